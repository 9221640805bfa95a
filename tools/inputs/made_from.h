/// A number for what a result is made from: the version, a command, its arguments, the bytes of
/// files. Two results of one number go together.
#ifndef MADE_FROM_H
#define MADE_FROM_H

#include "arguments/options.h"

/// Begins with the version and the name of a command.
uint64_t made_from_command(const char *name);

/// Adds bytes, and an end that tells "ab", "c" from "a", "bc": FNV-1a of 64 bits (RFC 9923).
uint64_t made_from_bytes(uint64_t sum, const char *bytes, size_t size);

/// Adds an argument: of a file its bytes, whatever its name.
sl_status made_from_argument(sl_context *context, const char *argument, uint64_t *sum);

#endif

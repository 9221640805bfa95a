/// What the sources of the JavaScript bindings share.
#ifndef SIGHTLINE_BINDINGS_H
#define SIGHTLINE_BINDINGS_H

#include "sightline/support.h"

/// The bytes of the last file written; NULL for none.
const char *sli_written(size_t *size);

/// A function that JavaScript calls by `name`.
#define SLI_EXPORT(type, name, ...)                                                                \
    type name(__VA_ARGS__);                                                                        \
    __attribute__((export_name(#name))) type name(__VA_ARGS__)

#endif

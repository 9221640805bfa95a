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

/// What every module that bakes has (module.c): a context, and places for numbers that JavaScript
/// reads. One instance of a module serves one thread, so this state is global.
typedef struct sli_module_state {
    sl_context *context;
    sl_status status; ///< of the last call
    uint32_t integers[40];
    double numbers[32];
} sli_module_state;

extern sli_module_state sli_module;

/// Keeps the status of a call; whether it is SL_OK.
bool sli_done(sl_status status);

#endif

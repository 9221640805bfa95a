/// The part of a module that all have, and that module.js calls.
#include "bindings/js/src/bindings.h"

#include "sightline/version.h"

#include <stdlib.h>

sli_module_state sli_module;

/// JavaScript wants to hear of progress.
static bool watched;

__attribute__((import_module("host"), import_name("progress"))) int
host_progress(const char *stage, double done, double total);
__attribute__((import_module("host"), import_name("cancelled"))) int host_cancelled(void);

static void progress(void *user, const sl_progress *at) {
    (void)user;
    if (watched) host_progress(at->stage, (double)at->done, (double)at->total);
}

static bool cancelled(void *user) {
    (void)user;
    return watched && host_cancelled();
}

bool sli_done(sl_status status) {
    sli_module.status = status;
    return status == SL_OK;
}

/// Makes the context; false where there is no memory even for that.
SLI_EXPORT(int, begin, void) {
    const sl_hooks hooks = {.progress = progress, .cancelled = cancelled};
    if (!sli_module.context) sli_module.context = sl_context_create(&hooks);
    return sli_module.context != NULL;
}

SLI_EXPORT(void *, take, size_t bytes) {
    return malloc(bytes ? bytes : 1);
}

SLI_EXPORT(void, give, void *block) {
    free(block);
}

SLI_EXPORT(const char *, message, void) {
    return sl_context_message(sli_module.context);
}

SLI_EXPORT(int, status, void) {
    return (int)sli_module.status;
}

SLI_EXPORT(const char *, version, void) {
    return sl_version();
}

SLI_EXPORT(void, watch, int on) {
    watched = on;
}

SLI_EXPORT(const uint32_t *, integers_place, void) {
    return sli_module.integers;
}

SLI_EXPORT(const double *, numbers_place, void) {
    return sli_module.numbers;
}

/// The bytes of what was written last; their number is integers[0].
SLI_EXPORT(const char *, written, void) {
    size_t size;
    const char *bytes = sli_written(&size);
    sli_module.integers[0] = (uint32_t)size;
    return bytes;
}

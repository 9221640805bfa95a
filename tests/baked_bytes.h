/// A baked file in memory, as tests, fuzzers and benchmarks keep it.
#ifndef SL_BAKED_BYTES_H
#define SL_BAKED_BYTES_H

#include "sightline/bake.h"
#include "sightline/support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// The bytes of the file that sl_baked_write would write, for free().
static inline char *baked_bytes(sl_context *context, const sl_baked *baked, size_t *size) {
    sl_bytes printed = {0};
    const sl_status status = sl_baked_print(context, baked, &printed);
    char *bytes = status == SL_OK ? malloc(printed.size + 1) : NULL;
    if (!bytes) {
        fprintf(stderr, "no baked file: %s\n", sl_context_message(context));
        abort();
    }
    memcpy(bytes, printed.data, printed.size + 1);
    sl_free(context, printed.data);
    *size = printed.size;
    return bytes;
}

#endif

/// What the fuzzers share.
#ifndef SL_FUZZ_H
#define SL_FUZZ_H

#include "sightline/io.h"
#include "sightline/space.h"
#include "unit/map_same.h"

#include <stdio.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/// Holds in every build: a finding is a program that ends here.
#define FUZZ_CHECK(condition)                                                                      \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition);                \
            abort();                                                                               \
        }                                                                                          \
    } while (0)

static inline sl_context *fuzz_context(void) {
    sl_context *context = sl_context_create(NULL);
    FUZZ_CHECK(context);
    return context;
}

/// A map written as text must read back as the same map. Gives that text, for free().
static inline char *fuzz_round_trip(sl_context *context, const sl_map *map) {
    char *text = map_text(map);
    sl_map back = {0};
    FUZZ_CHECK(sl_map_read_text(context, "back", text, strlen(text), &back) == SL_OK);
    FUZZ_CHECK(map_same(map, &back));
    sl_map_destroy(context, &back);
    return text;
}

/// What a reader refused: the status that bad input has, a message, and an empty map.
static inline void fuzz_refused(sl_context *context, sl_status status, const sl_map *map) {
    FUZZ_CHECK(status == SL_BAD_INPUT);
    FUZZ_CHECK(strncmp(sl_context_message(context), "input:", 6) == 0);
    FUZZ_CHECK(map_is_empty(map));
}

/// A map's own cells make a space that is in order, or are refused.
static inline void fuzz_cells(sl_context *context, const sl_map *map) {
    sl_space space = {0};
    const sl_status status = sl_subdivide_given(context, map, &space);
    if (status == SL_OK)
        FUZZ_CHECK(sl_space_check(context, &space) == SL_OK);
    else
        FUZZ_CHECK((status == SL_BAD_INPUT || status == SL_UNSUPPORTED) && !space.cells);
    sl_space_destroy(context, &space);
}

typedef sl_status fuzz_reader(sl_context *context, const char *name, const char *text, size_t size,
                              const sl_import_options *options, sl_map *map);

/// Reads a map: whatever is read is written as map text and read back the same. `argument` is what
/// the message names where the options do not fit the file; NULL where they always do.
static inline void fuzz_read(sl_context *context, const uint8_t *data, size_t size,
                             fuzz_reader *read, const sl_import_options *options,
                             const char *argument) {
    sl_map map = {0};
    const sl_status status = read(context, "input", (const char *)data, size, options, &map);
    if (status == SL_OK) {
        free(fuzz_round_trip(context, &map));
    } else if (argument && status == SL_BAD_ARGUMENT) {
        FUZZ_CHECK(strstr(sl_context_message(context), argument));
        FUZZ_CHECK(map_is_empty(&map));
    } else {
        fuzz_refused(context, status, &map);
    }
    sl_map_destroy(context, &map);
}

#endif

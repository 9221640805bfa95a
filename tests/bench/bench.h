/// What the programs that measure share: the processor's time, giving up, and a space from a map
/// file, cut as the map calls for.
#ifndef SL_BENCH_H
#define SL_BENCH_H

#include "sightline/io.h"
#include "sightline/space.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/// Of the processor.
static inline double bench_seconds(void) {
    struct timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static inline void bench_fail(const char *what) {
    fprintf(stderr, "%s\n", what);
    exit(1);
}

static inline void bench_must(sl_context *context, sl_status status) {
    if (status != SL_OK) bench_fail(context ? sl_context_message(context) : "failed");
}

/// `which`: the height of a model's slice, a WAD's level, or NULL. A level with ":given" behind its
/// name keeps the cells of its node builder.
static inline sl_status bench_read_space(sl_context *context, const char *path, const char *which,
                                         sl_space *space) {
    const char *ending = strrchr(path, '.');
    const bool is_wad = ending && strcmp(ending, ".wad") == 0;
    sl_import_options options = sl_import_options_default();
    char level[16];
    snprintf(level, sizeof level, "%.*s", which ? (int)strcspn(which, ":") : 0, which ? which : "");
    options.map = is_wad && which ? level : NULL;
    options.cells = is_wad && which && strcmp(which + strlen(level), ":given") == 0;
    options.has_slice = which && !is_wad;
    options.slice = options.has_slice ? strtod(which, NULL) : 0;
    sl_map map = {0};
    sl_status status = sl_io_use(context);
    if (status == SL_OK) status = sl_map_read(context, path, &options, &map);
    if (status == SL_OK) status = sl_map_clean(context, &map, NULL, NULL);
    if (status == SL_OK) status = sl_subdivision_for(&map)->subdivide(context, &map, NULL, space);
    sl_map_destroy(context, &map);
    return status;
}

#endif

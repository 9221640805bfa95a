/// A space for measurements: from a map file, cut as the map calls for.
#ifndef SL_BENCH_READ_SPACE_H
#define SL_BENCH_READ_SPACE_H

#include "sightline/io.h"
#include "sightline/space.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

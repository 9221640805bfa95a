/// What the programs that measure share: the processor's time, giving up, files, and a map by its
/// name: read, cut as it calls for, baked.
#ifndef SL_BENCH_H
#define SL_BENCH_H

#include "sightline/bake.h"
#include "sightline/generate.h"
#include "sightline/io.h"
#include "sightline/space.h"
#include "sightline/stab.h"

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

_Noreturn static inline void bench_fail(const char *what) {
    fprintf(stderr, "%s\n", what);
    exit(1);
}

static inline void bench_must(const sl_context *context, sl_status status) {
    if (status != SL_OK) bench_fail(context ? sl_context_message(context) : "failed");
}

/// A file's bytes, for free().
static inline void *bench_read_file(const char *path, size_t *size) {
    FILE *file = fopen(path, "rb");
    if (!file || fseek(file, 0, SEEK_END) != 0) bench_fail("cannot read the file");
    *size = (size_t)ftell(file);
    rewind(file);
    void *bytes = malloc(*size + 1);
    if (!bytes || fread(bytes, 1, *size, file) != *size) bench_fail("cannot read the file");
    fclose(file);
    return bytes;
}

/// The kind of a generated map, "office:20"; NULL: the name is that of a file.
static inline const sl_map_kind *bench_kind(const char *name) {
    size_t count;
    const sl_map_kind *kinds = sl_map_kinds(&count);
    const size_t length = strcspn(name, ":");
    for (size_t i = 0; i < count && name[length]; i++)
        if (strlen(kinds[i].name) == length && memcmp(kinds[i].name, name, length) == 0)
            return &kinds[i];
    return NULL;
}

/// `name`: KIND:SIZE[:DEGREES], a generated map, turned; or a file. `which`: the height of a
/// model's slice, a WAD's level, or NULL. A level with ":given" behind its name keeps the cells of
/// its node builder.
static inline void bench_read_map(sl_context *context, const char *name, const char *which,
                                  sl_map *map) {
    const sl_map_kind *kind = bench_kind(name);
    bench_must(context, sl_io_use(context));
    if (kind) {
        sl_generate_options options = sl_generate_options_default();
        char *turned;
        options.size = strtoull(strchr(name, ':') + 1, &turned, 10);
        if (*turned == ':') options.turned = strtod(turned + 1, NULL);
        bench_must(context, sl_generate(context, kind, &options, map));
    } else {
        const char *ending = strrchr(name, '.');
        const bool is_wad = ending && strcmp(ending, ".wad") == 0;
        sl_import_options options = sl_import_options_default();
        char level[16];
        snprintf(level, sizeof level, "%.*s", which ? (int)strcspn(which, ":") : 0,
                 which ? which : "");
        options.map = is_wad && which ? level : NULL;
        options.cells = is_wad && which && strcmp(which + strlen(level), ":given") == 0;
        options.has_slice = which && !is_wad;
        options.slice = options.has_slice ? strtod(which, NULL) : 0;
        bench_must(context, sl_map_read(context, name, &options, map));
    }
    bench_must(context, sl_map_clean(context, map, NULL, NULL));
}

static inline void bench_read_space(sl_context *context, const char *name, const char *which,
                                    sl_space *space) {
    sl_map map = {0};
    bench_read_map(context, name, which, &map);
    bench_must(context, sl_subdivision_for(&map)->subdivide(context, &map, NULL, space));
    sl_map_destroy(context, &map);
}

/// The map with its space and its visible sets.
static inline void bench_bake(sl_context *context, const char *name, const char *which,
                              sl_baked *baked) {
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    size_t count;
    *baked = (sl_baked){.method = "dfs", .solver = "funnel"};
    bench_read_map(context, name, which, &baked->map);
    bench_must(
        context,
        sl_subdivision_for(&baked->map)->subdivide(context, &baked->map, NULL, &baked->space));
    bench_must(context,
               sl_see_methods(&count)->see(context, &baked->space, &options, &baked->visibility));
}

#endif

/// Maps baked in memory and opened by the runtime, for its tests.
#ifndef SL_RUNTIME_MAPS_H
#define SL_RUNTIME_MAPS_H

#include "baked_bytes.h"
#include "map_files.h"

#include "map/scan.h"
#include "runtime/sightline_runtime.h"
#include "sightline/stab.h"
#include "sightline/support.h"

#include <math.h>

typedef struct baked_file {
    const char *name;
    sl_baked baked;
    char *bytes;
    size_t size;
    sl_runtime runtime;
} baked_file;

static inline void baked_file_open(baked_file *f) {
    const sl_runtime_status status = sl_runtime_open(f->bytes, f->size, &f->runtime);
    if (status != SL_RUNTIME_OK) fail_msg("%s: %s", f->name, sl_runtime_status_text(status));
}

/// The map of `f->baked` cut, seen, printed, opened.
static inline void baked_file_make(sl_context *context, baked_file *f, bool inside_only) {
    sl_baked *b = &f->baked;
    testing_subdivide(context, &b->map, &b->space);
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    options.inside_only = inside_only;
    size_t count;
    assert_ok(context, sl_see_methods(&count)->see(context, &b->space, &options, &b->visibility));
    f->bytes = baked_bytes(context, b, &f->size);
    baked_file_open(f);
}

static inline baked_file baked_file_of_text(sl_context *context, const char *statements) {
    baked_file f = {.name = "text", .baked = {.method = "dfs", .solver = "funnel"}};
    char text[1100];
    snprintf(text, sizeof text, "sightline 1\n%s", statements);
    assert_ok(context, sli_map_read_text(context, "text", text, strlen(text), &f.baked.map));
    baked_file_make(context, &f, false);
    return f;
}

static inline baked_file baked_file_of(sl_context *context, const char *path) {
    baked_file f = {.name = path, .baked = {.method = "dfs", .solver = "funnel"}};
    map_files_read(context, path, &f.baked.map);
    baked_file_make(context, &f, false);
    return f;
}

/// The walls of a map of maps/, those that do not stop all too, turned and moved away from the
/// origin.
static inline baked_file baked_file_turned(sl_context *context, const char *name, double degrees,
                                           double offset) {
    char path[1024];
    baked_file f = {.name = name, .baked = {.method = "dfs", .solver = "funnel"}};
    sl_map *map = &f.baked.map;
    const double angle = degrees * 0.017453292519943295, sine = sin(angle), cosine = cos(angle);
    snprintf(path, sizeof path, "%s/maps/%s.map", SIGHTLINE_SOURCE_DIR, name);
    map_files_read(context, path, map);
    for (size_t i = 0; i < 2 * map->wall_count; i++) {
        sl_point *p = i % 2 ? &map->walls[i / 2].a : &map->walls[i / 2].b;
        *p = (sl_point){offset + cosine * p->x - sine * p->y, offset + sine * p->x + cosine * p->y};
    }
    for (size_t i = 0; i < 2 * map->seam_count; i++) {
        sl_point *p = i % 2 ? &map->seams[i / 2].segment.a : &map->seams[i / 2].segment.b;
        *p = (sl_point){offset + cosine * p->x - sine * p->y, offset + sine * p->x + cosine * p->y};
    }
    map->start_count = 0;
    baked_file_make(context, &f, false);
    return f;
}

static inline void baked_file_destroy(sl_context *context, baked_file *f) {
    sl_baked_destroy(context, &f->baked);
    free(f->bytes);
}

/// Does something with every map file there is.
static inline void baked_file_each(void (*visit)(const baked_file *)) {
    sl_context *context = testing_context(NULL);
    glob_t found = map_files_find(MAP_FILES_ALL);
    for (size_t i = 0; i < found.gl_pathc; i++) {
        baked_file f = baked_file_of(context, found.gl_pathv[i]);
        visit(&f);
        baked_file_destroy(context, &f);
    }
    globfree(&found);
    sl_context_destroy(context);
}

/// A wall on a grid of `size` by `size`, upright or level, up to 4 long.
static inline sl_segment grid_segment(sl_random *random, int size) {
    const bool upright = sl_random_below(random, 2);
    const double at = (double)sl_random_below(random, (uint64_t)size + 1);
    const double from = (double)sl_random_below(random, (uint64_t)size);
    const double to = fmin(from + 1 + (double)sl_random_below(random, 4), size);
    const sl_segment s =
        upright ? (sl_segment){{at, from}, {at, to}} : (sl_segment){{from, at}, {to, at}};
    return sl_random_below(random, 2) ? (sl_segment){s.b, s.a} : s;
}

/// A room of `size` by `size` with walls and open doors (named a, b, c, ...) anywhere in it. Not
/// clean yet.
static inline void grid_rooms(sl_context *context, sl_random *random, int size, int walls,
                              int doors, sl_map *map) {
    const sl_point c[5] = {{0, 0}, {size, 0}, {size, size}, {0, size}, {0, 0}};
    for (int i = 0; i < 4; i++)
        assert_ok(context, sl_map_add_wall(context, map, c[i], c[i + 1], 0));
    for (int i = 0; i < walls; i++) {
        const sl_segment at = grid_segment(random, size);
        assert_ok(context, sl_map_add_wall(context, map, at.a, at.b, 0));
    }
    for (int i = 0; i < doors; i++) {
        const char name[2] = {(char)('a' + i), 0};
        assert_ok(context,
                  sl_map_add_door(context, map, name, grid_segment(random, size), true, 0));
    }
}

static inline sl_point runtime_between(sl_point a, sl_point b, double part) {
    return (sl_point){a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)};
}

/// A point of the cone's border in one of some directions, also along walls; exact to subtract
/// again. The eye itself where there is none such.
static inline sl_point runtime_border(sl_random *random, sl_point eye, double reach) {
    const double step = ldexp(1, ilogb(reach) - 4);
    const sl_point by = {step * ((double)sl_random_below(random, 9) - 4),
                         step * ((double)sl_random_below(random, 9) - 4)};
    const sl_point at = {eye.x + by.x, eye.y + by.y};
    // Knuth's two-sum leaves nothing over.
    const bool exact = at.x - eye.x == by.x && at.x - by.x == eye.x && at.y - eye.y == by.y &&
                       at.y - by.y == eye.y;
    return exact ? at : eye;
}

#endif

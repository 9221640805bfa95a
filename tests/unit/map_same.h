/// Maps as text, and whether two maps are the same but for the lines they came from.
#ifndef SL_MAP_SAME_H
#define SL_MAP_SAME_H

#include "map/scan.h"

#include <stdlib.h>
#include <string.h>

/// free() is the caller's; aborts where there is no memory.
static inline char *map_text(const sl_map *map) {
    char *text = NULL;
    size_t size;
    FILE *stream = open_memstream(&text, &size);
    if (!stream) abort();
    sl_context *context = sl_context_create(NULL);
    if (!context || sli_map_print_text(context, map, stream) != SL_OK) abort();
    sl_context_destroy(context);
    if (fclose(stream) != 0) abort();
    return text;
}

/// As map_text, with solid ground left out, all walls as walls, and no unit.
static inline char *map_walls_text(const sl_map *map) {
    sl_map bare = *map;
    bare.unit[0] = '\0';
    bare.unit_line = 0;
    bare.walls = malloc((map->wall_count + 1) * sizeof *bare.walls);
    if (!bare.walls) abort();
    for (size_t i = 0; i < map->wall_count; i++) {
        bare.walls[i] = map->walls[i];
        bare.walls[i].ground = 0;
    }
    char *text = map_text(&bare);
    free(bare.walls);
    return text;
}

/// The plan's text, for free(); NULL where there is none, the status then in *status.
static inline char *map_plan_text(sl_context *context, const sl_map *map, sl_status *status) {
    char *text = NULL;
    size_t size;
    FILE *stream = open_memstream(&text, &size);
    if (!stream) abort();
    *status = sli_map_print_plan(context, map, stream);
    if (fclose(stream) != 0) abort();
    if (*status == SL_OK) return text;
    if (size) abort();
    free(text);
    return NULL;
}

/// Tells 0 from -0.
static inline bool same_numbers(const double *a, const double *b, size_t count) {
    return memcmp(a, b, count * sizeof *a) == 0;
}

static inline bool same_points(const sl_point *a, const sl_point *b, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!same_numbers(&a[i].x, &b[i].x, 1) || !same_numbers(&a[i].y, &b[i].y, 1)) return false;
    return true;
}

static inline bool same_segment(sl_segment a, sl_segment b) {
    return same_points(&a.a, &b.a, 1) && same_points(&a.b, &b.b, 1);
}

static inline bool same_text(const char *a, const char *b) {
    return a && b ? strcmp(a, b) == 0 : a == b;
}

static inline bool same_walls(const sl_map *a, const sl_map *b) {
    if (a->wall_count != b->wall_count) return false;
    for (size_t i = 0; i < a->wall_count; i++)
        if (!same_points(&a->walls[i].a, &b->walls[i].a, 1) ||
            !same_points(&a->walls[i].b, &b->walls[i].b, 1) ||
            a->walls[i].ground != b->walls[i].ground)
            return false;
    return true;
}

static inline bool same_glass(const sl_glass *a, const sl_glass *b, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!same_segment(a[i].segment, b[i].segment)) return false;
    return true;
}

static inline bool same_doors(const sl_door *a, const sl_door *b, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!same_text(a[i].name, b[i].name) || !same_segment(a[i].segment, b[i].segment) ||
            a[i].open != b[i].open)
            return false;
    return true;
}

static inline bool same_starts(const sl_start *a, const sl_start *b, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!same_points(&a[i].at, &b[i].at, 1) || !same_numbers(&a[i].heading, &b[i].heading, 1))
            return false;
    return true;
}

static inline bool same_paths(const sl_path *a, const sl_path *b, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!same_text(a[i].name, b[i].name) || a[i].count != b[i].count ||
            !same_points(a[i].points, b[i].points, a[i].count))
            return false;
    return true;
}

static inline bool same_objects(const sl_object *a, const sl_object *b, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!same_text(a[i].name, b[i].name) || !same_points(&a[i].box.min, &b[i].box.min, 1) ||
            !same_points(&a[i].box.max, &b[i].box.max, 1))
            return false;
    return true;
}

static inline bool same_cells(const sl_map *a, const sl_map *b) {
    if (a->cell_count != b->cell_count || a->corner_count != b->corner_count) return false;
    for (size_t i = 0; i < a->cell_count; i++)
        if (a->cells[i].first != b->cells[i].first || a->cells[i].count != b->cells[i].count)
            return false;
    return same_points(a->corners, b->corners, a->corner_count) &&
           same_numbers(&a->snap, &b->snap, 1);
}

static inline bool map_same(const sl_map *a, const sl_map *b) {
    return same_walls(a, b) && a->door_count == b->door_count &&
           a->mirror_count == b->mirror_count && a->oneway_count == b->oneway_count &&
           a->seam_count == b->seam_count && a->start_count == b->start_count &&
           a->path_count == b->path_count && a->object_count == b->object_count &&
           same_text(a->source.notes, b->source.notes) &&
           same_doors(a->doors, b->doors, a->door_count) &&
           same_glass(a->mirrors, b->mirrors, a->mirror_count) &&
           same_glass(a->oneways, b->oneways, a->oneway_count) &&
           same_glass(a->seams, b->seams, a->seam_count) &&
           same_starts(a->starts, b->starts, a->start_count) &&
           same_paths(a->paths, b->paths, a->path_count) &&
           same_objects(a->objects, b->objects, a->object_count) && same_cells(a, b) &&
           same_numbers(&a->range, &b->range, 1);
}

/// Whether nothing is in the map and nothing is owned by it.
static inline bool map_is_empty(const sl_map *map) {
    const sl_map empty = {0};
    return map_same(map, &empty) && !map->source.name && !map->walls && !map->doors &&
           !map->mirrors && !map->oneways && !map->seams && !map->starts && !map->paths &&
           !map->objects && !map->cells;
}

#endif

/// Closing gaps: wall ends that are near to each other, then ends that are near to a wall.
#include "space/faults.h"

#include "geometry/orient.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// An end of a wall.
typedef struct wall_end {
    sl_point at;
    uint32_t wall;
    uint32_t users; ///< walls with an end at the same place
    bool second;
} wall_end;

typedef struct snapper {
    sl_context *context;
    sl_map *map;
    double gap;
    wall_end *ends; ///< by place; those of one place together
    size_t count;
    sl_snap_account account;
} snapper;

static int compare_places(const void *left, const void *right) {
    const wall_end *a = left, *b = right;
    if (a->at.x != b->at.x) return a->at.x < b->at.x ? -1 : 1;
    if (a->at.y != b->at.y) return a->at.y < b->at.y ? -1 : 1;
    return a->wall != b->wall ? (a->wall < b->wall ? -1 : 1) : a->second - b->second;
}

/// The most used places first, and then those of the first walls.
static int compare_use(const void *left, const void *right) {
    const wall_end *a = left, *b = right;
    if (a->users != b->users) return a->users > b->users ? -1 : 1;
    return a->wall != b->wall ? (a->wall < b->wall ? -1 : 1) : a->second - b->second;
}

static sl_point *end_of(snapper *s, const wall_end *end) {
    sl_wall *wall = &s->map->walls[end->wall];
    return end->second ? &wall->b : &wall->a;
}

static void list_ends(snapper *s) {
    for (size_t i = 0; i < s->map->wall_count; i++) {
        s->ends[2 * i] = (wall_end){.at = s->map->walls[i].a, .wall = (uint32_t)i};
        s->ends[2 * i + 1] =
            (wall_end){.at = s->map->walls[i].b, .wall = (uint32_t)i, .second = true};
    }
    s->count = 2 * s->map->wall_count;
    qsort(s->ends, s->count, sizeof *s->ends, compare_places);
    for (size_t i = 0, end; i < s->count; i = end) {
        for (end = i; end < s->count && sl_same_point(s->ends[i].at, s->ends[end].at); end++)
            continue;
        for (size_t k = i; k < end; k++) s->ends[k].users = (uint32_t)(end - i);
    }
}

static void move_end(snapper *s, sl_point *end, sl_point to) {
    const double way = sl_apart(*end, to);
    if (sl_same_point(*end, to)) return;
    s->account.moved++;
    s->account.farthest = fmax(s->account.farthest, way);
    *end = to;
}

// --- ends to ends

/// Moves each end near to a place that is no less used, if it has not been moved, onto that place.
/// `settled` says which walls' ends have their place, two bits a wall.
static sl_status join_ends(snapper *s, const sl_wall_grid *grid, uint8_t *settled) {
    const sl_wall *before = s->map->walls;
    for (size_t i = 0; i < s->count; i++) {
        const wall_end *keep = &s->ends[i];
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(s->context));
        if (settled[keep->wall] >> keep->second & 1) continue;
        uint32_t count;
        const uint32_t *near = sl_wall_grid_at(grid, keep->at, &count);
        for (uint32_t k = 0; k < count; k++) {
            for (int second = 0; second < 2; second++) {
                const sl_wall *wall = &before[near[k]];
                const sl_point at = second ? wall->b : wall->a;
                if (settled[near[k]] >> second & 1 || sl_apart(at, keep->at) > s->gap) continue;
                settled[near[k]] |= (uint8_t)(1 << second);
                const wall_end moved = {.wall = near[k], .second = second};
                move_end(s, end_of(s, &moved), keep->at);
            }
        }
    }
    return SL_OK;
}

// --- ends to walls

static bool is_upright(const sl_wall *wall) {
    return wall->a.x == wall->b.x;
}

static bool is_level(const sl_wall *wall) {
    return wall->a.y == wall->b.y;
}

/// Where an end of one wall meets another wall.
static sl_point meeting(const sl_wall *own, sl_point end, const sl_wall *other) {
    if (is_upright(own) && is_level(other)) return (sl_point){end.x, other->a.y};
    if (is_level(own) && is_upright(other)) return (sl_point){other->a.x, end.y};
    sl_point to = sl_nearest_on_wall(other, end);
    if (is_upright(other)) to.x = other->a.x;
    if (is_level(other)) to.y = other->a.y;
    return to;
}

static void put_on_wall(snapper *s, const sl_wall_grid *grid, const wall_end *end) {
    sl_point *at = end_of(s, end);
    const sl_wall *own = &s->map->walls[end->wall];
    uint32_t count;
    const uint32_t *near = sl_wall_grid_at(grid, *at, &count);
    sl_point best = *at;
    double least = INFINITY;
    for (uint32_t k = 0; k < count; k++) {
        const sl_wall *other = &s->map->walls[near[k]];
        if (near[k] == end->wall || sl_same_point(other->a, other->b)) continue;
        if (sl_touches_wall(other, *at)) return;
        const sl_point to = meeting(own, *at, other);
        const double way = sl_apart(*at, to);
        const bool there = sl_apart(to, sl_nearest_on_wall(other, to)) <= s->gap;
        if (way > s->gap || way >= least || !there) continue;
        least = way;
        best = to;
    }
    move_end(s, at, best);
}

// --- both

static void drop_points(snapper *s) {
    size_t kept = 0;
    for (size_t i = 0; i < s->map->wall_count; i++) {
        const sl_wall wall = s->map->walls[i];
        if (!sl_same_point(wall.a, wall.b)) s->map->walls[kept++] = wall;
    }
    s->account.vanished = s->map->wall_count - kept;
    s->map->wall_count = kept;
}

static sl_status snap_to_ends(snapper *s) {
    sl_wall_grid grid;
    uint8_t *settled = sl_alloc_array(s->context, s->map->wall_count, sizeof *settled);
    if (!settled) return SL_NO_MEMORY;
    sl_status status = sl_wall_grid_create(s->context, s->map, s->gap, &grid);
    if (status == SL_OK) {
        list_ends(s);
        qsort(s->ends, s->count, sizeof *s->ends, compare_use);
        status = join_ends(s, &grid, settled);
        sl_wall_grid_destroy(s->context, &grid);
    }
    sl_free(s->context, settled);
    return status;
}

/// The grid holds what is within twice the gap: walls move while it serves, each by a gap at most.
static sl_status snap_to_walls(snapper *s) {
    sl_wall_grid grid;
    SL_TRY(sl_wall_grid_create(s->context, s->map, 2 * s->gap, &grid));
    list_ends(s);
    qsort(s->ends, s->count, sizeof *s->ends, compare_use);
    for (size_t i = 0; i < s->count; i++)
        if (s->ends[i].users == 1) put_on_wall(s, &grid, &s->ends[i]);
    sl_wall_grid_destroy(s->context, &grid);
    return SL_OK;
}

sl_status sl_map_snap(sl_context *context, sl_map *map, double gap, sl_snap_account *account) {
    if (!(gap > 0 && sl_coordinate_usable(gap)))
        return sl_fail(context, SL_BAD_ARGUMENT, "the gap to close must be a positive number");
    snapper s = {.context = context, .map = map, .gap = gap};
    s.ends = sl_alloc_array(context, 2 * map->wall_count, sizeof *s.ends);
    if (!s.ends) return SL_NO_MEMORY;
    sl_status status = snap_to_ends(&s);
    if (status == SL_OK) status = snap_to_walls(&s);
    if (status == SL_OK) drop_points(&s);
    if (status == SL_OK) sl_map_drop_cells(context, map);
    sl_free(context, s.ends);
    if (status == SL_OK && account) *account = s.account;
    return status;
}

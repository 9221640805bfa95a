/// Closing gaps by moving the ends of walls, and which gaps and leaks that leaves.
///
///     ends to ends             ends to walls
///
///     ---. .---                ---.  |
///            ->                      |   ->
///     ----o----                ------o
///                                    |
///
/// Ends near an often used place move onto that place; then free ends move onto a near wall. Axial
/// walls stay axial where they can. Mending (sl_map_mend) cleans the map and snaps it by turns,
/// until nothing moves. In a clean map walls touch in common ends alone, and all ends at a place
/// move together. So mending opens nothing that was closed.
///
/// A corner near the side of a wall stays where it is: someone has to decide which of the two is
/// right. What is left is found by mending a copy. Time about O(n log n) for walls that are short
/// against the map.
#include "space/faults/faults.h"

#include "geometry/orient.h"

#include <math.h>
#include <stdlib.h>

static bool touches_segment(sl_segment at, sl_point p) {
    const sl_wall wall = {.a = at.a, .b = at.b};
    return sli_touches_wall(&wall, p);
}

// --- closing gaps

/// An end of a wall.
typedef struct wall_end {
    sl_point at;
    uint32_t wall;
    uint32_t users; ///< the number of walls with an end at this place
    bool second;
} wall_end;

/// A place, and where its ends went.
typedef struct snap_move {
    sl_point from, to;
} snap_move;

/// A wall that is to go through a point, which is on it but for rounding.
typedef struct snap_split {
    uint32_t wall;
    double along; ///< from the wall's first end
    sl_point at;
} snap_split;

typedef struct snapper {
    sl_context *context;
    sl_map *map;
    double gap;
    wall_end *ends; ///< sorted by place
    size_t count;
    SL_ARRAY(snap_move) moves; ///< of one step
    SL_ARRAY(snap_split) splits;
    sl_mend_account account;
} snapper;

static int compare_places(const void *left, const void *right) {
    const wall_end *a = left, *b = right;
    if (a->at.x != b->at.x) return a->at.x < b->at.x ? -1 : 1;
    if (a->at.y != b->at.y) return a->at.y < b->at.y ? -1 : 1;
    return a->wall != b->wall ? (a->wall < b->wall ? -1 : 1) : a->second - b->second;
}

/// The most used places first; then the order of walls.
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
        for (end = i; end < s->count && sli_same_point(s->ends[i].at, s->ends[end].at); end++)
            continue;
        for (size_t k = i; k < end; k++) s->ends[k].users = (uint32_t)(end - i);
    }
}

static sl_status move_end(snapper *s, sl_point *end, sl_point to) {
    const double way = sli_apart(*end, to);
    if (sli_same_point(*end, to)) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(s->context, &s->moves, 1));
    s->moves.items[s->moves.count++] = (snap_move){*end, to};
    s->account.moved++;
    s->account.farthest = fmax(s->account.farthest, way);
    *end = to;
    return SL_OK;
}

// --- ends to ends

/// Moves ends onto a near place that is used at least as often. Each end moves once. `settled` has
/// two bits by wall: its ends that have their place.
static sl_status join_ends(snapper *s, sli_wall_index *index, uint8_t *settled) {
    const sl_wall *before = s->map->walls;
    for (size_t i = 0; i < s->count; i++) {
        const wall_end *keep = &s->ends[i];
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(s->context));
        if (settled[keep->wall] >> keep->second & 1) continue;
        const sli_box_list *near = &index->near;
        SL_TRY(sli_walls_near(s->context, index, (sl_segment){keep->at, keep->at}, s->gap));
        for (size_t k = 0; k < near->count; k++) {
            const uint32_t number = near->items[k];
            for (int second = 0; second < 2; second++) {
                const sl_wall *wall = &before[number];
                const sl_point at = second ? wall->b : wall->a;
                if (settled[number] >> second & 1 || sli_apart(at, keep->at) > s->gap) continue;
                settled[number] |= (uint8_t)(1 << second);
                const wall_end moved = {.wall = number, .second = second};
                SL_TRY(move_end(s, end_of(s, &moved), keep->at));
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

/// The place where an end of one wall meets another wall.
static sl_point meeting(const sl_wall *own, sl_point end, const sl_wall *other) {
    if (is_upright(own) && is_level(other)) return (sl_point){end.x, other->a.y};
    if (is_level(own) && is_upright(other)) return (sl_point){other->a.x, end.y};
    sl_point to = sli_nearest_on_wall(other, end);
    if (is_upright(other)) to.x = other->a.x;
    if (is_level(other)) to.y = other->a.y;
    return to;
}

/// Has a wall go through a point, unless it does or the point lies beyond its ends.
static sl_status add_split(snapper *s, uint32_t number, sl_point at) {
    const sl_wall *wall = &s->map->walls[number];
    const sl_point way = {wall->b.x - wall->a.x, wall->b.y - wall->a.y};
    const double along = (at.x - wall->a.x) * way.x + (at.y - wall->a.y) * way.y;
    if (sli_touches_wall(wall, at) || !(along > 0 && along < way.x * way.x + way.y * way.y))
        return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(s->context, &s->splits, 1));
    s->splits.items[s->splits.count++] = (snap_split){number, along, at};
    return SL_OK;
}

static int compare_splits(const void *left, const void *right) {
    const snap_split *a = left, *b = right;
    if (a->wall != b->wall) return a->wall < b->wall ? -1 : 1;
    return (a->along > b->along) - (a->along < b->along);
}

/// The first piece of a split wall keeps its number.
static sl_status split_walls(snapper *s) {
    const snap_split *splits = s->splits.items;
    if (s->splits.count) qsort(s->splits.items, s->splits.count, sizeof *splits, compare_splits);
    for (size_t i = s->splits.count; i-- > 0;) {
        const sl_wall wall = s->map->walls[splits[i].wall];
        SL_TRY(sl_map_add_wall(s->context, s->map, splits[i].at, wall.b, wall.line));
        // All else that a wall says of itself holds for both pieces.
        sl_wall *last = &s->map->walls[s->map->wall_count - 1];
        *last = wall;
        last->a = s->map->walls[splits[i].wall].b = splits[i].at;
    }
    return SL_OK;
}

/// Each wall may have moved by a gap since the index was made.
static sl_status put_on_wall(snapper *s, sli_wall_index *index, const wall_end *end) {
    sl_point *at = end_of(s, end);
    const sl_wall *own = &s->map->walls[end->wall];
    const sli_box_list *near = &index->near;
    SL_TRY(sli_walls_near(s->context, index, (sl_segment){*at, *at}, 2 * s->gap));
    sl_point best = *at;
    double least = INFINITY;
    uint32_t onto = end->wall;
    for (size_t k = 0; k < near->count; k++) {
        const sl_wall *other = &s->map->walls[near->items[k]];
        if (near->items[k] == end->wall || sli_same_point(other->a, other->b)) continue;
        if (sli_touches_wall(other, *at)) return SL_OK;
        const sl_point to = meeting(own, *at, other);
        const double way = sli_apart(*at, to);
        const bool there = sli_apart(to, sli_nearest_on_wall(other, to)) <= s->gap;
        if (way > s->gap || !there || way > least) continue;
        if (way == least && near->items[k] > onto) continue;
        least = way;
        best = to;
        onto = near->items[k];
    }
    if (onto == end->wall) return SL_OK;
    SL_TRY(add_split(s, onto, best));
    return move_end(s, at, best);
}

// --- doors and glass

static int compare_moves(const void *left, const void *right) {
    const snap_move *a = left, *b = right;
    const int order = sli_compare_points(a->from, b->from);
    return order ? order : sli_compare_points(a->to, b->to);
}

static sl_point moved_with(const snapper *s, sl_point end) {
    const size_t low = sli_first_at(s->moves.items, sizeof *s->moves.items, s->moves.count, end);
    const bool found = low < s->moves.count && sli_same_point(s->moves.items[low].from, end);
    return found ? s->moves.items[low].to : end;
}

/// Moves the ends at places whose walls moved. What would lose its length stays.
static bool carry(const snapper *s, sl_segment *at) {
    const sl_segment moved = {moved_with(s, at->a), moved_with(s, at->b)};
    if (sli_same_point(moved.a, moved.b)) return false;
    const bool differs = !sli_same_point(moved.a, at->a) || !sli_same_point(moved.b, at->b);
    *at = moved;
    return differs;
}

/// Ends the step: doors and glass go with the walls that they hang on.
static void carry_others(snapper *s) {
    sl_map *map = s->map;
    if (s->moves.count) qsort(s->moves.items, s->moves.count, sizeof(snap_move), compare_moves);
    for (size_t i = 0; i < map->mirror_count; i++) carry(s, &map->mirrors[i].segment);
    for (size_t i = 0; i < map->oneway_count; i++) carry(s, &map->oneways[i].segment);
    for (size_t i = 0; i < map->seam_count; i++) carry(s, &map->seams[i].segment);
    for (size_t i = 0; i < map->door_count; i++) {
        sl_door *door = &map->doors[i];
        if (!carry(s, &door->segment)) continue;
        sl_free(s->context, door->parts);
        door->parts = NULL;
        door->part_count = 0;
    }
    s->moves.count = 0;
}

// --- both steps

/// Drops walls of no length, and counts them.
static size_t drop_points(sl_map *map) {
    size_t kept = 0;
    for (size_t i = 0; i < map->wall_count; i++)
        if (!sli_same_point(map->walls[i].a, map->walls[i].b)) map->walls[kept++] = map->walls[i];
    const size_t dropped = map->wall_count - kept;
    map->wall_count = kept;
    return dropped;
}

static sl_status snap_to_ends(snapper *s) {
    sli_wall_index index;
    uint8_t *settled = sl_alloc_array(s->context, s->map->wall_count, sizeof *settled);
    if (!settled) return SL_NO_MEMORY;
    sl_status status = sli_wall_index_create(s->context, s->map, &index);
    if (status == SL_OK) {
        list_ends(s);
        qsort(s->ends, s->count, sizeof *s->ends, compare_use);
        status = join_ends(s, &index, settled);
    }
    sli_wall_index_destroy(s->context, &index);
    sl_free(s->context, settled);
    carry_others(s);
    return status;
}

static sl_status snap_to_walls(snapper *s) {
    sli_wall_index index;
    sl_status status = sli_wall_index_create(s->context, s->map, &index);
    list_ends(s);
    qsort(s->ends, s->count, sizeof *s->ends, compare_use);
    for (size_t i = 0; i < s->count && status == SL_OK; i++)
        if (s->ends[i].users == 1) status = put_on_wall(s, &index, &s->ends[i]);
    sli_wall_index_destroy(s->context, &index);
    if (status == SL_OK) status = split_walls(s);
    carry_others(s);
    return status;
}

sl_status sli_map_snap(sl_context *context, sl_map *map, double gap, sl_mend_account *account) {
    if (!(gap > 0 && sl_coordinate_usable(gap)))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "the gap to close is %g: expected over 0, up to %g", gap, SL_COORDINATE_MAX);
    snapper s = {.context = context, .map = map, .gap = gap};
    s.ends = sl_alloc_array(context, 2 * map->wall_count, sizeof *s.ends);
    if (!s.ends) return SL_NO_MEMORY;
    sl_status status = snap_to_ends(&s);
    if (status == SL_OK) status = snap_to_walls(&s);
    sl_free(context, s.ends);
    sl_free(context, s.moves.items);
    sl_free(context, s.splits.items);
    if (status != SL_OK) return status;
    s.account.vanished = drop_points(map);
    sl_map_drop_cells(context, map);
    if (account) *account = s.account;
    return SL_OK;
}

// --- until nothing moves

/// Cleaning makes a wall of each mirror. The map keeps the mirrors alone.
static void drop_mirror_walls(sl_map *map) {
    size_t kept = 0;
    for (size_t i = 0; i < map->wall_count; i++) {
        const sl_wall *wall = &map->walls[i];
        bool of_mirror = false;
        for (size_t k = 0; k < map->mirror_count && !of_mirror; k++) {
            const sl_glass *mirror = &map->mirrors[k];
            of_mirror = mirror->line == wall->line && touches_segment(mirror->segment, wall->a) &&
                        touches_segment(mirror->segment, wall->b);
        }
        if (!of_mirror) map->walls[kept++] = *wall;
    }
    map->wall_count = kept;
}

/// Where walls have moved, rock may have no width any more. Both of its sides are then one wall,
/// which the marks would have inside of rock: it would fall away. So no marks are kept.
static bool drop_ground(sl_map *map) {
    bool any = false;
    for (size_t i = 0; i < map->wall_count; i++) {
        any |= map->walls[i].ground != 0;
        map->walls[i].ground = 0;
    }
    map->ground_guessed = false;
    return any;
}

sl_status sl_map_mend(sl_context *context, sl_map *map, double gap, const sl_clean_options *clean,
                      sl_mend_account *account) {
    enum { ROUNDS = 32 };
    sl_mend_account all = {0}, round = {.moved = 1};
    for (int i = 0; i < ROUNDS && round.moved && map->wall_count; i++) {
        SL_TRY(sl_map_clean(context, map, clean, NULL));
        SL_TRY(sli_map_snap(context, map, gap, &round));
        all.moved += round.moved;
        all.vanished += round.vanished;
        all.farthest = fmax(all.farthest, round.farthest);
        if (round.moved) all.ground_dropped |= drop_ground(map);
    }
    drop_mirror_walls(map);
    if (account) *account = all;
    return SL_OK;
}

// --- what mending leaves

/// Where a fault is.
static sl_point place_of(const sl_fault *fault) {
    return (sl_point){fault->at.a.x / 2 + fault->at.b.x / 2, fault->at.a.y / 2 + fault->at.b.y / 2};
}

static int compare_by_place(const void *left, const void *right) {
    const sl_fault *const *a = left, *const *b = right;
    const int order = sli_compare_points(place_of(*a), place_of(*b));
    return order ? order : (*a > *b) - (*a < *b);
}

/// The nearest fault that is not marked yet, of those sorted by place; NULL for none. With
/// `same`, only one at the very place.
static sl_fault *nearest_unmarked(sl_fault **sorted, size_t count, sl_point at, bool same) {
    size_t low = 0, high = count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (place_of(sorted[middle]).x < at.x)
            low = middle + 1;
        else
            high = middle;
    }
    sl_fault *best = NULL;
    double least = same ? 0 : INFINITY;
    for (size_t i = low; i < count && place_of(sorted[i]).x - at.x <= least; i++) {
        const double distance = sli_apart(place_of(sorted[i]), at);
        if (sorted[i]->stays || distance > least || (best && distance == least)) continue;
        least = distance;
        best = sorted[i];
    }
    for (size_t i = low; i-- > 0 && at.x - place_of(sorted[i]).x <= least;) {
        const double distance = sli_apart(place_of(sorted[i]), at);
        if (sorted[i]->stays || distance >= least) continue;
        least = distance;
        best = sorted[i];
    }
    return best;
}

/// Lists the faults of a kind by place.
static size_t sort_kind(const sli_fault_search *search, sl_fault_kind kind, sl_fault **sorted) {
    size_t count = 0;
    for (size_t i = 0; i < search->faults.count; i++)
        if (search->faults.items[i].kind == kind) sorted[count++] = &search->faults.items[i];
    if (count) qsort(sorted, count, sizeof *sorted, compare_by_place);
    return count;
}

/// Marks as many gaps as mending leaves: those where one is left, then the nearest.
static void mark_gaps(sl_fault **sorted, size_t count, const sl_faults *left, bool *done) {
    for (int pass = 0; pass < 2 && count; pass++) {
        for (uint32_t i = 0; i < left->count; i++) {
            if (left->items[i].kind != SL_FAULT_GAP || done[i]) continue;
            sl_fault *gap = nearest_unmarked(sorted, count, place_of(&left->items[i]), pass == 0);
            if (!gap) continue;
            gap->stays = done[i] = true;
        }
    }
}

/// Marks the leaks near which one is left. Their number is not kept: where gaps are closed, other
/// openings may part a start from the outside.
static void mark_leaks(sl_fault **sorted, size_t count, const sl_faults *left, double reach) {
    for (uint32_t i = 0; i < left->count; i++) {
        const sl_point at = place_of(&left->items[i]);
        if (left->items[i].kind != SL_FAULT_LEAK) continue;
        size_t low = 0, high = count;
        while (low < high) {
            const size_t middle = low + (high - low) / 2;
            if (place_of(sorted[middle]).x < at.x - reach)
                low = middle + 1;
            else
                high = middle;
        }
        for (; low < count && place_of(sorted[low]).x <= at.x + reach; low++)
            sorted[low]->stays |= sli_apart(place_of(sorted[low]), at) <= reach;
    }
}

static sl_status mark_left(sli_fault_search *search, const sl_faults *left) {
    sl_fault **sorted = sl_alloc_array(search->context, search->faults.count, sizeof *sorted);
    bool *done = sl_alloc_array(search->context, left->count, sizeof *done);
    const bool room = sorted && done;
    if (room) {
        const size_t gaps = sort_kind(search, SL_FAULT_GAP, sorted);
        mark_gaps(sorted, gaps, left, done);
        const size_t leaks = sort_kind(search, SL_FAULT_LEAK, sorted);
        mark_leaks(sorted, leaks, left, 4 * search->options.gap);
    }
    sl_free(search->context, sorted);
    sl_free(search->context, done);
    return room ? SL_OK : SL_NO_MEMORY;
}

static void mark_all(sli_fault_search *search) {
    for (size_t i = 0; i < search->faults.count; i++) {
        sl_fault *fault = &search->faults.items[i];
        fault->stays = fault->kind == SL_FAULT_GAP || fault->kind == SL_FAULT_LEAK;
        search->leaks_left += fault->kind == SL_FAULT_LEAK;
    }
}

/// Mends a copy of the map, and finds what is left of gaps and leaks.
static sl_status mend_copy(sli_fault_search *search, sl_map *copy, sl_map *clean, sl_space *space,
                           sl_faults *left) {
    sl_context *context = search->context;
    const sl_clean_options *options = search->options.clean;
    SL_TRY(sl_map_copy(context, search->map, copy));
    SL_TRY(sl_map_mend(context, copy, search->options.gap, options, NULL));
    if (!copy->wall_count) return SL_UNSUPPORTED;
    SL_TRY(sl_map_copy(context, copy, clean));
    SL_TRY(sl_map_clean(context, clean, options, NULL));
    SL_TRY(sl_subdivision_for(clean)->subdivide(context, clean, NULL, space));
    return sli_find_faults(context, copy, space, &search->options, true, left);
}

sl_status sli_try_mending(sli_fault_search *search) {
    sl_context *context = search->context;
    sl_map copy = {0}, clean = {0};
    sl_space space = {0};
    sl_faults left = {0};
    sl_status status = mend_copy(search, &copy, &clean, &space, &left);
    if (status == SL_OK) status = mark_left(search, &left);
    search->leaks_left = left.counts[SL_FAULT_LEAK];
    if (status == SL_BAD_INPUT || status == SL_BAD_ARGUMENT || status == SL_UNSUPPORTED) {
        // A trial that cannot be done mends nothing.
        search->leaks_left = 0;
        mark_all(search);
        status = SL_OK;
    }
    sl_map_destroy(context, &copy);
    sl_map_destroy(context, &clean);
    sl_space_destroy(context, &space);
    sl_faults_destroy(context, &left);
    return status;
}

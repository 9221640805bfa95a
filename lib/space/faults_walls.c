/// Faults between walls (gaps, overlaps, crossings), and closing gaps. A grid over the walls gives
/// the pairs that are near each other; exact signs decide whether two walls touch, cross or
/// overlap.
///
///     gap                    closed              snapped: ends to ends      ends to walls
///
///     -----.  |              -----.  |           ---. .---                  ---.  |
///             |                    \_|                   ->                        |   ->
///             |                      |           ----o----                  ------o
///                                                                                 |
///
/// A gap is an end near another wall, with no wall that joins the two and none between them.
/// Snapping moves the ends near an often used place onto that place, and then free ends onto a near
/// wall. Axial walls stay axial where they can. What snapping does not close is found by trying it.
/// Time about O(n log n) for walls that are short
/// against the map.
#include "space/faults.h"

#include "geometry/orient.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// The point of a wall that is nearest to another point: an end, or rounded.
static sl_point nearest_on_wall(const sl_wall *wall, sl_point point) {
    const sl_point along = {wall->b.x - wall->a.x, wall->b.y - wall->a.y};
    const double length = hypot(along.x, along.y);
    if (!(length > 0)) return wall->a;
    const sl_point unit = {along.x / length, along.y / length};
    const double at = (point.x - wall->a.x) * unit.x + (point.y - wall->a.y) * unit.y;
    if (at <= 0) return wall->a;
    if (at >= length) return wall->b;
    // An axial wall keeps its coordinate.
    return (sl_point){wall->a.x + at * unit.x, wall->a.y + at * unit.y};
}

/// Exact.
static bool touches_wall(const sl_wall *wall, sl_point p) {
    if (sli_orient(wall->a, wall->b, p) != 0) return false;
    return p.x >= fmin(wall->a.x, wall->b.x) && p.x <= fmax(wall->a.x, wall->b.x) &&
           p.y >= fmin(wall->a.y, wall->b.y) && p.y <= fmax(wall->a.y, wall->b.y);
}

static bool crosses(const sl_wall *wall, sl_point a, sl_point b) {
    return sli_orient(wall->a, wall->b, a) * sli_orient(wall->a, wall->b, b) < 0 &&
           sli_orient(a, b, wall->a) * sli_orient(a, b, wall->b) < 0;
}

/// Whether an end touches a wall, or is so near that cleaning welds it to the wall.
static bool joins_wall(const sl_wall *wall, sl_point p, double weld) {
    if (touches_wall(wall, p)) return true;
    return weld > 0 && (sli_apart(wall->a, p) <= weld || sli_apart(wall->b, p) <= weld ||
                        sli_apart(nearest_on_wall(wall, p), p) < weld / 2);
}

/// Whether two walls join at an end of one of them.
static bool walls_join(const sl_wall *a, const sl_wall *b, double weld) {
    return joins_wall(a, b->a, weld) || joins_wall(a, b->b, weld) || joins_wall(b, a->a, weld) ||
           joins_wall(b, a->b, weld);
}

// --- gaps

/// Whether two walls meet at an end of one of them, within `reach` of a point.
static bool meet_near(const sl_wall *a, const sl_wall *b, sl_point point, double reach,
                      double weld) {
    return (sli_apart(b->a, point) <= reach && joins_wall(a, b->a, weld)) ||
           (sli_apart(b->b, point) <= reach && joins_wall(a, b->b, weld)) ||
           (sli_apart(a->a, point) <= reach && joins_wall(b, a->a, weld)) ||
           (sli_apart(a->b, point) <= reach && joins_wall(b, a->b, weld));
}

/// Whether a wall closes the gap from a wall's end to another wall: it joins the two, or passes
/// between them.
static bool is_closed(const sli_fault_search *search, const uint32_t *near, uint32_t count,
                      sl_point end, const sl_wall *other, sl_point to) {
    const sl_map *map = search->map;
    const double weld = search->weld, reach = 2 * sli_apart(end, to) + weld;
    for (uint32_t i = 0; i < count; i++) {
        const sl_wall *wall = &map->walls[near[i]];
        if (wall == other) continue;
        if (crosses(wall, end, to)) return true;
        if (joins_wall(wall, end, weld) && meet_near(wall, other, end, reach, weld)) return true;
    }
    return false;
}

/// Whether an earlier wall has the same end, and so reports its gap.
static bool is_reported(const sl_map *map, const uint32_t *near, uint32_t count, uint32_t wall,
                        sl_point end) {
    for (uint32_t i = 0; i < count; i++)
        if (near[i] < wall && (sli_same_point(map->walls[near[i]].a, end) ||
                               sli_same_point(map->walls[near[i]].b, end)))
            return true;
    return false;
}

/// A gap between two ends is found from both. Whether the other end reports it.
static bool is_reported_there(const sl_wall *other, sl_point end, sl_point to) {
    if (!sli_same_point(to, other->a) && !sli_same_point(to, other->b)) return false;
    return to.x != end.x ? to.x < end.x : to.y < end.y;
}

static sl_status find_gap(sli_fault_search *search, const sli_wall_grid *grid, uint32_t wall,
                          sl_point end) {
    uint32_t count;
    const uint32_t *near = sli_wall_grid_at(grid, end, &count);
    const sl_map *map = search->map;
    if (is_reported(map, near, count, wall, end)) return SL_OK;
    sl_fault gap = {.kind = SL_FAULT_GAP, .size = INFINITY, .cell = SL_NO_CELL};
    for (uint32_t i = 0; i < count; i++) {
        const sl_wall *other = &map->walls[near[i]];
        if (near[i] == wall || joins_wall(other, end, search->weld)) continue;
        const sl_point to = nearest_on_wall(other, end);
        const double width = sli_apart(end, to);
        if (!(width <= search->options.gap) || width >= gap.size) continue;
        if (is_closed(search, near, count, end, other, to)) continue;
        gap.size = width;
        gap.at = (sl_segment){end, to};
        gap.walls[0] = wall;
        gap.walls[1] = near[i];
    }
    if (gap.size == INFINITY || is_reported_there(&map->walls[gap.walls[1]], end, gap.at.b))
        return SL_OK;
    return sli_add_fault(search, gap);
}

// --- pairs

/// The piece that two walls in one line share; false if it has no length.
static bool shared_piece(const sl_wall *a, const sl_wall *b, sl_segment *out) {
    const bool by_x = fabs(a->b.x - a->a.x) >= fabs(a->b.y - a->a.y);
    sl_point ends[4] = {a->a, a->b, b->a, b->b};
#define AT(p) (by_x ? (p).x : (p).y)
    for (int i = 0; i < 4; i += 2) {
        if (AT(ends[i]) <= AT(ends[i + 1])) continue;
        const sl_point swapped = ends[i];
        ends[i] = ends[i + 1];
        ends[i + 1] = swapped;
    }
    out->a = AT(ends[0]) >= AT(ends[2]) ? ends[0] : ends[2];
    out->b = AT(ends[1]) <= AT(ends[3]) ? ends[1] : ends[3];
    return AT(out->a) < AT(out->b);
#undef AT
}

static sl_point crossing_point(const sl_wall *a, const sl_wall *b) {
    const sl_point u = {a->b.x - a->a.x, a->b.y - a->a.y}, v = {b->b.x - b->a.x, b->b.y - b->a.y};
    const double at = ((b->a.x - a->a.x) * v.y - (b->a.y - a->a.y) * v.x) / (u.x * v.y - u.y * v.x);
    return (sl_point){a->a.x + at * u.x, a->a.y + at * u.y};
}

static sl_status compare_walls(sli_fault_search *search, uint32_t i, uint32_t j) {
    const sl_wall *a = &search->map->walls[i], *b = &search->map->walls[j];
    sl_fault fault = {.walls = {i, j}, .cell = SL_NO_CELL};
    if (crosses(a, b->a, b->b)) {
        if (search->weld > 0 && walls_join(a, b, search->weld)) return SL_OK;
        fault.kind = SL_FAULT_CROSSING;
        fault.at.a = fault.at.b = crossing_point(a, b);
        return sli_add_fault(search, fault);
    }
    const bool in_line = !sli_same_point(a->a, a->b) && !sli_same_point(b->a, b->b) &&
                         sli_orient(a->a, a->b, b->a) == 0 && sli_orient(a->a, a->b, b->b) == 0;
    if (!in_line || !shared_piece(a, b, &fault.at)) return SL_OK;
    fault.kind = SL_FAULT_OVERLAP;
    fault.size = sli_apart(fault.at.a, fault.at.b);
    return sli_add_fault(search, fault);
}

static sl_status compare_in_square(sli_fault_search *search, const uint32_t *walls,
                                   uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t j = i + 1; j < count; j++) SL_TRY(compare_walls(search, walls[i], walls[j]));
    return SL_OK;
}

static sl_status find_gaps(sli_fault_search *search, const sli_wall_grid *grid) {
    for (uint32_t i = 0; i < search->map->wall_count; i++) {
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(search->context));
        SL_TRY(find_gap(search, grid, i, search->map->walls[i].a));
        SL_TRY(find_gap(search, grid, i, search->map->walls[i].b));
        // A trial has no space, and is not reported.
        if (search->space)
            sl_report(search->context, "check", "walls", i + 1, search->map->wall_count);
    }
    return SL_OK;
}

static sl_status search_grid(sli_fault_search *search, const sli_wall_grid *grid) {
    const size_t squares = (size_t)grid->columns * grid->rows;
    for (size_t i = 0; i < squares; i++) {
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(search->context));
        SL_TRY(compare_in_square(search, grid->walls + grid->offsets[i],
                                 grid->offsets[i + 1] - grid->offsets[i]));
    }
    return find_gaps(search, grid);
}

// --- closing gaps

/// An end of a wall.
typedef struct wall_end {
    sl_point at;
    uint32_t wall;
    uint32_t users; ///< the number of walls with an end at this place
    bool second;
} wall_end;

typedef struct snapper {
    sl_context *context;
    sl_map *map;
    double gap;
    wall_end *ends; ///< sorted by place
    size_t count;
    sl_snap_account account;
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

static void move_end(snapper *s, sl_point *end, sl_point to) {
    const double way = sli_apart(*end, to);
    if (sli_same_point(*end, to)) return;
    s->account.moved++;
    s->account.farthest = fmax(s->account.farthest, way);
    *end = to;
}

// --- ends to ends

/// Moves ends onto a near place that is used at least as often. Each end moves once. `settled` has
/// two bits by wall: its ends that have their place.
static sl_status join_ends(snapper *s, const sli_wall_grid *grid, uint8_t *settled) {
    const sl_wall *before = s->map->walls;
    for (size_t i = 0; i < s->count; i++) {
        const wall_end *keep = &s->ends[i];
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(s->context));
        if (settled[keep->wall] >> keep->second & 1) continue;
        uint32_t count;
        const uint32_t *near = sli_wall_grid_at(grid, keep->at, &count);
        for (uint32_t k = 0; k < count; k++) {
            for (int second = 0; second < 2; second++) {
                const sl_wall *wall = &before[near[k]];
                const sl_point at = second ? wall->b : wall->a;
                if (settled[near[k]] >> second & 1 || sli_apart(at, keep->at) > s->gap) continue;
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

/// The place where an end of one wall meets another wall.
static sl_point meeting(const sl_wall *own, sl_point end, const sl_wall *other) {
    if (is_upright(own) && is_level(other)) return (sl_point){end.x, other->a.y};
    if (is_level(own) && is_upright(other)) return (sl_point){other->a.x, end.y};
    sl_point to = nearest_on_wall(other, end);
    if (is_upright(other)) to.x = other->a.x;
    if (is_level(other)) to.y = other->a.y;
    return to;
}

static void put_on_wall(snapper *s, const sli_wall_grid *grid, const wall_end *end) {
    sl_point *at = end_of(s, end);
    const sl_wall *own = &s->map->walls[end->wall];
    uint32_t count;
    const uint32_t *near = sli_wall_grid_at(grid, *at, &count);
    sl_point best = *at;
    double least = INFINITY;
    for (uint32_t k = 0; k < count; k++) {
        const sl_wall *other = &s->map->walls[near[k]];
        if (near[k] == end->wall || sli_same_point(other->a, other->b)) continue;
        if (touches_wall(other, *at)) return;
        const sl_point to = meeting(own, *at, other);
        const double way = sli_apart(*at, to);
        const bool there = sli_apart(to, nearest_on_wall(other, to)) <= s->gap;
        if (way > s->gap || way >= least || !there) continue;
        least = way;
        best = to;
    }
    move_end(s, at, best);
}

// --- both

/// Drops walls of no length, and counts them. `numbers` (NULL for none) gets the old number of each
/// wall that is kept.
static size_t drop_points(sl_wall *walls, size_t *count, uint32_t *numbers) {
    size_t kept = 0;
    for (size_t i = 0; i < *count; i++) {
        if (sli_same_point(walls[i].a, walls[i].b)) continue;
        if (numbers) numbers[kept] = (uint32_t)i;
        walls[kept++] = walls[i];
    }
    const size_t dropped = *count - kept;
    *count = kept;
    return dropped;
}

static sl_status snap_to_ends(snapper *s) {
    sli_wall_grid grid;
    uint8_t *settled = sl_alloc_array(s->context, s->map->wall_count, sizeof *settled);
    if (!settled) return SL_NO_MEMORY;
    sl_status status = sli_wall_grid_create(s->context, s->map, s->gap, &grid);
    if (status == SL_OK) {
        list_ends(s);
        qsort(s->ends, s->count, sizeof *s->ends, compare_use);
        status = join_ends(s, &grid, settled);
        sli_wall_grid_destroy(s->context, &grid);
    }
    sl_free(s->context, settled);
    return status;
}

/// The grid finds walls within twice the gap, as each may move by a gap while the grid is in use.
static sl_status snap_to_walls(snapper *s) {
    sli_wall_grid grid;
    SL_TRY(sli_wall_grid_create(s->context, s->map, 2 * s->gap, &grid));
    list_ends(s);
    qsort(s->ends, s->count, sizeof *s->ends, compare_use);
    for (size_t i = 0; i < s->count; i++)
        if (s->ends[i].users == 1) put_on_wall(s, &grid, &s->ends[i]);
    sli_wall_grid_destroy(s->context, &grid);
    return SL_OK;
}

/// Moves the ends of a map's walls. Walls that lose their length stay.
static sl_status snap_walls(sl_context *context, sl_map *map, double gap,
                            sl_snap_account *account) {
    snapper s = {.context = context, .map = map, .gap = gap};
    s.ends = sl_alloc_array(context, 2 * map->wall_count, sizeof *s.ends);
    if (!s.ends) return SL_NO_MEMORY;
    sl_status status = snap_to_ends(&s);
    if (status == SL_OK) status = snap_to_walls(&s);
    sl_free(context, s.ends);
    *account = s.account;
    return status;
}

sl_status sl_map_snap(sl_context *context, sl_map *map, double gap, sl_snap_account *account) {
    sl_snap_account own = {0};
    if (!(gap > 0 && sl_coordinate_usable(gap)))
        return sl_fail(context, SL_BAD_ARGUMENT, "the gap to close must be a positive number");
    SL_TRY(snap_walls(context, map, gap, &own));
    own.vanished = drop_points(map->walls, &map->wall_count, NULL);
    sl_map_drop_cells(context, map);
    if (account) *account = own;
    return SL_OK;
}

// --- gaps that snapping does not close

/// A list of gaps for each wall: those that a trial of snapping leaves.
typedef struct left_gaps {
    uint32_t *first; ///< by wall: its last gap's entry; UINT32_MAX for none
    uint32_t *next;  ///< two entries by gap, one for each of its walls
    const sl_fault *gaps;
    uint32_t count;
} left_gaps;

/// Whether a gap is left at a wall, near a place.
static bool is_left(const left_gaps *left, uint32_t wall, sl_point at, double reach) {
    for (uint32_t i = left->first[wall]; i != UINT32_MAX; i = left->next[i])
        if (sli_apart(left->gaps[i / 2].at.a, at) <= reach ||
            sli_apart(left->gaps[i / 2].at.b, at) <= reach)
            return true;
    return false;
}

static void list_left(left_gaps *left, const uint32_t *numbers, size_t wall_count) {
    for (size_t i = 0; i < wall_count; i++) left->first[i] = UINT32_MAX;
    for (uint32_t i = 0; i < 2 * left->count; i++) {
        const uint32_t wall = numbers[left->gaps[i / 2].walls[i % 2]];
        left->next[i] = left->first[wall];
        left->first[wall] = i;
    }
}

/// Finds the gaps of the snapped map, and marks those of the search that are still there. An end
/// has moved by twice the gap at most.
static sl_status mark_stays(sli_fault_search *search, const sl_map *snapped,
                            const uint32_t *numbers) {
    sl_context *context = search->context;
    sli_fault_search after = {
        .context = context, .map = snapped, .options = search->options, .weld = search->weld};
    sli_wall_grid grid = {0};
    left_gaps left = {.first = sl_alloc_array(context, search->map->wall_count, sizeof(uint32_t))};
    sl_status status = left.first ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK)
        status = sli_wall_grid_create(context, snapped, search->options.gap, &grid);
    if (status == SL_OK) status = find_gaps(&after, &grid);
    left.gaps = after.faults.items;
    left.count = (uint32_t)after.faults.count;
    if (status == SL_OK) {
        left.next = sl_alloc_array(context, 2 * (size_t)left.count, sizeof *left.next);
        if (!left.next) status = SL_NO_MEMORY;
    }
    if (status == SL_OK) list_left(&left, numbers, search->map->wall_count);
    for (size_t i = 0; i < search->faults.count && status == SL_OK; i++) {
        sl_fault *gap = &search->faults.items[i];
        if (gap->kind != SL_FAULT_GAP) continue;
        for (int k = 0; k < 2; k++)
            gap->stays |= is_left(&left, gap->walls[k], gap->at.a, 2 * search->options.gap);
    }
    sli_wall_grid_destroy(context, &grid);
    sl_free(context, left.first);
    sl_free(context, left.next);
    sl_free(context, after.faults.items);
    return status;
}

/// Snaps a copy of the walls.
static sl_status try_snapping(sli_fault_search *search) {
    sl_context *context = search->context;
    const size_t count = search->map->wall_count;
    sl_map copy = {.wall_count = count};
    sl_snap_account account;
    copy.walls = sl_alloc_array(context, count, sizeof *copy.walls);
    uint32_t *numbers = sl_alloc_array(context, count, sizeof *numbers);
    sl_status status = copy.walls && numbers ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; i < count && status == SL_OK; i++) copy.walls[i] = search->map->walls[i];
    if (status == SL_OK) status = snap_walls(context, &copy, search->options.gap, &account);
    if (status == SL_OK) {
        drop_points(copy.walls, &copy.wall_count, numbers);
        if (copy.wall_count) status = mark_stays(search, &copy, numbers);
    }
    for (size_t i = 0; i < search->faults.count && !copy.wall_count; i++)
        search->faults.items[i].stays = search->faults.items[i].kind == SL_FAULT_GAP;
    sl_free(context, copy.walls);
    sl_free(context, numbers);
    return status;
}

// --- all of it

sl_status sli_find_wall_faults(sli_fault_search *search) {
    sli_wall_grid grid;
    SL_TRY(sli_wall_grid_create(search->context, search->map, search->options.gap, &grid));
    const sl_status status = search_grid(search, &grid);
    sli_wall_grid_destroy(search->context, &grid);
    SL_TRY(status);
    for (size_t i = 0; i < search->faults.count; i++)
        if (search->faults.items[i].kind == SL_FAULT_GAP) return try_snapping(search);
    return SL_OK;
}

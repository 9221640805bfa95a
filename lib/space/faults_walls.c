/// Faults between walls: gaps, overlaps, crossings.
#include "geometry/orient.h"
#include "space/faults.h"

#include <math.h>

sl_point sl_nearest_on_wall(const sl_wall *wall, sl_point point) {
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

bool sl_touches_wall(const sl_wall *wall, sl_point p) {
    if (sl_orient(wall->a, wall->b, p) != 0) return false;
    return p.x >= fmin(wall->a.x, wall->b.x) && p.x <= fmax(wall->a.x, wall->b.x) &&
           p.y >= fmin(wall->a.y, wall->b.y) && p.y <= fmax(wall->a.y, wall->b.y);
}

static bool crosses(const sl_wall *wall, sl_point a, sl_point b) {
    return sl_orient(wall->a, wall->b, a) * sl_orient(wall->a, wall->b, b) < 0 &&
           sl_orient(a, b, wall->a) * sl_orient(a, b, wall->b) < 0;
}

// --- gaps

/// Whether two walls meet, by an end of one of them, nearer to a point than `reach`.
static bool meet_near(const sl_wall *a, const sl_wall *b, sl_point point, double reach) {
    return (sl_touches_wall(a, b->a) && sl_apart(b->a, point) <= reach) ||
           (sl_touches_wall(a, b->b) && sl_apart(b->b, point) <= reach) ||
           (sl_touches_wall(b, a->a) && sl_apart(a->a, point) <= reach) ||
           (sl_touches_wall(b, a->b) && sl_apart(a->b, point) <= reach);
}

/// Whether the gap from a wall's end to another wall is closed: by a wall that joins the two, or by
/// one that passes between.
static bool is_closed(const sl_map *map, const uint32_t *near, uint32_t count, sl_point end,
                      const sl_wall *other, sl_point to) {
    const double reach = 2 * sl_apart(end, to);
    for (uint32_t i = 0; i < count; i++) {
        const sl_wall *wall = &map->walls[near[i]];
        if (wall == other) continue;
        if (crosses(wall, end, to)) return true;
        if (sl_touches_wall(wall, end) && meet_near(wall, other, end, reach)) return true;
    }
    return false;
}

/// The end is told of once: by the first of the walls that have it.
static bool is_told_before(const sl_map *map, const uint32_t *near, uint32_t count, uint32_t wall,
                           sl_point end) {
    for (uint32_t i = 0; i < count; i++)
        if (near[i] < wall && (sl_same_point(map->walls[near[i]].a, end) ||
                               sl_same_point(map->walls[near[i]].b, end)))
            return true;
    return false;
}

/// The gap between two ends is found from both of them.
static bool is_told_from_there(const sl_wall *other, sl_point end, sl_point to) {
    if (!sl_same_point(to, other->a) && !sl_same_point(to, other->b)) return false;
    return to.x != end.x ? to.x < end.x : to.y < end.y;
}

static sl_status find_gap(sl_fault_search *search, const sl_wall_grid *grid, uint32_t wall,
                          sl_point end) {
    uint32_t count;
    const uint32_t *near = sl_wall_grid_at(grid, end, &count);
    const sl_map *map = search->map;
    if (is_told_before(map, near, count, wall, end)) return SL_OK;
    sl_fault gap = {.kind = SL_FAULT_GAP, .size = INFINITY, .cell = SL_NO_CELL};
    for (uint32_t i = 0; i < count; i++) {
        const sl_wall *other = &map->walls[near[i]];
        if (near[i] == wall || sl_touches_wall(other, end)) continue;
        const sl_point to = sl_nearest_on_wall(other, end);
        const double width = sl_apart(end, to);
        if (!(width <= search->options.gap) || width >= gap.size) continue;
        if (is_closed(map, near, count, end, other, to)) continue;
        gap.size = width;
        gap.at = (sl_segment){end, to};
        gap.walls[0] = wall;
        gap.walls[1] = near[i];
    }
    if (gap.size == INFINITY || is_told_from_there(&map->walls[gap.walls[1]], end, gap.at.b))
        return SL_OK;
    return sl_add_fault(search, gap);
}

// --- pairs

/// The piece that two walls on one line share; false where it has no length.
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

static sl_status compare_walls(sl_fault_search *search, uint32_t i, uint32_t j) {
    const sl_wall *a = &search->map->walls[i], *b = &search->map->walls[j];
    sl_fault fault = {.walls = {i, j}, .cell = SL_NO_CELL};
    if (crosses(a, b->a, b->b)) {
        fault.kind = SL_FAULT_CROSSING;
        fault.at.a = fault.at.b = crossing_point(a, b);
        return sl_add_fault(search, fault);
    }
    const bool in_line = !sl_same_point(a->a, a->b) && !sl_same_point(b->a, b->b) &&
                         sl_orient(a->a, a->b, b->a) == 0 && sl_orient(a->a, a->b, b->b) == 0;
    if (!in_line || !shared_piece(a, b, &fault.at)) return SL_OK;
    fault.kind = SL_FAULT_OVERLAP;
    fault.size = sl_apart(fault.at.a, fault.at.b);
    return sl_add_fault(search, fault);
}

static sl_status compare_in_square(sl_fault_search *search, const uint32_t *walls, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t j = i + 1; j < count; j++) SL_TRY(compare_walls(search, walls[i], walls[j]));
    return SL_OK;
}

static sl_status search_grid(sl_fault_search *search, const sl_wall_grid *grid) {
    const size_t squares = (size_t)grid->columns * grid->rows;
    for (size_t i = 0; i < squares; i++) {
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(search->context));
        SL_TRY(compare_in_square(search, grid->walls + grid->offsets[i],
                                 grid->offsets[i + 1] - grid->offsets[i]));
    }
    for (uint32_t i = 0; i < search->map->wall_count; i++) {
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(search->context));
        SL_TRY(find_gap(search, grid, i, search->map->walls[i].a));
        SL_TRY(find_gap(search, grid, i, search->map->walls[i].b));
        sl_report(search->context, "check", "walls", i + 1, search->map->wall_count);
    }
    return SL_OK;
}

sl_status sl_find_wall_faults(sl_fault_search *search) {
    sl_wall_grid grid;
    SL_TRY(sl_wall_grid_create(search->context, search->map, search->options.gap, &grid));
    const sl_status status = search_grid(search, &grid);
    sl_wall_grid_destroy(search->context, &grid);
    return status;
}

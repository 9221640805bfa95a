/// Faults between walls: gaps, overlaps and crossings. A grid over the walls gives the pairs that
/// are near each other; exact signs decide whether two walls touch, cross or overlap.
///
///     gap                    closed by a wall that joins the two
///
///     -----.  |              -----.  |
///             |                    \_|
///             |                      |
///
/// Gaps are those of the clean map, which is the map as it is used: cleaning closes what the
/// digits of a drawing leave open. A gap is an end near another wall, with no wall that joins the
/// two and none between them. Overlaps and crossings are those of the map as read, as cleaning
/// leaves none; but not where the two walls are welded. Time about O(n log n) for walls that are
/// short against the map.
#include "geometry/length.h"
#include "space/faults.h"

#include "geometry/orient.h"
#include "map/planar.h"

#include <math.h>
#include <stdlib.h>

sl_point sli_nearest_on_wall(const sl_wall *wall, sl_point point) {
    const sl_point along = {wall->b.x - wall->a.x, wall->b.y - wall->a.y};
    const double length = sli_length(along.x, along.y);
    if (!(length > 0)) return wall->a;
    const sl_point unit = {along.x / length, along.y / length};
    const double at = (point.x - wall->a.x) * unit.x + (point.y - wall->a.y) * unit.y;
    if (at <= 0) return wall->a;
    if (at >= length) return wall->b;
    // An axial wall keeps its coordinate.
    return (sl_point){wall->a.x + at * unit.x, wall->a.y + at * unit.y};
}

bool sli_touches_wall(const sl_wall *wall, sl_point p) {
    if (sli_orient(wall->a, wall->b, p) != 0) return false;
    return p.x >= fmin(wall->a.x, wall->b.x) && p.x <= fmax(wall->a.x, wall->b.x) &&
           p.y >= fmin(wall->a.y, wall->b.y) && p.y <= fmax(wall->a.y, wall->b.y);
}

static bool crosses(const sl_wall *wall, sl_point a, sl_point b) {
    return sli_orient(wall->a, wall->b, a) * sli_orient(wall->a, wall->b, b) < 0 &&
           sli_orient(a, b, wall->a) * sli_orient(a, b, wall->b) < 0;
}

// --- gaps, in the clean map: there walls touch in common ends alone, by the same bits

/// Whether two walls meet at an end of one of them, within `reach` of a point.
static bool meet_near(const sl_wall *a, const sl_wall *b, sl_point point, double reach) {
    return (sli_apart(b->a, point) <= reach && sli_touches_wall(a, b->a)) ||
           (sli_apart(b->b, point) <= reach && sli_touches_wall(a, b->b)) ||
           (sli_apart(a->a, point) <= reach && sli_touches_wall(b, a->a)) ||
           (sli_apart(a->b, point) <= reach && sli_touches_wall(b, a->b));
}

/// Whether a wall closes the gap from a wall's end to another wall: it joins the two, or passes
/// between them.
static bool is_closed(const sl_map *map, const uint32_t *near, uint32_t count, sl_point end,
                      const sl_wall *other, sl_point to) {
    const double reach = 2 * sli_apart(end, to);
    for (uint32_t i = 0; i < count; i++) {
        const sl_wall *wall = &map->walls[near[i]];
        if (wall == other) continue;
        if (crosses(wall, end, to)) return true;
        if (sli_touches_wall(wall, end) && meet_near(wall, other, end, reach)) return true;
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

static sl_status find_gap(sl_context *context, const sl_map *map, const sli_wall_grid *grid,
                          double most, uint32_t wall, sl_point end, sli_fault_list *out) {
    uint32_t count;
    const uint32_t *near = sli_wall_grid_at(grid, end, &count);
    if (is_reported(map, near, count, wall, end)) return SL_OK;
    sl_fault gap = {.kind = SL_FAULT_GAP, .size = INFINITY, .cell = SL_NO_CELL};
    for (uint32_t i = 0; i < count; i++) {
        const sl_wall *other = &map->walls[near[i]];
        if (near[i] == wall || sli_touches_wall(other, end)) continue;
        const sl_point to = sli_nearest_on_wall(other, end);
        const double width = sli_apart(end, to);
        if (!(width <= most) || width >= gap.size) continue;
        if (is_closed(map, near, count, end, other, to)) continue;
        gap.size = width;
        gap.at = (sl_segment){end, to};
        gap.walls[0] = wall;
        gap.walls[1] = near[i];
    }
    if (gap.size == INFINITY || is_reported_there(&map->walls[gap.walls[1]], end, gap.at.b))
        return SL_OK;
    return sli_add_to_list(context, out, gap);
}

/// The gaps between a map's walls, up to a width. The faults' walls are those of this map.
static sl_status list_gaps(sl_context *context, const sl_map *map, double most, bool reports,
                           sli_fault_list *out) {
    sli_wall_grid grid;
    SL_TRY(sl_check_cancelled(context));
    sl_status status = sli_wall_grid_create(context, map, most, &grid);
    SL_TRY(status);
    for (uint32_t i = 0; i < map->wall_count && status == SL_OK; i++) {
        if (i % 1024 == 0) status = sl_check_cancelled(context);
        for (int second = 0; second < 2 && status == SL_OK; second++)
            status = find_gap(context, map, &grid, most, i,
                              second ? map->walls[i].b : map->walls[i].a, out);
        if (reports) sl_report(context, "check", "walls", i + 1, map->wall_count);
    }
    sli_wall_grid_destroy(context, &grid);
    return status;
}

static sl_status find_gaps(sli_fault_search *search) {
    const size_t first = search->faults.count;
    SL_TRY(list_gaps(search->context, &search->clean, search->options.gap, !search->trial,
                     &search->faults));
    for (size_t i = first; i < search->faults.count; i++) {
        sl_fault *gap = &search->faults.items[i];
        const sl_wall *walls = search->clean.walls;
        const uint32_t own = sli_wall_as_read(search, gap->at.a, walls[gap->walls[0]].line);
        gap->walls[1] = sli_wall_as_read(search, gap->at.b, walls[gap->walls[1]].line);
        gap->walls[0] = own;
    }
    return SL_OK;
}

/// Counts the gaps of the map as read that cleaning closes by its tolerance. The rounding of
/// doubles closes none that anyone drew.
static sl_status count_welded(sli_fault_search *search) {
    const sl_box box = sl_map_bounds(search->map);
    if (!(search->weld > 2 * sli_planar_tolerance(&box))) return SL_OK;
    sli_fault_list gaps = {0};
    const sl_status status = list_gaps(search->context, search->map, search->weld, false, &gaps);
    for (size_t i = 0; i < gaps.count; i++) {
        const sl_fault *gap = &gaps.items[i];
        const sl_wall *other = &search->map->walls[gap->walls[1]];
        const bool to_end =
            sli_same_point(gap->at.b, other->a) || sli_same_point(gap->at.b, other->b);
        // An end that goes too far is no gap: its wall crosses the other one.
        if (crosses(&search->map->walls[gap->walls[0]], other->a, other->b)) continue;
        search->welded += to_end || gap->size < search->weld / 2;
    }
    sl_free(search->context, gaps.items);
    return status;
}

// --- walls as read

uint32_t sli_wall_as_read(const sli_fault_search *search, sl_point p, uint32_t line) {
    uint32_t count, best = UINT32_MAX;
    const uint32_t *near = sli_wall_grid_at(&search->grid, p, &count);
    double least = search->options.gap / 1024 + search->moved;
    bool same_line = false;
    for (uint32_t i = 0; i < count; i++) {
        const sl_wall *wall = &search->map->walls[near[i]];
        const double distance = sli_apart(p, sli_nearest_on_wall(wall, p));
        const bool same = line && wall->line == line;
        if (!(distance <= search->options.gap / 1024 + search->moved)) continue;
        if (best != UINT32_MAX && (same_line && !same)) continue;
        if (best != UINT32_MAX && same_line == same &&
            (distance > least || (distance == least && near[i] > best)))
            continue;
        least = distance;
        best = near[i];
        same_line = same;
    }
    return best;
}

// --- pairs

/// Whether an end touches a wall, or is so near that cleaning welds it to the wall.
static bool joins_wall(const sl_wall *wall, sl_point p, double weld) {
    if (sli_touches_wall(wall, p)) return true;
    return weld > 0 && (sli_apart(wall->a, p) <= weld || sli_apart(wall->b, p) <= weld ||
                        sli_apart(sli_nearest_on_wall(wall, p), p) < weld / 2);
}

/// Whether two walls join at an end of one of them.
static bool walls_join(const sl_wall *a, const sl_wall *b, double weld) {
    return joins_wall(a, b->a, weld) || joins_wall(a, b->b, weld) || joins_wall(b, a->a, weld) ||
           joins_wall(b, a->b, weld);
}

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

static sl_status compare_all(sli_fault_search *search) {
    const sli_wall_grid *grid = &search->grid;
    const size_t squares = (size_t)grid->columns * grid->rows;
    for (size_t i = 0; i < squares; i++) {
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(search->context));
        SL_TRY(compare_in_square(search, grid->walls + grid->offsets[i],
                                 grid->offsets[i + 1] - grid->offsets[i]));
    }
    return SL_OK;
}

sl_status sli_find_wall_faults(sli_fault_search *search) {
    if (!search->trial) {
        SL_TRY(compare_all(search));
        SL_TRY(count_welded(search));
    }
    return find_gaps(search);
}

// --- a welding tolerance for a map whose walls miss each other by rounding
//
// The gaps of such a map come in two sizes: those of rounding, and those that are meant, such as
// a slit or a door. Sorted by width there is a step between them:
//
//     width   ........  ::::::                      |    |   |     |
//             rounding          ^ the tolerance     slits, the shortest wall
//
// The widest step (as a ratio) is looked for. The tolerance lies above it, with room for walls
// that overshoot or are rounded more than those that were found. Then the map is cleaned with it
// for trial: it is suggested only if it leaves no gap up to that width. Time: that of two
// searches.

enum {
    LEAST_STEP = 8, ///< between rounding and what is meant, as a ratio
    ROOM = 4,       ///< between the widest gap of rounding and the tolerance
};

static int compare_widths(const void *left, const void *right) {
    const double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

/// The widths of a map's gaps up to `widest`, and its walls' lengths that are above 0; sorted.
typedef struct widths {
    SL_ARRAY(double) gaps;
    SL_ARRAY(double) walls;
} widths;

static sl_status find_widths(sl_context *context, const sl_map *map, double widest, widths *out) {
    sli_fault_list gaps = {0};
    out->gaps.count = 0;
    sl_status status = list_gaps(context, map, widest, false, &gaps);
    if (status == SL_OK) status = SL_ARRAY_ROOM(context, &out->gaps, gaps.count);
    for (size_t i = 0; i < gaps.count && status == SL_OK; i++)
        if (gaps.items[i].size > 0) out->gaps.items[out->gaps.count++] = gaps.items[i].size;
    sl_free(context, gaps.items);
    if (out->gaps.count) qsort(out->gaps.items, out->gaps.count, sizeof(double), compare_widths);
    return status;
}

static sl_status find_lengths(sl_context *context, const sl_map *map, widths *out) {
    for (size_t i = 0; i < map->wall_count; i++) {
        const double length = sli_apart(map->walls[i].a, map->walls[i].b);
        if (!(length > 0)) continue;
        SL_TRY(SL_ARRAY_ROOM(context, &out->walls, 1));
        out->walls.items[out->walls.count++] = length;
    }
    if (out->walls.count) qsort(out->walls.items, out->walls.count, sizeof(double), compare_widths);
    return SL_OK;
}

/// The shortest wall that is longer than `width`; HUGE_VAL for none.
static double wall_above(const widths *w, double width) {
    size_t low = 0, high = w->walls.count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (w->walls.items[middle] > width)
            high = middle;
        else
            low = middle + 1;
    }
    return low < w->walls.count ? w->walls.items[low] : HUGE_VAL;
}

/// The tolerance at the widest step; 0 where no step is wide enough.
static double tolerance_at_step(const widths *w) {
    double step = LEAST_STEP, tolerance = 0;
    for (size_t i = 0; i < w->gaps.count; i++) {
        const double width = w->gaps.items[i];
        double next = wall_above(w, width);
        if (i + 1 < w->gaps.count) next = fmin(next, w->gaps.items[i + 1]);
        if (!(next / width > step)) continue;
        step = next / width;
        tolerance = fmin(ROOM * width, sqrt(width) * sqrt(next));
    }
    if (!(tolerance > 0)) return 0;
    // Rounded up to one digit where that stays below the step.
    const double unit = pow(10, floor(log10(tolerance)));
    const double round = ceil(tolerance / unit) * unit;
    return round < 2 * tolerance ? round : tolerance;
}

static sl_status suggest(sl_context *context, const sl_map *map, widths *w, sl_map *copy,
                         double *weld) {
    const sl_box box = sl_map_bounds(map);
    SL_TRY(find_widths(context, map, sli_apart(box.min, box.max) / 1000, w));
    SL_TRY(find_lengths(context, map, w));
    const double tolerance = tolerance_at_step(w);
    if (!(tolerance > 0)) return SL_OK;
    const sl_clean_options trial = {.weld = tolerance};
    SL_TRY(sl_map_copy(context, map, copy));
    const sl_status status = sl_map_clean(context, copy, &trial, NULL);
    if (status == SL_UNSUPPORTED) return SL_OK;
    SL_TRY(status);
    SL_TRY(find_widths(context, copy, tolerance, w));
    if (!w->gaps.count) *weld = tolerance;
    return SL_OK;
}

sl_status sl_suggest_weld(sl_context *context, const sl_map *map, double *weld) {
    widths w = {0};
    sl_map copy = {0};
    *weld = 0;
    const sl_status status = map->wall_count ? suggest(context, map, &w, &copy, weld) : SL_OK;
    sl_map_destroy(context, &copy);
    sl_free(context, w.gaps.items);
    sl_free(context, w.walls.items);
    return status;
}

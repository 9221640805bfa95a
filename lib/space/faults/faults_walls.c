/// Faults between walls: gaps, overlaps and crossings. An index of the walls gives those that are
/// near each other; exact signs decide whether two walls touch, cross or overlap.
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
/// leaves none; but not where the two walls are welded.
///
/// Many walls may share a piece or cross at one place. Of n walls there, n - 1 pairs are listed and
/// not all n^2: each wall is named, and each place. Time about O(n log n) for walls that are short
/// against the map, wherever they lie.
#include "base/base.h"
#include "geometry/length.h"
#include "space/faults/faults.h"

#include "geometry/orient.h"
#include "map/planar.h"

#include "sightline/support.h"

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
static bool is_closed(const sl_map *map, const sli_box_list *near, sl_point end,
                      const sl_wall *other, sl_point to) {
    const double reach = 2 * sli_apart(end, to);
    for (size_t i = 0; i < near->count; i++) {
        const sl_wall *wall = &map->walls[near->items[i]];
        if (wall == other) continue;
        if (crosses(wall, end, to)) return true;
        if (sli_touches_wall(wall, end) && meet_near(wall, other, end, reach)) return true;
    }
    return false;
}

/// A gap between two ends is found from both. Whether the other end reports it.
static bool is_reported_there(const sl_wall *other, sl_point end, sl_point to) {
    if (!sli_same_point(to, other->a) && !sli_same_point(to, other->b)) return false;
    return to.x != end.x ? to.x < end.x : to.y < end.y;
}

/// A place where walls end, and the first wall that does.
typedef struct wall_end {
    sl_point at;
    uint32_t wall;
} wall_end;

static int compare_ends(const void *left, const void *right) {
    const wall_end *a = left, *b = right;
    const int order = sli_compare_points(a->at, b->at);
    return order ? order : (a->wall > b->wall) - (a->wall < b->wall);
}

/// The places where walls end, once each. The caller frees them.
static sl_status list_ends(sl_context *context, const sl_map *map, wall_end **out, size_t *count) {
    wall_end *ends = sl_alloc_array(context, 2 * map->wall_count, sizeof *ends);
    if (!ends) return SL_NO_MEMORY;
    for (size_t i = 0; i < map->wall_count; i++) {
        ends[2 * i] = (wall_end){map->walls[i].a, (uint32_t)i};
        ends[2 * i + 1] = (wall_end){map->walls[i].b, (uint32_t)i};
    }
    qsort(ends, 2 * map->wall_count, sizeof *ends, compare_ends);
    *count = 0;
    for (size_t i = 0; i < 2 * map->wall_count; i++)
        if (!*count || !sli_same_point(ends[i].at, ends[*count - 1].at)) ends[(*count)++] = ends[i];
    *out = ends;
    return SL_OK;
}

/// A wall that an end may have a gap to.
typedef struct candidate {
    double width;
    uint32_t wall;
} candidate;

typedef SL_ARRAY(candidate) candidate_list;

static int compare_candidates(const void *left, const void *right) {
    const candidate *a = left, *b = right;
    if (a->width != b->width) return a->width < b->width ? -1 : 1;
    return (a->wall > b->wall) - (a->wall < b->wall);
}

/// The walls up to `most` away from an end, the nearest first: most ends have a gap to the first.
static sl_status list_candidates(sl_context *context, const sl_map *map, sli_wall_index *index,
                                 double most, const wall_end *end, candidate_list *out) {
    const sli_box_list *near = &index->near;
    out->count = 0;
    SL_TRY(sli_walls_near(context, index, (sl_segment){end->at, end->at}, most));
    SL_TRY(SL_ARRAY_ROOM(context, out, near->count));
    for (size_t i = 0; i < near->count; i++) {
        const sl_wall *other = &map->walls[near->items[i]];
        if (near->items[i] == end->wall || sli_touches_wall(other, end->at)) continue;
        const double width = sli_apart(end->at, sli_nearest_on_wall(other, end->at));
        if (width <= most) out->items[out->count++] = (candidate){width, near->items[i]};
    }
    if (out->count > 1) qsort(out->items, out->count, sizeof *out->items, compare_candidates);
    return SL_OK;
}

static sl_status find_gap(sl_context *context, const sl_map *map, sli_wall_index *index,
                          double most, const wall_end *end, candidate_list *candidates,
                          sli_fault_list *out) {
    SL_TRY(list_candidates(context, map, index, most, end, candidates));
    for (size_t i = 0; i < candidates->count; i++) {
        const candidate *found = &candidates->items[i];
        const sl_wall *other = &map->walls[found->wall];
        const sl_point to = sli_nearest_on_wall(other, end->at);
        if (is_closed(map, &index->near, end->at, other, to)) continue;
        if (is_reported_there(other, end->at, to)) return SL_OK;
        return sli_add_to_list(context, out,
                               (sl_fault){.kind = SL_FAULT_GAP,
                                          .size = found->width,
                                          .at = {end->at, to},
                                          .walls = {end->wall, found->wall},
                                          .cell = SL_NO_CELL});
    }
    return SL_OK;
}

/// The gaps between a map's walls, up to a width. The faults' walls are those of this map.
static sl_status list_gaps(sl_context *context, const sl_map *map, double most, bool reports,
                           sli_fault_list *out) {
    sli_wall_index index;
    wall_end *ends = NULL;
    candidate_list candidates = {0};
    size_t count = 0;
    SL_TRY(sl_check_cancelled(context));
    sl_status status = sli_wall_index_create(context, map, &index);
    if (status == SL_OK) status = list_ends(context, map, &ends, &count);
    for (size_t i = 0; i < count && status == SL_OK; i++) {
        if (i % 256 == 0) status = sl_check_cancelled(context);
        if (status == SL_OK)
            status = find_gap(context, map, &index, most, &ends[i], &candidates, out);
        if (reports) sl_report(context, "check", "wall ends", i + 1, count);
    }
    sl_free(context, ends);
    sl_free(context, candidates.items);
    sli_wall_index_destroy(context, &index);
    return status;
}

static sl_status find_gaps(sli_fault_search *search) {
    const size_t first = search->faults.count;
    SL_TRY(list_gaps(search->context, &search->clean, search->options.gap, !search->trial,
                     &search->faults));
    for (size_t i = first; i < search->faults.count; i++) {
        sl_fault *gap = &search->faults.items[i];
        const sl_wall *walls = search->clean.walls;
        const uint32_t lines[2] = {walls[gap->walls[0]].line, walls[gap->walls[1]].line};
        SL_TRY(sli_wall_as_read(search, gap->at.a, lines[0], &gap->walls[0]));
        SL_TRY(sli_wall_as_read(search, gap->at.b, lines[1], &gap->walls[1]));
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

sl_status sli_wall_as_read(sli_fault_search *search, sl_point p, uint32_t line, uint32_t *out) {
    const double reach = search->options.gap / 1024 + search->moved;
    const sli_box_list *near = &search->index.near;
    double least = reach;
    bool same_line = false;
    uint32_t best = UINT32_MAX;
    SL_TRY(sli_walls_near(search->context, &search->index, (sl_segment){p, p}, reach));
    for (size_t i = 0; i < near->count; i++) {
        const sl_wall *wall = &search->map->walls[near->items[i]];
        const double distance = sli_apart(p, sli_nearest_on_wall(wall, p));
        const bool same = line && wall->line == line;
        if (!(distance <= reach)) continue;
        if (best != UINT32_MAX && (same_line && !same)) continue;
        if (best != UINT32_MAX && same_line == same &&
            (distance > least || (distance == least && near->items[i] > best)))
            continue;
        least = distance;
        best = near->items[i];
        same_line = same;
    }
    *out = best;
    return SL_OK;
}

// --- overlaps: walls sorted by their lines, and along each line

/// A wall from its lower end to its upper one, in the order of sli_compare_points.
typedef struct lined_wall {
    sl_point low, high;
    uint32_t wall;
    uint32_t line; ///< equal for walls in one line
} lined_wall;

typedef struct lined_walls {
    lined_wall *items;
    size_t count;
} lined_walls;

/// The order of lines: by direction, then from right to left. Exact.
static int compare_lines(const lined_wall *a, const lined_wall *b) {
    if (a->low.x == a->high.x && b->low.x == b->high.x)
        return (a->low.x < b->low.x) - (a->low.x > b->low.x);
    if (a->low.y == a->high.y && b->low.y == b->high.y)
        return (a->low.y > b->low.y) - (a->low.y < b->low.y);
    const int turn = sli_turn(a->low, a->high, b->low, b->high);
    return turn ? -turn : -sli_orient(a->low, a->high, b->low);
}

/// On one line, a wall comes before those that it covers.
static int compare_lined(const void *left, const void *right) {
    const lined_wall *a = left, *b = right;
    int order = compare_lines(a, b);
    if (!order) order = sli_compare_points(a->low, b->low);
    if (!order) order = sli_compare_points(b->high, a->high);
    return order ? order : (a->wall > b->wall) - (a->wall < b->wall);
}

/// The walls of the map that have a length, by line and along it.
static sl_status sort_by_line(sl_context *context, const sl_map *map, lined_walls *out) {
    out->items = sl_alloc_array(context, map->wall_count, sizeof *out->items);
    if (!out->items) return SL_NO_MEMORY;
    for (size_t i = 0; i < map->wall_count; i++) {
        const sl_point a = map->walls[i].a, b = map->walls[i].b;
        const int order = sli_compare_points(a, b);
        if (order)
            out->items[out->count++] =
                (lined_wall){order < 0 ? a : b, order < 0 ? b : a, (uint32_t)i, 0};
    }
    if (out->count) qsort(out->items, out->count, sizeof *out->items, compare_lined);
    return SL_OK;
}

static sl_status add_overlap(sli_fault_search *search, const lined_wall *far,
                             const lined_wall *wall, sl_point end) {
    const bool turned = wall->wall < far->wall;
    return sli_add_fault(search, (sl_fault){.kind = SL_FAULT_OVERLAP,
                                            .at = {wall->low, end},
                                            .size = sli_apart(wall->low, end),
                                            .walls = {turned ? wall->wall : far->wall,
                                                      turned ? far->wall : wall->wall},
                                            .cell = SL_NO_CELL});
}

/// Of the walls that begin before a wall on its line, the one that reaches farthest shares all that
/// any of them shares with it. Keeps the walls that it does not cover: they meet all that the
/// others meet.
static sl_status find_overlaps(sli_fault_search *search, lined_walls *walls) {
    lined_wall far = {0};
    size_t kept = 0;
    for (size_t i = 0; i < walls->count; i++) {
        lined_wall wall = walls->items[i];
        const bool new_line = i == 0 || compare_lines(&far, &wall) != 0;
        const bool beyond = new_line || sli_compare_points(wall.high, far.high) > 0;
        if (!new_line && sli_compare_points(wall.low, far.high) < 0)
            SL_TRY(add_overlap(search, &far, &wall, beyond ? far.high : wall.high));
        if (!beyond) continue;
        wall.line = far.line + new_line;
        far = walls->items[kept++] = wall;
    }
    walls->count = kept;
    return SL_OK;
}

// --- crossings

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

static sl_point crossing_point(const sl_wall *a, const sl_wall *b) {
    const sl_point u = {a->b.x - a->a.x, a->b.y - a->a.y}, v = {b->b.x - b->a.x, b->b.y - b->a.y};
    const double at = ((b->a.x - a->a.x) * v.y - (b->a.y - a->a.y) * v.x) / (u.x * v.y - u.y * v.x);
    return (sl_point){a->a.x + at * u.x, a->a.y + at * u.y};
}

/// A wall that crosses another one, and how far from the first end of that one.
typedef struct crossing {
    double along;
    uint32_t wall;
} crossing;

typedef SL_ARRAY(crossing) crossing_list;

static int compare_crossings(const void *left, const void *right) {
    const crossing *a = left, *b = right;
    if (a->along != b->along) return a->along < b->along ? -1 : 1;
    return (a->wall > b->wall) - (a->wall < b->wall);
}

/// Walls that have an end in common do not cross, which takes no predicate.
static bool share_end(const sl_wall *a, const sl_wall *b) {
    return sli_same_point(a->a, b->a) || sli_same_point(a->a, b->b) || sli_same_point(a->b, b->a) ||
           sli_same_point(a->b, b->b);
}

/// Lists the walls that cross a wall, along it. The index has the walls as sorted.
static sl_status list_crossings(sli_fault_search *search, const lined_walls *walls,
                                sli_wall_index *index, size_t at, crossing_list *out) {
    const sl_wall *wall = &index->walls[at];
    const sli_box_list *near = &index->near;
    out->count = 0;
    SL_TRY(sli_walls_near(search->context, index, (sl_segment){wall->a, wall->b}, 0));
    for (size_t i = 0; i < near->count; i++) {
        const sl_wall *other = &index->walls[near->items[i]];
        const lined_wall *lined = &walls->items[near->items[i]];
        if (lined->line == walls->items[at].line || share_end(wall, other)) continue;
        if (!crosses(wall, other->a, other->b)) continue;
        if (search->weld > 0 && walls_join(wall, other, search->weld)) continue;
        SL_TRY(SL_ARRAY_ROOM(search->context, out, 1));
        const double along = sli_apart(wall->a, crossing_point(wall, other));
        out->items[out->count++] = (crossing){along, lined->wall};
    }
    if (out->count > 1) qsort(out->items, out->count, sizeof *out->items, compare_crossings);
    return SL_OK;
}

/// At each place that a wall shares with others, adds its crossing with the first of them; unless
/// it is the first. Places no farther apart than `rounding` are one.
static sl_status add_crossings(sli_fault_search *search, uint32_t number, double rounding,
                               const crossing_list *list) {
    for (size_t i = 0, end; i < list->count; i = end) {
        uint32_t first = number;
        for (end = i; end < list->count; end++) {
            if (end > i && list->items[end].along - list->items[end - 1].along > rounding) break;
            if (list->items[end].wall < first) first = list->items[end].wall;
        }
        if (first == number) continue;
        const sl_wall *walls = search->map->walls;
        sl_fault fault = {.kind = SL_FAULT_CROSSING, .walls = {first, number}, .cell = SL_NO_CELL};
        fault.at.a = fault.at.b = crossing_point(&walls[first], &walls[number]);
        SL_TRY(sli_add_fault(search, fault));
    }
    return SL_OK;
}

static sl_status compare_near(sli_fault_search *search, const lined_walls *walls,
                              sli_wall_index *index) {
    const sl_box box = sl_map_bounds(search->map);
    const double rounding = sli_planar_tolerance(&box);
    crossing_list list = {0};
    sl_status status = SL_OK;
    for (size_t i = 0; i < walls->count && status == SL_OK; i++) {
        if (i % 256 == 0) status = sl_check_cancelled(search->context);
        if (status == SL_OK) status = list_crossings(search, walls, index, i, &list);
        if (status == SL_OK) status = add_crossings(search, walls->items[i].wall, rounding, &list);
    }
    sl_free(search->context, list.items);
    return status;
}

static sl_status find_crossings(sli_fault_search *search, const lined_walls *walls) {
    sl_map sorted = {.wall_count = walls->count};
    sli_wall_index index = {0};
    sorted.walls = sl_alloc_array(search->context, walls->count, sizeof *sorted.walls);
    if (!sorted.walls) return SL_NO_MEMORY;
    for (size_t i = 0; i < walls->count; i++)
        sorted.walls[i] = search->map->walls[walls->items[i].wall];
    sl_status status = sli_wall_index_create(search->context, &sorted, &index);
    if (status == SL_OK) status = compare_near(search, walls, &index);
    sli_wall_index_destroy(search->context, &index);
    sl_free(search->context, sorted.walls);
    return status;
}

static sl_status find_pairs(sli_fault_search *search) {
    lined_walls walls = {0};
    sl_status status = sort_by_line(search->context, search->map, &walls);
    if (status == SL_OK) status = find_overlaps(search, &walls);
    if (status == SL_OK) status = find_crossings(search, &walls);
    sl_free(search->context, walls.items);
    return status;
}

sl_status sli_find_wall_faults(sli_fault_search *search) {
    if (!search->trial) {
        SL_TRY(find_pairs(search));
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
    if (out->gaps.count)
        qsort(out->gaps.items, out->gaps.count, sizeof(double), sl_compare_numbers);
    return status;
}

static sl_status find_lengths(sl_context *context, const sl_map *map, widths *out) {
    for (size_t i = 0; i < map->wall_count; i++) {
        const double length = sli_apart(map->walls[i].a, map->walls[i].b);
        if (!(length > 0)) continue;
        SL_TRY(SL_ARRAY_ROOM(context, &out->walls, 1));
        out->walls.items[out->walls.count++] = length;
    }
    if (out->walls.count)
        qsort(out->walls.items, out->walls.count, sizeof(double), sl_compare_numbers);
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
    const double unit = sli_power_of_ten((int)floor(log10(tolerance)));
    const double round = ceil(tolerance / unit) * unit;
    return round < 2 * tolerance ? round : tolerance;
}

static sl_status suggest(sl_context *context, const sl_map *map, widths *w, sl_map *copy,
                         double *weld) {
    // A wider gap than half of the walls are long is not one of rounding.
    const sl_box box = sl_map_bounds(map);
    const double widest = fmin(sli_apart(box.min, box.max) / 1000, 2 * sl_usual_gap(map));
    SL_TRY(find_widths(context, map, widest, w));
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

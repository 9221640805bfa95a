/// Who sees a witness, and the set cover of all witnesses.
///
/// The region of a witness holds the points that see it, as sight has no direction. Points on walls
/// see one side only, and one-way glass has a direction: these are asked themselves. Field of view,
/// range and dead zone are exact. The chords of a range lie within its arc; what sees a witness
/// only between chord and arc counts for the lower bound alone.
#include "analysis/placement/looks.h"
#include "analysis/placement/place_area.h"
#include "geometry/crossing.h"
#include "geometry/orient.h"
#include "sight/cone.h"

#include <math.h>

enum { GRID_POINTS = 1500 };
/// How far a witness is from its corner, as a share of the shorter side.
#define CORNER_STEP 0x1p-10

bool sli_shape_holds(const sl_shape *shape, sl_point p) {
    int winding = 0;
    size_t first = 0;
    for (size_t l = 0; l < shape->count; first = shape->ends[l++])
        for (size_t i = first; i < shape->ends[l]; i++) {
            const sl_point a = shape->points[i];
            const sl_point b = shape->points[i + 1 < shape->ends[l] ? i + 1 : first];
            if ((a.y <= p.y) == (b.y <= p.y)) continue;
            const int side = sli_orient(a, b, p);
            if (a.y <= p.y && side > 0) winding++;
            if (a.y > p.y && side < 0) winding--;
        }
    return winding != 0;
}

/// Notes the places at a point that look at a witness there.
static sl_status add_group(sli_area *a, uint32_t group, sl_point at) {
    const double range = a->ranges[a->groups[group]];
    if (range > 0 && sli_distance_compare(a->task->places[a->groups[group]].at, at, range) > 0)
        return SL_OK;
    for (uint32_t i = a->groups[group]; i < a->groups[group + 1]; i++) {
        const sl_viewpoint *place = &a->task->places[i];
        if (place->nearest > 0 && sli_distance_compare(place->at, at, place->nearest) < 0) continue;
        if (!a->views[i].full && !sli_same_point(place->at, at) &&
            !sli_view_holds(&a->views[i], at))
            continue;
        uint32_t entry = i;
        if (range > 0 || place->nearest > 0) {
            const sl_shape shape = sli_view_shape(&a->shapes, i + 1);
            if (!sli_box_holds(&a->boxes[i], at) || !sli_shape_holds(&shape, at)) entry |= SLI_WIDE;
        }
        SL_TRY(SL_ARRAY_ROOM(a->context, &a->row, 1));
        a->row.items[a->row.count++] = entry;
    }
    return SL_OK;
}

/// Whether no place of a group reaches a point.
static bool is_beyond(const sli_area *a, uint32_t group, sl_point at) {
    const double range = a->ranges[a->groups[group]];
    const sl_point from = a->task->places[a->groups[group]].at;
    return range > 0 && (fabs(from.x - at.x) > range || fabs(from.y - at.y) > range);
}

sl_status sli_area_seers(sli_area *a, sl_point at, uint32_t first) {
    sli_look look = {0};
    bool clean = false;
    sl_status status = SL_OK;
    const double range = sl_query_range(a->query);
    a->seers.count = 0;
    SL_TRY(SL_ARRAY_ROOM(a->context, &a->seers, a->group_count));
    SL_TRY(sl_query_set_range(a->context, a->query, 0));
    if (!a->directed) status = sli_look_make(a->context, a->query, &a->region, at, &look, &clean);
    clean = clean && look.general;
    for (uint32_t g = first; status == SL_OK && g < a->group_count; g++) {
        const sl_point from = a->task->places[a->groups[g]].at;
        if (is_beyond(a, g, at)) continue;
        bool sees = !clean || (sli_box_holds(&look.bounds, from) && sli_look_holds(&look, from));
        if (sees && (!clean || a->on_edge[g]))
            status = sl_query_sees(a->context, a->query, from, at, &sees);
        if (sees) a->seers.items[a->seers.count++] = g;
    }
    sli_look_destroy(a->context, &look);
    const sl_status reset = sl_query_set_range(a->context, a->query, range);
    return status == SL_OK ? reset : status;
}

sl_status sli_area_look(sli_area *a, sl_point at) {
    a->row.count = 0;
    SL_TRY(sli_area_seers(a, at, 0));
    for (size_t i = 0; i < a->seers.count; i++) SL_TRY(add_group(a, a->seers.items[i], at));
    return SL_OK;
}

sl_status sli_area_add_row(sli_area *a, sl_point at) {
    SL_TRY(SL_ARRAY_ROOM(a->context, &a->witnesses, 1));
    SL_TRY(SL_ARRAY_ROOM(a->context, &a->row_ends, 1));
    SL_TRY(SL_ARRAY_ROOM(a->context, &a->entries, a->row.count));
    bool wide = false;
    for (size_t i = 0; i < a->row.count; i++) {
        wide |= a->row.items[i] & SLI_WIDE;
        a->entries.items[a->entries.count++] = a->row.items[i];
    }
    a->wide_count += wide;
    a->witnesses.items[a->witnesses.count++] = at;
    a->row_ends.items[a->row_ends.count++] = a->entries.count;
    return SL_OK;
}

bool sli_area_asks(const sli_area *a, const uint8_t *chosen) {
    uint32_t all = 0, taken = 0;
    for (size_t i = 0; i < a->row.count; i++) {
        if (a->row.items[i] & SLI_WIDE) continue;
        all++;
        taken += chosen[a->row.items[i]] != 0;
    }
    return taken < (all < a->cover ? all : a->cover);
}

// --- the first witnesses

static sl_status try_witness(sli_area *a, sl_point at) {
    at = sli_coordinates(at);
    if (!sl_space_is_inside(a->space, at) || !sli_shape_holds(&a->target, at)) return SL_OK;
    SL_TRY(sl_check_cancelled(a->context));
    SL_TRY(sli_area_look(a, at));
    for (size_t i = 0; i < a->row.count; i++)
        if (a->row.items[i] & SLI_WIDE) return SL_OK;
    return a->row.count ? sli_area_add_row(a, at) : SL_OK;
}

/// One near a corner of the outline, on its left side.
static sl_status try_corner(sli_area *a, sl_point before, sl_point at, sl_point next) {
    if (sli_orient(before, at, next) <= 0) return SL_OK;
    const sl_point p = {before.x - at.x, before.y - at.y}, q = {next.x - at.x, next.y - at.y};
    const double pl = hypot(p.x, p.y), ql = hypot(q.x, q.y), step = CORNER_STEP * fmin(pl, ql);
    return try_witness(
        a, (sl_point){at.x + step * (p.x / pl + q.x / ql), at.y + step * (p.y / pl + q.y / ql)});
}

sl_status sli_area_first_witnesses(sli_area *a) {
    const sl_shape *t = &a->target;
    sl_box box = {t->points[0], t->points[0]};
    size_t first = 0;
    for (size_t l = 0; l < t->count; first = t->ends[l++])
        for (size_t i = first; i < t->ends[l]; i++) {
            const sl_point at = t->points[i];
            box.min = (sl_point){fmin(box.min.x, at.x), fmin(box.min.y, at.y)};
            box.max = (sl_point){fmax(box.max.x, at.x), fmax(box.max.y, at.y)};
            SL_TRY(try_corner(a, t->points[i > first ? i - 1 : t->ends[l] - 1], at,
                              t->points[i + 1 < t->ends[l] ? i + 1 : first]));
        }
    const double width = box.max.x - box.min.x, height = box.max.y - box.min.y;
    const double step =
        fmax(sqrt(a->out->area / GRID_POINTS), sqrt(width * height / (16.0 * GRID_POINTS)));
    for (double y = box.min.y + step / 3; y < box.max.y; y += step)
        for (double x = box.min.x + step / 3; x < box.max.x; x += step)
            SL_TRY(try_witness(a, (sl_point){x, y}));
    return SL_OK;
}

// --- the set cover

static bool counts(uint32_t entry, bool wide) {
    return wide || !(entry & SLI_WIDE);
}

/// Whether a place may be chosen for a row.
static bool is_offered(const sli_area *a, uint32_t entry, bool wide) {
    const uint32_t place = entry & ~SLI_WIDE;
    return counts(entry, wide) && !a->fixed[place] && sli_network_allows(a, place);
}

/// What the fixed places leave of a row's demand: as many as surely see it, up to `cover`.
static uint32_t demand_of(const sli_area *a, size_t row, bool wide) {
    uint32_t sure = 0, fixed = 0;
    for (size_t i = row ? a->row_ends.items[row - 1] : 0; i < a->row_ends.items[row]; i++) {
        const uint32_t entry = a->entries.items[i];
        sure += counts(entry, false);
        fixed += counts(entry, wide) && a->fixed[entry & ~SLI_WIDE];
    }
    const uint32_t demand = sure < a->cover ? sure : a->cover;
    return demand > fixed ? demand - fixed : 0;
}

sl_status sli_area_problem(sli_area *a, bool wide, sl_cover_problem *out) {
    const uint32_t witnesses = (uint32_t)a->witnesses.count, columns = a->task->place_count;
    const uint32_t rows = witnesses + (uint32_t)a->network.row_ends.count;
    size_t *ends = sl_alloc_array(a->context, (size_t)columns + 1, sizeof *ends);
    uint32_t *demands = sl_alloc_array(a->context, rows, sizeof *demands);
    uint32_t *entries =
        sl_alloc_array(a->context, a->entries.count + a->network.entries.count, sizeof *entries);
    *out = (sl_cover_problem){.row_count = rows,
                              .column_count = columns,
                              .ends = ends,
                              .entries = entries,
                              .costs = a->task->costs,
                              .demands = demands};
    if (!ends || !demands || !entries) return SL_NO_MEMORY;
    // ends[c + 1] counts column c, then is where it starts, then where it ends.
    size_t *const starts = ends;
    for (size_t i = 0; i < a->entries.count; i++) {
        const uint32_t entry = a->entries.items[i];
        if (is_offered(a, entry, wide)) starts[(entry & ~SLI_WIDE) + 1]++;
    }
    for (size_t i = 0; i < a->network.entries.count; i++) starts[a->network.entries.items[i] + 1]++;
    for (uint32_t c = 0; c < columns; c++) starts[c + 1] += starts[c];
    for (size_t r = 0, i = 0; r < witnesses; r++) {
        demands[r] = demand_of(a, r, wide);
        for (; i < a->row_ends.items[r]; i++) {
            const uint32_t entry = a->entries.items[i];
            if (is_offered(a, entry, wide)) entries[starts[entry & ~SLI_WIDE]++] = (uint32_t)r;
        }
    }
    for (size_t r = 0, i = 0; r < a->network.row_ends.count; r++) {
        demands[witnesses + r] = 1;
        for (; i < a->network.row_ends.items[r]; i++)
            entries[starts[a->network.entries.items[i]]++] = witnesses + (uint32_t)r;
    }
    return SL_OK;
}

void sli_area_problem_destroy(sl_context *context, sl_cover_problem *problem) {
    sl_free(context, (void *)(uintptr_t)problem->ends);
    sl_free(context, (void *)(uintptr_t)problem->entries);
    sl_free(context, (void *)(uintptr_t)problem->demands);
    *problem = (sl_cover_problem){0};
}

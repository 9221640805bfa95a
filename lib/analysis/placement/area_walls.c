/// Walls to scan: each point of a wall is to be seen from near enough, and not too flat
/// (González-Baños and Latombe 2001, A randomized art-gallery algorithm for sensor placement).
///
///     ---+======+-----+======+-------- wall     A place sees spans of a side of a wall: what its
///         \      \    |     /                   region has of it, cut to where lines of sight make
///          \      \   #    /                    at least the angle with the wall, and are at most
///           \      \  #   /                     as long as the range. Between the ends of all
///            \       \   /                      spans, it does not change who sees the wall. So
///             \    A  \ /                       the middles of these pieces are the rows of a set
///              o-------o eye                    cover, and there are no others.
///
/// The ends of spans are rounded. Ends that are closer than rounding are one, so at the middle of a
/// piece nothing is doubtful, but for ranges that only just reach a wall: what these see counts for
/// the lower bound alone. What is thinner than rounding is counted (`rounding`).
///
/// One place must see a point. Then a piece counts only where fewer see it than see both pieces
/// beside it.
#include "analysis/placement/place_area.h"
#include "geometry/length.h"
#include "geometry/orient.h"

#include <math.h>
#include <stdlib.h>

/// Rounding of an end, as a share of the largest coordinate; more for flat angles.
#define ROUNDING 0x1p-46
/// How far off its wall a point is asked whether it is inside and in a zone, as a share of the
/// wall.
#define OFF_WALL 0x1p-20
#define RADIAN   0.017453292519943295

#define TARGET   UINT32_MAX
#define CROSSING (UINT32_MAX - 1)

/// A part of a side of a wall, by the distance from the wall's first point.
typedef struct span {
    uint32_t wall, place; ///< place TARGET: what is to be seen. CROSSING: a zone ends at `from`
    uint32_t left;        ///< 1: of the left side of the wall, from its first point on
    double from, to;
    double from_error, to_error;
} span;

typedef struct span_end {
    double at;
    uint32_t span;
    bool starts;
} span_end;

/// Ends that are one but for rounding.
typedef struct knot {
    double from, to;
    size_t first, last; ///< ends
    uint32_t starts, stops;
    bool other; ///< of what is to be seen
} knot;

typedef struct scanner {
    sli_area *a;
    const sl_outline *outline;
    double error; ///< rounding of an end
    SL_ARRAY(span) spans;
    SL_ARRAY(span_end) ends;
    SL_ARRAY(knot) knots;
    SL_ARRAY(uint32_t) active; ///< spans over the piece at hand
    size_t *place_in;          ///< by span: where it is in `active`
    uint32_t targets;          ///< over the piece at hand
    bool all;                  ///< every piece counts
    SL_ARRAY(sl_blind_spot) blind;
    double blind_from; ///< where the last one starts on its wall
    bool goes_on;      ///< the piece before belongs to it
} scanner;

bool sli_area_scans(const sli_area *a) {
    return a->task->scan_angle > 0 || a->task->scan_range > 0;
}

// --- spans

static double length_of(const sl_wall *wall) {
    return sli_length(wall->b.x - wall->a.x, wall->b.y - wall->a.y);
}

static double along(const sl_wall *wall, double length, sl_point p) {
    const sl_point u = {(wall->b.x - wall->a.x) / length, (wall->b.y - wall->a.y) / length};
    return sli_dot(u, (sl_point){p.x - wall->a.x, p.y - wall->a.y});
}

static sl_status add_span(scanner *s, span part) {
    if (!(part.from < part.to) && part.place != CROSSING) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(s->a->context, &s->spans, 1));
    s->spans.items[s->spans.count++] = part;
    return SL_OK;
}

/// Half of what a circle cuts out of a line at a distance; *error: how far it may be off.
static double half_chord(const scanner *s, double radius, double distance, double *error) {
    const double near = fmax(0, distance - s->error), far = distance + s->error;
    const double most = radius > near ? sqrt((radius - near) * (radius + near)) : 0;
    const double least = radius > far ? sqrt((radius - far) * (radius + far)) : 0;
    *error = (most - least) / 2 + s->error;
    return (most + least) / 2;
}

/// Cuts a span to `half` on both sides of `foot`.
static void cut(span *part, double foot, double half, double error) {
    if (foot - half + error > part->from) {
        part->from = fmax(part->from, foot - half);
        part->from_error = fmax(part->from_error, error);
    }
    if (foot + half - error < part->to) {
        part->to = fmin(part->to, foot + half);
        part->to_error = fmax(part->to_error, error);
    }
}

/// Adds a span without the dead zone, half as wide as `gap`, about the foot.
static sl_status add_around(scanner *s, const span *part, double foot, double gap, double error) {
    span before = *part, after = *part;
    if (foot - gap - error < before.to) {
        before.to = fmin(before.to, foot - gap);
        before.to_error = fmax(before.to_error, error);
    }
    if (foot + gap + error > after.from) {
        after.from = fmax(after.from, foot + gap);
        after.from_error = fmax(after.from_error, error);
    }
    SL_TRY(add_span(s, before));
    return add_span(s, after);
}

/// What a place sees of a wall, between two points of it.
static sl_status add_edge(scanner *s, uint32_t place, uint32_t number, sl_point p, sl_point q) {
    const sli_area *a = s->a;
    const sl_viewpoint *v = &a->task->places[place];
    const sl_wall *wall = &a->space->walls[number];
    const int side = sli_orient(wall->a, wall->b, v->at);
    const double length = length_of(wall);
    if (side == 0 || !(length > 0)) return SL_OK;
    const double from = along(wall, length, p), to = along(wall, length, q);
    span part = {.wall = number,
                 .place = place,
                 .left = side > 0,
                 .from = fmax(0, fmin(from, to)),
                 .to = fmin(length, fmax(from, to)),
                 .from_error = s->error,
                 .to_error = s->error};
    const double foot = along(wall, length, v->at);
    const sl_point way = {wall->b.x - wall->a.x, wall->b.y - wall->a.y};
    const double distance =
        fabs(sli_cross(way, (sl_point){v->at.x - wall->a.x, v->at.y - wall->a.y})) / length;
    const double angle = a->task->scan_angle, scan = a->task->scan_range;
    double range = a->ranges[place], error;
    if (scan > 0 && !(range > 0 && range < scan)) range = scan;
    if (angle > 0) cut(&part, foot, distance / tan(angle * RADIAN), s->error);
    if (range > 0) {
        const double half = half_chord(s, range, distance, &error);
        cut(&part, foot, half, error);
    }
    if (!(v->nearest > 0)) return add_span(s, part);
    const double gap = half_chord(s, v->nearest, distance, &error);
    return gap > 0 ? add_around(s, &part, foot, gap, error) : add_span(s, part);
}

static sl_status add_place(scanner *s, uint32_t place) {
    sli_area *a = s->a;
    const double most = sl_query_range(a->query);
    SL_TRY(sl_query_set_range(a->context, a->query, 0));
    const sl_status status = sl_query_region(a->context, a->query, &a->views[place], &a->region);
    SL_TRY(sl_query_set_range(a->context, a->query, most));
    SL_TRY(status);
    for (size_t i = 0; i < a->region.count; i++) {
        const sl_region_edge *edge = &a->region.edges[i];
        if (edge->kind != SL_EDGE_WALL || edge->wall >= a->space->wall_count) continue;
        SL_TRY(add_edge(s, place, edge->wall, a->region.points[i],
                        a->region.points[i + 1 < a->region.count ? i + 1 : 0]));
    }
    return SL_OK;
}

/// The sides of walls that rooms have.
static sl_status add_targets(scanner *s) {
    const sl_outline *o = s->outline;
    const sl_space *space = s->a->space;
    for (uint32_t i = 0; i < o->side_count; i++) {
        const uint32_t number = o->sides[i].neighbour - SL_SIDE_WALL;
        if (o->sides[i].neighbour < SL_SIDE_WALL || number >= space->wall_count) continue;
        const sl_wall *wall = &space->walls[number];
        const double length = length_of(wall);
        if (!(length > 0)) continue;
        const double from = along(wall, length, o->sides[i].start);
        const double to = along(wall, length, o->sides[o->sides[i].next].start);
        SL_TRY(add_span(s, (span){.wall = number,
                                  .place = TARGET,
                                  .left = from < to,
                                  .from = fmax(0, fmin(from, to)),
                                  .to = fmin(length, fmax(from, to))}));
    }
    return SL_OK;
}

/// Where the outline of what is to be seen crosses walls, on both sides of each.
static sl_status add_crossings(scanner *s) {
    const sl_shape *see = s->a->task->see;
    if (!see) return SL_OK;
    for (uint32_t w = 0; w < s->a->space->wall_count; w++) {
        const sl_wall *wall = &s->a->space->walls[w];
        const double length = length_of(wall);
        size_t first = 0;
        for (size_t l = 0; length > 0 && l < see->count; first = see->ends[l++])
            for (size_t i = first; i < see->ends[l]; i++) {
                const sl_point p = see->points[i];
                const sl_point q = see->points[i + 1 < see->ends[l] ? i + 1 : first];
                const int before = sli_orient(wall->a, wall->b, p);
                if (before == sli_orient(wall->a, wall->b, q)) continue;
                const sl_point way = {wall->b.x - wall->a.x, wall->b.y - wall->a.y};
                const double d = sli_cross(way, (sl_point){p.x - wall->a.x, p.y - wall->a.y});
                const double e = sli_cross(way, (sl_point){q.x - wall->a.x, q.y - wall->a.y});
                const double share = d == e ? 0 : d / (d - e);
                const sl_point at = {p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)};
                span part = {.wall = w, .place = CROSSING, .from = along(wall, length, at)};
                if (!(part.from > 0 && part.from < length)) continue;
                part.to = part.from;
                SL_TRY(add_span(s, part));
                part.left = 1;
                SL_TRY(add_span(s, part));
            }
    }
    return SL_OK;
}

// --- pieces

static int compare_spans(const void *left, const void *right) {
    const span *a = left, *b = right;
    if (a->wall != b->wall) return a->wall < b->wall ? -1 : 1;
    if (a->left != b->left) return a->left < b->left ? -1 : 1;
    if (a->place != b->place) return a->place < b->place ? -1 : 1;
    return (a->from > b->from) - (a->from < b->from);
}

static int compare_ends(const void *left, const void *right) {
    const span_end *a = left, *b = right;
    if (a->at != b->at) return a->at < b->at ? -1 : 1;
    if (a->starts != b->starts) return a->starts ? -1 : 1;
    return (a->span > b->span) - (a->span < b->span);
}

static int compare_entries(const void *left, const void *right) {
    const uint32_t a = *(const uint32_t *)left & ~SLI_WIDE;
    const uint32_t b = *(const uint32_t *)right & ~SLI_WIDE;
    return (a > b) - (a < b);
}

/// The ends of the spans of a side of a wall, and knots of them.
static sl_status tie_knots(scanner *s, size_t from, size_t to) {
    sl_context *context = s->a->context;
    s->ends.count = s->knots.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &s->ends, 2 * (to - from)));
    SL_TRY(SL_ARRAY_ROOM(context, &s->knots, 2 * (to - from)));
    for (size_t i = from; i < to; i++) {
        const span *part = &s->spans.items[i];
        s->ends.items[s->ends.count++] = (span_end){part->from, (uint32_t)i, true};
        s->ends.items[s->ends.count++] = (span_end){part->to, (uint32_t)i, false};
    }
    qsort(s->ends.items, s->ends.count, sizeof *s->ends.items, compare_ends);
    for (size_t i = 0; i < s->ends.count; i++) {
        const span_end *end = &s->ends.items[i];
        knot *k = s->knots.count ? &s->knots.items[s->knots.count - 1] : NULL;
        if (!k || end->at - k->to > 4 * s->error) {
            k = &s->knots.items[s->knots.count++];
            *k = (knot){.from = end->at, .first = i};
        }
        k->to = end->at;
        k->last = i;
        const uint32_t place = s->spans.items[end->span].place;
        k->other |= place == TARGET || place == CROSSING;
        k->starts += end->starts;
        k->stops += !end->starts;
    }
    return SL_OK;
}

/// Follows the spans over a knot.
static sl_status pass(scanner *s, const knot *k) {
    for (int stops = 0; stops < 2; stops++)
        for (size_t i = k->first; i <= k->last; i++) {
            const span_end *end = &s->ends.items[i];
            const uint32_t place = s->spans.items[end->span].place;
            if (end->starts == (stops != 0) || place == CROSSING) continue;
            if (place == TARGET) {
                s->targets += end->starts ? 1 : UINT32_MAX;
            } else if (end->starts) {
                SL_TRY(SL_ARRAY_ROOM(s->a->context, &s->active, 1));
                s->place_in[end->span] = s->active.count;
                s->active.items[s->active.count++] = end->span;
            } else {
                const uint32_t last = s->active.items[--s->active.count];
                s->active.items[s->place_in[end->span]] = last;
                s->place_in[last] = s->place_in[end->span];
            }
        }
    return SL_OK;
}

/// Fills a->row with who sees a place on the wall. `doubtful`: spans of these ends, too.
static sl_status list_seers(scanner *s, size_t from, size_t to, bool doubtful, double at,
                            uint32_t *sure) {
    sli_area *a = s->a;
    a->row.count = 0;
    *sure = 0;
    SL_TRY(SL_ARRAY_ROOM(a->context, &a->row, s->active.count + (doubtful ? to - from : 0)));
    for (size_t i = 0; i < (doubtful ? to - from : s->active.count); i++) {
        const span *part = &s->spans.items[doubtful ? from + i : s->active.items[i]];
        if (part->place == TARGET || part->place == CROSSING) continue;
        if (at < part->from - part->from_error || at > part->to + part->to_error) continue;
        const bool is_sure = at > part->from + part->from_error && at < part->to - part->to_error;
        *sure += is_sure;
        a->row.items[a->row.count++] = part->place | (is_sure ? 0 : SLI_WIDE);
    }
    if (a->row.count) qsort(a->row.items, a->row.count, sizeof *a->row.items, compare_entries);
    return SL_OK;
}

static sl_point point_on(const sl_wall *wall, double length, double at) {
    return (sl_point){wall->a.x + at / length * (wall->b.x - wall->a.x),
                      wall->a.y + at / length * (wall->b.y - wall->a.y)};
}

/// Whether a place on a side of a wall is to be seen.
static bool is_asked(const scanner *s, const span *part, double at) {
    const sl_wall *wall = &s->a->space->walls[part->wall];
    const double off = part->left ? OFF_WALL : -OFF_WALL;
    const sl_point on = point_on(wall, length_of(wall), at);
    const sl_point beside = {on.x - off * (wall->b.y - wall->a.y),
                             on.y + off * (wall->b.x - wall->a.x)};
    return s->targets && sl_space_is_inside(s->a->space, beside) &&
           (!s->a->task->see || sli_shape_holds(s->a->task->see, beside));
}

/// A piece that too few places see: a blind spot, or more of that which ended where it starts.
static sl_status add_blind(scanner *s, const span *part, double from, double to) {
    const sl_wall *wall = &s->a->space->walls[part->wall];
    const double length = length_of(wall);
    const sl_point ends[2] = {point_on(wall, length, from), point_on(wall, length, to)};
    if (!s->goes_on) {
        SL_TRY(SL_ARRAY_ROOM(s->a->context, &s->blind, 1));
        s->blind.items[s->blind.count++] =
            (sl_blind_spot){.bounds = {ends[0], ends[0]}, .at = ends[0]};
        s->blind_from = from;
    }
    sl_blind_spot *spot = &s->blind.items[s->blind.count - 1];
    spot->area += to - from;
    spot->at = point_on(wall, length, (s->blind_from + to) / 2);
    for (int i = 0; i < 2; i++) {
        sl_box *b = &spot->bounds;
        b->min = (sl_point){fmin(b->min.x, ends[i].x), fmin(b->min.y, ends[i].y)};
        b->max = (sl_point){fmax(b->max.x, ends[i].x), fmax(b->max.y, ends[i].y)};
    }
    s->a->out->blind_area += to - from;
    s->goes_on = true;
    return SL_OK;
}

/// Whether one of the pieces beside a piece makes its row needless: spans only start, or only stop,
/// on the way there, and not all of them.
static bool is_needless(const scanner *s, const knot *before, const knot *after,
                        size_t active_before) {
    if (s->all) return false;
    if (before->starts && !before->stops && !before->other && active_before) return true;
    return after->stops && !after->starts && !after->other && s->active.count > after->stops;
}

/// The pieces of a side of a wall.
static sl_status add_pieces(scanner *s, size_t from, size_t to) {
    sli_area *a = s->a;
    const span *first = &s->spans.items[from];
    bool doubtful = false;
    s->active.count = s->targets = 0;
    s->goes_on = false;
    for (size_t i = from; i < to; i++)
        doubtful |=
            s->spans.items[i].from_error > s->error || s->spans.items[i].to_error > s->error;
    s->all = doubtful || a->cover > 1 || a->task->count;
    SL_TRY(tie_knots(s, from, to));
    for (size_t k = 0; k + 1 < s->knots.count; k++) {
        const knot *before = &s->knots.items[k], *after = before + 1;
        const size_t active_before = s->active.count;
        SL_TRY(pass(s, before));
        const double middle = before->to + (after->from - before->to) / 2;
        if (!is_asked(s, first, middle)) {
            s->goes_on = false;
            continue;
        }
        const double length = after->from - before->to;
        uint32_t sure;
        a->out->area += length;
        a->out->rounding += after->to - after->from + 4 * s->error;
        SL_TRY(list_seers(s, from, to, doubtful, middle, &sure));
        if (sure < a->cover && !a->task->count)
            SL_TRY(add_blind(s, first, before->to, after->from));
        else
            s->goes_on = false;
        if (!a->row.count || is_needless(s, before, after, active_before)) continue;
        const sl_wall *wall = &a->space->walls[first->wall];
        SL_TRY(sli_area_add_row(a, point_on(wall, length_of(wall), middle)));
        SL_TRY(SL_ARRAY_ROOM(a->context, &a->lengths, 1));
        a->lengths.items[a->lengths.count++] = length;
    }
    return SL_OK;
}

static sl_status add_rows(scanner *s) {
    if (s->spans.count)
        qsort(s->spans.items, s->spans.count, sizeof *s->spans.items, compare_spans);
    s->place_in = sl_alloc_array(s->a->context, s->spans.count, sizeof *s->place_in);
    if (!s->place_in) return SL_NO_MEMORY;
    for (size_t i = 0, end; i < s->spans.count; i = end) {
        const span *part = &s->spans.items[i];
        for (end = i; end < s->spans.count && s->spans.items[end].wall == part->wall &&
                      s->spans.items[end].left == part->left;)
            end++;
        SL_TRY(sl_check_cancelled(s->a->context));
        SL_TRY(add_pieces(s, i, end));
    }
    return SL_OK;
}

static sl_status scan(scanner *s) {
    sli_area *a = s->a;
    const sl_box *b = &a->space->bounds;
    const double angle = a->task->scan_angle;
    double most = fmax(fmax(fabs(b->min.x), fabs(b->max.x)), fmax(fabs(b->min.y), fabs(b->max.y)));
    most = fmax(most, b->max.x - b->min.x + b->max.y - b->min.y);
    s->error = ROUNDING * most * (angle > 0 ? 1 + 1 / tan(angle * RADIAN) : 1);
    SL_TRY(sl_query_outline(a->context, a->query, &s->outline));
    SL_TRY(add_targets(s));
    SL_TRY(add_crossings(s));
    for (uint32_t i = 0; i < a->task->place_count; i++) {
        if (i % 64 == 0) SL_TRY(sl_check_cancelled(a->context));
        SL_TRY(add_place(s, i));
    }
    a->out->area = a->out->rounding = 0;
    SL_TRY(add_rows(s));
    if (s->blind.count)
        qsort(s->blind.items, s->blind.count, sizeof *s->blind.items, sli_blind_spots_compare);
    a->out->blind = s->blind.items;
    a->out->blind_count = (uint32_t)s->blind.count;
    s->blind.items = NULL;
    a->out->seen = a->out->area - a->out->blind_area;
    if (!(a->out->area > 0))
        return sl_fail(a->context, SL_BAD_ARGUMENT, "no wall is to be seen inside");
    if (!a->witnesses.count)
        return sl_fail(a->context, SL_BAD_ARGUMENT,
                       "none of the %u places sees any wall so; the longest piece is at (%.9g, "
                       "%.9g)",
                       a->task->place_count, a->out->blind[0].at.x, a->out->blind[0].at.y);
    return SL_OK;
}

sl_status sli_area_walls(sli_area *a) {
    scanner s = {.a = a};
    const sl_status status = scan(&s);
    sl_free(a->context, s.spans.items);
    sl_free(a->context, s.ends.items);
    sl_free(a->context, s.knots.items);
    sl_free(a->context, s.active.items);
    sl_free(a->context, s.place_in);
    sl_free(a->context, s.blind.items);
    return status;
}

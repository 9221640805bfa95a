/// The region of a set: one eye for each piece of the set that no wall cuts, and the cones.
///
/// A segment is cut where it crosses walls and at the ends of walls that lie on it: there, what its
/// points see may change at once. For weak visibility, the ends of pieces are eyes where they are
/// known exactly, and so given or ends of walls. A piece of the set that a point sees ends at such
/// an eye or at a ray that grazes a wall, so in a cone. Only a piece between two crossings needs an
/// eye in its middle, as both may be the ends of what a point sees.
///
/// For complete visibility, each piece needs what an eye within it sees: that is what an eye next
/// to its end sees, which walls at the end may part. Where points on both sides of a wall must see
/// something there is nothing, and pieces that meet in free ground need one eye only.
#include "analysis/set_sight/set_sight.h"

#include "geometry/crossing.h"
#include "geometry/length.h"
#include "geometry/orient.h"
#include "sight/overlay.h"

#include <math.h>
#include <stdlib.h>

/// A place where a segment is cut, or its end.
typedef struct cut {
    sl_point at;
    double along;
    bool exact;
    sl_segment wall; ///< that crosses there, if it is not exact
} cut;

typedef struct maker {
    sl_context *context;
    sl_set_sight *sight;
    sl_set_seen seen;
    sli_parts eyes;          ///< for complete visibility: by piece
    sli_parts cones;         ///< and all that weak visibility is made of
    SL_ARRAY(size_t) pieces; ///< by piece: the loops up to its last one
    SL_ARRAY(cut) cuts;
    SL_ARRAY(sl_segment) along; ///< within a range: walls that touch the segment, but for rounding
    bool through;               ///< the set crosses a wall
} maker;

// --- the pieces of a segment

static sl_status add_cut(maker *m, sl_segment s, sl_point at, const sl_segment *wall) {
    const sl_point way = {s.b.x - s.a.x, s.b.y - s.a.y}, to = {at.x - s.a.x, at.y - s.a.y};
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->cuts, 1));
    m->cuts.items[m->cuts.count++] = (cut){at, sli_dot(way, to), !wall, wall ? *wall : s};
    return SL_OK;
}

static int compare_cuts(const void *left, const void *right) {
    const cut *a = left, *b = right;
    if (a->along != b->along) return a->along < b->along ? -1 : 1;
    const int order = sli_compare_points(a->at, b->at);
    return order ? order : (int)b->exact - (int)a->exact;
}

static bool is_between(sl_segment s, sl_point p) {
    const sl_box box = {{sli_lesser(s.a.x, s.b.x), sli_lesser(s.a.y, s.b.y)},
                        {sli_greater(s.a.x, s.b.x), sli_greater(s.a.y, s.b.y)}};
    return sli_box_holds(&box, p) && !sli_same_point(p, s.a) && !sli_same_point(p, s.b);
}

/// More than rounding moves places of the map.
static double slack_of(const maker *m) {
    const sl_box *b = &m->sight->rooms.outline->space->bounds;
    return 0x1p-44 * sli_greater(sli_greater(fabs(b->min.x), fabs(b->max.x)),
                                 sli_greater(fabs(b->min.y), fabs(b->max.y)));
}

/// Keeps a wall that the segment does not cross, if it touches it but for rounding.
static sl_status keep_along(maker *m, sl_segment s, sl_segment wall) {
    const double apart =
        fmin(fmin(sli_away_from(wall.a, wall.b, s.a), sli_away_from(wall.a, wall.b, s.b)),
             fmin(sli_away_from(s.a, s.b, wall.a), sli_away_from(s.a, s.b, wall.b)));
    if (apart > 4 * slack_of(m)) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->along, 1));
    m->along.items[m->along.count++] = wall;
    return SL_OK;
}

/// Cuts a segment at one side that stops sight.
static sl_status cut_at(maker *m, sl_segment s, uint32_t side) {
    const sli_beam_rooms *rooms = &m->sight->rooms;
    const sl_segment wall = {sli_side(rooms, side)->start, sli_side_end(rooms, side)};
    const int a = sli_orient(s.a, s.b, wall.a), b = sli_orient(s.a, s.b, wall.b);
    if (a == 0 && is_between(s, wall.a)) SL_TRY(add_cut(m, s, wall.a, NULL));
    if (b == 0 && is_between(s, wall.b)) SL_TRY(add_cut(m, s, wall.b, NULL));
    if (a * b >= 0 || sli_orient(wall.a, wall.b, s.a) * sli_orient(wall.a, wall.b, s.b) >= 0)
        return m->sight->within > 0 ? keep_along(m, s, wall) : SL_OK;
    m->through |= sli_side_across(rooms, side) == SL_NO_WALL;
    return add_cut(m, s, sli_crossing(s, wall), &wall);
}

static sl_status cut_segment(maker *m, sl_segment s) {
    m->cuts.count = m->along.count = 0;
    SL_TRY(add_cut(m, s, s.a, NULL));
    SL_TRY(add_cut(m, s, s.b, NULL));
    for (uint32_t i = 0; i < m->sight->stop_count; i++) SL_TRY(cut_at(m, s, m->sight->stops[i]));
    qsort(m->cuts.items, m->cuts.count, sizeof *m->cuts.items, compare_cuts);
    size_t kept = 0;
    for (size_t i = 0; i < m->cuts.count; i++)
        if (!kept || !sli_same_point(m->cuts.items[kept - 1].at, m->cuts.items[i].at))
            m->cuts.items[kept++] = m->cuts.items[i];
    m->cuts.count = kept;
    return SL_OK;
}

// --- the parts

static int side_of(sl_segment wall, sl_point p) {
    return sli_orient(wall.a, wall.b, p);
}

/// A place between two crossings of the segment, on its side of both walls. The middle may be
/// rounded to their other sides. So it steps away from the first wall, by units in the last place.
static sl_point between_walls(sl_segment s, const cut *from, const cut *to) {
    const sl_point a = from->at, b = to->at,
                   middle = {a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2};
    const sl_segment w = from->wall;
    const double length = sli_length(w.b.x - w.a.x, w.b.y - w.a.y);
    const double unit = 0x1p-53 * sli_greater(fabs(middle.x), fabs(middle.y)) / length;
    const int first = side_of(w, s.b), second = side_of(to->wall, s.a);
    sl_point at = middle;
    for (int steps = 1; steps <= 64; steps *= 2) {
        if (side_of(w, at) == first && side_of(to->wall, at) == second) return at;
        const double away = first * steps * unit;
        at = (sl_point){middle.x - away * (w.b.y - w.a.y), middle.y + away * (w.b.x - w.a.x)};
    }
    return middle;
}

static sl_status add_eye(maker *m, sl_point at, const sl_point *towards, sli_parts *parts) {
    SL_TRY(sli_spot_find(m->context, m->sight, at, &m->sight->spot));
    return sli_add_eye(m->context, m->sight, &m->sight->spot, towards, parts);
}

static sl_status end_piece(maker *m) {
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->pieces, 1));
    m->pieces.items[m->pieces.count++] = m->eyes.ends.count;
    return SL_OK;
}

/// The side of a wall that a segment is on that does not cross it; 0: it is in line with it, or
/// only one point of it is on the wall's line.
static int side_of_segment(sl_segment wall, sl_segment s) {
    const int a = side_of(wall, s.a), b = side_of(wall, s.b);
    return a * b < 0 ? 0 : a ? a : b;
}

/// Adds an eye of the segment. Next to a wall along it, rounding might move the eye across. So it
/// steps to the side of the wall that the segment is on; if that is in line with it, to `side`.
static sl_status add_eye_aside(maker *m, sl_segment s, sl_point at, int side) {
    const double slack = slack_of(m);
    sl_point aside = at;
    bool in_line = false;
    for (size_t i = 0; i < m->along.count; i++) {
        const sl_segment w = m->along.items[i];
        if (sli_away_from(w.a, w.b, at) > 2 * slack) continue;
        const double x = w.b.x - w.a.x, y = w.b.y - w.a.y;
        const int on = side_of_segment(w, s);
        const double step = (on ? on : side) * slack / sli_length(x, y);
        aside = (sl_point){at.x - step * y, at.y + step * x};
        in_line = !on;
        break;
    }
    if (side < 0 && !in_line) return SL_OK; // one eye is enough
    for (size_t i = 0; i < m->along.count; i++) {
        const sl_segment w = m->along.items[i];
        const int on = side_of_segment(w, s), is = side_of(w, aside);
        if (sli_away_from(w.a, w.b, at) <= 2 * slack && (on ? is != on : !is)) return SL_OK;
    }
    return add_eye(m, aside, NULL, &m->cones);
}

/// Eyes along a piece, near enough to each other for the range, and next to its ends where walls
/// cross the segment.
static sl_status add_eyes_between(maker *m, sl_segment s, const cut *from, const cut *to) {
    const double range = m->sight->range;
    const sl_point a = from->at, way = {to->at.x - a.x, to->at.y - a.y};
    const double length = sli_length(way.x, way.y),
                 beside = fmin(0.5, sli_range_beside(range) / length);
    const double first = from->exact ? 0 : beside, last = to->exact ? 1 : 1 - beside;
    const double steps = ceil((last - first) * length / sli_range_step(range));
    if (!(steps <= SL_SET_REGION_CORNERS))
        return sl_fail(m->context, SL_UNSUPPORTED,
                       "the set is too long for the range %.9g: a piece of it has length %.9g",
                       range, length);
    for (double i = from->exact ? 1 : 0; i <= steps - (to->exact ? 1 : 0); i++) {
        const double share = first + (last - first) * (steps > 0 ? i / steps : 0);
        const sl_point at = {a.x + share * way.x, a.y + share * way.y};
        SL_TRY(add_eye_aside(m, s, at, 1));
        SL_TRY(add_eye_aside(m, s, at, -1));
    }
    return SL_OK;
}

static sl_status add_weak_eyes(maker *m, sl_segment s) {
    for (size_t i = 0; i < m->cuts.count; i++) {
        const cut *at = &m->cuts.items[i];
        if (at->exact) SL_TRY(add_eye(m, at->at, NULL, &m->cones));
        if (i && !at->exact && !at[-1].exact)
            SL_TRY(add_eye(m, between_walls(s, at - 1, at), NULL, &m->cones));
        if (i && m->sight->within > 0) SL_TRY(add_eyes_between(m, s, at - 1, at));
    }
    return SL_OK;
}

/// The eye of one piece, but where free ground joins it with the piece before it.
static sl_status add_complete_eye(maker *m, sl_segment segment, const cut *from, const cut *to) {
    const bool joined = m->pieces.count > 0;
    sl_set_sight *s = m->sight;
    const bool exact = from->exact || to->exact;
    const sl_point at = from->exact ? from->at
                        : to->exact ? to->at
                                    : between_walls(segment, from, to);
    SL_TRY(sli_spot_find(m->context, s, at, &s->spot));
    if (joined && !s->spot.blocks.count && from->exact) return SL_OK;
    SL_TRY(sli_add_eye(m->context, s, &s->spot, exact ? from->exact ? &to->at : &from->at : NULL,
                       &m->eyes));
    return end_piece(m);
}

static sl_status add_segment(maker *m, size_t i) {
    const sl_segment s = sli_segment(m->sight, i);
    if (sli_same_point(s.a, s.b)) return SL_OK;
    SL_TRY(cut_segment(m, s));
    if (m->seen == SL_SEEN_FROM_SOME)
        SL_TRY(add_weak_eyes(m, s));
    else if (m->through)
        return SL_OK;
    for (size_t k = 1; m->seen == SL_SEEN_FROM_ALL && k < m->cuts.count; k++)
        SL_TRY(add_complete_eye(m, s, &m->cuts.items[k - 1], &m->cuts.items[k]));
    return sli_add_cones(m->context, m->sight, s, &m->cones);
}

/// Adds what a convex cell has in common with the area of the set.
static sl_status add_cell(maker *m, const sl_cell *cell) {
    const sl_set_sight *s = m->sight;
    const sl_space *space = s->rooms.outline->space;
    SL_ARRAY(sl_point) now = {0}, next = {0};
    sl_status status = SL_ARRAY_ROOM(m->context, &now, cell->vertex_count + s->count + 2);
    if (status == SL_OK)
        status = SL_ARRAY_ROOM(m->context, &next, cell->vertex_count + s->count + 2);
    for (uint32_t i = 0; i < cell->vertex_count && status == SL_OK; i++)
        now.items[now.count++] = space->vertices[cell->first_vertex + i];
    for (size_t k = 0; k < s->count && status == SL_OK; k++) {
        const sl_segment line = sli_segment(s, k);
        next.count = 0;
        for (size_t i = 0; i < now.count && status == SL_OK; i++) {
            const sl_point a = now.items[i], b = now.items[i + 1 < now.count ? i + 1 : 0];
            const int at_a = sli_orient(line.a, line.b, a), at_b = sli_orient(line.a, line.b, b);
            status = SL_ARRAY_ROOM(m->context, &next, 2);
            if (status != SL_OK) break;
            if (at_a >= 0) next.items[next.count++] = a;
            if (at_a * at_b < 0) next.items[next.count++] = sli_crossing((sl_segment){a, b}, line);
        }
        sl_point *const keep = now.items;
        const size_t capacity = now.capacity;
        now.items = next.items;
        now.count = next.count;
        now.capacity = next.capacity;
        next.items = keep;
        next.capacity = capacity;
    }
    if (status == SL_OK && now.count > 2)
        status = SL_ARRAY_ROOM(m->context, &m->cones.points, now.count);
    for (size_t i = 0; i < now.count && status == SL_OK && now.count > 2; i++)
        m->cones.points.items[m->cones.points.count++] = now.items[i];
    sl_free(m->context, now.items);
    sl_free(m->context, next.items);
    return status == SL_OK ? sli_parts_close(m->context, &m->cones) : status;
}

/// An area is seen from itself.
static sl_status add_area(maker *m) {
    const sl_set_sight *s = m->sight;
    const sl_space *space = s->rooms.outline->space;
    sl_box box = {s->points[0], s->points[0]};
    for (size_t i = 1; i < s->count; i++) {
        const sl_point p = s->points[i];
        box.min = (sl_point){sli_lesser(box.min.x, p.x), sli_lesser(box.min.y, p.y)};
        box.max = (sl_point){sli_greater(box.max.x, p.x), sli_greater(box.max.y, p.y)};
    }
    for (size_t i = 0; i < sl_eye_words(space); i++) s->touched[i] = 0;
    sl_cells_of_box(space, box, s->touched);
    for (uint32_t c = 0; c < space->cell_count; c++)
        if (sl_eye_sees(s->touched, c) && !space->cells[c].solid)
            SL_TRY(add_cell(m, &space->cells[c]));
    return SL_OK;
}

static sl_status add_parts(maker *m) {
    const sl_set_sight *s = m->sight;
    const size_t segments = sli_segment_count(s);
    bool is_point = true;
    for (size_t i = 1; i < s->count; i++) is_point &= sli_same_point(s->points[i], s->points[0]);
    if (is_point && m->seen == SL_SEEN_FROM_SOME) return add_eye(m, s->points[0], NULL, &m->cones);
    if (is_point) {
        SL_TRY(add_eye(m, s->points[0], NULL, &m->eyes));
        return end_piece(m);
    }
    for (size_t i = 0; i < segments; i++) SL_TRY(add_segment(m, i));
    return s->kind == SL_SET_AREA && m->seen == SL_SEEN_FROM_SOME ? add_area(m) : SL_OK;
}

// --- joining them

static sl_shape shape_of(const sli_parts *parts) {
    return (sl_shape){parts->points.items, parts->ends.items, parts->ends.count};
}

/// The outline of what at least so many shapes cover.
static sl_status join(sl_context *context, const sl_shape *shapes, size_t count, size_t at_least,
                      sl_shape *out) {
    sl_overlay overlay = {0};
    *out = (sl_shape){0};
    SL_TRY(sli_overlay_make_up_to(context, "the region of the set, before its parts are joined",
                                  NULL, shapes, count, SL_SET_REGION_CROSSINGS, &overlay));
    const sl_status status = sl_overlay_outline(context, &overlay, at_least, out);
    sl_overlay_destroy(context, &overlay);
    return status;
}

/// `base` without `off`, both simple. Where the loops of both are laid together, those of `off`
/// turned over, they go around what only one of the two covers.
static sl_status subtract(sl_context *context, const sl_shape *base, const sl_shape *off,
                          sl_shape *out) {
    const size_t first = base->count ? base->ends[base->count - 1] : 0;
    const size_t more = off->count ? off->ends[off->count - 1] : 0;
    sl_point *points = sl_alloc_array(context, first + more + 1, sizeof *points);
    size_t *ends = sl_alloc_array(context, base->count + off->count + 1, sizeof *ends);
    sl_status status = points && ends ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) {
        for (size_t i = 0; i < first; i++) points[i] = base->points[i];
        for (size_t i = 0; i < base->count; i++) ends[i] = base->ends[i];
        for (size_t i = 0; i < off->count; i++) {
            const size_t begin = i ? off->ends[i - 1] : 0, end = off->ends[i];
            for (size_t k = begin; k < end; k++)
                points[first + k] = off->points[begin + end - 1 - k];
            ends[base->count + i] = first + end;
        }
        const sl_shape both[2] = {*base, {points, ends, base->count + off->count}};
        status = join(context, both, 2, 2, out);
    }
    sl_free(context, points);
    sl_free(context, ends);
    return status;
}

/// Adds what is in range of the set's points, each a piece of its own. All between them is nearer.
static sl_status add_circles(maker *m) {
    const sl_set_sight *s = m->sight;
    for (size_t i = 0; i < s->count; i++) {
        SL_TRY(sli_add_circle(m->context, s, s->points[i], &m->eyes));
        SL_TRY(end_piece(m));
    }
    return SL_OK;
}

static sl_status join_complete(maker *m, sl_shape *out) {
    const size_t count = m->pieces.count;
    sl_shape all = {0}, off = {0};
    if (m->through || !count) return SL_OK;
    sl_shape *shapes = sl_alloc_array(m->context, count, sizeof *shapes);
    if (!shapes) return SL_NO_MEMORY;
    size_t loop = 0;
    sl_status status = SL_OK;
    size_t *ends = sl_alloc_array(m->context, m->eyes.ends.count + 1, sizeof *ends);
    if (!ends) status = SL_NO_MEMORY;
    for (size_t i = 0; i < count && status == SL_OK; i++) {
        const size_t first = loop, begin = first ? m->eyes.ends.items[first - 1] : 0;
        for (; loop < m->pieces.items[i]; loop++) ends[loop] = m->eyes.ends.items[loop] - begin;
        shapes[i] = (sl_shape){m->eyes.points.items + begin, ends + first, loop - first};
    }
    if (status == SL_OK) status = join(m->context, shapes, count, count, &all);
    const sl_shape cones = shape_of(&m->cones);
    if (status == SL_OK) status = join(m->context, &cones, 1, 1, &off);
    if (status == SL_OK) status = subtract(m->context, &all, &off, out);
    sl_shape_destroy(m->context, &all);
    sl_shape_destroy(m->context, &off);
    sl_free(m->context, shapes);
    sl_free(m->context, ends);
    return status;
}

/// Twice the area of a loop, and its length.
static double measure(const sl_point *p, size_t count, double *length) {
    double twice = 0;
    *length = 0;
    for (size_t i = 0; i < count; i++) {
        const sl_point a = p[i], b = p[i + 1 < count ? i + 1 : 0];
        twice += (a.x - p[0].x) * (b.y - p[0].y) - (a.y - p[0].y) * (b.x - p[0].x);
        *length += sli_length(b.x - a.x, b.y - a.y);
    }
    return twice;
}

/// Keeps loops that are not thinner than what rounding leaves, and adds up their area.
static sl_status finish(maker *m, const sl_shape *shape, sl_set_region *out) {
    const sl_box *b = &m->sight->rooms.outline->space->bounds;
    const double reach = sli_greater(sli_greater(fabs(b->min.x), fabs(b->max.x)),
                                     sli_greater(fabs(b->min.y), fabs(b->max.y)));
    const size_t count = shape->count ? shape->ends[shape->count - 1] : 0;
    sl_point *points = sl_alloc_array(m->context, count + 1, sizeof *points);
    size_t *ends = sl_alloc_array(m->context, shape->count + 1, sizeof *ends);
    size_t kept = 0, loops = 0;
    for (size_t i = 0; points && ends && i < shape->count; i++) {
        const size_t begin = i ? shape->ends[i - 1] : 0;
        double length;
        const double twice = measure(shape->points + begin, shape->ends[i] - begin, &length);
        if (fabs(twice) <= length * reach * 0x1p-44) continue;
        for (size_t k = begin; k < shape->ends[i]; k++) points[kept++] = shape->points[k];
        ends[loops++] = kept;
        out->area += twice / 2;
    }
    out->shape = (sl_shape){points, ends, loops};
    return points && ends ? SL_OK : SL_NO_MEMORY;
}

sl_status sl_set_sight_region(sl_context *context, sl_set_sight *sight, sl_set_seen seen,
                              sl_set_region *out) {
    maker m = {.context = context, .sight = sight, .seen = seen};
    sl_shape joined = {0};
    sl_set_region_destroy(context, out);
    sight->within = seen == SL_SEEN_FROM_SOME ? sight->range : 0;
    sl_status status = add_parts(&m);
    if (status == SL_OK && seen == SL_SEEN_FROM_ALL && sight->range > 0 && m.pieces.count)
        status = add_circles(&m);
    const sl_shape parts = shape_of(&m.cones);
    if (status == SL_OK)
        status = seen == SL_SEEN_FROM_SOME ? join(context, &parts, 1, 1, &joined)
                                           : join_complete(&m, &joined);
    if (status == SL_OK) status = finish(&m, &joined, out);
    out->walled = m.through;
    out->cones = m.cones.cones;
    out->corners = m.cones.points.count + m.eyes.points.count;
    if (status != SL_OK) sl_set_region_destroy(context, out);
    sl_shape_destroy(context, &joined);
    sli_parts_destroy(context, &m.eyes);
    sli_parts_destroy(context, &m.cones);
    sl_free(context, m.pieces.items);
    sl_free(context, m.cuts.items);
    sl_free(context, m.along.items);
    return status;
}

void sl_set_region_destroy(sl_context *context, sl_set_region *region) {
    sl_shape_destroy(context, &region->shape);
    *region = (sl_set_region){0};
}

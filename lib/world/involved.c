/// Which walls an edit has to do with.
///
/// Walls that cross or touch are cut there, and the place is rounded where they are oblique. So a
/// wall that comes or goes may cut or bend others, which may then touch yet others. The walls
/// involved are found by two steps, until neither finds more:
///
/// - A wall is involved if it shares a corner with one that is, and the corner is not an end of
///   both: they cut each other there before.
/// - A wall is involved if it meets the segment or the new pieces of one that is, other than in an
///   end of both: they cut each other there now. If it is cut there already, at a place that
///   rounding has not moved off it, nothing changes.
///
/// Then the graph of the walls involved is made (map/planar.h). As nothing else meets them, it is
/// the same as their part of the graph of all walls.
///
/// What a segment meets is found by a flood over the triangles that it meets. The graph is made in
/// rounds, and walls are bent by a few steps of doubles in between. So what comes nearer than that
/// counts as met. One too many costs time and changes nothing.
#include "world/world.h"

#include "geometry/length.h"
#include "geometry/orient.h"

static sl_status involve(sl_world *s, uint32_t line) {
    if (s->lines.items[line].mark == s->now) return SL_OK;
    SL_TRY(sli_numbers_push(s->context, &s->involved, line));
    s->lines.items[line].mark = s->now;
    return SL_OK;
}

// --- what a segment meets

static bool overlap(double a, double b, double c, double d) {
    return fmax(fmin(a, b), fmin(c, d)) <= fmin(fmax(a, b), fmax(c, d));
}

/// Whether two closed segments have a point in common.
static bool meets(sl_segment s, sl_point c, sl_point d) {
    const int ac = sli_orient(s.a, s.b, c), ad = sli_orient(s.a, s.b, d);
    if (ac * ad > 0) return false;
    const int ca = sli_orient(c, d, s.a), cb = sli_orient(c, d, s.b);
    if (ca * cb > 0) return false;
    if (ac || ad || ca || cb) return true;
    return overlap(s.a.x, s.b.x, c.x, d.x) && overlap(s.a.y, s.b.y, c.y, d.y);
}

/// Whether q and r lie in one direction from p, if all are on a line.
static bool same_way(sl_point p, sl_point q, sl_point r) {
    return (q.x > p.x) == (r.x > p.x) && (q.x < p.x) == (r.x < p.x) && (q.y > p.y) == (r.y > p.y) &&
           (q.y < p.y) == (r.y < p.y);
}

/// Whether segments that meet do so other than in one end of both.
static bool meets_within(sl_segment s, sl_point c, sl_point d) {
    const bool ac = sli_same_point(s.a, c), ad = sli_same_point(s.a, d);
    const bool bc = sli_same_point(s.b, c), bd = sli_same_point(s.b, d);
    if (!ac && !ad && !bc && !bd) return true;
    const sl_point p = ac || ad ? s.a : s.b, q = ac || ad ? s.b : s.a, r = ac || bc ? d : c;
    return sli_orient(p, q, r) == 0 && same_way(p, q, r);
}

static sl_status reach(sl_world *s, uint32_t half) {
    sli_live *l = &s->live;
    const uint32_t triangle = sli_live_triangle(l, half);
    if (l->mark[triangle] == l->now) return SL_OK;
    SL_TRY(sli_numbers_push(s->context, &s->flood, triangle));
    l->mark[triangle] = l->now;
    return SL_OK;
}

static sl_status involve_uses(sl_world *s, uint32_t label) {
    for (uint32_t use = label; use; use = s->uses.items[use - 1].next)
        SL_TRY(involve(s, s->uses.items[use - 1].line));
    return SL_OK;
}

static bool is_end(sl_segment at, sl_point p) {
    return sli_same_point(at.a, p) || sli_same_point(at.b, p);
}

/// Involves the walls of an edge that a segment meets in an end of both, at a place off the wall.
static sl_status involve_cut(sl_world *s, uint32_t label, sl_point at) {
    for (uint32_t use = label; use; use = s->uses.items[use - 1].next) {
        const uint32_t line = s->uses.items[use - 1].line;
        const sl_segment wall = s->lines.items[line].at;
        if (!is_end(wall, at) && sli_orient(wall.a, wall.b, at) != 0) SL_TRY(involve(s, line));
    }
    return SL_OK;
}

static double distance(sl_point at, sl_point a, sl_point b) {
    const sl_point d = {b.x - a.x, b.y - a.y}, o = {at.x - a.x, at.y - a.y};
    const double square = d.x * d.x + d.y * d.y;
    const double share = square > 0 ? fmin(1, fmax(0, (o.x * d.x + o.y * d.y) / square)) : 0;
    return sli_length(o.x - share * d.x, o.y - share * d.y);
}

/// Whether an end of one of two segments is near the other one.
static bool is_near(sl_segment s, sl_point c, sl_point d, double tolerance) {
    return distance(s.a, c, d) <= tolerance || distance(s.b, c, d) <= tolerance ||
           distance(c, s.a, s.b) <= tolerance || distance(d, s.a, s.b) <= tolerance;
}

/// The same, but for an end of both.
static bool is_near_within(sl_segment s, sl_point c, sl_point d, double tolerance) {
    const bool a = sli_same_point(s.a, c) || sli_same_point(s.a, d);
    const bool b = sli_same_point(s.b, c) || sli_same_point(s.b, d);
    const bool at_c = sli_same_point(c, s.a) || sli_same_point(c, s.b);
    const bool at_d = sli_same_point(d, s.a) || sli_same_point(d, s.b);
    return (!a && distance(s.a, c, d) <= tolerance) || (!b && distance(s.b, c, d) <= tolerance) ||
           (!at_c && distance(c, s.a, s.b) <= tolerance) ||
           (!at_d && distance(d, s.a, s.b) <= tolerance);
}

/// Farther than rounding bends a wall.
static double tolerance_of(const sl_box *b) {
    return 64 * DBL_EPSILON *
           fmax(fmax(fabs(b->min.x), fabs(b->max.x)), fmax(fabs(b->min.y), fabs(b->max.y)));
}

/// Involves what a segment meets.
static sl_status involve_met(sl_world *s, sl_segment at) {
    sli_live *l = &s->live;
    const double tolerance = tolerance_of(&l->space.bounds);
    bool on;
    sli_live_next_mark(l);
    s->flood.count = 0;
    sli_live_go_near(l, at.a);
    SL_TRY(reach(s, sli_triangulator_walk(&l->maker, at.a, &on)));
    for (size_t i = 0; i < s->flood.count; i++) {
        uint32_t half = s->flood.items[i];
        for (int k = 0; k < 3; k++, half = sli_live_next(l, half)) {
            const sl_point c = sli_live_start(l, half), d = sli_live_end(l, half);
            const uint32_t label = l->triangles.labels[half / 2];
            const bool met = meets(at, c, d);
            if (!met && !is_near(at, c, d, tolerance)) continue;
            if (!sli_half_is_outside(&l->triangles, half ^ 1)) SL_TRY(reach(s, half ^ 1));
            if (label && ((met && meets_within(at, c, d)) || is_near_within(at, c, d, tolerance)))
                SL_TRY(involve_uses(s, label));
            else if (label && met)
                SL_TRY(involve_cut(s, label, is_end(at, c) ? c : d));
        }
    }
    return SL_OK;
}

// --- what a chain shares corners with

static bool is_end_of(const sl_world *s, uint32_t line, uint32_t point) {
    const sli_world_line *l = &s->lines.items[line];
    return s->points[l->first] == point || s->points[l->first + l->count - 1] == point;
}

static sl_status involve_at(sl_world *s, uint32_t line, uint32_t point) {
    const sli_triangulation *t = &s->live.triangles;
    const bool end = is_end_of(s, line, point);
    const uint32_t first = t->out[point];
    uint32_t half = first;
    do {
        for (uint32_t use = t->labels[half / 2]; use; use = s->uses.items[use - 1].next) {
            const uint32_t other = s->uses.items[use - 1].line;
            if (!end || !is_end_of(s, other, point)) SL_TRY(involve(s, other));
        }
        half = sli_half_around(t, half);
    } while (half != first);
    return SL_OK;
}

static sl_status involve_around(sl_world *s, uint32_t line) {
    const sli_world_line at = s->lines.items[line];
    for (uint32_t i = 0; i < at.count; i++) SL_TRY(involve_at(s, line, s->points[at.first + i]));
    return at.next_stands ? involve_met(s, at.next_at) : SL_OK;
}

// --- the new chains

static sl_status add_corner(sl_world *s, sl_point at) {
    SL_TRY(SL_ARRAY_ROOM(s->context, &s->corners, 1));
    s->corners.items[s->corners.count++] = at;
    return SL_OK;
}

static sl_status take_chain(sl_world *s, const sli_planar *graph, size_t segment) {
    for (size_t k = graph->first[segment]; k < graph->first[segment + 1]; k++) {
        const sl_segment at = sli_planar_at(graph, graph->links[k]);
        if (k == graph->first[segment]) SL_TRY(add_corner(s, at.a));
        SL_TRY(add_corner(s, at.b));
    }
    return SL_OK;
}

static sl_status make_chains(sl_world *s) {
    sli_planar graph = {0};
    s->segments.count = s->corners.count = s->first_corner.count = 0;
    for (size_t i = 0; i < s->involved.count; i++) {
        const sli_world_line *line = &s->lines.items[s->involved.items[i]];
        if (!line->next_stands) continue;
        SL_TRY(SL_ARRAY_ROOM(s->context, &s->segments, 1));
        s->segments.items[s->segments.count++] = line->next_at;
    }
    if (s->segments.count > 1)
        SL_TRY(sli_planar_make(s->context, "the world", s->segments.items, s->segments.count, 0,
                               &graph));
    size_t segment = 0;
    sl_status status = SL_OK;
    for (size_t i = 0; i < s->involved.count && status == SL_OK; i++) {
        const sli_world_line *line = &s->lines.items[s->involved.items[i]];
        status = sli_numbers_push(s->context, &s->first_corner, (uint32_t)s->corners.count);
        if (status != SL_OK || !line->next_stands) continue;
        if (s->segments.count > 1) {
            status = take_chain(s, &graph, segment++);
            continue;
        }
        status = add_corner(s, line->next_at.a);
        if (status == SL_OK) status = add_corner(s, line->next_at.b);
    }
    if (status == SL_OK)
        status = sli_numbers_push(s->context, &s->first_corner, (uint32_t)s->corners.count);
    sli_planar_destroy(s->context, &graph);
    return status;
}

/// Involves what bent pieces meet.
static sl_status involve_bent(sl_world *s) {
    for (size_t i = 0; i + 1 < s->first_corner.count; i++) {
        const uint32_t first = s->first_corner.items[i], stop = s->first_corner.items[i + 1];
        for (uint32_t k = first; k + 1 < stop && stop - first > 2; k++)
            SL_TRY(involve_met(s, (sl_segment){s->corners.items[k], s->corners.items[k + 1]}));
    }
    return SL_OK;
}

sl_status sli_world_involve(sl_world *s) {
    size_t looked = 0, chained;
    s->now++;
    s->involved.count = 0;
    for (size_t i = 0; i < s->pending.count; i++) SL_TRY(involve(s, s->pending.items[i]));
    do {
        for (; looked < s->involved.count; looked++)
            SL_TRY(involve_around(s, s->involved.items[looked]));
        SL_TRY(make_chains(s));
        chained = s->involved.count;
        SL_TRY(involve_bent(s));
    } while (chained < s->involved.count);
    return SL_OK;
}

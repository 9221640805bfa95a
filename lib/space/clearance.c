/// Clearances, by the triangles between walls. The nearest wall of a point is found through the
/// sides of triangles that are nearer than the best wall so far. The clearance changes by no more
/// than one goes, so a triangle whose middle has clearance c has none above c + r, where r is its
/// radius. Nor has it any above the largest distance of a corner from the wall that is nearest to
/// the middle, as distances from a segment are convex: so slivers between walls are not cut on and
/// on. The search for a place with more cuts triangles in four until that decides.
#include "space/clearance.h"

#include "geometry/length.h"
#include "geometry/orient.h"

sl_status sli_clearance_make(sl_context *context, const sli_channels *channels,
                             sli_clearance *out) {
    *out = (sli_clearance){.context = context, .channels = channels};
    out->seen = sl_alloc_array(context, channels->triangles.halves.count, sizeof *out->seen);
    return out->seen ? SL_OK : SL_NO_MEMORY;
}

void sli_clearance_destroy(sli_clearance *c) {
    sl_free(c->context, c->seen);
    sl_free(c->context, c->stack.items);
    *c = (sli_clearance){0};
}

static double apart(sl_point a, sl_point b) {
    return sli_length(b.x - a.x, b.y - a.y);
}

static double to_segment(sl_point p, sl_point a, sl_point b) {
    const sl_point d = {b.x - a.x, b.y - a.y}, w = {p.x - a.x, p.y - a.y};
    const double length = sli_length(d.x, d.y);
    if (!(length > 0)) return apart(p, a);
    const sl_point unit = {d.x / length, d.y / length};
    const double along = sli_dot(w, unit);
    if (along <= 0) return apart(p, a);
    if (along >= length) return apart(p, b);
    return fabs(sli_cross(unit, w));
}

static sl_point start_of(const sli_clearance *c, uint32_t half) {
    const sli_triangulation *t = &c->channels->triangles;
    return t->points.items[t->halves.items[half].from];
}

static sl_status push_half_edge(sli_clearance *c, uint32_t half) {
    SL_TRY(SL_ARRAY_ROOM(c->context, &c->stack, 1));
    c->stack.items[c->stack.count++] = half;
    return SL_OK;
}

/// The distance from a point to the nearest wall that it can be reached from, rounded; `most` if
/// that is less. `half` is a half-edge of the triangle that holds the point. `wall`, where not
/// NULL, gets that wall, if it is nearer.
static sl_status clearance_at(sli_clearance *c, uint32_t half, sl_point point, double most,
                              double *out, sl_segment *wall) {
    const sli_triangulation *t = &c->channels->triangles;
    double best = most;
    sl_segment nearest = {point, point};
    c->stamp++;
    SL_TRY(push_half_edge(c, half));
    while (c->stack.count) {
        uint32_t side = c->stack.items[--c->stack.count];
        if (c->seen[side] == c->stamp) continue;
        // A wall that hides an end is nearer than the end, and is found.
        for (int i = 0; i < 3; i++, side = t->halves.items[side].next) {
            const sl_point corner = start_of(c, side);
            if (!sl_bits_has(c->channels->solid, t->halves.items[side].from)) continue;
            if (!(apart(point, corner) < best)) continue;
            best = apart(point, corner);
            nearest = (sl_segment){corner, corner};
        }
        for (int i = 0; i < 3; i++, side = t->halves.items[side].next) {
            c->seen[side] = c->stamp;
            const uint32_t twin = side ^ 1;
            const sl_segment at = {start_of(c, side), start_of(c, twin)};
            const double distance = to_segment(point, at.a, at.b);
            const bool is_wall = c->channels->label[side / 2] == SLI_WALL;
            if (!(distance < best) && !(is_wall && distance == best)) continue;
            if (is_wall) {
                best = distance;
                nearest = at;
            } else if (!sli_half_is_outside(t, twin) && c->seen[twin] != c->stamp) {
                SL_TRY(push_half_edge(c, twin));
            }
        }
    }
    if (wall) *wall = nearest;
    *out = best;
    return SL_OK;
}

typedef struct triangle {
    sl_point corner[3];
} triangle;

static triangle corners_of(const sli_clearance *c, uint32_t half) {
    const sli_half_edge *halves = c->channels->triangles.halves.items;
    const uint32_t second = halves[half].next, third = halves[second].next;
    return (triangle){{start_of(c, half), start_of(c, second), start_of(c, third)}};
}

static sl_point middle_of(const triangle *t) {
    const sl_point *p = t->corner;
    return (sl_point){p[0].x / 3 + p[1].x / 3 + p[2].x / 3, p[0].y / 3 + p[1].y / 3 + p[2].y / 3};
}

static bool holds(const triangle *t, sl_point p) {
    return sli_orient(t->corner[0], t->corner[1], p) >= 0 &&
           sli_orient(t->corner[1], t->corner[2], p) >= 0 &&
           sli_orient(t->corner[2], t->corner[0], p) >= 0;
}

/// The middle of the circle through the corners.
static sl_point circle_middle(const triangle *t) {
    const sl_point a = t->corner[0];
    const sl_point b = {t->corner[1].x - a.x, t->corner[1].y - a.y};
    const sl_point d = {t->corner[2].x - a.x, t->corner[2].y - a.y};
    const double twice = 2 * sli_cross(b, d), b2 = sli_dot(b, b), d2 = sli_dot(d, d);
    return (sl_point){a.x + (d.y * b2 - b.y * d2) / twice, a.y + (b.x * d2 - d.x * b2) / twice};
}

sl_status sli_clearance_of(sli_clearance *c, uint32_t half, sl_point *place, double *out) {
    const triangle t = corners_of(c, half);
    const sl_point tried[2] = {middle_of(&t), circle_middle(&t)};
    *out = -1;
    for (int i = 0; i < 2; i++) {
        double own;
        if (!holds(&t, tried[i])) continue;
        SL_TRY(clearance_at(c, half, tried[i], INFINITY, &own, NULL));
        if (own <= *out) continue;
        *out = own;
        *place = tried[i];
    }
    return SL_OK;
}

/// A limit for all of a triangle, by the walls at its sides and the ends at its corners.
static double limit_of(const sli_clearance *c, uint32_t half) {
    const sli_channels *channels = c->channels;
    const triangle t = corners_of(c, half);
    double least = INFINITY, longest = 0;
    bool ends = true;
    for (int i = 0; i < 3; i++, half = channels->triangles.halves.items[half].next) {
        const sl_point a = t.corner[i], b = t.corner[(i + 1) % 3];
        if (channels->label[half / 2] == SLI_WALL)
            least = fmin(least, to_segment(t.corner[(i + 2) % 3], a, b));
        longest = fmax(longest, apart(a, b));
        ends &= sl_bits_has(channels->solid, channels->triangles.halves.items[half].from);
    }
    // Half of the longest side, if that is the diameter; more only for acute triangles.
    return ends ? fmin(least, 0.578 * longest) : least;
}

/// So many parts of a triangle are looked at: a sliver among corners has any number of them.
enum { MOST_PARTS = 1 << 15 };

static sl_status search(sli_clearance *c, uint32_t half, const triangle *t, double wanted,
                        uint32_t *parts_left, sl_point *place, bool *out) {
    const sl_point middle = middle_of(t);
    double own, radius = 0, farthest = 0;
    sl_segment wall;
    for (int i = 0; i < 3; i++) radius = fmax(radius, apart(middle, t->corner[i]));
    SL_TRY(clearance_at(c, half, middle, wanted + radius, &own, &wall));
    *out = own >= wanted;
    if (*out) *place = middle;
    if (!*parts_left || !--*parts_left) return SL_OK;
    if (*out || own + radius < wanted || radius < wanted / 16) return SL_OK;
    for (int i = 0; i < 3; i++) farthest = fmax(farthest, to_segment(t->corner[i], wall.a, wall.b));
    if (farthest < wanted) return SL_OK;
    const sl_point *p = t->corner;
    sl_point m[3];
    for (int i = 0; i < 3; i++)
        m[i] = (sl_point){p[i].x / 2 + p[(i + 1) % 3].x / 2, p[i].y / 2 + p[(i + 1) % 3].y / 2};
    const triangle parts[4] = {
        {{m[0], m[1], m[2]}}, {{p[0], m[0], m[2]}}, {{m[0], p[1], m[1]}}, {{m[2], m[1], p[2]}}};
    for (int i = 0; i < 4 && !*out; i++)
        SL_TRY(search(c, half, &parts[i], wanted, parts_left, place, out));
    return SL_OK;
}

sl_status sli_clearance_reaches(sli_clearance *c, uint32_t half, double wanted, sl_point *place,
                                bool *out) {
    *out = false;
    if (limit_of(c, half) < wanted) return SL_OK;
    const triangle t = corners_of(c, half);
    uint32_t parts_left = MOST_PARTS;
    return search(c, half, &t, wanted, &parts_left, place, out);
}

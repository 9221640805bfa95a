/// Clearances, by the walls of channels. The wall that is nearest to a place, of all walls, can be
/// reached from there: a wall between would be nearer. So a tree of boxes finds it, however many
/// channels lie around, in about O(log n). No more than a wall as near as `least` is looked for
/// where places count that are farther; and the wall found last is tried first. So most triangles
/// of a group take one look.
///
/// The clearance changes by no more than one goes, so a triangle whose middle has clearance c has
/// none above c + r, where r is its radius. Nor has it any above the largest distance of a corner
/// from the wall that is nearest to the middle, as distances from a segment are convex: so slivers
/// between walls are not cut on and on. The search for a place with more cuts triangles in four
/// until that decides. A sliver as long as n times the clearance wanted may have so n² parts, but
/// only about n if it is cut across its longest side: so that is tried first where it may show that
/// there is no place, and last where there are too many parts.
#include "space/clearance.h"

#include "geometry/length.h"
#include "geometry/orient.h"

enum { STEPS_A_QUESTION = 1 << 16 };

sl_status sli_clearance_make(sl_context *context, const sli_channels *channels,
                             sli_clearance *out) {
    const sli_triangulation *t = &channels->triangles;
    const size_t edges = t->halves.count / 2;
    size_t count = 0;
    *out = (sli_clearance){.context = context, .channels = channels};
    for (size_t i = 0; i < edges; i++) count += channels->label[i] == SLI_WALL;
    sl_box *boxes = sl_alloc_array(context, count, sizeof *boxes);
    out->walls = sl_alloc_array(context, count, sizeof *out->walls);
    sl_status status = boxes && out->walls ? SL_OK : SL_NO_MEMORY;
    count = 0;
    for (uint32_t i = 0; status == SL_OK && i < edges; i++) {
        if (channels->label[i] != SLI_WALL) continue;
        const sli_half_edge *halves = &t->halves.items[2 * (size_t)i];
        boxes[count] =
            sli_box_around(t->points.items[halves[0].from], t->points.items[halves[1].from]);
        out->walls[count++] = i;
    }
    if (status == SL_OK) status = sli_box_tree_create(context, boxes, count, &out->tree);
    if (count && status == SL_OK) out->last = out->walls[0];
    sl_free(context, boxes);
    return status;
}

void sli_clearance_destroy(sli_clearance *c) {
    sl_free(c->context, c->walls);
    sli_box_tree_destroy(c->context, &c->tree);
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

/// A search for the wall that is nearest to a point.
typedef struct nearest_wall {
    sli_clearance *c;
    sl_point point;
    double best;
    sl_segment at; ///< the wall, or its end, twice
} nearest_wall;

/// Looks at one wall, from the side on which the point is.
static void look_at_edge(nearest_wall *n, uint32_t edge) {
    sl_point a = start_of(n->c, 2 * edge), b = start_of(n->c, 2 * edge + 1);
    const sl_point p = n->point;
    if (sli_cross((sl_point){b.x - a.x, b.y - a.y}, (sl_point){p.x - a.x, p.y - a.y}) < 0) {
        const sl_point start = a;
        a = b;
        b = start;
    }
    n->c->steps++;
    const double distance = to_segment(p, a, b), ends[2] = {apart(p, a), apart(p, b)};
    for (int i = 0; i < 2; i++) {
        if (!(ends[i] < n->best)) continue;
        n->best = ends[i];
        n->at = i ? (sl_segment){b, b} : (sl_segment){a, a};
        n->c->last = edge;
    }
    if (!(distance <= n->best)) return;
    n->best = distance;
    n->at = (sl_segment){a, b};
    n->c->last = edge;
}

static void look_at_wall(void *user, uint32_t box) {
    nearest_wall *n = user;
    look_at_edge(n, n->c->walls[box]);
}

/// The distance from a point to the nearest wall, rounded; `most` if that is less. As soon as it is
/// not above `least`, it may be that of any wall. `wall`, where not NULL, gets the wall, if it is
/// nearer.
static sl_status clearance_at(sli_clearance *c, sl_point point, double least, double most,
                              double *out, sl_segment *wall) {
    nearest_wall n = {c, point, most, {point, point}};
    if (c->tree.levels) look_at_edge(&n, c->last);
    if (n.best > least) c->steps += sli_box_tree_near(&c->tree, point, &n.best, look_at_wall, &n);
    if (wall) *wall = n.at;
    *out = n.best;
    if (c->steps - c->asked < STEPS_A_QUESTION) return SL_OK;
    c->asked = c->steps;
    return sl_check_cancelled(c->context);
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

sl_status sli_clearance_of(sli_clearance *c, uint32_t half, double least, sl_point *place,
                           double *out) {
    const triangle t = corners_of(c, half);
    const sl_point tried[2] = {middle_of(&t), circle_middle(&t)};
    *out = -1;
    for (int i = 0; i < 2; i++) {
        double own;
        if (!holds(&t, tried[i])) continue;
        SL_TRY(clearance_at(c, tried[i], fmax(least, *out), INFINITY, &own, NULL));
        if (own <= *out || own <= least) continue;
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

/// So many parts of a triangle are looked at in each of two ways.
enum { MOST_PARTS = 1 << 15 };

/// A search for a place in a triangle.
typedef struct place_search {
    sli_clearance *c;
    double wanted;
    bool halves; ///< parts are cut in two across the longest side; else in four
    bool proves; ///< ends as soon as it is not plain that there is no place
    uint32_t parts_left;
    bool found, close; ///< `close`: a part was too small to be cut
    sl_point place;
} place_search;

/// Cuts a triangle into the parts to look at next, and returns their count.
static int cut(const triangle *t, bool halves, triangle parts[4]) {
    const sl_point *p = t->corner;
    sl_point m[3];
    for (int i = 0; i < 3; i++)
        m[i] = (sl_point){p[i].x / 2 + p[(i + 1) % 3].x / 2, p[i].y / 2 + p[(i + 1) % 3].y / 2};
    if (halves) {
        int longest = 0;
        for (int i = 1; i < 3; i++)
            if (apart(p[i], p[(i + 1) % 3]) > apart(p[longest], p[(longest + 1) % 3])) longest = i;
        const sl_point a = p[longest], b = p[(longest + 1) % 3], c = p[(longest + 2) % 3];
        parts[0] = (triangle){{a, m[longest], c}};
        parts[1] = (triangle){{m[longest], b, c}};
        return 2;
    }
    parts[0] = (triangle){{m[0], m[1], m[2]}};
    parts[1] = (triangle){{p[0], m[0], m[2]}};
    parts[2] = (triangle){{m[0], p[1], m[1]}};
    parts[3] = (triangle){{m[2], m[1], p[2]}};
    return 4;
}

static sl_status search(place_search *s, const triangle *t) {
    const sl_point middle = middle_of(t);
    const double wanted = s->wanted;
    double own, radius = 0, farthest = 0;
    sl_segment wall;
    triangle parts[4];
    if (!s->parts_left) return SL_OK;
    s->parts_left--;
    for (int i = 0; i < 3; i++) radius = fmax(radius, apart(middle, t->corner[i]));
    SL_TRY(clearance_at(s->c, middle, -1, wanted + radius, &own, &wall));
    s->found = own >= wanted;
    if (s->found) s->place = middle;
    if (s->found || own + radius < wanted) return SL_OK;
    if (radius < wanted / 16) {
        s->close = true;
        return SL_OK;
    }
    for (int i = 0; i < 3; i++) farthest = fmax(farthest, to_segment(t->corner[i], wall.a, wall.b));
    if (farthest < wanted) return SL_OK;
    const int count = cut(t, s->halves, parts);
    for (int i = 0; i < count && !s->found && !(s->proves && s->close); i++)
        SL_TRY(search(s, &parts[i]));
    return SL_OK;
}

/// Whether a triangle is so long that to cut it in four gives very many parts.
static bool is_long(const triangle *t, double wanted) {
    return apart(t->corner[0], t->corner[1]) + apart(t->corner[1], t->corner[2]) > 32 * wanted;
}

sl_status sli_clearance_reaches(sli_clearance *c, uint32_t half, double wanted, sl_point *place,
                                bool *out) {
    *out = false;
    if (limit_of(c, half) < wanted) return SL_OK;
    const triangle t = corners_of(c, half);
    const place_search by_halves = {
        .c = c, .wanted = wanted, .halves = true, .parts_left = MOST_PARTS};
    place_search s = by_halves;
    s.proves = true;
    if (is_long(&t, wanted)) SL_TRY(search(&s, &t));
    if (s.parts_left && s.parts_left < MOST_PARTS && !s.found && !s.close) return SL_OK;
    s = (place_search){.c = c, .wanted = wanted, .parts_left = MOST_PARTS};
    SL_TRY(search(&s, &t));
    if (!s.found && !s.parts_left) {
        s = by_halves;
        SL_TRY(search(&s, &t));
        c->cut_short += !s.found && !s.parts_left;
    }
    *out = s.found;
    if (s.found) *place = s.place;
    return SL_OK;
}

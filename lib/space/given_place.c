/// Where the corners of given cells go, and how those that are still bent are cut.
///
/// Cells that meet in a place and reach each other there through portals share one corner. One on a
/// wall is moved to the wall's line or behind it, as seen from these cells: whatever comes up to
/// the wall from its front is then within a cell, and the cell ends nowhere before its wall does.
#include "space/given.h"

#include <math.h>
#include <stdlib.h>

typedef struct placer {
    sl_given *given;
    uint32_t *first;  ///< by face: its first corner's number; one more at the end
    uint32_t *leader; ///< by corner: another one of the same place; its own number for the last
    uint32_t *order;  ///< corners, those of one place together
} placer;

static sl_bsp_sides *sides_of(const placer *p, size_t face) {
    return &p->given->bsp.faces.items[face].sides;
}

// --- corners that are one

static uint32_t leader_of(const placer *p, uint32_t corner) {
    while (p->leader[corner] != corner) {
        p->leader[corner] = p->leader[p->leader[corner]];
        corner = p->leader[corner];
    }
    return corner;
}

static void unite(const placer *p, uint32_t a, uint32_t b) {
    a = leader_of(p, a);
    b = leader_of(p, b);
    p->leader[a > b ? a : b] = a > b ? b : a;
}

static uint32_t corner_of(const placer *p, size_t face, size_t side) {
    return p->first[face] + (uint32_t)(side % sides_of(p, face)->count);
}

static void unite_portals(const placer *p) {
    for (size_t f = 0; f < p->given->bsp.faces.count; f++) {
        const sl_bsp_sides *sides = sides_of(p, f);
        for (size_t i = 0; i < sides->count; i++) {
            const sl_bsp_side *side = &sides->items[i];
            if (side->what != SL_BEYOND_EXIT || side->beyond < f) continue;
            const size_t twin = sl_bsp_find_side(&p->given->bsp.faces.items[side->beyond],
                                                 sl_side_end(sides, i), side->from, (uint32_t)f);
            if (twin == SIZE_MAX) continue;
            unite(p, corner_of(p, f, i), corner_of(p, side->beyond, twin + 1));
            unite(p, corner_of(p, f, i + 1), corner_of(p, side->beyond, twin));
        }
    }
}

// --- moving them

enum { MOST_WALLS = 16 };

/// The walls that meet in a place, each with the hand at which its cell is.
typedef struct meeting {
    sl_point at;
    const sl_wall *walls[MOST_WALLS];
    bool reversed[MOST_WALLS];
    size_t count;
    bool fixed; ///< one of the walls ends here
} meeting;

static void add_wall(const placer *p, meeting *m, const sl_bsp_side *side) {
    if (side->what >= SL_BEYOND_BORDER) return;
    const sl_wall *wall = &p->given->map->walls[side->what];
    m->fixed |= sl_same_point(wall->a, m->at) || sl_same_point(wall->b, m->at);
    for (size_t i = 0; i < m->count; i++)
        if (m->walls[i] == wall && m->reversed[i] == side->reversed) return;
    if (m->count == MOST_WALLS) return;
    m->reversed[m->count] = side->reversed;
    m->walls[m->count++] = wall;
}

static bool is_behind_all(const meeting *m, sl_point at) {
    for (size_t i = 0; i < m->count; i++)
        if (!sl_bsp_behind(m->walls[i], m->reversed[i], at)) return false;
    return true;
}

/// Away from the cells: the sum of the walls' normals.
static sl_point direction_behind(const meeting *m) {
    sl_point sum = {0, 0};
    for (size_t i = 0; i < m->count; i++) {
        const double dx = m->walls[i]->b.x - m->walls[i]->a.x;
        const double dy = m->walls[i]->b.y - m->walls[i]->a.y;
        const double length = (m->reversed[i] ? -1 : 1) * hypot(dx, dy);
        sum.x += dy / length;
        sum.y -= dx / length;
    }
    return sum;
}

static sl_point foot_on(const sl_wall *wall, sl_point at) {
    const double dx = wall->b.x - wall->a.x, dy = wall->b.y - wall->a.y;
    const double share = (dx * (at.x - wall->a.x) + dy * (at.y - wall->a.y)) / (dx * dx + dy * dy);
    return (sl_point){dx == 0 ? wall->a.x : wall->a.x + share * dx,
                      dy == 0 ? wall->a.y : wall->a.y + share * dy};
}

/// Where the lines of two walls of the meeting cross; what is on one wall's line where all its
/// walls are parallel.
static sl_point on_lines(const meeting *m) {
    const sl_wall *w = m->walls[0];
    const double ux = w->b.x - w->a.x, uy = w->b.y - w->a.y;
    for (size_t i = 1; i < m->count; i++) {
        const sl_wall *v = m->walls[i];
        const double vx = v->b.x - v->a.x, vy = v->b.y - v->a.y;
        const double cross = ux * vy - uy * vx;
        const double share = ((v->a.x - w->a.x) * vy - (v->a.y - w->a.y) * vx) / cross;
        if (share >= 0 && share <= 1) return (sl_point){w->a.x + share * ux, w->a.y + share * uy};
    }
    return foot_on(w, m->at);
}

/// The nearest place to the walls' lines that is behind all, in steps that double.
static bool find_behind(const meeting *m, sl_point *out) {
    enum { MOST_STEPS = 32 };
    const sl_point start = on_lines(m);
    const sl_point off = direction_behind(m);
    double step = 0, unit = fmax(fabs(start.x), fabs(start.y)) * 0x1p-53;
    for (int i = 0; i < MOST_STEPS; i++) {
        const sl_point at = {start.x + step * off.x, start.y + step * off.y};
        if (!sl_coordinate_usable(at.x) || !sl_coordinate_usable(at.y)) return false;
        if (is_behind_all(m, at)) {
            *out = at;
            return true;
        }
        step = step > 0 ? 2 * step : unit;
    }
    return false;
}

/// The corners order[from .. end) are one place.
static void move_place(const placer *p, const uint32_t *faces, size_t from, size_t end) {
    const uint32_t first = p->order[from];
    meeting m = {.at = sides_of(p, faces[first])->items[first - p->first[faces[first]]].from};
    for (size_t k = from; k < end; k++) {
        const uint32_t corner = p->order[k], face = faces[corner];
        const sl_bsp_sides *sides = sides_of(p, face);
        const size_t side = corner - p->first[face];
        add_wall(p, &m, &sides->items[side]);
        add_wall(p, &m, &sides->items[side ? side - 1 : sides->count - 1]);
    }
    sl_point to;
    if (m.fixed || !m.count || !find_behind(&m, &to)) return;
    for (size_t k = from; k < end; k++) {
        const uint32_t corner = p->order[k];
        sides_of(p, faces[corner])->items[corner - p->first[faces[corner]]].from = to;
    }
}

/// Sorts the corners by their places: each leader has the least number of its own.
static void sort_corners(const placer *p, uint32_t *ends, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) ends[leader_of(p, i)]++;
    uint32_t sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t own = ends[i];
        ends[i] = sum;
        sum += own;
    }
    for (uint32_t i = 0; i < count; i++) p->order[ends[leader_of(p, i)]++] = i;
}

static void move_all(const placer *p, const uint32_t *faces, uint32_t count) {
    for (uint32_t i = 0; i < count;) {
        uint32_t end = i + 1;
        while (end < count && leader_of(p, p->order[end]) == leader_of(p, p->order[i])) end++;
        move_place(p, faces, i, end);
        i = end;
    }
}

sl_status sl_given_place(sl_given *given) {
    sl_context *context = given->bsp.context;
    placer p = {.given = given};
    uint64_t total = 0;
    for (size_t f = 0; f < given->bsp.faces.count; f++)
        total += given->bsp.faces.items[f].sides.count;
    if (total > UINT32_MAX - 1) return sl_fail_memory(context);
    const uint32_t count = (uint32_t)total;
    p.first = sl_alloc_array(context, given->bsp.faces.count + 1, sizeof *p.first);
    p.leader = sl_alloc_array(context, count, sizeof *p.leader);
    p.order = sl_alloc_array(context, count, sizeof *p.order);
    uint32_t *faces = sl_alloc_array(context, count, sizeof *faces);
    uint32_t *ends = sl_alloc_array(context, count, sizeof *ends);
    const bool done = p.first && p.leader && p.order && faces && ends;
    if (done) {
        for (size_t f = 0; f < given->bsp.faces.count; f++) {
            p.first[f + 1] = p.first[f] + (uint32_t)given->bsp.faces.items[f].sides.count;
            for (uint32_t i = p.first[f]; i < p.first[f + 1]; i++) {
                faces[i] = (uint32_t)f;
                p.leader[i] = i;
            }
        }
        unite_portals(&p);
        sort_corners(&p, ends, count);
        move_all(&p, faces, count);
    }
    sl_free(context, p.first);
    sl_free(context, p.leader);
    sl_free(context, p.order);
    sl_free(context, faces);
    sl_free(context, ends);
    return done ? SL_OK : SL_NO_MEMORY;
}

// --- cutting

/// Corners from .. to of a face, closed by a side that is not known yet.
static sl_status copy_part(sl_context *context, const sl_bsp_sides *sides, size_t from, size_t to,
                           sl_bsp_sides *out) {
    for (size_t i = from; i != to; i = i + 1 == sides->count ? 0 : i + 1)
        SL_TRY(sl_bsp_add_side(context, out, sides->items[i]));
    const sl_bsp_side last = {
        .from = sides->items[to].from, .what = SL_BEYOND_BORDER, .beyond = SL_NO_FACE};
    return sl_bsp_add_side(context, out, last);
}

/// Cuts a face along a diagonal; the second part becomes the last face.
static sl_status cut_face(sl_given *given, uint32_t face, size_t from, size_t to) {
    sl_bsp *bsp = &given->bsp;
    sl_bsp_sides parts[2] = {0};
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &bsp->faces, 1));
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &given->of, 1));
    const sl_bsp_sides *sides = &bsp->faces.items[face].sides;
    sl_status status = copy_part(bsp->context, sides, from, to, &parts[0]);
    if (status == SL_OK) status = copy_part(bsp->context, sides, to, from, &parts[1]);
    if (status != SL_OK) {
        sl_free(bsp->context, parts[0].items);
        sl_free(bsp->context, parts[1].items);
        return status;
    }
    sl_free(bsp->context, bsp->faces.items[face].sides.items);
    bsp->faces.items[face].sides = parts[0];
    bsp->faces.items[bsp->faces.count++] = (sl_bsp_face){.sides = parts[1]};
    given->of.items[given->of.count++] = given->of.items[face];
    return SL_OK;
}

sl_status sl_given_cut(sl_given *given) {
    for (uint32_t f = 0; f < given->bsp.faces.count;) {
        const sl_bsp_sides *sides = &given->bsp.faces.items[f].sides;
        size_t from, to;
        if (sl_bsp_convex(sides)) {
            f++;
            continue;
        }
        if (given->bsp.faces.count > INT32_MAX / 2) return sl_fail_memory(given->bsp.context);
        if (sides->count < 4 || !sl_bsp_diagonal(sides, &from, &to))
            return sl_given_fail(given, f,
                                 "is bent so far that it cannot be cut into convex cells; it "
                                 "starts at %g %g",
                                 sides->items[0].from.x, sides->items[0].from.y);
        SL_TRY(cut_face(given, f, from, to));
    }
    return SL_OK;
}

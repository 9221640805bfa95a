/// The check of a whole mesh, by exact signs and comparisons.
///
/// The sides of cells prove that the cells tile the bounds. A convex, counter-clockwise cell winds
/// once around each of its points. A side that is not on the border has exactly one partner, a side
/// of another cell that runs the other way between the same two ends:
///
///     +-----<-----+-----<-----+       the two cancel; the sides on the border make up the border,
///     |           ^|          |       once; so the sum of all cells winds around each point of the
///     v           |v          ^       bounds as often as the border does, which is once
///     +----->-----+----->-----+
///
/// Time O(n log n), for sorting.
#include "geometry/orient.h"
#include "sightline/support.h"
#include "space/index.h"
#include "space/mesh.h"
#include "space/seams.h"

#include <stdlib.h>

typedef struct checker {
    sl_context *context;
    const sl_space *space;
    uint8_t *directed_found; ///< by portal, as in sli_check_directed
    uint8_t *sides_found;    ///< by wall: bit 1 for a cell at its left, bit 2 for one at its right
    uint8_t *on_border;      ///< by wall
} checker;

static sl_status fail_cell(const checker *c, uint32_t cell, const char *what) {
    return sl_fail(c->context, SL_BAD_INPUT, "cell %u %s", cell, what);
}

// --- cells

static bool goes_up(sl_point a, sl_point b) {
    return a.y < b.y || (a.y == b.y && a.x < b.x);
}

/// Whether corners make a convex, counter-clockwise polygon of positive area: no corner turns
/// right, three turn left, and the way around goes up once and down once.
static bool is_convex(const sl_point *v, uint32_t count) {
    uint32_t turns = 0, peaks = 0;
    for (uint32_t i = 0; i < count; i++) {
        const sl_point a = v[i ? i - 1 : count - 1], p = v[i], b = v[i + 1 < count ? i + 1 : 0];
        if (!sli_goes_on(a, p, b)) return false;
        turns += sli_orient(a, p, b) > 0;
        peaks += goes_up(a, p) && !goes_up(p, b);
    }
    return turns >= 3 && peaks == 1;
}

/// Whether a corner is usable; the bounds of a map without width or height are padded.
static bool is_usable(sl_point p) {
    return (sl_coordinate_usable(p.x) || sl_coordinate_usable(p.x / 2)) &&
           (sl_coordinate_usable(p.y) || sl_coordinate_usable(p.y / 2));
}

static sl_status check_cell(const checker *c, uint32_t number, uint64_t vertices,
                            uint64_t directed) {
    const sl_space *s = c->space;
    const sl_cell *cell = &s->cells[number];
    if (cell->first_vertex != vertices || cell->vertex_count > s->vertex_count - vertices)
        return fail_cell(c, number, "has corners out of range");
    if (cell->first_directed != directed || cell->directed_count > s->directed_count - directed)
        return fail_cell(c, number, "has portals out of range");
    SL_TRY(sli_check_ground(c->context, c->space, number));
    const sl_point *corners = s->vertices + cell->first_vertex;
    for (uint32_t i = 0; i < cell->vertex_count; i++)
        if (!is_usable(corners[i]) || (!s->loose && !sli_box_holds(&s->bounds, corners[i])))
            return fail_cell(c, number, "leaves the bounds");
    if (!is_convex(corners, cell->vertex_count)) return fail_cell(c, number, "is not convex");
    return SL_OK;
}

static sl_status check_cells(const checker *c) {
    const sl_space *s = c->space;
    uint64_t vertices = 0, directed = 0;
    uint32_t inside = 0;
    for (uint32_t i = 0; i < s->cell_count; i++) {
        if (i % 4096 == 0) SL_TRY(sl_check_cancelled(c->context));
        SL_TRY(check_cell(c, i, vertices, directed));
        vertices += s->cells[i].vertex_count;
        directed += s->cells[i].directed_count;
        inside += s->cells[i].inside;
    }
    if (inside == s->inside_count && directed == s->directed_count && vertices == s->vertex_count)
        return SL_OK;
    return sl_fail(c->context, SL_BAD_INPUT,
                   "the counts of cells, corners or portals do not add up");
}

// --- sides

/// The side of the bounds that both points are on: 1 + its number; 0 for none.
static int border_of(const sl_box *b, sl_point p, sl_point q) {
    if (p.y == b->min.y && q.y == b->min.y) return 1;
    if (p.x == b->max.x && q.x == b->max.x) return 2;
    if (p.y == b->max.y && q.y == b->max.y) return 3;
    return p.x == b->min.x && q.x == b->min.x ? 4 : 0;
}

static sl_status check_wall(const checker *c, uint32_t cell, uint32_t what, sl_point from,
                            sl_point to) {
    const uint32_t number = what & ~SL_NEIGHBOUR_RIGHT;
    if (number >= c->space->wall_count) return fail_cell(c, cell, "has a side on no known wall");
    if (c->space->loose || c->space->cut_walls) return SL_OK;
    const sl_wall *wall = &c->space->walls[number];
    const bool right = what & SL_NEIGHBOUR_RIGHT;
    if (!sli_same_point(right ? wall->b : wall->a, from) ||
        !sli_same_point(right ? wall->a : wall->b, to))
        return fail_cell(c, cell, "has a side that is not the wall it is said to be");
    const uint8_t bit = right ? 2 : 1;
    if (c->sides_found[number] & bit)
        return fail_cell(c, cell, "is where another cell is, at a wall");
    c->sides_found[number] |= bit;
    c->on_border[number] = border_of(&c->space->bounds, from, to) != 0;
    return SL_OK;
}

static sl_status check_sides(const checker *c, uint32_t number) {
    const sl_space *s = c->space;
    const sl_cell *cell = &s->cells[number];
    const sl_point *corners = s->vertices + cell->first_vertex;
    uint32_t passed = 0;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const uint32_t what = s->neighbour[cell->first_vertex + i];
        const sl_point from = corners[i], to = corners[i + 1 < cell->vertex_count ? i + 1 : 0];
        if (what == SL_NEIGHBOUR_PORTAL) {
            if (passed == cell->directed_count) return fail_cell(c, number, "has too few portals");
            const sl_directed_portal *portal = &s->directed[cell->first_directed + passed++];
            if (!sli_same_point(portal->right, from) || !sli_same_point(portal->left, to))
                return fail_cell(c, number, "has a portal that is not on its boundary");
            SL_TRY(sli_check_directed(c->context, s, number, portal, c->directed_found));
        } else if (what != SL_NEIGHBOUR_BORDER) {
            SL_TRY(check_wall(c, number, what, from, to));
        } else if (!s->loose && !border_of(&s->bounds, from, to)) {
            return fail_cell(c, number, "has a border within the bounds");
        }
    }
    return passed == cell->directed_count ? SL_OK : fail_cell(c, number, "has too many portals");
}

/// Each wall has one cell on either side, except on the border.
static sl_status check_walls(const checker *c) {
    for (uint32_t i = 0; i < c->space->wall_count; i++) {
        const uint8_t found = c->sides_found[i];
        if (found == 3 ? c->on_border[i] : !(c->on_border[i] && found))
            return sl_fail(c->context, SL_BAD_INPUT, "wall %u has not one cell on either side", i);
    }
    return SL_OK;
}

// --- walls that are cut

/// A side of a cell that is a wall or part of one. It runs as the wall does, from a to b.
typedef struct wall_side {
    uint32_t wall;
    sl_point from, to;
    bool right; ///< the cell is at the wall's right
} wall_side;

static int compare_sides(const void *left, const void *right) {
    const wall_side *s = left, *t = right;
    const double of_s[4] = {s->from.x, s->from.y, s->to.x, s->to.y};
    const double of_t[4] = {t->from.x, t->from.y, t->to.x, t->to.y};
    if (s->wall != t->wall) return s->wall < t->wall ? -1 : 1;
    for (int i = 0; i < 4; i++)
        if (of_s[i] != of_t[i]) return of_s[i] < of_t[i] ? -1 : 1;
    return s->right - t->right;
}

static size_t gather_sides(const checker *c, wall_side *sides) {
    const sl_space *s = c->space;
    size_t count = 0;
    for (uint32_t i = 0; i < s->cell_count; i++) {
        const sl_cell *cell = &s->cells[i];
        const sl_point *v = s->vertices + cell->first_vertex;
        for (uint32_t k = 0; k < cell->vertex_count; k++) {
            const uint32_t what = s->neighbour[cell->first_vertex + k];
            const sl_point at = v[k], next = v[k + 1 < cell->vertex_count ? k + 1 : 0];
            const bool right = what & SL_NEIGHBOUR_RIGHT;
            if (what < SL_NEIGHBOUR_BORDER)
                sides[count++] = (wall_side){what & ~SL_NEIGHBOUR_RIGHT, right ? next : at,
                                             right ? at : next, right};
        }
    }
    if (count) qsort(sides, count, sizeof *sides, compare_sides);
    return count;
}

/// Each part of a wall has one cell on either side, except on the border.
static sl_status check_cut_walls(const checker *c) {
    wall_side *sides = sl_alloc_array(c->context, c->space->vertex_count, sizeof *sides);
    if (!sides) return SL_NO_MEMORY;
    const size_t count = gather_sides(c, sides);
    size_t i = 0;
    while (i < count) {
        const wall_side *s = &sides[i], *t = i + 1 < count ? s + 1 : s;
        const bool pair = s->wall == t->wall && sli_same_point(s->from, t->from) &&
                          sli_same_point(s->to, t->to) && !s->right && t->right;
        if (!pair && !border_of(&c->space->bounds, s->from, s->to)) break;
        i += pair ? 2 : 1;
    }
    const uint32_t wall = i < count ? sides[i].wall : 0;
    sl_free(c->context, sides);
    if (i == count) return SL_OK;
    return sl_fail(c->context, SL_BAD_INPUT, "a part of wall %u has not one cell on either side",
                   wall);
}

// --- the border

/// A side on the border: the border's number, and its ends counter-clockwise.
typedef struct stretch {
    int border;
    double from, to;
} stretch;

static int compare_stretches(const void *left, const void *right) {
    const stretch *a = left, *b = right;
    if (a->border != b->border) return a->border - b->border;
    return (a->from > b->from) - (a->from < b->from);
}

static stretch stretch_of(int border, sl_point from, sl_point to) {
    switch (border) {
    case 1:
        return (stretch){1, from.x, to.x};
    case 2:
        return (stretch){2, from.y, to.y};
    case 3:
        return (stretch){3, -from.x, -to.x};
    default:
        return (stretch){4, -from.y, -to.y};
    }
}

/// Whether the stretches cover the border of the bounds exactly once.
static bool is_whole(const sl_box *b, const stretch *stretches, size_t count) {
    const double from[4] = {b->min.x, b->min.y, -b->max.x, -b->max.y};
    const double to[4] = {b->max.x, b->max.y, -b->min.x, -b->min.y};
    size_t i = 0;
    for (int border = 1; border <= 4; border++) {
        double at = from[border - 1];
        for (; i < count && stretches[i].border == border; i++) {
            if (stretches[i].from != at || !(stretches[i].to > at)) return false;
            at = stretches[i].to;
        }
        if (at != to[border - 1]) return false;
    }
    return i == count;
}

static sl_status check_border(const checker *c) {
    const sl_space *s = c->space;
    stretch *stretches = sl_alloc_array(c->context, s->vertex_count, sizeof *stretches);
    if (!stretches) return SL_NO_MEMORY;
    size_t count = 0;
    for (uint32_t i = 0; i < s->cell_count; i++) {
        const sl_cell *cell = &s->cells[i];
        const sl_point *v = s->vertices + cell->first_vertex;
        for (uint32_t k = 0; k < cell->vertex_count; k++) {
            const sl_point from = v[k], to = v[k + 1 < cell->vertex_count ? k + 1 : 0];
            const int border = border_of(&s->bounds, from, to);
            if (border) stretches[count++] = stretch_of(border, from, to);
        }
    }
    if (count) qsort(stretches, count, sizeof *stretches, compare_stretches);
    const bool whole = is_whole(&s->bounds, stretches, count);
    sl_free(c->context, stretches);
    if (whole) return SL_OK;
    return sl_fail(c->context, SL_BAD_INPUT, "the cells do not make up the border of the bounds");
}

// --- the grid

/// The buckets are readable, and the cells of each ascend; those of cut cells, by what they are cut
/// from.
static sl_status check_grid(const checker *c) {
    const sl_space *s = c->space;
    const sl_cell_grid *g = &s->grid;
    const uint64_t buckets = (uint64_t)g->columns * g->rows;
    if (!g->columns || !g->rows || !g->first || !g->cells || g->first[0] != 0 ||
        g->first[buckets] != g->entry_count)
        return sl_fail(c->context, SL_BAD_INPUT, "the grid of buckets is none");
    for (uint64_t i = 0; i < buckets; i++) {
        const uint32_t first = g->first[i], end = g->first[i + 1];
        if (first > end || end > g->entry_count)
            return sl_fail(c->context, SL_BAD_INPUT, "a bucket ends before it starts");
        for (uint32_t k = first; k < end; k++)
            if (g->cells[k] >= s->cell_count ||
                (!s->cut_walls && k > first && g->cells[k - 1] >= g->cells[k]))
                return sl_fail(c->context, SL_BAD_INPUT,
                               "a bucket has cells out of range or order");
    }
    return SL_OK;
}

// --- seams

/// A segment with its lower end first.
static sl_segment in_order(sl_point a, sl_point b) {
    return sli_compare_points(a, b) < 0 ? (sl_segment){a, b} : (sl_segment){b, a};
}

static int compare_segments(const void *left, const void *right) {
    const sl_segment *s = left, *t = right;
    const int order = sli_compare_points(s->a, t->a);
    return order ? order : sli_compare_points(s->b, t->b);
}

/// A portal that is listed for a seam has the ends of the seam.
static sl_status check_seam_portals(const checker *c, bool *passed) {
    const sl_space *s = c->space;
    for (uint32_t i = 0; i < s->seam_portal_count; i++) {
        const sl_seam_portal *at = &s->seam_portals[i];
        const sl_segment *seam = &s->seams[at->seam].at;
        const sl_portal *p = &s->portals[at->portal];
        const bool forward = sli_same_point(seam->a, p->left) && sli_same_point(seam->b, p->right);
        const bool backward = sli_same_point(seam->a, p->right) && sli_same_point(seam->b, p->left);
        if (!forward && !backward)
            return sl_fail(c->context, SL_BAD_INPUT, "portal %u is not on seam %u", at->portal,
                           at->seam);
        if (forward != at->forward)
            return sl_fail(c->context, SL_BAD_INPUT, "portal %u is said the wrong way on seam %u",
                           at->portal, at->seam);
        passed[at->seam] = true;
    }
    return SL_OK;
}

/// A seam without a portal is covered by a wall, or on the border.
static sl_status check_covered(const checker *c, const bool *passed, sl_segment *walls) {
    const sl_space *s = c->space;
    for (uint32_t i = 0; i < s->wall_count; i++) walls[i] = in_order(s->walls[i].a, s->walls[i].b);
    if (s->wall_count) qsort(walls, s->wall_count, sizeof *walls, compare_segments);
    for (uint32_t i = 0; i < s->seam_count; i++) {
        const sl_segment at = in_order(s->seams[i].at.a, s->seams[i].at.b);
        if (!passed[i] && !border_of(&s->bounds, at.a, at.b) &&
            !(s->wall_count && bsearch(&at, walls, s->wall_count, sizeof *walls, compare_segments)))
            return sl_fail(c->context, SL_BAD_INPUT, "seam %u is neither portal nor wall", i);
    }
    return SL_OK;
}

static sl_status check_seams(const checker *c) {
    const sl_space *s = c->space;
    SL_TRY(sli_seams_check(c->context, s, false));
    // Portals on seams that boxes cut are parts of them, and bent.
    if (s->loose || s->cut_walls || !s->seam_count) return SL_OK;
    bool *passed = sl_alloc_array(c->context, s->seam_count, sizeof *passed);
    sl_segment *walls = sl_alloc_array(c->context, s->wall_count, sizeof *walls);
    sl_status status = passed && walls ? check_seam_portals(c, passed) : SL_NO_MEMORY;
    if (status == SL_OK) status = check_covered(c, passed, walls);
    sl_free(c->context, passed);
    sl_free(c->context, walls);
    return status;
}

static sl_status check_all(const checker *c) {
    const sl_space *s = c->space;
    SL_TRY(check_cells(c));
    for (uint32_t cell = 0; cell < s->cell_count; cell++) {
        if (cell % 4096 == 0) SL_TRY(sl_check_cancelled(c->context));
        SL_TRY(check_sides(c, cell));
    }
    SL_TRY(check_grid(c));
    SL_TRY(check_seams(c));
    SL_TRY(sl_check_cancelled(c->context));
    if (s->loose) return SL_OK;
    SL_TRY(s->cut_walls ? check_cut_walls(c) : check_walls(c));
    SL_TRY(check_border(c));
    SL_TRY(sl_check_cancelled(c->context));
    return sli_cell_grid_check(c->context, s);
}

sl_status sli_check_mesh(sl_context *context, const sl_space *space) {
    checker c = {.context = context, .space = space};
    c.directed_found = sl_alloc_array(context, space->portal_count, sizeof *c.directed_found);
    c.sides_found = sl_alloc_array(context, space->wall_count, sizeof *c.sides_found);
    c.on_border = sl_alloc_array(context, space->wall_count, sizeof *c.on_border);
    const sl_status status =
        c.directed_found && c.sides_found && c.on_border ? check_all(&c) : SL_NO_MEMORY;
    sl_free(context, c.directed_found);
    sl_free(context, c.sides_found);
    sl_free(context, c.on_border);
    return status;
}

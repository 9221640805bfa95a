/// The check of a whole space: it proves what the later stages rely on. It is safe on any bytes, as
/// every index is checked before it is used.
///
/// For a kd-tree's space the proof goes from the root down. Each split lies within its region, and
/// each cell is led to once and has the corners of its region. So the cells tile the bounds. No
/// wall comes into a cell when it is sent down the tree. Then each cell is walked around: every
/// piece of its boundary is a wall, a portal or the border. For a mesh see check_mesh.c. All is
/// done by exact comparisons. Time O(n log n).
#include "geometry/orient.h"
#include "sightline/support.h"
#include "space/kd_tree.h"
#include "space/mesh.h"
#include "space/seams.h"
#include "space/walled.h"

#include <math.h>

typedef struct checker {
    sl_context *context;
    const sl_space *space;
    sli_piece *walls;
    sl_box *regions; ///< of the nodes, then of the cells, by the tree
    sl_bits *led_to; ///< the nodes, then the cells, that some node leads to
    uint8_t
        *directed_found; ///< by portal: 1 for the directed portal of cell[0], 2 for that of cell[1]
} checker;

static sl_status check_ranges(const checker *c) {
    const sl_space *s = c->space;
    const bool has_nodes =
        s->loose || s->neighbour ? !s->node_count : s->node_count == s->cell_count - 1;
    if (!s->cell_count || !has_nodes)
        return sl_fail(c->context, SL_BAD_INPUT, "%u nodes cannot lead to %u cells", s->node_count,
                       s->cell_count);
    if (s->directed_count != 2 * (uint64_t)s->portal_count)
        return sl_fail(c->context, SL_BAD_INPUT, "%u portals cannot have %u directed portals",
                       s->portal_count, s->directed_count);
    const sl_box *b = &s->bounds;
    if (!isfinite(b->max.x - b->min.x) || !isfinite(b->max.y - b->min.y) ||
        !(b->min.x < b->max.x) || !(b->min.y < b->max.y))
        return sl_fail(c->context, SL_BAD_INPUT, "the bounds enclose no area");
    return SL_OK;
}

static sl_status fail_node(const checker *c, uint32_t node, const char *what) {
    return sl_fail(c->context, SL_BAD_INPUT, "node %u %s", node, what);
}

/// Gives the child of a node (-1 for the root) its region, once.
static sl_status lead_to(checker *c, int64_t node, int32_t child, sl_box region) {
    const sl_space *s = c->space;
    const bool in_range = child < 0 ? (uint32_t)~child < s->cell_count
                                    : child > node && (uint32_t)child < s->node_count;
    const uint32_t parent = node < 0 ? 0 : (uint32_t)node;
    if (!in_range) return fail_node(c, parent, "leads out of the tree");
    const size_t slot = child < 0 ? (size_t)s->node_count + (uint32_t)~child : (size_t)child;
    if (sl_bits_has(c->led_to, slot)) return fail_node(c, parent, "leads where another one does");
    sl_bits_add(c->led_to, slot);
    c->regions[slot] = region;
    return SL_OK;
}

static sl_status check_tree(checker *c) {
    const sl_space *s = c->space;
    SL_TRY(lead_to(c, -1, s->root, s->bounds));
    for (uint32_t i = 0; i < s->node_count; i++) {
        const sl_node *node = &s->nodes[i];
        if (!sl_bits_has(c->led_to, i)) return fail_node(c, i, "cannot be reached");
        if (node->axis != 0 && node->axis != 1) return fail_node(c, i, "has no known axis");
        sl_box below = c->regions[i], above = c->regions[i];
        double *lo = node->axis ? &above.min.y : &above.min.x;
        double *hi = node->axis ? &below.max.y : &below.max.x;
        if (!(node->position > *lo && node->position < *hi))
            return fail_node(c, i, "splits outside its region");
        *lo = *hi = node->position;
        SL_TRY(lead_to(c, i, node->below, below));
        SL_TRY(lead_to(c, i, node->above, above));
    }
    return SL_OK; // cell_count - 1 nodes with two children each, none led to twice: all are reached
}

static sl_status fail_cell(const checker *c, uint32_t cell, const char *what) {
    return sl_fail(c->context, SL_BAD_INPUT, "cell %u %s", cell, what);
}

/// The corners of a cell must be those of the tree's region, counter-clockwise.
static sl_status check_cells(const checker *c) {
    const sl_space *s = c->space;
    uint64_t directed = 0;
    uint32_t inside = 0;
    for (uint32_t i = 0; i < s->cell_count; i++) {
        const sl_cell *cell = &s->cells[i];
        if (i % 4096 == 0) SL_TRY(sl_check_cancelled(c->context));
        if (cell->vertex_count != 4 || cell->first_vertex > s->vertex_count ||
            s->vertex_count - cell->first_vertex < 4)
            return fail_cell(c, i, "has corners out of range");
        const sl_box *r = &c->regions[s->node_count + i];
        const sl_point *v = &s->vertices[cell->first_vertex];
        const sl_point lower_right = {r->max.x, r->min.y}, upper_left = {r->min.x, r->max.y};
        if (!sli_same_point(v[0], r->min) || !sli_same_point(v[1], lower_right) ||
            !sli_same_point(v[2], r->max) || !sli_same_point(v[3], upper_left))
            return fail_cell(c, i, "is not the region that the tree gives it");
        if (cell->first_directed != directed || cell->directed_count > s->directed_count - directed)
            return fail_cell(c, i, "has portals out of range");
        SL_TRY(sli_check_ground(c->context, s, i));
        directed += cell->directed_count;
        inside += cell->inside;
    }
    if (inside != s->inside_count || directed != s->directed_count)
        return sl_fail(c->context, SL_BAD_INPUT, "the counts of cells or portals do not add up");
    return SL_OK;
}

/// Keeps the part of a wall in a child's region; false for none. A wall on the split is in neither.
static bool enters(const sl_node *node, bool above, sli_piece *wall) {
    const double at = node->position;
    if (wall->axis == node->axis) return above ? wall->at > at : wall->at < at;
    if (above)
        wall->lo = wall->lo > at ? wall->lo : at;
    else
        wall->hi = wall->hi < at ? wall->hi : at;
    return wall->lo < wall->hi;
}

typedef struct visit {
    int32_t child;
    sli_piece wall;
} visit;

static sl_status check_wall(const checker *c, const sli_piece *wall, visit *stack) {
    const sl_box *b = &c->space->bounds;
    const double lo = wall->axis ? b->min.y : b->min.x, hi = wall->axis ? b->max.y : b->max.x;
    const double side_lo = wall->axis ? b->min.x : b->min.y;
    const double side_hi = wall->axis ? b->max.x : b->max.y;
    if (!(wall->at >= lo && wall->at <= hi && wall->lo >= side_lo && wall->hi <= side_hi))
        return sl_fail(c->context, SL_BAD_INPUT, "a wall leaves the bounds");
    if (wall->at == lo || wall->at == hi) return SL_OK;
    size_t count = 0;
    stack[count++] = (visit){c->space->root, *wall};
    while (count) {
        const visit now = stack[--count];
        if (now.child < 0) return fail_cell(c, (uint32_t)~now.child, "has a wall inside");
        const sl_node *node = &c->space->nodes[now.child];
        visit below = {node->below, now.wall}, above = {node->above, now.wall};
        if (enters(node, true, &above.wall)) stack[count++] = above;
        if (enters(node, false, &below.wall)) stack[count++] = below;
    }
    return SL_OK;
}

/// Checks that no wall, or no part of a seam, is inside a cell.
static sl_status check_walls(const checker *c, const sli_piece *walls, size_t count) {
    // A way down leaves at most one sibling waiting on each level.
    visit *stack = sl_alloc_array(c->context, (size_t)c->space->node_count + 2, sizeof *stack);
    if (!stack) return SL_NO_MEMORY;
    sl_status status = SL_OK;
    for (size_t i = 0; i < count && status == SL_OK; i++) {
        if (i % 4096 == 0) status = sl_check_cancelled(c->context);
        if (status == SL_OK) status = check_wall(c, &walls[i], stack);
    }
    sl_free(c->context, stack);
    return status;
}

// --- seams

static bool lies_on(const sl_portal *p, const sl_segment *seam) {
    const bool upright = seam->a.x == seam->b.x;
    const double at = upright ? seam->a.x : seam->a.y;
    const double from = upright ? seam->a.y : seam->a.x, to = upright ? seam->b.y : seam->b.x;
    const double one = upright ? p->left.y : p->left.x, other = upright ? p->right.y : p->right.x;
    const bool in_line =
        upright ? p->left.x == at && p->right.x == at : p->left.y == at && p->right.y == at;
    return in_line && fmin(one, other) >= fmin(from, to) && fmax(one, other) <= fmax(from, to);
}

/// No part of a seam is inside a cell, and every portal on one is listed.
static sl_status check_parts(const checker *c, const sli_seam_parts *parts,
                             const sli_piece *pieces) {
    sl_space found = *c->space;
    found.seam_portals = NULL;
    found.seam_portal_count = 0;
    SL_TRY(check_walls(c, pieces, parts->parts.count));
    sl_status status = sli_seams_tag_axial(c->context, parts, &found);
    bool same = status == SL_OK && found.seam_portal_count == c->space->seam_portal_count;
    for (uint32_t i = 0; same && i < found.seam_portal_count; i++) {
        const sl_seam_portal *a = &found.seam_portals[i], *b = &c->space->seam_portals[i];
        same = a->portal == b->portal && a->seam == b->seam && a->forward == b->forward &&
               lies_on(&found.portals[a->portal], &found.seams[a->seam].at);
    }
    sl_free(c->context, found.seam_portals);
    if (status != SL_OK || same) return status;
    return sl_fail(c->context, SL_BAD_INPUT, "the list of portals on seams is wrong");
}

static sl_status check_seams(const checker *c) {
    if (!c->space->seam_count && !c->space->seam_portal_count) return SL_OK;
    SL_TRY(sli_seams_check(c->context, c->space, true));
    sli_seam_parts parts = {0};
    sli_piece *pieces = NULL;
    sl_status status = sli_seams_part(c->context, c->space, &parts);
    if (status == SL_OK) status = sli_seam_lines(c->context, NULL, 0, &parts, &pieces);
    if (status == SL_OK) status = check_parts(c, &parts, pieces);
    sli_seam_parts_destroy(c->context, &parts);
    sl_free(c->context, pieces);
    return status;
}

/// An edge of a cell's box, on the line at `at`, from `from` to `to` counter-clockwise.
typedef struct edge {
    int axis;
    double at, from, to;
    bool on_border;
} edge;

static edge edge_of(const sl_box *r, const sl_box *bounds, int number) {
    switch (number) {
    case 0:
        return (edge){1, r->min.y, r->min.x, r->max.x, r->min.y == bounds->min.y};
    case 1:
        return (edge){0, r->max.x, r->min.y, r->max.y, r->max.x == bounds->max.x};
    case 2:
        return (edge){1, r->max.y, r->max.x, r->min.x, r->max.y == bounds->max.y};
    default:
        return (edge){0, r->min.x, r->max.y, r->min.y, r->min.x == bounds->min.x};
    }
}

static bool wall_between(const checker *c, const edge *e, double from, double to) {
    const double lo = from < to ? from : to, hi = from < to ? to : from;
    return sli_wall_lines_cover(c->walls, c->space->wall_count, e->axis, e->at, lo, hi);
}

static bool free_between(const checker *c, const edge *e, double from, double to) {
    const double lo = from < to ? from : to, hi = from < to ? to : from;
    const size_t i = sli_wall_lines_find(c->walls, c->space->wall_count, e->axis, e->at, lo);
    return i == c->space->wall_count || c->walls[i].axis != e->axis || c->walls[i].at != e->at ||
           c->walls[i].lo >= hi;
}

/// Whether a directed portal lies on an edge, and its ends along the edge.
static bool portal_on_edge(const sl_directed_portal *directed, const edge *e, double *from,
                           double *to) {
    const bool on = e->axis ? directed->right.y == e->at && directed->left.y == e->at
                            : directed->right.x == e->at && directed->left.x == e->at;
    *from = e->axis ? directed->right.x : directed->right.y;
    *to = e->axis ? directed->left.x : directed->left.y;
    return on && (e->from < e->to ? *from < *to : *from > *to);
}

sl_status sli_check_ground(sl_context *context, const sl_space *s, uint32_t cell) {
    const sl_cell *c = &s->cells[cell];
    if (c->inside <= 1 && c->solid <= 1 && !(c->inside && c->solid)) return SL_OK;
    return sl_fail(context, SL_BAD_INPUT,
                   "cell %u is not one of these: inside, outside, solid ground", cell);
}

sl_status sli_check_directed(sl_context *context, const sl_space *s, uint32_t cell,
                             const sl_directed_portal *directed, uint8_t *directed_found) {
    if (directed->portal >= s->portal_count)
        return sl_fail(context, SL_BAD_INPUT, "cell %u has a portal of an unknown number", cell);
    const sl_portal *p = &s->portals[directed->portal];
    if (p->cell[0] >= p->cell[1] || p->cell[1] >= s->cell_count)
        return sl_fail(context, SL_BAD_INPUT, "portal %u joins no two cells", directed->portal);
    if (s->cells[p->cell[0]].solid != s->cells[p->cell[1]].solid)
        return sl_fail(context, SL_BAD_INPUT, "portal %u joins solid ground with open ground",
                       directed->portal);
    const int side = p->cell[0] == cell ? 0 : 1;
    if (p->cell[side] != cell || directed->cell != p->cell[!side] ||
        !sli_same_point(directed->left, side ? p->right : p->left) ||
        !sli_same_point(directed->right, side ? p->left : p->right) ||
        directed_found[directed->portal] & (1 << side))
        return sl_fail(context, SL_BAD_INPUT, "cell %u has a directed portal unlike its portal",
                       cell);
    directed_found[directed->portal] |= (uint8_t)(1 << side);
    return SL_OK;
}

/// Walks round a cell: each directed portal must start where the last one ended, or after a wall.
static sl_status check_boundary(checker *c, uint32_t cell) {
    const sl_space *s = c->space;
    const sl_directed_portal *directed = s->directed + s->cells[cell].first_directed;
    const sl_directed_portal *end = directed + s->cells[cell].directed_count;
    for (int number = 0; number < 4; number++) {
        const edge e = edge_of(&c->regions[s->node_count + cell], &s->bounds, number);
        double at = e.from, from, to;
        for (; directed < end && portal_on_edge(directed, &e, &from, &to); directed++) {
            SL_TRY(sli_check_directed(c->context, s, cell, directed, c->directed_found));
            const bool forward =
                e.from < e.to ? from >= at && to <= e.to : from <= at && to >= e.to;
            if (!forward || e.on_border) return fail_cell(c, cell, "has a portal out of place");
            if (!free_between(c, &e, from, to)) return fail_cell(c, cell, "has a portal on a wall");
            if (from != at && !wall_between(c, &e, at, from))
                return fail_cell(c, cell, "has a boundary that is neither wall nor portal");
            if (from == at && at != e.from && directed[-1].cell == directed->cell &&
                sli_seams_same(s, directed[-1].portal, directed->portal))
                return fail_cell(c, cell, "has a portal that is not a longest piece");
            at = to;
        }
        if (at != e.to && !e.on_border && !wall_between(c, &e, at, e.to))
            return fail_cell(c, cell, "has a boundary that is neither wall nor portal");
    }
    // There are twice as many directed portals as portals, and none comes twice: each portal has
    // both.
    return directed == end ? SL_OK : fail_cell(c, cell, "has a portal that is not on its boundary");
}

static sl_status check_all(checker *c) {
    const sl_space *s = c->space;
    SL_TRY(check_tree(c));
    SL_TRY(check_cells(c));
    SL_TRY(sli_wall_lines(c->context, NULL, s->walls, s->wall_count, &c->walls));
    SL_TRY(check_walls(c, c->walls, s->wall_count));
    for (uint32_t cell = 0; cell < s->cell_count; cell++) {
        if (cell % 4096 == 0) SL_TRY(sl_check_cancelled(c->context));
        SL_TRY(check_boundary(c, cell));
    }
    return check_seams(c);
}

static sl_status check_tree_space(sl_context *context, const sl_space *space) {
    checker c = {.context = context, .space = space};
    if (space->loose)
        return sl_fail(context, SL_BAD_INPUT, "a loose space that does not know its sides");
    const size_t places = (size_t)space->node_count + space->cell_count;
    c.regions = sl_alloc_array(context, places, sizeof *c.regions);
    c.led_to = sl_alloc_array(context, sl_bits_words(places), sizeof *c.led_to);
    c.directed_found = sl_alloc_array(context, space->portal_count, sizeof *c.directed_found);
    const sl_status status =
        c.regions && c.led_to && c.directed_found ? check_all(&c) : SL_NO_MEMORY;
    sl_free(context, c.walls);
    sl_free(context, c.regions);
    sl_free(context, c.led_to);
    sl_free(context, c.directed_found);
    return status;
}

sl_status sl_space_check(sl_context *context, const sl_space *space) {
    const checker c = {.context = context, .space = space};
    SL_TRY(check_ranges(&c));
    SL_TRY(space->neighbour ? sli_check_mesh(context, space) : check_tree_space(context, space));
    return sli_passages_check(context, space); // of cells that are sound
}

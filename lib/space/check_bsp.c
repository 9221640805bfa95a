/// The whole-graph check of a BSP's space. What sight depends on is checked exactly: convex cells,
/// portals that both cells have alike, walls' sides that lie on their wall or behind it. That walls
/// are all there and that cells fill the bounds is checked within rounding.
#include "base/bits.h"
#include "space/bsp.h"

#include <math.h>

typedef struct checker {
    sl_context *context;
    const sl_space *space;
    double slack;         ///< what rounding may have done to a place
    sl_bits *led_to;      ///< nodes, then cells, that some node leads to
    uint8_t *exits_found; ///< by portal: 1 for the exit of cell[0], 2 for that of cell[1]
    int32_t *stack;
} checker;

static sl_status fail_node(const checker *c, uint32_t node, const char *what) {
    return sl_fail(c->context, SL_BAD_INPUT, "node %u %s", node, what);
}

static sl_status fail_cell(const checker *c, uint32_t cell, const char *what) {
    return sl_fail(c->context, SL_BAD_INPUT, "cell %u %s", cell, what);
}

// --- the tree

static sl_status lead_to(const checker *c, int64_t node, int32_t child) {
    const sl_space *s = c->space;
    const bool in_range = child < 0 ? (uint32_t)~child < s->cell_count
                                    : child > node && (uint32_t)child < s->node_count;
    const uint32_t parent = node < 0 ? 0 : (uint32_t)node;
    if (!in_range) return fail_node(c, parent, "leads out of the tree");
    const size_t slot = child < 0 ? (size_t)s->node_count + (uint32_t)~child : (size_t)child;
    sl_bits_add(c->led_to, slot);
    return SL_OK;
}

/// Within what a map without width or height is padded to.
static bool is_usable(sl_point p) {
    return (sl_coordinate_usable(p.x) || sl_coordinate_usable(p.x / 2)) &&
           (sl_coordinate_usable(p.y) || sl_coordinate_usable(p.y / 2));
}

/// Several nodes may lead to one: all must be reached.
static sl_status check_tree(const checker *c) {
    const sl_space *s = c->space;
    SL_TRY(lead_to(c, -1, s->root));
    for (uint32_t i = 0; i < s->node_count; i++) {
        const sl_node *node = &s->nodes[i];
        if (!sl_bits_has(c->led_to, i)) return fail_node(c, i, "cannot be reached");
        if (node->axis != 2 || node->line < 0 || (uint32_t)node->line >= s->line_count)
            return fail_node(c, i, "splits along no known line");
        SL_TRY(lead_to(c, i, node->below));
        SL_TRY(lead_to(c, i, node->above));
    }
    for (uint32_t i = 0; i < s->cell_count; i++)
        if (!sl_bits_has(c->led_to, (size_t)s->node_count + i))
            return sl_fail(c->context, SL_BAD_INPUT, "no node leads to cell %u", i);
    for (uint32_t i = 0; i < s->line_count; i++) {
        const sl_segment *line = &s->lines[i];
        if (!is_usable(line->a) || !is_usable(line->b) || sl_same_point(line->a, line->b))
            return sl_fail(c->context, SL_BAD_INPUT, "line %u is none", i);
    }
    return SL_OK;
}

// --- cells

/// The numbers of a cell, and its corners: convex, within the bounds.
static sl_status check_cell(const checker *c, uint32_t number, uint64_t vertices, uint64_t exits) {
    const sl_space *s = c->space;
    const sl_cell *cell = &s->cells[number];
    if (cell->first_vertex != vertices || cell->vertex_count > s->vertex_count - vertices)
        return fail_cell(c, number, "has corners out of range");
    if (cell->first_exit != exits || cell->exit_count > s->exit_count - exits)
        return fail_cell(c, number, "has exits out of range");
    if (cell->inside > 1) return fail_cell(c, number, "is neither inside nor outside");
    const sl_point *corners = s->vertices + cell->first_vertex;
    const sl_box *b = &s->bounds;
    for (uint32_t i = 0; i < cell->vertex_count; i++)
        if (!is_usable(corners[i]) || corners[i].x < b->min.x - c->slack ||
            corners[i].x > b->max.x + c->slack || corners[i].y < b->min.y - c->slack ||
            corners[i].y > b->max.y + c->slack)
            return fail_cell(c, number, "leaves the bounds");
    if (!sl_convex_corners(corners, sizeof *corners, cell->vertex_count))
        return fail_cell(c, number, "is not convex");
    return SL_OK;
}

static double share_of(const sl_space *s, const sl_cell *cell) {
    const double width = s->bounds.max.x - s->bounds.min.x;
    const double height = s->bounds.max.y - s->bounds.min.y;
    const sl_point *v = s->vertices + cell->first_vertex;
    double twice = 0;
    for (uint32_t i = 2; i < cell->vertex_count; i++)
        twice += (v[i - 1].x - v[0].x) / width * ((v[i].y - v[0].y) / height) -
                 (v[i].x - v[0].x) / width * ((v[i - 1].y - v[0].y) / height);
    return twice / 2;
}

static sl_status check_cells(const checker *c) {
    const sl_space *s = c->space;
    uint64_t vertices = 0, exits = 0;
    uint32_t inside = 0;
    double sum = 0;
    for (uint32_t i = 0; i < s->cell_count; i++) {
        SL_TRY(check_cell(c, i, vertices, exits));
        vertices += s->cells[i].vertex_count;
        exits += s->cells[i].exit_count;
        inside += s->cells[i].inside;
        sum += share_of(s, &s->cells[i]);
    }
    if (inside != s->inside_count || exits != s->exit_count || vertices != s->vertex_count)
        return sl_fail(c->context, SL_BAD_INPUT,
                       "the counts of cells, corners or exits do not add up");
    const double width = s->bounds.max.x - s->bounds.min.x;
    const double height = s->bounds.max.y - s->bounds.min.y;
    const double slack = 1e-9 + (double)vertices * c->slack / fmin(width, height);
    // More where walls within rounding of each other leave no room for corners between them.
    if ((s->partial || sum >= 1 - slack) && sum <= 1.5 + slack) return SL_OK;
    return sl_fail(c->context, SL_BAD_INPUT, "the cells' areas add up to %.17g of the bounds'",
                   sum);
}

// --- sides

static sl_status check_exit(const checker *c, uint32_t cell, const sl_exit *exit, sl_point from,
                            sl_point to) {
    if (!sl_same_point(exit->right, from) || !sl_same_point(exit->left, to))
        return fail_cell(c, cell, "has an exit that is not on its boundary");
    return sl_check_exit(c->context, c->space, cell, exit, c->exits_found);
}

static bool is_on_border(const sl_box *b, sl_point p, sl_point q) {
    return (p.x == q.x && (p.x == b->min.x || p.x == b->max.x)) ||
           (p.y == q.y && (p.y == b->min.y || p.y == b->max.y));
}

/// Whether no corner is on the right of a side: sight that leaves there comes back nowhere.
static bool is_outermost(const sl_space *s, sl_point from, sl_point to) {
    for (uint32_t i = 0; i < s->vertex_count; i++)
        if (sl_orient(from, to, s->vertices[i]) < 0) return false;
    return true;
}

static bool is_strictly_inside(const sl_space *s, const sl_cell *cell, sl_point point) {
    const sl_point *v = s->vertices + cell->first_vertex;
    for (uint32_t i = 0; i < cell->vertex_count; i++)
        if (sl_orient(v[i], v[i + 1 == cell->vertex_count ? 0 : i + 1], point) <= 0) return false;
    return true;
}

/// Where cells came with the map, a wall that a side is along must not end before it does.
static bool ends_within(const sl_space *s, const sl_cell *cell, uint32_t what) {
    const sl_wall *wall = &s->walls[what & ~SL_BEYOND_RIGHT];
    return s->partial &&
           (is_strictly_inside(s, cell, wall->a) || is_strictly_inside(s, cell, wall->b));
}

/// On the wall's line or behind it, as seen from the cell.
static bool is_behind(const sl_space *s, uint32_t what, sl_point from, sl_point to) {
    const uint32_t number = what & ~SL_BEYOND_RIGHT;
    if (number >= s->wall_count) return false;
    const sl_wall *wall = &s->walls[number];
    const bool right = what & SL_BEYOND_RIGHT;
    return sl_bsp_behind(wall, right, from) && sl_bsp_behind(wall, right, to);
}

static sl_status check_sides(const checker *c, uint32_t number) {
    const sl_space *s = c->space;
    const sl_cell *cell = &s->cells[number];
    const sl_point *corners = s->vertices + cell->first_vertex;
    uint32_t exits = 0;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const uint32_t what = s->beyond[cell->first_vertex + i];
        const sl_point from = corners[i], to = corners[i + 1 == cell->vertex_count ? 0 : i + 1];
        if (what == SL_BEYOND_EXIT) {
            if (exits == cell->exit_count) return fail_cell(c, number, "has too few exits");
            SL_TRY(check_exit(c, number, &s->exits[cell->first_exit + exits++], from, to));
        } else if (what == SL_BEYOND_BORDER) {
            SL_TRY(sl_check_cancelled(c->context));
            if (s->partial ? !is_outermost(s, from, to) : !is_on_border(&s->bounds, from, to))
                return fail_cell(c, number, "has a border within the bounds");
        } else if (!is_behind(s, what, from, to))
            return fail_cell(c, number, "has a wall's side that is not behind the wall");
        else if (ends_within(s, cell, what))
            return fail_cell(c, number, "has a wall's side that is longer than the wall");
    }
    return exits == cell->exit_count ? SL_OK : fail_cell(c, number, "has too many exits");
}

// --- walls

/// Follows a wall down the tree: it must be inside no cell that it leads to.
static sl_status check_wall(const checker *c, const sl_wall *wall) {
    const sl_space *s = c->space;
    size_t count = 0;
    c->stack[count++] = s->root;
    while (count) {
        const int32_t at = c->stack[--count];
        if (at < 0) {
            const uint32_t cell = (uint32_t)~at;
            const sl_point *corners = s->vertices + s->cells[cell].first_vertex;
            if (sl_wall_depth(corners, sizeof *corners, s->cells[cell].vertex_count, wall) >
                c->slack)
                return fail_cell(c, cell, "has a wall inside");
            continue;
        }
        const sl_segment *line = &s->lines[s->nodes[at].line];
        const int a = sl_orient(line->a, line->b, wall->a);
        const int b = sl_orient(line->a, line->b, wall->b);
        if (a > 0 || b > 0) c->stack[count++] = s->nodes[at].above;
        if (a < 0 || b < 0) c->stack[count++] = s->nodes[at].below;
    }
    return SL_OK;
}

static sl_status check_walls(const checker *c) {
    const sl_space *s = c->space;
    const sl_box *b = &s->bounds;
    for (uint32_t i = 0; i < s->wall_count; i++) {
        const sl_wall *wall = &s->walls[i];
        if (!(fmin(wall->a.x, wall->b.x) >= b->min.x && fmax(wall->a.x, wall->b.x) <= b->max.x &&
              fmin(wall->a.y, wall->b.y) >= b->min.y && fmax(wall->a.y, wall->b.y) <= b->max.y))
            return sl_fail(c->context, SL_BAD_INPUT, "a wall leaves the bounds");
        if (i % 256 == 0) SL_TRY(sl_check_cancelled(c->context));
        if (!sl_same_point(wall->a, wall->b)) SL_TRY(check_wall(c, wall));
    }
    return SL_OK;
}

// --- seams

/// How far a point is from a segment, at most its ends' distance.
static double distance_to(const sl_segment *s, sl_point p) {
    const double dx = s->b.x - s->a.x, dy = s->b.y - s->a.y, length = hypot(dx, dy);
    const double along = ((p.x - s->a.x) * (dx / length) + (p.y - s->a.y) * (dy / length)) / length;
    const double t = fmin(1, fmax(0, along));
    return hypot(p.x - s->a.x - t * dx, p.y - s->a.y - t * dy);
}

/// Portals told to be on a seam are, as near as the BSP places their corners.
static sl_status check_seams(const checker *c) {
    const sl_space *s = c->space;
    const double slack = sl_bsp_seam_slack(&s->bounds);
    SL_TRY(sl_seams_check(c->context, s, false));
    for (uint32_t i = 0; i < s->seam_portal_count; i++) {
        const sl_seam_portal *at = &s->seam_portals[i];
        const sl_segment *seam = &s->seams[at->seam].at;
        const sl_portal *p = &s->portals[at->portal];
        const double along = (seam->b.x - seam->a.x) * (p->right.x - p->left.x) +
                             (seam->b.y - seam->a.y) * (p->right.y - p->left.y);
        if (distance_to(seam, p->left) > slack || distance_to(seam, p->right) > slack)
            return sl_fail(c->context, SL_BAD_INPUT, "portal %u is not on seam %u", at->portal,
                           at->seam);
        const double length = hypot(seam->b.x - seam->a.x, seam->b.y - seam->a.y);
        if (fabs(along) > slack * length && (along > 0) != (at->forward == 1))
            return sl_fail(c->context, SL_BAD_INPUT, "portal %u is told the wrong way on seam %u",
                           at->portal, at->seam);
    }
    return SL_OK;
}

static sl_status check_all(const checker *c) {
    SL_TRY(check_tree(c));
    SL_TRY(check_cells(c));
    for (uint32_t cell = 0; cell < c->space->cell_count; cell++) SL_TRY(check_sides(c, cell));
    SL_TRY(check_walls(c));
    return check_seams(c);
}

sl_status sl_check_bsp(sl_context *context, const sl_space *space) {
    checker c = {.context = context, .space = space, .slack = sl_bsp_slack(&space->bounds)};
    const size_t places = (size_t)space->node_count + space->cell_count;
    c.led_to = sl_alloc_array(context, sl_bits_words(places), sizeof *c.led_to);
    c.exits_found = sl_alloc_array(context, space->portal_count, sizeof *c.exits_found);
    // A way down leaves at most one sibling waiting on each level.
    c.stack = sl_alloc_array(context, (size_t)space->node_count + 2, sizeof *c.stack);
    const sl_status status = c.led_to && c.exits_found && c.stack ? check_all(&c) : SL_NO_MEMORY;
    sl_free(context, c.led_to);
    sl_free(context, c.exits_found);
    sl_free(context, c.stack);
    return status;
}

/// Boxes put into a space. A kd-tree's space is cut here, a mesh in boxes_mesh.c.
///
/// Each cell that a side of a box runs through is cut along the lines of these sides, as nodes of
/// the tree below its leaf:
///
///     +-------------+        +---+-----+---+
///     |   .-----.   |        |   |     |   |      a part is cut at its first side; the other
///     |   | box |   |   ->   |   +-----+   |      sides are cut for both halves, and so on,
///     |   '-----'   |        |   |     |   |      until no side runs through a part
///     |             |        |   +-----+   |
///     +-------------+        +---+-----+---+
///
/// Portals of untouched cells stay. Others are found again between the parts on both sides of the
/// old portal, and between the parts of one cell. Sides of boxes that block are left out of them.
/// No coordinate is computed. To find what lies beside a part, the parts of a cell are sorted by
/// their lower sides: one behind the other on a line. Time: linear in the space, which is copied,
/// plus the parts times the sides in their cell.
#include "space/boxes.h"

#include "geometry/orient.h"
#include "sightline/map.h"
#include "sightline/support.h"
#include "space/index.h"
#include "space/kd_tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- the sides of boxes

unsigned sli_box_sides(sl_box box, sli_piece sides[4]) {
    const sl_point a = box.min, b = box.max;
    unsigned count = 0;
    if (a.y < b.y) {
        sides[count++] = (sli_piece){.axis = 0, .at = a.x, .lo = a.y, .hi = b.y};
        if (a.x < b.x) sides[count++] = (sli_piece){.axis = 0, .at = b.x, .lo = a.y, .hi = b.y};
    }
    if (a.x < b.x) {
        sides[count++] = (sli_piece){.axis = 1, .at = a.y, .lo = a.x, .hi = b.x};
        if (a.y < b.y) sides[count++] = (sli_piece){.axis = 1, .at = b.y, .lo = a.x, .hi = b.x};
    }
    return count;
}

sl_wall sli_piece_wall(const sli_piece *p) {
    return p->axis ? (sl_wall){.a = {p->lo, p->at}, .b = {p->hi, p->at}}
                   : (sl_wall){.a = {p->at, p->lo}, .b = {p->at, p->hi}};
}

static sl_status add_piece(sl_context *context, sli_piece_list *list, sli_piece piece) {
    SL_TRY(SL_ARRAY_ROOM(context, list, 1));
    list->items[list->count++] = piece;
    return SL_OK;
}

sl_status sli_piece_add_free(sl_context *context, const sli_piece *walls, size_t count,
                             sli_piece piece, sli_piece_list *out) {
    size_t i = sli_wall_lines_find(walls, count, piece.axis, piece.at, piece.lo);
    for (; i < count && piece.lo < piece.hi; i++) {
        const sli_piece *wall = &walls[i];
        if (wall->axis != piece.axis || wall->at != piece.at || wall->lo >= piece.hi) break;
        sli_piece before = piece;
        before.hi = wall->lo;
        if (before.lo < before.hi) SL_TRY(add_piece(context, out, before));
        piece.lo = fmax(piece.lo, wall->hi);
    }
    return piece.lo < piece.hi ? add_piece(context, out, piece) : SL_OK;
}

/// Sorts pieces, each place once: a piece that overlaps the one before it starts at its end.
/// Returns the number that is left.
static size_t sort_out(sli_piece *pieces, size_t count) {
    size_t kept = 0;
    if (count) qsort(pieces, count, sizeof *pieces, sli_compare_pieces);
    for (size_t i = 0; i < count; i++) {
        sli_piece piece = pieces[i];
        const sli_piece *last = kept ? &pieces[kept - 1] : NULL;
        if (last && last->axis == piece.axis && last->at == piece.at)
            piece.lo = fmax(piece.lo, last->hi);
        if (piece.lo < piece.hi) pieces[kept++] = piece;
    }
    return kept;
}

/// Keeps the part of a side within the bounds; false for none.
static bool clip(const sl_box *bounds, sli_piece *side) {
    const double at_lo = side->axis ? bounds->min.y : bounds->min.x;
    const double at_hi = side->axis ? bounds->max.y : bounds->max.x;
    side->lo = fmax(side->lo, side->axis ? bounds->min.x : bounds->min.y);
    side->hi = fmin(side->hi, side->axis ? bounds->max.x : bounds->max.y);
    return side->at >= at_lo && side->at <= at_hi && side->lo < side->hi;
}

static sl_status add_sides(sl_context *context, const sli_box_ground *ground,
                           const sl_moving_box *boxes, size_t count, bool blocking,
                           sli_piece_list *all, sli_piece_list *out) {
    for (size_t i = 0; i < count; i++) {
        sli_piece sides[4];
        const unsigned n = boxes[i].blocks == blocking ? sli_box_sides(boxes[i].box, sides) : 0;
        for (unsigned k = 0; k < n; k++)
            if (clip(&ground->space->bounds, &sides[k])) SL_TRY(add_piece(context, all, sides[k]));
    }
    all->count = sort_out(all->items, all->count);
    for (size_t i = 0; i < all->count; i++)
        SL_TRY(sli_piece_add_free(context, ground->walls, ground->wall_count, all->items[i], out));
    return SL_OK;
}

sl_status sli_box_sides_put(sl_context *context, const sli_box_ground *ground,
                            const sl_moving_box *boxes, size_t count, bool blocking,
                            sli_piece_list *out) {
    sli_piece_list all = {0};
    const sl_status status = add_sides(context, ground, boxes, count, blocking, &all, out);
    sl_free(context, all.items);
    return status;
}

sl_status sli_boxes_check(sl_context *context, const sl_moving_box *boxes, size_t count) {
    if (count >= UINT32_MAX) return sl_fail_memory(context);
    for (size_t i = 0; i < count; i++) {
        const sl_box b = boxes[i].box;
        if (!sl_coordinate_usable(b.min.x) || !sl_coordinate_usable(b.min.y) ||
            !sl_coordinate_usable(b.max.x) || !sl_coordinate_usable(b.max.y) || b.min.x > b.max.x ||
            b.min.y > b.max.y)
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "box %zu: coordinates must be as a map's, and the lower left corner not "
                           "beyond the upper right one",
                           i + 1);
    }
    return SL_OK;
}

// --- cells

/// Looks for a separating line among the sides of the box and of the cell.
bool sli_cell_meets_box(const sl_space *space, uint32_t number, sl_box box) {
    const sl_point corners[4] = {box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
    const sl_cell *cell = &space->cells[number];
    const sl_point *v = space->vertices + cell->first_vertex;
    bool left = true, right = true, under = true, over = true;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point next = v[i + 1 == cell->vertex_count ? 0 : i + 1];
        bool outside = true;
        for (int k = 0; k < 4 && outside; k++) outside = sli_orient(v[i], next, corners[k]) < 0;
        if (outside) return false;
        left &= v[i].x < box.min.x;
        right &= v[i].x > box.max.x;
        under &= v[i].y < box.min.y;
        over &= v[i].y > box.max.y;
    }
    return !left && !right && !under && !over;
}

void sl_cells_of_box(const sl_space *space, sl_box box, uint64_t *cells) {
    memset(cells, 0, sl_bits_words(space->cell_count) * sizeof *cells);
    if (!space->neighbour) {
        for (uint32_t i = 0; i < space->cell_count; i++)
            if (sli_cell_meets_box(space, i, box)) sl_bits_add(cells, i);
        return;
    }
    sli_cell_grid_range r = sli_cell_grid_range_of(space, box);
    for (uint32_t i; sli_cell_grid_next(&space->grid, &r, &i);)
        if (!sl_bits_has(cells, i) && sli_cell_meets_box(space, i, box)) sl_bits_add(cells, i);
}

// --- the ground

/// The axial walls of a mesh.
static sl_status gather_axial(sl_context *context, const sl_space *space, sli_box_ground *out) {
    sli_piece *pieces = sl_alloc_array(context, space->wall_count, sizeof *pieces);
    size_t count = 0;
    if (!pieces) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < space->wall_count; i++) {
        const sl_point a = space->walls[i].a, b = space->walls[i].b;
        sli_piece sides[4];
        // A box without width or height has one side.
        if (a.x == b.x || a.y == b.y)
            if (sli_box_sides(
                    (sl_box){{fmin(a.x, b.x), fmin(a.y, b.y)}, {fmax(a.x, b.x), fmax(a.y, b.y)}},
                    sides))
                pieces[count++] = sides[0];
    }
    *out = (sli_box_ground){space, pieces, sort_out(pieces, count)};
    return SL_OK;
}

sl_status sli_box_ground_create(sl_context *context, const sl_space *space, sli_box_ground *out) {
    if (space->directed_count != 2 * space->portal_count)
        return sl_fail(context, SL_UNSUPPORTED, "boxes are put in before one-way glass is");
    if (space->loose)
        return sl_fail(context, SL_UNSUPPORTED,
                       "boxes need cells that fit together, which a file of version 1 does not "
                       "have: bake the map again");
    if (space->neighbour) return gather_axial(context, space, out);
    sli_piece *walls = NULL;
    SL_TRY(sli_wall_lines(context, NULL, space->walls, space->wall_count, &walls));
    *out = (sli_box_ground){space, walls, space->wall_count};
    return SL_OK;
}

void sli_box_ground_destroy(sl_context *context, sli_box_ground *ground) {
    sl_free(context, ground->walls);
    *ground = (sli_box_ground){0};
}

/// A side of a box that runs through a cell, and the place in the tree that leads to the cell.
typedef struct cut {
    uint32_t cell;
    sli_piece side;
    int32_t node; ///< -1: the cell is the root
    bool above;
} cut;

/// A part of a cell still to be cut: by sides[first .. first + count).
typedef struct part {
    sl_box box;
    size_t first, count;
    int32_t node;
    bool above;
} part;

/// A portal, and the portal of the ground that it is a part of; UINT32_MAX for one within a cell.
typedef struct made_portal {
    sl_portal portal;
    uint32_t of;
} made_portal;

/// The lower side of a part of a cell: on the line `at`, from `lo` on.
typedef struct low_side {
    double at, lo;
    uint32_t part;
} low_side;

typedef struct maker {
    sl_context *context;
    const sli_box_ground *ground;
    const sl_space *from;
    sli_boxed_space *out;
    sli_piece_list blocking; ///< the sides of boxes that block
    sli_piece_list sides;    ///< of parts
    SL_ARRAY(cut) cuts;
    SL_ARRAY(part) parts;
    SL_ARRAY(sl_box) boxes; ///< of all cells
    SL_ARRAY(uint32_t) parents;
    SL_ARRAY(sl_node) nodes;
    SL_ARRAY(int32_t) stack;
    SL_ARRAY(made_portal) portals;
    SL_ARRAY(uint32_t) of_cut; ///< the parts of cells that are cut, cell after cell
    low_side *low_sides[2];    ///< by axis: those of the parts in of_cut, sorted within a cell
    uint32_t *first_part;      ///< by cell of the ground: in of_cut; UINT32_MAX: it is whole
    uint32_t *part_count;
    bool *touched; ///< by cell of the ground: a box lies in it or beside it
} maker;

// --- which cells are cut

/// Whether a side has a point strictly inside a box.
static bool runs_through(const sli_piece *side, const sl_box *box) {
    const double at_lo = side->axis ? box->min.y : box->min.x;
    const double at_hi = side->axis ? box->max.y : box->max.x;
    const double lo = side->axis ? box->min.x : box->min.y;
    const double hi = side->axis ? box->max.x : box->max.y;
    return at_lo < side->at && side->at < at_hi && side->lo < hi && side->hi > lo;
}

static sl_status push_child(maker *m, int32_t child) {
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->stack, 1));
    m->stack.items[m->stack.count++] = child;
    return SL_OK;
}

/// Finds the cells that a box touches, and those that its sides run through.
static sl_status find_cells(maker *m, sl_box box) {
    sli_piece sides[4];
    const unsigned count = sli_box_sides(box, sides);
    const sl_space *s = m->from;
    m->stack.count = 0;
    int32_t node = -1;
    bool above = false;
    for (int32_t child = s->root;;) {
        if (child >= 0) {
            const sl_node *n = &s->nodes[child];
            const double lo = n->axis ? box.min.y : box.min.x;
            const double hi = n->axis ? box.max.y : box.max.x;
            // The stack has 2 * node + 1 for the child above, 2 * node for the child below.
            if (lo <= n->position) SL_TRY(push_child(m, 2 * child));
            if (hi >= n->position) SL_TRY(push_child(m, 2 * child + 1));
        } else {
            const uint32_t cell = (uint32_t)~child;
            m->touched[cell] = true;
            for (unsigned k = 0; k < count; k++) {
                if (!runs_through(&sides[k], &m->boxes.items[cell])) continue;
                SL_TRY(SL_ARRAY_ROOM(m->context, &m->cuts, 1));
                m->cuts.items[m->cuts.count++] = (cut){cell, sides[k], node, above};
            }
        }
        if (!m->stack.count) return SL_OK;
        const int32_t next = m->stack.items[--m->stack.count];
        node = next / 2;
        above = next % 2;
        child = above ? s->nodes[node].above : s->nodes[node].below;
    }
}

// --- cutting

static void lead_to(maker *m, int32_t node, bool above, int32_t child) {
    if (node < 0)
        m->out->space.root = child;
    else if (above)
        m->nodes.items[node].above = child;
    else
        m->nodes.items[node].below = child;
}

static sl_status keep_part(maker *m, const part *p, uint32_t cell) {
    uint32_t number = cell;
    if (m->part_count[cell]) {
        number = (uint32_t)m->boxes.count;
        SL_TRY(SL_ARRAY_ROOM(m->context, &m->boxes, 1));
        SL_TRY(SL_ARRAY_ROOM(m->context, &m->parents, 1));
        m->boxes.count++;
        m->parents.items[m->parents.count++] = cell;
    }
    m->boxes.items[number] = p->box;
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->of_cut, 1));
    m->of_cut.items[m->of_cut.count++] = number;
    m->part_count[cell]++;
    lead_to(m, p->node, p->above, ~(int32_t)number);
    return SL_OK;
}

/// Cuts a part at its first side. Each half keeps the other sides that run through it.
static sl_status cut_part(maker *m, const part *p) {
    const sli_piece by = m->sides.items[p->first];
    const int32_t node = (int32_t)m->nodes.count;
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->nodes, 1));
    m->nodes.items[m->nodes.count++] = (sl_node){.position = by.at, .axis = by.axis};
    lead_to(m, p->node, p->above, node);
    for (int above = 0; above < 2; above++) {
        part half = {p->box, m->sides.count, 0, node, above};
        if (by.axis)
            *(above ? &half.box.min.y : &half.box.max.y) = by.at;
        else
            *(above ? &half.box.min.x : &half.box.max.x) = by.at;
        for (size_t i = p->first + 1; i < p->first + p->count; i++) {
            const sli_piece side = m->sides.items[i];
            if (runs_through(&side, &half.box)) SL_TRY(add_piece(m->context, &m->sides, side));
        }
        half.count = m->sides.count - half.first;
        SL_TRY(SL_ARRAY_ROOM(m->context, &m->parts, 1));
        m->parts.items[m->parts.count++] = half;
    }
    return SL_OK;
}

static sl_status cut_cell(maker *m, const cut *cuts, size_t count) {
    const uint32_t cell = cuts->cell;
    m->sides.count = 0;
    for (size_t i = 0; i < count; i++) SL_TRY(add_piece(m->context, &m->sides, cuts[i].side));
    m->first_part[cell] = (uint32_t)m->of_cut.count;
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->parts, 1));
    m->parts.items[0] = (part){m->boxes.items[cell], 0, count, cuts->node, cuts->above};
    m->parts.count = 1;
    while (m->parts.count) {
        const part p = m->parts.items[--m->parts.count];
        SL_TRY(p.count ? cut_part(m, &p) : keep_part(m, &p, cell));
    }
    return SL_OK;
}

static int compare_cuts(const void *left, const void *right) {
    const cut *a = left, *b = right;
    return (a->cell > b->cell) - (a->cell < b->cell);
}

static sl_status cut_cells(maker *m) {
    if (m->cuts.count) qsort(m->cuts.items, m->cuts.count, sizeof *m->cuts.items, compare_cuts);
    for (size_t i = 0, end; i < m->cuts.count; i = end) {
        for (end = i + 1; end < m->cuts.count && m->cuts.items[end].cell == m->cuts.items[i].cell;)
            end++;
        SL_TRY(sl_check_cancelled(m->context));
        SL_TRY(cut_cell(m, &m->cuts.items[i], end - i));
    }
    return m->boxes.count > UINT32_MAX / 4 ? sl_fail_memory(m->context) : SL_OK;
}

// --- portals

/// The piece of positive length that two cells share, the first of them below it; false for none.
static bool share(const sl_box *below, const sl_box *above, int axis, sli_piece *out) {
    const double at = axis ? below->max.y : below->max.x;
    if (at != (axis ? above->min.y : above->min.x)) return false;
    *out = (sli_piece){.axis = axis, .at = at};
    out->lo = axis ? fmax(below->min.x, above->min.x) : fmax(below->min.y, above->min.y);
    out->hi = axis ? fmin(below->max.x, above->max.x) : fmin(below->max.y, above->max.y);
    return out->lo < out->hi;
}

/// Adds the portals on a piece that two cells share, without the sides that block.
static sl_status add_portals(maker *m, uint32_t below, uint32_t above, sli_piece piece,
                             uint32_t of) {
    m->sides.count = 0;
    SL_TRY(sli_piece_add_free(m->context, m->blocking.items, m->blocking.count, piece, &m->sides));
    for (size_t i = 0; i < m->sides.count; i++) {
        const sli_piece *p = &m->sides.items[i];
        // Going up in the line's coordinate, the left hand is at high y (axis 0) or at low x.
        sl_point left = p->axis ? (sl_point){p->lo, p->at} : (sl_point){p->at, p->hi};
        sl_point right = p->axis ? (sl_point){p->hi, p->at} : (sl_point){p->at, p->lo};
        sl_portal portal = {{below, above}, left, right};
        if (below > above) portal = (sl_portal){{above, below}, right, left};
        SL_TRY(SL_ARRAY_ROOM(m->context, &m->portals, 1));
        m->portals.items[m->portals.count++] = (made_portal){portal, of};
    }
    return SL_OK;
}

/// The parts of a cell; a whole cell is its own part.
static const uint32_t *parts_of(const maker *m, const uint32_t *cell, uint32_t *count) {
    const uint32_t first = m->first_part[*cell];
    *count = first == UINT32_MAX ? 1 : m->part_count[*cell];
    return first == UINT32_MAX ? cell : m->of_cut.items + first;
}

static int compare_low_sides(const void *left, const void *right) {
    const low_side *a = left, *b = right;
    if (a->at != b->at) return a->at < b->at ? -1 : 1;
    return (a->lo > b->lo) - (a->lo < b->lo);
}

static sl_status sort_low_sides(maker *m) {
    for (int axis = 0; axis < 2; axis++) {
        low_side *sides = sl_alloc_array(m->context, m->of_cut.count, sizeof *sides);
        m->low_sides[axis] = sides;
        if (!sides) return SL_NO_MEMORY;
        for (size_t i = 0; i < m->of_cut.count; i++) {
            const sl_point low = m->boxes.items[m->of_cut.items[i]].min;
            sides[i] = (low_side){axis ? low.y : low.x, axis ? low.x : low.y, m->of_cut.items[i]};
        }
        for (uint32_t i = 0; i < m->from->cell_count; i++)
            if (m->first_part[i] != UINT32_MAX)
                qsort(sides + m->first_part[i], m->part_count[i], sizeof *sides, compare_low_sides);
    }
    return SL_OK;
}

/// The first of sorted lower sides that may reach beyond `lo` on the line `at`. Those on one line
/// do not overlap, so at most one begins before `lo` and does.
static uint32_t first_beyond(const low_side *sides, uint32_t count, double at, double lo) {
    uint32_t first = 0, end = count;
    const low_side wanted = {.at = at, .lo = lo};
    while (first < end) {
        const uint32_t middle = first + (end - first) / 2;
        if (compare_low_sides(&sides[middle], &wanted) < 0)
            first = middle + 1;
        else
            end = middle;
    }
    return first && sides[first - 1].at == at ? first - 1 : first;
}

/// Adds the portals, within limits, between a part and those parts of a cell that lie above it.
static sl_status join_part(maker *m, uint32_t below, uint32_t cell, int axis, sl_point limits,
                           uint32_t of) {
    const sl_box box = m->boxes.items[below];
    const double at = axis ? box.max.y : box.max.x;
    const double lo = axis ? box.min.x : box.min.y, hi = axis ? box.max.x : box.max.y;
    const sl_point low = m->boxes.items[cell].min;
    const low_side whole = {axis ? low.y : low.x, axis ? low.x : low.y, cell}, *sides = &whole;
    uint32_t count = 1;
    if (m->first_part[cell] != UINT32_MAX) {
        sides = m->low_sides[axis] + m->first_part[cell];
        count = m->part_count[cell];
    }
    for (uint32_t k = first_beyond(sides, count, at, lo);
         k < count && sides[k].at == at && sides[k].lo < hi; k++) {
        sli_piece piece;
        if (!share(&box, &m->boxes.items[sides[k].part], axis, &piece)) continue;
        piece.lo = fmax(piece.lo, limits.x);
        piece.hi = fmin(piece.hi, limits.y);
        if (piece.lo < piece.hi) SL_TRY(add_portals(m, below, sides[k].part, piece, of));
    }
    return SL_OK;
}

/// The portals between parts of cells that a portal of the ground becomes.
static sl_status take_portal(maker *m, uint32_t number) {
    const sl_portal *p = &m->from->portals[number];
    if (!m->touched[p->cell[0]] && !m->touched[p->cell[1]]) {
        SL_TRY(SL_ARRAY_ROOM(m->context, &m->portals, 1));
        m->portals.items[m->portals.count++] = (made_portal){*p, number};
        return SL_OK;
    }
    const int axis = p->left.x == p->right.x ? 0 : 1;
    const double lo = axis ? fmin(p->left.x, p->right.x) : fmin(p->left.y, p->right.y);
    const double hi = axis ? fmax(p->left.x, p->right.x) : fmax(p->left.y, p->right.y);
    // Crossed upwards, the left hand is at high y or at low x.
    const bool up = axis ? p->left.x < p->right.x : p->left.y > p->right.y;
    uint32_t below_count;
    const uint32_t *below = parts_of(m, &p->cell[up ? 0 : 1], &below_count);
    for (uint32_t i = 0; i < below_count; i++)
        SL_TRY(join_part(m, below[i], p->cell[up ? 1 : 0], axis, (sl_point){lo, hi}, number));
    return SL_OK;
}

/// The portals between the parts of a cell.
static sl_status join_parts(maker *m, uint32_t cell) {
    uint32_t count;
    const uint32_t *parts = parts_of(m, &cell, &count);
    for (uint32_t i = 0; i < count; i++) {
        SL_TRY(sl_check_cancelled(m->context));
        for (int axis = 0; axis < 2; axis++)
            SL_TRY(join_part(m, parts[i], cell, axis, (sl_point){-INFINITY, INFINITY}, UINT32_MAX));
    }
    return SL_OK;
}

/// Gives a part of a portal the seams that the portal lies on.
static void take_seams(maker *m, uint32_t number, const made_portal *made) {
    sl_space *s = &m->out->space;
    size_t count;
    const sl_seam_portal *on = sl_space_seams_of(m->from, made->of, &count);
    const sl_portal *was = &m->from->portals[made->of];
    const bool turned =
        (was->left.x > was->right.x) != (made->portal.left.x > made->portal.right.x) ||
        (was->left.y > was->right.y) != (made->portal.left.y > made->portal.right.y);
    for (size_t i = 0; i < count; i++) {
        sl_seam_portal tag = on[i];
        tag.portal = number;
        tag.forward = turned ? !tag.forward : tag.forward;
        s->seam_portals[s->seam_portal_count++] = tag;
    }
}

static sl_status write_portals(maker *m) {
    sl_space *s = &m->out->space;
    size_t tags = 0, count;
    if (m->portals.count > UINT32_MAX / 2) return sl_fail_memory(m->context);
    if (m->portals.count)
        qsort(m->portals.items, m->portals.count, sizeof *m->portals.items, sli_compare_portals);
    for (size_t i = 0; i < m->portals.count; i++)
        if (m->portals.items[i].of != UINT32_MAX) {
            sl_space_seams_of(m->from, m->portals.items[i].of, &count);
            tags += count;
        }
    s->portals = sl_alloc_array(m->context, m->portals.count, sizeof *s->portals);
    s->seam_portals = sl_alloc_array(m->context, tags, sizeof *s->seam_portals);
    if (!s->portals || !s->seam_portals) return SL_NO_MEMORY;
    for (size_t i = 0; i < m->portals.count; i++) {
        s->portals[i] = m->portals.items[i].portal;
        if (m->portals.items[i].of != UINT32_MAX) take_seams(m, (uint32_t)i, &m->portals.items[i]);
    }
    s->portal_count = (uint32_t)m->portals.count;
    s->directed_count = 2 * s->portal_count;
    return sli_make_directed(m->context, s);
}

static sl_status make_portals(maker *m) {
    SL_TRY(sort_low_sides(m));
    for (uint32_t i = 0; i < m->from->portal_count; i++) SL_TRY(take_portal(m, i));
    for (uint32_t i = 0; i < m->from->cell_count; i++)
        if (m->first_part[i] != UINT32_MAX) SL_TRY(join_parts(m, i));
    return write_portals(m);
}

// --- the space

static sl_status write_cells(maker *m) {
    const sl_space *f = m->from;
    sl_space *s = &m->out->space;
    s->cell_count = (uint32_t)m->boxes.count;
    s->vertex_count = 4 * s->cell_count;
    s->cells = sl_alloc_array(m->context, s->cell_count, sizeof *s->cells);
    s->vertices = sl_alloc_array(m->context, s->vertex_count, sizeof *s->vertices);
    if (!s->cells || !s->vertices) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < s->cell_count; i++) {
        const sl_box *box = &m->boxes.items[i];
        const sl_point corners[4] = {
            box->min, {box->max.x, box->min.y}, box->max, {box->min.x, box->max.y}};
        const sl_cell *parent = &f->cells[m->parents.items[i]];
        s->cells[i] = (sl_cell){.first_vertex = 4 * i,
                                .vertex_count = 4,
                                .inside = parent->inside,
                                .solid = parent->solid};
        s->inside_count += parent->inside;
        memcpy(&s->vertices[(size_t)4 * i], corners, sizeof corners);
    }
    return SL_OK;
}

static sl_status write_walls(maker *m) {
    const sl_space *f = m->from;
    sl_space *s = &m->out->space;
    const size_t count = f->wall_count + m->blocking.count;
    if (count > INT32_MAX) return sl_fail_memory(m->context);
    s->walls = sl_alloc_array(m->context, count, sizeof *s->walls);
    s->seams = sl_alloc_array(m->context, f->seam_count, sizeof *s->seams);
    if (!s->walls || !s->seams) return SL_NO_MEMORY;
    if (f->wall_count) memcpy(s->walls, f->walls, f->wall_count * sizeof *s->walls);
    if (f->seam_count) memcpy(s->seams, f->seams, f->seam_count * sizeof *s->seams);
    s->seam_count = f->seam_count;
    s->wall_count = f->wall_count;
    for (size_t i = 0; i < m->blocking.count; i++)
        s->walls[s->wall_count++] = sli_piece_wall(&m->blocking.items[i]);
    return SL_OK;
}

/// Takes the nodes, and finds the depth: nodes come after their parents.
static sl_status write_nodes(maker *m) {
    sl_space *s = &m->out->space;
    s->nodes = m->nodes.items;
    s->node_count = (uint32_t)m->nodes.count;
    m->nodes.items = NULL;
    uint32_t *depth = sl_alloc_array(m->context, s->node_count, sizeof *depth);
    if (!depth) return SL_NO_MEMORY;
    s->tree_depth = s->node_count ? 1 : 0;
    for (uint32_t i = 0; i < s->node_count; i++) {
        const int32_t children[2] = {s->nodes[i].below, s->nodes[i].above};
        if (depth[i] + 1 > s->tree_depth) s->tree_depth = depth[i] + 1;
        for (int k = 0; k < 2; k++)
            if (children[k] >= 0) depth[children[k]] = depth[i] + 1;
    }
    sl_free(m->context, depth);
    return SL_OK;
}

static sl_status begin_cutting(maker *m) {
    const sl_space *f = m->from;
    m->out->space = (sl_space){.bounds = f->bounds, .root = f->root};
    m->first_part = sl_alloc_array(m->context, f->cell_count, sizeof *m->first_part);
    m->part_count = sl_alloc_array(m->context, f->cell_count, sizeof *m->part_count);
    m->touched = sl_alloc_array(m->context, f->cell_count, sizeof *m->touched);
    if (!m->first_part || !m->part_count || !m->touched) return SL_NO_MEMORY;
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->boxes, f->cell_count));
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->parents, f->cell_count));
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->nodes, (size_t)f->node_count + 1));
    for (uint32_t i = 0; i < f->cell_count; i++) {
        const sl_point *corners = f->vertices + f->cells[i].first_vertex;
        m->boxes.items[i] = (sl_box){corners[0], corners[2]};
        m->parents.items[i] = i;
        m->first_part[i] = UINT32_MAX;
    }
    m->boxes.count = m->parents.count = f->cell_count;
    if (f->node_count) memcpy(m->nodes.items, f->nodes, f->node_count * sizeof *f->nodes);
    m->nodes.count = f->node_count;
    return SL_OK;
}

static sl_status make(maker *m, const sl_moving_box *boxes, size_t count) {
    SL_TRY(begin_cutting(m));
    SL_TRY(sli_box_sides_put(m->context, m->ground, boxes, count, true, &m->blocking));
    for (size_t i = 0; i < count; i++) SL_TRY(find_cells(m, boxes[i].box));
    SL_TRY(cut_cells(m));
    SL_TRY(write_cells(m));
    SL_TRY(write_walls(m));
    SL_TRY(write_nodes(m));
    SL_TRY(make_portals(m));
    m->out->parents = m->parents.items;
    m->parents.items = NULL;
    return SL_OK;
}

/// In a kd-tree's space.
static sl_status put_axial(sl_context *context, const sli_box_ground *ground,
                           const sl_moving_box *boxes, size_t count, sli_boxed_space *out) {
    maker m = {.context = context, .ground = ground, .from = ground->space, .out = out};
    const sl_status status = make(&m, boxes, count);
    void *const scratch[] = {m.blocking.items, m.sides.items,   m.cuts.items,  m.parts.items,
                             m.boxes.items,    m.parents.items, m.nodes.items, m.stack.items,
                             m.portals.items,  m.of_cut.items,  m.first_part,  m.part_count,
                             m.touched,        m.low_sides[0],  m.low_sides[1]};
    for (size_t i = 0; i < sizeof scratch / sizeof *scratch; i++) sl_free(context, scratch[i]);
    return status;
}

// --- any space

sl_status sli_boxes_put(sl_context *context, const sli_box_ground *ground,
                        const sl_moving_box *boxes, size_t count, sli_boxed_space *out) {
    sli_boxed_space made = {0};
    const sl_status status = ground->space->neighbour
                                 ? sli_boxes_put_mesh(context, ground, boxes, count, &made)
                                 : put_axial(context, ground, boxes, count, &made);
    if (status == SL_OK)
        *out = made;
    else
        sli_boxed_space_destroy(context, &made);
    return status;
}

void sli_boxed_space_destroy(sl_context *context, sli_boxed_space *boxed) {
    sl_space_destroy(context, &boxed->space);
    sl_free(context, boxed->parents);
    sl_free(context, boxed->first_share);
    sl_free(context, boxed->shares);
    *boxed = (sli_boxed_space){0};
}

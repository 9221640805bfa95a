/// From the BSP's faces to a space: cells numbered as the tree leads to them, portals, exits.
#include "space/bsp.h"

#include <stdlib.h>
#include <string.h>

/// A portal, and its places among the exits of its two cells.
typedef struct joint {
    sl_portal portal;
    uint32_t exits[2];
    uint32_t seam; ///< as of its sides
} joint;

typedef struct maker {
    sl_bsp *bsp;
    sl_space *space;
    uint32_t *cell_of; ///< by face
    uint32_t *face_of; ///< by cell
    bool *seen;        ///< by node: gone down already
    SL_ARRAY(joint) joints;
} maker;

/// Drops corners in the middle of what is one straight side: of one portal, wall, or the border.
static void join_sides(sl_bsp_sides *sides) {
    sl_bsp_side *items = sides->items;
    size_t kept = 0;
    const size_t count = sides->count;
    const sl_bsp_side first = items[0];
    for (size_t i = 0; i < count; i++) {
        const sl_bsp_side *before = kept ? &items[kept - 1] : &items[count - 1];
        const sl_point after = i + 1 < count ? items[i + 1].from : first.from;
        const bool same = before->what == items[i].what && before->beyond == items[i].beyond &&
                          before->reversed == items[i].reversed && before->seam == items[i].seam;
        if (same && sl_orient(before->from, items[i].from, after) == 0) continue;
        items[kept++] = items[i];
    }
    sides->count = kept;
}

/// The first corner is the leftmost, the lowest of those.
static size_t first_corner(const sl_bsp_sides *sides) {
    size_t first = 0;
    for (size_t i = 1; i < sides->count; i++) {
        const sl_point p = sides->items[i].from, q = sides->items[first].from;
        if (p.x < q.x || (p.x == q.x && p.y < q.y)) first = i;
    }
    return first;
}

static void keep_numbers(maker *m) {
    for (uint32_t i = 0; i < m->space->cell_count; i++) m->cell_of[i] = m->face_of[i] = i;
}

/// Numbers the cells as the tree leads to them first, what is below before what is above.
static void number_cells(maker *m, int32_t *stack) {
    sl_space *s = m->space;
    size_t count = 0;
    uint32_t cells = 0;
    for (uint32_t i = 0; i < s->cell_count; i++) m->cell_of[i] = UINT32_MAX;
    stack[count++] = m->bsp->root;
    while (count) {
        const int32_t at = stack[--count];
        if (at >= 0) {
            if (m->seen[at]) continue;
            m->seen[at] = true;
            stack[count++] = s->nodes[at].above;
            stack[count++] = s->nodes[at].below;
        } else if (m->cell_of[~at] == UINT32_MAX) {
            m->face_of[cells] = (uint32_t)~at;
            m->cell_of[~at] = cells++;
        }
    }
}

static int32_t renumbered(const maker *m, int32_t child) {
    return child < 0 ? ~(int32_t)m->cell_of[~child] : child;
}

static void deepen(uint32_t *depths, sl_space *s, int32_t child, uint32_t depth) {
    if (depth > s->tree_depth) s->tree_depth = depth;
    if (child >= 0 && depth > depths[child]) depths[child] = depth;
}

/// Gives the tree's leaves the cells' numbers, and measures its depth.
static void finish_tree(maker *m, uint32_t *depths) {
    sl_space *s = m->space;
    s->root = renumbered(m, m->bsp->root);
    for (uint32_t i = 0; i < s->node_count; i++) {
        sl_node *node = &s->nodes[i];
        node->below = renumbered(m, node->below);
        node->above = renumbered(m, node->above);
        deepen(depths, s, node->below, depths[i] + 1);
        deepen(depths, s, node->above, depths[i] + 1);
    }
}

static sl_status make_tree(maker *m) {
    sl_context *context = m->bsp->context;
    const size_t count = m->space->node_count;
    int32_t *stack = sl_alloc_array(context, 2 * count + 1, sizeof *stack);
    uint32_t *depths = sl_alloc_array(context, count, sizeof *depths);
    m->seen = sl_alloc_array(context, count, sizeof *m->seen);
    const bool done = stack && depths && m->seen;
    if (done) {
        if (m->bsp->of_space)
            keep_numbers(m);
        else
            number_cells(m, stack);
        finish_tree(m, depths);
    }
    sl_free(context, stack);
    sl_free(context, depths);
    sl_free(context, m->seen);
    return done ? SL_OK : SL_NO_MEMORY;
}

static sl_status copy_cells(maker *m) {
    sl_space *s = m->space;
    uint64_t vertices = 0, exits = 0;
    for (uint32_t i = 0; i < s->cell_count; i++) {
        sl_bsp_sides *sides = &m->bsp->faces.items[m->face_of[i]].sides;
        const size_t first = first_corner(sides);
        s->cells[i] = (sl_cell){.first_vertex = (uint32_t)vertices,
                                .vertex_count = (uint32_t)sides->count,
                                .first_exit = (uint32_t)exits};
        for (size_t k = 0; k < sides->count; k++) {
            const sl_bsp_side *side = &sides->items[(first + k) % sides->count];
            s->vertices[vertices] = side->from;
            s->beyond[vertices++] = side->what | (side->reversed ? SL_BEYOND_RIGHT : 0);
            s->cells[i].exit_count += side->what == SL_BEYOND_EXIT;
        }
        exits += s->cells[i].exit_count;
    }
    return SL_OK;
}

/// The number of a side among its cell's exits.
static uint32_t exit_number(const sl_bsp_sides *sides, size_t side) {
    uint32_t number = 0;
    for (size_t k = first_corner(sides); k != side; k = k + 1 == sides->count ? 0 : k + 1)
        number += sides->items[k].what == SL_BEYOND_EXIT;
    return number;
}

static sl_status add_joints(maker *m, uint32_t cell) {
    const uint32_t face = m->face_of[cell];
    const sl_bsp_sides *sides = &m->bsp->faces.items[face].sides;
    for (size_t i = 0; i < sides->count; i++) {
        const sl_bsp_side *side = &sides->items[i];
        if (side->what != SL_BEYOND_EXIT || m->cell_of[side->beyond] < cell) continue;
        const sl_bsp_face *beyond = &m->bsp->faces.items[side->beyond];
        const sl_point from = side->from, to = sl_side_end(sides, i);
        const size_t twin = sl_bsp_find_side(beyond, to, from, face);
        if (twin == SIZE_MAX)
            return sl_fail(m->bsp->context, SL_UNSUPPORTED, "a portal has lost its other side");
        const uint32_t other = m->cell_of[side->beyond];
        SL_TRY(SL_ARRAY_ROOM(m->bsp->context, &m->joints, 1));
        m->joints.items[m->joints.count++] = (joint){
            .portal = {.cell = {cell, other}, .left = to, .right = from},
            .exits = {m->space->cells[cell].first_exit + exit_number(sides, i),
                      m->space->cells[other].first_exit + exit_number(&beyond->sides, twin)},
            .seam = side->seam};
    }
    return SL_OK;
}

static int compare_joints(const void *left, const void *right) {
    const sl_portal *a = &((const joint *)left)->portal, *b = &((const joint *)right)->portal;
    for (int i = 0; i < 2; i++)
        if (a->cell[i] != b->cell[i]) return a->cell[i] < b->cell[i] ? -1 : 1;
    if (a->right.x != b->right.x) return a->right.x < b->right.x ? -1 : 1;
    return (a->right.y > b->right.y) - (a->right.y < b->right.y);
}

static sl_status make_portals(maker *m) {
    sl_space *s = m->space;
    for (uint32_t cell = 0; cell < s->cell_count; cell++) SL_TRY(add_joints(m, cell));
    const size_t count = m->joints.count;
    if (count > UINT32_MAX / 2) return sl_fail_memory(m->bsp->context);
    if (count) qsort(m->joints.items, count, sizeof(joint), compare_joints);
    s->portals = sl_alloc_array(m->bsp->context, count, sizeof *s->portals);
    s->exits = sl_alloc_array(m->bsp->context, 2 * count, sizeof *s->exits);
    if (!s->portals || !s->exits) return SL_NO_MEMORY;
    s->portal_count = (uint32_t)count;
    s->exit_count = 2 * s->portal_count;
    for (uint32_t i = 0; i < s->portal_count; i++) {
        const sl_portal *p = &m->joints.items[i].portal;
        s->portals[i] = *p;
        for (int side = 0; side < 2; side++)
            s->exits[m->joints.items[i].exits[side]] =
                (sl_exit){.portal = i,
                          .cell = p->cell[!side],
                          .left = side ? p->right : p->left,
                          .right = side ? p->left : p->right};
    }
    return SL_OK;
}

static sl_status allocate(maker *m) {
    sl_bsp *bsp = m->bsp;
    sl_space *s = m->space;
    uint64_t vertices = 0;
    for (size_t i = 0; i < bsp->faces.count; i++) {
        join_sides(&bsp->faces.items[i].sides);
        vertices += bsp->faces.items[i].sides.count;
    }
    if (vertices > UINT32_MAX - 1) return sl_fail_memory(bsp->context);
    s->cell_count = (uint32_t)bsp->faces.count;
    s->vertex_count = (uint32_t)vertices;
    s->node_count = (uint32_t)bsp->nodes.count;
    s->line_count = (uint32_t)bsp->lines.count;
    s->wall_count = (uint32_t)bsp->wall_count;
    s->cells = sl_alloc_array(bsp->context, s->cell_count, sizeof *s->cells);
    s->vertices = sl_alloc_array(bsp->context, s->vertex_count, sizeof *s->vertices);
    s->beyond = sl_alloc_array(bsp->context, s->vertex_count, sizeof *s->beyond);
    s->walls = sl_alloc_array(bsp->context, s->wall_count, sizeof *s->walls);
    s->nodes = sl_alloc_array(bsp->context, s->node_count, sizeof *s->nodes);
    s->lines = sl_alloc_array(bsp->context, s->line_count, sizeof *s->lines);
    m->cell_of = sl_alloc_array(bsp->context, s->cell_count, sizeof *m->cell_of);
    m->face_of = sl_alloc_array(bsp->context, s->cell_count, sizeof *m->face_of);
    if (!s->cells || !s->vertices || !s->beyond || !s->walls || !s->nodes || !s->lines ||
        !m->cell_of || !m->face_of)
        return SL_NO_MEMORY;
    if (s->wall_count) memcpy(s->walls, bsp->walls, s->wall_count * sizeof *s->walls);
    if (s->node_count) memcpy(s->nodes, bsp->nodes.items, s->node_count * sizeof *s->nodes);
    if (s->line_count) memcpy(s->lines, bsp->lines.items, s->line_count * sizeof *s->lines);
    return SL_OK;
}

static sl_status tag_portals(const maker *m, const sl_seam_parts *seams) {
    sl_context *context = m->bsp->context;
    uint32_t *on = sl_alloc_array(context, m->joints.count, sizeof *on);
    if (!on) return SL_NO_MEMORY;
    for (size_t i = 0; i < m->joints.count; i++) on[i] = m->joints.items[i].seam;
    const sl_status status = sl_seams_tag(context, seams, on, m->space);
    sl_free(context, on);
    return status;
}

sl_status sl_bsp_make_space(sl_bsp *bsp, const sl_seam_parts *seams, sl_space *out) {
    maker m = {.bsp = bsp, .space = out};
    sl_status status = allocate(&m);
    if (status == SL_OK) status = make_tree(&m);
    if (status == SL_OK) status = copy_cells(&m);
    if (status == SL_OK) status = make_portals(&m);
    if (status == SL_OK && seams->parts.count) status = tag_portals(&m, seams);
    sl_free(bsp->context, m.cell_of);
    sl_free(bsp->context, m.face_of);
    sl_free(bsp->context, m.joints.items);
    return status;
}

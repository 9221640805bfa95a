/// Boxes put into a BSP's space: its cells become faces again, and the boxes' sides are put in as
/// the map's walls were.
#include "space/boxes.h"

#include "space/box_tree.h"
#include "space/bsp.h"

#include <math.h>
#include <string.h>

typedef SL_ARRAY(sl_point) point_list;

typedef struct maker {
    sl_context *context;
    const sl_box_ground *ground;
    const sl_space *from;
    sl_boxed_space *out;
    sl_bsp bsp;
    sl_piece_list blocking;
    point_list polygon, cut;
    sl_wall *walls; ///< the ground's, and behind them the sides that block
} maker;

// --- faces

static sl_bsp_side side_of(const maker *m, uint32_t vertex, uint32_t *exit) {
    const sl_space *f = m->from;
    sl_bsp_side side = {
        .from = f->vertices[vertex], .what = f->beyond[vertex], .beyond = SL_NO_FACE};
    if (side.what == SL_BEYOND_EXIT) {
        side.beyond = f->exits[(*exit)++].cell;
    } else if (side.what != SL_BEYOND_BORDER) {
        side.reversed = (side.what & SL_BEYOND_RIGHT) != 0;
        side.what &= ~SL_BEYOND_RIGHT;
    }
    return side;
}

static sl_status take_cells(maker *m) {
    const sl_space *f = m->from;
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->bsp.faces, f->cell_count));
    for (uint32_t i = 0; i < f->cell_count; i++) {
        const sl_cell *cell = &f->cells[i];
        sl_bsp_face *face = &m->bsp.faces.items[m->bsp.faces.count++];
        *face = (sl_bsp_face){.of = i};
        SL_TRY(SL_ARRAY_ROOM(m->context, &face->sides, cell->vertex_count));
        uint32_t exit = cell->first_exit;
        for (uint32_t k = 0; k < cell->vertex_count; k++)
            face->sides.items[face->sides.count++] = side_of(m, cell->first_vertex + k, &exit);
    }
    return SL_OK;
}

static sl_status add_place(maker *m, int32_t child, sl_bsp_spot place) {
    if (child >= 0) return SL_OK;
    sl_bsp_face *face = &m->bsp.faces.items[~child];
    SL_TRY(SL_ARRAY_ROOM(m->context, &face->places, 1));
    face->places.items[face->places.count++] = place;
    return SL_OK;
}

static sl_status take_tree(maker *m) {
    const sl_space *f = m->from;
    sl_bsp *bsp = &m->bsp;
    bsp->root = f->root;
    SL_TRY(SL_ARRAY_ROOM(m->context, &bsp->nodes, f->node_count));
    SL_TRY(SL_ARRAY_ROOM(m->context, &bsp->lines, f->line_count));
    if (f->node_count) memcpy(bsp->nodes.items, f->nodes, f->node_count * sizeof *f->nodes);
    if (f->line_count) memcpy(bsp->lines.items, f->lines, f->line_count * sizeof *f->lines);
    bsp->nodes.count = f->node_count;
    bsp->lines.count = f->line_count;
    SL_TRY(add_place(m, f->root, (sl_bsp_spot){.node = -1}));
    for (uint32_t i = 0; i < f->node_count; i++) {
        SL_TRY(add_place(m, f->nodes[i].below, (sl_bsp_spot){(int32_t)i, false}));
        SL_TRY(add_place(m, f->nodes[i].above, (sl_bsp_spot){(int32_t)i, true}));
    }
    return SL_OK;
}

// --- the boxes' sides

static sl_status gather_walls(maker *m, const sl_moving_box *boxes, size_t count) {
    const sl_space *f = m->from;
    SL_TRY(sl_box_sides_blocking(m->context, m->ground, boxes, count, &m->blocking));
    const size_t walls = f->wall_count + m->blocking.count;
    if (walls >= INT32_MAX - 1) return sl_fail_memory(m->context);
    m->walls = sl_alloc_array(m->context, walls, sizeof *m->walls);
    if (!m->walls) return SL_NO_MEMORY;
    if (f->wall_count) memcpy(m->walls, f->walls, f->wall_count * sizeof *f->walls);
    for (size_t i = 0; i < m->blocking.count; i++)
        m->walls[f->wall_count + i] = sl_piece_wall(&m->blocking.items[i]);
    m->bsp.walls = m->walls;
    m->bsp.wall_count = (uint32_t)walls;
    return SL_OK;
}

static sl_box box_of(const sl_bsp_sides *sides) {
    sl_box box = sl_box_around(sides->items[0].from, sides->items[1].from);
    for (size_t k = 2; k < sides->count; k++) box = sl_box_with(box, sides->items[k].from);
    return box;
}

static bool meet(const sl_box *a, const sl_box *b) {
    return a->min.x <= b->max.x && b->min.x <= a->max.x && a->min.y <= b->max.y &&
           b->min.y <= a->max.y;
}

/// Gives a face the sides that it has inside, and makes walls of portals that they lie on.
static sl_status deal_to(maker *m, uint32_t face) {
    sl_bsp *bsp = &m->bsp;
    const sl_box box = box_of(&bsp->faces.items[face].sides);
    for (uint32_t i = m->from->wall_count; i < bsp->wall_count; i++) {
        const sl_wall *wall = &bsp->walls[i];
        const sl_box around = sl_box_around(wall->a, wall->b);
        size_t along;
        if (!meet(&box, &around)) continue;
        if (sl_bsp_hits(&bsp->faces.items[face].sides, wall, &along))
            SL_TRY(sl_bsp_add_wall(bsp, face, i));
        else if (along != SIZE_MAX)
            SL_TRY(sl_bsp_close_portals(bsp, face, i));
    }
    return SL_OK;
}

// --- the space

static sl_status write_parents(maker *m) {
    sl_space *s = &m->out->space;
    m->out->parents = sl_alloc_array(m->context, s->cell_count, sizeof *m->out->parents);
    if (!m->out->parents) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < s->cell_count; i++) {
        m->out->parents[i] = m->bsp.faces.items[i].of;
        s->cells[i].inside = m->from->cells[m->out->parents[i]].inside;
        s->inside_count += s->cells[i].inside;
    }
    return SL_OK;
}

// --- parts that reach into other cells

/// What of a polygon is at the left of a line, in doubles.
static sl_status cut_off(maker *m, sl_point a, sl_point b) {
    m->cut.count = 0;
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->cut, 2 * m->polygon.count));
    for (size_t i = 0; i < m->polygon.count; i++) {
        const sl_point p = m->polygon.items[i];
        const sl_point q = m->polygon.items[i + 1 == m->polygon.count ? 0 : i + 1];
        const double length = hypot(b.x - a.x, b.y - a.y);
        const double ux = (b.x - a.x) / length, uy = (b.y - a.y) / length;
        const double at_p = ux * (p.y - a.y) - uy * (p.x - a.x);
        const double at_q = ux * (q.y - a.y) - uy * (q.x - a.x);
        if (at_p >= 0) m->cut.items[m->cut.count++] = p;
        if ((at_p < 0) == (at_q < 0)) continue;
        const double t = at_p / (at_p - at_q);
        m->cut.items[m->cut.count++] = (sl_point){p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
    }
    const point_list taken = m->polygon;
    m->polygon = m->cut;
    m->cut = taken;
    return SL_OK;
}

/// How wide what a cell has in common with one of the ground is, about: 0 for nothing.
static sl_status measure_common(maker *m, uint32_t cell, uint32_t other, double *width) {
    const sl_cell *c = &m->out->space.cells[cell], *g = &m->from->cells[other];
    const sl_point *v = m->from->vertices + g->first_vertex;
    double area = 0, around = 0;
    m->polygon.count = 0;
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->polygon, c->vertex_count));
    for (uint32_t i = 0; i < c->vertex_count; i++)
        m->polygon.items[m->polygon.count++] = m->out->space.vertices[c->first_vertex + i];
    for (uint32_t i = 0; i < g->vertex_count && m->polygon.count; i++)
        SL_TRY(cut_off(m, v[i], v[i + 1 == g->vertex_count ? 0 : i + 1]));
    for (size_t i = 0; i < m->polygon.count; i++) {
        const sl_point o = m->polygon.items[0], p = m->polygon.items[i];
        const sl_point q = m->polygon.items[i + 1 == m->polygon.count ? 0 : i + 1];
        area += (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
        around += hypot(q.x - p.x, q.y - p.y);
    }
    *width = around > 0 ? area / around : 0;
    return SL_OK;
}

/// Whether a cell is one of the ground as it was.
static bool is_untouched(const maker *m, uint32_t cell) {
    if (cell >= m->from->cell_count) return false;
    const sl_cell *a = &m->out->space.cells[cell], *b = &m->from->cells[cell];
    return a->vertex_count == b->vertex_count &&
           memcmp(m->out->space.vertices + a->first_vertex, m->from->vertices + b->first_vertex,
                  a->vertex_count * sizeof(sl_point)) == 0;
}

static sl_box box_of_corners(const sl_space *space, uint32_t number) {
    const sl_cell *cell = &space->cells[number];
    const sl_point *v = space->vertices + cell->first_vertex;
    sl_box box = sl_box_around(v[0], v[1]);
    for (uint32_t i = 2; i < cell->vertex_count; i++) box = sl_box_with(box, v[i]);
    return box;
}

/// Tells of a cell the others of the ground that it reaches into by more than rounding, beside its
/// parent.
static sl_status find_shares(maker *m, uint32_t cell) {
    const double slack = sl_bsp_slack(&m->from->bounds);
    const sl_box box = box_of_corners(&m->out->space, cell);
    for (uint32_t i = 0; i < m->from->cell_count; i++) {
        const sl_box around = box_of_corners(m->from, i);
        double width;
        if (i == m->out->parents[cell] || !meet(&box, &around)) continue;
        SL_TRY(measure_common(m, cell, i, &width));
        if (width <= slack) continue;
        SL_TRY(SL_ARRAY_ROOM(m->context, &m->out->shares, 1));
        m->out->shares.items[m->out->shares.count++] = (sl_box_share){cell, i};
    }
    return SL_OK;
}

static sl_status make(maker *m, const sl_moving_box *boxes, size_t count) {
    m->out->space = (sl_space){.bounds = m->from->bounds, .partial = m->from->partial};
    SL_TRY(gather_walls(m, boxes, count));
    SL_TRY(take_cells(m));
    SL_TRY(take_tree(m));
    for (uint32_t i = 0; i < m->from->cell_count; i++) SL_TRY(deal_to(m, i));
    SL_TRY(sl_bsp_settle(&m->bsp));
    const sl_seam_parts no_seams = {0};
    SL_TRY(sl_bsp_make_space(&m->bsp, &no_seams, &m->out->space));
    SL_TRY(write_parents(m));
    for (uint32_t i = 0; i < m->out->space.cell_count; i++)
        if (!is_untouched(m, i)) SL_TRY(find_shares(m, i));
    return SL_OK;
}

sl_status sl_boxes_put_bsp(sl_context *context, const sl_box_ground *ground,
                           const sl_moving_box *boxes, size_t count, sl_boxed_space *out) {
    const sl_bsp_options options = sl_bsp_options_default();
    maker m = {.context = context, .ground = ground, .from = ground->space, .out = out};
    m.bsp = (sl_bsp){
        .context = context, .options = &options, .bounds = ground->space->bounds, .of_space = true};
    const sl_status status = make(&m, boxes, count);
    sl_bsp_destroy(&m.bsp);
    sl_free(context, m.blocking.items);
    sl_free(context, m.walls);
    sl_free(context, m.polygon.items);
    sl_free(context, m.cut.items);
    return status;
}

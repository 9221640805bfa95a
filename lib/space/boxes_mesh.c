/// Boxes put into a mesh: the cells that their sides touch are cut anew.
///
/// The walls and portals of these cells, and the sides of the boxes, become a planar graph. It is
/// triangulated and merged to cells, as for a map (mesh.h):
///
///     .-----.-----.           .-----.-----.       the portal and the wall that the box crosses are
///     |    /|      \          |    / \_    \      bent to representable points of its sides; the
///     |  [---]      .   ->    |  [-+--]-----.     sides of the box are axial, so they hold these
///     |  [---]     /          |  [---]     /      points exactly
///     '-----'-----'           '-----'-----'
///
/// The parts of a cell stay within its own walls and portals. The borders to untouched cells must
/// not change. If a bent wall comes to cross one, the cell there is cut too, and all is done again.
/// This ends, as there are only so many cells.
#include "space/boxes.h"

#include "geometry/orient.h"
#include "space/index.h"
#include "space/mesh.h"

#include <string.h>

#define NONE UINT32_MAX

/// A wall or portal of cells that are cut.
typedef struct line {
    uint32_t cells[2]; ///< of the ground, at its left and right; NONE outside the border
    uint32_t wall;     ///< NONE for a portal
    uint32_t portal;   ///< the line runs from its right to its left; NONE for a wall
} line;

/// The line that an edge of the graph is part of.
typedef struct graph_edge {
    uint32_t neighbour; ///< of a cell at its left, as in sl_space.neighbour
    uint32_t line;      ///< NONE for none
    bool along;         ///< it runs as the line does
    bool shared;        ///< several lines have it
    uint32_t of;        ///< the portal of the ground whose seams it has; NONE for none
    bool of_along;      ///< it runs from the right to the left of that portal
} graph_edge;

/// The portal of the ground that a portal is part of, and whether it has the same cell[0] side.
typedef struct origin {
    uint32_t portal; ///< NONE for none with seams
    bool turned;
} origin;

/// The new cell at one side of a portal of the ground, and the place of its directed portal.
typedef struct portal_end {
    uint32_t cell, directed;
} portal_end;

typedef struct new_cell {
    uint32_t parent;
    uint32_t half; ///< one of its half-edges; NONE for a cell that is not cut
} new_cell;

typedef struct polygon {
    const sl_point *corners;
    uint32_t count; ///< 2 for a segment
} polygon;

typedef struct maker {
    sl_context *context;
    const sli_box_ground *ground;
    const sl_space *from;
    sli_boxed_space *out;
    bool *touched;        ///< by cell of the ground
    uint32_t *wall_cells; ///< by wall of the ground: the cells at its left and right
    sli_piece_list blocking, open;
    SL_ARRAY(sl_segment) segments; ///< lines, then sides that block, then other sides
    SL_ARRAY(line) lines;
    sli_planar graph;
    sli_triangulation t;
    graph_edge *edges;
    bool *in;                 ///< by half-edge: it is in a cell that is cut
    uint32_t *cell;           ///< by half-edge: the new cell, NONE for none
    SL_ARRAY(uint32_t) stack; ///< half-edges to visit
    SL_ARRAY(new_cell) cells;
    SL_ARRAY(sl_point) corners; ///< of the current cell
    uint32_t *directed;         ///< by half-edge
    portal_end *ends;           ///< two by portal of the ground
    SL_ARRAY(sli_mesh_joint) joints;
    SL_ARRAY(origin) origins; ///< by sli_mesh_joint.half
    bool crowded;             ///< an edge has the seams of several portals
    SL_ARRAY(uint32_t) shares;
} maker;

// --- polygons

static polygon polygon_of(const sl_space *space, uint32_t cell) {
    return (polygon){space->vertices + space->cells[cell].first_vertex,
                     space->cells[cell].vertex_count};
}

static sl_point corner_after(const polygon *p, uint32_t i) {
    return p->corners[i + 1 < p->count ? i + 1 : 0];
}

static sl_box box_of(const polygon *p) {
    sl_box box = sli_box_around(p->corners[0], p->corners[1]);
    for (uint32_t i = 2; i < p->count; i++) box = sli_box_with(box, p->corners[i]);
    return box;
}

/// Whether all corners are at the left of a line or on it.
static bool is_left_of(const polygon *p, sl_point a, sl_point b) {
    for (uint32_t i = 0; i < p->count; i++)
        if (sli_orient(a, b, p->corners[i]) < 0) return false;
    return true;
}

static bool is_within(const polygon *p, const polygon *outer) {
    for (uint32_t i = 0; i < outer->count; i++)
        if (!is_left_of(p, outer->corners[i], corner_after(outer, i))) return false;
    return true;
}

static bool is_beside(const polygon *p, const polygon *other) {
    for (uint32_t i = 0; i < p->count; i++)
        if (is_left_of(other, corner_after(p, i), p->corners[i])) return true;
    return false;
}

/// Whether the insides of two polygons, or of a polygon and a segment, overlap.
static bool overlap(const polygon *p, const polygon *q) {
    return !is_beside(p, q) && !is_beside(q, p);
}

// --- the cells to be cut

static void touch_along(maker *m, const sli_piece_list *sides) {
    for (size_t i = 0; i < sides->count; i++) {
        const sl_wall side = sli_piece_wall(&sides->items[i]);
        const sl_box box = {side.a, side.b};
        sli_cell_grid_range r = sli_cell_grid_range_of(m->from, box);
        for (uint32_t at; sli_cell_grid_next(&m->from->grid, &r, &at);)
            if (!m->touched[at] && sli_cell_meets_box(m->from, at, box)) m->touched[at] = true;
    }
}

static sl_status find_wall_cells(maker *m) {
    const sl_space *f = m->from;
    m->wall_cells = sl_alloc_array(m->context, 2 * (size_t)f->wall_count, sizeof *m->wall_cells);
    if (!m->wall_cells) return SL_NO_MEMORY;
    for (size_t i = 0; i < 2 * (size_t)f->wall_count; i++) m->wall_cells[i] = NONE;
    for (uint32_t i = 0; i < f->cell_count; i++)
        for (uint32_t k = 0; k < f->cells[i].vertex_count; k++) {
            const uint32_t what = f->neighbour[f->cells[i].first_vertex + k];
            if (what < SL_NEIGHBOUR_BORDER)
                m->wall_cells[2 * (what & ~SL_NEIGHBOUR_RIGHT) +
                              (what & SL_NEIGHBOUR_RIGHT ? 1 : 0)] = i;
        }
    return SL_OK;
}

static bool is_cut(const maker *m, uint32_t cell) {
    return cell != NONE && m->touched[cell];
}

static sl_status add_segment(maker *m, sl_point a, sl_point b) {
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->segments, 1));
    m->segments.items[m->segments.count++] = (sl_segment){a, b};
    return SL_OK;
}

static sl_status add_line(maker *m, line l, sl_point a, sl_point b) {
    if (!is_cut(m, l.cells[0]) && !is_cut(m, l.cells[1])) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->lines, 1));
    m->lines.items[m->lines.count++] = l;
    return add_segment(m, a, b);
}

static sl_status add_sides(maker *m, const sli_piece_list *sides) {
    for (size_t i = 0; i < sides->count; i++) {
        const sl_wall side = sli_piece_wall(&sides->items[i]);
        SL_TRY(add_segment(m, side.a, side.b));
    }
    return SL_OK;
}

static sl_status gather_segments(maker *m) {
    const sl_space *f = m->from;
    m->segments.count = m->lines.count = 0;
    for (uint32_t i = 0; i < f->wall_count; i++) {
        const line l = {{m->wall_cells[2 * i], m->wall_cells[2 * i + 1]}, i, NONE};
        SL_TRY(add_line(m, l, f->walls[i].a, f->walls[i].b));
    }
    for (uint32_t i = 0; i < f->portal_count; i++) {
        const sl_portal *p = &f->portals[i];
        const line l = {{p->cell[0], p->cell[1]}, NONE, i};
        SL_TRY(add_line(m, l, p->right, p->left));
    }
    SL_TRY(add_sides(m, &m->blocking));
    return add_sides(m, &m->open);
}

// --- the graph

/// Gives an edge the seams of a line that it is part of.
static void take_seams(maker *m, graph_edge *e, uint32_t portal, bool along) {
    size_t count = 0;
    if (portal != NONE && m->from->seam_count) sl_space_seams_of(m->from, portal, &count);
    if (!count) return;
    m->crowded |= e->of != NONE;
    e->of = portal;
    e->of_along = along;
}

static sl_status take_edges(maker *m) {
    const sli_planar *g = &m->graph;
    sl_free(m->context, m->edges);
    m->crowded = false;
    m->edges = sl_alloc_array(m->context, g->edge_count, sizeof *m->edges);
    if (!m->edges) return SL_NO_MEMORY;
    for (size_t i = 0; i < g->edge_count; i++)
        m->edges[i] = (graph_edge){.neighbour = SL_NEIGHBOUR_PORTAL, .line = NONE, .of = NONE};
    for (size_t i = 0; i < m->lines.count + m->blocking.count; i++)
        for (size_t k = g->first[i]; k < g->first[i + 1]; k++) {
            graph_edge *e = &m->edges[g->links[k] / 2];
            const bool along = g->links[k] % 2 == 0;
            const uint32_t wall = i < m->lines.count
                                      ? m->lines.items[i].wall
                                      : (uint32_t)(m->from->wall_count + i - m->lines.count);
            if (wall != NONE && e->neighbour == SL_NEIGHBOUR_PORTAL)
                e->neighbour = wall | (along ? 0 : SL_NEIGHBOUR_RIGHT);
            if (i >= m->lines.count) continue;
            e->shared = e->line != NONE;
            if (!e->shared) e->line = (uint32_t)i, e->along = along;
            take_seams(m, e, m->lines.items[i].portal, along);
        }
    return SL_OK;
}

/// Whether a line has a cut cell on one side and an uncut one on the other.
static bool leads_out(const maker *m, const line *l) {
    return l->cells[0] != NONE && l->cells[1] != NONE &&
           m->touched[l->cells[0]] != m->touched[l->cells[1]];
}

/// Adds the uncut cells whose border changed to the cut ones; false for none.
static bool grow(maker *m) {
    const sli_planar *g = &m->graph;
    bool grown = false;
    for (size_t i = 0; i < m->lines.count; i++) {
        const uint32_t *cells = m->lines.items[i].cells;
        if (!leads_out(m, &m->lines.items[i])) continue;
        const size_t first = g->first[i];
        if (g->first[i + 1] == first + 1 && !m->edges[g->links[first] / 2].shared) continue;
        m->touched[cells[0]] = m->touched[cells[1]] = grown = true;
    }
    return grown;
}

static sl_box region_box(const maker *m) {
    sl_box box = sli_box_around(m->segments.items[0].a, m->segments.items[0].b);
    for (uint32_t i = 0; i < m->from->cell_count; i++) {
        const polygon cell = polygon_of(m->from, i);
        for (uint32_t k = 0; k < cell.count && m->touched[i]; k++)
            box = sli_box_with(box, cell.corners[k]);
    }
    return box;
}

static const graph_edge *edge_of(const maker *m, uint32_t half, bool *along) {
    const uint32_t label = m->t.labels[half / 2];
    if (!label) return NULL;
    *along = m->t.halves.items[half].from == m->graph.edges[label - 1].a;
    return &m->edges[label - 1];
}

/// The cell at the left of a half-edge on a border between cut and uncut cells; else NONE.
static uint32_t cell_at_border(const maker *m, uint32_t half) {
    bool along = false;
    const graph_edge *e = edge_of(m, half, &along);
    if (!e || e->line == NONE || !leads_out(m, &m->lines.items[e->line])) return NONE;
    return m->lines.items[e->line].cells[along == e->along ? 0 : 1];
}

static sl_status enter_triangle(maker *m, uint32_t half) {
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->stack, 3));
    for (int i = 0; i < 3; i++, half = m->t.halves.items[half].next) {
        m->in[half] = true;
        m->stack.items[m->stack.count++] = half;
    }
    return SL_OK;
}

/// Finds the triangles of the cut cells, from their borders on. Without borders, all triangles.
static sl_status find_inside(maker *m) {
    const size_t halves = m->t.halves.count;
    bool bordered = false;
    sl_free(m->context, m->in);
    m->in = sl_alloc_array(m->context, halves, sizeof *m->in);
    if (!m->in) return SL_NO_MEMORY;
    for (uint32_t half = 0; half < halves; half++) {
        const uint32_t cell = cell_at_border(m, half);
        bordered |= cell != NONE;
        if (!m->in[half] && is_cut(m, cell)) SL_TRY(enter_triangle(m, half));
    }
    while (m->stack.count) {
        const uint32_t twin = m->stack.items[--m->stack.count] ^ 1;
        if (!sli_half_is_outside(&m->t, twin) && !m->in[twin] && cell_at_border(m, twin) == NONE)
            SL_TRY(enter_triangle(m, twin));
    }
    for (uint32_t half = 0; half < halves && !bordered; half++)
        m->in[half] = !sli_half_is_outside(&m->t, half);
    return SL_OK;
}

/// Adds the cells that bent lines have entered to the cut ones; false for none.
static bool take_strays(maker *m) {
    bool grown = false;
    for (uint32_t half = 0; half < m->t.halves.count; half++) {
        const sl_point ends[2] = {m->t.points.items[m->t.halves.items[half].from],
                                  m->t.points.items[sli_half_end(&m->t, half)]};
        const polygon edge = {ends, 2};
        if (!m->t.labels[half / 2] || sli_half_is_outside(&m->t, half) || m->in[half] ||
            cell_at_border(m, half) != NONE)
            continue;
        sli_cell_grid_range r = sli_cell_grid_range_of(m->from, box_of(&edge));
        for (uint32_t at; sli_cell_grid_next(&m->from->grid, &r, &at);) {
            const polygon cell = polygon_of(m->from, at);
            if (!m->touched[at] && overlap(&edge, &cell)) m->touched[at] = grown = true;
        }
    }
    return grown;
}

static sl_status make_graph(maker *m) {
    SL_TRY(sl_check_cancelled(m->context));
    SL_TRY(gather_segments(m));
    sli_planar_destroy(m->context, &m->graph);
    SL_TRY(sli_planar_make(m->context, "the space with boxes", m->segments.items, m->segments.count,
                           0, &m->graph));
    return take_edges(m);
}

static sl_status make_triangles(maker *m) {
    if (!m->blocking.count && !m->open.count) return SL_OK;
    do {
        do SL_TRY(make_graph(m));
        while (grow(m));
        const sl_box box = region_box(m);
        sli_triangulation_destroy(m->context, &m->t);
        SL_TRY(sli_triangulate(m->context, &m->graph, &box, &m->t));
        SL_TRY(find_inside(m));
    } while (take_strays(m));
    return SL_OK;
}

// --- the cells

/// Gathers the corners of the cell of a half-edge.
static sl_status gather_corners(maker *m, uint32_t half) {
    const uint32_t first = half;
    m->corners.count = 0;
    do {
        SL_TRY(SL_ARRAY_ROOM(m->context, &m->corners, 1));
        m->corners.items[m->corners.count++] = m->t.points.items[m->t.halves.items[half].from];
        half = m->t.halves.items[half].next;
    } while (half != first);
    return SL_OK;
}

/// The cell of the ground that a new cell is within. Bent lines may leave none; then the one at its
/// middle, or any one that it overlaps.
static uint32_t parent_of(const maker *m, const polygon *p) {
    sl_point middle = {0, 0};
    for (uint32_t i = 0; i < p->count; i++) {
        middle.x += p->corners[i].x / p->count;
        middle.y += p->corners[i].y / p->count;
    }
    uint32_t found = sl_space_locate(m->from, middle);
    if (!is_cut(m, found)) found = NONE;
    if (found != NONE) {
        const polygon cell = polygon_of(m->from, found);
        if (is_within(p, &cell)) return found;
    }
    sli_cell_grid_range r = sli_cell_grid_range_of(m->from, box_of(p));
    for (uint32_t at; sli_cell_grid_next(&m->from->grid, &r, &at);) {
        const polygon cell = polygon_of(m->from, at);
        if (!m->touched[at]) continue;
        if (is_within(p, &cell)) return at;
        if (found == NONE && overlap(p, &cell)) found = at;
    }
    return found;
}

/// Adds a cell, with the number of its parent if that is free.
static sl_status add_cell(maker *m, uint32_t parent, uint32_t half) {
    if (m->cells.items[parent].half == NONE) {
        m->cells.items[parent].half = half;
        return SL_OK;
    }
    if (m->cells.count > UINT32_MAX / 8) return sl_fail_memory(m->context);
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->cells, 1));
    m->cells.items[m->cells.count++] = (new_cell){parent, half};
    return SL_OK;
}

/// Nothing may be left of a cell as narrow as a step of doubles. The last cell takes its number.
static void close_gaps(maker *m) {
    for (uint32_t i = 0; i < m->cells.count; i++)
        while (i < m->cells.count && m->cells.items[i].half == NONE &&
               m->touched[m->cells.items[i].parent])
            m->cells.items[i] = m->cells.items[--m->cells.count];
}

static sl_status make_cells(maker *m) {
    const size_t halves = m->t.halves.count;
    SL_TRY(sli_mesh_merge(m->context, &m->t, NULL, NULL, &m->cell));
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->cells, m->from->cell_count));
    for (uint32_t i = 0; i < m->from->cell_count; i++)
        m->cells.items[m->cells.count++] = (new_cell){i, NONE};
    for (uint32_t half = 0; half < halves; half++) {
        if (!m->in[half]) m->cell[half] = NONE;
        if (m->cell[half]) continue; // not there, or noted
        SL_TRY(gather_corners(m, half));
        const polygon p = {m->corners.items, (uint32_t)m->corners.count};
        SL_TRY(add_cell(m, parent_of(m, &p), half));
        for (uint32_t at = half; !m->cell[at]; at = m->t.halves.items[at].next) m->cell[at] = 1;
    }
    close_gaps(m);
    for (uint32_t i = 0; i < m->cells.count; i++) {
        const uint32_t first = m->cells.items[i].half;
        uint32_t half = first;
        if (first == NONE) continue;
        do m->cell[half] = i;
        while ((half = m->t.halves.items[half].next) != first);
    }
    return SL_OK;
}

static uint32_t neighbour_of(const maker *m, uint32_t half) {
    bool along = false;
    const graph_edge *e = edge_of(m, half, &along);
    if (e && e->neighbour != SL_NEIGHBOUR_PORTAL)
        return along ? e->neighbour : e->neighbour ^ SL_NEIGHBOUR_RIGHT;
    if (e && e->line != NONE && leads_out(m, &m->lines.items[e->line])) return SL_NEIGHBOUR_PORTAL;
    return sli_half_is_outside(&m->t, half ^ 1) ? SL_NEIGHBOUR_BORDER : SL_NEIGHBOUR_PORTAL;
}

/// Adds a corner and the neighbour across its side. Returns whether that is a portal.
static bool add_corner(maker *m, sl_point corner, uint32_t neighbour) {
    sl_space *s = &m->out->space;
    s->vertices[s->vertex_count] = corner;
    s->neighbour[s->vertex_count++] = neighbour;
    s->directed_count += neighbour == SL_NEIGHBOUR_PORTAL;
    return neighbour == SL_NEIGHBOUR_PORTAL;
}

static void copy_cell(maker *m, uint32_t number, uint32_t was) {
    const sl_space *f = m->from;
    const sl_cell *cell = &f->cells[was];
    uint32_t next = cell->first_directed;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const uint32_t at = cell->first_vertex + i, directed = m->out->space.directed_count;
        if (!add_corner(m, f->vertices[at], f->neighbour[at])) continue;
        const uint32_t portal = f->directed[next++].portal;
        m->ends[2 * portal + (f->portals[portal].cell[0] == was ? 0 : 1)] =
            (portal_end){number, directed};
    }
}

static void cut_cell(maker *m, uint32_t number, uint32_t first) {
    uint32_t half = first;
    do {
        const sl_point corner = m->t.points.items[m->t.halves.items[half].from];
        const uint32_t directed = m->out->space.directed_count;
        if (!add_corner(m, corner, neighbour_of(m, half))) continue;
        m->directed[half] = directed;
        if (m->cell[half ^ 1] != NONE) continue;
        bool along;
        const graph_edge *e = edge_of(m, half, &along);
        m->ends[2 * m->lines.items[e->line].portal + (along == e->along ? 0 : 1)] =
            (portal_end){number, directed};
    } while ((half = m->t.halves.items[half].next) != first);
}

static sl_status write_cells(maker *m) {
    const sl_space *f = m->from;
    sl_space *s = &m->out->space;
    const size_t corners = f->vertex_count + m->t.halves.count;
    s->cell_count = (uint32_t)m->cells.count;
    s->cells = sl_alloc_array(m->context, s->cell_count, sizeof *s->cells);
    s->vertices = sl_alloc_array(m->context, corners, sizeof *s->vertices);
    s->neighbour = sl_alloc_array(m->context, corners, sizeof *s->neighbour);
    m->out->parents = sl_alloc_array(m->context, s->cell_count, sizeof *m->out->parents);
    m->directed = sl_alloc_array(m->context, m->t.halves.count, sizeof *m->directed);
    m->ends = sl_alloc_array(m->context, 2 * (size_t)f->portal_count, sizeof *m->ends);
    if (!s->cells || !s->vertices || !s->neighbour || !m->out->parents || !m->directed || !m->ends)
        return SL_NO_MEMORY;
    for (size_t i = 0; i < 2 * (size_t)f->portal_count; i++) m->ends[i].cell = NONE;
    if (corners > UINT32_MAX / 4) return sl_fail_memory(m->context);
    for (uint32_t i = 0; i < s->cell_count; i++) {
        const new_cell made = m->cells.items[i];
        sl_cell cell = {.first_vertex = s->vertex_count, .first_directed = s->directed_count};
        cell.inside = f->cells[made.parent].inside;
        cell.solid = f->cells[made.parent].solid;
        s->inside_count += cell.inside;
        m->out->parents[i] = made.parent;
        if (made.half == NONE)
            copy_cell(m, i, made.parent);
        else
            cut_cell(m, i, made.half);
        cell.vertex_count = s->vertex_count - cell.first_vertex;
        cell.directed_count = s->directed_count - cell.first_directed;
        s->cells[i] = cell;
    }
    return SL_OK;
}

// --- portals and walls

/// Adds a portal; `right` and `left` are its ends as crossed from the first cell to the second, and
/// `of` is turned as they are.
static sl_status add_joint(maker *m, portal_end from, portal_end to, sl_point right, sl_point left,
                           origin of) {
    const bool up = from.cell < to.cell;
    const uint32_t number = (uint32_t)m->joints.count;
    sli_mesh_joint joint = {
        {{from.cell, to.cell}, left, right}, {from.directed, to.directed}, number};
    if (!up)
        joint = (sli_mesh_joint){
            {{to.cell, from.cell}, right, left}, {to.directed, from.directed}, number};
    of.turned = of.turned == up;
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->joints, 1));
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->origins, 1));
    m->joints.items[m->joints.count++] = joint;
    m->origins.items[m->origins.count++] = of;
    return SL_OK;
}

static sl_status add_joints(maker *m) {
    for (uint32_t i = 0; i < m->from->portal_count; i++) {
        const sl_portal *p = &m->from->portals[i];
        const portal_end *ends = &m->ends[2 * (size_t)i];
        if (ends[0].cell != NONE && ends[1].cell != NONE)
            SL_TRY(add_joint(m, ends[0], ends[1], p->right, p->left, (origin){i, false}));
    }
    for (uint32_t half = 0; half < m->t.halves.count; half += 2) {
        const uint32_t twin = half + 1, a = m->cell[half], b = m->cell[twin];
        if (a == NONE || b == NONE || neighbour_of(m, half) != SL_NEIGHBOUR_PORTAL) continue;
        bool along = false;
        const graph_edge *e = edge_of(m, half, &along);
        const origin of = {e ? e->of : NONE, e && along != e->of_along};
        SL_TRY(add_joint(m, (portal_end){a, m->directed[half]}, (portal_end){b, m->directed[twin]},
                         m->t.points.items[m->t.halves.items[half].from],
                         m->t.points.items[m->t.halves.items[twin].from], of));
    }
    return SL_OK;
}

/// Gives portals the seams of the portals that they are parts of. The joints are sorted by now.
static sl_status write_seams(maker *m) {
    const sl_space *f = m->from;
    sl_space *s = &m->out->space;
    size_t tags = 0, count;
    if (!f->seam_count) return SL_OK;
    if (m->crowded)
        return sl_fail(m->context, SL_UNSUPPORTED,
                       "a box stands where glass, doors or seams lie within a step of doubles");
    for (size_t i = 0; i < m->origins.count; i++)
        if (m->origins.items[i].portal != NONE) {
            sl_space_seams_of(f, m->origins.items[i].portal, &count);
            tags += count;
        }
    if (tags > UINT32_MAX) return sl_fail_memory(m->context);
    s->seams = sl_alloc_array(m->context, f->seam_count, sizeof *s->seams);
    s->seam_portals = sl_alloc_array(m->context, tags, sizeof *s->seam_portals);
    if (!s->seams || !s->seam_portals) return SL_NO_MEMORY;
    memcpy(s->seams, f->seams, f->seam_count * sizeof *s->seams);
    s->seam_count = f->seam_count;
    for (uint32_t i = 0; i < m->joints.count; i++) {
        const origin of = m->origins.items[m->joints.items[i].half];
        if (of.portal == NONE) continue;
        const sl_seam_portal *on = sl_space_seams_of(f, of.portal, &count);
        for (size_t k = 0; k < count; k++)
            s->seam_portals[s->seam_portal_count++] =
                (sl_seam_portal){i, on[k].seam, on[k].forward != of.turned};
    }
    return SL_OK;
}

static sl_status write_portals(maker *m) {
    SL_TRY(add_joints(m));
    SL_TRY(sli_mesh_join(m->context, m->joints.items, m->joints.count, &m->out->space));
    return write_seams(m);
}

static sl_status write_walls(maker *m) {
    const sl_space *f = m->from;
    sl_space *s = &m->out->space;
    const size_t count = f->wall_count + m->blocking.count;
    if (count > INT32_MAX) return sl_fail_memory(m->context);
    s->walls = sl_alloc_array(m->context, count, sizeof *s->walls);
    if (!s->walls) return SL_NO_MEMORY;
    if (f->wall_count) memcpy(s->walls, f->walls, f->wall_count * sizeof *s->walls);
    for (size_t i = 0; i < m->blocking.count; i++)
        s->walls[f->wall_count + i] = sli_piece_wall(&m->blocking.items[i]);
    s->wall_count = (uint32_t)count;
    return SL_OK;
}

// --- parts of other cells that bent lines leave

static sl_status find_shares(maker *m, uint32_t number) {
    const polygon p = polygon_of(&m->out->space, number);
    const uint32_t parent = m->out->parents[number];
    const polygon whole = polygon_of(m->from, parent);
    if (is_within(&p, &whole)) return SL_OK;
    const size_t before = m->shares.count;
    sli_cell_grid_range r = sli_cell_grid_range_of(m->from, box_of(&p));
    for (uint32_t at; sli_cell_grid_next(&m->from->grid, &r, &at);) {
        const polygon cell = polygon_of(m->from, at);
        bool known = at == parent || !overlap(&p, &cell);
        for (size_t i = before; i < m->shares.count && !known; i++)
            known = m->shares.items[i] == at;
        if (known) continue;
        SL_TRY(SL_ARRAY_ROOM(m->context, &m->shares, 1));
        m->shares.items[m->shares.count++] = at;
    }
    return SL_OK;
}

static sl_status write_shares(maker *m) {
    const uint32_t cells = m->out->space.cell_count;
    uint32_t *first = sl_alloc_array(m->context, (size_t)cells + 1, sizeof *first);
    m->out->first_share = first;
    if (!first) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < cells; i++) {
        if (m->cells.items[i].half != NONE) SL_TRY(find_shares(m, i));
        if (m->shares.count > UINT32_MAX) return sl_fail_memory(m->context);
        first[i + 1] = (uint32_t)m->shares.count;
    }
    m->out->shares = m->shares.items;
    m->shares.items = NULL;
    return SL_OK;
}

// --- the grid

/// An eye on a wall is in the cell that comes first there. So that boxes do not bring it to the
/// other side, the parts of a cell come where the cell came.
static sl_status write_grid(maker *m) {
    SL_TRY(sli_cell_grid_make(m->context, &m->out->space));
    const sl_cell_grid *g = &m->out->space.grid;
    const uint32_t *parents = m->out->parents;
    for (size_t bucket = 0; bucket < (size_t)g->columns * g->rows; bucket++) {
        uint32_t *cells = g->cells + g->first[bucket];
        for (uint32_t i = 1; i < g->first[bucket + 1] - g->first[bucket]; i++) {
            const uint32_t cell = cells[i];
            uint32_t k = i;
            for (; k && parents[cells[k - 1]] > parents[cell]; k--) cells[k] = cells[k - 1];
            cells[k] = cell;
        }
    }
    return SL_OK;
}

// --- all of it

static sl_status make(maker *m, const sl_moving_box *boxes, size_t count) {
    m->out->space = (sl_space){.bounds = m->from->bounds, .root = m->from->root, .cut_walls = 1};
    SL_TRY(sli_box_sides_put(m->context, m->ground, boxes, count, true, &m->blocking));
    SL_TRY(sli_box_sides_put(m->context, m->ground, boxes, count, false, &m->open));
    m->touched = sl_alloc_array(m->context, m->from->cell_count, sizeof *m->touched);
    if (!m->touched) return SL_NO_MEMORY;
    touch_along(m, &m->blocking);
    touch_along(m, &m->open);
    SL_TRY(find_wall_cells(m));
    SL_TRY(make_triangles(m));
    SL_TRY(make_cells(m));
    SL_TRY(write_cells(m));
    SL_TRY(write_portals(m));
    SL_TRY(write_walls(m));
    SL_TRY(write_shares(m));
    return write_grid(m);
}

sl_status sli_boxes_put_mesh(sl_context *context, const sli_box_ground *ground,
                             const sl_moving_box *boxes, size_t count, sli_boxed_space *out) {
    maker m = {.context = context, .ground = ground, .from = ground->space, .out = out};
    const sl_status status = make(&m, boxes, count);
    void *const scratch[] = {m.touched,      m.wall_cells,  m.blocking.items, m.open.items,
                             m.lines.items,  m.edges,       m.segments.items, m.in,
                             m.cell,         m.stack.items, m.cells.items,    m.corners.items,
                             m.directed,     m.ends,        m.joints.items,   m.shares.items,
                             m.origins.items};
    for (size_t i = 0; i < sizeof scratch / sizeof *scratch; i++) sl_free(context, scratch[i]);
    sli_planar_destroy(context, &m.graph);
    sli_triangulation_destroy(context, &m.t);
    return status;
}

/// Cells of a mesh: triangles, merged where the result is convex.
///
/// Each side between two triangles that is no edge of the graph is tried, the longest first. It is
/// removed if both of its ends stay convex corners (Hertel & Mehlhorn 1983, Fast triangulation of
/// simple polygons):
///
///     +-------+          +-------+             +-------+
///     |     / |          |       |             |     / .
///     |   /   |    ->    |       |      but    |   /  .       stays: without the side
///     | /     |          |       |             | /   .        this corner would turn right
///     +-------+          +-------+             +----+
///                                              |     \.
///                                              +------+
///
/// One round is enough. Removing a side only makes the corners at its ends wider, so a side that
/// has to stay has to stay for good. Longest first gives few cells and few pairs of cells that see
/// each other. Exactly straight corners count as convex. Time O(n log n), for sorting.
///
/// Then cells are numbered in the order of their points, and every side between two cells becomes a
/// portal.
#include "space/mesh.h"

#include "geometry/length.h"
#include "geometry/orient.h"
#include "map/ground.h"
#include "map/source.h"
#include "space/index.h"
#include "space/kd_tree.h"
#include "space/seams.h"
#include "space/subdivide.h"
#include "space/walled.h"

#include <stdlib.h>
#include <string.h>

#define NONE UINT32_MAX

typedef struct candidate {
    double length;
    uint32_t half;
} candidate;

/// The wall and the seams that an edge of the graph is part of.
typedef struct graph_edge {
    uint32_t wall;       ///< 1 + its number, 0 for none
    uint32_t first_seam; ///< 1 + the place of its first seam in seam_links, 0 for none
} graph_edge;

/// A seam that an edge is part of, and the next such link of the edge.
typedef struct seam_link {
    uint32_t seam, next;
    bool reversed; ///< the edge runs against the seam
} seam_link;

typedef struct merger {
    sl_context *context;
    sli_triangulation *t;
    const sli_planar *graph;
    sl_space *space;
    uint32_t *previous;    ///< by half-edge
    uint32_t *cell;        ///< by half-edge; NONE for a removed one or one outside
    uint32_t *directed;    ///< by half-edge of a portal: its place in space.directed
    sli_mesh_watch *watch; ///< NULL for none
    void *user;
    graph_edge *edges;
    SL_ARRAY(seam_link) seam_links;
} merger;

static sl_point start_of(const merger *m, uint32_t half) {
    return m->t->points.items[m->t->halves.items[half].from];
}

static sl_point end_of(const merger *m, uint32_t half) {
    return start_of(m, half ^ 1);
}

static uint32_t next(const merger *m, uint32_t half) {
    return m->t->halves.items[half].next;
}

// --- merging

/// Whether the corner where a half-edge starts is convex without its edge.
static bool leaves_convex(const merger *m, uint32_t half) {
    return sli_goes_on(start_of(m, m->previous[half]), start_of(m, half),
                       end_of(m, next(m, half ^ 1)));
}

static void join(merger *m, uint32_t before, uint32_t after) {
    m->t->halves.items[before].next = after;
    m->previous[after] = before;
}

static int compare_candidates(const void *left, const void *right) {
    const candidate *a = left, *b = right;
    if (a->length != b->length) return a->length > b->length ? -1 : 1;
    return (a->half > b->half) - (a->half < b->half);
}

static sl_status list_candidates(merger *m, candidate **out, size_t *count) {
    const size_t halves = m->t->halves.count;
    candidate *list = sl_alloc_array(m->context, halves / 2, sizeof *list);
    if (!list) return SL_NO_MEMORY;
    *count = 0;
    for (uint32_t half = 0; half < halves; half += 2) {
        if (m->t->labels[half / 2] || sli_half_is_outside(m->t, half) ||
            sli_half_is_outside(m->t, half + 1))
            continue;
        const sl_point a = start_of(m, half), b = end_of(m, half);
        list[(*count)++] = (candidate){sli_length(b.x - a.x, b.y - a.y), half};
    }
    if (*count) qsort(list, *count, sizeof *list, compare_candidates);
    *out = list;
    return SL_OK;
}

/// Removes a side if both of its ends stay convex.
static sl_status try_side(merger *m, uint32_t half) {
    const uint32_t twin = half ^ 1;
    const uint32_t stuck = !leaves_convex(m, half) ? half : leaves_convex(m, twin) ? NONE : twin;
    if (m->watch) SL_TRY(m->watch(m->user, half, stuck));
    if (stuck != NONE) return SL_OK;
    join(m, m->previous[half], next(m, twin));
    join(m, m->previous[twin], next(m, half));
    m->cell[half] = m->cell[twin] = NONE;
    return SL_OK;
}

static sl_status merge(merger *m) {
    const size_t halves = m->t->halves.count;
    candidate *list = NULL;
    size_t count;
    m->previous = sl_alloc_array(m->context, halves, sizeof *m->previous);
    m->cell = sl_alloc_array(m->context, halves, sizeof *m->cell);
    if (!m->previous || !m->cell) return SL_NO_MEMORY;
    for (uint32_t half = 0; half < halves; half++)
        if (!sli_half_is_outside(m->t, half)) m->previous[next(m, half)] = half;
    SL_TRY(list_candidates(m, &list, &count));
    sl_status status = SL_OK;
    for (size_t i = 0; i < count && status == SL_OK; i++) {
        if (i % 4096 == 0) status = sl_check_cancelled(m->context);
        if (status == SL_OK) status = try_side(m, list[i].half);
    }
    sl_free(m->context, list);
    return status;
}

sl_status sli_mesh_merge(sl_context *context, sli_triangulation *triangles, sli_mesh_watch *watch,
                         void *user, uint32_t **cell) {
    merger m = {.context = context, .t = triangles, .watch = watch, .user = user};
    const sl_status status = merge(&m);
    sl_free(context, m.previous);
    if (status == SL_OK && cell)
        *cell = m.cell;
    else
        sl_free(context, m.cell);
    return status;
}

// --- cells

static bool is_gone(const merger *m, uint32_t half) {
    return m->cell[half] == NONE;
}

static bool is_before(sl_point a, sl_point b) {
    return a.x < b.x || (a.x == b.x && a.y < b.y);
}

/// Numbers the cells by their first half-edges, which follow the order of points. The first corner
/// of a cell is the leftmost one, of several the lowest.
static sl_status number_cells(merger *m, uint32_t **firsts) {
    const size_t halves = m->t->halves.count;
    uint32_t cells = 0;
    uint64_t corners = 0;
    *firsts = sl_alloc_array(m->context, halves / 3 + 1, sizeof **firsts);
    if (!*firsts) return SL_NO_MEMORY;
    for (uint32_t half = 0; half < halves; half++) {
        if (sli_half_is_outside(m->t, half)) m->cell[half] = NONE;
        if (m->cell[half]) continue; // removed, or has a number: 1 + its cell
        uint32_t first = half, at = half;
        do {
            m->cell[at] = cells + 1;
            corners++;
            if (is_before(start_of(m, at), start_of(m, first))) first = at;
            at = next(m, at);
        } while (at != half);
        (*firsts)[cells++] = first;
    }
    for (uint32_t half = 0; half < halves; half++)
        if (!is_gone(m, half)) m->cell[half]--;
    if (corners > UINT32_MAX / 4) return sl_fail_memory(m->context);
    m->space->cell_count = cells;
    m->space->vertex_count = (uint32_t)corners;
    return SL_OK;
}

/// The neighbour across a half-edge, as in sl_space.neighbour.
static uint32_t neighbour_of(const merger *m, uint32_t half) {
    const uint32_t label = m->t->labels[half / 2];
    const uint32_t wall = label ? m->edges[label - 1].wall : 0;
    if (wall) {
        const sl_wall *w = &m->space->walls[wall - 1];
        const sl_point a = start_of(m, half);
        return (wall - 1) | (w->a.x == a.x && w->a.y == a.y ? 0 : SL_NEIGHBOUR_RIGHT);
    }
    return sli_half_is_outside(m->t, half ^ 1) ? SL_NEIGHBOUR_BORDER : SL_NEIGHBOUR_PORTAL;
}

static sl_status write_cells(merger *m, const uint32_t *firsts) {
    sl_space *s = m->space;
    s->cells = sl_alloc_array(m->context, s->cell_count, sizeof *s->cells);
    s->vertices = sl_alloc_array(m->context, s->vertex_count, sizeof *s->vertices);
    s->neighbour = sl_alloc_array(m->context, s->vertex_count, sizeof *s->neighbour);
    m->directed = sl_alloc_array(m->context, m->t->halves.count, sizeof *m->directed);
    if (!s->cells || !s->vertices || !s->neighbour || !m->directed) return SL_NO_MEMORY;
    uint32_t vertices = 0, directed = 0;
    for (uint32_t i = 0; i < s->cell_count; i++) {
        s->cells[i] = (sl_cell){.first_vertex = vertices, .first_directed = directed};
        uint32_t half = firsts[i];
        do {
            s->vertices[vertices] = start_of(m, half);
            s->neighbour[vertices] = neighbour_of(m, half);
            if (s->neighbour[vertices++] == SL_NEIGHBOUR_PORTAL) m->directed[half] = directed++;
            half = next(m, half);
        } while (half != firsts[i]);
        s->cells[i].vertex_count = vertices - s->cells[i].first_vertex;
        s->cells[i].directed_count = directed - s->cells[i].first_directed;
    }
    s->directed_count = directed;
    s->portal_count = directed / 2;
    return SL_OK;
}

// --- portals

static int compare_joints(const void *left, const void *right) {
    const int order = sli_compare_portals(left, right);
    if (order) return order;
    const sli_mesh_joint *a = left, *b = right;
    return (a->half > b->half) - (a->half < b->half);
}

sl_status sli_mesh_join(sl_context *context, sli_mesh_joint *joints, size_t count, sl_space *s) {
    s->portal_count = (uint32_t)count;
    s->directed_count = 2 * s->portal_count;
    s->portals = sl_alloc_array(context, count, sizeof *s->portals);
    s->directed = sl_alloc_array(context, 2 * count, sizeof *s->directed);
    if (!s->portals || !s->directed) return SL_NO_MEMORY;
    if (count) qsort(joints, count, sizeof *joints, compare_joints);
    for (uint32_t i = 0; i < count; i++) {
        const sl_portal p = s->portals[i] = joints[i].portal;
        s->directed[joints[i].directed[0]] = (sl_directed_portal){i, p.cell[1], p.left, p.right};
        s->directed[joints[i].directed[1]] = (sl_directed_portal){i, p.cell[0], p.right, p.left};
    }
    return SL_OK;
}

static sl_status add_seams(merger *m, const sli_mesh_joint *at, uint32_t portal, size_t *room) {
    sl_space *s = m->space;
    const uint32_t label = m->t->labels[at->half / 2];
    if (!label) return SL_OK;
    const sli_planar_edge *e = &m->graph->edges[label - 1];
    // The half-edge runs from the portal's right end to its left one.
    const bool along = m->t->halves.items[at->half].from != e->a;
    for (uint32_t i = m->edges[label - 1].first_seam; i; i = m->seam_links.items[i - 1].next) {
        const seam_link *l = &m->seam_links.items[i - 1];
        if (s->seam_portal_count == UINT32_MAX) return sl_fail_memory(m->context);
        SL_TRY(sl_reserve(m->context, &s->seam_portals, room, (size_t)s->seam_portal_count + 1,
                          sizeof *s->seam_portals));
        s->seam_portals[s->seam_portal_count++] =
            (sl_seam_portal){portal, l->seam, along != l->reversed};
    }
    return SL_OK;
}

static sl_status write_portals(merger *m) {
    sl_space *s = m->space;
    sli_mesh_joint *joints = sl_alloc_array(m->context, s->portal_count, sizeof *joints);
    size_t count = 0, room = 0;
    for (uint32_t half = 0; joints && half < m->t->halves.count; half++) {
        const uint32_t twin = half ^ 1;
        if (is_gone(m, half) || is_gone(m, twin) || m->cell[half] > m->cell[twin] ||
            neighbour_of(m, half) != SL_NEIGHBOUR_PORTAL)
            continue;
        joints[count++] = (sli_mesh_joint){{.cell = {m->cell[half], m->cell[twin]},
                                            .left = end_of(m, half),
                                            .right = start_of(m, half)},
                                           {m->directed[half], m->directed[twin]},
                                           half};
    }
    sl_status status = joints ? sli_mesh_join(m->context, joints, count, s) : SL_NO_MEMORY;
    for (uint32_t i = 0; i < count && status == SL_OK; i++)
        status = add_seams(m, &joints[i], i, &room);
    sl_free(m->context, joints);
    return status;
}

// --- the graph's edges

/// Walls are numbered in the order of segments, so that a clean map keeps its numbers.
static sl_status take_walls(merger *m, const sl_map *map, const sli_mesh_lines *lines) {
    sl_space *s = m->space;
    const sli_planar *g = m->graph;
    m->edges = sl_alloc_array(m->context, g->edge_count, sizeof *m->edges);
    s->walls = sl_alloc_array(m->context, g->edge_count, sizeof *s->walls);
    if (!m->edges || !s->walls) return SL_NO_MEMORY;
    for (size_t i = 0; i < lines->wall_count; i++)
        for (size_t k = g->first[i]; k < g->first[i + 1]; k++) {
            graph_edge *e = &m->edges[g->links[k] / 2];
            const sl_segment at = sli_planar_at(g, g->links[k]);
            const sl_wall *wall = &map->walls[i];
            if (!e->wall) {
                s->walls[s->wall_count++] = (sl_wall){at.a, at.b, wall->line, wall->ground};
                e->wall = s->wall_count;
                continue;
            }
            sl_wall *first = &s->walls[e->wall - 1];
            const bool same = sli_same_point(first->a, at.a);
            first->ground = sli_ground_joined(first->ground,
                                              same ? wall->ground : sl_ground_turned(wall->ground));
        }
    return SL_OK;
}

/// Replaces the seams by their parts, one for each edge, in order.
static sl_status take_seams(merger *m, const sli_mesh_lines *lines) {
    const sli_planar *g = m->graph;
    const size_t *first = g->first + lines->wall_count;
    const size_t count = first[lines->seam_count] - first[0];
    if (!lines->seam_count) return SL_OK;
    if (count > INT32_MAX) return sl_fail_memory(m->context);
    sl_seam *parts = sl_alloc_array(m->context, count, sizeof *parts);
    if (!parts) return SL_NO_MEMORY;
    uint32_t next_part = 0;
    for (size_t i = 0; i < lines->seam_count; i++)
        for (size_t k = first[i]; k < first[i + 1]; k++) {
            parts[next_part] = m->space->seams[i];
            parts[next_part++].at = sli_planar_at(g, g->links[k]);
        }
    sl_free(m->context, m->space->seams);
    m->space->seams = parts;
    m->space->seam_count = next_part;
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->seam_links, count));
    // Backwards, so that the links of each edge are in the order of seams.
    for (size_t k = first[lines->seam_count]; k-- > first[0];) {
        graph_edge *e = &m->edges[g->links[k] / 2];
        m->seam_links.items[m->seam_links.count++] =
            (seam_link){(uint32_t)(k - first[0]), e->first_seam, g->links[k] % 2};
        e->first_seam = (uint32_t)m->seam_links.count;
    }
    return SL_OK;
}

// --- all of it

static sl_status make(merger *m, const sl_map *map, const sli_mesh_lines *lines) {
    uint32_t *firsts = NULL;
    SL_TRY(take_walls(m, map, lines));
    SL_TRY(take_seams(m, lines));
    SL_TRY(merge(m));
    sl_status status = number_cells(m, &firsts);
    if (status == SL_OK) status = sl_check_cancelled(m->context);
    if (status == SL_OK) status = write_cells(m, firsts);
    sl_free(m->context, firsts);
    SL_TRY(status);
    SL_TRY(sl_check_cancelled(m->context));
    SL_TRY(write_portals(m));
    SL_TRY(sl_check_cancelled(m->context));
    SL_TRY(sli_cell_grid_make(m->context, m->space));
    SL_TRY(sl_check_cancelled(m->context));
    SL_TRY(sli_mark_inside(m->context, map, NULL, m->space));
    return sli_walled_by_channel(m->context, map, m->space);
}

sl_status sli_mesh_make(sl_context *context, const sl_map *map, const sli_mesh_lines *lines,
                        const sli_planar *graph, sli_triangulation *triangles, sl_space *space) {
    merger m = {.context = context, .t = triangles, .graph = graph, .space = space};
    const sl_status status = make(&m, map, lines);
    sl_free(context, m.previous);
    sl_free(context, m.cell);
    sl_free(context, m.directed);
    sl_free(context, m.edges);
    sl_free(context, m.seam_links.items);
    return status;
}

sl_status sli_mesh_add_line(sl_context *context, sli_mesh_lines *lines, sl_segment at) {
    SL_TRY(SL_ARRAY_ROOM(context, &lines->items, 1));
    lines->items.items[lines->items.count++] = at;
    return SL_OK;
}

sl_status sli_mesh_lines_of_map(sl_context *context, const sl_map *map, sli_mesh_lines *lines,
                                sl_space *space) {
    SL_TRY(sli_check_has_walls(context, map));
    if (map->wall_count > INT32_MAX / 2) return sl_fail_memory(context);
    space->bounds = sli_space_bounds(map);
    SL_TRY(sli_seams_of_map(context, map, false, space));
    for (size_t i = 0; i < map->wall_count; i++)
        SL_TRY(sli_mesh_add_line(context, lines, (sl_segment){map->walls[i].a, map->walls[i].b}));
    for (uint32_t i = 0; i < space->seam_count; i++)
        SL_TRY(sli_mesh_add_line(context, lines, space->seams[i].at));
    lines->wall_count = map->wall_count;
    lines->seam_count = space->seam_count;
    return SL_OK;
}

sl_status sli_subdivide_mesh(sl_context *context, const sl_map *map, sl_space *out) {
    sl_space space = {0};
    sli_mesh_lines lines = {0};
    sli_planar graph = {0};
    sli_triangulation triangles = {0};
    sl_status status = sli_mesh_lines_of_map(context, map, &lines, &space);
    if (status == SL_OK)
        status = sli_planar_make(context, sli_map_name(map), lines.items.items, lines.items.count,
                                 0, &graph);
    if (status == SL_OK) status = sli_triangulate(context, &graph, &space.bounds, &triangles);
    if (status == SL_OK) status = sli_mesh_make(context, map, &lines, &graph, &triangles, &space);
    sli_triangulation_destroy(context, &triangles);
    sli_planar_destroy(context, &graph);
    sl_free(context, lines.items.items);
    if (status != SL_OK) {
        sl_space_destroy(context, &space);
        return status;
    }
    sl_report(context, "subdivide", "cells", space.cell_count, space.cell_count);
    *out = space;
    return SL_OK;
}

// --- the steps of the mesh, for lessons

void sli_mesh_steps_destroy(sl_context *context, sli_mesh_steps *steps) {
    sli_triangulation_destroy(context, &steps->delaunay);
    sli_triangulation_destroy(context, &steps->triangles);
    sl_free(context, steps->fresh);
    sl_free(context, steps->sides.items);
    sl_free(context, steps->taken);
    *steps = (sli_mesh_steps){0};
}

typedef struct recorder {
    sl_context *context;
    sli_mesh_steps *steps;
} recorder;

static sl_status note_side(void *user, uint32_t half, uint32_t stuck) {
    const recorder *r = user;
    sli_mesh_steps *s = r->steps;
    SL_TRY(SL_ARRAY_ROOM(r->context, &s->sides, 1));
    if (stuck == SLI_OUTSIDE) s->taken[half / 2] = (uint32_t)s->sides.count;
    s->sides.items[s->sides.count++] = (sli_mesh_side){half, stuck};
    return SL_OK;
}

static int compare_keys(const void *left, const void *right) {
    const uint64_t a = *(const uint64_t *)left, b = *(const uint64_t *)right;
    return (a > b) - (a < b);
}

/// An edge as its two points, whichever way it runs.
static uint64_t key_of(const sli_triangulation *t, size_t edge) {
    const uint64_t a = t->halves.items[2 * edge].from, b = t->halves.items[2 * edge + 1].from;
    return a < b ? a << 32 | b : b << 32 | a;
}

static sl_status find_fresh(sl_context *context, sli_mesh_steps *s) {
    const size_t count = s->delaunay.halves.count / 2, edges = s->triangles.halves.count / 2;
    uint64_t *keys = sl_alloc_array(context, count, sizeof *keys);
    s->fresh = sl_alloc_array(context, edges, sizeof *s->fresh);
    for (size_t i = 0; keys && i < count; i++) keys[i] = key_of(&s->delaunay, i);
    if (keys) qsort(keys, count, sizeof *keys, compare_keys);
    for (size_t i = 0; keys && s->fresh && i < edges; i++) {
        const uint64_t key = key_of(&s->triangles, i);
        s->fresh[i] = !bsearch(&key, keys, count, sizeof *keys, compare_keys);
    }
    const bool done = keys && s->fresh;
    sl_free(context, keys);
    return done ? SL_OK : SL_NO_MEMORY;
}

/// Records the merging of a second triangulation.
static sl_status record_sides(sl_context *context, const sli_planar *graph, const sl_box *box,
                              sli_mesh_steps *s) {
    const size_t edges = s->triangles.halves.count / 2;
    s->taken = sl_alloc_array(context, edges, sizeof *s->taken);
    if (!s->taken) return SL_NO_MEMORY;
    memset(s->taken, 0xff, edges * sizeof *s->taken);
    sli_triangulation merged = {0};
    recorder r = {context, s};
    SL_TRY(sli_triangulate(context, graph, box, &merged));
    const sl_status status = sli_mesh_merge(context, &merged, note_side, &r, NULL);
    sli_triangulation_destroy(context, &merged);
    return status;
}

static sl_status record(sl_context *context, const sli_planar *graph, const sl_box *box,
                        sli_mesh_steps *s) {
    sli_planar points = *graph;
    points.edge_count = 0;
    SL_TRY(sli_triangulate(context, &points, box, &s->delaunay));
    SL_TRY(sli_triangulate(context, graph, box, &s->triangles));
    SL_TRY(find_fresh(context, s));
    return record_sides(context, graph, box, s);
}

sl_status sli_mesh_steps_record(sl_context *context, const sl_space *space, sli_mesh_steps *out) {
    const size_t count = (size_t)space->wall_count + space->seam_count;
    sl_segment *lines = sl_alloc_array(context, count, sizeof *lines);
    sli_planar graph = {0};
    sli_mesh_steps steps = {0};
    if (!lines) return SL_NO_MEMORY;
    for (size_t i = 0; i < space->wall_count; i++)
        lines[i] = (sl_segment){space->walls[i].a, space->walls[i].b};
    for (size_t i = 0; i < space->seam_count; i++)
        lines[space->wall_count + i] = space->seams[i].at;
    sl_status status = sli_planar_make(context, "the space", lines, count, 0, &graph);
    if (status == SL_OK) status = record(context, &graph, &space->bounds, &steps);
    sl_free(context, lines);
    sli_planar_destroy(context, &graph);
    if (status == SL_OK)
        *out = steps;
    else
        sli_mesh_steps_destroy(context, &steps);
    return status;
}

uint32_t sli_mesh_steps_next(const sli_mesh_steps *steps, size_t place, uint32_t half) {
    const sli_half_edge *halves = steps->triangles.halves.items;
    uint32_t next = halves[half].next;
    // Around the point, past the removed sides.
    while (steps->taken[next / 2] < place) next = halves[next ^ 1].next;
    return next;
}

void sli_mesh_steps_corner(const sli_mesh_steps *steps, size_t place, sl_point corner[3]) {
    const sli_triangulation *t = &steps->triangles;
    const uint32_t stuck = steps->sides.items[place].stuck;
    uint32_t before = stuck;
    for (uint32_t half; (half = sli_mesh_steps_next(steps, place, before)) != stuck;) before = half;
    const uint32_t after = sli_mesh_steps_next(steps, place, stuck ^ 1);
    corner[0] = t->points.items[t->halves.items[before].from];
    corner[1] = t->points.items[t->halves.items[stuck].from];
    corner[2] = t->points.items[sli_half_end(t, after)];
}

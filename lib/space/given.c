/// Cells that a map brings along (a node builder's, or anyone's).
///
/// Such cells have been rounded: corners that should lie on a straight side bend it, cells meet in
/// T-junctions, corners stand off their walls. So their sides are taken for lines that end cells,
/// welded together with the walls by the map's own tolerance, and a mesh is made over all of them.
/// Cells that are still bent come out in several convex parts.
///
/// Which of the map's cells a triangle is in is counted from outside: the way into a triangle
/// crosses a side of each cell that it enters or leaves.
#include "space/mesh.h"

#include <math.h>

#define NONE UINT32_MAX

/// A side of a cell of the map, by its line behind walls and seams.
typedef struct cell_side {
    uint32_t cell;
    bool clockwise; ///< the cell is at the right of the line
} cell_side;

/// How many of the map's cells cover a triangle, and the sum of their numbers, each plus one.
typedef struct cover {
    int64_t count, sum;
} cover;

typedef struct given {
    sl_context *context;
    const sl_map *map;
    const char *source; ///< for messages
    sl_mesh_lines lines;
    SL_ARRAY(cell_side) sides;
    sl_planar graph;
    sl_triangulation triangles;
    cover *steps;  ///< by edge of the graph: what is at the left of it, a to b, less what is not
    cover *covers; ///< by half-edge
    bool *known;   ///< by half-edge
    SL_ARRAY(uint32_t) waiting;
    size_t without_area;
} given;

static sl_status fail(const given *g, uint32_t cell, const char *what) {
    return sl_fail_at(g->context, g->source, g->map->cells[cell].line, "cell %lu %s",
                      (unsigned long)cell, what);
}

static double twice_area(const sl_point *corners, size_t count) {
    double sum = 0;
    for (size_t i = 2; i < count; i++)
        sum += (corners[i - 1].x - corners[0].x) * (corners[i].y - corners[0].y) -
               (corners[i].x - corners[0].x) * (corners[i - 1].y - corners[0].y);
    return sum;
}

static sl_status add_cell(given *g, uint32_t number) {
    const sl_map_cell *cell = &g->map->cells[number];
    const sl_point *corners = g->map->corners + cell->first;
    const double area = twice_area(corners, cell->count);
    if (!(area > 0) && !(area < 0)) {
        g->without_area++;
        return SL_OK;
    }
    for (size_t i = 0; i < cell->count; i++) {
        const sl_segment at = {corners[i], corners[i + 1 < cell->count ? i + 1 : 0]};
        SL_TRY(sl_mesh_add_line(g->context, &g->lines, at));
        SL_TRY(SL_ARRAY_ROOM(g->context, &g->sides, 1));
        g->sides.items[g->sides.count++] = (cell_side){number, area < 0};
    }
    return SL_OK;
}

static sl_status make_graph(given *g, sl_space *space) {
    SL_TRY(sl_mesh_lines_of_map(g->context, g->map, &g->lines, space));
    for (size_t i = 0; i < g->map->cell_count; i++) {
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(g->context));
        SL_TRY(add_cell(g, (uint32_t)i));
    }
    if (!g->sides.count)
        return sl_fail_at(g->context, g->source, 0, "the map's cells enclose no area");
    const double weld = fmax(g->map->snap, sl_planar_tolerance(&space->bounds));
    SL_TRY(sl_planar_make(g->context, g->source, g->lines.items.items, g->lines.items.count, weld,
                          &g->graph));
    return sl_triangulate(g->context, &g->graph, &space->bounds, &g->triangles);
}

// --- which cell a triangle is in

/// What crossing each edge of the graph, from its right to its left, adds to the cover.
static void count_steps(given *g) {
    const size_t first = g->lines.wall_count + g->lines.seam_count;
    for (size_t i = 0; i < g->sides.count; i++) {
        const cell_side *side = &g->sides.items[i];
        for (size_t k = g->graph.first[first + i]; k < g->graph.first[first + i + 1]; k++) {
            const sl_planar_link link = g->graph.links[k];
            const int sign = (link % 2 == 1) == side->clockwise ? 1 : -1;
            g->steps[link / 2].count += sign;
            g->steps[link / 2].sum += sign * ((int64_t)side->cell + 1);
        }
    }
}

/// What crossing a half-edge, from its right to its left, adds to the cover.
static cover step_into(const given *g, uint32_t half) {
    const uint32_t label = g->triangles.labels[half / 2];
    if (!label) return (cover){0, 0};
    const cover step = g->steps[label - 1];
    return g->triangles.halves.items[half].from == g->graph.edges[label - 1].a
               ? step
               : (cover){-step.count, -step.sum};
}

/// Gives the triangle of a half-edge its cover.
static sl_status cover_triangle(given *g, uint32_t half, cover c) {
    SL_TRY(SL_ARRAY_ROOM(g->context, &g->waiting, 3));
    for (int i = 0; i < 3; i++) {
        g->known[half] = true;
        g->covers[half] = c;
        g->waiting.items[g->waiting.count++] = half;
        half = g->triangles.halves.items[half].next;
    }
    return SL_OK;
}

static sl_status cover_all(given *g) {
    const sl_triangulation *t = &g->triangles;
    uint32_t outside = 0;
    while (!sl_half_is_outside(t, outside)) outside++;
    SL_TRY(cover_triangle(g, outside ^ 1, step_into(g, outside ^ 1)));
    while (g->waiting.count) {
        const uint32_t half = g->waiting.items[--g->waiting.count], twin = half ^ 1;
        if (sl_half_is_outside(t, twin) || g->known[twin]) continue;
        const cover step = step_into(g, twin), c = g->covers[half];
        SL_TRY(cover_triangle(g, twin, (cover){c.count + step.count, c.sum + step.sum}));
    }
    return SL_OK;
}

/// A cell that has a side at an edge where others overlap it.
static sl_status fail_overlap(const given *g, uint32_t half) {
    const sl_point at = g->triangles.points.items[g->triangles.halves.items[half].from];
    const size_t first = g->lines.wall_count + g->lines.seam_count;
    const uint32_t label = g->triangles.labels[half / 2];
    for (size_t i = 0; i < g->sides.count; i++)
        for (size_t k = g->graph.first[first + i]; k < g->graph.first[first + i + 1]; k++)
            if (g->graph.links[k] / 2 + 1 == label) {
                char what[128];
                snprintf(what, sizeof what, "overlaps another cell near %.9g %.9g", at.x, at.y);
                return fail(g, g->sides.items[i].cell, what);
            }
    return sl_fail_at(g->context, g->source, 0, "the map's cells overlap near %.9g %.9g", at.x,
                      at.y);
}

/// Cells may not overlap, nor wind around a place more than once.
static sl_status check_cover(given *g) {
    const size_t halves = g->triangles.halves.count;
    g->steps = sl_alloc_array(g->context, g->graph.edge_count, sizeof *g->steps);
    g->covers = sl_alloc_array(g->context, halves, sizeof *g->covers);
    g->known = sl_alloc_array(g->context, halves, sizeof *g->known);
    if (!g->steps || !g->covers || !g->known) return SL_NO_MEMORY;
    count_steps(g);
    SL_TRY(cover_all(g));
    for (uint32_t half = 0; half < halves; half++) {
        const cover c = g->covers[half];
        if (!g->known[half] || !g->triangles.labels[half / 2]) continue;
        if (c.count < 0 || c.count > 1 || (c.count == 0 && c.sum != 0))
            return fail_overlap(g, half);
    }
    return SL_OK;
}

// --- all of it

static void destroy(given *g) {
    sl_free(g->context, g->lines.items.items);
    sl_free(g->context, g->sides.items);
    sl_planar_destroy(g->context, &g->graph);
    sl_triangulation_destroy(g->context, &g->triangles);
    sl_free(g->context, g->steps);
    sl_free(g->context, g->covers);
    sl_free(g->context, g->known);
    sl_free(g->context, g->waiting.items);
}

sl_status sl_subdivide_given(sl_context *context, const sl_map *map, sl_space *out) {
    given g = {.context = context, .map = map, .source = map->source ? map->source : "the map"};
    if (!map->cell_count)
        return sl_fail_at(context, g.source, 0, "the map brings no cells of its own");
    if (map->cell_count > INT32_MAX / 2) return sl_fail_memory(context);
    sl_space space = {0};
    sl_status status = make_graph(&g, &space);
    if (status == SL_OK) status = check_cover(&g);
    if (status == SL_OK)
        status = sl_mesh_make(context, map, &g.lines, &g.graph, &g.triangles, &space);
    destroy(&g);
    if (status != SL_OK) {
        sl_space_destroy(context, &space);
        return status;
    }
    sl_note(context, "the map brings %zu cells; %u were made of them and of what they leave open",
            map->cell_count - g.without_area, space.cell_count);
    sl_report(context, "subdivide", "cells", space.cell_count, space.cell_count);
    *out = space;
    return SL_OK;
}

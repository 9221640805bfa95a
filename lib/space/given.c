/// Cells that a map brings along, from a node builder or elsewhere.
///
/// Such cells are rounded. Corners that should lie on a straight side bend it, cells meet in
/// T-junctions, corners stand beside their walls:
///
///     +-----+-----+            the sides of cells are lines, welded with the walls by the
///     |     .     |            map's own tolerance; a mesh is made over all of them, so a
///     |      .----+            cell that is bent comes out in several convex parts
///     |     .     |
///     +-----+-----+
///
/// Are the cells sound? The cover of a triangle is the number of cells over it. Outside it is 0,
/// and a side changes it by one, so a walk over all triangles counts it. More than one, or less
/// than none, is a cell that overlaps another. Time O(n log n), for the mesh.
#include "map/source.h"
#include "space/mesh.h"
#include "space/subdivide.h"

/// The number of the map's cells that cover a triangle, and the sum of their numbers, each plus
/// one.
typedef struct cover {
    int64_t count, sum;
} cover;

typedef struct given {
    sl_context *context;
    const sl_map *map;
    const char *source; ///< for messages
    sli_mesh_lines lines;
    sli_planar graph; ///< of walls, seams, and sides of cells by corner of the map
    sli_triangulation triangles;
    cover
        *steps; ///< by edge of the graph, from a to b: the cover at its left less that at its right
    cover *covers; ///< by half-edge
    bool *known;   ///< by half-edge
    SL_ARRAY(uint32_t) waiting;
    size_t without_area;
} given;

static sl_status make_graph(given *g, sl_space *space) {
    SL_TRY(sli_mesh_lines_of_map(g->context, g->map, &g->lines, space));
    for (size_t i = 0; i < g->map->cell_count; i++) {
        const sl_map_cell *cell = &g->map->cells[i];
        const sl_point *corners = g->map->corners + cell->first;
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(g->context));
        for (size_t k = 0; k < cell->count; k++)
            SL_TRY(sli_mesh_add_line(g->context, &g->lines,
                                     (sl_segment){corners[k], corners[(k + 1) % cell->count]}));
    }
    SL_TRY(sli_planar_make(g->context, g->source, g->lines.items.items, g->lines.items.count,
                           2 * g->map->snap, &g->graph));
    return sli_triangulate(g->context, &g->graph, &space->bounds, &g->triangles);
}

// --- the cells that cover a triangle

/// The *count edges around a cell.
static const sli_planar_link *links_of(const given *g, uint32_t cell, size_t *count) {
    const sl_map_cell *c = &g->map->cells[cell];
    const size_t *first = g->graph.first + g->lines.wall_count + g->lines.seam_count + c->first;
    *count = first[c->count] - first[0];
    return g->graph.links + first[0];
}

/// Twice the area of a cell as welded; negative where it is clockwise.
static double area_of(const given *g, uint32_t cell) {
    size_t count;
    const sli_planar_link *links = links_of(g, cell, &count);
    double sum = 0;
    for (size_t k = 1; k < count; k++) {
        const sl_point o = sli_planar_at(&g->graph, links[0]).a;
        const sl_segment at = sli_planar_at(&g->graph, links[k]);
        sum += (at.a.x - o.x) * (at.b.y - o.y) - (at.b.x - o.x) * (at.a.y - o.y);
    }
    return sum;
}

/// Counts what crossing each edge of the graph, from its right to its left, adds to the cover.
static void count_steps(given *g) {
    for (uint32_t i = 0; i < g->map->cell_count; i++) {
        const double area = area_of(g, i);
        size_t count;
        const sli_planar_link *links = links_of(g, i, &count);
        g->without_area += area == 0;
        for (size_t k = 0; k < count; k++) {
            const int sign = (links[k] % 2 == 1) == (area < 0) ? 1 : -1;
            g->steps[links[k] / 2].count += sign;
            g->steps[links[k] / 2].sum += sign * ((int64_t)i + 1);
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
    const sli_triangulation *t = &g->triangles;
    uint32_t outside = 0;
    while (!sli_half_is_outside(t, outside)) outside++;
    SL_TRY(cover_triangle(g, outside ^ 1, step_into(g, outside ^ 1)));
    while (g->waiting.count) {
        const uint32_t half = g->waiting.items[--g->waiting.count], twin = half ^ 1;
        if (sli_half_is_outside(t, twin) || g->known[twin]) continue;
        const cover step = step_into(g, twin), c = g->covers[half];
        SL_TRY(cover_triangle(g, twin, (cover){c.count + step.count, c.sum + step.sum}));
    }
    return SL_OK;
}

/// Fails for a triangle that is covered wrongly. Names a cell that has the half-edge as a side, and
/// is entered there, or left where the cover is too low. SL_OK if there is none.
static sl_status fail_at(const given *g, uint32_t half) {
    const uint32_t from = g->triangles.halves.items[half].from;
    const sl_point at = g->triangles.points.items[from];
    for (uint32_t i = 0; i < g->map->cell_count; i++) {
        size_t count;
        const sli_planar_link *links = links_of(g, i, &count);
        for (size_t k = 0; k < count; k++) {
            if (links[k] / 2 + 1 != g->triangles.labels[half / 2]) continue;
            const bool along = (from == g->graph.edges[links[k] / 2].a) == (links[k] % 2 == 0);
            const bool entered = along == (area_of(g, i) >= 0);
            if (entered == (g->covers[half].count > 1))
                return sli_map_fail(g->context, g->map, SL_BAD_INPUT, g->map->cells[i].line,
                                    "cell %lu overlaps another one or itself near %.9g %.9g",
                                    (unsigned long)i, at.x, at.y);
        }
    }
    return SL_OK;
}

/// Cells must not overlap, nor wind around a place more than once.
static sl_status check_cover(given *g) {
    const size_t halves = g->triangles.halves.count;
    g->steps = sl_alloc_array(g->context, g->graph.edge_count, sizeof *g->steps);
    g->covers = sl_alloc_array(g->context, halves, sizeof *g->covers);
    g->known = sl_alloc_array(g->context, halves, sizeof *g->known);
    if (!g->steps || !g->covers || !g->known) return SL_NO_MEMORY;
    count_steps(g);
    if (g->without_area == g->map->cell_count)
        return sl_fail_at(g->context, g->source, 0, "the map's cells enclose no area");
    SL_TRY(cover_all(g));
    for (uint32_t half = 0; half < halves; half++) {
        const cover c = g->covers[half];
        if (c.count > 1 || c.count < 0 || (c.count == 0 && c.sum != 0)) SL_TRY(fail_at(g, half));
    }
    return SL_OK;
}

// --- all of it

static void destroy(given *g) {
    sl_free(g->context, g->lines.items.items);
    sli_planar_destroy(g->context, &g->graph);
    sli_triangulation_destroy(g->context, &g->triangles);
    sl_free(g->context, g->steps);
    sl_free(g->context, g->covers);
    sl_free(g->context, g->known);
    sl_free(g->context, g->waiting.items);
}

sl_status sli_subdivide_given(sl_context *context, const sl_map *map, sl_space *out) {
    given g = {.context = context, .map = map, .source = sli_map_name(map)};
    if (!map->cell_count)
        return sl_fail_at(context, g.source, 0, "the map brings no cells of its own");
    if (map->cell_count > INT32_MAX / 2) return sl_fail_memory(context);
    sl_space space = {0};
    sl_status status = make_graph(&g, &space);
    if (status == SL_OK) status = check_cover(&g);
    if (status == SL_OK)
        status = sli_mesh_make(context, map, &g.lines, &g.graph, &g.triangles, &space);
    destroy(&g);
    if (status != SL_OK) {
        sl_space_destroy(context, &space);
        return status;
    }
    const size_t brought = map->cell_count - g.without_area;
    sl_note(context, "the map brings %zu cell%s; %u %s made of %s and of what %s open", brought,
            brought == 1 ? "" : "s", space.cell_count, space.cell_count == 1 ? "was" : "were",
            brought == 1 ? "it" : "them", brought == 1 ? "it leaves" : "they leave");
    sl_report(context, "subdivide", "cells", space.cell_count, space.cell_count);
    *out = space;
    return SL_OK;
}

/// Visibility graph analysis for JavaScript: graph.js asks, visibility_graph/ answers.
///
/// A graph is a query of a map whose doors stand as they were set (sightline/query.h), a grid of
/// points in it, and which of them see each other (sightline/vga.h). Groups of measures are
/// computed one at a time, because some cost much and few are looked at. Their results stay until
/// the next call about the same graph.
#include "bindings/js/src/bindings.h"
#include "sightline/bake.h"
#include "sightline/effects.h"
#include "sightline/import.h"
#include "sightline/query.h"
#include "sightline/vga.h"

#include <math.h>
#include <string.h>

typedef struct graph {
    sl_baked baked; ///< its space alone, where it comes from a map
    sl_query *query;
    const sl_outline *outline; ///< of the query
    sl_vga_graph sights;
    sl_vga_steps *steps; ///< NULL where steps go as sight does
    sl_vga_grid grid;
    sl_vga_measures *measures; ///< by point, of the last group
    sl_vga_depths *depths;     ///< by point
} graph;

static sl_context *context(void) {
    return sli_module.context;
}

SLI_EXPORT(void, graph_close, graph *g) {
    if (!g) return;
    sl_free(context(), g->measures);
    sl_free(context(), g->depths);
    sl_vga_grid_destroy(context(), &g->grid);
    sl_vga_steps_destroy(context(), g->steps);
    sl_vga_graph_destroy(context(), &g->sights);
    sl_query_destroy(context(), g->query);
    sl_baked_destroy(context(), &g->baked);
    sl_free(context(), g);
}

// --- the map

static sl_status make_space(graph *g, const char *name, const char *text, size_t size,
                            double entrance) {
    const sl_import_options import = {.entrance = entrance};
    sl_map map = {0};
    sl_status status = sl_map_parse(context(), name, text, size, &import, &map);
    if (status == SL_OK) status = sl_bake_cells(context(), &map, NULL, &g->baked);
    sl_map_destroy(context(), &map);
    return status;
}

static sl_status open_map(graph *g, const char *name, const char *bytes, size_t size, int baked,
                          double entrance) {
    SL_TRY(baked ? sl_baked_parse(context(), name, bytes, size, &g->baked)
                 : make_space(g, name, bytes, size, entrance));
    SL_TRY(sl_effects_check(context(), &g->baked.map, "graph", ~(unsigned)SL_EFFECT_MIRROR,
                            "steps and paths lead straight to points, not to mirror images"));
    return sl_query_over(context(), &g->baked.space, &g->baked.map, NULL, &g->query);
}

/// Reads a map, or with `baked` a baked file. `entrance` is the width of entrances; 0: as the map
/// says.
SLI_EXPORT(graph *, graph_open, const char *name, const char *bytes, size_t size, int baked,
           double entrance) {
    graph *g = sl_alloc_array(context(), 1, sizeof *g);
    if (sli_done(g ? open_map(g, name, bytes, size, baked, entrance) : SL_NO_MEMORY)) return g;
    graph_close(g);
    return NULL;
}

/// Before graph_make(): opens or shuts a door.
SLI_EXPORT(int, graph_set_door, graph *g, const char *name, int open) {
    sli_done(sl_query_set_door(context(), g->query, name, open));
    return (int)sli_module.status;
}

// --- the graph

static sl_status refuse_step(double step, double points, double most) {
    return sl_fail(context(), SL_BAD_ARGUMENT,
                   "grid: steps of %.3g give %.0f points, more than %.0f; choose a coarser grid",
                   step, points, most);
}

/// The area is asked first: a grid that is far too large is not filled.
static sl_status fill(graph *g, double step, double most) {
    const sl_space *space = &g->baked.space;
    const sl_outline *outline = sl_vga_steps_outline(g->steps, g->outline);
    double area = 0;
    if (!(step > 0) || isinf(step))
        return sl_fail(context(), SL_BAD_ARGUMENT, "grid: a step over 0 is needed");
    for (uint32_t c = 0; c < space->cell_count; c++)
        if (space->cells[c].inside) area += sl_space_area(space, c);
    if (area / step / step > 2 * most) return refuse_step(step, area / step / step, most);
    SL_TRY(sl_vga_grid_make(context(), outline, step, NULL, 0, &g->grid));
    if (g->grid.count > most) return refuse_step(step, g->grid.count, most);
    if (g->grid.count) return SL_OK;
    return sl_fail(context(), SL_BAD_ARGUMENT,
                   "grid: no point of a grid with steps of %.3g is inside; choose a finer grid",
                   step);
}

static sl_status make(graph *g, double step, double range, double most) {
    SL_TRY(sl_query_outline(context(), g->query, &g->outline));
    SL_TRY(sl_vga_steps_create(context(), &g->baked, g->query, NULL, &g->steps));
    SL_TRY(fill(g, step, most));
    return sl_vga_graph_make(context(), g->outline, &g->grid,
                             range < 0 ? g->baked.map.range : range, 1, &g->sights);
}

/// Makes the graph, of no more than `most` points. A range below 0 is the map's own. integers:
/// points, their place, columns, rows, the place of the points' squares, whether there is one-way
/// glass; numbers: the first column and row.
SLI_EXPORT(int, graph_make, graph *g, double step, double range, double most) {
    if (!sli_done(make(g, step, range, most))) return (int)sli_module.status;
    const sl_vga_grid *grid = &g->grid;
    const uint32_t table[] = {
        grid->count, (uint32_t)(uintptr_t)grid->points,  grid->columns,
        grid->rows,  (uint32_t)(uintptr_t)grid->squares, g->baked.map.oneway_count > 0};
    memcpy(sli_module.integers, table, sizeof table);
    sli_module.numbers[0] = (double)grid->left;
    sli_module.numbers[1] = (double)grid->bottom;
    return SL_OK;
}

/// Whether a point sees another.
SLI_EXPORT(int, graph_sees, const graph *g, uint32_t a, uint32_t b) {
    return sl_vga_sees(&g->sights, a, b);
}

// --- measures

/// What they mean is in measures.d.ts: pages load no more than they need.
#define ROW(name, group, unit, meaning) #name " " #group " " #unit "\n"

/// The measures of points, a line each: name, group, unit.
SLI_EXPORT(const char *, graph_rows, void) {
    return SL_GRAPH_MEASURES(ROW) SL_GRAPH_COUNTS(ROW);
}

/// Depths from a point, likewise.
SLI_EXPORT(const char *, depth_rows, void) {
    return SL_DEPTH_MEASURES(ROW);
}

#define PART(name, group, unit, meaning) SL_VGA_##group,
static const uint8_t graph_parts[] = {SL_GRAPH_MEASURES(PART) SL_GRAPH_COUNTS(PART)};
static const uint8_t depth_parts[] = {SL_DEPTH_MEASURES(PART)};

static sl_status measure(graph *g, unsigned part) {
    sl_vga_options options = sl_vga_options_default();
    options.parts = part;
    options.threads = 1;
    if (!g->measures) g->measures = sl_alloc_array(context(), g->grid.count, sizeof *g->measures);
    if (!g->measures) return SL_NO_MEMORY;
    return sl_vga_measure_walked(context(), g->outline, &g->grid, &g->sights, g->steps, &options,
                                 g->measures);
}

/// Measures the group of a measure, by its row. integers[0]: the place of the sl_vga_measures.
SLI_EXPORT(int, graph_measure, graph *g, size_t row) {
    sli_done(measure(g, graph_parts[row]));
    sli_module.integers[0] = (uint32_t)(uintptr_t)g->measures;
    return (int)sli_module.status;
}

/// The point in whose square a place lies; UINT32_MAX: none.
SLI_EXPORT(uint32_t, graph_find, const graph *g, double x, double y) {
    return sl_vga_grid_find(&g->grid, (sl_point){x, y});
}

static sl_status find_depths(graph *g, unsigned part, uint32_t from) {
    if (!g->depths) g->depths = sl_alloc_array(context(), g->grid.count, sizeof *g->depths);
    if (!g->depths) return SL_NO_MEMORY;
    return sl_vga_depth_walked(context(), g->outline, &g->grid, &g->sights, g->steps, NULL, 0, part,
                               &from, 1, 1, g->depths);
}

/// Depths of all points from one, of the group of a row. integers[0]: the place of the
/// sl_vga_depths.
SLI_EXPORT(int, graph_depth, graph *g, size_t row, uint32_t from) {
    sli_done(find_depths(g, depth_parts[row], from));
    sli_module.integers[0] = (uint32_t)(uintptr_t)g->depths;
    return (int)sli_module.status;
}

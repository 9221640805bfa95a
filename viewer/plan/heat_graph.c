/// The visibility graph of a grid of points, and its measures. A task makes the graph once, and
/// then one group of measures at a time: a group costs much, and few are looked at. Cost: as
/// sightline/vga.h says.
#include "plan/heat_graph.h"

#include "sightline/support.h"

#include <inttypes.h>
#include <math.h>

// --- measures

const sl_measure *heat_measure(size_t number) {
    size_t count;
    const sl_measure *all = sl_measures(SL_VGA, &count);
    const size_t usual = sl_measure_find(SL_VGA, "visual_integration_hh");
    if (number == 0) return &all[usual];
    for (size_t k = 0; k < count; k++)
        if (k != usual && all[k].of == SL_OF_GRAPH && --number == 0) return &all[k];
    return number == 1 ? &all[sl_measure_find(SL_VGA, "visual_step_depth")] : NULL;
}

size_t heat_measure_count(void) {
    size_t count = 0;
    while (heat_measure(count)) count++;
    return count;
}

unsigned heat_measure_part(const sl_measure *measure) {
    return measure->of == SL_OF_GRAPH ? 1u << measure->group : 0;
}

// --- the work

sl_status heat_graph_begin(sl_context *context, const sl_baked *baked, const sl_query *query,
                           double step, double range, heat_graph *graph) {
    graph->step = step;
    graph->range = range;
    SL_TRY(sl_effects_check(context, &baked->map, "the heat map", ~(unsigned)SL_EFFECT_MIRROR,
                            "steps and paths lead straight to points, not to mirror images"));
    SL_TRY(sl_query_copy(context, query, &graph->query));
    return sl_vga_steps_create(context, baked, graph->query, NULL, &graph->steps);
}

static sl_status make_graph(sl_context *context, heat_graph *g) {
    SL_TRY(sl_query_outline(context, g->query, &g->outline));
    SL_TRY(sl_vga_grid_make(context, sl_vga_steps_outline(g->steps, g->outline), g->step, NULL, 0,
                            &g->grid));
    if (g->grid.count == 0)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "no point of a grid with steps of %.3g is inside; choose a finer grid",
                       g->step);
    if (g->grid.count > HEAT_POINTS_MOST)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "a grid with steps of %.3g has %" PRIu32
                       " points, more than %d; choose a coarser grid",
                       g->step, g->grid.count, HEAT_POINTS_MOST);
    const size_t squares = (size_t)g->grid.columns * g->grid.rows;
    g->points = sl_alloc_array(context, squares, sizeof *g->points);
    g->measures = sl_alloc_array(context, g->grid.count, sizeof *g->measures);
    if (!g->points || !g->measures) return SL_NO_MEMORY;
    for (size_t i = 0; i < squares; i++) g->points[i] = UINT32_MAX;
    for (uint32_t p = 0; p < g->grid.count; p++) g->points[g->grid.squares[p]] = p;
    return sl_vga_graph_make(context, g->outline, &g->grid, g->range, 0, &g->graph);
}

/// Drops all that make_graph makes.
static void drop_graph(sl_context *context, heat_graph *g) {
    sl_vga_graph_destroy(context, &g->graph);
    sl_vga_grid_destroy(context, &g->grid);
    sl_free(context, g->measures);
    sl_free(context, g->points);
    g->measures = NULL;
    g->points = NULL;
    g->made = false;
    g->parts = 0;
}

/// Measures one group, beside those that are there.
static sl_status measure_group(sl_context *context, heat_graph *g, unsigned part) {
    sl_vga_measures *made = sl_alloc_array(context, g->grid.count, sizeof *made);
    if (!made) return SL_NO_MEMORY;
    sl_vga_options options = sl_vga_options_default();
    options.parts = part;
    const sl_status status =
        sl_vga_measure_walked(context, g->outline, &g->grid, &g->graph, g->steps, &options, made);
    size_t count;
    const sl_measure *all = sl_measures(SL_VGA, &count);
    for (size_t k = 0; k < count && status == SL_OK; k++)
        for (uint32_t p = 0; p < g->grid.count && heat_measure_part(&all[k]) == part; p++)
            ((double *)&g->measures[p])[all[k].index] = sl_measure_value(&all[k], &made[p]);
    if (status == SL_OK) g->parts |= part;
    sl_free(context, made);
    return status;
}

sl_status heat_graph_work(sl_context *context, void *data) {
    heat_graph *g = data;
    if (!g->made) {
        const sl_status status = make_graph(context, g);
        if (status != SL_OK) drop_graph(context, g);
        SL_TRY(status);
        g->made = true;
    }
    return g->wanted & ~g->parts ? measure_group(context, g, g->wanted) : SL_OK;
}

void heat_graph_destroy(sl_context *context, heat_graph *graph) {
    drop_graph(context, graph);
    sl_query_destroy(context, graph->query);
    sl_vga_steps_destroy(context, graph->steps);
    *graph = (heat_graph){0};
}

// --- points

/// The point of the square so many columns and rows from that of a place.
static uint32_t point_beside(const heat_graph *g, sl_point at, int columns, int rows) {
    const double column = round(at.x / g->step) - (double)g->grid.left + columns;
    const double row = round(at.y / g->step) - (double)g->grid.bottom + rows;
    const bool inside = column >= 0 && column < g->grid.columns && row >= 0 && row < g->grid.rows;
    return inside ? g->points[(size_t)column * g->grid.rows + (size_t)row] : UINT32_MAX;
}

uint32_t heat_graph_square(const heat_graph *graph, sl_point at) {
    return graph->made ? point_beside(graph, at, 0, 0) : UINT32_MAX;
}

uint32_t heat_graph_nearest(sl_context *context, const heat_graph *graph, sl_point at) {
    uint32_t nearest = UINT32_MAX;
    double least = INFINITY;
    for (int i = 0; i < 9 && graph->made; i++) {
        const uint32_t p = point_beside(graph, at, i / 3 - 1, i % 3 - 1);
        bool seen = false;
        if (p == UINT32_MAX) continue;
        const sl_point to = graph->grid.points[p];
        const double away = hypot(to.x - at.x, to.y - at.y);
        if (away < least && sl_query_sees(context, graph->query, at, to, &seen) == SL_OK && seen) {
            least = away;
            nearest = p;
        }
    }
    return nearest;
}

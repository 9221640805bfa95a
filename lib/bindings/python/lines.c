/// Axial lines and segments for Python. Results are kept in the handle, as rows of doubles.
#include "facade.h"

#include "sightline/axial.h"

#include <string.h>

enum { AXIAL_COLUMNS = sizeof(sl_axial_measures) / sizeof(double) };
enum { SEGMENT_COLUMNS = sizeof(sl_segment_measures) / sizeof(double) };

void slp_lines_forget(slp_base *base) {
    sl_free(base->context, base->lines.lines);
    sl_free(base->context, base->lines.values);
    base->lines = (slp_lines){0};
}

/// Room for `count` lines, which the lines kept have.
static sl_status begin(slp_base *base, size_t count, size_t columns) {
    base->lines.count = count;
    base->lines.columns = columns;
    base->lines.values = sl_alloc_array(base->context, count * columns, sizeof(double));
    return base->lines.values ? SL_OK : SL_NO_MEMORY;
}

static sl_status measure_axial(slp_base *base, const sl_axial_lines *found,
                               const sl_axial_options *options) {
    sl_line_graph graph = {0};
    base->lines.lines = sl_alloc_array(base->context, found->count, sizeof *base->lines.lines);
    if (!base->lines.lines) return SL_NO_MEMORY;
    memcpy(base->lines.lines, found->lines, found->count * sizeof *found->lines);
    SL_TRY(begin(base, found->count, AXIAL_COLUMNS));
    sl_status status = sl_line_graph_make(base->context, found->lines, found->count, &graph);
    if (status == SL_OK)
        status = sl_axial_measure(base->context, found->lines, &graph, options,
                                  (sl_axial_measures *)base->lines.values);
    sl_line_graph_destroy(base->context, &graph);
    return status;
}

int slp_level_axial(slp_level *level, int kept, uint32_t radius, unsigned threads) {
    sl_context *context = level->base.context;
    const sl_axial_options options = {.radius = radius, .threads = threads};
    const sl_outline *outline;
    sl_axial_lines found = {0};
    slp_lines_forget(&level->base);
    SL_TRY(sl_effects_check(context, &level->baked.map, "axial", SL_EFFECT_DOOR,
                            "axial lines end at walls alone"));
    SL_TRY(slp_level_queries(level, 1));
    SL_TRY(sl_query_outline(context, level->queries.items[0], &outline));
    sl_status status = sl_axial_all_lines(context, outline, threads, &found);
    if (status == SL_OK && !found.count)
        status = sl_fail(context, SL_BAD_ARGUMENT,
                         "the map has no axial line: none of its corners is inside");
    if (status == SL_OK && kept != SLP_LINES_ALL)
        status = sl_axial_fewest(context, &found, kept == SLP_LINES_FEWEST);
    if (status == SL_OK) status = measure_axial(&level->base, &found, &options);
    sl_axial_lines_destroy(context, &found);
    if (status != SL_OK) slp_lines_forget(&level->base);
    return status;
}

/// The walls of a clean copy: cleaning cuts the lines where they cross and joins their ends.
static sl_status take_walls(slp_plan *plan) {
    sl_context *context = plan->base.context;
    sl_map map = {0};
    SL_TRY(sl_map_copy(context, &plan->map, &map));
    for (size_t i = 0; i < map.wall_count; i++) map.walls[i].ground = 0;
    sl_status status = sl_map_clean(context, &map, NULL, NULL);
    if (status == SL_OK && map.wall_count > INT32_MAX / 4)
        status = sl_fail(context, SL_UNSUPPORTED, "too many lines");
    if (status == SL_OK) status = begin(&plan->base, map.wall_count, SEGMENT_COLUMNS);
    slp_lines *kept = &plan->base.lines;
    if (status == SL_OK) {
        kept->lines = sl_alloc_array(context, map.wall_count, sizeof *kept->lines);
        if (!kept->lines) status = SL_NO_MEMORY;
    }
    for (size_t i = 0; status == SL_OK && i < map.wall_count; i++)
        kept->lines[i] = (sl_segment){map.walls[i].a, map.walls[i].b};
    sl_map_destroy(context, &map);
    return status;
}

int slp_plan_segments(slp_plan *plan, double metric_radius, double angular_radius,
                      unsigned threads) {
    const sl_segment_options options = {metric_radius, angular_radius, threads};
    slp_lines *kept = &plan->base.lines;
    slp_lines_forget(&plan->base);
    sl_status status = take_walls(plan);
    if (status == SL_OK)
        status = sl_segment_measure(plan->base.context, kept->lines, (uint32_t)kept->count,
                                    &options, (sl_segment_measures *)kept->values);
    if (status != SL_OK) slp_lines_forget(&plan->base);
    return status;
}

size_t slp_lines_copy(const void *handle, double *lines, double *values) {
    const slp_lines *kept = &((const slp_base *)handle)->lines;
    for (size_t i = 0; lines && i < kept->count; i++) {
        const sl_segment *s = &kept->lines[i];
        const double row[4] = {s->a.x, s->a.y, s->b.x, s->b.y};
        memcpy(lines + 4 * i, row, sizeof row);
    }
    if (values && kept->count)
        memcpy(values, kept->values, kept->count * kept->columns * sizeof *values);
    return kept->count;
}

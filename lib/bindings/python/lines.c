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

/// Of each line kept, its share of the weight of its wall.
static sl_status share_weights(slp_plan *plan, const sl_map *clean, const double *weights,
                               double *own) {
    sl_context *context = plan->base.context;
    uint32_t *walls = sl_alloc_array(context, clean->wall_count, sizeof *walls);
    if (!walls) return SL_NO_MEMORY;
    for (size_t i = 0; i < clean->wall_count; i++) walls[i] = clean->walls[i].line;
    const sl_status status =
        sl_segment_share(context, plan->base.lines.lines, (uint32_t)clean->wall_count, walls,
                         weights, (uint32_t)plan->map.wall_count, own);
    sl_free(context, walls);
    return status;
}

/// The walls of a clean copy: cleaning cuts the lines where they cross and joins their ends.
/// `weights`: by wall, or NULL; `own` gets those of the lines.
static sl_status take_walls(slp_plan *plan, const double *weights, double **own) {
    sl_context *context = plan->base.context;
    sl_map map = {0};
    SL_TRY(sl_map_copy(context, &plan->map, &map));
    for (size_t i = 0; i < map.wall_count; i++) {
        map.walls[i].ground = 0;
        map.walls[i].line = (uint32_t)i;
    }
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
    if (status == SL_OK && weights) {
        *own = sl_alloc_array(context, map.wall_count, sizeof **own);
        status = *own ? share_weights(plan, &map, weights, *own) : SL_NO_MEMORY;
    }
    sl_map_destroy(context, &map);
    return status;
}

static sl_status find_unlinks(slp_plan *plan, const double *points, size_t count,
                              sl_point *unlinks) {
    const slp_lines *kept = &plan->base.lines;
    for (size_t i = 0; i < count; i++)
        SL_TRY(sl_segment_crossing(plan->base.context, kept->lines, (uint32_t)kept->count,
                                   (sl_point){points[2 * i], points[2 * i + 1]}, &unlinks[i]));
    return SL_OK;
}

int slp_plan_segments(slp_plan *plan, double metric_radius, double angular_radius,
                      const double *weights, const double *unlinks, size_t unlink_count,
                      unsigned threads) {
    sl_context *context = plan->base.context;
    slp_lines *kept = &plan->base.lines;
    double *own = NULL;
    slp_lines_forget(&plan->base);
    sl_point *crossings = sl_alloc_array(context, unlink_count, sizeof *crossings);
    sl_status status = crossings ? take_walls(plan, weights, &own) : SL_NO_MEMORY;
    if (status == SL_OK) status = find_unlinks(plan, unlinks, unlink_count, crossings);
    const sl_segment_options options = {.metric_radius = metric_radius,
                                        .angular_radius = angular_radius,
                                        .threads = threads,
                                        .weights = own,
                                        .unlinks = crossings,
                                        .unlink_count = (uint32_t)unlink_count};
    if (status == SL_OK)
        status = sl_segment_measure(context, kept->lines, (uint32_t)kept->count, &options,
                                    (sl_segment_measures *)kept->values);
    sl_free(context, own);
    sl_free(context, crossings);
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

/// From a map to the measures of its visibility graph: sizes are checked before work begins.
#include "studies/vga_run.h"

#include "arguments/outputs.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

// --- the size of the graph

static double area_inside(const sl_space *space) {
    double area = 0;
    for (uint32_t c = 0; c < space->cell_count; c++)
        if (space->cells[c].inside) area += sl_space_area(space, c);
    return area;
}

/// The largest of 1, 2 and 5 times a power of ten that gives about 2000 points or more.
static double usual_step(const sl_space *space) {
    const double most = sqrt(area_inside(space) / 2000);
    if (!(most > 0)) return 1;
    const double power = pow(10, floor(log10(most)));
    return power * (most >= 5 * power ? 5 : most >= 2 * power ? 2 : 1);
}

/// What else makes a grid smaller, where the command has it.
static const char *or_at(const vga_plan *plan, const char *words) {
    return strcmp(plan->command, "vga") == 0 && !plan->of_building ? words : "";
}

/// Refuses a step by the area inside, before a grid is filled that is far too large. From --at the
/// grid may go out, and filling it says when it is too large.
static sl_status check_area(sl_context *context, const vga_plan *plan, const sl_space *space) {
    const double points = area_inside(space) / plan->points.step / plan->points.step;
    if (plan->points.at.count || points <= SL_VGA_POINTS_MOST) return SL_OK;
    return sl_fail(
        context, SL_BAD_ARGUMENT,
        "--grid %.9g: about %.3g points, and a graph has up to %u; choose a larger step%s",
        plan->points.step, points, SL_VGA_POINTS_MOST, or_at(plan, ", or one room with --at"));
}

/// A step that is wrong by far may be meant in another unit than the drawing's.
static sl_status name_unit(sl_context *context, const vga_plan *plan, const sl_map *map,
                           const sl_space *space, sl_status status) {
    const sl_box b = space->bounds;
    const double across = fmax(b.max.x - b.min.x, b.max.y - b.min.y);
    if (status != SL_BAD_ARGUMENT || !map->source.drawing_unit ||
        across < 10000 * plan->points.step || strcmp(map->unit, "m") == 0)
        return status;
    char message[512];
    snprintf(message, sizeof message, "%s", sl_context_message(context));
    return sl_fail(context, status, "%s; lengths are in %s: --unit m reads the drawing in metres",
                   message, map->unit);
}

/// Two plans in different units have no place in common.
static sl_status check_units(sl_context *context, const vga_plan *plan, const sl_map *map) {
    const sl_map *first = plan->first;
    if (!first || !*first->unit || !*map->unit || strcmp(first->unit, map->unit) == 0) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "--compare %s: its lengths are in %s, those of the first plan in %s; --unit m "
                   "reads both drawings in metres",
                   plan->input, map->unit, first->unit);
}

static sl_status check_memory(sl_context *context, const vga_plan *plan, const vga_work *w) {
    const uint32_t points = w->table.grid.count;
    uint64_t bytes;
    char size[SIZE_TEXT], most[SIZE_TEXT];
    SL_TRY(sl_vga_graph_bytes(context, w->outline, &w->table.grid, plan->range, &bytes));
    size_write(bytes, size);
    size_write(sl_machine_memory() / 2, most);
    if (bytes > sl_machine_memory() / 2)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--grid %.9g: the graph of %" PRIu32 " points takes about %s; half of this "
                       "machine's memory is %s; choose a larger step%s",
                       plan->points.step, points, size, most,
                       or_at(plan, ", or one room with --at"));
    sl_note(context, "%" PRIu32 " %s; the graph takes about %s", points,
            points == 1 ? "point" : "points", size);
    return SL_OK;
}

/// Bytes a point of an estimate, and of each of its threads, beside tiles.
enum { TALLIES = 64, SEARCHER = 32 };

static uint64_t plan_threads(const vga_plan *plan) {
    return plan->options.threads ? plan->options.threads : sl_core_count();
}

/// Refuses measures that take more than the graph left, before they are begun.
static sl_status check_measures(sl_context *context, const vga_plan *plan, const vga_work *w) {
    const sl_vga_grid *grid = &w->table.grid;
    uint64_t bytes;
    SL_TRY(sl_vga_measure_bytes(context, w->outline, grid, &w->graph, &plan->options, &bytes));
    if (plan->estimate_given)
        bytes += (uint64_t)grid->count * (TALLIES + SEARCHER * plan_threads(plan));
    if (w->link_count) bytes *= 2; // the graph of linked places, and its measures
    char size[SIZE_TEXT], most[SIZE_TEXT];
    size_write(bytes, size);
    size_write(sl_machine_memory() / 2, most);
    if (bytes > sl_machine_memory() / 2)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--grid %.9g: the measures of %" PRIu32 " points take up to %s; half of "
                       "this machine's memory is %s; choose a larger step, fewer --measures or "
                       "fewer --threads",
                       plan->points.step, grid->count, size, most);
    sl_note(context, "the measures take up to %s, the graph included", size);
    return SL_OK;
}

// --- the work

static sl_status find_depths(sl_context *context, const vga_plan *plan, vga_work *w) {
    const sl_vga_grid *grid = &w->table.grid;
    uint32_t *from = sl_alloc_array(context, plan->from.count, sizeof *from);
    w->table.depths = sl_alloc_array(context, grid->count, sizeof *w->table.depths);
    const unsigned parts = (plan->parts & VGA_PART_STEPS ? SL_VGA_GLOBAL : 0u) |
                           (plan->parts & VGA_PART_STEP_LENGTHS ? SL_VGA_METRIC : 0u) |
                           (plan->parts & VGA_PART_STEP_TURNS ? SL_VGA_ANGULAR : 0u);
    sl_status status = from && w->table.depths ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = vga_grid_find(context, grid, "--from", &plan->from, from);
    if (status == SL_OK)
        status = sl_vga_depth_walked(context, w->outline, grid, &w->graph, w->steps, w->links,
                                     w->link_count, parts, from, plan->from.count,
                                     plan->options.threads, w->table.depths);
    sl_free(context, from);
    return status;
}

static sl_status walk_agents(sl_context *context, const vga_plan *plan, vga_work *w) {
    const sl_vga_grid *grid = &w->table.grid;
    sl_vga_agents agents = plan->agents;
    uint32_t *starts = sl_alloc_array(context, plan->agents_from.count + 1, sizeof *starts);
    w->table.gates = sl_alloc_array(context, grid->count, sizeof *w->table.gates);
    sl_status status = starts && w->table.gates ? SL_OK : SL_NO_MEMORY;
    agents.threads = plan->options.threads;
    agents.starts = starts;
    agents.start_count = plan->agents_from.count;
    if (w->baked.map.oneway_count)
        status = sl_fail(context, SL_UNSUPPORTED,
                         "--agents: the map has one-way glass, and agents walk wherever they see; "
                         "--without oneway leaves it out");
    if (status == SL_OK)
        status = vga_grid_find(context, grid, "--agents-from", &plan->agents_from, starts);
    sl_vga_graph both = {0};
    if (status == SL_OK && w->steps)
        status = sl_vga_steps_connect(context, w->steps, grid, &w->graph, agents.threads, &both);
    const sl_vga_graph *graph = w->steps ? &both : &w->graph;
    if (status == SL_OK) status = sl_vga_walk_agents(context, grid, graph, &agents, w->table.gates);
    sl_vga_graph_destroy(context, &both);
    sl_free(context, starts);
    return status;
}

static sl_status measure_regions(sl_context *context, const vga_plan *plan, vga_work *w) {
    const sl_vga_grid *grid = &w->table.grid;
    const isovist_scene scene = {
        .space = &w->baked.space, .query = w->query, .range = sl_query_range(w->query)};
    SL_TRY(sl_query_set_range(context, w->query, plan->range));
    for (uint32_t p = 0; p < grid->count; p++)
        SL_TRY(eyes_add(context, &w->eyes, (eye_place){grid->points[p], 0, 360, 0}));
    w->table.isovists = sl_alloc_array(context, grid->count, sizeof *w->table.isovists);
    if (!w->table.isovists) return SL_NO_MEMORY;
    return isovist_run(context, &scene, &w->eyes, &plan->part, plan->options.threads,
                       w->table.isovists);
}

/// Mean depths from a few roots, and how far off they may be.
static sl_status estimate(sl_context *context, const vga_plan *plan, vga_work *w) {
    vga_table *table = &w->table;
    const uint32_t count = table->grid.count;
    sl_vga_estimate options = plan->estimate;
    options.threads = plan->options.threads;
    table->estimated = sl_alloc_array(context, count, sizeof *table->estimated);
    if (!table->estimated) return SL_NO_MEMORY;
    SL_TRY(sl_vga_estimate_depths(context, &table->grid, &w->graph, &options, table->measures,
                                  table->estimated));
    double sum = 0, most = 0, points = 0;
    for (uint32_t p = 0; p < count; p++) {
        const double depth = table->measures[p].visual_mean_depth;
        const sl_vga_interval ends = table->estimated[p];
        if (isnan(depth)) continue;
        const double off = fmax(depth - ends.least, ends.most - depth);
        most = fmax(most, off);
        sum += off;
        points++;
    }
    sl_note(context,
            "visual_mean_depth is estimated from %" PRIu32 " root%s, integration from it; for each "
            "point the exact value is between _least and _most with a probability of at least "
            "%.9g %%: %.3g steps off on average, %.3g at most",
            options.roots, options.roots == 1 ? "" : "s", 100 * options.confidence,
            points > 0 ? sum / points : 0, most);
    return SL_OK;
}

static sl_status measure(sl_context *context, vga_plan *plan, vga_work *w) {
    vga_table *table = &w->table;
    const sl_vga_grid *grid = &table->grid;
    table->parts = plan->parts;
    table->global_only = plan->global_only;
    table->earth = w->baked.map.earth;
    const unsigned of_graph = plan->parts & ~(unsigned)VGA_PART_ISOVIST;
    table->measures = sl_alloc_array(context, grid->count, sizeof *table->measures);
    if (!table->measures) return SL_NO_MEMORY;
    if (of_graph || plan->pairs) {
        SL_TRY(check_memory(context, plan, w));
        SL_TRY(sl_vga_graph_make(context, w->outline, grid, plan->range, plan->options.threads,
                                 &w->graph));
        if (plan->turned) SL_TRY(sl_vga_graph_turn(context, &w->graph));
    }
    unsigned visual = SL_VGA_LOCAL | (plan->of_building ? 0u : (unsigned)SL_VGA_GLOBAL);
    // Of an estimate it is for the bytes that it takes.
    if (plan->estimate_given || plan->global_only) visual = SL_VGA_GLOBAL;
    plan->options.parts = (of_graph & VGA_PART_VISUAL ? visual : 0u) |
                          (of_graph & VGA_PART_THROUGH ? SL_VGA_THROUGH : 0u) |
                          (of_graph & VGA_PART_METRIC ? SL_VGA_METRIC : 0u) |
                          (of_graph & VGA_PART_ANGULAR ? SL_VGA_ANGULAR : 0u);
    if (plan->part.count) {
        size_t first, stop;
        table_part_rows(&plan->part, grid->count, &first, &stop);
        plan->options.first = (uint32_t)first;
        plan->options.count = (uint32_t)(stop - first);
        if (first == stop) plan->options.parts = 0;
    }
    if (plan->options.parts) SL_TRY(check_measures(context, plan, w));
    if (plan->from.count && !plan->of_building) SL_TRY(find_depths(context, plan, w));
    if (plan->agents_given) SL_TRY(walk_agents(context, plan, w));
    if (plan->estimate_given)
        SL_TRY(estimate(context, plan, w));
    else if (plan->options.parts)
        SL_TRY(sl_vga_measure_walked_linked(context, w->outline, grid, &w->graph, w->steps,
                                            w->links, w->link_count, &plan->options,
                                            table->measures));
    return plan->parts & VGA_PART_ISOVIST ? measure_regions(context, plan, w) : SL_OK;
}

/// The parts of the graph that no sightline joins. Measures of the whole graph are of a point's
/// own.
static sl_status find_parts(sl_context *context, vga_work *w) {
    vga_table *table = &w->table;
    if (!w->graph.rows) return SL_OK;
    table->part = sl_alloc_array(context, table->grid.count, sizeof *table->part);
    if (!table->part) return SL_NO_MEMORY;
    SL_TRY(
        sl_vga_parts(context, &w->graph, w->links, w->link_count, table->part, &table->part_count));
    if (table->part_count > 1)
        sl_note(context,
                "%" PRIu32 " parts that no sightline joins, numbered in the column 'part': the "
                "largest has %" PRIu32 " of %" PRIu32 " points",
                table->part_count, vga_part_size(table, 0), table->grid.count);
    return SL_OK;
}

/// Measures of a map with glass are directed: what a point sees, or who sees it.
static sl_status check_direction(sl_context *context, const vga_plan *plan, const vga_work *w) {
    if (w->baked.map.oneway_count) {
        sl_note(context, plan->turned ? "one-way glass: measures are of who sees a point"
                                      : "one-way glass: measures are of what a point sees; "
                                        "--seen-from counts who sees it");
    } else if (plan->turned) {
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--seen-from is for maps with one-way glass: without it, who is seen sees");
    }
    return SL_OK;
}

/// Without places to fill from, the grid is all that is inside.
static sl_status note_inside(sl_context *context, const vga_plan *plan, const vga_work *w) {
    const sl_map *map = &w->baked.map;
    const sl_space *space = &w->baked.space;
    if (plan->points.at.count) return pipeline_note_inside(context, &plan->pipeline, map, space);
    return pipeline_need_inside(context, &plan->pipeline, map, space,
                                or_at(plan, ", or fill the grid from a point: --at X,Y"));
}

/// The plan of steps, from that of sight before its doors are shut.
static sl_status make_steps(sl_context *context, const vga_plan *plan, vga_work *w) {
    const sl_map *map = &w->baked.map;
    sl_query *doors = NULL;
    bool *shut = sl_alloc_array(context, map->door_count + 1, sizeof *shut);
    sl_status status = shut ? doors_read(context, &plan->doors, map, shut) : SL_NO_MEMORY;
    if (status == SL_OK) status = sl_query_over(context, &w->baked.space, map, NULL, &doors);
    for (size_t i = 0; i < map->door_count && status == SL_OK; i++)
        sl_query_set_door_at(context, doors, i, !shut[i]);
    if (status == SL_OK)
        status = sl_vga_steps_create(context, &w->baked, doors, &plan->pipeline.bake, &w->steps);
    sl_query_destroy(context, doors);
    sl_free(context, shut);
    return status;
}

/// From the map to its measures.
sl_status vga_compute(sl_context *context, vga_plan *plan, vga_work *w) {
    SL_TRY(pipeline_read_space(context, &plan->pipeline, plan->command, ~(unsigned)SL_EFFECT_MIRROR,
                               "steps and paths lead straight to points, not to mirror images",
                               &w->baked));
    SL_TRY(check_units(context, plan, &w->baked.map));
    SL_TRY(check_direction(context, plan, w));
    if (!name_ends_with(plan->input, ".slv")) SL_TRY(note_inside(context, plan, w));
    SL_TRY(make_steps(context, plan, w));
    SL_TRY(doors_shut(context, &plan->doors, &w->baked));
    if (!plan->range_given) plan->range = w->baked.map.range;
    SL_TRY(sl_query_over(context, &w->baked.space, &w->baked.map, NULL, &w->query));
    SL_TRY(sl_query_outline(context, w->query, &w->outline));
    if (!(plan->points.step > 0)) plan->points.step = usual_step(&w->baked.space);
    sl_status status = check_area(context, plan, &w->baked.space);
    status = pipeline_name_stray(context, plan->input, &w->baked.map, &w->baked.space, status);
    if (status == SL_OK)
        status = vga_grid_choose(context, &plan->points, &plan->pipeline, &w->baked.map,
                                 sl_vga_steps_outline(w->steps, w->outline), &w->table.grid);
    SL_TRY(name_unit(context, plan, &w->baked.map, &w->baked.space, status));
    if (plan->points.links)
        SL_TRY(vga_grid_read_links(context, plan->points.links, &w->table.grid, &w->links,
                                   &w->link_count));
    SL_TRY(measure(context, plan, w));
    return plan->of_building ? SL_OK : find_parts(context, w);
}

void vga_work_destroy(sl_context *context, vga_work *w) {
    sl_free(context, w->table.measures);
    sl_free(context, w->table.isovists);
    sl_free(context, w->table.estimated);
    sl_free(context, w->table.depths);
    sl_vga_steps_destroy(context, w->steps);
    sl_free(context, w->table.gates);
    sl_free(context, w->table.part);
    sl_free(context, w->links);
    sl_vga_grid_destroy(context, &w->table.grid);
    sl_vga_graph_destroy(context, &w->graph);
    eyes_destroy(context, &w->eyes);
    sl_query_destroy(context, w->query);
    sl_baked_destroy(context, &w->baked);
}

/// `sightline vga`: visibility graph analysis of a grid of points, as tables and heat maps.
#include "arguments/help.h"
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "inputs/pipeline.h"
#include "reports/heat_map.h"
#include "sightline/query.h"
#include "sightline/support.h"
#include "studies/vga_change.h"
#include "studies/vga_grid.h"
#include "studies/vga_table.h"
#include "system/built.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct vga_plan {
    const char *input, *output, *picture, *pairs;
    const char *compare;      ///< another plan, to be compared
    const sl_map *first;      ///< of the other plan: the map that it is compared with
    const char *compare_shut; ///< its doors that are shut
    door_choice doors;
    map_pipeline pipeline;
    vga_grid_plan points;
    option_list from, agents_from;
    sl_vga_agents agents;
    const char *agents_given, *agent_option;
    double range;
    bool turned; ///< who sees a point, in place of what it sees
    unsigned parts;
    const char *step_given, *parts_given, *range_given, *measure_given, *scale_given;
    const char *visual_given, *metric_given, *angular_given; ///< radii
    size_t measure;
    sl_point scale; ///< from x to y
    sl_vga_options options;
    sl_draw_options drawing;
} vga_plan;

typedef struct vga_work {
    sl_baked baked;
    sl_query *query;
    const sl_outline *outline; ///< the query's
    sl_vga_steps *steps;       ///< NULL where steps go as sight does
    sl_vga_graph graph;
    sl_vga_link *links;
    size_t link_count;
    eye_places eyes; ///< the points again, for their regions
    vga_table table;
} vga_work;

// --- the options

/// A measure of the groups that are chosen: the default one, else their first.
static size_t some_measure(unsigned parts) {
    size_t k = sl_measure_find(SL_VGA, "visual_integration_hh");
    if (parts & vga_measure_part(k)) return k;
    for (k = 0; !(parts & vga_measure_part(k));) k++;
    return k;
}

/// A radius limits measures that must be asked for.
static sl_status check_radius(sl_context *context, const vga_plan *p, const char *given,
                              unsigned part, const char *name) {
    if (!given || p->parts & part) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT, "--%s is for the %s measures; add them to --measures",
                   given, name);
}

static sl_status make_plan(sl_context *context, vga_plan *p) {
    if (!p->step_given)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--grid is missing: the distance between neighbouring points");
    if (!p->parts_given) p->parts = p->measure_given ? 0 : VGA_PART_VISUAL;
    if (p->parts & VGA_PART_ALL) p->parts |= VGA_PART_ALL - 1;
    p->parts &= VGA_PART_ALL - 1;
    const unsigned part = p->measure_given ? vga_measure_part(p->measure) : 0;
    const unsigned steps = VGA_PART_STEPS | VGA_PART_STEP_LENGTHS | VGA_PART_STEP_TURNS;
    if (part & steps && !p->from.count) {
        const name_table measures = measure_table(SL_VGA);
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--measure %s needs --from X,Y: where the steps begin",
                       name_table_at(&measures, p->measure));
    }
    p->parts |= part;
    if (p->from.count) p->parts |= VGA_PART_STEPS;
    if (p->from.count && p->parts & VGA_PART_METRIC) p->parts |= VGA_PART_STEP_LENGTHS;
    if (p->from.count && p->parts & VGA_PART_ANGULAR) p->parts |= VGA_PART_STEP_TURNS;
    if (part == VGA_PART_AGENTS && !p->agents_given)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--measure gate_counts needs --agents N: how many walk");
    if ((p->agent_option || p->agents_from.count) && !p->agents_given)
        return sl_fail(context, SL_BAD_ARGUMENT, "--%s is for --agents N",
                       p->agent_option ? p->agent_option : "agents-from");
    if (p->agents_given) p->parts |= VGA_PART_AGENTS;
    if (!p->parts)
        return sl_fail(context, SL_BAD_ARGUMENT, "--measures none: name one group or several");
    if (!p->measure_given) p->measure = some_measure(p->parts);
    SL_TRY(within_check(context, &p->points.within));
    SL_TRY(check_radius(context, p, p->visual_given, VGA_PART_VISUAL, "visual"));
    SL_TRY(check_radius(context, p, p->metric_given, VGA_PART_METRIC, "metric"));
    SL_TRY(check_radius(context, p, p->angular_given, VGA_PART_ANGULAR, "angular"));
    if (p->scale_given && !p->picture)
        return sl_fail(context, SL_BAD_ARGUMENT, "--scale is for a --picture");
    if (p->compare_shut && !p->compare)
        return sl_fail(context, SL_BAD_ARGUMENT, "--compare-shut is for --compare MAP");
    if (p->scale_given && p->compare && p->scale.x != -p->scale.y)
        return sl_fail(
            context, SL_BAD_ARGUMENT,
            "--scale %.9g,%.9g: changes need the same number on both sides of 0, as -2,2",
            p->scale.x, p->scale.y);
    if (p->scale_given && !(p->scale.x < p->scale.y))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--scale %.9g,%.9g: expected the smaller number first, as 0,500", p->scale.x,
                       p->scale.y);
    return pipeline_plan(context, p->input, &p->pipeline);
}

// --- the size of the graph

/// Refuses a step by the area inside, before a grid is filled that is far too large. From --at the
/// grid may go out, and filling it says when it is too large.
static sl_status check_area(sl_context *context, const vga_plan *plan, const sl_space *space) {
    double area = 0;
    for (uint32_t c = 0; c < space->cell_count; c++)
        if (space->cells[c].inside) area += sl_space_area(space, c);
    const double points = area / plan->points.step / plan->points.step;
    if (plan->points.at.count || points <= SL_VGA_POINTS_MOST) return SL_OK;
    return sl_fail(
        context, SL_BAD_ARGUMENT,
        "--grid %.9g: about %.3g points, and a graph has up to %u; choose a larger step, "
        "or one room with --at",
        plan->points.step, points, SL_VGA_POINTS_MOST);
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
                       "machine's memory is %s; choose a larger step, or one room with --at",
                       plan->points.step, points, size, most);
    sl_note(context, "%" PRIu32 " %s; the graph takes about %s", points,
            points == 1 ? "point" : "points", size);
    return SL_OK;
}

/// Refuses measures that take more than the graph left, before they are begun.
static sl_status check_measures(sl_context *context, const vga_plan *plan, const vga_work *w) {
    const sl_vga_grid *grid = &w->table.grid;
    uint64_t bytes;
    SL_TRY(sl_vga_measure_bytes(context, w->outline, grid, &w->graph, &plan->options, &bytes));
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
    return isovist_run(context, &scene, &w->eyes, plan->options.threads, w->table.isovists);
}

static sl_status put_pairs(sl_context *context, const vga_work *w, FILE *out) {
    const sl_vga_grid *grid = &w->table.grid;
    char text[4][SL_NUMBER_TEXT];
    fputs("x,y,to_x,to_y\n", out);
    for (uint32_t p = 0; p < grid->count; p++) {
        SL_TRY(sl_check_cancelled(context));
        sl_number_write(grid->points[p].x, text[0]);
        sl_number_write(grid->points[p].y, text[1]);
        for (sl_vga_run run = sl_vga_row(&w->graph, p); sl_vga_next(&run);)
            for (uint32_t q = run.first; q < run.stop; q++) {
                sl_number_write(grid->points[q].x, text[2]);
                sl_number_write(grid->points[q].y, text[3]);
                fprintf(out, "%s,%s,%s,%s\n", text[0], text[1], text[2], text[3]);
            }
    }
    return SL_OK;
}

/// Who sees whom: a row for each ordered pair.
static sl_status write_pairs(sl_context *context, const vga_plan *plan, const vga_work *w) {
    sl_output output;
    SL_TRY(sl_output_open(context, plan->pairs, &output));
    return sl_output_close(context, &output, put_pairs(context, w, output.stream));
}

static sl_status measure(sl_context *context, vga_plan *plan, vga_work *w) {
    vga_table *table = &w->table;
    const sl_vga_grid *grid = &table->grid;
    table->parts = plan->parts;
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
    plan->options.parts = (of_graph & VGA_PART_VISUAL ? SL_VGA_LOCAL | SL_VGA_GLOBAL : 0u) |
                          (of_graph & VGA_PART_THROUGH ? SL_VGA_THROUGH : 0u) |
                          (of_graph & VGA_PART_METRIC ? SL_VGA_METRIC : 0u) |
                          (of_graph & VGA_PART_ANGULAR ? SL_VGA_ANGULAR : 0u);
    if (plan->options.parts) SL_TRY(check_measures(context, plan, w));
    if (plan->from.count) SL_TRY(find_depths(context, plan, w));
    if (plan->agents_given) SL_TRY(walk_agents(context, plan, w));
    if (plan->options.parts)
        SL_TRY(sl_vga_measure_walked_linked(context, w->outline, grid, &w->graph, w->steps,
                                            w->links, w->link_count, &plan->options,
                                            table->measures));
    return plan->parts & VGA_PART_ISOVIST ? measure_regions(context, plan, w) : SL_OK;
}

/// Fields go row by row from the lowest, grids column by column. A point is the middle of a square.
static void lay_out(const sl_vga_grid *grid, const double *values, double *field) {
    for (size_t i = 0; i < (size_t)grid->columns * grid->rows; i++) field[i] = NAN;
    for (uint32_t p = 0; p < grid->count; p++) {
        const size_t column = grid->squares[p] / grid->rows, row = grid->squares[p] % grid->rows;
        field[row * grid->columns + column] = values[p];
    }
}

/// Of several parts the largest alone is coloured, by its own scale. `grey` takes the squares of
/// the others, by point.
static void grey_others(const vga_table *table, double *values, double *grey) {
    for (uint32_t p = 0; p < table->grid.count; p++) {
        grey[p] = table->part[p] ? 1 : NAN;
        if (table->part[p]) values[p] = NAN;
    }
}

/// Areas, steps of agents and the like do not go by the part that a point is in: small parts only
/// do not set their scale.
static sl_status scale_without_small(sl_context *context, const vga_plan *plan, const vga_work *w,
                                     const double *values, sl_field *field) {
    uint32_t *sizes = sl_alloc_array(context, w->table.grid.count, sizeof *sizes);
    sl_status status = sizes ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK && w->graph.rows)
        status = sl_vga_part_sizes(context, &w->graph, w->links, w->link_count, sizes);
    else if (status == SL_OK)
        status = isovist_part_sizes(context, w->query, &w->eyes, sizes);
    if (status == SL_OK)
        heat_map_scale(context, plan->scale_given != NULL, values, sizes, w->table.grid.count,
                       &field->least, &field->most);
    sl_free(context, sizes);
    return status;
}

static sl_status draw(sl_context *context, const vga_plan *plan, const vga_work *w) {
    const sl_vga_grid *grid = &w->table.grid;
    const size_t count = (size_t)grid->columns * grid->rows;
    const name_table measures = measure_table(SL_VGA);
    double *laid = sl_alloc_array(context, count, sizeof *laid);
    double *values = sl_alloc_array(context, grid->count, sizeof *values);
    double *others = sl_alloc_array(context, grid->count, sizeof *others);
    bool *grey = sl_alloc_array(context, count, sizeof *grey);
    sl_status status = laid && values && others && grey ? SL_OK : SL_NO_MEMORY;
    const heat_map heat = {.input = plan->input,
                           .map = plan->pipeline.input.import.map,
                           .measure = name_table_at(&measures, plan->measure),
                           .drawing = &plan->drawing,
                           .path = plan->picture};
    sl_field field = {.corner = {((double)grid->left - 0.5) * grid->step,
                                 ((double)grid->bottom - 0.5) * grid->step},
                      .step = grid->step,
                      .columns = grid->columns,
                      .rows = grid->rows,
                      .values = laid,
                      .least = plan->scale.x,
                      .most = plan->scale.y};
    for (uint32_t p = 0; status == SL_OK && p < grid->count; p++)
        values[p] = vga_value(&w->table, plan->measure, p);
    if (status == SL_OK && !vga_measure_is_of_part(plan->measure)) {
        status = scale_without_small(context, plan, w, values, &field);
    } else if (status == SL_OK && w->table.part_count > 1 && !plan->scale_given) {
        grey_others(&w->table, values, others);
        lay_out(grid, others, laid);
        for (size_t i = 0; i < count; i++) grey[i] = !isnan(laid[i]);
        field.grey = grey;
        sl_note(context,
                "the colours are those of the largest part; the other%s grey (--scale "
                "MIN,MAX colours all)",
                w->table.part_count > 2 ? "s are" : " is");
    }
    if (status == SL_OK) {
        lay_out(grid, values, laid);
        status = heat_map_draw(context, &w->baked, &heat, &field);
    }
    void *const arrays[] = {laid, values, others, grey};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) sl_free(context, arrays[i]);
    return status;
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
                                ", or fill the grid from a point: --at X,Y");
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
static sl_status compute(sl_context *context, vga_plan *plan, vga_work *w) {
    SL_TRY(pipeline_read_space(context, &plan->pipeline, "vga", ~(unsigned)SL_EFFECT_MIRROR,
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
    return find_parts(context, w);
}

static void work_destroy(sl_context *context, vga_work *w) {
    sl_free(context, w->table.measures);
    sl_free(context, w->table.isovists);
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

static sl_status draw_change(sl_context *context, const vga_plan *plan, const vga_work *w,
                             const vga_change *change) {
    const name_table measures = measure_table(SL_VGA);
    char name[96];
    snprintf(name, sizeof name, "change of %s", name_table_at(&measures, plan->measure));
    const heat_map heat = {.input = plan->input,
                           .map = plan->pipeline.input.import.map,
                           .measure = name,
                           .drawing = &plan->drawing,
                           .path = plan->picture};
    sl_field field;
    double *values;
    SL_TRY(vga_change_field(context, change, plan->measure, &values, &field));
    field.least = plan->scale.x;
    field.most = plan->scale.y;
    const sl_status status = heat_map_draw(context, &w->baked, &heat, &field);
    sl_free(context, values);
    return status;
}

/// Where the table goes: a file, stdout, or nowhere (NULL).
static const char *table_path(const vga_plan *plan) {
    if (plan->output) return plan->output;
    return plan->picture ? NULL : "-";
}

/// Computes the other plan too, and shows the difference.
static sl_status compare(command_console *console, const vga_plan *plan, const vga_work *w) {
    sl_context *context = console->context;
    const char *path = table_path(plan);
    vga_plan other_plan = *plan;
    vga_work other = {0};
    vga_change change = {0};
    other_plan.input = plan->compare;
    other_plan.first = &w->baked.map;
    if (plan->compare_shut)
        other_plan.doors =
            (door_choice){.shut = plan->compare_shut, .shut_option = "--compare-shut"};
    if (!plan->range_given) other_plan.range = 0;
    sl_status status = pipeline_plan(context, plan->compare, &other_plan.pipeline);
    if (status == SL_OK) status = compute(context, &other_plan, &other);
    if (status == SL_OK) status = vga_change_make(context, &w->table, &other.table, &change);
    if (status == SL_OK && plan->pairs) status = write_pairs(context, plan, w);
    if (status == SL_OK && plan->picture) status = draw_change(context, plan, w, &change);
    progress_line_clear(&console->line);
    if (status == SL_OK && path) status = vga_change_write(context, &change, path);
    if (status == SL_OK && !console->quiet && (!path || strcmp(path, "-") != 0))
        vga_change_print(&change, plan->measure);
    vga_change_destroy(context, &change);
    work_destroy(context, &other);
    return status;
}

static sl_status work(command_console *console, vga_plan *plan, vga_work *w) {
    sl_context *context = console->context;
    const char *path = table_path(plan);
    SL_TRY(compute(context, plan, w));
    if (plan->compare) return compare(console, plan, w);
    if (plan->pairs) SL_TRY(write_pairs(context, plan, w));
    if (plan->picture) SL_TRY(draw(context, plan, w));
    progress_line_clear(&console->line);
    if (path) SL_TRY(vga_write(context, &w->table, path));
    if (!console->quiet && (!path || strcmp(path, "-") != 0))
        vga_print_summary(&w->table, plan->measure);
    return SL_OK;
}

static void print_tables(void) {
    size_t count;
    const sl_measure *measures = sl_measures(SL_VGA, &count);
    const name_table parts = vga_parts();
    puts("\nmeasures, for --measure, and their groups, for --measures:");
    for (unsigned bit = 0; 1u << bit <= VGA_PART_STEPS; bit++) {
        const bool steps = 1u << bit == VGA_PART_STEPS;
        if (1u << bit == VGA_PART_ALL) continue;
        printf(" %s:\n", steps ? "with --from and --agents" : name_table_at(&parts, bit));
        for (size_t k = 0; k < count; k++)
            if (steps ? vga_measure_part(k) >= VGA_PART_STEPS : vga_measure_part(k) == 1u << bit)
                help_measure(&measures[k], 36);
    }
}

sl_status cmd_vga(command_console *console, int argc, char **argv) {
    vga_plan plan = {.pipeline = pipeline_default(),
                     .options = sl_vga_options_default(),
                     .agents = sl_vga_agents_default(),
                     .drawing = built_draw_options()};
    option_table pipeline = pipeline_option_table(&plan.pipeline);
    const option_table picture = picture_option_table(&plan.drawing, "picture", true);
    const option_table doors = door_option_table(&plan.doors);
    const option_table points = vga_grid_option_table(&plan.points);
    const option_spec options[] = {
        {"grid", 0, "STEP", "distance between neighbouring points", .number = &plan.points.step,
         .over_0 = true, .given = &plan.step_given},
        {"at", 0, "X,Y",
         "fill the grid from here through doors that are open (default: all that is inside); may "
         "be given several times",
         .list = &plan.points.at},
        {"output", 'o', "TABLE",
         "where the table goes: .csv, or .geojson for a GIS (default: stdout, or nowhere if there "
         "is a --picture)",
         .text = &plan.output, .check = CHECK_FILE, .endings = ".csv .txt .geojson"},
        {"picture", 0, "PICTURE", "draw a heat map: .png, .svg or .pdf", .text = &plan.picture,
         .check = CHECK_PICTURE},
        {"measure", 0, "NAME",
         "what the picture shows and the summary ranks (default: visual_integration_hh)",
         .choice = &plan.measure, .names = measure_table(SL_VGA), .given = &plan.measure_given},
        {"measures", 0, "GROUP,...",
         "what to compute: visual, through, metric, angular, isovist, all (default: the group of "
         "--measure, else visual)",
         .choices = &plan.parts, .names = vga_parts(), .given = &plan.parts_given},
        {.group = &doors},
        {"from", 0, "X,Y",
         "add the column visual_step_depth: steps from here; with --measures metric or angular the "
         "paths from here too; may be given several times",
         .list = &plan.from, .rare = true},
        {"compare", 0, "MAP",
         "compute another plan on the same grid too, and show the other less this one",
         .text = &plan.compare, .is_input = true},
        {"compare-shut", 0, "NAME,...",
         "shut these doors of the other plan (default: as in this one); to see what a door does, "
         "compare a map with itself",
         .text = &plan.compare_shut, .rare = true},
        {"pairs", 0, "FILE.csv", "write the pairs of points that see each other",
         .text = &plan.pairs, .check = CHECK_TABLE, .rare = true},
        {"seen-from", 0, NULL, "with one-way glass: who sees a point (default: what a point sees)",
         .flag = &plan.turned, .rare = true},
        {"range", 0, "R", "see no farther than R (default: the map's range)", .number = &plan.range,
         .over_0 = true, .given = &plan.range_given},
        {"scale", 0, "MIN,MAX",
         "the ends of the colour scale, to compare pictures (default: smallest and largest value "
         "in "
         "parts of the plan with at least a tenth of the points of the largest part)",
         .point = &plan.scale, .given = &plan.scale_given, .rare = true},
        {"threads", 0, "N", "number of threads (default: one per core)",
         .count32 = &plan.options.threads, .most = 1024},
        {"radius", 0, "N", "visual: only points within N steps (default: all)",
         .count32 = &plan.options.radius, .least = 1, .most = UINT32_MAX, .topic = "limits",
         .given = &plan.visual_given, .rare = true},
        {"metric-radius", 0, "R", "metric: only paths up to this length (default: all)",
         .number = &plan.options.metric_radius, .over_0 = true, .topic = "limits",
         .given = &plan.metric_given, .rare = true},
        {"angular-radius", 0, "A",
         "angular: only paths that turn up to A right angles (default: all)",
         .number = &plan.options.angular_radius, .over_0 = true, .topic = "limits",
         .given = &plan.angular_given, .rare = true},
        {"agents", 0, "N",
         "let N agents walk by sight, and add the column gate_counts: steps onto a point (Turner "
         "and "
         "Penn 2002)",
         .count32 = &plan.agents.agents, .least = 1, .most = 1 << 30, .topic = "agents",
         .given = &plan.agents_given},
        {"agents-from", 0, "X,Y",
         "where agents start (default: anywhere); may be given several times",
         .list = &plan.agents_from, .topic = "agents", .rare = true},
        {"agent-steps", 0, "N", "steps of an agent (default 1000)", .count32 = &plan.agents.steps,
         .least = 1, .most = 1 << 30, .topic = "agents", .given = &plan.agent_option, .rare = true},
        {"agent-look", 0, "N", "steps until an agent picks a new goal (default 3)",
         .count32 = &plan.agents.look, .least = 1, .most = 1 << 30, .topic = "agents",
         .given = &plan.agent_option, .rare = true},
        {"agent-view", 0, "DEG", "field of view of an agent, in degrees (default 170)",
         .number = &plan.agents.view, .over_0 = true, .most = 360, .topic = "agents",
         .needs = "over 0 and up to 360 degrees are needed", .given = &plan.agent_option,
         .rare = true},
        {"seed", 0, "N", "random seed of agents (default 1)", .count = &plan.agents.seed,
         .topic = "agents", .given = &plan.agent_option, .rare = true},
        {.group = &points},
        {.group = &picture},
        {.group = &pipeline},
    };
    const command_usage usage = {
        .name = "vga",
        .synopsis = "MAP|FILE.slv --grid STEP [options]",
        .operands = {"MAP|FILE.slv"},
        .what = "Computes visibility graph analysis (space syntax). The graph joins the points of "
                "a grid that see each other. Writes a table under the names that depthmapX gives "
                "the measures. Shortest and straightest paths turn only at points beside walls, "
                "and add up in single precision, as those of depthmapX. A measure that is not "
                "defined at a point has no value there.",
        .tables = print_tables,
        .examples = "  sightline vga office.map --grid 1 -o office.csv --picture office.png\n"
                    "  sightline vga office.map --grid 1 --measure visual_control --picture "
                    "a.png\n"
                    "  sightline vga old.map --grid 1 --compare new.map --picture gain.png",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .given = &plan.pipeline.given,
    };
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, &plan.input, &helped));
    if (helped) return SL_OK;
    SL_TRY(make_plan(console->context, &plan));
    vga_work w = {0};
    const sl_status status = work(console, &plan, &w);
    work_destroy(console->context, &w);
    return status;
}

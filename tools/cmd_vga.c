/// `sightline vga`: visibility graph analysis of a grid of points, as tables and heat maps.
#include "commands.h"
#include "heat_map.h"
#include "outputs.h"
#include "pipeline.h"
#include "sightline/outline.h"
#include "sightline/support.h"
#include "vga_table.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

typedef struct vga_plan {
    const char *input, *output, *picture;
    door_choice doors;
    map_pipeline pipeline;
    option_list at, from;
    double step, range;
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
    sl_outline outline;
    sl_vga_graph graph;
    eye_places eyes; ///< the points again, for their regions
    vga_table table;
} vga_work;

// --- the options

static size_t default_measure(void) {
    const name_table measures = vga_measures();
    size_t k = 0;
    while (strcmp(name_table_at(&measures, k), "visual_integration_hh") != 0) k++;
    return k;
}

/// A measure of the groups that are chosen: the default one, else their first.
static size_t some_measure(unsigned parts) {
    size_t k = default_measure();
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
    if (p->from.count) p->parts |= VGA_PART_STEPS;
    const unsigned part = p->measure_given ? vga_measure_part(p->measure) : 0;
    if (part == VGA_PART_STEPS && !p->from.count)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--measure visual_step_depth needs --from X,Y: where the steps begin");
    p->parts |= part;
    if (!p->parts)
        return sl_fail(context, SL_BAD_ARGUMENT, "--measures none: name one group or several");
    if (!p->measure_given) p->measure = some_measure(p->parts);
    SL_TRY(check_radius(context, p, p->visual_given, VGA_PART_VISUAL, "visual"));
    SL_TRY(check_radius(context, p, p->metric_given, VGA_PART_METRIC, "metric"));
    SL_TRY(check_radius(context, p, p->angular_given, VGA_PART_ANGULAR, "angular"));
    if (p->scale_given && !p->picture)
        return sl_fail(context, SL_BAD_ARGUMENT, "--scale is for a --picture");
    if (p->scale_given && !(p->scale.x < p->scale.y))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--scale %.9g,%.9g: expected the smaller number first, as 0,500", p->scale.x,
                       p->scale.y);
    return pipeline_plan(context, p->input, &p->pipeline);
}

// --- the grid

static sl_status fill_grid(sl_context *context, const vga_plan *plan, vga_work *w) {
    const sl_space *space = &w->baked.space;
    sl_point *seeds = sl_alloc_array(context, plan->at.count + 1, sizeof *seeds);
    sl_status status = seeds ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; i < plan->at.count && status == SL_OK; i++) {
        status = read_point(context, "--at", plan->at.items[i], &seeds[i]);
        if (status == SL_OK)
            status = input_locate(context, "--at", plan->at.items[i], space, seeds[i], NULL);
    }
    if (status == SL_OK)
        status = sl_vga_grid_fill(context, &w->outline, plan->step, seeds, plan->at.count,
                                  &w->table.grid);
    sl_free(context, seeds);
    if (status == SL_OK && w->table.grid.count == 0)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--grid %.9g: no point of the grid is inside the map; choose a smaller step",
                       plan->step);
    return status;
}

static sl_status refuse_size(sl_context *context, const vga_plan *plan, double points) {
    char most[SIZE_TEXT];
    size_write(sl_machine_memory() / 2, most);
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "--grid %.9g: the graph of %.0f points needs %.3g GiB; half of this machine's "
                   "memory is %s; choose a larger step, or one room with --at",
                   plan->step, points, points * points / 8 / 1073741824.0, most);
}

/// Refuses a step by the area inside, before a grid is filled that is far too large.
static sl_status check_area(sl_context *context, const vga_plan *plan, const sl_space *space) {
    double area = 0;
    for (uint32_t c = 0; c < space->cell_count; c++)
        if (space->cells[c].inside) area += sl_space_area(space, c);
    const double points = area / plan->step / plan->step;
    if (plan->at.count || points * points / 8 <= (double)sl_machine_memory()) return SL_OK;
    return refuse_size(context, plan, points);
}

static sl_status check_memory(sl_context *context, const vga_plan *plan, uint32_t points) {
    const uint64_t bytes = sl_vga_graph_bytes(points);
    char size[SIZE_TEXT];
    if (bytes > sl_machine_memory() / 2) return refuse_size(context, plan, points);
    size_write(bytes, size);
    sl_note(context, "%" PRIu32 " %s; the graph takes %s", points, points == 1 ? "point" : "points",
            size);
    return SL_OK;
}

// --- the work

static sl_status find_depths(sl_context *context, const vga_plan *plan, vga_work *w) {
    const sl_vga_grid *grid = &w->table.grid;
    uint32_t *from = sl_alloc_array(context, plan->from.count, sizeof *from);
    w->table.depths = sl_alloc_array(context, grid->count, sizeof *w->table.depths);
    sl_status status = from && w->table.depths ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; i < plan->from.count && status == SL_OK; i++) {
        const char *text = plan->from.items[i];
        sl_point at = {0};
        status = read_point(context, "--from", text, &at);
        const double x = round(at.x / grid->step) * grid->step;
        const double y = round(at.y / grid->step) * grid->step;
        uint32_t p = 0;
        while (p < grid->count && (fabs(grid->points[p].x - x) > grid->step / 4 ||
                                   fabs(grid->points[p].y - y) > grid->step / 4))
            p++;
        from[i] = p;
        if (status == SL_OK && p == grid->count)
            status = sl_fail(context, SL_BAD_ARGUMENT,
                             "--from %s: the grid has no point there; choose a place in a room "
                             "that the grid fills",
                             text);
    }
    if (status == SL_OK)
        status = sl_vga_step_depth(context, &w->graph, from, plan->from.count, w->table.depths);
    sl_free(context, from);
    return status;
}

static sl_status measure_regions(sl_context *context, const vga_plan *plan, vga_work *w) {
    const sl_vga_grid *grid = &w->table.grid;
    const isovist_scene scene = {.outline = &w->outline, .range = plan->range};
    for (uint32_t p = 0; p < grid->count; p++)
        SL_TRY(eyes_add(context, &w->eyes, (eye_place){grid->points[p], 0, 360}));
    w->table.isovists = sl_alloc_array(context, grid->count, sizeof *w->table.isovists);
    if (!w->table.isovists) return SL_NO_MEMORY;
    return isovist_run(context, &scene, &w->eyes, plan->options.threads, w->table.isovists);
}

static sl_status measure(sl_context *context, vga_plan *plan, vga_work *w) {
    vga_table *table = &w->table;
    const sl_vga_grid *grid = &table->grid;
    table->parts = plan->parts;
    const unsigned of_graph = plan->parts & ~(unsigned)VGA_PART_ISOVIST;
    table->measures = sl_alloc_array(context, grid->count, sizeof *table->measures);
    if (!table->measures) return SL_NO_MEMORY;
    if (of_graph) {
        SL_TRY(check_memory(context, plan, grid->count));
        SL_TRY(sl_vga_graph_make(context, &w->outline, grid, plan->range, plan->options.threads,
                                 &w->graph));
    }
    plan->options.parts = (of_graph & VGA_PART_VISUAL ? SL_VGA_LOCAL | SL_VGA_GLOBAL : 0u) |
                          (of_graph & VGA_PART_THROUGH ? SL_VGA_THROUGH : 0u) |
                          (of_graph & VGA_PART_METRIC ? SL_VGA_METRIC : 0u) |
                          (of_graph & VGA_PART_ANGULAR ? SL_VGA_ANGULAR : 0u);
    if (plan->from.count) SL_TRY(find_depths(context, plan, w));
    if (plan->options.parts)
        SL_TRY(
            sl_vga_measure(context, &w->outline, grid, &w->graph, &plan->options, table->measures));
    return plan->parts & VGA_PART_ISOVIST ? measure_regions(context, plan, w) : SL_OK;
}

/// Fields go row by row from the lowest, grids column by column. A point is the middle of a square.
static sl_status draw(sl_context *context, const vga_plan *plan, const vga_work *w) {
    const sl_vga_grid *grid = &w->table.grid;
    const size_t count = (size_t)grid->columns * grid->rows;
    const name_table measures = vga_measures();
    double *values = sl_alloc_array(context, count, sizeof *values);
    if (!values) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) values[i] = NAN;
    for (uint32_t p = 0; p < grid->count; p++) {
        const size_t column = grid->squares[p] / grid->rows, row = grid->squares[p] % grid->rows;
        values[row * grid->columns + column] = vga_value(&w->table, plan->measure, p);
    }
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
                      .values = values,
                      .least = plan->scale.x,
                      .most = plan->scale.y};
    const sl_status status = heat_map_draw(context, &w->baked, &heat, &field);
    sl_free(context, values);
    return status;
}

static sl_status work(command_console *console, vga_plan *plan, vga_work *w) {
    sl_context *context = console->context;
    SL_TRY(pipeline_read_space(context, &plan->pipeline, "vga", SL_EFFECT_RANGE | SL_EFFECT_DOOR,
                               "its graph joins points both ways, by straight lines", &w->baked));
    if (!input_ends_with(plan->input, ".slv"))
        SL_TRY(pipeline_note_inside(context, &plan->pipeline, &w->baked.map, &w->baked.space));
    SL_TRY(doors_shut(context, &plan->doors, &w->baked));
    if (!plan->range_given) plan->range = w->baked.map.range;
    SL_TRY(sl_outline_make(context, &w->baked.space, &w->outline));
    SL_TRY(check_area(context, plan, &w->baked.space));
    SL_TRY(fill_grid(context, plan, w));
    SL_TRY(measure(context, plan, w));
    if (plan->picture) SL_TRY(draw(context, plan, w));
    progress_line_clear(&console->line);
    const bool to_stdout = plan->output ? strcmp(plan->output, "-") == 0 : !plan->picture;
    if (plan->output || !plan->picture)
        SL_TRY(vga_write(context, &w->table, plan->output ? plan->output : "-"));
    if (!to_stdout && !console->quiet) vga_print_summary(&w->table, plan->measure);
    return SL_OK;
}

static void print_tables(void) {
    const name_table measures = vga_measures();
    fputs("\nmeasures, for --measure, and their groups, for --measures:\n", stdout);
    for (unsigned bit = 0; 1u << bit <= VGA_PART_STEPS; bit++) {
        const name_table parts = vga_parts();
        if (1u << bit == VGA_PART_ALL) continue;
        printf("  %s:\n", 1u << bit == VGA_PART_STEPS ? "with --from" : name_table_at(&parts, bit));
        for (size_t k = 0; k < measures.count; k++)
            if (vga_measure_part(k) == 1u << bit) printf("    %s\n", name_table_at(&measures, k));
    }
}

sl_status cmd_vga(command_console *console, int argc, char **argv) {
    vga_plan plan = {.pipeline = pipeline_default(),
                     .options = sl_vga_options_default(),
                     .drawing = sl_draw_options_default()};
    option_table pipeline = pipeline_option_table(&plan.pipeline);
    const option_table picture = picture_option_table(&plan.drawing, true);
    const option_table doors = door_option_table(&plan.doors);
    const option_spec options[] = {
        {"grid", 0, "STEP", "distance between neighbouring points", .number = &plan.step,
         .over_0 = true, .given = &plan.step_given},
        {"at", 0, "X,Y",
         "fill the grid from here through doors that are open (default: all that is inside); may "
         "be "
         "given several times",
         .list = &plan.at},
        {"output", 'o', "TABLE",
         "where the table goes: .csv, or .geojson for a GIS (default: stdout, or nowhere if there "
         "is a --picture)",
         .text = &plan.output, .check = CHECK_FILE, .endings = ".csv .txt .geojson"},
        {"picture", 0, "PICTURE", "draw a heat map: .png, .svg or .pdf", .text = &plan.picture,
         .check = CHECK_PICTURE},
        {"measure", 0, "NAME",
         "what the picture shows and the summary ranks (default: visual_integration_hh)",
         .choice = &plan.measure, .names = vga_measures(), .given = &plan.measure_given},
        {"measures", 0, "GROUP,...",
         "what to compute: visual (default), through, metric, angular, isovist, all",
         .choices = &plan.parts, .names = vga_parts(), .given = &plan.parts_given},
        {.group = &doors},
        {"from", 0, "X,Y",
         "add the column visual_step_depth: steps from here; may be given several times",
         .list = &plan.from, .rare = true},
        {"range", 0, "R", "nothing farther is seen (default: the map's range, if any)",
         .number = &plan.range, .over_0 = true, .given = &plan.range_given},
        {"scale", 0, "MIN,MAX",
         "ends of the colour scale, to compare pictures (default: lowest and highest value)",
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
        {.group = &picture},
        {.group = &pipeline},
    };
    const command_usage usage = {
        .name = "vga",
        .synopsis = "MAP|FILE.slv --grid STEP [options]",
        .operands = {"MAP|FILE.slv"},
        .what = "Computes visibility graph analysis (space syntax). The graph joins the points of "
                "a grid that see each other. Writes a table under the names that depthmapX gives "
                "the measures.",
        .tables = print_tables,
        .examples = "  sightline vga office.map --grid 1 -o office.csv --picture office.png\n"
                    "  sightline vga office.map --grid 1 --measure visual_control --picture "
                    "a.png",
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, &plan.input, &helped));
    if (helped) return SL_OK;
    SL_TRY(make_plan(console->context, &plan));
    vga_work w = {0};
    const sl_status status = work(console, &plan, &w);
    sl_free(console->context, w.table.measures);
    sl_free(console->context, w.table.isovists);
    sl_free(console->context, w.table.depths);
    sl_vga_grid_destroy(console->context, &w.table.grid);
    sl_vga_graph_destroy(console->context, &w.graph);
    eyes_destroy(console->context, &w.eyes);
    sl_outline_destroy(console->context, &w.outline);
    sl_baked_destroy(console->context, &w.baked);
    return status;
}

/// `sightline vga`: visibility graph analysis of a grid of points, as tables and heat maps.
#include "arguments/help.h"
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "inputs/pipeline.h"
#include "reports/heat_map.h"
#include "sightline/query.h"
#include "sightline/support.h"
#include "studies/building_vga.h"
#include "studies/vga_change.h"
#include "studies/vga_field.h"
#include "system/built.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

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

/// An estimate is of mean depths by sight: none of this goes with it.
static sl_status check_estimate(sl_context *context, vga_plan *p) {
    if (p->seed_given && !p->agents_given && !p->estimate_given)
        return sl_fail(context, SL_BAD_ARGUMENT, "--seed is for --agents N or --estimate N");
    p->estimate.seed = p->agents.seed;
    if (!p->estimate_given) return SL_OK;
    const char *other = p->compare                    ? "--compare"
                        : p->points.links             ? "--links"
                        : p->visual_given             ? "--radius"
                        : p->turned                   ? "--seen-from"
                        : input_is_building(p->input) ? "a building"
                                                      : NULL;
    if (other)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--estimate does not go with %s: leave --estimate out for exact values",
                       other);
    if (!(p->parts & VGA_PART_VISUAL) ||
        p->parts & (VGA_PART_THROUGH | VGA_PART_METRIC | VGA_PART_ANGULAR))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--estimate is for the visual measures; --measures visual alone, or with "
                       "isovist");
    if (vga_is_estimated(p->measure)) return SL_OK;
    const name_table measures = measure_table(SL_VGA);
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "--measure %s is not estimated: leave --estimate out for exact values",
                   name_table_at(&measures, p->measure));
}

static sl_status check_global(sl_context *context, const vga_plan *p) {
    if (!p->global_only) return SL_OK;
    const name_table measures = measure_table(SL_VGA);
    if (!(p->parts & VGA_PART_VISUAL))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--global is for the visual measures; add them to --measures");
    if (input_is_building(p->input))
        return sl_fail(context, SL_BAD_ARGUMENT, "--global does not go with a building");
    if (vga_is_global(p->measure)) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT, "--measure %s is local: leave --global out",
                   name_table_at(&measures, p->measure));
}

/// The rows of a part are measures of its points, by the whole graph.
static sl_status check_shard(sl_context *context, const vga_plan *p) {
    const char *other = !p->part.text                 ? NULL
                        : p->estimate_given           ? "--estimate"
                        : p->picture                  ? "--picture"
                        : p->pairs                    ? "--pairs"
                        : p->compare                  ? "--compare"
                        : p->points.links             ? "--links"
                        : p->agents_given             ? "--agents"
                        : p->parts & VGA_PART_THROUGH ? "--measures through"
                        : input_is_building(p->input) ? "a building"
                                                      : NULL;
    if (!other) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT, "--shard does not go with %s", other);
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
    SL_TRY(check_estimate(context, p));
    SL_TRY(check_global(context, p));
    SL_TRY(check_shard(context, p));
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
    if (input_is_building(p->input)) return SL_OK; // each storey has a plan of its own
    if (p->storey)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--storey %s: is for a building, a file that "
                       "ends in " BUILDING_ENDING,
                       p->storey);
    return pipeline_plan(context, p->input, &p->pipeline);
}

// --- the files

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

static sl_status draw(sl_context *context, const vga_plan *plan, const vga_work *w) {
    const name_table measures = measure_table(SL_VGA);
    const heat_map heat = {.input = plan->input,
                           .map = plan->pipeline.input.import.map,
                           .measure = name_table_at(&measures, plan->measure),
                           .drawing = &plan->drawing,
                           .path = plan->picture};
    vga_field field;
    SL_TRY(
        vga_field_make(context, w, plan->measure, plan->scale_given ? &plan->scale : NULL, &field));
    if (field.field.grey)
        sl_note(context,
                "the colours are those of the largest part; the other%s grey (--scale "
                "MIN,MAX colours all)",
                w->table.part_count > 2 ? "s are" : " is");
    const sl_status status = heat_map_draw(context, &w->baked, &heat, &field.field);
    vga_field_destroy(context, &field);
    return status;
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
    sl_status status = vga_change_field(context, change, plan->measure, &values, &field);
    field.least = plan->scale.x;
    field.most = plan->scale.y;
    if (status == SL_OK) status = heat_map_draw(context, &w->baked, &heat, &field);
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
    if (status == SL_OK) status = vga_compute(context, &other_plan, &other);
    if (status == SL_OK) status = vga_change_make(context, &w->table, &other.table, &change);
    if (status == SL_OK && plan->pairs) status = write_pairs(context, plan, w);
    if (status == SL_OK && plan->picture) status = draw_change(context, plan, w, &change);
    progress_line_clear(&console->line);
    if (status == SL_OK && path) status = vga_change_write(context, &change, path);
    if (status == SL_OK && !console->quiet && (!path || strcmp(path, "-") != 0))
        vga_change_print(&change, plan->measure);
    vga_change_destroy(context, &change);
    vga_work_destroy(context, &other);
    return status;
}

static sl_status show(command_console *console, const vga_plan *plan, const vga_table *table) {
    const char *path = table_path(plan);
    progress_line_clear(&console->line);
    if (path) SL_TRY(vga_write(console->context, table, &plan->part, path));
    if (!console->quiet && !plan->part.count && (!path || strcmp(path, "-") != 0))
        vga_print_summary(table, plan->measure);
    return SL_OK;
}

static sl_status work(command_console *console, vga_plan *plan, vga_work *w) {
    sl_context *context = console->context;
    SL_TRY(vga_compute(context, plan, w));
    if (plan->compare) return compare(console, plan, w);
    if (plan->pairs) SL_TRY(write_pairs(context, plan, w));
    if (plan->picture) SL_TRY(draw(context, plan, w));
    return show(console, plan, &w->table);
}

static sl_status work_building(command_console *console, vga_plan *plan, building_vga *b) {
    const vga_work *storey;
    SL_TRY(building_vga_compute(console->context, plan, b));
    SL_TRY(building_vga_storey(console->context, b, plan->storey, &storey));
    if (plan->picture) SL_TRY(draw(console->context, plan, storey));
    return show(console, plan, &b->all.table);
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
    vga_plan plan = {.command = "vga",
                     .pipeline = pipeline_default(),
                     .options = sl_vga_options_default(),
                     .agents = sl_vga_agents_default(),
                     .estimate = sl_vga_estimate_default(),
                     .drawing = built_draw_options()};
    option_table pipeline = pipeline_option_table(&plan.pipeline);
    const option_table picture = picture_option_table(&plan.drawing, "picture", true);
    const option_table doors = door_option_table(&plan.doors);
    const option_table points = vga_grid_option_table(&plan.points);
    const option_spec options[] = {
        {"grid", 0, "STEP", "distance between neighbouring points, which lie at multiples of it",
         .number = &plan.points.step, .over_0 = true, .given = &plan.step_given},
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
        {"storey", 0, "NAME", "of a building: which storey the picture shows (default: the first)",
         .text = &plan.storey, .without = "picture", .rare = true},
        {"pairs", 0, "FILE.csv", "write the pairs of points that see each other",
         .text = &plan.pairs, .check = CHECK_TABLE, .rare = true},
        {"seen-from", 0, NULL, "with one-way glass: who sees a point (default: what a point sees)",
         .flag = &plan.turned, .rare = true},
        {"range", 0, "R", "see no farther than R (default: the map's range)", .number = &plan.range,
         .over_0 = true, .given = &plan.range_given},
        {"scale", 0, "MIN,MAX",
         "the ends of the colour scale, to compare pictures (default: smallest and largest value "
         "in parts of the plan with at least a tenth of the points of the largest part)",
         .point = &plan.scale, .given = &plan.scale_given, .rare = true},
        {"threads", 0, "N", "number of threads (default: one per core)",
         .count32 = &plan.options.threads, .most = 1024},
        {"radius", 0, "N", "visual: only points within N steps (default: all)",
         .count32 = &plan.options.radius, .least = 1, .most = UINT32_MAX, .topic = "limits",
         .given = &plan.visual_given, .rare = true},
        {"global", 0, NULL,
         "visual: only measures of the whole graph, and connectivity; local ones (clustering, "
         "control, controllability, moments) take most of the time of large graphs",
         .flag = &plan.global_only, .topic = "limits", .rare = true},
        {"shard", 0, "K/N", "compute part K of N of the table (1 <= K <= N), for 'sightline merge'",
         .text = &plan.part.text, .topic = "limits", .rare = true},
        {"estimate", 0, "N",
         "visual: estimate mean depth and integration by searches from N points of each part of "
         "the graph, drawn by --seed; two more columns have the ends between which the exact depth "
         "of a point lies with a probability of 99 %",
         .count32 = &plan.estimate.roots, .least = 1, .most = SL_VGA_POINTS_MOST, .topic = "limits",
         .given = &plan.estimate_given, .rare = true},
        {"metric-radius", 0, "R", "metric: only paths up to this length (default: all)",
         .number = &plan.options.metric_radius, .over_0 = true, .topic = "limits",
         .given = &plan.metric_given, .rare = true},
        {"angular-radius", 0, "A",
         "angular: only paths that turn up to A right angles (default: all)",
         .number = &plan.options.angular_radius, .over_0 = true, .topic = "limits",
         .given = &plan.angular_given, .rare = true},
        {"agents", 0, "N",
         "let N agents walk by sight, and add the column gate_counts: steps onto a point (Turner "
         "and Penn 2002)",
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
        {"seed", 0, "N", "random seed of agents, and of --estimate (default 1)",
         .count = &plan.agents.seed, .topic = "agents", .given = &plan.seed_given, .rare = true},
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
                "defined at a point has no value there. A file of storeys (.storeys) is one "
                "building.",
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
    SL_TRY(table_part_plan(console->context, argc, argv, plan.output, &plan.part));
    vga_work w = {0};
    building_vga b = {0};
    const sl_status status = input_is_building(plan.input) ? work_building(console, &plan, &b)
                                                           : work(console, &plan, &w);
    vga_work_destroy(console->context, &w);
    building_vga_destroy(console->context, &b);
    return status;
}

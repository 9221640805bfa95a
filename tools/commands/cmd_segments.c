/// `sightline segments`: angular analysis of a network of drawn lines.
#include "arguments/help.h"
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "inputs/network.h"
#include "reports/line_table.h"
#include "sightline/axial.h"
#include "sightline/support.h"
#include "system/built.h"

#include <string.h>

typedef struct segments_plan {
    const char *input, *output, *picture, *weight, *unlinks;
    input_options reading;
    option_list metric, angular;
    size_t measure;
    unsigned threads;
    sl_draw_options drawing;
} segments_plan;

typedef struct segments_work {
    sl_map map;
    sl_segment *segments;
    sl_point *unlinks;
    uint32_t unlink_count;
    double *weights;
    sl_segment_measures *measures;
    line_table table;
} segments_work;

/// Cleaning cuts the lines where they cross and joins their ends.
static sl_status read_segments(sl_context *context, const segments_plan *plan, segments_work *w) {
    SL_TRY(lines_read(context, plan->input, &plan->reading, &w->map));
    for (size_t i = 0; i < w->map.wall_count; i++) w->map.walls[i].ground = 0;
    SL_TRY(input_clean(context, &plan->reading, &w->map, NULL));
    const size_t count = w->map.wall_count;
    if (count > INT32_MAX / 4) return sl_fail(context, SL_UNSUPPORTED, "too many lines");
    w->segments = sl_alloc_array(context, count + 1, sizeof *w->segments);
    w->measures = sl_alloc_array(context, count + 1, sizeof *w->measures);
    if (!w->segments || !w->measures) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++)
        w->segments[i] = (sl_segment){w->map.walls[i].a, w->map.walls[i].b};
    w->table.lines = w->segments;
    w->table.earth = w->map.earth;
    w->table.unit = w->map.unit;
    w->table.layer = "SEGMENTS";
    w->table.count = (uint32_t)count;
    if (plan->unlinks)
        SL_TRY(network_unlinks_read(context, plan->unlinks, w->segments, w->table.count,
                                    &w->unlinks, &w->unlink_count));
    return SL_OK;
}

/// "n" is the whole network.
static sl_status read_radius(sl_context *context, const char *option, const char *kind,
                             const char *text, double *radius, char ending[64]) {
    char number[SL_NUMBER_TEXT];
    *radius = 0;
    ending[0] = '\0';
    if (strcmp(text, "n") == 0) return SL_OK;
    SL_TRY(read_number(context, option, text, radius));
    if (!(*radius > 0))
        return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: a number over 0, or n, is needed", option,
                       text);
    sl_number_write(*radius, number);
    snprintf(ending, 64, "_r%s_%s", number, kind);
    return SL_OK;
}

static bool has_whole(const option_list *radii) {
    for (size_t i = 0; i < radii->count; i++)
        if (strcmp(radii->items[i], "n") == 0) return true;
    return false;
}

/// Two columns of one name would be no use.
static sl_status check_apart(sl_context *context, const char *option, const option_list *radii) {
    double one, other;
    char ending[64];
    for (size_t i = 0; i < radii->count; i++) {
        SL_TRY(read_radius(context, option, "", radii->items[i], &one, ending));
        for (size_t k = 0; k < i; k++) {
            SL_TRY(read_radius(context, option, "", radii->items[k], &other, ending));
            if (one == other)
                return sl_fail(context, SL_BAD_ARGUMENT, "%s %s is given twice", option,
                               radii->items[i]);
        }
    }
    return SL_OK;
}

/// From this many segments on, the whole network takes more than some seconds.
#define MANY 5000

/// The whole network is all pairs of segments.
static void note_pairs(sl_context *context, const segments_plan *plan, size_t count) {
    const bool whole = plan->metric.count + plan->angular.count == 0 || has_whole(&plan->metric) ||
                       has_whole(&plan->angular);
    if (whole && count >= MANY)
        sl_note(context,
                "%zu segments: the whole network is measured from each, so that the time grows "
                "with the square of their number; --metric-radius R measures what is within R, and "
                "takes much less",
                count);
}

/// `measures` hold the lengths.
static sl_status find_weights(sl_context *context, const segments_plan *plan, segments_work *w) {
    w->weights = sl_alloc_array(context, w->table.count, sizeof *w->weights);
    if (!w->weights) return SL_NO_MEMORY;
    if (strcmp(plan->weight, "segment_length") != 0)
        return network_weights_read(context, plan->input, plan->weight, &w->map, w->segments,
                                    w->weights);
    for (uint32_t i = 0; i < w->table.count; i++) w->weights[i] = w->measures[i].segment_length;
    return SL_OK;
}

/// Measures without weights, and then with them.
static sl_status measure(sl_context *context, const segments_plan *plan, segments_work *w,
                         sl_segment_options *options, const char *ending) {
    SL_TRY(sl_segment_measure(context, w->segments, w->table.count, options, w->measures));
    SL_TRY(
        line_table_add(context, &w->table, SL_SEGMENTS, w->measures, sizeof *w->measures, ending));
    if (!plan->weight) return SL_OK;
    if (!w->weights) SL_TRY(find_weights(context, plan, w));
    char weighted[80];
    snprintf(weighted, sizeof weighted, "%s_weighted", ending);
    options->weights = w->weights;
    SL_TRY(sl_segment_measure(context, w->segments, w->table.count, options, w->measures));
    return line_table_add(context, &w->table, SL_SEGMENTS, w->measures, sizeof *w->measures,
                          weighted);
}

/// One analysis for each radius.
static sl_status run(sl_context *context, const segments_plan *plan, segments_work *w) {
    const size_t metric = plan->metric.count, angular = plan->angular.count;
    const size_t count = metric + angular ? metric + angular : 1;
    for (size_t i = 0; i < count; i++) {
        sl_segment_options options = {
            .threads = plan->threads, .unlinks = w->unlinks, .unlink_count = w->unlink_count};
        char ending[64] = "";
        if (i < metric)
            SL_TRY(read_radius(context, "--metric-radius", "metric", plan->metric.items[i],
                               &options.metric_radius, ending));
        else if (i < metric + angular)
            SL_TRY(read_radius(context, "--angular-radius", "angular",
                               plan->angular.items[i - metric], &options.angular_radius, ending));
        SL_TRY(measure(context, plan, w, &options, ending));
    }
    return SL_OK;
}

static sl_status work(command_console *console, const segments_plan *plan, segments_work *w) {
    sl_context *context = console->context;
    SL_TRY(check_apart(context, "--metric-radius", &plan->metric));
    SL_TRY(check_apart(context, "--angular-radius", &plan->angular));
    if (has_whole(&plan->metric) && has_whole(&plan->angular))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--metric-radius n and --angular-radius n are one analysis: give one of "
                       "them");
    SL_TRY(read_segments(context, plan, w));
    note_pairs(context, plan, w->table.count);
    SL_TRY(run(context, plan, w));
    const line_column *column = line_table_column(&w->table, plan->measure);
    if (plan->picture)
        SL_TRY(line_table_draw(context, &w->table, column, NULL, plan->input,
                               plan->reading.import.map, &plan->drawing, plan->picture));
    progress_line_clear(&console->line);
    const char *path = plan->output ? plan->output : plan->picture ? NULL : "-";
    if (path) SL_TRY(line_table_write(context, &w->table, path));
    if (!console->quiet && (!path || strcmp(path, "-") != 0))
        line_table_print(&w->table, "segment", column);
    return SL_OK;
}

static void print_tables(void) {
    help_measures(SL_SEGMENTS);
}

sl_status cmd_segments(command_console *console, int argc, char **argv) {
    segments_plan plan = {.reading = input_options_default(),
                          .measure = sl_measure_find(SL_SEGMENTS, "t1024_choice"),
                          .drawing = built_draw_options()};
    const option_table reading = input_option_table(&plan.reading);
    const option_table picture = picture_option_table(&plan.drawing, "picture", true);
    const option_spec options[] = {
        {"output", 'o', "TABLE",
         "where the table goes: .csv, .geojson for a GIS, or .dxf for the lines alone (default: "
         "stdout, or nowhere if there "
         "is a --picture)",
         .text = &plan.output, .check = CHECK_FILE, .endings = ".csv .txt .geojson .dxf"},
        {"picture", 0, "PICTURE", "draw the network: .png, .svg or .pdf", .text = &plan.picture,
         .check = CHECK_PICTURE},
        {"measure", 0, "NAME",
         "what the picture shows and the summary ranks (default: t1024_choice)",
         .choice = &plan.measure, .names = measure_table(SL_SEGMENTS)},
        {"metric-radius", 0, "R",
         "only segments within R along the network, or n for all (default); may be given several "
         "times",
         .list = &plan.metric},
        {"angular-radius", 0, "A",
         "only segments within A right angles of turns, or n for all; may be given several times",
         .list = &plan.angular},
        {"weight", 0, "NAME",
         "also measure with weights, in columns that end with _weighted: segment_length, or a "
         "column of the .csv; pieces of a line share its weight by length",
         .text = &plan.weight},
        {"unlinks", 0, "POINTS",
         "crossings that are no junctions, as bridges: a .csv with the columns x,y",
         .text = &plan.unlinks},
        {"threads", 0, "N", "number of threads (default: one per core)", .count32 = &plan.threads,
         .most = 1024, .rare = true},
        {.group = &picture},
        {.group = &reading},
    };
    const command_usage usage = {
        .name = "segments",
        .synopsis = "MAP|FILE.slv [options]",
        .operands = {"MAP|FILE.slv"},
        .what = "Computes angular segment analysis (space syntax) of a network: street centre "
                "lines or axial lines, as a drawing, a map, GeoJSON, or a .csv with the columns "
                "x1,y1,x2,y2. Lines are cut where they cross.",
        .examples = "  sightline segments streets.dxf -o streets.csv --picture choice.png\n"
                    "  sightline segments axial.csv --metric-radius 400 --metric-radius n -o "
                    "all.csv\n"
                    "  sightline segments streets.csv --weight lanes --unlinks bridges.csv",
        .tables = print_tables,
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, &plan.input, &helped));
    if (helped) return SL_OK;
    segments_work w = {0};
    const sl_status status = work(console, &plan, &w);
    line_table_destroy(console->context, &w.table);
    sl_free(console->context, w.measures);
    sl_free(console->context, w.weights);
    sl_free(console->context, w.unlinks);
    sl_free(console->context, w.segments);
    sl_map_destroy(console->context, &w.map);
    return status;
}

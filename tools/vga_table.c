#include "vga_table.h"

#include "inputs.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <math.h>
#include <stddef.h>

typedef struct part {
    const char *name;
} part;

static const part parts[] = {{"visual"},  {"through"}, {"metric"},
                             {"angular"}, {"isovist"}, {"all"}};

name_table vga_parts(void) {
    return (name_table){"group of measures", parts, sizeof *parts, sizeof parts / sizeof *parts,
                        NULL};
}

typedef struct column {
    const char *name;
    unsigned part;
    size_t offset; ///< in sl_vga_measures, sl_region_measures or sl_vga_depths
} column;

#define OF_GRAPH(part, name)                                                                       \
    { #name, VGA_PART_##part, offsetof(sl_vga_measures, name) }
#define OF_REGION(name)                                                                            \
    { #name, VGA_PART_ISOVIST, offsetof(sl_region_measures, name) }
#define OF_STEPS(part, name)                                                                       \
    { #name, VGA_PART_##part, offsetof(sl_vga_depths, name) }
static const column columns[] = {
    OF_GRAPH(VISUAL, connectivity),
    OF_GRAPH(VISUAL, visual_mean_depth),
    OF_GRAPH(VISUAL, visual_node_count),
    OF_GRAPH(VISUAL, visual_integration_hh),
    OF_GRAPH(VISUAL, visual_integration_tekl),
    OF_GRAPH(VISUAL, visual_integration_pvalue),
    OF_GRAPH(VISUAL, visual_entropy),
    OF_GRAPH(VISUAL, visual_relativised_entropy),
    OF_GRAPH(VISUAL, visual_clustering_coefficient),
    OF_GRAPH(VISUAL, visual_control),
    OF_GRAPH(VISUAL, visual_controllability),
    OF_GRAPH(VISUAL, point_first_moment),
    OF_GRAPH(VISUAL, point_second_moment),
    OF_GRAPH(THROUGH, through_vision),
    OF_GRAPH(METRIC, metric_mean_shortest_path_distance),
    OF_GRAPH(METRIC, metric_mean_shortest_path_angle),
    OF_GRAPH(METRIC, metric_mean_straight_line_distance),
    OF_GRAPH(ANGULAR, angular_mean_depth),
    OF_GRAPH(ANGULAR, angular_total_depth),
    OF_REGION(area),
    OF_REGION(perimeter),
    OF_REGION(compactness),
    OF_REGION(occlusivity),
    OF_REGION(drift_magnitude),
    OF_REGION(drift_angle),
    OF_REGION(min_radial),
    OF_REGION(max_radial),
    OF_GRAPH(METRIC, metric_node_count),
    OF_GRAPH(ANGULAR, angular_node_count),
    OF_STEPS(STEPS, visual_step_depth),
    OF_STEPS(STEP_LENGTHS, metric_step_shortest_path_length),
    OF_STEPS(STEP_LENGTHS, metric_step_shortest_path_angle),
    OF_STEPS(STEP_LENGTHS, metric_straight_line_distance),
    OF_STEPS(STEP_TURNS, angular_step_depth),
    {"gate_counts", VGA_PART_AGENTS, 0},
};
enum { COLUMNS = sizeof columns / sizeof *columns, BEST = 10 };

name_table vga_measures(void) {
    return (name_table){"measure", columns, sizeof *columns, COLUMNS, NULL};
}

unsigned vga_measure_part(size_t measure) {
    return columns[measure].part;
}

double vga_value(const vga_table *table, size_t measure, uint32_t point) {
    const column *c = &columns[measure];
    const void *from = &table->measures[point];
    if (c->part == VGA_PART_AGENTS) return (double)table->gates[point];
    if (c->part >= VGA_PART_STEPS) from = &table->depths[point];
    if (c->part == VGA_PART_ISOVIST) from = &table->isovists[point].measures;
    return *(const double *)((const char *)from + c->offset);
}

// --- files

static void put(FILE *out, double value, const char *missing) {
    char text[SL_NUMBER_TEXT];
    if (isnan(value)) {
        fputs(missing, out);
        return;
    }
    sl_number_write(value, text);
    fputs(text, out);
}

static sl_status write_csv(sl_context *context, const vga_table *table, FILE *out) {
    fputs("x,y", out);
    for (size_t k = 0; k < COLUMNS; k++)
        if (table->parts & columns[k].part) fprintf(out, ",%s", columns[k].name);
    putc('\n', out);
    for (uint32_t p = 0; p < table->grid.count; p++) {
        if (p % 4096 == 0) SL_TRY(sl_check_cancelled(context));
        put(out, table->grid.points[p].x, "");
        putc(',', out);
        put(out, table->grid.points[p].y, "");
        for (size_t k = 0; k < COLUMNS; k++) {
            if (!(table->parts & columns[k].part)) continue;
            putc(',', out);
            put(out, vga_value(table, k, p), "");
        }
        putc('\n', out);
    }
    return SL_OK;
}

static sl_status write_geojson(sl_context *context, const vga_table *table, FILE *out) {
    fputs("{\"type\": \"FeatureCollection\", \"features\": [", out);
    for (uint32_t p = 0; p < table->grid.count; p++) {
        if (p % 4096 == 0) SL_TRY(sl_check_cancelled(context));
        fprintf(out, "%s\n{\"type\": \"Feature\", \"geometry\": {\"type\": \"Point\", ",
                p ? "," : "");
        fputs("\"coordinates\": [", out);
        put(out, table->grid.points[p].x, "");
        fputs(", ", out);
        put(out, table->grid.points[p].y, "");
        fputs("]}, \"properties\": {", out);
        const char *comma = "";
        for (size_t k = 0; k < COLUMNS; k++) {
            if (!(table->parts & columns[k].part)) continue;
            fprintf(out, "%s\"%s\": ", comma, columns[k].name);
            put(out, vga_value(table, k, p), "null");
            comma = ", ";
        }
        fputs("}}", out);
    }
    fputs("\n]}\n", out);
    return SL_OK;
}

sl_status vga_write(sl_context *context, const vga_table *table, const char *path) {
    const bool geojson = input_ends_with(path, ".geojson");
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    return sl_output_close(context, &output,
                           geojson ? write_geojson(context, table, output.stream)
                                   : write_csv(context, table, output.stream));
}

// --- the summary

static void print_mean(const vga_table *table, size_t measure) {
    double sum = 0, squares = 0, count = 0;
    for (uint32_t p = 0; p < table->grid.count; p++) {
        const double value = vga_value(table, measure, p);
        if (isnan(value)) continue;
        sum += value;
        count++;
    }
    if (count == 0) {
        printf("  %-36s %12s\n", columns[measure].name, "not defined");
        return;
    }
    const double mean = sum / count;
    for (uint32_t p = 0; p < table->grid.count; p++) {
        const double value = vga_value(table, measure, p);
        if (!isnan(value)) squares += (value - mean) * (value - mean);
    }
    printf("  %-36s %12.6g %12.6g\n", columns[measure].name, mean, sqrt(squares / count));
}

/// The points of the highest values, the first of equal ones.
static size_t find_best(const vga_table *table, size_t measure, uint32_t best[BEST]) {
    size_t count = 0;
    for (uint32_t p = 0; p < table->grid.count; p++) {
        const double value = vga_value(table, measure, p);
        size_t at = count;
        if (isnan(value)) continue;
        while (at && value > vga_value(table, measure, best[at - 1])) at--;
        if (at == BEST) continue;
        if (count < BEST) count++;
        for (size_t k = count - 1; k > at; k--) best[k] = best[k - 1];
        best[at] = p;
    }
    return count;
}

void vga_print_summary(const vga_table *table, size_t measure) {
    uint32_t best[BEST];
    const size_t count = find_best(table, measure, best);
    printf("%" PRIu32 " points\n  %-36s %12s %12s\n", table->grid.count, "measure", "mean",
           "deviation");
    for (size_t k = 0; k < COLUMNS; k++)
        if (table->parts & columns[k].part) print_mean(table, k);
    if (!count) return;
    printf("highest %s:\n  %12s %12s %12s\n", columns[measure].name, "x", "y", "value");
    for (size_t k = 0; k < count; k++)
        printf("  %12.6g %12.6g %12.6g\n", table->grid.points[best[k]].x,
               table->grid.points[best[k]].y, vga_value(table, measure, best[k]));
}

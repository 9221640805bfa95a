#include "vga_table.h"

#include "inputs.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <math.h>

/// Groups as they can be chosen, in the order of the bits.
static const sl_measure_group groups[] = {SL_GROUP_LOCAL, SL_GROUP_THROUGH, SL_GROUP_METRIC,
                                          SL_GROUP_ANGULAR, SL_GROUP_ISOVIST};
enum { GROUPS = sizeof groups / sizeof *groups, BEST = 10 };

static const char *part_name(size_t index) {
    return index < GROUPS ? sl_measure_group_name(groups[index]) : "all";
}

name_table vga_parts(void) {
    return (name_table){.kind = "group of measures", .count = GROUPS + 1, .at = part_name};
}

static const sl_measure *columns(size_t *count) {
    return sl_measures(SL_VGA, count);
}

unsigned vga_measure_part(size_t measure) {
    const sl_measure *m = &columns(&(size_t){0})[measure];
    if (m->of == SL_OF_AGENTS) return VGA_PART_AGENTS;
    unsigned part = VGA_PART_VISUAL; // of local and global ones
    for (size_t i = 0; i < GROUPS; i++)
        if (groups[i] == m->group) part = 1u << i;
    return m->of == SL_OF_DEPTH ? part * VGA_PART_STEPS : part;
}

double vga_value(const vga_table *table, size_t measure, uint32_t point) {
    const sl_measure *m = &columns(&(size_t){0})[measure];
    if (m->of == SL_OF_AGENTS) return (double)table->gates[point];
    if (m->of == SL_OF_DEPTH) return sl_measure_value(m, &table->depths[point]);
    if (m->of == SL_OF_REGION) return sl_measure_value(m, &table->isovists[point].measures);
    return sl_measure_value(m, &table->measures[point]);
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
    size_t count;
    const sl_measure *measures = columns(&count);
    fputs("x,y", out);
    for (size_t k = 0; k < count; k++)
        if (table->parts & vga_measure_part(k)) fprintf(out, ",%s", measures[k].name);
    putc('\n', out);
    for (uint32_t p = 0; p < table->grid.count; p++) {
        if (p % 4096 == 0) SL_TRY(sl_check_cancelled(context));
        put(out, table->grid.points[p].x, "");
        putc(',', out);
        put(out, table->grid.points[p].y, "");
        for (size_t k = 0; k < count; k++) {
            if (!(table->parts & vga_measure_part(k))) continue;
            putc(',', out);
            put(out, vga_value(table, k, p), "");
        }
        putc('\n', out);
    }
    return SL_OK;
}

static sl_status write_geojson(sl_context *context, const vga_table *table, FILE *out) {
    size_t count;
    const sl_measure *measures = columns(&count);
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
        for (size_t k = 0; k < count; k++) {
            if (!(table->parts & vga_measure_part(k))) continue;
            fprintf(out, "%s\"%s\": ", comma, measures[k].name);
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
    const char *name = columns(&(size_t){0})[measure].name;
    double sum = 0, squares = 0, count = 0;
    for (uint32_t p = 0; p < table->grid.count; p++) {
        const double value = vga_value(table, measure, p);
        if (isnan(value)) continue;
        sum += value;
        count++;
    }
    if (count == 0) {
        printf("  %-36s %12s\n", name, "not defined");
        return;
    }
    const double mean = sum / count;
    for (uint32_t p = 0; p < table->grid.count; p++) {
        const double value = vga_value(table, measure, p);
        if (!isnan(value)) squares += (value - mean) * (value - mean);
    }
    printf("  %-36s %12.6g %12.6g\n", name, mean, sqrt(squares / count));
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
    size_t columns_count;
    const char *name = columns(&columns_count)[measure].name;
    const size_t count = find_best(table, measure, best);
    printf("%" PRIu32 " points\n  %-36s %12s %12s\n", table->grid.count, "measure", "mean",
           "deviation");
    for (size_t k = 0; k < columns_count; k++)
        if (table->parts & vga_measure_part(k)) print_mean(table, k);
    if (!count) return;
    printf("highest %s:\n  %12s %12s %12s\n", name, "x", "y", "value");
    for (size_t k = 0; k < count; k++)
        printf("  %12.6g %12.6g %12.6g\n", table->grid.points[best[k]].x,
               table->grid.points[best[k]].y, vga_value(table, measure, best[k]));
}

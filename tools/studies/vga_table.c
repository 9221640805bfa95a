/// The columns of the table follow the parts that are asked for.
#include "studies/vga_table.h"

#include "inputs/inputs.h"
#include "reports/fields.h"
#include "reports/summary.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

/// Groups as they can be chosen, in the order of the bits.
static const sl_measure_group groups[] = {SL_GROUP_LOCAL, SL_GROUP_THROUGH, SL_GROUP_METRIC,
                                          SL_GROUP_ANGULAR, SL_GROUP_ISOVIST};
enum { GROUPS = sizeof groups / sizeof *groups };

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

bool vga_measure_is_of_part(size_t measure) {
    return vga_measure_part(measure) < VGA_PART_ISOVIST;
}

bool vga_is_global(size_t measure) {
    const sl_measure *m = &columns(&(size_t){0})[measure];
    return vga_measure_part(measure) != VGA_PART_VISUAL || m->group == SL_GROUP_GLOBAL ||
           strcmp(m->name, "connectivity") == 0;
}

bool vga_is_estimated(size_t measure) {
    const sl_measure *m = &columns(&(size_t){0})[measure];
    return vga_measure_part(measure) != VGA_PART_VISUAL || sl_vga_is_estimated(m);
}

bool vga_has(const vga_table *table, size_t measure) {
    return table->parts & vga_measure_part(measure) &&
           (!table->estimated || vga_is_estimated(measure)) &&
           (!table->global_only || vga_is_global(measure));
}

double vga_value(const vga_table *table, size_t measure, uint32_t point) {
    const sl_measure *m = &columns(&(size_t){0})[measure];
    if (m->of == SL_OF_AGENTS) return (double)table->gates[point];
    if (m->of == SL_OF_DEPTH) return sl_measure_value(m, &table->depths[point]);
    if (m->of == SL_OF_REGION) return sl_measure_value(m, &table->isovists[point].measures);
    return sl_measure_value(m, &table->measures[point]);
}

// --- files

/// The point, and then its measures.
static size_t list_fields(const void *of, size_t point, table_field fields[FIELDS_MOST]) {
    const vga_table *table = of;
    size_t measure_count, count = 0;
    const sl_measure *measures = columns(&measure_count);
    fields[count++] = field_real("x", table->grid.points[point].x);
    fields[count++] = field_real("y", table->grid.points[point].y);
    for (size_t k = 0; k < measure_count; k++)
        if (vga_has(table, k))
            fields[count++] = field_real(measures[k].name, vga_value(table, k, (uint32_t)point));
    if (table->estimated) {
        fields[count++] = field_real("visual_mean_depth_least", table->estimated[point].least);
        fields[count++] = field_real("visual_mean_depth_most", table->estimated[point].most);
    }
    if (table->part_count > 1) fields[count++] = field_real("part", table->part[point] + 1.0);
    if (table->storeys) fields[count++] = field_text("storey", table->storeys[point]);
    return count;
}

static sl_status write_geojson(sl_context *context, const vga_table *table, FILE *out) {
    table_field fields[FIELDS_MOST];
    const bool known = table->earth.known;
    fputs("{\"type\": \"FeatureCollection\", ", out);
    sl_geojson_put_crs(out, &table->earth);
    fputs("\"features\": [", out);
    for (uint32_t p = 0; p < table->grid.count; p++) {
        if (p % 4096 == 0) SL_TRY(sl_check_cancelled(context));
        fprintf(out, "%s\n{\"type\": \"Feature\", \"geometry\": {\"type\": \"Point\", ",
                p ? "," : "");
        fputs("\"coordinates\": [", out);
        sl_point at = table->grid.points[p];
        if (known) at = sl_earth_of_map(&table->earth, at);
        csv_put(out, at.x, ", ");
        csv_put(out, at.y, "");
        fputs("]}, \"properties\": {", out);
        const size_t count = list_fields(table, p, fields);
        for (size_t k = 2; k < count; k++) {
            fprintf(out, "%s\"%s\": ", k > 2 ? ", " : "", fields[k].key);
            if (fields[k].kind == FIELD_TEXT) // a name without quotes (storeys.h)
                fprintf(out, "\"%s\"", fields[k].text);
            else
                csv_put(out, fields[k].real, fields[k].kind == FIELD_NONE ? "null" : "");
        }
        fputs("}}", out);
    }
    fputs("\n]}\n", out);
    return SL_OK;
}

sl_status vga_write(sl_context *context, const vga_table *table, const table_part *part,
                    const char *path) {
    const field_rows rows = {list_fields, table, table->grid.count};
    if (!name_ends_with(path, ".geojson")) return table_part_write(context, part, &rows, path);
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    return sl_output_close(context, &output, write_geojson(context, table, output.stream));
}

// --- the summary

typedef struct table_measure {
    const vga_table *table;
    size_t measure;
    uint32_t part;
} table_measure;

/// The value of a point of that part.
static double value_at(const void *of, size_t index) {
    const table_measure *m = of;
    if (m->table->part_count > 1 && m->table->part[index] != m->part &&
        vga_measure_is_of_part(m->measure))
        return NAN;
    return vga_value(m->table, m->measure, (uint32_t)index);
}

uint32_t vga_part_size(const vga_table *table, uint32_t part) {
    uint32_t size = 0;
    for (uint32_t p = 0; p < table->grid.count; p++) size += table->part[p] == part;
    return size;
}

/// Each part but the largest in a line, as far as they are many.
static void print_others(const vga_table *table, size_t measure, const char *name) {
    enum { LISTED = 10 };
    table_measure of = {table, measure, 1};
    const summary_values values = {value_at, &of, table->grid.count};
    printf("other parts:\n  %4s %8s %12s %12s   mean %s\n", "part", "points", "x", "y", name);
    for (; of.part < table->part_count && of.part <= LISTED; of.part++) {
        uint32_t first = 0;
        double mean, deviation;
        while (table->part[first] != of.part) first++;
        const sl_point at = table->grid.points[first];
        printf("  %4" PRIu32 " %8" PRIu32 " %12.10g %12.10g", of.part + 1,
               vga_part_size(table, of.part), at.x, at.y);
        if (summary_mean(&values, &mean, &deviation))
            printf("   %.6g\n", mean);
        else
            printf("   not defined\n");
    }
    if (table->part_count > LISTED + 1)
        printf("  and %" PRIu32 " more\n", table->part_count - LISTED - 1);
}

void vga_print_summary(const vga_table *table, size_t measure) {
    size_t best[SUMMARY_BEST], columns_count;
    const sl_measure *measures = columns(&columns_count);
    table_measure of = {table, measure, 0};
    const summary_values values = {value_at, &of, table->grid.count};
    const size_t count = summary_best(&values, best);
    printf("%" PRIu32 " points", table->grid.count);
    if (table->part_count > 1)
        printf(" in %" PRIu32
               " parts that no sightline joins; the graph's figures are those of the "
               "largest, %" PRIu32 " points",
               table->part_count, vga_part_size(table, 0));
    printf("\n  %-36s %12s %12s\n", "measure", "mean", "deviation");
    for (of.measure = 0; of.measure < columns_count; of.measure++)
        if (vga_has(table, of.measure)) summary_print_mean(measures[of.measure].name, &values);
    of.measure = measure;
    if (count) printf("highest %s:\n  %12s %12s %12s\n", measures[measure].name, "x", "y", "value");
    for (size_t k = 0; k < count; k++)
        printf("  %12.10g %12.10g %12.6g\n", table->grid.points[best[k]].x,
               table->grid.points[best[k]].y, vga_value(table, measure, (uint32_t)best[k]));
    if (table->part_count > 1 && vga_measure_is_of_part(measure))
        print_others(table, measure, measures[measure].name);
}

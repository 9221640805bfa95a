/// Tables of lines, written and drawn; and lines out of drawings and tables.
#include "reports/line_table.h"

#include "inputs/number_table.h"
#include "reports/fields.h"
#include "reports/heat_map.h"
#include "reports/summary.h"
#include "sightline/json.h"
#include "sightline/support.h"
#include "system/built.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

void line_table_destroy(sl_context *context, line_table *table) {
    for (size_t i = 0; i < table->columns.count; i++)
        sl_free(context, table->columns.items[i].values);
    sl_free(context, table->columns.items);
    *table = (line_table){0};
}

sl_status line_table_add(sl_context *context, line_table *table, sl_analysis analysis,
                         const void *values, size_t size, const char *radius) {
    size_t count;
    const sl_measure *measures = sl_measures(analysis, &count);
    const bool first = table->columns.count == 0;
    SL_TRY(SL_ARRAY_ROOM(context, &table->columns, count));
    for (size_t k = 0; k < count; k++) {
        const bool has_radius = measures[k].group == SL_GROUP_NETWORK;
        if (!first && !has_radius) continue;
        line_column column = {.measure = k};
        snprintf(column.name, sizeof column.name, "%s%s", measures[k].name,
                 has_radius ? radius : "");
        column.values = sl_alloc_array(context, (size_t)table->count + 1, sizeof *column.values);
        if (!column.values) return SL_NO_MEMORY;
        for (uint32_t i = 0; i < table->count; i++)
            column.values[i] = sl_measure_value(&measures[k], (const char *)values + i * size);
        table->columns.items[table->columns.count++] = column;
    }
    return SL_OK;
}

const line_column *line_table_column(const line_table *table, size_t measure) {
    size_t k = 0;
    while (table->columns.items[k].measure != measure) k++;
    return &table->columns.items[k];
}

// --- files

static sl_status write_csv(sl_context *context, const line_table *t, FILE *out) {
    fputs("x1,y1,x2,y2", out);
    for (size_t k = 0; k < t->columns.count; k++) fprintf(out, ",%s", t->columns.items[k].name);
    putc('\n', out);
    for (uint32_t i = 0; i < t->count; i++) {
        if (i % 4096 == 0) SL_TRY(sl_check_cancelled(context));
        csv_put(out, t->lines[i].a.x, ",");
        csv_put(out, t->lines[i].a.y, ",");
        csv_put(out, t->lines[i].b.x, ",");
        csv_put(out, t->lines[i].b.y, "");
        for (size_t k = 0; k < t->columns.count; k++) {
            putc(',', out);
            csv_put(out, t->columns.items[k].values[i], "");
        }
        putc('\n', out);
    }
    return SL_OK;
}

static sl_status write_geojson(sl_context *context, const line_table *t, FILE *file) {
    sl_geojson_writer out = sl_geojson_begin(file, &t->earth);
    for (uint32_t i = 0; i < t->count; i++) {
        if (i % 4096 == 0) SL_TRY(sl_check_cancelled(context));
        sl_geojson_put_line(&out, "line", t->lines[i].a, t->lines[i].b);
        for (size_t k = 0; k < t->columns.count; k++) {
            const line_column *c = &t->columns.items[k];
            sl_geojson_add_real(&out, c->name, c->values[i]);
        }
        sl_geojson_end_feature(&out);
    }
    sl_geojson_end(&out);
    return SL_OK;
}

/// Lines alone: a drawing has no place for measures.
static sl_status write_dxf(sl_context *context, const line_table *t, const char *path) {
    const built_io *io;
    SL_TRY(built_need_io(context, path, &io));
    sl_polyline *lines = sl_alloc_array(context, t->count, sizeof *lines);
    if (!lines) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < t->count; i++)
        lines[i] = (sl_polyline){.layer = t->layer, .points = &t->lines[i].a, .count = 2};
    const sl_status status = io->polylines_dxf(context, lines, t->count, t->unit, path);
    sl_free(context, lines);
    return status;
}

sl_status line_table_write(sl_context *context, const line_table *table, const char *path) {
    if (name_ends_with(path, ".dxf")) return write_dxf(context, table, path);
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    return sl_output_close(context, &output,
                           name_ends_with(path, ".geojson")
                               ? write_geojson(context, table, output.stream)
                               : write_csv(context, table, output.stream));
}

// --- the summary

static double value_at(const void *of, size_t index) {
    const line_column *column = of;
    return column->values[index];
}

void line_table_print(const line_table *table, const char *what, const line_column *column) {
    size_t best[SUMMARY_BEST];
    const size_t count = summary_best(&(summary_values){value_at, column, table->count}, best);
    printf("%" PRIu32 " %s%s\n  %-36s %12s %12s\n", table->count, what,
           table->count == 1 ? "" : "s", "measure", "mean", "deviation");
    for (size_t k = 0; k < table->columns.count; k++) {
        const line_column *c = &table->columns.items[k];
        summary_print_mean(c->name, &(summary_values){value_at, c, table->count});
    }
    if (count)
        printf("highest %s:\n  %12s %12s %12s %12s %12s\n", column->name, "x1", "y1", "x2", "y2",
               "value");
    for (size_t k = 0; k < count; k++) {
        const sl_segment *s = &table->lines[best[k]];
        printf("  %12.10g %12.10g %12.10g %12.10g %12.6g\n", s->a.x, s->a.y, s->b.x, s->b.y,
               column->values[best[k]]);
    }
}

// --- the picture

/// A page without a plan: a space as large as the lines.
static sl_status make_page(sl_context *context, const line_table *table, sl_baked *baked) {
    sl_box b = {table->lines[0].a, table->lines[0].a};
    for (uint32_t i = 0; i < table->count; i++) {
        const sl_segment *s = &table->lines[i];
        b.min =
            (sl_point){fmin(b.min.x, fmin(s->a.x, s->b.x)), fmin(b.min.y, fmin(s->a.y, s->b.y))};
        b.max =
            (sl_point){fmax(b.max.x, fmax(s->a.x, s->b.x)), fmax(b.max.y, fmax(s->a.y, s->b.y))};
    }
    const double pad = fmax(b.max.x - b.min.x, b.max.y - b.min.y) * 0.02;
    const double x[2] = {b.min.x - pad, b.max.x + pad}, y[2] = {b.min.y - pad, b.max.y + pad};
    const sl_point corners[4] = {{x[0], y[0]}, {x[1], y[0]}, {x[1], y[1]}, {x[0], y[1]}};
    sl_map map = {0};
    sl_bake_options options = sl_bake_options_default();
    sl_bake_account account = {0};
    sl_status status = SL_OK;
    for (int i = 0; i < 4 && status == SL_OK; i++)
        status = sl_map_add_wall(context, &map, corners[i], corners[(i + 1) % 4], 0);
    if (status == SL_OK) status = sl_bake_space(context, &map, &options, baked, &account);
    sl_map_destroy(context, &map);
    return status;
}

sl_status line_table_draw(sl_context *context, const line_table *table, const line_column *column,
                          const sl_baked *baked, const char *input, const char *map,
                          const sl_draw_options *drawing, const char *path) {
    sl_baked page = {0};
    char measure[LINE_COLUMN_NAME], title[512];
    if (!table->count) return sl_fail(context, SL_BAD_ARGUMENT, "there is no line to draw");
    if (!baked) SL_TRY(make_page(context, table, &page));
    sl_draw_options options = *drawing;
    words_of(column->name, measure, sizeof measure);
    heat_map_title(input, map, measure, title, sizeof title);
    if (!options.title) options.title = title;
    const sl_drawn_lines lines = {.name = measure,
                                  .lines = table->lines,
                                  .values = column->values,
                                  .count = table->count,
                                  .alone = !baked};
    const sl_status status =
        built_pictures()->lines(context, baked ? baked : &page, &lines, &options, path);
    sl_baked_destroy(context, &page);
    return status;
}

// --- lines as they are drawn

static sl_status parse_table(sl_context *context, const char *path, const sl_bytes *text,
                             sl_map *map) {
    number_table table;
    SL_TRY(number_table_parse(context, path, text->data, text->size, &table));
    static const char *const names[4] = {"x1", "y1", "x2", "y2"};
    size_t columns[4];
    sl_status status = SL_OK;
    for (size_t k = 0; k < 4; k++)
        columns[k] = table.names ? number_table_column(&table, names[k]) : k;
    for (size_t k = 0; k < 4 && status == SL_OK; k++)
        if (columns[k] >= table.columns)
            status =
                sl_fail_at(context, path, table.first_line, "the columns x1,y1,x2,y2 are needed");
    for (size_t i = 0; i < table.rows && status == SL_OK; i++) {
        double v[4];
        bool usable = true;
        for (size_t k = 0; k < 4; k++) {
            v[k] = number_table_at(&table, i, columns[k]);
            usable &= fabs(v[k]) <= SL_COORDINATE_MAX;
        }
        if (usable)
            status = sl_map_add_wall(context, map, (sl_point){v[0], v[1]}, (sl_point){v[2], v[3]},
                                     table.lines[i]);
        else
            status =
                sl_fail_at(context, path, table.lines[i], "four numbers are needed: x1,y1,x2,y2");
    }
    number_table_destroy(context, &table);
    if (status != SL_OK) sl_map_destroy(context, map);
    return status;
}

bool lines_are_drawn(const char *path) {
    return name_ends_with(path, ".csv") || name_ends_with(path, ".geojson");
}

static sl_status parse_lines(sl_context *context, const char *path, const sl_bytes *bytes,
                             const input_options *input, sl_map *map) {
    const bool piped = strcmp(path, "-") == 0;
    if (name_ends_with(path, ".csv") || (piped && number_table_begins(bytes->data, bytes->size, 4)))
        return parse_table(context, path, bytes, map);
    input_options as_drawn = *input;
    as_drawn.import.lines = true;
    return input_parse_either(context, path, bytes, &as_drawn, map);
}

sl_status lines_read(sl_context *context, const char *path, const input_options *input,
                     sl_map *map) {
    sl_bytes bytes;
    SL_TRY(sl_file_read(context, path, &bytes));
    input_options own = *input;
    own.import.all_layers = true; // a network is no plan: streets and axes are its lines
    const sl_status status = parse_lines(context, path, &bytes, &own, map);
    sl_free(context, bytes.data);
    SL_TRY(status);
    SL_TRY(input_take_lines(context, map));
    size_t count = 0; // lines without length are none
    for (size_t i = 0; i < map->wall_count; i++)
        if (map->walls[i].a.x != map->walls[i].b.x || map->walls[i].a.y != map->walls[i].b.y)
            map->walls[count++] = map->walls[i];
    map->wall_count = count;
    if (count) return SL_OK;
    sl_map_destroy(context, map);
    return sl_fail(context, SL_BAD_INPUT, "%s: there is no line in it", path);
}

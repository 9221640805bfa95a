/// Rows of the tables find their segments by place, and by line of the file.
#include "inputs/network.h"

#include "arguments/names.h"
#include "arguments/options.h"
#include "inputs/number_table.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// --- unlinks

static sl_status find_crossings(sl_context *context, const number_table *table,
                                const sl_segment *segments, uint32_t count, sl_point *unlinks) {
    const size_t x = number_table_column(table, "x"), y = number_table_column(table, "y");
    if (x == table->columns || y == table->columns)
        return sl_fail_at(context, table->path, table->first_line, "the columns x,y are needed");
    for (size_t i = 0; i < table->rows; i++) {
        const sl_point at = {number_table_at(table, i, x), number_table_at(table, i, y)};
        if (isnan(at.x) || isnan(at.y))
            return sl_fail_at(context, table->path, table->lines[i], "a point needs x and y");
        if (sl_segment_crossing(context, segments, count, at, &unlinks[i]) != SL_OK) {
            char why[256];
            snprintf(why, sizeof why, "%s", sl_context_message(context));
            return sl_fail_at(context, table->path, table->lines[i], "%s", why);
        }
        for (size_t k = 0; k < i; k++)
            if (unlinks[k].x == unlinks[i].x && unlinks[k].y == unlinks[i].y)
                return sl_fail_at(context, table->path, table->lines[i],
                                  "line %u means the same crossing", table->lines[k]);
    }
    return SL_OK;
}

sl_status network_unlinks_read(sl_context *context, const char *path, const sl_segment *segments,
                               uint32_t count, sl_point **unlinks, uint32_t *unlink_count) {
    number_table table = {0};
    SL_TRY(number_table_read(context, path, &table));
    *unlinks = sl_alloc_array(context, table.rows, sizeof **unlinks);
    *unlink_count = (uint32_t)table.rows;
    const sl_status status =
        !*unlinks ? SL_NO_MEMORY
        : !table.names
            ? sl_fail_at(context, path, table.first_line, "a line of names with x,y is needed")
            : find_crossings(context, &table, segments, count, *unlinks);
    number_table_destroy(context, &table);
    return status;
}

// --- weights

/// The row of a line of the file. Every wall has one.
static size_t row_of(const number_table *table, uint32_t line) {
    size_t low = 0, high = table->rows - 1;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (table->lines[middle] < line)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static sl_status share_values(sl_context *context, const number_table *table, size_t column,
                              const sl_map *map, const sl_segment_measures *measures,
                              double *lengths, double *weights) {
    for (size_t i = 0; i < table->rows; i++)
        if (!(number_table_at(table, i, column) >= 0))
            return sl_fail_at(context, table->path, table->lines[i],
                              "the column \"%s\" needs a weight of 0 or more",
                              table->names[column]);
    for (size_t i = 0; i < map->wall_count; i++)
        lengths[row_of(table, map->walls[i].line)] += measures[i].segment_length;
    for (size_t i = 0; i < map->wall_count; i++) {
        const size_t row = row_of(table, map->walls[i].line);
        weights[i] =
            number_table_at(table, row, column) * (measures[i].segment_length / lengths[row]);
    }
    return SL_OK;
}

sl_status network_weights_read(sl_context *context, const char *path, const char *column,
                               const sl_map *map, const sl_segment_measures *measures,
                               double *weights) {
    if (strcmp(column, "segment_length") == 0) {
        for (size_t i = 0; i < map->wall_count; i++) weights[i] = measures[i].segment_length;
        return SL_OK;
    }
    if (!name_ends_with(path, ".csv"))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--weight %s: %s is no .csv file with columns; without one, only "
                       "segment_length can be a weight",
                       column, path);
    number_table table = {0};
    SL_TRY(number_table_read(context, path, &table));
    const size_t at = table.names ? number_table_column(&table, column) : table.columns;
    double *lengths = sl_alloc_array(context, table.rows, sizeof *lengths);
    const sl_status status =
        !lengths              ? SL_NO_MEMORY
        : at == table.columns ? sl_fail_at(context, path, table.first_line,
                                           "--weight: there is no column \"%s\"", column)
                              : share_values(context, &table, at, map, measures, lengths, weights);
    sl_free(context, lengths);
    number_table_destroy(context, &table);
    return status;
}

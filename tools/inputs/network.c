/// Rows of the tables find their segments by place, and by line of the file.
#include "inputs/network.h"

#include "arguments/names.h"
#include "arguments/options.h"
#include "inputs/number_table.h"

#include <math.h>
#include <stdio.h>

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
static uint32_t row_of(const number_table *table, uint32_t line) {
    uint32_t low = 0, high = (uint32_t)table->rows - 1;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (table->lines[middle] < line)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/// A line of no length, or one that lies on others, has no piece of its own: nothing has its
/// weight.
static void note_lost(sl_context *context, const number_table *table, const uint32_t *rows,
                      size_t pieces, double *values) {
    size_t lost = 0, first = 0;
    for (size_t i = 0; i < pieces; i++) values[rows[i]] = 0;
    for (size_t i = table->rows; i-- > 0;)
        if (values[i] > 0) lost++, first = i;
    if (lost)
        sl_note(
            context,
            "%s:%u: this line has no length, or lies on others, so its weight does not count%s; "
            "give a stretch that several lines share to one of them",
            table->path, (unsigned)table->lines[first],
            lost > 1 ? " (nor do those of further lines)" : "");
}

static sl_status share_values(sl_context *context, const number_table *table, size_t column,
                              const sl_map *map, const sl_segment *segments, uint32_t *rows,
                              double *values, double *weights) {
    for (size_t i = 0; i < table->rows; i++) {
        values[i] = number_table_at(table, i, column);
        if (!(values[i] >= 0))
            return sl_fail_at(context, table->path, table->lines[i],
                              "the column \"%s\" needs a weight of 0 or more",
                              table->names[column]);
    }
    for (size_t i = 0; i < map->wall_count; i++) rows[i] = row_of(table, map->walls[i].line);
    const sl_status status = sl_segment_share(context, segments, (uint32_t)map->wall_count, rows,
                                              values, (uint32_t)table->rows, weights);
    if (status == SL_OK) note_lost(context, table, rows, map->wall_count, values);
    return status;
}

sl_status network_weights_read(sl_context *context, const char *path, const char *column,
                               const sl_map *map, const sl_segment *segments, double *weights) {
    if (!name_ends_with(path, ".csv"))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--weight %s: %s is no .csv file with columns; without one, only "
                       "segment_length can be a weight",
                       column, path);
    number_table table = {0};
    SL_TRY(number_table_read(context, path, &table));
    const size_t at = table.names ? number_table_column(&table, column) : table.columns;
    uint32_t *rows = sl_alloc_array(context, map->wall_count, sizeof *rows);
    double *values = sl_alloc_array(context, table.rows, sizeof *values);
    const sl_status status =
        !rows || !values ? SL_NO_MEMORY
        : at == table.columns
            ? sl_fail_at(context, path, table.first_line, "--weight: there is no column \"%s\"",
                         column)
            : share_values(context, &table, at, map, segments, rows, values, weights);
    sl_free(context, rows);
    sl_free(context, values);
    number_table_destroy(context, &table);
    return status;
}

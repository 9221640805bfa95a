/// A path of the map by its name, or the rows of a table.
#include "inputs/path_points.h"

#include "arguments/names.h"
#include "arguments/options.h"
#include "inputs/number_table.h"

#include <math.h>
#include <string.h>

static sl_status take_table(sl_context *context, const number_table *table, sl_point **points,
                            size_t *count) {
    if (table->columns < 2 || !table->rows)
        return sl_fail(context, SL_BAD_INPUT, "%s: expected the columns x,y and a row for a point",
                       table->path);
    const size_t x = table->names ? number_table_column(table, "x") : 0;
    const size_t y = table->names ? number_table_column(table, "y") : 1;
    if (x == table->columns || y == table->columns)
        return sl_fail(context, SL_BAD_INPUT, "%s:%u: there is no column \"%s\"", table->path,
                       table->first_line, x == table->columns ? "x" : "y");
    *points = sl_alloc_array(context, table->rows, sizeof **points);
    if (!*points) return SL_NO_MEMORY;
    for (; *count < table->rows; ++*count) {
        const sl_point at = {number_table_at(table, *count, x), number_table_at(table, *count, y)};
        if (isnan(at.x) || isnan(at.y))
            return sl_fail(context, SL_BAD_INPUT, "%s:%u: a point needs x and y", table->path,
                           table->lines[*count]);
        (*points)[*count] = at;
    }
    return SL_OK;
}

sl_status path_points_read(sl_context *context, const char *option, const char *name,
                           const sl_map *map, sl_point **points, size_t *count) {
    *points = NULL;
    *count = 0;
    for (size_t i = 0; i < map->path_count; i++) {
        const sl_path *path = &map->paths[i];
        if (strcmp(path->name, name) != 0) continue;
        *points = sl_alloc_array(context, path->count, sizeof **points);
        if (!*points) return SL_NO_MEMORY;
        memcpy(*points, path->points, path->count * sizeof **points);
        *count = path->count;
        return SL_OK;
    }
    if (name_ends_with(name, ".csv") || strcmp(name, "-") == 0) {
        number_table table = {0};
        SL_TRY(number_table_read(context, name, &table));
        const sl_status status = take_table(context, &table, points, count);
        number_table_destroy(context, &table);
        return status;
    }
    const name_table paths = {"path", map->paths, sizeof *map->paths, map->path_count, NULL};
    char names[NAME_LIST];
    name_list(&paths, names);
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "--%s %s: the map has no path of that name; its paths: %s", option, name, names);
}

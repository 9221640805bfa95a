/// Points out of options and files, found in the grid; links as pairs of points.
#include "studies/vga_grid.h"

#include "inputs/number_table.h"

#include <math.h>

option_table vga_grid_option_table(vga_grid_plan *plan) {
    const option_table within = within_option_table(&plan->within, WITHIN_GRID);
    const option_spec options[] = {
        {"points", 0, "CSV", "only the grid points nearest to the points x,y of a table",
         .text = &plan->points, .is_input = true, .rare = true},
        {"boundary", 0, NULL, "only grid points at the border of the grid: a boundary graph",
         .flag = &plan->border, .rare = true},
        {"links", 0, "CSV",
         "link pairs of points, as stairs and lifts do: rows x1,y1,x2,y2. Linked points count as "
         "one place",
         .text = &plan->links, .is_input = true, .rare = true},
    };
    option_table table = {0};
    option_table_add(&table, options, sizeof options / sizeof *options);
    option_table_add(&table, within.items, within.count);
    option_table_topic(&table, "points");
    return table;
}

// --- a part of the grid

/// A table of places: one point a row, or two.
typedef struct place_table {
    number_table table;
    size_t columns[4]; ///< of x and y, or of x1, y1, x2, y2
} place_table;

/// The columns of these names: "Ref,x,y" is what depthmapX writes. Else all columns there are, or
/// the first ones of a table without names. Returns whether there are such columns.
static bool find_columns(place_table *places, const char *const *names, size_t needed) {
    const number_table *table = &places->table;
    bool named = true;
    for (size_t k = 0; k < needed; k++) {
        places->columns[k] = number_table_column(&places->table, names[k]);
        named &= places->columns[k] < places->table.columns;
    }
    for (size_t k = 0; k < needed && !named; k++) places->columns[k] = k;
    return named || table->columns == needed || (table->columns > needed && !table->names);
}

/// A table whose `needed` columns are numbers everywhere.
static sl_status read_places(sl_context *context, const char *path, size_t needed,
                             place_table *places) {
    static const char *const names[2][4] = {{"x", "y"}, {"x1", "y1", "x2", "y2"}};
    const char *what = needed == 2 ? "x,y" : "x1,y1,x2,y2";
    number_table *table = &places->table;
    SL_TRY(number_table_read(context, path, table));
    sl_status status = SL_OK;
    const bool found = find_columns(places, names[needed == 4], needed);
    if (!table->rows)
        status = sl_fail_at(context, path, 0, "rows of %s are needed", what);
    else if (!found)
        status =
            sl_fail_at(context, path, table->first_line,
                       table->names ? "the columns %s are needed" : "rows of %s are needed", what);
    for (size_t i = 0; i < table->rows && status == SL_OK; i++)
        for (size_t k = 0; k < needed && status == SL_OK; k++)
            if (isnan(number_table_at(table, i, places->columns[k])))
                status = sl_fail_at(context, path, table->lines[i], "%s are needed", what);
    if (status != SL_OK) number_table_destroy(context, table);
    return status;
}

/// The grid's point for the place number `which` of a row.
static sl_status find_place(sl_context *context, const sl_vga_grid *grid, const place_table *places,
                            size_t row, size_t which, uint32_t *point) {
    const number_table *table = &places->table;
    const sl_point at = {number_table_at(table, row, places->columns[2 * which]),
                         number_table_at(table, row, places->columns[2 * which + 1])};
    *point = sl_vga_grid_find(grid, at);
    if (*point != UINT32_MAX) return SL_OK;
    return sl_fail_at(context, table->path, table->lines[row],
                      "the grid has no point at %.9g,%.9g; its points are %.9g apart", at.x, at.y,
                      grid->step);
}

static sl_status mark_listed(sl_context *context, const char *path, const sl_vga_grid *grid,
                             sl_bits *kept) {
    place_table places;
    SL_TRY(read_places(context, path, 2, &places));
    sl_status status = SL_OK;
    for (size_t i = 0; i < places.table.rows && status == SL_OK; i++) {
        uint32_t point;
        status = find_place(context, grid, &places, i, 0, &point);
        if (status == SL_OK) sl_bits_add(kept, point);
    }
    number_table_destroy(context, &places.table);
    return status;
}

static sl_status mark_within(sl_context *context, const vga_grid_plan *plan,
                             const input_options *input, const sl_vga_grid *grid, sl_bits *kept) {
    sl_map outlines = {0};
    SL_TRY(within_read(context, &plan->within, input, &outlines));
    size_t count = 0;
    for (uint32_t p = 0; p < grid->count; p++) {
        const bool within = within_has(&outlines, grid->points[p]);
        if (within) sl_bits_add(kept, p);
        count += within;
    }
    sl_map_destroy(context, &outlines);
    return count ? SL_OK : within_fail(context, &plan->within);
}

static sl_status drop_others(sl_context *context, const vga_grid_plan *plan,
                             const input_options *input, sl_vga_grid *grid) {
    for (int k = 0; k < 3; k++) {
        const bool asked = k == 0   ? plan->within.path != NULL
                           : k == 1 ? plan->border
                                    : !!plan->points;
        if (!asked) continue;
        sl_bits *kept = sl_alloc_array(context, sl_bits_words(grid->count), sizeof *kept);
        if (!kept) return SL_NO_MEMORY;
        const sl_status status = k == 0   ? mark_within(context, plan, input, grid, kept)
                                 : k == 1 ? sl_vga_grid_border(context, grid, kept)
                                          : mark_listed(context, plan->points, grid, kept);
        if (status == SL_OK) sl_vga_grid_keep(grid, kept);
        sl_free(context, kept);
        SL_TRY(status);
    }
    return SL_OK;
}

sl_status vga_grid_choose(sl_context *context, const vga_grid_plan *plan,
                          const map_pipeline *pipeline, const sl_map *map,
                          const sl_outline *outline, sl_vga_grid *grid) {
    sl_point *seeds = sl_alloc_array(context, plan->at.count + 1, sizeof *seeds);
    sl_status status = seeds ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; i < plan->at.count && status == SL_OK; i++) {
        status = read_point(context, "--at", plan->at.items[i], &seeds[i]);
        if (status == SL_OK)
            status =
                input_locate(context, "--at", plan->at.items[i], outline->space, seeds[i], NULL);
    }
    if (status == SL_OK) {
        status = sl_vga_grid_make(context, outline, plan->step, seeds, plan->at.count, grid);
        status = pipeline_name_stray(context, pipeline->path, map, outline->space, status);
    }
    sl_free(context, seeds);
    if (status == SL_OK && grid->count == 0)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--grid %.9g: no point of the grid is inside the map; choose a smaller step",
                       plan->step);
    return status == SL_OK ? drop_others(context, plan, &pipeline->input, grid) : status;
}

// --- chosen points and links

sl_status vga_grid_find(sl_context *context, const sl_vga_grid *grid, const char *option,
                        const option_list *places, uint32_t *from) {
    for (size_t i = 0; i < places->count; i++) {
        sl_point at = {0};
        SL_TRY(read_point(context, option, places->items[i], &at));
        from[i] = sl_vga_grid_find(grid, at);
        if (from[i] == UINT32_MAX)
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "%s %s: the grid has no point there; choose a place in a room that the "
                           "grid fills",
                           option, places->items[i]);
    }
    return SL_OK;
}

sl_status vga_grid_read_links(sl_context *context, const char *path, const sl_vga_grid *grid,
                              sl_vga_link **links, size_t *count) {
    place_table places;
    SL_TRY(read_places(context, path, 4, &places));
    const size_t rows = places.table.rows;
    sl_vga_link *out = sl_alloc_array(context, rows, sizeof *out);
    sl_status status = out ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; i < rows && status == SL_OK; i++) {
        status = find_place(context, grid, &places, i, 0, &out[i].a);
        if (status == SL_OK) status = find_place(context, grid, &places, i, 1, &out[i].b);
        if (status == SL_OK && out[i].a == out[i].b)
            status = sl_fail_at(context, path, places.table.lines[i],
                                "both ends of the link are one point of the grid");
    }
    *count = rows;
    number_table_destroy(context, &places.table);
    if (status == SL_OK)
        *links = out;
    else
        sl_free(context, out);
    return status;
}

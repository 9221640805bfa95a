/// The title, the scale and the squares of a heat map.
#include "reports/heat_map.h"

#include "reports/fields.h"
#include "sightline/support.h"
#include "system/built.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void heat_map_title(const char *input, const char *map, const char *measure, char *text,
                    size_t size) {
    char name[256], readable[256];
    snprintf(name, sizeof name, "%s", sl_path_name(input));
    char *ending = strrchr(name, '.');
    if (ending && ending != name && !map) *ending = '\0';
    text_make_readable(strcmp(name, "-") ? name : "standard input", readable, sizeof readable);
    const char *known = map && sl_text_is_utf8(map) ? map : "";
    snprintf(text, size, "%s%s%.64s: %s", readable, *known ? " " : "", known, measure);
}

/// Fields go row by row from the lowest, grids column by column.
sl_field heat_map_field(const sl_vga_grid *grid, const double *values, double *squares) {
    for (size_t i = 0; i < (size_t)grid->columns * grid->rows; i++) squares[i] = NAN;
    for (uint32_t p = 0; p < grid->count; p++) {
        const size_t column = grid->squares[p] / grid->rows, row = grid->squares[p] % grid->rows;
        squares[row * grid->columns + column] = values[p];
    }
    return (sl_field){.corner = {((double)grid->left - 0.5) * grid->step,
                                 ((double)grid->bottom - 0.5) * grid->step},
                      .step = grid->step,
                      .columns = grid->columns,
                      .rows = grid->rows,
                      .values = squares};
}

void heat_map_scale(sl_context *context, bool given, const double *values, const uint32_t *sizes,
                    uint32_t count, double *least, double *most) {
    const sl_vga_scale scale = sl_vga_scale_of(values, sizes, count);
    if (given || !scale.beyond || !(scale.least < scale.most)) return;
    *least = scale.least;
    *most = scale.most;
    sl_note(context,
            "the colour scale leaves out %u point%s in %u small part%s, not seen from the rest; "
            "values there lie beyond its ends; to fill in only the part that counts, add --start "
            "X,Y there",
            (unsigned)scale.small_points, scale.small_points == 1 ? "" : "s",
            (unsigned)scale.small_parts, scale.small_parts == 1 ? "" : "s");
}

sl_status heat_map_draw(sl_context *context, const sl_baked *baked, const heat_map *heat,
                        sl_field *field) {
    char measure[64], title[512];
    words_of(heat->measure, measure, sizeof measure);
    heat_map_title(heat->input, heat->map, measure, title, sizeof title);
    sl_draw_options drawing = *heat->drawing;
    if (!drawing.title) drawing.title = title;
    field->name = measure;
    return built_pictures()->field(context, baked, field, &drawing, heat->path);
}

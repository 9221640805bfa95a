/// Values by point, laid out as squares, and the ends of their colours.
#include "studies/vga_field.h"

#include "reports/heat_map.h"
#include "sightline/support.h"

#include <math.h>

/// Of several parts the largest alone is coloured, by its own scale. `grey` takes the squares of
/// the others, by point.
static void grey_others(const vga_table *table, double *values, double *grey) {
    for (uint32_t p = 0; p < table->grid.count; p++) {
        grey[p] = table->part[p] ? 1 : NAN;
        if (table->part[p]) values[p] = NAN;
    }
}

/// Areas, steps of agents and the like do not go by the part that a point is in: small parts only
/// do not set their scale.
static sl_status scale_without_small(sl_context *context, const vga_work *w, bool given,
                                     const double *values, sl_field *field) {
    uint32_t *sizes = sl_alloc_array(context, w->table.grid.count, sizeof *sizes);
    sl_status status = sizes ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK && w->graph.rows)
        status = sl_vga_part_sizes(context, &w->graph, w->links, w->link_count, sizes);
    else if (status == SL_OK)
        status = isovist_part_sizes(context, w->query, &w->eyes, sizes);
    if (status == SL_OK)
        heat_map_scale(context, given, values, sizes, w->table.grid.count, &field->least,
                       &field->most);
    sl_free(context, sizes);
    return status;
}

static sl_status fill(sl_context *context, const vga_work *w, size_t measure, const sl_point *scale,
                      double *values, double *others, vga_field *out) {
    const sl_vga_grid *grid = &w->table.grid;
    const bool of_part = vga_measure_is_of_part(measure);
    const bool greys = of_part && w->table.part_count > 1 && !scale;
    for (uint32_t p = 0; p < grid->count; p++) values[p] = vga_value(&w->table, measure, p);
    if (greys) {
        grey_others(&w->table, values, others);
        heat_map_field(grid, others, out->values);
        for (size_t i = 0; i < (size_t)grid->columns * grid->rows; i++)
            out->grey[i] = !isnan(out->values[i]);
    }
    out->field = heat_map_field(grid, values, out->values);
    if (greys) out->field.grey = out->grey;
    if (scale) {
        out->field.least = scale->x;
        out->field.most = scale->y;
    }
    return of_part ? SL_OK : scale_without_small(context, w, scale != NULL, values, &out->field);
}

sl_status vga_field_make(sl_context *context, const vga_work *w, size_t measure,
                         const sl_point *scale, vga_field *out) {
    const sl_vga_grid *grid = &w->table.grid;
    const size_t count = (size_t)grid->columns * grid->rows;
    double *values = sl_alloc_array(context, grid->count, sizeof *values);
    double *others = sl_alloc_array(context, grid->count, sizeof *others);
    *out = (vga_field){.values = sl_alloc_array(context, count, sizeof *out->values),
                       .grey = sl_alloc_array(context, count, sizeof *out->grey)};
    sl_status status = values && others && out->values && out->grey ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = fill(context, w, measure, scale, values, others, out);
    sl_free(context, values);
    sl_free(context, others);
    if (status != SL_OK) vga_field_destroy(context, out);
    return status;
}

void vga_field_destroy(sl_context *context, vga_field *field) {
    sl_free(context, field->values);
    sl_free(context, field->grey);
    *field = (vga_field){0};
}

/// The difference of two plans in `sightline vga`: what each point gains or loses.
#ifndef VGA_CHANGE_H
#define VGA_CHANGE_H

#include "sightline/draw.h"
#include "studies/vga_table.h"

/// A point of either plan; UINT32_MAX where a plan does not have it.
typedef struct vga_pair {
    sl_point at;
    uint32_t before, after;
} vga_pair;

/// All points of two plans, column by column. Both tables must live as long as it.
typedef struct vga_change {
    const vga_table *before, *after;
    vga_pair *pairs;
    size_t count;
} vga_change;

/// Both grids have the same step.
sl_status vga_change_make(sl_context *context, const vga_table *before, const vga_table *after,
                          vga_change *out);
void vga_change_destroy(sl_context *context, vga_change *change);

/// Writes for each measure its value, that of the other plan, and the other less the first:
/// GeoJSON where the name ends so, else CSV. "-" is stdout.
sl_status vga_change_write(sl_context *context, const vga_change *change, const char *path);

/// Fills a field with the changes of one measure. The caller frees the values (sl_free), also after
/// a failure.
sl_status vga_change_field(sl_context *context, const vga_change *change, size_t measure,
                           double **values_out, sl_field *out);

/// Prints mean and deviation of both plans and of the changes, and the ten places that gain most of
/// one measure.
void vga_change_print(const vga_change *change, size_t measure);

#endif

/// The heat map of a measure of a visibility graph.
#ifndef VGA_FIELD_H
#define VGA_FIELD_H

#include "studies/vga_run.h"

/// A field, and what it is made of.
typedef struct vga_field {
    sl_field field; ///< its name is not set
    double *values;
    bool *grey;
} vga_field;

/// Lays out the values of a measure. `scale`: the ends of the colours; NULL: as the values say. Of
/// several parts of the graph the largest then sets them. Notes what they leave out.
sl_status vga_field_make(sl_context *context, const vga_work *w, size_t measure,
                         const sl_point *scale, vga_field *out);
void vga_field_destroy(sl_context *context, vga_field *field);

#endif

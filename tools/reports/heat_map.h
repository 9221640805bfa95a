/// Heat maps: the values of one measure on a grid of squares, drawn over the plan.
#ifndef HEAT_MAP_H
#define HEAT_MAP_H

#include "sightline/draw.h"
#include "sightline/vga.h"

/// What a picture shows of which map.
typedef struct heat_map {
    const char *input;   ///< the map's file, for the title
    const char *map;     ///< the name of one of several maps in it; NULL for none
    const char *measure; ///< by its name in tables: "visual_control"
    const sl_draw_options *drawing;
    const char *path; ///< of the picture
} heat_map;

/// Draws `field`; its name is set to the measure's, in words. The title, without one in the
/// options, is "office: area", or "doom.wad E1M1: area" for one of several maps.
sl_status heat_map_draw(sl_context *context, const sl_baked *baked, const heat_map *heat,
                        sl_field *field);

/// Lays out values by point: each point is the middle of a square. `squares`, with room for columns
/// times rows, becomes the field's values. The rest of the field is zeroed.
sl_field heat_map_field(const sl_vga_grid *grid, const double *values, double *squares);

/// Sets the ends of the colour scale, unless `given`, to those of the values in the plan's large
/// parts, and notes what lies beyond. `values` and the `sizes` of parts are by point.
void heat_map_scale(sl_context *context, bool given, const double *values, const uint32_t *sizes,
                    uint32_t count, double *least, double *most);

/// The title of a picture: "office: area", or "doom.wad E1M1: area".
void heat_map_title(const char *input, const char *map, const char *measure, char *text,
                    size_t size);

#endif

/// Pictures as plans: how dark each pixel is, and walls around the dark ones.
#ifndef SL_IMPORT_IMAGE_H
#define SL_IMPORT_IMAGE_H

#include "sightline/io.h"
#include "sightline/support.h"

/// How a picture is a plan.
typedef struct sl_image_plan {
    double threshold; ///< a pixel is solid where its darkness, 0 .. 1, is at least this
    bool light;       ///< the light pixels are the dark ones
    double step;      ///< the size of a pixel
    sl_point origin;  ///< of the lower left pixel's lower left corner
} sl_image_plan;

/// Adds walls along the edges between solid and other pixels, merged. Beyond the picture all is
/// open. Gives the number of solid pixels.
sl_status sl_image_add_walls(sl_context *context, const sl_image *image, const sl_image_plan *plan,
                             sl_map *map, size_t *solid);

#endif

/// Pictures as plans: how dark each pixel is, and walls around the dark ones.
#ifndef SL_IMPORT_IMAGE_H
#define SL_IMPORT_IMAGE_H

#include "sightline/import.h"
#include "sightline/support.h"

/// Rows from the top down, a byte a pixel: 0 black, 255 white. Zeroed, there is none.
typedef struct sl_image {
    size_t width, height;
    unsigned char *pixels;
} sl_image;

/// PNG, or portable grey map or bit map (P1, P2, P4, P5), told by their first bytes. What is
/// transparent is white. SL_BAD_INPUT, naming the file, for all else.
sl_status sl_image_read(sl_context *context, const char *name, const char *bytes, size_t size,
                        sl_image *out);
void sl_image_destroy(sl_context *context, sl_image *image);

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

/// Pictures as plans: what is solid in them, and the walls about it.
#ifndef SL_IMAGE_H
#define SL_IMAGE_H

#include "map/grid.h"
#include "sightline/io.h"

/// The grey and the opacity of each pixel, one behind the other; NULL where the picture has no
/// transparent ones. sl_free is the caller's. As sl_image_read.
sl_status sli_image_read_alpha(sl_context *context, const char *name, const char *bytes,
                               size_t size, unsigned char **out);

// --- walls

/// What of the small pieces of solid that touch nothing is open.
typedef enum sli_image_left_out {
    SLI_LEAVE_OUT_NONE,
    SLI_LEAVE_OUT_LETTERS,
    SLI_LEAVE_OUT_SMALL,
} sli_image_left_out;

/// How a picture is a plan.
typedef struct sli_image_plan {
    double threshold; ///< a pixel is solid where its darkness, 0 .. 1, is at least this
    bool light;       ///< the light pixels are the dark ones
    sli_image_left_out left_out;
    bool solid_outside; ///< beyond the picture all is solid; else it is open
    double step;        ///< the size of a pixel
    sl_point origin;    ///< of the lower left pixel's lower left corner
} sli_image_plan;

/// Small pieces of solid: symbols, columns, and lettering where it is not left out.
typedef struct sli_image_small {
    size_t letters;       ///< pieces that are left out as lettering
    size_t count;         ///< other pieces
    size_t width, height; ///< of the largest, in pixels
} sli_image_small;

/// Adds walls along the edges between solid and other pixels, merged. Gives the number of solid
/// pixels; with `small`, small pieces are looked for.
sl_status sli_image_add_walls(sl_context *context, const sl_image *image,
                              const sli_image_plan *plan, sl_map *map, size_t *solid,
                              sli_image_small *small);

/// Looks for small pieces in a grid of rows of one length; what is left out becomes open ground.
sl_status sli_image_find_small(sl_context *context, sli_grid *grid, sli_image_left_out left_out,
                               sli_image_small *out);

/// As sli_map_read_image(); `before` stands before the names of layers in messages.
sl_status sli_image_read_map(sl_context *context, const char *name, const char *text, size_t size,
                             const sl_import_options *options, const char *before, sl_map *map);

/// A piece of solid: its box, from its first pixel to behind its last one along x and y, its number
/// of pixels, and whether it is of a word.
typedef struct sli_piece {
    size_t low[2], high[2], area;
    bool letter;
} sli_piece;

/// Marks the pieces that are letters, and changes their order.
sl_status sli_image_find_letters(sl_context *context, sli_piece **pieces, size_t count);

// --- what is solid

/// Whether the walls are what is opaque: thin, mostly light, and the rest is transparent.
bool sli_image_is_opaque(const unsigned char *alpha, const sl_image *image, size_t *row);
/// Whether the walls are thin light lines on a dark ground. `row` has room for a row and one more.
bool sli_image_is_light(const sl_image *image, size_t *row);

/// What may be wrong where the page is dark and solid.
typedef struct sli_image_page {
    bool has_lines;           ///< what is light on it is mostly thin
    double lightness, second; ///< of the page and of ground that is dark, too; 0 for none
    double threshold;         ///< between the two
} sli_image_page;

sli_image_page sli_image_find_page(const sl_image *image, size_t *row);

/// What a histogram says of the threshold.
typedef struct sli_image_levels {
    double threshold;  ///< the usual, or less where nearly all of the drawing is fainter
    bool faint;        ///< it is less
    size_t lost;       ///< pixels of fainter lines and areas that stay open
    double lost_level; ///< their darkness
    double lost_from;  ///< the threshold that takes them
    bool soft;         ///< edges are soft, as drawing programs and scanners make them
    double between;    ///< the share of pixels of all kinds of grey, as photographs have them
} sli_image_levels;

sli_image_levels sli_image_find_levels(const sl_image *image, bool light, size_t *row);

#endif

/// Transforms of SVG attributes and of CSS, and lengths with their units.
#ifndef SL_SVG_TRANSFORM_H
#define SL_SVG_TRANSFORM_H

#include "io/parts/shapes.h"
#include "map/scan.h"

/// The size of a unit in user units (SVG 1.1, 7.10: 96 a CSS inch), of none: 1; 0 where the unit is
/// not known.
double sli_svg_unit(sli_word unit);

typedef enum sli_svg_result {
    SLI_SVG_READ,
    SLI_SVG_WRONG,  ///< no transform at all, which viewers leave out
    SLI_SVG_BEYOND, ///< one that viewers know and this reader does not
} sli_svg_result;

/// Reads a list of transforms: matrix, translate, scale, rotate, skewX, skewY (SVG 1.1, 7.6), and
/// those of CSS in the plane, with units (CSS Transforms 1). Shares in percent are of `box`, which
/// may be NULL: they are unknown then.
sli_svg_result sli_svg_transform(sli_word text, const sl_box *box, sli_affine *out);

/// Reads the place that a transform leaves where it is: "left", "50% 10px". Shares are of `box`.
sli_svg_result sli_svg_origin(sli_word text, const sl_box *box, sl_point *out);

#endif

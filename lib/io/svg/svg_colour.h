/// Colours of SVG and CSS, and with them how a shape is painted.
#ifndef SL_SVG_COLOUR_H
#define SL_SVG_COLOUR_H

#include "io/parts/drawn_looks.h"
#include "io/svg/svg_style.h"

/// A colour as 0xRRGGBB, and its opacity. SLI_SVG_NO_COLOUR where it is not known here: patterns,
/// variables, names that are seldom used.
#define SLI_SVG_NO_COLOUR UINT32_MAX
uint32_t sli_svg_colour(sli_word value, double *opacity);

/// How a shape looks whose lines are `scale` times as wide in the map. A shape with a line is known
/// by it, unless it is filled with the same colour.
sli_ink sli_svg_ink(const sli_svg_paint *paint, double scale);

#endif

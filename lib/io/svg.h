/// An SVG drawing as its readers see it: numbers in attributes, and a path's commands.
#ifndef SL_IMPORT_SVG_H
#define SL_IMPORT_SVG_H

#include "io/pen.h"

/// A walk over the text of an attribute.
typedef struct sl_svg_text {
    const char *at, *end;
    const char *what; ///< the attribute, for messages
} sl_svg_text;

sl_svg_text sl_svg_text_of(const char *text, const char *what);
/// Passes over white space and at most one comma.
void sl_svg_skip(sl_svg_text *text);
/// The next number. SL_BAD_INPUT, at the pen's line, where there is none.
sl_status sl_svg_number(const sl_pen *pen, sl_svg_text *text, double *value);

/// Reads a list of transforms: matrix, translate, scale, rotate, skewX, skewY (SVG 1.1, 7.6).
sl_status sl_svg_transform(const sl_pen *pen, const char *text, sl_affine *affine);

/// Draws a path's data, all commands (SVG 1.1, 8.3).
sl_status sl_svg_path(sl_pen *pen, const char *data);

#endif

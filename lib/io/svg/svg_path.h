/// Numbers in attributes, and the data of paths.
#ifndef SL_SVG_PATH_H
#define SL_SVG_PATH_H

#include "io/parts/shapes.h"
#include "map/scan.h"

/// A walk over the text of an attribute.
typedef struct sli_svg_text {
    const char *at, *end;
    const char *what; ///< the attribute, for messages
    bool wrong;       ///< the last failure: something else was expected here
} sli_svg_text;

sli_svg_text sli_svg_text_of(const char *text, const char *what);
/// Passes over white space; sli_svg_skip over at most one comma too.
void sli_svg_skip_space(sli_svg_text *text);
void sli_svg_skip(sli_svg_text *text);
/// SL_BAD_INPUT, at the pen's line: "points: expected a number, found 'x'".
sl_status sli_svg_fail(const sli_pen *pen, sli_svg_text *text, const char *expected);
/// The next number.
sl_status sli_svg_number(const sli_pen *pen, sli_svg_text *text, double *value);
/// The next number, as a coordinate of what is drawn.
sl_status sli_svg_coordinate(sli_pen *pen, sli_svg_text *text, double *value);

/// Draws a path's data, all commands (SVG 1.1, 8.3). Where it is wrong, `*wrong` is set, and all
/// before it is drawn, as SVG asks for (F.2).
sl_status sli_svg_path(sli_pen *pen, const char *data, bool *wrong);

#endif

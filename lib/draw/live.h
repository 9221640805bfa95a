/// Sheets of paper keep what pictures drop: layers with names, and in SVG texts that stay text.
#ifndef SL_DRAW_LIVE_H
#define SL_DRAW_LIVE_H

#include "draw/draw_plan.h"
#include "sightline/support.h"

/// Bytes of a file that is kept back until it is finished.
typedef SL_ARRAY(char) sli_text_buffer;

/// Lets a surface keep layers, and texts too if `texts`.
sl_status sli_live_begin(sl_context *context, cairo_surface_t *surface, bool texts);

/// What is drawn from here on belongs to a layer of this name. Nothing on other surfaces.
void sli_layer_begin(cairo_t *cairo, const char *name);

/// A text that an SVG keeps: UTF-8, `length` bytes, `width` wide in a font of that size.
typedef struct sli_live_text {
    const char *text;
    size_t length;
    double size, width;
    bool bold;
} sli_live_text;

/// Keeps a text at the left end of its base line, if the surface keeps texts. False: draw it.
bool sli_live_keep(cairo_t *cairo, sl_colour colour, double x, double y, const sli_live_text *text);

/// Makes groups with names of the pages of an SVG that cairo has written, and adds the texts.
sl_status sli_live_write_svg(sl_context *context, cairo_surface_t *surface, sli_text_buffer *svg);

/// The names of the layers of a surface.
sl_status sli_live_layers(sl_context *context, cairo_surface_t *surface, const char *const **names,
                          size_t *count);

/// Makes layers with names of the pages of a PDF that cairo has written. SL_IO if its parts are
/// not where cairo 1.16 puts them.
sl_status sli_live_write_pdf(sl_context *context, cairo_surface_t *surface, sli_text_buffer *file);

#endif

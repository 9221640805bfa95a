/// A page in a file: PNG, SVG or PDF by the ending of its name.
#ifndef SL_DRAW_PAPER_H
#define SL_DRAW_PAPER_H

#include "sightline/support.h"

#include <cairo.h>

typedef struct sl_paper_kind sl_paper_kind;

/// The kind that a file's name asks for: SL_BAD_ARGUMENT where its ending is none that is known.
sl_status sl_paper_kind_of(sl_context *context, const char *path, const sl_paper_kind **out);

typedef struct sl_paper {
    const sl_paper_kind *kind;
    const char *path; ///< the caller's
    cairo_surface_t *surface;
    cairo_t *cairo; ///< to draw with
    sl_output output;
    sl_context *context;
    SL_ARRAY(char) text; ///< what is kept back until the end (SVG)
    bool out_of_memory;  ///< while that was being kept
} sl_paper;

/// A blank page; `title` (NULL for none) goes into the file's own description where it has one.
sl_status sl_paper_open(sl_context *context, const sl_paper_kind *kind, const char *path, int width,
                        int height, const char *title, sl_paper *out);

/// Writes the file where `status` is SL_OK and cairo has no complaint; else nothing is left of it.
sl_status sl_paper_close(sl_context *context, sl_paper *paper, sl_status status);

/// A failure of cairo's in our words.
sl_status sl_fail_cairo(sl_context *context, const char *path, cairo_status_t status);

#endif

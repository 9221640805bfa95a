/// A sheet of paper on which the plan stands to scale: its size, the scale, the title block.
#ifndef SL_DRAW_SHEET_H
#define SL_DRAW_SHEET_H

#include "draw/page.h"

/// A sheet that was asked for (sl_sheet), read. Lengths of paper are in points.
typedef struct sli_sheet {
    const sl_scene *scene;
    const char *title, *paper; ///< `paper` as a name: "A3"
    double narrow, wide;       ///< sides of the paper
    double metres;             ///< the length of the map's unit
    double scale;              ///< the plan is drawn at 1 to this; 0: not chosen yet
} sli_sheet;

/// Reads what was asked for. SL_BAD_ARGUMENT on a paper, a scale or a kind of file that no sheet
/// has, and for a map whose unit is not known.
sl_status sli_sheet_read(sl_context *context, const sl_scene *scene, const char *title,
                         const char *path, sli_sheet *out);

/// Chooses how the paper lies, and the scale if none is given, and lays out the page.
/// SL_BAD_ARGUMENT if the plan does not fit: the message has a scale that does.
sl_status sli_sheet_lay_out(sl_context *context, cairo_t *cairo, const sli_page_parts *parts,
                            sli_sheet *sheet, sli_page *page);

/// Draws the frame and the title block.
void sli_sheet_paint(cairo_t *cairo, const sli_sheet *sheet, const sli_page *page);

/// Draws a scale bar as long as `room` allows, its right end at `right`, with its length below.
void sli_draw_scale_bar(cairo_t *cairo, const sl_scene *scene, const sl_frame *frame, double right,
                        double y, double room, double text);

#endif

/// What the two files of the picture of an explanation share: draw_explain.c has the page,
/// draw_explain_plan.c what is drawn over the plan.
#ifndef SL_DRAW_EXPLAIN_H
#define SL_DRAW_EXPLAIN_H

#include "draw/marks.h"
#include "draw/page.h"

/// What the picture shows.
typedef struct sli_explained {
    sl_scene scene; ///< the plan, its cells painted as the explanation asks
    const sl_explanation *explanation;
    const sl_sequence *sequence; ///< the one shown; NULL for none
    const sl_miss *miss;         ///< the one it is of; NULL where it is seen
    sl_colour left, right;       ///< of portal ends
    sl_colour target;            ///< the name of the cell looked at
    sl_box frame;                ///< the part of the map that is shown
    bool part;                   ///< it is not all of it
} sli_explained;

/// Marks that the key explains.
typedef enum sli_swatch {
    SLI_LEFT_END,
    SLI_RIGHT_END,
    SLI_CROSSED,
    SLI_STOP,
    SLI_SIGHTLINE,
    SLI_WAY,
    SLI_BENT,
    SLI_SWATCHES
} sli_swatch;

/// Draws the plan and over it what is to be explained.
sl_status sli_explained_over_plan(sl_context *context, cairo_t *cairo, const sli_explained *pic,
                                  const sl_frame *frame);

/// Draws a mark for the key: it starts at `left`, and is twice as wide as `size`.
void sli_explained_swatch(cairo_t *cairo, const sli_explained *pic, sli_swatch what, double left,
                          double middle, double size);

#endif

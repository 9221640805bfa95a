/// The marks of faults: a shape and a colour a kind, alike in the plan and in its legend.
#ifndef SL_DRAW_FAULTS_H
#define SL_DRAW_FAULTS_H

#include "draw/marks.h"
#include "sightline/faults.h"

/// All faults over the plan.
void sl_draw_faults(cairo_t *cairo, const sl_palette *palette, const sl_pens *pens,
                    const sl_frame *frame, const sl_faults *faults);

/// A fault's mark from one point to another, in page coordinates.
void sl_mark_fault(cairo_t *cairo, const sl_palette *palette, const sl_pens *pens,
                   sl_fault_kind kind, sl_point a, sl_point b);

#endif

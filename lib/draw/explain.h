/// A picture of an explanation: what it shows, and how that lies over the plan.
#ifndef SL_DRAW_EXPLAIN_H
#define SL_DRAW_EXPLAIN_H

#include "draw/canvas.h"
#include "draw/marks.h"
#include "draw/scene.h"
#include "sightline/support.h"

typedef struct sl_told {
    sl_scene scene; ///< the plan, its cells painted as the explanation asks
    const sl_explanation *explanation;
    const sl_sequence *sequence; ///< the one shown; NULL for none
    const sl_miss *miss;         ///< the one it is of; NULL where it is seen
    sl_colour left, right;       ///< of portal ends
    sl_colour target;            ///< the name of the cell looked at
    sl_box frame;                ///< the part of the map that is shown
    bool part;                   ///< it is not all of it
} sl_told;

/// Draws the plan and over it what is told of it.
sl_status sl_draw_told(sl_context *context, cairo_t *cairo, const sl_told *told,
                       const sl_frame *frame);

/// What stands for a portal's end: a disc for left ones, a square for right ones.
void sl_mark_end(cairo_t *cairo, const sl_told *told, sl_point at, bool left, double radius);

/// A number (from 1) in a disc; 0 for the cross of a portal that stops a sequence.
void sl_mark_badge(cairo_t *cairo, const sl_told *told, sl_point at, double radius,
                   unsigned number);

/// Strokes the path as the line that sees, as one that sees by mirror, as the way of a sequence
/// that does not, as a portal of the sequence or as the one that stops it.
void sl_pen_sightline(cairo_t *cairo, const sl_told *told, double unit);
void sl_pen_bent(cairo_t *cairo, const sl_told *told, double unit);
void sl_pen_way(cairo_t *cairo, const sl_told *told, double unit);
void sl_pen_crossed(cairo_t *cairo, const sl_told *told, double unit);
void sl_pen_stop(cairo_t *cairo, const sl_told *told, double unit);

#endif

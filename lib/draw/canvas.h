/// From the map to the page: the transform, and paths that never leave what cairo can hold.
#ifndef SL_DRAW_CANVAS_H
#define SL_DRAW_CANVAS_H

#include "sightline/geometry.h"

#include <cairo.h>
#include <stdbool.h>
#include <stddef.h>

/// Where a map stands on a page: a frame and what it shows. Page coordinates run right and down
/// from the page's upper left.
typedef struct sl_frame {
    sl_point corner;  ///< the map's point at its lower left
    double scale;     ///< page units for a unit of the map, the same both ways
    double left, top; ///< its place on the page
    double width, height;
    double unit; ///< what line widths are given in: 1 on a page 1200 wide
} sl_frame;

/// A frame that shows all of `bounds`, as large as the frame allows, in its middle; nothing is
/// stretched.
sl_frame sl_frame_fit(sl_box bounds, double left, double top, double width, double height,
                      double unit);

/// On the page. The corner is taken off before scaling, so that maps far from the origin keep their
/// places; what lies far off the page stays finite.
sl_point sl_frame_point(const sl_frame *frame, sl_point point);

/// The frame and its surroundings, on the page: nothing beyond is worth drawing, and cairo's
/// fixed-point coordinates overflow beyond 2^23, which a frame zoomed in reaches.
sl_box sl_frame_guard(const sl_frame *frame);

/// A segment's piece in the guard, on the page; false where there is none.
bool sl_frame_segment(const sl_frame *frame, sl_point a, sl_point b, sl_point *from, sl_point *to);

/// Whether a point's place is in the guard; `place` may be NULL.
bool sl_frame_holds(const sl_frame *frame, sl_point point, sl_point *place);

/// Adds a segment, cut to the guard.
void sl_path_segment(cairo_t *cairo, const sl_frame *frame, sl_point a, sl_point b);

/// Adds a convex polygon, cut likewise.
void sl_path_polygon(cairo_t *cairo, const sl_frame *frame, const sl_point *corners, size_t count);

/// Adds a curve; where it reaches far off the frame, the straight segment between its ends.
void sl_path_curve(cairo_t *cairo, const sl_frame *frame, const sl_point controls[4]);

#endif

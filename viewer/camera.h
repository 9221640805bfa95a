/// The part of the map that the plan shows: panned, zoomed about a point, fitted.
#ifndef VIEWER_CAMERA_H
#define VIEWER_CAMERA_H

#include "sightline/canvas.h"

typedef struct plan_camera {
    sl_point middle;    ///< of the map, in the pane's middle
    double scale;       ///< pixels for a unit of the map
    double least, most; ///< bounds of the scale, by the map's size
} plan_camera;

/// All of `bounds` in a pane of that size, with a margin.
plan_camera camera_fit(sl_box bounds, double width, double height);

void camera_pan(plan_camera *camera, double dx, double dy); ///< pixels, right and down

/// Zooms; what is at `offset` (pixels from the pane's middle, right and down) stays there.
void camera_zoom(plan_camera *camera, double factor, sl_point offset);

/// The frame that draws the whole plane through a pane.
sl_frame camera_frame(const plan_camera *camera, sl_box pane, double unit);

/// The map's point at a place on the page.
sl_point camera_point(const plan_camera *camera, sl_box pane, sl_point page);

#endif

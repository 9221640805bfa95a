/// Where things are seen from: the camera over the plan, and the eye that walks through the map.
#ifndef VIEWER_VIEW_H
#define VIEWER_VIEW_H

#include "document/document.h"
#include "sightline/draw.h"

typedef struct app_state app_state;

// --- the camera

typedef struct plan_camera {
    sl_point middle;    ///< of the map, in the pane's middle
    double scale;       ///< pixels for a unit of the map
    double least, most; ///< bounds of the scale, by the map's size
} plan_camera;

/// All of `bounds` in a pane of that size, with a margin.
plan_camera camera_fit(sl_box bounds, double width, double height);

/// The frame that draws the whole plane through a pane.
sl_frame camera_frame(const plan_camera *camera, sl_box pane, double unit);

/// The map's point at a place on the page.
sl_point camera_point(const plan_camera *camera, sl_box pane, sl_point page);

// --- the camera, moved by hand: the plan no longer fits the pane by itself

/// Moves the plan by pixels, right and down.
void view_pan(app_state *app, double dx, double dy);

/// Zooms; the place at `offset` (pixels from the middle of the pane, right and down) stays.
void view_zoom(app_state *app, double factor, sl_point offset);

// --- the eye

/// Keys held down.
enum hold_key {
    HOLD_FORWARD = 1,
    HOLD_BACK = 2,
    HOLD_LEFT = 4,
    HOLD_RIGHT = 8,
    HOLD_TURN_LEFT = 16,
    HOLD_TURN_RIGHT = 32,
};

typedef struct eye_state {
    sl_point at;
    double heading, fov; ///< degrees; 360: all round
    bool flies;          ///< through walls
} eye_state;

/// The speed of the eye in map units a second: it depends on the size of cells.
double walk_speed(const document_state *document);

/// Moves the eye by the keys that are held. Walls stop a walking eye by an exact test, and it
/// slides along them.
void walk_tick(app_state *app, double seconds);

/// Puts the eye at the map's first start, or into the middle of its largest cell that counts.
void walk_home(app_state *app);

#endif

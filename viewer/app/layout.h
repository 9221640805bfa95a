/// Where things are on the page.
#ifndef VIEWER_LAYOUT_H
#define VIEWER_LAYOUT_H

#include "app/app.h"
#include "panes/modes.h"

typedef struct window_layout {
    sl_box bar, side, status, plan[2], time;
    int plan_count;
    sl_box below[PANES_BELOW]; ///< the plan, or the first person beside it; of no width where they
                               ///< are not shown
} window_layout;

window_layout app_layout(const app_state *app);

/// The same, and tells the view where the plans are.
window_layout app_place(app_state *app);

/// Moves a border between panels, of ui_edges, by pixels; positive: the panel grows.
void app_drag_edge(app_state *app, int edge, double by);

/// Fits the map into a plan of that size, if the camera is to fit.
void app_fit(app_state *app, sl_box plan);

#endif

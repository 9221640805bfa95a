/// The shortest way between two places that are clicked, among walls and shut doors as they are
/// now.
#ifndef VIEWER_ROUTE_H
#define VIEWER_ROUTE_H

#include "plan/view.h"
#include "sightline/path.h"

struct route_layer {
    sl_query *query; ///< a copy of its own; NULL: none yet
    sl_route_finder *finder;
    uint32_t version; ///< of what is present that they are of
    double walker;    ///< the radius that they are for
    bool tight;       ///< an end of the way has no room for it
    int clicks;       ///< 0: none, 1: the way begins at `from`, 2: it ends at `to`
    sl_point from, to;
    sl_route route;
};

/// Takes a click: where the way begins, where it ends, and then anew.
void route_click(view_state *view, sl_point at);
/// Finds the way again where doors, walls or the walker's radius have changed.
void route_update(view_state *view);
void route_draw(const view_state *view, const sl_frame *frame);
/// Forgets the way. False where there was none.
bool route_clear(view_state *view);
void route_layer_destroy(sl_context *context, route_layer *layer); ///< NULL: nothing

#endif

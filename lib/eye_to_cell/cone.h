/// A view's cone as an arc, made once for many questions.
#ifndef SL_CONE_H
#define SL_CONE_H

#include "eye_to_cell/arc.h"
#include "sightline/view.h"

/// `arc` is the cone or, of one wider than 180 degrees (`wide`), what it leaves out, borders apart.
typedef struct sl_cone {
    bool full, wide;
    sl_arc arc;
} sl_cone;

/// The pivot must be at the view's eye, and the view usable.
sl_cone sl_cone_of(sl_pivot *pivot, const sl_view *view);

bool sl_cone_holds(sl_pivot *pivot, const sl_cone *cone, sl_point point);
bool sl_cone_meets_segment(sl_pivot *pivot, const sl_cone *cone, sl_point a, sl_point b);
bool sl_cone_meets_polygon(sl_pivot *pivot, const sl_cone *cone, const sl_point *corners,
                           size_t count);

/// What of an arc lies within the cone: up to two arcs. Returns how many.
unsigned sl_cone_clip(sl_pivot *pivot, const sl_cone *cone, const sl_arc *arc, sl_arc pieces[2]);

#endif

/// What objects cost to render.
#ifndef SL_VIEW_RENDER_H
#define SL_VIEW_RENDER_H

#include "sightline/support.h"
#include "sightline/view_cells.h"

typedef struct sl_view_render {
    const sl_view_scene *scene;
    uint32_t object_count;
    double *fixed; ///< by object: max(a, b * t)
    bool even;     ///< all of these are the same, and c is 0
} sl_view_render;

sl_status sl_view_render_make(sl_context *context, const sl_view_scene *scene, sl_view_render *out);
void sl_view_render_destroy(sl_context *context, sl_view_render *render);

/// What takes the share of the full circle that an object does from a place.
double sl_view_render_share(const sl_view_render *render, uint32_t object, sl_point from);

/// The cost of an object, seen from a place.
static inline double sl_view_render_object(const sl_view_render *render, uint32_t object,
                                           sl_point from) {
    const double fixed = render->fixed[object], c = render->scene->cost.c;
    if (!(c > 0)) return fixed;
    const double seen = c * sl_view_render_share(render, object, from);
    return seen > fixed ? seen : fixed;
}

/// The cost of a set, seen from a place; `words` of it.
double sl_view_render_set(const sl_view_render *render, const sl_bits *set, size_t words,
                          sl_point from);

#endif

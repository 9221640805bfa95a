/// Where a viewpoint could stand to see a point, near to places that are given: sight has no
/// direction, so it is in the region of the point.
#include "analysis/placement/view_shapes.h"
#include "geometry/length.h"
#include "sightline/place_area.h"

#include <math.h>

sl_status sl_place_nearest(sl_context *context, sl_query *query, const sl_viewpoint *like,
                           sl_point target, const sl_viewpoint *places, uint32_t count,
                           sl_point *out, bool *found) {
    const sl_viewpoint around = {
        .at = target, .fov = 360, .range = like->range, .nearest = like->nearest};
    sl_region region = {0};
    sli_view_shapes shapes = {0};
    double least = INFINITY;
    *found = false;
    const sl_status status = sli_view_shapes_add(context, query, &around, &region, &shapes);
    const sl_shape shape = status == SL_OK ? sli_view_shape(&shapes, 0) : (sl_shape){0};
    size_t first = 0;
    for (size_t l = 0; l < shape.count; first = shape.ends[l++])
        for (size_t i = first; i < shape.ends[l]; i++) {
            const sl_point a = shape.points[i];
            const sl_point b = shape.points[i + 1 < shape.ends[l] ? i + 1 : first];
            for (uint32_t k = 0; k < count; k++) {
                const sl_point at = sli_nearest_on(a, b, places[k].at);
                const double distance = sli_length(at.x - places[k].at.x, at.y - places[k].at.y);
                if (!(distance < least)) continue;
                least = distance;
                *out = at;
                *found = true;
            }
        }
    // A little off walls, and off the border of the range, but not into the dead zone.
    if (*found && !(like->nearest > 0)) {
        out->x += 0x1p-10 * (target.x - out->x);
        out->y += 0x1p-10 * (target.y - out->y);
    }
    sl_region_destroy(context, &region);
    sli_view_shapes_destroy(context, &shapes);
    return status;
}

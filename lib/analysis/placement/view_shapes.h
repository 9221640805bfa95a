/// What viewpoints see, as shapes of an overlay (overlay.h).
#ifndef SLI_VIEW_SHAPES_H
#define SLI_VIEW_SHAPES_H

#include "sightline/overlay.h"
#include "sightline/query.h"
#include "sightline/support.h"
#include "sightline/viewpoint.h"

/// Shapes side by side. Zeroed, it is empty.
typedef struct sli_view_shapes {
    SL_ARRAY(sl_point) points;     ///< of all shapes
    SL_ARRAY(size_t) ends;         ///< of all loops, counted from their shape's first point
    SL_ARRAY(size_t) shape_points; ///< by shape: the number of points up to its end
    SL_ARRAY(size_t) shape_loops;  ///< by shape: the number of loops up to its end
} sli_view_shapes;

/// Refuses a viewpoint, by its number, whose cone, range or dead zone is none, and a sign without a
/// range.
sl_status sli_check_viewpoints(sl_context *context, const sl_viewpoint *viewpoints, size_t count);
/// Refuses signs, for `what` does not know them.
sl_status sli_refuse_signs(sl_context *context, const sl_viewpoint *viewpoints, size_t count,
                           const char *what);
/// The range that counts for a viewpoint, the query's included; 0: no limit.
double sli_view_range(const sl_query *query, const sl_viewpoint *viewpoint);
/// Where it looks from: its place; of a sign, just before it.
sl_point sli_viewpoint_eye(const sl_space *space, const sl_viewpoint *viewpoint);
/// Whether a place is within its cone and range, and not in its dead zone. `view`: its eye and its
/// cone. Exact, but for signs.
bool sli_viewpoint_holds(const sl_viewpoint *viewpoint, const sl_view *view, sl_point place);
/// The middle of the disc that a sign is read from, given its eye.
sl_point sli_sign_middle(sl_point eye, const sl_viewpoint *sign);
/// Adds what a viewpoint sees. Where a range ends, chords lie within the arc; around a dead zone
/// they lie outside of it. So the shape has nothing that is not seen. `region` is scratch. Of a
/// sign it is where the sign is read from. SL_UNSUPPORTED for a sign and one-way glass.
sl_status sli_view_shapes_add(sl_context *context, sl_query *query, const sl_viewpoint *viewpoint,
                              sl_region *region, sli_view_shapes *shapes);
/// Adds all walls of a space, there and back, as one shape. It covers nothing.
sl_status sli_view_shapes_add_walls(sl_context *context, const sl_space *space,
                                    sli_view_shapes *shapes);
/// A shape, until the next one is added.
sl_shape sli_view_shape(const sli_view_shapes *shapes, size_t number);
void sli_view_shapes_destroy(sl_context *context, sli_view_shapes *shapes); ///< and zeroes it

#endif

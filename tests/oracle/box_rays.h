/// Whether an eye sees a box, by walls alone: nothing changes between two neighbouring directions
/// of those to ends of walls and to where walls meet sides of the box. So a ray between each two
/// says what is seen of the box; the directions themselves say what sightlines may touch of it.
/// Coordinates are integers up to 2^10, and all products exact in 64 bits.
#ifndef SL_TESTS_BOX_RAYS_H
#define SL_TESTS_BOX_RAYS_H

#include "oracle/two_points.h"

#include "sightline/view.h"

typedef enum box_sight {
    BOX_HIDDEN,  ///< no sightline comes to it, and none touches it
    BOX_TOUCHED, ///< at most single sightlines do, past ends of walls
    BOX_OPEN,    ///< it is not said
    BOX_SEEN,    ///< all sightlines between two directions come to it
} box_sight;

/// The walls are without the box's own sides, `q` is not used. Sides of the box cross walls at
/// integers. The first `cover` walls hide a side that they cover; one that others cover is
/// BOX_OPEN, and so is a box at the very end of the range (0: there is none).
box_sight box_rays_sight(const two_points *eye, size_t cover, sl_box box, const sl_view *view,
                         double range);

/// Whether a point is in a direction of the view, and on neither border of it.
bool box_rays_in_view(const sl_view *view, sl_point p);

/// Whether it is in the direction of a border.
bool box_rays_on_border(const sl_view *view, sl_point p);

#endif

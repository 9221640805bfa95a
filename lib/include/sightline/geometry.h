/// Points, segments, boxes and shapes: plain doubles, y up, any unit.
#ifndef SIGHTLINE_GEOMETRY_H
#define SIGHTLINE_GEOMETRY_H

#include "sightline/context.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A usable coordinate is 0, or its magnitude is in this range. Then no later stage can overflow,
/// or lose bits to underflow. Readers take a smaller magnitude as 0, and refuse a larger one.
#define SL_COORDINATE_MIN 1e-150
/// The largest magnitude of a coordinate.
#define SL_COORDINATE_MAX 1e150

/// A point, in the map's unit; y grows upwards.
typedef struct sl_point {
    double x, y;
} sl_point;

/// A closed segment from a to b.
typedef struct sl_segment {
    sl_point a, b;
} sl_segment;

/// Closed; min.x <= max.x and min.y <= max.y.
typedef struct sl_box {
    sl_point min, max;
} sl_box;

/// 1 where c lies to the left of the line from a to b, -1 to the right, 0 on it. Exact for all
/// finite doubles.
SL_API int sl_orient(sl_point a, sl_point b, sl_point c);

/// Shapes of polygons with holes, in three levels. Rings are not closed: the last point is not the
/// first one again. Outer rings are counter-clockwise, holes clockwise.
typedef struct sl_shapes {
    sl_point *points;
    uint32_t *rings;    ///< by ring, and one more: points[rings[i] .. rings[i + 1])
    uint32_t *polygons; ///< by polygon, and one more: its rings; the first is the outer one
    uint32_t *shapes;   ///< by shape, and one more: its polygons
    uint32_t count;     ///< of shapes
} sl_shapes;

#ifdef __cplusplus
}
#endif

#endif

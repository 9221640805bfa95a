/// Points, segments and boxes: plain doubles, y up, any unit.
#ifndef SIGHTLINE_GEOMETRY_H
#define SIGHTLINE_GEOMETRY_H

#ifdef __cplusplus
extern "C" {
#endif

/// A usable coordinate is 0, or its magnitude is in this range. Then no later stage can overflow,
/// or lose bits to underflow. Readers refuse other coordinates.
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

#ifdef __cplusplus
}
#endif

#endif

/// The eyes of `sightline isovist`: single points, a grid, a path of the map, a table from a file.
#ifndef ISOVIST_EYES_H
#define ISOVIST_EYES_H

#include "sightline/bake.h"
#include "sightline/support.h"

/// A place to look from, with its heading and view cone in degrees.
typedef struct sl_eye {
    sl_point at;
    double look, fov;
} sl_eye;

typedef struct sl_eyes {
    SL_ARRAY(sl_eye) list;
    // Of a grid: its squares, and by eye the square that it is in the middle of.
    sl_point corner;
    double step;
    size_t columns, rows;
    SL_ARRAY(size_t) squares;
} sl_eyes;

void sl_eyes_destroy(sl_context *context, sl_eyes *eyes);

sl_status sl_eyes_add(sl_context *context, sl_eyes *eyes, sl_eye eye);

/// The middles of squares that lie inside, over the whole map. `like` has their heading and cone.
sl_status sl_eyes_add_grid(sl_context *context, const sl_space *space, double step, sl_eye like,
                           sl_eyes *eyes);

/// The points of a path, and, where `step` is not 0, points every `step` along it instead.
sl_status sl_eyes_add_path(sl_context *context, const sl_path *path, double step, sl_eye like,
                           sl_eyes *eyes);

/// Lines of x, y and, where they are given, angle and field of view, with commas between; a first
/// line of words is passed over. SL_BAD_INPUT with FILE:LINE on anything else, and on points
/// outside the map.
sl_status sl_eyes_read_csv(sl_context *context, const char *path, const sl_space *space,
                           sl_eye like, sl_eyes *eyes);

#endif

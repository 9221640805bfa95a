/// The eyes of `sightline isovist` (points, a grid, a path, a table from a file), and the measures
/// of what they see.
#ifndef ISOVIST_H
#define ISOVIST_H

#include "names.h"
#include "sightline/bake.h"
#include "sightline/mirrored.h"
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

typedef struct sl_isovist {
    sl_region_measures measures;
    size_t corners;       ///< of walls that are seen
    double mirrored_area; ///< 0 where the map has no mirrors, as `parts`
    size_t parts;         ///< of what is seen by mirror
} sl_isovist;

/// The measures by name.
sl_name_table sl_isovist_measures(void);
double sl_isovist_value(const sl_isovist *isovist, size_t measure);

/// The view of an eye.
sl_view sl_eye_view(const sl_space *space, const sl_eye *eye);

/// What there is to be seen, and how far.
typedef struct sl_isovist_scene {
    const sl_outline *outline;
    const sl_room_mirrors *mirrors; ///< NULL where the map has none
    double range;
    uint32_t mirror_depth;
} sl_isovist_scene;

/// The region of a view, with what is seen by mirror where there are any.
sl_status sl_isovist_look(sl_context *context, const sl_isovist_scene *scene, const sl_view *view,
                          sl_mirrored_region *out);

/// Fills out[0 .. eyes->list.count). Reports stage "isovist".
sl_status sl_isovist_run(sl_context *context, const sl_isovist_scene *scene, const sl_eyes *eyes,
                         unsigned threads, sl_isovist *out);

/// Writes the table to a file, "-" for stdout; with columns for mirrors where there are any.
sl_status sl_isovist_write(sl_context *context, const sl_isovist_scene *scene, const sl_eyes *eyes,
                           const sl_isovist *isovists, const char *path);

#endif

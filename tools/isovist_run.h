/// The measures of many eyes, found by several threads, and told as CSV.
#ifndef ISOVIST_RUN_H
#define ISOVIST_RUN_H

#include "isovist_eyes.h"
#include "names.h"
#include "sightline/mirrored.h"

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

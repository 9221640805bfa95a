/// A walk along a path: frames of a film, and a measure along the way as a chart.
#ifndef ISOVIST_WALK_H
#define ISOVIST_WALK_H

#include "sightline/draw.h"
#include "studies/isovist.h"

/// What a walk shows. The eyes are in the order of the walk.
typedef struct isovist_walk {
    const sl_baked *baked;
    const isovist_scene *scene;
    const eye_places *eyes;
    double step; ///< between eyes along the path; 0: they are its points
} isovist_walk;

/// Draws what each eye sees directly, as DIR/frame-00001.png and so on, all of one size, and notes
/// how ffmpeg makes a film of them. All files or none.
sl_status isovist_walk_frames(sl_context *context, const isovist_walk *walk,
                              const sl_draw_options *drawing, const char *folder);

/// Draws a measure of SL_ISOVIST over the length of the way.
sl_status isovist_walk_chart(sl_context *context, const isovist_walk *walk,
                             const isovist_result *isovists, size_t measure,
                             const sl_draw_options *drawing, const char *path);

#endif

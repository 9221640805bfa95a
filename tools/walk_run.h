/// The way of a walk, and walking it by each method: counts and times, frame by frame.
#ifndef WALK_RUN_H
#define WALK_RUN_H

#include "console.h"
#include "isovist.h"
#include "sightline/bake.h"
#include "sightline/eye_to_cell.h"
#include "sightline/walk.h"

typedef SL_ARRAY(sl_point) sl_way;

/// Lines of x and y, with blanks or a comma between; # begins a comment. SL_BAD_INPUT with
/// FILE:LINE on anything else, on points outside the map, and where there are fewer than two.
sl_status sl_way_read(sl_context *context, const char *path, const sl_space *space, sl_way *way);

/// A tour: from cell to cell through the middles of portals, to cells chosen at random of those
/// that can be walked to, until it is `length` long. It begins at `start`, which must lie inside
/// the bounds.
sl_status sl_way_tour(sl_context *context, const sl_space *space, sl_point start, uint64_t seed,
                      double length, sl_way *way);

double sl_way_length(const sl_way *way);

/// Eyes every `step` along the way, each looking at the point of the way that is `ahead` on.
sl_status sl_way_frames(sl_context *context, const sl_way *way, double step, double ahead,
                        double fov, sl_eyes *eyes);

/// What is counted and timed of each frame, and averaged over a walk.
typedef enum sl_walk_figure {
    SL_FIGURE_TESTS,         ///< node visibility tests
    SL_FIGURE_FRUSTUM_TESTS, ///< and the rest of sl_walk_frame
    SL_FIGURE_OPENED,
    SL_FIGURE_PROPAGATIONS,
    SL_FIGURE_PROPAGATED,
    SL_FIGURE_SKIPPED,
    SL_FIGURE_BOUNDED,
    SL_FIGURE_CHEAP,
    SL_FIGURE_VISITED,
    SL_FIGURE_OUT,
    SL_FIGURE_INVISIBLE,
    SL_FIGURE_PARTIAL,
    SL_FIGURE_VISIBLE,
    SL_FIGURE_OCCLUDERS,
    SL_FIGURE_ORIENTATIONS,
    SL_FIGURE_CELLS,      ///< drawn
    SL_FIGURE_WALLS,      ///< drawn
    SL_FIGURE_VISIBILITY, ///< seconds to find the cells
    SL_FIGURE_DRAWING,    ///< seconds to draw their walls
    SL_FIGURE_FRAME,      ///< both
    SL_FIGURES
} sl_walk_figure;

/// The names of the figures, as columns of a table have them.
const char *sl_walk_figure_name(sl_walk_figure figure);

/// One way to walk: a method with a test; or, where `method` is NULL, culling for an eye from the
/// baked visible sets.
typedef struct sl_walk_choice {
    const sl_walk_method *method;
    sl_walk_options options;
    const sl_eye_method *baked;
} sl_walk_choice;

/// "updating", "exact"; and "tree", "intervals", "baked".
const char *sl_walk_choice_name(const sl_walk_choice *choice);
const char *sl_walk_choice_test(const sl_walk_choice *choice);

/// What is walked through.
typedef struct sl_walk_scene {
    const sl_baked *baked;
    const sl_hierarchy *hierarchy;
    double wall_seconds; ///< what drawing a wall is counted for; 0: as measured
    unsigned repeat;     ///< walks; times are the least of all, frame by frame
} sl_walk_scene;

/// Walks past the eyes: means over all frames. `frames` has SL_FIGURES places for each eye, or is
/// NULL.
sl_status sl_walk_run(sl_console *console, const sl_walk_scene *scene, const sl_walk_choice *choice,
                      const sl_eyes *eyes, double means[SL_FIGURES], double *frames);

#endif

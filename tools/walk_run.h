/// Running methods of walking along a way, and what that comes to.
#ifndef WALK_RUN_H
#define WALK_RUN_H

#include "console.h"
#include "isovist_eyes.h"
#include "sightline/bake.h"
#include "sightline/eye_to_cell.h"
#include "sightline/walk.h"

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

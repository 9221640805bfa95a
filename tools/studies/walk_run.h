/// The path of a walk, and the walk itself by each method: counts and times, frame by frame.
#ifndef WALK_RUN_H
#define WALK_RUN_H

#include "sightline/bake.h"
#include "sightline/view.h"
#include "sightline/walk.h"
#include "studies/isovist.h"
#include "system/console.h"

typedef SL_ARRAY(sl_point) walk_way;

/// Reads lines of x and y, with blanks or a comma between; # begins a comment. SL_BAD_INPUT with
/// FILE:LINE on anything else, on points outside the map, and on fewer than two points.
sl_status way_read(sl_context *context, const char *path, const sl_space *space, walk_way *way);

/// A tour to random cells that can be reached, through the middles of portals, until it is `steps`
/// of length *step long. It begins at `start`, which must lie inside the bounds. A step of 0
/// becomes a share of the size of all that can be reached.
sl_status way_tour(sl_context *context, const sl_space *space, sl_point start, uint64_t seed,
                   double steps, double *step, walk_way *way);

double way_length(const walk_way *way);

/// Eyes every `step` along the way. Each looks at the point that is `ahead` further on.
sl_status way_frames(sl_context *context, const walk_way *way, double step, double ahead,
                     double fov, eye_places *eyes);

/// The figures of a frame: counts and times. A walk has their means.
typedef enum walk_figure {
    FIGURE_TESTS,         ///< node visibility tests
    FIGURE_FRUSTUM_TESTS, ///< and the rest of sl_walk_frame
    FIGURE_OPENED,
    FIGURE_PROPAGATIONS,
    FIGURE_PROPAGATED,
    FIGURE_SKIPPED,
    FIGURE_BOUNDED,
    FIGURE_CHEAP,
    FIGURE_VISITED,
    FIGURE_OUT,
    FIGURE_INVISIBLE,
    FIGURE_PARTIAL,
    FIGURE_VISIBLE,
    FIGURE_OCCLUDERS,
    FIGURE_ORIENTATIONS,
    FIGURE_CELLS,      ///< drawn
    FIGURE_WALLS,      ///< drawn
    FIGURE_VISIBILITY, ///< seconds to find the cells
    FIGURE_DRAWING,    ///< seconds to draw their walls
    FIGURE_FRAME,      ///< both
    FIGURES
} walk_figure;

/// The names of the figures, as columns of a table have them.
const char *walk_figure_name(walk_figure figure);

/// One way to walk: a method with a node test. Where `method` is NULL: culling for an eye by the
/// baked visible sets.
typedef struct walk_choice {
    const sl_walk_method *method;
    sl_walk_options options;
    const sl_eye_method *baked;
} walk_choice;

/// "updating", "exact"; and "tree", "intervals", "baked".
const char *walk_choice_name(const walk_choice *choice);
const char *walk_choice_test(const walk_choice *choice);

/// What is walked through.
typedef struct walk_scene {
    const sl_baked *baked;
    const sl_hierarchy *hierarchy;
    double wall_seconds; ///< what drawing a wall is counted for; 0: as measured
    unsigned repeat;     ///< walks; times are the least of all, frame by frame
} walk_scene;

/// Walks from eye to eye; gives means over all frames. `frames` has FIGURES places for each eye, or
/// is NULL.
sl_status walk_run(command_console *console, const walk_scene *scene, const walk_choice *choice,
                   const eye_places *eyes, double means[FIGURES], double *frames);

#endif

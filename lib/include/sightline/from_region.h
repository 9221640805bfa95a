/// From-region visibility: which objects are seen from which view cells? Several methods that use
/// the same solver (Laine 2005).
#ifndef SIGHTLINE_FROM_REGION_H
#define SIGHTLINE_FROM_REGION_H

#include "sightline/map.h"
#include "sightline/stab.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What view cells are: n x n squares over the map, the kd-tree's leaves, or the map's `object`
/// boxes, where boxes of one name are one view cell. Boxes may leave parts of the map without a
/// view cell: there sightlines leave the compound.
typedef enum sl_view_cell_kind {
    SL_VIEW_CELLS_GRID,
    SL_VIEW_CELLS_LEAVES,
    SL_VIEW_CELLS_BOXES,
} sl_view_cell_kind;

/// What objects are: walls, groups of walls that lie together, `object` boxes (those of one name
/// are one object), or the kd-tree's leaves. Boxes and leaves hide nothing.
typedef enum sl_object_kind {
    SL_OBJECTS_WALLS,
    SL_OBJECTS_GROUPS,
    SL_OBJECTS_BOXES,
    SL_OBJECTS_CELLS,
} sl_object_kind;

/// Start from sl_from_region_scene_options_default().
typedef struct sl_from_region_scene_options {
    sl_view_cell_kind view_cells;
    uint32_t grid; ///< n of a grid, 1 to SL_VIEW_GRID_MOST
    sl_object_kind objects;
    uint32_t groups; ///< about so many, at least 1
    bool cut_cycles; ///< cut view cells that depend on each other in a cycle, along the kd-tree;
                     ///< else they are refused
} sl_from_region_scene_options;

/// The finest grid of view cells.
#define SL_VIEW_GRID_MOST 256

/// The usual options: 8 x 8 squares as view cells, about 1800 groups of walls as objects.
SL_API sl_from_region_scene_options sl_from_region_scene_options_default(void);

/// View cells and objects of a map, ready for the methods. It is only read by them.
typedef struct sl_from_region_scene sl_from_region_scene;

/// Subdivides the map by a kd-tree, also along the borders of view cells, and keeps what is inside.
/// Walls must be axial and clean. SL_BAD_INPUT where they are not, where the map has none of the
/// boxes that are asked for, and where view cells depend on each other in a cycle in some quadrant
/// of directions: the message names the cycle.
SL_API sl_status sl_from_region_scene_create(sl_context *context, const sl_map *map,
                                             const sl_from_region_scene_options *options,
                                             sl_from_region_scene **out);
/// Frees a scene; NULL is fine.
SL_API void sl_from_region_scene_destroy(sl_context *context, sl_from_region_scene *scene);

/// How much there is in a scene.
typedef struct sl_from_region_counts {
    uint32_t view_cells, objects;
    uint32_t leaves; ///< of the kd-tree, inside
    uint32_t faces;  ///< open pieces of view cells' borders, each with the side it leads out of
    uint32_t boundary_faces; ///< faces with no view cell behind them
    uint32_t dependents; ///< the most view cells that depend on one in a quadrant: the paper's K
} sl_from_region_counts;

/// Counts what is in a scene.
SL_API sl_from_region_counts sl_from_region_scene_count(const sl_from_region_scene *scene);

/// The solvers that decide what is seen through a face.
typedef struct sl_from_region_solver {
    const char *name, *what;
    sl_guarantee guarantee;
    bool stabs; ///< whether it needs sl_from_region_options.stab
} sl_from_region_solver;

/// All: "sampling", "stabs".
SL_API const sl_from_region_solver *sl_from_region_solvers(size_t *count);

/// Start from sl_from_region_options_default().
typedef struct sl_from_region_options {
    const sl_from_region_solver *solver;
    const sl_solver *stab; ///< of "stabs"
    sl_sight sight;        ///< of "stabs"
    uint32_t points;       ///< of "sampling": points along the longer side of the map, usually 256
    uint32_t pixels;       ///< of "sampling": lines from a point in half a quadrant, usually 32
    uint64_t seed;         ///< of "sampling"
    unsigned threads;      ///< 0: one a core; the result does not depend on it
} sl_from_region_options;

/// The usual options, as told at each field.
SL_API sl_from_region_options sl_from_region_options_default(void);

/// What a method found. Zeroed, it is empty.
typedef struct sl_from_region_result {
    uint32_t view_cells, objects;
    uint32_t words;   ///< of a row
    uint64_t *seen;   ///< a row of bits a view cell: what it sees, what lies in it included
    uint64_t images;  ///< solved: for "sampling" a point's half quadrants, else a face's quadrants
    uint64_t rays;    ///< for "sampling" lines followed, else portal sequences tested
    uint64_t refined; ///< objects given to the solver, over all images; after view frustum culling
                      ///< where the solver culls
    uint64_t candidates; ///< objects given to it, over view cells and quadrants
    uint64_t relations;  ///< objects in directed visible sets, over view cells and quadrants; by
                         ///< "multipass" only
} sl_from_region_result;

/// Frees a result and zeroes it.
SL_API void sl_from_region_result_destroy(sl_context *context, sl_from_region_result *result);
/// Over all view cells.
SL_API uint64_t sl_from_region_pairs(const sl_from_region_result *result);

/// A method. All give the solver the same faces, quadrant by quadrant, and differ only in the
/// refine set. So with one solver they find the same.
typedef struct sl_from_region_method {
    const char *name, *what;
    sl_status (*see)(sl_context *context, const sl_from_region_scene *scene,
                     const sl_from_region_options *options, sl_from_region_result *out);
} sl_from_region_method;

/// "brute" (every view cell on its own, all objects), "hierarchy" (Nirenstein & Blake 2004, with
/// its cache: superset simplification), "multipass" (Laine 2005). Reports stage "from_region".
SL_API const sl_from_region_method *sl_from_region_methods(size_t *count);

#ifdef __cplusplus
}
#endif

#endif

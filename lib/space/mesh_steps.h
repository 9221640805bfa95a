/// How the mesh of a space comes about, step by step, to be shown.
#ifndef SL_SPACE_MESH_STEPS_H
#define SL_SPACE_MESH_STEPS_H

#include "space/mesh.h"

/// A side of two triangles that is no wall and no seam.
typedef struct sl_mesh_side {
    uint32_t half;
    uint32_t stuck; ///< half or its twin: without the side the corner where this one starts would
                    ///< turn right. SL_OUTSIDE: the side was taken out
} sl_mesh_side;

/// Zeroed, it is empty.
typedef struct sl_mesh_steps {
    sl_triangulation delaunay;    ///< of the points alone
    sl_triangulation triangles;   ///< with walls and seams as sides, and the same points
    bool *fresh;                  ///< by edge of `triangles`: it is none of `delaunay`
    SL_ARRAY(sl_mesh_side) sides; ///< in the order in which they are tried: the longest first
    uint32_t *taken;              ///< by edge: its place in `sides`, where it was taken out
} sl_mesh_steps;

/// What `taken` has of an edge that stays.
#define SL_MESH_STAYS UINT32_MAX

/// Triangulates the walls and seams of a space again, and merges the triangles again. Of a space
/// with the map's own cells (sl_subdivide_given) it is the mesh without those.
sl_status sl_mesh_steps_record(sl_context *context, const sl_space *space, sl_mesh_steps *out);
void sl_mesh_steps_destroy(sl_context *context, sl_mesh_steps *steps); ///< and zeroes it

/// The half-edge that follows one around its cell, before the side of that place is tried.
uint32_t sl_mesh_steps_next(const sl_mesh_steps *steps, size_t place, uint32_t half);

/// The corner that would turn right without the side of that place, which has to stay: from a
/// through the corner b to c.
void sl_mesh_steps_corner(const sl_mesh_steps *steps, size_t place, sl_point corner[3]);

#endif

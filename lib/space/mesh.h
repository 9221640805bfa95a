/// The mesh of a map with oblique walls. Segments become a planar graph (map/planar.h), the graph
/// is triangulated with its edges as sides, and triangles are merged to convex cells.
#ifndef SL_SPACE_MESH_H
#define SL_SPACE_MESH_H

#include "map/planar.h"
#include "sightline/space.h"
#include "sightline/support.h"

// --- the triangulation

/// The `next` of a half-edge outside the box.
#define SLI_OUTSIDE UINT32_MAX

/// One side of an edge, with a triangle at its left. The other side of half-edge h is h ^ 1, its
/// twin.
typedef struct sli_half_edge {
    uint32_t from; ///< the point where it starts
    uint32_t next; ///< counter-clockwise around the triangle
} sli_half_edge;

/// Zeroed, it is empty. The points are those of the graph, with the same numbers, and after them
/// corners of the box. By exact signs, all triangles are counter-clockwise and of positive area,
/// and cover the box once. No coordinate is computed.
typedef struct sli_triangulation {
    SL_ARRAY(sl_point) points;
    SL_ARRAY(sli_half_edge) halves;
    uint32_t *labels; ///< by edge (h / 2): 1 + the number of the graph's edge, 0 for none
    size_t label_room;
    uint32_t *out; ///< by point: a half-edge within the box that starts there
    size_t out_room;
} sli_triangulation;

/// Triangulates. The triangles are Delaunay triangles where the graph's edges permit it, except for
/// points that lie nearly on one circle. SL_BAD_INPUT names a place where edges cross or go through
/// a point, so that the graph is not planar. Time about O(n log n).
sl_status sli_triangulate(sl_context *context, const sli_planar *graph, const sl_box *box,
                          sli_triangulation *out);
void sli_triangulation_destroy(sl_context *context, sli_triangulation *t); ///< and zeroes it

static inline uint32_t sli_half_end(const sli_triangulation *t, uint32_t half) {
    return t->halves.items[half ^ 1].from;
}

static inline bool sli_half_is_outside(const sli_triangulation *t, uint32_t half) {
    return t->halves.items[half].next == SLI_OUTSIDE;
}

// --- the mesh

/// The segments of a map for its graph: walls first, then sl_space.seams, then all other lines
/// where cells end.
typedef struct sli_mesh_lines {
    SL_ARRAY(sl_segment) items;
    size_t wall_count, seam_count;
} sli_mesh_lines;

sl_status sli_mesh_add_line(sl_context *context, sli_mesh_lines *lines, sl_segment at);
/// Lists the walls and seams of a map, and gives the space its bounds and seams.
sl_status sli_mesh_lines_of_map(sl_context *context, const sl_map *map, sli_mesh_lines *lines,
                                sl_space *space);

/// Called for each side that may be removed, the longest first. `stuck` is SLI_OUTSIDE if the side
/// is removed. Else it is half or its twin: without the side, the corner where `stuck` starts would
/// turn right.
typedef sl_status sli_mesh_watch(void *user, uint32_t half, uint32_t stuck);

/// Merges triangles to convex cells, but not across an edge of the graph. Afterwards `next` goes
/// around cells. `cell` (NULL for none) becomes the caller's, by half-edge: SLI_OUTSIDE for a
/// removed one, else 0.
sl_status sli_mesh_merge(sl_context *context, sli_triangulation *triangles, sli_mesh_watch *watch,
                         void *user, uint32_t **cell);

/// A portal, and the places of its two directed portals in sl_space.directed.
typedef struct sli_mesh_joint {
    sl_portal portal;
    uint32_t directed[2]; ///< that of portal.cell[0], then that of portal.cell[1]
    uint32_t half;        ///< decides the order of portals between the same cells at one place
} sli_mesh_joint;

/// Sorts the joints, and makes portals and directed portals of them.
sl_status sli_mesh_join(sl_context *context, sli_mesh_joint *joints, size_t count, sl_space *space);

/// Makes the cells, portals, walls and grid of a space that has its bounds and seams. The triangles
/// are those of the graph of lines, and are used up.
sl_status sli_mesh_make(sl_context *context, const sl_map *map, const sli_mesh_lines *lines,
                        const sli_planar *graph, sli_triangulation *triangles, sl_space *space);

// --- the steps of the mesh, for lessons

/// A side between two triangles that is neither wall nor seam.
typedef struct sli_mesh_side {
    uint32_t half;
    uint32_t stuck; ///< as in sli_mesh_watch
} sli_mesh_side;

/// Zeroed, it is empty.
typedef struct sli_mesh_steps {
    sli_triangulation delaunay;    ///< of the points, without walls and seams
    sli_triangulation triangles;   ///< with walls and seams as sides, and the same points
    bool *fresh;                   ///< by edge of `triangles`: `delaunay` does not have it
    SL_ARRAY(sli_mesh_side) sides; ///< in the order of trial: the longest first
    uint32_t *taken;               ///< by edge: its place in `sides` if it was removed
} sli_mesh_steps;

/// The value of `taken` for an edge that stays.
#define SLI_MESH_STAYS UINT32_MAX

/// Triangulates the walls and seams of a space again, and merges the triangles again. It leaves out
/// cells that a map brought along (sli_subdivide_given).
sl_status sli_mesh_steps_record(sl_context *context, const sl_space *space, sli_mesh_steps *out);
void sli_mesh_steps_destroy(sl_context *context, sli_mesh_steps *steps); ///< and zeroes it

/// The half-edge after `half` around its cell, just before the side at `place` is tried.
uint32_t sli_mesh_steps_next(const sli_mesh_steps *steps, size_t place, uint32_t half);

/// For a side that has to stay: three points whose middle one is the corner that would turn right.
void sli_mesh_steps_corner(const sli_mesh_steps *steps, size_t place, sl_point corner[3]);

// --- checks

/// Checks a mesh whose counts and bounds are checked already (check_mesh.c).
sl_status sli_check_mesh(sl_context *context, const sl_space *space);

/// Checks that a cell is inside, outside or solid ground.
sl_status sli_check_ground(sl_context *context, const sl_space *space, uint32_t cell);

/// Checks a directed portal against its portal. `directed_found` notes, by portal, the bits 1 for
/// cell[0] and 2 for cell[1]; each may come once.
sl_status sli_check_directed(sl_context *context, const sl_space *space, uint32_t cell,
                             const sl_directed_portal *directed, uint8_t *directed_found);

#endif

/// A space made of a planar graph: what both a map's mesh and its own cells come to.
#ifndef SL_SPACE_MESH_H
#define SL_SPACE_MESH_H

#include "map/planar.h"
#include "sightline/space.h"
#include "sightline/support.h"

// --- the triangulation

/// Beyond the box: what a half-edge on the outside has next.
#define SL_OUTSIDE UINT32_MAX

/// One side of an edge, with a triangle at its left. The other side of half-edge h is h ^ 1.
typedef struct sl_half_edge {
    uint32_t from; ///< the point where it starts
    uint32_t next; ///< counter-clockwise around the triangle
} sl_half_edge;

/// Zeroed, it is empty. Points are those of the graph, by the same numbers, and behind them corners
/// of the box. All triangles are counter-clockwise and of positive area, by exact signs, and cover
/// the box once. No coordinate is computed.
typedef struct sl_triangulation {
    SL_ARRAY(sl_point) points;
    SL_ARRAY(sl_half_edge) halves;
    uint32_t *labels; ///< by edge (h / 2): 1 + the edge of the graph that it is, 0 for none
    size_t label_room;
    uint32_t *out; ///< by point: a half-edge within the box that starts there
} sl_triangulation;

/// Triangulates. Where no edge of the graph forbids it, triangles are Delaunay's, but for points
/// that lie nearly on one circle. SL_BAD_INPUT, naming a place, where edges cross or go through
/// points: the graph is none. Time about O(n log n).
sl_status sl_triangulate(sl_context *context, const sl_planar *graph, const sl_box *box,
                         sl_triangulation *out);
void sl_triangulation_destroy(sl_context *context, sl_triangulation *t); ///< and zeroes it

static inline uint32_t sl_half_end(const sl_triangulation *t, uint32_t half) {
    return t->halves.items[half ^ 1].from;
}

static inline bool sl_half_is_outside(const sl_triangulation *t, uint32_t half) {
    return t->halves.items[half].next == SL_OUTSIDE;
}

// --- the mesh

/// The segments of a map, as they go into its graph: walls first, then the parts of seams as
/// sl_space.seams has them, then what else ends cells.
typedef struct sl_mesh_lines {
    SL_ARRAY(sl_segment) items;
    size_t wall_count, seam_count;
} sl_mesh_lines;

sl_status sl_mesh_add_line(sl_context *context, sl_mesh_lines *lines, sl_segment at);
/// Lists walls and seams of a map, and gives the space its bounds and seams.
sl_status sl_mesh_lines_of_map(sl_context *context, const sl_map *map, sl_mesh_lines *lines,
                               sl_space *space);

/// Sees each side of a triangle that may be taken out, the longest first. Without the side the
/// corner where `stuck` (half or its twin) starts would turn right, and the side has to stay; with
/// SL_OUTSIDE both ends stay convex, and it is taken out.
typedef sl_status sl_mesh_watch(void *user, uint32_t half, uint32_t stuck);

/// Merges triangles to convex cells, across no edge of the graph. Triangles lose their form: `next`
/// goes round cells. `cell` becomes the caller's, by half-edge: SL_OUTSIDE for one that is gone,
/// else 0; NULL where nobody asks.
sl_status sl_mesh_merge(sl_context *context, sl_triangulation *triangles, sl_mesh_watch *watch,
                        void *user, uint32_t **cell);

/// A portal, and the places of its two directed portals in sl_space.directed portals.
typedef struct sl_mesh_joint {
    sl_portal portal;
    uint32_t directed[2]; ///< that of portal.cell[0], then that of portal.cell[1]
    uint32_t half;        ///< of several between the same cells at one place, the least comes first
} sl_mesh_joint;

/// Sorts the joints and makes the portals and directed portals of them.
sl_status sl_mesh_join(sl_context *context, sl_mesh_joint *joints, size_t count, sl_space *space);

/// Makes the cells, portals, walls and grid of a space whose bounds and seams are there, of the
/// graph of lines and its triangles, which are used up. Merges none across an edge of the graph.
sl_status sl_mesh_make(sl_context *context, const sl_map *map, const sl_mesh_lines *lines,
                       const sl_planar *graph, sl_triangulation *triangles, sl_space *space);

// --- steps, to be shown

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

// --- checks

/// The check of a space that knows its sides, of which counts and bounds are checked.
sl_status sl_check_mesh(sl_context *context, const sl_space *space);

/// The check of a directed portal against its portal. `directed_found`, by portal: 1 for the
/// directed portal of cell[0], 2 for that of cell[1]; each may be there once.
sl_status sl_check_directed(sl_context *context, const sl_space *space, uint32_t cell,
                            const sl_directed_portal *directed, uint8_t *directed_found);

#endif

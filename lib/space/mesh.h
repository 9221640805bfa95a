/// A space made of a planar graph: what both a map's mesh and its own cells come to.
#ifndef SL_SPACE_MESH_H
#define SL_SPACE_MESH_H

#include "sightline/space.h"
#include "space/triangulation.h"

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

#endif

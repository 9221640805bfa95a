/// The ways to subdivide a map, which stand in the table of sl_subdivisions(): kd_tree.c, mesh.c,
/// given.c.
#ifndef SL_SUBDIVIDE_H
#define SL_SUBDIVIDE_H

#include "sightline/space.h"

/// Subdivides by a kd-tree on the lines of walls, until no wall is inside a cell. Walls and seams
/// must be axial (SL_BAD_INPUT names the first that is not), and walls clean (sl_map_clean). No
/// coordinate is computed: all are the map's, so predicates on the space are exact. (Only the
/// bounds of a map without height or width are padded.) Reports stage "subdivide".
sl_status sli_subdivide_kd(sl_context *context, const sl_map *map,
                           const sl_subdivide_options *options, sl_space *out);

/// Subdivides by a constrained triangulation of walls and seams, whose triangles are merged to
/// convex cells. Portals are removed, the longest first, if both of their ends stay convex corners
/// (Hertel & Mehlhorn 1983). Walls may be oblique.
///
/// No coordinate is computed for a clean map (sl_map_clean). Each corner of a cell is the end of a
/// wall or seam, or a corner of the bounds, and both sides of a portal have the same ends. So the
/// cells tile the bounds, predicates on them are exact, and a shut door is as tight as a wall. A
/// map that is not clean is made planar first, without a tolerance. This fails for a few maps
/// (SL_UNSUPPORTED); clean those first.
///
/// SL_BAD_INPUT for a map without walls. Memory O(n), time about O(n log n). Reports stage
/// "subdivide".
sl_status sli_subdivide_mesh(sl_context *context, const sl_map *map, sl_space *out);

/// Subdivides by a mesh that respects the cells that the map brings along (sl_map.cells). Their
/// sides end cells, so each cell lies in one of the map's cells, or in none. Bent cells are cut.
/// The room that the map's cells leave open gets cells too.
///
/// Cells may be rounded, as node builders leave them. If the map is not clean (sl_map_clean),
/// places within twice its `snap` of each other, also ends of walls, are welded first.
///
/// SL_BAD_INPUT, naming the cell, for cells that overlap.
sl_status sli_subdivide_given(sl_context *context, const sl_map *map, sl_space *out);

#endif

/// GL nodes: the convex subsectors that a node builder cut a Doom map into, as cells of the map.
///
/// (glBSP's GL nodes, versions 1, 2, 3 and 5, as its document "Specification for GL Nodes" tells:
/// GL_VERT, GL_SEGS and GL_SSECT. The tree of GL_NODES is not needed.)
#ifndef SL_DOOM_CELLS_H
#define SL_DOOM_CELLS_H

#include "io/doom.h"

/// Adds each subsector that the WAD has for the map to `out` as a cell. SL_BAD_INPUT, naming the
/// lump, where there are none or they are damaged.
sl_status sl_doom_add_cells(sl_context *context, const sl_wad *wad, const sl_wad_map *map,
                            sl_map *out);

#endif

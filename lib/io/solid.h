/// Names that say of a layer, a tile or a value that it stops sight.
#ifndef SL_IMPORT_SOLID_H
#define SL_IMPORT_SOLID_H

#include <stdbool.h>

/// Whether all words of the name are words for what is solid (wall, solid, collision, collider,
/// obstacle, block, blocked, blocking, blocker, occluder, occlusion, opaque, impassable, one or
/// many) or for nothing in particular (layer, tile, object, group, map, area, shape, box), one of
/// the first at least. Words are runs of letters, in small letters or capitals, and end before a
/// capital that follows a small letter: "Collision_Layer 2", "wallTiles", but not "wall_tops".
bool sl_says_solid(const char *name);

#endif

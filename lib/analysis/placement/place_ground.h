/// What is to be seen: the inside of a space, with its walls by their ends.
#ifndef SLI_PLACE_GROUND_H
#define SLI_PLACE_GROUND_H

#include "analysis/placement/nearby.h"
#include "sightline/map.h"
#include "sightline/space.h"

/// A wall as it leaves one of its ends.
typedef struct sli_wall_end {
    sl_point at, other;
} sli_wall_end;

typedef struct sli_ground {
    const sl_space *space;
    bool open;          ///< portals lead out of what is inside: windows may, too
    sli_wall_end *ends; ///< sorted by their points
    size_t end_count;
    sli_box_tree walls;   ///< boxes of the space's walls
    sli_box_tree outside; ///< of its cells that are not inside, where it is open; no others
    uint32_t *outer;      ///< their numbers
} sli_ground;

/// Walls meet at common ends only, but for shut doors, which may end within others: those are cut
/// there. `map`: whose doors it has.
sl_status sli_ground_make(sl_context *context, const sl_space *space, const sl_map *map,
                          sli_ground *out);

/// The pieces of a door: as cleaning cut it, or the whole.
static inline size_t sli_door_piece_count(const sl_door *door) {
    return door->part_count ? door->part_count : 1;
}
static inline sl_segment sli_door_piece(const sl_door *door, size_t piece) {
    return door->part_count ? door->parts[piece] : door->segment;
}
/// Whether a point is on a segment, exactly.
bool sli_segment_holds(const sl_segment *segment, sl_point point);
void sli_ground_destroy(sl_context *context, sli_ground *ground);

/// The walls that end at a point, *count of them; a wall that a shut door ends in is two.
const sli_wall_end *sli_ground_walls_at(const sli_ground *ground, sl_point at, size_t *count);

/// Whether walls that meet at a corner leave two directions from there, towards a and b, together.
/// Directions along a wall are on both of its sides. Exact.
bool sli_ground_joins(const sli_ground *ground, sl_point corner, sl_point a, sl_point b);

#endif

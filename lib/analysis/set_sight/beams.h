/// Beams of sight: what lies between two rays from a point, walked from room to room.
#ifndef SL_SET_SIGHT_BEAMS_H
#define SL_SET_SIGHT_BEAMS_H

#include "sightline/space.h"
#include "sightline/support.h"

/// A ray from the eye: through a point, or straight away from it. So the ray behind a corner, as it
/// is seen from another place, is no rounded one.
typedef struct sli_ray {
    sl_point through;
    bool away;
} sli_ray;

/// From `right` counter-clockwise to `left`, by less than half a turn.
typedef struct sli_beam {
    sli_ray right, left;
} sli_beam;

/// An outline with what walks need beside it.
typedef struct sli_beam_rooms {
    const sl_outline *outline;
    uint32_t *before;   ///< by side: the side before it in its room
    uint32_t *room_of;  ///< by side
    bool *solid;        ///< by room: in solid ground
    uint32_t *by_start; ///< sides, sorted by their starts
} sli_beam_rooms;

sl_status sli_beam_rooms_make(sl_context *context, const sl_outline *outline, sli_beam_rooms *out);
void sli_beam_rooms_destroy(sl_context *context, sli_beam_rooms *rooms);

static inline const sl_side *sli_side(const sli_beam_rooms *rooms, uint32_t i) {
    return &rooms->outline->sides[i];
}

static inline sl_point sli_side_end(const sli_beam_rooms *rooms, uint32_t i) {
    return sli_side(rooms, sli_side(rooms, i)->next)->start;
}

/// Whether sight passes a side, from its room to the one behind. Backwards: from there to here.
bool sli_side_passes(const sli_beam_rooms *rooms, uint32_t side, bool backwards);

/// The same side as the room behind it has it; SL_NO_WALL if there is none or sight never passes.
uint32_t sli_side_across(const sli_beam_rooms *rooms, uint32_t side);

struct sli_walk;

/// What a walk does at a side, of which `beam` meets all. At a side that sight passes, *enter is
/// true; false keeps the walk from passing it.
typedef sl_status (*sli_at_side)(struct sli_walk *walk, uint32_t side, const sli_beam *beam,
                                 bool *enter);

typedef struct sli_walk_frame {
    uint32_t entry, at;
    sli_beam beam;
} sli_walk_frame;

/// A walk. Zero it, then set the first members.
typedef struct sli_walk {
    sl_context *context;
    const sli_beam_rooms *rooms;
    sli_at_side at_side;
    void *data;
    bool backwards;
    sl_point eye;
    uint64_t sides; ///< that were looked at
    SL_ARRAY(sli_walk_frame) frames;
} sli_walk;

/// The sign of the turn from one ray to another, less than half a turn; 0 in one line. Exact.
int sli_ray_turn(sl_point eye, const sli_ray *from, const sli_ray *to);

/// Walks from the eye in the room of side `first`, around it from there; the eye is in the room or
/// on its border. `within`: the beam that is walked; NULL for all that the room sees. Sides are met
/// counter-clockwise. Beams of no width are dropped: so a walk ends, and needles are not seen.
sl_status sli_walk_from(sli_walk *walk, uint32_t first, const sli_beam *within);

#endif

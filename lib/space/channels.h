/// Channels: the narrow places between walls, where a disc of some width gets stuck.
#ifndef SL_SPACE_CHANNELS_H
#define SL_SPACE_CHANNELS_H

#include "space/mesh.h"

/// The shortest way across a narrow place: from the end of a wall to another end, or to the foot
/// within a wall. A disc whose width is at least that of the channel does not pass between its
/// ends.
typedef struct sli_channel {
    sl_segment at;   ///< from an end to an end, or to the foot, which is rounded
    sl_segment wall; ///< with a foot: the wall; else at.b, twice
    double width;    ///< rounded
} sli_channel;

/// The free ground between walls as triangles. Their sides are walls, channels, or free.
typedef struct sli_channels {
    sl_box box; ///< the map's bounds with as much again around them
    SL_ARRAY(sli_channel) items;
    sli_triangulation triangles;
    uint32_t *label; ///< by edge (half / 2): SLI_FREE, SLI_WALL, or a channel, the narrowest there
    sl_bits *solid;  ///< by point: it lies on a wall
} sli_channels;

#define SLI_FREE UINT32_MAX
#define SLI_WALL (UINT32_MAX - 1)

/// Lists all channels up to the width `most` of a map whose walls are clean. Where there are up to
/// some thousands, other places that are as narrow may be among them. Shut or open, doors are walls
/// here, and so are entrances that are known (sl_glass.entrance). Walls are cut at feet. Time about
/// O(n log n) where few walls lie within `most` of each other. SL_UNSUPPORTED where walls or
/// channels cross a million times.
sl_status sli_channels_make(sl_context *context, const sl_map *map, double most, sli_channels *out);
void sli_channels_destroy(sl_context *context, sli_channels *channels); ///< and zeroes it

/// Whether a disc of a width does not pass a channel: the channel is at most that wide. Exact.
bool sli_channel_stops(const sli_channel *channel, double width);

#endif

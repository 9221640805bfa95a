/// What an eye sees, directly and by mirror, as polygons to be drawn.
#ifndef SEEN_PARTS_H
#define SEEN_PARTS_H

#include "sightline/draw.h"
#include "sightline/mirrored.h"

/// Adds the direct region, where `direct`, and all parts seen by mirror: arcs as chords.
/// What is added before a failure is left for sl_seen_parts_destroy.
typedef struct sl_seen_parts {
    sl_drawn_region *items;
    size_t count, capacity;
} sl_seen_parts;

sl_status sl_seen_parts_add(sl_context *context, const sl_space *space,
                            const sl_mirrored_region *region, bool direct, sl_seen_parts *parts);
/// Adds one region that is seen directly.
sl_status sl_seen_parts_add_region(sl_context *context, const sl_space *space,
                                   const sl_region *region, sl_seen_parts *parts);
void sl_seen_parts_destroy(sl_context *context, sl_seen_parts *parts);

#endif

/// What walls reveal that are taken away (reveal.c, along.c).
#ifndef SL_WORLD_REVEAL_H
#define SL_WORLD_REVEAL_H

#include "world/world_rows.h"

/// Where a cell lies, seen along a line: both where it has points on both sides, or on the line.
enum { SLI_RIGHT_OF_IT = 1, SLI_LEFT_OF_IT = 2 };

uint8_t sli_reveal_side(const sl_space *space, uint32_t cell, sl_segment line);

sl_status sli_reveal_pair(sl_context *context, sli_reveal_pairs *pairs, uint32_t place,
                          uint32_t other);

/// Gives places to the changed cells that stay, then to those of a region, and keeps searches
/// within these.
void sli_reveal_begin(sli_world_rows *rows, const sli_numbers *region);
void sli_reveal_end(sli_world_rows *rows, const sli_numbers *region);

/// Lists in `pairs` what lines along portals join now, and in `joined`, sorted, what they joined
/// before and no line joins now.
sl_status sli_reveal_along(sl_context *context, const sli_live *live, sli_world_rows *rows);

#endif

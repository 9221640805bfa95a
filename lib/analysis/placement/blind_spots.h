/// Blind spots: pieces of an overlay that are not seen, joined.
#ifndef SLI_BLIND_SPOTS_H
#define SLI_BLIND_SPOTS_H

#include "sightline/coverage.h"

/// The middle of a piece.
sl_point sli_piece_middle(const sl_space *pieces, uint32_t piece);

/// Joins the pieces that are blind, but not across the walls, which are the overlay's first shape.
/// Spots of an area over `negligible`, the largest first; `spots` by piece: its spot, or UINT32_MAX
/// for none. The caller frees both.
sl_status sli_blind_spots_find(sl_context *context, const sl_overlay *overlay, const bool *blind,
                               double negligible, uint32_t **spots, sl_blind_spot **found,
                               uint32_t *count);

#endif

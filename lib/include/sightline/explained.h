/// What a baked file adds to the explanation of a pair: what the file says, and the doors and the
/// glass on a way. And the JSON of it all, as `sightline explain --json` prints it.
#ifndef SIGHTLINE_EXPLAINED_H
#define SIGHTLINE_EXPLAINED_H

#include "sightline/bake.h"
#include "sightline/explain.h"

#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A pair that sl_explain_effects() has explained, and what it was asked of. Nothing is owned but
/// `e`, which sl_effect_explanation_destroy() frees.
typedef struct sl_explained {
    const sl_baked *baked;
    const bool *shut; ///< by door of the map, as it was explained
    sl_effect_explanation e;
} sl_explained;

/// What a file says about a pair. Nothing where the bake did not look from its first cell.
typedef enum sl_said { SL_SAID_NOTHING, SL_SAID_HIDDEN, SL_SAID_SEEN } sl_said;

/// What the file says about the pair, with the doors as they are.
SL_API sl_said sl_explained_said(const sl_explained *a);
/// Whether rounding decided in the file.
SL_API bool sl_explained_is_doubtful(const sl_explained *a);

/// What a way crosses: the portals of a sequence, or portals and mirrors.
typedef struct sl_way {
    const sl_sequence *sequence;
    const sl_bent_sightline *bent; ///< NULL: directly
    double length;
} sl_way;

/// The way of an explanation's sequence.
SL_API sl_way sl_way_direct(const sl_explanation *e);
/// The way of a sightline by mirror.
SL_API sl_way sl_way_bent(const sl_bent_sightline *bent);
/// The number of its steps.
SL_API uint32_t sl_way_count(const sl_way *way);
/// The directed portal of a step; UINT32_MAX for a mirror.
SL_API uint32_t sl_way_at(const sl_way *way, uint32_t step);
/// The seam of a kind that a step crosses; NULL for none, and for a mirror.
SL_API const sl_seam *sl_way_seam(const sl_space *space, const sl_way *way, uint32_t step,
                                  sl_seam_kind kind);
/// Marks the doors on a way, those that are shut or those that are open: a flag for each door of
/// the map. Whether there are any.
SL_API bool sl_way_doors(const sl_explained *a, const sl_way *way, bool shut, bool *marked);
/// Whether a step crosses one-way glass that is dark from where the way comes.
SL_API bool sl_way_is_dark(const sl_explained *a, const sl_way *way, uint32_t step);
/// Whether a door is marked, and no door of its name before it: names are listed once.
SL_API bool sl_door_is_first(const sl_map *map, const bool *marked, size_t door);

/// Writes the answer as one JSON object, with blanks and a line end behind it. Writes that the
/// stream refuses are left to its error flag. SL_NO_MEMORY before anything is written; SL_BAD_INPUT
/// where a number is not finite, which JSON cannot say.
SL_API sl_status sl_explained_json(sl_context *context, const sl_explained *a, FILE *stream);

#ifdef __cplusplus
}
#endif

#endif

/// A pair of cells explained: what the text and the JSON of `sightline explain` both tell of it.
#ifndef EXPLAIN_ANSWER_H
#define EXPLAIN_ANSWER_H

#include "sightline/bake.h"
#include "sightline/explain.h"

#include <stdio.h>
#include <string.h>

/// A pair explained, and what it was asked of.
typedef struct answer {
    const sl_baked *baked;
    bool *shut; ///< by door of the map
    sl_effect_explanation e;
} answer;

typedef enum said { SAID_NOTHING, SAID_HIDDEN, SAID_SEEN } said;

/// What the file says about the pair. Nothing where the bake did not look from the cell.
said said_by(const answer *a);
/// Whether rounding decided in the file.
bool is_doubtful(const answer *a);

/// The portals of a way: those of a sequence, or those between mirrors.
typedef struct way {
    const sl_sequence *sequence;
    const sl_bent_sightline *bent; ///< NULL: directly
    double length;
} way;

uint32_t way_count(const way *w);
/// The directed portal of a step; UINT32_MAX for a mirror.
uint32_t way_at(const way *w, uint32_t i);
way way_direct(const sl_explanation *e);
way way_bent(const sl_bent_sightline *bent);

/// Marks the doors on a way, those that are shut or those that are open. Whether there are any.
bool mark_doors(const answer *a, const way *w, bool shut, bool *marked);
/// Whether a door is marked, and no door of its name before it.
bool is_first(const sl_map *map, const bool *marked, size_t door);

/// The effects that can hide a pair.
enum { HIDING = 3 };
typedef struct hiding_effect {
    unsigned bit;
    const char *name, *what;
} hiding_effect;
extern const hiding_effect hiding[HIDING];

/// The seam of a kind that a directed portal of the space lies on; NULL for none.
const sl_seam *seam_of(const sl_space *space, uint32_t directed, sl_seam_kind kind);

// --- telling; `scratch` has a place for each door

void explanation_print(const answer *a, bool *scratch);
sl_status explanation_print_json(sl_context *context, const answer *a, bool *scratch, FILE *stream);

#endif

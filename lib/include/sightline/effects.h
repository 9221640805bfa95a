/// Effects: what a map may call for beside walls, and the plan of the work that follows from it.
/// What a map does not have costs it nothing; what a method does not know, it refuses by name.
#ifndef SIGHTLINE_EFFECTS_H
#define SIGHTLINE_EFFECTS_H

#include "sightline/space.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A bit for each effect, by its place in the table.
enum {
    SL_EFFECT_DOOR = 1,
    SL_EFFECT_MIRROR = 2,
    SL_EFFECT_ONEWAY = 4,
    SL_EFFECT_RANGE = 8,
};

/// An effect: reachable by name, listed everywhere from the table.
typedef struct sl_effect {
    const char *name;    ///< "mirror"
    const char *several; ///< "mirrors"
    const char *adds;    ///< what it adds to the work
    const char *without; ///< what holds where it is left out
    bool mutual;         ///< with it, who is seen sees as well
    size_t (*count)(const sl_map *map);
    uint32_t (*line)(const sl_map *map); ///< of the first, 0 where unknown; only if there is one
    void (*leave_out)(sl_context *context, sl_map *map);
} sl_effect;

/// All effects: "door", "mirror", "oneway", "range".
SL_API const sl_effect *const *sl_effects(size_t *count);

/// The plan: what a map calls for. It is made once, and asked by each stage as it begins.
typedef struct sl_plan {
    unsigned effects;      ///< bits
    bool mutual;           ///< whether who is seen sees as well: pairs are symmetric
    double range;          ///< nothing farther than this is seen; 0 for no limit
    const sl_map *map;     ///< that it was made of, and must outlive it
    uint32_t mirror_depth; ///< reflections of a sightline, at most; 1 by itself
    uint32_t door_limit;   ///< sets of doors kept of a pair, at most; 16 by itself, 0: none
} sl_plan;

/// The plan of a map; it never fails.
SL_API sl_plan sl_plan_make(const sl_map *map);

/// Whether two maps have the same effects, in the same order: doors (open or shut as they may be),
/// mirrors, one-way glass and the view range.
SL_API bool sl_effects_same(const sl_map *a, const sl_map *b);

/// Takes effects out of a map, and notes what was taken.
SL_API void sl_effects_leave_out(sl_context *context, sl_map *map, unsigned effects);

/// Doors as they stand, for methods that know no doors: walls take the place of those that are
/// shut, and open ones go. It is noted. Rooms that no start reaches but through a shut door are
/// outside then. Clean the map after it.
SL_API sl_status sl_effects_settle_doors(sl_context *context, sl_map *map);
/// The note alone: how many doors are open, how many are shut.
SL_API void sl_effects_note_doors(sl_context *context, const sl_map *map);

/// SL_UNSUPPORTED, with what to do about it, where a map calls for more than `known`. `method` is
/// what messages call the method; `reason`, which may be NULL, is why it does not know an effect:
/// "its lines end at walls alone".
SL_API sl_status sl_effects_check(sl_context *context, const sl_map *map, const char *method,
                                  unsigned known, const char *reason);

#ifdef __cplusplus
}
#endif

#endif

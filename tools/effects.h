/// What a map may call for beside walls. No method knows any of it yet: it is refused by name or,
/// at the user's word, left out.
#ifndef EFFECTS_H
#define EFFECTS_H

#include "options.h"
#include "sightline/map.h"

typedef struct sl_effect {
    const char *name;    ///< as --without takes it: "mirror"
    const char *several; ///< "mirrors"
    const char *without; ///< what then holds: "sight passes where they stand"
    size_t (*count)(const sl_map *map);
    uint32_t (*line)(const sl_map *map); ///< of the first, 0 where unknown
    void (*leave_out)(sl_context *context, sl_map *map);
} sl_effect;

/// For sl_option_choices: an array of sl_effect.
sl_name_table sl_effect_table(void);

/// A bit for each effect of the table that the map calls for.
unsigned sl_effects_of_map(const sl_map *map);

/// Takes the effects out of the map and notes what was taken.
void sl_effects_leave_out(sl_context *context, sl_map *map, unsigned effects);

/// SL_UNSUPPORTED, with what to do about it, where the map still calls for any.
sl_status sl_effects_check(sl_context *context, const sl_map *map, const char *method);

#endif

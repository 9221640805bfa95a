/// The plan of the work that a map calls for, as text and for programs.
#ifndef PLAN_REPORT_H
#define PLAN_REPORT_H

#include "json_print.h"
#include "names.h"
#include "sightline/effects.h"

/// The names of all effects; what the table points to is the caller's.
typedef struct sl_effect_names {
    const char *names[32];
} sl_effect_names;

sl_name_table sl_effect_table(sl_effect_names *names);

/// What a map calls for, what each adds to the work, and what is left out as nothing calls for it.
void sl_plan_print(const sl_map *map);

/// "effects": a flag for each.
void sl_plan_add_json(sl_json_fields *fields, const sl_map *map);

#endif

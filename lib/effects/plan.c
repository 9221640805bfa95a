/// The table of effects, and what is planned from it.
#include "effects/effects.h"

#include <stdio.h>
#include <string.h>

static const sl_effect *const table[] = {&sl_effect_door, &sl_effect_mirror, &sl_effect_oneway,
                                         &sl_effect_range};

const sl_effect *const *sl_effects(size_t *count) {
    *count = sizeof table / sizeof *table;
    return table;
}

static bool calls_for(const sl_map *map, unsigned effects, size_t i) {
    return effects >> i & 1 && table[i]->count(map);
}

sl_plan sl_plan_make(const sl_map *map) {
    sl_plan plan = {
        .mutual = true, .range = map->range, .map = map, .mirror_depth = 1, .door_limit = 16};
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        if (!calls_for(map, UINT32_MAX, i)) continue;
        plan.effects |= 1u << i;
        plan.mutual &= table[i]->mutual;
    }
    return plan;
}

void sl_effects_leave_out(sl_context *context, sl_map *map, unsigned effects) {
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        if (!calls_for(map, effects, i)) continue;
        sl_note(context, "left out: %s (%zu); %s", table[i]->several, table[i]->count(map),
                table[i]->without);
        table[i]->leave_out(context, map);
    }
}

/// "doors, mirrors and a view range"
static void append(char *text, size_t size, const char *between, const char *more) {
    const size_t used = strlen(text);
    snprintf(text + used, size - used, "%s%s", used ? between : "", more);
}

sl_status sl_effects_check(sl_context *context, const sl_map *map, const char *method,
                           unsigned known) {
    const unsigned unknown = sl_plan_make(map).effects & ~known;
    if (!unknown) return SL_OK;
    char several[128] = "", names[64] = "", line[16] = "";
    uint32_t first = UINT32_MAX;
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        if (!calls_for(map, unknown, i)) continue;
        append(several, sizeof several, unknown >> (i + 1) ? ", " : " and ", table[i]->several);
        append(names, sizeof names, ",", table[i]->name);
        if (table[i]->line(map) < first) first = table[i]->line(map);
    }
    // A map out of a baked file has no lines that anyone could look up.
    if (first && map->source) snprintf(line, sizeof line, "%u:", (unsigned)first);
    const char *source = map->source ? map->source : "", *colon = map->source ? ":" : "";
    const char *space = map->source ? " " : "", *bake = map->source ? "" : "bake ";
    const char *them = unknown == SL_EFFECT_RANGE ? "it" : "them";
    return sl_fail(context, SL_UNSUPPORTED,
                   "%s%s%s%sthe map calls for %s, which '%s' does not know; "
                   "%s--without %s leaves %s out",
                   source, colon, line, space, several, method, bake, names, them);
}

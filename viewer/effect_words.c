#include "effect_words.h"

#include <stdio.h>
#include <string.h>

static void append(char text[CALLS_TEXT], const char *before, const char *more) {
    const size_t used = strlen(text);
    snprintf(text + used, CALLS_TEXT - used, "%s%s", before, more);
}

void effects_left_out(const sl_map *map, char text[CALLS_TEXT]) {
    size_t count;
    const sl_effect *const *effects = sl_effects(&count);
    const unsigned called_for = sl_plan_make(map).effects;
    text[0] = '\0';
    for (size_t i = 0; i < count; i++)
        if (!(called_for >> i & 1)) append(text, *text ? ", " : "", effects[i]->several);
}

void effects_in_words(const sl_map *map, char text[CALLS_TEXT]) {
    size_t count;
    const sl_effect *const *effects = sl_effects(&count);
    const unsigned called_for = sl_plan_make(map).effects;
    if (!called_for) {
        char none[CALLS_TEXT];
        effects_left_out(map, none);
        snprintf(text, CALLS_TEXT, "nothing calls for %.120s", none);
        return;
    }
    text[0] = '\0';
    for (size_t i = 0; i < count; i++) {
        char counted[64];
        if (!(called_for >> i & 1)) continue;
        snprintf(counted, sizeof counted, "%s (%zu)", effects[i]->several, effects[i]->count(map));
        append(text, *text ? ", " : "calls for ", counted);
    }
}

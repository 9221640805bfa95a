#include "plan_report.h"

#include <stdio.h>

sl_name_table sl_effect_table(sl_effect_names *names) {
    size_t count;
    const sl_effect *const *effects = sl_effects(&count);
    for (size_t i = 0; i < count; i++) names->names[i] = effects[i]->name;
    return (sl_name_table){"effect", names->names, sizeof *names->names, count};
}

void sl_plan_print(const sl_map *map) {
    size_t count;
    const sl_effect *const *effects = sl_effects(&count);
    const unsigned called_for = sl_plan_make(map).effects;
    const char *lead = "  plan      ";
    for (size_t i = 0; i < count; i++) {
        if (!(called_for >> i & 1)) continue;
        printf("%s%s (%zu): %s\n", lead, effects[i]->several, effects[i]->count(map),
               effects[i]->adds);
        lead = "            ";
    }
    const char *between = called_for ? "nothing calls for " : "walls alone; nothing calls for ";
    for (size_t i = 0; i < count; i++) {
        if (called_for >> i & 1) continue;
        printf("%s%s%s", lead, between, effects[i]->several);
        lead = "";
        between = ", ";
    }
    if (!*lead) putchar('\n');
}

void sl_plan_add_json(sl_json_fields *fields, const sl_map *map) {
    size_t count;
    const sl_effect *const *effects = sl_effects(&count);
    const unsigned called_for = sl_plan_make(map).effects;
    sl_json_fields calls = sl_json_begin();
    for (size_t i = 0; i < count; i++)
        sl_json_add_flag(&calls, effects[i]->name, called_for >> i & 1);
    sl_json_add_fields(fields, "effects", &calls);
}

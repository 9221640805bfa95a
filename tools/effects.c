#include "effects.h"

#include "base/base.h"

#include <string.h>

static size_t count_doors(const sl_map *map) {
    return map->door_count;
}

static uint32_t line_of_doors(const sl_map *map) {
    return map->doors[0].line;
}

static void leave_out_doors(sl_context *context, sl_map *map) {
    for (size_t i = 0; i < map->door_count; i++) sl_free(context, map->doors[i].name);
    map->door_count = 0;
}

static size_t count_mirrors(const sl_map *map) {
    return map->mirror_count;
}

static uint32_t line_of_mirrors(const sl_map *map) {
    return map->mirrors[0].line;
}

static void leave_out_mirrors(sl_context *context, sl_map *map) {
    (void)context;
    map->mirror_count = 0;
}

static size_t count_oneways(const sl_map *map) {
    return map->oneway_count;
}

static uint32_t line_of_oneways(const sl_map *map) {
    return map->oneways[0].line;
}

static void leave_out_oneways(sl_context *context, sl_map *map) {
    (void)context;
    map->oneway_count = 0;
}

static size_t count_range(const sl_map *map) {
    return map->range > 0;
}

static uint32_t line_of_range(const sl_map *map) {
    return map->range_line;
}

static void leave_out_range(sl_context *context, sl_map *map) {
    (void)context;
    map->range = 0;
    map->range_line = 0;
}

static const sl_effect effects[] = {
    {"door", "doors", "open passages stand in their place", count_doors, line_of_doors,
     leave_out_doors},
    {"mirror", "mirrors", "sight passes where they stand", count_mirrors, line_of_mirrors,
     leave_out_mirrors},
    {"oneway", "one-way glass", "sight passes it both ways", count_oneways, line_of_oneways,
     leave_out_oneways},
    {"range", "a view range", "sight reaches any distance", count_range, line_of_range,
     leave_out_range},
};
enum { EFFECT_COUNT = sizeof effects / sizeof *effects };

sl_name_table sl_effect_table(void) {
    return (sl_name_table){"effect", effects, sizeof *effects, EFFECT_COUNT};
}

unsigned sl_effects_of_map(const sl_map *map) {
    unsigned called_for = 0;
    for (unsigned i = 0; i < EFFECT_COUNT; i++)
        if (effects[i].count(map)) called_for |= 1u << i;
    return called_for;
}

void sl_effects_leave_out(sl_context *context, sl_map *map, unsigned left_out) {
    const unsigned present = left_out & sl_effects_of_map(map);
    for (unsigned i = 0; i < EFFECT_COUNT; i++) {
        if (!(present >> i & 1)) continue;
        sl_note(context, "left out: %s (%zu); %s", effects[i].several, effects[i].count(map),
                effects[i].without);
        effects[i].leave_out(context, map);
    }
}

/// "doors, mirrors and a view range"
static void append(char *text, size_t size, const char *between, const char *more) {
    const size_t used = strlen(text);
    snprintf(text + used, size - used, "%s%s", used ? between : "", more);
}

sl_status sl_effects_check(sl_context *context, const sl_map *map, const char *method) {
    const unsigned present = sl_effects_of_map(map);
    if (!present) return SL_OK;
    char several[128] = "", names[64] = "", line[16] = "";
    uint32_t first = UINT32_MAX;
    for (unsigned i = 0; i < EFFECT_COUNT; i++) {
        if (!(present >> i & 1)) continue;
        append(several, sizeof several, present >> (i + 1) ? ", " : " and ", effects[i].several);
        append(names, sizeof names, ",", effects[i].name);
        if (effects[i].line(map) < first) first = effects[i].line(map);
    }
    if (first) snprintf(line, sizeof line, "%u:", (unsigned)first);
    return sl_fail(context, SL_UNSUPPORTED,
                   "%s:%s the map calls for %s, which the method '%s' does not know; "
                   "--without %s leaves %s out",
                   map->source ? map->source : "the map", line, several, method, names,
                   strcmp(names, "range") == 0 ? "it" : "them");
}

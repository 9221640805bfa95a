/// The table of effects, and the plan of a map: which effects its bake needs.
///
/// A map declares its doors, mirrors, one-way glass and view range. The plan has a bit for each
/// effect that the map has. A map without any has an empty plan, and no stage does work for
/// effects.
#include "effects/effects.h"
#include "map/source.h"

#include <stdio.h>
#include <string.h>

// --- doors

static size_t count_door(const sl_map *map) {
    return map->door_count;
}

static uint32_t line_of_door(const sl_map *map) {
    return map->doors[0].line;
}

static void leave_out_door(sl_context *context, sl_map *map) {
    for (size_t i = 0; i < map->door_count; i++) {
        sl_free(context, map->doors[i].name);
        sl_free(context, map->doors[i].parts);
    }
    map->door_count = 0;
}

static const sl_effect door_effect = {
    .name = "door",
    .several = "doors",
    .adds = "cells end at doors; each pair keeps the sets of doors that it is seen through",
    .without = "open passages stand in their place",
    .mutual = true,
    .count = count_door,
    .line = line_of_door,
    .leave_out = leave_out_door,
};

// --- mirrors

static size_t count_mirror(const sl_map *map) {
    return map->mirror_count;
}

static uint32_t line_of_mirror(const sl_map *map) {
    return map->mirrors[0].line;
}

static void leave_out_mirror(sl_context *context, sl_map *map) {
    (void)context;
    map->mirror_count = 0;
}

static const sl_effect mirror_effect = {
    .name = "mirror",
    .several = "mirrors",
    .adds = "mirrors are walls that sequences go on from, reflected",
    .without = "sight passes where they stand",
    .mutual = true,
    .count = count_mirror,
    .line = line_of_mirror,
    .leave_out = leave_out_mirror,
};

// --- one-way glass

static size_t count_oneway(const sl_map *map) {
    return map->oneway_count;
}

static uint32_t line_of_oneway(const sl_map *map) {
    return map->oneways[0].line;
}

static void leave_out_oneway(sl_context *context, sl_map *map) {
    (void)context;
    map->oneway_count = 0;
}

static const sl_effect oneway_effect = {
    .name = "oneway",
    .several = "one-way glass",
    .adds = "cells end at glass; sequences cross it one way, pairs are no longer mutual",
    .without = "sight passes it both ways",
    .mutual = false,
    .count = count_oneway,
    .line = line_of_oneway,
    .leave_out = leave_out_oneway,
};

// --- the view range

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

static const sl_effect range_effect = {
    .name = "range",
    .several = "a view range",
    .adds = "each sequence's shortest sightline is held against the range",
    .without = "sight reaches any distance",
    .mutual = true,
    .count = count_range,
    .line = line_of_range,
    .leave_out = leave_out_range,
};

// --- the plan

static const sl_effect *const table[] = {&door_effect, &mirror_effect, &oneway_effect,
                                         &range_effect};

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

static bool same_segment(sl_segment a, sl_segment b) {
    return a.a.x == b.a.x && a.a.y == b.a.y && a.b.x == b.b.x && a.b.y == b.b.y;
}

static bool same_door(const sl_door *a, const sl_door *b) {
    return strcmp(a->name, b->name) == 0 && same_segment(a->segment, b->segment);
}

static bool same_glass(const sl_glass *a, const sl_glass *b, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (a[i].one_sided != b[i].one_sided || !same_segment(a[i].segment, b[i].segment))
            return false;
    return true;
}

bool sl_effects_same(const sl_map *a, const sl_map *b) {
    if (a->range != b->range || a->door_count != b->door_count ||
        a->mirror_count != b->mirror_count || a->oneway_count != b->oneway_count)
        return false;
    for (size_t i = 0; i < a->door_count; i++)
        if (!same_door(&a->doors[i], &b->doors[i])) return false;
    return same_glass(a->mirrors, b->mirrors, a->mirror_count) &&
           same_glass(a->oneways, b->oneways, a->oneway_count);
}

void sl_effects_leave_out(sl_context *context, sl_map *map, unsigned effects) {
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        if (!calls_for(map, effects, i)) continue;
        sl_note(context, "left out: %s (%zu); %s", table[i]->several, table[i]->count(map),
                table[i]->without);
        table[i]->leave_out(context, map);
    }
}

void sl_effects_note_doors(sl_context *context, const sl_map *map) {
    size_t shut = 0;
    for (size_t i = 0; i < map->door_count; i++) shut += !map->doors[i].open;
    if (map->door_count)
        sl_note(context, "doors stand as the map has them: %zu open, %zu shut, which are walls",
                map->door_count - shut, shut);
}

static sl_status settle(sl_context *context, sl_map *map, const sl_door *door) {
    const sl_segment *parts = door->parts ? door->parts : &door->segment;
    const size_t count = door->parts ? door->part_count : 1;
    for (size_t i = 0; i < count && !door->open; i++)
        SL_TRY(sl_map_add_wall(context, map, parts[i].a, parts[i].b, door->line));
    return SL_OK;
}

sl_status sl_effects_settle_doors(sl_context *context, sl_map *map) {
    sl_effects_note_doors(context, map);
    for (size_t i = 0; i < map->door_count; i++) SL_TRY(settle(context, map, &map->doors[i]));
    leave_out_door(context, map);
    return SL_OK;
}

/// "doors, mirrors and a view range"
static void append(char *text, size_t size, const char *between, const char *more) {
    const size_t used = strlen(text);
    snprintf(text + used, size - used, "%s%s", used ? between : "", more);
}

sl_status sl_effects_check(sl_context *context, const sl_map *map, const char *method,
                           unsigned known, const char *reason) {
    const unsigned unknown = sl_plan_make(map).effects & ~known;
    if (!unknown) return SL_OK;
    char several[128] = "", names[64] = "";
    uint32_t first = UINT32_MAX;
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        if (!calls_for(map, unknown, i)) continue;
        append(several, sizeof several, unknown >> (i + 1) ? ", " : " and ", table[i]->several);
        append(names, sizeof names, ",", table[i]->name);
        if (table[i]->line(map) < first) first = table[i]->line(map);
    }
    const char *bake = map->source.name ? "" : "bake ";
    const char *them = unknown == SL_EFFECT_RANGE ? "it" : "them";
    char what[512];
    snprintf(what, sizeof what,
             "the map calls for %s, which '%s' does not know%s%s; %s--without %s leaves %s out",
             several, method, reason ? ": " : "", reason ? reason : "", bake, names, them);
    // A map out of a baked file has no lines that anyone could look up.
    if (!map->source.name) return sl_fail(context, SL_UNSUPPORTED, "%s", what);
    return sli_map_fail(context, map, SL_UNSUPPORTED, first, "%s", what);
}

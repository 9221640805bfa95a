#include "effects/effects.h"

static size_t count(const sl_map *map) {
    return map->door_count;
}

static uint32_t line(const sl_map *map) {
    return map->doors[0].line;
}

static void leave_out(sl_context *context, sl_map *map) {
    for (size_t i = 0; i < map->door_count; i++) {
        sl_free(context, map->doors[i].name);
        sl_free(context, map->doors[i].parts);
    }
    map->door_count = 0;
}

const sl_effect sl_effect_door = {
    .name = "door",
    .several = "doors",
    .adds = "cells end at doors; each pair keeps the sets of doors that it is seen through",
    .without = "open passages stand in their place",
    .mutual = true,
    .count = count,
    .line = line,
    .leave_out = leave_out,
};

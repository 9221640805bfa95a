#include "effects/effects.h"

static size_t count(const sl_map *map) {
    return map->range > 0;
}

static uint32_t line(const sl_map *map) {
    return map->range_line;
}

static void leave_out(sl_context *context, sl_map *map) {
    (void)context;
    map->range = 0;
    map->range_line = 0;
}

const sl_effect sl_effect_range = {
    .name = "range",
    .several = "a view range",
    .adds = "each sequence's shortest sightline is held against the range",
    .without = "sight reaches any distance",
    .mutual = true,
    .count = count,
    .line = line,
    .leave_out = leave_out,
};

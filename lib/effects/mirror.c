#include "effects/effects.h"

static size_t count(const sl_map *map) {
    return map->mirror_count;
}

static uint32_t line(const sl_map *map) {
    return map->mirrors[0].line;
}

static void leave_out(sl_context *context, sl_map *map) {
    (void)context;
    map->mirror_count = 0;
}

const sl_effect sl_effect_mirror = {
    .name = "mirror",
    .several = "mirrors",
    .adds = "mirrors are walls that sequences go on from, reflected",
    .without = "sight passes where they stand",
    .mutual = true,
    .count = count,
    .line = line,
    .leave_out = leave_out,
};

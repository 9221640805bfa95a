#include "sightline/space.h"

static sl_status by_kd(sl_context *context, const sl_map *map, const sl_subdivide_options *rules,
                       sl_space *out) {
    const sl_subdivide_options usual = sl_subdivide_options_default();
    return sl_subdivide_kd(context, map, rules ? rules : &usual, out);
}

static sl_status by_bsp(sl_context *context, const sl_map *map, const sl_subdivide_options *rules,
                        sl_space *out) {
    (void)rules;
    const sl_bsp_options options = sl_bsp_options_default();
    return sl_subdivide_bsp(context, map, &options, out);
}

static const sl_subdivision subdivisions[] = {
    {"kd", "kd-tree on the walls' own lines; walls must be axial", true, by_kd},
    {"bsp", "binary space partition on the walls' own lines; walls may be oblique", false, by_bsp},
};
enum { KD, BSP };

const sl_subdivision *sl_subdivisions(size_t *count) {
    *count = sizeof subdivisions / sizeof *subdivisions;
    return subdivisions;
}

const sl_subdivision *sl_subdivision_for(const sl_map *map) {
    return &subdivisions[sl_map_count_oblique(map) ? BSP : KD];
}

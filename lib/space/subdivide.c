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

static sl_status as_given(sl_context *context, const sl_map *map, const sl_subdivide_options *rules,
                          sl_space *out) {
    (void)rules;
    return sl_subdivide_given(context, map, out);
}

static const sl_subdivision subdivisions[] = {
    {.name = "kd",
     .what = "kd-tree on the walls' own lines; walls must be axial",
     .takes_rules = true,
     .subdivide = by_kd},
    {.name = "bsp",
     .what = "binary space partition on the walls' own lines; walls may be oblique",
     .subdivide = by_bsp},
    {.name = "given",
     .what = "the cells that the file brings: 'cell' of a map text, GL nodes of a WAD",
     .takes_cells = true,
     .subdivide = as_given},
};
enum { KD, BSP, GIVEN };

const sl_subdivision *sl_subdivisions(size_t *count) {
    *count = sizeof subdivisions / sizeof *subdivisions;
    return subdivisions;
}

static bool is_oblique(sl_segment at) {
    return at.a.x != at.b.x && at.a.y != at.b.y;
}

/// Whether all that cuts cells is axial.
static bool is_axial(const sl_map *map) {
    bool oblique = sl_map_count_oblique(map) > 0;
    for (size_t i = 0; i < map->door_count; i++) oblique |= is_oblique(map->doors[i].segment);
    for (size_t i = 0; i < map->oneway_count; i++) oblique |= is_oblique(map->oneways[i].segment);
    for (size_t i = 0; i < map->seam_count; i++) oblique |= is_oblique(map->seams[i].segment);
    return !oblique;
}

const sl_subdivision *sl_subdivision_for(const sl_map *map) {
    return &subdivisions[map->cell_count ? GIVEN : is_axial(map) ? KD : BSP];
}

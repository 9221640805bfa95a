/// The table of the ways to subdivide a map, and which of them is meant for it.
#include "space/subdivide.h"

#include "sightline/support.h"

sl_subdivide_options sl_subdivide_options_default(void) {
    return (sl_subdivide_options){
        .spanning = true, .obscured = 0.2, .cleaving = true, .median = true};
}

static sl_status by_kd(sl_context *context, const sl_map *map, const sl_subdivide_options *rules,
                       sl_space *out) {
    const sl_subdivide_options usual = sl_subdivide_options_default();
    return sli_subdivide_kd(context, map, rules ? rules : &usual, out);
}

static sl_status by_mesh(sl_context *context, const sl_map *map, const sl_subdivide_options *rules,
                         sl_space *out) {
    (void)rules;
    return sli_subdivide_mesh(context, map, out);
}

static sl_status as_given(sl_context *context, const sl_map *map, const sl_subdivide_options *rules,
                          sl_space *out) {
    (void)rules;
    return sli_subdivide_given(context, map, out);
}

static const sl_subdivision subdivisions[] = {
    {.name = "kd",
     .what = "kd-tree on the walls' own lines; walls must be axial",
     .takes_rules = true,
     .subdivide = by_kd},
    {.name = "mesh",
     .what = "constrained triangulation, triangles merged to convex cells; walls may be oblique",
     .subdivide = by_mesh},
    {.name = "given",
     .what = "the cells that the file brings: 'cell' of a map text, GL nodes of a WAD",
     .takes_cells = true,
     .subdivide = as_given},
};
enum { KD, MESH, GIVEN };

const sl_subdivision *sl_subdivisions(size_t *count) {
    *count = sizeof subdivisions / sizeof *subdivisions;
    return subdivisions;
}

const sl_subdivision *sl_subdivision_for(const sl_map *map) {
    return &subdivisions[map->cell_count ? GIVEN : sl_map_is_axial(map) ? KD : MESH];
}

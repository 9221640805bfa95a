#include "studies/vga_steps.h"

sl_status vga_steps_make(sl_context *context, const sl_baked *sight, const door_choice *doors,
                         vga_steps *out) {
    sl_map map = {0};
    sl_bake_options options = sl_bake_options_default();
    if (!sl_map_steps_differ(&sight->map)) return SL_OK;
    sl_status status = sl_baked_copy_map(context, sight, &map);
    map.channel = SL_STOPS_STEPS;
    if (status == SL_OK) status = sl_bake_space(context, &map, &options, &out->baked, NULL);
    sl_map_destroy(context, &map);
    if (status == SL_OK) status = doors_shut(context, doors, &out->baked);
    if (status == SL_OK)
        status = sl_query_over(context, &out->baked.space, &out->baked.map, NULL, &out->query);
    if (status == SL_OK) status = sl_query_outline(context, out->query, &out->outline);
    if (status == SL_OK)
        sl_note(context, "some walls stop steps and not sight, or sight and not steps: the grid, "
                         "paths and agents go by steps, other measures by sight");
    return status;
}

void vga_steps_destroy(sl_context *context, vga_steps *steps) {
    sl_vga_graph_destroy(context, &steps->graph);
    sl_query_destroy(context, steps->query);
    sl_baked_destroy(context, &steps->baked);
}

sl_status vga_steps_connect(sl_context *context, const vga_steps *steps, const sl_vga_grid *grid,
                            const sl_vga_graph *sights, unsigned threads, sl_vga_graph *out) {
    SL_TRY(sl_vga_graph_make(context, steps->outline, grid, 0, threads, out));
    if (!sights) return SL_OK;
    out->edges = 0;
    for (size_t i = 0; i < out->count * out->words; i++) {
        out->rows[i] &= sights->rows[i];
        out->edges += (uint64_t)__builtin_popcountll(out->rows[i]);
    }
    return SL_OK;
}

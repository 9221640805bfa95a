#include "within.h"

option_table within_option_table(within_plan *plan) {
    const option_spec options[] = {
        {"within", 0, "MAP",
         "only grid points within the closed outlines of a drawing or map; the file may be the map "
         "itself",
         .text = &plan->path, .rare = true},
        {"within-layers", 0, "LAYER,...", "which layers of the --within drawing to read",
         .text = &plan->layers, .rare = true},
    };
    option_table table = {0};
    option_table_add(&table, options, sizeof options / sizeof *options);
    option_table_topic(&table, "points");
    return table;
}

sl_status within_check(sl_context *context, const within_plan *plan) {
    if (!plan->layers || plan->path) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT, "--within-layers is for --within MAP");
}

sl_status within_read(sl_context *context, const within_plan *plan, const input_options *input,
                      sl_map *outlines) {
    input_options own = *input;
    if (plan->layers) own.import.layers = plan->layers;
    return input_read_either(context, plan->path, &own, outlines);
}

/// Whether a ray to the right of a point crosses a wall. Exact; a wall that the point lies on is
/// not crossed.
static bool is_crossed(sl_point p, const sl_wall *w) {
    if ((w->a.y > p.y) == (w->b.y > p.y)) return false;
    const sl_point low = w->a.y < w->b.y ? w->a : w->b, high = w->a.y < w->b.y ? w->b : w->a;
    return sl_orient(low, high, p) > 0;
}

bool within_has(const sl_map *outlines, sl_point point) {
    bool within = false;
    for (size_t i = 0; i < outlines->wall_count; i++)
        within ^= is_crossed(point, &outlines->walls[i]);
    return within;
}

sl_status within_fail(sl_context *context, const within_plan *plan) {
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "--within %s: no point of the grid is within its outlines", plan->path);
}

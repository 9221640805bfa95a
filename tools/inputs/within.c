/// Cuts a plan, or a space, to what lies within outlines.
#include "inputs/within.h"

#include "sightline/support.h"

#include <stdlib.h>

option_table within_option_table(within_plan *plan, const char *help) {
    const option_spec options[] = {
        {"within", 0, "MAP", help, .text = &plan->path, .is_input = true, .rare = true},
        {"within-layers", 0, "LAYER,...", "which layers of the --within drawing to read",
         .text = &plan->layers, .rare = true},
    };
    option_table table = {0};
    option_table_add(&table, options, sizeof options / sizeof *options);
    option_table_topic(&table, "part of the plan");
    return table;
}

sl_status within_check(sl_context *context, const within_plan *plan) {
    if (!plan->layers || plan->path) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT, "--within-layers is for --within MAP");
}

static int compare_points(const void *left, const void *right) {
    const sl_point *a = left, *b = right;
    return a->x != b->x ? (a->x > b->x) - (a->x < b->x) : (a->y > b->y) - (a->y < b->y);
}

/// Notes the first place at which an odd number of walls ends: an outline that is not closed.
static sl_status note_open(sl_context *context, const within_plan *plan, const sl_map *outlines) {
    const size_t count = 2 * outlines->wall_count;
    sl_point *ends = sl_alloc_array(context, count + 1, sizeof *ends);
    if (!ends) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++)
        ends[i] = i % 2 ? outlines->walls[i / 2].b : outlines->walls[i / 2].a;
    qsort(ends, count, sizeof *ends, compare_points);
    for (size_t i = 0, next; i < count; i = next) {
        for (next = i + 1; next < count && compare_points(&ends[i], &ends[next]) == 0;) next++;
        if ((next - i) % 2 == 0) continue;
        sl_note(context,
                "--within %s: an outline is not closed at %.9g,%.9g; what is within may be wrong",
                plan->path, ends[i].x, ends[i].y);
        break;
    }
    sl_free(context, ends);
    return SL_OK;
}

sl_status within_read(sl_context *context, const within_plan *plan, const input_options *input,
                      sl_map *outlines) {
    input_options own = *input;
    if (plan->layers) own.import.layers = plan->layers;
    own.import.all_layers = true; // outlines, whatever they are called
    SL_TRY(input_read_either(context, plan->path, &own, outlines));
    sl_status status = input_take_lines(context, outlines);
    if (status == SL_OK) status = note_open(context, plan, outlines);
    if (status != SL_OK) sl_map_destroy(context, outlines);
    return status;
}

bool within_crosses(sl_point p, sl_point a, sl_point b) {
    if ((a.y > p.y) == (b.y > p.y)) return false;
    return sl_orient(a.y < b.y ? a : b, a.y < b.y ? b : a, p) > 0;
}

bool within_has(const sl_map *outlines, sl_point point) {
    bool within = false;
    for (size_t i = 0; i < outlines->wall_count; i++)
        within ^= within_crosses(point, outlines->walls[i].a, outlines->walls[i].b);
    return within;
}

sl_status within_fail(sl_context *context, const within_plan *plan) {
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "--within %s: no point of the grid is within its outlines", plan->path);
}

// --- a space

static sl_status add_walls(sl_context *context, const sl_wall *walls, size_t count, sl_map *map) {
    for (size_t i = 0; i < count; i++)
        SL_TRY(sl_map_add_wall(context, map, walls[i].a, walls[i].b, 0));
    return SL_OK;
}

static void choose_inside(const sl_space *plan, const sl_map *outlines, sl_space *space) {
    space->inside_count = 0;
    for (uint32_t c = 0; c < space->cell_count; c++) {
        sl_cell *cell = &space->cells[c];
        const sl_point middle = sl_space_middle(space, c);
        const uint32_t of_plan = sl_space_locate(plan, middle);
        cell->inside =
            of_plan != SL_NO_CELL && plan->cells[of_plan].inside && within_has(outlines, middle);
        space->inside_count += cell->inside;
    }
}

sl_status within_space(sl_context *context, const within_plan *plan, const input_options *input,
                       const sl_space *space, sl_space *out) {
    sl_map outlines = {0}, map = {0};
    SL_TRY(within_read(context, plan, input, &outlines));
    sl_status status = add_walls(context, space->walls, space->wall_count, &map);
    if (status == SL_OK) status = add_walls(context, outlines.walls, outlines.wall_count, &map);
    map.precision = outlines.precision;
    if (status == SL_OK) status = input_clean(context, input, &map, NULL);
    if (status == SL_OK) status = sl_subdivision_for(&map)->subdivide(context, &map, NULL, out);
    if (status == SL_OK) choose_inside(space, &outlines, out);
    if (status == SL_OK && !out->inside_count)
        status = sl_fail(context, SL_BAD_ARGUMENT,
                         "--within %s: nothing that is inside is within its outlines", plan->path);
    sl_map_destroy(context, &outlines);
    sl_map_destroy(context, &map);
    return status;
}

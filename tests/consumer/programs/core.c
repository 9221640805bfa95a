// What a program does with the core: a map made by hand, cleaned, cut into cells, asked.
#include <sightline/sightline.h>

#include <stdio.h>

// Two rooms of 10 x 10 with a gap of 2 between them.
static const double walls[][4] = {
    {0, 0, 20, 0}, {20, 0, 20, 10}, {20, 10, 0, 10}, {0, 10, 0, 0}, {10, 0, 10, 4}, {10, 6, 10, 10},
};

static sl_status cut(sl_context *context, sl_map *map, sl_space *space) {
    for (size_t i = 0; i < sizeof walls / sizeof *walls; i++) {
        sl_point a = {walls[i][0], walls[i][1]}, b = {walls[i][2], walls[i][3]};
        sl_status status = sl_map_add_wall(context, map, a, b, 0);
        if (status != SL_OK) return status;
    }
    sl_status status = sl_map_clean(context, map, NULL, NULL);
    if (status != SL_OK) return status;
    sl_subdivide_options options = sl_subdivide_options_default();
    status = sl_subdivide_kd(context, map, &options, space);
    return status == SL_OK ? sl_space_check(context, space) : status;
}

// Whether each room sees the other.
static sl_status look(sl_context *context, const sl_space *space, bool *seen) {
    uint32_t left = sl_space_locate(space, (sl_point){5, 5});
    uint32_t right = sl_space_locate(space, (sl_point){15, 5});
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    sl_visibility visibility = {0};
    size_t count;
    sl_status status = sl_see_methods(&count)[0].see(context, space, &options, &visibility);
    if (status != SL_OK) return status;
    *seen = left != right && sl_pvs_sees(&visibility.pvs, left, right) &&
            sl_pvs_sees(&visibility.pvs, right, left);
    sl_visibility_destroy(context, &visibility);
    return SL_OK;
}

int main(void) {
    sl_context *context = sl_context_create(NULL);
    if (!context) return 1;
    sl_map map = {0};
    sl_space space = {0};
    bool seen = false;
    sl_status status = cut(context, &map, &space);
    if (status == SL_OK) status = look(context, &space, &seen);
    bool outside = sl_space_locate(&space, (sl_point){25, 5}) == SL_NO_CELL;
    printf("%s: %u cells, %u portals, %s\n", sl_status_name(status), space.cell_count,
           space.portal_count, sl_context_message(context));
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    return status == SL_OK && seen && outside ? 0 : 1;
}

// What a program does with the core: a map made by hand, baked, asked.
#include <sightline/sightline.h>

#include <stdio.h>

// Two rooms of 10 x 10 with a gap of 2 between them.
static const double walls[][4] = {
    {0, 0, 20, 0}, {20, 0, 20, 10}, {20, 10, 0, 10}, {0, 10, 0, 0}, {10, 0, 10, 4}, {10, 6, 10, 10},
};

static sl_status build(sl_context *context, sl_map *map) {
    sl_status status = SL_OK;
    for (size_t i = 0; i < sizeof walls / sizeof *walls && status == SL_OK; i++)
        status = sl_map_add_wall(context, map, (sl_point){walls[i][0], walls[i][1]},
                                 (sl_point){walls[i][2], walls[i][3]}, 0);
    return status;
}

int main(void) {
    sl_context *context = sl_context_create(NULL);
    if (!context) return 1;
    sl_map map = {0};
    sl_baked baked = {0};
    sl_query *query = NULL;
    bool through = false, behind = true;
    sl_status status = build(context, &map);
    if (status == SL_OK) status = sl_bake(context, &map, NULL, &baked, NULL);
    if (status == SL_OK) status = sl_query_create(context, &baked, &query);
    sl_point eye = {5, 5};
    if (status == SL_OK) status = sl_query_sees(context, query, eye, (sl_point){15, 5}, &through);
    if (status == SL_OK) status = sl_query_sees(context, query, eye, (sl_point){11, 9}, &behind);
    printf("%s: %u cells, %u portals, %s\n", sl_status_name(status), baked.space.cell_count,
           baked.space.portal_count, sl_context_message(context));
    sl_query_destroy(context, query);
    sl_baked_destroy(context, &baked);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    return status == SL_OK && through && !behind ? 0 : 1;
}

// Asks over a map without a bake: a door is shut, and the next answer knows it.
#include <sightline/sightline.h>

#include <stdio.h>
#include <string.h>

static const char text[] =
    "sightline 1\nwalls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 4\nwall 10 6 10 10\n"
    "door front 10 4 10 6 open\n";

int main(void) {
    sl_context *context = sl_context_create(NULL);
    sl_map map = {0};
    sl_bake_options options = sl_bake_options_default();
    sl_baked baked = {0};
    sl_query *query = NULL;
    sl_region region = {0};
    double area[2] = {0};
    sl_status status = sl_map_parse(context, "house.map", text, strlen(text), NULL, &map);
    if (status == SL_OK)
        status = sl_bake_space(context, &map, &options, &baked, NULL); // no visible sets
    if (status == SL_OK) status = sl_query_over(context, &baked.space, &baked.map, NULL, &query);
    for (int open = 0; open < 2 && status == SL_OK; open++) {
        const sl_view view = sl_query_view(query, (sl_point){5, 5}, 0, 360);
        sl_query_set_doors(context, query, open);
        status = sl_query_region(context, query, &view, &region);
        area[open] = sl_region_area(&region);
    }
    printf("%s: %g shut, %g open %s\n", sl_status_name(status), area[0], area[1],
           sl_context_message(context));
    sl_region_destroy(context, &region);
    sl_query_destroy(context, query);
    sl_baked_destroy(context, &baked);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    return status == SL_OK && area[0] == 100 && area[1] > 100 ? 0 : 1;
}

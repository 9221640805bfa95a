// Visibility graphs: the points of an empty room all see each other.
#include <sightline/query.h>
#include <sightline/vga.h>

#include <stdio.h>

static sl_status build(sl_context *context, sl_map *map) {
    static const sl_point corners[] = {{0, 0}, {4, 0}, {4, 3}, {0, 3}};
    sl_status status = SL_OK;
    for (int i = 0; i < 4 && status == SL_OK; i++)
        status = sl_map_add_wall(context, map, corners[i], corners[(i + 1) % 4], 0);
    return status;
}

static sl_status subdivide(sl_context *context, const sl_map *map, sl_space *space) {
    return sl_subdivision_for(map)->subdivide(context, map, NULL, space);
}

int main(void) {
    sl_context *context = sl_context_create(NULL);
    if (!context) return 1;
    sl_map map = {0};
    sl_space space = {0};
    sl_query *query = NULL;
    const sl_outline *outline = NULL;
    sl_vga_grid grid = {0};
    sl_vga_graph graph = {0};
    const sl_point seed = {1, 1};
    sl_status status = build(context, &map);
    if (status == SL_OK) status = subdivide(context, &map, &space);
    if (status == SL_OK) status = sl_query_over(context, &space, &map, NULL, &query);
    if (status == SL_OK) status = sl_query_outline(context, query, &outline);
    if (status == SL_OK) status = sl_vga_grid_make(context, outline, 1, &seed, 1, &grid);
    if (status == SL_OK) status = sl_vga_graph_make(context, outline, &grid, 0, 1, &graph);
    printf("%s: %u points, %u pairs\n", sl_status_name(status), graph.count, (unsigned)graph.edges);
    const bool good = status == SL_OK && graph.count > 1 &&
                      graph.edges == (uint64_t)graph.count * (graph.count - 1);
    sl_vga_graph_destroy(context, &graph);
    sl_vga_grid_destroy(context, &grid);
    sl_query_destroy(context, query);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    return good ? 0 : 1;
}

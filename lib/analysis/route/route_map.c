/// The shortest path map of a point: by cell, the nodes of the search that bring something to it.
///
/// A way to a place ends with a straight piece, from its last corner through the portal by which it
/// enters the place's cell. So it is one of the nodes of the cell: the place lies in the directions
/// of the node, and the way is as long as that to the node's root and the straight piece. Of the
/// nodes, the one with the least sum tells. A node is left out only where all of its cell is known
/// to be nearer by another one (search.c).
///
/// The parts of a cell by node have bent borders, where two sums are equal: they are never made.
#include "analysis/route/route.h"

#include "geometry/length.h"
#include "geometry/orient.h"

#include <stdlib.h>

struct sl_route_map {
    sl_route_finder *finder;
    sl_point from;
    double limit;    ///< widened
    uint32_t *first; ///< by cell, and one more: nodes[first[c] .. first[c + 1])
    SL_ARRAY(sli_route_node) nodes;
};

static sl_status take(sl_context *context, const sli_route_node *node, void *user) {
    sl_route_map *map = user;
    SL_TRY(SL_ARRAY_ROOM(context, &map->nodes, 1));
    map->nodes.items[map->nodes.count++] = *node;
    return SL_OK;
}

static int compare_nodes(const void *left, const void *right) {
    const sli_route_node *a = left, *b = right;
    if (a->cell != b->cell) return a->cell < b->cell ? -1 : 1;
    if (a->g != b->g) return a->g < b->g ? -1 : 1;
    return sli_compare_points(a->root, b->root);
}

/// The nodes by cell.
static void index_nodes(sl_route_map *map) {
    const uint32_t cells = map->finder->space->cell_count;
    if (map->nodes.count)
        qsort(map->nodes.items, map->nodes.count, sizeof *map->nodes.items, compare_nodes);
    for (size_t i = 0; i < map->nodes.count; i++) map->first[map->nodes.items[i].cell + 1]++;
    for (uint32_t c = 0; c < cells; c++) map->first[c + 1] += map->first[c];
}

static sl_status fill(sl_context *context, sl_route_map *map, sl_route_near *cells) {
    sl_route_finder *finder = map->finder;
    map->first = sl_alloc_array(context, (size_t)finder->space->cell_count + 1, sizeof *map->first);
    if (!cells || !map->first) return SL_NO_MEMORY;
    sli_route_begin(finder);
    SL_TRY(sli_route_spread(context, finder, map->from, map->limit, cells, take, map));
    if (map->nodes.count >= UINT32_MAX) return sl_fail(context, SL_NO_MEMORY, "too many nodes");
    index_nodes(map);
    return SL_OK;
}

sl_status sl_route_map_create(sl_context *context, sl_route_finder *finder, sl_point from,
                              double limit, sl_route_map **out) {
    uint32_t start;
    double most = 0;
    if (finder->radius > 0)
        return sl_fail(context, SL_UNSUPPORTED,
                       "shortest path maps are those of a walker without a radius");
    SL_TRY(sli_route_widen(context, finder->space, limit, &most));
    SL_TRY(sli_route_stand_in(context, finder, "from", from, &start));
    sl_route_map *map = sl_alloc_array(context, 1, sizeof *map);
    if (!map) return SL_NO_MEMORY;
    map->finder = finder;
    map->from = from;
    map->limit = most;
    sl_route_near *cells = sl_alloc_array(context, finder->space->cell_count, sizeof *cells);
    const sl_status status = fill(context, map, cells);
    sl_free(context, cells);
    if (status == SL_OK)
        *out = map;
    else
        sl_route_map_destroy(context, map);
    return status;
}

void sl_route_map_destroy(sl_context *context, sl_route_map *map) {
    if (!map) return;
    sl_free(context, map->first);
    sl_free(context, map->nodes.items);
    sl_free(context, map);
}

static void look_in(const sl_route_map *map, uint32_t cell, sl_point to, sl_route_place *out) {
    for (uint32_t i = map->first[cell]; i < map->first[cell + 1]; i++) {
        const sli_route_node *n = &map->nodes.items[i];
        if (n->g >= out->distance) return; // and so are all behind it
        const double distance = n->g + sli_length(to.x - n->root.x, to.y - n->root.y);
        if (distance >= out->distance || sli_route_is_beyond(n, SLI_ROUTE_RIGHT, to) ||
            sli_route_is_beyond(n, SLI_ROUTE_LEFT, to))
            continue;
        *out = (sl_route_place){distance, n->root};
    }
}

void sl_route_map_at(sl_route_map *map, sl_point to, sl_route_place *out) {
    sl_route_finder *finder = map->finder;
    const sl_space *space = finder->space;
    *out = (sl_route_place){INFINITY, to};
    if (!isfinite(to.x) || !isfinite(to.y)) return;
    const uint32_t cell = sl_space_locate(space, to);
    if (cell == SL_NO_CELL || space->cells[cell].solid) return;
    sli_route_begin(finder);
    const uint32_t count = sli_route_stand(finder, to, cell, finder->at_goal);
    for (uint32_t i = 0; i < count; i++) look_in(map, finder->list[i], to, out);
    if (out->distance > map->limit) *out = (sl_route_place){INFINITY, to};
}

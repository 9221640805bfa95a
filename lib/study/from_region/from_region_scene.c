/// The scene of the from-region methods: the map is cut along the borders of view cells, and each
/// quadrant gets its pass.
///
/// Borders of view cells become seams of the map, so that each leaf of the kd-tree lies in one view
/// cell. A pass has two orders in which those behind come first: of view cells, by the dependence
/// graph of their faces; and of all leaves, by taking the farther side of each split first. Cost:
/// O(leaves) a quadrant, besides the kd-tree.
#include "study/from_region/from_region_scene.h"

#include "map/scan.h"
#include "map/source.h"
#include "space/kd_tree.h"
#include "space/subdivide.h"

#include <string.h>

sl_from_region_scene_options sl_from_region_scene_options_default(void) {
    return (sl_from_region_scene_options){
        .view_cells = SL_VIEW_CELLS_GRID, .grid = 8, .objects = SL_OBJECTS_GROUPS, .groups = 1800};
}

// --- the map with the view cells' borders

static sl_status add_grid(sl_context *context, sl_map *map, uint32_t grid) {
    const sl_box b = sli_space_bounds(map); // the space's
    for (uint32_t i = 1; i < grid; i++) {
        const double x = sli_grid_line(&b, 0, i, grid), y = sli_grid_line(&b, 1, i, grid);
        SL_TRY(sli_map_add_border(context, map, (sl_segment){{x, b.min.y}, {x, b.max.y}}));
        SL_TRY(sli_map_add_border(context, map, (sl_segment){{b.min.x, y}, {b.max.x, y}}));
    }
    return SL_OK;
}

static sl_status add_borders_of_boxes(sl_context *context, sl_map *map) {
    for (size_t i = 0; i < map->object_count; i++) {
        const sl_point a = map->objects[i].box.min, b = map->objects[i].box.max;
        const sl_segment sides[4] = {
            {a, {b.x, a.y}}, {{b.x, a.y}, b}, {{a.x, b.y}, b}, {a, {a.x, b.y}}};
        for (int k = 0; k < 4; k++)
            if (sides[k].a.x != sides[k].b.x || sides[k].a.y != sides[k].b.y)
                SL_TRY(sli_map_add_border(context, map, sides[k]));
    }
    return SL_OK;
}

static sl_status subdivide(sl_context *context, const sl_map *map,
                           const sl_from_region_scene_options *options,
                           sl_from_region_scene *scene) {
    SL_TRY(sl_map_copy(context, map, &scene->map));
    if (options->view_cells == SL_VIEW_CELLS_GRID)
        SL_TRY(add_grid(context, &scene->map, options->grid));
    if (options->view_cells == SL_VIEW_CELLS_BOXES)
        SL_TRY(add_borders_of_boxes(context, &scene->map));
    const sl_subdivide_options rules = sl_subdivide_options_default();
    return sli_subdivide_kd(context, &scene->map, &rules, &scene->space);
}

// --- passes

static sli_direction_sector quadrant_cone(int quadrant) {
    static const sl_point axes[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    const sl_point zero = {0, 0};
    return (sli_direction_sector){{zero, axes[quadrant]},
                                  {zero, axes[(quadrant + 1) % SLI_QUADRANTS]}};
}

/// Lists, for each view cell, those behind its faces. There is room for all faces.
static void link_view_cells(const sl_from_region_scene *scene, const sli_pass *pass,
                            uint32_t *first, uint32_t *to) {
    uint32_t count = 0;
    for (uint32_t cell = 0; cell < scene->counts.view_cells; cell++) {
        first[cell] = count;
        for (uint32_t f = scene->first_face[cell]; f < scene->first_face[cell + 1]; f++) {
            const sli_face *face = &scene->faces.items[f];
            if (face->to != SL_NO_VIEW_CELL && pass->faces[face->directed] != SLI_NO_FACE)
                to[count++] = face->to;
        }
    }
    first[scene->counts.view_cells] = count;
}

/// The largest number of view cells that one lies behind.
static uint32_t most_dependents(const sli_dependence *graph, uint32_t *last, uint32_t *dependents) {
    uint32_t most = 0;
    for (uint32_t i = 0; i < graph->count; i++) {
        last[i] = UINT32_MAX;
        dependents[i] = 0;
    }
    for (uint32_t i = 0; i < graph->count; i++)
        for (uint32_t k = graph->first[i]; k < graph->first[i + 1]; k++) {
            const uint32_t to = graph->to[k];
            if (last[to] == i) continue;
            last[to] = i;
            if (++dependents[to] > most) most = dependents[to];
        }
    return most;
}

static sl_status find_orders(sl_context *context, sl_from_region_scene *scene) {
    const size_t count = scene->counts.view_cells;
    uint32_t *first = sl_alloc_array(context, count + 1, 3 * sizeof *first);
    uint32_t *to = sl_alloc_array(context, scene->faces.count, sizeof *to);
    sl_status status = first && to ? SL_OK : SL_NO_MEMORY;
    scene->counts.dependents = 0;
    for (int q = 0; q < SLI_QUADRANTS && status == SL_OK; q++) {
        sli_from_region_pass *pass = &scene->passes[q];
        link_view_cells(scene, &pass->leaves, first, to);
        const sli_dependence graph = {scene->counts.view_cells, first, to};
        const uint32_t most = most_dependents(&graph, first + count + 1, first + 2 * (count + 1));
        if (most > scene->counts.dependents) scene->counts.dependents = most;
        sli_order_destroy(context, &pass->view_cells);
        status = sli_order_create(context, &graph, &pass->view_cells);
    }
    sl_free(context, first);
    sl_free(context, to);
    return status;
}

/// Numbers leaves, those behind first: at each split the farther side before the nearer one.
static sl_status place_leaves(sl_context *context, const sl_space *space, int quadrant,
                              uint32_t **out) {
    uint32_t *place = sl_alloc_array(context, space->cell_count, sizeof *place);
    int32_t *stack = sl_alloc_array(context, (size_t)space->tree_depth + 2, sizeof *stack);
    uint32_t count = 0, placed = 0;
    if (place && stack) {
        stack[count++] = space->root;
        while (count) {
            const int32_t child = stack[--count];
            if (child < 0) {
                place[~child] = placed++;
                continue;
            }
            const sl_node *node = &space->nodes[child];
            const bool onwards = node->axis ? sli_goes_up(quadrant) : sli_goes_right(quadrant);
            stack[count++] = onwards ? node->below : node->above;
            stack[count++] = onwards ? node->above : node->below;
        }
    }
    sl_free(context, stack);
    *out = place;
    return placed ? SL_OK : SL_NO_MEMORY;
}

static sl_status make_passes(sl_context *context, sl_from_region_scene *scene) {
    for (int q = 0; q < SLI_QUADRANTS; q++) {
        SL_TRY(sli_pass_create(context, &scene->space, true, quadrant_cone(q),
                               &scene->passes[q].leaves));
        SL_TRY(place_leaves(context, &scene->space, q, &scene->passes[q].place));
    }
    return find_orders(context, scene);
}

// --- the whole

static sl_status mark_inside(sl_context *context, sl_from_region_scene *scene) {
    scene->inside =
        sl_alloc_array(context, scene->counts.view_cells, scene->words * sizeof *scene->inside);
    if (!scene->inside) return SL_NO_MEMORY;
    for (size_t i = 0; i < scene->items.count; i++) {
        const uint32_t cell = scene->view_cell[scene->items.items[i].leaf];
        if (cell != SL_NO_VIEW_CELL)
            sl_bits_add(sli_from_region_inside(scene, cell), scene->items.items[i].object);
    }
    return SL_OK;
}

static sl_status check_options(sl_context *context, const sl_map *map,
                               const sl_from_region_scene_options *options) {
    const bool boxes =
        options->view_cells == SL_VIEW_CELLS_BOXES || options->objects == SL_OBJECTS_BOXES;
    if (options->grid < 1 || options->grid > SL_VIEW_GRID_MOST)
        return sl_fail(context, SL_BAD_ARGUMENT, "a grid of %u view cells a side: 1 to %d",
                       options->grid, SL_VIEW_GRID_MOST);
    if (options->groups < 1) return sl_fail(context, SL_BAD_ARGUMENT, "0 groups: at least 1");
    if (boxes && !map->object_count)
        return sl_fail_at(context, sli_map_name(map), 0,
                          "no object: add 'object NAME X0 Y0 X1 Y1', or take other view cells and "
                          "objects");
    return SL_OK;
}

static sl_status make(sl_context *context, const sl_map *map,
                      const sl_from_region_scene_options *options, sl_from_region_scene *scene) {
    SL_TRY(check_options(context, map, options));
    SL_TRY(sli_check_has_walls(context, map));
    SL_TRY(subdivide(context, map, options, scene));
    SL_TRY(sli_from_region_find_view_cells(context, options, scene));
    SL_TRY(make_passes(context, scene));
    for (bool cut = true; cut;) {
        SL_TRY(sl_check_cancelled(context));
        SL_TRY(sli_from_region_check_cycles(context, options, scene, &cut));
        if (!cut) break;
        SL_TRY(sli_from_region_find_faces(context, scene));
        SL_TRY(find_orders(context, scene));
    }
    SL_TRY(sli_from_region_find_objects(context, options, scene));
    return mark_inside(context, scene);
}

sl_status sl_from_region_scene_create(sl_context *context, const sl_map *map,
                                      const sl_from_region_scene_options *options,
                                      sl_from_region_scene **out) {
    sl_from_region_scene *scene = sl_alloc_array(context, 1, sizeof *scene);
    if (!scene) return SL_NO_MEMORY;
    const sl_status status = make(context, map, options, scene);
    if (status == SL_OK)
        *out = scene;
    else
        sl_from_region_scene_destroy(context, scene);
    return status;
}

void sl_from_region_scene_destroy(sl_context *context, sl_from_region_scene *scene) {
    if (!scene) return;
    for (uint32_t i = 0; scene->names && i < scene->counts.view_cells; i++)
        sl_free(context, scene->names[i]);
    for (int q = 0; q < SLI_QUADRANTS; q++) {
        sli_pass_destroy(context, &scene->passes[q].leaves);
        sli_order_destroy(context, &scene->passes[q].view_cells);
        sl_free(context, scene->passes[q].place);
    }
    sl_map_destroy(context, &scene->map);
    sl_space_destroy(context, &scene->space);
    sl_free(context, scene->view_cell);
    sl_free(context, scene->names);
    sl_free(context, scene->faces.items);
    sl_free(context, scene->first_face);
    sl_free(context, scene->face_of);
    sl_free(context, scene->items.items);
    sl_free(context, scene->first_item);
    sl_free(context, scene->leaf_items);
    sl_free(context, scene->first_leaf_item);
    sl_free(context, scene->boxes);
    sl_free(context, scene->inside);
    sl_free(context, scene);
}

sl_from_region_counts sl_from_region_scene_count(const sl_from_region_scene *scene) {
    return scene->counts;
}

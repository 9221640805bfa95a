/// What elementary view cells see, by exact sets: a space is made in which no cell lies in two of
/// them, nor in two cells of the scene, and a method of cell-to-cell visibility is asked.
#include "view_cells/tree.h"

typedef struct exact {
    const sl_view_scene *scene;
    const sl_view_tree *tree;
    sl_map map; ///< walls and starts of the scene's, and seams
    sl_space space;
    sl_visibility visibility;
    uint32_t *leaves, *homes; ///< by cell of `space`: where it lies
} exact;

static sl_status make_map(sl_context *context, const sl_map *map, exact *e) {
    sl_status status = SL_OK;
    for (size_t i = 0; i < map->wall_count && status == SL_OK; i++)
        status = sl_map_add_wall(context, &e->map, map->walls[i].a, map->walls[i].b, 0);
    for (size_t i = 0; i < map->start_count && status == SL_OK; i++)
        status = sl_map_add_start(context, &e->map, map->starts[i].at, map->starts[i].heading, 0);
    SL_TRY(status);
    uint32_t *each = sl_alloc_array(context, e->tree->cell_count, sizeof *each);
    if (!each) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < e->tree->cell_count; i++) each[i] = i;
    status = sl_view_add_seams(context, e->tree, each, e->scene->space, &e->map);
    sl_free(context, each);
    return status;
}

static sl_status find_places(sl_context *context, exact *e) {
    const uint32_t count = e->space.cell_count;
    e->leaves = sl_alloc_array(context, count, sizeof *e->leaves);
    e->homes = sl_alloc_array(context, count, sizeof *e->homes);
    if (!e->leaves || !e->homes) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++) {
        e->leaves[i] = sl_view_cell_leaf(e->tree, &e->space, i);
        e->homes[i] = sl_view_cell_home(e->scene->space, &e->space, i);
    }
    return SL_OK;
}

static sl_status fill(sl_context *context, exact *e, sl_view_sets *sets) {
    const uint32_t count = e->space.cell_count;
    for (uint32_t i = 0; i < count; i++) {
        if (i % 256 == 0) SL_TRY(sl_check_cancelled(context));
        if (!e->space.cells[i].inside || e->leaves[i] >= e->tree->cell_count) continue;
        sl_bits *set = sl_view_set(sets, e->leaves[i]);
        for (sl_pvs_run run = sl_pvs_begin(&e->visibility.pvs, i); sl_pvs_next(&run);)
            for (uint32_t c = run.first; c < run.end; c++)
                if (e->homes[c] != SL_NO_CELL) sl_bits_add(set, e->homes[c]);
    }
    return SL_OK;
}

sl_status sl_view_sets_exact(sl_context *context, const sl_map *map, const sl_view_scene *scene,
                             const sl_view_tree *tree, const sl_see_method *method,
                             const sl_see_options *options, sl_view_sets *out) {
    if (scene->objects != SL_VIEW_CELLS)
        return sl_fail(context, SL_BAD_ARGUMENT, "exact sets are of cells, not of walls");
    exact e = {.scene = scene, .tree = tree};
    sl_view_sets sets = {0};
    sl_status status = make_map(context, map, &e);
    if (status == SL_OK)
        status = sl_subdivision_for(&e.map)->subdivide(context, &e.map, NULL, &e.space);
    if (status == SL_OK) status = method->see(context, &e.space, options, &e.visibility);
    if (status == SL_OK) status = find_places(context, &e);
    if (status == SL_OK)
        status = sl_view_sets_create(context, tree->cell_count, scene->space->cell_count, &sets);
    if (status == SL_OK) status = fill(context, &e, &sets);
    sl_free(context, e.leaves);
    sl_free(context, e.homes);
    sl_visibility_destroy(context, &e.visibility);
    sl_space_destroy(context, &e.space);
    sl_map_destroy(context, &e.map);
    if (status == SL_OK)
        *out = sets;
    else
        sl_view_sets_destroy(context, &sets);
    return status;
}

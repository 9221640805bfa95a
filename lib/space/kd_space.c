/// A kd-tree becomes a space: its boxes are cells, and seams cut portals.
#include "sightline/support.h"
#include "space/index.h"
#include "space/kd_tree.h"
#include "space/seams.h"
#include "space/subdivide.h"
#include "space/walled.h"

#include <string.h>

static sl_status copy_cells(sl_context *context, const sli_kd_tree *tree, sl_space *space) {
    const size_t count = tree->cells.count;
    if (count > UINT32_MAX / 4) return sl_fail_memory(context);
    space->cell_count = (uint32_t)count;
    space->vertex_count = (uint32_t)count * 4;
    space->cells = sl_alloc_array(context, count, sizeof *space->cells);
    space->vertices = sl_alloc_array(context, count * 4, sizeof *space->vertices);
    if (!space->cells || !space->vertices) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < space->cell_count; i++) {
        const sl_box *box = &tree->cells.items[i];
        space->cells[i] = (sl_cell){.first_vertex = 4 * i, .vertex_count = 4};
        const sl_point corners[4] = {
            box->min, {box->max.x, box->min.y}, box->max, {box->min.x, box->max.y}};
        memcpy(&space->vertices[(size_t)4 * i], corners, sizeof corners);
    }
    return SL_OK;
}

/// The tree over the walls and the parts of seams.
static sl_status build_tree(sl_context *context, const sli_piece *walls, size_t count,
                            const sli_seam_parts *seams, const sl_subdivide_options *options,
                            sl_box bounds, sli_kd_tree *tree) {
    if (!seams->parts.count) return sli_kd_build(context, walls, count, bounds, options, tree);
    sli_piece *all = NULL;
    sl_status status = sli_seam_lines(context, walls, count, seams, &all);
    if (status == SL_OK)
        status = sli_kd_build(context, all, count + seams->parts.count, bounds, options, tree);
    sl_free(context, all);
    return status;
}

static sl_status fill_space(sl_context *context, const sl_map *map, const sli_piece *walls,
                            const sli_seam_parts *seams, const sl_subdivide_options *options,
                            sli_kd_tree *tree, sl_space *space) {
    SL_TRY(build_tree(context, walls, map->wall_count, seams, options, space->bounds, tree));
    SL_TRY(copy_cells(context, tree, space));
    space->walls = sl_alloc_array(context, map->wall_count, sizeof *space->walls);
    if (!space->walls) return SL_NO_MEMORY;
    if (map->wall_count) memcpy(space->walls, map->walls, map->wall_count * sizeof *space->walls);
    space->wall_count = (uint32_t)map->wall_count;
    SL_TRY(sli_make_portals(context, tree, space));
    if (space->seam_count) SL_TRY(sli_seams_tag_axial(context, seams, space));
    space->root = tree->root;
    space->tree_depth = tree->depth;
    space->node_count = (uint32_t)tree->nodes.count;
    space->nodes = tree->nodes.items;
    tree->nodes.items = NULL;
    SL_TRY(sli_mark_inside(context, map, walls, space));
    SL_TRY(sli_walled_by_channel(context, map, space));
    sl_report(context, "subdivide", "cells", space->cell_count, space->cell_count);
    return SL_OK;
}

sl_status sli_subdivide_kd(sl_context *context, const sl_map *map,
                           const sl_subdivide_options *options, sl_space *out) {
    if (!(options->obscured >= 0 && options->obscured <= 1))
        return sl_fail(context, SL_BAD_ARGUMENT, "the obscured share must lie between 0 and 1");
    SL_TRY(sli_check_has_walls(context, map));
    if (map->wall_count > INT32_MAX) return sl_fail_memory(context);
    sl_space space = {.bounds = sli_space_bounds(map)};
    sli_kd_tree tree = {0};
    sli_piece *walls = NULL;
    sli_seam_parts seams = {0};
    sl_status status = sli_wall_lines(context, map, map->walls, map->wall_count, &walls);
    if (status == SL_OK) status = sli_seams_of_map(context, map, true, &space);
    if (status == SL_OK && space.seam_count) status = sli_seams_part(context, &space, &seams);
    if (status == SL_OK) status = fill_space(context, map, walls, &seams, options, &tree, &space);
    sli_seam_parts_destroy(context, &seams);
    sl_free(context, walls);
    sli_kd_destroy(context, &tree);
    if (status == SL_OK)
        *out = space;
    else
        sl_space_destroy(context, &space);
    return status;
}

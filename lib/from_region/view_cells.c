/// View cells: which leaf belongs to which, and the faces between them.
#include "from_region/regions.h"

#include <stdlib.h>
#include <string.h>

sl_box sl_leaf_box(const sl_space *space, uint32_t leaf) {
    const sl_cell *c = &space->cells[leaf];
    const sl_point *corners = space->vertices + c->first_vertex;
    sl_box box = {corners[0], corners[0]};
    for (uint32_t i = 1; i < c->vertex_count; i++) {
        if (corners[i].x < box.min.x) box.min.x = corners[i].x;
        if (corners[i].y < box.min.y) box.min.y = corners[i].y;
        if (corners[i].x > box.max.x) box.max.x = corners[i].x;
        if (corners[i].y > box.max.y) box.max.y = corners[i].y;
    }
    return box;
}

double sl_grid_line(const sl_box *bounds, int axis, uint32_t line, uint32_t grid) {
    const double low = axis ? bounds->min.y : bounds->min.x;
    const double high = axis ? bounds->max.y : bounds->max.x;
    return line == grid ? high : low + (high - low) * ((double)line / grid);
}

// --- which view cell a leaf is of

/// The square's number on one axis. Leaves do not run over the grid's lines.
static uint32_t square_on(const sl_box *bounds, int axis, uint32_t grid, double low) {
    uint32_t square = 0;
    while (square + 1 < grid && sl_grid_line(bounds, axis, square + 1, grid) <= low) square++;
    return square;
}

static uint32_t square_of(const sl_regions *scene, uint32_t grid, sl_box leaf) {
    const sl_box *bounds = &scene->space.bounds;
    return square_on(bounds, 1, grid, leaf.min.y) * grid + square_on(bounds, 0, grid, leaf.min.x);
}

/// The first box that holds a leaf; boxes of one name go by the first of them.
static uint32_t box_of(const sl_regions *scene, sl_box leaf) {
    const sl_map *map = &scene->map;
    for (uint32_t i = 0; i < map->object_count; i++) {
        const sl_box *box = &map->objects[i].box;
        if (box->min.x > leaf.min.x || box->min.y > leaf.min.y || box->max.x < leaf.max.x ||
            box->max.y < leaf.max.y)
            continue;
        for (uint32_t k = 0; k < i; k++)
            if (strcmp(map->objects[k].name, map->objects[i].name) == 0) return k;
        return i;
    }
    return SL_NO_VIEW_CELL;
}

/// Numbers those that have leaves, in ascending order, from 0. Returns how many there are.
static uint32_t number(uint32_t *of_leaf, uint32_t leaves, uint32_t *numbers, uint32_t most) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < most; i++) numbers[i] = SL_NO_VIEW_CELL;
    for (uint32_t i = 0; i < leaves; i++)
        if (of_leaf[i] != SL_NO_VIEW_CELL) numbers[of_leaf[i]] = 0;
    for (uint32_t i = 0; i < most; i++)
        if (numbers[i] != SL_NO_VIEW_CELL) numbers[i] = count++;
    for (uint32_t i = 0; i < leaves; i++)
        if (of_leaf[i] != SL_NO_VIEW_CELL) of_leaf[i] = numbers[of_leaf[i]];
    return count;
}

static sl_status name_boxes(sl_context *context, sl_regions *scene, const uint32_t *numbers) {
    scene->names = sl_alloc_array(context, scene->counts.view_cells, sizeof *scene->names);
    if (!scene->names) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < scene->map.object_count; i++) {
        if (numbers[i] == SL_NO_VIEW_CELL) continue;
        const char *name = scene->map.objects[i].name;
        scene->names[numbers[i]] = sl_copy_text(context, name, strlen(name));
        if (!scene->names[numbers[i]]) return SL_NO_MEMORY;
    }
    return SL_OK;
}

static sl_status assign(sl_context *context, const sl_regions_options *options, sl_regions *scene) {
    const sl_space *space = &scene->space;
    uint32_t most = space->cell_count;
    if (options->view_cells == SL_VIEW_CELLS_GRID) most = options->grid * options->grid;
    if (options->view_cells == SL_VIEW_CELLS_BOXES) most = (uint32_t)scene->map.object_count;
    uint32_t *numbers = sl_alloc_array(context, most, sizeof *numbers);
    scene->view_cell = sl_alloc_array(context, space->cell_count, sizeof *scene->view_cell);
    if (!numbers || !scene->view_cell) {
        sl_free(context, numbers);
        return SL_NO_MEMORY;
    }
    for (uint32_t leaf = 0; leaf < space->cell_count; leaf++) {
        const sl_box box = sl_leaf_box(space, leaf);
        scene->view_cell[leaf] = SL_NO_VIEW_CELL;
        if (!space->cells[leaf].inside) continue;
        scene->counts.leaves++;
        scene->view_cell[leaf] = options->view_cells == SL_VIEW_CELLS_GRID
                                     ? square_of(scene, options->grid, box)
                                 : options->view_cells == SL_VIEW_CELLS_BOXES ? box_of(scene, box)
                                                                              : leaf;
    }
    scene->counts.view_cells = number(scene->view_cell, space->cell_count, numbers, most);
    const sl_status status =
        options->view_cells == SL_VIEW_CELLS_BOXES ? name_boxes(context, scene, numbers) : SL_OK;
    sl_free(context, numbers);
    return status;
}

// --- faces

static int compare_faces(const void *left, const void *right) {
    const sl_face *a = left, *b = right;
    if (a->from != b->from) return a->from < b->from ? -1 : 1;
    return (a->directed > b->directed) - (a->directed < b->directed);
}

sl_status sl_regions_find_faces(sl_context *context, sl_regions *scene) {
    const sl_space *space = &scene->space;
    scene->faces.count = 0;
    scene->counts.boundary_faces = 0;
    for (uint32_t leaf = 0; leaf < space->cell_count; leaf++) {
        const sl_cell *c = &space->cells[leaf];
        for (uint32_t e = c->first_directed; e < c->first_directed + c->directed_count; e++) {
            const sl_face face = {scene->view_cell[leaf], scene->view_cell[space->directed[e].cell],
                                  e};
            scene->face_of[e] = UINT32_MAX;
            if (face.from == SL_NO_VIEW_CELL || face.from == face.to) continue;
            if (!space->cells[space->directed[e].cell].inside) continue;
            SL_TRY(SL_ARRAY_ROOM(context, &scene->faces, 1));
            scene->faces.items[scene->faces.count++] = face;
            scene->counts.boundary_faces += face.to == SL_NO_VIEW_CELL;
        }
    }
    sl_face *faces = scene->faces.items;
    const uint32_t count = scene->counts.faces = (uint32_t)scene->faces.count;
    if (count) qsort(faces, count, sizeof *faces, compare_faces);
    sl_free(context, scene->first_face);
    scene->first_face =
        sl_alloc_array(context, (size_t)scene->counts.view_cells + 1, sizeof *scene->first_face);
    if (!scene->first_face) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++) {
        scene->first_face[faces[i].from + 1]++;
        scene->face_of[faces[i].directed] = i;
    }
    for (uint32_t i = 0; i < scene->counts.view_cells; i++)
        scene->first_face[i + 1] += scene->first_face[i];
    return SL_OK;
}

sl_status sl_regions_find_view_cells(sl_context *context, const sl_regions_options *options,
                                     sl_regions *scene) {
    SL_TRY(assign(context, options, scene));
    scene->face_of = sl_alloc_array(context, scene->space.directed_count, sizeof *scene->face_of);
    if (!scene->face_of) return SL_NO_MEMORY;
    return sl_regions_find_faces(context, scene);
}

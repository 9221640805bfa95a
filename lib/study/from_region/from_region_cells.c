/// View cells of a compound: which leaf of the kd-tree belongs to which, the faces between them,
/// and cycles.
///
/// A face is an open piece of a view cell's border, as a sightline crosses it on the way out. In a
/// quadrant a view cell depends on those behind its faces. Multipass needs an order in which those
/// behind come first, so dependences must have no cycle.
///
///     +---+---+---+     Convex view cells have such an order in the plane, however they are
///     | A   A   A |     laid out. (In space three boxes can make a cycle: Laine 2005, figure 5.)
///     +---+---+   |     A view cell that lies on two sides of another makes a cycle: sightlines
///     | A | B | A |     to the right go from A to B, and from B to A.
///     +---+---+---+
///
/// A cycle is refused, with its view cells named, or the view cell with the most leaves is cut
/// along the kd-tree until there is no cycle left.
#include "map/source.h"
#include "study/from_region/from_region_scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

sl_box sli_leaf_box(const sl_space *space, uint32_t leaf) {
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

double sli_grid_line(const sl_box *bounds, int axis, uint32_t line, uint32_t grid) {
    const double low = axis ? bounds->min.y : bounds->min.x;
    const double high = axis ? bounds->max.y : bounds->max.x;
    return line == grid ? high : low + (high - low) * ((double)line / grid);
}

// --- which view cell a leaf is of

/// The number of a leaf's square on one axis. No leaf crosses a line of the grid.
static uint32_t square_on(const sl_box *bounds, int axis, uint32_t grid, double low) {
    uint32_t square = 0;
    while (square + 1 < grid && sli_grid_line(bounds, axis, square + 1, grid) <= low) square++;
    return square;
}

static uint32_t square_of(const sl_from_region_scene *scene, uint32_t grid, sl_box leaf) {
    const sl_box *bounds = &scene->space.bounds;
    return square_on(bounds, 1, grid, leaf.min.y) * grid + square_on(bounds, 0, grid, leaf.min.x);
}

/// The first box that holds a leaf. Boxes of one name count as the first of them.
static uint32_t box_of(const sl_from_region_scene *scene, sl_box leaf) {
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

/// Renumbers the view cells that have leaves, in ascending order from 0. Returns how many there
/// are.
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

static sl_status name_boxes(sl_context *context, sl_from_region_scene *scene,
                            const uint32_t *numbers) {
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

static sl_status assign(sl_context *context, const sl_from_region_scene_options *options,
                        sl_from_region_scene *scene) {
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
        const sl_box box = sli_leaf_box(space, leaf);
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
    const sli_face *a = left, *b = right;
    if (a->from != b->from) return a->from < b->from ? -1 : 1;
    return (a->directed > b->directed) - (a->directed < b->directed);
}

sl_status sli_from_region_find_faces(sl_context *context, sl_from_region_scene *scene) {
    const sl_space *space = &scene->space;
    scene->faces.count = 0;
    scene->counts.boundary_faces = 0;
    for (uint32_t leaf = 0; leaf < space->cell_count; leaf++) {
        const sl_cell *c = &space->cells[leaf];
        for (uint32_t e = c->first_directed; e < c->first_directed + c->directed_count; e++) {
            const sli_face face = {scene->view_cell[leaf],
                                   scene->view_cell[space->directed[e].cell], e};
            scene->face_of[e] = UINT32_MAX;
            if (face.from == SL_NO_VIEW_CELL || face.from == face.to) continue;
            if (!space->cells[space->directed[e].cell].inside) continue;
            SL_TRY(SL_ARRAY_ROOM(context, &scene->faces, 1));
            scene->faces.items[scene->faces.count++] = face;
            scene->counts.boundary_faces += face.to == SL_NO_VIEW_CELL;
        }
    }
    sli_face *faces = scene->faces.items;
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

sl_status sli_from_region_find_view_cells(sl_context *context,
                                          const sl_from_region_scene_options *options,
                                          sl_from_region_scene *scene) {
    SL_TRY(assign(context, options, scene));
    if (!scene->counts.view_cells)
        return sl_fail_at(context, sli_map_name(&scene->map), 0,
                          "nothing of the map is inside: no view cells");
    scene->face_of = sl_alloc_array(context, scene->space.directed_count, sizeof *scene->face_of);
    if (!scene->face_of) return SL_NO_MEMORY;
    return sli_from_region_find_faces(context, scene);
}

// --- cycles

/// A face to a view cell of the same component; UINT32_MAX for none.
static uint32_t face_within(const sl_from_region_scene *scene, const sli_from_region_pass *pass,
                            uint32_t cell) {
    const sli_order *order = &pass->view_cells;
    for (uint32_t f = scene->first_face[cell]; f < scene->first_face[cell + 1]; f++) {
        const sli_face *face = &scene->faces.items[f];
        if (face->to != SL_NO_VIEW_CELL && pass->leaves.faces[face->directed] != SLI_NO_FACE &&
            order->component[face->to] == order->component[cell])
            return f;
    }
    return UINT32_MAX;
}

/// The first component of more than one view cell; UINT32_MAX for none.
static uint32_t cyclic_component(const sli_order *order) {
    for (uint32_t k = 0; k < order->component_count; k++)
        if (order->starts[k + 1] - order->starts[k] > 1) return k;
    return UINT32_MAX;
}

static void append_name(const sl_from_region_scene *scene, uint32_t cell, char *text, size_t size) {
    const size_t length = strlen(text);
    const char *before = length ? ", " : "";
    if (scene->names && scene->names[cell])
        snprintf(text + length, size - length, "%s'%s'", before, scene->names[cell]);
    else
        snprintf(text + length, size - length, "%s%u", before, cell);
}

/// Goes from view cell to view cell within a component until one comes again: a cycle.
static sl_status refuse(sl_context *context, const sl_from_region_scene *scene, int quadrant,
                        uint32_t component) {
    static const char *const towards[] = {"up and right", "up and left", "down and left",
                                          "down and right"};
    const sli_from_region_pass *pass = &scene->passes[quadrant];
    bool *met = sl_alloc_array(context, scene->counts.view_cells, sizeof *met);
    if (!met) return SL_NO_MEMORY;
    uint32_t cell = pass->view_cells.nodes[pass->view_cells.starts[component]];
    while (!met[cell]) {
        met[cell] = true;
        cell = scene->faces.items[face_within(scene, pass, cell)].to;
    }
    sl_free(context, met);
    const uint32_t start = cell;
    char cycle[512] = "";
    do {
        append_name(scene, cell, cycle, sizeof cycle);
        cell = scene->faces.items[face_within(scene, pass, cell)].to;
    } while (cell != start);
    append_name(scene, start, cycle, sizeof cycle);
    return sl_fail_at(context, sli_map_name(&scene->map), 0,
                      "view cells depend on each other round a cycle for sightlines %s: %s; cut "
                      "them (--cut), or shape them so that none lies on two sides of another",
                      towards[quadrant], cycle);
}

// --- cutting view cells on cycles

static uint32_t leaves_below(const sl_from_region_scene *scene, int32_t child, uint32_t cell,
                             int32_t *stack) {
    uint32_t count = 0, found = 0;
    stack[count++] = child;
    while (count) {
        const int32_t at = stack[--count];
        if (at < 0) {
            found += scene->view_cell[~at] == cell;
            continue;
        }
        stack[count++] = scene->space.nodes[at].above;
        stack[count++] = scene->space.nodes[at].below;
    }
    return found;
}

static void move_leaves(sl_from_region_scene *scene, int32_t child, uint32_t from, uint32_t to,
                        int32_t *stack) {
    uint32_t count = 0;
    stack[count++] = child;
    while (count) {
        const int32_t at = stack[--count];
        if (at < 0) {
            if (scene->view_cell[~at] == from) scene->view_cell[~at] = to;
            continue;
        }
        stack[count++] = scene->space.nodes[at].above;
        stack[count++] = scene->space.nodes[at].below;
    }
}

static sl_status add_name(sl_context *context, sl_from_region_scene *scene, uint32_t like) {
    const uint32_t count = scene->counts.view_cells;
    char **names = sl_alloc_array(context, (size_t)count + 1, sizeof *names);
    if (!names) return SL_NO_MEMORY;
    memcpy(names, scene->names, count * sizeof *names);
    sl_free(context, scene->names);
    scene->names = names;
    char text[300];
    snprintf(text, sizeof text, "%.200s, part %u", names[like] ? names[like] : "", count);
    scene->names[count] = sl_copy_text(context, text, strlen(text));
    return scene->names[count] ? SL_OK : SL_NO_MEMORY;
}

/// Cuts a view cell along the first split of the kd-tree that has some of it on either side.
static sl_status cut_in_two(sl_context *context, sl_from_region_scene *scene, uint32_t cell) {
    const sl_space *space = &scene->space;
    int32_t *stack = sl_alloc_array(context, (size_t)space->tree_depth + 2, sizeof *stack);
    if (!stack) return SL_NO_MEMORY;
    int32_t at = space->root;
    for (;;) {
        const sl_node *node = &space->nodes[at];
        const uint32_t above = leaves_below(scene, node->above, cell, stack);
        const uint32_t below = leaves_below(scene, node->below, cell, stack);
        if (above && below) break;
        at = above ? node->above : node->below;
    }
    move_leaves(scene, space->nodes[at].above, cell, scene->counts.view_cells, stack);
    sl_free(context, stack);
    if (scene->names) SL_TRY(add_name(context, scene, cell));
    scene->counts.view_cells++;
    return SL_OK;
}

/// Chooses the view cell of a component with the most leaves. It has several, as leaves have an
/// order.
static sl_status choose(sl_context *context, const sl_from_region_scene *scene,
                        const sli_order *order, uint32_t component, uint32_t *cell) {
    uint32_t *leaves = sl_alloc_array(context, scene->counts.view_cells, sizeof *leaves);
    if (!leaves) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < scene->space.cell_count; i++)
        if (scene->view_cell[i] != SL_NO_VIEW_CELL) leaves[scene->view_cell[i]]++;
    *cell = order->nodes[order->starts[component]];
    for (uint32_t i = order->starts[component]; i < order->starts[component + 1]; i++)
        if (leaves[order->nodes[i]] > leaves[*cell]) *cell = order->nodes[i];
    sl_free(context, leaves);
    return SL_OK;
}

sl_status sli_from_region_check_cycles(sl_context *context,
                                       const sl_from_region_scene_options *options,
                                       sl_from_region_scene *scene, bool *cut) {
    *cut = false;
    for (int q = 0; q < SLI_QUADRANTS; q++) {
        const sli_order *order = &scene->passes[q].view_cells;
        const uint32_t component = cyclic_component(order);
        if (component == UINT32_MAX) continue;
        if (!options->cut_cycles) return refuse(context, scene, q, component);
        uint32_t cell;
        SL_TRY(choose(context, scene, order, component, &cell));
        *cut = true;
        return cut_in_two(context, scene, cell);
    }
    return SL_OK;
}

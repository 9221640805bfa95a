/// View cells that depend on each other round a cycle: named, and cut.
///
/// Convex view cells have an order in the plane, whatever they are made by: it takes one whose
/// parts lie on several sides of another. (In space three boxes will do: Laine 2005, figure 5.)
#include "from_region/regions.h"

#include <stdio.h>
#include <string.h>

/// A face to a view cell of the same component; UINT32_MAX for none.
static uint32_t face_within(const sl_regions *scene, const sl_regions_pass *pass, uint32_t cell) {
    const sl_order *order = &pass->view_cells;
    for (uint32_t f = scene->first_face[cell]; f < scene->first_face[cell + 1]; f++) {
        const sl_face *face = &scene->faces.items[f];
        if (face->to != SL_NO_VIEW_CELL && pass->leaves.faces[face->directed] != SL_NO_FACE &&
            order->component[face->to] == order->component[cell])
            return f;
    }
    return UINT32_MAX;
}

/// The first component of more than one view cell; UINT32_MAX for none.
static uint32_t cyclic_component(const sl_order *order) {
    for (uint32_t k = 0; k < order->component_count; k++)
        if (order->starts[k + 1] - order->starts[k] > 1) return k;
    return UINT32_MAX;
}

static void append_name(const sl_regions *scene, uint32_t cell, char *text, size_t size) {
    const size_t length = strlen(text);
    const char *before = length ? ", " : "";
    if (scene->names && scene->names[cell])
        snprintf(text + length, size - length, "%s'%s'", before, scene->names[cell]);
    else
        snprintf(text + length, size - length, "%s%u", before, cell);
}

/// Goes from one view cell of a component to another until one comes again: from there on it is a
/// cycle.
static sl_status refuse(sl_context *context, const sl_regions *scene, int quadrant,
                        uint32_t component) {
    static const char *const towards[] = {"up and right", "up and left", "down and left",
                                          "down and right"};
    const sl_regions_pass *pass = &scene->passes[quadrant];
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
    return sl_fail_at(context, scene->map.source, 0,
                      "view cells depend on each other round a cycle for sightlines %s: %s; cut "
                      "them (--cut), or shape them so that none lies on two sides of another",
                      towards[quadrant], cycle);
}

// --- cutting

static uint32_t leaves_below(const sl_regions *scene, int32_t child, uint32_t cell,
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

static void move_leaves(sl_regions *scene, int32_t child, uint32_t from, uint32_t to,
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

static sl_status add_name(sl_context *context, sl_regions *scene, uint32_t like) {
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
static sl_status cut_in_two(sl_context *context, sl_regions *scene, uint32_t cell) {
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

/// The view cell of a component that has the most leaves: more than one, for leaves have an order.
static sl_status choose(sl_context *context, const sl_regions *scene, const sl_order *order,
                        uint32_t component, uint32_t *cell) {
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

sl_status sl_regions_check_cycles(sl_context *context, const sl_regions_options *options,
                                  sl_regions *scene, bool *cut) {
    *cut = false;
    for (int q = 0; q < SL_QUADRANTS; q++) {
        const sl_order *order = &scene->passes[q].view_cells;
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

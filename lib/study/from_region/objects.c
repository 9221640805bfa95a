/// Objects: what may be seen, as items that each lie within one leaf.
///
/// Walls are found on the sides of leaves: walls are sorted by their lines, and each side of a leaf
/// finds those on its own line by binary search. Boxes are found down the kd-tree. Groups of walls
/// are made like a kd-tree: halved by number along the longer side, O(n log^2 n).
#include "study/from_region/from_region_scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// A wall, with the line that it is on.
typedef struct lined_wall {
    double at, lo, hi;
    int axis;
    uint32_t wall;
} lined_wall;

static int compare_lined(const void *left, const void *right) {
    const lined_wall *a = left, *b = right;
    if (a->axis != b->axis) return a->axis - b->axis;
    if (a->at != b->at) return a->at < b->at ? -1 : 1;
    return (a->lo > b->lo) - (a->lo < b->lo);
}

static void line_walls(const sl_space *space, lined_wall *lined) {
    for (uint32_t i = 0; i < space->wall_count; i++) {
        const sl_point a = space->walls[i].a, b = space->walls[i].b;
        const int axis = a.x == b.x ? 0 : 1;
        const double p = axis ? a.x : a.y, q = axis ? b.x : b.y;
        lined[i] = (lined_wall){
            .at = axis ? a.y : a.x, .lo = fmin(p, q), .hi = fmax(p, q), .axis = axis, .wall = i};
    }
    if (space->wall_count) qsort(lined, space->wall_count, sizeof *lined, compare_lined);
}

static sl_status add_item(sl_context *context, sl_from_region_scene *scene, sli_item item) {
    SL_TRY(SL_ARRAY_ROOM(context, &scene->items, 1));
    scene->items.items[scene->items.count++] = item;
    return SL_OK;
}

/// The first wall in the sorted list that ends past `lo` on this line, or lies on a later line.
/// Walls of a line do not overlap.
static size_t find_on_line(const lined_wall *lined, size_t count, int axis, double at, double lo) {
    size_t first = 0;
    while (first < count) {
        const size_t middle = first + (count - first) / 2;
        const lined_wall *w = &lined[middle];
        const bool before = w->axis != axis ? w->axis < axis
                            : w->at != at   ? w->at < at
                                            : w->hi <= lo;
        if (before)
            first = middle + 1;
        else
            count = middle;
    }
    return first;
}

/// Adds the pieces of walls on a side of a leaf from a to b, counter-clockwise. Each wall is an
/// object for now.
static sl_status add_side(sl_context *context, sl_from_region_scene *scene, const lined_wall *lined,
                          uint32_t leaf, sl_point a, sl_point b) {
    const int axis = a.x == b.x ? 0 : 1;
    const double at = axis ? a.y : a.x;
    const double from = axis ? a.x : a.y, to = axis ? b.x : b.y;
    const double lo = fmin(from, to), hi = fmax(from, to);
    const size_t count = scene->space.wall_count;
    for (size_t i = find_on_line(lined, count, axis, at, lo); i < count; i++) {
        const lined_wall *w = &lined[i];
        if (w->axis != axis || w->at != at || w->lo >= hi) break;
        const double low = fmax(lo, w->lo), high = fmin(hi, w->hi);
        const double right = from < to ? low : high, left = from < to ? high : low;
        SL_TRY(add_item(context, scene,
                        (sli_item){.object = w->wall,
                                   .leaf = leaf,
                                   .left = axis ? (sl_point){left, at} : (sl_point){at, left},
                                   .right = axis ? (sl_point){right, at} : (sl_point){at, right}}));
    }
    return SL_OK;
}

static sl_status add_walls(sl_context *context, sl_from_region_scene *scene) {
    const sl_space *space = &scene->space;
    lined_wall *lined = sl_alloc_array(context, space->wall_count, sizeof *lined);
    if (!lined) return SL_NO_MEMORY;
    line_walls(space, lined);
    sl_status status = SL_OK;
    for (uint32_t leaf = 0; leaf < space->cell_count && status == SL_OK; leaf++) {
        const sl_cell *c = &space->cells[leaf];
        if (!c->inside) continue;
        for (uint32_t i = 0; i < c->vertex_count && status == SL_OK; i++)
            status = add_side(context, scene, lined, leaf, space->vertices[c->first_vertex + i],
                              space->vertices[c->first_vertex + (i + 1) % c->vertex_count]);
    }
    sl_free(context, lined);
    return status;
}

// --- walls that have a side inside, and groups of them

static void take(sl_box *box, sl_point p) {
    box->min.x = fmin(box->min.x, p.x);
    box->min.y = fmin(box->min.y, p.y);
    box->max.x = fmax(box->max.x, p.x);
    box->max.y = fmax(box->max.y, p.y);
}

static int compare_x(const void *left, const void *right) {
    const sli_placed *a = left, *b = right;
    if (a->at.x != b->at.x) return a->at.x < b->at.x ? -1 : 1;
    return (a->number > b->number) - (a->number < b->number);
}

static int compare_y(const void *left, const void *right) {
    const sli_placed *a = left, *b = right;
    if (a->at.y != b->at.y) return a->at.y < b->at.y ? -1 : 1;
    return (a->number > b->number) - (a->number < b->number);
}

bool sli_placed_sort(sli_placed *items, size_t count, sl_box *box) {
    *box = (sl_box){items[0].at, items[0].at};
    for (size_t i = 1; i < count; i++) take(box, items[i].at);
    const bool wide = box->max.x - box->min.x >= box->max.y - box->min.y;
    qsort(items, count, sizeof *items, wide ? compare_x : compare_y);
    return wide;
}

/// Divides walls into `groups` of about the same size, along the longer side each time. `object` is
/// the number of the first group. Recursion depth: the logarithm of `groups`.
static void divide(sli_placed *walls, size_t count, uint32_t groups, uint32_t object,
                   uint32_t *of_wall) {
    if (groups == 1) {
        for (size_t i = 0; i < count; i++) of_wall[walls[i].number] = object;
        return;
    }
    sl_box box;
    sli_placed_sort(walls, count, &box);
    const uint32_t below = groups / 2;
    const size_t half = count * below / groups;
    divide(walls, half, below, object, of_wall);
    divide(walls + half, count - half, groups - below, object + below, of_wall);
}

/// Numbers the walls that have items, from `first` on: in `groups` groups, or each on its own (0).
/// *count: how many numbers there are.
static sl_status number_walls(sl_context *context, sl_from_region_scene *scene, uint32_t groups,
                              uint32_t first, uint32_t *count) {
    const sl_space *space = &scene->space;
    uint32_t *of_wall = sl_alloc_array(context, space->wall_count, sizeof *of_wall);
    sli_placed *placed = sl_alloc_array(context, space->wall_count, sizeof *placed);
    if (!of_wall || !placed) {
        sl_free(context, of_wall);
        sl_free(context, placed);
        return SL_NO_MEMORY;
    }
    size_t walls = 0;
    for (size_t i = 0; i < scene->items.count; i++)
        if (!scene->items.items[i].through) of_wall[scene->items.items[i].object] = 1;
    for (uint32_t i = 0; i < space->wall_count; i++) {
        if (!of_wall[i]) continue;
        const sl_point a = space->walls[i].a, b = space->walls[i].b;
        of_wall[i] = first + (uint32_t)walls;
        placed[walls++] = (sli_placed){{a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2}, i};
    }
    *count = (uint32_t)walls;
    if (groups && groups < walls) {
        divide(placed, walls, groups, first, of_wall);
        *count = groups;
    }
    for (size_t i = 0; i < scene->items.count; i++)
        if (!scene->items.items[i].through)
            scene->items.items[i].object = of_wall[scene->items.items[i].object];
    sl_free(context, of_wall);
    sl_free(context, placed);
    return SL_OK;
}

// --- objects that are seen through

static sl_status add_through(sl_context *context, sl_from_region_scene *scene, uint32_t object,
                             uint32_t leaf, sl_box box) {
    const sl_box own = sli_leaf_box(&scene->space, leaf);
    const sl_point low = {fmax(own.min.x, box.min.x), fmax(own.min.y, box.min.y)};
    const sl_point high = {fmin(own.max.x, box.max.x), fmin(own.max.y, box.max.y)};
    if (!scene->space.cells[leaf].inside || low.x > high.x || low.y > high.y) return SL_OK;
    return add_item(context, scene, (sli_item){object, leaf, true, low, high});
}

/// Adds a box to each leaf that it meets, down the kd-tree.
static sl_status add_box(sl_context *context, sl_from_region_scene *scene, uint32_t object,
                         sl_box box, int32_t *stack) {
    const sl_space *space = &scene->space;
    uint32_t count = 0;
    stack[count++] = space->root;
    while (count) {
        const int32_t child = stack[--count];
        if (child < 0) {
            SL_TRY(add_through(context, scene, object, (uint32_t)~child, box));
            continue;
        }
        const sl_node *node = &space->nodes[child];
        const double low = node->axis ? box.min.y : box.min.x;
        const double high = node->axis ? box.max.y : box.max.x;
        if (high >= node->position) stack[count++] = node->above;
        if (low <= node->position) stack[count++] = node->below;
    }
    return SL_OK;
}

static sl_status add_boxes(sl_context *context, sl_from_region_scene *scene) {
    const sl_map *map = &scene->map;
    int32_t *stack = sl_alloc_array(context, (size_t)scene->space.tree_depth + 2, sizeof *stack);
    uint32_t *numbers = sl_alloc_array(context, map->object_count, sizeof *numbers);
    sl_status status = stack && numbers ? SL_OK : SL_NO_MEMORY;
    for (uint32_t i = 0; i < map->object_count && status == SL_OK; i++) {
        uint32_t same = 0;
        while (strcmp(map->objects[same].name, map->objects[i].name) != 0) same++;
        numbers[i] = same < i ? numbers[same] : scene->counts.objects++;
        status = add_box(context, scene, numbers[i], map->objects[i].box, stack);
    }
    sl_free(context, stack);
    sl_free(context, numbers);
    return status;
}

static sl_status add_leaves(sl_context *context, sl_from_region_scene *scene) {
    for (uint32_t leaf = 0; leaf < scene->space.cell_count; leaf++)
        if (scene->space.cells[leaf].inside)
            SL_TRY(add_through(context, scene, scene->counts.objects++, leaf,
                               sli_leaf_box(&scene->space, leaf)));
    return SL_OK;
}

// --- indices

static int compare_items(const void *left, const void *right) {
    const sli_item *a = left, *b = right;
    if (a->object != b->object) return a->object < b->object ? -1 : 1;
    if (a->leaf != b->leaf) return a->leaf < b->leaf ? -1 : 1;
    if (a->left.x != b->left.x) return a->left.x < b->left.x ? -1 : 1;
    return (a->left.y > b->left.y) - (a->left.y < b->left.y);
}

static sl_status index_items(sl_context *context, sl_from_region_scene *scene) {
    const uint32_t objects = sli_from_region_objects(scene), leaves = scene->space.cell_count;
    const size_t count = scene->items.count;
    sli_item *items = scene->items.items;
    if (count) qsort(items, count, sizeof *items, compare_items);
    scene->words = sl_bits_words(objects);
    scene->first_item = sl_alloc_array(context, (size_t)objects + 1, sizeof *scene->first_item);
    scene->boxes = sl_alloc_array(context, objects, sizeof *scene->boxes);
    scene->leaf_items = sl_alloc_array(context, count, sizeof *scene->leaf_items);
    scene->first_leaf_item =
        sl_alloc_array(context, (size_t)leaves + 2, sizeof *scene->first_leaf_item);
    if (!scene->first_item || !scene->boxes || !scene->leaf_items || !scene->first_leaf_item)
        return SL_NO_MEMORY;
    for (uint32_t i = 0; i < objects; i++)
        scene->boxes[i] = (sl_box){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (size_t i = 0; i < count; i++) {
        scene->first_item[items[i].object + 1]++;
        scene->first_leaf_item[items[i].leaf + 2]++;
        take(&scene->boxes[items[i].object], items[i].left);
        take(&scene->boxes[items[i].object], items[i].right);
    }
    for (uint32_t i = 0; i < objects; i++) scene->first_item[i + 1] += scene->first_item[i];
    for (uint32_t i = 0; i < leaves; i++)
        scene->first_leaf_item[i + 2] += scene->first_leaf_item[i + 1];
    for (size_t i = 0; i < count; i++)
        scene->leaf_items[scene->first_leaf_item[items[i].leaf + 1]++] = (uint32_t)i;
    return SL_OK;
}

sl_status sli_from_region_find_objects(sl_context *context,
                                       const sl_from_region_scene_options *options,
                                       sl_from_region_scene *scene) {
    SL_TRY(add_walls(context, scene));
    if (options->objects == SL_OBJECTS_BOXES) SL_TRY(add_boxes(context, scene));
    if (options->objects == SL_OBJECTS_CELLS) SL_TRY(add_leaves(context, scene));
    const bool walls =
        options->objects == SL_OBJECTS_WALLS || options->objects == SL_OBJECTS_GROUPS;
    SL_TRY(number_walls(context, scene, options->objects == SL_OBJECTS_GROUPS ? options->groups : 0,
                        scene->counts.objects, walls ? &scene->counts.objects : &scene->occluders));
    return index_items(context, scene);
}

/// What the pictures of two plans do not share.
///
/// A drag changes few cells, but each of its frames has a new space, with new numbers. So what is
/// drawn is told by its look, not by its number: by a hash of corners and paint. Both lists are
/// sorted by hash, and one pass over the two finds what only one of them has. A few boxes around
/// that are drawn again. Everything outside of them looks the same in both plans.
///
/// Cost: O(n log n) for n cells, portals and walls. Two different items with one hash of 64 bits
/// would be taken for the same; the picture is drawn as a whole once the drag ends.
#include "plan/changes.h"

#include "draw/draw_plan.h" // private: the paint of cells

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct lister {
    sl_context *context;
    plan_items *items;
} lister;

static uint64_t mix_bits(uint64_t z) {
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

static uint64_t mix_number(uint64_t hash, double number) {
    union {
        double value;
        uint64_t bits;
    } n = {number + 0.0};
    return mix_bits(hash + 0x9e3779b97f4a7c15u + n.bits);
}

/// Adds an item with these corners. `look`: its kind, paint or state.
static sl_status add_item(const lister *l, uint64_t look, const sl_point *corners, size_t count) {
    plan_item item = {mix_bits(look + 1), {corners[0], corners[0]}};
    for (size_t i = 0; i < count; i++) {
        item.hash = mix_number(mix_number(item.hash, corners[i].x), corners[i].y);
        item.box.min.x = fmin(item.box.min.x, corners[i].x);
        item.box.min.y = fmin(item.box.min.y, corners[i].y);
        item.box.max.x = fmax(item.box.max.x, corners[i].x);
        item.box.max.y = fmax(item.box.max.y, corners[i].y);
    }
    SL_TRY(SL_ARRAY_ROOM(l->context, l->items, 1));
    l->items->items[l->items->count++] = item;
    return SL_OK;
}

static sl_status add_segment(const lister *l, uint64_t look, sl_point a, sl_point b) {
    const sl_point ends[2] = {a, b};
    return add_item(l, look, ends, 2);
}

enum { PORTAL = 1000, WALL, DOOR_OPEN, DOOR_SHUT, MIRROR, ONEWAY, OBJECT, BOUNDS, CELL };

static sl_status list_under(const lister *l, const sl_baked *baked, const sl_scene *scene) {
    const sl_space *space = &baked->space;
    uint8_t *paint = sl_alloc_array(l->context, space->cell_count, sizeof *paint);
    if (!paint) return SL_NO_MEMORY;
    sli_scene_get_paint(scene, paint);
    sl_status status = SL_OK;
    for (uint32_t i = 0; i < space->cell_count && status == SL_OK; i++) {
        const sl_cell *cell = &space->cells[i];
        const bool shown = sli_scene_shows(scene, i);
        const uint64_t look = CELL + 4u * paint[i] + 2u * shown + cell->inside;
        status = add_item(l, look, space->vertices + cell->first_vertex, cell->vertex_count);
    }
    for (uint32_t i = 0; i < space->portal_count && status == SL_OK; i++)
        if (sli_scene_shows(scene, space->portals[i].cell[0]))
            status = add_segment(l, PORTAL, space->portals[i].left, space->portals[i].right);
    sl_free(l->context, paint);
    return status;
}

static sl_status list_over(const lister *l, const sl_baked *baked) {
    const sl_space *space = &baked->space;
    const sl_map *map = &baked->map;
    for (uint32_t i = 0; i < space->wall_count; i++)
        SL_TRY(add_segment(l, WALL, space->walls[i].a, space->walls[i].b));
    for (size_t i = 0; i < map->door_count; i++)
        SL_TRY(add_segment(l, map->doors[i].open ? DOOR_OPEN : DOOR_SHUT, map->doors[i].segment.a,
                           map->doors[i].segment.b));
    for (size_t i = 0; i < map->mirror_count; i++)
        SL_TRY(add_segment(l, MIRROR, map->mirrors[i].segment.a, map->mirrors[i].segment.b));
    for (size_t i = 0; i < map->oneway_count; i++)
        SL_TRY(add_segment(l, ONEWAY, map->oneways[i].segment.a, map->oneways[i].segment.b));
    for (size_t i = 0; i < map->object_count; i++)
        SL_TRY(add_segment(l, OBJECT, map->objects[i].box.min, map->objects[i].box.max));
    return SL_OK;
}

static int by_hash(const void *left, const void *right) {
    const plan_item *a = left, *b = right;
    return (a->hash > b->hash) - (a->hash < b->hash);
}

sl_status plan_items_list(sl_context *context, const sl_baked *baked, const sl_scene *scene,
                          bool over, plan_items *items) {
    const lister l = {context, items};
    const sl_box bounds = baked->space.bounds;
    items->count = 0;
    sl_status status = add_segment(&l, BOUNDS, bounds.min, bounds.max);
    if (status == SL_OK) status = over ? list_over(&l, baked) : list_under(&l, baked, scene);
    if (status != SL_OK) items->count = 0;
    if (items->count) qsort(items->items, items->count, sizeof *items->items, by_hash);
    return status;
}

static sl_box join_boxes(sl_box a, sl_box b) {
    return (sl_box){{fmin(a.min.x, b.min.x), fmin(a.min.y, b.min.y)},
                    {fmax(a.max.x, b.max.x), fmax(a.max.y, b.max.y)}};
}

/// The area of a box with a margin: each box is drawn with its surroundings.
static double drawn_area(sl_box box, double margin) {
    return (box.max.x - box.min.x + margin) * (box.max.y - box.min.y + margin);
}

/// Puts a box to the one that grows least, or beside all if it would grow by more than itself.
static int put_box(sl_box boxes[CHANGES_MOST], int count, sl_box box, double margin) {
    int best = -1;
    double least = count < CHANGES_MOST ? drawn_area(box, margin) : INFINITY;
    for (int i = 0; i < count; i++) {
        const double growth =
            drawn_area(join_boxes(boxes[i], box), margin) - drawn_area(boxes[i], margin);
        if (growth > least) continue;
        least = growth;
        best = i;
    }
    if (best < 0) {
        boxes[count] = box;
        return count + 1;
    }
    boxes[best] = join_boxes(boxes[best], box);
    return count;
}

int plan_items_compare(const plan_items *a, const plan_items *b, sl_box boxes[CHANGES_MOST]) {
    double size = 0;
    for (size_t i = 0; i < a->count; i++)
        size = fmax(size, a->items[i].box.max.x - a->items[i].box.min.x);
    int count = 0;
    size_t i = 0, k = 0;
    while (i < a->count || k < b->count) {
        const plan_item *p = i < a->count ? &a->items[i] : NULL;
        const plan_item *q = k < b->count ? &b->items[k] : NULL;
        const plan_item *one = !q || (p && p->hash < q->hash) ? p : q;
        const bool both = p && q && p->hash == q->hash;
        i += both || one == p;
        k += both || one == q;
        if (!both) count = put_box(boxes, count, one->box, size / 8);
    }
    return count;
}

void plan_keep_pens(sl_scene *scene, double *size, double stronger) {
    if (*size > 0) scene->cell_size = *size;
    *size = scene->cell_size;
    scene->cell_size *= stronger;
}

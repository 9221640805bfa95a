#include "space/box_tree.h"

#include <math.h>
#include <stdlib.h>

enum { FAN = 8 };

static double lesser(double a, double b) {
    return a < b ? a : b;
}

static double greater(double a, double b) {
    return a > b ? a : b;
}

sl_box sl_box_around(sl_point a, sl_point b) {
    return (sl_box){{lesser(a.x, b.x), lesser(a.y, b.y)}, {greater(a.x, b.x), greater(a.y, b.y)}};
}

static sl_box joined(sl_box a, sl_box b) {
    return (sl_box){{lesser(a.min.x, b.min.x), lesser(a.min.y, b.min.y)},
                    {greater(a.max.x, b.max.x), greater(a.max.y, b.max.y)}};
}

sl_box sl_box_with(sl_box box, sl_point point) {
    return joined(box, (sl_box){point, point});
}

// --- the order

typedef struct place {
    uint32_t key, item;
} place;

/// The bits of 16, a 0 before each.
static uint32_t spread_bits(uint32_t value) {
    value = (value | value << 8) & 0x00ff00ff;
    value = (value | value << 4) & 0x0f0f0f0f;
    value = (value | value << 2) & 0x33333333;
    return (value | value << 1) & 0x55555555;
}

/// Where along a side of 65,536 steps; rounding moves what is near to what, no more.
static uint32_t step_at(double at, double low, double high) {
    const double share = (at / 2 - low / 2) / (high / 2 - low / 2);
    return share > 0 ? (uint32_t)lesser(share * 65536, 65535) : 0;
}

static int compare_places(const void *left, const void *right) {
    const place *a = left, *b = right;
    if (a->key != b->key) return a->key < b->key ? -1 : 1;
    return (a->item > b->item) - (a->item < b->item);
}

/// The boxes' numbers, sorted along the curve by their middles.
static sl_status sort_items(sl_context *context, const sl_box *boxes, size_t count,
                            uint32_t *items) {
    place *places = sl_alloc_array(context, count, sizeof *places);
    if (!places) return SL_NO_MEMORY;
    sl_box all = boxes[0];
    for (size_t i = 1; i < count; i++) all = joined(all, boxes[i]);
    for (size_t i = 0; i < count; i++) {
        const sl_box *b = &boxes[i];
        const uint32_t x = step_at(b->min.x / 2 + b->max.x / 2, all.min.x, all.max.x);
        const uint32_t y = step_at(b->min.y / 2 + b->max.y / 2, all.min.y, all.max.y);
        places[i] = (place){spread_bits(x) | spread_bits(y) << 1, (uint32_t)i};
    }
    qsort(places, count, sizeof *places, compare_places);
    for (size_t i = 0; i < count; i++) items[i] = places[i].item;
    sl_free(context, places);
    return SL_OK;
}

// --- the tree

/// Counts the boxes of each level; the last has one.
static void lay_out(sl_box_tree *tree, size_t count) {
    while (true) {
        tree->first[tree->levels + 1] = tree->first[tree->levels] + count;
        tree->levels++;
        if (count == 1) return;
        count = (count + FAN - 1) / FAN;
    }
}

static void fill_level(sl_box_tree *tree, uint32_t level) {
    const sl_box *below = tree->boxes + tree->first[level - 1];
    const size_t count = tree->first[level] - tree->first[level - 1];
    for (size_t i = 0; i < count; i++) {
        sl_box *box = &tree->boxes[tree->first[level] + i / FAN];
        *box = i % FAN ? joined(*box, below[i]) : below[i];
    }
}

sl_status sl_box_tree_create(sl_context *context, const sl_box *boxes, size_t count,
                             sl_box_tree *out) {
    *out = (sl_box_tree){0};
    if (!count) return SL_OK;
    lay_out(out, count);
    out->items = sl_alloc_array(context, count, sizeof *out->items);
    out->boxes = sl_alloc_array(context, out->first[out->levels], sizeof *out->boxes);
    if (!out->items || !out->boxes) return SL_NO_MEMORY;
    SL_TRY(sort_items(context, boxes, count, out->items));
    for (size_t i = 0; i < count; i++) out->boxes[i] = boxes[out->items[i]];
    for (uint32_t level = 1; level < out->levels; level++) fill_level(out, level);
    return SL_OK;
}

void sl_box_tree_destroy(sl_context *context, sl_box_tree *tree) {
    sl_free(context, tree->items);
    sl_free(context, tree->boxes);
    *tree = (sl_box_tree){0};
}

// --- finding

static bool boxes_meet(const sl_box *a, const sl_box *b) {
    return a->min.x <= b->max.x && a->max.x >= b->min.x && a->min.y <= b->max.y &&
           a->max.y >= b->min.y;
}

static int compare_items(const void *left, const void *right) {
    const uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
    return (a > b) - (a < b);
}

/// What of a level lies below a box of the one above it, or on the highest all.
static sl_status find_below(sl_context *context, const sl_box_tree *tree, uint32_t level,
                            size_t begin, const sl_box *box, sl_box_list *found) {
    const size_t first = tree->first[level], count = tree->first[level + 1] - first;
    const size_t end = count - begin < FAN ? count : begin + FAN;
    if (level == 0) SL_TRY(SL_ARRAY_ROOM(context, found, FAN));
    for (size_t i = begin; i < end; i++) {
        if (!boxes_meet(&tree->boxes[first + i], box)) continue;
        if (level)
            SL_TRY(find_below(context, tree, level - 1, i * FAN, box, found));
        else
            found->items[found->count++] = tree->items[i];
    }
    return SL_OK;
}

sl_status sl_box_tree_find(sl_context *context, const sl_box_tree *tree, const sl_box *box,
                           sl_box_list *found) {
    found->count = 0;
    if (!tree->levels) return SL_OK;
    SL_TRY(find_below(context, tree, tree->levels - 1, 0, box, found));
    if (found->count > 1) qsort(found->items, found->count, sizeof *found->items, compare_items);
    return SL_OK;
}

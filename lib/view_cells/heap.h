/// A priority queue: the largest key first, of equal ones that with the lowest numbers.
#ifndef SL_VIEW_HEAP_H
#define SL_VIEW_HEAP_H

#include "sightline/support.h"

typedef struct sl_heap_item {
    double key;
    uint32_t a, b;
} sl_heap_item;

typedef SL_ARRAY(sl_heap_item) sl_heap;

static inline bool sl_heap_before(const sl_heap_item *x, const sl_heap_item *y) {
    if (x->key != y->key) return x->key > y->key;
    return x->a != y->a ? x->a < y->a : x->b < y->b;
}

static inline sl_status sl_heap_push(sl_context *context, sl_heap *heap, sl_heap_item item) {
    SL_TRY(SL_ARRAY_ROOM(context, heap, 1));
    size_t at = heap->count++;
    while (at && sl_heap_before(&item, &heap->items[(at - 1) / 2])) {
        heap->items[at] = heap->items[(at - 1) / 2];
        at = (at - 1) / 2;
    }
    heap->items[at] = item;
    return SL_OK;
}

/// Takes the first item; there must be one.
static inline sl_heap_item sl_heap_pop(sl_heap *heap) {
    const sl_heap_item top = heap->items[0], last = heap->items[--heap->count];
    size_t at = 0;
    while (true) {
        size_t next = 2 * at + 1;
        if (next >= heap->count) break;
        if (next + 1 < heap->count && sl_heap_before(&heap->items[next + 1], &heap->items[next]))
            next++;
        if (!sl_heap_before(&heap->items[next], &last)) break;
        heap->items[at] = heap->items[next];
        at = next;
    }
    if (heap->count) heap->items[at] = last;
    return top;
}

#endif

/// A binary heap of points that paths have reached: the least key first, then the lower number.
#ifndef SL_VGA_HEAP_H
#define SL_VGA_HEAP_H

#include "sightline/support.h"

/// No point.
#define SLI_VGA_NONE UINT32_MAX

typedef struct sli_vga_entry {
    float key;
    uint32_t number; ///< of the point
    uint32_t at,
        before;    ///< the point, and the one of the path before it or none, as searches have them
    uint32_t next; ///< for lists of entries: the next one, or none
} sli_vga_entry;

typedef SL_ARRAY(sli_vga_entry) sli_vga_heap;

static inline bool sli_vga_is_before(const sli_vga_entry *a, const sli_vga_entry *b) {
    return a->key < b->key || (a->key == b->key && a->number < b->number);
}

static inline sl_status sli_vga_push(sl_context *context, sli_vga_heap *heap, sli_vga_entry e) {
    SL_TRY(SL_ARRAY_ROOM(context, heap, 1));
    size_t i = heap->count++;
    for (; i && sli_vga_is_before(&e, &heap->items[(i - 1) / 2]); i = (i - 1) / 2)
        heap->items[i] = heap->items[(i - 1) / 2];
    heap->items[i] = e;
    return SL_OK;
}

static inline sli_vga_entry sli_vga_pop(sli_vga_heap *heap) {
    sli_vga_entry *items = heap->items;
    const sli_vga_entry first = items[0], moved = items[--heap->count];
    size_t i = 0;
    for (;;) {
        size_t child = 2 * i + 1;
        if (child >= heap->count) break;
        if (child + 1 < heap->count && sli_vga_is_before(&items[child + 1], &items[child])) child++;
        if (!sli_vga_is_before(&items[child], &moved)) break;
        items[i] = items[child];
        i = child;
    }
    items[i] = moved;
    return first;
}

#endif

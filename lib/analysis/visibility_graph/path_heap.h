/// Heaps of points that paths have reached: the least key first, then the lower number.
#ifndef SL_VGA_HEAP_H
#define SL_VGA_HEAP_H

#include "base/heap.h"

/// No point.
#define SLI_VGA_NONE UINT32_MAX

typedef struct sli_vga_entry {
    float key;
    uint32_t number; ///< of the point
    uint32_t at,
        before;    ///< the point, and the one of the path before it or none, as searches have them
    uint32_t next; ///< for lists of entries: the next one, or none
} sli_vga_entry;

static inline bool sli_vga_is_before(const sli_vga_entry *a, const sli_vga_entry *b) {
    return a->key < b->key || (a->key == b->key && a->number < b->number);
}

SLI_HEAP(sli_vga_heap, sli_vga_entry, sli_vga_is_before)

#endif

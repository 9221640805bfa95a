/// A binary heap (Williams 1964, Algorithm 232) in an SL_ARRAY, of any items in any order.
#ifndef SL_HEAP_H
#define SL_HEAP_H

#include "sightline/support.h"

/// Writes NAME_push(context, heap, item) and NAME_pop(heap), for heaps of type NAME: an SL_ARRAY of
/// `item`. `is_before(a, b)`, of pointers to items, says which one leaves the heap first. Where it
/// says so of neither, the same pushes and pops give the same order again. A heap that is popped
/// must not be empty.
// NOLINTBEGIN(bugprone-macro-parentheses): names and types cannot stand in parentheses
#define SLI_HEAP(name, item, is_before)                                                            \
    typedef SL_ARRAY(item) name;                                                                   \
    static inline sl_status name##_push(sl_context *context, name *heap, item pushed) {            \
        SL_TRY(SL_ARRAY_ROOM(context, heap, 1));                                                   \
        item *items = heap->items;                                                                 \
        size_t i = heap->count++;                                                                  \
        for (; i && is_before(&pushed, &items[(i - 1) / 2]); i = (i - 1) / 2)                      \
            items[i] = items[(i - 1) / 2];                                                         \
        items[i] = pushed;                                                                         \
        return SL_OK;                                                                              \
    }                                                                                              \
    static inline item name##_pop(name *heap) {                                                    \
        item *items = heap->items;                                                                 \
        const item first = items[0], moved = items[--heap->count];                                 \
        size_t i = 0;                                                                              \
        for (size_t child; (child = 2 * i + 1) < heap->count; i = child) {                         \
            if (child + 1 < heap->count && is_before(&items[child + 1], &items[child])) child++;   \
            if (!is_before(&items[child], &moved)) break;                                          \
            items[i] = items[child];                                                               \
        }                                                                                          \
        items[i] = moved;                                                                          \
        return first;                                                                              \
    }
// NOLINTEND(bugprone-macro-parentheses)

#endif

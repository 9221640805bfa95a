/// Passages in a baked file: each is there twice, for the two cells beside its wall, so that a
/// reader finds those of a cell as it finds its portals.
#include "bake/slv.h"
#include "sightline/support.h"

#include <stdlib.h>
#include <string.h>

static int compare_items(const void *left, const void *right) {
    const sli_slv_passage *a = left, *b = right;
    if (a->cell != b->cell) return a->cell < b->cell ? -1 : 1;
    return (a->wall > b->wall) - (a->wall < b->wall);
}

static int compare_passages(const void *left, const void *right) {
    const sl_passage *a = left, *b = right;
    return (a->wall > b->wall) - (a->wall < b->wall);
}

sl_status sli_slv_list_passages(sl_context *context, const sl_space *space, sli_slv_passage **out) {
    const size_t count = 2 * (size_t)space->passage_count;
    sli_slv_passage *items = sl_alloc_array(context, count, sizeof *items);
    if (!items) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) {
        const sl_passage *p = &space->passages[i / 2];
        items[i] = (sli_slv_passage){.cell = p->cell[i % 2],
                                     .wall = p->wall | (i % 2 ? SL_NEIGHBOUR_RIGHT : 0),
                                     .other = p->cell[1 - i % 2],
                                     .stops = p->stops};
    }
    if (count) qsort(items, count, sizeof *items, compare_items);
    *out = items;
    return SL_OK;
}

sl_status sli_slv_take_passages(sl_context *context, const sli_slv_passage *items, uint64_t count,
                                sl_space *space, bool *sound) {
    sli_slv_passage *again = NULL;
    *sound = count % 2 == 0 && count / 2 <= space->wall_count;
    if (!count || !*sound) return SL_OK;
    space->passages = sl_alloc_array(context, (size_t)count / 2, sizeof *space->passages);
    if (!space->passages) return SL_NO_MEMORY;
    for (uint64_t i = 0; i < count && *sound; i++) {
        if (items[i].wall & SL_NEIGHBOUR_RIGHT) continue;
        *sound = space->passage_count < count / 2;
        if (*sound)
            space->passages[space->passage_count++] =
                (sl_passage){items[i].wall, items[i].stops, {items[i].cell, items[i].other}};
    }
    *sound &= space->passage_count == count / 2;
    if (!*sound) return SL_OK;
    qsort(space->passages, space->passage_count, sizeof *space->passages, compare_passages);
    SL_TRY(sli_slv_list_passages(context, space, &again));
    *sound = memcmp(again, items, (size_t)count * sizeof *again) == 0;
    sl_free(context, again);
    return SL_OK;
}

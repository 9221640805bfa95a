#include "eye_to_cell/spread.h"

/// Looks at the cells beside one that is kept.
static size_t look_around(sl_eye_query *query, sl_spread_test *test, uint32_t from, uint32_t *queue,
                          size_t queued) {
    const sl_cell *cell = &query->space->cells[from];
    for (uint32_t i = 0; i < cell->directed_count; i++) {
        const sl_directed_portal *directed = &query->space->directed[cell->first_directed + i];
        if (sl_bits_has(query->cells, directed->cell) || !sl_eye_may_see(query, directed->cell))
            continue;
        query->nodes++;
        if (!test(query, directed)) continue;
        sl_bits_add(query->cells, directed->cell);
        queue[queued++] = directed->cell;
    }
    return queued;
}

sl_status sl_eye_spread(sl_context *context, sl_eye_query *query, sl_spread_test *test) {
    if (query->cell == SL_NO_CELL) return SL_OK;
    uint32_t *queue = query->search->queue;
    size_t queued = 0;
    sl_bits_add(query->cells, query->cell);
    queue[queued++] = query->cell;
    query->nodes = 1;
    for (size_t at = 0; at < queued; at++) {
        if (at % 4096 == 4095) SL_TRY(sl_check_cancelled(context));
        queued = look_around(query, test, queue[at], queue, queued);
    }
    return SL_OK;
}

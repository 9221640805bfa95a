#include "history.h"

#include "map_copy.h"

#include <string.h>

static void clear(sl_context *context, sl_map *list, size_t *count) {
    while (*count) sl_map_destroy(context, &list[--*count]);
}

/// The oldest makes room.
static sl_status push(sl_context *context, sl_map *list, size_t *count, const sl_map *map) {
    sl_map copy = {0};
    const sl_status status = sl_map_copy(context, map, &copy);
    if (status != SL_OK) return status;
    if (*count == SL_HISTORY_MOST) {
        sl_map_destroy(context, &list[0]);
        memmove(list, list + 1, --*count * sizeof *list);
    }
    list[(*count)++] = copy;
    return SL_OK;
}

sl_status sl_history_keep(sl_context *context, sl_history *history, const sl_map *map) {
    clear(context, history->undone, &history->undone_count);
    return push(context, history->done, &history->done_count, map);
}

void sl_history_forget_last(sl_context *context, sl_history *history) {
    if (history->done_count) sl_map_destroy(context, &history->done[--history->done_count]);
}

bool sl_history_undo(sl_context *context, sl_history *history, sl_map *map, bool redo, bool *bake,
                     sl_status *status) {
    sl_map *from = redo ? history->undone : history->done;
    sl_map *to = redo ? history->done : history->undone;
    size_t *from_count = redo ? &history->undone_count : &history->done_count;
    size_t *to_count = redo ? &history->done_count : &history->undone_count;
    if (!*from_count) return false;
    *status = push(context, to, to_count, map);
    if (*status != SL_OK) return true;
    const sl_map last = from[--*from_count];
    *bake = !sl_map_same_bake(map, &last);
    sl_map_destroy(context, map);
    *map = last;
    return true;
}

void sl_history_clear(sl_context *context, sl_history *history) {
    clear(context, history->done, &history->done_count);
    clear(context, history->undone, &history->undone_count);
}

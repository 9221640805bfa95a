#include "history.h"

#include "base/base.h"
#include "map_copy.h"

#include <string.h>

static void clear(sl_context *context, sl_walls *list, size_t *count) {
    while (*count) sl_free(context, list[--*count].walls);
}

/// The oldest makes room.
static sl_status push(sl_context *context, sl_walls *list, size_t *count, const sl_map *map) {
    sl_walls copy = {sl_alloc_array(context, map->wall_count, sizeof *copy.walls), map->wall_count};
    if (!copy.walls) return SL_NO_MEMORY;
    if (map->wall_count) memcpy(copy.walls, map->walls, map->wall_count * sizeof *copy.walls);
    if (*count == SL_HISTORY_MOST) {
        sl_free(context, list[0].walls);
        memmove(list, list + 1, --*count * sizeof *list);
    }
    list[(*count)++] = copy;
    return SL_OK;
}

sl_status sl_history_keep(sl_context *context, sl_history *history, const sl_map *map) {
    clear(context, history->undone, &history->undone_count);
    return push(context, history->done, &history->done_count, map);
}

bool sl_history_undo(sl_context *context, sl_history *history, sl_map *map, bool redo,
                     sl_status *status) {
    sl_walls *from = redo ? history->undone : history->done;
    sl_walls *to = redo ? history->done : history->undone;
    size_t *from_count = redo ? &history->undone_count : &history->done_count;
    size_t *to_count = redo ? &history->done_count : &history->undone_count;
    if (!*from_count) return false;
    *status = push(context, to, to_count, map);
    if (*status != SL_OK) return true;
    const sl_walls last = from[--*from_count];
    *status = sl_map_set_walls(context, map, last.walls, last.count);
    sl_free(context, last.walls);
    return true;
}

void sl_history_clear(sl_context *context, sl_history *history) {
    clear(context, history->done, &history->done_count);
    clear(context, history->undone, &history->undone_count);
}

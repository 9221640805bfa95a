#include "history.h"

#include "sightline/support.h"

#include <string.h>

static void clear(sl_context *context, sl_map *list, size_t *count) {
    while (*count) sl_map_destroy(context, &list[--*count]);
}

/// Adds the number of a state as push adds its map: `count` is that after push.
static void push_state(uint64_t *states, size_t count, uint64_t state, bool dropped) {
    if (dropped) memmove(states, states + 1, (count - 1) * sizeof *states);
    states[count - 1] = state;
}

/// The oldest change is dropped for a new one.
static sl_status push(sl_context *context, sl_map *list, size_t *count, const sl_map *map) {
    sl_map copy = {0};
    const sl_status status = sl_map_copy(context, map, &copy);
    if (status != SL_OK) return status;
    if (*count == HISTORY_MOST) {
        sl_map_destroy(context, &list[0]);
        memmove(list, list + 1, --*count * sizeof *list);
    }
    list[(*count)++] = copy;
    return SL_OK;
}

sl_status history_keep(sl_context *context, edit_history *history, const sl_map *map) {
    const bool full = history->done_count == HISTORY_MOST;
    clear(context, history->undone, &history->undone_count);
    SL_TRY(push(context, history->done, &history->done_count, map));
    push_state(history->done_state, history->done_count, history->state, full);
    history->state = ++history->last_state;
    return SL_OK;
}

void history_forget_last(sl_context *context, edit_history *history) {
    if (!history->done_count) return;
    sl_map_destroy(context, &history->done[--history->done_count]);
    history->state = history->done_state[history->done_count];
}

bool history_take_back(sl_context *context, edit_history *history, sl_map *map) {
    if (!history->done_count) return false;
    sl_map_destroy(context, map);
    *map = history->done[--history->done_count];
    history->state = history->done_state[history->done_count];
    return true;
}

static bool same_segment(sl_segment a, sl_segment b) {
    return a.a.x == b.a.x && a.a.y == b.a.y && a.b.x == b.b.x && a.b.y == b.b.y;
}

static bool same_glass(const sl_glass *a, size_t a_count, const sl_glass *b, size_t b_count) {
    bool same = a_count == b_count;
    for (size_t i = 0; i < a_count && same; i++)
        same = same_segment(a[i].segment, b[i].segment) && a[i].one_sided == b[i].one_sided;
    return same;
}

/// Whether two maps are equal for a bake: doors may be open or shut.
static bool same_bake(const sl_map *a, const sl_map *b) {
    bool same = a->wall_count == b->wall_count && a->door_count == b->door_count &&
                a->cell_count == b->cell_count && a->range == b->range;
    for (size_t i = 0; i < a->wall_count && same; i++)
        same = same_segment((sl_segment){a->walls[i].a, a->walls[i].b},
                            (sl_segment){b->walls[i].a, b->walls[i].b});
    for (size_t i = 0; i < a->door_count && same; i++)
        same = same_segment(a->doors[i].segment, b->doors[i].segment);
    return same && same_glass(a->mirrors, a->mirror_count, b->mirrors, b->mirror_count) &&
           same_glass(a->oneways, a->oneway_count, b->oneways, b->oneway_count) &&
           same_glass(a->seams, a->seam_count, b->seams, b->seam_count);
}

bool history_undo(sl_context *context, edit_history *history, sl_map *map, bool redo, bool *bake,
                  sl_status *status) {
    sl_map *from = redo ? history->undone : history->done;
    sl_map *to = redo ? history->done : history->undone;
    size_t *from_count = redo ? &history->undone_count : &history->done_count;
    size_t *to_count = redo ? &history->done_count : &history->undone_count;
    const bool full = *to_count == HISTORY_MOST;
    if (!*from_count) return false;
    *status = push(context, to, to_count, map);
    if (*status != SL_OK) return true;
    push_state(redo ? history->done_state : history->undone_state, *to_count, history->state, full);
    const sl_map last = from[--*from_count];
    history->state = (redo ? history->undone_state : history->done_state)[*from_count];
    *bake = !same_bake(map, &last);
    sl_map_destroy(context, map);
    *map = last;
    return true;
}

void history_clear(sl_context *context, edit_history *history) {
    clear(context, history->done, &history->done_count);
    clear(context, history->undone, &history->undone_count);
    history->state = ++history->last_state;
}

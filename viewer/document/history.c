/// Two stacks of maps; and whether a change needs a new bake.
#include "document/history.h"

#include "sightline/support.h"

#include <string.h>

static void clear_list(sl_context *context, kept_maps *list) {
    while (list->count) sl_map_destroy(context, &list->items[--list->count].map);
}

/// The oldest change is dropped for a new one.
static sl_status push_map(sl_context *context, kept_maps *list, const sl_map *map, uint64_t state) {
    sl_map copy = {0};
    SL_TRY(sl_map_copy(context, map, &copy));
    if (list->count == HISTORY_MOST) {
        sl_map_destroy(context, &list->items[0].map);
        memmove(list->items, list->items + 1, --list->count * sizeof *list->items);
    }
    list->items[list->count++] = (kept_map){copy, state};
    return SL_OK;
}

/// The last one of a list takes the map's place.
static void pop_map(sl_context *context, edit_history *history, kept_maps *list, sl_map *map) {
    const kept_map last = list->items[--list->count];
    sl_map_destroy(context, map);
    *map = last.map;
    history->state = last.state;
}

sl_status history_keep(sl_context *context, edit_history *history, const sl_map *map) {
    clear_list(context, &history->undone);
    SL_TRY(push_map(context, &history->done, map, history->state));
    history->state = ++history->last_state;
    return SL_OK;
}

void history_forget_last(sl_context *context, edit_history *history) {
    sl_map unused = {0};
    if (!history->done.count) return;
    pop_map(context, history, &history->done, &unused);
    sl_map_destroy(context, &unused);
}

bool history_take_back(sl_context *context, edit_history *history, sl_map *map) {
    if (!history->done.count) return false;
    pop_map(context, history, &history->done, map);
    return true;
}

static bool same_segment(sl_segment a, sl_segment b) {
    return a.a.x == b.a.x && a.a.y == b.a.y && a.b.x == b.b.x && a.b.y == b.b.y;
}

static bool same_glass(const sl_glass *a, size_t a_count, const sl_glass *b, size_t b_count) {
    bool same = a_count == b_count;
    for (size_t i = 0; i < a_count && same; i++)
        same = same_segment(a[i].segment, b[i].segment) && a[i].one_sided == b[i].one_sided &&
               a[i].stops == b[i].stops;
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
    kept_maps *from = redo ? &history->undone : &history->done;
    kept_maps *to = redo ? &history->done : &history->undone;
    if (!from->count) return false;
    *status = push_map(context, to, map, history->state);
    if (*status != SL_OK) return true;
    *bake = !same_bake(map, &from->items[from->count - 1].map);
    pop_map(context, history, from, map);
    return true;
}

void history_clear(sl_context *context, edit_history *history) {
    clear_list(context, &history->done);
    clear_list(context, &history->undone);
    history->state = ++history->last_state;
}

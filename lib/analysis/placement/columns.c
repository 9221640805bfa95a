/// Sets of witnesses that one place sees, for the lower bound.
///
/// The regions of the witnesses cut the plane into faces. Go from any point towards the border of
/// its face: closed regions that hold the point hold the border, too. So each largest set of
/// regions with a point in common has one on a window, or is that of a part without windows. Along
/// a window, regions are entered and left. A set can be largest only where one is left that was
/// entered since the last one was left:
///
///      apex ---[1---[2------1]----[3----2]--3]----> far
///                   |1,2|   |         |2,3|
///
/// Of events at one spot, entering counts first: all regions that touch the spot hold it.
#include "analysis/placement/columns.h"
#include "base/base.h"

#include "geometry/length.h"
#include "geometry/orient.h"

#include <stdlib.h>

void sli_place_columns_destroy(sl_context *context, sli_place_columns *columns) {
    sl_free(context, columns->ends.items);
    sl_free(context, columns->entries.items);
    sl_free(context, columns->places.items);
    *columns = (sli_place_columns){0};
}

void sli_crossings_destroy(sl_context *context, sli_crossings *crossings) {
    for (size_t i = 0; i < crossings->windows.count; i++)
        sl_free(context, crossings->windows.items[i].items);
    sl_free(context, crossings->windows.items);
    sli_nearby_destroy(context, &crossings->near);
    *crossings = (sli_crossings){0};
}

/// Keeps events of looks that have a number.
static void keep_events(sli_crossing_events *all, const uint32_t *numbers) {
    size_t count = 0;
    for (size_t i = 0; i < all->count; i++) {
        sli_crossing_event e = all->items[i];
        e.look = numbers[e.look];
        if (e.look != UINT32_MAX) all->items[count++] = e;
    }
    all->count = count;
}

sl_status sli_crossings_keep(sl_context *context, sli_crossings *all, const sli_look *const *looks,
                             const bool *kept) {
    uint32_t *numbers = sl_alloc_array(context, all->known, sizeof *numbers);
    if (!numbers) return SL_NO_MEMORY;
    uint32_t count = 0;
    for (uint32_t i = 0; i < all->known; i++) numbers[i] = kept[i] ? count++ : UINT32_MAX;
    size_t from = 0, to = 0;
    for (uint32_t i = 0; i < all->known; i++)
        for (uint32_t w = 0; w < looks[i]->window_count; w++, from++) {
            sli_crossing_events events = all->windows.items[from];
            if (kept[i]) {
                keep_events(&events, numbers);
                all->windows.items[to++] = events;
            } else {
                sl_free(context, events.items);
            }
        }
    all->windows.count = to;
    all->known = count;
    sli_nearby_clear(context, &all->near);
    sl_free(context, numbers);
    return SL_OK;
}

typedef sli_crossing_event event;

typedef struct collector {
    sl_context *context;
    const sli_ground *ground;
    const sli_look *const *looks;
    uint32_t count;
    sli_place_columns *out;
    sli_spans spans;
    sli_crossings *crossings;
    sli_crossing_events fresh;
    event *spare;
    size_t spare_room;
    uint32_t *here, *where; ///< the looks that hold the spot, and their places in this list
    uint32_t here_count;
    uint64_t hash;
    uint32_t *table; ///< of columns by hash, and one more: open addressing
    size_t table_size;
    uint32_t *sorted;
} collector;

static uint64_t hash_of(uint32_t look) {
    sl_random random = {look};
    return sl_random_next(&random);
}

static bool same_column(const sli_place_columns *all, size_t column, const uint32_t *entries,
                        uint32_t count) {
    const size_t first = column ? all->ends.items[column - 1] : 0;
    if (all->ends.items[column] - first != count) return false;
    for (uint32_t i = 0; i < count; i++)
        if (all->entries.items[first + i] != entries[i]) return false;
    return true;
}

static sl_status grow_table(collector *c) {
    const size_t size = c->table_size ? 2 * c->table_size : 1024;
    uint32_t *table = sl_alloc_array(c->context, size, sizeof *table);
    if (!table) return SL_NO_MEMORY;
    size_t from = 0;
    for (size_t i = 0; i < c->out->ends.count; i++) {
        uint64_t hash = 0;
        for (; from < c->out->ends.items[i]; from++) hash ^= hash_of(c->out->entries.items[from]);
        size_t at = hash & (size - 1);
        while (table[at]) at = (at + 1) & (size - 1);
        table[at] = (uint32_t)i + 1;
    }
    sl_free(c->context, c->table);
    c->table = table;
    c->table_size = size;
    return SL_OK;
}

/// Adds what holds the current spot as a column, once.
static sl_status emit(collector *c, sli_window_part place) {
    sli_place_columns *out = c->out;
    if (2 * (out->ends.count + 1) > c->table_size) SL_TRY(grow_table(c));
    for (uint32_t i = 0; i < c->here_count; i++) c->sorted[i] = c->here[i];
    qsort(c->sorted, c->here_count, sizeof *c->sorted, sli_compare_whole);
    size_t at = c->hash & (c->table_size - 1);
    for (; c->table[at]; at = (at + 1) & (c->table_size - 1)) {
        const uint32_t column = c->table[at] - 1;
        if (same_column(out, column, c->sorted, c->here_count)) return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(c->context, &out->entries, c->here_count));
    SL_TRY(SL_ARRAY_ROOM(c->context, &out->ends, 1));
    SL_TRY(SL_ARRAY_ROOM(c->context, &out->places, 1));
    for (uint32_t i = 0; i < c->here_count; i++)
        out->entries.items[out->entries.count++] = c->sorted[i];
    out->ends.items[out->ends.count++] = out->entries.count;
    out->places.items[out->places.count++] = place;
    c->table[at] = (uint32_t)out->ends.count;
    return SL_OK;
}

static void enter(collector *c, uint32_t look) {
    c->where[look] = c->here_count;
    c->here[c->here_count++] = look;
    c->hash ^= hash_of(look);
}

static void leave(collector *c, uint32_t look) {
    const uint32_t last = c->here[--c->here_count], at = c->where[look];
    c->here[at] = last;
    c->where[last] = at;
    c->hash ^= hash_of(look);
}

static bool comes_first(const sl_segment *line, const event *a, const event *b) {
    const int order = sli_spot_order(line, &a->spot, &b->spot);
    return order ? order < 0 : a->leaves < b->leaves;
}

/// A merge sort: stable, whatever the comparisons cost.
static void sort_events(const sl_segment *line, event *events, event *spare, size_t count) {
    if (count < 2) return;
    const size_t half = count / 2;
    sort_events(line, events, spare, half);
    sort_events(line, events + half, spare, count - half);
    for (size_t i = 0; i < half; i++) spare[i] = events[i];
    size_t a = 0, b = half, to = 0;
    while (a < half)
        events[to++] =
            b < count && comes_first(line, &events[b], &spare[a]) ? events[b++] : spare[a++];
}

/// Whether a region touches the track only at the apex, and there from between other walls: nobody
/// who stands there sees both.
static bool is_parted(const collector *c, const sli_track *track, const sli_span *span,
                      uint32_t look) {
    const sl_segment *line = &track->line;
    return sli_spot_order(line, &span->to, &track->start) == 0 &&
           !sli_ground_joins(c->ground, line->b, line->a, c->looks[look]->eye);
}

/// The events of looks from `from` on, sorted.
static sl_status list_events(collector *c, const sli_track *track, uint32_t mine, uint32_t from) {
    sli_nearby *near = &c->crossings->near;
    c->fresh.count = 0;
    SL_TRY(sli_nearby_find(c->context, near, sli_track_box(track, &c->ground->space->bounds)));
    for (size_t k = 0; k < near->found.count; k++) {
        const uint32_t j = near->found.items[k];
        if (j == mine || j < from) continue;
        SL_TRY(sli_track_spans(c->context, track, c->looks[j], false, &c->spans));
        SL_TRY(SL_ARRAY_ROOM(c->context, &c->fresh, 2 * c->spans.count));
        for (size_t i = 0; i < c->spans.count; i++) {
            if (is_parted(c, track, &c->spans.items[i], j)) continue;
            c->fresh.items[c->fresh.count++] = (event){c->spans.items[i].from, j, false};
            c->fresh.items[c->fresh.count++] = (event){c->spans.items[i].to, j, true};
        }
    }
    SL_TRY(sl_reserve(c->context, &c->spare, &c->spare_room, c->fresh.count, sizeof *c->spare));
    sort_events(&track->line, c->fresh.items, c->spare, c->fresh.count);
    return SL_OK;
}

/// Merges the fresh events with those that a window has.
static sl_status merge_events(collector *c, const sli_track *track, sli_crossing_events *all) {
    SL_TRY(SL_ARRAY_ROOM(c->context, all, c->fresh.count));
    size_t a = all->count, b = c->fresh.count, to = a + b;
    all->count = to;
    while (b) {
        if (a && comes_first(&track->line, &c->fresh.items[b - 1], &all->items[a - 1]))
            all->items[--to] = all->items[--a];
        else
            all->items[--to] = c->fresh.items[--b];
    }
    return SL_OK;
}

static sl_status walk_window(collector *c, uint32_t mine, uint32_t window,
                             sli_crossing_events *all) {
    const sli_track track = sli_track_of(c->looks[mine], window);
    SL_TRY(list_events(c, &track, mine, mine < c->crossings->known ? c->crossings->known : 0));
    SL_TRY(merge_events(c, &track, all));
    const size_t count = all->count;
    c->here_count = 0;
    c->hash = 0;
    enter(c, mine);
    sli_window_part place = {mine, window, 1, 1};
    bool entered = true;
    for (size_t i = 0; i < count; i++) {
        const event *e = &all->items[i];
        if (!e->leaves) {
            enter(c, e->look);
            place.from = sli_spot_share(&e->spot);
            entered = true;
            continue;
        }
        place.to = sli_spot_share(&e->spot);
        if (entered) SL_TRY(emit(c, place));
        entered = false;
        leave(c, e->look);
    }
    place.to = sli_spot_share(&track.end);
    return entered ? emit(c, place) : SL_OK;
}

/// A region without windows is a whole part of the plan: all that see into it see the eye.
static sl_status add_whole(collector *c, uint32_t mine) {
    c->here_count = 0;
    c->hash = 0;
    for (uint32_t j = 0; j < c->count; j++)
        if (sli_box_holds(&c->looks[mine]->bounds, c->looks[j]->eye) &&
            sli_look_holds(c->looks[mine], c->looks[j]->eye))
            enter(c, j);
    return emit(c, (sli_window_part){mine, SLI_NO_WINDOW, 0, 0});
}

static sl_status collect(collector *c) {
    c->here = sl_alloc_array(c->context, c->count, sizeof *c->here);
    c->where = sl_alloc_array(c->context, c->count, sizeof *c->where);
    c->sorted = sl_alloc_array(c->context, c->count, sizeof *c->sorted);
    if (!c->here || !c->where || !c->sorted) return SL_NO_MEMORY;
    size_t at = 0, windows = 0;
    sli_crossings *all = c->crossings;
    for (uint32_t i = 0; i < c->count; i++) windows += c->looks[i]->window_count;
    for (size_t i = all->near.boxes.count; i < c->count; i++)
        SL_TRY(sli_nearby_add(c->context, &all->near, c->looks[i]->bounds));
    SL_TRY(SL_ARRAY_ROOM(c->context, &all->windows, windows - all->windows.count));
    while (all->windows.count < windows)
        all->windows.items[all->windows.count++] = (sli_crossing_events){0};
    for (uint32_t i = 0; i < c->count; i++) {
        SL_TRY(sl_check_cancelled(c->context));
        if (!c->looks[i]->window_count) SL_TRY(add_whole(c, i));
        for (uint32_t w = 0; w < c->looks[i]->window_count; w++)
            SL_TRY(walk_window(c, i, w, &all->windows.items[at++]));
    }
    all->known = c->count;
    return SL_OK;
}

sl_status sli_place_columns_make(sl_context *context, const sli_ground *ground,
                                 const sli_look *const *looks, uint32_t count,
                                 sli_crossings *crossings, sli_place_columns *out) {
    collector c = {.crossings = crossings,
                   .context = context,
                   .ground = ground,
                   .looks = looks,
                   .count = count,
                   .out = out};
    *out = (sli_place_columns){0};
    const sl_status status = collect(&c);
    sl_free(context, c.spans.items);
    sl_free(context, c.fresh.items);
    sl_free(context, c.spare);
    sl_free(context, c.here);
    sl_free(context, c.where);
    sl_free(context, c.table);
    sl_free(context, c.sorted);
    if (status != SL_OK) sli_place_columns_destroy(context, out);
    return status;
}

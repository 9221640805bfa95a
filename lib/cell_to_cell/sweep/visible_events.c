/// Sorts the start and end events of visible intervals by angle about the point.
///
/// A rough angle in doubles sorts the events first (merge sort of short runs). Exact predicates
/// then compare neighbours and move the few events that stand wrong. Events at one angle become
/// one. Cost: n log n cheap comparisons of numbers, and about n exact ones.
#include "cell_to_cell/sweep/visible.h"

#include <math.h>
#include <string.h>

// --- intervals that have grown together

static bool touch(const sli_visible_finder *r, const sli_visible_interval *a,
                  const sli_visible_interval *b) {
    return !sli_is_gap(r, a->high, b->low) && !sli_is_gap(r, b->high, a->low);
}

static void join_touching(const sli_visible_finder *r, sli_visible_interval *a,
                          const sli_visible_interval *gone) {
    if (sli_is_before(r, gone->low, a->low)) a->low = gone->low;
    if (sli_is_before(r, a->high, gone->high)) a->high = gone->high;
}

/// Joins one pair of a cell's intervals, the later one into the earlier; false where there is none.
static bool join_two(const sli_visible_finder *r, sli_visible *visible, uint32_t cell) {
    sli_visible_interval *all = visible->cells.items;
    for (uint32_t *late = &r->last[cell]; *late != UINT32_MAX; late = &all[*late].other) {
        sli_visible_interval *gone = &all[*late];
        for (uint32_t i = gone->other; i != UINT32_MAX; i = all[i].other) {
            if (!touch(r, &all[i], gone)) continue;
            join_touching(r, &all[i], gone);
            gone->joined = true;
            *late = gone->other;
            return true;
        }
    }
    return false;
}

static void join_split(const sli_visible_finder *r, sli_visible *visible) {
    for (size_t i = 0; i < r->split.count; i++)
        while (join_two(r, visible, r->split.items[i])) {
        }
}

// --- events

static uint32_t slot_of(sli_visible_finder *r, sli_bound bound) {
    uint32_t *at = &r->slot_of.items[2 * bound.end + bound.away];
    if (*at < r->slots.count && r->slots.items[*at].end == bound.end &&
        r->slots.items[*at].away == bound.away)
        return *at;
    *at = (uint32_t)r->slots.count;
    r->slots.items[r->slots.count++] = (sli_event_slot){.end = bound.end, .away = bound.away};
    return *at;
}

static sl_status make_slots(sl_context *context, sli_visible_finder *r, sli_visible *visible) {
    r->slots.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &r->slots, 2 * visible->cells.count));
    for (size_t i = 0; i < visible->cells.count; i++) {
        sli_visible_interval *c = &visible->cells.items[i];
        if (c->joined) continue;
        c->enter = slot_of(r, c->low);
        c->leave = slot_of(r, c->high);
    }
    return SL_OK;
}

/// A number that grows with the angle from `first`, over half a turn, but for rounding.
static uint32_t rough_angle(const sli_visible_finder *r, sl_point first,
                            const sli_event_slot *slot) {
    sl_point to = sli_towards(r, slot->end);
    if (slot->away) to = (sl_point){-to.x, -to.y};
    const double sine = fabs(sli_cross(first, to)), cosine = first.x * to.x + first.y * to.y;
    const double sum = sine + fabs(cosine);
    const double angle = cosine >= 0 ? sine / sum : 2 - sine / sum;
    return angle >= 0 ? (uint32_t)(angle * 0x7fffffff) : 0; // or it is no number
}

static bool same_direction(const sli_visible_finder *r, const sli_event_slot *a,
                           const sli_event_slot *b) {
    if (a->end == b->end) return a->away == b->away;
    return sli_ends_turn(r, a->end, b->end) == 0 &&
           sli_opposite(r->from, sli_end_of(r, a->end), sli_end_of(r, b->end)) ==
               (a->away != b->away);
}

/// Compares two slots exactly: -1 if `a` comes first, 0 for the same direction, else 1.
static int compare(const sli_visible_finder *r, uint64_t a, uint64_t b) {
    const sli_event_slot *p = &r->slots.items[(uint32_t)a], *q = &r->slots.items[(uint32_t)b];
    const int sign = sli_ends_turn(r, p->end, q->end);
    if (sign != 0) return p->away != q->away ? sign : -sign;
    if (same_direction(r, p, q)) return 0;
    return a < b ? -1 : 1; // half a turn apart
}

/// Insertion sort by exact comparison, for keys that are nearly sorted. `same`: a key has the
/// direction of the key before it.
static void insert_sorted(const sli_visible_finder *r, uint64_t *keys, bool *same, size_t count) {
    for (size_t i = 1; i < count; i++) {
        int order = compare(r, keys[i - 1], keys[i]);
        same[i] = order == 0;
        const uint64_t key = keys[i];
        size_t at = i;
        while (order > 0) {
            keys[at] = keys[at - 1];
            at--;
            order = at ? compare(r, keys[at - 1], key) : -1;
        }
        if (at == i) continue;
        keys[at] = key;
        // It stands between two that have other neighbours now; behind them all are the same still.
        same[at] = at && order == 0;
        for (size_t k = at + 1; k <= i; k++) same[k] = compare(r, keys[k - 1], keys[k]) == 0;
    }
}

enum { RUN = 12 };

/// Merge sort, bottom-up, of short runs sorted by insertion. `other` has as much room. Returns the
/// one of the two that holds the result.
static uint64_t *sort_keys(uint64_t *keys, uint64_t *other, size_t count) {
    for (size_t first = 0; first < count; first += RUN) {
        const size_t end = first + RUN < count ? first + RUN : count;
        for (size_t i = first + 1; i < end; i++) {
            const uint64_t key = keys[i];
            size_t at = i;
            for (; at > first && keys[at - 1] > key; at--) keys[at] = keys[at - 1];
            keys[at] = key;
        }
    }
    for (size_t run = RUN; run < count; run *= 2) {
        for (size_t first = 0; first < count; first += 2 * run) {
            const size_t middle = first + run < count ? first + run : count;
            const size_t end = middle + run < count ? middle + run : count;
            size_t a = first, b = middle;
            for (size_t i = first; i < end; i++) {
                const bool of_a = b >= end || (a < middle && keys[a] <= keys[b]);
                other[i] = of_a ? keys[a] : keys[b];
                a += of_a;
                b += !of_a;
            }
        }
        uint64_t *swap = keys;
        keys = other;
        other = swap;
    }
    return keys;
}

/// Gives the next slot its event: the last one if it has the same direction, or a new one.
static void add_event(sli_event_slot *slot, bool same, sli_visible *visible) {
    if (!same)
        visible->events.items[visible->events.count++] = (sli_visible_event){.end = slot->end,
                                                                             .away = slot->away,
                                                                             .ray = UINT32_MAX,
                                                                             .enter = UINT32_MAX,
                                                                             .leave = UINT32_MAX};
    slot->event = (uint32_t)visible->events.count - 1;
}

static sl_status sort_slots(sl_context *context, sli_visible_finder *r, sli_bound first,
                            sli_visible *visible) {
    const size_t count = r->slots.count;
    sl_point along = sli_towards(r, first.end);
    if (first.away) along = (sl_point){-along.x, -along.y};
    SL_TRY(SL_ARRAY_ROOM(context, &r->keys, 2 * count));
    SL_TRY(SL_ARRAY_ROOM(context, &r->same, count));
    SL_TRY(SL_ARRAY_ROOM(context, &visible->events, count));
    bool *same = r->same.items;
    uint64_t *keys = r->keys.items;
    for (uint32_t i = 0; i < count; i++)
        keys[i] = (uint64_t)rough_angle(r, along, &r->slots.items[i]) << 32 | i;
    keys = sort_keys(keys, keys + count, count);
    insert_sorted(r, keys, same, count);
    if (count) same[0] = false;
    for (size_t i = 0; i < count; i++)
        add_event(&r->slots.items[(uint32_t)keys[i]], same[i], visible);
    return SL_OK;
}

sl_status sli_visible_sort(sl_context *context, sli_visible_finder *r, sli_bound first,
                           sli_visible *visible) {
    join_split(r, visible);
    SL_TRY(make_slots(context, r, visible));
    SL_TRY(sort_slots(context, r, first, visible));
    for (uint32_t i = 0; i < visible->cells.count; i++) {
        sli_visible_interval *c = &visible->cells.items[i];
        if (c->joined) continue;
        c->enter = r->slots.items[c->enter].event;
        c->leave = r->slots.items[c->leave].event;
        c->next_enter = visible->events.items[c->enter].enter;
        c->next_leave = visible->events.items[c->leave].leave;
        visible->events.items[c->enter].enter = visible->events.items[c->leave].leave = i;
    }
    return SL_OK;
}

int sli_events_compare(const sli_visible_finder *r, uint32_t first, const sli_visible_event *a,
                       const sli_visible_event *b) {
    const bool turned = !b->away;
    const int sign = sli_ends_turn(r, a->end, b->end);
    if (sign != 0) return (a->away != turned) ? sign : -sign;
    const sli_event_slot of_a = {.end = a->end, .away = a->away};
    const sli_event_slot of_b = {.end = b->end, .away = turned};
    if (same_direction(r, &of_a, &of_b)) return 0;
    // Half a turn apart: the one in the first direction comes first.
    return same_direction(r, &(sli_event_slot){.end = first}, &of_a) ? -1 : 1;
}

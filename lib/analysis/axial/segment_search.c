/// Dijkstra 1959, from both ends of the root's chain at once.
#include "analysis/axial/segment_search.h"

#include <math.h>
#include <string.h>

_Static_assert((int)SLI_BUCKETS > SLI_MOST_OF_CHAIN + (int)SLI_UNITS_OF_HALF_TURN, "a step's turn");

void sli_segment_search_destroy(sl_context *context, sli_segment_search *s) {
    sl_free(context, s->states);
    sl_free(context, s->met);
    sl_free(context, s->wanted);
    sl_free(context, s->order);
    sl_free(context, s->touched);
    sl_free(context, s->far);
    sl_free(context, s->corners);
    sl_free(context, s->chosen);
    sl_free(context, s->waiting.items);
    sl_free(context, s->queue.items);
    *s = (sli_segment_search){0};
}

sl_status sli_segment_search_make(sl_context *context, const sli_segment_network *n,
                                  const sl_segment_options *options, sli_segment_search *s) {
    const size_t chains = (size_t)n->chain_count + 1, corners = (size_t)n->corner_count + 1;
    *s = (sli_segment_search){.states = sl_alloc_array(context, 2 * chains, sizeof *s->states)};
    s->met = sl_alloc_array(context, chains, sizeof *s->met);
    s->wanted = sl_alloc_array(context, chains, sizeof *s->wanted);
    s->order = sl_alloc_array(context, 2 * chains, sizeof *s->order);
    s->touched = sl_alloc_array(context, 2 * chains, sizeof *s->touched);
    s->far = sl_alloc_array(context, corners, sizeof *s->far);
    s->corners = sl_alloc_array(context, corners, sizeof *s->corners);
    s->chosen = sl_alloc_array(context, chains, sizeof *s->chosen);
    if (!s->states || !s->met || !s->wanted || !s->order || !s->touched || !s->far || !s->corners ||
        !s->chosen)
        return SL_NO_MEMORY;
    for (size_t i = 0; i < 2 * chains; i++) s->states[i].key = SLI_FAR;
    for (size_t i = 0; i < chains; i++) s->wanted[i] = !(options->metric_radius > 0);
    for (size_t i = 0; i < corners; i++) s->far[i] = INFINITY;
    return SL_OK;
}

/// Lengths are not negative, so their bits order them: the queue of keys serves here too.
static uint64_t bits_of(double length) {
    union {
        double value;
        uint64_t bits;
    } u = {.value = length};
    return u.bits;
}

static void reach_corner(sli_segment_search *s, uint32_t corner, double far) {
    if (isinf(s->far[corner])) s->corners[s->corner_count++] = corner;
    s->far[corner] = far;
}

/// Wanted are the segments within the metric radius. Returns their number, without the root.
static sl_status want(sl_context *context, const sli_segment_network *n, double radius,
                      sli_segment_search *s, uint32_t root, uint32_t *count) {
    *count = n->chain_count - 1;
    if (!(radius > 0)) return SL_OK;
    for (uint32_t i = 0; i < s->chosen_count; i++) s->wanted[s->chosen[i]] = false;
    for (uint32_t i = 0; i < s->corner_count; i++) s->far[s->corners[i]] = INFINITY;
    s->chosen_count = s->corner_count = 0;
    s->queue.count = 0;
    for (int e = 0; e < 2; e++) {
        reach_corner(s, n->corners[root][e], n->lengths[root] / 2);
        SL_TRY(sli_segment_queue_push(
            context, &s->queue,
            (sli_segment_entry){bits_of(n->lengths[root] / 2), n->corners[root][e]}));
    }
    while (s->queue.count) {
        const sli_segment_entry e = sli_segment_queue_pop(&s->queue);
        const double here = s->far[e.state];
        if (e.key > bits_of(here)) continue;
        if (here > radius) break;
        for (uint32_t i = n->first_at[e.state]; i < n->first_at[e.state + 1]; i++) {
            const uint32_t segment = n->at[i] / 2, to = n->corners[segment][1 - n->at[i] % 2];
            if (segment == root) continue;
            if (!s->wanted[segment] && here + n->lengths[segment] / 2 <= radius) {
                s->wanted[segment] = true;
                s->chosen[s->chosen_count++] = segment;
            }
            if (here + n->lengths[segment] >= s->far[to]) continue;
            reach_corner(s, to, here + n->lengths[segment]);
            SL_TRY(sli_segment_queue_push(context, &s->queue,
                                          (sli_segment_entry){bits_of(s->far[to]), to}));
        }
    }
    *count = s->chosen_count;
    return SL_OK;
}

static sl_status put_waiting(sl_context *context, sli_segment_search *s, sli_segment_entry e) {
    const uint64_t turn = e.key >> SLI_STEP_BITS;
    const uint32_t bucket = turn % SLI_BUCKETS;
    if (turn == s->turn) return sli_segment_queue_push(context, &s->queue, e);
    SL_TRY(SL_ARRAY_ROOM(context, &s->waiting, 1));
    s->waiting.items[s->waiting.count++] = (sli_segment_waiting){e, s->buckets[bucket]};
    s->buckets[bucket] = (uint32_t)s->waiting.count;
    s->filled[bucket / 64] |= (uint64_t)1 << bucket % 64;
    return SL_OK;
}

/// The first bucket from this one on, round the ring, that is not empty; SLI_BUCKETS for none.
static uint32_t next_bucket(const sli_segment_search *s, uint32_t from) {
    uint64_t word = s->filled[from / 64] & UINT64_MAX << from % 64;
    for (uint32_t i = 0; i <= SLI_BUCKET_WORDS; i++) {
        const uint32_t at = (from / 64 + i) % SLI_BUCKET_WORDS;
        if (i) word = s->filled[at];
        if (word) return at * 64 + (uint32_t)__builtin_ctzll(word);
    }
    return SLI_BUCKETS;
}

/// Takes the next turn at hand, and its states into the queue; false at the end.
static sl_status take_turn(sl_context *context, sli_segment_search *s, bool *found) {
    const uint32_t bucket = next_bucket(s, s->turn % SLI_BUCKETS);
    *found = bucket < SLI_BUCKETS;
    if (!*found) return SL_OK;
    s->turn += (bucket + SLI_BUCKETS - s->turn % SLI_BUCKETS) % SLI_BUCKETS;
    for (uint32_t i = s->buckets[bucket]; i;) {
        const sli_segment_waiting *w = &s->waiting.items[i - 1];
        if (w->entry.key == s->states[w->entry.state].key)
            SL_TRY(sli_segment_queue_push(context, &s->queue, w->entry));
        i = w->next;
    }
    s->buckets[bucket] = 0;
    s->filled[bucket / 64] &= ~((uint64_t)1 << bucket % 64);
    return SL_OK;
}

/// Sets back what the search before has touched.
static void forget(sli_segment_search *s) {
    for (uint32_t i = 0; i < s->touched_count; i++) {
        s->states[s->touched[i]].key = SLI_FAR;
        s->met[s->touched[i] / 2] = false;
    }
    memset(s->buckets, 0, sizeof s->buckets);
    memset(s->filled, 0, sizeof s->filled);
    s->touched_count = s->count = 0;
    s->queue.count = s->waiting.count = 0;
    s->turn = 0;
}

/// From the end of a chain, which has this key. `before`: the state that the walk is in.
static inline sl_status walk_on(sl_context *context, const sli_segment_network *n,
                                sli_segment_search *s, uint32_t state, uint64_t end,
                                uint32_t before) {
    const double paths = s->states[before].paths;
    for (size_t i = n->first[state]; i < n->first[state + 1]; i++) {
        const uint64_t key = sli_key_after(&n->arcs[i], end);
        sli_segment_state *to = &s->states[n->arcs[i].to];
        if (key > to->key) continue;
        if (key == to->key) {
            to->paths += paths;
            to->before = SLI_SEVERAL;
            continue;
        }
        if (to->key == SLI_FAR) s->touched[s->touched_count++] = n->arcs[i].to;
        *to = (sli_segment_state){.key = key, .paths = paths, .before = before};
        SL_TRY(put_waiting(context, s, (sli_segment_entry){key, n->arcs[i].to}));
    }
    return SL_OK;
}

/// The key of the end of the root's chain, in this state.
static uint64_t root_end(const sli_segment_network *n, uint32_t root, uint32_t state) {
    const uint64_t offset = n->offsets[n->place_of[root]];
    return state % 2 ? offset : sli_offset_of_last(n, state / 2) - offset;
}

/// Finds the least turns, until all that is wanted is found.
static sl_status search(sl_context *context, const sli_segment_network *n, double radius,
                        sli_segment_search *s, uint32_t root, uint32_t left) {
    const uint32_t home = n->chain_of[root];
    uint64_t farthest = 0; // at home, and in the chains that are met
    bool found = true;
    s->most = SLI_FAR;
    if (radius > 0 && radius < 1e6)
        s->most = ((uint64_t)floor(radius * SLI_UNITS_OF_RIGHT_ANGLE) + 1) << SLI_STEP_BITS;
    for (uint32_t e = 0; e < 2; e++) {
        const uint64_t end = root_end(n, root, 2 * home + e);
        const uint32_t start = 2 * n->chain_count + e;
        if (end > farthest) farthest = end;
        s->states[start] = (sli_segment_state){.key = end, .paths = 1};
        SL_TRY(walk_on(context, n, s, 2 * home + e, end, start));
    }
    if (!left && farthest < s->most) s->most = farthest + 1;
    while (found) {
        if (!s->queue.count) {
            SL_TRY(take_turn(context, s, &found));
            continue;
        }
        const sli_segment_entry e = sli_segment_queue_pop(&s->queue);
        const uint32_t chain = e.state / 2;
        if (e.key != s->states[e.state].key) continue;
        if (e.key >= s->most) break;
        const uint64_t end = e.key + sli_offset_of_last(n, chain);
        s->order[s->count++] = e.state;
        if (chain == home) continue;
        if (s->wanted[chain] && !s->met[chain]) {
            if (end > farthest) farthest = end;
            if (--left == 0 && farthest < s->most) s->most = farthest + 1;
        }
        s->met[chain] = true;
        SL_TRY(walk_on(context, n, s, e.state, end, e.state));
    }
    return SL_OK;
}

sl_status sli_segment_search_run(sl_context *context, const sli_segment_network *n,
                                 const sl_segment_options *options, uint32_t root,
                                 sli_segment_search *s) {
    uint32_t wanted;
    SL_TRY(want(context, n, options->metric_radius, s, root, &wanted));
    forget(s);
    return search(context, n, options->angular_radius, s, root, wanted);
}

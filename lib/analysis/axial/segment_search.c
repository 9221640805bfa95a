/// Dijkstra 1959, from both ends of a chain at once.
#include "analysis/axial/segment_search.h"

#include <math.h>
#include <string.h>

_Static_assert((int)SLI_BUCKETS > SLI_MOST_OF_CHAIN + (int)SLI_UNITS_OF_HALF_TURN, "a step's turn");

void sli_segment_search_destroy(sl_context *context, sli_segment_search *s) {
    sl_free(context, s->keys);
    sl_free(context, s->paths);
    sl_free(context, s->before);
    sl_free(context, s->met);
    sl_free(context, s->wanted);
    sl_free(context, s->order);
    sl_free(context, s->chains);
    sl_free(context, s->far);
    sl_free(context, s->corners);
    sl_free(context, s->chosen);
    sl_free(context, s->last);
    sl_free(context, s->waiting.items);
    sl_free(context, s->queue.items);
    *s = (sli_segment_search){0};
}

sl_status sli_segment_search_make(sl_context *context, const sli_segment_network *n,
                                  const sl_segment_options *options, sli_segment_search *s) {
    const size_t chains = (size_t)n->chain_count + 1, corners = (size_t)n->corner_count + 1;
    *s = (sli_segment_search){.keys = sl_alloc_array(context, 4 * chains, sizeof *s->keys)};
    s->paths = sl_alloc_array(context, 4 * chains, sizeof *s->paths);
    s->before = sl_alloc_array(context, 4 * chains, sizeof *s->before);
    s->met = sl_alloc_array(context, chains, sizeof *s->met);
    s->wanted = sl_alloc_array(context, chains, sizeof *s->wanted);
    s->order = sl_alloc_array(context, 4 * chains, sizeof *s->order);
    s->chains = sl_alloc_array(context, chains, sizeof *s->chains);
    s->far = sl_alloc_array(context, corners, sizeof *s->far);
    s->corners = sl_alloc_array(context, corners, sizeof *s->corners);
    s->chosen = sl_alloc_array(context, chains, sizeof *s->chosen);
    s->last = sl_alloc_array(context, 4 * chains, sizeof *s->last);
    if (!s->keys || !s->paths || !s->before || !s->met || !s->wanted || !s->order || !s->chains ||
        !s->far || !s->corners || !s->chosen || !s->last)
        return SL_NO_MEMORY;
    for (size_t i = 0; i < 4 * chains; i++) s->keys[i] = SLI_FAR;
    for (size_t i = 0; i < chains; i++) s->wanted[i] = !(options->metric_radius > 0);
    for (size_t i = 0; i < corners; i++) s->far[i] = INFINITY;
    s->paths[sli_tree_start(n, 0)] = s->paths[sli_tree_start(n, 1)] = 1;
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
        const double here = s->far[e.at];
        if (e.key > bits_of(here)) continue;
        if (here > radius) break;
        for (uint32_t i = n->first_at[e.at]; i < n->first_at[e.at + 1]; i++) {
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

/// A way's key was `before`.
static inline sl_status put(sl_context *context, const sli_segment_network *n,
                            sli_segment_search *s, uint32_t way, uint64_t before) {
    const uint64_t key = s->keys[way], turn = key >> SLI_STEP_BITS;
    if (turn == s->turn && n->straight[sli_state_of(way)])
        return sli_segment_queue_push(context, &s->queue, (sli_segment_entry){key, way});
    if (before >> SLI_STEP_BITS == turn) return SL_OK; // it waits there
    if (turn == s->turn) {
        s->last[s->last_count++] = way;
        return SL_OK;
    }
    const uint32_t bucket = turn % SLI_BUCKETS;
    SL_TRY(SL_ARRAY_ROOM(context, &s->waiting, 1));
    s->waiting.items[s->waiting.count++] = (sli_segment_waiting){way, s->buckets[bucket]};
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

/// Takes the next turn at hand, and its ways; false at the end.
static sl_status take_turn(sl_context *context, const sli_segment_network *n, sli_segment_search *s,
                           bool *found) {
    const uint32_t bucket = next_bucket(s, s->turn % SLI_BUCKETS);
    *found = bucket < SLI_BUCKETS;
    if (!*found) return SL_OK;
    s->turn += (bucket + SLI_BUCKETS - s->turn % SLI_BUCKETS) % SLI_BUCKETS;
    for (uint32_t i = s->buckets[bucket]; i; i = s->waiting.items[i - 1].next) {
        const uint32_t way = s->waiting.items[i - 1].way;
        const uint64_t key = s->keys[way];
        if (key >> SLI_STEP_BITS != s->turn) continue; // it was nearer
        if (n->straight[sli_state_of(way)])
            SL_TRY(sli_segment_queue_push(context, &s->queue, (sli_segment_entry){key, way}));
        else
            s->last[s->last_count++] = way;
    }
    s->buckets[bucket] = 0;
    s->filled[bucket / 64] &= ~((uint64_t)1 << bucket % 64);
    return SL_OK;
}

/// Sets back what the search before has touched.
static void forget(sli_segment_search *s) {
    for (uint32_t i = 0; i < s->chain_count; i++) {
        for (uint32_t k = 0; k < 4; k++) s->keys[4 * s->chains[i] + k] = SLI_FAR;
        s->met[s->chains[i]] = false;
    }
    memset(s->buckets, 0, sizeof s->buckets);
    memset(s->filled, 0, sizeof s->filled);
    s->chain_count = s->count = s->last_count = 0;
    s->queue.count = s->waiting.count = 0;
    s->turn = 0;
}

typedef struct place_home {
    uint32_t chain;
    uint64_t last; ///< offset of its last piece
} place_home;

/// Whether no piece at home gains by a way with this key: see find_slack(). A piece at home is up
/// to `home.last` nearer to the end that one tree starts from than to that of the other.
static inline bool is_useless(const sli_segment_network *n, const sli_segment_search *s,
                              place_home home, uint32_t way, uint64_t key) {
    const uint64_t slack = n->slack[way / 4];
    return key > s->keys[way ^ 1] + slack || key > s->keys[way ^ 2] + home.last ||
           key > s->keys[way ^ 3] + slack + home.last;
}

/// From the end of a chain, which has this key. `before`: the way or start that the walk is in.
static inline sl_status walk_on(sl_context *context, const sli_segment_network *n,
                                sli_segment_search *s, place_home home, uint32_t state,
                                uint32_t tree, uint64_t end, uint32_t before) {
    const double paths = s->paths[before];
    for (size_t i = n->first[state]; i < n->first[state + 1]; i++) {
        const uint64_t key = sli_key_after(&n->arcs[i], end);
        const uint32_t to = sli_way(n->arcs[i].to, tree);
        const uint64_t was = s->keys[to];
        if (key > was) continue;
        if (key == was) {
            s->paths[to] += paths;
            s->before[to] = SLI_SEVERAL;
            continue;
        }
        if (is_useless(n, s, home, to, key)) continue;
        if (was == SLI_FAR && s->keys[to ^ 1] == SLI_FAR && s->keys[to ^ 2] == SLI_FAR &&
            s->keys[to ^ 3] == SLI_FAR)
            s->chains[s->chain_count++] = to / 4;
        s->keys[to] = key;
        s->paths[to] = paths;
        s->before[to] = before;
        SL_TRY(put(context, n, s, to, was));
    }
    return SL_OK;
}

typedef struct chains_left {
    uint32_t count;    ///< that are wanted and not met
    uint64_t farthest; ///< key at home, and in the chains that are met
} chains_left;

/// Takes a way whose key is known.
static inline sl_status finish(sl_context *context, const sli_segment_network *n,
                               sli_segment_search *s, place_home home, uint32_t way,
                               chains_left *left) {
    const uint32_t chain = way / 4;
    const uint64_t key = s->keys[way], end = key + sli_offset_of_last(n, chain);
    if (key >= s->most || is_useless(n, s, home, way, key)) return SL_OK;
    s->order[s->count++] = way;
    if (chain == home.chain) return SL_OK;
    if (s->wanted[chain] && !s->met[chain]) {
        if (end > left->farthest) left->farthest = end;
        if (--left->count == 0 && left->farthest + home.last < s->most)
            s->most = left->farthest + home.last + 1;
    }
    s->met[chain] = true;
    return walk_on(context, n, s, home, sli_state_of(way), sli_tree_of(way), end, way);
}

sl_status sli_segment_search_run(sl_context *context, const sli_segment_network *n,
                                 const sl_segment_options *options, uint32_t home,
                                 sli_segment_search *s) {
    const place_home from = {home, sli_offset_of_last(n, home)};
    const double radius = options->angular_radius;
    chains_left left = {.farthest = from.last};
    SL_TRY(want(context, n, options->metric_radius, s, home, &left.count));
    forget(s);
    s->most = SLI_FAR;
    if (radius > 0 && radius < 1e6)
        s->most = ((uint64_t)floor(radius * SLI_UNITS_OF_RIGHT_ANGLE) + 1) << SLI_STEP_BITS;
    if (!left.count && left.farthest + from.last < s->most) s->most = left.farthest + from.last + 1;
    for (uint32_t tree = 0; tree < 2; tree++)
        SL_TRY(walk_on(context, n, s, from, 2 * home + tree, tree, 0, sli_tree_start(n, tree)));
    for (bool found = true; found && s->turn << SLI_STEP_BITS < s->most;) {
        while (s->queue.count) {
            const sli_segment_entry e = sli_segment_queue_pop(&s->queue);
            if (e.key == s->keys[e.at]) SL_TRY(finish(context, n, s, from, e.at, &left));
        }
        for (uint32_t i = 0; i < s->last_count; i++)
            SL_TRY(finish(context, n, s, from, s->last[i], &left));
        s->last_count = 0;
        SL_TRY(take_turn(context, n, s, &found));
    }
    return SL_OK;
}

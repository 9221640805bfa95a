/// Dijkstra 1959, from both ends of a chain at once.
#include "analysis/axial/segment_search.h"

#include <math.h>
#include <string.h>

_Static_assert((int)SLI_BUCKETS > SLI_MOST_OF_CHAIN + (int)SLI_UNITS_OF_HALF_TURN, "a step's turn");

void sli_segment_search_destroy(sl_context *context, sli_segment_search *s) {
    sl_free(context, s->chains);
    sl_free(context, s->paths);
    sl_free(context, s->met);
    sl_free(context, s->wanted);
    sl_free(context, s->order);
    sl_free(context, s->reached);
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
    *s = (sli_segment_search){.chains = sl_alloc_array(context, chains, sizeof *s->chains)};
    s->paths = sl_alloc_array(context, 4 * chains, sizeof *s->paths);
    s->met = sl_alloc_array(context, chains, sizeof *s->met);
    s->wanted = sl_alloc_array(context, chains, sizeof *s->wanted);
    s->order = sl_alloc_array(context, 4 * chains, sizeof *s->order);
    s->reached = sl_alloc_array(context, chains, sizeof *s->reached);
    s->far = sl_alloc_array(context, corners, sizeof *s->far);
    s->corners = sl_alloc_array(context, corners, sizeof *s->corners);
    s->chosen = sl_alloc_array(context, chains, sizeof *s->chosen);
    s->last = sl_alloc_array(context, 4 * chains, sizeof *s->last);
    if (!s->chains || !s->paths || !s->met || !s->wanted || !s->order || !s->reached || !s->far ||
        !s->corners || !s->chosen || !s->last)
        return SL_NO_MEMORY;
    for (uint32_t i = 0; i < n->chain_count; i++)
        s->chains[i] =
            (sli_segment_chain){.keys = {SLI_FAR, SLI_FAR, SLI_FAR, SLI_FAR},
                                .last_turn = (uint16_t)(sli_offset_of_last(n, i) >> SLI_STEP_BITS),
                                .last_steps = (uint16_t)sli_offset_of_last(n, i),
                                .first = {n->first[2 * i], n->first[2 * i + 1]}};
    for (size_t i = 0; i < 4 * chains; i++) s->paths[i] = 1;
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
    const uint64_t key = sli_way_key(s, way), turn = key >> SLI_STEP_BITS;
    if (turn == s->turn && n->straight[sli_state_of(way)])
        return sli_segment_queue_push(context, &s->queue, (sli_segment_entry){key, way});
    if (before >> SLI_STEP_BITS == turn) return SL_OK; // it waits there
    if (turn == s->turn) {
        s->last[s->last_count++] = way;
        return SL_OK;
    }
    const uint32_t bucket = turn % SLI_BUCKETS;
    uint32_t place = s->unused;
    if (place) {
        s->unused = s->waiting.items[place - 1].next;
    } else {
        SL_TRY(SL_ARRAY_ROOM(context, &s->waiting, 1));
        place = (uint32_t)++s->waiting.count;
    }
    s->waiting.items[place - 1] = (sli_segment_waiting){way, s->buckets[bucket]};
    s->buckets[bucket] = place;
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
    for (uint32_t i = s->buckets[bucket], next; i; i = next) {
        sli_segment_waiting *w = &s->waiting.items[i - 1];
        const uint32_t way = w->way;
        const uint64_t key = sli_way_key(s, way);
        next = w->next;
        w->next = s->unused;
        s->unused = i;
        if (key >> SLI_STEP_BITS != s->turn) continue; // it was nearer
        if (n->straight[sli_state_of(way)])
            SL_TRY(sli_segment_queue_push(context, &s->queue, (sli_segment_entry){key, way}));
        else
            s->last[s->last_count++] = way;
        __builtin_prefetch(&n->arcs[s->chains[way / 4].first[way % 2]]);
    }
    s->buckets[bucket] = 0;
    s->filled[bucket / 64] &= ~((uint64_t)1 << bucket % 64);
    return SL_OK;
}

/// Sets back what the search before has touched.
static void forget(sli_segment_search *s) {
    for (uint32_t i = 0; i < s->reached_count; i++) {
        const uint32_t chain = s->reached[i];
        for (uint32_t k = 0; k < 4; k++) s->chains[chain].keys[k] = SLI_FAR;
        for (uint32_t k = 0; k < 4 && s->several; k++) s->paths[4 * (size_t)chain + k] = 1;
        s->met[chain] = false;
    }
    memset(s->buckets, 0, sizeof s->buckets);
    memset(s->filled, 0, sizeof s->filled);
    s->reached_count = s->count = s->last_count = s->unused = 0;
    s->queue.count = s->waiting.count = 0;
    s->turn = 0;
    s->several = false;
}

typedef struct place_home {
    uint32_t chain;
    uint64_t last; ///< offset of its last piece
} place_home;

/// A walk may come into a chain by one end so much later than another walk by the other end that no
/// shortest path begins with it:
///
///   x  front        back       A walk from x comes into the front with the key k, a later one into
///    \  |             |        the back with the key k'. To pieces of the chain it is of no use if
///     --o--o--o--o--o--o--     k' is over k + the offset of the last piece. Then it goes back to
///    /                         the front, and on into z. From x, a walk turns into z, too. It may
///   z                          turn by more there, but only by so much (late_of()).
///
/// If z is x, backwards, the same must hold one chain earlier. Down to the front of x, the later
/// walk takes the way of the other one backwards, so it is later still, by twice that way. At the
/// end of this row is home, where it is of no use. `late` of a way is the most of what is allowed
/// at its front and at those before it, counted from k to the later walk's key at the front. So
/// that only walks are left out that are later for all ways on, steps are not counted.
///
/// Returns the largest k' - k that may be of use.
static inline uint64_t slack_of(uint64_t last, uint8_t late) {
    const uint64_t key = (uint64_t)late * SLI_LATE << SLI_STEP_BITS;
    return 2 * last < key ? key - last : last;
}

/// Whether no piece at home gains by a way with this key. A piece at home is up to `home.last`
/// nearer to the end that one tree starts from than to that of the other.
static inline bool is_useless(const sli_segment_chain *c, uint32_t way, uint64_t key,
                              place_home home) {
    const uint64_t last = sli_last_of(c);
    const uint32_t other = way % 4 ^ 1;
    return key > c->keys[other] + slack_of(last, c->late[other]) ||
           key > c->keys[way % 4 ^ 2] + home.last ||
           key > c->keys[other ^ 2] + slack_of(last, c->late[other ^ 2]) + home.last;
}

/// `late` of a chain that an arc leads to. `left`: what is left of that of the chain before.
static inline uint8_t late_after(const sli_segment_arc *arc, int left) {
    const int behind = (left - 2 * (int)arc->turn + SLI_LATE - 1) / SLI_LATE;
    return behind > arc->late ? (uint8_t)behind : arc->late;
}

/// From the end of a chain, which has this key, along its arcs from the first on. `before`: the way
/// or start that the walk is in; `left`: of its `late`, at its end.
static inline sl_status walk_on(sl_context *context, const sli_segment_network *n,
                                sli_segment_search *s, place_home home, uint32_t first,
                                uint32_t tree, uint64_t end, uint32_t before, int left) {
    if (first == n->arc_count) return SL_OK;
    const sli_segment_arc *arc = &n->arcs[first];
    do {
        const uint64_t key = sli_key_after(arc, end);
        const uint32_t to = sli_way(arc->to, tree);
        sli_segment_chain *c = &s->chains[to / 4];
        const uint64_t was = c->keys[to % 4];
        if (key > was) continue;
        if (key == was) {
            c->before[to % 4] = SLI_SEVERAL;
            s->several = true;
            continue;
        }
        if (is_useless(c, to, key, home)) continue;
        if (was == SLI_FAR && c->keys[to % 4 ^ 1] == SLI_FAR && c->keys[to % 4 ^ 2] == SLI_FAR &&
            c->keys[to % 4 ^ 3] == SLI_FAR) {
            s->reached[s->reached_count++] = to / 4;
            __builtin_prefetch(&n->arcs[c->first[0]]);
            __builtin_prefetch(&n->arcs[c->first[1]]);
        }
        c->keys[to % 4] = key;
        c->before[to % 4] = before;
        c->late[to % 4] = late_after(arc, left);
        SL_TRY(put(context, n, s, to, was));
    } while (!arc++->ends);
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
    const sli_segment_chain *c = &s->chains[chain];
    const uint64_t key = c->keys[way % 4], end = key + sli_last_of(c);
    if (key >= s->most || is_useless(c, way, key, home)) return SL_OK;
    s->order[s->count++] = (sli_segment_done){way, c->before[way % 4]};
    if (chain == home.chain) return SL_OK;
    if (!s->met[chain]) {
        s->met[chain] = true;
        if (s->wanted[chain]) {
            if (end > left->farthest) left->farthest = end;
            if (--left->count == 0 && left->farthest + home.last < s->most)
                s->most = left->farthest + home.last + 1;
        }
    }
    return walk_on(context, n, s, home, c->first[way % 2], sli_tree_of(way), end, way,
                   c->late[way % 4] * SLI_LATE - 2 * c->last_turn);
}

/// Where several paths have one key, all are counted afterwards.
static void count_paths(const sli_segment_network *n, sli_segment_search *s, uint32_t home) {
    for (uint32_t k = 0; k < s->count; k++) {
        const sli_segment_done *d = &s->order[k];
        if (d->before != SLI_SEVERAL) {
            s->paths[d->way] = s->paths[d->before];
            continue;
        }
        sli_segment_origin from = sli_segment_origins(n, s, d->way, home);
        s->paths[d->way] = 0;
        for (uint32_t way; sli_segment_origin_next(&from, &way);) s->paths[d->way] += s->paths[way];
    }
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
        SL_TRY(walk_on(context, n, s, from, n->first[2 * home + tree], tree, 0,
                       sli_tree_start(n, tree), 0));
    for (bool found = true; found && s->turn << SLI_STEP_BITS < s->most;) {
        while (s->queue.count) {
            const sli_segment_entry e = sli_segment_queue_pop(&s->queue);
            if (e.key == sli_way_key(s, e.at)) SL_TRY(finish(context, n, s, from, e.at, &left));
        }
        for (uint32_t i = 0; i < s->last_count; i++)
            SL_TRY(finish(context, n, s, from, s->last[i], &left));
        s->last_count = 0;
        SL_TRY(take_turn(context, n, s, &found));
    }
    if (s->several) count_paths(n, s, home);
    return SL_OK;
}

/// Angular analysis of segments (Turner 2007, From axial to road-centre lines).
///
/// A walk along a segment has a direction, so each segment is two states: towards b, and towards a.
/// At its end a walk goes on into any other segment there, at the cost of the turn:
///
///      ----->o----->   0        Turns are whole numbers: 1024th parts of a full turn. A path's key
///            |                  is its turn, then its number of segments. So keys are exact, ties
///            v         256      are ties, and no step is free.
///
/// A search from each segment (Dijkstra 1959) starts in both directions. A segment is as far as the
/// nearer of its states. Choice is betweenness (Brandes 2001) on the states: the paths to both
/// states of a segment share its 1 where they tie. Sums are whole numbers, as in axial_measures.c.
///
/// Turns are at most a half turn, so states wait in a ring of buckets, one for each turn that may
/// come next (Dial 1969); only the states of the turn at hand are kept in order, by a heap. What a
/// search has touched is set back before the next one, so that a search within a radius costs what
/// it reaches.
///
/// Cost: O(n * pairs of segments that meet) for n segments, times the logarithm of the states of
/// one turn. Threads take segments one by one.
#include "base/heap.h"
#include "geometry/length.h"
#include "geometry/orient.h"
#include "sightline/axial.h"
#include "sightline/support.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#define HALF_TURN 3.14159265358979323846

enum { UNITS_OF_HALF_TURN = 512, UNITS_OF_RIGHT_ANGLE = 256, STEP_BITS = 32 };

/// Choice in whole numbers.
#define SHARE 0x1p24
#define FAR   UINT64_MAX

typedef struct arc {
    uint32_t to; ///< a state
    uint32_t turn;
} arc;

/// State 2 s walks segment s from a to b, state 2 s + 1 back.
typedef struct network {
    const sl_segment *segments;
    uint32_t count, corner_count;
    double *lengths;
    uint32_t (*corners)[2]; ///< by segment: where its a and b are
    uint32_t *first_at;     ///< by corner, and one more: into `at`
    uint32_t *at;           ///< 2 s where segment s has its a, 2 s + 1 where it has its b
    size_t *first;          ///< by state, and one more: into `arcs`
    arc *arcs;
} network;

static void network_destroy(sl_context *context, network *n) {
    sl_free(context, n->lengths);
    sl_free(context, n->corners);
    sl_free(context, n->first_at);
    sl_free(context, n->at);
    sl_free(context, n->first);
    sl_free(context, n->arcs);
}

// --- the network

typedef struct tip {
    sl_point point;
    uint32_t end; ///< 2 s or 2 s + 1
} tip;

static int compare_tips(const void *left, const void *right) {
    const tip *a = left, *b = right;
    const int order = sli_compare_points(a->point, b->point);
    return order ? order : (a->end > b->end) - (a->end < b->end);
}

static sl_status find_corners(sl_context *context, network *n) {
    const size_t ends = 2 * (size_t)n->count;
    tip *tips = sl_alloc_array(context, ends + 1, sizeof *tips);
    n->lengths = sl_alloc_array(context, (size_t)n->count + 1, sizeof *n->lengths);
    n->corners = sl_alloc_array(context, (size_t)n->count + 1, sizeof *n->corners);
    n->first_at = sl_alloc_array(context, ends + 2, sizeof *n->first_at);
    n->at = sl_alloc_array(context, ends + 1, sizeof *n->at);
    if (!tips || !n->lengths || !n->corners || !n->first_at || !n->at) {
        sl_free(context, tips);
        return SL_NO_MEMORY;
    }
    for (uint32_t s = 0; s < n->count; s++) {
        const sl_segment *l = &n->segments[s];
        n->lengths[s] = sli_length(l->b.x - l->a.x, l->b.y - l->a.y);
        tips[2 * s] = (tip){l->a, 2 * s};
        tips[2 * s + 1] = (tip){l->b, 2 * s + 1};
    }
    qsort(tips, ends, sizeof *tips, compare_tips);
    for (size_t i = 0; i < ends; i++) {
        if (i == 0 || !sli_same_point(tips[i].point, tips[i - 1].point))
            n->first_at[n->corner_count++] = (uint32_t)i;
        n->at[i] = tips[i].end;
        n->corners[tips[i].end / 2][tips[i].end % 2] = n->corner_count - 1;
    }
    n->first_at[n->corner_count] = (uint32_t)ends;
    sl_free(context, tips);
    return SL_OK;
}

/// The turn from one walk into the next.
static uint32_t turn_of(const network *n, uint32_t from, uint32_t to) {
    const sl_segment *s = &n->segments[from / 2], *t = &n->segments[to / 2];
    const double sx = s->b.x - s->a.x, sy = s->b.y - s->a.y, sign = from % 2 == to % 2 ? 1 : -1;
    const double tx = sign * (t->b.x - t->a.x), ty = sign * (t->b.y - t->a.y);
    const double angle = fabs(atan2(sx * ty - sy * tx, sx * tx + sy * ty));
    return (uint32_t)lround(angle / HALF_TURN * UNITS_OF_HALF_TURN);
}

static sl_status find_arcs(sl_context *context, network *n) {
    n->first = sl_alloc_array(context, 2 * (size_t)n->count + 2, sizeof *n->first);
    if (!n->first) return SL_NO_MEMORY;
    for (uint32_t state = 0; state < 2 * n->count; state++) {
        const uint32_t corner = n->corners[state / 2][1 - state % 2];
        n->first[state + 1] = n->first[state] + n->first_at[corner + 1] - n->first_at[corner] - 1;
    }
    n->arcs = sl_alloc_array(context, n->first[2 * (size_t)n->count] + 1, sizeof *n->arcs);
    if (!n->arcs) return SL_NO_MEMORY;
    for (uint32_t state = 0; state < 2 * n->count; state++) {
        const uint32_t corner = n->corners[state / 2][1 - state % 2];
        size_t next = n->first[state];
        for (uint32_t i = n->first_at[corner]; i < n->first_at[corner + 1]; i++)
            if (n->at[i] / 2 != state / 2) // from its a it is walked to b: state and end agree
                n->arcs[next++] = (arc){n->at[i], turn_of(n, state, n->at[i])};
    }
    return SL_OK;
}

// --- searches

typedef struct entry {
    uint64_t key;
    uint32_t state;
} entry;

static inline bool is_before(const entry *a, const entry *b) {
    return a->key < b->key || (a->key == b->key && a->state < b->state);
}

SLI_HEAP(queue, entry, is_before)

/// An entry that waits in a bucket.
typedef struct waiting {
    entry entry;
    uint32_t next; ///< of the bucket, from 1; 0 for the last
} waiting;

/// More than there are turns from one state to the next.
enum { BUCKETS = 1024, BUCKET_WORDS = BUCKETS / 64 };

typedef struct scratch {
    uint64_t *keys; ///< by state
    double *paths, *depends;
    uint32_t *order;   ///< of states: ascending keys
    uint32_t *touched; ///< states that have a key
    double *far;       ///< by corner: along the network, from the middle of the root
    uint32_t *corners; ///< those that are not INFINITY far
    bool *done, *wanted;
    uint32_t *chosen; ///< segments that are wanted, with a metric radius
    uint64_t *choice; ///< by segment
    uint32_t count, touched_count, corner_count, chosen_count;
    queue queue; ///< of states of the turn at hand
    SL_ARRAY(waiting) waiting;
    uint32_t buckets[BUCKETS]; ///< into `waiting`, from 1; by turn modulo BUCKETS
    uint64_t filled[BUCKET_WORDS];
    uint64_t turn; ///< at hand
} scratch;

typedef struct job {
    network net;
    const sl_segment_options *options;
    sl_segment_measures *measures;
    _Atomic uint64_t *choice;
} job;

/// Lengths are not negative, so their bits order them: the queue of keys serves here too.
static uint64_t bits_of(double length) {
    union {
        double value;
        uint64_t bits;
    } u = {.value = length};
    return u.bits;
}

static void reach_corner(scratch *s, uint32_t corner, double far) {
    if (isinf(s->far[corner])) s->corners[s->corner_count++] = corner;
    s->far[corner] = far;
}

/// Wanted are the segments within the metric radius. Returns their number, without the root.
static sl_status want(sl_context *context, const job *j, scratch *s, uint32_t root,
                      uint32_t *count) {
    const network *n = &j->net;
    const double radius = j->options->metric_radius;
    *count = n->count - 1;
    if (!(radius > 0)) return SL_OK;
    for (uint32_t i = 0; i < s->chosen_count; i++) s->wanted[s->chosen[i]] = false;
    for (uint32_t i = 0; i < s->corner_count; i++) s->far[s->corners[i]] = INFINITY;
    s->chosen_count = s->corner_count = 0;
    s->queue.count = 0;
    for (int e = 0; e < 2; e++) {
        reach_corner(s, n->corners[root][e], n->lengths[root] / 2);
        SL_TRY(queue_push(context, &s->queue,
                          (entry){bits_of(n->lengths[root] / 2), n->corners[root][e]}));
    }
    while (s->queue.count) {
        const entry e = queue_pop(&s->queue);
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
            SL_TRY(queue_push(context, &s->queue, (entry){bits_of(s->far[to]), to}));
        }
    }
    *count = s->chosen_count;
    return SL_OK;
}

static sl_status put_waiting(sl_context *context, scratch *s, entry e) {
    const uint64_t turn = e.key >> STEP_BITS;
    const uint32_t bucket = turn % BUCKETS;
    if (turn == s->turn) return queue_push(context, &s->queue, e);
    SL_TRY(SL_ARRAY_ROOM(context, &s->waiting, 1));
    s->waiting.items[s->waiting.count++] = (waiting){e, s->buckets[bucket]};
    s->buckets[bucket] = (uint32_t)s->waiting.count;
    s->filled[bucket / 64] |= (uint64_t)1 << bucket % 64;
    return SL_OK;
}

/// The first bucket from this one on, round the ring, that is not empty; BUCKETS for none.
static uint32_t next_bucket(const scratch *s, uint32_t from) {
    uint64_t word = s->filled[from / 64] & UINT64_MAX << from % 64;
    for (uint32_t i = 0; i <= BUCKET_WORDS; i++) {
        const uint32_t at = (from / 64 + i) % BUCKET_WORDS;
        if (i) word = s->filled[at];
        if (word) return at * 64 + (uint32_t)__builtin_ctzll(word);
    }
    return BUCKETS;
}

/// Takes the next turn at hand, and its states into the queue; false at the end.
static sl_status take_turn(sl_context *context, scratch *s, bool *found) {
    const uint32_t bucket = next_bucket(s, s->turn % BUCKETS);
    *found = bucket < BUCKETS;
    if (!*found) return SL_OK;
    s->turn += (bucket + BUCKETS - s->turn % BUCKETS) % BUCKETS;
    for (uint32_t i = s->buckets[bucket]; i;) {
        const waiting *w = &s->waiting.items[i - 1];
        if (w->entry.key == s->keys[w->entry.state])
            SL_TRY(queue_push(context, &s->queue, w->entry));
        i = w->next;
    }
    s->buckets[bucket] = 0;
    s->filled[bucket / 64] &= ~((uint64_t)1 << bucket % 64);
    return SL_OK;
}

/// Sets back what the search before has touched.
static void forget(scratch *s) {
    for (uint32_t i = 0; i < s->touched_count; i++) {
        const uint32_t state = s->touched[i];
        s->keys[state] = FAR;
        s->paths[state] = s->depends[state] = 0;
        s->done[state] = false;
    }
    memset(s->buckets, 0, sizeof s->buckets);
    memset(s->filled, 0, sizeof s->filled);
    s->touched_count = s->count = 0;
    s->queue.count = s->waiting.count = 0;
    s->turn = 0;
}

static sl_status reach(sl_context *context, scratch *s, uint32_t state, uint64_t key) {
    if (s->keys[state] == FAR) s->touched[s->touched_count++] = state;
    s->keys[state] = key;
    s->paths[state] = 0;
    return put_waiting(context, s, (entry){key, state});
}

/// Finds the least turns, until all that is wanted is found.
static sl_status search(sl_context *context, const job *j, scratch *s, uint32_t root,
                        uint32_t left) {
    const network *n = &j->net;
    const double radius = j->options->angular_radius;
    uint64_t most = FAR;
    bool found = true;
    if (radius > 0 && radius < 1e6)
        most = ((uint64_t)floor(radius * UNITS_OF_RIGHT_ANGLE) + 1) << STEP_BITS;
    for (uint32_t e = 0; e < 2; e++) {
        SL_TRY(reach(context, s, 2 * root + e, 0));
        s->paths[2 * root + e] = 1;
    }
    while (found) {
        if (!s->queue.count) {
            SL_TRY(take_turn(context, s, &found));
            continue;
        }
        const entry e = queue_pop(&s->queue);
        if (s->done[e.state] || e.key != s->keys[e.state]) continue;
        if (e.key >= most) break;
        s->done[e.state] = true;
        s->order[s->count++] = e.state;
        if (s->wanted[e.state / 2] && !s->done[e.state ^ 1] && --left == 0) most = e.key + 1;
        for (size_t i = n->first[e.state]; i < n->first[e.state + 1]; i++) {
            const arc a = n->arcs[i];
            const uint64_t key = e.key + ((uint64_t)a.turn << STEP_BITS) + 1;
            if (key > s->keys[a.to]) continue;
            if (key < s->keys[a.to]) SL_TRY(reach(context, s, a.to, key));
            s->paths[a.to] += s->paths[e.state];
        }
    }
    return SL_OK;
}

/// The least key of a segment, and the number of paths with it.
static uint64_t nearest(const scratch *s, uint32_t segment, double *paths) {
    const uint64_t there = s->done[2 * segment] ? s->keys[2 * segment] : FAR;
    const uint64_t back = s->done[2 * segment + 1] ? s->keys[2 * segment + 1] : FAR;
    *paths = (there <= back ? s->paths[2 * segment] : 0) +
             (back <= there ? s->paths[2 * segment + 1] : 0);
    return there < back ? there : back;
}

static void add_choice(const job *j, scratch *s, uint32_t root) {
    const network *n = &j->net;
    for (uint32_t k = s->count; k-- > 0;) {
        const uint32_t state = s->order[k];
        for (size_t i = n->first[state]; i < n->first[state + 1]; i++) {
            const arc a = n->arcs[i];
            double paths;
            if (!s->done[a.to] ||
                s->keys[a.to] != s->keys[state] + ((uint64_t)a.turn << STEP_BITS) + 1)
                continue;
            const uint64_t least = nearest(s, a.to / 2, &paths);
            const bool ends = s->wanted[a.to / 2] && s->keys[a.to] == least;
            s->depends[state] += s->paths[state] * (ends ? 1 / paths : 0) +
                                 s->paths[state] / s->paths[a.to] * s->depends[a.to];
        }
        if (state / 2 != root) s->choice[state / 2] += (uint64_t)llround(s->depends[state] * SHARE);
    }
}

static sl_status measure_segment(sl_context *context, void *all, void *state, size_t unit) {
    const job *j = all;
    const network *n = &j->net;
    scratch *s = state;
    const uint32_t root = (uint32_t)unit;
    sl_segment_measures *out = &j->measures[root];
    uint32_t wanted;
    uint64_t units = 0, nodes = 1;
    const bool all_wanted = !(j->options->metric_radius > 0);
    SL_TRY(sl_check_cancelled(context));
    SL_TRY(want(context, j, s, root, &wanted));
    forget(s);
    s->wanted[root] = false;
    if (wanted) SL_TRY(search(context, j, s, root, wanted));
    for (uint32_t i = 0; i < (all_wanted ? n->count : wanted); i++) {
        double paths;
        const uint32_t segment = all_wanted ? i : s->chosen[i];
        const uint64_t key = s->wanted[segment] ? nearest(s, segment, &paths) : FAR;
        nodes += key != FAR;
        units += key != FAR ? key >> STEP_BITS : 0;
    }
    if (wanted) add_choice(j, s, root);
    s->wanted[root] = all_wanted;
    const double total = (double)units / UNITS_OF_RIGHT_ANGLE, count = (double)nodes;
    *out =
        (sl_segment_measures){.connectivity = (double)(n->first[2 * root + 2] - n->first[2 * root]),
                              .segment_length = n->lengths[root],
                              .t1024_node_count = count,
                              .t1024_total_depth = total,
                              .t1024_integration = total > 0 ? count * count / total : NAN,
                              .nain = total > 0 ? pow(count, 1.2) / total : NAN};
    return SL_OK;
}

// --- all segments

static void end_segment_worker(sl_context *context, void *all, void *state) {
    const job *j = all;
    scratch *s = state;
    for (uint32_t i = 0; i < j->net.count && s->choice; i++)
        if (s->choice[i]) atomic_fetch_add(&j->choice[i], s->choice[i]);
    sl_free(context, s->keys);
    sl_free(context, s->paths);
    sl_free(context, s->depends);
    sl_free(context, s->order);
    sl_free(context, s->touched);
    sl_free(context, s->corners);
    sl_free(context, s->chosen);
    sl_free(context, s->waiting.items);
    sl_free(context, s->far);
    sl_free(context, s->done);
    sl_free(context, s->wanted);
    sl_free(context, s->choice);
    sl_free(context, s->queue.items);
    sl_free(context, s);
}

static sl_status begin_segment_worker(sl_context *context, void *all, void **state) {
    const network *n = &((const job *)all)->net;
    const size_t states = 2 * (size_t)n->count + 1;
    scratch *s = sl_alloc_array(context, 1, sizeof *s);
    if (!s) return SL_NO_MEMORY;
    s->keys = sl_alloc_array(context, states, sizeof *s->keys);
    s->paths = sl_alloc_array(context, states, sizeof *s->paths);
    s->depends = sl_alloc_array(context, states, sizeof *s->depends);
    s->order = sl_alloc_array(context, states, sizeof *s->order);
    s->touched = sl_alloc_array(context, states, sizeof *s->touched);
    s->corners = sl_alloc_array(context, states, sizeof *s->corners);
    s->chosen = sl_alloc_array(context, states, sizeof *s->chosen);
    s->far = sl_alloc_array(context, states, sizeof *s->far);
    s->done = sl_alloc_array(context, states, sizeof *s->done);
    s->wanted = sl_alloc_array(context, states, sizeof *s->wanted);
    s->choice = sl_alloc_array(context, states, sizeof *s->choice);
    if (!s->keys || !s->paths || !s->depends || !s->order || !s->touched || !s->corners ||
        !s->chosen || !s->far || !s->done || !s->wanted || !s->choice) {
        end_segment_worker(context, all, s);
        return SL_NO_MEMORY;
    }
    for (size_t i = 0; i < states; i++) {
        s->keys[i] = FAR;
        s->far[i] = INFINITY;
        s->wanted[i] = !(((const job *)all)->options->metric_radius > 0);
    }
    *state = s;
    return SL_OK;
}

static sl_status measure_all(sl_context *context, job *j) {
    const sl_work work = {.job = j,
                          .begin = begin_segment_worker,
                          .unit = measure_segment,
                          .end = end_segment_worker,
                          .stage = "segment measures",
                          .units = "segments"};
    SL_TRY(sl_work_run(context, &work, j->net.count, j->options->threads));
    for (uint32_t i = 0; i < j->net.count; i++) {
        sl_segment_measures *m = &j->measures[i];
        m->t1024_choice = (double)atomic_load(&j->choice[i]) / (2 * SHARE); // seen from both ends
        m->nach = log10(m->t1024_choice + 1) / log10(m->t1024_total_depth + 3);
    }
    return SL_OK;
}

sl_status sl_segment_measure(sl_context *context, const sl_segment *segments, uint32_t count,
                             const sl_segment_options *options, sl_segment_measures *measures) {
    for (uint32_t i = 0; i < count; i++)
        if (sli_same_point(segments[i].a, segments[i].b))
            return sl_fail(context, SL_BAD_ARGUMENT, "segment %u has no length", i);
    if (count > UINT32_MAX / 8) return sl_fail(context, SL_UNSUPPORTED, "too many segments");
    job j = {
        .net = {.segments = segments, .count = count}, .options = options, .measures = measures};
    void *block = sl_alloc_array(context, (size_t)count + 1, sizeof(_Atomic uint64_t));
    j.choice = block;
    sl_status status = block ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = find_corners(context, &j.net);
    if (status == SL_OK) status = find_arcs(context, &j.net);
    if (status == SL_OK) status = measure_all(context, &j);
    network_destroy(context, &j.net);
    sl_free(context, block);
    return status;
}

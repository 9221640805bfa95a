/// Angular depth: the paths from each point to all others along a visibility graph that turn least
/// (depthmapX, vgaangular.cpp of its salalib; Dijkstra 1959).
///
/// A path turns at points beside walls, and where it has not turned so far. So only those points
/// are expanded. Neighbours that were seen from the point before are passed over:
///
///        p --------- u           The way p, q never turns more than p, u, q: the direction p to q
///          \        /            lies between p to u and u to q. So only neighbours of u that p
///            \    /              does not see can gain by u.
///              q
///
/// From one start to the next most points are reached from the same point before. So each point
/// keeps what a way on turns:
///
///       least:  0.4            0.1        of the 64 points of a word
///               |              |
///       turns:  0.4 0.7 0.5    0.1 0.3    of each point that p does not see
///
/// A word is passed over where its least turn leads to no gain, as no point in it has a worse path
/// so far. A turn is first kept as a lower bound, by a short formula. It becomes exact when the
/// bound cannot tell. Turns are in single precision, and ties go to the lower number, as in
/// depthmapX.
///
/// Invariant: the bounds are below the turns by more than rounding. So a way on that is passed over
/// gains nothing, and the result is that of trying all ways on, to the last bit.
///
/// Cost: for each point, the words of the points that are expanded, and a heap operation for each
/// gain of such a point. Memory: for each thread 16 bytes a word, and up to SLI_VGA_KEPT_TURNS
/// turns. Points for which no room is left begin anew each time.
#include "visibility_graph/paths.h"

#include <string.h>

typedef sli_vga_entry entry; ///< of slots

/// Keys of a bucket share their whole number of parts of a right angle. No turn is over two right
/// angles, so that no two buckets that wait share a place.
enum { PARTS = 256, BUCKETS = 4 * PARTS };

/// How far a bound lies below its turn at least, in right angles. The formula is off by 4.3e-5, and
/// single precision near a cosine of 1 by 5e-4.
#define BELOW 1e-3f

/// The ways on from a point to those of a word.
typedef struct ways_on {
    uint64_t fresh; ///< points that the point before does not see
    uint32_t first; ///< of their turns, among those of the point
    float least;    ///< no turn is less; below 0: not known yet
} ways_on;

typedef struct walker {
    const sli_vga_sights *sights;
    float *turn;             ///< by slot, in right angles: of its path so far; INFINITY: none
    float *most;             ///< by bundle: the largest of these
    sl_bits *done;           ///< points whose paths are final
    ways_on *ways;           ///< by word
    uint32_t *before;        ///< by slot: the point before, for which its ways on are kept, or none
    size_t *kept;            ///< by slot: where its turns begin, or 0: in the room that all share
    float *turns;            ///< with its sign: a bound
    sli_vga_heap heap;       ///< of the bucket that is reached
    SL_ARRAY(entry) entries; ///< of the buckets after it
    size_t waiting;          ///< entries that are not taken yet
    uint64_t reached;
    uint32_t buckets[BUCKETS]; ///< first entries
} walker;

// --- the queue: buckets of keys, and a small heap for the one that is reached

static sl_status push(sl_context *context, walker *w, entry e) {
    const uint64_t bucket = (uint64_t)(e.key * PARTS);
    if (bucket == w->reached) return sli_vga_push(context, &w->heap, e);
    SL_TRY(SL_ARRAY_ROOM(context, &w->entries, 1));
    e.next = w->buckets[bucket % BUCKETS];
    w->buckets[bucket % BUCKETS] = (uint32_t)w->entries.count;
    w->entries.items[w->entries.count++] = e;
    w->waiting++;
    return SL_OK;
}

/// Goes on to the next bucket with entries that no better path has replaced.
static sl_status reach_next(sl_context *context, walker *w) {
    while (w->waiting && !w->heap.count) {
        uint32_t *bucket = &w->buckets[++w->reached % BUCKETS];
        for (uint32_t i = *bucket; i != SLI_VGA_NONE; i = w->entries.items[i].next) {
            const entry *e = &w->entries.items[i];
            w->waiting--;
            if (e->key <= w->turn[e->at]) SL_TRY(sli_vga_push(context, &w->heap, *e));
        }
        *bucket = SLI_VGA_NONE;
    }
    return SL_OK;
}

// --- ways on

/// At most the turn between two steps (Abramowitz and Stegun 1964, 4.4.45).
static inline float bound_turn(float ax, float ay, float bx, float by) {
    const float cosine = (ax * bx + ay * by) / sqrtf((ax * ax + ay * ay) * (bx * bx + by * by));
    const float size = fabsf(cosine), c = size < 1 ? size : 1;
    const float series = 1.5707288f + c * (-0.2121144f + c * (0.0742610f - c * 0.0187293f));
    const float turn = sqrtf(1 - c) * series * (float)(1 / SLI_RIGHT_ANGLE);
    const float bound = (cosine < 0 ? 2 - turn : turn) - BELOW;
    return bound > 0 ? bound : 0;
}

/// Bounds the turns of a word.
static void bound_word(const walker *w, const entry *at, uint32_t bundle, ways_on *ways,
                       float *turns) {
    const sli_vga_sights *s = w->sights;
    const float x = s->x[at->at], y = s->y[at->at];
    const float bx = x - s->x[at->before], by = y - s->y[at->before];
    float least = 2;
    for (uint64_t rest = ways->fresh; rest; rest &= rest - 1) {
        const uint32_t q = bundle * 64 + (uint32_t)__builtin_ctzll(rest);
        const float turn = bound_turn(s->x[q] - x, s->y[q] - y, bx, by);
        least = turn < least ? turn : least;
        *turns++ = -turn;
    }
    ways->least = least;
}

/// Splits what a point sees: points that the point before sees, too, can gain nothing.
static void split_row(walker *w, const entry *at) {
    const sli_vga_sights *s = w->sights;
    const sli_vga_word *words = s->words.items;
    const bool first = at->before == SLI_VGA_NONE;
    size_t k = first ? 0 : s->first[at->before];
    const size_t end = first ? 0 : s->first[at->before + 1];
    uint32_t count = 0;
    for (size_t i = s->first[at->at]; i < s->first[at->at + 1]; i++) {
        uint64_t fresh = words[i].seen;
        while (k < end && words[k].bundle < words[i].bundle) k++;
        if (k < end && words[k].bundle == words[i].bundle) fresh &= ~words[k].seen;
        w->ways[i] = (ways_on){fresh, count, -1};
        for (; fresh; fresh &= fresh - 1) count++;
    }
    w->before[at->at] = w->kept[at->at] ? at->before : SLI_VGA_NONE;
}

// --- paths

static float most_of(const float *turns) {
    float most[8] = {0};
    for (int i = 0; i < 64; i += 8)
        for (int k = 0; k < 8; k++) most[k] = turns[i + k] > most[k] ? turns[i + k] : most[k];
    for (int k = 1; k < 8; k++) most[0] = most[k] > most[0] ? most[k] : most[0];
    return most[0];
}

static sl_status gain(sl_context *context, walker *w, const entry *at, uint32_t q, float turn) {
    const sli_vga_sights *s = w->sights;
    w->turn[q] = turn;
    // Only straight ahead, and beside walls, are points expanded.
    if (turn > 0 && !sl_bits_has(s->turning, q)) return SL_OK;
    return push(context, w, (entry){turn, s->points[q], q, at->at, SLI_VGA_NONE});
}

static sl_status try_word(sl_context *context, walker *w, const entry *at, uint32_t bundle,
                          uint64_t fresh, float *turns) {
    bool gained = false;
    for (; fresh; fresh &= fresh - 1, turns++) {
        const uint32_t q = bundle * 64 + (uint32_t)__builtin_ctzll(fresh);
        if (at->key + fabsf(*turns) >= w->turn[q]) continue;
        if (signbit(*turns)) {
            *turns = sli_vga_turn(sli_vga_cosine(w->sights, at->before, at->at, q));
            if (at->key + *turns >= w->turn[q]) continue;
        }
        SL_TRY(gain(context, w, at, q, at->key + *turns));
        gained = true;
    }
    if (gained) w->most[bundle] = most_of(w->turn + (size_t)bundle * 64);
    return SL_OK;
}

static sl_status expand(sl_context *context, walker *w, const entry *at) {
    const sli_vga_sights *s = w->sights;
    float *turns = w->turns + w->kept[at->at];
    if (w->before[at->at] == SLI_VGA_NONE || w->before[at->at] != at->before) split_row(w, at);
    for (size_t i = s->first[at->at]; i < s->first[at->at + 1]; i++) {
        const uint32_t bundle = s->words.items[i].bundle;
        ways_on *ways = &w->ways[i];
        if (!(ways->fresh & ~w->done[bundle]) || at->key + ways->least >= w->most[bundle]) continue;
        if (ways->least < 0) {
            if (at->key >= w->most[bundle]) continue;
            bound_word(w, at, bundle, ways, turns + ways->first);
            if (at->key + ways->least >= w->most[bundle]) continue;
        }
        SL_TRY(try_word(context, w, at, bundle, ways->fresh, turns + ways->first));
    }
    return SL_OK;
}

/// All in sight of the start is reached without a turn.
static sl_status start(sl_context *context, walker *w, uint32_t from) {
    const sli_vga_sights *s = w->sights;
    const entry at = {0, s->points[from], from, SLI_VGA_NONE, SLI_VGA_NONE};
    w->turn[from] = 0;
    sl_bits_add(w->done, from);
    for (size_t i = s->first[from]; i < s->first[from + 1]; i++) {
        const sli_vga_word *word = &s->words.items[i];
        for (uint64_t rest = word->seen; rest; rest &= rest - 1) {
            const uint32_t q = word->bundle * 64 + (uint32_t)__builtin_ctzll(rest);
            SL_TRY(gain(context, w, &at, q, 0));
        }
        w->done[word->bundle] |= word->seen; // final
        w->most[word->bundle] = most_of(w->turn + (size_t)word->bundle * 64);
    }
    return SL_OK;
}

static sl_status find_straightest(sl_context *context, walker *w, uint32_t from) {
    const sli_vga_sights *s = w->sights;
    const double radius = s->job->options->angular_radius;
    w->heap.count = w->entries.count = w->waiting = 0;
    w->reached = 0;
    memset(w->buckets, 0xff, sizeof w->buckets); // none
    memset(w->done, 0, s->bundles * sizeof *w->done);
    for (uint32_t q = 0; q < s->count; q++)
        w->turn[q] = s->parts[q] == s->parts[from] ? INFINITY : -1; // never reached
    for (size_t k = 0; k < s->bundles; k++) w->most[k] = INFINITY;
    SL_TRY(start(context, w, from));
    for (;;) {
        if (!w->heap.count) SL_TRY(reach_next(context, w));
        if (!w->heap.count) return SL_OK;
        const entry e = sli_vga_pop(&w->heap);
        if (radius > 0 && e.key > radius) return SL_OK;
        if (e.key > w->turn[e.at]) continue; // a better path has come since
        SL_TRY(expand(context, w, &e));
        sl_bits_add(w->done, e.at);
    }
}

static sl_status measure(sl_context *context, void *state, uint32_t from) {
    walker *w = state;
    const sli_vga_sights *s = w->sights;
    const double radius = s->job->options->angular_radius;
    double turn = 0, nodes = 0;
    SL_TRY(find_straightest(context, w, from));
    for (uint32_t p = 0; p < s->count; p++) {
        const float of_p = w->turn[s->slots[p]];
        if (of_p == INFINITY || of_p < 0 || (radius > 0 && of_p > radius)) continue;
        turn += of_p;
        nodes++;
    }
    sl_vga_measures *out = &s->job->measures[s->points[from]];
    out->angular_mean_depth = turn / nodes;
    out->angular_total_depth = turn;
    out->angular_node_count = nodes;
    return SL_OK;
}

// --- all points

static void end(sl_context *context, void *state) {
    walker *w = state;
    void *parts[] = {w->turn, w->most,  w->done,       w->ways,          w->before,
                     w->kept, w->turns, w->heap.items, w->entries.items, w};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) sl_free(context, parts[i]);
}

static size_t count_seen(const sli_vga_sights *s, uint32_t slot) {
    size_t seen = 0;
    for (size_t i = s->first[slot]; i < s->first[slot + 1]; i++)
        seen += (size_t)__builtin_popcountll(s->words.items[i].seen);
    return seen;
}

/// Shares out room for turns, first what all share. Returns how much there is.
static size_t place_turns(walker *w) {
    const sli_vga_sights *s = w->sights;
    size_t most = 1;
    for (uint32_t slot = 0; slot < s->count; slot++)
        most = count_seen(s, slot) > most ? count_seen(s, slot) : most;
    size_t used = most;
    for (uint32_t slot = 0; slot < s->count; slot++) {
        const size_t degree = count_seen(s, slot);
        if (!sl_bits_has(s->turning, slot) || !degree || used - most + degree > SLI_VGA_KEPT_TURNS)
            continue;
        w->kept[slot] = used;
        used += degree;
    }
    return used;
}

static sl_status begin(sl_context *context, const sli_vga_searches *searches, void **state) {
    const sli_vga_sights *s = searches->sights;
    const size_t slots = s->bundles * 64;
    walker *w = sl_alloc_array(context, 1, sizeof *w);
    if (!w) return SL_NO_MEMORY;
    w->sights = s;
    w->turn = sl_alloc_array(context, slots, sizeof *w->turn);
    w->most = sl_alloc_array(context, s->bundles, sizeof *w->most);
    w->done = sl_alloc_array(context, s->bundles, sizeof *w->done);
    w->ways = sl_alloc_array(context, s->words.count + 1, sizeof *w->ways);
    w->before = sl_alloc_array(context, slots, sizeof *w->before);
    w->kept = sl_alloc_array(context, slots, sizeof *w->kept);
    if (w->kept) w->turns = sl_alloc_array(context, place_turns(w), sizeof *w->turns);
    if (!w->turn || !w->most || !w->done || !w->ways || !w->before || !w->turns) {
        end(context, w);
        return SL_NO_MEMORY;
    }
    memset(w->before, 0xff, slots * sizeof *w->before); // none
    *state = w;
    return SL_OK;
}

sl_status sli_vga_measure_angular(sl_context *context, const sli_vga_sights *sights) {
    const sli_vga_searches searches = {sights, NULL, begin, measure, end, "straightest paths"};
    return sli_vga_search_all(context, &searches);
}

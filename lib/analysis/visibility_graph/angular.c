/// Angular depth: the paths from each point to all others along a visibility graph that turn least
/// (depthmapX, vgaangular.cpp of its salalib; Dijkstra 1959).
///
/// A path turns at points beside walls, and where it has not turned so far. So only those points
/// are expanded. Neighbours that were seen from the point before are passed over:
///
///        p --------- u           The way p, q never turns more than p, u, q: the direction p to q
///          \        /            lies between p to u and u to q. So only neighbours of u that p
///            \    /              does not see can gain by u. We call them fresh.
///              q
///
/// Points of a word (64 points near each other) are tried only if one of them may gain: if the path
/// so far and the least turn to a fresh point of the word are less than the worst path in the word.
/// From one start to the next most points are reached from the same point before. So each point
/// beside walls keeps its fresh points and the least turns.
///
/// Points that are not reached yet have no path to compare with. They borrow one:
///
///       o--------- u ----- q     A point q expects what its path of the search before turns, moved
///     old         /              to the new start. A way on that turns more waits. When the search
///       x--------'               comes to what q expects, and nothing has reached q, then q looks
///     new                        for the best of all ways to it so far (`catch_up`).
///
/// Expectations need no proof: they only choose when a way on is tried. This needs sight in both
/// directions. With glass that is seen through one way, points expect nothing.
///
/// Where no path turns, points are last. By then all paths that lead there are known, and the point
/// before of the last search is a good first guess.
///
/// Turns are in single precision, and ties go to the lower number, as in depthmapX. Directions of
/// steps come from a table by offset. They are off by less than half of ROUNDING. So a way on that
/// is passed over gains nothing, and the result is that of trying all ways on, to the last bit.
///
/// Cost: for each point, the words of the points that are expanded, and a heap operation for each
/// gain of a point beside walls. Memory: the table, 48 bytes for each square of the grid, and for
/// each thread 16 bytes for each word of points beside walls.
#include "analysis/visibility_graph/graph_paths.h"

#include <string.h>

/// Of slots. Without a point before: a point expects to be reached.
typedef sli_vga_entry entry;

/// Keys of a bucket share their whole number of parts of a right angle.
enum { PARTS = 256, BUCKETS = 4 * PARTS };

/// Turns by the table are off by less than this, in right angles.
#define ROUNDING 2e-6f

/// How much more a point expects than it may, so that rounding does not disappoint it.
#define SLACK 1e-5f

/// Directions of steps by their offsets, in right angles from -2 to 2.
typedef struct compass {
    double *directions;
    float *rounded;
    const double *exact_middle; ///< of no step
    const float *middle;
    int32_t *places; ///< by slot: the offset is the difference of two places
    int32_t a_column;
    bool mutual; ///< points see those that see them
} compass;

/// What the ways on from a point to the fresh points of a word turn at least.
typedef struct ways_on {
    uint32_t bundle;
    float least; ///< first by the box around the bundle
} ways_on;

/// The ways on that a point keeps: its first words of points beside walls, and of others.
typedef struct kept_ways {
    uint32_t before; ///< the point before, or none
    uint32_t words[2];
} kept_ways;

typedef struct walker {
    const sli_vga_sights *sights;
    const compass *compass;
    // By slot:
    float *turn;     ///< of its path so far, in right angles, or what it expects
    uint32_t *last;  ///< the point before, or none: not reached
    uint32_t *hint;  ///< `last` of the search before
    float *heading;  ///< of those that are expanded: the direction of the last step
    uint32_t *rank;  ///< of those that are expanded: their place in `order`
    kept_ways *kept; ///< of those beside walls
    // By word of the points beside walls:
    ways_on *ways;
    uint64_t *fresh;
    // By bundle:
    float *most;              ///< the largest of `turn`
    sl_bits *sight;           ///< the start, and what it sees
    sl_bits *hidden;          ///< scratch: what a point sees
    sl_bits *done;            ///< points that were expanded
    SL_ARRAY(uint32_t) order; ///< slots in the order of expansion
    sli_vga_heap heap;        ///< of the bucket that is reached
    SL_ARRAY(entry) entries;  ///< of the buckets after it
    size_t waiting;           ///< entries that are not taken yet
    uint64_t reached;
    uint32_t buckets[BUCKETS]; ///< first entries
} walker;

// --- the queue: buckets of keys, and a small heap for the one that is reached

static sl_status push_turn(sl_context *context, walker *w, entry e) {
    const uint64_t bucket = (uint64_t)(e.key * PARTS);
    if (bucket == w->reached) return sli_vga_heap_push(context, &w->heap, e);
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
        uint32_t left = SLI_VGA_NONE; // of those that share the place, far ahead
        for (uint32_t i = *bucket, next; i != SLI_VGA_NONE; i = next) {
            entry *e = &w->entries.items[i];
            next = e->next;
            if ((uint64_t)(e->key * PARTS) == w->reached) {
                w->waiting--;
                if (e->key <= w->turn[e->at]) SL_TRY(sli_vga_heap_push(context, &w->heap, *e));
            } else {
                e->next = left;
                left = i;
            }
        }
        *bucket = left;
    }
    return SL_OK;
}

// --- turns

static inline float direction(const walker *w, uint32_t from, uint32_t to) {
    const compass *c = w->compass;
    return c->middle[c->places[to] - c->places[from]];
}

/// From one direction to another.
static inline float turn_between(float a, float b) {
    const float turn = fabsf(a - b);
    return 2 - fabsf(2 - turn);
}

/// At most the turn from a direction to any point of a box.
static float bound_turn(const walker *w, uint32_t at, float heading, const sli_vga_box *box) {
    const sli_vga_sights *s = w->sights;
    const float x = s->x[at], y = s->y[at];
    if (box->left <= x && x <= box->right && box->bottom <= y && y <= box->top) return 0;
    const float *column = w->compass->middle + (int32_t)(box->left - x) * w->compass->a_column;
    const int32_t wide = (int32_t)(box->right - box->left) * w->compass->a_column;
    const int32_t low = (int32_t)(box->bottom - y), high = (int32_t)(box->top - y);
    const float corners[] = {column[low], column[high], column[wide + low], column[wide + high]};
    float right = 2, left = -2, least = 2;
    for (int i = 0; i < 4; i++) {
        float turn = corners[i] - heading; // with its sign
        turn = turn > 2 ? turn - 4 : turn < -2 ? turn + 4 : turn;
        right = turn < right ? turn : right;
        left = turn > left ? turn : left;
        least = fabsf(turn) < least ? fabsf(turn) : least;
    }
    // The box is less than 2 wide. So it is ahead, or behind where the turns are up to 2.
    if (right <= 0 && left >= 0 && left - right <= 2) return 0;
    return least > ROUNDING ? least - ROUNDING : 0;
}

/// The turn as its formula has it, from directions: they tell it to about 1e-15 unless it is near
/// 0 or 2, where the formula is less exact. If rounding to single precision is in doubt, the
/// formula itself is asked.
static float turn_exactly(const walker *w, uint32_t before, uint32_t at, uint32_t to) {
    const compass *c = w->compass;
    const double a = c->exact_middle[c->places[at] - c->places[before]];
    const double b = c->exact_middle[c->places[to] - c->places[at]];
    const double about = fabs(a - b), turn = about > 2 ? 4 - about : about;
    const double off = 1e-14 / (turn < 1 ? turn : 2 - turn);
    const float low = (float)(turn - off);
    if (low == (float)(turn + off)) return low;
    return sli_vga_turn(sli_vga_cosine(w->sights, before, at, to));
}

static float most_of(const float *turns) {
    float most[8] = {0};
    for (int i = 0; i < 64; i += 8)
        for (int k = 0; k < 8; k++) most[k] = turns[i + k] > most[k] ? turns[i + k] : most[k];
    for (int k = 1; k < 8; k++) most[0] = most[k] > most[0] ? most[k] : most[0];
    return most[0];
}

// --- paths

static sl_status reach(sl_context *context, walker *w, uint32_t q, uint32_t at, float turn) {
    const sli_vga_sights *s = w->sights;
    w->turn[q] = turn;
    w->last[q] = at;
    // Only straight ahead, and beside walls, are points expanded.
    if (turn > 0 && q >= s->turning_count) return SL_OK;
    return push_turn(context, w, (entry){turn, s->points[q], q, at, SLI_VGA_NONE});
}

/// Tries the ways on to a word. Sets the least of their turns.
static sl_status try_word(sl_context *context, walker *w, uint32_t at, uint32_t bundle,
                          uint64_t fresh, float *least) {
    const float *middle = w->compass->middle;
    const int32_t *places = w->compass->places, place = places[at];
    const float key = w->turn[at], heading = w->heading[at];
    float lowest = 2;
    for (; fresh; fresh &= fresh - 1) {
        const uint32_t q = bundle * 64 + (uint32_t)__builtin_ctzll(fresh);
        const float about = turn_between(middle[places[q] - place], heading);
        lowest = about < lowest ? about : lowest;
        const float old = w->turn[q];
        if (key + (about - ROUNDING) >= old) continue;
        const float turn = key + turn_exactly(w, w->last[at], at, q);
        if (turn >= old) continue;
        SL_TRY(reach(context, w, q, at, turn));
        if (old == w->most[bundle]) w->most[bundle] = most_of(w->turn + (size_t)bundle * 64);
    }
    *least = lowest > ROUNDING ? lowest - ROUNDING : 0;
    return SL_OK;
}

/// Tries ways on straight ahead, to points where no path turns.
static sl_status try_straight(sl_context *context, walker *w, uint32_t at, uint32_t bundle,
                              uint64_t fresh) {
    for (; fresh; fresh &= fresh - 1) {
        const uint32_t q = bundle * 64 + (uint32_t)__builtin_ctzll(fresh);
        if (w->last[q] != SLI_VGA_NONE) continue;
        if (turn_between(direction(w, at, q), w->heading[at]) > ROUNDING) continue;
        if (turn_exactly(w, w->last[at], at, q) == 0) SL_TRY(reach(context, w, q, at, 0));
    }
    return SL_OK;
}

/// Tries the ways on of a path without a turn, to points beside walls or to others. `straight`:
/// those straight ahead alone.
static sl_status expand_straight(sl_context *context, walker *w, uint32_t at, bool others,
                                 bool straight) {
    const sli_vga_sights *s = w->sights;
    const sli_vga_word *words = s->words.items;
    const sl_bits *hidden = w->sight;
    const uint32_t before = w->last[at];
    if (!sl_bits_has(w->sight, at)) {
        memset(w->hidden, 0, s->bundles * sizeof *w->hidden);
        for (size_t i = s->first[before]; i < s->first[before + 1]; i++)
            w->hidden[words[i].bundle] |= words[i].seen;
        hidden = w->hidden;
    }
    const size_t end = others ? s->first[at + 1] : s->others[at];
    for (size_t i = others ? s->others[at] : s->first[at]; i < end; i++) {
        const uint32_t bundle = words[i].bundle;
        const uint64_t fresh = words[i].seen & ~hidden[bundle];
        if (!fresh) continue;
        float least = bound_turn(w, at, w->heading[at], &s->boxes[bundle]);
        if (straight && least == 0)
            SL_TRY(try_straight(context, w, at, bundle, fresh));
        else if (!straight && least < w->most[bundle])
            SL_TRY(try_word(context, w, at, bundle, fresh, &least));
    }
    return SL_OK;
}

/// Finds the fresh points of a point beside walls.
static void keep_ways(walker *w, uint32_t at) {
    const sli_vga_sights *s = w->sights;
    const sli_vga_word *words = s->words.items;
    const uint32_t before = w->last[at];
    const size_t first[] = {s->first[at], s->others[at], s->first[at + 1]};
    const size_t hidden[] = {s->first[before], s->others[before], s->first[before + 1]};
    for (int part = 0; part < 2; part++) {
        size_t k = hidden[part], to = first[part];
        for (size_t i = first[part]; i < first[part + 1]; i++) {
            const uint32_t bundle = words[i].bundle;
            uint64_t fresh = words[i].seen;
            while (k < hidden[part + 1] && words[k].bundle < bundle) k++;
            if (k < hidden[part + 1] && words[k].bundle == bundle) fresh &= ~words[k].seen;
            if (!fresh) continue;
            const float bound = bound_turn(w, at, w->heading[at], &s->boxes[bundle]);
            w->ways[to] = (ways_on){bundle, bound};
            w->fresh[to++] = fresh;
        }
        w->kept[at].words[part] = (uint32_t)(to - first[part]);
    }
    w->kept[at].before = before;
}

/// Tries the ways on that are kept, to points beside walls or to others.
static sl_status expand_kept(sl_context *context, walker *w, uint32_t at, bool others) {
    const float key = w->turn[at];
    const size_t first = others ? w->sights->others[at] : w->sights->first[at];
    const size_t end = first + w->kept[at].words[others];
    for (size_t i = first; i < end; i++) {
        ways_on *ways = &w->ways[i];
        if (key + ways->least < w->most[ways->bundle])
            SL_TRY(try_word(context, w, at, ways->bundle, w->fresh[i], &ways->least));
    }
    return SL_OK;
}

static sl_status expand(sl_context *context, walker *w, uint32_t at) {
    SL_TRY(SL_ARRAY_ROOM(context, &w->order, 1));
    w->rank[at] = (uint32_t)w->order.count;
    w->order.items[w->order.count++] = at;
    w->heading[at] = direction(w, w->last[at], at);
    sl_bits_add(w->done, at);
    if (w->turn[at] == 0) {
        SL_TRY(expand_straight(context, w, at, true, true));
        return expand_straight(context, w, at, false, false);
    }
    if (w->kept[at].before != w->last[at]) keep_ways(w, at);
    return expand_kept(context, w, at, false);
}

/// Finds the best of all ways so far to a point.
static sl_status catch_up(sl_context *context, walker *w, uint32_t q) {
    const sli_vga_sights *s = w->sights;
    float best = INFINITY;
    uint32_t best_at = SLI_VGA_NONE;
    for (size_t i = s->first[q]; i < s->first[q + 1]; i++) {
        const sli_vga_word *word = &s->words.items[i];
        for (uint64_t rest = word->seen & w->done[word->bundle]; rest; rest &= rest - 1) {
            const uint32_t at = word->bundle * 64 + (uint32_t)__builtin_ctzll(rest);
            const float about = turn_between(direction(w, at, q), w->heading[at]);
            if (w->turn[at] + (about - ROUNDING) > best) continue;
            const uint32_t before = w->last[at];
            if (sli_vga_slot_sees(s, before, q)) continue;
            const float turn = w->turn[at] + turn_exactly(w, before, at, q);
            if (turn > best || (turn == best && w->rank[at] > w->rank[best_at])) continue;
            best = turn;
            best_at = at;
        }
    }
    w->turn[q] = best;
    w->most[q / 64] = most_of(w->turn + (size_t)(q / 64) * 64);
    return best_at == SLI_VGA_NONE ? SL_OK : reach(context, w, q, best_at, best);
}

// --- a search

/// Points beside walls expect the paths of the search before, from the new start.
static sl_status expect(sl_context *context, walker *w, uint32_t from) {
    const sli_vga_sights *s = w->sights;
    if (!w->compass->mutual || !w->order.count) return SL_OK;
    const uint32_t old_from = w->order.items[0];
    if (!sl_bits_has(w->sight, old_from)) return SL_OK;
    for (size_t i = 0; i < w->order.count; i++) {
        const uint32_t q = w->order.items[i], at = w->hint[q];
        if (q == from) continue;
        if (sl_bits_has(w->sight, q)) {
            w->turn[q] = 0;
            w->heading[q] = direction(w, from, q);
            continue;
        }
        const float turn = w->turn[at] + SLACK;
        w->turn[q] = turn + turn_between(direction(w, at, q), w->heading[at]);
        if (q < s->turning_count)
            SL_TRY(push_turn(context, w, (entry){w->turn[q], s->points[q], q, SLI_VGA_NONE, 0}));
    }
    return SL_OK;
}

/// All in sight of the start is reached without a turn.
static sl_status start(sl_context *context, walker *w, uint32_t from) {
    const sli_vga_sights *s = w->sights;
    uint32_t *hint = w->hint;
    w->hint = w->last;
    w->last = hint;
    for (uint32_t q = 0; q < s->count; q++) {
        w->turn[q] = s->parts[q] == s->parts[from] ? INFINITY : -1; // never reached
        w->last[q] = SLI_VGA_NONE;
    }
    memset(w->sight, 0, s->bundles * sizeof *w->sight);
    memset(w->done, 0, s->bundles * sizeof *w->done);
    sl_bits_add(w->sight, from);
    for (size_t i = s->first[from]; i < s->first[from + 1]; i++)
        w->sight[s->words.items[i].bundle] |= s->words.items[i].seen;
    SL_TRY(expect(context, w, from));
    for (uint32_t q = s->turning_count; q < s->count; q++) w->turn[q] = -1; // these come last
    w->turn[from] = 0;
    w->last[from] = from;
    w->order.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &w->order, 1));
    w->order.items[w->order.count++] = from;
    for (size_t i = s->first[from]; i < s->first[from + 1]; i++) {
        const sli_vga_word *word = &s->words.items[i];
        for (uint64_t rest = word->seen; rest; rest &= rest - 1)
            SL_TRY(reach(context, w, word->bundle * 64 + (uint32_t)__builtin_ctzll(rest), from, 0));
    }
    for (size_t b = 0; b < s->bundles; b++) w->most[b] = most_of(w->turn + b * 64);
    return SL_OK;
}

/// Finds the paths to points where none turns.
static sl_status reach_others(sl_context *context, walker *w) {
    const sli_vga_sights *s = w->sights;
    const uint32_t from = w->order.items[0];
    for (uint32_t q = s->turning_count; q < s->count; q++) {
        const uint32_t at = w->hint[q];
        if (w->last[q] != SLI_VGA_NONE || s->parts[q] != s->parts[from]) continue;
        w->turn[q] = INFINITY;
        if (!w->compass->mutual || at == SLI_VGA_NONE || !sl_bits_has(w->done, at)) continue;
        w->turn[q] = w->turn[at] + turn_between(direction(w, at, q), w->heading[at]) + SLACK;
    }
    for (size_t b = s->turning_count / 64; b < s->bundles; b++)
        w->most[b] = most_of(w->turn + b * 64);
    for (size_t i = 1; i < w->order.count; i++) {
        const uint32_t at = w->order.items[i];
        if (w->turn[at] == 0)
            SL_TRY(expand_straight(context, w, at, true, false));
        else
            SL_TRY(expand_kept(context, w, at, true));
    }
    for (uint32_t q = s->turning_count; q < s->count; q++)
        if (w->last[q] == SLI_VGA_NONE && w->turn[q] >= 0 && w->turn[q] < INFINITY)
            SL_TRY(catch_up(context, w, q));
    return SL_OK;
}

static sl_status find_straightest(sl_context *context, walker *w, uint32_t from) {
    const double radius = w->sights->job->options->angular_radius;
    w->heap.count = w->entries.count = w->waiting = 0;
    w->reached = 0;
    memset(w->buckets, 0xff, sizeof w->buckets); // none
    SL_TRY(start(context, w, from));
    for (;;) {
        if (!w->heap.count) SL_TRY(reach_next(context, w));
        if (!w->heap.count) break;
        const entry e = sli_vga_heap_pop(&w->heap);
        if (radius > 0 && e.key > radius) break;
        if (e.key > w->turn[e.at]) continue; // a better path has come since
        if (e.before != SLI_VGA_NONE)
            SL_TRY(expand(context, w, e.at));
        else if (w->last[e.at] == SLI_VGA_NONE)
            SL_TRY(catch_up(context, w, e.at));
    }
    return reach_others(context, w);
}

static sl_status measure(sl_context *context, void *state, uint32_t from) {
    walker *w = state;
    const sli_vga_sights *s = w->sights;
    const double radius = s->job->options->angular_radius;
    double turn = 0, nodes = 0;
    SL_TRY(find_straightest(context, w, from));
    for (uint32_t p = 0; p < s->count; p++) {
        const uint32_t slot = s->slots[p];
        if (w->last[slot] == SLI_VGA_NONE || (radius > 0 && w->turn[slot] > radius)) continue;
        turn += w->turn[slot];
        nodes++;
    }
    sl_vga_measures *out = &s->job->measures[s->points[from]];
    out->angular_mean_depth = turn / nodes;
    out->angular_total_depth = turn;
    out->angular_node_count = nodes;
    return SL_OK;
}

// --- all points

static void end_angular_search(sl_context *context, void *state) {
    walker *w = state;
    void *parts[] = {w->turn,        w->last,       w->hint,          w->heading,
                     w->rank,        w->kept,       w->ways,          w->fresh,
                     w->most,        w->sight,      w->hidden,        w->done,
                     w->order.items, w->heap.items, w->entries.items, w};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) sl_free(context, parts[i]);
}

static sl_status begin_angular_search(sl_context *context, const sli_vga_searches *searches,
                                      void **state) {
    const sli_vga_sights *s = searches->sights;
    const size_t slots = s->bundles * 64;
    walker *w = sl_alloc_array(context, 1, sizeof *w);
    if (!w) return SL_NO_MEMORY;
    w->sights = s;
    w->compass = searches->shared;
    w->turn = sl_alloc_array(context, slots, sizeof *w->turn);
    w->last = sl_alloc_array(context, slots, sizeof *w->last);
    w->hint = sl_alloc_array(context, slots, sizeof *w->hint);
    w->heading = sl_alloc_array(context, slots, sizeof *w->heading);
    w->rank = sl_alloc_array(context, slots, sizeof *w->rank);
    w->kept = sl_alloc_array(context, s->turning_count, sizeof *w->kept);
    w->ways = sl_alloc_array(context, s->first[s->turning_count], sizeof *w->ways);
    w->fresh = sl_alloc_array(context, s->first[s->turning_count], sizeof *w->fresh);
    w->most = sl_alloc_array(context, s->bundles, sizeof *w->most);
    w->sight = sl_alloc_array(context, s->bundles, sizeof *w->sight);
    w->hidden = sl_alloc_array(context, s->bundles, sizeof *w->hidden);
    w->done = sl_alloc_array(context, s->bundles, sizeof *w->done);
    if (!w->turn || !w->last || !w->hint || !w->heading || !w->rank || !w->kept || !w->ways ||
        !w->fresh || !w->most || !w->sight || !w->hidden || !w->done) {
        end_angular_search(context, w);
        return SL_NO_MEMORY;
    }
    memset(w->last, 0xff, slots * sizeof *w->last); // none
    memset(w->kept, 0xff, s->turning_count * sizeof *w->kept);
    *state = w;
    return SL_OK;
}

static sl_status compass_make(sl_context *context, const sli_vga_sights *s, compass *c) {
    const int32_t columns = (int32_t)s->job->grid->columns, rows = (int32_t)s->job->grid->rows;
    const size_t offsets = ((size_t)columns * 2 - 1) * ((size_t)rows * 2 - 1);
    *c = (compass){.a_column = 2 * rows - 1, .mutual = !s->job->graph->directed};
    c->directions = sl_alloc_array(context, offsets, sizeof *c->directions);
    c->rounded = sl_alloc_array(context, offsets, sizeof *c->rounded);
    c->places = sl_alloc_array(context, s->count, sizeof *c->places);
    if (!c->directions || !c->rounded || !c->places) return SL_NO_MEMORY;
    double *next = c->directions;
    for (int32_t x = 1 - columns; x < columns; x++)
        for (int32_t y = 1 - rows; y < rows; y++) *next++ = atan2(y, x) / SLI_RIGHT_ANGLE;
    for (size_t i = 0; i < offsets; i++) c->rounded[i] = (float)c->directions[i];
    c->exact_middle = c->directions + offsets / 2;
    c->middle = c->rounded + offsets / 2;
    for (uint32_t slot = 0; slot < s->count; slot++)
        c->places[slot] = (int32_t)s->x[slot] * c->a_column + (int32_t)s->y[slot];
    return SL_OK;
}

sl_status sli_vga_measure_angular(sl_context *context, const sli_vga_sights *sights) {
    compass shared;
    const sli_vga_searches searches = {
        sights, &shared, begin_angular_search, measure, end_angular_search, "straightest paths"};
    sl_status status = compass_make(context, sights, &shared);
    if (status == SL_OK) status = sli_vga_search_all(context, &searches);
    sl_free(context, shared.directions);
    sl_free(context, shared.rounded);
    sl_free(context, shared.places);
    return status;
}

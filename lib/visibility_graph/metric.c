/// Metric depth: the shortest paths from each point to all others along a visibility graph
/// (depthmapX, vgametric.cpp of its salalib; Dijkstra 1959).
///
/// A path turns only at points beside walls. So only those points are expanded, and the first.
/// Distances are counted in squares and in single precision. Of equally long paths the first in
/// the order of (length, number of the point) counts. All of this is as in depthmapX.
///
/// Neighbouring points have almost the same paths. So a search begins with what the search before
/// it, from the point beside it, has found:
///
///       o--------- u ----- q     Bounds: a path from the old start, moved to the new one, is a
///     old         /              path. So its length bounds the shortest from above. A way on
///       x--------'               that is longer than the bound gains nothing.
///     new
///
/// Slack: how much longer the way by u to q is than the bound of q. Of the 64 points of a word, u
/// keeps the least slack. From one start to the next it shrinks by no more than the length of u and
/// the bounds of the 64 points do. While it is over 0, the 64 are passed over.
///
/// Points that are seen from the point before u are passed over too, unless they are straight
/// ahead, as the detour by u is longer.
///
/// Invariant: what is passed over is longer than the shortest path by more than rounding can hide
/// (`tolerance`). Thus the result is that of trying all ways on, to the last bit.
///
/// Cost: for each point about O(points + words of points beside walls); a word is tried only where
/// it may gain. Keys are at least 1 apart along a path, so a bucket for each whole length is sorted
/// once, when it is reached.
#include "visibility_graph/paths.h"

#include <stdlib.h>
#include <string.h>

typedef struct entry {
    float key;
    uint32_t slot, before; ///< before: the slot of the path before it, or none
    uint32_t number;       ///< of the point
    uint32_t next;         ///< in its bucket, or none
} entry;

/// A turn that was computed.
typedef struct known_turn {
    uint32_t before, at;
    float turn;
} known_turn;

/// Points with less slack are tried each time.
#define LIST_BELOW 0.02f

/// A longer detour than this is told from none in spite of rounding.
#define DETOUR 0.002f

/// The ways on from a point to those of a word.
typedef struct ways_on {
    uint64_t fresh; ///< points that the point before does not see
    uint64_t tried; ///< points that are tried each time
    float least;    ///< no more than the slack of any other fresh point
} ways_on;

typedef struct walker {
    const sli_vga_sights *sights;
    // By slot:
    float *length;     ///< of its path so far, in squares; INFINITY: none
    float *old_length; ///< from the start before
    float *bound;      ///< no shortest path is longer, but for rounding
    float *old_bound;
    float *turn;      ///< along its path, in right angles, once the path is final
    float *hop;       ///< length of its path's last step
    uint32_t *last;   ///< the slot of its path before it, or none
    uint32_t *steps;  ///< of the path of its bound
    uint32_t *before; ///< of those that were expanded: `before` of their entry
    uint32_t *run;    ///< number of the search in which its slacks were set
    known_turn *turns;
    // By bundle:
    sl_bits *seen;                   ///< by the start
    float *most_bound, *most_change; ///< the largest bound; by how much a bound grows at most
    // By word:
    ways_on *ways;
    uint32_t *buckets; ///< first entries; by length modulo their number
    uint32_t bucket_mask;
    SL_ARRAY(entry) entries;
    SL_ARRAY(entry) sorted;
    SL_ARRAY(uint32_t) order; ///< slots in the order of expansion
    size_t waiting;
    uint32_t from, old_from, runs;
    float tolerance, guard;
} walker;

// --- buckets

static sl_status push(sl_context *context, walker *w, float key, uint32_t slot, uint32_t before) {
    SL_TRY(SL_ARRAY_ROOM(context, &w->entries, 1));
    uint32_t *bucket = &w->buckets[(uint64_t)key & w->bucket_mask];
    w->entries.items[w->entries.count] =
        (entry){key, slot, before, w->sights->points[slot], *bucket};
    *bucket = (uint32_t)w->entries.count++;
    w->waiting++;
    return SL_OK;
}

static bool is_before(const entry *a, const entry *b) {
    return a->key < b->key || (a->key == b->key && a->number < b->number);
}

static int compare_entries(const void *left, const void *right) {
    return is_before(right, left) - is_before(left, right);
}

/// Takes all entries of a bucket, sorted.
static sl_status take_bucket(sl_context *context, walker *w, uint64_t length) {
    uint32_t *bucket = &w->buckets[length & w->bucket_mask];
    w->sorted.count = 0;
    for (uint32_t i = *bucket; i != SLI_VGA_NONE; i = w->entries.items[i].next) {
        SL_TRY(SL_ARRAY_ROOM(context, &w->sorted, 1));
        const entry e = w->entries.items[i];
        w->waiting--;
        if (e.key > w->length[e.slot]) continue; // a shorter path has come since
        w->sorted.items[w->sorted.count++] = e;
    }
    *bucket = SLI_VGA_NONE;
    entry *all = w->sorted.items;
    if (w->sorted.count > 48) {
        qsort(all, w->sorted.count, sizeof *all, compare_entries);
        return SL_OK;
    }
    for (size_t i = 1; i < w->sorted.count; i++) {
        const entry e = all[i];
        size_t k = i;
        for (; k && is_before(&e, &all[k - 1]); k--) all[k] = all[k - 1];
        all[k] = e;
    }
    return SL_OK;
}

// --- bounds

/// The bound of a point that the start does not see: by two steps.
static void bound_by_two(walker *w, uint32_t q) {
    const sli_vga_sights *s = w->sights;
    for (size_t i = s->first[q]; i < s->first[q + 1]; i++) {
        const sli_vga_word *word = &s->words.items[i];
        uint64_t both = word->seen & w->seen[word->bundle] & s->turning[word->bundle];
        for (; both; both &= both - 1) {
            const uint32_t at = word->bundle * 64 + (uint32_t)__builtin_ctzll(both);
            // Through one-way glass q may see what does not see it.
            if (!sl_bits_has(sli_vga_row(s->job->graph, s->points[at]), s->points[q])) continue;
            const float way = w->bound[at] + (float)sli_vga_distance(s, at, q);
            w->bound[q] = way < w->bound[q] ? way : w->bound[q];
        }
    }
    w->steps[q] = 2;
}

/// The bound of a point by the path from the old start.
static void move_bound(walker *w, uint32_t q) {
    const uint32_t at = w->last[q];
    if (w->bound[q] < INFINITY || at == SLI_VGA_NONE) return;
    if (at == w->old_from) {
        bound_by_two(w, q);
        return;
    }
    w->bound[q] = w->bound[at] + w->hop[q];
    w->steps[q] = w->steps[at] + 1;
}

static void bound_seen(walker *w, uint32_t from) {
    const sli_vga_sights *s = w->sights;
    memset(w->seen, 0, s->bundles * sizeof *w->seen);
    for (size_t i = s->first[from]; i < s->first[from + 1]; i++) {
        const sli_vga_word *word = &s->words.items[i];
        w->seen[word->bundle] = word->seen;
        for (uint64_t rest = word->seen; rest; rest &= rest - 1) {
            const uint32_t q = word->bundle * 64 + (uint32_t)__builtin_ctzll(rest);
            w->bound[q] = (float)sli_vga_distance(s, from, q);
            w->steps[q] = 1;
        }
    }
    w->bound[from] = 0;
    w->steps[from] = 0;
}

/// Sums up bounds and their changes by bundles.
static void sum_up_bounds(walker *w) {
    float longest = 0;
    uint32_t steps = 0;
    for (size_t b = 0; b < w->sights->bundles; b++) {
        float most = 0, change = -INFINITY;
        for (size_t q = b * 64; q < b * 64 + 64; q++) {
            const float now = w->bound[q], old = w->old_bound[q];
            const float grown = now < INFINITY && old < INFINITY ? now - old : INFINITY;
            most = now > most ? now : most;
            change = grown > change ? grown : change;
            if (now < INFINITY && now > longest) longest = now;
            steps = w->steps[q] > steps ? w->steps[q] : steps;
        }
        w->most_bound[b] = most;
        w->most_change[b] = change;
    }
    // Each step of a path is rounded twice, by half of 2^-23 of its length.
    w->tolerance = longest * (float)(steps + 8) * 2.4e-7f;
    w->guard = longest * 5e-7f;
}

static void find_bounds(walker *w, uint32_t from) {
    const uint32_t count = w->sights->count;
    float *swap = w->bound;
    w->bound = w->old_bound;
    w->old_bound = swap;
    const uint32_t *parts = w->sights->parts;
    for (uint32_t q = 0; q < count; q++) w->bound[q] = parts[q] == parts[from] ? INFINITY : 0;
    bound_seen(w, from);
    if (w->old_from != SLI_VGA_NONE) {
        for (size_t i = 0; i < w->order.count; i++) move_bound(w, w->order.items[i]);
        for (uint32_t q = 0; q < count; q++) move_bound(w, q);
    }
    sum_up_bounds(w);
}

// --- paths

/// The turn of a path whose last step is known, and all before it.
static float turn_to(walker *w, uint32_t slot) {
    const uint32_t at = w->last[slot], before = w->before[at];
    if (before == SLI_VGA_NONE) return 0;
    known_turn *known = &w->turns[slot];
    if (known->at != at || known->before != before)
        *known =
            (known_turn){before, at, sli_vga_turn(sli_vga_cosine(w->sights, before, at, slot))};
    return w->turn[at] + known->turn;
}

static float distance_to_box(float x, float y, const sli_vga_box *box) {
    const float dx = x < box->left ? box->left - x : x > box->right ? x - box->right : 0;
    const float dy = y < box->bottom ? box->bottom - y : y > box->top ? y - box->top : 0;
    return sqrtf(dx * dx + dy * dy);
}

/// Tries the way on from a point to another.
static sl_status try_point(sl_context *context, walker *w, const entry *at, uint32_t q) {
    const sli_vga_sights *s = w->sights;
    const float old = w->length[q];
    const double dx = (double)s->x[at->slot] - (double)s->x[q];
    const double dy = (double)s->y[at->slot] - (double)s->y[q];
    const double bound = (double)w->bound[q] + w->tolerance;
    const double left = (bound < old ? bound : old) - at->key, square = dx * dx + dy * dy;
    if (square > left * left * (1 + 1e-12)) return SL_OK; // without a root
    const double step = sqrt(square);
    if (at->key + step >= old) return SL_OK;
    w->hop[q] = (float)step;
    w->length[q] = at->key + w->hop[q];
    w->last[q] = at->slot;
    // A path that is shorter by less than a float tells is there already, with its way so far.
    if (w->length[q] == old || !sl_bits_has(s->turning, q)) return SL_OK;
    return push(context, w, w->length[q], q, at->slot);
}

/// Those of a word that are straight ahead, or nearly: the detour by `at` is up to DETOUR.
static uint64_t find_ahead(const sli_vga_sights *s, const entry *at, uint32_t bundle,
                           uint64_t seen) {
    const float x = s->x[at->slot], y = s->y[at->slot];
    const float bx = x - s->x[at->before], by = y - s->y[at->before];
    const float hop = sqrtf(bx * bx + by * by);
    uint64_t ahead = 0;
    for (; seen; seen &= seen - 1) {
        const uint32_t q = bundle * 64 + (uint32_t)__builtin_ctzll(seen);
        const float ax = s->x[q] - x, ay = s->y[q] - y;
        const float dot = ax * bx + ay * by, cross = ax * by - ay * bx;
        // A detour d of steps a and b turns by t: t * t is about 2 d (1 / a + 1 / b).
        if (dot > 0 && cross * cross <= 2.2f * DETOUR * (dot / hop + hop) * dot)
            ahead |= (uint64_t)1 << q % 64;
    }
    return ahead;
}

/// Splits what a point sees. Points that the point before sees, too, can gain nothing, unless they
/// are straight ahead.
static void split_row(walker *w, const entry *at) {
    const sli_vga_sights *s = w->sights;
    const bool all = at->before == SLI_VGA_NONE || w->tolerance > DETOUR / 2;
    size_t k = all ? 0 : s->first[at->before];
    for (size_t i = s->first[at->slot]; i < s->first[at->slot + 1]; i++) {
        const sli_vga_word *word = &s->words.items[i];
        uint64_t known = 0;
        if (!all) {
            const size_t end = s->first[at->before + 1];
            while (k < end && s->words.items[k].bundle < word->bundle) k++;
            if (k < end && s->words.items[k].bundle == word->bundle)
                known = s->words.items[k].seen & word->seen;
        }
        w->ways[i].fresh = word->seen & ~known;
        w->ways[i].tried = known ? find_ahead(s, at, word->bundle, known) : 0;
        w->ways[i].least = -INFINITY;
    }
}

static sl_status try_points(sl_context *context, walker *w, const entry *at, uint32_t bundle,
                            uint64_t points) {
    for (; points; points &= points - 1)
        SL_TRY(try_point(context, w, at, bundle * 64 + (uint32_t)__builtin_ctzll(points)));
    return SL_OK;
}

/// Takes down the slacks of the ways on to those of a word.
static void find_slacks(walker *w, const entry *at, uint32_t bundle, ways_on *ways) {
    const sli_vga_sights *s = w->sights;
    const float x = s->x[at->slot], y = s->y[at->slot], key = at->key - w->guard;
    uint64_t listed = 0;
    ways->tried &= ~ways->fresh;
    ways->least = key + distance_to_box(x, y, &s->boxes[bundle]) - w->most_bound[bundle];
    if (ways->least > w->tolerance) return;
    ways->least = INFINITY;
    for (uint64_t rest = ways->fresh; rest; rest &= rest - 1) {
        const uint32_t q = bundle * 64 + (uint32_t)__builtin_ctzll(rest);
        const float dx = x - s->x[q], dy = y - s->y[q];
        const float slack = key + sqrtf(dx * dx + dy * dy) - w->bound[q];
        listed |= (uint64_t)(slack <= LIST_BELOW) << q % 64;
        const float other = slack <= LIST_BELOW ? INFINITY : slack;
        ways->least = other < ways->least ? other : ways->least;
    }
    ways->tried |= listed;
}

static sl_status expand(sl_context *context, walker *w, const entry *at) {
    const sli_vga_sights *s = w->sights;
    const size_t end = s->first[at->slot + 1];
    const bool known = w->run[at->slot] + 1 == w->runs && w->before[at->slot] == at->before &&
                       w->tolerance <= DETOUR / 2;
    const float grown = at->key - w->old_length[at->slot] - w->guard;
    if (!known) split_row(w, at);
    for (size_t i = s->first[at->slot]; i < end; i++) {
        const uint32_t bundle = s->words.items[i].bundle;
        ways_on *ways = &w->ways[i];
        if (known) ways->least += grown - w->most_change[bundle];
        if (ways->fresh && !(ways->least > w->tolerance)) find_slacks(w, at, bundle, ways);
        SL_TRY(try_points(context, w, at, bundle, ways->tried));
    }
    w->run[at->slot] = w->runs;
    return SL_OK;
}

static sl_status find_shortest(sl_context *context, walker *w, uint32_t from) {
    const sli_vga_job *j = w->sights->job;
    const double radius = j->options->metric_radius, step = j->grid->step;
    float *swap = w->length;
    w->runs++;
    w->length = w->old_length;
    w->old_length = swap;
    w->from = from;
    find_bounds(w, from);
    w->order.count = 0;
    w->entries.count = 0;
    for (uint32_t q = 0; q < w->sights->count; q++) {
        w->length[q] = w->turn[q] = INFINITY;
        w->last[q] = SLI_VGA_NONE;
    }
    w->length[from] = w->turn[from] = 0;
    SL_TRY(push(context, w, 0, from, SLI_VGA_NONE));
    bool within = true;
    for (uint64_t length = 0; w->waiting; length++) {
        if (w->buckets[length & w->bucket_mask] == SLI_VGA_NONE) continue;
        SL_TRY(take_bucket(context, w, length));
        SL_TRY(SL_ARRAY_ROOM(context, &w->order, w->sorted.count));
        for (size_t i = 0; i < w->sorted.count && within; i++) {
            const entry *e = &w->sorted.items[i];
            within = !(radius > 0 && e->key * step > radius);
            if (!within) break; // what waits is taken, and left
            if (e->before != SLI_VGA_NONE) w->turn[e->slot] = turn_to(w, e->slot);
            w->order.items[w->order.count++] = e->slot;
            SL_TRY(expand(context, w, e));
            w->before[e->slot] = e->before;
        }
    }
    w->old_from = from;
    return SL_OK;
}

static sl_status measure(sl_context *context, walker *w, uint32_t from) {
    const sli_vga_sights *s = w->sights;
    const sl_vga_options *options = s->job->options;
    const double step = s->job->grid->step;
    double length = 0, turn = 0, straight = 0, nodes = 0;
    SL_TRY(find_shortest(context, w, from));
    for (uint32_t p = 0; p < s->count; p++) {
        const uint32_t slot = s->slots[p];
        if (w->length[slot] == INFINITY) continue;
        if (options->metric_radius > 0 && w->length[slot] * step > options->metric_radius) continue;
        length += w->length[slot] * step;
        if (slot != from) turn += w->turn[slot] == INFINITY ? turn_to(w, slot) : w->turn[slot];
        straight += step * sli_vga_distance(s, slot, from);
        nodes++;
    }
    sl_vga_measures *out = &s->job->measures[s->points[from]];
    out->metric_mean_shortest_path_distance = length / nodes;
    out->metric_mean_shortest_path_angle = turn / nodes;
    out->metric_mean_straight_line_distance = straight / nodes;
    out->metric_node_count = nodes;
    return SL_OK;
}

// --- all points

static void end(sl_context *context, void *all, void *state) {
    (void)all;
    walker *w = state;
    void *parts[] = {w->length,  w->old_length,    w->bound,        w->old_bound,   w->turn,
                     w->hop,     w->last,          w->steps,        w->before,      w->run,
                     w->turns,   w->most_bound,    w->most_change,  w->seen,        w->ways,
                     w->buckets, w->entries.items, w->sorted.items, w->order.items, w};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) sl_free(context, parts[i]);
}

static sl_status begin(sl_context *context, void *all, void **state) {
    const sli_vga_sights *s = all;
    const sl_vga_grid *grid = s->job->grid;
    const size_t slots = s->bundles * 64;
    walker *w = sl_alloc_array(context, 1, sizeof *w);
    if (!w) return SL_NO_MEMORY;
    w->sights = s;
    w->old_from = SLI_VGA_NONE;
    w->runs = 1; // no slack is of the search before the first
    // No step is longer than columns and rows together, so that many lengths can wait at once.
    for (w->bucket_mask = 1; w->bucket_mask < grid->columns + grid->rows + 2;)
        w->bucket_mask = w->bucket_mask * 2 + 1;
    float **floats[] = {&w->length, &w->old_length, &w->bound, &w->old_bound, &w->turn, &w->hop};
    uint32_t **numbers[] = {&w->last, &w->steps, &w->before, &w->run};
    bool room = true;
    for (size_t i = 0; i < sizeof floats / sizeof *floats; i++)
        room &= (*floats[i] = sl_alloc_array(context, slots, sizeof **floats[i])) != NULL;
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        room &= (*numbers[i] = sl_alloc_array(context, slots, sizeof **numbers[i])) != NULL;
    w->turns = sl_alloc_array(context, slots, sizeof *w->turns);
    w->most_bound = sl_alloc_array(context, s->bundles, sizeof *w->most_bound);
    w->most_change = sl_alloc_array(context, s->bundles, sizeof *w->most_change);
    w->seen = sl_alloc_array(context, s->bundles, sizeof *w->seen);
    w->ways = sl_alloc_array(context, s->words.count + 1, sizeof *w->ways);
    w->buckets = sl_alloc_array(context, (size_t)w->bucket_mask + 1, sizeof *w->buckets);
    if (!room || !w->turns || !w->most_bound || !w->most_change || !w->seen || !w->ways ||
        !w->buckets) {
        end(context, all, w);
        return SL_NO_MEMORY;
    }
    memset(w->buckets, 0xff, ((size_t)w->bucket_mask + 1) * sizeof *w->buckets);
    *state = w;
    return SL_OK;
}

static sl_status measure_unit(sl_context *context, void *all, void *state, size_t unit) {
    const sli_vga_sights *s = all;
    for (size_t slot = unit * 64; slot < s->count && slot < unit * 64 + 64; slot++) {
        SL_TRY(sl_check_cancelled(context));
        SL_TRY(measure(context, state, (uint32_t)slot));
    }
    return SL_OK;
}

sl_status sli_vga_measure_metric(sl_context *context, const sli_vga_sights *sights) {
    sli_vga_sights mine = *sights;
    const sl_work work = {.job = &mine,
                          .begin = begin,
                          .unit = measure_unit,
                          .end = end,
                          .stage = "shortest paths",
                          .units = "bundles of points"};
    return sl_work_run(context, &work, sights->bundles, sights->job->options->threads);
}

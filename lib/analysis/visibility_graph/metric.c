/// Metric depth: the shortest paths from each point to all others along a visibility graph
/// (depthmapX, vgametric.cpp of its salalib; Dijkstra 1959).
///
/// A path turns only at points beside walls. So only those points are expanded, and the first.
/// Distances are counted in squares and in single precision. Of equally long paths the first in
/// the order of (length, number of the point) counts. All of this is as in depthmapX.
///
/// Each part of a shortest path is a shortest path. So two steps p, u, q are part of one only if no
/// other way of one or two steps leads from p to q and is shorter:
///
///          u ------ q         From p by u only those q are tried that u is best for. The lists
///         /  #    .           of these q are made once, for all points p beside walls, and serve
///        /  #  .              the searches from all points.
///       p . v                 (v is shorter: p, u, q is not listed)
///
/// Invariant: what is not listed is longer than the shortest path by more than rounding can hide
/// (`detour`), or the search is done again with all ways on. Thus the result is that of trying all
/// ways on, to the last bit.
///
/// A search begins with bounds: the paths from the point beside it, moved to the new start. A way
/// on that is longer than the bound by more than `detour` is passed over.
///
/// Cost: for each point about O(points + ways on in the lists of points beside walls). The lists
/// take O(pairs of points that are two steps apart), up to a limit; what has no list tries all.
/// Keys are at least 1 apart along a path, so a bucket of keys near each other is sorted once, when
/// it is reached.
#include "analysis/visibility_graph/graph_paths.h"
#include "base/base.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

/// A way on to a point, and the number of its step; NONE where no path turns at the point.
typedef struct way_on {
    uint32_t slot, step;
    float length; ///< of the step, rounded
} way_on;

/// Buckets hold the keys of a part of a square.
enum { PARTS = 4 };

/// Shortest paths are told from others by at least this, in squares.
#define LEAST_DETOUR 4e-3f

/// Each step of a path is 1 at least and is rounded by up to 2^-24 of its length: so two paths of
/// the length L are off by up to L * L * 2^-23.
#define ROUNDING 1.25e-7f

/// The ways on of 64 points.
typedef struct way_list {
    SL_ARRAY(way_on) ways;
} way_list;

/// Steps lead from points beside walls to points beside walls, and are numbered in the order of
/// the rows. The ways on after step k of bundle b: starts[k + b] to starts[k + b + 1].
typedef struct all_ways {
    const sli_vga_sights *sights;
    float detour;
    uint32_t *first_step; ///< by slot
    uint32_t *starts;
    way_list *lists; ///< by bundle
    sl_bits *listed; ///< slots whose steps have lists
} all_ways;

typedef struct entry {
    float key;
    uint32_t slot, before; ///< before: the slot of the path before it, or none
    uint32_t step;         ///< the number of its last step, or none
    uint32_t number;       ///< of the point
    uint32_t next;         ///< in its bucket, or none
} entry;

/// A turn that was computed.
typedef struct known_turn {
    uint32_t before, at;
    float turn;
} known_turn;

typedef struct walker {
    const sli_vga_sights *sights;
    const all_ways *ways; ///< NULL: all ways on are tried
    // By slot:
    float *length; ///< of its path so far, in squares; where `last` is none: no path is longer
    float *bound;
    float *hop;       ///< length of its path's last step
    float *turn;      ///< along its path, in right angles, once the path is final
    uint32_t *last;   ///< the slot of its path before it, or none
    uint32_t *before; ///< of those that were expanded: `before` of their entry
    known_turn *turns;
    uint32_t *buckets; ///< first entries; by length modulo their number
    uint32_t bucket_mask;
    SL_ARRAY(entry) entries;
    SL_ARRAY(entry) sorted;
    SL_ARRAY(uint32_t) order; ///< slots in the order of expansion
    size_t waiting;
    uint32_t old_from; ///< the start before, or none
} walker;

// --- buckets

/// There is room for the entry.
static inline void push_way(walker *w, entry e) {
    uint32_t *bucket = &w->buckets[(uint64_t)(e.key * PARTS) & w->bucket_mask];
    e.number = w->sights->points[e.slot];
    e.next = *bucket;
    *bucket = (uint32_t)w->entries.count;
    w->entries.items[w->entries.count++] = e;
    w->waiting++;
}

static bool is_before(const entry *a, const entry *b) {
    return a->key < b->key || (a->key == b->key && a->number < b->number);
}

static int compare_entries(const void *left, const void *right) {
    return is_before(right, left) - is_before(left, right);
}

/// Takes all entries of a bucket, sorted.
static sl_status take_bucket(sl_context *context, walker *w, uint64_t parts) {
    uint32_t *bucket = &w->buckets[parts & w->bucket_mask];
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

// --- paths

/// The turn of a path whose last step is known, and all before it.
static inline float turn_to(walker *w, uint32_t slot) {
    const uint32_t at = w->last[slot], before = w->before[at];
    if (before == SLI_VGA_NONE) return 0;
    known_turn *known = &w->turns[slot];
    if (known->at != at || known->before != before)
        *known =
            (known_turn){before, at, sli_vga_turn(sli_vga_cosine(w->sights, before, at, slot))};
    return w->turn[at] + known->turn;
}

/// Tries a way on. There is room for an entry. Single precision decides where it can: its sum is
/// off by less than 3e-7 of itself, and is never longer than that of a gain.
static inline void try_way(walker *w, const entry *at, way_on way) {
    const float old = w->length[way.slot], length = at->key + way.length;
    if (length > old) return;
    if (length * (1 + 3e-7f) >= old &&
        at->key + sli_vga_distance(w->sights, at->slot, way.slot) >= old)
        return;
    w->hop[way.slot] = way.length;
    w->length[way.slot] = length;
    w->last[way.slot] = at->slot;
    // A path that is shorter by less than a float tells is there already, with its way so far.
    if (length == old || way.slot >= w->sights->turning_count) return;
    push_way(w, (entry){.key = length, .slot = way.slot, .before = at->slot, .step = way.step});
}

/// Tries all ways on.
static sl_status expand_row(sl_context *context, walker *w, const entry *at) {
    const sli_vga_sights *s = w->sights;
    const float x = s->x[at->slot], y = s->y[at->slot];
    const bool numbered = w->ways && at->slot < s->turning_count;
    uint32_t step = numbered ? w->ways->first_step[at->slot] : SLI_VGA_NONE;
    for (size_t i = s->first[at->slot]; i < s->first[at->slot + 1]; i++) {
        const sli_vga_word *word = &s->words.items[i];
        SL_TRY(SL_ARRAY_ROOM(context, &w->entries, 64));
        for (uint64_t rest = word->seen; rest; rest &= rest - 1) {
            const uint32_t q = word->bundle * 64 + (uint32_t)__builtin_ctzll(rest);
            const float dx = s->x[q] - x, dy = s->y[q] - y, left = w->length[q] - at->key;
            if (left > 0 && (dx * dx + dy * dy) * (1 - 1e-6f) < left * left)
                try_way(w, at, (way_on){q, step, (float)sli_vga_distance(s, at->slot, q)});
            step += numbered && q < s->turning_count;
        }
    }
    return SL_OK;
}

static sl_status expand(sl_context *context, walker *w, const entry *at) {
    const all_ways *a = w->ways;
    if (at->step == SLI_VGA_NONE || !sl_bits_has(a->listed, at->before))
        return expand_row(context, w, at);
    const size_t bundle = at->before / 64;
    const uint32_t *starts = &a->starts[at->step + bundle];
    const way_on *ways = a->lists[bundle].ways.items; // NULL where there are none
    const uint32_t end = starts[1];
    SL_TRY(SL_ARRAY_ROOM(context, &w->entries, end - starts[0]));
    for (uint32_t i = starts[0]; i < end; i++) try_way(w, at, ways[i]);
    return SL_OK;
}

/// Bounds lengths by the paths from the start before, moved to the new one:
///
///       o--------- u ----- q
///     old         /            All but the first step is as before.
///       x--------'
///     new
static void find_bounds(walker *w, uint32_t from) {
    const sli_vga_sights *s = w->sights;
    float *bound = w->bound;
    const float slack = w->ways->detour;
    for (size_t i = s->first[from]; i < s->first[from + 1]; i++) {
        const sli_vga_word *word = &s->words.items[i];
        for (uint64_t rest = word->seen; rest; rest &= rest - 1) {
            const uint32_t q = word->bundle * 64 + (uint32_t)__builtin_ctzll(rest);
            bound[q] = (float)sli_vga_distance(s, from, q);
        }
    }
    for (size_t i = 0; i < w->order.count; i++) {
        const uint32_t q = w->order.items[i], at = w->last[q];
        if (at == SLI_VGA_NONE || at == w->old_from) continue;
        const float way = bound[at] + w->hop[q];
        bound[q] = way < bound[q] ? way : bound[q];
    }
    for (uint32_t q = 0; q < s->count; q++) {
        const uint32_t at = w->last[q];
        const float way =
            at == SLI_VGA_NONE || at == w->old_from ? INFINITY : bound[at] + w->hop[q];
        w->length[q] = (way < bound[q] ? way : bound[q]) + slack;
    }
}

static sl_status find_shortest(sl_context *context, walker *w, uint32_t from) {
    const sli_vga_job *j = w->sights->job;
    const double radius = j->options->metric_radius, step = j->grid->step;
    w->entries.count = 0;
    for (uint32_t q = 0; q < w->sights->count; q++) w->length[q] = w->bound[q] = INFINITY;
    if (w->ways && w->old_from != SLI_VGA_NONE) find_bounds(w, from);
    for (uint32_t q = 0; q < w->sights->count; q++) {
        w->turn[q] = INFINITY;
        w->last[q] = SLI_VGA_NONE;
    }
    w->order.count = 0;
    w->old_from = from;
    w->length[from] = w->turn[from] = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &w->entries, 1));
    push_way(w, (entry){.slot = from, .before = SLI_VGA_NONE, .step = SLI_VGA_NONE});
    bool within = true;
    for (uint64_t parts = 0; w->waiting; parts++) {
        if (w->buckets[parts & w->bucket_mask] == SLI_VGA_NONE) continue;
        SL_TRY(take_bucket(context, w, parts));
        SL_TRY(SL_ARRAY_ROOM(context, &w->order, w->sorted.count));
        for (size_t i = 0; i < w->sorted.count && within; i++) {
            const entry *e = &w->sorted.items[i];
            within = !(radius > 0 && e->key * step > radius);
            if (!within) break; // what waits is taken, and left
            w->order.items[w->order.count++] = e->slot;
            if (e->before != SLI_VGA_NONE) w->turn[e->slot] = turn_to(w, e->slot);
            SL_TRY(expand(context, w, e));
            w->before[e->slot] = e->before;
        }
    }
    for (uint32_t q = 0; q < w->sights->count; q++)
        if (w->last[q] == SLI_VGA_NONE && q != from) w->length[q] = INFINITY;
    return SL_OK;
}

/// The longest path. Points that are not reached count by their bounds.
static float longest_of(const walker *w) {
    float longest = 0;
    for (uint32_t q = 0; q < w->sights->count; q++) {
        const float length = w->length[q] < INFINITY ? w->length[q] : w->bound[q];
        if (length < INFINITY && length > longest) longest = length;
    }
    return longest;
}

/// Finds the shortest paths by the lists, or without them where rounding hides too much.
static sl_status find_paths(sl_context *context, walker *w, uint32_t from) {
    SL_TRY(find_shortest(context, w, from));
    const float longest = longest_of(w);
    const all_ways *ways = w->ways;
    if (!ways || longest * longest * ROUNDING <= ways->detour) return SL_OK;
    w->ways = NULL;
    const sl_status status = find_shortest(context, w, from);
    w->ways = ways;
    return status;
}

static sl_status measure(sl_context *context, void *state, uint32_t from) {
    walker *w = state;
    const sli_vga_sights *s = w->sights;
    const sl_vga_options *options = s->job->options;
    const double step = s->job->grid->step;
    double length = 0, turn = 0, straight = 0, nodes = 0;
    SL_TRY(find_paths(context, w, from));
    const double limit =
        options->metric_radius > 0 ? fmin(options->metric_radius, DBL_MAX) : DBL_MAX;
    for (uint32_t p = 0; p < s->count; p++) {
        const uint32_t slot = s->slots[p];
        if (w->length[slot] * step > limit) continue;
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

// --- walkers

static void walker_destroy(sl_context *context, walker *w) {
    void *parts[] = {w->length,      w->turn,    w->last,          w->before,
                     w->turns,       w->buckets, w->entries.items, w->sorted.items,
                     w->order.items, w->bound,   w->hop,           w};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) sl_free(context, parts[i]);
}

static sl_status walker_make(sl_context *context, const sli_vga_sights *s, const all_ways *ways,
                             walker **out) {
    const sl_vga_grid *grid = s->job->grid;
    const size_t slots = s->bundles * 64;
    walker *w = sl_alloc_array(context, 1, sizeof *w);
    if (!w) return SL_NO_MEMORY;
    w->sights = s;
    w->ways = ways;
    w->old_from = SLI_VGA_NONE;
    // No step is longer than columns and rows together, so that many lengths can wait at once.
    for (w->bucket_mask = 1; w->bucket_mask < PARTS * (grid->columns + grid->rows + 2);)
        w->bucket_mask = w->bucket_mask * 2 + 1;
    w->length = sl_alloc_array(context, slots, sizeof *w->length);
    w->bound = sl_alloc_array(context, slots, sizeof *w->bound);
    w->hop = sl_alloc_array(context, slots, sizeof *w->hop);
    w->turn = sl_alloc_array(context, slots, sizeof *w->turn);
    w->last = sl_alloc_array(context, slots, sizeof *w->last);
    w->before = sl_alloc_array(context, slots, sizeof *w->before);
    w->turns = sl_alloc_array(context, slots, sizeof *w->turns);
    w->buckets = sl_alloc_array(context, (size_t)w->bucket_mask + 1, sizeof *w->buckets);
    if (!w->length || !w->bound || !w->hop || !w->turn || !w->last || !w->before || !w->turns ||
        !w->buckets) {
        walker_destroy(context, w);
        return SL_NO_MEMORY;
    }
    memset(w->buckets, 0xff, ((size_t)w->bucket_mask + 1) * sizeof *w->buckets);
    *out = w;
    return SL_OK;
}

// --- the lists of ways on

static void end_lists(sl_context *context, void *all, void *state) {
    (void)all;
    sl_free(context, state);
}

static sl_status begin_lists(sl_context *context, void *all, void **state) {
    const all_ways *a = all;
    *state = sl_alloc_array(context, a->sights->bundles, 64 * sizeof(float) + sizeof(uint64_t));
    return *state ? SL_OK : SL_NO_MEMORY;
}

/// Lowers the lengths to what u sees, of the slots in `far`, by a second step from there.
static void step_from(const sli_vga_sights *s, uint32_t u, float hop, const uint64_t *far,
                      float *two) {
    const float x = s->x[u], y = s->y[u];
    for (size_t k = s->first[u]; k < s->first[u + 1]; k++) {
        const sli_vga_word *next = &s->words.items[k];
        for (uint64_t rest = next->seen & far[next->bundle]; rest; rest &= rest - 1) {
            const uint32_t q = next->bundle * 64 + (uint32_t)__builtin_ctzll(rest);
            const float dx = s->x[q] - x, dy = s->y[q] - y, left = two[q] - hop;
            const float square = dx * dx + dy * dy;
            if (left > 0 && square < left * left) two[q] = hop + sqrtf(square);
        }
    }
}

/// Finds the least length of one step or two from p, by slot. What p sees is nearest by one step.
/// `far`: scratch, for what p does not see.
static void find_two_steps(const sli_vga_sights *s, uint32_t p, float *two, uint64_t *far) {
    for (uint32_t q = 0; q < s->count; q++) two[q] = INFINITY;
    memset(far, 0xff, s->bundles * sizeof *far);
    two[p] = 0;
    for (size_t i = s->first[p]; i < s->first[p + 1]; i++) {
        const sli_vga_word *word = &s->words.items[i];
        far[word->bundle] &= ~word->seen;
        for (uint64_t rest = word->seen; rest; rest &= rest - 1) {
            const uint32_t q = word->bundle * 64 + (uint32_t)__builtin_ctzll(rest);
            two[q] = (float)sli_vga_distance(s, p, q);
        }
    }
    for (size_t i = s->first[p]; i < s->first[p + 1]; i++) {
        const sli_vga_word *word = &s->words.items[i];
        for (uint64_t rest = word->seen & s->turning[word->bundle]; rest; rest &= rest - 1) {
            const uint32_t u = word->bundle * 64 + (uint32_t)__builtin_ctzll(rest);
            step_from(s, u, (float)sli_vga_distance(s, p, u), far, two);
        }
    }
}

/// Lists the ways on from p by u.
static sl_status list_ways(sl_context *context, const all_ways *a, uint32_t p, uint32_t u,
                           const float *two, way_list *list) {
    const sli_vga_sights *s = a->sights;
    const float x = s->x[u], y = s->y[u], hop = (float)sli_vga_distance(s, p, u) - a->detour;
    uint32_t step = a->first_step[u];
    for (size_t k = s->first[u]; k < s->first[u + 1]; k++) {
        const sli_vga_word *word = &s->words.items[k];
        for (uint64_t rest = word->seen; rest; rest &= rest - 1) {
            const uint32_t q = word->bundle * 64 + (uint32_t)__builtin_ctzll(rest);
            const bool turns = sl_bits_has(s->turning, q);
            const float dx = s->x[q] - x, dy = s->y[q] - y, left = two[q] - hop;
            if (left > 0 && dx * dx + dy * dy <= left * left) {
                SL_TRY(SL_ARRAY_ROOM(context, &list->ways, 1));
                list->ways.items[list->ways.count++] =
                    (way_on){q, turns ? step : SLI_VGA_NONE, (float)sli_vga_distance(s, u, q)};
            }
            step += turns;
        }
    }
    return SL_OK;
}

static size_t count_reached(const sli_vga_sights *s, const float *two) {
    size_t count = 0;
    for (uint32_t q = 0; q < s->count; q++) count += two[q] < INFINITY;
    return count;
}

static size_t least(size_t a, size_t b) {
    return a < b ? a : b;
}

static sl_status list_unit(sl_context *context, void *all, void *state, size_t unit) {
    const all_ways *a = all;
    const sli_vga_sights *s = a->sights;
    const size_t room = s->kept_ways / s->bundles;
    float *two = state;
    size_t most = 0; // what the points so far may list
    way_list *list = &a->lists[unit];
    size_t start = 0; // place in `starts`
    for (uint32_t p = (uint32_t)unit * 64; p < s->count && p < unit * 64 + 64; p++) {
        if (!sl_bits_has(s->turning, p)) continue;
        SL_TRY(sl_check_cancelled(context));
        find_two_steps(s, p, two, (uint64_t *)(two + s->bundles * 64));
        most = least(most + SLI_VGA_WAYS_A_PAIR * count_reached(s, two), room);
        const size_t before = list->ways.count;
        start = a->first_step[p] + unit;
        for (size_t i = s->first[p]; i < s->first[p + 1]; i++) {
            const sli_vga_word *word = &s->words.items[i];
            for (uint64_t rest = word->seen & s->turning[word->bundle]; rest; rest &= rest - 1) {
                const uint32_t u = word->bundle * 64 + (uint32_t)__builtin_ctzll(rest);
                a->starts[start++] = (uint32_t)list->ways.count;
                if (list->ways.count <= most) SL_TRY(list_ways(context, a, p, u, two, list));
            }
        }
        a->starts[start] = (uint32_t)list->ways.count;
        if (list->ways.count > most) { // no room for these, nor for those after
            list->ways.count = before;
            break;
        }
        sl_bits_add(a->listed, p);
    }
    sli_shrink(context, &list->ways.items, &list->ways.capacity, list->ways.count,
               sizeof *list->ways.items);
    return SL_OK;
}

/// Numbers the steps. Returns how many there are, or NONE for too many.
static uint32_t number_steps(const sli_vga_sights *s, uint32_t *first_step) {
    uint64_t count = 0;
    for (uint32_t slot = 0; slot < s->count; slot++) {
        first_step[slot] = (uint32_t)count;
        if (!sl_bits_has(s->turning, slot)) continue;
        for (size_t i = s->first[slot]; i < s->first[slot + 1]; i++)
            count += (uint64_t)__builtin_popcountll(s->words.items[i].seen &
                                                    s->turning[s->words.items[i].bundle]);
        if (count + s->bundles >= SLI_VGA_NONE) return SLI_VGA_NONE;
    }
    return (uint32_t)count;
}

static void ways_destroy(sl_context *context, all_ways *a) {
    for (size_t b = 0; a->lists && b < a->sights->bundles; b++)
        sl_free(context, a->lists[b].ways.items);
    sl_free(context, a->lists);
    sl_free(context, a->starts);
    sl_free(context, a->first_step);
    sl_free(context, a->listed);
}

/// A search from the first point shows about how long paths are.
static sl_status choose_detour(sl_context *context, all_ways *a) {
    walker *w;
    SL_TRY(walker_make(context, a->sights, NULL, &w));
    const sl_status status = find_shortest(context, w, 0);
    const float longest = status == SL_OK ? 2 * longest_of(w) : 0;
    a->detour = fmaxf(LEAST_DETOUR, longest * longest * ROUNDING);
    walker_destroy(context, w);
    return status;
}

static sl_status ways_make(sl_context *context, const sli_vga_sights *s, all_ways *a) {
    *a = (all_ways){.sights = s};
    a->first_step = sl_alloc_array(context, s->count + 1, sizeof *a->first_step);
    a->lists = sl_alloc_array(context, s->bundles + 1, sizeof *a->lists);
    a->listed = sl_alloc_array(context, s->bundles + 1, sizeof *a->listed);
    if (!a->first_step || !a->lists || !a->listed) return SL_NO_MEMORY;
    const uint32_t steps = number_steps(s, a->first_step);
    if (!s->count || steps == SLI_VGA_NONE) return SL_OK; // all rows are tried whole
    a->starts = sl_alloc_array(context, (size_t)steps + s->bundles + 1, sizeof *a->starts);
    if (!a->starts) return SL_NO_MEMORY;
    SL_TRY(choose_detour(context, a));
    const sl_work work = {.job = a,
                          .begin = begin_lists,
                          .unit = list_unit,
                          .end = end_lists,
                          .stage = "ways of two steps",
                          .units = "bundles of points"};
    return sl_work_run(context, &work, s->bundles, s->job->options->threads);
}

// --- all points

static void end_metric_search(sl_context *context, void *state) {
    walker_destroy(context, state);
}

static sl_status begin_metric_search(sl_context *context, const sli_vga_searches *searches,
                                     void **state) {
    walker *w;
    SL_TRY(walker_make(context, searches->sights, searches->shared, &w));
    *state = w;
    return SL_OK;
}

sl_status sli_vga_measure_metric(sl_context *context, const sli_vga_sights *sights) {
    all_ways ways;
    const sli_vga_searches searches = {
        sights, &ways, begin_metric_search, measure, end_metric_search, "shortest paths"};
    sl_status status = ways_make(context, sights, &ways);
    if (status == SL_OK) status = sli_vga_search_all(context, &searches);
    ways_destroy(context, &ways);
    return status;
}

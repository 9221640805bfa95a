/// Global measures of a visibility graph: of the numbers of steps from each point to all others, by
/// the formulas of depthmapX (vgavisualglobal.cpp of its salalib), after Turner et al. 2001 and
/// Hillier and Hanson 1984.
///
/// One search serves a group: up to 64 points of a bundle (tiles.h) that all see each other. So
/// their depths of a point q differ by 1 at most. The search finds the least depth of q among the
/// group, level by level, and its mask: which of the group have this depth. For the rest it is one
/// more.
///
///      level d - 1      level d      A point that sees one with a full mask has a full mask. Words
///      u: s t . .       q: s t v     of 64 points say so at once. Few points are left: they join
///      w: . t v .                    the masks of the points of the level before that they see.
///
/// Invariant: a point of the group has depth d of q if it has depth d - 1 of a point that q sees,
/// and that point is of the level before: else q would be nearer.
///
/// A level is found from whichever side has fewer tiles (Beamer, Asanovic and Patterson 2012,
/// Direction-optimizing breadth-first search): from the level before, or from the points that are
/// left. Most of these find one they see after a few tiles. A search ends as soon as all points are
/// found that the search before found. So the last level, often most of the plan, is never taken
/// on.
///
/// A search with a radius ends early, and then touches few of many bundles: a set of the bundles of
/// a level leads to its words, so that no search passes over the whole plan.
///
/// All of this needs sight that is mutual. In a directed graph, each point is a group of its own,
/// and levels are found from the level before.
///
/// Cost: for a group, the tiles of bundles that one of the two sides has, a few spans of some, and
/// the spans of points whose masks are not full. Most bundles are a group, so that is about a 64th
/// of a search from each point. Memory: a word for each point and thread.
#include "analysis/visibility_graph/graph_measures.h"
#include "analysis/visibility_graph/integration.h"
#include "analysis/visibility_graph/tiles.h"

#include <math.h>
#include <string.h>

/// What the threads share.
typedef struct global_job {
    const sli_vga_job *all;
    const sli_vga_tiles *tiles;
    uint32_t most; ///< steps of a search; 0: no limit
} global_job;

typedef struct searcher {
    sl_bits *seen;
    sl_bits *reach; ///< all that the search before found, if it found all that steps lead to
    sl_bits *full, *partial; ///< the points of a level whose masks are full, and the others
    sl_bits *next, *next_full;
    sl_bits *level, *next_level; ///< the bundles of these
    sl_bits *touched;            ///< bundles of all levels; outside, the sets above are empty
    uint64_t *masks; ///< by slot, where it is partial: the points of the group, by place
    uint64_t *any;   ///< by bundle: the masks of its partial points together
    // Numbers of points by depth; the last entry holds all that are deeper.
    int64_t common[SLI_VGA_DEPTHS];  ///< the same for all of the group
    int64_t own[SLI_VGA_DEPTHS][64]; ///< by place: to be added
    int64_t sum[SLI_VGA_DEPTHS];     ///< of both, for one place
    uint64_t digits[32]; ///< numbers of points by place, of a level: digit k of all 64 of them
    uint32_t deepest;
} searcher;

// --- numbers of points

static size_t entry_of(uint64_t depth) {
    return depth < SLI_VGA_DEPTHS ? (size_t)depth : SLI_VGA_DEPTHS - 1;
}

/// Counts a point for the places of its mask: adds 1 to 64 numbers at once, digit by digit.
static void add_mask(searcher *s, uint64_t mask) {
    for (size_t k = 0; mask; k++) {
        const uint64_t carry = s->digits[k] & mask;
        s->digits[k] ^= mask;
        mask = carry;
    }
}

/// Takes what add_mask() has counted: points of this depth for some, and one more for the rest.
/// `points`: how many masks there were.
static void add_partial(searcher *s, uint64_t depth, int64_t points) {
    int64_t *near = s->own[entry_of(depth)], *far = s->own[entry_of(depth + 1)];
    s->common[entry_of(depth + 1)] += points;
    for (size_t k = 0; k < sizeof s->digits / sizeof *s->digits; k++) {
        for (uint64_t rest = s->digits[k]; rest; rest &= rest - 1) {
            const int place = __builtin_ctzll(rest);
            near[place] += (int64_t)1 << k;
            far[place] -= (int64_t)1 << k;
        }
        s->digits[k] = 0;
    }
}

static void clear_counts(searcher *s) {
    memset(s->common, 0, ((size_t)s->deepest + 1) * sizeof *s->common);
    memset(s->own, 0, ((size_t)s->deepest + 1) * sizeof *s->own);
}

// --- a group

uint64_t sli_vga_choose_group(const sli_vga_job *job, const sli_vga_tiles *t, size_t bundle,
                              uint64_t places) {
    const sli_vga_bundle *of = &t->of[bundle];
    uint64_t group = places & -places, rest = places;
    uint32_t i = 0;
    while (i < of->count && of->tiles[i].bundle != bundle) i++;
    if (i == of->count || job->graph->directed) return group;
    for (uint64_t next = group; next; next = rest & -rest) {
        group |= next;
        rest &= sli_vga_tile_row(of, &of->tiles[i], (unsigned)__builtin_ctzll(next));
    }
    return group;
}

/// Empties the sets of the search before.
static void clear_search(const sli_vga_tiles *t, searcher *s) {
    size_t b = 0;
    for (; (b = sli_bits_next(s->touched, t->bundles, b, true)) < t->bundles; b++)
        s->seen[b] = s->full[b] = s->partial[b] = s->next[b] = s->next_full[b] = 0;
    const size_t bytes = sl_bits_words(t->bundles) * sizeof *s->touched;
    memset(s->touched, 0, bytes);
    memset(s->level, 0, bytes);
    memset(s->next_level, 0, bytes);
}

/// The first level: what the group sees.
static void see_first(const sli_vga_tiles *t, searcher *s, size_t bundle, uint64_t group) {
    const sli_vga_bundle *of = &t->of[bundle];
    clear_search(t, s);
    for (uint32_t i = 0; i < of->count; i++) {
        const sli_vga_tile *tile = &of->tiles[i];
        const uint32_t b = tile->bundle;
        uint64_t all = UINT64_MAX, some = 0, blind = group;
        for (sli_vga_span span = sli_vga_spans(of, tile); sli_vga_next_span(&span);) {
            if (!(span.places & group)) continue;
            all &= span.seen;
            some |= span.seen;
            blind &= ~span.places;
        }
        if (blind) all = 0;
        if (b == bundle) some &= ~group;
        s->full[b] = all & some;
        s->partial[b] = some & ~all;
        s->seen[b] = some;
        sl_bits_add(s->level, b);
        sl_bits_add(s->touched, b);
        for (uint64_t left = s->partial[b]; left; left &= left - 1)
            s->masks[(size_t)b * 64 + (size_t)__builtin_ctzll(left)] = 0;
        for (sli_vga_span span = sli_vga_spans(of, tile); sli_vga_next_span(&span);)
            for (uint64_t left = span.places & group ? span.seen & s->partial[b] : 0; left;
                 left &= left - 1)
                s->masks[(size_t)b * 64 + (size_t)__builtin_ctzll(left)] |= span.places & group;
    }
    s->seen[bundle] |= group;
    sl_bits_add(s->touched, bundle);
}

/// What all of these points have in their masks.
static uint64_t common_mask(const uint64_t *masks, uint64_t points) {
    uint64_t common = UINT64_MAX;
    for (; points; points &= points - 1) common &= masks[__builtin_ctzll(points)];
    return common;
}

/// Adds to masks of a bundle what its points see in one tile. Returns those that have become full.
static uint64_t join_tile(const sli_vga_bundle *of, const sli_vga_tile *tile, const searcher *s,
                          uint64_t *masks, uint64_t points, uint64_t group) {
    const uint64_t *sources = s->masks + (size_t)tile->bundle * 64;
    const uint64_t from = tile->any & s->partial[tile->bundle], any = s->any[tile->bundle];
    uint64_t full = 0;
    for (sli_vga_span span = sli_vga_spans(of, tile); sli_vga_next_span(&span);) {
        uint64_t seen = span.seen & from, rest = span.places & points;
        if (!seen || !rest) continue;
        const uint64_t gain = any & ~common_mask(masks, rest);
        uint64_t joined = 0;
        for (; seen && gain & ~joined; seen &= seen - 1) joined |= sources[__builtin_ctzll(seen)];
        for (; rest && joined; rest &= rest - 1) {
            uint64_t *mask = &masks[__builtin_ctzll(rest)];
            *mask |= joined;
            if (*mask == group) full |= rest & -rest;
        }
    }
    return full;
}

/// Finds the masks of points of a bundle that see no point with a full mask. Returns those that are
/// full nevertheless; masks of 0 are of points that see none.
static uint64_t join_masks(const sli_vga_tiles *t, searcher *s, size_t bundle, uint64_t points,
                           uint64_t group) {
    const sli_vga_bundle *of = &t->of[bundle];
    uint64_t *masks = s->masks + bundle * 64, full = 0, common = 0;
    for (uint64_t rest = points; rest; rest &= rest - 1) masks[__builtin_ctzll(rest)] = 0;
    for (uint32_t i = 0; i < of->count && points; i++) {
        const sli_vga_tile *tile = &of->tiles[i];
        if (!(tile->any & s->partial[tile->bundle]) || !(s->any[tile->bundle] & ~common)) continue;
        full |= join_tile(of, tile, s, masks, points, group);
        points &= ~full;
        common = common_mask(masks, points);
    }
    return full;
}

/// Counts a level, and joins the masks of its partial points by bundle. False if it is empty.
static bool count_level(const sli_vga_tiles *t, searcher *s, uint64_t depth) {
    int64_t full = 0, partial = 0;
    for (size_t b = 0; (b = sli_bits_next(s->level, t->bundles, b, true)) < t->bundles; b++) {
        full += sli_word_count(s->full[b]);
        if (!s->partial[b]) continue;
        s->any[b] = 0;
        for (uint64_t rest = s->partial[b]; rest; rest &= rest - 1) {
            const uint64_t mask = s->masks[b * 64 + (size_t)__builtin_ctzll(rest)];
            s->any[b] |= mask;
            add_mask(s, mask);
            partial++;
        }
    }
    s->common[entry_of(depth)] += full;
    if (partial) add_partial(s, depth, partial);
    return full || partial;
}

/// Finds the next level from this one: the points that it sees.
static void push_level(const sli_vga_tiles *t, searcher *s, uint64_t group) {
    size_t b = 0;
    sli_vga_tiles_step(t, s->level, s->full, s->seen, s->next, s->next_level);
    for (; (b = sli_bits_next(s->next_level, t->bundles, b, true)) < t->bundles; b++)
        s->next_full[b] = s->next[b];
    sli_vga_tiles_step(t, s->level, s->partial, s->seen, s->next, s->next_level);
    for (b = 0; (b = sli_bits_next(s->next_level, t->bundles, b, true)) < t->bundles; b++) {
        const uint64_t left = s->next[b] & ~s->next_full[b];
        if (left) s->next_full[b] |= join_masks(t, s, b, left, group);
        s->next[b] &= ~s->next_full[b];
    }
}

/// Points of a bundle that see one with a full mask.
static uint64_t see_full(const sli_vga_bundle *of, const searcher *s, uint64_t points) {
    uint64_t found = 0;
    for (uint32_t i = 0; i < of->count && found != points; i++) {
        const sli_vga_tile *tile = &of->tiles[i];
        const uint64_t seen = tile->any & s->full[tile->bundle];
        if (!seen) continue;
        for (sli_vga_span span = sli_vga_spans(of, tile); sli_vga_next_span(&span);)
            if (span.seen & seen) found |= span.places & points;
    }
    return found;
}

/// Finds the next level from the points that are left: those that see one of this level.
static void pull_level(const sli_vga_tiles *t, searcher *s, uint64_t group) {
    for (size_t b = 0; b < t->bundles; b++) {
        uint64_t left = s->reach[b] & ~s->seen[b];
        s->next_full[b] = left ? see_full(&t->of[b], s, left) : 0;
        left &= ~s->next_full[b];
        if (left) s->next_full[b] |= join_masks(t, s, b, left, group);
        s->next[b] = 0;
        for (left &= ~s->next_full[b]; left; left &= left - 1)
            if (s->masks[b * 64 + (size_t)__builtin_ctzll(left)]) s->next[b] |= left & -left;
        if (s->next[b] | s->next_full[b]) sl_bits_add(s->next_level, b);
    }
}

/// Whether fewer tiles lead from the points that are left than from the level.
static bool is_pulled(const sli_vga_tiles *t, const searcher *s) {
    uint64_t pushed = 0, pulled = 0;
    for (size_t b = 0; b < t->bundles; b++) {
        if (s->full[b] | s->partial[b]) pushed += t->of[b].count;
        if (s->reach[b] & ~s->seen[b]) pulled += t->of[b].count;
    }
    return pulled < pushed;
}

/// `reaches`: s->reach is known.
static void next_level(const sli_vga_tiles *t, searcher *s, uint64_t group, bool reaches) {
    if (reaches && is_pulled(t, s))
        pull_level(t, s, group);
    else
        push_level(t, s, group);
    size_t b = 0;
    for (; (b = sli_bits_next(s->level, t->bundles, b, true)) < t->bundles; b++)
        s->full[b] = s->partial[b] = 0;
    for (b = 0; (b = sli_bits_next(s->next_level, t->bundles, b, true)) < t->bundles; b++)
        s->seen[b] |= s->next[b] | s->next_full[b];
    const size_t words = sl_bits_words(t->bundles);
    for (size_t w = 0; w < words; w++) s->touched[w] |= s->next_level[w];
    memset(s->level, 0, words * sizeof *s->level);
    sli_swap_sets(&s->full, &s->next_full);
    sli_swap_sets(&s->partial, &s->next);
    sli_swap_sets(&s->level, &s->next_level);
}

/// Counts points by depth for a group. Entries are valid up to `deepest`.
static void search(const global_job *g, searcher *s, size_t bundle, uint64_t group) {
    const sli_vga_tiles *t = g->tiles;
    const size_t bytes = t->bundles * sizeof *s->seen;
    const bool reaches = !g->all->graph->directed && s->reach[bundle] & group;
    uint64_t depth = 1;
    bool more = true;
    see_first(t, s, bundle, group);
    s->common[0] = 1;
    s->common[1] = sli_word_count(group) - 1;
    while (more && (more = count_level(t, s, depth)) && depth != g->most) {
        more = !reaches || memcmp(s->seen, s->reach, bytes) != 0;
        if (more) next_level(t, s, group, reaches);
        depth++;
    }
    if (!more && !reaches) memcpy(s->reach, s->seen, bytes);
    s->deepest = (uint32_t)(depth + 1 < SLI_VGA_DEPTHS ? depth + 1 : SLI_VGA_DEPTHS - 1);
}

// --- measures

#define LOG2_E 1.4426950408889634

/// Of numbers of points by depth, up to the deepest.
static void measure_depths(const int64_t *points, uint32_t deepest, sl_vga_measures *out) {
    double nodes = 0, total = 0;
    for (uint32_t k = 0; k <= deepest; k++) {
        nodes += (double)points[k];
        total += (double)k * (double)points[k];
    }
    out->visual_node_count = nodes;
    if (nodes < 2) return;
    const double mean = total / (nodes - 1);
    out->visual_mean_depth = mean;
    const sli_integration integration = sli_integration_of(nodes, total);
    out->visual_integration_hh = integration.hh;
    out->visual_integration_pvalue = integration.pvalue;
    out->visual_integration_tekl = integration.tekl;
    // Poisson's share at the depth k is mean^k / (k + 1)! e^-mean. As a logarithm, because powers
    // and factorials overflow where points are 170 steps deep.
    double entropy = 0, relative = 0, expected = -mean * LOG2_E;
    for (uint32_t k = 1; k <= deepest; k++) {
        if (!points[k]) continue;
        const double share = (double)points[k] / (nodes - 1);
        entropy -= share * log2(share);
        expected += log2(mean / (double)(k + 1));
        relative += share * (log2(share) - expected);
    }
    out->visual_entropy = entropy;
    out->visual_relativised_entropy = relative;
}

static void measure_group(const global_job *g, searcher *s, size_t bundle, uint64_t group) {
    const sl_vga_options *options = g->all->options;
    search(g, s, bundle, group);
    const uint32_t deepest =
        options->radius && options->radius < s->deepest ? options->radius : s->deepest;
    for (uint64_t rest = group; rest; rest &= rest - 1) {
        const size_t place = (size_t)__builtin_ctzll(rest);
        const uint32_t point = g->tiles->points[bundle * 64 + place];
        if (g->all->second) g->all->second[point] = (uint32_t)(s->common[2] + s->own[2][place]);
        if (!(options->parts & SL_VGA_GLOBAL)) continue;
        for (uint32_t k = 0; k <= deepest; k++) s->sum[k] = s->common[k] + s->own[k][place];
        measure_depths(s->sum, deepest, &g->all->measures[point]);
    }
    clear_counts(s);
}

// --- all points

static void end_global_worker(sl_context *context, void *all, void *state) {
    (void)all;
    searcher *s = state;
    void *parts[] = {s->seen, s->full,  s->partial, s->next,       s->next_full, s->masks,
                     s->any,  s->reach, s->level,   s->next_level, s->touched,   s};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) sl_free(context, parts[i]);
}

static sl_status begin_global_worker(sl_context *context, void *all, void **state) {
    const size_t words = ((const global_job *)all)->tiles->bundles;
    searcher *s = sl_alloc_array(context, 1, sizeof *s);
    if (!s) return SL_NO_MEMORY;
    s->masks = sl_alloc_array(context, words * 64, sizeof *s->masks);
    bool room = s->masks != NULL;
    uint64_t **sets[] = {&s->seen, &s->full,  &s->partial, &s->next,       &s->next_full,
                         &s->any,  &s->reach, &s->level,   &s->next_level, &s->touched};
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++)
        room &= (*sets[i] = sl_alloc_array(context, words, sizeof **sets[i])) != NULL;
    if (!room) {
        end_global_worker(context, all, s);
        return SL_NO_MEMORY;
    }
    *state = s;
    return SL_OK;
}

static sl_status measure_unit(sl_context *context, void *all, void *state, size_t unit) {
    const global_job *g = all;
    uint64_t places = sli_vga_places(g->all, g->tiles, unit);
    while (places) {
        const uint64_t group = sli_vga_choose_group(g->all, g->tiles, unit, places);
        SL_TRY(sl_check_cancelled(context));
        measure_group(g, state, unit, group);
        places &= ~group;
    }
    return SL_OK;
}

sl_status sli_vga_measure_global(sl_context *context, const sli_vga_job *job,
                                 const sli_vga_tiles *tiles) {
    const sl_vga_options *options = job->options;
    global_job mine = {job, tiles, options->parts & SL_VGA_GLOBAL ? options->radius : 2};
    if (job->second && mine.most == 1) mine.most = 2;
    const sl_work work = {.job = &mine,
                          .begin = begin_global_worker,
                          .unit = measure_unit,
                          .end = end_global_worker,
                          .stage = "depths",
                          .units = "bundles of points"};
    return sl_work_run(context, &work, tiles->bundles, options->threads);
}

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
/// The masks need points that see each other. Where one-way glass makes exceptions, each point is
/// a group of its own.
///
/// Cost: for a group, the tiles of all bundles, a few rows of some, and the rows of points whose
/// masks are not full. Most bundles are a group, so that is about a 64th of a search from each
/// point. Memory: a word for each point and thread.
#include "analysis/visibility_graph/graph_measures.h"
#include "analysis/visibility_graph/integration.h"
#include "analysis/visibility_graph/tiles.h"

#include <math.h>
#include <string.h>

/// What the threads share.
typedef struct global_job {
    const sli_vga_job *all;
    const sli_vga_tiles *tiles;
    bool mutual;
} global_job;

typedef struct searcher {
    sl_bits *seen;
    sl_bits *full, *partial; ///< the points of a level whose masks are full, and the others
    sl_bits *next, *next_full;
    uint64_t *masks; ///< by slot, where it is partial: the points of the group, by place
    uint64_t *any;   ///< by bundle: the masks of its partial points together
    // Numbers of points by depth; the last entry holds all that are deeper.
    int64_t common[SLI_VGA_DEPTHS];  ///< the same for all of the group
    int64_t own[64][SLI_VGA_DEPTHS]; ///< by place: to be added
    uint32_t deepest;
} searcher;

// --- numbers of points

static void add_depth(searcher *s, uint64_t depth, int64_t points) {
    s->common[depth < SLI_VGA_DEPTHS ? depth : SLI_VGA_DEPTHS - 1] += points;
}

/// Counts a point that has this depth for those of the mask, and one more for the rest.
static void add_partial(searcher *s, uint64_t depth, uint64_t mask) {
    const size_t near = (size_t)(depth < SLI_VGA_DEPTHS ? depth : SLI_VGA_DEPTHS - 1);
    const size_t far = near + 1 < SLI_VGA_DEPTHS ? near + 1 : SLI_VGA_DEPTHS - 1;
    s->common[far]++;
    for (; mask; mask &= mask - 1) {
        int64_t *own = s->own[__builtin_ctzll(mask)];
        own[near]++;
        own[far]--;
    }
}

static void clear_counts(searcher *s, uint64_t group) {
    const size_t bytes = ((size_t)s->deepest + 1) * sizeof *s->common;
    memset(s->common, 0, bytes);
    for (; group; group &= group - 1) memset(s->own[__builtin_ctzll(group)], 0, bytes);
}

// --- a group

/// Points of a bundle that all see each other: the first one and others, by place.
static uint64_t choose_group(const sli_vga_tiles *t, size_t bundle, uint64_t places) {
    const uint64_t *rows = NULL;
    for (size_t i = t->first[bundle]; i < t->first[bundle + 1]; i++)
        if (t->tiles.items[i].bundle == bundle) rows = t->rows.items[i].rows;
    uint64_t group = places & -places;
    if (!rows) return group;
    uint64_t rest = places & rows[__builtin_ctzll(group)];
    while (rest) {
        group |= rest & -rest;
        rest &= rows[__builtin_ctzll(rest)];
    }
    return group;
}

/// The first level: what the group sees.
static void see_first(const sli_vga_tiles *t, searcher *s, size_t bundle, uint64_t group) {
    memset(s->seen, 0, t->bundles * sizeof *s->seen);
    memset(s->full, 0, t->bundles * sizeof *s->full);
    memset(s->partial, 0, t->bundles * sizeof *s->partial);
    for (size_t i = t->first[bundle]; i < t->first[bundle + 1]; i++) {
        const uint64_t *rows = t->rows.items[i].rows;
        const uint32_t b = t->tiles.items[i].bundle;
        uint64_t all = UINT64_MAX, some = 0;
        for (uint64_t rest = group; rest; rest &= rest - 1) {
            all &= rows[__builtin_ctzll(rest)];
            some |= rows[__builtin_ctzll(rest)];
        }
        if (b == bundle) some &= ~group;
        s->full[b] = all;
        s->partial[b] = some & ~all;
        s->seen[b] = some;
        for (uint64_t left = s->partial[b]; left; left &= left - 1) {
            const int q = __builtin_ctzll(left);
            uint64_t mask = 0;
            for (uint64_t rest = group; rest; rest &= rest - 1)
                if (rows[__builtin_ctzll(rest)] >> q & 1) mask |= rest & -rest;
            s->masks[(size_t)b * 64 + (size_t)q] = mask;
        }
    }
    s->seen[bundle] |= group;
}

/// The masks of the points of a bundle that see no point with a full mask. Returns those that are
/// full nevertheless.
static uint64_t join_masks(const sli_vga_tiles *t, searcher *s, size_t bundle, uint64_t points,
                           uint64_t group) {
    uint64_t *masks = s->masks + bundle * 64, full = 0;
    for (uint64_t rest = points; rest; rest &= rest - 1) masks[__builtin_ctzll(rest)] = 0;
    for (size_t i = t->first[bundle]; i < t->first[bundle + 1] && points; i++) {
        const sli_vga_tile *tile = &t->tiles.items[i];
        const uint64_t from = tile->any & s->partial[tile->bundle];
        if (!from) continue;
        for (uint64_t rest = points; rest; rest &= rest - 1) {
            uint64_t *mask = &masks[__builtin_ctzll(rest)];
            if (!(s->any[tile->bundle] & ~*mask)) continue;
            uint64_t sources = t->rows.items[i].rows[__builtin_ctzll(rest)] & from;
            for (; sources; sources &= sources - 1)
                *mask |= s->masks[(size_t)tile->bundle * 64 + (size_t)__builtin_ctzll(sources)];
            if (*mask != group) continue;
            full |= rest & -rest;
            points &= ~(rest & -rest);
        }
    }
    return full;
}

/// Counts a level, and joins the masks of its partial points by bundle. False if it is empty.
static bool count_level(const sli_vga_tiles *t, searcher *s, uint64_t depth) {
    uint64_t full = 0;
    bool partial = false;
    for (size_t b = 0; b < t->bundles; b++) {
        full += (uint64_t)__builtin_popcountll(s->full[b]);
        if (!s->partial[b]) continue;
        s->any[b] = 0;
        for (uint64_t rest = s->partial[b]; rest; rest &= rest - 1) {
            const uint64_t mask = s->masks[b * 64 + (size_t)__builtin_ctzll(rest)];
            s->any[b] |= mask;
            add_partial(s, depth, mask);
        }
        partial = true;
    }
    add_depth(s, depth, (int64_t)full);
    return full || partial;
}

static void next_level(const sli_vga_tiles *t, searcher *s, uint64_t group) {
    const size_t bytes = t->bundles * sizeof *s->next;
    memset(s->next, 0, bytes);
    sli_vga_tiles_step(t, s->full, s->seen, s->next);
    memcpy(s->next_full, s->next, bytes);
    sli_vga_tiles_step(t, s->partial, s->seen, s->next);
    for (size_t b = 0; b < t->bundles; b++) {
        const uint64_t left = s->next[b] & ~s->next_full[b];
        if (left) s->next_full[b] |= join_masks(t, s, b, left, group);
        s->next[b] &= ~s->next_full[b];
        s->seen[b] |= s->next[b] | s->next_full[b];
    }
    sl_bits *swap = s->full;
    s->full = s->next_full;
    s->next_full = swap;
    swap = s->partial;
    s->partial = s->next;
    s->next = swap;
}

/// Counts points by depth for a group. Entries are valid up to `deepest`.
static void search(const sli_vga_tiles *t, searcher *s, size_t bundle, uint64_t group,
                   uint32_t radius) {
    uint64_t depth = 1;
    see_first(t, s, bundle, group);
    add_depth(s, 0, 1);
    add_depth(s, 1, __builtin_popcountll(group) - 1);
    for (; count_level(t, s, depth) && depth != radius; depth++) next_level(t, s, group);
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
    const uint32_t radius = g->all->options->radius;
    search(g->tiles, s, bundle, group, radius);
    const uint32_t deepest = radius && radius < s->deepest ? radius : s->deepest;
    for (uint64_t rest = group; rest; rest &= rest - 1) {
        const size_t place = (size_t)__builtin_ctzll(rest);
        int64_t *own = s->own[place];
        for (uint32_t k = 0; k <= deepest; k++) own[k] += s->common[k];
        measure_depths(own, deepest, &g->all->measures[g->tiles->points[bundle * 64 + place]]);
    }
    clear_counts(s, group);
}

// --- all points

static void end_global_worker(sl_context *context, void *all, void *state) {
    (void)all;
    searcher *s = state;
    void *parts[] = {s->seen, s->full, s->partial, s->next, s->next_full, s->masks, s->any, s};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) sl_free(context, parts[i]);
}

static sl_status begin_global_worker(sl_context *context, void *all, void **state) {
    const size_t words = ((const global_job *)all)->tiles->bundles;
    searcher *s = sl_alloc_array(context, 1, sizeof *s);
    if (!s) return SL_NO_MEMORY;
    s->masks = sl_alloc_array(context, words * 64, sizeof *s->masks);
    bool room = s->masks != NULL;
    uint64_t **sets[] = {&s->seen, &s->full, &s->partial, &s->next, &s->next_full, &s->any};
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
    const size_t left = g->tiles->count - unit * 64;
    uint64_t places = left < 64 ? ((uint64_t)1 << left) - 1 : UINT64_MAX;
    while (places) {
        const uint64_t group = g->mutual ? choose_group(g->tiles, unit, places) : places & -places;
        SL_TRY(sl_check_cancelled(context));
        measure_group(g, state, unit, group);
        places &= ~group;
    }
    return SL_OK;
}

/// Whether all that a point sees sees it. One-way glass makes exceptions.
static bool is_mutual(const sli_vga_job *j) {
    uint64_t pairs = 0, all = 0;
    for (uint32_t p = 0; p < j->graph->count; p++) {
        const sl_bits *row = sli_vga_row(j->graph, p);
        all += j->degree[p];
        for (size_t w = p / 64; w < j->graph->words; w++) {
            for (sl_bits rest = row[w]; rest; rest &= rest - 1) {
                const uint32_t q = (uint32_t)(w * 64) + (uint32_t)__builtin_ctzll(rest);
                if (q < p) continue;
                if (!sl_bits_has(sli_vga_row(j->graph, q), p)) return false;
                pairs++;
            }
        }
    }
    return all == 2 * pairs;
}

sl_status sli_vga_measure_global(sl_context *context, const sli_vga_job *job,
                                 const sli_vga_tiles *tiles) {
    global_job mine = {job, tiles, is_mutual(job)};
    const sl_work work = {.job = &mine,
                          .begin = begin_global_worker,
                          .unit = measure_unit,
                          .end = end_global_worker,
                          .stage = "depths",
                          .units = "bundles of points"};
    return sl_work_run(context, &work, tiles->bundles, job->options->threads);
}

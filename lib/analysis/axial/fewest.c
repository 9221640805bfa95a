/// Fewer axial lines: a subset of the all-line map that still covers the plan.
///
/// A line covers the probes that it crosses from side to side. Probes are the walls' own lines,
/// extended into the open: where one crosses them, one passes from one convex room to the next
/// (Peponis, Wineman, Bafna, Rashid and Kim 1998). Turner, Penn and Hillier (2005) drop lines in
/// two ways:
///
/// 1. Subsets: a line goes where a longer line covers all that it covers.
/// 2. Fewest: a line goes where all that it covers is covered by others, the shortest line first.
///
/// Lines that go must not tear the others apart: two lines that one line joins stay joined. So each
/// part of the plan keeps a line, also a convex room, which has no probes.
///
/// A line that covers all that another one covers covers its first probe. So it stands in that
/// probe's list of lines that stay.
///
/// Invariant: each probe that was covered stays covered. Cost: O(n * probes beside its extent in x)
/// for n lines, n times the list of a probe * probes / 64, and a search of the network for each
/// line that stays.
#include "geometry/length.h"
#include "sightline/axial.h"

#include "analysis/axial/touch.h"
#include "base/bits.h"
#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct chooser {
    const sl_axial_lines *all;
    size_t words;
    sl_bits *covers;  ///< by line: a set of probes
    uint32_t *order;  ///< of lines: the longest first
    bool *kept;       ///< by line
    uint32_t *stamps; ///< by line: which search came by
    uint32_t *stay;   ///< lines that are kept
    uint32_t stay_count;
    SL_ARRAY(uint32_t) queue;
} chooser;

static void keep(chooser *c, uint32_t line) {
    c->kept[line] = true;
    c->stay[c->stay_count++] = line;
}

/// Equally long lines: the one that covers more is before. Both stay the same if a plan is turned
/// or mirrored. Lines that are equal in both come by their place, so which of them stays may change
/// with a turn. A plan that is its own mirror image has such lines, and none is the better one.
typedef struct ranked {
    double length;
    uint32_t covers;
    uint32_t line;
} ranked;

static int compare_ranks(const void *left, const void *right) {
    const ranked *a = left, *b = right;
    if (a->length != b->length) return a->length > b->length ? -1 : 1;
    if (a->covers != b->covers) return a->covers > b->covers ? -1 : 1;
    return (a->line > b->line) - (a->line < b->line);
}

static sl_bits *covers_of(const chooser *c, uint32_t line) {
    return c->covers + line * c->words;
}

static sl_status rank(sl_context *context, chooser *c) {
    const uint32_t n = c->all->count;
    ranked *all = sl_alloc_array(context, (size_t)n + 1, sizeof *all);
    if (!all) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < n; i++) {
        const sl_segment *s = &c->all->lines[i];
        all[i] = (ranked){sli_length(s->b.x - s->a.x, s->b.y - s->a.y),
                          (uint32_t)sli_bits_count(covers_of(c, i), c->words), i};
    }
    qsort(all, n, sizeof *all, compare_ranks);
    for (uint32_t i = 0; i < n; i++) c->order[i] = all[i].line;
    sl_free(context, all);
    return SL_OK;
}

/// From one side of the probe to the other; it may graze the probe's end, but not run along it.
static bool crosses(const sl_segment *line, const sl_segment *probe) {
    return sli_orient(probe->a, probe->b, line->a) * sli_orient(probe->a, probe->b, line->b) < 0 &&
           sli_touch(line, probe);
}

typedef struct extent {
    double left, right, low, high;
    uint32_t probe;
} extent;

static extent extent_of(const sl_segment *s, uint32_t probe) {
    const bool right = s->a.x < s->b.x, up = s->a.y < s->b.y;
    return (extent){right ? s->a.x : s->b.x, right ? s->b.x : s->a.x, up ? s->a.y : s->b.y,
                    up ? s->b.y : s->a.y, probe};
}

static int compare_extents(const void *left, const void *right) {
    const extent *a = left, *b = right;
    if (a->left != b->left) return a->left < b->left ? -1 : 1;
    return (a->probe > b->probe) - (a->probe < b->probe);
}

static sl_status find_cover(sl_context *context, chooser *c) {
    const uint32_t probes = c->all->probe_count;
    extent *order = sl_alloc_array(context, (size_t)probes + 1, sizeof *order);
    if (!order) return SL_NO_MEMORY;
    for (uint32_t k = 0; k < probes; k++) order[k] = extent_of(&c->all->probes[k], k);
    qsort(order, probes, sizeof *order, compare_extents);
    sl_status status = SL_OK;
    for (uint32_t i = 0; i < c->all->count && status == SL_OK; i++) {
        const sl_segment *line = &c->all->lines[i];
        const extent e = extent_of(line, 0);
        if (i % 64 == 0) {
            sl_report(context, "axial cover", "lines", i, c->all->count);
            status = sl_check_cancelled(context);
        }
        for (const extent *o = order; o < order + probes && o->left <= e.right; o++)
            if (o->right >= e.left && o->low <= e.high && o->high >= e.low &&
                crosses(line, &c->all->probes[o->probe]))
                sl_bits_add(covers_of(c, i), o->probe);
    }
    sl_free(context, order);
    return status;
}

/// By probe: the kept lines that cover it, in lists; one more, of all of them.
typedef struct cover_list {
    uint32_t line, next; ///< from 1; 0: no more
} cover_list;

typedef struct cover_lists {
    uint32_t *first; ///< by probe: into `items`, from 1; 0: none
    SL_ARRAY(cover_list) list;
} cover_lists;

static sl_status list_line(sl_context *context, const chooser *c, cover_lists *lists,
                           uint32_t line) {
    const uint32_t probes = c->all->probe_count;
    for (uint32_t k = 0; k <= probes; k++) {
        if (k < probes && !sl_bits_has(covers_of(c, line), k)) continue;
        SL_TRY(SL_ARRAY_ROOM(context, &lists->list, 1));
        lists->list.items[lists->list.count++] = (cover_list){line, lists->first[k]};
        lists->first[k] = (uint32_t)lists->list.count;
    }
    return SL_OK;
}

/// Whether a line that stays covers what this one covers, and touches it.
static bool is_subset(const chooser *c, const cover_lists *lists, uint32_t line) {
    const sl_bits *mine = covers_of(c, line);
    uint32_t probe = 0;
    while (probe < c->all->probe_count && !sl_bits_has(mine, probe)) probe++;
    for (uint32_t i = lists->first[probe]; i; i = lists->list.items[i - 1].next) {
        const uint32_t other = lists->list.items[i - 1].line;
        const sl_bits *theirs = covers_of(c, other);
        size_t w = probe / 64;
        while (w < c->words && !(mine[w] & ~theirs[w])) w++;
        if (w >= c->words && sli_touch(&c->all->lines[line], &c->all->lines[other])) return true;
    }
    return false;
}

/// Longest first: a line stays unless one that stays covers the same and touches it.
static sl_status drop_subsets(sl_context *context, chooser *c) {
    cover_lists lists = {0};
    lists.first = sl_alloc_array(context, (size_t)c->all->probe_count + 1, sizeof *lists.first);
    sl_status status = lists.first ? SL_OK : SL_NO_MEMORY;
    for (uint32_t r = 0; r < c->all->count && status == SL_OK; r++) {
        const uint32_t line = c->order[r];
        if (r % 64 == 0) {
            sl_report(context, "axial subsets", "lines", r, c->all->count);
            status = sl_check_cancelled(context);
        }
        if (status != SL_OK || is_subset(c, &lists, line)) continue;
        keep(c, line);
        status = list_line(context, c, &lists, line);
    }
    sl_free(context, lists.first);
    sl_free(context, lists.list.items);
    return status;
}

// --- lines that stay joined

/// Stamps all kept lines that steps lead to.
static sl_status stamp_from(sl_context *context, chooser *c, uint32_t line, uint32_t stamp) {
    c->queue.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &c->queue, 1));
    c->queue.items[c->queue.count++] = line;
    c->stamps[line] = stamp;
    for (size_t head = 0; head < c->queue.count; head++) {
        const uint32_t at = c->queue.items[head];
        for (uint32_t k = 0; k < c->stay_count; k++) {
            const uint32_t i = c->stay[k];
            if (c->stamps[i] == stamp || !sli_touch(&c->all->lines[at], &c->all->lines[i]))
                continue;
            SL_TRY(SL_ARRAY_ROOM(context, &c->queue, 1));
            c->queue.items[c->queue.count++] = i;
            c->stamps[i] = stamp;
        }
    }
    return SL_OK;
}

/// Takes a line back if it joins kept lines of different parts. Returns how many parts less are
/// left.
static uint32_t take_back(chooser *c, uint32_t *parents, uint32_t line) {
    uint32_t part = 0, fewer = 0;
    for (uint32_t k = 0; k < c->stay_count; k++) {
        const uint32_t i = c->stay[k], other = sl_root_of(parents, c->stamps[i]);
        if (other == part || !sli_touch(&c->all->lines[line], &c->all->lines[i])) continue;
        fewer += part != 0;
        parents[other] = part ? part : other;
        part = part ? part : other;
    }
    if (!fewer) return 0;
    keep(c, line);
    c->stamps[line] = part;
    return fewer;
}

/// Takes lines back, the longest first, until the parts are those of all lines.
static sl_status rejoin(sl_context *context, chooser *c) {
    uint32_t parts = 0;
    const uint32_t n = c->all->count;
    for (uint32_t i = 0; i < n; i++) c->stamps[i] = 0;
    for (uint32_t i = 0; i < n; i++)
        if (c->kept[i] && !c->stamps[i]) SL_TRY(stamp_from(context, c, i, ++parts));
    uint32_t *parents = sl_alloc_array(context, (size_t)parts + 1, sizeof *parents);
    if (!parents) return SL_NO_MEMORY;
    for (uint32_t k = 0; k <= parts; k++) parents[k] = k;
    sl_status status = SL_OK;
    for (uint32_t r = 0; r < n && parts > 1 && status == SL_OK; r++) {
        if (!c->kept[c->order[r]]) parts -= take_back(c, parents, c->order[r]);
        if (r % 64 == 0) status = sl_check_cancelled(context);
    }
    sl_free(context, parents);
    return status;
}

/// Whether the kept lines that touch a line reach each other without it; false for the last line of
/// its part of the plan. `graph`: of all lines. The search ends when it has found them all, mostly
/// after few steps. `stamp` marks those to be found, and the one after it those that are reached.
static bool stays_joined(chooser *c, const sl_line_graph *graph, uint32_t line, uint32_t stamp) {
    const uint32_t *touched = graph->others + graph->first[line], reached = stamp + 1;
    const size_t count = graph->first[line + 1] - graph->first[line];
    size_t head = 0, tail = 0, missing = 0;
    for (size_t i = 0; i < count; i++) {
        if (!c->kept[touched[i]]) continue;
        c->stamps[touched[i]] = stamp;
        if (!missing++) c->queue.items[tail++] = touched[i];
    }
    if (!missing) return false;
    c->stamps[c->queue.items[0]] = reached;
    missing--;
    while (missing && head < tail) {
        const uint32_t at = c->queue.items[head++];
        for (size_t i = graph->first[at]; i < graph->first[at + 1]; i++) {
            const uint32_t next = graph->others[i];
            if (!c->kept[next] || c->stamps[next] == reached) continue;
            missing -= c->stamps[next] == stamp;
            c->stamps[next] = reached;
            c->queue.items[tail++] = next;
        }
    }
    return !missing;
}

/// Shortest first: a line goes where nothing is missing without it.
static sl_status drop_spare(sl_context *context, chooser *c) {
    const uint32_t n = c->all->count, probes = c->all->probe_count;
    sl_line_graph graph = {0};
    uint32_t stamp = n + 1; // larger than those of rejoin()
    uint32_t *times = sl_alloc_array(context, (size_t)probes + 1, sizeof *times);
    if (!times) return SL_NO_MEMORY;
    sl_status status = sl_line_graph_make(context, c->all->lines, n, &graph);
    if (status == SL_OK) status = SL_ARRAY_ROOM(context, &c->queue, (size_t)n + 1);
    if (status != SL_OK) {
        sl_line_graph_destroy(context, &graph);
        sl_free(context, times);
        return status;
    }
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t k = 0; k < probes && c->kept[i]; k++)
            times[k] += sl_bits_has(covers_of(c, i), k);
    for (uint32_t r = n; r-- > 0 && status == SL_OK;) {
        const uint32_t line = c->order[r];
        bool goes = c->kept[line];
        for (uint32_t k = 0; k < probes && goes; k++)
            goes = !sl_bits_has(covers_of(c, line), k) || times[k] > 1;
        if (!goes) continue;
        c->kept[line] = false;
        goes = stays_joined(c, &graph, line, stamp);
        stamp += 2;
        c->kept[line] = !goes;
        for (uint32_t k = 0; k < probes && goes; k++)
            times[k] -= sl_bits_has(covers_of(c, line), k);
        status = sl_check_cancelled(context);
    }
    sl_line_graph_destroy(context, &graph);
    sl_free(context, times);
    return status;
}

static sl_status reduce(sl_context *context, sl_axial_lines *lines, bool fewest) {
    const uint32_t n = lines->count;
    chooser c = {.all = lines, .words = sl_bits_words(lines->probe_count)};
    c.covers = sl_alloc_array(context, n * c.words + 1, sizeof *c.covers);
    c.order = sl_alloc_array(context, (size_t)n + 1, sizeof *c.order);
    c.kept = sl_alloc_array(context, (size_t)n + 1, sizeof *c.kept);
    c.stamps = sl_alloc_array(context, (size_t)n + 1, sizeof *c.stamps);
    c.stay = sl_alloc_array(context, (size_t)n + 1, sizeof *c.stay);
    sl_status status = c.covers && c.order && c.kept && c.stamps && c.stay ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = find_cover(context, &c);
    if (status == SL_OK) status = rank(context, &c);
    for (uint32_t i = 0; i < n && status == SL_OK && fewest; i++) c.kept[i] = true;
    if (status == SL_OK && !fewest) status = drop_subsets(context, &c);
    if (status == SL_OK && !fewest) status = rejoin(context, &c);
    if (status == SL_OK && fewest) status = drop_spare(context, &c);
    if (status == SL_OK) {
        lines->count = 0;
        for (uint32_t i = 0; i < n; i++)
            if (c.kept[i]) lines->lines[lines->count++] = lines->lines[i];
    }
    sl_free(context, c.covers);
    sl_free(context, c.order);
    sl_free(context, c.kept);
    sl_free(context, c.stamps);
    sl_free(context, c.stay);
    sl_free(context, c.queue.items);
    return status;
}

sl_status sl_axial_fewest(sl_context *context, sl_axial_lines *lines, bool fewest) {
    SL_TRY(reduce(context, lines, false));
    return fewest ? reduce(context, lines, true) : SL_OK;
}

/// The parts of a visibility graph: points that steps join, in either direction. A search goes from
/// part to part. Each run takes one operation a word, as points that were found are left out at
/// once; so the cost is O(runs).
///
/// Where glass is dark from one side, a search may come to points of another part, which did not
/// lead here. Then the two parts are one: `parent` has sets of parts.
#include "base/bits.h"
#include "sightline/vga.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Parts with fewer points than this share of the largest one do not set a scale.
#define SMALL_PART 0.1

typedef struct search {
    const sl_vga_graph *graph;
    sl_bits *found, *own; ///< points of all parts so far, and of this one
    uint32_t *part;       ///< by point: the first point of its search
    uint32_t *parent;     ///< by point: sets of parts
    uint32_t *stack, depth;
} search;

static void join(search *s, uint32_t a, uint32_t b) {
    a = sl_root_of(s->parent, a);
    b = sl_root_of(s->parent, b);
    s->parent[a > b ? a : b] = a > b ? b : a;
}

/// Takes the points of a word of a row: new ones, and those of other parts.
static void take(search *s, uint32_t part, size_t word, sl_bits seen) {
    const sl_bits fresh = seen & ~s->found[word];
    sl_bits other = seen & ~s->own[word];
    s->own[word] |= seen;
    s->found[word] |= seen;
    for (uint32_t point = (uint32_t)(64 * word); other; other >>= 1, point++) {
        if (!(other & 1)) continue;
        if (!(fresh >> point % 64 & 1)) {
            join(s, part, s->part[point]);
            continue;
        }
        s->part[point] = part;
        s->stack[s->depth++] = point;
    }
}

static void search_from(search *s, uint32_t first) {
    memset(s->own, 0, sl_bits_words(s->graph->count) * sizeof *s->own);
    take(s, first, first / 64, (sl_bits)1 << first % 64);
    while (s->depth) {
        sl_vga_run run = sl_vga_row(s->graph, s->stack[--s->depth]);
        while (sl_vga_next(&run))
            for (size_t w = run.first / 64; w * 64 < run.stop; w++) {
                const sl_bits seen = sli_bits_run(w, run.first, run.stop);
                if (seen & ~s->own[w]) take(s, first, w, seen);
            }
    }
}

/// Gives each point the first point of its part.
static sl_status find_parts(sl_context *context, const sl_vga_graph *graph,
                            const sl_vga_link *links, size_t link_count, uint32_t *parts) {
    const uint32_t count = graph->count;
    for (size_t i = 0; i < link_count; i++)
        if (links[i].a >= count || links[i].b >= count)
            return sl_fail(context, SL_BAD_ARGUMENT, "a link joins two points of the grid");
    search s = {.graph = graph,
                .found = sl_alloc_array(context, sl_bits_words(count), sizeof *s.found),
                .own = sl_alloc_array(context, sl_bits_words(count), sizeof *s.own),
                .part = parts,
                .parent = sl_alloc_array(context, (size_t)count + 1, sizeof *s.parent),
                .stack = sl_alloc_array(context, (size_t)count + 1, sizeof *s.stack)};
    const bool room = s.found && s.own && s.parent && s.stack;
    if (room) {
        for (uint32_t p = 0; p < count; p++) s.parent[p] = p;
        for (uint32_t p = 0; p < count; p++)
            if (!sl_bits_has(s.found, p)) search_from(&s, p);
        for (size_t i = 0; i < link_count; i++) join(&s, s.part[links[i].a], s.part[links[i].b]);
        for (uint32_t p = 0; p < count; p++) s.part[p] = sl_root_of(s.parent, s.part[p]);
    }
    void *const arrays[] = {s.found, s.own, s.parent, s.stack};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) sl_free(context, arrays[i]);
    return room ? SL_OK : SL_NO_MEMORY;
}

/// A part, while parts are put in order.
typedef struct part {
    uint32_t first, size;
} part;

/// The larger one comes first; of two alike the one whose first point does.
static int compare_parts(const void *a, const void *b) {
    const part *p = a, *q = b;
    return p->size != q->size ? (p->size < q->size) - (p->size > q->size)
                              : (p->first > q->first) - (p->first < q->first);
}

sl_status sl_vga_parts(sl_context *context, const sl_vga_graph *graph, const sl_vga_link *links,
                       size_t link_count, uint32_t *parts, uint32_t *part_count) {
    const uint32_t count = graph->count;
    part *list = sl_alloc_array(context, (size_t)count + 1, sizeof *list);
    uint32_t *place = sl_alloc_array(context, (size_t)count + 1, sizeof *place), found = 0;
    sl_status status = list && place ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = find_parts(context, graph, links, link_count, parts);
    for (uint32_t p = 0; status == SL_OK && p < count; p++) {
        if (parts[p] == p) {
            place[p] = found;
            list[found++] = (part){.first = p};
        }
        list[place[parts[p]]].size++; // a part's first point comes before the others
    }
    if (status == SL_OK) {
        qsort(list, found, sizeof *list, compare_parts);
        for (uint32_t i = 0; i < found; i++) place[list[i].first] = i;
        for (uint32_t p = 0; p < count; p++) parts[p] = place[parts[p]];
        *part_count = found;
    }
    sl_free(context, list);
    sl_free(context, place);
    return status;
}

sl_status sl_vga_part_sizes(sl_context *context, const sl_vga_graph *graph,
                            const sl_vga_link *links, size_t link_count, uint32_t *sizes) {
    const uint32_t count = graph->count;
    uint32_t *parts = sl_alloc_array(context, (size_t)count + 1, sizeof *parts);
    sl_status status = parts ? find_parts(context, graph, links, link_count, parts) : SL_NO_MEMORY;
    if (status == SL_OK) {
        for (uint32_t p = 0; p < count; p++) sizes[p] = 0;
        for (uint32_t p = 0; p < count; p++) sizes[parts[p]]++;
        for (uint32_t p = 0; p < count; p++) sizes[p] = sizes[parts[p]]; // first points first
    }
    sl_free(context, parts);
    return status;
}

sl_vga_scale sl_vga_scale_of(const double *values, const uint32_t *sizes, uint32_t count) {
    sl_vga_scale scale = {.least = INFINITY, .most = -INFINITY};
    double largest = 0, parts = 0;
    for (uint32_t i = 0; i < count; i++)
        if (!isnan(values[i])) largest = fmax(largest, sizes[i]);
    for (uint32_t i = 0; i < count; i++) {
        if (sizes[i] < SMALL_PART * largest) {
            scale.small_points++;
            parts += 1.0 / sizes[i];
            continue;
        }
        scale.least = fmin(scale.least, values[i]);
        scale.most = fmax(scale.most, values[i]);
    }
    scale.small_parts = (uint32_t)round(parts);
    for (uint32_t i = 0; i < count; i++)
        scale.beyond += values[i] < scale.least || values[i] > scale.most;
    return scale;
}

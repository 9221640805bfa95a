/// Networks: chosen places that lines of sight join, each to each over others (cooperative guards:
/// Liaw, Huang and Lee 1993, The minimum cooperative guards problem on k-spiral polygons).
///
/// Two points of places are linked if each sees the other, within the ranges of both. Headings do
/// not count.
///
///     a . . . b   c . . d     The places {a, b, c, d} see everything, but fall into parts. Let A
///     be
///              \ /            places around one part and D places around the others, so that no
///               r             place of A is linked to one of D; B is the rest.
///
/// A witness that no place of D sees needs a place of A or B, and one that no place of A sees needs
/// a place of D or B. So a network has a place of B, which joins A and D. That is one more row of
/// the set cover, and the parts do not cover it. Such rows are added until the cheapest cover is a
/// network: bounds stay those of set covers.
///
/// A set in parts is joined by the cheapest chains (Dijkstra 1959); then what is not needed goes.
/// Links may leave the places themselves in parts. Those that cannot see all witnesses are ruled
/// out.
#include "analysis/placement/cover.h"
#include "analysis/placement/place_area.h"
#include "base/heap.h"
#include "geometry/crossing.h"

#include <string.h>

#define NONE UINT32_MAX

// --- links

static bool is_within(const sli_area *a, uint32_t g, uint32_t h) {
    const uint32_t p = a->groups[g], q = a->groups[h];
    const sl_point from = a->task->places[p].at, to = a->task->places[q].at;
    return !(a->ranges[p] > 0 && sli_distance_compare(from, to, a->ranges[p]) > 0) &&
           !(a->ranges[q] > 0 && sli_distance_compare(from, to, a->ranges[q]) > 0);
}

/// Whether each of two points sees the other, of which the second does. Off walls and without glass
/// sight has no direction.
static sl_status see_each_other(sli_area *a, uint32_t g, uint32_t h, bool *out) {
    const sl_point from = a->task->places[a->groups[g]].at, to = a->task->places[a->groups[h]].at;
    *out = true;
    if (!a->directed && !a->on_edge[g] && !a->on_edge[h]) return SL_OK;
    const double range = sl_query_range(a->query);
    SL_TRY(sl_query_set_range(a->context, a->query, 0));
    sl_status status = sl_query_sees(a->context, a->query, from, to, out);
    if (status == SL_OK && *out) status = sl_query_sees(a->context, a->query, to, from, out);
    const sl_status reset = sl_query_set_range(a->context, a->query, range);
    return status == SL_OK ? reset : status;
}

/// Links of each point to those after it, as ends.links of its list.
static sl_status find_links(sli_area *a, sli_link_list *later) {
    for (uint32_t g = 0; g < a->group_count; g++) {
        SL_TRY(sl_check_cancelled(a->context));
        SL_TRY(sli_area_seers(a, a->task->places[a->groups[g]].at, g + 1));
        SL_TRY(SL_ARRAY_ROOM(a->context, later, 2 * a->seers.count));
        for (size_t i = 0; i < a->seers.count; i++) {
            bool linked = is_within(a, g, a->seers.items[i]);
            if (linked) SL_TRY(see_each_other(a, g, a->seers.items[i], &linked));
            if (!linked) continue;
            later->items[later->count++] = g;
            later->items[later->count++] = a->seers.items[i];
        }
    }
    return SL_OK;
}

/// The pairs as lists by point, both ways.
static sl_status list_links(sli_area *a, const sli_link_list *pairs) {
    sli_network *n = &a->network;
    n->first = sl_alloc_array(a->context, (size_t)a->group_count + 2, sizeof *n->first);
    n->links = sl_alloc_array(a->context, pairs->count + 1, sizeof *n->links);
    n->group_of = sl_alloc_array(a->context, a->task->place_count, sizeof *n->group_of);
    n->part = sl_alloc_array(a->context, a->group_count, sizeof *n->part);
    n->queue = sl_alloc_array(a->context, a->group_count, sizeof *n->queue);
    if (!n->first || !n->links || !n->group_of || !n->part || !n->queue) return SL_NO_MEMORY;
    // The start of a list is kept one place behind, where it moves while the list is filled.
    for (size_t i = 0; i < pairs->count; i++) n->first[(size_t)pairs->items[i] + 2]++;
    for (uint32_t g = 0; g < a->group_count; g++) n->first[g + 2] += n->first[g + 1];
    for (size_t i = 0; i < pairs->count; i++)
        n->links[n->first[(size_t)pairs->items[i] + 1]++] = pairs->items[i ^ 1];
    for (uint32_t g = 0; g < a->group_count; g++)
        for (uint32_t i = a->groups[g]; i < a->groups[g + 1]; i++) n->group_of[i] = g;
    return SL_OK;
}

void sli_network_end(sli_area *a) {
    sli_network *n = &a->network;
    sl_free(a->context, n->first);
    sl_free(a->context, n->links);
    sl_free(a->context, n->group_of);
    sl_free(a->context, n->region);
    sl_free(a->context, n->failed);
    sl_free(a->context, n->seen);
    sl_free(a->context, n->part);
    sl_free(a->context, n->queue);
    sl_free(a->context, n->row_ends.items);
    sl_free(a->context, n->entries.items);
}

/// Numbers the parts that chosen places fall into: n->part by point, NONE where none is chosen.
/// Returns how many there are.
static uint32_t find_parts(sli_area *a, const uint8_t *chosen) {
    sli_network *n = &a->network;
    uint32_t parts = 0;
    for (uint32_t g = 0; g < a->group_count; g++) {
        n->part[g] = NONE;
        for (uint32_t i = a->groups[g]; i < a->groups[g + 1]; i++)
            if (chosen[i]) n->part[g] = NONE - 1;
    }
    for (uint32_t g = 0; g < a->group_count; g++) {
        if (n->part[g] != NONE - 1) continue;
        size_t head = 0, tail = 0;
        n->part[g] = parts;
        n->queue[tail++] = g;
        while (head < tail) {
            const uint32_t at = n->queue[head++];
            for (size_t i = n->first[at]; i < n->first[at + 1]; i++) {
                if (n->part[n->links[i]] != NONE - 1) continue;
                n->part[n->links[i]] = parts;
                n->queue[tail++] = n->links[i];
            }
        }
        parts++;
    }
    return parts;
}

// --- parts of all places

/// Parts without all fixed places fail.
static sl_status rule_out_by_fixed(sli_area *a) {
    sli_network *n = &a->network;
    for (uint32_t i = 1; i < a->task->fixed_count; i++)
        if (n->region[n->group_of[a->task->fixed[i]]] != n->region[n->group_of[a->task->fixed[0]]])
            return sl_fail(a->context, SL_BAD_ARGUMENT,
                           "no network: no lines of sight join the fixed places %u and %u", 1u,
                           i + 1);
    for (uint32_t r = 0; r < n->region_count; r++)
        for (uint32_t i = 0; i < a->task->fixed_count; i++)
            if (n->region[n->group_of[a->task->fixed[i]]] != r) n->failed[r] = true;
    return SL_OK;
}

sl_status sli_network_begin(sli_area *a) {
    sli_network *n = &a->network;
    sli_link_list pairs = {0};
    sl_status status = find_links(a, &pairs);
    if (status == SL_OK) status = list_links(a, &pairs);
    sl_free(a->context, pairs.items);
    SL_TRY(status);
    uint8_t *all = sl_alloc_array(a->context, a->task->place_count, 1);
    n->region = sl_alloc_array(a->context, a->group_count, sizeof *n->region);
    if (!all || !n->region) {
        sl_free(a->context, all);
        return SL_NO_MEMORY;
    }
    memset(all, 1, a->task->place_count);
    n->region_count = find_parts(a, all);
    memcpy(n->region, n->part, a->group_count * sizeof *n->region);
    sl_free(a->context, all);
    n->failed = sl_alloc_array(a->context, n->region_count, sizeof *n->failed);
    n->seen = sl_alloc_array(a->context, n->region_count, sizeof *n->seen);
    if (!n->failed || !n->seen) return SL_NO_MEMORY;
    return rule_out_by_fixed(a);
}

/// The part of all places with the most points.
static uint32_t largest_region(const sli_area *a, bool allowed) {
    const sli_network *n = &a->network;
    uint32_t best = NONE, most = 0;
    for (uint32_t r = 0; r < n->region_count; r++) {
        uint32_t size = 0;
        for (uint32_t g = 0; g < a->group_count; g++) size += n->region[g] == r;
        if (size <= most || (allowed && n->failed[r])) continue;
        most = size;
        best = r;
    }
    return best;
}

/// Counts by part who sees a witness, surely and maybe, into n->seen. Returns how often it must be
/// seen.
static uint32_t count_seers(sli_area *a, size_t row) {
    sli_network *n = &a->network;
    uint32_t all = 0;
    memset(n->seen, 0, n->region_count * sizeof *n->seen);
    for (size_t i = row ? a->row_ends.items[row - 1] : 0; i < a->row_ends.items[row]; i++) {
        const uint32_t entry = a->entries.items[i];
        sli_seen_by *seen = &n->seen[n->region[n->group_of[entry & ~SLI_WIDE]]];
        seen->maybe++;
        if (entry & SLI_WIDE) continue;
        seen->surely++;
        all++;
    }
    return all < a->cover ? all : a->cover;
}

sl_status sli_network_rule_out(sli_area *a) {
    sli_network *n = &a->network;
    if (n->region_count < 2) return SL_OK;
    const uint32_t largest = largest_region(a, false);
    for (; n->rows_known < a->witnesses.count; n->rows_known++) {
        const sl_point at = a->witnesses.items[n->rows_known];
        const uint32_t demand = count_seers(a, n->rows_known);
        for (uint32_t r = 0; r < n->region_count; r++) {
            if (n->seen[r].surely >= demand || n->failed[r]) continue;
            if (r == largest) n->hidden = at;
            n->failed[r] = true;
            n->is_rounded |= n->seen[r].maybe >= demand;
        }
    }
    if (largest_region(a, true) != NONE) return SL_OK;
    return sl_fail(a->context, SL_BAD_ARGUMENT,
                   "no network of these places sees everything: they fall into %u parts that no "
                   "lines of sight join, and not enough of the largest part see (%.9g, %.9g)",
                   n->region_count, n->hidden.x, n->hidden.y);
}

bool sli_network_allows(const sli_area *a, uint32_t place) {
    const sli_network *n = &a->network;
    return !n->failed || !n->failed[n->region[n->group_of[place]]];
}

// --- joining

typedef struct reached {
    uint64_t cost;
    uint32_t group;
} reached;

static bool is_nearer(const reached *a, const reached *b) {
    return a->cost != b->cost ? a->cost < b->cost : a->group < b->group;
}

SLI_HEAP(reach_heap, reached, is_nearer)

/// The cheapest place at a point.
static uint32_t cheapest_at(const sli_area *a, uint32_t group) {
    uint32_t best = a->groups[group];
    for (uint32_t i = best + 1; a->task->costs && i < a->groups[group + 1]; i++)
        if (a->task->costs[i] < a->task->costs[best]) best = i;
    return best;
}

typedef struct joiner {
    sli_area *a;
    uint64_t *cost; ///< by point, of the way there from the first part
    uint32_t *from; ///< by point: the one before it
    reach_heap heap;
} joiner;

static sl_status reach(joiner *j, uint32_t group, uint64_t cost, uint32_t from) {
    if (cost >= j->cost[group]) return SL_OK;
    j->cost[group] = cost;
    j->from[group] = from;
    return reach_heap_push(j->a->context, &j->heap, (reached){cost, group});
}

/// Adds the cheapest chain of places from the first part to another. *joined: there is one.
static sl_status add_chain(joiner *j, uint8_t *chosen, bool *joined) {
    sli_area *a = j->a;
    const sli_network *n = &a->network;
    *joined = false;
    j->heap.count = 0;
    for (uint32_t g = 0; g < a->group_count; g++) j->cost[g] = UINT64_MAX;
    for (uint32_t g = 0; g < a->group_count; g++)
        if (n->part[g] == 0) SL_TRY(reach(j, g, 0, NONE));
    while (j->heap.count) {
        const reached r = reach_heap_pop(&j->heap);
        if (r.cost > j->cost[r.group]) continue;
        if (n->part[r.group] != NONE && n->part[r.group] != 0) {
            for (uint32_t g = r.group; g != NONE; g = j->from[g])
                if (n->part[g] == NONE) chosen[cheapest_at(a, g)] = 1;
            *joined = true;
            return SL_OK;
        }
        for (size_t i = n->first[r.group]; i < n->first[r.group + 1]; i++) {
            const uint32_t next = n->links[i];
            uint64_t cost = 0;
            if (n->part[next] == NONE)
                cost = a->task->costs ? a->task->costs[cheapest_at(a, next)] : 1;
            SL_TRY(reach(j, next, r.cost + cost, r.group));
        }
    }
    return SL_OK;
}

static bool is_needed(const sli_cover *cover, const uint32_t *counts, uint32_t place) {
    for (size_t i = cover->column_first[place]; i < cover->column_first[place + 1]; i++) {
        const uint32_t row = cover->column_rows[i];
        if (counts[row] <= cover->demands[row]) return true;
    }
    return false;
}

/// Drops places without which the rest is a network that covers all rows: the dear ones first, of
/// these from `start` on.
static sl_status drop_unneeded(sli_area *a, const sli_cover *cover, uint32_t start,
                               uint8_t *chosen) {
    uint32_t most = 0;
    uint32_t *counts = sl_alloc_array(a->context, cover->rows, sizeof *counts);
    if (!counts) return SL_NO_MEMORY;
    for (uint32_t p = 0; p < cover->columns; p++) {
        if (!chosen[p]) continue;
        if (cover->costs[p] > most) most = cover->costs[p];
        for (size_t i = cover->column_first[p]; i < cover->column_first[p + 1]; i++)
            counts[cover->column_rows[i]]++;
    }
    for (uint32_t next = 0; most; most = next, next = 0)
        for (uint32_t k = 0; k < cover->columns; k++) {
            const uint32_t p =
                k < cover->columns - start ? start + k : k - (cover->columns - start);
            if (!chosen[p] || a->fixed[p]) continue;
            if (cover->costs[p] < most && cover->costs[p] > next) next = cover->costs[p];
            if (cover->costs[p] != most || is_needed(cover, counts, p)) continue;
            chosen[p] = 0;
            if (find_parts(a, chosen) > 1) {
                chosen[p] = 1;
                continue;
            }
            for (size_t i = cover->column_first[p]; i < cover->column_first[p + 1]; i++)
                counts[cover->column_rows[i]]--;
        }
    sl_free(a->context, counts);
    return SL_OK;
}

/// All places of one part.
static void take_region(sli_area *a, uint8_t *chosen) {
    const sli_network *n = &a->network;
    const uint32_t region = largest_region(a, true);
    for (uint32_t p = 0; p < a->task->place_count; p++)
        chosen[p] = n->region[n->group_of[p]] == region;
}

sl_status sli_network_join_by(sli_area *a, const sli_cover *cover, uint32_t start, uint8_t *chosen,
                              bool *joined) {
    joiner j = {.a = a};
    sl_status status = SL_OK;
    *joined = true;
    j.cost = sl_alloc_array(a->context, a->group_count, sizeof *j.cost);
    j.from = sl_alloc_array(a->context, a->group_count, sizeof *j.from);
    if (!j.cost || !j.from) status = SL_NO_MEMORY;
    while (status == SL_OK && *joined && find_parts(a, chosen) > 1)
        status = add_chain(&j, chosen, joined);
    if (status == SL_OK && !*joined) take_region(a, chosen);
    if (status == SL_OK) status = drop_unneeded(a, cover, start, chosen);
    sl_free(a->context, j.cost);
    sl_free(a->context, j.from);
    sl_free(a->context, j.heap.items);
    return status;
}

sl_status sli_network_join(sli_area *a, uint8_t *chosen) {
    sl_cover_problem problem = {0};
    sli_cover cover = {0};
    bool joined;
    sl_status status = sli_area_problem(a, false, &problem);
    if (status == SL_OK) status = sli_cover_read(a->context, &problem, 1, &cover);
    if (status == SL_OK) status = sli_network_join_by(a, &cover, 0, chosen, &joined);
    sli_cover_destroy(a->context, &cover);
    sli_area_problem_destroy(a->context, &problem);
    return status;
}

// --- rows

/// What bits of a place say: on which side it is, and of the two witnesses, which ones it sees.
enum { IN_A = 1, IN_D = 2, SEES_FIRST = 4, SEES_SECOND = 8, NEAR_A = 1, NEAR_D = 2 };

typedef struct cutter {
    sli_area *a;
    const sli_cover *cover; ///< all rows, with true ranges
    const uint8_t *chosen;
    uint8_t *bits; ///< by place
    uint8_t *near; ///< by point: there, or linked to it, is a place of A, of D
} cutter;

static void mark_near(cutter *c, uint32_t group, uint8_t bit) {
    const sli_network *n = &c->a->network;
    c->near[group] |= bit;
    for (size_t i = n->first[group]; i < n->first[group + 1]; i++) c->near[n->links[i]] |= bit;
}

/// The row with the fewest places, of which none is on a side; NONE where every row has one.
static uint32_t row_off(const cutter *c, uint8_t side) {
    uint32_t best = NONE;
    size_t fewest = SIZE_MAX;
    for (uint32_t r = 0; r < c->cover->rows; r++) {
        const size_t from = c->cover->row_first[r], to = c->cover->row_first[r + 1];
        bool off = c->cover->demands[r] > 0 && to - from < fewest;
        for (size_t i = from; i < to && off; i++) off = !(c->bits[c->cover->row_columns[i]] & side);
        if (!off) continue;
        fewest = to - from;
        best = r;
    }
    return best;
}

/// Says that a place out of a side and B is needed in any case: a fixed one is there, or some
/// witness asks for it. False where that is not sure.
static bool needs_side(cutter *c, uint8_t side, uint8_t other, uint8_t sees) {
    for (uint32_t p = 0; p < c->a->task->place_count; p++)
        if (c->a->fixed[p] && c->bits[p] & side) return true;
    const uint32_t row = row_off(c, other);
    if (row == NONE) return false;
    for (size_t i = c->cover->row_first[row]; i < c->cover->row_first[row + 1]; i++)
        c->bits[c->cover->row_columns[i]] |= sees;
    return true;
}

/// Parts the places into A, D and B, about one of the parts. False where nothing says that a
/// network has places on both sides.
static bool part_places(cutter *c, uint32_t part) {
    const sli_network *n = &c->a->network;
    const uint32_t places = c->a->task->place_count;
    memset(c->bits, 0, places);
    memset(c->near, 0, c->a->group_count);
    for (uint32_t p = 0; p < places; p++) {
        if (!c->chosen[p]) continue;
        const bool is_in = n->part[n->group_of[p]] == part;
        c->bits[p] = is_in ? IN_A : IN_D;
        mark_near(c, n->group_of[p], is_in ? NEAR_A : NEAR_D);
    }
    if (!needs_side(c, IN_A, IN_D, SEES_FIRST) || !needs_side(c, IN_D, IN_A, SEES_SECOND))
        return false;
    for (uint32_t p = 0; p < places; p++) {
        if (c->bits[p] & (IN_A | IN_D | SEES_SECOND) || c->near[n->group_of[p]] & NEAR_D) continue;
        c->bits[p] |= IN_A;
        mark_near(c, n->group_of[p], NEAR_A);
    }
    for (uint32_t p = 0; p < places; p++) {
        if (c->bits[p] & (IN_A | IN_D | SEES_FIRST) || c->near[n->group_of[p]] & NEAR_A) continue;
        c->bits[p] |= IN_D;
    }
    return true;
}

/// B is empty only where no network can see everything.
static sl_status add_row(cutter *c) {
    sli_area *a = c->a;
    sli_network *n = &a->network;
    SL_TRY(SL_ARRAY_ROOM(a->context, &n->row_ends, 1));
    SL_TRY(SL_ARRAY_ROOM(a->context, &n->entries, a->task->place_count));
    for (uint32_t p = 0; p < a->task->place_count; p++)
        if (!(c->bits[p] & (IN_A | IN_D))) n->entries.items[n->entries.count++] = p;
    n->row_ends.items[n->row_ends.count++] = n->entries.count;
    return SL_OK;
}

static sl_status add_rows(cutter *c, uint32_t parts, uint32_t *added) {
    for (uint32_t part = 0; part < parts; part++) {
        if (!part_places(c, part)) continue;
        SL_TRY(add_row(c));
        ++*added;
    }
    return SL_OK;
}

sl_status sli_network_cut(sli_area *a, const uint8_t *chosen, uint32_t *added) {
    *added = 0;
    const uint32_t parts = find_parts(a, chosen);
    if (parts < 2) return SL_OK;
    sl_cover_problem problem = {0};
    sli_cover cover = {0};
    cutter c = {.a = a, .cover = &cover, .chosen = chosen};
    c.bits = sl_alloc_array(a->context, a->task->place_count, 1);
    c.near = sl_alloc_array(a->context, a->group_count, 1);
    sl_status status = c.bits && c.near ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = sli_area_problem(a, true, &problem);
    if (status == SL_OK) status = sli_cover_read(a->context, &problem, 1, &cover);
    if (status == SL_OK) status = add_rows(&c, parts, added);
    sli_cover_destroy(a->context, &cover);
    sli_area_problem_destroy(a->context, &problem);
    sl_free(a->context, c.bits);
    sl_free(a->context, c.near);
    return status;
}

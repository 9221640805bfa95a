/// Cuts directions into sectors, and puts cells into an order for each sector.
///
/// The order comes from Tarjan's search for strongly connected components (1972, Depth-First Search
/// and Linear Graph Algorithms): one walk over the graph of cells, linear in time and memory. Cells
/// that depend on each other round a cycle are one component. Components come out with those that
/// they depend on before them.
#include "cell_to_cell/search/sectors.h"

#include "cell_to_cell/methods.h"
#include "geometry/length.h"
#include "sightline/support.h"

#include <stdlib.h>
#include <string.h>

// --- sectors of directions

/// A direction within the half-turn from +x, that included, and what is known of it.
typedef struct candidate {
    sl_line line;
    double length; ///< of all portals along it; only which are kept depends on its rounding
    bool axis;
} candidate;

/// The same line's direction within the half-turn from +x.
static sl_line upwards(sl_point a, sl_point b) {
    const bool up = a.y != b.y ? b.y > a.y : b.x > a.x;
    return up ? (sl_line){a, b} : (sl_line){b, a};
}

static int by_angle(const void *a, const void *b) {
    const candidate *p = a, *q = b;
    return -sli_turn(p->line.a, p->line.b, q->line.a, q->line.b);
}

/// Axes first, then the longer ones; of equal length by angle, so that the order is a total one.
static int by_worth(const void *a, const void *b) {
    const candidate *p = a, *q = b;
    if (p->axis != q->axis) return p->axis ? -1 : 1;
    if (p->length != q->length) return p->length > q->length ? -1 : 1;
    return by_angle(a, b);
}

/// Sorted by angle, each direction once.
static size_t join_same(candidate *candidates, size_t count) {
    qsort(candidates, count, sizeof *candidates, by_angle);
    size_t kept = 0;
    for (size_t i = 1; i < count; i++) {
        if (by_angle(&candidates[kept], &candidates[i]) == 0) {
            candidates[kept].length += candidates[i].length;
            candidates[kept].axis |= candidates[i].axis;
        } else {
            candidates[++kept] = candidates[i];
        }
    }
    return kept + 1;
}

static size_t choose(const sl_space *space, uint32_t most, candidate *candidates) {
    const sl_point zero = {0, 0};
    size_t count = 0;
    candidates[count++] = (candidate){.line = {zero, {1, 0}}, .axis = true};
    candidates[count++] = (candidate){.line = {zero, {0, 1}}, .axis = true};
    for (uint32_t i = 0; i < space->portal_count; i++) {
        const sl_point a = space->portals[i].left, b = space->portals[i].right;
        candidates[count++] =
            (candidate){.line = upwards(a, b), .length = sli_length(b.x - a.x, b.y - a.y)};
    }
    count = join_same(candidates, count);
    if (!most || count <= most / 2) return count;
    qsort(candidates, count, sizeof *candidates, by_worth);
    count = most < 4 ? 2 : most / 2;
    qsort(candidates, count, sizeof *candidates, by_angle);
    return count;
}

sl_status sli_sectors_create(sl_context *context, const sl_space *space, uint32_t most,
                             sli_sectors *out) {
    candidate *candidates =
        sl_alloc_array(context, (size_t)space->portal_count + 2, sizeof *candidates);
    if (!candidates) return SL_NO_MEMORY;
    const size_t count = choose(space, most, candidates);
    sl_line *bounds = sl_alloc_array(context, 2 * count, sizeof *bounds);
    for (size_t i = 0; i < count && bounds; i++) {
        const sl_line line = candidates[i].line;
        bounds[i] = line;
        bounds[count + i] = (sl_line){line.b, line.a};
    }
    sl_free(context, candidates);
    if (!bounds) return SL_NO_MEMORY;
    *out = (sli_sectors){.count = (uint32_t)(2 * count), .bounds = bounds};
    return SL_OK;
}

void sli_sectors_destroy(sl_context *context, sli_sectors *sectors) {
    sl_free(context, sectors->bounds);
    *sectors = (sli_sectors){0};
}

// --- what depends on what

#define UNSEEN UINT32_MAX

/// One run of the search. Numbers are given as nodes are met, from 0.
typedef struct tarjan {
    const sli_dependence *graph;
    sli_order *order;
    uint32_t *number, *lowest; ///< by node
    uint32_t *next;            ///< by node: arc to look at next
    uint32_t *way, *open;      ///< nodes on the way down; nodes without a component, as met
    uint32_t way_count, open_count, met;
} tarjan;

static void enter(tarjan *t, uint32_t node) {
    t->number[node] = t->lowest[node] = t->met++;
    t->next[node] = t->graph->first[node];
    t->way[t->way_count++] = node;
    t->open[t->open_count++] = node;
}

/// All that was met since `node` and is still open is a component.
static void close_component(tarjan *t, uint32_t node) {
    sli_order *o = t->order;
    const uint32_t number = o->component_count++;
    uint32_t member, level = 0;
    do {
        member = t->open[--t->open_count];
        o->component[member] = number;
        o->nodes[o->count++] = member;
    } while (member != node);
    o->starts[number + 1] = o->count;
    for (uint32_t i = o->starts[number]; i < o->count; i++)
        for (uint32_t k = t->graph->first[o->nodes[i]]; k < t->graph->first[o->nodes[i] + 1]; k++) {
            const uint32_t other = o->component[t->graph->to[k]];
            if (other != number && o->level[other] >= level) level = o->level[other] + 1;
        }
    o->level[number] = level;
    if (level >= o->level_count) o->level_count = level + 1;
}

static void leave(tarjan *t, uint32_t node) {
    t->way_count--;
    if (t->lowest[node] == t->number[node]) close_component(t, node);
    if (!t->way_count) return;
    const uint32_t before = t->way[t->way_count - 1];
    if (t->lowest[node] < t->lowest[before]) t->lowest[before] = t->lowest[node];
}

static void search(tarjan *t, uint32_t root) {
    enter(t, root);
    while (t->way_count) {
        const uint32_t node = t->way[t->way_count - 1];
        if (t->next[node] == t->graph->first[node + 1]) {
            leave(t, node);
            continue;
        }
        const uint32_t to = t->graph->to[t->next[node]++];
        if (t->number[to] == UNSEEN)
            enter(t, to);
        else if (t->order->component[to] == UNSEEN && t->number[to] < t->lowest[node])
            t->lowest[node] = t->number[to];
    }
}

sl_status sli_order_create(sl_context *context, const sli_dependence *graph, sli_order *out) {
    const size_t count = graph->count;
    sli_order order = {.nodes = sl_alloc_array(context, count, sizeof *order.nodes),
                       .starts = sl_alloc_array(context, count + 1, sizeof *order.starts),
                       .component = sl_alloc_array(context, count, sizeof *order.component),
                       .level = sl_alloc_array(context, count, sizeof *order.level)};
    uint32_t *scratch = sl_alloc_array(context, count, 5 * sizeof *scratch);
    if (order.nodes && order.starts && order.component && order.level && scratch) {
        tarjan t = {.graph = graph,
                    .order = &order,
                    .number = scratch,
                    .lowest = scratch + count,
                    .next = scratch + 2 * count,
                    .way = scratch + 3 * count,
                    .open = scratch + 4 * count};
        for (size_t i = 0; i < count; i++) t.number[i] = order.component[i] = UNSEEN;
        for (uint32_t i = 0; i < graph->count; i++)
            if (t.number[i] == UNSEEN) search(&t, i);
        sl_free(context, scratch);
        *out = order;
        return SL_OK;
    }
    sl_free(context, scratch);
    sli_order_destroy(context, &order);
    return SL_NO_MEMORY;
}

void sli_order_destroy(sl_context *context, sli_order *order) {
    sl_free(context, order->nodes);
    sl_free(context, order->starts);
    sl_free(context, order->component);
    sl_free(context, order->level);
    *order = (sli_order){0};
}

// --- one pass

static bool faces(const sl_space *space, bool inside_only, uint32_t cell,
                  const sl_directed_portal *directed, sli_direction_sector cone) {
    if (!sli_looks_from(space, inside_only, cell) ||
        !sli_looks_from(space, inside_only, directed->cell))
        return false;
    return sli_direction_sector_cut(&cone, directed);
}

static sl_status fill(sl_context *context, const sl_space *space, bool inside_only,
                      sli_pass *pass) {
    for (uint32_t cell = 0; cell < space->cell_count; cell++) {
        const sl_cell *c = &space->cells[cell];
        for (uint32_t e = c->first_directed; e < c->first_directed + c->directed_count; e++) {
            pass->faces[e] = SLI_NO_FACE;
            if (!faces(space, inside_only, cell, &space->directed[e], pass->cone)) continue;
            pass->to[pass->face_count] = space->directed[e].cell;
            pass->faces[e] = pass->face_count++;
        }
        pass->first[cell + 1] = pass->face_count;
    }
    const sli_dependence graph = {space->cell_count, pass->first, pass->to};
    return sli_order_create(context, &graph, &pass->order);
}

sl_status sli_pass_create(sl_context *context, const sl_space *space, bool inside_only,
                          sli_direction_sector cone, sli_pass *out) {
    sli_pass pass = {.cone = cone,
                     .faces = sl_alloc_array(context, space->directed_count, sizeof *pass.faces),
                     .first =
                         sl_alloc_array(context, (size_t)space->cell_count + 1, sizeof *pass.first),
                     .to = sl_alloc_array(context, space->directed_count, sizeof *pass.to)};
    sl_status status = pass.faces && pass.first && pass.to ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = fill(context, space, inside_only, &pass);
    if (status == SL_OK)
        *out = pass;
    else
        sli_pass_destroy(context, &pass);
    return status;
}

void sli_pass_destroy(sl_context *context, sli_pass *pass) {
    sl_free(context, pass->faces);
    sl_free(context, pass->first);
    sl_free(context, pass->to);
    sli_order_destroy(context, &pass->order);
    *pass = (sli_pass){0};
}

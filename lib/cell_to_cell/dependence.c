#include "cell_to_cell/dependence.h"

#include "sightline/support.h"

#define UNSEEN UINT32_MAX

/// One run of the search. Numbers are given as nodes are met, from 0.
typedef struct tarjan {
    const sl_dependence *graph;
    sl_order *order;
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
    sl_order *o = t->order;
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

sl_status sl_order_create(sl_context *context, const sl_dependence *graph, sl_order *out) {
    const size_t count = graph->count;
    sl_order order = {.nodes = sl_alloc_array(context, count, sizeof *order.nodes),
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
    sl_order_destroy(context, &order);
    return SL_NO_MEMORY;
}

void sl_order_destroy(sl_context *context, sl_order *order) {
    sl_free(context, order->nodes);
    sl_free(context, order->starts);
    sl_free(context, order->component);
    sl_free(context, order->level);
    *order = (sl_order){0};
}

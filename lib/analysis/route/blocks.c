/// Blocks of cells: where a shortest way from one cell to another can lead at all.
///
/// A cell that alone joins two parts of the space parts it into blocks (biconnected components):
///
///         +-------+-----------+-------+      A way from A to E leaves D into the room R and comes
///         |   A   |     D     |   E   |      back to D only if R is its goal: cells are convex, so
///         +-------+----| |----+-------+      within D it is no longer to go straight on. A, D, E
///                 |     R     |              are on the way, and R is in a block that is not.
///                 +-----------+
///
/// Blocks and the cells between them form a tree. The ways from a cell to another one lie in the
/// blocks between the two in that tree, all others are left out. For a search by depth, cells have
/// numbers in the order in which they are met; all other portals of a cell lead to cells above and
/// below it in the tree of that search. A cell is in a block of its own below the one above it, if
/// nothing below it leads farther up (Hopcroft and Tarjan 1973, Algorithm 447).
#include "analysis/route/route.h"

#include <string.h>

/// A search by depth over all cells.
typedef struct descent {
    const sl_space *space;
    uint32_t *met;    ///< the cells, in the order in which they are met
    uint32_t *order;  ///< by cell: its number among them
    uint32_t *parent; ///< by cell; SLI_ROUTE_NONE for the first one of a part
    uint32_t *next;   ///< by cell: the directed portals that have been tried
    uint32_t *low;    ///< by cell: the least number that it and the cells below it lead to
    uint32_t count;
} descent;

static void meet(descent *d, uint32_t cell, uint32_t parent) {
    d->order[cell] = d->count;
    d->met[d->count++] = cell;
    d->parent[cell] = parent;
}

static void descend(descent *d, uint32_t first) {
    meet(d, first, SLI_ROUTE_NONE);
    for (uint32_t at = first; at != SLI_ROUTE_NONE;) {
        const sl_cell *cell = &d->space->cells[at];
        if (d->next[at] == cell->directed_count) {
            at = d->parent[at];
            continue;
        }
        const uint32_t to = d->space->directed[cell->first_directed + d->next[at]++].cell;
        if (d->order[to] != SLI_ROUTE_NONE) continue;
        meet(d, to, at);
        at = to;
    }
}

/// The least numbers, from the last cell to the first.
static void find_low(const descent *d) {
    for (uint32_t i = 0; i < d->count; i++) d->low[d->met[i]] = i;
    for (uint32_t i = d->count; i--;) {
        const uint32_t c = d->met[i], parent = d->parent[c];
        const sl_cell *cell = &d->space->cells[c];
        for (uint32_t k = 0; k < cell->directed_count; k++) {
            const uint32_t to = d->order[d->space->directed[cell->first_directed + k].cell];
            if (to < d->low[c]) d->low[c] = to;
        }
        if (parent != SLI_ROUTE_NONE && d->low[c] < d->low[parent]) d->low[parent] = d->low[c];
    }
}

/// The block above each cell.
static void find_blocks(const descent *d, sli_route_blocks *b) {
    uint32_t blocks = 0;
    for (uint32_t i = 0; i < d->count; i++) {
        const uint32_t c = d->met[i], parent = d->parent[c];
        if (parent == SLI_ROUTE_NONE) {
            b->above[c] = SLI_ROUTE_NONE;
            b->depth[c] = 0;
        } else if (d->low[c] < d->order[parent]) {
            b->above[c] = b->above[parent];
            b->depth[c] = b->depth[parent];
        } else {
            b->top[blocks] = parent;
            b->above[c] = blocks++;
            b->depth[c] = b->depth[parent] + 1;
        }
    }
    for (uint32_t i = 0; i < d->space->portal_count; i++) {
        const uint32_t *ends = d->space->portals[i].cell;
        b->of[i] = b->above[ends[d->order[ends[1]] > d->order[ends[0]]]];
    }
}

sl_status sli_route_find_blocks(sl_context *context, sl_route_finder *f) {
    const uint32_t cells = f->space->cell_count;
    sli_route_blocks *b = &f->blocks;
    if (f->has_glass) return SL_OK;
    descent d = {.space = f->space, .met = f->list};
    d.order = sl_alloc_array(context, cells, sizeof *d.order);
    d.parent = sl_alloc_array(context, cells, sizeof *d.parent);
    d.next = sl_alloc_array(context, cells, sizeof *d.next);
    d.low = sl_alloc_array(context, cells, sizeof *d.low);
    b->of = sl_alloc_array(context, f->space->portal_count, sizeof *b->of);
    b->above = sl_alloc_array(context, cells, sizeof *b->above);
    b->depth = sl_alloc_array(context, cells, sizeof *b->depth);
    b->top = sl_alloc_array(context, cells, sizeof *b->top);
    b->stamp = sl_alloc_array(context, cells, sizeof *b->stamp);
    const bool found = d.order && d.parent && d.next && d.low && b->of && b->above && b->depth &&
                       b->top && b->stamp;
    if (found) {
        memset(d.order, 0xff, cells * sizeof *d.order);
        for (uint32_t c = 0; c < cells; c++)
            if (d.order[c] == SLI_ROUTE_NONE) descend(&d, c);
        find_low(&d);
        find_blocks(&d, b);
    }
    sl_free(context, d.order);
    sl_free(context, d.parent);
    sl_free(context, d.next);
    sl_free(context, d.low);
    return found ? SL_OK : SL_NO_MEMORY;
}

void sli_route_drop_blocks(sl_context *context, sli_route_blocks *b) {
    sl_free(context, b->of);
    sl_free(context, b->above);
    sl_free(context, b->depth);
    sl_free(context, b->top);
    sl_free(context, b->stamp);
    *b = (sli_route_blocks){0};
}

void sli_route_open_blocks(sl_route_finder *f, uint32_t from, uint32_t to) {
    sli_route_blocks *b = &f->blocks;
    while (b->of && from != to) {
        const uint32_t above = b->depth[from] < b->depth[to] ? b->above[to] : b->above[from];
        b->stamp[above] = f->stamp;
        if (b->above[from] == b->above[to]) return;
        if (b->depth[from] < b->depth[to])
            to = b->top[above];
        else
            from = b->top[above];
    }
}

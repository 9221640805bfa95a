#include "cell_to_cell/tree_store.h"

#include <string.h>

sl_status sl_tree_store_create(sl_context *context, uint32_t cell_count, uint64_t limit,
                               sl_tree_store *store) {
    *store = (sl_tree_store){.cell_count = cell_count, .limit = limit};
    store->trees = sl_alloc_array(context, cell_count, sizeof *store->trees);
    if (!store->trees) return SL_NO_MEMORY;
    pthread_mutex_init(&store->lock, NULL);
    return SL_OK;
}

void sl_tree_store_destroy(sl_context *context, sl_tree_store *store) {
    if (!store->trees) return;
    for (uint32_t i = 0; i < store->cell_count; i++) sl_free(context, store->trees[i].nodes);
    sl_free(context, store->trees);
    store->trees = NULL;
    pthread_mutex_destroy(&store->lock);
}

sl_status sl_tree_grow(sl_context *context, const sl_tree_store *store, sl_growing_tree *tree,
                       sl_stab_node node) {
    if (tree->overflown) return SL_OK;
    if (tree->nodes.count == UINT32_MAX || (tree->nodes.count + 1) * sizeof node > store->limit) {
        tree->overflown = true;
        return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(context, &tree->nodes, 1));
    tree->nodes.items[tree->nodes.count++] = node;
    return SL_OK;
}

static void let_largest_go(sl_context *context, sl_tree_store *store) {
    struct sl_kept_tree *largest = &store->trees[0];
    for (uint32_t i = 1; i < store->cell_count; i++)
        if (store->trees[i].count >= largest->count) largest = &store->trees[i];
    store->held -= largest->count * sizeof(sl_stab_node);
    sl_free(context, largest->nodes);
    *largest = (struct sl_kept_tree){0};
}

void sl_tree_store_put(sl_context *context, sl_tree_store *store, uint32_t source,
                       sl_growing_tree *tree) {
    if (tree->overflown)
        sl_free(context, tree->nodes.items);
    else {
        pthread_mutex_lock(&store->lock);
        store->trees[source] =
            (struct sl_kept_tree){.nodes = tree->nodes.items, .count = tree->nodes.count};
        store->held += tree->nodes.count * sizeof(sl_stab_node);
        while (store->held > store->limit) let_largest_go(context, store);
        pthread_mutex_unlock(&store->lock);
    }
    *tree = (sl_growing_tree){0};
}

sl_status sl_tree_store_join(sl_context *context, const sl_tree_store *store, sl_stab_trees *out) {
    const uint32_t count = store->cell_count;
    uint64_t *offsets = sl_alloc_array(context, (size_t)count + 1, sizeof *offsets);
    sl_stab_node *nodes = sl_alloc_array(context, store->held / sizeof *nodes, sizeof *nodes);
    if (!offsets || !nodes) {
        sl_free(context, offsets);
        sl_free(context, nodes);
        return SL_NO_MEMORY;
    }
    uint32_t left_out = 0;
    for (uint32_t i = 0; i < count; i++) {
        const struct sl_kept_tree *tree = &store->trees[i];
        if (tree->count) memcpy(nodes + offsets[i], tree->nodes, tree->count * sizeof *nodes);
        left_out += tree->count == 0;
        offsets[i + 1] = offsets[i] + tree->count;
    }
    *out = (sl_stab_trees){
        .cell_count = count, .left_out = left_out, .offsets = offsets, .nodes = nodes};
    return SL_OK;
}

/// The stab trees of a bake, within a limit on memory. Smaller trees are kept before larger ones,
/// so that what is kept does not depend on the order in which threads bring them.
#ifndef SL_TREE_STORE_H
#define SL_TREE_STORE_H

#include "sightline/cell_to_cell.h"
#include "sightline/support.h"

#include <pthread.h>

/// A tree while it grows. `overflown`: larger than the limit by itself, and no longer recorded.
typedef struct sl_growing_tree {
    SL_ARRAY(sl_stab_node) nodes;
    bool overflown;
} sl_growing_tree;

typedef struct sl_tree_store {
    pthread_mutex_t lock;
    uint32_t cell_count;
    uint64_t limit, held; ///< bytes
    struct sl_kept_tree {
        sl_stab_node *nodes;
        uint64_t count;
    } * trees;
} sl_tree_store;

sl_status sl_tree_store_create(sl_context *context, uint32_t cell_count, uint64_t limit,
                               sl_tree_store *store);
void sl_tree_store_destroy(sl_context *context, sl_tree_store *store);

/// Adds a node to a growing tree; does nothing once the tree is larger than the limit.
sl_status sl_tree_grow(sl_context *context, const sl_tree_store *store, sl_growing_tree *tree,
                       sl_stab_node node);

/// Takes a finished tree (its nodes are the store's then) and lets the largest go while too much is
/// held. Safe from several threads.
void sl_tree_store_put(sl_context *context, sl_tree_store *store, uint32_t source,
                       sl_growing_tree *tree);

/// Joins what was kept, in the sources' order.
sl_status sl_tree_store_join(sl_context *context, const sl_tree_store *store, sl_stab_trees *out);

#endif

/// The depth-first search: what its two forms share, the plain one and the one with effects, and
/// the stab trees that it leaves.
#ifndef SL_DFS_H
#define SL_DFS_H

#include "cell_to_cell/methods.h"
#include "cell_to_cell/pvs_rows.h"
#include "cell_to_cell/search/bounds.h"
#include "cell_to_cell/search/directions.h"
#include "cell_to_cell/search/portal_search.h"
#include "sightline/cell_to_cell.h"
#include "sightline/support.h"

#include <pthread.h>

// --- stab trees

/// A tree while it grows. `overflown`: larger than the limit by itself, and no longer recorded.
typedef struct sli_growing_tree {
    SL_ARRAY(sl_stab_node) nodes;
    bool overflown;
} sli_growing_tree;

typedef struct sli_tree_store {
    pthread_mutex_t lock;
    uint32_t cell_count;
    uint64_t limit, held; ///< bytes
    struct sli_kept_tree {
        sl_stab_node *nodes;
        uint64_t count;
    } * trees;
} sli_tree_store;

// --- the search

/// A cell on the way from the source.
typedef struct sli_dfs_step {
    sli_portal_step at;
    uint32_t node; ///< in the stab tree
    bool grazing;  ///< the sequence is no more than grazed
} sli_dfs_step;

/// What is known of direct sight before a search with effects begins. Both have each cell with
/// itself.
typedef struct sli_dfs_known {
    const sl_pvs *possible; ///< no other pairs are seen
    const sl_pvs *certain;  ///< of them those that are, through no door
} sli_dfs_known;

/// All searches together.
typedef struct sli_dfs {
    const sl_space *space;
    const sl_see_options *options;
    sli_tree_store trees;
    sli_row_bytes *sure;     ///< by source: seen whatever rounding did
    sli_row_bytes *doubtful; ///< by source: seen unless rounding erred
    sl_see_account *accounts;
    pthread_mutex_t lock;
    sl_stab_account stab;     ///< of all solvers, under the lock
    const sl_partial *before; ///< what is known; NULL: nothing, and all is to be done
    uint8_t *done;            ///< by source, where there is `before`
    bool prunes;
    const sli_dfs_known *known;     ///< NULL: nothing; else it prunes
    size_t words;                   ///< of a set of cells
    sli_prune_bounds bounds;        ///< where it prunes
    struct sl_dfs_effects *effects; ///< where the plan has any, all that is done for them
} sli_dfs;

/// One thread's own.
typedef struct sli_dfs_thread {
    sli_portal_search search;
    sl_bits *sure, *doubtful;
    sli_prune_wanted wanted; ///< where it prunes: what may be seen beyond each step
    sli_growing_tree tree;
    sl_see_account account; ///< of the source at hand
    struct sl_dfs_effects_thread *effects;
} sli_dfs_thread;

/// The depth-first search with effects, for the pairs that are possible and not certain, and for
/// what is seen by mirror.
sl_status sli_dfs_see_rest(sl_context *context, const sl_space *space,
                           const sl_see_options *options, const sli_dfs_known *known,
                           sl_visibility *out);

/// Both searches' job for a visitor: one source at a time.
typedef struct sli_dfs_job {
    const sli_dfs *all;
    sli_dfs_thread *me;
} sli_dfs_job;

/// Enters the step that stands behind the last one. A sequence that counts as seen becomes a node
/// of the stab tree below `parent`, of which `directed` is as in sl_stab_node.
sl_status sli_dfs_enter(sl_context *context, const sli_dfs *all, sli_dfs_thread *me,
                        sli_dfs_step *to, uint32_t parent, uint32_t directed, bool counts);

/// The search with effects (dfs_effects.c). What it finds beside the sets of cells seen goes to the
/// visibility at the end.
sl_status sli_dfs_effects_create(sl_context *context, sli_dfs *all);
void sli_dfs_effects_destroy(sl_context *context, sli_dfs *all);
sl_status sli_dfs_effects_begin(sl_context *context, const sli_dfs *all, sli_dfs_thread *me);
void sli_dfs_effects_end(sl_context *context, sli_dfs_thread *me);
sl_status sli_dfs_effects_search(sl_context *context, const sli_dfs *all, sli_dfs_thread *me,
                                 uint32_t source);
sl_status sli_dfs_effects_finish(sl_context *context, sli_dfs *all, sl_visibility *out);
/// The same into partial results, for sli_dfs_effects_settle().
sl_status sli_dfs_effects_hand_over(sl_context *context, sli_dfs *all, sl_partial *found);
/// Adds to a visibility copies of what partial results have of effects.
sl_status sli_dfs_effects_settle(sl_context *context, const sl_plan *plan,
                                 const sl_partial *partial, sl_visibility *out);

/// SL_CANCELLED if the search is to stop. It asks from time to time.
static inline sl_status sli_dfs_check_going_on(sl_context *context, const sli_dfs *all) {
    SL_TRY(sl_check_cancelled(context));
    return all->before && sli_is_enough(all->options) ? SL_CANCELLED : SL_OK;
}

#endif

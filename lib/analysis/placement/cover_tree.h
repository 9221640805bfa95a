/// What the files of the branching tree share. Begin with cover_tree.c.
#ifndef SLI_COVER_TREE_H
#define SLI_COVER_TREE_H

#include "analysis/placement/cover.h"

/// A node counts as one for so many entries of its part.
enum { SLI_COVER_NODE_ENTRIES = 512 };

/// Simplex steps times entries that the program may take for a node: some seconds.
#define SLI_COVER_NODE_WORK ((uint64_t)1 << 28)

typedef struct sli_cover_fixed {
    uint32_t column;
    uint8_t how;
    size_t duals; ///< SIZE_MAX: a row takes all that it has
} sli_cover_fixed;

/// What it did to the bound to leave a column [0] or to take it [1], for all of it.
typedef struct sli_cover_effect {
    double sums[2];
    uint32_t tries;
} sli_cover_effect;

/// A column to branch on, and what is expected of it.
typedef struct sli_cover_prospect {
    double score;
    uint32_t column;
} sli_cover_prospect;

typedef struct sli_cover_tree {
    sli_cover_part *part;
    const sli_cover *cover;   ///< the part's, or that with cuts
    sl_cover_problem problem; ///< the same for the program
    sli_cover_state state;
    void *program; ///< its state; NULL: none
    uint64_t target, *nodes_left;
    uint64_t least; ///< bound of all leaves so far
    bool spent;
    SL_ARRAY(sli_cover_fixed) fixes;
    bool *needed;   ///< by column: some bound counts on its being left
    int64_t *sums;  ///< by column, of the last bound
    double *y;      ///< by row
    double *values; ///< by column
    uint8_t *set;   ///< by column
    // To choose a column to branch on.
    sli_cover_effect *effects, all_effects; ///< by column, and of all
    sli_cover_prospect *prospects;
    double *tried_y, *tried_values;
    uint64_t *tried_duals;
} sli_cover_tree;

/// Pays for a node, by its work; false where too few are left.
bool sli_cover_pay(sli_cover_tree *tree);

/// The column to branch on (cover_choose.c), where `bound` is that of the state.
sl_status sli_cover_choose(sl_context *context, sli_cover_tree *tree, int64_t bound,
                           uint32_t *column);

#endif

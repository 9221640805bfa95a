/// Upper bounds on what is seen. A bound never misses a visible pair.
#ifndef SL_BOUNDS_H
#define SL_BOUNDS_H

#include "cell_to_cell/rows.h"
#include "sightline/cell_to_cell.h"
#include "sightline/support.h"

// --- by signs of portals in pairs

/// Adds to an empty set all cells that a sightline through the directed portal may reach: never
/// misses one, but gives up where they are more than `most`. They are listed in `found`, which has
/// room for all cells, and counted.
uint32_t sli_flood_through(const sl_space *space, const sl_see_options *options,
                           const sl_directed_portal *directed, uint32_t most, sl_bits *set,
                           uint32_t *found);

/// The bound on what all cells see, symmetric. Once options.enough says so there is none but
/// what portals join: *bounded is then false.
sl_status sli_flood_bound(sl_context *context, const sl_space *space, const sl_see_options *options,
                          sl_pvs *out, bool *bounded);

/// The bound on what all cells see by mirror, up to the plan's depth: what cells see from which a
/// line may come back. `direct` bounds what they see directly. Lengths are not asked for.
sl_status sli_mirrored_bound(sl_context *context, const sl_space *space,
                             const sl_see_options *options, const sl_pvs *direct, sl_pvs *out);

// --- by the view range

/// Whether lines between two cells, from where they leave the one to where they enter the other,
/// are within the range: ordered by how far apart the cells are.
typedef enum sli_cells_apart {
    SLI_ALL_WITHIN, ///< all are
    SLI_SOME_WITHIN,
    SLI_NONE_WITHIN, ///< none is, nor within rounding of it
} sli_cells_apart;

/// The pairs of `pvs` whose cells are no farther apart than `most`.
sl_status sli_pvs_within(sl_context *context, const sl_space *space, const sl_pvs *pvs,
                         double range, sli_cells_apart most, sl_pvs *out);

// --- what a search has left to find

/// A word of a set of cells that has some: cells 64 * word on.
typedef struct sli_prune_word {
    sl_bits bits;
    uint32_t word;
} sli_prune_word;

/// Upper bounds: that of a directed portal is words[offsets[directed portal] .. offsets[directed
/// portal + 1]), ascending; none where that is empty, and all may be seen through it. Zeroed, it is
/// empty.
typedef struct sli_prune_bounds {
    size_t *offsets;
    SL_ARRAY(sli_prune_word) words;
} sli_prune_bounds;

/// Finds the bounds of all directed portals: what the cell behind may see by `possible`; where that
/// is NULL those of sli_flood_through, but where space and sets are large not those of directed
/// portals through which much may be seen, so that memory grows with the number of directed
/// portals. `out` is to be destroyed also on failure.
sl_status sli_prune_bounds_find(sl_context *context, const sl_space *space,
                                const sl_see_options *options, const sl_pvs *possible,
                                sli_prune_bounds *out);
void sli_prune_bounds_destroy(sl_context *context, sli_prune_bounds *bounds);

/// What is wanted at a step.
typedef struct sli_prune_set {
    size_t begin, end; ///< of the words
    size_t top;        ///< words behind here are free
    bool all;          ///< all cells from the first one on, and no words
} sli_prune_set;

/// What is wanted at each step of a search, one thread's own. Zeroed, it is empty.
typedef struct sli_prune_wanted {
    uint32_t first; ///< cells below it are not wanted
    SL_ARRAY(sli_prune_set) sets;
    SL_ARRAY(sli_prune_word) words;
} sli_prune_wanted;

/// Begins with all cells from the first one on, at step 0.
sl_status sli_prune_start(sl_context *context, sli_prune_wanted *wanted, uint32_t first);

/// Begins with the members of a row from the first cell on.
sl_status sli_prune_start_with(sl_context *context, sli_prune_wanted *wanted, const sl_pvs *pvs,
                               uint32_t cell, uint32_t first);

/// Begins with the members of a set.
sl_status sli_prune_start_among(sl_context *context, sli_prune_wanted *wanted,
                                const sli_word_set *set);

/// Makes the set of a step: what is wanted at the step before it and within a directed portal's
/// bound. Later steps are forgotten.
sl_status sli_prune_step(sl_context *context, const sli_prune_bounds *bounds,
                         sli_prune_wanted *wanted, size_t step, uint32_t directed);

/// Makes the set of a step that no bound before it holds for: all cells from the first one on.
sl_status sli_prune_step_anew(sl_context *context, sli_prune_wanted *wanted, size_t step);

/// As sli_prune_step(), within a row, which bounds nothing where it is empty; after
/// sli_prune_start_among only.
sl_status sli_prune_step_within(sl_context *context, const sli_sparse_row *row,
                                sli_prune_wanted *wanted, size_t step);

void sli_prune_wanted_destroy(sl_context *context, sli_prune_wanted *wanted); ///< and zeroes it

#endif

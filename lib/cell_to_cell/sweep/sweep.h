/// The sweep: what it does at one fan, and how its forms share the run over all fans (sweep.c).
#ifndef SL_SWEEP_H
#define SL_SWEEP_H

#include "cell_to_cell/methods.h"
#include "cell_to_cell/rows.h"
#include "cell_to_cell/sweep/visible.h"

#include <pthread.h>

/// A cell of a fan, and what of its sector is looked through.
typedef struct sli_fan_sector {
    uint32_t cell;
    sli_bound low, high;
    bool thin; ///< the bounds are the same angle
} sli_fan_sector;

/// Without one-way glass there is one set of fans, with it there are three.
enum { SLI_MOST_FAN_SETS = 3 };

/// Scratch of one thread.
typedef struct sli_sweeper {
    const sli_fans *fans;
    const sli_fans *inward,
        *outward; ///< whose directed portals the line's backward half and its forward half
                  ///< go through; the fans' own, but for one-way glass
    bool closed;
    sli_bit_rows rows;                    ///< what it finds: a fork
    sli_bit_rows seen_from;               ///< for one-way glass: from where cells are seen, a fork
    sli_bit_rows *back_rows, *ahead_rows; ///< get what the backward half and the forward half see
                                          ///< of each other; `rows`, but for one-way glass
    sli_visible_finder finder;
    sli_visible back, middle, ahead;
    sli_rays rays;
    sli_rays looks; ///< for one-way glass: what is seen through each cell of the fan at hand
    SL_ARRAY(uint32_t) passing; ///< scratch: cells that are seen along one ray only
    SL_ARRAY(sli_fan_sector) sectors;
    sli_word_set behind, before;
} sli_sweeper;

static inline void sli_visible_add_to(sli_word_set *set, const sli_visible *visible) {
    for (size_t i = 0; i < visible->cells.count; i++)
        sli_word_set_add(set, visible->cells.items[i].cell);
}

/// `rows`, and `seen_from` where there is one-way glass: empty, or shared with other threads. To be
/// destroyed also on failure.
sl_status sli_sweeper_create(sl_context *context, const sli_fans *fans, bool closed,
                             const sli_bit_rows *rows, const sli_bit_rows *seen_from,
                             sli_sweeper *sweeper);
/// Its rows must have been joined.
void sli_sweeper_destroy(sl_context *context, sli_sweeper *sweeper);

/// The first and the last direction of a sector between two edges. Directions along an edge belong
/// to rays.
static inline sli_bound sli_after_edge(const sli_sweeper *sweeper, uint32_t end) {
    return (sli_bound){.end = end, .rank = sweeper->closed ? SLI_COUNTER : SLI_AFTER};
}

static inline sli_bound sli_before_edge(const sli_sweeper *sweeper, uint32_t end) {
    return (sli_bound){.end = end, .rank = sweeper->closed ? SLI_CLOCKWISE : SLI_BEFORE};
}

/// Adds to the rows all pairs that lines through the fan's point join while it turns beside the
/// walls' corner, and what the point sees for the cells that it covers. Pairs may be added one way
/// only.
sl_status sli_sweep_fan(sl_context *context, sli_sweeper *sweeper, const sli_fan *fan);

/// A sweep: sets of fans, and what is done at each fan. All threads share it.
typedef struct sli_sweep {
    const sl_space *space;
    const sl_see_options *options;
    sli_fans fans[SLI_MOST_FAN_SETS]; ///< the first has the ends and cells of all
    uint32_t fan_sets;
    sl_status (*visit)(sl_context *context, const struct sli_sweep *all, sli_sweeper *sweeper,
                       uint32_t set, const sli_fan *fan);
    const sl_partial *before; ///< what is known; NULL: nothing, and all is to be done
    uint8_t *done;            ///< by fan, where there is `before`; each is written by one thread
    pthread_mutex_t lock;
    sli_bit_rows rows, seen_from; ///< joined from the threads' forks, under the lock
    uint64_t pieces;
    uint32_t deepest;
} sli_sweep;

/// Visits all fans, by all threads.
sl_status sli_sweep_run(sl_context *context, sli_sweep *all);

/// Makes a whole result: `find` fills the rows, from what the sweep has to begin with.
sl_status sli_sweep_see(sl_context *context, const sl_space *space, const sl_see_options *options,
                        sl_status (*find)(sl_context *context, sli_sweep *all, sl_visibility *out),
                        sl_visibility *out);

/// The sweep where the map has one-way glass (sweep_oneway.c).
sl_status sli_see_sweep_one_way(sl_context *context, const sl_space *space,
                                const sl_see_options *options, sl_visibility *out);

/// The sweep where the map has doors, mirrors or a view range (sweep_effects.c).
sl_status sli_see_sweep_finished(sl_context *context, const sl_space *space,
                                 const sl_see_options *options, sl_visibility *out);

/// Makes the result of all that was found: adds that each cell sees itself and through each of its
/// portals the cell behind, and that pairs are mutual where the plan is. Sets the PVS and its
/// count.
sl_status sli_sweep_finish(sl_context *context, const sl_space *space,
                           const sl_see_options *options, sli_bit_rows *rows, sl_visibility *out);

#endif

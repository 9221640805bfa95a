/// The turning line at one fan: what the sweep does for each.
#ifndef SL_SWEEP_H
#define SL_SWEEP_H

#include "cell_to_cell/reach.h"
#include "cell_to_cell/rows.h"

/// A cell of a fan, and what of its sector is looked through.
typedef struct sl_sector {
    uint32_t cell;
    sl_bound low, high;
    bool thin; ///< the bounds are the same angle
} sl_sector;

/// Scratch of one thread.
typedef struct sl_sweeper {
    const sl_fans *fans;
    const sl_fans *inward,
        *outward; ///< whose directed portals the line's backward half and its forward half
                  ///< go through; the fans' own, but for one-way glass
    bool closed;
    sl_bit_rows rows;                    ///< what it finds: a fork
    sl_bit_rows *back_rows, *ahead_rows; ///< that get what the backward half and the forward half
                                         ///< see, of the other; `rows`, but for one-way glass
    sl_reacher reacher;
    sl_reach back, middle, ahead;
    sl_rays rays;
    SL_ARRAY(uint32_t) passing; ///< scratch: cells that are seen along one ray only
    SL_ARRAY(sl_sector) sectors;
    sl_word_set behind, before;
} sl_sweeper;

/// `rows`: empty, or shared with other threads. To be destroyed also on failure.
sl_status sl_sweeper_create(sl_context *context, const sl_fans *fans, bool closed,
                            const sl_bit_rows *rows, sl_sweeper *sweeper);
/// `sweeper->rows` must have been joined.
void sl_sweeper_destroy(sl_context *context, sl_sweeper *sweeper);

/// Adds to the rows all pairs that lines through the fan's point join while it turns beside the
/// walls' corner, and what the point sees for the cells that it serves. Pairs may be added one way
/// only.
sl_status sl_sweep_fan(sl_context *context, sl_sweeper *sweeper, const sl_fan *fan);

/// About how much sparse rows will take when all fans are swept, half as much or twice as much.
/// Some fans are swept for it.
sl_status sl_sweep_estimate(sl_context *context, const sl_fans *fans, bool closed,
                            sl_bit_rows *rows, uint64_t *bytes);

/// Turns the line: adds the pairs of what is seen by both its halves.
sl_status sl_sweep_turn(sl_context *context, sl_sweeper *sweeper, const sl_fan *fan);

/// The sweep where the map has one-way glass (sweep_oneway.c).
sl_status sl_see_sweep_one_way(sl_context *context, const sl_space *space,
                               const sl_see_options *options, sl_visibility *out);

/// The sweep where the map has doors or a view range (sweep_effects.c).
sl_status sl_see_sweep_finished(sl_context *context, const sl_space *space,
                                const sl_see_options *options, sl_visibility *out);

/// Makes the result of all that was found: adds that each cell sees itself and through each of its
/// portals the cell behind, and that pairs are mutual where the plan is. Sets the PVS and its
/// count.
sl_status sl_sweep_finish(sl_context *context, const sl_space *space, const sl_see_options *options,
                          sl_bit_rows *rows, sl_visibility *out);

#endif

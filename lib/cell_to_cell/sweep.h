/// The turning line at one fan: what the sweep does for each.
#ifndef SL_SWEEP_H
#define SL_SWEEP_H

#include "cell_to_cell/bit_rows.h"
#include "cell_to_cell/reach.h"

/// A set of cells and the words in which it may have any.
typedef struct sl_word_set {
    sl_bits *bits;
    size_t low, high; ///< words low .. high - 1
} sl_word_set;

/// A start of reach.cells, and the rays along the first and the last edge of the cell of the fan.
typedef struct sl_fan_rays {
    uint32_t first, last; ///< of the rays; UINT32_MAX for none
} sl_fan_rays;

/// Scratch of one thread.
typedef struct sl_sweeper {
    const sl_fans *fans;
    bool closed;
    sl_bit_rows rows; ///< what it finds
    sl_reacher reacher;
    sl_reach back, middle, ahead;
    sl_rays rays;
    SL_ARRAY(sl_fan_rays) rays_of; ///< by cell of the fan
    SL_ARRAY(uint32_t) passing;    ///< scratch: cells that are seen along one ray only
    sl_word_set behind, before;
} sl_sweeper;

sl_status sl_sweeper_create(sl_context *context, const sl_fans *fans, bool closed,
                            sl_sweeper *sweeper);
void sl_sweeper_destroy(sl_context *context, sl_sweeper *sweeper);

/// Adds to the rows all pairs that lines through the fan's point join while it turns beside the
/// walls' corner, and what the point sees for the cells that it serves. Pairs may be added one way
/// only.
sl_status sl_sweep_fan(sl_context *context, sl_sweeper *sweeper, const sl_fan *fan);

/// Turns the line: adds the pairs of what is seen by both its halves.
sl_status sl_sweep_turn(sl_context *context, sl_sweeper *sweeper, const sl_fan *fan);

/// Adds a set to the row of a cell.
void sl_sweep_add(sl_sweeper *sweeper, uint32_t cell, const sl_word_set *set);
void sl_word_set_add(sl_word_set *set, uint32_t cell);
void sl_word_set_clear(sl_word_set *set);

#endif

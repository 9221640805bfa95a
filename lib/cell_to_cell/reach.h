/// What is seen from a point, sorted by direction: cells, each over one or more intervals of angle.
///
/// Closed sight needs two directions for each angle: the line there, about to turn clockwise, and
/// the same about to turn counter-clockwise (sweep.c says why). Together with "before both" and
/// "after both", which are the bounds of open intervals, an angle has four levels.
#ifndef SL_REACH_H
#define SL_REACH_H

#include "cell_to_cell/fans.h"

enum { SL_BEFORE = -2, SL_CLOCKWISE = -1, SL_COUNTER = 1, SL_AFTER = 2 };

/// An end of an interval of directions: from the point towards `at`, which is the fans' or the
/// caller's to keep, or away from it.
typedef struct sl_bound {
    const sl_point *at;
    int8_t level;
    bool away;
} sl_bound;

/// A cell that is seen from turns[enter] to turns[leave], both at their levels included.
typedef struct sl_reached {
    uint32_t cell, enter, leave;
    uint32_t next; ///< that leaves at the same turn; UINT32_MAX for none
    int8_t enter_level, leave_level;
    bool start;   ///< the point is a corner of the cell
    bool touched; ///< for its user: it counts where the line touches it in the point alone
} sl_reached;

/// A direction in which cells are entered or left.
typedef struct sl_reach_turn {
    const sl_point *at;
    bool away;
    uint32_t ray;   ///< of sl_reach.rays; UINT32_MAX for none
    uint32_t leave; ///< the first cell that is left here; UINT32_MAX for none
} sl_reach_turn;

/// Cells seen along one edge of the fan alone: ray r has cells[rays[r] .. rays[r + 1]).
typedef struct sl_rays {
    SL_ARRAY(uint32_t) starts;
    SL_ARRAY(uint32_t) cells;
} sl_rays;

/// Counter-clockwise: turns in their order, cells in the order in which they are entered.
typedef struct sl_reach {
    SL_ARRAY(sl_reach_turn) turns;
    SL_ARRAY(sl_reached) cells;
} sl_reach;

/// A piece of the search: the rest of the exits of a cell, seen between two directions.
typedef struct sl_reach_step {
    uint32_t next, left; ///< exit to look at next, and how many are left
    uint32_t first, end; ///< the cell's exits
    uint32_t found;      ///< of sl_reach.cells
    sl_bound low, high;
    bool thin;    ///< low and high are the same angle
    bool crossed; ///< an exit has been crossed beyond `low`
} sl_reach_step;

/// Scratch of one thread, for one point at a time.
typedef struct sl_reacher {
    const sl_fans *fans;
    bool closed;
    sl_point from;
    uint32_t *last;    ///< by cell: where it may stand in what is being found
    uint32_t *on_rays; ///< by cell: where it may stand among the cells of rays
    SL_ARRAY(sl_reach_step) steps;
    uint64_t pieces; ///< done so far
    uint32_t deepest;
} sl_reacher;

sl_status sl_reacher_create(sl_context *context, const sl_fans *fans, bool closed,
                            sl_reacher *reacher);
void sl_reacher_destroy(sl_context *context, sl_reacher *reacher);

/// Adds what is seen of the world through a cell of a fan between two directions within its sector,
/// the cell included. Cells of a fan must be added in their order. `begin`: the cell's exits in
/// their order from the point start there. The bounds are no edges' directions but for those that
/// the levels of open intervals exclude.
sl_status sl_reach_add(sl_context *context, sl_reacher *reacher, const sl_fan_cell *cell,
                       sl_bound low, sl_bound high, bool thin, sl_reach *reach);

/// An edge of a fan's cell: the first, about which the line turns clockwise, or the last,
/// counter-clockwise.
typedef struct sl_fan_edge {
    const sl_fan_cell *cell;
    const sl_point *edge;
    bool last;
} sl_fan_edge;

/// Adds one ray: what is seen from a cell of a fan along an edge. `known`: what was found last, in
/// which the edge is a turn's direction, or NULL; what it has at that moment is left out.
sl_status sl_rays_add(sl_context *context, sl_reacher *reacher, sl_fan_edge along,
                      const sl_reach *known, uint32_t turn, sl_rays *rays);

void sl_reach_clear(sl_reach *reach);
void sl_reach_destroy(sl_context *context, sl_reach *reach);
void sl_rays_destroy(sl_context *context, sl_rays *rays);

/// Compares the directions of two turns seen from a point, the second turned by half a turn, both
/// within half a turn from `first` on: -1, 0, 1.
int sl_turns_compare(sl_point from, const sl_point *first, const sl_reach_turn *a,
                     const sl_reach_turn *b);

#endif

/// What is seen from a point: cells, each over one or more intervals of angle.
///
/// Closed sight needs two directions for each angle: the line there, about to turn clockwise, and
/// the same about to turn counter-clockwise (sweep.c says why). Together with "before both" and
/// "after both", which are the bounds of open intervals, an angle has four levels.
#ifndef SL_REACH_H
#define SL_REACH_H

#include "cell_to_cell/fans.h"
#include "geometry/orient.h"

enum { SL_BEFORE = -2, SL_CLOCKWISE = -1, SL_COUNTER = 1, SL_AFTER = 2 };

/// An end of an interval of directions: from the point towards an end of the fans, or away from it.
typedef struct sl_bound {
    uint32_t end;
    int8_t level;
    bool away;
} sl_bound;

/// A cell that is seen from `low` counter-clockwise to `high`, both included.
typedef struct sl_reached {
    uint32_t cell;
    uint32_t other; ///< interval of the same cell, found before; UINT32_MAX for none
    sl_bound low, high;
    sl_bound from, to;     ///< of it, what waits for its turn, and then is looked at
    uint32_t next_waiting; ///< UINT32_MAX for none
    uint32_t depth;        ///< portals crossed
    /// Once sorted: turns, and the next interval that is entered or left there, or UINT32_MAX.
    uint32_t enter, leave, next_enter, next_leave;
    bool waiting;
    bool joined;  ///< with an earlier one of the same cell: to be passed over
    bool start;   ///< the point is a corner of the cell
    bool touched; ///< for its user: it counts where the line touches it in the point alone
} sl_reached;

/// A direction in which cells are entered or left.
typedef struct sl_reach_turn {
    uint32_t end;
    bool away;
    uint32_t ray;          ///< of sl_rays; UINT32_MAX for none
    uint32_t enter, leave; ///< the first cells that are entered and left here; UINT32_MAX for none
} sl_reach_turn;

/// Cells in no order, but those of a fan in theirs; and, once they are asked for, turns
/// counter-clockwise.
typedef struct sl_reach {
    SL_ARRAY(sl_reached) cells;
    SL_ARRAY(sl_reach_turn) turns;
} sl_reach;

/// Cells seen along one edge of the fan alone: ray r has cells[starts[r] .. starts[r + 1]).
typedef struct sl_rays {
    SL_ARRAY(uint32_t) starts;
    SL_ARRAY(uint32_t) cells;
} sl_rays;

/// A direction at which intervals start or end, while they are sorted.
typedef struct sl_reach_slot {
    uint32_t end, turn;
    bool away;
} sl_reach_slot;

enum { SL_NEAR_RINGS = 1024 };

/// Scratch of one thread, for one point at a time.
typedef struct sl_reacher {
    const sl_fans *fans; ///< whose directed portals it goes through
    const sl_fans *ends; ///< whose ends bounds have; the same, but for one-way glass
    bool closed;
    sl_point from;
    double limit;               ///< a cross product of directions beyond it has its sign
    double ring_scale;          ///< of squared distances
    uint32_t *last;             ///< by cell: where it may stand in what is being found
    SL_ARRAY(uint32_t) slot_of; ///< by end, twice: scratch of sorting
    uint32_t *on_rays;          ///< by cell: where it may stand among the cells of rays
    /// What waits, by its distance: the first interval of each ring, and which rings have any.
    uint32_t rings[SL_NEAR_RINGS];
    uint64_t ringed[SL_NEAR_RINGS / 64], some_ringed;
    SL_ARRAY(uint32_t) split; ///< cells with more intervals than one
    SL_ARRAY(uint64_t) keys;  ///< scratch of sorting
    SL_ARRAY(bool) same;
    SL_ARRAY(sl_reach_slot) slots;
    uint64_t pieces; ///< done so far
    uint32_t deepest;
} sl_reacher;

sl_status sl_reacher_create(sl_context *context, const sl_fans *fans, bool closed,
                            sl_reacher *reacher);
void sl_reacher_destroy(sl_context *context, sl_reacher *reacher);

/// Sets the point, of a fan of `ends`.
sl_status sl_reacher_stand(sl_context *context, sl_reacher *reacher, const sl_fans *ends,
                           sl_point from);
void sl_reach_clear(sl_reach *reach);

/// Adds a cell of a fan, seen between two directions within its sector. Cells of a fan must be
/// added in their order.
sl_status sl_reach_add(sl_context *context, sl_reacher *reacher, uint32_t cell, sl_bound low,
                       sl_bound high, sl_reach *reach);

/// Lets what is seen through a cell of a fan, between two directions within its sector, wait. The
/// bounds are no edges' directions but for those that the levels of open intervals exclude. `thin`:
/// they are the same angle.
sl_status sl_reach_through(sl_context *context, sl_reacher *reacher, uint32_t cell, sl_bound low,
                           sl_bound high, bool thin, sl_reach *reach);

/// Finds all that is seen through what waits.
sl_status sl_reach_run(sl_context *context, sl_reacher *reacher, sl_reach *reach);

/// Makes each cell's intervals such that no two touch, and turns of where they start and end, at
/// most half a turn from `first` on.
sl_status sl_reach_sort(sl_context *context, sl_reacher *reacher, sl_bound first, sl_reach *reach);

/// An edge of a fan's cell: the first, about which the line turns clockwise, or the last,
/// counter-clockwise.
typedef struct sl_fan_edge {
    uint32_t cell;
    uint32_t end;
    bool last;
} sl_fan_edge;

/// Adds one ray: what is seen from a cell of a fan along an edge. `known`: what was found last,
/// sorted, in which the edge is a turn's direction, or NULL; what it has at that moment is left
/// out.
sl_status sl_rays_add(sl_context *context, sl_reacher *reacher, sl_fan_edge along,
                      const sl_reach *known, uint32_t turn, sl_rays *rays);

void sl_reach_destroy(sl_context *context, sl_reach *reach);
void sl_rays_destroy(sl_context *context, sl_rays *rays);

/// Compares the directions of two turns seen from a point, the second turned by half a turn, both
/// within half a turn from the direction to `first` on: -1, 0, 1.
int sl_turns_compare(const sl_reacher *reacher, uint32_t first, const sl_reach_turn *a,
                     const sl_reach_turn *b);

// --- directions compared

static inline sl_point sl_end_of(const sl_reacher *r, uint32_t end) {
    return r->ends->ends.items[end];
}

/// From the point to an end.
static inline sl_point sl_towards(const sl_reacher *r, uint32_t end) {
    const sl_point at = sl_end_of(r, end);
    return (sl_point){at.x - r->from.x, at.y - r->from.y};
}

static inline double sl_cross(sl_point a, sl_point b) {
    return a.x * b.y - a.y * b.x;
}

/// Where rounding may have changed a cross product's sign. It must not be inlined: it is rare.
int sl_ends_turn_exact(const sl_reacher *r, uint32_t a, uint32_t b);

/// On which side of the direction to `a` the end `b` lies: 1 counter-clockwise, -1 clockwise, 0 on
/// its line.
static inline int sl_ends_turn(const sl_reacher *r, uint32_t a, uint32_t b) {
    if (a == b) return 0;
    const double cross = sl_cross(sl_towards(r, a), sl_towards(r, b));
    if (cross > r->limit) return 1;
    if (cross < -r->limit) return -1;
    return sl_ends_turn_exact(r, a, b);
}

static inline int sl_bound_side(const sl_reacher *r, sl_bound bound, uint32_t end) {
    const int sign = sl_ends_turn(r, bound.end, end);
    return bound.away ? -sign : sign;
}

/// Whether an end on a bound's line lies in its direction.
static inline bool sl_bound_has(const sl_reacher *r, sl_bound bound, uint32_t end) {
    return bound.end == end
               ? !bound.away
               : sl_opposite(r->from, sl_end_of(r, bound.end), sl_end_of(r, end)) == bound.away;
}

/// By how much `b` is beyond `a`, of two directions less than half a turn apart: 1, 0, -1.
static inline int sl_bounds_turn(const sl_reacher *r, sl_bound a, sl_bound b) {
    const int sign = sl_ends_turn(r, a.end, b.end);
    return a.away != b.away ? -sign : sign;
}

/// Whether directions lie between the end of an interval and the start of another.
static inline bool sl_is_gap(const sl_reacher *r, sl_bound high, sl_bound low) {
    const int turn = sl_bounds_turn(r, high, low);
    // Levels -1 and 1 follow each other. Of open sight single directions do not matter.
    return turn > 0 || (turn == 0 && r->closed && low.level - high.level > 2);
}

static inline bool sl_is_before(const sl_reacher *r, sl_bound a, sl_bound b) {
    const int turn = sl_bounds_turn(r, a, b);
    return turn > 0 || (turn == 0 && a.level < b.level);
}

#endif

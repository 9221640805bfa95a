/// What is seen from a point: cells, each over one or more visible intervals of angle.
///
/// An interval begins with a start event and ends with an end event. Events at one angle have an
/// order, their rank. Closed sight needs two ranks for each angle: the line there, rotated a little
/// clockwise, and the same rotated a little counter-clockwise (SWEEP.md). Open intervals are
/// bounded by the ranks before both and after both.
#ifndef SL_VISIBLE_H
#define SL_VISIBLE_H

#include "cell_to_cell/fans.h"
#include "geometry/orient.h"

/// Ranks of events at one angle.
enum { SL_BEFORE = -2, SL_CLOCKWISE = -1, SL_COUNTER = 1, SL_AFTER = 2 };

/// A start or end event: the direction from the point towards an end of the fans, or away from it.
typedef struct sl_bound {
    uint32_t end;
    int8_t rank;
    bool away;
} sl_bound;

/// A cell that is seen from its start event `low` counter-clockwise to its end event `high`, both
/// included.
typedef struct sl_visible_interval {
    uint32_t cell;
    uint32_t other; ///< interval of the same cell, found before; UINT32_MAX for none
    sl_bound low, high;
    sl_bound from, to;     ///< the part that waits to be looked through
    uint32_t next_waiting; ///< UINT32_MAX for none
    uint32_t depth;        ///< portals crossed
    /// Once sorted: the events, and the next interval that starts or ends there, or UINT32_MAX.
    uint32_t enter, leave, next_enter, next_leave;
    bool waiting;
    bool joined;  ///< with an earlier one of the same cell: to be passed over
    bool start;   ///< the point is a corner of the cell
    bool touched; ///< for its user: it counts where the line touches it in the point alone
} sl_visible_interval;

/// An angle at which intervals start or end.
typedef struct sl_visible_event {
    uint32_t end;
    bool away;
    uint32_t ray;          ///< of sl_rays; UINT32_MAX for none
    uint32_t enter, leave; ///< the first intervals that start and end here; UINT32_MAX for none
} sl_visible_event;

/// All intervals, in no order but that those of the fan's own cells come in the fan's order. Events
/// are there once sl_visible_sort has made them, counter-clockwise.
typedef struct sl_visible {
    SL_ARRAY(sl_visible_interval) cells;
    SL_ARRAY(sl_visible_event) events;
} sl_visible;

/// Cells seen along one edge of the fan alone: ray r has cells[starts[r] .. starts[r + 1]).
typedef struct sl_rays {
    SL_ARRAY(uint32_t) starts;
    SL_ARRAY(uint32_t) cells;
} sl_rays;

/// A direction at which intervals start or end, while they are sorted.
typedef struct sl_event_slot {
    uint32_t end, event;
    bool away;
} sl_event_slot;

enum { SL_NEAR_RINGS = 1024 };

/// Scratch of one thread, for one point at a time.
typedef struct sl_visible_finder {
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
    SL_ARRAY(sl_event_slot) slots;
    uint64_t pieces; ///< done so far
    uint32_t deepest;
} sl_visible_finder;

sl_status sl_visible_finder_create(sl_context *context, const sl_fans *fans, bool closed,
                                   sl_visible_finder *finder);
void sl_visible_finder_destroy(sl_context *context, sl_visible_finder *finder);

/// Sets the point from which is looked: that of a fan of `ends`.
sl_status sl_visible_finder_stand(sl_context *context, sl_visible_finder *finder,
                                  const sl_fans *ends, sl_point from);
void sl_visible_clear(sl_visible *visible);

/// Adds a cell of a fan, seen between two directions within its sector. Cells of a fan must be
/// added in their order.
sl_status sl_visible_add(sl_context *context, sl_visible_finder *finder, uint32_t cell,
                         sl_bound low, sl_bound high, sl_visible *visible);

/// Queues what is seen through a cell of a fan, between two directions within its sector. A bound
/// is no edge's direction, but where its rank leaves the edge out. `thin`: both are the same angle.
sl_status sl_visible_through(sl_context *context, sl_visible_finder *finder, uint32_t cell,
                             sl_bound low, sl_bound high, bool thin, sl_visible *visible);

/// Looks through everything that is queued, until nothing is.
sl_status sl_visible_run(sl_context *context, sl_visible_finder *finder, sl_visible *visible);

/// Joins intervals of one cell that touch, and makes the events, in their order from `first` on,
/// over half a turn at most.
sl_status sl_visible_sort(sl_context *context, sl_visible_finder *finder, sl_bound first,
                          sl_visible *visible);

/// An edge of a fan's cell: the first, where the line is rotated clockwise, or the last, where it
/// is rotated counter-clockwise.
typedef struct sl_fan_edge {
    uint32_t cell;
    uint32_t end;
    bool last;
} sl_fan_edge;

/// Adds one ray: the cells that are seen from a cell of a fan along an edge. `known`: the intervals
/// found last, sorted, or NULL. Cells that they have at `event`, the edge's angle, are left out.
sl_status sl_rays_add(sl_context *context, sl_visible_finder *finder, sl_fan_edge along,
                      const sl_visible *known, uint32_t event, sl_rays *rays);

void sl_visible_destroy(sl_context *context, sl_visible *visible);
void sl_rays_destroy(sl_context *context, sl_rays *rays);

/// Compares the angles of two events, the second rotated by half a turn. Both are within half a
/// turn from the direction to `first` on. -1, 0 or 1.
int sl_events_compare(const sl_visible_finder *finder, uint32_t first, const sl_visible_event *a,
                      const sl_visible_event *b);

// --- directions compared

static inline sl_point sl_end_of(const sl_visible_finder *r, uint32_t end) {
    return r->ends->ends.items[end];
}

/// From the point to an end.
static inline sl_point sl_towards(const sl_visible_finder *r, uint32_t end) {
    const sl_point at = sl_end_of(r, end);
    return (sl_point){at.x - r->from.x, at.y - r->from.y};
}

static inline double sl_cross(sl_point a, sl_point b) {
    return a.x * b.y - a.y * b.x;
}

/// Where rounding may have changed a cross product's sign. It must not be inlined: it is rare.
int sl_ends_turn_exact(const sl_visible_finder *r, uint32_t a, uint32_t b);

/// On which side of the direction to `a` the end `b` lies: 1 counter-clockwise, -1 clockwise, 0 on
/// its line.
static inline int sl_ends_turn(const sl_visible_finder *r, uint32_t a, uint32_t b) {
    if (a == b) return 0;
    const double cross = sl_cross(sl_towards(r, a), sl_towards(r, b));
    if (cross > r->limit) return 1;
    if (cross < -r->limit) return -1;
    return sl_ends_turn_exact(r, a, b);
}

static inline int sl_bound_side(const sl_visible_finder *r, sl_bound bound, uint32_t end) {
    const int sign = sl_ends_turn(r, bound.end, end);
    return bound.away ? -sign : sign;
}

/// Whether an end on a bound's line lies in its direction.
static inline bool sl_bound_has(const sl_visible_finder *r, sl_bound bound, uint32_t end) {
    return bound.end == end
               ? !bound.away
               : sl_opposite(r->from, sl_end_of(r, bound.end), sl_end_of(r, end)) == bound.away;
}

/// By how much `b` is beyond `a`, of two directions less than half a turn apart: 1, 0, -1.
static inline int sl_bounds_turn(const sl_visible_finder *r, sl_bound a, sl_bound b) {
    const int sign = sl_ends_turn(r, a.end, b.end);
    return a.away != b.away ? -sign : sign;
}

/// Whether directions lie between the end of an interval and the start of another.
static inline bool sl_is_gap(const sl_visible_finder *r, sl_bound high, sl_bound low) {
    const int turn = sl_bounds_turn(r, high, low);
    // Ranks -1 and 1 follow each other. Of open sight single directions do not matter.
    return turn > 0 || (turn == 0 && r->closed && low.rank - high.rank > 2);
}

static inline bool sl_is_before(const sl_visible_finder *r, sl_bound a, sl_bound b) {
    const int turn = sl_bounds_turn(r, a, b);
    return turn > 0 || (turn == 0 && a.rank < b.rank);
}

#endif

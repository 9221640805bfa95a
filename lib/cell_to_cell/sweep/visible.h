/// What is seen from a point: cells, each over one or more visible intervals of angle.
///
/// An interval begins with a start event and ends with an end event. Events at one angle have an
/// order, their rank. Closed sight needs two ranks for each angle: the line there, rotated a little
/// clockwise, and the same rotated a little counter-clockwise (SWEEP.md). Open intervals are
/// bounded by the ranks before both and after both.
#ifndef SL_VISIBLE_H
#define SL_VISIBLE_H

#include "cell_to_cell/sweep/fans.h"
#include "geometry/length.h"
#include "geometry/orient.h"

/// Ranks of events at one angle.
enum { SLI_BEFORE = -2, SLI_CLOCKWISE = -1, SLI_COUNTER = 1, SLI_AFTER = 2 };

/// A start or end event: the direction from the point towards an end of the fans, or away from it.
typedef struct sli_bound {
    uint32_t end;
    int8_t rank;
    bool away;
} sli_bound;

/// A cell that is seen from its start event `low` counter-clockwise to its end event `high`, both
/// included.
typedef struct sli_visible_interval {
    uint32_t cell;
    uint32_t other; ///< interval of the same cell, found before; UINT32_MAX for none
    sli_bound low, high;
    sli_bound from, to;    ///< the part that waits to be looked through
    uint32_t next_waiting; ///< UINT32_MAX for none
    uint32_t depth;        ///< portals crossed
    /// Once sorted: the events, and the next interval that starts or ends there, or UINT32_MAX.
    uint32_t enter, leave, next_enter, next_leave;
    bool waiting;
    bool joined;  ///< with an earlier one of the same cell: to be passed over
    bool start;   ///< the point is a corner of the cell
    bool touched; ///< for its user: it counts where the line touches it in the point alone
} sli_visible_interval;

/// An angle at which intervals start or end.
typedef struct sli_visible_event {
    uint32_t end;
    bool away;
    uint32_t ray;          ///< of sli_rays; UINT32_MAX for none
    uint32_t enter, leave; ///< the first intervals that start and end here; UINT32_MAX for none
} sli_visible_event;

/// All intervals, in no order but that those of the fan's own cells come in the fan's order. Events
/// are there once sli_visible_sort has made them, counter-clockwise.
typedef struct sli_visible {
    SL_ARRAY(sli_visible_interval) cells;
    SL_ARRAY(sli_visible_event) events;
} sli_visible;

/// Cells seen along one edge of the fan alone: ray r has cells[starts[r] .. starts[r + 1]).
typedef struct sli_rays {
    SL_ARRAY(uint32_t) starts;
    SL_ARRAY(uint32_t) cells;
} sli_rays;

/// A direction at which intervals start or end, while they are sorted.
typedef struct sli_event_slot {
    uint32_t end, event;
    bool away;
} sli_event_slot;

enum { SLI_NEAR_RINGS = 1024 };

/// Scratch of one thread, for one point at a time.
typedef struct sli_visible_finder {
    const sli_fans *fans; ///< whose directed portals it goes through
    const sli_fans *ends; ///< whose ends bounds have; the same, but for one-way glass
    bool closed;
    sl_point from;
    double limit;               ///< a cross product of directions beyond it has its sign
    double ring_scale;          ///< of squared distances
    uint32_t *last;             ///< by cell: where it may stand in what is being found
    SL_ARRAY(uint32_t) slot_of; ///< by end, twice: scratch of sorting
    uint32_t *on_rays;          ///< by cell: where it may stand among the cells of rays
    /// What waits, by its distance: the first interval of each ring, and which rings have any.
    uint32_t rings[SLI_NEAR_RINGS];
    uint64_t ringed[SLI_NEAR_RINGS / 64], some_ringed;
    SL_ARRAY(uint32_t) split; ///< cells with more intervals than one
    SL_ARRAY(uint64_t) keys;  ///< scratch of sorting
    SL_ARRAY(bool) same;
    SL_ARRAY(sli_event_slot) slots;
    uint64_t pieces; ///< done so far
    uint32_t deepest;
} sli_visible_finder;

sl_status sli_visible_finder_create(sl_context *context, const sli_fans *fans, bool closed,
                                    sli_visible_finder *finder);
void sli_visible_finder_destroy(sl_context *context, sli_visible_finder *finder);

/// Sets the point from which is looked: that of a fan of `ends`.
sl_status sli_visible_finder_stand(sl_context *context, sli_visible_finder *finder,
                                   const sli_fans *ends, sl_point from);
void sli_visible_clear(sli_visible *visible);

/// Adds a cell of a fan, seen between two directions within its sector. Cells of a fan must be
/// added in their order.
sl_status sli_visible_add(sl_context *context, sli_visible_finder *finder, uint32_t cell,
                          sli_bound low, sli_bound high, sli_visible *visible);

/// Queues what is seen through a cell of a fan, between two directions within its sector. A bound
/// is no edge's direction, but where its rank leaves the edge out. `thin`: both are the same angle.
sl_status sli_visible_through(sl_context *context, sli_visible_finder *finder, uint32_t cell,
                              sli_bound low, sli_bound high, bool thin, sli_visible *visible);

/// Looks through everything that is queued, until nothing is.
sl_status sli_visible_run(sl_context *context, sli_visible_finder *finder, sli_visible *visible);

/// Joins intervals of one cell that touch, and makes the events, in their order from `first` on,
/// over half a turn at most.
sl_status sli_visible_sort(sl_context *context, sli_visible_finder *finder, sli_bound first,
                           sli_visible *visible);

/// An edge of a fan's cell: the first, where the line is rotated clockwise, or the last, where it
/// is rotated counter-clockwise.
typedef struct sli_fan_edge {
    uint32_t cell;
    uint32_t end;
    bool last;
} sli_fan_edge;

/// Adds one ray: the cells that are seen from a cell of a fan along an edge. `known`: the intervals
/// found last, sorted, or NULL. Cells that they have at `event`, the edge's angle, are left out.
sl_status sli_rays_add(sl_context *context, sli_visible_finder *finder, sli_fan_edge along,
                       const sli_visible *known, uint32_t event, sli_rays *rays);

void sli_visible_destroy(sl_context *context, sli_visible *visible);
void sli_rays_destroy(sl_context *context, sli_rays *rays);

/// Compares the angles of two events, the second rotated by half a turn. Both are within half a
/// turn from the direction to `first` on. -1, 0 or 1.
int sli_events_compare(const sli_visible_finder *finder, uint32_t first, const sli_visible_event *a,
                       const sli_visible_event *b);

// --- directions compared

static inline sl_point sli_end_of(const sli_visible_finder *r, uint32_t end) {
    return r->ends->ends.items[end];
}

/// From the point to an end.
static inline sl_point sli_towards(const sli_visible_finder *r, uint32_t end) {
    const sl_point at = sli_end_of(r, end);
    return (sl_point){at.x - r->from.x, at.y - r->from.y};
}

/// Where rounding may have changed a cross product's sign. It must not be inlined: it is rare.
int sli_ends_turn_exact(const sli_visible_finder *r, uint32_t a, uint32_t b);

/// On which side of the direction to `a` the end `b` lies: 1 counter-clockwise, -1 clockwise, 0 on
/// its line.
static inline int sli_ends_turn(const sli_visible_finder *r, uint32_t a, uint32_t b) {
    if (a == b) return 0;
    const double cross = sli_cross(sli_towards(r, a), sli_towards(r, b));
    if (cross > r->limit) return 1;
    if (cross < -r->limit) return -1;
    return sli_ends_turn_exact(r, a, b);
}

static inline int sli_bound_side(const sli_visible_finder *r, sli_bound bound, uint32_t end) {
    const int sign = sli_ends_turn(r, bound.end, end);
    return bound.away ? -sign : sign;
}

/// Whether an end on a bound's line lies in its direction.
static inline bool sli_bound_has(const sli_visible_finder *r, sli_bound bound, uint32_t end) {
    return bound.end == end
               ? !bound.away
               : sli_opposite(r->from, sli_end_of(r, bound.end), sli_end_of(r, end)) == bound.away;
}

/// By how much `b` is beyond `a`, of two directions less than half a turn apart: 1, 0, -1.
static inline int sli_bounds_turn(const sli_visible_finder *r, sli_bound a, sli_bound b) {
    const int sign = sli_ends_turn(r, a.end, b.end);
    return a.away != b.away ? -sign : sign;
}

/// Whether directions lie between the end of an interval and the start of another.
static inline bool sli_is_gap(const sli_visible_finder *r, sli_bound high, sli_bound low) {
    const int turn = sli_bounds_turn(r, high, low);
    // Ranks -1 and 1 follow each other. Of open sight single directions do not matter.
    return turn > 0 || (turn == 0 && r->closed && low.rank - high.rank > 2);
}

static inline bool sli_is_before(const sli_visible_finder *r, sli_bound a, sli_bound b) {
    const int turn = sli_bounds_turn(r, a, b);
    return turn > 0 || (turn == 0 && a.rank < b.rank);
}

#endif

/// What lies round the portal ends: for each, the cells between two walls, or all round it. Where
/// glass is one-way, also the cells between glass that is blocked for a line going round.
#ifndef SL_FANS_H
#define SL_FANS_H

#include "geometry/orient.h"
#include "sightline/cell_to_cell.h"
#include "sightline/support.h"

/// A directed portal as the sweep walks through it; its ends are numbers of sli_fans.ends. The
/// directed portals of a cell are directed portals[first[cell] .. first[cell + 1]),
/// counter-clockwise; cells left out of the search have none, and none leads to them.
typedef struct sli_walk_portal {
    uint32_t left, right;
    uint32_t cell; ///< where it leads; SL_NO_CELL where one-way glass is blocked
    uint32_t twin; ///< the directed portal that leads back
} sli_walk_portal;

/// A cell of a fan: the sector between two of its edges, seen from the fan's point.
typedef struct sli_fan_cell {
    uint32_t cell;
    uint32_t
        begin; ///< its directed portals counter-clockwise from the fan's point start with this one
    uint32_t edge; ///< the other end of its first edge, clockwise of it: of sli_fans.ends
    /// Sign of the edge's angle beyond the fan's first edge, less pi; and of the angle by which the
    /// fan's last edge is beyond the edge, taken from pi.
    int8_t past_half, past_rest;
    bool covered; ///< what is seen from the fan's point counts for the cell
} sli_fan_cell;

/// Consecutive cells round a portal end, counter-clockwise. A fan between walls has one item more
/// than cells: its last edge. So has a full turn without walls: the first edge again.
typedef struct sli_fan {
    sl_point at;
    uint32_t first, count; ///< of cells
    bool full_turn;        ///< no wall stops it
    bool wide;             ///< it leaves a line room to turn beside the corner of its walls
    bool back_to_back;     ///< it goes all round one wall: first and last edge are the same
    bool covers;           ///< some of its cells are covered
} sli_fan;

typedef struct sli_fans {
    uint32_t cell_count;
    uint32_t *first_directed; ///< cell_count + 1
    sli_walk_portal *directed;
    sl_point *middles; ///< of cells, about
    /// What directions lead to: ends of portals; then ends of walls that fans start and end with;
    /// and with `has_horizon` two points more, far right and far left of all and below them.
    SL_ARRAY(sl_point) ends;
    sl_box bounds; ///< of the ends
    bool has_horizon;
    double
        grid; ///< times which all coordinates are whole numbers below 2^50; 0 where none is known
    SL_ARRAY(sli_fan) fans;
    SL_ARRAY(sli_fan_cell) cells;
} sli_fans;

/// Which fans, and in which of its two directions one-way glass is blocked for whoever walks
/// through the directed portals.
typedef enum sli_fan_way {
    SLI_FANS_MUTUAL,   ///< no glass is blocked
    SLI_FANS_COVERING, ///< those that cover cells alone; glass does not end them, directed portals
                       ///< are as sight
    SLI_FANS_FORTH,    ///< wide ones alone, also between glass that is blocked counter-clockwise
    SLI_FANS_BACK, ///< as if all glass were turned round: directed portals lead to cells from which
                   ///< sight comes
} sli_fan_way;

/// Finds the fans of all portal ends. Each cell that has a directed portal is covered by one of
/// them at least, but for SLI_FANS_FORTH and SLI_FANS_BACK. Fans without room to turn that cover no
/// cell are left out. Directed portals and ends of portals have the same numbers in all ways.
/// `fans` is zeroed, and to be destroyed also on failure. Time: a hash table of the ends.
sl_status sli_fans_find(sl_context *context, const sl_space *space, const sl_see_options *options,
                        sli_fan_way way, sli_fans *fans);
void sli_fans_destroy(sl_context *context, sli_fans *fans); ///< and zeroes it
/// What they take of memory.
uint64_t sli_fans_bytes(const sli_fans *fans);

/// Whether two points on one line through `v` lie on different sides of it.
static inline bool sli_opposite(sl_point v, sl_point a, sl_point b) {
    return (a.x > v.x && b.x < v.x) || (a.x < v.x && b.x > v.x) || (a.y > v.y && b.y < v.y) ||
           (a.y < v.y && b.y > v.y);
}

#endif

/// Pieces of view space with their exact directed visible sets (Laine 2005, section 3).
///
/// A piece is a convex part of one room. Its directed visible set is what it sees within a quadrant
/// of directions; of each object the set also says from where in the piece it is seen.
#ifndef SL_VIEW_PIECES_H
#define SL_VIEW_PIECES_H

#include "cell_to_cell/sectors.h"
#include "sightline/support.h"
#include "sightline/view_cells.h"

#include <math.h>
#include <pthread.h>

// --- rooms: the convex regions that sightlines pass, with their portals and objects. Where objects
// are cells, rooms are the space's cells. Where objects are walls, they are the outline's rooms,
// which are fewer.

#define SL_NO_ROOM   UINT32_MAX
#define SL_NO_OBJECT UINT32_MAX

/// A piece of a room's boundary, as it is crossed on the way out. The map's border is left out:
/// nothing is behind it, and it is no object.
typedef struct sl_room_side {
    sl_point left, right;
    uint32_t room;   ///< behind it; SL_NO_ROOM for a wall
    uint32_t object; ///< seen wherever the side is seen; SL_NO_OBJECT for none
} sl_room_side;

/// The rooms inside.
typedef struct sl_view_rooms {
    uint32_t count, object_count;
    sl_box bounds;
    sl_point *corners;      ///< counter-clockwise
    uint32_t *first_corner; ///< by room, and one more
    sl_room_side *sides;
    uint32_t *first_side; ///< by room, and one more
    uint32_t *object;     ///< by room: the object that the room itself is; SL_NO_OBJECT for none
    double *places[2];    ///< the corners' coordinates on each axis, ascending, each once
    uint32_t place_counts[2];
} sl_view_rooms;

/// Snaps a rounded place on an axis to the coordinate of a corner, if one is very near: so cuts lie
/// exactly along walls.
double sl_view_rooms_snap(const sl_view_rooms *rooms, int axis, double place);

// --- pieces

enum { SL_VIEW_QUADRANTS = 4 };

typedef SL_ARRAY(sl_point) sl_view_points;
typedef SL_ARRAY(uint32_t) sl_view_numbers;

/// The places along each axis between which an object is seen. Rounded: it says where cutting may
/// pay, and decides no visibility.
typedef struct sl_view_extent {
    double low[2], high[2];
} sl_view_extent;

static inline sl_view_extent sl_view_no_extent(void) {
    return (sl_view_extent){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
}

static inline void sl_view_extent_join(sl_view_extent *extent, const sl_view_extent *other) {
    for (int axis = 0; axis < 2; axis++) {
        if (other->low[axis] < extent->low[axis]) extent->low[axis] = other->low[axis];
        if (other->high[axis] > extent->high[axis]) extent->high[axis] = other->high[axis];
    }
}

// --- clipping in doubles

/// Shortens t0 .. t1 to where from + t * by <= 0.
static inline void sl_keep_below(double from, double by, double *t0, double *t1) {
    if (by > 0)
        *t1 = fmin(*t1, -from / by);
    else if (by < 0)
        *t0 = fmax(*t0, -from / by);
}

static inline double sl_within(double value, double low, double high) {
    return value < low ? low : value > high ? high : value;
}

// --- directed visible sets

typedef struct sl_view_sight {
    uint32_t object;
    sl_view_extent from;
} sl_view_sight;

/// What a piece sees in a quadrant, without its own room: the rooms that sightlines enter, and the
/// objects.
typedef struct sl_view_directed {
    sl_view_numbers rooms;
    SL_ARRAY(sl_view_sight) objects;
} sl_view_directed;

typedef struct sl_view_piece {
    uint32_t room;
    sl_view_points corners; ///< convex, counter-clockwise
    sl_view_extent box;     ///< about them
    sl_view_directed directed[SL_VIEW_QUADRANTS];
} sl_view_piece;

/// Searches from pieces: a thread's solver and scratch.
typedef struct sl_view_searcher sl_view_searcher;

typedef struct sl_view_pieces {
    sl_context *context;
    sl_sight sight;
    sl_view_rooms rooms;
    SL_ARRAY(sl_view_piece) items; ///< the rooms themselves at first
    pthread_mutex_t lock;
    sl_view_searcher *idle; ///< under the lock: those in no thread's use
    sl_view_work work;
} sl_view_pieces;

/// Makes a piece of each room, and finds what rooms see by a pass in each quadrant, one a thread.
/// `scene` must stay. To be destroyed also on failure.
sl_status sl_view_pieces_create(sl_context *context, const sl_view_scene *scene, sl_sight sight,
                                unsigned threads, sl_view_pieces *pieces);
void sl_view_pieces_destroy(sl_view_pieces *pieces);

/// The halves of a piece, which stays whole until it is cut. Zeroed: none.
typedef struct sl_view_halves {
    sl_view_piece below, above;
    sl_view_work work; ///< what finding them took
} sl_view_halves;

/// Finds the halves of a piece that lies on both sides of a line across an axis. A half that is not
/// asked for gets no set. Threads may do so at the same time, each with its own searcher, while
/// nothing is cut. `out` is to be destroyed, or handed to sl_view_pieces_cut, also on failure.
sl_status sl_view_pieces_halve(sl_context *context, const sl_view_pieces *pieces,
                               sl_view_searcher *searcher, uint32_t number, int axis,
                               double position, bool asks_below, bool asks_above,
                               sl_view_halves *out);
void sl_view_halves_destroy(sl_context *context, sl_view_halves *halves); ///< and zeroes them

/// Cuts a piece into its halves, which are then empty: the one below takes its number, *above is
/// the number of the other.
sl_status sl_view_pieces_cut(sl_view_pieces *pieces, uint32_t number, sl_view_halves *halves,
                             uint32_t *above);

/// Adds what a piece sees, with the objects of its own room, to a row of bits.
void sl_view_piece_add_to(const sl_view_pieces *pieces, const sl_view_piece *piece, uint64_t *row);

// --- searching (piece_search.c)

/// Takes a searcher for the caller's thread and context, until it is given back.
sl_status sl_view_searcher_take(sl_context *context, sl_view_pieces *pieces,
                                sl_view_searcher **out);
void sl_view_searcher_give(sl_view_pieces *pieces, sl_view_searcher *searcher);
void sl_view_searchers_destroy(sl_context *context, sl_view_pieces *pieces);

/// The work since the last call.
sl_view_work sl_view_searcher_work(sl_view_searcher *searcher);

static inline void sl_view_work_add(sl_view_work *work, const sl_view_work *more) {
    work->looks += more->looks;
    work->candidates += more->candidates;
    work->relations += more->relations;
    work->tests += more->tests;
}

/// The directions of a quadrant: 0 from east to north, and on counter-clockwise.
sl_direction_sector sl_view_quadrant(int quadrant);

/// Starts a new list of candidate rooms, which is empty.
void sl_view_search_begin(sl_view_searcher *searcher);
/// Makes a room a candidate.
void sl_view_search_allow(sl_view_searcher *searcher, uint32_t room);

/// What a piece sees in a quadrant, among the candidate rooms and, where `objects` is not NULL,
/// among its objects. `out` must be empty.
sl_status sl_view_search(sl_view_searcher *searcher, const sl_view_piece *piece, int quadrant,
                         const sl_view_directed *objects, sl_view_directed *out);

#endif

/// Pieces of view space with their exact directed visible sets (Laine 2005, section 3).
///
/// A piece is a convex part of one room. Its directed visible set is what it sees within a quadrant
/// of directions; of each object the set also says from where in the piece it is seen.
#ifndef SL_VIEW_PIECES_H
#define SL_VIEW_PIECES_H

#include "cell_to_cell/search/sectors.h"
#include "sightline/support.h"
#include "sightline/view_cells.h"

#include <math.h>
#include <pthread.h>

// --- rooms: the convex regions that sightlines pass, with their portals and objects. Where objects
// are cells, rooms are the space's cells. Where objects are walls, they are the outline's rooms,
// which are fewer.

#define SLI_NO_ROOM   UINT32_MAX
#define SLI_NO_OBJECT UINT32_MAX

/// A piece of a room's boundary, as it is crossed on the way out. The map's border is left out:
/// nothing is behind it, and it is no object.
typedef struct sli_room_side {
    sl_point left, right;
    uint32_t room;   ///< behind it; SLI_NO_ROOM for a wall
    uint32_t object; ///< seen wherever the side is seen; SLI_NO_OBJECT for none
} sli_room_side;

/// The rooms inside.
typedef struct sli_view_rooms {
    uint32_t count, object_count;
    sl_box bounds;
    sl_point *corners;      ///< counter-clockwise
    uint32_t *first_corner; ///< by room, and one more
    sli_room_side *sides;
    uint32_t *first_side; ///< by room, and one more
    uint32_t *object;     ///< by room: the object that the room itself is; SLI_NO_OBJECT for none
    double *places[2];    ///< the corners' coordinates on each axis, ascending, each once
    uint32_t place_counts[2];
} sli_view_rooms;

/// Snaps a rounded place on an axis to the coordinate of a corner, if one is very near: so cuts lie
/// exactly along walls.
double sli_view_rooms_snap(const sli_view_rooms *rooms, int axis, double place);

// --- pieces

enum { SLI_VIEW_QUADRANTS = 4 };

typedef SL_ARRAY(sl_point) sli_view_points;
typedef SL_ARRAY(uint32_t) sli_view_numbers;

/// The places along each axis between which an object is seen. Rounded: it says where cutting may
/// pay, and decides no visibility.
typedef struct sli_view_extent {
    double low[2], high[2];
} sli_view_extent;

static inline sli_view_extent sli_view_no_extent(void) {
    return (sli_view_extent){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
}

static inline void sli_view_extent_join(sli_view_extent *extent, const sli_view_extent *other) {
    for (int axis = 0; axis < 2; axis++) {
        if (other->low[axis] < extent->low[axis]) extent->low[axis] = other->low[axis];
        if (other->high[axis] > extent->high[axis]) extent->high[axis] = other->high[axis];
    }
}

// --- clipping in doubles

/// Shortens t0 .. t1 to where from + t * by <= 0.
static inline void sli_keep_below(double from, double by, double *t0, double *t1) {
    if (by > 0)
        *t1 = fmin(*t1, -from / by);
    else if (by < 0)
        *t0 = fmax(*t0, -from / by);
}

static inline double sli_within(double value, double low, double high) {
    return value < low ? low : value > high ? high : value;
}

// --- directed visible sets

typedef struct sli_view_sight {
    uint32_t object;
    sli_view_extent from;
} sli_view_sight;

/// What a piece sees in a quadrant, without its own room: the rooms that sightlines enter, and the
/// objects.
typedef struct sli_view_directed {
    sli_view_numbers rooms;
    SL_ARRAY(sli_view_sight) objects;
} sli_view_directed;

typedef struct sli_view_piece {
    uint32_t room;
    sli_view_points corners; ///< convex, counter-clockwise
    sli_view_extent box;     ///< about them
    sli_view_directed directed[SLI_VIEW_QUADRANTS];
} sli_view_piece;

/// Searches from pieces: a thread's solver and scratch.
typedef struct sli_view_searcher sli_view_searcher;

typedef struct sli_view_pieces {
    sl_context *context;
    sl_sight sight;
    sli_view_rooms rooms;
    SL_ARRAY(sli_view_piece) items; ///< the rooms themselves at first
    pthread_mutex_t lock;
    sli_view_searcher *idle; ///< under the lock: those in no thread's use
    sl_view_work work;
} sli_view_pieces;

/// Makes a piece of each room, and finds what rooms see by a pass in each quadrant, one a thread.
/// `scene` must stay. To be destroyed also on failure.
sl_status sli_view_pieces_create(sl_context *context, const sl_view_scene *scene, sl_sight sight,
                                 unsigned threads, sli_view_pieces *pieces);
void sli_view_pieces_destroy(sli_view_pieces *pieces);

/// The halves of a piece, which stays whole until it is cut. Zeroed: none.
typedef struct sli_view_halves {
    sli_view_piece below, above;
    sl_view_work work; ///< what finding them took
} sli_view_halves;

/// Finds the halves of a piece that lies on both sides of a line across an axis. A half that is not
/// asked for gets no set. Threads may do so at the same time, each with its own searcher, while
/// nothing is cut. `out` is to be destroyed, or handed to sli_view_pieces_cut, also on failure.
sl_status sli_view_pieces_halve(sl_context *context, const sli_view_pieces *pieces,
                                sli_view_searcher *searcher, uint32_t number, int axis,
                                double position, bool asks_below, bool asks_above,
                                sli_view_halves *out);
void sli_view_halves_destroy(sl_context *context, sli_view_halves *halves); ///< and zeroes them

/// Cuts a piece into its halves, which are then empty: the one below takes its number, *above is
/// the number of the other.
sl_status sli_view_pieces_cut(sli_view_pieces *pieces, uint32_t number, sli_view_halves *halves,
                              uint32_t *above);

/// Adds what a piece sees, with the objects of its own room, to a row of bits.
void sli_view_piece_add_to(const sli_view_pieces *pieces, const sli_view_piece *piece,
                           uint64_t *row);

// --- searching (piece_search.c)

/// Takes a searcher for the caller's thread and context, until it is given back.
sl_status sli_view_searcher_take(sl_context *context, sli_view_pieces *pieces,
                                 sli_view_searcher **out);
void sli_view_searcher_give(sli_view_pieces *pieces, sli_view_searcher *searcher);
void sli_view_searchers_destroy(sl_context *context, sli_view_pieces *pieces);

/// The work since the last call.
sl_view_work sli_view_searcher_work(sli_view_searcher *searcher);

static inline void sli_view_work_add(sl_view_work *work, const sl_view_work *more) {
    work->looks += more->looks;
    work->candidates += more->candidates;
    work->relations += more->relations;
    work->tests += more->tests;
}

/// The directions of a quadrant: 0 from east to north, and on counter-clockwise.
sli_direction_sector sli_view_quadrant(int quadrant);

/// Starts a new list of candidate rooms, which is empty.
void sli_view_search_begin(sli_view_searcher *searcher);
/// Makes a room a candidate.
void sli_view_search_allow(sli_view_searcher *searcher, uint32_t room);

/// What a piece sees in a quadrant, among the candidate rooms and, where `objects` is not NULL,
/// among its objects. `out` must be empty.
sl_status sli_view_search(sli_view_searcher *searcher, const sli_view_piece *piece, int quadrant,
                          const sli_view_directed *objects, sli_view_directed *out);

#endif

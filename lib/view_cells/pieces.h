/// Pieces of view space with their exact directed visible sets (Laine 2005, section 3): what a
/// convex part of one room sees within each quadrant of directions, and of each object from where
/// in the piece it is seen.
///
/// The sets of whole rooms come from a pass of the multipass method in each quadrant. A piece that
/// is cut has for candidates what it sees itself: its halves are never held against anything else.
#ifndef SL_VIEW_PIECES_H
#define SL_VIEW_PIECES_H

#include "cell_to_cell/sectors.h"
#include "view_cells/rooms.h"

#include <math.h>
#include <pthread.h>

enum { SL_VIEW_QUADRANTS = 4 };

typedef SL_ARRAY(sl_point) sl_view_points;
typedef SL_ARRAY(uint32_t) sl_view_numbers;

/// Between which places along each axis an object is seen. Rounded: it says where cutting may pay,
/// and decides on no visibility.
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

typedef struct sl_view_sight {
    uint32_t object;
    sl_view_extent from;
} sl_view_sight;

/// What a piece sees in a quadrant, but for its own room: the rooms that sightlines enter, and the
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

/// What looks from pieces, one thread's own: the solver and its scratch.
typedef struct sl_view_looker sl_view_looker;

typedef struct sl_view_pieces {
    sl_context *context;
    sl_sight sight;
    sl_view_rooms rooms;
    SL_ARRAY(sl_view_piece) items; ///< the rooms themselves at first
    pthread_mutex_t lock;
    sl_view_looker *idle; ///< under the lock: those that no thread has
    sl_view_work work;
} sl_view_pieces;

/// What rooms see, by passes over all of them, a quadrant a thread. `scene` must stay. To be
/// destroyed also on failure.
sl_status sl_view_pieces_create(sl_context *context, const sl_view_scene *scene, sl_sight sight,
                                unsigned threads, sl_view_pieces *pieces);
void sl_view_pieces_destroy(sl_view_pieces *pieces);

/// The halves of a piece that stays whole until it is cut. Zeroed: none.
typedef struct sl_view_halves {
    sl_view_piece below, above;
    sl_view_work work; ///< what finding them took
} sl_view_halves;

/// Finds the halves of a piece that lies on both sides of a line across an axis. Halves for which
/// nobody asks see nothing. Threads may do so at the same time, each with a looker, as long as
/// nothing is cut. To be destroyed, or handed to sl_view_pieces_cut, also on failure.
sl_status sl_view_pieces_halve(sl_context *context, const sl_view_pieces *pieces,
                               sl_view_looker *looker, uint32_t number, int axis, double position,
                               bool asks_below, bool asks_above, sl_view_halves *out);
void sl_view_halves_destroy(sl_context *context, sl_view_halves *halves); ///< and zeroes them

/// Cuts a piece into its halves, which are then empty: the one below takes its number, *above is
/// the number of the other.
sl_status sl_view_pieces_cut(sl_view_pieces *pieces, uint32_t number, sl_view_halves *halves,
                             uint32_t *above);

/// Adds what a piece sees, its own room's objects among it, to a row of bits.
void sl_view_piece_add_to(const sl_view_pieces *pieces, const sl_view_piece *piece, uint64_t *row);

// --- looking (piece_look.c)

/// A looker for the caller's thread, whose context it takes, until it is given back.
sl_status sl_view_looker_take(sl_context *context, sl_view_pieces *pieces, sl_view_looker **out);
void sl_view_looker_give(sl_view_pieces *pieces, sl_view_looker *looker);
void sl_view_lookers_destroy(sl_context *context, sl_view_pieces *pieces);

/// What it has done since it was asked last.
sl_view_work sl_view_looker_work(sl_view_looker *looker);

static inline void sl_view_work_add(sl_view_work *work, const sl_view_work *more) {
    work->looks += more->looks;
    work->candidates += more->candidates;
    work->relations += more->relations;
    work->tests += more->tests;
}

/// The directions of a quadrant: 0 from east to north, and on round.
sl_direction_sector sl_view_quadrant(int quadrant);

/// No room is a candidate, and all objects are.
void sl_view_look_begin(sl_view_looker *looker);
/// Makes a room a candidate.
void sl_view_look_allow(sl_view_looker *looker, uint32_t room);

/// What a piece sees in a quadrant among the candidate rooms; and among `objects` alone where these
/// are not NULL. `out` is to be empty.
sl_status sl_view_look(sl_view_looker *looker, const sl_view_piece *piece, int quadrant,
                       const sl_view_directed *objects, sl_view_directed *out);

#endif

/// The BSP while it is built: faces, convex polygons in doubles, that are split until no wall is
/// inside one.
///
/// What holds at all times: every face is convex by exact predicates; a portal's side has a twin
/// with the same two ends in the face beyond; the ends of a wall's side lie on the wall's line or
/// behind it, as seen from the face. A wall is put in whole: where it goes on through a portal, the
/// face beyond is split with it, so that it never stands half in the way.
#ifndef SL_BSP_H
#define SL_BSP_H

#include "base/base.h"
#include "geometry/orient.h"
#include "sightline/space.h"
#include "space/seams.h"

#define SL_NO_FACE UINT32_MAX

/// From a corner to the face's next one, counter-clockwise.
typedef struct sl_bsp_side {
    sl_point from;
    uint32_t what;   ///< a wall, SL_BEYOND_EXIT or SL_BEYOND_BORDER
    uint32_t beyond; ///< the face behind a portal; SL_NO_FACE while it is not known, and for others
    uint32_t joint;  ///< the same for both sides of a portal that is new; 0 for others
    uint32_t seam : 31;    ///< what part of the seams a portal lies on: 1 + its number; 0 for none
    uint32_t reversed : 1; ///< a wall's side that runs from the wall's b to its a
} sl_bsp_side;

typedef SL_ARRAY(sl_bsp_side) sl_bsp_sides;
typedef SL_ARRAY(uint32_t) sl_bsp_walls;

/// A place in the tree: a child of a node. The root's node is -1.
typedef struct sl_bsp_spot {
    int32_t node;
    bool above;
} sl_bsp_spot;

typedef struct sl_bsp_face {
    sl_bsp_sides sides;
    sl_bsp_walls walls;           ///< those inside it
    size_t set_aside;             ///< the last so many of them could not be put in
    uint32_t of;                  ///< the face that it is a part of, of those at first
    SL_ARRAY(sl_bsp_spot) places; ///< all that lead here
} sl_bsp_face;

/// A side that crosses the line that is put in, or a corner on it.
typedef struct sl_bsp_crossing {
    size_t side;    ///< of the face: the one crossed, or the one that starts in the corner
    bool at_corner; ///< the corner lies exactly on the line
    bool walled;    ///< a wall on the line reaches up to here from within the face
    bool passes;    ///< and goes on through a portal
    sl_point touch; ///< where the wall ends exactly on the side, if so
    bool touches;
} sl_bsp_crossing;

/// What the line does in one face.
typedef struct sl_bsp_passage {
    uint32_t face;
    sl_bsp_crossing entry, exit;
    size_t first_stop, stop_count;  ///< of sl_bsp.stops: exact points on the line inside the face
    uint32_t entry_wall, exit_wall; ///< the walls before the first stop and behind the last one
    /// The corners on either side of the line; equal where the line is free there.
    sl_point entry_left, entry_right, exit_left, exit_right;
    /// The line, being free, ends in a new corner on the side; else in a corner that is there.
    bool entry_new, exit_new;
    /// How often corners have been placed in vain, for the pieces left and right of the line, and
    /// how far off those of walls are tried for it: 0 as near as can be.
    uint32_t failures[2], entry_try[2], exit_try[2];
    int32_t node;       ///< that splits the face along the line
    sl_bsp_walls walls; ///< those that were inside the face
} sl_bsp_passage;

/// A point on the line with what goes on from there along it: a wall, or SL_BEYOND_EXIT.
typedef struct sl_bsp_stop {
    sl_point at;
    uint32_t wall;
} sl_bsp_stop;

/// A convex piece of a face that is being split.
typedef struct sl_bsp_piece {
    sl_bsp_sides sides;
    sl_bsp_spot place;
    uint32_t passage, face;
    bool left;         ///< of the line
    bool reaches_over; ///< and beyond it: a corner is cut off the other side for it
} sl_bsp_piece;

/// Where the line, being free, gives way to a portal to a corner beside it, what lies between the
/// two belongs to the other side of the line: to the piece there that has the portal.
typedef struct sl_bsp_corner_cut {
    sl_bsp_spot place;
    uint32_t passage, joint;
    bool left; ///< of the piece
} sl_bsp_corner_cut;

/// A wall end on the line, for sorting.
typedef struct sl_bsp_along {
    double key; ///< a coordinate, growing along the line
    sl_point at;
} sl_bsp_along;

typedef struct sl_bsp {
    sl_context *context;
    const sl_wall *walls; ///< the map's, and behind them the parts of its seams
    uint32_t wall_count;  ///< of the map's
    const sl_bsp_options *options;
    sl_box bounds;
    SL_ARRAY(sl_bsp_face) faces;
    SL_ARRAY(sl_node) nodes; ///< children: as in sl_node, but ~face for cells
    SL_ARRAY(sl_segment) lines;
    SL_ARRAY(uint32_t) waiting; ///< faces that have walls inside
    int32_t root;
    bool of_space; ///< the faces at first are a space's cells: they keep their numbers
    // The line being put in, and scratch for it.
    sl_point a, b;
    SL_ARRAY(sl_bsp_passage) passages; ///< in order along the line
    SL_ARRAY(sl_bsp_stop) stops;
    SL_ARRAY(sl_bsp_piece) pieces;
    SL_ARRAY(sl_bsp_corner_cut) cuts;
    sl_bsp_walls on_line; ///< walls on the line in the face at hand
    SL_ARRAY(sl_bsp_along) along;
    SL_ARRAY(int8_t) signs;
    size_t seams_left_out;   ///< in how many cells
    bool unplaced;           ///< a seam has nowhere to pass
    bool placed;             ///< the pieces' sides are the faces' already
    uint32_t failed_passage; ///< where a piece cannot be made convex
    bool failed_left;
} sl_bsp;

/// After so many failures, corners within a wall are left out.
#define SL_BSP_PATIENCE 4

/// Whether a number, of a wall or of what is on the line, is that of a part of a seam. A seam is
/// put in as a wall is, but its sides are portals.
static inline bool sl_bsp_is_seam(const sl_bsp *bsp, uint32_t what) {
    return what >= bsp->wall_count && what < SL_BEYOND_BORDER;
}

static inline bool sl_bsp_is_wall(const sl_bsp *bsp, uint32_t what) {
    return what < bsp->wall_count;
}

// --- faces (bsp_face.c)

static inline bool sl_same_point(sl_point a, sl_point b) {
    return a.x == b.x && a.y == b.y;
}

static inline sl_point sl_side_end(const sl_bsp_sides *sides, size_t i) {
    return sides->items[i + 1 == sides->count ? 0 : i + 1].from;
}

/// Exactly convex, counter-clockwise, of positive area; corners may be flat, but not repeat. They
/// lie `stride` bytes apart.
bool sl_convex_corners(const void *first, size_t stride, size_t count);
bool sl_bsp_convex(const sl_bsp_sides *sides);
/// Whether the point is strictly inside a convex face.
bool sl_bsp_holds(const sl_bsp_sides *sides, sl_point point);
/// Whether a wall has a point strictly inside a convex face. If not, *along is the side that it
/// lies along, or SIZE_MAX.
bool sl_bsp_hits(const sl_bsp_sides *sides, const sl_wall *wall, size_t *along);
/// Whether the point is on the wall's line or behind it, as seen from a side that it stands on.
bool sl_bsp_behind(const sl_wall *wall, bool reversed, sl_point point);
/// The diagonal, from corner *from to corner *to, that cuts an inner corner away; false where there
/// is none.
bool sl_bsp_diagonal(const sl_bsp_sides *sides, size_t *from, size_t *to);
sl_status sl_bsp_add_side(sl_context *context, sl_bsp_sides *sides, sl_bsp_side side);

// --- putting walls in (bsp.c)

/// Splits the faces that wait, until no wall is inside one that it could be put into.
sl_status sl_bsp_settle(sl_bsp *bsp);
/// Frees what it owns: not the walls.
void sl_bsp_destroy(sl_bsp *bsp);

// --- putting a line in

/// Follows a wall from a face both ways: fills passages and stops (bsp_trace.c).
sl_status sl_bsp_trace(sl_bsp *bsp, uint32_t face, uint32_t wall);
/// Chooses the corners (bsp_place.c).
void sl_bsp_place(sl_bsp *bsp);
/// Has the corners where the pieces failed tried farther off; false where all has been tried.
bool sl_bsp_try_farther(sl_bsp *bsp);
/// Makes the convex pieces that the faces are split into; *done is false where the corners do not
/// allow it, and failed_passage and failed_left tell where (bsp_pieces.c).
sl_status sl_bsp_make_pieces(sl_bsp *bsp, bool *done);
void sl_bsp_drop_pieces(sl_bsp *bsp);
/// Puts the pieces in the place of the faces (bsp_cut.c).
sl_status sl_bsp_replace_faces(sl_bsp *bsp);
/// Gives the pieces the walls that the faces had inside (bsp_walls.c).
sl_status sl_bsp_deal_walls(sl_bsp *bsp);
/// Has a wall wait in a face to be put in.
sl_status sl_bsp_add_wall(sl_bsp *bsp, uint32_t face, uint32_t wall);
bool sl_bsp_has_wall(const sl_bsp_face *face, uint32_t wall);
/// Adds walls to the faces that have them inside by more than rounding, and do not know of them
/// (bsp_lost.c).
sl_status sl_bsp_find_lost(sl_bsp *bsp);
/// How deep the middle of what is inside of a wall lies in a convex face, whose corners lie
/// `stride` bytes apart; 0 where nothing is. Rounded.
double sl_wall_depth(const void *first, size_t stride, size_t count, const sl_wall *wall);
/// What rounding may have done to a place, at most.
double sl_bsp_slack(const sl_box *bounds);
/// How far beside a seam's line its portals may lie: more, as no face must be bent.
double sl_bsp_seam_slack(const sl_box *bounds);

/// Makes walls of what a wall covers of the portals of a face that it is in line with; a part of a
/// seam marks them (bsp_walls.c).
sl_status sl_bsp_close_portals(sl_bsp *bsp, uint32_t face, uint32_t wall);
/// Gives all faces the parts of the seams that they have inside, when the walls are in, and marks
/// the portals on parts (bsp_seams.c).
sl_status sl_bsp_deal_seams(sl_bsp *bsp, size_t count);

/// The side of a face that runs from one point to another and leads to `beyond`; SIZE_MAX for none.
size_t sl_bsp_find_side(const sl_bsp_face *face, sl_point from, sl_point to, uint32_t beyond);
/// Puts a corner into a side: what is behind it becomes a side of its own.
sl_status sl_bsp_insert_corner(sl_context *context, sl_bsp_face *face, size_t side, sl_point at);
bool sl_bsp_is_passage(const sl_bsp *bsp, uint32_t face);

/// A coordinate that grows along the line.
static inline double sl_bsp_key(const sl_bsp *bsp, sl_point p) {
    if (fabs(bsp->b.x - bsp->a.x) >= fabs(bsp->b.y - bsp->a.y))
        return bsp->b.x > bsp->a.x ? p.x : -p.x;
    return bsp->b.y > bsp->a.y ? p.y : -p.y;
}

/// Where among a face's walls the one is whose line is the split of least cost, but for those that
/// are set aside (bsp_choose.c).
size_t sl_bsp_choose(const sl_bsp *bsp, const sl_bsp_face *face);

/// Makes a space of the faces, the seams told of its portals (bsp_space.c). Cells are numbered as
/// the tree leads to them, or as the faces are where those are a space's cells.
sl_status sl_bsp_make_space(sl_bsp *bsp, const sl_seam_parts *seams, sl_space *out);

/// The check of a space that tells its sides, of which counts and bounds are checked (check_bsp.c).
sl_status sl_check_bsp(sl_context *context, const sl_space *space);
/// The check of an exit against its portal, of any space (check.c). `exits_found`, by portal: 1 for
/// the exit of cell[0], 2 for that of cell[1]; each may be there once.
sl_status sl_check_exit(sl_context *context, const sl_space *space, uint32_t cell,
                        const sl_exit *exit, uint8_t *exits_found);

#endif

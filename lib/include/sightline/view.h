/// A view: where an eye is and which way it looks; and the methods of eye-to-cell culling.
///
/// An eye stands in the cell that sl_space_locate gives, and in each cell that portals at the eye
/// join with it: it is on the portal, or on its end, and so on from cell to cell. It sees what it
/// sees from any of these cells. All that asks what an eye sees keeps to this: the region, the
/// culling methods, boxes, queries and the runtime header. So:
///
/// - An eye on a portal, or where portals meet, sees to all sides.
/// - At the end of a wall, and at a corner of solid ground, it sees all around, but for what lies
///   behind the wall or in the solid ground. No direction along the wall hides anything.
/// - Within a wall, between its ends, it sees one side, that of its cell. So nobody looks through a
///   wall that has no thickness. Where one side is inside, it is that one.
/// - Where walls meet, they part what is around the eye. It sees the part that has its cell.
/// - A shut door is a wall. So is one-way glass for an eye on its dark side. For an eye in line
///   with glass, it is dark if any of the cell that sl_space_locate gives is on its dark side.
/// - A cone sees those of the eye's cells that it leads into: some of its directions enter the
///   cell, or run along its border. It does not see a cell that it only leaves. So an eye on a wall
///   that looks into the wall sees no cell.
/// - An eye outside the bounds or in solid ground stands in no cell, and sees nothing.
///
/// What is looked at has no side: a point on a wall or on a shut door is seen from both. So of two
/// points each sees the other or none does, unless one of them is where walls, shut doors or glass
/// part what is around it, or glass is between them.
#ifndef SIGHTLINE_VIEW_H
#define SIGHTLINE_VIEW_H

#include "sightline/space.h"
#include "sightline/stab.h"

#ifdef __cplusplus
extern "C" {
#endif

/// An eye with its view cone, or with a full circle. The cone goes counter-clockwise from the ray
/// through `right` to the ray through `left`, borders included. It is given by points, so
/// predicates on it are exact. Two rays of one direction make a cone of 0 degrees.
typedef struct sl_view {
    sl_point eye;
    bool full;            ///< all round: `left` and `right` are not used
    sl_point left, right; ///< other than the eye
} sl_view;

/// A view of the full circle.
SL_API sl_view sl_view_all_round(sl_point eye);

/// A cone about a heading, in degrees counter-clockwise from +x, `fov` degrees wide: 0 to 360,
/// where 360 and more is all round. The border points are rounded and lie about `reach` from the
/// eye. Pass the map's size, so that they differ from the eye.
SL_API sl_view sl_view_cone(sl_point eye, double heading, double fov, double reach);

// --- eye-to-cell culling
//
// Which cells does one viewpoint see? Methods from loose to exact (Teller &
// Séquin 1991, Eye to Cell Visibility). On every input, each method's cells are among those of the
// method before it in the table.
//
// The eye stands in one or more cells: view.h says in which. A cell is seen through a portal
// sequence from one of these if a line through the eye, in a direction within the cone, crosses
// the sequence. As everywhere, some direction must cross all portals strictly forwards. Closed
// sight takes lines that touch portal ends or run along portals. A line may cross portals that it
// runs along to its left or to its right, but not some to the left and others to the right. The
// runtime header keeps the same rule.
//
// Of the cells that the eye stands in, the exact method sees those that the cone leads into, with
// open sight, too, and within any range. The others keep all. But nothing is seen if the visible
// set of the first one is empty. The visible sets of all of them count: that of one cell has what
// is seen through its own portals, and not what is seen from its corner around the end of a wall.
// For an eye in line with glass that is not dark, those of the cells at that glass count, too: the
// visible set of a cell on its dark side lacks what an eye sees along the glass.
//
// Open sight needs an open set of directions: with it, a cone of 0 degrees sees only cells that
// the eye stands in.

/// What a query cost.
typedef struct sl_eye_account {
    uint64_t nodes; ///< cells tested, kept or not; for the exact method nodes of the stab tree that
                    ///< are seen: a cell counts once for each portal sequence
    uint64_t orientations; ///< orientation tests
    uint64_t rounded;      ///< rounded images in mirrors, of the eye or of a ray's point
} sl_eye_account;

/// The number of words in a set of the space's cells.
SL_API size_t sl_eye_words(const sl_space *space);

/// Whether a set holds a cell.
static inline bool sl_eye_sees(const uint64_t *cells, uint32_t cell) {
    return cells[cell / 64] >> (cell % 64) & 1;
}

struct sli_eye_search; // the scratch memory of queries

/// A culling method, for sl_query_look. `cull` fills the caller's `cells`, sl_eye_words() words:
/// bit c % 64 of word c / 64 is cell c. `account`, which may be NULL, is set, not added to. No
/// memory is allocated. Errors: SL_BAD_ARGUMENT for a view that is not usable or missing visible
/// sets, SL_BAD_INPUT for a space that no map can have, SL_CANCELLED; `cells` is then undefined.
/// The guarantee holds with exact visible sets. What rounded ones (SL_ROUNDED) miss is missed here
/// too.
typedef struct sl_eye_method {
    const char *name, *what;
    sl_guarantee guarantee;
    bool needs_pvs; ///< whether it needs visible sets
    sl_status (*cull)(sl_context *context, struct sli_eye_search *search, const sl_view *view,
                      uint64_t *cells, sl_eye_account *account);
    /// The same for cells that are seen by mirror, with at least one reflection. The eye's own cell
    /// may be among them. A method that needs visible sets gives what was baked as seen by mirror.
    /// Memory may be allocated. NULL: the method does not support mirrors.
    sl_status (*mirrored)(sl_context *context, struct sli_eye_search *search, const sl_view *view,
                          uint64_t *cells, sl_eye_account *account);
} sl_eye_method;

/// All methods, the loosest first, from "cell_to_cell" to "exact".
SL_API const sl_eye_method *sl_eye_methods(size_t *count);

#ifdef __cplusplus
}
#endif

#endif

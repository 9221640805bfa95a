/// Eye-to-cell culling: which cells one viewpoint sees, by methods from loose to exact (Teller &
/// Séquin 1991, Eye to Cell Visibility). Each method's cells are among those of the one before it
/// in the table, on every input.
///
/// The eye is in the cell that sl_space_locate gives, its border included, and sightlines start
/// there: portal sequences from that cell count that a line through the eye crosses, in a direction
/// within the cone. As everywhere, sequences count only if some direction crosses all their portals
/// strictly forwards, and closed sight takes lines that touch portal ends or run along portals. So
///
/// - an eye on a portal, or where portals meet, sees to all sides of it, whichever of the cells it
///   is in; cells that a line passes at the eye itself, on the way to what is behind them, count;
/// - an eye on a wall, or on a wall's end, stands in its cell and sees what is to be seen from
///   there: not through the wall, nor round its end against the direction of sight;
/// - an eye outside the bounds sees nothing: no method keeps a cell;
/// - the eye's own cell is always seen (where its visible set is not empty).
///
/// Open sight asks for an open set of directions: beside the eye's own cell, a cone of 0 degrees
/// sees nothing with it.
#ifndef SIGHTLINE_EYE_TO_CELL_H
#define SIGHTLINE_EYE_TO_CELL_H

#include "sightline/cell_to_cell.h"
#include "sightline/view.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What a query cost.
typedef struct sl_eye_account {
    uint64_t nodes; ///< cells looked at, kept or not; of the exact method, nodes of the stab tree
                    ///< that are seen: a cell once for each portal sequence
    uint64_t orientations; ///< orientation tests
    uint64_t rounded;      ///< images in mirrors, of the eye or of a ray's point, that are rounded
} sl_eye_account;

/// What queries on one space work with. Serves one thread at a time.
typedef struct sl_eye_search sl_eye_search;

/// `visibility` holds the visible sets and the sight; it may be without rows (zeroed but for its
/// sight): the exact method then searches the whole space, and the others refuse. Where it has the
/// eye's cell's stab tree the exact method goes down that. Both must outlive the search.
/// SL_BAD_ARGUMENT where they do not go together. Memory: about 200 bytes a cell.
SL_API sl_status sl_eye_search_create(sl_context *context, const sl_space *space,
                                      const sl_visibility *visibility, sl_eye_search **out);
/// Frees a search; NULL is fine.
SL_API void sl_eye_search_destroy(sl_context *context, sl_eye_search *search);

/// Has a search look into mirrors: those of `map`, whose walls the space was made from, with
/// `depth` reflections of a sightline at most. The map must outlive the search.
///
/// A sightline is reflected where it crosses a mirror as it would cross a portal, by the same
/// rules: that it crosses them all strictly forwards, in mirrored space. An eye on a mirror is so
/// seen to look into it.
///
/// Behind axial mirrors answers are exact: the eye's image, which looks at the map itself through
/// the mirror, is kept as sums of coordinates in two doubles each, and the predicates take these.
/// Where two do not hold one (coordinates of more than about 30 digits apart), and behind oblique
/// mirrors, images are rounded, which the account counts: the answer is then exact for an eye and a
/// cone that each reflection moves by a few units in the last place of the largest coordinates.
SL_API sl_status sl_eye_search_add_mirrors(sl_context *context, sl_eye_search *search,
                                           const sl_map *map, uint32_t depth);

/// How far the method "exact" sees, directly and by mirror, in the queries that follow; 0, as at
/// first, for no limit. Of a cell it counts how far the nearest place is that the eye sees of it,
/// along the sightline with its reflections: exactly (of images that are rounded, from where they
/// are), so that one at just that distance is seen with closed sight and not with open sight. The
/// other methods know no range.
SL_API void sl_eye_search_limit(sl_eye_search *search, double range);

/// The number of words in a set of the space's cells.
SL_API size_t sl_eye_words(const sl_space *space);

/// Whether a set holds a cell.
static inline bool sl_eye_sees(const uint64_t *cells, uint32_t cell) {
    return cells[cell / 64] >> (cell % 64) & 1;
}

/// A culling method. `cull` fills the caller's `cells`, sl_eye_words() words: bit c % 64 of word
/// c / 64 is cell c. `account` is set, not added to. No memory is allocated. SL_BAD_ARGUMENT on a
/// view that is not usable or missing visible sets, SL_BAD_INPUT on a space that no map can have,
/// SL_CANCELLED; the contents of `cells` are then undefined. The guarantee is that of the method
/// with visible sets that are exact; rounded ones (SL_ROUNDED) hand on what they miss.
typedef struct sl_eye_method {
    const char *name, *what;
    sl_guarantee guarantee;
    bool needs_pvs; ///< whether it needs visible sets
    sl_status (*cull)(sl_context *context, sl_eye_search *search, const sl_view *view,
                      uint64_t *cells, sl_eye_account *account);
    /// Likewise the cells that are seen by mirror, with at least one reflection; the eye's own may
    /// be among them. Of a method that needs visible sets, what was baked as seen by mirror. Memory
    /// may be allocated. NULL: the method does not know mirrors.
    sl_status (*mirrored)(sl_context *context, sl_eye_search *search, const sl_view *view,
                          uint64_t *cells, sl_eye_account *account);
} sl_eye_method;

/// All methods, the loosest first: "cell_to_cell", "disjoint_cell", "connected_component",
/// "incident_portals", "exact".
SL_API const sl_eye_method *sl_eye_methods(size_t *count);

#ifdef __cplusplus
}
#endif

#endif

/// Eye-to-cell culling: which cells does one viewpoint see? Methods from loose to exact (Teller &
/// Séquin 1991, Eye to Cell Visibility). On every input, each method's cells are among those of the
/// method before it in the table.
///
/// The eye stands in one or more cells: view.h says in which. A cell is seen through a portal
/// sequence from one of these if a line through the eye, in a direction within the cone, crosses
/// the sequence. As everywhere, some direction must cross all portals strictly forwards. Closed
/// sight takes lines that touch portal ends or run along portals. A line may cross portals that it
/// runs along to its left or to its right, but not some to the left and others to the right. The
/// runtime header keeps the same rule.
///
/// Of the cells that the eye stands in, the exact method sees those that the cone leads into, with
/// open sight, too, and within any range. The others keep all. But nothing is seen if the visible
/// set of the first one is empty. The visible sets of all of them count: that of one cell has what
/// is seen through its own portals, and not what is seen from its corner around the end of a wall.
///
/// Open sight needs an open set of directions: with it, a cone of 0 degrees sees only cells that
/// the eye stands in.
#ifndef SIGHTLINE_EYE_TO_CELL_H
#define SIGHTLINE_EYE_TO_CELL_H

#include "sightline/cell_to_cell.h"
#include "sightline/view.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What a query cost.
typedef struct sl_eye_account {
    uint64_t nodes; ///< cells tested, kept or not; for the exact method nodes of the stab tree that
                    ///< are seen: a cell counts once for each portal sequence
    uint64_t orientations; ///< orientation tests
    uint64_t rounded;      ///< rounded images in mirrors, of the eye or of a ray's point
} sl_eye_account;

/// The scratch memory of queries on one space. For one thread at a time.
typedef struct sl_eye_search sl_eye_search;

/// `visibility` holds the visible sets and the sight. It may have no rows (all zero but for the
/// sight): then the exact method searches the whole space, and the others refuse. Where it has the
/// stab tree of the eye's cell, the exact method uses it. Both must outlive the search.
/// SL_BAD_ARGUMENT where the two do not fit together. Memory: about 200 bytes a cell.
SL_API sl_status sl_eye_search_create(sl_context *context, const sl_space *space,
                                      const sl_visibility *visibility, sl_eye_search **out);
/// Frees a search; NULL is fine.
SL_API void sl_eye_search_destroy(sl_context *context, sl_eye_search *search);

/// Makes a search use mirrors: those of `map`, whose walls the space was made from, with up to
/// `depth` reflections of a sightline. The map must outlive the search.
///
/// A sightline crosses a mirror as it would cross a portal, by the same rules: it must cross all of
/// them strictly forwards, in mirrored space. So an eye on a mirror looks into it.
///
/// Behind axial mirrors answers are exact. The eye's image looks at the map through the mirror. Its
/// coordinates are sums of two doubles, and the predicates take these. Images are rounded where two
/// doubles do not suffice (coordinates that are more than about 30 digits apart) and behind oblique
/// mirrors; the account counts them. The answer is then exact for an eye and a cone that each
/// reflection moves by a few units in the last place of the largest coordinates.
SL_API sl_status sl_eye_search_add_mirrors(sl_context *context, sl_eye_search *search,
                                           const sl_map *map, uint32_t depth);

/// Sets how far the method "exact" sees, directly and by mirror, in later queries; 0 for no limit
/// (the default). The distance of a cell is that of the nearest place that the eye sees of it,
/// along the sightline with its reflections. It is compared exactly: a place at just that distance
/// is seen with closed sight, and not with open sight. Rounded images count from where they are.
/// The other methods know no range.
SL_API void sl_eye_search_set_range(sl_eye_search *search, double range);

/// The number of words in a set of the space's cells.
SL_API size_t sl_eye_words(const sl_space *space);

/// The cells that an eye stands in (view.h), that of sl_space_locate first. Returns how many there
/// are: 0 outside the bounds and in solid ground. `cells` has room for all cells of the space, and
/// `marks` for sl_eye_words() words, which are 0 before and after.
SL_API uint32_t sl_eye_cells(const sl_space *space, sl_point eye, uint32_t *cells, uint64_t *marks);

/// Whether a set holds a cell.
static inline bool sl_eye_sees(const uint64_t *cells, uint32_t cell) {
    return cells[cell / 64] >> (cell % 64) & 1;
}

/// A culling method. `cull` fills the caller's `cells`, sl_eye_words() words: bit c % 64 of word
/// c / 64 is cell c. `account`, which may be NULL, is set, not added to. No memory is allocated.
/// Errors: SL_BAD_ARGUMENT for a view that is not usable or missing visible sets, SL_BAD_INPUT for
/// a space that no map can have, SL_CANCELLED; `cells` is then undefined. The guarantee holds with
/// exact visible sets. What rounded ones (SL_ROUNDED) miss is missed here too.
typedef struct sl_eye_method {
    const char *name, *what;
    sl_guarantee guarantee;
    bool needs_pvs; ///< whether it needs visible sets
    sl_status (*cull)(sl_context *context, sl_eye_search *search, const sl_view *view,
                      uint64_t *cells, sl_eye_account *account);
    /// The same for cells that are seen by mirror, with at least one reflection. The eye's own cell
    /// may be among them. A method that needs visible sets gives what was baked as seen by mirror.
    /// Memory may be allocated. NULL: the method does not support mirrors.
    sl_status (*mirrored)(sl_context *context, sl_eye_search *search, const sl_view *view,
                          uint64_t *cells, sl_eye_account *account);
} sl_eye_method;

/// All methods, the loosest first, from "cell_to_cell" to "exact".
SL_API const sl_eye_method *sl_eye_methods(size_t *count);

#ifdef __cplusplus
}
#endif

#endif

/// What the culling methods share: the scratch of a search, and how each query begins.
#ifndef SL_EYE_SEARCH_H
#define SL_EYE_SEARCH_H

#include "cell_to_cell/search/portal_search.h"
#include "effects/mirrors.h"
#include "sight/cone.h"
#include "sight/moving.h"
#include "sightline/support.h"
#include "space/boxes.h"
#include "space/index.h"

/// The option SIGHTLINE_BOXES of the build. Without it a query refuses boxes, and nothing leads to
/// the sources that are for boxes alone: a linker can leave them out.
#ifdef SLI_WITHOUT_BOXES
enum { SLI_BOXES = 0 };
#else
enum { SLI_BOXES = 1 };
#endif

/// A step of the exact method: a cell that is entered, or a node of the stab tree.
typedef struct sli_eye_step {
    sli_portal_step at; ///< `next` is the node's number in a stab tree
    uint32_t ray;       ///< over portals: the number of the ray, where a single one is left
    bool near;          ///< the eye is on the portal crossed last, or this is a cell of its own
    bool limited;       ///< the way has crossed a limited wall
    unsigned arc_count; ///< over portals, 1 but for an eye's cell
    sli_arc arcs[2];    ///< what is seen into the cell: within a wide cone up to two arcs
} sli_eye_step;

/// Pieces of cells' boundaries. A search marks those that it meets.
typedef struct sli_eye_targets {
    const uint32_t *first; ///< by cell: its targets are items[first[cell] .. first[cell + 1])
    const sl_directed_portal
        *targets; ///< as crossed on the way out of the cell; `portal`: of `met`
    bool *met;
} sli_eye_targets;

/// The boxes that reach into each cell of a space.
typedef struct sli_box_lists {
    const sl_moving_box *boxes; ///< the caller's
    size_t count;
    uint32_t *first; ///< by cell: its boxes are items[first[cell] .. first[cell + 1])
    uint32_t *items;
} sli_box_lists;

/// What a search by mirror needs (exact_mirrored.c).
typedef struct sli_eye_mirrors {
    const sl_map *map;
    uint32_t depth;
    sli_mirror_sides sides;
    sli_fine *images;      ///< of the eye, by the number of mirrors
    sli_portal_search way; ///< of steps with their mirrors
    uint64_t rounded;
} sli_eye_mirrors;

/// The scratch memory of queries on one space. For one thread at a time.
typedef struct sli_eye_search {
    double range; ///< of the exact method; 0 for no limit
    const sl_space *space;
    const sl_visibility *visibility;
    const bool *shut;             ///< by door of the map, for the visible sets; NULL: all are open
    const sli_boxed_space *boxed; ///< of which `space` is: maps its cells to those of the ground,
                                  ///< which rows and bits are of; NULL for a space without boxes
    sli_eye_targets targets;      ///< for the exact method, also by mirror; `first` NULL: none
    const sli_box_lists *boxes;   ///< likewise, with closed sight and without mirrors; NULL: none
    bool *boxes_seen;             ///< by box: whether the search has met it
    sl_bits *limited; ///< by portal: whether it is on a limited wall; NULL where none is
    bool has_pvs;
    bool in_line;        ///< with glass, which the space has open both ways, unlike the visible
                         ///< sets: those of its cells count as well
    sl_bits *row;        ///< the visible sets of the eye's cells
    uint32_t *queue;     ///< cells to spread from, the eye's first
    sli_eye_step *steps; ///< cell_count + 3 of them
    uint32_t *rays;      ///< SLI_RAY_SIDES a cell: the last ray that has come to it. With limited
                         ///< walls twice as many: for ways that have crossed none, then for others
    uint32_t ray_count;
    sli_eye_mirrors *mirrors; ///< NULL for none
} sli_eye_search;

/// `visibility` holds the visible sets and the sight. It may have no rows (all zero but for the
/// sight): then the exact method searches the whole space, and the others refuse. Where it has the
/// stab tree of the eye's cell, the exact method uses it. Both must outlive the search.
/// SL_BAD_ARGUMENT where the two do not fit together. Memory: about 200 bytes a cell.
sl_status sli_eye_search_create(sl_context *context, const sl_space *space,
                                const sl_visibility *visibility, sli_eye_search **out);
/// Frees a search; NULL is fine.
void sli_eye_search_destroy(sl_context *context, sli_eye_search *search);

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
sl_status sli_eye_search_add_mirrors(sl_context *context, sli_eye_search *search, const sl_map *map,
                                     uint32_t depth);

/// Sets how far the method "exact" sees, directly and by mirror, in later queries; 0 for no limit
/// (the default). The distance of a cell is that of the nearest place that the eye sees of it,
/// along the sightline with its reflections. It is compared exactly: a place at just that distance
/// is seen with closed sight, and not with open sight. Rounded images count from where they are.
/// The other methods know no range.
void sli_eye_search_set_range(sli_eye_search *search, double range);

/// The cells that an eye stands in (view.h), that of sl_space_locate first. Returns how many there
/// are: 0 outside the bounds and in solid ground. `cells` has room for all cells of the space, and
/// `marks` for sl_eye_words() words, which are 0 before and after.
uint32_t sli_eye_cells(const sl_space *space, sl_point eye, uint32_t *cells, uint64_t *marks);

enum { SLI_RAY_SIDES = 3 };

/// A query under way.
typedef struct sli_eye_query {
    sli_eye_search *search;
    const sl_space *space;
    sli_pivot pivot;
    sli_cone cone;
    uint32_t fan_count; ///< of the eye's cells (sightline/view.h), which begin the search's queue;
                        ///< 0 where it sees nothing
    uint64_t nodes;     ///< so far
    sl_bits *cells;     ///< the result
} sli_eye_query;

/// A search of a space with boxes. The visibility is that of the ground, with `row_cells` cells.
sl_status sli_eye_search_create_cut(sl_context *context, const sli_boxed_space *boxed,
                                    const sl_visibility *visibility, uint32_t row_cells,
                                    sli_eye_search **out);

/// Checks the view, finds the eye's cells and their visible sets, and empties the result.
sl_status sli_eye_begin(sl_context *context, sli_eye_search *search, const sl_view *view,
                        bool needs_pvs, uint64_t *cells, sli_eye_query *out);

void sli_eye_end(const sli_eye_query *query, sl_eye_account *account);

/// Whether a part of a cell is in the visible sets of the eye's cells. True where there are none.
static inline bool sli_eye_may_see(const sli_eye_query *query, uint32_t cell) {
    const sli_eye_search *search = query->search;
    const sli_boxed_space *boxed = search->boxed;
    if (!search->has_pvs) return true;
    if (!boxed) return sl_bits_has(search->row, cell);
    if (sl_bits_has(search->row, boxed->parents[cell])) return true;
    if (boxed->first_share)
        for (uint32_t i = boxed->first_share[cell]; i < boxed->first_share[cell + 1]; i++)
            if (sl_bits_has(search->row, boxed->shares[i])) return true;
    return false;
}

/// Whether a cell meets the cone.
static inline bool sli_eye_meets_cell(sli_eye_query *query, uint32_t number) {
    const sl_cell *cell = &query->space->cells[number];
    return query->cone.full ||
           sli_cone_meets_polygon(&query->pivot, &query->cone,
                                  query->space->vertices + cell->first_vertex, cell->vertex_count);
}

/// Whether a portal meets the cone.
static inline bool sli_eye_meets_portal(sli_eye_query *query, const sl_directed_portal *portal) {
    return query->cone.full ||
           sli_cone_meets_segment(&query->pivot, &query->cone, portal->left, portal->right);
}

/// A first step of the exact method: one of the eye's cells, with all of the cone.
sli_eye_step sli_eye_first_step(const sli_eye_query *query, uint32_t fan);

/// Whether a cell is one of the eye's.
bool sli_eye_is_in(const sli_eye_query *query, uint32_t cell);

/// Whether the cone leads into one of the eye's cells: some of its directions enter the cell, or
/// run along its border. Then the eye sees the cell.
bool sli_eye_leads_into(sli_eye_query *query, uint32_t cell);

/// Whether to go on from a step of one arc: not where its single ray has come to the cell before.
/// Gives the ray a number, where it has none from the step before.
bool sli_eye_is_new(sli_eye_search *search, const sli_eye_step *from, sli_eye_step *to);

/// Marks the targets that are met in a cell just entered; `first` for a cell of the eye's own.
void sli_eye_meet_targets(sli_eye_query *query, const sli_eye_step *at, bool first);

/// Makes the visible sets those with doors shut (`shut` by door of the map; it must stay, and NULL
/// is for none). The space has walls there already.
void sli_moving_set_shut(sli_moving *moving, const bool *shut);

/// Makes it one for eyes in line with glass (sli_eye_search.in_line).
void sli_moving_set_in_line(sli_moving *moving);

/// Finds the cells of boxes, which must outlive the lists.
sl_status sli_box_lists_make(sl_context *context, const sl_space *space, const sl_moving_box *boxes,
                             size_t count, sli_box_lists *out);
void sli_box_lists_destroy(sl_context *context, sli_box_lists *lists); ///< and zeroes it

/// Finds which boxes an eye sees, if none of them blocks sight: with closed sight, no mirrors and
/// no range.
sl_status sli_eye_boxes_seen(sl_context *context, sli_eye_search *search,
                             const sli_box_lists *lists, const sl_view *view, uint64_t *cells,
                             bool *seen);

/// Marks the boxes that are seen in a cell just entered; `first` for a cell of the eye's own.
void sli_eye_meet_boxes(sli_eye_query *query, const sli_eye_step *at, bool first);

/// Frees them; NULL is fine.
void sli_eye_mirrors_destroy(sl_context *context, sli_eye_mirrors *mirrors);

/// Clips a step's arcs to a directed portal of its cell; `first` for a cell of the eye's own.
/// Leaves out arcs in which the portal is out of the search's range. False where nothing is left
/// that counts.
bool sli_eye_pass_in_range(sli_eye_query *query, const sli_eye_step *from, bool first,
                           const sl_directed_portal *portal, sli_eye_step *to);

/// Whether a step may cross a portal: not the second limited wall on the way. Notes in `to` whether
/// the way has crossed one.
static inline bool sli_eye_may_cross(const sli_eye_search *search, const sli_eye_step *from,
                                     uint32_t portal, sli_eye_step *to) {
    const bool limited = search->limited && sl_bits_has(search->limited, portal);
    to->limited = from->limited || limited;
    return !(from->limited && limited);
}

/// The exact method down the stab tree of one of the eye's cells. `done` is false where the tree is
/// not kept or its nodes are not in the order of a depth-first search.
sl_status sli_eye_exact_tree(sl_context *context, sli_eye_query *query, uint32_t fan, bool *done);

/// The exact method of the table, and what is seen by mirror with it.
sl_status sli_eye_exact(sl_context *context, sli_eye_search *search, const sl_view *view,
                        uint64_t *cells, sl_eye_account *account);
sl_status sli_eye_exact_mirrored(sl_context *context, sli_eye_search *search, const sl_view *view,
                                 uint64_t *cells, sl_eye_account *account);

#endif

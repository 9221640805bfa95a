/// What the files of placement for areas share. Begin with place_area.c.
#ifndef SLI_PLACE_AREA_H
#define SLI_PLACE_AREA_H

#include "analysis/placement/cover.h"
#include "analysis/placement/view_shapes.h"
#include "sightline/place_area.h"

/// In the list of who sees a witness: only beyond the chords of the range, so for the lower bound.
#define SLI_WIDE (UINT32_C(1) << 31)

typedef SL_ARRAY(uint32_t) sli_link_list;

/// How many places see a witness.
typedef struct sli_seen_by {
    uint32_t surely, maybe; ///< maybe: with those that are SLI_WIDE
} sli_seen_by;

/// Lines of sight between points of places, and rows that ask for them. Zeroed without a network.
typedef struct sli_network {
    size_t *first;      ///< by group, and one more: its links
    uint32_t *links;    ///< groups
    uint32_t *group_of; ///< by place
    uint32_t *region;   ///< by group: which part it is in that links join
    bool *failed;       ///< by such part: it cannot see all witnesses, or has not all that
                        ///< are fixed
    uint32_t region_count;
    size_t rows_known;          ///< witnesses that `failed` counts
    sl_point hidden;            ///< a witness that the largest part does not see
    bool is_rounded;            ///< one failed only since chords stand for arcs: bounds end there
    sli_seen_by *seen;          ///< scratch, by such part
    uint32_t *part, *queue;     ///< scratch, by group
    SL_ARRAY(size_t) row_ends;  ///< by row
    SL_ARRAY(uint32_t) entries; ///< places of which a network has one
} sli_network;

typedef struct sli_area {
    sl_context *context;
    sl_query *query;
    const sl_place_area *task;
    const sl_place_options *options;
    const sl_space *space;
    bool directed; ///< one-way glass: who sees a witness is asked from the places
    uint32_t cover;
    sl_shape target;   ///< what is to be seen
    double negligible; ///< areas that are rounding, all together
    sl_region region;  ///< scratch

    sli_view_shapes shapes; ///< of the walls, then of the places
    sl_view *views;         ///< by place
    sl_box *boxes;          ///< by place: about its shape
    double *ranges;         ///< by place: the one that counts
    uint32_t *groups;       ///< the first place of each point and range; one more than there are
    bool *on_edge;          ///< by group: the point is on a side of its cell
    uint32_t group_count;
    bool *fixed; ///< by place

    SL_ARRAY(sl_point) witnesses;
    SL_ARRAY(size_t) row_ends;  ///< by witness
    SL_ARRAY(uint32_t) entries; ///< places that see it, ascending, maybe with SLI_WIDE
    SL_ARRAY(uint32_t) row;     ///< scratch: the same of one point
    SL_ARRAY(double) lengths;   ///< of walls to scan: by witness, that of its piece
    SL_ARRAY(uint32_t) seers;   ///< scratch: groups
    uint32_t wide_count;        ///< witnesses with an entry that is SLI_WIDE
    sli_network network;

    sl_area_placement *out;
} sli_area;

/// The order of blind spots: the largest first, then by their places.
int sli_blind_spots_compare(const void *left, const void *right);
/// What two shapes have in common. The caller destroys it.
sl_status sli_shape_common(sl_context *context, const sl_shape *one, const sl_shape *other,
                           sl_shape *out);

// --- who sees what (area_rows.c)

/// Fills a->seers with the groups from `first` on that see a point, whatever their headings; of a
/// group that is nearer than its range along each axis only.
sl_status sli_area_seers(sli_area *a, sl_point at, uint32_t first);
/// Fills a->row with the places that see a point.
sl_status sli_area_look(sli_area *a, sl_point at);
/// Makes a->row a row, of the point as a witness.
sl_status sli_area_add_row(sli_area *a, sl_point at);
/// Whether the places of a->row could see the point more often than the chosen ones do.
bool sli_area_asks(const sli_area *a, const uint8_t *chosen);
/// Witnesses to begin with: near corners, and on a grid.
sl_status sli_area_first_witnesses(sli_area *a);
/// The set cover of all witnesses, and of the rows of a network. With `wide`, ranges are true.
/// `demands`: what the fixed places leave. The caller destroys it, on failure too.
sl_status sli_area_problem(sli_area *a, bool wide, sl_cover_problem *out);
void sli_area_problem_destroy(sl_context *context, sl_cover_problem *problem);
/// Whether the loops of a shape go around a point; on a loop, either may be.
bool sli_shape_holds(const sl_shape *shape, sl_point at);

// --- what chosen places leave (area_check.c)

/// Adds witnesses where the chosen places (bytes by place) leave something unseen that others could
/// see, *added of them. Where there is none, `out` gets what is seen and what is blind.
sl_status sli_area_check(sli_area *a, const uint8_t *chosen, uint32_t *added);
/// Whether each piece of an area has a shape over it, but for those that are rounding.
bool sli_area_is_covered(const sl_overlay *overlay);

// --- walls to scan (area_walls.c)

/// Whether walls are to be seen, and not the area.
bool sli_area_scans(const sli_area *a);
/// Adds all rows. `out` gets the length that is to be seen, and what is blind of it.
sl_status sli_area_walls(sli_area *a);

// --- lines to be seen (area_lines.c)

/// Whether lines are to be seen, and no area.
bool sli_area_has_only_lines(const sli_area *a);
/// Adds all rows. `out` gets the lengths of the lines, and without an area what is blind of them.
sl_status sli_area_lines(sli_area *a);

// --- networks (area_network.c)

sl_status sli_network_begin(sli_area *a);
void sli_network_end(sli_area *a);
/// Rules out parts of all places that cannot see new witnesses. SL_BAD_ARGUMENT where none is left.
sl_status sli_network_rule_out(sli_area *a);
/// Whether a place is in a part that is left; true without a network.
bool sli_network_allows(const sli_area *a, uint32_t place);
/// Adds places to chosen ones until lines of sight join all, and drops what is not needed for that
/// nor for the rows.
sl_status sli_network_join(sli_area *a, uint8_t *chosen);
/// The same for a cover that is read already. Of places that are as dear, what is not needed goes
/// from `start` on. *joined: false where a whole part of all places was taken.
sl_status sli_network_join_by(sli_area *a, const sli_cover *cover, uint32_t start, uint8_t *chosen,
                              bool *joined);
/// Looks for a cheaper network that covers all rows (area_network_search.c).
sl_status sli_network_search(sli_area *a, uint8_t *chosen);
/// Adds rows that all networks cover, and chosen places in parts do not, *added of them. Maybe none
/// for demands of several.
sl_status sli_network_cut(sli_area *a, const uint8_t *chosen, uint32_t *added);

// --- the most that a number of places sees (area_most.c)

sl_status sli_area_most(sli_area *a);

#endif

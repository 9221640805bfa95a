/// Placement: the fewest viewpoints that see everything, with a proof that fewer do not (the art
/// gallery problem).
///
///     sl_place_options options = sl_place_options_default();
///     sl_placement placement;
///     sl_status status = sl_place(context, query, &options, &placement);
///     if (status == SL_OK && placement.lower == placement.upper) // no fewer can do it
///         for (uint32_t i = 0; i < placement.count; i++) use(placement.viewpoints[i].at);
///     sl_placement_destroy(context, &placement);
///
/// Two bounds close in on the optimum (Tozoni, de Rezende and de Souza 2016, Algorithm 966: A
/// practical iterative algorithm for the art gallery problem using integer linear programming).
///
/// - `lower`: no set of fewer viewpoints, anywhere in the plane, sees all of `witnesses`, which are
///   points inside. `columns` has every largest set of witnesses that one place can see, and the
///   proof says that fewer of these sets do not hold all witnesses. Exact.
/// - `upper`: `viewpoints` see everything. Each point that is inside, or on the border of what is
///   inside, is in the visible region (region.h) of one of them. Exact, for the coordinates that
///   the viewpoints have. Anywhere, nothing is left out, be it thinner than any double: rather than
///   that, there is one more viewpoint. Only given places can leave `slivers`.
///
/// Sight is closed: it may graze walls. What is seen only in a single direction does not count for
/// the upper bound. It has no area, so all around it is seen, by others, and then it is, too.
#ifndef SIGHTLINE_PLACE_H
#define SIGHTLINE_PLACE_H

#include "sightline/query.h"
#include "sightline/set_cover.h"
#include "sightline/viewpoint.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What to do, and how much of it. sl_place_options_default() has the usual values.
typedef struct sl_place_options {
    const sl_cover_program *program; ///< for set covers; NULL: without a linear program
    const sl_point *places; ///< to choose from; NULL: anywhere. `lower` is then for these alone
    uint32_t place_count;
    uint64_t rounds; ///< up to this number; 0: up to 400, and no limit among given places
    uint64_t nodes;  ///< of the branching tree of each set cover, at most
    /// Entries of columns from which a round drops witnesses that others imply: it saves memory on
    /// large maps, and costs rounds.
    uint64_t many_entries;
} sl_place_options;

/// Anywhere, without a linear program.
SL_API sl_place_options sl_place_options_default(void);

/// A point that the lower bound asks to be seen.
typedef struct sl_witness {
    sl_point at; ///< inside, on no wall
    /// Whether sight is closed: lines that graze walls see it. Always true without limits of view
    /// and range.
    bool closed;
} sl_witness;

/// Zeroed, it is empty.
typedef struct sl_placement {
    uint64_t lower, upper;    ///< viewpoints; upper == count
    sl_viewpoint *viewpoints; ///< they see everything
    uint32_t count;
    sl_witness *witnesses; ///< of the lower bound: the rows of `columns`
    uint32_t witness_count;
    /// Column by column, the witnesses that a place sees (set_cover.h). Each set of witnesses that
    /// some place sees is part of a column.
    sl_cover_problem columns;
    sl_point *places;     ///< by column: a place that sees it, rounded
    sl_cover_proof proof; ///< of `lower`, for `columns`
    uint64_t rounds;
    /// Among given places only: parts of borders of visible regions beyond which something is
    /// unseen, so thin that a search found no unseen point there. None of the places sees it, or
    /// only within rounding. 0: nothing is unseen, proven; and so it is always anywhere.
    uint64_t slivers;
    double unseen_area;      ///< of the slivers, rounded
    double seen, seen_bound; ///< of sl_place_list.count: the weight that is seen; no set of so many
                             ///< places sees more than the bound
    bool given;              ///< among given places: both bounds are for these alone
} sl_placement;

/// Finds viewpoints for all that is inside of a query's space, with its doors as they are. They may
/// stand anywhere inside, or at given places (sl_place_options.places).
///
/// SL_BAD_ARGUMENT where nothing is inside, for a place that is not, and where something is seen
/// from none of the places, with a point of it. SL_UNSUPPORTED for maps with mirrors, one-way glass
/// or limited walls, and past boxes. Cancelled by the context, it returns SL_CANCELLED with the
/// best set and bounds so far in `out`, once it has a set. Reports stage "place". The same input
/// gives the same bytes.
SL_API sl_status sl_place(sl_context *context, sl_query *query, const sl_place_options *options,
                          sl_placement *out);

/// Where points are taken from.
typedef enum sl_place_from {
    SL_PLACE_CORNERS, ///< ends of walls, exactly
    SL_PLACE_WALLS,   ///< along walls, on each side that is inside, at equal distances of up to a
                      ///< step (0: the middle of each); off the wall by 2^-20 of its length
    SL_PLACE_GRID,    ///< multiples of a step
} sl_place_from;

/// Points that are inside, by x, then by y: to place viewpoints at, or as targets. The caller frees
/// them: sl_free(). SL_BAD_ARGUMENT for a step that is not positive (of walls: negative), for more
/// than 2^24 points, and where there is none.
SL_API sl_status sl_place_points(sl_context *context, sl_query *query, sl_place_from from,
                                 double step, sl_point **points, uint32_t *count);

/// A step between places along walls that suits a plan: a twentieth of the side of a square as
/// large as the inside, but with a range (0: no limit) not more than a third of it.
SL_API double sl_place_step(const sl_space *space, double range);

/// Places to choose from, and targets to see: both are lists, so fields of view, ranges, costs and
/// demands are possible. Bounds hold for these places and targets alone. What may be NULL is so
/// where nothing is said.
typedef struct sl_place_list {
    const sl_viewpoint *places; ///< a point with several headings: one after the other
    const uint32_t *costs;      ///< by place, at least 1; NULL: 1 each
    const sl_point *targets;
    const uint32_t *demands; ///< by target: how many places must see it; NULL: 1 each
    const double *weights;   ///< by target, for `count`; NULL: 1 each
    const uint32_t *fixed;   ///< places that are taken in any case, each once
    uint32_t place_count, target_count, fixed_count;
    uint32_t count; ///< 0: all targets are to be seen; else the most that so many places see
                    ///< beside the fixed ones
} sl_place_list;

/// Finds the cheapest of the places that see all targets, or the most that `count` places see. A
/// place sees a target in its visible region (region.h), within its field of view and range,
/// borders included. Exact.
///
/// `lower` and `upper` of the result are costs, of fixed places too. `columns` has the places
/// and what the fixed ones leave to be seen of the targets; its `proof` is of the rest of `lower`.
/// With `count` they are the number of places, and `seen` and `seen_bound` are weights.
///
/// SL_BAD_ARGUMENT with the target that too few places see, for numbers out of range, and for
/// `count` with demands. Cancelled as sl_place.
SL_API sl_status sl_place_among(sl_context *context, sl_query *query, const sl_place_list *list,
                                const sl_place_options *options, sl_placement *out);

/// What sl_place has proven, in a sentence or two: "No fewer can: 12 witnesses inside need 4
/// cameras, wherever they stand." `noun`: what to call a viewpoint, "camera". `stopped`: the work
/// ended early. Cut to fit `size`.
SL_API void sl_placement_say(const sl_placement *placement, const char *noun, bool stopped,
                             char *text, size_t size);
SL_API void sl_placement_destroy(sl_context *context, sl_placement *placement); ///< and zeroes it

#ifdef __cplusplus
}
#endif

#endif

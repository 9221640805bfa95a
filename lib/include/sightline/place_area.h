/// Placement of cameras: which of given places and headings see an area, with fields of view,
/// ranges, dead zones, costs, and by how many.
///
///     sl_viewpoint places[] = {{.at = {1, 1}, .heading = 45, .fov = 90, .range = 12}, ...};
///     sl_place_area area = {.places = places, .place_count = 2};
///     sl_area_placement placed;
///     sl_status status = sl_place_area_cover(context, query, &area, NULL, &placed);
///     if (status == SL_OK && placed.lower == placed.upper) // none of these sets costs less
///         for (uint32_t i = 0; i < placed.count; i++) use(places[placed.chosen[i]]);
///     sl_area_placement_destroy(context, &placed);
///
/// All of the area counts, and not only points of it. Points that are asked to be seen (witnesses)
/// are added where a set leaves something unseen, until it leaves nothing that one of the places
/// could see. Few of the witnesses are needed for that.
///
/// - `lower`: no set of these places that costs less sees all witnesses. Exact: who sees a witness
///   is decided by exact predicates, up to the true range.
/// - `upper`: the chosen places see all of the area but `blind`. Their regions are laid over it
///   (overlay.h), and chords stand for arcs so that nothing counts that is not seen (coverage.h).
///   Up to rounding: `rounding` is the area of pieces thinner than 2^-44 of the largest coordinate.
///   sl_place_area_proof_complete() adds what sees such pieces, exactly.
/// - `blind`: parts that fewer than `cover` of the places see, so no choice of them helps. There,
///   the chosen ones are as many as can be.
#ifndef SIGHTLINE_PLACE_AREA_H
#define SIGHTLINE_PLACE_AREA_H

#include "sightline/coverage.h"
#include "sightline/place.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Places to choose from, and the area to see. What may be NULL is so where nothing is said.
typedef struct sl_place_area {
    const sl_viewpoint *places; ///< a point with several headings: one after the other
    uint32_t place_count;
    const uint32_t *costs; ///< by place, at least 1; NULL: 1 each
    const uint32_t *fixed; ///< places that are taken in any case, each once, ascending
    uint32_t fixed_count;
    const sl_shape *see; ///< what of the inside is to be seen; NULL: all of it
    uint32_t cover;      ///< how many places must see each point; 0: 1
    uint32_t count;      ///< 0: see everything; else the most area that so many places see, beside
                         ///< the fixed ones
    /// With `count`: parts of what is to be seen, and weights by which their areas count, each over
    /// 0. Where parts overlap, both count. The areas of the result are multiplied by these weights
    /// then. NULL: all of it counts once.
    const sl_shape *zones;
    const double *weights; ///< by zone
    uint32_t zone_count;
    /// Chosen places form one network: lines of sight within the ranges of both ends join each to
    /// each, over others. Headings do not count there.
    bool network;
    /// Over 0, one or both: walls are to be seen in place of the area, each side that is inside.
    /// Each point of them from at most `scan_range` (0: no limit), by a line of sight that makes an
    /// angle of at least `scan_angle` degrees with the wall. Shut doors are walls,
    /// and so are dark sides of glass. The areas of the result are lengths of walls then.
    double scan_angle, scan_range;
    /// Segments of which each point is to be seen: routes, doors. With `see`, beside that area;
    /// else in its place, and the areas of the result are lengths of lines then. Only what is
    /// inside counts. Not with scans of walls; with `count`, not beside an area.
    const sl_segment *lines;
    const double *line_weights; ///< with `count`: by line, what its length is worth; NULL: 1 each
    uint32_t line_count;
} sl_place_area;

/// Zeroed, it is empty.
typedef struct sl_area_placement {
    uint64_t lower, upper; ///< costs, of fixed places too; with `count`, numbers of places
    uint32_t *chosen;      ///< places, ascending, the fixed ones among them
    uint32_t count;
    double area;     ///< to be seen
    double seen;     ///< of it, by at least `cover` of the chosen places
    double rounding; ///< of it, of pieces too thin to be decided
    double
        seen_most; ///< with `count`: no set of so many places sees more; `seen` where that is all
    double blind_area;
    sl_blind_spot *blind; ///< the largest first
    uint32_t blind_count;
    uint32_t witness_count;
    uint64_t rounds;
    /// Of `lower`, but for the costs of fixed places: by row of `columns` a witness, which places
    /// see it up to their true ranges, and what the fixed ones leave of its demand. The proof is of
    /// these columns, with the costs of the places (columns.costs is NULL). Empty with `count`.
    sl_point *witnesses;
    sl_cover_problem columns;
    sl_cover_proof proof;
    double *line_lengths; ///< by line, what of it is inside; NULL without lines
} sl_area_placement;

/// Finds the cheapest places that see the area, as far as these places can see it; or, with
/// `count`, places that see as much of it as so many can.
///
/// Doors count as the query has them, and one-way glass; the query's range is the most that counts.
/// SL_BAD_ARGUMENT with the number of a place that is none, where nothing is to be seen, where no
/// place sees anything of it, where no network sees all that places see, and for `count` with
/// `cover` or `network`. SL_UNSUPPORTED for mirrors and boxes.
/// Cancelled by the context, it returns SL_CANCELLED with the best set and bounds so far, once it
/// has a set. Reports stages "views" and "place"; once it has a set, "place" with both bounds. The
/// same input gives the same bytes.
SL_API sl_status sl_place_area_cover(sl_context *context, sl_query *query,
                                     const sl_place_area *area, const sl_place_options *options,
                                     sl_area_placement *out);
/// What is proven of a choice, in a sentence or two: "No fewer can, of these 96 places: 31 points
/// inside need 4 viewpoints." Costs are divided by `scale`. `stopped`: the work ended early. Cut to
/// fit `size`.
SL_API void sl_area_placement_say(const sl_place_area *area, const sl_area_placement *placement,
                                  double scale, bool stopped, char *text, size_t size);
/// "of these 96 places and headings at 12 points"
SL_API void sl_place_area_say_among(const sl_place_area *area, char *text, size_t size);
/// "4 viewpoints"; where places have costs of their own, "a cost of 7.5".
SL_API void sl_place_area_say_cost(const sl_place_area *area, double scale, uint64_t cost,
                                   char *text, size_t size);
SL_API void sl_area_placement_destroy(sl_context *context,
                                      sl_area_placement *placement); ///< and zeroes it

/// Of all points that a viewpoint like `like` could stand at to see `target`, looking there: one
/// that is nearest to one of the places. False where `target` is not inside. Rounded.
SL_API sl_status sl_place_nearest(sl_context *context, sl_query *query, const sl_viewpoint *like,
                                  sl_point target, const sl_viewpoint *places, uint32_t count,
                                  sl_point *out, bool *found);

#ifdef __cplusplus
}
#endif

#endif

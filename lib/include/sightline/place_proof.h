/// Proofs of placements: a file that says why no fewer viewpoints can do it, and a check of it by
/// other code than that which found it.
///
///     sl_place_proof_write(context, query, &placement, "proof.json");
///     ...
///     sl_placement claimed;
///     sl_place_verdict verdict;
///     sl_status status = sl_place_proof_read(context, query, "proof.json", &claimed);
///     if (status == SL_OK) status = sl_place_proof_check(context, query, &claimed, &verdict);
///     if (status == SL_OK && verdict.sees_all && verdict.lower == claimed.upper) // it is proven
///
/// What is checked, in exact arithmetic:
///
/// - The lower bound. A place anywhere in the map's bounds sees a set of the witnesses: those to
///   which a straight line leads that crosses no wall, though it may graze some. A place on a wall,
///   or in a corner, stands on one side of it. All largest such sets are found anew, and each must
///   be part of one of the file's columns. So whatever the columns are, fewer viewpoints than it
///   takes columns to hold all witnesses do not see all witnesses. That number is bounded in whole
///   numbers (sl_cover_check).
/// - The upper bound. Each point inside or on the border of what is inside is in the closed visible
///   region of a viewpoint: all but single directions of what straight lines from it reach without
///   crossing a wall. A viewpoint on a wall stands in the cell that sl_space_locate gives.
///
/// A proof holds one integer program, that of the lower bound. The upper bound needs none: it does
/// not matter how the viewpoints were found, only that they see everything, and this is checked.
///
/// Placements among given places (place_area.h) have proofs, too. Who checks one says again which
/// places there are and what is to be seen; the file only says which of them were chosen, and why
/// no cheaper ones do it:
///
/// - The lower bound: the check asks each place which witnesses it sees, within its cone and its
///   true range. Around a witness, at least as many places see as the witness demands. So any
///   choice that sees all that these places can see, as often as asked or as they can, sees the
///   witnesses so often. The set cover of places and witnesses is bounded in whole numbers.
/// - The upper bound: the chosen places see each point of the area, as often as is asked; or each
///   that some other place sees, from up to 0.9995 of its range, and from beyond 1.0006 of its dead
///   zone. Polygons up to 2e-6 within a range, and around a dead zone, stand for those of the
///   chosen places. All else is exact: the check knows no slivers.
#ifndef SIGHTLINE_PLACE_PROOF_H
#define SIGHTLINE_PLACE_PROOF_H

#include "sightline/place.h"
#include "sightline/place_area.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Writes a placement anywhere (sl_place without `places`) of the query's space. The file is JSON,
/// and is put in its place only when it is complete. Members come in this order: what it is of
/// (`sightline_proof`, `walls`, `walls_sum`), the bounds (`lower`, `upper`), points (`viewpoints`,
/// `witnesses`), `columns` of numbers of witnesses, the parts of an sl_cover_proof (`denominator`,
/// `steps`, `part_count`, `parts`, `nodes`, `duals`; null for none; where parts are split,
/// `splits`, each with `unit`, `blocks`, `costs` and the same parts for its copies; where they have
/// cuts, `raised`, each with `rows`, `cuts` and the same parts for rows and cuts), and `program`:
/// the integer program of the columns in CPLEX' LP format, which the reader passes over.
SL_API sl_status sl_place_proof_write(sl_context *context, sl_query *query,
                                      const sl_placement *placement, const char *path);
/// The same into a stream. Refused writes are left to the stream's error flag.
SL_API sl_status sl_place_proof_print(sl_context *context, sl_query *query,
                                      const sl_placement *placement, FILE *stream);
/// Reads what sl_place_proof_write() wrote, for the same walls. Only the claim is read: witnesses,
/// viewpoints, columns, proof and bounds. SL_BAD_INPUT, with file and line, for anything else, and
/// for a proof of another map.
SL_API sl_status sl_place_proof_read(sl_context *context, sl_query *query, const char *path,
                                     sl_placement *out);
/// The same from memory; `path` is for messages.
SL_API sl_status sl_place_proof_parse(sl_context *context, sl_query *query, const char *path,
                                      const char *text, size_t size, sl_placement *out);

/// What holds of a claim.
typedef struct sl_place_verdict {
    uint64_t lower;   ///< no fewer viewpoints see all inside; 0 where nothing is proven
    bool sees_all;    ///< the viewpoints see everything
    uint64_t places;  ///< that were tried for the lower bound
    uint64_t corners; ///< places that were tried for the upper bound
    sl_point extra;   ///< where lower is 0: about where a place sees witnesses that no column has,
                      ///< if has_extra
    bool has_extra;
    sl_point unseen; ///< where sees_all is false: next to this place, something is not seen
} sl_place_verdict;

/// Checks a claim. SL_BAD_ARGUMENT for witnesses and viewpoints that are not inside, and for
/// witnesses on walls. SL_UNSUPPORTED as sl_place.
SL_API sl_status sl_place_proof_check(sl_context *context, sl_query *query,
                                      const sl_placement *claim, sl_place_verdict *out);

// --- among given places

/// Writes a placement among the places of an area. Members of the file: `sightline_proof` (2),
/// `walls`, `walls_sum`, `places` and `places_sum` (which places and which area), `lower`, `upper`
/// (costs), `chosen` (numbers of places), `witnesses`, `demands` (what the fixed places leave of
/// them), the parts of an sl_cover_proof and `program` as above.
///
/// SL_UNSUPPORTED for networks, for the most that a number of places sees, for walls to scan, and
/// as sl_place_proof_check.
SL_API sl_status sl_place_area_proof_write(sl_context *context, sl_query *query,
                                           const sl_place_area *area,
                                           const sl_area_placement *placement, const char *path);
/// The same into a stream. Refused writes are left to the stream's error flag.
SL_API sl_status sl_place_area_proof_print(sl_context *context, sl_query *query,
                                           const sl_place_area *area,
                                           const sl_area_placement *placement, FILE *stream);
/// Reads what sl_place_area_proof_write() wrote, for the same walls, places and area: bounds,
/// chosen places, witnesses, demands and proof. SL_BAD_INPUT, with file and line, for anything
/// else.
SL_API sl_status sl_place_area_proof_read(sl_context *context, sl_query *query,
                                          const sl_place_area *area, const char *path,
                                          sl_area_placement *out);
/// The same from memory; `path` is for messages.
SL_API sl_status sl_place_area_proof_parse(sl_context *context, sl_query *query,
                                           const sl_place_area *area, const char *path,
                                           const char *text, size_t size, sl_area_placement *out);

/// What holds of a claim.
typedef struct sl_place_area_verdict {
    uint64_t lower;   ///< no choice that costs less sees all that the places can see; 0: not proven
    uint64_t upper;   ///< cost of the chosen places
    bool sees_all;    ///< they see all that is to be seen, as often as asked
    bool sees_as_all; ///< they see as much of it as all places do
    uint64_t corners; ///< places that were tried for the upper bound
    sl_point unseen;  ///< where sees_as_all is false: next to this point,
    uint32_t place;   ///< this place sees something that too few of the chosen ones see
    uint32_t weak;    ///< where lower is 0: a witness that demands more than is seen all around it,
                      ///< or is on no part of the area; UINT32_MAX: none
} sl_place_area_verdict;

/// Checks a claim. SL_BAD_ARGUMENT for chosen places that are none or are named twice, where a
/// fixed place is not chosen, and for witnesses that are not inside. SL_UNSUPPORTED as
/// sl_place_area_proof_write, and for a range that is too small for its coordinates. Reports stage
/// "place".
SL_API sl_status sl_place_area_proof_check(sl_context *context, sl_query *query,
                                           const sl_place_area *area,
                                           const sl_area_placement *claim,
                                           sl_place_area_verdict *out);
/// Checks a placement, and adds places that see what the chosen ones leave, *added of them, as
/// slivers between borders that lie on one line but for rounding. At most 16; `out` is what holds
/// in the end. Errors as sl_place_area_proof_check; then `placement` keeps what was added.
SL_API sl_status sl_place_area_proof_complete(sl_context *context, sl_query *query,
                                              const sl_place_area *area,
                                              sl_area_placement *placement, uint32_t *added,
                                              sl_place_area_verdict *out);

#ifdef __cplusplus
}
#endif

#endif

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
#ifndef SIGHTLINE_PLACE_PROOF_H
#define SIGHTLINE_PLACE_PROOF_H

#include "sightline/place.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Writes a placement anywhere (sl_place without `places`) of the query's space. The file is JSON,
/// and is put in its place only when it is complete. Members come in this order: what it is of
/// (`sightline_proof`, `walls`, `walls_sum`), the bounds (`lower`, `upper`), points (`viewpoints`,
/// `witnesses`), `columns` of numbers of witnesses, the parts of an sl_cover_proof (`denominator`,
/// `steps`, `part_count`, `parts`, `nodes`, `duals`; null for none), and `program`: the integer
/// program of the columns in CPLEX' LP format, which the reader passes over.
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

#ifdef __cplusplus
}
#endif

#endif

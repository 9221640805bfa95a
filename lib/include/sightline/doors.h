/// Doors: under which of them being shut a pair of cells stays seen.
#ifndef SIGHTLINE_DOORS_H
#define SIGHTLINE_DOORS_H

#include "sightline/context.h"

#ifdef __cplusplus
extern "C" {
#endif

/// For each pair that depends on doors its alternatives: the smallest sets of doors that some
/// sightline passes. The pair is seen exactly if of one of them no door is shut. Pairs that some
/// sightline joins without a door are not there, nor those that needed more alternatives than the
/// limit: they count as seen whatever is shut (counted by sl_see_account.door_fallbacks).
/// Alternatives of fewer doors come first, of as many those with lower doors.
///
/// A row is bytes[offsets[cell] .. offsets[cell + 1]): numbers in LEB128, for each pair in turn the
/// cells passed over since the last one, how many alternatives, and for each of them how many
/// doors, then the doors passed over since the last one. Zeroed: no rows.
typedef struct sl_door_sets {
    uint32_t cell_count;
    uint64_t *offsets; ///< cell_count + 1
    uint8_t *bytes;
} sl_door_sets;

SL_API void sl_door_sets_destroy(sl_context *context, sl_door_sets *sets); ///< and zeroes it

/// Bytes of all rows.
SL_API uint64_t sl_door_sets_bytes(const sl_door_sets *sets);

/// Whether a pair that is seen with all doors open is seen while some are shut: `shut` by door of
/// the map. Time: the length of the row.
SL_API bool sl_door_sets_open(const sl_door_sets *sets, uint32_t from, uint32_t to,
                              const bool *shut);

/// One of a pair's alternatives, `which` counted from 0: sets those of `doors` (by door of the map)
/// that it is made of, and leaves the others; NULL to ask only. False where there is none of that
/// number. Time: the length of the row.
SL_API bool sl_door_sets_alternative(const sl_door_sets *sets, uint32_t from, uint32_t to,
                                     uint32_t which, bool *doors);

/// A walk over a row's pairs: for (sl_door_pairs p = sl_door_pairs_begin(sets, cell);
/// sl_door_pairs_next(&p, shut);) p.cell, p.open.
typedef struct sl_door_pairs {
    uint32_t cell, alternatives;
    bool open;                  ///< seen, with what is shut
    const uint8_t *next, *stop; ///< the walk's own
} sl_door_pairs;

/// Starts a walk over the pairs of a cell's row.
SL_API sl_door_pairs sl_door_pairs_begin(const sl_door_sets *sets, uint32_t cell);
/// Goes on to the next pair; false behind the last.
SL_API bool sl_door_pairs_next(sl_door_pairs *pairs, const bool *shut);

/// Checks rows from an untrusted file: in range, in order, ending where they should. SL_BAD_INPUT.
SL_API sl_status sl_door_sets_check(sl_context *context, const sl_door_sets *sets,
                                    size_t door_count);

#ifdef __cplusplus
}
#endif

#endif

/// Potentially visible sets: for each cell the cells seen from it, kept compressed.
#ifndef SIGHTLINE_PVS_H
#define SIGHTLINE_PVS_H

#include "sightline/context.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A row is bytes[offsets[cell] .. offsets[cell + 1]): numbers in LEB128 (seven bits a byte, low
/// first, the high bit set on all but the last), in turn how many cells are not in the set, how
/// many are, and so on from cell 0; the last run is one of cells in the set. Zeroed: no rows.
typedef struct sl_pvs {
    uint32_t cell_count;
    uint64_t *offsets; ///< cell_count + 1
    uint8_t *bytes;
} sl_pvs;

SL_API void sl_pvs_destroy(sl_context *context, sl_pvs *pvs); ///< and zeroes it

/// A run of cells of a row, first .. end - 1.
typedef struct sl_pvs_run {
    uint32_t first, end;
    const uint8_t *next, *stop; ///< the iteration's own
} sl_pvs_run;

/// Iterates a row: for (sl_pvs_run r = sl_pvs_begin(pvs, cell); sl_pvs_next(&r);) first .. end - 1.
SL_API sl_pvs_run sl_pvs_begin(const sl_pvs *pvs, uint32_t cell);
/// Goes on to the next run; false behind the last.
SL_API bool sl_pvs_next(sl_pvs_run *run);

/// Whether cell `to` is in the row of cell `from`. Time: the length of the row.
SL_API bool sl_pvs_sees(const sl_pvs *pvs, uint32_t from, uint32_t to);
/// How many cells are in a row.
SL_API uint32_t sl_pvs_count(const sl_pvs *pvs, uint32_t cell);
SL_API uint64_t sl_pvs_pairs(const sl_pvs *pvs); ///< of all rows

/// Checks rows from an untrusted file: in range, in order, ending where they should. SL_BAD_INPUT.
SL_API sl_status sl_pvs_check(sl_context *context, const sl_pvs *pvs);

#ifdef __cplusplus
}
#endif

#endif

/// Who sees whom, a row of bits a cell: what methods gather before it is kept compressed.
#ifndef SL_BIT_ROWS_H
#define SL_BIT_ROWS_H

#include "base/base.h"
#include "base/bits.h"
#include "sightline/cell_to_cell.h"

typedef struct sl_bit_rows {
    uint32_t count; ///< of cells
    size_t words;   ///< of a row
    sl_bits *bits;
} sl_bit_rows;

sl_status sl_bit_rows_create(sl_context *context, uint32_t count, sl_bit_rows *rows);
void sl_bit_rows_destroy(sl_context *context, sl_bit_rows *rows);

static inline sl_bits *sl_bit_row(const sl_bit_rows *rows, uint32_t cell) {
    return rows->bits + cell * rows->words;
}

/// Adds what another one holds.
void sl_bit_rows_join(sl_bit_rows *rows, const sl_bit_rows *other);

/// Makes pairs symmetric: where (a, b) alone is there, (b, a) is added, or (a, b) taken away.
typedef enum sl_mirroring { SL_ADD_MIRRORED, SL_KEEP_MUTUAL } sl_mirroring;
void sl_bit_rows_mirror(sl_bit_rows *rows, sl_mirroring how);

/// Makes of them a PVS, and counts its pairs.
sl_status sl_bit_rows_encode(sl_context *context, const sl_bit_rows *rows, sl_visibility *out);

#endif

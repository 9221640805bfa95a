/// Who sees whom, a row of bits a cell: what methods gather before it is kept compressed. Small
/// sets of rows hold every bit; large ones only the words that have any.
#ifndef SL_BIT_ROWS_H
#define SL_BIT_ROWS_H

#include "cell_to_cell/sparse_row.h"
#include "sightline/cell_to_cell.h"

/// Of rows that all threads add to.
typedef struct sl_shared_rows sl_shared_rows;

/// Dense or sparse: one of `bits` and `sparse` is there.
typedef struct sl_bit_rows {
    uint32_t count; ///< of cells
    size_t words;   ///< of a row
    sl_bits *bits;
    sl_sparse_row *sparse;
    sl_shared_rows *shared; ///< of sparse rows
} sl_bit_rows;

/// Empty rows, kept as options->rows says, sparse ones in options->row_bytes at most.
sl_status sl_bit_rows_create(sl_context *context, uint32_t count, const sl_see_options *options,
                             sl_bit_rows *rows);
void sl_bit_rows_destroy(sl_context *context, sl_bit_rows *rows);

/// What one thread may add to while others do: empty rows of its own where they are dense, the same
/// ones where they are sparse. Every fork is to be joined before `rows` are destroyed.
sl_status sl_bit_rows_fork(sl_context *context, const sl_bit_rows *rows, sl_bit_rows *fork);
/// Adds what a fork holds, and zeroes it. One join at a time.
void sl_bit_rows_join(sl_context *context, sl_bit_rows *rows, sl_bit_rows *fork);

static inline sl_bits *sl_bit_rows_dense(const sl_bit_rows *rows, uint32_t cell) {
    return rows->bits + cell * rows->words;
}

/// Adds to a row; SL_NO_MEMORY where rows take more than they may.
sl_status sl_bit_rows_add_sparse(sl_context *context, sl_bit_rows *rows, uint32_t cell,
                                 const sl_word_set *set);
sl_status sl_bit_rows_add_word(sl_context *context, sl_bit_rows *rows, uint32_t cell, size_t word,
                               sl_bits bits); ///< members of one word, not none

static inline sl_status sl_bit_rows_add_one(sl_context *context, sl_bit_rows *rows, uint32_t cell,
                                            uint32_t member) {
    return sl_bit_rows_add_word(context, rows, cell, member / 64, (sl_bits)1 << (member % 64));
}

static inline sl_status sl_bit_rows_add(sl_context *context, sl_bit_rows *rows, uint32_t cell,
                                        const sl_word_set *set) {
    if (!rows->bits) return sl_bit_rows_add_sparse(context, rows, cell, set);
    sl_bits *restrict row = sl_bit_rows_dense(rows, cell);
    const sl_bits *restrict from = set->bits;
    for (size_t i = set->low; i < set->high; i++) row[i] |= from[i];
    return SL_OK;
}

/// Makes pairs symmetric: where (a, b) alone is there, (b, a) is added, or (a, b) taken away.
typedef enum sl_mirroring { SL_ADD_MIRRORED, SL_KEEP_MUTUAL } sl_mirroring;
sl_status sl_bit_rows_mirror(sl_context *context, sl_bit_rows *rows, sl_mirroring how);

/// Makes of them a PVS, and counts its pairs. Sparse rows are emptied.
sl_status sl_bit_rows_encode(sl_context *context, sl_bit_rows *rows, sl_visibility *out);

#endif

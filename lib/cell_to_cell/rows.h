/// Who sees whom: a row of bits for each cell, as methods gather it before it is compressed.
///
/// A word set is one row in the making; it knows which of its words have any bits. Small tables
/// hold every bit of every row (dense). Large ones hold only the words that have any (sparse).
#ifndef SL_ROWS_H
#define SL_ROWS_H

#include "sightline/cell_to_cell.h"
#include "sightline/support.h"

#include <stdatomic.h>

// --- sets of cells

/// To be made with sli_word_set_create and freed with sli_word_set_destroy.
typedef struct sli_word_set {
    sl_bits *bits;
    sl_bits *used;    ///< a bit a word: whether it has any
    size_t low, high; ///< words low .. high - 1 may have any, no others
} sli_word_set;

/// Empty, of cells below `count`. Zeroed on failure.
sl_status sli_word_set_create(sl_context *context, size_t count, sli_word_set *set);
void sli_word_set_destroy(sl_context *context, sli_word_set *set);

/// Adds the members of one word, not none.
static inline void sli_word_set_join(sli_word_set *set, size_t word, sl_bits bits) {
    set->bits[word] |= bits;
    sl_bits_add(set->used, word);
    if (word < set->low) set->low = word;
    if (word >= set->high) set->high = word + 1;
}

static inline void sli_word_set_add(sli_word_set *set, uint32_t cell) {
    sli_word_set_join(set, cell / 64, (sl_bits)1 << (cell % 64));
}

static inline void sli_word_set_drop(sli_word_set *set, uint32_t cell) {
    const size_t word = cell / 64;
    set->bits[word] &= ~((sl_bits)1 << (cell % 64));
    if (!set->bits[word]) set->used[word / 64] &= ~((sl_bits)1 << (word % 64));
}

/// Takes all out. Time: of the words that have any, and 1/64 of those between.
void sli_word_set_clear(sli_word_set *set);

/// The first word from `from` on that has any, set->high or more for none.
static inline size_t sli_word_set_next(const sli_word_set *set, size_t from) {
    if (from >= set->high) return set->high;
    size_t at = from / 64;
    const size_t end = sl_bits_words(set->high);
    sl_bits some = set->used[at] >> (from % 64) << (from % 64);
    while (!some && ++at < end) some = set->used[at];
    return some ? at * 64 + (size_t)__builtin_ctzll(some) : set->high;
}

/// The last word before `end` that has any, SIZE_MAX for none.
static inline size_t sli_word_set_before(const sli_word_set *set, size_t end) {
    if (end <= set->low) return SIZE_MAX;
    size_t at = (end - 1) / 64;
    const size_t first = set->low / 64, above = 63 - (end - 1) % 64;
    sl_bits some = set->used[at] << above >> above;
    while (!some && at-- > first) some = set->used[at];
    return some ? at * 64 + 63 - (size_t)__builtin_clzll(some) : SIZE_MAX;
}

// --- rows with few members

/// What rows may take, and take; several threads may count at once.
typedef struct sli_row_budget {
    uint64_t most; ///< bytes
    atomic_uint_least64_t used;
} sli_row_budget;

#define SLI_ALL_WORDS UINT32_MAX
enum { SLI_SPARSE_WORD_BYTES = sizeof(sl_bits) + sizeof(uint32_t) };

/// Words by ascending index, the indices behind them in the same block; where they are many, all
/// words of the row, and no indices. Zeroed, it is empty.
typedef struct sli_sparse_row {
    sl_bits *words;
    uint32_t room;  ///< of words, and of indices
    uint32_t count; ///< of words; SLI_ALL_WORDS where there are no indices
} sli_sparse_row;

static inline uint32_t *sli_sparse_index(const sli_sparse_row *row) {
    return row->words ? (uint32_t *)(void *)(row->words + row->room) : NULL;
}

/// Of a row of `words` words at most. On failure the row is left as it was, but for members that
/// were added: SL_NO_MEMORY where the budget is used up too.
sl_status sli_sparse_row_add(sl_context *context, sli_sparse_row *row, size_t words,
                             const sli_word_set *set, sli_row_budget *budget);

/// Adds the row's members to a set.
void sli_sparse_row_add_to(const sli_sparse_row *row, size_t words, sli_word_set *set);

void sli_sparse_row_destroy(sl_context *context, sli_sparse_row *row); ///< and zeroes it

// --- all rows

/// Of rows that all threads add to.
typedef struct sli_shared_rows sli_shared_rows;

/// Dense or sparse: one of `bits` and `sparse` is there.
typedef struct sli_bit_rows {
    uint32_t count; ///< of cells
    size_t words;   ///< of a row
    sl_bits *bits;
    sli_sparse_row *sparse;
    sli_shared_rows *shared; ///< of sparse rows
} sli_bit_rows;

/// Empty rows, kept as options->rows says, sparse ones in options->row_bytes at most.
sl_status sli_bit_rows_create(sl_context *context, uint32_t count, const sl_see_options *options,
                              sli_bit_rows *rows);
void sli_bit_rows_destroy(sl_context *context, sli_bit_rows *rows);

/// What one thread may add to while others do: empty rows of its own where they are dense, the same
/// ones where they are sparse. Every fork is to be joined before `rows` are destroyed.
sl_status sli_bit_rows_fork(sl_context *context, const sli_bit_rows *rows, sli_bit_rows *fork);
/// Adds what a fork holds, and zeroes it. One join at a time.
void sli_bit_rows_join(sl_context *context, sli_bit_rows *rows, sli_bit_rows *fork);

static inline sl_bits *sli_bit_rows_dense(const sli_bit_rows *rows, uint32_t cell) {
    return rows->bits + cell * rows->words;
}

/// Adds to a row; SL_NO_MEMORY where rows take more than they may.
sl_status sli_bit_rows_add_sparse(sl_context *context, sli_bit_rows *rows, uint32_t cell,
                                  const sli_word_set *set);
sl_status sli_bit_rows_add_word(sl_context *context, sli_bit_rows *rows, uint32_t cell, size_t word,
                                sl_bits bits); ///< members of one word, not none

static inline sl_status sli_bit_rows_add_one(sl_context *context, sli_bit_rows *rows, uint32_t cell,
                                             uint32_t member) {
    return sli_bit_rows_add_word(context, rows, cell, member / 64, (sl_bits)1 << (member % 64));
}

static inline sl_status sli_bit_rows_add(sl_context *context, sli_bit_rows *rows, uint32_t cell,
                                         const sli_word_set *set) {
    if (!rows->bits) return sli_bit_rows_add_sparse(context, rows, cell, set);
    sl_bits *restrict row = sli_bit_rows_dense(rows, cell);
    const sl_bits *restrict from = set->bits;
    for (size_t i = set->low; i < set->high; i++) row[i] |= from[i];
    return SL_OK;
}

/// Makes pairs symmetric: where (a, b) alone is there, (b, a) is added, or (a, b) taken away.
typedef enum sli_mirroring { SLI_ADD_MIRRORED, SLI_KEEP_MUTUAL } sli_mirroring;
sl_status sli_bit_rows_mirror(sl_context *context, sli_bit_rows *rows, sli_mirroring how);

/// Makes of them a PVS, and counts its pairs. Sparse rows are emptied.
sl_status sli_bit_rows_encode(sl_context *context, sli_bit_rows *rows, sl_visibility *out);

#endif

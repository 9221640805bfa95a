/// A row of bits of which most words are empty.
#ifndef SL_SPARSE_ROW_H
#define SL_SPARSE_ROW_H

#include "cell_to_cell/word_set.h"

#include <stdatomic.h>

/// What rows may take, and take; several threads may count at once.
typedef struct sl_row_budget {
    uint64_t most; ///< bytes
    atomic_uint_least64_t used;
} sl_row_budget;

#define SL_ALL_WORDS UINT32_MAX
enum { SL_SPARSE_WORD_BYTES = sizeof(sl_bits) + sizeof(uint32_t) };

/// Words by ascending index, the indices behind them in the same block; where they are many, all
/// words of the row, and no indices. Zeroed, it is empty.
typedef struct sl_sparse_row {
    sl_bits *words;
    uint32_t room;  ///< of words, and of indices
    uint32_t count; ///< of words; SL_ALL_WORDS where there are no indices
} sl_sparse_row;

static inline uint32_t *sl_sparse_index(const sl_sparse_row *row) {
    return row->words ? (uint32_t *)(void *)(row->words + row->room) : NULL;
}

/// Of a row of `words` words at most. On failure the row is left as it was, but for members that
/// were added: SL_NO_MEMORY where the budget is used up too.
sl_status sl_sparse_row_add(sl_context *context, sl_sparse_row *row, size_t words,
                            const sl_word_set *set, sl_row_budget *budget);
/// Adds the members of one word, not none.
sl_status sl_sparse_row_add_word(sl_context *context, sl_sparse_row *row, size_t words, size_t word,
                                 sl_bits bits, sl_row_budget *budget);

/// The place of a word, or NULL where the row has none. `cursor` starts at 0 and makes ascending
/// searches short; words may be added to the row meanwhile.
sl_bits *sl_sparse_row_find(const sl_sparse_row *row, size_t word, uint32_t *cursor);

/// Adds the row's members to a set.
void sl_sparse_row_add_to(const sl_sparse_row *row, size_t words, sl_word_set *set);

void sl_sparse_row_destroy(sl_context *context, sl_sparse_row *row); ///< and zeroes it

#endif

#include "cell_to_cell/bit_rows.h"

#include "base/threads.h"
#include "cell_to_cell/pvs_rows.h"

#include <pthread.h>

/// Up to here, rows that hold every bit are as fast or faster: they fit a processor's caches.
#define MOST_DENSE_BYTES (UINT64_C(16) << 20)

/// Neighbours are asked for at once, so that they have locks of their own.
enum { LOCKS = 256 };

struct sl_shared_rows {
    sl_row_budget budget;
    pthread_mutex_t locks[LOCKS];
};

/// Of dense rows each thread has its own.
static bool choose_sparse(uint64_t count, size_t words, const sl_see_options *options) {
    if (options->rows != SL_ROWS_BY_SIZE) return options->rows == SL_ROWS_SPARSE;
    const uint64_t bytes = count * words * sizeof(sl_bits);
    const uint64_t forks = options->threads ? options->threads : sl_core_count();
    return bytes > MOST_DENSE_BYTES || bytes * (forks + 1) > options->row_bytes;
}

static sl_status create_sparse(sl_context *context, sl_bit_rows *rows, uint64_t most) {
    const uint64_t heads = rows->count * sizeof *rows->sparse;
    rows->sparse = sl_alloc_array(context, rows->count, sizeof *rows->sparse);
    rows->shared = sl_alloc(context, sizeof *rows->shared);
    if (!rows->sparse || !rows->shared) {
        sl_free(context, rows->sparse);
        sl_free(context, rows->shared);
        return SL_NO_MEMORY;
    }
    rows->shared->budget.most = most;
    atomic_init(&rows->shared->budget.used, heads);
    for (size_t i = 0; i < LOCKS; i++) pthread_mutex_init(&rows->shared->locks[i], NULL);
    return SL_OK;
}

static sl_status create_dense(sl_context *context, sl_bit_rows *rows) {
    if (rows->words && rows->count > SIZE_MAX / rows->words) return sl_fail_memory(context);
    rows->bits = sl_alloc_array(context, rows->count * rows->words, sizeof *rows->bits);
    return rows->bits ? SL_OK : SL_NO_MEMORY;
}

sl_status sl_bit_rows_create(sl_context *context, uint32_t count, const sl_see_options *options,
                             sl_bit_rows *rows) {
    sl_bit_rows made = {.count = count, .words = sl_bits_words(count)};
    if (choose_sparse(count, made.words, options))
        SL_TRY(create_sparse(context, &made, options->row_bytes));
    else
        SL_TRY(create_dense(context, &made));
    *rows = made;
    return SL_OK;
}

void sl_bit_rows_destroy(sl_context *context, sl_bit_rows *rows) {
    sl_free(context, rows->bits);
    for (uint32_t cell = 0; rows->sparse && cell < rows->count; cell++)
        sl_sparse_row_destroy(context, &rows->sparse[cell]);
    sl_free(context, rows->sparse);
    for (size_t i = 0; rows->shared && i < LOCKS; i++)
        pthread_mutex_destroy(&rows->shared->locks[i]);
    sl_free(context, rows->shared);
    *rows = (sl_bit_rows){0};
}

sl_status sl_bit_rows_fork(sl_context *context, const sl_bit_rows *rows, sl_bit_rows *fork) {
    sl_bit_rows made = *rows;
    if (rows->bits) SL_TRY(create_dense(context, &made));
    *fork = made;
    return SL_OK;
}

void sl_bit_rows_join(sl_context *context, sl_bit_rows *rows, sl_bit_rows *fork) {
    for (size_t i = 0; fork->bits && i < rows->count * rows->words; i++)
        rows->bits[i] |= fork->bits[i];
    sl_free(context, fork->bits);
    *fork = (sl_bit_rows){0};
}

sl_status sl_bit_rows_add_sparse(sl_context *context, sl_bit_rows *rows, uint32_t cell,
                                 const sl_word_set *set) {
    pthread_mutex_t *lock = &rows->shared->locks[cell % LOCKS];
    pthread_mutex_lock(lock);
    const sl_status status =
        sl_sparse_row_add(context, &rows->sparse[cell], rows->words, set, &rows->shared->budget);
    pthread_mutex_unlock(lock);
    return status;
}

sl_status sl_bit_rows_add_word(sl_context *context, sl_bit_rows *rows, uint32_t cell, size_t word,
                               sl_bits bits) {
    if (rows->bits) {
        sl_bit_rows_dense(rows, cell)[word] |= bits;
        return SL_OK;
    }
    pthread_mutex_t *lock = &rows->shared->locks[cell % LOCKS];
    pthread_mutex_lock(lock);
    const sl_status status = sl_sparse_row_add_word(context, &rows->sparse[cell], rows->words, word,
                                                    bits, &rows->shared->budget);
    pthread_mutex_unlock(lock);
    return status;
}

// --- encoding

static uint64_t count_bits(const sl_bits *bits, size_t words) {
    uint64_t count = 0;
    for (size_t i = 0; i < words; i++) count += (uint64_t)__builtin_popcountll(bits[i]);
    return count;
}

static sl_status append_row(sl_context *context, sl_bit_rows *rows, uint32_t cell,
                            sl_row_bytes *bytes, uint64_t *pairs) {
    if (rows->bits) {
        *pairs += count_bits(sl_bit_rows_dense(rows, cell), rows->words);
        return sl_row_append(context, bytes, sl_bit_rows_dense(rows, cell), rows->count);
    }
    sl_sparse_row *row = &rows->sparse[cell];
    const bool all = row->count == SL_ALL_WORDS;
    const size_t count = all ? rows->words : row->count;
    *pairs += count_bits(row->words, count);
    SL_TRY(
        sl_row_append_words(context, bytes, row->words, all ? NULL : sl_sparse_index(row), count));
    sl_sparse_row_destroy(context, row);
    return SL_OK;
}

static sl_status encode(sl_context *context, sl_bit_rows *rows, sl_row_bytes *bytes, sl_pvs *out,
                        uint64_t *pairs) {
    out->cell_count = rows->count;
    out->offsets = sl_alloc_array(context, (size_t)rows->count + 1, sizeof *out->offsets);
    if (!out->offsets) return SL_NO_MEMORY;
    for (uint32_t cell = 0; cell < rows->count; cell++) {
        SL_TRY(append_row(context, rows, cell, bytes, pairs));
        out->offsets[cell + 1] = bytes->count;
    }
    // Never NULL, also where no cell sees any.
    SL_TRY(SL_ARRAY_ROOM(context, bytes, 1));
    out->bytes = bytes->items;
    bytes->items = NULL;
    return SL_OK;
}

sl_status sl_bit_rows_encode(sl_context *context, sl_bit_rows *rows, sl_visibility *out) {
    sl_row_bytes bytes = {0};
    sl_pvs pvs = {0};
    uint64_t pairs = 0;
    const sl_status status = encode(context, rows, &bytes, &pvs, &pairs);
    sl_free(context, bytes.items);
    if (status != SL_OK) {
        sl_pvs_destroy(context, &pvs);
        return status;
    }
    out->pvs = pvs;
    out->account.pairs = pairs;
    return SL_OK;
}

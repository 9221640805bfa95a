/// Rows made symmetric, in blocks of 64 rows by one word.
#include "cell_to_cell/bit_rows.h"

/// Mirrors 64 rows of 64 bits about their diagonal, by swapping ever smaller blocks (Warren 2003,
/// Hacker's Delight, section 7-3).
static void transpose(sl_bits block[64]) {
    sl_bits mask = 0x00000000ffffffff;
    for (unsigned size = 32; size; size >>= 1, mask ^= mask << size)
        for (unsigned i = 0; i < 64; i = ((i | size) + 1) & ~size) {
            const sl_bits swap = (block[i] >> size ^ block[i | size]) & mask;
            block[i] ^= swap << size;
            block[i | size] ^= swap;
        }
}

// --- dense rows

/// Copies 64 rows of one word each; rows past the last are empty. Returns whether any bit is set.
static bool take_block(const sl_bit_rows *rows, size_t first_row, size_t word, sl_bits block[64]) {
    sl_bits any = 0;
    for (size_t i = 0; i < 64; i++) {
        const size_t row = first_row + i;
        block[i] = row < rows->count ? rows->bits[row * rows->words + word] : 0;
        any |= block[i];
    }
    return any != 0;
}

static void merge_block(sl_bit_rows *rows, size_t first_row, size_t word, const sl_bits block[64],
                        sl_mirroring how) {
    for (size_t i = 0; i < 64 && first_row + i < rows->count; i++) {
        sl_bits *bits = &rows->bits[(first_row + i) * rows->words + word];
        *bits = how == SL_ADD_MIRRORED ? *bits | block[i] : *bits & block[i];
    }
}

static void mirror_dense(sl_bit_rows *rows, sl_mirroring how) {
    sl_bits below[64], above[64];
    for (size_t i = 0; i < rows->words; i++)
        for (size_t k = 0; k <= i; k++) {
            const bool some_below = take_block(rows, 64 * i, k, below);
            const bool some_above = take_block(rows, 64 * k, i, above);
            if (!some_below && !some_above) continue;
            transpose(below);
            merge_block(rows, 64 * k, i, below, how);
            if (k == i) continue;
            transpose(above);
            merge_block(rows, 64 * i, k, above, how);
        }
}

// --- sparse rows

/// The number of rows, up to 64, from a multiple of 64 on.
static uint32_t block_rows(const sl_bit_rows *rows, size_t first) {
    return rows->count - first < 64 ? (uint32_t)(rows->count - first) : 64;
}

/// Copies one word of each of 64 rows; cursors as those of sl_sparse_row_find.
static void take_words(const sl_bit_rows *rows, size_t first, size_t word, uint32_t cursors[64],
                       sl_bits block[64]) {
    const uint32_t count = block_rows(rows, first);
    for (uint32_t i = 0; i < 64; i++) {
        const sl_bits *found =
            i < count ? sl_sparse_row_find(&rows->sparse[first + i], word, &cursors[i]) : NULL;
        block[i] = found ? *found : 0;
    }
}

static sl_status add_words(sl_context *context, sl_bit_rows *rows, size_t first, size_t word,
                           const sl_bits block[64]) {
    for (uint32_t i = 0; i < block_rows(rows, first); i++)
        if (block[i])
            SL_TRY(sl_bit_rows_add_word(context, rows, (uint32_t)(first + i), word, block[i]));
    return SL_OK;
}

static void keep_words(sl_bit_rows *rows, size_t first, size_t word, uint32_t cursors[64],
                       const sl_bits block[64]) {
    for (uint32_t i = 0; i < block_rows(rows, first); i++) {
        sl_bits *found = sl_sparse_row_find(&rows->sparse[first + i], word, &cursors[i]);
        if (found) *found &= block[i];
    }
}

/// The rows 64 * i and on against those that their words tell of: what they have goes there, or
/// what those have stays here.
static sl_status mirror_rows(sl_context *context, sl_bit_rows *rows, size_t i, sl_mirroring how,
                             sl_word_set *any) {
    uint32_t cursors[64] = {0};
    sl_bits block[64];
    for (uint32_t r = 0; r < block_rows(rows, 64 * i); r++)
        sl_sparse_row_add_to(&rows->sparse[64 * i + r], rows->words, any);
    for (size_t k = sl_word_set_next(any, any->low); k < any->high;
         k = sl_word_set_next(any, k + 1)) {
        if (how == SL_ADD_MIRRORED) {
            take_words(rows, 64 * i, k, cursors, block);
            transpose(block);
            SL_TRY(add_words(context, rows, 64 * k, i, block));
        } else {
            uint32_t there[64] = {0};
            take_words(rows, 64 * k, i, there, block);
            transpose(block);
            keep_words(rows, 64 * i, k, cursors, block);
        }
    }
    sl_word_set_clear(any);
    return SL_OK;
}

static sl_status mirror_sparse(sl_context *context, sl_bit_rows *rows, sl_mirroring how) {
    sl_word_set any;
    SL_TRY(sl_word_set_create(context, rows->count, &any));
    sl_status status = SL_OK;
    for (size_t i = 0; i < rows->words && status == SL_OK; i++) {
        status = mirror_rows(context, rows, i, how, &any);
        if (status == SL_OK && i % 64 == 0) status = sl_check_cancelled(context);
    }
    sl_word_set_destroy(context, &any);
    return status;
}

sl_status sl_bit_rows_mirror(sl_context *context, sl_bit_rows *rows, sl_mirroring how) {
    if (!rows->bits) return mirror_sparse(context, rows, how);
    mirror_dense(rows, how);
    return SL_OK;
}

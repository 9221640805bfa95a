#include "cell_to_cell/bit_rows.h"

#include "cell_to_cell/pvs_rows.h"

sl_status sl_bit_rows_create(sl_context *context, uint32_t count, sl_bit_rows *rows) {
    const size_t words = sl_bits_words(count);
    if (words && count > SIZE_MAX / words) return sl_fail_memory(context);
    sl_bits *bits = sl_alloc_array(context, count * words, sizeof *bits);
    if (!bits) return SL_NO_MEMORY;
    *rows = (sl_bit_rows){.count = count, .words = words, .bits = bits};
    return SL_OK;
}

void sl_bit_rows_destroy(sl_context *context, sl_bit_rows *rows) {
    sl_free(context, rows->bits);
    *rows = (sl_bit_rows){0};
}

void sl_bit_rows_join(sl_bit_rows *rows, const sl_bit_rows *other) {
    for (size_t i = 0; i < rows->count * rows->words; i++) rows->bits[i] |= other->bits[i];
}

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

void sl_bit_rows_mirror(sl_bit_rows *rows, sl_mirroring how) {
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

static uint64_t count_bits(const sl_bits *bits, size_t words) {
    uint64_t count = 0;
    for (size_t i = 0; i < words; i++) count += (uint64_t)__builtin_popcountll(bits[i]);
    return count;
}

static sl_status encode(sl_context *context, const sl_bit_rows *rows, sl_row_bytes *bytes,
                        sl_pvs *out) {
    out->cell_count = rows->count;
    out->offsets = sl_alloc_array(context, (size_t)rows->count + 1, sizeof *out->offsets);
    if (!out->offsets) return SL_NO_MEMORY;
    for (uint32_t cell = 0; cell < rows->count; cell++) {
        SL_TRY(sl_row_append(context, bytes, sl_bit_row(rows, cell), rows->count));
        out->offsets[cell + 1] = bytes->count;
    }
    // Never NULL, also where no cell sees any.
    SL_TRY(SL_ARRAY_ROOM(context, bytes, 1));
    out->bytes = bytes->items;
    bytes->items = NULL;
    return SL_OK;
}

sl_status sl_bit_rows_encode(sl_context *context, const sl_bit_rows *rows, sl_visibility *out) {
    sl_row_bytes bytes = {0};
    sl_pvs pvs = {0};
    const sl_status status = encode(context, rows, &bytes, &pvs);
    sl_free(context, bytes.items);
    if (status != SL_OK) {
        sl_pvs_destroy(context, &pvs);
        return status;
    }
    out->pvs = pvs;
    out->account.pairs = count_bits(rows->bits, rows->count * rows->words);
    return SL_OK;
}

/// From what a search found in each direction to one result.
#include "cell_to_cell/pvs_rows.h"

#include <string.h>

/// The rows that go in, each with its transposed.
typedef struct partial {
    const sl_pvs *sure, *doubtful;
    sl_pvs sure_back, doubtful_back;
} partial;

typedef struct result_rows {
    sl_row_bytes *seen, *doubtful;
    sl_bits *set, *open; ///< scratch
} result_rows;

static uint64_t count_bits(const sl_bits *set, size_t words) {
    uint64_t count = 0;
    for (size_t i = 0; i < words; i++) count += (uint64_t)__builtin_popcountll(set[i]);
    return count;
}

static sl_status settle_row(sl_context *context, const partial *in, result_rows *rows,
                            uint32_t cell, sl_visibility *out) {
    const uint32_t count = in->sure->cell_count;
    const size_t words = sl_bits_words(count);
    memset(rows->set, 0, words * sizeof *rows->set);
    memset(rows->open, 0, words * sizeof *rows->open);
    sl_row_add_to(in->sure, cell, rows->set);
    if (in->sure_back.cell_count) sl_row_add_to(&in->sure_back, cell, rows->set);
    sl_row_add_to(in->doubtful, cell, rows->open);
    if (in->doubtful_back.cell_count) sl_row_add_to(&in->doubtful_back, cell, rows->open);
    for (size_t i = 0; i < words; i++) rows->open[i] &= ~rows->set[i];
    SL_TRY(sl_row_append(context, &rows->doubtful[cell], rows->open, count));
    out->account.doubtful_pairs += count_bits(rows->open, words);
    if (out->sight == SL_CLOSED)
        for (size_t i = 0; i < words; i++) rows->set[i] |= rows->open[i];
    out->account.pairs += count_bits(rows->set, words);
    return sl_row_append(context, &rows->seen[cell], rows->set, count);
}

static sl_status settle_rows(sl_context *context, const partial *in, result_rows *rows,
                             sl_visibility *out) {
    const uint32_t count = in->sure->cell_count;
    rows->seen = sl_alloc_array(context, count, sizeof *rows->seen);
    rows->doubtful = sl_alloc_array(context, count, sizeof *rows->doubtful);
    rows->set = sl_alloc_array(context, sl_bits_words(count), sizeof *rows->set);
    rows->open = sl_alloc_array(context, sl_bits_words(count), sizeof *rows->open);
    if (!rows->seen || !rows->doubtful || !rows->set || !rows->open) return SL_NO_MEMORY;
    for (uint32_t cell = 0; cell < count; cell++) SL_TRY(settle_row(context, in, rows, cell, out));
    SL_TRY(sl_pvs_join(context, rows->seen, count, &out->pvs));
    return sl_pvs_join(context, rows->doubtful, count, &out->doubtful);
}

sl_status sl_visibility_finish(sl_context *context, const sl_pvs *sure, const sl_pvs *doubtful,
                               bool mutual, sl_visibility *out) {
    partial in = {.sure = sure, .doubtful = doubtful};
    result_rows rows = {0};
    sl_status status = SL_OK;
    if (mutual) status = sl_pvs_transpose(context, sure, &in.sure_back);
    if (mutual && status == SL_OK) status = sl_pvs_transpose(context, doubtful, &in.doubtful_back);
    if (status == SL_OK) status = settle_rows(context, &in, &rows, out);
    sl_pvs_destroy(context, &in.sure_back);
    sl_pvs_destroy(context, &in.doubtful_back);
    for (uint32_t i = 0; i < sure->cell_count; i++) {
        if (rows.seen) sl_free(context, rows.seen[i].items);
        if (rows.doubtful) sl_free(context, rows.doubtful[i].items);
    }
    sl_free(context, rows.seen);
    sl_free(context, rows.doubtful);
    sl_free(context, rows.set);
    sl_free(context, rows.open);
    return status;
}

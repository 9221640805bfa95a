/// No culling: the visible set of the eye's cell, as it was baked.
#include "cell_to_cell/pvs_rows.h"
#include "eye_to_cell/eye_methods.h"
#include "eye_to_cell/eye_search.h"

#include <string.h>

sl_status sl_eye_cell_to_cell(sl_context *context, sl_eye_search *search, const sl_view *view,
                              uint64_t *cells, sl_eye_account *account) {
    sl_eye_query query;
    SL_TRY(sl_eye_begin(context, search, view, true, cells, &query));
    const size_t words = sl_eye_words(search->space);
    if (query.cell != SL_NO_CELL) {
        memcpy(cells, search->row, words * sizeof *cells);
        for (size_t i = 0; i < words; i++) query.nodes += (uint64_t)__builtin_popcountll(cells[i]);
    }
    sl_eye_end(&query, account);
    return SL_OK;
}

sl_status sl_eye_cell_to_cell_mirrored(sl_context *context, sl_eye_search *search,
                                       const sl_view *view, uint64_t *cells,
                                       sl_eye_account *account) {
    sl_eye_query query;
    SL_TRY(sl_eye_begin(context, search, view, true, cells, &query));
    const sl_pvs *mirrored = &search->visibility->mirrored;
    if (query.cell != SL_NO_CELL && mirrored->cell_count) {
        sl_row_add_to(mirrored, query.cell, cells);
        for (size_t i = 0; i < sl_eye_words(search->space); i++)
            query.nodes += (uint64_t)__builtin_popcountll(cells[i]);
    }
    sl_eye_end(&query, account);
    return SL_OK;
}

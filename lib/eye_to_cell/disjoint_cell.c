/// Disjoint cell: of the visible set, the cells that are not disjoint from the cone, one by one.
#include "eye_to_cell/eye_methods.h"
#include "eye_to_cell/eye_search.h"

sl_status sl_eye_disjoint_cell(sl_context *context, sl_eye_search *search, const sl_view *view,
                               uint64_t *cells, sl_eye_account *account) {
    sl_eye_query query;
    SL_TRY(sl_eye_begin(context, search, view, true, cells, &query));
    const size_t words = query.cell == SL_NO_CELL ? 0 : sl_eye_words(search->space);
    for (size_t word = 0; word < words; word++) {
        for (sl_bits rest = search->row[word]; rest; rest &= rest - 1) {
            const uint32_t cell = (uint32_t)(64 * word) + (uint32_t)__builtin_ctzll(rest);
            if (++query.nodes % 4096 == 0) SL_TRY(sl_check_cancelled(context));
            if (sl_eye_meets_cell(&query, cell)) sl_bits_add(cells, cell);
        }
    }
    sl_eye_end(&query, account);
    return SL_OK;
}

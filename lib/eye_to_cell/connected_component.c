/// Connected component: of the visible set, the cells that can be reached from the eye's over cells
/// that all meet the cone. Each of them meets the cone, so that they are among those of the
/// disjoint-cell method.
#include "eye_to_cell/eye_methods.h"
#include "eye_to_cell/spread.h"

static bool meets_cell(sl_eye_query *query, const sl_directed_portal *directed) {
    return sl_eye_meets_cell(query, directed->cell);
}

sl_status sl_eye_connected_component(sl_context *context, sl_eye_search *search,
                                     const sl_view *view, uint64_t *cells,
                                     sl_eye_account *account) {
    sl_eye_query query;
    SL_TRY(sl_eye_begin(context, search, view, true, cells, &query));
    SL_TRY(sl_eye_spread(context, &query, meets_cell));
    sl_eye_end(&query, account);
    return SL_OK;
}

/// Incident portals: of the visible set, the cells that can be reached from the eye's through
/// portals that all meet the cone. A portal is part of the borders of both its cells, so that these
/// meet the cone as well: what is reached is among the connected component.
#include "eye_to_cell/eye_methods.h"
#include "eye_to_cell/spread.h"

sl_status sl_eye_incident_portals(sl_context *context, sl_eye_search *search, const sl_view *view,
                                  uint64_t *cells, sl_eye_account *account) {
    sl_eye_query query;
    SL_TRY(sl_eye_begin(context, search, view, true, cells, &query));
    SL_TRY(sl_eye_spread(context, &query, sl_eye_meets_portal));
    sl_eye_end(&query, account);
    return SL_OK;
}

/// The culling methods that the table lists.
#ifndef SL_EYE_METHODS_H
#define SL_EYE_METHODS_H

#include "sightline/eye_to_cell.h"

sl_status sl_eye_cell_to_cell(sl_context *context, sl_eye_search *search, const sl_view *view,
                              uint64_t *cells, sl_eye_account *account);
sl_status sl_eye_disjoint_cell(sl_context *context, sl_eye_search *search, const sl_view *view,
                               uint64_t *cells, sl_eye_account *account);
sl_status sl_eye_connected_component(sl_context *context, sl_eye_search *search,
                                     const sl_view *view, uint64_t *cells, sl_eye_account *account);
sl_status sl_eye_incident_portals(sl_context *context, sl_eye_search *search, const sl_view *view,
                                  uint64_t *cells, sl_eye_account *account);
sl_status sl_eye_exact(sl_context *context, sl_eye_search *search, const sl_view *view,
                       uint64_t *cells, sl_eye_account *account);

// What is seen by mirror, of the methods that know it.
sl_status sl_eye_cell_to_cell_mirrored(sl_context *context, sl_eye_search *search,
                                       const sl_view *view, uint64_t *cells,
                                       sl_eye_account *account);
sl_status sl_eye_exact_mirrored(sl_context *context, sl_eye_search *search, const sl_view *view,
                                uint64_t *cells, sl_eye_account *account);

#endif

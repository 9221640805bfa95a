/// Reading the rows of view cells.
#ifndef SL_VIEW_ROWS_H
#define SL_VIEW_ROWS_H

#include "sightline/pvs.h"

/// The view cell of a point: that of its cell in the space. SL_NO_VIEW_CELL for none.
uint32_t sli_view_rows_locate(const sl_view_rows *rows, const sl_space *space, sl_point point);
/// Sets bit c % 64 of word c / 64 for each cell c that a view cell sees; other bits stay.
void sli_view_rows_add_to(const sl_view_rows *rows, uint32_t view_cell, uint64_t *bits);
/// Whether a view cell sees a cell.
bool sli_view_rows_sees(const sl_view_rows *rows, uint32_t view_cell, uint32_t cell);

/// Checks rows from an untrusted file. SL_BAD_INPUT.
sl_status sli_view_rows_check(sl_context *context, const sl_view_rows *rows);

#endif

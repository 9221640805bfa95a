/// Rows of view cells in use (Mattausch et al. 2006, section 5.2): what a baked file keeps of them,
/// and what its readers need. How rows are made: study/view_cells/view_cell_rows.c.
///
/// A lookup unites the rows on the way from a view cell to the root. Cost: O(depth) rows.
#include "bake/view_rows.h"

#include "cell_to_cell/pvs_rows.h"
#include "sightline/support.h"

void sl_view_rows_destroy(sl_context *context, sl_view_rows *rows) {
    sl_free(context, rows->view_cells);
    sl_free(context, rows->parents);
    sl_pvs_destroy(context, &rows->rows);
    *rows = (sl_view_rows){0};
}

uint32_t sli_view_rows_locate(const sl_view_rows *rows, const sl_space *space, sl_point point) {
    const uint32_t cell = sl_space_locate(space, point);
    return cell == SL_NO_CELL || !rows->view_cells ? SL_NO_VIEW_CELL : rows->view_cells[cell];
}

void sli_view_rows_add_to(const sl_view_rows *rows, uint32_t view_cell, uint64_t *bits) {
    for (uint32_t node = view_cell; node != SL_NO_VIEW_CELL; node = rows->parents[node])
        sli_row_add_to(&rows->rows, node, bits);
}

bool sli_view_rows_sees(const sl_view_rows *rows, uint32_t view_cell, uint32_t cell) {
    for (uint32_t node = view_cell; node != SL_NO_VIEW_CELL; node = rows->parents[node])
        if (sl_pvs_sees(&rows->rows, node, cell)) return true;
    return false;
}

sl_status sli_view_rows_check(sl_context *context, const sl_view_rows *rows) {
    const uint32_t cells = rows->rows.cell_count;
    if (!rows->view_cell_count || rows->view_cell_count > rows->node_count ||
        rows->node_count > cells)
        return sl_fail(context, SL_BAD_INPUT, "the numbers of view cells make no sense");
    for (uint32_t i = 0; i < cells; i++)
        if (rows->view_cells[i] != SL_NO_VIEW_CELL && rows->view_cells[i] >= rows->view_cell_count)
            return sl_fail(context, SL_BAD_INPUT, "cell %u is in a view cell that is not there", i);
    for (uint32_t i = 0; i < rows->node_count; i++)
        if (rows->parents[i] != SL_NO_VIEW_CELL &&
            (rows->parents[i] <= i || rows->parents[i] < rows->view_cell_count ||
             rows->parents[i] >= rows->node_count))
            return sl_fail(context, SL_BAD_INPUT, "node %u of the view cells' rows hangs nowhere",
                           i);
    return sli_pvs_check(context, &rows->rows);
}

sl_status sl_view_rows_expand(sl_context *context, const sl_view_rows *rows, sl_pvs *out,
                              uint64_t *pairs) {
    const uint32_t cells = rows->rows.cell_count;
    sli_pvs_maker maker;
    sl_status status = sli_pvs_maker_create(context, cells, cells, &maker);
    for (uint32_t i = 0; i < cells && status == SL_OK; i++) {
        for (uint32_t node = rows->view_cells[i]; node != SL_NO_VIEW_CELL;
             node = rows->parents[node])
            sli_pvs_maker_add(&maker, &rows->rows, node);
        status = sli_pvs_maker_end_row(context, &maker);
        if (status == SL_OK && i % 256 == 0) status = sl_check_cancelled(context);
    }
    if (status == SL_OK) status = sli_pvs_maker_finish(context, &maker, out);
    if (status == SL_OK) *pairs = maker.pairs;
    sli_pvs_maker_destroy(context, &maker);
    return status;
}

/// A PVS made row by row, in the cells' order, from sets put together from other rows.
#ifndef SL_PVS_MAKER_H
#define SL_PVS_MAKER_H

#include "cell_to_cell/pvs_rows.h"
#include "cell_to_cell/word_set.h"

typedef struct sl_pvs_maker {
    sl_word_set row; ///< being made
    uint32_t count, made;
    uint64_t pairs; ///< of the rows made
    uint64_t *offsets;
    sl_row_bytes bytes;
    SL_ARRAY(sl_bits) words;   ///< scratch: those of the row that have any
    SL_ARRAY(uint32_t) places; ///< scratch: where they are
} sl_pvs_maker;

/// For so many rows of `members` possible members. To be destroyed also on failure.
sl_status sl_pvs_maker_create(sl_context *context, uint32_t members, uint32_t rows,
                              sl_pvs_maker *maker);
void sl_pvs_maker_destroy(sl_context *context, sl_pvs_maker *maker);

/// Adds to the row being made the members of another one.
void sl_pvs_maker_add(sl_pvs_maker *maker, const sl_pvs *pvs, uint32_t cell);

/// Makes of what was added the next row, and starts an empty one.
sl_status sl_pvs_maker_end_row(sl_context *context, sl_pvs_maker *maker);

/// The PVS, when all rows are made. The maker is then only to be destroyed.
sl_status sl_pvs_maker_finish(sl_context *context, sl_pvs_maker *maker, sl_pvs *out);

/// Adds to a set the members of a row.
void sl_word_set_add_row(sl_word_set *set, const sl_pvs *pvs, uint32_t cell);

/// Adds to a set the members of a row that another set has too.
void sl_word_set_add_common(sl_word_set *set, const sl_pvs *pvs, uint32_t cell,
                            const sl_word_set *other);

#endif

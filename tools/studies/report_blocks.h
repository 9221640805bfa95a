/// The blocks of a report while it is put together: titles, texts, tables, pictures.
#ifndef REPORT_BLOCKS_H
#define REPORT_BLOCKS_H

#include "sightline/draw.h"
#include "sightline/support.h"

typedef SL_ARRAY(const char *) text_list;

/// It keeps what its blocks refer to. Zeroed but for the context, it is empty.
typedef struct report_blocks {
    sl_context *context;
    SL_ARRAY(sl_document_block) list;
    SL_ARRAY(char *) texts;         ///< that blocks have
    SL_ARRAY(const char **) tables; ///< likewise
    sl_status status;               ///< the first failure; what is added after it is dropped
} report_blocks;

void blocks_keep_status(report_blocks *blocks, sl_status status);

/// A copy that is kept; "" after a failure.
const char *blocks_keep(report_blocks *blocks, const char *text);
/// Likewise, of up to 1023 bytes.
const char *blocks_say(report_blocks *blocks, const char *format, ...) SL_PRINTF(2, 3);
/// A number with four digits, or all before the point.
const char *blocks_number(report_blocks *blocks, double value);

void blocks_add(report_blocks *blocks, sl_document_block block);
void blocks_add_text(report_blocks *blocks, sl_document_block_kind kind, const char *text);
void blocks_add_cell(report_blocks *blocks, text_list *list, const char *text);
/// The names of the columns.
void blocks_add_head(report_blocks *blocks, text_list *list, const char *const *head,
                     size_t columns);
/// A row of two cells.
void blocks_add_row(report_blocks *blocks, text_list *list, const char *name, const char *value);
/// Adds a table of the cells in `list`, row by row, which it takes over.
void blocks_add_table(report_blocks *blocks, text_list *list, size_t columns);

void blocks_destroy(report_blocks *blocks);

#endif

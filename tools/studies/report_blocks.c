/// Blocks of a report, and the texts and tables that they refer to.
#include "studies/report_blocks.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/// The longest text, its 0 included; longer ones are cut.
enum { TEXT = 1024 };

void blocks_keep_status(report_blocks *b, sl_status status) {
    if (b->status == SL_OK) b->status = status;
}

const char *blocks_keep(report_blocks *b, const char *text) {
    char *copy = sl_copy_text(b->context, text, strlen(text));
    blocks_keep_status(b, copy ? SL_ARRAY_ROOM(b->context, &b->texts, 1) : SL_NO_MEMORY);
    if (b->status != SL_OK) {
        sl_free(b->context, copy);
        return "";
    }
    return b->texts.items[b->texts.count++] = copy;
}

const char *blocks_say(report_blocks *b, const char *format, ...) {
    char text[TEXT];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return blocks_keep(b, text);
}

void blocks_add(report_blocks *b, sl_document_block block) {
    if (b->status == SL_OK) blocks_keep_status(b, SL_ARRAY_ROOM(b->context, &b->list, 1));
    if (b->status == SL_OK) b->list.items[b->list.count++] = block;
}

void blocks_add_text(report_blocks *b, sl_document_block_kind kind, const char *text) {
    blocks_add(b, (sl_document_block){.kind = kind, .text = text});
}

void blocks_add_table(report_blocks *b, text_list *list, size_t columns) {
    blocks_keep_status(b, SL_ARRAY_ROOM(b->context, &b->tables, 1));
    if (b->status != SL_OK) {
        sl_free(b->context, list->items);
        return;
    }
    b->tables.items[b->tables.count++] = list->items;
    blocks_add(b, (sl_document_block){.kind = SL_BLOCK_TABLE,
                                      .cells = list->items,
                                      .columns = columns,
                                      .rows = list->count / columns});
}

void blocks_add_cell(report_blocks *b, text_list *list, const char *text) {
    if (b->status == SL_OK) blocks_keep_status(b, SL_ARRAY_ROOM(b->context, list, 1));
    if (b->status == SL_OK) list->items[list->count++] = text;
}

void blocks_add_head(report_blocks *blocks, text_list *list, const char *const *head,
                     size_t columns) {
    for (size_t c = 0; c < columns; c++) blocks_add_cell(blocks, list, head[c]);
}

void blocks_add_row(report_blocks *b, text_list *list, const char *name, const char *value) {
    blocks_add_cell(b, list, name);
    blocks_add_cell(b, list, value);
}

const char *blocks_number(report_blocks *b, double value) {
    if (isnan(value)) return "not defined";
    return blocks_say(b, fabs(value) >= 1000 ? "%.0f" : "%.4g", value);
}

void blocks_destroy(report_blocks *b) {
    for (size_t i = 0; i < b->texts.count; i++) sl_free(b->context, b->texts.items[i]);
    for (size_t i = 0; i < b->tables.count; i++) sl_free(b->context, b->tables.items[i]);
    sl_free(b->context, b->texts.items);
    sl_free(b->context, b->tables.items);
    sl_free(b->context, b->list.items);
}

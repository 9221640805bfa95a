/// Documents: blocks one under the other, on pages of A4. A block that does not fit the rest of a
/// page begins the next one; a table goes on there, with its head again.
#include "draw/marks.h"
#include "draw/page.h"

#include <cairo-pdf.h>
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#define MM (72 / 25.4) ///< a millimetre in points

#define WIDTH  (210 * MM)
#define HEIGHT (297 * MM)
#define MARGIN (20 * MM)
#define INNER  (WIDTH - 2 * MARGIN)
#define BOTTOM (HEIGHT - MARGIN)

/// Sizes of letters, and from line to line as a multiple of that.
#define TITLE   20.0
#define HEADING 13.0
#define BODY    9.5
#define CELL    8.5
#define LINE    1.45
#define GAP     10.0 ///< between columns

/// Columns beyond this one are not set apart from each other.
enum { COLUMNS_MOST = 16 };

typedef struct document {
    sl_context *context;
    cairo_t *cairo;
    cairo_surface_t *surface;
    const char *title;
    sl_palette palette;
    double y; ///< where the next block begins
    unsigned page;
} document;

// --- pages

static void draw_foot(const document *d) {
    char number[24];
    snprintf(number, sizeof number, "%u", d->page);
    const double y = HEIGHT - 0.5 * MARGIN;
    if (d->title)
        sl_text_show_within(d->cairo, d->palette.faint, MARGIN, y, INNER - 40, CELL, false,
                            d->title);
    sl_text_font(d->cairo, CELL, false);
    sl_text_show(d->cairo, d->palette.faint, MARGIN + INNER - sl_text_width(d->cairo, number), y,
                 number);
}

static void begin_page(document *d) {
    if (d->page++) cairo_show_page(d->cairo);
    d->y = MARGIN;
    draw_foot(d);
}

/// Begins a new page where so much does not fit the rest of this one.
static void need(document *d, double height) {
    if (d->y > MARGIN && d->y + height > BOTTOM) begin_page(d);
}

// --- texts

/// Lines of one size, with so much room above and below.
static void put_lines(document *d, const char *text, double size, bool bold, double above,
                      double more) {
    sl_text_font(d->cairo, size, bold);
    const double height = sl_text_lines(d->cairo, INNER, text) * LINE * size;
    if (d->y > MARGIN) d->y += above;
    need(d, height + more);
    sl_text_font(d->cairo, size, bold);
    sl_text_show_lines(d->cairo, d->palette.ink, MARGIN, d->y + size, INNER, LINE * size, text);
    d->y += height;
}

/// A heading stays with what follows it, and the file's outline leads to it.
static void put_heading(document *d, const char *text, double more) {
    char place[64];
    put_lines(d, text, HEADING, true, 1.6 * HEADING, more);
    snprintf(place, sizeof place, "page=%u", d->page);
    cairo_pdf_surface_add_outline(d->surface, CAIRO_PDF_OUTLINE_ROOT, text, place, 0);
    d->y += 0.3 * HEADING;
}

// --- tables

typedef struct table_layout {
    const sl_document_block *block;
    double left[COLUMNS_MOST], width[COLUMNS_MOST];
} table_layout;

static bool is_number(const char *text) {
    return isdigit((unsigned char)text[0]) || (text[0] == '-' && isdigit((unsigned char)text[1]));
}

/// All columns but the last are as wide as their widest cell.
static void measure_columns(const document *d, table_layout *t) {
    const sl_document_block *b = t->block;
    double left = MARGIN;
    for (size_t c = 0; c < b->columns; c++) {
        t->left[c] = left;
        for (size_t r = 0; r < b->rows && c + 1 < b->columns; r++) {
            sl_text_font(d->cairo, CELL, r == 0);
            t->width[c] = fmax(t->width[c], sl_text_width(d->cairo, b->cells[r * b->columns + c]));
        }
        left += t->width[c] + GAP;
    }
    const size_t last = b->columns - 1;
    t->width[last] = fmax(MARGIN + INNER - t->left[last], 6 * CELL);
}

static double row_height(const document *d, const table_layout *t, size_t row) {
    const sl_document_block *b = t->block;
    sl_text_font(d->cairo, CELL, row == 0);
    const unsigned lines = sl_text_lines(d->cairo, t->width[b->columns - 1],
                                         b->cells[row * b->columns + b->columns - 1]);
    return fmax(lines, 1) * LINE * CELL + 2;
}

static void put_row(document *d, const table_layout *t, size_t row) {
    const sl_document_block *b = t->block;
    const double height = row_height(d, t, row), base = d->y + CELL + 1;
    for (size_t c = 0; c < b->columns; c++) {
        const char *text = b->cells[row * b->columns + c];
        sl_text_font(d->cairo, CELL, row == 0);
        const bool right = c > 0 && c + 1 < b->columns && (row == 0 || is_number(text));
        const double x = t->left[c] + (right ? t->width[c] - sl_text_width(d->cairo, text) : 0);
        if (c + 1 < b->columns)
            sl_text_show(d->cairo, d->palette.ink, x, base, text);
        else
            sl_text_show_lines(d->cairo, d->palette.ink, x, base, t->width[c], LINE * CELL, text);
    }
    d->y += height;
    cairo_move_to(d->cairo, MARGIN, d->y);
    cairo_line_to(d->cairo, MARGIN + INNER, d->y);
    sli_pen_stroke(d->cairo, row == 0 ? d->palette.ink : d->palette.outline, row == 0 ? 0.8 : 0.4);
}

static void put_table(document *d, const sl_document_block *block) {
    table_layout t = {.block = block};
    measure_columns(d, &t);
    d->y += 0.5 * BODY;
    need(d, row_height(d, &t, 0) + (block->rows > 1 ? row_height(d, &t, 1) : 0));
    for (size_t r = 0; r < block->rows; r++) {
        if (d->y + row_height(d, &t, r) > BOTTOM) {
            begin_page(d);
            put_row(d, &t, 0);
        }
        put_row(d, &t, r);
    }
    d->y += 0.8 * BODY;
}

// --- pictures

static sl_status draw_picture(document *d, const sl_document_block *block,
                              const sl_draw_options *options, sli_page_target *target) {
    return block->coverage
               ? sli_draw_coverage(d->context, block->baked, block->coverage, NULL, options, target)
               : sli_draw_picture(d->context, block->baked, block->field, block->lines, options,
                                  target);
}

/// A picture is as wide as the text, unless it is then higher than a page. *height has its caption.
static sl_status measure_picture(document *d, const sl_document_block *block,
                                 sl_draw_options *options, double *height) {
    const double caption = block->text ? 2 * LINE * CELL : 0;
    sli_page_target target = {.cairo = d->cairo};
    *options = sl_draw_options_default();
    options->labels = block->labels;
    options->label_count = block->label_count;
    options->width = INNER / 0.92; // a page of its own has margins
    for (;; options->width *= 0.9) {
        SL_TRY(draw_picture(d, block, options, &target));
        *height = target.height + caption;
        if (*height <= BOTTOM - MARGIN || options->width < 2 * SL_DRAW_WIDTH_MIN) return SL_OK;
    }
}

static sl_status put_picture(document *d, const sl_document_block *block) {
    sl_draw_options options;
    double height;
    SL_TRY(measure_picture(d, block, &options, &height));
    need(d, height);
    sli_page_target target = {
        .cairo = d->cairo, .at = {(WIDTH - options.width) / 2, d->y}, .paint = true};
    SL_TRY(draw_picture(d, block, &options, &target));
    d->y += target.height;
    if (block->text) put_lines(d, block->text, CELL, false, 0, 0);
    return sl_check_cancelled(d->context);
}

// --- the file

/// The height of what is to stay with a heading: texts up to the next picture, and that; or a
/// few lines.
static sl_status height_after(document *d, const sl_document_block *blocks, size_t count,
                              double *height) {
    sl_draw_options options;
    *height = 0;
    size_t i = 0;
    for (; i < count && blocks[i].kind == SL_BLOCK_TEXT; i++) {
        sl_text_font(d->cairo, BODY, false);
        *height += (sl_text_lines(d->cairo, INNER, blocks[i].text) * LINE + 0.5) * BODY;
    }
    if (i == count || blocks[i].kind != SL_BLOCK_PICTURE) {
        *height = 8 * BODY;
        return SL_OK;
    }
    double picture;
    SL_TRY(measure_picture(d, &blocks[i], &options, &picture));
    *height += picture + HEADING;
    return SL_OK;
}

/// `count` blocks are left, this one included.
static sl_status put_block(document *d, const sl_document_block *block, size_t count) {
    double more;
    switch (block->kind) {
    case SL_BLOCK_TITLE:
        put_lines(d, block->text, TITLE, true, TITLE, 0);
        break;
    case SL_BLOCK_HEADING:
        SL_TRY(height_after(d, block + 1, count - 1, &more));
        put_heading(d, block->text, more);
        break;
    case SL_BLOCK_TEXT:
        put_lines(d, block->text, BODY, false, 0.5 * BODY, 0);
        break;
    case SL_BLOCK_TABLE:
        put_table(d, block);
        break;
    case SL_BLOCK_PICTURE:
        return put_picture(d, block);
    }
    return sl_check_cancelled(d->context);
}

static sl_status check_blocks(sl_context *context, const sl_document_block *blocks, size_t count,
                              const char *path) {
    const size_t length = strlen(path);
    if (length <= 4 || strcasecmp(path + length - 4, ".pdf") != 0)
        return sl_fail(context, SL_BAD_ARGUMENT, "%s: a document's name ends in .pdf", path);
    for (size_t i = 0; i < count; i++)
        if (blocks[i].kind == SL_BLOCK_TABLE &&
            (blocks[i].columns == 0 || blocks[i].columns > COLUMNS_MOST || blocks[i].rows == 0))
            return sl_fail(context, SL_BAD_ARGUMENT, "a table has 1 to %d columns and a head",
                           COLUMNS_MOST);
    return SL_OK;
}

sl_status sl_draw_document_file(sl_context *context, const sl_document_block *blocks, size_t count,
                                const char *title, const char *path) {
    const sli_paper_kind *kind;
    sli_paper paper;
    SL_TRY(check_blocks(context, blocks, count, path));
    SL_TRY(sli_paper_kind_of(context, path, &kind));
    SL_TRY(sli_paper_open(context, kind, path, WIDTH, HEIGHT, false, title, &paper));
    document d = {.context = context,
                  .cairo = paper.cairo,
                  .surface = paper.surface,
                  .title = title,
                  .palette = sl_palette_make(false)};
    begin_page(&d);
    sl_status status = SL_OK;
    for (size_t i = 0; i < count && status == SL_OK; i++)
        status = put_block(&d, &blocks[i], count - i);
    return sli_paper_close(context, &paper, status);
}

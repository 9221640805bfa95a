/// Text on a page, by Pango: it breaks lines, and takes letters that the font lacks from others.
///
/// Setting a text (finding its letters, joining and breaking them) costs far more than drawing it,
/// and most text of a window stays from frame to frame. So a surface keeps the last texts that were
/// set on it. The shelf follows from the text, its font and its width; on a full shelf a text
/// replaces the one that was used least recently. So the cost of a text seen before is a hash, and
/// memory is bounded.
///
/// Letters are not fitted to pixels: their widths grow evenly with the size, and pictures of any
/// width and kind are laid out alike. The font stands in the cairo context, as a face and a size:
/// it is saved and restored with it.
#include "draw/draw_plan.h"
#include "draw/live.h"

#include <math.h>
#include <pango/pangocairo.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define THIN_SPACE "\xe2\x80\x89"

enum { SHELVES = 256, ON_A_SHELF = 4 };

/// How a text is set: on one line, on one line cut with an ellipsis, or on several.
typedef enum text_setting { ON_A_LINE, CUT, WRAPPED } text_setting;

/// Letters of one font, on one line.
typedef struct run {
    cairo_scaled_font_t *font; ///< for a page that is neither turned nor scaled
    size_t first, count;       ///< of the glyphs
    int line;
} run;

typedef struct kept_text {
    char *text; ///< NULL: none
    double size, width;
    bool bold;
    text_setting setting;
    uint64_t used; ///< when, by the count of texts shown
    PangoLayout *layout;
    double wide; ///< of its first line
    int lines;
    cairo_glyph_t *glyphs; ///< of all runs; each line begins at the origin
    run *runs;
    size_t run_count;
} kept_text;

/// What a surface keeps. The fonts come from the map of fonts of the thread that draws.
typedef struct text_store {
    PangoContext *context;
    kept_text kept[SHELVES * ON_A_SHELF];
    uint64_t count; ///< of texts shown
} text_store;

static const cairo_user_data_key_t store_key = {0};

static void drop_runs(kept_text *kept) {
    for (size_t i = 0; i < kept->run_count; i++) cairo_scaled_font_destroy(kept->runs[i].font);
    free(kept->glyphs);
    free(kept->runs);
    kept->glyphs = NULL;
    kept->runs = NULL;
    kept->run_count = 0;
}

static void drop_store(void *data) {
    text_store *store = data;
    for (int i = 0; i < SHELVES * ON_A_SHELF; i++) {
        kept_text *kept = &store->kept[i];
        drop_runs(kept);
        free(kept->text);
        if (kept->layout) g_object_unref(kept->layout);
    }
    g_object_unref(store->context);
    free(store);
}

static cairo_font_options_t *make_options(void) {
    cairo_font_options_t *options = cairo_font_options_create();
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    return options;
}

/// The store of the context's surface; NULL if memory is short or the context has failed.
static text_store *store_of(cairo_t *cairo) {
    cairo_surface_t *surface = cairo_get_target(cairo);
    text_store *store = cairo_surface_get_user_data(surface, &store_key);
    if (store || cairo_status(cairo) != CAIRO_STATUS_SUCCESS) return store;
    store = calloc(1, sizeof *store);
    if (!store) return NULL;
    store->context = pango_font_map_create_context(pango_cairo_font_map_get_default());
    cairo_font_options_t *options = make_options();
    pango_cairo_context_set_font_options(store->context, options);
    cairo_font_options_destroy(options);
    pango_cairo_context_set_resolution(store->context, 96);
    pango_context_set_round_glyph_positions(store->context, FALSE);
    pango_context_set_language(store->context, pango_language_from_string("en"));
    if (cairo_surface_set_user_data(surface, &store_key, store, drop_store) == CAIRO_STATUS_SUCCESS)
        return store;
    drop_store(store);
    return NULL;
}

static uint64_t hash_bytes(uint64_t hash, const void *data, size_t count) {
    const unsigned char *bytes = data;
    for (size_t i = 0; i < count; i++) hash = (hash ^ bytes[i]) * 0x100000001b3;
    return hash;
}

static bool is_same(const kept_text *a, const kept_text *b) {
    return a->text && a->size == b->size && a->width == b->width && a->bold == b->bold &&
           a->setting == b->setting && strcmp(a->text, b->text) == 0;
}

/// The place of a text on its shelf, or the one that it is to have.
static kept_text *find(text_store *store, uint64_t hash, const kept_text *wanted) {
    kept_text *shelf = &store->kept[hash % SHELVES * ON_A_SHELF], *oldest = shelf;
    for (int i = 0; i < ON_A_SHELF; i++) {
        if (is_same(&shelf[i], wanted)) return &shelf[i];
        if (shelf[i].used < oldest->used) oldest = &shelf[i];
    }
    return oldest;
}

static void set_text(PangoLayout *layout, const kept_text *wanted) {
    PangoFontDescription *font = pango_font_description_new();
    pango_font_description_set_family_static(font, "DejaVu Sans");
    pango_font_description_set_weight(font, wanted->bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
    pango_font_description_set_absolute_size(font, wanted->size * PANGO_SCALE);
    pango_layout_set_font_description(layout, font);
    pango_font_description_free(font);
    const bool wraps = wanted->setting == WRAPPED;
    const double width = fmin(fmax(wanted->width, 1), 1e5);
    pango_layout_set_single_paragraph_mode(layout, !wraps);
    pango_layout_set_wrap(layout, PANGO_WRAP_WORD_CHAR);
    pango_layout_set_ellipsize(layout,
                               wanted->setting == CUT ? PANGO_ELLIPSIZE_END : PANGO_ELLIPSIZE_NONE);
    pango_layout_set_width(layout, wanted->setting == ON_A_LINE ? -1 : (int)(width * PANGO_SCALE));
    // Names of files may be of any bytes.
    if (g_utf8_validate(wanted->text, -1, NULL)) {
        pango_layout_set_text(layout, wanted->text, -1);
        return;
    }
    char *valid = g_utf8_make_valid(wanted->text, -1);
    pango_layout_set_text(layout, valid, -1);
    g_free(valid);
}

/// The number of runs and of glyphs; false where Pango has to draw the text itself, as a letter is
/// in no font.
static bool count_runs(PangoLayout *layout, size_t *runs, size_t *glyphs) {
    *runs = *glyphs = 0;
    for (const GSList *l = pango_layout_get_lines_readonly(layout); l; l = l->next)
        for (const GSList *r = ((PangoLayoutLine *)l->data)->runs; r; r = r->next) {
            const PangoGlyphString *string = ((PangoGlyphItem *)r->data)->glyphs;
            for (int i = 0; i < string->num_glyphs; i++)
                if (string->glyphs[i].glyph & PANGO_GLYPH_UNKNOWN_FLAG) return false;
            *glyphs += (size_t)string->num_glyphs;
            ++*runs;
        }
    return *runs > 0 && *glyphs > 0;
}

/// Adds the glyphs of a run that begins at x; returns where it ends.
static double add_run(kept_text *kept, const PangoGlyphItem *item, int line, size_t *at, double x) {
    const PangoGlyphString *string = item->glyphs;
    PangoCairoFont *font = (PangoCairoFont *)item->item->analysis.font;
    run *r = &kept->runs[kept->run_count++];
    *r = (run){cairo_scaled_font_reference(pango_cairo_font_get_scaled_font(font)), *at, 0, line};
    for (int i = 0; i < string->num_glyphs; i++) {
        const PangoGlyphInfo *glyph = &string->glyphs[i];
        if (glyph->glyph != PANGO_GLYPH_EMPTY) {
            kept->glyphs[(*at)++] =
                (cairo_glyph_t){glyph->glyph, x + (double)glyph->geometry.x_offset / PANGO_SCALE,
                                (double)glyph->geometry.y_offset / PANGO_SCALE};
            r->count++;
        }
        x += (double)glyph->geometry.width / PANGO_SCALE;
    }
    return x;
}

/// Takes the glyphs out of the layout: drawing those costs a fraction of drawing the layout.
/// Without them, for lack of memory too, the layout is drawn.
static void take_glyphs(kept_text *kept) {
    size_t runs, glyphs;
    drop_runs(kept);
    if (!count_runs(kept->layout, &runs, &glyphs)) return;
    kept->runs = calloc(runs, sizeof *kept->runs);
    kept->glyphs = calloc(glyphs, sizeof *kept->glyphs);
    size_t at = 0;
    int line = 0;
    if (!kept->runs || !kept->glyphs) {
        drop_runs(kept);
        return;
    }
    for (const GSList *l = pango_layout_get_lines_readonly(kept->layout); l; l = l->next, line++) {
        double x = 0;
        for (const GSList *r = ((PangoLayoutLine *)l->data)->runs; r; r = r->next)
            x = add_run(kept, r->data, line, &at, x);
    }
}

static void fill(kept_text *kept) {
    PangoRectangle extents;
    set_text(kept->layout, kept);
    kept->lines = pango_layout_get_line_count(kept->layout);
    pango_layout_line_get_extents(pango_layout_get_line_readonly(kept->layout, 0), NULL, &extents);
    kept->wide = (double)extents.width / PANGO_SCALE;
    take_glyphs(kept);
}

/// Sets a text in the context's font; NULL if that cannot be.
static const kept_text *set(cairo_t *cairo, const char *text, text_setting setting, double width) {
    text_store *store = store_of(cairo);
    cairo_matrix_t matrix;
    cairo_font_face_t *face = cairo_get_font_face(cairo);
    cairo_get_font_matrix(cairo, &matrix);
    if (!store || !(matrix.yy > 0)) return NULL;
    kept_text wanted = {.size = matrix.yy, .width = width, .setting = setting};
    if (cairo_font_face_get_type(face) == CAIRO_FONT_TYPE_TOY)
        wanted.bold = cairo_toy_font_face_get_weight(face) == CAIRO_FONT_WEIGHT_BOLD;
    const size_t length = strlen(text);
    uint64_t hash = hash_bytes(0xcbf29ce484222325, text, length);
    hash = hash_bytes(hash, &wanted.size, sizeof wanted.size);
    hash = hash_bytes(hash, &width, sizeof width) ^ wanted.bold ^ (uint64_t)setting << 1;
    wanted.text = (char *)(uintptr_t)text; // only read
    kept_text *kept = find(store, hash ^ hash >> 32, &wanted);
    kept->used = ++store->count;
    if (is_same(kept, &wanted)) return kept;
    char *copy = realloc(kept->text, length + 1);
    if (!copy) return NULL;
    memcpy(copy, text, length + 1);
    kept->text = copy;
    kept->size = wanted.size;
    kept->width = width;
    kept->bold = wanted.bold;
    kept->setting = setting;
    if (!kept->layout) kept->layout = pango_layout_new(store->context);
    fill(kept);
    return kept;
}

void sl_text_font(cairo_t *cairo, double size, bool bold) {
    cairo_select_font_face(cairo, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo, size);
}

double sl_text_width(cairo_t *cairo, const char *text) {
    const kept_text *kept = set(cairo, text, ON_A_LINE, 0);
    return kept ? kept->wide : 0;
}

/// By Pango, which names the letters too, for files that keep them (PDF).
static void show_layout(cairo_t *cairo, const kept_text *kept, int line, double x, double y) {
    pango_cairo_update_layout(cairo, kept->layout);
    cairo_move_to(cairo, x, y);
    pango_cairo_show_layout_line(cairo, pango_layout_get_line_readonly(kept->layout, line));
    // The fonts of the next text are again those of a page that is not turned.
    pango_context_set_matrix(pango_layout_get_context(kept->layout), NULL);
}

static void set_font(cairo_t *cairo, cairo_scaled_font_t *font) {
    cairo_matrix_t page, matrix;
    cairo_get_matrix(cairo, &page);
    if (page.xx == 1 && page.yy == 1 && page.xy == 0 && page.yx == 0) {
        cairo_set_scaled_font(cairo, font);
        return;
    }
    cairo_font_options_t *options = make_options();
    cairo_scaled_font_get_font_matrix(font, &matrix);
    cairo_set_font_face(cairo, cairo_scaled_font_get_font_face(font));
    cairo_set_font_matrix(cairo, &matrix);
    cairo_set_font_options(cairo, options);
    cairo_font_options_destroy(options);
}

static void show_run(cairo_t *cairo, const kept_text *kept, const run *r, double x, double y) {
    cairo_glyph_t shown[128];
    const size_t room = sizeof shown / sizeof *shown;
    set_font(cairo, r->font);
    for (size_t i = 0; i < r->count;) {
        size_t count = 0;
        for (; count < room && i < r->count; count++, i++) {
            const cairo_glyph_t *glyph = &kept->glyphs[r->first + i];
            shown[count] = (cairo_glyph_t){glyph->index, x + glyph->x, y + glyph->y};
        }
        cairo_show_glyphs(cairo, shown, (int)count);
    }
}

/// Keeps the lines as text, where the page does; false: they are to be drawn. The letters of a text
/// that is cut are not those of the text.
static bool keep_lines(cairo_t *cairo, sl_colour colour, double x, double y, double spacing,
                       const kept_text *kept) {
    const char *text = pango_layout_get_text(kept->layout);
    for (int i = 0; i < kept->lines && kept->setting != CUT; i++) {
        PangoRectangle extents;
        PangoLayoutLine *line = pango_layout_get_line_readonly(kept->layout, i);
        pango_layout_line_get_extents(line, NULL, &extents);
        const sli_live_text live = {.text = text + line->start_index,
                                    .length = (size_t)line->length,
                                    .size = kept->size,
                                    .width = (double)extents.width / PANGO_SCALE,
                                    .bold = kept->bold};
        if (!sli_live_keep(cairo, colour, x, y + i * spacing, &live)) return false;
    }
    return kept->setting != CUT;
}

/// Draws lines from the left end of the first base line, `spacing` apart.
static void show(cairo_t *cairo, sl_colour colour, double x, double y, double spacing,
                 const kept_text *kept) {
    if (!kept || keep_lines(cairo, colour, x, y, spacing, kept)) return;
    sl_set_colour(cairo, colour);
    cairo_save(cairo);
    if (!kept->run_count || cairo_surface_has_show_text_glyphs(cairo_get_target(cairo)))
        for (int i = 0; i < kept->lines; i++) show_layout(cairo, kept, i, x, y + i * spacing);
    else
        for (size_t i = 0; i < kept->run_count; i++)
            show_run(cairo, kept, &kept->runs[i], x, y + kept->runs[i].line * spacing);
    cairo_restore(cairo);
    cairo_new_path(cairo);
}

void sl_text_show(cairo_t *cairo, sl_colour colour, double x, double y, const char *text) {
    show(cairo, colour, x, y, 0, set(cairo, text, ON_A_LINE, 0));
}

void sl_text_show_within(cairo_t *cairo, sl_colour colour, double x, double y, double width,
                         double size, bool bold, const char *text) {
    sl_text_font(cairo, size, bold);
    const double wanted = sl_text_width(cairo, text);
    if (wanted > width) sl_text_font(cairo, size * fmax(width / wanted, 2.0 / 3), bold);
    if (wanted * (2.0 / 3) <= width)
        sl_text_show(cairo, colour, x, y, text);
    else
        show(cairo, colour, x, y, 0, set(cairo, text, CUT, width));
}

unsigned sl_text_lines(cairo_t *cairo, double width, const char *text) {
    const kept_text *kept = *text ? set(cairo, text, WRAPPED, width) : NULL;
    return kept ? (unsigned)kept->lines : 0;
}

unsigned sl_text_show_lines(cairo_t *cairo, sl_colour colour, double x, double y, double width,
                            double spacing, const char *text) {
    const kept_text *kept = *text ? set(cairo, text, WRAPPED, width) : NULL;
    show(cairo, colour, x, y, spacing, kept);
    return kept ? (unsigned)kept->lines : 0;
}

void sli_text_copy(const char *text, size_t length, char *out, size_t room) {
    if (length > room - 1) {
        length = room - 1;
        // A byte 10xxxxxx continues a character.
        while (length > 0 && ((unsigned char)text[length] & 0xc0) == 0x80) length--;
    }
    memcpy(out, text, length);
    out[length] = '\0';
}

void sl_text_count(uint64_t count, const char *unit, char text[SL_COUNT_TEXT]) {
    char digits[24], grouped[2 * sizeof digits];
    const int length = snprintf(digits, sizeof digits, "%llu", (unsigned long long)count);
    size_t at = 0;
    for (int i = 0; i < length; i++) {
        if (i > 0 && (length - i) % 3 == 0) {
            memcpy(grouped + at, THIN_SPACE, sizeof THIN_SPACE - 1);
            at += sizeof THIN_SPACE - 1;
        }
        grouped[at++] = digits[i];
    }
    grouped[at] = '\0';
    snprintf(text, SL_COUNT_TEXT, "%s%s%s%s", grouped, *unit ? " " : "", unit,
             *unit && count != 1 ? "s" : "");
}

void sl_text_percent(double share, char text[SL_COUNT_TEXT]) {
    const unsigned tenths = (unsigned)(fmin(fmax(share, 0), 1) * 1000 + 0.5);
    snprintf(text, SL_COUNT_TEXT, "%u.%u" THIN_SPACE "%%", tenths / 10, tenths % 10);
}

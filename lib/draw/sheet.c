/// Sheets of paper: a plan to scale, as it is printed or plotted.
///
///     +---------------------------------+
///     |                                 |   the plan, in the middle of what is free
///     |   legend                        |
///     +---------------------+-----------+
///     | title, note   |--|  | 1:100  N  |   title block
///     +---------------------+-----------+
///
/// What fits depends on the legend, whose height depends on the width. So a page is laid out for
/// each of the two ways that the paper may lie, and for each scale that is tried.
#include "draw/sheet.h"
#include "draw/marks.h"
#include "map/unit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#define MM (72 / 25.4) ///< a millimetre in points

/// Of the page, in points.
#define MARGIN (10 * MM)
#define BLOCK  (24 * MM) ///< the height of the title block
#define TEXT   9.0       ///< the size of letters

/// Sizes of ISO 216, in mm.
static const struct {
    const char *name;
    double narrow, wide;
} papers[] = {
    {"A0", 841, 1189}, {"A1", 594, 841}, {"A2", 420, 594}, {"A3", 297, 420}, {"A4", 210, 297},
};
enum { PAPERS = sizeof papers / sizeof *papers };

/// Round scales, the largest first: 1:1, 1:2, 1:2.5, 1:3, 1:4, 1:5, 1:10, and so on.
enum { LEADING = 6, ROUND_SCALES = LEADING * 9 };
static double round_scale(int step) {
    static const double leading[LEADING] = {1, 2, 2.5, 3, 4, 5};
    double scale = leading[step % LEADING];
    for (int i = step / LEADING; i > 0; i--) scale *= 10;
    return scale;
}

// --- what was asked for

static sl_status read_scale(sl_context *context, const char *text, double *scale) {
    const bool ratio = strncmp(text, "1:", 2) == 0;
    if (ratio && sl_number_read(text + 2, strlen(text + 2), scale) && *scale >= 1 && *scale <= 1e9)
        return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "plot scale \"%s\": expected 1:N with N from 1 to 1e9, as 1:100", text);
}

sl_status sli_sheet_read(sl_context *context, const sl_scene *scene, const char *title,
                         const char *path, sli_sheet *out) {
    const sl_sheet *asked = &scene->options.sheet;
    const size_t length = strlen(path);
    int p = 0;
    while (p < PAPERS && strcasecmp(papers[p].name, asked->paper) != 0) p++;
    if (p == PAPERS)
        return sl_fail(context, SL_BAD_ARGUMENT, "paper \"%s\": expected A0, A1, A2, A3 or A4",
                       asked->paper);
    if (length >= 4 && strcasecmp(path + length - 4, ".png") == 0)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "%s: a sheet of paper is a file that ends in .pdf or .svg", path);
    *out = (sli_sheet){.scene = scene,
                       .title = title,
                       .paper = papers[p].name,
                       .narrow = papers[p].narrow * MM,
                       .wide = papers[p].wide * MM,
                       .metres = sli_unit_metres(scene->baked->map.unit)};
    if (!(out->metres > 0))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "%s: the map does not say what its lengths are in, which a scale needs: "
                       "begin its text with 'unit m', or read a drawing with --unit mm=m",
                       path);
    return asked->scale ? read_scale(context, asked->scale, &out->scale) : SL_OK;
}

// --- what fits

/// Lays out a page. Whether the plan fits it; what is free then goes above and below the plan.
static bool lay_out(cairo_t *cairo, const sli_page_parts *parts, const sli_sheet *sheet, bool high,
                    double scale, sli_page *page) {
    const sl_box b = sheet->scene->baked->space.bounds;
    const double width = high ? sheet->narrow : sheet->wide;
    const double height = high ? sheet->wide : sheet->narrow;
    *page = (sli_page){.width = width,
                       .margin = MARGIN,
                       .inner = width - 2 * MARGIN,
                       .text = TEXT,
                       .plan_scale = 1000 * MM * sheet->metres / scale};
    sli_page_set(cairo, parts, page, false);
    const double free = height - BLOCK - MARGIN - page->height;
    page->height = height;
    page->frame.top += free / 2;
    page->bottom += free;
    page->key += free;
    return free >= 0 && (b.max.x - b.min.x) * page->plan_scale <= page->inner;
}

/// Tries both ways that the paper may lie, the one that is more like the plan first.
static bool fits(cairo_t *cairo, const sli_page_parts *parts, const sli_sheet *sheet, double scale,
                 sli_page *page) {
    const sl_box b = sheet->scene->baked->space.bounds;
    const bool high = b.max.y - b.min.y > b.max.x - b.min.x;
    return lay_out(cairo, parts, sheet, high, scale, page) ||
           lay_out(cairo, parts, sheet, !high, scale, page);
}

sl_status sli_sheet_lay_out(sl_context *context, cairo_t *cairo, const sli_page_parts *parts,
                            sli_sheet *sheet, sli_page *page) {
    const sl_box b = sheet->scene->baked->space.bounds;
    double *const drawn_at = sheet->scene->options.sheet.drawn_at;
    int step = 0;
    if (sheet->scale > 0 && fits(cairo, parts, sheet, sheet->scale, page)) {
        if (drawn_at) *drawn_at = sheet->scale;
        return SL_OK;
    }
    while (step < ROUND_SCALES && !(round_scale(step) > sheet->scale &&
                                    fits(cairo, parts, sheet, round_scale(step), page)))
        step++;
    if (step < ROUND_SCALES && !(sheet->scale > 0)) {
        sheet->scale = round_scale(step);
        if (drawn_at) *drawn_at = sheet->scale;
        return SL_OK;
    }
    char fitting[64] = "no round scale fits";
    if (step < ROUND_SCALES) snprintf(fitting, sizeof fitting, "1:%.9g fits", round_scale(step));
    const double mm = 1000 * sheet->metres / (sheet->scale > 0 ? sheet->scale : 1);
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "the plan is %.4g mm x %.4g mm at 1:%.9g: too large for %s; %s",
                   (b.max.x - b.min.x) * mm, (b.max.y - b.min.y) * mm,
                   sheet->scale > 0 ? sheet->scale : 1, sheet->paper, fitting);
}

// --- the scale bar

/// The longest 1, 2 or 5 times a power of ten up to `limit`, as the nearest double and as text.
/// False if there is none.
static bool round_length(double limit, double *length, char text[SL_NUMBER_TEXT]) {
    static const int leading[] = {1, 2, 5};
    if (!(limit > 0) || !isfinite(limit)) return false;
    bool found = false;
    for (int power = (int)floor(log10(limit)) - 1, i = 0; i < 9; i++) {
        char decimal[SL_NUMBER_TEXT];
        double value;
        // Read as text, since pow() may be a bit off the decimal.
        const int size = snprintf(decimal, sizeof decimal, "%de%d", leading[i % 3], power + i / 3);
        if (!sl_number_read(decimal, (size_t)size, &value) || !(value > 0) || value > limit)
            continue;
        *length = value;
        found = true;
    }
    if (found) sl_number_write(*length, text);
    return found;
}

void sli_draw_scale_bar(cairo_t *cairo, const sl_scene *scene, const sl_frame *frame, double right,
                        double y, double room, double text) {
    double length;
    char number[SL_NUMBER_TEXT], label[SL_NUMBER_TEXT + 24];
    if (!round_length(room / frame->scale, &length, number)) return;
    const char *unit = scene->baked->map.unit;
    snprintf(label, sizeof label, "%s %s", number, *unit ? unit : length == 1 ? "unit" : "units");
    const double left = right - length * frame->scale, tick = 0.35 * text;
    cairo_move_to(cairo, left, y - tick);
    cairo_line_to(cairo, left, y);
    cairo_line_to(cairo, right, y);
    cairo_line_to(cairo, right, y - tick);
    sl_set_colour(cairo, scene->palette.ink);
    cairo_set_line_width(cairo, 0.11 * text);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_SQUARE);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_MITER);
    cairo_stroke(cairo);
    sl_text_font(cairo, text, false);
    sl_text_show(cairo, scene->palette.faint, right - sl_text_width(cairo, label), y + 1.15 * text,
                 label);
}

// --- the title block

/// Which way north is on the page, as a unit vector. False if nobody has said it: y is north where
/// the map lies on the earth.
static bool find_north(const sl_scene *scene, sl_point *north) {
    const sl_point asked = scene->options.sheet.north;
    const double length = hypot(asked.x, asked.y);
    *north = (sl_point){0, -1};
    if (length > 0) *north = (sl_point){asked.x / length, -asked.y / length};
    return length > 0 || scene->baked->map.earth.known;
}

static void draw_north(cairo_t *cairo, const sl_palette *palette, sl_point at, double radius,
                       sl_point north) {
    const sl_point side = {-north.y, north.x};
    const double tip = 0.55 * radius, wing = 0.32 * radius;
    cairo_move_to(cairo, at.x + tip * north.x, at.y + tip * north.y);
    cairo_line_to(cairo, at.x - radius * north.x + wing * side.x,
                  at.y - radius * north.y + wing * side.y);
    cairo_line_to(cairo, at.x - 0.7 * radius * north.x, at.y - 0.7 * radius * north.y);
    cairo_line_to(cairo, at.x - radius * north.x - wing * side.x,
                  at.y - radius * north.y - wing * side.y);
    cairo_close_path(cairo);
    sl_set_colour(cairo, palette->ink);
    cairo_fill(cairo);
    sl_text_font(cairo, TEXT, true);
    sl_text_show(cairo, palette->ink, at.x + radius * north.x - sl_text_width(cairo, "N") / 2,
                 at.y + radius * north.y + 0.36 * TEXT, "N");
}

static void rule(cairo_t *cairo, const sl_palette *palette, double width) {
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_SQUARE);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_MITER);
    sli_pen_stroke(cairo, palette->ink, width);
}

void sli_sheet_paint(cairo_t *cairo, const sli_sheet *sheet, const sli_page *page) {
    const sl_scene *scene = sheet->scene;
    const sl_palette *palette = &scene->palette;
    const double left = MARGIN / 2, right = page->width - left, low = page->height - left;
    const double top = page->height - MARGIN / 2 - BLOCK, width = right - left;
    const double second = left + 0.5 * width, third = right - 46 * MM;
    char text[64];
    sl_point north;
    cairo_new_path(cairo);
    cairo_rectangle(cairo, left, left, width, low - left);
    cairo_move_to(cairo, left, top);
    cairo_line_to(cairo, right, top);
    for (int i = 0; i < 2; i++) {
        cairo_move_to(cairo, i ? third : second, top);
        cairo_line_to(cairo, i ? third : second, low);
    }
    rule(cairo, palette, 0.7);
    const double x = left + TEXT, inner = second - x - TEXT;
    if (sheet->title)
        sl_text_show_within(cairo, palette->ink, x, top + 2.2 * TEXT, inner, 1.6 * TEXT, true,
                            sheet->title);
    if (scene->options.sheet.note)
        sl_text_show_within(cairo, palette->ink, x, top + 4.2 * TEXT, inner, TEXT, false,
                            scene->options.sheet.note);
    sli_draw_scale_bar(cairo, scene, &page->frame, third - TEXT, top + 2.4 * TEXT,
                       third - second - 2 * TEXT, TEXT);
    snprintf(text, sizeof text, "1:%.9g", sheet->scale);
    sl_text_show_within(cairo, palette->ink, third + TEXT, top + 2.2 * TEXT, 24 * MM, 1.6 * TEXT,
                        true, text);
    snprintf(text, sizeof text, "on %s", sheet->paper);
    sl_text_show_within(cairo, palette->ink, third + TEXT, top + 4.2 * TEXT, 24 * MM, TEXT, false,
                        text);
    if (find_north(scene, &north))
        draw_north(cairo, palette, (sl_point){right - 12 * MM, top + BLOCK / 2}, 8.5 * MM, north);
}

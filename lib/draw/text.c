#include "draw/text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define THIN_SPACE "\xe2\x80\x89"
#define ELLIPSIS   "\xe2\x80\xa6"

void sl_text_font(cairo_t *cairo, double size, bool bold) {
    cairo_font_options_t *options = cairo_font_options_create();
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_set_font_options(cairo, options);
    cairo_font_options_destroy(options);
    cairo_select_font_face(cairo, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo, size);
}

double sl_text_width(cairo_t *cairo, const char *text) {
    cairo_text_extents_t extents;
    cairo_text_extents(cairo, text, &extents);
    return extents.x_advance;
}

void sl_text_show(cairo_t *cairo, sl_colour colour, double x, double y, const char *text) {
    cairo_set_source_rgb(cairo, colour.red, colour.green, colour.blue);
    cairo_move_to(cairo, x, y);
    cairo_show_text(cairo, text);
    cairo_new_path(cairo);
}

void sl_text_copy(const char *text, size_t length, char *out, size_t room) {
    if (length > room - 1) {
        length = room - 1;
        // A byte 10xxxxxx continues a character.
        while (length > 0 && ((unsigned char)text[length] & 0xc0) == 0x80) length--;
    }
    memcpy(out, text, length);
    out[length] = '\0';
}

/// The text's longest beginning, at a character's end, that fits with an ellipsis behind it.
static void cut(cairo_t *cairo, const char *text, double width, char *out, size_t room) {
    size_t length = strlen(text);
    if (length > room - sizeof ELLIPSIS) length = room - sizeof ELLIPSIS;
    for (;; length--) {
        // A byte 10xxxxxx continues a character.
        while (length > 0 && ((unsigned char)text[length] & 0xc0) == 0x80) length--;
        snprintf(out, room, "%.*s" ELLIPSIS, (int)length, text);
        if (length == 0 || sl_text_width(cairo, out) <= width) return;
    }
}

void sl_text_show_within(cairo_t *cairo, sl_colour colour, double x, double y, double width,
                         double size, bool bold, const char *text) {
    sl_text_font(cairo, size, bold);
    const double wanted = sl_text_width(cairo, text);
    if (wanted > width) sl_text_font(cairo, size * fmax(width / wanted, 2.0 / 3), bold);
    if (wanted * (2.0 / 3) <= width) {
        sl_text_show(cairo, colour, x, y, text);
        return;
    }
    char shown[512];
    cut(cairo, text, width, shown, sizeof shown);
    sl_text_show(cairo, colour, x, y, shown);
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

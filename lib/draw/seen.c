#include "draw/seen.h"

#include "draw/marks.h"
#include "draw/text.h"

#include <stdio.h>

/// Depths that the key tells apart: more reflections come with the last.
enum { DEPTHS_MOST = 8, KEY_TEXT = 64 };

static sl_colour hue(const sl_palette *palette, uint32_t depth) {
    return depth ? palette->mirrored : palette->glass;
}

static double strength(uint32_t depth) {
    return depth ? 1.0 / depth : 1;
}

static void set_faded(cairo_t *cairo, sl_colour c, double opacity) {
    cairo_set_source_rgba(cairo, c.red, c.green, c.blue, opacity);
}

void sl_draw_seen(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                  const sl_drawn_region *region) {
    const sl_colour colour = hue(palette, region->depth);
    if (region->count < 3) return;
    sl_path_polygon(cairo, frame, region->points, region->count);
    set_faded(cairo, colour, 0.4 * strength(region->depth));
    cairo_fill_preserve(cairo);
    set_faded(cairo, colour, strength(region->depth));
    cairo_set_line_width(cairo, 1.5 * frame->unit);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(cairo);
}

/// An entry of the key: of a depth, or the last one of mirrors themselves.
static void write_entry(uint32_t depth, uint32_t deepest, char text[KEY_TEXT]) {
    static const char *const numbers[] = {"", "one mirror", "two mirrors", "three mirrors"};
    if (depth > deepest)
        snprintf(text, KEY_TEXT, "mirror");
    else if (depth == 0)
        snprintf(text, KEY_TEXT, "seen directly");
    else if (depth < sizeof numbers / sizeof *numbers)
        snprintf(text, KEY_TEXT, "seen in %s", numbers[depth]);
    else
        snprintf(text, KEY_TEXT, "in %u%s", (unsigned)depth,
                 depth == DEPTHS_MOST ? " and more" : "");
}

static void draw_swatch(cairo_t *cairo, const sl_palette *palette, uint32_t depth, uint32_t deepest,
                        double left, double top, double size) {
    const double width = 2 * size, height = 1.15 * size;
    if (depth > deepest) {
        const sl_pens pens = {.wall = 0.22 * size};
        sl_mark_mirror(cairo, palette, &pens, (sl_point){left, top + height / 2},
                       (sl_point){left + width, top + height / 2});
        return;
    }
    cairo_rectangle(cairo, left, top, width, height);
    set_faded(cairo, hue(palette, depth), 0.4 * strength(depth));
    cairo_fill_preserve(cairo);
    set_faded(cairo, hue(palette, depth), strength(depth));
    cairo_set_line_width(cairo, 0.08 * size);
    cairo_stroke(cairo);
}

double sl_draw_seen_key(cairo_t *cairo, const sl_palette *palette, const sl_drawn_region *regions,
                        size_t count, sl_point at, double width, double size, bool paint) {
    uint32_t deepest = 0, first = 1;
    for (size_t i = 0; i < count; i++) {
        const uint32_t depth = regions[i].depth;
        deepest = depth > deepest ? depth : deepest;
        first = depth < first ? depth : first;
    }
    if (!deepest) return 0;
    if (deepest > DEPTHS_MOST) deepest = DEPTHS_MOST;
    double x = at.x, y = at.y;
    for (uint32_t depth = first; depth <= deepest + 1; depth++) {
        char text[KEY_TEXT];
        write_entry(depth, deepest, text);
        sl_text_font(cairo, size, false);
        const double wide = 2.55 * size + sl_text_width(cairo, text);
        if (x > at.x && x + wide > at.x + width) {
            x = at.x;
            y += 1.95 * size;
        }
        if (paint) {
            draw_swatch(cairo, palette, depth, deepest, x, y + 0.22 * size, size);
            sl_text_font(cairo, size, false);
            sl_text_show(cairo, palette->ink, x + 2.55 * size, y + 1.16 * size, text);
        }
        x += wide + 1.9 * size;
    }
    return y + 1.95 * size - at.y;
}

#include "draw/boxes.h"

#include "draw/marks.h"
#include "draw/text.h"

/// Gives the path the looks of a box.
static void ink(cairo_t *cairo, const sl_palette *palette, bool blocks, bool seen, double width) {
    const sl_colour c = blocks ? palette->wall : palette->object;
    const double dashes[2] = {2.5 * width, 2 * width};
    sl_set_colour(cairo, palette->page);
    cairo_fill_preserve(cairo);
    cairo_set_source_rgba(cairo, c.red, c.green, c.blue, blocks ? 0.6 : 0.25);
    cairo_fill_preserve(cairo);
    cairo_set_source_rgba(cairo, c.red, c.green, c.blue, 1);
    cairo_set_line_width(cairo, width);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_MITER);
    if (!seen) cairo_set_dash(cairo, dashes, 2, 0);
    cairo_stroke(cairo);
    cairo_set_dash(cairo, NULL, 0, 0);
}

static void set_light(cairo_t *cairo, const sl_palette *palette, double opacity) {
    const sl_colour c = palette->page;
    cairo_set_source_rgba(cairo, c.red, c.green, c.blue, opacity);
}

void sl_draw_lit(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                 const sl_drawn_region *region) {
    if (region->count < 3) return;
    sl_path_polygon(cairo, frame, region->points, region->count);
    set_light(cairo, palette, 0.6);
    cairo_fill(cairo);
}

void sl_draw_boxes(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                   const sl_drawn_box *boxes, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const sl_box b = boxes[i].box;
        const sl_point corners[4] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}};
        sl_path_polygon(cairo, frame, corners, 4);
        ink(cairo, palette, boxes[i].blocks, boxes[i].seen, 2 * frame->unit);
    }
}

double sl_draw_boxes_key(cairo_t *cairo, const sl_palette *palette, size_t count, sl_point at,
                         double size, bool paint) {
    static const struct {
        const char *text;
        bool blocks, seen;
    } entries[] = {{"object, seen", false, true},
                   {"hidden", false, false},
                   {"blocks sight", true, true},
                   {"blocks sight, hidden", true, false}};
    if (!count) return 0;
    const double top = at.y + 0.22 * size;
    double x = at.x;
    for (size_t i = 0; i < sizeof entries / sizeof *entries && paint; i++) {
        cairo_rectangle(cairo, x, top, 2 * size, 1.15 * size);
        ink(cairo, palette, entries[i].blocks, entries[i].seen, 0.12 * size);
        sl_text_font(cairo, size, false);
        sl_text_show(cairo, palette->ink, x + 2.55 * size, at.y + 1.16 * size, entries[i].text);
        x += 4.45 * size + sl_text_width(cairo, entries[i].text);
    }
    return 1.95 * size;
}

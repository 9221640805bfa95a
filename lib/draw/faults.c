#include "draw/faults.h"

#include <math.h>

/// Of Okabe & Ito, as the palette's, a kind each.
static sl_colour colour_of(sl_fault_kind kind) {
    static const unsigned hues[SL_FAULT_KINDS] = {
        [SL_FAULT_LEAK] = 0xd55e00,    [SL_FAULT_GAP] = 0x0072b2,
        [SL_FAULT_OVERLAP] = 0xcc79a7, [SL_FAULT_CROSSING] = 0x56b4e9,
        [SL_FAULT_THIN] = 0x009e73,    [SL_FAULT_UNREACHABLE] = 0xe69f00,
    };
    const unsigned hue = hues[kind];
    return (sl_colour){(hue >> 16 & 255) / 255.0, (hue >> 8 & 255) / 255.0, (hue & 255) / 255.0};
}

/// On a pale rim, so that it stands out from what is below.
static void stroke(cairo_t *cairo, const sl_palette *palette, sl_fault_kind kind, double width) {
    const sl_colour rim = palette->page;
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_set_source_rgba(cairo, rim.red, rim.green, rim.blue, 0.8);
    cairo_set_line_width(cairo, 2 * width);
    cairo_stroke_preserve(cairo);
    sl_set_colour(cairo, colour_of(kind));
    cairo_set_line_width(cairo, width);
    cairo_stroke(cairo);
}

static void add_line(cairo_t *cairo, sl_point a, sl_point b) {
    cairo_move_to(cairo, a.x, a.y);
    cairo_line_to(cairo, b.x, b.y);
}

static void add_ring(cairo_t *cairo, sl_point at, double radius) {
    cairo_new_sub_path(cairo);
    cairo_arc(cairo, at.x, at.y, radius, 0, 6.283185307179586);
}

/// A square, or one on its corner.
static void add_square(cairo_t *cairo, sl_point at, double radius, bool turned) {
    const double flat = turned ? 0 : radius;
    cairo_move_to(cairo, at.x - radius, at.y - flat);
    cairo_line_to(cairo, at.x + flat, at.y - radius);
    cairo_line_to(cairo, at.x + radius, at.y + flat);
    cairo_line_to(cairo, at.x - flat, at.y + radius);
    cairo_close_path(cairo);
}

void sl_mark_fault(cairo_t *cairo, const sl_palette *palette, const sl_pens *pens,
                   sl_fault_kind kind, sl_point a, sl_point b) {
    const double size = 0.6 * pens->mark, half = hypot(b.x - a.x, b.y - a.y) / 2;
    const sl_point middle = {(a.x + b.x) / 2, (a.y + b.y) / 2};
    switch (kind) {
    case SL_FAULT_LEAK:
        add_line(cairo, a, b);
        add_ring(cairo, middle, fmax(size, half + 0.3 * size));
        break;
    case SL_FAULT_GAP:
        add_line(cairo, a, b);
        add_ring(cairo, middle, fmax(size, half));
        break;
    case SL_FAULT_CROSSING:
        add_line(cairo, (sl_point){middle.x - size / 2, middle.y - size / 2},
                 (sl_point){middle.x + size / 2, middle.y + size / 2});
        add_line(cairo, (sl_point){middle.x - size / 2, middle.y + size / 2},
                 (sl_point){middle.x + size / 2, middle.y - size / 2});
        break;
    case SL_FAULT_THIN:
        add_square(cairo, middle, 0.8 * size, true);
        break;
    case SL_FAULT_UNREACHABLE:
        add_square(cairo, middle, 0.8 * size, false);
        break;
    default:
        add_line(cairo, a, b);
    }
    stroke(cairo, palette, kind, kind == SL_FAULT_OVERLAP ? 0.4 * size : 0.2 * size);
}

static void draw_way(cairo_t *cairo, const sl_palette *palette, const sl_pens *pens,
                     const sl_frame *frame, const sl_point *points, uint32_t count) {
    for (uint32_t i = 1; i < count; i++) sl_path_segment(cairo, frame, points[i - 1], points[i]);
    stroke(cairo, palette, SL_FAULT_LEAK, 0.22 * pens->mark);
}

void sl_draw_faults(cairo_t *cairo, const sl_palette *palette, const sl_pens *pens,
                    const sl_frame *frame, const sl_faults *faults) {
    // The gravest first of all in the list, and so last of all on the page.
    for (uint32_t i = faults->count; i-- > 0;) {
        const sl_fault *fault = &faults->items[i];
        sl_point a, b;
        if (fault->kind == SL_FAULT_LEAK)
            draw_way(cairo, palette, pens, frame, faults->points + fault->first_point,
                     fault->point_count);
        if (sl_frame_holds(frame, fault->at.a, &a) && sl_frame_holds(frame, fault->at.b, &b))
            sl_mark_fault(cairo, palette, pens, fault->kind, a, b);
    }
}

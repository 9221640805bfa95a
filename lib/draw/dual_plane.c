#include "draw/dual_plane.h"

#include "draw/marks.h"

#include <math.h>

sl_dual_frame sl_dual_frame_fit(const sl_dual *before, double left, double top, double width,
                                double height, double unit) {
    sl_dual_line low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (uint32_t i = 0; i < before->corner_count; i++) {
        low.slope = fmin(low.slope, before->corners[i].slope);
        low.height = fmin(low.height, before->corners[i].height);
        high.slope = fmax(high.slope, before->corners[i].slope);
        high.height = fmax(high.height, before->corners[i].height);
    }
    if (!before->corner_count) {
        low = (sl_dual_line){-1, -1};
        high = (sl_dual_line){1, 1};
    }
    // Steep lines would make all others small.
    low.slope = fmax(low.slope, fmin(-2.5, high.slope - 0.5));
    high.slope = fmin(high.slope, fmax(2.5, low.slope + 0.5));
    low.height = fmax(low.height, fmin(-2.5, high.height - 0.5));
    high.height = fmin(high.height, fmax(2.5, low.height + 0.5));
    const double wide = 0.35 * fmax(high.slope - low.slope, 1e-6);
    const double tall = 0.35 * fmax(high.height - low.height, 1e-6);
    return (sl_dual_frame){.left = left,
                           .top = top,
                           .width = width,
                           .height = height,
                           .unit = unit,
                           .low = {low.slope - wide, low.height - tall},
                           .high = {high.slope + wide, high.height + tall}};
}

static sl_point frame_point(const sl_dual_frame *f, sl_dual_line line) {
    const double x = (line.slope - f->low.slope) / (f->high.slope - f->low.slope);
    const double y = (line.height - f->low.height) / (f->high.height - f->low.height);
    return (sl_point){fmin(fmax(f->left + x * f->width, -1e5), 1e5),
                      fmin(fmax(f->top + (1 - y) * f->height, -1e5), 1e5)};
}

sl_dual_line sl_dual_frame_line(const sl_dual_frame *f, sl_point page) {
    const double x = (page.x - f->left) / f->width, y = 1 - (page.y - f->top) / f->height;
    return (sl_dual_line){f->low.slope + x * (f->high.slope - f->low.slope),
                          f->low.height + y * (f->high.height - f->low.height)};
}

/// The border of an end's half-plane, from one side of the frame to the other.
static void add_border(cairo_t *cairo, const sl_dual_frame *f, sl_point end) {
    const double a = f->low.slope, b = f->high.slope;
    const sl_point from = frame_point(f, (sl_dual_line){a, end.y - a * end.x});
    const sl_point to = frame_point(f, (sl_dual_line){b, end.y - b * end.x});
    cairo_move_to(cairo, from.x, from.y);
    cairo_line_to(cairo, to.x, to.y);
}

/// Short strokes on the side that an end forbids.
static void add_teeth(cairo_t *cairo, const sl_dual_frame *f, sl_point end, bool left) {
    for (int i = 1; i < 14; i++) {
        const double a = f->low.slope + (f->high.slope - f->low.slope) * i / 14;
        const sl_point at = frame_point(f, (sl_dual_line){a, end.y - a * end.x});
        cairo_move_to(cairo, at.x, at.y);
        cairo_line_to(cairo, at.x + 3 * f->unit, at.y + (left ? -6 : 6) * f->unit);
    }
}

static void draw_borders(cairo_t *cairo, const sl_palette *palette, const sl_dual_frame *f,
                         const sl_dual *dual, const sl_portal_ends *portals, uint32_t count) {
    for (int side = 0; side < 2; side++) {
        const bool left = side == 0;
        const sl_colour colour = left ? palette->glass : palette->start;
        for (uint32_t i = 0; i < count; i++) {
            const sl_point end = sl_dual_point(dual, left ? portals[i].left : portals[i].right);
            const bool last = i + 1 == count;
            add_border(cairo, f, end);
            cairo_set_source_rgba(cairo, colour.red, colour.green, colour.blue, last ? 1 : 0.55);
            cairo_set_line_width(cairo, (last ? 2.2 : 1.1) * f->unit);
            cairo_stroke(cairo);
            if (!last) continue;
            add_teeth(cairo, f, end, left);
            cairo_set_line_width(cairo, 1.1 * f->unit);
            cairo_stroke(cairo);
        }
    }
}

static void draw_polygon(cairo_t *cairo, const sl_palette *palette, const sl_dual_frame *f,
                         const sl_dual *dual) {
    if (!dual->corner_count) return;
    cairo_new_path(cairo);
    for (uint32_t i = 0; i < dual->corner_count; i++) {
        const sl_point at = frame_point(f, dual->corners[i]);
        cairo_line_to(cairo, at.x, at.y);
    }
    cairo_close_path(cairo);
    const sl_colour c = palette->portal;
    cairo_set_source_rgba(cairo, c.red, c.green, c.blue, 0.3);
    cairo_fill_preserve(cairo);
    sl_set_colour(cairo, c);
    cairo_set_line_width(cairo, 1.6 * f->unit);
    cairo_stroke(cairo);
}

/// The optimum's margin: a bar as high as the line can move up and down.
static void draw_best(cairo_t *cairo, const sl_palette *palette, const sl_dual_frame *f,
                      const sl_dual *dual) {
    const double m = fmax(dual->margin, 0);
    const sl_point at = frame_point(f, dual->best);
    const sl_point over = frame_point(f, (sl_dual_line){dual->best.slope, dual->best.height + m});
    const sl_point under = frame_point(f, (sl_dual_line){dual->best.slope, dual->best.height - m});
    sl_set_colour(cairo, palette->ink);
    cairo_set_line_width(cairo, 1.2 * f->unit);
    cairo_move_to(cairo, over.x, over.y);
    cairo_line_to(cairo, under.x, under.y);
    cairo_move_to(cairo, at.x - 5 * f->unit, at.y);
    cairo_line_to(cairo, at.x + 5 * f->unit, at.y);
    cairo_stroke(cairo);
}

void sl_draw_dual(cairo_t *cairo, const sl_palette *palette, const sl_dual_frame *f,
                  const sl_dual *dual, const sl_portal_ends *portals, uint32_t count,
                  sl_dual_line chosen) {
    cairo_save(cairo);
    cairo_rectangle(cairo, f->left, f->top, f->width, f->height);
    cairo_clip(cairo);
    sl_set_colour(cairo, palette->floor[0]);
    cairo_paint(cairo);
    draw_polygon(cairo, palette, f, dual);
    draw_borders(cairo, palette, f, dual, portals, count);
    draw_best(cairo, palette, f, dual);
    const sl_point at = frame_point(f, chosen);
    cairo_arc(cairo, at.x, at.y, 5.5 * f->unit, 0, 6.283185307179586);
    sl_set_colour(cairo, palette->page);
    cairo_set_line_width(cairo, 3 * f->unit);
    cairo_stroke_preserve(cairo);
    sl_set_colour(cairo, palette->ink);
    cairo_fill(cairo);
    cairo_restore(cairo);
}

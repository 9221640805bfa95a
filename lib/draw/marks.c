#include "draw/marks.h"

#include <math.h>

sl_pens sl_pens_for(const sl_scene *scene, const sl_frame *frame) {
    const double unit = frame->unit, cell = scene->cell_size * frame->scale;
    // Where cells come out tiny the lines give way, or nothing but lines would be seen.
    const double least = fmin(unit, 0.11 * cell);
    const double wall = fmin(fmax(0.048 * cell, fmax(least, 0.3 * unit)), 3.6 * unit);
    return (sl_pens){
        .wall = wall,
        .portal = fmin(fmax(0.45 * wall, 0.6 * least), 1.4 * unit),
        .outline = fmin(0.25 * wall, 1.0 * unit),
        .tree = fmin(fmax(0.08 * cell, 1.3 * unit), 4.5 * unit),
        .mark = fmin(fmax(0.35 * cell, 9 * unit), 15 * unit),
    };
}

void sl_set_colour(cairo_t *cairo, sl_colour colour) {
    cairo_set_source_rgb(cairo, colour.red, colour.green, colour.blue);
}

static void stroke(cairo_t *cairo, sl_colour colour, double width, cairo_line_cap_t cap) {
    sl_set_colour(cairo, colour);
    cairo_set_line_width(cairo, width);
    cairo_set_line_cap(cairo, cap);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(cairo);
}

static void stroke_dashed(cairo_t *cairo, sl_colour colour, double width, double on, double off,
                          cairo_line_cap_t cap) {
    const double dashes[2] = {on, off};
    cairo_set_dash(cairo, dashes, 2, 0);
    stroke(cairo, colour, width, cap);
    cairo_set_dash(cairo, NULL, 0, 0);
}

void sl_pen_wall(cairo_t *cairo, const sl_palette *palette, const sl_pens *pens) {
    stroke(cairo, palette->wall, pens->wall, CAIRO_LINE_CAP_ROUND);
}

void sl_pen_portal(cairo_t *cairo, const sl_palette *palette, const sl_pens *pens) {
    const double width = pens->portal;
    stroke_dashed(cairo, palette->portal, width, 3.2 * width, 2.6 * width, CAIRO_LINE_CAP_BUTT);
}

void sl_pen_outline(cairo_t *cairo, const sl_palette *palette, const sl_pens *pens) {
    stroke(cairo, palette->outline, pens->outline, CAIRO_LINE_CAP_BUTT);
}

void sl_pen_source_edge(cairo_t *cairo, const sl_palette *palette, const sl_pens *pens) {
    stroke(cairo, palette->source_edge, pens->wall * 0.8, CAIRO_LINE_CAP_BUTT);
}

void sl_pen_path(cairo_t *cairo, const sl_palette *palette, const sl_pens *pens) {
    const double width = pens->mark * 0.24;
    cairo_path_t *path = cairo_copy_path(cairo);
    const sl_colour rim = palette->page;
    cairo_set_source_rgba(cairo, rim.red, rim.green, rim.blue, 0.75);
    cairo_set_line_width(cairo, 1.7 * width);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    cairo_stroke(cairo);
    cairo_append_path(cairo, path);
    cairo_path_destroy(path);
    stroke_dashed(cairo, palette->path, width, 0, 1.9 * width, CAIRO_LINE_CAP_ROUND);
}

void sl_pen_object(cairo_t *cairo, const sl_palette *palette, const sl_pens *pens) {
    const sl_colour c = palette->object;
    cairo_set_source_rgba(cairo, c.red, c.green, c.blue, 0.25);
    cairo_fill_preserve(cairo);
    stroke(cairo, c, pens->portal, CAIRO_LINE_CAP_BUTT);
}

static void set_tree_colour(cairo_t *cairo, sl_colour c, uint32_t depth) {
    cairo_set_source_rgba(cairo, c.red, c.green, c.blue, 0.15 + 0.8 * pow(0.84, depth));
}

double sl_tree_width(const sl_pens *pens, uint32_t depth) {
    return pens->tree * (0.3 + 0.7 * pow(0.84, depth));
}

void sl_pen_tree_dots(cairo_t *cairo, sl_colour colour, uint32_t depth) {
    set_tree_colour(cairo, colour, depth);
    cairo_fill(cairo);
}

void sl_pen_tree(cairo_t *cairo, sl_colour colour, const sl_pens *pens, uint32_t depth) {
    set_tree_colour(cairo, colour, depth);
    cairo_set_line_width(cairo, sl_tree_width(pens, depth));
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(cairo);
}

void sl_mark_hatch(cairo_t *cairo, const sl_palette *palette, sl_box box, double spacing,
                   double phase) {
    // The lines x + y = phase + k * spacing.
    const double first = box.min.x + box.min.y, last = box.max.x + box.max.y;
    for (double sum = first + spacing - fmod(first - phase, spacing); sum < last; sum += spacing) {
        const double from = fmax(box.min.x, sum - box.max.y);
        const double to = fmin(box.max.x, sum - box.min.y);
        cairo_move_to(cairo, from, sum - from);
        cairo_line_to(cairo, to, sum - to);
    }
    stroke(cairo, palette->hatch, spacing * 0.14, CAIRO_LINE_CAP_BUTT);
}

void sl_mark_start(cairo_t *cairo, const sl_palette *palette, sl_point at, double heading,
                   double size) {
    cairo_save(cairo);
    cairo_translate(cairo, at.x, at.y);
    cairo_rotate(cairo, -fmod(heading, 360) * (3.14159265358979323846 / 180));
    cairo_move_to(cairo, 1.05 * size, 0);
    cairo_line_to(cairo, -0.75 * size, 0.68 * size);
    cairo_line_to(cairo, -0.35 * size, 0);
    cairo_line_to(cairo, -0.75 * size, -0.68 * size);
    cairo_close_path(cairo);
    cairo_restore(cairo);
    // A rim in the paper's colour sets it off from whatever is below.
    sl_set_colour(cairo, palette->page);
    cairo_set_line_width(cairo, 0.42 * size);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke_preserve(cairo);
    sl_set_colour(cairo, palette->start);
    cairo_fill(cairo);
}

void sl_mark_door(cairo_t *cairo, const sl_palette *palette, const sl_pens *pens, sl_point a,
                  sl_point b, bool open) {
    cairo_move_to(cairo, a.x, a.y);
    cairo_line_to(cairo, b.x, b.y);
    stroke(cairo, palette->door, 1.5 * pens->wall, CAIRO_LINE_CAP_BUTT);
    if (!open) return;
    cairo_move_to(cairo, a.x, a.y);
    cairo_line_to(cairo, b.x, b.y);
    stroke(cairo, palette->page, 0.7 * pens->wall, CAIRO_LINE_CAP_BUTT);
}

void sl_mark_mirror(cairo_t *cairo, const sl_palette *palette, const sl_pens *pens, sl_point a,
                    sl_point b) {
    cairo_move_to(cairo, a.x, a.y);
    cairo_line_to(cairo, b.x, b.y);
    stroke(cairo, palette->wall, 1.5 * pens->wall, CAIRO_LINE_CAP_BUTT);
    cairo_move_to(cairo, a.x, a.y);
    cairo_line_to(cairo, b.x, b.y);
    stroke(cairo, palette->seen[0], 0.8 * pens->wall, CAIRO_LINE_CAP_BUTT);
}

void sl_mark_oneway(cairo_t *cairo, const sl_palette *palette, const sl_pens *pens, sl_point a,
                    sl_point b) {
    const double dx = b.x - a.x, dy = b.y - a.y, length = hypot(dx, dy);
    cairo_move_to(cairo, a.x, a.y);
    cairo_line_to(cairo, b.x, b.y);
    if (length > 0) {
        // On the page y runs down, so that the left of (dx, dy) is (dy, -dx).
        const double size = pens->mark * 0.8, ux = dx / length, uy = dy / length;
        const sl_point foot = {(a.x + b.x) / 2, (a.y + b.y) / 2};
        const sl_point tip = {foot.x + uy * size, foot.y - ux * size};
        cairo_move_to(cairo, foot.x, foot.y);
        cairo_line_to(cairo, tip.x, tip.y);
        cairo_move_to(cairo, tip.x - (uy + ux) * size * 0.35, tip.y + (ux - uy) * size * 0.35);
        cairo_line_to(cairo, tip.x, tip.y);
        cairo_line_to(cairo, tip.x - (uy - ux) * size * 0.35, tip.y + (ux + uy) * size * 0.35);
    }
    stroke(cairo, palette->glass, 0.7 * pens->wall, CAIRO_LINE_CAP_BUTT);
}

#include "draw/sight.h"

#include "draw/marks.h"
#include "sightline/support.h"

#include <math.h>

#define FULL_TURN 6.283185307179586

static void set_faded(cairo_t *cairo, sl_colour c, double opacity) {
    cairo_set_source_rgba(cairo, c.red, c.green, c.blue, opacity);
}

static void add_cell(cairo_t *cairo, const sl_space *space, const sl_frame *frame, uint32_t cell) {
    const sl_cell *c = &space->cells[cell];
    sl_path_polygon(cairo, frame, space->vertices + c->first_vertex, c->vertex_count);
}

void sl_draw_cell_set(cairo_t *cairo, const sl_space *space, const sl_frame *frame,
                      const uint64_t *cells, const uint64_t *without, sl_colour colour,
                      double opacity) {
    for (size_t w = 0; w < sl_bits_words(space->cell_count); w++) {
        const uint64_t word = cells[w] & ~(without ? without[w] : 0);
        for (uint32_t i = 0; i < 64 && word >> i; i++)
            if (word >> i & 1) add_cell(cairo, space, frame, (uint32_t)(64 * w + i));
    }
    set_faded(cairo, colour, opacity);
    cairo_fill(cairo);
}

void sl_draw_cell(cairo_t *cairo, const sl_space *space, const sl_frame *frame, uint32_t cell,
                  sl_colour colour, double opacity, double width) {
    add_cell(cairo, space, frame, cell);
    if (opacity > 0) {
        set_faded(cairo, colour, opacity);
        cairo_fill_preserve(cairo);
    }
    sl_set_colour(cairo, colour);
    cairo_set_line_width(cairo, width);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_MITER);
    cairo_stroke(cairo);
}

void sl_draw_region(cairo_t *cairo, const sl_frame *frame, const sl_region *region,
                    sl_colour colour) {
    if (region->count < 3) return;
    sl_path_polygon(cairo, frame, region->points, region->count);
    set_faded(cairo, colour, 0.6);
    cairo_fill_preserve(cairo);
    set_faded(cairo, colour, 0.9);
    cairo_set_line_width(cairo, 1.3 * frame->unit);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(cairo);
}

void sl_draw_cone(cairo_t *cairo, const sl_frame *frame, sl_point eye, double heading, double fov,
                  double reach, sl_colour colour) {
    sl_point at;
    if (!sl_frame_holds(frame, eye, &at)) return;
    cairo_new_path(cairo);
    if (fov < 360) {
        const double from = (heading - fov / 2) * (FULL_TURN / 360);
        const double to = (heading + fov / 2) * (FULL_TURN / 360);
        cairo_move_to(cairo, at.x, at.y);
        cairo_arc_negative(cairo, at.x, at.y, reach, -from, -to); // on the page y runs down
        cairo_close_path(cairo);
    } else {
        cairo_arc(cairo, at.x, at.y, reach, 0, FULL_TURN);
    }
    set_faded(cairo, colour, 0.10);
    cairo_fill_preserve(cairo);
    set_faded(cairo, colour, 0.7);
    cairo_set_line_width(cairo, 1.4 * frame->unit);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(cairo);
}

void sl_draw_eye_mark(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                      sl_point eye, double heading, double radius) {
    sl_point at;
    if (!sl_frame_holds(frame, eye, &at)) return;
    cairo_new_path(cairo);
    sl_mark_start(cairo, palette, at, heading, 2.2 * radius);
    cairo_new_path(cairo);
    cairo_arc(cairo, at.x, at.y, 0.55 * radius, 0, FULL_TURN);
    sl_set_colour(cairo, palette->page);
    cairo_fill(cairo);
}

void sl_draw_line(cairo_t *cairo, const sl_frame *frame, sl_point a, sl_point b, sl_colour colour,
                  double width) {
    sl_path_segment(cairo, frame, a, b);
    sl_set_colour(cairo, colour);
    cairo_set_line_width(cairo, width);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    cairo_stroke(cairo);
}

static void add_end(cairo_t *cairo, sl_point at, bool left, double radius) {
    cairo_new_sub_path(cairo);
    if (left)
        cairo_arc(cairo, at.x, at.y, radius, 0, FULL_TURN);
    else
        cairo_rectangle(cairo, at.x - 0.88 * radius, at.y - 0.88 * radius, 1.76 * radius,
                        1.76 * radius);
}

void sl_draw_portal_ends(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                         const sl_portal_ends *portals, uint32_t count, bool last_stops) {
    const double radius = 4.2 * frame->unit;
    for (uint32_t i = 0; i < count; i++) {
        const bool stops = last_stops && i + 1 == count;
        sl_draw_line(cairo, frame, portals[i].left, portals[i].right,
                     stops ? palette->start : palette->portal, 3.4 * frame->unit);
    }
    for (uint32_t i = 0; i < 2 * count; i++) {
        const bool left = i % 2 == 0;
        sl_point at;
        if (!sl_frame_holds(frame, left ? portals[i / 2].left : portals[i / 2].right, &at))
            continue;
        add_end(cairo, at, left, radius);
        sl_set_colour(cairo, palette->page);
        cairo_set_line_width(cairo, 0.7 * radius);
        cairo_stroke_preserve(cairo);
        sl_set_colour(cairo, left ? palette->glass : palette->start);
        cairo_fill(cairo);
    }
}

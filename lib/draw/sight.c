/// What is seen, over the plan: sets of cells, regions, eyes with their cones, portal sequences.
/// The key says in how many mirrors a region is seen.
#include "draw/marks.h"
#include "draw/page.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>

// --- cells, eyes, portals

void sl_draw_cell(cairo_t *cairo, const sl_space *space, const sl_frame *frame, uint32_t cell,
                  sl_colour colour, double opacity, double width) {
    const sl_cell *c = &space->cells[cell];
    sl_path_polygon(cairo, frame, space->vertices + c->first_vertex, c->vertex_count);
    if (opacity > 0) {
        sli_set_faded(cairo, colour, opacity);
        cairo_fill_preserve(cairo);
    }
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_MITER);
    sli_pen_stroke(cairo, colour, width);
}

void sl_draw_cone(cairo_t *cairo, const sl_frame *frame, sl_point eye, double heading, double fov,
                  double reach, sl_colour colour) {
    sl_point at;
    if (!sl_frame_holds(frame, eye, &at)) return;
    cairo_new_path(cairo);
    if (fov < 360) {
        const double from = (heading - fov / 2) * (SLI_FULL_TURN / 360);
        const double to = (heading + fov / 2) * (SLI_FULL_TURN / 360);
        cairo_move_to(cairo, at.x, at.y);
        cairo_arc_negative(cairo, at.x, at.y, reach, -from, -to); // on the page y runs down
        cairo_close_path(cairo);
    } else {
        cairo_arc(cairo, at.x, at.y, reach, 0, SLI_FULL_TURN);
    }
    sli_set_faded(cairo, colour, 0.10);
    cairo_fill_preserve(cairo);
    sli_set_faded(cairo, colour, 0.7);
    cairo_set_line_width(cairo, 1.4 * frame->unit);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(cairo);
}

void sl_draw_eye_mark(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                      sl_point eye, double heading, double radius) {
    sl_point at;
    if (!sl_frame_holds(frame, eye, &at)) return;
    cairo_new_path(cairo);
    sli_mark_start(cairo, palette, at, heading, 2.2 * radius);
    cairo_new_path(cairo);
    cairo_arc(cairo, at.x, at.y, 0.55 * radius, 0, SLI_FULL_TURN);
    sl_set_colour(cairo, palette->page);
    cairo_fill(cairo);
}

void sl_draw_line(cairo_t *cairo, const sl_frame *frame, sl_point a, sl_point b, sl_colour colour,
                  double width) {
    sl_path_segment(cairo, frame, a, b);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    sli_pen_stroke(cairo, colour, width);
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
        sli_path_portal_end(cairo, at, left, radius);
        sl_set_colour(cairo, palette->page);
        cairo_set_line_width(cairo, 0.7 * radius);
        cairo_stroke_preserve(cairo);
        sl_set_colour(cairo, left ? palette->glass : palette->start);
        cairo_fill(cairo);
    }
}

void sl_draw_ring(cairo_t *cairo, const sl_frame *frame, sl_point at, double radius,
                  sl_colour colour, double width) {
    sl_point place;
    if (!sl_frame_holds(frame, at, &place)) return;
    cairo_new_path(cairo);
    cairo_arc(cairo, place.x, place.y, radius, 0, SLI_FULL_TURN);
    sli_pen_stroke(cairo, colour, width);
}

/// Fills and strokes what lies between the ends of one side: a triangle, a segment or a point.
static void draw_between(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                         const sl_portal_ends *portals, const sl_conflict *conflict, bool left) {
    const sl_colour colour = left ? palette->glass : palette->start;
    sl_point places[SL_CONFLICT_MOST];
    uint32_t count = 0;
    for (uint32_t i = 0; i < conflict->end_count; i++) {
        const sl_portal_ends *at = &portals[conflict->ends[i].portal];
        if (conflict->ends[i].left == left) places[count++] = left ? at->left : at->right;
    }
    if (count == 3) {
        sl_path_polygon(cairo, frame, places, count);
        sli_set_faded(cairo, colour, 0.22);
        cairo_fill(cairo);
    }
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < i; k++) sl_path_segment(cairo, frame, places[k], places[i]);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    sl_set_colour(cairo, palette->page);
    cairo_set_line_width(cairo, 4.4 * frame->unit);
    cairo_stroke_preserve(cairo);
    sli_pen_stroke(cairo, colour, 2.4 * frame->unit);
}

/// An arrow through a portal's middle, the way that it is crossed.
static void draw_crossing(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                          const sl_portal_ends *portal) {
    const sl_point left = sl_frame_point(frame, portal->left);
    const sl_point right = sl_frame_point(frame, portal->right);
    const double wide = hypot(left.x - right.x, left.y - right.y), reach = 16 * frame->unit;
    if (!(wide > 0) || !sl_frame_holds(frame, portal->left, NULL)) return;
    const sl_point at = {(left.x + right.x) / 2, (left.y + right.y) / 2};
    // On the page y runs down: forwards is from left to right, turned counter-clockwise as seen.
    const double ux = (right.y - left.y) / wide * reach, uy = (left.x - right.x) / wide * reach;
    const sl_point tip = {at.x + ux, at.y + uy};
    cairo_move_to(cairo, at.x - ux, at.y - uy);
    cairo_line_to(cairo, tip.x, tip.y);
    cairo_move_to(cairo, tip.x - 0.4 * ux - 0.3 * uy, tip.y - 0.4 * uy + 0.3 * ux);
    cairo_line_to(cairo, tip.x, tip.y);
    cairo_line_to(cairo, tip.x - 0.4 * ux + 0.3 * uy, tip.y - 0.4 * uy - 0.3 * ux);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    sl_set_colour(cairo, palette->page);
    cairo_set_line_width(cairo, 5 * frame->unit);
    cairo_stroke_preserve(cairo);
    sli_pen_stroke(cairo, palette->ink, 2.4 * frame->unit);
}

static double within(double value, double low, double high) {
    return fmin(fmax(value, low), fmax(low, high));
}

/// Writes names beyond the ends of their portals: "L3" for the left end of portal 3.
static void draw_end_names(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                           const sl_portal_ends *portals, const sl_conflict *conflict) {
    const double size = 12 * frame->unit, away = 1.3 * size;
    sl_text_font(cairo, size, true);
    for (uint32_t i = 0; i < conflict->end_count; i++) {
        const sl_stab_end end = conflict->ends[i];
        const sl_portal_ends *at = &portals[end.portal];
        const sl_point from = sl_frame_point(frame, end.left ? at->right : at->left);
        sl_point to;
        if (!sl_frame_holds(frame, end.left ? at->left : at->right, &to)) continue;
        const double dx = to.x - from.x, dy = to.y - from.y, length = fmax(hypot(dx, dy), 1e-9);
        char text[16];
        snprintf(text, sizeof text, "%c%u", end.left ? 'L' : 'R', end.portal + 1);
        const double wide = sl_text_width(cairo, text);
        const double x = within(to.x + dx / length * away - wide / 2, frame->left + 0.3 * size,
                                frame->left + frame->width - wide - 0.3 * size);
        const double y = within(to.y + dy / length * away + 0.36 * size, frame->top + size,
                                frame->top + frame->height - 0.3 * size);
        cairo_move_to(cairo, x, y);
        cairo_text_path(cairo, text);
        sli_set_faded(cairo, palette->page, 0.85);
        cairo_set_line_width(cairo, 0.35 * size);
        cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
        cairo_stroke(cairo);
        sl_text_show(cairo, end.left ? palette->glass : palette->start, x, y, text);
    }
}

void sl_draw_conflict(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                      const sl_portal_ends *portals, const sl_conflict *conflict) {
    if (!conflict->turns) {
        draw_between(cairo, palette, frame, portals, conflict, true);
        draw_between(cairo, palette, frame, portals, conflict, false);
    }
    for (uint32_t i = 0; i < conflict->end_count; i++) {
        const sl_stab_end end = conflict->ends[i];
        const sl_portal_ends *at = &portals[end.portal];
        sl_point place;
        if (conflict->turns && end.left) draw_crossing(cairo, palette, frame, at);
        if (!sl_frame_holds(frame, end.left ? at->left : at->right, &place)) continue;
        sli_path_portal_end(cairo, place, end.left, 6.4 * frame->unit);
        sl_set_colour(cairo, palette->ink);
        cairo_set_line_width(cairo, 3.4 * frame->unit);
        cairo_stroke_preserve(cairo);
        sl_set_colour(cairo, end.left ? palette->glass : palette->start);
        cairo_fill(cairo);
    }
    draw_end_names(cairo, palette, frame, portals, conflict);
}

// --- regions by the number of mirrors

/// The key tells this many depths apart; deeper ones share the last entry.
enum { DEPTHS_MOST = 8, KEY_TEXT = 64 };

static sl_colour hue(const sl_palette *palette, uint32_t depth) {
    return depth ? palette->mirrored : palette->glass;
}

static double strength(uint32_t depth) {
    return depth ? 1.0 / depth : 1;
}

void sli_draw_seen(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                   const sl_drawn_region *region) {
    const sl_colour colour = hue(palette, region->depth);
    if (region->count < 3) return;
    sl_path_polygon(cairo, frame, region->points, region->count);
    sli_set_faded(cairo, colour, 0.4 * strength(region->depth));
    cairo_fill_preserve(cairo);
    sli_set_faded(cairo, colour, strength(region->depth));
    cairo_set_line_width(cairo, 1.5 * frame->unit);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(cairo);
}

/// An entry of the key: a depth; the last entry is the mirrors themselves.
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
        const sli_pens pens = {.wall = 0.22 * size};
        sli_mark_mirror(cairo, palette, &pens, (sl_point){left, top + height / 2},
                        (sl_point){left + width, top + height / 2});
        return;
    }
    cairo_rectangle(cairo, left, top, width, height);
    sli_set_faded(cairo, hue(palette, depth), 0.4 * strength(depth));
    cairo_fill_preserve(cairo);
    sli_set_faded(cairo, hue(palette, depth), strength(depth));
    cairo_set_line_width(cairo, 0.08 * size);
    cairo_stroke(cairo);
}

double sli_draw_seen_key(cairo_t *cairo, const sl_palette *palette, const sl_drawn_region *regions,
                         size_t count, sl_point at, double width, double size, bool paint) {
    uint32_t deepest = 0, first = 1;
    for (size_t i = 0; i < count; i++) {
        const uint32_t depth = regions[i].depth;
        deepest = depth > deepest ? depth : deepest;
        first = depth < first ? depth : first;
    }
    if (!deepest) return 0;
    if (deepest > DEPTHS_MOST) deepest = DEPTHS_MOST;
    sli_key key = sli_key_at(at, width, size);
    for (uint32_t depth = first; depth <= deepest + 1; depth++) {
        char text[KEY_TEXT];
        write_entry(depth, deepest, text);
        const sl_point entry = sli_key_entry(cairo, palette->ink, &key, text, paint);
        if (paint)
            draw_swatch(cairo, palette, depth, deepest, entry.x, entry.y + 0.22 * size, size);
    }
    return sli_key_end(&key) - at.y;
}

/// The dual plane of a portal sequence: each line of the map is a point there, each portal end a
/// half-plane, and the lines through all portals are a convex polygon.
///
/// A line y' = a x' + b is the point (a, b). An end at (x', y') allows the points on one side of
/// the line b = y' - a x': a left end those below, a right end those above. Where nothing is left,
/// a few half-planes alone have no point in common (Helly). Their borders are thick, and a frame
/// shows where they meet.
#include "draw/marks.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>

#define MINUS "\xe2\x88\x92"

// --- the frame

/// A range of slopes and heights. It starts as nothing.
typedef struct range {
    sl_dual_line low, high;
} range;

#define NO_RANGE ((range){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}})

static void include(range *r, sl_dual_line at) {
    r->low.slope = fmin(r->low.slope, at.slope);
    r->low.height = fmin(r->low.height, at.height);
    r->high.slope = fmax(r->high.slope, at.slope);
    r->high.height = fmax(r->high.height, at.height);
}

/// What a polygon takes; steep lines would make all others small.
static range range_of(const sl_dual *before) {
    range r = NO_RANGE;
    for (uint32_t i = 0; i < before->corner_count; i++) include(&r, before->corners[i]);
    if (!before->corner_count) r = (range){{-1, -1}, {1, 1}};
    r.low.slope = fmax(r.low.slope, fmin(-2.5, r.high.slope - 0.5));
    r.high.slope = fmin(r.high.slope, fmax(2.5, r.low.slope + 0.5));
    r.low.height = fmax(r.low.height, fmin(-2.5, r.high.height - 0.5));
    r.high.height = fmin(r.high.height, fmax(2.5, r.low.height + 0.5));
    return r;
}

static sl_dual_frame frame_of(range r, double left, double top, double width, double height,
                              double unit) {
    const double wide = 0.35 * fmax(r.high.slope - r.low.slope, 1e-6);
    const double tall = 0.35 * fmax(r.high.height - r.low.height, 1e-6);
    return (sl_dual_frame){.left = left,
                           .top = top,
                           .width = width,
                           .height = height,
                           .unit = unit,
                           .low = {r.low.slope - wide, r.low.height - tall},
                           .high = {r.high.slope + wide, r.high.height + tall}};
}

static sl_point end_at(const sl_dual *dual, const sl_portal_ends *portals, sl_stab_end end) {
    const sl_portal_ends *at = &portals[end.portal];
    return sl_dual_point(dual, end.left ? at->left : at->right);
}

/// The height of an end's border at a slope.
static double border(sl_point end, double slope) {
    return end.y - slope * end.x;
}

/// Where the borders of a conflict meet: at the optimum's slope each border has a point, and each
/// pair its crossing, if that is within the range.
static range conflict_range(const sl_dual *dual, const sl_portal_ends *portals,
                            const sl_conflict *conflict, range within) {
    range r = NO_RANGE;
    const double slope = dual->best.slope;
    for (uint32_t i = 0; i < conflict->end_count; i++) {
        const sl_point a = end_at(dual, portals, conflict->ends[i]);
        include(&r, (sl_dual_line){slope, border(a, slope)});
        for (uint32_t k = 0; k < i; k++) {
            const sl_point b = end_at(dual, portals, conflict->ends[k]);
            const double at = (a.y - b.y) / (a.x - b.x);
            if (a.x != b.x && at >= within.low.slope && at <= within.high.slope)
                include(&r, (sl_dual_line){at, border(a, at)});
        }
    }
    return r;
}

sl_dual_frame sl_dual_frame_fit(const sl_dual *dual, const sl_dual *before,
                                const sl_portal_ends *portals, const sl_conflict *conflict,
                                double left, double top, double width, double height, double unit) {
    range r = range_of(before);
    if (conflict->end_count) {
        const range c = conflict_range(dual, portals, conflict, r);
        include(&r, c.low);
        include(&r, c.high);
    }
    return frame_of(r, left, top, width, height, unit);
}

sl_point sl_dual_frame_point(const sl_dual_frame *f, sl_dual_line line) {
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

// --- numbers

/// A short number with the sign of print: "−0.31".
static void write_number(double value, char text[32]) {
    if (fabs(value) < 5e-4) value = 0;
    snprintf(text, 32, "%s%.3g", value < 0 ? MINUS : "", fabs(value));
}

void sli_dual_equation(const sl_dual *dual, sl_point end, bool left, char text[SLI_EQUATION_TEXT]) {
    const sl_point at = sl_dual_point(dual, end);
    char height[32], slope[32];
    write_number(at.y, height);
    write_number(fabs(at.x), slope);
    snprintf(text, SLI_EQUATION_TEXT, "b %s %s %s %s a", left ? "\xe2\x89\xa4" : "\xe2\x89\xa5",
             height, at.x < 0 ? "+" : MINUS, slope);
}

/// A step of 1, 2 or 5 times a power of ten, of which the range has up to `most`.
static double step_for(double low, double high, double most) {
    const double least = (high - low) / most, power = pow(10, floor(log10(least)));
    const double share = least / power;
    return power * (share <= 1 ? 1 : share <= 2 ? 2 : share <= 5 ? 5 : 10);
}

static void draw_axes(cairo_t *cairo, const sl_palette *palette, const sl_dual_frame *f,
                      double size) {
    const sl_colour faint = sl_colour_mix(palette->floor[0], palette->faint, 0.3);
    const double sizes[2] = {f->width, f->height};
    const double lows[2] = {f->low.slope, f->low.height},
                 highs[2] = {f->high.slope, f->high.height};
    sl_text_font(cairo, size, false);
    for (int axis = 0; axis < 2; axis++) {
        const double step =
            step_for(lows[axis], highs[axis], fmax(sizes[axis] / (axis ? 3.2 : 6) / size, 1));
        for (double k = ceil(lows[axis] / step); k * step <= highs[axis]; k++) {
            const sl_point at =
                sl_dual_frame_point(f, axis ? (sl_dual_line){f->low.slope, k * step}
                                            : (sl_dual_line){k * step, f->low.height});
            char text[32];
            write_number(k * step, text);
            cairo_move_to(cairo, at.x, at.y);
            cairo_line_to(cairo, axis ? f->left + f->width : at.x, axis ? at.y : f->top);
            sli_pen_stroke(cairo, faint, (k == 0 ? 1.6 : 0.7) * f->unit);
            // The corner belongs to neither axis.
            if (axis && at.y > f->top + f->height - 1.6 * size) continue;
            sl_text_show(cairo, palette->faint, at.x + 0.3 * size, at.y - 0.25 * size, text);
        }
    }
}

// --- half-planes

/// The border of an end's half-plane, across the frame.
static void add_border(cairo_t *cairo, const sl_dual_frame *f, sl_point end) {
    const double a = f->low.slope, b = f->high.slope;
    const sl_point from = sl_dual_frame_point(f, (sl_dual_line){a, border(end, a)});
    const sl_point to = sl_dual_frame_point(f, (sl_dual_line){b, border(end, b)});
    cairo_move_to(cairo, from.x, from.y);
    cairo_line_to(cairo, to.x, to.y);
}

/// Short strokes on the forbidden side of an end.
static void add_teeth(cairo_t *cairo, const sl_dual_frame *f, sl_point end, bool left) {
    for (int i = 1; i < 14; i++) {
        const double a = f->low.slope + (f->high.slope - f->low.slope) * i / 14;
        const sl_point at = sl_dual_frame_point(f, (sl_dual_line){a, border(end, a)});
        cairo_move_to(cairo, at.x, at.y);
        cairo_line_to(cairo, at.x + 3 * f->unit, at.y + (left ? -6 : 6) * f->unit);
    }
}

static bool is_end(const sl_stab_end *ends, uint32_t count, sl_stab_end end) {
    for (uint32_t i = 0; i < count; i++)
        if (ends[i].portal == end.portal && ends[i].left == end.left) return true;
    return false;
}

/// What the borders of a figure have in common.
typedef struct figure {
    cairo_t *cairo;
    const sl_palette *palette;
    const sl_dual_frame *frame;
    const sl_dual *dual;
    const sl_portal_ends *portals;
    uint32_t count;
    const sl_dual_marks *marks;
} figure;

static bool in_conflict(const figure *g, sl_stab_end end) {
    const sl_conflict *c = g->marks->conflict;
    return c && is_end(c->ends, c->end_count, end);
}

static void draw_border(const figure *g, sl_stab_end end) {
    const sl_colour c = end.left ? g->palette->glass : g->palette->start;
    const sl_point at = end_at(g->dual, g->portals, end);
    const double unit = g->frame->unit;
    const bool conflict = in_conflict(g, end), last = end.portal + 1 == g->count;
    const bool chosen = g->marks->end && is_end(g->marks->end, 1, end);
    const bool strong = conflict || chosen || last;
    add_border(g->cairo, g->frame, at);
    sli_set_faded(g->cairo, c, strong ? 1 : 0.45);
    cairo_set_line_width(g->cairo, (chosen ? 4.5 : conflict ? 3.4 : last ? 2.0 : 1.1) * unit);
    cairo_stroke(g->cairo);
    if (!strong) return;
    add_teeth(g->cairo, g->frame, at, end.left);
    cairo_set_line_width(g->cairo, 1.1 * unit);
    cairo_stroke(g->cairo);
}

/// A text on a plate in the colour of the ground.
static void show_on_plate(const figure *g, sl_colour colour, double x, double y, bool bold,
                          const char *text) {
    const double size = g->marks->text;
    const sl_colour ground = g->palette->floor[0];
    sl_text_font(g->cairo, size, bold);
    cairo_rectangle(g->cairo, x - 0.2 * size, y - 0.95 * size,
                    sl_text_width(g->cairo, text) + 0.4 * size, 1.2 * size);
    sli_set_faded(g->cairo, ground, 0.85);
    cairo_fill(g->cairo);
    sl_text_show(g->cairo, colour, x, y, text);
}

enum { NAMES_MOST = 64, PLACES = 20 };

/// Names that have a place.
typedef struct names {
    sl_box taken[NAMES_MOST];
    int count;
} names;

static bool is_free(const names *n, sl_box box) {
    for (int i = 0; i < n->count; i++) {
        const sl_box t = n->taken[i];
        if (box.min.x < t.max.x && t.min.x < box.max.x && box.min.y < t.max.y &&
            t.min.y < box.max.y)
            return false;
    }
    return n->count < NAMES_MOST;
}

/// Writes the name of an end at its border, as far right as there is room.
static void draw_name(const figure *g, names *n, sl_stab_end end, bool marked, bool strong) {
    const sl_dual_frame *f = g->frame;
    const double size = g->marks->text;
    const sl_point at = end_at(g->dual, g->portals, end);
    const sl_portal_ends *ends = &g->portals[end.portal];
    char text[SLI_EQUATION_TEXT + 40], equation[SLI_EQUATION_TEXT] = "";
    if (marked) sli_dual_equation(g->dual, end.left ? ends->left : ends->right, end.left, equation);
    snprintf(text, sizeof text, "%c%u%s%s", end.left ? 'L' : 'R', end.portal + 1,
             marked ? ":  " : "", equation);
    sl_text_font(g->cairo, size, strong);
    const double wide = sl_text_width(g->cairo, text);
    // Only those that matter follow their border to where it enters the frame.
    for (int place = 0; place < (strong ? PLACES : 1); place++) {
        const double slope =
            f->high.slope - (f->high.slope - f->low.slope) * place / (double)PLACES;
        const sl_point on = sl_dual_frame_point(f, (sl_dual_line){slope, border(at, slope)});
        const double x = on.x - wide - 0.5 * size, y = on.y + 0.35 * size;
        const sl_box box = {{x, y - size}, {x + wide, y + 0.15 * size}};
        if (box.min.y < f->top || box.max.y > f->top + f->height || x < f->left) continue;
        if (!is_free(n, box)) continue;
        n->taken[n->count++] = box;
        show_on_plate(g, end.left ? g->palette->glass : g->palette->start, x, y, strong, text);
        return;
    }
}

/// Names "L3" for the left end of portal 3, with the equation of the one marked. First that, then
/// those of a conflict, then all others that find room.
static void draw_names(const figure *g) {
    names n = {.count = 0};
    if (!(g->marks->text > 0)) return;
    for (int pass = 0; pass < 3; pass++)
        for (uint32_t i = 0; i < 2 * g->count; i++) {
            const sl_stab_end end = {i / 2, i % 2 == 0};
            const bool marked = g->marks->end && is_end(g->marks->end, 1, end);
            if (pass == (marked ? 0 : in_conflict(g, end) ? 1 : 2))
                draw_name(g, &n, end, marked, pass < 2);
        }
}

/// A dashed frame about the place where the borders of the conflict meet.
static void draw_conflict_frame(const figure *g) {
    const sl_conflict *c = g->marks->conflict;
    const sl_dual_frame *f = g->frame;
    const double dashes[2] = {6 * f->unit, 4 * f->unit}, room = 12 * f->unit;
    if (!c || !c->end_count || c->verdict != SL_HIDDEN) return;
    const range r = conflict_range(g->dual, g->portals, c, (range){f->low, f->high});
    const sl_point low = sl_dual_frame_point(f, r.low), high = sl_dual_frame_point(f, r.high);
    const double left = fmax(low.x - room, f->left + 2 * f->unit),
                 right = fmin(high.x + room, f->left + f->width - 2 * f->unit);
    const double top = fmax(high.y - room, f->top + 2 * f->unit),
                 bottom = fmin(low.y + room, f->top + f->height - 2 * f->unit);
    cairo_rectangle(g->cairo, left, top, right - left, bottom - top);
    sl_set_colour(g->cairo, g->palette->ink);
    cairo_set_dash(g->cairo, dashes, 2, 0);
    cairo_set_line_width(g->cairo, 1.6 * f->unit);
    cairo_stroke(g->cairo);
    cairo_set_dash(g->cairo, NULL, 0, 0);
    if (!(g->marks->text > 0)) return;
    static const char words[] = "no point in common";
    const double above = top - 0.45 * g->marks->text;
    sl_text_font(g->cairo, g->marks->text, true);
    const double most = f->left + f->width - sl_text_width(g->cairo, words) - 4 * f->unit;
    show_on_plate(g, g->palette->ink, fmin(left + 0.3 * g->marks->text, most),
                  above > f->top + g->marks->text ? above : top + 1.2 * g->marks->text, true,
                  words);
}

static void draw_polygon(cairo_t *cairo, const sl_palette *palette, const sl_dual_frame *f,
                         const sl_dual *dual) {
    if (!dual->corner_count) return;
    cairo_new_path(cairo);
    for (uint32_t i = 0; i < dual->corner_count; i++) {
        const sl_point at = sl_dual_frame_point(f, dual->corners[i]);
        cairo_line_to(cairo, at.x, at.y);
    }
    cairo_close_path(cairo);
    const sl_colour c = palette->portal;
    sli_set_faded(cairo, c, 0.3);
    cairo_fill_preserve(cairo);
    sli_pen_stroke(cairo, c, 1.6 * f->unit);
}

/// A bar at the optimum, as high as the line can move up and down.
static void draw_best(cairo_t *cairo, const sl_palette *palette, const sl_dual_frame *f,
                      const sl_dual *dual) {
    const double m = fmax(dual->margin, 0);
    const sl_point at = sl_dual_frame_point(f, dual->best);
    const sl_point over =
        sl_dual_frame_point(f, (sl_dual_line){dual->best.slope, dual->best.height + m});
    const sl_point under =
        sl_dual_frame_point(f, (sl_dual_line){dual->best.slope, dual->best.height - m});
    cairo_move_to(cairo, over.x, over.y);
    cairo_line_to(cairo, under.x, under.y);
    cairo_move_to(cairo, at.x - 5 * f->unit, at.y);
    cairo_line_to(cairo, at.x + 5 * f->unit, at.y);
    sli_pen_stroke(cairo, palette->ink, 1.2 * f->unit);
}

void sl_draw_dual(cairo_t *cairo, const sl_palette *palette, const sl_dual_frame *f,
                  const sl_dual *dual, const sl_portal_ends *portals, uint32_t count,
                  sl_dual_line chosen, const sl_dual_marks *marks) {
    const sl_dual_marks none = {0};
    const figure g = {cairo, palette, f, dual, portals, count, marks ? marks : &none};
    cairo_save(cairo);
    cairo_rectangle(cairo, f->left, f->top, f->width, f->height);
    cairo_clip(cairo);
    sl_set_colour(cairo, palette->floor[0]);
    cairo_paint(cairo);
    if (g.marks->text > 0) draw_axes(cairo, palette, f, g.marks->text);
    draw_polygon(cairo, palette, f, dual);
    for (uint32_t i = 0; i < 2 * count; i++) draw_border(&g, (sl_stab_end){i / 2, i % 2 == 0});
    draw_best(cairo, palette, f, dual);
    draw_conflict_frame(&g);
    draw_names(&g);
    const sl_point at = sl_dual_frame_point(f, chosen);
    cairo_new_path(cairo);
    cairo_arc(cairo, at.x, at.y, 5.5 * f->unit, 0, SLI_FULL_TURN);
    sl_set_colour(cairo, palette->page);
    cairo_set_line_width(cairo, 3 * f->unit);
    cairo_stroke_preserve(cairo);
    sl_set_colour(cairo, palette->ink);
    cairo_fill(cairo);
    cairo_restore(cairo);
}

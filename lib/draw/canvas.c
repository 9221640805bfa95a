/// From the map to the page: the transform, paths cut to the frame, and text.
///
/// cairo keeps coordinates as fixed-point numbers, which overflow beyond 2^23. A frame zoomed in
/// reaches that, so all paths are cut to the guard: the frame and a margin as wide as the widest
/// line. Segments are cut after Liang and Barsky (1984), polygons after Sutherland and Hodgman
/// (1974): corners stream through the four sides of the guard, with no array between them.
#include "draw/plan.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

sl_frame sl_frame_fit(sl_box bounds, double left, double top, double width, double height,
                      double unit) {
    double wide = bounds.max.x - bounds.min.x, high = bounds.max.y - bounds.min.y;
    if (!(wide > 0) && !(high > 0)) wide = high = 1;
    const double scale =
        fmin(wide > 0 ? width / wide : INFINITY, high > 0 ? height / high : INFINITY);
    const double free_x = width - wide * scale, free_y = height - high * scale;
    return (sl_frame){.corner = bounds.min,
                      .scale = scale,
                      .left = left + free_x / 2,
                      .top = top + free_y / 2,
                      .width = wide * scale,
                      .height = high * scale,
                      .unit = unit};
}

/// Far beyond any page, and small enough for cutting to keep its precision.
static double tame(double value) {
    return fmin(fmax(value, -1e12), 1e12);
}

sl_point sl_frame_point(const sl_frame *frame, sl_point point) {
    return (sl_point){
        tame(frame->left + (point.x - frame->corner.x) * frame->scale),
        tame(frame->top + frame->height - (point.y - frame->corner.y) * frame->scale),
    };
}

sl_box sli_frame_guard(const sl_frame *frame) {
    // Enough for the edge of the widest line, cut there, to stay out of sight.
    const double around = 100 * frame->unit;
    return (sl_box){{frame->left - around, frame->top - around},
                    {frame->left + frame->width + around, frame->top + frame->height + around}};
}

static bool holds(const sl_box *box, sl_point p) {
    return p.x >= box->min.x && p.x <= box->max.x && p.y >= box->min.y && p.y <= box->max.y;
}

/// Liang & Barsky's: narrows [*from, *to] to where `start + t * step` lies in [low, high].
static bool narrow(double start, double step, double low, double high, double *from, double *to) {
    if (step == 0) return start >= low && start <= high;
    const double enter = ((step > 0 ? low : high) - start) / step;
    const double leave = ((step > 0 ? high : low) - start) / step;
    *from = fmax(*from, enter);
    *to = fmin(*to, leave);
    return *from <= *to;
}

bool sli_frame_segment(const sl_frame *frame, sl_point a, sl_point b, sl_point *from,
                       sl_point *to) {
    const sl_box box = sli_frame_guard(frame);
    const sl_point p = sl_frame_point(frame, a), q = sl_frame_point(frame, b);
    const double dx = q.x - p.x, dy = q.y - p.y;
    double enter = 0, leave = 1;
    if (!narrow(p.x, dx, box.min.x, box.max.x, &enter, &leave)) return false;
    if (!narrow(p.y, dy, box.min.y, box.max.y, &enter, &leave)) return false;
    *from = enter > 0 ? (sl_point){p.x + enter * dx, p.y + enter * dy} : p;
    *to = leave < 1 ? (sl_point){p.x + leave * dx, p.y + leave * dy} : q;
    return true;
}

bool sl_frame_holds(const sl_frame *frame, sl_point point, sl_point *place) {
    const sl_box box = sli_frame_guard(frame);
    const sl_point p = sl_frame_point(frame, point);
    if (place) *place = p;
    return holds(&box, p);
}

void sl_path_segment(cairo_t *cairo, const sl_frame *frame, sl_point a, sl_point b) {
    sl_point from, to;
    if (!sli_frame_segment(frame, a, b, &from, &to)) return;
    cairo_move_to(cairo, from.x, from.y);
    cairo_line_to(cairo, to.x, to.y);
}

/// One side of the guard, as a step of Sutherland and Hodgman's clipping. Corners enter one by one.
/// What remains goes to the next side, and from the last side into the path.
typedef struct side {
    bool vertical, upper; ///< whether it bounds x, and whether from above
    double bound;
    bool begun;
    sl_point first, last;
} side;

/// How far inside the side a point lies.
static double depth(const side *s, sl_point p) {
    const double over = (s->vertical ? p.x : p.y) - s->bound;
    return s->upper ? -over : over;
}

static sl_point crossing(const side *s, sl_point p, sl_point q) {
    const double dp = depth(s, p), dq = depth(s, q), share = dp / (dp - dq);
    return (sl_point){p.x + (q.x - p.x) * share, p.y + (q.y - p.y) * share};
}

static void take(cairo_t *cairo, side *sides, int count, sl_point p) {
    if (count == 0) {
        cairo_line_to(cairo, p.x, p.y);
        return;
    }
    side *s = sides;
    if (!s->begun)
        s->first = p;
    else if ((depth(s, s->last) >= 0) != (depth(s, p) >= 0))
        take(cairo, sides + 1, count - 1, crossing(s, s->last, p));
    s->begun = true;
    s->last = p;
    if (depth(s, p) >= 0) take(cairo, sides + 1, count - 1, p);
}

static void add_cut(cairo_t *cairo, const sl_box *box, const sl_frame *frame,
                    const sl_point *corners, size_t count) {
    side sides[4] = {{.vertical = true, .bound = box->min.x},
                     {.vertical = true, .upper = true, .bound = box->max.x},
                     {.bound = box->min.y},
                     {.upper = true, .bound = box->max.y}};
    for (size_t i = 0; i < count; i++) take(cairo, sides, 4, sl_frame_point(frame, corners[i]));
    for (int i = 0; i < 4; i++) {
        side *s = &sides[i];
        if (s->begun && (depth(s, s->last) >= 0) != (depth(s, s->first) >= 0))
            take(cairo, sides + i + 1, 3 - i, crossing(s, s->last, s->first));
    }
}

void sl_path_polygon(cairo_t *cairo, const sl_frame *frame, const sl_point *corners, size_t count) {
    const sl_box box = sli_frame_guard(frame);
    bool whole = true;
    for (size_t i = 0; i < count && whole; i++)
        whole = holds(&box, sl_frame_point(frame, corners[i]));
    cairo_new_sub_path(cairo);
    if (whole) {
        for (size_t i = 0; i < count; i++) {
            const sl_point p = sl_frame_point(frame, corners[i]);
            cairo_line_to(cairo, p.x, p.y);
        }
    } else {
        add_cut(cairo, &box, frame, corners, count);
    }
    if (cairo_has_current_point(cairo)) cairo_close_path(cairo);
}

void sli_path_curve(cairo_t *cairo, const sl_frame *frame, const sl_point controls[4]) {
    const sl_box box = sli_frame_guard(frame);
    sl_point p[4];
    bool whole = true;
    for (int i = 0; i < 4; i++) {
        p[i] = sl_frame_point(frame, controls[i]);
        whole = whole && holds(&box, p[i]);
    }
    if (!whole) {
        sl_path_segment(cairo, frame, controls[0], controls[3]);
        return;
    }
    cairo_move_to(cairo, p[0].x, p[0].y);
    cairo_curve_to(cairo, p[1].x, p[1].y, p[2].x, p[2].y, p[3].x, p[3].y);
}

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

void sli_text_copy(const char *text, size_t length, char *out, size_t room) {
    if (length > room - 1) {
        length = room - 1;
        // A byte 10xxxxxx continues a character.
        while (length > 0 && ((unsigned char)text[length] & 0xc0) == 0x80) length--;
    }
    memcpy(out, text, length);
    out[length] = '\0';
}

/// The longest beginning of the text that fits with an ellipsis. It ends at a whole character.
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

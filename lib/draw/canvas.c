/// From the map to the page: the transform, and paths cut to the frame.
///
/// cairo keeps coordinates as fixed-point numbers, which overflow beyond 2^23. A frame zoomed in
/// reaches that, so all paths are cut to the guard: the frame and a margin as wide as the widest
/// line. Segments are cut after Liang and Barsky (1984), polygons after Sutherland and Hodgman
/// (1974): corners stream through the four sides of the guard, with no array between them.
#include "draw/draw_plan.h"

#include <math.h>

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

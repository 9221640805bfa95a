#include "io/pen.h"

#include "sightline/support.h"

#include <math.h>

/// So many chords of one curve and no more.
#define MOST_CHORDS 4096
/// So many walls and no more: a few nested blocks could ask for any number.
#define MOST_WALLS ((size_t)1 << 24)

static const double pi = 3.14159265358979323846;

sl_affine sl_affine_after(sl_affine outer, sl_affine inner) {
    return (sl_affine){.xx = outer.xx * inner.xx + outer.xy * inner.yx,
                       .xy = outer.xx * inner.xy + outer.xy * inner.yy,
                       .x0 = outer.xx * inner.x0 + outer.xy * inner.y0 + outer.x0,
                       .yx = outer.yx * inner.xx + outer.yy * inner.yx,
                       .yy = outer.yx * inner.xy + outer.yy * inner.yy,
                       .y0 = outer.yx * inner.x0 + outer.yy * inner.y0 + outer.y0};
}

static sl_point apply(const sl_affine *affine, sl_point point) {
    return (sl_point){affine->xx * point.x + affine->xy * point.y + affine->x0,
                      affine->yx * point.x + affine->yy * point.y + affine->y0};
}

sl_affine sl_affine_turn(double degrees) {
    double sine = sin(degrees * (pi / 180)), cosine = cos(degrees * (pi / 180));
    const double quarters = remainder(degrees / 90, 4);
    if (quarters == rint(quarters)) {
        sine = quarters == 1 ? 1 : quarters == -1 ? -1 : 0;
        cosine = quarters == 0 ? 1 : sine ? 0 : -1;
    }
    return (sl_affine){.xx = cosine, .xy = -sine, .yx = sine, .yy = cosine};
}

/// A place in the map; what is too small to be used is 0.
static bool place(const sl_pen *pen, sl_point point, sl_point *out) {
    const sl_point at = apply(&pen->affine, point);
    out->x = fabs(at.x) < SL_COORDINATE_MIN ? 0 : at.x;
    out->y = fabs(at.y) < SL_COORDINATE_MIN ? 0 : at.y;
    return sl_coordinate_usable(out->x) && sl_coordinate_usable(out->y);
}

sl_status sl_pen_line(sl_pen *pen, sl_point to) {
    sl_point a, b;
    if (!place(pen, pen->at, &a) || !place(pen, to, &b))
        return sl_fail_at(pen->context, pen->name, pen->line,
                          "a coordinate is out of range: expected a magnitude up to %g",
                          SL_COORDINATE_MAX);
    pen->at = to;
    if (a.x == b.x && a.y == b.y) {
        pen->points++;
        return SL_OK;
    }
    if (pen->walls == MOST_WALLS)
        return sl_fail_at(pen->context, pen->name, pen->line,
                          "the drawing gives more than %zu walls", MOST_WALLS);
    if (pen->walls++ % 1024 == 0) SL_TRY(sl_check_cancelled(pen->context));
    return sl_map_add_wall(pen->context, pen->map, a, b, pen->line);
}

/// How far the map makes a vector at most.
static double length_in_map(const sl_affine *affine, sl_point vector) {
    return hypot(affine->xx * vector.x + affine->xy * vector.y,
                 affine->yx * vector.x + affine->yy * vector.y);
}

/// A chord over an angle s is r (1 - cos(s / 2)) from its circle. An ellipse is a circle of its
/// greatest radius pressed together, and so are the distances; the two given radii are no less
/// than that one when added up as the legs of a right angle.
static int arc_chords(const sl_pen *pen, sl_point u, sl_point v, double sweep) {
    const double radius = hypot(length_in_map(&pen->affine, u), length_in_map(&pen->affine, v));
    double share = pen->tolerance > 0 ? pen->tolerance / radius : 0.005;
    if (!(share < 1)) share = 1;
    const double count = ceil(fabs(sweep) / (2 * acos(1 - share)));
    return count >= 1 && count <= MOST_CHORDS ? (int)count : count > MOST_CHORDS ? MOST_CHORDS : 1;
}

sl_status sl_pen_arc(sl_pen *pen, sl_point centre, sl_point u, sl_point v, double sweep,
                     sl_point to) {
    const int count = arc_chords(pen, u, v, sweep);
    // A closed curve keeps an area.
    const int least = fabs(sweep) > 1.75 * pi ? 4 : 1;
    const int chords = count > least ? count : least;
    for (int i = 1; i < chords; i++) {
        const double angle = sweep * i / chords;
        const double cosine = cos(angle), sine = sin(angle);
        SL_TRY(sl_pen_line(pen, (sl_point){centre.x + cosine * u.x + sine * v.x,
                                           centre.y + cosine * u.y + sine * v.y}));
    }
    return sl_pen_line(pen, to);
}

/// n chords of even steps are no farther from the curve than max |B''| / (8 n²); for a cubic curve
/// that second derivative is at most 6 times the larger second difference of its control points.
static int cubic_chords(const sl_pen *pen, const sl_point p[4]) {
    double bend = 0, size = 0;
    for (int i = 0; i < 2; i++) {
        const sl_point second = {p[i].x - 2 * p[i + 1].x + p[i + 2].x,
                                 p[i].y - 2 * p[i + 1].y + p[i + 2].y};
        bend = fmax(bend, 6 * length_in_map(&pen->affine, second));
    }
    for (int i = 1; i < 4; i++) {
        const sl_point away = {p[i].x - p[0].x, p[i].y - p[0].y};
        size = fmax(size, length_in_map(&pen->affine, away));
    }
    const double tolerance = pen->tolerance > 0 ? pen->tolerance : size / 200;
    const double count = ceil(sqrt(bend / (8 * tolerance)));
    return count >= 1 && count <= MOST_CHORDS ? (int)count : count > MOST_CHORDS ? MOST_CHORDS : 1;
}

sl_status sl_pen_cubic(sl_pen *pen, sl_point first, sl_point second, sl_point to) {
    const sl_point p[4] = {pen->at, first, second, to};
    const int chords = cubic_chords(pen, p);
    for (int i = 1; i < chords; i++) {
        const double t = (double)i / chords, s = 1 - t;
        const double w[4] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
        SL_TRY(sl_pen_line(
            pen, (sl_point){w[0] * p[0].x + w[1] * p[1].x + w[2] * p[2].x + w[3] * p[3].x,
                            w[0] * p[0].y + w[1] * p[1].y + w[2] * p[2].y + w[3] * p[3].y}));
    }
    return sl_pen_line(pen, to);
}

/// B-splines (de Boor's algorithm), drawn as the Bézier curves that they consist of.
#include "io/parts/shapes.h"

typedef struct spline {
    int degree;
    const double *knots;
    const sl_point *points;
} spline;

/// The blossom of the piece between knots k and k + 1: for three equal arguments the curve's point,
/// else a control point of it as a Bézier curve. A lower degree takes the mean over its arguments.
static sl_point blossom(const spline *s, size_t k, const double at[3]) {
    static const int choices[4][3][3] = {
        {{0}}, {{0}, {1}, {2}}, {{0, 1}, {0, 2}, {1, 2}}, {{0, 1, 2}}};
    const int degree = s->degree, count = degree == 3 ? 1 : 3;
    sl_point mean = {0, 0};
    for (int c = 0; c < count; c++) {
        sl_point points[4];
        for (int i = 0; i <= degree; i++) points[i] = s->points[k - (size_t)(degree - i)];
        for (int round = 1; round <= degree; round++) {
            const double t = at[choices[degree][c][round - 1]];
            for (int i = degree; i >= round; i--) {
                const double low = s->knots[k + (size_t)i - (size_t)degree],
                             high = s->knots[k + (size_t)i + 1 - (size_t)round];
                const double share = (t - low) / (high - low);
                points[i].x = (1 - share) * points[i - 1].x + share * points[i].x;
                points[i].y = (1 - share) * points[i - 1].y + share * points[i].y;
            }
        }
        mean.x += points[degree].x / count;
        mean.y += points[degree].y / count;
    }
    return mean;
}

sl_status sli_pen_spline(sli_pen *pen, int degree, const double *knots, const sl_point *points,
                         size_t count) {
    const spline s = {degree, knots, points};
    bool begun = false;
    for (size_t k = (size_t)degree; k < count; k++) {
        const double a = knots[k], b = knots[k + 1];
        if (!(a < b)) continue;
        if (!begun) pen->at = blossom(&s, k, (const double[3]){a, a, a});
        begun = true;
        SL_TRY(sli_pen_cubic(pen, blossom(&s, k, (const double[3]){a, a, b}),
                             blossom(&s, k, (const double[3]){a, b, b}),
                             blossom(&s, k, (const double[3]){b, b, b})));
    }
    return SL_OK;
}

#include "effects/fold.h"

/// a + b, and what that leaves out (Knuth's TwoSum).
static double add(double a, double b, double *rest) {
    const double sum = a + b, part = sum - a;
    *rest = (a - (sum - part)) + (b - part);
    return sum;
}

/// 2 axis - (at + rest).
static void fold_coordinate(double axis, double *at, double *rest, bool *rounded) {
    double first, second, third;
    const double sum = add(2 * axis, -*at, &first);
    const double low = add(first, -*rest, &second);
    *at = add(sum, low, &third);
    *rest = add(third, second, &first);
    // What is left of the tail may have to go up again.
    *at = add(*at, *rest, rest);
    *rounded |= first != 0;
}

/// p + 2 n (n . (a - p)) for the mirror's normal n, from the mirror's first end.
static sl_point fold_oblique(sl_segment mirror, sl_point p) {
    const double dx = mirror.b.x - mirror.a.x, dy = mirror.b.y - mirror.a.y;
    const double x = p.x - mirror.a.x, y = p.y - mirror.a.y;
    const double share = 2 * (dx * y - dy * x) / (dx * dx + dy * dy);
    return (sl_point){p.x + dy * share, p.y - dx * share};
}

sl_fine sl_fold(sl_segment mirror, const sl_fine *point, bool *rounded) {
    sl_fine out = *point;
    const sl_point a = mirror.a, b = mirror.b;
    if (a.x == b.x) {
        fold_coordinate(a.x, &out.at.x, &out.rest.x, rounded);
    } else if (a.y == b.y) {
        fold_coordinate(a.y, &out.at.y, &out.rest.y, rounded);
    } else if (sl_orient_fine(&(sl_fine){.at = a}, &(sl_fine){.at = b}, point) != 0) {
        out = (sl_fine){.at = fold_oblique(mirror, point->at)};
        *rounded = true;
    }
    return out;
}

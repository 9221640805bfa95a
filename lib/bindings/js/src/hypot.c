/// The length of a vector, rounded as glibc 2.35 and later round it (Borges 2019, An Improved
/// Algorithm for hypot(a, b), corrected, without fused operations).
///
/// A mesh joins triangles over their longest portals first. In a turned map many portals are of the
/// same length but for rounding, so the last bit of a length changes the cells. The hypot of
/// wasi-libc differs there, and a bake would have other bytes than that of the command. Neither is
/// wrong; but one map should give one file. The error is below one unit in the last place.
#include <math.h>

/// For 0 < small <= large, whose squares neither overflow nor underflow. The square root is right
/// up to rounding; one Newton step corrects it by what h^2 has too much.
static double length_of(double large, double small) {
    const double h = sqrt(large * large + small * small);
    double first, second;
    if (h <= 2 * small) {
        const double delta = h - small;
        first = large * (2 * delta - large);
        second = (delta - 2 * (large - small)) * delta;
    } else {
        const double delta = h - large;
        first = 2 * delta * (large - 2 * small);
        second = (4 * delta - small) * small + delta * delta;
    }
    return h - (first + second) / (2 * h);
}

double hypot(double x, double y) {
    const double scale = 0x1p-600;
    const double large = fmax(fabs(x), fabs(y)), small = fmin(fabs(x), fabs(y));
    if (isinf(x) || isinf(y)) return INFINITY;
    if (isnan(x) || isnan(y)) return NAN;
    if (small <= large * 0x1p-54) return large + small;
    if (large > 0x1p511) return length_of(large * scale, small * scale) / scale;
    if (small < 0x1p-459) return length_of(large / scale, small / scale) * scale;
    return length_of(large, small);
}

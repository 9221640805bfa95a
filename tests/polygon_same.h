/// Whether two polygons are the same but for rounding: the library's region and the runtime's.
#ifndef SL_POLYGON_SAME_H
#define SL_POLYGON_SAME_H

#include "sightline/region.h"

#include <math.h>

static inline double polygon_distance(sl_point at, sl_point a, sl_point b) {
    const sl_point d = {b.x - a.x, b.y - a.y};
    const double square = d.x * d.x + d.y * d.y;
    double share = square > 0 ? ((at.x - a.x) * d.x + (at.y - a.y) * d.y) / square : 0;
    share = fmin(fmax(share, 0), 1);
    const sl_point off = {a.x + share * d.x - at.x, a.y + share * d.y - at.y};
    return sqrt(off.x * off.x + off.y * off.y);
}

/// The largest distance of a corner of one polygon from the outline of another.
static inline double polygon_farthest(const sl_point *from, size_t from_count, const sl_point *to,
                                      size_t to_count) {
    double most = 0;
    for (size_t i = 0; i < from_count; i++) {
        double least = INFINITY;
        for (size_t k = 0; k < to_count && least > most; k++)
            least = fmin(least, polygon_distance(from[i], to[k], to[(k + 1) % to_count]));
        most = fmax(most, least);
    }
    return most;
}

static inline double polygon_area(sl_point eye, const sl_point *p, size_t count) {
    double area = 0;
    for (size_t i = 0; i < count; i++) {
        const sl_point a = p[i], b = p[(i + 1) % count];
        area += ((a.x - eye.x) * (b.y - eye.y) - (a.y - eye.y) * (b.x - eye.x)) / 2;
    }
    return area;
}

/// The error that rounding may leave in a point: of the map's size and its largest coordinate.
static inline double polygon_error(const sl_box *b) {
    const double size = fmax(b->max.x - b->min.x, b->max.y - b->min.y);
    const double largest =
        fmax(fmax(fabs(b->min.x), fabs(b->max.x)), fmax(fabs(b->min.y), fabs(b->max.y)));
    return 1e-14 * size + 4e-16 * largest;
}

#endif

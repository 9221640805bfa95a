/// Whether two lines have a point in common.
#ifndef SL_AXIAL_TOUCH_H
#define SL_AXIAL_TOUCH_H

#include "geometry/orient.h"

/// Whether the values from a to b and those from c to d have none in common. Most pairs end here.
static inline bool sli_are_apart(double a, double b, double c, double d) {
    const double low = a < b ? a : b, high = a < b ? b : a;
    return (c < low && d < low) || (c > high && d > high);
}

/// Exact, for closed segments.
static inline bool sli_touch(const sl_segment *s, const sl_segment *t) {
    if (sli_are_apart(s->a.x, s->b.x, t->a.x, t->b.x) ||
        sli_are_apart(s->a.y, s->b.y, t->a.y, t->b.y))
        return false;
    // Boxes meet. In one line, the segments meet too.
    return sli_orient(s->a, s->b, t->a) * sli_orient(s->a, s->b, t->b) <= 0 &&
           sli_orient(t->a, t->b, s->a) * sli_orient(t->a, t->b, s->b) <= 0;
}

#endif

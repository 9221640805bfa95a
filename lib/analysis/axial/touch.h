/// Whether two lines have a point in common.
#ifndef SL_AXIAL_TOUCH_H
#define SL_AXIAL_TOUCH_H

#include "geometry/orient.h"

/// Exact, for closed segments.
static inline bool sli_touch(const sl_segment *s, const sl_segment *t) {
    if (fmax(s->a.x, s->b.x) < fmin(t->a.x, t->b.x) || fmax(t->a.x, t->b.x) < fmin(s->a.x, s->b.x))
        return false;
    if (fmax(s->a.y, s->b.y) < fmin(t->a.y, t->b.y) || fmax(t->a.y, t->b.y) < fmin(s->a.y, s->b.y))
        return false;
    // Boxes meet. In one line, the segments meet too.
    return sli_orient(s->a, s->b, t->a) * sli_orient(s->a, s->b, t->b) <= 0 &&
           sli_orient(t->a, t->b, s->a) * sli_orient(t->a, t->b, s->b) <= 0;
}

#endif

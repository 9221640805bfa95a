/// Reflections: images of points, and frames of mirrored space.
///
/// Reflecting a point in an axial mirror is 2 a - p, and so exact as long as two doubles hold the
/// sum. Knuth's TwoSum gives the rounding error of each addition, which says whether it was exact.
/// Reflections in oblique mirrors are rounded, and say so.
#include "effects/mirrors.h"

#include "geometry/length.h"

// --- images of points

/// 2 axis - (at + rest).
static void fold_coordinate(double axis, double *at, double *rest, bool *rounded) {
    double first, second, third;
    const double sum = sli_two_sum(2 * axis, -*at, &first);
    const double low = sli_two_sum(first, -*rest, &second);
    *at = sli_two_sum(sum, low, &third);
    *rest = sli_two_sum(third, second, &first);
    // What is left of the tail may have to go up again.
    *at = sli_two_sum(*at, *rest, rest);
    *rounded |= first != 0;
}

/// p + 2 n (n . (a - p)) for the mirror's normal n, from the mirror's first end.
static sl_point fold_oblique(sl_segment mirror, sl_point p) {
    const double dx = mirror.b.x - mirror.a.x, dy = mirror.b.y - mirror.a.y;
    const double x = p.x - mirror.a.x, y = p.y - mirror.a.y;
    const double share = 2 * (dx * y - dy * x) / (dx * dx + dy * dy);
    return (sl_point){p.x + dy * share, p.y - dx * share};
}

sli_fine sli_fold(sl_segment mirror, const sli_fine *point, bool *rounded) {
    sli_fine out = *point;
    const sl_point a = mirror.a, b = mirror.b;
    if (a.x == b.x) {
        fold_coordinate(a.x, &out.at.x, &out.rest.x, rounded);
    } else if (a.y == b.y) {
        fold_coordinate(a.y, &out.at.y, &out.rest.y, rounded);
    } else if (sli_orient_fine(&(sli_fine){.at = a}, &(sli_fine){.at = b}, point) != 0) {
        out = (sli_fine){.at = fold_oblique(mirror, point->at)};
        *rounded = true;
    }
    return out;
}

// --- frames

sli_mirror_frame sli_mirror_frame_of_map(void) {
    return (sli_mirror_frame){.xx = 1, .yy = 1};
}

/// a + b; *rounded where that is not the sum.
static double add_noting(double a, double b, bool *rounded) {
    double rest;
    const double sum = sli_two_sum(a, b, &rest);
    if (rest != 0) *rounded = true;
    return sum;
}

/// The frame's map after p goes to (xx p.x + xy p.y + x, ...): first that, then the frame.
static sli_mirror_frame after(const sli_mirror_frame *f, const sli_mirror_frame *r) {
    return (sli_mirror_frame){.xx = f->xx * r->xx + f->xy * r->yx,
                              .xy = f->xx * r->xy + f->xy * r->yy,
                              .x = f->xx * r->x + f->xy * r->y + f->x,
                              .yx = f->yx * r->xx + f->yy * r->yx,
                              .yy = f->yx * r->xy + f->yy * r->yy,
                              .y = f->yx * r->x + f->yy * r->y + f->y};
}

sli_mirror_frame sli_mirror_frame_reflect(const sli_mirror_frame *frame, sl_segment mirror) {
    sli_mirror_frame out = *frame;
    const sl_point a = mirror.a, b = mirror.b;
    if (a.x == b.x && frame->xy == 0) {
        out.x = add_noting(frame->x, frame->xx * (2 * a.x), &out.rounded);
        out.xx = -frame->xx;
    } else if (a.y == b.y && frame->xy == 0) {
        out.y = add_noting(frame->y, frame->yy * (2 * a.y), &out.rounded);
        out.yy = -frame->yy;
    } else {
        // p + 2 n (n . (a - p)) for the mirror's unit normal n.
        const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
        const double nx = -dy, ny = dx, at = (nx * a.x + ny * a.y) / square;
        const sli_mirror_frame reflection = {.xx = 1 - 2 * nx * nx / square,
                                             .xy = -2 * nx * ny / square,
                                             .x = 2 * nx * at,
                                             .yx = -2 * nx * ny / square,
                                             .yy = 1 - 2 * ny * ny / square,
                                             .y = 2 * ny * at};
        out = after(frame, &reflection);
        out.rounded = true;
    }
    out.depth = frame->depth + 1;
    return out;
}

sl_point sli_mirror_frame_place(const sli_mirror_frame *f, sl_point p, bool *rounded) {
    if (f->xy == 0 && f->yx == 0)
        return (sl_point){add_noting(f->x, f->xx * p.x, rounded),
                          add_noting(f->y, f->yy * p.y, rounded)};
    *rounded = true;
    return (sl_point){f->xx * p.x + f->xy * p.y + f->x, f->yx * p.x + f->yy * p.y + f->y};
}

#include "effects/frame.h"

sl_frame sl_frame_of_map(void) {
    return (sl_frame){.xx = 1, .yy = 1};
}

/// a + b; *rounded where that is not the sum (Knuth's TwoSum).
static double add(double a, double b, bool *rounded) {
    const double sum = a + b, part = sum - a;
    if ((a - (sum - part)) + (b - part) != 0) *rounded = true;
    return sum;
}

/// The frame's map after p goes to (xx p.x + xy p.y + x, ...): first that, then the frame.
static sl_frame after(const sl_frame *f, const sl_frame *r) {
    return (sl_frame){.xx = f->xx * r->xx + f->xy * r->yx,
                      .xy = f->xx * r->xy + f->xy * r->yy,
                      .x = f->xx * r->x + f->xy * r->y + f->x,
                      .yx = f->yx * r->xx + f->yy * r->yx,
                      .yy = f->yx * r->xy + f->yy * r->yy,
                      .y = f->yx * r->x + f->yy * r->y + f->y};
}

sl_frame sl_frame_reflect(const sl_frame *frame, sl_segment mirror) {
    sl_frame out = *frame;
    const sl_point a = mirror.a, b = mirror.b;
    if (a.x == b.x && frame->xy == 0) {
        out.x = add(frame->x, frame->xx * (2 * a.x), &out.rounded);
        out.xx = -frame->xx;
    } else if (a.y == b.y && frame->xy == 0) {
        out.y = add(frame->y, frame->yy * (2 * a.y), &out.rounded);
        out.yy = -frame->yy;
    } else {
        // p + 2 n (n . (a - p)) for the mirror's unit normal n.
        const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
        const double nx = -dy, ny = dx, at = (nx * a.x + ny * a.y) / square;
        const sl_frame reflection = {.xx = 1 - 2 * nx * nx / square,
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

sl_point sl_frame_place(const sl_frame *f, sl_point p, bool *rounded) {
    if (f->xy == 0 && f->yx == 0)
        return (sl_point){add(f->x, f->xx * p.x, rounded), add(f->y, f->yy * p.y, rounded)};
    *rounded = true;
    return (sl_point){f->xx * p.x + f->xy * p.y + f->x, f->yx * p.x + f->yy * p.y + f->y};
}

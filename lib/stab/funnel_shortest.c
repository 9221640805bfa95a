#include "stab/funnel.h"

#include <math.h>

/// Between two portals, along lines through a point.
typedef struct piece {
    sl_portal_ends first, last;
    sl_point pivot;
} piece;

typedef struct way {
    double x, y; ///< of unit length
} way;

static way way_of(sl_point from, sl_point to) {
    const double x = to.x - from.x, y = to.y - from.y, length = hypot(x, y);
    return (way){x / length, y / length};
}

static way between(way a, way b, double share) {
    const double x = a.x + share * (b.x - a.x), y = a.y + share * (b.y - a.y);
    const double length = hypot(x, y);
    return (way){x / length, y / length};
}

/// How far along the way from the pivot a portal is crossed. A portal along the way is crossed
/// where that makes the piece shortest: `late` at its far end, else at its near one.
static double crossed_at(const piece *p, const sl_portal_ends *portal, way d, bool late) {
    const double lx = portal->left.x - p->pivot.x, ly = portal->left.y - p->pivot.y;
    const double rx = portal->right.x - p->pivot.x, ry = portal->right.y - p->pivot.y;
    const double left = d.x * lx + d.y * ly, right = d.x * rx + d.y * ry;
    const double left_off = d.x * ly - d.y * lx, right_off = d.x * ry - d.y * rx;
    const double low = fmin(left, right), high = fmax(left, right);
    if (left_off == right_off) return late ? high : low;
    const double at = left + (right - left) * (left_off / (left_off - right_off));
    return fmin(high, fmax(low, at));
}

static double length_at(const piece *p, way d) {
    const double length = crossed_at(p, &p->last, d, false) - crossed_at(p, &p->first, d, true);
    return fmax(0, length);
}

/// The least over a turn from one way to another, by golden section: the length is convex in the
/// angle, and so has one low.
static double shortest_of_turn(const piece *p, way from, way to) {
    const double golden = 0.6180339887498949;
    double low = 0, high = 1, a = 1 - golden, b = golden;
    double at_a = length_at(p, between(from, to, a)), at_b = length_at(p, between(from, to, b));
    double least = fmin(length_at(p, from), length_at(p, to));
    for (int i = 0; i < 60; i++) {
        if (at_a <= at_b) {
            high = b;
            b = a, at_b = at_a;
            a = high - golden * (high - low);
            at_a = length_at(p, between(from, to, a));
        } else {
            low = a;
            a = b, at_a = at_b;
            b = low + golden * (high - low);
            at_b = length_at(p, between(from, to, b));
        }
        least = fmin(least, fmin(at_a, at_b));
    }
    return least;
}

/// Between two portals on one line.
static double gap(const sl_portal_ends *a, const sl_portal_ends *b) {
    const sl_point p[2] = {a->left, a->right}, q[2] = {b->left, b->right};
    const bool flat = fabs(p[0].x - p[1].x) >= fabs(p[0].y - p[1].y);
    const double a_low = flat ? fmin(p[0].x, p[1].x) : fmin(p[0].y, p[1].y);
    const double a_high = flat ? fmax(p[0].x, p[1].x) : fmax(p[0].y, p[1].y);
    const double b_low = flat ? fmin(q[0].x, q[1].x) : fmin(q[0].y, q[1].y);
    const double b_high = flat ? fmax(q[0].x, q[1].x) : fmax(q[0].y, q[1].y);
    if (a_high >= b_low && b_high >= a_low) return 0;
    double least = INFINITY;
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++) least = fmin(least, hypot(p[i].x - q[k].x, p[i].y - q[k].y));
    return least;
}

double sl_funnel_shortest(const void *state) {
    piece p = {.first = sl_funnel_portal(state, false), .last = sl_funnel_portal(state, true)};
    const uint32_t count = sl_funnel_corner_count(state);
    if (!count) return gap(&p.first, &p.last);
    double least = INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        const sl_funnel_corner now = sl_funnel_corner_at(state, i);
        const sl_funnel_corner next = sl_funnel_corner_at(state, i + 1 < count ? i + 1 : 0);
        p.pivot = now.pivot;
        least =
            fmin(least, shortest_of_turn(&p, way_of(now.from, now.to), way_of(next.from, next.to)));
    }
    return least;
}

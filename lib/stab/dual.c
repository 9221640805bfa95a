/// Duality: a line y' = a x' + b becomes the point (a, b), and a portal end becomes a line.
///
/// A left end must lie over the sightline or on it: b <= y' - a x'. A right end must not: b >= y' -
/// a x'. So each end is a half-plane of points (a, b). The sightlines of a sequence are the points
/// in all half-planes: a convex polygon.
#include "sightline/dual.h"
#include "geometry/length.h"

#include <math.h>
#include <string.h>

static sl_point turn(const sl_dual *dual, sl_point p) {
    const double x = p.x - dual->origin.x, y = p.y - dual->origin.y;
    return (sl_point){(x * dual->along.x + y * dual->along.y) / dual->scale,
                      (y * dual->along.x - x * dual->along.y) / dual->scale};
}

sl_point sl_dual_point(const sl_dual *dual, sl_point point) {
    return turn(dual, point);
}

static sl_point turn_back(const sl_dual *dual, sl_point p) {
    const double x = p.x * dual->scale, y = p.y * dual->scale;
    return (sl_point){dual->origin.x + x * dual->along.x - y * dual->along.y,
                      dual->origin.y + x * dual->along.y + y * dual->along.x};
}

sl_line sl_dual_line_at(const sl_dual *dual, sl_dual_line line, double from, double to) {
    return (sl_line){
        turn_back(dual, (sl_point){from, line.slope * from + line.height}),
        turn_back(dual, (sl_point){to, line.slope * to + line.height}),
    };
}

/// A frame whose +x' goes through every portal the right way: the sum of the portals' unit normals,
/// each direction once as far as they repeat, does so for portals of up to two axial directions.
static void choose_frame(const sl_portal_ends *portals, uint32_t count, sl_dual *dual) {
    sl_point low = portals[0].left, high = low, sum = {0, 0}, last = {0, 0};
    for (uint32_t i = 0; i < count; i++) {
        const sl_point ends[2] = {portals[i].left, portals[i].right};
        for (int k = 0; k < 2; k++) {
            low = (sl_point){fmin(low.x, ends[k].x), fmin(low.y, ends[k].y)};
            high = (sl_point){fmax(high.x, ends[k].x), fmax(high.y, ends[k].y)};
        }
        const double wx = ends[0].x - ends[1].x, wy = ends[0].y - ends[1].y, w = sli_length(wx, wy);
        const sl_point normal = {wy / w, -wx / w};
        const bool again =
            sum.x * normal.x + sum.y * normal.y > 0.5 || (normal.x == last.x && normal.y == last.y);
        if (!again) sum = (sl_point){sum.x + normal.x, sum.y + normal.y};
        last = normal;
    }
    const double length = sli_length(sum.x, sum.y);
    dual->along = length > 0 ? (sl_point){sum.x / length, sum.y / length} : (sl_point){1, 0};
    dual->origin = (sl_point){low.x + (high.x - low.x) / 2, low.y + (high.y - low.y) / 2};
    dual->scale = sli_length(high.x - low.x, high.y - low.y) / 2;
    if (!(dual->scale > 0)) dual->scale = 1;
}

/// Keeps of the polygon what has sign * (height + slope x - y) <= 0: Sutherland & Hodgman.
static void cut(sl_dual *dual, sl_point end, double sign) {
    sl_dual_line kept[SL_DUAL_CORNERS_MOST];
    uint32_t count = 0;
    for (uint32_t i = 0; i < dual->corner_count; i++) {
        const sl_dual_line p = dual->corners[i], q = dual->corners[(i + 1) % dual->corner_count];
        const double dp = sign * (p.height + p.slope * end.x - end.y);
        const double dq = sign * (q.height + q.slope * end.x - end.y);
        if (dp <= 0 && count < SL_DUAL_CORNERS_MOST) kept[count++] = p;
        if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) {
            const double share = dp / (dp - dq);
            if (count < SL_DUAL_CORNERS_MOST)
                kept[count++] = (sl_dual_line){p.slope + (q.slope - p.slope) * share,
                                               p.height + (q.height - p.height) * share};
        }
    }
    memcpy(dual->corners, kept, count * sizeof *kept);
    dual->corner_count = count;
}

/// For one slope: the heights that all ends leave go from *low up to *high; none if high < low.
static void heights(const sl_dual *dual, const sl_portal_ends *portals, uint32_t count,
                    double slope, double *low, double *high) {
    *low = -INFINITY;
    *high = INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        const sl_point left = turn(dual, portals[i].left), right = turn(dual, portals[i].right);
        *high = fmin(*high, left.y - slope * left.x);
        *low = fmax(*low, right.y - slope * right.x);
    }
}

/// Rooms nearer to each other than this are alike: rounding alone tells them apart.
#define ALIKE 1e-13

/// The room between the heights is a concave function of the slope: its top by ternary search.
/// Where two slopes have the same room, the top is between them; of a flat top it is the middle.
static void optimize(const sl_portal_ends *portals, uint32_t count, sl_dual *dual) {
    double from = -SL_DUAL_SLOPE, to = SL_DUAL_SLOPE, low, high;
    for (int i = 0; i < 80; i++) {
        const double a = from + (to - from) / 3, b = to - (to - from) / 3;
        heights(dual, portals, count, a, &low, &high);
        const double room = high - low;
        heights(dual, portals, count, b, &low, &high);
        if (room < high - low + ALIKE) from = a;
        if (room > high - low - ALIKE) to = b;
    }
    dual->best.slope = from + (to - from) / 2;
    heights(dual, portals, count, dual->best.slope, &low, &high);
    dual->best.height = low + (high - low) / 2;
    dual->margin = (high - low) / 2;
    if (!count) dual->best.height = dual->margin = 0;
}

void sl_dual_make(const sl_portal_ends *portals, uint32_t count, uint32_t cutting, sl_dual *out) {
    if (count > SL_DUAL_PORTALS_MOST) count = SL_DUAL_PORTALS_MOST;
    if (cutting > count) cutting = count;
    choose_frame(portals, count, out);
    out->corner_count = 4;
    out->corners[0] = (sl_dual_line){-SL_DUAL_SLOPE, -SL_DUAL_HEIGHT};
    out->corners[1] = (sl_dual_line){SL_DUAL_SLOPE, -SL_DUAL_HEIGHT};
    out->corners[2] = (sl_dual_line){SL_DUAL_SLOPE, SL_DUAL_HEIGHT};
    out->corners[3] = (sl_dual_line){-SL_DUAL_SLOPE, SL_DUAL_HEIGHT};
    for (uint32_t i = 0; i < cutting; i++) {
        cut(out, turn(out, portals[i].left), 1);
        cut(out, turn(out, portals[i].right), -1);
    }
    optimize(portals, cutting, out);
}

double sl_dual_margin(const sl_dual *dual, const sl_portal_ends *portals, uint32_t count,
                      sl_dual_line line) {
    double low, high;
    heights(dual, portals, count, line.slope, &low, &high);
    return fmin(high - line.height, line.height - low);
}

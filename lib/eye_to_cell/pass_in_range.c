/// How far an eye sees: of a portal the nearest place between the borders of what is seen through
/// it, in doubles, with what rounding may have done on the side of seeing.
#include "eye_to_cell/eye_search.h"

#include <math.h>

static sl_point from_eye(sl_point eye, sl_point p) {
    return (sl_point){p.x - eye.x, p.y - eye.y};
}

static double size(sl_point v) {
    return fabs(v.x) + fabs(v.y);
}

/// Where on the way from p to q, 0 to 1, a ray meets it, with what rounding may have done to that;
/// false where it may be anywhere.
static bool meet(sl_point eye, sl_ray ray, sl_point p, sl_point q, double *at, double *error) {
    const sl_point d = ray.away ? from_eye(ray.point, eye) : from_eye(eye, ray.point);
    const double at_p = d.x * p.y - d.y * p.x, at_q = d.x * q.y - d.y * q.x;
    const double error_p = 0x1p-50 * size(d) * size(p), error_q = 0x1p-50 * size(d) * size(q);
    const double width = at_q - at_p;
    if (!(width > 4 * (error_p + error_q))) return false;
    *at = -at_p / width;
    *error = 2 * (error_p + fabs(*at) * (error_p + error_q)) / width + 0x1p-50;
    return true;
}

/// Whether what an arc has of an exit's portal is within range of the eye: true where that is so
/// but for rounding.
static bool arc_reaches(const sl_pivot *pivot, const sl_arc *arc, const sl_exit *exit,
                        double range) {
    const sl_point p = from_eye(pivot->eye, exit->right), q = from_eye(pivot->eye, exit->left);
    const sl_point d = {q.x - p.x, q.y - p.y};
    const double square = d.x * d.x + d.y * d.y;
    const double limit = range * (1 + 1e-12) + 1e-14 * (size(p) + size(q));
    double from = 0, to = 1, at, error;
    if (arc->span != SL_SPAN_HALF) {
        if (meet(pivot->eye, arc->right, p, q, &at, &error)) from = fmax(at - error, 0);
        if (meet(pivot->eye, arc->left, p, q, &at, &error)) to = fmin(at + error, 1);
    }
    at = square > 0 ? -(p.x * d.x + p.y * d.y) / square : 0;
    at = fmax(fmin(at, to), from);
    return !(hypot(p.x + at * d.x, p.y + at * d.y) > limit);
}

void sl_eye_search_limit(sl_eye_search *search, double range) {
    search->range = range;
}

bool sl_eye_pass_in_range(sl_eye_query *query, const sl_eye_step *from, bool first,
                          const sl_exit *exit, sl_eye_step *to) {
    const double range = query->search->range;
    if (!sl_eye_pass(query, from, first, exit, to)) return false;
    if (!(range > 0)) return true;
    unsigned kept = 0;
    for (unsigned i = 0; i < to->arc_count; i++)
        if (arc_reaches(&query->pivot, &to->arcs[i], exit, range)) to->arcs[kept++] = to->arcs[i];
    to->arc_count = kept;
    return kept > 0;
}

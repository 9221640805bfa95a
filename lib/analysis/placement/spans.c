/// Spans of windows that regions cover.
///
/// An eye beside the line of the window sees it through its fronts. The two rays of a front meet
/// the line in two spots, and between these the window is seen if it is before the front's wall:
///
///        ------+===========+----------  wall of the front
///               \         /
///        apex ---+-------+------- far   No wall crosses a window. So all that is between the rays
///                 \     /               is on one side of the wall, and one comparison with the
///                  \   /                spot of the wall's line tells.
///                   eye
///
/// An eye in line with the window looks along it. Then the front at either side of the line ends
/// the span.
#include "analysis/placement/spans.h"

#include "geometry/crossing.h"
#include "geometry/length.h"

/// (b - a) x (c - a), rounded, with a bound of its error.
static double determinant(sl_point a, sl_point b, sl_point c, double *error) {
    const double left = (b.x - a.x) * (c.y - a.y), right = (b.y - a.y) * (c.x - a.x);
    *error = 8 * 0x1p-53 * (fabs(left) + fabs(right)) + 0x1p-900;
    return left - right;
}

sli_spot sli_spot_of_line(const sl_segment *line, sl_segment other) {
    double from_error, to_error;
    const double from = determinant(other.a, other.b, line->a, &from_error);
    const double to = determinant(other.a, other.b, line->b, &to_error);
    const double both = 4 * (from_error + to_error), change = from - to;
    sli_spot spot = {other, 0, INFINITY};
    if (!(fabs(change) > 2 * both)) return spot;
    spot.at = from / change;
    spot.error =
        2 * (4 * from_error + fabs(spot.at) * both) / fabs(change) + 8 * 0x1p-53 * fabs(spot.at);
    return spot;
}

sli_spot sli_spot_of_point(const sl_segment *line, sl_point p) {
    const double dx = line->b.x - line->a.x, dy = line->b.y - line->a.y;
    const double step = fabs(dx) + fabs(dy) + fabs(p.x) + fabs(p.y);
    const bool steep = fabs(dy) > fabs(dx);
    const sl_point q = {steep ? p.x + step : p.x, steep ? p.y : p.y + step};
    return sli_spot_of_line(line, (sl_segment){p, q});
}

/// Whether two lines are given by a common point that is on a third one.
static bool meet_on(const sl_segment *line, const sl_segment *a, const sl_segment *b) {
    return ((sli_same_point(a->a, b->a) || sli_same_point(a->a, b->b)) &&
            sli_orient(line->a, line->b, a->a) == 0) ||
           ((sli_same_point(a->b, b->a) || sli_same_point(a->b, b->b)) &&
            sli_orient(line->a, line->b, a->b) == 0);
}

int sli_spot_order(const sl_segment *line, const sli_spot *a, const sli_spot *b) {
    const double gap = a->at - b->at, error = a->error + b->error;
    if (gap > error) return 1;
    if (-gap > error) return -1;
    if (sli_same_point(a->line.a, b->line.a) && sli_same_point(a->line.b, b->line.b)) return 0;
    if (meet_on(line, &a->line, &b->line)) return 0;
    return sli_meet_order(*line, a->line, b->line);
}

double sli_spot_share(const sli_spot *spot) {
    return spot->error < INFINITY ? spot->at : 1;
}

sli_track sli_track_of(const sli_look *look, uint32_t i) {
    const sli_window *w = &look->windows[i];
    sli_track track = {.line = {look->eye, w->apex}, .far = w->far, .seen = w->seen};
    track.start = sli_spot_of_point(&track.line, w->apex);
    track.end = sli_spot_of_line(&track.line, w->wall);
    return track;
}

sl_point sli_track_at(const sli_track *track, double share) {
    const sl_point a = track->line.a, b = track->line.b;
    return (sl_point){a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
}

sl_point sli_track_beside(const sli_track *t, double share, int side, double depth) {
    const sl_point at = sli_track_at(t, share), a = t->line.a, b = t->line.b;
    const double step = side * t->seen * depth / sli_length(b.x - a.x, b.y - a.y);
    return (sl_point){at.x - step * (b.y - a.y), at.y + step * (b.x - a.x)};
}

typedef struct spanner {
    sl_context *context;
    const sli_track *track;
    const sli_look *look;
    bool beyond;
    sli_spans *out;
} spanner;

static int order(const spanner *s, const sli_spot *a, const sli_spot *b) {
    return sli_spot_order(&s->track->line, a, b);
}

/// Adds a span, cut to the track.
static sl_status add(const spanner *s, sli_span span) {
    if (order(s, &span.from, &s->track->start) < 0) span.from = s->track->start;
    if (order(s, &span.to, &s->track->end) > 0) span.to = s->track->end;
    const int length = order(s, &span.to, &span.from);
    if (length < 0 || (length == 0 && s->beyond)) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(s->context, s->out, 1));
    s->out->items[s->out->count++] = span;
    return SL_OK;
}

/// Whether a part of the track is before a front's wall.
static bool is_before(const spanner *s, const sli_front *f, const sli_span *span) {
    const sl_segment *line = &s->track->line;
    const int mine = sli_orient(f->wall.a, f->wall.b, s->look->eye);
    const int rise = sli_turn(f->wall.a, f->wall.b, line->a, line->b);
    if (rise == 0) {
        const int side = sli_orient(f->wall.a, f->wall.b, line->a);
        return side == mine || (side == 0 && !s->beyond);
    }
    const sli_spot wall = sli_spot_of_line(line, f->wall);
    const int from = order(s, &span->from, &wall), to = order(s, &span->to, &wall);
    if (from == 0 && to == 0) return true; // one spot
    if (from >= 0) return rise == mine;
    if (to <= 0) return rise != mine;
    return !s->beyond; // never: it would be crossed
}

/// The spot where the ray through a corner meets the track. At the apex it is the track's own.
static sli_spot spot_of_ray(const spanner *s, sl_point corner) {
    if (sli_same_point(corner, s->track->line.b)) return s->track->start;
    return sli_spot_of_line(&s->track->line, (sl_segment){s->look->eye, corner});
}

/// Whether a ray meets the line, from an eye on its side `side`.
static bool hits(const spanner *s, sl_point corner, int side) {
    const sl_segment *line = &s->track->line;
    return sli_turn(line->a, line->b, s->look->eye, corner) == -side;
}

/// The part between two rays, of which at least one meets the line.
static sli_span span_between(const spanner *s, const sl_point *right, const sl_point *left,
                             int side) {
    sli_span span = {s->track->start, s->track->end};
    const sl_point *from = side > 0 ? right : left, *to = side > 0 ? left : right;
    if (from) span.from = spot_of_ray(s, *from);
    if (to) span.to = spot_of_ray(s, *to);
    if (order(s, &span.from, &s->track->start) < 0) span.from = s->track->start;
    if (order(s, &span.to, &s->track->end) > 0) span.to = s->track->end;
    return span;
}

/// The part that is seen through a front.
static sl_status see_through(const spanner *s, const sli_front *f, int side) {
    const bool right = hits(s, f->right, side), left = hits(s, f->left, side);
    if (!right && !left) return SL_OK;
    const sli_span span = span_between(s, right ? &f->right : NULL, left ? &f->left : NULL, side);
    if (order(s, &span.from, &span.to) > 0 || !is_before(s, f, &span)) return SL_OK;
    return add(s, span);
}

/// Whether the track is before a front's wall, as a whole: 1, or behind it: -1; 0 where this is not
/// clear at once.
static int place_at(const spanner *s, const sli_front *f) {
    double apex_error, far_error, eye_error;
    const double apex = determinant(f->wall.a, f->wall.b, s->track->line.b, &apex_error);
    const double far = determinant(f->wall.a, f->wall.b, s->track->far, &far_error);
    const double eye = determinant(f->wall.a, f->wall.b, s->look->eye, &eye_error);
    // The far end is rounded: much more than that, in terms of the products.
    const double margin = 0x1p20 * (apex_error + far_error + eye_error);
    if (!(fabs(apex) > margin && fabs(far) > margin && fabs(eye) > margin)) return 0;
    if ((apex > 0) != (far > 0)) return 0;
    return (apex > 0) == (eye > 0) ? 1 : -1;
}

/// What is seen through fronts that follow each other within less than half a turn of the way from
/// one end of the track to the other. Those that it is before are one span.
static sl_status see_through_all(const spanner *s, uint32_t first, uint32_t count, int side) {
    const sli_look *look = s->look;
    for (uint32_t i = 0; i < count;) {
        const sli_front *f = &look->fronts[(first + i++) % look->front_count], *last = f;
        const int at = place_at(s, f);
        if (at == 0) SL_TRY(see_through(s, f, side));
        if (at <= 0) continue;
        const bool right = hits(s, f->right, side);
        bool left = hits(s, f->left, side), any = left;
        for (; i < count; i++) {
            const sli_front *next = &look->fronts[(first + i) % look->front_count];
            if (!sli_same_point(last->left, next->right) || place_at(s, next) <= 0) break;
            last = next;
            left = hits(s, last->left, side);
            any = any || left;
        }
        if (!right && !any) continue;
        SL_TRY(add(s, span_between(s, right ? &f->right : NULL, left ? &last->left : NULL, side)));
    }
    return SL_OK;
}

/// The range of fronts that may see the track, by angles, with a margin. False where an angle is
/// not clear, or too wide: all fronts.
static bool find_fronts(const spanner *s, int side, uint32_t *first, uint32_t *count) {
    const sli_look *look = s->look;
    const sl_point apex = s->track->line.b, far = s->track->far, eye = look->eye;
    const sl_point a = {apex.x - eye.x, apex.y - eye.y}, b = {far.x - eye.x, far.y - eye.y};
    const double cross = fabs(sli_cross(a, b)), size = sli_dot(a, a) + sli_dot(b, b);
    *first = 0;
    *count = look->front_count;
    const double reach = fabs(eye.x) + fabs(eye.y) + fabs(far.x) + fabs(far.y), near = 1e-8 * reach;
    if (!(cross > 1e-9 * size && sli_dot(a, a) > near * near && sli_dot(b, b) > near * near))
        return false;
    const double margin = 1e-6;
    const double right = sli_look_angle(side > 0 ? a : b), left = sli_look_angle(side > 0 ? b : a);
    double from = right - margin;
    double length = left - right + 2 * margin;
    if (length < 0) length += 4;
    if (length > 2.5) return false;
    if (from < 0) from += 4;
    uint32_t low = 0, high = look->front_count; // the first one at an angle beyond `from`
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (look->angles[middle] <= from)
            low = middle + 1;
        else
            high = middle;
    }
    *first = (low + look->front_count - 1) % look->front_count;
    uint32_t n = 1;
    while (n < look->front_count) {
        double ahead = look->angles[(*first + n) % look->front_count] - from;
        if (ahead < 0) ahead += 4;
        if (ahead > length) break;
        n++;
    }
    *count = n;
    return true;
}

/// What an eye on the line sees to one side of it: `way` is 1 forwards along the line, -1 back.
static sl_status see_along(const spanner *s, const sli_front *f, int way) {
    const sl_segment *line = &s->track->line;
    const sl_point eye = s->look->eye, ahead = way > 0 ? line->b : line->a,
                   from = way > 0 ? line->a : line->b;
    // The ray that the direction is on, or that it is between.
    const int right = sli_turn(eye, f->right, from, ahead),
              left = sli_turn(from, ahead, eye, f->left);
    const double right_along = sli_dot((sl_point){f->right.x - eye.x, f->right.y - eye.y},
                                       (sl_point){ahead.x - from.x, ahead.y - from.y});
    const double left_along = sli_dot((sl_point){f->left.x - eye.x, f->left.y - eye.y},
                                      (sl_point){ahead.x - from.x, ahead.y - from.y});
    // What is beyond is clockwise of the direction where the right side of the way is unseen.
    const bool clockwise = s->track->seen * way > 0;
    const bool at_right = right == 0 && right_along > 0, at_left = left == 0 && left_along > 0;
    const bool within = right > 0 && left > 0;
    const bool touches = s->beyond ? (clockwise ? at_left : at_right) : at_left || at_right;
    if (!within && !touches) return SL_OK;
    if (sli_turn(f->wall.a, f->wall.b, line->a, line->b) == 0) return SL_OK;
    const sli_spot here = sli_spot_of_point(line, eye), there = sli_spot_of_line(line, f->wall);
    return add(s, way > 0 ? (sli_span){here, there} : (sli_span){there, here});
}

/// Spans in their order, joined where they touch.
static void join(const spanner *s) {
    sli_spans *all = s->out;
    for (size_t i = 1; i < all->count; i++) {
        const sli_span span = all->items[i];
        size_t k = i;
        for (; k && order(s, &all->items[k - 1].from, &span.from) > 0; k--)
            all->items[k] = all->items[k - 1];
        all->items[k] = span;
    }
    size_t count = 0;
    for (size_t i = 0; i < all->count; i++) {
        const sli_span span = all->items[i];
        if (count && order(s, &span.from, &all->items[count - 1].to) <= 0) {
            if (order(s, &span.to, &all->items[count - 1].to) > 0)
                all->items[count - 1].to = span.to;
        } else
            all->items[count++] = span;
    }
    all->count = count;
}

/// Whether a track may reach into a region: by boxes, with a margin for what was rounded.
static bool may_meet(const sli_track *track, const sl_box *box) {
    const sl_point p = track->line.b, q = track->far;
    const double x = 0x1p-40 * (fabs(box->min.x) + fabs(box->max.x));
    const double y = 0x1p-40 * (fabs(box->min.y) + fabs(box->max.y));
    return sli_lesser(p.x, q.x) <= box->max.x + x && sli_greater(p.x, q.x) >= box->min.x - x &&
           sli_lesser(p.y, q.y) <= box->max.y + y && sli_greater(p.y, q.y) >= box->min.y - y;
}

sl_box sli_track_box(const sli_track *track, const sl_box *bounds) {
    const double x = 0x1p-38 * fmax(fabs(bounds->min.x), fabs(bounds->max.x));
    const double y = 0x1p-38 * fmax(fabs(bounds->min.y), fabs(bounds->max.y));
    const sl_point p = track->line.b, q = track->far;
    return (sl_box){{sli_lesser(p.x, q.x) - x, sli_lesser(p.y, q.y) - y},
                    {sli_greater(p.x, q.x) + x, sli_greater(p.y, q.y) + y}};
}

sl_status sli_track_spans(sl_context *context, const sli_track *track, const sli_look *look,
                          bool beyond, sli_spans *out) {
    const spanner s = {context, track, look, beyond, out};
    out->count = 0;
    if (!may_meet(track, &look->bounds)) return SL_OK;
    const int side = sli_orient(track->line.a, track->line.b, look->eye);
    if (side == 0) {
        for (uint32_t i = 0; i < look->front_count; i++) {
            SL_TRY(see_along(&s, &look->fronts[i], 1));
            SL_TRY(see_along(&s, &look->fronts[i], -1));
        }
    } else {
        uint32_t first, count;
        if (find_fronts(&s, side, &first, &count))
            SL_TRY(see_through_all(&s, first, count, side));
        else
            for (uint32_t i = 0; i < count; i++) SL_TRY(see_through(&s, &look->fronts[i], side));
    }
    join(&s);
    return SL_OK;
}

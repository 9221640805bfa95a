/// Sets that are looked from, in small rooms and random maps: what of a segment a point sees, in
/// rational numbers (the crossings of all lines through the point and the ends of walls), and many
/// eyes.
#ifndef SL_SET_PLAN_H
#define SL_SET_PLAN_H

#include "room.h"

#include "geometry/orient.h"
#include "oracle/random_map.h"
#include "oracle/random_oblique.h"
#include "sightline/set_sight.h"

#include <gmp.h>
#include <math.h>

static inline double area_of(const room *r, const sl_point *points, size_t count, sl_set_kind kind,
                             sl_set_seen seen) {
    sl_set_sight *sight;
    sl_set_region region = {0};
    assert_ok(r->context, sl_set_sight_create(r->context, r->query, points, count, kind, &sight));
    assert_ok(r->context, sl_set_sight_region(r->context, sight, seen, &region));
    const double area = region.area;
    sl_set_region_destroy(r->context, &region);
    sl_set_sight_destroy(r->context, sight);
    return area;
}

typedef struct exact_point {
    mpq_t x, y;
} exact_point;

static inline void set_exact(exact_point *p, sl_point at) {
    mpq_set_d(p->x, at.x);
    mpq_set_d(p->y, at.y);
}

static inline int turn_of(const exact_point *a, const exact_point *b, const exact_point *c) {
    mpq_t p, q, r, s;
    mpq_inits(p, q, r, s, NULL);
    mpq_sub(p, b->x, a->x);
    mpq_sub(q, c->y, a->y);
    mpq_sub(r, b->y, a->y);
    mpq_sub(s, c->x, a->x);
    mpq_mul(p, p, q);
    mpq_mul(r, r, s);
    const int sign = mpq_cmp(p, r);
    mpq_clears(p, q, r, s, NULL);
    return (sign > 0) - (sign < 0);
}

enum { ENDS = 400 };

/// Exact places, made once.
typedef struct brute {
    exact_point a, b, eye, p, ends[ENDS][2];
    mpq_t shares[2 * ENDS + 2], t, u, v, w, range;
    size_t wall_count, share_count;
} brute;

static inline void brute_open(brute *x) {
    exact_point *const single[] = {&x->a, &x->b, &x->eye, &x->p};
    for (size_t i = 0; i < 4; i++) mpq_inits(single[i]->x, single[i]->y, NULL);
    for (size_t i = 0; i < ENDS; i++)
        for (int k = 0; k < 2; k++) mpq_inits(x->ends[i][k].x, x->ends[i][k].y, NULL);
    for (size_t i = 0; i < 2 * ENDS + 2; i++) mpq_init(x->shares[i]);
    mpq_inits(x->t, x->u, x->v, x->w, x->range, NULL);
}

static inline void brute_close(brute *x) {
    exact_point *const single[] = {&x->a, &x->b, &x->eye, &x->p};
    for (size_t i = 0; i < 4; i++) mpq_clears(single[i]->x, single[i]->y, NULL);
    for (size_t i = 0; i < ENDS; i++)
        for (int k = 0; k < 2; k++) mpq_clears(x->ends[i][k].x, x->ends[i][k].y, NULL);
    for (size_t i = 0; i < 2 * ENDS + 2; i++) mpq_clear(x->shares[i]);
    mpq_clears(x->t, x->u, x->v, x->w, x->range, NULL);
}

/// Adds where the line from the eye through an end meets the segment, as a share of its length.
static inline void add_share(brute *x, const exact_point *end) {
    // t = (eye - a) x (end - eye) / (b - a) x (end - eye)
    mpq_sub(x->u, end->x, x->eye.x);
    mpq_sub(x->v, end->y, x->eye.y);
    mpq_t *share = &x->shares[x->share_count];
    mpq_sub(x->t, x->b.x, x->a.x);
    mpq_mul(x->t, x->t, x->v);
    mpq_sub(x->w, x->b.y, x->a.y);
    mpq_mul(x->w, x->w, x->u);
    mpq_sub(x->t, x->t, x->w);
    if (mpq_sgn(x->t) == 0) return;
    mpq_sub(*share, x->eye.x, x->a.x);
    mpq_mul(*share, *share, x->v);
    mpq_sub(x->w, x->eye.y, x->a.y);
    mpq_mul(x->w, x->w, x->u);
    mpq_sub(*share, *share, x->w);
    mpq_div(*share, *share, x->t);
    mpq_set_ui(x->u, 1, 1);
    if (mpq_sgn(*share) > 0 && mpq_cmp(*share, x->u) < 0) x->share_count++;
}

static inline int compare_shares(const void *a, const void *b) {
    return mpq_cmp((mpq_srcptr)a, (mpq_srcptr)b);
}

static inline bool is_clear(const brute *x) {
    for (size_t i = 0; i < x->wall_count; i++) {
        const exact_point *w = x->ends[i];
        if (turn_of(&x->eye, &x->p, &w[0]) * turn_of(&x->eye, &x->p, &w[1]) < 0 &&
            turn_of(&w[0], &w[1], &x->eye) * turn_of(&w[0], &w[1], &x->p) < 0)
            return false;
    }
    return true;
}

/// The pieces of a segment that are seen from a point, or not: whether there are any, and the
/// share of the longest one.
typedef struct seen_pieces {
    bool any, near; ///< near: some place of them is in range
    double longest;
} seen_pieces;

static inline void place_at(brute *x, const mpq_t share) {
    mpq_sub(x->p.x, x->b.x, x->a.x);
    mpq_mul(x->p.x, x->p.x, share);
    mpq_add(x->p.x, x->p.x, x->a.x);
    mpq_sub(x->p.y, x->b.y, x->a.y);
    mpq_mul(x->p.y, x->p.y, share);
    mpq_add(x->p.y, x->p.y, x->a.y);
}

/// Whether the place of the segment nearest to the eye, between two shares, is in range of it.
static inline bool is_near(brute *x, const mpq_t from, const mpq_t to) {
    // The foot: (eye - a) . (b - a) / (b - a)^2
    mpq_sub(x->u, x->b.x, x->a.x);
    mpq_sub(x->v, x->b.y, x->a.y);
    mpq_sub(x->t, x->eye.x, x->a.x);
    mpq_mul(x->t, x->t, x->u);
    mpq_sub(x->w, x->eye.y, x->a.y);
    mpq_mul(x->w, x->w, x->v);
    mpq_add(x->t, x->t, x->w);
    mpq_mul(x->u, x->u, x->u);
    mpq_mul(x->v, x->v, x->v);
    mpq_add(x->u, x->u, x->v);
    mpq_div(x->t, x->t, x->u);
    if (mpq_cmp(x->t, from) < 0) mpq_set(x->t, from);
    if (mpq_cmp(x->t, to) > 0) mpq_set(x->t, to);
    place_at(x, x->t);
    mpq_sub(x->u, x->p.x, x->eye.x);
    mpq_mul(x->u, x->u, x->u);
    mpq_sub(x->v, x->p.y, x->eye.y);
    mpq_mul(x->v, x->v, x->v);
    mpq_add(x->u, x->u, x->v);
    mpq_mul(x->v, x->range, x->range);
    return mpq_cmp(x->u, x->v) <= 0;
}

/// Finds the pieces that are not seen, and those that are: between two neighbours of all shares
/// where a line to an end of a wall meets the segment, or where a wall does, one place tells.
static inline void by_brute_force(brute *x, sl_segment s, sl_point eye, seen_pieces found[2]) {
    set_exact(&x->a, s.a);
    set_exact(&x->b, s.b);
    set_exact(&x->eye, eye);
    x->share_count = 2;
    mpq_set_ui(x->shares[0], 0, 1);
    mpq_set_ui(x->shares[1], 1, 1);
    for (size_t i = 0; i < x->wall_count; i++)
        for (int k = 0; k < 2; k++) add_share(x, &x->ends[i][k]);
    // Where walls cross the segment: on the line through both ends, as seen from one of them.
    const exact_point keep = x->eye;
    for (size_t i = 0; i < x->wall_count; i++) {
        x->eye = x->ends[i][0];
        add_share(x, &x->ends[i][1]);
        x->eye = keep;
    }
    qsort(x->shares, x->share_count, sizeof *x->shares, compare_shares);
    found[0] = found[1] = (seen_pieces){0};
    for (size_t i = 1; i < x->share_count; i++) {
        if (mpq_cmp(x->shares[i - 1], x->shares[i]) == 0) continue;
        mpq_add(x->t, x->shares[i - 1], x->shares[i]);
        mpq_div_2exp(x->t, x->t, 1);
        place_at(x, x->t);
        seen_pieces *of = &found[is_clear(x)];
        of->any = true;
        of->near = of->near || (mpq_sgn(x->range) && is_near(x, x->shares[i - 1], x->shares[i]));
        mpq_sub(x->t, x->shares[i], x->shares[i - 1]);
        of->longest = fmax(of->longest, mpq_get_d(x->t));
    }
}

static inline bool make_random(sl_context *context, uint64_t seed, room *r) {
    *r = (room){.context = context};
    if (seed % 2)
        assert_ok(context, oracle_random_map(context, seed, (oracle_grid)(seed / 2 % 3), &r->map));
    else
        assert_ok(context, oblique_random_map(context, seed, (oblique_grid)(seed / 2 % 3),
                                              4 + (uint32_t)(seed % 17), &r->map));
    if (seed % 8 > 5) oblique_turn_map(&r->map, 17.3, seed % 16 > 9 ? 1e6 : 0);
    assert_ok(context, sl_map_clean(context, &r->map, NULL, NULL));
    if (!r->map.wall_count) return false;
    assert_ok(context, sl_subdivision_for(&r->map)->subdivide(context, &r->map, NULL, &r->space));
    assert_ok(context, sl_query_over(context, &r->space, &r->map, NULL, &r->query));
    return r->space.wall_count <= ENDS;
}

/// A point anywhere, at the end of a wall, or on a wall between its ends if that is a double.
static inline sl_point odd_point(const room *r, sl_random *random) {
    const sl_wall *wall = &r->space.walls[sl_random_next(random) % r->space.wall_count];
    const sl_point middle = {(wall->a.x + wall->b.x) / 2, (wall->a.y + wall->b.y) / 2};
    switch (sl_random_next(random) % 4) {
    case 0:
        return wall->a;
    case 1:
        return sl_orient(wall->a, wall->b, middle) == 0 ? middle : wall->b;
    default:
        return random_point(&r->space.bounds, random);
    }
}

static inline bool goes_around(const sl_shape *shape, sl_point p) {
    int times = 0;
    for (size_t i = 0; i < shape->count; i++) {
        const size_t begin = i ? shape->ends[i - 1] : 0, end = shape->ends[i];
        for (size_t k = begin; k < end; k++) {
            const sl_point a = shape->points[k], b = shape->points[k + 1 < end ? k + 1 : begin];
            if ((a.y <= p.y) == (b.y <= p.y)) continue;
            const int turn = sl_orient(a, b, p);
            if (a.y <= p.y && turn > 0) times++;
            if (b.y <= p.y && turn < 0) times--;
        }
    }
    return times != 0;
}

static inline double distance_to(const sl_shape *shape, sl_point p) {
    double least = INFINITY;
    for (size_t i = 0; i < shape->count; i++) {
        const size_t begin = i ? shape->ends[i - 1] : 0, end = shape->ends[i];
        for (size_t k = begin; k < end; k++) {
            const sl_point a = shape->points[k], b = shape->points[k + 1 < end ? k + 1 : begin];
            const double x = b.x - a.x, y = b.y - a.y;
            const double t =
                fmin(1, fmax(0, ((p.x - a.x) * x + (p.y - a.y) * y) / (x * x + y * y)));
            least = fmin(least, hypot(p.x - a.x - t * x, p.y - a.y - t * y));
        }
    }
    return least;
}

/// Whether a point sees a given point of the set or an end of a wall on it.
static inline bool sees_single(const room *r, sl_segment s, sl_point at) {
    sl_point points[2 * ENDS + 2] = {s.a, s.b};
    size_t count = 2;
    for (uint32_t i = 0; i < r->space.wall_count; i++) {
        const sl_point ends[2] = {r->space.walls[i].a, r->space.walls[i].b};
        for (int k = 0; k < 2; k++)
            if (sl_orient(s.a, s.b, ends[k]) == 0) points[count++] = ends[k];
    }
    for (size_t i = 0; i < count; i++) {
        bool to, from;
        assert_ok(r->context, sl_query_sees(r->context, r->query, at, points[i], &to));
        assert_ok(r->context, sl_query_sees(r->context, r->query, points[i], at, &from));
        if (to || from) return true;
    }
    return false;
}

/// As many eyes along the set as SIGHTLINE_EYES says. The long check is 100000.
static inline size_t eye_count(void) {
    const char *text = getenv("SIGHTLINE_EYES");
    return text ? strtoull(text, NULL, 10) : 1000;
}

static const char set_plan[] =
    "walls 0 0 24 0 24 16 0 16 0 0\nwall 8 0 8 6\nwall 8 8 8 16\ndoor one 8 6 8 8 open\n"
    "wall 16 0 16 3\nwall 16 5 16 16\ndoor two 16 3 16 5 shut\noneway 8 11 16 13\n"
    "walls 10 2 12 3 11 5 10 2\nwalls 19 9 21 9 21 11 19 11 19 9\nwall 13 6 14 9\n"
    "wall 3 3 4 8\nstart 2 5 0\n";

/// An eye of the set: along its line, or anywhere in its area.
static inline sl_point eye_of(const sl_point *points, size_t count, sl_set_kind kind, double share,
                              sl_random *random) {
    sl_point at = {0, 0};
    if (kind == SL_SET_LINE) {
        const double along = share * (double)(count - 1);
        const size_t i = (size_t)fmin(floor(along), (double)(count - 2));
        const double t = along - (double)i;
        return (sl_point){points[i].x + t * (points[i + 1].x - points[i].x),
                          points[i].y + t * (points[i + 1].y - points[i].y)};
    }
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        const double weight = -log(1 - sl_random_unit(random));
        sum += weight;
        at.x += weight * points[i].x;
        at.y += weight * points[i].y;
    }
    return (sl_point){at.x / sum, at.y / sum};
}

#endif

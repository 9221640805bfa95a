/// A ray in rationals, from one wall to the next.
#include "oracle/mirror_ray.h"

#include <gmp.h>
#include <math.h>

typedef struct vector {
    mpq_t x, y;
} vector;

typedef struct tracer {
    const sl_map *map;
    vector at, to, a, b, e, hit;
    mpq_t p, q, t, u, best;
} tracer;

static void init(vector *v) {
    mpq_inits(v->x, v->y, NULL);
}

static void clear(vector *v) {
    mpq_clears(v->x, v->y, NULL);
}

static void set(vector *v, sl_point p) {
    mpq_set_d(v->x, p.x);
    mpq_set_d(v->y, p.y);
}

static sl_point rounded(const vector *v) {
    return (sl_point){mpq_get_d(v->x), mpq_get_d(v->y)};
}

static void subtract(vector *out, const vector *a, const vector *b) {
    mpq_sub(out->x, a->x, b->x);
    mpq_sub(out->y, a->y, b->y);
}

/// out = u x v; `scratch` is another.
static void cross(mpq_t out, const vector *u, const vector *v, mpq_t scratch) {
    mpq_mul(out, u->x, v->y);
    mpq_mul(scratch, u->y, v->x);
    mpq_sub(out, out, scratch);
}

static void dot(mpq_t out, const vector *u, const vector *v, mpq_t scratch) {
    mpq_mul(out, u->x, v->x);
    mpq_mul(scratch, u->y, v->y);
    mpq_add(out, out, scratch);
}

/// Where the ray meets a segment: `t` of its way, more than 0. False where it does not.
static bool meets(tracer *r, sl_segment s) {
    set(&r->a, s.a);
    set(&r->b, s.b);
    subtract(&r->e, &r->b, &r->a);
    subtract(&r->a, &r->a, &r->at);
    cross(r->p, &r->to, &r->e, r->q);
    if (mpq_sgn(r->p) == 0) return false;
    cross(r->t, &r->a, &r->e, r->q);
    mpq_div(r->t, r->t, r->p);
    cross(r->u, &r->a, &r->to, r->q);
    mpq_div(r->u, r->u, r->p);
    return mpq_sgn(r->t) > 0 && mpq_sgn(r->u) >= 0 && mpq_cmp_ui(r->u, 1, 1) <= 0;
}

/// How far the ray, up to `best` of its way, keeps from a point.
static double distance(tracer *r, sl_point point) {
    set(&r->a, point);
    subtract(&r->a, &r->a, &r->at);
    dot(r->p, &r->to, &r->to, r->q);
    dot(r->t, &r->a, &r->to, r->q);
    mpq_div(r->t, r->t, r->p);
    if (mpq_sgn(r->t) < 0) mpq_set_ui(r->t, 0, 1);
    if (mpq_cmp(r->t, r->best) > 0) mpq_set(r->t, r->best);
    mpq_mul(r->p, r->to.x, r->t);
    mpq_mul(r->q, r->to.y, r->t);
    mpq_sub(r->p, r->a.x, r->p);
    mpq_sub(r->q, r->a.y, r->q);
    return hypot(mpq_get_d(r->p), mpq_get_d(r->q));
}

/// The first wall, or glass that the ray comes to from its left; sets `hit` and `best`.
static bool find_first(tracer *r) {
    bool found = false;
    for (size_t i = 0; i < r->map->oneway_count; i++) {
        if (!meets(r, r->map->oneways[i].segment) || (found && mpq_cmp(r->t, r->best) >= 0))
            continue;
        // p is the ray's direction x the glass's, as in mirror_at_hit.
        cross(r->p, &r->to, &r->e, r->q);
        if (mpq_sgn(r->p) <= 0) continue;
        found = true;
        mpq_set(r->best, r->t);
    }
    for (size_t i = 0; i < r->map->wall_count; i++) {
        const sl_wall *w = &r->map->walls[i];
        if (!meets(r, (sl_segment){w->a, w->b}) || (found && mpq_cmp(r->t, r->best) >= 0)) continue;
        found = true;
        mpq_set(r->best, r->t);
    }
    mpq_mul(r->p, r->to.x, r->best);
    mpq_add(r->hit.x, r->at.x, r->p);
    mpq_mul(r->p, r->to.y, r->best);
    mpq_add(r->hit.y, r->at.y, r->p);
    return found;
}

/// The mirror that reflects where the ray hits; UINT32_MAX for none.
static uint32_t mirror_at_hit(tracer *r) {
    for (uint32_t i = 0; i < r->map->mirror_count; i++) {
        const sl_glass *m = &r->map->mirrors[i];
        if (!meets(r, m->segment) || mpq_cmp(r->t, r->best) != 0) continue;
        // p is the ray's direction x the mirror's: over 0 where it comes from the mirror's left.
        cross(r->p, &r->to, &r->e, r->q);
        if (!m->one_sided || mpq_sgn(r->p) > 0) return i;
    }
    return UINT32_MAX;
}

/// From the hit on: to' = 2 (to . e) / (e . e) e - to.
static void reflect(tracer *r, sl_segment mirror) {
    set(&r->a, mirror.a);
    set(&r->b, mirror.b);
    subtract(&r->e, &r->b, &r->a);
    dot(r->t, &r->to, &r->e, r->q);
    dot(r->p, &r->e, &r->e, r->q);
    mpq_div(r->t, r->t, r->p);
    mpq_add(r->t, r->t, r->t);
    mpq_mul(r->p, r->e.x, r->t);
    mpq_sub(r->to.x, r->p, r->to.x);
    mpq_mul(r->p, r->e.y, r->t);
    mpq_sub(r->to.y, r->p, r->to.y);
    mpq_set(r->at.x, r->hit.x);
    mpq_set(r->at.y, r->hit.y);
}

static void follow(tracer *r, uint32_t depth, oracle_ray *out) {
    uint32_t mirror = UINT32_MAX;
    while (find_first(r)) {
        for (size_t i = 0; i < r->map->wall_count; i++)
            out->margin = fmin(out->margin, fmin(distance(r, r->map->walls[i].a),
                                                 distance(r, r->map->walls[i].b)));
        for (size_t i = 0; i < r->map->mirror_count; i++)
            out->margin = fmin(out->margin, fmin(distance(r, r->map->mirrors[i].segment.a),
                                                 distance(r, r->map->mirrors[i].segment.b)));
        for (size_t i = 0; i < r->map->oneway_count; i++)
            out->margin = fmin(out->margin, fmin(distance(r, r->map->oneways[i].segment.a),
                                                 distance(r, r->map->oneways[i].segment.b)));
        out->legs[out->count++] = (oracle_leg){rounded(&r->at), rounded(&r->hit), mirror};
        mirror = mirror_at_hit(r);
        if (mirror == UINT32_MAX || out->count > depth || out->count == ORACLE_LEGS_MOST) return;
        reflect(r, r->map->mirrors[mirror].segment);
    }
    out->count = 0;
}

oracle_ray oracle_ray_of(const sl_map *map, sl_point eye, sl_point direction, uint32_t depth) {
    oracle_ray out = {.margin = INFINITY};
    tracer r = {.map = map};
    vector *const vectors[] = {&r.at, &r.to, &r.a, &r.b, &r.e, &r.hit};
    for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++) init(vectors[i]);
    mpq_inits(r.p, r.q, r.t, r.u, r.best, NULL);
    set(&r.at, eye);
    set(&r.to, direction);
    follow(&r, depth, &out);
    for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++) clear(vectors[i]);
    mpq_clears(r.p, r.q, r.t, r.u, r.best, NULL);
    return out;
}

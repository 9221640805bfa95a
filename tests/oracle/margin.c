// A line with left normal n keeps the margin d to all ends iff n·L + c >= d and n·R + c <= -d for
// some c, so that the most it can keep is (min n·L - max n·R) / 2. The margin of the sequence is
// the maximum of that over all unit vectors n: half the distance between the convex hulls of left
// ends and of right ends, or, where they overlap, minus half of how deep they do.
//
// The differences of a left and a right end have as their hull a polygon K; the margin is half the
// distance of 0 to K, or minus half its distance to K's border where 0 is inside. It is attained by
// the normal of an edge of K, which is an edge of one of the two hulls, or where a corner of K is
// nearest, by a difference of two corners. All n that are tried are no better than the maximum, so
// that trying too many is no harm. Only the length of n is not rational.
#include "oracle/margin.h"

#include "oracle/dyadic.h"
#include "oracle/must.h"

#include <gmp.h>
#include <limits.h>
#include <stdlib.h>

typedef struct vector {
    mpz_t x, y;
} vector;

/// The corners of a convex polygon, counter-clockwise; two for a segment, one for a point.
typedef struct hull {
    vector **corners;
    size_t count;
} hull;

typedef struct job {
    int exponent; ///< coordinates are integers times 2 ^ exponent
    hull left, right;
    vector normal;
    mpz_t least, most, term, other;
    bool any;
    oracle_margin best;
} job;

static int lowest_exponent(const oracle_portal *portals, size_t count) {
    int lowest = INT_MAX;
    for (size_t i = 0; i < count; i++) {
        const double values[] = {portals[i].left.x, portals[i].left.y, portals[i].right.x,
                                 portals[i].right.y};
        for (int k = 0; k < 4; k++) {
            const dyadic d = dyadic_of(values[k]);
            if (d.odd && d.exponent < lowest) lowest = d.exponent;
        }
    }
    return lowest == INT_MAX ? 0 : lowest;
}

static void init_integer(mpz_t out, double value, int exponent) {
    const dyadic d = dyadic_of(value);
    mpz_init_set_d(out, (double)d.odd); // 53 bits; a long may have 32
    if (d.odd) mpz_mul_2exp(out, out, (mp_bitcnt_t)(d.exponent - exponent));
}

static vector *make_vectors(const oracle_portal *portals, size_t count, bool left, int exponent) {
    vector *vectors = must(calloc(count, sizeof *vectors));
    for (size_t i = 0; i < count; i++) {
        const sl_point p = left ? portals[i].left : portals[i].right;
        init_integer(vectors[i].x, p.x, exponent);
        init_integer(vectors[i].y, p.y, exponent);
    }
    return vectors;
}

static void free_vectors(vector *vectors, size_t count) {
    for (size_t i = 0; i < count; i++) mpz_clears(vectors[i].x, vectors[i].y, NULL);
    free(vectors);
}

static int compare(const void *a, const void *b) {
    const vector *p = *(vector *const *)a, *q = *(vector *const *)b;
    const int by_x = mpz_cmp(p->x, q->x);
    return by_x ? by_x : mpz_cmp(p->y, q->y);
}

/// Above 0 where c lies to the left of the line from a to b.
static int turn(job *j, const vector *a, const vector *b, const vector *c) {
    mpz_sub(j->term, b->x, a->x);
    mpz_sub(j->other, c->y, a->y);
    mpz_mul(j->least, j->term, j->other);
    mpz_sub(j->term, b->y, a->y);
    mpz_sub(j->other, c->x, a->x);
    mpz_submul(j->least, j->term, j->other);
    return mpz_sgn(j->least);
}

/// Andrew's monotone chain: the lower chain from left to right, then the upper one back.
static hull make_hull(job *j, vector *points, size_t count) {
    vector **sorted = must(calloc(count, sizeof *sorted));
    hull h = {must(calloc(2 * count + 1, sizeof *h.corners)), 0};
    for (size_t i = 0; i < count; i++) sorted[i] = &points[i];
    qsort(sorted, count, sizeof *sorted, compare);
    for (int chain = 0; chain < 2; chain++) {
        const size_t start = h.count;
        for (size_t i = 0; i < count; i++) {
            vector *p = sorted[chain ? count - 1 - i : i];
            if (h.count > start && compare(&h.corners[h.count - 1], &p) == 0) continue;
            while (h.count >= start + 2 &&
                   turn(j, h.corners[h.count - 2], h.corners[h.count - 1], p) <= 0)
                h.count--;
            h.corners[h.count++] = p;
        }
        if (h.count > start + 1)
            h.count--; // begins the next chain
        else if (chain)
            h.count--;
    }
    free(sorted);
    return h;
}

static void dot(mpz_t out, const vector *u, const vector *v) {
    mpz_mul(out, u->x, v->x);
    mpz_addmul(out, u->y, v->y);
}

/// The smallest (`way` -1) or largest (1) product of the normal with a corner.
static void extreme(job *j, mpz_t out, const hull *h, int way) {
    for (size_t i = 0; i < h->count; i++) {
        dot(j->term, &j->normal, h->corners[i]);
        if (i == 0 || mpz_cmp(j->term, out) * way > 0) mpz_set(out, j->term);
    }
}

/// mantissa / root of square, times 2 ^ exponent.
static double quotient(const mpz_t value, const mpz_t square, int exponent) {
    long value_exponent, square_exponent;
    const double v = mpz_get_d_2exp(&value_exponent, value);
    double s = mpz_get_d_2exp(&square_exponent, square);
    if (square_exponent % 2) {
        s *= 2;
        square_exponent--;
    }
    return ldexp(v / sqrt(s), (int)(value_exponent - square_exponent / 2) + exponent);
}

static void try_normal(job *j) {
    if (mpz_sgn(j->normal.x) == 0 && mpz_sgn(j->normal.y) == 0) return;
    extreme(j, j->least, &j->left, -1);
    extreme(j, j->most, &j->right, 1);
    mpz_sub(j->least, j->least, j->most);
    const int sign = mpz_sgn(j->least);
    dot(j->other, &j->normal, &j->normal);
    const double value = quotient(j->least, j->other, j->exponent - 1);
    const sl_stab_verdict verdict = sign > 0 ? SL_STABBED : sign == 0 ? SL_GRAZING : SL_HIDDEN;
    if (!j->any || verdict > j->best.verdict ||
        (verdict == j->best.verdict && value > j->best.value))
        j->best = (oracle_margin){verdict, value};
    j->any = true;
}

static void try_edges(job *j, const hull *h) {
    for (size_t i = 0; i < h->count; i++) {
        const vector *a = h->corners[i], *b = h->corners[i + 1 < h->count ? i + 1 : 0];
        mpz_sub(j->normal.x, a->y, b->y);
        mpz_sub(j->normal.y, b->x, a->x);
        try_normal(j);
        mpz_neg(j->normal.x, j->normal.x);
        mpz_neg(j->normal.y, j->normal.y);
        try_normal(j);
    }
}

oracle_margin oracle_margin_of(const oracle_portal *portals, size_t count) {
    job j = {.exponent = lowest_exponent(portals, count)};
    mpz_inits(j.normal.x, j.normal.y, j.least, j.most, j.term, j.other, NULL);
    vector *left = make_vectors(portals, count, true, j.exponent);
    vector *right = make_vectors(portals, count, false, j.exponent);
    j.left = make_hull(&j, left, count);
    j.right = make_hull(&j, right, count);
    try_edges(&j, &j.left);
    try_edges(&j, &j.right);
    for (size_t i = 0; i < j.left.count; i++) {
        for (size_t k = 0; k < j.right.count; k++) {
            mpz_sub(j.normal.x, j.left.corners[i]->x, j.right.corners[k]->x);
            mpz_sub(j.normal.y, j.left.corners[i]->y, j.right.corners[k]->y);
            try_normal(&j);
        }
    }
    if (!j.any) j.best.verdict = SL_GRAZING; // all in one point
    free(j.left.corners);
    free(j.right.corners);
    free_vectors(left, count);
    free_vectors(right, count);
    mpz_clears(j.normal.x, j.normal.y, j.least, j.most, j.term, j.other, NULL);
    return j.best;
}

bool oracle_forwards(const oracle_portal *portals, size_t count) {
    const int exponent = lowest_exponent(portals, count);
    vector *across = make_vectors(portals, count, true, exponent);
    vector *right = make_vectors(portals, count, false, exponent);
    mpz_t cross, along;
    mpz_inits(cross, along, NULL);
    for (size_t i = 0; i < count; i++) {
        mpz_sub(across[i].x, across[i].x, right[i].x);
        mpz_sub(across[i].y, across[i].y, right[i].y);
    }
    // One of them then has all others less than a half turn to its left.
    bool found = false;
    for (size_t i = 0; i < count && !found; i++) {
        found = true;
        for (size_t k = 0; k < count && found; k++) {
            mpz_mul(cross, across[i].x, across[k].y);
            mpz_submul(cross, across[i].y, across[k].x);
            dot(along, &across[i], &across[k]);
            found = mpz_sgn(cross) > 0 || (mpz_sgn(cross) == 0 && mpz_sgn(along) > 0);
        }
    }
    mpz_clears(cross, along, NULL);
    free_vectors(across, count);
    free_vectors(right, count);
    return found;
}

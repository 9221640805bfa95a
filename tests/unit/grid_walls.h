/// Random walls on a small grid, and what is seen of them: sightlines are told free in integers.
#ifndef SL_GRID_WALLS_H
#define SL_GRID_WALLS_H

#include "testing.h"

#include "sightline/support.h"

enum { GRID = 12, WALLS_MOST = 14, LINES = 60 };

typedef struct place {
    int x, y;
} place;

static inline long turn(place a, place b, place c) {
    return (long)(b.x - a.x) * (c.y - a.y) - (long)(b.y - a.y) * (c.x - a.x);
}

static inline int sign(long value) {
    return (value > 0) - (value < 0);
}

static inline bool in_box(place a, place b, place p) {
    return (p.x - a.x) * (p.x - b.x) <= 0 && (p.y - a.y) * (p.y - b.y) <= 0;
}

/// Whether two closed segments share a point, in integers.
static inline bool touch(place a, place b, place c, place d) {
    const int ab_c = sign(turn(a, b, c)), ab_d = sign(turn(a, b, d));
    const int cd_a = sign(turn(c, d, a)), cd_b = sign(turn(c, d, b));
    if (ab_c * ab_d < 0 && cd_a * cd_b < 0) return true;
    return (ab_c == 0 && in_box(a, b, c)) || (ab_d == 0 && in_box(a, b, d)) ||
           (cd_a == 0 && in_box(c, d, a)) || (cd_b == 0 && in_box(c, d, b));
}

static inline place random_place(sl_random *random) {
    return (place){(int)sl_random_below(random, GRID), (int)sl_random_below(random, GRID)};
}

static inline sl_point scaled(place p, double scale, double shift) {
    return (sl_point){p.x * scale + shift, p.y * scale + shift};
}

typedef struct drawn {
    place a[WALLS_MOST], b[WALLS_MOST];
    int count;
} drawn;

/// The walls of a kind: anyhow, from one centre, in a chain, each third one twice.
static inline drawn draw(sl_random *random, int kind) {
    drawn d = {.count = 1 + (int)sl_random_below(random, WALLS_MOST)};
    const place centre = random_place(random);
    for (int i = 0; i < d.count; i++) {
        d.a[i] = kind == 1 ? centre : kind == 2 && i ? d.b[i - 1] : random_place(random);
        do d.b[i] = random_place(random);
        while (d.b[i].x == d.a[i].x && d.b[i].y == d.a[i].y);
        if (kind == 3 && i % 3 == 2) d.a[i] = d.a[i - 1], d.b[i] = d.b[i - 1];
    }
    return d;
}

static inline bool is_free(const drawn *d, place p, place q) {
    for (int i = 0; i < d->count; i++)
        if (touch(p, q, d->a[i], d->b[i])) return false;
    return true;
}

static inline void see(sl_context *context, const sl_space *space, const char *name, sl_sight sight,
                       sl_visibility *out) {
    const sl_see_method *method = testing_method(name);
    sl_see_options options = sl_see_options_default();
    options.sight = sight;
    options.solver = method->stabs ? sl_funnel() : NULL;
    assert_ok(context, method->see(context, space, &options, out));
}

/// Gives the number of free sightlines that were checked.
static inline int check_free(const drawn *d, const sl_space *space, const sl_pvs *pvs, double scale,
                             double shift, sl_random *random) {
    int checked = 0;
    for (int i = 0; i < LINES; i++) {
        const place p = random_place(random), q = random_place(random);
        if ((p.x == q.x && p.y == q.y) || !is_free(d, p, q)) continue;
        const uint32_t a = sl_space_locate(space, scaled(p, scale, shift));
        const uint32_t b = sl_space_locate(space, scaled(q, scale, shift));
        if (a == SL_NO_CELL || b == SL_NO_CELL) continue;
        checked++;
        if (!sl_pvs_sees(pvs, a, b))
            fail_msg("(%d %d) sees (%d %d), but not cell %u cell %u", p.x, p.y, q.x, q.y, a, b);
    }
    return checked;
}

#endif

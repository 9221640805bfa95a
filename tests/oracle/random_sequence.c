/// Kinds of sequences, and how each is made degenerate.
#include "oracle/random_sequence.h"

#include <math.h>
#include <stdlib.h>

/// What the portals of one sequence have in common.
typedef struct plan {
    sl_random *random;
    random_kind kind;
    sl_point step;    ///< the direction of travel
    sl_point origin;  ///< a point on the line that ends are put on
    double size;      ///< coordinates are about so large
    uint64_t grid;    ///< and these integers below it
    sl_point pool[6]; ///< for ends out of a few points
    uint64_t pool_count;
    sl_point front; ///< how far stairs have come
} plan;

const char *random_kind_name(random_kind kind) {
    static const char *const names[] = {"stairs",   "grid",      "large grid",
                                        "few ends", "collinear", "grazing integers",
                                        "grazing",  "corridor",  "doors"};
    return names[kind];
}

static double below(const plan *p, uint64_t bound) {
    return (double)sl_random_below(p->random, bound);
}

static bool chance(const plan *p, uint64_t in) {
    return sl_random_below(p->random, in) == 0;
}

/// Uniform in -1 .. 1.
static double spread(const plan *p) {
    return 2 * sl_random_unit(p->random) - 1;
}

static bool same(sl_point a, sl_point b) {
    return a.x == b.x && a.y == b.y;
}

/// Moves a value by a few units in its last place; 0 to something very small, but usable.
static double nudged(sl_random *random, double value) {
    static const int steps[] = {-2, -1, -1, 1, 1, 2};
    static const double small[] = {0x1p-52, -0x1p-52, 0x1p-80, -SL_COORDINATE_MIN};
    const int step = steps[sl_random_below(random, 6)];
    if (value == 0) return small[sl_random_below(random, 4)];
    for (int i = 0; i < abs(step); i++) value = nextafter(value, step > 0 ? INFINITY : -INFINITY);
    return value;
}

/// Gives a portal whose length was rounded away the shortest there is.
static void keep_apart(oracle_portal *portal) {
    if (!same(portal->left, portal->right)) return;
    double *y = &portal->left.y;
    *y = *y == 0 ? 0x1p-52 : nextafter(*y, INFINITY);
}

/// Two points as a portal that the direction of travel crosses forwards, if it crosses it.
static oracle_portal facing(const plan *p, sl_point a, sl_point b) {
    const double forwards = (a.y - b.y) * p->step.x + (b.x - a.x) * p->step.y;
    return forwards > 0 ? (oracle_portal){a, b} : (oracle_portal){b, a};
}

static oracle_portal stairs_portal(plan *p) {
    const double on = 1 + below(p, 3), aside = below(p, 4), length = 1 + below(p, 3);
    if (chance(p, 2)) {
        p->front.x += on;
        return (oracle_portal){{p->front.x, p->front.y + aside + length},
                               {p->front.x, p->front.y + aside}};
    }
    p->front.y += on;
    return (oracle_portal){{p->front.x + aside, p->front.y},
                           {p->front.x + aside + length, p->front.y}};
}

static oracle_portal grid_portal(const plan *p) {
    sl_point a = {below(p, p->grid), below(p, p->grid)}, b = a;
    const uint64_t axis = sl_random_below(p->random, 4);
    while (same(a, b)) {
        if (axis != 0) b.y = below(p, p->grid);
        if (axis != 1) b.x = below(p, p->grid);
    }
    return facing(p, a, b);
}

static oracle_portal pool_portal(const plan *p) {
    const uint64_t first = sl_random_below(p->random, p->pool_count);
    const uint64_t second = (first + 1 + sl_random_below(p->random, p->pool_count - 1));
    return facing(p, p->pool[first], p->pool[second % p->pool_count]);
}

static sl_point on_line(const plan *p, double steps) {
    return (sl_point){p->origin.x + steps * p->step.x, p->origin.y + steps * p->step.y};
}

/// Pieces of one line across the direction of travel, and now and then a portal off it.
static oracle_portal collinear_portal(plan *p) {
    const sl_point along = {-p->step.y, p->step.x};
    sl_point ends[2];
    const double from = below(p, 8), length = 1 + below(p, 4);
    for (int i = 0; i < 2; i++) {
        const double at = from + i * length;
        ends[i] = (sl_point){p->origin.x + at * along.x, p->origin.y + at * along.y};
    }
    if (chance(p, 4)) ends[sl_random_below(p->random, 2)].x += chance(p, 2) ? 1 : -1;
    if (same(ends[0], ends[1])) ends[0].y += 1;
    return facing(p, ends[0], ends[1]);
}

/// One end on the line of travel, or a little beside it; the other at either side.
static oracle_portal grazing_portal(const plan *p, size_t number) {
    const bool integers = p->kind == RANDOM_GRAZING_INTEGERS;
    const double steps = (double)number + (integers ? below(p, 2) : sl_random_unit(p->random));
    sl_point touch = on_line(p, steps);
    if (chance(p, 3)) {
        double *moved = chance(p, 2) ? &touch.x : &touch.y;
        *moved = integers ? *moved + (chance(p, 2) ? 1 : -1) : nudged(p->random, *moved);
    }
    const bool left = chance(p, 2);
    // An end far enough to the other side, in any direction that is not the line's.
    const double aside = left ? -1 : 1, slant = integers ? below(p, 3) - 1 : spread(p);
    const double times = integers ? 1 + below(p, 3) : 0.01 + sl_random_unit(p->random);
    const sl_point other = {touch.x + times * (slant * p->step.x - aside * p->step.y),
                            touch.y + times * (slant * p->step.y + aside * p->step.x)};
    return left ? (oracle_portal){touch, other} : (oracle_portal){other, touch};
}

/// Gates across a corridor from 0 to 1, over a length of a million, opened to a multiple of a very
/// small number.
static oracle_portal corridor_portal(const plan *p, size_t number) {
    static const double grains[] = {0.25, 1e-3, 1e-7, 1e-10, 0x1p-40};
    const double x = ((double)number + sl_random_unit(p->random)) * (1e6 / RANDOM_PORTALS);
    const double grain = grains[sl_random_below(p->random, 5)];
    const double middle = 0.5 + (below(p, 7) - 3) * grain;
    const double top = chance(p, 2) ? 1 : middle, bottom = top == 1 ? middle : 0;
    return (oracle_portal){{x, top}, {chance(p, 4) ? x + spread(p) : x, bottom}};
}

static oracle_portal doors_portal(const plan *p, size_t number) {
    sl_point at = on_line(p, (double)number + sl_random_unit(p->random));
    const double slip = (below(p, 5) - 2) * 0.5e-9;
    at.x -= slip * p->step.y / 1e6;
    at.y += slip * p->step.x / 1e6;
    sl_point other = {at.x - 1e-9 * p->step.y / 1e6, at.y + 1e-9 * p->step.x / 1e6};
    return facing(p, at, other);
}

static oracle_portal next_portal(plan *p, size_t number) {
    switch (p->kind) {
    case RANDOM_STAIRS:
        return stairs_portal(p);
    case RANDOM_FEW_POINTS:
        return pool_portal(p);
    case RANDOM_COLLINEAR:
        return collinear_portal(p);
    case RANDOM_GRAZING_INTEGERS:
    case RANDOM_GRAZING:
        return grazing_portal(p, number);
    case RANDOM_CORRIDOR:
        return corridor_portal(p, number);
    case RANDOM_DOORS:
        return doors_portal(p, number);
    default:
        return grid_portal(p);
    }
}

static plan make_plan(sl_random *random, random_kind kind) {
    plan p = {.random = random, .kind = kind, .grid = 2 + sl_random_below(random, 7)};
    const bool large = kind == RANDOM_LARGE_GRID;
    if (large) p.grid = UINT64_C(2) << (4 + sl_random_below(random, 48));
    p.size = kind == RANDOM_DOORS ? 1e6 : 1;
    const bool integers = kind == RANDOM_GRAZING_INTEGERS || kind == RANDOM_COLLINEAR;
    const uint64_t reach =
        kind == RANDOM_COLLINEAR ? 4 : UINT64_C(2) << sl_random_below(random, 40);
    do {
        p.step = integers ? (sl_point){below(&p, reach), below(&p, reach)}
                          : (sl_point){spread(&p) * p.size, spread(&p) * p.size};
    } while (p.step.x == 0 && p.step.y == 0);
    p.origin = integers ? (sl_point){below(&p, 100), below(&p, 100)}
                        : (sl_point){spread(&p) * p.size, spread(&p) * p.size};
    for (p.pool_count = 0; p.pool_count < 3 + p.grid % 4;) {
        const sl_point one = {below(&p, 4), below(&p, 4)};
        bool fresh = true;
        for (uint64_t i = 0; i < p.pool_count; i++) fresh = fresh && !same(p.pool[i], one);
        if (fresh) p.pool[p.pool_count++] = one;
    }
    return p;
}

void random_sequence(sl_random *random, random_kind kind, random_portals *out) {
    plan p = make_plan(random, kind);
    const bool is_long = chance(&p, 32);
    out->count = is_long ? RANDOM_PORTALS : 2 + sl_random_below(random, 7);
    for (size_t i = 0; i < out->count; i++) {
        out->items[i] =
            i && chance(&p, 12) ? out->items[sl_random_below(random, i)] : next_portal(&p, i);
        // Grazing ends whose distance is rounded away.
        keep_apart(&out->items[i]);
    }
}

static sl_point *end_of(random_portals *portals, uint64_t number) {
    oracle_portal *portal = &portals->items[number / 2];
    return number % 2 ? &portal->right : &portal->left;
}

void random_placing(sl_random *random, random_portals *portals) {
    static const double shifts[] = {1e3, 1e9, 1e15, 0x1p52, -123456789.1};
    const uint64_t turns = sl_random_below(random, 8);
    const double scale =
        sl_random_below(random, 8) ? 1 : ldexp(1, (int)sl_random_below(random, 800) - 400);
    const bool shifted = sl_random_below(random, 8) == 0;
    const double dx = shifted ? shifts[sl_random_below(random, 5)] : 0;
    const double dy = shifted ? shifts[sl_random_below(random, 5)] : 0;
    for (size_t i = 0; i < portals->count; i++) {
        oracle_portal *portal = &portals->items[i];
        for (uint64_t k = 0; k < 2; k++) {
            sl_point *p = end_of(portals, 2 * i + k);
            if (turns & 1) *p = (sl_point){-p->y, p->x};
            if (turns & 2) *p = (sl_point){-p->x, -p->y};
            if (turns & 4) p->x = -p->x;
            *p = (sl_point){(p->x + dx) * scale, (p->y + dy) * scale};
        }
        if (turns & 4) *portal = (oracle_portal){portal->right, portal->left};
        if (same(portal->left, portal->right)) portal->left.y = nextafter(portal->left.y, INFINITY);
    }
}

/// Puts an end on the line through two others, as near as doubles come.
static void pinch(sl_random *random, random_portals *portals, sl_point *moved) {
    const sl_point a = *end_of(portals, sl_random_below(random, 2 * portals->count));
    const sl_point b = *end_of(portals, sl_random_below(random, 2 * portals->count));
    const double t = 3 * sl_random_unit(random) - 1;
    *moved = (sl_point){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

static void drop(random_portals *portals, size_t at) {
    portals->count--;
    for (size_t i = at; i < portals->count; i++) portals->items[i] = portals->items[i + 1];
}

void random_mutation(sl_random *random, random_portals *portals) {
    const uint64_t ends = 2 * portals->count, what = sl_random_below(random, 8);
    const uint64_t number = sl_random_below(random, ends);
    oracle_portal *portal = &portals->items[number / 2];
    sl_point *moved = end_of(portals, number);
    const oracle_portal before = *portal;
    if (what < 3) {
        double *value = sl_random_below(random, 2) ? &moved->x : &moved->y;
        *value = nudged(random, *value);
    } else if (what == 3) {
        pinch(random, portals, moved);
    } else if (what == 4) {
        *moved = *end_of(portals, sl_random_below(random, ends));
    } else if (what == 5 && portals->count > 2) {
        drop(portals, number / 2);
        return;
    } else if (what == 6 && portals->count < RANDOM_PORTALS) {
        portals->items[portals->count++] = before;
        return;
    } else {
        oracle_portal *other = &portals->items[sl_random_below(random, portals->count)];
        *portal = *other;
        *other = before;
        return;
    }
    if (same(portal->left, portal->right)) *portal = before;
}

sl_box oracle_bounds(const oracle_portal *portals, size_t count) {
    sl_box box = {portals[0].left, portals[0].left};
    for (size_t i = 0; i < 2 * count; i++) {
        const sl_point p = i % 2 ? portals[i / 2].right : portals[i / 2].left;
        box.min = (sl_point){fmin(box.min.x, p.x), fmin(box.min.y, p.y)};
        box.max = (sl_point){fmax(box.max.x, p.x), fmax(box.max.y, p.y)};
    }
    return box;
}

/// Whether one point sees another past walls that stop sight and walls that limit it: sight passes
/// one limited wall, not two. By the walls alone, no cell or portal is followed. Coordinates are
/// integers up to 2^13, so that all products are exact in 64 bits.
///
/// The way has a left and a right side. At each place where it meets walls, each side costs the
/// walls that lead off there: walls in one direction are one, and a wall that stops sight costs
/// all. Between such places one changes sides, at the cost of what lies along the way:
///
///            | limited                left:  1 at the first place, 1 at the second
///     p -----+=======+------- q       right: 0 at the first place, 1 at the second
///          limited / | limited        along: 1
///
/// The cheapest way counts. What meets the way at p or q costs nothing there. p is on no wall that
/// stops sight.
#ifndef SL_TESTS_LIMITED_POINTS_H
#define SL_TESTS_LIMITED_POINTS_H

#include "sightline/geometry.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

typedef struct limited_wall {
    int64_t ax, ay, bx, by;
    bool stops; ///< sight; else limits it
} limited_wall;

typedef struct limited_way {
    const limited_wall *walls;
    size_t count;
    int64_t px, py, qx, qy;
} limited_way;

enum { LIMITED_MANY = 1 << 20 };

/// A place on the way: the share `above` / `below` of it, `below` over 0.
typedef struct limited_place {
    int64_t above, below;
} limited_place;

static inline int64_t limited_side(const limited_way *w, int64_t x, int64_t y) {
    return (w->qx - w->px) * (y - w->py) - (w->qy - w->py) * (x - w->px);
}

static inline int64_t limited_along(const limited_way *w, int64_t x, int64_t y) {
    return (w->qx - w->px) * (x - w->px) + (w->qy - w->py) * (y - w->py);
}

static inline int limited_compare(const void *left, const void *right) {
    const limited_place *a = left, *b = right;
    const int64_t one = a->above * b->below, other = b->above * a->below;
    return (one > other) - (one < other);
}

/// Where a wall that does not lie along the way meets its line.
static inline bool limited_meets(const limited_way *w, const limited_wall *wall,
                                 limited_place *out) {
    const int64_t a = limited_side(w, wall->ax, wall->ay), b = limited_side(w, wall->bx, wall->by);
    if ((a == 0 && b == 0) || (a > 0 && b > 0) || (a < 0 && b < 0)) return false;
    // From p: the turn of the wall's line over the turn of the way against the wall.
    const int64_t dx = wall->bx - wall->ax, dy = wall->by - wall->ay;
    int64_t above = (wall->ax - w->px) * dy - (wall->ay - w->py) * dx;
    int64_t below = (w->qx - w->px) * dy - (w->qy - w->py) * dx;
    if (below < 0) {
        above = -above;
        below = -below;
    }
    *out = (limited_place){above, below};
    return true;
}

/// What a side of the way costs at a place: 1 left, -1 right.
static inline int64_t limited_cost(const limited_way *w, limited_place at, int side) {
    int64_t cost = 0;
    for (size_t i = 0; i < w->count; i++) {
        const limited_wall *wall = &w->walls[i];
        const int64_t a = limited_side(w, wall->ax, wall->ay) * side;
        const int64_t b = limited_side(w, wall->bx, wall->by) * side;
        limited_place place;
        if ((a <= 0 && b <= 0) || !limited_meets(w, wall, &place) || limited_compare(&place, &at))
            continue;
        if (wall->stops) return LIMITED_MANY;
        bool known = false;
        for (size_t k = 0; k < i; k++) {
            const limited_wall *one = &w->walls[k];
            const int64_t c = limited_side(w, one->ax, one->ay) * side;
            const int64_t d = limited_side(w, one->bx, one->by) * side;
            known |= (c > 0 || d > 0) && limited_meets(w, one, &place) &&
                     !limited_compare(&place, &at) &&
                     (one->bx - one->ax) * (wall->by - wall->ay) ==
                         (one->by - one->ay) * (wall->bx - wall->ax);
        }
        cost += !known;
    }
    return cost;
}

/// What it costs to change sides between two places that follow each other.
static inline int64_t limited_change(const limited_way *w, limited_place from, limited_place to) {
    const int64_t length = limited_along(w, w->qx, w->qy);
    int64_t cost = 0;
    for (size_t i = 0; i < w->count; i++) {
        const limited_wall *wall = &w->walls[i];
        if (limited_side(w, wall->ax, wall->ay) || limited_side(w, wall->bx, wall->by)) continue;
        limited_place a = {limited_along(w, wall->ax, wall->ay), length};
        limited_place b = {limited_along(w, wall->bx, wall->by), length};
        if (limited_compare(&a, &b) > 0) {
            const limited_place other = a;
            a = b;
            b = other;
        }
        if (limited_compare(&a, &from) > 0 || limited_compare(&b, &to) < 0) continue;
        if (wall->stops) return LIMITED_MANY;
        cost = 1;
    }
    return cost;
}

/// Lists the places between p and `until`, in order. `out` has room for two a wall.
static inline size_t limited_places(const limited_way *w, limited_place until, limited_place *out) {
    const int64_t length = limited_along(w, w->qx, w->qy);
    const limited_place p = {0, 1};
    size_t count = 0;
    for (size_t i = 0; i < w->count; i++) {
        const limited_wall *wall = &w->walls[i];
        limited_place at[2] = {{limited_along(w, wall->ax, wall->ay), length},
                               {limited_along(w, wall->bx, wall->by), length}};
        const bool flat =
            !limited_side(w, wall->ax, wall->ay) && !limited_side(w, wall->bx, wall->by);
        if (!flat && !limited_meets(w, wall, &at[0])) continue;
        for (int k = 0; k < (flat ? 2 : 1); k++)
            if (limited_compare(&at[k], &p) > 0 && limited_compare(&at[k], &until) < 0)
                out[count++] = at[k];
    }
    if (count) qsort(out, count, sizeof *out, limited_compare);
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (!kept || limited_compare(&out[kept - 1], &out[i])) out[kept++] = out[i];
    return kept;
}

/// How many limited walls the way passes at least up to a place; LIMITED_MANY or more for one that
/// stops sight.
static inline int64_t limited_passed_until(const limited_way *w, limited_place until) {
    limited_place *places = malloc((2 * w->count + 1) * sizeof *places);
    if (!places) abort();
    const size_t count = limited_places(w, until, places);
    int64_t left = 0, right = 0;
    limited_place last = {0, 1};
    for (size_t i = 0; i <= count; i++) {
        const limited_place next = i < count ? places[i] : until;
        const int64_t change = limited_change(w, last, next);
        if (left > right + change) left = right + change;
        if (right > left + change) right = left + change;
        if (i < count) left += limited_cost(w, next, 1);
        if (i < count) right += limited_cost(w, next, -1);
        last = next;
    }
    free(places);
    return left < right ? left : right;
}

/// The same all the way.
static inline int64_t limited_passed(const limited_way *w) {
    if (w->px == w->qx && w->py == w->qy) return 0;
    return limited_passed_until(w, (limited_place){1, 1});
}

/// Whether a point has a common point with the closed way's walls that stop sight: open sight is
/// stopped by them.
static inline bool limited_touches(const limited_way *w) {
    const limited_place p = {0, 1}, q = {1, 1};
    const int64_t length = limited_along(w, w->qx, w->qy);
    for (size_t i = 0; i < w->count && length; i++) {
        const limited_wall *wall = &w->walls[i];
        limited_place a, b;
        if (!wall->stops) continue;
        if (!limited_side(w, wall->ax, wall->ay) && !limited_side(w, wall->bx, wall->by)) {
            a = (limited_place){limited_along(w, wall->ax, wall->ay), length};
            b = (limited_place){limited_along(w, wall->bx, wall->by), length};
            if (limited_compare(&a, &b) > 0) {
                const limited_place other = a;
                a = b;
                b = other;
            }
        } else if (limited_meets(w, wall, &a)) {
            b = a;
        } else {
            continue;
        }
        if (limited_compare(&a, &q) <= 0 && limited_compare(&b, &p) >= 0) return true;
    }
    return false;
}

#endif

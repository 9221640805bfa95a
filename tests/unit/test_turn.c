/// The sign of a turn between two directions, and that of points finer than doubles, against GMP's
/// rationals; and the rule of crossings, against all directions there are to try.
#include "testing.h"

#include "cell_to_cell/search/directions.h"
#include "sightline/support.h"

#include <gmp.h>
#include <math.h>

static int sign(int value) {
    return (value > 0) - (value < 0);
}

/// b - a as rationals.
static void difference(mpq_t out, double a, double b) {
    mpq_t from;
    mpq_init(from);
    mpq_set_d(from, a);
    mpq_set_d(out, b);
    mpq_sub(out, out, from);
    mpq_clear(from);
}

static int rational_turn(sl_point a, sl_point b, sl_point c, sl_point d) {
    mpq_t ux, uy, vx, vy;
    mpq_inits(ux, uy, vx, vy, NULL);
    difference(ux, a.x, b.x);
    difference(uy, a.y, b.y);
    difference(vx, c.x, d.x);
    difference(vy, c.y, d.y);
    mpq_mul(ux, ux, vy);
    mpq_mul(uy, uy, vx);
    const int result = sign(mpq_cmp(ux, uy));
    mpq_clears(ux, uy, vx, vy, NULL);
    return result;
}

static void check(sl_point a, sl_point b, sl_point c, sl_point d) {
    const int expected = rational_turn(a, b, c, d);
    assert_int_equal(sli_turn(a, b, c, d), expected);
    assert_int_equal(sli_turn_exact(a, b, c, d), expected);
    assert_int_equal(sli_turn(c, d, a, b), -expected);
    assert_int_equal(sli_turn(b, a, c, d), -expected);
}

static double random_double(sl_random *random, int lowest, int highest) {
    const double share = (double)(sl_random_next(random) >> 11) * 0x1p-53 + 1;
    const int exponent = lowest + (int)(sl_random_next(random) % (unsigned)(highest - lowest + 1));
    return ldexp(sl_random_next(random) & 1 ? -share : share, exponent);
}

static void any_directions_are_told(void **state) {
    (void)state;
    sl_random random = {7};
    const int ranges[][2] = {{0, 0}, {-3, 3}, {-300, 300}, {-498, -490}, {490, 498}};
    for (size_t range = 0; range < sizeof ranges / sizeof *ranges; range++)
        for (int i = 0; i < 4000; i++) {
            sl_point p[4];
            for (int k = 0; k < 4; k++) {
                p[k].x = random_double(&random, ranges[range][0], ranges[range][1]);
                p[k].y = random_double(&random, ranges[range][0], ranges[range][1]);
            }
            // Every so often the same direction, or all but the same.
            if (i % 4 == 1) p[2] = p[0], p[3] = p[1];
            if (i % 4 == 2) p[2] = p[0], p[3] = (sl_point){p[1].x, nextafter(p[1].y, INFINITY)};
            if (i % 8 == 3) p[1].x = p[0].x;
            if (i % 16 == 7) p[3].x = p[2].x;
            check(p[0], p[1], p[2], p[3]);
        }
}

/// b - a of fine numbers as rationals.
static void fine_difference(mpq_t out, double a, double a_rest, double b, double b_rest) {
    mpq_t rest;
    mpq_init(rest);
    difference(out, a, b);
    difference(rest, a_rest, b_rest);
    mpq_add(out, out, rest);
    mpq_clear(rest);
}

static int rational_orient(const sli_fine *a, const sli_fine *b, const sli_fine *c) {
    mpq_t ux, uy, vx, vy;
    mpq_inits(ux, uy, vx, vy, NULL);
    fine_difference(ux, a->at.x, a->rest.x, b->at.x, b->rest.x);
    fine_difference(uy, a->at.y, a->rest.y, b->at.y, b->rest.y);
    fine_difference(vx, a->at.x, a->rest.x, c->at.x, c->rest.x);
    fine_difference(vy, a->at.y, a->rest.y, c->at.y, c->rest.y);
    mpq_mul(ux, ux, vy);
    mpq_mul(uy, uy, vx);
    const int result = sign(mpq_cmp(ux, uy));
    mpq_clears(ux, uy, vx, vy, NULL);
    return result;
}

/// A rest of few bits, so that two of them can make up for each other.
static double random_rest(sl_random *random, double at) {
    return ldexp((double)sl_random_below(random, 9) - 4, ilogb(at) - 56);
}

static void fine_points_are_told(void **state) {
    (void)state;
    sl_random random = {13};
    int on_line = 0;
    for (int i = 0; i < 20000; i++) {
        // Points of the diagonal, or of a line a little off it: only the rests, and then only
        // their products, tell.
        sli_fine p[3];
        for (int k = 0; k < 3; k++) {
            const double at = 1 + (double)sl_random_below(&random, 4) / 4;
            p[k].at = (sl_point){at, at};
            p[k].rest = (sl_point){random_rest(&random, at), random_rest(&random, at)};
            if (i % 4 == 0) p[k].rest.y = p[k].rest.x;
            if (i % 4 == 1) p[k].at = (sl_point){1, 1};
        }
        const int expected = rational_orient(&p[0], &p[1], &p[2]);
        on_line += expected == 0;
        assert_int_equal(sli_orient_fine(&p[0], &p[1], &p[2]), expected);
        assert_int_equal(sli_orient_fine(&p[1], &p[0], &p[2]), -expected);
    }
    assert_true(on_line > 5000 && on_line < 10000);
}

enum { DIRECTIONS = 720 };

/// Whether one of many directions crosses all portals strictly forwards. Portals turn by whole
/// degrees, so that half degrees find any way there is.
static bool some_direction_crosses(const int *degrees, int count) {
    for (int i = 0; i < DIRECTIONS; i++) {
        bool all = true;
        for (int k = 0; k < count && all; k++) {
            // Forwards is the quarter turn to the right of the portal's own direction.
            const int beside = ((i - 2 * (degrees[k] - 90)) % DIRECTIONS + DIRECTIONS) % DIRECTIONS;
            all = beside < DIRECTIONS / 4 || beside > DIRECTIONS * 3 / 4;
        }
        if (all) return true;
    }
    return false;
}

static void crossings_are_those_of_some_direction(void **state) {
    (void)state;
    sl_random random = {11};
    // Directions whose turns doubles tell exactly: the axes and the diagonals.
    static const struct {
        int degrees;
        double x, y;
    } ways[] = {{0, 1, 0},  {90, 0, 1},   {180, -1, 0},  {270, 0, -1},
                {45, 1, 1}, {135, -1, 1}, {225, -1, -1}, {315, 1, -1}};
    sl_directed_portal directed[5];
    const sl_space space = {.directed = directed};
    for (int i = 0; i < 20000; i++) {
        int degrees[5];
        sli_directions crossings = SLI_NO_DIRECTIONS;
        for (int k = 0; k < 5; k++) {
            const uint64_t way = sl_random_next(&random) % 8;
            const sl_point at = {random_double(&random, 0, 0), random_double(&random, 0, 0)};
            const double size = ldexp(1, (int)(sl_random_next(&random) % 3));
            degrees[k] = ways[way].degrees;
            directed[k].right =
                (sl_point){ldexp(round(ldexp(at.x, 8)), -8), ldexp(round(ldexp(at.y, 8)), -8)};
            directed[k].left = (sl_point){directed[k].right.x + size * ways[way].x,
                                          directed[k].right.y + size * ways[way].y};
            const bool some = some_direction_crosses(degrees, k + 1);
            assert_int_equal(sli_directions_add(&space, &crossings, (uint32_t)k), some);
            if (!some) break;
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_directions_are_told),
        cmocka_unit_test(fine_points_are_told),
        cmocka_unit_test(crossings_are_those_of_some_direction),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

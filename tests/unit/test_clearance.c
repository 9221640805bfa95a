/// Clearances among slivers: long walls a hair apart. They are those of a plain search over all
/// walls, take few steps however many channels there are, and end when they are told to.
#include "space/clearance.h"
#include "testing.h"

#include "geometry/length.h"
#include "sightline/space.h"

#include <limits.h>
#include <math.h>

/// Long walls that are nearly parallel, in a hall that is turned.
static void make_slivers(sl_context *context, int count, double hair, double degrees, sl_map *map) {
    const double angle = degrees * acos(-1) / 180, cos_a = cos(angle), sin_a = sin(angle);
    const sl_point hall[] = {{0, 0}, {100, 0.37}, {100, 100}, {0, 99}, {0, 0}};
    *map = (sl_map){0};
    for (int i = 0; i < count + 4; i++) {
        sl_point a, b;
        if (i < 4) {
            a = hall[i];
            b = hall[i + 1];
        } else {
            const double y = 10 + hair * (i - 4);
            a = (sl_point){10 + 1e-3 * (i % 3), y};
            b = (sl_point){90 + 1e-3 * (i % 5), y + hair / 100 * (i % 3)};
        }
        a = (sl_point){cos_a * a.x - sin_a * a.y, sin_a * a.x + cos_a * a.y};
        b = (sl_point){cos_a * b.x - sin_a * b.y, sin_a * b.x + cos_a * b.y};
        assert_ok(context, sl_map_add_wall(context, map, a, b, 0));
    }
    assert_ok(context, sl_map_clean(context, map, NULL, NULL));
}

typedef struct scene {
    testing_memory memory;
    sl_context *context;
    sl_map map;
    sli_channels channels;
    sli_clearance clearance;
} scene;

static void open_scene(int count, double hair, double degrees, scene *s) {
    *s = (scene){0};
    s->context = testing_context(&s->memory);
    make_slivers(s->context, count, hair, degrees, &s->map);
    assert_ok(s->context, sli_channels_make(s->context, &s->map, 30, &s->channels));
    assert_ok(s->context, sli_clearance_make(s->context, &s->channels, &s->clearance));
}

static void close_scene(scene *s) {
    sli_clearance_destroy(&s->clearance);
    sli_channels_destroy(s->context, &s->channels);
    sl_map_destroy(s->context, &s->map);
    sl_context_destroy(s->context);
    assert_int_equal(s->memory.live, 0);
}

/// The distance to the nearest of all walls.
static double plain(const scene *s, sl_point p) {
    double best = INFINITY;
    for (size_t i = 0; i < s->map.wall_count; i++) {
        const sl_point a = s->map.walls[i].a, b = s->map.walls[i].b;
        const double x = b.x - a.x, y = b.y - a.y, square = x * x + y * y;
        double share = ((p.x - a.x) * x + (p.y - a.y) * y) / square;
        share = fmin(1, fmax(0, share));
        best = fmin(best, hypot(p.x - a.x - share * x, p.y - a.y - share * y));
    }
    return best;
}

enum { ROUNDING = 46 }; ///< bits below 100 at which places, feet and distances are rounded

static bool is_same(double a, double b) {
    return fabs(a - b) <= ldexp(100, -ROUNDING);
}

/// Measures in all triangles; the steps for each.
static double measure(scene *s, int each) {
    const sli_triangulation *t = &s->channels.triangles;
    size_t asked = 0;
    for (uint32_t half = 0; half < t->halves.count; half++) {
        if (sli_half_is_outside(t, half)) continue;
        sl_point place;
        double found, more;
        assert_ok(s->context, sli_clearance_of(&s->clearance, half, -1, &place, &found));
        if (asked++ % (size_t)each || found < 0) continue;
        assert_true(is_same(found, plain(s, place)));
        // By what it must be above: the same, or nothing.
        const sl_point before = place;
        assert_ok(s->context, sli_clearance_of(&s->clearance, half, found / 2, &place, &more));
        assert_true(more == found && place.x == before.x && place.y == before.y);
        assert_ok(s->context, sli_clearance_of(&s->clearance, half, found, &place, &more));
        assert_true(more == -1 && place.x == before.x && place.y == before.y);
    }
    return (double)s->clearance.steps / (double)asked;
}

static void test_nearest(void **state) {
    (void)state;
    const double turns[] = {0, 17.3};
    for (int i = 0; i < 2; i++) {
        scene s;
        open_scene(60, 0.1, turns[i], &s);
        measure(&s, 7);
        close_scene(&s);
    }
}

/// Steps for each triangle grow by less than the square root of the number of walls, though there
/// are more and more channels around.
static void test_steps(void **state) {
    (void)state;
    const double turns[] = {0, 17.3};
    for (int i = 0; i < 2; i++) {
        double before = INFINITY;
        for (int count = 25; count <= 400; count *= 4) {
            scene s;
            open_scene(count, 80.0 / count, turns[i], &s);
            const double steps = measure(&s, 1000);
            assert_true(steps > 1 && steps < 2 * before);
            before = steps;
            close_scene(&s);
        }
    }
}

/// What is found has the clearance; where nothing is found, no place of a lattice has it and 1/16.
static void test_places(void **state) {
    (void)state;
    scene s;
    open_scene(30, 0.05, 17.3, &s);
    const sli_triangulation *t = &s.channels.triangles;
    const double shares[] = {0.01, 0.3, 0.9, 1.02, 1.5};
    size_t yes = 0, no = 0;
    for (uint32_t half = 0; half < t->halves.count; half += 11) {
        if (sli_half_is_outside(t, half)) continue;
        const uint32_t second = t->halves.items[half].next, third = t->halves.items[second].next;
        const sl_point a = t->points.items[t->halves.items[half].from];
        const sl_point b = t->points.items[t->halves.items[second].from];
        const sl_point c = t->points.items[t->halves.items[third].from];
        double most = 0;
        for (int i = 0; i <= 24; i++)
            for (int k = 0; i + k <= 24; k++) {
                const double u = i / 24.0, v = k / 24.0, w = 1 - u - v;
                most = fmax(most, plain(&s, (sl_point){u * a.x + v * b.x + w * c.x,
                                                       u * a.y + v * b.y + w * c.y}));
            }
        for (size_t i = 0; i < sizeof shares / sizeof *shares; i++) {
            const double wanted = shares[i] * most;
            sl_point place;
            bool found;
            assert_ok(s.context, sli_clearance_reaches(&s.clearance, half, wanted, &place, &found));
            if (found) assert_true(plain(&s, place) >= wanted - ldexp(100, -ROUNDING));
            if (!found) assert_true(most < wanted * (1 + 1.0 / 16) + ldexp(100, -ROUNDING));
            yes += found;
            no += !found;
        }
    }
    assert_true(yes > 100 && no > 100);
    assert_int_equal(s.clearance.cut_short, 0);
    close_scene(&s);
}

/// Gaps a little too narrow, thousands of times as long: the search for places ends, without giving
/// up one.
static void test_long(void **state) {
    (void)state;
    scene s;
    open_scene(30, 0.05, 17.3, &s);
    const sli_triangulation *t = &s.channels.triangles;
    const double wanted = 0.49 * 0.05;
    for (uint32_t half = 0; half < t->halves.count; half += 5) {
        sl_point place;
        bool found;
        if (sli_half_is_outside(t, half)) continue;
        assert_ok(s.context, sli_clearance_reaches(&s.clearance, half, wanted, &place, &found));
        if (found) assert_true(plain(&s, place) >= wanted - ldexp(100, -ROUNDING));
    }
    assert_true(s.clearance.steps < 32000000);
    assert_int_equal(s.clearance.cut_short, 0);
    close_scene(&s);
}

/// Asks whether to go on are counted; the one numbered `most` is answered by no.
typedef struct patience {
    unsigned long asked, most;
} patience;

static bool is_over(void *user) {
    patience *p = user;
    return p->asked++ >= p->most;
}

/// The search for what is inside ends at each question, leaves the map as it was, and asks often.
static void test_cancelled(void **state) {
    (void)state;
    patience p = {.most = ULONG_MAX};
    const sl_hooks hooks = {.user = &p, .cancelled = is_over};
    sl_context *context = sl_context_create(&hooks);
    sl_map map;
    make_slivers(context, 200, 0.4, 17.3, &map);
    p.asked = 0;
    assert_ok(context, sl_map_find_inside(context, &map, NULL, NULL));
    const unsigned long asked = p.asked;
    assert_true(asked > 20);
    for (unsigned long most = 0; most < asked; most += 1 + asked / 20) {
        p = (patience){.most = most};
        assert_int_equal(sl_map_find_inside(context, &map, NULL, NULL), SL_CANCELLED);
        assert_int_equal(p.asked, most + 1);
        assert_int_equal(map.seam_count, 0);
    }
    sli_channels channels;
    sli_clearance clearance;
    p.most = ULONG_MAX;
    assert_ok(context, sli_channels_make(context, &map, 30, &channels));
    assert_ok(context, sli_clearance_make(context, &channels, &clearance));
    p.asked = 0;
    for (uint32_t half = 0; half < channels.triangles.halves.count; half++) {
        sl_point place;
        double found;
        if (!sli_half_is_outside(&channels.triangles, half))
            assert_ok(context, sli_clearance_of(&clearance, half, -1, &place, &found));
    }
    assert_true(clearance.steps > 1000000 && p.asked > clearance.steps / 100000);
    sli_clearance_destroy(&clearance);
    sli_channels_destroy(context, &channels);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nearest),   cmocka_unit_test(test_steps),
        cmocka_unit_test(test_places),    cmocka_unit_test(test_long),
        cmocka_unit_test(test_cancelled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

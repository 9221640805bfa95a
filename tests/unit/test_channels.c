/// Channels are the narrow places between walls: none is missing of those that a plain search over
/// all pairs of walls finds. In crowded plans no wall is in the circle over one, and there are few
/// of them however finely round walls are drawn.
#include "space/channels.h"
#include "testing.h"

#include "geometry/length.h"
#include "sightline/space.h"

#include <math.h>

/// How much nearer than the radius a wall may be, by rounding, that touches a circle.
#define TOUCHES 0x1p-19

typedef struct scene {
    testing_memory memory;
    sl_context *context;
    sl_map map;
    sli_channels channels;
} scene;

static void open_scene(scene *s) {
    *s = (scene){0};
    s->context = testing_context(&s->memory);
}

static void find_channels(double most, scene *s) {
    assert_ok(s->context, sl_map_clean(s->context, &s->map, NULL, NULL));
    assert_ok(s->context, sli_channels_make(s->context, &s->map, most, &s->channels));
}

static void close_scene(scene *s) {
    sli_channels_destroy(s->context, &s->channels);
    sl_map_destroy(s->context, &s->map);
    sl_context_destroy(s->context);
    assert_int_equal(s->memory.live, 0);
}

static void add_wall(scene *s, sl_point a, sl_point b) {
    assert_ok(s->context, sl_map_add_wall(s->context, &s->map, a, b, 0));
}

/// A ring of so many walls.
static void add_ring(scene *s, sl_point middle, double radius, int count) {
    const double step = 2 * acos(-1) / count;
    for (int i = 0; i < count; i++)
        add_wall(s,
                 (sl_point){middle.x + radius * cos(i * step), middle.y + radius * sin(i * step)},
                 (sl_point){middle.x + radius * cos((i + 1) % count * step),
                            middle.y + radius * sin((i + 1) % count * step)});
}

/// Short walls at random, some of which cross.
static void add_walls_at_random(scene *s, int count, uint64_t seed) {
    sl_random random = {seed};
    for (int i = 0; i < count; i++) {
        const sl_point a = {100 * sl_random_unit(&random), 100 * sl_random_unit(&random)};
        add_wall(s, a,
                 (sl_point){a.x + 40 * sl_random_unit(&random) - 20,
                            a.y + 40 * sl_random_unit(&random) - 20});
    }
}

/// How near the nearest wall comes to the middle of a pair of places, by its radius.
static double room_of(const scene *s, sl_segment pair) {
    const sl_point middle = {(pair.a.x + pair.b.x) / 2, (pair.a.y + pair.b.y) / 2};
    const double radius = hypot(pair.b.x - pair.a.x, pair.b.y - pair.a.y) / 2;
    double best = INFINITY;
    for (size_t i = 0; i < s->map.wall_count; i++) {
        const sl_wall *w = &s->map.walls[i];
        const double x = w->b.x - w->a.x, y = w->b.y - w->a.y;
        double share = ((middle.x - w->a.x) * x + (middle.y - w->a.y) * y) / (x * x + y * y);
        share = fmin(1, fmax(0, share));
        best = fmin(best, hypot(middle.x - w->a.x - share * x, middle.y - w->a.y - share * y));
    }
    return best / radius;
}

static bool is_listed(const scene *s, sl_segment pair) {
    for (size_t i = 0; i < s->channels.items.count; i++) {
        const sl_segment own = s->channels.items.items[i].at;
        const double there = hypot(own.a.x - pair.a.x, own.a.y - pair.a.y) +
                             hypot(own.b.x - pair.b.x, own.b.y - pair.b.y);
        const double back = hypot(own.a.x - pair.b.x, own.a.y - pair.b.y) +
                            hypot(own.b.x - pair.a.x, own.b.y - pair.a.y);
        if (fmin(there, back) < 1e-9) return true;
    }
    return false;
}

/// Looks for a pair in the list, if it is a channel. Returns whether it is one.
static bool check_pair(const scene *s, sl_point p, sl_point q, double most) {
    const double width = hypot(p.x - q.x, p.y - q.y);
    if (width < 1e-6 || width > most * (1 - TOUCHES)) return false;
    if (room_of(s, (sl_segment){p, q}) < 1 - 1e-9) return false;
    assert_true(is_listed(s, (sl_segment){p, q}));
    return true;
}

/// Checks the list by all pairs of an end with an end, and with a foot.
static size_t check_all(const scene *s, double most) {
    size_t found = 0;
    for (size_t i = 0; i < 2 * s->map.wall_count; i++) {
        const sl_wall *own = &s->map.walls[i / 2];
        const sl_point p = i % 2 ? own->b : own->a;
        for (size_t k = 0; k < s->map.wall_count; k++) {
            const sl_wall *w = &s->map.walls[k];
            const double x = w->b.x - w->a.x, y = w->b.y - w->a.y;
            const double share = ((p.x - w->a.x) * x + (p.y - w->a.y) * y) / (x * x + y * y);
            found += check_pair(s, p, w->a, most);
            found += check_pair(s, p, w->b, most);
            if (share > 1e-9 && share < 1 - 1e-9)
                found += check_pair(s, p, (sl_point){w->a.x + share * x, w->a.y + share * y}, most);
        }
    }
    return found;
}

static void none_is_missing(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        scene s;
        open_scene(&s);
        add_walls_at_random(&s, 24, seed);
        if (seed % 2) add_ring(&s, (sl_point){50, 50}, 13, 40);
        find_channels(30, &s);
        assert_true(check_all(&s, 30) > 10);
        close_scene(&s);
    }
}

/// Round pillars in round halls, with walls at random among them: thousands of places look narrow.
static void crowded_plans_have_true_channels_alone(void **state) {
    (void)state;
    for (int walls = 800; walls <= 3200; walls *= 2) {
        scene s;
        open_scene(&s);
        add_ring(&s, (sl_point){0, 0}, 300, walls);
        add_ring(&s, (sl_point){-80, 3}, 50, walls);
        add_ring(&s, (sl_point){80, 7}, 50, walls);
        add_walls_at_random(&s, 400, (uint64_t)walls);
        find_channels(600, &s);
        for (size_t i = 0; i < s.channels.items.count; i++)
            assert_true(room_of(&s, s.channels.items.items[i].at) >= 1 - TOUCHES);
        // Across a ring all pairs of opposite corners are nearly as wide.
        assert_in_range(s.channels.items.count, 100, 3 * walls + 8 * s.map.wall_count / 4);
        assert_in_range(s.channels.triangles.halves.count, 1, 60 * s.map.wall_count);
        close_scene(&s);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(none_is_missing),
        cmocka_unit_test(crowded_plans_have_true_channels_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/// The two node visibility tests beside a brute-force search of directions in whole numbers, and
/// beside each other.
#include "testing.h"

#include "oracle/random_map.h"
#include "sightline/walk.h"
#include "study/walk/shape.h"

#include <math.h>

enum { MOST_DIRECTIONS = 400 };

/// A direction, or a point, in whole numbers: coordinates are multiples of a half.
typedef struct whole {
    int64_t x, y;
} whole;

static whole whole_of(sl_point p, sl_point eye) {
    return (whole){(int64_t)(2 * (p.x - eye.x)), (int64_t)(2 * (p.y - eye.y))};
}

static int64_t cross(whole a, whole b) {
    return a.x * b.y - a.y * b.x;
}

static bool upper(whole a) {
    return a.y > 0 || (a.y == 0 && a.x > 0);
}

static int by_direction(const void *left, const void *right) {
    const whole *a = left, *b = right;
    if (upper(*a) != upper(*b)) return upper(*a) ? -1 : 1;
    const int64_t turn = cross(*a, *b);
    return turn > 0 ? -1 : turn < 0;
}

/// A share of a direction's length: n / d, d > 0.
typedef struct share {
    int64_t n, d;
} share;

static bool less(share a, share b) {
    return a.n * b.d < b.n * a.d;
}

static share share_of(int64_t n, int64_t d) {
    return d < 0 ? (share){-n, -d} : (share){n, d};
}

typedef struct scene {
    sl_point eye;
    sl_box box;
    sl_segment walls[24];
    int wall_count;
    whole directions[MOST_DIRECTIONS];
    int direction_count;
} scene;

static void add_direction(scene *s, whole d) {
    assert_true(s->direction_count < MOST_DIRECTIONS);
    if (d.x || d.y) s->directions[s->direction_count++] = d;
}

/// Where anything can change: at walls' ends, the box's corners, and where walls' lines cross the
/// box's sides.
static void gather_directions(scene *s) {
    s->direction_count = 0;
    const double xs[2] = {s->box.min.x, s->box.max.x}, ys[2] = {s->box.min.y, s->box.max.y};
    for (int i = 0; i < 4; i++) {
        add_direction(s, whole_of((sl_point){xs[i % 2], ys[i / 2]}, s->eye));
        add_direction(s, (whole){i == 0 ? 1 : i == 1 ? -1 : 0, i == 2 ? 1 : i == 3 ? -1 : 0});
    }
    for (int i = 0; i < s->wall_count; i++) {
        const sl_segment *w = &s->walls[i];
        add_direction(s, whole_of(w->a, s->eye));
        add_direction(s, whole_of(w->b, s->eye));
        for (int k = 0; k < 2; k++)
            add_direction(s, w->a.x == w->b.x ? whole_of((sl_point){w->a.x, ys[k]}, s->eye)
                                              : whole_of((sl_point){xs[k], w->a.y}, s->eye));
    }
    qsort(s->directions, (size_t)s->direction_count, sizeof *s->directions, by_direction);
}

/// What of the ray, strictly inside the box, is before the first wall, and behind it.
static unsigned along(const scene *s, whole d) {
    const whole low = whole_of(s->box.min, s->eye), high = whole_of(s->box.max, s->eye);
    const int64_t way[2] = {d.x, d.y}, from[2] = {low.x, low.y}, to[2] = {high.x, high.y};
    share in = {0, 1}, out = {1, 0};
    for (int axis = 0; axis < 2; axis++) {
        if (!way[axis]) {
            if (from[axis] >= 0 || to[axis] <= 0) return 0;
            continue;
        }
        const share a = share_of(from[axis], way[axis]), b = share_of(to[axis], way[axis]);
        const share near = less(a, b) ? a : b, far = less(a, b) ? b : a;
        if (less(in, near)) in = near;
        if (less(far, out)) out = far;
    }
    if (!less(in, out)) return 0;
    share wall = {1, 0};
    for (int i = 0; i < s->wall_count; i++) {
        const whole a = whole_of(s->walls[i].a, s->eye), b = whole_of(s->walls[i].b, s->eye);
        if (cross(d, a) * cross(d, b) >= 0) continue;
        const bool upright = a.x == b.x;
        const share at = share_of(upright ? a.x : a.y, upright ? d.x : d.y);
        if (at.n > 0 && less(at, wall)) wall = at;
    }
    return (less(in, wall) ? SLI_BEFORE : 0) | (less(wall, out) ? SLI_BEHIND : 0);
}

static unsigned brute_force(scene *s) {
    unsigned bits = 0;
    gather_directions(s);
    for (int i = 0; i < s->direction_count; i++) {
        const whole a = s->directions[i], b = s->directions[(i + 1) % s->direction_count];
        if (cross(a, b) > 0) bits |= along(s, (whole){a.x + b.x, a.y + b.y});
    }
    return bits;
}

static void fill(sl_context *context, const scene *s, const sli_node_test_calls *test,
                 sli_occlusion *o) {
    sli_shadows *shadows = &o->shadows;
    shadows->pivot = (sli_pivot){.eye = s->eye};
    shadows->occluders.count = shadows->shadows.count = 0;
    assert_ok(context, test->clear(context, o, s->eye));
    for (int i = 0; i < s->wall_count; i++) {
        const sl_segment *w = &s->walls[i];
        const int side = sli_orient(w->a, w->b, s->eye);
        if (!side) continue;
        const sli_occluder occluder =
            side > 0 ? (sli_occluder){w->a, w->b} : (sli_occluder){w->b, w->a};
        assert_ok(context, SL_ARRAY_ROOM(context, &shadows->occluders, 1));
        shadows->occluders.items[shadows->occluders.count++] = occluder;
        const sli_wedge wedge = {sli_ray_to(occluder.a), sli_ray_to(occluder.b)};
        bool added = false;
        assert_ok(context,
                  test->add(context, o, (uint32_t)shadows->occluders.count - 1, &wedge, &added));
    }
}

static unsigned query(const scene *s, const sli_node_test_calls *test, sli_occlusion *o) {
    const sl_box *b = &s->box;
    const sl_point corners[4] = {b->min, {b->max.x, b->min.y}, b->max, {b->min.x, b->max.y}};
    const sli_shape shape = {corners, 4, *b, true};
    sli_wedge wedges[4];
    unsigned bits = 0;
    const uint32_t count = sli_shape_wedges(&o->shadows.pivot, &shape, wedges);
    for (uint32_t i = 0; i < count; i++) test->query(o, &shape, &wedges[i], &bits);
    return bits;
}

static void free_occlusion(sl_context *context, const sli_node_test_calls *test, sli_occlusion *o) {
    sl_free(context, o->shadows.occluders.items);
    sl_free(context, o->shadows.shadows.items);
    test->destroy(context, o);
}

static double half(sl_random *random, uint64_t size) {
    return (double)sl_random_below(random, 2 * size + 1) / 2;
}

static void random_scene(sl_random *random, bool disjoint, scene *s) {
    const uint64_t size = 4 + sl_random_below(random, 10);
    s->wall_count = 0;
    const int wanted = 1 + (int)sl_random_below(random, 14);
    for (int i = 0; i < wanted; i++) {
        const bool upright = sl_random_below(random, 2);
        // Disjoint walls: each in a strip of its own, touching at most.
        const double line = disjoint ? i / 2. : half(random, size);
        const double from = half(random, size), to = from + half(random, 4) + 0.5;
        const sl_segment across = {{line, from}, {line, to}}, level = {{from, line}, {to, line}};
        s->walls[s->wall_count++] = disjoint || upright ? across : level;
    }
    s->eye = (sl_point){half(random, size), half(random, size)};
    if (sl_random_below(random, 16) == 0) s->eye.x += 1 << 20;
    s->box.min = (sl_point){half(random, size), half(random, size)};
    s->box.max.x = s->box.min.x + 0.5 + half(random, 4);
    s->box.max.y = s->box.min.y + 0.5 + half(random, 4);
}

/// Walls that cross are allowed to make a test say too much, never too little.
static void as_brute_force_says(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    size_t test_count;
    const sl_node_test *tests = sl_node_tests(&test_count);
    sli_occlusion *occlusions[4];
    for (size_t t = 0; t < test_count; t++)
        assert_ok(context, tests[t].calls->create(context, &occlusions[t]));
    sl_random random = {10};
    int seen[4] = {0}, loose = 0;
    for (int round = 0; round < 60000; round++) {
        scene s;
        const bool disjoint = round % 2;
        random_scene(&random, disjoint, &s);
        const unsigned due = brute_force(&s);
        assert_true(due);
        seen[due]++;
        unsigned first = 0;
        for (size_t t = 0; t < test_count; t++) {
            fill(context, &s, tests[t].calls, occlusions[t]);
            const unsigned found = query(&s, tests[t].calls, occlusions[t]);
            if (disjoint && found != due)
                fail_msg("round %d, %s: %u, brute force %u", round, tests[t].name, found, due);
            if ((found & due) != due)
                fail_msg("round %d, %s: %u misses some of %u", round, tests[t].name, found, due);
            loose += found != due;
            if (t) assert_int_equal(found, first);
            first = found;
        }
    }
    assert_true(seen[SLI_BEFORE] > 1000 && seen[SLI_BEHIND] > 1000 && seen[SLI_BOTH_SIDES] > 1000);
    assert_true(loose < 600);
    for (size_t t = 0; t < test_count; t++) free_occlusion(context, tests[t].calls, occlusions[t]);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(as_brute_force_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

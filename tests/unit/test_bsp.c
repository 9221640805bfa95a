/// The BSP on random walls that cross, touch and overlap: the space is in order, what is free in
/// the map is seen in it, and methods agree on it.
#include "testing.h"

#include "base/random.h"

enum { GRID = 12, WALLS_MOST = 14, MAPS = 1200, LINES = 60 };

typedef struct place {
    int x, y;
} place;

static long turn(place a, place b, place c) {
    return (long)(b.x - a.x) * (c.y - a.y) - (long)(b.y - a.y) * (c.x - a.x);
}

static int sign(long value) {
    return (value > 0) - (value < 0);
}

static bool in_box(place a, place b, place p) {
    return (p.x - a.x) * (p.x - b.x) <= 0 && (p.y - a.y) * (p.y - b.y) <= 0;
}

/// Whether two closed segments share a point, in integers.
static bool touch(place a, place b, place c, place d) {
    const int ab_c = sign(turn(a, b, c)), ab_d = sign(turn(a, b, d));
    const int cd_a = sign(turn(c, d, a)), cd_b = sign(turn(c, d, b));
    if (ab_c * ab_d < 0 && cd_a * cd_b < 0) return true;
    return (ab_c == 0 && in_box(a, b, c)) || (ab_d == 0 && in_box(a, b, d)) ||
           (cd_a == 0 && in_box(c, d, a)) || (cd_b == 0 && in_box(c, d, b));
}

static place random_place(sl_random *random) {
    return (place){(int)sl_random_below(random, GRID), (int)sl_random_below(random, GRID)};
}

static sl_point scaled(place p, double scale, double shift) {
    return (sl_point){p.x * scale + shift, p.y * scale + shift};
}

typedef struct drawn {
    place a[WALLS_MOST], b[WALLS_MOST];
    int count;
} drawn;

static drawn draw(sl_random *random, int kind) {
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

static bool is_free(const drawn *d, place p, place q) {
    for (int i = 0; i < d->count; i++)
        if (touch(p, q, d->a[i], d->b[i])) return false;
    return true;
}

static void see(sl_context *context, const sl_space *space, const char *name, sl_sight sight,
                sl_visibility *out) {
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    sl_see_options options = sl_see_options_default();
    options.sight = sight;
    options.solver = sl_funnel();
    for (size_t i = 0; i < count; i++) {
        if (strcmp(methods[i].name, name) != 0) continue;
        if (!methods[i].stabs) options.solver = NULL;
        assert_ok(context, methods[i].see(context, space, &options, out));
        return;
    }
    fail_msg("there is no method %s", name);
}

/// Gives the number of free sightlines that were checked.
static int check_free(const drawn *d, const sl_space *space, const sl_pvs *pvs, double scale,
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

static int check_map(sl_random *random, int kind, double scale, double shift) {
    sl_context *context = testing_context(NULL);
    const drawn d = draw(random, kind);
    sl_map map = {0};
    sl_space space = {0};
    int checked = 0;
    for (int i = 0; i < d.count; i++)
        assert_ok(context, sl_map_add_wall(context, &map, scaled(d.a[i], scale, shift),
                                           scaled(d.b[i], scale, shift), 0));
    const sl_bsp_options options = sl_bsp_options_default();
    assert_ok(context, sl_subdivide_bsp(context, &map, &options, &space));
    assert_ok(context, sl_space_check(context, &space));
    for (sl_sight sight = SL_CLOSED; sight <= SL_OPEN; sight++) {
        sl_visibility swept = {0}, searched = {0};
        see(context, &space, "sweep", sight, &swept);
        see(context, &space, "dfs", sight, &searched);
        for (uint32_t a = 0; a < space.cell_count; a++)
            for (uint32_t b = 0; b < space.cell_count; b++)
                assert_int_equal(sl_pvs_sees(&swept.pvs, a, b), sl_pvs_sees(&searched.pvs, a, b));
        if (sight == SL_CLOSED) checked = check_free(&d, &space, &swept.pvs, scale, shift, random);
        sl_visibility_destroy(context, &swept);
        sl_visibility_destroy(context, &searched);
    }
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    return checked;
}

static void random_walls(void **state) {
    (void)state;
    sl_random random = {3};
    int checked = 0;
    for (int i = 0; i < MAPS; i++) checked += check_map(&random, i % 4, 1, 0);
    assert_true(checked > 3 * MAPS);
}

static void tiny_huge_and_far(void **state) {
    (void)state;
    sl_random random = {4};
    for (int i = 0; i < MAPS / 3; i++) {
        check_map(&random, i % 4, 0x1p-400, 0);
        check_map(&random, i % 4, 0x1p400, 0);
        check_map(&random, i % 4, 1, 0x1p40);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_walls),
        cmocka_unit_test(tiny_huge_and_far),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

// Generated maps: the same bytes for the same seed, clean walls, whole graphs, rooms that a start
// leads to.
#include "testing.h"

#include "geometry/orient.h"
#include "map_same.h"
#include "sightline/generate.h"
#include "space/subdivide.h"

#include <math.h>

typedef struct golden {
    const char *kind;
    uint64_t seed;
    double open, turned;
    uint64_t hash;
    bool in_line;
} golden;

static const golden goldens[] = {
    {"maze", 1, -1, 0, 0xe09c405745653c38, false},
    {"maze", 2, -1, 0, 0x948aacc7c2815f02, false},
    {"office", 1, -1, 0, 0x62e23f2f4806d2f4, false},
    {"office", 2, -1, 0, 0x36cc6cd6ba865aad, false},
    {"city", 1, -1, 0, 0xdd71320f3c64b6ce, false},
    {"city", 2, -1, 0, 0xfc69b7b46a50736e, false},
    {"pillars", 1, -1, 0, 0x1843d15d00daac4d, false},
    {"pillars", 2, -1, 0, 0xc16413e5c711a532, false},
    {"tunnels", 1, 10, 0, 0x4528fdcfe0f0cdfe, false},
    {"tunnels", 1, 100, 0, 0xacb132065c8fc107, false},
    {"tunnels", 2, 10, 0, 0x856dfe006e2223d1, false},
    {"tower", 1, -1, 0, 0x6b7a14d866548781, false},
    {"tower", 2, -1, 0, 0x950382cc656b1152, false},
    {"office", 1, -1, 30, 0xc25967a0571d810d, false},
    {"office", 1, -1, 30, 0x2d60a0fc8ed5a089, true},
    {"tunnels", 1, 70, 45, 0xfadbf1188fcfb0eb, true},
};

static const sl_map_kind *find_kind(const char *name) {
    size_t count;
    const sl_map_kind *kinds = sl_map_kinds(&count);
    for (size_t i = 0; i < count; i++)
        if (strcmp(kinds[i].name, name) == 0) return &kinds[i];
    fail_msg("no kind %s", name);
    return NULL;
}

static sl_map generate(sl_context *context, const char *kind, const sl_generate_options *options) {
    sl_map map = {0};
    assert_ok(context, sl_generate(context, find_kind(kind), options, &map));
    return map;
}

static sl_map generate_walls(sl_context *context, const char *kind, uint64_t walls) {
    sl_generate_options options = sl_generate_options_default();
    options.walls = walls;
    return generate(context, kind, &options);
}

/// FNV-1a.
static uint64_t hash_text(const char *text) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (; *text; text++) hash = (hash ^ (unsigned char)*text) * 0x100000001b3u;
    return hash;
}

static void test_same_bytes(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < sizeof goldens / sizeof *goldens; i++) {
        const golden *g = &goldens[i];
        sl_generate_options options = sl_generate_options_default();
        options.seed = g->seed;
        options.open = g->open;
        options.turned = g->turned;
        options.in_line = g->in_line;
        sl_map map = generate(context, g->kind, &options);
        char *text = map_text(&map);
        if (hash_text(text) != g->hash)
            fail_msg("%s, seed %d, turned %g: 0x%016llx", g->kind, (int)g->seed, g->turned,
                     (unsigned long long)hash_text(text));
        free(text);
        sl_map_destroy(context, &map);
    }
    sl_context_destroy(context);
}

/// Subdivides, checks the whole graph and looks for faults.
static void examine(sl_context *context, const sl_map *map, sl_space *space, sl_faults *faults) {
    const sl_subdivide_options rules = sl_subdivide_options_default();
    const sl_faults_options small = {.gap = 0.99, .thin = 0.99};
    assert_ok(context, sli_subdivide_kd(context, map, &rules, space));
    assert_ok(context, sl_space_check(context, space));
    assert_ok(context, sl_find_faults(context, map, space, &small, faults));
    assert_true(faults->has_starts);
    for (int kind = 0; kind < SL_FAULT_KINDS; kind++)
        if (kind != SL_FAULT_UNREACHABLE) assert_int_equal(faults->counts[kind], 0);
}

/// Rooms that nothing leads to are what is solid.
static void check_unreachable(const char *kind, const sl_map *map, const sl_space *space,
                              const sl_faults *faults) {
    const uint32_t rooms = faults->counts[SL_FAULT_UNREACHABLE];
    if (strcmp(kind, "maze") == 0 || strcmp(kind, "office") == 0 || strcmp(kind, "tower") == 0) {
        assert_int_equal(rooms, 0);
    } else if (strcmp(kind, "tunnels") == 0) {
        assert_true(map->object_count > 0);
        for (size_t i = 0; i < map->object_count; i++) {
            const sl_box box = map->objects[i].box;
            const sl_point middle = {box.min.x / 2 + box.max.x / 2, box.min.y / 2 + box.max.y / 2};
            assert_true(space->cells[sl_space_locate(space, middle)].inside);
        }
    } else {
        const double most = strcmp(kind, "city") == 0 ? 4 : 100; // trees, pillars
        for (uint32_t i = 0; i < faults->count; i++) assert_true(faults->items[i].size <= most);
    }
}

static void test_whole(void **state) {
    (void)state;
    size_t count;
    const sl_map_kind *kinds = sl_map_kinds(&count);
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < count; i++)
        for (uint64_t seed = 0; seed < 12; seed++) {
            sl_generate_options options = sl_generate_options_default();
            options.seed = seed;
            // From the least size on.
            options.walls = 100 * (seed + 1) * (seed + 1);
            sl_map map = generate(context, kinds[i].name, &options), cleaned = {0};
            sl_space space = {0};
            sl_faults faults = {0};
            examine(context, &map, &space, &faults);
            check_unreachable(kinds[i].name, &map, &space, &faults);
            for (size_t k = 0; k < map.wall_count; k++)
                assert_ok(context, sl_map_add_wall(context, &cleaned, map.walls[k].a,
                                                   map.walls[k].b, map.walls[k].line));
            assert_ok(context, sl_map_clean(context, &cleaned, NULL, NULL));
            assert_true(same_walls(&map, &cleaned));
            sl_faults_destroy(context, &faults);
            sl_space_destroy(context, &space);
            sl_map_destroy(context, &cleaned);
            sl_map_destroy(context, &map);
        }
    sl_context_destroy(context);
}

static void test_walls_asked_for(void **state) {
    (void)state;
    size_t count;
    const sl_map_kind *kinds = sl_map_kinds(&count);
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < count; i++)
        for (uint64_t walls = 2000; walls <= 128000; walls *= 8) {
            sl_map map = generate_walls(context, kinds[i].name, walls);
            const double share = (double)map.wall_count / (double)walls;
            if (share < 0.9 || share > 1.1)
                fail_msg("%s: %zu walls where %d are asked for", kinds[i].name, map.wall_count,
                         (int)walls);
            sl_map_destroy(context, &map);
        }
    sl_context_destroy(context);
}

/// By a cell inside, on average.
static double cells_seen(sl_context *context, const char *kind, uint64_t walls) {
    sl_map map = generate_walls(context, kind, walls);
    sl_space space = {0};
    sl_visibility visibility = {0};
    size_t count;
    const sl_subdivide_options rules = sl_subdivide_options_default();
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    options.inside_only = true;
    assert_ok(context, sli_subdivide_kd(context, &map, &rules, &space));
    assert_ok(context, sl_see_methods(&count)->see(context, &space, &options, &visibility));
    const double seen = (double)visibility.account.pairs / space.inside_count;
    sl_visibility_destroy(context, &visibility);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    return seen;
}

/// Four times as many walls: what a cell sees stays about the same.
static void test_sight_stays_near(void **state) {
    (void)state;
    size_t count;
    const sl_map_kind *kinds = sl_map_kinds(&count);
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < count; i++) {
        const double small = cells_seen(context, kinds[i].name, 700);
        const double large = cells_seen(context, kinds[i].name, 2800);
        if (large > 1.6 * small)
            fail_msg("%s: a cell sees %g cells, and in the larger map %g", kinds[i].name, small,
                     large);
    }
    sl_context_destroy(context);
}

/// The network is the same for any share that is open; those of a smaller share are open in a
/// larger one.
static void test_tunnels(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_generate_options options = sl_generate_options_default();
    sl_map maps[5] = {0};
    size_t before = SIZE_MAX;
    for (int i = 0; i < 5; i++) {
        options.open = 25 * i;
        maps[i] = generate(context, "tunnels", &options);
        assert_int_equal(maps[i].object_count, 1825);
        assert_true(same_objects(maps[0].objects, maps[i].objects, maps[i].object_count));
        assert_true(maps[i].wall_count < before);
        before = maps[i].wall_count;
    }
    // A tunnel that is blocked has a wall more, and cuts its two sides: 1,200 of them.
    assert_int_equal(maps[0].wall_count - maps[4].wall_count, 3 * 1200);
    assert_int_equal(maps[0].wall_count - maps[2].wall_count, 3 * 600);
    assert_int_equal(maps[0].start_count, 625);
    assert_int_equal(maps[4].start_count, 1);
    for (int i = 0; i < 5; i++) sl_map_destroy(context, &maps[i]);
    options.open = 10;
    options.size = 4;
    maps[0] = generate(context, "tunnels", &options);
    assert_int_equal(maps[0].object_count, 2500 + 4900);
    sl_map_destroy(context, &maps[0]);
    sl_context_destroy(context);
}

/// How many walls' ends are in line with a wall; `in_line`: all that were stay so to the last bit.
static size_t check_turned(sl_context *context, bool in_line, double lengths, double degrees) {
    sl_generate_options options = sl_generate_options_default();
    sl_map plain = generate(context, "office", &options);
    options.turned = 37.5;
    options.in_line = in_line;
    sl_map turned = generate(context, "office", &options);
    assert_int_equal(plain.wall_count, turned.wall_count);
    size_t found = 0;
    for (size_t i = 0; i < plain.wall_count; i++) {
        const sl_wall *a = &plain.walls[i], *b = &turned.walls[i];
        const double before = hypot(a->b.x - a->a.x, a->b.y - a->a.y);
        const double after = hypot(b->b.x - b->a.x, b->b.y - b->a.y);
        assert_true(fabs(after / before - 1) < lengths);
        const double angle =
            atan2(b->b.y - b->a.y, b->b.x - b->a.x) - atan2(a->b.y - a->a.y, a->b.x - a->a.x);
        assert_true(fabs(angle * 180 / 3.14159265358979 - 37.5) < degrees);
        for (size_t j = 0; j < plain.wall_count; j++) {
            const sl_point p = plain.walls[j].a, q = turned.walls[j].a;
            const int before_it = sli_orient(a->a, a->b, p), after_it = sli_orient(b->a, b->b, q);
            assert_true(after_it == before_it || (!in_line && before_it == 0));
            // What meets still does.
            assert_int_equal(a->b.x == p.x && a->b.y == p.y, b->b.x == q.x && b->b.y == q.y);
            found += after_it == 0;
        }
    }
    sl_map_destroy(context, &plain);
    sl_map_destroy(context, &turned);
    return found;
}

static void test_turned(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const size_t exact = check_turned(context, true, 0x1p-16, 0.001);
    const size_t rounded = check_turned(context, false, 1e-13, 1e-11);
    print_message("ends in line: %zu, turned in doubles %zu of them\n", exact, rounded);
    assert_true(rounded > 0 && 2 * rounded < exact);
    // A quarter turn keeps walls axial.
    for (int in_line = 0; in_line < 2; in_line++) {
        sl_generate_options options = sl_generate_options_default();
        options.turned = -90;
        options.in_line = in_line;
        sl_map turned = generate(context, "city", &options);
        assert_true(sl_map_is_axial(&turned));
        sl_map_destroy(context, &turned);
    }
    sl_context_destroy(context);
}

static void test_bad_options(void **state) {
    (void)state;
    const struct {
        const char *kind;
        sl_generate_options options;
        const char *message;
    } bad[] = {
        {"maze", {.open = -1, .size = 1}, "size 1: maze: expected 2 to 100000 squares a side"},
        {"maze", {.open = -1, .size = 100001}, "expected 2 to 100000"},
        {"tower", {.open = -1, .size = 100000}, "walls; at most 10000000 can be"},
        {"tunnels", {.open = -1, .size = 50000}, "walls; at most 10000000 can be"},
        {"city", {.open = -1, .walls = 99}, "walls 99: expected 100 to 10000000"},
        {"city", {.open = -1, .walls = 10000001}, "walls 10000001: expected 100 to 10000000"},
        {"city", {.open = -1, .walls = 200, .size = 3}, "walls 200 and size 3: either"},
        {"maze", {.open = 10}, "open 10: maze has nothing to open"},
        {"tunnels", {.open = 100.5}, "open 100.5: expected 0 to 100"},
        {"tunnels", {.open = NAN}, "open nan: expected 0 to 100"},
        {"maze", {.open = -1, .turned = 361}, "turned 361: expected -360 to 360"},
        {"maze", {.open = -1, .turned = NAN}, "turned nan: expected"},
    };
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    const long live = memory.live;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        sl_map map = {0};
        assert_int_equal(sl_generate(context, find_kind(bad[i].kind), &bad[i].options, &map),
                         SL_BAD_ARGUMENT);
        if (!strstr(sl_context_message(context), bad[i].message))
            fail_msg("'%s' lacks '%s'", sl_context_message(context), bad[i].message);
        assert_true(map_is_empty(&map));
        assert_int_equal(memory.live, live);
    }
    sl_context_destroy(context);
}

/// Without memory, or stopped, nothing is left behind.
static void test_fails_clean(void **state) {
    (void)state;
    size_t count;
    const sl_map_kind *kinds = sl_map_kinds(&count);
    for (size_t i = 0; i < count; i++) {
        const sl_generate_options options = sl_generate_options_default();
        testing_memory memory = {0};
        sl_context *context = testing_context(&memory);
        const long live = memory.live;
        sl_status status = SL_NO_MEMORY;
        for (long fail_at = 1; status != SL_OK; fail_at += 1 + fail_at / 8) {
            sl_map map = {0};
            memory.calls = 0;
            memory.fail_at = fail_at;
            status = sl_generate(context, &kinds[i], &options, &map);
            assert_true(status == SL_OK || status == SL_NO_MEMORY);
            if (status != SL_OK) assert_true(map_is_empty(&map));
            sl_map_destroy(context, &map);
            assert_int_equal(memory.live, live);
        }
        sl_context_destroy(context);

        const sl_hooks hooks = {.cancelled = testing_cancelled};
        sl_map map = {0};
        context = sl_context_create(&hooks);
        assert_non_null(context);
        assert_int_equal(sl_generate(context, &kinds[i], &options, &map), SL_CANCELLED);
        assert_true(map_is_empty(&map));
        sl_context_destroy(context);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_bytes),      cmocka_unit_test(test_whole),
        cmocka_unit_test(test_walls_asked_for), cmocka_unit_test(test_sight_stays_near),
        cmocka_unit_test(test_tunnels),         cmocka_unit_test(test_turned),
        cmocka_unit_test(test_bad_options),     cmocka_unit_test(test_fails_clean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

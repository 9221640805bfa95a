// Doors that change in a game, and rows that follow: after any changes a settled row is that of a
// sweep over the space with walls in place of the shut doors, and before that it misses nothing.
//   test_runtime_state [MAPS [SEED]]    so many random maps of each kind instead of 60
#include "runtime_maps.h"

#include "cell_to_cell/sweep/sweep.h"
#include "effects/filtered.h"
#include "sightline/effects.h"

#include <inttypes.h>

enum { SIZE = 8, WALLS = 14, DOORS = 12, CHANGES = 12, EYES = 40 };

static uint64_t maps = 60, seed = 5;

typedef struct game {
    sl_context *context;
    sl_random random;
    baked_file file;
    sl_runtime_state state;
    uint32_t *memory, *scratch;
    unsigned char *bits;
    uint64_t settled, exact_before, pairs;
} game;

static void start(game *g) {
    const sl_runtime *r = &g->file.runtime;
    const size_t count = sl_runtime_state_count(r);
    // Exactly as much as is asked for, so that sanitizers find what lies beyond.
    g->memory = malloc(count * sizeof *g->memory);
    g->scratch = malloc(sl_runtime_scratch_count(r) * sizeof *g->scratch);
    g->bits = malloc((r->cell_count + 7) / 8);
    assert_non_null(g->memory);
    assert_non_null(g->scratch);
    assert_non_null(g->bits);
    memset(g->memory, 0xa5, count * sizeof *g->memory);
    sl_runtime_state_start(&g->state, r, g->memory);
    for (uint32_t i = 0; i < r->door_count; i++)
        assert_int_equal(g->state.shut[i], !sl_runtime_door_open(r, i));
}

static void end(game *g) {
    free(g->memory);
    free(g->scratch);
    free(g->bits);
    baked_file_destroy(g->context, &g->file);
}

/// The rows by the sweep, with walls in the shut doors.
static sl_visibility oracle(game *g) {
    const sl_space *space = &g->file.baked.space;
    sl_plan plan = sl_plan_make(&g->file.baked.map);
    sl_see_options options = sl_see_options_default();
    sl_visibility out = {0};
    sl_space walled = {0};
    bool *shut = calloc(g->file.runtime.door_count + 1, sizeof *shut);
    assert_non_null(shut);
    for (uint32_t i = 0; i < g->file.runtime.door_count; i++) shut[i] = g->state.shut[i];
    plan.effects &= SL_EFFECT_ONEWAY;
    plan.range = 0;
    options.plan = &plan;
    const sli_filtered_space filtered = {.shut = shut};
    assert_ok(g->context, sli_filtered_space_make(g->context, space, &filtered, NULL, &walled));
    assert_ok(g->context, sli_see_sweep(g->context, &walled, &options, &out));
    sl_space_destroy(g->context, &walled);
    free(shut);
    return out;
}

static bool is_solid_or_rowless(const sl_runtime *r, uint32_t cell) {
    return !sl_runtime_has_row(r, cell);
}

/// Rows hold all that is seen; if all are settled, nothing else. By bits and one by one the same.
static void compare(game *g) {
    const sl_runtime *r = &g->file.runtime;
    sl_visibility truth = oracle(g);
    for (uint32_t i = 0; i < r->cell_count; i++) {
        uint32_t count = 0;
        if (is_solid_or_rowless(r, i)) continue;
        const uint32_t said = sl_runtime_state_row_bits(&g->state, i, g->bits);
        for (uint32_t k = 0; k < r->cell_count; k++) {
            const bool sees = sl_pvs_sees(&truth.pvs, i, k), bit = g->bits[k / 8] >> k % 8 & 1;
            assert_int_equal(bit, sl_runtime_state_can_see(&g->state, i, k));
            count += bit;
            g->pairs++;
            if (sees ? !bit : bit && !g->state.unsettled)
                fail_msg("%s: cell %u %s cell %u", g->file.name, i, sees ? "misses" : "adds", k);
            g->exact_before += bit == sees;
        }
        assert_int_equal(said, count);
    }
    assert_false(sl_runtime_state_can_see(&g->state, r->cell_count, 0));
    assert_false(sl_runtime_state_can_see(&g->state, 0, r->cell_count));
    sl_visibility_destroy(g->context, &truth);
}

/// Points that see each other, by the call that is exact at once, are in cells that do.
static void compare_points(game *g) {
    const sl_runtime *r = &g->file.runtime;
    for (int i = 0; i < EYES; i++) {
        double p[4];
        for (int k = 0; k < 4; k++)
            p[k] = (k % 2 ? r->min_y : r->min_x) +
                   (k % 2 ? r->max_y - r->min_y : r->max_x - r->min_x) * sl_random_unit(&g->random);
        const uint32_t from = sl_runtime_locate(r, p[0], p[1]),
                       to = sl_runtime_locate(r, p[2], p[3]);
        if (from == SL_RUNTIME_NO_CELL || to == SL_RUNTIME_NO_CELL) continue;
        if (is_solid_or_rowless(r, from) || sl_runtime_is_solid(r, to)) continue;
        if (sl_runtime_sees(r, p[0], p[1], p[2], p[3], g->state.shut, 0, g->scratch))
            assert_true(sl_runtime_state_can_see(&g->state, from, to));
    }
}

/// Works in small pieces until all is settled. No call does more than it is told to: each makes
/// some progress.
static void settle(game *g) {
    uint64_t calls = 0;
    while (g->state.unsettled) {
        const uint32_t before = g->state.unsettled;
        const uint32_t left = sl_runtime_settle(&g->state, 1 + (uint32_t)(g->settled % 40));
        assert_int_equal(left, g->state.unsettled);
        assert_true(left <= before);
        assert_true(++calls < 100000000);
    }
    g->settled++;
    assert_int_equal(sl_runtime_settle(&g->state, 1000), 0);
    assert_int_equal(g->state.given_up, 0);
}

static void change_some(game *g) {
    const sl_runtime *r = &g->file.runtime;
    for (uint64_t i = 1 + sl_random_below(&g->random, 3); i > 0; i--) {
        const uint32_t door = (uint32_t)sl_random_below(&g->random, r->door_count);
        const bool shut = sl_random_below(&g->random, 2);
        sl_runtime_settle(&g->state, (uint32_t)sl_random_below(&g->random, 200));
        const sl_runtime_door_kind kind = sl_runtime_get_door_kind(r, door);
        const bool stands = g->state.shut[door];
        const bool may = stands == shut || kind != (shut ? SL_RUNTIME_BREAKABLE : SL_RUNTIME_SITE);
        assert_int_equal(sl_runtime_state_set_door(&g->state, door, shut), may);
        assert_int_equal(g->state.shut[door], may ? shut : stands);
    }
}

static void play(game *g) {
    start(g);
    for (int i = 0; i < CHANGES; i++) {
        if (i) change_some(g);
        if (i % 3 == 0) compare(g);
        settle(g);
        compare(g);
        compare_points(g);
    }
    end(g);
}

// --- maps

/// Rows as a bake keeps them: with up to `limit` sets of doors for each pair.
static void make(game *g, uint32_t limit) {
    sl_baked *b = &g->file.baked;
    testing_subdivide(g->context, &b->map, &b->space);
    sl_plan plan = sl_plan_make(&b->map);
    sl_see_options options = sl_see_options_default();
    size_t count;
    plan.door_limit = limit;
    plan.effects &= ~(unsigned)SL_EFFECT_MIRROR;
    options.plan = &plan;
    options.solver = sl_funnel();
    assert_ok(g->context,
              sl_see_methods(&count)->see(g->context, &b->space, &options, &b->visibility));
    g->file.bytes = baked_bytes(g->context, b, &g->file.size);
    baked_file_open(&g->file);
}

static void turn(sl_map *map, double c, double s, double offset) {
    for (size_t i = 0; i < 2 * (map->wall_count + map->door_count); i++) {
        sl_point *p = i < 2 * map->wall_count ? i % 2 ? &map->walls[i / 2].a : &map->walls[i / 2].b
                      : i % 2                 ? &map->doors[i / 2 - map->wall_count].segment.a
                                              : &map->doors[i / 2 - map->wall_count].segment.b;
        *p = (sl_point){offset + c * p->x - s * p->y, offset + s * p->x + c * p->y};
    }
}

/// Walls and doors on a grid: they touch, overlap and lie on each other.
static void check_random_maps(double c, double s, double offset) {
    game g = {.context = testing_context(NULL), .random = {seed}};
    for (uint64_t i = 0; i < maps; i++) {
        sl_map *map = &g.file.baked.map;
        g.file = (baked_file){.name = "random", .baked = {.method = "dfs", .solver = "funnel"}};
        grid_rooms(g.context, &g.random, SIZE, i % 2 ? WALLS : 2, DOORS, map);
        turn(map, c, s, offset);
        assert_ok(g.context, sl_map_clean(g.context, map, NULL, NULL));
        make(&g, i % 3 == 0 ? 1 : i % 3 == 1 ? 3 : 64);
        play(&g);
    }
    print_message("%" PRIu64 " maps, %" PRIu64 " pairs\n", maps, g.pairs);
    sl_context_destroy(g.context);
}

static void on_a_grid(void **state) {
    (void)state;
    check_random_maps(1, 0, 0);
}

static void turned_exactly(void **state) {
    (void)state;
    check_random_maps(4, 3, 0);
}

static void turned_by_17_degrees_far_away(void **state) {
    (void)state;
    check_random_maps(cos(17.3 * 0.017453292519943295), sin(17.3 * 0.017453292519943295), 1e6);
}

static void tiny(void **state) {
    (void)state;
    check_random_maps(1e-100, 0, 0);
}

/// The maps with doors, without range: rows keep to that as they are baked.
static void on_maps(void **state) {
    (void)state;
    size_t count = 0;
    glob_t found = map_files_find(MAP_FILES_ALL);
    for (size_t i = 0; i < found.gl_pathc; i++) {
        game g = {
            .context = testing_context(NULL),
            .random = {seed + i},
            .file = {.name = found.gl_pathv[i], .baked = {.method = "dfs", .solver = "funnel"}}};
        sl_map *map = &g.file.baked.map;
        map_files_read(g.context, found.gl_pathv[i], map);
        if (map->door_count && map->door_count < 100 && !(map->range > 0)) {
            count++;
            make(&g, 2);
            play(&g);
        } else
            sl_map_destroy(g.context, map);
        sl_context_destroy(g.context);
    }
    globfree(&found);
    assert_true(count > 0);
}

/// Rooms side by side, each two with a wall between them half of which breaks.
static void make_rooms(game *g) {
    enum { ROOMS = 5, WIDTH = 3 * ROOMS };
    sl_map *map = &g->file.baked.map;
    const sl_point corners[] = {{0, 0}, {WIDTH, 0}, {WIDTH, WIDTH}, {0, WIDTH}, {0, 0}};
    for (int i = 0; i < 4; i++)
        assert_ok(g->context, sl_map_add_wall(g->context, map, corners[i], corners[i + 1], 0));
    for (int i = 3; i < WIDTH; i += 3)
        for (int k = 0; k < WIDTH; k += 3) {
            const sl_segment upright = {{i, k + 2}, {i, k + 3}}, level = {{k + 1, i}, {k + 3, i}};
            const sl_point low = {i, k}, left = {k, i};
            char name[16];
            assert_ok(g->context, sl_map_add_wall(g->context, map, low, upright.a, 0));
            assert_ok(g->context, sl_map_add_wall(g->context, map, left, level.a, 0));
            snprintf(name, sizeof name, "u%d-%d", i, k);
            assert_ok(g->context, sl_map_add_door(g->context, map, name, upright, false, 0));
            name[0] = 'l';
            assert_ok(g->context, sl_map_add_door(g->context, map, name, level, false, 0));
        }
    make(g, 0);
}

/// Opens all doors, and counts the calls with so many portals until all is settled.
static uint64_t calls_with(uint32_t portals) {
    game g = {.context = testing_context(NULL), .random = {seed}};
    uint64_t calls = 1;
    make_rooms(&g);
    start(&g);
    settle(&g);
    for (uint32_t i = 0; i < g.file.runtime.door_count; i++)
        assert_true(sl_runtime_state_set_door(&g.state, i, false));
    while (sl_runtime_settle(&g.state, portals)) calls++;
    end(&g);
    sl_context_destroy(g.context);
    return calls;
}

/// A call with one portal does one step at most. So one with more does no more steps than it is
/// told to, if there are enough such calls: a row that begins counts as one of them at least.
static void no_call_does_more_than_it_is_told(void **state) {
    (void)state;
    const uint64_t steps = calls_with(1);
    assert_true(steps > 1000);
    for (uint32_t portals = 10; portals <= 1000; portals *= 10) {
        const uint64_t calls = calls_with(portals);
        assert_true(calls * portals >= steps && calls < steps);
    }
}

/// What is broken stays broken, and what is built stays built; parts of one name go together.
static void kinds_keep(void **state) {
    (void)state;
    game g = {.context = testing_context(NULL), .random = {seed}};
    g.file = baked_file_of_text(g.context, "walls 0 0 9 0 9 9 0 9 0 0\n"
                                           "door wall 3 0 3 3 breakable\n"
                                           "door site 6 0 6 9 site\n"
                                           "door wall 3 3 3 9 breakable\n"
                                           "door plain 6 3 9 3 shut\n");
    start(&g);
    settle(&g);
    const sl_runtime *r = &g.file.runtime;
    sl_runtime_state *s = &g.state;
    const uint32_t left = sl_runtime_locate(r, 1, 1), right = sl_runtime_locate(r, 5, 1);
    const uint32_t wall = sl_runtime_find_door(r, "wall"), site = sl_runtime_find_door(r, "site");
    const uint32_t plain = sl_runtime_find_door(r, "plain");
    assert_int_equal(sl_runtime_get_door_kind(r, wall), SL_RUNTIME_BREAKABLE);
    assert_int_equal(sl_runtime_get_door_kind(r, site), SL_RUNTIME_SITE);
    assert_int_equal(sl_runtime_get_door_kind(r, plain), SL_RUNTIME_DOOR);
    assert_int_equal(sl_runtime_get_door_kind(r, r->door_count), SL_RUNTIME_DOOR);
    assert_true(s->shut[wall] && s->shut[2] && !s->shut[site] && s->shut[plain]);
    assert_false(sl_runtime_state_can_see(s, left, right));
    assert_true(sl_runtime_state_set_door(s, wall, true)); // it stands
    assert_int_equal(s->unsettled, 0);
    assert_true(sl_runtime_state_set_door(s, wall, false));
    assert_true(!s->shut[wall] && !s->shut[2] && s->unsettled > 0);
    assert_false(sl_runtime_state_set_door(s, wall, true));
    assert_false(sl_runtime_state_set_door(s, 2, true));
    assert_false(s->shut[wall]);
    settle(&g);
    assert_true(sl_runtime_state_can_see(s, left, right));
    assert_true(sl_runtime_state_set_door(s, site, false)); // nothing is built yet
    assert_true(sl_runtime_state_set_door(s, site, true));
    assert_false(sl_runtime_state_set_door(s, site, false));
    assert_true(s->shut[site]);
    assert_true(sl_runtime_state_set_door(s, plain, false));
    assert_true(sl_runtime_state_set_door(s, plain, true));
    assert_false(sl_runtime_state_set_door(s, r->door_count, true));
    assert_false(sl_runtime_state_set_door(s, SL_RUNTIME_NO_DOOR, false));
    end(&g);
    sl_context_destroy(g.context);
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_call_does_more_than_it_is_told),
                                       cmocka_unit_test(kinds_keep),
                                       cmocka_unit_test(on_a_grid),
                                       cmocka_unit_test(turned_exactly),
                                       cmocka_unit_test(turned_by_17_degrees_far_away),
                                       cmocka_unit_test(tiny),
                                       cmocka_unit_test(on_maps)};
    if (argc > 1) maps = strtoull(argv[1], NULL, 10);
    if (argc > 2) seed = strtoull(argv[2], NULL, 10);
    return cmocka_run_group_tests(tests, NULL, NULL);
}

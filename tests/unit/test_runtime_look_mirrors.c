/// What the runtime's eye sees in mirrors, cell by cell: against brute force in random axial maps
/// with all effects, and against single rays among turned mirrors. SIGHTLINE_SEEDS in the
/// environment: how many maps (64 by default).
#include "testing.h"

#include "effects/filtered.h"
#include "mirror_rays.h"
#include "oracle/mirrored.h"
#include "oracle/random_effects.h"
#include "oracle/random_oblique.h"
#include "runtime_maps.h"

#include "sightline/bake.h"

enum { MAPS = 64, EYES = 16, RAYS = 24, CELLS_MOST = 256 };

typedef struct trial {
    sl_context *context;
    sl_random random;
    uint64_t seed;
    double scale;
    uint32_t depth;
    baked_file f;
    bool is_shut[3];                          ///< by door
    unsigned char shut[3], found[CELLS_MOST]; ///< found: 1 directly, 2 by mirror
    uint32_t *scratch;
    bool rounded;
    size_t by_mirror, fewer, roundings, rays;
} trial;

static void begin(trial *t, uint64_t seed, double degrees) {
    t->random = (sl_random){seed};
    t->seed = seed;
    t->scale = seed % 16 == 8 ? 0.1 : 1;
    t->depth = 1 + (uint32_t)sl_random_below(&t->random, 3);
    t->f = (baked_file){.name = "random"};
    const unsigned effects = SL_EFFECT_MIRROR | (seed & 1 ? SL_EFFECT_DOOR : 0) |
                             (seed & 2 && degrees == 0 ? SL_EFFECT_ONEWAY : 0) |
                             (seed & 4 && degrees == 0 ? SL_EFFECT_RANGE : 0);
    sl_map map = {0};
    sl_bake_options options = sl_bake_options_default();
    options.mirror_depth = t->depth;
    random_effects_map(t->context, &t->random, effects, t->scale, &map);
    if (degrees != 0) {
        oblique_turn_map(&map, degrees, 0);
        assert_ok(t->context, sl_map_clean(t->context, &map, NULL, NULL));
    }
    assert_ok(t->context, sl_bake(t->context, &map, &options, &t->f.baked, NULL));
    t->f.bytes = baked_bytes(t->context, &t->f.baked, &t->f.size);
    baked_file_open(&t->f);
    assert_true(t->f.runtime.cell_count <= CELLS_MOST);
    for (int i = 0; i < 3; i++)
        t->shut[i] = t->is_shut[i] = degrees == 0 && sl_random_below(&t->random, 2);
    t->scratch =
        malloc(sl_runtime_mirrored_scratch_count(&t->f.runtime, t->depth) * sizeof *t->scratch);
    assert_non_null(t->scratch);
}

static void end(trial *t) {
    free(t->scratch);
    baked_file_destroy(t->context, &t->f);
}

static void look(trial *t, const sl_view *view) {
    const sl_runtime *r = &t->f.runtime;
    const sl_point eye = view->eye;
    const sl_runtime_view same = {eye.x,
                                  eye.y,
                                  view->full,
                                  {view->right.x - eye.x, view->right.y - eye.y},
                                  {view->left.x - eye.x, view->left.y - eye.y}};
    uint32_t cells[CELLS_MOST], past[CELLS_MOST], direct;
    const uint32_t count = sl_runtime_look_into_mirrors(r, &same, t->shut, 0, t->depth, t->scratch,
                                                        cells, CELLS_MOST, &direct, &t->rounded);
    memset(t->found, 0, sizeof t->found);
    assert_true(direct <= count && count <= r->cell_count);
    for (uint32_t i = 0; i < count; i++) {
        assert_int_equal(t->found[cells[i]], 0);
        t->found[cells[i]] = i < direct ? 1 : 2;
        assert_true(i <= direct || cells[i] > cells[i - 1] || t->rounded);
    }
    assert_int_equal(sl_runtime_look_past(r, &same, t->shut, 0, t->scratch, past, CELLS_MOST),
                     direct);
    assert_memory_equal(past, cells, direct * sizeof *cells);
    const uint32_t all =
        sl_runtime_look_mirrored(r, &same, t->shut, 0, t->scratch, past, CELLS_MOST, &direct);
    assert_true(count <= all);
    t->fewer += count < all;
    t->roundings += t->rounded;
}

static sl_view random_view(trial *t) {
    const sl_point eye = random_effects_point(&t->random, t->scale);
    const bool full = t->scale != 1 || sl_random_below(&t->random, 2); // differences must be exact
    return random_effects_view(&t->random, eye, full, t->scale);
}

/// Then the side of the eye's cell counts for what is seen directly (sl_runtime_look), and the
/// oracle knows none.
static bool is_in_line_with_glass(const trial *t, sl_point eye) {
    const sl_map *map = &t->f.baked.map;
    for (size_t i = 0; i < map->oneway_count; i++) {
        const sl_segment at = map->oneways[i].segment;
        if (at.a.x == at.b.x ? eye.x == at.a.x : eye.y == at.a.y) return true;
    }
    return false;
}

static void compare(trial *t, const sl_view *view, const oracle_mirrored *truth) {
    for (uint32_t c = 0; c < t->f.runtime.cell_count; c++) {
        const bool seen = truth->closed[c] || truth->direct_closed[c];
        t->by_mirror += t->found[c] == 2 && truth->closed[c];
        if (seen ? t->found[c] != 0 : !t->found[c] || t->rounded) continue;
        fail_msg("seed %llu, depth %u: cell %u is %s; eye %g %g, full %d, right %g %g, left %g %g",
                 (unsigned long long)t->seed, t->depth, c, seen ? "missed" : "too many",
                 view->eye.x, view->eye.y, view->full, view->right.x, view->right.y, view->left.x,
                 view->left.y);
    }
}

static void as_brute_force_says(void **state) {
    (void)state;
    static trial t;
    const uint64_t maps = testing_seeds(MAPS);
    t.context = testing_context(NULL);
    for (uint64_t seed = 1; seed <= maps; seed++) {
        sl_space space = {0};
        begin(&t, seed, 0);
        const sli_filtered_space filtered = {.shut = t.is_shut, .one_way = true};
        assert_ok(t.context,
                  sli_filtered_space_make(t.context, &t.f.baked.space, &filtered, NULL, &space));
        for (int i = 0; i < EYES; i++) {
            const sl_map *map = &t.f.baked.map;
            const sl_view view = random_view(&t);
            if (is_in_line_with_glass(&t, view.eye)) continue;
            oracle_mirrored truth = oracle_mirrored_of(&space, map, &view, map->range, t.depth);
            look(&t, &view);
            compare(&t, &view, &truth);
            oracle_mirrored_free(&truth);
        }
        sl_space_destroy(t.context, &space);
        end(&t);
    }
    print_message("%zu cells by mirror, fewer than in rows %zu times, %zu rounded\n", t.by_mirror,
                  t.fewer, t.roundings);
    assert_true(t.by_mirror > maps / 4 && t.fewer > maps && t.roundings < maps);
    sl_context_destroy(t.context);
}

/// No cell is missed that a ray comes well into.
static void turned_maps_miss_nothing(void **state) {
    (void)state;
    static trial t;
    const uint64_t maps = testing_seeds(MAPS);
    t.context = testing_context(NULL);
    for (uint64_t seed = 1; seed <= maps; seed++) {
        begin(&t, seed, 17.3);
        const sl_space *space = &t.f.baked.space;
        const sl_box b = space->bounds;
        sl_map map = t.f.baked.map; // whose walls are in the space
        map.walls = t.f.baked.space.walls;
        map.wall_count = t.f.baked.space.wall_count;
        for (int i = 0; i < EYES; i++) {
            const sl_view view = sl_view_all_round(
                (sl_point){b.min.x + sl_random_unit(&t.random) * (b.max.x - b.min.x),
                           b.min.y + sl_random_unit(&t.random) * (b.max.y - b.min.y)});
            look(&t, &view);
            for (int k = 0; k < RAYS; k++) {
                const sl_point way = {sl_random_unit(&t.random) - 0.5,
                                      sl_random_unit(&t.random) - 0.5};
                const oracle_ray ray = oracle_ray_of(&map, view.eye, way, t.depth);
                for (uint32_t leg = 1; leg < ray.count && ray.margin > 1e-7; leg++) {
                    const sl_point p = {(ray.legs[leg].from.x + ray.legs[leg].to.x) / 2,
                                        (ray.legs[leg].from.y + ray.legs[leg].to.y) / 2};
                    const uint32_t cell = sl_space_locate(space, p);
                    if (mirror_rays_depth_in(space, cell, p) < 1e-7) continue;
                    t.rays++;
                    if (!t.found[cell])
                        fail_msg("seed %llu, depth %u: cell %u is missed; eye %.17g %.17g",
                                 (unsigned long long)seed, t.depth, cell, view.eye.x, view.eye.y);
                }
            }
        }
        end(&t);
    }
    print_message("%zu reflected rays, %zu views rounded\n", t.rays, t.roundings);
    assert_true(t.rays > maps && t.roundings > maps / 2);
    sl_context_destroy(t.context);
}

/// A wall parts a hall. The rows of the lower cells have what a mirror shows to some place in them;
/// this eye sees nothing of it.
static void rows_say_too_much(void **state) {
    (void)state;
    static trial t;
    t.context = testing_context(NULL);
    t.f = baked_file_of_text(t.context, "wall 0 0 20 0\nwall 20 0 20 10\nwall 20 10 0 10\n"
                                        "wall 0 10 0 0\nwall 10 0 10 8\nmirror 4 10 16 10\n");
    const sl_runtime *r = &t.f.runtime;
    t.depth = 1;
    t.scratch = malloc(sl_runtime_mirrored_scratch_count(r, 1) * sizeof *t.scratch);
    sl_view view = {.eye = {2, 2}, .right = {2, 1}, .left = {3, 1}}; // away from the mirror
    look(&t, &view);
    assert_false(t.rounded);
    for (uint32_t i = 0; i < r->cell_count; i++) assert_int_not_equal(t.found[i], 2);
    assert_true(t.fewer);
    // By the mirror it sees behind the wall.
    view = (sl_view){.eye = {8, 2}, .right = {9.75, 10}, .left = {8, 10}};
    look(&t, &view);
    assert_false(t.rounded);
    assert_int_equal(t.found[sl_runtime_locate(r, 11, 7.5)], 2);
    view = sl_view_all_round((sl_point){8, 0.1}); // its image is no double
    look(&t, &view);
    assert_true(t.rounded);
    end(&t);
    sl_context_destroy(t.context);
}

/// An eye on a mirror stands in one cell only. When a piece of its cone has filled the path, the
/// next one looks into that mirror.
static void on_a_mirror_when_the_path_was_full(void **state) {
    (void)state;
    static trial t;
    t.context = testing_context(NULL);
    t.f = baked_file_of_text(t.context, "wall 0 0 10 0\nwall 10 0 10 4\nwall 10 4 0 4\n"
                                        "wall 0 4 0 0\nwall 4 1 4 4\nmirror 0 0 2 0\n");
    const sl_runtime *r = &t.f.runtime;
    assert_int_equal(r->cell_count, 2);
    t.depth = 1;
    t.scratch = malloc(sl_runtime_mirrored_scratch_count(r, 1) * sizeof *t.scratch);
    const sl_view view = {.eye = {1, 0}, .right = {1.1, -1}, .left = {0, -0.5}};
    look(&t, &view);
    assert_false(t.rounded);
    for (uint32_t i = 0; i < r->cell_count; i++) assert_int_equal(t.found[i], 1);
    end(&t);
    sl_context_destroy(t.context);
}

/// In line with the mirror that the eye is on is a doorway. By the mirror, the line through it
/// shows no more than that line.
static void on_a_mirror_beside_a_doorway(void **state) {
    (void)state;
    static trial t;
    sl_space space = {0};
    t.context = testing_context(NULL);
    t.f = baked_file_of_text(
        t.context, "wall 0 -4 10 -4\nwall 10 -4 10 4\nwall 10 4 0 4\nwall 0 4 0 -4\n"
                   "wall 0 0 2 0\nwall 4 0 6 0\nwall 8 0 10 0\nwall 3 -4 3 -2\nwall 5 -2 5 0\n"
                   "mirror 2 0 4 0\n");
    t.depth = 1;
    t.scratch = malloc(sl_runtime_mirrored_scratch_count(&t.f.runtime, 1) * sizeof *t.scratch);
    const sli_filtered_space filtered = {.shut = t.is_shut, .one_way = true};
    assert_ok(t.context,
              sli_filtered_space_make(t.context, &t.f.baked.space, &filtered, NULL, &space));
    for (int x = 16; x <= 32; x++) {
        const sl_view view = sl_view_all_round((sl_point){x / 8.0, 0});
        oracle_mirrored truth = oracle_mirrored_of(&space, &t.f.baked.map, &view, 0, 1);
        look(&t, &view);
        compare(&t, &view, &truth);
        oracle_mirrored_free(&truth);
    }
    sl_space_destroy(t.context, &space);
    end(&t);
    sl_context_destroy(t.context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_say_too_much),
        cmocka_unit_test(on_a_mirror_when_the_path_was_full),
        cmocka_unit_test(on_a_mirror_beside_a_doorway),
        cmocka_unit_test(as_brute_force_says),
        cmocka_unit_test(turned_maps_miss_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

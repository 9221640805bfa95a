// From-region visibility: methods find the same by any solver, the exact one what the search by
// cells does; view cells of any kind, boundaries and cycles.
#include "testing.h"

#include "oracle/random_map.h"
#include "sightline/from_region.h"
#include "sightline/support.h"
#include "space/subdivide.h"

enum { RANDOM_MAPS = 24 };

static const sl_from_region_solver *solver_of(const char *name) {
    size_t count;
    const sl_from_region_solver *solvers = sl_from_region_solvers(&count);
    for (size_t i = 0; i < count; i++)
        if (strcmp(solvers[i].name, name) == 0) return &solvers[i];
    fail_msg("no solver '%s'", name);
    return NULL;
}

static sl_from_region_result see(sl_context *context, const sl_from_region_scene *scene,
                                 size_t method, const sl_from_region_options *options) {
    size_t count;
    const sl_from_region_method *methods = sl_from_region_methods(&count);
    sl_from_region_result result = {0};
    assert_true(method < count);
    assert_ok(context, methods[method].see(context, scene, options, &result));
    return result;
}

static size_t method_count(void) {
    size_t count;
    sl_from_region_methods(&count);
    return count;
}

static bool same(const sl_from_region_result *a, const sl_from_region_result *b) {
    return a->view_cells == b->view_cells && a->objects == b->objects && a->words == b->words &&
           memcmp(a->seen, b->seen, (size_t)a->view_cells * a->words * sizeof *a->seen) == 0;
}

static bool sees(const sl_from_region_result *result, uint32_t view_cell, uint32_t object) {
    return sl_bits_has(result->seen + (size_t)view_cell * result->words, object);
}

/// Every method, on one thread and on two, finds the same from as many images. Returns it.
static sl_from_region_result compare_methods(sl_context *context, const char *name,
                                             const sl_from_region_scene *scene,
                                             sl_from_region_options options) {
    options.threads = 1;
    sl_from_region_result first = see(context, scene, 0, &options);
    for (size_t m = 0; m < method_count(); m++)
        for (unsigned threads = 1; threads <= 2; threads++) {
            options.threads = threads;
            sl_from_region_result other = see(context, scene, m, &options);
            if (!same(&first, &other))
                fail_msg("%s, %s: method %d sees %d pairs, brute force %d", name,
                         options.solver->name, (int)m, (int)sl_from_region_pairs(&other),
                         (int)sl_from_region_pairs(&first));
            assert_int_equal(first.images, other.images);
            assert_true(other.refined <= first.refined);
            if (!options.solver->stabs) assert_int_equal(first.rays, other.rays);
            sl_from_region_result_destroy(context, &other);
        }
    return first;
}

static void read_map(sl_context *context, const char *path, sl_map *map) {
    char full[4096];
    snprintf(full, sizeof full, "%s/%s", SIGHTLINE_SOURCE_DIR, path);
    assert_ok(context, sl_map_read(context, full, NULL, map));
    assert_ok(context, sl_map_clean(context, map, NULL, NULL));
}

/// Leaves as view cells and as objects: what cells see of each other.
static void leaves_see_what_cells_see(void **state) {
    (void)state;
    const char *paths[] = {"maps/office.map", "maps/grazing.map", "maps/pillars.map",
                           "maps/spiral.map"};
    sl_context *context = testing_context(NULL);
    size_t count;
    const sl_see_method *by_cells = sl_see_methods(&count);
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++)
        for (int sight = SL_CLOSED; sight <= SL_OPEN; sight++) {
            sl_map map = {0};
            sl_space space;
            sl_from_region_scene *scene;
            read_map(context, paths[i], &map);
            const sl_subdivide_options rules = sl_subdivide_options_default();
            assert_ok(context, sli_subdivide_kd(context, &map, &rules, &space));
            sl_see_options by = sl_see_options_default();
            by.sight = (sl_sight)sight;
            by.inside_only = true;
            by.solver = sl_funnel();
            sl_visibility expected;
            assert_ok(context, by_cells[0].see(context, &space, &by, &expected));
            sl_from_region_scene_options what = sl_from_region_scene_options_default();
            what.view_cells = SL_VIEW_CELLS_LEAVES;
            what.objects = SL_OBJECTS_CELLS;
            assert_ok(context, sl_from_region_scene_create(context, &map, &what, &scene));
            sl_from_region_options options = sl_from_region_options_default();
            options.solver = solver_of("stabs");
            options.stab = sl_funnel();
            options.sight = (sl_sight)sight;
            sl_from_region_result seen = compare_methods(context, paths[i], scene, options);
            uint32_t a = 0;
            for (uint32_t cell = 0; cell < space.cell_count; cell++) {
                if (!space.cells[cell].inside) continue;
                uint32_t b = 0;
                for (uint32_t other = 0; other < space.cell_count; other++) {
                    if (!space.cells[other].inside) continue;
                    // A leaf that only touches the view cell's own side is none that lies in it.
                    assert_int_equal(sees(&seen, a, b), sl_pvs_sees(&expected.pvs, cell, other));
                    b++;
                }
                a++;
            }
            assert_int_equal(a, seen.view_cells);
            sl_from_region_result_destroy(context, &seen);
            sl_visibility_destroy(context, &expected);
            sl_from_region_scene_destroy(context, scene);
            sl_space_destroy(context, &space);
            sl_map_destroy(context, &map);
        }
    sl_context_destroy(context);
}

/// What sampling sees the exact solver does.
static void check_subset(const char *name, const sl_from_region_result *some,
                         const sl_from_region_result *all) {
    for (uint32_t a = 0; a < some->view_cells; a++)
        for (uint32_t b = 0; b < some->objects; b++)
            if (sees(some, a, b) && !sees(all, a, b))
                fail_msg("%s: sampling adds that %u sees %u", name, a, b);
}

static void check_scene(sl_context *context, const char *name, const sl_map *map,
                        const sl_from_region_scene_options *what, uint64_t seed, uint64_t *sampled,
                        uint64_t *exact) {
    sl_from_region_scene *scene;
    assert_ok(context, sl_from_region_scene_create(context, map, what, &scene));
    sl_from_region_options options = sl_from_region_options_default();
    options.points = 32;
    options.pixels = 8;
    options.seed = seed;
    sl_from_region_result some = compare_methods(context, name, scene, options);
    options.solver = solver_of("stabs");
    options.stab = sl_funnel();
    sl_from_region_result all = compare_methods(context, name, scene, options);
    check_subset(name, &some, &all);
    *sampled += sl_from_region_pairs(&some);
    *exact += sl_from_region_pairs(&all);
    sl_from_region_result_destroy(context, &some);
    sl_from_region_result_destroy(context, &all);
    sl_from_region_scene_destroy(context, scene);
}

static void methods_find_the_same(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    uint64_t sampled = 0, exact = 0;
    for (uint64_t seed = 1; seed <= RANDOM_MAPS; seed++) {
        sl_map map = {0};
        char name[64];
        assert_ok(context, oracle_random_map(context, 1900 + seed, (oracle_grid)(seed % 3), &map));
        assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
        const sl_box b = sl_map_bounds(&map);
        const sl_box lower = {b.min, {(b.min.x + b.max.x) / 2, (b.min.y + b.max.y) / 2}};
        const sl_box upper = {{b.min.x, lower.max.y}, {lower.max.x, b.max.y}};
        assert_ok(context, sl_map_add_object(context, &map, "lower", lower, 0));
        assert_ok(context, sl_map_add_object(context, &map, "upper", upper, 0));
        for (int cells = SL_VIEW_CELLS_GRID; cells <= SL_VIEW_CELLS_BOXES; cells++)
            for (int objects = SL_OBJECTS_WALLS; objects <= SL_OBJECTS_CELLS; objects++) {
                sl_from_region_scene_options what = sl_from_region_scene_options_default();
                what.view_cells = (sl_view_cell_kind)cells;
                what.objects = (sl_object_kind)objects;
                what.grid = 1 + (uint32_t)(seed % 5);
                what.groups = 3;
                snprintf(name, sizeof name, "seed %d, view cells %d, objects %d", (int)seed, cells,
                         objects);
                check_scene(context, name, &map, &what, seed, &sampled, &exact);
            }
        sl_map_destroy(context, &map);
    }
    print_message("%d pairs sampled of %d\n", (int)sampled, (int)exact);
    assert_true(sampled * 100 > exact * 80 && sampled < exact);
    sl_context_destroy(context);
}

static void boundaries_are_counted(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space;
    testing_space(context,
                  "walls 0 0 12 0 12 9 0 9 0 0\nwall 6 0 6 4\nwall 6 5 6 9\nstart 1 1 0\n"
                  "object west 0 0 6 9\nobject east 6 0 12 9\n",
                  &map, &space);
    sl_from_region_scene_options what = sl_from_region_scene_options_default();
    what.view_cells = SL_VIEW_CELLS_BOXES;
    what.objects = SL_OBJECTS_WALLS;
    sl_from_region_scene *scene;
    assert_ok(context, sl_from_region_scene_create(context, &map, &what, &scene));
    sl_from_region_counts counts = sl_from_region_scene_count(scene);
    assert_int_equal(counts.view_cells, 2);
    assert_int_equal(counts.faces, 2);
    assert_int_equal(counts.boundary_faces, 0);
    assert_int_equal(counts.dependents, 1);
    sl_from_region_scene_destroy(context, scene);
    map.object_count--; // the east is no view cell's: one face leads out of the compound
    assert_ok(context, sl_from_region_scene_create(context, &map, &what, &scene));
    counts = sl_from_region_scene_count(scene);
    assert_int_equal(counts.view_cells, 1);
    assert_int_equal(counts.faces, 1);
    assert_int_equal(counts.boundary_faces, 1);
    sl_from_region_options options = sl_from_region_options_default();
    sl_from_region_result seen = compare_methods(context, "one view cell", scene, options);
    // Through the door the east's far walls are seen, though no view cell lies there.
    assert_int_equal(seen.objects, counts.objects);
    assert_int_equal(sl_from_region_pairs(&seen), counts.objects);
    sl_from_region_result_destroy(context, &seen);
    sl_from_region_scene_destroy(context, scene);
    map.object_count++;
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// A view cell on both sides of another.
static void cycles_are_named_and_cut(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space;
    testing_space(context,
                  "walls 0 0 9 0 9 9 0 9 0 0\nstart 1 1 0\n"
                  "object hook 0 0 3 9\nobject eye 3 0 6 9\nobject hook 6 0 9 9\n",
                  &map, &space);
    sl_from_region_scene_options what = sl_from_region_scene_options_default();
    what.view_cells = SL_VIEW_CELLS_BOXES;
    what.objects = SL_OBJECTS_WALLS;
    sl_from_region_scene *scene = NULL;
    assert_int_equal(sl_from_region_scene_create(context, &map, &what, &scene), SL_BAD_INPUT);
    assert_null(scene);
    const char *message = sl_context_message(context);
    assert_non_null(strstr(message, "cycle"));
    assert_non_null(strstr(message, "'hook'"));
    assert_non_null(strstr(message, "'eye'"));
    what.cut_cycles = true;
    assert_ok(context, sl_from_region_scene_create(context, &map, &what, &scene));
    assert_int_equal(sl_from_region_scene_count(scene).view_cells, 3);
    sl_from_region_result seen =
        compare_methods(context, "cut", scene, sl_from_region_options_default());
    sl_from_region_result_destroy(context, &seen);
    sl_from_region_scene_destroy(context, scene);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// In a grid at most two view cells depend on one, and so no more than twice as many candidates are
/// tested as are seen (Laine 2005, section 6.3).
static void work_is_bounded_by_output(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    read_map(context, "maps/office.map", &map);
    for (uint32_t grid = 2; grid <= 16; grid *= 2) {
        sl_from_region_scene_options what = sl_from_region_scene_options_default();
        what.grid = grid;
        what.objects = SL_OBJECTS_WALLS;
        sl_from_region_scene *scene;
        assert_ok(context, sl_from_region_scene_create(context, &map, &what, &scene));
        assert_true(sl_from_region_scene_count(scene).dependents <= 2);
        assert_int_equal(sl_from_region_scene_count(scene).boundary_faces, 0);
        sl_from_region_options options = sl_from_region_options_default();
        sl_from_region_result seen = see(context, scene, 2, &options);
        assert_true(seen.relations > 0 && seen.candidates <= 2 * seen.relations);
        sl_from_region_result_destroy(context, &seen);
        sl_from_region_scene_destroy(context, scene);
    }
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void lack_of_memory_is_told_and_leaves_nothing(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_map map = {0};
    sl_space space;
    testing_space(context,
                  "walls 0 0 12 0 12 9 0 9 0 0\nwall 6 0 6 4\nstart 1 1 0\n"
                  "object hook 0 0 4 9\nobject eye 4 0 8 9\nobject hook 8 0 12 9\n",
                  &map, &space);
    const long live = memory.live;
    for (size_t solver = 0; solver < 2; solver++)
        for (size_t m = 0; m < method_count(); m++) {
            sl_status status = SL_NO_MEMORY;
            long calls = 0;
            for (long fail_at = 1; status == SL_NO_MEMORY; fail_at++, calls++) {
                size_t count;
                sl_from_region_scene_options what = sl_from_region_scene_options_default();
                what.view_cells = SL_VIEW_CELLS_BOXES;
                what.objects = SL_OBJECTS_BOXES;
                what.cut_cycles = true;
                sl_from_region_options options = sl_from_region_options_default();
                options.threads = 1;
                options.points = 8;
                options.pixels = 4;
                options.solver = &sl_from_region_solvers(&count)[solver];
                options.stab = sl_funnel();
                sl_from_region_scene *scene = NULL;
                sl_from_region_result result = {0};
                memory.calls = 0;
                memory.fail_at = fail_at;
                status = sl_from_region_scene_create(context, &map, &what, &scene);
                if (status == SL_OK)
                    status =
                        sl_from_region_methods(&count)[m].see(context, scene, &options, &result);
                memory.fail_at = 0;
                sl_from_region_result_destroy(context, &result);
                sl_from_region_scene_destroy(context, scene);
                assert_int_equal(memory.live, live);
            }
            assert_int_equal(status, SL_OK);
            assert_true(calls > 30);
        }
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void what_makes_no_sense_is_refused(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space;
    sl_from_region_scene *scene = NULL;
    testing_space(context, "walls 0 0 12 0 12 9 0 9 0 0\n", &map, &space);
    sl_from_region_scene_options what = sl_from_region_scene_options_default();
    what.grid = 0;
    assert_int_equal(sl_from_region_scene_create(context, &map, &what, &scene), SL_BAD_ARGUMENT);
    what.grid = SL_VIEW_GRID_MOST + 1;
    assert_int_equal(sl_from_region_scene_create(context, &map, &what, &scene), SL_BAD_ARGUMENT);
    what = sl_from_region_scene_options_default();
    what.objects = SL_OBJECTS_BOXES;
    assert_int_equal(sl_from_region_scene_create(context, &map, &what, &scene), SL_BAD_INPUT);
    assert_non_null(strstr(sl_context_message(context), "no object"));
    what = sl_from_region_scene_options_default();
    what.groups = 0;
    assert_int_equal(sl_from_region_scene_create(context, &map, &what, &scene), SL_BAD_ARGUMENT);
    what = sl_from_region_scene_options_default();
    what.grid = 2;
    assert_ok(context, sl_from_region_scene_create(context, &map, &what, &scene));
    size_t count;
    const sl_from_region_method *methods = sl_from_region_methods(&count);
    sl_from_region_result result;
    sl_from_region_options options = sl_from_region_options_default();
    options.points = 0;
    assert_int_equal(methods[0].see(context, scene, &options, &result), SL_BAD_ARGUMENT);
    options = sl_from_region_options_default();
    options.pixels = 0;
    assert_int_equal(methods[0].see(context, scene, &options, &result), SL_BAD_ARGUMENT);
    options = sl_from_region_options_default();
    options.solver = solver_of("stabs");
    assert_int_equal(methods[0].see(context, scene, &options, &result), SL_BAD_ARGUMENT);
    sl_from_region_scene_destroy(context, scene);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// Walls without a side inside are not objects.
static void what_lies_outside_is_no_object(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space;
    sl_from_region_scene *scene;
    testing_space(context,
                  "walls 0 0 8 0 8 8 0 8 0 0\nwalls 10 0 12 0 12 2 10 2 10 0\n"
                  "wall 3 3 5 3\nstart 1 1 0\n",
                  &map, &space);
    sl_from_region_scene_options what = sl_from_region_scene_options_default();
    what.objects = SL_OBJECTS_WALLS;
    assert_ok(context, sl_from_region_scene_create(context, &map, &what, &scene));
    assert_int_equal(sl_from_region_scene_count(scene).objects, 5);
    sl_from_region_scene_destroy(context, scene);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// Far from the origin, where neighbouring doubles are farther apart than a sample's lines.
static void far_maps_are_sampled(void **state) {
    (void)state;
    const double far[] = {0, 0x1p40, 0x1p52, -0x1p52};
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < sizeof far / sizeof *far; i++) {
        const sl_point corner = {far[i], -far[i]};
        const sl_point at[] = {corner,
                               {corner.x + 8, corner.y},
                               {corner.x + 8, corner.y + 8},
                               {corner.x, corner.y + 8},
                               corner};
        sl_map map = {0};
        sl_from_region_scene *scene;
        for (int k = 0; k < 4; k++)
            assert_ok(context, sl_map_add_wall(context, &map, at[k], at[k + 1], 0));
        sl_from_region_scene_options what = sl_from_region_scene_options_default();
        what.grid = 2;
        what.objects = SL_OBJECTS_WALLS;
        assert_ok(context, sl_from_region_scene_create(context, &map, &what, &scene));
        sl_from_region_options options = sl_from_region_options_default();
        options.solver = solver_of("sampling");
        options.points = 64;
        options.pixels = 16;
        sl_from_region_result seen = compare_methods(context, "a far room", scene, options);
        assert_int_equal(sl_from_region_pairs(&seen), 4 * 4);
        sl_from_region_result_destroy(context, &seen);
        sl_from_region_scene_destroy(context, scene);
        sl_map_destroy(context, &map);
    }
    sl_context_destroy(context);
}

static void a_map_without_walls_is_refused(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const sl_map map = {0};
    const sl_from_region_scene_options what = sl_from_region_scene_options_default();
    sl_from_region_scene *scene = NULL;
    assert_int_equal(sl_from_region_scene_create(context, &map, &what, &scene), SL_BAD_INPUT);
    assert_non_null(strstr(sl_context_message(context), "no walls"));
    assert_null(scene);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(leaves_see_what_cells_see),
        cmocka_unit_test(methods_find_the_same),
        cmocka_unit_test(boundaries_are_counted),
        cmocka_unit_test(cycles_are_named_and_cut),
        cmocka_unit_test(work_is_bounded_by_output),
        cmocka_unit_test(lack_of_memory_is_told_and_leaves_nothing),
        cmocka_unit_test(what_makes_no_sense_is_refused),
        cmocka_unit_test(what_lies_outside_is_no_object),
        cmocka_unit_test(far_maps_are_sampled),
        cmocka_unit_test(a_map_without_walls_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

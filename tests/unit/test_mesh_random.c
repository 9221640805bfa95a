/// Meshes of random maps, oblique, degenerate, turned and moved: cells tile the bounds, exact
/// methods agree, no free sightline is lost, and what is set among walls is as tight as they are.
#include "effects/filtered.h"
#include "sight/eye_search.h"
#include "sight/region.h"
#include "space/outline.h"
#include "space/subdivide.h"
#include "unit/grid_walls.h"
#include "unit/mesh_scene.h"

#include "oracle/blockers.h"
#include "oracle/oracle.h"
#include "oracle/random_map.h"
#include "sightline/generate.h"
#include "sightline/support.h"

// --- what every scene must pass

static void check_methods(const scene *s) {
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    for (int sight = SL_CLOSED; sight <= SL_OPEN; sight++) {
        sl_visibility swept = scene_see(s, &s->space, "sweep", (sl_sight)sight);
        for (size_t i = 0; i < count; i++) {
            if (!methods[i].stabs) continue; // the exact ones but for the sweep
            sl_visibility seen = scene_see(s, &s->space, methods[i].name, (sl_sight)sight);
            assert_int_equal(seen.guarantee, SL_EXACT);
            if (!testing_same_rows(&swept.pvs, &seen.pvs))
                fail_msg("%s: %s does not see what the sweep does, sight %d", s->name,
                         methods[i].name, sight);
            sl_visibility_destroy(s->context, &seen);
        }
        sl_visibility_destroy(s->context, &swept);
    }
}

/// Gives the number of free sightlines that were held against what is seen.
static uint64_t check_sightlines(const scene *s, uint64_t seed, int tries) {
    sl_visibility v = scene_see(s, &s->space, "sweep", SL_CLOSED);
    sl_random random = {seed};
    uint64_t checked = 0;
    for (int i = 0; i < tries; i++) {
        const sl_point p = oblique_random_point(&random, &s->map, s->space.bounds);
        const sl_point q = oblique_random_point(&random, &s->map, s->space.bounds);
        if (sl_space_locate(&s->space, p) == SL_NO_CELL ||
            sl_space_locate(&s->space, q) == SL_NO_CELL)
            continue;
        const bool clean = oblique_is_free(&s->map, p, q), as_read = scene_is_free(s, p, q);
        if (as_read && !clean)
            fail_msg("%s: a wall was moved by more than %g into %a %a to %a %a", s->name,
                     s->account.largest_move, p.x, p.y, q.x, q.y);
        if (clean && !scene_sees(s, &v, p, q))
            fail_msg("%s: lost from %a %a to %a %a", s->name, p.x, p.y, q.x, q.y);
        checked += as_read;
    }
    sl_visibility_destroy(s->context, &v);
    return checked;
}

static scene begin(const char *what, int kind, uint64_t seed) {
    scene s = {.context = testing_context(NULL)};
    snprintf(s.name, sizeof s.name, "%s %d, seed %d", what, kind, (int)seed);
    return s;
}

// --- oblique maps

static void add_seams(scene *s, uint64_t seed, oblique_grid grid) {
    sl_random random = {seed};
    for (int i = 0; i < 3; i++) {
        double at[4];
        for (int k = 0; k < 4; k++) at[k] = oblique_coordinate(&random, grid);
        const sl_segment seam = {{at[0], at[1]}, {at[2], at[3]}};
        assert_ok(s->context, sl_map_add_seam(s->context, &s->read, seam, 0));
    }
}

static void walls_of_all_kinds(void **state) {
    (void)state;
    const double welds[] = {-1, 1e-9, 0.02};
    const uint64_t seeds = testing_seeds(24);
    uint64_t checked = 0;
    for (int grid = 0; grid < OBLIQUE_GRIDS; grid++)
        for (uint64_t seed = 1; seed <= seeds; seed++) {
            scene s = begin("grid", grid, seed);
            assert_ok(s.context,
                      oblique_random_map(s.context, seed, (oblique_grid)grid, 16, &s.read));
            if (seed % 2) add_seams(&s, seed, (oblique_grid)grid);
            const sl_box b = sl_map_bounds(&s.read);
            const double size = fmax(b.max.x - b.min.x, b.max.y - b.min.y);
            const double weld = welds[seed / 2 % 3];
            if (scene_make(&s, weld < 0 ? weld : weld * size)) {
                scene_prove(&s);
                check_methods(&s);
                checked += check_sightlines(&s, seed, 60);
            }
            scene_end(&s);
        }
    assert_true(checked > 40 * seeds);
}

/// What is not clean is made planar by the way, or refused.
static void walls_that_are_not_clean(void **state) {
    (void)state;
    const uint64_t seeds = testing_seeds(24);
    uint64_t made = 0, refused = 0;
    for (int grid = 0; grid < OBLIQUE_GRIDS; grid++)
        for (uint64_t seed = 100; seed < 100 + seeds; seed++) {
            char why[ORACLE_WHY];
            scene s = begin("raw grid", grid, seed);
            assert_ok(s.context,
                      oblique_random_map(s.context, seed, (oblique_grid)grid, 16, &s.read));
            if (seed % 2) add_seams(&s, seed, (oblique_grid)grid);
            const sl_status status = sli_subdivide_mesh(s.context, &s.read, &s.space);
            if (status == SL_OK) {
                assert_ok(s.context, sl_space_check(s.context, &s.space));
                if (!oracle_is_tiling(&s.space, why)) fail_msg("%s: %s", s.name, why);
                made++;
            } else {
                assert_int_equal(status, SL_UNSUPPORTED);
                refused++;
            }
            scene_end(&s);
        }
    assert_true(made > 50 * refused);
}

/// Walls on a small grid: sightlines are told free in integers.
static void grid_walls(void **state) {
    (void)state;
    const struct {
        double scale, shift;
    } places[] = {{1, 0}, {0x1p-400, 0}, {0x1p400, 0}, {1, 0x1p40}};
    sl_random random = {3};
    const uint64_t maps = testing_seeds(400);
    uint64_t checked = 0;
    for (uint64_t i = 0; i < maps; i++) {
        scene s = begin("grid walls", (int)(i % 4), i);
        const drawn d = draw(&random, (int)(i % 4));
        const double scale = places[i / 4 % 4].scale, shift = places[i / 4 % 4].shift;
        for (int k = 0; k < d.count; k++)
            assert_ok(s.context, sl_map_add_wall(s.context, &s.read, scaled(d.a[k], scale, shift),
                                                 scaled(d.b[k], scale, shift), 0));
        assert_true(scene_make(&s, -1));
        scene_prove(&s);
        check_methods(&s);
        sl_visibility v = scene_see(&s, &s.space, "sweep", SL_CLOSED);
        checked += (uint64_t)check_free(&d, &s.space, &v.pvs, scale, shift, &random);
        sl_visibility_destroy(s.context, &v);
        scene_end(&s);
    }
    assert_true(checked > 3 * maps);
}

/// The same walls in another order make the same cells.
static void the_order_of_walls_does_not_count(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 30; seed++) {
        scene a = begin("order", 0, seed), b = begin("order", 1, seed);
        assert_ok(a.context, oblique_random_map(a.context, seed, OBLIQUE_TENTHS, 30, &a.read));
        for (size_t i = a.read.wall_count; i-- > 0;)
            assert_ok(b.context, sl_map_add_wall(b.context, &b.read, a.read.walls[i].b,
                                                 a.read.walls[i].a, a.read.walls[i].line));
        const bool made = scene_make(&a, -1);
        assert_int_equal(scene_make(&b, -1), made);
        if (made) {
            assert_int_equal(a.space.vertex_count, b.space.vertex_count);
            assert_memory_equal(a.space.vertices, b.space.vertices,
                                a.space.vertex_count * sizeof *a.space.vertices);
            assert_int_equal(a.space.directed_count, b.space.directed_count);
            if (a.space.directed_count)
                assert_memory_equal(a.space.directed, b.space.directed,
                                    a.space.directed_count * sizeof *a.space.directed);
        }
        scene_end(&a);
        scene_end(&b);
    }
}

static void methods_agree_with_rationals(void **state) {
    (void)state;
    const uint64_t seeds = testing_seeds(12);
    uint64_t compared = 0;
    for (int grid = 0; grid < OBLIQUE_GRIDS; grid++)
        for (uint64_t seed = 400; seed < 400 + seeds; seed++) {
            scene s = begin("grid", grid, seed);
            assert_ok(s.context,
                      oblique_random_map(s.context, seed, (oblique_grid)grid, 5, &s.read));
            const bool made = scene_make(&s, -1);
            const size_t count = s.space.cell_count;
            bool *matrix[2] = {calloc(count * count + 1, sizeof(bool)),
                               calloc(count * count + 1, sizeof(bool))};
            assert_true(matrix[0] && matrix[1]);
            if (made && oracle_by_sequences(&s.space, 3000, matrix[0], matrix[1])) {
                compared++;
                for (int k = 0; k < 2; k++) {
                    sl_visibility v = scene_see(&s, &s.space, "sweep", k ? SL_OPEN : SL_CLOSED);
                    for (uint32_t i = 0; i < count * count; i++)
                        assert_int_equal(
                            sl_pvs_sees(&v.pvs, i / (uint32_t)count, i % (uint32_t)count),
                            matrix[k][i]);
                    sl_visibility_destroy(s.context, &v);
                }
                check_methods(&s);
            }
            free(matrix[0]);
            free(matrix[1]);
            scene_end(&s);
        }
    assert_true(compared > 4 * seeds);
}

// --- axial maps, turned and moved

static const double angles[] = {17.3, 33, 45, 0.001};

static void turned_maps(void **state) {
    (void)state;
    const uint64_t maps = testing_seeds(300);
    uint64_t checked = 0;
    for (uint64_t seed = 1; seed <= maps; seed++) {
        scene s = begin("turned map", (int)(seed % 3), seed);
        assert_ok(s.context, oracle_random_map(s.context, seed, (oracle_grid)(seed % 3), &s.read));
        oblique_turn_map(&s.read, angles[seed / 3 % 4], seed / 12 % 2 ? 1e6 : 0);
        if (scene_make(&s, -1)) {
            scene_prove(&s);
            check_methods(&s);
            checked += check_sightlines(&s, seed, 30);
        }
        scene_end(&s);
    }
    assert_true(checked > 2 * maps);
}

/// Generated plans of all kinds: what met before meets again, so that no room is opened.
static void turned_plans(void **state) {
    (void)state;
    size_t kinds;
    uint64_t checked = 0;
    const sl_map_kind *kind = sl_map_kinds(&kinds);
    for (size_t k = 0; k < kinds; k++)
        for (int move = 0; move < 2; move++) {
            scene s = begin("plan", (int)k, 1);
            sl_generate_options how = sl_generate_options_default();
            how.walls = 250;
            assert_ok(s.context, sl_generate(s.context, &kind[k], &how, &s.read));
            const size_t walls = s.read.wall_count;
            oblique_turn_map(&s.read, angles[k % 4], move ? 1e6 : 0);
            assert_true(scene_make(&s, -1));
            scene_prove(&s);
            assert_int_equal(s.map.wall_count, walls);
            assert_int_equal(s.account.crossings, 0);
            check_methods(&s);
            checked += check_sightlines(&s, k, 1000);
            scene_end(&s);
        }
    assert_true(checked > 50);
}

// --- what is set among walls

/// Which cells are joined by portals: each has the lowest cell of its part.
static uint32_t *parts_of(const sl_space *s) {
    uint32_t *part = calloc(s->cell_count, sizeof *part);
    assert_non_null(part);
    for (uint32_t i = 0; i < s->cell_count; i++) part[i] = i;
    for (bool more = true; more;) {
        more = false;
        for (uint32_t i = 0; i < s->portal_count; i++) {
            uint32_t *a = &part[s->portals[i].cell[0]], *b = &part[s->portals[i].cell[1]];
            if (*a == *b) continue;
            *a = *b = *a < *b ? *a : *b;
            more = true;
        }
    }
    return part;
}

/// Two spaces of the same walls, in different cells.
typedef struct twins {
    sl_context *context;
    const char *name;
    const sl_space *one, *other;
    const sl_map *walls; ///< what of them both have
} twins;

/// Whether the segment touches none of the places at which answers could hang on an end.
static bool is_plain(const sl_map *map, sl_point p, sl_point q) {
    for (size_t i = 0; i < map->wall_count; i++) {
        const sl_wall *w = &map->walls[i];
        if (!blockers_turn(w->a, w->b, p) || !blockers_turn(w->a, w->b, q) ||
            !blockers_turn(p, q, w->a) || !blockers_turn(p, q, w->b))
            return false;
    }
    return true;
}

static uint64_t check_twins(const twins *t, uint64_t seed) {
    sl_outline outlines[2] = {0};
    uint32_t *parts[2] = {parts_of(t->one), parts_of(t->other)};
    sl_random random = {seed};
    uint64_t seen_count = 0;
    assert_ok(t->context, sli_outline_make(t->context, t->one, &outlines[0]));
    assert_ok(t->context, sli_outline_make(t->context, t->other, &outlines[1]));
    for (int i = 0; i < 60; i++) {
        const sl_point p = oblique_random_point(&random, t->walls, t->one->bounds);
        const sl_point q = oblique_random_point(&random, t->walls, t->one->bounds);
        const uint32_t a[2] = {sl_space_locate(t->one, p), sl_space_locate(t->other, p)};
        const uint32_t b[2] = {sl_space_locate(t->one, q), sl_space_locate(t->other, q)};
        if (a[0] == SL_NO_CELL || b[0] == SL_NO_CELL || !is_plain(t->walls, p, q)) continue;
        bool seen[2];
        for (int k = 0; k < 2; k++)
            assert_ok(t->context, sli_sees(t->context, &outlines[k], p, q, SL_CLOSED, &seen[k]));
        const bool is_free = oblique_is_free(t->walls, p, q);
        if (seen[0] != is_free || seen[1] != is_free)
            fail_msg("%s: %a %a sees %a %a: %d, %d, by walls %d", t->name, p.x, p.y, q.x, q.y,
                     seen[0], seen[1], is_free);
        if ((parts[0][a[0]] == parts[0][b[0]]) != (parts[1][a[1]] == parts[1][b[1]]))
            fail_msg("%s: a way from %a %a to %a %a is in one of them only", t->name, p.x, p.y, q.x,
                     q.y);
        seen_count += is_free;
    }
    for (int k = 0; k < 2; k++) {
        sli_outline_destroy(t->context, &outlines[k]);
        free(parts[k]);
    }
    return seen_count;
}

static void add_doors(scene *s, uint64_t seed, oblique_grid grid) {
    sl_random random = {seed + 7};
    for (int i = 0; i < 3; i++) {
        double at[4];
        char name[8];
        for (int k = 0; k < 4; k++) at[k] = oblique_coordinate(&random, grid);
        snprintf(name, sizeof name, "d%d", i);
        const sl_segment door = {{at[0], at[1]}, {at[2], at[3]}};
        assert_ok(s->context, sl_map_add_door(s->context, &s->read, name, door, true, 0));
    }
}

/// The clean map with walls in the place of its doors, and of one-way glass that is dark for an
/// eye.
static void wall_up(const scene *s, const sl_point *eye, sl_map *out) {
    assert_ok(s->context, sl_map_copy(s->context, &s->map, out));
    for (size_t i = 0; i < s->map.door_count && !eye; i++) {
        const sl_door *door = &s->map.doors[i];
        const sl_segment *parts = door->parts ? door->parts : &door->segment;
        for (size_t k = 0; k < (door->parts ? door->part_count : 1); k++)
            assert_ok(s->context, sl_map_add_wall(s->context, out, parts[k].a, parts[k].b, 0));
    }
    for (size_t i = 0; i < s->map.oneway_count && eye; i++) {
        const sl_segment glass = s->map.oneways[i].segment;
        if (blockers_turn(glass.a, glass.b, *eye) > 0)
            assert_ok(s->context, sl_map_add_wall(s->context, out, glass.a, glass.b, 0));
    }
}

/// A space past doors that are shut, or glass for an eye, beside that of walls in their place.
static uint64_t check_walled(const scene *s, const sli_filtered_space *filtered, uint64_t seed) {
    sl_map map = {0};
    sl_space walled = {0}, past = {0};
    char why[ORACLE_WHY];
    wall_up(s, filtered->eye, &map);
    assert_ok(s->context, sl_map_clean(s->context, &map, NULL, NULL));
    assert_ok(s->context, sli_subdivide_mesh(s->context, &map, &walled));
    assert_ok(s->context, sli_filtered_space_make(s->context, &s->space, filtered, NULL, &past));
    assert_ok(s->context, sl_space_check(s->context, &past));
    if (!oracle_is_tiling(&past, why)) fail_msg("%s, past doors: %s", s->name, why);
    const twins t = {s->context, s->name, &past, &walled, &map};
    const uint64_t seen = check_twins(&t, seed);
    sl_space_destroy(s->context, &past);
    sl_space_destroy(s->context, &walled);
    sl_map_destroy(s->context, &map);
    return seen;
}

static void shut_doors_are_as_tight_as_walls(void **state) {
    (void)state;
    const bool shut[3] = {true, true, true};
    const sli_filtered_space all_shut = {.shut = shut}, all_open = {0};
    const uint64_t seeds = testing_seeds(12);
    uint64_t seen = 0;
    for (int grid = 0; grid < OBLIQUE_GRIDS; grid++)
        for (uint64_t seed = 1; seed <= seeds; seed++) {
            scene s = begin("doors, grid", grid, seed);
            assert_ok(s.context,
                      oblique_random_map(s.context, seed, (oblique_grid)grid, 12, &s.read));
            add_doors(&s, seed, (oblique_grid)grid);
            if (scene_make(&s, -1)) {
                scene_prove(&s);
                check_methods(&s);
                seen += check_walled(&s, &all_shut, seed);
                sl_space past;
                assert_ok(s.context,
                          sli_filtered_space_make(s.context, &s.space, &all_open, NULL, &past));
                assert_int_equal(past.portal_count, s.space.portal_count);
                sl_space_destroy(s.context, &past);
            }
            scene_end(&s);
        }
    assert_true(seen > 20 * seeds);
}

static void dark_glass_is_as_tight_as_walls(void **state) {
    (void)state;
    const uint64_t seeds = testing_seeds(8);
    uint64_t seen = 0;
    for (int grid = 0; grid < OBLIQUE_GRIDS; grid++)
        for (uint64_t seed = 1; seed <= seeds; seed++) {
            scene s = begin("glass, grid", grid, seed);
            sl_random random = {seed + 9};
            assert_ok(s.context,
                      oblique_random_map(s.context, seed, (oblique_grid)grid, 12, &s.read));
            for (int i = 0; i < 3; i++) {
                double at[4];
                for (int k = 0; k < 4; k++) at[k] = oblique_coordinate(&random, (oblique_grid)grid);
                const sl_segment glass = {{at[0], at[1]}, {at[2], at[3]}};
                assert_ok(s.context, sl_map_add_oneway(s.context, &s.read, glass, 0));
            }
            if (scene_make(&s, -1)) {
                scene_prove(&s);
                const sl_point eye = oblique_random_point(&random, &s.map, s.space.bounds);
                const sli_filtered_space filtered = {.eye = &eye};
                bool on_glass = false;
                for (size_t i = 0; i < s.map.oneway_count; i++) {
                    const sl_segment glass = s.map.oneways[i].segment;
                    on_glass |= blockers_turn(glass.a, glass.b, eye) == 0;
                }
                if (!on_glass) seen += check_walled(&s, &filtered, seed);
            }
            scene_end(&s);
        }
    assert_true(seen > 20 * seeds);
}

static bool eye_sees(const scene *s, const sl_space *space, sl_point eye, sl_point point) {
    const sl_visibility none = {.sight = SL_CLOSED};
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    sli_eye_search *search = NULL;
    sl_eye_account account;
    uint64_t *cells = calloc(sl_eye_words(space), sizeof *cells);
    assert_non_null(cells);
    assert_ok(s->context, sli_eye_search_create(s->context, space, &none, &search));
    const sl_view view = sl_view_all_round(eye);
    assert_ok(s->context, methods[count - 1].cull(s->context, search, &view, cells, &account));
    const bool seen = sl_eye_sees(cells, sl_space_locate(space, point));
    sli_eye_search_destroy(s->context, search);
    free(cells);
    return seen;
}

/// A door beside an oblique wall was leaky where its cells' corners were rounded.
static void a_door_beside_an_oblique_wall(void **state) {
    (void)state;
    scene s = scene_of_text("walls 0 0 12 0 12 5 0 5 0 0\nwall 8 0 8 2\ndoor d0 8 5 8 2 open\n"
                            "wall 5 1 3 4\n");
    const sl_point eye = {6, 2.5};
    const bool shut = true;
    const sli_filtered_space filtered = {.shut = &shut};
    sl_space past;
    assert_ok(s.context, sli_filtered_space_make(s.context, &s.space, &filtered, NULL, &past));
    sl_visibility seen = scene_see(&s, &past, "sweep", SL_CLOSED);
    for (int i = 0; i < 40; i++) {
        const sl_point behind = {8.05 + 0.09 * i, 0.1 + 0.12 * i};
        assert_true(eye_sees(&s, &s.space, eye, (sl_point){9, 2.5}));
        assert_false(eye_sees(&s, &past, eye, behind));
        assert_false(
            sl_pvs_sees(&seen.pvs, sl_space_locate(&past, eye), sl_space_locate(&past, behind)));
    }
    sl_visibility_destroy(s.context, &seen);
    sl_space_destroy(s.context, &past);
    scene_end(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(walls_of_all_kinds),
        cmocka_unit_test(walls_that_are_not_clean),
        cmocka_unit_test(grid_walls),
        cmocka_unit_test(the_order_of_walls_does_not_count),
        cmocka_unit_test(methods_agree_with_rationals),
        cmocka_unit_test(turned_maps),
        cmocka_unit_test(turned_plans),
        cmocka_unit_test(shut_doors_are_as_tight_as_walls),
        cmocka_unit_test(dark_glass_is_as_tight_as_walls),
        cmocka_unit_test(a_door_beside_an_oblique_wall),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

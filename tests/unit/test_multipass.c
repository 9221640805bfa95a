// The multipass method against the search and the sweep, for any number of sectors and threads; the
// sectors and their orders themselves; and lines of a sector alone, by each solver that tells them.
#include "map_files.h"

#include "cell_to_cell/search/sectors.h"
#include "oracle/convex_space.h"
#include "oracle/random_map.h"
#include "sightline/glpk.h"
#include "sightline/support.h"
#include "space/subdivide.h"

#include <math.h>

enum { RANDOM_MAPS = 200, RANDOM_SPACES = 400, RANDOM_SEQUENCES = 6000, SEQUENCE_MOST = 5 };

static sl_visibility see(sl_context *context, const sl_space *space, const char *name,
                         sl_see_options options) {
    const sl_see_method *method = testing_method(name);
    if (!options.solver) options.solver = method->stabs ? sl_funnel() : NULL;
    sl_visibility seen;
    assert_ok(context, method->see(context, space, &options, &seen));
    return seen;
}

/// Multipass with several numbers of sectors and threads sees what another method does.
static void compare(sl_context *context, const char *name, const sl_space *space,
                    const char *other) {
    static const uint32_t sectors[] = {4, 8, 0};
    for (int sight = SL_CLOSED; sight <= SL_OPEN; sight++)
        for (int inside = 0; inside < 2; inside++) {
            sl_see_options options = sl_see_options_default();
            options.sight = (sl_sight)sight;
            options.inside_only = inside;
            options.threads = 1;
            sl_visibility expected = see(context, space, other, options);
            for (size_t i = 0; i < sizeof sectors / sizeof *sectors; i++) {
                options.sectors = sectors[i];
                options.threads = (unsigned)(1 + i % 2);
                sl_visibility seen = see(context, space, "multipass", options);
                if (!testing_same_rows(&seen.pvs, &expected.pvs))
                    fail_msg("%s, %s sight, %u sectors: other pairs than by '%s'", name,
                             sight == SL_CLOSED ? "closed" : "open", sectors[i], other);
                assert_int_equal(seen.account.pairs, expected.account.pairs);
                assert_true(seen.account.multipass.candidates >= seen.account.multipass.relations);
                if (!sectors[i]) assert_int_equal(seen.account.multipass.on_cycles, 0);
                sl_visibility_destroy(context, &seen);
            }
            sl_visibility_destroy(context, &expected);
        }
}

static void check_file(const char *path) {
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space;
    map_files_cut(context, path, &map, &space);
    compare(context, path, &space, "dfs");
    sl_map_destroy(context, &map);
    sl_space_destroy(context, &space);
    sl_context_destroy(context);
}

static void maps_are_seen_as_by_the_search(void **state) {
    (void)state;
    map_files_each(MAP_FILES_ALL, check_file);
}

static void random_maps_are_seen_as_by_the_search(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    for (uint64_t seed = 1; seed <= RANDOM_MAPS; seed++) {
        sl_map map = {0};
        sl_space space;
        char name[32];
        snprintf(name, sizeof name, "seed %d", (int)seed);
        assert_ok(context, oracle_random_map(context, 8800 + seed, (oracle_grid)(seed % 3), &map));
        testing_subdivide(context, &map, &space);
        compare(context, name, &space, "dfs");
        sl_map_destroy(context, &map);
        sl_space_destroy(context, &space);
    }
    sl_context_destroy(context);
}

// --- oblique portals

/// Bounds go counter-clockwise, each by less than half a turn from the last, and every portal's
/// direction is one of them where all are asked for.
static void check_sectors(const sl_space *space, const sli_sectors *sectors, bool all) {
    assert_int_equal(sectors->count % 2, 0);
    assert_true(sectors->count >= 4);
    for (uint32_t i = 0; i < sectors->count; i++) {
        const sli_direction_sector c = sli_sectors_get(sectors, i);
        assert_int_equal(sli_turn(c.right.a, c.right.b, c.left.a, c.left.b), 1);
    }
    for (uint32_t p = 0; p < space->portal_count && all; p++) {
        bool found = false;
        for (uint32_t i = 0; i < sectors->count && !found; i++) {
            const sl_line b = sectors->bounds[i];
            found = sli_turn(b.a, b.b, space->portals[p].left, space->portals[p].right) == 0;
        }
        assert_true(found);
    }
}

/// Each cell in one component, and what it depends on in its own or in one before, of a lower
/// level. Returns the cells on cycles.
static uint32_t check_order(const sl_space *space, const sli_pass *pass) {
    const sli_order *order = &pass->order;
    uint32_t on_cycles = 0;
    assert_int_equal(order->starts[order->component_count], space->cell_count);
    for (uint32_t k = 0; k < order->component_count; k++) {
        const uint32_t first = order->starts[k], end = order->starts[k + 1];
        assert_true(end > first);
        if (end - first > 1) on_cycles += end - first;
        for (uint32_t i = first; i < end; i++) {
            const uint32_t cell = order->nodes[i];
            assert_int_equal(order->component[cell], k);
            for (uint32_t f = pass->first[cell]; f < pass->first[cell + 1]; f++) {
                const uint32_t other = order->component[pass->to[f]];
                assert_true(other <= k);
                if (other < k) assert_true(order->level[other] < order->level[k]);
            }
        }
    }
    return on_cycles;
}

static uint32_t check_passes(sl_context *context, const sl_space *space, uint32_t most) {
    sli_sectors sectors;
    assert_ok(context, sli_sectors_create(context, space, most, &sectors));
    check_sectors(space, &sectors, most == 0);
    uint32_t on_cycles = 0;
    for (uint32_t i = 0; i < sectors.count; i++) {
        sli_pass pass;
        assert_ok(context,
                  sli_pass_create(context, space, false, sli_sectors_get(&sectors, i), &pass));
        on_cycles += check_order(space, &pass);
        sli_pass_destroy(context, &pass);
    }
    sli_sectors_destroy(context, &sectors);
    return on_cycles;
}

static void sectors_of_all_directions_have_an_order(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    uint32_t on_cycles_of_quadrants = 0;
    for (uint64_t seed = 1; seed <= RANDOM_SPACES; seed++) {
        sl_space space;
        oracle_random_space(context, seed, &space);
        on_cycles_of_quadrants += check_passes(context, &space, 4);
        assert_int_equal(check_passes(context, &space, 0), 0);
        sl_space_destroy(context, &space);
    }
    assert_true(on_cycles_of_quadrants > 0);
    sl_context_destroy(context);
}

static void oblique_spaces_are_seen_as_by_the_sweep(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    for (uint64_t seed = 1; seed <= RANDOM_SPACES; seed++) {
        sl_space space;
        char name[32];
        snprintf(name, sizeof name, "space %d", (int)seed);
        oracle_random_space(context, seed, &space);
        compare(context, name, &space, "sweep");
        sl_space_destroy(context, &space);
    }
    sl_context_destroy(context);
}

/// Walls at random angles, cut by a mesh.
static void oblique_maps_are_seen_as_by_the_sweep(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {4711};
    for (int round = 0; round < 20; round++) {
        sl_map map = {0};
        sl_space space;
        char name[32];
        snprintf(name, sizeof name, "oblique map %d", round);
        for (int i = 0; i < 12; i++) {
            const sl_point a = {100 * sl_random_unit(&random), 100 * sl_random_unit(&random)};
            const sl_point b = {a.x + 40 * sl_random_unit(&random) - 20,
                                a.y + 40 * sl_random_unit(&random) - 20};
            assert_ok(context, sl_map_add_wall(context, &map, a, b, 0));
        }
        assert_ok(context, sli_subdivide_mesh(context, &map, &space));
        compare(context, name, &space, "sweep");
        assert_int_equal(check_passes(context, &space, 0), 0);
        sl_map_destroy(context, &map);
        sl_space_destroy(context, &space);
    }
    sl_context_destroy(context);
}

// --- lines of some directions alone

static sl_point grid_point(sl_random *random) {
    return (sl_point){(double)sl_random_below(random, 9), (double)sl_random_below(random, 9)};
}

static int side(sl_line line, sl_point p) {
    return sli_orient(line.a, line.b, p);
}

/// Whether a line of the sequence, through two ends or through one in a bound's direction, is of
/// the directions. The lines are a polygon and so are its parts: where there are any, one of these
/// is among them.
static bool any_line(const sl_portal_ends *portals, size_t count, sl_line right, sl_line left) {
    sl_point ends[2 * SEQUENCE_MOST];
    for (size_t i = 0; i < count; i++) {
        ends[2 * i] = portals[i].left;
        ends[2 * i + 1] = portals[i].right;
    }
    for (size_t a = 0; a < 2 * count; a++)
        for (size_t b = 0; b < 2 * count + 2; b++) {
            const sl_line bound = b == 2 * count ? right : left;
            const sl_point way = {bound.b.x - bound.a.x, bound.b.y - bound.a.y};
            const sl_point to =
                b < 2 * count ? ends[b] : (sl_point){ends[a].x + way.x, ends[a].y + way.y};
            const sl_line line = {ends[a], to};
            if (to.x == ends[a].x && to.y == ends[a].y) continue;
            bool good = sli_turn(right.a, right.b, line.a, line.b) >= 0 &&
                        sli_turn(left.a, left.b, line.a, line.b) <= 0;
            for (size_t i = 0; i < count && good; i++)
                good = side(line, portals[i].left) >= 0 && side(line, portals[i].right) <= 0;
            if (good) return true;
        }
    return false;
}

/// A sequence of portals that directions from `right` to `left` all cross forwards, and those
/// directions; false where there are none.
static bool make_sequence(sl_random *random, sl_portal_ends *portals, size_t count,
                          sli_direction_sector *cone) {
    const sl_point zero = {0, 0};
    static const sl_point axes[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    const size_t quadrant = (size_t)sl_random_below(random, 4);
    *cone = (sli_direction_sector){{zero, axes[quadrant]}, {zero, axes[(quadrant + 1) % 4]}};
    for (size_t i = 0; i < count; i++) {
        const sl_point a = grid_point(random), b = grid_point(random);
        if (a.x == b.x && a.y == b.y) return false;
        portals[i] = (sl_portal_ends){a, b};
        const sl_directed_portal directed = {.left = a, .right = b};
        if (!sli_direction_sector_cut(cone, &directed)) return false;
    }
    return true;
}

static void solvers_find_lines_of_a_sector(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const sl_solver *solvers[] = {sl_funnel(), sl_glpk_hybrid(), sl_glpk_exact(),
                                  sl_glpk_simplex()};
    const sl_box bounds = {{0, 0}, {9, 9}};
    size_t hidden = 0, seen = 0;
    for (size_t s = 0; s < sizeof solvers / sizeof *solvers; s++) {
        void *solver;
        sl_random random = {99};
        assert_ok(context, solvers[s]->create(context, bounds, &solver));
        for (int round = 0; round < RANDOM_SEQUENCES; round++) {
            sl_portal_ends portals[SEQUENCE_MOST];
            sli_direction_sector cone;
            const size_t count = 1 + (size_t)sl_random_below(&random, SEQUENCE_MOST);
            if (!make_sequence(&random, portals, count, &cone)) continue;
            sl_stab_verdict all = SL_STABBED, part;
            size_t pushed = 0;
            while (pushed < count && all != SL_HIDDEN) {
                const sl_portal_ends *p = &portals[pushed++];
                assert_ok(context, solvers[s]->push(context, solver, p->left, p->right, &all));
            }
            if (all != SL_HIDDEN) {
                assert_ok(context,
                          solvers[s]->toward(context, solver, cone.right, cone.left, &part));
                const bool there = any_line(portals, count, cone.right, cone.left);
                if (solvers[s]->guarantee == SL_EXACT) {
                    assert_int_equal(part != SL_HIDDEN, there);
                    hidden += !there;
                    seen += there;
                }
                // A rounded solver is bound to it only where it is sure.
                if (part == SL_STABBED) assert_true(there);
                if (part == SL_HIDDEN) assert_false(there);
                assert_true(all == SL_STABBED || part != SL_STABBED);
            }
            while (pushed--) solvers[s]->pop(solver);
        }
        solvers[s]->destroy(context, solver);
    }
    print_message("%zu sequences with a line of the sector, %zu without\n", seen, hidden);
    assert_true(hidden > 100 && seen > 100);
    sl_context_destroy(context);
}

/// Every solver gives what the search gives with it; rounded ones up to the pairs that they doubt.
static void solvers_are_exchangeable(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const sl_solver *solvers[] = {sl_funnel(), sl_glpk_hybrid(), sl_glpk_exact(),
                                  sl_glpk_simplex()};
    sl_map map = {0};
    sl_space space;
    map_files_cut(context, SIGHTLINE_SOURCE_DIR "/maps/grazing.map", &map, &space);
    for (int sight = SL_CLOSED; sight <= SL_OPEN; sight++) {
        sl_see_options options = sl_see_options_default();
        options.sight = (sl_sight)sight;
        sl_visibility expected = see(context, &space, "sweep", options);
        for (size_t s = 0; s < sizeof solvers / sizeof *solvers; s++) {
            options.solver = solvers[s];
            sl_visibility seen = see(context, &space, "multipass", options);
            const bool exact = solvers[s]->guarantee == SL_EXACT;
            if (exact) assert_true(testing_same_rows(&seen.pvs, &expected.pvs));
            assert_int_equal(seen.guarantee, solvers[s]->guarantee);
            for (uint32_t a = 0; a < space.cell_count && !exact; a++)
                for (uint32_t b = 0; b < space.cell_count; b++)
                    assert_true(sl_pvs_sees(&seen.pvs, a, b) == sl_pvs_sees(&expected.pvs, a, b) ||
                                sl_pvs_sees(&seen.doubtful, a, b));
            sl_visibility_destroy(context, &seen);
        }
        sl_visibility_destroy(context, &expected);
    }
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(maps_are_seen_as_by_the_search),
        cmocka_unit_test(random_maps_are_seen_as_by_the_search),
        cmocka_unit_test(sectors_of_all_directions_have_an_order),
        cmocka_unit_test(oblique_spaces_are_seen_as_by_the_sweep),
        cmocka_unit_test(oblique_maps_are_seen_as_by_the_sweep),
        cmocka_unit_test(solvers_find_lines_of_a_sector),
        cmocka_unit_test(solvers_are_exchangeable),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

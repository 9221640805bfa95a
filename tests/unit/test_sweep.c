// The sweep against other ways to the same answer: the depth-first search with the funnel on every
// map, the rational oracle on random spaces with oblique walls; and what it promises beside.
#include "map_files.h"

#include "oracle/convex_space.h"
#include "oracle/oracle.h"
#include "oracle/random_map.h"
#include "sightline/generate.h"
#include "sightline/support.h"
#include "space/subdivide.h"

static const char OFFICE[] = SIGHTLINE_SOURCE_DIR "/maps/office.map";

enum { RANDOM_MAPS = 400, RANDOM_SPACES = 1500, PUSH_LIMIT = 30000 };

static sl_visibility see(sl_context *context, const sl_space *space, const char *name,
                         sl_sight sight, unsigned threads, bool inside_only) {
    const sl_see_method *method = testing_method(name);
    sl_see_options options = sl_see_options_default();
    options.sight = sight;
    options.threads = threads;
    options.inside_only = inside_only;
    options.solver = method->stabs ? sl_funnel() : NULL;
    sl_visibility seen;
    assert_ok(context, method->see(context, space, &options, &seen));
    return seen;
}

static void compare_to_search(sl_context *context, const char *name, const sl_space *space) {
    for (int sight = SL_CLOSED; sight <= SL_OPEN; sight++)
        for (int inside = 0; inside < 2; inside++) {
            sl_visibility dfs = see(context, space, "dfs", (sl_sight)sight, 1, inside);
            sl_visibility sweep = see(context, space, "sweep", (sl_sight)sight, 1, inside);
            if (!testing_same_rows(&dfs.pvs, &sweep.pvs))
                fail_msg("%s, %s sight: the sweep sees other pairs than the search", name,
                         sight == SL_CLOSED ? "closed" : "open");
            assert_int_equal(dfs.account.pairs, sweep.account.pairs);
            assert_int_equal(sweep.guarantee, SL_EXACT);
            sl_visibility_destroy(context, &dfs);
            sl_visibility_destroy(context, &sweep);
        }
}

static void check_file(const char *path) {
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space;
    map_files_cut(context, path, &map, &space);
    compare_to_search(context, path, &space);
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
    const uint64_t seeds = testing_seeds(RANDOM_MAPS);
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        sl_map map = {0};
        sl_space space;
        char name[32];
        snprintf(name, sizeof name, "seed %d", (int)seed);
        assert_ok(context, oracle_random_map(context, 77777 + seed, (oracle_grid)(seed % 3), &map));
        testing_subdivide(context, &map, &space);
        compare_to_search(context, name, &space);
        sl_map_destroy(context, &map);
        sl_space_destroy(context, &space);
    }
    sl_context_destroy(context);
}

// --- oblique walls

static void print_space(const sl_space *space) {
    for (uint32_t c = 0; c < space->cell_count; c++) {
        print_error("cell %u:", c);
        for (uint32_t i = 0; i < space->cells[c].vertex_count; i++) {
            const sl_point p = space->vertices[space->cells[c].first_vertex + i];
            print_error(" %.17g,%.17g", p.x, p.y);
        }
        print_error("\n");
    }
    for (uint32_t i = 0; i < space->portal_count; i++) {
        const sl_portal *p = &space->portals[i];
        print_error("portal %u %u: %.17g,%.17g %.17g,%.17g\n", p->cell[0], p->cell[1], p->left.x,
                    p->left.y, p->right.x, p->right.y);
    }
}

static void compare_to_oracle(sl_context *context, uint64_t seed, const sl_space *space,
                              sl_sight sight, const bool *truth) {
    sl_visibility seen = see(context, space, "sweep", sight, 1, false);
    const uint32_t n = space->cell_count;
    for (uint32_t a = 0; a < n; a++)
        for (uint32_t b = 0; b < n; b++)
            if (sl_pvs_sees(&seen.pvs, a, b) != truth[(size_t)a * n + b]) {
                print_space(space);
                fail_msg("space %d, %s sight: cells %u and %u are %s", (int)seed,
                         sight == SL_CLOSED ? "closed" : "open", a, b,
                         truth[(size_t)a * n + b] ? "hidden, but see each other"
                                                  : "seen, but hidden");
            }
    sl_visibility_destroy(context, &seen);
}

static void oblique_spaces_are_seen_as_by_the_oracle(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const uint64_t count = testing_seeds(RANDOM_SPACES);
    size_t asked = 0, grazing = 0, hidden = 0;
    for (uint64_t seed = 1; seed <= count; seed++) {
        sl_space space;
        oracle_random_space(context, seed, &space);
        const size_t pairs = (size_t)space.cell_count * space.cell_count;
        bool *closed = calloc(pairs, sizeof *closed), *open = calloc(pairs, sizeof *open);
        assert_true(closed && open);
        if (oracle_by_sequences(&space, PUSH_LIMIT, closed, open)) {
            asked++;
            compare_to_oracle(context, seed, &space, SL_CLOSED, closed);
            compare_to_oracle(context, seed, &space, SL_OPEN, open);
            for (size_t i = 0; i < pairs; i++) {
                grazing += closed[i] && !open[i];
                hidden += !closed[i];
            }
        }
        free(closed);
        free(open);
        sl_space_destroy(context, &space);
    }
    print_message("%zu spaces asked, %zu pairs hidden, %zu by grazing lines only\n", asked, hidden,
                  grazing);
    assert_true(asked * 10 > count * 9 && hidden > 0 && grazing > 0);
    sl_context_destroy(context);
}

// --- what is promised beside

static void threads_make_no_difference(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space;
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    map_files_cut(context, OFFICE, &map, &space);
    for (size_t m = 0; m < count; m++) {
        sl_visibility one = see(context, &space, methods[m].name, SL_CLOSED, 1, false);
        for (unsigned threads = 2; threads <= 7; threads += 5) {
            sl_visibility many = see(context, &space, methods[m].name, SL_CLOSED, threads, false);
            assert_true(testing_same_rows(&one.pvs, &many.pvs));
            assert_int_equal(one.account.pairs, many.account.pairs);
            assert_int_equal(one.account.sweep.pieces, many.account.sweep.pieces);
            sl_visibility_destroy(context, &many);
        }
        sl_visibility_destroy(context, &one);
    }
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void lack_of_memory_is_told_and_leaves_nothing(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_map map = {0};
    sl_space space;
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    map_files_cut(context, OFFICE, &map, &space);
    for (size_t m = 1; m < count; m++) {
        sl_see_options options = sl_see_options_default();
        options.threads = 1;
        options.solver = methods[m].stabs ? sl_funnel() : NULL;
        const long live = memory.live;
        sl_status status = SL_NO_MEMORY;
        long calls = 0;
        for (long fail_at = 1; status == SL_NO_MEMORY; fail_at++, calls++) {
            sl_visibility seen = {0};
            memory.calls = 0;
            memory.fail_at = fail_at;
            status = methods[m].see(context, &space, &options, &seen);
            memory.fail_at = 0;
            if (status == SL_OK) sl_visibility_destroy(context, &seen);
            assert_int_equal(memory.live, live);
            assert_null(seen.pvs.bytes);
        }
        assert_int_equal(status, SL_OK);
        assert_true(calls > 3);
    }
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void what_cannot_be_done_is_refused(void **state) {
    (void)state;
    const sl_hooks hooks = {.cancelled = testing_cancelled};
    sl_context *context = testing_context(NULL), *stopped = sl_context_create(&hooks);
    assert_non_null(stopped);
    sl_map map = {0};
    sl_space space;
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    map_files_cut(context, OFFICE, &map, &space);
    for (size_t m = 1; m < count; m++) {
        sl_visibility seen;
        sl_see_options options = sl_see_options_default();
        options.solver = methods[m].stabs ? sl_funnel() : NULL;
        assert_int_equal(methods[m].see(stopped, &space, &options, &seen), SL_CANCELLED);
        options.trees = true;
        assert_int_equal(methods[m].see(context, &space, &options, &seen), SL_UNSUPPORTED);
        assert_non_null(strstr(sl_context_message(context), methods[m].name));
    }
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(stopped);
    sl_context_destroy(context);
}

/// A map so large that rows are sparse and "prune" leaves bounds out.
static void large_maps_are_seen_alike(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space;
    size_t count;
    const sl_map_kind *kind = sl_map_kinds(&count);
    while (strcmp(kind->name, "city") != 0) kind++;
    sl_generate_options city = sl_generate_options_default();
    city.walls = 31623;
    assert_ok(context, sl_generate(context, kind, &city, &map));
    assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
    const sl_subdivide_options rules = sl_subdivide_options_default();
    assert_ok(context, sli_subdivide_kd(context, &map, &rules, &space));
    assert_true((uint64_t)space.directed_count * space.cell_count / 8 > (uint64_t)64 << 20);
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    sl_visibility swept, pruned, passed;
    assert_ok(context, testing_method("sweep")->see(context, &space, &options, &swept));
    assert_ok(context, testing_method("prune")->see(context, &space, &options, &pruned));
    assert_ok(context, testing_method("multipass")->see(context, &space, &options, &passed));
    assert_true(testing_same_rows(&swept.pvs, &pruned.pvs));
    assert_true(testing_same_rows(&swept.pvs, &passed.pvs));
    sl_visibility_destroy(context, &swept);
    sl_visibility_destroy(context, &pruned);
    sl_visibility_destroy(context, &passed);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// No walls at all, and cells without portals.
static void cells_alone_see_themselves(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space;
    testing_space(context, "walls 0 0 4 0 4 4 0 4 0 0\nwall 2 0 2 4\n", &map, &space);
    assert_int_equal(space.portal_count, 0);
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    for (size_t m = 0; m < count; m++) {
        sl_visibility seen = see(context, &space, methods[m].name, SL_CLOSED, 2, false);
        assert_int_equal(seen.account.pairs, space.cell_count);
        sl_visibility_destroy(context, &seen);
    }
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(maps_are_seen_as_by_the_search),
        cmocka_unit_test(random_maps_are_seen_as_by_the_search),
        cmocka_unit_test(oblique_spaces_are_seen_as_by_the_oracle),
        cmocka_unit_test(threads_make_no_difference),
        cmocka_unit_test(lack_of_memory_is_told_and_leaves_nothing),
        cmocka_unit_test(what_cannot_be_done_is_refused),
        cmocka_unit_test(large_maps_are_seen_alike),
        cmocka_unit_test(cells_alone_see_themselves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

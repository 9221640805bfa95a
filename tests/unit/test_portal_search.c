/// The search that all methods over portal sequences share, by visitors of this test.
#include "testing.h"

#include "cell_to_cell/search/directions.h"
#include "cell_to_cell/search/portal_search.h"

static const char *const hall = "walls 0 0 12 0 12 8 0 8 0 0\n"
                                "wall 4 0 4 3\nwall 4 4 4 8\nwall 8 0 8 5\nwall 8 6 8 8\n"
                                "wall 4 6 6 6\n";

typedef struct step {
    sli_portal_step at;
    sli_directions directions;
    bool first;
} step;

typedef struct job {
    sli_portal_search search;
    bool entered[256];
    uint32_t steps, left, most; ///< it stops after so many steps; 0 for no limit
} job;

static void enter(job *j, uint32_t cell) {
    j->search.count++;
    j->entered[cell] = true;
    j->search.stop = ++j->steps == j->most;
}

/// Goes through a portal where some direction crosses all, and with a solver where some line does.
static sl_status cross(sl_context *context, void *of, const void *from, void *to, uint32_t number) {
    job *j = of;
    step *next = to;
    const sl_directed_portal *portal = &j->search.space->directed[number];
    *next = (step){.at.cell = portal->cell, .directions = ((const step *)from)->directions};
    if (!sli_directions_add(j->search.space, &next->directions, number)) return SL_OK;
    const step *way = j->search.steps;
    for (size_t i = 0; i < j->search.count; i++) assert_int_not_equal(way[i].at.cell, portal->cell);
    if (j->search.solver) {
        sl_stab_verdict verdict;
        SL_TRY(sli_portal_search_push(context, &j->search, portal->left, portal->right, &verdict));
        assert_int_equal(j->search.held, j->search.count);
        if (verdict == SL_HIDDEN) {
            sli_portal_search_pop(&j->search);
            return SL_OK;
        }
    }
    enter(j, portal->cell);
    return SL_OK;
}

/// Enters each cell beside the first one twice.
static sl_status cross_twice(sl_context *context, void *of, const void *from, void *to,
                             uint32_t number) {
    (void)context;
    job *j = of;
    step *next = to;
    const uint32_t cell = j->search.space->directed[number].cell;
    for (int i = 0; i < 2 && ((const step *)from)->first; i++) {
        next[i] = (step){.at.cell = cell};
        enter(j, cell);
    }
    return SL_OK;
}

static sl_status leave(sl_context *context, void *of, const void *left) {
    (void)context;
    job *j = of;
    assert_true(j->entered[((const step *)left)->at.cell]);
    j->left++;
    return SL_OK;
}

static void search(sl_context *context, job *j, const sli_portal_visitor *visitor,
                   uint32_t source) {
    assert_ok(context, sli_portal_search_start(context, &j->search, sizeof(step)));
    *(step *)j->search.steps =
        (step){.at.cell = source, .directions = SLI_NO_DIRECTIONS, .first = true};
    enter(j, source);
    assert_ok(context, sli_portal_search_run(context, &j->search, visitor, j));
    assert_int_equal(j->search.held, 0);
}

static const sli_portal_visitor by_rule = {
    .step_size = sizeof(step), .cross = cross, .leave = leave};

typedef struct scene {
    sl_context *context;
    sl_map map;
    sl_space space;
    sl_visibility seen;
} scene;

static scene make_scene(void) {
    scene s = {.context = testing_context(NULL)};
    testing_space(s.context, hall, &s.map, &s.space);
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    assert_ok(s.context, testing_method("dfs")->see(s.context, &s.space, &options, &s.seen));
    assert_true(s.space.cell_count >= 2 && s.space.cell_count <= 256);
    return s;
}

static void destroy_scene(scene *s) {
    sl_visibility_destroy(s->context, &s->seen);
    sl_space_destroy(s->context, &s->space);
    sl_map_destroy(s->context, &s->map);
    sl_context_destroy(s->context);
}

/// The rule of directions alone ends every search and misses nothing that is seen; with a solver
/// just that is entered.
static void test_what_is_entered(void **state) {
    (void)state;
    scene s = make_scene();
    for (uint32_t source = 0; source < s.space.cell_count; source++) {
        job all = {.search = {.space = &s.space}};
        job stabbed = {.search = {.space = &s.space, .solver = sl_funnel()}};
        assert_ok(s.context,
                  sl_funnel()->create(s.context, s.space.bounds, &stabbed.search.solver_state));
        search(s.context, &all, &by_rule, source);
        search(s.context, &stabbed, &by_rule, source);
        assert_int_equal(all.left, all.steps);
        assert_int_equal(stabbed.left, stabbed.steps);
        assert_int_equal(stabbed.search.count, 0);
        for (uint32_t cell = 0; cell < s.space.cell_count; cell++) {
            assert_int_equal(stabbed.entered[cell], sl_pvs_sees(&s.seen.pvs, source, cell));
            assert_true(all.entered[cell] || !stabbed.entered[cell]);
        }
        sli_portal_search_end(s.context, &all.search);
        sli_portal_search_end(s.context, &stabbed.search);
    }
    destroy_scene(&s);
}

/// A search that stops keeps its way, and lets go of what the solver holds.
static void test_stop(void **state) {
    (void)state;
    scene s = make_scene();
    job j = {.search = {.space = &s.space, .solver = sl_funnel()}, .most = 3};
    assert_ok(s.context, sl_funnel()->create(s.context, s.space.bounds, &j.search.solver_state));
    search(s.context, &j, &by_rule, 0);
    assert_int_equal(j.steps, 3);
    assert_int_equal(j.search.count, 3 - j.left);
    // The next search starts afresh.
    job again = {.search = j.search};
    search(s.context, &again, &by_rule, 0);
    assert_int_equal(again.search.count, 0);
    assert_int_equal(again.left, again.steps);
    sli_portal_search_end(s.context, &again.search);
    destroy_scene(&s);
}

static void test_two_steps_by_one_crossing(void **state) {
    (void)state;
    static const sli_portal_visitor visitor = {
        .step_size = sizeof(step), .cross = cross_twice, .leave = leave};
    scene s = make_scene();
    for (uint32_t source = 0; source < s.space.cell_count; source++) {
        job j = {.search = {.space = &s.space}};
        search(s.context, &j, &visitor, source);
        assert_int_equal(j.steps, 1 + 2 * s.space.cells[source].directed_count);
        assert_int_equal(j.left, j.steps);
        sli_portal_search_end(s.context, &j.search);
    }
    destroy_scene(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_is_entered),
        cmocka_unit_test(test_stop),
        cmocka_unit_test(test_two_steps_by_one_crossing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/// The steps of a search against what the method "dfs" finds: the same nodes, the same cells.
#include "testing.h"

static const char *const hall = "walls 0 0 12 0 12 8 0 8 0 0\n"
                                "wall 4 0 4 3\nwall 4 4 4 8\nwall 8 0 8 5\nwall 8 6 8 8\n"
                                "wall 4 6 6 6\n";

static void check_sequence(const sl_space *space, const sl_steps *steps, size_t at) {
    uint32_t directed[256];
    const sl_step *s = &steps->steps[at];
    const uint32_t count = sl_steps_sequence(steps, at, directed, 256);
    assert_int_equal(count, s->depth);
    uint32_t cell = steps->steps[0].cell;
    for (uint32_t i = 0; i < count; i++) {
        // Each directed portal leads out of the cell that the one before leads into.
        const sl_cell *c = &space->cells[cell];
        assert_true(directed[i] - c->first_directed < c->directed_count);
        cell = space->directed[directed[i]].cell;
    }
    assert_int_equal(cell, s->cell);
}

static void check_source(sl_context *context, const sl_space *space, const sl_visibility *seen,
                         sl_sight sight, uint32_t source) {
    sl_steps steps = {0};
    sl_steps_options options = sl_steps_options_default();
    options.sight = sight;
    assert_ok(context, sl_steps_record(context, space, &options, source, &steps));
    assert_true(steps.complete);
    const sl_step *last = &steps.steps[steps.count - 1];
    assert_int_equal(last->kind, SL_STEP_LEAVE);
    assert_int_equal(last->seen, sl_pvs_count(&seen->pvs, source));
    const uint64_t first = seen->trees.offsets[source];
    assert_int_equal(last->node, seen->trees.offsets[source + 1] - first);
    for (size_t i = 0, node = 0; i < steps.count; i++) {
        check_sequence(space, &steps, i);
        if (steps.steps[i].kind != SL_STEP_ENTER) continue;
        assert_int_equal(steps.steps[i].cell, seen->trees.nodes[first + node].cell);
        assert_int_equal(steps.steps[i].directed, seen->trees.nodes[first + node].directed);
        node++;
    }
    sl_steps_destroy(context, &steps);
}

static void check_space(sl_context *context, const sl_space *space) {
    for (int sight = SL_CLOSED; sight <= SL_OPEN; sight++) {
        sl_visibility seen = {0};
        sl_see_options options = sl_see_options_default();
        options.solver = sl_funnel();
        options.sight = (sl_sight)sight;
        options.trees = true;
        options.tree_bytes = 1 << 24;
        size_t count;
        assert_ok(context, sl_see_methods(&count)[0].see(context, space, &options, &seen));
        for (uint32_t cell = 0; cell < space->cell_count; cell++)
            check_source(context, space, &seen, (sl_sight)sight, cell);
        sl_visibility_destroy(context, &seen);
    }
}

static void test_same_as_dfs(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space = {0};
    testing_space(context, hall, &map, &space);
    check_space(context, &space);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void test_limit(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space = {0};
    sl_steps steps = {0};
    testing_space(context, hall, &map, &space);
    sl_steps_options options = sl_steps_options_default();
    options.most = 3;
    assert_ok(context, sl_steps_record(context, &space, &options, 0, &steps));
    assert_int_equal(steps.count, 3);
    assert_false(steps.complete);
    sl_steps_destroy(context, &steps);
    assert_int_equal(sl_steps_record(context, &space, &options, space.cell_count, &steps),
                     SL_BAD_ARGUMENT);
    options.solver = NULL;
    assert_int_equal(sl_steps_record(context, &space, &options, 0, &steps), SL_BAD_ARGUMENT);
    assert_null(steps.steps);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// Wherever memory ends, nothing is kept.
static void test_memory(void **state) {
    (void)state;
    sl_context *plain = testing_context(NULL);
    sl_map map = {0};
    sl_space space = {0};
    testing_space(plain, hall, &map, &space);
    const sl_steps_options options = sl_steps_options_default();
    for (long at = 1;; at++) {
        testing_memory memory = {.fail_at = at + 1}; // the context's own block comes first
        sl_context *context = testing_context(&memory);
        sl_steps steps = {0};
        const sl_status status = sl_steps_record(context, &space, &options, 0, &steps);
        if (status == SL_OK)
            sl_steps_destroy(context, &steps);
        else
            assert_int_equal(status, SL_NO_MEMORY);
        assert_int_equal(memory.live, 1);
        sl_context_destroy(context);
        if (status == SL_OK) break;
    }
    sl_space_destroy(plain, &space);
    sl_map_destroy(plain, &map);
    sl_context_destroy(plain);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_as_dfs),
        cmocka_unit_test(test_limit),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

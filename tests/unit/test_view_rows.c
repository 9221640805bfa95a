/// Exact sets of view cells: location beside the tree's own, rows beside the union of what their
/// cells see, compressed and not.
#include "bake/view_rows.h"
#include "view_cells_maps.h"

#include "cell_to_cell/pvs_rows.h"
#include "map/scan.h"
#include "sightline/cell_to_cell.h"
#include "sightline/support.h"

typedef struct seen {
    view_world world;
    sl_view_tree tree;
    sl_view_hierarchy hierarchy;
    uint32_t cells;
    uint32_t *view_cells, *numbers;
    sl_map map; ///< with seams
    sl_space space;
    sl_visibility visibility;
} seen;

static void see(sl_context *context, const char *statements, bool oblique, uint32_t elementary,
                uint32_t cells, sl_sight sight, seen *s) {
    *s = (seen){.cells = cells};
    make_world(context, statements, oblique, SL_VIEW_CELLS, 4000, &s->world);
    sl_view_subdivision options = sl_view_subdivision_default();
    options.cells = elementary;
    sl_view_sets sets;
    assert_ok(context, view_method("av-m")->divide(context, &s->world.scene, &s->world.segments,
                                                   &options, &s->tree, NULL));
    assert_ok(context, sl_view_sets_sample(context, &s->world.scene, &s->tree, &s->world.segments,
                                           1, &sets));
    assert_ok(context, sl_view_hierarchy_make(context, &s->world.scene, &s->tree, &sets, true,
                                              &s->hierarchy));
    sl_view_sets_destroy(context, &sets);
    s->view_cells = calloc(s->hierarchy.cell_count, sizeof *s->view_cells);
    s->numbers = calloc(cells, sizeof *s->numbers);
    assert_ok(context, sl_view_cut(context, &s->hierarchy, cells, s->view_cells, s->numbers));
    char text[2048];
    snprintf(text, sizeof text, "sightline 1\n%s", statements);
    assert_ok(context, sli_map_read_text(context, "test", text, strlen(text), &s->map));
    assert_ok(context, sl_map_clean(context, &s->map, NULL, NULL));
    assert_ok(context,
              sl_view_add_seams(context, &s->tree, s->view_cells, &s->world.space, &s->map));
    assert_ok(context, sl_subdivision_for(&s->map)->subdivide(context, &s->map, NULL, &s->space));
    sl_see_options seeing = sl_see_options_default();
    seeing.sight = sight;
    assert_ok(context, testing_method("sweep")->see(context, &s->space, &seeing, &s->visibility));
}

static void drop(sl_context *context, seen *s) {
    sl_visibility_destroy(context, &s->visibility);
    sl_space_destroy(context, &s->space);
    sl_map_destroy(context, &s->map);
    sl_view_hierarchy_destroy(context, &s->hierarchy);
    sl_view_tree_destroy(context, &s->tree);
    free(s->view_cells);
    free(s->numbers);
    drop_world(context, &s->world);
}

/// A merged view cell that is no convex polygon, or in several parts, is found in all its places.
static void check_location(const seen *s, const sl_view_rows *rows, bool axial) {
    const sl_box *b = &s->space.bounds;
    sl_random random = {3};
    for (int i = 0; i < 5000; i++) {
        sl_point p = {b->min.x + (b->max.x - b->min.x) * sl_random_unit(&random),
                      b->min.y + (b->max.y - b->min.y) * sl_random_unit(&random)};
        // Some on walls and borders, where only a kd-tree's space keeps to the tree of view cells.
        if (axial && i % 4 == 0) p = (sl_point){floor(p.x), floor(p.y)};
        const uint32_t leaf = sl_view_tree_locate(&s->tree, p);
        const uint32_t cell = sl_space_locate(&s->space, p);
        uint32_t expected = SL_NO_VIEW_CELL;
        if (s->space.cells[cell].inside && leaf < s->tree.cell_count)
            expected = s->view_cells[leaf];
        assert_int_equal(sli_view_rows_locate(rows, &s->space, p), expected);
    }
    assert_int_equal(sli_view_rows_locate(rows, &s->space, (sl_point){NAN, 0}), SL_NO_VIEW_CELL);
}

static uint64_t check_rows(sl_context *context, const seen *s, bool compressed, bool axial) {
    sl_view_rows rows;
    assert_ok(context, sl_view_rows_make(context, &s->space, &s->visibility.pvs, &s->tree,
                                         &s->hierarchy, s->cells, compressed, &rows));
    assert_ok(context, sli_view_rows_check(context, &rows));
    assert_int_equal(rows.view_cell_count, s->cells);
    const size_t words = sl_bits_words(s->space.cell_count);
    sl_bits *expected = calloc(words, sizeof *expected), *found = calloc(words, sizeof *found);
    for (uint32_t v = 0; v < s->cells; v++) {
        memset(expected, 0, words * sizeof *expected);
        memset(found, 0, words * sizeof *found);
        for (uint32_t c = 0; c < s->space.cell_count; c++)
            if (rows.view_cells[c] == v) sli_row_add_to(&s->visibility.pvs, c, expected);
        sli_view_rows_add_to(&rows, v, found);
        assert_memory_equal(expected, found, words * sizeof *found);
        for (uint32_t c = 0; c < s->space.cell_count; c++)
            assert_int_equal(sli_view_rows_sees(&rows, v, c), sl_bits_has(expected, c));
    }
    free(expected);
    free(found);
    check_location(s, &rows, axial);
    uint64_t references = sli_pvs_pairs(&rows.rows);
    sl_view_rows_destroy(context, &rows);
    return references;
}

static void rows_hold_what_their_cells_see(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    for (int i = 0; i < ROOMS; i++) {
        seen s;
        see(context, rooms_map(i), i > 0, 40, 12, SL_CLOSED, &s);
        const uint64_t plain = check_rows(context, &s, false, i == 0);
        const uint64_t compressed = check_rows(context, &s, true, i == 0);
        assert_true(compressed < plain);
        drop(context, &s);
    }
    sl_context_destroy(context);
}

/// What samples see is seen: their sets are part of the exact ones, and cost less.
static void samples_see_no_more_than_there_is(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    seen s;
    see(context, TWO_ROOMS, false, 40, 15, SL_OPEN, &s);
    sl_view_rows rows;
    assert_ok(context, sl_view_rows_make(context, &s.space, &s.visibility.pvs, &s.tree,
                                         &s.hierarchy, s.cells, true, &rows));
    double exact, sampled[64];
    assert_ok(context, sl_view_rows_cost(context, &s.world.scene, &s.space, &rows, &s.hierarchy,
                                         s.cells, &exact));
    sl_view_curve(&s.hierarchy, sampled, NULL);
    assert_true(sampled[s.cells - 1] <= exact + 1e-9);
    assert_true(exact < 1.3 * sampled[s.cells - 1]);
    // The same cut by the exact sets of elementary cells.
    sl_view_sets sets;
    sl_view_hierarchy told;
    sl_see_options seeing = sl_see_options_default();
    seeing.sight = SL_OPEN;
    double curve[64];
    assert_ok(context, sl_view_sets_exact(context, &s.world.map, &s.world.scene, &s.tree,
                                          testing_method("sweep"), &seeing, &sets));
    assert_ok(context,
              sl_view_evaluate(context, &s.world.scene, &s.tree, &s.hierarchy, &sets, &told));
    sl_view_curve(&told, curve, NULL);
    assert_true(fabs(curve[s.cells - 1] - exact) < 1e-9);
    for (uint32_t i = 0; i < told.cell_count; i++) assert_true(sampled[i] <= curve[i] + 1e-9);
    sl_view_hierarchy_destroy(context, &told);
    sl_view_sets_destroy(context, &sets);
    s.world.scene.objects = SL_VIEW_WALLS;
    assert_int_equal(sl_view_sets_exact(context, &s.world.map, &s.world.scene, &s.tree,
                                        testing_method("sweep"), &seeing, &sets),
                     SL_BAD_ARGUMENT);
    assert_int_equal(
        sl_view_rows_cost(context, &s.world.scene, &s.space, &rows, &s.hierarchy, s.cells, &exact),
        SL_BAD_ARGUMENT);
    // Rows that a file could hold, each with one fault.
    assert_ok(context, sli_view_rows_check(context, &rows));
    const uint32_t parent = rows.parents[0], of = rows.view_cells[0], count = rows.view_cell_count;
    rows.parents[0] = 0;
    assert_int_equal(sli_view_rows_check(context, &rows), SL_BAD_INPUT);
    rows.parents[0] = rows.node_count;
    assert_int_equal(sli_view_rows_check(context, &rows), SL_BAD_INPUT);
    rows.parents[0] = parent;
    rows.view_cells[0] = count;
    assert_int_equal(sli_view_rows_check(context, &rows), SL_BAD_INPUT);
    rows.view_cells[0] = of;
    rows.view_cell_count = 0;
    assert_int_equal(sli_view_rows_check(context, &rows), SL_BAD_INPUT);
    rows.view_cell_count = count;
    sl_view_rows_destroy(context, &rows);
    drop(context, &s);
    sl_context_destroy(context);
}

/// The exact sets of a method's view cells hold all that lines drawn at random see.
static void check_method(sl_context *context, const view_world *w, const sl_view_method *method) {
    sl_view_subdivision options = sl_view_subdivision_default();
    options.cells = 60;
    sl_view_tree tree = {0};
    sl_view_sets sampled = {0}, exact = {0};
    sl_see_options seeing = sl_see_options_default();
    seeing.inside_only = true;
    seeing.sight = SL_CLOSED;
    assert_ok(context, method->divide(context, &w->scene, &w->segments, &options, &tree, NULL));
    assert_ok(context, sl_view_sets_sample(context, &w->scene, &tree, &w->segments, 1, &sampled));
    assert_ok(context, sl_view_sets_exact(context, &w->map, &w->scene, &tree,
                                          testing_method("sweep"), &seeing, &exact));
    assert_int_equal(sampled.count, exact.count);
    uint64_t pairs = 0;
    for (uint32_t i = 0; i < exact.count; i++)
        for (uint32_t c = 0; c < w->space.cell_count; c++) {
            pairs += set_has(&sampled, i, c);
            if (set_has(&sampled, i, c) && !set_has(&exact, i, c))
                fail_msg("%s: view cell %u sees cell %u by samples alone", method->name, i, c);
        }
    assert_true(pairs > exact.count);
    sl_view_sets_destroy(context, &exact);
    sl_view_sets_destroy(context, &sampled);
    sl_view_tree_destroy(context, &tree);
}

/// By all methods, the splits of which are axial or along walls, which rounded ends of lines are
/// not behind.
static void samples_see_through_no_wall(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    size_t count;
    const sl_view_method *methods = sl_view_methods(&count);
    for (int i = 0; i < ROOMS; i++) {
        view_world w;
        make_world(context, rooms_map(i), i > 0, SL_VIEW_CELLS, 20000, &w);
        for (size_t m = 0; m < count; m++) check_method(context, &w, &methods[m]);
        drop_world(context, &w);
    }
    sl_context_destroy(context);
}

/// Where memory ends, wherever that is, nothing is left behind.
static void no_memory_is_told(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    seen s;
    see(context, TWO_ROOMS, false, 6, 3, SL_CLOSED, &s);
    const long before = memory.live;
    bool done = false;
    for (long fail = 1; !done; fail++) {
        sl_view_rows rows = {0};
        sl_view_sets sets = {0};
        sl_see_options seeing = sl_see_options_default();
        seeing.threads = 1;
        double cost;
        memory.calls = 0;
        memory.fail_at = fail;
        sl_status status = sl_view_rows_make(context, &s.space, &s.visibility.pvs, &s.tree,
                                             &s.hierarchy, s.cells, true, &rows);
        if (status == SL_OK)
            status = sl_view_rows_cost(context, &s.world.scene, &s.space, &rows, &s.hierarchy,
                                       s.cells, &cost);
        if (status == SL_OK)
            status = sl_view_sets_exact(context, &s.world.map, &s.world.scene, &s.tree,
                                        testing_method("sweep"), &seeing, &sets);
        assert_true(status == SL_OK || status == SL_NO_MEMORY);
        done = status == SL_OK;
        memory.fail_at = 0;
        sl_view_rows_destroy(context, &rows);
        sl_view_sets_destroy(context, &sets);
        assert_int_equal(memory.live, before);
    }
    drop(context, &s);
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_hold_what_their_cells_see),
        cmocka_unit_test(samples_see_no_more_than_there_is),
        cmocka_unit_test(samples_see_through_no_wall),
        cmocka_unit_test(no_memory_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/// Merging and cutting hierarchies of view cells, beside all pairs weighed by themselves.
#include "view_cells_maps.h"

#include "cell_to_cell/pvs_rows.h"

#define NEAR 1e-9

typedef struct made {
    view_world world;
    sl_view_tree tree;
    sl_view_sets sets;
    sl_view_hierarchy hierarchy;
} made;

static void make(sl_context *context, const char *statements, bool oblique, uint32_t cells,
                 bool merges, made *m) {
    make_world(context, statements, oblique, SL_VIEW_WALLS, 3000, &m->world);
    sl_view_subdivision options = sl_view_subdivision_default();
    options.cells = cells;
    options.wall_splits = oblique ? 10 : 0;
    assert_ok(context, view_method("av-m")->divide(context, &m->world.scene, &m->world.segments,
                                                   &options, &m->tree, NULL));
    assert_ok(context, sl_view_sets_sample(context, &m->world.scene, &m->tree, &m->world.segments,
                                           1, &m->sets));
    assert_ok(context, sl_view_hierarchy_make(context, &m->world.scene, &m->tree, &m->sets, merges,
                                              &m->hierarchy));
}

static void drop(sl_context *context, made *m) {
    sl_view_hierarchy_destroy(context, &m->hierarchy);
    sl_view_sets_destroy(context, &m->sets);
    sl_view_tree_destroy(context, &m->tree);
    drop_world(context, &m->world);
}

static sl_box box_of(const sl_view_tree *tree, uint32_t leaf) {
    sl_box box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (uint32_t i = tree->first[leaf]; i < tree->first[leaf + 1]; i++) {
        const sl_point p = tree->corners[i];
        box.min = (sl_point){fmin(box.min.x, p.x), fmin(box.min.y, p.y)};
        box.max = (sl_point){fmax(box.max.x, p.x), fmax(box.max.y, p.y)};
    }
    return box;
}

/// Whether two boxes have a piece of boundary in common.
static bool touch(const sl_view_tree *tree, uint32_t a, uint32_t b) {
    const sl_box p = box_of(tree, a), q = box_of(tree, b);
    const double x = fmin(p.max.x, q.max.x) - fmax(p.min.x, q.min.x);
    const double y = fmin(p.max.y, q.max.y) - fmax(p.min.y, q.min.y);
    return (x == 0 && y > 0) || (y == 0 && x > 0);
}

static uint32_t count_union(const sl_view_sets *sets, const uint32_t *top, uint32_t a, uint32_t b) {
    uint32_t count = 0;
    for (uint32_t o = 0; o < sets->object_count; o++) {
        bool in = false;
        for (uint32_t e = 0; e < sets->count; e++)
            in = in || ((top[e] == a || top[e] == b) && set_has(sets, e, o));
        count += in;
    }
    return count;
}

/// Before each joint: its two parts are neighbours, and no two others cost less to merge.
static void each_merge_costs_least(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    made m;
    make(context, TWO_ROOMS, false, 24, true, &m);
    const sl_view_hierarchy *h = &m.hierarchy;
    const uint32_t count = h->cell_count;
    uint32_t top[64];
    double mass[128];
    for (uint32_t e = 0; e < count; e++) {
        top[e] = e;
        mass[e] = m.tree.mass[e];
    }
    for (uint32_t i = 0; i + 1 < count; i++) {
        const uint32_t *parts = h->joints[i].parts;
        double least = INFINITY, taken = INFINITY;
        for (uint32_t e = 0; e < count; e++)
            for (uint32_t f = 0; f < e; f++) {
                const uint32_t a = top[e], b = top[f];
                if (a == b || !touch(&m.tree, e, f)) continue;
                const double increase = (mass[a] + mass[b]) * count_union(&m.sets, top, a, b) -
                                        mass[a] * count_union(&m.sets, top, a, a) -
                                        mass[b] * count_union(&m.sets, top, b, b);
                least = fmin(least, increase);
                if ((a == parts[0] && b == parts[1]) || (a == parts[1] && b == parts[0]))
                    taken = increase;
            }
        assert_true(taken <= least + NEAR);
        mass[count + i] = mass[parts[0]] + mass[parts[1]];
        for (uint32_t e = 0; e < count; e++)
            if (top[e] == parts[0] || top[e] == parts[1]) top[e] = count + i;
    }
    drop(context, &m);
    sl_context_destroy(context);
}

static uint64_t bytes_of(sl_context *context, const sl_view_sets *sets, const uint32_t *view_cells,
                         uint32_t cell, uint32_t *objects) {
    sl_bits row[8] = {0};
    assert_true(sets->words <= 8);
    for (uint32_t e = 0; e < sets->count; e++)
        for (size_t k = 0; k < sets->words && view_cells[e] == cell; k++)
            row[k] |= sets->bits[e * sets->words + k];
    *objects = 0;
    for (uint32_t o = 0; o < sets->object_count; o++) *objects += sl_bits_has(row, o);
    sli_row_bytes bytes = {0};
    assert_ok(context, sli_row_append(context, &bytes, row, sets->object_count));
    const uint64_t size = bytes.count;
    sl_free(context, bytes.items);
    return size;
}

/// Each cut's cost and bytes are those of its cells, added up from the elementary ones.
static void check_cuts(sl_context *context, const made *m) {
    const sl_view_hierarchy *h = &m->hierarchy;
    double costs[64], mass[64];
    uint64_t bytes[64];
    uint32_t view_cells[64], numbers[64];
    assert_true(h->cell_count <= 64);
    sl_view_curve(h, costs, bytes);
    for (uint32_t cells = 1; cells <= h->cell_count; cells++) {
        assert_ok(context, sl_view_cut(context, h, cells, view_cells, numbers));
        double cost = 0;
        uint64_t size = 0;
        memset(mass, 0, sizeof mass);
        for (uint32_t e = 0; e < h->cell_count; e++) {
            assert_true(view_cells[e] < cells);
            mass[view_cells[e]] += m->tree.mass[e];
        }
        for (uint32_t v = 0; v < cells; v++) {
            uint32_t objects;
            const uint64_t row = bytes_of(context, &m->sets, view_cells, v, &objects);
            assert_int_equal(objects, h->objects[numbers[v]]);
            assert_int_equal(row, h->bytes[numbers[v]]);
            assert_true(h->cost[numbers[v]] == objects);
            assert_true(fabs(mass[v] - h->mass[numbers[v]]) < NEAR && mass[v] > 0);
            cost += mass[v] * objects;
            size += row;
        }
        assert_true(fabs(cost - costs[cells - 1]) < 1e-6);
        assert_int_equal(size, bytes[cells - 1]);
        // Fewer cells never cost less.
        if (cells > 1) assert_true(costs[cells - 1] <= costs[cells - 2] + NEAR);
    }
}

static void cuts_cost_what_their_cells_do(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    for (int i = 0; i < 2 * ROOMS; i++) {
        made m;
        make(context, rooms_map(i / 2), i / 2 > 0, 40, i % 2, &m);
        check_cuts(context, &m);
        drop(context, &m);
    }
    sl_context_destroy(context);
}

static void cuts_keep_to_their_budget(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    made m;
    make(context, TWO_ROOMS, false, 50, true, &m);
    const sl_view_hierarchy *h = &m.hierarchy;
    double costs[64];
    uint64_t bytes[64];
    uint32_t cells;
    sl_view_curve(h, costs, bytes);
    for (uint64_t budget = bytes[0]; budget < bytes[h->cell_count - 1] + 9; budget += 3) {
        assert_ok(context, sl_view_cut_by_bytes(context, h, budget, &cells));
        assert_true(bytes[cells - 1] <= budget);
        assert_true(cells == h->cell_count || bytes[cells] > budget);
    }
    assert_int_equal(sl_view_cut_by_bytes(context, h, bytes[0] - 1, &cells), SL_BAD_ARGUMENT);
    for (double tolerance = 0; tolerance < 4; tolerance += 0.13) {
        assert_ok(context, sl_view_cut_by_cost(context, h, tolerance, &cells));
        const double most = (1 + tolerance) * costs[h->cell_count - 1];
        assert_true(costs[cells - 1] <= most);
        assert_true(cells == 1 || costs[cells - 2] > most);
    }
    assert_int_equal(sl_view_cut_by_cost(context, h, NAN, &cells), SL_BAD_ARGUMENT);
    uint32_t view_cells[64], numbers[64];
    assert_int_equal(sl_view_cut(context, h, 0, view_cells, numbers), SL_BAD_ARGUMENT);
    assert_int_equal(sl_view_cut(context, h, h->cell_count + 1, view_cells, numbers),
                     SL_BAD_ARGUMENT);
    drop(context, &m);
    sl_context_destroy(context);
}

/// Rooms that no neighbours join, and a map of one cell.
static void view_space_in_parts_becomes_one_tree(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    made m;
    make(context,
         "walls 0 0 4 0 4 4 0 4 0 0\nwalls 9 0 13 0 13 4 9 4 9 0\nstart 1 1 0\nstart 10 1 0\n",
         false, 12, true, &m);
    check_cuts(context, &m);
    drop(context, &m);
    make(context, "walls 0 0 4 0 4 4 0 4 0 0\n", false, 1, true, &m);
    assert_int_equal(m.hierarchy.cell_count, 1);
    check_cuts(context, &m);
    drop(context, &m);
    sl_context_destroy(context);
}

static void costs_follow_the_model(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    made m;
    sl_view_hierarchy other;
    make(context, TWO_ROOMS, false, 30, true, &m);
    m.world.scene.cost = (sl_render_cost){1, 2.5, 0};
    assert_ok(context,
              sl_view_evaluate(context, &m.world.scene, &m.tree, &m.hierarchy, &m.sets, &other));
    for (uint32_t i = 0; i < 2 * other.cell_count - 1; i++)
        assert_true(other.cost[i] == 2.5 * m.hierarchy.cost[i]);
    sl_view_hierarchy_destroy(context, &other);
    // By the share of the circle alone, all walls seen from within take no less than all of it.
    m.world.scene.cost = (sl_render_cost){0, 0, 1};
    assert_ok(context,
              sl_view_evaluate(context, &m.world.scene, &m.tree, &m.hierarchy, &m.sets, &other));
    const uint32_t whole = 2 * other.cell_count - 2;
    assert_true(other.cost[whole] > 1 && other.cost[whole] < m.hierarchy.cost[whole]);
    sl_view_hierarchy_destroy(context, &other);
    assert_ok(context,
              sl_view_hierarchy_make(context, &m.world.scene, &m.tree, &m.sets, true, &other));
    sl_view_hierarchy_destroy(context, &other);
    drop(context, &m);
    sl_context_destroy(context);
}

/// Where memory ends, wherever that is, nothing is left behind.
static void no_memory_is_told(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    made m;
    make_world(context, TWO_ROOMS, false, SL_VIEW_WALLS, 200, &m.world);
    const long before = memory.live;
    bool done = false;
    for (long fail = 1; !done; fail++) {
        m.tree = (sl_view_tree){0};
        m.sets = (sl_view_sets){0};
        m.hierarchy = (sl_view_hierarchy){0};
        sl_view_segments segments = {0};
        sl_view_sampling sampling = sl_view_sampling_default();
        sampling.samples = 100;
        sampling.threads = 1;
        sl_view_subdivision options = sl_view_subdivision_default();
        options.cells = 6;
        options.wall_splits = 3;
        memory.calls = 0;
        memory.fail_at = fail;
        sl_status status = sl_view_sample(context, &m.world.outline, &sampling, &segments);
        if (status == SL_OK)
            status = view_method("av-m")->divide(context, &m.world.scene, &segments, &options,
                                                 &m.tree, NULL);
        if (status == SL_OK)
            status = sl_view_sets_sample(context, &m.world.scene, &m.tree, &segments, 1, &m.sets);
        if (status == SL_OK)
            status = sl_view_hierarchy_make(context, &m.world.scene, &m.tree, &m.sets, true,
                                            &m.hierarchy);
        assert_true(status == SL_OK || status == SL_NO_MEMORY);
        done = status == SL_OK;
        memory.fail_at = 0;
        sl_view_hierarchy_destroy(context, &m.hierarchy);
        sl_view_sets_destroy(context, &m.sets);
        sl_view_tree_destroy(context, &m.tree);
        sl_view_segments_destroy(context, &segments);
        assert_int_equal(memory.live, before);
    }
    drop_world(context, &m.world);
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_merge_costs_least),
        cmocka_unit_test(cuts_cost_what_their_cells_do),
        cmocka_unit_test(cuts_keep_to_their_budget),
        cmocka_unit_test(view_space_in_parts_becomes_one_tree),
        cmocka_unit_test(costs_follow_the_model),
        cmocka_unit_test(no_memory_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

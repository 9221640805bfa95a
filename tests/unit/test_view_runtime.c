/// View cells in the runtime: merged ones, that need not be convex, are found and looked up right.
///   test_view_runtime [POINTS]    so many random points instead of some thousands
#include "bake/view_rows.h"
#include "baked_bytes.h"
#include "space/outline.h"
#include "view_cells_maps.h"

#include "cell_to_cell/pvs_rows.h"
#include "runtime/sightline_runtime.h"
#include "sightline/bake.h"
#include "sightline/import.h"
#include "sightline/support.h"

static uint64_t points = 4000;

/// A map of the project's with view cells of the cut, as a file in memory.
typedef struct viewed {
    view_world world;
    sl_view_tree tree;
    sl_view_hierarchy hierarchy;
    uint32_t *cut; ///< by elementary cell: its view cell
    sl_baked baked;
    char *bytes;
    size_t size;
} viewed;

static void read_map(sl_context *context, const char *name, sl_map *map) {
    char path[1024];
    snprintf(path, sizeof path, "%s/maps/%s", SIGHTLINE_SOURCE_DIR, name);
    const sl_import_options options = sl_import_options_default();
    assert_ok(context, sl_map_read(context, path, &options, map));
    assert_ok(context, sl_map_clean(context, map, NULL, NULL));
}

static void make_cells(sl_context *context, const char *name, viewed *v) {
    view_world *w = &v->world;
    read_map(context, name, &w->map);
    assert_ok(context, sl_subdivision_for(&w->map)->subdivide(context, &w->map, NULL, &w->space));
    assert_ok(context, sli_outline_make(context, &w->space, &w->outline));
    assert_ok(context, sl_view_places_inside(context, &w->space, &w->places));
    w->scene = (sl_view_scene){&w->space, SL_VIEW_WALLS, sl_render_cost_default(), &w->places};
    sl_view_sampling sampling = sl_view_sampling_default();
    sampling.samples = 5000;
    assert_ok(context, sl_view_sample(context, &w->outline, &sampling, &w->segments));
    sl_view_subdivision options = sl_view_subdivision_default();
    options.cells = 100;
    assert_ok(context, view_method("av-m")->divide(context, &w->scene, &w->segments, &options,
                                                   &v->tree, NULL));
    sl_view_sets sets;
    assert_ok(context, sl_view_sets_sample(context, &w->scene, &v->tree, &w->segments, 1, &sets));
    assert_ok(context,
              sl_view_hierarchy_make(context, &w->scene, &v->tree, &sets, true, &v->hierarchy));
    sl_view_sets_destroy(context, &sets);
}

static void bake(sl_context *context, const char *name, uint32_t cells, viewed *v) {
    sl_baked *b = &v->baked;
    v->cut = calloc(v->hierarchy.cell_count, sizeof *v->cut);
    uint32_t *numbers = calloc(cells, sizeof *numbers);
    assert_ok(context, sl_view_cut(context, &v->hierarchy, cells, v->cut, numbers));
    read_map(context, name, &b->map);
    assert_ok(context, sl_view_add_seams(context, &v->tree, v->cut, NULL, &b->map));
    free(numbers);
    assert_ok(context, sl_subdivision_for(&b->map)->subdivide(context, &b->map, NULL, &b->space));
    sl_see_options seeing = sl_see_options_default();
    seeing.inside_only = true;
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    for (size_t i = 0; i < count; i++)
        if (strcmp(methods[i].name, "sweep") == 0)
            assert_ok(context, methods[i].see(context, &b->space, &seeing, &b->visibility));
    snprintf(b->method, sizeof b->method, "sweep");
    assert_ok(context, sl_view_rows_make(context, &b->space, &b->visibility.pvs, &v->tree,
                                         &v->hierarchy, cells, true, &b->views));
    v->bytes = baked_bytes(context, b, &v->size);
}

static void drop(sl_context *context, viewed *v) {
    free(v->bytes);
    free(v->cut);
    sl_baked_destroy(context, &v->baked);
    sl_view_hierarchy_destroy(context, &v->hierarchy);
    sl_view_tree_destroy(context, &v->tree);
    drop_world(context, &v->world);
}

/// The leaf whose polygon a point is in, by all of them; SL_NO_VIEW_CELL for one on a border.
static uint32_t leaf_about(const sl_view_tree *tree, sl_point p) {
    for (uint32_t leaf = 0; leaf < tree->leaf_count; leaf++) {
        const uint32_t first = tree->first[leaf], count = tree->first[leaf + 1] - first;
        const sl_point *corners = tree->corners + first;
        bool within = true;
        for (uint32_t k = 0; k < count && within; k++)
            within = cross_of(corners[k], corners[(k + 1) % count], p) > 1e-9;
        if (within) return leaf;
    }
    return SL_NO_VIEW_CELL;
}

/// Whether no wall comes near a segment.
static bool is_free(const sl_space *space, sl_point p, sl_point q) {
    for (uint32_t i = 0; i < space->wall_count; i++) {
        const sl_wall *w = &space->walls[i];
        const double a = cross_of(p, q, w->a), b = cross_of(p, q, w->b);
        const double c = cross_of(w->a, w->b, p), d = cross_of(w->a, w->b, q);
        const bool apart = (a > 1e-9 && b > 1e-9) || (a < -1e-9 && b < -1e-9) ||
                           (c > 1e-9 && d > 1e-9) || (c < -1e-9 && d < -1e-9);
        if (!apart) return false;
    }
    return true;
}

/// Told by nothing that the library has computed of cells: the view cell of a point is that of the
/// polygon about it, and it sees the cell of every place that no wall hides from the point. Returns
/// whether there was such a place.
static bool check_alone(const viewed *v, const sl_runtime *rt, sl_point p, sl_point q,
                        uint32_t view) {
    const uint32_t leaf = leaf_about(&v->tree, p);
    if (leaf < v->tree.cell_count && view != SL_NO_VIEW_CELL) assert_int_equal(view, v->cut[leaf]);
    if (leaf != SL_NO_VIEW_CELL && leaf >= v->tree.cell_count)
        assert_int_equal(view, SL_NO_VIEW_CELL);
    if (view == SL_NO_VIEW_CELL || !is_free(&v->world.space, p, q)) return false;
    assert_true(sl_runtime_view_can_see(rt, view, sl_runtime_locate(rt, q.x, q.y)));
    return true;
}

/// What a point's view cell sees holds all that its cell sees; the runtime says what the library
/// does.
static void check_points(const viewed *v, const sl_runtime *rt) {
    const sl_baked *b = &v->baked;
    const sl_box box = b->space.bounds;
    const size_t words = sl_bits_words(b->space.cell_count);
    sl_bits *rows = calloc(b->views.view_cell_count * words, sizeof *rows);
    sl_bits *own = calloc(words, sizeof *own);
    unsigned char *unpacked = calloc(b->space.cell_count / 8 + 1, 1);
    for (uint32_t i = 0; i < b->views.view_cell_count; i++) {
        sli_view_rows_add_to(&b->views, i, rows + i * words);
        sl_runtime_view_bits(rt, i, unpacked);
        for (uint32_t c = 0; c < b->space.cell_count; c++)
            assert_int_equal(unpacked[c / 8] >> c % 8 & 1, sl_bits_has(rows + i * words, c));
    }
    sl_random random = {17};
    uint64_t found = 0, free_ways = 0;
    for (uint64_t i = 0; i < points; i++) {
        sl_point p = {box.min.x + (box.max.x - box.min.x) * sl_random_unit(&random),
                      box.min.y + (box.max.y - box.min.y) * sl_random_unit(&random)};
        if (i % 5 == 0) p = (sl_point){floor(p.x), floor(p.y)};
        const uint32_t cell = sl_runtime_locate(rt, p.x, p.y);
        const uint32_t view = sl_runtime_view_cell(rt, cell);
        assert_int_equal(view, sli_view_rows_locate(&b->views, &b->space, p));
        const sl_point q = {box.min.x + (box.max.x - box.min.x) * sl_random_unit(&random),
                            box.min.y + (box.max.y - box.min.y) * sl_random_unit(&random)};
        free_ways += check_alone(v, rt, p, q, view);
        if (view == SL_NO_VIEW_CELL) continue;
        found++;
        memset(own, 0, words * sizeof *own);
        sli_row_add_to(&b->visibility.pvs, cell, own);
        for (size_t k = 0; k < words; k++) assert_int_equal(own[k] & ~rows[view * words + k], 0);
        const uint32_t to = (uint32_t)sl_random_below(&random, b->space.cell_count);
        assert_int_equal(sl_runtime_view_can_see(rt, view, to),
                         sl_bits_has(rows + view * words, to));
    }
    assert_true(found > points / 4 && free_ways > points / 100);
    assert_int_equal(sl_runtime_view_cell(rt, SL_RUNTIME_NO_CELL), SL_RUNTIME_NO_CELL);
    assert_false(sl_runtime_view_can_see(rt, SL_RUNTIME_NO_CELL, 0));
    free(rows);
    free(own);
    free(unpacked);
}

static void view_cells_are_found_and_looked_up(void **state) {
    (void)state;
    static const char *const names[] = {"office.map", "dungeon.txt", "gallery.map"};
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        viewed v = {0};
        make_cells(context, names[i], &v);
        bake(context, names[i], 20, &v);
        sl_runtime rt;
        assert_int_equal(sl_runtime_open(v.bytes, v.size, &rt), SL_RUNTIME_OK);
        assert_int_equal(rt.view_cell_count, 20);
        check_points(&v, &rt);
        sl_baked again = {0};
        assert_ok(context, sl_baked_parse(context, "memory", v.bytes, v.size, &again));
        assert_int_equal(again.views.node_count, v.baked.views.node_count);
        assert_memory_equal(again.views.parents, v.baked.views.parents,
                            again.views.node_count * sizeof *again.views.parents);
        assert_memory_equal(again.views.view_cells, v.baked.views.view_cells,
                            again.space.cell_count * sizeof *again.views.view_cells);
        sl_baked_destroy(context, &again);
        // Another space's rows are refused.
        v.baked.views.rows.cell_count--;
        assert_int_equal(sl_baked_write(context, &v.baked, "unwritten.slv"), SL_BAD_ARGUMENT);
        v.baked.views.rows.cell_count++;
        drop(context, &v);
    }
    sl_context_destroy(context);
}

static void print_again(sl_context *context, viewed *v) {
    free(v->bytes);
    v->bytes = baked_bytes(context, &v->baked, &v->size);
}

/// As `bake`, without what cells see.
static void bake_by_views(sl_context *context, const char *name, uint32_t cells, viewed *v) {
    bake(context, name, cells, v);
    sl_visibility *seen = &v->baked.visibility;
    sl_pvs exact = seen->pvs;
    sl_view_rows_destroy(context, &v->baked.views);
    assert_ok(context, sl_view_rows_make(context, &v->baked.space, &exact, &v->tree, &v->hierarchy,
                                         cells, false, &v->baked.views));
    assert_ok(context,
              sl_view_rows_expand(context, &v->baked.views, &seen->pvs, &seen->account.pairs));
    for (uint32_t a = 0; a < exact.cell_count; a++)
        for (uint32_t b = 0; b < exact.cell_count; b++) {
            const uint32_t view = v->baked.views.view_cells[a];
            if (sl_pvs_sees(&exact, a, b)) assert_true(sl_pvs_sees(&seen->pvs, a, b));
            assert_int_equal(sl_pvs_sees(&seen->pvs, a, b),
                             view != SL_NO_VIEW_CELL &&
                                 sli_view_rows_sees(&v->baked.views, view, b));
        }
    sl_pvs_destroy(context, &exact);
    seen->guarantee = SL_CONSERVATIVE;
    v->baked.by_views = true;
    const size_t before = v->size;
    print_again(context, v);
    assert_true(v->size < before);
}

/// A file may leave out what cells see: each sees what its view cell does, for both readers.
static void view_cells_stand_for_their_cells(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    viewed v = {0};
    make_cells(context, "dungeon.txt", &v);
    bake_by_views(context, "dungeon.txt", 15, &v);
    const sl_pvs *pvs = &v.baked.visibility.pvs;
    sl_runtime rt;
    assert_int_equal(sl_runtime_open(v.bytes, v.size, &rt), SL_RUNTIME_OK);
    for (uint32_t a = 0; a < rt.cell_count; a++) {
        assert_int_equal(sl_runtime_row_count(&rt, a), sl_pvs_count(pvs, a));
        assert_int_equal(sl_runtime_has_row(&rt, a), sl_pvs_count(pvs, a) > 0);
        for (uint32_t b = 0; b < rt.cell_count; b++)
            assert_int_equal(sl_runtime_can_see(&rt, a, b), sl_pvs_sees(pvs, a, b));
    }
    check_points(&v, &rt);
    sl_baked again = {0};
    assert_ok(context, sl_baked_parse(context, "memory", v.bytes, v.size, &again));
    assert_true(again.by_views && again.visibility.pvs.cell_count == pvs->cell_count);
    assert_memory_equal(again.visibility.pvs.bytes, pvs->bytes, pvs->offsets[pvs->cell_count]);
    sl_baked_destroy(context, &again);
    // A cell in a view cell that does not see it, and a row that is not all of what is seen.
    uint32_t *view_cells = v.baked.views.view_cells, first = 0;
    for (int fault = 0; fault < 2; fault++) {
        const uint32_t kept = fault ? v.baked.views.parents[0] : 0;
        while (!fault && (view_cells[first] == SL_NO_VIEW_CELL ||
                          sli_view_rows_sees(&v.baked.views, 0, first)))
            first++;
        const uint32_t own = view_cells[first];
        if (fault)
            v.baked.views.parents[0] = 1;
        else
            view_cells[first] = 0;
        print_again(context, &v);
        assert_int_equal(sl_runtime_open(v.bytes, v.size, &rt), SL_RUNTIME_ROW);
        assert_int_equal(sl_baked_parse(context, "memory", v.bytes, v.size, &again), SL_BAD_INPUT);
        view_cells[first] = own;
        if (fault) v.baked.views.parents[0] = kept;
    }
    drop(context, &v);
    sl_context_destroy(context);
}

/// Every word of the sections of view cells, made large: both readers refuse or stay in bounds.
static void damaged_view_cells_are_refused(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    viewed v = {0};
    make_cells(context, "office.map", &v);
    bake(context, "office.map", 6, &v);
    sl_view_rows *views = &v.baked.views;
    for (int fault = 0; fault < 4; fault++) {
        uint32_t *word = fault == 0   ? &views->parents[0]
                         : fault == 1 ? &views->view_cells[3]
                         : fault == 2 ? &views->view_cell_count
                                      : &views->parents[views->node_count - 1];
        const uint32_t before = *word;
        *word = fault == 2 ? views->node_count + 1 : fault == 3 ? 0 : views->node_count;
        size_t size;
        char *bytes = baked_bytes(context, &v.baked, &size);
        sl_runtime rt;
        sl_baked again = {0};
        assert_int_equal(sl_runtime_open(bytes, size, &rt), SL_RUNTIME_ROW);
        assert_int_equal(sl_baked_parse(context, "memory", bytes, size, &again), SL_BAD_INPUT);
        free(bytes);
        *word = before;
    }
    drop(context, &v);
    sl_context_destroy(context);
}

int main(int argc, char **argv) {
    if (argc > 1) points = strtoull(argv[1], NULL, 10);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(view_cells_are_found_and_looked_up),
        cmocka_unit_test(view_cells_stand_for_their_cells),
        cmocka_unit_test(damaged_view_cells_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/// Memory of visibility graph analysis: what is told before, beside what is taken.
#include "space/outline.h"
#include "testing.h"

#include "sightline/import.h"
#include "sightline/support.h"
#include "sightline/vga.h"

/// Counts bytes: each block has its size in front.
typedef struct gauge {
    atomic_llong live, peak;
} gauge;

enum { IN_FRONT = 16 };

static void *gauge_resize(void *user, void *block, size_t bytes) {
    gauge *g = user;
    char *old = block ? (char *)block - IN_FRONT : NULL;
    size_t had = 0;
    if (old) memcpy(&had, old, sizeof had);
    if (!bytes) {
        g->live -= (long long)had;
        free(old);
        return NULL;
    }
    char *made = realloc(old, bytes + IN_FRONT);
    if (!made) return NULL;
    memcpy(made, &bytes, sizeof bytes);
    const long long live = atomic_fetch_add(&g->live, (long long)bytes - (long long)had) +
                           (long long)bytes - (long long)had;
    long long peak = g->peak;
    while (live > peak && !atomic_compare_exchange_weak(&g->peak, &peak, live)) {
    }
    return made + IN_FRONT;
}

static size_t wrong;

static void compare(const char *map_name, double step, unsigned parts, unsigned threads) {
    gauge g = {0};
    const sl_hooks hooks = {.user = &g, .resize = gauge_resize};
    sl_context *context = sl_context_create(&hooks);
    sl_map map = {0};
    sl_space space = {0};
    sl_outline outline = {0};
    sl_vga_grid grid = {0};
    sl_vga_graph graph = {0};
    sl_vga_options options = sl_vga_options_default();
    char path[512];
    uint64_t told = 0;
    options.parts = parts;
    options.threads = threads;
    snprintf(path, sizeof path, "%s/maps/%s", SIGHTLINE_SOURCE_DIR, map_name);
    assert_non_null(context);
    assert_ok(context, sl_map_read(context, path, NULL, &map));
    testing_subdivide(context, &map, &space);
    assert_ok(context, sli_outline_make(context, &space, &outline));
    assert_ok(context, sl_vga_grid_make(context, &outline, step, NULL, 0, &grid));
    const long long before = g.live;
    assert_ok(context, sl_vga_graph_make(context, &outline, &grid, 0, 1, &graph));
    assert_ok(context, sl_vga_measure_bytes(context, &outline, &grid, &graph, &options, &told));
    sl_vga_measures *measures = sl_alloc_array(context, grid.count, sizeof *measures);
    assert_non_null(measures);
    g.peak = 0;
    assert_ok(context, sl_vga_measure(context, &outline, &grid, &graph, &options, measures));
    const double taken = (double)(g.peak - before);
    if ((double)told < taken || (double)told > 2.5 * taken)
        print_message("%s, parts %u, threads %u: told %.0f, taken %.0f\n", map_name, parts, threads,
                      (double)told, taken);
    wrong += (double)told < taken || (double)told > 2.5 * taken;
    sl_free(context, measures);
    sl_vga_graph_destroy(context, &graph);
    sl_vga_grid_destroy(context, &grid);
    sli_outline_destroy(context, &outline);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void told_is_at_least_what_is_taken(void **state) {
    (void)state;
    static const unsigned parts[] = {SL_VGA_LOCAL | SL_VGA_GLOBAL, SL_VGA_THROUGH, SL_VGA_METRIC,
                                     SL_VGA_ANGULAR};
    static const struct {
        const char *name;
        double step;
    } maps[] = {{"gallery.map", 1}, {"office.map", 2}, {"pillars.map", 0.5}};
    for (size_t m = 0; m < sizeof maps / sizeof *maps; m++)
        for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
            for (unsigned threads = 1; threads <= 2; threads++)
                compare(maps[m].name, maps[m].step, parts[i], threads);
    assert_int_equal(wrong, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(told_is_at_least_what_is_taken)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

// The area that was explored, as tiles: those whose middles the eye sees, and no others.
#include "runtime_maps.h"

enum { EYES = 12 };

typedef struct explorer {
    const baked_file *file;
    sl_runtime_grid grid;
    uint32_t *scratch;
    unsigned char *seen;
    double *points;
    uint32_t room;
} explorer;

static bool has(const sl_runtime_grid *grid, uint32_t n) {
    return grid->bits[n / 8] >> n % 8 & 1;
}

/// The middle of a tile, and how far the nearest edge of a polygon is from it, in tiles.
static double off_border(const explorer *e, uint32_t n, const double *points, uint32_t count,
                         double at[2]) {
    double least = INFINITY;
    at[0] = e->grid.min_x + (n % e->grid.columns + 0.5) * e->grid.tile;
    at[1] = e->grid.min_y + (n / e->grid.columns + 0.5) * e->grid.tile;
    for (uint32_t i = 0; i < count; i++) {
        const double *a = points + 2 * i, *b = points + 2 * ((i + 1) % count);
        const double x = b[0] - a[0], y = b[1] - a[1], square = x * x + y * y;
        double t = square > 0 ? ((at[0] - a[0]) * x + (at[1] - a[1]) * y) / square : 0;
        t = fmin(fmax(t, 0), 1);
        least = fmin(least, hypot(a[0] + t * x - at[0], a[1] + t * y - at[1]));
    }
    return least / e->grid.tile;
}

/// By points: a tile is explored if the eye sees its middle. Beside borders either may be said.
static void look(explorer *e, double x, double y) {
    const sl_runtime *r = &e->file->runtime;
    const sl_runtime_view view = sl_runtime_view_all_round(x, y);
    const uint32_t tiles = e->grid.columns * e->grid.rows;
    const uint32_t count =
        sl_runtime_visible_polygon(r, &view, NULL, 0, e->scratch, e->points, e->room);
    uint32_t before = 0, after = 0, clear = 0;
    assert_true(count <= e->room);
    for (uint32_t n = 0; n < tiles; n++) before += e->seen[n] = has(&e->grid, n);
    const uint32_t found = sl_runtime_explore(&e->grid, x, y, e->points, count);
    for (uint32_t n = 0; n < tiles; n++) {
        double at[2];
        after += has(&e->grid, n);
        if (e->seen[n]) {
            assert_true(has(&e->grid, n)); // what was explored stays
            continue;
        }
        if (count && off_border(e, n, e->points, count, at) < 1e-6) continue;
        clear++;
        if (!count) continue;
        if (has(&e->grid, n) != sl_runtime_sees(r, x, y, at[0], at[1], NULL, 0, e->scratch))
            fail_msg("%s: from %.17g,%.17g the tile about %.17g,%.17g is %s", e->file->name, x, y,
                     at[0], at[1], has(&e->grid, n) ? "explored" : "not explored");
    }
    assert_int_equal(after - before, found);
    assert_true(clear || before + after > tiles / 4);
    assert_int_equal(sl_runtime_explore(&e->grid, x, y, e->points, count), 0);
    assert_int_equal(sl_runtime_explore(&e->grid, x, y, e->points, 0), 0);
}

static void explore(const baked_file *f) {
    const sl_runtime *r = &f->runtime;
    sl_random random = {9};
    explorer e = {.file = f, .room = 4096};
    if (r->range > 0 || r->has_limits || r->mirrors) return;
    e.grid = sl_runtime_grid_over(r, (r->max_x - r->min_x) / 37.3);
    assert_int_equal(e.grid.columns, 38);
    // Where doubles are coarser than tiles, middles are not where they should be.
    if (1e-12 * fmax(fabs(r->min_x), fabs(r->min_y)) > 1e-6 * e.grid.tile) return;
    const uint32_t tiles = e.grid.columns * e.grid.rows;
    e.grid.bits = calloc((tiles + 7) / 8, 1);
    e.seen = malloc(tiles);
    e.points = malloc(2 * e.room * sizeof *e.points);
    e.scratch = malloc(sl_runtime_scratch_count(r) * sizeof *e.scratch);
    assert_true(e.grid.bits && e.seen && e.points && e.scratch);
    for (int i = 0; i < EYES; i++) {
        const double x = r->min_x + (r->max_x - r->min_x) * sl_random_unit(&random);
        look(&e, x, r->min_y + (r->max_y - r->min_y) * sl_random_unit(&random));
    }
    free(e.grid.bits);
    free(e.seen);
    free(e.points);
    free(e.scratch);
}

static void on_every_map(void **state) {
    (void)state;
    baked_file_each(explore);
}

static void grids(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, "walls 0 0 8 0 8 4 0 4 0 0\n");
    sl_runtime_grid grid = sl_runtime_grid_over(&f.runtime, 1);
    assert_true(grid.columns == 8 && grid.rows == 4 && !grid.bits);
    grid = sl_runtime_grid_over(&f.runtime, 3);
    assert_true(grid.columns == 3 && grid.rows == 2);
    grid = sl_runtime_grid_over(&f.runtime, 1e9);
    assert_true(grid.columns == 1 && grid.rows == 1);
    const double none[] = {0, -1, NAN, 1e-9, 1e-300};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        assert_int_equal(sl_runtime_grid_over(&f.runtime, none[i]).columns, 0);
    // A hand-made polygon: it may leave the grid, and touch middles.
    unsigned char bits[4] = {0};
    grid = sl_runtime_grid_over(&f.runtime, 1);
    grid.bits = bits;
    const double square[] = {-9, 0.5, 2.5, 0.5, 2.5, 2.5, -9, 2.5};
    assert_int_equal(sl_runtime_explore(&grid, 1, 1, square, 4), 9);
    const double beyond[] = {100, 1, 100, 2, 90, 2};
    assert_int_equal(sl_runtime_explore(&grid, 95, 1.5, beyond, 3), 0);
    assert_true(bits[0] == 7 && bits[1] == 7 && bits[2] == 7 && bits[3] == 0);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(on_every_map), cmocka_unit_test(grids)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

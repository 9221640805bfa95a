/// The runtime's eye past shut doors and within a range, against the library's eye in a space with
/// walls in those doors and against the visible region.
#include "effects/filtered.h"
#include "runtime_maps.h"
#include "sight/eye_search.h"
#include "sight/region.h"
#include "space/outline.h"

#include "sightline/support.h"

#include <math.h>

enum { SIZE = 12, MAPS = 60, DOORS = 8, STATES = 5, CELLS_MOST = 512 };

typedef struct trial {
    sl_context *context;
    sl_random random;
    baked_file file;
    sl_space walled; ///< with walls in the doors that are shut
    unsigned char shut[DOORS];
    size_t seen, in_range, asked;
} trial;

static double below(trial *t, uint64_t bound) {
    return (double)sl_random_below(&t->random, bound);
}

// --- how far what is seen of a cell is

/// What of a polygon lies at the left of the line from a to b.
static size_t cut(const sl_point *in, size_t count, sl_point a, sl_point b, sl_point *out) {
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        const sl_point p = in[i], q = in[(i + 1) % count];
        const double at_p = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
        const double at_q = (b.x - a.x) * (q.y - a.y) - (b.y - a.y) * (q.x - a.x);
        if (at_p >= 0) out[kept++] = p;
        if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
            const double share = at_p / (at_p - at_q);
            out[kept++] = (sl_point){p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)};
        }
    }
    return kept;
}

static double distance_to(sl_point eye, sl_point a, sl_point b) {
    const sl_point d = {b.x - a.x, b.y - a.y};
    const double square = d.x * d.x + d.y * d.y;
    double share = square > 0 ? ((eye.x - a.x) * d.x + (eye.y - a.y) * d.y) / square : 0;
    share = fmin(fmax(share, 0), 1);
    return hypot(a.x + share * d.x - eye.x, a.y + share * d.y - eye.y);
}

/// The least distance of what a triangle at the eye has of a cell; infinite where that is next to
/// nothing.
static double nearest_within(const trial *t, const sl_point *triangle, uint32_t cell) {
    sl_point polygons[2][16] = {{triangle[0], triangle[1], triangle[2]}};
    const sl_cell *c = &t->walled.cells[cell];
    const sl_point *v = t->walled.vertices + c->first_vertex;
    size_t count = 3;
    for (uint32_t i = 0; i < c->vertex_count; i++)
        count =
            cut(polygons[i % 2], count, v[i], v[(i + 1) % c->vertex_count], polygons[(i + 1) % 2]);
    const sl_point *last = polygons[c->vertex_count % 2];
    double area = 0, nearest = INFINITY;
    for (size_t i = 0; i < count; i++) {
        const sl_point p = last[i], q = last[(i + 1) % count];
        area += (p.x * q.y - p.y * q.x) / 2;
        nearest = fmin(nearest, distance_to(triangle[0], p, q));
    }
    return area > 1e-9 ? nearest : INFINITY;
}

/// The least distance of what a region, which is made up of triangles at the eye, has of a cell.
static double nearest_seen(const trial *t, const sl_region *region, uint32_t cell) {
    double nearest = INFINITY;
    for (size_t i = 0; i < region->count; i++) {
        const sl_point triangle[3] = {region->view.eye, region->points[i],
                                      region->points[(i + 1) % region->count]};
        nearest = fmin(nearest, nearest_within(t, triangle, cell));
    }
    return nearest;
}

// --- one eye

static uint32_t look(const trial *t, const sl_view *view, double range, bool *said) {
    static uint32_t scratch[7 * CELLS_MOST], cells[CELLS_MOST];
    const sl_runtime *rt = &t->file.runtime;
    const sl_runtime_view eye = {view->eye.x,
                                 view->eye.y,
                                 view->full,
                                 {view->right.x - view->eye.x, view->right.y - view->eye.y},
                                 {view->left.x - view->eye.x, view->left.y - view->eye.y}};
    assert_true(sl_runtime_scratch_count(rt) <= sizeof scratch / sizeof *scratch);
    const uint32_t count =
        sl_runtime_look_past(rt, &eye, t->shut, range, scratch, cells, CELLS_MOST);
    memset(said, 0, rt->cell_count * sizeof *said);
    for (uint32_t i = 0; i < count; i++) said[cells[i]] = true;
    return count;
}

/// What the library sees within a range.
static void see(const trial *t, const sl_view *view, double range, uint64_t *seen) {
    const sl_visibility bare = {.sight = SL_CLOSED};
    sli_eye_search *search;
    sl_eye_account account;
    size_t methods;
    const sl_eye_method *exact = sl_eye_methods(&methods) + methods - 1;
    assert_ok(t->context, sli_eye_search_create(t->context, &t->walled, &bare, &search));
    sli_eye_search_set_range(search, range);
    assert_ok(t->context, exact->cull(t->context, search, view, seen, &account));
    sli_eye_search_destroy(t->context, search);
}

static void try_eye(trial *t) {
    const uint32_t count = t->walled.cell_count;
    // Within cells, on a grid where lines pass several corners; or where none passes two, so that
    // no cell is seen by touching alone.
    const bool on_grid = sl_random_below(&t->random, 2);
    const sl_point eye =
        on_grid ? (sl_point){below(t, 8 * SIZE) / 8 + 0.0625, below(t, 8 * SIZE) / 8 + 0.0625}
                : (sl_point){below(t, UINT64_C(1) << 44) * SIZE * 0x1p-44,
                             below(t, UINT64_C(1) << 44) * SIZE * 0x1p-44};
    sl_view view = sl_view_all_round(eye);
    if (sl_random_below(&t->random, 2)) {
        // Straight borders only, which directions give exactly.
        view = (sl_view){eye, false, {eye.x + 3, eye.y + 1}, {eye.x + 1, eye.y - 2}};
        if (sl_random_below(&t->random, 2)) view.left = (sl_point){eye.x + 1, eye.y + 4};
    }
    uint64_t seen[CELLS_MOST / 64], near[CELLS_MOST / 64];
    bool said[CELLS_MOST];
    see(t, &view, 0, seen);
    look(t, &view, 0, said);
    for (uint32_t c = 0; c < count; c++) {
        if (said[c] != sl_eye_sees(seen, c))
            fail_msg("eye %g,%g: cell %u is %s", eye.x, eye.y, c, said[c] ? "hidden" : "seen");
        t->seen += said[c];
    }

    sl_outline outline = {0};
    sl_region region = {0};
    assert_ok(t->context, sli_outline_make(t->context, &t->walled, &outline));
    assert_ok(t->context, sli_region_make(t->context, &outline, &view, 0, &region));
    for (int i = 0; i < 3 && region.count; i++) {
        const double range = 0.25 + below(t, 10 * SIZE) / 16;
        look(t, &view, range, said);
        see(t, &view, range, near);
        for (uint32_t c = 0; c < count; c++) {
            if (!sl_eye_sees(seen, c)) assert_false(said[c]);
            assert_int_equal(sl_eye_sees(near, c), said[c]);
            const double nearest = nearest_seen(t, &region, c);
            if (!isfinite(nearest) || c == region.cell) continue;
            t->asked++;
            t->in_range += said[c];
            if ((nearest <= range * (1 - 1e-9) && !said[c]) ||
                (nearest > range * (1 + 1e-9) && said[c] && !on_grid))
                fail_msg("eye %g,%g, range %g: cell %u, %.17g away, is %s", eye.x, eye.y, range, c,
                         nearest, said[c] ? "seen" : "not seen");
        }
    }
    sl_region_destroy(t->context, &region);
    sli_outline_destroy(t->context, &outline);
}

static void as_walls_in_the_doors(void **state) {
    (void)state;
    trial t = {.context = testing_context(NULL)};
    for (uint64_t seed = 1; seed <= MAPS; seed++) {
        t.random = (sl_random){seed};
        t.file = (baked_file){.name = "random", .baked = {.method = "dfs", .solver = "funnel"}};
        grid_rooms(t.context, &t.random, SIZE, 10, DOORS, &t.file.baked.map);
        assert_ok(t.context, sl_map_clean(t.context, &t.file.baked.map, NULL, NULL));
        baked_file_make(t.context, &t.file, false);
        assert_true(t.file.runtime.cell_count <= CELLS_MOST);
        for (int i = 0; i < STATES; i++) {
            bool shut[DOORS];
            for (int k = 0; k < DOORS; k++)
                t.shut[k] = shut[k] = sl_random_below(&t.random, STATES) < (uint64_t)i;
            const sli_filtered_space filtered = {.shut = shut};
            assert_ok(t.context, sli_filtered_space_make(t.context, &t.file.baked.space, &filtered,
                                                         NULL, &t.walled));
            for (int k = 0; k < 6; k++) try_eye(&t);
            sl_space_destroy(t.context, &t.walled);
        }
        baked_file_destroy(t.context, &t.file);
    }
    print_message("%zu cells seen; %zu of %zu in range\n", t.seen, t.in_range, t.asked);
    assert_true(t.in_range > 0 && t.in_range < t.asked);
    sl_context_destroy(t.context);
}

// --- by hand

/// Whether the second cell is seen from the origin of the doorway's corner within a range.
static bool sees(const baked_file *f, double x, double y, double range) {
    uint32_t scratch[64], cells[8];
    const sl_runtime_view view = sl_runtime_view_all_round(x, y);
    return sl_runtime_look_past(&f->runtime, &view, NULL, range, scratch, cells, 8) == 2;
}

/// The doorway begins 3 over and 4 beside the eye, 5 away; or straight ahead.
static void at_the_range_itself(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(
        context, "walls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 4\nwall 10 6 10 10\n");
    assert_int_equal(f.runtime.cell_count, 2);
    assert_true(sees(&f, 6, 1, 5));
    assert_true(sees(&f, 6, 1, nextafter(5, 6)));
    assert_true(sees(&f, 6, 1, 5 * (1 - 1e-13))); // within what is told
    assert_false(sees(&f, 6, 1, 5 * (1 - 3e-12)));
    assert_true(sees(&f, 7.5, 5, 2.5));
    assert_false(sees(&f, 7.5, 5, 2.5 * (1 - 3e-12)));
    assert_true(sees(&f, 10, 5, 1e-3)); // on the portal
    assert_true(sees(&f, 10, 4, 1e-3)); // at its end
    assert_false(sees(&f, 1, 5, 1e-3));
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(at_the_range_itself),
        cmocka_unit_test(as_walls_in_the_doors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

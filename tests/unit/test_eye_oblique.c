/// What one viewpoint sees among oblique walls, by all that tells of it, beside sightlines that
/// touch no wall: none may be lost, and the answers go together.
#include "sight/eye_search.h"
#include "sight/region.h"
#include "space/outline.h"
#include "space/subdivide.h"
#include "testing.h"

#include "oracle/random_oblique.h"

enum { MAPS = 600, WALLS = 10, EYES = 8, POINTS = 20 };

typedef struct trial {
    sl_context *context;
    uint64_t seed;
    sl_random random;
    sl_map map;
    sl_space space;
    sl_outline outline;
    sl_visibility bare, seen; ///< no rows; rows and stab trees
    sl_sight sight;
    size_t free;
} trial;

static bool begin(trial *t) {
    const oblique_grid grid = (oblique_grid)(t->seed % OBLIQUE_GRIDS);
    assert_ok(t->context, oblique_random_map(t->context, t->seed, grid, WALLS, &t->map));
    // Seams make more cells, and hide nothing.
    for (int i = 0; i < 2; i++) {
        const sl_wall *from = &t->map.walls[sl_random_below(&t->random, t->map.wall_count)];
        const sl_wall *to = &t->map.walls[sl_random_below(&t->random, t->map.wall_count)];
        if (from->a.x != to->b.x || from->a.y != to->b.y)
            assert_ok(t->context,
                      sl_map_add_seam(t->context, &t->map, (sl_segment){from->a, to->b}, 0));
    }
    assert_ok(t->context, sl_map_clean(t->context, &t->map, NULL, NULL));
    if (!t->map.wall_count) return false;
    assert_ok(t->context, sli_subdivide_mesh(t->context, &t->map, &t->space));
    assert_ok(t->context, sli_outline_make(t->context, &t->space, &t->outline));
    sl_see_options options = sl_see_options_default();
    options.sight = t->sight;
    options.solver = sl_funnel();
    options.trees = true;
    assert_ok(t->context, testing_method("dfs")->see(t->context, &t->space, &options, &t->seen));
    t->bare.sight = t->sight;
    return true;
}

static void end(trial *t) {
    sl_visibility_destroy(t->context, &t->seen);
    sli_outline_destroy(t->context, &t->outline);
    sl_space_destroy(t->context, &t->space);
    sl_map_destroy(t->context, &t->map);
}

static void complain(const trial *t, sl_point eye, uint32_t cell, const char *what) {
    fail_msg("seed %llu, %s sight: eye %.17g %.17g, cell %u: %s", (unsigned long long)t->seed,
             t->sight == SL_CLOSED ? "closed" : "open", eye.x, eye.y, cell, what);
}

/// All methods, the exact one last, from rows and stab trees: `cells` becomes what the exact one
/// keeps.
static void cull(trial *t, const sl_view *view, uint64_t *cells) {
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    const size_t words = sl_eye_words(&t->space);
    uint64_t *before = calloc(words, sizeof *before);
    assert_non_null(before);
    sli_eye_search *with = NULL, *without = NULL;
    sl_eye_account account;
    assert_ok(t->context, sli_eye_search_create(t->context, &t->space, &t->seen, &with));
    assert_ok(t->context, sli_eye_search_create(t->context, &t->space, &t->bare, &without));
    for (size_t m = 0; m < count; m++) {
        assert_ok(t->context, methods[m].cull(t->context, with, view, cells, &account));
        for (uint32_t c = 0; m && c < t->space.cell_count; c++)
            if (sl_eye_sees(cells, c) && !sl_eye_sees(before, c))
                complain(t, view->eye, c, methods[m].name);
        memcpy(before, cells, words * sizeof *before);
    }
    assert_ok(t->context, methods[count - 1].cull(t->context, without, view, before, &account));
    assert_memory_equal(before, cells, words * sizeof *before);
    sli_eye_search_destroy(t->context, with);
    sli_eye_search_destroy(t->context, without);
    free(before);
}

/// The ray through the end of a free sightline goes no less far, where no walls run along each
/// other: a place on a wall that the ray all but runs along is rounded by more than a few steps.
static void check_ray(const trial *t, sl_point eye, sl_point point) {
    sl_hit hit;
    if (t->seed % OBLIQUE_GRIDS >= OBLIQUE_FAR || (eye.x == point.x && eye.y == point.y)) return;
    assert_ok(t->context, sli_ray_cast(t->context, &t->outline, eye, point, &hit));
    const double there = hypot(point.x - eye.x, point.y - eye.y);
    const double scale = fmax(fmax(fabs(eye.x), fabs(eye.y)), fmax(fabs(point.x), fabs(point.y)));
    const double reach = hypot(hit.point.x - eye.x, hit.point.y - eye.y);
    if (reach < there * (1 - 1e-12) - 1e-14 * scale) complain(t, eye, 0, "a ray ends too soon");
}

static void try_eye(trial *t, uint64_t *cells) {
    const sl_point eye = oblique_random_point(&t->random, &t->map, t->space.bounds);
    const uint32_t at = sl_space_locate(&t->space, eye);
    if (at == SL_NO_CELL) return;
    sl_view view = sl_view_all_round(eye);
    const bool cone = sl_random_below(&t->random, 3) == 0;
    if (cone) {
        view.full = false;
        view.right = oblique_random_point(&t->random, &t->map, t->space.bounds);
        view.left = oblique_random_point(&t->random, &t->map, t->space.bounds);
        if (!sli_view_usable(&view)) view.full = true;
    }
    cull(t, &view, cells);
    for (uint32_t c = 0; c < t->space.cell_count; c++)
        if (sl_eye_sees(cells, c) && !sl_pvs_sees(&t->seen.pvs, at, c))
            complain(t, eye, c, "is not seen from the eye's cell");
    for (int i = 0; i < POINTS; i++) {
        const sl_point p = oblique_random_point(&t->random, &t->map, t->space.bounds);
        const uint32_t cell = sl_space_locate(&t->space, p);
        if (cell == SL_NO_CELL || !oblique_is_free(&t->map, eye, p)) continue;
        t->free++;
        check_ray(t, eye, p);
        // A cone without an inside sees nothing with open sight.
        if (!view.full && t->sight == SL_OPEN) continue;
        if (sli_view_holds(&view, p) && !sl_eye_sees(cells, cell))
            complain(t, eye, cell, "a free sightline is lost");
    }
}

static void no_sightline_is_lost(void **state) {
    (void)state;
    size_t free_count = 0;
    const uint64_t maps = testing_seeds(MAPS);
    for (uint64_t seed = 1; seed <= maps; seed++) {
        trial t = {.context = testing_context(NULL), .seed = seed, .random = {seed}};
        t.sight = seed / OBLIQUE_GRIDS % 2 ? SL_OPEN : SL_CLOSED;
        if (begin(&t)) {
            uint64_t *cells = calloc(sl_eye_words(&t.space), sizeof *cells);
            assert_non_null(cells);
            for (int i = 0; i < EYES; i++) try_eye(&t, cells);
            free(cells);
        }
        free_count += t.free;
        end(&t);
        sl_context_destroy(t.context);
    }
    assert_true(free_count > 5 * maps);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_sightline_is_lost)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

// Exact eye-to-cell culling against brute force on random maps, cell by cell: closed and open
// sight, with visible sets, with stab trees and without either, eyes on all places that are
// special. SIGHTLINE_SEEDS in the environment: how many maps (60 by default).
#include "sight/eye_search.h"
#include "space/subdivide.h"
#include "testing.h"

#include "oracle/eye.h"
#include "oracle/random_map.h"

enum { EYES = 7, VIEWS = 9, CELLS_MOST = 90 };

typedef struct trial {
    sl_context *context;
    uint64_t seed;
    sl_random random;
    sl_map map;
    sl_space space;
    sl_visibility bare, baked, trees; ///< no rows; rows; rows and stab trees
    sl_sight sight;
    size_t seen, asked;
} trial;

static uint64_t below(trial *t, uint64_t bound) {
    return sl_random_below(&t->random, bound);
}

/// A place on a segment: an end, or a point that divides it by a power of two.
static sl_point on_segment(trial *t, sl_point a, sl_point b) {
    const double share = (double)below(t, 9) / 8;
    return (sl_point){a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share};
}

static sl_point random_eye(trial *t) {
    const sl_space *space = &t->space;
    const sl_cell *cell = &space->cells[below(t, space->cell_count)];
    const sl_point *corners = space->vertices + cell->first_vertex;
    const uint64_t kind = below(t, 5);
    if (kind == 0) return corners[below(t, cell->vertex_count)];
    if (kind == 1 && space->directed_count) {
        const sl_directed_portal *directed = &space->directed[below(t, space->directed_count)];
        return on_segment(t, directed->left, directed->right);
    }
    if (kind == 2) {
        const sl_wall *wall = &space->walls[below(t, space->wall_count)];
        return on_segment(t, wall->a, wall->b);
    }
    const sl_point p = on_segment(t, corners[0], corners[1]);
    const sl_point q = on_segment(t, corners[2], corners[3]);
    return on_segment(t, p, q);
}

/// A point that the cone's border goes through: along an axis, through something, or anywhere.
static sl_point random_border(trial *t, sl_point eye) {
    const double size = t->space.bounds.max.x - t->space.bounds.min.x;
    sl_point p;
    do {
        const uint64_t kind = below(t, 3);
        p = sl_view_cone(eye, kind ? (double)below(t, 8) * 45 : (double)below(t, 3600) / 10, 0,
                         size)
                .left;
        if (kind == 1) p = t->space.vertices[below(t, t->space.vertex_count)];
    } while (p.x == eye.x && p.y == eye.y);
    return p;
}

static void complain(const trial *t, const sl_view *view, uint32_t cell, const char *who,
                     bool said) {
    for (uint32_t i = 0; i < t->space.wall_count; i++) {
        const sl_wall *w = &t->space.walls[i];
        print_error("wall %.17g %.17g %.17g %.17g\n", w->a.x, w->a.y, w->b.x, w->b.y);
    }
    print_error("eye %.17g,%.17g", view->eye.x, view->eye.y);
    if (!view->full)
        print_error(" right %.17g,%.17g left %.17g,%.17g", view->right.x, view->right.y,
                    view->left.x, view->left.y);
    const sl_point corner = t->space.vertices[t->space.cells[cell].first_vertex];
    fail_msg("\nseed %llu, %s sight, %s: cell %u (at %g,%g) is %s", (unsigned long long)t->seed,
             t->sight == SL_OPEN ? "open" : "closed", who, cell, corner.x, corner.y,
             said ? "seen, but hidden" : "hidden, but seen");
}

/// Asks every method, the exact one in its three ways.
static void ask(trial *t, const sl_visibility *visibility, const char *who, const sl_view *view,
                const bool *expected) {
    uint64_t cells[CELLS_MOST / 64 + 1];
    sli_eye_search *search;
    sl_eye_account account;
    size_t count;
    const sl_eye_method *exact = sl_eye_methods(&count) + count - 1;
    assert_ok(t->context, sli_eye_search_create(t->context, &t->space, visibility, &search));
    assert_ok(t->context, exact->cull(t->context, search, view, cells, &account));
    sli_eye_search_destroy(t->context, search);
    for (uint32_t c = 0; c < t->space.cell_count; c++) {
        if (sl_eye_sees(cells, c) != expected[c]) complain(t, view, c, who, !expected[c]);
        t->seen += expected[c];
        t->asked++;
    }
}

static void try_eye(trial *t) {
    const uint32_t count = t->space.cell_count;
    sl_point eye; // rounding may have put it beyond the border
    do eye = random_eye(t);
    while (sl_space_locate(&t->space, eye) == SL_NO_CELL);
    sl_view views[VIEWS] = {sl_view_all_round(eye)};
    sl_point borders[2 * VIEWS];
    for (int i = 1; i < VIEWS; i++) {
        views[i] = (sl_view){eye, false, random_border(t, eye), random_border(t, eye)};
        if (i == 1) views[i].left = views[i].right;
        if (i == 2)
            views[i].left = (sl_point){2 * eye.x - views[i].right.x, 2 * eye.y - views[i].right.y};
        borders[2 * i - 2] = views[i].right;
        borders[2 * i - 1] = views[i].left;
    }
    oracle_eye *oracle = oracle_eye_create(&t->space, eye, borders, 2 * (size_t)VIEWS - 2);
    bool *closed = calloc(count, sizeof *closed), *open = calloc(count, sizeof *open);
    assert_true(closed && open);
    for (int i = 0; i < VIEWS; i++) {
        oracle_eye_sees(oracle, &views[i], closed, open);
        const bool *expected = t->sight == SL_OPEN ? open : closed;
        for (uint32_t c = 0; c < count; c++) assert_true(closed[c] >= open[c]);
        ask(t, &t->bare, "over portals", &views[i], expected);
        ask(t, &t->baked, "within visible sets", &views[i], expected);
        ask(t, &t->trees, "down stab trees", &views[i], expected);
    }
    free(closed);
    free(open);
    oracle_eye_destroy(oracle);
}

static void bake(trial *t) {
    size_t count;
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    options.threads = 1;
    options.sight = t->sight;
    const sl_see_method *dfs = sl_see_methods(&count);
    t->bare = (sl_visibility){.sight = t->sight};
    assert_ok(t->context, dfs->see(t->context, &t->space, &options, &t->baked));
    options.trees = true;
    assert_ok(t->context, dfs->see(t->context, &t->space, &options, &t->trees));
}

static void try_map(trial *t) {
    const oracle_grid grid = (oracle_grid)(t->seed % 3);
    assert_ok(t->context, oracle_random_map(t->context, t->seed, grid, &t->map));
    assert_ok(t->context, sl_map_clean(t->context, &t->map, NULL, NULL));
    const sl_subdivide_options options = sl_subdivide_options_default();
    if (t->map.wall_count)
        assert_ok(t->context, sli_subdivide_kd(t->context, &t->map, &options, &t->space));
    t->random = (sl_random){t->seed ^ 0x5eed};
    if (t->space.cell_count && t->space.cell_count <= CELLS_MOST) {
        bake(t);
        for (int i = 0; i < EYES; i++) try_eye(t);
    }
    sl_visibility_destroy(t->context, &t->baked);
    sl_visibility_destroy(t->context, &t->trees);
    sl_space_destroy(t->context, &t->space);
    sl_map_destroy(t->context, &t->map);
}

static void random_maps(sl_sight sight) {
    const uint64_t seeds = testing_seeds(60);
    trial t = {.context = testing_context(NULL), .sight = sight};
    for (t.seed = 1; t.seed <= seeds; t.seed++) try_map(&t);
    print_message("%zu of %zu cells seen\n", t.seen, t.asked);
    assert_true(t.seen > 0 && t.seen < t.asked);
    sl_context_destroy(t.context);
}

static void closed_sight(void **state) {
    (void)state;
    random_maps(SL_CLOSED);
}

static void open_sight(void **state) {
    (void)state;
    random_maps(SL_OPEN);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_sight),
        cmocka_unit_test(open_sight),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

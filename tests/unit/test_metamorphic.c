// What must not change an answer, and what may change it one way only. Where the subdivision of a
// changed map is another, what is compared does not depend on it: cells are turned as they are, or
// points that see each other are looked up.
#include "testing.h"

#include "geometry/orient.h"
#include "oracle/random_map.h"
#include "sightline/import.h"
#include "space/subdivide.h"

#include <glob.h>
#include <math.h>

enum { RANDOM_MAPS = 150, POINTS = 40 };

/// A change of the plane that is exact for all doubles, but for moving by an offset.
typedef struct change {
    const char *name;
    bool turns, mirrors;
    double scale, dx, dy;
} change;

static const change changes[] = {
    {"none", false, false, 1, 0, 0},
    {"a quarter turn", true, false, 1, 0, 0},
    {"mirroring", false, true, 1, 0, 0},
    {"a quarter turn and mirroring", true, true, 1, 0, 0},
    {"2^-400", false, false, 0x1p-400, 0, 0},
    {"2^300", false, false, 0x1p300, 0, 0},
    {"moving", false, false, 1, 1024, -65536},
};

enum { CHANGES = sizeof changes / sizeof *changes };

static sl_point apply(const change *c, sl_point p) {
    if (c->turns) p = (sl_point){-p.y, p.x};
    if (c->mirrors) p = (sl_point){-p.x, p.y};
    return (sl_point){p.x * c->scale + c->dx, p.y * c->scale + c->dy};
}

static bool sum_is_exact(double a, double b) {
    const double sum = a + b, back = sum - a;
    return (a - (sum - back)) + (b - back) == 0;
}

static bool is_exact(const change *c, sl_point p) {
    return sum_is_exact(p.x, c->dx) && sum_is_exact(p.y, c->dy);
}

static void subdivide(sl_context *context, sl_map *map, sl_space *out) {
    const sl_subdivide_options options = sl_subdivide_options_default();
    assert_ok(context, sl_map_clean(context, map, NULL, NULL));
    assert_ok(context, sli_subdivide_kd(context, map, &options, out));
}

static sl_visibility see(sl_context *context, const sl_space *space, const sl_see_method *method,
                         sl_sight sight) {
    sl_see_options options = sl_see_options_default();
    options.sight = sight;
    options.solver = method->stabs ? sl_funnel() : NULL;
    options.threads = 1;
    options.trees = strcmp(method->name, "dfs") == 0;
    sl_visibility seen;
    assert_ok(context, method->see(context, space, &options, &seen));
    assert_int_equal(seen.trees.left_out, 0);
    return seen;
}

/// Every map of maps/ and a number of random ones, each to one test.
typedef void on_map(sl_context *context, const char *name, const sl_map *map);

static void copy_walls(sl_context *context, const sl_map *map, size_t but, sl_map *out) {
    for (size_t i = 0; i < map->wall_count; i++)
        if (i != but)
            assert_ok(context, sl_map_add_wall(context, out, map->walls[i].a, map->walls[i].b, 0));
}

static void on_each_map(on_map *test) {
    glob_t found;
    sl_context *context = testing_context(NULL);
    assert_int_equal(glob(SIGHTLINE_SOURCE_DIR "/maps/*.map", 0, NULL, &found), 0);
    for (size_t i = 0; i < found.gl_pathc; i++) {
        sl_map map = {0}, walls = {0};
        assert_ok(context, sl_map_read(context, found.gl_pathv[i], NULL, &map));
        copy_walls(context, &map, SIZE_MAX, &walls);
        test(context, strrchr(found.gl_pathv[i], '/') + 1, &walls);
        sl_map_destroy(context, &map);
        sl_map_destroy(context, &walls);
    }
    globfree(&found);
    for (uint64_t seed = 1; seed <= RANDOM_MAPS; seed++) {
        sl_map map = {0};
        char name[32];
        snprintf(name, sizeof name, "seed %d", (int)seed);
        assert_ok(context, oracle_random_map(context, seed, (oracle_grid)(seed % 3), &map));
        test(context, name, &map);
        sl_map_destroy(context, &map);
    }
    sl_context_destroy(context);
}

static bool same_trees(const sl_stab_trees *a, const sl_stab_trees *b) {
    if (a->cell_count != b->cell_count) return false;
    if (!a->cell_count) return true;
    const size_t offsets = ((size_t)a->cell_count + 1) * sizeof *a->offsets;
    return memcmp(a->offsets, b->offsets, offsets) == 0 &&
           memcmp(a->nodes, b->nodes, a->offsets[a->cell_count] * sizeof *a->nodes) == 0;
}

/// The space with every point changed, all else as it was but what depends on handedness. False
/// where the change is not exact. The tree stays behind: no search asks it.
static bool change_space(const change *c, const sl_space *space, sl_space *out) {
    bool exact = true;
    for (uint32_t i = 0; i < space->portal_count; i++) {
        const sl_portal *from = &space->portals[i];
        out->portals[i].left = apply(c, c->mirrors ? from->right : from->left);
        out->portals[i].right = apply(c, c->mirrors ? from->left : from->right);
    }
    for (uint32_t i = 0; i < space->cell_count; i++) {
        const sl_cell *cell = &space->cells[i];
        for (uint32_t k = 0; k < cell->vertex_count; k++) {
            const uint32_t at = c->mirrors ? cell->vertex_count - 1 - k : k;
            const sl_point from = space->vertices[cell->first_vertex + k];
            exact = exact && is_exact(c, from);
            out->vertices[cell->first_vertex + at] = apply(c, from);
        }
        for (uint32_t k = 0; k < cell->directed_count; k++) {
            const uint32_t at = c->mirrors ? cell->directed_count - 1 - k : k;
            const sl_directed_portal *from = &space->directed[cell->first_directed + k];
            sl_directed_portal *to = &out->directed[cell->first_directed + at];
            exact = exact && is_exact(c, from->left) && is_exact(c, from->right);
            *to = *from;
            to->left = apply(c, c->mirrors ? from->right : from->left);
            to->right = apply(c, c->mirrors ? from->left : from->right);
        }
    }
    for (uint32_t i = 0; i < space->wall_count; i++) {
        out->walls[i].a = apply(c, space->walls[i].a);
        out->walls[i].b = apply(c, space->walls[i].b);
    }
    const sl_point a = apply(c, space->bounds.min), b = apply(c, space->bounds.max);
    out->bounds = (sl_box){{fmin(a.x, b.x), fmin(a.y, b.y)}, {fmax(a.x, b.x), fmax(a.y, b.y)}};
    return exact;
}

/// `same_order`: directed portals are tried in the same order, so that stab trees are the same.
static void compare_changed(sl_context *context, const char *name, const sl_space *space,
                            const sl_space *changed, const sl_see_method *method, const char *what,
                            bool same_order) {
    for (int sight = SL_CLOSED; sight <= SL_OPEN; sight++) {
        sl_visibility before = see(context, space, method, (sl_sight)sight);
        sl_visibility after = see(context, changed, method, (sl_sight)sight);
        if (!testing_same_rows(&before.pvs, &after.pvs) ||
            before.trees.cell_count != after.trees.cell_count ||
            (same_order && !same_trees(&before.trees, &after.trees)))
            fail_msg("%s: %s makes %s see other cells", name, what, method->name);
        if (before.trees.cell_count) assert_int_equal(before.account.nodes, after.account.nodes);
        sl_visibility_destroy(context, &before);
        sl_visibility_destroy(context, &after);
    }
}

static void change_each_way(sl_context *context, const char *name, const sl_map *map) {
    sl_map clean = {0}, again = {0};
    sl_space space, changed;
    size_t method_count;
    const sl_see_method *methods = sl_see_methods(&method_count);
    copy_walls(context, map, SIZE_MAX, &clean);
    copy_walls(context, map, SIZE_MAX, &again);
    subdivide(context, &clean, &space);
    subdivide(context, &again, &changed);
    for (size_t i = 1; i < CHANGES; i++) {
        if (!change_space(&changes[i], &space, &changed)) continue;
        // What is drawn at random falls elsewhere in another space.
        for (size_t m = 0; m < method_count; m++)
            if (methods[m].guarantee != SL_AGGRESSIVE)
                compare_changed(context, name, &space, &changed, &methods[m], changes[i].name,
                                !changes[i].mirrors);
    }
    sl_space_destroy(context, &space);
    sl_space_destroy(context, &changed);
    sl_map_destroy(context, &clean);
    sl_map_destroy(context, &again);
}

static void turned_mirrored_scaled_moved_spaces_are_seen_alike(void **state) {
    (void)state;
    on_each_map(change_each_way);
}

static bool touches(sl_point p, sl_point q, const sl_wall *wall) {
    const int a = sli_orient(p, q, wall->a), b = sli_orient(p, q, wall->b);
    const int c = sli_orient(wall->a, wall->b, p), d = sli_orient(wall->a, wall->b, q);
    if (a * b > 0 || c * d > 0) return false;
    if (a || b || c || d) return true;
    // All on one line.
    return !(fmax(p.x, q.x) < fmin(wall->a.x, wall->b.x) ||
             fmax(wall->a.x, wall->b.x) < fmin(p.x, q.x) ||
             fmax(p.y, q.y) < fmin(wall->a.y, wall->b.y) ||
             fmax(wall->a.y, wall->b.y) < fmin(p.y, q.y));
}

static bool is_free(const sl_map *map, sl_point p, sl_point q) {
    for (size_t i = 0; i < map->wall_count; i++)
        if (touches(p, q, &map->walls[i])) return false;
    return true;
}

/// Points all over the map; most on no wall.
static void scatter(sl_random *random, const sl_map *map, sl_point points[POINTS]) {
    const sl_box box = sl_map_bounds(map);
    for (int i = 0; i < POINTS; i++) {
        const double x = (double)(2 * sl_random_below(random, 1024) + 1) / 2048;
        const double y = (double)(2 * sl_random_below(random, 1024) + 1) / 2048;
        points[i] = (sl_point){box.min.x + x * (box.max.x - box.min.x),
                               box.min.y + y * (box.max.y - box.min.y)};
    }
}

/// Points with nothing between them in `before`, changed, are in cells of `after` that see each
/// other, with either sight: a segment that touches no wall has room.
static size_t check_points(sl_context *context, const char *name, const sl_map *before,
                           sl_map *after, const change *c, sl_random *random) {
    size_t method_count, count = 0;
    const sl_see_method *methods = sl_see_methods(&method_count);
    sl_point points[POINTS];
    sl_space space;
    scatter(random, before, points);
    subdivide(context, after, &space);
    sl_visibility closed = see(context, &space, &methods[0], SL_CLOSED);
    sl_visibility open = see(context, &space, &methods[0], SL_OPEN);
    for (int i = 0; i < POINTS; i++) {
        for (int k = 0; k < i; k++) {
            if (!is_free(before, points[i], points[k])) continue;
            if (!is_exact(c, points[i]) || !is_exact(c, points[k])) continue;
            const uint32_t a = sl_space_locate(&space, apply(c, points[i]));
            const uint32_t b = sl_space_locate(&space, apply(c, points[k]));
            // A map without its outermost wall may have shrunk.
            if (a == SL_NO_CELL || b == SL_NO_CELL) continue;
            count++;
            if (!sl_pvs_sees(&closed.pvs, a, b) || !sl_pvs_sees(&open.pvs, a, b))
                fail_msg("%s, %s: nothing is between (%g, %g) and (%g, %g), but their cells are "
                         "hidden from each other",
                         name, c->name, points[i].x, points[i].y, points[k].x, points[k].y);
        }
    }
    sl_visibility_destroy(context, &closed);
    sl_visibility_destroy(context, &open);
    sl_space_destroy(context, &space);
    return count;
}

static void points_of_changed_map(sl_context *context, const char *name, const sl_map *map) {
    sl_random random = {7};
    for (size_t i = 0; i < CHANGES; i++) {
        sl_map changed = {0};
        bool exact = true;
        for (size_t k = 0; k < map->wall_count; k++) {
            const sl_wall *wall = &map->walls[k];
            exact = exact && is_exact(&changes[i], wall->a) && is_exact(&changes[i], wall->b);
            assert_ok(context, sl_map_add_wall(context, &changed, apply(&changes[i], wall->a),
                                               apply(&changes[i], wall->b), 0));
        }
        const size_t count =
            exact ? check_points(context, name, map, &changed, &changes[i], &random) : 1;
        // Some random maps are walls all over.
        if (strchr(name, '.')) assert_true(count > 0);
        sl_map_destroy(context, &changed);
    }
}

static void points_that_see_each_other_are_in_cells_that_do(void **state) {
    (void)state;
    on_each_map(points_of_changed_map);
}

static void points_without_a_wall(sl_context *context, const char *name, const sl_map *map) {
    sl_random random = {11};
    for (int i = 0; i < 4; i++) {
        sl_map fewer = {0};
        copy_walls(context, map, sl_random_below(&random, map->wall_count), &fewer);
        check_points(context, name, map, &fewer, &changes[0], &random);
        sl_map_destroy(context, &fewer);
    }
}

static void a_wall_taken_away_hides_no_point(void **state) {
    (void)state;
    on_each_map(points_without_a_wall);
}

/// Where the upper side of a cell lies on the lower side of another: the directed portal up across
/// all of it.
static bool common_side(const sl_space *space, uint32_t below, uint32_t above,
                        sl_directed_portal *up) {
    const sl_point *a = &space->vertices[space->cells[below].first_vertex];
    const sl_point *b = &space->vertices[space->cells[above].first_vertex];
    const double from = fmax(a[0].x, b[0].x), to = fmin(a[1].x, b[1].x);
    if (a[2].y != b[0].y || from >= to) return false;
    *up = (sl_directed_portal){.cell = above, .left = {from, b[0].y}, .right = {to, b[0].y}};
    return true;
}

/// The space with one directed portal more from one cell to another and back.
static void add_way(const sl_space *space, uint32_t below, sl_directed_portal up, sl_space *out) {
    *out = *space;
    out->directed = calloc(space->directed_count + 2, sizeof *out->directed);
    out->cells = calloc(space->cell_count, sizeof *out->cells);
    assert_true(out->directed && out->cells);
    out->directed_count = 0;
    for (uint32_t c = 0; c < space->cell_count; c++) {
        sl_cell *cell = &out->cells[c];
        *cell = space->cells[c];
        const sl_directed_portal *directed = &space->directed[cell->first_directed];
        cell->first_directed = out->directed_count;
        for (uint32_t i = 0; i < cell->directed_count; i++)
            out->directed[out->directed_count++] = directed[i];
        const sl_directed_portal down = {.cell = below, .left = up.right, .right = up.left};
        if (c == below) out->directed[out->directed_count++] = up;
        if (c == up.cell) out->directed[out->directed_count++] = down;
        cell->directed_count = out->directed_count - cell->first_directed;
    }
}

static bool is_subset(const sl_pvs *small, const sl_pvs *large) {
    for (uint32_t c = 0; c < small->cell_count; c++)
        for (sl_pvs_run run = sl_pvs_begin(small, c); sl_pvs_next(&run);)
            for (uint32_t to = run.first; to < run.end; to++)
                if (!sl_pvs_sees(large, c, to)) return false;
    return true;
}

/// Opens the wall between two cells that lie on each other, a few times.
static void open_walls(sl_context *context, const char *name, const sl_map *map) {
    sl_map clean = {0};
    sl_space space, wider;
    size_t method_count;
    const sl_see_method *dfs = sl_see_methods(&method_count);
    assert_true(dfs->stabs);
    copy_walls(context, map, SIZE_MAX, &clean);
    subdivide(context, &clean, &space);
    sl_visibility before[2] = {see(context, &space, dfs, SL_CLOSED),
                               see(context, &space, dfs, SL_OPEN)};
    sl_random random = {13};
    int opened = 0;
    for (int tries = 0; tries < 4000 && opened < 3; tries++) {
        const uint32_t below = (uint32_t)sl_random_below(&random, space.cell_count);
        const uint32_t above = (uint32_t)sl_random_below(&random, space.cell_count);
        sl_directed_portal up;
        if (!common_side(&space, below, above, &up)) continue;
        opened++;
        add_way(&space, below, up, &wider);
        for (int sight = SL_CLOSED; sight <= SL_OPEN; sight++) {
            sl_visibility after = see(context, &wider, dfs, (sl_sight)sight);
            if (!is_subset(&before[sight].pvs, &after.pvs))
                fail_msg("%s: a wall opened between cells %u and %u hides a cell", name, below,
                         above);
            assert_true(sl_pvs_sees(&after.pvs, below, above));
            sl_visibility_destroy(context, &after);
        }
        free(wider.directed);
        free(wider.cells);
    }
    sl_visibility_destroy(context, &before[0]);
    sl_visibility_destroy(context, &before[1]);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &clean);
}

static void a_wall_opened_in_one_space_hides_no_cell(void **state) {
    (void)state;
    on_each_map(open_walls);
}

/// The cells that a stab tree has reached: what was found from one end, before anything is
/// mirrored.
static void reach(const sl_visibility *seen, uint32_t source, bool *reached) {
    const sl_stab_trees *trees = &seen->trees;
    for (uint64_t i = trees->offsets[source]; i < trees->offsets[source + 1]; i++)
        reached[trees->nodes[i].cell] = true;
}

static void see_both_ways(sl_context *context, const char *name, const sl_map *map) {
    sl_map clean = {0};
    sl_space space;
    size_t method_count;
    const sl_see_method *dfs = sl_see_methods(&method_count);
    copy_walls(context, map, SIZE_MAX, &clean);
    subdivide(context, &clean, &space);
    const uint32_t n = space.cell_count;
    for (int sight = SL_CLOSED; sight <= SL_OPEN; sight++) {
        bool *reached = calloc((size_t)n * n, sizeof *reached);
        assert_non_null(reached);
        sl_visibility seen = see(context, &space, dfs, (sl_sight)sight);
        for (uint32_t c = 0; c < n; c++) reach(&seen, c, reached + (size_t)c * n);
        for (uint32_t a = 0; a < n; a++) {
            if (!reached[(size_t)a * n + a]) fail_msg("%s: cell %u does not see itself", name, a);
            for (uint32_t b = 0; b < n; b++)
                if (reached[(size_t)a * n + b] != reached[(size_t)b * n + a])
                    fail_msg("%s: of cells %u and %u one sees the other only", name, a, b);
        }
        sl_visibility_destroy(context, &seen);
        free(reached);
    }
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &clean);
}

static void who_sees_is_seen(void **state) {
    (void)state;
    on_each_map(see_both_ways);
}

static bool same_bytes(const void *a, const void *b, size_t count, size_t size) {
    return count == 0 || memcmp(a, b, count * size) == 0;
}

static bool same_space(const sl_space *a, const sl_space *b) {
    return a->root == b->root && a->node_count == b->node_count && a->cell_count == b->cell_count &&
           a->vertex_count == b->vertex_count && a->portal_count == b->portal_count &&
           a->directed_count == b->directed_count && a->inside_count == b->inside_count &&
           same_bytes(a->nodes, b->nodes, a->node_count, sizeof *a->nodes) &&
           same_bytes(a->cells, b->cells, a->cell_count, sizeof *a->cells) &&
           same_bytes(a->vertices, b->vertices, a->vertex_count, sizeof *a->vertices) &&
           same_bytes(a->portals, b->portals, a->portal_count, sizeof *a->portals) &&
           same_bytes(a->directed, b->directed, a->directed_count, sizeof *a->directed);
}

/// The same walls in another order, some the other way round, some twice.
static void shuffle(sl_context *context, sl_random *random, const sl_map *map, sl_map *out) {
    copy_walls(context, map, SIZE_MAX, out);
    for (size_t i = out->wall_count; i > 1; i--) {
        const size_t k = sl_random_below(random, i);
        const sl_wall swap = out->walls[i - 1];
        out->walls[i - 1] = out->walls[k];
        out->walls[k] = swap;
    }
    for (size_t i = 0; i < map->wall_count; i++) {
        sl_wall *wall = &out->walls[i];
        if (sl_random_below(random, 2))
            *wall = (sl_wall){wall->b, wall->a, wall->line, sl_ground_turned(wall->ground)};
        const sl_point a = wall->a, b = wall->b;
        if (sl_random_below(random, 8) == 0)
            assert_ok(context, sl_map_add_wall(context, out, a, b, 0));
    }
}

static void reorder(sl_context *context, const char *name, const sl_map *map) {
    sl_random random = {17};
    sl_map clean = {0};
    sl_space space, other;
    size_t method_count;
    const sl_see_method *methods = sl_see_methods(&method_count);
    copy_walls(context, map, SIZE_MAX, &clean);
    subdivide(context, &clean, &space);
    for (int i = 0; i < 3; i++) {
        sl_map shuffled = {0};
        shuffle(context, &random, map, &shuffled);
        subdivide(context, &shuffled, &other);
        if (!same_space(&space, &other)) fail_msg("%s: the order of walls makes other cells", name);
        for (size_t m = 0; i == 0 && m < method_count; m++)
            compare_changed(context, name, &space, &other, &methods[m], "another order of walls",
                            true);
        sl_space_destroy(context, &other);
        sl_map_destroy(context, &shuffled);
    }
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &clean);
}

static void the_order_of_walls_changes_nothing(void **state) {
    (void)state;
    on_each_map(reorder);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(turned_mirrored_scaled_moved_spaces_are_seen_alike),
        cmocka_unit_test(points_that_see_each_other_are_in_cells_that_do),
        cmocka_unit_test(a_wall_taken_away_hides_no_point),
        cmocka_unit_test(a_wall_opened_in_one_space_hides_no_cell),
        cmocka_unit_test(who_sees_is_seen),
        cmocka_unit_test(the_order_of_walls_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

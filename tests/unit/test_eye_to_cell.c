// Eye-to-cell culling: each method within the one before, on every map of maps/ and on random ones,
// for eyes and cones of all kinds; what an eye on a portal, a wall, a corner sees; what is refused.
#include "map_files.h"
#include "sight/eye_search.h"
#include "space/subdivide.h"

#include "oracle/random_map.h"

#include <math.h>

typedef struct world {
    sl_context *context;
    sl_map map;
    sl_space space;
    sl_visibility visibility;
    sli_eye_search *search;
} world;

static void see(world *w, sl_sight sight, bool trees, bool inside_only) {
    size_t count;
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    options.sight = sight;
    options.trees = trees;
    options.inside_only = inside_only;
    assert_ok(w->context,
              sl_see_methods(&count)->see(w->context, &w->space, &options, &w->visibility));
    assert_ok(w->context, sli_eye_search_create(w->context, &w->space, &w->visibility, &w->search));
}

static void forget(world *w) {
    sli_eye_search_destroy(w->context, w->search);
    sl_visibility_destroy(w->context, &w->visibility);
    w->search = NULL;
}

static world open_world(const char *statements) {
    world w = {.context = testing_context(NULL)};
    testing_space(w.context, statements, &w.map, &w.space);
    return w;
}

static void close_world(world *w) {
    forget(w);
    sl_space_destroy(w->context, &w->space);
    sl_map_destroy(w->context, &w->map);
    sl_context_destroy(w->context);
}

static uint64_t *new_set(const world *w) {
    uint64_t *cells = calloc(sl_eye_words(&w->space) + 1, sizeof *cells);
    assert_non_null(cells);
    return cells;
}

static void cull(const world *w, const char *method, const sl_view *view, uint64_t *cells) {
    size_t count;
    sl_eye_account account;
    const sl_eye_method *methods = sl_eye_methods(&count);
    for (size_t i = 0; i < count; i++)
        if (strcmp(methods[i].name, method) == 0) {
            assert_ok(w->context, methods[i].cull(w->context, w->search, view, cells, NULL));
            assert_ok(w->context, methods[i].cull(w->context, w->search, view, cells, &account));
            return;
        }
    fail_msg("no method %s", method);
}

/// Whether the exact method sees the cell that holds a point.
static bool sees(const world *w, sl_point eye, double look, double fov, sl_point point) {
    const sl_view view = sl_view_cone(eye, look, fov, 100);
    uint64_t *cells = new_set(w);
    cull(w, "exact", &view, cells);
    const bool seen = sl_eye_sees(cells, sl_space_locate(&w->space, point));
    free(cells);
    return seen;
}

// --- the chain

/// Every method's cells are among those of the one before, all beyond the last cell are 0, and the
/// eye's cell is seen if anything is: by the exact method, if the cone leads into it.
static void check_view(const world *w, const sl_view *view, const char *where) {
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    const size_t words = sl_eye_words(&w->space);
    uint64_t *before = new_set(w), *cells = new_set(w);
    const uint32_t own = sl_space_locate(&w->space, view->eye);
    for (size_t i = 0; i < count; i++) {
        sl_eye_account account = {0};
        cells[words] = 42;
        assert_ok(w->context, methods[i].cull(w->context, w->search, view, cells, &account));
        assert_int_equal(cells[words], 42);
        bool any = false;
        for (uint32_t c = 0; c < 64 * words; c++) {
            if (!sl_eye_sees(cells, c)) continue;
            any = true;
            if (c >= w->space.cell_count || (i && !sl_eye_sees(before, c)))
                fail_msg("%s, eye %.17g,%.17g right %.17g,%.17g left %.17g,%.17g: cell %u is kept "
                         "by %s, not by %s before it",
                         where, view->eye.x, view->eye.y, view->right.x, view->right.y,
                         view->left.x, view->left.y, c, methods[i].name,
                         i ? methods[i - 1].name : "any cell that there is");
        }
        if (any && (view->full || i + 1 < count)) assert_true(sl_eye_sees(cells, own));
        if (any) assert_true(account.nodes > 0);
        if (own == SL_NO_CELL) assert_false(any);
        memcpy(before, cells, words * sizeof *cells);
    }
    free(before);
    free(cells);
}

static sl_point on_segment(sl_random *random, sl_point a, sl_point b) {
    const double share = (double)sl_random_below(random, 9) / 8;
    return (sl_point){a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share};
}

static sl_point random_eye(const world *w, sl_random *random) {
    const sl_space *space = &w->space;
    const sl_cell *cell = &space->cells[sl_random_below(random, space->cell_count)];
    const sl_point *corners = space->vertices + cell->first_vertex;
    switch (sl_random_below(random, 5)) {
    case 0:
        return corners[sl_random_below(random, cell->vertex_count)];
    case 1: {
        if (!space->directed_count) return corners[0];
        const sl_directed_portal *directed =
            &space->directed[sl_random_below(random, space->directed_count)];
        return on_segment(random, directed->left, directed->right);
    }
    case 2: {
        const sl_wall *wall = &space->walls[sl_random_below(random, space->wall_count)];
        return on_segment(random, wall->a, wall->b);
    }
    case 3: { // here and there outside
        const sl_box b = space->bounds;
        const double x = 1.2 * sl_random_unit(random) - 0.1, y = 1.2 * sl_random_unit(random) - 0.1;
        return (sl_point){b.min.x + x * (b.max.x - b.min.x), b.min.y + y * (b.max.y - b.min.y)};
    }
    default:
        return on_segment(random, on_segment(random, corners[0], corners[1]),
                          on_segment(random, corners[2], corners[3]));
    }
}

static void check_views(const world *w, uint64_t seed, int count, const char *where) {
    static const double widths[] = {0, 1e-9, 1, 30, 60, 90, 179, 180, 181, 270, 359, 360};
    sl_random random = {seed};
    const double reach = w->space.bounds.max.x - w->space.bounds.min.x +
                         fabs(w->space.bounds.min.x) + fabs(w->space.bounds.max.y);
    for (int i = 0; i < count; i++) {
        const sl_point eye = random_eye(w, &random);
        const double look = sl_random_below(&random, 2) ? 45 * (double)sl_random_below(&random, 8)
                                                        : 360 * sl_random_unit(&random);
        for (size_t k = 0; k < sizeof widths / sizeof *widths; k++) {
            sl_view view = sl_view_cone(eye, look, widths[k], reach);
            check_view(w, &view, where);
            // through a corner of some cell
            view.right = w->space.vertices[sl_random_below(&random, w->space.vertex_count)];
            if (!view.full && sli_view_usable(&view)) check_view(w, &view, where);
        }
    }
}

static void check_world(world *w, uint64_t seed, int count, const char *where) {
    for (int sight = 0; sight < 2; sight++)
        for (int way = 0; way < 3; way++) {
            see(w, (sl_sight)sight, way == 1, way == 2);
            check_views(w, seed, count, where);
            forget(w);
        }
}

static void chain_on_every_map(void **state) {
    (void)state;
    glob_t files = map_files_find(MAP_FILES_OWN);
    size_t maps = 0;
    for (size_t i = 0; i < files.gl_pathc; i++) {
        world w = {.context = testing_context(NULL)};
        const sl_subdivide_options options = sl_subdivide_options_default();
        map_files_read(w.context, files.gl_pathv[i], &w.map);
        assert_ok(w.context, sl_map_clean(w.context, &w.map, NULL, NULL));
        if (sli_subdivide_kd(w.context, &w.map, &options, &w.space) == SL_OK) {
            check_world(&w, maps, 6, files.gl_pathv[i]);
            maps++;
        }
        close_world(&w);
    }
    globfree(&files);
    assert_true(maps >= 5);
}

static void chain_on_random_maps(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 40; seed++) {
        world w = {.context = testing_context(NULL)};
        char where[32];
        snprintf(where, sizeof where, "seed %u", (unsigned)seed);
        const sl_subdivide_options options = sl_subdivide_options_default();
        assert_ok(w.context, oracle_random_map(w.context, seed, (oracle_grid)(seed % 3), &w.map));
        assert_ok(w.context, sl_map_clean(w.context, &w.map, NULL, NULL));
        assert_ok(w.context, sli_subdivide_kd(w.context, &w.map, &options, &w.space));
        check_world(&w, seed, 4, where);
        close_world(&w);
    }
}

// --- where the eye is

/// Two rooms with a door between, from (10,4) to (10,6), and cells that the door's lines cut.
static const char rooms[] = "walls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 4\nwall 10 6 10 10\n";

static void an_eye_on_a_portal_sees_both_sides(void **state) {
    (void)state;
    world w = open_world(rooms);
    for (int sight = 0; sight < 2; sight++) {
        see(&w, (sl_sight)sight, false, false);
        const sl_point door = {10, 5}, west = {1, 5}, east = {19, 5};
        assert_true(sees(&w, door, 0, 360, west) && sees(&w, door, 0, 360, east));
        assert_true(sees(&w, door, 180, 60, west) && sees(&w, door, 0, 60, east));
        // The eye is in both cells at the door, and sees those that the cone leads into.
        assert_false(sees(&w, door, 180, 60, east) || sees(&w, door, 0, 60, west));
        assert_false(sees(&w, door, 180, 179, east) || sees(&w, door, 0, 179, west));
        // Along the door it runs along the borders of both.
        assert_true(sees(&w, door, 180, 180, east) && sees(&w, door, 0, 180, west));
        assert_true(sees(&w, door, 90, 0, east) && sees(&w, door, 90, 0, west));
        forget(&w);
    }
    close_world(&w);
}

static void an_eye_on_a_wall_sees_one_side(void **state) {
    (void)state;
    world w = open_world(rooms);
    for (int sight = 0; sight < 2; sight++) {
        see(&w, (sl_sight)sight, false, false);
        const sl_point wall = {10, 2}, west = {1, 2}, east = {19, 2};
        assert_true(sees(&w, wall, 0, 360, east));
        assert_false(sees(&w, wall, 180, 170, west));
        // Closed sight runs along the wall up to the door, and there touches the other room.
        assert_int_equal(sees(&w, wall, 0, 360, west), sight == SL_CLOSED);
        forget(&w);
    }
    close_world(&w);
}

static void an_eye_where_portals_meet_sees_all_round(void **state) {
    (void)state;
    // Two walls' lines cut the square in four at (4,4), where no wall is.
    world w = open_world("walls 0 0 8 0 8 8 0 8 0 0\nwall 4 0 4 1\nwall 0 4 1 4\n"
                         "wall 4 7 4 8\nwall 7 4 8 4\n");
    for (int sight = 0; sight < 2; sight++) {
        see(&w, (sl_sight)sight, false, false);
        for (int look = 45; look < 360; look += 90)
            for (int other = 45; other < 360; other += 90) {
                const double radians = other * (acos(-1) / 180);
                const sl_point at = {4 + 3 * cos(radians), 4 + 3 * sin(radians)};
                // It is in all four. Two more are beside a cone of 90 degrees.
                assert_int_equal(sees(&w, (sl_point){4, 4}, look, 30, at), look == other);
                assert_int_equal(sees(&w, (sl_point){4, 4}, look - 45, 90, at),
                                 look == other || (other + 90) % 360 == look % 360);
            }
        forget(&w);
    }
    close_world(&w);
}

static void an_eye_at_a_walls_end_sees_around_it(void **state) {
    (void)state;
    // A wall that hangs down to (4,4): its end is located in the cell at its right.
    world w = open_world("walls 0 0 8 0 8 8 0 8 0 0\nwall 4 4 4 8\nwall 0 4 1 4\nwall 7 4 8 4\n");
    see(&w, SL_CLOSED, false, false);
    const sl_point eye = {4, 4};
    assert_true(sees(&w, eye, 0, 360, (sl_point){6, 6}));
    assert_true(sees(&w, eye, 0, 360, (sl_point){6, 2}));
    assert_true(sees(&w, eye, 225, 30, (sl_point){2, 2}));
    assert_true(sees(&w, eye, 135, 30, (sl_point){2, 6}));
    // On the wall, the side of the cell counts.
    assert_false(sees(&w, (sl_point){4, 5}, 135, 30, (sl_point){2, 6}));
    close_world(&w);
}

static void an_eye_outside_sees_nothing(void **state) {
    (void)state;
    world w = open_world(rooms);
    see(&w, SL_CLOSED, false, false);
    const sl_view view = sl_view_all_round((sl_point){-1, 5});
    check_view(&w, &view, "outside");
    close_world(&w);
}

static void grazing_is_for_closed_sight(void **state) {
    (void)state;
    // From (2,2) the line over the end at (4,4) meets the corner of the alcove at (6,6).
    world w = open_world("walls 0 0 8 0 8 8 0 8 0 0\nwall 4 0 4 4\nwall 4 4 8 4\n");
    see(&w, SL_CLOSED, false, false);
    const sl_point eye = {2, 4}, neighbour = {7, 6};
    assert_true(sees(&w, eye, 0, 0, neighbour));
    forget(&w);
    see(&w, SL_OPEN, false, false);
    assert_false(sees(&w, eye, 0, 0, neighbour));
    assert_true(sees(&w, eye, 0, 360, neighbour));
    close_world(&w);
}

static void without_visible_sets(void **state) {
    (void)state;
    world w = open_world(rooms);
    size_t count;
    sl_eye_account account;
    const sl_eye_method *methods = sl_eye_methods(&count);
    const sl_view view = sl_view_all_round((sl_point){5, 5});
    assert_ok(w.context, sli_eye_search_create(w.context, &w.space, &w.visibility, &w.search));
    uint64_t *cells = new_set(&w);
    for (size_t i = 0; i < count; i++) {
        const sl_status status = methods[i].cull(w.context, w.search, &view, cells, &account);
        assert_int_equal(status, methods[i].needs_pvs ? SL_BAD_ARGUMENT : SL_OK);
    }
    assert_true(sl_eye_sees(cells, sl_space_locate(&w.space, (sl_point){19, 5})));
    free(cells);
    close_world(&w);
}

static void a_cell_that_was_not_baked_sees_nothing(void **state) {
    (void)state;
    world w = open_world("walls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 10\nstart 5 5 0\n");
    see(&w, SL_CLOSED, false, true);
    uint64_t *cells = new_set(&w);
    const sl_view view = sl_view_all_round((sl_point){15, 5});
    cull(&w, "exact", &view, cells);
    assert_int_equal(cells[0], 0);
    free(cells);
    close_world(&w);
}

// --- rays through many corners

/// A ray along the diagonal of a grid of portals can pass each corner on either side: sequences
/// double at each, the search's steps must not.
static void a_diagonal_does_not_explode(void **state) {
    (void)state;
    enum { SIDE = 24 };
    static char text[SIDE * SIDE * 80];
    size_t used = (size_t)snprintf(text, sizeof text, "walls 0 0 24 0 24 24 0 24 0 0\n");
    for (int line = 1; line < SIDE; line++)
        for (int i = 0; i < SIDE; i++) // gaps are left about each corner
            used += (size_t)snprintf(text + used, sizeof text - used,
                                     "wall %d.25 %d %d.75 %d\nwall %d %d.25 %d %d.75\n", i, line, i,
                                     line, line, i, line, i);
    world w = open_world(text);
    assert_int_equal(w.space.cell_count, SIDE * SIDE);
    assert_ok(w.context, sli_eye_search_create(w.context, &w.space, &w.visibility, &w.search));
    size_t count;
    const sl_eye_method *exact = sl_eye_methods(&count) + count - 1;
    uint64_t *cells = new_set(&w);
    for (int fov = 0; fov <= 360; fov += 180) {
        const sl_view view = sl_view_cone((sl_point){0.5, 0.5}, 45, fov, 100);
        sl_eye_account account;
        assert_ok(w.context, exact->cull(w.context, w.search, &view, cells, &account));
        assert_true(sl_eye_sees(cells, sl_space_locate(&w.space, (sl_point){23.5, 23.5})));
        assert_true(account.nodes < 100 * 1000);
    }
    free(cells);
    close_world(&w);
}

// --- trees

static void a_tree_in_another_order_is_passed_over(void **state) {
    (void)state;
    // Five rooms in a row, the eye in the middle one: two nodes each way.
    world w = open_world("walls 0 0 50 0 50 10 0 10 0 0\n"
                         "wall 10 0 10 4\nwall 10 6 10 10\nwall 20 0 20 4\nwall 20 6 20 10\n"
                         "wall 30 0 30 4\nwall 30 6 30 10\nwall 40 0 40 4\nwall 40 6 40 10\n");
    see(&w, SL_CLOSED, true, false);
    uint64_t *with = new_set(&w), *without = new_set(&w);
    const sl_view view = sl_view_all_round((sl_point){25, 5});
    const uint32_t cell = sl_space_locate(&w.space, view.eye);
    cull(&w, "exact", &view, with);
    assert_int_equal(with[0], 31);
    sl_stab_trees *trees = &w.visibility.trees;
    sl_stab_node *nodes = trees->nodes + trees->offsets[cell];
    assert_int_equal(trees->offsets[cell + 1] - trees->offsets[cell], 5);
    // Breadth first: both of the first portal, then both of the second.
    const sl_stab_node second = nodes[2];
    nodes[2] = nodes[3];
    nodes[3] = second;
    nodes[4].parent = 2;
    cull(&w, "exact", &view, without);
    assert_memory_equal(with, without, sl_eye_words(&w.space) * sizeof *with);
    free(with);
    free(without);
    close_world(&w);
}

// --- what is refused

static void views_that_are_none(void **state) {
    (void)state;
    world w = open_world(rooms);
    see(&w, SL_CLOSED, false, false);
    const sl_point eye = {5, 5}, far = {9, 5}, nowhere = {NAN, 5}, endless = {INFINITY, 5};
    const sl_view views[] = {sl_view_all_round(nowhere), sl_view_all_round(endless),
                             {eye, false, eye, far},     {eye, false, far, eye},
                             {eye, false, nowhere, far}, {eye, false, far, endless}};
    size_t count;
    sl_eye_account account;
    const sl_eye_method *methods = sl_eye_methods(&count);
    uint64_t *cells = new_set(&w);
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
        assert_false(sli_view_usable(&views[v]));
        for (size_t i = 0; i < count; i++)
            assert_int_equal(methods[i].cull(w.context, w.search, &views[v], cells, &account),
                             SL_BAD_ARGUMENT);
    }
    free(cells);
    close_world(&w);
}

static void a_heading_turns_over_and_over(void **state) {
    (void)state;
    // 1e22 is a double, and 280 more than whole turns; half a view cone is lost beside it.
    const sl_view once = sl_view_cone((sl_point){1, 1}, 280, 90, 100);
    for (int sign = -1; sign <= 1; sign += 2) {
        const sl_view view = sl_view_cone((sl_point){1, 1}, sign * 1e22, 90, 100);
        const sl_view same = sl_view_cone((sl_point){1, 1}, sign * 280, 90, 100);
        assert_memory_equal(&view.left, &same.left, sizeof view.left);
        assert_memory_equal(&view.right, &same.right, sizeof view.right);
    }
    assert_true(once.left.x > once.right.x && once.left.y < 1 && once.right.y < 1);
}

static void sets_of_another_space(void **state) {
    (void)state;
    world w = open_world(rooms), other = open_world("walls 0 0 1 0 1 1 0 1 0 0\n");
    sli_eye_search *search = NULL;
    see(&w, SL_CLOSED, false, false);
    assert_int_equal(sli_eye_search_create(other.context, &other.space, &w.visibility, &search),
                     SL_BAD_ARGUMENT);
    assert_null(search);
    close_world(&w);
    close_world(&other);
}

/// Portals that lead round and round, each crossed upwards: no map has them.
static void a_space_that_no_map_has(void **state) {
    (void)state;
    sl_directed_portal directed[2] = {{0, 1, {-1, 1}, {1, 1}}, {1, 0, {-1, 2}, {1, 2}}};
    sl_cell cells[2] = {{.first_directed = 0, .directed_count = 1},
                        {.first_directed = 1, .directed_count = 1}};
    const sl_space space = {.bounds = {{-1, 0}, {1, 3}},
                            .root = -1,
                            .cell_count = 2,
                            .directed_count = 2,
                            .cells = cells,
                            .directed = directed};
    const sl_visibility none = {.sight = SL_CLOSED};
    sl_context *context = testing_context(NULL);
    sli_eye_search *search;
    uint64_t set;
    size_t count;
    sl_eye_account account;
    const sl_view view = sl_view_all_round((sl_point){0, 0.5});
    const sl_eye_method *exact = sl_eye_methods(&count) + count - 1;
    assert_ok(context, sli_eye_search_create(context, &space, &none, &search));
    assert_int_equal(exact->cull(context, search, &view, &set, &account), SL_BAD_INPUT);
    assert_non_null(strstr(sl_context_message(context), "twice"));
    sli_eye_search_destroy(context, search);
    sl_context_destroy(context);
}

static void memory_that_fails(void **state) {
    (void)state;
    testing_memory memory = {0};
    world w = open_world(rooms);
    sl_context *context = testing_context(&memory);
    const long live = memory.live;
    long failures = 0;
    sl_status status = SL_NO_MEMORY;
    for (; status == SL_NO_MEMORY; failures++) {
        sli_eye_search *search = NULL;
        memory.calls = 0;
        memory.fail_at = failures + 1;
        status = sli_eye_search_create(context, &w.space, &w.visibility, &search);
        assert_true((status == SL_OK) == (search != NULL));
        sli_eye_search_destroy(context, search);
        assert_int_equal(memory.live, live);
    }
    assert_int_equal(status, SL_OK);
    assert_true(failures > 4);
    sl_context_destroy(context);
    close_world(&w);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chain_on_every_map),
        cmocka_unit_test(chain_on_random_maps),
        cmocka_unit_test(an_eye_on_a_portal_sees_both_sides),
        cmocka_unit_test(an_eye_on_a_wall_sees_one_side),
        cmocka_unit_test(an_eye_where_portals_meet_sees_all_round),
        cmocka_unit_test(an_eye_at_a_walls_end_sees_around_it),
        cmocka_unit_test(an_eye_outside_sees_nothing),
        cmocka_unit_test(grazing_is_for_closed_sight),
        cmocka_unit_test(without_visible_sets),
        cmocka_unit_test(a_cell_that_was_not_baked_sees_nothing),
        cmocka_unit_test(a_diagonal_does_not_explode),
        cmocka_unit_test(a_tree_in_another_order_is_passed_over),
        cmocka_unit_test(views_that_are_none),
        cmocka_unit_test(a_heading_turns_over_and_over),
        cmocka_unit_test(sets_of_another_space),
        cmocka_unit_test(a_space_that_no_map_has),
        cmocka_unit_test(memory_that_fails),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

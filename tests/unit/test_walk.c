/// Walks on random maps: nothing that is seen is missed, by any method with any test, and those
/// that should agree do.
#include "sight/eye_search.h"
#include "sight/region.h"
#include "space/outline.h"
#include "space/subdivide.h"
#include "testing.h"

#include "geometry/orient.h"
#include "oracle/random_map.h"
#include "oracle/random_oblique.h"
#include "sightline/generate.h"
#include "sightline/walk.h"

#include <math.h>

enum { MOST_WALKS = 40 };

/// A map with its space, and a walk of each method with each test.
typedef struct world {
    sl_context *context;
    sl_map map;
    sl_space space;
    sl_outline outline;
    sl_hierarchy hierarchy;
    sl_visibility none; ///< no visible sets: exact culling then searches the whole space
    sli_eye_search *search;
    sl_region region;
    uint64_t *seen; ///< cells, by exact culling or by points of the visible region
    sl_walk *walks[MOST_WALKS];
    const sl_walk_method *methods[MOST_WALKS];
    size_t walk_count;
    bool cheap;
} world;

static void open_world(world *w, const sl_walk_options *like) {
    sl_context *context = w->context;
    size_t methods_count, tests_count;
    const sl_walk_method *methods = sl_walk_methods(&methods_count);
    const sl_node_test *tests = sl_node_tests(&tests_count);
    assert_ok(context, sli_outline_make(context, &w->space, &w->outline));
    assert_ok(context, sl_hierarchy_make(context, &w->space, &w->hierarchy));
    w->none.sight = SL_OPEN;
    w->cheap = like->cheap > 0;
    assert_ok(context, sli_eye_search_create(context, &w->space, &w->none, &w->search));
    w->seen = calloc(sl_eye_words(&w->space), sizeof *w->seen);
    assert_non_null(w->seen);
    for (size_t m = 0; m < methods_count; m++)
        for (size_t t = 0; t < tests_count; t++) {
            sl_walk_options options = *like;
            options.test = &tests[t];
            assert_true(w->walk_count < MOST_WALKS);
            w->methods[w->walk_count] = &methods[m];
            assert_ok(context, sl_walk_create(context, &w->hierarchy, &methods[m], &options,
                                              &w->walks[w->walk_count++]));
        }
}

static void close_world(world *w) {
    for (size_t i = 0; i < w->walk_count; i++) sl_walk_destroy(w->context, w->walks[i]);
    free(w->seen);
    sl_region_destroy(w->context, &w->region);
    sli_eye_search_destroy(w->context, w->search);
    sl_hierarchy_destroy(w->context, &w->hierarchy);
    sli_outline_destroy(w->context, &w->outline);
    sl_space_destroy(w->context, &w->space);
    sl_map_destroy(w->context, &w->map);
    *w = (world){.context = w->context};
}

static void see(world *w, uint32_t cell) {
    w->seen[cell / 64] |= UINT64_C(1) << cell % 64;
}

/// Whether the eye is in its cell, not on its border.
static bool stands_free(const world *w, sl_point eye, uint32_t cell) {
    if (cell == SL_NO_CELL) return false;
    const sl_cell *c = &w->space.cells[cell];
    const sl_point *corners = w->space.vertices + c->first_vertex;
    for (uint32_t i = 0; i < c->vertex_count; i++)
        if (sli_orient(corners[i], corners[(i + 1) % c->vertex_count], eye) <= 0) return false;
    return true;
}

/// Whether a wall crosses the segment between two points.
static bool crosses_wall(const world *w, sl_point from, sl_point to) {
    for (uint32_t i = 0; i < w->space.wall_count; i++) {
        const sl_wall *wall = &w->space.walls[i];
        if (sli_orient(wall->a, wall->b, from) * sli_orient(wall->a, wall->b, to) < 0 &&
            sli_orient(from, to, wall->a) * sli_orient(from, to, wall->b) < 0)
            return true;
    }
    return false;
}

/// By exact culling, of an eye that is free in its cell: one on a border has cells count that it
/// only touches. False for other eyes.
static bool look_exactly(world *w, const sl_view *view) {
    memset(w->seen, 0, sl_eye_words(&w->space) * sizeof *w->seen);
    if (!stands_free(w, view->eye, sl_space_locate(&w->space, view->eye))) return false;
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    sl_eye_account account;
    assert_ok(w->context, methods[count - 1].cull(w->context, w->search, view, w->seen, &account));
    return true;
}

/// By points of the visible region, for every eye.
static void look_at_region(world *w, const sl_view *view) {
    assert_ok(w->context, sli_region_make(w->context, &w->outline, view, 0, &w->region));
    const sl_region *r = &w->region;
    const sl_box b = w->space.bounds;
    const double floor_area = 1e-9 * (b.max.x - b.min.x) * (b.max.y - b.min.y);
    for (size_t i = 0; i < r->count; i++) {
        const sl_point p = r->offsets[i], q = r->offsets[(i + 1) % r->count];
        // A triangle too thin holds no point that doubles can tell.
        if (p.x * q.y - p.y * q.x < floor_area) continue;
        for (int k = 1; k < 8; k++) {
            const double along = k / 8., out = (k * 5 % 8) / 8. * 0.98 + 0.01;
            const sl_point at = {view->eye.x + out * (p.x + along * (q.x - p.x)),
                                 view->eye.y + out * (p.y + along * (q.y - p.y))};
            const uint32_t cell = sl_space_locate(&w->space, at);
            if (!stands_free(w, at, cell)) continue;
            assert_false(crosses_wall(w, view->eye, at));
            see(w, cell);
        }
    }
}

static void look(world *w, const sl_view *view) {
    look_exactly(w, view);
    look_at_region(w, view);
}

typedef struct tally {
    long seen, drawn, frames, propagated, skipped, opened, bounded;
    long tests[MOST_WALKS]; ///< by method
} tally;

/// The leaves' states and the cells to be drawn say the same.
static void check_leaves(const world *w, const sl_walk *walk) {
    const uint64_t *cells = sl_walk_cells(walk);
    for (uint32_t i = 0; i < w->hierarchy.node_count; i++) {
        const sl_walk_node *n = &w->hierarchy.nodes[i];
        sl_walk_reason reason;
        if (n->cell == SL_NO_CELL) continue;
        const bool drawn = sl_walk_state(walk, i, &reason) != SL_NODE_INVISIBLE;
        assert_int_equal(drawn, sl_eye_sees(cells, n->cell));
    }
}

/// Beside the classical method: every leaf as there, or no leaf less. In a kd-tree's space, where
/// children make up their parent, all nodes are as there.
static void check_beside_classical(const world *w, size_t i, bool cheap) {
    const bool exact = w->hierarchy.tiles && !cheap;
    for (uint32_t n = 0; n < w->hierarchy.node_count; n++) {
        sl_walk_reason reason;
        const sl_node_state due = sl_walk_state(w->walks[0], n, &reason);
        const sl_node_state found = sl_walk_state(w->walks[i], n, &reason);
        if (!exact && w->hierarchy.nodes[n].cell == SL_NO_CELL) continue;
        const sl_walk_agreement agreement = w->methods[i]->agreement;
        const bool less = !found && due;
        if (agreement == SL_WALK_AS_CLASSICAL ? found != due
                                              : agreement == SL_WALK_MAYBE_MORE && less)
            fail_msg("%s: node %u is in state %d, classical: %d (by reason %d)",
                     w->methods[i]->name, n, found, due, reason);
    }
}

static void step(world *w, const sl_view *view, tally *count) {
    look(w, view);
    for (size_t i = 0; i < w->walk_count; i++) {
        sl_walk_frame frame;
        assert_ok(w->context, sl_walk_step(w->context, w->walks[i], view, &frame));
        const uint64_t *cells = sl_walk_cells(w->walks[i]);
        for (uint32_t c = 0; c < w->space.cell_count; c++) {
            const bool seen = sl_eye_sees(w->seen, c), drawn = sl_eye_sees(cells, c);
            if (seen && !drawn)
                fail_msg("%s misses cell %u from %.17g %.17g", w->methods[i]->name, c, view->eye.x,
                         view->eye.y);
            count->seen += seen;
            count->drawn += drawn;
        }
        check_leaves(w, w->walks[i]);
        check_beside_classical(w, i, w->cheap);
        assert_int_equal(frame.out + frame.invisible + frame.partial + frame.visible,
                         frame.visited);
        count->tests[w->methods[i] - sl_walk_methods(&(size_t){0})] += frame.tests;
        count->propagated += frame.propagated;
        count->skipped += frame.skipped;
        count->opened += frame.opened;
        count->bounded += frame.bounded;
        // All tests give one answer: walks of a method with one and another are the same.
        if (i && w->methods[i] == w->methods[i - 1])
            for (uint32_t n = 0; n < w->hierarchy.node_count; n++) {
                sl_walk_reason reason;
                assert_int_equal(sl_walk_state(w->walks[i], n, &reason),
                                 sl_walk_state(w->walks[i - 1], n, &reason));
            }
    }
    count->frames++;
}

/// Walks about: short steps with jumps between, cones of all widths, eyes on walls, splits, corners
/// and far away.
static void walk_about(world *w, uint64_t seed, int steps, tally *count) {
    sl_random random = {seed};
    const sl_box b = w->space.bounds;
    const double size = fmax(b.max.x - b.min.x, b.max.y - b.min.y);
    static const double widths[] = {360, 60, 90, 180, 270, 10, 350, 0.01};
    sl_point eye = {(b.min.x + b.max.x) / 2, (b.min.y + b.max.y) / 2};
    double heading = 30, width = 360;
    for (int i = 0; i < steps; i++) {
        if (i % 10 == 0) {
            const uint64_t kind = sl_random_below(&random, 4);
            const uint32_t v = (uint32_t)sl_random_below(&random, w->space.vertex_count);
            eye.x = b.min.x + sl_random_unit(&random) * (b.max.x - b.min.x);
            eye.y = b.min.y + sl_random_unit(&random) * (b.max.y - b.min.y);
            if (kind < 2) eye.x = w->space.vertices[v].x;
            if (kind == 0) eye.y = w->space.vertices[v].y;
            width = widths[sl_random_below(&random, sizeof widths / sizeof *widths)];
        }
        heading += (sl_random_unit(&random) - 0.5) * 10;
        const double step_length = i % 10 == 0 ? 0 : size / 100;
        eye.x += step_length * cos(heading / 57.3);
        eye.y += step_length * sin(heading / 57.3);
        const sl_view view =
            sl_view_cone(eye, i % 3 ? heading : 90 * floor(heading / 90), width, size);
        step(w, &view, count);
    }
}

static void kd_world(sl_context *context, uint64_t seed, const sl_walk_options *like, int steps,
                     tally *count) {
    world w = {.context = context};
    assert_ok(context, oracle_random_map(context, seed, (oracle_grid)(seed % 3), &w.map));
    assert_ok(context, sl_map_clean(context, &w.map, NULL, NULL));
    const sl_subdivide_options options = sl_subdivide_options_default();
    if (w.map.wall_count && sli_subdivide_kd(context, &w.map, &options, &w.space) == SL_OK) {
        open_world(&w, like);
        walk_about(&w, seed, steps, count);
    }
    close_world(&w);
}

static void random_walks_miss_nothing(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    tally count = {0};
    for (uint64_t seed = 1; seed <= 120; seed++) {
        sl_walk_options options = sl_walk_options_default();
        options.occluders = seed % 5 ? (uint32_t)(seed % 5 * 4) : SL_WALK_OCCLUDERS_MOST;
        options.cheap = seed % 4 == 3 ? 2 : 0;
        kd_world(context, seed, &options, 60, &count);
    }
    // Not by drawing all: no more than a few times what is seen.
    assert_true(count.frames > 5000 && count.seen > 20000);
    assert_true(count.drawn < 3 * count.seen);
    assert_true(count.propagated > 100 && count.skipped > 1000 && count.opened > 10000);
    assert_true(count.bounded > 1000);
    // In the table's order each method up to "skipping" saves more tests.
    assert_true(count.tests[1] < count.tests[0] && count.tests[2] < count.tests[1]);
    assert_true(count.tests[3] < count.tests[2]);
    sl_context_destroy(context);
}

typedef struct bound_tally {
    long hidden, seen, whole, turned;
} bound_tally;

/// With all walls for occluders, what a bound decides is what a test gives. Where the cone turns, a
/// wall may come into it unlooked at: what is seen may then be more, what is hidden is hidden. The
/// boxes of a mesh are more than their children, by whose states they may be hidden: leaves alone.
static void check_bounds(const world *w, const sl_walk *bounded, const sl_walk *tested, bool turns,
                         bound_tally *count) {
    for (uint32_t n = 0; n < w->hierarchy.node_count; n++) {
        sl_walk_reason reason, ignored;
        const sl_node_state found = sl_walk_state(bounded, n, &reason);
        const bool leaf = w->hierarchy.nodes[n].cell != SL_NO_CELL;
        if (reason != SL_WALK_BOUNDED || !(leaf || w->hierarchy.tiles)) continue;
        const sl_node_state due = sl_walk_state(tested, n, &ignored);
        const bool in_part = leaf && found == SL_NODE_PARTIAL && due == SL_NODE_VISIBLE;
        const bool may_be_more = turns && found > due;
        if (found != due && !in_part && !may_be_more)
            fail_msg("node %u is in state %d by a bound, %d by a test", n, found, due);
        count->hidden += found == SL_NODE_INVISIBLE;
        count->seen += found == SL_NODE_PARTIAL;
        count->whole += found == SL_NODE_VISIBLE;
        count->turned += turns;
    }
}

/// Short steps of an eye in line with no wall, all round and with a cone that turns.
static void walk_by_bounds(world *w, uint64_t seed, bool turns, bound_tally *count) {
    size_t method_count;
    const sl_walk_method *methods = sl_walk_methods(&method_count);
    sl_walk_options options = sl_walk_options_default();
    options.occluders = SL_WALK_OCCLUDERS_MOST;
    sl_walk *tested = NULL, *bounded = NULL;
    assert_ok(w->context,
              sl_walk_create(w->context, &w->hierarchy, &methods[0], &options, &tested));
    for (size_t m = 0; m < method_count; m++)
        if (strcmp(methods[m].name, "bounded") == 0)
            assert_ok(w->context,
                      sl_walk_create(w->context, &w->hierarchy, &methods[m], &options, &bounded));
    assert_non_null(bounded);
    sl_random random = {seed};
    const sl_box b = w->space.bounds;
    const double size = fmax(b.max.x - b.min.x, b.max.y - b.min.y);
    sl_point eye = b.min;
    for (int i = 0; i < 200; i++) {
        if (i % 40 == 0)
            eye = (sl_point){b.min.x + sl_random_unit(&random) * (b.max.x - b.min.x),
                             b.min.y + sl_random_unit(&random) * (b.max.y - b.min.y)};
        eye.x += (sl_random_unit(&random) - 0.4) * size / 200;
        eye.y += (sl_random_unit(&random) - 0.4) * size / 200;
        const sl_view view = sl_view_cone(eye, 5 * i, turns ? 100 : 360, size);
        sl_walk_frame frame;
        assert_ok(w->context, sl_walk_step(w->context, tested, &view, &frame));
        assert_ok(w->context, sl_walk_step(w->context, bounded, &view, &frame));
        check_bounds(w, bounded, tested, turns, count);
    }
    sl_walk_destroy(w->context, tested);
    sl_walk_destroy(w->context, bounded);
}

static void mesh_world(sl_context *context, const sl_walk_options *like, world *w) {
    assert_ok(context, sl_map_clean(context, &w->map, NULL, NULL));
    assert_ok(context, sli_subdivide_mesh(context, &w->map, &w->space));
    assert_ok(context, sl_space_check(context, &w->space));
    open_world(w, like);
}

/// Oblique walls: a generated map.
static void generated_world(sl_context *context, const char *name, double turned,
                            const sl_walk_options *like, world *w) {
    sl_generate_options how = sl_generate_options_default();
    how.walls = 300;
    how.turned = turned;
    size_t kinds_count;
    const sl_map_kind *kinds = sl_map_kinds(&kinds_count);
    for (size_t i = 0; i < kinds_count; i++)
        if (strcmp(kinds[i].name, name) == 0)
            assert_ok(context, sl_generate(context, &kinds[i], &how, &w->map));
    assert_true(w->map.wall_count > 0);
    mesh_world(context, like, w);
}

static sl_point turn(sl_point p) {
    const double angle = 17.3 * 0.017453292519943295;
    return (sl_point){p.x * cos(angle) - p.y * sin(angle), p.x * sin(angle) + p.y * cos(angle)};
}

/// Random walls: oblique, or axial ones turned in doubles, so that what was in line is so but for
/// rounding.
static void random_mesh(sl_context *context, uint64_t seed, const sl_walk_options *like, world *w) {
    if (seed % 2) {
        assert_ok(context,
                  oblique_random_map(context, seed, (oblique_grid)(seed / 2 % OBLIQUE_GRIDS), 20,
                                     &w->map));
    } else {
        assert_ok(context, oracle_random_map(context, seed, (oracle_grid)(seed / 2 % 3), &w->map));
        for (size_t i = 0; i < w->map.wall_count; i++) {
            w->map.walls[i].a = turn(w->map.walls[i].a);
            w->map.walls[i].b = turn(w->map.walls[i].b);
        }
    }
    assert_ok(context, sl_map_clean(context, &w->map, NULL, NULL));
    if (w->map.wall_count) mesh_world(context, like, w);
}

static void kd_bounds(sl_context *context, uint64_t seed, bound_tally *count) {
    world w = {.context = context};
    assert_ok(context, oracle_random_map(context, seed, (oracle_grid)(seed % 3), &w.map));
    assert_ok(context, sl_map_clean(context, &w.map, NULL, NULL));
    const sl_subdivide_options options = sl_subdivide_options_default();
    if (w.map.wall_count && sli_subdivide_kd(context, &w.map, &options, &w.space) == SL_OK) {
        assert_ok(context, sl_hierarchy_make(context, &w.space, &w.hierarchy));
        walk_by_bounds(&w, seed, false, count);
        walk_by_bounds(&w, seed, true, count);
    }
    close_world(&w);
}

static void mesh_bounds(sl_context *context, uint64_t seed, bound_tally *count) {
    world w = {.context = context};
    const sl_walk_options like = sl_walk_options_default();
    random_mesh(context, seed, &like, &w);
    if (w.walk_count) {
        walk_by_bounds(&w, seed, false, count);
        walk_by_bounds(&w, seed, true, count);
    }
    close_world(&w);
}

static void bounds_decide_as_tests_do(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    for (int mesh = 0; mesh < 2; mesh++) {
        bound_tally count = {0};
        for (uint64_t seed = 1; seed <= 60; seed++)
            (mesh ? mesh_bounds : kd_bounds)(context, seed, &count);
        assert_true(count.hidden > 1000 && count.seen > 1000);
        assert_true(count.whole > 1000 && count.turned > 1000);
    }
    sl_context_destroy(context);
}

static void oblique_walks_miss_nothing(void **state) {
    (void)state;
    static const char *const names[] = {"tunnels", "pillars", "city"};
    sl_context *context = testing_context(NULL);
    tally count = {0};
    for (int i = 0; i < 3; i++) {
        world w = {.context = context};
        const sl_walk_options like = sl_walk_options_default();
        generated_world(context, names[i], 17, &like, &w);
        walk_about(&w, 1, 200, &count);
        close_world(&w);
    }
    assert_true(count.drawn < 3 * count.seen);
    sl_context_destroy(context);
}

static void walks_on_random_meshes_miss_nothing(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    tally count = {0};
    for (uint64_t seed = 1; seed <= testing_seeds(120); seed++) {
        world w = {.context = context};
        sl_walk_options like = sl_walk_options_default();
        like.occluders = seed % 5 ? (uint32_t)(seed % 5 * 4) : SL_WALK_OCCLUDERS_MOST;
        like.cheap = seed % 4 == 3 ? 2 : 0;
        random_mesh(context, seed, &like, &w);
        if (w.walk_count) walk_about(&w, seed, 60, &count);
        close_world(&w);
    }
    assert_true(count.drawn < 2 * count.seen && count.frames > 40 * (long)testing_seeds(120));
    sl_context_destroy(context);
}

/// With all walls for occluders the classical method draws just what exact culling finds, of eyes
/// that are in line with nothing.
static void all_occluders_hide_all_that_is_hidden(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_walk_options like = sl_walk_options_default();
    like.occluders = SL_WALK_OCCLUDERS_MOST;
    long frames = 0;
    for (uint64_t seed = 1; seed <= testing_seeds(60); seed++) {
        world w = {.context = context};
        random_mesh(context, seed, &like, &w);
        sl_random random = {seed};
        const sl_box b = w.space.bounds;
        for (int i = 0; i < 40 && w.walk_count; i++) {
            const sl_point eye = {b.min.x + sl_random_unit(&random) * (b.max.x - b.min.x),
                                  b.min.y + sl_random_unit(&random) * (b.max.y - b.min.y)};
            const sl_view view = sl_view_cone(eye, 11 * i, i % 2 ? 360 : 75, b.max.x - b.min.x);
            sl_walk_frame frame;
            if (!look_exactly(&w, &view)) continue;
            assert_ok(context, sl_walk_step(context, w.walks[0], &view, &frame));
            assert_memory_equal(sl_walk_cells(w.walks[0]), w.seen,
                                sl_eye_words(&w.space) * sizeof *w.seen);
            frames++;
        }
        close_world(&w);
    }
    assert_true(frames > 20 * (long)testing_seeds(60));
    sl_context_destroy(context);
}

/// The faces that ropes lead to hold the whole face, and no less node beyond does.
static void ropes_hold_faces(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    long ropes = 0;
    for (uint64_t seed = 1; seed <= 60; seed++) {
        world w = {.context = context};
        assert_ok(context, oracle_random_map(context, seed, ORACLE_GRID_INTEGER, &w.map));
        assert_ok(context, sl_map_clean(context, &w.map, NULL, NULL));
        const sl_subdivide_options options = sl_subdivide_options_default();
        if (w.map.wall_count && sli_subdivide_kd(context, &w.map, &options, &w.space) == SL_OK)
            assert_ok(context, sl_hierarchy_make(context, &w.space, &w.hierarchy));
        for (uint32_t i = 0; i < w.hierarchy.node_count; i++)
            for (int face = 0; face < 4; face++) {
                const sl_box *b = &w.hierarchy.nodes[i].box, *all = &w.space.bounds;
                const double at[4] = {b->min.x, b->max.x, b->min.y, b->max.y};
                const double edge[4] = {all->min.x, all->max.x, all->min.y, all->max.y};
                int32_t least = -1;
                for (uint32_t k = 0; k < w.hierarchy.node_count; k++) {
                    const sl_box *o = &w.hierarchy.nodes[k].box;
                    const double touch[4] = {o->max.x, o->min.x, o->max.y, o->min.y};
                    const bool holds = face < 2 ? o->min.y <= b->min.y && b->max.y <= o->max.y
                                                : o->min.x <= b->min.x && b->max.x <= o->max.x;
                    if (touch[face] == at[face] && holds) least = (int32_t)k;
                }
                // Nodes stand before those below them: the last that holds the face is the least.
                assert_int_equal(w.hierarchy.nodes[i].rope[face], least);
                assert_int_equal(least < 0, at[face] == edge[face]);
                ropes += least >= 0;
            }
        close_world(&w);
    }
    assert_true(ropes > 1000);
    sl_context_destroy(context);
}

static void square_room(sl_context *context, world *w) {
    testing_space(context, "walls 0 0 8 0 8 8 0 8 0 0\nwall 4 0 4 3\nwall 4 5 4 8\n", &w->map,
                  &w->space);
}

static void bad_arguments_are_refused(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    world w = {.context = context};
    square_room(context, &w);
    assert_ok(context, sl_hierarchy_make(context, &w.space, &w.hierarchy));
    const sl_walk_method *method = sl_walk_methods(&(size_t){0});
    const sl_walk_options good = sl_walk_options_default();
    sl_walk_options bad[5] = {good, good, good, good, good};
    bad[0].test = NULL;
    bad[1].occluders = SL_WALK_OCCLUDERS_MOST + 1;
    bad[2].p_vp = 1.5;
    bad[3].p_skip = -0.1;
    bad[4].p_skip = NAN;
    sl_walk *walk = NULL;
    for (int i = 0; i < 5; i++) {
        assert_int_equal(sl_walk_create(context, &w.hierarchy, method, &bad[i], &walk),
                         SL_BAD_ARGUMENT);
        assert_null(walk);
    }
    assert_ok(context, sl_walk_create(context, &w.hierarchy, method, &good, &walk));
    const sl_view nowhere = sl_view_all_round((sl_point){NAN, 0});
    const sl_view edge = {.eye = {1, 1}, .left = {1, 1}, .right = {2, 1}};
    sl_walk_frame frame = {.visited = 77};
    assert_int_equal(sl_walk_step(context, walk, &nowhere, &frame), SL_BAD_ARGUMENT);
    assert_int_equal(sl_walk_step(context, walk, &edge, &frame), SL_BAD_ARGUMENT);
    assert_int_equal(frame.visited, 77);
    // A cone of no width sees nothing.
    const sl_view ray = {.eye = {1, 1}, .left = {2, 1}, .right = {3, 1}};
    assert_ok(context, sl_walk_step(context, walk, &ray, &frame));
    assert_int_equal(frame.cells, 0);
    sl_walk_destroy(context, walk);
    close_world(&w);
    sl_context_destroy(context);
}

/// Every allocation fails once; what comes of it is a status, and no memory lost.
static void memory_runs_out(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    world w = {.context = context};
    square_room(context, &w);
    size_t tests_count;
    const sl_node_test *tests = sl_node_tests(&tests_count);
    const long live = memory.live;
    for (size_t t = 0; t < tests_count; t++)
        for (long fail_at = 1;; fail_at++) {
            sl_walk_options options = sl_walk_options_default();
            options.test = &tests[t];
            sl_walk *walk = NULL;
            sl_walk_frame frame;
            const sl_view view = sl_view_all_round((sl_point){1, 1});
            memory.calls = 0;
            memory.fail_at = fail_at;
            sl_status status = sl_hierarchy_make(context, &w.space, &w.hierarchy);
            if (status == SL_OK)
                status = sl_walk_create(context, &w.hierarchy, sl_walk_methods(&(size_t){0}),
                                        &options, &walk);
            if (status == SL_OK) status = sl_walk_step(context, walk, &view, &frame);
            memory.fail_at = 0;
            sl_walk_destroy(context, walk);
            sl_hierarchy_destroy(context, &w.hierarchy);
            assert_int_equal(memory.live, live);
            if (status == SL_OK) break;
            assert_int_equal(status, SL_NO_MEMORY);
            assert_true(fail_at < 1000);
        }
    close_world(&w);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_walks_miss_nothing),
        cmocka_unit_test(oblique_walks_miss_nothing),
        cmocka_unit_test(walks_on_random_meshes_miss_nothing),
        cmocka_unit_test(all_occluders_hide_all_that_is_hidden),
        cmocka_unit_test(bounds_decide_as_tests_do),
        cmocka_unit_test(ropes_hold_faces),
        cmocka_unit_test(bad_arguments_are_refused),
        cmocka_unit_test(memory_runs_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

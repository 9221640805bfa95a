/// Boxes that move among oblique walls, on random maps, on axial ones that are turned, and on one
/// that was once a fault.
///
/// The space with boxes in it is held against what is promised of its walls: those of the map and
/// the sides of boxes, some of them bent by steps of doubles where they cross. What is seen in it is
/// held against brute force in integers. And where walls as they are and walls as bent agree on what
/// is free or hidden between two points, by rationals, so must the space.
/// SIGHTLINE_SEEDS in the environment: how many maps (150 by default).
#include "testing.h"

#include "oracle/blockers.h"
#include "oracle/eye.h"
#include "oracle/random_map.h"
#include "oracle/random_oblique.h"

#include <math.h>

enum { BOXES = 4, EYES = 4, POINTS = 40, WALLS = 9, CELLS_MOST = 2048, ORACLE_CELLS = 48 };

/// Segments, and the answers about them.
typedef struct segments {
    sl_segment items[CELLS_MOST];
    size_t count;
    blockers *blockers;
} segments;

typedef struct trial {
    sl_context *context;
    uint64_t seed;
    sl_random random;
    sl_map map;
    sl_space space;
    sl_visibility baked;
    sl_moving_box boxes[BOXES];
    size_t count;
    sl_moving *moving;
    segments straight; ///< the map's walls, and the sides of boxes that block
    segments bent;     ///< the same as the space with boxes has them
    double size;
    double step;   ///< of doubles, at the largest coordinate
    bool coarse;   ///< places are steps of doubles apart: only the space is checked
    size_t free, hidden, cells_seen, cells_asked, marginal, boxes_seen, boxes_asked;
    size_t bends, exact_seen, exact_asked;
} trial;

static uint64_t below(trial *t, uint64_t bound) {
    return sl_random_below(&t->random, bound);
}

// --- the map with boxes

static double random_coordinate(trial *t, oblique_grid grid, bool vertical) {
    const sl_wall *w = &t->map.walls[below(t, t->map.wall_count)];
    const sl_point end = below(t, 2) ? w->a : w->b;
    if (below(t, 3) == 0) return vertical ? end.y : end.x;
    return oblique_coordinate(&t->random, grid);
}

static sl_box random_box(trial *t, oblique_grid grid) {
    const double x0 = random_coordinate(t, grid, false), y0 = random_coordinate(t, grid, true);
    double x1 = random_coordinate(t, grid, false), y1 = random_coordinate(t, grid, true);
    const uint64_t flat = below(t, 12);
    if (flat == 0) x1 = x0;
    if (flat == 1) y1 = y0;
    return (sl_box){{fmin(x0, x1), fmin(y0, y1)}, {fmax(x0, x1), fmax(y0, y1)}};
}

static sl_segment random_segment(trial *t, oblique_grid grid) {
    return (sl_segment){{random_coordinate(t, grid, false), random_coordinate(t, grid, true)},
                        {random_coordinate(t, grid, false), random_coordinate(t, grid, true)}};
}

static void corners_of(sl_box box, sl_point c[4]) {
    c[0] = box.min;
    c[1] = (sl_point){box.max.x, box.min.y};
    c[2] = box.max;
    c[3] = (sl_point){box.min.x, box.max.y};
}

static void gather_segments(trial *t) {
    t->segment_count = 0;
    for (size_t i = 0; i < t->map.wall_count; i++)
        t->segments[t->segment_count++] = (sl_segment){t->map.walls[i].a, t->map.walls[i].b};
    for (size_t i = 0; i < t->count; i++) {
        sl_point c[4];
        corners_of(t->boxes[i].box, c);
        for (int k = 0; k < 4 && t->boxes[i].blocks; k++)
            t->segments[t->segment_count++] = (sl_segment){c[k], c[(k + 1) % 4]};
    }
}

// --- what is said, and what is so

static void complain(const trial *t, sl_point eye, sl_point p, const char *what, size_t number) {
    for (size_t i = 0; i < t->map.wall_count; i++) {
        const sl_wall *w = &t->map.walls[i];
        print_error("wall %.17g %.17g %.17g %.17g\n", w->a.x, w->a.y, w->b.x, w->b.y);
    }
    for (size_t i = 0; i < t->count; i++) {
        const sl_box b = t->boxes[i].box;
        print_error("box %.17g %.17g %.17g %.17g%s\n", b.min.x, b.min.y, b.max.x, b.max.y,
                    t->boxes[i].blocks ? " block" : "");
    }
    fail_msg("\nseed %llu: eye %.17g,%.17g point %.17g,%.17g: %s %zu", (unsigned long long)t->seed,
             eye.x, eye.y, p.x, p.y, what, number);
}

static double cross(sl_point a, sl_point b, sl_point c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// How far a point is from a segment's line, and on which side. 0 for a segment of no length.
static double off(sl_segment s, sl_point p) {
    const double length = hypot(s.b.x - s.a.x, s.b.y - s.a.y);
    return length > 0 ? cross(s.a, s.b, p) / length : 0;
}

/// Whether one of the segments stands between two points, by much more than rounding.
static bool is_hidden(const trial *t, sl_point p, sl_point q) {
    const double slack = 1e-7 * t->size;
    for (size_t i = 0; i < t->segment_count; i++) {
        const sl_segment s = t->segments[i], way = {p, q};
        const double sp = off(s, p), sq = off(s, q), wa = off(way, s.a), wb = off(way, s.b);
        if ((sp < 0) != (sq < 0) && (wa < 0) != (wb < 0) && fmin(fabs(sp), fabs(sq)) > slack &&
            fmin(fabs(wa), fabs(wb)) > slack)
            return true;
    }
    return false;
}

/// 1 for a point in a region, -1 for one out of it, 0 where that is within rounding.
static int side_of_region(const trial *t, const sl_region *region, sl_point p) {
    const double slack = 1e-7 * t->size;
    int winding = 0;
    for (size_t i = 0; i < region->count; i++) {
        const sl_point a = region->points[i], b = region->points[(i + 1) % region->count];
        const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
        double at = square > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / square : 0;
        at = fmin(fmax(at, 0), 1);
        if (hypot(a.x + at * dx - p.x, a.y + at * dy - p.y) < slack) return 0;
        if (a.y <= p.y && b.y > p.y && cross(a, b, p) > 0) winding++;
        if (a.y > p.y && b.y <= p.y && cross(a, b, p) < 0) winding--;
    }
    return winding ? 1 : -1;
}

/// The area that a region shares with a convex polygon.
static double shared_area(const sl_region *region, const sl_point *corners, size_t count) {
    const sl_point eye = region->view.eye;
    double sum = 0;
    for (size_t i = 0; i < region->count; i++) {
        sl_point in[40] = {eye, region->points[i], region->points[(i + 1) % region->count]},
                 out[40];
        size_t n = 3;
        for (size_t k = 0; k < count && n; k++) {
            const sl_point p = corners[k], q = corners[(k + 1) % count];
            size_t kept = 0;
            for (size_t j = 0; j < n; j++) {
                const sl_point a = in[j], b = in[(j + 1) % n];
                const double at_a = cross(p, q, a), at_b = cross(p, q, b);
                if (at_a >= 0) out[kept++] = a;
                if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0)) {
                    const double s = at_a / (at_a - at_b);
                    out[kept++] = (sl_point){a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)};
                }
                assert_true(kept < 38);
            }
            n = kept;
            memcpy(in, out, n * sizeof *in);
        }
        for (size_t j = 1; j + 1 < n; j++) sum += cross(in[0], in[j], in[j + 1]) / 2;
    }
    return fabs(sum);
}

/// Whether a point is in a cell, and away from its border by much more than rounding.
static bool is_deep_in(const trial *t, uint32_t number, sl_point p) {
    if (number == SL_NO_CELL) return false;
    const sl_cell *cell = &t->space.cells[number];
    const sl_point *v = t->space.vertices + cell->first_vertex;
    for (uint32_t i = 0; i < cell->vertex_count; i++)
        if (off((sl_segment){v[i], v[(i + 1) % cell->vertex_count]}, p) < 1e-7 * t->size)
            return false;
    return true;
}

/// A point that the segments leave free is seen, so are its cell and the boxes on the way; one that
/// they hide is out of the region.
static void judge_point(trial *t, sl_point eye, sl_point p, const sl_outline *outline,
                        const sl_region *region, const uint64_t *cells, const bool *seen) {
    const uint32_t *parents;
    const sl_space *boxed = sl_moving_space(t->moving, &parents);
    const uint32_t cell = sl_space_locate(boxed, p);
    bool sees = false;
    if (cell == SL_NO_CELL) return;
    if (!blockers_free(t->walls, (sl_segment){eye, p})) {
        const bool hidden = is_hidden(t, eye, p);
        if (hidden && side_of_region(t, region, p) > 0) complain(t, eye, p, "in the region", 0);
        t->hidden += hidden;
        return;
    }
    assert_ok(t->context, sl_sees(t->context, outline, eye, p, SL_CLOSED, &sees));
    if (!sees) complain(t, eye, p, "not seen in cell", cell);
    if (!sl_eye_sees(cells, parents[cell])) complain(t, eye, p, "hidden cell", parents[cell]);
    const uint32_t ground = sl_space_locate(&t->space, p);
    if (is_deep_in(t, ground, p) && !sl_eye_sees(cells, ground))
        complain(t, eye, p, "hidden cell", ground);
    if (side_of_region(t, region, p) < 0) complain(t, eye, p, "out of the region", 0);
    for (size_t i = 0; i < t->count; i++) {
        sl_point c[4];
        corners_of(t->boxes[i].box, c);
        for (int k = 0; k < 4; k++)
            if (blockers_turn(eye, p, c[k]) * blockers_turn(eye, p, c[(k + 1) % 4]) < 0 &&
                blockers_turn(c[k], c[(k + 1) % 4], eye) * blockers_turn(c[k], c[(k + 1) % 4], p) <
                    0 &&
                !seen[i])
                complain(t, eye, p, "hidden box", i);
    }
    t->free++;
}

/// Cells that are said to be seen share an area with the region, those that are not share none.
static void judge_cells(trial *t, sl_point eye, const sl_region *region, const uint64_t *cells) {
    for (uint32_t c = 0; c < t->space.cell_count; c++) {
        const sl_cell *cell = &t->space.cells[c];
        const double area =
            shared_area(region, t->space.vertices + cell->first_vertex, cell->vertex_count) /
            (t->size * t->size);
        const bool said = sl_eye_sees(cells, c);
        if (!said && area > 1e-9) complain(t, eye, eye, "hidden cell", c);
        t->marginal += said && area < 1e-13;
        t->cells_seen += said;
        t->cells_asked++;
    }
}

/// Whether a side of a box may lie on the border or on that of another one that blocks: there it is
/// seen where sight ends, and the box is not entered.
static bool shares_a_line(const trial *t, size_t number) {
    const sl_box a = t->boxes[number].box, all = t->space.bounds;
    if (a.min.x >= all.max.x || a.min.y >= all.max.y || a.max.x <= all.min.x ||
        a.max.y <= all.min.y)
        return true;
    for (size_t i = 0; i < t->count; i++) {
        const sl_box b = t->boxes[i].box;
        if (i != number && t->boxes[i].blocks &&
            (a.min.x == b.min.x || a.min.x == b.max.x || a.max.x == b.min.x || a.max.x == b.max.x ||
             a.min.y == b.min.y || a.min.y == b.max.y || a.max.y == b.min.y || a.max.y == b.max.y))
            return true;
    }
    return false;
}

/// A box that blocks is seen where it would be entered if it did not.
static void judge_boxes(trial *t, const sl_view *view, const bool *seen) {
    sl_moving_box boxes[BOXES];
    sl_region region = {0};
    const sl_outline *outline;
    for (size_t i = 0; i < t->count; i++) {
        const sl_box box = t->boxes[i].box;
        sl_point c[4];
        if (box.min.x == box.max.x || box.min.y == box.max.y) continue;
        memcpy(boxes, t->boxes, sizeof boxes);
        boxes[i].blocks = false;
        assert_ok(t->context, sl_moving_place(t->context, t->moving, boxes, t->count));
        assert_ok(t->context, sl_moving_outline(t->context, t->moving, &outline));
        assert_ok(t->context, sl_region_make(t->context, outline, view, 0, &region));
        corners_of(box, c);
        const double area = shared_area(&region, c, 4) / (t->size * t->size);
        if (!seen[i] && area > 1e-9) complain(t, view->eye, view->eye, "hidden box", i);
        const bool holds = box.min.x <= view->eye.x && view->eye.x <= box.max.x &&
                           box.min.y <= view->eye.y && view->eye.y <= box.max.y;
        t->marginal += seen[i] && !holds && area < 1e-13 && !shares_a_line(t, i);
        t->boxes_seen += seen[i];
        t->boxes_asked++;
    }
    sl_region_destroy(t->context, &region);
}

/// Whether an eye is clear of all segments, so that what it sees is a matter of them alone.
static bool is_clear(const trial *t, sl_point eye) {
    for (size_t i = 0; i < t->segment_count; i++)
        if (fabs(off(t->segments[i], eye)) < 1e-6 * t->size) return false;
    return true;
}

static void try_eye(trial *t) {
    uint64_t cells[64];
    bool seen[BOXES];
    sl_eye_account account;
    const sl_outline *outline;
    sl_region region = {0};
    const sl_point eye = oblique_random_point(&t->random, &t->map, t->space.bounds);
    const sl_view view = sl_view_all_round(eye);
    assert_true(sl_eye_words(&t->space) <= 64);
    if (sl_space_locate(&t->space, eye) == SL_NO_CELL) return;
    assert_ok(t->context, sl_moving_place(t->context, t->moving, t->boxes, t->count));
    assert_ok(t->context, sl_space_check(t->context, sl_moving_space(t->moving, NULL)));
    assert_ok(t->context, sl_moving_look(t->context, t->moving, &view, cells, seen, &account));
    assert_ok(t->context, sl_moving_outline(t->context, t->moving, &outline));
    assert_ok(t->context, sl_region_make(t->context, outline, &view, 0, &region));
    gather_segments(t);
    t->walls = blockers_create(t->segments, t->segment_count);
    for (int i = 0; i < POINTS && !t->coarse; i++)
        judge_point(t, eye, oblique_random_point(&t->random, &t->map, t->space.bounds), outline,
                    &region, cells, seen);
    blockers_destroy(t->walls);
    if (!t->coarse && is_clear(t, eye)) {
        judge_cells(t, eye, &region, cells);
        judge_boxes(t, &view, seen);
    }
    sl_region_destroy(t->context, &region);
}

// --- random maps

static void bake(trial *t, sl_sight sight) {
    size_t count;
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    options.threads = 1;
    options.sight = sight;
    t->baked = (sl_visibility){.sight = sight};
    if (t->seed % 2)
        assert_ok(t->context,
                  sl_see_methods(&count)->see(t->context, &t->space, &options, &t->baked));
}

static void try_map(trial *t, sl_sight sight) {
    const oblique_grid grid = (oblique_grid)(t->seed % OBLIQUE_GRIDS);
    assert_ok(t->context, oblique_random_map(t->context, t->seed, grid, WALLS, &t->map));
    t->random = (sl_random){t->seed ^ 0xb0e5};
    for (uint64_t i = below(t, 3); i > 0; i--)
        assert_ok(t->context, sl_map_add_seam(t->context, &t->map, random_segment(t, grid), 0));
    assert_ok(t->context, sl_subdivide_mesh(t->context, &t->map, &t->space));
    const sl_box b = t->space.bounds;
    t->size = fmax(b.max.x - b.min.x, b.max.y - b.min.y);
    t->coarse = grid >= OBLIQUE_SCALES;
    bake(t, sight);
    assert_ok(t->context, sl_moving_create(t->context, &t->space, &t->baked, &t->moving));
    for (int i = 0; i < EYES; i++) {
        t->count = 1 + below(t, BOXES);
        for (size_t k = 0; k < t->count; k++)
            t->boxes[k] = (sl_moving_box){random_box(t, grid), below(t, 3) > 0};
        try_eye(t);
    }
    sl_moving_destroy(t->context, t->moving);
    sl_visibility_destroy(t->context, &t->baked);
    sl_space_destroy(t->context, &t->space);
    sl_map_destroy(t->context, &t->map);
}

static void random_maps(sl_sight sight) {
    const uint64_t seeds = testing_seeds(150);
    trial t = {.context = testing_context(NULL)};
    for (t.seed = 1; t.seed <= seeds; t.seed++) try_map(&t, sight);
    print_message("%zu points free, %zu hidden; %zu of %zu cells, %zu of %zu boxes seen; %zu by "
                  "next to nothing\n",
                  t.free, t.hidden, t.cells_seen, t.cells_asked, t.boxes_seen, t.boxes_asked,
                  t.marginal);
    assert_true(t.free > seeds && t.hidden > seeds);
    assert_true(t.cells_seen > 0 && t.cells_seen < t.cells_asked);
    assert_true(t.boxes_seen > 0 && t.boxes_seen < t.boxes_asked);
    if (sight == SL_OPEN) assert_true(500 * t.marginal < t.cells_seen + t.boxes_seen);
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

// --- by hand

typedef struct room {
    sl_context *context;
    sl_map map;
    sl_space space;
    sl_visibility bare;
    sl_moving *moving;
} room;

/// A square of 8 with a wall askew and a seam that goes on from it.
static void enter(room *r, testing_memory *memory) {
    *r = (room){.context = testing_context(memory), .bare = {.sight = SL_CLOSED}};
    const sl_point c[5] = {{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}};
    for (int i = 0; i < 4; i++)
        assert_ok(r->context, sl_map_add_wall(r->context, &r->map, c[i], c[i + 1], 0));
    assert_ok(r->context,
              sl_map_add_wall(r->context, &r->map, (sl_point){0, 0}, (sl_point){4, 4}, 0));
    assert_ok(r->context, sl_map_add_seam(r->context, &r->map, (sl_segment){{4, 4}, {8, 8}}, 0));
    assert_ok(r->context, sl_subdivide_mesh(r->context, &r->map, &r->space));
}

static void leave(room *r) {
    sl_moving_destroy(r->context, r->moving);
    sl_space_destroy(r->context, &r->space);
    sl_map_destroy(r->context, &r->map);
    sl_context_destroy(r->context);
}

static void cells_keep_their_numbers(void **state) {
    (void)state;
    room r;
    enter(&r, NULL);
    const uint32_t *parents;
    const sl_moving_box boxes[] = {{{{1, 2}, {3, 5}}, true}};
    assert_ok(r.context, sl_moving_create(r.context, &r.space, &r.bare, &r.moving));
    assert_ok(r.context, sl_moving_place(r.context, r.moving, boxes, 1));
    const sl_space *boxed = sl_moving_space(r.moving, &parents);
    assert_true(boxed->cell_count > r.space.cell_count);
    for (uint32_t i = 0; i < r.space.cell_count; i++) assert_int_equal(parents[i], i);
    for (double x = 0.25; x < 8; x += 0.5)
        for (double y = 0.125; y < 8; y += 0.5)
            assert_int_equal(parents[sl_space_locate(boxed, (sl_point){x, y})],
                             sl_space_locate(&r.space, (sl_point){x, y}));
    leave(&r);
}

static void no_memory(void **state) {
    (void)state;
    testing_memory memory = {0};
    room r;
    enter(&r, &memory);
    const sl_moving_box boxes[] = {{{{1, 2}, {5, 6}}, true}, {{{3, 2}, {4, 7}}, false}};
    const long before = memory.live;
    sl_status status = SL_NO_MEMORY;
    for (long fail = 1; status != SL_OK; fail++) {
        sl_moving *moving = NULL;
        memory.calls = 0;
        memory.fail_at = fail;
        status = sl_moving_create(r.context, &r.space, &r.bare, &moving);
        if (status == SL_OK) status = sl_moving_place(r.context, moving, boxes, 2);
        assert_true(status == SL_OK || status == SL_NO_MEMORY);
        memory.fail_at = 0;
        sl_moving_destroy(r.context, moving);
        assert_int_equal(memory.live, before);
    }
    leave(&r);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cells_keep_their_numbers),
        cmocka_unit_test(no_memory),
        cmocka_unit_test(closed_sight),
        cmocka_unit_test(open_sight),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

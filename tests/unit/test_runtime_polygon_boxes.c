// The runtime's visible polygon past boxes, in scenes with boxes that touch walls, each other and
// the eye: against the library's region, and against a brute-force sweep in rationals over a map
// that has the boxes' sides as walls.
#include "box_scene.h"
#include "oracle/isovist.h"
#include "polygon_same.h"
#include "runtime_maps.h"

enum { ROOM = 1 << 10, PAIRS = 1 << 12, VIEWS = 24 };

typedef struct trial {
    scene s;
    baked_file f;
    sl_runtime_box list[BOXES];
    sl_runtime_boxes boxes;
    uint32_t *memory, *scratch;
    sl_region region;
    double range;
    size_t asked, hidden, at_border, cut;
} trial;

/// The scene's map, baked and opened, with the boxes put into it.
static void open_scene(trial *t) {
    scene *s = &t->s;
    t->f = (baked_file){.name = "scene", .baked = {.method = "dfs", .solver = "funnel"}};
    assert_ok(s->context, sl_map_copy(s->context, &s->map, &t->f.baked.map));
    baked_file_make(s->context, &t->f, false);
    const sl_runtime *r = &t->f.runtime;
    const uint32_t count = (uint32_t)s->box_count;
    t->memory = malloc(sl_runtime_boxes_count(r, count, PAIRS) * sizeof *t->memory);
    assert_non_null(t->memory);
    sl_runtime_boxes_start(&t->boxes, r, t->list, count, PAIRS, t->memory);
    t->scratch = malloc(sl_runtime_boxes_scratch_count(&t->boxes) * sizeof *t->scratch);
    assert_non_null(t->scratch);
    for (uint32_t i = 0; i < count; i++) {
        const sl_box b = s->boxes[i].box;
        const sl_runtime_box box = {b.min.x, b.min.y, b.max.x, b.max.y, s->boxes[i].blocks};
        assert_true(sl_runtime_boxes_move(&t->boxes, i, &box));
    }
}

static void close_scene(trial *t) {
    free(t->scratch);
    free(t->memory);
    baked_file_destroy(t->s.context, &t->f);
}

static void fail_at(const trial *t, const sl_view *view, const char *what, double found,
                    double expected) {
    for (size_t i = 0; i < t->s.box_count; i++)
        fprintf(stderr, "box %.17g %.17g %.17g %.17g, blocks %d\n", t->s.boxes[i].box.min.x,
                t->s.boxes[i].box.min.y, t->s.boxes[i].box.max.x, t->s.boxes[i].box.max.y,
                t->s.boxes[i].blocks);
    fail_msg("seed %llu: %s %.17g, not %.17g; eye %.17g %.17g, full %d, right %.17g %.17g, left "
             "%.17g %.17g, range %g",
             (unsigned long long)t->s.seed, what, found, expected, view->eye.x, view->eye.y,
             view->full, view->right.x, view->right.y, view->left.x, view->left.y, t->range);
}

/// Points about the eye, counter-clockwise.
static void check_order(const trial *t, const sl_view *view, const sl_point *p, uint32_t count,
                        double error) {
    for (uint32_t i = 0; i < count; i++) {
        const sl_point a = p[i], b = p[(i + 1) % count], eye = view->eye;
        const double turn = (a.x - eye.x) * (b.y - eye.y) - (a.y - eye.y) * (b.x - eye.x);
        if (turn < -4 * error * (hypot(a.x - eye.x, a.y - eye.y) + hypot(b.x - eye.x, b.y - eye.y)))
            fail_at(t, view, "turn", turn, 0);
    }
}

/// Axial walls: sight and eyes as the sweep has them. (Boxes as walls widen the bounds of a map
/// that is all in one line.)
static void check_area(trial *t, const sl_view *view, double area) {
    if (memcmp(&t->s.space.bounds, &t->s.other.bounds, sizeof(sl_box)) != 0) return;
    const oracle_isovist expected = oracle_isovist_of(&t->s.other, view);
    const double size = t->s.space.bounds.max.x - t->s.space.bounds.min.x;
    if (fabs(area - expected.area) > 1e-12 * (expected.area + size * size))
        fail_at(t, view, "area by the sweep", area, expected.area);
}

static void compare(trial *t, const sl_view *view) {
    static sl_point points[ROOM], few[ROOM];
    const sl_region *is = &t->region;
    const sl_point eye = view->eye;
    const sl_runtime_view same = {eye.x,
                                  eye.y,
                                  view->full,
                                  {view->right.x - eye.x, view->right.y - eye.y},
                                  {view->left.x - eye.x, view->left.y - eye.y}};
    const uint32_t count = sl_runtime_visible_polygon_past_boxes(&t->boxes, &same, NULL, t->range,
                                                                 t->scratch, &points[0].x, ROOM);
    assert_true(count <= ROOM);
    const double error = polygon_error(&t->s.space.bounds);
    const double size = t->s.space.bounds.max.x - t->s.space.bounds.min.x;
    const double area = polygon_area(eye, points, count);
    t->asked++;
    check_order(t, view, points, count, error);
    if (!(t->range > 0) && !t->s.space.neighbour) check_area(t, view, area);
    assert_ok(t->s.context, sl_query_set_range(t->s.context, t->s.query, t->range));
    assert_ok(t->s.context, sl_query_region(t->s.context, t->s.query, view, &t->region));
    const double expected = sl_region_area(is);
    const bool on_box = is_on_box(&t->s, eye);
    t->at_border += on_box;
    if (on_box && t->s.space.neighbour) return; // the library may take another side
    // Chords leave out a share of the circle.
    const double chords = 4.1e-4 * 3.15 * t->range * t->range;
    if (area > expected + 32 * error * size || area < expected - chords - 32 * error * size)
        fail_at(t, view, "area", area, expected);
    t->cut += t->range > 0;
    if (count < 3 || is->count < 3 || t->range > 0) return;
    // Where walls at the eye are seen edge-on, the library has their ends too.
    const double off = polygon_farthest(points, count, is->points, is->count);
    if (off > 8 * error) fail_at(t, view, "a point is off by", off, 0);
    for (size_t i = 0; i < is->count; i++) t->hidden += is->edges[i].wall - SL_BOX_WALL < 4 * BOXES;
    const uint32_t room = count / 2;
    few[room] = (sl_point){-1, -2};
    assert_int_equal(sl_runtime_visible_polygon_past_boxes(&t->boxes, &same, NULL, 0, t->scratch,
                                                           &few[0].x, room),
                     count);
    assert_memory_equal(few, points, room * sizeof *few);
    assert_true(few[room].x == -1 && few[room].y == -2);
}

/// Whether the differences from the eye to a cone's border are exact: the header takes these.
static bool is_exact(double eye, double to) {
    const double by = to - eye;
    return eye + by == to && to - by == eye;
}

/// Eyes anywhere, on corners of boxes and on their sides.
static sl_point next_eye(trial *t, int i, bool turned) {
    scene *s = &t->s;
    const sl_point p = any_eye(s, turned);
    const sl_box b = s->boxes[sl_random_below(&s->random, s->box_count)].box;
    const sl_point corner = {i & 1 ? b.min.x : b.max.x, i & 2 ? b.min.y : b.max.y};
    if (i % 3 == 0) return corner;
    return i % 3 == 1 ? (sl_point){corner.x, p.y} : p;
}

static void look(trial *t, bool turned) {
    scene *s = &t->s;
    const double size = s->space.bounds.max.x - s->space.bounds.min.x;
    for (int i = 0; i < VIEWS; i++) {
        const sl_view view = any_view(s, next_eye(t, i, turned));
        if (is_outside(s, view.eye)) continue;
        if (!view.full &&
            !(is_exact(view.eye.x, view.right.x) && is_exact(view.eye.y, view.right.y) &&
              is_exact(view.eye.x, view.left.x) && is_exact(view.eye.y, view.left.y)))
            continue;
        t->range = i % 8 == 7 ? size * ldexp(sl_random_unit(&s->random), -(i / 8)) : 0;
        compare(t, &view);
    }
}

static void look_in_scenes(trial *t, uint64_t count, bool turned, double move) {
    static const double angles[] = {17.3, 33, 45, 0.001};
    t->s.context = testing_context(NULL);
    const uint64_t seeds = testing_seeds(count);
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        if (make_scene(&t->s, seed, turned ? angles[seed % 4] : 0, move)) {
            open_scene(t);
            look(t, turned);
            close_scene(t);
        }
        destroy_scene(&t->s);
    }
    sl_region_destroy(t->s.context, &t->region);
    sl_context_destroy(t->s.context);
    print_message("%zu views, %zu from borders of boxes, %zu cut, %zu sides of boxes\n", t->asked,
                  t->at_border, t->cut, t->hidden);
}

static void as_the_library_and_the_sweep_say(void **state) {
    (void)state;
    static trial t;
    look_in_scenes(&t, 120, false, 0);
    assert_true(t.hidden > t.asked / 2 && t.at_border > t.asked / 20 && t.cut > t.asked / 20);
}

static void among_turned_walls(void **state) {
    (void)state;
    static trial t;
    look_in_scenes(&t, 100, true, 0);
    assert_true(t.hidden > t.asked / 2);
}

static void far_from_the_origin(void **state) {
    (void)state;
    static trial t;
    look_in_scenes(&t, 30, true, 1e6);
}

/// Crowds: some in a corner of the room, some all over it, overlapping or as thin as walls.
static sl_box box_of_crowd(sl_random *random, uint64_t kind) {
    const sl_point at = {64 * sl_random_unit(random), 64 * sl_random_unit(random)};
    const double wide = kind % 2 ? 16 : 1, high = kind % 3 ? wide : 0;
    const sl_point min = kind % 5 ? at : (sl_point){floor(at.x), floor(at.y)};
    return (sl_box){min, {min.x + wide * sl_random_unit(random), min.y + high}};
}

static void past_crowds(void **state) {
    (void)state;
    enum { CROWD = 256 };
    static sl_moving_box crowd[CROWD];
    static sl_runtime_box list[CROWD];
    static sl_point points[ROOM];
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, "wall 0 0 64 0\nwall 64 0 64 64\nwall 64 64 0 64\n"
                                               "wall 0 64 0 0\nwall 32 0 32 20\n");
    sl_random random = {31};
    sl_region region = {0};
    for (uint64_t kind = 0; kind < 30; kind++) {
        const uint32_t count = 1 + (uint32_t)sl_random_below(&random, CROWD);
        sl_runtime_boxes boxes;
        sl_query *query;
        uint32_t *memory = malloc(sl_runtime_boxes_count(&f.runtime, count, PAIRS) * 4);
        sl_runtime_boxes_start(&boxes, &f.runtime, list, count, PAIRS, memory);
        uint32_t *scratch = malloc(sl_runtime_boxes_scratch_count(&boxes) * 4);
        for (uint32_t i = 0; i < count; i++) {
            const sl_box b = box_of_crowd(&random, kind);
            const sl_runtime_box box = {b.min.x, b.min.y, b.max.x, b.max.y, true};
            crowd[i] = (sl_moving_box){b, true};
            assert_true(sl_runtime_boxes_move(&boxes, i, &box));
        }
        assert_ok(context, sl_query_over(context, &f.baked.space, &f.baked.map, NULL, &query));
        assert_ok(context, sl_query_set_boxes(context, query, crowd, count));
        for (int i = 0; i < 8; i++) {
            const sl_view view = sl_view_all_round(
                (sl_point){64 * sl_random_unit(&random), 64 * sl_random_unit(&random)});
            const sl_runtime_view same = sl_runtime_view_all_round(view.eye.x, view.eye.y);
            const uint32_t found = sl_runtime_visible_polygon_past_boxes(
                &boxes, &same, NULL, 0, scratch, &points[0].x, ROOM);
            assert_ok(context, sl_query_region(context, query, &view, &region));
            assert_true(found >= 3 && found <= ROOM);
            const double area = polygon_area(view.eye, points, found);
            if (fabs(area - sl_region_area(&region)) > 1e-9)
                fail_msg("crowd %d, eye %.17g %.17g: area %.17g, not %.17g", (int)kind, view.eye.x,
                         view.eye.y, area, sl_region_area(&region));
            assert_true(polygon_farthest(points, found, region.points, region.count) < 1e-10);
        }
        sl_query_destroy(context, query);
        free(scratch);
        free(memory);
    }
    sl_region_destroy(context, &region);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(as_the_library_and_the_sweep_say),
        cmocka_unit_test(among_turned_walls),
        cmocka_unit_test(far_from_the_origin),
        cmocka_unit_test(past_crowds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

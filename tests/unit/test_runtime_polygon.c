// The runtime's visible polygon against the library's visible region: on every map, on turned maps,
// and past shut doors and one-way glass against a space with walls there.
//   test_runtime_polygon [EYES]    so many eyes instead of ten thousand
#include "effects/filtered.h"
#include "polygon_same.h"
#include "runtime_maps.h"
#include "sight/region.h"
#include "space/outline.h"

#include "sightline/support.h"

#include <math.h>

enum { ROOM = 1 << 13 };

static uint64_t eyes = 10000;

typedef struct trial {
    sl_context *context;
    const baked_file *f;
    sl_outline outline;
    sl_region region;
    uint32_t *scratch;
    const unsigned char *shut;
    double range; ///< that is asked for; 0: the map's own
    sl_random random;
    size_t asked, seen, exact, arcs;
} trial;

static trial trial_of(sl_context *context, const baked_file *f, const sl_space *space) {
    trial t = {.context = context, .f = f, .random = {23}};
    assert_ok(context, sli_outline_make(context, space, &t.outline));
    t.scratch = malloc(sl_runtime_scratch_count(&f->runtime) * sizeof *t.scratch);
    assert_non_null(t.scratch);
    return t;
}

static void trial_end(trial *t) {
    free(t->scratch);
    sl_region_destroy(t->context, &t->region);
    sli_outline_destroy(t->context, &t->outline);
}

static bool has(const sl_point *points, size_t count, sl_point at) {
    for (size_t i = 0; i < count; i++)
        if (points[i].x == at.x && points[i].y == at.y) return true;
    return false;
}

/// Drops needles: if a shut door at the eye crosses a wall, the region has the door's far end too.
static size_t without_needles(const trial *t, sl_point *points, bool *exact) {
    const sl_region *region = &t->region;
    size_t count = 0;
    for (size_t i = 0; i < region->count; i++) {
        const sl_point a = region->points[(i + region->count - 1) % region->count],
                       at = region->points[i], b = region->points[(i + 1) % region->count];
        const sl_point u = {a.x - at.x, a.y - at.y}, v = {b.x - at.x, b.y - at.y};
        if (t->shut && u.x * v.y == u.y * v.x && u.x * v.x + u.y * v.y > 0) continue;
        exact[count] = region->edges[i].exact;
        points[count++] = at;
    }
    return count;
}

/// The corners of the map that the region has, but those in one line with their neighbours, are
/// corners of the polygon to the last bit.
static void has_corners(trial *t, const sl_point *is, const bool *exact, size_t is_count,
                        const sl_point *points, size_t count) {
    for (size_t i = 0; i < is_count; i++) {
        const sl_point a = is[(i + is_count - 1) % is_count], b = is[(i + 1) % is_count];
        if (!exact[i] || polygon_distance(is[i], a, b) < 1e-9 * hypot(b.x - a.x, b.y - a.y))
            continue;
        t->exact++;
        if (!has(points, count, is[i]))
            fail_msg("%s: (%.17g, %.17g) does not have the corner (%.17g, %.17g)", t->f->name,
                     t->region.view.eye.x, t->region.view.eye.y, is[i].x, is[i].y);
    }
}

// --- with a range

static double turned(sl_point a, sl_point b) {
    return a.x * b.y - a.y * b.x;
}

static bool is_arc(const sl_region *region, size_t i) {
    return region->edges[i % region->count].kind == SL_EDGE_ARC;
}

/// Whether the region has an arc in a direction, ends included but for rounding.
static bool has_arc(const sl_region *region, sl_point u) {
    const double slack = 1e-9 * region->range * hypot(u.x, u.y);
    for (size_t i = 0; i < region->count; i++) {
        const sl_point a = region->offsets[i], b = region->offsets[(i + 1) % region->count];
        if (is_arc(region, i) && turned(a, u) >= -slack && turned(u, b) >= -slack &&
            a.x * u.x + a.y * u.y + b.x * u.x + b.y * u.y >= -slack)
            return true;
    }
    return false;
}

/// How far a point is from the outline of a region.
static double off_region(const sl_region *region, sl_point at) {
    const sl_point u = {at.x - region->view.eye.x, at.y - region->view.eye.y};
    double least = has_arc(region, u) ? fabs(hypot(u.x, u.y) - region->range) : INFINITY;
    for (size_t i = 0; i < region->count; i++)
        if (!is_arc(region, i))
            least = fmin(least, polygon_distance(at, region->points[i],
                                                 region->points[(i + 1) % region->count]));
    return least;
}

/// What chords leave out of the circle.
static double left_out(const sl_region *region, const sl_point *points, size_t count,
                       double error) {
    const double range = region->range;
    const sl_point eye = region->view.eye;
    double area = 0;
    for (size_t i = 0; i < count; i++) {
        const sl_point p = points[i], q = points[(i + 1) % count];
        const sl_point a = {p.x - eye.x, p.y - eye.y}, b = {q.x - eye.x, q.y - eye.y};
        const double angle = atan2(turned(a, b), a.x * b.x + a.y * b.y);
        if (fabs(hypot(a.x, a.y) - range) > 8 * error || fabs(hypot(b.x, b.y) - range) > 8 * error)
            continue;
        // A wall may be a chord as well.
        double least = INFINITY;
        const sl_point middle = {(p.x + q.x) / 2, (p.y + q.y) / 2};
        for (size_t k = 0; k < region->count; k++)
            if (!is_arc(region, k))
                least = fmin(least, polygon_distance(middle, region->points[k],
                                                     region->points[(k + 1) % region->count]));
        if (least <= 8 * error) continue;
        if (angle > 6.2832 / 128 + 1e-9 + 8 * error / range)
            fail_msg("(%.17g, %.17g), range %.17g: a chord of %g from (%.17g, %.17g)", eye.x, eye.y,
                     range, angle, p.x, p.y);
        area += range * range / 2 * (angle - sin(angle));
    }
    return area;
}

/// The polygon has the region's corners, but for those between two arcs; its points are on the
/// region's outline; its chords are short; and all that it leaves out is left out by chords.
static void compare_cut(trial *t, const sl_point *points, size_t count, double error) {
    const sl_region *is = &t->region;
    const sl_point eye = is->view.eye;
    const double range = is->range, loose = 1e3 * error + 1e-7 * range;
    // Where a wall all but touches the circle, its crossing has half the digits.
    for (size_t i = 0; i < count; i++)
        if (off_region(is, points[i]) > loose)
            fail_msg("%s: (%.17g, %.17g), range %.17g: point (%.17g, %.17g) is off by %g",
                     t->f->name, eye.x, eye.y, range, points[i].x, points[i].y,
                     off_region(is, points[i]));
    for (size_t i = 0; i < is->count; i++) {
        const bool between_arcs = is_arc(is, i) && is_arc(is, i + is->count - 1);
        const double off = polygon_farthest(&is->points[i], 1, points, count);
        t->arcs += is_arc(is, i);
        if (off > loose + (between_arcs ? range / 3000 : 0))
            fail_msg("%s: (%.17g, %.17g), range %.17g: the corner (%.17g, %.17g) is off by %g",
                     t->f->name, eye.x, eye.y, range, is->points[i].x, is->points[i].y, off);
    }
    const double said = polygon_area(eye, points, count) + left_out(is, points, count, error);
    const double area = sl_region_area(is);
    if (fabs(said - area) > 1e-9 * range * range + 8 * error * range)
        fail_msg("%s: (%.17g, %.17g), range %.17g: area %.17g for %.17g", t->f->name, eye.x, eye.y,
                 range, said, area);
}

/// The smaller one of the range that is asked for and the map's own.
static double ranges_meet(const trial *t) {
    const double own = t->f->baked.map.range;
    return own > 0 && t->range > 0 ? fmin(own, t->range) : fmax(own, t->range);
}

static void compare(trial *t, const sl_view *view) {
    static sl_point points[ROOM], few[ROOM], needless[ROOM];
    static bool exact[ROOM];
    const sl_runtime *r = &t->f->runtime;
    const sl_point eye = view->eye;
    // Directions may have any length but a very small one.
    const double up = r->max_x - r->min_x < 1 ? 0x1p300 : 1;
    const sl_runtime_view same = {eye.x,
                                  eye.y,
                                  view->full,
                                  {up * (view->right.x - eye.x), up * (view->right.y - eye.y)},
                                  {up * (view->left.x - eye.x), up * (view->left.y - eye.y)}};
    const uint32_t count =
        sl_runtime_visible_polygon(r, &same, t->shut, t->range, t->scratch, &points[0].x, ROOM);
    assert_true(count <= ROOM);
    assert_ok(t->context,
              sli_region_make(t->context, &t->outline, view, ranges_meet(t), &t->region));
    const sl_region *is = &t->region;
    t->asked++;
    const double size = fmax(r->max_x - r->min_x, r->max_y - r->min_y);
    const double area = sl_region_area(is), error = polygon_error(&t->f->baked.space.bounds);
    // Two points may be half a circle or all of it.
    if (count == 0 || is->count < 2 || (is->count < 3 && !is_arc(is, 0) && !is_arc(is, 1))) {
        if (count || fabs(area) > error * size)
            fail_msg("%s: (%.17g, %.17g)%s from (%g, %g) to (%g, %g): %u points for %zu",
                     t->f->name, eye.x, eye.y, view->full ? "" : " with a cone", same.right[0],
                     same.right[1], same.left[0], same.left[1], count, is->count);
        return;
    }
    t->seen++;
    assert_true(is->count <= ROOM);
    if (is->range > 0) {
        compare_cut(t, points, count, error);
        return;
    }
    const double said = polygon_area(eye, points, count);
    const size_t is_count = without_needles(t, needless, exact);
    const double off = polygon_farthest(points, count, needless, is_count);
    const double missed = polygon_farthest(needless, is_count, points, count);
    if (!(fabs(said - area) <= 8 * error * size && off <= 4 * error && missed <= 4 * error))
        fail_msg("%s: (%.17g, %.17g)%s from (%g, %g) to (%g, %g): area %.17g for %.17g, off by "
                 "%g and %g of %g",
                 t->f->name, eye.x, eye.y, view->full ? "" : " with a cone", same.right[0],
                 same.right[1], same.left[0], same.left[1], said, area, off, missed, size);
    has_corners(t, needless, exact, is_count, points, count);
    if (t->asked % 16) return;
    // The same number for any room, and no more written than there is room for.
    const uint32_t room = (uint32_t)sl_random_below(&t->random, count);
    few[room] = (sl_point){-1, -2};
    assert_int_equal(
        sl_runtime_visible_polygon(r, &same, t->shut, t->range, t->scratch, &few[0].x, room),
        count);
    assert_memory_equal(few, points, room * sizeof *few);
    assert_true(few[room].x == -1 && few[room].y == -2);
    assert_int_equal(sl_runtime_visible_polygon(r, &same, t->shut, t->range, t->scratch, NULL, 0),
                     count);
}

static void look_from(trial *t, sl_point eye) {
    const sl_runtime *r = &t->f->runtime;
    const double reach = fmin(r->max_x - r->min_x, r->max_y - r->min_y);
    if (sl_runtime_locate(r, eye.x, eye.y) == SL_RUNTIME_NO_CELL) return;
    sl_view view = sl_view_all_round(eye);
    compare(t, &view);
    for (int i = 0; i < 2; i++) {
        view = (sl_view){eye, false, runtime_border(&t->random, eye, reach),
                         runtime_border(&t->random, eye, reach)};
        if (!testing_same_point(view.right, eye) && !testing_same_point(view.left, eye))
            compare(t, &view);
    }
}

/// Eyes within cells, on walls, on portals, on corners.
static void look_from_many(trial *t, const sl_space *s, uint64_t count) {
    for (uint64_t i = 0; i < count; i += 5) {
        const sl_point v = s->vertices[sl_random_below(&t->random, s->vertex_count)];
        const sl_point w = s->vertices[sl_random_below(&t->random, s->vertex_count)];
        const sl_box *b = &s->bounds;
        look_from(t, (sl_point){b->min.x + sl_random_unit(&t->random) * (b->max.x - b->min.x),
                                b->min.y + sl_random_unit(&t->random) * (b->max.y - b->min.y)});
        look_from(t, runtime_between(v, w, sl_random_unit(&t->random)));
        look_from(t, v);
        look_from(t, (sl_point){v.x, w.y});
        if (!s->portal_count) continue;
        const sl_portal *p = &s->portals[sl_random_below(&t->random, s->portal_count)];
        look_from(t,
                  runtime_between(p->left, p->right, sl_random_below(&t->random, 2) ? 0.5 : 0.25));
    }
}

/// Looks past shut doors and dark glass, and in a space with walls there.
static void look_past(sl_context *context, const baked_file *f, const unsigned char *shut,
                      sl_point eye, uint64_t seed) {
    bool is_shut[64] = {false};
    sl_space walled = {0};
    for (uint32_t i = 0; i < f->runtime.door_count; i++) is_shut[i] = shut[i];
    const sli_filtered_space filtered = {.shut = is_shut, .eye = &eye};
    assert_ok(context, sli_filtered_space_make(context, &f->baked.space, &filtered, NULL, &walled));
    trial t = trial_of(context, f, &walled);
    t.shut = shut;
    t.random = (sl_random){seed};
    look_from(&t, eye);
    trial_end(&t);
    sl_space_destroy(context, &walled);
}

static void look_past_glass(sl_context *context, const baked_file *f) {
    static const unsigned char open[64];
    const sl_box *b = &f->baked.space.bounds;
    sl_random random = {29};
    assert_true(f->runtime.door_count <= 64);
    for (uint64_t i = 0; i < eyes / 100 + 1; i++)
        look_past(context, f, open,
                  (sl_point){b->min.x + sl_random_unit(&random) * (b->max.x - b->min.x),
                             b->min.y + sl_random_unit(&random) * (b->max.y - b->min.y)},
                  i);
}

static size_t asked, corners, arcs;

static void polygons_are_the_same(const baked_file *f) {
    sl_context *context = testing_context(NULL);
    if (f->baked.map.oneway_count) {
        look_past_glass(context, f);
        sl_context_destroy(context);
        return;
    }
    trial t = trial_of(context, f, &f->baked.space);
    look_from_many(&t, &f->baked.space, eyes / 50 + 1);
    const sl_box *b = &f->baked.space.bounds;
    const double size = fmax(b->max.x - b->min.x, b->max.y - b->min.y);
    // Far from the origin, circles are too coarse to compare.
    for (int i = 0; i < 8 && polygon_error(b) < 1e-9 * size; i++) {
        t.range = size * (i % 2 ? 0.125 * i : ldexp(sl_random_unit(&t.random), -i));
        look_from_many(&t, &f->baked.space, eyes / 200 + 1);
    }
    arcs += t.arcs;
    asked += t.asked;
    corners += t.exact;
    trial_end(&t);
    sl_context_destroy(context);
}

static void on_every_map(void **state) {
    (void)state;
    baked_file_each(polygons_are_the_same);
    print_message("%zu views, %zu corners, %zu arcs\n", asked, corners, arcs);
    assert_true(arcs > 100);
}

static void on_turned_maps(void **state) {
    (void)state;
    static const char *const names[] = {"office", "gallery", "oblique/chapel", "oblique/rotunda",
                                        "oblique/star"};
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < 10; i++) {
        baked_file f = baked_file_turned(context, names[i / 2], i % 2 ? 17.3 : 44.9, i % 2 * 1e4);
        trial t = trial_of(context, &f, &f.baked.space);
        look_from_many(&t, &f.baked.space, eyes / 20 + 1);
        t.range = 12.5;
        look_from_many(&t, &f.baked.space, eyes / 50 + 1);
        trial_end(&t);
        baked_file_destroy(context, &f);
    }
    sl_context_destroy(context);
}

// --- doors and glass

enum { SIZE = 12, MAPS = 40, DOORS = 6 };

static void past_doors_and_glass(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    for (uint64_t seed = 1; seed <= MAPS; seed++) {
        sl_random random = {seed};
        baked_file f = {.name = "random", .baked = {.method = "dfs", .solver = "funnel"}};
        grid_rooms(context, &random, SIZE, 10, DOORS, &f.baked.map);
        for (int i = 0; i < DOORS && seed % 2; i++)
            assert_ok(context,
                      sl_map_add_oneway(context, &f.baked.map, grid_segment(&random, SIZE), 0));
        assert_ok(context, sl_map_clean(context, &f.baked.map, NULL, NULL));
        baked_file_make(context, &f, false);
        for (uint64_t i = 0; i < eyes / 200 + 1; i++) {
            unsigned char shut[DOORS];
            for (int k = 0; k < DOORS; k++) shut[k] = sl_random_below(&random, 2);
            const sl_point eye = {(double)sl_random_below(&random, 8 * SIZE) / 8,
                                  (double)sl_random_below(&random, 8 * SIZE) / 8};
            look_past(context, &f, shut, eye, seed + i);
        }
        baked_file_destroy(context, &f);
    }
    sl_context_destroy(context);
}

// --- by hand

static void a_room_is_its_corners(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, "walls 0 0 9 0 9 9 0 9 0 0\n");
    uint32_t scratch[16];
    double points[16];
    assert_true(sl_runtime_scratch_count(&f.runtime) <= 16);
    sl_runtime_view view = sl_runtime_view_all_round(3, 4);
    assert_int_equal(sl_runtime_visible_polygon(&f.runtime, &view, NULL, 0, scratch, points, 8), 4);
    assert_int_equal(points[0] + points[2] + points[4] + points[6], 18);
    view = sl_runtime_view_toward(3, 4, 1, 0, 0.5);
    assert_int_equal(sl_runtime_visible_polygon(&f.runtime, &view, NULL, 0, scratch, points, 8), 3);
    const double cone[] = {3, 4, 9, 1, 9, 7};
    assert_memory_equal(points, cone, sizeof cone);
    view = sl_runtime_view_all_round(10, 4);
    assert_int_equal(sl_runtime_visible_polygon(&f.runtime, &view, NULL, 0, scratch, points, 8), 0);
    view = sl_runtime_view_all_round(NAN, 4);
    assert_int_equal(sl_runtime_visible_polygon(&f.runtime, &view, NULL, 0, scratch, points, 8), 0);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

static uint32_t polygon_within(const baked_file *f, double x, double range, double *points,
                               uint32_t room) {
    uint32_t scratch[64];
    const sl_runtime_view view = sl_runtime_view_all_round(x, 5);
    assert_true(sl_runtime_scratch_count(&f->runtime) <= 64);
    return sl_runtime_visible_polygon(&f->runtime, &view, NULL, range, scratch, points, room);
}

/// The circle touches no wall, meets one, or holds the room; the map's own range is the most.
static void a_range_cuts_a_room(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of_text(context, "walls 0 0 20 0 20 10 0 10 0 0\n");
    double p[1024];
    uint32_t count = polygon_within(&f, 8, 2, p, 512);
    assert_true(count >= 128 && count <= 320);
    for (uint32_t i = 0; i < count; i++)
        assert_true(fabs(hypot(p[2 * i] - 8, p[2 * i + 1] - 5) - 2) < 1e-13);
    count = polygon_within(&f, 1, 2, p, 512);
    uint32_t on_wall = 0;
    for (uint32_t i = 0; i < count; i++) on_wall += p[2 * i] == 0;
    assert_int_equal(on_wall, 2);
    assert_true(count >= 64 && count <= 320);
    assert_int_equal(polygon_within(&f, 8, 30, p, 512), 4);
    assert_int_equal(polygon_within(&f, 8, 1e-300, p, 512) > 2, true);
    assert_int_equal(polygon_within(&f, 8, 1e300, p, 512), 4);
    baked_file_destroy(context, &f);
    f = baked_file_of_text(context, "walls 0 0 20 0 20 10 0 10 0 0\nrange 2\n");
    double same[1024];
    count = polygon_within(&f, 8, 0, p, 512);
    assert_true(count >= 128 && count <= 320);
    assert_int_equal(polygon_within(&f, 8, 3, same, 512), count);
    assert_memory_equal(p, same, 2 * count * sizeof *p);
    assert_int_equal(polygon_within(&f, 8, 3, NULL, 0), count);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_room_is_its_corners), cmocka_unit_test(a_range_cuts_a_room),
        cmocka_unit_test(on_every_map),          cmocka_unit_test(on_turned_maps),
        cmocka_unit_test(past_doors_and_glass),
    };
    if (argc == 2) eyes = strtoull(argv[1], NULL, 10);
    return cmocka_run_group_tests(tests, NULL, NULL);
}

// Viewpoints on corners and within walls of random outlines, whose outside is not solid: they stand
// inside. What they see is compared with an oracle that knows the outline alone: in each wedge
// between neighbouring directions to corners, a ray finds the side that is seen. The outlines are
// stars and staircases, as they are, turned, and far from the origin.
#include "testing.h"

#include "sightline/coverage.h"
#include "sightline/place.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { CORNERS_MOST = 40, OUTLINES = 60 };

#define PI 3.14159265358979323846

/// Counter-clockwise.
typedef struct ring {
    sl_point at[CORNERS_MOST];
    size_t count;
} ring;

typedef struct plan {
    sl_context *context;
    sl_map map;
    sl_space space;
    sl_query *query;
    ring outline;
    double area;
} plan;

static sl_point less(sl_point a, sl_point b) {
    return (sl_point){a.x - b.x, a.y - b.y};
}

static double cross(sl_point a, sl_point b) {
    return a.x * b.y - a.y * b.x;
}

static double area_of(const ring *r) {
    double twice = 0;
    for (size_t i = 1; i + 1 < r->count; i++)
        twice += cross(less(r->at[i], r->at[0]), less(r->at[i + 1], r->at[0]));
    return twice / 2;
}

// --- outlines

static ring make_star(sl_random *random) {
    ring r = {.count = 5 + (size_t)sl_random_below(random, 12)};
    for (size_t i = 0; i < r.count; i++) {
        const double angle = 2 * PI * (double)i / (double)r.count;
        const double radius = 2 + 8 * sl_random_unit(random);
        r.at[i] = (sl_point){radius * cos(angle), radius * sin(angle)};
    }
    return r;
}

/// Columns side by side on the line y = 0. No two neighbours are equally high.
static ring make_staircase(sl_random *random) {
    const size_t columns = 3 + (size_t)sl_random_below(random, 8);
    ring r = {.count = 2, .at = {{0, 0}, {(double)columns, 0}}};
    double before = 0;
    for (size_t i = columns; i-- > 0;) {
        double height = before;
        while (height == before) height = 1 + (double)sl_random_below(random, 6);
        r.at[r.count++] = (sl_point){(double)i + 1, height};
        r.at[r.count++] = (sl_point){(double)i, height};
        before = height;
    }
    return r;
}

static void turn(ring *r, double degrees, double offset) {
    const double c = cos(degrees * PI / 180), s = sin(degrees * PI / 180);
    for (size_t i = 0; i < r->count; i++) {
        const sl_point p = r->at[i];
        r->at[i] = (sl_point){offset + c * p.x - s * p.y, offset + s * p.x + c * p.y};
    }
}

static plan begin(sl_context *context, const ring *outline) {
    plan p = {.context = context, .outline = *outline, .area = area_of(outline)};
    char text[CORNERS_MOST * 60] = "walls";
    for (size_t i = 0; i <= outline->count; i++) {
        const sl_point at = outline->at[i % outline->count];
        const size_t used = strlen(text);
        snprintf(text + used, sizeof text - used, " %.17g %.17g", at.x, at.y);
    }
    strcat(text, "\n");
    testing_space(context, text, &p.map, &p.space);
    assert_ok(context, sl_query_over(context, &p.space, &p.map, NULL, &p.query));
    return p;
}

static void end(plan *p) {
    sl_query_destroy(p->context, p->query);
    sl_space_destroy(p->context, &p->space);
    sl_map_destroy(p->context, &p->map);
}

// --- the oracle

/// A wedge of what is seen from an eye: a triangle.
typedef struct wedge {
    sl_point right, left; ///< less the eye
} wedge;

/// The angle from one direction counter-clockwise to another: 0 to 2 pi.
static double angle_between(sl_point from, sl_point to) {
    const double angle = atan2(cross(from, to), from.x * to.x + from.y * to.y);
    return angle < 0 ? angle + 2 * PI : angle;
}

static sl_point turned(sl_point d, double angle) {
    return (sl_point){cos(angle) * d.x - sin(angle) * d.y, sin(angle) * d.x + cos(angle) * d.y};
}

/// How far a ray goes to a line, as a multiple of `way`; all less the eye.
static double meet(sl_point way, sl_point a, sl_point b) {
    return cross(a, less(b, a)) / cross(way, less(b, a));
}

/// What is seen of the inside between two directions: up to the first side on the ray between them.
static wedge look(const ring *r, sl_point eye, const bool *at_eye, sl_point right, sl_point left) {
    const sl_point way = {right.x + left.x, right.y + left.y};
    double least = INFINITY;
    wedge found = {{0, 0}, {0, 0}};
    for (size_t i = 0; i < r->count; i++) {
        const sl_point a = less(r->at[i], eye), b = less(r->at[(i + 1) % r->count], eye);
        if (at_eye[i] || !(cross(way, a) < 0) || !(cross(way, b) > 0)) continue;
        const double far = meet(way, a, b);
        if (!(far > 0 && far < least)) continue;
        const double to_right = meet(right, a, b), to_left = meet(left, a, b);
        least = far;
        found =
            (wedge){{to_right * right.x, to_right * right.y}, {to_left * left.x, to_left * left.y}};
    }
    assert_true(least < INFINITY);
    return found;
}

/// The wedges that are seen from a point of side `side` that is not its end; returns their number.
static size_t oracle_look(const ring *r, sl_point eye, size_t side, wedge *out) {
    const size_t n = r->count;
    const bool corner = testing_same_point(eye, r->at[side]);
    const sl_point next = less(r->at[(side + 1) % n], eye);
    const sl_point before = less(r->at[corner ? (side + n - 1) % n : side], eye);
    const double whole = angle_between(next, before);
    double angles[CORNERS_MOST + 4] = {0, whole};
    bool at_eye[CORNERS_MOST] = {false};
    size_t count = 2, found = 0;
    at_eye[side] = true;
    if (corner) at_eye[(side + n - 1) % n] = true;
    for (size_t i = 0; i < n; i++) {
        const double angle = angle_between(next, less(r->at[i], eye));
        if (!testing_same_point(r->at[i], eye) && angle < whole) angles[count++] = angle;
    }
    // The middle of two directions must be between them.
    for (double at = 1; at < whole; at++) angles[count++] = at;
    qsort(angles, count, sizeof *angles, sl_compare_numbers);
    const double length = hypot(next.x, next.y);
    const sl_point unit = {next.x / length, next.y / length};
    for (size_t i = 0; i + 1 < count; i++)
        if (angles[i + 1] - angles[i] > 1e-10)
            out[found++] =
                look(r, eye, at_eye, turned(unit, angles[i]), turned(unit, angles[i + 1]));
    return found;
}

// --- what is compared

static void near(const plan *p, sl_point eye, const char *what, double is, double should) {
    if (fabs(is - should) > 1e-7 * p->area)
        fail_msg("%s from (%.17g, %.17g): %.12g, not %.12g", what, eye.x, eye.y, is, should);
}

static void check_pairs(const plan *p, sl_point eye, const wedge *wedges, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const wedge *w = &wedges[i];
        if (cross(w->right, w->left) < 1e-5 * p->area) continue;
        const sl_point at = {eye.x + (w->right.x + w->left.x) / 3,
                             eye.y + (w->right.y + w->left.y) / 3};
        bool there, back;
        assert_ok(p->context, sl_query_sees(p->context, p->query, eye, at, &there));
        assert_ok(p->context, sl_query_sees(p->context, p->query, at, eye, &back));
        if (!there || !back)
            fail_msg("(%.17g, %.17g) does not see (%.17g, %.17g)", eye.x, eye.y, at.x, at.y);
    }
}

static void check_eye(const plan *p, sl_point eye, size_t side) {
    wedge wedges[CORNERS_MOST + 12];
    const size_t count = oracle_look(&p->outline, eye, side, wedges);
    const uint32_t cell = sl_query_locate(p->query, eye);
    const sl_view view = sl_view_all_round(eye);
    const sl_viewpoint viewpoint = {.at = eye, .fov = 360};
    sl_region region = {0};
    sl_coverage coverage;
    double seen = 0;
    for (size_t i = 0; i < count; i++) seen += cross(wedges[i].right, wedges[i].left) / 2;
    assert_true(seen > 0 && cell != SL_NO_CELL);
    assert_true(p->space.cells[cell].inside);
    assert_ok(p->context, sl_query_region(p->context, p->query, &view, &region));
    near(p, eye, "region", sl_region_area(&region), seen);
    assert_ok(p->context, sl_coverage_make(p->context, p->query, &viewpoint, 1, &coverage));
    near(p, eye, "coverage", coverage.seen[0], seen);
    near(p, eye, "blind area", coverage.overlay.areas[0] - coverage.overlay.areas[1],
         p->area - seen);
    check_pairs(p, eye, wedges, count);
    sl_coverage_destroy(p->context, &coverage);
    sl_region_destroy(p->context, &region);
}

static void check_candidates(const plan *p) {
    sl_point *points;
    uint32_t count;
    assert_ok(p->context,
              sl_place_points(p->context, p->query, SL_PLACE_CORNERS, 0, &points, &count));
    assert_int_equal(count, p->outline.count);
    for (size_t i = 0; i < p->outline.count; i++) {
        bool found = false;
        for (uint32_t k = 0; k < count; k++)
            found |= testing_same_point(points[k], p->outline.at[i]);
        assert_true(found);
    }
    sl_free(p->context, points);
}

/// All corners of an outline, and the middles of its sides that are on them as rounded.
static size_t check_outline(sl_context *context, const ring *outline) {
    plan p = begin(context, outline);
    const size_t n = outline->count;
    size_t within = 0;
    for (size_t i = 0; i < n; i++) {
        const sl_point a = outline->at[i], b = outline->at[(i + 1) % n];
        const sl_point middle = {a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2};
        check_eye(&p, a, i);
        if (sl_orient(a, b, middle) != 0) continue;
        check_eye(&p, middle, i);
        within++;
    }
    check_candidates(&p);
    end(&p);
    return within;
}

static void corners_and_walls(void **state) {
    (void)state;
    static const struct { double degrees, offset; } turns[] = {{0, 0}, {17.3, 0}, {17.3, 4096}};
    sl_context *context = testing_context(NULL);
    size_t within = 0;
    for (uint64_t seed = 1; seed <= testing_seeds(OUTLINES); seed++)
        for (size_t i = 0; i < sizeof turns / sizeof *turns; i++) {
            sl_random random = {seed};
            ring outline = seed % 2 ? make_star(&random) : make_staircase(&random);
            turn(&outline, turns[i].degrees, turns[i].offset);
            within += check_outline(context, &outline);
        }
    assert_true(within > OUTLINES);
    sl_context_destroy(context);
}

/// A wall that two rooms share, of which one is inside: who stands on it looks into that one.
static void a_room_that_nobody_enters(void **state) {
    (void)state;
    static const char *const plans[] = {
        "walls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 10\nstart 15 5 0\n",
        "walls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 10\nstart 5 5 0\n",
        "walls 0 0 20 0 20 10 1 10 0 0\nwall 10 0 10 10\nstart 15 5 0\n",
        "walls 0 0 20 0 20 10 1 10 0 0\nwall 10 0 10 10\nstart 5 5 0\n"};
    static const double areas[] = {100, 100, 100, 95};
    for (size_t i = 0; i < sizeof plans / sizeof *plans; i++) {
        plan p = {.context = testing_context(NULL)};
        testing_space(p.context, plans[i], &p.map, &p.space);
        assert_ok(p.context, sl_query_over(p.context, &p.space, &p.map, NULL, &p.query));
        const sl_viewpoint eyes[] = {{.at = {10, 0}, .fov = 360}, {.at = {10, 5}, .fov = 360}};
        for (int k = 0; k < 2; k++) {
            sl_coverage c;
            assert_ok(p.context, sl_coverage_make(p.context, p.query, &eyes[k], 1, &c));
            assert_true(fabs(c.overlay.areas[1] - areas[i]) < 1e-9);
            assert_int_equal(c.blind_count, 0);
            sl_coverage_destroy(p.context, &c);
        }
        sl_context *const context = p.context;
        end(&p);
        sl_context_destroy(context);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(corners_and_walls),
        cmocka_unit_test(a_room_that_nobody_enters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/// Fisk's colouring: each result is checked as a triangulation with a proper colouring, exactly.
#include "testing.h"

#include "sightline/art_gallery.h"

#include <math.h>
#include <string.h>

enum { CORNERS_MOST = 2500 };

typedef struct polygon {
    sl_point points[CORNERS_MOST];
    size_t count;
} polygon;

static sl_status colour(sl_context *context, const polygon *p, sl_fisk *out) {
    const sl_shape shape = {p->points, &p->count, 1};
    return sl_fisk_colour(context, &shape, out);
}

static void add(polygon *p, double x, double y) {
    assert_true(p->count < CORNERS_MOST);
    p->points[p->count++] = (sl_point){x, y};
}

static void turn_by(polygon *p, double degrees) {
    const double angle = degrees * 3.14159265358979323846 / 180;
    for (size_t i = 0; i < p->count; i++) {
        const sl_point at = p->points[i];
        p->points[i] = (sl_point){cos(angle) * at.x - sin(angle) * at.y,
                                  sin(angle) * at.x + cos(angle) * at.y};
    }
}

static void reverse(polygon *p) {
    for (size_t i = 0, j = p->count - 1; i < j; i++, j--) {
        const sl_point kept = p->points[i];
        p->points[i] = p->points[j];
        p->points[j] = kept;
    }
}

/// Each side of the polygon is a side of one triangle, and each cut of two, once in each direction.
/// All triangles turn left. So they tile the polygon: no place is covered twice or left out.
static void check_triangles(const polygon *p, const sl_fisk *f, bool clockwise) {
    const uint32_t n = (uint32_t)p->count;
    signed char *sides = calloc((size_t)n * n, 1);
    assert_non_null(sides);
    assert_int_equal(f->ear_count, n - 2);
    for (uint32_t i = 0; i < f->ear_count; i++) {
        const sl_ear *e = &f->ears[i];
        const uint32_t corners[] = {e->before, e->tip, e->after};
        assert_int_equal(
            sl_orient(p->points[corners[0]], p->points[corners[1]], p->points[corners[2]]), 1);
        for (int k = 0; k < 3; k++) {
            const uint32_t from = corners[k], to = corners[(k + 1) % 3];
            assert_int_equal(sides[(size_t)from * n + to]++, 0);
        }
        assert_int_equal(1 << f->colours[corners[0]] | 1 << f->colours[corners[1]] |
                             1 << f->colours[corners[2]],
                         7);
    }
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < i; j++) {
            const signed char forth = sides[(size_t)j * n + i], back = sides[(size_t)i * n + j];
            const bool next = i == j + 1, around = j == 0 && i == n - 1;
            if (next || around) {
                assert_int_equal(forth, next != clockwise);
                assert_int_equal(back, next == clockwise);
            } else {
                assert_int_equal(forth, back);
            }
        }
    free(sides);
}

static void check_guards(const polygon *p, const sl_fisk *f) {
    uint32_t sizes[3] = {0};
    for (uint32_t i = 0; i < f->corner_count; i++) sizes[f->colours[i]]++;
    assert_memory_equal(sizes, f->sizes, sizeof sizes);
    assert_int_equal(f->guard_count, sizes[f->least]);
    assert_true(f->guard_count <= p->count / 3);
    for (uint32_t i = 0; i < f->guard_count; i++) {
        assert_int_equal(f->colours[f->guards[i]], f->least);
        assert_true(i == 0 || f->guards[i - 1] < f->guards[i]);
    }
}

/// As given, the other way round, turned, and far from the origin.
static void check_polygon(polygon *p) {
    sl_context *context = testing_context(NULL);
    for (int way = 0; way < 4; way++) {
        sl_fisk fisk;
        if (way == 1) turn_by(p, 17.3);
        if (way == 2) reverse(p);
        for (size_t i = 0; i < p->count && way == 3; i++) p->points[i].x += 1048576;
        assert_ok(context, colour(context, p, &fisk));
        check_triangles(p, &fisk, way >= 2);
        check_guards(p, &fisk);
        sl_fisk_destroy(context, &fisk);
    }
    sl_context_destroy(context);
}

// --- polygons

/// Chvátal's comb needs a guard for each tooth: n/3, which Fisk's colouring gives.
static void comb(void **state) {
    (void)state;
    static polygon p;
    sl_context *context = testing_context(NULL);
    for (uint32_t teeth = 1; teeth <= 64; teeth *= 4) {
        sl_fisk fisk;
        p.count = 0;
        for (uint32_t i = 0; i < teeth; i++) {
            add(&p, 4 * i, 0);
            add(&p, 4 * i + 1, 8);
            if (i + 1 < teeth) add(&p, 4 * i + 2, 0);
        }
        add(&p, 4 * teeth, -1);
        reverse(&p);
        assert_ok(context, colour(context, &p, &fisk));
        assert_int_equal(fisk.guard_count, teeth);
        sl_fisk_destroy(context, &fisk);
        check_polygon(&p);
    }
    sl_context_destroy(context);
}

static void stars(void **state) {
    (void)state;
    static polygon p;
    uint64_t random = 7;
    static const uint32_t sizes[] = {3, 4, 5, 6, 7, 20, 100, 500};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        p.count = 0;
        for (uint32_t i = 0; i < sizes[s]; i++) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            const double angle = 6.283185307179586 * i / sizes[s];
            const double far = 10 + (double)(random >> 40) / (1 << 20);
            add(&p, far * cos(angle), far * sin(angle));
        }
        check_polygon(&p);
    }
}

/// A ribbon that winds up, with 2,500 corners.
static void ribbon(void **state) {
    (void)state;
    static polygon p;
    enum { HALF = CORNERS_MOST / 2 };
    p.count = 0;
    for (int i = 0; i < HALF; i++)
        add(&p, (10 + 0.03 * i) * cos(0.05 * i), (10 + 0.03 * i) * sin(0.05 * i));
    for (int i = HALF; i-- > 0;)
        add(&p, (9 + 0.03 * i) * cos(0.05 * i), (9 + 0.03 * i) * sin(0.05 * i));
    check_polygon(&p);
}

/// Many corners on straight lines; one side has none.
static void flat_corners(void **state) {
    (void)state;
    static polygon p;
    for (int sides = 0; sides < 4; sides++) {
        p.count = 0;
        for (int i = 0; i < (sides > 0 ? 20 : 1); i++) add(&p, 10 * i, 0);
        for (int i = 0; i < (sides > 1 ? 20 : 1); i++) add(&p, 200, 10 * i);
        for (int i = 0; i < (sides > 2 ? 20 : 1); i++) add(&p, 200 - 10 * i, 200);
        add(&p, 0, 200);
        sl_context *context = testing_context(NULL);
        sl_fisk fisk;
        assert_ok(context, colour(context, &p, &fisk));
        check_triangles(&p, &fisk, false);
        check_guards(&p, &fisk);
        sl_fisk_destroy(context, &fisk);
        sl_context_destroy(context);
    }
}

// --- what is refused

static void refused(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_fisk fisk = {0};
    static const sl_point holed[] = {{0, 0}, {9, 0}, {9, 9}, {0, 9},
                                     {3, 3}, {3, 6}, {6, 6}, {6, 3}};
    static const size_t ends[] = {4, 8};
    assert_int_equal(sl_fisk_colour(context, &(sl_shape){holed, ends, 2}, &fisk), SL_UNSUPPORTED);
    assert_non_null(strstr(sl_context_message(context), "holes"));
    static const struct {
        polygon p;
        const char *says;
    } bad[] = {
        {{{{0, 0}, {1, 0}}, 2}, "three corners"},
        {{{{0, 0}, {4, 4}, {4, 0}, {0, 4}}, 4}, "corner 1 and corner 3"},
        {{{{0, 0}, {4, 0}, {4, 0}, {4, 4}}, 4}, "meets itself"},
        {{{{0, 0}, {4, 0}, {2, 0}}, 3}, "meets itself"},
        {{{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}, 5}, "meets itself"},
        {{{{0, 0}, {4, 0}, {4, NAN}}, 3}, "corner 3"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(colour(context, &bad[i].p, &fisk), SL_BAD_ARGUMENT);
        assert_non_null(strstr(sl_context_message(context), bad[i].says));
        assert_null(fisk.ears);
    }
    assert_int_equal(sl_fisk_colour(context, &(sl_shape){0}, &fisk), SL_BAD_ARGUMENT);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(comb), cmocka_unit_test(stars),
                                       cmocka_unit_test(ribbon), cmocka_unit_test(flat_corners),
                                       cmocka_unit_test(refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

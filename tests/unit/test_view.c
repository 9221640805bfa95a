/// The view cone: which points it holds, at every width.
#include "sight/cone.h"
#include "testing.h"

#include "sightline/view.h"

#include <math.h>

static void quarter_turns(void **state) {
    (void)state;
    const sl_point eye = {3, -2};
    const sl_point east = {9, -2}, north = {3, 5}, west = {-1, -2}, south = {3, -7};
    const sl_view up = sl_view_cone(eye, 90, 180, 10);
    assert_true(sli_view_holds(&up, east) && sli_view_holds(&up, north) &&
                sli_view_holds(&up, west));
    assert_false(sli_view_holds(&up, south));
    const sl_view most = sl_view_cone(eye, 90, 270, 10);
    assert_true(sli_view_holds(&most, north) && sli_view_holds(&most, east));
    assert_false(sli_view_holds(&most, south));
    const sl_view ray = sl_view_cone(eye, 0, 0, 10);
    assert_true(sli_view_holds(&ray, east));
    assert_false(sli_view_holds(&ray, west));
    assert_false(sli_view_holds(&ray, (sl_point){9, nextafter(-2, 0)}));
}

/// Borders between the axes are exact too, where the eye has bits to spare: eyes in one line share
/// them.
static void diagonals(void **state) {
    (void)state;
    const sl_point eye = {24.5, 6.25};
    for (int k = 0; k < 4; k++) {
        const sl_view view = sl_view_cone(eye, 90 * k, 90, 200);
        const sl_point borders[] = {view.left, view.right};
        for (int i = 0; i < 2; i++) {
            const double x = borders[i].x - eye.x, y = borders[i].y - eye.y;
            assert_true(fabs(x) == fabs(y) && fabs(x) > 100 && fabs(x) <= 200);
            const sl_point other = {eye.x + copysign(0.5, x), eye.y + copysign(0.5, y)};
            assert_true(sli_view_holds(&view, other));
            assert_int_equal(sli_orient(eye, other, borders[i]), 0);
        }
    }
}

static void the_border_belongs_to_the_cone(void **state) {
    (void)state;
    const sl_view view = {.eye = {0, 0}, .left = {1, 3}, .right = {3, 1}};
    assert_true(sli_view_holds(&view, (sl_point){0.5, 1.5}));
    assert_true(sli_view_holds(&view, (sl_point){1.5, 0.5}));
    assert_false(sli_view_holds(&view, (sl_point){1.5, nextafter(0.5, 0)}));
    assert_false(sli_view_holds(&view, (sl_point){-0.5, -1.5}));
    assert_true(sli_view_holds(&view, view.eye));
    const sl_view rest = {.eye = {0, 0}, .left = {3, 1}, .right = {1, 3}};
    assert_true(sli_view_holds(&rest, (sl_point){1.5, nextafter(0.5, 0)}));
    assert_false(sli_view_holds(&rest, (sl_point){1, 1}));
}

static void all_round(void **state) {
    (void)state;
    const sl_view given = sl_view_cone((sl_point){1, 1}, 17, 360, 10);
    assert_true(given.full);
    const sl_view nearly = sl_view_cone((sl_point){1, 1}, 17, nextafter(360, 0), 10);
    for (int i = 0; i < 360; i += 15) {
        const sl_view ray = sl_view_cone((sl_point){1, 1}, i, 0, 7);
        assert_true(sli_view_holds(&given, ray.left));
        assert_true(sli_view_holds(&nearly, ray.left));
    }
}

// --- segments and polygons, on a small grid against integers

typedef struct vector {
    int x, y;
} vector;

static int cross(vector u, vector v) {
    return u.x * v.y - u.y * v.x;
}

static int dot(vector u, vector v) {
    return u.x * v.x + u.y * v.y;
}

/// A share of the way along a segment.
typedef struct share {
    int num, den;
} share;

static bool is_less(share a, share b) {
    return a.num * b.den < b.num * a.den;
}

/// Keeps of a segment where a value is not negative that runs evenly from its one end to the other.
static void keep_where(int from, int to, share *low, share *high, bool *any) {
    if (from < 0 && to < 0) *any = false;
    if ((from < 0) == (to < 0)) return;
    const share at = {abs(from), abs(from) + abs(to)};
    if (from < 0 && is_less(*low, at)) *low = at;
    if (to < 0 && is_less(at, *high)) *high = at;
}

static bool meets_by_integers(vector right, vector left, vector a, vector b) {
    const int width = cross(right, left);
    share low = {0, 1}, high = {1, 1};
    bool any = true;
    if (width < 0) // a union of two half-planes
        return cross(right, a) >= 0 || cross(right, b) >= 0 || cross(a, left) >= 0 ||
               cross(b, left) >= 0;
    keep_where(cross(right, a), cross(right, b), &low, &high, &any);
    if (width > 0 || dot(right, left) > 0)
        keep_where(cross(a, left), cross(b, left), &low, &high, &any);
    if (width == 0 && dot(right, left) > 0)
        keep_where(dot(right, a), dot(right, b), &low, &high, &any);
    return any && !is_less(high, low);
}

static sl_point on_grid(vector v) {
    return (sl_point){v.x + 7, v.y - 3};
}

/// The nth of the 25 vectors of up to two steps each way.
static vector nth(int n) {
    return (vector){n % 5 - 2, n / 5 - 2};
}

static void segments_on_a_grid(void **state) {
    (void)state;
    size_t met = 0, all = 0;
    for (int r = 0; r < 25; r++)
        for (int l = 0; l < 25; l++) {
            if (r == 12 || l == 12) continue; // the eye
            const sl_view view = {
                .eye = on_grid(nth(12)), .right = on_grid(nth(r)), .left = on_grid(nth(l))};
            sli_pivot pivot = {.eye = view.eye};
            const sli_cone cone = sli_cone_of(&pivot, &view);
            for (int a = 0; a < 25; a++)
                for (int b = 0; b < 25; b++) {
                    const bool expected = meets_by_integers(nth(r), nth(l), nth(a), nth(b));
                    if (sli_cone_meets_segment(&pivot, &cone, on_grid(nth(a)), on_grid(nth(b))) !=
                        expected)
                        fail_msg("right %d left %d segment %d %d", r, l, a, b);
                    met += expected;
                    all++;
                }
        }
    assert_true(met > all / 10 && met < all);
}

static void polygons_on_a_grid(void **state) {
    (void)state;
    for (int r = 0; r < 25; r++)
        for (int l = 0; l < 25; l++) {
            if (r == 12 || l == 12) continue;
            const sl_view view = {
                .eye = on_grid(nth(12)), .right = on_grid(nth(r)), .left = on_grid(nth(l))};
            sli_pivot pivot = {.eye = view.eye};
            const sli_cone cone = sli_cone_of(&pivot, &view);
            for (int a = 0; a < 25; a++)
                for (int b = 0; b < 25; b += 2)
                    for (int c = 0; c < 25; c += 3) {
                        const vector v[3] = {nth(a), nth(b), nth(c)};
                        bool expected = false;
                        for (int i = 0; i < 3; i++)
                            expected |= meets_by_integers(nth(r), nth(l), v[i], v[(i + 1) % 3]);
                        const sl_point corners[3] = {on_grid(v[0]), on_grid(v[1]), on_grid(v[2])};
                        if (sli_cone_meets_polygon(&pivot, &cone, corners, 3) != expected)
                            fail_msg("right %d left %d corners %d %d %d", r, l, a, b, c);
                    }
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quarter_turns),
        cmocka_unit_test(diagonals),
        cmocka_unit_test(the_border_belongs_to_the_cone),
        cmocka_unit_test(all_round),
        cmocka_unit_test(segments_on_a_grid),
        cmocka_unit_test(polygons_on_a_grid),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

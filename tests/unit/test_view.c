/// The view cone: which points it holds, at every width.
#include "testing.h"

#include "sightline/view.h"

#include <math.h>

static void quarter_turns(void **state) {
    (void)state;
    const sl_point eye = {3, -2};
    const sl_point east = {9, -2}, north = {3, 5}, west = {-1, -2}, south = {3, -7};
    const sl_view up = sl_view_cone(eye, 90, 180, 10);
    assert_true(sl_view_holds(&up, east) && sl_view_holds(&up, north) && sl_view_holds(&up, west));
    assert_false(sl_view_holds(&up, south));
    const sl_view most = sl_view_cone(eye, 90, 270, 10);
    assert_true(sl_view_holds(&most, north) && sl_view_holds(&most, east));
    assert_false(sl_view_holds(&most, south));
    const sl_view ray = sl_view_cone(eye, 0, 0, 10);
    assert_true(sl_view_holds(&ray, east));
    assert_false(sl_view_holds(&ray, west));
    assert_false(sl_view_holds(&ray, (sl_point){9, nextafter(-2, 0)}));
}

static void the_border_belongs_to_the_cone(void **state) {
    (void)state;
    const sl_view view = {.eye = {0, 0}, .left = {1, 3}, .right = {3, 1}};
    assert_true(sl_view_holds(&view, (sl_point){0.5, 1.5}));
    assert_true(sl_view_holds(&view, (sl_point){1.5, 0.5}));
    assert_false(sl_view_holds(&view, (sl_point){1.5, nextafter(0.5, 0)}));
    assert_false(sl_view_holds(&view, (sl_point){-0.5, -1.5}));
    assert_true(sl_view_holds(&view, view.eye));
    const sl_view rest = {.eye = {0, 0}, .left = {3, 1}, .right = {1, 3}};
    assert_true(sl_view_holds(&rest, (sl_point){1.5, nextafter(0.5, 0)}));
    assert_false(sl_view_holds(&rest, (sl_point){1, 1}));
}

static void all_round(void **state) {
    (void)state;
    const sl_view given = sl_view_cone((sl_point){1, 1}, 17, 360, 10);
    assert_true(given.full);
    const sl_view nearly = sl_view_cone((sl_point){1, 1}, 17, nextafter(360, 0), 10);
    for (int i = 0; i < 360; i += 15) {
        const sl_view ray = sl_view_cone((sl_point){1, 1}, i, 0, 7);
        assert_true(sl_view_holds(&given, ray.left));
        assert_true(sl_view_holds(&nearly, ray.left));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quarter_turns),
        cmocka_unit_test(the_border_belongs_to_the_cone),
        cmocka_unit_test(all_round),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

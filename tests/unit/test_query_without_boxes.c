// A query of a build without boxes (SIGHTLINE_BOXES): it refuses boxes and answers all else. The
// query is compiled here, without them.
#define SLI_WITHOUT_BOXES
#include "sight/query.c" // NOLINT(bugprone-suspicious-include)

#include "testing.h"

static const char *const room = "sightline 1\nwalls 0 0 10 0 10 10 0 10 0 0\nwall 5 0 5 6\n"
                                "door gate 5 6 5 10 open\n";

static void boxes_are_refused_and_all_else_is_answered(void **state) {
    (void)state;
    sl_context *context = sl_context_create(NULL);
    sl_map map = {0};
    sl_baked baked = {0};
    sl_query *query = NULL;
    assert_ok(context, sl_map_parse(context, "room", room, strlen(room), NULL, &map));
    assert_ok(context, sl_bake(context, &map, NULL, &baked, NULL));
    assert_ok(context, sl_query_create(context, &baked, &query));

    const sl_moving_box box = {{{6, 1}, {7, 2}}, true};
    assert_int_equal(sl_query_set_boxes(context, query, &box, 1), SL_UNSUPPORTED);
    assert_non_null(strstr(sl_context_message(context), "no boxes"));
    assert_ok(context, sl_query_set_boxes(context, query, NULL, 0));

    bool sees, seen = false;
    const sl_view view = sl_query_view(query, (sl_point){1, 9}, 0, 360);
    assert_ok(context, sl_query_sees(context, query, view.eye, (sl_point){9, 9}, &sees));
    assert_true(sees);
    assert_ok(context, sl_query_set_door(context, query, "gate", false));
    assert_ok(context, sl_query_sees(context, query, view.eye, (sl_point){9, 9}, &sees));
    assert_false(sees);
    assert_ok(context, sl_query_boxes_seen(context, query, &view, &seen, NULL));
    assert_false(seen);

    sl_query_destroy(context, query);
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes_are_refused_and_all_else_is_answered),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

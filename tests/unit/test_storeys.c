/// Buildings: what is read of the text, and that whatever is wrong is refused with its line.
#include "testing.h"

#include "sightline/storeys.h"
#include "sightline/support.h"

#include <string.h>

static int set_up(void **state) {
    *state = testing_context(NULL);
    return 0;
}

static int tear_down(void **state) {
    sl_context_destroy(*state);
    return 0;
}

static void a_building_is_read(void **state) {
    sl_context *context = *state;
    static const char text[] = "# a house\r\nstoreys 1\r\n"
                               "storey ground plan0.dxf # below\r\n"
                               "storey first \"plans\\first floor.map\"\r\n"
                               "storey roof /tmp/roof.map\r\n\r\n"
                               "link stair ground 3,4 first -3.5,1e1 6.5\r\n"
                               "link lift ground 1,1 roof 1,1\r\n"
                               "\tlink ramp first 0,0 first 5,0";
    sl_building b;
    assert_ok(context, sl_building_parse(context, "dir/a.storeys", text, sizeof text - 1, &b));
    assert_int_equal(b.storey_count, 3);
    assert_string_equal(b.storeys[0].name, "ground");
    assert_string_equal(b.storeys[0].path, "dir/plan0.dxf");
    assert_string_equal(b.storeys[1].path, "dir/plans/first floor.map");
    assert_string_equal(b.storeys[2].path, "/tmp/roof.map");
    assert_int_equal(b.storeys[1].line, 4);
    assert_int_equal(b.link_count, 3);
    assert_string_equal(b.links[0].name, "stair");
    assert_int_equal(b.links[0].storeys[1], 1);
    assert_true(b.links[0].places[1].x == -3.5 && b.links[0].places[1].y == 10);
    assert_true(b.links[0].length == 6.5 && b.links[1].length == 0);
    assert_int_equal(b.links[1].storeys[1], 2);
    assert_int_equal(b.links[2].line, 9);
    assert_int_equal(sl_building_find(&b, "roofs", 4), 2);
    assert_true(sl_building_find(&b, "roofs", 5) == SL_NO_STOREY);
    sl_building_destroy(context, &b);
    assert_ok(context, sl_building_parse(context, "a.storeys", text, sizeof text - 1, &b));
    assert_string_equal(b.storeys[0].path, "plan0.dxf");
    sl_building_destroy(context, &b);
}

#define HEAD "storeys 1\nstorey a a.map\nstorey b b.map\n"

static void what_is_wrong_has_its_line(void **state) {
    sl_context *context = *state;
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"", "no storey"},
        {"storeys 1\n", "no storey"},
        {"storeys 2\n", "a.storeys:1: expected 'storeys 1'"},
        {"storey a a.map\n", "a.storeys:1: expected 'storeys 1'"},
        {HEAD "storeys 1\n", "a.storeys:4: expected 'storey' or 'link', found 'storeys'"},
        {HEAD "storey c\n", "a.storeys:4: expected 'storey NAME FILE'"},
        {HEAD "storey c \"\"\n", "a.storeys:4: expected 'storey NAME FILE'"},
        {HEAD "storey c d e\n", "a.storeys:4: expected 'storey NAME FILE'"},
        {HEAD "storey c \"d e\n", "a.storeys:4: a word begins with \" and has no end"},
        {HEAD "storey a c.map\n", "a.storeys:4: storey: 'a' is the name of the storey in line 2"},
        {HEAD "storey a:b c.map\n", "a.storeys:4: storey: 'a:b' is no name"},
        {HEAD "link s,t a 1,2 b 1,2\n", "a.storeys:4: link: 's,t' is no name"},
        {HEAD "link s a 1,2 b 1,2 3 4\n", "a.storeys:4: expected 'link NAME STOREY X,Y"},
        {HEAD "link s a 1,2 b\n", "a.storeys:4: expected 'link NAME STOREY X,Y"},
        {HEAD "link s a 1,2 c 1,2\n", "a.storeys:4: link: no storey 'c' stands before"},
        {HEAD "link s a 1,2 a 1,2\n", "a.storeys:4: link: expected two different places"},
        {HEAD "link s a 1 b 1,2\n", "a.storeys:4: link: expected a place X,Y, found '1'"},
        {HEAD "link s a 1,x b 1,2\n", "a.storeys:4: expected a finite decimal number, found 'x'"},
        {HEAD "link s a 1,1e200 b 1,2\n", "a.storeys:4: '1e200' is out of range"},
        {HEAD "link s a 1,2 b 1,2 -1\n", "a.storeys:4: link: expected a length of 0 or more"},
        {HEAD "link s a 1,2 b 1,2 nan\n", "a.storeys:4: expected a finite decimal number"},
        {HEAD "\n\n1 2 3 4 5 6 7 8 9\n", "a.storeys:6: more than 8 words"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sl_building b = {0};
        const char *text = cases[i].text;
        assert_int_equal(sl_building_parse(context, "a.storeys", text, strlen(text), &b),
                         SL_BAD_INPUT);
        if (!strstr(sl_context_message(context), cases[i].message))
            fail_msg("\"%s\" is not in: %s", cases[i].message, sl_context_message(context));
        assert_null(b.storeys);
    }
    sl_building b = {0};
    assert_int_equal(sl_building_parse(context, "a.storeys", "storeys\0 1", 10, &b), SL_BAD_INPUT);
    assert_int_equal(sl_building_read(context, "/nowhere/a.storeys", &b), SL_BAD_ARGUMENT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_building_is_read),
        cmocka_unit_test(what_is_wrong_has_its_line),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}

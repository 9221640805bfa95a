// Universal VTT and Foundry's scenes: walls, doors, one-way walls; our own export; and what is
// refused.
#include "testing.h"

#include "import_check.h"
#include "sightline/io.h"

static const sl_import_options with_doors = {.doors = true};

// --- Universal VTT

#define POINT(x, y) "{\"x\": " x ", \"y\": " y "}"
#define SIZE                                                                                       \
    "\"resolution\": {\"map_origin\": " POINT("2", "1") ", \"map_size\": " POINT("4", "9") "},\n"
#define LINES         "\"line_of_sight\": [[" POINT("0", "0") "," POINT("0", "4") "," POINT("0", "4") "]]"
#define OBJECTS       "\"objects_line_of_sight\": [[" POINT("1", "1") "," POINT("2.5", "3") "]]"
#define PORTAL(state) "{\"bounds\": [" POINT("0", "4") "," POINT("0", "5") "]" state "}"
#define PORTALS                                                                                    \
    "\"portals\": [" PORTAL(", \"closed\": true") "," PORTAL(", \"closed\": false") "," PORTAL(    \
        "") "]"
#define UVTT(body) "{" SIZE body "}"

static void assert_uvtt(const sl_import_options *options, const char *text, const char *expected) {
    assert_walls_of(sl_map_read_uvtt, options, text, strlen(text), expected);
}

static void assert_uvtt_refused(const char *text, const char *message) {
    assert_refused_of(sl_map_read_uvtt, NULL, text, strlen(text), SL_BAD_INPUT, message);
}

static void test_uvtt(void **state) {
    (void)state;
    assert_uvtt(NULL, UVTT(LINES), "wall 0 10 0 6\n");
    assert_uvtt(NULL, UVTT(LINES "," OBJECTS "," PORTALS),
                "wall 0 10 0 6\nwall 1 9 2.5 7\nwall 0 6 0 5\nwall 0 6 0 5\n");
    assert_uvtt(&with_doors, UVTT(LINES "," PORTALS),
                "wall 0 10 0 6\ndoor door1 0 6 0 5 shut\ndoor door2 0 6 0 5 open\ndoor door3 0 6 0 "
                "5 shut\n");
    const sl_import_options objects = {.layers = "objects_line_of_sight"};
    assert_uvtt(&objects, UVTT(LINES "," OBJECTS "," PORTALS), "wall 1 9 2.5 7\n");
    const sl_import_options unknown = {.layers = "walls"};
    assert_refused_of(sl_map_read_uvtt, &unknown, UVTT(LINES), strlen(UVTT(LINES)), SL_BAD_ARGUMENT,
                      "f: there is no layer 'walls'");
}

static void test_uvtt_refused(void **state) {
    (void)state;
    assert_uvtt_refused("{\n\"a\": }", "f:2: column 6: no JSON: ");
    assert_uvtt_refused("", "f:1: column 0: no JSON: ");
    assert_uvtt_refused("[]", "f: expected an object, found an array");
    assert_uvtt_refused("{}", "f: resolution: expected an object, found nothing");
    assert_uvtt_refused("{\"resolution\": {}}", "f: resolution.map_size.y: expected a number");
    assert_uvtt_refused(UVTT("\"a\": 1"), "f: line_of_sight: expected an array, found nothing");
    assert_uvtt_refused(UVTT("\"line_of_sight\": [3]"),
                        "f: line_of_sight[0]: expected an array, found 3");
    assert_uvtt_refused(UVTT("\"line_of_sight\": [[" POINT("0", "\"1\"") "]]"),
                        "f: line_of_sight[0][0].y: expected a number, found '1'");
    assert_uvtt_refused(UVTT("\"line_of_sight\": [[" POINT("1e308", "0") "]]"),
                        "f: line_of_sight[0][0].x: 1e+308 is out of range");
    assert_uvtt_refused(UVTT("\"line_of_sight\": [[" POINT("1e-300", "0") "]]"),
                        "f: line_of_sight[0][0].x: 1e-300 is out of range");
    assert_uvtt_refused(UVTT("\"line_of_sight\": [[" POINT("NaN", "0") "]]"), "f:2: column ");
    assert_uvtt_refused(UVTT("\"line_of_sight\": [], \"portals\": [{}]"),
                        "f: portals[0].bounds: expected an array");
    assert_uvtt_refused(UVTT("\"line_of_sight\": [], \"portals\": [{\"bounds\": [1]}]"),
                        "f: portals[0].bounds: a portal has 2 ends, this one 1");
    assert_uvtt_refused(
        UVTT("\"line_of_sight\": [], \"portals\": [" PORTAL(", \"closed\": \"no\"") "]"),
        "f: portals[0].closed: expected true or false");
    assert_uvtt_refused("{\"resolution\": {\"map_size\": " POINT(
                            "1", "1e150") "}, "
                                          "\"line_of_sight\": [[" POINT("0", "-1e150") "]]}",
                        "f: line_of_sight[0][0].y: out of range once y points up");
}

// --- Foundry

#define SCENE(walls)  "{\"name\": \"s\", \"padding\": 0, \"walls\": [" walls "]}"
#define WALL(c, more) "{\"c\": [" c "]" more "}"
#define BASE          WALL("0, 10, 8, 10", "")
#define BASE_WALL     "wall 0 0 8 0\n"

static void assert_foundry(const sl_import_options *options, const char *text,
                           const char *expected) {
    assert_walls_of(sl_map_read_foundry, options, text, strlen(text), expected);
}

static void assert_foundry_refused(const char *text, const char *message) {
    assert_refused_of(sl_map_read_foundry, NULL, text, strlen(text), SL_BAD_INPUT, message);
}

static void test_foundry_walls(void **state) {
    (void)state;
    assert_foundry(NULL, SCENE(BASE "," WALL("1, 2, 3, 4.5", ", \"sight\": 20, \"move\": 0")),
                   BASE_WALL "wall 1 8 3 5.5\n");
    assert_foundry(NULL, "[" BASE "," WALL("1, 2, 3, 4", ", \"sense\": 1") "]",
                   BASE_WALL "wall 1 8 3 6\n");
    // Left out: no sight stopped, the first of two, by distance, no length.
    assert_foundry(
        NULL,
        SCENE(BASE "," WALL("1, 2, 3, 4", ", \"sight\": 0, \"move\": 20") "," WALL(
            "1, 2, 3, 4",
            ", "
            "\"sigh"
            "t\": "
            "10") "," WALL("1, 2, 3, 4",
                           ", \"sight\": 30") "," WALL("1, 2, 3, 4",
                                                       ", \"sight\": 40") "," WALL("1, 2, 1, 2",
                                                                                   "") "," WALL("1,"
                                                                                                " 2"
                                                                                                ", "
                                                                                                "3,"
                                                                                                " "
                                                                                                "4",
                                                                                                ", "
                                                                                                "\""
                                                                                                "se"
                                                                                                "ns"
                                                                                                "e"
                                                                                                "\""
                                                                                                ": "
                                                                                                "2")),
        BASE_WALL);
    assert_foundry(NULL, SCENE(""), "");
}

static void test_foundry_sides(void **state) {
    (void)state;
    // Working on the left only: passed from the right to the left, as one-way glass is.
    assert_foundry(NULL, SCENE(BASE "," WALL("1, 2, 3, 2", ", \"dir\": 1")),
                   BASE_WALL "oneway 1 8 3 8\n");
    assert_foundry(NULL, SCENE(BASE "," WALL("1, 2, 3, 2", ", \"dir\": 2")),
                   BASE_WALL "oneway 3 8 1 8\n");
}

static void test_foundry_doors(void **state) {
    (void)state;
#define DOORS                                                                                      \
    SCENE(BASE "," WALL("1, 2, 3, 2", ", \"door\": 1, \"ds\": 0") "," WALL(                        \
        "3, 2, 5, 2",                                                                              \
        ", \"door\": "                                                                             \
        "1, \"ds\": "                                                                              \
        "1") "," WALL("5, 2, 7, 2",                                                                \
                      ", \"door\": 2, \"ds\": 2") "," WALL("7, 2, 9, 2",                           \
                                                           ", \"door\": 1, "                       \
                                                           "\"dir\": 1") "," WALL("7, 2, "         \
                                                                                  "9, 2",          \
                                                                                  ", "             \
                                                                                  "\"door"         \
                                                                                  "\": 1, "        \
                                                                                  "\"sight"        \
                                                                                  "\": 0"))
    assert_foundry(NULL, DOORS, BASE_WALL "wall 1 8 3 8\nwall 5 8 7 8\noneway 7 8 9 8\n");
    assert_foundry(&with_doors, DOORS,
                   BASE_WALL
                   "door door1 1 8 3 8 shut\ndoor door2 3 8 5 8 open\ndoor door3 5 8 7 8 shut\n"
                   "door door4 7 8 9 8 shut\n");
}

static void test_foundry_refused(void **state) {
    (void)state;
    assert_foundry_refused("{", "f:1: column 1: no JSON: ");
    assert_foundry_refused("{}", "f: walls: expected an array, found nothing");
    assert_foundry_refused("[1]", "f: [0]: expected an object, found 1");
    assert_foundry_refused(SCENE("{}"), "f: walls[0].c: expected an array, found nothing");
    assert_foundry_refused(SCENE(WALL("1, 2, 3", "")), "f: walls[0].c: expected 4 numbers");
    assert_foundry_refused(SCENE(WALL("1, 2, 3, null", "")),
                           "f: walls[0].c[3]: expected a number, found nothing");
    assert_foundry_refused(SCENE(WALL("1, 2, 3, 1e308", "")),
                           "f: walls[0].c[3]: 1e+308 is out of range");
    assert_foundry_refused(SCENE(WALL("1, 2, 3, 4", ", \"sight\": 50")),
                           "f: walls[0].sight: 50 is out of range");
    assert_foundry_refused(SCENE(WALL("1, 2, 3, 4", ", \"dir\": 3")),
                           "f: walls[0].dir: 3 is out of range");
    assert_foundry_refused(SCENE(WALL("1, 2, 3, 4", ", \"door\": true")),
                           "f: walls[0].door: expected a whole number, found true");
    assert_foundry_refused(SCENE(WALL("1, 2, 3, 4", ", \"ds\": 1.5")),
                           "f: walls[0].ds: expected a whole number, found 1.5");
    assert_foundry_refused(SCENE(WALL("0, 1e150, 0, 0", "") "," WALL("0, -1e150, 0, 0", "")),
                           "f: walls[1].c: out of range once y points up");
}

// --- our own export

static void test_export(void **state) {
    (void)state;
    static const char text[] = "{\"format\": \"sightline\", \"walls\": [[0, 1, 2.5, 1]]}";
    assert_walls_of(sl_map_read_export, NULL, text, strlen(text), "wall 0 1 2.5 1\n");
    static const char broken[] = "{\"format\": \"sightline\", \"walls\": [[0, 1, 2.5]]}";
    assert_refused_of(sl_map_read_export, NULL, broken, strlen(broken), SL_BAD_INPUT,
                      "f: walls[0]: expected 4 numbers");
}

// --- memory

static void assert_memory(import_reader *read, const char *text) {
    const sl_import_options options = {.doors = true};
    sl_status status = SL_NO_MEMORY;
    for (long fail_at = 1; status != SL_OK; fail_at++) {
        testing_memory memory = {0};
        sl_context *context = testing_context(&memory);
        memory.fail_at = memory.calls + fail_at;
        sl_map map = {0};
        status = read(context, "f", text, strlen(text), &options, &map);
        if (status != SL_OK) assert_int_equal(status, SL_NO_MEMORY);
        if (status != SL_OK) assert_true(map_is_empty(&map));
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
        assert_int_equal(memory.live, 0);
        assert_in_range(fail_at, 1, 100);
    }
}

static void test_memory(void **state) {
    (void)state;
    assert_memory(sl_map_read_uvtt, UVTT(LINES "," OBJECTS "," PORTALS));
    assert_memory(sl_map_read_foundry, DOORS);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_uvtt),          cmocka_unit_test(test_uvtt_refused),
        cmocka_unit_test(test_foundry_walls), cmocka_unit_test(test_foundry_sides),
        cmocka_unit_test(test_foundry_doors), cmocka_unit_test(test_foundry_refused),
        cmocka_unit_test(test_export),        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

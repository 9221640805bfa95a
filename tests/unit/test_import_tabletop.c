// Universal VTT and Foundry's scenes: walls, doors, one-way walls; our own export; and what is
// refused.
#include "testing.h"

#include "import_check.h"
#include "io/io_formats.h"
#include "sightline/io.h"

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

/// All but the scene's edge.
static const sl_import_options no_edge = {.layers = "line_of_sight,objects_line_of_sight,portals"};

static void assert_uvtt(const sl_import_options *options, const char *text, const char *expected) {
    assert_walls_of(sli_map_read_uvtt, options, text, strlen(text), expected);
}

static void assert_uvtt_refused(const char *text, const char *message) {
    assert_refused_of(sli_map_read_uvtt, NULL, text, strlen(text), SL_BAD_INPUT, message);
}

static void test_uvtt(void **state) {
    (void)state;
    assert_uvtt(&no_edge, UVTT(LINES), "wall 0 10 0 6\n");
    assert_uvtt(&no_edge, UVTT(LINES "," OBJECTS), "wall 0 10 0 6\nwall 1 9 2.5 7\n");
    assert_uvtt(&no_edge, UVTT(LINES "," PORTALS),
                "wall 0 10 0 6\ndoor door1 0 6 0 5 shut\ndoor door2 0 6 0 5 open\ndoor door3 0 6 0 "
                "5 shut\n");
    const sl_import_options objects = {.layers = "objects_line_of_sight"};
    assert_uvtt(&objects, UVTT(LINES "," OBJECTS "," PORTALS), "wall 1 9 2.5 7\n");
    const sl_import_options unknown = {.layers = "walls"};
    assert_refused_of(sli_map_read_uvtt, &unknown, UVTT(LINES), strlen(UVTT(LINES)),
                      SL_BAD_ARGUMENT, "f: there is no layer 'walls'");
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
    assert_uvtt_refused(UVTT("\"line_of_sight\": [[" POINT("NaN", "0") "]]"), "f:2: column ");
    assert_uvtt_refused(
        UVTT("\"line_of_sight\": [], \"portals\": []"),
        "f: the map has no walls and no doors, so nothing is hidden in it: draw them "
        "in the program that wrote it, and export it again");
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
    assert_walls_of(sli_map_read_foundry, options, text, strlen(text), expected);
}

static void assert_foundry_refused(const char *text, const char *message) {
    assert_refused_of(sli_map_read_foundry, NULL, text, strlen(text), SL_BAD_INPUT, message);
}

static void test_foundry_walls(void **state) {
    (void)state;
    assert_foundry(NULL, SCENE(BASE "," WALL("1, 2, 3, 4.5", ", \"sight\": 20, \"move\": 20")),
                   BASE_WALL "wall 1 8 3 5.5\n");
    assert_foundry(NULL, "[" BASE "," WALL("1, 2, 3, 4", ", \"sense\": 1") "]",
                   BASE_WALL "wall 1 8 3 6\n");
    assert_foundry(NULL, SCENE(BASE "," WALL("1, 2, 1, 2", "")), BASE_WALL);
    assert_foundry_refused(SCENE(""), "f: the scene has no walls, so nothing is hidden in it");
}

/// A wall, what the file says that it does, and what it then stops.
static void test_foundry_stops(void **state) {
    (void)state;
    static const struct {
        const char *members, *stops;
    } walls[] = {
        {"\"sight\": 20, \"move\": 0", " stops sight,sound"},
        {"\"sight\": 20, \"move\": 0, \"sound\": 0", " stops sight"},
        {"\"sight\": 0, \"move\": 20", " stops steps,sound"},
        {"\"sight\": 0, \"move\": 20, \"sound\": 0, \"light\": 20", " stops steps"},
        {"\"sight\": 0, \"move\": 0, \"sound\": 20", " stops sound"},
        {"\"sight\": 0, \"move\": 0, \"sound\": 0", NULL},
        {"\"sense\": 0, \"move\": 1", " stops steps,sound"},
        {"\"sight\": 20, \"sound\": 10", " stops sight,steps"},
        {"\"sight\": 20, \"sound\": null, \"move\": true", ""},
        // Limited sight; from one side it counts as open.
        {"\"sight\": 10, \"move\": 0, \"sound\": 0", " stops limited"},
        {"\"sight\": 10", " stops steps,sound,limited"},
        {"\"sense\": 2", " stops steps,sound,limited"},
        {"\"sight\": 10, \"sound\": 0, \"dir\": 1", " stops steps"},
        // Doors that are seen through are open to steps, and open ones are nothing.
        {"\"sight\": 10, \"door\": 1, \"ds\": 0", " stops sound,limited"},
        {"\"sight\": 10, \"door\": 1, \"ds\": 1", NULL},
        // By distance: open.
        {"\"sight\": 30, \"sound\": 40", " stops steps"},
        {"\"sight\": 40, \"sound\": 0", " stops steps"},
        {"\"sight\": 0, \"door\": 1, \"ds\": 0", " stops sound"},
        {"\"sight\": 0, \"sound\": 0, \"door\": 1, \"ds\": 0", NULL},
        {"\"sight\": 0, \"door\": 1, \"ds\": 1", NULL},
        {"\"sight\": 0, \"dir\": 1", " stops steps,sound"},
        // What no version has: open to sight and sound, and shut to steps.
        {"\"sight\": 50, \"sound\": 3, \"move\": 7", " stops steps"},
        {"\"sight\": -1, \"move\": 0", " stops sound"},
    };
    for (size_t i = 0; i < sizeof walls / sizeof *walls; i++) {
        char text[256], expected[128] = BASE_WALL;
        snprintf(text, sizeof text, "[%s, {\"c\": [1, 2, 3, 2], %s}]", BASE, walls[i].members);
        if (walls[i].stops)
            snprintf(expected, sizeof expected, "%swall 1 8 3 8%s\n", BASE_WALL, walls[i].stops);
        assert_foundry(NULL, text, expected);
    }
}

static void test_foundry_sides(void **state) {
    (void)state;
    // Working on the left only: passed from the right to the left, as one-way glass is.
    assert_foundry(NULL, SCENE(BASE "," WALL("1, 2, 3, 2", ", \"dir\": 1")),
                   BASE_WALL "oneway 1 8 3 8\n");
    assert_foundry(NULL, SCENE(BASE "," WALL("1, 2, 3, 2", ", \"dir\": 2")),
                   BASE_WALL "oneway 3 8 1 8\n");
}

#define DOOR_AT(c, more) WALL(c, ", \"door\": 1" more)
#define DOORS                                                                                       \
    SCENE(                                                                                          \
        BASE                                                                                        \
        "," DOOR_AT("1, 2, 3, 2", ", \"ds\": 0") "," DOOR_AT("3, 2, 5, 2", ", \"ds\": 1") "," WALL( \
            "5, 2, 7, 2",                                                                           \
            ", \"door\": 2, \"ds\": 2") "," DOOR_AT("7, 2, 9, 2",                                   \
                                                    ", \"dir\": 1") "," DOOR_AT("7, 2, 9, 2",       \
                                                                                ", \"sight\": 0"))

/// Shut, open, locked and secret, on one side, and one that is seen through.
static void test_foundry_doors(void **state) {
    (void)state;
    assert_foundry(NULL, DOORS,
                   BASE_WALL
                   "wall 7 8 9 8 stops sound\n"
                   "door door1 1 8 3 8 shut\ndoor door2 3 8 5 8 open\ndoor door3 5 8 7 8 shut\n"
                   "door door4 7 8 9 8 shut\n");
}

static void test_foundry_refused(void **state) {
    (void)state;
    assert_foundry_refused("{", "f:1: column 1: no JSON: ");
    assert_foundry_refused("{}",
                           "f: a document of Foundry, no scene: in Foundry, right-click the scene");
    assert_foundry_refused("[1]", "f: [0]: expected an object, found 1");
    assert_foundry_refused(SCENE("{}"), "f: walls[0].c: expected an array, found nothing");
    assert_foundry_refused(SCENE(WALL("1, 2, 3", "")), "f: walls[0].c: expected 4 numbers");
    assert_foundry_refused(SCENE(WALL("1, 2, 3, null", "")),
                           "f: walls[0].c[3]: expected a number, found nothing");
    assert_foundry_refused(SCENE(WALL("1, 2, 3, 1e308", "")),
                           "f: walls[0].c[3]: 1e+308 is out of range");
    assert_foundry_refused(SCENE(WALL("1, 2, 3, 4", ", \"sight\": \"20\"")),
                           "f: walls[0].sight: expected a whole number, found '20'");
    assert_foundry_refused(SCENE(WALL("1, 2, 3, 4", ", \"move\": 1.5")),
                           "f: walls[0].move: expected a whole number, found 1.5");
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
    assert_walls_of(sli_map_read_export, NULL, text, strlen(text), "wall 0 1 2.5 1\n");
    static const char broken[] = "{\"format\": \"sightline\", \"walls\": [[0, 1, 2.5]]}";
    assert_refused_of(sli_map_read_export, NULL, broken, strlen(broken), SL_BAD_INPUT,
                      "f: walls[0]: expected 4 numbers");
}

#define EXPORT(members)                                                                            \
    "{\"format\": \"sightline\", \"version\": 2, \"walls\": [[0, 0, 8, 0], [8, 0, 8, 4]]" members  \
    "}"
#define DOOR(segments) ", \"doors\": [{\"name\": \"front\", \"segments\": [" segments "]}]"
#define EVERYTHING                                                                                 \
    EXPORT(", \"doors\": [{\"name\": \"d\", \"segments\": [[0, 1, 2, 1], [2, 1, 3, 1], [3, 1, 4, " \
           "2]], "                                                                                 \
           "\"open\": false}], \"mirrors\": [[1, 0, 2, 0], [3, 0, 4, 0]], \"one_sided_mirrors\": " \
           "[1], "                                                                                 \
           "\"oneways\": [[5, 0, 5, 4]], \"seams\": [[6, 0, 6, 4]], \"range\": 2.5, "              \
           "\"starts\": [{\"at\": [1, 2], \"heading\": 1e-200}], "                                 \
           "\"paths\": [{\"name\": \"tour\", \"points\": [[1, 2], [3, 4]]}], "                     \
           "\"objects\": [{\"name\": \"box\", \"box\": [3, 2, 1, 4]}], \"later\": {}")

static void assert_export(const char *text, const char *expected) {
    assert_walls_of(sli_map_read_export, NULL, text, strlen(text), expected);
}

static void assert_export_refused(const char *text, const char *message) {
    assert_refused_of(sli_map_read_export, NULL, text, strlen(text), SL_BAD_INPUT, message);
}

/// Stretches of a door that go on in one line are one door again.
static void test_export_all(void **state) {
    (void)state;
    assert_export(EVERYTHING, "range 2.5\nwall 0 0 8 0\nwall 8 0 8 4\n"
                              "door d 0 1 3 1 shut\ndoor d 3 1 4 2 shut\n"
                              "mirror 1 0 2 0\nmirror 3 0 4 0 one\noneway 5 0 5 4\nseam 6 0 6 4\n"
                              "start 1 2 1e-200\npath tour 1 2 3 4\nobject box 1 2 3 4\n");
    assert_export(EXPORT(DOOR("[0, 1, 2, 1]") ", \"range\": null, \"doubtful\": 1"),
                  "wall 0 0 8 0\nwall 8 0 8 4\ndoor front 0 1 2 1 open\n");
}

/// Walls that say where solid ground is come before the polygons, which would add walls.
static void test_export_ground(void **state) {
    (void)state;
#define SOLIDS ", \"solids\": [[[0, 0], [8, 0], [8, 4]]]"
    assert_export(EXPORT(SOLIDS), "wall 0 0 8 0\nwall 8 0 8 4\nwall 0 0 8 0\nwall 8 0 8 4\n"
                                  "wall 8 4 0 0\n");
    const char *const text = EXPORT(SOLIDS ", \"solid_walls\": {\"left\": [0, 1], \"right\": [1]}");
    assert_export(text, "wall 0 0 8 0\nwall 8 0 8 4\n");
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    assert_ok(context, sli_map_read_export(context, "f", text, strlen(text), NULL, &map));
    assert_int_equal(map.walls[0].ground, SL_SOLID_LEFT);
    assert_int_equal(map.walls[1].ground, SL_SOLID_LEFT | SL_SOLID_RIGHT);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void test_export_refused(void **state) {
    (void)state;
    assert_export_refused("{\"format\": \"sightline\"", "f:1: column ");
    assert_export_refused("[1]", "f: expected an object, found an array");
    assert_export_refused("{\"format\": \"other\", \"walls\": []}",
                          "f: format: expected \"sightline\"");
    assert_export_refused("{\"format\": \"sightline\", \"version\": 3, \"walls\": []}",
                          "f: version: ");
    assert_export_refused("{\"format\": \"sightline\", \"version\": 2}", "f: walls: ");
    static const struct {
        const char *text, *message;
    } cases[] = {
        {EXPORT(", \"doors\": [1]"), "f: doors[0]: expected an object"},
        {EXPORT(", \"doors\": [{\"name\": \"a b\"}]"), "f: doors[0].name: expected one word"},
        {EXPORT(DOOR("")), "f: doors[0].segments: expected at least 1 segment"},
        {EXPORT(DOOR("[1, 2, 1, 2]")), "f: doors[0].segments[0]: expected two different ends"},
        {EXPORT(", \"doors\": [{\"name\": \"d\", \"open\": \"yes\"}]"),
         "f: doors[0].open: expected true or false"},
        {EXPORT(", \"solid_walls\": {\"left\": [2], \"right\": []}"), "f: solid_walls.left[0]: "},
        {EXPORT(", \"solid_walls\": {\"left\": []}"), "f: solid_walls.right: "},
        {EXPORT(", \"solids\": [[[0, 0], [1, 1]]]"),
         "f: solids[0]: expected at least 3 corners, found 2"},
        {EXPORT(", \"solids\": [[[0, 0], [1, 1], 5]]"), "f: solids[0][2]: "},
        {EXPORT(", \"mirrors\": [[0, 0, 0, 0]]"), "f: mirrors[0]: expected two different ends"},
        {EXPORT(", \"one_sided_mirrors\": [0]"), "f: one_sided_mirrors[0]: "},
        {EXPORT(", \"oneways\": [[0, 0, 1]]"), "f: oneways[0]: expected 4 numbers"},
        {EXPORT(", \"range\": -1"), "f: range: expected a number greater than 0"},
        {EXPORT(", \"range\": \"far\""), "f: range: "},
        {EXPORT(", \"starts\": [{\"at\": [1]}]"), "f: starts[0].at: expected 2 numbers"},
        {EXPORT(", \"starts\": [{\"at\": [1, 2], \"heading\": \"up\"}]"),
         "f: starts[0].heading: expected a number of degrees"},
        {EXPORT(", \"paths\": [{\"name\": \"p\", \"points\": []}]"),
         "f: paths[0].points: expected at least 1 point, found 0"},
        {EXPORT(", \"objects\": [{\"name\": \"o\"}]"), "f: objects[0].box: "},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_export_refused(cases[i].text, cases[i].message);
}

// --- memory

static void test_memory(void **state) {
    (void)state;
    const sl_import_options options = {.doors = true};
    assert_memory_of(sli_map_read_uvtt, &options, UVTT(LINES "," OBJECTS "," PORTALS));
    assert_memory_of(sli_map_read_foundry, &options, DOORS);
    assert_memory_of(sli_map_read_export, &options, EVERYTHING);
    assert_memory_of(sli_map_read_export, &options, EXPORT(SOLIDS));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_uvtt),
        cmocka_unit_test(test_uvtt_refused),
        cmocka_unit_test(test_foundry_walls),
        cmocka_unit_test(test_foundry_stops),
        cmocka_unit_test(test_foundry_sides),
        cmocka_unit_test(test_foundry_doors),
        cmocka_unit_test(test_foundry_refused),
        cmocka_unit_test(test_export),
        cmocka_unit_test(test_export_all),
        cmocka_unit_test(test_export_ground),
        cmocka_unit_test(test_export_refused),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

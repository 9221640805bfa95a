// Scenes of virtual tabletops as their versions write them, their edges, their starts, and what
// comes back from what is written.
#include "testing.h"

#include "import_check.h"
#include "io/io_formats.h"
#include "sightline/io.h"

static void assert_scene(const char *text, const char *expected) {
    assert_walls_of(sli_map_read_foundry, NULL, text, strlen(text), expected);
}

static void assert_table(const char *text, const char *expected) {
    assert_walls_of(sli_map_read_uvtt, NULL, text, strlen(text), expected);
}

// --- versions

/// One scene in the words of each version: a wall, a window, a limited wall, a shut door, a locked
/// secret one, a wall that works on its left.
static void test_versions(void **state) {
    (void)state;
    static const char *const versions[] = {
        // 0.6 to 0.8: sense, and no light.
        "{\"name\": \"s\", \"grid\": 100, \"gridType\": 1, \"shiftX\": 0, \"shiftY\": 0, "
        "\"walls\": ["
        "{\"c\": [0, 0, 900, 0], \"move\": 1, \"sense\": 1, \"sound\": 1, \"dir\": 0, \"door\": 0, "
        "\"ds\": 0, \"flags\": {}},"
        "{\"c\": [0, 100, 900, 100], \"move\": 1, \"sense\": 0, \"sound\": 0, \"dir\": 0, "
        "\"door\": 0},"
        "{\"c\": [0, 200, 900, 200], \"move\": 1, \"sense\": 2, \"sound\": 1},"
        "{\"c\": [0, 300, 900, 300], \"move\": 1, \"sense\": 1, \"door\": 1, \"ds\": 0},"
        "{\"c\": [0, 400, 900, 400], \"move\": 1, \"sense\": 1, \"door\": 2, \"ds\": 2},"
        "{\"c\": [0, 500, 900, 500], \"move\": 1, \"sense\": 1, \"dir\": 1}]}",
        // 9.
        "{\"name\": \"s\", \"grid\": 100, \"gridType\": 1, \"walls\": ["
        "{\"c\": [0, 0, 900, 0], \"light\": 20, \"move\": 20, \"sight\": 20, \"sound\": 20, "
        "\"dir\": 0, "
        "\"door\": 0, \"ds\": 0},"
        "{\"c\": [0, 100, 900, 100], \"light\": 0, \"move\": 20, \"sight\": 0, \"sound\": 0},"
        "{\"c\": [0, 200, 900, 200], \"light\": 10, \"move\": 20, \"sight\": 10, \"sound\": 20},"
        "{\"c\": [0, 300, 900, 300], \"move\": 20, \"sight\": 20, \"door\": 1, \"ds\": 0},"
        "{\"c\": [0, 400, 900, 400], \"move\": 20, \"sight\": 20, \"door\": 2, \"ds\": 2},"
        "{\"c\": [0, 500, 900, 500], \"move\": 20, \"sight\": 20, \"dir\": 1}]}",
        // 10 to 13.
        "{\"name\": \"s\", \"grid\": {\"type\": 1, \"size\": 100, \"style\": \"solidLines\"}, "
        "\"background\": {\"src\": \"a.webp\", \"offsetX\": 0}, \"walls\": ["
        "{\"_id\": \"a\", \"c\": [0, 0, 900, 0], \"light\": 20, \"move\": 20, \"sight\": 20, "
        "\"sound\": "
        "20, \"dir\": 0, \"door\": 0, \"ds\": 0, \"threshold\": {\"light\": null, \"sight\": null, "
        "\"sound\": null, \"attenuation\": false}, \"flags\": {}},"
        "{\"c\": [0, 100, 900, 100], \"light\": 0, \"move\": 20, \"sight\": 0, \"sound\": 0},"
        "{\"c\": [0, 200, 900, 200], \"light\": 10, \"move\": 20, \"sight\": 10, \"sound\": 20},"
        "{\"c\": [0, 300, 900, 300], \"move\": 20, \"sight\": 20, \"door\": 1, \"ds\": 0, "
        "\"doorSound\": \"woodBasic\"},"
        "{\"c\": [0, 400, 900, 400], \"move\": 20, \"sight\": 20, \"door\": 2, \"ds\": 2},"
        "{\"c\": [0, 500, 900, 500], \"move\": 20, \"sight\": 20, \"dir\": 1}]}",
    };
    for (size_t i = 0; i < sizeof versions / sizeof *versions; i++)
        assert_scene(versions[i], "wall 0 500 900 500\n"
                                  "wall 0 400 900 400 stops steps\n"
                                  "wall 0 300 900 300 stops steps,sound,limited\n"
                                  "door door1 0 200 900 200 shut\ndoor door2 0 100 900 100 shut\n"
                                  "oneway 0 0 900 0\n");
}

// --- the edge

#define SCENE(size, walls, more) "{" size ", \"walls\": [" walls "]" more "}"
#define PLAIN                    "\"width\": 1000, \"height\": 800, \"padding\": 0"
#define W(c)                     "{\"c\": [" c "], \"move\": 20, \"sight\": 20}"
#define DOOR(c)                  "{\"c\": [" c "], \"move\": 20, \"sight\": 20, \"door\": 1}"
/// 300 to 700 by 200 to 600.
#define ROOM W("300, 200, 700, 200") "," W("700, 200, 700, 600") "," W("700, 600, 300, 600")
#define LEFT W("300, 600, 300, 200")
#define ROOM_TEXT(y, low, high)                                                                    \
    "wall 300 " high " 700 " high "\nwall 700 " high " 700 " low "\nwall 700 " low " 300 " low "\n"
#define EDGE_TEXT "wall 0 0 1000 0\nwall 1000 0 1000 800\nwall 0 800 1000 800\nwall 0 0 0 800\n"

static void test_edge(void **state) {
    (void)state;
    // Closed: rock lies beyond.
    assert_scene(SCENE(PLAIN, ROOM "," LEFT, ""), ROOM_TEXT(, "0", "400") "wall 300 0 300 400\n");
    // A door leads out, one side is open, a wall stands outside: the edge.
    assert_scene(SCENE(PLAIN, ROOM "," DOOR("300, 600, 300, 200"), ""),
                 ROOM_TEXT(, "200", "600") EDGE_TEXT "door door1 300 200 300 600 shut\n");
    assert_scene(SCENE(PLAIN, ROOM, ""), ROOM_TEXT(, "200", "600") EDGE_TEXT);
    assert_scene(
        SCENE(PLAIN, ROOM "," LEFT "," W("100, 100, 200, 100"), ""),
        ROOM_TEXT(, "200", "600") "wall 300 200 300 600\nwall 100 700 200 700\n" EDGE_TEXT);
    // Walls of one side only, windows and limited walls alone are a map.
    assert_scene(SCENE(PLAIN, "{\"c\": [300, 200, 700, 200], \"dir\": 2}", ""),
                 EDGE_TEXT "oneway 700 600 300 600\n");
    // Without a size there is none, and with a size that no wall is in.
    assert_scene("{\"walls\": [" ROOM "]}", ROOM_TEXT(, "0", "400"));
    assert_scene(SCENE("\"width\": 200, \"height\": 150, \"padding\": 0", ROOM, ""),
                 ROOM_TEXT(, "0", "400"));
    assert_scene(SCENE("\"width\": -1000, \"height\": 800", ROOM, ""), ROOM_TEXT(, "0", "400"));
    const char *empty = SCENE(PLAIN, "", "");
    assert_refused_of(sli_map_read_foundry, NULL, empty, strlen(empty), SL_BAD_INPUT,
                      "f: the scene has no walls, so nothing is hidden in it");
    // What has no length once y points up is left out.
    assert_scene("[" W("0, 100, 9, 100") ", {\"c\": [3, 0, 3, 5e-149], \"sight\": 0}]",
                 "precision 1.9984014443252818e-14\n"
                 "wall 0 0 9 0\n");
    const sl_import_options asked = {.layers = "walls,edge"}, off = {.layers = "walls"};
    const char *text = SCENE(PLAIN, ROOM "," LEFT, "");
    assert_walls_of(sli_map_read_foundry, &asked, text, strlen(text),
                    ROOM_TEXT(, "200", "600") "wall 300 200 300 600\nwall 0 0 1000 0\nwall 1000 0 "
                                              "1000 800\nwall 1000 800 0 800\nwall 0 800 0 0\n");
    text = SCENE(PLAIN, ROOM, "");
    assert_walls_of(sli_map_read_foundry, &off, text, strlen(text), ROOM_TEXT(, "0", "400"));
}

/// A passage from the left edge to a room with a door: its mouth is closed, and rock stays rock.
static void test_edge_of_passage(void **state) {
    (void)state;
    const char *text =
        SCENE(PLAIN,
              W("0, 380, 300, 380") "," W("0, 420, 300, 420") "," ROOM "," W(
                  "300, 200, 300, 380") "," W("300, 600, 300, 420") "," DOOR("500, 200, 500, 600"),
              "");
    assert_scene(text,
                 "wall 0 220 300 220\nwall 0 180 300 180\n" ROOM_TEXT(
                     , "0", "400") "wall 300 400 300 220\nwall 300 0 300 180\nwall 0 180 0 220\n"
                                   "door door1 500 400 500 0 shut\n");
    // Walls along the edge are enough.
    assert_scene(SCENE("\"width\": 400, \"height\": 400, \"padding\": 0",
                       W("0, 0, 400, 0") "," W("400, 0, 400, 400") "," W("400, 400, 0, 400") "," W(
                           "0, 400, 0, 0") "," DOOR("200, 0, 200, 400"),
                       ""),
                 "wall 0 400 400 400\nwall 400 400 400 0\nwall 400 0 0 0\nwall 0 0 0 400\n"
                 "door door1 200 400 200 0 shut\n");
}

/// The scene on its padded canvas, in the words of two versions; what does not say its padding.
static void test_edge_padded(void **state) {
    (void)state;
    static const char *const sizes[] = {
        "\"width\": 1000, \"height\": 800, \"padding\": 0.25, \"grid\": 150, \"shiftX\": 20, "
        "\"shiftY\": -10",
        "\"width\": 1000, \"height\": 800, \"padding\": 0.25, \"grid\": {\"size\": 150, \"type\": "
        "1}, "
        "\"background\": {\"offsetX\": 20, \"offsetY\": -10}",
    };
    for (size_t i = 0; i < 2; i++) { // padded by 300 both ways
        char text[512];
        snprintf(text, sizeof text, "{%s, \"walls\": [%s]}", sizes[i], W("500, 500, 700, 500"));
        assert_scene(text, "wall 500 610 700 610\nwall 280 0 1280 0\nwall 1280 0 1280 800\n"
                           "wall 280 800 1280 800\nwall 280 0 280 800\n");
    }
    // Foundry 12 pads scenes without a grid by whole pixels.
    assert_scene(
        "{\"width\": 1001, \"height\": 800, \"padding\": 0.25, \"grid\": {\"size\": 150, "
        "\"type\": 0, \"style\": \"solidLines\"}, \"walls\": [" W("500, 500, 700, 500") "]}",
        "wall 500 500 700 500\nwall 251 0 1252 0\nwall 1252 0 1252 800\n"
        "wall 251 800 1252 800\nwall 251 0 251 800\n");
    assert_scene("{\"width\": 1000, \"height\": 800, \"walls\": [" W("900, 900, 1200, 900") "]}",
                 "wall 900 100 1200 100\nwall 300 0 1300 0\nwall 1300 0 1300 800\n"
                 "wall 300 800 1300 800\nwall 300 0 300 800\n");
}

// --- starts

#define TOKEN(name, x, y) "{\"name\": \"" name "\", \"x\": " x ", \"y\": " y ", \"disposition\": 1}"
#define TOKENS(list)      ", \"grid\": 100, \"tokens\": [" list "]"
/// A closet of 60 by 60 in the lower right corner of the room.
#define CLOSET      W("640, 600, 640, 540") "," W("640, 540, 700, 540")
#define CLOSET_TEXT "wall 640 0 640 60\nwall 640 60 700 60\n"

static void test_starts(void **state) {
    (void)state;
    const char *const room = ROOM_TEXT(, "0", "400") "wall 300 0 300 400\n" CLOSET_TEXT;
    char expected[512];
    // The one in the closet is not believed, whatever its name, nor the one beyond the edge.
    snprintf(expected, sizeof expected, "%sstart 500 250 270\n", room);
    assert_scene(SCENE(PLAIN, ROOM "," LEFT "," CLOSET,
                       TOKENS(TOKEN("Player", "620", "520") "," TOKEN(
                           "Tester", "450", "300") "," TOKEN("Hero", "1100", "100"))),
                 expected);
    // Unless it is asked for.
    const sl_import_options named = {.start_names = "Player"};
    const char *text =
        SCENE(PLAIN, ROOM "," LEFT "," CLOSET,
              TOKENS(TOKEN("Player", "620", "520") "," TOKEN("Tester", "450", "300")));
    snprintf(expected, sizeof expected, "%sstart 670 30 270\n", room);
    assert_walls_of(sli_map_read_foundry, &named, text, strlen(text), expected);
    // A start outside: all that it reaches is inside.
    assert_scene(SCENE(PLAIN, ROOM "," LEFT, TOKENS(TOKEN("a", "50", "50"))),
                 ROOM_TEXT(, "200", "600") "wall 300 200 300 600\n" EDGE_TEXT
                                           "start 100 700 270\n");
}

// --- Universal VTT

#define POINT(x, y) "{\"x\": " x ", \"y\": " y "}"
#define TABLE(origin, body)                                                                        \
    "{\"format\": 0.3, \"resolution\": {\"map_origin\": " origin                                   \
    ", \"map_size\": " POINT("10", "8") ", \"pixels_per_grid\": 70}, " body "}"
#define FREE_WALL "\"line_of_sight\": [[" POINT("3", "3") ", " POINT("5", "3") "]]"

static void test_table_edge(void **state) {
    (void)state;
    assert_table(TABLE(POINT("0", "0"), FREE_WALL),
                 "wall 3 5 5 5\nwall 0 0 10 0\nwall 10 0 10 8\nwall 0 8 10 8\nwall 0 0 0 8\n");
    assert_table(TABLE(POINT("2.5", "-1.5"), FREE_WALL),
                 "wall 3 3.5 5 3.5\nwall 2.5 0 12.5 0\nwall 12.5 0 12.5 8\n"
                 "wall 2.5 8 12.5 8\nwall 2.5 0 2.5 8\n");
    // Walls from the corner of a map whose origin is far away.
    assert_table(
        TABLE(POINT("40", "20"), FREE_WALL),
        "wall 3 25 5 25\nwall 0 20 10 20\nwall 10 20 10 28\nwall 0 28 10 28\nwall 0 20 0 28\n");
    // Objects that stop sight are walls, too; a freestanding portal is a door.
    assert_table(
        TABLE(
            POINT("0", "0"),
            "\"line_of_sight\": [], \"objects_line_of_sight\": [[" POINT("3", "3") ", " POINT("5", "3") "]], \"portals\": [{\"position\": " POINT(
                "5.5",
                "3") ", \"bounds\": [" POINT("5",
                                             "3") ", " POINT("6",
                                                             "3") "], \"rotation\": 0, \"closed\": "
                                                                  "true, \"freestanding\": true}], "
                                                                  "\"environment\": "
                                                                  "{\"baked_lighting\": true}, "
                                                                  "\"lights\": [{\"range\": 4}], "
                                                                  "\"software\": \"DUNGEONFOG\""),
        "wall 3 5 5 5\nwall 0 0 10 0\nwall 10 0 10 8\nwall 0 8 10 8\nwall 0 0 0 8\n"
        "door door1 5 5 6 5 shut\n");
}

// --- what is written comes back

static void assert_back(sl_context *context, const sl_map *map, const char *name) {
    size_t count;
    const sl_map_format *formats = sl_map_formats(context, &count), *format = NULL;
    for (size_t i = 0; i < count; i++)
        if (strcmp(formats[i].name, name) == 0) format = &formats[i];
    assert_non_null(format);
    FILE *stream = tmpfile();
    assert_non_null(stream);
    assert_ok(context, format->write(context, map, stream));
    static char text[1 << 16];
    rewind(stream);
    const size_t size = fread(text, 1, sizeof text - 1, stream);
    text[size] = '\0';
    fclose(stream);
    sl_map back = {0};
    const sl_import_options usual = sl_import_options_default();
    assert_ok(context, format->read(context, "f", text, size, &usual, &back));
    char *was = map_walls_text(map), *is = map_walls_text(&back);
    assert_string_equal(is, was);
    free(was), free(is);
    sl_map_destroy(context, &back);
}

/// Open scenes, with all kinds of walls: no edge is added to what has one.
static void test_back(void **state) {
    (void)state;
    static const char *const scenes[] = {
        SCENE(PLAIN, W("100, 100, 200, 100"), ""),
        SCENE(PLAIN, DOOR("100, 100, 200, 100") "," W("100, 100, 100, 300"), ""),
        SCENE(PLAIN, "{\"c\": [100, 100, 200, 100], \"dir\": 1}", ""),
        SCENE(PLAIN, "{\"c\": [100, 100, 200, 100], \"sight\": 0}", ""),
        SCENE(PLAIN, "{\"c\": [100, 100, 200, 100], \"sight\": 10, \"move\": 0}", ""),
        SCENE(PLAIN, "{\"c\": [100, 100, 200, 100], \"sight\": 30}", ""),
        SCENE(PLAIN, "{\"c\": [100, 100, 200.5, 100], \"move\": 0}", TOKENS(TOKEN("a", "5", "5"))),
    };
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        sl_context *context = testing_context(NULL);
        const sl_import_options usual = sl_import_options_default();
        sl_map map = {0};
        assert_ok(context, sl_io_use(context));
        assert_ok(context,
                  sli_map_read_foundry(context, "f", scenes[i], strlen(scenes[i]), &usual, &map));
        assert_true(map.wall_count >= 4);
        assert_back(context, &map, "foundry");
        if (!map.oneway_count && !map.seam_count) assert_back(context, &map, "uvtt");
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
}

// --- files of several scenes

static void assert_names(const char *text, const char *expected) {
    sl_context *context = testing_context(NULL);
    sl_map_list list = {0};
    char names[256] = "";
    assert_ok(context, sli_map_list_foundry(context, "f", text, strlen(text), &list));
    for (size_t i = 0; i < list.count; i++)
        snprintf(names + strlen(names), sizeof names - strlen(names), "%s|", list.names[i]);
    assert_string_equal(names, expected);
    sl_map_list_destroy(context, &list);
    sl_context_destroy(context);
}

#define NAMED(name) "{\"name\": \"" name "\", \"walls\": [" W("0, 0, 9, 0") "]}"

static void test_names(void **state) {
    (void)state;
    assert_names(NAMED("Inn"), "Inn|");
    assert_names("[" W("0, 0, 9, 0") "]", "scene|");
    assert_names(
        "[" NAMED("Inn") ", " NAMED("inn:2") ", " NAMED("INN") ", " NAMED("") ", " NAMED("inn") "]",
        "Inn|inn:2|INN:3|scene|inn:4|");
    assert_names("{\"scenes\": [{\"walls\": []}, " NAMED("a\\tb") "]}", "a?b|");
    assert_names("[{\"scenes\": [" NAMED("x") "]}, {\"scenes\": [" NAMED("y") "]}]", "x|y|");
    assert_names(NAMED("a") "\n" NAMED("b") "\r\n\n", "a|b|");
    assert_refused_of(sli_map_read_foundry, NULL, "[{\"scenes\": [{\"walls\": []}]}]",
                      strlen("[{\"scenes\": [{\"walls\": []}]}]"), SL_BAD_INPUT,
                      "f: none of its 1 scene has walls");
}

// --- memory

static void test_memory(void **state) {
    (void)state;
    assert_memory_of(sli_map_read_foundry, NULL, NAMED("a") "\n" NAMED("b") "\n" NAMED("b"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_versions),
        cmocka_unit_test(test_edge),
        cmocka_unit_test(test_edge_of_passage),
        cmocka_unit_test(test_edge_padded),
        cmocka_unit_test(test_starts),
        cmocka_unit_test(test_table_edge),
        cmocka_unit_test(test_back),
        cmocka_unit_test(test_names),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

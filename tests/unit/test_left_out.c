// Windows and walls among what a drawing's layers and looks leave out.
#include "testing.h"

#include "import_check.h"
#include "io/io_formats.h"

#define HEAD "0\nSECTION\n2\nENTITIES\n"
#define TAIL "0\nENDSEC\n0\nEOF\n"
#define LINE(layer, x0, y0, x1, y1)                                                                \
    "0\nLINE\n8\n" layer "\n10\n" #x0 "\n20\n" #y0 "\n11\n" #x1 "\n21\n" #y1 "\n"
#define ARC(layer, x, y, r, from, to)                                                              \
    "0\nARC\n8\n" layer "\n10\n" #x "\n20\n" #y "\n40\n" #r "\n50\n" #from "\n51\n" #to "\n"
#define WALL(x0, y0, x1, y1)   "wall " #x0 " " #y0 " " #x1 " " #y1 "\n"
#define WINDOW(x0, y0, x1, y1) "wall " #x0 " " #y0 " " #x1 " " #y1 " stops steps,sound\n"
/// The outline of the walls of a room of 320 by 256, with a gap from (128,0) to (192,0).
#define ROOM(L)                                                                                    \
    L(128, 0, 0, 0)                                                                                \
    L(0, 0, 0, 256)                                                                                \
    L(0, 256, 320, 256)                                                                            \
    L(320, 256, 320, 0)                                                                            \
    L(320, 0, 192, 0)                                                                              \
    L(192, 0, 192, 8)                                                                              \
    L(192, 8, 312, 8)                                                                              \
    L(312, 8, 312, 248)                                                                            \
    L(312, 248, 8, 248) L(8, 248, 8, 8) L(8, 8, 128, 8) L(128, 8, 128, 0)
#define ON_WALLS(x0, y0, x1, y1) LINE("A-WALL", x0, y0, x1, y1)
#define PANES(layer)             LINE(layer, 128, 4, 192, 4) LINE(layer, 128, 6, 192, 6)
#define GLASS                    WINDOW(128, 4, 192, 4) WINDOW(128, 6, 192, 6)

static void assert_dxf(const char *entities, const char *layers, const char *expected,
                       const char *note) {
    char text[8192];
    sl_import_options options = sl_import_options_default();
    options.layers = layers;
    assert_true((size_t)snprintf(text, sizeof text, HEAD "%s" TAIL, entities) < sizeof text);
    assert_noted_of(sli_map_read_dxf, &options, text, strlen(text), expected, note);
}

/// Lines side by side from jamb to jamb are glass, in gaps of outer walls.
static void test_glass(void **state) {
    (void)state;
    assert_dxf(ROOM(ON_WALLS) PANES("0"), NULL, ROOM(WALL) GLASS,
               "lines side by side close 1 gap of outer walls: windows, which are seen through; "
               "--layers '0=ignore' leaves them out");
    assert_dxf(ROOM(ON_WALLS) PANES("0"), "0=ignore", ROOM(WALL), "passed over: 0");
    // A little too short, or into the walls.
    assert_dxf(ROOM(ON_WALLS) LINE("0", 129, 0, 191, 0) LINE("0", 124, 4, 196, 4), NULL,
               ROOM(WALL) WINDOW(129, 0, 191, 0) WINDOW(124, 4, 196, 4), "1 gap");
    // One line, also twice; far from the jambs; of an entrance; beside a door.
    assert_dxf(ROOM(ON_WALLS) LINE("0", 128, 4, 192, 4) LINE("0", 192, 4, 128, 4), NULL, ROOM(WALL),
               "passed over: 0");
    assert_dxf(ROOM(ON_WALLS) LINE("0", 144, 4, 192, 4) LINE("0", 144, 8, 192, 8), NULL, ROOM(WALL),
               "passed over: 0");
    assert_dxf(ROOM(ON_WALLS) PANES("Entrance"), NULL, ROOM(WALL), "passed over: Entrance");
    assert_dxf(ROOM(ON_WALLS) PANES("0") LINE("A-DOOR", 128, 0, 128, 64)
                   ARC("A-DOOR", 128, 0, 64, 0, 90),
               NULL, ROOM(WALL), "passed over: 0");
    // A niche: the other face of the wall goes on.
    assert_dxf(ROOM(ON_WALLS) LINE("A-WALL", 128, 8, 192, 8) PANES("0"), NULL,
               ROOM(WALL) WALL(128, 8, 192, 8), "passed over: 0");
    // A wall in front: the gap leads to another room.
    assert_dxf(ROOM(ON_WALLS) PANES("0") LINE("A-WALL", 0, -128, 320, -128), NULL,
               ROOM(WALL) WALL(0, -128, 320, -128), "passed over: 0");
}

/// Very many lines in a gap are not looked at.
static void test_crowded(void **state) {
    (void)state;
    static const char room[] = HEAD ROOM(ON_WALLS), pane[] = PANES("0");
    enum { PANES_IN_GAP = 2500 };
    const size_t size = sizeof room + PANES_IN_GAP * (sizeof pane - 1) + sizeof TAIL;
    char *text = malloc(size), *end = text;
    assert_non_null(text);
    end += snprintf(end, sizeof room, "%s", room);
    for (int i = 0; i < PANES_IN_GAP; i++) end += snprintf(end, sizeof pane, "%s", pane);
    snprintf(end, sizeof TAIL, "%s", TAIL);
    assert_noted_of(sli_map_read_dxf, NULL, text, strlen(text), ROOM(WALL), "passed over: 0");
    free(text);
}

/// Between columns, two lines may be the faces of a wall, and three are glass.
static void test_columns(void **state) {
    (void)state;
#define COLUMNS(L)                                                                                 \
    L(0, 0, 8, 0)                                                                                  \
    L(8, 0, 8, 8)                                                                                  \
    L(8, 8, 0, 8)                                                                                  \
    L(0, 8, 0, 0)                                                                                  \
    L(64, 0, 72, 0) L(72, 0, 72, 8) L(72, 8, 64, 8) L(64, 8, 64, 0) L(0, 256, 288, 256)
#define FACES LINE("0", 8, 0, 64, 0) LINE("0", 8, 8, 64, 8)
    assert_dxf(COLUMNS(ON_WALLS) FACES, NULL, COLUMNS(WALL), "passed over: 0");
    assert_dxf(COLUMNS(ON_WALLS) FACES LINE("0", 8, 4, 64, 4), NULL,
               COLUMNS(WALL) WINDOW(8, 0, 64, 0) WINDOW(8, 8, 64, 8) WINDOW(8, 4, 64, 4), "1 gap");
}

/// By looks, the lines of windows are thinner.
static void test_looks(void **state) {
    (void)state;
    static const char plan[] =
        "<svg xmlns='http://www.w3.org/2000/svg' width='100' height='80'>"
        "<path d='M40 80H0V0H100V80H60V77H97V3H3V77H40Z'/>"
        "<g fill='none' stroke='#888' stroke-width='.25'>"
        "<path d='M40 78H60'/><path d='M40 79H60'/>"
        "<path d='M10 10H20V15H10Z'/><path d='M30 10H40V15H30Z'/><path d='M50 10H60V15H50Z'/>"
        "<path d='M10 30H20V35H10Z'/><path d='M30 30H40V35H30Z'/><path d='M50 30H60V35H50Z'/>"
        "</g></svg>";
    static const char walls[] =
        WALL(40, 0, 0, 0) WALL(0, 0, 0, 80) WALL(0, 80, 100, 80) WALL(100, 80, 100, 0)
            WALL(100, 0, 60, 0) WALL(60, 0, 60, 3) WALL(60, 3, 97, 3) WALL(97, 3, 97, 77)
                WALL(97, 77, 3, 77) WALL(3, 77, 3, 3) WALL(3, 3, 40, 3) WALL(40, 3, 40, 0);
    char expected[1024];
    snprintf(expected, sizeof expected, "%s%s", walls, WINDOW(40, 2, 60, 2) WINDOW(40, 1, 60, 1));
    assert_noted_of(sli_map_read_svg, NULL, plan, strlen(plan), expected, "3 shapes give 14 walls");
    sl_import_options options = sl_import_options_default();
    options.layers = "#888888 line 0.25=ignore";
    assert_noted_of(sli_map_read_svg, &options, plan, strlen(plan), walls, "give 12 walls");
}

/// Windows of a layer that is taken as walls, too, are counted once.
static void test_glass_and_walls(void **state) {
    (void)state;
#define OPEN_ROOM(L)                                                                               \
    L(128, 256, 0, 256)                                                                            \
    L(0, 256, 0, 0)                                                                                \
    L(128, 256, 128, 248)                                                                          \
    L(320, 0, 320, 256) L(320, 256, 192, 256) L(192, 256, 192, 248) L(128, 160, 192, 160)
#define PARTS(L)                                                                                   \
    L(0, 0, 320, 0) L(96, 0, 96, 256) L(192, 0, 192, 160) L(192, 128, 320, 128) L(0, 96, 96, 96)
#define ON_NEW(x0, y0, x1, y1) LINE("New", x0, y0, x1, y1)
#define NEW_PANES(L)           L(128, 250, 192, 250) L(128, 252, 192, 252)
    assert_dxf(OPEN_ROOM(ON_WALLS) NEW_PANES(ON_NEW) PARTS(ON_NEW), NULL,
               OPEN_ROOM(WALL) PARTS(WALL) NEW_PANES(WINDOW), "14 entities give 14 walls");
}

/// Layers that part rooms are taken where it is in doubt what is inside; else they are named.
static void test_chains(void **state) {
    (void)state;
#define SIDES(L)             L(0, 0, 0, 256) L(0, 256, 320, 256) L(320, 256, 320, 0)
#define INNER(L)             L(96, 0, 96, 256) L(192, 0, 192, 256) L(96, 128, 192, 128) L(192, 160, 320, 160)
#define ON_X(x0, y0, x1, y1) LINE("X", x0, y0, x1, y1)
    assert_dxf(SIDES(ON_WALLS) ON_X(0, 0, 320, 0) INNER(ON_X), NULL,
               SIDES(WALL) WALL(0, 0, 320, 0) INNER(WALL),
               "X: 5 lines part rooms, and with them it is plain what is inside: taken as walls; "
               "--layers 'X=ignore' leaves them out");
    assert_dxf(SIDES(ON_WALLS) ON_X(0, 0, 320, 0) INNER(ON_X), "X=ignore", SIDES(WALL),
               "passed over: X (other)");
    assert_dxf(SIDES(ON_WALLS) LINE("A-WALL", 0, 0, 320, 0) INNER(ON_X), NULL,
               SIDES(WALL) WALL(0, 0, 320, 0),
               "X: passed over, but 4 of its lines stand as walls do: if they are walls: "
               "--layers 'X=wall'");
    assert_dxf(SIDES(ON_WALLS) LINE("A-WALL", 0, 0, 320, 0) INNER(ON_X), "X=wall",
               SIDES(WALL) WALL(0, 0, 320, 0) INNER(WALL), "");
}

static void assert_no_walls(const char *lines) {
    char notes[4096] = "", text[8192];
    const sl_hooks hooks = {.user = notes, .note = import_keep_notes};
    sl_context *context = sl_context_create(&hooks);
    const sl_import_options usual = sl_import_options_default();
    sl_map map = {0};
    assert_non_null(context);
    snprintf(text, sizeof text, HEAD "%s%s%s" TAIL, SIDES(ON_WALLS), LINE("A-WALL", 0, 0, 320, 0),
             lines);
    assert_ok(context, sli_map_read_dxf(context, "f", text, strlen(text), &usual, &map));
    assert_int_equal(map.wall_count, 4);
    if (strstr(notes, "stand as walls")) fail_msg("%s: %s", lines, notes);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// What goes from wall to wall, but parts no rooms.
static void test_no_walls(void **state) {
    (void)state;
    // Counters along walls, steps, axes through walls, furniture, lines with a free end.
    assert_no_walls(ON_X(0, 248, 320, 248) ON_X(0, 8, 320, 8) ON_X(8, 0, 8, 256)
                        ON_X(312, 0, 312, 256));
    assert_no_walls(ON_X(0, 128, 320, 128) ON_X(0, 132, 320, 132) ON_X(0, 136, 320, 136)
                        ON_X(0, 140, 320, 140) ON_X(0, 144, 320, 144));
    assert_no_walls(ON_X(96, -32, 96, 288) ON_X(192, -32, 192, 288) ON_X(-32, 96, 352, 96)
                        ON_X(-32, 192, 352, 192));
    assert_no_walls(ON_X(96, 96, 192, 96) ON_X(192, 96, 192, 192) ON_X(192, 192, 96, 192)
                        ON_X(96, 192, 96, 96));
    assert_no_walls(ON_X(96, 0, 96, 224) ON_X(192, 0, 192, 224) ON_X(256, 0, 256, 224)
                        ON_X(96, 160, 160, 160));
    // A fifth of the layer.
    assert_no_walls(INNER(ON_X) ON_X(32, -288, 288, -288) ON_X(32, -608, 288, -608)
                        ON_X(32, -928, 288, -928) ON_X(32, -1248, 288, -1248)
                            ON_X(32, -1568, 288, -1568) ON_X(32, -1888, 288, -1888)
                                ON_X(32, -2208, 288, -2208) ON_X(32, -2528, 288, -2528));
}

/// Lines side by side, at which walls end.
static void test_pairs(void **state) {
    (void)state;
#define RING(L)                                                                                    \
    L(0, 0, 320, 0)                                                                                \
    L(320, 0, 320, 256)                                                                            \
    L(320, 256, 0, 256)                                                                            \
    L(0, 256, 0, 0)                                                                                \
    L(4, 4, 316, 4)                                                                                \
    L(316, 4, 316, 252) L(316, 252, 4, 252) L(4, 252, 4, 4)
#define BETWEEN(L) L(96, 4, 96, 252) L(192, 4, 192, 252) L(192, 128, 316, 128)
    assert_dxf(BETWEEN(ON_WALLS) RING(ON_X), NULL, BETWEEN(WALL) RING(WALL),
               "X: 8 lines part rooms");
}

static void test_memory(void **state) {
    (void)state;
    assert_memory_of(sli_map_read_dxf, NULL, HEAD ROOM(ON_WALLS) PANES("0") TAIL);
    assert_memory_of(sli_map_read_dxf, NULL,
                     HEAD SIDES(ON_WALLS) ON_X(0, 0, 320, 0) ON_X(96, 0, 96, 224)
                         ON_X(192, 0, 192, 224) ON_X(96, 160, 160, 160) TAIL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_glass),           cmocka_unit_test(test_crowded),
        cmocka_unit_test(test_glass_and_walls), cmocka_unit_test(test_columns),
        cmocka_unit_test(test_looks),           cmocka_unit_test(test_chains),
        cmocka_unit_test(test_no_walls),        cmocka_unit_test(test_pairs),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

// Closed objects and shapes of tiles in Tiled maps: their insides are solid ground, but for those
// that are drawn round a room. Squares without tiles beside them.
#include "testing.h"

#include "import_check.h"
#include "io/io_formats.h"
#include "sightline/space.h"

#include <math.h>

#define SIZE            " width='12' height='8' "
#define MAP(body)       "<map" SIZE "tilewidth='8' tileheight='8'>\n" body "</map>"
#define SOLID(body)     "<objectgroup name='collision'>" body "</objectgroup>"
#define THINGS(body)    "<objectgroup name='things'>" body "</objectgroup>"
#define BOX(x, y, w, h) "<object x='" x "' y='" y "' width='" w "' height='" h "'/>"
#define ROUND(x, y, w, h)                                                                          \
    "<object x='" x "' y='" y "' width='" w "' height='" h "'><ellipse/></object>"
#define DRAWN(x, y, kind, points)                                                                  \
    "<object x='" x "' y='" y "'><" kind " points='" points "'/></object>"
#define START(x, y) "<object name='start' x='" x "' y='" y "'><point/></object>"
#define SET         "<tileset firstgid='1' tilewidth='8' tileheight='8'/>"
#define LAYER(name, rows)                                                                          \
    "<layer name='" name "'" SIZE "><data encoding='csv'>" rows "</data></layer>"

/// How much of the plan is inside, open beyond it, and solid, in squares of 8 pixels.
typedef struct share {
    double inside, outside, solid;
} share;

static share read_share(const char *text, const char *layers) {
    sl_context *context = testing_context(NULL);
    const sl_import_options options = {.layers = layers};
    sl_map map = {0};
    sl_space space = {0};
    share all = {0};
    assert_ok(context, sli_map_read_tmx(context, "f", text, strlen(text), &options, &map));
    assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
    assert_ok(context, sl_map_find_inside(context, &map, NULL, NULL));
    assert_ok(context, sl_subdivision_for(&map)->subdivide(context, &map, NULL, &space));
    assert_ok(context, sl_space_check(context, &space));
    for (uint32_t i = 0; i < space.cell_count; i++) {
        const sl_cell *cell = &space.cells[i];
        double *to = cell->solid ? &all.solid : cell->inside ? &all.inside : &all.outside;
        *to += sl_space_area(&space, i) / 64;
    }
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    return all;
}

static void assert_share(const char *text, double inside, double outside, double solid) {
    const share all = read_share(text, NULL);
    if (fabs(all.inside - inside) > 1e-9 || fabs(all.outside - outside) > 1e-9 ||
        fabs(all.solid - solid) > 1e-9)
        fail_msg("%g inside, %g outside, %g solid: expected %g, %g, %g of %s", all.inside,
                 all.outside, all.solid, inside, outside, solid, text);
}

/// Rectangles, polygons and ellipses are solid inside; they may overlap, and lie at the edge.
static void test_solid(void **state) {
    (void)state;
    assert_share(MAP(SOLID(BOX("16", "16", "16", "16"))), 92, 0, 4);
    assert_share(MAP(SOLID(BOX("16", "16", "16", "16") BOX("24", "24", "16", "16"))), 89, 0, 7);
    assert_share(MAP(SOLID(BOX("0", "0", "96", "8") BOX("0", "0", "8", "64"))), 77, 0, 19);
    assert_share(MAP(SOLID(DRAWN("16", "16", "polygon", "0,0 16,0 0,16"))), 94, 0, 2);
    assert_share(MAP(SOLID(DRAWN("16", "16", "polygon", "0,0 0,16 16,0"))), 94, 0, 2);
    const share round = read_share(MAP(SOLID(ROUND("16", "16", "16", "16"))), NULL);
    assert_true(round.solid > 3.1 && round.solid < 3.2);
    // A line is none, closed or not.
    assert_share(MAP(SOLID(DRAWN("16", "16", "polyline", "0,0 16,0 16,16 0,16 0,0"))), 4, 0, 0);
    // Solid tiles may lie under objects.
    assert_share(MAP(SET LAYER("collision", "0,0,0,0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0,0,0,0,0,0,0, "
                                            "0,0,1,0,0,0,0,0,0,0,0,0, 0,0,1,1,0,0,0,0,0,0,0,0, "
                                            "0,0,0,0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0,0,0,0,0,0,0, "
                                            "0,0,0,0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0,0,0,0,0,0,0")
                         THINGS("<object type='wall' x='16' y='16' width='8' height='24'/>")),
                 92, 0, 4);
    assert_share(MAP(SOLID(BOX("16", "16", "16", "16")) THINGS(START("80", "40"))), 92, 0, 4);
}

/// Drawn round a room, objects are its walls.
static void test_outlines(void **state) {
    (void)state;
    // A start in it, or a door over it.
    assert_share(
        MAP(SOLID(BOX("16", "16", "32", "32") BOX("64", "8", "8", "8")) THINGS(START("20", "20"))),
        16, 79, 1);
    assert_share(MAP(SOLID(BOX("16", "16", "32", "32") BOX("64", "8", "8", "8"))
                         THINGS("<object name='door' x='44' y='24' width='8' height='8'/>")),
                 95, 0, 1);
    // More than half of the map.
    assert_share(MAP(SOLID(BOX("8", "8", "80", "48"))), 60, 0, 0);
    // Another one in a polygon; most others in a rectangle, and not one of three.
    assert_share(
        MAP(SOLID(DRAWN("16", "16", "polygon", "0,0 32,0 32,32 0,32") BOX("24", "24", "8", "8"))),
        95, 0, 1);
    assert_share(MAP(SOLID(BOX("16", "16", "32", "32") BOX("24", "24", "8", "8"))), 95, 0, 1);
    assert_share(MAP(SOLID(BOX("16", "16", "32", "32") BOX("24", "24", "8", "8")
                               BOX("64", "8", "8", "8") BOX("64", "24", "8", "8"))),
                 78, 0, 18);
    // A polygon that crosses itself has no inside of its own.
    assert_share(
        MAP(SOLID(DRAWN("16", "16", "polygon", "0,0 16,16 16,0 0,16") BOX("64", "8", "8", "8"))),
        95, 0, 1);
}

/// Nothing is beyond the map where it has an end: without one, or with objects beyond its edge, the
/// objects alone are the map.
static void test_page(void **state) {
    (void)state;
    const char *infinite = "<map infinite='1'" SIZE "tilewidth='8' tileheight='8'>" SOLID(
        BOX("16", "16", "8", "8") BOX("40", "16", "8", "8")) "</map>";
    assert_share(infinite, 2, 0, 2);
    assert_share(MAP(SOLID(BOX("-8", "16", "16", "8") BOX("16", "16", "8", "8"))), 1, 0, 3);
    assert_share(MAP(SOLID(BOX("0", "16", "16", "8") BOX("24", "16", "8", "8"))), 93, 0, 3);
}

#define SHAPED                                                                                     \
    "<tileset firstgid='1' tilewidth='8' tileheight='8'><tile id='0'><objectgroup>" BOX(           \
        "0", "0", "8", "4") "</objectgroup></tile></tileset>"
#define NONE "0,0,0,0,0,0,0,0,0,0,0,0"

/// So are shapes that tiles collide with.
static void test_shapes_of_tiles(void **state) {
    (void)state;
    assert_share(MAP(SHAPED LAYER("a", "0,0,0,0,0,0,0,0,0,0,0,0, 0,0,1,1,0,0,0,0,0,0,0,0, " NONE
                                       ", " NONE ", " NONE ", " NONE ", " NONE ", " NONE)),
                 95, 0, 1);
}

#define DIAMONDS(body)                                                                             \
    "<map orientation='isometric'" SIZE "tilewidth='16' tileheight='8'>\n" SET LAYER(              \
        "collision", NONE ", " NONE ", " NONE ", " NONE ", " NONE ", " NONE ", " NONE              \
                          ", 0,0,0,0,0,0,0,0,0,0,0,1") body "</map>"
#define TWO        SOLID(BOX("16", "16", "32", "32") BOX("64", "8", "8", "8"))
#define DOOR(x, y) "<object name='door' x='" x "' y='" y "' width='8' height='8'/>"

/// The same where tiles are diamonds, each as large as a square of the plan. One tile is solid.
static void test_diamonds(void **state) {
    (void)state;
    assert_true(read_share(DIAMONDS(TWO), NULL).inside == 78);
    assert_true(read_share(DIAMONDS(TWO THINGS(START("40", "8"))), NULL).inside == 78);
    assert_true(read_share(DIAMONDS(TWO THINGS(DOOR("52", "24"))), NULL).inside == 78);
    // A start in it, or a door over it.
    assert_true(read_share(DIAMONDS(TWO THINGS(START("20", "40"))), NULL).inside == 16);
    assert_true(read_share(DIAMONDS(TWO THINGS(DOOR("44", "24"))), NULL).inside == 94);
}

#define FLOORS                                                                                     \
    NONE ", 0,0,0,0,0,0,0,0,0,0,0,0, 0,0,1,1,1,1,0,0,0,0,0,0, 0,0,1,1,1,1,0,0,0,0,0,0, "           \
         "0,0,1,1,1,1,0,0,0,0,0,0, " NONE ", " NONE ", " NONE
#define WALLS                                                                                      \
    NONE ", 0,1,1,1,1,1,1,0,0,0,0,0, 0,1,0,0,0,0,1,0,0,0,0,0, 0,1,0,0,0,0,1,0,0,0,0,0, "           \
         "0,1,0,0,0,0,1,0,0,0,0,0, 0,1,1,1,1,1,1,0,0,0,0,0, " NONE ", " NONE
/// The same, open at its top.
#define LINES                                                                                      \
    NONE ", 0,1,0,0,0,0,1,0,0,0,0,0, 0,1,0,0,0,0,1,0,0,0,0,0, 0,1,0,0,0,0,1,0,0,0,0,0, "           \
         "0,1,0,0,0,0,1,0,0,0,0,0, 0,1,1,1,1,1,1,0,0,0,0,0, " NONE ", " NONE

#define FULL                                                                                       \
    "1,1,1,1,1,1,1,1,1,1,1,1, 1,1,1,1,1,1,1,1,1,1,1,1, 1,1,1,1,1,1,1,1,1,1,1,1, "                  \
    "1,1,1,1,1,1,1,1,1,1,1,1, 1,1,1,1,1,1,1,1,1,1,1,1, 1,1,1,1,1,1,1,1,1,1,1,1, "                  \
    "1,1,1,1,1,1,1,1,1,1,1,1, 1,1,1,1,1,1,1,1,1,1,1,1"

/// A room of 2 x 2 squares in a map of 96.
#define SMALL_ROOM                                                                                 \
    "1,1,1,1,0,0,0,0,0,0,0,0, 1,1,1,1,0,0,0,0,0,0,0,0, 1,1,1,1,0,0,0,0,0,0,0,0, "                  \
    "1,1,1,1,0,0,0,0,0,0,0,0, " NONE ", " NONE ", " NONE ", " NONE

/// Squares without tiles at the edge are solid where walls part them from all floor, unless a start
/// says what is inside. One layer of floor is walled by its gaps, though a layer of walls is empty.
static void test_void(void **state) {
    (void)state;
    assert_share(MAP(SET LAYER("base", FLOORS) LAYER("walls", WALLS)), 12, 0, 0);
    assert_share(MAP(SET LAYER("base", FLOORS) LAYER("walls", WALLS) THINGS(START("28", "28"))), 12,
                 66, 18);
    assert_share(
        MAP(SET LAYER("floor", FLOORS) LAYER("walls", NONE ", " NONE ", " NONE ", " NONE ", " NONE
                                                           ", " NONE ", " NONE ", " NONE)),
        12, 0, 0);
    // So is the sea about an island; not a meadow.
    assert_share(MAP(SET LAYER("Ocean", FULL) LAYER("base", FLOORS) LAYER("walls", WALLS)), 12, 0,
                 0);
    assert_share(MAP(SET LAYER("Grass", FULL) LAYER("base", FLOORS) LAYER("walls", WALLS)), 78, 0,
                 18);
    // A room may be small against the map.
    assert_share(MAP(SET LAYER("map", SMALL_ROOM) SOLID(BOX("0", "0", "32", "8") BOX(
                     "0", "24", "32", "8") BOX("0", "0", "8", "32") BOX("24", "0", "8", "32"))),
                 4, 0, 12);
    // A door parts it from what is beyond.
    assert_share(MAP(SET LAYER("map", SMALL_ROOM) SOLID(
                     BOX("0", "0", "32", "8") BOX("0", "24", "8", "8") BOX("16", "24", "16", "8")
                         BOX("0", "0", "8", "32") BOX("24", "0", "8", "32"))
                         THINGS("<object type='door' x='8' y='24' width='8' height='8'/>")),
                 5, 0, 11);
    // Tiles under a solid object are no floor: the rest of this platformer is air.
    assert_share(MAP(SET LAYER("terrain", NONE ", " NONE ", " NONE ", " NONE ", " NONE ", " NONE
                                               ", 1,1,1,1,1,1,1,1,0,0,0,0, 1,1,1,1,1,1,1,1,0,0,0,0")
                         SOLID(BOX("0", "48", "64", "16"))),
                 80, 0, 16);
}

#define WIDE               "1,1,1,1,1,1,1,1,1,0,0,0"
#define HOLED              "1,0,1,0,1,0,1,0,1,0,0,0"
#define LINE(x, y, points) DRAWN(x, y, "polyline", points)
#define RAIL(x, y)         LINE(x, y, "0,0 8,0 8,8 0,8 0,0")
#define RAILS(y)           RAIL("8", y) RAIL("24", y) RAIL("40", y) RAIL("56", y)

/// Squares at the edge are solid where one place in ten is open, and not at more. The border of
/// holes among rooms does not count, and a wall parts only squares that it lies between.
static void test_void_with_openings(void **state) {
    (void)state;
    // 10 places, of them 1 open, and 2.
    const char *corner = "1,1,1,1,1,1,0,0,0,0,0,0";
    char text[2][4000];
    for (int i = 0; i < 2; i++) {
        snprintf(text[i], sizeof text[i],
                 "<map" SIZE "tilewidth='8' tileheight='8'>" SET "<layer name='base'" SIZE
                 "><data encoding='csv'>%s,%s,%s,%s," NONE "," NONE "," NONE "," NONE
                 "</data></layer>" SOLID(LINE("48", "0", "0,0 0,32 %s,32")) "</map>",
                 corner, corner, corner, corner, i ? "-32" : "-40");
    }
    assert_true(read_share(text[0], NULL).inside == 24);
    assert_true(read_share(text[1], NULL).inside != 24);
    // 4 places of 8 are open; with those of 12 holes it would be 4 of 56.
    const share holes =
        read_share(MAP(SET LAYER("base", WIDE ", " HOLED ", " WIDE ", " HOLED ", " WIDE ", " HOLED
                                              ", " WIDE ", " WIDE)
                           SOLID(LINE("72", "0", "0,0 0,32") RAILS("8") RAILS("24") RAILS("40"))),
                   NULL);
    assert_true(holes.inside == 96);
    // 1 place of 8 is open. A wall elsewhere lies in line with it.
    const share line =
        read_share(MAP(SET LAYER("base", WIDE ", " WIDE ", " WIDE ", " WIDE ", " WIDE ", " WIDE
                                              ", " WIDE ", " WIDE)
                           SOLID(LINE("72", "8", "0,0 0,56") LINE("0", "4", "0,0 8,0"))),
                   NULL);
    assert_true(line.inside == 96);
}

/// Where nothing says what is solid, and tiles lie as floors of rooms do, the command names void.
static void test_refused(void **state) {
    (void)state;
    const char *text = MAP(SET LAYER("a", FLOORS));
    assert_refused_of(
        sli_map_read_tmx, NULL, text, strlen(text), SL_BAD_INPUT,
        "f:1: nothing in it says what is solid; to take the squares without tiles as "
        "solid: sightline check 'f' --layers void -o map.png; layers: 'a' (12 tiles)");
    const share all = read_share(text, "void");
    assert_true(all.inside == 12 && all.outside == 0);
    // Thin lines of tiles are walls, and no floor.
    const char *lines = MAP(SET LAYER("a", LINES));
    assert_refused_of(sli_map_read_tmx, NULL, lines, strlen(lines), SL_BAD_INPUT,
                      "f:1: nothing in it says what is solid; to take a layer as solid: sightline "
                      "check 'f' --layers 'a' "
                      "-o map.png; layers: 'a' (14 tiles)");
}

#define GROUND                                                                                     \
    NONE ", 0,0,0,1,1,0,0,0,0,0,0,0, " NONE ", 0,0,0,0,0,0,1,1,0,0,0,0, " NONE ", "                \
         "1,1,1,1,0,0,0,0,0,0,0,0, " NONE ", 1,1,1,0,0,0,0,0,0,0,0,0"
#define THING(x, y) "<object x='" x "' y='" y "'><point/></object>"

/// Where nothing says what is solid, three objects tell: they stand where one can stand.
static void test_where_objects_stand(void **state) {
    (void)state;
    assert_share(MAP(SET LAYER("a", GROUND) THINGS(THING("4", "4") THING("12", "20") THING(
                     "60", "36") BOX("0", "0", "90", "60"))),
                 85, 0, 11);
    assert_share(
        MAP(SET LAYER("a", FLOORS) THINGS(THING("20", "20") THING("28", "28") THING("36", "36"))),
        12, 0, 0);
    const char *texts[] = {
        MAP(SET LAYER("a", FLOORS) THINGS(THING("20", "20") THING("28", "28"))),
        MAP(SET LAYER("a", FLOORS) THINGS(THING("20", "20") THING("28", "28") THING("4", "4")))};
    for (int i = 0; i < 2; i++)
        assert_refused_of(sli_map_read_tmx, NULL, texts[i], strlen(texts[i]), SL_BAD_INPUT,
                          "f:1: nothing in it says what is solid");
}

#define BOXES BOX("0", "0", "8", "8") BOX("16", "0", "8", "8") BOX("32", "0", "8", "8")

/// Four objects or more of which nothing is said, half of their layer, are solid where nothing else
/// is.
static void test_bare_objects(void **state) {
    (void)state;
    const char *exit = "<object name='exit' x='80' y='40' width='8' height='8'/>";
    char text[4000];
    snprintf(text, sizeof text, "%s%s%s",
             "<map width='12' height='8' tilewidth='8' tileheight='8'>" SET LAYER(
                 "a", FULL) "<objectgroup name='Objects'>" BOXES BOX("48", "0", "8", "8"),
             exit, "</objectgroup></map>");
    assert_share(text, 92, 0, 4);
    const char *texts[] = {MAP(SET LAYER("a", FULL) THINGS(BOXES)),
                           MAP(SET LAYER("a", FULL) "<objectgroup name='zones'>" BOXES BOX(
                               "48", "0", "8", "8") "</objectgroup>")};
    for (int i = 0; i < 2; i++)
        assert_refused_of(sli_map_read_tmx, NULL, texts[i], strlen(texts[i]), SL_BAD_INPUT,
                          "f:1: nothing in it says what is solid");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_solid),
        cmocka_unit_test(test_outlines),
        cmocka_unit_test(test_page),
        cmocka_unit_test(test_shapes_of_tiles),
        cmocka_unit_test(test_diamonds),
        cmocka_unit_test(test_void),
        cmocka_unit_test(test_void_with_openings),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_bare_objects),
        cmocka_unit_test(test_where_objects_stand),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

// Tiled maps in both notations: all ways to write tiles, what says that something is solid,
// objects, chunks, tilesets in files of their own, and what is refused.
#include "testing.h"

#include "import_check.h"
#include "io/io_formats.h"
#include "io/parts/names.h"
#include "sightline/io.h"
#include "sightline/space.h"
#include "space/subdivide.h"

#include <sys/stat.h>
#include <unistd.h>

// The tiles 0 1 1 / 0 0 0; the third is mirrored.
#define RAW               "AAAAAAEAAAABAACAAAAAAAAAAAAAAAAA"
#define ZLIB              "eJxjYGBgYITgBgYkAAAGvACD"
#define GZIP              "H4sIAAAAAAACA2NgYGBghOAGBiQAAOBFpMgYAAAA"
#define ZSTD              "KLUv/QRYfQAAOAAAAAABgAACADiDH5wWV9Vy0Q=="
#define SIZE              " width='3' height='2' "
#define MAP(body)         "<map" SIZE "tilewidth='8' tileheight='8'>\n" body "</map>"
#define SET               "<tileset firstgid='1' tilewidth='8' tileheight='8'/>"
#define LAYER(name, data) "<layer name='" name "'" SIZE ">\n" data "</layer>"
#define DATA(how, text)   "<data " how ">" text "</data>"
#define CSV(text)         DATA("encoding='csv'", text)
#define TRUE(name)        "<properties><property name='" name "' type='bool' value='true'/></properties>"
#define FALSE(name)       "<properties><property name='" name "' type='bool' value='false'/></properties>"

/// The walls of two solid tiles at the upper right, with those about the map.
#define TWO_TILES                                                                                  \
    "wall 0 16 8 16\nwall 8 8 24 8\nwall 8 8 8 16\nwall 0 0 24 0\nwall 0 0 0 16\nwall 24 0 24 8\n"
#define FRAME "wall 0 16 24 16\nwall 0 0 24 0\nwall 0 0 0 16\nwall 24 0 24 16\n"

static void assert_walls(const char *text, const char *expected) {
    assert_walls_of(sli_map_read_tmx, NULL, text, strlen(text), expected);
}

static void assert_walls_json(const char *text, const char *expected) {
    assert_walls_of(sli_map_read_tmj, NULL, text, strlen(text), expected);
}

static void assert_chosen(const char *layers, const char *text, const char *expected) {
    const sl_import_options options = {.layers = layers};
    assert_walls_of(sli_map_read_tmx, &options, text, strlen(text), expected);
}

static void assert_refused(const char *text, const char *message) {
    assert_refused_of(sli_map_read_tmx, NULL, text, strlen(text), SL_BAD_INPUT, message);
}

static void assert_refused_json(const char *text, const char *message) {
    assert_refused_of(sli_map_read_tmj, NULL, text, strlen(text), SL_BAD_INPUT, message);
}

static void assert_not_chosen(const char *layers, const char *text, const char *message) {
    const sl_import_options options = {.layers = layers};
    assert_refused_of(sli_map_read_tmx, &options, text, strlen(text), SL_BAD_ARGUMENT, message);
}

static void test_encodings(void **state) {
    (void)state;
    static const char *const data[] = {
        DATA("", "<tile gid='0'/><tile gid='1'/><tile gid='2147483649'/><tile/><tile/><tile/>"),
        CSV("\n0,1,2147483649,\n0,0,0\n"),
        CSV("0,1,2147483649,0,0,0,"),
        DATA("encoding='base64'", "\n  " RAW "\n"),
        DATA("encoding='base64' compression=''", RAW),
        DATA("encoding='base64' compression='zlib'", ZLIB),
        DATA("encoding='base64' compression='gzip'", GZIP),
        DATA("encoding='base64' compression='zstd'", "\n" ZSTD),
    };
    for (size_t i = 0; i < sizeof data / sizeof *data; i++) {
        char text[1024];
        snprintf(text, sizeof text, MAP(SET LAYER("walls", "%s")), data[i]);
        assert_walls(text, TWO_TILES);
    }
}

#define JSON(layers)                                                                               \
    "{\"width\": 3, \"height\": 2, \"tilewidth\": 8, \"tileheight\": 8, \"tilesets\": [{"          \
    "\"firstgid\": 1, \"tilewidth\": 8, \"tileheight\": 8}],\n\"layers\": [" layers "]}"
#define JSON_LAYER(data)                                                                           \
    "{\"type\": \"tilelayer\", \"name\": \"walls\", \"width\": 3, \"height\": 2, " data "}"

static void test_json(void **state) {
    (void)state;
    assert_walls_json(JSON(JSON_LAYER("\"data\": [0, 1, 2147483649, 0, 0, 0]")), TWO_TILES);
    assert_walls_json(JSON(JSON_LAYER("\"encoding\": \"base64\", \"data\": \"" RAW "\"")),
                      TWO_TILES);
    assert_walls_json(JSON(JSON_LAYER("\"encoding\": \"base64\", \"compression\": \"zstd\", "
                                      "\"data\": \"" ZSTD "\"")),
                      TWO_TILES);
    assert_walls_json(JSON("{\"type\": \"group\", \"name\": \"Walls\", \"layers\": [{\"type\": "
                           "\"objectgroup\", \"objects\": [{\"x\": 1, \"y\": 2, \"polyline\": "
                           "[{\"x\": 0, \"y\": 0}, {\"x\": 3, \"y\": 4}]}]}]}"),
                      "wall 1 14 4 10\n");
    assert_refused_json(JSON("{\"type\": "), "f:2: column ");
    assert_refused_json("[]", "f: expected an object, found an array");
    assert_refused_json(JSON("7"), "f: layers[0]: expected an object, found 7");
    assert_refused_json(JSON(JSON_LAYER("\"data\": [0, 1]")),
                        "f: layers[0].data: 2 tiles, the layer has 6");
    assert_refused_json(JSON(JSON_LAYER("\"data\": [0, 1, 2, 3, -4, 5]")),
                        "f: layers[0].data[4]: -4 is out of range");
    assert_refused_json(JSON(JSON_LAYER("\"data\": [0, 1, 2, 3, \"4\", 5]")),
                        "f: layers[0].data[4]: expected a whole number, found '4'");
    assert_refused_json(JSON(JSON_LAYER("\"offsetx\": 1e308, \"data\": []")),
                        "f: layers[0].offsetx: 1e+308 is out of range");
    assert_refused_json(JSON(JSON_LAYER("\"offsetx\": 1e400, \"data\": []")), "f:2: column ");
    assert_refused_json(JSON(JSON_LAYER("\"offsetx\": NaN, \"data\": []")), "f:2: column ");
}

static void test_names_that_say_solid(void **state) {
    (void)state;
    static const char *const solid[] = {
        "walls",     "Wall",           "WALLS",           "Collision Layer 1", "solid",
        "obstacles", "CollisionLayer", "collision_boxes", "blocking",          "wallTiles",
        "Collisons", "colission",      "Kollisionen",     "Colisiones",        "collisoni"};
    static const char *const others[] = {"",          "Floor",   "wall_tops",    "wallpaper",
                                         "layer",     "unsolid", "Wand\xc3\xa4", "walls behind",
                                         "Colliseum", "Collins", "colons"};
    for (size_t i = 0; i < sizeof solid / sizeof *solid; i++)
        if (!sli_says_solid(solid[i])) fail_msg("%s", solid[i]);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (sli_says_solid(others[i])) fail_msg("%s", others[i]);
}

static void test_layers_that_are_solid(void **state) {
    (void)state;
#define TILES CSV("0,1,1,0,0,0")
    assert_walls(MAP(SET LAYER("a", TRUE("solid") TILES)), TWO_TILES);
    assert_walls(MAP(SET "<layer name='a' class='Wall'" SIZE ">" TILES "</layer>"), TWO_TILES);
    assert_walls(MAP(SET "<group name='collision'>" LAYER("a", TILES) "</group>"), TWO_TILES);
    // A property is over a name; what is said not to be solid is left out.
    assert_walls(MAP(SET LAYER("walls", FALSE("solid") CSV("1,0,0,0,0,0")) LAYER("walls", TILES)),
                 TWO_TILES);
    // Two layers on one grid become one.
    assert_walls(MAP(SET LAYER("walls", CSV("0,1,0,0,0,0")) LAYER("walls", CSV("0,0,1,0,0,0"))),
                 TWO_TILES);
    // One that is off the grid adds its own outlines.
    assert_walls(MAP(SET LAYER("walls", TILES) "<layer name='walls' offsetx='1' offsety='-2'" SIZE
                                               ">" CSV("0,0,0,0,1,0") "</layer>"),
                 TWO_TILES "wall 9 10 17 10\nwall 9 2 17 2\nwall 9 2 9 10\nwall 17 2 17 10\n");
}

/// A property says what walls of objects stop; an object's own is over that of its layer, and
/// a layer's over that of its group.
static void test_objects_that_stop_some(void **state) {
    (void)state;
#define STOPS(what)  "<properties><property name='stops' value='" what "'/></properties>"
#define FENCE(more)  "<object id='1' x='8' y='8'>" more "<polyline points='0,0 8,0'/></object>"
#define FENCES(more) "<objectgroup name='fences'>" more "</objectgroup>"
#define GROUP(more)  "<group name='yard'>" more "</group>"
    const char *plan = "wall 8 8 16 8 stops steps\n";
    assert_walls(MAP(SET FENCES(FENCE(STOPS("steps")))), plan);
    assert_walls(MAP(SET FENCES(STOPS("steps") FENCE(""))), plan);
    assert_walls(MAP(SET FENCES(STOPS("sight") FENCE(STOPS("steps")))), plan);
    assert_walls(MAP(SET FENCES(STOPS("sound,steps,sight") FENCE(""))), "wall 8 8 16 8\n");
    assert_walls(MAP(SET GROUP(STOPS("steps") FENCES(FENCE("")))), plan);
    assert_walls(MAP(SET GROUP(STOPS("steps") GROUP(FENCES(FENCE(""))))), plan);
    assert_walls(MAP(SET GROUP(STOPS("sight") FENCES(STOPS("steps") FENCE("")))), plan);
    assert_walls(MAP(SET GROUP(STOPS("sight") GROUP(STOPS("steps") FENCES(FENCE(""))))), plan);
    assert_refused(MAP(SET GROUP(STOPS("stairs") FENCES(FENCE("")))),
                   "f: stops: expected sight or limited, steps, sound");
    assert_refused(MAP(SET FENCES(FENCE(STOPS("stairs")))),
                   "f: stops: expected sight or limited, steps, sound");
    assert_refused(
        MAP(SET "<objectgroup name='sightline-wall-stops-stairs'>" FENCE("") "</objectgroup>"),
        "f:1: a layer whose walls stop something: expected a name such as "
        "sightline-wall-stops-sight");
}

static void test_layers_asked_for(void **state) {
    (void)state;
#define THREE MAP(SET LAYER("a:b", CSV("0,5,7,0,0,0")) LAYER("walls", CSV("1,1,1,1,1,0")))
    assert_chosen("a:b", THREE, TWO_TILES);
    assert_chosen("a:b:5+7", THREE, TWO_TILES);
    assert_chosen("walls:2, a:b:4-7", THREE, TWO_TILES);
    assert_chosen("a:b:9", THREE, FRAME);
    assert_not_chosen("b", THREE, "f: there is no layer 'b' in the map; it has a:b, walls");
    assert_not_chosen("a:b,walls2", THREE, "f: there is no layer 'walls2'");
    assert_not_chosen("walls:1-", THREE, "f: layer 'walls:1-': expected tile numbers");
    assert_not_chosen("walls:1;2", THREE, "f: layer 'walls:1;2': expected tile numbers");
}

#define SET_OF(tiles)    "<tileset firstgid='1' tilewidth='8' tileheight='8'>" tiles "</tileset>"
#define BOX(x, y, w, h)  "<object x='" x "' y='" y "' width='" w "' height='" h "'/>"
#define COLLIDES(shapes) "<tile id='0'><objectgroup>" shapes "</objectgroup></tile>"

static void test_tiles_that_are_solid(void **state) {
    (void)state;
    assert_walls(
        MAP(SET_OF("<tile id='4'>" TRUE("solid") "</tile>") LAYER("a", CSV("2,5,5,1,0,0"))),
        TWO_TILES);
    assert_walls(MAP(SET_OF("<tile id='4' type='wall'/>") LAYER("a", CSV("2,5,5,1,0,0"))),
                 TWO_TILES);
    assert_walls(MAP(SET_OF(TRUE("collides") "<tile id='1'>" FALSE("solid") "</tile>")
                         LAYER("a", CSV("2,5,5,2,0,0"))),
                 TWO_TILES);
    // A tile that is open stays so in a layer that is solid.
    assert_walls(
        MAP(SET_OF("<tile id='1'>" FALSE("solid") "</tile>") LAYER("walls", CSV("2,5,5,2,0,0"))),
        TWO_TILES);
    // A shape that covers its tile is a solid tile.
    assert_walls(MAP(SET_OF(COLLIDES(BOX("0", "0", "8", "8"))) LAYER("a", TILES)), TWO_TILES);
}

static void test_shapes_of_tiles(void **state) {
    (void)state;
#define SHAPED(shapes, gid) MAP(SET_OF(COLLIDES(shapes)) LAYER("a", CSV("0," gid ",0,0,0,0")))
#define AS_BOX(a, b, c, d)                                                                         \
    "wall " a " " b "\nwall " b " " c "\nwall " c " " d "\nwall " d " " a "\n" FRAME
    assert_walls(SHAPED(BOX("1", "2", "3", "4"), "1"), AS_BOX("9 14", "12 14", "12 10", "9 10"));
    // Mirrored across, down, both; x and y exchanged; a quarter turn clockwise.
    assert_walls(SHAPED(BOX("1", "2", "3", "4"), "2147483649"),
                 AS_BOX("15 14", "12 14", "12 10", "15 10"));
    assert_walls(SHAPED(BOX("1", "2", "3", "4"), "1073741825"),
                 AS_BOX("9 10", "12 10", "12 14", "9 14"));
    assert_walls(SHAPED(BOX("1", "2", "3", "4"), "3221225473"),
                 AS_BOX("15 10", "12 10", "12 14", "15 14"));
    assert_walls(SHAPED(BOX("1", "2", "3", "4"), "536870913"),
                 AS_BOX("10 15", "10 12", "14 12", "14 15"));
    assert_walls(SHAPED(BOX("1", "2", "3", "4"), "2684354561"),
                 AS_BOX("14 15", "14 12", "10 12", "10 15"));
    assert_walls(SHAPED("<object x='1' y='1'><polyline points='0,0 2,3'/></object>", "1"),
                 "wall 9 15 11 12\n" FRAME);
    // A larger tile stands on the lower left corner of its square.
    assert_walls(MAP("<tileset firstgid='1' tilewidth='4' tileheight='12'><tileoffset x='1' y='2'/>"
                     "<tile id='0'><objectgroup><object><polyline points='0,0 4,12'/></object>"
                     "</objectgroup></tile></tileset>" LAYER("a", CSV("0,0,0,0,1,0"))),
                 "wall 9 10 13 -2\n" FRAME);
}

#define OBJECTS(body)                                                                              \
    MAP("<objectgroup name='collision' offsetx='1' offsety='-1'>" body "</objectgroup>")

static void test_objects(void **state) {
    (void)state;
    assert_walls(OBJECTS(BOX("1", "2", "3", "4")),
                 "wall 2 15 5 15\nwall 5 15 5 11\nwall 5 11 2 11\nwall 2 11 2 15\n" FRAME);
    // Turned clockwise about its place.
    assert_walls(OBJECTS("<object x='4' y='5' width='3' height='2' rotation='90'/>"),
                 "wall 5 12 5 9\nwall 5 9 3 9\nwall 3 9 3 12\nwall 3 12 5 12\n" FRAME);
    assert_walls(OBJECTS("<object x='4' y='5' width='3' height='2' rotation='-180'/>"),
                 "wall 5 12 2 12\nwall 2 12 2 14\nwall 2 14 5 14\nwall 5 14 5 12\n" FRAME);
    assert_walls(OBJECTS("<object x='1' y='1'><polygon points='0,0 2,0 0,3'/></object>"),
                 "wall 2 16 4 16\nwall 4 16 2 13\nwall 2 13 2 16\n" FRAME);
    assert_walls(OBJECTS("<object x='1' y='1'><polyline points='0,0 2.5,-1 0,0'/></object>"),
                 "wall 2 16 4.5 17\nwall 4.5 17 2 16\n");
    // A tile as an object stands on its place.
    assert_walls(OBJECTS("<object gid='1' x='0' y='4' width='2' height='3'/>"),
                 "wall 1 16 3 16\nwall 3 16 3 13\nwall 3 13 1 13\nwall 1 13 1 16\n" FRAME);
    // Others are left out.
    assert_walls(OBJECTS("<object x='1' y='1'><point/></object><object x='1' y='1' width='4' "
                         "height='4'><text>wall</text></object><object template='t.tx'/>"
                         "<object x='3' y='3'/><object x='1' y='1'><polyline points='0,0 1,0'/>"
                         "</object>"),
                 "wall 2 16 3 16\n");
    assert_walls(
        MAP("<objectgroup name='things'>" BOX(
            "0", "0", "1",
            "1") "<object type='wall'><polyline points='0,0 1,0'/></object>"
                 "<object name='Wall 7'><polyline points='2,0 3,0'/></object>"
                 "<object>" TRUE("solid") "<polyline points='4,0 5,0'/></object></objectgroup>"),
        "wall 0 16 1 16\nwall 2 16 3 16\nwall 4 16 5 16\n");
}

static void test_ellipses(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const char *text = OBJECTS("<object x='2' y='1' width='8' height='4'><ellipse/></object>");
    for (int i = 0; i < 2; i++) {
        const sl_import_options options = {.tolerance = i ? 0.001 : 0};
        sl_map map = {0};
        assert_ok(context, sli_map_read_tmx(context, "f", text, strlen(text), &options, &map));
        // The last walls are about the map.
        const size_t count = map.wall_count - 4;
        assert_true(count >= (i ? 60 : 16) && count <= 400);
        for (size_t k = 0; k < count; k++) {
            const double x = (map.walls[k].a.x - 7) / 4, y = (map.walls[k].a.y - 14) / 2;
            assert_true(x * x + y * y > 1 - 1e-12 && x * x + y * y < 1 + 1e-12);
            const size_t next = (k + 1) % count;
            assert_true(map.walls[k].b.x == map.walls[next].a.x);
            assert_true(map.walls[k].b.y == map.walls[next].a.y);
        }
        sl_map_destroy(context, &map);
    }
    sl_context_destroy(context);
}

#define INFINITE(layers)                                                                           \
    "<map width='3' height='2' tilewidth='8' tileheight='8' infinite='1'>\n" SET layers "</map>"
#define CHUNK(x, y, w, h, data)                                                                    \
    "<chunk x='" x "' y='" y "' width='" w "' height='" h "'>" data "</chunk>"

static void test_chunks(void **state) {
    (void)state;
    assert_walls(
        INFINITE(LAYER("empty", CSV("")) LAYER(
            "walls", CSV(CHUNK("0", "0", "2", "2", "0,1,0,0") CHUNK("2", "0", "1", "2", "1,0")))),
        TWO_TILES);
    assert_walls(INFINITE(LAYER("walls", CSV(CHUNK("-2", "0", "1", "1", "0")
                                                 CHUNK("1", "-1", "1", "2", "1,1")))),
                 "wall -16 24 8 24\nwall -16 8 8 8\nwall -16 8 -16 24\nwall 8 8 8 24\n");
    assert_refused(INFINITE(LAYER("walls", CSV(CHUNK("-2", "0", "1", "1", "0")
                                                   CHUNK("70000000", "0", "1", "1", "1")))),
                   "f: its tiles are spread over 70000003 x 1 squares");
    assert_refused(INFINITE(LAYER("walls", CSV(CHUNK("1e9", "0", "1", "1", "0,1")))),
                   "f:3: layers[0].chunks[0].data: more than the layer's 1 tiles");
    assert_refused(INFINITE(LAYER("walls", CSV(CHUNK("1e10", "0", "1", "1", "0")))),
                   "f:3: layers[0].chunks[0].x: 1e+10 is out of range");
    assert_refused(INFINITE(LAYER("walls", CSV(CHUNK("0", "0", "99999", "99999", "0")))),
                   "f:2: layer 'walls', 99999 x 99999: 9999800001 squares, more than the limit of "
                   "134217728; --max-squares raises it");
    assert_refused(INFINITE(LAYER("walls", CSV(CHUNK("0", "0", "0", "1", "0")))),
                   "f:3: layers[0].chunks[0].width: 0 is out of range");
}

// --- diamonds and hexagons

#define LATTICE(how, size, body)                                                                   \
    "<map orientation='" how "' " size "tilewidth='16' tileheight='8'>\n" body "</map>"
#define THREE_BY_THREE  "width='3' height='3' "
#define LATTICE_SET     "<tileset firstgid='1' tilewidth='16' tileheight='8'/>"
#define RING            "<layer name='walls' " THREE_BY_THREE ">" CSV("1,1,1,1,0,1,1,1,1") "</layer>"
#define RING_MAP(how)   LATTICE(how, THREE_BY_THREE, LATTICE_SET RING)
#define STAGGERED(axis) "staggered' staggeraxis='" axis
#define HEXAGONAL(axis) "hexagonal' hexsidelength='4' staggeraxis='" axis
#define EVEN            "' staggerindex='even"

static void assert_one_inside(const char *text) {
    sl_context *context = testing_context(NULL);
    const sl_import_options options = sl_import_options_default();
    sl_map map = {0};
    sl_space space = {0};
    assert_ok(context, sli_map_read_tmx(context, "f", text, strlen(text), &options, &map));
    assert_ok(context, sli_subdivide_mesh(context, &map, &space));
    assert_int_equal(space.inside_count, 1);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// A ring of solid tiles about one open tile, which is where Tiled draws it.
static void test_rings(void **state) {
    (void)state;
    static const struct {
        const char *text, *corners;
    } cases[] = {
        {RING_MAP("isometric"), "16 12 24 16 32 12 24 8"},
        {RING_MAP(STAGGERED("y")), "24 8 32 12 40 8 32 4"},
        {RING_MAP(STAGGERED("y") EVEN), "16 8 24 12 32 8 24 4"},
        {RING_MAP(STAGGERED("x")), "8 12 16 16 24 12 16 8"},
        {RING_MAP(STAGGERED("x") EVEN), "8 16 16 20 24 16 16 12"},
        {RING_MAP(HEXAGONAL("x")), "10 12 16 16 20 16 26 12 20 8 16 8"},
        {RING_MAP(HEXAGONAL("x") EVEN), "10 16 16 20 20 20 26 16 20 12 16 12"},
        {RING_MAP(HEXAGONAL("y")), "24 8 24 12 32 14 40 12 40 8 32 6"},
        {RING_MAP(HEXAGONAL("y") EVEN), "16 8 16 12 24 14 32 12 32 8 24 6"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sl_context *context = testing_context(NULL);
        const sl_import_options options = sl_import_options_default();
        sl_map map = {0};
        const char *text = cases[i].text;
        assert_ok(context, sli_map_read_tmx(context, "f", text, strlen(text), &options, &map));
        char *whole = map_text(&map), expected[128];
        snprintf(expected, sizeof expected, "sightline 1\nopen %s\n", cases[i].corners);
        assert_string_equal(whole, expected);
        free(whole);
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
        assert_one_inside(text);
    }
}

static void test_lattices_as_json(void **state) {
    (void)state;
    assert_walls_json("{\"orientation\": \"hexagonal\", \"hexsidelength\": 4, \"staggeraxis\": "
                      "\"x\", \"staggerindex\": \"even\", \"width\": 1, \"height\": 1, "
                      "\"tilewidth\": 16, \"tileheight\": 8, \"layers\": [{\"type\": "
                      "\"tilelayer\", \"name\": \"walls\", \"width\": 1, \"height\": 1, "
                      "\"data\": [0]}]}",
                      "wall 0 0 6 4\nwall 6 -4 0 0\nwall 6 4 10 4\nwall 6 -4 10 -4\n"
                      "wall 10 -4 16 0\nwall 16 0 10 4\n");
}

/// Twice the area of what is open, by the walls: each has solid ground at one hand.
static double open_area_of(const sl_map *map) {
    double area = 0;
    for (size_t i = 0; i < map->wall_count; i++) {
        const sl_wall *wall = &map->walls[i];
        const double cross = wall->a.x * wall->b.y - wall->a.y * wall->b.x;
        assert_true(!(wall->ground & SL_SOLID_LEFT) != !(wall->ground & SL_SOLID_RIGHT));
        area += wall->ground & SL_SOLID_RIGHT ? cross : -cross;
    }
    return area;
}

static char *add_random_tiles(char *end, uint32_t *seed, size_t count, size_t *open) {
    for (size_t i = 0; i < count; i++) {
        *seed = *seed * 1664525 + 1013904223;
        const bool solid = *seed >> 31;
        *open += !solid;
        end += sprintf(end, "%s%d", i ? "," : "", solid);
    }
    return end;
}

/// The walls enclose as much as all open tiles have together: neighbours share their corners.
static void test_random_lattices(void **state) {
    (void)state;
    static const struct {
        const char *how;
        int area; ///< twice that of a tile
    } cases[] = {
        {"isometric", 16 * 8},
        {STAGGERED("y"), 16 * 8},
        {STAGGERED("y") EVEN, 16 * 8},
        {STAGGERED("x"), 16 * 8},
        {STAGGERED("x") EVEN, 16 * 8},
        {HEXAGONAL("x"), 2 * 10 * 8},
        {HEXAGONAL("x") EVEN, 2 * 80},
        {HEXAGONAL("y"), 2 * 6 * 16},
        {HEXAGONAL("y") EVEN, 2 * 6 * 16},
    };
    uint32_t seed = 1;
    for (size_t i = 0; i < 9 * 20; i++) {
        char text[2048], *end = text;
        size_t open = 0;
        end += sprintf(end,
                       "<map orientation='%s' width='7' height='6' tilewidth='16' "
                       "tileheight='8' infinite='1'>" LATTICE_SET
                       "<layer name='walls' width='7' height='6'><data encoding='csv'>"
                       "<chunk x='-3' y='-3' width='7' height='3'>",
                       cases[i % 9].how);
        end = add_random_tiles(end, &seed, 21, &open);
        end += sprintf(end, "</chunk><chunk x='-3' y='0' width='4' height='3'>");
        end = add_random_tiles(end, &seed, 12, &open);
        end += sprintf(end, "</chunk><chunk x='1' y='0' width='3' height='3'>");
        end = add_random_tiles(end, &seed, 9, &open);
        sprintf(end, "</chunk></data></layer></map>");
        sl_context *context = testing_context(NULL);
        const sl_import_options options = sl_import_options_default();
        sl_map map = {0};
        assert_ok(context, sli_map_read_tmx(context, "f", text, strlen(text), &options, &map));
        assert_true(open_area_of(&map) == (double)open * cases[i % 9].area);
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
}

/// What the text gives, starts and doors too: these lines, in any order.
static void assert_reads(const char *text, const char *expected) {
    sl_context *context = testing_context(NULL);
    const sl_import_options options = sl_import_options_default();
    sl_map map = {0};
    assert_ok(context, sli_map_read_tmx(context, "f", text, strlen(text), &options, &map));
    char *whole = map_walls_text(&map);
    bool same = strlen(whole) == strlen("sightline 1\n") + strlen(expected);
    for (const char *at = expected; same && *at; at = strchr(at, '\n') + 1) {
        char line[128];
        snprintf(line, sizeof line, "\n%.*s", (int)(strchr(at, '\n') + 1 - at), at);
        same = strstr(whole, line);
    }
    if (!same) fail_msg("%s is not\n%s", whole, expected);
    free(whole);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// Long walls of diamonds are one wall each; a guess takes what is empty as solid.
static void test_few_walls_of_diamonds(void **state) {
    (void)state;
    assert_reads(LATTICE("isometric", "width='4' height='3' ",
                         LATTICE_SET "<layer name='walls' width='4' height='3'>" CSV(
                             "1,1,1,1,1,0,0,1,1,1,1,1") "</layer>"),
                 "wall 24 20 40 12\nwall 16 16 24 20\nwall 16 16 32 8\nwall 32 8 40 12\n");
    assert_reads(LATTICE(STAGGERED("y"), THREE_BY_THREE,
                         LATTICE_SET "<layer name='floor' " THREE_BY_THREE
                                     ">" CSV("0,0,0,0,2,0,0,2,0") "</layer>"),
                 "wall 32 12 40 8\nwall 16 4 24 0\nwall 16 4 32 12\nwall 24 0 40 8\n");
}

#define WITH_OBJECTS(how, rows, body)                                                              \
    LATTICE(how, "width='3' height='" rows "' ",                                                   \
            LATTICE_SET "<layer name='walls' width='3' height='" rows                              \
                        "'>" CSV("1,1,1,1,0,1,1,1,1") "</layer><objectgroup name='things'>" body   \
                                                      "</objectgroup>")
#define DIAMOND "wall 16 12 24 16\nwall 24 16 32 12\nwall 16 12 24 8\nwall 24 8 32 12\n"

/// Objects in isometric maps are in units of the tile's height; turns are those of the screen.
static void test_objects_on_lattices(void **state) {
    (void)state;
#define AS_WALL(how) "<object name='wall' " how "/>"
    assert_reads(
        WITH_OBJECTS("isometric", "3", AS_WALL("x='8' y='8' width='8' height='4'")),
        "wall 24 16 32 12\nwall 32 12 28 10\nwall 28 10 20 14\nwall 20 14 24 16\n" DIAMOND);
    assert_reads(
        WITH_OBJECTS("isometric", "3", AS_WALL("x='8' y='8' width='8' height='4' rotation='180'")),
        "wall 24 16 16 20\nwall 16 20 20 22\nwall 20 22 28 18\nwall 28 18 24 16\n" DIAMOND);
    assert_reads(
        WITH_OBJECTS("isometric", "3", AS_WALL("x='8' y='8' width='8' height='4' rotation='90'")),
        "wall 24 16 20 8\nwall 20 8 18 12\nwall 18 12 22 20\nwall 22 20 24 16\n" DIAMOND);
    // A tile as an object stands on the diamond behind its place.
    assert_reads(WITH_OBJECTS("isometric", "3", AS_WALL("gid='1' x='16' y='16'")),
                 "wall 24 16 32 12\nwall 32 12 24 8\nwall 24 8 16 12\nwall 16 12 24 16\n" DIAMOND);
    // The others have them on the screen.
    assert_reads(WITH_OBJECTS(STAGGERED("x"), "3", AS_WALL("x='12' y='14' width='6' height='3'")),
                 "wall 12 14 18 14\nwall 18 14 18 11\nwall 18 11 12 11\nwall 12 11 12 14\n"
                 "wall 8 12 16 16\nwall 16 16 24 12\nwall 8 12 16 8\nwall 16 8 24 12\n");
}

static void test_starts_and_doors_on_lattices(void **state) {
    (void)state;
#define START(x, y) "<object name='start' x='" x "' y='" y "'><point/></object>"
    assert_reads(WITH_OBJECTS("isometric", "3", START("12", "10") START("4", "4")),
                 DIAMOND "start 26 13 0\n");
    assert_reads(WITH_OBJECTS(STAGGERED("x"), "3", START("12", "16") START("4", "4")),
                 "wall 8 12 16 16\nwall 16 16 24 12\nwall 8 12 16 8\nwall 16 8 24 12\n"
                 "start 12 12 0\n");
    assert_reads(WITH_OBJECTS(HEXAGONAL("x"), "3", START("12", "16") START("11", "13")),
                 "wall 10 12 16 16\nwall 16 8 10 12\nwall 16 16 20 16\nwall 26 12 20 16\n"
                 "wall 20 8 26 12\nwall 16 8 20 8\nstart 12 12 0\n");
    // A door on a solid square between two open ones.
    assert_reads(
        LATTICE("isometric", "width='3' height='1' ",
                LATTICE_SET "<layer name='walls' width='3' height='1'>" CSV(
                    "0,1,0") "</layer><objectgroup name='things'><object name='door' x='8' "
                             "y='0' width='8' height='8'/></objectgroup>"),
        "wall 8 16 32 4\nwall 0 12 8 16\nwall 0 12 24 0\nwall 24 0 32 4\n"
        "door door 12 6 20 10 open\n");
    // Tiles that are doors; in hexagonal maps they are left out.
#define TILE_DOOR(how, width, tiles)                                                               \
    LATTICE(how, "width='" width "' height='3' ",                                                  \
            "<tileset firstgid='1' tilewidth='16' tileheight='8'><tile id='1' type='door'/>"       \
            "</tileset><layer name='walls' width='" width "' height='3'>" CSV(tiles) "</layer>")
    assert_reads(TILE_DOOR("isometric", "1", "0,2,0"),
                 "wall 24 16 32 12\nwall 0 4 24 16\nwall 0 4 8 0\nwall 8 0 32 12\n"
                 "door door 12 10 20 6 open\n");
    assert_reads(TILE_DOOR(STAGGERED("y"), "2", "0,1,2,1,1,0"),
                 "wall 8 16 32 4\nwall 0 12 24 0\nwall 0 12 8 16\nwall 24 0 32 4\n"
                 "door door 12 6 20 10 open\n");
    assert_reads(
        TILE_DOOR(HEXAGONAL("y"), "1", "1,2,0"),
        "wall 8 8 0 6\nwall 16 6 8 8\nwall 0 6 0 2\nwall 16 6 16 2\nwall 16 2 8 0\nwall 8 0 0 2\n");
    assert_reads(WITH_OBJECTS(HEXAGONAL("y"), "3",
                              "<object name='door' x='24' y='10' width='16' height='1'/>"),
                 "wall 32 14 24 12\nwall 40 12 32 14\nwall 24 12 24 8\nwall 40 12 40 8\nwall 40 8 "
                 "32 6\nwall 32 6 24 8\ndoor door 24 9.5 40 9.5 open\n");
}

/// Shapes of tiles: those of isometric sets are drawn in a diamond, others in pixels; hexagons turn
/// by 60 degrees.
static void test_tile_shapes_on_lattices(void **state) {
    (void)state;
#define SHAPED_SET(more, shape)                                                                    \
    "<tileset firstgid='1' tilewidth='16' tileheight='8'>" more "<tile id='0'><objectgroup>" shape \
    "</objectgroup></tile></tileset><layer name='a' " THREE_BY_THREE ">"
#define DIAMONDS "<grid orientation='isometric' width='16' height='8'/>"
#define SHAPED_RING(how, more, shape)                                                              \
    LATTICE(how, THREE_BY_THREE, SHAPED_SET(more, shape) CSV("1,1,1,1,0,1,1,1,1") "</layer>")
    assert_reads(SHAPED_RING("isometric", DIAMONDS, BOX("0", "0", "8", "8")), DIAMOND);
    assert_reads(SHAPED_RING(STAGGERED("x"), DIAMONDS, BOX("0", "0", "8", "8")),
                 "wall 8 12 16 16\nwall 16 16 24 12\nwall 8 12 16 8\nwall 16 8 24 12\n");
#define ONE_SHAPE(how, gid, more, shape)                                                           \
    LATTICE(how, THREE_BY_THREE, SHAPED_SET(more, shape) CSV("0,0,0,0," gid ",0,0,0,0") "</layer>")
#define LINE "<object><polyline points='0,0 16,8'/></object>"
    static const struct {
        const char *text, *wall;
    } cases[] = {
        {ONE_SHAPE("isometric", "1", DIAMONDS, "<object><polyline points='0,0 8,4'/></object>"),
         "wall 24 16 28 10\n"},
        {ONE_SHAPE("isometric", "1", "", LINE), "wall 16 16 32 8\n"},
        {ONE_SHAPE("isometric", "2147483649", "", LINE), "wall 32 16 16 8\n"},
        {ONE_SHAPE(STAGGERED("y"), "1", "", LINE), "wall 24 12 40 4\n"},
        {ONE_SHAPE(HEXAGONAL("x"), "1", "", LINE), "wall 10 16 26 8\n"},
        {ONE_SHAPE(HEXAGONAL("x"), "805306369", "", LINE), "wall 26 8 10 16\n"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sl_context *context = testing_context(NULL);
        const sl_import_options options = sl_import_options_default();
        const char *text = cases[i].text;
        sl_map map = {0};
        assert_ok(context, sli_map_read_tmx(context, "f", text, strlen(text), &options, &map));
        char *whole = map_walls_text(&map);
        if (strncmp(whole + 12, cases[i].wall, strlen(cases[i].wall)) != 0)
            fail_msg("%zu: %s", i, whole);
        free(whole);
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
}

/// The layers to choose from, and whether the map says which of them are solid.
static void test_layers_listed(void **state) {
    (void)state;
    static const struct {
        const char *name, *text, *layers;
        bool unsaid;
    } cases[] = {
        {"a.tmx",
         MAP(SET LAYER("ground", CSV("1,1,1,1,1,1")) "<group name='g'><objectgroup name='things'/>"
                                                     "</group>"),
         "ground|things|", true},
        {"b.tmx", MAP(SET LAYER("ground", CSV("1,1,1,1,1,1")) LAYER("walls", CSV("1,0,0,0,0,0"))),
         "ground|walls|", false},
        {"c.tmx", MAP("<tileset firstgid='1' source='gone.tsx'/>" LAYER("a", CSV("1,1,1,1,1,1"))),
         "a|", true},
        {"d.tmj",
         "{\"width\": 1, \"height\": 1, \"tilewidth\": 8, \"tileheight\": 8, \"layers\": ["
         "{\"type\": \"tilelayer\", \"name\": \"floor\", \"width\": 1, \"height\": 1, "
         "\"data\": [0]}]}",
         "floor|", true},
    };
    sl_context *context = testing_context(NULL);
    assert_ok(context, sl_io_use(context));
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char found[256] = "";
        sl_map_choice choice = {0};
        assert_ok(context, sl_map_choice_parse(context, cases[i].name, cases[i].text,
                                               strlen(cases[i].text), &choice));
        for (size_t k = 0; k < choice.layers.count; k++) {
            strcat(found, choice.layers.names[k]);
            strcat(found, "|");
        }
        assert_string_equal(found, cases[i].layers);
        assert_int_equal(choice.layers_unsaid, cases[i].unsaid);
        sl_map_choice_destroy(context, &choice);
    }
    sl_context_destroy(context);
}

static void test_damaged_data(void **state) {
    (void)state;
#define BROKEN(how, text, message)                                                                 \
    assert_refused(MAP(SET LAYER("walls", DATA(how, text))), "f:2: layers[0]" message)
#define BASE64 "encoding='base64'"
    BROKEN("encoding='csv'", "0,1,1", ".data: 3 tiles, the layer has 6");
    BROKEN("encoding='csv'", "0,1,1,0,0,0,0", ".data: more than the layer's 6 tiles");
    BROKEN("encoding='csv'", "0,1,x,0,0,0",
           ".data: tile 3 of 6: expected a whole number, found 'x'");
    BROKEN("encoding='csv'", "0,1,-1,0,0,0", ".data: tile 3 of 6: expected a whole number");
    BROKEN("encoding='csv'", "0,1,4294967296,0,0,0", ".data: tile 3 of 6: expected a whole number");
    BROKEN("encoding='csv'", "0,1 1,0,0,0", ".data: tile 2 of 6: expected ',', found '1'");
    BROKEN("", "<tile gid='1'/>", ".data: 1 tiles, the layer has 6");
    BROKEN("", "<tile gid='1e308'/><tile/><tile/><tile/><tile/><tile/>",
           ".data[0]: 1e+308 is out of range");
    BROKEN(BASE64, "AAA", ".data: the base64 text is cut off");
    BROKEN(BASE64, "AA==AAAA", ".data: character 5 is not base64");
    BROKEN(BASE64, "A*AA", ".data: character 2 is not base64");
    BROKEN(BASE64, "AAAA", ".data: the data is not that of the layer's 6 tiles");
    BROKEN(BASE64 " compression='zlib'", "AAAA", ".data: the compressed data is damaged");
    BROKEN(BASE64 " compression='zlib'", "eJxjYGBgYITg",
           ".data: the compressed data is damaged: it is cut");
    BROKEN(BASE64 " compression='zlib'", "eJxjYGBgYITgBgYoAAAEsACD",
           ".data: the data is not that of the layer's 6");
    BROKEN(BASE64 " compression='zlib'",
           "eJxjYGBgYITgBgY0gE0cABmoAQU=", ".data: the data is not that of the layer's 6");
    BROKEN(BASE64 " compression='gzip'", "AAAA", ".data: the compressed data is damaged");
    BROKEN(BASE64 " compression='zstd'", "AAAA", ".data: the compressed data is damaged");
    BROKEN(BASE64 " compression='zstd'",
           "KLUv/QSnfQAAOAAAAAABgAACADiDH5wWV9VyhA==", ".data: the compressed data is damaged");
    BROKEN(BASE64 " compression='zstd'", "KLUv/QRYQQAAAAAAAAEAAACpoo4m",
           ".data: the data is not that of the layer's 6");
    BROKEN(BASE64 " compression='zstd'", "KLUv/QRYlQAAOAAAAAABgAADAO00Aa7jB6cFXZtEww==",
           ".data: the data is not that of the layer's 6");
    BROKEN(BASE64 " compression='lzma'", RAW, ".compression: 'lzma' is unknown");
    BROKEN("encoding='rot13'", RAW, ".encoding: 'rot13' is unknown");
    assert_refused(MAP("<layer name='walls' width='9999' height='9999'>" CSV("0") "</layer>"),
                   "f:2: layers[0].data: the data is not that of the layer's 99980001 tiles");
}

static void test_refused(void **state) {
    (void)state;
    assert_refused("", "f: the file is empty");
    assert_refused("<map>\n<layer></map>", "f:2: XML: ");
    assert_refused("\n<svg/>", "f:2: expected <map>, found <svg>");
    assert_refused("<map orientation='round' " SIZE "/>", "f:1: orientation: 'round' is unknown");
    assert_refused("<map orientation='isometric'" SIZE "tilewidth='8' tileheight='1'/>",
                   "f:1: tileheight: 1 is out of range");
    assert_refused("<map orientation='hexagonal'" SIZE "tilewidth='8' tileheight='8' "
                   "hexsidelength='9'/>",
                   "f:1: hexsidelength: 9 is more than the size of a tile, 8");
    assert_refused("<map orientation='staggered'" SIZE "tilewidth='8' tileheight='8' "
                   "staggeraxis='z'/>",
                   "f:1: staggeraxis: 'z' is unknown");
    assert_refused("<map orientation='staggered'" SIZE
                   "tilewidth='8' tileheight='8'>" LAYER("walls", TILES) "<layer name='walls' "
                                                                         "offsetx='1'" SIZE
                                                                         ">" TILES "</layer></map>",
                   "f:2: layers[1]: layers of tiles that are moved differently");
    assert_refused("<map" SIZE "tilewidth='8'/>",
                   "f:1: it does not say how large its tiles are (tileheight)");
    assert_refused("<map" SIZE "tilewidth='nan' tileheight='8'/>",
                   "f:1: tilewidth: expected a number, found 'nan'");
    assert_refused("<map" SIZE "tilewidth='1e308' tileheight='8'/>",
                   "f:1: tilewidth: 1e+308 is out of range");
    assert_refused("<map" SIZE "tilewidth='-8' tileheight='8'>" LAYER("walls", TILES) "</map>",
                   "f: 3 x 2 tiles of -8 x 8 pixels at 0 0: out of range");
    assert_refused("<map width='3' height='-2' tilewidth='8' tileheight='8'/>",
                   "f:1: height: -2 is out of range");
    assert_refused(MAP("<tileset tilewidth='8' tileheight='8'/>"),
                   "f:2: tilesets[0].firstgid: expected a whole number, found nothing");
    assert_refused(MAP("<tileset firstgid='1' tilewidth='8'/>"),
                   "f:2: tilesets[0].tileheight: expected a number, found nothing");
    assert_refused(MAP(SET_OF("<tile/>")), "f:2: tilesets[0].tiles[0].id: expected a whole number");
    assert_refused(MAP("<layer name='walls' width='3'/>"),
                   "f:2: layers[0].height: expected a whole number, found nothing");
    assert_refused(MAP("<layer name='walls'" SIZE "/>"), "f:2: layers[0].data: expected text");
    assert_refused(OBJECTS("\n<object x='1e308'/>"), "f:3: layers[0].objects[0].x: 1e+308 is out");
    assert_refused(OBJECTS("\n<object rotation='x'/>"),
                   "f:3: layers[0].objects[0].rotation: expected a number, found 'x'");
    assert_refused(OBJECTS("<object><polygon points='0,0 1,1'/></object>"),
                   "f:2: layers[0].objects[0].polygon: 2 points, at least 3 are needed");
    assert_refused(OBJECTS("<object><polyline points='0,0 1'/></object>"),
                   "f:2: layers[0].objects[0].polyline: point 2: expected x,y; found ''");
    assert_refused(OBJECTS("<object><polyline points='0,0 1,1e999'/></object>"),
                   "f:2: layers[0].objects[0].polyline: point 2: expected x,y; found '1e999'");
    assert_refused(OBJECTS("<object x='1e150' width='1e150' height='1'/>"),
                   "f:2: a coordinate is out of range");
}

static void test_entities_are_not_followed(void **state) {
    (void)state;
    // Ten levels of ten: the name would be of 10^10 characters, and of one that says solid.
    char text[2048] = "<!DOCTYPE map [<!ENTITY a0 'wallwallwa'>";
    for (int i = 1; i <= 10; i++) {
        char line[128], *end = line + snprintf(line, sizeof line, "<!ENTITY a%d '", i);
        for (int k = 0; k < 10; k++) end += snprintf(end, 8, "&a%d;", i - 1);
        strcat(text, line);
        strcat(text, "'>");
    }
    strcat(text, "<!ENTITY file SYSTEM '/etc/passwd'>]>");
    strcat(text, MAP(SET LAYER("&a10;", TILES) LAYER("walls", CSV("&file;0,1,1,0,0,0"))));
    sl_context *context = testing_context(NULL);
    const sl_import_options options = sl_import_options_default();
    sl_map map = {0};
    const sl_status status = sli_map_read_tmx(context, "f", text, strlen(text), &options, &map);
    // libxml2 may refuse the nested entities by itself, or they are passed over.
    assert_true(status == SL_OK || status == SL_BAD_INPUT);
    assert_null(strstr(sl_context_message(context), "root:"));
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void test_long_texts(void **state) {
    (void)state;
    // More characters than libxml2 takes of itself; then declared entities are refused.
    const size_t columns = 2000, rows = 2600;
    const char *heads[] = {"<map ", "<!DOCTYPE map [<!ENTITY a 'b'>]><map "};
    char *text = malloc(2 * columns * rows + 512);
    assert_non_null(text);
    for (int i = 0; i < 2; i++) {
        char *end = text + sprintf(text,
                                   "%swidth='%zu' height='%zu' tilewidth='1' tileheight='1'><layer "
                                   "name='walls' width='%zu' height='%zu'><data encoding='csv'>",
                                   heads[i], columns, rows, columns, rows);
        for (size_t k = 0; k < columns * rows; k++) end += sprintf(end, "0,");
        strcpy(end - 1, "</data></layer></map>");
        if (i)
            assert_refused(text, "f: XML: it declares entities");
        else
            assert_walls(text, "wall 0 2600 2000 2600\nwall 0 0 2000 0\nwall 0 0 0 2600\n"
                               "wall 2000 0 2000 2600\n");
    }
    free(text);
}

// --- files beside the map

static void write_file(const char *folder, const char *name, const char *text) {
    char path[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    import_write_file(path, text);
}

static void remove_file(const char *folder, const char *name) {
    char path[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    assert_int_equal(remove(path), 0);
}

#define BESIDE(source, layers) MAP("<tileset firstgid='1' source='" source "'/>" layers)

static sl_status read_beside(sl_context *context, const char *folder, const char *text,
                             sl_map *map) {
    char path[256];
    snprintf(path, sizeof path, "%s/m.tmx", folder);
    write_file(folder, "m.tmx", text);
    assert_ok(context, sl_io_use(context));
    return sl_map_read(context, path, NULL, map);
}

static void test_tilesets_beside(void **state) {
    (void)state;
    char folder[] = "/tmp/sightline-tiled-XXXXXX", inner[64];
    assert_non_null(mkdtemp(folder));
    snprintf(inner, sizeof inner, "%s/sets", folder);
    assert_int_equal(mkdir(inner, 0700), 0);
    write_file(inner, "a.tsx",
               "<?xml version='1.0'?><tileset tilewidth='8' tileheight='8'>"
               "<tile id='4'>" TRUE("solid") "</tile></tileset>");
    write_file(
        inner, "b.tsj",
        "{\"tilewidth\": 8, \"tileheight\": 8, \"tiles\": [{\"id\": 4, \"type\": \"wall\"}]}");
    write_file(inner, "broken.tsx", "<tileset tilewidth='8'/>");
    static const struct {
        const char *text, *message;
    } cases[] = {
        {BESIDE("sets/a.tsx", LAYER("a", CSV("1,5,5,0,0,0"))), NULL},
        {BESIDE("sets\\a.tsx", LAYER("a", CSV("1,5,5,0,0,0"))), NULL},
        {BESIDE("sets/b.tsj", LAYER("a", CSV("1,5,5,0,0,0"))), NULL},
        // A file that is missing does no harm where a layer says that it is solid.
        {BESIDE("no.tsx", LAYER("a", CSV("1,5,5,0,0,0")) LAYER("walls", TILES)), NULL},
        {BESIDE("no.tsx", LAYER("a", TILES)), "its tileset 'no.tsx' cannot be read"},
        {BESIDE("sets", LAYER("a", TILES)), "its tileset 'sets' cannot be read"},
        {BESIDE("sets/broken.tsx", LAYER("a", TILES)), "broken.tsx:1: tileheight: expected"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        testing_memory memory = {0};
        sl_context *context = testing_context(&memory);
        sl_map map = {0};
        const sl_status status = read_beside(context, folder, cases[i].text, &map);
        const char *said = sl_context_message(context);
        if (cases[i].message) {
            assert_int_equal(status, SL_BAD_INPUT);
            if (!strstr(said, cases[i].message)) fail_msg("%s", said);
        } else {
            if (status != SL_OK) fail_msg("%s", said);
            char *walls = map_walls_text(&map);
            assert_string_equal(walls + strlen("sightline 1\n"), TWO_TILES);
            free(walls);
        }
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
        assert_int_equal(memory.live, 0);
    }
    remove_file(inner, "a.tsx");
    remove_file(inner, "b.tsj");
    remove_file(inner, "broken.tsx");
    remove_file(folder, "m.tmx");
    assert_int_equal(rmdir(inner), 0);
    assert_int_equal(rmdir(folder), 0);
}

/// An instance of a template is a wall like any other object.
static void test_templates_beside(void **state) {
    (void)state;
    char folder[] = "/tmp/sightline-tiled-XXXXXX";
    assert_non_null(mkdtemp(folder));
    write_file(folder, "crate.tx",
               "<template><object type='wall' width='8' height='4'/></template>");
    write_file(folder, "tile.tx",
               "<template><tileset firstgid='1' source='b.tsx'/><object gid='3' width='8' "
               "height='4'/></template>");
    write_file(
        folder, "b.tsx",
        "<tileset tilewidth='8' tileheight='8'><tile id='2'>" TRUE("solid") "</tile></tileset>");
#define WITH_INSTANCES(more)                                                                       \
    MAP("<tileset firstgid='1' tilewidth='8' tileheight='8'/><tileset firstgid='40' "              \
        "source='b.tsx'/><objectgroup name='things'>" more "</objectgroup>")
    static const struct {
        const char *text, *walls;
    } cases[] = {
        {WITH_INSTANCES("<object template='crate.tx' x='8' y='8'/>"),
         "wall 8 8 16 8\nwall 16 8 16 4\nwall 16 4 8 4\nwall 8 4 8 8\n" FRAME},
        {WITH_INSTANCES("<object template='crate.tx' x='8' y='8' width='4'/>"),
         "wall 8 8 12 8\nwall 12 8 12 4\nwall 12 4 8 4\nwall 8 4 8 8\n" FRAME},
        // A tile of the template's set, which has another number in the map.
        {WITH_INSTANCES("<object template='tile.tx' x='8' y='8'/>"),
         "wall 8 12 16 12\nwall 16 12 16 8\nwall 16 8 8 8\nwall 8 8 8 12\n" FRAME},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sl_context *context = testing_context(NULL);
        sl_map map = {0};
        assert_ok(context, read_beside(context, folder, cases[i].text, &map));
        char *walls = map_walls_text(&map);
        assert_string_equal(walls + strlen("sightline 1\n"), cases[i].walls);
        free(walls);
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
    remove_file(folder, "crate.tx");
    remove_file(folder, "tile.tx");
    remove_file(folder, "b.tsx");
    remove_file(folder, "m.tmx");
    assert_int_equal(rmdir(folder), 0);
}

static void test_memory(void **state) {
    (void)state;
    assert_memory_of(
        sli_map_read_tmx, NULL,
        MAP(SET_OF(COLLIDES(BOX("1", "1", "2", "2")) "<tile id='1' type='wall'/>")
                LAYER("a", DATA("encoding='base64' compression='zlib'",
                                ZLIB)) "<objectgroup "
                                       "name='walls'>" BOX("1", "1", "2", "2") "</objectgroup>"));
    assert_memory_of(sli_map_read_tmx, NULL, WITH_OBJECTS("isometric", "3", START("12", "10")));
    assert_memory_of(sli_map_read_tmx, NULL, TILE_DOOR(STAGGERED("y"), "2", "0,1,2,1,1,0"));
    assert_memory_of(sli_map_read_tmx, NULL, WITH_OBJECTS(HEXAGONAL("x"), "3", START("12", "16")));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_encodings),
        cmocka_unit_test(test_json),
        cmocka_unit_test(test_names_that_say_solid),
        cmocka_unit_test(test_layers_that_are_solid),
        cmocka_unit_test(test_objects_that_stop_some),
        cmocka_unit_test(test_layers_asked_for),
        cmocka_unit_test(test_tiles_that_are_solid),
        cmocka_unit_test(test_shapes_of_tiles),
        cmocka_unit_test(test_objects),
        cmocka_unit_test(test_ellipses),
        cmocka_unit_test(test_chunks),
        cmocka_unit_test(test_rings),
        cmocka_unit_test(test_lattices_as_json),
        cmocka_unit_test(test_random_lattices),
        cmocka_unit_test(test_few_walls_of_diamonds),
        cmocka_unit_test(test_objects_on_lattices),
        cmocka_unit_test(test_starts_and_doors_on_lattices),
        cmocka_unit_test(test_tile_shapes_on_lattices),
        cmocka_unit_test(test_templates_beside),
        cmocka_unit_test(test_layers_listed),
        cmocka_unit_test(test_damaged_data),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_entities_are_not_followed),
        cmocka_unit_test(test_long_texts),
        cmocka_unit_test(test_tilesets_beside),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

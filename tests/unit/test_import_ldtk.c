// LDtk: levels by name, worlds, layers, values, levels in files of their own, and what is refused.
#include "testing.h"

#include "import_check.h"
#include "io/io_formats.h"
#include "sightline/io.h"

#include <sys/stat.h>
#include <unistd.h>

#define GRID(name, cells, more)                                                                    \
    "{\"__identifier\": \"" name "\", \"__type\": \"IntGrid\", \"__cWid\": 3, \"__cHei\": 2, "     \
    "\"__gridSize\": 8, \"layerDefUid\": 7, \"intGridCsv\": [" cells "]" more "}"
#define LEVEL(name, x, y, layers)                                                                  \
    "{\"identifier\": \"" name "\", \"iid\": \"id-" name "\", \"worldX\": " x ", \"worldY\": " y   \
    ", \"pxWid\": 24, \"pxHei\": 16, \"layerInstances\": [" layers "]}"
#define PROJECT(more, levels)                                                                      \
    "{\"__header__\": {\"app\": \"LDtk\"}, \"worlds\": []" more ",\n\"levels\": [" levels "]}"
#define VALUES                                                                                     \
    ", \"defs\": {\"layers\": [{\"uid\": 6}, {\"uid\": 7, \"intGridValues\": [{\"value\": 1, "     \
    "\"identifier\": \"Wall\"}, {\"value\": 2, \"identifier\": null}, {\"value\": 3, "             \
    "\"identifier\": \"solid\"}]}]}"

#define TWO_TILES                                                                                  \
    "wall 0 16 8 16\nwall 8 8 24 8\nwall 8 8 8 16\nwall 0 0 24 0\nwall 0 0 0 16\nwall 24 0 24 8\n"

static void assert_walls(const char *text, const char *name, const char *layers,
                         const char *expected) {
    const sl_import_options options = {.map = name, .layers = layers};
    assert_walls_of(sli_map_read_ldtk, &options, text, strlen(text), expected);
}

static void assert_refused(const char *text, const char *message) {
    assert_refused_of(sli_map_read_ldtk, NULL, text, strlen(text), SL_BAD_INPUT, message);
}

static void assert_no_such(const char *text, const char *name, const char *layers,
                           const char *message) {
    const sl_import_options options = {.map = name, .layers = layers};
    assert_refused_of(sli_map_read_ldtk, &options, text, strlen(text), SL_BAD_ARGUMENT, message);
}

static void test_values(void **state) {
    (void)state;
    const char *nameless = PROJECT("", LEVEL("A", "0", "0", GRID("Any", "0,1,2,0,0,0", "")));
    assert_noted_of(sli_map_read_ldtk, NULL, nameless, strlen(nameless), TWO_TILES,
                    "f: values: solid, as none has a name: 1, 2; --layers Any:1+2 takes");
    // Without names all values but 0 are solid; with names those that say so.
    assert_walls(PROJECT("", LEVEL("A", "0", "0", GRID("Any", "0,1,2,0,0,0", ""))), NULL, NULL,
                 TWO_TILES);
    assert_walls(PROJECT(VALUES, LEVEL("A", "0", "0", GRID("Any", "2,1,3,4,0,2", ""))), NULL, NULL,
                 TWO_TILES);
    assert_walls(LEVEL("A", "5", "5", GRID("Any", "0,1,2,0,0,0", "")), NULL, NULL, TWO_TILES);
}

#define NAMED(name, cells, values)                                                                 \
    PROJECT(", \"defs\": {\"layers\": [{\"uid\": 7, \"intGridValues\": [" values "]}]}",           \
            LEVEL("A", "0", "0", GRID(name, cells, "")))
#define VALUE(number, name) "{\"value\": " number ", \"identifier\": \"" name "\"}"

/// Values by what their names mean: walls and rock are solid, ladders and doors are passed, water
/// stops steps alone. Ground is solid in a platformer.
static void test_values_by_meaning(void **state) {
    (void)state;
#define WATER TWO_TILES "wall 0 8 8 8 stops steps\nwall 8 8 8 0 stops steps\n"
    assert_walls(NAMED("Any", "3,1,1,2,3,3",
                       VALUE("1", "Wall") "," VALUE("2", "water") "," VALUE("3", "grass")),
                 NULL, NULL, WATER);
    assert_walls(NAMED("Any", "3,1,4,2,3,3",
                       VALUE("1", "brick_wall") "," VALUE("2", "Lava") "," VALUE(
                           "3", "Floor") "," VALUE("4", "rock")),
                 NULL, NULL, WATER);
    // Most squares are empty: earth is what one stands on.
    assert_walls(NAMED("Any", "0,1,3,2,0,0",
                       VALUE("1", "dirt") "," VALUE("2", "ladder") "," VALUE("3", "stone")),
                 NULL, NULL, TWO_TILES);
    // None is empty: grass is open.
    assert_walls(NAMED("Any", "1,3,3,1,1,2",
                       VALUE("1", "grass") "," VALUE("2", "path") "," VALUE("3", "cliff")),
                 NULL, NULL, TWO_TILES);
    // The layer says that its values are solid, but for what one passes.
    assert_walls(NAMED("Collisions", "0,1,1,2,0,0", VALUE("1", "ground") "," VALUE("2", "Ladder")),
                 NULL, NULL, TWO_TILES);
    assert_walls(NAMED("Any", "2,1,3,2,2,2",
                       VALUE("1", "Wall") "," VALUE("2", "dirt") "," VALUE("3", "water")),
                 NULL, "Any:1+3", TWO_TILES);
    // Plants, chains and spikes are no walls, nor are they ground.
    assert_walls(NAMED("Any", "0,1,1,2,3,4",
                       VALUE("1", "Terrain") "," VALUE("2", "Flora") "," VALUE(
                           "3", "Chain") "," VALUE("4", "Spikes")),
                 NULL, NULL, TWO_TILES);
    // A map seen from the side has ceilings, and its ground is solid.
    assert_walls(NAMED("Any", "0,1,2,0,0,0",
                       VALUE("1", "Ceiling") "," VALUE("2", "Ground") "," VALUE("3", "Wall")),
                 NULL, NULL, TWO_TILES);
    assert_refused(NAMED("Any", "0,1,1,1,1,1", VALUE("1", "grass")),
                   "f: the values grass (1) may be walls or open ground; if they are walls: "
                   "sightline check 'f' --map 'A' --layers 'Any' -o map.png");
    assert_no_such(NAMED("Any", "0,1,1,1,1,1", ""), NULL, "Any:x",
                   "f: layer 'Any:x': expected values such as 1+3-5");
}

#define STAND(x)                                                                                   \
    "{\"__identifier\": \"Chest\", \"px\": [" x                                                    \
    "], \"width\": 8, \"height\": 8, \"__pivot\": [0, 0]}"

/// Where only what is walkable has a value, the rest is solid; stone that entities stand on is a
/// floor.
static void test_values_by_what_stands(void **state) {
    (void)state;
    assert_walls(NAMED("Any", "1,0,0,1,1,1", VALUE("1", "WALKABLE")), NULL, NULL, TWO_TILES);
    assert_walls(NAMED("Any", "1,0,0,1,1,1", VALUE("1", "Grass")), NULL, "Any:0", TWO_TILES);
    // One passes through a thin platform, and stands on it.
    assert_walls(NAMED("Any", "1,0,0,0,0,0", VALUE("1", "pass_through")), NULL, NULL,
                 "wall 0 16 24 16\nwall 0 0 24 0\nwall 0 0 0 16\nwall 24 0 24 16\n");
#define STONES(entities)                                                                           \
    PROJECT(", \"defs\": {\"layers\": [{\"uid\": 7, \"intGridValues\": [" VALUE(                   \
                "1", "Wall") "," VALUE("2", "StoneTile") "]}]}",                                   \
            LEVEL("A", "0", "0",                                                                   \
                  GRID("Any", "2,1,1,2,2,2", "") ",{\"__type\": \"Entities\", \"__gridSize\": 8, " \
                                                 "\"entityInstances\": [" entities "]}"))
    assert_walls(STONES(STAND("0, 0") "," STAND("0, 8") "," STAND("8, 8")), NULL, NULL, TWO_TILES);
    assert_refused(
        STONES(STAND("0, 0") "," STAND("0, 8")),
        "f: level A: every cell is solid, so there are no walls; to take values by their numbers: "
        "sightline check 'f' --map 'A' --layers 'Any:1' -o map.png");
}

#define TILE(px, id) "{\"px\": [" px "], \"t\": " id "}"
#define OF_TILES(name, tilesets)                                                                   \
    PROJECT(", \"defs\": {\"layers\": [], \"tilesets\": [{\"uid\": 3" tilesets "}]}",              \
            LEVEL("A", "0", "0",                                                                   \
                  "{\"__identifier\": \"" name                                                     \
                  "\", \"__type\": \"Tiles\", \"__cWid\": 3, \"__cHei\": "                         \
                  "2, \"__gridSize\": 8, \"__tilesetDefUid\": 3, \"gridTiles\": [" TILE(           \
                      "8, 0", "5") "," TILE("16, 0",                                               \
                                            "6") "," TILE("99, 0",                                 \
                                                          "5") "," TILE("-8, 0",                   \
                                                                        "5") "," TILE("0, 8",      \
                                                                                      "7") "]}"))

/// Cells that are all empty say nothing where there are tiles, but in a layer of walls.
static void test_empty_cells(void **state) {
    (void)state;
#define EMPTY(name, tiles)                                                                         \
    PROJECT("",                                                                                    \
            LEVEL("A", "0", "0",                                                                   \
                  GRID(name, "0,0,0,0,0,0", "") ",{\"__identifier\": \"Terrain\", \"__type\": "    \
                                                "\"Tiles\", \"__cWid\": 3, \"__cHei\": 2, "        \
                                                "\"__gridSize\": 8, \"gridTiles\": [" tiles "]}"))
    assert_refused(EMPTY("Any", TILE("8, 0", "5")),
                   "f: level A has no IntGrid layer with values, and no layer of tiles whose name");
    static const char frame[] = "wall 0 16 24 16\nwall 0 0 24 0\nwall 0 0 0 16\nwall 24 0 24 16\n";
    assert_walls(EMPTY("Walls", TILE("8, 0", "5")), NULL, NULL, frame);
    assert_walls(EMPTY("Any", ""), NULL, NULL, frame);
    // Tiles can be asked for beside cells.
    assert_walls(EMPTY("Walls", TILE("8, 0", "5") "," TILE("16, 0", "6")), NULL, "Terrain",
                 TWO_TILES);
}

/// Where a level has no cells its tiles do, by their layer's name or their tileset.
static void test_tiles(void **state) {
    (void)state;
    assert_walls(OF_TILES("Any",
                          ", \"enumTags\": [{\"enumValueId\": \"Wall\", \"tileIds\": [5, 6]}, "
                          "{\"enumValueId\": \"Floor\", \"tileIds\": [7]}]"),
                 NULL, NULL, TWO_TILES);
    assert_walls(OF_TILES("Any",
                          ", \"customData\": [{\"tileId\": 5, \"data\": \"solid\"}, {\"tileId\": "
                          "6, \"data\": \"{\\\"collides\\\": true}\"}, {\"tileId\": 7, \"data\": "
                          "\"solid: false\"}]"),
                 NULL, NULL, TWO_TILES);
    assert_walls(OF_TILES("Any",
                          ", \"enumTags\": [{\"enumValueId\": \"Solid\", \"tileIds\": [5, 6]}, "
                          "{\"enumValueId\": \"Water\", \"tileIds\": [7]}]"),
                 NULL, NULL, WATER);
    static const char three[] = "wall 0 16 8 16\nwall 0 8 8 8\nwall 8 8 24 8\nwall 0 8 0 16\n"
                                "wall 8 8 8 16\nwall 8 0 24 0\nwall 8 0 8 8\nwall 24 0 24 8\n";
    assert_walls(OF_TILES("Walls", ""), NULL, NULL, three);
    assert_walls(OF_TILES("Any", ""), NULL, "Any", three);
    assert_refused(OF_TILES("Any", ""), "f: level A has no IntGrid layer, and no layer of tiles");
    // Some of the tiles, by their numbers; by a short word.
    assert_walls(OF_TILES("Any", ""), NULL, "Any:5-6", TWO_TILES);
    assert_walls(OF_TILES("Any", ", \"customData\": [{\"tileId\": 5, \"data\": \"coll\"}, "
                                 "{\"tileId\": 6, \"data\": \"coll\"}]"),
                 NULL, NULL, TWO_TILES);
    assert_no_such(OF_TILES("Any", ""), NULL, "Other",
                   "f: there is no layer 'Other' in the level; it has Any");
}

static void test_layers(void **state) {
    (void)state;
#define LAYERS                                                                                     \
    PROJECT("", LEVEL("A", "0", "0",                                                               \
                      GRID("Water", "1,1,1,1,1,0",                                                 \
                           "") ",{\"__type\": \"Entities\", "                                      \
                               "\"__identifier\": \"Walls_2\", \"entityInstances\": [{}]}," GRID(  \
                                   "Collisions", "0,1,0,0,0,0", "") "," GRID("Walls",              \
                                                                             "0,0,1,0,0,0", "")))
    // Water beside walls stops steps.
    assert_walls(LAYERS, NULL, NULL, TWO_TILES "wall 16 8 16 0 stops steps\n");
    assert_walls(LAYERS, NULL, "Walls,Collisions", TWO_TILES);
    assert_walls(LAYERS, NULL, "Water",
                 "wall 16 8 24 8\nwall 16 0 24 0\nwall 16 0 16 8\nwall 24 0 24 8\n");
    assert_no_such(LAYERS, NULL, "Water,Walls_2",
                   "f: there is no layer 'Walls_2' in the level; it has Water, Collisions, Walls");
    // A layer's offset moves it; what it does not cover is solid.
    assert_walls(PROJECT("", LEVEL("A", "0", "0",
                                   GRID("Any", "0,0,0,0,0,0",
                                        ", \"__pxTotalOffsetX\": 4, \"__pxTotalOffsetY\": -3"))),
                 NULL, NULL, "wall 4 19 28 19\nwall 4 3 28 3\nwall 4 3 4 19\nwall 28 3 28 19\n");
}

#define ENTITY(name, x, y, w, h)                                                                   \
    "{\"__identifier\": \"" name "\", \"px\": [" x ", " y "], \"__pivot\": [0, 0], \"width\": " w  \
    ", \"height\": " h "}"
#define ENTITIES(list)                                                                             \
    "{\"__identifier\": \"Things\", \"__type\": \"Entities\", \"__gridSize\": 8, "                 \
    "\"entityInstances\": [" list "]}"

/// Entities that are named for walls and drawn as boxes are walls where no layer is; those that are
/// all one cell large are marks.
static void test_walls_as_entities(void **state) {
    (void)state;
    const char *box = "wall 0 16 24 16\nwall 0 0 24 0\nwall 0 0 0 16\nwall 24 0 24 16\n"
                      "wall 4 2 16 2\nwall 16 2 16 8\nwall 16 8 4 8\nwall 4 8 4 2\n";
    assert_walls(PROJECT("", LEVEL("A", "0", "0",
                                   ENTITIES(ENTITY("Wall", "4", "8", "12",
                                                   "6") "," ENTITY("Enemy", "0", "0", "8", "8")))),
                 NULL, NULL, box);
    assert_walls(PROJECT("", LEVEL("A", "0", "0",
                                   GRID("Any", "0,1,2,0,0,0",
                                        "") "," ENTITIES(ENTITY("Wall", "4", "8", "12", "6")))),
                 NULL, NULL, TWO_TILES);
    // Beside cells those count that say that they stop a player.
    assert_walls(PROJECT("", LEVEL("A", "0", "0",
                                   GRID("Any", "0,0,0,0,0,0", "") "," ENTITIES(
                                       ENTITY("SolidBlock", "4", "8", "12", "6")))),
                 NULL, NULL, box);
    assert_walls(PROJECT("", LEVEL("A", "0", "0",
                                   GRID("Any", "0,1,2,0,0,0", "") "," ENTITIES(
                                       ENTITY("SolidBlock", "4", "8", "12", "6")))),
                 NULL, "Any", TWO_TILES);
    // Not beside all levels: they would make the map as large as their way.
    assert_walls(PROJECT("", LEVEL("A", "0", "0",
                                   GRID("Any", "0,1,2,0,0,0", "") "," ENTITIES(
                                       ENTITY("SolidBlock", "900", "8", "12", "6")))),
                 NULL, NULL, TWO_TILES);
    assert_refused(PROJECT("", LEVEL("A", "0", "0", ENTITIES(ENTITY("Wall", "8", "8", "8", "8")))),
                   "f: level A has no IntGrid layer, and no layer of tiles");
}

#define WALLED(width, step)                                                                        \
    PROJECT("",                                                                                    \
            "{\"identifier\": \"A\", \"pxWid\": " width ", \"pxHei\": 16, \"layerInstances\": "    \
            "[{\"__identifier\": \"Things\", \"__type\": \"Entities\", \"__gridSize\": " step      \
            ", \"entityInstances\": [" ENTITY("Wall", "4", "8", "12", "6") "]}]}")

/// The squares about such walls are counted from sizes that the file gives.
static void test_sizes_about_entities(void **state) {
    (void)state;
    assert_refused(WALLED("-24", "8"), "f: levels[0].pxWid: -24 is out of range");
    assert_refused(WALLED("0", "8"), "f: levels[0].pxWid: 0 is out of range");
    assert_refused(WALLED("24", "8.673617379884035e-19"),
                   "f: levels[0].layerInstances[0].__gridSize: expected a whole number");
    assert_refused(WALLED("24", "-8"),
                   "f: levels[0].layerInstances[0].__gridSize: -8 is out of range");
    assert_refused(WALLED("1000000000", "1"),
                   "f: a level, 1000000000 x 16: 16000000000 squares, more than the limit");
}

#define WORLD                                                                                      \
    LEVEL("A", "-8", "100", GRID("Any", "1,0,0,1,0,0", ""))                                        \
    "," LEVEL(                                                                                     \
        "B", "16", "108",                                                                          \
        GRID("Any", "0,0,0,0,1,1",                                                                 \
             "")) ",{\"identifier\": \"Up\", "                                                     \
                  "\"worldDepth\": 1, \"worldX\": 0, \"worldY\": 0, \"pxWid\": 8, \"pxHei\": 8}"

static void test_levels(void **state) {
    (void)state;
    static const char a[] = "wall 8 16 24 16\nwall 8 0 24 0\nwall 8 0 8 16\nwall 24 0 24 16\n";
    assert_walls(PROJECT("", WORLD), NULL, NULL, a);
    assert_walls(PROJECT("", WORLD), "A", NULL, a);
    assert_walls(PROJECT("", WORLD), "id-A", NULL, a);
    assert_walls(PROJECT("", WORLD), "B", NULL,
                 "wall 0 16 24 16\nwall 8 8 24 8\nwall 24 8 24 16\nwall 0 0 8 0\nwall 0 0 0 16\n"
                 "wall 8 0 8 8\n");
    // Side by side they are one: the way from A to B is open where both are.
    assert_walls(PROJECT("", WORLD), "all", NULL,
                 "wall 0 24 16 24\nwall 16 16 40 16\nwall 16 16 16 24\nwall 0 8 16 8\n"
                 "wall 24 8 40 8\nwall 0 8 0 24\nwall 40 8 40 16\nwall 16 0 24 0\n"
                 "wall 16 0 16 8\nwall 24 0 24 8\n");
    assert_no_such(PROJECT("", WORLD), "C", NULL, "f: there is no level or world 'C'");
    assert_no_such(LEVEL("A", "0", "0", ""), "B", NULL, "f: the level's name is 'A'");
}

static void test_layouts(void **state) {
    (void)state;
#define ROW(layout)                                                                                \
    PROJECT(", \"worldLayout\": \"" layout "\"",                                                   \
            LEVEL("A", "-1", "-1", GRID("Any", "0,0,0,0,0,0", "")) "," LEVEL(                      \
                "B", "-1", "-1", GRID("Any", "0,0,0,0,0,0", "")))
    assert_walls(ROW("LinearHorizontal"), "all", NULL,
                 "wall 0 16 48 16\nwall 0 0 48 0\nwall 0 0 0 16\nwall 48 0 48 16\n");
    assert_walls(ROW("LinearVertical"), "all", NULL,
                 "wall 0 32 24 32\nwall 0 0 24 0\nwall 0 0 0 32\nwall 24 0 24 32\n");
    // Levels off each other's grid keep walls of their own.
    assert_walls(PROJECT("", LEVEL("A", "0", "0", GRID("Any", "0,0,0,0,0,0", "")) "," LEVEL(
                                 "B", "25", "0", GRID("Any", "0,0,0,0,0,0", ""))),
                 "all", NULL,
                 "wall 0 16 24 16\nwall 0 0 24 0\nwall 0 0 0 16\nwall 24 0 24 16\n"
                 "wall 25 16 49 16\nwall 25 0 49 0\nwall 25 0 25 16\nwall 49 0 49 16\n");
}

static void test_several_worlds(void **state) {
    (void)state;
    static const char text[] =
        "{\"levels\": [], \"worlds\": [{\"identifier\": \"W1\", \"levels\": []}, {\"identifier\": "
        "\"W2\", \"levels\": [" LEVEL("A", "0", "0", GRID("Any", "0,1,1,0,0,0", "")) "]}]}";
    assert_walls(text, "A", NULL, TWO_TILES);
    assert_walls(text, "W2", NULL, TWO_TILES);
    assert_refused("{\"levels\": [], \"worlds\": []}", "f: the project has no level");
}

static void assert_list(const char *text, const char *expected) {
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_map_list list = {0};
    char names[256] = "";
    assert_ok(context, sli_map_list_ldtk(context, "f", text, strlen(text), &list));
    for (size_t i = 0; i < list.count; i++) {
        strcat(names, list.names[i]);
        strcat(names, " ");
    }
    assert_string_equal(names, expected);
    sl_map_list_destroy(context, &list);
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

static void test_list(void **state) {
    (void)state;
    assert_list(PROJECT("", WORLD), "A B Up all ");
    assert_list(PROJECT("", LEVEL("A", "0", "0", "")), "A ");
    assert_list(LEVEL("A", "0", "0", ""), "A ");
    assert_list("{\"worlds\": [{\"identifier\": \"W\", \"levels\": [" LEVEL(
                    "A", "0", "0", "") "]}, {\"identifier\": \"V\", \"levels\": []}]}",
                "A W V ");
    sl_context *context = testing_context(NULL);
    sl_map_list list = {0};
    assert_int_equal(sli_map_list_ldtk(context, "f", "{\"levels\": [{}]}", 16, &list),
                     SL_BAD_INPUT);
    assert_string_equal(sl_context_message(context),
                        "f: levels[0].identifier: expected text, found nothing");
    assert_null(list.names);
    sl_context_destroy(context);
}

static void test_refused(void **state) {
    (void)state;
    assert_refused("{", "f:1: column ");
    assert_refused("7", "f:1: column 1: no JSON");
    assert_refused("[]", "f: expected an object, found an array");
    assert_refused("{\"levels\": 7}", "f: levels: expected an array, found 7");
    assert_refused("{\"levels\": [7]}", "f: levels[0]: expected an object, found 7");
    assert_refused(
        LEVEL("A", "0", "0",
              "{\"__identifier\": \"Any\", \"__type\": \"IntGrid\", \"__cWid\": 3, "
              "\"__cHei\": 2, \"__gridSize\": 8, \"intGrid\": [{\"coordId\": 1, \"v\": 0}]}"),
        "f: layerInstances[0]: an LDtk before 0.8 wrote these cells, in a form that is "
        "not read: open the project in a newer LDtk and save it");
    assert_refused("{\"levels\": [{}]}", "f: levels[0].pxHei: expected a whole number");
    assert_refused(PROJECT("", "{\"pxHei\": 1.5}"), "f: levels[0].pxHei: expected a whole number, "
                                                    "found 1.5");
    assert_refused(PROJECT("", "{\"pxHei\": 1e308}"), "f: levels[0].pxHei: 1e+308 is out of range");
    assert_refused(PROJECT("", "{\"pxHei\": 8}"), "f: levels[0].pxWid: expected a whole number");
    assert_refused(PROJECT("", "{\"pxHei\": 8, \"pxWid\": 8}"),
                   "f: levels[0].layerInstances: expected an array");
    assert_refused(PROJECT("", LEVEL("A", "0", "0", "")), "f: level A has no IntGrid layer");
    assert_refused(PROJECT("", LEVEL("A", "0", "0", "7")),
                   "f: levels[0].layerInstances[0]: expected");
#define IN_LAYER "f: levels[0].layerInstances[0]"
    assert_refused(PROJECT("", LEVEL("A", "0", "0", GRID("Any", "0,1,1,0,0", ""))),
                   IN_LAYER ".intGridCsv: 3 x 2 cells are 6, found 5");
    assert_refused(PROJECT("", LEVEL("A", "0", "0", GRID("Any", "0,1,1,0,0,0,0", ""))),
                   IN_LAYER ".intGridCsv: 3 x 2 cells are 6, found 7");
    assert_refused(PROJECT("", LEVEL("A", "0", "0", GRID("Any", "0,1,-1,0,0,0", ""))),
                   IN_LAYER ".intGridCsv[2]: -1 is out of range");
    assert_refused(PROJECT("", LEVEL("A", "0", "0", GRID("Any", "0,1,\"1\",0,0,0", ""))),
                   IN_LAYER ".intGridCsv[2]: expected a whole number, found '1'");
    assert_refused(PROJECT("", LEVEL("A", "0", "0", "{\"__type\": \"IntGrid\", \"__cWid\": 0}")),
                   IN_LAYER ".__cWid: 0 is out of range");
    assert_refused(PROJECT("", LEVEL("A", "0", "0",
                                     "{\"__type\": \"IntGrid\", \"__cWid\": 2147483647, "
                                     "\"__cHei\": 2147483647, \"__gridSize\": 8, "
                                     "\"intGridCsv\": [1]}")),
                   IN_LAYER ".intGridCsv: 2147483647 x 2147483647 cells are");
    assert_refused(
        PROJECT("", "{\"pxHei\": 8, \"pxWid\": 8, \"externalRelPath\": \"no/such.ldtkl\"}"),
        "f: it names the file no/such.ldtkl: ");
}

/// A level's file finds its project by the name of its folder.
static void test_project_of_a_level(void **state) {
    (void)state;
    char top[] = "/tmp/sightline-ldtk-XXXXXX", folder[64], project[64], level[96];
    assert_non_null(mkdtemp(top));
    snprintf(folder, sizeof folder, "%s/p", top);
    snprintf(project, sizeof project, "%s/p.ldtk", top);
    snprintf(level, sizeof level, "%s/A.ldtkl", folder);
    assert_int_equal(mkdir(folder, 0700), 0);
    import_write_file(project, PROJECT(VALUES, ""));
    import_write_file(level, LEVEL("A", "0", "0", GRID("Any", "2,1,3,0,0,2", "")));
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_map map = {0};
    assert_ok(context, sl_io_use(context));
    assert_ok(context, sl_map_read(context, level, NULL, &map));
    char *text = map_walls_text(&map);
    assert_string_equal(text + strlen("sightline 1\n"), TWO_TILES);
    free(text);
    sl_map_destroy(context, &map);
    import_write_file(project, "{");
    assert_int_equal(sl_map_read(context, level, NULL, &map), SL_BAD_INPUT);
    assert_non_null(strstr(sl_context_message(context), "p.ldtk:1: column "));
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
    assert_int_equal(remove(project) | remove(level) | rmdir(folder) | rmdir(top), 0);
}

static void test_separate_levels(void **state) {
    (void)state;
    char folder[] = "/tmp/sightline-ldtk-XXXXXX", project[64], level[64];
    assert_non_null(mkdtemp(folder));
    snprintf(project, sizeof project, "%s/p.ldtk", folder);
    snprintf(level, sizeof level, "%s/A.ldtkl", folder);
    import_write_file(project,
                      PROJECT(VALUES, "{\"identifier\": \"A\", \"pxHei\": 16, \"pxWid\": 24, "
                                      "\"layerInstances\": null, "
                                      "\"externalRelPath\": \"A.ldtkl\"}"));
    import_write_file(level, LEVEL("A", "0", "0", GRID("Any", "2,1,3,0,0,2", "")));
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_map map = {0};
    // The project knows the names of the values.
    assert_ok(context, sl_io_use(context));
    assert_ok(context, sl_map_read(context, project, NULL, &map));
    char *text = map_walls_text(&map);
    assert_string_equal(text + strlen("sightline 1\n"), TWO_TILES);
    free(text);
    sl_map_destroy(context, &map);
    assert_ok(context, sl_map_read(context, level, NULL, &map));
    assert_int_equal(map.wall_count, 4);
    sl_map_destroy(context, &map);
    import_write_file(level, "{");
    assert_int_equal(sl_map_read(context, project, NULL, &map), SL_BAD_INPUT);
    assert_non_null(strstr(sl_context_message(context), "A.ldtkl:1: column "));
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
    assert_int_equal(remove(project) | remove(level) | rmdir(folder), 0);
}

static void test_memory(void **state) {
    (void)state;
    assert_memory_of(sli_map_read_ldtk, NULL,
                     NAMED("Any", "3,1,1,2,3,3", VALUE("1", "Wall") "," VALUE("2", "water")));
    assert_memory_of(sli_map_read_ldtk, NULL, OF_TILES("Walls", ""));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_values_by_meaning),
        cmocka_unit_test(test_walls_as_entities),
        cmocka_unit_test(test_sizes_about_entities),
        cmocka_unit_test(test_memory),
        cmocka_unit_test(test_values_by_what_stands),
        cmocka_unit_test(test_empty_cells),
        cmocka_unit_test(test_tiles),
        cmocka_unit_test(test_project_of_a_level),
        cmocka_unit_test(test_values),
        cmocka_unit_test(test_layers),
        cmocka_unit_test(test_levels),
        cmocka_unit_test(test_layouts),
        cmocka_unit_test(test_several_worlds),
        cmocka_unit_test(test_list),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_separate_levels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

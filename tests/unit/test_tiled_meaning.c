// What is solid in Tiled maps by its meaning: words of properties and names in several languages,
// weaker names, terrains, tilesets' names, and the few looks that a guess is made from.
#include "testing.h"

#include "import_check.h"
#include "io/io_formats.h"
#include "io/parts/game_names.h"

// The tiles 0 1 1 / 0 0 0 are the walls of most tests.
#define SIZE              " width='3' height='2' "
#define MAP(body)         "<map" SIZE "tilewidth='8' tileheight='8'>\n" body "</map>"
#define SET               "<tileset firstgid='1' tilewidth='8' tileheight='8'/>"
#define SET_OF(tiles)     "<tileset firstgid='1' tilewidth='8' tileheight='8'>" tiles "</tileset>"
#define LAYER(name, data) "<layer name='" name "'" SIZE ">\n" data "</layer>"
#define CSV(text)         "<data encoding='csv'>" text "</data>"
#define TRUE(name)        "<properties><property name='" name "' type='bool' value='true'/></properties>"
#define PROPERTY(name, value)                                                                      \
    "<properties><property name='" name "' value='" value "'/></properties>"
#define BOX(x, y, w, h) "<object x='" x "' y='" y "' width='" w "' height='" h "'/>"
#define TILES           CSV("0,1,1,0,0,0")
#define FULL            CSV("1,1,1,1,1,1")

#define TWO_TILES                                                                                  \
    "wall 0 16 8 16\nwall 8 8 24 8\nwall 8 8 8 16\nwall 0 0 24 0\nwall 0 0 0 16\nwall 24 0 24 8\n"
#define FRAME "wall 0 16 24 16\nwall 0 0 24 0\nwall 0 0 0 16\nwall 24 0 24 16\n"

static void assert_walls(const char *text, const char *expected) {
    assert_walls_of(sli_map_read_tmx, NULL, text, strlen(text), expected);
}

static void assert_walls_json(const char *text, const char *expected) {
    assert_walls_of(sli_map_read_tmj, NULL, text, strlen(text), expected);
}

static void assert_refused(const char *text, const char *message) {
    assert_refused_of(sli_map_read_tmx, NULL, text, strlen(text), SL_BAD_INPUT, message);
}

static void assert_refused_json(const char *text, const char *message) {
    assert_refused_of(sli_map_read_tmj, NULL, text, strlen(text), SL_BAD_INPUT, message);
}

#define UNSAID                 "f:1: nothing in it says what is solid; "
#define WIDE(body)             "<map width='6' height='4' tilewidth='8' tileheight='8'>\n" body "</map>"
#define WIDE_LAYER(name, data) "<layer name='" name "' width='6' height='4'>\n" CSV(data) "</layer>"
#define RING                   "1,1,1,1,1,1, 1,0,0,0,0,1, 1,0,0,0,0,1, 1,1,1,1,1,1"
#define RING_WALLS             "wall 8 24 40 24\nwall 8 8 40 8\nwall 8 8 8 24\nwall 40 8 40 24\n"
#define GRASS                  "7,7,7,7,7,7, 7,1,2,3,4,7, 7,5,6,8,9,7, 7,7,7,7,7,7"

/// Nothing says what is solid: a few maps have a look that tells, and a meadow has none.
static void test_guess(void **state) {
    (void)state;
    // A floor without tiles is a wall.
    assert_walls(MAP(SET LAYER("Floor", CSV("3,0,0,4,4,5")) LAYER("roof", CSV("3,9,0,4,0,0"))),
                 TWO_TILES);
    // So it is where a layer says where one walks.
    assert_walls(
        MAP(SET LAYER("map", FULL) LAYER("walkable", CSV("3,0,0,3,3,3")) LAYER("props", TILES)),
        TWO_TILES);
    assert_refused(MAP(SET LAYER("map", FULL) LAYER("walkable", FULL)), UNSAID);
    // A layer with tiles about it, and one with a ground below.
    assert_walls(WIDE(SET WIDE_LAYER("Tile Layer 1", RING)), RING_WALLS);
    assert_walls(WIDE(SET WIDE_LAYER("Tile Layer 1", "0,0,0,0,0,0, 0,0,0,0,0,0, 0,0,0,0,0,0, "
                                                     "3,3,3,3,3,3")),
                 "wall 0 32 48 32\nwall 0 8 48 8\nwall 0 8 0 32\nwall 48 8 48 32\n");
    // The tile that most of a dungeon is of.
    const char *dungeon = WIDE("<tileset firstgid='1' name='dungeon_tiles' tilewidth='8' "
                               "tileheight='8'/>" WIDE_LAYER("Bottom", GRASS));
    assert_walls(dungeon, RING_WALLS);
    // Of what is named for ground that tile is none.
    assert_refused(
        WIDE("<tileset firstgid='1' name='dungeon_tiles' tilewidth='8' "
             "tileheight='8'/>" WIDE_LAYER("Ground/terrain", GRASS)),
        "f:1: nothing in it says what is solid; to take a layer as solid: sightline check "
        "'f' --layers 'Ground/terrain:1-6+8-9' -o map.png");
    // The same tiles as a meadow; a layer beside the floor; a layer that is full.
    assert_refused(WIDE(SET WIDE_LAYER("Ground", GRASS)), UNSAID);
    assert_refused(WIDE(SET WIDE_LAYER("Tile Layer 1", GRASS)), UNSAID);
    assert_refused(MAP(SET LAYER("floor", CSV("3,0,0,4,4,5")) LAYER("b", CSV("3,9,0,4,0,0"))),
                   UNSAID "to take a layer as solid: sightline check 'f' --layers 'b' -o "
                          "map.png; layers: 'floor' (4 tiles), 'b' (3 tiles)");
    assert_refused(MAP(SET LAYER("a", CSV("1,1,1,1,1,1")) "<group name='g'><objectgroup name='b'/>"
                                                          "</group>"),
                   UNSAID);
    // Of a full layer the command asks for the tiles but the most frequent one.
    assert_refused(WIDE(SET WIDE_LAYER("Ground", GRASS)),
                   UNSAID "to take a layer as solid: sightline check 'f' --layers "
                          "'Ground:1-6+8-9' -o map.png; layers: 'Ground' (24 tiles)");
    assert_refused(MAP(SET LAYER("Ground", FULL)),
                   UNSAID "all tiles of 'Ground' are the same: draw walls in a layer Collision; "
                          "layers: 'Ground' (6 tiles)");
    // The command says where it is not sure, and names tiles where most of the layer is one tile.
    assert_refused(MAP(SET LAYER("a", TILES) LAYER("b", CSV("0,0,0,2,2,0"))), UNSAID
                   "perhaps, if a look shows so: sightline check 'f' --layers 'a' -o map.png; "
                   "layers: 'a' (2 tiles), 'b' (2 tiles)");
    assert_refused(MAP(SET LAYER("Tile Layer in the north of the town with all its harbour", TILES)
                           LAYER("sand", CSV("0,0,0,2,2,0"))),
                   UNSAID "to take a layer as solid: sightline check 'f' --layers "
                          "'Tile Layer in the north of the town with all its harbour' -o map.png");
    assert_refused(MAP(SET LAYER("a", TILES) LAYER("sand", CSV("0,0,0,2,2,0"))),
                   UNSAID "to take a layer as solid: sightline check 'f' --layers 'a' -o "
                          "map.png; layers: 'a' (2 tiles), 'sand' (2 tiles)");
    // No command can name a layer whose name has a comma, a quote or a blank at its end.
    assert_refused(MAP(SET LAYER("a, b", TILES)), UNSAID
                   "to take 'a, b', give it a name in Tiled "
                   "without commas, quotes and blanks at its ends; layers: 'a, b' (2 tiles)");
    assert_refused(MAP(SET LAYER("b ", TILES)), UNSAID "to take 'b ',");
    assert_refused(MAP(SET LAYER("Ground", CSV("1,1,2,2,3,3"))),
                   UNSAID "which of the tiles 1-3 of 'Ground' are "
                          "solid, only its picture shows: a tile's number is its ID in Tiled + the "
                          "tileset's firstgid; layers: 'Ground' (6 tiles)");
    // One that starts inside the wall says that the guess is wrong.
    assert_refused(WIDE(SET WIDE_LAYER("Tile Layer 1", RING) "<objectgroup name='o'><object "
                                                             "name='Player' x='4' y='4'/>"
                                                             "</objectgroup>"),
                   "f:1: nothing in it says what is solid, and a start stands on what looks so");
    assert_refused(
        MAP(SET LAYER("walls", CSV("1,1,1,1,1,1"))),
        "f:1: layer 'walls' has a tile on every square, so all is solid and there are no "
        "walls; name its tiles that are solid, as in --layers 'walls'");
    assert_refused(MAP(SET LAYER("a", CSV("0,0,0,0,0,0"))),
                   "f:1: nothing in it says what is solid; all its layers are empty");
    assert_refused(MAP(""), "f:1: nothing in it says what is solid; it has no layers");
}

/// Ground below the air is solid, beside what lies on it; not where other layers fill the air.
static void test_ground_below_air(void **state) {
    (void)state;
#define AIR   "0,0,0,0,0,0, 0,0,0,0,0,0, 0,0,0,0,0,0, "
#define FRONT SET WIDE_LAYER("groundLayer", AIR "3,3,3,3,0,3")
    assert_walls(WIDE(FRONT WIDE_LAYER("acid", AIR "0,0,0,0,4,0")
                          WIDE_LAYER("flag", "0,0,0,0,0,0, 0,0,0,0,0,0, 0,0,0,0,0,5, 0,0,0,0,0,0")
                              WIDE_LAYER("backGround", GRASS)),
                 "wall 0 32 48 32\nwall 0 8 32 8\nwall 40 8 48 8\nwall 0 8 0 32\n"
                 "wall 48 8 48 32\nwall 32 0 40 0\nwall 32 0 32 8\nwall 40 0 40 8\n");
    assert_refused(WIDE(FRONT WIDE_LAYER("base", GRASS)), UNSAID);
    assert_refused(
        WIDE(FRONT WIDE_LAYER("a", AIR "0,0,0,0,4,0") WIDE_LAYER("more ground", AIR "0,0,0,0,4,0")),
        UNSAID);
}

#define HALL(name, inner)                                                                          \
    "<map width='10' height='6' tilewidth='8' tileheight='8'>" SET "<layer name='" name            \
    "' width='10' height='6'>" CSV("2,2,3,3,2,2,2,2,2,2, 2,1,1,1,1,1,1,1,1,2, "                    \
                                   "2,1,1," inner ",1,1,1,1,2, 3,1,1,1,1,1,1,1,1,2, "              \
                                   "3,1,1,1,1,1,1,1,1,2, 2,2,2,2,2,2,2,2,2,2") "</layer>"

/// A floor that does not come to the edge, with walls of the edge's tiles.
static void test_floor_within_walls(void **state) {
    (void)state;
    assert_walls(HALL("Tile Layer 1", "2,3") "</map>",
                 "wall 8 40 72 40\nwall 24 32 40 32\nwall 24 24 40 24\nwall 24 24 24 32\n"
                 "wall 40 24 40 32\nwall 8 8 72 8\nwall 8 8 8 40\nwall 72 8 72 40\n");
    // A meadow with flowers; a layer that is named for ground; a start in the trees.
    assert_refused(HALL("Tile Layer 1", "8,9") "</map>", UNSAID);
    assert_refused(HALL("Grass", "2,3") "</map>", UNSAID);
    assert_refused(HALL("Tile Layer 1", "2,3") "<objectgroup><object name='start' x='4' "
                                               "y='4'/></objectgroup></map>",
                   "f:1: nothing in it says what is solid, and a start stands on what looks so");
}

/// Walls are a picture where a layer that stops lies on them: it leaves the doorway open.
static void test_pictures_of_walls(void **state) {
    (void)state;
#define DOORWAY CSV("0,1,1,0,1,0")
#define STOPS_TWO                                                                                  \
    "<objectgroup name='objects'><object type='collision' x='8' y='0' width='16' height='8'/>"     \
    "</objectgroup>"
    assert_walls(MAP(SET LAYER("walls1", DOORWAY) LAYER("collisions", TILES)), TWO_TILES);
    assert_walls(MAP(SET LAYER("CollisionHorizontal", TILES) LAYER("Walls", DOORWAY)), TWO_TILES);
    assert_walls(MAP(SET "<group name='walls'>" LAYER(
                     "a", DOORWAY) "</group><group name='collision'>" LAYER("b", TILES) "</group>"),
                 TWO_TILES);
    // Objects draw their own walls.
    assert_walls(MAP(SET LAYER("walls", DOORWAY) STOPS_TWO),
                 "wall 8 16 24 16\nwall 24 16 24 8\nwall 24 8 8 8\nwall 8 8 8 16\n" FRAME);
    // Elsewhere they are furniture, and of another meaning they are none.
    assert_walls(MAP(SET LAYER("walls", TILES) LAYER("collision", CSV("0,0,0,0,0,1"))),
                 "wall 0 16 8 16\nwall 8 8 16 8\nwall 8 8 8 16\nwall 0 0 16 0\nwall 0 0 0 16\nwall "
                 "16 0 16 8\n");
    assert_walls(MAP(SET LAYER("walls", TILES) LAYER("enemy collision", DOORWAY)), TWO_TILES);
    assert_walls(MAP(SET LAYER("walls", TILES) LAYER("Light-Collisions", DOORWAY)), TWO_TILES);
}

/// A layer "World" is solid where nothing else says more, also beside layers of walls without
/// tiles.
static void test_world(void **state) {
    (void)state;
    assert_walls(MAP(SET LAYER("leftCollider", CSV("0,0,0,0,0,0")) LAYER("World", TILES)
                         LAYER("Ground", FULL)),
                 TWO_TILES);
    // Firmer words go first.
    assert_walls(MAP(SET LAYER("World", CSV("0,0,0,0,1,1")) LAYER("Walls", TILES)), TWO_TILES);
}

/// What the player goes over or under is not solid beside a layer that is, whatever its tiles say.
static void test_beside_player(void **state) {
    (void)state;
#define TILE_1_COLLIDES SET_OF("<tile id='0'>" TRUE("collides") "</tile>")
#define ONE_BELOW       CSV("0,0,0,1,0,2")
    assert_walls(MAP(TILE_1_COLLIDES LAYER("Below Player", ONE_BELOW) LAYER("World", TILES)),
                 TWO_TILES);
    assert_walls(MAP(TILE_1_COLLIDES LAYER("World", TILES) LAYER("abovePlayer", ONE_BELOW)),
                 TWO_TILES);
    assert_walls(MAP(TILE_1_COLLIDES LAYER("Below Player", ONE_BELOW) LAYER("Walls", TILES)),
                 TWO_TILES);
    assert_walls(MAP(TILE_1_COLLIDES LAYER("belowplayer", ONE_BELOW) LAYER("World", TILES)),
                 TWO_TILES);
    // Alone they count.
    assert_walls(MAP(TILE_1_COLLIDES LAYER("Below Player", TILES)), TWO_TILES);
    // A name that does not say so much is no reason.
    assert_walls(
        MAP(TILE_1_COLLIDES LAYER("Below", CSV("0,1,0,0,0,0")) LAYER("World", CSV("0,0,1,0,0,0"))),
        TWO_TILES);
}

/// In a layer named for walls, tiles that say that they are solid go over the name: a door's tile
/// without the property stands open. Few such tiles leave the layer whole, and this is said.
static void test_tiles_over_names(void **state) {
    (void)state;
    const char *door = MAP(TILE_1_COLLIDES LAYER("walls", CSV("2,1,1,0,0,0")));
    const char *chunks =
        "<map infinite='1'" SIZE "tilewidth='8' tileheight='8'>" TILE_1_COLLIDES
        "<layer name='walls'" SIZE "><data encoding='csv'>"
        "<chunk x='0' y='0' width='2' height='2'>2,1,0,0</chunk>"
        "<chunk x='2' y='0' width='2' height='2'>1,0,0,0</chunk></data></layer></map>";
    assert_noted_of(
        sli_map_read_tmx, NULL, door, strlen(door), TWO_TILES,
        "f: layer 'walls': 2 of its 3 tiles say that they are solid, and the others are "
        "taken as open; if these are walls: sightline check 'f' --layers 'walls' -o map.png\n");
    // The others are taken no more.
    const char *two =
        MAP(TILE_1_COLLIDES LAYER("walls", CSV("2,1,1,0,0,0")) LAYER("things", CSV("0,0,0,1,0,0")));
    assert_noted_of(sli_map_read_tmx, NULL, two, strlen(two),
                    "wall 0 16 8 16\nwall 0 8 8 8\nwall 0 8 0 16\nwall 8 8 8 16\n",
                    "--layers 'walls' -o map.png, which takes no other layer\n");
    assert_noted_of(sli_map_read_tmx, NULL, chunks, strlen(chunks),
                    "wall 0 16 8 16\nwall 24 16 32 16\nwall 8 8 24 8\nwall 8 8 8 16\n"
                    "wall 24 8 24 16\nwall 0 0 32 0\nwall 0 0 0 16\nwall 32 0 32 16\n",
                    "2 of its 3 tiles say that they are solid");
    // What a shape of a tile draws, is drawn; a layer that stops by its name is whole.
    assert_walls(
        MAP(SET_OF("<tile id='0'>" TRUE("collides") "</tile><tile id='1'><objectgroup>" BOX(
            "2", "2", "4", "4") "</objectgroup></tile>") LAYER("walls", CSV("2,1,1,0,0,0"))),
        "wall 2 14 6 14\nwall 6 14 6 10\nwall 6 10 2 10\nwall 2 10 2 14\n" TWO_TILES);
    const char *stops = MAP(TILE_1_COLLIDES LAYER("collision", CSV("0,1,2,0,0,0")));
    assert_noted_of(
        sli_map_read_tmx, NULL, stops, strlen(stops), TWO_TILES,
        "f: layer 'collision' is taken whole by its name, and only 1 of its 2 tiles says "
        "that it is solid; if no others are: sightline check 'f' --layers 'collision:1' "
        "-o map.png\n");
    const char *few = MAP(TILE_1_COLLIDES LAYER("walls", CSV("0,2,2,0,0,0"))
                              LAYER("Walls 2", CSV("1,2,2,0,0,0")));
    assert_noted_of(sli_map_read_tmx, NULL, few, strlen(few),
                    "wall 0 8 24 8\nwall 0 0 24 0\nwall 0 0 0 8\nwall 24 0 24 8\n",
                    "f: layer 'Walls 2' is taken whole by its name, and only 1 of its 3 tiles says "
                    "that it is solid; if no others are: sightline check 'f' --layers 'Walls 2:1' "
                    "-o map.png, which takes no other layer\n");
}

/// Tiles that say that they are open are open in a layer named for collision, too; a note says so.
static void test_tiles_deny_the_name(void **state) {
    (void)state;
#define TILE_2_OPEN                                                                                \
    SET_OF("<tile id='0'>" TRUE(                                                                   \
        "collide") "</tile><tile id='1'><properties><property "                                    \
                   "name='collide' type='bool' value='false'/></properties></tile>")
    const char *text = MAP(TILE_2_OPEN LAYER("Collision", CSV("2,1,1,2,2,2")));
    assert_noted_of(sli_map_read_tmx, NULL, text, strlen(text), TWO_TILES,
                    "f: layer 'Collision' is named for what is solid, but 4 of its 6 tiles say "
                    "that they are open, and so they are taken; if they are solid: sightline check "
                    "'f' --layers 'Collision:1-2' -o map.png\n");
#undef TILE_2_OPEN
}

/// Tiles in a layer named for doors are doors where they are solid, else open ground; a note says
/// so.
static void test_layers_named_for_doors(void **state) {
    (void)state;
    const char *open =
        MAP(TILE_1_COLLIDES LAYER("Walls", TILES) LAYER("Closed Doors", CSV("2,0,0,0,0,0")));
    assert_noted_of(sli_map_read_tmx, NULL, open, strlen(open), TWO_TILES,
                    "f: layer 'Closed Doors' (1 tile) is named for doors, and is taken as open: if "
                    "it is solid: sightline check 'f' --layers 'Walls,Closed Doors' -o map.png; "
                    "tiles of the class 'door' are doors\n");
}

/// A property that says it outright goes before what a property "name" calls the tile.
static void test_outright_before_name(void **state) {
    (void)state;
#define CALLED(more)                                                                               \
    SET_OF("<tile id='0'><properties><property name='name' value='wall'/>" more                    \
           "</properties></tile>")
    assert_walls(MAP(CALLED("") LAYER("World", CSV("0,1,1,0,0,0"))), TWO_TILES);
    static const char open[] =
        MAP(CALLED("<property name='solid' type='bool' value='false'/>")
                LAYER("World", CSV("1,1,1,0,0,0")) LAYER("collision", CSV("0,2,2,0,0,0")));
    assert_walls(open, TWO_TILES);
}

/// One solid tile of a hundred is a doubt.
static void test_few_solid_tiles(void **state) {
    (void)state;
#define HUNDRED(first)                                                                             \
    "<map width='10' height='10' tilewidth='8' tileheight='8'>" TILE_1_COLLIDES                    \
    "<layer name='ground' width='10' height='10'>" CSV(first ROW ROW ROW ROW ROW ROW ROW ROW ROW   \
                                                       "3,3,3,3,3,3,3,3") "</layer></map>"
#define ROW "3,3,3,3,3,3,3,3,3,3,"
    assert_noted_of(
        sli_map_read_tmx, NULL, HUNDRED("1,3,"), strlen(HUNDRED("1,3,")),
        "wall 8 80 80 80\nwall 0 72 8 72\nwall 8 72 8 80\nwall 0 0 80 0\n"
        "wall 0 0 0 72\nwall 80 0 80 80\n",
        "f: only 1 of 100 tiles says that it is solid, and nothing else does; to take a "
        "layer as solid: sightline check 'f' --layers 'ground:1' -o map.png; layers of "
        "tiles: 'ground' (100 tiles)\n");
}

/// A property on nearly all tiles, the floor's too, says nothing.
static void test_all_solid(void **state) {
    (void)state;
    const char *both = MAP(SET_OF("<tile id='0'>" TRUE("solid") "</tile>") LAYER("Ground", FULL)
                               LAYER("Walls", TILES));
    assert_walls(both, TWO_TILES);
    assert_refused(
        MAP(SET_OF("<tile id='0'>" TRUE("solid") "</tile>") LAYER("Ground", FULL)),
        "f:1: nearly all of its tiles say that they are solid; all tiles of 'Ground' are");
}

/// What is no whole map is named.
static void test_tile_size(void **state) {
    (void)state;
    assert_refused("<map width='1' height='1'/>",
                   "f:1: it does not say how large its tiles are (tilewidth); a map saved by");
    assert_refused("<map width='1' height='1' tilewidth='8'/>",
                   "f:1: it does not say how large its tiles are (tileheight)");
}

/// Enemies and triggers among walls are none; a chest is.
static void test_passing_objects(void **state) {
    (void)state;
    const char *box =
        "<map width='3' height='2' tilewidth='8' tileheight='8'><objectgroup "
        "name='Collision'><object name='Goblin' x='8' y='4' width='2' height='2'/>"
        "<object type='trigger' x='8' y='8' width='2' height='2'/>"
        "<object name='chest' x='16' y='8' width='4' height='4'/></objectgroup></map>";
    assert_walls(box, "wall 16 8 20 8\nwall 20 8 20 4\nwall 20 4 16 4\nwall 16 4 16 8\n" FRAME);
}

/// Objects without a name have it as a property: walls and starts.
static void test_names_as_properties(void **state) {
    (void)state;
    assert_walls(
        MAP(SET LAYER("a", FULL) "<objectgroup name='b'>"
                                 "<object x='8' y='0' width='8' height='8'>" PROPERTY(
                                     "name", "Solid") "</object>"
                                                      "<object x='4' y='12'>" PROPERTY(
                                                          "Name",
                                                          "start") "</object></objectgroup>"),
        "wall 8 16 16 16\nwall 16 16 16 8\nwall 16 8 8 8\nwall 8 8 8 16\n" FRAME "start 4 4 0\n");
}

/// Weaker names count where there are no firm ones, the firmest of them alone.
static void test_weaker_names(void **state) {
    (void)state;
    assert_walls(MAP(SET LAYER("Ground", FULL) LAYER("Trees", TILES)), TWO_TILES);
    assert_walls(MAP(SET LAYER("Ground", FULL) LAYER("meta", TILES)), TWO_TILES);
    assert_walls(MAP(SET LAYER("Trees", CSV("0,0,0,1,0,0")) LAYER("Platforms", TILES)), TWO_TILES);
    assert_walls(MAP(SET LAYER("Trees", CSV("0,0,0,1,0,0")) LAYER("walls of Rome", TILES)),
                 TWO_TILES);
    assert_walls(MAP(SET LAYER("inner walls", TILES) LAYER("Trees", CSV("0,0,0,1,0,0"))),
                 TWO_TILES);
    assert_walls(MAP(SET "<group name='Houses'>" LAYER("a", TILES)
                         LAYER("roofs", CSV("0,0,0,1,0,0")) "</group>"),
                 TWO_TILES);
    // What one stands on in a platformer is often called so; not a storey, nor what holds all.
    assert_walls(MAP(SET LAYER("BG", FULL) LAYER("BG Detail", TILES) LAYER("Level", TILES)),
                 TWO_TILES);
    assert_refused(MAP(SET LAYER("Ground", FULL) LAYER("Level 2", TILES)), UNSAID);
    assert_refused(
        MAP(SET "<group name='Level'>" LAYER("Ground", FULL) LAYER("a", TILES) "</group>"), UNSAID);
    // Firm words are before them; tiles that say so too.
    assert_walls(MAP(SET LAYER("Trees", CSV("0,0,0,1,0,0")) LAYER("collision", TILES)), TWO_TILES);
    assert_walls(
        MAP(SET_OF("<tile id='4'>" TRUE("Collidable") "</tile>") LAYER("Meta", CSV("2,5,5,2,0,0"))),
        TWO_TILES);
    // What is drawn over the player, what is full, and what moves against the rest is none.
    assert_refused(MAP(SET LAYER("Ground", FULL) LAYER("tree tops", TILES)), UNSAID);
    assert_refused(MAP(SET LAYER("Mountains", FULL)), UNSAID);
    assert_refused(MAP(SET "<layer name='Trees' parallaxx='0.5'" SIZE ">" TILES
                           "</layer>" LAYER("Ground", FULL)),
                   UNSAID);
    // Objects count as tiles do, but for those that may be places only.
#define BOX_IN(name) "<objectgroup name='" name "'>" BOX("8", "0", "8", "8") "</objectgroup>"
    assert_walls(MAP(SET LAYER("Ground", FULL) BOX_IN("Platforms")),
                 "wall 8 16 16 16\nwall 16 16 16 8\nwall 16 8 8 8\nwall 8 8 8 16\n" FRAME);
    assert_refused(MAP(SET LAYER("Ground", FULL) BOX_IN("Houses")), UNSAID);
    // Bodies of a platformer beside its enemies: four boxes at least, of which nothing is said.
#define FOUR_IN(name, y)                                                                           \
    "<objectgroup name='" name "'>" BOX("8", y, "8", "8") BOX("8", y, "8", "8")                    \
        BOX("8", y, "8", "8") BOX("8", y, "8", "8") "</objectgroup>"
#define FOUR_BOXES "wall 8 16 16 16\nwall 16 16 16 8\nwall 16 8 8 8\nwall 8 8 8 16\n"
    assert_walls(MAP(SET LAYER("Graphics", FULL) FOUR_IN("Ground Layer", "0")
                         FOUR_IN("Goombas", "8") FOUR_IN("grass", "8")),
                 FOUR_BOXES FOUR_BOXES FOUR_BOXES FOUR_BOXES FRAME);
    // A race's finish and the bots' way are no walls.
#define NAMED(name) "<object name='" name "' x='8' y='0' width='8' height='8'/>"
    assert_refused(MAP(SET LAYER("Ground", FULL) "<objectgroup name='meta'>" NAMED("finish")
                           NAMED("route 1") "</objectgroup>"),
                   UNSAID);
}

/// An object that shows a tile has the tile's collision shapes, stretched and mirrored as it is.
static void test_shapes_of_tile_objects(void **state) {
    (void)state;
#define SHOWN(more)                                                                                \
    MAP(SET_OF("<tile id='4'><objectgroup>" BOX("1", "2", "3", "4") "</objectgroup></tile>")       \
            LAYER("a", FULL) "<objectgroup name='things'><object " more "/></objectgroup>")
#define AS_BOX(a, b, c, d)                                                                         \
    "wall " a " " b "\nwall " b " " c "\nwall " c " " d "\nwall " d " " a "\n" FRAME
    assert_walls(SHOWN("gid='5' x='8' y='8' width='8' height='8'"),
                 AS_BOX("9 14", "12 14", "12 10", "9 10"));
    assert_walls(SHOWN("gid='5' x='8' y='8'"), AS_BOX("9 14", "12 14", "12 10", "9 10"));
    assert_walls(SHOWN("gid='5' x='0' y='16' width='16' height='16'"),
                 AS_BOX("2 12", "8 12", "8 4", "2 4"));
    assert_walls(SHOWN("gid='2147483653' x='8' y='8' width='8' height='8'"),
                 AS_BOX("15 14", "12 14", "12 10", "15 10"));
    assert_walls(SHOWN("gid='5' x='8' y='8' width='8' height='8' rotation='90'"),
                 AS_BOX("14 7", "14 4", "10 4", "10 7"));
    assert_refused(SHOWN("gid='5' name='slime' x='8' y='8' width='8' height='8'"), UNSAID);
    assert_refused(SHOWN("gid='6' x='8' y='8' width='8' height='8'"), UNSAID);
}

/// A layer that is named for walls and holds nothing does not decide.
static void test_empty_layers(void **state) {
    (void)state;
    assert_walls(MAP(SET LAYER("walls", CSV("0,0,0,0,0,0")) "<objectgroup name='collision'/>" LAYER(
                     "Trees", TILES)),
                 TWO_TILES);
    assert_walls(MAP(SET LAYER("walls", CSV("0,0,0,0,0,0")) LAYER("ground", FULL)), FRAME);
    assert_refused(MAP(SET LAYER("no collision", TILES) LAYER("ground", FULL)), UNSAID);
}

#define TILE_WITH(property)                                                                        \
    MAP(SET_OF("<tile id='4'>" property "</tile>") LAYER("a", CSV("2,5,5,2,0,0")))

static void test_words_of_properties(void **state) {
    (void)state;
    static const char *const solid[] = {
        TILE_WITH(PROPERTY("collidable", "true")),   TILE_WITH(PROPERTY("Collides", "1")),
        TILE_WITH(PROPERTY("isWall", "True")),       TILE_WITH(PROPERTY("ge_collide", "true")),
        TILE_WITH(PROPERTY("walkable", "false")),    TILE_WITH(PROPERTY("isPassable", "0")),
        TILE_WITH(PROPERTY("type", "wall")),         TILE_WITH(PROPERTY("blocked", "yes")),
        TILE_WITH(PROPERTY("can_walk", "no")),       TILE_WITH(PROPERTY("obstacle", "full")),
        TILE_WITH(PROPERTY("hasCollision", "true")), TILE_WITH(PROPERTY("not walkable", "true")),
        TILE_WITH(PROPERTY("bodyType", "static")),   TILE_WITH(PROPERTY("Name", "Solid")),
        TILE_WITH(PROPERTY("area_type", "wall")),
    };
    static const char *const open[] = {
        TILE_WITH(PROPERTY("collidable", "false")),  TILE_WITH(PROPERTY("walkable", "true")),
        TILE_WITH(PROPERTY("exitUrl", "wall.json")), TILE_WITH(PROPERTY("type", "wallpaper")),
        TILE_WITH(PROPERTY("solid", "maybe")),       TILE_WITH(PROPERTY("wall_height", "3")),
        TILE_WITH(PROPERTY("bodyType", "dynamic")),  TILE_WITH(PROPERTY("name", "wall lamp")),
    };
    for (size_t i = 0; i < sizeof solid / sizeof *solid; i++) assert_walls(solid[i], TWO_TILES);
    for (size_t i = 0; i < sizeof open / sizeof *open; i++) assert_refused(open[i], UNSAID);
    assert_walls(MAP(SET PROPERTY("collisionLayer", "b, c") LAYER("a", FULL) LAYER("b", TILES)),
                 TWO_TILES);
    // A layer of WorkAdventure that leads elsewhere is no wall.
    assert_refused(MAP(SET LAYER("exit", PROPERTY("exitUrl", "#start") TILES)), UNSAID);
}

static void test_names_in_languages(void **state) {
    (void)state;
    static const char *const solid[] = {"Mauern",       "W\xc3\xa4nde",
                                        "W\xc3\x84NDE", "murs",
                                        "Muros",        "paredes",
                                        "colisiones",   "\xd0\xa1\xd1\x82\xd0\xb5\xd0\xbd\xd1\x8b",
                                        "\xe5\xa2\x99", "\xe7\xa2\xb0\xe6\x92\x9e\xe5\xb1\x82",
                                        "no walk",      "not passable",
                                        "unwalkable",   "inner walls",
                                        "Castle_Walls", "bounds",
                                        "estSolide",    "es_s\xc3\xb3lido"};
    static const char *const others[] = {"wall_tops", "Walls behind", "wall deco", "no walls",
                                         "walk",      "Grass",        "Overhead",  "M\xc3\xa4user",
                                         "wallpaper", "camera bounds"};
    for (size_t i = 0; i < sizeof solid / sizeof *solid; i++)
        if (sli_game_kind_of(solid[i]) != SLI_GAME_SOLID) fail_msg("%s", solid[i]);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (sli_game_kind_of(others[i]) == SLI_GAME_SOLID) fail_msg("%s", others[i]);
    assert_int_equal(sli_game_kind_of("stone floor"), SLI_GAME_FLOOR);
    assert_int_equal(sli_game_kind_of("Water"), SLI_GAME_WATER);
    assert_int_equal(sli_game_kind_of("Ladder"), SLI_GAME_PASS);
    assert_int_equal(sli_game_kind_of("Tile Layer 1"), SLI_GAME_UNSAID);
}

/// Terrains, colours of Wang sets, and at last the names of tilesets.
static void test_terrains(void **state) {
    (void)state;
#define WANG(name, color, id)                                                                      \
    "<wangsets><wangset name='" name "'><wangcolor name='" color "'/><wangcolor name='Floor'/>"    \
    "<wangtile tileid='4' wangid='" id "'/><wangtile tileid='1' wangid='2,2,2,2,2,2,2,1'/>"        \
    "</wangset></wangsets>"
#define TERRAIN                                                                                    \
    "<terraintypes><terrain name='Wall'/><terrain name='Floor'/></terraintypes>"                   \
    "<tile id='4' terrain='0,0,,1'/><tile id='1' terrain='1,1,1,0'/>"
#define DRAWN MAP(SET_OF("%s") LAYER("a", CSV("2,5,5,2,2,2")))
    static const char *const solid[] = {WANG("Dungeon", "Wall", "0,1,0,1,0,1,0,1"),
                                        WANG("Dungeon", "stone walls", "2,1,2,1,1,1,2,2"),
                                        WANG("Walls", "", "0,1,0,0,0,0,0,0"), TERRAIN};
    static const char *const others[] = {
        WANG("Dungeon", "Grass", "0,1,0,1,0,1,0,1"), WANG("Dungeon", "Wall", "2,2,2,2,2,2,2,1"),
        WANG("Dungeon", "Wall", "9,9,,x,0,99999999999999999999"),
        "<terraintypes><terrain name='Brick'/></terraintypes><tile id='4' terrain='0,0,0,0'/>"};
    char text[2048];
    for (size_t i = 0; i < sizeof solid / sizeof *solid; i++) {
        snprintf(text, sizeof text, DRAWN, solid[i]);
        assert_walls(text, TWO_TILES);
    }
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        snprintf(text, sizeof text, DRAWN, others[i]);
        assert_refused(text, UNSAID);
    }
#define TWO_SETS(name)                                                                             \
    MAP("<tileset firstgid='1' name='" name "' tilewidth='8' tileheight='8'/><tileset "            \
        "firstgid='9' name='ground' tilewidth='8' tileheight='8'/>" LAYER("a",                     \
                                                                          CSV("9,1,2,9,9,9")))
    assert_walls(TWO_SETS("Walls"), TWO_TILES);
    assert_refused(TWO_SETS("overworld"), UNSAID);
    // So may pictures be: that of a set, and those that single tiles have.
#define PICTURES(of_set, of_tile)                                                                  \
    MAP("<tileset firstgid='1' name='a' tilewidth='8' tileheight='8'>" of_set                      \
        "<tile id='0'><image source='" of_tile "'/></tile><tile id='1'><image "                    \
        "source='floor.png'/></tile></tileset><tileset firstgid='9' tilewidth='8' "                \
        "tileheight='8'/>" LAYER("a", CSV("9,1,1,2,9,9")))
    assert_walls(PICTURES("", "img/Brick_Wall-2.png"), TWO_TILES);
    assert_refused(PICTURES("", "img/walls/tile.png"), UNSAID);
    assert_refused(PICTURES("", "wall_top.png"), UNSAID);
    assert_walls(MAP("<tileset firstgid='1' tilewidth='8' tileheight='8'><image "
                     "source='../walls.png'/></tileset><tileset firstgid='9' tilewidth='8' "
                     "tileheight='8'/>" LAYER("a", CSV("9,1,2,9,9,9"))),
                 TWO_TILES);
    // A set that all tiles are of says nothing.
    assert_refused(MAP("<tileset firstgid='1' name='Walls' tilewidth='8' tileheight='8'/>" LAYER(
                       "a", CSV("1,2,0,1,1,1"))),
                   UNSAID);
}

/// Tilesets of JSON files before Tiled 1.2 have their tiles by number, and properties apart.
static void test_old_json(void **state) {
    (void)state;
#define OLD(set)                                                                                   \
    "{\"width\": 3, \"height\": 2, \"tilewidth\": 8, \"tileheight\": 8, \"tilesets\": [{"          \
    "\"firstgid\": 1, \"tilewidth\": 8, \"tileheight\": 8, " set "}], \"layers\": [{\"type\": "    \
    "\"tilelayer\", \"name\": \"a\", \"width\": 3, \"height\": 2, \"data\": [2,5,5,2,2,2]}]}"
    assert_walls_json(OLD("\"tileproperties\": {\"4\": {\"collides\": true}}"), TWO_TILES);
    assert_walls_json(OLD("\"tileproperties\": {\"4\": {\"collides\": \"1\"}, \"1\": {\"x\": 1}}, "
                          "\"tiles\": {\"1\": {\"terrain\": [0, 0, 0, 0]}}"),
                      TWO_TILES);
    assert_walls_json(
        OLD("\"tiles\": {\"4\": {\"objectgroup\": {\"objects\": [{\"x\": 0, \"y\": 0, "
            "\"width\": 8, \"height\": 8}]}}}"),
        TWO_TILES);
    assert_walls_json(OLD("\"terrains\": [{\"name\": \"Wall\"}], \"tiles\": {\"4\": {\"terrain\": "
                          "[0, 0, -1, -1]}}"),
                      TWO_TILES);
    assert_refused_json(OLD("\"tileproperties\": {\"-4\": {\"collides\": true}, \"x\": 7}"),
                        "f: nothing in it says what is solid");
}

/// A layer of tiles where one starts: in the middle of the tile next to the middle of all.
static void test_start_layers(void **state) {
    (void)state;
#define STARTS(name, more)                                                                         \
    WIDE(SET WIDE_LAYER(                                                                           \
        "walls", RING) "<layer name='" name "' width='6' "                                         \
                       "height='4'>" more CSV(                                                     \
                           "0,0,0,0,0,0, 0,0,1,1,1,0, 0,0,0,0,0,0, 0,0,0,0,0,0") "</layer>")
    static const struct {
        const char *text;
        size_t count;
    } cases[] = {{STARTS("start", ""), 1},
                 {STARTS("from-hall", PROPERTY("startLayer", "true")), 1},
                 {STARTS("from-hall", PROPERTY("startLayer", "false")), 0},
                 {STARTS("exit", PROPERTY("exitUrl", "start.json")), 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sl_context *context = testing_context(NULL);
        const sl_import_options options = sl_import_options_default();
        sl_map map = {0};
        assert_ok(context, sli_map_read_tmx(context, "f", cases[i].text, strlen(cases[i].text),
                                            &options, &map));
        assert_int_equal(map.start_count, cases[i].count);
        if (map.start_count) {
            assert_true(map.starts[0].at.x == 28);
            assert_true(map.starts[0].at.y == 20);
        }
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
}

/// Starts are taken whatever layers are asked for, and no walls come with them.
static void test_start_layers_beside_others(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const sl_import_options options = {.layers = "walls"};
    const char *text = STARTS("start", "");
    sl_map map = {0};
    assert_ok(context, sli_map_read_tmx(context, "f", text, strlen(text), &options, &map));
    assert_int_equal(map.start_count, 1);
    assert_int_equal(map.wall_count, 4);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// Rules by which Tiled draws other maps are no level, whatever is solid in them.
static void test_rules(void **state) {
    (void)state;
    const char *rules = MAP(SET LAYER("regions", CSV("1,1,1,1,1,1")) LAYER(
        "input2_Walls", CSV("3,0,0,4,4,5")) LAYER("output_Walls", CSV("3,0,0,4,4,5")));
    assert_refused(rules, "f:1: its layers input_... and output_... are rules by which Tiled draws "
                          "other maps: read a map that they have drawn");
    // One of the two words alone, or one that is part of a longer word, tells nothing.
    const char *levels[] = {
        MAP(SET LAYER("input_Walls", CSV("3,0,0,4,4,5"))),
        MAP(SET LAYER("inputs_Walls", CSV("3,0,0,4,4,5")) LAYER("output_x", CSV("0,0,0,0,0,0")))};
    for (size_t i = 0; i < 2; i++) {
        sl_context *context = testing_context(NULL);
        const sl_import_options options = {0};
        sl_map map = {0};
        assert_ok(context,
                  sli_map_read_tmx(context, "f", levels[i], strlen(levels[i]), &options, &map));
        assert_true(map.wall_count > 0);
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
}

static void test_memory(void **state) {
    (void)state;
    assert_memory_of(sli_map_read_tmx, NULL, STARTS("start", ""));
    assert_memory_of(sli_map_read_tmx, NULL, SHOWN("gid='5' x='8' y='8'"));
    assert_memory_of(
        sli_map_read_tmx, NULL,
        MAP(SET_OF(WANG("Walls", "", "0,1,0,0,0,0,0,0")) LAYER("a", CSV("2,5,5,2,2,2"))));
    assert_memory_of(sli_map_read_tmx, NULL, MAP(SET LAYER("Floor", CSV("3,0,0,4,4,5"))));
    assert_memory_of(sli_map_read_tmj, NULL,
                     OLD("\"tileproperties\": {\"4\": {\"collides\": true}}"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_guess),
        cmocka_unit_test(test_ground_below_air),
        cmocka_unit_test(test_floor_within_walls),
        cmocka_unit_test(test_pictures_of_walls),
        cmocka_unit_test(test_world),
        cmocka_unit_test(test_beside_player),
        cmocka_unit_test(test_tiles_over_names),
        cmocka_unit_test(test_tiles_deny_the_name),
        cmocka_unit_test(test_layers_named_for_doors),
        cmocka_unit_test(test_outright_before_name),
        cmocka_unit_test(test_few_solid_tiles),
        cmocka_unit_test(test_all_solid),
        cmocka_unit_test(test_tile_size),
        cmocka_unit_test(test_passing_objects),
        cmocka_unit_test(test_names_as_properties),
        cmocka_unit_test(test_weaker_names),
        cmocka_unit_test(test_shapes_of_tile_objects),
        cmocka_unit_test(test_empty_layers),
        cmocka_unit_test(test_words_of_properties),
        cmocka_unit_test(test_names_in_languages),
        cmocka_unit_test(test_terrains),
        cmocka_unit_test(test_old_json),
        cmocka_unit_test(test_start_layers),
        cmocka_unit_test(test_start_layers_beside_others),
        cmocka_unit_test(test_rules),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

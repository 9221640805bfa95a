/// Starts and doors of Tiled's and LDtk's maps: which names say them, where they are among the
/// squares, what is left out, and the option that names starts.
#include "testing.h"

#include "import_check.h"
#include "io/io_formats.h"
#include "io/parts/names.h"
#include "map/scan.h"
#include "sightline/io.h"

#include <unistd.h>

// --- maps made from plans: squares of 8 pixels; '#' solid, 'D' a door, 'X' both

#define MOST_TEXT 8192

/// A Tiled map: a layer "walls" of the plan, and the text of other layers. Tile 1 is plain, tile 2
/// is of the class Door.
static const char *tmx_of(const char *plan, const char *more) {
    static char text[MOST_TEXT];
    const size_t width = strcspn(plan, "\n"), height = (strlen(plan) + 1) / (width + 1);
    char floor[1024] = "", walls[1024] = "";
    for (const char *at = plan; *at; at++) {
        if (*at == '\n') continue;
        strcat(walls, *at == '#' ? "1," : *at == 'X' ? "2," : "0,");
        strcat(floor, *at == 'D' ? "2," : "1,");
    }
    snprintf(text, sizeof text,
             "<map width='%zu' height='%zu' tilewidth='8' tileheight='8'>\n"
             "<tileset firstgid='1' tilewidth='8' tileheight='8'><tile id='1' type='Door'/>"
             "</tileset>\n"
             "<layer name='floor' width='%zu' height='%zu'><data encoding='csv'>%s</data></layer>"
             "<layer name='walls' width='%zu' height='%zu'><data encoding='csv'>%s</data></layer>"
             "%s</map>",
             width, height, width, height, floor, width, height, walls, more);
    return text;
}

#define OBJECTS(text)      "<objectgroup name='things'>" text "</objectgroup>"
#define AT(x, y)           "x='" x "' y='" y "'"
#define SIZED(x, y, w, h)  AT(x, y) " width='" w "' height='" h "'"
#define NAMED(name, place) "<object name='" name "' " place "/>"
#define POINT(name, place) "<object name='" name "' " place "><point/></object>"
#define LINE(name, place, points)                                                                  \
    "<object name='" name "' " place "><polyline points='" points "'/></object>"
#define BOOL(name, value)                                                                          \
    "<properties><property name='" name "' type='bool' value='" value "'/></properties>"

/// An LDtk level of the plan; values 1 Wall and 2 Door have names. Entities of one layer.
static const char *ldtk_of(const char *plan, const char *entities) {
    static char text[MOST_TEXT];
    const size_t width = strcspn(plan, "\n"), height = (strlen(plan) + 1) / (width + 1);
    char cells[1024] = "";
    for (const char *at = plan; *at; at++) {
        if (*at == '\n') continue;
        snprintf(cells + strlen(cells), sizeof cells - strlen(cells), "%s%c", *cells ? "," : "",
                 *at == '#'   ? '1'
                 : *at == 'D' ? '2'
                              : '0');
    }
    snprintf(text, sizeof text,
             "{\"__header__\": {\"app\": \"LDtk\"}, \"worlds\": [], \"defs\": {\"layers\": ["
             "{\"uid\": 7, \"intGridValues\": [{\"value\": 1, \"identifier\": \"Wall\"}, "
             "{\"value\": 2, \"identifier\": \"Door\"}]}]}, \"levels\": [{\"identifier\": \"A\", "
             "\"pxWid\": %zu, \"pxHei\": %zu, \"layerInstances\": [{\"__identifier\": \"Things\", "
             "\"__type\": \"Entities\", \"__gridSize\": 8, \"__pxTotalOffsetX\": 0, "
             "\"__pxTotalOffsetY\": 0, \"entityInstances\": [%s]}, {\"__identifier\": \"Any\", "
             "\"__type\": \"IntGrid\", \"__cWid\": %zu, \"__cHei\": %zu, \"__gridSize\": 8, "
             "\"layerDefUid\": 7, \"intGridCsv\": [%s]}]}]}",
             8 * width, 8 * height, entities, width, height, cells);
    return text;
}

#define ENTITY(name, px, pivot, size, fields)                                                      \
    "{\"__identifier\": \"" name "\", \"px\": [" px "], \"__pivot\": [" pivot "], " size           \
    ", \"fieldInstances\": [" fields "]}"
#define FIELD(name, value) "{\"__identifier\": \"" name "\", \"__value\": " value "}"
#define EIGHT              "\"width\": 8, \"height\": 8"

// --- what is read

/// Notes of a reading, each with a line end.
typedef struct notes {
    char text[4096];
} notes;

static void take_note(void *user, const char *note) {
    char *text = ((notes *)user)->text;
    snprintf(text + strlen(text), sizeof(notes) - strlen(text), "%s\n", note);
}

/// The doors and starts that a text gives, as lines of map text, and the number of its walls; and
/// its notes, where `said` is not NULL.
static void read_things(import_reader *read, const char *input, const sl_import_options *options,
                        char *things, size_t *walls, notes *said) {
    const sl_hooks hooks = {.user = said, .note = take_note};
    sl_context *context = sl_context_create(said ? &hooks : NULL);
    assert_non_null(context);
    sl_map map = {0};
    assert_ok(context, read(context, "f", input, strlen(input), options, &map));
    char *text = map_text(&map), *rest;
    *things = '\0';
    for (char *line = strtok_r(text, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest)) {
        if (strncmp(line, "door ", 5) != 0 && strncmp(line, "start ", 6) != 0) continue;
        strcat(strcat(things, line), "\n");
    }
    if (walls) *walls = map.wall_count;
    free(text);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static sl_import_options with_doors(const char *start_names) {
    sl_import_options options = sl_import_options_default();
    options.doors = true;
    options.start_names = start_names;
    return options;
}

static void assert_things(import_reader *read, const char *input, const char *start_names,
                          const char *expected) {
    char things[MOST_TEXT];
    const sl_import_options options = with_doors(start_names);
    read_things(read, input, &options, things, NULL, NULL);
    assert_string_equal(things, expected);
}

static void assert_tmx(const char *plan, const char *more, const char *expected) {
    assert_things(sli_map_read_tmx, tmx_of(plan, more), NULL, expected);
}

static void assert_ldtk(const char *plan, const char *entities, const char *expected) {
    assert_things(sli_map_read_ldtk, ldtk_of(plan, entities), NULL, expected);
}

/// A note of the reading contains the text.
static void assert_note(import_reader *read, const char *input, const sl_import_options *options,
                        const char *expected) {
    char things[MOST_TEXT];
    notes said = {{0}};
    read_things(read, input, options, things, NULL, &said);
    if (!strstr(said.text, expected)) fail_msg("no '%s' in:\n%s", expected, said.text);
}

// --- names

static void test_names(void **state) {
    (void)state;
    static const char *const starts[] = {
        "Player",   "player_1",           "Player Spawn", "spawn-point",  "PlayerStart",
        "START",    "Entrance",           "spawnpoint2",  "playerstart",  "Hero",
        "startPos", "player_spawn_point", "Spawn Points", "PLAYER_START", "starting point"};
    static const char *const doors[] = {"door",      "Gate",         "Door_3",      "KitchenDoor",
                                        "iron gate", "door_left",    "secret-door", "DOOR",
                                        "doors",     "Door (locked)"};
    static const char *const others[] = {"",
                                         "starting_room",
                                         "enemy_spawn",
                                         "StartButton",
                                         "restart",
                                         "player blocker",
                                         "door_key",
                                         "trap door",
                                         "doormat",
                                         "DoorSwitch",
                                         "outdoors",
                                         "point",
                                         "gatekeeper",
                                         "item_spawner",
                                         "left",
                                         "no door",
                                         "T\xc3\xbcr door key"};
    for (size_t i = 0; i < sizeof starts / sizeof *starts; i++)
        if (!sli_says_start(starts[i]) || sli_says_door(starts[i])) fail_msg("%s", starts[i]);
    for (size_t i = 0; i < sizeof doors / sizeof *doors; i++)
        if (!sli_says_door(doors[i]) || sli_says_start(doors[i])) fail_msg("%s", doors[i]);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (sli_says_door(others[i]) || sli_says_start(others[i])) fail_msg("%s", others[i]);
    assert_int_equal(sli_says_state("locked door"), SLI_DOOR_SHUT);
    assert_int_equal(sli_says_state("Door_open"), SLI_DOOR_OPEN);
    assert_int_equal(sli_says_state("door"), SLI_DOOR_UNSAID);
}

// --- starts

#define ROOM "#####\n#...#\n#...#\n#...#\n#####"

static void test_starts_of_tiled(void **state) {
    (void)state;
    assert_tmx(ROOM, OBJECTS(POINT("Player", AT("12", "20"))), "start 12 20 0\n");
    assert_tmx(ROOM, OBJECTS(NAMED("spawn", SIZED("8", "10", "6", "4"))), "start 11 28 0\n");
    assert_tmx(ROOM, OBJECTS("<object type='Player' name='Bob' " AT("12", "30") "/>"),
               "start 12 10 0\n");
    assert_tmx(ROOM, OBJECTS("<object class='PlayerStart' " AT("12", "30") "/>"),
               "start 12 10 0\n");
    // A tile as an object stands on its place.
    assert_tmx(ROOM, OBJECTS("<object name='hero' gid='1' " SIZED("9", "30", "6", "8") "/>"),
               "start 12 14 0\n");
    assert_tmx(ROOM, OBJECTS("<object name='hero' gid='1' " AT("9", "30") "/>"), "start 13 14 0\n");
    // Clockwise with y down is against the clock with y up; the middle turns about the place.
    assert_tmx(ROOM, OBJECTS("<object name='start' rotation='90' " AT("12", "20") "/>"),
               "start 12 20 270\n");
    assert_tmx(ROOM,
               OBJECTS("<object name='start' rotation='-90' " SIZED("12", "20", "4", "6") "/>"),
               "start 15 22 90\n");
    assert_tmx(ROOM, OBJECTS("<object name='start' rotation='45' " AT("12", "20") "/>"),
               "start 12 20 315\n");
    assert_tmx(ROOM, OBJECTS(LINE("start", AT("10", "10"), "0,0 4,0 4,8")), "start 12 26 0\n");
    // Layers and groups move what is in them; all object layers are looked at.
    assert_tmx(ROOM,
               "<group offsetx='2' offsety='3'><objectgroup offsetx='-1' offsety='1' "
               "name='a'>" POINT("P", AT("9", "9"))
                   POINT("player", AT("12", "20")) "</objectgroup></group>" OBJECTS(
                       POINT("player", AT("12", "30"))),
               "start 13 16 0\nstart 12 10 0\n");
    assert_tmx(ROOM, OBJECTS(POINT("starting_room", AT("12", "20"))), "");
}

static void test_starts_and_walls(void **state) {
    (void)state;
    // On the edge of a solid square: into the open square beside it. Inside two open ones it stays.
    assert_tmx(ROOM, OBJECTS(POINT("player", AT("8", "8"))), "start 12 28 0\n");
    assert_tmx(ROOM, OBJECTS(POINT("player", AT("32", "20"))), "start 28 20 0\n");
    assert_tmx(ROOM, OBJECTS(POINT("player", AT("16", "16"))), "start 16 24 0\n");
    const sl_import_options options = sl_import_options_default();
    const char *input = tmx_of(ROOM, OBJECTS(POINT("player", AT("4", "8")) POINT(
                                         "start", AT("-20", "9")) POINT("spawn", AT("12", "12"))));
    assert_things(sli_map_read_tmx, input, NULL, "start 12 28 0\n");
    assert_note(sli_map_read_tmx, input, &options,
                "f:3: start 'player' at 4 8 in the file is left out: it stands on solid ground\n");
    assert_note(sli_map_read_tmx, input, &options,
                "f:3: start 'start' at -20 9 in the file is left out: it is outside the map\n");
    assert_note(sli_map_read_tmx, input, &options, "f: taken: 1 start, from 'spawn'\n");
    // The file's own name may stand in that of a start, and no other place.
    assert_things(
        sli_map_read_tmx,
        tmx_of(ROOM, OBJECTS(POINT("spawn_f", AT("12", "12")) POINT("spawn_g", AT("20", "20")))),
        NULL, "start 12 28 0\n");
    // But not in a layer of enemies.
    assert_things(sli_map_read_tmx,
                  tmx_of(ROOM, "<objectgroup name='Enemies'>" POINT(
                                   "spawn_f", AT("12", "12")) "</objectgroup>"),
                  NULL, "");
    // Starts of a solid layer are no walls.
    size_t walls;
    char things[MOST_TEXT];
    read_things(sli_map_read_tmx,
                tmx_of(ROOM, "<objectgroup name='walls'>" NAMED(
                                 "player", SIZED("12", "12", "4", "4")) "</objectgroup>"),
                &options, things, &walls, NULL);
    assert_string_equal(things, "start 14 26 0\n");
    assert_int_equal(walls, 4);
    // A map without tiles: its walls say how far it goes.
    assert_things(
        sli_map_read_tmx,
        "<map width='9' height='5' tilewidth='8' tileheight='8'><objectgroup "
        "name='walls'><object x='8' y='8' width='30' height='20'/>" POINT("player", AT("10", "10"))
            POINT("player", AT("2", "2")) "</objectgroup></map>",
        NULL, "start 10 30 0\n");
}

static void test_start_names(void **state) {
    (void)state;
    const char *text = tmx_of(ROOM, OBJECTS(POINT("Player", AT("12", "20")) POINT(
                                        "guard", AT("20", "20")) POINT("", AT("20", "28"))));
    assert_things(sli_map_read_tmx, text, "Guard", "start 20 20 0\n");
    assert_things(sli_map_read_tmx, text, "guard, player", "start 12 20 0\nstart 20 20 0\n");
    assert_things(sli_map_read_tmx, text, "", "");
    assert_things(sli_map_read_tmx, text, "none", "");
    sl_import_options options = with_doors("guard,thief");
    assert_refused_of(sli_map_read_tmx, &options, text, strlen(text), SL_BAD_ARGUMENT,
                      "--start-names: f has no object 'thief'; its objects: 'Player', 'guard'");
    text = tmx_of(ROOM, "");
    assert_refused_of(sli_map_read_tmx, &options, text, strlen(text), SL_BAD_ARGUMENT,
                      "--start-names: f has no object 'guard'; its objects: none has a name");
    text = ldtk_of(ROOM, ENTITY("Guard", "12,20", "0,0", EIGHT, ""));
    assert_things(sli_map_read_ldtk, text, "guard", "start 16 16 0\n");
    assert_refused_of(sli_map_read_ldtk, &options, text, strlen(text), SL_BAD_ARGUMENT,
                      "--start-names: f has no object 'thief'; its objects: 'Guard'");
}

static void test_starts_of_chunks(void **state) {
    (void)state;
#define CHUNK(x, y, data) "<chunk x='" x "' y='" y "' width='2' height='2'>" data "</chunk>"
    assert_things(sli_map_read_tmx,
                  "<map infinite='1' width='2' height='2' tilewidth='8' tileheight='8'>"
                  "<layer name='walls' width='2' height='2'><data encoding='csv'>" CHUNK("-4", "-2",
                                                                                         "0,0,0,1")
                      CHUNK("-2", "-2", "0,0,0,0") "</data></layer>" OBJECTS(
                          POINT("player", AT("-30", "-10")) POINT("player", AT("-4", "-4"))
                              POINT("player", AT("4", "4"))) "</map>",
                  NULL, "start -30 26 0\nstart -4 20 0\n");
}

static void test_starts_of_ldtk(void **state) {
    (void)state;
    assert_ldtk(ROOM, ENTITY("Player", "12,20", "0.5,0.5", EIGHT, ""), "start 12 20 0\n");
    assert_ldtk(ROOM, ENTITY("Player", "12,20", "0,0", EIGHT, ""), "start 16 16 0\n");
    assert_ldtk(ROOM, ENTITY("Player", "12,24", "0.5,1", EIGHT, ""), "start 12 20 0\n");
    // Without a size it is that of a square.
    assert_ldtk(ROOM, "{\"__identifier\": \"Spawn_Point\", \"px\": [8, 16]}", "start 12 20 0\n");
    assert_ldtk(ROOM, ENTITY("Player", "12,20", "0.5,0.5", EIGHT, FIELD("rotation", "90")),
                "start 12 20 270\n");
    assert_ldtk(ROOM, ENTITY("Player", "12,20", "0.5,0.5", EIGHT, FIELD("Facing", "\"Up\"")),
                "start 12 20 90\n");
    assert_ldtk(ROOM, ENTITY("EnemySpawn", "12,20", "0,0", EIGHT, ""), "");
    assert_ldtk(ROOM, ENTITY("Player", "100,20", "0,0", EIGHT, ""), "");
    const char *text = ldtk_of(ROOM, "{\"__identifier\": \"Player\"}");
    assert_refused_of(sli_map_read_ldtk, NULL, text, strlen(text), SL_BAD_INPUT,
                      "f: levels[0].layerInstances[0].entityInstances[0].px: expected two numbers");
}

/// Levels in their places, and a layer with an offset.
static void test_starts_of_worlds(void **state) {
    (void)state;
#define LEVEL(name, x, y)                                                                          \
    "{\"identifier\": \"" name "\", \"worldX\": " x ", \"worldY\": " y ", \"pxWid\": 16, "         \
    "\"pxHei\": 16, \"layerInstances\": [{\"__type\": \"Entities\", \"__gridSize\": 8, "           \
    "\"__pxTotalOffsetX\": 1, \"__pxTotalOffsetY\": 2, \"entityInstances\": "                      \
    "[{\"__identifier\": \"Player\", \"px\": [4, 4]}]}, {\"__identifier\": \"Walls\", "            \
    "\"__type\": \"IntGrid\", \"__cWid\": 2, \"__cHei\": 2, \"__gridSize\": 8, \"intGridCsv\": "   \
    "[0,0,0,0]}]}"
    const char *text = "{\"__header__\": {\"app\": \"LDtk\"}, \"worlds\": [], \"levels\": [" LEVEL(
        "A", "0", "0") "," LEVEL("B", "16", "8") "]}";
    sl_import_options options = with_doors(NULL);
    char things[MOST_TEXT];
    options.map = "B";
    read_things(sli_map_read_ldtk, text, &options, things, NULL, NULL);
    assert_string_equal(things, "start 9 6 0\n");
    options.map = "all";
    read_things(sli_map_read_ldtk, text, &options, things, NULL, NULL);
    assert_string_equal(things, "start 9 14 0\nstart 25 6 0\n");
}

static void test_tokens_of_foundry(void **state) {
    (void)state;
#define SCENE(grid, tokens)                                                                        \
    "{\"padding\": 0.25, \"grid\": " grid ", \"walls\": [{\"c\": [0, 0, 400, 0]}, {\"c\": "        \
    "[0, 0, 0, 300]}], \"tokens\": [" tokens "]}"
#define TOKEN(name, x, y, disposition, more)                                                       \
    "{\"name\": \"" name "\", \"x\": " x ", \"y\": " y ", \"disposition\": " disposition more "}"
    const char *text = SCENE("{\"size\": 50}",
                             TOKEN("Ann", "50", "100", "1", ", \"rotation\": 90") "," TOKEN(
                                 "Wolf", "0", "0", "-1", "") "," TOKEN("Far", "500", "0", "1", ""));
    assert_things(sli_map_read_foundry, text, NULL, "start 75 175 180\n");
    assert_things(sli_map_read_foundry, text, "wolf", "start 25 275 270\n");
    assert_things(sli_map_read_foundry, text, "none", "");
    text = SCENE("100", TOKEN("Gate", "100", "100", "1", ", \"width\": 2, \"height\": 1"));
    assert_things(sli_map_read_foundry, text, NULL, "start 200 150 270\n");
    text = SCENE("100", TOKEN("Ann", "\"1\"", "100", "1", ""));
    assert_refused_of(sli_map_read_foundry, NULL, text, strlen(text), SL_BAD_INPUT,
                      "f: tokens[0].x: expected a number");
}

// --- doors

#define TWO_ROOMS                                                                                  \
    "#######\n"                                                                                    \
    "#..#..#\n"                                                                                    \
    "#.....#\n"                                                                                    \
    "#..#..#\n"                                                                                    \
    "#######"
#define NO_WAY                                                                                     \
    "#######\n"                                                                                    \
    "#..#..#\n"                                                                                    \
    "#..#..#\n"                                                                                    \
    "#..#..#\n"                                                                                    \
    "#######"

static void test_doors_of_tiled(void **state) {
    (void)state;
    static const char door[] = "door Door 28 16 28 24 open\n";
    assert_tmx(TWO_ROOMS, OBJECTS(NAMED("Door", SIZED("24", "16", "8", "8"))), door);
    assert_tmx(TWO_ROOMS, OBJECTS(POINT("Door", AT("28", "20"))), door);
    assert_tmx(TWO_ROOMS, OBJECTS("<object name='Door' gid='1' " SIZED("24", "24", "8", "8") "/>"),
               door);
    assert_tmx(TWO_ROOMS, OBJECTS("<object type='Door' " SIZED("25", "17", "6", "6") "/>"), door);
    assert_tmx(TWO_ROOMS,
               OBJECTS("<object name='Door'><polygon points='24,16 32,16 32,24 24,24'/></object>"),
               door);
    assert_tmx(TWO_ROOMS,
               OBJECTS("<object name='Door' rotation='90' " SIZED("32", "16", "8", "8") "/>"),
               door);
    // A tile whose set says so is a door as an object, and in a layer.
    assert_tmx(TWO_ROOMS, OBJECTS("<object gid='2' " SIZED("24", "24", "8", "8") "/>"), door);
    assert_tmx("#######\n#..#..#\n#..D..#\n#..#..#\n#######", "", door);
    // Its own name, as one word; the class stands in for it.
    assert_tmx(TWO_ROOMS,
               OBJECTS("<object type='door' name='to the cellar, #2' " AT("28", "20") "/>"),
               "door to_the_cellar___2 28 16 28 24 open\n");
    // Loosely drawn rectangles, and lines: from wall to wall.
    assert_tmx(TWO_ROOMS, OBJECTS(NAMED("Door", SIZED("26", "14", "3", "12"))),
               "door Door 27.5 16 27.5 24 open\n");
    assert_tmx(TWO_ROOMS, OBJECTS(LINE("Door", AT("26", "17"), "0,0 0,6")),
               "door Door 26 16 26 24 open\n");
    assert_tmx(TWO_ROOMS, OBJECTS(LINE("Door", AT("24", "15"), "0,0 0,10")),
               "door Door 24 16 24 24 open\n");
    // On the border between two columns of squares.
    assert_tmx(
        "########\n#..##..#\n#......#\n#..##..#\n########",
        OBJECTS(LINE("Door", AT("32", "18"), "0,0 0,4") NAMED("Door", SIZED("31", "17", "2", "6"))),
        "door Door 32 16 32 24 open\ndoor Door:2 32 16 32 24 open\n");
    // Layers and groups move doors too.
    assert_tmx(TWO_ROOMS,
               "<group offsetx='24'><objectgroup offsety='16'>" NAMED(
                   "Door", SIZED("0", "0", "8", "8")) "</objectgroup></group>",
               door);
}

static void test_doors_on_solid_squares(void **state) {
    (void)state;
    static const char door[] = "door Door 28 16 28 24 open\n";
    size_t walls;
    char things[MOST_TEXT];
    sl_import_options options = with_doors(NULL);
    assert_tmx(NO_WAY, OBJECTS(NAMED("Door", SIZED("24", "16", "8", "8"))), door);
    assert_tmx(NO_WAY, OBJECTS(LINE("Door", AT("27", "18"), "0,0 0,4")),
               "door Door 27 16 27 24 open\n");
    // The door's tile is in the layer of walls.
    const char *text = tmx_of("#######\n#..#..#\n#..X..#\n#..#..#\n#######", "");
    read_things(sli_map_read_tmx, text, &options, things, &walls, NULL);
    assert_string_equal(things, door);
    assert_int_equal(walls, 12);
    // Also where nobody asks for doors.
    options.doors = false;
    read_things(sli_map_read_tmx, text, &options, things, &walls, NULL);
    assert_string_equal(things, door);
    assert_note(sli_map_read_tmx, text, &options, "f: taken: 1 open door\n");
    text = tmx_of(NO_WAY, OBJECTS(NAMED("shut door", SIZED("24", "16", "8", "8"))));
    read_things(sli_map_read_tmx, text, &options, things, &walls, NULL);
    assert_string_equal(things, "door shut_door 28 16 28 24 shut\n");
    assert_int_equal(walls, 12);
    // A thick wall: through its middle.
    assert_tmx("######\n#.##.#\n#.##.#\n#.##.#\n######",
               OBJECTS(NAMED("Door", SIZED("16", "16", "16", "8"))),
               "door Door 24 16 24 24 open\n");
}

/// What a file says without being understood is noted, and so is what is left out or renamed.
static void test_notes_about_doors(void **state) {
    (void)state;
    const sl_import_options options = sl_import_options_default();
    const char *const gap = "#####\n#.#.#\n#...#\n#.#.#\n#####";
#define STATE(name, value)                                                                         \
    "<object name='Big Door' x='16' y='16' width='8' height='8'><properties><property name='" name \
    "' value='" value "'/></properties></object>"
    const char *text = tmx_of(gap, OBJECTS(STATE("state", "closed")));
    assert_things(sli_map_read_tmx, text, NULL, "door Big_Door 20 16 20 24 shut\n");
    assert_note(sli_map_read_tmx, text, &options,
                "f: door 'Big Door' is named Big_Door here: names are one word each\n");
    assert_things(sli_map_read_tmx, tmx_of(gap, OBJECTS(STATE("status", "opened"))), NULL,
                  "door Big_Door 20 16 20 24 open\n");
    assert_note(sli_map_read_tmx, tmx_of(gap, OBJECTS(STATE("state", "ajar"))), &options,
                "f: property 'state' of door 'Big Door' is not understood\n");
    assert_note(sli_map_read_tmx, tmx_of(gap, OBJECTS(STATE("locked", "by a key"))), &options,
                "f: property 'locked' of door 'Big Door' is not understood\n");
    // Texts that are true or false; what is not understood is told once for all doors of a name.
    assert_things(sli_map_read_tmx, tmx_of(gap, OBJECTS(STATE("Open", "0"))), NULL,
                  "door Big_Door 20 16 20 24 shut\n");
    assert_things(sli_map_read_tmx, tmx_of(gap, OBJECTS(STATE("locked", "0"))), NULL,
                  "door Big_Door 20 16 20 24 open\n");
    text = tmx_of(gap, OBJECTS(STATE("locked", "by a key") STATE("locked", "by a key")));
    assert_note(sli_map_read_tmx, text, &options,
                "f: property 'locked' of door 'Big Door' is not understood\nf: 12 walls");
    text = tmx_of(gap, OBJECTS(NAMED("crate", SIZED("8", "8", "8", "8"))
                                   NAMED("door of the hall", SIZED("16", "16", "8", "8"))));
    assert_note(sli_map_read_tmx, text, &options,
                "f: objects left out: 'crate', 'door of the hall'; name or type 'door' what is a "
                "door: 'door of the hall'\n");
}

static void test_doors_without_passage(void **state) {
    (void)state;
    size_t walls;
    char things[MOST_TEXT];
    const sl_import_options options = with_doors(NULL);
    // The front of a house: behind the door all is solid. Its square stays so.
    const char *text =
        tmx_of("#####\n#...#\n#...#\n#####", OBJECTS(NAMED("Door", SIZED("16", "0", "8", "8"))));
    read_things(sli_map_read_tmx, text, &options, things, &walls, NULL);
    assert_string_equal(things, "");
    assert_int_equal(walls, 4);
    assert_note(sli_map_read_tmx, text, &options,
                "f:3: door 'Door' at 20 4 in the file is left out: no passage is found there\n");
    // In the open, a square door does not say which way it goes; a longer one does.
    assert_tmx(ROOM, OBJECTS(NAMED("Door", SIZED("16", "16", "8", "8"))), "");
    assert_tmx(ROOM, OBJECTS(NAMED("Door", SIZED("14", "16", "12", "8"))),
               "door Door 14 20 26 20 open\n");
    assert_tmx(ROOM, OBJECTS(LINE("Door", AT("12", "20"), "0,0 8,8")),
               "door Door 12 20 20 12 open\n");
    // Along a wall there is no passage. Outside there is nothing.
    assert_tmx(ROOM, OBJECTS(LINE("Door", AT("8", "10"), "0,0 0,10")), "");
    assert_tmx(ROOM, OBJECTS(NAMED("Door", SIZED("14", "7", "8", "2"))), "");
    text = tmx_of(ROOM, OBJECTS(NAMED("Door", SIZED("80", "16", "8", "8"))));
    assert_note(sli_map_read_tmx, text, &options,
                "door 'Door' at 84 20 in the file is left out: it is outside the map\n");
    // An object of a solid layer stays what it would be without its name.
    text = "<map width='9' height='5' tilewidth='8' tileheight='8'><objectgroup name='walls'>"
           "<object name='door' x='8' y='8' width='8' height='8'/>"
           "<object x='40' y='8' width='8' height='8'/></objectgroup></map>";
    read_things(sli_map_read_tmx, text, &options, things, &walls, NULL);
    assert_int_equal(walls, 12);
    assert_note(sli_map_read_tmx, text, &options,
                "f:1: door 'door' at 12 12 in the file is taken as a wall: no passage is found "
                "there\n");
    // More than a few are counted.
    text = tmx_of(ROOM, OBJECTS(NAMED("Door", AT("1", "1")) NAMED("Door", AT("1", "2"))
                                    NAMED("Door", AT("1", "3")) NAMED("Door", AT("1", "4"))
                                        NAMED("Door", AT("1", "5")) NAMED("Door", AT("1", "6"))));
    assert_note(sli_map_read_tmx, text, &options, "f: so is 1 more door\n");
}

/// Walls that are objects tell too, if they stand at two opposite sides of the door.
/// A door in solid ground, or one that runs into it, is left out: no map is refused for it.
static void test_doors_in_ground(void **state) {
    (void)state;
    const sl_import_options options = sl_import_options_default();
    const char *const rooms = "#######\n#..#..#\n#.....#\n#..#..#\n#######";
    // Turned a little, and longer than its opening; a line from within the edge of the map.
    const char *text =
        tmx_of(rooms, OBJECTS("<object name='door' x='27' y='12' width='2' height='16' "
                              "rotation='5'/>"));
    assert_things(sli_map_read_tmx, text, NULL, "");
    assert_note(sli_map_read_tmx, text, &options, "left out: it runs into solid ground\n");
    assert_tmx(rooms, OBJECTS(LINE("door", AT("4", "20"), "0,0 12,0")), "");
    // Its passage is closed by a wall that is an entity.
    text = ldtk_of(rooms, ENTITY("door", "24,16", "0,0", EIGHT, "") ", " ENTITY(
                              "SolidBlock", "24,8", "0,0", "\"width\": 8, \"height\": 24", ""));
    assert_things(sli_map_read_ldtk, text, NULL, "");
    assert_note(sli_map_read_ldtk, text, &options,
                "f: door 'door' at 28 20 in the file is left out: it runs into solid ground\n");
    assert_ldtk(rooms, ENTITY("door", "24,16", "0,0", EIGHT, ""), "door door 28 16 28 24 open\n");
}

static void test_doors_between_shapes(void **state) {
    (void)state;
#define SHAPES(door)                                                                               \
    "<map width='9' height='5' tilewidth='8' tileheight='8'><objectgroup name='walls'>"            \
    "<object x='0' y='16' width='20' height='8'/><object x='30' y='16' width='20' height='8'/>"    \
    "</objectgroup><objectgroup name='doors'>" door "</objectgroup></map>"
    assert_things(sli_map_read_tmx, SHAPES(NAMED("door", SIZED("20", "16", "10", "10"))), NULL,
                  "door door 20 19 30 19 open\n");
    assert_things(sli_map_read_tmx, SHAPES(NAMED("door", SIZED("21", "16", "8", "8"))), NULL,
                  "door door 20 20 30 20 open\n");
    assert_things(sli_map_read_tmx, SHAPES(NAMED("door", SIZED("21", "16", "8", "9"))), NULL,
                  "door door 20 19.5 30 19.5 open\n");
    assert_things(sli_map_read_tmx, SHAPES(NAMED("door", SIZED("21", "0", "8", "8"))), NULL, "");
    assert_things(sli_map_read_tmx, SHAPES(NAMED("door", SIZED("21", "0", "8", "6"))), NULL,
                  "door door 21 37 29 37 open\n");
}

static void test_double_doors(void **state) {
    (void)state;
    static const char plan[] = "######\n#....#\n##..##\n#....#\n######";
    static const char solid[] = "######\n#....#\n######\n#....#\n######";
#define LEFT  NAMED("Door", SIZED("16", "16", "8", "8"))
#define RIGHT NAMED("Door", SIZED("24", "16", "8", "8"))
    static const char two[] = "door Door 16 20 24 20 open\ndoor Door:2 24 20 32 20 open\n";
    assert_tmx(plan, OBJECTS(LEFT RIGHT), two);
    assert_tmx(solid, OBJECTS(LEFT RIGHT), two);
    assert_tmx(plan, OBJECTS(NAMED("Door", SIZED("16", "16", "16", "8"))),
               "door Door 16 20 32 20 open\n");
    // Wider than the passage: only the open squares count.
    assert_tmx(plan, OBJECTS(NAMED("Door", SIZED("8", "16", "32", "8"))),
               "door Door 16 20 32 20 open\n");
    // Tiles side by side are one door, over one another too.
    assert_tmx("######\n#....#\n##DD##\n#....#\n######", "", "door Door 16 20 32 20 open\n");
    assert_tmx("#####\n#.X.#\n#.X.#\n#.X.#\n#####", "", "door Door 20 8 20 32 open\n");
}

/// An object that stands on the picture of its door: one door, with the object's name and state.
static void test_doors_drawn_twice(void **state) {
    (void)state;
    static const char shut[] = "door gate 28 16 28 24 shut\n";
#define GATE                                                                                       \
    OBJECTS(                                                                                       \
        "<object name='gate' " SIZED("24", "16", "8", "8") ">" BOOL("closed", "true") "</object>")
    assert_tmx("#######\n#..#..#\n#..X..#\n#..#..#\n#######", GATE, shut);
    assert_tmx("#######\n#..#..#\n#..D..#\n#..#..#\n#######", GATE, shut);
    // A small object on the wall beside the tile is that door, too, and opens no wall.
    assert_tmx("#######\n#..#..#\n#..X..#\n#..#..#\n#######",
               OBJECTS("<object name='gate' " SIZED("27", "13", "2",
                                                    "2") ">" BOOL("closed", "true") "</object>"),
               shut);
    // Where the object is no door, as behind it all is solid, the tile is none either.
    assert_tmx("#####\n#...#\n#...#\n##X##", OBJECTS(NAMED("door", SIZED("16", "24", "8", "8"))),
               "");
    assert_ldtk("#######\n#..#..#\n#..D..#\n#..#..#\n#######",
                ENTITY("gate", "24,16", "0,0", EIGHT, FIELD("shut", "true")), shut);
}

/// Solid tiles in a layer named for doors are doors, and shut if the name does not say otherwise. A
/// mark beside one is the same door.
static void test_layers_of_doors(void **state) {
    (void)state;
    const char *const rooms = "#######\n#..#..#\n#.....#\n#..#..#\n#######";
#define DOORS(name)                                                                                \
    "<tileset firstgid='3' tilewidth='8' tileheight='8'><tile id='0'>" BOOL(                       \
        "collides", "true") "</tile></tileset><layer name='" name                                  \
                            "' width='7' height='5'><data encoding='csv'>"                         \
                            "0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,3,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0," \
                            "0</data></layer>"
    assert_tmx(rooms, DOORS("Doors"), "door Doors 28 16 28 24 shut\n");
    assert_tmx(rooms, DOORS("open doors"), "door open_doors 28 16 28 24 open\n");
    assert_tmx(rooms, DOORS("Closed Doors") OBJECTS(NAMED("gate", SIZED("27", "13", "2", "2"))),
               "door gate 28 16 28 24 shut\n");
    assert_tmx(rooms, DOORS("things"), "");
#undef DOORS
}

static void test_names_of_doors(void **state) {
    (void)state;
    static const char plan[] = "#########\n#.......#\n#.#.#.#.#\n#.......#\n#########";
    assert_tmx(plan,
               OBJECTS(NAMED("door", AT("12", "20")) NAMED("Door", AT("28", "20"))
                           NAMED("door", AT("44", "20")) NAMED("door:2", AT("60", "20"))),
               "door door 8 20 16 20 open\ndoor Door 24 20 32 20 open\n"
               "door door:2 40 20 48 20 open\ndoor door_2 56 20 64 20 open\n");
    // The pieces of a line are one door.
    assert_tmx(ROOM,
               OBJECTS(LINE("gate", AT("12", "12"), "0,0 4,0 4,4")
                           LINE("gate", AT("12", "24"), "0,0 4,0 4,4")),
               "door gate 12 28 16 28 open\ndoor gate 16 28 16 24 open\n"
               "door gate:2 12 16 16 16 open\ndoor gate:2 16 16 16 12 open\n");
}

static void test_states_of_doors(void **state) {
    (void)state;
    static const char open[] = "door door 28 16 28 24 open\n";
    static const char shut[] = "door door 28 16 28 24 shut\n";
#define WITH(properties) OBJECTS("<object name='door' " AT("28", "20") ">" properties "</object>")
    assert_tmx(TWO_ROOMS, WITH(""), open);
    assert_tmx(TWO_ROOMS, WITH(BOOL("open", "false")), shut);
    assert_tmx(TWO_ROOMS, WITH(BOOL("isOpen", "true")), open);
    assert_tmx(TWO_ROOMS, WITH(BOOL("closed", "true")), shut);
    assert_tmx(TWO_ROOMS, WITH(BOOL("locked", "true")), shut);
    assert_tmx(TWO_ROOMS, WITH(BOOL("Shut", "false")), open);
    assert_tmx(TWO_ROOMS,
               WITH("<properties><property name='open' type='bool' value='false'/><property "
                    "name='locked' type='bool' value='false'/></properties>"),
               shut);
    assert_tmx(TWO_ROOMS, OBJECTS(NAMED("locked_door", AT("28", "20"))),
               "door locked_door 28 16 28 24 shut\n");
    // A property may say that something is a door, or that it is none.
    assert_tmx(TWO_ROOMS, OBJECTS("<object " AT("28", "20") ">" BOOL("door", "true") "</object>"),
               open);
    assert_tmx(TWO_ROOMS, WITH(BOOL("door", "false")), "");
    assert_ldtk(TWO_ROOMS, ENTITY("door", "28,20", "0.5,0.5", EIGHT, FIELD("locked", "true")),
                shut);
    assert_ldtk(TWO_ROOMS, ENTITY("door", "28,20", "0.5,0.5", EIGHT, FIELD("lockedWith", "\"K\"")),
                shut);
    assert_ldtk(TWO_ROOMS,
                ENTITY("door", "28,20", "0.5,0.5", EIGHT, FIELD("lockedWith", "{\"iid\": 3}")),
                shut);
    static const char *const no_keys[] = {"null", "\"\"", "[]"};
    for (size_t i = 0; i < 3; i++) {
        char entity[512];
        snprintf(entity, sizeof entity,
                 ENTITY("door", "28,20", "0.5,0.5", EIGHT, FIELD("lockedWith", "%s")), no_keys[i]);
        assert_ldtk(TWO_ROOMS, entity, open);
    }
}

static void test_doors_of_ldtk(void **state) {
    (void)state;
    static const char door[] = "door Door 28 16 28 24 open\n";
    assert_ldtk(TWO_ROOMS, ENTITY("Door", "24,16", "0,0", EIGHT, ""), door);
    assert_ldtk(TWO_ROOMS, ENTITY("Door", "28,24", "0.5,1", EIGHT, ""), door);
    assert_ldtk(NO_WAY, ENTITY("Door", "24,16", "0,0", EIGHT, ""), door);
    assert_ldtk(TWO_ROOMS,
                ENTITY("Door", "24,16", "0,0", EIGHT,
                       FIELD("name", "\"hall\"") "," FIELD("state", "\"Closed\"")),
                "door hall 28 16 28 24 shut\n");
    const sl_import_options options = sl_import_options_default();
    assert_note(sli_map_read_ldtk, ldtk_of(TWO_ROOMS, ENTITY("Guard", "12,20", "0,0", EIGHT, "")),
                &options, ": objects left out: 'Guard'\n");
    assert_ldtk("#######\n#..#..#\n#..D..#\n#..#..#\n#######", "", door);
    assert_ldtk("####\n#..#\n####\n#.D#\n####", "", "");
    assert_ldtk("#####\n#...#\n##DD#\n#...#\n#####", "", "door Door 16 20 32 20 open\n");
}

/// The door that an ASCII plan has in a square, in pixels; false where the plan is refused, or
/// where no open square is on one side of the door.
static bool door_of_plan(sl_context *context, const char *plan, size_t at, char *door) {
    sl_map map = {0};
    if (sli_map_read_plan(context, "plan", plan, strlen(plan), &map) != SL_OK) return false;
    const size_t stride = strcspn(plan, "\n") + 1;
    const sl_segment s = map.doors[0].segment;
    const size_t step = s.a.x == s.b.x ? 1 : stride;
    snprintf(door, 128, "door door %g %g %g %g open\n", 8 * s.a.x, 8 * s.a.y, 8 * s.b.x, 8 * s.b.y);
    sl_map_destroy(context, &map);
    return plan[at - step] == '.' && plan[at + step] == '.';
}

/// Random plans, a door in each of their squares in turn: as an ASCII plan has it. The square of
/// the door may be drawn solid.
static void test_doors_of_plans(void **state) {
    (void)state;
    enum { SIDE = 7 };
    sl_context *context = testing_context(NULL);
    const sl_import_options options = with_doors(NULL);
    uint32_t random = 1;
    size_t found = 0;
    for (int round = 0; round < 20; round++) {
        char plan[SIDE * (SIDE + 1)] = "";
        for (size_t i = 0; i + 1 < sizeof plan; i++) {
            const size_t column = i % (SIDE + 1), row = i / (SIDE + 1);
            const bool edge = column == 0 || row == 0 || column == SIDE - 1 || row == SIDE - 1;
            random = random * 1664525 + 1013904223;
            plan[i] = column == SIDE ? '\n' : edge || random >> 31 ? '#' : '.';
        }
        for (size_t i = SIDE + 2; i < sizeof plan - SIDE - 2; i++) {
            const size_t column = i % (SIDE + 1), row = i / (SIDE + 1);
            if (column == 0 || column >= SIDE - 1) continue;
            char expected[128] = "", object[128], things[MOST_TEXT];
            const char was = plan[i];
            plan[i] = '+';
            if (!door_of_plan(context, plan, i, expected)) *expected = '\0';
            plan[i] = was;
            found += *expected != '\0';
            snprintf(object, sizeof object,
                     OBJECTS("<object name='door' x='%zu' y='%zu' width='8' height='8'/>"),
                     8 * column, 8 * row);
            read_things(sli_map_read_tmx, tmx_of(plan, object), &options, things, NULL, NULL);
            if (strcmp(things, expected) != 0)
                fail_msg("%s\n(%zu,%zu): '%s' is not '%s'", plan, column, row, things, expected);
        }
    }
    assert_true(found > 30);
    sl_context_destroy(context);
}

// --- templates

static void test_templates(void **state) {
    (void)state;
    char folder[] = "/tmp/starts-XXXXXX", cwd[4096];
    assert_non_null(getcwd(cwd, sizeof cwd));
    assert_non_null(mkdtemp(folder));
    assert_int_equal(chdir(folder), 0);
    import_write_file("door.tx", "<template><object name='gate' width='8' height='8'><properties>"
                                 "<property name='locked' type='bool' value='true'/></properties>"
                                 "</object></template>");
    import_write_file("player.tj", "{\"type\": \"template\", \"object\": {\"name\": \"Player\", "
                                   "\"point\": true, \"rotation\": 180}}");
    assert_tmx(TWO_ROOMS, OBJECTS("<object template='door.tx' " AT("24", "16") "/>"),
               "door gate 28 16 28 24 shut\n");
    assert_tmx(TWO_ROOMS,
               OBJECTS("<object template='door.tx' name='west gate' " AT("24", "16") ">" BOOL(
                   "locked", "false") "</object>"),
               "door west_gate 28 16 28 24 open\n");
    assert_tmx(TWO_ROOMS,
               OBJECTS("<object template='player.tj' " AT(
                   "12", "20") "/>"
                               "<object template='player.tj' rotation='0' " AT("12", "12") "/>"),
               "start 12 20 180\nstart 12 28 0\n");
    const sl_import_options options = sl_import_options_default();
    assert_note(sli_map_read_tmx,
                tmx_of(TWO_ROOMS, OBJECTS("<object template='no.tx' " AT("12", "20") "/>")),
                &options, "f: its template 'no.tx' cannot be read\n");
    import_write_file("bad.tx", "<template>");
    const char *text = tmx_of(TWO_ROOMS, OBJECTS("<object template='bad.tx'/>"));
    assert_refused_of(sli_map_read_tmx, NULL, text, strlen(text), SL_BAD_INPUT, "bad.tx:1: XML");
    assert_int_equal(unlink("door.tx") + unlink("player.tj") + unlink("bad.tx"), 0);
    assert_int_equal(chdir(cwd), 0);
    assert_int_equal(rmdir(folder), 0);
}

// --- no memory

static void test_memory(void **state) {
    (void)state;
    const sl_import_options options = with_doors("player");
    assert_memory_of(
        sli_map_read_tmx, &options,
        tmx_of("#######\n#..#..#\n#..X..#\n#..#..#\n#######",
               OBJECTS(POINT("player", AT("12", "12")) LINE("door", AT("12", "9"), "0,0 4,4")
                           NAMED(" door", SIZED("9", "9", "3", "5"))
                               NAMED("door", SIZED("9", "9", "3", "5")))));
    assert_memory_of(sli_map_read_ldtk, &options,
                     ldtk_of(TWO_ROOMS, ENTITY("Door", "24,16", "0,0", EIGHT, "") "," ENTITY(
                                            "Player", "12,12", "0,0", EIGHT, "")));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_names),
        cmocka_unit_test(test_starts_of_tiled),
        cmocka_unit_test(test_starts_and_walls),
        cmocka_unit_test(test_start_names),
        cmocka_unit_test(test_starts_of_chunks),
        cmocka_unit_test(test_starts_of_ldtk),
        cmocka_unit_test(test_starts_of_worlds),
        cmocka_unit_test(test_tokens_of_foundry),
        cmocka_unit_test(test_doors_of_tiled),
        cmocka_unit_test(test_doors_on_solid_squares),
        cmocka_unit_test(test_notes_about_doors),
        cmocka_unit_test(test_doors_without_passage),
        cmocka_unit_test(test_doors_in_ground),
        cmocka_unit_test(test_doors_between_shapes),
        cmocka_unit_test(test_double_doors),
        cmocka_unit_test(test_doors_drawn_twice),
        cmocka_unit_test(test_layers_of_doors),
        cmocka_unit_test(test_names_of_doors),
        cmocka_unit_test(test_states_of_doors),
        cmocka_unit_test(test_doors_of_ldtk),
        cmocka_unit_test(test_doors_of_plans),
        cmocka_unit_test(test_templates),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

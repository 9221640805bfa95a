// Doom WADs: maps by name, lines with one side and with two, doors, both kinds of records and the
// text format; and each way in which a WAD can be broken.
#include "testing.h"

#include "io/io_formats.h"
#include "sightline/io.h"
#include "unit/map_same.h"
#include "wad_make.h"

typedef struct noted {
    char text[2048];
} noted;

static void keep_note(void *user, const char *message) {
    noted *notes = user;
    const size_t used = strlen(notes->text);
    snprintf(notes->text + used, sizeof notes->text - used, "%s\n", message);
}

static sl_status read_wad(sl_context *context, const wad_made *wad, const char *name, bool doors,
                          sl_map *map) {
    const sl_import_options options = {.map = name, .doors = doors};
    // Read from a block of its own size, so that a byte too far is seen.
    char *copy = malloc(wad->size + 1);
    assert_non_null(copy);
    memcpy(copy, wad->bytes, wad->size);
    const sl_status status = sli_map_read_wad(context, "in.wad", copy, wad->size, &options, map);
    free(copy);
    return status;
}

static void two_rooms(wad_made *wad, int special, int tag, int ceiling) {
    wad_begin(wad);
    wad_two_rooms(wad, "MAP01", special, tag, ceiling, NULL);
    wad_end(wad);
}

static void test_lines(void **state) {
    (void)state;
    noted notes = {""};
    const sl_hooks hooks = {.user = &notes, .note = keep_note};
    sl_context *context = sl_context_create(&hooks);
    wad_made wad;
    two_rooms(&wad, 0, 0, 128);
    sl_map map = {0};
    assert_ok(context, read_wad(context, &wad, "map01", false, &map));
    assert_int_equal(map.wall_count, 12);
    assert_int_equal(map.door_count, 0);
    assert_int_equal(map.start_count, 1);
    assert_true(map.starts[0].at.x == 32 && map.starts[0].at.y == 32);
    assert_true(map.starts[0].heading == 90);
    const sl_box box = sl_map_bounds(&map);
    assert_true(box.min.x == 0 && box.min.y == 0 && box.max.x == 136 && box.max.y == 64);
    assert_non_null(strstr(notes.text, "of 14 lines 12 with one side are walls, 2 with two are"));
    assert_null(strstr(notes.text, "--doors"));
    sl_map_destroy(context, &map);
    free(wad.bytes);
    sl_context_destroy(context);
}

/// By hand, by tag, by Boom's generalized specials, and without a special where the ceiling meets
/// the floor.
static void test_doors(void **state) {
    (void)state;
    const struct {
        int special, tag, ceiling;
        size_t doors;
        bool open;
    } cases[] = {
        {1, 0, 0, 2, false},        {1, 0, 100, 2, true},       {31, 0, 100, 2, true},
        {2, 7, 100, 2, true},       {2, 8, 100, 0, false},      {0, 0, 0, 2, false},
        {0, 0, -8, 2, false},       {0, 0, 1, 0, false},        {11, 7, 100, 0, false},
        {0x3c06, 0, 100, 2, true},  {0x3c00, 7, 100, 2, true},  {0x3c00, 0, 100, 0, false},
        {0x3807, 9, 100, 2, true},  {0x4000, 7, 100, 0, false}, {-1, 7, 100, 0, false},
        {0x37ff, 7, 100, 0, false}, {196, 7, 64, 2, true},
    };
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wad_made wad;
        two_rooms(&wad, cases[i].special, cases[i].tag, cases[i].ceiling);
        sl_map map = {0};
        assert_ok(context, read_wad(context, &wad, NULL, true, &map));
        assert_int_equal(map.wall_count, 12);
        if (map.door_count != cases[i].doors)
            fail_msg("special %d, tag %d, ceiling %d: %zu doors", cases[i].special, cases[i].tag,
                     cases[i].ceiling, map.door_count);
        for (size_t k = 0; k < map.door_count; k++) {
            assert_string_equal(map.doors[k].name, "sector_1");
            assert_int_equal(map.doors[k].open, cases[i].open);
            assert_true(map.doors[k].segment.a.x == (k ? 72 : 64));
        }
        sl_map_destroy(context, &map);
        assert_ok(context, read_wad(context, &wad, NULL, false, &map));
        assert_int_equal(map.wall_count, 12);
        assert_int_equal(map.door_count, 0);
        sl_map_destroy(context, &map);
        free(wad.bytes);
    }
    sl_context_destroy(context);
}

/// Maps by name, each once; what lies between them is no map.
static void test_list(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    wad_made wad;
    wad_begin(&wad);
    wad_text(&wad, "PLAYPAL", "colours");
    wad_two_rooms(&wad, "E1M1", 0, 0, 0, NULL);
    wad_two_rooms(&wad, "E1M2", 0, 0, 0, NULL);
    wad_text(&wad, "CREDIT", "between");
    wad_lump(&wad, "WORLD", NULL, 0);
    wad_text(&wad, "TEXTMAP", "namespace = \"doom\";");
    wad_lump(&wad, "ZNODES", NULL, 0);
    wad_lump(&wad, "ENDMAP", NULL, 0);
    wad_two_rooms(&wad, "E1M1", 0, 0, 0, "SECTORS");
    wad_end(&wad);
    sl_map_list list = {0};
    assert_ok(context, sli_map_list_wad(context, "in.wad", (char *)wad.bytes, wad.size, &list));
    assert_int_equal(list.count, 3);
    assert_string_equal(list.names[0], "E1M1");
    assert_string_equal(list.names[1], "E1M2");
    assert_string_equal(list.names[2], "WORLD");
    sl_map_list_destroy(context, &list);
    sl_map map = {0};
    assert_ok(context, read_wad(context, &wad, "E1M2", false, &map));
    sl_map_destroy(context, &map);
    assert_ok(context, read_wad(context, &wad, "world", false, &map));
    assert_int_equal(map.wall_count, 0);
    sl_map_destroy(context, &map);
    // Of two maps with one name the game takes the last; here that one is broken.
    assert_int_equal(read_wad(context, &wad, "E1M1", false, &map), SL_BAD_INPUT);
    assert_string_equal(sl_context_message(context), "in.wad: map E1M1 has no lump SECTORS");
    assert_int_equal(read_wad(context, &wad, "E9M9", false, &map), SL_BAD_INPUT);
    assert_true(map_is_empty(&map));
    free(wad.bytes);
    sl_context_destroy(context);
}

/// The same through sl_map_read: the name is asked for where there are several.
static void test_choice(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    assert_ok(context, sl_io_use(context));
    char path[] = "/tmp/sightline-wad-XXXXXX";
    const int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    wad_made wad;
    wad_begin(&wad);
    for (int i = 1; i <= 8; i++) {
        char name[9];
        snprintf(name, sizeof name, "MAP%02d", i);
        wad_lump(&wad, name, NULL, 0);
        wad_text(&wad, "TEXTMAP", "namespace = \"doom\"; vertex { x = 1; y = 2; }");
        wad_lump(&wad, "ENDMAP", NULL, 0);
    }
    wad_end(&wad);
    FILE *file = fdopen(descriptor, "wb");
    assert_int_equal(fwrite(wad.bytes, 1, wad.size, file), wad.size);
    assert_int_equal(fclose(file), 0);
    sl_map map = {0};
    char expected[300];
    // Known by its bytes: the name has no ending.
    assert_int_equal(sl_map_read(context, path, NULL, &map), SL_BAD_ARGUMENT);
    snprintf(expected, sizeof expected,
             "%s: it holds 8 maps, MAP01, MAP02, MAP03, MAP04, MAP05, MAP06 ...: choose one by "
             "--map NAME, as in: sightline check '%s' --map 'MAP01' -o map.png",
             path, path);
    assert_string_equal(sl_context_message(context), expected);
    const sl_import_options unknown = {.map = "MAP9"}, known = {.map = "map07"};
    assert_int_equal(sl_map_read(context, path, &unknown, &map), SL_BAD_ARGUMENT);
    snprintf(expected, sizeof expected,
             "%s: there is no map 'MAP9': it holds 8 maps, MAP01, MAP02, MAP03, MAP04, MAP05, "
             "MAP06 ...",
             path);
    assert_string_equal(sl_context_message(context), expected);
    assert_true(map_is_empty(&map));
    assert_ok(context, sl_map_read(context, path, &known, &map));
    sl_map_destroy(context, &map);
    sl_map_choice choice;
    assert_ok(context, sl_map_choice_read(context, path, &choice));
    assert_int_equal(choice.maps.count, 8);
    sl_map_choice_destroy(context, &choice);
    remove(path);
    free(wad.bytes);
    sl_context_destroy(context);
}

static void test_hexen(void **state) {
    (void)state;
    static const size_t vertex[] = {0, 2}, side[] = {28}, sector[] = {0, 2, 24};
    static const int vertices[][2] = {{-8, -8}, {8, 8}}, sides[][1] = {{0}, {1}},
                     sectors[][3] = {{0, 64, 0}, {0, 64, 3}};
    // from, to, special and first argument in one, sides
    static const size_t line[] = {0, 2, 6, 12, 14}, thing[] = {2, 4, 8, 10};
    static const int lines[][5] = {{0, 1, 12 | 3 << 8, 0, 1}, {1, 0, 0, 0, 0xffff}};
    static const int things[][4] = {{-4, 4, 270, 1}, {4, -4, 45, 1}, {0, 0, 0, 2}};
    sl_context *context = testing_context(NULL);
    wad_made wad;
    wad_begin(&wad);
    wad_lump(&wad, "MAP05", NULL, 0);
    wad_records(&wad, "THINGS", 20, 4, thing, WAD_ROWS(things));
    wad_records(&wad, "LINEDEFS", 16, 5, line, WAD_ROWS(lines));
    wad_records(&wad, "SIDEDEFS", 30, 1, side, WAD_ROWS(sides));
    wad_records(&wad, "VERTEXES", 4, 2, vertex, WAD_ROWS(vertices));
    wad_records(&wad, "SECTORS", 26, 3, sector, WAD_ROWS(sectors));
    wad_text(&wad, "BEHAVIOR", "ACS");
    wad_end(&wad);
    sl_map map = {0};
    assert_ok(context, read_wad(context, &wad, "MAP05", true, &map));
    assert_int_equal(map.wall_count, 1);
    assert_true(map.walls[0].a.x == 8 && map.walls[0].b.y == -8);
    assert_int_equal(map.door_count, 1);
    assert_string_equal(map.doors[0].name, "sector_1");
    // The last start of player 1, then that of player 2.
    assert_int_equal(map.start_count, 2);
    assert_true(map.starts[0].at.x == 4 && map.starts[0].heading == 45);
    assert_true(map.starts[1].at.x == 0 && map.starts[1].at.y == 0);
    sl_map_destroy(context, &map);
    free(wad.bytes);
    sl_context_destroy(context);
}

// --- the text format

static void text_wad(wad_made *wad, const char *text) {
    wad_begin(wad);
    wad_lump(wad, "MAP01", NULL, 0);
    wad_text(wad, "TEXTMAP", text);
    wad_lump(wad, "ENDMAP", NULL, 0);
    wad_end(wad);
}

#define SQUARE                                                                                     \
    "vertex { x = 0; y = 0; } vertex { x = 0.5; y = 8e0; } VERTEX{X=+8;Y=0x8;}\n"                  \
    "sidedef { sector = 0; texturemiddle = \"a \\\" } b\"; } sidedef { sector = 01; }\n"           \
    "sector { heightceiling = 64; } sector { id = 5; heightceiling = 32; }\n"

static void test_textmap(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    wad_made wad;
    text_wad(&wad, "// a comment\nnamespace = \"ZDoom\"; /* another\n { */ unknown = yes;\n" SQUARE
                   "linedef // at once\n{ v1 = 0; v2 = 1; sidefront = 0; blocking = true; }\n"
                   "linedef { v1 = 1; v2 = 2; sidefront = 0; sideback = 1; special = 11; "
                   "arg0 = 5; id = 9; }\n"
                   "linedef { v1 = 1; v2 = 1; sidefront = 0; }\n"
                   "linedef { v1 = 0; v2 = 2; sidefront = -1; }\n"
                   "linedef { v1 = 0; v2 = 2; }\n" // a stray one, without sides
                   "thing { x = 1; y = 2.25; type = 1; angle = -45; } weird { a = b; }");
    sl_map map = {0};
    assert_ok(context, read_wad(context, &wad, "MAP01", true, &map));
    assert_int_equal(map.wall_count, 1);
    assert_true(map.walls[0].b.x == 0.5 && map.walls[0].b.y == 8);
    char named[SL_LINE_TEXT];
    sl_map_say_line(&map, map.walls[0].line, named);
    assert_string_equal(named, "linedef 0, TEXTMAP line 7");
    assert_int_equal(map.door_count, 1);
    assert_string_equal(map.doors[0].name, "sector_1");
    assert_true(map.doors[0].segment.b.x == 8 && map.doors[0].segment.b.y == 8);
    assert_int_equal(map.start_count, 1);
    assert_true(map.starts[0].heading == -45);
    sl_map_destroy(context, &map);
    free(wad.bytes);
    // Doom's namespace has Doom's specials, and the id as the tag.
    text_wad(&wad, "namespace = \"doom\";" SQUARE
                   "linedef { v1 = 1; v2 = 2; sidefront = 0; sideback = 1; special = 2; id = 5; }");
    assert_ok(context, read_wad(context, &wad, "MAP01", true, &map));
    assert_int_equal(map.door_count, 1);
    sl_map_destroy(context, &map);
    free(wad.bytes);
    sl_context_destroy(context);
}

/// A room with a pillar of four lines, of which the first has a special, a line within with
/// another, and a wall with a third.
static size_t walls_with_specials(const char *name_space, int pillar, int within, int wall,
                                  noted *notes) {
    const sl_hooks hooks = {.user = notes, .note = keep_note};
    sl_context *context = sl_context_create(&hooks);
    char text[2048];
    snprintf(
        text, sizeof text,
        "namespace = \"%s\"; sidedef { sector = 0; } sector { }\n"
        "vertex { x = 0; y = 0; } vertex { x = 0; y = 64; } vertex { x = 64; y = 64; }\n"
        "vertex { x = 64; y = 0; } vertex { x = 16; y = 16; } vertex { x = 32; y = 16; }\n"
        "vertex { x = 32; y = 32; } vertex { x = 16; y = 32; } vertex { x = 48; y = 48; }\n"
        "linedef { v1 = 0; v2 = 1; sidefront = 0; special = %d; }\n"
        "linedef { v1 = 1; v2 = 2; sidefront = 0; } linedef { v1 = 2; v2 = 3; sidefront = 0; }\n"
        "linedef { v1 = 3; v2 = 0; sidefront = 0; } linedef { v1 = 6; v2 = 7; sidefront = 0; }\n"
        "linedef { v1 = 4; v2 = 5; sidefront = 0; special = %d; arg0 = 7; }\n"
        "linedef { v1 = 7; v2 = 4; sidefront = 0; } linedef { v1 = 5; v2 = 6; sidefront = 0; }\n"
        "linedef { v1 = 8; v2 = 6; sidefront = 0; special = %d; }\n",
        name_space, wall, pillar, within);
    wad_made wad;
    text_wad(&wad, text);
    sl_map map = {0};
    assert_ok(context, read_wad(context, &wad, "MAP01", false, &map));
    const size_t walls = map.wall_count;
    sl_map_destroy(context, &map);
    free(wad.bytes);
    sl_context_destroy(context);
    return walls;
}

/// A polyobject is the lines from its first one on, or those that say so each. Only Hexen's
/// specials have them, and portals.
static void test_polyobjects(void **state) {
    (void)state;
    noted notes = {""}, none = {""}, portal = {""};
    assert_int_equal(walls_with_specials("zdoom", 1, 5, 0, &notes), 4);
    assert_non_null(strstr(notes.text, "left out: 5 lines of polyobjects, which the game moves\n"));
    assert_int_equal(walls_with_specials("zdoom", 5, 0, 0, &none), 8);
    assert_int_equal(walls_with_specials("zdoom", 0, 1, 0, &none), 4);
    none.text[0] = '\0';
    assert_int_equal(walls_with_specials("doom", 1, 5, 156, &none), 9);
    assert_null(strstr(none.text, "left out"));
    assert_null(strstr(none.text, "portal"));
    const int portals[] = {57, 156, 301};
    for (size_t i = 0; i < sizeof portals / sizeof *portals; i++) {
        portal.text[0] = '\0';
        assert_int_equal(walls_with_specials("zdoom", 0, 0, portals[i], &portal), 9);
        assert_non_null(strstr(portal.text, "1 line of portals: portals are not followed"));
    }
}

static void assert_starts(const char *things, const char *expected, const char *note) {
    noted notes = {""};
    const sl_hooks hooks = {.user = &notes, .note = keep_note};
    sl_context *context = sl_context_create(&hooks);
    char text[2048], found[256] = "";
    snprintf(text, sizeof text,
             "namespace = \"doom\";" SQUARE "linedef { v1 = 0; v2 = 1; sidefront = 0; }\n%s",
             things);
    wad_made wad;
    text_wad(&wad, text);
    sl_map map = {0};
    assert_ok(context, read_wad(context, &wad, "MAP01", false, &map));
    for (size_t i = 0; i < map.start_count; i++)
        snprintf(found + strlen(found), sizeof found - strlen(found), "%g ", map.starts[i].at.x);
    assert_string_equal(found, expected);
    if (!strstr(notes.text, note)) fail_msg("no '%s' in: %s", note, notes.text);
    sl_map_destroy(context, &map);
    free(wad.bytes);
    sl_context_destroy(context);
}

/// The last start of each of four players; those of a deathmatch only where players have none.
static void test_starts(void **state) {
    (void)state;
#define THING(x, type) "thing { x = " x "; y = 2; type = " type "; }\n"
    assert_starts(THING("3", "2") THING("1", "1") THING("2", "1") THING("4", "4") THING("5", "11")
                      THING("6", "3001"),
                  "2 3 4 ", "map MAP01: players start at 3 places");
    assert_starts(THING("5", "11") THING("6", "11") THING("7", "5"), "5 6 ",
                  "no player has a start; the 2 starts of a deathmatch are taken");
    assert_starts(THING("6", "3001"), "", "no player has a start");
}

/// A closed square, its sidedefs and its sector: `n` counts squares.
static void add_square(char *text, size_t size, int n, double x, double side, int tag) {
    const double at[4][2] = {{x, 0}, {x, side}, {x + side, side}, {x + side, 0}};
    const size_t used = strlen(text);
    snprintf(text + used, size - used,
             "sector { id = %d; heightceiling = 64; }\nsidedef { sector = %d; }\n", tag, n);
    for (int i = 0; i < 4; i++) {
        const size_t now = strlen(text);
        snprintf(text + now, size - now,
                 "vertex { x = %g; y = %g; } linedef { v1 = %d; v2 = %d; sidefront = %d; }\n",
                 at[i][0], at[i][1], 4 * n + i, 4 * n + (i + 1) % 4, n);
    }
}

/// A start in a closet reaches little and is left out. What teleporters lead to is inside, too, and
/// they lead to sectors of their tag alone.
static void test_starts_that_reach(void **state) {
    (void)state;
    const struct {
        const char *special;
        int tag; ///< of the far room's sector; that of the line is 7
        double closet;
        const char *expected, *note;
    } cases[] = {
        {"97", 7, 20, "5 350 ", "map MAP01: left out: the start at 205,2: it reaches less than a"},
        {"97", 7, 20, "5 350 ", "by teleporters players reach 1 place apart from these"},
        {"97", 8, 20, "5 ", "map MAP01: left out: the start at 205,2"},
        {"125", 7, 20, "5 ", "map MAP01: left out: the start at 205,2"}, // for monsters alone
        {"97", 8, 60, "5 205 ", "map MAP01: players start at 2 places"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        noted notes = {""};
        const sl_hooks hooks = {.user = &notes, .note = keep_note};
        sl_context *context = sl_context_create(&hooks);
        char text[4096] = "namespace = \"doom\";\n", found[64] = "";
        add_square(text, sizeof text, 0, 0, 100, 0);
        add_square(text, sizeof text, 1, 200, cases[i].closet, 0);
        add_square(text, sizeof text, 2, 300, 100, cases[i].tag);
        const size_t used = strlen(text);
        snprintf(text + used, sizeof text - used,
                 "vertex { x = 50; y = 20; } vertex { x = 60; y = 20; }\n"
                 "linedef { v1 = 12; v2 = 13; sidefront = 0; sideback = 0; special = %s; id = 7; "
                 "}\n" THING("5", "1") THING("205", "2") THING("350", "14"),
                 cases[i].special);
        wad_made wad;
        text_wad(&wad, text);
        sl_map map = {0};
        assert_ok(context, read_wad(context, &wad, "MAP01", false, &map));
        for (size_t k = 0; k < map.start_count; k++)
            snprintf(found + strlen(found), sizeof found - strlen(found), "%g ",
                     map.starts[k].at.x);
        assert_string_equal(found, cases[i].expected);
        if (!strstr(notes.text, cases[i].note))
            fail_msg("no '%s' in: %s", cases[i].note, notes.text);
        sl_map_destroy(context, &map);
        free(wad.bytes);
        sl_context_destroy(context);
    }
}

static void test_textmap_broken(void **state) {
    (void)state;
    const struct {
        const char *text, *message;
    } cases[] = {
        {"vertex { x = 1; y = 2;", "in.wad:1: map MAP01, lump TEXTMAP: expected a field's name or "
                                   "'}', found the end of the lump"},
        {"\nvertex { x = 1; }", "in.wad:2: map MAP01, lump TEXTMAP: this vertex has no y"},
        {"\n\nvertex { x = one; y = 2; }",
         "in.wad:3: map MAP01, lump TEXTMAP: x: expected a number, found 'one'"},
        {"vertex { x = 1e400; y = 2; }",
         "in.wad:1: map MAP01, lump TEXTMAP: x: expected a number, found '1e400'"},
        {"vertex { x = 1; y = 2 }", "in.wad:1: map MAP01, lump TEXTMAP: expected ';', found '}'"},
        {"vertex { x 1; }", "in.wad:1: map MAP01, lump TEXTMAP: expected '=', found '1'"},
        {"vertex { x = ; }", "in.wad:1: map MAP01, lump TEXTMAP: expected a value, found ';'"},
        {"}", "in.wad:1: map MAP01, lump TEXTMAP: expected a name, found '}'"},
        {"vertex x", "in.wad:1: map MAP01, lump TEXTMAP: expected '{', found 'x'"},
        {"a = \"text\n\\\"", "in.wad:1: map MAP01, lump TEXTMAP: '\"' without a second one"},
        {"a = \"\\", "in.wad:1: map MAP01, lump TEXTMAP: '\"' without a second one"},
        {"a\n/* b", "in.wad:2: map MAP01, lump TEXTMAP: '/*' without '*/'"},
        {"sidedef { sector = 0.5; }",
         "in.wad:1: map MAP01, lump TEXTMAP: sector: expected a whole number, found '0.5'"},
        {"sidedef { sector = 0x100000000; }",
         "in.wad:1: map MAP01, lump TEXTMAP: sector: expected a whole number, found '0x100000000'"},
        {"linedef { v1 = 0; sidefront = 0; }",
         "in.wad:1: map MAP01, lump TEXTMAP: this linedef has no v2"},
        {SQUARE "linedef { v1 = 0; v2 = 3; sidefront = 0; }",
         "in.wad:4: map MAP01, linedef 0: vertex 3, but there are 3"},
        {SQUARE "\nlinedef { v1 = 0; v2 = 1; sidefront = 2; }",
         "in.wad:5: map MAP01, linedef 0: sidedef 2, but there are 2"},
        {SQUARE "linedef { v1 = 0; v2 = 1; sidefront = -2; }",
         "in.wad:4: map MAP01, linedef 0: sidedef -2, but there are 2"},
        {SQUARE "sidedef { sector = 2; }\nlinedef { v1 = 0; v2 = 1; sidefront = 2; }",
         "in.wad:4: map MAP01, sidedef 2: sector 2, but there are 2"},
    };
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wad_made wad;
        text_wad(&wad, cases[i].text);
        sl_map map = {0};
        assert_int_equal(read_wad(context, &wad, NULL, false, &map), SL_BAD_INPUT);
        assert_string_equal(sl_context_message(context), cases[i].message);
        assert_true(map_is_empty(&map));
        free(wad.bytes);
    }
    sl_context_destroy(context);
}

// --- broken files

static void expect_broken(sl_context *context, const wad_made *wad, const char *message) {
    sl_map map = {0};
    const sl_status status = read_wad(context, wad, NULL, false, &map);
    if (status != SL_BAD_INPUT || !strstr(sl_context_message(context), message))
        fail_msg("expected '%s', found '%s'", message,
                 status == SL_OK ? "" : sl_context_message(context));
    assert_memory_equal(sl_context_message(context), "in.wad: ", 8);
    assert_true(map_is_empty(&map));
}

static void test_directory_broken(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    wad_made wad;
    two_rooms(&wad, 0, 0, 0);
    const size_t whole = wad.size;
    // Cut off anywhere, it is refused, and nothing is read beyond the end.
    for (wad.size = 0; wad.size < whole; wad.size += wad.size < 16 ? 1 : 7)
        expect_broken(context, &wad, "");
    wad.size = 11;
    expect_broken(context, &wad, "the WAD's header is cut off: 11 bytes of 12");
    wad.size = whole - 1;
    expect_broken(context, &wad, "does not lie in the file's");
    wad.size = whole;
    wad_u32(wad.bytes + 4, UINT32_MAX);
    expect_broken(context, &wad, "the directory of 4294967295 lumps");
    wad_u32(wad.bytes + 4, 0);
    expect_broken(context, &wad, "holds no map");
    memcpy(wad.bytes, "QWAD", 4);
    expect_broken(context, &wad, "no WAD: expected 'IWAD' or 'PWAD'");
    free(wad.bytes);
    sl_context_destroy(context);
}

/// Lumps of scripts behind a name are no map, whatever the name is: libraries have them, too.
static void test_scripts_alone(void **state) {
    (void)state;
    static const char *const libraries[] = {"A_END", "MAP01"};
    sl_context *context = testing_context(NULL);
    wad_made wad;
    wad_begin(&wad);
    wad_text(&wad, "A_START", "");
    wad_text(&wad, "BEHAVIOR", "ACS");
    wad_text(&wad, "SCRIPTS", "script");
    wad_two_rooms(&wad, "MAP01", 0, 0, 0, NULL);
    for (size_t i = 0; i < 2; i++) {
        wad_text(&wad, libraries[i], "");
        wad_text(&wad, "BEHAVIOR", "ACS");
    }
    wad_end(&wad);
    sl_map map = {0};
    assert_ok(context, read_wad(context, &wad, NULL, false, &map));
    assert_int_equal(map.wall_count, 12);
    sl_map_destroy(context, &map);
    free(wad.bytes);
    wad_begin(&wad);
    wad_text(&wad, "MAP01", "");
    wad_text(&wad, "BEHAVIOR", "ACS");
    wad_end(&wad);
    expect_broken(context, &wad, "holds no map");
    free(wad.bytes);
    sl_context_destroy(context);
}

static void test_lumps_broken(void **state) {
    (void)state;
    static const char *const needed[] = {"THINGS", "LINEDEFS", "SIDEDEFS", "VERTEXES", "SECTORS"};
    sl_context *context = testing_context(NULL);
    char message[100];
    for (size_t i = 0; i < sizeof needed / sizeof *needed; i++) {
        wad_made wad;
        wad_begin(&wad);
        wad_two_rooms(&wad, "MAP01", 0, 0, 0, needed[i]);
        wad_end(&wad);
        snprintf(message, sizeof message, "map MAP01 has no lump %s", needed[i]);
        expect_broken(context, &wad, message);
        free(wad.bytes);
        two_rooms(&wad, 0, 0, 0);
        for (size_t k = 0; k < wad.lump_count; k++) {
            unsigned char *entry = wad.bytes + wad.size - (wad.lump_count - k) * 16;
            if (strcmp(wad.lumps[k].name, needed[i]) != 0) continue;
            wad_u32(entry + 4, (uint32_t)wad.lumps[k].size - 1);
            snprintf(message, sizeof message, "lump %s: %zu bytes are no whole number of records",
                     needed[i], wad.lumps[k].size - 1);
            expect_broken(context, &wad, message);
            wad_u32(entry + 4, (uint32_t)wad.size);
            snprintf(message, sizeof message, "lump %zu, %s: its %zu bytes at byte", k, needed[i],
                     wad.size);
            expect_broken(context, &wad, message);
            wad_u32(entry, UINT32_MAX);
            expect_broken(context, &wad, "at byte 4294967295 do not lie in the file's");
        }
        free(wad.bytes);
    }
    // Doom 64 has the names of Doom's lumps, and other records.
    wad_made wad;
    wad_begin(&wad);
    wad_two_rooms(&wad, "MAP01", 0, 0, 0, NULL);
    wad_lump(&wad, "LEAFS", NULL, 0);
    wad_end(&wad);
    expect_broken(context, &wad, "map MAP01 is one of Doom 64");
    free(wad.bytes);
    sl_context_destroy(context);
}

/// One number of a lump is too large.
static void test_references_broken(void **state) {
    (void)state;
    const struct {
        const char *lump;
        size_t place;
        int value;
        const char *message;
    } cases[] = {
        {"LINEDEFS", 2, 12, "map MAP01, linedef 0: vertex 12, but there are 12"},
        {"LINEDEFS", 14, 0xffff, "map MAP01, linedef 1: vertex 65535, but there are 12"},
        {"LINEDEFS", 24, 3, "map MAP01, linedef 1: sidedef 3, but there are 3"},
        {"LINEDEFS", 12 * 14 + 12, 77, "map MAP01, linedef 12: sidedef 77, but there are 3"},
        {"SIDEDEFS", 58, 3, "map MAP01, sidedef 1: sector 3, but there are 3"},
    };
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wad_made wad;
        two_rooms(&wad, 0, 0, 0);
        for (size_t k = 0; k < wad.lump_count; k++)
            if (strcmp(wad.lumps[k].name, cases[i].lump) == 0)
                wad_u16(wad.bytes + wad.lumps[k].offset + cases[i].place, cases[i].value);
        expect_broken(context, &wad, cases[i].message);
        free(wad.bytes);
    }
    sl_context_destroy(context);
}

static void test_memory(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    const long outside = memory.live;
    wad_made wads[2];
    two_rooms(&wads[0], 1, 0, 0);
    text_wad(&wads[1], "namespace = \"zdoom\";" SQUARE "linedef { v1 = 0; v2 = 1; sidefront = 0; }"
                       "thing { x = 1; y = 2; type = 1; }");
    for (size_t i = 0; i < 2; i++) {
        for (long fail_at = 1;; fail_at++) {
            memory.fail_at = memory.calls + fail_at;
            sl_map map = {0};
            const sl_status status = read_wad(context, &wads[i], NULL, true, &map);
            memory.fail_at = 0;
            sl_map_destroy(context, &map);
            assert_int_equal(memory.live, outside);
            if (status == SL_OK) break;
            assert_int_equal(status, SL_NO_MEMORY);
        }
        free(wads[i].bytes);
    }
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lines),
        cmocka_unit_test(test_doors),
        cmocka_unit_test(test_list),
        cmocka_unit_test(test_choice),
        cmocka_unit_test(test_hexen),
        cmocka_unit_test(test_textmap),
        cmocka_unit_test(test_textmap_broken),
        cmocka_unit_test(test_directory_broken),
        cmocka_unit_test(test_scripts_alone),
        cmocka_unit_test(test_lumps_broken),
        cmocka_unit_test(test_references_broken),
        cmocka_unit_test(test_memory),
        cmocka_unit_test(test_starts),
        cmocka_unit_test(test_polyobjects),
        cmocka_unit_test(test_starts_that_reach),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

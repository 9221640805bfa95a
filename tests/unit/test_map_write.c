// Every format that can be written: what is written reads back as what it was, and what a format
// has no place for is named in a note. It also prints the table of round trips of
// lib/io/FORMATS.md, over maps/, tests/cases/ and the files named:
//
//     test_map_write --table [MAP...]
#include "testing.h"

#include "map/scan.h"
#include "map_files.h"
#include "map_same.h"

#include <math.h>
#include <unistd.h>

// --- a context that remembers its notes

typedef struct notes {
    char text[8192];
} notes;

static void keep_note(void *user, const char *message) {
    notes *kept = user;
    const size_t used = strlen(kept->text);
    snprintf(kept->text + used, sizeof kept->text - used, "%s\n", message);
}

static sl_context *noting_context(notes *kept) {
    const sl_hooks hooks = {.user = kept, .note = keep_note};
    sl_context *context = sl_context_create(&hooks);
    assert_non_null(context);
    assert_ok(context, sl_io_use(context));
    return context;
}

// --- a map's things as sets of lines

static int compare_lines(const void *left, const void *right) {
    return strcmp(*(char *const *)left, *(char *const *)right);
}

/// The lines of a text that begin with one of the words, sorted; free() is the caller's.
static char *lines_with(const char *text, const char *const *words) {
    char *copy = strdup(text), **lines = calloc(strlen(text) + 1, sizeof *lines);
    char *out = calloc(strlen(text) + 1, 1);
    assert_true(copy && lines && out);
    size_t count = 0, used = 0;
    for (char *line = strtok(copy, "\n"); line; line = strtok(NULL, "\n"))
        for (size_t i = 0; words[i]; i++) {
            const size_t length = strlen(words[i]);
            if (strncmp(line, words[i], length) == 0 && line[length] == ' ') lines[count++] = line;
        }
    if (count) qsort(lines, count, sizeof *lines, compare_lines);
    for (size_t i = 0; i < count; i++) used += (size_t)sprintf(out + used, "%s\n", lines[i]);
    free(lines);
    free(copy);
    return out;
}

static char *things_of(const sl_map *map, const char *const *words) {
    sl_map bare = *map;
    bare.source.comment_count = 0;
    bare.source.notes = NULL;
    char *text = map_text(&bare), *lines = lines_with(text, words);
    free(text);
    return lines;
}

static bool same_things(const sl_map *a, const sl_map *b, const char *const *words) {
    char *left = things_of(a, words), *right = things_of(b, words);
    const bool same = strcmp(left, right) == 0;
    free(left);
    free(right);
    return same;
}

/// A line from its lower end, and no 0 below 0.
static sl_wall ordered(sl_segment at) {
    const bool turned = at.b.x < at.a.x || (at.b.x == at.a.x && at.b.y < at.a.y);
    const sl_point a = turned ? at.b : at.a, b = turned ? at.a : at.b;
    return (sl_wall){.a = {a.x + 0.0, a.y + 0.0}, .b = {b.x + 0.0, b.y + 0.0}};
}

static int compare_walls(const void *left, const void *right) {
    const double *a = (const double *)left, *b = (const double *)right;
    for (int i = 0; i < 4; i++)
        if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
    return 0;
}

/// All walls as lines in order, each once; free() is the caller's.
static sl_wall *wall_set(const sl_map *map, bool with_mirrors, size_t *count) {
    sl_wall *set = calloc(map->wall_count + map->mirror_count + 1, sizeof *set);
    assert_non_null(set);
    size_t all = 0;
    for (size_t i = 0; i < map->wall_count; i++) {
        const sl_segment at = {map->walls[i].a, map->walls[i].b};
        if (at.a.x != at.b.x || at.a.y != at.b.y) set[all++] = ordered(at);
    }
    for (size_t i = 0; with_mirrors && i < map->mirror_count; i++)
        set[all++] = ordered(map->mirrors[i].segment);
    if (all) qsort(set, all, sizeof *set, compare_walls);
    *count = 0;
    for (size_t i = 0; i < all; i++)
        if (!i || compare_walls(&set[i - 1], &set[i]) != 0) set[(*count)++] = set[i];
    return set;
}

static bool same_wall_sets(const sl_map *a, const sl_map *b, bool mirrors_are_walls) {
    size_t counts[2];
    sl_wall *left = wall_set(a, mirrors_are_walls, &counts[0]);
    sl_wall *right = wall_set(b, false, &counts[1]);
    bool same = counts[0] == counts[1];
    for (size_t i = 0; same && i < counts[0]; i++) same = compare_walls(&left[i], &right[i]) == 0;
    free(left);
    free(right);
    return same;
}

static bool same_start_places(const sl_map *a, const sl_map *b) {
    if (a->start_count != b->start_count) return false;
    for (size_t i = 0; i < a->start_count; i++) {
        const sl_start *s = &a->starts[i], *t = &b->starts[i];
        if (s->at.x != t->at.x || s->at.y != t->at.y) return false;
        if (!(fabs(remainder(s->heading - t->heading, 360)) < 1e-9)) return false;
    }
    return true;
}

// --- one round trip

/// What may be kept or left out: the columns of the table.
typedef struct column {
    const char *name, *note; ///< the note's word for it
    unsigned keeps;
    const char *words[3];
} column;

static const column columns[] = {
    {"doors", "door", SL_KEEPS_DOORS, {"door"}},
    {"solid ground", "solid ground", SL_KEEPS_SOLID, {"solid", "open"}},
    {"mirrors", "mirror", SL_KEEPS_MIRRORS, {"mirror"}},
    {"one-way glass", "one-way glass", SL_KEEPS_ONEWAYS, {"oneway"}},
    {"seams", "seam", SL_KEEPS_SEAMS, {"seam"}},
    {"range", "view range", SL_KEEPS_RANGE, {"range"}},
    {"starts", "start", SL_KEEPS_STARTS, {"start"}},
    {"paths", "path", SL_KEEPS_PATHS, {"path"}},
    {"objects", "object", SL_KEEPS_OBJECTS, {"object"}},
    {"cells", "cell", SL_KEEPS_CELLS, {"cell", "snap"}},
};
enum { COLUMNS = sizeof columns / sizeof *columns, WALLS = COLUMNS, BAKES, RESULTS };

/// How often something came back, was left out with a note, or neither.
typedef struct trips {
    size_t kept[RESULTS], told[RESULTS], lost[RESULTS];
} trips;

static bool has_any(const sl_map *map, const column *kind) {
    char *lines = things_of(map, kind->words);
    const bool any = *lines != '\0';
    free(lines);
    return any;
}

static bool same_bakes(sl_context *context, const sl_map *map, const sl_map *again) {
    sl_map copies[2] = {{.walls = NULL}, {.walls = NULL}};
    sl_baked baked[2] = {{.map = {.walls = NULL}}, {.map = {.walls = NULL}}};
    sl_status status[2];
    for (int i = 0; i < 2; i++) {
        assert_ok(context, sl_map_copy(context, i ? again : map, &copies[i]));
        status[i] = sl_bake(context, &copies[i], NULL, &baked[i], NULL);
    }
    const bool same = status[0] == status[1] &&
                      baked[0].space.cell_count == baked[1].space.cell_count &&
                      baked[0].space.portal_count == baked[1].space.portal_count &&
                      testing_same_rows(&baked[0].visibility.pvs, &baked[1].visibility.pvs);
    for (int i = 0; i < 2; i++) {
        sl_map_destroy(context, &copies[i]);
        sl_baked_destroy(context, &baked[i]);
    }
    return same;
}

static bool same_cleaned(sl_context *context, const sl_map *map, const sl_map *again) {
    static const char *const walls[] = {"wall", "solid", "open", NULL};
    sl_map copies[2] = {{.walls = NULL}, {.walls = NULL}};
    for (int i = 0; i < 2; i++) {
        assert_ok(context, sl_map_copy(context, i ? again : map, &copies[i]));
        if (sl_map_clean(context, &copies[i], NULL, NULL) == SL_OK) continue;
        sl_map_destroy(context, &copies[0]);
        sl_map_destroy(context, &copies[1]);
        return same_things(map, again, walls); // a map that cannot be cleaned
    }
    const bool same = same_things(&copies[0], &copies[1], walls);
    sl_map_destroy(context, &copies[0]);
    sl_map_destroy(context, &copies[1]);
    return same;
}

static void count(trips *all, size_t what, bool kept, bool told) {
    ++*(kept ? &all->kept[what] : told ? &all->told[what] : &all->lost[what]);
}

/// Leaves out what limits sight.
static void unlimit(sl_map *map) {
    size_t kept = 0;
    for (size_t i = 0; i < map->seam_count; i++) {
        sl_glass seam = map->seams[i];
        seam.stops &= SL_STOPS_ALL;
        if (seam.stops || !map->seams[i].stops) map->seams[kept++] = seam;
    }
    map->seam_count = kept;
}

/// What a format is to keep: without walls that do not stop sight, if it has no place for what
/// walls stop, and without what limits sight, if it has none for that.
static sl_map expected_of(sl_context *context, const sl_map *map, const sl_map_format *format) {
    sl_map expected = {.walls = NULL};
    assert_ok(context, sl_map_copy(context, map, &expected));
    for (size_t i = 0; strcmp(format->name, "text") != 0 && i < expected.door_count; i++)
        expected.doors[i].kind = SL_DOOR_PLAIN;
    if (!(format->keeps & SL_KEEPS_STOPS))
        assert_ok(context, sl_map_settle_stops(context, &expected, NULL));
    else if (!(format->keeps & SL_KEEPS_LIMITED))
        unlimit(&expected);
    return expected;
}

/// Writes a map, reads it back, and counts what came of it.
static void make_trip(const sl_map *whole, const sl_map_format *format, const char *folder,
                      bool bakes, trips *all) {
    notes kept = {{0}};
    sl_context *context = noting_context(&kept);
    char path[256];
    snprintf(path, sizeof path, "%s/trip%.*s", folder, (int)strcspn(format->endings, " "),
             format->endings);
    if (strcmp(format->name, "foundry") == 0) snprintf(path, sizeof path, "%s/trip.json", folder);
    assert_ok(context, sl_map_write(context, whole, format, path));
    const notes written = kept;
    const bool told = strstr(written.text, "what walls stop") != NULL;
    assert_int_equal(told, sl_map_partial_walls(whole) && !(format->keeps & SL_KEEPS_STOPS));
    bool kinds = false;
    for (size_t i = 0; i < whole->door_count; i++) kinds |= whole->doors[i].kind != SL_DOOR_PLAIN;
    assert_int_equal(strstr(written.text, "walls that break") != NULL,
                     kinds && format->keeps & SL_KEEPS_DOORS && strcmp(format->name, "text") != 0);
    sl_map expected = expected_of(context, whole, format);
    const sl_map *map = &expected;
    sl_map again = {0};
    const sl_import_options options = {.doors = format->takes & SL_TAKES_DOORS &&
                                                strcmp(format->name, "tmx") != 0};
    assert_ok(context, sl_map_read(context, path, &options, &again));
    bool holds_all = true;
    for (size_t i = 0; i < COLUMNS; i++) {
        if (!has_any(map, &columns[i])) continue;
        const bool promised = format->keeps & columns[i].keeps;
        const bool same = columns[i].keeps == SL_KEEPS_STARTS ? same_start_places(map, &again)
                          : columns[i].keeps == SL_KEEPS_SOLID
                              ? same_cleaned(context, map, &again)
                              : same_things(map, &again, columns[i].words);
        holds_all &= promised;
        count(all, i, promised && same, !promised && strstr(written.text, columns[i].note));
    }
    const bool solid = format->keeps & SL_KEEPS_SOLID;
    count(all, WALLS,
          solid ? same_cleaned(context, map, &again)
                : same_wall_sets(map, &again, !(format->keeps & SL_KEEPS_MIRRORS)),
          false);
    if (bakes && holds_all) count(all, BAKES, same_bakes(context, map, &again), false);
    sl_map_destroy(context, &again);
    sl_map_destroy(context, &expected);
    assert_int_equal(remove(path), 0);
    sl_context_destroy(context);
}

static void assert_nothing_lost(const trips *all, const char *format, const char *map) {
    for (size_t i = 0; i < RESULTS; i++)
        if (all->lost[i])
            fail_msg("%s, written as %s: %s", map, format,
                     i < COLUMNS  ? columns[i].name
                     : i == WALLS ? "walls"
                                  : "cells or pairs");
}

static char *make_folder(void) {
    char *folder = strdup("/tmp/sightline-write-XXXXXX");
    assert_true(folder && mkdtemp(folder));
    return folder;
}

/// Each format that is written, but ASCII plans, which refuse what they cannot hold.
static void make_all_trips(const sl_map *map, const char *name, bool bakes) {
    sl_context *context = noting_context(&(notes){{0}});
    char *folder = make_folder();
    size_t formats, written = 0;
    const sl_map_format *format = sl_map_formats(context, &formats);
    for (size_t i = 0; i < formats; i++) {
        if (!format[i].write || strcmp(format[i].name, "plan") == 0) continue;
        trips all = {.kept = {0}};
        make_trip(map, &format[i], folder, bakes, &all);
        assert_nothing_lost(&all, format[i].name, name);
        written++;
    }
    assert_int_equal(written, 6);
    assert_int_equal(rmdir(folder), 0);
    free(folder);
    sl_context_destroy(context);
}

// --- maps

static void visit_file(const char *path) {
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    map_files_read(context, path, &map);
    make_all_trips(&map, path, map.wall_count < 300);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void test_files(void **state) {
    (void)state;
    map_files_each(MAP_FILES_OWN | MAP_FILES_CASES, visit_file);
}

static void turn(sl_point *point) {
    const double c = cos(17.3 * 0.017453292519943295), s = sin(17.3 * 0.017453292519943295);
    *point = (sl_point){c * point->x - s * point->y, s * point->x + c * point->y};
}

/// Coordinates of all bits, on both sides of y 0. Solid ground is left out: its sides no longer
/// meet.
static void visit_turned(const char *path) {
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    map_files_read(context, path, &map);
    for (size_t i = 0; i < map.wall_count; i++) {
        turn(&map.walls[i].a);
        turn(&map.walls[i].b);
        map.walls[i].ground = 0;
    }
    for (size_t i = 0; i < map.door_count; i++) {
        turn(&map.doors[i].segment.a);
        turn(&map.doors[i].segment.b);
    }
    sl_glass *const glass[] = {map.mirrors, map.oneways, map.seams};
    const size_t counts[] = {map.mirror_count, map.oneway_count, map.seam_count};
    for (size_t k = 0; k < 3; k++)
        for (size_t i = 0; i < counts[k]; i++) {
            turn(&glass[k][i].segment.a);
            turn(&glass[k][i].segment.b);
        }
    for (size_t i = 0; i < map.start_count; i++) turn(&map.starts[i].at);
    sl_map_drop_cells(context, &map);
    map.snap = 0;
    make_all_trips(&map, path, map.wall_count < 60);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void test_turned(void **state) {
    (void)state;
    map_files_each(MAP_FILES_OWN, visit_turned);
}

static void read_statements(sl_context *context, const char *statements, sl_map *map) {
    char text[4096];
    snprintf(text, sizeof text, "sightline 1\n%s", statements);
    assert_ok(context, sli_map_read_text(context, "test", text, strlen(text), map));
}

/// One of each kind of thing; names that a format could take for something else.
static const char *const own_maps[] = {
    "range 7.5\nwalls -3 -4 20.1 -4 20.1 9.7 -3 9.7 -3 -4\nwall 1 1 2 1 solid\n"
    "solid 3 3 4 3 4 4 3 4\nsolid 5 5 8 5 8 8 5 8\nopen 6 6 7 6 7 7 6 7\n"
    "door a&b\"<c> 10 -4 10 9.7 open\ndoor door:2 12 -4 12 2 shut\ndoor sp-lit 14 0 14 1 shut\n"
    "door t\xc3\xbcr 13 0 13 1 open\ndoor sp-lit 14 2 14 3 shut\ndoor open-x 15 0 15 1 shut\n"
    "door Open-x 15 2 15 3 open\ndoor door1 16 0 16 1 open\n"
    "mirror 0 0 1 0 one\nmirror 0 2 1 2.3\noneway 2 0 3 0.1\nseam 4 0 5 0.7\n"
    "start 1 2 -90\nstart 0.3 0.1 17.3\nstart 18 -3 450\n"
    "path tour&<\"> 1 1 2 2 3 1\npath line 1 1 2 1\nobject box-1 1 1 2 2.5\n"
    "snap 0.25\ncell 0 0 1 0 1 1\ncell 1 0 2 0 2 1 1 1\ncell 3 0 3 0 4 0 4 1 4 1 3 1 3 0\n",
    "wall -1000000000000000 3 1000000000000000 3\nwall 0 -1e-7 1e-9 0.1\nstart 0 1 0\n",
    "walls 0 -100 50 -100 50 -60 0 -60 0 -100\nstart 1 -70.123456789012345 1e-5\n",
    "wall 0.1 0.2 0.3 0.7\nwall 1e20 1e20 2e20 3e20\nmirror 0.1 0.7 0.3 0.9\n",
    // Walls that do not stop all: plain, a closed outline, beside solid ground that is not closed,
    // and round open ground.
    "walls 0 0 20 0 20 9 0 9 0 0\nwall 1 1 2 1.3 stops sight\nwall 1 3 2 3 solid stops steps\n"
    "wall 2 3 2 4.7 solid stops steps\nwall 3 3 3 4 solid stops sight,sound\n"
    "solid 4 4 5 4 5 5 4 5 stops steps\nwall 6 6 6 8 solid stops steps\n"
    "wall 6 8 8 8 solid stops steps\nwall 8 8 8 6 solid stops steps\n"
    "wall 8 6 6 6 solid stops steps\nstart 10 4 0\n",
};

static void test_everything(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof own_maps / sizeof *own_maps; i++) {
        sl_context *context = testing_context(NULL);
        sl_map map = {0};
        read_statements(context, own_maps[i], &map);
        make_all_trips(&map, own_maps[i], false);
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
}

// --- the place and the exactness of what came from a file

/// A file that nobody has edited is as exact as the map was; one that somebody has edited is a
/// drawing like any other.
static void test_digits(void **state) {
    (void)state;
    static const struct {
        const char *ending, *behind, *from, *to;
    } cases[] = {{".svg", "<line", "4000", "4001"},
                 {".dxf", "LINE\n8", "4000", "4001"},
                 {".uvtt", "line_of_sight", "4000.0", "4001.0"}};
    sl_context *context = noting_context(&(notes){{0}});
    char *folder = make_folder(), path[128];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sl_map map = {0}, again = {0};
        const sl_map_format *format;
        sl_bytes bytes;
        // The shortest wall is longer than twice the tolerance that a drawing of whole numbers has.
        read_statements(context, "walls 0 0 9000 0 9000 4000 0 4000 0 0\nwall 100 100 102 100\n",
                        &map);
        snprintf(path, sizeof path, "%s/digits%s", folder, cases[i].ending);
        assert_ok(context, sl_map_format_to_write(context, "-o", path, NULL, &format));
        assert_ok(context, sl_map_write(context, &map, format, path));
        assert_ok(context, sl_map_read(context, path, NULL, &again));
        assert_true(again.precision == 0);
        sl_map_destroy(context, &again);
        assert_ok(context, sl_file_read(context, path, &bytes));
        char *place = strstr(strstr(bytes.data, cases[i].behind), cases[i].from);
        assert_non_null(place);
        memcpy(place, cases[i].to, strlen(cases[i].to));
        assert_ok(context, sl_map_parse(context, path, bytes.data, bytes.size, NULL, &again));
        assert_true(again.precision == 5);
        sl_map_destroy(context, &again);
        // What is rounded stays rounded.
        map.precision = 0.25;
        assert_ok(context, sl_map_write(context, &map, format, path));
        assert_ok(context, sl_map_read(context, path, NULL, &again));
        assert_true(again.precision == 0.25);
        sl_free(context, bytes.data);
        sl_map_destroy(context, &again);
        sl_map_destroy(context, &map);
        remove(path);
    }
    rmdir(folder);
    free(folder);
    sl_context_destroy(context);
}

/// Drawings come back to the place that they had in the file that they were read from.
static void test_places(void **state) {
    (void)state;
    static const struct {
        const char *name, *text, *expected[3];
    } cases[] = {
        {"a.svg",
         "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"10 20 300 200\">"
         "<line x1=\"30\" y1=\"50\" x2=\"60\" y2=\"70\"/></svg>",
         {"viewBox=\"10 20 300 200\"", "y1=\"50\"", "y2=\"70\""}},
        {"a.dd2vtt",
         "{\"resolution\":{\"map_origin\":{\"x\":2,\"y\":3},\"map_size\":{\"x\":20,\"y\":10},"
         "\"pixels_per_grid\":70},\"line_of_sight\":[[{\"x\":4,\"y\":5},{\"x\":6,\"y\":7.5}]]}",
         {"\"y\": 3.0", "\"y\": 5.0", "\"y\": 7.5"}},
        {"a.json",
         "{\"width\":4000,\"height\":3000,\"padding\":0,\"walls\":[{\"c\":[100,700,300,900],"
         "\"move\":20,\"sight\":20}],\"flags\":{\"sightline\":{\"y0\":2900}}}",
         {"\"height\": 3000.0", "700.0", "900.0"}},
        {"a.tmx",
         "<map width=\"20\" height=\"10\" tilewidth=\"16\" tileheight=\"16\"><objectgroup "
         "name=\"walls\"><object id=\"1\" x=\"8\" y=\"24\"><polyline points=\"0,0 5,6\"/></object>"
         "</objectgroup></map>",
         {"tileheight=\"32\"", "y=\"24\"", "points=\"0,0 5,6\""}},
    };
    sl_context *context = noting_context(&(notes){{0}});
    char *folder = make_folder(), path[128];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const bool json = strstr(cases[i].name, ".json");
        sl_map map = {0};
        const sl_map_format *format;
        sl_bytes bytes;
        assert_ok(context, sl_map_parse(context, cases[i].name, cases[i].text,
                                        strlen(cases[i].text), NULL, &map));
        snprintf(path, sizeof path, "%s/%s", folder, cases[i].name);
        assert_ok(context,
                  sl_map_format_to_write(context, "-o", path, json ? "foundry" : NULL, &format));
        assert_ok(context, sl_map_write(context, &map, format, path));
        assert_ok(context, sl_file_read(context, path, &bytes));
        for (size_t k = 0; k < 3; k++)
            if (!strstr(bytes.data, cases[i].expected[k]))
                fail_msg("%s: no %s in\n%s", cases[i].name, cases[i].expected[k], bytes.data);
        sl_free(context, bytes.data);
        sl_map_destroy(context, &map);
        remove(path);
    }
    rmdir(folder);
    free(folder);
    sl_context_destroy(context);
}

/// The unit of a drawing stays with it.
static void test_unit(void **state) {
    (void)state;
    static const char drawing[] = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n"
                                  "0\nSECTION\n2\nENTITIES\n0\nLINE\n8\nA\n10\n1000\n20\n0\n11\n"
                                  "2000\n21\n0\n0\nENDSEC\n0\nEOF\n";
    sl_context *context = noting_context(&(notes){{0}});
    char *folder = make_folder(), path[128];
    snprintf(path, sizeof path, "%s/a.dxf", folder);
    for (int i = 0; i < 2; i++) {
        sl_map map = {0}, again = {0};
        const sl_map_format *format;
        const sl_import_options turned = {.unit = "m"};
        assert_ok(context, sl_map_parse(context, "a.dxf", drawing, strlen(drawing),
                                        i ? &turned : NULL, &map));
        assert_ok(context, sl_map_format_to_write(context, "-o", path, NULL, &format));
        assert_ok(context, sl_map_write(context, &map, format, path));
        assert_ok(context, sl_map_read(context, path, &(sl_import_options){.unit = "mm"}, &again));
        assert_true(again.walls[0].b.x == 2000);
        sl_map_destroy(context, &again);
        sl_map_destroy(context, &map);
    }
    remove(path);
    rmdir(folder);
    free(folder);
    sl_context_destroy(context);
}

// --- drawings by hand

static void assert_text(const char *name, const char *text, const char *expected) {
    sl_context *context = noting_context(&(notes){{0}});
    sl_map map = {0};
    assert_ok(context, sl_map_parse(context, name, text, strlen(text), NULL, &map));
    char *found = map_text(&map);
    assert_string_equal(found, expected);
    free(found);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void assert_wrong(const char *name, const char *text, const char *message) {
    sl_context *context = noting_context(&(notes){{0}});
    sl_map map = {0};
    assert_int_equal(sl_map_parse(context, name, text, strlen(text), NULL, &map), SL_BAD_INPUT);
    if (!strstr(sl_context_message(context), message))
        fail_msg("'%s' has no '%s'", sl_context_message(context), message);
    assert_true(map_is_empty(&map));
    sl_context_destroy(context);
}

#define SVG(text)                                                                                  \
    "<svg xmlns=\"http://www.w3.org/2000/svg\" data-sightline-y0=\"0\">\n" text "\n</svg>"
#define DXF(text) "0\nSECTION\n2\nENTITIES\n" text "0\nENDSEC\n0\nEOF\n"

/// What people draw on such layers themselves: rectangles, curves, groups that are turned.
static void test_by_hand(void **state) {
    (void)state;
    assert_text("a.svg",
                SVG("<g id=\"layer3\" label=\"Sightline-Solid\"><rect x=\"1\" y=\"-3\" width=\"2\" "
                    "height=\"2\"/></g>\n<g id=\"sightline-door\" transform=\"rotate(-90)\">"
                    "<line x1=\"0\" y1=\"5\" x2=\"4\" y2=\"5\" data-open=\"false\"/></g>\n"
                    "<g id=\"sightline-start\" transform=\"rotate(-90)\">"
                    "<circle cx=\"1\" cy=\"2\" r=\"1\"/></g>"),
                "sightline 1\nsolid 1 1 3 1 3 3 1 3\ndoor door1 5 0 5 4 shut\nstart 2 1 90\n");
    assert_text("a.dxf",
                DXF("0\nLINE\n8\nSIGHTLINE-DOOR\n10\n1\n20\n0\n11\n1\n21\n4\n"
                    "0\nLINE\n8\nsightline-door-SHUT-front\n10\n2\n20\n0\n11\n2\n21\n4\n"
                    "0\nLINE\n8\nsightline-door-back\n10\n3\n20\n0\n11\n3\n21\n4\n"
                    "0\nLINE\n8\nsightline-walls\n10\n4\n20\n0\n11\n4\n21\n4\n"
                    "0\nPOINT\n8\nsightline-start\n10\n6\n20\n1\n"),
                "sightline 1\nwall 4 0 4 4\ndoor door1 1 0 1 4 open\ndoor front 2 0 2 4 shut\n"
                "door back 3 0 3 4 open\nstart 6 1 0\n");
    assert_wrong("a.svg", SVG("<g id=\"sightline-solid\">\n<polyline points=\"0,0 1,0 1,1\"/></g>"),
                 "a.svg:3: layer sightline-solid: expected a closed outline");
    assert_wrong("a.svg",
                 SVG("<g id=\"sightline-solid\">\n<polygon points=\"0,0 4,4 4,0 0,3\"/></g>"),
                 "a.svg:3: ");
    assert_wrong("a.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\" data-sightline-range=\"0\"/>",
                 "data-sightline-range");
    assert_wrong("a.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\" data-sightline-y0=\"4m\"/>",
                 "data-sightline-y0");
    assert_wrong("a.dxf", DXF("0\nLINE\n8\nsightline-solid\n10\n1\n20\n0\n11\n1\n21\n4\n"),
                 "a.dxf:6: layer sightline-solid");
}

/// A door that somebody adds does not take the name of one that is there.
static void test_added_doors(void **state) {
    (void)state;
    static const char text[] =
        "{\"resolution\":{\"map_size\":{\"x\":9,\"y\":0}},\"line_of_sight\":[],\"portals\":["
        "{\"bounds\":[{\"x\":0,\"y\":0},{\"x\":1,\"y\":0}]},"
        "{\"bounds\":[{\"x\":2,\"y\":0},{\"x\":3,\"y\":0}],\"sightline\":{\"name\":\"door1\"}},"
        "{\"bounds\":[{\"x\":4,\"y\":0},{\"x\":5,\"y\":0}]}]}";
    sl_context *context = noting_context(&(notes){{0}});
    sl_map map = {0};
    const sl_import_options options = {.doors = true};
    assert_ok(context, sl_map_parse(context, "a.uvtt", text, strlen(text), &options, &map));
    assert_int_equal(map.door_count, 3);
    assert_string_equal(map.doors[0].name, "door2");
    assert_string_equal(map.doors[1].name, "door1");
    assert_string_equal(map.doors[2].name, "door3");
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

// --- which format

static void test_choice(void **state) {
    (void)state;
    static const struct {
        const char *path, *name, *found, *message;
    } cases[] = {
        {"-", NULL, "text", NULL},
        {"-", "svg", "svg", NULL},
        {"a.MAP", NULL, "text", NULL},
        {"a.txt", NULL, "plan", NULL},
        {"a.uvtt", NULL, "uvtt", NULL},
        {"a.df2vtt", "uvtt", "uvtt", NULL},
        {"a.json", "foundry", "foundry", NULL},
        {"a.json", "uvtt", "uvtt", NULL},
        {"a.json", NULL, NULL,
         "several formats have this ending; choose one by --format: uvtt or "
         "foundry"},
        {"a.json", "svg", NULL, "-o a.json: end the name in .svg"},
        {"a.wad", NULL, NULL, "end the name in .map, .txt, .dxf, .svg, .tmx, .dd2vtt"},
        {"a", NULL, NULL, "end the name in .map"},
        {"a.wad", "wad", NULL,
         "no map is written as 'wad': choose text, plan, dxf, svg, tmx, "
         "uvtt or foundry"},
    };
    sl_context *context = noting_context(&(notes){{0}});
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const sl_map_format *format = NULL;
        const sl_status status =
            sl_map_format_to_write(context, "-o", cases[i].path, cases[i].name, &format);
        assert_int_equal(status, cases[i].found ? SL_OK : SL_BAD_ARGUMENT);
        if (cases[i].found)
            assert_string_equal(format->name, cases[i].found);
        else if (!strstr(sl_context_message(context), cases[i].message))
            fail_msg("'%s' has no '%s'", sl_context_message(context), cases[i].message);
    }
    sl_context_destroy(context);
}

/// A name that a file could not hold is refused, and an older file stays as it is.
static void test_names_refused(void **state) {
    (void)state;
    static const char *const names[] = {"svg", "tmx"};
    static const char *const things[] = {"door \xef\xbf\xbf 0 0 1 0", "path a\xef\xbf\xbe 0 0 1 0",
                                         "object \xef\xbf\xbf 0 0 1 1"};
    sl_context *context = noting_context(&(notes){{0}});
    char *folder = make_folder(), path[128];
    for (size_t i = 0; i < 6; i++) {
        const sl_map_format *format = NULL;
        sl_map map = {0};
        sl_bytes bytes;
        snprintf(path, sizeof path, "%s/a.%s", folder, names[i % 2]);
        FILE *older = fopen(path, "w");
        assert_non_null(older);
        assert_true(fputs("older", older) >= 0);
        assert_int_equal(fclose(older), 0);
        read_statements(context, things[i / 2], &map);
        assert_ok(context, sl_map_format_to_write(context, "-o", path, NULL, &format));
        assert_int_equal(sl_map_write(context, &map, format, path), SL_UNSUPPORTED);
        assert_non_null(strstr(sl_context_message(context), "2: a name has the character U+FFF"));
        assert_ok(context, sl_file_read(context, path, &bytes));
        assert_string_equal(bytes.data, "older");
        sl_free(context, bytes.data);
        sl_map_destroy(context, &map);
        remove(path);
    }
    assert_int_equal(rmdir(folder), 0);
    free(folder);
    sl_context_destroy(context);
}

/// Lack of memory, wherever it strikes, leaves no file and no memory behind.
static void test_memory(void **state) {
    (void)state;
    size_t formats;
    sl_context *plain = noting_context(&(notes){{0}});
    const sl_map_format *format = sl_map_formats(plain, &formats);
    char *folder = make_folder(), path[128];
    sl_map map = {0};
    read_statements(
        plain, "solid 0 0 9 0 9 9 0 9\nopen 1 1 8 1 8 8 1 8\ndoor a 1 4 8 4\nwall 3 3 4 5\n", &map);
    for (size_t i = 0; i < formats; i++) {
        if (!format[i].write || strcmp(format[i].name, "plan") == 0) continue;
        snprintf(path, sizeof path, "%s/a%.*s", folder, (int)strcspn(format[i].endings, " "),
                 format[i].endings);
        sl_status status = SL_NO_MEMORY;
        for (long at = 1; status == SL_NO_MEMORY; at++) {
            testing_memory memory = {0};
            sl_context *context = testing_context(&memory);
            const long live = memory.live;
            memory.fail_at = memory.calls + at;
            status = sl_map_write(context, &map, &format[i], path);
            assert_int_equal(memory.live, live);
            assert_int_equal(access(path, F_OK) == 0, status == SL_OK);
            sl_context_destroy(context);
        }
        assert_int_equal(status, SL_OK);
        remove(path);
    }
    sl_map_destroy(plain, &map);
    rmdir(folder);
    free(folder);
    sl_context_destroy(plain);
}

// --- the table

static trips table[32];
static const char *folder_of_table;

static void add_map(const sl_map *map) {
    sl_context *context = noting_context(&(notes){{0}});
    size_t formats;
    const sl_map_format *format = sl_map_formats(context, &formats);
    for (size_t i = 0; i < formats && i < 32; i++)
        if (format[i].write && strcmp(format[i].name, "plan") != 0)
            make_trip(map, &format[i], folder_of_table, map->wall_count < 2000, &table[i]);
    sl_context_destroy(context);
}

static void add_to_table(const char *path) {
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_import_options options = sl_import_options_default();
    options.has_slice = strstr(path, ".ug") != NULL;
    options.slice = 1040;
    options.doors = strstr(path, "vtt") != NULL;
    if (strstr(path, ".ldtk")) options.map = "all";
    assert_ok(context, sl_io_use(context));
    assert_ok(context, sl_map_read(context, path, &options, &map));
    add_map(&map);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void print_result(const trips *all, size_t what) {
    printf(" |");
    if (all->kept[what]) printf(" %zu kept", all->kept[what]);
    if (all->told[what]) printf(" %zu left out, said so", all->told[what]);
    if (all->lost[what]) printf(" %zu LOST", all->lost[what]);
}

static int print_table(int count, char **paths) {
    sl_context *context = noting_context(&(notes){{0}});
    char *folder = make_folder();
    size_t formats, lost = 0;
    folder_of_table = folder;
    map_files_each(MAP_FILES_OWN | MAP_FILES_CASES, add_to_table);
    for (int i = 0; i < count; i++) add_to_table(paths[i]);
    for (size_t i = 0; i < sizeof own_maps / sizeof *own_maps; i++) {
        sl_map map = {0};
        read_statements(context, own_maps[i], &map);
        add_map(&map);
        sl_map_destroy(context, &map);
    }
    const sl_map_format *format = sl_map_formats(context, &formats);
    printf("| format | walls");
    for (size_t k = 0; k < COLUMNS; k++) printf(" | %s", columns[k].name);
    printf(" | same cells and pairs |\n|");
    for (size_t k = 0; k < COLUMNS + 3; k++) printf(" --- |");
    for (size_t i = 0; i < formats && i < 32; i++) {
        if (!format[i].write || strcmp(format[i].name, "plan") == 0) continue;
        printf("\n| %s", format[i].name);
        print_result(&table[i], WALLS);
        for (size_t k = 0; k < COLUMNS; k++) print_result(&table[i], k);
        print_result(&table[i], BAKES);
        printf(" |");
        for (size_t k = 0; k < RESULTS; k++) lost += table[i].lost[k];
    }
    printf("\n");
    rmdir(folder);
    free(folder);
    sl_context_destroy(context);
    return lost ? 1 : 0;
}

int main(int argc, char **argv) {
    if (argc > 1 && strcmp(argv[1], "--table") == 0) return print_table(argc - 2, argv + 2);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_files),         cmocka_unit_test(test_turned),
        cmocka_unit_test(test_everything),    cmocka_unit_test(test_digits),
        cmocka_unit_test(test_places),        cmocka_unit_test(test_unit),
        cmocka_unit_test(test_by_hand),       cmocka_unit_test(test_added_doors),
        cmocka_unit_test(test_names_refused), cmocka_unit_test(test_choice),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

// A REJECT hides nothing that a free sightline joins: random Doom maps of squares, in which sectors
// meet at walls, at lines that are seen through, and, being one sector, at nothing. And the copy of
// the WAD that it goes into is otherwise the same.
#include "testing.h"

#include "io/io_formats.h"
#include "oracle/sectors.h"
#include "sightline/io.h"
#include "sightline/support.h"
#include "space/subdivide.h"
#include "wad_make.h"

#include <unistd.h>

enum { SIDE = 5, SQUARES = SIDE * SIDE, STEP = 64 };
enum { CORNERS = (SIDE + 1) * (SIDE + 1), LINES = 8 * SQUARES + 4 * SIDE };
enum { SECTORS = 2 * SQUARES, REJECT_BYTES = (SECTORS * SECTORS + 7) / 8 };

/// A map of squares being made.
typedef struct squares_map {
    int vertices[CORNERS + 4 * SQUARES][2];
    int lines[LINES][7];
    int sides[2 * LINES][1];
    int sectors[SECTORS][4];
    size_t line_count, side_count;
} squares_map;

static int vertex_at(int x, int y) {
    return y * (SIDE + 1) + x;
}

static int side_of(squares_map *map, int sector) {
    if (sector < 0) return 0xffff;
    map->sides[map->side_count][0] = sector;
    return (int)map->side_count++;
}

/// A line with a sector at its right, and one at its left unless that is negative.
static void add_line(squares_map *map, int from, int to, int right, int left) {
    const int line[7] = {from, to, left < 0 ? 1 : 4, 0, 0, side_of(map, right), side_of(map, left)};
    memcpy(map->lines[map->line_count++], line, sizeof line);
}

/// Between two squares, `right` being at the right from one vertex to the other: a wall of two
/// lines back to back, a line that is seen through, or nothing within one sector.
static void part(squares_map *map, sl_random *random, int from, int to, int right, int left) {
    if (right < 0 || left < 0) {
        if (right >= 0) add_line(map, from, to, right, -1);
        if (left >= 0) add_line(map, to, from, left, -1);
    } else if (sl_random_below(random, 100) < 45) {
        add_line(map, from, to, right, -1);
        add_line(map, to, from, left, -1);
    } else if (right != left) {
        add_line(map, from, to, right, left);
    }
}

/// A step in a square, seen through all around. Far steps may be one sector.
static void add_step(squares_map *map, int square, int around) {
    static const int places[4][2] = {{4, 4}, {4, 24}, {24, 24}, {24, 4}};
    const int first = CORNERS + 4 * square, moved = square % 2 ? 20 : 0;
    for (int i = 0; i < 4; i++) {
        map->vertices[first + i][0] = square % SIDE * STEP + moved + places[i][0];
        map->vertices[first + i][1] = square / SIDE * STEP + moved + places[i][1];
        add_line(map, first + i, first + (i + 1) % 4, SQUARES + square % 9, around);
    }
}

static void make_squares(squares_map *map, sl_random *random) {
    int sector[SIDE + 2][SIDE + 2];
    memset(map, 0, sizeof *map);
    memset(sector, -1, sizeof sector);
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            const bool joined = x > 0 && sl_random_below(random, 100) < 30;
            sector[y + 1][x + 1] = joined ? sector[y + 1][x] : y * SIDE + x;
        }
    for (int i = 0; i < SECTORS; i++) map->sectors[i][1] = 128;
    for (int i = 0; i < SQUARES; i++)
        if (sl_random_below(random, 100) < 40) add_step(map, i, sector[i / SIDE + 1][i % SIDE + 1]);
    for (int y = 0; y <= SIDE; y++)
        for (int x = 0; x <= SIDE; x++) {
            map->vertices[vertex_at(x, y)][0] = x * STEP;
            map->vertices[vertex_at(x, y)][1] = y * STEP;
            if (x < SIDE)
                part(map, random, vertex_at(x, y), vertex_at(x + 1, y), sector[y][x + 1],
                     sector[y + 1][x + 1]);
            if (y < SIDE)
                part(map, random, vertex_at(x, y), vertex_at(x, y + 1), sector[y + 1][x + 1],
                     sector[y + 1][x]);
        }
}

static void make_wad(const squares_map *map, wad_made *wad, bool with_reject) {
    static const size_t vertex[] = {0, 2}, line[] = {0, 2, 4, 6, 8, 10, 12}, side[] = {28},
                        sector[] = {0, 2, 22, 24};
    wad_begin(wad);
    wad_text(wad, "BEFORE", "kept");
    wad_lump(wad, "MAP01", NULL, 0);
    wad_lump(wad, "THINGS", NULL, 0);
    wad_records(wad, "LINEDEFS", 14, 7, line, (const int *)map->lines, map->line_count);
    wad_records(wad, "SIDEDEFS", 30, 1, side, (const int *)map->sides, map->side_count);
    wad_records(wad, "VERTEXES", 4, 2, vertex, WAD_ROWS(map->vertices));
    wad_records(wad, "SECTORS", 26, 4, sector, WAD_ROWS(map->sectors));
    const unsigned char old[REJECT_BYTES] = {0xff};
    if (with_reject) wad_lump(wad, "REJECT", old, sizeof old);
    wad_text(wad, "BLOCKMAP", "any");
    wad_text(wad, "BEHIND", "kept too");
    wad_end(wad);
}

static void write_file(const char *path, const void *bytes, size_t size) {
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static void bake_map(sl_context *context, const wad_made *wad, sl_baked *baked) {
    const sl_import_options options = sl_import_options_default();
    const sl_subdivide_options rules = sl_subdivide_options_default();
    sl_map map = {0};
    assert_ok(context,
              sli_map_read_wad(context, "in.wad", (char *)wad->bytes, wad->size, &options, &map));
    assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
    assert_ok(context, sli_subdivide_kd(context, &map, &rules, &baked->space));
    sl_map_destroy(context, &map);
    size_t methods;
    sl_see_options see = sl_see_options_default();
    see.solver = sl_funnel();
    assert_ok(context,
              sl_see_methods(&methods)->see(context, &baked->space, &see, &baked->visibility));
    strcpy(baked->method, "dfs");
}

/// The first lump of a name in a WAD.
static sli_lump lump_of(sl_context *context, const sl_bytes *bytes, const char *name) {
    sli_wad wad;
    sli_lump lump = {0};
    assert_ok(context, sli_wad_open(context, "out.wad", bytes->data, bytes->size, &wad));
    for (uint32_t i = 0; i < wad.lump_count; i++) {
        char own[SLI_LUMP_NAME];
        sli_wad_lump_name(&wad, i, own);
        if (strcmp(own, name) != 0) continue;
        assert_ok(context, sli_wad_lump(context, &wad, i, &lump));
        break;
    }
    return lump;
}

static sl_point random_point(sl_random *random) {
    return (sl_point){sl_random_unit(random) * SIDE * STEP, sl_random_unit(random) * SIDE * STEP};
}

/// Looks for a hidden pair that a free sightline joins; gives how many pairs are hidden.
static size_t check_reject(sl_context *context, const wad_made *made, const sli_lump *reject,
                           sl_random *random) {
    sli_wad wad;
    sli_wad_map map;
    sli_doom_level level = {0};
    sl_segment walls[LINES];
    size_t wall_count = 0, hidden = 0;
    assert_ok(context, sli_wad_open(context, "in.wad", made->bytes, made->size, &wad));
    assert_ok(context, sli_wad_find_map(context, &wad, NULL, &map));
    assert_ok(context, sli_doom_read(context, &wad, &map, &level));
    for (size_t i = 0; i < level.line_count; i++)
        if (level.lines[i].left == SLI_NO_SECTOR)
            walls[wall_count++] = (sl_segment){level.lines[i].from, level.lines[i].to};
    blockers *blocking = blockers_create(walls, wall_count);
    sector_finder *where = sector_finder_create(&level);
    assert_int_equal(reject->size, REJECT_BYTES);
    for (int i = 0; i < 3000; i++) {
        const sl_segment s = {random_point(random), random_point(random)};
        if (!blockers_free(blocking, s)) continue;
        const uint32_t a = sectors_at(where, s.a), b = sectors_at(where, s.b);
        assert_true(a != SLI_NO_SECTOR && b != SLI_NO_SECTOR);
        if (sectors_rejected(reject, SECTORS, a, b) || sectors_rejected(reject, SECTORS, b, a))
            fail_msg("%g,%g in %u sees %g,%g in %u", s.a.x, s.a.y, a, s.b.x, s.b.y, b);
    }
    for (uint32_t a = 0; a < SECTORS; a++)
        for (uint32_t b = 0; b < SECTORS; b++) hidden += sectors_rejected(reject, SECTORS, a, b);
    sector_finder_destroy(where);
    blockers_destroy(blocking);
    sli_doom_level_destroy(context, &level);
    return hidden;
}

static void hides_nothing_that_is_seen(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    char folder[] = "/tmp/sightline-reject-XXXXXX", in[100], out[100];
    assert_non_null(mkdtemp(folder));
    snprintf(in, sizeof in, "%s/in.wad", folder);
    snprintf(out, sizeof out, "%s/out.wad", folder);
    const sl_export_options options = {.wad = in, .map = "map01"};
    sl_random random = {.state = 7};
    size_t hidden = 0;
    for (int round = 0; round < 40; round++) {
        squares_map map;
        wad_made wad;
        sl_baked baked = {0};
        sl_bytes written;
        make_squares(&map, &random);
        make_wad(&map, &wad, round % 2);
        write_file(in, wad.bytes, wad.size);
        bake_map(context, &wad, &baked);
        assert_ok(context, sli_export_reject(context, &baked, &options, out));
        assert_ok(context, sl_file_read(context, out, &written));
        const sli_lump reject = lump_of(context, &written, "REJECT");
        hidden += check_reject(context, &wad, &reject, &random);
        // With a REJECT of the same size nothing else is touched.
        const sli_lump old = lump_of(context, &(sl_bytes){(char *)wad.bytes, wad.size}, "REJECT");
        if (round % 2) {
            assert_int_equal(written.size, wad.size);
            memcpy((unsigned char *)written.data + (old.bytes - wad.bytes), old.bytes, old.size);
            assert_memory_equal(written.data, wad.bytes, wad.size);
        } else {
            assert_int_equal(written.size, wad.size + 16 + reject.size);
            static const char *const kept[] = {"BEFORE", "LINEDEFS", "SECTORS", "BLOCKMAP",
                                               "BEHIND"};
            for (size_t i = 0; i < sizeof kept / sizeof *kept; i++) {
                const sli_lump a = lump_of(context, &written, kept[i]);
                const sli_lump b =
                    lump_of(context, &(sl_bytes){(char *)wad.bytes, wad.size}, kept[i]);
                assert_int_equal(a.size, b.size);
                assert_memory_equal(a.bytes, b.bytes, a.size);
            }
        }
        sl_free(context, written.data);
        sl_baked_destroy(context, &baked);
        free(wad.bytes);
    }
    // It is no REJECT of zeros.
    assert_true(hidden > 40 * SQUARES * SQUARES / 5);
    remove(in);
    remove(out);
    remove(folder);
    sl_context_destroy(context);
}

/// Three sectors side by side, and boxes of walls that no line of the level touches: what is within
/// them is known by the nearest line alone, however far away that is.
static void the_nearest_line_may_be_far(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sli_doom_line lines[] = {{{0, 0}, {0, 1024}, .right = 0, .left = SLI_NO_SECTOR},
                             {{100, 0}, {100, 1024}, .right = 1, .left = 0},
                             {{900, 0}, {900, 1024}, .right = 2, .left = 1},
                             {{1024, 0}, {1024, 1024}, .right = SLI_NO_SECTOR, .left = 2}};
    const sli_doom_level level = {.lines = lines, .line_count = 4, .sector_count = 3};
    sl_map map = {0};
    sl_space space = {0};
    sli_cell_sectors found = {0};
    testing_space(context,
                  "walls 0 0 1024 0 1024 1024 0 1024 0 0\nwall 100 0 100 1024\n"
                  "wall 900 0 900 1024\nwalls 102 50 106 50 106 54 102 54 102 50\n"
                  "walls 400 500 500 500 500 600 400 600 400 500\n"
                  "walls 880 700 890 700 890 710 880 710 880 700\n",
                  &map, &space);
    assert_ok(context, sli_cell_sectors_find(context, &space, &level, &found));
    for (uint32_t cell = 0; cell < space.cell_count; cell++) {
        const sl_point corner = space.vertices[space.cells[cell].first_vertex];
        const sl_point opposite = space.vertices[space.cells[cell].first_vertex + 2];
        const double x = (corner.x + opposite.x) / 2;
        assert_int_equal(found.first[cell + 1] - found.first[cell], 1);
        assert_int_equal(found.sectors[found.first[cell]], (x > 100) + (x > 900));
    }
    assert_true(space.cell_count > 10);
    sli_cell_sectors_destroy(context, &found);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void refuses_what_it_cannot_promise(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    char folder[] = "/tmp/sightline-reject-XXXXXX", in[100];
    assert_non_null(mkdtemp(folder));
    snprintf(in, sizeof in, "%s/in.wad", folder);
    sl_random random = {.state = 1};
    squares_map map;
    wad_made wad;
    sl_baked baked = {0};
    make_squares(&map, &random);
    make_wad(&map, &wad, true);
    bake_map(context, &wad, &baked);
    write_file(in, wad.bytes, wad.size);
    const sl_export_options good = {.wad = in, .map = "MAP01"};
    const sl_export_options no_map = {.wad = in}, other_map = {.wad = in, .map = "MAP02"};
    assert_ok(context, sli_export_reject(context, &baked, &good, "/dev/null"));
    assert_int_equal(sli_export_reject(context, &baked, &no_map, "/dev/null"), SL_BAD_ARGUMENT);
    assert_int_equal(sli_export_reject(context, &baked, &other_map, "/dev/null"), SL_BAD_INPUT);
    baked.visibility.guarantee = SL_AGGRESSIVE;
    assert_int_equal(sli_export_reject(context, &baked, &good, "/dev/null"), SL_BAD_ARGUMENT);
    baked.visibility.guarantee = SL_EXACT;
    baked.space.walls[0].a.x += 1;
    assert_int_equal(sli_export_reject(context, &baked, &good, "/dev/null"), SL_BAD_INPUT);
    assert_non_null(strstr(sl_context_message(context), "has other walls than the baked file"));
    baked.space.walls[0].a.x -= 1;
    const sl_segment door = {{0, 0}, {0, 1}};
    assert_ok(context, sl_map_add_door(context, &baked.map, "door", door, true, 0));
    assert_int_equal(sli_export_reject(context, &baked, &good, "/dev/null"), SL_BAD_ARGUMENT);
    sl_baked_destroy(context, &baked);
    free(wad.bytes);
    remove(in);
    remove(folder);
    sl_context_destroy(context);
}

/// Every allocation that fails is told: nothing
/// is written and nothing left behind.
static void survives_a_lack_of_memory(void **state) {
    (void)state;
    char folder[] = "/tmp/sightline-reject-XXXXXX", in[100], out[100];
    assert_non_null(mkdtemp(folder));
    snprintf(in, sizeof in, "%s/in.wad", folder);
    snprintf(out, sizeof out, "%s/out.wad", folder);
    sl_random random = {.state = 3};
    squares_map map;
    wad_made wad;
    make_squares(&map, &random);
    make_wad(&map, &wad, false);
    write_file(in, wad.bytes, wad.size);
    sl_reject_options options = sl_reject_options_default();
    options.threads = 1;
    sl_status status = SL_NO_MEMORY;
    long calls = 0;
    for (long fail_at = 1; status != SL_OK; fail_at += 1 + fail_at / 16) {
        testing_memory memory = {.fail_at = fail_at + 1};
        sl_context *context = testing_context(&memory);
        sl_reject_report report = {0};
        status = sl_reject_wad(context, in, &options, out, &report);
        assert_int_equal(access(out, F_OK) != 0, status != SL_OK);
        if (status != SL_OK) assert_int_equal(status, SL_NO_MEMORY);
        if (status != SL_OK) assert_null(report.maps);
        if (status == SL_OK) assert_int_equal(report.maps[0].sectors, SECTORS);
        sl_reject_report_destroy(context, &report);
        sl_context_destroy(context);
        assert_int_equal(memory.live, 0);
        calls = memory.calls;
    }
    assert_true(calls > 50);
    free(wad.bytes);
    remove(in);
    remove(out);
    remove(folder);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hides_nothing_that_is_seen),
        cmocka_unit_test(the_nearest_line_may_be_far),
        cmocka_unit_test(refuses_what_it_cannot_promise),
        cmocka_unit_test(survives_a_lack_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

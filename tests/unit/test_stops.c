/// Walls that stop only some of sight, steps and sound: as text, in spaces, in baked files.
#include "testing.h"

#include "oracle/oracle.h"
#include "oracle/random_map.h"
#include "slv_file.h"

#include <math.h>

static const uint32_t channels[] = {SL_STOPS_SIGHT, SL_STOPS_STEPS, SL_STOPS_SOUND};

static sl_status read_map(sl_context *context, const char *statements, sl_map *map) {
    char text[4096];
    snprintf(text, sizeof text, "sightline 1\n%s", statements);
    return sl_map_parse(context, "test.map", text, strlen(text), NULL, map);
}

/// Bakes the text for a channel.
static sl_baked bake(sl_context *context, const char *statements, uint32_t channel) {
    sl_map map = {0};
    sl_baked baked = {0};
    assert_ok(context, read_map(context, statements, &map));
    map.channel = channel;
    assert_ok(context, sl_bake(context, &map, NULL, &baked, NULL));
    assert_ok(context, sl_space_check(context, &baked.space));
    return baked;
}

// --- text

static void walls_of_no_length_are_dropped(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    assert_ok(context, read_map(context,
                                "wall 1 1 1 1 stops sight\n"
                                "solid 9 3 9 3 11 3 11 5 stops steps\n",
                                &map));
    assert_int_equal(map.seam_count, 3);
    assert_int_equal(map.wall_count, 0);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void words_are_read_and_written(void **state) {
    (void)state;
    char text[SL_STOPS_TEXT];
    uint32_t stops;
    for (uint32_t i = 1; i <= SL_STOPS_ALL; i++) {
        sl_stops_write(i, text);
        assert_true(sl_stops_read(text, strlen(text), &stops));
        assert_int_equal(stops, i);
    }
    for (uint32_t i = SL_STOPS_LIMITED; i < 2 * SL_STOPS_LIMITED; i += 2) {
        sl_stops_write(i, text);
        assert_true(sl_stops_read(text, strlen(text), &stops));
        assert_int_equal(stops, i);
    }
    assert_true(sl_stops_read("sound,sight", 11, &stops));
    assert_int_equal(stops, SL_STOPS_SOUND | SL_STOPS_SIGHT);
    static const char *const wrong[] = {"",
                                        ",",
                                        "sight,",
                                        ",sight",
                                        "sights",
                                        "sight,,steps",
                                        "steps,steps",
                                        "Sight",
                                        "all",
                                        "sight,limited",
                                        "limited,sight",
                                        "limited,limited"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_false(sl_stops_read(wrong[i], strlen(wrong[i]), &stops));
}

static void wrong_statements_name_their_line(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    static const char *const wrong[] = {
        "wall 0 0 1 1 stops",         "wall 0 0 1 1 stops sigth",
        "walls 0 0 1 stops steps 1",  "wall 0 0 1 1 stops sight solid",
        "door d 0 0 1 1 stops sight", "open 0 0 1 0 1 1 stops sight"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        sl_map map = {0};
        assert_int_equal(read_map(context, wrong[i], &map), SL_BAD_INPUT);
        assert_non_null(strstr(sl_context_message(context), "test.map:2: "));
    }
    sl_context_destroy(context);
}

/// Map text of a map, for free().
static char *text_of(sl_context *context, const sl_map *map) {
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    assert_non_null(stream);
    assert_ok(context, sli_map_print_text(context, map, stream));
    fclose(stream);
    return text;
}

static void text_is_kept(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0}, again = {0};
    assert_ok(context, read_map(context,
                                "wall 0 0 9 0\nwall 0 0 0 9 solid\nwalls 1 1 2 1 2 2 stops sight\n"
                                "wall 3 1 4 1 solid stops steps,sound # a step\n"
                                "solid 5 5 6 5 6 6 stops steps\nseam 1 8 2 8\n"
                                "wall 7 7 8 8 stops sound,steps,sight\n"
                                "wall 2 8 2 9 stops limited\nwall 3 8 3 9 stops limited,steps\n",
                                &map));
    assert_int_equal(map.wall_count, 3);
    assert_int_equal(map.seam_count, 9);
    char *text = text_of(context, &map);
    assert_non_null(strstr(text, "wall 2 1 2 2 stops sight\n"));
    assert_non_null(strstr(text, "wall 3 1 4 1 solid stops steps,sound # a step\n"));
    assert_non_null(strstr(text, "solid 5 5 6 5 6 6 stops steps\n"));
    assert_non_null(strstr(text, "wall 7 7 8 8\n"));
    assert_non_null(strstr(text, "wall 2 8 2 9 stops limited\n"));
    assert_non_null(strstr(text, "wall 3 8 3 9 stops steps,limited\n"));
    assert_non_null(strstr(text, "\nseam 1 8 2 8\n"));
    assert_ok(context, sl_map_parse(context, "t", text, strlen(text), NULL, &again));
    char *twice = text_of(context, &again);
    assert_string_equal(text, twice);
    free(text);
    free(twice);
    sl_map_destroy(context, &again);
    assert_ok(context, sl_map_copy(context, &map, &again));
    assert_int_equal(again.seams[0].stops, SL_STOPS_SIGHT);
    sl_map_destroy(context, &map);
    sl_map_destroy(context, &again);
    sl_context_destroy(context);
}

// --- against the oracles

/// Random stops for the walls of a map, most of which stop all.
static void limit_walls(sl_context *context, uint64_t seed, sl_map *map, uint32_t *stops) {
    sl_random random = {seed ^ 0x5709};
    const size_t count = map->wall_count;
    sl_wall *walls = malloc(count * sizeof *walls);
    assert_non_null(walls);
    memcpy(walls, map->walls, count * sizeof *walls);
    map->wall_count = 0;
    for (size_t i = 0; i < count; i++) {
        const uint32_t some = 1 + (uint32_t)sl_random_below(&random, 6);
        stops[i] = sl_random_below(&random, 2) ? SL_STOPS_ALL : some;
        const size_t first = map->wall_count;
        assert_ok(context, sl_map_add_wall(context, map, walls[i].a, walls[i].b, 0));
        assert_ok(context, sl_map_walls_stop(context, map, first, stops[i]));
    }
    free(walls);
}

static void assert_rows(const sl_baked *baked, const bool *sees, uint64_t seed, const char *what) {
    const uint32_t cells = baked->space.cell_count;
    for (uint32_t i = 0; i < cells; i++)
        for (uint32_t k = 0; k < cells; k++)
            if (sl_pvs_sees(&baked->visibility.pvs, i, k) != sees[i * (size_t)cells + k])
                fail_msg("seed %llu, %s: cells %u and %u", (unsigned long long)seed, what, i, k);
}

/// Exact rows on random axial maps that cross, touch and overlap: open sight by lines cut at the
/// walls as read, closed sight by portal sequences.
static void rows_are_those_without_the_other_walls(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    size_t by_lines = 0, by_sequences = 0, passages = 0;
    for (uint64_t seed = 1; seed <= testing_seeds(400); seed++) {
        sl_map raw = {0}, map = {0};
        sl_baked baked = {0};
        uint32_t stops[64];
        const uint32_t channel = channels[seed % 3];
        assert_ok(context, oracle_random_map(context, seed, (oracle_grid)(seed % 2), &raw));
        assert_ok(context, sl_map_copy(context, &raw, &map));
        limit_walls(context, seed, &map, stops);
        size_t count = 0;
        for (size_t i = 0; i < raw.wall_count; i++)
            if (stops[i] & channel) raw.walls[count++] = raw.walls[i];
        map.channel = channel;
        sl_bake_options options = sl_bake_options_default();
        options.see.sight = seed / 3 % 2 ? SL_OPEN : SL_CLOSED;
        assert_ok(context, sl_bake(context, &map, &options, &baked, NULL));
        assert_ok(context, sl_space_check(context, &baked.space));
        const size_t pairs = (size_t)baked.space.cell_count * baked.space.cell_count;
        bool *closed = calloc(pairs, 1), *open = calloc(pairs, 1);
        assert_true(closed && open);
        const char *reason;
        if (options.see.sight == SL_OPEN &&
            oracle_by_lines(&baked.space, raw.walls, count, open, &reason)) {
            assert_rows(&baked, open, seed, "by lines");
            by_lines++;
        } else if (options.see.sight == SL_CLOSED &&
                   oracle_by_sequences(&baked.space, 20000, closed, open)) {
            assert_rows(&baked, closed, seed, "by sequences");
            by_sequences++;
        }
        passages += baked.space.passage_count;
        free(closed);
        free(open);
        sl_baked_destroy(context, &baked);
        sl_map_destroy(context, &raw);
        sl_map_destroy(context, &map);
    }
    assert_true(by_lines && by_sequences && passages);
    sl_context_destroy(context);
}

static sl_point turned(sl_point p, double degrees) {
    const double c = cos(degrees * 0.017453292519943295), s = sin(degrees * 0.017453292519943295);
    return (sl_point){c * p.x - s * p.y, s * p.x + c * p.y};
}

static double area_seen(sl_context *context, const sl_baked *baked, sl_point eye) {
    sl_query *query = NULL;
    sl_region region = {0};
    assert_ok(context, sl_query_create(context, baked, &query));
    const sl_view view = sl_query_view(query, eye, 0, 360);
    assert_ok(context, sl_query_region(context, query, &view, &region));
    const double area = sl_region_measure(&region).area;
    sl_region_destroy(context, &region);
    sl_query_destroy(context, query);
    return area;
}

/// Overlapping walls of several kinds, turned by 17.3 degrees: an eye sees as if the walls that do
/// not stop sight were not there.
static void turned_walls_are_combined_piece_by_piece(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    for (uint64_t seed = 1; seed <= testing_seeds(120); seed++) {
        sl_map raw = {0}, map = {0}, without = {0};
        sl_baked baked = {0}, other = {0};
        uint32_t stops[64];
        sl_random random = {seed};
        assert_ok(context, oracle_random_map(context, seed, ORACLE_GRID_INTEGER, &raw));
        const double box[5][2] = {{-2, -2}, {18, -2}, {18, 18}, {-2, 18}, {-2, -2}};
        for (size_t i = 0; i < raw.wall_count; i++) {
            raw.walls[i].a = turned(raw.walls[i].a, 17.3);
            raw.walls[i].b = turned(raw.walls[i].b, 17.3);
        }
        assert_ok(context, sl_map_copy(context, &raw, &map));
        limit_walls(context, seed, &map, stops);
        for (size_t i = 0; i < raw.wall_count; i++)
            if (stops[i] & SL_STOPS_SIGHT)
                assert_ok(context, sl_map_add_walls(context, &without, &raw.walls[i], 1));
        for (int i = 0; i < 4; i++) {
            const sl_point a = turned((sl_point){box[i][0], box[i][1]}, 17.3);
            const sl_point b = turned((sl_point){box[i + 1][0], box[i + 1][1]}, 17.3);
            assert_ok(context, sl_map_add_wall(context, &map, a, b, 0));
            assert_ok(context, sl_map_add_wall(context, &without, a, b, 0));
        }
        assert_ok(context, sl_bake(context, &map, NULL, &baked, NULL));
        assert_ok(context, sl_bake(context, &without, NULL, &other, NULL));
        assert_ok(context, sl_space_check(context, &baked.space));
        for (int i = 0; i < 10; i++) {
            const sl_point at = {sl_random_unit(&random) * 19 - 1.5,
                                 sl_random_unit(&random) * 19 - 1.5};
            const double with = area_seen(context, &baked, turned(at, 17.3));
            const double than = area_seen(context, &other, turned(at, 17.3));
            if (!(fabs(with - than) < 1e-9))
                fail_msg("seed %llu: %.17g instead of %.17g", (unsigned long long)seed, with, than);
        }
        sl_baked_destroy(context, &baked);
        sl_baked_destroy(context, &other);
        sl_map_destroy(context, &raw);
    }
    sl_context_destroy(context);
}

/// The part of the way from one wall to another where both lie stops what either does.
static void overlaps_stop_the_union(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    for (int turn = 0; turn < 2; turn++)
        for (uint32_t stops = 1; stops < SL_STOPS_ALL; stops++)
            for (uint32_t other = 1; other <= SL_STOPS_ALL; other++) {
                const double degrees = turn ? 17.3 : 0;
                const double ends[6][4] = {{0, 5, 6, 5},    {4, 5, 10, 5},   {0, 0, 10, 0},
                                           {10, 0, 10, 10}, {10, 10, 0, 10}, {0, 10, 0, 0}};
                sl_map map = {0};
                sl_baked baked = {0};
                sl_query *query = NULL;
                for (int i = 0; i < 6; i++) {
                    const size_t first = map.wall_count;
                    assert_ok(context, sl_map_add_wall(
                                           context, &map,
                                           turned((sl_point){ends[i][0], ends[i][1]}, degrees),
                                           turned((sl_point){ends[i][2], ends[i][3]}, degrees), 0));
                    assert_ok(context, sl_map_walls_stop(context, &map, first,
                                                         i == 0   ? stops
                                                         : i == 1 ? other
                                                                  : SL_STOPS_ALL));
                }
                assert_ok(context, sl_bake(context, &map, NULL, &baked, NULL));
                assert_ok(context, sl_space_check(context, &baked.space));
                assert_ok(context, sl_query_create(context, &baked, &query));
                for (int part = 0; part < 3; part++) {
                    const uint32_t all = (part < 2 ? stops : 0) | (part > 0 ? other : 0);
                    const sl_point under = turned((sl_point){1 + 4 * part, 4.5}, degrees);
                    const sl_point over = turned((sl_point){1 + 4 * part, 5.5}, degrees);
                    const uint32_t a = sl_space_locate(&baked.space, under);
                    const uint32_t b = sl_space_locate(&baked.space, over);
                    bool sees, passed = false;
                    assert_ok(context, sl_query_sees(context, query, under, over, &sees));
                    assert_int_equal(sees, !(all & SL_STOPS_SIGHT));
                    for (uint32_t i = 0; i < baked.space.passage_count; i++) {
                        const sl_passage *p = &baked.space.passages[i];
                        if ((p->cell[0] == a && p->cell[1] == b) ||
                            (p->cell[0] == b && p->cell[1] == a))
                            passed |= p->stops == all;
                    }
                    if (all & SL_STOPS_SIGHT && all != SL_STOPS_ALL) assert_true(passed);
                }
                sl_query_destroy(context, query);
                sl_baked_destroy(context, &baked);
            }
    sl_context_destroy(context);
}

// --- what is inside

static bool inside(const sl_baked *baked, double x, double y) {
    return sl_space_is_inside(&baked->space, (sl_point){x, y});
}

/// A house with a window in its outer wall, a room behind a curtain, and a pond in it.
#define HOUSE                                                                                      \
    "walls 0 0 20 0 20 10\nwall 20 10 12 10\nwall 8 10 0 10\nwall 0 10 0 0\n"                      \
    "wall 8 10 12 10 stops steps,sound\nwall 10 0 10 6\nwall 10 6 10 10 stops sight\n"             \
    "solid 2 2 4 2 4 4 2 4 stops steps\n"

static void steps_decide_what_is_inside(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    static const char *const maps[] = {HOUSE "walls -5 -5 25 -5 25 15 -5 15 -5 -5\nstart 5 5 0\n",
                                       HOUSE "start 5 5 0\n", HOUSE "entrance 1\n", HOUSE};
    for (size_t i = 0; i < sizeof maps / sizeof *maps; i++)
        for (int k = 0; k < 3; k++) {
            sl_baked baked = bake(context, maps[i], channels[k]);
            assert_true(inside(&baked, 5, 5));
            assert_true(inside(&baked, 15, 5));
            assert_false(inside(&baked, 3, 3));
            assert_false(inside(&baked, 10, 10.1));
            sl_baked_destroy(context, &baked);
        }
    sl_context_destroy(context);
}

/// Who stands over water sees, and is seen.
static void water_is_seen_over(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_baked sight = bake(context, HOUSE "start 5 5 0\n", SL_STOPS_SIGHT);
    sl_baked steps = bake(context, HOUSE "start 5 5 0\n", SL_STOPS_STEPS);
    const sl_point water = {3, 3}, garden = {10, 10.1}, room = {5, 5};
    const sl_space *s = &sight.space, *t = &steps.space;
    assert_true(
        sl_pvs_sees(&sight.visibility.pvs, sl_space_locate(s, water), sl_space_locate(s, room)));
    assert_true(
        sl_pvs_sees(&sight.visibility.pvs, sl_space_locate(s, room), sl_space_locate(s, garden)));
    assert_false(
        sl_pvs_sees(&steps.visibility.pvs, sl_space_locate(t, water), sl_space_locate(t, room)));
    assert_false(
        sl_pvs_sees(&steps.visibility.pvs, sl_space_locate(t, room), sl_space_locate(t, garden)));
    sl_baked_destroy(context, &sight);
    sl_baked_destroy(context, &steps);
    sl_context_destroy(context);
}

// --- baked files

static void files_keep_them(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    for (int k = 0; k < 6; k++) {
        const char *plan = k < 3 ? HOUSE "start 5 5 0\n" : HOUSE "wall 1 8 3 9\nstart 5 5 0\n";
        sl_baked baked = bake(context, plan, channels[k % 3]), again = {0};
        sl_bytes bytes, twice;
        assert_ok(context, sl_baked_print(context, &baked, &bytes));
        assert_ok(context, sl_baked_parse(context, "t", bytes.data, bytes.size, &again));
        assert_true(sl_baked_same_space(&baked.space, &again.space));
        assert_int_equal(sl_map_channel(&again.map), channels[k % 3]);
        assert_int_equal(again.map.seam_count, baked.map.seam_count);
        assert_true(again.space.passage_count > 0);
        for (size_t i = 0; i < again.map.seam_count; i++)
            assert_int_equal(again.map.seams[i].stops, baked.map.seams[i].stops);
        assert_ok(context, sl_baked_print(context, &again, &twice));
        assert_int_equal(bytes.size, twice.size);
        assert_memory_equal(bytes.data, twice.data, twice.size);
        sl_free(context, bytes.data);
        sl_free(context, twice.data);
        sl_baked_destroy(context, &baked);
        sl_baked_destroy(context, &again);
    }
    sl_context_destroy(context);
}

/// Each field of the new sections with values that make no sense.
static void damaged_sections_are_refused(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_baked baked = bake(context, HOUSE "start 5 5 0\n", SL_STOPS_SOUND), again = {0};
    sl_bytes bytes;
    assert_ok(context, sl_baked_print(context, &baked, &bytes));
    static const struct {
        const char *tag;
        size_t at;
        uint32_t value;
    } wrong[] = {{"STOP", 0, 9},
                 {"STOP", 0, SL_STOPS_ALL},
                 {"STOP", 0, 16},
                 {"STOP", 0, 0x402},
                 {"STOP", 0, 0x100},
                 {"CHAN", 0, 0},
                 {"CHAN", 0, 8},
                 {"PASS", 0, 0xffff},
                 {"PASS", 4, 0x7fffffff},
                 {"PASS", 4, UINT32_MAX},
                 {"PASS", 8, 0xffff},
                 {"PASS", 12, 0},
                 {"PASS", 12, SL_STOPS_ALL}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char *copy = malloc(bytes.size);
        assert_non_null(copy);
        memcpy(copy, bytes.data, bytes.size);
        const uint32_t value = slv_u32(wrong[i].value);
        memcpy(slv_items(copy, wrong[i].tag) + wrong[i].at, &value, sizeof value);
        slv_seal(copy, bytes.size);
        assert_int_equal(sl_baked_parse(context, "t", copy, bytes.size, &again), SL_BAD_INPUT);
        free(copy);
    }
    // The cells exchanged in both items of a passage, and one that is not beside the wall.
    for (int k = 0; k < 2; k++) {
        sl_baked turned = bake(context, HOUSE "start 5 5 0\n", SL_STOPS_SOUND);
        sl_bytes other;
        sl_passage *passage = turned.space.passages;
        const uint32_t left = passage->cell[0];
        passage->cell[0] = k ? sl_space_locate(&turned.space, (sl_point){15, 5}) : passage->cell[1];
        passage->cell[1] = k ? passage->cell[1] : left;
        assert_int_equal(sl_space_check(context, &turned.space), SL_BAD_INPUT);
        assert_ok(context, sl_baked_print(context, &turned, &other));
        assert_int_equal(sl_baked_parse(context, "t", other.data, other.size, &again),
                         SL_BAD_INPUT);
        sl_free(context, other.data);
        sl_baked_destroy(context, &turned);
    }
    // Corners of a cell that are nowhere: found before passages look at them.
    for (uint32_t cell = 0; cell < baked.space.cell_count; cell++) {
        sl_cell *damaged = &baked.space.cells[cell];
        const uint32_t first = damaged->first_vertex;
        damaged->first_vertex = 0x7fffffff;
        assert_int_equal(sl_space_check(context, &baked.space), SL_BAD_INPUT);
        damaged->first_vertex = first;
    }
    sl_free(context, bytes.data);
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
}

/// Any allocation of the way from text to a file and back may fail, and nothing is lost.
static void memory_may_be_lacking(void **state) {
    (void)state;
    static const char text[] = "sightline 1\n" HOUSE "wall 1 8 3 9 stops sound\nstart 5 5 0\n";
    bool done = false;
    for (long fail_at = 1; !done; fail_at++) {
        testing_memory memory = {.fail_at = fail_at, .once = fail_at % 2};
        sl_context *context =
            sl_context_create(&(sl_hooks){.user = &memory, .resize = testing_resize});
        if (!context) continue;
        sl_map map = {0}, copy = {0};
        sl_baked baked = {0}, again = {0};
        sl_bytes bytes = {0};
        sl_bake_options options = sl_bake_options_default();
        options.see.threads = 1;
        sl_status status = sl_map_parse(context, "t", text, sizeof text - 1, NULL, &map);
        map.channel = SL_STOPS_STEPS;
        if (status == SL_OK) status = sl_bake(context, &map, &options, &baked, NULL);
        if (status == SL_OK) status = sl_baked_print(context, &baked, &bytes);
        if (status == SL_OK) status = sl_baked_parse(context, "t", bytes.data, bytes.size, &again);
        if (status == SL_OK) status = sl_baked_copy_map(context, &again, &copy);
        if (status == SL_OK) status = sl_map_settle_stops(context, &copy, NULL);
        assert_true(status == SL_OK || status == SL_NO_MEMORY);
        sl_free(context, bytes.data);
        sl_map_destroy(context, &map);
        sl_map_destroy(context, &copy);
        sl_baked_destroy(context, &baked);
        sl_baked_destroy(context, &again);
        sl_context_destroy(context);
        assert_int_equal(memory.live, 0);
        done = status == SL_OK && memory.calls < fail_at;
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(words_are_read_and_written),
        cmocka_unit_test(walls_of_no_length_are_dropped),
        cmocka_unit_test(wrong_statements_name_their_line),
        cmocka_unit_test(text_is_kept),
        cmocka_unit_test(rows_are_those_without_the_other_walls),
        cmocka_unit_test(turned_walls_are_combined_piece_by_piece),
        cmocka_unit_test(overlaps_stop_the_union),
        cmocka_unit_test(steps_decide_what_is_inside),
        cmocka_unit_test(water_is_seen_over),
        cmocka_unit_test(files_keep_them),
        cmocka_unit_test(damaged_sections_are_refused),
        cmocka_unit_test(memory_may_be_lacking),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

// Cleaning, against a model that knows nothing of sweeps: walls as sets of unit edges of a edges.
#include "testing.h"

#include "map/scan.h"
#include "map_same.h"
#include "oracle/random_oblique.h"
#include "sightline/support.h"

#define SIZE 10

/// Per direction (0 upright, 1 level), line and unit: whether a wall covers it, and the smallest
/// line number on the whole run that it belongs to.
typedef struct unit_edges {
    bool covered[2][SIZE][SIZE];
    uint32_t line[2][SIZE][SIZE];
} unit_edges;

/// Axial walls as unit edges them.
static void span(const sl_wall *wall, int *direction, int *at, int *low, int *high) {
    const double along[2][2] = {{wall->a.y, wall->b.y}, {wall->a.x, wall->b.x}};
    *direction = wall->a.x != wall->b.x;
    const double *ends = along[*direction];
    *at = (int)(*direction ? wall->a.y : wall->a.x);
    *low = (int)(ends[0] < ends[1] ? ends[0] : ends[1]);
    *high = (int)(ends[0] < ends[1] ? ends[1] : ends[0]);
}

static unit_edges edges_of(const sl_map *map) {
    unit_edges edges = {0};
    int direction, at, low, high;
    for (size_t i = 0; i < map->wall_count; i++) {
        span(&map->walls[i], &direction, &at, &low, &high);
        for (int k = low; k < high; k++) edges.covered[direction][at][k] = true;
    }
    for (size_t i = 0; i < map->wall_count; i++) {
        span(&map->walls[i], &direction, &at, &low, &high);
        if (low == high) continue;
        while (low > 0 && edges.covered[direction][at][low - 1]) low--;
        while (high < SIZE && edges.covered[direction][at][high]) high++;
        const uint32_t line = map->walls[i].line;
        for (int k = low; k < high; k++) {
            uint32_t *kept = &edges.line[direction][at][k];
            if (line && (!*kept || line < *kept)) *kept = line;
        }
    }
    return edges;
}

/// Whether a wall across has a point at this place along a line.
static bool met_across(const unit_edges *edges, int direction, int at, int place) {
    if (place < 0 || place >= SIZE) return false;
    const bool *across = edges->covered[!direction][place];
    return (at > 0 && across[at - 1]) || (at < SIZE && across[at]);
}

/// The one right answer: each covered unit is in one wall, and walls end just where they must.
static void check_against(const unit_edges *before, const sl_map *after) {
    int seen[2][SIZE][SIZE] = {0};
    for (size_t i = 0; i < after->wall_count; i++) {
        int direction, at, low, high;
        const sl_wall *wall = &after->walls[i];
        span(wall, &direction, &at, &low, &high);
        assert_true(low < high);
        assert_true(direction ? wall->a.x < wall->b.x : wall->a.y < wall->b.y);
        for (int k = low; k < high; k++) {
            seen[direction][at][k]++;
            assert_int_equal(wall->line, before->line[direction][at][k]);
            // No wall meets it within.
            if (k > low) assert_false(met_across(before, direction, at, k));
        }
        // Where it ends a wall meets it, or nothing goes on.
        const bool *covered = before->covered[direction][at];
        if (low > 0 && covered[low - 1]) assert_true(met_across(before, direction, at, low));
        if (high < SIZE && covered[high]) assert_true(met_across(before, direction, at, high));
    }
    for (int direction = 0; direction < 2; direction++)
        for (int at = 0; at < SIZE; at++)
            for (int k = 0; k < SIZE; k++)
                assert_int_equal(seen[direction][at][k], before->covered[direction][at][k]);
}

static void check_order(const sl_map *map) {
    for (size_t i = 1; i < map->wall_count; i++) {
        const sl_wall *a = &map->walls[i - 1], *b = &map->walls[i];
        const bool upright[] = {a->a.x == a->b.x, b->a.x == b->b.x};
        assert_true(upright[0] >= upright[1]);
        if (upright[0] != upright[1]) continue;
        const double first[] = {upright[0] ? a->a.x : a->a.y, upright[0] ? b->a.x : b->a.y};
        const double then[] = {upright[0] ? a->b.y : a->b.x, upright[0] ? b->a.y : b->a.x};
        assert_true(first[0] < first[1] || (first[0] == first[1] && then[0] <= then[1]));
    }
}

/// What can be counted without cleaning.
static void check_account(const sl_map *map, const sl_clean_account *account, size_t after) {
    size_t zero = 0, duplicate = 0;
    for (size_t i = 0; i < map->wall_count; i++) {
        const sl_wall *wall = &map->walls[i];
        if (wall->a.x == wall->b.x && wall->a.y == wall->b.y) {
            zero++;
            continue;
        }
        bool again = false;
        for (size_t k = 0; k < i; k++) {
            const sl_wall *other = &map->walls[k];
            const sl_segment turned = {other->b, other->a}, plain = {other->a, other->b};
            const sl_segment here = {wall->a, wall->b};
            again |= same_segment(here, plain) || same_segment(here, turned);
        }
        duplicate += again;
    }
    const unit_edges edges = edges_of(map);
    size_t runs = 0;
    for (int direction = 0; direction < 2; direction++)
        for (int at = 0; at < SIZE; at++)
            for (int k = 0; k < SIZE; k++)
                runs += edges.covered[direction][at][k] &&
                        (k == 0 || !edges.covered[direction][at][k - 1]);
    assert_int_equal(account->before, map->wall_count);
    assert_int_equal(account->after, after);
    assert_int_equal(account->zero_length, zero);
    assert_int_equal(account->duplicate, duplicate);
    assert_int_equal(account->merged, map->wall_count - zero - duplicate - runs);
    assert_true(account->split <= runs && account->split <= after - runs);
    assert_int_equal(account->split == 0, after == runs);
}

static void add(sl_context *context, sl_map *map, double x0, double y0, double x1, double y1,
                uint32_t line) {
    assert_ok(context, sl_map_add_wall(context, map, (sl_point){x0, y0}, (sl_point){x1, y1}, line));
}

static void copy_walls(sl_context *context, const sl_map *from, sl_map *to) {
    for (size_t i = 0; i < from->wall_count; i++)
        assert_ok(context, sl_map_add_wall(context, to, from->walls[i].a, from->walls[i].b,
                                           from->walls[i].line));
}

static void shuffle(sl_random *random, sl_map *map) {
    for (size_t i = map->wall_count; i > 1; i--) {
        sl_wall *a = &map->walls[i - 1], *b = &map->walls[sl_random_below(random, i)];
        const sl_wall kept = *a;
        *a = *b;
        *b = kept;
        if (sl_random_below(random, 2))
            *a = (sl_wall){a->b, a->a, a->line, sl_ground_turned(a->ground)};
    }
}

static void assert_same_walls(const sl_map *a, const sl_map *b) {
    assert_true(same_walls(a, b));
    for (size_t i = 0; i < a->wall_count; i++) assert_int_equal(a->walls[i].line, b->walls[i].line);
}

static void test_random(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_random random = {3};
    for (int round = 0; round < 4000; round++) {
        sl_map map = {0}, clean = {0}, other = {0};
        const uint64_t count = sl_random_below(&random, 30);
        for (uint64_t i = 0; i < count; i++) {
            const double at = (double)sl_random_below(&random, SIZE);
            const double low = (double)sl_random_below(&random, SIZE);
            const double high = (double)sl_random_below(&random, SIZE);
            const uint32_t line = (uint32_t)sl_random_below(&random, 50);
            if (i & 1)
                add(context, &map, at, low, at, high, line);
            else
                add(context, &map, low, at, high, at, line);
        }
        copy_walls(context, &map, &clean);
        sl_clean_account account;
        assert_ok(context, sl_map_clean(context, &clean, NULL, &account));
        const unit_edges edges = edges_of(&map);
        check_against(&edges, &clean);
        check_order(&clean);
        check_account(&map, &account, clean.wall_count);
        shuffle(&random, &map);
        assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
        assert_same_walls(&map, &clean);
        copy_walls(context, &clean, &other);
        assert_ok(context, sl_map_clean(context, &other, NULL, NULL));
        assert_same_walls(&other, &clean);
        sl_map_destroy(context, &map);
        sl_map_destroy(context, &clean);
        sl_map_destroy(context, &other);
    }
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

static void read_walls(sl_context *context, const char *walls, sl_map *map) {
    char text[1000];
    snprintf(text, sizeof text, "sightline 1\n%s", walls);
    assert_ok(context, sli_map_read_text(context, "t", text, strlen(text), map));
}

static void assert_cleaned(sl_context *context, const char *walls, const char *expected) {
    sl_map map = {0};
    read_walls(context, walls, &map);
    assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
    char *clean = map_text(&map);
    assert_string_equal(clean + strlen("sightline 1\n"), expected);
    free(clean);
    sl_map_destroy(context, &map);
}

static void test_cases(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    assert_cleaned(context, "", "");
    assert_cleaned(context, "wall 1 1 1 1\n", "");
    // L: nothing to do. T: the one is cut. X: both are.
    assert_cleaned(context, "wall 2 0 0 0\nwall 0 0 0 2\n", "wall 0 0 0 2\nwall 0 0 2 0\n");
    assert_cleaned(context, "wall 0 0 2 0\nwall 1 0 1 2\n",
                   "wall 1 0 1 2\nwall 0 0 1 0\nwall 1 0 2 0\n");
    assert_cleaned(context, "wall 0 1 2 1\nwall 1 0 1 2\n",
                   "wall 1 0 1 1\nwall 1 1 1 2\nwall 0 1 1 1\nwall 1 1 2 1\n");
    // Touching ones become one, unless a third meets them there.
    assert_cleaned(context, "wall 1 0 2 0\nwall 0 0 1 0\n", "wall 0 0 2 0\n");
    assert_cleaned(context, "wall 1 0 2 0\nwall 0 0 1 0\nwall 1 -1 1 0\n",
                   "wall 1 -1 1 0\nwall 0 0 1 0\nwall 1 0 2 0\n");
    // One zero.
    assert_cleaned(context, "wall -0 -0 -0 1\nwall 0 0 0 1\nwall -0 0 1 1\nwall 0 -0 1 1\n",
                   "wall 0 0 0 1\nwall 0 0 1 1\n");
    // Oblique walls are cut and cut others, and what overlaps is there once, either way round.
    assert_cleaned(context, "wall 2 2 0 0\nwall 0 0 2 2\nwall 1 0 1 2\nwall 0 0 1 1\n",
                   "wall 0 0 1 1\nwall 1 0 1 1\nwall 1 1 1 2\nwall 1 1 2 2\n");
    assert_cleaned(context, "wall 0 0 3 6\nwall 2 4 4 8\nwall 1 2 5 0\n",
                   "wall 0 0 1 2\nwall 1 2 2 4\nwall 1 2 5 0\nwall 2 4 3 6\nwall 3 6 4 8\n");
    // Glass and seams that are cut become several; mirrors are walls as well.
    assert_cleaned(context, "wall 0 0 4 4\nseam 4 0 0 4\noneway 1 0 1 2\nmirror 0 2 4 2\n",
                   "wall 0 0 1 1\nwall 0 2 1 2\nwall 1 1 2 2\nwall 1 2 2 2\nwall 2 2 4 2\n"
                   "wall 2 2 4 4\nmirror 0 2 1 2\nmirror 1 2 2 2\nmirror 2 2 4 2\noneway 1 0 1 1\n"
                   "oneway 1 1 1 2\nseam 4 0 2 2\nseam 2 2 0 4\n");
    // Coordinates next to each other are two coordinates.
    assert_cleaned(context, "wall 0 0 0.1 0\nwall 0.10000000000000002 0 1 0\n",
                   "wall 0 0 0.1 0\nwall 0.10000000000000002 0 1 0\n");
    // What is not a wall stays.
    assert_cleaned(
        context, "wall 1 1 0 1\ndoor d 1 0 0 0 shut\nmirror 1 0 0 0\nstart -0 0 1\n",
        "wall 0 0 1 0\nwall 0 1 1 1\ndoor d 1 0 0 0 shut\nmirror 1 0 0 0\nstart -0 0 1\n");
    sl_context_destroy(context);
}

/// A door stays one, in parts; what is left of it is whole again.
static void test_doors(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    read_walls(context, "wall 0 0 4 4\nwall 1 2 1 4\ndoor d 4 0 0 4 open\ndoor e 9 9 8 7 shut\n",
               &map);
    for (int again = 0; again < 2; again++) {
        assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
        assert_int_equal(map.door_count, 2);
        const sl_door *door = &map.doors[0];
        const sl_point places[] = {{4, 0}, {2, 2}, {1, 3}, {0, 4}};
        assert_int_equal(door->part_count, 3);
        assert_true(testing_same_point(door->segment.a, places[0]) &&
                    testing_same_point(door->segment.b, places[3]));
        for (int i = 0; i < 3; i++)
            assert_true(testing_same_point(door->parts[i].a, places[i]) &&
                        testing_same_point(door->parts[i].b, places[i + 1]));
        assert_true(!map.doors[1].parts && !map.doors[1].part_count && !map.doors[1].open);
    }
    // Without what has cut it.
    map.wall_count = 0;
    assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
    assert_true(!map.doors[0].parts && !map.doors[0].part_count);
    // Nothing but what has no length.
    map.doors[0].segment = map.doors[1].segment = (sl_segment){{1, 2}, {1, 2}};
    assert_ok(context, sl_map_clean(context, &map, &(sl_clean_options){1}, NULL));
    assert_int_equal(map.door_count, 0);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// The notes of one call, one after the other.
typedef struct note_list {
    char text[4096];
    size_t count;
} note_list;

static void keep_note(void *user, const char *message) {
    note_list *notes = user;
    const size_t used = strlen(notes->text);
    snprintf(notes->text + used, sizeof notes->text - used, "%s\n", message);
    notes->count++;
}

/// Doors, glass and seams whose ends become one place are left out, each with a note that names its
/// line, however the map is cleaned; the rest stays in its order.
static void test_what_has_no_length_is_left_out(void **state) {
    (void)state;
    static const char things[] = "door a 1 1 1 1.5\ndoor b 5 5 5 7\nmirror 2 2 2.5 2\n"
                                 "oneway 3 3 3.5 3\nseam 4 8 4.5 8\nseam 7 7 9 7\n";
    note_list notes = {0};
    const sl_hooks hooks = {.user = &notes, .note = keep_note};
    sl_context *context = sl_context_create(&hooks);
    assert_non_null(context);
    for (int oblique = 0; oblique < 2; oblique++) {
        sl_map map = {0};
        memset(&notes, 0, sizeof notes);
        read_walls(context, things, &map);
        if (oblique)
            assert_ok(context,
                      sl_map_add_wall(context, &map, (sl_point){20, 0}, (sl_point){30, 7}, 8));
        // As read: places that are one already, as callers of the library may give.
        if (!oblique) map.doors[0].segment.b = map.doors[0].segment.a;
        if (!oblique) map.mirrors[0].segment.b = map.mirrors[0].segment.a;
        if (!oblique) map.oneways[0].segment.b = map.oneways[0].segment.a;
        if (!oblique) map.seams[0].segment.b = map.seams[0].segment.a;
        assert_ok(context,
                  sl_map_clean(context, &map, &(sl_clean_options){oblique ? 0.6 : 0}, NULL));
        assert_int_equal(map.door_count, 1);
        assert_string_equal(map.doors[0].name, "b");
        assert_int_equal(map.mirror_count + map.oneway_count, 0);
        assert_int_equal(map.seam_count, 1);
        assert_int_equal(map.seams[0].segment.a.x, 7);
        assert_int_equal(notes.count, 4);
        static const char *const said[] = {"line 2: door a is left out", "line 4: mirror is",
                                           "line 5: one-way glass is", "line 6: seam is"};
        for (size_t i = 0; i < 4; i++) assert_non_null(strstr(notes.text, said[i]));
        assert_true(!strstr(notes.text, "--weld") == !oblique);
        sl_map_destroy(context, &map);
    }
    sl_context_destroy(context);
}

static sl_clean_account account_of(sl_context *context, const char *walls, double weld) {
    sl_map map = {0};
    sl_clean_account account;
    read_walls(context, walls, &map);
    assert_ok(context, sl_map_clean(context, &map, &(sl_clean_options){weld}, &account));
    sl_map_destroy(context, &map);
    return account;
}

static void test_oblique_account(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    // A crossing that is a double moves nothing.
    sl_clean_account a = account_of(context, "wall 0 0 4 4\nwall 0 4 4 0\n", -1);
    assert_true(a.before == 2 && a.after == 4 && a.split == 2 && a.crossings == 1);
    assert_true(a.welded == 0 && a.largest_move == 0);
    // One at thirds does, by less than a step.
    a = account_of(context, "wall 0 0 1 3\nwall 0 1 3 0\n", -1);
    assert_true(a.crossings == 1 && a.largest_move > 0 && a.largest_move < 0x1p-49);
    // An end by a wall: it is led through the end where that is nearer than half of the tolerance.
    const char *beside = "wall 0 0 8 6\nwall 4.03 2.96 9 0\n";
    a = account_of(context, beside, 0.2);
    assert_true(a.after == 3 && a.crossings == 0 && a.welded == 0);
    assert_true(a.largest_move > 0.049 && a.largest_move < 0.051);
    a = account_of(context, beside, 0.05);
    assert_true(a.after == 2 && a.largest_move == 0);
    // Two ends.
    const char *ends = "wall 0 0 8 6\nwall 8.03 6.04 9 0\n";
    a = account_of(context, ends, 0.06);
    assert_true(a.welded == 1 && a.largest_move > 0.035 && a.largest_move < 0.037);
    assert_true(account_of(context, ends, 0.04).welded == 0);
    // With a tolerance of its own what is axial is welded too; without one it is not.
    const char *axial = "wall 0 0 8 0\nwall 8 0.01 8 6\n";
    assert_true(account_of(context, axial, 0.02).welded == 1);
    assert_true(account_of(context, axial, -1).welded == 0);
    sl_map map = {0};
    add(context, &map, 0, 0, 1, 1, 0);
    const double none[] = {NAN, HUGE_VAL, 2e150};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        assert_int_equal(sl_map_clean(context, &map, &(sl_clean_options){none[i]}, NULL),
                         SL_BAD_ARGUMENT);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// What is clean stays as it is, and the order of walls does not count.
static void test_random_oblique(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_random random = {8};
    for (int grid = 0; grid < OBLIQUE_GRIDS; grid++)
        for (uint64_t seed = 1; seed <= 60; seed++) {
            sl_map map = {0}, clean = {0}, other = {0};
            sl_clean_account account;
            assert_ok(context, oblique_random_map(context, seed, (oblique_grid)grid, 20, &map));
            copy_walls(context, &map, &clean);
            assert_ok(context, sl_map_clean(context, &clean, NULL, NULL));
            copy_walls(context, &clean, &other);
            shuffle(&random, &other);
            assert_ok(context, sl_map_clean(context, &other, NULL, &account));
            assert_true(account.welded == 0 && account.largest_move == 0);
            // Walls that welding has made axial, and in line, become one.
            if (grid != OBLIQUE_NEARLY) assert_same_walls(&other, &clean);
            shuffle(&random, &map);
            assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
            assert_same_walls(&map, &clean);
            sl_map_destroy(context, &map);
            sl_map_destroy(context, &clean);
            sl_map_destroy(context, &other);
        }
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

/// More ranks than two floors of the sweep's set have, with gaps: a ladder and one long pole. Some
/// rungs end before it, some begin behind it, few meet it.
static void test_many_ranks(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    const int rungs = 70 * 64 * 64 / 10;
    size_t met = 0;
    for (int i = 0; i < rungs; i++) {
        const bool meets = i % 1000 == 7;
        add(context, &map, meets || i % 2 ? -2 : 1, i, meets || i % 2 == 0 ? 2 : -1, i, 0);
        met += meets;
    }
    add(context, &map, 0, -1, 0, rungs, 0);
    sl_clean_account account;
    assert_ok(context, sl_map_clean(context, &map, NULL, &account));
    assert_int_equal(account.split, met + 1);
    assert_int_equal(account.after, (size_t)rungs + 1 + 2 * met);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void test_cancelled(void **state) {
    (void)state;
    const sl_hooks hooks = {.cancelled = testing_cancelled};
    sl_context *context = sl_context_create(&hooks);
    sl_map map = {0};
    add(context, &map, 1, 2, 1, 0, 4);
    assert_int_equal(sl_map_clean(context, &map, NULL, NULL), SL_CANCELLED);
    assert_true(map.wall_count == 1 && map.walls[0].a.y == 2);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random),
        cmocka_unit_test(test_cases),
        cmocka_unit_test(test_doors),
        cmocka_unit_test(test_what_has_no_length_is_left_out),
        cmocka_unit_test(test_oblique_account),
        cmocka_unit_test(test_random_oblique),
        cmocka_unit_test(test_many_ranks),
        cmocka_unit_test(test_cancelled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

// Rooms without an opening: which count, how large they are, the same turned, moved and scaled.
#include "testing.h"

#include "map/scan.h"
#include "sightline/bake.h"
#include "sightline/faults.h"

#include <math.h>
#include <string.h>

/// Two rooms of 4 by 4 beside a passage of 2 by 8. Each part begins with a line.
#define PASSAGE "walls 0 0 2 0 2 8 0 8 0 0\n"
#define SHUT    "walls 2 0 6 0 6 4 2 4\nwalls 6 4 6 8 2 8\n"
#define OPENED  "walls 0 0 2 0\nwalls 2 1 2 8 0 8 0 0\nwalls 2 0 6 0 6 4 2 4\nwalls 6 4 6 8 2 8\n"

typedef struct move {
    double turn, scale, x, y;
} move;

static void find(const char *statements, move by, sl_sealed *out) {
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_map map = {0};
    sl_baked baked = {0};
    sl_bake_options options = sl_bake_options_default();
    char text[4096];
    snprintf(text, sizeof text, "sightline 1\n%s", statements);
    assert_ok(context, sli_map_read_text(context, "f", text, strlen(text), &map));
    const double c = by.scale * cos(by.turn), s = by.scale * sin(by.turn);
    for (size_t i = 0; i < map.wall_count; i++) {
        sl_point *ends[2] = {&map.walls[i].a, &map.walls[i].b};
        for (int k = 0; k < 2; k++)
            *ends[k] = (sl_point){c * ends[k]->x - s * ends[k]->y + by.x,
                                  s * ends[k]->x + c * ends[k]->y + by.y};
    }
    assert_ok(context, sl_bake_space(context, &map, &options, &baked, NULL));
    assert_ok(context, sl_find_sealed(context, &baked.map, &baked.space, out));
    sl_baked_destroy(context, &baked);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

static const move still = {0, 1, 0, 0};

static void test_counts(void **state) {
    (void)state;
    sl_sealed found;
    find(PASSAGE SHUT, still, &found);
    assert_int_equal(found.rooms, 3);
    assert_true(fabs(found.share - 32.0 / 48) < 1e-12);
    assert_true(found.open.area == 16 && found.largest.area == 16);
    find(OPENED, still, &found);
    assert_int_equal(found.rooms, 2);
    assert_true(fabs(found.share - 16.0 / 48) < 1e-12);
    assert_true(found.largest.at.x > 2 && found.largest.at.y > 4);
    find("walls 0 0 9 0 9 9 0 9 0 0\n", still, &found);
    assert_true(found.rooms == 1 && found.share == 0 && found.largest.area == 0);
    // Nothing is closed: nothing is sealed.
    find("wall 0 0 9 0\nwall 0 5 3 7\n", still, &found);
    assert_true(found.share == 0);
}

/// A room inside of others is not at the edge, and none is where all reach it.
static void test_edge(void **state) {
    (void)state;
    sl_sealed found;
    find("walls 0 0 9 0 9 9 0 9 0 0\nwalls 1 1 3 1 3 3 1 3 1 1\nwalls 5 5 8 5 8 8 5 8 5 5\n", still,
         &found);
    assert_true(found.open.at_edge && !found.within.at_edge && found.within.area == 9);
    assert_true(found.within.at.x > 5 && found.within.at.x < 8);
    find(PASSAGE SHUT, still, &found);
    assert_true(found.open.at_edge && found.largest.at_edge && found.within.area == 0);
    // A way out is no edge: the rock about it is at the edge, the hall that it leads to is not.
    find("walls 0 0 20 0 20 20 0 20 0 0\nwalls 9 20 9 12 4 12 4 4 14 4 14 12 10 12 10 20\n", still,
         &found);
    assert_true(found.open.at_edge && !found.largest.at_edge && found.within.area == 88);
    // What touches three sides is around the rest, if at corners only.
    find("walls 0 10 10 0 20 10 10 20 0 10\nwalls 8 8 12 8 12 12 8 12 8 8\n", still, &found);
    assert_true(found.open.at_edge && found.within.area == 16);
}

/// Nobody walks through a window.
static void test_window(void **state) {
    (void)state;
    sl_sealed found;
    find(PASSAGE "walls 2 0 6 0 6 4 2 4\n", still, &found);
    assert_int_equal(found.rooms, 2);
    find("walls 0 0 2 0\nwalls 2 1 2 8 0 8 0 0\nwalls 2 0 6 0 6 4 2 4\nwall 2 0 2 1 stops steps\n",
         still, &found);
    assert_int_equal(found.rooms, 2);
    assert_true(found.share > 0.49 && found.share < 0.51);
    find("walls 0 0 2 0\nwalls 2 1 2 8 0 8 0 0\nwalls 2 0 6 0 6 4 2 4\nwall 2 0 2 1 stops sound\n",
         still, &found);
    assert_int_equal(found.rooms, 1);
}

/// The core of a wall and a small shaft do not count.
static void test_thin(void **state) {
    (void)state;
    sl_sealed found;
    find("walls 0 0 10 0 10 10 0 10 0 0\nwalls -0.3 -0.3 10.3 -0.3 10.3 10.3 -0.3 10.3 -0.3 -0.3\n"
         "walls 5 5 5.2 5 5.2 5.2 5 5.2 5 5\n",
         still, &found);
    assert_true(found.rooms == 1 && found.share == 0);
    // A cupboard in a room is as large as a small room.
    find("walls 0 0 10 0 10 10 0 10 0 0\nwalls 4 4 7 4 7 7 4 7 4 4\n", still, &found);
    assert_int_equal(found.rooms, 2);
    assert_true(fabs(found.share - 0.09) < 1e-12);
}

static void test_placed(void **state) {
    (void)state;
    static const move moves[] = {{17.3 * 3.14159265358979 / 180, 1, 0, 0},
                                 {0, 0x1p-40, 0, 0},
                                 {0, 0x1p40, 0, 0},
                                 {0, 1, 0x1p30, -0x1p30}};
    for (size_t i = 0; i < sizeof moves / sizeof *moves; i++) {
        sl_sealed found;
        find(PASSAGE SHUT, moves[i], &found);
        assert_int_equal(found.rooms, 3);
        assert_true(fabs(found.share - 32.0 / 48) < 1e-6);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_counts), cmocka_unit_test(test_edge),
                                       cmocka_unit_test(test_window), cmocka_unit_test(test_thin),
                                       cmocka_unit_test(test_placed)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

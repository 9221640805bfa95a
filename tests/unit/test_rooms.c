/// Rooms: by hand in small plans, turned, and on random maps against what discs pass.
#include "room.h"

#include "map/source.h"
#include "oracle/random_oblique.h"
#include "sightline/rooms.h"

#include <math.h>
#include <stdio.h>

/// Two rooms with a gap of 1 between them, a third one behind a door, and a doorway of a wall that
/// is 0.4 thick.
static const char plan[] =
    "walls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 4\nwall 10 5 10 10\n"
    "wall 10 6 14 6\nwall 15 6 20 6\nwall 10 6.4 14 6.4\nwall 15 6.4 20 6.4\n"
    "wall 14 6 14 6.4\nwall 15 6 15 6.4\n"
    "wall 4 10 4 6\nwall 4 6 1 6\ndoor d 0 6 1 6 open\nstart 2 2 0\n";

/// The statements, turned about the origin and with a unit in front.
static void turned_space(room *r, testing_memory *memory, const char *statements, double degrees,
                         const char *unit) {
    *r = (room){.context = testing_context(memory)};
    char text[1024];
    const int length = snprintf(text, sizeof text, "sightline 1\n%s", statements);
    assert_ok(r->context, sli_map_read_text(r->context, "test", text, (size_t)length, &r->map));
    oblique_turn_map(&r->map, degrees, 0);
    snprintf(r->map.unit, sizeof r->map.unit, "%s", unit);
    testing_subdivide(r->context, &r->map, &r->space);
}

static sl_point turn(double degrees, double x, double y) {
    return oblique_turned((sl_point){x, y}, degrees, 0);
}

static void close_scene(room *r, sl_rooms *rooms, testing_memory *memory) {
    sl_rooms_destroy(r->context, rooms);
    end_room(r);
    assert_int_equal(memory->live, 0);
}

/// With the unit, by a width, and by the openings of the plan itself; turned and not.
static void four_rooms(void **state) {
    static const struct {
        double degrees, width;
        const char *unit;
    } cases[] = {{0, 0, "m"},      {17.3, 0, "m"}, {0, 1, ""},
                 {17.3, 1.01, ""}, {17.3, 0, ""},  {0, 0, ""}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        testing_memory memory = {0};
        room r;
        sl_rooms rooms;
        const double d = cases[i].degrees;
        turned_space(&r, &memory, plan, d, cases[i].unit);
        assert_ok(r.context, sl_rooms_find(r.context, &r.map, &r.space, cases[i].width, &rooms));
        assert_int_equal(rooms.count, 4);
        // 10 x 10 without the corner room; 10 x 6; 10 x 3.6; 4 x 4. No doorway.
        assert_true(fabs(rooms.items[0].area - 84) < 0.3);
        assert_true(fabs(rooms.items[1].area - 60) < 0.3);
        assert_true(fabs(rooms.items[2].area - 36) < 0.3);
        assert_true(fabs(rooms.items[3].area - 16) < 0.3);
        assert_int_equal(sl_rooms_at(&rooms, turn(d, 2, 2)), 0);
        assert_int_equal(sl_rooms_at(&rooms, turn(d, 15, 3)), 1);
        assert_int_equal(sl_rooms_at(&rooms, turn(d, 15, 8)), 2);
        assert_int_equal(sl_rooms_at(&rooms, turn(d, 2, 8)), 3);
        assert_int_equal(sl_rooms_at(&rooms, turn(d, 14.5, 6.2)), SL_NO_ROOM);
        assert_int_equal(sl_rooms_at(&rooms, turn(d, -3, 4)), SL_NO_ROOM);
        assert_int_equal(sl_rooms_at(&rooms, (sl_point){NAN, 0}), SL_NO_ROOM);
        assert_string_equal(rooms.items[2].name, "Room 3");
        for (uint32_t k = 0; k < rooms.count; k++)
            assert_int_equal(sl_rooms_at(&rooms, rooms.items[k].at), k);
        close_scene(&r, &rooms, &memory);
    }
}

/// The exact width: a gap of 1 is a door for a disc of 1, and none for one that is a bit smaller.
static void exact_width(void **state) {
    (void)state;
    for (int wider = 0; wider < 2; wider++) {
        testing_memory memory = {0};
        room r;
        sl_rooms rooms;
        turned_space(&r, &memory,
                     "walls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 4\nwall 10 5 10 10\n", 0, "");
        const double width = wider ? 1 : nextafter(1, 0);
        assert_ok(r.context, sl_rooms_find(r.context, &r.map, &r.space, width, &rooms));
        assert_int_equal(rooms.count, wider ? 2 : 1);
        assert_true(fabs(rooms.items[0].area - (wider ? 100 : 200)) < 1e-9);
        close_scene(&r, &rooms, &memory);
    }
}

/// What a room's eye sees of another one: the shapes of rooms are those of overlays.
static void seen_share(void **state) {
    (void)state;
    testing_memory memory = {0};
    room r;
    sl_rooms rooms;
    sl_overlay overlay;
    turned_space(&r, &memory, plan, 0, "m");
    assert_ok(r.context, sl_rooms_find(r.context, &r.map, &r.space, 0, &rooms));
    static const sl_point half[] = {{5, 1}, {15, 1}, {15, 2}, {5, 2}};
    static const size_t end = 4;
    const sl_shape shape = {half, &end, 1};
    assert_ok(r.context, sl_overlay_make(r.context, &rooms.items[1].shape, &shape, 1, &overlay));
    assert_true(fabs(overlay.areas[0] - rooms.items[1].area) < 1e-9);
    assert_true(fabs(overlay.areas[1] - 5) < 1e-9);
    sl_overlay_destroy(r.context, &overlay);
    close_scene(&r, &rooms, &memory);
}

static void names_of_texts(void **state) {
    static const struct {
        const char *text;
        double x, y, height;
    } texts[] = {{"101", 2, 2, 0.3},         {"Hall", 3, 3, 0.2},   {"84.0 m\xc2\xb2", 3, 2.5, 0.4},
                 {"  Lift \nA", 15, 3, 0.2}, {"below", 15, 2, 0.2}, {"7", 15, 8, 0.2},
                 {"outside", 40, 40, 1},     {" \n ", 2, 8, 1}};
    (void)state;
    testing_memory memory = {0};
    room r;
    sl_rooms rooms;
    sl_map copy = {0};
    turned_space(&r, &memory, plan, 0, "m");
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        assert_ok(r.context, sli_source_add_text(
                                 r.context, &r.map.source, texts[i].text, strlen(texts[i].text),
                                 (sl_point){texts[i].x, texts[i].y}, texts[i].height));
    assert_int_equal(r.map.source.text_count, sizeof texts / sizeof *texts - 1);
    assert_ok(r.context, sl_map_copy(r.context, &r.map, &copy));
    assert_ok(r.context, sl_rooms_find(r.context, &r.map, &r.space, 0, &rooms));
    assert_ok(r.context, sl_rooms_take_names(r.context, &rooms, &copy));
    assert_string_equal(rooms.items[0].name, "Hall");
    assert_string_equal(rooms.items[1].name, "Lift");
    assert_string_equal(rooms.items[2].name, "7");
    assert_string_equal(rooms.items[3].name, "Room 4");
    assert_ok(r.context, sl_rooms_name(r.context, &rooms, 3, "Store"));
    assert_string_equal(rooms.items[3].name, "Store");
    assert_ok(r.context, sl_rooms_name(r.context, &rooms, 0, ""));
    assert_string_equal(rooms.items[0].name, "Room 1");
    sl_map_destroy(r.context, &copy);
    close_scene(&r, &rooms, &memory);
}

static void nothing_there(void **state) {
    (void)state;
    testing_memory memory = {0};
    room r;
    sl_rooms rooms;
    turned_space(&r, &memory, "wall 0 0 10 0\nwall 0 3 10 3\n", 17.3, "m");
    assert_int_equal(sl_rooms_find(r.context, &r.map, &r.space, -1, &rooms), SL_BAD_ARGUMENT);
    assert_int_equal(sl_rooms_find(r.context, &r.map, &r.space, NAN, &rooms), SL_BAD_ARGUMENT);
    assert_ok(r.context, sl_rooms_find(r.context, &r.map, &r.space, 0, &rooms));
    assert_int_equal(sl_rooms_at(&rooms, (sl_point){5, 10}), SL_NO_ROOM);
    close_scene(&r, &rooms, &memory);
}

/// On random maps rooms do not overlap, and each place far from walls that is inside is in one.
static void random_maps(void **state) {
    (void)state;
    for (uint32_t seed = 1; seed <= 30; seed++) {
        testing_memory memory = {0};
        room r = {.context = testing_context(&memory)};
        sl_rooms rooms;
        sl_random random = {.state = seed};
        assert_ok(r.context, oblique_random_map(r.context, seed, OBLIQUE_ANYWHERE, 40, &r.map));
        testing_subdivide(r.context, &r.map, &r.space);
        const sl_box b = r.space.bounds;
        const double width = (0.02 + 0.1 * sl_random_unit(&random)) * (b.max.x - b.min.x);
        double area = 0, inside = 0;
        assert_ok(r.context, sl_rooms_find(r.context, &r.map, &r.space, width, &rooms));
        for (uint32_t i = 0; i < rooms.count; i++) {
            const sl_room *each = &rooms.items[i];
            area += each->area;
            assert_true(2 * each->clearance >= width / 2);
            assert_true(i == 0 || each->area <= rooms.items[i - 1].area);
            for (uint32_t k = 0; k < each->shape.count; k++) {
                const sl_point *c = each->shape.points + 3 * (size_t)k;
                assert_true(sl_orient(c[0], c[1], c[2]) > 0);
            }
        }
        for (uint32_t i = 0; i < r.space.cell_count; i++)
            if (r.space.cells[i].inside) inside += sl_space_area(&r.space, i);
        assert_true(area <= inside * (1 + 1e-9));
        close_scene(&r, &rooms, &memory);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(four_rooms),    cmocka_unit_test(exact_width),
        cmocka_unit_test(seen_share),    cmocka_unit_test(names_of_texts),
        cmocka_unit_test(nothing_there), cmocka_unit_test(random_maps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

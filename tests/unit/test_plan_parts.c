// What a plan has beside walls, by shape alone: frames, dimensions, axes, legends, furniture.
#include "testing.h"

#include "io/parts/plan_doubt.h"
#include "io/parts/plan_parts.h"

#include <math.h>

/// A drawing: lines of one item have one number, as those of one polyline have.
typedef struct drawing {
    sl_context *context;
    sl_map map;
    uint32_t item;
} drawing;

static void add_line(drawing *d, double x0, double y0, double x1, double y1) {
    assert_ok(d->context, sl_map_add_wall(d->context, &d->map, (sl_point){x0, y0},
                                          (sl_point){x1, y1}, d->item));
}

static void line(drawing *d, double x0, double y0, double x1, double y1) {
    d->item++;
    add_line(d, x0, y0, x1, y1);
}

static void box(drawing *d, double x0, double y0, double x1, double y1) {
    d->item++;
    add_line(d, x0, y0, x1, y0);
    add_line(d, x1, y0, x1, y1);
    add_line(d, x1, y1, x0, y1);
    add_line(d, x0, y1, x0, y0);
}

/// Six rooms of 3.6 by 3.6 m in walls 0.3 m thick, each drawn by its two faces; a door in the
/// first.
static void house(drawing *d) {
    for (int i = 1; i < 6; i++) {
        const double x = 0.3 + 3.9 * (i % 3), y = 0.3 + 3.9 * (double)(i / 3);
        box(d, x, y, x + 3.6, y + 3.6);
    }
    static const double outline[][2] = {{1, 0},     {0, 0},   {0, 8.1},   {12, 8.1},  {12, 0},
                                        {2, 0},     {2, 0.3}, {3.9, 0.3}, {3.9, 3.9}, {0.3, 3.9},
                                        {0.3, 0.3}, {1, 0.3}, {1, 0}};
    d->item++;
    for (size_t i = 0; i + 1 < sizeof outline / sizeof *outline; i++)
        add_line(d, outline[i][0], outline[i][1], outline[i + 1][0], outline[i + 1][1]);
}

static void bed(drawing *d, double x, double y) {
    box(d, x, y, x + 1, y + 2);
    line(d, x + 0.2, y + 1.6, x + 0.8, y + 1.9);
    line(d, x, y + 1.5, x + 1, y + 1.5);
}

/// How a drawing is placed.
typedef struct place {
    double degrees, scale, x, y;
} place;

static const place places[] = {{0, 1, 0, 0},
                               {17.3, 1, 0, 0},
                               {-90, 1000, 1e6, -2e6},
                               {17.3, 1, 3e5, 5e6},
                               {61, 1 / 25.4, 0, 0}};

static void put(drawing *d, const place *at) {
    const double angle = at->degrees * 3.14159265358979323846 / 180;
    const double c = cos(angle) * at->scale, s = sin(angle) * at->scale;
    for (size_t i = 0; i < d->map.wall_count; i++) {
        sl_wall *wall = &d->map.walls[i];
        wall->a = (sl_point){at->x + c * wall->a.x - s * wall->a.y,
                             at->y + s * wall->a.x + c * wall->a.y};
        wall->b = (sl_point){at->x + c * wall->b.x - s * wall->b.y,
                             at->y + s * wall->b.x + c * wall->b.y};
    }
}

/// What is found of a house with more in it. Nothing of the house itself, wherever it is.
static void assert_found(void (*more)(drawing *d), sli_plan_parts expected) {
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        drawing d = {.context = testing_context(NULL)};
        sli_plan_parts found = {0};
        house(&d);
        const size_t own = d.map.wall_count;
        more(&d);
        put(&d, &places[i]);
        assert_ok(d.context, sli_plan_parts_find(d.context, &d.map, places[i].scale, &found));
        assert_non_null(found.gone);
        for (size_t k = 0; k < own; k++) assert_false(sl_bits_has(found.gone, k));
        size_t gone = 0;
        for (size_t k = own; k < d.map.wall_count; k++) gone += sl_bits_has(found.gone, k);
        assert_int_equal(gone, sli_plan_parts_count(&found));
        assert_int_equal(found.frame, expected.frame);
        assert_int_equal(found.dimensions, expected.dimensions);
        assert_int_equal(found.across, expected.across);
        assert_int_equal(found.beside, expected.beside);
        assert_int_equal(found.loose, expected.loose);
        assert_int_equal(found.pieces, expected.pieces);
        assert_int_equal(found.tiles, expected.tiles);
        sli_plan_parts_destroy(d.context, &found);
        sl_map_destroy(d.context, &d.map);
        sl_context_destroy(d.context);
    }
}

// --- what is found

static void add_nothing(drawing *d) {
    (void)d;
}

static void add_frame(drawing *d) {
    box(d, -6, -5, 30, 20);
    line(d, 20, -5, 20, -2);
    line(d, 20, -2, 30, -2);
}

static void add_double_frame(drawing *d) {
    box(d, -6, -5, 30, 20);
    box(d, -5.8, -4.8, 29.8, 19.8);
}

static void add_dimension(drawing *d) {
    line(d, 0, -1, 12, -1);
    line(d, 0, 0, 0, -1.1);
    line(d, 12, 0, 12, -1.1);
    line(d, -0.1, -1.1, 0.1, -0.9);
    line(d, 11.9, -1.1, 12.1, -0.9);
}

static void add_axis(drawing *d) {
    line(d, -2, 6, 14, 6);
}

static void add_legend(drawing *d) {
    box(d, 16, 0, 20, 6);
    line(d, 16, 5, 20, 5);
    line(d, 17, 3, 18, 4);
}

static void add_beds(drawing *d) {
    bed(d, 5, 1);
    bed(d, 9, 5);
}

/// Tiles in the second room, the last of each row cut by its wall and open there.
static void add_tiles(drawing *d) {
    for (int row = 0; row < 8; row++)
        for (int column = 0; column < 9; column++) {
            const double x = 4.22 + 0.4 * column, y = 0.32 + 0.4 * row;
            if (column < 8) {
                box(d, x, y, x + 0.395, y + 0.395);
                continue;
            }
            d->item++;
            add_line(d, x + 0.3, y, x, y);
            add_line(d, x, y, x, y + 0.395);
            add_line(d, x, y + 0.395, x + 0.3, y + 0.395);
        }
}

static void test_found(void **state) {
    (void)state;
    assert_found(add_nothing, (sli_plan_parts){0});
    assert_found(add_frame, (sli_plan_parts){.frame = 6});
    assert_found(add_double_frame, (sli_plan_parts){.frame = 8});
    assert_found(add_dimension, (sli_plan_parts){.dimensions = 5});
    assert_found(add_axis, (sli_plan_parts){.across = 1});
    assert_found(add_legend, (sli_plan_parts){.beside = 6});
    assert_found(add_beds, (sli_plan_parts){.loose = 12, .pieces = 4});
    assert_found(add_tiles, (sli_plan_parts){.tiles = 8 * (8 * 4 + 3)});
}

static void add_all(drawing *d) {
    add_double_frame(d);
    add_dimension(d);
    add_axis(d);
    add_legend(d);
    add_beds(d);
}

static void test_all_together(void **state) {
    (void)state;
    assert_found(
        add_all,
        (sli_plan_parts){
            .frame = 8, .dimensions = 5, .across = 1, .beside = 6, .loose = 12, .pieces = 4});
}

// --- what is kept

/// A column, obstacles that are plain boxes, a stub of a wall, a window, a wall by one line.
static void add_walls(drawing *d) {
    box(d, 6, 1, 6.3, 1.3);
    box(d, 5, 2, 5.8, 2.7);
    box(d, 9, 5, 9.2, 6.5);
    line(d, 9, 1, 11, 1);
    line(d, 1.2, 4.2, 1.2, 7.8);
    line(d, 5, 8, 7, 8);
}

/// A hall in a yard: drawn by one line, the wall of the yard is no pair.
static void test_kept(void **state) {
    (void)state;
    assert_found(add_walls, (sli_plan_parts){0});
    drawing d = {.context = testing_context(NULL)};
    sli_plan_parts found = {0};
    // Rooms by one line each, with furniture: nothing is known of walls.
    for (int i = 0; i < 6; i++) box(&d, 4 * i, 0, 4 * i + 4, 5);
    bed(&d, 1, 1);
    bed(&d, 5, 1);
    assert_ok(d.context, sli_plan_parts_find(d.context, &d.map, 1, &found));
    assert_int_equal(sli_plan_parts_count(&found), 0);
    sli_plan_parts_destroy(d.context, &found);
    sl_map_destroy(d.context, &d.map);
    // Rooms in rows and columns, by their inner faces, without doors: their walls are no joints.
    for (int i = 0; i < 120; i++) {
        const double x = 4 * (double)(i % 12), y = 4 * (double)(i / 12);
        box(&d, x, y, x + 3.88, y + 3.88);
    }
    assert_ok(d.context, sli_plan_parts_find(d.context, &d.map, 1, &found));
    assert_int_equal(found.tiles, 0);
    sli_plan_parts_destroy(d.context, &found);
    sl_map_destroy(d.context, &d.map);
    // A hall with boxes in it: the outer face of its wall is no frame.
    box(&d, 0, 0, 20, 10);
    box(&d, 0.3, 0.3, 19.7, 9.7);
    for (int i = 0; i < 8; i++) box(&d, 2 + 2 * i, 3, 3 + 2 * i, 4);
    assert_ok(d.context, sli_plan_parts_find(d.context, &d.map, 1, &found));
    assert_int_equal(sli_plan_parts_count(&found), 0);
    sli_plan_parts_destroy(d.context, &found);
    sl_map_destroy(d.context, &d.map);
    sl_context_destroy(d.context);
}

/// What is not told by pairs is measured.
static void test_rest(void **state) {
    (void)state;
    for (int wires = 0; wires < 2; wires++) {
        drawing d = {.context = testing_context(NULL)};
        sli_plan_parts found = {0};
        house(&d);
        for (int i = 0; wires && i < 60; i++) line(&d, 4.2, 0.3, 7.8, 0.4 + 0.05 * i);
        assert_ok(d.context, sli_plan_parts_find(d.context, &d.map, 1, &found));
        assert_true(wires ? found.rest > 0.5 : found.rest < 0.1);
        sli_plan_parts_destroy(d.context, &found);
        sl_map_destroy(d.context, &d.map);
        sl_context_destroy(d.context);
    }
}

static void test_memory(void **state) {
    (void)state;
    drawing d = {.context = testing_context(NULL)};
    house(&d);
    add_all(&d);
    sl_status status = SL_NO_MEMORY;
    for (long failing = 2; status == SL_NO_MEMORY; failing++) {
        testing_memory memory = {.fail_at = failing};
        sl_context *context = testing_context(&memory);
        sli_plan_parts found = {0};
        status = sli_plan_parts_find(context, &d.map, 1, &found);
        sli_plan_parts_destroy(context, &found);
        sl_context_destroy(context);
        assert_int_equal(memory.live, 0);
    }
    assert_int_equal(status, SL_OK);
    sl_map_destroy(d.context, &d.map);
    sl_context_destroy(d.context);
}

/// What is too dense to look at is said to be so, and is not taken for looked at.
static void test_crowded(void **state) {
    (void)state;
    drawing d = {.context = testing_context(NULL)};
    sli_plan_look look;
    house(&d);
    assert_ok(d.context, sli_plan_look_at(d.context, &d.map, 1, 0, &look));
    assert_true(!look.crowded && look.walls == d.map.wall_count && look.closed > 0);
    for (int i = 0; i < 6000; i++) line(&d, 0, 0.001 * i, 12, 6 - 0.001 * i);
    assert_ok(d.context, sli_plan_look_at(d.context, &d.map, 1, 0, &look));
    assert_true(look.crowded && look.walls == 0);
    sl_map_destroy(d.context, &d.map);
    assert_ok(d.context, sli_plan_look_at(d.context, &d.map, 1, 0, &look));
    assert_false(look.crowded);
    sl_context_destroy(d.context);
}

/// The boundary of a site is told, at any turn; a house alone and a room about it are none.
static void test_site(void **state) {
    (void)state;
    static const struct {
        double ring[5][2];
        bool site;
    } cases[] = {{{{-8, -6}, {20, -9}, {24, 14}, {3, 18}, {-9, 12}}, true},
                 {{{-1, -1}, {13, -1}, {13, 9}, {6, 9.2}, {-1, 9}}, false},
                 {{{-8, -6}, {20, -9}, {24, 14}, {6, 7}, {-9, 12}}, false}};
    for (int i = 0; i < 6; i++) {
        drawing d = {.context = testing_context(NULL)};
        const double angle = i % 2 ? 17.3 * 0.017453292519943295 : 0, c = cos(angle),
                     s = sin(angle);
        sli_plan_look look;
        house(&d);
        d.item++;
        for (int k = 0; k < 5; k++) {
            const double *a = cases[i / 2].ring[k], *b = cases[i / 2].ring[(k + 1) % 5];
            add_line(&d, a[0], a[1], b[0], b[1]);
        }
        for (size_t k = 0; k < d.map.wall_count; k++) {
            sl_wall *w = &d.map.walls[k];
            w->a = (sl_point){c * w->a.x - s * w->a.y, s * w->a.x + c * w->a.y};
            w->b = (sl_point){c * w->b.x - s * w->b.y, s * w->b.x + c * w->b.y};
        }
        assert_ok(d.context, sli_plan_look_at(d.context, &d.map, 1, 0, &look));
        assert_int_equal(look.site, cases[i / 2].site);
        sl_map_destroy(d.context, &d.map);
        sl_context_destroy(d.context);
    }
}

/// Desks in two columns look like walls by their faces. The room beside them is larger, so it is no
/// legend.
static void test_room_beside_desks(void **state) {
    (void)state;
    drawing d = {.context = testing_context(NULL)};
    sli_plan_parts found = {0};
    for (int i = 0; i < 16; i++) {
        const double x = 7.4 + 1.28 * (i % 2), y = 0.84 * (double)(i / 2);
        box(&d, x, y, x + 0.98, y + 0.55);
    }
    box(&d, 0, 0.5, 6.4, 5.4);
    line(&d, 0, 3, 0.5, 3);
    assert_ok(d.context, sli_plan_parts_find(d.context, &d.map, 0, &found));
    assert_int_equal(sli_plan_parts_count(&found), 0);
    sli_plan_parts_destroy(d.context, &found);
    sl_map_destroy(d.context, &d.map);
    sl_context_destroy(d.context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_room_beside_desks),
        cmocka_unit_test(test_found),
        cmocka_unit_test(test_all_together),
        cmocka_unit_test(test_kept),
        cmocka_unit_test(test_rest),
        cmocka_unit_test(test_memory),
        cmocka_unit_test(test_crowded),
        cmocka_unit_test(test_site),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

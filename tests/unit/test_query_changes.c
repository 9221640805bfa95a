/// Doors open and shut in place: after any changes a query's rows are those cut to what is left,
/// and its walls those of a space made anew. Also what is out of range, and rows backwards. What an
/// eye sees is in test_query_matrix.c.
#include "effects/filtered.h"
#include "testing.h"

#include "map/scan.h"
#include "sightline/bake.h"
#include "sightline/effects.h"
#include "sightline/support.h"

#include <math.h>

enum { ROOMS = 5, SIDE = 8, MAPS = 6, CHANGES = 40 };

/// A grid of rooms. Between two of them: a door, glass, glass both ways, a door with glass in it,
/// or a gap. `turned`: by the exact turn (4, 3), so that walls are oblique.
typedef struct plan {
    char text[16384];
    size_t length;
    bool turned;
    sl_random random;
} plan;

static void put(plan *p, const char *what, double x, double y, double to_x, double to_y,
                const char *more) {
    const double c = p->turned ? 4 : 1, s = p->turned ? 3 : 0;
    p->length += (size_t)snprintf(p->text + p->length, sizeof p->text - p->length,
                                  "%s %g %g %g %g%s\n", what, c * x - s * y, s * x + c * y,
                                  c * to_x - s * to_y, s * to_x + c * to_y, more);
    assert_true(p->length < sizeof p->text);
}

/// A wall between two rooms with something in the middle.
static void put_between(plan *p, double x, double y, bool upright) {
    const double dx = upright ? 0 : 1, dy = upright ? 1 : 0;
    const double from = 2 + (double)sl_random_below(&p->random, 2), to = from + 3;
    char door[32], named[64];
    put(p, "wall", x, y, x + dx * from, y + dy * from, "");
    put(p, "wall", x + dx * to, y + dy * to, x + dx * SIDE, y + dy * SIDE, "");
    const double ax = x + dx * from, ay = y + dy * from, bx = x + dx * to, by = y + dy * to;
    snprintf(door, sizeof door, "door d%u", (unsigned)sl_random_below(&p->random, 12));
    snprintf(named, sizeof named, " %s", sl_random_below(&p->random, 2) ? "open" : "shut");
    const unsigned kind = (unsigned)sl_random_below(&p->random, 8);
    if (kind < 4 || kind == 7) put(p, door, ax, ay, bx, by, named);
    if (kind == 4 || kind == 6 || kind == 7) put(p, "oneway", ax, ay, bx, by, "");
    if (kind == 5 || kind == 6) put(p, "oneway", bx, by, ax, ay, "");
}

static void bake_rooms(sl_context *context, uint64_t seed, bool turned, sl_baked *out) {
    plan p = {.turned = turned, .random = {seed}};
    const double all = ROOMS * SIDE;
    p.length = (size_t)snprintf(p.text, sizeof p.text, "sightline 1\n");
    put(&p, "wall", 0, 0, all, 0, "");
    put(&p, "wall", all, 0, all, all, "");
    put(&p, "wall", all, all, 0, all, "");
    put(&p, "wall", 0, all, 0, 0, "");
    for (int i = 0; i < ROOMS; i++)
        for (int k = 1; k < ROOMS; k++) {
            put_between(&p, k * SIDE, i * SIDE, true);
            put_between(&p, i * SIDE, k * SIDE, false);
        }
    sl_map map = {0};
    assert_ok(context, sli_map_read_text(context, "rooms", p.text, p.length, &map));
    assert_ok(context, sl_bake(context, &map, NULL, out, NULL));
}

/// What a query is compared with: made anew for each state of the doors.
typedef struct fresh {
    sl_space shut, space;
    sl_visibility rows;
} fresh;

static void make_fresh(sl_context *context, const sl_baked *baked, const bool *shut, fresh *f) {
    const sli_filtered_space glass = {.one_way = true, .dark_walls = true};
    *f = (fresh){0};
    assert_ok(context, sl_baked_shut(context, baked, shut, &f->shut, &f->rows));
    assert_ok(context, sli_filtered_space_make(context, &f->shut, &glass, NULL, &f->space));
}

static void destroy_fresh(sl_context *context, fresh *f) {
    sl_visibility_destroy(context, &f->rows);
    sl_space_destroy(context, &f->space);
    sl_space_destroy(context, &f->shut);
}

static sl_point any_point(sl_random *random, const sl_space *space) {
    if (sl_random_below(random, 4) == 0)
        return space->vertices[sl_random_below(random, space->vertex_count)];
    const sl_box b = space->bounds;
    return (sl_point){b.min.x + sl_random_unit(random) * (b.max.x - b.min.x),
                      b.min.y + sl_random_unit(random) * (b.max.y - b.min.y)};
}

/// The walls that stand are those of the space made anew.
static void same_walls(sl_context *context, sl_query *query, const sl_space *wanted) {
    const sl_space *space;
    uint32_t standing = 0;
    assert_ok(context, sl_query_space(context, query, &space, NULL));
    for (uint32_t i = 0; i < space->wall_count; i++)
        standing += memcmp(&space->walls[i].a, &space->walls[i].b, sizeof(sl_point)) != 0;
    assert_int_equal(standing, wanted->wall_count);
}

static void same_rows(sl_context *context, sl_query *query, const fresh *f) {
    const uint32_t count = sl_query_asked(query)->cell_count;
    uint64_t row[64];
    assert_true(sl_eye_words(sl_query_asked(query)) <= 64);
    for (uint32_t from = 0; from < count; from += 7) {
        assert_ok(context, sl_query_row(context, query, from, false, row));
        for (uint32_t to = 0; to < count; to++) {
            bool sees;
            assert_int_equal(sl_eye_sees(row, to), sl_pvs_sees(&f->rows.pvs, from, to));
            assert_ok(context, sl_query_can_see(context, query, from, to, &sees));
            assert_int_equal(sees, sl_eye_sees(row, to));
        }
    }
}

static void doors_in_place_leave_the_rows_of_new_spaces(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    for (uint64_t seed = 1; seed <= MAPS; seed++) {
        sl_random random = {seed};
        sl_baked baked = {0};
        sl_query *query;
        bake_rooms(context, seed, seed % 2, &baked);
        const sl_map *map = &baked.map;
        bool *shut = calloc(map->door_count, sizeof *shut);
        assert_true(shut && map->door_count && map->oneway_count);
        assert_ok(context, sl_query_create(context, &baked, &query));
        for (int change = 0; change < CHANGES; change++) {
            const char *name = map->doors[sl_random_below(&random, map->door_count)].name;
            const bool open = sl_random_below(&random, 2);
            if (change % 10 == 9)
                sl_query_set_doors(context, query, open);
            else if (change % 10 == 7)
                sl_query_set_door_at(context, query, sl_random_below(&random, map->door_count),
                                     open);
            else if (change)
                assert_ok(context, sl_query_set_door(context, query, name, open));
            for (size_t d = 0; d < map->door_count; d++) shut[d] = !sl_query_door_is_open(query, d);
            if (change % 4) continue;
            fresh f;
            make_fresh(context, &baked, shut, &f);
            same_rows(context, query, &f);
            same_walls(context, query, &f.space);
            destroy_fresh(context, &f);
        }
        sl_query_destroy(context, query);
        sl_baked_destroy(context, &baked);
        free(shut);
    }
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

/// A query without a bake, a bake that ends later, and one that is given up.
static void visible_sets_may_come_later(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_random random = {1};
    sl_baked baked = {0};
    sl_query *query;
    uint64_t cells[64];
    bake_rooms(context, 1, true, &baked);
    bool *shut = calloc(baked.map.door_count, sizeof *shut);
    assert_non_null(shut);
    const sl_view view = sl_view_all_round(any_point(&random, &baked.space));
    assert_ok(context, sl_query_over(context, &baked.space, &baked.map, NULL, &query));
    sl_query_set_doors(context, query, false);
    for (size_t d = 0; d < baked.map.door_count; d++) shut[d] = true;
    assert_int_equal(
        sl_query_look(context, query, &view, sl_eye_methods(&(size_t){0}), cells, NULL),
        SL_BAD_ARGUMENT);
    assert_ok(context, sl_query_set_visibility(context, query, &baked.visibility));
    fresh f;
    make_fresh(context, &baked, shut, &f);
    same_rows(context, query, &f);
    destroy_fresh(context, &f);
    assert_ok(context, sl_query_set_visibility(context, query, NULL));
    assert_int_equal(sl_query_row(context, query, 0, false, cells), SL_BAD_ARGUMENT);
    sl_query_destroy(context, query);
    sl_baked_destroy(context, &baked);
    free(shut);
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

/// Cells out of range: none that the exact method keeps, and all that are so by a distance that is
/// counted with room for rounding.
static void far_cells_are_dropped(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const double range = 10;
    sl_random random = {1};
    sl_baked baked = {0};
    sl_query *query;
    size_t dropped = 0;
    bake_rooms(context, 2, false, &baked);
    const sl_space *space = &baked.space;
    assert_ok(context, sl_query_create(context, &baked, &query));
    assert_ok(context, sl_query_set_range(context, query, range));
    for (int i = 0; i < 100; i++) {
        const sl_point eye = any_point(&random, space);
        const sl_view view = sl_query_view(query, eye, 0, 360);
        uint64_t cells[64] = {0}, exact[64];
        assert_true(sl_eye_words(space) <= 64);
        for (uint32_t c = 0; c < space->cell_count; c++) sl_bits_add(cells, c);
        sl_query_drop_far(query, eye, cells);
        assert_ok(context, sl_query_look(context, query, &view, NULL, exact, NULL));
        for (uint32_t c = 0; c < space->cell_count; c++) {
            // Cells of this map are boxes.
            const sl_point *at = space->vertices + space->cells[c].first_vertex;
            const double x = fmax(fmax(at[0].x - eye.x, eye.x - at[2].x), 0);
            const double y = fmax(fmax(at[0].y - eye.y, eye.y - at[2].y), 0);
            const double away = hypot(x, y);
            dropped += !sl_eye_sees(cells, c);
            if (away < range - 1e-9) assert_true(sl_eye_sees(cells, c));
            if (away > range + 1e-9) assert_false(sl_eye_sees(cells, c));
            if (sl_eye_sees(exact, c)) assert_true(sl_eye_sees(cells, c));
        }
    }
    assert_true(dropped > 100);
    sl_query_destroy(context, query);
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
}

/// Backwards, a row has the cells that see it.
static void backwards_a_row_has_those_that_see_it(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    for (uint64_t seed = 1; seed <= MAPS; seed++) {
        sl_baked baked = {0};
        sl_query *query;
        uint64_t cells[64];
        bake_rooms(context, seed, seed % 2, &baked);
        assert_ok(context, sl_query_create(context, &baked, &query));
        assert_true(sl_eye_words(&baked.space) <= 64);
        for (uint32_t to = 0; to < baked.space.cell_count; to += 7) {
            sl_query_set_backwards(context, query, true);
            assert_ok(context, sl_query_row(context, query, to, false, cells));
            sl_query_set_backwards(context, query, false);
            for (uint32_t from = 0; from < baked.space.cell_count; from++) {
                bool sees;
                assert_ok(context, sl_query_can_see(context, query, from, to, &sees));
                assert_int_equal(sees, sl_eye_sees(cells, from));
            }
        }
        sl_query_destroy(context, query);
        sl_baked_destroy(context, &baked);
    }
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(doors_in_place_leave_the_rows_of_new_spaces),
        cmocka_unit_test(visible_sets_may_come_later),
        cmocka_unit_test(far_cells_are_dropped),
        cmocka_unit_test(backwards_a_row_has_those_that_see_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

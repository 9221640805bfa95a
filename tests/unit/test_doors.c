/// Doors of a large plan: every state of them is seen as a bake is that has walls in those that are
/// shut, by the library and by the runtime for games.
#include "baked_bytes.h"
#include "effects/filtered.h"
#include "runtime_maps.h"

#include "cell_to_cell/search/door_table.h"
#include "doors_plan.h"
#include "sightline/support.h"
#include "space/subdivide.h"

enum { STATES = 1000 };

static void bake(sl_context *context, baked_file *f) {
    sl_baked *b = &f->baked;
    *f = (baked_file){.name = "doors", .baked = {.method = "prune", .solver = "funnel"}};
    assert_ok(context, doors_plan(context, &b->map));
    assert_int_equal(b->map.door_count, DOORS);
    const sl_subdivide_options rules = sl_subdivide_options_default();
    assert_ok(context, sl_map_clean(context, &b->map, NULL, NULL));
    assert_ok(context, sli_subdivide_kd(context, &b->map, &rules, &b->space));
    sl_plan plan = sl_plan_make(&b->map);
    plan.door_limit = 200;
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    options.plan = &plan;
    assert_ok(context, testing_method("prune")->see(context, &b->space, &options, &b->visibility));
    assert_int_equal(b->visibility.account.effects.door_fallbacks, 0);
    f->bytes = baked_bytes(context, b, &f->size);
    baked_file_open(f);
    assert_int_equal(f->runtime.door_count, DOORS);
}

static void compare(sl_context *context, const baked_file *f, const bool *shut) {
    const sl_space *space = &f->baked.space;
    const sl_visibility *v = &f->baked.visibility;
    sl_space walled;
    sl_visibility fresh = {0};
    const sli_filtered_space filtered = {.shut = shut};
    sl_see_options options = sl_see_options_default();
    unsigned char bytes[DOORS];
    for (int i = 0; i < DOORS; i++) bytes[i] = shut[i];
    assert_ok(context, sli_filtered_space_make(context, space, &filtered, NULL, &walled));
    assert_ok(context, testing_method("sweep")->see(context, &walled, &options, &fresh));
    for (uint32_t a = 0; a < space->cell_count; a++)
        for (uint32_t b = 0; b < space->cell_count; b++) {
            const bool sees = sl_pvs_sees(&fresh.pvs, a, b);
            assert_int_equal(sees, sl_pvs_sees(&v->pvs, a, b) &&
                                       sli_door_sets_open(&v->doors, a, b, shut));
            assert_int_equal(sees, sl_runtime_can_see_past(&f->runtime, a, b, bytes));
            assert_int_equal(sl_runtime_can_see(&f->runtime, a, b),
                             sl_runtime_can_see_past(&f->runtime, a, b, NULL));
        }
    sl_visibility_destroy(context, &fresh);
    sl_space_destroy(context, &walled);
}

/// A pair is open as one of its alternatives is.
static void compare_alternatives(const baked_file *f, const bool *shut) {
    const sl_door_sets *sets = &f->baked.visibility.doors;
    for (uint32_t a = 0; a < sets->cell_count; a++)
        for (uint32_t b = 0; b < sets->cell_count; b++) {
            bool open = !sl_door_sets_alternative(sets, a, b, 0, NULL);
            bool doors[DOORS] = {false};
            for (uint32_t i = 0; sl_door_sets_alternative(sets, a, b, i, doors); i++) {
                bool good = true, any = false;
                for (int k = 0; k < DOORS; k++) {
                    good &= !doors[k] || !shut[k];
                    any |= doors[k];
                    doors[k] = false;
                }
                assert_true(any);
                open |= good;
            }
            assert_int_equal(open, sli_door_sets_open(sets, a, b, shut));
        }
}

static void states_are_as_fresh_bakes(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {30};
    baked_file f;
    bake(context, &f);
    for (int i = 0; i < STATES; i++) {
        bool shut[DOORS];
        // From few doors shut to nearly all.
        for (int k = 0; k < DOORS; k++) shut[k] = sl_random_below(&random, 10) < (uint64_t)(i % 10);
        compare(context, &f, shut);
        if (i < 20) compare_alternatives(&f, shut);
    }
    print_message("%u cells, %llu pairs, %.2f bytes of door sets a pair\n",
                  f.baked.space.cell_count, (unsigned long long)f.baked.visibility.account.pairs,
                  (double)sl_door_sets_bytes(&f.baked.visibility.doors) /
                      (double)f.baked.visibility.account.pairs);
    sl_baked_destroy(context, &f.baked);
    free(f.bytes);
    sl_context_destroy(context);
}

/// Pairs that need more sets of doors than are kept count as seen, and are counted.
static void what_is_beyond_the_limit_counts_as_seen(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    baked_file f;
    bake(context, &f);
    sl_plan plan = sl_plan_make(&f.baked.map);
    plan.door_limit = 1;
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    options.plan = &plan;
    sl_visibility few = {0};
    assert_ok(context, testing_method("dfs")->see(context, &f.baked.space, &options, &few));
    assert_true(few.account.effects.door_fallbacks > 0);
    bool shut[DOORS] = {false};
    for (int i = 0; i < DOORS; i += 2) shut[i] = true;
    for (uint32_t a = 0; a < few.pvs.cell_count; a++)
        for (uint32_t b = 0; b < few.pvs.cell_count; b++)
            if (sli_door_sets_open(&f.baked.visibility.doors, a, b, shut))
                assert_true(sli_door_sets_open(&few.doors, a, b, shut));
    sl_visibility_destroy(context, &few);
    sl_baked_destroy(context, &f.baked);
    free(f.bytes);
    sl_context_destroy(context);
}

/// Two doors and a seam in one place: each door shuts it.
static void doors_in_one_place_shut_it_each(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space;
    testing_space(context,
                  "walls 0 0 8 0 8 4 0 4 0 0\nwall 4 0 4 1\nwall 4 3 4 4\n"
                  "door one 4 1 4 3 open\nseam 4 1 4 3\ndoor other 4 1 4 3 open\n",
                  &map, &space);
    assert_int_equal(map.door_count, 2);
    for (int shut = 0; shut < 4; shut++) {
        const bool doors[2] = {shut & 1, shut & 2};
        const sli_filtered_space filtered = {.shut = doors};
        sl_space walled;
        assert_ok(context, sli_filtered_space_make(context, &space, &filtered, NULL, &walled));
        assert_int_equal(space.portal_count - walled.portal_count, shut ? 1 : 0);
        sl_space_destroy(context, &walled);
    }
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// Among oblique walls the sides of cells tell what is beyond them: shut doors are walls there too.
static void shut_doors_are_walls_of_sides(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space, walled;
    testing_space(context,
                  "walls 0 0 8 0 8 4 0 4 0 0\nwall 3 0 3.5 1\nwall 4.5 3 5 4\n"
                  "door d 3.5 1 4.5 3 open\n",
                  &map, &space);
    assert_non_null(space.neighbour);
    const bool shut = true;
    const sli_filtered_space filtered = {.shut = &shut};
    assert_ok(context, sli_filtered_space_make(context, &space, &filtered, NULL, &walled));
    assert_ok(context, sl_space_check(context, &walled));
    uint32_t left = 0, right = 0;
    for (uint32_t i = 0; i < space.vertex_count; i++) {
        if (space.neighbour[i] == walled.neighbour[i]) continue;
        const uint32_t wall = walled.neighbour[i] & ~SL_NEIGHBOUR_RIGHT;
        const bool at_right = walled.neighbour[i] & SL_NEIGHBOUR_RIGHT;
        assert_int_equal(space.neighbour[i], SL_NEIGHBOUR_PORTAL);
        assert_true(wall >= space.wall_count && wall < walled.wall_count);
        // Cells are at the left of their sides: at the right of a wall that runs against these.
        const sl_point a = walled.walls[wall].a, from = walled.vertices[i];
        assert_int_equal(at_right, a.x != from.x || a.y != from.y);
        left += !at_right;
        right += at_right;
    }
    assert_true(left > 0 && left == right);
    sl_space_destroy(context, &walled);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// Sets of doors that do not fit into one word: the smallest ones are kept.
static void sets_of_many_doors_are_told_apart(void **state) {
    (void)state;
    enum { MANY = 150, LIMIT = 3 };
    sl_context *context = testing_context(NULL);
    sli_door_table table;
    assert_ok(context, sli_door_table_create(context, 1, MANY, LIMIT, &table));
    sl_bits low[3] = {0}, both[3] = {0}, high[3] = {0};
    sl_bits_add(low, 1);
    sl_bits_add(both, 1);
    sl_bits_add(both, 149);
    sl_bits_add(high, 100);
    assert_ok(context, sli_door_table_add(context, &table, 0, both));
    assert_true(sli_door_table_proves(&table, 0, both));
    assert_false(sli_door_table_proves(&table, 0, low));
    assert_ok(context, sli_door_table_add(context, &table, 0, high));
    assert_int_equal(table.count[0], 2);
    assert_false(sli_door_table_proves(&table, 0, low));
    assert_ok(context, sli_door_table_add(context, &table, 0, low)); // in the place of both
    assert_int_equal(table.count[0], 2);
    assert_true(sli_door_table_proves(&table, 0, low) && sli_door_table_proves(&table, 0, high));
    assert_int_equal(table.fallbacks, 0);
    sli_door_table_destroy(context, &table);
    sl_context_destroy(context);
}

static void damaged_sets_are_refused(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const struct {
        uint8_t bytes[6];
        uint64_t size;
        bool sound;
    } rows[] = {
        {{0, 1, 1, 0}, 4, true},       // cell 0, one set, of door 0
        {{1, 2, 1, 0, 1, 2}, 6, true}, // cell 1: door 0, or door 2
        {{0, 1, 1, 3}, 4, false},      // there is no door 3
        {{2, 1, 1, 0}, 4, false},      // nor cell 2
        {{0, 0}, 2, false},            // no set
        {{0, 1, 0}, 3, false},         // a set of no door
        {{0, 1, 2, 0}, 4, false},      // cut short
        {{0, 1, 1, 0x80}, 4, false},   // in the middle of a number
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        uint64_t offsets[3] = {0, rows[i].size, rows[i].size};
        uint8_t bytes[6];
        memcpy(bytes, rows[i].bytes, sizeof bytes);
        const sl_door_sets sets = {.cell_count = 2, .offsets = offsets, .bytes = bytes};
        assert_int_equal(sli_door_sets_check(context, &sets, 3),
                         rows[i].sound ? SL_OK : SL_BAD_INPUT);
    }
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(states_are_as_fresh_bakes),
        cmocka_unit_test(what_is_beyond_the_limit_counts_as_seen),
        cmocka_unit_test(doors_in_one_place_shut_it_each),
        cmocka_unit_test(shut_doors_are_walls_of_sides),
        cmocka_unit_test(sets_of_many_doors_are_told_apart),
        cmocka_unit_test(damaged_sets_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

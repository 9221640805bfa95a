// The BSP over oblique walls: cells that are sound whatever the walls are, and nothing lost that
// the walls leave free.
#include "testing.h"

#include "bake/slv.h"
#include "geometry/orient.h"
#include "oracle/oracle.h"
#include "oracle/random_oblique.h"
#include "sightline/solvers.h"

#include <math.h>

typedef struct scene {
    sl_context *context;
    sl_map map;
    sl_space space;
} scene;

static void subdivide(scene *s) {
    const sl_bsp_options options = sl_bsp_options_default();
    assert_ok(s->context, sl_subdivide_bsp(s->context, &s->map, &options, &s->space));
    assert_ok(s->context, sl_space_check(s->context, &s->space));
}

static scene from_text(const char *statements) {
    scene s = {.context = testing_context(NULL)};
    char text[4096];
    const int size = snprintf(text, sizeof text, "sightline 1\n%s", statements);
    assert_ok(s.context, sl_map_read_text(s.context, "test", text, (size_t)size, &s.map));
    subdivide(&s);
    return s;
}

static scene from_seed(uint64_t seed, oblique_grid grid, uint64_t most) {
    scene s = {.context = testing_context(NULL)};
    assert_ok(s.context, oblique_random_map(s.context, seed, grid, most, &s.map));
    subdivide(&s);
    return s;
}

static void end(scene *s) {
    sl_space_destroy(s->context, &s->space);
    sl_map_destroy(s->context, &s->map);
    sl_context_destroy(s->context);
}

static sl_visibility see(scene *s, const char *name, sl_sight sight) {
    size_t count;
    const sl_see_method *method = sl_see_methods(&count);
    while (strcmp(method->name, name) != 0) method++;
    sl_see_options options = sl_see_options_default();
    options.sight = sight;
    options.solver = method->stabs ? sl_funnel() : NULL;
    options.threads = 1;
    sl_visibility visibility = {0};
    assert_ok(s->context, method->see(s->context, &s->space, &options, &visibility));
    return visibility;
}

static bool sees(scene *s, const sl_visibility *v, sl_point p, sl_point q) {
    return sl_pvs_sees(&v->pvs, sl_space_locate(&s->space, p), sl_space_locate(&s->space, q));
}

// --- sound

static void any_walls_give_a_sound_space(void **state) {
    (void)state;
    for (int grid = 0; grid < OBLIQUE_GRIDS; grid++)
        for (uint64_t seed = 0; seed < 60; seed++) {
            scene s = from_seed(seed, (oblique_grid)grid, 20);
            end(&s);
        }
}

static void cells_fill_the_bounds(void **state) {
    (void)state;
    const oblique_grid grids[] = {OBLIQUE_SQUARES, OBLIQUE_ANYWHERE, OBLIQUE_TENTHS, OBLIQUE_DOOM};
    for (size_t g = 0; g < 4; g++)
        for (uint64_t seed = 100; seed < 150; seed++) {
            scene s = from_seed(seed, grids[g], 15);
            const sl_box *b = &s.space.bounds;
            const double whole = (b->max.x - b->min.x) * (b->max.y - b->min.y);
            double sum = 0;
            for (uint32_t i = 0; i < s.space.cell_count; i++) sum += sl_space_area(&s.space, i);
            assert_true(fabs(sum / whole - 1) < 1e-9);
            end(&s);
        }
}

static void the_same_walls_give_the_same_space(void **state) {
    (void)state;
    scene a = from_seed(7, OBLIQUE_TENTHS, 30), b = from_seed(7, OBLIQUE_TENTHS, 30);
    assert_int_equal(a.space.vertex_count, b.space.vertex_count);
    assert_memory_equal(a.space.vertices, b.space.vertices,
                        a.space.vertex_count * sizeof *a.space.vertices);
    assert_memory_equal(a.space.exits, b.space.exits, a.space.exit_count * sizeof *a.space.exits);
    end(&a);
    end(&b);
}

// --- nothing lost

static void no_free_sightline_is_lost(void **state) {
    (void)state;
    sl_random random = {21};
    uint64_t free_count = 0;
    for (int grid = 0; grid < OBLIQUE_SANE; grid++)
        for (uint64_t seed = 200; seed < 230; seed++) {
            scene s = from_seed(seed, (oblique_grid)grid, 12);
            sl_visibility v = see(&s, "sweep", SL_CLOSED);
            for (int i = 0; i < 400; i++) {
                const sl_point p = oblique_random_point(&random, &s.map, s.space.bounds),
                               q = oblique_random_point(&random, &s.map, s.space.bounds);
                if (sl_space_locate(&s.space, p) == SL_NO_CELL ||
                    sl_space_locate(&s.space, q) == SL_NO_CELL || !oblique_is_free(&s.map, p, q))
                    continue;
                free_count++;
                if (!sees(&s, &v, p, q))
                    fail_msg("grid %d, seed %d: lost from %.17g %.17g to %.17g %.17g", grid,
                             (int)seed, p.x, p.y, q.x, q.y);
            }
            sl_visibility_destroy(s.context, &v);
            end(&s);
        }
    assert_true(free_count > 10000);
}

/// Whether a cell that holds one point sees one that holds the other.
static bool some_see(const scene *s, const sl_visibility *v, sl_point p, sl_point q) {
    for (uint32_t a = 0; a < s->space.cell_count; a++)
        for (uint32_t b = 0; b < s->space.cell_count; b++) {
            bool hold = sl_pvs_sees(&v->pvs, a, b);
            for (int k = 0; k < 2 && hold; k++) {
                const sl_cell *cell = &s->space.cells[k ? b : a];
                const sl_point *corners = s->space.vertices + cell->first_vertex;
                for (uint32_t i = 0; i < cell->vertex_count; i++)
                    hold &= sl_orient(corners[i], corners[(i + 1) % cell->vertex_count],
                                      k ? q : p) >= 0;
            }
            if (hold) return true;
        }
    return false;
}

/// Where the whole map is some steps of doubles wide, more than one cell may hold a point, and the
/// one located need not be the one that sees.
static void nor_in_maps_of_a_few_steps(void **state) {
    (void)state;
    sl_random random = {22};
    for (int grid = OBLIQUE_SANE; grid < OBLIQUE_GRIDS; grid++)
        for (uint64_t seed = 300; seed < 330; seed++) {
            scene s = from_seed(seed, (oblique_grid)grid, 8);
            sl_visibility v = see(&s, "sweep", SL_CLOSED);
            for (int i = 0; i < 60; i++) {
                const sl_point p = oblique_random_point(&random, &s.map, s.space.bounds),
                               q = oblique_random_point(&random, &s.map, s.space.bounds);
                if (sl_space_locate(&s.space, p) == SL_NO_CELL ||
                    sl_space_locate(&s.space, q) == SL_NO_CELL || !oblique_is_free(&s.map, p, q) ||
                    sees(&s, &v, p, q))
                    continue;
                assert_true(some_see(&s, &v, p, q));
            }
            sl_visibility_destroy(s.context, &v);
            end(&s);
        }
}

// --- nothing added

static void walls_that_touch_part_rooms(void **state) {
    (void)state;
    const struct {
        const char *map;
        sl_point one, other;
    } cases[] = {
        // A partition that ends on two oblique walls' insides, at points exactly on them
        {"walls 0 0 30 10 20 40 -10 30 0 0\nwall 15 5 5 35\n", {0, 20}, {20, 20}},
        // The same where no double is on the walls: it ends behind them
        {"walls 0 0 3.1 1.03 2.07 4.13 -1.03 3.1 0 0\nwall 1.6 0.5 0.5 3.7\n", {0, 1.5}, {2, 2}},
        // Two diagonals: four rooms
        {"walls 0 0 7 0 7 5 0 5 0 0\nwall 0 0 7 5\nwall 0 5 7 0\n", {3.5, 1}, {3.5, 4}},
        // Two that overlap
        {"walls 0 0 9 0 9 6 0 6 0 0\nwall 0 0 6 4\nwall 3 2 9 6\nwall 0 0 6 4\n", {7, 1}, {1, 5}},
        // A triangle of needles
        {"walls 0 0 9 0 9 6 0 6 0 0\nwalls 1 1 8 1.0000001 8 1 1 1\nwall 0 1 9 1\n",
         {4, 0.5},
         {4, 3}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        scene s = from_text(cases[i].map);
        sl_visibility v = see(&s, "dfs", SL_CLOSED);
        if (sees(&s, &v, cases[i].one, cases[i].other)) fail_msg("case %zu leaks", i);
        sl_visibility_destroy(s.context, &v);
        end(&s);
    }
}

enum { RAYS = 24 };

/// The tip of a ray, exactly across from that of another.
static sl_point tip_of(int ray) {
    const int half = RAYS / 2, one = ray % half;
    const double sign = ray / half % 2 ? -1 : 1, angle = acos(-1) * one / half;
    return (sl_point){sign * 10 * cos(angle), sign * 10 * sin(angle)};
}

static void no_two_sectors_of_a_star_see_each_other(void **state) {
    (void)state;
    const double turn = 2 * acos(-1);
    scene s = {.context = testing_context(NULL)};
    for (int i = 0; i < RAYS; i++) {
        const sl_point tip = tip_of(i), next = tip_of(i + 1);
        assert_ok(s.context, sl_map_add_wall(s.context, &s.map, tip, next, 0));
        if (i < RAYS / 2)
            assert_ok(s.context,
                      sl_map_add_wall(s.context, &s.map, tip, (sl_point){-tip.x, -tip.y}, 0));
    }
    subdivide(&s);
    sl_visibility v = see(&s, "sweep", SL_OPEN);
    for (int i = 0; i < RAYS; i++)
        for (int k = 0; k < i; k++) {
            const double a = turn * (i + 0.5) / RAYS, b = turn * (k + 0.5) / RAYS;
            // Those across the centre may: the walls cross there within rounding, and no nearer.
            const sl_point p = {5 * cos(a), 5 * sin(a)}, q = {5 * cos(b), 5 * sin(b)};
            if (abs(i - k) == RAYS / 2) continue;
            if (sees(&s, &v, p, q)) fail_msg("sectors %d and %d", i, k);
        }
    sl_visibility_destroy(s.context, &v);
    end(&s);
}

static void a_round_room_is_few_cells(void **state) {
    (void)state;
    enum { CHORDS = 1000 };
    scene s = {.context = testing_context(NULL)};
    for (int i = 0; i < CHORDS; i++) {
        const double a = 2 * acos(-1) * i / CHORDS, b = 2 * acos(-1) * (i + 1) / CHORDS;
        assert_ok(s.context, sl_map_add_wall(s.context, &s.map, (sl_point){cos(a), sin(a)},
                                             (sl_point){cos(b), sin(b)}, 0));
    }
    assert_ok(s.context, sl_map_add_start(s.context, &s.map, (sl_point){0, 0}, 0, 0));
    subdivide(&s);
    assert_true(s.space.cell_count < 2 * CHORDS);
    sl_visibility v = see(&s, "sweep", SL_CLOSED);
    for (uint32_t i = 0; i < s.space.cell_count; i++)
        if (s.space.cells[i].inside)
            assert_int_equal(sl_pvs_count(&v.pvs, i), s.space.inside_count);
    sl_visibility_destroy(s.context, &v);
    end(&s);
}

// --- later stages

static void methods_agree_with_rationals(void **state) {
    (void)state;
    int compared = 0;
    for (int grid = 0; grid < OBLIQUE_TINY; grid++)
        for (uint64_t seed = 400; seed < 425; seed++) {
            scene s = from_seed(seed, (oblique_grid)grid, 4);
            const size_t count = s.space.cell_count;
            bool *matrix[2] = {calloc(count * count, sizeof(bool)),
                               calloc(count * count, sizeof(bool))};
            assert_true(matrix[0] && matrix[1]);
            if (count <= 24 && oracle_by_sequences(&s.space, 5000, matrix[0], matrix[1])) {
                compared++;
                for (int k = 0; k < 4; k++) {
                    sl_visibility v = see(&s, k & 1 ? "sweep" : "dfs", k & 2 ? SL_OPEN : SL_CLOSED);
                    for (uint32_t i = 0; i < count * count; i++)
                        assert_int_equal(
                            sl_pvs_sees(&v.pvs, i / (uint32_t)count, i % (uint32_t)count),
                            matrix[k / 2][i]);
                    sl_visibility_destroy(s.context, &v);
                }
            }
            free(matrix[0]);
            free(matrix[1]);
            end(&s);
        }
    assert_true(compared > 30);
}

static void bake(scene *s, sl_baked *out) {
    *out = (sl_baked){.visibility = see(s, "dfs", SL_CLOSED), .space = s->space};
    s->space = (sl_space){0};
    snprintf(out->method, sizeof out->method, "dfs");
    snprintf(out->solver, sizeof out->solver, "funnel");
}

static void a_baked_space_reads_back(void **state) {
    (void)state;
    scene s = from_text("walls 0 0 30 10 20 40 -10 30 0 0\nwall 7 11 3 22\nwall 5 5 12 31\n");
    sl_baked baked, again = {0};
    bake(&s, &baked);
    char *bytes = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&bytes, &size);
    assert_non_null(stream);
    assert_ok(s.context, sl_slv_print(s.context, &baked, stream));
    assert_int_equal(fclose(stream), 0);
    assert_ok(s.context, sl_baked_parse(s.context, "test", bytes, size, &again));
    assert_int_equal(again.space.line_count, baked.space.line_count);
    assert_memory_equal(again.space.lines, baked.space.lines,
                        baked.space.line_count * sizeof *baked.space.lines);
    assert_memory_equal(again.space.beyond, baked.space.beyond,
                        baked.space.vertex_count * sizeof *baked.space.beyond);
    sl_baked_destroy(s.context, &again);
    sl_baked_destroy(s.context, &baked);
    free(bytes);
    end(&s);
}

// --- faults

static sl_status damaged(sl_space *s, int number) {
    uint32_t wall = 0, exit = 0;
    while (s->beyond[wall] >= SL_BEYOND_BORDER) wall++;
    while (s->beyond[exit] != SL_BEYOND_EXIT) exit++;
    switch (number) {
    case 0:
        s->nodes[0].axis = 0;
        break;
    case 1:
        s->nodes[0].line = (int32_t)s->line_count;
        break;
    case 2:
        s->nodes[0].below = 0;
        break;
    case 3:
        s->lines[0].b = s->lines[0].a;
        break;
    case 4:
        s->lines[0].a.x = NAN;
        break;
    case 5:
        s->vertices[0].x = -1e6;
        break;
    case 6: // a corner bent in
        s->vertices[s->cells[0].first_vertex + 1] = s->vertices[s->cells[0].first_vertex];
        break;
    case 7:
        s->beyond[wall] = s->wall_count;
        break;
    case 8:
        s->beyond[wall] = SL_BEYOND_EXIT;
        break;
    case 9:
        s->beyond[exit] = SL_BEYOND_BORDER;
        break;
    case 10: // as seen from the other side
        for (uint32_t i = 0; i < s->wall_count; i++) {
            s->walls[i].a.x += 0.5;
            s->walls[i].b.x += 0.5;
        }
        break;
    case 11:
        s->cells[1].first_vertex++;
        break;
    case 12:
        s->exits[0].left.x += 0.25;
        break;
    case 13:
        s->portals[0].cell[1] = UINT32_MAX;
        break;
    case 14: // a wall more
        s->walls[0] = (sl_wall){{3, 12}, {11, 23}, 0};
        break;
    case 15:
        s->cells[0].inside = 2;
        break;
    case 16:
        s->node_count--;
        break;
    case 17: // a leaf that nothing leads to
        for (uint32_t i = 0; i < s->node_count; i++) {
            if (s->nodes[i].below == ~0) s->nodes[i].below = ~1;
            if (s->nodes[i].above == ~0) s->nodes[i].above = ~1;
        }
        break;
    default:
        fail_msg("no damage %d", number);
    }
    return SL_OK;
}

static void the_check_finds_damage(void **state) {
    (void)state;
    for (int number = 0; number <= 17; number++) {
        scene s = from_text("walls 0 0 30 10 20 40 -10 30 0 0\nwall 7 11 3 22\nwall 5 5 12 31\n");
        damaged(&s.space, number);
        if (sl_space_check(s.context, &s.space) != SL_BAD_INPUT)
            fail_msg("damage %d passes", number);
        end(&s);
    }
}

static void what_cannot_be_is_refused(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space = {0};
    sl_bsp_options options = sl_bsp_options_default();
    assert_int_equal(sl_subdivide_bsp(context, &map, &options, &space), SL_BAD_INPUT);
    assert_ok(context, sl_map_add_wall(context, &map, (sl_point){0, 0}, (sl_point){1, 2}, 0));
    options.candidates = 0;
    assert_int_equal(sl_subdivide_bsp(context, &map, &options, &space), SL_BAD_ARGUMENT);
    options = sl_bsp_options_default();
    options.cuts = NAN;
    assert_int_equal(sl_subdivide_bsp(context, &map, &options, &space), SL_BAD_ARGUMENT);
    options.cuts = -1;
    assert_int_equal(sl_subdivide_bsp(context, &map, &options, &space), SL_BAD_ARGUMENT);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

/// Without a start what is reached from the border is outside, among oblique walls too.
static void the_border_tells_the_outside(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space;
    testing_space(context, "walls 5 0 10 5 5 10 0 5 5 0\n", &map, &space);
    const struct {
        sl_point at;
        bool inside;
    } places[] = {
        {{5, 5}, true}, {{1, 1}, false}, {{9, 1}, false}, {{1, 9}, false}, {{9, 9}, false}};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const uint32_t cell = sl_space_locate(&space, places[i].at);
        assert_true(cell != SL_NO_CELL);
        assert_int_equal(space.cells[cell].inside, places[i].inside);
    }
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void memory_may_fail_at_any_call(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_map map = {0};
    assert_ok(context, oblique_random_map(context, 3, OBLIQUE_TENTHS, 9, &map));
    const sl_bsp_options options = sl_bsp_options_default();
    const long before = memory.live;
    sl_status status = SL_NO_MEMORY;
    for (long at = 1; status == SL_NO_MEMORY; at++) {
        memory.calls = 0;
        memory.fail_at = at;
        sl_space space = {0};
        status = sl_subdivide_bsp(context, &map, &options, &space);
        if (status == SL_OK) status = sl_space_check(context, &space);
        sl_space_destroy(context, &space);
        assert_int_equal(memory.live, before);
        assert_true(at < 100000);
    }
    assert_int_equal(status, SL_OK);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_walls_give_a_sound_space),
        cmocka_unit_test(cells_fill_the_bounds),
        cmocka_unit_test(the_same_walls_give_the_same_space),
        cmocka_unit_test(no_free_sightline_is_lost),
        cmocka_unit_test(nor_in_maps_of_a_few_steps),
        cmocka_unit_test(walls_that_touch_part_rooms),
        cmocka_unit_test(no_two_sectors_of_a_star_see_each_other),
        cmocka_unit_test(a_round_room_is_few_cells),
        cmocka_unit_test(methods_agree_with_rationals),
        cmocka_unit_test(a_baked_space_reads_back),
        cmocka_unit_test(the_check_finds_damage),
        cmocka_unit_test(what_cannot_be_is_refused),
        cmocka_unit_test(the_border_tells_the_outside),
        cmocka_unit_test(memory_may_fail_at_any_call),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

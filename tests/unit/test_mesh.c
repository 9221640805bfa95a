/// Meshes: what walls part stays parted, what locates a point is right, and the check of a space
/// refuses one that was damaged.
#include "baked_bytes.h"
#include "unit/mesh_scene.h"

#include "geometry/orient.h"
#include "oracle/blockers.h"
#include "space/subdivide.h"

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
        scene s = scene_of_text(cases[i].map);
        sl_visibility v = scene_see(&s, &s.space, "dfs", SL_CLOSED);
        if (scene_sees(&s, &v, cases[i].one, cases[i].other)) fail_msg("case %zu leaks", i);
        sl_visibility_destroy(s.context, &v);
        scene_end(&s);
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
    const double whole_turn = 2 * acos(-1);
    scene s = {.context = testing_context(NULL), .name = "star"};
    for (int i = 0; i < RAYS; i++) {
        const sl_point tip = tip_of(i), next = tip_of(i + 1);
        assert_ok(s.context, sl_map_add_wall(s.context, &s.read, tip, next, 0));
        if (i < RAYS / 2)
            assert_ok(s.context,
                      sl_map_add_wall(s.context, &s.read, tip, (sl_point){-tip.x, -tip.y}, 0));
    }
    assert_true(scene_make(&s, -1));
    scene_prove(&s);
    sl_visibility v = scene_see(&s, &s.space, "sweep", SL_CLOSED);
    for (int i = 0; i < RAYS; i++)
        for (int k = 0; k < i; k++) {
            const double a = whole_turn * (i + 0.5) / RAYS, b = whole_turn * (k + 0.5) / RAYS;
            const sl_point p = {5 * cos(a), 5 * sin(a)}, q = {5 * cos(b), 5 * sin(b)};
            if (scene_sees(&s, &v, p, q)) fail_msg("sectors %d and %d", i, k);
        }
    sl_visibility_destroy(s.context, &v);
    scene_end(&s);
}

/// One convex room of many walls: all of it is one cell.
static void a_round_room_is_one_cell(void **state) {
    (void)state;
    enum { CHORDS = 1000 };
    scene s = {.context = testing_context(NULL), .name = "round room"};
    for (int i = 0; i < CHORDS; i++) {
        const double a = 2 * acos(-1) * i / CHORDS, b = 2 * acos(-1) * (i + 1) / CHORDS;
        assert_ok(s.context, sl_map_add_wall(s.context, &s.read, (sl_point){cos(a), sin(a)},
                                             (sl_point){cos(b), sin(b)}, 0));
    }
    assert_ok(s.context, sl_map_add_start(s.context, &s.read, (sl_point){0, 0}, 0, 0));
    assert_true(scene_make(&s, -1));
    scene_prove(&s);
    assert_int_equal(s.space.inside_count, 1);
    scene_end(&s);
}

/// Without a start what is reached from the border is outside, among oblique walls too.
static void the_border_tells_the_outside(void **state) {
    (void)state;
    scene s = scene_of_text("walls 5 0 10 5 5 10 0 5 5 0\n");
    const struct {
        sl_point at;
        bool inside;
    } places[] = {
        {{5, 5}, true}, {{1, 1}, false}, {{9, 1}, false}, {{1, 9}, false}, {{9, 9}, false}};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const uint32_t cell = sl_space_locate(&s.space, places[i].at);
        assert_true(cell != SL_NO_CELL);
        assert_int_equal(s.space.cells[cell].inside, places[i].inside);
    }
    scene_end(&s);
}

// --- locating

static double a_step(double value, uint64_t way) {
    return way == 0 ? value : nextafter(value, way == 1 ? HUGE_VAL : -HUGE_VAL);
}

static void check_place(const scene *s, sl_point p) {
    const sl_box *b = &s->space.bounds;
    const bool within = p.x >= b->min.x && p.x <= b->max.x && p.y >= b->min.y && p.y <= b->max.y;
    const uint32_t expected = within ? oracle_locate(&s->space, p) : SL_NO_CELL;
    const uint32_t found = sl_space_locate(&s->space, p);
    if (found != expected)
        fail_msg("%s: %a %a is in cell %u, not %u", s->name, p.x, p.y, expected, found);
    if (within) assert_true(found != SL_NO_CELL);
}

/// A place and those one step of doubles beside it.
static void check_around(const scene *s, sl_point p) {
    for (uint64_t way = 0; way < 9; way++)
        check_place(s, (sl_point){a_step(p.x, way % 3), a_step(p.y, way / 3)});
}

static void places_are_located(void **state) {
    (void)state;
    for (int grid = 0; grid < OBLIQUE_GRIDS; grid++)
        for (uint64_t seed = 1; seed <= 12; seed++) {
            scene s = {.context = testing_context(NULL)};
            sl_random random = {seed};
            snprintf(s.name, sizeof s.name, "grid %d, seed %d", grid, (int)seed);
            assert_ok(s.context,
                      oblique_random_map(s.context, seed, (oblique_grid)grid, 12, &s.read));
            if (scene_make(&s, -1)) {
                const sl_space *space = &s.space;
                for (int i = 0; i < 60; i++)
                    check_place(&s, oblique_random_point(&random, &s.map, space->bounds));
                for (uint32_t i = 0; i < space->cell_count; i++) {
                    const sl_cell *cell = &space->cells[i];
                    const sl_point *v = space->vertices + cell->first_vertex;
                    const uint32_t k = (uint32_t)sl_random_below(&random, cell->vertex_count);
                    const sl_point a = v[k], c = v[(k + 1) % cell->vertex_count];
                    check_around(&s, a);
                    check_around(&s, (sl_point){a.x / 2 + c.x / 2, a.y / 2 + c.y / 2});
                }
                check_around(&s, space->bounds.min);
                check_around(&s, space->bounds.max);
            }
            scene_end(&s);
        }
}

/// Sides long and short, steep and flat, across a large grid of buckets.
static void places_in_a_fan_are_located(void **state) {
    (void)state;
    const double heights[] = {1, 1e-3, 1e-6, 1e6};
    for (size_t h = 0; h < sizeof heights / sizeof *heights; h++) {
        scene s = {.context = testing_context(NULL), .name = "fan"};
        sl_random random = {h + 1};
        for (int i = 0; i < 60; i++)
            assert_ok(s.context, sl_map_add_wall(s.context, &s.read, (sl_point){0, 0},
                                                 (sl_point){100, heights[h] * i * i}, 0));
        assert_true(scene_make(&s, -1));
        for (int i = 0; i < 2000; i++) {
            const double x = 100 * sl_random_unit(&random);
            const double row = (double)sl_random_below(&random, 60);
            check_place(&s, (sl_point){x, heights[h] * row * row * x / 100});
            check_place(&s, (sl_point){x, heights[h] * 3481 * sl_random_unit(&random)});
        }
        scene_end(&s);
    }
}

static void no_place_out_of_bounds(void **state) {
    (void)state;
    scene s = scene_of_text("walls 5 0 10 5 5 10 0 5 5 0\n");
    const sl_point out[] = {{-0x1p-1074, 5}, {nextafter(10, 11), 5}, {5, -1},       {NAN, 5},
                            {5, NAN},        {HUGE_VAL, 5},          {5, -HUGE_VAL}};
    for (size_t i = 0; i < sizeof out / sizeof *out; i++)
        assert_int_equal(sl_space_locate(&s.space, out[i]), SL_NO_CELL);
    scene_end(&s);
}

// --- faults

static const char damaged_map[] =
    "walls 0 0 30 10 20 40 -10 30 0 0\nwall 7 11 3 22\nwall 5 5 12 31\nseam 7 11 12 31\n"
    "wall 5 5 7 11\n";

/// The first side of which what is beyond is a directed portal, a wall, or border.
static uint32_t side_with(const sl_space *s, uint32_t what) {
    for (uint32_t i = 0; i < s->vertex_count; i++)
        if (what == SL_NEIGHBOUR_RIGHT ? s->neighbour[i] < SL_NEIGHBOUR_BORDER
                                       : s->neighbour[i] == what)
            return i;
    fail_msg("no such side");
    return 0;
}

/// Takes a cell out of the space, with all that is its own; its neighbours keep their directed
/// portals.
static void drop_cell(sl_space *s, uint32_t number) {
    const sl_cell gone = s->cells[number];
    const uint32_t vertices = gone.first_vertex + gone.vertex_count;
    const uint32_t directed = gone.first_directed + gone.directed_count;
    memmove(s->vertices + gone.first_vertex, s->vertices + vertices,
            (s->vertex_count - vertices) * sizeof *s->vertices);
    memmove(s->neighbour + gone.first_vertex, s->neighbour + vertices,
            (s->vertex_count - vertices) * sizeof *s->neighbour);
    memmove(s->directed + gone.first_directed, s->directed + directed,
            (s->directed_count - directed) * sizeof *s->directed);
    memmove(s->cells + number, s->cells + number + 1,
            (s->cell_count - number - 1) * sizeof *s->cells);
    s->vertex_count -= gone.vertex_count;
    s->directed_count -= gone.directed_count;
    s->inside_count -= gone.inside;
    s->cell_count--;
    for (uint32_t i = number; i < s->cell_count; i++) {
        s->cells[i].first_vertex -= gone.vertex_count;
        s->cells[i].first_directed -= gone.directed_count;
    }
}

/// Takes an entry out of the grid.
static void drop_entry(sl_cell_grid *g, uint32_t entry) {
    memmove(g->cells + entry, g->cells + entry + 1,
            (g->entry_count - entry - 1) * sizeof *g->cells);
    g->entry_count--;
    for (uint32_t i = 0; i <= g->columns * g->rows; i++) g->first[i] -= g->first[i] > entry;
}

/// Moves a corner wherever it is known: only the walls' own list knows better.
static void move_place(sl_space *s, sl_point from, sl_point to, bool walls_too) {
    for (uint32_t i = 0; i < s->vertex_count; i++)
        if (s->vertices[i].x == from.x && s->vertices[i].y == from.y) s->vertices[i] = to;
    for (uint32_t i = 0; i < s->portal_count; i++)
        for (int k = 0; k < 2; k++) {
            sl_point *end = k ? &s->portals[i].left : &s->portals[i].right;
            if (end->x == from.x && end->y == from.y) *end = to;
        }
    for (uint32_t i = 0; i < s->directed_count; i++)
        for (int k = 0; k < 2; k++) {
            sl_point *end = k ? &s->directed[i].left : &s->directed[i].right;
            if (end->x == from.x && end->y == from.y) *end = to;
        }
    for (uint32_t i = 0; i < s->wall_count && walls_too; i++)
        for (int k = 0; k < 2; k++) {
            sl_point *end = k ? &s->walls[i].a : &s->walls[i].b;
            if (end->x == from.x && end->y == from.y) *end = to;
        }
}

/// False where there is no damage of that number.
static bool damage(sl_space *s, int number) {
    const uint32_t directed = side_with(s, SL_NEIGHBOUR_PORTAL),
                   wall = side_with(s, SL_NEIGHBOUR_RIGHT);
    const uint32_t border = side_with(s, SL_NEIGHBOUR_BORDER);
    sl_directed_portal kept;
    switch (number) {
    case 0: // corners
        s->vertices[0].x = -1e6;
        return true;
    case 1:
        s->vertices[s->cells[0].first_vertex + 1] = s->vertices[s->cells[0].first_vertex];
        return true;
    case 2:
        s->vertices[3].x = nextafter(s->vertices[3].x, 100);
        return true;
    case 3:
        s->vertices[1].y = NAN;
        return true;
    case 4: // across to the other side of everything
        move_place(s, (sl_point){7, 11}, (sl_point){18, 33}, false);
        return true;
    case 5:
        move_place(s, (sl_point){7, 11}, (sl_point){18, 33}, true);
        return true;
    case 6: // a step only, which the walls do not follow
        move_place(s, (sl_point){7, 11}, (sl_point){nextafter(7, 8), 11}, false);
        return true;
    case 7: // out of the bounds' corner
        move_place(s, s->bounds.min, (sl_point){s->bounds.min.x + 1, s->bounds.min.y}, false);
        return true;
    case 8: // walls
        s->neighbour[wall] = s->wall_count;
        return true;
    case 9:
        s->neighbour[wall] ^= 1;
        return true;
    case 10:
        s->neighbour[wall] ^= SL_NEIGHBOUR_RIGHT;
        return true;
    case 11:
        s->neighbour[wall] = SL_NEIGHBOUR_PORTAL;
        return true;
    case 12:
        s->neighbour[wall] = SL_NEIGHBOUR_BORDER;
        return true;
    case 13:
        for (uint32_t i = 0; i < s->wall_count; i++) {
            s->walls[i].a.x += 0.5;
            s->walls[i].b.x += 0.5;
        }
        return true;
    case 14: // one that no cell has
        s->walls[0] = (sl_wall){{3, 12}, {11, 23}, 0, 0};
        return true;
    case 15:
        s->wall_count--;
        return true;
    case 16: // portals and directed portals
        s->neighbour[directed] = SL_NEIGHBOUR_BORDER;
        return true;
    case 17:
        s->neighbour[directed] = 0;
        return true;
    case 18:
        s->directed[0].left.x += 0.25;
        return true;
    case 19:
        kept = s->directed[0];
        s->directed[0] = s->directed[1];
        s->directed[1] = kept;
        return true;
    case 20:
        s->directed[0].cell = s->directed[0].cell ? 0 : 1;
        return true;
    case 21:
        s->directed[0].portal = s->directed[1].portal;
        return true;
    case 22:
        s->portals[0].cell[1] = UINT32_MAX;
        return true;
    case 23:
        s->portal_count--;
        return true;
    case 24:
        s->portal_count--;
        s->directed_count -= 2;
        s->cells[s->cell_count - 1].directed_count--;
        return true;
    case 25:
        s->portals[0].left.x = nextafter(s->portals[0].left.x, 100);
        return true;
    case 26: // cells
        s->cells[1].first_vertex++;
        return true;
    case 27:
        s->cells[0].inside = 2;
        return true;
    case 28:
        s->cells[0].inside ^= 1;
        return true;
    case 29:
        drop_cell(s, s->cell_count - 1);
        return true;
    case 30: // the same one twice
        drop_cell(s, 0);
        return true;
    case 31:
        s->cells[1] = s->cells[0];
        return true;
    case 32:
        s->cell_count--;
        return true;
    case 33: // bounds
        s->bounds.max.x += 1;
        return true;
    case 34:
        s->bounds.max.x -= 1;
        return true;
    case 35:
        s->neighbour[border] = 0;
        return true;
    case 36: // the grid
        s->grid.cells[0] = s->cell_count;
        return true;
    case 37:
        s->grid.first[1]++;
        return true;
    case 38:
        s->grid.columns--;
        return true;
    case 39:
        s->grid.first[s->grid.columns * s->grid.rows] = 1;
        return true;
    case 40:
        s->grid.rows = 0;
        return true;
    case 41: // seams
        s->seam_portals[0].forward ^= 1;
        return true;
    case 42:
        s->seam_portals[0].portal ^= 1;
        return true;
    case 43:
        s->seam_portals[0].seam = s->seam_count;
        return true;
    case 44:
        s->node_count = 1;
        return true;
    default:
        return false;
    }
}

static void the_check_finds_damage(void **state) {
    (void)state;
    bool more = true;
    for (int number = 0; more; number++) {
        scene s = scene_of_text(damaged_map);
        more = damage(&s.space, number);
        const sl_status status = sl_space_check(s.context, &s.space);
        if (status != (more ? SL_BAD_INPUT : SL_OK)) fail_msg("damage %d passes", number);
        scene_end(&s);
    }
}

/// Two cells whose corners go round each other's: all sides have their other side, and the area is
/// covered twice elsewhere.
static void the_check_finds_each_corner_moved(void **state) {
    (void)state;
    scene s = scene_of_text(damaged_map);
    const uint32_t count = s.space.vertex_count;
    scene_end(&s);
    for (uint32_t i = 0; i < count; i++)
        for (int walls_too = 0; walls_too < 2; walls_too++) {
            s = scene_of_text(damaged_map);
            const sl_point from = s.space.vertices[i];
            const sl_point to = {from.x + 11.5 - 23 * (i % 2), from.y + 5.25 - 10.5 * (i / 2 % 2)};
            move_place(&s.space, from, to, walls_too);
            char why[ORACLE_WHY];
            const bool sound = oracle_is_tiling(&s.space, why);
            const sl_status status = sl_space_check(s.context, &s.space);
            if (status == SL_OK && !sound) fail_msg("corner %u is moved: %s", i, why);
            scene_end(&s);
        }
}

/// Without one entry of the grid some place in that bucket is not found: unless the cell only comes
/// near it, the check must say so.
static void the_check_finds_each_entry_missing(void **state) {
    (void)state;
    scene s = scene_of_text(damaged_map);
    const uint32_t count = s.space.grid.entry_count;
    scene_end(&s);
    uint32_t refused = 0;
    for (uint32_t entry = 0; entry < count; entry++) {
        s = scene_of_text(damaged_map);
        drop_entry(&s.space.grid, entry);
        const bool passes = sl_space_check(s.context, &s.space) == SL_OK;
        refused += !passes;
        sl_random random = {entry};
        for (int i = 0; i < 2000 && passes; i++) {
            const sl_box *b = &s.space.bounds;
            const sl_point p = {b->min.x + sl_random_unit(&random) * (b->max.x - b->min.x),
                                b->min.y + sl_random_unit(&random) * (b->max.y - b->min.y)};
            if (sl_space_locate(&s.space, p) != oracle_locate(&s.space, p))
                fail_msg("without entry %u %a %a is not found, and the check passes", entry, p.x,
                         p.y);
        }
        scene_end(&s);
    }
    assert_true(refused > count / 2);
}

static void what_cannot_be_is_refused(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space = {0};
    assert_int_equal(sli_subdivide_mesh(context, &map, &space), SL_BAD_INPUT);
    assert_null(space.cells);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void memory_may_fail_at_any_call(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_map map = {0};
    assert_ok(context, oblique_random_map(context, 3, OBLIQUE_TENTHS, 9, &map));
    const long before = memory.live;
    sl_status status = SL_NO_MEMORY;
    for (long at = 1; status == SL_NO_MEMORY; at++) {
        memory.calls = 0;
        memory.fail_at = at;
        sl_space space = {0};
        status = sli_subdivide_mesh(context, &map, &space);
        if (status == SL_OK) status = sl_space_check(context, &space);
        sl_space_destroy(context, &space);
        assert_int_equal(memory.live, before);
        assert_true(at < 100000);
    }
    assert_int_equal(status, SL_OK);
    memory.fail_at = 0;
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void a_baked_space_reads_back(void **state) {
    (void)state;
    scene s = scene_of_text("walls 0 0 30 10 20 40 -10 30 0 0\nwall 7 11 3 22\nwall 5 5 12 31\n");
    sl_baked baked = {.visibility = scene_see(&s, &s.space, "dfs", SL_CLOSED), .space = s.space};
    sl_baked again = {0};
    s.space = (sl_space){0};
    snprintf(baked.method, sizeof baked.method, "dfs");
    snprintf(baked.solver, sizeof baked.solver, "funnel");
    size_t size;
    char *bytes = baked_bytes(s.context, &baked, &size);
    assert_ok(s.context, sl_baked_parse(s.context, "test", bytes, size, &again));
    assert_memory_equal(again.space.neighbour, baked.space.neighbour,
                        baked.space.vertex_count * sizeof *baked.space.neighbour);
    assert_memory_equal(again.space.grid.cells, baked.space.grid.cells,
                        baked.space.grid.entry_count * sizeof *baked.space.grid.cells);
    assert_ok(s.context, sl_space_check(s.context, &again.space));
    sl_baked_destroy(s.context, &again);
    sl_baked_destroy(s.context, &baked);
    free(bytes);
    scene_end(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(walls_that_touch_part_rooms),
        cmocka_unit_test(no_two_sectors_of_a_star_see_each_other),
        cmocka_unit_test(a_round_room_is_one_cell),
        cmocka_unit_test(the_border_tells_the_outside),
        cmocka_unit_test(places_are_located),
        cmocka_unit_test(places_in_a_fan_are_located),
        cmocka_unit_test(no_place_out_of_bounds),
        cmocka_unit_test(the_check_finds_damage),
        cmocka_unit_test(the_check_finds_each_corner_moved),
        cmocka_unit_test(the_check_finds_each_entry_missing),
        cmocka_unit_test(what_cannot_be_is_refused),
        cmocka_unit_test(memory_may_fail_at_any_call),
        cmocka_unit_test(a_baked_space_reads_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

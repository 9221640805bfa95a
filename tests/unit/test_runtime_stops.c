/// The runtime and walls that do not stop all: who walks past which of them, and what a file says.
#include "runtime/sightline_runtime.h"

#include "runtime_maps.h"

#include "oracle/blockers.h"
#include "oracle/random_map.h"
#include "oracle/random_oblique.h"
#include "slv_file.h"

static const uint32_t channels[] = {SL_STOPS_SIGHT, SL_STOPS_STEPS, SL_STOPS_SOUND};

/// Doors of this name are shut, others are open.
static const char shut_name[] = "shut";

/// Gives half of the walls random stops, and half of those that steps pass a door along them.
static void limit_walls(sl_context *context, uint64_t seed, sl_map *map, uint32_t *stops) {
    sl_random random = {seed ^ 0x5709};
    const size_t count = map->wall_count;
    sl_wall *walls = malloc((count + 1) * sizeof *walls);
    assert_non_null(walls);
    if (count) memcpy(walls, map->walls, count * sizeof *walls);
    map->wall_count = 0;
    for (size_t i = 0; i < count; i++) {
        const uint32_t some = 1 + (uint32_t)sl_random_below(&random, 6);
        const size_t first = map->wall_count;
        stops[i] = sl_random_below(&random, 2) ? SL_STOPS_ALL : some;
        assert_ok(context, sl_map_add_wall(context, map, walls[i].a, walls[i].b, 0));
        assert_ok(context, sl_map_walls_stop(context, map, first, stops[i]));
        if (stops[i] & SL_STOPS_STEPS || sl_random_below(&random, 2)) continue;
        const bool shut = sl_random_below(&random, 2);
        const sl_segment at = {walls[i].a, walls[i].b};
        assert_ok(context, sl_map_add_door(context, map, shut ? shut_name : "open", at, !shut, 0));
        if (shut) stops[i] |= SL_STOPS_STEPS;
    }
    free(walls);
}

/// The bytes of a file's doors for the runtime.
static unsigned char *shut_doors(const baked_file *f) {
    unsigned char *shut = calloc(f->baked.map.door_count + 1, 1);
    assert_non_null(shut);
    for (size_t i = 0; i < f->baked.map.door_count; i++)
        shut[i] = strcmp(f->baked.map.doors[i].name, shut_name) == 0;
    return shut;
}

typedef SL_ARRAY(sl_segment) segments;

static void add(sl_context *context, segments *list, sl_segment at) {
    assert_ok(context, SL_ARRAY_ROOM(context, list, 1));
    list->items[list->count++] = at;
}

/// The walls and shut doors of a clean space that stop steps, by the lists of the library.
static void list_walls(sl_context *context, const sl_baked *baked, segments *out) {
    const sl_space *s = &baked->space;
    for (uint32_t i = 0, next = 0; i < s->wall_count; i++) {
        const bool passed = next < s->passage_count && s->passages[next].wall == i;
        const uint32_t stops = passed ? s->passages[next++].stops : SL_STOPS_ALL;
        if (stops & SL_STOPS_STEPS) add(context, out, (sl_segment){s->walls[i].a, s->walls[i].b});
    }
    for (size_t i = 0; i < baked->map.seam_count; i++)
        if (baked->map.seams[i].stops & SL_STOPS_STEPS)
            add(context, out, baked->map.seams[i].segment);
    for (size_t i = 0; i < baked->map.door_count; i++) {
        const sl_door *door = &baked->map.doors[i];
        if (strcmp(door->name, shut_name) != 0) continue;
        for (size_t k = 0; k < door->part_count; k++) add(context, out, door->parts[k]);
        if (!door->part_count) add(context, out, door->segment);
    }
}

static void bake_file(sl_context *context, sl_map *map, uint32_t channel, baked_file *f) {
    map->channel = channel;
    assert_ok(context, sl_bake(context, map, NULL, &f->baked, NULL));
    f->bytes = baked_bytes(context, &f->baked, &f->size);
    baked_file_open(f);
    assert_int_equal(f->runtime.channel, channel);
}

static void end_file(sl_context *context, baked_file *f) {
    sl_baked_destroy(context, &f->baked);
    free(f->bytes);
}

static double point_distance(sl_point p, sl_segment s) {
    const double dx = s.b.x - s.a.x, dy = s.b.y - s.a.y;
    double at = ((p.x - s.a.x) * dx + (p.y - s.a.y) * dy) / (dx * dx + dy * dy);
    at = at > 0 ? at < 1 ? at : 1 : 0; // NaN too
    return hypot(p.x - s.a.x - at * dx, p.y - s.a.y - at * dy);
}

/// Of two segments; 0 where they meet.
static double distance(sl_segment s, sl_segment t) {
    if (blockers_meet(s, t)) return 0;
    return fmin(fmin(point_distance(s.a, t), point_distance(s.b, t)),
                fmin(point_distance(t.a, s), point_distance(t.b, s)));
}

/// Discs whose way is clearly free, or clearly too near to a wall or to the border.
static void try_disc(const baked_file *f, const segments *walls, const unsigned char *shut,
                     sl_segment way, double radius, uint32_t *scratch) {
    const sl_box b = f->baked.space.bounds;
    const sl_runtime_walker walker = {.radius = radius, .shut = shut, .own_box = SL_RUNTIME_NO_BOX};
    double least = fmin(fmin(fmin(way.a.x, way.b.x) - b.min.x, b.max.x - fmax(way.a.x, way.b.x)),
                        fmin(fmin(way.a.y, way.b.y) - b.min.y, b.max.y - fmax(way.a.y, way.b.y)));
    for (size_t i = 0; i < walls->count; i++) least = fmin(least, distance(way, walls->items[i]));
    const bool walks =
        sl_runtime_can_walk_wide(&f->runtime, &walker, way.a.x, way.a.y, way.b.x, way.b.y, scratch);
    if (fabs(least - radius) > 1e-9 && walks != (least > radius))
        fail_msg("disc of %g from %.17g %.17g to %.17g %.17g: %d, distance %g", radius, way.a.x,
                 way.a.y, way.b.x, way.b.y, walks, least);
}

/// Steps between points of the grid and others against segments that meet no wall.
static size_t try_steps(const baked_file *f, const segments *walls, uint64_t seed, int tries) {
    const sl_box b = f->baked.space.bounds;
    blockers *wall = blockers_create(walls->items, walls->count);
    sl_random random = {seed};
    uint32_t *scratch = calloc(sl_runtime_scratch_count(&f->runtime), sizeof *scratch);
    assert_non_null(scratch);
    unsigned char *shut = shut_doors(f);
    size_t walked = 0;
    for (int i = 0; i < tries; i++) {
        sl_point ends[2];
        for (int k = 0; k < 2; k++) {
            const bool on_grid = sl_random_below(&random, 2);
            const double x = sl_random_unit(&random), y = sl_random_unit(&random);
            ends[k] =
                (sl_point){b.min.x + x * (b.max.x - b.min.x), b.min.y + y * (b.max.y - b.min.y)};
            if (on_grid && b.max.x - b.min.x > 1 && b.max.x < 1e6)
                ends[k] = (sl_point){floor(2 * ends[k].x) / 2, floor(2 * ends[k].y) / 2};
        }
        const sl_runtime *r = &f->runtime;
        const bool inside = sl_runtime_locate(r, ends[0].x, ends[0].y) != SL_RUNTIME_NO_CELL &&
                            sl_runtime_locate(r, ends[1].x, ends[1].y) != SL_RUNTIME_NO_CELL;
        const bool is = inside && blockers_free(wall, (sl_segment){ends[0], ends[1]});
        const bool said = sl_runtime_can_walk(r, ends[0].x, ends[0].y, ends[1].x, ends[1].y, shut);
        const bool back = sl_runtime_can_walk(r, ends[1].x, ends[1].y, ends[0].x, ends[0].y, shut);
        if (said != is || back != is)
            fail_msg("seed %llu: from %.17g %.17g to %.17g %.17g: %d, back %d, but %d",
                     (unsigned long long)seed, ends[0].x, ends[0].y, ends[1].x, ends[1].y, said,
                     back, is);
        walked += is;
        try_disc(f, walls, shut, (sl_segment){ends[0], ends[1]}, 0.05 * (double)(1 + i % 20),
                 scratch);
    }
    free(shut);
    blockers_destroy(wall);
    free(scratch);
    return walked;
}

/// What the runtime says of portals and passages is what the library has.
static void assert_same_stops(const baked_file *f) {
    const sl_space *s = &f->baked.space;
    uint32_t passages = 0;
    for (uint32_t i = 0; i < s->portal_count; i++) {
        size_t count;
        uint32_t stops = 0;
        const sl_seam_portal *on = sl_space_seams_of(s, i, &count);
        for (size_t k = 0; k < count; k++) {
            const sl_seam *seam = &s->seams[on[k].seam];
            if (seam->kind != SL_SEAM_DOOR) stops |= f->baked.map.seams[seam->number].stops;
        }
        assert_int_equal(sl_runtime_portal_stops(&f->runtime, i), stops);
        assert_int_equal(stops & f->runtime.channel, 0);
    }
    for (uint32_t c = 0; c < s->cell_count; c++) {
        sl_runtime_passage found[64];
        const uint32_t count = sl_runtime_passages(&f->runtime, c, found, 64);
        assert_true(count <= 64);
        passages += count;
        for (uint32_t k = 0; k < count; k++) {
            const sl_point middle = sl_space_middle(s, c), next = sl_space_middle(s, found[k].cell);
            const sl_point right = {found[k].right[0], found[k].right[1]};
            const sl_point left = {found[k].left[0], found[k].left[1]};
            assert_int_equal(blockers_turn(right, left, middle), 1);
            assert_int_equal(blockers_turn(right, left, next), -1);
            assert_true(found[k].stops & f->runtime.channel);
        }
    }
    assert_int_equal(passages, 2 * s->passage_count);
}

static void test_axial(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    size_t walked = 0, passages = 0;
    for (uint64_t seed = 1; seed <= testing_seeds(300); seed++) {
        sl_map raw = {0}, map = {0};
        baked_file f = {.name = "axial"};
        segments walls = {0};
        uint32_t stops[64];
        assert_ok(context, oracle_random_map(context, seed, ORACLE_GRID_INTEGER, &raw));
        assert_ok(context, sl_map_copy(context, &raw, &map));
        limit_walls(context, seed, &map, stops);
        bake_file(context, &map, channels[seed % 3], &f);
        for (size_t i = 0; i < raw.wall_count; i++) {
            const sl_segment at = {raw.walls[i].a, raw.walls[i].b};
            if (stops[i] & SL_STOPS_STEPS && !testing_same_point(at.a, at.b))
                add(context, &walls, at);
        }
        walked += try_steps(&f, &walls, seed, 400);
        assert_same_stops(&f);
        passages += f.baked.space.passage_count;
        sl_free(context, walls.items);
        sl_map_destroy(context, &raw);
        end_file(context, &f);
    }
    assert_true(walked && passages);
    sl_context_destroy(context);
}

static void test_oblique(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    size_t walked = 0, passages = 0;
    for (uint64_t seed = 1; seed <= testing_seeds(200); seed++) {
        sl_map map = {0};
        baked_file f = {.name = "oblique"};
        segments walls = {0};
        uint32_t stops[64];
        const oblique_grid grid = seed % 2 ? OBLIQUE_SQUARES : OBLIQUE_ANYWHERE;
        assert_ok(context, oblique_random_map(context, seed, grid, 24, &map));
        for (int i = 0; i < 4; i++) {
            const double ends[5][2] = {{-1, -1}, {101, -1}, {101, 101}, {-1, 101}, {-1, -1}};
            assert_ok(context, sl_map_add_wall(context, &map, (sl_point){ends[i][0], ends[i][1]},
                                               (sl_point){ends[i + 1][0], ends[i + 1][1]}, 0));
        }
        assert_true(map.wall_count <= 64);
        limit_walls(context, seed, &map, stops);
        bake_file(context, &map, channels[seed / 2 % 3], &f);
        list_walls(context, &f.baked, &walls);
        walked += try_steps(&f, &walls, seed, 300);
        assert_same_stops(&f);
        passages += f.baked.space.passage_count;
        sl_free(context, walls.items);
        end_file(context, &f);
    }
    assert_true(walked && passages);
    sl_context_destroy(context);
}

/// A long corridor with curtains and a window: more cells than a step by touch goes through.
static void test_long_way(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    baked_file f = {.name = "corridor"};
    const double ends[5][2] = {{0, 0}, {100, 0}, {100, 4}, {0, 4}, {0, 0}};
    for (int i = 0; i < 4; i++)
        assert_ok(context, sl_map_add_wall(context, &map, (sl_point){ends[i][0], ends[i][1]},
                                           (sl_point){ends[i + 1][0], ends[i + 1][1]}, 0));
    for (int i = 1; i < 50; i++) {
        const size_t first = map.wall_count;
        assert_ok(context,
                  sl_map_add_wall(context, &map, (sl_point){2 * i, 0}, (sl_point){2 * i, 4}, 0));
        assert_ok(context, sl_map_walls_stop(context, &map, first, SL_STOPS_SIGHT));
    }
    const size_t first = map.wall_count;
    assert_ok(context, sl_map_add_wall(context, &map, (sl_point){51, 0}, (sl_point){51, 2}, 0));
    assert_ok(context, sl_map_walls_stop(context, &map, first, SL_STOPS_STEPS));
    bake_file(context, &map, SL_STOPS_SIGHT, &f);
    const sl_runtime *r = &f.runtime;
    assert_true(sl_runtime_can_walk(r, 1, 3, 99, 3, NULL));
    assert_true(sl_runtime_can_walk(r, 99, 3.5, 1, 2.5, NULL));
    assert_false(sl_runtime_can_walk(r, 1, 1, 99, 1, NULL));
    assert_false(sl_runtime_can_walk(r, 1, 2, 99, 2, NULL)); // the window's end
    assert_false(sl_runtime_can_walk(r, 1, 3, 99, 5, NULL));
    assert_true(sl_runtime_can_walk(r, 4, 1, 4, 3, NULL)); // in a curtain
    assert_false(sl_runtime_can_walk(r, 51, 1, 51, 3, NULL));
    end_file(context, &f);
    sl_context_destroy(context);
}

/// Each field of the sections with values that make no sense, with the checksum right.
/// A flat box in a curtain stops who walks through it, at any angle.
static void test_box_in_curtain(void **state) {
    (void)state;
    static const char *const rooms[] = {
        "walls 0 0 10 0 10 10 0 10 0 0\nwall 5 0 5 10 stops sight\n",
        "walls 0 0 10 0 10 10 1 9 0 0\nwall 5 0 5 9 stops sight\n"};
    for (int i = 0; i < 2; i++) {
        sl_context *context = testing_context(NULL);
        baked_file f = baked_file_of_text(context, rooms[i]);
        sl_runtime_box list[1], box = {5, 4, 5, 6, true};
        sl_runtime_boxes boxes;
        const size_t size = sl_runtime_boxes_count(&f.runtime, 1, 8);
        uint32_t *memory = malloc(size * sizeof *memory);
        uint32_t *scratch = malloc(sl_runtime_scratch_count(&f.runtime) * sizeof *scratch);
        assert_true(memory && scratch);
        sl_runtime_boxes_start(&boxes, &f.runtime, list, 1, 8, memory);
        const sl_runtime_walker walker = {0, NULL, &boxes, SL_RUNTIME_NO_BOX};
        for (int here = 0; here < 2; here++) {
            assert_int_equal(
                sl_runtime_can_walk_past_boxes(&boxes, 2, 5, 8, 5, NULL, SL_RUNTIME_NO_BOX), !here);
            assert_int_equal(sl_runtime_can_walk_wide(&f.runtime, &walker, 2, 5, 8, 5, scratch),
                             !here);
            assert_true(
                sl_runtime_can_walk_past_boxes(&boxes, 2, 3, 8, 3, NULL, SL_RUNTIME_NO_BOX));
            assert_true(sl_runtime_boxes_move(&boxes, 0, &box));
        }
        free(memory);
        free(scratch);
        baked_file_destroy(context, &f);
        sl_context_destroy(context);
    }
}

/// A door in a curtain stops who walks through it as long as it is shut; a point and a disc, at any
/// angle.
static void test_door_in_curtain(void **state) {
    (void)state;
    for (int turned = 0; turned < 2; turned++) {
        const double angle = turned ? 17.3 * 0.017453292519943295 : 0, c = cos(angle),
                     s = sin(angle);
        const double room[9][2] = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0},
                                   {5, 0}, {5, 4},  {5, 6},   {5, 10}};
        double at[9][2], from[2][2], to[2][2];
        for (int i = 0; i < 9; i++) {
            at[i][0] = c * room[i][0] - s * room[i][1];
            at[i][1] = s * room[i][0] + c * room[i][1];
        }
        for (int i = 0; i < 2; i++) { // through the door, and beside it
            const double y = i ? 2 : 5;
            from[i][0] = c * 2 - s * y, from[i][1] = s * 2 + c * y;
            to[i][0] = c * 8 - s * y, to[i][1] = s * 8 + c * y;
        }
        sl_context *context = testing_context(NULL);
        sl_map map = {0};
        baked_file f = {.name = "door in curtain"};
        for (int i = 0; i < 8; i++) {
            const sl_point a = {at[i][0], at[i][1]}, b = {at[i + 1][0], at[i + 1][1]};
            const size_t first = map.wall_count;
            if (i == 4) continue;
            assert_ok(context, sl_map_add_wall(context, &map, a, b, 0));
            if (i > 4) assert_ok(context, sl_map_walls_stop(context, &map, first, SL_STOPS_SIGHT));
            if (i == 6)
                assert_ok(context,
                          sl_map_add_door(context, &map, "front", (sl_segment){a, b}, true, 0));
        }
        bake_file(context, &map, SL_STOPS_SIGHT, &f);
        const sl_runtime *r = &f.runtime;
        assert_int_equal(r->door_count, 1);
        uint32_t *scratch = malloc(sl_runtime_scratch_count(r) * sizeof *scratch);
        assert_non_null(scratch);
        for (unsigned char shut = 0; shut < 2; shut++)
            for (int i = 0; i < 2; i++) {
                const bool free_way = i == 1 || !shut;
                const double *a = from[i], *b = to[i];
                assert_int_equal(sl_runtime_can_walk(r, a[0], a[1], b[0], b[1], &shut), free_way);
                assert_int_equal(sl_runtime_can_walk(r, b[0], b[1], a[0], a[1], &shut), free_way);
                const sl_runtime_walker walker = {0.5, &shut, NULL, SL_RUNTIME_NO_BOX};
                double x, y;
                assert_int_equal(
                    sl_runtime_can_walk_wide(r, &walker, a[0], a[1], b[0], b[1], scratch),
                    free_way);
                assert_int_equal(
                    sl_runtime_walk(r, &walker, a[0], a[1], b[0], b[1], scratch, &x, &y), free_way);
                const double came = hypot(x - a[0], y - a[1]);
                assert_true(fabs(came - (free_way ? 6 : 2.5)) < 1e-9);
            }
        free(scratch);
        end_file(context, &f);
        sl_context_destroy(context);
    }
}

static void test_damaged(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    baked_file f = {.name = "damaged"};
    static const char text[] = "sightline 1\nwalls 0 0 9 0 9 9 0 9 0 0\nwall 4 0 4 9 stops sight\n"
                               "wall 0 4 4 4 stops steps\n";
    assert_ok(context, sl_map_parse(context, "t", text, sizeof text - 1, NULL, &map));
    bake_file(context, &map, SL_STOPS_SIGHT, &f);
    static const struct {
        const char *tag;
        size_t at;
        uint32_t value;
    } wrong[] = {{"PASS", 0, 0xffff}, {"PASS", 4, 0x7fffffff}, {"PASS", 4, UINT32_MAX},
                 {"PASS", 8, 0xffff}, {"PASS", 12, 0},         {"PASS", 12, 7}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        sl_runtime runtime;
        char *copy = malloc(f.size);
        assert_non_null(copy);
        memcpy(copy, f.bytes, f.size);
        const uint32_t value = slv_u32(wrong[i].value);
        memcpy(slv_items(copy, wrong[i].tag) + wrong[i].at, &value, sizeof value);
        slv_seal(copy, f.size);
        assert_int_equal(sl_runtime_open(copy, f.size, &runtime), SL_RUNTIME_SPACE);
        free(copy);
    }
    // A channel that is none, more stops than seams, passages out of order.
    const uint32_t none = slv_u32(8), some[8] = {0};
    const uint32_t passages[8] = {slv_u32(1), 0, 0, slv_u32(1), 0, 0, 0, slv_u32(1)};
    const struct {
        const char *tag;
        const void *items;
        uint32_t item_bytes;
        uint64_t count;
    } more[] = {{"CHAN", &none, 4, 1}, {"CHAN", some, 4, 2}};
    for (size_t i = 0; i < sizeof more / sizeof *more; i++) {
        sl_runtime runtime;
        size_t size = f.size;
        char *longer =
            slv_with(f.bytes, &size, more[i].tag, more[i].items, more[i].item_bytes, more[i].count);
        assert_int_equal(sl_runtime_open(longer, size, &runtime), SL_RUNTIME_SPACE);
        free(longer);
    }
    sl_runtime runtime;
    memcpy(slv_items(f.bytes, "PASS"), passages, sizeof passages);
    slv_seal(f.bytes, f.size);
    assert_int_equal(sl_runtime_open(f.bytes, f.size, &runtime), SL_RUNTIME_SPACE);
    end_file(context, &f);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_axial),           cmocka_unit_test(test_oblique),
        cmocka_unit_test(test_long_way),        cmocka_unit_test(test_box_in_curtain),
        cmocka_unit_test(test_door_in_curtain), cmocka_unit_test(test_damaged),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

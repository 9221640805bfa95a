// Which things each player may see: by the oracle no pair is missed, and few are added. On the maps
// no pair is missed of which two points see each other.
//   test_runtime_relevant [MAPS [SEED]]    so many random maps of each kind instead of 100
#include "runtime_maps.h"

#include "oracle/two_boxes.h"

enum { SIZE = 12, WALLS = 14, DOORS = 3, PLAYERS = 6, THINGS = 10, MOST = 128 };

static uint64_t maps = 40, seed = 5;

typedef struct trial {
    sl_context *context;
    sl_random random;
    baked_file file;
    sl_segment walls[MOST]; ///< with shut doors
    size_t wall_count;
    unsigned char *shut;
    sl_runtime_box players[PLAYERS], things[THINGS];
    double margin, range;
    unsigned char bits[PLAYERS * ((THINGS + 7) / 8)];
    size_t said, seen, within; ///< pairs
} trial;

static double below(trial *t, uint64_t bound) {
    return (double)sl_random_below(&t->random, bound);
}

static sl_runtime_box random_box(trial *t) {
    const sl_runtime *r = &t->file.runtime;
    const double unit = (r->max_x - r->min_x) / SIZE, most = sl_random_below(&t->random, 3) ? 2 : 5;
    const double x = floor(r->min_x + (below(t, SIZE + 3) - 1) * unit);
    const double y = floor(r->min_y + (below(t, SIZE + 3) - 1) * unit);
    return (sl_runtime_box){x, y, x + floor(below(t, (uint64_t)most + 1) * unit / 2),
                            y + floor(below(t, (uint64_t)most + 1) * unit / 2), false};
}

static void place_boxes(trial *t) {
    for (size_t i = 0; i < PLAYERS; i++) t->players[i] = random_box(t);
    for (size_t i = 0; i < THINGS; i++) t->things[i] = random_box(t);
    t->margin = below(t, 2);
}

static bool says(const trial *t, size_t player, size_t thing) {
    return t->bits[player * ((THINGS + 7) / 8) + thing / 8] >> thing % 8 & 1;
}

static void ask(trial *t) {
    const sl_runtime *r = &t->file.runtime;
    uint32_t *scratch = malloc(sl_runtime_relevant_count(r, THINGS) * sizeof *scratch);
    size_t count = 0;
    assert_non_null(scratch);
    const size_t pairs = sl_runtime_relevant(r, t->players, PLAYERS, t->margin, t->things, THINGS,
                                             t->shut, t->range, scratch, t->bits);
    for (size_t i = 0; i < PLAYERS; i++)
        for (size_t k = 0; k < THINGS; k++) count += says(t, i, k);
    assert_int_equal(count, pairs);
    free(scratch);
}

// --- against the oracle

/// The part of a box in the map. False for none.
static bool in_map(const sl_runtime *r, const sl_runtime_box *box, double margin, sl_box *out) {
    *out = (sl_box){{fmax(box->min_x - margin, r->min_x), fmax(box->min_y - margin, r->min_y)},
                    {fmin(box->max_x + margin, r->max_x), fmin(box->max_y + margin, r->max_y)}};
    return out->min.x <= out->max.x && out->min.y <= out->max.y;
}

static void print_pair(const trial *t, const sl_box *from, const sl_box *to) {
    for (size_t i = 0; i < t->wall_count; i++)
        print_message("wall %.17g %.17g %.17g %.17g\n", t->walls[i].a.x, t->walls[i].a.y,
                      t->walls[i].b.x, t->walls[i].b.y);
    print_message("%.17g,%.17g %.17g,%.17g to %.17g,%.17g %.17g,%.17g\n", from->min.x, from->min.y,
                  from->max.x, from->max.y, to->min.x, to->min.y, to->max.x, to->max.y);
}

/// The same pair alone, if both boxes are squares.
static bool within(trial *t, const sl_runtime_box *from, const sl_runtime_box *to) {
    const sl_runtime *r = &t->file.runtime;
    const double a = (from->max_x - from->min_x) / 2, b = (to->max_x - to->min_x) / 2;
    uint32_t *scratch = malloc(sl_runtime_scratch_count(r) * sizeof *scratch);
    assert_non_null(scratch);
    const bool sees =
        sl_runtime_sees_within(r, from->min_x + a, from->min_y + a, a + t->margin, to->min_x + b,
                               to->min_y + b, b, t->shut, t->range, scratch);
    free(scratch);
    return sees;
}

static bool is_square(const sl_runtime_box *box) {
    return box->max_x - box->min_x == box->max_y - box->min_y;
}

static void compare_with_oracle(trial *t) {
    const sl_box bounds = t->file.baked.space.bounds;
    ask(t);
    for (size_t i = 0; i < PLAYERS; i++)
        for (size_t k = 0; k < THINGS; k++) {
            sl_box from, to;
            const bool here = in_map(&t->file.runtime, &t->players[i], t->margin, &from) &&
                              in_map(&t->file.runtime, &t->things[k], 0, &to);
            const bool sees = here && two_boxes_see(t->walls, t->wall_count, bounds, from, to);
            t->said += says(t, i, k);
            t->seen += sees;
            if (sees && !says(t, i, k)) {
                print_pair(t, &from, &to);
                fail_msg("player %zu does not see thing %zu", i, k);
            }
            assert_true(here || !says(t, i, k));
            if (!is_square(&t->players[i]) || !is_square(&t->things[k])) continue;
            const bool alone = within(t, &t->players[i], &t->things[k]);
            t->within += alone;
            assert_true(alone || !sees);
            assert_true(!alone || says(t, i, k));
        }
}

static void take_walls(trial *t) {
    const sl_map *map = &t->file.baked.map;
    t->wall_count = 0;
    for (size_t i = 0; i < map->wall_count; i++)
        t->walls[t->wall_count++] = (sl_segment){map->walls[i].a, map->walls[i].b};
    for (size_t i = 0; i < map->door_count; i++)
        if (t->shut[i]) t->walls[t->wall_count++] = map->doors[i].segment;
    assert_true(t->wall_count <= MOST);
}

/// Turns a map by an angle with a whole tangent, so that coordinates stay integers.
static void turn(sl_map *map, double c, double s) {
    for (size_t i = 0; i < 2 * map->wall_count; i++) {
        sl_point *p = i % 2 ? &map->walls[i / 2].a : &map->walls[i / 2].b;
        *p = (sl_point){c * p->x - s * p->y, s * p->x + c * p->y};
    }
    for (size_t i = 0; i < 2 * map->door_count; i++) {
        sl_segment *d = &map->doors[i / 2].segment;
        sl_point *p = i % 2 ? &d->a : &d->b;
        *p = (sl_point){c * p->x - s * p->y, s * p->x + c * p->y};
    }
}

static double turn_of(sl_segment s, sl_point p) {
    return (s.b.x - s.a.x) * (p.y - s.a.y) - (s.b.y - s.a.y) * (p.x - s.a.x);
}

static bool cross(sl_segment s, sl_segment t) {
    return turn_of(s, t.a) * turn_of(s, t.b) < 0 && turn_of(t, s.a) * turn_of(t, s.b) < 0;
}

static bool crosses_any(const sl_map *map, sl_segment s) {
    for (size_t i = 0; i < map->wall_count; i++)
        if (cross((sl_segment){map->walls[i].a, map->walls[i].b}, s)) return true;
    for (size_t i = 0; i < map->door_count; i++)
        if (cross(map->doors[i].segment, s)) return true;
    return false;
}

/// A room with walls and doors any way, that touch but do not cross. So cells lie any way beside
/// boxes, and boxes are before and behind the same portals.
static void slanted_rooms(trial *t, int walls, sl_map *map) {
    grid_rooms(t->context, &t->random, SIZE, 0, 0, map);
    for (int i = 0; i < walls + DOORS; i++) {
        const char name[2] = {(char)('a' + i), 0};
        sl_segment s;
        do
            s = (sl_segment){{below(t, SIZE + 1), below(t, SIZE + 1)},
                             {below(t, SIZE + 1), below(t, SIZE + 1)}};
        while ((s.a.x == s.b.x && s.a.y == s.b.y) || crosses_any(map, s));
        if (i < DOORS)
            assert_ok(t->context, sl_map_add_door(t->context, map, name, s, true, 0));
        else
            assert_ok(t->context, sl_map_add_wall(t->context, map, s.a, s.b, 0));
    }
}

/// Axial maps turned by (c, s), or slanted ones for (0, 0).
static void check_random_maps(double c, double s) {
    unsigned char shut[DOORS];
    trial t = {.context = testing_context(NULL), .random = {seed}, .shut = shut};
    for (uint64_t i = 0; i < maps; i++) {
        const int walls = i % 2 ? WALLS : 2 * WALLS;
        sl_map *map = &t.file.baked.map;
        t.file = (baked_file){.name = "random", .baked = {.method = "dfs", .solver = "funnel"}};
        if (c == 0 && s == 0) {
            slanted_rooms(&t, walls / 2, map);
        } else {
            grid_rooms(t.context, &t.random, SIZE, walls, DOORS, map);
            turn(map, c, s);
        }
        assert_ok(t.context, sl_map_clean(t.context, &t.file.baked.map, NULL, NULL));
        baked_file_make(t.context, &t.file, false);
        for (size_t k = 0; k < DOORS; k++) t.shut[k] = (unsigned char)sl_random_below(&t.random, 2);
        take_walls(&t);
        place_boxes(&t);
        compare_with_oracle(&t);
        baked_file_destroy(t.context, &t.file);
    }
    print_message("%zu pairs, the oracle has %zu (%.1f %% more); %zu squares alone\n", t.said,
                  t.seen, 100 * ((double)t.said / (double)t.seen - 1), t.within);
    assert_true((double)t.said <= 1.1 * (double)t.seen);
    sl_context_destroy(t.context);
}

static void test_axial_maps(void **state) {
    (void)state;
    check_random_maps(1, 0);
}

static void test_turned_maps(void **state) {
    (void)state;
    check_random_maps(10, 3);
    check_random_maps(4, 3);
    check_random_maps(1, 1);
}

static void test_slanted_maps(void **state) {
    (void)state;
    check_random_maps(0, 0);
}

// --- against points that see each other

/// A place in a box: often on a side or a corner.
static sl_point place_in(trial *t, const sl_runtime_box *box, double margin) {
    const double low[2] = {box->min_x - margin, box->min_y - margin};
    const double high[2] = {box->max_x + margin, box->max_y + margin};
    double at[2];
    for (int k = 0; k < 2; k++) {
        const uint64_t where = sl_random_below(&t->random, 4);
        at[k] = where == 0   ? low[k]
                : where == 1 ? high[k]
                             : low[k] + sl_random_unit(&t->random) * (high[k] - low[k]);
        at[k] = fmin(at[k], high[k]);
    }
    return (sl_point){at[0], at[1]};
}

/// Somewhere, or with corners on corners and lines of the map.
static sl_runtime_box box_near(trial *t) {
    const sl_space *s = &t->file.baked.space;
    const sl_runtime *r = &t->file.runtime;
    const double size = (r->max_x - r->min_x) / 10 * sl_random_unit(&t->random);
    const sl_point v = s->vertices[sl_random_below(&t->random, s->vertex_count)];
    const sl_point w = s->vertices[sl_random_below(&t->random, s->vertex_count)];
    const double x = r->min_x + sl_random_unit(&t->random) * (r->max_x - r->min_x);
    const double y = r->min_y + sl_random_unit(&t->random) * (r->max_y - r->min_y);
    switch (sl_random_below(&t->random, 5)) {
    case 0:
        return (sl_runtime_box){v.x, v.y, v.x, v.y, false};
    case 1:
        return (sl_runtime_box){v.x - size, w.y, v.x, w.y + size, false};
    case 2:
        return (sl_runtime_box){v.x, w.y - size / 2, v.x + size, w.y + size / 2, false};
    default:
        return (sl_runtime_box){x, y, x + size, y + size, false};
    }
}

static void check_points(trial *t, uint32_t *scratch) {
    const sl_runtime *r = &t->file.runtime;
    for (size_t i = 0; i < PLAYERS; i++)
        for (size_t k = 0; k < THINGS; k++)
            for (int tries = 0; tries < 40 && !says(t, i, k); tries++) {
                const sl_point p = place_in(t, &t->players[i], t->margin);
                const sl_point q = place_in(t, &t->things[k], 0);
                if (sl_runtime_sees(r, p.x, p.y, q.x, q.y, t->shut, t->range, scratch))
                    fail_msg("%s: player %zu at %.17g,%.17g does not see thing %zu at %.17g,%.17g",
                             t->file.name, i, p.x, p.y, k, q.x, q.y);
            }
}

static void check_map(const baked_file *f) {
    trial t = {.context = NULL, .random = {9}, .file = *f};
    const sl_runtime *r = &f->runtime;
    uint32_t *scratch = malloc(sl_runtime_scratch_count(r) * sizeof *scratch);
    t.shut = calloc(r->door_count + 1, 1);
    assert_true(scratch && t.shut);
    for (int round = 0; round < 12; round++) {
        for (uint32_t i = 0; i < r->door_count; i++)
            t.shut[i] = (unsigned char)sl_random_below(&t.random, 2);
        for (size_t i = 0; i < PLAYERS; i++) t.players[i] = box_near(&t);
        for (size_t i = 0; i < THINGS; i++) t.things[i] = box_near(&t);
        t.margin = round % 3 ? 0 : (r->max_x - r->min_x) / 40;
        t.range = round % 4 ? 0 : (r->max_x - r->min_x) / 3;
        ask(&t);
        check_points(&t, scratch);
    }
    free(t.shut);
    free(scratch);
}

static void test_points_of_all_maps(void **state) {
    (void)state;
    baked_file_each(check_map);
}

static void test_points_far_away(void **state) {
    (void)state;
    static const double offsets[] = {0, 1e9, 1e-6};
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < sizeof offsets / sizeof *offsets; i++) {
        baked_file f = baked_file_turned(context, "office", 17.3, offsets[i]);
        check_map(&f);
        baked_file_destroy(context, &f);
    }
    sl_context_destroy(context);
}

// --- answers that are known

/// Two rooms with a door between them, a pillar in the first.
static const char rooms[] = "walls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 4\nwall 10 6 10 10\n"
                            "door d 10 4 10 6\nsolid 4 4 6 4 6 6 4 6\n";
/// A place nearer to the wall than numbers of maps are is on it.
static const char split[] = "walls -10 0 10 0 10 10 -10 10 -10 0\nwall 0 0 0 10\n";
/// One sees through the glass from the right.
static const char glass[] = "walls 0 0 20 0 20 10 0 10 0 0\noneway 10 0 10 10\n";
/// Only along y = 0 one sees past all walls, which end there from below, above and below.
static const char comb[] = "walls 0 -5 20 -5 20 5 0 5 0 -5\nwall 5 -5 5 0\nwall 8 0 8 5\n"
                           "wall 11 -5 11 0\n";
/// A corner of the box is behind the slanted door, and beside its room.
static const char slanted[] = "walls 1 1 -5 -5 5 -5 5 5 1 5 1 1\ndoor a 1 1 5 5\n";
/// Around the end of the wall from 0 2 to 6 0 one looks through the doors a, b and c. The line from
/// the lower right of the box to the left end of a comes back through c the other way.
static const char around[] = "walls -5 12 -5 -2 6 -2 6 0 0 2\nwalls -5 12 10 12 10 0 6 0\n"
                             "door a -5 2 0 2\ndoor b 0 2 0 12\ndoor c 6 0 6 12\n";
static const char around_left[] = "walls 5 12 5 -2 -6 -2 -6 0 0 2\nwalls 5 12 -10 12 -10 0 -6 0\n"
                                  "door a 5 2 0 2\ndoor b 0 2 0 12\ndoor c -6 0 -6 12\n";
/// Two combs, one on the other: one sees through them only along y = 0 and y = 3. Both lines come
/// through the door e.
static const char combs[] = "walls 0 -5 -20 -5 -20 5 0 5 0 -5\nwall -5 1.5 -11 1.5\n"
                            "wall -5 -5 -5 0\nwall -8 0 -8 1.5\nwall -11 -5 -11 0\n"
                            "wall -5 5 -5 3\nwall -8 3 -8 1.5\nwall -11 5 -11 3\n"
                            "door a -5 0 -5 1.5\ndoor b -5 1.5 -5 3\n"
                            "door c -11 0 -11 1.5\ndoor d -11 1.5 -11 3\ndoor e -13 -5 -13 5\n";

static const struct {
    const char *map;
    sl_runtime_box from, to;
    double range;
    bool shut, sees;
} known[] = {
    {rooms, {8, 4.5, 9, 5.5, false}, {12, 4.5, 13, 5.5, false}, 0, false, true},
    {rooms, {8, 4.5, 9, 5.5, false}, {12, 4.5, 13, 5.5, false}, 0, true, false},
    {rooms, {9, 4.5, 10, 5.5, false}, {12, 4.5, 13, 5.5, false}, 0, true, true}, // on the door
    {rooms, {1, 1, 2, 2, false}, {5, 1, 6, 2, false}, 3, false, true},
    {rooms, {1, 1, 2, 2, false}, {5, 1, 6, 2, false}, 2.99, false, false},
    {rooms, {0, 0, 1, 1, false}, {11, 8.5, 12, 9.5, false}, 0, false, false},
    {rooms, {0, 0, 1, 1, false}, {11, 7, 12, 8, false}, 0, false, true},
    {rooms, {0, 0, 1, 1, false}, {11, 7.34, 12, 8, false}, 0, false, false},
    {rooms, {4.5, 4.5, 5.5, 5.5, false}, {7, 4.5, 8, 5.5, false}, 0, false, false}, // in the pillar
    {rooms, {4.5, 4.5, 5.5, 5.5, false}, {5, 5, 5.5, 5.5, false}, 0, false, false},
    {rooms, {7, 4.5, 8, 5.5, false}, {4.5, 4.5, 5.5, 5.5, false}, 0, false, false},
    {rooms, {7, 4.5, 8, 5.5, false}, {4.5, 4.5, 6, 5.5, false}, 0, false, true}, // its side
    {split, {-1e-210, 4, -1e-210, 4, false}, {5, 4, 6, 5, false}, 0, false, true},
    {split, {5, 4, 6, 5, false}, {-1e-210, 4, -1e-210, 4, false}, 0, false, true},
    {split, {-1e-190, 4, -1e-190, 4, false}, {5, 4, 6, 5, false}, 0, false, false},
    {glass, {2, 2, 3, 3, false}, {12, 2, 13, 3, false}, 0, false, false},
    {glass, {12, 2, 13, 3, false}, {2, 2, 3, 3, false}, 0, false, true},
    {glass, {9, 2, 11, 3, false}, {12, 2, 13, 3, false}, 0, false, true},
    {comb, {1, 0, 1, 0, false}, {15, 0, 15, 0, false}, 0, false, true},
    {comb, {15, -1, 16, 1, false}, {1, -1, 2, 1, false}, 0, false, true},
    {comb, {1, 0, 3, 0, false}, {12, 0, 13, 1, false}, 0, false, true},
    {comb, {1, 0, 3, 0, false}, {12, 0.1, 13, 1, false}, 0, false, false},
    {comb, {1, 0, 3, 0, false}, {12, -1, 13, -0.5, false}, 0, false, false},
    {comb, {1, -2, 3, 0, false}, {12, -1, 13, -0.5, false}, 0, false, false},
    {slanted, {-3, -3, 0, -1, false}, {3, 3.2, 3.1, 3.3, false}, 0, false, true},
    {slanted, {-3, -3, 0, -1, false}, {3, 3.2, 3.1, 3.3, false}, 0, true, false},
    {around, {-1, 0, 2.9, 1, false}, {7, 10.5, 8, 11.5, false}, 0, false, true},
    {around, {-1, 0, 2.9, 1, false}, {7, 0, 8, 5, false}, 0, false, false},
    {around, {-1, 0, 2.9, 1, false}, {0.5, 6, 0.6, 6.1, false}, 0, false, true},
    {around_left, {-2.9, 0, 1, 1, false}, {-8, 10.5, -7, 11.5, false}, 0, false, true},
    {around_left, {-2.9, 0, 1, 1, false}, {-8, 0, -7, 5, false}, 0, false, false},
    {around_left, {-2.9, 0, 1, 1, false}, {-0.6, 6, -0.5, 6.1, false}, 0, false, true},
    {combs, {-3, 0, -1, 3, false}, {-16, -1, -15, 0, false}, 0, false, true},
    {combs, {-3, 0, -1, 3, false}, {-16, 3, -15, 4, false}, 0, false, true},
    {combs, {-3, 0.1, -1, 2.9, false}, {-16, -1, -15, 4, false}, 0, false, false},
};

static void test_known_answers(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        baked_file f = baked_file_of_text(context, known[i].map);
        trial t = {.file = f, .range = known[i].range};
        unsigned char shut[5] = {known[i].shut};
        for (size_t k = 0; k < PLAYERS; k++) t.players[k] = known[i].from;
        for (size_t k = 0; k < THINGS; k++) t.things[k] = known[i].to;
        t.shut = shut;
        ask(&t);
        if (says(&t, PLAYERS - 1, THINGS - 1) != known[i].sees)
            fail_msg("known answer %zu: sees is %d", i, !known[i].sees);
        baked_file_destroy(context, &f);
    }
    sl_context_destroy(context);
}

/// More large things than there is room for at a time.
static void test_large_things(void **state) {
    (void)state;
    enum { MANY = 40 };
    sl_context *context = testing_context(NULL);
    baked_file f = baked_file_of(context, SIGHTLINE_SOURCE_DIR "/maps/office.map");
    const sl_runtime *r = &f.runtime;
    const sl_runtime_box all = {r->min_x - 1, r->min_y, r->max_x, r->max_y, false};
    const sl_runtime_box nowhere = {NAN, 0, 1, 1, false}, turned = {1, 1, 0, 0, false};
    const sl_runtime_box players[4] = {{53, 20, 53, 20, false}, all, nowhere, turned};
    sl_runtime_box things[MANY];
    unsigned char bits[4 * MANY / 8];
    uint32_t *scratch = malloc(sl_runtime_relevant_count(r, MANY) * sizeof *scratch);
    assert_non_null(scratch);
    for (int i = 0; i < MANY; i++) things[i] = i == 7 ? nowhere : all;
    assert_int_equal(sl_runtime_relevant(r, players, 4, 0, things, MANY, NULL, 0, scratch, bits),
                     2 * (MANY - 1));
    for (int i = 0; i < 4 * MANY; i++)
        assert_int_equal(bits[i / 8] >> i % 8 & 1, i < 2 * MANY && i % MANY != 7);
    free(scratch);
    baked_file_destroy(context, &f);
    sl_context_destroy(context);
}

int main(int argc, char **argv) {
    if (argc > 1) maps = strtoull(argv[1], NULL, 10);
    if (argc > 2) seed = strtoull(argv[2], NULL, 10);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_axial_maps),      cmocka_unit_test(test_turned_maps),
        cmocka_unit_test(test_slanted_maps),    cmocka_unit_test(test_points_of_all_maps),
        cmocka_unit_test(test_points_far_away), cmocka_unit_test(test_known_answers),
        cmocka_unit_test(test_large_things),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/// What is inside of a map without starts: what a disc of the width of an entrance cannot enter.
#include "testing.h"

#include "map/scan.h"
#include "map/unit.h"
#include "sightline/support.h"

#include <math.h>

// --- maps

typedef struct plan {
    testing_memory memory;
    sl_context *context;
    sl_map map; ///< with its interior
    sl_space space;
} plan;

static void open_plan(sl_map *map, plan *p) {
    p->map = *map;
    *map = (sl_map){0};
    assert_ok(p->context, sl_map_clean(p->context, &p->map, NULL, NULL));
    assert_ok(p->context, sl_map_find_inside(p->context, &p->map, NULL, NULL));
    assert_ok(p->context,
              sl_subdivision_for(&p->map)->subdivide(p->context, &p->map, NULL, &p->space));
    assert_ok(p->context, sl_space_check(p->context, &p->space));
}

/// What a map is that a format other than map text makes.
typedef enum kind {
    TEXT,
    DRAWING, ///< a wide opening may be an entrance
    PICTURE  ///< what is not solid is open
} kind;

static void read_as(kind as, const char *text, plan *p) {
    sl_map map = {0};
    char all[8000];
    snprintf(all, sizeof all, "sightline 1\n%s", text);
    *p = (plan){0};
    p->context = testing_context(&p->memory);
    assert_ok(p->context, sli_map_read_text(p->context, "plan", all, strlen(all), &map));
    map.entrance_may_be_wide = as == DRAWING;
    for (size_t i = 0; i < map.wall_count && as == PICTURE; i++)
        map.walls[i].ground |= map.walls[i].ground & SL_SOLID_LEFT ? SL_OPEN_RIGHT : SL_OPEN_LEFT;
    open_plan(&map, p);
}

static void read_plan(const char *text, plan *p) {
    read_as(TEXT, text, p);
}

static void close_plan(plan *p) {
    sl_map_destroy(p->context, &p->map);
    sl_space_destroy(p->context, &p->space);
    sl_context_destroy(p->context);
    assert_int_equal(p->memory.live, 0);
}

static bool is_inside(const plan *p, sl_point at) {
    const uint32_t cell = sl_space_locate(&p->space, at);
    return cell != SL_NO_CELL && p->space.cells[cell].inside;
}

static sl_inside doubt_of(plan *p) {
    sl_inside doubt = SL_INSIDE_NONE;
    assert_ok(p->context, sl_doubt_inside(p->context, &p->map, &p->space, &doubt));
    return doubt;
}

/// A turn and a scale of all that a map has, and a way to look places up in it.
typedef struct turned {
    double cos, sin, x, y;
} turned;

static sl_point turn(const turned *t, double x, double y) {
    return (sl_point){t->cos * x - t->sin * y + t->x, t->sin * x + t->cos * y + t->y};
}

static turned turned_by(double degrees, double scale, double x, double y) {
    const double angle = degrees * 3.14159265358979323846 / 180;
    if (degrees == 0) return (turned){scale, 0, x, y};
    return (turned){scale * cos(angle), scale * sin(angle), x, y};
}

static void turn_plan(const char *text, const turned *t, plan *p) {
    sl_map map = {0};
    char all[8000];
    snprintf(all, sizeof all, "sightline 1\n%s", text);
    *p = (plan){0};
    p->context = testing_context(&p->memory);
    assert_ok(p->context, sli_map_read_text(p->context, "plan", all, strlen(all), &map));
    for (size_t i = 0; i < map.wall_count; i++) {
        sl_wall *w = &map.walls[i];
        w->a = turn(t, w->a.x, w->a.y);
        w->b = turn(t, w->b.x, w->b.y);
    }
    open_plan(&map, p);
}

// --- a house: thick walls, a hall, two rooms

/// Outer walls 0.3 thick, 10 by 8; an entrance from x = 3 on; the hall below y = 4; rooms left and
/// right of x = 5 above it. `doors` 0.9 wide lead from the hall to the left room, then to the right
/// one; rooms without a door are closed. `unit` and other statements come first.
static void say_house(const char *first, double entrance, int doors, char text[4000]) {
    const double e = 3 + entrance;
    int n = snprintf(text, 4000,
                     "%s"
                     "walls %.17g 0 10 0 10 8 0 8 0 0 3 0 3 0.3 0.3 0.3 0.3 4\n"
                     "walls %.17g 0 %.17g 0.3 9.7 0.3 9.7 4\n",
                     first, e, e, e);
    n += snprintf(text + n, 4000 - (size_t)n, "walls 0.3 4 ");
    if (doors > 0) n += snprintf(text + n, 4000 - (size_t)n, "2 4 2 4.3\nwalls 2.9 4.3 2.9 4 ");
    if (doors > 1) n += snprintf(text + n, 4000 - (size_t)n, "7 4 7 4.3\nwalls 7.9 4.3 7.9 4 ");
    n += snprintf(text + n, 4000 - (size_t)n, "9.7 4\n");
    n += snprintf(text + n, 4000 - (size_t)n,
                  doors > 0 ? "walls 2 4.3 0.3 4.3 0.3 7.7 4.85 7.7 4.85 4.3 2.9 4.3\n"
                            : "walls 0.3 4.3 0.3 7.7 4.85 7.7 4.85 4.3 0.3 4.3\n");
    snprintf(text + n, 4000 - (size_t)n,
             doors > 1 ? "walls 7 4.3 5.15 4.3 5.15 7.7 9.7 7.7 9.7 4.3 7.9 4.3\n"
                       : "walls 5.15 4.3 5.15 7.7 9.7 7.7 9.7 4.3 5.15 4.3\n");
}

static const sl_point hall = {7, 2}, rooms[2] = {{2.5, 6}, {7.5, 6}};
static const sl_point cores[] = {{0.15, 3}, {5, 6}, {1, 4.15}, {9.85, 6}, {6, 0.15}, {4.3, 7.85}};

static void test_house(void **state) {
    (void)state;
    static const double widths[] = {0.8, 0.9, 1.0, 1.1, 1.2}, angles[] = {0, 17.3, 45, 90};
    static const char *const units[] = {"", "unit m\n", "entrance 1.2\n", "entrance 1.2 doors\n"};
    for (int i = 0; i < 5 * 4 * 3 * 4; i++) {
        const double width = widths[i % 5];
        const turned t = turned_by(angles[i / 5 % 4], 1, i % 7 * 100, i % 3 * 1000);
        const int doors = i / 20 % 3;
        char text[4000];
        plan p;
        say_house(units[i / 60], width, doors, text);
        turn_plan(text, &t, &p);
        assert_true(is_inside(&p, turn(&t, hall.x, hall.y)));
        for (int k = 0; k < 2; k++) assert_true(is_inside(&p, turn(&t, rooms[k].x, rooms[k].y)));
        for (size_t k = 0; k < sizeof cores / sizeof *cores; k++)
            assert_false(is_inside(&p, turn(&t, cores[k].x, cores[k].y)));
        assert_true(is_inside(&p, turn(&t, 3 + width / 2, 0.15)));
        assert_int_equal(doubt_of(&p), SL_INSIDE_SURE);
        assert_int_equal(p.map.interior.entrances, 1);
        const double area = 9.4 * 3.7 + 2 * 4.55 * 3.4 + 0.3 * width + 0.3 * 0.9 * doors;
        const sl_ground_shares shares = sl_space_ground(&p.space);
        const sl_box b = p.space.bounds;
        assert_float_equal(shares.inside * (b.max.x - b.min.x) * (b.max.y - b.min.y), area, 1e-9);
        close_plan(&p);
    }
}

/// How much walls enclose is the same however the plan is turned: a long room, and a small room
/// beside a long wall.
static void test_enclosed(void **state) {
    (void)state;
    static const double angles[] = {0, 17.3, 45, 90};
    static const struct {
        const char *text;
        double share;
        sl_inside doubt;
    } plans[] = {
        {"walls 0 0 10 0 10 2 0 2 0 0\n", 1, SL_INSIDE_SURE},
        {"walls 0 0 10 0 10 1 5 1 5 2 0 2 0 0\n", 15 / 17.5, SL_INSIDE_SURE},
        {"walls 0 0 2 0 2 2 0 2 0 0\nwalls 10 0 10 2\n", 0.2, SL_INSIDE_SMALL},
    };
    for (int i = 0; i < 4 * 3; i++) {
        const turned t = turned_by(angles[i % 4], 1, 100, 1000);
        double share;
        plan p;
        turn_plan(plans[i / 4].text, &t, &p);
        assert_int_equal(sl_space_enclosed(p.context, &p.space, &share), SL_OK);
        assert_float_equal(share, plans[i / 4].share, 1e-9);
        assert_int_equal(doubt_of(&p), plans[i / 4].doubt);
        close_plan(&p);
    }
}

/// A house of one loop, or of four walls that are drawn as rectangles. It has a toilet and a
/// corridor that thin walls close.
static void say_thick(const char *first, double e, double t, bool apart, char text[4000]) {
    const double w = 10 - t, h = 8 - t;
    int n = snprintf(text, 4000, "%s", first);
    if (apart)
        n += snprintf(text + n, 4000 - (size_t)n,
                      "walls 0 0 3 0 3 %g 0 %g 0 0\nwalls %g 0 10 0 10 %g %g %g %g 0\n"
                      "walls 0 %g 0 8 10 8 10 %g 0 %g\nwalls 0 %g %g %g %g %g\n"
                      "walls 10 %g %g %g %g %g\n",
                      t, t, 3 + e, t, 3 + e, t, 3 + e, h, h, h, t, t, t, t, h, t, w, t, w, h);
    else
        n += snprintf(text + n, 4000 - (size_t)n,
                      "walls %g 0 10 0 10 8 0 8 0 0 3 0 3 %g %g %g %g %g %g %g %g %g %g %g %g 0\n",
                      3 + e, t, t, t, t, h, w, h, w, t, 3 + e, t, 3 + e);
    snprintf(text + n, 4000 - (size_t)n,
             "walls %g 5.8 %g 5.8 %g 4 %g 4\nwalls %g 4 %g 4 %g 4.95 %g 4.95\n", t, t + 0.9,
             t + 0.9, t, t + 0.9, t + 5.4, t + 5.4, t + 0.9);
}

/// Half a disc fits in cores of thick walls, too: these are not inside. Short rooms and corridors
/// that are narrower than an entrance are.
static void test_thick_walls(void **state) {
    (void)state;
    static const double thick[] = {0.365, 0.5, 0.6, 0.65}, angles[] = {0, 17.3, 45};
    static const char *const units[] = {"", "unit m\n", "entrance 1.2\n"};
    for (int i = 0; i < 4 * 3 * 3 * 2 * 3; i++) {
        const double t = thick[i % 4], e = 0.8 + 0.2 * (i / 4 % 3);
        const turned turns = turned_by(angles[i / 12 % 3], 1, 0, 0);
        char text[4000];
        plan p;
        say_thick(units[i / 72], e, t, i / 36 % 2, text);
        turn_plan(text, &turns, &p);
        const sl_point in[] = {{6, 2}, {t + 0.4, 5}, {t + 3, 4.5}};
        const sl_point core[] = {{t / 2, 3},     {10 - t / 2, 3}, {5, 8 - t / 2},
                                 {t / 4, t / 4}, {1, t / 2},      {7, t / 2}};
        for (int k = 0; k < 3; k++) assert_true(is_inside(&p, turn(&turns, in[k].x, in[k].y)));
        for (int k = 0; k < 6; k++) assert_false(is_inside(&p, turn(&turns, core[k].x, core[k].y)));
        close_plan(&p);
    }
}

/// An opening that is wider than entrances: the house is not inside by halves.
static void test_wide_entrance(void **state) {
    (void)state;
    for (int i = 0; i < 9; i++) {
        const turned t = turned_by(i % 3 * 17.3, 1, 0, 0);
        const int doors = i / 3;
        char text[4000];
        plan p;
        say_house("unit m\n", 2, doors, text);
        turn_plan(text, &t, &p);
        assert_int_equal(doubt_of(&p), SL_INSIDE_OPENING);
        assert_float_equal(p.map.interior.doubtful_width, 2, 1e-9);
        assert_int_equal(p.map.interior.place_count, 0);
        assert_int_equal(p.space.inside_count, p.space.cell_count);
        close_plan(&p);
        say_thick("unit m\n", 2, 0.65, doors,
                  text); // a closed room, cores in which half a disc fits
        turn_plan(text, &t, &p);
        assert_int_equal(doubt_of(&p), SL_INSIDE_OPENING);
        assert_int_equal(p.map.interior.place_count, 0);
        close_plan(&p);
        say_house("", 2.4, 2, text); // the width that is found is that of inner doors
        turn_plan(text, &t, &p);
        assert_int_equal(doubt_of(&p), SL_INSIDE_OPENING);
        assert_int_equal(p.map.interior.place_count, 0);
        close_plan(&p);
        say_house("unit m\nentrance 2\n", 2, doors, text);
        turn_plan(text, &t, &p);
        assert_int_equal(doubt_of(&p), SL_INSIDE_SURE);
        assert_true(is_inside(&p, turn(&t, hall.x, hall.y)));
        assert_true(is_inside(&p, turn(&t, rooms[0].x, rooms[0].y)));
        assert_false(is_inside(&p, turn(&t, cores[0].x, cores[0].y)));
        close_plan(&p);
    }
}

// --- the width of channels, exactly

/// A room of 40 by 30 within a map of 60 by 50, whose walls end `gap` apart in one corner.
static void test_exact(void **state) {
    (void)state;
    static const struct {
        const char *walls;
        double width;
    } cases[] = {
        // from an end to an end, 3-4-5
        {"walls 14 10 50 10 50 40 10 40 10 13\nwall 0 0 1 0\nwall 59 50 60 50\n", 5},
        // from an end to the foot on a wall
        {"walls 10 0 10 40 50 40 50 10 13 10\nwall 0 0 1 0\nwall 59 50 60 50\n", 3},
        // from an end to the foot on an oblique wall
        {"walls 10 10 50 40 10 40 10 30 23 26\nwall 0 0 1 0\nwall 59 50 60 50\n", 5},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int step = -1; step <= 1; step++) {
            char text[400], number[SL_NUMBER_TEXT];
            plan p;
            // Widths in the last digits that cleaning does not take for one place.
            const double width = cases[i].width + step * 1e-11;
            sl_number_write(width, number);
            snprintf(text, sizeof text, "entrance %s\n%s", number, cases[i].walls);
            read_plan(text, &p);
            assert_int_equal(p.map.interior.place_count, step >= 0);
            if (step >= 0) {
                assert_true(is_inside(&p, (sl_point){25, 33}));
                assert_false(is_inside(&p, (sl_point){55, 45}));
            }
            close_plan(&p);
        }
}

// --- against a disc that is pushed about

enum { SIDE = 12, FINE = 8, LATTICE = (SIDE + 8) * FINE + 1 };

typedef struct lattice {
    float clearance[LATTICE][LATTICE];
    bool reached[LATTICE][LATTICE];
    uint32_t stack[LATTICE * LATTICE];
} lattice;

static sl_point point_at(int i, int k) {
    return (sl_point){(double)i / FINE - 4, (double)k / FINE - 4};
}

static double to_wall(sl_point p, const sl_wall *w) {
    const double dx = w->b.x - w->a.x, dy = w->b.y - w->a.y;
    const double share = ((p.x - w->a.x) * dx + (p.y - w->a.y) * dy) / (dx * dx + dy * dy);
    const double held = fmin(fmax(share, 0), 1);
    return hypot(w->a.x + held * dx - p.x, w->a.y + held * dy - p.y);
}

static void measure(const sl_map *map, lattice *l) {
    for (int i = 0; i < LATTICE; i++)
        for (int k = 0; k < LATTICE; k++) {
            double least = 100;
            for (size_t w = 0; w < map->wall_count; w++)
                least = fmin(least, to_wall(point_at(i, k), &map->walls[w]));
            l->clearance[i][k] = (float)least;
        }
}

/// Marks the places that a disc reaches from a corner of the lattice where its middle has at least
/// this clearance.
static void push_disc(lattice *l, double clearance) {
    size_t count = 0;
    memset(l->reached, 0, sizeof l->reached);
    l->reached[0][0] = true;
    l->stack[count++] = 0;
    while (count) {
        const uint32_t at = l->stack[--count];
        const int i = (int)(at / LATTICE), k = (int)(at % LATTICE);
        for (int way = 0; way < 4; way++) {
            const int x = i + (way == 0) - (way == 1), y = k + (way == 2) - (way == 3);
            if (x < 0 || y < 0 || x == LATTICE || y == LATTICE || l->reached[x][y] ||
                !(l->clearance[x][y] >= clearance))
                continue;
            l->reached[x][y] = true;
            l->stack[count++] = (uint32_t)(x * LATTICE + y);
        }
    }
}

static void make_walls(sl_random *random, bool oblique, double width, char text[4000]) {
    int n = snprintf(text, 4000, "entrance %g\nwall 0 0 12 0\nwall 12 0 12 12\n", width);
    const uint64_t count = 4 + sl_random_below(random, 20);
    for (uint64_t i = 0; i < count; i++) {
        const unsigned x = (unsigned)sl_random_below(random, 13),
                       y = (unsigned)sl_random_below(random, 13);
        unsigned to_x = (unsigned)sl_random_below(random, 13),
                 to_y = (unsigned)sl_random_below(random, 13);
        if (!oblique && sl_random_below(random, 2)) to_x = x;
        if (!oblique && to_x != x) to_y = y;
        if (to_x == x && to_y == y) continue;
        n += snprintf(text + n, 4000 - (size_t)n, "wall %u %u %u %u\n", x, y, to_x, to_y);
    }
}

/// Compares places where a disc surely gets to, or surely does not. Returns how many are enclosed.
static size_t compare(const plan *p, lattice *l, double width) {
    size_t enclosed = 0;
    static bool surely[LATTICE][LATTICE];
    push_disc(l, width / 2 + 0.75 / FINE);
    memcpy(surely, l->reached, sizeof surely);
    push_disc(l, width / 2 - 0.75 / FINE);
    for (int i = 4 * FINE; i < LATTICE - 4 * FINE; i++)
        for (int k = 4 * FINE; k < LATTICE - 4 * FINE; k++) {
            // Seams of axial maps go around by up to half of that: 0.5 to the root of 2 times.
            if (l->clearance[i][k] < 0.708 * width) continue;
            const bool inside = is_inside(p, point_at(i, k));
            if (!l->reached[i][k]) {
                assert_true(inside);
                enclosed++;
            } else if (surely[i][k]) {
                assert_true(!inside || !p->map.interior.place_count);
            }
        }
    return enclosed;
}

static void test_disc(void **state) {
    (void)state;
    sl_random random = {41};
    lattice *l = malloc(sizeof *l);
    size_t enclosed = 0, maps = 0;
    assert_non_null(l);
    for (uint64_t round = 0; round < testing_seeds(120); round++) {
        const double width = 0.7 + 0.37 * (double)sl_random_below(&random, 6);
        char text[4000];
        plan p;
        make_walls(&random, round % 2, width, text);
        read_plan(text, &p);
        measure(&p.map, l);
        const size_t found = compare(&p, l, width);
        enclosed += found;
        maps += found > 0;
        close_plan(&p);
    }
    free(l);
    print_message("%zu places are enclosed, on %zu maps\n", enclosed, maps);
    assert_true(maps > 0);
}

// --- what is not inside

static void test_outdoors(void **state) {
    (void)state;
    static const struct {
        const char *map;
        sl_point in, out; ///< a place that is inside, and one that is not
    } cases[] = {
        // an alley between two houses, and a recess in a wall
        {"unit m\nwalls 0 0 6 0 6 8 0 8 0 0\nwalls 7 0 15 0 15 3 14 3 14 4 15 4 15 8 7 8 7 0\n",
         {3, 4},
         {6.5, 4}},
        {"unit m\nwalls 0 0 6 0 6 8 0 8 0 0\nwalls 7 0 15 0 15 3 14 3 14 4 15 4 15 8 7 8 7 0\n",
         {10, 4},
         {14.5, 3.5}},
        // a yard behind a wide gate is outdoors, a closed house in it is not
        {"unit m\nwalls 0 0 20 0 20 20 12 20\nwalls 6 20 0 20 0 0\nwalls 5 5 9 5 9 9 5 9 5 5\n",
         {7, 7},
         {15, 15}},
        // a door is an entrance, however wide
        {"unit m\nwalls 0 0 4 0\nwalls 7 0 12 0 12 9 0 9 0 0\ndoor gate 4 0 7 0 open\n"
         "wall -5 -5 -4 -5\n",
         {6, 5},
         {-2, 3}},
        // a closet that is closed, of which the unit says that nobody fits in
        {"unit m\nwalls 0 0 8 0 8 6 0 6 0 0\nwalls 3 3 3.5 3 3.5 3.5 3 3.5 3 3\n",
         {1, 1},
         {3.25, 3.25}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        plan p;
        read_plan(cases[i].map, &p);
        assert_true(is_inside(&p, cases[i].in));
        assert_false(is_inside(&p, cases[i].out));
        close_plan(&p);
    }
}

/// A corridor with an open end, and rooms with doors to it: the rooms are not inside without it. A
/// room with an entrance of its own belongs to the same building.
static void test_corridor(void **state) {
    (void)state;
    static const char walls[] = "walls 0 0 12 0 12 10 0 10 0 6 3 6\nwalls 3.9 6 8 6\n"
                                "walls 8.9 6 12 6\nwall 6 6 6 10\nwalls 0 0 0 4 1 4\n"
                                "walls 1.9 4 8 4\nwalls 8.9 4 12 4\nwalls 6 0 6 1\n"
                                "walls 6 1.9 6 4\n";
    static const sl_point within[] = {{3, 8}, {9, 8}, {3, 2}, {9, 2}}, corridor = {5, 5};
    char text[4000];
    plan p;
    snprintf(text, sizeof text, "unit m\n%s", walls);
    read_plan(text, &p);
    assert_int_equal(doubt_of(&p), SL_INSIDE_OPENING);
    assert_float_equal(p.map.interior.doubtful_width, 2, 1e-9);
    assert_int_equal(p.map.interior.place_count, 0);
    close_plan(&p);
    snprintf(text, sizeof text, "entrance 2\n%s", walls);
    read_plan(text, &p);
    assert_int_equal(doubt_of(&p), SL_INSIDE_SURE);
    assert_true(is_inside(&p, corridor));
    for (int i = 0; i < 4; i++) assert_true(is_inside(&p, within[i]));
    close_plan(&p);
    // The room at the lower left also has a window to the street.
    snprintf(text, sizeof text, "unit m\n%swall -1 -3 13 -3\n", walls);
    char *below = strstr(text, "0 0 12 0");
    assert_non_null(below);
    *below = '2';
    strcat(text, "wall 0 0 1.1 0\n");
    read_plan(text, &p);
    assert_int_equal(doubt_of(&p), SL_INSIDE_OPENING);
    assert_int_equal(p.map.interior.place_count, 0);
    close_plan(&p);
}

/// A closed building with two wings. The yard between them is roomier than its rooms are; the place
/// that a start is proposed in is in the building.
static void test_roomiest(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        const turned t = turned_by(i * 17.3, 1, 0, 0);
        plan p;
        turn_plan("walls 0 0 12 0 12 10 7.5 10 7.5 2 4.5 2 4.5 10 0 10 0 0\nwall 1.5 1.5 1.5 9\n"
                  "wall 3 1.5 3 9\nwall 9 1.5 9 9\nwall 10.5 1.5 10.5 9\n"
                  "walls 0.2 0.2 0.9 0.2 0.9 0.9 0.2 0.9 0.2 0.2\n",
                  &t, &p);
        assert_true(is_inside(&p, p.map.interior.roomiest));
        assert_false(is_inside(&p, turn(&t, 6, 6)));
        close_plan(&p);
    }
}

/// Without an opening and a unit all is as walls enclose it, however small.
static void test_closed(void **state) {
    (void)state;
    plan p;
    read_plan("walls 0 0 8 0 8 6 0 6 0 0\nwalls 3 3 3.5 3 3.5 3.5 3 3.5 3 3\n", &p);
    assert_true(is_inside(&p, (sl_point){1, 1}) && is_inside(&p, (sl_point){3.25, 3.25}));
    assert_int_equal(p.map.interior.by, SL_ENTRANCE_NONE);
    assert_int_equal(p.map.seam_count, 0);
    close_plan(&p);
}

/// Where all walls say what is solid and what is open, pockets of rock are no rooms, and their
/// openings no doubt.
static void test_known_ground(void **state) {
    (void)state;
    plan p;
    read_plan(
        "unit m\nopen 0 0 20 0 20 10 16 10 16 16 12 16 12 15.5 15.5 15.5 15.5 10.5 10 10.5 10 "
        "15.5 10.6 15.5 10.6 16 9.5 16 9.5 10 0 10\n",
        &p);
    assert_true(is_inside(&p, (sl_point){1, 1}) && !is_inside(&p, (sl_point){13, 13}));
    assert_true(p.map.interior.doubtful_width == 0);
    assert_int_equal(p.map.interior.by, SL_ENTRANCE_NONE);
    close_plan(&p);
}

/// A picture says for each wall what is solid and what is open. Where the ground around is open,
/// entrances part it from rooms; solid ground does so by itself.
static void test_open_around(void **state) {
    (void)state;
    static const char house[] = "solid 4 0 10 0 10 8 0 8 0 0 3 0 3 0.3 0.3 0.3 0.3 7.7 9.7 7.7 9.7 "
                                "0.3 4 0.3\nsolid 14 -5 15 -5 15 -4 14 -4\n";
    static const char *const around[] = {"", "solid -9 -9 -8 -9 -8 -8 -9 -8\n",
                                         "open -20 -20 30 -20 30 30 -20 30\n"};
    for (int i = 0; i < 3; i++) {
        char text[600];
        plan p;
        snprintf(text, sizeof text, "unit m\n%s%s", house, around[i]);
        read_as(PICTURE, text, &p);
        assert_true(is_inside(&p, (sl_point){5, 4}));
        assert_int_equal(is_inside(&p, (sl_point){13, 4}), i == 2);
        assert_int_equal(p.map.interior.by, i == 2 ? SL_ENTRANCE_NONE : SL_ENTRANCE_UNIT);
        close_plan(&p);
    }
}

/// What lies around the rooms that a start reaches is no room, if there is solid ground: the void
/// of a game. What lies beside them is, and so is all in a map of lines.
static void test_void_around(void **state) {
    (void)state;
#define HALL "walls 6 6 14 6 14 14 6 14 6 6\nstart 10 10 0\n"
    static const char *const plans[] = {
        "open 0 0 20 0 20 20 0 20\nsolid 5 5 15 5 15 15 5 15\nopen 6 6 14 6 14 14 6 14\n"
        "start 10 10 0\n",
        "walls 0 0 20 0 20 20 0 20 0 0\n" HALL,
        "open 0 0 20 0 20 20 0 20\nsolid 0 5 20 5 20 15 0 15\nopen 6 6 14 6 14 14 6 14\n"
        "start 10 10 0\n"};
    for (int i = 0; i < 3; i++) {
        plan p;
        read_plan(plans[i], &p);
        assert_int_equal(doubt_of(&p), i ? SL_INSIDE_FEW : SL_INSIDE_SURE);
        close_plan(&p);
    }
}

/// Nearly nothing is inside, whatever is said of how it was found: this is a doubt.
static void test_nearly_nothing(void **state) {
    (void)state;
#define FAR "wall 999 999 1000 1000\n"
    static const char *const plans[] = {"entrance 1.2\nwalls 1 0 2 0 2 2 0 2 0 0\n" FAR,
                                        "unit m\nwalls 1 0 2 0 2 2 0 2 0 0\n" FAR,
                                        "walls 0 0 2 0 2 2 0 2 0 0\nstart 1 1 0\n" FAR};
    for (int i = 0; i < 3; i++) {
        char said[SL_INSIDE_TEXT];
        plan p;
        read_plan(plans[i], &p);
        assert_int_equal(doubt_of(&p), i < 2 ? SL_INSIDE_SMALL : SL_INSIDE_FEW);
        assert_true(p.space.inside_count > 0);
        assert_ok(p.context, sl_say_inside(p.context, &p.map, &p.space, said));
        assert_true(*said);
        close_plan(&p);
    }
}

static void assert_same_inside(const plan *a, const plan *b) {
    const sl_interior *found = &a->map.interior, *other = &b->map.interior;
    assert_int_equal(found->by, other->by);
    assert_true(found->width == other->width);
    assert_true(found->doubtful_width == other->doubtful_width);
    assert_int_equal(found->entrances, other->entrances);
    assert_int_equal(found->place_count, other->place_count);
    assert_int_equal(a->map.seam_count, b->map.seam_count);
    for (size_t i = 0; i < a->map.seam_count; i++)
        assert_memory_equal(&a->map.seams[i].segment, &b->map.seams[i].segment, sizeof(sl_segment));
    assert_int_equal(a->space.inside_count, b->space.inside_count);
}

/// A drawing with a garage, or with one in another house that is wider: these are entrances.
static void test_wide_of_drawing(void **state) {
    (void)state;
    static const char other[] = "walls 33.5 0 36 0 36 6 30 6 30 0\n";
    for (int i = 0; i < 2; i++) {
        char text[4100];
        plan p;
        say_house("unit m\n", 2, 2, text);
        if (i) strcat(text, other);
        read_as(DRAWING, text, &p);
        assert_int_equal(p.map.interior.by, SL_ENTRANCE_WIDE);
        assert_float_equal(p.map.interior.width, i ? 3.5 : 2, 1e-9);
        assert_int_equal(doubt_of(&p), SL_INSIDE_SURE);
        assert_true(is_inside(&p, hall) && is_inside(&p, rooms[0]) && !is_inside(&p, cores[0]));
        assert_int_equal(is_inside(&p, (sl_point){33, 3}), i);
        close_plan(&p);
    }
}

/// Where no building is inside by the wide opening, or the width is that of openings that are small
/// against the plan and a wider one is doubtful, too, the answer is that of other maps, seams
/// included.
static void test_narrow_of_drawing(void **state) {
    (void)state;
    static const char fences[] = "wall -50 -20 90 -20\nwall -50 -40 90 -40\nwall -50 -60 90 -60\n"
                                 "walls 40 0 48 0 48 8 40 8 40 1\n";
    static const char yard[] = "walls 62.8 0 65 0 65 5 60 5 60 0\nwalls 249 0 250 0 250 9\n";
    for (int i = 0; i < 2; i++) {
        char text[4200];
        plan of_text, of_drawing;
        say_house(i ? "" : "unit m\n", i ? 2.4 : 2, 2, text);
        strcat(text, i ? yard : fences);
        read_as(TEXT, text, &of_text);
        read_as(DRAWING, text, &of_drawing);
        assert_true(of_text.map.interior.doubtful_width > 0);
        assert_same_inside(&of_text, &of_drawing);
        close_plan(&of_text);
        close_plan(&of_drawing);
    }
}

/// A drawing whose walls nearly meet: the gap that is somewhat wider than the others is none to the
/// outside either, if no opening at all is doubtful then.
static void test_small_of_drawing(void **state) {
    (void)state;
    char text[4200];
    plan p;
    say_house("", 2.4, 2, text);
    strcat(text, "wall 300 0 301 0\n");
    read_plan(text, &p);
    assert_true(p.map.interior.doubtful_width > 0);
    close_plan(&p);
    read_as(DRAWING, text, &p);
    assert_int_equal(p.map.interior.by, SL_ENTRANCE_WIDE);
    assert_float_equal(p.map.interior.width, 2.4, 1e-9);
    assert_int_equal(doubt_of(&p), SL_INSIDE_SURE);
    assert_true(is_inside(&p, hall) && is_inside(&p, rooms[0]) && !is_inside(&p, cores[0]));
    close_plan(&p);
}

/// A drawing of rooms that are closed but for one with a wide opening: that is an entrance, as
/// wider ones would change nothing. Where what is inside hangs on the width, the narrow answer
/// stays.
static void test_steady_of_drawing(void **state) {
    (void)state;
    static const char rooms_of[] = "unit m\nwalls 1.8 0 30 0 30 20 0 20 0 0\n"
                                   "wall 10 0 10 20\nwall 20 0 20 20\nwall 0 10 30 10\n";
    static const char yard[] = "walls 43 0 60 0 60 20 40 20 40 0\n"
                               "wall 0 40 100 40\nwall 0 50 100 50\nwall 0 60 100 60\n";
    for (int i = 0; i < 2; i++) {
        char text[600];
        plan of_text, of_drawing;
        snprintf(text, sizeof text, "%s%s", rooms_of, i ? yard : "");
        read_as(TEXT, text, &of_text);
        read_as(DRAWING, text, &of_drawing);
        assert_true(of_text.map.interior.doubtful_width > 0);
        if (i) {
            assert_same_inside(&of_text, &of_drawing);
        } else {
            assert_int_equal(of_drawing.map.interior.by, SL_ENTRANCE_WIDE);
            assert_float_equal(of_drawing.map.interior.width, 1.8, 1e-9);
            assert_int_equal(doubt_of(&of_drawing), SL_INSIDE_SURE);
            assert_true(is_inside(&of_drawing, (sl_point){5, 5}));
            assert_true(is_inside(&of_drawing, (sl_point){25, 15}));
        }
        close_plan(&of_text);
        close_plan(&of_drawing);
    }
}

/// A drawing with a pair of doors as its entrance, and doors to its rooms that are drawn: whether
/// these are kept as doors or are gaps, the same is inside.
static void test_doors_of_drawing(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        char text[4200];
        plan p;
        say_house("unit m\n", 2, 2, text);
        if (i)
            strcat(text, "door a 2 4 2.9 4\ndoor b 2 4.3 2.9 4.3\ndoor c 7 4 7.9 4\n"
                         "door d 7 4.3 7.9 4.3\ndoor e 3.4 0.3 3.4 4\ndoor f 5.6 0.3 5.6 4\n");
        read_as(DRAWING, text, &p);
        assert_int_equal(p.map.interior.by, SL_ENTRANCE_WIDE);
        assert_int_equal(doubt_of(&p), SL_INSIDE_SURE);
        assert_true(is_inside(&p, hall) && is_inside(&p, rooms[0]) && is_inside(&p, rooms[1]));
        close_plan(&p);
    }
}

/// Starts go before it, and what was found is found again without doubling seams.
static void test_again(void **state) {
    (void)state;
    char text[4000];
    plan p;
    say_house("unit m\nwall -5 -5 -4 -5\n", 1, 2, text);
    read_plan(text, &p);
    const size_t seams = p.map.seam_count;
    assert_true(seams > 0);
    assert_ok(p.context, sl_map_find_inside(p.context, &p.map, NULL, NULL));
    assert_int_equal(p.map.seam_count, seams);
    for (size_t i = 0; i < seams; i++) p.map.seams[i].entrance = false; // as a file has them
    assert_ok(p.context, sl_map_find_inside(p.context, &p.map, NULL, NULL));
    assert_int_equal(p.map.seam_count, seams);
    assert_ok(p.context, sl_map_add_start(p.context, &p.map, (sl_point){5, 2}, 0, 0));
    assert_ok(p.context, sl_map_find_inside(p.context, &p.map, NULL, NULL));
    assert_int_equal(p.map.seam_count, 0);
    assert_int_equal(p.map.interior.place_count, 0);
    close_plan(&p);
}

/// What each lack of memory leaves behind can be destroyed.
static void test_memory(void **state) {
    (void)state;
    char text[4000], all[4100];
    const turned t = turned_by(17.3, 1, 0, 0);
    say_house("", 1, 2, text);
    snprintf(all, sizeof all, "sightline 1\n%s", text);
    long failed = 0;
    for (bool done = false; !done;) {
        testing_memory memory = {0};
        sl_context *context = testing_context(&memory);
        sl_map map = {0};
        assert_ok(context, sli_map_read_text(context, "plan", all, strlen(all), &map));
        for (size_t i = 0; i < map.wall_count; i++) {
            map.walls[i].a = turn(&t, map.walls[i].a.x, map.walls[i].a.y);
            map.walls[i].b = turn(&t, map.walls[i].b.x, map.walls[i].b.y);
        }
        assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
        memory.fail_at = memory.calls + 1 + failed;
        const sl_status status = sl_map_find_inside(context, &map, NULL, NULL);
        assert_true(status == SL_OK || status == SL_NO_MEMORY);
        done = status == SL_OK;
        failed += !done;
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
        assert_int_equal(memory.live, 0);
    }
    assert_true(failed > 20);
}

/// Walls that nearly meet leave slits, which are no entrances where the plan has some; where it has
/// none, they are.
static void test_slits(void **state) {
    (void)state;
    static const struct {
        const char *walls;
        bool hall; ///< is inside
    } plans[] = {
        {"walls 4 0 10 0 10 8 0 8 0 0 3 0\nwall 6 8 6 0.0001\n", true},
        {"walls 0.0001 0 10 0 10 8 0 8 0 0\nwall 6 8 6 0\n", true},
    };
    for (int i = 0; i < 6; i++) {
        const turned t = turned_by(i % 3 * 17.3, 1, 0, 0);
        char text[4000];
        plan p;
        snprintf(text, sizeof text, "%s", plans[i / 3].walls);
        turn_plan(text, &t, &p);
        assert_true(is_inside(&p, turn(&t, 8, 4)));
        assert_int_equal(is_inside(&p, turn(&t, 3, 4)), plans[i / 3].hall);
        const double width = p.map.interior.width; // that of a slit is one that people can see
        if (i < 3) assert_true(width >= 1 && width < 1.1);
        if (i >= 3) assert_true(width >= 0.01 && width < 0.015);
        close_plan(&p);
    }
}

/// Where a window is at the border of the map, the space goes on beyond it, and inside still ends
/// at the entrances that lie on that border.
static void test_window_at_border(void **state) {
    (void)state;
    static const char *const windows[] = {"", "wall 10 2 10 5 stops steps,sound\n",
                                          "wall 7 0 9 0 stops steps,sound\n"};
    for (int i = 0; i < 3; i++) {
        const turned t = turned_by(0, 1, 0, 0);
        char text[4000];
        plan p;
        snprintf(text, sizeof text, "unit m\nwalls 4 0 10 0 10 8 0 8 0 0 3 0\n%s", windows[i]);
        turn_plan(text, &t, &p);
        assert_true(is_inside(&p, (sl_point){5, 4}));
        assert_int_equal(doubt_of(&p), SL_INSIDE_SURE);
        assert_int_equal(p.map.interior.entrances, 1);
        for (int k = 0; k < 4 && i; k++)
            assert_false(is_inside(&p, (sl_point){k % 2 ? 3.5 : 10.3, k / 2 ? 8.3 : -0.3}));
        close_plan(&p);
    }
}

/// A house with one room, whose walls 0.5 thick have an opening of 0.1 into their core, and an
/// entrance.
static void say_open_core(const char *first, double entrance, char text[4000]) {
    const double e = 3 + entrance;
    snprintf(text, 4000,
             "%s"
             "walls 3 0 3 0.5 0.5 0.5 0.5 7.5 9.5 7.5 9.5 0.5 %.17g 0.5 %.17g 0 10 0 10 8 5.1 8\n"
             "walls 5 8 0 8 0 0 3 0\nwalls 6 3 6 7.5\n",
             first, e, e);
}

/// The width by doors counts where the one that is found is narrower than doors. A wider opening
/// is doubtful then.
static void test_by_doors(void **state) {
    (void)state;
    static const sl_point room = {3, 5}, core = {0.25, 4};
    static const struct {
        const char *first;
        double entrance;
        sl_entrance by;
        bool room, core;
        sl_inside doubt;
    } cases[] = {{"", 1, SL_ENTRANCE_FOUND, false, true, SL_INSIDE_SMALL},
                 {"entrance 1.2 doors\n", 1, SL_ENTRANCE_DOORS, true, false, SL_INSIDE_SURE},
                 {"entrance 1.2 doors\n", 2, SL_ENTRANCE_DOORS, true, true, SL_INSIDE_OPENING},
                 {"entrance 0.01 doors\n", 1, SL_ENTRANCE_FOUND, false, true, SL_INSIDE_SMALL}};
    static const double angles[] = {0, 17.3};
    for (size_t i = 0; i < 2 * sizeof cases / sizeof *cases; i++) {
        const turned t = turned_by(angles[i % 2], 1, 0, 0);
        char text[4000];
        plan p;
        say_open_core(cases[i / 2].first, cases[i / 2].entrance, text);
        turn_plan(text, &t, &p);
        assert_int_equal(p.map.interior.by, cases[i / 2].by);
        if (cases[i / 2].by == SL_ENTRANCE_DOORS)
            assert_int_equal(doubt_of(&p), cases[i / 2].doubt);
        if (cases[i / 2].doubt != SL_INSIDE_OPENING) {
            assert_int_equal(is_inside(&p, turn(&t, room.x, room.y)), cases[i / 2].room);
            assert_int_equal(is_inside(&p, turn(&t, core.x, core.y)), cases[i / 2].core);
        }
        close_plan(&p);
    }
}

static void test_units(void **state) {
    (void)state;
    assert_true(sli_unit_metres("m") == 1 && sli_unit_metres("mm") == 1e-3);
    assert_true(sli_unit_metres("ft") == 0.3048 && sli_unit_metres("in") == 0.0254);
    assert_true(sli_unit_metres("px") == 0 && sli_unit_metres("") == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_house),
        cmocka_unit_test(test_enclosed),
        cmocka_unit_test(test_wide_entrance),
        cmocka_unit_test(test_exact),
        cmocka_unit_test(test_disc),
        cmocka_unit_test(test_outdoors),
        cmocka_unit_test(test_closed),
        cmocka_unit_test(test_again),
        cmocka_unit_test(test_memory),
        cmocka_unit_test(test_units),
        cmocka_unit_test(test_by_doors),
        cmocka_unit_test(test_corridor),
        cmocka_unit_test(test_thick_walls),
        cmocka_unit_test(test_roomiest),
        cmocka_unit_test(test_slits),
        cmocka_unit_test(test_window_at_border),
        cmocka_unit_test(test_known_ground),
        cmocka_unit_test(test_open_around),
        cmocka_unit_test(test_void_around),
        cmocka_unit_test(test_nearly_nothing),
        cmocka_unit_test(test_wide_of_drawing),
        cmocka_unit_test(test_narrow_of_drawing),
        cmocka_unit_test(test_small_of_drawing),
        cmocka_unit_test(test_steady_of_drawing),
        cmocka_unit_test(test_doors_of_drawing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

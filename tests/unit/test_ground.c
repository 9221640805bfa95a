// Solid ground against an oracle of its own: squares of grids, and polygons in integers. Nothing
// here asks the library what is solid but the cells that it makes.
#include "cell_to_cell/pvs_rows.h"
#include "space/subdivide.h"
#include "testing.h"

#include "geometry/orient.h"
#include "io/parts/shapes.h"
#include "map/grid.h"
#include "map/scan.h"
#include "sightline/bake.h"
#include "sightline/support.h"
#include "unit/map_same.h"

#include <math.h>
#include <unistd.h>

// --- spaces of a map

enum { KD = 1, MESH = 2 };

/// Where a map's places go: scaled, turned, then moved.
typedef struct transform {
    double scale, sine, cosine, x, y;
} transform;

static const transform stay = {1, 0, 1, 0, 0};

static sl_point put(const transform *t, double x, double y) {
    x *= t->scale;
    y *= t->scale;
    return (sl_point){x * t->cosine - y * t->sine + t->x, x * t->sine + y * t->cosine + t->y};
}

static transform random_transform(sl_random *random) {
    transform t = stay;
    const uint64_t kind = sl_random_below(random, 5);
    const double angle = 17.3 * 3.14159265358979323846 / 180;
    if (kind == 1) t.scale = 1e-6;
    if (kind == 2) t.scale = 1e6;
    if (kind == 3 || kind == 4) t.sine = sin(angle), t.cosine = cos(angle);
    if (kind == 4) t.x = 123456.7, t.y = -7654321.9;
    return t;
}

/// Prints the map with the message of a failure.
static void fail_map(const sl_map *map, const char *what, uint64_t seed) {
    char *text = map_text(map);
    fputs(text, stderr); // print_message cuts long texts
    free(text);
    fail_msg("seed %llu: %s", (unsigned long long)seed, what);
}

static void subdivide(sl_context *context, const sl_map *map, int kind, sl_space *space) {
    const sl_subdivide_options rules = sl_subdivide_options_default();
    const sl_status status = kind == KD ? sli_subdivide_kd(context, map, &rules, space)
                                        : sli_subdivide_mesh(context, map, space);
    if (status != SL_OK) fail_map(map, sl_context_message(context), 0); // the map is clean
    assert_ok(context, sl_space_check(context, space));
}

/// What an oracle says of a place: 1 solid, 0 open, -1 nothing, as it is on a border.
typedef int oracle_of(const void *user, int x, int y);

/// Places of the oracle are in 1/PARTS of the map's unit before its transform.
enum { PARTS = 64 };

typedef struct trial {
    const sl_map *read; ///< not clean
    transform at;
    oracle_of *oracle;
    const void *user;
    int low, high; ///< the places to ask for, in units
    uint64_t seed;
} trial;

static void check_place(const trial *t, const sl_space *space, int x, int y) {
    const int is = t->oracle(t->user, x, y);
    const sl_point at = put(&t->at, (double)x / PARTS, (double)y / PARTS);
    const uint32_t cell = is < 0 ? SL_NO_CELL : sl_space_locate(space, at);
    if (cell == SL_NO_CELL) return;
    if (space->cells[cell].solid == (uint32_t)is) return;
    char what[160];
    snprintf(what, sizeof what, "%s at %d/64 %d/64 (%.17g %.17g) in cell %u of a %s",
             is ? "not solid" : "solid", x, y, at.x, at.y, cell, space->neighbour ? "mesh" : "kd");
    fail_map(t->read, what, t->seed);
}

/// The middle of each square, and random places.
static void check_places(const trial *t, const sl_space *space, sl_random *random) {
    for (int x = t->low; x < t->high; x++)
        for (int y = t->low; y < t->high; y++)
            check_place(t, space, x * PARTS + PARTS / 2, y * PARTS + PARTS / 2);
    const uint64_t side = (uint64_t)(t->high - t->low) * PARTS;
    for (int i = 0; i < 100; i++)
        check_place(t, space, t->low * PARTS + (int)sl_random_below(random, side),
                    t->low * PARTS + (int)sl_random_below(random, side));
}

/// Whether any place is open. Where none is, marks on walls cannot say how often all is covered.
static bool any_is_open(const trial *t) {
    const int step = PARTS / 2;
    for (int x = t->low * 2; x < t->high * 2; x++)
        for (int y = t->low * 2; y < t->high * 2; y++)
            if (t->oracle(t->user, x * step + PARTS / 4, y * step + PARTS / 4) == 0) return true;
    return false;
}

/// Solid ground is the same; open ground is not said of each wall in text.
static uint32_t solid_of(uint32_t ground) {
    const uint32_t open = SL_OPEN_LEFT | SL_OPEN_RIGHT;
    return (ground & open) == open ? 0 : ground & (SL_SOLID_LEFT | SL_SOLID_RIGHT);
}

static bool same_solid(const sl_space *a, const sl_space *b) {
    for (uint32_t i = 0; i < a->wall_count; i++)
        if (solid_of(a->walls[i].ground) != solid_of(b->walls[i].ground)) return false;
    return true;
}

/// A map that was written and read again gives the same space, and the same text.
static void check_text(sl_context *context, const sl_map *map, const sl_space *const spaces[3],
                       uint64_t seed) {
    char *text = map_text(map);
    sl_map back = {0};
    if (sli_map_read_text(context, "text", text, strlen(text), &back) != SL_OK)
        fail_map(map, sl_context_message(context), seed);
    char *again = map_text(&back);
    if (strcmp(text, again) != 0) {
        fputs(again, stderr);
        fail_map(map, "written again it is another text", seed);
    }
    assert_ok(context, sl_map_clean(context, &back, NULL, NULL));
    for (int kind = KD; kind <= MESH; kind++) {
        if (!spaces[kind]) continue;
        sl_space space = {0};
        subdivide(context, &back, kind, &space);
        if (!sl_baked_same_space(spaces[kind], &space) || !same_solid(spaces[kind], &space))
            fail_map(map, "read back it is another space", seed);
        sl_space_destroy(context, &space);
    }
    sl_map_destroy(context, &back);
    free(text);
    free(again);
}

/// The same of a clean map. Cleaning it again may join walls, where walls in solid ground are gone.
static void check_clean_text(sl_context *context, const sl_map *map, uint64_t seed) {
    sl_map again = {0};
    sl_space spaces[3] = {0};
    const sl_space *made[3] = {0};
    assert_ok(context, sl_map_copy(context, map, &again));
    assert_ok(context, sl_map_clean(context, &again, NULL, NULL));
    for (int kind = KD; kind <= MESH && again.wall_count; kind++) {
        if (kind == KD && !sl_map_is_axial(&again)) continue;
        subdivide(context, &again, kind, &spaces[kind]);
        made[kind] = &spaces[kind];
    }
    check_text(context, map, made, seed);
    sl_space_destroy(context, &spaces[KD]);
    sl_space_destroy(context, &spaces[MESH]);
    sl_map_destroy(context, &again);
}

/// Some place between two, on a square's side in a third of the cases.
static sl_point random_corner(const trial *t, sl_random *random) {
    const int step = sl_random_below(random, 3) ? 1 : PARTS;
    const uint64_t steps = (uint64_t)((t->high - t->low) * PARTS / step);
    const double x = t->low * PARTS + step * (int)sl_random_below(random, steps);
    const double y = t->low * PARTS + step * (int)sl_random_below(random, steps);
    return put(&t->at, x / PARTS, y / PARTS);
}

/// Half squares of a box: the ground is what it was; nothing is beyond.
static bool check_cropped(const trial *t, const sl_space *space, sl_box box, bool ask) {
    bool open = false;
    const int step = PARTS / 2;
    for (int x = t->low * 2; x < t->high * 2; x++)
        for (int y = t->low * 2; y < t->high * 2; y++) {
            const int u = x * step + PARTS / 4, v = y * step + PARTS / 4;
            const sl_point at = put(&t->at, (double)u / PARTS, (double)v / PARTS);
            if (at.x <= box.min.x || at.x >= box.max.x || at.y <= box.min.y || at.y >= box.max.y)
                continue;
            open |= t->oracle(t->user, u, v) == 0;
            if (ask) check_place(t, space, u, v);
        }
    return open;
}

/// Cropped to a random box, the ground in it stays what it is.
static void check_crop(sl_context *context, const trial *t, sl_random *random) {
    sl_map map = {0};
    sl_crop_account account;
    const sl_point p = random_corner(t, random), q = random_corner(t, random);
    if (p.x == q.x || p.y == q.y) return;
    const sl_box box = {{fmin(p.x, q.x), fmin(p.y, q.y)}, {fmax(p.x, q.x), fmax(p.y, q.y)}};
    assert_ok(context, sl_map_copy(context, t->read, &map));
    assert_ok(context, sl_map_crop(context, &map, (sl_box){p, q}, &account));
    assert_int_equal(account.inside + account.cut + account.left_out, t->read->wall_count);
    const sl_box bounds = sl_map_bounds(&map);
    if (map.wall_count) {
        assert_true(bounds.min.x >= box.min.x && bounds.min.y >= box.min.y);
        assert_true(bounds.max.x <= box.max.x && bounds.max.y <= box.max.y);
    }
    if (account.inside + account.cut && check_cropped(t, NULL, box, false)) {
        assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
        // Walls of no length, and those a rounding apart, are gone now.
        for (int kind = KD; kind <= MESH && map.wall_count; kind++) {
            sl_space space = {0};
            if (kind == KD && !sl_map_is_axial(&map)) continue;
            subdivide(context, &map, kind, &space);
            check_cropped(t, &space, box, true);
            sl_space_destroy(context, &space);
        }
    }
    sl_map_destroy(context, &map);
}

/// Cleans a map, subdivides it in each way, asks the oracle, and writes and reads it.
static void check_map(sl_context *context, const trial *t, sl_random *random) {
    sl_map map = {0};
    if (!t->read->wall_count || !any_is_open(t)) return;
    assert_ok(context, sl_map_copy(context, t->read, &map));
    assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
    sl_space kd = {0}, mesh = {0};
    const bool axial = sl_map_is_axial(&map);
    if (axial) subdivide(context, &map, KD, &kd);
    subdivide(context, &map, MESH, &mesh);
    if (axial) check_places(t, &kd, random);
    check_places(t, &mesh, random);
    const sl_space *spaces[3] = {[KD] = axial ? &kd : NULL, [MESH] = &mesh};
    check_text(context, t->read, spaces, t->seed);
    check_clean_text(context, &map, t->seed);
    check_crop(context, t, random);
    sl_space_destroy(context, &kd);
    sl_space_destroy(context, &mesh);
    sl_map_destroy(context, &map);
}

// --- grids

enum { SIDE = 12, GRIDS = 3 };

typedef struct squares {
    int x, y, width, height, step; ///< the lower left corner and the side of a square, in units
    bool closed;
    char at[SIDE * SIDE + 1]; ///< from the top down
} squares;

typedef struct several {
    squares grids[GRIDS];
    int count;
    int box[4]; ///< beyond this box all is solid: left, lower, right and upper border, in units
    bool boxed;
} several;

static squares random_squares(sl_random *random) {
    squares s = {.step = 1};
    s.width = 1 + (int)sl_random_below(random, SIDE);
    s.height = 1 + (int)sl_random_below(random, SIDE);
    s.closed = sl_random_below(random, 2);
    const uint64_t share = 1 + sl_random_below(random, 9);
    for (int i = 0; i < s.width * s.height; i++)
        s.at[i] = sl_random_below(random, 10) < share ? '#' : '.';
    return s;
}

static int floor_divide(int a, int b) {
    return a >= 0 ? a / b : -((-a + b - 1) / b);
}

static int grid_says(const squares *s, int x, int y) {
    const int side = s->step * PARTS, u = x - s->x * PARTS, v = y - s->y * PARTS;
    if (u % side == 0 || v % side == 0) return -1;
    const int column = floor_divide(u, side), row = floor_divide(v, side);
    if (column < 0 || row < 0 || column >= s->width || row >= s->height) return s->closed;
    return s->at[(s->height - 1 - row) * s->width + column] == '#';
}

static int grids_say(const void *user, int x, int y) {
    const several *all = user;
    const int *box = all->box;
    if (all->boxed &&
        (x < box[0] * PARTS || y < box[1] * PARTS || x > box[2] * PARTS || y > box[3] * PARTS))
        return 1;
    int is = 0;
    for (int i = 0; i < all->count; i++) {
        const int own = grid_says(&all->grids[i], x, y);
        if (own < 0) return -1;
        is |= own;
    }
    return is;
}

/// Adds the walls of a grid that may be scaled, and then turned and moved wall by wall.
static void add_grid(sl_context *context, const squares *s, const transform *t, bool sure,
                     sl_map *map) {
    sli_grid grid;
    sl_map own = {0};
    const transform scale = {t->scale, 0, 1, 0, 0};
    assert_ok(context, sli_grid_create(context, (size_t)s->width, (size_t)s->height, &grid));
    memcpy(grid.squares, s->at, (size_t)(s->width * s->height));
    grid.origin = put(&scale, s->x, s->y);
    grid.step = put(&scale, s->step, s->step);
    grid.open_outside = !s->closed;
    grid.sure = sure;
    assert_ok(context, sli_grid_add_walls(context, &grid, &own));
    const transform turn = {1, t->sine, t->cosine, t->x, t->y};
    for (size_t i = 0; i < own.wall_count; i++) {
        const sl_wall *w = &own.walls[i];
        assert_ok(context, sl_map_add_wall(context, map, put(&turn, w->a.x, w->a.y),
                                           put(&turn, w->b.x, w->b.y), 0));
        map->walls[map->wall_count - 1].ground = w->ground;
    }
    sli_grid_destroy(context, &grid);
    sl_map_destroy(context, &own);
}

static void test_grids(void **state) {
    (void)state;
    const uint64_t count = testing_seeds(600);
    for (uint64_t seed = 1; seed <= count; seed++) {
        sl_context *context = testing_context(NULL);
        sl_random random = {seed};
        several all = {.count = 1};
        all.grids[0] = random_squares(&random);
        const transform t = random_transform(&random);
        sl_map map = {0};
        add_grid(context, &all.grids[0], &t, sl_random_below(&random, 2), &map);
        const trial one = {&map, t, grids_say, &all, -1, SIDE + 1, seed};
        check_map(context, &one, &random);
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
}

/// Grids on one another, each with squares of its own size: solid is what any of them says.
static void test_grids_on_one_another(void **state) {
    (void)state;
    const uint64_t count = testing_seeds(300);
    for (uint64_t seed = 1; seed <= count; seed++) {
        sl_context *context = testing_context(NULL);
        sl_random random = {seed};
        several all = {.count = 2 + (int)sl_random_below(&random, 2)};
        const transform t = random_transform(&random);
        sl_map map = {0};
        for (int i = 0; i < all.count; i++) {
            squares *s = &all.grids[i];
            *s = random_squares(&random);
            s->step = 1 + (int)sl_random_below(&random, 3);
            s->x = (int)sl_random_below(&random, 6) - 3;
            s->y = (int)sl_random_below(&random, 6) - 3;
            s->closed &= i == 0;
            add_grid(context, s, &t, false, &map);
        }
        const trial several_grids = {&map, t, grids_say, &all, -4, 40, seed};
        check_map(context, &several_grids, &random);
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
}

/// Beyond the first grid all is solid: that is, beyond the box of its blocks.
static void find_box(several *all) {
    const squares *first = &all->grids[0];
    int *box = all->box;
    for (int i = 0; i < all->count; i++) {
        const squares *s = &all->grids[i];
        if (s->step != first->step) continue;
        const int own[4] = {s->x, s->y, s->x + s->width * s->step, s->y + s->height * s->step};
        for (int k = 0; k < 4; k++)
            if (i == 0 || (k < 2 ? own[k] < box[k] : own[k] > box[k])) box[k] = own[k];
    }
    all->boxed = true;
}

/// Blocks of tiles, of which some lie on one grid.
static void test_tiles(void **state) {
    (void)state;
    const uint64_t count = testing_seeds(300);
    for (uint64_t seed = 1; seed <= count; seed++) {
        sl_context *context = testing_context(NULL);
        sl_random random = {seed};
        several all = {.count = 1 + (int)sl_random_below(&random, GRIDS)};
        sli_tiles tiles = {0};
        const sli_tiles_options options = {.top = 7};
        for (int i = 0; i < all.count; i++) {
            squares *s = &all.grids[i];
            *s = random_squares(&random);
            s->step = 1 + (int)sl_random_below(&random, 2);
            s->x = 2 * (int)sl_random_below(&random, 4);
            s->y = 2 * (int)sl_random_below(&random, 4);
            s->closed = false;
            const sl_point corner = {s->x, options.top - (s->y + s->height * s->step)};
            char *own;
            assert_ok(context,
                      sli_tiles_add(context, &tiles, "tiles", corner, (sl_point){s->step, s->step},
                                    (size_t)s->width, (size_t)s->height, &own));
            memcpy(own, s->at, (size_t)(s->width * s->height));
        }
        find_box(&all);
        sl_map map = {0};
        assert_ok(context, sli_tiles_add_walls(context, &tiles, "tiles", &options, &map));
        const trial blocks = {&map, stay, grids_say, &all, -2, 34, seed};
        check_map(context, &blocks, &random);
        sl_map_destroy(context, &map);
        sli_tiles_destroy(context, &tiles);
        sl_context_destroy(context);
    }
}

// --- polygons

enum { CORNERS = 12, POLYGONS = 10, ROOM = 20 };

typedef struct corner {
    int x, y;
} corner;

typedef struct polygon {
    corner at[CORNERS];
    int count;
    bool open; ///< open ground in solid ground
} polygon;

typedef struct polygons {
    polygon items[POLYGONS];
    int count;
} polygons;

static long turn_of(corner a, corner b, corner c) {
    return (long)(b.x - a.x) * (c.y - a.y) - (long)(b.y - a.y) * (c.x - a.x);
}

/// How often a polygon runs round a place, in PARTS; 1000 where the place is on a side.
static int winding(const polygon *p, corner at) {
    int turns = 0;
    for (int i = 0; i < p->count; i++) {
        corner a = p->at[i], b = p->at[(i + 1) % p->count];
        a = (corner){a.x * PARTS, a.y * PARTS};
        b = (corner){b.x * PARTS, b.y * PARTS};
        const long turn = turn_of(a, b, at);
        if (turn == 0 && (long)(at.x - a.x) * (at.x - b.x) <= 0 &&
            (long)(at.y - a.y) * (at.y - b.y) <= 0)
            return 1000;
        if (a.y <= at.y && b.y > at.y && turn > 0) turns++;
        if (b.y <= at.y && a.y > at.y && turn < 0) turns--;
    }
    return turns;
}

/// With an open polygon in the map all is solid beyond them, up to the next wall; so they come
/// without a room.
static int polygons_say(const void *user, int x, int y) {
    const polygons *all = user;
    int solid = 0, open = 0;
    bool closed = false;
    for (int i = 0; i < all->count; i++) {
        const int turns = winding(&all->items[i], (corner){x, y});
        if (turns == 1000) return -1;
        closed |= all->items[i].open;
        *(all->items[i].open ? &open : &solid) |= turns != 0;
    }
    return solid || (closed && !open);
}

static polygon rectangle(int x0, int y0, int x1, int y1) {
    return (polygon){.at = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, .count = 4};
}

static int below(sl_random *random, int bound) {
    return (int)sl_random_below(random, (uint64_t)bound);
}

/// A rectangle within [low, high]².
static polygon random_rectangle(sl_random *random, int low, int high) {
    const int x = low + below(random, high - low), y = low + below(random, high - low);
    const int most_x = high - x < 7 ? high - x : 7, most_y = high - y < 7 ? high - y : 7;
    return rectangle(x, y, x + 1 + below(random, most_x), y + 1 + below(random, most_y));
}

static polygon random_triangle(sl_random *random) {
    polygon p = {.count = 3};
    do
        for (int i = 0; i < 3; i++) p.at[i] = (corner){below(random, ROOM), below(random, ROOM)};
    while (turn_of(p.at[0], p.at[1], p.at[2]) == 0);
    return p;
}

/// A rectangle with a hole, which a bridge joins to its outside.
static polygon keyhole(sl_random *random) {
    const int x = below(random, 12), y = below(random, 12), s = 1 + below(random, 2);
    return (polygon){.at = {{x, y},
                            {x + s, y + s},
                            {x + s, y + 2 * s},
                            {x + 2 * s, y + 2 * s},
                            {x + 2 * s, y + s},
                            {x + s, y + s},
                            {x, y},
                            {x + 3 * s, y},
                            {x + 3 * s, y + 3 * s},
                            {x, y + 3 * s}},
                     .count = 10};
}

static polygon turned_round(const polygon *p) {
    polygon out = *p;
    for (int i = 0; i < p->count; i++) out.at[i] = p->at[p->count - 1 - i];
    return out;
}

static void add_polygon(sl_context *context, const polygon *p, const transform *t, sl_map *map) {
    sl_point corners[CORNERS];
    for (int i = 0; i < p->count; i++) corners[i] = put(t, p->at[i].x, p->at[i].y);
    if (p->open)
        assert_ok(context, sl_map_add_open(context, map, corners, (size_t)p->count, 0));
    else
        assert_ok(context, sl_map_add_solid(context, map, corners, (size_t)p->count, 0));
}

static void add_side(sl_context *context, const transform *t, corner a, corner b, sl_map *map) {
    assert_ok(context, sl_map_add_wall(context, map, put(t, a.x, a.y), put(t, b.x, b.y), 0));
}

/// Plain walls: a room round all, and parts of the sides of polygons.
static void add_walls(sl_context *context, const polygons *all, const transform *t,
                      sl_random *random, sl_map *map) {
    if (below(random, 3)) {
        const polygon room = rectangle(-2, -2, ROOM + 2, ROOM + 2);
        for (int i = 0; i < 4; i++) add_side(context, t, room.at[i], room.at[(i + 1) % 4], map);
    }
    for (int i = 0; i < all->count; i++) {
        const polygon *p = &all->items[i];
        const int k = below(random, p->count);
        corner a = p->at[k], b = p->at[(k + 1) % p->count];
        if (below(random, 3) || (a.x != b.x && a.y != b.y)) continue;
        if (a.x == b.x && a.y != b.y) b.y += 1 - below(random, 3);
        if (a.y == b.y && a.x != b.x) b.x += 1 - below(random, 3);
        if (a.x != b.x || a.y != b.y) add_side(context, t, a, b, map);
    }
}

static polygons random_polygons(sl_random *random, bool axial) {
    polygons all = {.count = 1 + below(random, POLYGONS)};
    for (int i = 0; i < all.count; i++) {
        polygon *p = &all.items[i];
        const int kind = below(random, 8);
        if (i && kind == 0)
            *p = all.items[below(random, i)];
        else if (!axial && kind == 1)
            *p = keyhole(random);
        else
            *p = axial || kind < 4 ? random_rectangle(random, 0, ROOM) : random_triangle(random);
        if (below(random, 2)) *p = turned_round(p);
    }
    return all;
}

static void test_polygons(void **state) {
    (void)state;
    const uint64_t count = testing_seeds(800);
    for (uint64_t seed = 1; seed <= count; seed++) {
        sl_context *context = testing_context(NULL);
        sl_random random = {seed};
        const bool axial = seed % 2;
        const polygons all = random_polygons(&random, axial);
        const transform t = random_transform(&random);
        sl_map map = {0};
        for (int i = 0; i < all.count; i++) add_polygon(context, &all.items[i], &t, &map);
        add_walls(context, &all, &t, &random, &map);
        const trial one = {&map, t, polygons_say, &all, -2, ROOM + 2, seed};
        check_map(context, &one, &random);
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
}

/// Open rooms in rock, with solid blocks in them and in the rock.
static void test_open_polygons(void **state) {
    (void)state;
    const uint64_t count = testing_seeds(400);
    for (uint64_t seed = 1; seed <= count; seed++) {
        sl_context *context = testing_context(NULL);
        sl_random random = {seed};
        const transform t = random_transform(&random);
        polygons all = {0};
        sl_map map = {0};
        for (int i = 0; i < 4; i++) {
            const int x = i % 2 * 10, y = i / 2 * 10;
            const int width = 4 + below(&random, 7), height = 4 + below(&random, 7);
            if (all.count && !below(&random, 4)) continue;
            polygon *room = &all.items[all.count++];
            *room = rectangle(x, y, x + width, y + height);
            room->open = true;
            if (below(&random, 2)) *room = turned_round(room);
            polygon *block = &all.items[all.count++];
            const int u = x + 1 + below(&random, width - 2), v = y + 1 + below(&random, height - 2);
            *block = rectangle(u, v, u + 1, v + 1);
            if (below(&random, 2)) *block = turned_round(block);
        }
        for (int i = 0; i < all.count; i++) add_polygon(context, &all.items[i], &t, &map);
        const trial one = {&map, t, polygons_say, &all, -2, ROOM + 2, seed};
        check_map(context, &one, &random);
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
}

/// Polygons of any corners are refused, or are solid where they run once round a place.
static void test_any_corners(void **state) {
    (void)state;
    const uint64_t count = testing_seeds(6000);
    uint64_t taken = 0;
    for (uint64_t seed = 1; seed <= count; seed++) {
        sl_context *context = testing_context(NULL);
        sl_random random = {seed};
        polygons all = {.count = 1};
        polygon *p = &all.items[0];
        p->count = 3 + below(&random, CORNERS - 3);
        for (int i = 0; i < p->count; i++)
            p->at[i] = (corner){below(&random, 4), below(&random, 4)};
        sl_point corners[CORNERS];
        for (int i = 0; i < p->count; i++) corners[i] = put(&stay, p->at[i].x, p->at[i].y);
        sl_map map = {0};
        const sl_status status = sl_map_add_solid(context, &map, corners, (size_t)p->count, 0);
        if (status == SL_OK) {
            taken++;
            const polygon room = rectangle(-1, -1, 5, 5);
            for (int i = 0; i < 4; i++)
                add_side(context, &stay, room.at[i], room.at[(i + 1) % 4], &map);
            const trial one = {&map, stay, polygons_say, &all, -1, 5, seed};
            check_map(context, &one, &random);
        } else {
            assert_int_equal(status, SL_BAD_INPUT);
            assert_int_equal(map.wall_count, 0);
        }
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
    assert_true(taken > count / 100);
}

/// Walls marked one by one, most of which make no loop: only text and the two ways to subdivide
/// are held against each other.
static void test_marked_walls(void **state) {
    (void)state;
    const uint64_t count = testing_seeds(1000);
    for (uint64_t seed = 1; seed <= count; seed++) {
        sl_context *context = testing_context(NULL);
        sl_random random = {seed};
        const transform t = random_transform(&random);
        sl_map map = {0};
        const int side = 2 + below(&random, 5), walls = 1 + below(&random, 20);
        for (int i = 0; i < walls; i++) {
            corner a = {below(&random, side), below(&random, side)}, b = a;
            *(below(&random, 2) ? &b.x : &b.y) = below(&random, side);
            if (seed % 2) b = (corner){below(&random, side), below(&random, side)};
            add_side(context, &t, a, b, &map);
            if (below(&random, 3))
                map.walls[map.wall_count - 1].ground = SL_SOLID_LEFT | SL_SOLID_BEGINS;
        }
        sl_map clean = {0};
        sl_space spaces[3] = {0};
        assert_ok(context, sl_map_copy(context, &map, &clean));
        assert_ok(context, sl_map_clean(context, &clean, NULL, NULL));
        const sl_space *made[3] = {0};
        for (int kind = KD; kind <= MESH && clean.wall_count; kind++) {
            if (kind == KD && !sl_map_is_axial(&clean)) continue;
            subdivide(context, &clean, kind, &spaces[kind]);
            made[kind] = &spaces[kind];
        }
        if (made[KD])
            for (uint32_t i = 0; i < spaces[KD].cell_count; i++) {
                const sl_point *v = spaces[KD].vertices + spaces[KD].cells[i].first_vertex;
                const sl_point middle = {(v[0].x + v[2].x) / 2, (v[0].y + v[2].y) / 2.03125};
                const uint32_t cell = sl_space_locate(&spaces[MESH], middle);
                const uint32_t of_kd = sl_space_locate(&spaces[KD], middle);
                if (cell == SL_NO_CELL || of_kd == SL_NO_CELL) continue;
                if (spaces[MESH].cells[cell].solid != spaces[KD].cells[of_kd].solid)
                    fail_map(&map, "kd-tree and mesh differ", seed);
            }
        if (clean.wall_count) check_text(context, &map, made, seed);
        if (clean.wall_count) check_clean_text(context, &clean, seed);
        sl_space_destroy(context, &spaces[KD]);
        sl_space_destroy(context, &spaces[MESH]);
        sl_map_destroy(context, &clean);
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
}

// --- what is seen

/// Random polygons in a room; every other seed gives axial ones.
static void random_map(sl_context *context, uint64_t seed, sl_map *map) {
    sl_random random = {seed};
    const polygons all = random_polygons(&random, seed % 2);
    for (int i = 0; i < all.count; i++) add_polygon(context, &all.items[i], &stay, map);
    const polygon room = rectangle(-2, -2, ROOM + 2, ROOM + 2);
    for (int i = 0; i < 4; i++) add_side(context, &stay, room.at[i], room.at[(i + 1) % 4], map);
    assert_ok(context, sl_map_clean(context, map, NULL, NULL));
}

/// The same walls without marks.
static void bare_map(sl_context *context, const sl_map *map, sl_map *out) {
    assert_ok(context, sl_map_copy(context, map, out));
    for (size_t i = 0; i < out->wall_count; i++) out->walls[i].ground = 0;
}

/// Rows of solid cells are empty, no row holds one, and the rest is as without solid ground.
static void check_rows(const sl_space *space, const sl_pvs *rows, const sl_pvs *bare,
                       bool inside_only, const char *name) {
    for (uint32_t a = 0; a < space->cell_count; a++)
        for (uint32_t b = 0; b < space->cell_count; b++) {
            const sl_cell *from = &space->cells[a], *to = &space->cells[b];
            const bool looks = !from->solid && (from->inside || !inside_only);
            const bool is = looks && sl_pvs_sees(bare, a, b);
            if (is && to->solid) fail_msg("%s: open cell %u sees solid cell %u", name, a, b);
            if (sl_pvs_sees(rows, a, b) != is)
                fail_msg("%s: cell %u %s cell %u", name, a, is ? "does not see" : "sees", b);
        }
}

static void see(sl_context *context, const sl_see_method *by, const sl_space *space,
                bool inside_only, sl_visibility *out) {
    sl_see_options options = sl_see_options_default();
    options.inside_only = inside_only;
    options.samples = 50;
    if (by->stabs) options.solver = sl_funnel();
    assert_ok(context, by->see(context, space, &options, out));
}

static void test_methods(void **state) {
    (void)state;
    const uint64_t seeds = testing_seeds(30);
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        sl_context *context = testing_context(NULL);
        sl_map map = {0}, bare = {0};
        sl_space space = {0}, bare_space = {0};
        random_map(context, seed, &map);
        bare_map(context, &map, &bare);
        const int kind = sl_map_is_axial(&map) && seed % 4 == 1 ? KD : MESH;
        subdivide(context, &map, kind, &space);
        subdivide(context, &bare, kind, &bare_space);
        assert_int_equal(space.cell_count, bare_space.cell_count);
        for (size_t i = 0; i < count; i++) {
            sl_visibility bare_seen = {0};
            see(context, &methods[i], &bare_space, false, &bare_seen);
            for (int inside_only = 0; inside_only < 2; inside_only++) {
                sl_visibility seen = {0};
                see(context, &methods[i], &space, inside_only, &seen);
                check_rows(&space, &seen.pvs, &bare_seen.pvs, inside_only, methods[i].name);
                sl_visibility_destroy(context, &seen);
            }
            sl_visibility_destroy(context, &bare_seen);
        }
        sl_space_destroy(context, &space);
        sl_space_destroy(context, &bare_space);
        sl_map_destroy(context, &map);
        sl_map_destroy(context, &bare);
        sl_context_destroy(context);
    }
}

/// What an eye sees past boxes, with and without solid ground.
static void check_eye(sl_context *context, sl_query *query, sl_query *bare, sl_point eye) {
    const sl_space *space = sl_query_asked(query);
    const sl_view view = sl_view_all_round(eye);
    const size_t words = sl_eye_words(space);
    uint64_t *cells = calloc(words, sizeof *cells), *of_bare = calloc(words, sizeof *of_bare);
    bool seen[3], bare_seen[3];
    assert_true(cells && of_bare);
    const uint32_t cell = sl_query_locate(query, eye);
    assert_ok(context, sl_query_look(context, query, &view, NULL, cells, NULL));
    if (space->cells[cell].solid) {
        for (uint32_t i = 0; i < space->cell_count; i++)
            if (sl_eye_sees(cells, i)) assert_true(space->cells[i].solid);
    } else {
        assert_ok(context, sl_query_look(context, bare, &view, NULL, of_bare, NULL));
        assert_memory_equal(cells, of_bare, words * sizeof *cells);
        assert_ok(context, sl_query_boxes_seen(context, query, &view, seen, NULL));
        assert_ok(context, sl_query_boxes_seen(context, bare, &view, bare_seen, NULL));
        assert_memory_equal(seen, bare_seen, sizeof seen);
    }
    free(cells);
    free(of_bare);
}

static void test_eyes_and_boxes(void **state) {
    (void)state;
    uint64_t compared = 0;
    const uint64_t seeds = testing_seeds(60);
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        sl_context *context = testing_context(NULL);
        sl_random random = {seed};
        sl_map map = {0}, bare = {0};
        sl_baked baked = {0}, bare_baked = {0};
        sl_query *query, *bare_query;
        random_map(context, seed, &map);
        bare_map(context, &map, &bare);
        assert_ok(context, sl_bake(context, &map, NULL, &baked, NULL));
        // Without marks cleaning could join more walls.
        sl_bake_options options = sl_bake_options_default();
        assert_ok(context, sl_bake(context, &bare, &options, &bare_baked, NULL));
        const sl_space *one = &baked.space, *other = &bare_baked.space;
        const bool same =
            one->cell_count == other->cell_count && one->vertex_count == other->vertex_count &&
            memcmp(one->vertices, other->vertices, one->vertex_count * sizeof *one->vertices) == 0;
        compared += same;
        assert_ok(context, sl_query_create(context, &baked, &query));
        assert_ok(context, sl_query_create(context, &bare_baked, &bare_query));
        for (int i = 0; same && i < 3; i++) {
            sl_moving_box boxes[3];
            for (int k = 0; k < 3; k++) {
                const double x = below(&random, ROOM), y = below(&random, ROOM) + 0.25 * k;
                boxes[k] = (sl_moving_box){
                    {{x, y}, {x + 0.5 * below(&random, 6), y + 0.5 * below(&random, 6)}}, k != 2};
            }
            assert_ok(context, sl_query_set_boxes(context, query, boxes, 3));
            assert_ok(context, sl_query_set_boxes(context, bare_query, boxes, 3));
            for (int k = 0; k < 5; k++)
                check_eye(context, query, bare_query,
                          (sl_point){below(&random, ROOM) + 0.37, below(&random, ROOM) + 0.61});
        }
        sl_query_destroy(context, query);
        sl_query_destroy(context, bare_query);
        sl_baked_destroy(context, &baked);
        sl_baked_destroy(context, &bare_baked);
        sl_context_destroy(context);
    }
    assert_true(compared > seeds / 4);
}

// --- by hand

#define ROOM_WITH_ROCK "walls 0 0 10 0 10 10 0 10 0 0\nsolid 4 4 6 4 6 6 4 6\n"

/// Subdivides a map text in each way: the status and message that are expected, and whether the
/// cell at a place is solid (1), open (0) or not asked for (-1).
static void check_text_map(const char *statements, const char *message, double weld, sl_point at,
                           int solid) {
    sl_context *context = testing_context(NULL);
    char text[2048];
    snprintf(text, sizeof text, "sightline 1\n%s", statements);
    for (int kind = KD; kind <= MESH; kind++) {
        sl_map map = {0};
        sl_space space = {0};
        const sl_clean_options clean = {.weld = weld};
        const sl_subdivide_options rules = sl_subdivide_options_default();
        assert_ok(context, sli_map_read_text(context, "test", text, strlen(text), &map));
        assert_ok(context, sl_map_clean(context, &map, &clean, NULL));
        const sl_status status = kind == KD ? sli_subdivide_kd(context, &map, &rules, &space)
                                            : sli_subdivide_mesh(context, &map, &space);
        if (message) {
            if (status != SL_BAD_INPUT || !strstr(sl_context_message(context), message))
                fail_msg("%s: %s", statements, sl_context_message(context));
        } else {
            assert_ok(context, status);
            assert_ok(context, sl_space_check(context, &space));
            const uint32_t cell = sl_space_locate(&space, at);
            if (solid >= 0 && space.cells[cell].solid != (uint32_t)solid)
                fail_msg("%s: solid is not %d", statements, solid);
            if (solid == 0 && !space.cells[cell].inside) fail_msg("%s: not inside", statements);
        }
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
    }
    sl_context_destroy(context);
}

static void test_by_hand(void **state) {
    (void)state;
    const struct {
        const char *statements, *message;
        double x, y;
        int solid;
    } cases[] = {
        {ROOM_WITH_ROCK, NULL, 5, 5, 1},
        {ROOM_WITH_ROCK "start 4 5 0\n", NULL, 1, 1, 0},     // on the border of rock
        {ROOM_WITH_ROCK "start 6 6 0\n", NULL, 1, 1, 0},     // in its corner
        {ROOM_WITH_ROCK "start 0 10 0\n", NULL, 1, 1, 0},    // in the map's corner
        {ROOM_WITH_ROCK "start 20 20 0\n", NULL, 20, 20, 0}, // beyond the walls
        {ROOM_WITH_ROCK "start 5 5 0\nstart 1 1 0\n", NULL, 1, 1, 0},
        {ROOM_WITH_ROCK "start 5 5 0\n", "the map:4: the start at 5 5 is in solid ground (line 3)",
         0, 0, -1},
        {ROOM_WITH_ROCK "start 5 5 0\nstart 20 20 0\n", NULL, 20, 20, 0},
        {ROOM_WITH_ROCK "door d 4 5 6 5\n", "the map:4: door d stands in solid ground (line 3)", 0,
         0, -1},
        {ROOM_WITH_ROCK "door d 6 5 10 5\n", NULL, 8, 8, 0},
        {ROOM_WITH_ROCK "door d 4 4 6 4\n", NULL, 8, 8, 0}, // on a wall: none
        {ROOM_WITH_ROCK "open 1 1 5 1 5 5 1 5\n", "may not overlap", 0, 0, -1},
        {ROOM_WITH_ROCK "wall 5 5 5.5 5\n", NULL, 5.2, 5.2, 1},
        {ROOM_WITH_ROCK "walls 4.5 4.5 5.5 4.5 5.5 5.5 4.5 5.5 4.5 4.5\n", NULL, 5, 5, 1},
        {ROOM_WITH_ROCK "walls 4.5 4.5 5.5 4.5 5.5 5.5 4.5 5.5 4.5 4.5\nstart 5 5 0\n",
         "in solid ground", 0, 0, -1},
        {"solid 0 0 4 0 4 4 0 4\n", NULL, 1, 1, 1}, // all is rock
        {"solid 0 0 4 0 4 4 0 4\nstart 4 4 0\n", "in solid ground", 0, 0, -1},
        {"solid 0 0 4 0 4 4 0 4\nopen 1 1 2 1 2 2 1 2\n", NULL, 1.5, 1.5, 0},
        {"open 0 0 4 0 4 4 0 4\nopen 4 1 8 1 8 3 4 3\n", NULL, 5, 2, 0},
        {"open 0 0 4 0 4 4 0 4\nsolid 3 1 4 1 4 2 3 2\n", NULL, 3.5, 1.5, 1}, // along a side
        {"open 0 0 4 0 4 4 0 4\nsolid 3 1 4 1 4 2 3 2\n", NULL, 1, 1, 0},
        {"open 0 0 4 0 4 4 0 4\nopen 2 1 8 1 8 3 2 3\n", "may not overlap", 0, 0, -1},
        {"walls 0 0 8 0 8 8 0 8 0 0\nwall 4 0 4 8 solid\n", NULL, 1, 1, 1}, // one wall, no loop
        {"walls 0 0 8 0 8 8 0 8 0 0\nwall 4 0 4 8 solid\n", NULL, 5, 5, 0},
        {"walls 0 0 8 0 8 8 0 8 0 0\nwall 4 0 4 7 solid\n", NULL, 5, 5, 1}, // round its end
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        check_text_map(cases[i].statements, cases[i].message, -1,
                       (sl_point){cases[i].x, cases[i].y}, cases[i].solid);
}

/// A polygon thinner than the tolerance becomes a wall; the room beside it stays open.
static void test_welding_closes_thin_polygons(void **state) {
    (void)state;
    const char *thin = "walls 0 0 10 0 10 10 0 10 0 0\n"
                       "solid 5 0 5.05 0 5.05 8 5 8\nsolid 7 7 8 7 8 8 7 8\n";
    check_text_map(thin, NULL, 0.1, (sl_point){2, 2}, 0);
    check_text_map(thin, NULL, 0.1, (sl_point){8.5, 8.5}, 0);
    check_text_map(thin, NULL, 0.1, (sl_point){7.5, 7.5}, 1);
    // Two polygons that welding brings together are solid on both sides.
    const char *near = "walls 0 0 10 0 10 10 0 10 0 0\n"
                       "solid 2 2 5 2 5 8 2 8\nsolid 5.05 2 8 2 8 8 5.05 8\n";
    check_text_map(near, NULL, 0.1, (sl_point){4, 4}, 1);
    check_text_map(near, NULL, 0.1, (sl_point){6, 4}, 1);
    check_text_map(near, NULL, 0.1, (sl_point){1, 1}, 0);
}

/// A map that is all rock can be written, read, and looked at.
static void test_all_rock(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const sl_point corners[] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
    sl_map map = {0};
    sl_baked baked = {0}, back = {0};
    char path[] = "/tmp/sightline_ground_XXXXXX";
    const int file = mkstemp(path);
    assert_true(file >= 0);
    assert_ok(context, sl_map_add_solid(context, &map, corners, 4, 0));
    assert_ok(context, sl_bake(context, &map, NULL, &baked, NULL));
    assert_int_equal(baked.space.inside_count, 0);
    assert_ok(context, sl_baked_write(context, &baked, path));
    assert_ok(context, sl_baked_read(context, path, &back));
    assert_true(sl_baked_same_space(&baked.space, &back.space));
    assert_int_equal(sli_pvs_pairs(&back.visibility.pvs), 0);
    sl_baked_destroy(context, &baked);
    sl_baked_destroy(context, &back);
    remove(path);
    sl_context_destroy(context);
}

/// Corners that are no numbers or too far away are refused, and add nothing.
static void test_unusable_corners(void **state) {
    (void)state;
    const double values[] = {NAN, INFINITY, 1e300, -1e300};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        sl_context *context = testing_context(NULL);
        const sl_point corners[] = {{0, 0}, {4, 0}, {4, values[i]}};
        sl_map map = {0};
        assert_int_equal(sl_map_add_solid(context, &map, corners, 3, 0), SL_BAD_ARGUMENT);
        assert_int_equal(sl_map_add_open(context, &map, corners, 2, 0), SL_BAD_ARGUMENT);
        assert_int_equal(map.wall_count, 0);
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
    }
}

/// Without memory everything fails cleanly, wherever it ends.
static void test_memory(void **state) {
    (void)state;
    const char *text = "sightline 1\nwalls 0 0 10 0 10 10 0 10 0 0\nsolid 1 1 6 1 3 4\n"
                       "solid 2 2 5 2 5 3 2 3\nstart 9 9 0\n";
    for (long fail_at = 1;; fail_at++) {
        testing_memory memory = {.fail_at = fail_at};
        sl_context *context =
            sl_context_create(&(sl_hooks){.user = &memory, .resize = testing_resize});
        if (!context) continue;
        sl_map map = {0};
        sl_space space = {0};
        sl_status status = sli_map_read_text(context, "test", text, strlen(text), &map);
        if (status == SL_OK) status = sl_map_clean(context, &map, NULL, NULL);
        if (status == SL_OK) status = sli_subdivide_mesh(context, &map, &space);
        assert_true(status == SL_OK || status == SL_NO_MEMORY);
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
        sl_context_destroy(context);
        assert_int_equal(memory.live, 0);
        if (status == SL_OK) return;
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_grids),
        cmocka_unit_test(test_grids_on_one_another),
        cmocka_unit_test(test_tiles),
        cmocka_unit_test(test_polygons),
        cmocka_unit_test(test_open_polygons),
        cmocka_unit_test(test_any_corners),
        cmocka_unit_test(test_marked_walls),
        cmocka_unit_test(test_methods),
        cmocka_unit_test(test_eyes_and_boxes),
        cmocka_unit_test(test_by_hand),
        cmocka_unit_test(test_welding_closes_thin_polygons),
        cmocka_unit_test(test_all_rock),
        cmocka_unit_test(test_unusable_corners),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/// All effects together, against brute force: for each set of open doors, shut doors, mirrors,
/// one-way glass, a range and boxes that block, random maps are asked by a query, with and without
/// a bake, forwards and backwards, while its settings change in any order. The oracle knows the
/// segments of the map and of boxes alone. Maps are axial, or turned by an angle that leaves
/// coordinates integers. SIGHTLINE_SEEDS in the environment: how many maps for each set (3 by
/// default); SIGHTLINE_FIRST: the number of the first one.
#include "mirror_rays.h"
#include "testing.h"

#include "oracle/box_rays.h"
#include "oracle/eye.h"
#include "oracle/mirror_ray.h"
#include "oracle/mirrored.h"
#include "oracle/random_effects.h"
#include "oracle/two_points.h"

#include "sightline/bake.h"
#include "sightline/region.h"

#include <math.h>

enum {
    OPEN_DOORS = 1,
    SHUT_DOORS = 2,
    MIRRORS = 4,
    GLASS = 8,
    RANGE = 16,
    BOXES = 32, ///< that block; others are there in any case
    SUBSETS = 64
};

/// Box sides at multiples of GRID cross walls at integers.
enum { GRID = 12, BOX_COUNT = 3, DOOR_COUNT = 3, WALLS_MOST = 200, CELLS_MOST = 512 };
/// Of places: much more than rounding.
#define NEAR 1e-6

enum { CHANGES = 4, EYES = 2, POINTS = 20, PLACES = 24, RAYS = 8, ORACLE_CELLS = 60 };

typedef struct trial {
    sl_context *context;
    sl_random random;
    uint64_t seed;
    unsigned effects;
    bool turned, bare;
    sl_map map; ///< as the oracle knows it
    sl_baked baked;
    sl_query *query;
    sl_sight sight;
    bool shut[DOOR_COUNT], backwards, any_blocks;
    double range;
    uint32_t depth, baked_depth; ///< of mirrors
    sl_moving_box boxes[BOX_COUNT];
    sl_segment walls[WALLS_MOST]; ///< for the oracle
    size_t dark;                  ///< of these: glass
    size_t cover;                 ///< and walls and shut doors; the rest: the border, boxes
    size_t count;
    size_t asked[2], places[2], cells[2], boxes_seen[4], legs, parts; ///< by what was so
} trial;

static uint64_t below(trial *t, uint64_t bound) {
    return sl_random_below(&t->random, bound);
}

static sl_point turn(const trial *t, sl_point p) {
    return t->turned ? (sl_point){4 * p.x - 3 * p.y, 3 * p.x + 4 * p.y} : p;
}

// --- maps and settings

static void turn_segment(const trial *t, sl_segment *s) {
    *s = (sl_segment){turn(t, s->a), turn(t, s->b)};
}

static void make_map(trial *t) {
    const unsigned doors = t->effects & (OPEN_DOORS | SHUT_DOORS) ? SL_EFFECT_DOOR : 0;
    const unsigned mirrors = t->effects & MIRRORS ? SL_EFFECT_MIRROR : 0;
    const unsigned glass = t->effects & GLASS ? SL_EFFECT_ONEWAY : 0;
    sl_map map = {0};
    sl_bake_options options = sl_bake_options_default();
    random_effects_map(t->context, &t->random, doors | mirrors | glass, GRID, &map);
    // Glass both ways, and glass in a door.
    const uint64_t both = below(t, 3);
    if (map.oneway_count > 1 && both == 1)
        map.oneways[1].segment = (sl_segment){map.oneways[0].segment.b, map.oneways[0].segment.a};
    if (map.oneway_count && map.door_count && both == 2)
        map.oneways[0].segment = map.doors[0].segment;
    for (size_t i = 0; i < map.wall_count; i++) {
        map.walls[i].a = turn(t, map.walls[i].a);
        map.walls[i].b = turn(t, map.walls[i].b);
    }
    for (size_t i = 0; i < map.door_count; i++) {
        turn_segment(t, &map.doors[i].segment);
        for (size_t k = 0; k < map.doors[i].part_count; k++)
            turn_segment(t, &map.doors[i].parts[k]);
        map.doors[i].open = below(t, 2);
    }
    for (size_t i = 0; i < map.mirror_count; i++) turn_segment(t, &map.mirrors[i].segment);
    for (size_t i = 0; i < map.oneway_count; i++) turn_segment(t, &map.oneways[i].segment);
    if (t->effects & RANGE && below(t, 2))
        map.range = (double)((t->turned ? 5 : 1) * (20 + below(t, 60)));
    options.mirror_depth = t->baked_depth = (uint32_t)(1 + below(t, 2));
    options.see.sight = below(t, 4) ? SL_CLOSED : SL_OPEN;
    options.see.threads = 1;
    assert_ok(t->context, sl_map_copy(t->context, &map, &t->map));
    assert_ok(t->context, sl_bake(t->context, &map, &options, &t->baked, NULL));
    assert_true(t->baked.space.cell_count <= CELLS_MOST);
    assert_int_equal(t->baked.map.door_count, t->map.door_count);
}

/// A place for a box's side, a little out of bounds too.
static double random_side(trial *t, double from, double to) {
    const double step = t->turned ? GRID : GRID / 4;
    return from + step * ((double)below(t, (uint64_t)((to - from) / step) + 3) - 1);
}

static void set_boxes(trial *t) {
    const sl_box b = t->baked.space.bounds;
    t->any_blocks = false;
    for (int i = 0; i < BOX_COUNT; i++) {
        const double x = random_side(t, b.min.x, b.max.x), y = random_side(t, b.min.y, b.max.y);
        const double size = t->turned ? 5 * GRID : GRID, step = t->turned ? GRID : GRID / 4;
        const double width = step * (double)below(t, (uint64_t)(2 * size / step));
        const double height = step * (double)below(t, (uint64_t)(2 * size / step));
        const sl_box box = {{x, y}, {x + width, y + height}};
        t->boxes[i] = (sl_moving_box){box, t->effects & BOXES && below(t, 3)};
        t->any_blocks |= t->boxes[i].blocks;
    }
    assert_ok(t->context, sl_query_set_boxes(t->context, t->query, t->boxes, BOX_COUNT));
}

static void set_door(trial *t, size_t door) {
    const bool open = t->effects & OPEN_DOORS && (!(t->effects & SHUT_DOORS) || below(t, 2));
    sl_query_set_door_at(t->context, t->query, door, open);
    t->shut[door] = !open;
}

static void set_range(trial *t) {
    const double most = t->map.range > 0 ? t->map.range : t->turned ? 400 : 80;
    t->range = t->effects & RANGE ? 1 + (double)below(t, (uint64_t)most) : 0;
    assert_ok(t->context, sl_query_set_range(t->context, t->query, t->range));
}

/// Changes one setting; `which` counts through all of them.
static void change(trial *t, uint64_t which) {
    const size_t doors = t->map.door_count;
    if (which == 0) {
        set_boxes(t);
    } else if (which == 1) {
        set_range(t);
    } else if (which == 2) {
        t->backwards = below(t, 2);
        sl_query_set_backwards(t->context, t->query, t->backwards);
    } else if (which == 3) {
        t->depth = (uint32_t)below(t, 4);
        assert_ok(t->context, sl_query_set_mirror_depth(t->context, t->query, t->depth));
    } else if (doors) {
        set_door(t, (size_t)(which - 4) % doors);
    }
}

// --- the oracle's walls

static sl_segment glass_of(const trial *t, size_t number) {
    const sl_segment s = t->map.oneways[number].segment;
    return t->backwards ? (sl_segment){s.b, s.a} : s;
}

static size_t sides_of(sl_box box, sl_segment sides[4]) {
    const sl_point c[4] = {box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
    for (int i = 0; i < 4; i++) sides[i] = (sl_segment){c[i], c[(i + 1) % 4]};
    return 4;
}

/// The sides of a box as far as they are in bounds.
static size_t sides_within(sl_box box, sl_box bounds, sl_segment out[4]) {
    const sl_box in = {{fmax(box.min.x, bounds.min.x), fmax(box.min.y, bounds.min.y)},
                       {fmin(box.max.x, bounds.max.x), fmin(box.max.y, bounds.max.y)}};
    sl_segment sides[4], clipped[4];
    size_t count = 0;
    sides_of(box, sides);
    sides_of(in, clipped);
    for (int i = 0; i < 4 && in.min.x <= in.max.x && in.min.y <= in.max.y; i++) {
        const bool is_there =
            i % 2 ? sides[i].a.x == clipped[i].a.x : sides[i].a.y == clipped[i].a.y;
        if (is_there && !testing_same_point(clipped[i].a, clipped[i].b)) out[count++] = clipped[i];
    }
    return count;
}

/// Glass is dark at its left; for an eye in line with it, where its cell has a corner there.
static bool is_dark(const sl_space *s, sl_segment glass, sl_point eye, const sl_cell *cell) {
    const int64_t side = two_points_cross(glass.a, glass.b, eye);
    bool left = side > 0;
    for (uint32_t i = 0; i < cell->vertex_count && !side; i++)
        left |= two_points_cross(glass.a, glass.b, s->vertices[cell->first_vertex + i]) > 0;
    return left;
}

/// Walls, shut doors, sides of boxes but one, and glass that is dark for the eye. Of the space only
/// the side is taken that an eye on a wall or in line with glass stands on.
static two_points stand(trial *t, sl_point eye, size_t without) {
    const sl_map *map = &t->map;
    const sl_space *space;
    two_points out = {.walls = t->walls, .p = eye};
    assert_ok(t->context, sl_query_space(t->context, t->query, &space, NULL));
    const sl_cell *cell = &space->cells[sl_space_locate(space, eye)];
    for (size_t i = 0; i < map->oneway_count; i++)
        if (is_dark(space, glass_of(t, i), eye, cell)) t->walls[out.count++] = glass_of(t, i);
    t->dark = out.count;
    for (size_t i = 0; i < map->wall_count; i++)
        t->walls[out.count++] = (sl_segment){map->walls[i].a, map->walls[i].b};
    for (size_t i = 0; i < map->door_count; i++)
        if (t->shut[i]) t->walls[out.count++] = map->doors[i].segment;
    t->cover = out.count;
    out.count += sides_of(t->baked.space.bounds, t->walls + out.count);
    for (size_t i = 0; i < BOX_COUNT; i++)
        if (t->boxes[i].blocks && i != without)
            out.count += sides_within(t->boxes[i].box, t->baked.space.bounds, t->walls + out.count);
    t->count = out.count;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        out.inward.x += space->vertices[cell->first_vertex + i].x - eye.x;
        out.inward.y += space->vertices[cell->first_vertex + i].y - eye.y;
    }
    assert_true(out.count <= WALLS_MOST);
    return out;
}

/// Whether a wall, which the border of the map is not, has a point of the segment.
static bool is_touched(const trial *t, const two_points *way) {
    for (size_t i = 0; i < way->count; i++) {
        if (i == t->cover) i += 4;
        if (i == way->count) break;
        const sl_segment w = way->walls[i], s = {way->p, way->q};
        if (two_points_on(w, s.a) || two_points_on(w, s.b) || two_points_on(s, w.a) ||
            two_points_on(s, w.b))
            return true;
    }
    return two_points_crossed(way);
}

static bool is_seen(const trial *t, const two_points *way, sl_sight sight) {
    const double x = way->q.x - way->p.x, y = way->q.y - way->p.y;
    const double away = x * x + y * y, range = t->range * t->range;
    if (sight == SL_OPEN) return !is_touched(t, way) && (!(t->range > 0) || away < range);
    return two_points_see(way) && (!(t->range > 0) || away <= range);
}

/// Whether a point keeps off walls, ways past their ends, and the end of the range.
static bool is_clear(const trial *t, const two_points *way) {
    const double x = way->q.x - way->p.x, y = way->q.y - way->p.y;
    if (x * x + y * y == t->range * t->range || (x == 0 && y == 0)) return false;
    for (size_t i = 0; i < 2 * way->count; i++) {
        const sl_segment w = way->walls[i / 2];
        const sl_point end = i % 2 ? w.b : w.a;
        if (two_points_on(w, way->q)) return false;
        if (!testing_same_point(end, way->p) && two_points_half(way->p, way->q, end) == 0)
            return false;
    }
    return true;
}

static void complain(const trial *t, const sl_view *view, sl_point q, const char *who,
                     size_t number, bool said) {
    const sl_map *map = &t->map;
    for (size_t i = 0; i < map->wall_count; i++)
        print_error("wall %g %g %g %g\n", map->walls[i].a.x, map->walls[i].a.y, map->walls[i].b.x,
                    map->walls[i].b.y);
    for (size_t i = 0; i < map->door_count; i++) {
        const sl_segment s = map->doors[i].segment;
        print_error("door d%zu %g %g %g %g %s\n", i, s.a.x, s.a.y, s.b.x, s.b.y,
                    t->shut[i] ? "shut" : "open");
    }
    for (size_t i = 0; i < map->oneway_count; i++) {
        const sl_segment s = map->oneways[i].segment;
        print_error("oneway %g %g %g %g\n", s.a.x, s.a.y, s.b.x, s.b.y);
    }
    for (size_t i = 0; i < map->mirror_count; i++) {
        const sl_segment s = map->mirrors[i].segment;
        print_error("mirror %g %g %g %g%s\n", s.a.x, s.a.y, s.b.x, s.b.y,
                    map->mirrors[i].one_sided ? " one" : "");
    }
    for (size_t i = 0; i < BOX_COUNT; i++) {
        const sl_box b = t->boxes[i].box;
        print_error("box %g %g %g %g%s\n", b.min.x, b.min.y, b.max.x, b.max.y,
                    t->boxes[i].blocks ? " block" : "");
    }
    if (!view->full)
        print_error("right %g %g left %g %g\n", view->right.x, view->right.y, view->left.x,
                    view->left.y);
    fail_msg("effects %u seed %llu%s%s%s%s, range %g (map %g), depth %u, eye %.17g,%.17g to "
             "%.17g,%.17g: %s %zu is %s",
             t->effects, (unsigned long long)t->seed, t->turned ? " turned" : "",
             t->bare ? " bare" : "", t->backwards ? " backwards" : "",
             t->sight == SL_OPEN ? " open" : "", t->range, map->range, t->depth, view->eye.x,
             view->eye.y, q.x, q.y, who, number, said ? "added" : "missed");
}

// --- points

/// On a segment, at one of its ends, or in its middle.
static sl_point point_on(trial *t, sl_segment s) {
    const uint64_t kind = below(t, 3);
    if (kind < 2) return kind ? s.a : s.b;
    return (sl_point){(s.a.x + s.b.x) / 2, (s.a.y + s.b.y) / 2};
}

static sl_point any_point(trial *t) {
    const sl_map *map = &t->map;
    const sl_box b = t->baked.space.bounds;
    sl_segment sides[4];
    sl_point p = {-1e9, 0};
    while (!(p.x >= b.min.x && p.x <= b.max.x && p.y >= b.min.y && p.y <= b.max.y)) {
        const uint64_t kind = below(t, 7);
        sides_of(t->boxes[below(t, BOX_COUNT)].box, sides);
        p = (sl_point){b.min.x + (double)below(t, (uint64_t)(b.max.x - b.min.x) + 1),
                       b.min.y + (double)below(t, (uint64_t)(b.max.y - b.min.y) + 1)};
        if (kind == 0) {
            const sl_wall *w = &map->walls[below(t, map->wall_count)];
            p = point_on(t, (sl_segment){w->a, w->b});
        } else if (kind == 1) {
            p = point_on(t, sides[below(t, 4)]);
        } else if (kind == 2 && map->door_count) {
            p = point_on(t, map->doors[below(t, map->door_count)].segment);
        } else if (kind == 3 && map->oneway_count) {
            p = point_on(t, map->oneways[below(t, map->oneway_count)].segment);
        }
        if (p.x != floor(p.x) || p.y != floor(p.y)) p.x = -1e9;
    }
    return p;
}

static sl_view any_view(trial *t, sl_point eye) {
    sl_view view = sl_view_all_round(eye);
    if (below(t, 2)) return view;
    do {
        view = (sl_view){eye, false, any_point(t), any_point(t)};
    } while (testing_same_point(view.left, eye) || testing_same_point(view.right, eye));
    return view;
}

// --- what is compared

static void check_points(trial *t, sl_point eye) {
    const sl_view view = sl_view_all_round(eye);
    two_points way = stand(t, eye, BOX_COUNT);
    for (int i = 0; i < POINTS; i++) {
        bool sees;
        way.q = any_point(t);
        assert_ok(t->context, sl_query_sees(t->context, t->query, eye, way.q, &sees));
        if (sees != is_seen(t, &way, t->sight)) complain(t, &view, way.q, "the point", 0, sees);
        t->asked[sees]++;
    }
}

static bool is_within(const sl_space *space, uint32_t number, sl_point p) {
    const sl_cell *cell = &space->cells[number];
    const sl_point *v = space->vertices + cell->first_vertex;
    for (uint32_t i = 0; i < cell->vertex_count; i++)
        if (two_points_cross(v[i], v[(i + 1) % cell->vertex_count], p) <= 0) return false;
    return true;
}

/// Points within cells that no way past ends of walls leads to: the region has those that are seen,
/// and so have the cells of the eye, and the visible sets.
static void check_places(trial *t, const sl_view *view, const uint64_t *cells) {
    const sl_space *space = &t->baked.space;
    two_points way = stand(t, view->eye, BOX_COUNT);
    const uint32_t from = sl_space_locate(space, view->eye);
    uint64_t row[CELLS_MOST / 64 + 1];
    sl_region region = {0};
    assert_ok(t->context, sl_query_region(t->context, t->query, view, &region));
    if (!t->bare) assert_ok(t->context, sl_query_row(t->context, t->query, from, false, row));
    for (int i = 0; i < PLACES; i++) {
        way.q = any_point(t);
        const uint32_t to = sl_space_locate(space, way.q);
        if (!is_clear(t, &way) || box_rays_on_border(view, way.q)) continue;
        const bool seen = is_seen(t, &way, SL_CLOSED), looked_at = box_rays_in_view(view, way.q);
        bool can_see = true;
        if (mirror_rays_holds(&region, way.q) != (seen && looked_at))
            complain(t, view, way.q, "the place of the region", i, !(seen && looked_at));
        t->places[seen]++;
        if (!seen || !is_within(space, to, way.q)) continue;
        if (looked_at && !sl_eye_sees(cells, to)) complain(t, view, way.q, "cell", to, false);
        if (t->bare || !is_within(space, from, view->eye)) continue;
        assert_ok(t->context, sl_query_can_see(t->context, t->query, from, to, &can_see));
        if (!can_see || !sl_eye_sees(row, to)) complain(t, view, way.q, "pair to", to, false);
    }
    sl_region_destroy(t->context, &region);
}

/// The nearest corner or side of a cell, or 0 for one that holds the point.
static double distance(const sl_space *space, uint32_t number, sl_point p) {
    const sl_cell *cell = &space->cells[number];
    const sl_point *v = space->vertices + cell->first_vertex;
    double least = INFINITY;
    if (is_within(space, number, p)) return 0;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point a = v[i], b = v[(i + 1) % cell->vertex_count];
        const double x = b.x - a.x, y = b.y - a.y;
        const double at = ((p.x - a.x) * x + (p.y - a.y) * y) / (x * x + y * y);
        const double share = fmin(fmax(at, 0), 1);
        least = fmin(least, hypot(a.x + share * x - p.x, a.y + share * y - p.y));
    }
    return least;
}

/// Whether an eye is in line with glass.
static bool is_in_line(const trial *t, sl_point eye) {
    bool in_line = false;
    for (size_t i = 0; i < t->map.oneway_count; i++)
        in_line |= !two_points_cross(glass_of(t, i).a, glass_of(t, i).b, eye);
    return in_line;
}

/// The space that brute force takes for an eye; NULL where there is none that it understands. For
/// an eye in line with glass the side of its cell counts, which only a copy for that eye knows.
static const sl_space *space_for(trial *t, sl_point eye, sl_space *copy, const uint32_t **parents) {
    const sl_space *space;
    assert_ok(t->context, sl_query_space(t->context, t->query, &space, parents));
    if (!t->any_blocks) {
        assert_ok(t->context, sl_query_copy_space(t->context, t->query, eye, copy));
        return copy;
    }
    const bool one_way = !t->turned || t->sight == SL_OPEN || is_in_line(t, eye);
    return t->map.oneway_count && one_way ? NULL : space;
}

static void compare_cells(trial *t, const sl_view *view, const uint64_t *cells, const bool *seen,
                          const uint32_t *parents, uint32_t count, const char *who) {
    const sl_space *asked = &t->baked.space;
    const bool more = t->turned && t->range > 0; // brute force over oblique cells knows no range
    bool wanted[CELLS_MOST] = {false};
    for (uint32_t c = 0; c < count; c++) wanted[parents ? parents[c] : c] |= seen[c];
    for (uint32_t c = 0; c < asked->cell_count; c++) {
        const bool said = sl_eye_sees(cells, c);
        const bool far = t->range > 0 && distance(asked, c, view->eye) > t->range * (1 + 1e-9);
        if (more ? said && (!wanted[c] || far) : said != wanted[c])
            complain(t, view, asked->vertices[asked->cells[c].first_vertex], who, c, said);
        t->cells[said]++;
    }
}

/// The cells of the eye, by brute force over the query's space, in which shut doors and boxes are
/// walls.
static void check_cells(trial *t, const sl_view *view, const uint64_t *cells,
                        const uint64_t *mirrored) {
    const sl_point borders[2] = {view->right, view->left};
    const uint32_t *parents = NULL;
    sl_space copy = {0};
    bool closed[CELLS_MOST], open[CELLS_MOST];
    const sl_space *space = space_for(t, view->eye, &copy, &parents);
    const bool *seen = t->sight == SL_OPEN ? open : closed;
    if (space && space->cell_count <= ORACLE_CELLS && t->turned) {
        oracle_eye *oracle = oracle_eye_create(space, view->eye, borders, view->full ? 0 : 2);
        oracle_eye_sees(oracle, view, closed, open);
        oracle_eye_destroy(oracle);
        compare_cells(t, view, cells, seen, parents, space->cell_count, "cell");
    } else if (space && space->cell_count <= ORACLE_CELLS) {
        const bool glass = t->map.oneway_count; // that a ray comes back to may be dark for it alone
        oracle_mirrored truth =
            oracle_mirrored_of(space, &t->baked.map, view, t->range, glass ? 0 : t->depth);
        compare_cells(t, view, cells, t->sight == SL_OPEN ? truth.direct_open : truth.direct_closed,
                      parents, space->cell_count, "cell");
        if (!glass)
            compare_cells(t, view, mirrored, t->sight == SL_OPEN ? truth.open : truth.closed,
                          parents, space->cell_count, "cell in a mirror");
        oracle_mirrored_free(&truth);
    }
    sl_space_destroy(t->context, &copy);
}

static void check_superset(const trial *t, const sl_view *view, const uint64_t *cells,
                           const uint64_t *looser, const char *who) {
    for (uint32_t c = 0; c < t->baked.space.cell_count; c++)
        if (sl_eye_sees(cells, c) && !sl_eye_sees(looser, c))
            complain(t, view, view->eye, who, c, false);
}

static void check_looser(trial *t, const sl_view *view, const uint64_t *cells,
                         const uint64_t *mirrored) {
    uint64_t looser[CELLS_MOST / 64 + 1];
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    for (const sl_eye_method *m = methods; m + 1 < methods + count; m++) {
        if (m->needs_pvs && (t->bare || (t->backwards && t->map.oneway_count))) continue;
        assert_ok(t->context, sl_query_look(t->context, t->query, view, m, looser, NULL));
        check_superset(t, view, cells, looser, m->name);
        if (!m->mirrored || t->depth > t->baked_depth) continue;
        assert_ok(t->context, sl_query_look_mirrored(t->context, t->query, view, m, looser, NULL));
        check_superset(t, view, mirrored, looser, m->name);
    }
}

static void check_boxes(trial *t, const sl_view *view) {
    bool seen[BOX_COUNT];
    assert_ok(t->context, sl_query_boxes_seen(t->context, t->query, view, seen, NULL));
    for (size_t i = 0; i < BOX_COUNT; i++) {
        const sl_box box = t->boxes[i].box;
        two_points eye = stand(t, view->eye, i);
        box_sight sight = box_rays_sight(&eye, t->cover, box, view, t->range);
        eye.q = box.min;
        if (testing_same_point(box.min, box.max) && sight > BOX_HIDDEN &&
            !testing_same_point(box.min, view->eye))
            sight = is_seen(t, &eye, t->sight) ? BOX_SEEN : BOX_HIDDEN;
        const bool may_be = sight >= BOX_OPEN || (sight == BOX_TOUCHED && t->sight == SL_CLOSED);
        if (seen[i] ? !may_be : sight == BOX_SEEN) complain(t, view, box.min, "box", i, seen[i]);
        t->boxes_seen[sight]++;
    }
}

// --- in mirrors

/// What single rays know: walls, shut doors and boxes as walls, mirrors, and glass.
static sl_map map_of_rays(trial *t, sl_point eye, sl_wall *walls, sl_glass *panes) {
    sl_map map = {.walls = walls, .oneways = panes, .mirrors = t->baked.map.mirrors};
    stand(t, eye, BOX_COUNT);
    for (size_t i = t->dark; i < t->count; i++)
        walls[map.wall_count++] = (sl_wall){.a = t->walls[i].a, .b = t->walls[i].b};
    for (size_t i = 0; i < t->map.oneway_count; i++)
        panes[map.oneway_count++] = (sl_glass){.segment = glass_of(t, i)};
    map.mirror_count = t->baked.map.mirror_count;
    return map;
}

static bool is_on_wall(const trial *t, sl_point eye) {
    bool on = false;
    for (size_t i = t->dark; i < t->count; i++) on |= two_points_on(t->walls[i], eye);
    return on;
}

/// A place of a ray's leg, `away` from the eye: it is shown within the range, and its cell is seen.
static void check_leg(trial *t, const sl_view *view, const sl_mirrored_region *region,
                      const oracle_ray *ray, uint32_t leg, sl_point p, double away,
                      const uint64_t *cells, const uint64_t *row) {
    const bool wanted = !(t->range > 0) || away < t->range;
    const uint32_t cell = sl_space_locate(&t->baked.space, p);
    if (mirror_rays_show(region, ray, leg, p) != wanted)
        complain(t, view, p, "the reflection of the region", leg, !wanted);
    t->legs++;
    if (!wanted || mirror_rays_depth_in(&t->baked.space, cell, p) < NEAR) return;
    if (!sl_eye_sees(cells, cell)) complain(t, view, p, "reflection's cell", cell, false);
    if (!t->bare && leg <= t->baked_depth && !sl_eye_sees(row, cell))
        complain(t, view, p, "reflection in the visible sets, cell", cell, false);
}

static bool ends_at(sl_segment w, sl_point end) {
    const double dot = (end.x - w.a.x) * (end.x - w.b.x) + (end.y - w.a.y) * (end.y - w.b.y);
    return dot <= 0 && fabs(mirror_rays_cross(w.a, w.b, end)) < NEAR;
}

/// A reflected leg, cut at the range, that passes a box or ends at a side of its own sees it.
static void check_boxes_met(const trial *t, const sl_view *view, oracle_leg way, double away,
                            const bool *seen) {
    const sl_point d = {way.to.x - way.from.x, way.to.y - way.from.y};
    const double length = hypot(d.x, d.y), left = t->range > 0 ? t->range - away - NEAR : length;
    const sl_point end = way.to;
    size_t walls = 0; // that the leg ends at, and dark glass
    if (left <= 0) return;
    for (size_t i = t->dark; i < t->count; i++) walls += ends_at(t->walls[i], end);
    for (size_t i = 0; i < t->map.oneway_count; i++) {
        const sl_segment w = glass_of(t, i);
        walls += ends_at(w, end) && mirror_rays_cross(w.a, w.b, way.from) > 0;
    }
    for (size_t i = 0; i < BOX_COUNT; i++) {
        // A little farther: a box that blocks is not entered.
        const bool enter = t->boxes[i].blocks && left >= length && walls == 1;
        const double share = fmin(left / length, 1) + (enter ? 1e-4 / length : 0);
        way.to = (sl_point){way.from.x + share * d.x, way.from.y + share * d.y};
        const sl_box b = t->boxes[i].box;
        if (enter &&
            !(b.min.x < way.to.x && way.to.x < b.max.x && b.min.y < way.to.y && way.to.y < b.max.y))
            continue;
        if (!seen[i] && mirror_rays_meet_box(&way, b))
            complain(t, view, end, "box in a mirror", i, false);
    }
}

/// Rays that keep clear of all ends show what the region and the cells have, directly and in
/// mirrors; and rays to what the region shows end there.
static void check_rays(trial *t, const sl_view *view, const uint64_t *direct,
                       const uint64_t *mirrored) {
    sl_wall walls[WALLS_MOST];
    sl_glass panes[2];
    const sl_map map = map_of_rays(t, view->eye, walls, panes);
    const uint32_t from = sl_space_locate(&t->baked.space, view->eye);
    uint64_t rows[2][CELLS_MOST / 64 + 1];
    bool seen[BOX_COUNT];
    sl_mirrored_region region = {0};
    if (is_on_wall(t, view->eye) || is_in_line(t, view->eye)) return;
    assert_ok(t->context, sl_query_boxes_seen(t->context, t->query, view, NULL, seen));
    assert_ok(t->context, sl_query_mirrored_region(t->context, t->query, view, &region));
    for (int i = 0; i < 2 && !t->bare; i++)
        assert_ok(t->context, sl_query_row(t->context, t->query, from, i, rows[i]));
    for (int i = 0; i < RAYS; i++) {
        const sl_point to = {(double)below(t, 2001) - 1000, (double)below(t, 2001) - 1000};
        const sl_point through = {view->eye.x + to.x, view->eye.y + to.y};
        if (testing_same_point(view->eye, through) || !box_rays_in_view(view, through)) continue;
        const oracle_ray ray = oracle_ray_of(&map, view->eye, to, t->depth);
        double away = 0;
        for (uint32_t leg = 0; leg < ray.count && ray.margin > NEAR; leg++) {
            const sl_point a = ray.legs[leg].from, b = ray.legs[leg].to;
            const double share = 0.01 + 0.98 * sl_random_unit(&t->random);
            const sl_point p = {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
            const double length = hypot(b.x - a.x, b.y - a.y), at = away + share * length;
            if (fabs(at - t->range) > NEAR && share * length > NEAR)
                check_leg(t, view, &region, &ray, leg, p, at, leg ? mirrored : direct,
                          rows[leg > 0]);
            if (leg) check_boxes_met(t, view, ray.legs[leg], away, seen);
            away += length;
        }
    }
    for (uint32_t i = 0; i < region.part_count; i++) {
        const size_t edge = mirror_rays_wrong_edge(&map, view->eye, &region, i, 700, &t->parts);
        if (edge != SIZE_MAX)
            complain(t, view, region.parts[i].region.points[edge], "the edge of a part", edge,
                     true);
    }
    sl_mirrored_region_destroy(t->context, &region);
}

static void ask(trial *t, bool thorough) {
    const sl_view view = any_view(t, any_point(t));
    uint64_t cells[CELLS_MOST / 64 + 1], mirrored[CELLS_MOST / 64 + 1];
    assert_ok(t->context, sl_query_look(t->context, t->query, &view, NULL, cells, NULL));
    assert_ok(t->context,
              sl_query_look_mirrored(t->context, t->query, &view, NULL, mirrored, NULL));
    check_points(t, view.eye);
    check_places(t, &view, cells);
    check_looser(t, &view, cells, mirrored);
    check_boxes(t, &view);
    check_rays(t, &view, cells, mirrored);
    if (thorough) check_cells(t, &view, cells, mirrored);
}

/// A copy knows all settings but the boxes, and no visible sets.
static void go_on_with_copy(trial *t) {
    sl_query *copy;
    assert_ok(t->context, sl_query_copy(t->context, t->query, &copy));
    sl_query_destroy(t->context, t->query);
    t->query = copy;
    t->bare = true;
    t->sight = SL_CLOSED;
    assert_ok(t->context, sl_query_set_boxes(t->context, t->query, t->boxes, BOX_COUNT));
}

static void try_query(trial *t) {
    sl_context *context = t->context;
    t->sight = t->bare ? SL_CLOSED : t->baked.visibility.sight;
    t->backwards = false;
    t->depth = 1;
    if (t->bare)
        assert_ok(context, sl_query_over(context, &t->baked.space, &t->baked.map, NULL, &t->query));
    else
        assert_ok(context, sl_query_create(context, &t->baked, &t->query));
    for (uint64_t i = 0; i < 4 + DOOR_COUNT; i++) change(t, i);
    for (int i = 0; i < CHANGES; i++) {
        for (int k = 0; k < EYES; k++) ask(t, k == 0);
        for (uint64_t k = below(t, 4); k < 4; k++) change(t, below(t, 4 + DOOR_COUNT));
        if (below(t, 4) == 0) go_on_with_copy(t);
    }
    sl_query_destroy(context, t->query);
}

static void each_set_of_effects(void **state) {
    (void)state;
    testing_memory memory = {0};
    trial t = {.context = testing_context(&memory)};
    const char *first = getenv("SIGHTLINE_FIRST");
    const uint64_t from = first ? strtoull(first, NULL, 10) : 1, maps = testing_seeds(3);
    for (t.seed = from; t.seed < from + maps; t.seed++)
        for (t.effects = 0; t.effects < SUBSETS; t.effects++)
            for (int turned = 0; turned < 2; turned++) {
                t.turned = turned;
                t.random = (sl_random){t.seed * SUBSETS + t.effects};
                make_map(&t);
                for (int bare = 0; bare < 2; bare++) {
                    t.bare = bare;
                    try_query(&t);
                }
                sl_baked_destroy(t.context, &t.baked);
                sl_map_destroy(t.context, &t.map);
            }
    print_message("%zu of %zu points seen, %zu of %zu places, %zu of %zu cells; boxes: %zu hidden, "
                  "%zu touched, %zu open, %zu seen; %zu legs, %zu edges\n",
                  t.asked[1], t.asked[0] + t.asked[1], t.places[1], t.places[0] + t.places[1],
                  t.cells[1], t.cells[0] + t.cells[1], t.boxes_seen[0], t.boxes_seen[1],
                  t.boxes_seen[2], t.boxes_seen[3], t.legs, t.parts);
    sl_context_destroy(t.context);
    assert_int_equal(memory.live, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_set_of_effects)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

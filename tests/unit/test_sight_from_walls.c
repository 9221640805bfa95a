// Sight from points on walls: ends of walls and corners of pillars, ends of doors and of glass, and
// points within walls. The runtime, the library and an oracle that knows walls alone answer for all
// pairs of such points, both ways, on random maps with solid ground, doors, glass and mirrors. Of
// each answer about two points, the polygon, the region, the runtime's look and the library's
// culling say the same. A box outside of the map changes nothing. With view cones, too, the
// runtime's look is the library's culling, and has those of the eye's cells that the cone leads
// into. SIGHTLINE_SEEDS in the environment: how many maps (200 by default).
#include "runtime_maps.h"
#include "sight/eye_search.h"

#include "oracle/two_points.h"
#include "sightline/bake.h"
#include "sightline/support.h"
#include "space/index.h"

#include <math.h>

enum { MAPS = 200, SIZE = 12, WALLS = 9, PILLARS = 3, DOORS = 3, GLASS = 2, MIRRORS = 2 };
enum { POINTS_MOST = 400, CONES = 12 };

typedef struct trial {
    sl_context *context;
    sl_random random;
    uint64_t seed;
    baked_file file;
    sl_query *query;
    unsigned char *shut;
    uint32_t *scratch, *cells;
    double *polygon;
    uint32_t polygon_room;
    uint64_t *seen, *looser;
    sl_region region;
    sl_segment *walls; ///< with shut doors and the bounds; room for glass
    size_t wall_count;
    sl_point pillars[PILLARS][4];
    size_t pillar_count, pillar_corners;
    sl_point points[POINTS_MOST];
    size_t point_count;
    size_t seen_pairs, pairs, places;
    size_t entered, left; ///< cells of an eye that its cone leads into, or does not
} trial;

// --- maps of even coordinates, so that walls' middles are whole. No two segments cross.

/// Turned by an angle that leaves coordinates whole.
static sl_point on_grid(const trial *t, double x, double y) {
    const sl_point p = {2 * x, 2 * y};
    return t->seed % 3 == 1 ? (sl_point){4 * p.x - 3 * p.y, 3 * p.x + 4 * p.y} : p;
}

static sl_point random_corner(trial *t) {
    const double x = (double)sl_random_below(&t->random, SIZE + 1);
    const double y = (double)sl_random_below(&t->random, SIZE + 1);
    return on_grid(t, x, y);
}

/// Along the axes of the grid, or on every third map anywhere.
static sl_segment random_segment(trial *t) {
    if (t->seed % 3 == 2) {
        sl_segment s;
        do s = (sl_segment){random_corner(t), random_corner(t)};
        while (testing_same_point(s.a, s.b));
        return s;
    }
    const sl_segment s = grid_segment(&t->random, SIZE);
    return (sl_segment){on_grid(t, s.a.x, s.a.y), on_grid(t, s.b.x, s.b.y)};
}

/// Whether segments have a point in common that is an end of neither.
static bool cross(sl_segment s, sl_segment w) {
    const int a = sl_orient(s.a, s.b, w.a), b = sl_orient(s.a, s.b, w.b);
    const int p = sl_orient(w.a, w.b, s.a), q = sl_orient(w.a, w.b, s.b);
    return a * b < 0 && p * q < 0;
}

static bool fits(const sl_map *map, sl_segment s) {
    for (size_t i = 0; i < map->wall_count; i++)
        if (cross(s, (sl_segment){map->walls[i].a, map->walls[i].b})) return false;
    for (size_t i = 0; i < map->door_count; i++)
        if (cross(s, map->doors[i].segment)) return false;
    for (size_t i = 0; i < map->oneway_count; i++)
        if (cross(s, map->oneways[i].segment)) return false;
    for (size_t i = 0; i < map->mirror_count; i++)
        if (cross(s, map->mirrors[i].segment)) return false;
    return true;
}

/// A triangle, or along the axes a box.
static void add_pillar(trial *t, sl_map *map) {
    sl_point at[4];
    const bool is_free = t->seed % 3 == 2;
    const double x = (double)sl_random_below(&t->random, SIZE - 2);
    const double y = (double)sl_random_below(&t->random, SIZE - 2);
    const double width = 1 + (double)sl_random_below(&t->random, 2);
    const double height = 1 + (double)sl_random_below(&t->random, 2);
    const double of[4][2] = {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
    for (int i = 0; i < 4; i++) at[i] = on_grid(t, of[i][0], of[i][1]);
    for (int i = 0; i < 3 && is_free; i++) at[i] = random_corner(t);
    const int count = is_free ? 3 : 4;
    if (sl_orient(at[0], at[1], at[2]) == 0) return;
    for (int i = 0; i < count; i++)
        if (!fits(map, (sl_segment){at[i], at[(i + 1) % count]})) return;
    assert_ok(t->context, sl_map_add_solid(t->context, map, at, (size_t)count, 0));
    memcpy(t->pillars[t->pillar_count++], at, sizeof at);
    t->pillar_corners = (size_t)count;
}

/// Doors and glass may touch solid ground with their ends only.
static bool is_free_of_pillars(const trial *t, sl_segment s) {
    for (size_t i = 0; i < 7 * t->pillar_count; i++) {
        const sl_point *at = t->pillars[i / 7],
                       p = runtime_between(s.a, s.b, (double)(i % 7 + 1) / 8);
        const int turn = sl_orient(at[0], at[1], at[2]);
        bool outside = false;
        for (size_t k = 0; k < t->pillar_corners; k++)
            outside |= turn * sl_orient(at[k], at[(k + 1) % t->pillar_corners], p) < 0;
        if (!outside) return false;
    }
    return true;
}

static void make_map(trial *t, sl_map *map) {
    sl_context *context = t->context;
    const double corners[5][2] = {{0, 0}, {SIZE, 0}, {SIZE, SIZE}, {0, SIZE}, {0, 0}};
    for (int i = 0; i < 4; i++)
        assert_ok(context, sl_map_add_wall(context, map, on_grid(t, corners[i][0], corners[i][1]),
                                           on_grid(t, corners[i + 1][0], corners[i + 1][1]), 0));
    for (int i = 0; i < PILLARS; i++) add_pillar(t, map);
    for (int i = 0; i < WALLS; i++) {
        const sl_segment at = random_segment(t);
        if (fits(map, at)) assert_ok(context, sl_map_add_wall(context, map, at.a, at.b, 0));
    }
    for (int i = 0; i < DOORS; i++) {
        const char name[2] = {(char)('a' + i), 0};
        const sl_segment at = random_segment(t);
        if (fits(map, at) && is_free_of_pillars(t, at))
            assert_ok(context, sl_map_add_door(context, map, name, at, true, 0));
    }
    for (int i = 0; i < GLASS && t->seed % 2; i++) {
        const sl_segment at = random_segment(t);
        if (fits(map, at) && is_free_of_pillars(t, at))
            assert_ok(context, sl_map_add_oneway(context, map, at, 0));
    }
    for (int i = 0; i < MIRRORS && t->seed % 4 > 1; i++) {
        const sl_segment at = random_segment(t);
        if (fits(map, at) && is_free_of_pillars(t, at))
            assert_ok(context, sl_map_add_mirror(context, map, at, 0));
    }
    assert_ok(context, sl_map_clean(context, map, NULL, NULL));
}

// --- the points, and what parts them

static void add_point(trial *t, sl_point p) {
    for (size_t i = 0; i < t->point_count; i++)
        if (testing_same_point(t->points[i], p)) return;
    assert_true(t->point_count < POINTS_MOST);
    t->points[t->point_count++] = p;
}

static void add_segment(trial *t, sl_segment s) {
    add_point(t, s.a);
    add_point(t, s.b);
    if (remainder(s.a.x + s.b.x, 2) == 0 && remainder(s.a.y + s.b.y, 2) == 0)
        add_point(t, (sl_point){(s.a.x + s.b.x) / 2, (s.a.y + s.b.y) / 2});
}

static void gather_points(trial *t) {
    const sl_map *map = &t->file.baked.map;
    for (size_t i = 0; i < map->wall_count; i++)
        add_segment(t, (sl_segment){map->walls[i].a, map->walls[i].b});
    for (size_t i = 0; i < map->door_count; i++) add_segment(t, map->doors[i].segment);
    for (size_t i = 0; i < map->oneway_count; i++) add_segment(t, map->oneways[i].segment);
    for (size_t i = 0; i < map->mirror_count; i++) add_segment(t, map->mirrors[i].segment);
    for (int i = 0; i < 3; i++) add_point(t, random_corner(t));
}

static void gather_walls(trial *t) {
    const sl_map *map = &t->file.baked.map;
    const sl_point min = t->file.baked.space.bounds.min, max = t->file.baked.space.bounds.max;
    const sl_point corners[5] = {min, {max.x, min.y}, max, {min.x, max.y}, min};
    t->walls =
        malloc((4 + map->wall_count + map->door_count + map->oneway_count + map->mirror_count) *
               sizeof *t->walls);
    assert_non_null(t->walls);
    for (int i = 0; i < 4; i++)
        t->walls[t->wall_count++] = (sl_segment){corners[i], corners[i + 1]};
    for (size_t i = 0; i < map->wall_count; i++)
        t->walls[t->wall_count++] = (sl_segment){map->walls[i].a, map->walls[i].b};
    for (size_t i = 0; i < map->mirror_count; i++)
        t->walls[t->wall_count++] = map->mirrors[i].segment;
    for (size_t i = 0; i < map->door_count; i++) {
        t->shut[i] = (unsigned char)sl_random_below(&t->random, 2);
        assert_ok(t->context,
                  sl_query_set_door(t->context, t->query, map->doors[i].name, !t->shut[i]));
        if (t->shut[i]) t->walls[t->wall_count++] = map->doors[i].segment;
    }
}

// --- the oracle

/// Glass is dark at its left. For an eye in line with it the side of the eye's cell counts.
static bool is_dark(const sl_space *s, sl_segment glass, sl_point eye, const sl_cell *cell) {
    const int side = sl_orient(glass.a, glass.b, eye);
    bool left = side > 0;
    for (uint32_t i = 0; i < cell->vertex_count && !side; i++)
        left |= sl_orient(glass.a, glass.b, s->vertices[cell->first_vertex + i]) > 0;
    return left;
}

/// Adds glass that is dark for an eye to the walls. False if the eye is in solid ground or outside.
static bool stand(trial *t, sl_point eye, two_points *out) {
    const sl_map *map = &t->file.baked.map;
    const sl_space *s = &t->file.baked.space;
    const uint32_t at = sl_space_locate(s, eye);
    if (at == SL_NO_CELL || s->cells[at].solid) return false;
    const sl_cell *cell = &s->cells[at];
    *out = (two_points){.walls = t->walls, .count = t->wall_count, .p = eye};
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        out->inward.x += s->vertices[cell->first_vertex + i].x - eye.x;
        out->inward.y += s->vertices[cell->first_vertex + i].y - eye.y;
    }
    for (size_t i = 0; i < map->oneway_count; i++)
        if (is_dark(s, map->oneways[i].segment, eye, cell))
            t->walls[out->count++] = map->oneways[i].segment;
    return true;
}

static void complain(const trial *t, sl_point p, sl_point q, const char *who, bool said) {
    const sl_map *map = &t->file.baked.map;
    for (size_t i = 0; i < t->wall_count; i++)
        print_error("wall %g %g %g %g\n", t->walls[i].a.x, t->walls[i].a.y, t->walls[i].b.x,
                    t->walls[i].b.y);
    for (size_t i = 0; i < map->oneway_count; i++)
        print_error("oneway %g %g %g %g\n", map->oneways[i].segment.a.x,
                    map->oneways[i].segment.a.y, map->oneways[i].segment.b.x,
                    map->oneways[i].segment.b.y);
    fail_msg("map %llu: %s: (%.17g, %.17g) to (%.17g, %.17g) is %s", (unsigned long long)t->seed,
             who, p.x, p.y, q.x, q.y, said ? "added" : "missed");
}

// --- what is compared

static bool runtime_sees(const trial *t, sl_point p, sl_point q) {
    return sl_runtime_sees(&t->file.runtime, p.x, p.y, q.x, q.y, t->shut, 0, t->scratch);
}

static void compare_points(trial *t, const two_points *way, bool stands) {
    bool by_library;
    const bool seen = stands && two_points_see(way);
    assert_ok(t->context, sl_query_sees(t->context, t->query, way->p, way->q, &by_library));
    if (runtime_sees(t, way->p, way->q) != seen) complain(t, way->p, way->q, "the runtime", !seen);
    if (by_library != seen) complain(t, way->p, way->q, "the library", !seen);
    t->seen_pairs += seen;
    t->pairs++;
}

/// Whether a polygon about the eye holds a point: 1 or 0, and -1 for one too near to its border.
static int polygon_holds(const double *xy, size_t count, sl_point p) {
    bool inside = false;
    for (size_t i = 0, before = count - 1; i < count; before = i++) {
        const double ax = xy[2 * before] - p.x, ay = xy[2 * before + 1] - p.y;
        const double bx = xy[2 * i] - p.x, by = xy[2 * i + 1] - p.y;
        const double turn = ax * by - ay * bx, length = hypot(bx - ax, by - ay);
        if (fabs(turn) < 1e-7 * length && ax * bx + ay * by <= 0) return -1;
        if ((ay > 0) != (by > 0) && (turn > 0) == (by > ay)) inside = !inside;
    }
    return inside;
}

static uint32_t make_polygon(trial *t, const sl_runtime_view *view) {
    uint32_t count;
    while ((count = sl_runtime_visible_polygon(&t->file.runtime, view, t->shut, 0, t->scratch,
                                               t->polygon, t->polygon_room)) > t->polygon_room) {
        t->polygon_room = count;
        t->polygon = realloc(t->polygon, 2 * count * sizeof *t->polygon);
        assert_non_null(t->polygon);
    }
    return count;
}

/// A place within a cell, as good as never in line with corners.
static sl_point place_in(trial *t, uint32_t cell) {
    const sl_space *s = &t->file.baked.space;
    const sl_cell *c = &s->cells[cell];
    sl_point sum = {0};
    double total = 0;
    for (uint32_t i = 0; i < c->vertex_count; i++) {
        const double weight = 0.1 + sl_random_unit(&t->random);
        sum.x += weight * s->vertices[c->first_vertex + i].x;
        sum.y += weight * s->vertices[c->first_vertex + i].y;
        total += weight;
    }
    return (sl_point){sum.x / total, sum.y / total};
}

/// A place within each cell is seen if the polygon and the region hold it. Then its cell is seen.
static void compare_places(trial *t, two_points *way, uint32_t corners) {
    const sl_space *s = &t->file.baked.space;
    for (uint32_t c = 0; c < s->cell_count; c++) {
        const sl_point to = place_in(t, c);
        const int by_polygon = polygon_holds(t->polygon, corners, to);
        const int by_region = polygon_holds((const double *)t->region.points, t->region.count, to);
        bool by_library;
        assert_ok(t->context, sl_query_sees(t->context, t->query, way->p, to, &by_library));
        if (runtime_sees(t, way->p, to) != by_library)
            complain(t, way->p, to, "the runtime beside the library", !by_library);
        if (by_polygon >= 0 && by_polygon != by_library)
            complain(t, way->p, to, "the polygon", by_polygon);
        if (by_region >= 0 && by_region != by_library)
            complain(t, way->p, to, "the region", by_region);
        if (by_library && !sl_eye_sees(t->seen, c)) complain(t, way->p, to, "the cell", false);
        t->places += by_library;
    }
}

static void complain_of_cell(const trial *t, const sl_view *view, uint32_t cell, const char *who,
                             bool said) {
    const sl_space *s = &t->file.baked.space;
    const sl_point corner = s->vertices[s->cells[cell].first_vertex];
    if (!view->full)
        print_error("right (%.17g, %.17g) left (%.17g, %.17g)\n", view->right.x, view->right.y,
                    view->left.x, view->left.y);
    print_error("cell %u with a corner at (%.17g, %.17g)\n", cell, corner.x, corner.y);
    complain(t, view->eye, corner, who, said);
}

/// The runtime's cells are those of the exact method, and each looser method has them.
static void compare_cells(trial *t, const sl_view *view) {
    const sl_runtime *r = &t->file.runtime;
    const sl_point eye = view->eye;
    const sl_runtime_view same = {eye.x,
                                  eye.y,
                                  view->full,
                                  {view->right.x - eye.x, view->right.y - eye.y},
                                  {view->left.x - eye.x, view->left.y - eye.y}};
    const uint32_t count =
        sl_runtime_look_past(r, &same, t->shut, 0, t->scratch, t->cells, r->cell_count);
    assert_ok(t->context, sl_query_look(t->context, t->query, view, NULL, t->seen, NULL));
    memset(t->looser, 0, sl_eye_words(&t->file.baked.space) * sizeof *t->looser);
    for (uint32_t i = 0; i < count; i++) t->looser[t->cells[i] / 64] |= 1ull << t->cells[i] % 64;
    for (uint32_t c = 0; c < r->cell_count; c++)
        if (sl_eye_sees(t->looser, c) != sl_eye_sees(t->seen, c))
            complain_of_cell(t, view, c, "the runtime's cell beside the library",
                             sl_eye_sees(t->looser, c));
    size_t methods;
    for (const sl_eye_method *m = sl_eye_methods(&methods); methods > 0; methods--, m++) {
        assert_ok(t->context, sl_query_look(t->context, t->query, view, m, t->looser, NULL));
        for (uint32_t i = 0; i < count; i++) assert_true(sl_eye_sees(t->looser, t->cells[i]));
    }
}

/// A box outside of the map that hides what is behind it changes nothing.
static void compare_past_a_box(trial *t, const sl_view *view) {
    const sl_space *s = &t->file.baked.space;
    const sl_point corner = s->bounds.min;
    const sl_moving_box outside = {{{corner.x - 2, corner.y - 2}, {corner.x - 1, corner.y - 1}},
                                   true};
    assert_ok(t->context, sl_query_look(t->context, t->query, view, NULL, t->seen, NULL));
    assert_ok(t->context, sl_query_set_boxes(t->context, t->query, &outside, 1));
    assert_ok(t->context, sl_query_look(t->context, t->query, view, NULL, t->looser, NULL));
    assert_ok(t->context, sl_query_set_boxes(t->context, t->query, NULL, 0));
    for (uint32_t c = 0; c < s->cell_count; c++)
        if (sl_eye_sees(t->looser, c) != sl_eye_sees(t->seen, c))
            complain_of_cell(t, view, c, "the look past a box", sl_eye_sees(t->looser, c));
}

// --- cones

/// Whether a view has a direction that enters a cell with the eye, or runs along its border: it
/// holds a corner of the cell, or lies between the cell's sides at the eye.
static bool leads_into(const sl_space *s, uint32_t number, const sl_view *view) {
    const sl_cell *cell = &s->cells[number];
    const sl_point *v = s->vertices + cell->first_vertex, eye = view->eye;
    bool between = true;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point a = v[i], b = v[(i + 1) % cell->vertex_count];
        if (!testing_same_point(a, eye) && sli_view_holds(view, a)) return true;
        if (sl_orient(a, b, eye) == 0) between &= sl_orient(a, b, view->right) >= 0;
    }
    return between;
}

/// A cell at the eye is seen only if the cone leads into it. Where nothing but walls parts cells,
/// each of the eye's cells that the cone leads into is seen.
static void check_own_cells(trial *t, const sl_view *view) {
    const sl_space *s = &t->file.baked.space;
    const sl_map *map = &t->file.baked.map;
    const bool walls_alone = !map->door_count && !map->oneway_count;
    for (uint32_t c = 0; c < s->cell_count; c++)
        if (sl_eye_sees(t->seen, c) && sli_cell_holds(s, c, view->eye) && !leads_into(s, c, view))
            complain_of_cell(t, view, c, "the cell that the cone leaves", true);
    memset(t->looser, 0, sl_eye_words(s) * sizeof *t->looser);
    const uint32_t own = sli_eye_cells(s, view->eye, t->cells, t->looser);
    for (uint32_t i = 0; i < own; i++) {
        const bool enters = leads_into(s, t->cells[i], view);
        if (walls_alone && enters && !sl_eye_sees(t->seen, t->cells[i]))
            complain_of_cell(t, view, t->cells[i], "the cell that the cone enters", false);
        t->entered += enters;
        t->left += !enters;
    }
}

/// Another point, often one on a wall or portal at the eye.
static sl_point random_border(trial *t, sl_point eye) {
    static const double ways[8][2] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                      {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
    const double *way = ways[sl_random_below(&t->random, 8)];
    sl_point p = {eye.x + way[0], eye.y + way[1]};
    if (sl_random_below(&t->random, 4)) p = t->points[sl_random_below(&t->random, t->point_count)];
    return testing_same_point(p, eye) ? (sl_point){eye.x, eye.y + 1} : p;
}

/// Cones of no width, of 180 degrees and of any.
static void try_cones(trial *t, sl_point eye) {
    for (int i = 0; i < CONES; i++) {
        sl_view view = {eye, false, random_border(t, eye), random_border(t, eye)};
        if (i % 4 == 0) view.left = view.right;
        if (i % 4 == 1) view.left = (sl_point){2 * eye.x - view.right.x, 2 * eye.y - view.right.y};
        compare_cells(t, &view);
        check_own_cells(t, &view);
    }
}

static void try_eye(trial *t, sl_point eye) {
    two_points way = {.p = eye};
    const bool stands = stand(t, eye, &way);
    const sl_runtime_view view = sl_runtime_view_all_round(eye.x, eye.y);
    const sl_view same = sl_view_all_round(eye);
    for (size_t i = 0; i < t->point_count; i++) {
        way.q = t->points[i];
        compare_points(t, &way, stands);
    }
    compare_cells(t, &same);
    compare_past_a_box(t, &same);
    const uint32_t corners = make_polygon(t, &view);
    assert_ok(t->context, sl_query_region(t->context, t->query, &same, &t->region));
    assert_int_equal(corners > 0, t->region.count > 0);
    assert_int_equal(corners > 0, stands);
    if (stands) compare_places(t, &way, corners);
    try_cones(t, eye);
}

// --- a map

static void open_trial(trial *t) {
    const sl_runtime *r = &t->file.runtime;
    const size_t words = sl_eye_words(&t->file.baked.space);
    assert_ok(t->context, sl_query_create(t->context, &t->file.baked, &t->query));
    t->scratch = malloc(sl_runtime_scratch_count(r) * sizeof *t->scratch);
    t->cells = malloc(r->cell_count * sizeof *t->cells);
    t->seen = malloc(words * sizeof *t->seen);
    t->looser = malloc(words * sizeof *t->looser);
    t->shut = calloc(r->door_count + 1, 1);
    assert_true(t->scratch && t->cells && t->seen && t->looser && t->shut);
    gather_walls(t);
    gather_points(t);
}

static void close_trial(trial *t) {
    sl_region_destroy(t->context, &t->region);
    sl_query_destroy(t->context, t->query);
    baked_file_destroy(t->context, &t->file);
    free(t->scratch);
    free(t->cells);
    free(t->seen);
    free(t->looser);
    free(t->shut);
    free(t->polygon);
    free(t->walls);
}

static void all_say_the_same(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    size_t seen = 0, pairs = 0, places = 0, entered = 0, left = 0;
    const uint64_t maps = testing_seeds(MAPS);
    for (uint64_t seed = 1; seed <= maps; seed++) {
        trial t = {.context = context, .random = {seed}, .seed = seed};
        t.file = (baked_file){.name = "random", .baked = {.method = "dfs", .solver = "funnel"}};
        make_map(&t, &t.file.baked.map);
        baked_file_make(context, &t.file, false);
        open_trial(&t);
        for (size_t i = 0; i < t.point_count; i++) try_eye(&t, t.points[i]);
        seen += t.seen_pairs;
        pairs += t.pairs;
        places += t.places;
        entered += t.entered;
        left += t.left;
        close_trial(&t);
    }
    print_message("%zu of %zu pairs of points and %zu places seen\n", seen, pairs, places);
    print_message("%zu of %zu cells at eyes are entered by cones\n", entered, entered + left);
    assert_true(entered > 100 * maps && left > 100 * maps);
    assert_true(seen > 100 * maps && pairs - seen > 100 * maps && places > 100 * maps);
    sl_context_destroy(context);
}

// --- by hand

static void check_pairs(const char *text, sl_point p, sl_point q, bool there, bool back) {
    trial t = {.context = testing_context(NULL), .random = {1}};
    t.file = baked_file_of_text(t.context, text);
    open_trial(&t);
    const bool expected[2] = {there, back};
    for (int i = 0; i < 2; i++) {
        two_points way;
        bool seen;
        const sl_point from = i ? q : p, to = i ? p : q;
        assert_true(stand(&t, from, &way));
        way.q = to;
        compare_points(&t, &way, true);
        assert_ok(t.context, sl_query_sees(t.context, t.query, from, to, &seen));
        assert_int_equal(seen, expected[i]);
    }
    close_trial(&t);
    sl_context_destroy(t.context);
}

#define ROOM "walls 0 0 10 0 10 10 0 10 0 0\n"

static void from_a_pillars_corner(void **state) {
    (void)state;
    check_pairs(ROOM "solid 3 8 7 3 3 4\n", (sl_point){3, 8}, (sl_point){0, 0}, true, true);
}

static void from_a_walls_end(void **state) {
    (void)state;
    check_pairs(ROOM "wall 8 6 9 6\nwall 1 6 1 9\nwall 2 6 2 7\n", (sl_point){2, 6},
                (sl_point){1, 7}, true, true);
}

/// Who stands on a wall sees the side of his cell, and is seen from both sides.
static void nobody_looks_through_a_wall(void **state) {
    (void)state;
    check_pairs(ROOM "wall 4 2 4 8\n", (sl_point){4, 5}, (sl_point){1, 5}, false, true);
    check_pairs(ROOM "wall 4 2 4 8\n", (sl_point){4, 5}, (sl_point){9, 5}, true, true);
    check_pairs(ROOM "wall 4 2 4 8\n", (sl_point){4, 2}, (sl_point){1, 5}, true, true);
    // Two walls that meet part what is around their corner.
    check_pairs(ROOM "walls 4 8 4 2 8 2\n", (sl_point){4, 2}, (sl_point){1, 5}, false, true);
    check_pairs(ROOM "walls 4 8 4 2 8 2\n", (sl_point){4, 2}, (sl_point){6, 5}, true, true);
}

/// Past a wall's end at the left, one at the right and one at the left again.
static void a_line_may_touch_on_both_sides(void **state) {
    (void)state;
    check_pairs(ROOM "wall 2 5 2 10\nwall 4 0 4 5\nwall 6 5 6 10\n", (sl_point){1, 5},
                (sl_point){9, 5}, true, true);
}

/// An eye in line with glass, in a cell that is on both sides of the line.
static void in_line_with_glass(void **state) {
    (void)state;
    check_pairs(ROOM "oneway 8 5 4 5\nwall 8 3 8 5\n", (sl_point){8, 5}, (sl_point){4, 1}, false,
                true);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(from_a_pillars_corner),
        cmocka_unit_test(from_a_walls_end),
        cmocka_unit_test(nobody_looks_through_a_wall),
        cmocka_unit_test(a_line_may_touch_on_both_sides),
        cmocka_unit_test(in_line_with_glass),
        cmocka_unit_test(all_say_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/// Boxes that move among oblique walls, on random maps, on axial ones that are turned, and on one
/// that was once a fault.
///
/// The space with boxes in it is held against what is promised of its walls: those of the map and
/// the sides of boxes, some of them bent by steps of doubles where they cross. What is seen in it
/// is held against brute force in integers. And where walls as they are and walls as bent agree on
/// what is free or hidden between two points, by rationals, so must the space. SIGHTLINE_SEEDS in
/// the environment: how many maps (50 by default).
#include "sight/moving.h"
#include "sight/region.h"
#include "space/subdivide.h"
#include "testing.h"

#include "oracle/blockers.h"
#include "oracle/eye.h"
#include "oracle/random_map.h"
#include "oracle/random_oblique.h"
#include "space/boxes.h"

#include <math.h>

enum {
    BOXES = 4,
    EYES = 4,
    POINTS = 40,
    WALLS = 9,
    CELLS_MOST = 2048,
    SEGMENTS_MOST = 1 << 14,
    ORACLE_CELLS = 40
};

typedef struct segments {
    sl_segment items[SEGMENTS_MOST];
    size_t count;
    blockers *blockers;
} segments;

typedef struct trial {
    sl_context *context;
    uint64_t seed;
    sl_random random;
    sl_map map;
    sl_space space;
    sl_visibility baked;
    sl_moving_box boxes[4 * BOXES];
    size_t count;
    sli_moving *moving;
    segments straight; ///< the map's walls, and the sides of boxes that block
    segments bent;     ///< the same as the space with boxes has them
    double size;
    double step; ///< of doubles, at the largest coordinate
    bool coarse; ///< places are steps of doubles apart: only the space is checked
    size_t free, hidden, cells_seen, cells_asked, boxes_seen, boxes_asked, bends;
} trial;

static uint64_t below(trial *t, uint64_t bound) {
    return sl_random_below(&t->random, bound);
}

// --- the map with boxes

static double random_coordinate(trial *t, bool vertical) {
    const sl_wall *w = &t->map.walls[below(t, t->map.wall_count)];
    const sl_point end = below(t, 2) ? w->a : w->b;
    const sl_box b = t->space.bounds;
    if (below(t, 3) == 0) return vertical ? end.y : end.x;
    const double share = sl_random_unit(&t->random) * 1.2 - 0.1; // a little out of bounds too
    const double value =
        vertical ? b.min.y + share * (b.max.y - b.min.y) : b.min.x + share * (b.max.x - b.min.x);
    return sl_coordinate_usable(value) ? value : end.x;
}

static sl_box random_box(trial *t) {
    const double x0 = random_coordinate(t, false), y0 = random_coordinate(t, true);
    double x1 = random_coordinate(t, false), y1 = random_coordinate(t, true);
    const uint64_t flat = below(t, 12);
    if (flat == 0) x1 = x0;
    if (flat == 1) y1 = y0;
    return (sl_box){{fmin(x0, x1), fmin(y0, y1)}, {fmax(x0, x1), fmax(y0, y1)}};
}

static void corners_of(sl_box box, sl_point c[4]) {
    c[0] = box.min;
    c[1] = (sl_point){box.max.x, box.min.y};
    c[2] = box.max;
    c[3] = (sl_point){box.min.x, box.max.y};
}

static void add_segment(segments *s, sl_point a, sl_point b) {
    assert_true(s->count < SEGMENTS_MOST);
    s->items[s->count++] = (sl_segment){a, b};
}

static void gather_segments(trial *t) {
    const sl_space *boxed = sli_moving_space(t->moving, NULL);
    t->straight.count = t->bent.count = 0;
    for (size_t i = 0; i < t->map.wall_count; i++)
        add_segment(&t->straight, t->map.walls[i].a, t->map.walls[i].b);
    for (size_t i = 0; i < t->count; i++) {
        sl_point c[4];
        corners_of(t->boxes[i].box, c);
        for (int k = 0; k < 4 && t->boxes[i].blocks; k++)
            add_segment(&t->straight, c[k], c[(k + 1) % 4]);
    }
    for (uint32_t i = 0; i < boxed->cell_count; i++) {
        const sl_cell *cell = &boxed->cells[i];
        const sl_point *v = boxed->vertices + cell->first_vertex;
        for (uint32_t k = 0; k < cell->vertex_count; k++)
            if (boxed->neighbour[cell->first_vertex + k] < SL_NEIGHBOUR_BORDER)
                add_segment(&t->bent, v[k], v[(k + 1) % cell->vertex_count]);
    }
}

// --- what is said, and what is so

static void complain(const trial *t, sl_point eye, sl_point p, const char *what, size_t number) {
    for (size_t i = 0; i < t->map.wall_count; i++) {
        const sl_wall *w = &t->map.walls[i];
        print_error("wall %.17g %.17g %.17g %.17g\n", w->a.x, w->a.y, w->b.x, w->b.y);
    }
    for (size_t i = 0; i < t->count; i++) {
        const sl_box b = t->boxes[i].box;
        print_error("box %.17g %.17g %.17g %.17g%s\n", b.min.x, b.min.y, b.max.x, b.max.y,
                    t->boxes[i].blocks ? " block" : "");
    }
    fail_msg("\nseed %llu, %s sight: eye %.17g,%.17g point %.17g,%.17g: %s %zu",
             (unsigned long long)t->seed, t->baked.sight == SL_OPEN ? "open" : "closed", eye.x,
             eye.y, p.x, p.y, what, number);
}

static double cross(sl_point a, sl_point b, sl_point c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// How far a point is from a segment's line, and on which side. 0 for a segment of no length.
static double off(sl_segment s, sl_point p) {
    const double length = hypot(s.b.x - s.a.x, s.b.y - s.a.y);
    return length > 0 ? cross(s.a, s.b, p) / length : 0;
}

/// Whether two points are strictly apart by one of the segments.
static bool is_hidden(const segments *all, sl_point p, sl_point q) {
    for (size_t i = 0; i < all->count; i++) {
        const sl_point a = all->items[i].a, b = all->items[i].b;
        if (blockers_turn(p, q, a) * blockers_turn(p, q, b) < 0 &&
            blockers_turn(a, b, p) * blockers_turn(a, b, q) < 0)
            return true;
    }
    return false;
}

static bool touch(sl_box a, sl_box b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y;
}

static sl_box box_around(sl_point a, sl_point b, double more) {
    return (sl_box){{fmin(a.x, b.x) - more, fmin(a.y, b.y) - more},
                    {fmax(a.x, b.x) + more, fmax(a.y, b.y) + more}};
}

/// A corner within a wall: on a line of a box, and no farther from the wall than a step of doubles;
/// within a box's side, on it. Where walls are steps of doubles apart they bend each other too.
static bool is_on_wall(const trial *t, uint32_t wall, sl_point p) {
    const sl_wall *w = &sli_moving_space(t->moving, NULL)->walls[wall];
    bool on_box = false;
    for (size_t i = 0; i < t->count; i++) {
        const sl_box b = t->boxes[i].box;
        on_box |= p.x == b.min.x || p.x == b.max.x || p.y == b.min.y || p.y == b.max.y;
    }
    if (wall >= t->space.wall_count) return w->a.x == w->b.x ? p.x == w->a.x : p.y == w->a.y;
    return (on_box || t->coarse) &&
           fabs(off((sl_segment){w->a, w->b}, p)) <= (t->coarse ? 16 : 2) * t->step;
}

/// How much of a wall other walls cover, of which parts have become one with parts of it: sides of
/// cells within steps of doubles of it, from one end on.
static double covered(const trial *t, uint32_t wall) {
    const sl_space *boxed = sli_moving_space(t->moving, NULL);
    const sl_segment w = {boxed->walls[wall].a, boxed->walls[wall].b};
    double sum = 0;
    for (size_t i = 0; i < t->bent.count; i++) {
        const sl_segment s = t->bent.items[i];
        const double dot = (s.b.x - s.a.x) / t->size * ((w.b.x - w.a.x) / t->size) +
                           (s.b.y - s.a.y) / t->size * ((w.b.y - w.a.y) / t->size);
        const bool on = fabs(off(w, s.a)) <= 16 * t->step && fabs(off(w, s.b)) <= 16 * t->step;
        const sl_box b = box_around(w.a, w.b, 16 * t->step);
        if (on && dot > 0 && touch(b, (sl_box){s.a, s.a}) && touch(b, (sl_box){s.b, s.b}))
            sum += hypot(s.b.x - s.a.x, s.b.y - s.a.y);
    }
    return sum;
}

/// The walls: those of the map and sides of boxes, by their numbers; parts of them go from end to
/// end.
static void check_walls(trial *t) {
    const sl_space *boxed = sli_moving_space(t->moving, NULL);
    double *lengths = calloc(boxed->wall_count, sizeof *lengths);
    assert_non_null(lengths);
    gather_segments(t);
    for (uint32_t i = 0; i < t->space.wall_count; i++)
        assert_true(testing_same_point(boxed->walls[i].a, t->space.walls[i].a) &&
                    testing_same_point(boxed->walls[i].b, t->space.walls[i].b));
    for (uint32_t i = 0; i < boxed->cell_count; i++) {
        const sl_cell *cell = &boxed->cells[i];
        const sl_point *v = boxed->vertices + cell->first_vertex;
        for (uint32_t k = 0; k < cell->vertex_count; k++) {
            const uint32_t what = boxed->neighbour[cell->first_vertex + k];
            const uint32_t wall = what & ~SL_NEIGHBOUR_RIGHT;
            const sl_point ends[2] = {v[k], v[(k + 1) % cell->vertex_count]};
            if (what >= SL_NEIGHBOUR_BORDER) continue;
            const sl_wall *w = &boxed->walls[wall];
            for (int e = 0; e < 2; e++) {
                if (testing_same_point(ends[e], w->a) || testing_same_point(ends[e], w->b))
                    continue;
                if (!is_on_wall(t, wall, ends[e])) complain(t, ends[e], ends[e], "off wall", wall);
                t->bends++;
            }
            lengths[wall] += hypot(ends[1].x - ends[0].x, ends[1].y - ends[0].y);
        }
    }
    for (uint32_t i = 0; i < boxed->wall_count; i++) {
        const sl_wall *w = &boxed->walls[i];
        const double length = hypot(w->b.x - w->a.x, w->b.y - w->a.y), slack = 64 * t->step;
        // On the border there are cells on one side only.
        if (fabs(lengths[i] - length) > slack && fabs(lengths[i] - 2 * length) > slack &&
            (!t->coarse || covered(t, i) < length - slack))
            complain(t, w->a, w->b, "gaps in wall", i);
    }
    free(lengths);
}

/// 1 for a point in a region, -1 for one out of it, 0 where that is within rounding.
static int side_of_region(const trial *t, const sl_region *region, sl_point p) {
    const double slack = 1e-9 * t->size;
    int winding = 0;
    for (size_t i = 0; i < region->count; i++) {
        const sl_point a = region->points[i], b = region->points[(i + 1) % region->count];
        const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
        double at = square > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / square : 0;
        at = fmin(fmax(at, 0), 1);
        if (hypot(a.x + at * dx - p.x, a.y + at * dy - p.y) < slack) return 0;
        if (a.y <= p.y && b.y > p.y && cross(a, b, p) > 0) winding++;
        if (a.y > p.y && b.y <= p.y && cross(a, b, p) < 0) winding--;
    }
    return winding ? 1 : -1;
}

/// Whether a point is in a cell, and away from its border by more than borders are bent.
static bool is_deep_in(const trial *t, uint32_t number, sl_point p) {
    if (number == SL_NO_CELL) return false;
    const sl_cell *cell = &t->space.cells[number];
    const sl_point *v = t->space.vertices + cell->first_vertex;
    for (uint32_t i = 0; i < cell->vertex_count; i++)
        if (off((sl_segment){v[i], v[(i + 1) % cell->vertex_count]}, p) < 8 * t->step) return false;
    return true;
}

/// A point that is free is seen, so are its cell and the boxes on the way; one that is hidden is
/// not, and is out of the region.
static void judge_point(trial *t, sl_point eye, sl_point p, const sl_outline *outline,
                        const sl_region *region, const uint64_t *cells, const bool *seen) {
    const uint32_t ground = sl_space_locate(&t->space, p);
    const sl_segment way = {eye, p};
    bool sees[2] = {false, false};
    if (ground == SL_NO_CELL) return;
    assert_ok(t->context, sli_sees(t->context, outline, eye, p, SL_CLOSED, &sees[0]));
    assert_ok(t->context, sli_sees(t->context, outline, eye, p, SL_OPEN, &sees[1]));
    if (is_hidden(&t->straight, eye, p) && is_hidden(&t->bent, eye, p)) {
        if (sees[0] || sees[1]) complain(t, eye, p, "hidden, but seen", 0);
        if (side_of_region(t, region, p) > 0) complain(t, eye, p, "in the region", 0);
        t->hidden++;
        return;
    }
    if (!blockers_free(t->straight.blockers, way) || !blockers_free(t->bent.blockers, way)) return;
    if (!sees[0] || !sees[1]) complain(t, eye, p, "free, but not seen", 0);
    if (is_deep_in(t, ground, p) && !sl_eye_sees(cells, ground))
        complain(t, eye, p, "hidden cell", ground);
    if (side_of_region(t, region, p) < 0) complain(t, eye, p, "out of the region", 0);
    for (size_t i = 0; i < t->count; i++) {
        sl_point c[4];
        corners_of(t->boxes[i].box, c);
        for (int k = 0; k < 4; k++)
            if (blockers_turn(eye, p, c[k]) * blockers_turn(eye, p, c[(k + 1) % 4]) < 0 &&
                blockers_turn(c[k], c[(k + 1) % 4], eye) * blockers_turn(c[k], c[(k + 1) % 4], p) <
                    0 &&
                !seen[i])
                complain(t, eye, p, "hidden box", i);
    }
    t->free++;
}

// --- against brute force

/// What brute force sees in the space with boxes, of which bent walls are taken as they are.
static void ask_oracle(trial *t, const sl_view *view, bool *sees) {
    sl_space space = *sli_moving_space(t->moving, NULL);
    sl_wall walls[SEGMENTS_MOST];
    bool closed[ORACLE_CELLS], open[ORACLE_CELLS];
    gather_segments(t);
    for (size_t i = 0; i < t->bent.count; i++)
        walls[i] = (sl_wall){t->bent.items[i].a, t->bent.items[i].b, 0, 0};
    space.walls = walls;
    space.wall_count = (uint32_t)t->bent.count;
    oracle_eye *oracle = oracle_eye_create(&space, view->eye, NULL, 0);
    oracle_eye_sees(oracle, view, closed, open);
    oracle_eye_destroy(oracle);
    memcpy(sees, t->baked.sight == SL_OPEN ? open : closed, space.cell_count * sizeof *sees);
}

static void judge_cells(trial *t, const sl_view *view, const uint64_t *cells) {
    const uint32_t *parents;
    const sl_space *boxed = sli_moving_space(t->moving, &parents);
    bool sees[ORACLE_CELLS], expected[ORACLE_CELLS] = {false};
    ask_oracle(t, view, sees);
    for (uint32_t c = 0; c < boxed->cell_count; c++) expected[parents[c]] |= sees[c];
    for (uint32_t c = 0; c < t->space.cell_count; c++) {
        if (sl_eye_sees(cells, c) != expected[c])
            complain(t, view->eye, view->eye, expected[c] ? "hidden cell" : "seen cell", c);
        t->cells_seen += expected[c];
        t->cells_asked++;
    }
}

/// Whether brute force has a say on a box: there is something in it, and nothing that blocks, nor
/// the eye, touches it.
static bool can_judge(const trial *t, size_t number, sl_point eye) {
    const sl_box b = t->boxes[number].box, all = t->space.bounds;
    if (b.min.x == b.max.x || b.min.y == b.max.y || b.min.x <= all.min.x || b.min.y <= all.min.y ||
        b.max.x >= all.max.x || b.max.y >= all.max.y)
        return false;
    for (size_t i = 0; i < t->count; i++)
        if (i != number && t->boxes[i].blocks && touch(t->boxes[i].box, b)) return false;
    return !touch(b, (sl_box){eye, eye});
}

/// A box is seen where something in it would be if it did not block.
static void judge_box(trial *t, const sl_view *view, size_t number, bool said) {
    const sl_box box = t->boxes[number].box;
    const bool blocks = t->boxes[number].blocks;
    bool sees[ORACLE_CELLS], expected = false;
    t->boxes[number].blocks = false;
    assert_ok(t->context, sli_moving_set_boxes(t->context, t->moving, t->boxes, t->count));
    const sl_space *boxed = sli_moving_space(t->moving, NULL);
    if (boxed->cell_count <= ORACLE_CELLS) {
        ask_oracle(t, view, sees);
        for (uint32_t c = 0; c < boxed->cell_count; c++) {
            const sl_point *v = boxed->vertices + boxed->cells[c].first_vertex;
            bool within = sees[c];
            for (uint32_t k = 0; k < boxed->cells[c].vertex_count; k++)
                within &= touch(box, (sl_box){v[k], v[k]});
            expected |= within;
        }
        if (said != expected)
            complain(t, view->eye, view->eye, expected ? "hidden box" : "seen box", number);
        t->boxes_seen += expected;
        t->boxes_asked++;
    }
    t->boxes[number].blocks = blocks;
}

// --- eyes

/// Anywhere, near walls, or in special places: corners of cells, and on walls and boxes.
static sl_point random_eye(trial *t) {
    const sl_space *boxed = sli_moving_space(t->moving, NULL);
    const sl_box box = t->boxes[below(t, t->count)].box;
    const sl_wall *wall = &boxed->walls[below(t, boxed->wall_count)];
    switch (below(t, 8)) {
    case 0:
        return boxed->vertices[below(t, boxed->vertex_count)];
    case 1:
        return (sl_point){(wall->a.x + wall->b.x) / 2, (wall->a.y + wall->b.y) / 2};
    case 2:
        return (sl_point){(box.min.x + box.max.x) / 2, below(t, 2) ? box.min.y : box.max.y};
    default:
        return oblique_random_point(&t->random, &t->map, t->space.bounds);
    }
}

static void try_eye(trial *t) {
    uint64_t cells[CELLS_MOST / 64];
    bool seen[BOXES];
    sl_eye_account account;
    const sl_outline *outline;
    sl_region region = {0};
    const sl_point eye = random_eye(t);
    const sl_view view = sl_view_all_round(eye);
    if (sl_space_locate(&t->space, eye) == SL_NO_CELL) return;
    assert_ok(t->context, sli_moving_look(t->context, t->moving, &view, cells, seen, &account));
    assert_ok(t->context, sli_moving_outline(t->context, t->moving, &outline));
    assert_ok(t->context, sli_region_make(t->context, outline, &view, 0, &region));
    gather_segments(t);
    t->straight.blockers = blockers_create(t->straight.items, t->straight.count);
    t->bent.blockers = blockers_create(t->bent.items, t->bent.count);
    for (int i = 0; i < POINTS; i++)
        judge_point(t, eye, oblique_random_point(&t->random, &t->map, t->space.bounds), outline,
                    &region, cells, seen);
    blockers_destroy(t->straight.blockers);
    blockers_destroy(t->bent.blockers);
    sl_region_destroy(t->context, &region);
    if (sli_moving_space(t->moving, NULL)->cell_count > ORACLE_CELLS) return;
    judge_cells(t, &view, cells);
    for (size_t i = 0; i < t->count; i++)
        if (can_judge(t, i, eye)) judge_box(t, &view, i, seen[i]);
    assert_ok(t->context, sli_moving_set_boxes(t->context, t->moving, t->boxes, t->count));
}

// --- random maps

static void try_boxes(trial *t) {
    t->count = 1 + below(t, BOXES);
    for (size_t i = 0; i < t->count; i++)
        t->boxes[i] = (sl_moving_box){random_box(t), below(t, 3) > 0};
    assert_ok(t->context, sli_moving_set_boxes(t->context, t->moving, t->boxes, t->count));
    assert_ok(t->context, sl_space_check(t->context, sli_moving_space(t->moving, NULL)));
    if (t->coarse) return;
    check_walls(t);
    for (int i = 0; i < EYES; i++) try_eye(t);
}

static void bake(trial *t, sl_sight sight) {
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    options.threads = 1;
    options.sight = sight;
    t->baked = (sl_visibility){.sight = sight};
    if (t->seed % 2)
        assert_ok(t->context,
                  testing_method("dfs")->see(t->context, &t->space, &options, &t->baked));
}

static void measure(trial *t) {
    const sl_box b = t->space.bounds;
    const double most =
        fmax(fmax(fabs(b.min.x), fabs(b.min.y)), fmax(fabs(b.max.x), fabs(b.max.y)));
    t->size = fmax(b.max.x - b.min.x, b.max.y - b.min.y);
    t->step = nextafter(most, HUGE_VAL) - most + SL_COORDINATE_MIN; // below it there is 0 alone
}

static void try_map(trial *t, sl_sight sight) {
    t->random = (sl_random){t->seed ^ 0xb0e5};
    assert_ok(t->context, sli_subdivide_mesh(t->context, &t->map, &t->space));
    measure(t);
    assert_true(t->space.cell_count <= CELLS_MOST);
    bake(t, sight);
    assert_ok(t->context, sli_moving_create(t->context, &t->space, &t->baked, &t->moving));
    for (int i = 0; i < 2; i++) try_boxes(t); // placed, and placed anew
    sli_moving_destroy(t->context, t->moving);
    sl_visibility_destroy(t->context, &t->baked);
    sl_space_destroy(t->context, &t->space);
}

static void add_seams(trial *t) {
    for (uint64_t i = t->seed % 3; i > 0; i--) {
        const sl_wall *from = &t->map.walls[below(t, t->map.wall_count)];
        const sl_wall *to = &t->map.walls[below(t, t->map.wall_count)];
        assert_ok(t->context,
                  sl_map_add_seam(t->context, &t->map, (sl_segment){from->a, to->b}, 0));
    }
}

static void turn_map(sl_map *map, double angle) {
    const double c = cos(angle), s = sin(angle);
    for (size_t i = 0; i < map->wall_count; i++) {
        sl_wall *w = &map->walls[i];
        w->a = (sl_point){c * w->a.x - s * w->a.y, s * w->a.x + c * w->a.y};
        w->b = (sl_point){c * w->b.x - s * w->b.y, s * w->b.x + c * w->b.y};
    }
}

/// Oblique walls, clean but for those that are steps of doubles apart: there cleaning leaves
/// little.
static void make_oblique(trial *t) {
    const oblique_grid grid = (oblique_grid)(t->seed % OBLIQUE_GRIDS);
    assert_ok(t->context, oblique_random_map(t->context, t->seed, grid, WALLS, &t->map));
    add_seams(t);
    t->coarse = grid >= OBLIQUE_SCALES;
    if (!t->coarse) assert_ok(t->context, sl_map_clean(t->context, &t->map, NULL, NULL));
}

static void make_turned(trial *t) {
    assert_ok(t->context, oracle_random_map(t->context, t->seed, ORACLE_GRID_INTEGER, &t->map));
    turn_map(&t->map, 0.302);
    t->coarse = false;
    assert_ok(t->context, sl_map_clean(t->context, &t->map, NULL, NULL));
}

/// Boxes behind one of these walls used to be said to be seen.
static void make_fault(trial *t) {
    static const sl_wall walls[] = {
        {{-1.7842492444667157, 5.7285647970167846},
         {-3.5684984889334315, 11.457129594033569},
         0,
         0},
        {{2.1600663080833531, 13.241378838500285}, {0.3758170636166378, 18.969943635517069}, 0, 0},
        {{-5.6501226074779334, 18.140455190553151},
         {0.078442189538851181, 19.924704435019866},
         0,
         0},
        {{0.61055576042498316, 14.853525563428095},
         {-1.6588769899278365, 12.051879342189141},
         0,
         0}};
    for (size_t i = 0; i < sizeof walls / sizeof *walls; i++)
        assert_ok(t->context,
                  sl_map_add_wall(t->context, &t->map, walls[i].a, walls[i].b, (uint32_t)i + 1));
    t->coarse = false;
    assert_ok(t->context, sl_map_clean(t->context, &t->map, NULL, NULL));
}

static void random_maps(sl_sight sight, void (*make)(trial *t), uint64_t seeds) {
    trial t = {.context = testing_context(NULL)};
    for (t.seed = 1; t.seed <= seeds; t.seed++) {
        t.random = (sl_random){t.seed ^ 0x5ea};
        make(&t);
        if (t.map.wall_count) try_map(&t, sight);
        sl_map_destroy(t.context, &t.map);
    }
    print_message(
        "%zu points free, %zu hidden; %zu of %zu cells, %zu of %zu boxes seen; %zu bends\n", t.free,
        t.hidden, t.cells_seen, t.cells_asked, t.boxes_seen, t.boxes_asked, t.bends);
    assert_true(t.free > seeds && t.hidden > seeds && t.bends > seeds);
    assert_true(t.cells_seen > 0 && t.cells_seen < t.cells_asked);
    assert_true(t.boxes_seen > 0 && t.boxes_seen < t.boxes_asked);
    sl_context_destroy(t.context);
}

static void closed_sight(void **state) {
    (void)state;
    random_maps(SL_CLOSED, make_oblique, testing_seeds(50));
}

static void open_sight(void **state) {
    (void)state;
    random_maps(SL_OPEN, make_oblique, testing_seeds(50));
}

static void turned_maps(void **state) {
    (void)state;
    random_maps(SL_CLOSED, make_turned, testing_seeds(20));
    random_maps(SL_OPEN, make_turned, testing_seeds(20));
}

static void map_that_failed(void **state) {
    (void)state;
    random_maps(SL_CLOSED, make_fault, testing_seeds(15));
    random_maps(SL_OPEN, make_fault, testing_seeds(15));
}

/// Dozens of walls that cross each other within steps of doubles, and boxes among them: bent lines
/// come into cells that no box touches. The space holds together all the same.
static void crowds(void **state) {
    (void)state;
    const uint64_t seeds = testing_seeds(20);
    trial t = {.context = testing_context(NULL)};
    size_t placed = 0;
    for (t.seed = 1; t.seed <= seeds; t.seed++) {
        const oblique_grid grid = (oblique_grid)(t.seed % OBLIQUE_GRIDS);
        t.random = (sl_random){t.seed ^ 0xc0d};
        t.coarse = true;
        assert_ok(t.context, oblique_random_map(t.context, t.seed, grid, 6 * WALLS, &t.map));
        const sl_status status = sli_subdivide_mesh(t.context, &t.map, &t.space);
        assert_true(status == SL_OK || status == SL_UNSUPPORTED); // for lack of a tolerance
        measure(&t);
        if (status == SL_OK)
            assert_ok(t.context, sli_moving_create(t.context, &t.space, &t.baked, &t.moving));
        for (int k = 0; k < 4 && status == SL_OK; k++) {
            t.count = 4 * BOXES;
            for (size_t i = 0; i < t.count; i++)
                t.boxes[i] = (sl_moving_box){random_box(&t), below(&t, 3) > 0};
            assert_ok(t.context, sli_moving_set_boxes(t.context, t.moving, t.boxes, t.count));
            assert_ok(t.context, sl_space_check(t.context, sli_moving_space(t.moving, NULL)));
            if (grid < OBLIQUE_SCALES) check_walls(&t);
            placed++;
        }
        if (status == SL_OK) sli_moving_destroy(t.context, t.moving);
        sl_space_destroy(t.context, &t.space);
        sl_map_destroy(t.context, &t.map);
    }
    assert_true(placed > 3 * seeds);
    sl_context_destroy(t.context);
}

/// Whether a point is strictly within a cell.
static bool is_in(const sl_space *space, uint32_t number, sl_point p) {
    const sl_cell *cell = &space->cells[number];
    const sl_point *v = space->vertices + cell->first_vertex;
    for (uint32_t i = 0; i < cell->vertex_count; i++)
        if (blockers_turn(v[i], v[(i + 1) % cell->vertex_count], p) <= 0) return false;
    return true;
}

static bool has_share(const sli_boxed_space *boxed, uint32_t cell, uint32_t ground) {
    if (boxed->parents[cell] == ground) return true;
    for (uint32_t i = boxed->first_share[cell]; i < boxed->first_share[cell + 1]; i++)
        if (boxed->shares[i] == ground) return true;
    return false;
}

/// A cell with a corner in a cell of the ground knows that it reaches into that.
static void check_shares(trial *t, const sli_boxed_space *boxed) {
    const sl_space *s = &boxed->space;
    for (uint32_t c = 0; c < s->cell_count; c++)
        for (uint32_t g = 0; g < t->space.cell_count; g++) {
            const sl_point *v = s->vertices + s->cells[c].first_vertex;
            for (uint32_t i = 0; i < s->cells[c].vertex_count; i++)
                if (is_in(&t->space, g, v[i]) && !has_share(boxed, c, g))
                    complain(t, v[i], v[i], "unknown to its cell: cell", g);
        }
}

static void shares(void **state) {
    (void)state;
    trial t = {.context = testing_context(NULL)};
    size_t found = 0;
    for (t.seed = 1; t.seed <= testing_seeds(20); t.seed++) {
        sli_box_ground ground = {0};
        sli_boxed_space boxed = {0};
        t.random = (sl_random){t.seed ^ 0x5a};
        make_turned(&t);
        assert_ok(t.context, sli_subdivide_mesh(t.context, &t.map, &t.space));
        assert_ok(t.context, sli_box_ground_create(t.context, &t.space, &ground));
        for (int i = 0; i < BOXES; i++) t.boxes[i] = (sl_moving_box){random_box(&t), i % 2};
        assert_ok(t.context, sli_boxes_put(t.context, &ground, t.boxes, BOXES, &boxed));
        check_shares(&t, &boxed);
        found += boxed.first_share[boxed.space.cell_count];
        sli_boxed_space_destroy(t.context, &boxed);
        sli_box_ground_destroy(t.context, &ground);
        sl_space_destroy(t.context, &t.space);
        sl_map_destroy(t.context, &t.map);
    }
    assert_true(found > 60);
    sl_context_destroy(t.context);
}

// --- by hand

typedef struct room {
    sl_context *context;
    sl_map map;
    sl_space space;
    sl_visibility bare;
    sli_moving *moving;
} room;

/// A square of 8 with a wall askew and a seam that goes on from it.
static void enter(room *r, testing_memory *memory) {
    *r = (room){.context = testing_context(memory), .bare = {.sight = SL_CLOSED}};
    const sl_point c[5] = {{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}};
    for (int i = 0; i < 4; i++)
        assert_ok(r->context, sl_map_add_wall(r->context, &r->map, c[i], c[i + 1], 0));
    assert_ok(r->context,
              sl_map_add_wall(r->context, &r->map, (sl_point){0, 0}, (sl_point){4, 4}, 0));
    assert_ok(r->context, sl_map_add_seam(r->context, &r->map, (sl_segment){{4, 4}, {8, 8}}, 0));
    assert_ok(r->context, sli_subdivide_mesh(r->context, &r->map, &r->space));
}

static void leave(room *r) {
    sli_moving_destroy(r->context, r->moving);
    sl_space_destroy(r->context, &r->space);
    sl_map_destroy(r->context, &r->map);
    sl_context_destroy(r->context);
}

static void cells_keep_their_numbers(void **state) {
    (void)state;
    room r;
    enter(&r, NULL);
    const uint32_t *parents;
    const sl_moving_box boxes[] = {{{{1, 2}, {3, 5}}, true}};
    assert_ok(r.context, sli_moving_create(r.context, &r.space, &r.bare, &r.moving));
    assert_ok(r.context, sli_moving_set_boxes(r.context, r.moving, boxes, 1));
    const sl_space *boxed = sli_moving_space(r.moving, &parents);
    assert_true(boxed->cell_count > r.space.cell_count);
    for (uint32_t i = 0; i < r.space.cell_count; i++) assert_int_equal(parents[i], i);
    for (double x = 0.25; x < 8; x += 0.5)
        for (double y = 0.125; y < 8; y += 0.5)
            assert_int_equal(parents[sl_space_locate(boxed, (sl_point){x, y})],
                             sl_space_locate(&r.space, (sl_point){x, y}));
    leave(&r);
}

static void no_memory(void **state) {
    (void)state;
    testing_memory memory = {0};
    room r;
    enter(&r, &memory);
    const sl_moving_box boxes[] = {{{{1, 2}, {5, 6}}, true}, {{{3, 2}, {4, 7}}, false}};
    const long before = memory.live;
    sl_status status = SL_NO_MEMORY;
    for (long fail = 1; status != SL_OK; fail++) {
        sli_moving *moving = NULL;
        memory.calls = 0;
        memory.fail_at = fail;
        status = sli_moving_create(r.context, &r.space, &r.bare, &moving);
        if (status == SL_OK) status = sli_moving_set_boxes(r.context, moving, boxes, 2);
        assert_true(status == SL_OK || status == SL_NO_MEMORY);
        memory.fail_at = 0;
        sli_moving_destroy(r.context, moving);
        assert_int_equal(memory.live, before);
    }
    leave(&r);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cells_keep_their_numbers),
        cmocka_unit_test(no_memory),
        cmocka_unit_test(closed_sight),
        cmocka_unit_test(open_sight),
        cmocka_unit_test(turned_maps),
        cmocka_unit_test(map_that_failed),
        cmocka_unit_test(crowds),
        cmocka_unit_test(shares),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

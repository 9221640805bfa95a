/// Doors at a loss, and how far cells are: by hand, on random maps against ways through all sets of
/// doors, and cell by cell against single ways.
#include "testing.h"

#include "oracle/random_effects.h"
#include "route_plan.h"

#include <math.h>

static void set_losses(plan *p, const double *losses, size_t count) {
    assert_ok(p->context, sl_route_finder_set_losses(p->context, p->finder, losses, count));
}

static sl_route_near *distances(plan *p, sl_point from, double limit) {
    sl_route_near *cells = calloc(p->space.cell_count, sizeof *cells);
    assert_non_null(cells);
    assert_ok(p->context, sl_route_distances(p->context, p->finder, from, limit, cells));
    return cells;
}

// --- by hand

static const char two_rooms[] =
    "sightline 1\nwall 0 0 10 0\nwall 10 0 10 10\nwall 10 10 0 10\nwall 0 10 0 0\n"
    "wall 5 0 5 4\nwall 5 6 5 9\ndoor front 5 4 5 6 open\n";

/// Straight through the door at a loss, or around by the gap at the top.
static void test_loss_or_detour(void **state) {
    (void)state;
    plan p;
    read_plan(&p, two_rooms);
    const double around = 2 * hypot(4, 4), loss[] = {around - 8.125, around - 7.875, 0};
    set_losses(&p, &loss[0], 1);
    assert_true(way(&p, 1, 5, 9, 5) == 8 + loss[0] && p.route.count == 2);
    set_losses(&p, &loss[1], 1);
    assert_true(fabs(way(&p, 1, 5, 9, 5) - around) < 1e-14 && p.route.count == 3);
    set_losses(&p, &loss[2], 1);
    assert_true(way(&p, 1, 5, 9, 5) == 8);
    set_losses(&p, NULL, 0);
    assert_true(way(&p, 1, 5, 9, 5) == 8);
    close_plan(&p);
}

/// A corner of the door is near on one side, and by the loss farther on the other.
static void test_sides_of_a_door(void **state) {
    (void)state;
    plan p;
    read_plan(&p, two_rooms);
    const double loss = 1;
    set_losses(&p, &loss, 1);
    assert_true(way(&p, 1, 1, 9, 1) == 10 + loss); // by 5,4, two triangles of 3, 4, 5
    assert_true(way(&p, 2, 4, 5, 2) > 3 + 1e-9);   // a point on a wall stands on one side
    const double here = way(&p, 4, 5, 5, 5), there = way(&p, 6, 5, 5, 5);
    assert_true(fmin(here, there) == 1 && fmax(here, there) == 1 + loss);
    const double out = way(&p, 5, 5, 4, 5), over = way(&p, 5, 5, 6, 5);
    assert_true(out == here && over == there);
    close_plan(&p);
}

/// Doors around a point: nothing is found by turning around it again and again.
static void test_start_where_doors_meet(void **state) {
    (void)state;
    plan p;
    read_plan(&p, "sightline 1\nwall 0 0 10 0\nwall 10 0 10 10\nwall 10 10 0 10\nwall 0 10 0 0\n"
                  "wall 8 0 8 10\ndoor n 5 5 5 8 open\ndoor e 5 5 7 5 open\n"
                  "door s 5 5 5 2 open\n");
    const double losses[] = {1, 1, 1};
    set_losses(&p, losses, 3);
    assert_true(isinf(way(&p, 5, 5, 9, 5)));
    const double ways[] = {way(&p, 5, 5, 6, 6), way(&p, 5, 5, 6, 4), way(&p, 5, 5, 4, 5)};
    for (int i = 0; i < 3; i++) {
        const double straight = i < 2 ? hypot(1, 1) : 1, over = ways[i] - straight;
        assert_true(over == 0 || fabs(over - 1) < 1e-14);
    }
    free(distances(&p, (sl_point){5, 5}, INFINITY));
    close_plan(&p);
}

/// A door that stands free is passed around its end where that costs less.
static void test_free_door(void **state) {
    (void)state;
    plan p;
    read_plan(&p, "sightline 1\nwall 0 0 10 0\nwall 10 0 10 10\nwall 10 10 0 10\nwall 0 10 0 0\n"
                  "door lone 5 2 5 6 open\n");
    const double loss = 3, half = 1.5;
    set_losses(&p, &loss, 1);
    assert_true(way(&p, 2, 2, 8, 2) == 6); // through its end
    assert_true(fabs(way(&p, 2, 4, 8, 4) - 2 * hypot(3, 2)) < 1e-14);
    set_losses(&p, &half, 1);
    assert_true(way(&p, 2, 4, 8, 4) > 7 && way(&p, 2, 4, 8, 4) < 6 + half);
    const double small = 0.25;
    set_losses(&p, &small, 1);
    assert_true(way(&p, 2, 4, 8, 4) == 6 + small);
    close_plan(&p);
}

static void test_within_a_range(void **state) {
    (void)state;
    plan p;
    read_plan(&p, two_rooms);
    const double loss = 20;
    set_losses(&p, &loss, 1);
    const sl_point from = {1, 5};
    sl_route_near *all = distances(&p, from, INFINITY), *few = distances(&p, from, 5);
    size_t fewer = 0;
    for (uint32_t c = 0; c < p.space.cell_count; c++) {
        assert_true(isfinite(all[c].distance));
        assert_true(all[c].distance <= 5 ? few[c].distance == all[c].distance
                                         : isinf(few[c].distance));
        fewer += isinf(few[c].distance);
    }
    const uint32_t over = sl_space_locate(&p.space, (sl_point){9, 5});
    assert_true(all[over].distance < 20 && all[over].distance > hypot(4, 4) - 1e-14);
    assert_true(fewer > 0 && all[sl_space_locate(&p.space, from)].distance == 0);
    free(all);
    free(few);
    close_plan(&p);
}

static void test_refusals(void **state) {
    (void)state;
    plan p;
    read_plan(&p, two_rooms);
    sl_route_near cells[64];
    const double wrong[] = {-1, NAN, INFINITY};
    const sl_point in = {1, 1}, outside[] = {{11, 1}, {NAN, 1}};
    const double loss = 2;
    set_losses(&p, &loss, 1);
    for (size_t i = 0; i < 3; i++)
        assert_int_equal(sl_route_finder_set_losses(p.context, p.finder, &wrong[i], 1),
                         SL_BAD_ARGUMENT);
    assert_true(way(&p, 1, 5, 9, 5) == 10); // as before
    for (size_t i = 0; i < 2; i++) {
        assert_int_equal(sl_route_distances(p.context, p.finder, in, wrong[i], cells),
                         SL_BAD_ARGUMENT);
        assert_int_equal(sl_route_distances(p.context, p.finder, outside[i], 1, cells),
                         SL_BAD_ARGUMENT);
    }
    close_plan(&p);
}

static void test_memory(void **state) {
    (void)state;
    for (long fail_at = 1, done = 0; !done; fail_at++) {
        testing_memory memory = {0};
        plan p = {.context = testing_context(&memory)};
        assert_ok(p.context,
                  sl_map_parse(p.context, "test.map", two_rooms, strlen(two_rooms), NULL, &p.map));
        assert_ok(p.context, sl_map_clean(p.context, &p.map, NULL, NULL));
        open_plan(&p);
        sl_route_near cells[64];
        const double loss = 2;
        memory.calls = 0;
        memory.fail_at = fail_at;
        sl_status status = sl_route_finder_set_losses(p.context, p.finder, &loss, 1);
        if (status == SL_OK)
            status = sl_route_distances(p.context, p.finder, (sl_point){1, 1}, INFINITY, cells);
        done = status == SL_OK;
        if (!done) assert_int_equal(status, SL_NO_MEMORY);
        memory.fail_at = 0;
        close_plan(&p);
        assert_int_equal(memory.live, 0);
    }
}

// --- ways past doors at a loss, against ways through all sets of doors

enum { PIECES_MOST = 7 };

/// A part of doors that no wall and no other door touches inside: passed at most once.
typedef struct piece {
    sl_segment at;
    double loss;
} piece;

static bool holds(sl_segment s, sl_point p) {
    return sli_orient(s.a, s.b, p) == 0 && p.x >= fmin(s.a.x, s.b.x) && p.x <= fmax(s.a.x, s.b.x) &&
           p.y >= fmin(s.a.y, s.b.y) && p.y <= fmax(s.a.y, s.b.y);
}

static bool is_wall(const barrier *b, sl_point p) {
    for (size_t i = 0; i < b->count; i++)
        if (holds(b->walls[i], p)) return true;
    return false;
}

/// Whether anything but one door is at a place; the losses of the doors there.
static bool is_crowded(const plan *p, const barrier *b, size_t door, sl_point at,
                       const double *losses, double *loss) {
    bool crowded = is_wall(b, at);
    *loss = losses[door];
    for (size_t i = 0; i < p->map.door_count; i++)
        if (i != door && losses[i] > 0 && holds(p->map.doors[i].segment, at)) {
            crowded = true;
            *loss += losses[i];
        }
    return crowded;
}

/// The pieces of the doors of a map on a grid of whole numbers: their unit steps, joined where
/// nothing else is between. Of doors on each other the first one stands for all. PIECES_MOST + 1
/// for too many.
static size_t find_pieces(const plan *p, const barrier *b, const double *losses, piece *pieces) {
    size_t count = 0;
    for (size_t d = 0; d < p->map.door_count; d++) {
        const sl_segment at = p->map.doors[d].segment;
        const double steps = fmax(fabs(at.b.x - at.a.x), fabs(at.b.y - at.a.y));
        const sl_point step = {(at.b.x - at.a.x) / steps, (at.b.y - at.a.y) / steps};
        bool joins = false;
        for (int i = 0; losses[d] > 0 && i < (int)steps; i++) {
            const sl_point from = {at.a.x + i * step.x, at.a.y + i * step.y},
                           middle = {from.x + step.x / 2, from.y + step.y / 2},
                           to = {from.x + step.x, from.y + step.y};
            double loss, ignored;
            bool taken = is_wall(b, middle);
            for (size_t k = 0; k < d; k++)
                taken |= losses[k] > 0 && holds(p->map.doors[k].segment, middle);
            is_crowded(p, b, d, middle, losses, &loss);
            if (!taken && joins)
                pieces[count - 1].at.b = to;
            else if (!taken && count == PIECES_MOST)
                return PIECES_MOST + 1;
            else if (!taken)
                pieces[count++] = (piece){{from, to}, loss};
            joins = !taken && !is_crowded(p, b, d, to, losses, &ignored);
        }
    }
    return count;
}

/// The least over all sets of pieces that are passed, the others being walls.
static double by_sets(const barrier *b, const piece *pieces, size_t count, walk_end from,
                      walk_end to) {
    static barrier with;
    double least = INFINITY;
    for (unsigned set = 0; set < 1u << count; set++) {
        double loss = 0;
        with = *b;
        for (size_t i = 0; i < count; i++)
            if (set >> i & 1)
                loss += pieces[i].loss;
            else
                add_wall(&with, pieces[i].at.a, pieces[i].at.b);
        least = fmin(least, loss + oracle_walk(with.walls, with.count, from, to));
    }
    return least;
}

/// The number of ways that were compared.
static int check_losses(plan *p, uint64_t seed) {
    static barrier b;
    static const double choice[] = {0, 0.5, 1, 3};
    sl_random random = {seed};
    piece pieces[PIECES_MOST];
    double losses[3];
    int compared = 0;
    open_plan(p);
    assert_int_equal(p->map.door_count, 3);
    for (int i = 0; i < 3; i++) losses[i] = choice[sl_random_below(&random, 4)];
    sl_query_set_doors(p->context, p->query, true);
    set_losses(p, losses, 3);
    find_barrier(p, &b);
    const size_t count = find_pieces(p, &b, losses, pieces);
    for (int i = 0; i < 6 && count <= PIECES_MOST && b.count <= ORACLE_WALLS; i++) {
        const sl_point from = random_place(&random, p), to = random_place(&random, p);
        const walk_end start = stand(p, from), goal = stand(p, to);
        if (!is_clear(p, start) || !is_clear(p, goal)) continue;
        const double length = way(p, from.x, from.y, to.x, to.y),
                     expected = by_sets(&b, pieces, count, start, goal);
        if (isinf(length) != isinf(expected) ||
            (!isinf(length) && fabs(length - expected) > 1e-12 * expected))
            fail_msg("seed %llu: from %.17g,%.17g to %.17g,%.17g: %.17g, expected %.17g",
                     (unsigned long long)seed, from.x, from.y, to.x, to.y, length, expected);
        compared += count > 0 && isfinite(expected);
    }
    close_plan(p);
    return compared;
}

static void test_random_losses(void **state) {
    (void)state;
    uint64_t compared = 0;
    for (uint64_t seed = 0, count = testing_seeds(300); seed < count; seed++) {
        plan p = {.context = testing_context(NULL)};
        sl_random random = {seed};
        random_effects_map(p.context, &random, SL_EFFECT_DOOR, 1, &p.map);
        compared += (uint64_t)check_losses(&p, seed);
    }
    assert_true(compared > testing_seeds(300));
}

// --- distances of cells, against single ways

static sl_point toward(sl_point a, sl_point b, double share) {
    return (sl_point){a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
}

/// No place of a cell is nearer than its distance, and beside its nearest point is one that is not
/// farther than that and the step to it.
static void check_cell(plan *p, sl_random *random, sl_point from, uint32_t c,
                       const sl_route_near *near, uint64_t seed) {
    const sl_cell *cell = &p->space.cells[c];
    const sl_box *b = &p->space.bounds;
    const double slack =
        1e-12 * (fmax(fabs(b->max.x), fabs(b->min.x)) + fmax(fabs(b->max.y), fabs(b->min.y)));
    const sl_point middle = sl_space_middle(&p->space, c);
    for (uint32_t k = 0; k < cell->vertex_count; k++) {
        const sl_point vertex = p->space.vertices[cell->first_vertex + k],
                       at = toward(vertex, middle, sl_random_unit(random));
        if (sl_space_locate(&p->space, at) != c) continue;
        const double length = way(p, from.x, from.y, at.x, at.y);
        if (isinf(length) != isinf(near->distance) || length < near->distance - slack)
            fail_msg("seed %llu: from %.17g,%.17g: cell %u is at %.17g, but %.17g,%.17g at %.17g",
                     (unsigned long long)seed, from.x, from.y, c, near->distance, at.x, at.y,
                     length);
    }
    const sl_point in = toward(near->at, middle, 0x1p-16);
    if (isinf(near->distance) || sl_space_locate(&p->space, in) != c) return;
    const double length = way(p, from.x, from.y, in.x, in.y),
                 most = near->distance + hypot(in.x - near->at.x, in.y - near->at.y);
    if (length > most + slack)
        fail_msg("seed %llu: from %.17g,%.17g: cell %u is at %.17g, but its %.17g,%.17g at %.17g",
                 (unsigned long long)seed, from.x, from.y, c, near->distance, in.x, in.y, length);
}

static void check_distances(plan *p, uint64_t seed) {
    sl_random random = {seed};
    double losses[8];
    open_plan(p);
    for (int i = 0; i < 8; i++) losses[i] = (double)sl_random_below(&random, 4) / 2;
    sl_query_set_doors(p->context, p->query, true);
    if (p->map.door_count && seed % 4) set_losses(p, losses, 8);
    for (int i = 0; i < 2; i++) {
        const sl_point from = random_place(&random, p);
        const uint32_t at = sl_space_locate(&p->space, from);
        if (at == SL_NO_CELL || p->space.cells[at].solid) continue;
        sl_route_near *cells = distances(p, from, INFINITY);
        assert_true(cells[at].distance == 0);
        for (uint32_t c = 0; c < p->space.cell_count; c++)
            if (!p->space.cells[c].solid) check_cell(p, &random, from, c, &cells[c], seed);
        free(cells);
    }
    close_plan(p);
}

static void test_distances_axial(void **state) {
    (void)state;
    each_axial_plan(testing_seeds(100), check_distances);
}

static void test_distances_turned(void **state) {
    (void)state;
    each_turned_plan(testing_seeds(100), check_distances);
}

static void test_distances_oblique(void **state) {
    (void)state;
    each_oblique_plan(testing_seeds(200), check_distances);
}

static void test_distances_with_losses(void **state) {
    (void)state;
    for (uint64_t seed = 0, count = testing_seeds(200); seed < count; seed++) {
        plan p = {.context = testing_context(NULL)};
        sl_random random = {seed};
        random_effects_map(p.context, &random, SL_EFFECT_DOOR | SL_EFFECT_ONEWAY, 1, &p.map);
        check_distances(&p, seed);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_loss_or_detour),
        cmocka_unit_test(test_sides_of_a_door),
        cmocka_unit_test(test_start_where_doors_meet),
        cmocka_unit_test(test_free_door),
        cmocka_unit_test(test_within_a_range),
        cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_memory),
        cmocka_unit_test(test_random_losses),
        cmocka_unit_test(test_distances_axial),
        cmocka_unit_test(test_distances_turned),
        cmocka_unit_test(test_distances_oblique),
        cmocka_unit_test(test_distances_with_losses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

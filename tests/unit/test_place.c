// Placement against known optima, against points drawn at random, and against itself: turned,
// mirrored and scaled plans need as many viewpoints.
#include "testing.h"

#include "sightline/generate.h"
#include "sightline/place.h"
#include "sightline/place_proof.h"
#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>

/// A plan, and how to ask about it.
typedef struct plan {
    testing_memory memory;
    sl_context *context;
    sl_map map;
    sl_space space;
    sl_query *query;
} plan;

static void begin(plan *p) {
    *p = (plan){0};
    p->context = testing_context(&p->memory);
}

static void ready(plan *p) {
    testing_subdivide(p->context, &p->map, &p->space);
    assert_ok(p->context, sl_query_over(p->context, &p->space, &p->map, NULL, &p->query));
}

static void end(plan *p) {
    sl_query_destroy(p->context, p->query);
    sl_space_destroy(p->context, &p->space);
    sl_map_destroy(p->context, &p->map);
    sl_context_destroy(p->context);
    assert_int_equal(p->memory.live, 0);
}

static void place(plan *p, sl_placement *out) {
    assert_ok(p->context, sl_place(p->context, p->query, NULL, out));
}

// --- checks of a result

static bool is_seen(plan *p, const sl_placement *placed, sl_point at) {
    bool sees = false;
    for (uint32_t i = 0; i < placed->count && !sees; i++)
        assert_ok(p->context,
                  sl_query_sees(p->context, p->query, placed->viewpoints[i].at, at, &sees));
    return sees;
}

static sl_point draw_point(const sl_space *space, sl_random *random) {
    const sl_box *b = &space->bounds;
    if (sl_random_below(random, 2))
        return (sl_point){b->min.x + sl_random_unit(random) * (b->max.x - b->min.x),
                          b->min.y + sl_random_unit(random) * (b->max.y - b->min.y)};
    // Beside a corner.
    const sl_wall *wall = &space->walls[sl_random_below(random, space->wall_count)];
    const double angle = 7 * sl_random_unit(random);
    const double length = ldexp(b->max.x - b->min.x, -2 - (int)sl_random_below(random, 40));
    return (sl_point){wall->a.x + length * cos(angle), wall->a.y + length * sin(angle)};
}

static void check_all_seen(plan *p, const sl_placement *placed, int points) {
    sl_random random = {11};
    for (int i = 0; i < points; i++) {
        const sl_point at = draw_point(&p->space, &random);
        if (sl_space_is_inside(&p->space, at) && !is_seen(p, placed, at))
            fail_msg("(%.17g, %.17g) is not seen", at.x, at.y);
    }
}

/// Whether some column has all of these witnesses.
static bool is_in_a_column(const sl_cover_problem *columns, const bool *wanted) {
    for (uint32_t c = 0; c < columns->column_count; c++) {
        uint32_t missing = 0;
        for (uint32_t w = 0; w < columns->row_count; w++) missing += wanted[w];
        for (size_t i = c ? columns->ends[c - 1] : 0; i < columns->ends[c]; i++)
            missing -= wanted[columns->entries[i]];
        if (!missing) return true;
    }
    return false;
}

/// No place sees a set of witnesses that no column has; and the proof proves the bound.
static void check_lower(plan *p, const sl_placement *placed, int points) {
    sl_random random = {12};
    bool *seen = calloc(placed->witness_count, sizeof *seen);
    uint64_t proven;
    assert_non_null(seen);
    assert_ok(p->context, sl_cover_check(p->context, &placed->columns, &placed->proof, &proven));
    assert_int_equal(proven, placed->lower);
    for (int i = 0; i < points; i++) {
        const sl_point at = draw_point(&p->space, &random);
        if (!sl_space_is_inside(&p->space, at)) continue;
        for (uint32_t w = 0; w < placed->witness_count; w++)
            assert_ok(p->context,
                      sl_query_sees(p->context, p->query, at, placed->witnesses[w].at, &seen[w]));
        if (!is_in_a_column(&placed->columns, seen))
            fail_msg("what (%.17g, %.17g) sees is in no column", at.x, at.y);
    }
    free(seen);
}

static void check(plan *p, const sl_placement *placed, int points) {
    assert_true(placed->lower >= 1);
    assert_true(placed->lower <= placed->upper);
    assert_int_equal(placed->upper, placed->count);
    check_all_seen(p, placed, points);
    check_lower(p, placed, points / 10);
}

/// The optimum of a polygon, checked.
static uint64_t optimum_of(const sl_point *corners, size_t count, double turn) {
    plan p;
    sl_placement placed = {0};
    sl_point *turned = malloc(count * sizeof *turned);
    assert_non_null(turned);
    for (size_t i = 0; i < count; i++)
        turned[i] = turn == 0 ? corners[i]
                              : (sl_point){cos(turn) * corners[i].x - sin(turn) * corners[i].y,
                                           sin(turn) * corners[i].x + cos(turn) * corners[i].y};
    begin(&p);
    assert_ok(p.context, sl_map_add_open(p.context, &p.map, turned, count, 0));
    ready(&p);
    place(&p, &placed);
    check(&p, &placed, 3000);
    assert_int_equal(placed.lower, placed.upper);
    const uint64_t optimum = placed.upper;
    sl_placement_destroy(p.context, &placed);
    end(&p);
    free(turned);
    return optimum;
}

// --- known optima

/// A comb with pointed teeth. Each tip is seen from its tooth alone (Chvatal 1975).
static void known_combs(void **state) {
    (void)state;
    for (int teeth = 2; teeth <= 7; teeth++) {
        sl_point corners[32];
        size_t count = 0;
        corners[count++] = (sl_point){0, -1};
        corners[count++] = (sl_point){4 * teeth, -1};
        for (int i = teeth - 1; i >= 0; i--) {
            corners[count++] = (sl_point){4 * i + 3, 0};
            corners[count++] = (sl_point){4 * i + 2, 40};
            corners[count++] = (sl_point){4 * i + 1, 0};
        }
        assert_int_equal(optimum_of(corners, count, 0), teeth);
        assert_int_equal(optimum_of(corners, count, 0.3), teeth);
    }
}

/// An orthogonal comb: 4 corners a tooth (Kahn, Klawe and Kleitman 1983).
static void known_orthogonal_combs(void **state) {
    (void)state;
    for (int teeth = 2; teeth <= 7; teeth++) {
        sl_point corners[64];
        size_t count = 0;
        corners[count++] = (sl_point){0, -1};
        corners[count++] = (sl_point){4 * teeth - 2, -1};
        for (int i = teeth - 1; i >= 0; i--) {
            corners[count++] = (sl_point){4 * i + 2, 9};
            corners[count++] = (sl_point){4 * i, 9};
            if (i) corners[count++] = (sl_point){4 * i, 0};
            if (i) corners[count++] = (sl_point){4 * i - 2, 0};
        }
        assert_int_equal(count, 4 * (size_t)teeth);
        assert_int_equal(optimum_of(corners, count, 0), teeth);
        assert_int_equal(optimum_of(corners, count, 0.302), teeth);
    }
}

static void one_suffices(void **state) {
    (void)state;
    sl_point corners[40];
    for (int spikes = 3; spikes <= 20; spikes++) {
        for (int i = 0; i < 2 * spikes; i++) {
            const double angle = 3.14159265358979 * i / spikes, r = i % 2 ? 1 : 10;
            corners[i] = (sl_point){r * cos(angle), r * sin(angle)};
        }
        assert_int_equal(optimum_of(corners, (size_t)(2 * spikes), 0), 1); // star-shaped
        for (int i = 0; i < spikes; i++) corners[i] = corners[2 * i];
        assert_int_equal(optimum_of(corners, (size_t)spikes, 0), 1); // convex
    }
}

// --- plans with holes, thin walls and several rooms

static void solve_text(const char *text, uint64_t optimum) {
    plan p;
    sl_placement placed = {0};
    begin(&p);
    testing_space(p.context, text, &p.map, &p.space);
    assert_ok(p.context, sl_query_over(p.context, &p.space, &p.map, NULL, &p.query));
    place(&p, &placed);
    check(&p, &placed, 5000);
    assert_int_equal(placed.lower, optimum);
    assert_int_equal(placed.upper, optimum);
    sl_placement_destroy(p.context, &placed);
    end(&p);
}

#define ROOM "wall 0 0 10 0\nwall 10 0 10 10\nwall 10 10 0 10\nwall 0 10 0 0\n"

static void other_plans(void **state) {
    (void)state;
    solve_text(ROOM, 1);
    solve_text(ROOM "wall 5 0 5 6\n", 1);                // a thin wall, seen past its end
    solve_text(ROOM "wall 5 0 5 10\n", 2);               // two rooms
    solve_text(ROOM "wall 5 0 5 4\nwall 5 6 5 10\n", 1); // and an opening: from within it
    solve_text(ROOM "wall 5 0 5 4\nwall 5 6 5 10\ndoor a 5 4 5 6 shut\n", 2);
    solve_text(ROOM "solid 4 4 6 4 6 6 4 6\n", 2); // around a pillar
    solve_text(ROOM "wall 2 2 8 2\nwall 8 2 8 8\nwall 8 8 2 8\nwall 2 8 2 2\nstart 1 1 0\n", 2);
}

/// Two rooms, and a door in a thin wall between them, turned: a viewpoint in it is not in line with
/// both parts of the wall, and what it does not see is thinner than doubles tell.
static void door_in_thin_wall(void **state) {
    (void)state;
    static const sl_segment walls[] = {
        {{0, 0}, {10, 0}}, {{10, 0}, {10, 10}}, {{10, 10}, {0, 10}},
        {{0, 10}, {0, 0}}, {{5, 0}, {5, 4}},    {{5, 6}, {5, 10}},
    };
    for (int degrees = 1; degrees < 90; degrees += 8) {
        const double c = cos(degrees * 0.01745), s = sin(degrees * 0.01745);
        plan p;
        sl_placement placed = {0};
        begin(&p);
        for (size_t i = 0; i < sizeof walls / sizeof *walls; i++) {
            const sl_point a = walls[i].a, b = walls[i].b;
            const sl_point from = {c * a.x - s * a.y, s * a.x + c * a.y};
            const sl_point to = {c * b.x - s * b.y, s * b.x + c * b.y};
            assert_ok(p.context, sl_map_add_wall(p.context, &p.map, from, to, 0));
        }
        ready(&p);
        place(&p, &placed);
        check(&p, &placed, 2000);
        assert_int_equal(placed.slivers, 0);
        assert_in_range(placed.upper, 1, 2);
        sl_placement_destroy(p.context, &placed);
        end(&p);
    }
}

/// Two guards must stand where the edges of three spikes meet, at (0, 10) and (10, 0). What one of
/// them leaves of a niche ends in line with the reflex corner a and the ridge t, and no wall is on
/// that line; so the third guard sees the rest only from where two such lines meet, the origin.
///
///          t             Three spikes ask for a guard each, so 3 are needed. Anywhere but there, a
///        / | \           third guard leaves a sliver, and there would be 4.
///       |  1  |
///       |  |/-- b
///       | .+----+        The same is at the right, mirrored, and a spike at the lower right has an
///       '.:|    |        edge on the third line, x + y = 0.
///     ----'a    +---
///          |
///          3  ... 2
static void in_line_with_two_corners(void **state) {
    (void)state;
    static const sl_point niche[] = {
        {2, 3},    {2, 6},  {0, 6},  {1, 8},   {1, 9},    {5, 7.5},  {1, 9.5}, {1, 10},   {5, 10},
        {1, 10.5}, {1, 12}, {0, 15}, {-1, 12}, {-1, 9.5}, {-5, 7.5}, {-1, 9},  {-1, 3.5}, {0, 3},
    };
    enum { NICHE = sizeof niche / sizeof *niche };
    static const double maps[][4] = {{1, 0, 0, 1}, {2, 1, 1, 3}, {3, -2, 2, 5}, {-7, 1, 3, -4}};
    sl_point corners[2 * NICHE + 6] = {{-3, -3}, {2.5, -3}, {6, -6}, {3, -3}};
    size_t count = 4;
    for (int i = NICHE - 1; i >= 0; i--) corners[count++] = (sl_point){niche[i].y, niche[i].x};
    corners[count++] = (sl_point){3, 3};
    for (int i = 0; i < NICHE; i++) corners[count++] = niche[i];
    corners[count++] = (sl_point){-3, 3};
    for (size_t m = 0; m < sizeof maps / sizeof *maps; m++) {
        sl_point moved[2 * NICHE + 6];
        for (size_t i = 0; i < count; i++)
            moved[i] = (sl_point){maps[m][0] * corners[i].x + maps[m][1] * corners[i].y,
                                  maps[m][2] * corners[i].x + maps[m][3] * corners[i].y};
        assert_int_equal(optimum_of(moved, count, 0), 3);
    }
}

/// Maps of a generator, solid ground and thin walls, as they are and turned: a few rounds.
static void generated_maps(void **state) {
    (void)state;
    size_t kinds;
    const sl_map_kind *all = sl_map_kinds(&kinds);
    for (size_t k = 0; k < kinds; k++)
        for (int turned = 0; turned < 2; turned++) {
            plan p;
            sl_placement placed = {0};
            sl_place_options few = sl_place_options_default();
            sl_generate_options options = sl_generate_options_default();
            options.seed = 3;
            options.walls = SL_GENERATE_WALLS_LEAST;
            options.turned = turned ? 17.3 : 0;
            few.rounds = 1;
            begin(&p);
            assert_ok(p.context, sl_generate(p.context, &all[k], &options, &p.map));
            ready(&p);
            assert_ok(p.context, sl_place(p.context, p.query, &few, &placed));
            check(&p, &placed, 500);
            assert_int_equal(placed.slivers, 0);
            sl_placement_destroy(p.context, &placed);
            end(&p);
        }
}

/// On this turned map, gaps remain beside corners that only rounding makes: the round has a set all
/// the same, of fewer viewpoints than one in each cell.
static void gaps_by_rounding(void **state) {
    (void)state;
    plan p = {0};
    sl_placement placed = {0};
    sl_place_options one = sl_place_options_default();
    sl_generate_options options = sl_generate_options_default();
    options.seed = 6;
    options.walls = SL_GENERATE_WALLS_LEAST;
    options.turned = 17.3;
    one.rounds = 1;
    size_t kinds, city = 0;
    const sl_map_kind *all = sl_map_kinds(&kinds);
    while (strcmp(all[city].name, "city") != 0) city++;
    begin(&p);
    assert_ok(p.context, sl_generate(p.context, &all[city], &options, &p.map));
    ready(&p);
    assert_ok(p.context, sl_place(p.context, p.query, &one, &placed));
    check(&p, &placed, 2000);
    assert_int_equal(placed.slivers, 0);
    assert_true(placed.upper < p.space.inside_count / 2);
    sl_placement_destroy(p.context, &placed);
    end(&p);
}

/// Bounds as they are reported.
typedef struct reports {
    uint64_t lower[200], upper[200];
    int count;
} reports;

static void note_bounds(void *user, const sl_progress *progress) {
    reports *r = user;
    if (strcmp(progress->stage, "place") != 0 || r->count == 200) return;
    r->lower[r->count] = progress->done;
    r->upper[r->count++] = progress->total;
}

/// Where a step does not raise the lower bound, the round goes on to the upper bound. Among pillars
/// dozens of steps would each add some witnesses, in vain. And each step of the upper bound makes a
/// set that sees everything: the best one is not that of the last step.
static void rounds_do_not_wait(void **state) {
    (void)state;
    plan p = {0};
    reports r = {0};
    const sl_hooks hooks = {.user = &r, .progress = note_bounds};
    sl_placement placed = {0};
    sl_place_options one = sl_place_options_default();
    sl_generate_options options = sl_generate_options_default();
    options.seed = 3;
    options.walls = 200;
    one.rounds = 1;
    size_t kinds, pillars = 0;
    const sl_map_kind *all = sl_map_kinds(&kinds);
    while (strcmp(all[pillars].name, "pillars") != 0) pillars++;
    p.context = sl_context_create(&hooks);
    assert_non_null(p.context);
    assert_ok(p.context, sl_generate(p.context, &all[pillars], &options, &p.map));
    ready(&p);
    assert_ok(p.context, sl_place(p.context, p.query, &one, &placed));
    assert_int_equal(placed.rounds, 1);
    assert_true(r.count > 2);
    int same = 0, falls = 0;
    for (int i = 1; i < r.count; i++) {
        falls += r.upper[i] < r.upper[i - 1];
        same += r.lower[i] == r.lower[i - 1] && r.upper[i] == r.upper[i - 1];
    }
    assert_true(same <= 2); // the end of each half
    assert_true(falls > 3); // more than one step has
    sl_placement_destroy(p.context, &placed);
    end(&p);
}

// --- the same, changed

/// A polygon around the origin with corners in directions of whole numbers: it can be turned by
/// quarters, mirrored and scaled without rounding.
static size_t make_jagged(uint64_t seed, sl_point *out) {
    sl_random random = {seed};
    const size_t count = 12 + sl_random_below(&random, 20);
    for (size_t i = 0; i < count; i++) {
        const double angle =
            6.28318530717958 * ((double)i + 0.8 * sl_random_unit(&random)) / (double)count;
        const double r = 4 + (double)sl_random_below(&random, 60);
        out[i] = (sl_point){rint(r * 64 * cos(angle)), rint(r * 64 * sin(angle))};
    }
    return count;
}

static void changes_keep_the_optimum(void **state) {
    (void)state;
    const uint64_t seeds = testing_seeds(10);
    for (uint64_t seed = 0; seed < seeds; seed++) {
        sl_point corners[40], changed[40];
        const size_t count = make_jagged(seed, corners);
        const uint64_t optimum = optimum_of(corners, count, 0);
        for (size_t i = 0; i < count; i++) changed[i] = (sl_point){-corners[i].y, corners[i].x};
        assert_int_equal(optimum_of(changed, count, 0), optimum);
        for (size_t i = 0; i < count; i++)
            changed[i] = (sl_point){-corners[count - 1 - i].x, corners[count - 1 - i].y};
        assert_int_equal(optimum_of(changed, count, 0), optimum);
        for (size_t i = 0; i < count; i++)
            changed[i] = (sl_point){ldexp(corners[i].x, 200), ldexp(corners[i].y, 200)};
        assert_int_equal(optimum_of(changed, count, 0), optimum);
        for (size_t i = 0; i < count; i++)
            changed[i] = (sl_point){ldexp(corners[i].x, -200), ldexp(corners[i].y, -200)};
        assert_int_equal(optimum_of(changed, count, 0), optimum);
        for (size_t i = 0; i < count; i++)
            changed[i] = (sl_point){corners[i].x + 0x1p40, corners[i].y - 0x1p41};
        assert_int_equal(optimum_of(changed, count, 0), optimum);
    }
}

static void same_input_same_result(void **state) {
    (void)state;
    sl_point corners[40];
    const size_t count = make_jagged(5, corners);
    plan p;
    sl_placement one = {0}, other = {0};
    begin(&p);
    assert_ok(p.context, sl_map_add_open(p.context, &p.map, corners, count, 0));
    ready(&p);
    place(&p, &one);
    place(&p, &other);
    assert_int_equal(one.count, other.count);
    assert_int_equal(one.witness_count, other.witness_count);
    assert_memory_equal(one.viewpoints, other.viewpoints, one.count * sizeof *one.viewpoints);
    sl_placement_destroy(p.context, &one);
    sl_placement_destroy(p.context, &other);
    end(&p);
}

/// Among given places: no fewer than anywhere; as few where the optimum is among them.
static void given_places(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 6; seed++) {
        sl_point corners[40], places[48];
        const size_t count = make_jagged(seed, corners);
        plan p;
        sl_placement anywhere = {0}, given = {0}, few = {0};
        begin(&p);
        assert_ok(p.context, sl_map_add_open(p.context, &p.map, corners, count, 0));
        ready(&p);
        place(&p, &anywhere);
        sl_place_options options = sl_place_options_default();
        options.places = corners;
        options.place_count = (uint32_t)count;
        assert_ok(p.context, sl_place(p.context, p.query, &options, &given));
        check_all_seen(&p, &given, 3000);
        assert_true(given.lower >= anywhere.lower);
        assert_int_equal(given.lower, given.upper);
        // With the optimum among them, they are as good as anywhere.
        memcpy(places, corners, count * sizeof *corners);
        for (uint32_t i = 0; i < anywhere.count; i++) places[count + i] = anywhere.viewpoints[i].at;
        options.places = places;
        options.place_count = (uint32_t)count + anywhere.count;
        assert_ok(p.context, sl_place(p.context, p.query, &options, &few));
        assert_int_equal(few.lower, anywhere.upper);
        assert_int_equal(few.upper, anywhere.upper);
        sl_placement_destroy(p.context, &few);
        options.place_count = 1;
        const sl_status status = sl_place(p.context, p.query, &options, &few);
        assert_int_equal(status, anywhere.upper > 1 ? SL_BAD_ARGUMENT : status);
        if (status == SL_OK) sl_placement_destroy(p.context, &few);
        sl_placement_destroy(p.context, &anywhere);
        sl_placement_destroy(p.context, &given);
        end(&p);
    }
}

// --- refusals, cancelling

static void refusals(void **state) {
    (void)state;
    plan p;
    sl_placement placed = {0};
    begin(&p);
    testing_space(p.context, ROOM "mirror 2 2 4 4\n", &p.map, &p.space);
    assert_ok(p.context, sl_query_over(p.context, &p.space, &p.map, NULL, &p.query));
    assert_int_equal(sl_place(p.context, p.query, NULL, &placed), SL_UNSUPPORTED);
    assert_non_null(strstr(sl_context_message(p.context), "mirror"));
    assert_null(placed.viewpoints);
    end(&p);
}

/// Messages tell places apart that are far from the origin.
static void places_far_away(void **state) {
    (void)state;
    plan p;
    sl_placement placed = {0};
    begin(&p);
    testing_space(p.context,
                  "walls 2000000 0 2000010 0 2000010 10 2000000 10 2000000 0\n"
                  "wall 2000005 0 2000005 9\n",
                  &p.map, &p.space);
    assert_ok(p.context, sl_query_over(p.context, &p.space, &p.map, NULL, &p.query));
    const sl_point outside = {2000010.75, 5}, one = {2000001.25, 1};
    sl_place_options options = sl_place_options_default();
    options.place_count = 1;
    options.places = &outside;
    assert_int_equal(sl_place(p.context, p.query, &options, &placed), SL_BAD_ARGUMENT);
    assert_non_null(strstr(sl_context_message(p.context), "place 1 at (2000010.75, 5) is not"));
    options.places = &one;
    assert_int_equal(sl_place(p.context, p.query, &options, &placed), SL_BAD_ARGUMENT);
    assert_int_equal(sl_context_message(p.context)[0], '(');
    const double x = strtod(sl_context_message(p.context) + 1, NULL);
    assert_true(x > 2000005 && x < 2000010);
    const sl_viewpoint blind = {.at = one, .fov = 360};
    const sl_point target = {2000009.25, 1};
    const sl_place_list list = {
        .places = &blind, .place_count = 1, .targets = &target, .target_count = 1};
    assert_int_equal(sl_place_among(p.context, p.query, &list, NULL, &placed), SL_BAD_ARGUMENT);
    assert_non_null(strstr(sl_context_message(p.context), "target 1 at (2000009.25, 1)"));
    sl_viewpoint claimed = {.at = outside, .fov = 360};
    const sl_placement claim = {.viewpoints = &claimed, .count = 1};
    sl_place_verdict verdict;
    assert_int_equal(sl_place_proof_check(p.context, p.query, &claim, &verdict), SL_BAD_ARGUMENT);
    assert_non_null(strstr(sl_context_message(p.context), "viewpoint 1 at (2000010.75, 5) is not"));
    end(&p);
}

static bool is_over(void *user) {
    int *left = user;
    return --*left < 0;
}

/// However early it is stopped: without a set, or with one that sees everything.
static void cancelled(void **state) {
    (void)state;
    sl_point corners[40];
    const size_t count = make_jagged(7, corners);
    plan p;
    begin(&p);
    assert_ok(p.context, sl_map_add_open(p.context, &p.map, corners, count, 0));
    ready(&p);
    int kept = 0;
    for (int patience = 0; patience < 400; patience += 1 + patience / 8) {
        int left = patience;
        const sl_hooks hooks = {.user = &left, .cancelled = is_over};
        sl_context *hurried = sl_context_create(&hooks);
        sl_placement placed = {0};
        assert_non_null(hurried);
        const sl_status status = sl_place(hurried, p.query, NULL, &placed);
        assert_true(status == SL_CANCELLED || status == SL_OK);
        if (placed.viewpoints) {
            check_all_seen(&p, &placed, 500);
            assert_true(placed.lower <= placed.upper);
            kept += status == SL_CANCELLED;
            sl_place_verdict verdict;
            assert_ok(p.context, sl_place_proof_check(p.context, p.query, &placed, &verdict));
            assert_true(verdict.sees_all && verdict.lower == placed.lower);
        }
        sl_placement_destroy(hurried, &placed);
        sl_context_destroy(hurried);
    }
    assert_true(kept > 0);
    end(&p);
}

/// Memory fails once, at one allocation after the other: it is said, and nothing is left behind.
static void without_memory(void **state) {
    (void)state;
    static const sl_point corners[] = {{0, 0}, {9, 0}, {9, 8}, {6, 8}, {6, 4},
                                       {3, 4}, {3, 8}, {1, 9}, {0, 8}};
    plan p;
    long failed = 0;
    begin(&p);
    assert_ok(p.context, sl_map_add_open(p.context, &p.map, corners, 9, 0));
    ready(&p);
    p.memory.once = true;
    for (long n = 1, done = 0; !done; n += 1 + n / 16) {
        sl_placement placed = {0};
        p.memory.fail_at = p.memory.calls + n;
        const sl_status status = sl_place(p.context, p.query, NULL, &placed);
        done = p.memory.calls < p.memory.fail_at;
        p.memory.fail_at = 0;
        assert_true(status == SL_OK || status == SL_NO_MEMORY);
        assert_true((status == SL_OK) == (placed.viewpoints != NULL));
        failed += status == SL_NO_MEMORY;
        if (status == SL_OK) assert_int_equal(placed.lower, 2);
        sl_placement_destroy(p.context, &placed);
    }
    assert_true(failed > 20);
    end(&p);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_combs),
        cmocka_unit_test(known_orthogonal_combs),
        cmocka_unit_test(one_suffices),
        cmocka_unit_test(other_plans),
        cmocka_unit_test(door_in_thin_wall),
        cmocka_unit_test(in_line_with_two_corners),
        cmocka_unit_test(generated_maps),
        cmocka_unit_test(gaps_by_rounding),
        cmocka_unit_test(rounds_do_not_wait),
        cmocka_unit_test(changes_keep_the_optimum),
        cmocka_unit_test(same_input_same_result),
        cmocka_unit_test(given_places),
        cmocka_unit_test(refusals),
        cmocka_unit_test(places_far_away),
        cmocka_unit_test(cancelled),
        cmocka_unit_test(without_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

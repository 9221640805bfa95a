/// Work in parts: shards, what is stopped and gone on with, and what is taken over from a map
/// before it was changed all come to what is found in one go; what is stopped never misses a pair.
#include "cell_to_cell/pvs_rows.h"
#include "space/subdivide.h"
#include "testing.h"

#include "oracle/random_effects.h"
#include "oracle/random_map.h"
#include "sightline/support.h"

#ifdef SIGHTLINE_TESTS_GLPK
#include "sightline/generate.h"
#include "sightline/glpk.h"
#endif

#include <stdatomic.h>

enum { RANDOM_MAPS = 80, EDITS = 12, GRID = 12 }; // every other map is oblique

static const char *const names[] = {"sweep", "dfs", "prune"};
enum { NAMES = sizeof names / sizeof *names };

static sl_see_options options_for(const sl_see_method *method, sl_sight sight, bool inside_only,
                                  unsigned threads) {
    sl_see_options options = sl_see_options_default();
    options.sight = sight;
    options.inside_only = inside_only;
    options.threads = threads;
    options.solver = method->stabs ? sl_funnel() : NULL;
    return options;
}

static void assert_same_doors(const sl_door_sets *a, const sl_door_sets *b) {
    assert_int_equal(a->cell_count, b->cell_count);
    assert_int_equal(sl_door_sets_bytes(a), sl_door_sets_bytes(b));
    if (!sl_door_sets_bytes(a)) return;
    assert_memory_equal(a->offsets, b->offsets, (a->cell_count + 1) * sizeof *a->offsets);
    assert_memory_equal(a->bytes, b->bytes, sl_door_sets_bytes(a));
}

static void assert_same(const sl_visibility *a, const sl_visibility *b) {
    assert_true(testing_same_rows(&a->pvs, &b->pvs));
    assert_int_equal(a->account.doubtful_pairs, b->account.doubtful_pairs);
    if (a->account.doubtful_pairs) assert_true(testing_same_rows(&a->doubtful, &b->doubtful));
    assert_int_equal(a->account.pairs, b->account.pairs);
    assert_int_equal(a->sight, b->sight);
    assert_int_equal(a->guarantee, b->guarantee);
    assert_true(testing_same_rows(&a->mirrored, &b->mirrored));
    assert_int_equal(a->account.mirrored_pairs, b->account.mirrored_pairs);
    assert_same_doors(&a->doors, &b->doors);
    assert_same_doors(&a->mirrored_doors, &b->mirrored_doors);
}

// --- maps

typedef struct place {
    sl_map map;
    sl_space space;
} place;

static void destroy(sl_context *context, place *p) {
    sl_map_destroy(context, &p->map);
    sl_space_destroy(context, &p->space);
}

static void subdivide(sl_context *context, bool oblique, place *p) {
    assert_ok(context, sl_map_clean(context, &p->map, NULL, NULL));
    const sl_subdivide_options kd = sl_subdivide_options_default();
    if (oblique)
        assert_ok(context, sli_subdivide_mesh(context, &p->map, &p->space));
    else
        assert_ok(context, sli_subdivide_kd(context, &p->map, &kd, &p->space));
}

static sl_point random_point(sl_random *random) {
    return (sl_point){(double)sl_random_below(random, GRID), (double)sl_random_below(random, GRID)};
}

static void add_oblique_walls(sl_context *context, sl_random *random, sl_map *map) {
    for (uint64_t i = 2 + sl_random_below(random, 14); i > 0; i--)
        assert_ok(context,
                  sl_map_add_wall(context, map, random_point(random), random_point(random), 0));
    const sl_point corners[] = {{-1, -1}, {GRID, -1}, {GRID, GRID}, {-1, GRID}};
    for (int i = 0; i < 4; i++)
        assert_ok(context, sl_map_add_wall(context, map, corners[i], corners[(i + 1) % 4], 0));
}

static place random_map(sl_context *context, uint64_t seed, bool oblique) {
    place p = {0};
    sl_random random = {seed};
    if (oblique)
        add_oblique_walls(context, &random, &p.map);
    else
        assert_ok(context, oracle_random_map(context, seed, (oracle_grid)(seed % 3), &p.map));
    subdivide(context, oblique, &p);
    return p;
}

static place generated(sl_context *context, const char *kind, uint64_t walls, double turned,
                       bool in_line) {
    size_t count;
    const sl_map_kind *kinds = sl_map_kinds(&count);
    sl_generate_options options = sl_generate_options_default();
    options.walls = walls;
    options.turned = turned;
    options.in_line = in_line;
    place p = {0};
    for (size_t i = 0; i < count; i++)
        if (strcmp(kinds[i].name, kind) == 0)
            assert_ok(context, sl_generate(context, &kinds[i], &options, &p.map));
    assert_true(p.map.wall_count > 0);
    subdivide(context, turned != 0, &p);
    return p;
}

// --- one go and parts

typedef struct patience {
    atomic_long asked;
    long most;
} patience;

static bool is_over(void *user) {
    patience *p = user;
    return atomic_fetch_add(&p->asked, 1) >= p->most;
}

static void check_shards(sl_context *context, const sl_see_method *method, const sl_space *space,
                         sl_see_options options, const sl_visibility *plain) {
    for (uint32_t count = 1; count <= 7; count += 3) {
        sl_partial all = {0};
        for (uint32_t shard = count; shard > 0; shard--) {
            sl_partial part = {0};
            options.shard = shard;
            options.shard_count = count;
            assert_ok(context, method->run(context, space, &options, &part));
            if (shard == count) {
                all = part;
                continue;
            }
            assert_false(sl_partial_complete(&all) && all.unit_count);
            assert_ok(context, sl_partial_merge(context, &all, &part));
            sl_partial_destroy(context, &part);
        }
        sl_visibility joined;
        assert_true(sl_partial_complete(&all));
        assert_ok(context, method->finish(context, space, &options, &all, &joined));
        assert_same(&joined, plain);
        sl_visibility_destroy(context, &joined);
        sl_partial_destroy(context, &all);
    }
}

/// Whatever is seen while some of the doors are shut is in the rows, too.
static void assert_rows_miss_nothing(const sl_pvs *part, const sl_door_sets *part_doors,
                                     const sl_pvs *plain, const sl_door_sets *plain_doors,
                                     const bool *shut) {
    for (uint32_t a = 0; a < plain->cell_count; a++)
        for (uint32_t b = 0; b < plain->cell_count; b++)
            if (sl_pvs_sees(plain, a, b) && sli_door_sets_open(plain_doors, a, b, shut))
                assert_true(sl_pvs_sees(part, a, b) && sli_door_sets_open(part_doors, a, b, shut));
}

static void assert_misses_nothing(const sl_visibility *part, const sl_visibility *plain,
                                  const sl_plan *plan) {
    const uint32_t count = plain->pvs.cell_count;
    for (unsigned doors = 0; doors < (plan && plan->map->door_count ? 8u : 1u); doors++) {
        const bool shut[] = {doors & 1, doors & 2, doors & 4};
        assert_rows_miss_nothing(&part->pvs, &part->doors, &plain->pvs, &plain->doors, shut);
        assert_rows_miss_nothing(&part->mirrored, &part->mirrored_doors, &plain->mirrored,
                                 &plain->mirrored_doors, shut);
    }
    for (uint32_t a = 0; a < count && (!plan || plan->mutual); a++)
        for (uint32_t b = 0; b < count; b++)
            assert_true(sl_pvs_sees(&part->pvs, a, b) == sl_pvs_sees(&part->pvs, b, a));
    assert_int_equal(part->guarantee, SL_CONSERVATIVE);
    assert_true(part->account.pairs >= plain->account.pairs);
}

/// Stops again and again, each time a little later, by up to `step` questions; gives how often it
/// was stopped short.
static int check_stops(sl_context *context, const sl_see_method *method, const sl_space *space,
                       sl_see_options options, const sl_visibility *plain, sl_random *random,
                       uint64_t step) {
    sl_partial partial = {0};
    patience p = {0};
    options.enough = is_over;
    options.enough_user = &p;
    int stops = 0;
    long most = 0;
    do {
        const uint32_t before = partial.done_count;
        atomic_store(&p.asked, 0);
        p.most = most;
        most += 1 + (long)sl_random_below(random, step) + most / 2;
        assert_ok(context, method->run(context, space, &options, &partial));
        assert_true(partial.done_count >= before);
        sl_visibility now;
        if (sl_random_below(random, 2)) p.most *= 4; // for a tight bound, or a loose one
        assert_ok(context, method->finish(context, space, &options, &partial, &now));
        if (sl_partial_complete(&partial)) {
            assert_same(&now, plain);
        } else {
            assert_misses_nothing(&now, plain, options.plan);
            stops++;
        }
        sl_visibility_destroy(context, &now);
    } while (!sl_partial_complete(&partial));
    sl_partial_destroy(context, &partial);
    return stops;
}

static int check_space(sl_context *context, const sl_space *space, sl_random *random) {
    int stops = 0;
    for (size_t m = 0; m < NAMES; m++)
        for (int sight = SL_CLOSED; sight <= SL_OPEN; sight++)
            for (unsigned threads = 1; threads <= 2; threads++) {
                const sl_see_method *method = testing_method(names[m]);
                const bool inside = sl_random_below(random, 3) == 0;
                sl_see_options options = options_for(method, (sl_sight)sight, inside, threads);
                options.rows = sl_random_below(random, 2) ? SL_ROWS_SPARSE : SL_ROWS_DENSE;
                sl_visibility plain;
                assert_ok(context, method->see(context, space, &options, &plain));
                check_shards(context, method, space, options, &plain);
                stops += check_stops(context, method, space, options, &plain, random, 40);
                sl_visibility_destroy(context, &plain);
            }
    return stops;
}

static void parts_come_to_the_whole(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {5};
    int stops = 0;
    const uint64_t seeds = testing_seeds(RANDOM_MAPS);
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        place p = random_map(context, seed, seed % 2);
        stops += check_space(context, &p.space, &random);
        destroy(context, &p);
    }
    assert_true((uint64_t)stops > 5 * seeds);
    sl_context_destroy(context);
}

static void effects_come_to_the_whole(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {7};
    int stops = 0;
    const uint64_t seeds = testing_seeds(RANDOM_MAPS);
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        place p = {0};
        random_effects_map(context, &random, 1 + (unsigned)(seed % 15), 1, &p.map);
        subdivide(context, false, &p);
        sl_plan plan = sl_plan_make(&p.map);
        plan.mirror_depth = (uint32_t)sl_random_below(&random, 3);
        const sl_see_method *method = testing_method(seed % 2 ? "dfs" : "prune");
        const bool inside = sl_random_below(&random, 3) == 0;
        sl_see_options options = options_for(method, seed % 4 < 2 ? SL_OPEN : SL_CLOSED, inside, 2);
        options.plan = &plan;
        sl_visibility plain;
        assert_ok(context, method->see(context, &p.space, &options, &plain));
        check_shards(context, method, &p.space, options, &plain);
        stops += check_stops(context, method, &p.space, options, &plain, &random, 3);
        sl_visibility_destroy(context, &plain);
        destroy(context, &p);
    }
    assert_true((uint64_t)stops >= seeds + seeds / 4);
    sl_context_destroy(context);
}

static void larger_maps_come_to_the_whole(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {6};
    place office = generated(context, "office", 300, 0, false),
          city = generated(context, "city", 200, 20, false);
    assert_true(check_space(context, &office.space, &random) > 20);
    assert_true(check_space(context, &city.space, &random) > 20);
    destroy(context, &office);
    destroy(context, &city);
    sl_context_destroy(context);
}

#ifdef SIGHTLINE_TESTS_GLPK
/// What a solver that rounds cannot tell is kept apart by every part.
static void doubtful_pairs_come_together(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    place p = {0};
    assert_ok(context,
              sl_map_read(context, SIGHTLINE_SOURCE_DIR "/maps/grazing.map", NULL, &p.map));
    subdivide(context, false, &p);
    const sl_see_method *method = testing_method("dfs");
    sl_see_options options = options_for(method, SL_CLOSED, false, 1);
    options.solver = sl_glpk_simplex();
    sl_visibility plain;
    assert_ok(context, method->see(context, &p.space, &options, &plain));
    assert_true(plain.account.doubtful_pairs > 0);
    check_shards(context, method, &p.space, options, &plain);
    sl_visibility_destroy(context, &plain);
    destroy(context, &p);
    sl_context_destroy(context);
}
#endif

/// A set that half of the work made is nearer to the truth than the bound alone.
static void decided_pairs_are_told_from_others(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    place p = generated(context, "tunnels", 1000, 0, false);
    const sl_see_method *method = testing_method("sweep"), *flood = testing_method("flood");
    sl_see_options options = options_for(method, SL_CLOSED, false, 1);
    sl_visibility plain, bound, half;
    assert_ok(context, method->see(context, &p.space, &options, &plain));
    assert_ok(context, flood->see(context, &p.space, &options, &bound));
    sl_partial partial = {0};
    assert_ok(context, method->run(context, &p.space, &options, &partial));
    memset(partial.done + sl_bits_words(partial.unit_count / 2), 0,
           (sl_bits_words(partial.unit_count) - sl_bits_words(partial.unit_count / 2)) *
               sizeof *partial.done);
    partial.done_count = partial.unit_count / 2;
    assert_ok(context, method->finish(context, &p.space, &options, &partial, &half));
    assert_misses_nothing(&half, &plain, NULL);
    assert_true(bound.account.pairs > plain.account.pairs);
    print_message("%d pairs seen, %d by half of the work, %d by the bound\n",
                  (int)plain.account.pairs, (int)half.account.pairs, (int)bound.account.pairs);
    assert_true(half.account.pairs - plain.account.pairs <
                (bound.account.pairs - plain.account.pairs) * 9 / 10);
    sl_visibility_destroy(context, &plain);
    sl_visibility_destroy(context, &bound);
    sl_visibility_destroy(context, &half);
    sl_partial_destroy(context, &partial);
    destroy(context, &p);
    sl_context_destroy(context);
}

// --- a map that is changed

/// Takes a wall away, moves one a little, or adds one.
/// Glass and range of the map stay, but some glass is turned round.
static void keep_effects(sl_context *context, const place *from, sl_random *random, place *to) {
    const sl_map *map = &from->map;
    to->map.range = map->range;
    for (size_t i = 0; i < map->oneway_count; i++) {
        sl_segment at = map->oneways[i].segment;
        if (sl_random_below(random, 8) == 0) at = (sl_segment){at.b, at.a};
        assert_ok(context, sl_map_add_oneway(context, &to->map, at, 0));
    }
}

static place edited(sl_context *context, const place *from, bool oblique, sl_random *random) {
    place p = {0};
    const sl_space *space = &from->space;
    const uint64_t kind = sl_random_below(random, 3);
    const uint32_t chosen = (uint32_t)sl_random_below(random, space->wall_count);
    const double unit = (space->bounds.max.x - space->bounds.min.x) / 64;
    for (uint32_t i = 0; i < space->wall_count; i++) {
        sl_point a = space->walls[i].a, b = space->walls[i].b;
        const bool upright = a.x == b.x;
        if (i == chosen && kind == 0) continue;
        if (i == chosen && kind == 1) {
            if (upright || oblique) b.y += unit;
            if (!upright || oblique) b.x -= unit;
        }
        assert_ok(context, sl_map_add_wall(context, &p.map, a, b, 0));
        if (i != chosen || kind != 2) continue;
        const sl_point end = {upright || oblique ? a.x + unit : a.x, upright ? a.y : a.y + unit};
        assert_ok(context, sl_map_add_wall(context, &p.map, a, end, 0));
    }
    keep_effects(context, from, random, &p);
    subdivide(context, oblique, &p);
    return p;
}

/// Gives how many units were taken over.
static uint32_t check_edit(sl_context *context, const place *before, const place *after,
                           sl_random *random) {
    uint32_t kept = 0;
    const sl_plan plan = sl_plan_make(&after->map), plan_before = sl_plan_make(&before->map);
    assert_int_equal(plan.effects, plan_before.effects);
    for (size_t m = plan.effects ? 1 : 0; m < NAMES; m++) // with effects not the sweep
        for (int sight = SL_CLOSED; sight <= SL_OPEN; sight++) {
            const sl_see_method *method = testing_method(names[m]);
            const bool inside = sl_random_below(random, 4) == 0;
            const unsigned threads = 1 + (unsigned)sl_random_below(random, 2);
            sl_see_options options = options_for(method, (sl_sight)sight, inside, threads);
            options.plan = &plan;
            sl_visibility old, plain, again;
            sl_partial partial = {0};
            assert_ok(context, method->see(context, &before->space, &options, &old));
            assert_ok(context, method->see(context, &after->space, &options, &plain));
            assert_ok(context, sl_partial_reuse(context, &before->space, &old, &after->space,
                                                method, &options, &partial));
            kept += partial.done_count;
            sl_visibility bound;
            assert_ok(context, method->finish(context, &after->space, &options, &partial, &bound));
            if (!sl_partial_complete(&partial)) assert_misses_nothing(&bound, &plain, &plan);
            assert_ok(context, method->run(context, &after->space, &options, &partial));
            assert_ok(context, method->finish(context, &after->space, &options, &partial, &again));
            assert_same(&again, &plain);
            sl_partial_destroy(context, &partial);
            sl_visibility_destroy(context, &old);
            sl_visibility_destroy(context, &plain);
            sl_visibility_destroy(context, &again);
            sl_visibility_destroy(context, &bound);
        }
    return kept;
}

static uint32_t check_edits(sl_context *context, place *first, bool oblique, int edits,
                            sl_random *random) {
    uint32_t kept = 0;
    place before = *first;
    for (int i = 0; i < edits; i++) {
        place after = edited(context, &before, oblique, random);
        kept += check_edit(context, &before, &after, random);
        destroy(context, &before);
        before = after;
    }
    destroy(context, &before);
    return kept;
}

static void what_a_change_cannot_affect_is_kept(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {7};
    const uint64_t seeds = testing_seeds(RANDOM_MAPS);
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        place p = random_map(context, seed, seed % 2);
        check_edits(context, &p, seed % 2, 2, &random);
    }
    const char *const kinds[] = {"office", "city", "maze"};
    uint32_t kept = 0;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        place axial = generated(context, kinds[i], 300, 0, false);
        kept += check_edits(context, &axial, false, EDITS, &random);
        for (int in_line = 0; in_line < 2; in_line++) {
            place turned = generated(context, kinds[i], 150, 30, in_line);
            kept += check_edits(context, &turned, true, EDITS, &random);
        }
    }
    print_message("%u units were taken over\n", kept);
    assert_true(kept > 1000);
    sl_context_destroy(context);
}

/// Glass in some doorways, and a view range.
static place office_with_effects(sl_context *context, unsigned effects, sl_random *random) {
    place bare = generated(context, "office", 300, 0, false), p = {0};
    for (uint32_t i = 0; i < bare.space.wall_count; i++)
        assert_ok(context, sl_map_add_wall(context, &p.map, bare.space.walls[i].a,
                                           bare.space.walls[i].b, 0));
    for (uint32_t i = 0; i < bare.space.portal_count && effects & SL_EFFECT_ONEWAY; i++) {
        const sl_portal *portal = &bare.space.portals[i];
        const sl_segment at = {portal->left, portal->right};
        if (sl_random_below(random, 6) == 0)
            assert_ok(context, sl_map_add_oneway(context, &p.map, at, 0));
    }
    if (effects & SL_EFFECT_RANGE) p.map.range = 20;
    subdivide(context, false, &p);
    destroy(context, &bare);
    return p;
}

static void effects_that_a_change_cannot_affect_are_kept(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {9};
    for (unsigned effects = 1; effects < 4; effects++) {
        const unsigned wanted =
            (effects & 1 ? SL_EFFECT_ONEWAY : 0u) | (effects & 2 ? SL_EFFECT_RANGE : 0u);
        place p = office_with_effects(context, wanted, &random);
        assert_int_equal(sl_plan_make(&p.map).effects, wanted);
        const uint32_t kept = check_edits(context, &p, false, EDITS / 3, &random);
        print_message("effects %u: %u units were taken over\n", wanted, kept);
        assert_true(kept > 50);
    }
    sl_context_destroy(context);
}

static void other_questions_take_nothing_over(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    place p = {0};
    testing_space(context, "walls 0 0 8 0 8 8 0 8 0 0\nwalls 2 2 4 2 4 4 2 4 2 2\nstart 1 1 0\n",
                  &p.map, &p.space);
    const sl_see_method *sweep = testing_method("sweep"), *flood = testing_method("flood");
    const sl_see_options closed = options_for(sweep, SL_CLOSED, false, 1);
    const sl_see_options open = options_for(sweep, SL_OPEN, false, 1);
    const sl_see_options inside = options_for(sweep, SL_CLOSED, true, 1);
    sl_visibility exact, bound;
    sl_partial partial = {0};
    assert_ok(context, sweep->see(context, &p.space, &closed, &exact));
    assert_ok(context, flood->see(context, &p.space, &closed, &bound));
    const struct {
        const sl_visibility *seen;
        const sl_see_method *method;
        const sl_see_options *options;
        const char *said;
    } cases[] = {
        {&exact, sweep, &open, "closed sight"},
        {&exact, sweep, &inside, "inside alone"},
        {&bound, sweep, &closed, "not exact"},
        {&exact, flood, &closed, "exact method"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_equal(sl_partial_reuse(context, &p.space, cases[i].seen, &p.space,
                                          cases[i].method, cases[i].options, &partial),
                         SL_BAD_ARGUMENT);
        assert_non_null(strstr(sl_context_message(context), cases[i].said));
        assert_false(sl_partial_begun(&partial));
    }
    assert_ok(context,
              sl_partial_reuse(context, &p.space, &exact, &p.space, sweep, &closed, &partial));
    assert_true(sl_partial_complete(&partial));
    sl_partial_destroy(context, &partial);
    sl_visibility_destroy(context, &exact);
    sl_visibility_destroy(context, &bound);
    destroy(context, &p);
    sl_context_destroy(context);
}

// --- misuse, and lack of memory

static void what_does_not_belong_together_is_refused(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    place p = generated(context, "office", 100, 0, false),
          q = generated(context, "office", 200, 0, false);
    for (size_t m = 0; m < NAMES; m++) {
        const sl_see_method *method = testing_method(names[m]);
        sl_see_options options = options_for(method, SL_CLOSED, false, 1);
        sl_partial one = {0}, other = {0};
        options.shard = 3, options.shard_count = 2;
        assert_int_equal(method->run(context, &p.space, &options, &one), SL_BAD_ARGUMENT);
        assert_false(sl_partial_begun(&one));
        options.shard = 0, options.shard_count = 0;
        assert_ok(context, method->run(context, &p.space, &options, &one));
        assert_ok(context, method->run(context, &q.space, &options, &other));
        assert_int_equal(method->run(context, &q.space, &options, &one), SL_BAD_ARGUMENT);
        assert_int_equal(sl_partial_merge(context, &one, &other), SL_BAD_ARGUMENT);
        options.inside_only = true;
        assert_int_equal(method->run(context, &p.space, &options, &one), SL_BAD_ARGUMENT);
        options.trees = true;
        sl_partial none = {0};
        assert_int_not_equal(method->run(context, &p.space, &options, &none), SL_OK);
        sl_partial_destroy(context, &one);
        sl_partial_destroy(context, &other);
    }
    destroy(context, &p);
    destroy(context, &q);
    sl_context_destroy(context);
}

/// Stopped, settled, gone on with, taken over to a changed map, joined.
static sl_status go_all_ways(sl_context *context, const sl_see_method *method, const place *p,
                             const place *q, sl_visibility *out, sl_partial *partial) {
    patience few = {.most = 12};
    sl_see_options options = options_for(method, SL_CLOSED, false, 1);
    sl_see_options stopped = options;
    stopped.enough = is_over;
    stopped.enough_user = &few;
    sl_status status = method->run(context, &p->space, &stopped, &partial[0]);
    if (status == SL_OK)
        status = method->finish(context, &p->space, &options, &partial[0], &out[0]);
    if (status == SL_OK) status = method->run(context, &p->space, &options, &partial[0]);
    if (status == SL_OK)
        status = method->finish(context, &p->space, &options, &partial[0], &out[1]);
    if (status == SL_OK)
        status =
            sl_partial_reuse(context, &p->space, &out[1], &q->space, method, &options, &partial[1]);
    return status == SL_OK ? sl_partial_merge(context, &partial[0], &partial[0]) : status;
}

static void lack_of_memory_is_told_and_leaves_nothing(void **state) {
    (void)state;
    for (size_t m = 0; m < NAMES; m++) {
        testing_memory memory = {0};
        sl_context *context = testing_context(&memory);
        const sl_see_method *method = testing_method(names[m]);
        sl_random random = {8};
        place p = random_map(context, 5, false), q = edited(context, &p, false, &random);
        const long live = memory.live;
        sl_status status = SL_NO_MEMORY;
        for (long fail_at = 1; status == SL_NO_MEMORY; fail_at++) {
            sl_visibility seen[2] = {0};
            sl_partial partial[2] = {0};
            memory.calls = 0;
            memory.fail_at = fail_at;
            status = go_all_ways(context, method, &p, &q, seen, partial);
            memory.fail_at = 0;
            for (int i = 0; i < 2; i++) {
                sl_visibility_destroy(context, &seen[i]);
                sl_partial_destroy(context, &partial[i]);
            }
            assert_int_equal(memory.live, live);
        }
        assert_ok(context, status);
        destroy(context, &p);
        destroy(context, &q);
        sl_context_destroy(context);
    }
}

/// All methods on a map with all effects: in one go, and those that can in parts, joined with
/// themselves.
static sl_status see_effects(sl_context *context, const place *p, const sl_plan *plan,
                             const sl_see_method *method, sl_visibility *out, sl_partial *partial) {
    patience few = {.most = 4};
    sl_see_options options = options_for(method, SL_CLOSED, false, 1), stopped;
    options.plan = plan;
    sl_status status = method->see(context, &p->space, &options, &out[0]);
    if (!method->stabs || !method->run) return status;
    stopped = options;
    stopped.enough = is_over;
    stopped.enough_user = &few;
    if (status == SL_OK) status = method->run(context, &p->space, &stopped, partial);
    if (status == SL_OK) status = method->finish(context, &p->space, &options, partial, &out[1]);
    return status == SL_OK ? sl_partial_merge(context, partial, partial) : status;
}

static void lack_of_memory_for_effects_leaves_nothing(void **state) {
    (void)state;
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    for (const sl_see_method *method = methods; method < methods + count; method++) {
        testing_memory memory = {0};
        sl_context *context = testing_context(&memory);
        sl_random random = {3};
        place p = {0};
        random_effects_map(context, &random, 15, 1, &p.map);
        subdivide(context, false, &p);
        sl_plan plan = sl_plan_make(&p.map);
        plan.effects &= method->knows;
        const long live = memory.live;
        sl_status status = SL_NO_MEMORY;
        for (long fail_at = 1; status == SL_NO_MEMORY; fail_at++) {
            sl_visibility seen[2] = {0};
            sl_partial partial = {0};
            memory.calls = 0;
            memory.fail_at = fail_at;
            status = see_effects(context, &p, &plan, method, seen, &partial);
            memory.fail_at = 0;
            for (int i = 0; i < 2; i++) sl_visibility_destroy(context, &seen[i]);
            sl_partial_destroy(context, &partial);
            assert_int_equal(memory.live, live);
        }
        assert_ok(context, status);
        destroy(context, &p);
        sl_context_destroy(context);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_come_to_the_whole),
        cmocka_unit_test(effects_come_to_the_whole),
        cmocka_unit_test(larger_maps_come_to_the_whole),
#ifdef SIGHTLINE_TESTS_GLPK
        cmocka_unit_test(doubtful_pairs_come_together),
#endif
        cmocka_unit_test(decided_pairs_are_told_from_others),
        cmocka_unit_test(what_a_change_cannot_affect_is_kept),
        cmocka_unit_test(effects_that_a_change_cannot_affect_are_kept),
        cmocka_unit_test(other_questions_take_nothing_over),
        cmocka_unit_test(what_does_not_belong_together_is_refused),
        cmocka_unit_test(lack_of_memory_is_told_and_leaves_nothing),
        cmocka_unit_test(lack_of_memory_for_effects_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/// Effects against an oracle that knows them, on random maps with all their combinations; doors
/// against bakes with walls in those that are shut.
#include "cell_to_cell/pvs_rows.h"
#include "effects/filtered.h"
#include "space/subdivide.h"
#include "testing.h"

#include "oracle/effects.h"
#include "oracle/random_effects.h"
#include "oracle/random_oblique.h"

#include <math.h>

enum { MAPS = 160, STATES = 12, PUSHES = 6000 };

typedef struct trial {
    sl_context *context;
    sl_map map;
    sl_space space;
    sl_plan plan;
    uint64_t seed;
    uint32_t depth;
} trial;

static void see(sl_context *context, const sl_space *space, const sl_plan *plan, const char *name,
                sl_sight sight, sl_visibility *out) {
    sl_see_options options = sl_see_options_default();
    options.sight = sight;
    options.solver = testing_method(name)->stabs ? sl_funnel() : NULL;
    options.plan = plan;
    assert_ok(context, testing_method(name)->see(context, space, &options, out));
}

// --- random maps

/// `effects`: bits of those that the map has.
static void begin(trial *t, uint64_t seed, unsigned effects) {
    *t = (trial){.context = testing_context(NULL), .seed = seed};
    sl_random random = {seed};
    random_effects_map(t->context, &random, effects, 1, &t->map);
    t->depth = (uint32_t)sl_random_below(&random, 3);
    const sl_subdivide_options options = sl_subdivide_options_default();
    assert_ok(t->context, sli_subdivide_kd(t->context, &t->map, &options, &t->space));
    assert_ok(t->context, sl_space_check(t->context, &t->space));
    t->plan = sl_plan_make(&t->map);
    assert_int_equal(t->plan.effects, effects);
    t->plan.mirror_depth = t->depth;
    t->plan.door_limit = 1000;
}

static void end(trial *t) {
    sl_space_destroy(t->context, &t->space);
    sl_map_destroy(t->context, &t->map);
    sl_context_destroy(t->context);
}

// --- against the oracle

/// What the oracle says of a pair while doors are shut: seen for sure, or unless its lengths err.
typedef struct truth {
    bool sure, possible;
} truth;

static void gather(const trial *t, const oracle_ways *ways, uint32_t shut, bool mirrored,
                   truth *out) {
    const uint32_t n = t->space.cell_count;
    memset(out, 0, (size_t)n * n * sizeof *out);
    for (uint32_t i = 0; i < n && !mirrored; i++) out[i * n + i] = (truth){true, true};
    for (size_t i = 0; i < ways->count; i++) {
        const oracle_way *w = &ways->items[i];
        if (w->doors & shut || w->mirrored != mirrored) continue;
        truth *pair = &out[w->from * n + w->to];
        const double range = t->map.range;
        pair->sure |= !(range > 0) || w->length <= range;
        pair->possible |= !(range > 0) || w->length <= range * 1.003;
    }
}

static void compare(const trial *t, const oracle_ways *ways, const sl_see_method *method,
                    const sl_pvs *pvs, const sl_door_sets *doors, bool mirrored, uint32_t shut,
                    truth *truths) {
    const uint32_t n = t->space.cell_count;
    bool state[32];
    for (int i = 0; i < 32; i++) state[i] = shut >> i & 1;
    gather(t, ways, shut, mirrored, truths);
    for (uint32_t a = 0; a < n; a++)
        for (uint32_t b = 0; b < n; b++) {
            const truth *expected = &truths[a * n + b];
            const bool seen =
                pvs->cell_count && sl_pvs_sees(pvs, a, b) && sli_door_sets_open(doors, a, b, state);
            if (seen ? expected->possible || method->guarantee == SL_CONSERVATIVE
                     : !expected->sure || method->guarantee == SL_AGGRESSIVE)
                continue;
            sl_map_write(t->context, &t->map, NULL, "-");
            fail_msg("%s, seed %llu, effects %u, depth %u, shut %x: cell %u %s cell %u%s",
                     method->name, (unsigned long long)t->seed, t->plan.effects, t->depth, shut, a,
                     seen ? "sees" : "does not see", b, mirrored ? " by mirror" : "");
        }
}

static void assert_same_doors(const sl_door_sets *doors, const sl_door_sets *same) {
    const uint32_t n = doors->cell_count;
    assert_int_equal(n, same->cell_count);
    if (!n) return;
    assert_memory_equal(doors->offsets, same->offsets, (n + 1) * sizeof *doors->offsets);
    if (doors->offsets[n]) assert_memory_equal(doors->bytes, same->bytes, doors->offsets[n]);
}

/// The exact methods find the same, to the last byte.
static void compare_methods(const trial *t, const sl_visibility *by_dfs) {
    const char *const names[] = {"sweep", "prune"};
    const uint32_t n = t->space.cell_count;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        sl_visibility other = {0};
        see(t->context, &t->space, &t->plan, names[i], by_dfs->sight, &other);
        for (uint32_t a = 0; a < n; a++)
            for (uint32_t b = 0; b < n; b++)
                if (sl_pvs_sees(&by_dfs->pvs, a, b) != sl_pvs_sees(&other.pvs, a, b)) {
                    sl_map_write(t->context, &t->map, NULL, "-");
                    fail_msg("seed %llu, %s, %s: cells %u and %u", (unsigned long long)t->seed,
                             names[i], by_dfs->sight == SL_OPEN ? "open" : "closed", a, b);
                }
        assert_int_equal(by_dfs->account.pairs, other.account.pairs);
        assert_same_doors(&by_dfs->doors, &other.doors);
        assert_true(testing_same_rows(&by_dfs->mirrored, &other.mirrored));
        assert_same_doors(&by_dfs->mirrored_doors, &other.mirrored_doors);
        sl_visibility_destroy(t->context, &other);
    }
}

/// False where the map is too much for the oracle.
/// `sampled`: counts pairs that random lines found by mirror.
static bool try_map(uint64_t seed, unsigned effects, sl_sight sight, uint64_t *sampled) {
    trial t;
    oracle_ways ways;
    begin(&t, seed, effects);
    const bool within = oracle_effects(&t.space, &t.map, sight, t.depth, PUSHES, &ways);
    const uint32_t n = t.space.cell_count;
    truth *truths = calloc((size_t)n * n, sizeof *truths);
    assert_non_null(truths);
    size_t methods;
    const sl_see_method *all = sl_see_methods(&methods);
    for (size_t which = 0; which < methods && within; which++) {
        if (effects & ~all[which].knows) continue;
        sl_visibility v = {0};
        see(t.context, &t.space, &t.plan, all[which].name, sight, &v);
        assert_int_equal(v.account.effects.door_fallbacks, 0);
        if (strcmp(all[which].name, "dfs") == 0) compare_methods(&t, &v);
        if (all[which].guarantee == SL_AGGRESSIVE) *sampled += v.account.mirrored_pairs;
        for (uint32_t shut = 0; shut < (effects & SL_EFFECT_DOOR ? 8u : 1u); shut++) {
            compare(&t, &ways, &all[which], &v.pvs, &v.doors, false, shut, truths);
            compare(&t, &ways, &all[which], &v.mirrored, &v.mirrored_doors, true, shut, truths);
        }
        sl_visibility_destroy(t.context, &v);
    }
    free(truths);
    free(ways.items);
    end(&t);
    return within;
}

static void random_maps(void **state) {
    (void)state;
    uint64_t done = 0, sampled = 0;
    const uint64_t maps = testing_seeds(MAPS);
    for (uint64_t i = 0; i < maps; i++)
        done += try_map(i + 1, (unsigned)(i % 16), i / 16 % 2 ? SL_OPEN : SL_CLOSED, &sampled);
    assert_true(sampled > maps);
    // Once more those that more methods know.
    for (uint64_t i = 0; i < maps; i++) {
        const unsigned effects[] = {SL_EFFECT_ONEWAY, SL_EFFECT_RANGE,
                                    SL_EFFECT_ONEWAY | SL_EFFECT_RANGE,
                                    SL_EFFECT_MIRROR | SL_EFFECT_ONEWAY};
        done += try_map(i + 1, effects[i % 4], i / 4 % 2 ? SL_OPEN : SL_CLOSED, &sampled);
    }
    assert_true(done > maps);
}

// --- oblique walls

static sl_point draw_place(sl_random *random, oblique_grid grid) {
    const double x = oblique_coordinate(random, grid), y = oblique_coordinate(random, grid);
    return (sl_point){x, y};
}

static bool begin_oblique(trial *t, uint64_t seed, oblique_grid grid) {
    *t = (trial){.context = testing_context(NULL), .seed = seed};
    sl_random random = {seed};
    sl_status status = oblique_random_map(t->context, seed, grid, 12, &t->map);
    for (int i = 0; i < 4 && status == SL_OK; i++) {
        const sl_point a = draw_place(&random, grid), b = draw_place(&random, grid);
        if (a.x == b.x && a.y == b.y) continue;
        char name[] = {(char)('a' + i), 0};
        const bool mirror = seed % 4 == 0 && i < 2;
        if (mirror) {
            status = sl_map_add_mirror(t->context, &t->map, (sl_segment){a, b}, 0);
            if (status == SL_OK) t->map.mirrors[t->map.mirror_count - 1].one_sided = i == 1;
        }
        if (mirror) continue;
        if (sl_random_below(&random, 2))
            status = sl_map_add_oneway(t->context, &t->map, (sl_segment){a, b}, 0);
        else
            status = sl_map_add_door(t->context, &t->map, name, (sl_segment){a, b}, true, 0);
    }
    if (seed % 3 == 0) t->map.range = fabs(oblique_coordinate(&random, grid));
    if (status == SL_OK) status = sl_map_clean(t->context, &t->map, NULL, NULL);
    if (status == SL_OK) status = sli_subdivide_mesh(t->context, &t->map, &t->space);
    t->plan = sl_plan_make(&t->map);
    return status == SL_OK;
}

/// With some doors shut the sets say what a search past walls in their places finds.
static void compare_shut(const trial *t, const sl_visibility *by_dfs, const bool *shut) {
    const uint32_t n = t->space.cell_count;
    const sli_filtered_space filtered = {.shut = shut, .one_way = t->map.oneway_count > 0};
    sl_plan plan = t->plan;
    sl_space past;
    sl_visibility fresh = {0};
    assert_ok(t->context, sli_filtered_space_make(t->context, &t->space, &filtered, NULL, &past));
    plan.effects &= ~(unsigned)SL_EFFECT_DOOR;
    see(t->context, &past, &plan, "dfs", by_dfs->sight, &fresh);
    for (uint32_t a = 0; a < n; a++)
        for (uint32_t b = 0; b < n; b++)
            if (sl_pvs_sees(&fresh.pvs, a, b) !=
                (sl_pvs_sees(&by_dfs->pvs, a, b) && sli_door_sets_open(&by_dfs->doors, a, b, shut)))
                fail_msg("seed %llu: cells %u and %u with doors shut", (unsigned long long)t->seed,
                         a, b);
    sl_visibility_destroy(t->context, &fresh);
    sl_space_destroy(t->context, &past);
}

static void effects_among_oblique_walls(void **state) {
    (void)state;
    const uint64_t maps = testing_seeds(MAPS);
    uint64_t done = 0;
    for (uint64_t i = 0; i < maps; i++) {
        trial t;
        const bool made = begin_oblique(&t, i + 1, (oblique_grid)(i % OBLIQUE_GRIDS));
        for (int open = 0; open < 2 && made; open++) {
            sl_visibility by_dfs = {0};
            see(t.context, &t.space, &t.plan, "dfs", open ? SL_OPEN : SL_CLOSED, &by_dfs);
            compare_methods(&t, &by_dfs);
            const unsigned doors = 1 + (unsigned)(i / OBLIQUE_GRIDS) % 15;
            const bool shut[4] = {doors & 1, doors & 2, doors & 4, doors & 8};
            if (t.map.door_count && !by_dfs.account.effects.door_fallbacks)
                compare_shut(&t, &by_dfs, shut);
            sl_visibility_destroy(t.context, &by_dfs);
        }
        done += made;
        end(&t);
    }
    assert_true(done > maps / 2);
}

// --- doors against walls

static void compare_with_walls(const trial *t, const sl_visibility *all_open, const bool *shut) {
    sl_space walled;
    sl_visibility fresh = {0};
    const sli_filtered_space filtered = {.shut = shut};
    assert_ok(t->context, sli_filtered_space_make(t->context, &t->space, &filtered, NULL, &walled));
    assert_ok(t->context, sl_space_check(t->context, &walled));
    see(t->context, &walled, NULL, "sweep", all_open->sight, &fresh);
    for (uint32_t a = 0; a < t->space.cell_count; a++)
        for (uint32_t b = 0; b < t->space.cell_count; b++)
            if (sl_pvs_sees(&fresh.pvs, a, b) != (sl_pvs_sees(&all_open->pvs, a, b) &&
                                                  sli_door_sets_open(&all_open->doors, a, b, shut)))
                fail_msg("seed %llu: cells %u and %u", (unsigned long long)t->seed, a, b);
    sl_visibility_destroy(t->context, &fresh);
    sl_space_destroy(t->context, &walled);
}

static void shut_doors_are_walls(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= MAPS / 4; seed++) {
        trial t;
        sl_visibility v = {0};
        begin(&t, seed, SL_EFFECT_DOOR);
        see(t.context, &t.space, &t.plan, "prune", seed % 2 ? SL_OPEN : SL_CLOSED, &v);
        for (unsigned shut = 0; shut < 8; shut++)
            compare_with_walls(&t, &v, (bool[]){shut & 1, shut & 2, shut & 4});
        sl_visibility_destroy(t.context, &v);
        end(&t);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_maps),
        cmocka_unit_test(effects_among_oblique_walls),
        cmocka_unit_test(shut_doors_are_walls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

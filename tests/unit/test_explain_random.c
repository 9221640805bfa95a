// Explanations of every pair of cells of random maps: every line and every conflict that is told is
// proven again, and the answers are those of the search over all cells.
// SIGHTLINE_SEEDS in the environment: how many maps (300 by default).
#include "explain_proofs.h"

#include "oracle/random_map.h"
#include "space/subdivide.h"

/// Stabbing tests that a search over all cells may take; maps that need more are left out.
enum { MOST_TESTS = 20000 };

/// A space, and who sees whom in it.
typedef struct trial {
    sl_map map;
    sl_space space;
    sl_visibility closed, open;
} trial;

static void see(sl_context *context, trial *t) {
    size_t count;
    const sl_see_method *dfs = sl_see_methods(&count);
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    options.trees = true;
    options.threads = 1;
    assert_ok(context, dfs->see(context, &t->space, &options, &t->closed));
    options.sight = SL_OPEN;
    assert_ok(context, dfs->see(context, &t->space, &options, &t->open));
}

static void end_trial(sl_context *context, trial *t) {
    sl_visibility_destroy(context, &t->closed);
    sl_visibility_destroy(context, &t->open);
    sl_space_destroy(context, &t->space);
    sl_map_destroy(context, &t->map);
}

/// The fewest portals to a cell in a stab tree; SL_NO_WAY where it is in none. Of all cells in the
/// tree, the fewest portals from one of them to the cell go into *missing.
static uint32_t fewest_portals(const sl_space *space, const sl_stab_trees *trees, uint32_t from,
                               uint32_t to, uint32_t *missing) {
    const sl_stab_node *nodes = trees->nodes + trees->offsets[from];
    const size_t count = (size_t)(trees->offsets[from + 1] - trees->offsets[from]);
    uint32_t *depth = calloc(count, sizeof *depth), fewest = SL_NO_WAY;
    assert_non_null(depth);
    *missing = SL_NO_WAY;
    for (size_t i = 0; i < count; i++) {
        if (i) depth[i] = depth[nodes[i].parent] + 1;
        if (nodes[i].cell == to && depth[i] < fewest) fewest = depth[i];
        const uint32_t left = distance_between(space, nodes[i].cell, to);
        if (left < *missing) *missing = left;
    }
    free(depth);
    return fewest;
}

typedef struct tally {
    size_t maps, left_out, too_close, stabbed, grazing, hidden, unconnected, misses, turns;
} tally;

/// The portals of a sequence alone, without their space, are in each other's way as it says.
static void check_alone(sl_context *context, const sl_space *space, const sl_sequence *sequence,
                        sl_stab_verdict verdict, bool turns) {
    sl_portal_ends *portals = calloc(sequence->directed_count, sizeof *portals);
    sl_conflict found;
    assert_non_null(portals);
    for (uint32_t i = 0; i < sequence->directed_count; i++) {
        const sl_directed_portal *at = &space->directed[sequence->directed[i]];
        portals[i] = (sl_portal_ends){at->left, at->right};
    }
    assert_ok(context, sl_conflict_find(context, portals, sequence->directed_count, &found));
    assert_int_equal(found.verdict, verdict);
    assert_int_equal(found.turns, turns);
    assert_int_equal(found.end_count, sequence->end_count);
    for (uint32_t k = 0; k < found.end_count; k++) {
        assert_int_equal(found.ends[k].portal, sequence->ends[k].portal);
        assert_int_equal(found.ends[k].left, sequence->ends[k].left);
    }
    if (!turns && found.end_count)
        assert_string_equal(sl_conflict_reason(portals, &found),
                            sl_sequence_reason(space, sequence));
    free(portals);
}

static void check_hidden(sl_context *context, const trial *t, const sl_explanation *e,
                         tally *count) {
    uint32_t missing;
    fewest_portals(&t->space, &t->closed.trees, e->from, e->to, &missing);
    assert_true(e->miss_count > 0);
    assert_int_equal(e->misses[0].missing, missing);
    for (uint32_t i = 0; i < e->miss_count; i++) {
        check_miss(context, &t->space, e, i);
        check_alone(context, &t->space, &e->misses[i].sequence, SL_HIDDEN, e->misses[i].turns);
        count->turns += e->misses[i].turns;
    }
    count->misses += e->miss_count;
    count->hidden++;
}

static void check_pair(sl_context *context, const trial *t, uint64_t seed, uint32_t from,
                       uint32_t to, tally *count) {
    const sl_sight sight = seed % 2 ? SL_OPEN : SL_CLOSED;
    sl_explain_options options = sl_explain_options_default();
    options.sight = sight;
    sl_explanation e;
    assert_ok(context, sl_explain(context, &t->space, &options, from, to, &e));
    const bool closed = sl_pvs_sees(&t->closed.pvs, from, to);
    const bool open = sl_pvs_sees(&t->open.pvs, from, to);
    assert_true(e.complete);
    assert_int_equal(e.seen, sight == SL_OPEN ? open : closed);
    assert_int_equal(e.verdict, open ? SL_STABBED : closed ? SL_GRAZING : SL_HIDDEN);
    assert_int_equal(e.distance, distance_between(&t->space, from, to));
    assert_int_equal(e.sequence.directed_count > 0, closed && from != to);
    if (e.sequence.directed_count) {
        uint32_t missing;
        const sl_stab_trees *trees = open ? &t->open.trees : &t->closed.trees;
        assert_int_equal(check_chain(&t->space, from, &e.sequence), to);
        assert_int_equal(e.sequence.directed_count,
                         fewest_portals(&t->space, trees, from, to, &missing));
        check_witness(&t->space, &e);
        check_alone(context, &t->space, &e.sequence, e.verdict, false);
        if (e.verdict == SL_GRAZING) check_conflict(&t->space, &e.sequence, true);
        // Only the grid of rounded tenths has lines that close together.
        const bool too_close = e.touches && open;
        if (too_close) assert_int_equal(seed % 3, ORACLE_GRID_TENTHS);
        count->too_close += too_close;
        count->stabbed += open;
        count->grazing += !open;
    }
    if (closed || e.distance == SL_NO_WAY) {
        assert_int_equal(e.miss_count, 0);
        count->unconnected += !closed;
    } else {
        check_hidden(context, t, &e, count);
    }
    sl_explanation_destroy(context, &e);
}

static void try_random_map(sl_context *context, uint64_t seed, tally *count) {
    trial t = {0};
    const sl_subdivide_options options = sl_subdivide_options_default();
    assert_ok(context, oracle_random_map(context, seed, (oracle_grid)(seed % 3), &t.map));
    assert_ok(context, sl_map_clean(context, &t.map, NULL, NULL));
    assert_ok(context, sli_subdivide_kd(context, &t.map, &options, &t.space));
    see(context, &t);
    if (t.closed.account.tests > MOST_TESTS) {
        count->left_out++;
    } else {
        count->maps++;
        for (uint32_t a = 0; a < t.space.cell_count; a++)
            for (uint32_t b = 0; b < t.space.cell_count; b++)
                check_pair(context, &t, seed, a, b, count);
    }
    end_trial(context, &t);
}

static void random_maps_are_explained(void **state) {
    (void)state;
    const uint64_t seeds = testing_seeds(300);
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    tally count = {0};
    for (uint64_t seed = 0; seed < seeds; seed++) try_random_map(context, seed, &count);
    print_message("%zu maps (%zu left out): %zu pairs stabbed (%zu closely), %zu grazing, %zu "
                  "hidden with %zu "
                  "misses (%zu turn), %zu unconnected\n",
                  count.maps, count.left_out, count.stabbed, count.too_close, count.grazing,
                  count.hidden, count.misses, count.turns, count.unconnected);
    // Random maps must give all there is to explain.
    assert_true(count.stabbed && count.grazing && count.hidden && count.turns);
    assert_true(count.unconnected && count.misses > count.turns);
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_maps_are_explained),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/// Stab trees of maps with mirrors: what they hold, that eyes are not misled by them, and their
/// baked file.
#include "baked_bytes.h"
#include "sight/eye_search.h"
#include "slv_file.h"
#include "space/subdivide.h"

#include "effects/mirrors.h"
#include "oracle/random_effects.h"
#include "sightline/stab.h"
#include "sightline/view.h"

enum { MAPS = 96, EYES = 4, CELLS_MOST = 128 };

typedef struct trial {
    sl_context *context;
    sl_random random;
    unsigned effects;
    sl_map map;
    sl_space space;
    uint32_t depth;
} trial;

static void begin(trial *t, uint64_t seed) {
    *t = (trial){.context = testing_context(NULL), .random = {seed}, .depth = seed / 8 % 4};
    t->effects = SL_EFFECT_MIRROR | (seed & 1 ? SL_EFFECT_DOOR : 0) |
                 (seed & 2 ? SL_EFFECT_ONEWAY : 0) | (seed & 4 ? SL_EFFECT_RANGE : 0);
    random_effects_map(t->context, &t->random, t->effects, 1, &t->map);
    const sl_subdivide_options options = sl_subdivide_options_default();
    assert_ok(t->context, sli_subdivide_kd(t->context, &t->map, &options, &t->space));
    assert_true(t->space.cell_count <= CELLS_MOST);
}

static void end(trial *t) {
    sl_space_destroy(t->context, &t->space);
    sl_map_destroy(t->context, &t->map);
    sl_context_destroy(t->context);
}

static void see(sl_context *context, const sl_space *space, const sl_map *map, uint32_t depth,
                sl_sight sight, sl_visibility *out) {
    sl_plan plan = sl_plan_make(map);
    plan.mirror_depth = depth;
    size_t count;
    const sl_see_method *method = sl_see_methods(&count);
    while (strcmp(method->name, "dfs") != 0) method++;
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    options.plan = &plan;
    options.trees = true;
    options.sight = sight;
    assert_ok(context, method->see(context, space, &options, out));
}

// --- what they hold

/// What a tree says of each of its nodes, the parents' before.
typedef struct told {
    uint32_t mirrors, depth;
} told;

/// The mirrors on the way to a node, and how many portals and mirrors.
static void tell(const trial *t, const sl_stab_node *nodes, uint64_t node, told *of) {
    const sl_stab_node *n = &nodes[node], *parent = &nodes[n->parent];
    of[node] = (told){of[n->parent].mirrors, of[n->parent].depth + 1};
    if (!sl_stab_is_mirror(n)) {
        const sl_cell *from = &t->space.cells[parent->cell];
        assert_true(n->directed - from->first_directed < from->directed_count);
        assert_int_equal(t->space.directed[n->directed].cell, n->cell);
        return;
    }
    sli_mirror_side side;
    of[node].mirrors++;
    assert_int_equal(n->cell, parent->cell);
    assert_true(n->directed != parent->directed);
    assert_true(n->directed - SL_STAB_MIRROR < t->map.mirror_count);
    assert_true(
        sli_mirror_side_of(&t->space, &t->map, n->cell, n->directed - SL_STAB_MIRROR, &side));
}

/// The cells at a tree's nodes are those that the source sees, directly and by mirror; no sequence
/// stands in it twice. Adds the nodes that are reflected more than once.
static void check_tree(const trial *t, const sl_visibility *baked, uint32_t source, size_t *twice) {
    const sl_stab_trees *trees = &baked->trees;
    const sl_stab_node *nodes = trees->nodes + trees->offsets[source];
    const uint64_t count = trees->offsets[source + 1] - trees->offsets[source];
    bool direct[CELLS_MOST] = {false}, mirrored[CELLS_MOST] = {false};
    assert_true(count > 0);
    told *of = calloc(count, sizeof *of);
    assert_non_null(of);
    for (uint64_t i = 0; i < count; i++) {
        if (i) tell(t, nodes, i, of);
        assert_true(of[i].mirrors <= t->depth);
        *twice += of[i].mirrors > 1;
        (of[i].mirrors ? mirrored : direct)[nodes[i].cell] = true;
        for (uint64_t k = nodes[i].parent + 1; k < i; k++)
            assert_true(nodes[k].parent != nodes[i].parent ||
                        nodes[k].directed != nodes[i].directed);
    }
    free(of);
    for (uint32_t c = 0; c < t->space.cell_count; c++) {
        assert_int_equal(direct[c], sl_pvs_sees(&baked->pvs, source, c));
        const bool seen = baked->mirrored.cell_count && sl_pvs_sees(&baked->mirrored, source, c);
        assert_int_equal(mirrored[c], seen);
    }
}

/// An eye on whose way a tree is sees by the tree what it sees without, directly.
static void check_eye(trial *t, const sl_visibility *baked) {
    const double x = 7 * sl_random_unit(&t->random), y = 7 * sl_random_unit(&t->random);
    const sl_view view = sl_view_all_round((sl_point){x, y});
    uint64_t with[CELLS_MOST / 64 + 1], without[CELLS_MOST / 64 + 1];
    const sl_visibility bare = {.sight = baked->sight};
    const sl_visibility *of[2] = {baked, &bare};
    sl_eye_account account;
    size_t count;
    const sl_eye_method *exact = sl_eye_methods(&count) + count - 1;
    for (int i = 0; i < 2; i++) {
        sli_eye_search *search;
        assert_ok(t->context, sli_eye_search_create(t->context, &t->space, of[i], &search));
        assert_ok(t->context, exact->cull(t->context, search, &view, i ? without : with, &account));
        sli_eye_search_destroy(t->context, search);
    }
    for (uint32_t c = 0; c < t->space.cell_count; c++)
        assert_int_equal(sl_eye_sees(with, c), sl_eye_sees(without, c));
}

/// The trees hold what the bake finds, which is held against brute force elsewhere.
static void trees_hold_what_is_seen(void **state) {
    (void)state;
    size_t twice = 0;
    for (uint64_t seed = 1; seed <= MAPS; seed++) {
        trial t;
        begin(&t, seed);
        // An eye has no range of pairs, and sees no way that glass bars.
        const bool plain = !(t.effects & (SL_EFFECT_RANGE | SL_EFFECT_ONEWAY));
        sl_visibility baked = {0};
        see(t.context, &t.space, &t.map, t.depth, seed & 1 ? SL_CLOSED : SL_OPEN, &baked);
        assert_int_equal(baked.trees.left_out, 0);
        assert_int_equal(baked.trees.offsets[t.space.cell_count], baked.account.nodes);
        for (uint32_t c = 0; c < t.space.cell_count; c++) check_tree(&t, &baked, c, &twice);
        for (int i = 0; plain && i < EYES; i++) check_eye(&t, &baked);
        sl_visibility_destroy(t.context, &baked);
        end(&t);
    }
    assert_true(twice > 100);
}

// --- the baked file

/// A room cut in two, with a mirror on its right wall and one that lies in the left part alone.
static void bake(sl_context *context, sl_baked *baked) {
    *baked = (sl_baked){.method = "dfs", .solver = "funnel"};
    testing_space(context,
                  "walls 0 0 9 0 9 9 0 9 0 0\nwall 4 0 4 5\nseam 4 5 4 9\n"
                  "mirror 9 1 9 8\nmirror 0 2 0 3\n",
                  &baked->map, &baked->space);
    see(context, &baked->space, &baked->map, 2, SL_CLOSED, &baked->visibility);
    baked->map.wall_count = 0;
}

static char *print(sl_context *context, const sl_baked *baked, size_t *size) {
    return baked_bytes(context, baked, size);
}

static void a_file_keeps_them(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_baked baked, back = {0};
    bake(context, &baked);
    size_t size, again_size;
    char *bytes = print(context, &baked, &size);
    assert_ok(context, sl_baked_parse(context, "mirrors", bytes, size, &back));
    const sl_stab_trees *trees = &baked.visibility.trees;
    const uint64_t nodes = trees->offsets[trees->cell_count];
    assert_int_equal(back.visibility.trees.offsets[trees->cell_count], nodes);
    assert_memory_equal(back.visibility.trees.nodes, trees->nodes, nodes * sizeof *trees->nodes);
    char *again = print(context, &back, &again_size);
    assert_int_equal(again_size, size);
    assert_memory_equal(again, bytes, size);
    free(bytes);
    free(again);
    sl_baked_destroy(context, &baked);
    sl_baked_destroy(context, &back);
    sl_context_destroy(context);
}

/// Seals a file in which one field of a node is another, and has it refused.
static void refuse(sl_context *context, const sl_baked *baked, uint64_t node, size_t offset,
                   uint32_t value) {
    size_t size;
    sl_baked back = {0};
    char *bytes = print(context, baked, &size);
    value = slv_u32(value);
    memcpy(slv_items(bytes, "TREN") + node * sizeof(sl_stab_node) + offset, &value, sizeof value);
    slv_seal(bytes, size);
    assert_int_equal(sl_baked_parse(context, "mirrors", bytes, size, &back), SL_BAD_INPUT);
    assert_non_null(strstr(sl_context_message(context), "is no tree"));
    free(bytes);
}

static void a_lie_about_mirrors_is_refused(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_baked baked;
    bake(context, &baked);
    const sl_stab_trees *trees = &baked.visibility.trees;
    size_t tried = 0;
    for (uint64_t i = 0; i < trees->offsets[trees->cell_count]; i++) {
        const sl_stab_node *node = &trees->nodes[i];
        if (!sl_stab_is_mirror(node)) continue;
        // No such mirror; one that the cell does not end at; the root's mark; another cell; an
        // directed portal.
        refuse(context, &baked, i, offsetof(sl_stab_node, directed), SL_STAB_MIRROR + 2);
        refuse(context, &baked, i, offsetof(sl_stab_node, directed), node->directed ^ 1);
        refuse(context, &baked, i, offsetof(sl_stab_node, directed), UINT32_MAX);
        refuse(context, &baked, i, offsetof(sl_stab_node, cell), node->cell ^ 1);
        refuse(context, &baked, i, offsetof(sl_stab_node, directed), 0);
        refuse(context, &baked, i, offsetof(sl_stab_node, parent), UINT32_MAX);
        tried++;
    }
    assert_true(tried > 3);
    sl_baked_destroy(context, &baked);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(trees_hold_what_is_seen),
        cmocka_unit_test(a_file_keeps_them),
        cmocka_unit_test(a_lie_about_mirrors_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

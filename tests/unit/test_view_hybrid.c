/// View cells by exact directed sets: what each piece of a room sees beside what the depth-first
/// search finds from a cell put there; what each view cell sees beside what the cells in it see
/// when its borders cut the space; work beside what was found.
///   test_view_hybrid [FILE ...]    these maps instead, and more of each
#include "view_cells_maps.h"

#include "cell_to_cell/search/directions.h"
#include "map_files.h"
#include "oracle/random_map.h"
#include "sightline/bake.h"
#include "sightline/stab.h"
#include "sightline/support.h"
#include "space/subdivide.h"
#include "study/view_cells/pieces.h"

enum { RANDOM_MAPS = 40, DEEPEST = 64 };

static void check_work(const sl_view_work *work) {
    assert_true(work->candidates >= work->relations);
    assert_int_equal(work->looks % 4, 0);
    assert_true(work->looks >= 4 * (work->rooms + work->cuts));
    assert_true(work->looks <= 4 * (work->rooms + 2 * work->cuts));
}

// --- pieces

/// A search of its own, over the space's directed portals, that asks for no more than the
/// definition: of all lines through two of the points at hand, or through one along an axis, one
/// that passes all directed portals so far and the piece. (The lines of a quadrant are a polygon in
/// the plane of lines: where there are any, one of these is among them; lines strictly between are
/// there where the middle of some three of them is one.)
typedef struct oracle {
    const sl_space *space;
    const sli_view_piece *piece;
    sl_portal_ends ends[DEEPEST];
    size_t depth;
    bool anyhow; ///< lines along the first directed portal count wherever that is
    sl_bits *seen;
} oracle;

static bool line_passes(const oracle *o, sl_line line) {
    for (size_t i = 0; i < o->depth; i++)
        if (sli_orient(line.a, line.b, o->ends[i].left) < 0 ||
            sli_orient(line.a, line.b, o->ends[i].right) > 0)
            return false;
    bool left = false, right = false;
    for (size_t i = 0; i < o->piece->corners.count; i++) {
        const int side = sli_orient(line.a, line.b, o->piece->corners.items[i]);
        left = left || side >= 0;
        right = right || side <= 0;
    }
    return left && right;
}

/// Whether going along a line some place of the first directed portal that it meets is not before
/// all places of the piece that it meets: a question only of lines along the directed portal, for
/// the piece is on its near side.
static bool is_ahead(const oracle *o, sl_line line) {
    const sl_portal_ends *first = &o->ends[0];
    if (sli_orient(line.a, line.b, first->left) || sli_orient(line.a, line.b, first->right))
        return true;
    const double dx = line.b.x - line.a.x, dy = line.b.y - line.a.y;
    double least = INFINITY;
    for (size_t i = 0; i < o->piece->corners.count; i++) {
        const sl_point p = o->piece->corners.items[i];
        if (sli_orient(line.a, line.b, p) == 0) least = fmin(least, dx * p.x + dy * p.y);
    }
    return fmax(dx * first->left.x + dy * first->left.y,
                dx * first->right.x + dy * first->right.y) >= least;
}

/// Whether all directed portals so far are crossed forwards by some direction, and by that of a
/// line as far as a limit of such directions may.
static bool is_forwards(const oracle *o, sl_line line) {
    for (size_t i = 0; i < o->depth; i++)
        if (sli_turn(line.a, line.b, o->ends[i].right, o->ends[i].left) < 0) return false;
    return true;
}

static bool any_line(const oracle *o) {
    sl_point points[2 * DEEPEST + 16];
    size_t count = 0;
    for (size_t i = 0; i < o->depth; i++) {
        points[count++] = o->ends[i].left;
        points[count++] = o->ends[i].right;
    }
    for (size_t i = 0; i < o->piece->corners.count; i++)
        points[count++] = o->piece->corners.items[i];
    const double unit = fabs(o->space->bounds.max.x - o->space->bounds.min.x);
    const sl_point axes[4] = {{unit, 0}, {0, unit}, {-unit, 0}, {0, -unit}};
    for (size_t a = 0; a < count; a++)
        for (size_t b = 0; b < count + 4; b++) {
            const sl_point p = points[a];
            const sl_line line = {
                p, b < count ? points[b]
                             : (sl_point){p.x + axes[b - count].x, p.y + axes[b - count].y}};
            if (line.a.x == line.b.x && line.a.y == line.b.y) continue;
            if (is_forwards(o, line) && line_passes(o, line) && (o->anyhow || is_ahead(o, line)))
                return true;
        }
    return false;
}

static void search(oracle *o, uint32_t cell, sli_directions crossings) {
    const sl_cell *c = &o->space->cells[cell];
    sl_bits_add(o->seen, cell);
    assert_true(o->depth < DEEPEST);
    for (uint32_t e = c->first_directed; e < c->first_directed + c->directed_count; e++) {
        const sl_directed_portal *directed = &o->space->directed[e];
        sli_directions with = crossings;
        if (!sli_directions_add(o->space, &with, e)) continue;
        o->ends[o->depth++] = (sl_portal_ends){directed->left, directed->right};
        if (any_line(o)) search(o, directed->cell, with);
        o->depth--;
    }
}

/// A little of a piece's sides is taken away: rounding may have put them outside the room.
static sli_view_piece inner(const sli_view_piece *piece) {
    const size_t count = piece->corners.count;
    sli_view_piece made = *piece;
    made.corners.items = malloc(count * sizeof *made.corners.items);
    sl_point middle = {0, 0};
    for (size_t i = 0; i < count; i++) {
        middle.x += piece->corners.items[i].x / (double)count;
        middle.y += piece->corners.items[i].y / (double)count;
    }
    for (size_t i = 0; i < count; i++) {
        const sl_point p = piece->corners.items[i];
        made.corners.items[i] =
            (sl_point){p.x + 1e-9 * (middle.x - p.x), p.y + 1e-9 * (middle.y - p.y)};
    }
    return made;
}

/// Holds each piece against it. Of a piece with oblique sides a line along a portal of its room may
/// count though the portal is behind. One that only touches a corner where a cut crosses such a
/// side need not count, as that corner is rounded.
static void check_pieces(const char *name, const sl_space *space, const sli_view_pieces *pieces,
                         bool axial) {
    const size_t words = sl_bits_words(space->cell_count);
    sl_bits *rows = calloc(3 * words, sizeof *rows);
    sl_bits *found = rows, *least = rows + words, *most = rows + 2 * words;
    for (size_t i = 0; i < pieces->items.count; i++) {
        const sli_view_piece *piece = &pieces->items.items[i];
        const uint32_t home = pieces->rooms.object[piece->room];
        memset(rows, 0, 3 * words * sizeof *rows);
        sli_view_piece_add_to(pieces, piece, found);
        const sli_view_piece within = inner(piece);
        oracle o = {.space = space, .piece = axial ? piece : &within, .seen = least};
        search(&o, home, SLI_NO_DIRECTIONS);
        free(within.corners.items);
        o = (oracle){.space = space, .piece = piece, .anyhow = true, .seen = axial ? least : most};
        if (!axial) search(&o, home, SLI_NO_DIRECTIONS);
        for (size_t w = 0; w < words; w++)
            if (least[w] & ~found[w] || found[w] & ~o.seen[w])
                fail_msg("%s: piece %zu of %zu sees other cells than the search finds", name, i,
                         pieces->items.count);
    }
    free(rows);
}

/// Cuts pieces at random: in their middle, beside it, and at coordinates of the map.
static void cut_at_random(sl_context *context, sli_view_pieces *pieces, const sl_map *map,
                          int cuts) {
    sl_random random = {17};
    for (int i = 0; i < cuts; i++) {
        const uint32_t number = (uint32_t)sl_random_below(&random, pieces->items.count);
        const int axis = (int)sl_random_below(&random, 2);
        const sli_view_extent *box = &pieces->items.items[number].box;
        const double low = box->low[axis], high = box->high[axis];
        const sl_point end = map->walls[sl_random_below(&random, map->wall_count)].a;
        double at = axis ? end.y : end.x;
        if (!(at > low && at < high)) at = low + (high - low) * (i % 3 ? 0.5 : 0.3);
        if (!(at > low && at < high)) continue;
        sli_view_searcher *searcher;
        sli_view_halves halves = {0};
        uint32_t above;
        assert_ok(context, sli_view_searcher_take(context, pieces, &searcher));
        assert_ok(context, sli_view_pieces_halve(context, pieces, searcher, number, axis, at, true,
                                                 true, &halves));
        sli_view_searcher_give(pieces, searcher);
        assert_ok(context, sli_view_pieces_cut(pieces, number, &halves, &above));
        assert_int_equal(above, pieces->items.count - 1);
    }
}

/// With closed sight; what open sight sees is held against the search with its solver below.
static void check_cuts(sl_context *context, const char *name, const sl_map *map,
                       const sl_space *space, int cuts, bool axial) {
    const sl_view_scene scene = {space, SL_VIEW_CELLS, sl_render_cost_default(), NULL};
    sli_view_pieces pieces;
    assert_ok(context, sli_view_pieces_create(context, &scene, SL_CLOSED, 2, &pieces));
    if (pieces.items.count) cut_at_random(context, &pieces, map, cuts);
    check_pieces(name, space, &pieces, axial);
    check_work(&pieces.work);
    sli_view_pieces_destroy(&pieces);
}

// --- view cells

static void check_same(const char *name, const sl_view_sets *less, const sl_view_sets *more,
                       bool same) {
    assert_int_equal(less->count, more->count);
    for (size_t i = 0; i < less->count * less->words; i++)
        if (less->bits[i] & ~more->bits[i] || (same && less->bits[i] != more->bits[i]))
            fail_msg("%s: view cell %zu of %u sees other cells than those in it", name,
                     i / less->words, less->count);
}

/// False where seams cannot be put into the map: of coordinates near the least that there are.
static bool see_exactly(sl_context *context, const sl_map *map, const sl_view_scene *scene,
                        const sl_view_tree *tree, sl_sight sight, sl_view_sets *sets) {
    sl_see_options seeing = sl_see_options_default();
    seeing.inside_only = true;
    seeing.solver = sl_funnel();
    seeing.sight = sight;
    const sl_status status =
        sl_view_sets_exact(context, map, scene, tree, testing_method("dfs"), &seeing, sets);
    if (status != SL_OK) assert_non_null(strstr(sl_context_message(context), "magnitudes from"));
    return status == SL_OK;
}

/// Of an axial map whose walls are clean. In the space that view cells' borders cut, a grazing line
/// may be lost where it would have to cross a border both ways: closed sight sees no more there.
static void check_sets(sl_context *context, const char *name, const sl_map *map,
                       const sl_space *space, uint32_t cells) {
    sl_view_places places;
    if (sl_view_places_inside(context, space, &places) != SL_OK) return;
    const sl_view_scene scene = {space, SL_VIEW_CELLS, sl_render_cost_default(), &places};
    for (int sight = SL_CLOSED; sight <= SL_OPEN; sight++) {
        sl_view_subdivision options = sl_view_subdivision_default();
        options.cells = cells;
        options.sight = (sl_sight)sight;
        sl_view_tree tree;
        sl_view_found found;
        assert_ok(context,
                  view_method("hybrid")->divide(context, &scene, NULL, &options, &tree, &found));
        check_work(&found.work);
        sl_view_sets expected = {0};
        if (see_exactly(context, map, &scene, &tree, options.sight, &expected))
            check_same(name, &expected, &found.sets, sight == SL_OPEN);
        sl_view_sets_destroy(context, &expected);
        sl_view_sets_destroy(context, &found.sets);
        sl_view_tree_destroy(context, &tree);
    }
    sl_view_places_destroy(context, &places);
}

static bool is_axial(const sl_map *map) {
    for (size_t i = 0; i < map->wall_count; i++)
        if (map->walls[i].a.x != map->walls[i].b.x && map->walls[i].a.y != map->walls[i].b.y)
            return false;
    return true;
}

static void check_file_with(const char *path, uint32_t cells) {
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space;
    map_files_read(context, path, &map);
    if (strstr(path, ".ug"))
        assert_ok(context, sl_map_add_start(context, &map, (sl_point){1398, 1630}, 0, 0));
    testing_subdivide(context, &map, &space);
    if (is_axial(&map))
        check_sets(context, path, &map, &space, cells);
    else
        check_cuts(context, path, &map, &space, (int)cells, false);
    sl_map_destroy(context, &map);
    sl_space_destroy(context, &space);
    sl_context_destroy(context);
}

static void check_file(const char *path) {
    check_file_with(path, 1);
    check_file_with(path, 70);
}

static void sets_are_those_of_the_search(void **state) {
    (void)state;
    map_files_each(MAP_FILES_ALL, check_file);
}

static void sets_are_those_of_the_search_on_random_maps(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    for (uint64_t seed = 1; seed <= RANDOM_MAPS; seed++) {
        sl_map map = {0};
        sl_space space;
        char name[32];
        snprintf(name, sizeof name, "seed %d", (int)seed);
        const sl_subdivide_options rules = sl_subdivide_options_default();
        assert_ok(context, oracle_random_map(context, 3300 + seed, (oracle_grid)(seed % 3), &map));
        assert_ok(context, sl_map_clean(context, &map, NULL, NULL));
        assert_ok(context, sli_subdivide_kd(context, &map, &rules, &space));
        check_cuts(context, name, &map, &space, 60, true);
        check_sets(context, name, &map, &space, 60);
        sl_map_destroy(context, &map);
        sl_space_destroy(context, &space);
    }
    sl_context_destroy(context);
}

/// Walls as objects: closed sight sees all that lines drawn at random do, and open sight little
/// that very many of them miss.
static void walls_are_seen_as_by_samples(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    for (int i = 0; i < ROOMS; i++) {
        view_world w;
        make_world(context, rooms_map(i), i > 0, SL_VIEW_WALLS, 100000, &w);
        for (int sight = SL_CLOSED; sight <= SL_OPEN; sight++) {
            sl_view_subdivision options = sl_view_subdivision_default();
            options.cells = 40;
            options.sight = (sl_sight)sight;
            sl_view_tree tree;
            sl_view_found found;
            sl_view_sets sampled;
            assert_ok(context, view_method("hybrid")->divide(context, &w.scene, NULL, &options,
                                                             &tree, &found));
            assert_ok(context,
                      sl_view_sets_sample(context, &w.scene, &tree, &w.segments, 1, &sampled));
            if (sight == SL_CLOSED) check_same("walls", &sampled, &found.sets, false);
            uint32_t pairs = 0, missed = 0;
            for (uint32_t cell = 0; cell < tree.cell_count; cell++)
                for (uint32_t o = 0; o < w.space.wall_count; o++) {
                    pairs += set_has(&found.sets, cell, o);
                    missed += set_has(&found.sets, cell, o) && !set_has(&sampled, cell, o);
                }
            if (sight == SL_OPEN) assert_true(pairs > 100 && 15 * missed < pairs);
            sl_view_sets_destroy(context, &sampled);
            sl_view_sets_destroy(context, &found.sets);
            sl_view_tree_destroy(context, &tree);
        }
        drop_world(context, &w);
    }
    sl_context_destroy(context);
}

/// A view cell may be split just above where something is seen; just above 0 is no place on a map.
static void splits_are_places_of_a_map(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    view_world w;
    make_world(context, "wall 0 4 0 7\nwall 7 4 7 9\nwall 5 9 7 9\nwall -1 10 10 10\n", false,
               SL_VIEW_CELLS, 100, &w);
    for (uint32_t cells = 2; cells < 12; cells++) {
        sl_view_subdivision options = sl_view_subdivision_default();
        options.cells = cells;
        sl_view_tree tree;
        sl_view_found found;
        assert_ok(context,
                  view_method("hybrid")->divide(context, &w.scene, NULL, &options, &tree, &found));
        for (uint32_t i = 0; i < tree.node_count; i++)
            assert_true(sl_coordinate_usable(tree.nodes[i].position));
        sl_view_sets_destroy(context, &found.sets);
        sl_view_tree_destroy(context, &tree);
    }
    drop_world(context, &w);
    sl_context_destroy(context);
}

/// The same tree, sets and work.
static void threads_make_no_difference(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    view_world w;
    make_world(context, OBLIQUE_ROOMS, true, SL_VIEW_WALLS, 1000, &w);
    sl_view_tree trees[3];
    sl_view_found found[3];
    for (unsigned i = 0; i < 3; i++) {
        sl_view_subdivision options = sl_view_subdivision_default();
        options.cells = 300;
        options.threads = i ? 3 * i - 1 : 1;
        assert_ok(context, view_method("hybrid")->divide(context, &w.scene, NULL, &options,
                                                         &trees[i], &found[i]));
        const sl_view_tree *a = &trees[0], *b = &trees[i];
        assert_int_equal(a->node_count, b->node_count);
        assert_int_equal(a->leaf_count, b->leaf_count);
        assert_memory_equal(a->nodes, b->nodes, a->node_count * sizeof *a->nodes);
        assert_memory_equal(a->first, b->first, (a->leaf_count + 1) * sizeof *a->first);
        assert_memory_equal(a->edges, b->edges, a->first[a->leaf_count] * sizeof *a->edges);
        assert_memory_equal(a->corners, b->corners, a->first[a->leaf_count] * sizeof *a->corners);
        const sl_view_sets *one = &found[0].sets, *other = &found[i].sets;
        assert_memory_equal(one->bits, other->bits, one->count * one->words * sizeof *one->bits);
        assert_memory_equal(&found[0].work, &found[i].work, sizeof found[0].work);
    }
    assert_int_equal(trees[0].cell_count, 300);
    for (int i = 0; i < 3; i++) {
        sl_view_tree_destroy(context, &trees[i]);
        sl_view_sets_destroy(context, &found[i].sets);
    }
    drop_world(context, &w);
    sl_context_destroy(context);
}

static void lack_of_memory_leaves_nothing(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    view_world w;
    make_world(context, TWO_ROOMS, false, SL_VIEW_WALLS, 1000, &w);
    sl_view_subdivision options = sl_view_subdivision_default();
    options.cells = 12;
    options.threads = 1; // the allocator that counts is one thread's
    const long live = memory.live;
    sl_status status = SL_NO_MEMORY;
    for (long fail_at = 1; status == SL_NO_MEMORY; fail_at++) {
        sl_view_tree tree = {0};
        sl_view_found found = {0};
        memory.calls = 0;
        memory.fail_at = fail_at;
        status = view_method("hybrid")->divide(context, &w.scene, NULL, &options, &tree, &found);
        memory.fail_at = 0;
        assert_true(status == SL_OK || (!tree.nodes && !found.sets.bits));
        sl_view_tree_destroy(context, &tree);
        sl_view_sets_destroy(context, &found.sets);
        assert_int_equal(memory.live, live);
    }
    assert_int_equal(status, SL_OK);
    drop_world(context, &w);
    sl_context_destroy(context);
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sets_are_those_of_the_search),
        cmocka_unit_test(sets_are_those_of_the_search_on_random_maps),
        cmocka_unit_test(walls_are_seen_as_by_samples),
        cmocka_unit_test(splits_are_places_of_a_map),
        cmocka_unit_test(threads_make_no_difference),
        cmocka_unit_test(lack_of_memory_leaves_nothing),
    };
    for (int i = 1; i < argc; i++) check_file_with(argv[i], 2000);
    return argc > 1 ? 0 : cmocka_run_group_tests(tests, NULL, NULL);
}

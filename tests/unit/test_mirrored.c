/// What one viewpoint sees by mirror, cell by cell and as a region, against brute force: random
/// axial maps with all combinations of effects, on a grid where images are doubles and on one where
/// they are not. SIGHTLINE_SEEDS in the environment: how many maps (96 by default).
#include "cell_to_cell/pvs_rows.h"
#include "effects/filtered.h"
#include "sight/eye_search.h"
#include "sight/moving.h"
#include "sight/region.h"
#include "space/outline.h"
#include "space/subdivide.h"
#include "testing.h"

#include "oracle/mirrored.h"
#include "oracle/random_effects.h"

#include <math.h>

enum { MAPS = 96, EYES = 4, CELLS_MOST = 128 };

typedef struct trial {
    sl_context *context;
    sl_random random;
    uint64_t seed;
    unsigned effects;
    double scale;
    sl_map map;
    sl_space whole, space; ///< as it was made; with doors shut and glass that is dark
    sl_space walled;       ///< the same with a wall on the dark side of glass
    sl_space shut;         ///< with doors shut alone
    bool is_shut[3];       ///< by door
    uint32_t depth;
} trial;

static void begin(trial *t, uint64_t seed) {
    *t = (trial){.context = testing_context(NULL), .random = {seed}, .seed = seed};
    t->effects = SL_EFFECT_MIRROR | ((unsigned)seed & 1 ? SL_EFFECT_DOOR : 0) |
                 ((unsigned)seed & 2 ? SL_EFFECT_ONEWAY : 0) |
                 ((unsigned)seed & 4 ? SL_EFFECT_RANGE : 0);
    t->scale = seed & 8 ? 0.1 : 1;
    t->depth = 1 + (uint32_t)sl_random_below(&t->random, 3);
    random_effects_map(t->context, &t->random, t->effects, t->scale, &t->map);
    // Distances that are the range, to the last bit.
    if (t->map.range > 0 && sl_random_below(&t->random, 2))
        t->map.range = (double)(1 + sl_random_below(&t->random, 20)) * t->scale / 2;
    const sl_subdivide_options options = sl_subdivide_options_default();
    assert_ok(t->context, sli_subdivide_kd(t->context, &t->map, &options, &t->whole));
    bool *shut = t->is_shut;
    for (int i = 0; i < 3; i++) shut[i] = sl_random_below(&t->random, 2);
    sli_filtered_space filtered = {.shut = shut, .one_way = true};
    assert_ok(t->context,
              sli_filtered_space_make(t->context, &t->whole, &filtered, NULL, &t->space));
    filtered.dark_walls = true;
    assert_ok(t->context,
              sli_filtered_space_make(t->context, &t->whole, &filtered, NULL, &t->walled));
    const sli_filtered_space doors = {.shut = shut};
    assert_ok(t->context, sli_filtered_space_make(t->context, &t->whole, &doors, NULL, &t->shut));
    assert_true(t->space.cell_count <= CELLS_MOST);
}

static void end(trial *t) {
    sl_space_destroy(t->context, &t->whole);
    sl_space_destroy(t->context, &t->space);
    sl_space_destroy(t->context, &t->walled);
    sl_space_destroy(t->context, &t->shut);
    sl_map_destroy(t->context, &t->map);
    sl_context_destroy(t->context);
}

static void complain(const trial *t, const sl_view *view, const char *what) {
    for (size_t i = 0; i < t->map.wall_count; i++)
        print_error("wall %g %g %g %g\n", t->map.walls[i].a.x, t->map.walls[i].a.y,
                    t->map.walls[i].b.x, t->map.walls[i].b.y);
    for (size_t i = 0; i < t->map.mirror_count; i++) {
        const sl_segment m = t->map.mirrors[i].segment;
        print_error("mirror %g %g %g %g%s\n", m.a.x, m.a.y, m.b.x, m.b.y,
                    t->map.mirrors[i].one_sided ? " one" : "");
    }
    for (uint32_t i = 0; i < t->space.directed_count; i++) {
        const sl_directed_portal *directed = &t->space.directed[i];
        print_error("exit to %u: left %g %g right %g %g\n", directed->cell, directed->left.x,
                    directed->left.y, directed->right.x, directed->right.y);
    }
    for (uint32_t i = 0; i < t->space.cell_count; i++) {
        const sl_point *v = t->space.vertices + t->space.cells[i].first_vertex;
        print_error("cell %u: %g %g to %g %g\n", i, v[0].x, v[0].y, v[2].x, v[2].y);
    }
    fail_msg("seed %llu, depth %u, eye %.17g,%.17g full %d right %g,%g left %g,%g: %s",
             (unsigned long long)t->seed, t->depth, view->eye.x, view->eye.y, view->full,
             view->right.x, view->right.y, view->left.x, view->left.y, what);
}

static void compare_cells(const trial *t, const sl_view *view, const uint64_t *cells,
                          const bool *expected, sl_sight sight, const char *how) {
    for (uint32_t c = 0; c < t->space.cell_count; c++) {
        if (sl_eye_sees(cells, c) == expected[c]) continue;
        char text[160];
        snprintf(text, sizeof text, "%s sight, range %.17g: cell %u (at %g,%g) is %s %s",
                 sight == SL_OPEN ? "open" : "closed", t->map.range, c,
                 t->space.vertices[t->space.cells[c].first_vertex].x,
                 t->space.vertices[t->space.cells[c].first_vertex].y,
                 expected[c] ? "hidden, but seen" : "seen, but hidden", how);
        complain(t, view, text);
    }
}

static void ask_cells(const trial *t, const sl_view *view, const oracle_mirrored *truth,
                      sl_sight sight) {
    const sl_visibility bare = {.sight = sight};
    uint64_t cells[CELLS_MOST / 64 + 1];
    sli_eye_search *search;
    sl_eye_account account;
    size_t count;
    const sl_eye_method *exact = sl_eye_methods(&count) + count - 1;
    assert_ok(t->context, sli_eye_search_create(t->context, &t->space, &bare, &search));
    assert_ok(t->context, sli_eye_search_add_mirrors(t->context, search, &t->map, t->depth));
    sli_eye_search_set_range(search, t->map.range);
    assert_ok(t->context, exact->mirrored(t->context, search, view, cells, &account));
    assert_int_equal(account.rounded, 0);
    compare_cells(t, view, cells, sight == SL_OPEN ? truth->open : truth->closed, sight,
                  "by mirror");
    assert_ok(t->context, exact->cull(t->context, search, view, cells, &account));
    compare_cells(t, view, cells, sight == SL_OPEN ? truth->direct_open : truth->direct_closed,
                  sight, "directly");
    sli_eye_search_destroy(t->context, search);
}

static size_t chain_of(const trial *t, const sl_mirrored_region *region, uint32_t part) {
    if (part == SL_NO_PART) return 0;
    const sl_mirror_part *p = &region->parts[part];
    return chain_of(t, region, p->parent) * (t->map.mirror_count + 1) + p->mirror + 1;
}

static double area_of_polygon(const sl_point *points, size_t count) {
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        const sl_point p = points[i], q = points[i + 1 < count ? i + 1 : 0], o = points[0];
        sum += (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
    }
    return sum / 2;
}

/// What holds of a part by itself: it goes round counter-clockwise, one edge on its mirror, and its
/// image is the same polygon, turned over by each reflection.
static void check_part(const trial *t, const sl_view *view, const sl_mirror_part *part) {
    const sl_region *r = &part->region;
    const sl_segment mirror = t->map.mirrors[part->mirror].segment;
    size_t on_mirror = 0;
    if (part->rounded) complain(t, view, "a part is rounded");
    for (size_t i = 0; i < r->count; i++) {
        const sl_point p = r->points[i], q = r->points[i + 1 < r->count ? i + 1 : 0];
        if (r->edges[i].kind != SL_EDGE_MIRROR) continue;
        on_mirror++;
        const bool upright = mirror.a.x == mirror.b.x;
        if (!(t->map.range > 0))
            assert_true(upright ? p.x == mirror.a.x && q.x == mirror.a.x
                                : p.y == mirror.a.y && q.y == mirror.a.y);
    }
    if (on_mirror != 1) complain(t, view, "a part has not one edge on its mirror");
    const double real = area_of_polygon(r->points, r->count);
    const double image = area_of_polygon(part->image, r->count);
    const double sign = part->depth % 2 ? -1 : 1, slack = 1e-12 * t->scale * t->scale;
    if (real < -slack || fabs(real - sign * image) > 1000 * slack)
        complain(t, view, "a part and its image differ");
}

static void ask_region(const trial *t, const sl_space *space, const sl_view *view,
                       const oracle_mirrored *truth) {
    sl_outline outline;
    sli_room_mirrors mirrors;
    sl_mirrored_region region = {0};
    const size_t chains = oracle_chains(&t->map, t->depth);
    double *areas = calloc(chains, sizeof *areas);
    assert_non_null(areas);
    assert_ok(t->context, sli_outline_make(t->context, space, &outline));
    assert_ok(t->context, sli_room_mirrors_make(t->context, &outline, &t->map, &mirrors));
    assert_ok(t->context, sli_mirrored_region_make(t->context, &mirrors, view, t->map.range,
                                                   t->depth, &region));
    areas[0] = sl_region_area(&region.direct);
    for (uint32_t i = 0; i < region.part_count; i++) {
        areas[chain_of(t, &region, i)] += sl_region_area(&region.parts[i].region);
        check_part(t, view, &region.parts[i]);
        for (size_t k = 0; k < region.parts[i].region.count; k++) {
            const sl_point image = region.parts[i].image[k];
            const sl_point placed =
                sl_mirror_part_place(mirrors.map, &region, i, region.parts[i].region.points[k]);
            if (placed.x != image.x || placed.y != image.y)
                complain(t, view, "a corner of a part is not placed where its image is");
        }
    }
    for (size_t i = 0; i < chains; i++) {
        if (fabs(areas[i] - truth->areas[i]) <= 1e-10 * t->scale * t->scale) continue;
        char text[128];
        snprintf(text, sizeof text, "chain %zu: area %.15g, not %.15g (range %g)", i, areas[i],
                 truth->areas[i], t->map.range);
        complain(t, view, text);
    }
    sl_mirrored_region_destroy(t->context, &region);
    sli_room_mirrors_destroy(t->context, &mirrors);
    sli_outline_destroy(t->context, &outline);
    free(areas);
}

static sl_view random_view(trial *t) {
    sl_point eye;
    do eye = random_effects_point(&t->random, t->scale);
    while (sl_space_locate(&t->space, eye) == SL_NO_CELL);
    const bool full = sl_random_below(&t->random, 2);
    return random_effects_view(&t->random, eye, full, t->scale);
}

static void random_maps(void **state) {
    (void)state;
    const uint64_t maps = testing_seeds(MAPS);
    size_t seen = 0, areas = 0;
    for (uint64_t seed = 1; seed <= maps; seed++) {
        trial t;
        begin(&t, seed);
        for (int i = 0; i < EYES; i++) {
            const sl_view view = random_view(&t);
            oracle_mirrored truth =
                oracle_mirrored_of(&t.space, &t.map, &view, t.map.range, t.depth);
            ask_cells(&t, &view, &truth, SL_CLOSED);
            ask_cells(&t, &view, &truth, SL_OPEN);
            if (!truth.on_wall) ask_region(&t, &t.walled, &view, &truth);
            for (uint32_t c = 0; c < t.space.cell_count; c++) seen += truth.open[c];
            areas += !truth.on_wall && truth.areas[1] > 0;
            oracle_mirrored_free(&truth);
        }
        end(&t);
    }
    assert_true(seen > maps);
    assert_true(areas > maps / 4);
}

// --- past glass

/// The region of an eye, and the cells that it sees, where glass that is dark for it is a wall.
static void past_glass(void **state) {
    (void)state;
    const uint64_t maps = testing_seeds(MAPS);
    size_t count, darkened = 0;
    const sl_eye_method *exact = sl_eye_methods(&count) + count - 1;
    for (uint64_t seed = 2; seed <= 4 * maps; seed += 4) {
        trial t;
        begin(&t, seed);
        t.depth = 0;
        for (int i = 0; i < EYES; i++) {
            const sl_view view = random_view(&t);
            const sli_filtered_space filtered = {.eye = &view.eye};
            const sl_visibility bare = {.sight = SL_OPEN};
            uint64_t cells[CELLS_MOST / 64 + 1];
            sl_eye_account account;
            sli_eye_search *search;
            trial past = t, all = t;
            // Of what the glass itself says, and of its being a wall.
            const sli_filtered_space one_way = {.one_way = true};
            assert_ok(t.context,
                      sli_filtered_space_make(t.context, &t.whole, &one_way, NULL, &all.space));
            assert_ok(t.context,
                      sli_filtered_space_make(t.context, &t.whole, &filtered, NULL, &past.space));
            assert_ok(t.context, sl_space_check(t.context, &past.space));
            oracle_mirrored truth = oracle_mirrored_of(&all.space, &t.map, &view, t.map.range, 0);
            if (!truth.on_wall) ask_region(&past, &past.space, &view, &truth);
            assert_ok(t.context, sli_eye_search_create(t.context, &past.space, &bare, &search));
            sli_eye_search_set_range(search, t.map.range);
            assert_ok(t.context, exact->cull(t.context, search, &view, cells, &account));
            compare_cells(&all, &view, cells, truth.direct_open, SL_OPEN, "past glass");
            sli_eye_search_destroy(t.context, search);
            darkened += past.space.wall_count > t.whole.wall_count;
            oracle_mirrored_free(&truth);
            sl_space_destroy(t.context, &past.space);
            sl_space_destroy(t.context, &all.space);
        }
        end(&t);
    }
    assert_true(darkened > maps / 2);
}

// --- past boxes that move

enum { BOXES = 3 };

static double grid_place(trial *t) {
    return (double)sl_random_below(&t->random, 2 * RANDOM_EFFECTS_SIZE + 1) * t->scale / 2;
}

static sl_moving_box random_box(trial *t) {
    const double x0 = grid_place(t), y0 = grid_place(t);
    const double x1 = x0 + t->scale * (double)(1 + sl_random_below(&t->random, 4)) / 2;
    const double y1 = y0 + t->scale * (double)(1 + sl_random_below(&t->random, 4)) / 2;
    return (sl_moving_box){{{x0, y0}, {x1, y1}}, sl_random_below(&t->random, 3) > 0};
}

static bool touch(sl_box a, sl_box b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y;
}

/// Whether a box is seen just where one gets into it: it holds neither the eye nor a mirror.
static bool is_plain(const trial *t, sl_box box, sl_point eye) {
    if (touch(box, (sl_box){eye, eye})) return false;
    for (size_t i = 0; i < t->map.mirror_count; i++) {
        const sl_segment m = t->map.mirrors[i].segment;
        if (touch(box, (sl_box){{fmin(m.a.x, m.b.x), fmin(m.a.y, m.b.y)},
                                {fmax(m.a.x, m.b.x), fmax(m.a.y, m.b.y)}}))
            return false;
    }
    return true;
}

/// The oracle's word on a space with boxes, in cells of the space without them.
static void compare_past(const trial *t, sli_moving *moving, const sl_view *view, sl_sight sight,
                         const oracle_mirrored *truth, const uint64_t *cells) {
    const uint32_t *parents;
    const sl_space *boxed = sli_moving_space(moving, &parents);
    bool expected[CELLS_MOST] = {false};
    for (uint32_t c = 0; c < boxed->cell_count; c++)
        expected[parents[c]] |= sight == SL_OPEN ? truth->open[c] : truth->closed[c];
    compare_cells(t, view, cells, expected, sight, "by mirror past boxes");
}

/// The oracle on a space with boxes, whose directed portals tell where glass is dark.
static oracle_mirrored ask_past(const trial *t, const sl_moving_box *boxes, size_t count,
                                const sl_view *view) {
    const sl_visibility bare = {.sight = SL_OPEN};
    const sli_filtered_space one_way = {.one_way = true};
    sli_moving *moving;
    sl_space dark;
    assert_ok(t->context, sli_moving_create(t->context, &t->shut, &bare, &moving));
    assert_ok(t->context, sli_moving_set_boxes(t->context, moving, boxes, count));
    assert_ok(t->context, sli_filtered_space_make(t->context, sli_moving_space(moving, NULL),
                                                  &one_way, NULL, &dark));
    oracle_mirrored truth = oracle_mirrored_of(&dark, &t->map, view, t->map.range, t->depth);
    sl_space_destroy(t->context, &dark);
    sli_moving_destroy(t->context, moving);
    return truth;
}

/// Whether a cell within a box is seen by mirror, with nothing of the box in the way.
static bool is_entered(const trial *t, sli_moving *moving, sl_box box, const sl_view *view) {
    const sl_moving_box glass = {box, false};
    assert_ok(t->context, sli_moving_set_boxes(t->context, moving, &glass, 1));
    const sl_space *boxed = sli_moving_space(moving, NULL);
    oracle_mirrored truth = ask_past(t, &glass, 1, view);
    bool entered = false;
    for (uint32_t c = 0; c < boxed->cell_count; c++) {
        const sl_point *v = boxed->vertices + boxed->cells[c].first_vertex;
        entered |= truth.open[c] && v[0].x >= box.min.x && v[0].y >= box.min.y &&
                   v[2].x <= box.max.x && v[2].y <= box.max.y;
    }
    oracle_mirrored_free(&truth);
    return entered;
}

static void try_boxes(trial *t, sl_sight sight, size_t *seen, size_t *hidden) {
    const sl_visibility bare = {.sight = sight};
    const sl_view view = random_view(t);
    sl_moving_box boxes[BOXES];
    sli_moving *moving;
    uint64_t cells[CELLS_MOST / 64 + 1];
    bool met[BOXES];
    sl_eye_account account;
    const size_t count = sight == SL_OPEN ? 1 : 1 + sl_random_below(&t->random, BOXES);
    for (size_t i = 0; i < count; i++) boxes[i] = random_box(t);
    assert_ok(t->context, sli_moving_create(t->context, &t->shut, &bare, &moving));
    if (t->effects & SL_EFFECT_ONEWAY)
        assert_ok(t->context, sli_moving_add_glass(t->context, moving));
    assert_ok(t->context, sli_moving_add_mirrors(t->context, moving, &t->map, t->depth));
    sli_moving_set_range(moving, t->map.range);
    assert_ok(t->context, sli_moving_set_boxes(t->context, moving, boxes, count));
    const sl_space *boxed = sli_moving_space(moving, NULL);
    oracle_mirrored truth = ask_past(t, boxes, count, &view);
    assert_ok(t->context,
              sli_moving_look_mirrored(t->context, moving, &view, cells, met, &account));
    compare_past(t, moving, &view, sight, &truth, cells);
    trial past = *t;
    past.space = *boxed;
    if (!truth.on_wall) ask_region(&past, &past.space, &view, &truth);
    oracle_mirrored_free(&truth);
    if (count == 1 && sight == SL_OPEN && is_plain(t, boxes[0].box, view.eye)) {
        // One that blocks may stand between itself and a mirror.
        const bool entered = is_entered(t, moving, boxes[0].box, &view);
        if (met[0] ? !entered : entered && !boxes[0].blocks)
            complain(t, &view, met[0] ? "a box is seen by mirror, but hidden" : "a box is hidden");
        *(met[0] ? seen : hidden) += 1;
    }
    sli_moving_destroy(t->context, moving);
}

static void past_boxes(void **state) {
    (void)state;
    const uint64_t maps = testing_seeds(MAPS);
    size_t seen = 0, hidden = 0;
    for (uint64_t seed = 1; seed <= maps; seed++) {
        trial t;
        begin(&t, seed);
        for (int i = 0; i < 5; i++) try_boxes(&t, i < 2 ? SL_CLOSED : SL_OPEN, &seen, &hidden);
        end(&t);
    }
    assert_true(seen > maps / 30 && hidden > maps / 30);
}

// --- told

/// Each bend lies on its mirror, and the line leaves it as it came.
static void check_bends(const trial *t, const sl_bent_sightline *bent) {
    uint32_t bend = 0;
    for (uint32_t i = 0; i < bent->step_count; i++) {
        if (bent->steps[i].mirror == UINT32_MAX) continue;
        const sl_segment mirror = t->map.mirrors[bent->steps[i].mirror].segment;
        const bool upright = mirror.a.x == mirror.b.x;
        const sl_point p = bent->bends[bend], q = bent->bends[bend + 1], r = bent->bends[bend + 2];
        const double in = hypot(q.x - p.x, q.y - p.y), on = hypot(r.x - q.x, r.y - q.y);
        assert_true(fabs(upright ? q.x - mirror.a.x : q.y - mirror.a.y) < 1e-12);
        if (in > 1e-3 && on > 1e-3) {
            const double sign = upright ? -1 : 1;
            assert_true(fabs((q.x - p.x) / in * sign - (r.x - q.x) / on) < 1e-9);
            assert_true(fabs((q.y - p.y) / in * -sign - (r.y - q.y) / on) < 1e-9);
        }
        bend++;
    }
    assert_int_equal(bend, bent->mirrors);
}

/// Who sees whom without some effects, by bakes.
typedef struct bakes {
    unsigned effects;       ///< that can hide something
    sl_visibility seen[16]; ///< by the bits left out
} bakes;

static void bake_without(const trial *t, const sl_see_options *usual, unsigned without,
                         sl_visibility *out) {
    sl_plan plan = sl_plan_make(&t->map);
    sl_see_options options = *usual;
    plan.mirror_depth = t->depth;
    plan.effects &= ~without;
    if (without & SL_EFFECT_RANGE) plan.range = 0;
    options.plan = &plan;
    assert_ok(t->context, testing_method("dfs")->see(t->context, &t->whole, &options, out));
}

static bool bake_sees(const trial *t, const bakes *b, unsigned without, bool mirrored,
                      uint32_t from, uint32_t to) {
    const sl_visibility *v = &b->seen[without];
    if (!sl_pvs_sees(mirrored ? &v->mirrored : &v->pvs, from, to)) return false;
    return without & SL_EFFECT_DOOR ||
           sli_door_sets_open(mirrored ? &v->mirrored_doors : &v->doors, from, to, t->is_shut);
}

/// The effect that is said to decide is the one without which a bake sees the pair.
static void check_verdict(const trial *t, const bakes *b, const sl_effect_verdict *said,
                          bool mirrored, uint32_t from, uint32_t to) {
    const bool seen = bake_sees(t, b, 0, mirrored, from, to);
    unsigned decides = 0, without = 0;
    for (unsigned size = 1; size <= 3 && !seen && !without; size++)
        for (unsigned bits = 1; bits <= b->effects; bits++) {
            if (bits & ~b->effects || (unsigned)__builtin_popcount(bits) != size ||
                !bake_sees(t, b, bits, mirrored, from, to))
                continue;
            if (size == 1) decides |= bits;
            if (!without) without = bits;
        }
    if (said->seen != seen || said->decides != decides || said->without != without)
        fail_msg("seed %llu, cells %u and %u, mirrored %d: seen %d, not %d; %x and %x decide, not "
                 "%x and %x",
                 (unsigned long long)t->seed, from, to, mirrored, said->seen, seen, said->decides,
                 said->without, decides, without);
}

/// What explaining finds is what the bake finds; and the effect that decides is the one that does.
static void explained_as_baked(void **state) {
    (void)state;
    const uint64_t maps = testing_seeds(MAPS);
    size_t found = 0, twice = 0, decided[2] = {0, 0}, together = 0;
    for (uint64_t seed = 1; seed <= maps; seed++) {
        trial t;
        begin(&t, seed);
        sl_see_options options = sl_see_options_default();
        sl_explain_options how = sl_explain_options_default();
        options.solver = sl_funnel();
        options.sight = how.sight = seed / 8 % 2 ? SL_CLOSED : SL_OPEN;
        bakes b = {.effects = t.effects & (SL_EFFECT_ONEWAY | SL_EFFECT_RANGE)};
        for (int i = 0; i < 3 && t.effects & SL_EFFECT_DOOR; i++)
            if (t.is_shut[i]) b.effects |= SL_EFFECT_DOOR;
        for (unsigned bits = 0; bits <= b.effects; bits++)
            if (!(bits & ~b.effects)) bake_without(&t, &options, bits, &b.seen[bits]);
        const sl_explain_state as = {t.is_shut, t.depth};
        for (uint32_t from = 0; from < t.whole.cell_count; from++)
            for (uint32_t to = 0; to < t.whole.cell_count; to++) {
                sl_effect_explanation e;
                assert_ok(t.context,
                          sl_explain_effects(t.context, &t.whole, &t.map, &as, &how, from, to, &e));
                check_verdict(&t, &b, &e.direct, false, from, to);
                check_verdict(&t, &b, &e.mirrored, true, from, to);
                if (e.now.bent.bends) check_bends(&t, &e.now.bent);
                if (e.bent_without.bends) check_bends(&t, &e.bent_without);
                if (e.direct.without && !e.without.seen) fail_msg("what is without is hidden");
                if (t.map.range > 0 && e.now.seen && !(e.now.length <= t.map.range * (1 + 1e-9)))
                    fail_msg("a sightline of %g within %g", e.now.length, t.map.range);
                found += e.now.bent.mirrors > 0;
                twice += e.now.bent.mirrors > 1;
                decided[0] += e.direct.decides != 0;
                decided[1] += e.mirrored.decides != 0;
                together += e.direct.without && !e.direct.decides;
                sl_effect_explanation_destroy(t.context, &e);
            }
        for (size_t i = 0; i < sizeof b.seen / sizeof *b.seen; i++)
            sl_visibility_destroy(t.context, &b.seen[i]);
        end(&t);
    }
    if (maps < MAPS) return; // too few for the rare ones
    assert_true(found > 8 * maps && twice > maps / 16);
    assert_true(decided[0] > 4 * maps && decided[1] > 4 * maps && together > 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_maps),
        cmocka_unit_test(past_glass),
        cmocka_unit_test(past_boxes),
        cmocka_unit_test(explained_as_baked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

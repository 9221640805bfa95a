// What the runtime's polygon shows in mirrors: against brute force in random axial maps with all
// effects, and against the library among oblique mirrors. Areas are compared by the mirrors, one
// after the other, by which a part is seen.
#include "testing.h"

#include "effects/filtered.h"
#include "oracle/mirrored.h"
#include "oracle/random_effects.h"
#include "oracle/random_oblique.h"
#include "polygon_same.h"
#include "runtime_maps.h"
#include "sightline/query.h"

#include <math.h>

enum { MAPS = 320, EYES = 6, PARTS = 4096, ROOM = 1 << 16, CHAINS = 1 << 9 };

typedef struct trial {
    sl_context *context;
    sl_random random;
    uint64_t seed;
    double scale;
    uint32_t depth;
    baked_file f;
    bool is_shut[3]; ///< by door
    unsigned char shut[3];
    uint32_t *scratch;
    sl_runtime_mirror_part parts[PARTS];
    uint32_t part_count;
    sl_point points[ROOM];
    double areas[CHAINS]; ///< by chain, as oracle_mirrored
    size_t seen, deep, rounded;
} trial;

static void begin(trial *t, uint64_t seed, double degrees) {
    t->random = (sl_random){seed};
    t->seed = seed;
    t->scale = seed & 8 ? 0.1 : 1;
    t->depth = 1 + (uint32_t)sl_random_below(&t->random, 3);
    t->f = (baked_file){.name = "random", .baked = {.method = "dfs", .solver = "funnel"}};
    sl_map *map = &t->f.baked.map;
    const unsigned effects = SL_EFFECT_MIRROR | (seed & 1 ? SL_EFFECT_DOOR : 0) |
                             (seed & 2 && degrees == 0 ? SL_EFFECT_ONEWAY : 0) |
                             (seed & 4 ? SL_EFFECT_RANGE : 0);
    random_effects_map(t->context, &t->random, effects, t->scale, map);
    if (degrees != 0) {
        oblique_turn_map(map, degrees, 0);
        assert_ok(t->context, sl_map_clean(t->context, map, NULL, NULL));
    }
    baked_file_make(t->context, &t->f, false);
    for (int i = 0; i < 3; i++) t->shut[i] = t->is_shut[i] = sl_random_below(&t->random, 2);
    t->scratch = malloc(sl_runtime_scratch_count(&t->f.runtime) * sizeof *t->scratch);
    assert_non_null(t->scratch);
}

static void end(trial *t) {
    free(t->scratch);
    baked_file_destroy(t->context, &t->f);
}

static void complain(const trial *t, const sl_view *view, const char *what, double is,
                     double not ) {
    fail_msg("seed %llu, depth %u: %s %.17g, not %.17g; eye %.17g %.17g, full %d, right %.17g "
             "%.17g, left %.17g %.17g",
             (unsigned long long)t->seed, t->depth, what, is, not, view->eye.x, view->eye.y,
             view->full, view->right.x, view->right.y, view->left.x, view->left.y);
}

/// The chain of mirrors by which a part is seen, as oracle_mirrored numbers it.
static size_t chain_of(const trial *t, uint32_t part) {
    const sl_runtime_mirror_part *p = &t->parts[part];
    if (!p->depth) return 0;
    assert_true(p->parent < part && t->parts[p->parent].depth + 1 == p->depth);
    return chain_of(t, p->parent) * (t->f.baked.map.mirror_count + 1) + p->mirror + 1;
}

/// A part by itself: counter-clockwise about the image, with its ends on the mirror, and before it.
static void check_part(trial *t, const sl_view *view, const sl_runtime_mirror_part *part) {
    const sl_point *p = t->points + part->first, eye = {part->eye[0], part->eye[1]};
    const double error = 64 * polygon_error(&t->f.baked.space.bounds);
    assert_true(part->count >= 3);
    for (uint32_t i = 0; i + (part->depth > 0) < part->count; i++) {
        const sl_point a = p[i], b = p[(i + 1) % part->count];
        const double turn = (a.x - eye.x) * (b.y - eye.y) - (a.y - eye.y) * (b.x - eye.x);
        const double far = hypot(a.x - eye.x, a.y - eye.y) + hypot(b.x - eye.x, b.y - eye.y);
        if (turn < -error * far) complain(t, view, "a turn", turn, 0);
    }
    if (!part->depth) return;
    const sl_segment mirror = t->f.baked.map.mirrors[part->mirror].segment;
    const double off = fmax(polygon_distance(p[0], mirror.a, mirror.b),
                            polygon_distance(p[part->count - 1], mirror.a, mirror.b));
    if (off > error) complain(t, view, "a part is off its mirror by", off, 0);
    // The eye sees straight on what its image sees in the map.
    const double x = part->frame[0] * eye.x + part->frame[1] * eye.y + part->frame[2];
    const double y = part->frame[3] * eye.x + part->frame[4] * eye.y + part->frame[5];
    const double away = hypot(x - view->eye.x, y - view->eye.y);
    if (away > error) complain(t, view, "the image's image is off by", away, 0);
    t->deep += part->depth > 1;
    t->rounded += part->rounded;
}

/// Makes the parts and sums up their areas by chain.
static void look(trial *t, const sl_view *view) {
    const sl_point eye = view->eye;
    const sl_runtime_view same = {eye.x,
                                  eye.y,
                                  view->full,
                                  {view->right.x - eye.x, view->right.y - eye.y},
                                  {view->left.x - eye.x, view->left.y - eye.y}};
    const uint32_t count =
        sl_runtime_visible_polygon_mirrored(&t->f.runtime, &same, t->shut, 0, t->depth, t->scratch,
                                            t->parts, PARTS, &t->part_count, &t->points[0].x, ROOM);
    uint32_t all = 0;
    assert_true(count <= ROOM && t->part_count <= PARTS);
    memset(t->areas, 0, sizeof t->areas);
    for (uint32_t i = 0; i < t->part_count; i++) {
        const sl_runtime_mirror_part *part = &t->parts[i];
        const sl_point image = {part->eye[0], part->eye[1]};
        assert_true(part->first == all);
        all += part->count;
        check_part(t, view, part);
        t->areas[chain_of(t, i)] += polygon_area(image, t->points + part->first, part->count);
    }
    assert_int_equal(all, count);
    t->seen += t->part_count > 1;
}

static void compare_areas(const trial *t, const sl_view *view, const double *truth, size_t count,
                          double slack) {
    const double range = t->f.baked.map.range, chords = 4.1e-4 * 3.15 * range * range;
    for (size_t i = 0; i < count; i++) {
        char what[64];
        if (t->areas[i] <= truth[i] + slack && t->areas[i] >= truth[i] - slack - chords) continue;
        snprintf(what, sizeof what, "chain %zu, range %g: area", i, range);
        complain(t, view, what, t->areas[i], truth[i]);
    }
}

static sl_view random_view(trial *t) {
    const sl_point eye = random_effects_point(&t->random, t->scale);
    const bool full = t->scale != 1 || sl_random_below(&t->random, 2); // differences must be exact
    return random_effects_view(&t->random, eye, full, t->scale);
}

static void as_brute_force_says(void **state) {
    (void)state;
    static trial t;
    const uint64_t maps = testing_seeds(MAPS);
    t.context = testing_context(NULL);
    for (uint64_t seed = 1; seed <= maps; seed++) {
        sl_space space = {0};
        begin(&t, seed, 0);
        const sli_filtered_space filtered = {.shut = t.is_shut, .one_way = true};
        assert_ok(t.context,
                  sli_filtered_space_make(t.context, &t.f.baked.space, &filtered, NULL, &space));
        for (int i = 0; i < EYES; i++) {
            const sl_map *map = &t.f.baked.map;
            const sl_view view = random_view(&t);
            oracle_mirrored truth = oracle_mirrored_of(&space, map, &view, map->range, t.depth);
            look(&t, &view);
            if (!truth.on_wall)
                compare_areas(&t, &view, truth.areas, oracle_chains(map, t.depth),
                              1e-10 * t.scale * t.scale);
            oracle_mirrored_free(&truth);
        }
        sl_space_destroy(t.context, &space);
        end(&t);
    }
    print_message("%zu views with mirrors, %zu deep parts, %zu rounded\n", t.seen, t.deep,
                  t.rounded);
    assert_true(t.seen > maps && t.deep > maps / 8 && t.rounded > 0);
    sl_context_destroy(t.context);
}

/// The library's parts, by chain.
static void areas_of(const trial *t, const sl_mirrored_region *region, double *areas) {
    size_t chains[PARTS];
    memset(areas, 0, CHAINS * sizeof *areas);
    areas[0] = sl_region_area(&region->direct);
    for (size_t i = 0; i < region->part_count; i++) {
        const sl_mirror_part *p = &region->parts[i];
        chains[i] =
            (p->parent == SL_NO_PART ? 0 : chains[p->parent]) * (t->f.baked.map.mirror_count + 1) +
            p->mirror + 1;
        areas[chains[i]] += sl_region_area(&p->region);
    }
}

static void as_the_library_says_of_turned_mirrors(void **state) {
    (void)state;
    static trial t;
    static double areas[CHAINS];
    const uint64_t maps = testing_seeds(MAPS);
    sl_mirrored_region region = {0};
    t.context = testing_context(NULL);
    for (uint64_t seed = 1; seed <= maps; seed++) {
        sl_query *query;
        begin(&t, seed, 17.3);
        const sl_box *b = &t.f.baked.space.bounds;
        assert_ok(t.context,
                  sl_query_over(t.context, &t.f.baked.space, &t.f.baked.map, NULL, &query));
        for (size_t i = 0; i < t.f.baked.map.door_count; i++)
            sl_query_set_door_at(t.context, query, i, !t.is_shut[i]);
        for (int i = 0; i < EYES; i++) {
            const sl_view view = sl_view_all_round(
                (sl_point){b->min.x + sl_random_unit(&t.random) * (b->max.x - b->min.x),
                           b->min.y + sl_random_unit(&t.random) * (b->max.y - b->min.y)});
            assert_ok(t.context,
                      sl_query_mirrored_region_to(t.context, query, &view, t.depth, &region));
            areas_of(&t, &region, areas);
            look(&t, &view);
            compare_areas(&t, &view, areas, CHAINS, 1e-8 * t.scale * t.scale);
        }
        sl_query_destroy(t.context, query);
        end(&t);
    }
    sl_mirrored_region_destroy(t.context, &region);
    print_message("%zu views with mirrors, %zu deep parts\n", t.seen, t.deep);
    assert_true(t.seen > maps && t.deep > maps / 8 && t.rounded >= t.seen);
    sl_context_destroy(t.context);
}

/// What cells before a mirror show side by side is one part. A wall that hides some parts it.
static void cells_join(void **state) {
    (void)state;
    static trial t;
    static const char *const walls[] = {"wall 2 4 2 3\n", "wall 1.5 1 1.5 1.5\n"};
    for (uint32_t i = 0; i < 2; i++) {
        char text[256];
        snprintf(text, sizeof text,
                 "wall 0 0 4 0\nwall 4 0 4 4\nwall 4 4 0 4\nwall 0 4 0 0\n"
                 "mirror 1 0 3 0\n%s",
                 walls[i]);
        t.context = testing_context(NULL);
        t.f = baked_file_of_text(t.context, text);
        t.scratch = malloc(sl_runtime_scratch_count(&t.f.runtime) * sizeof *t.scratch);
        t.depth = 1;
        const sl_view all = sl_view_all_round((sl_point){1, 2.25});
        look(&t, &all);
        assert_true(t.f.runtime.cell_count > 1);
        assert_int_equal(t.part_count, 2 + i);
        end(&t);
        sl_context_destroy(t.context);
    }
}

/// The same parts for any room, and no more written than there is room for.
static void any_room_will_do(void **state) {
    (void)state;
    static trial t;
    t.context = testing_context(NULL);
    t.f = baked_file_of_text(t.context, "wall 0 0 4 0\nwall 4 0 4 4\nwall 4 4 0 4\nwall 0 4 0 0\n"
                                        "mirror 0 1 0 3\nmirror 4 1 4 3\n");
    t.scratch = malloc(sl_runtime_scratch_count(&t.f.runtime) * sizeof *t.scratch);
    t.depth = 4;
    const sl_view all = sl_view_all_round((sl_point){1, 2});
    look(&t, &all);
    assert_int_equal(t.part_count, 9);
    const uint32_t points = t.parts[8].first + t.parts[8].count;
    for (uint32_t room = 0; room < 9; room++) {
        sl_runtime_mirror_part parts[9];
        const sl_runtime_view view = sl_runtime_view_all_round(1, 2);
        sl_point few[16];
        uint32_t count;
        memset(parts, 1, sizeof parts);
        few[room] = (sl_point){-1, -2};
        const uint32_t found = sl_runtime_visible_polygon_mirrored(
            &t.f.runtime, &view, NULL, 0, 4, t.scratch, parts, room, &count, &few[0].x, room);
        assert_true(room ? count > room && found >= room : !count && !found);
        assert_true(found < points && few[room].x == -1 && few[room].y == -2);
        assert_memory_equal(few, t.points, room * sizeof *few);
    }
    end(&t);
    sl_context_destroy(t.context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(as_brute_force_says),
        cmocka_unit_test(as_the_library_says_of_turned_mirrors),
        cmocka_unit_test(cells_join),
        cmocka_unit_test(any_room_will_do),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/// What is promised behind oblique mirrors, where images are rounded: a sightline that keeps clear
/// of all ends of walls and mirrors is found, by the bake, by the cells of an eye and by its
/// region; and what the region shows is where the sightline to it ends. Likewise past boxes that
/// move, and boxes on the way are found. Against single rays in rationals, on random maps with
/// walls, mirrors and one-way glass in any direction. SIGHTLINE_SEEDS in the environment: how many
/// maps (60 by default).
#include "effects/filtered.h"
#include "mirror_rays.h"
#include "sight/eye_search.h"
#include "sight/moving.h"
#include "sight/region.h"
#include "space/outline.h"
#include "space/subdivide.h"
#include "testing.h"

#include "oracle/random_oblique.h"

#include <math.h>

enum { MAPS = 60, MIRRORS = 3, EYES = 4, RAYS = 24, DEPTH = 3, BOXES = 3 };

/// Of the map's size: what rounding moves is far less.
#define CLEAR 1e-9

typedef struct trial {
    sl_context *context;
    sl_random random;
    uint64_t seed;
    sl_map map;
    sl_space space;
    sl_space dark; ///< with a wall on the dark side of glass
    sl_outline outline;
    sli_room_mirrors mirrors;
    sl_visibility baked;
    double size;
    sl_moving_box boxes[BOXES];
    size_t box_count;
    bool seen[BOXES];             ///< by mirror
    size_t rays, points, rounded; ///< reflected legs and walls of regions checked; bakes rounded
    size_t boxes_met, boxes_hidden;
} trial;

static void add_walls(trial *t, oblique_grid grid) {
    for (uint64_t i = 2 + sl_random_below(&t->random, 5); i > 0; i--) {
        sl_segment s;
        do {
            s.a.x = oblique_coordinate(&t->random, grid),
            s.a.y = oblique_coordinate(&t->random, grid);
            s.b.x = oblique_coordinate(&t->random, grid),
            s.b.y = oblique_coordinate(&t->random, grid);
        } while (s.a.x == s.b.x && s.a.y == s.b.y);
        if (i <= MIRRORS) {
            assert_ok(t->context, sl_map_add_mirror(t->context, &t->map, s, 0));
            t->map.mirrors[t->map.mirror_count - 1].one_sided = sl_random_below(&t->random, 2);
        } else {
            assert_ok(t->context, sl_map_add_wall(t->context, &t->map, s.a, s.b, 0));
        }
    }
}

/// Every other map has two panes.
static void add_glass(trial *t, oblique_grid grid) {
    for (uint64_t i = 2 * (t->seed / 3 % 2); i > 0; i--) {
        sl_segment s;
        do {
            s.a.x = oblique_coordinate(&t->random, grid),
            s.a.y = oblique_coordinate(&t->random, grid);
            s.b.x = oblique_coordinate(&t->random, grid),
            s.b.y = oblique_coordinate(&t->random, grid);
        } while (s.a.x == s.b.x && s.a.y == s.b.y);
        assert_ok(t->context, sl_map_add_oneway(t->context, &t->map, s, 0));
    }
}

static void bake(trial *t) {
    sl_plan plan = sl_plan_make(&t->map);
    plan.mirror_depth = DEPTH;
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    options.threads = 1;
    options.plan = &plan;
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    while (strcmp(methods->name, "dfs") != 0) methods++;
    assert_ok(t->context, methods->see(t->context, &t->space, &options, &t->baked));
    t->rounded += t->baked.account.effects.rounded_places > 0;
}

static void begin(trial *t, uint64_t seed) {
    static const oblique_grid grids[] = {OBLIQUE_SQUARES, OBLIQUE_ANYWHERE, OBLIQUE_TENTHS};
    static const double highs[] = {9, 100, 10};
    t->random = (sl_random){seed};
    t->seed = seed;
    t->map = (sl_map){0};
    t->context = testing_context(NULL);
    const double high = highs[seed % 3] + 1;
    const sl_point corners[5] = {{-1, -1}, {high, -1}, {high, high}, {-1, high}, {-1, -1}};
    t->size = high + 1;
    for (int i = 0; i < 4; i++)
        assert_ok(t->context, sl_map_add_wall(t->context, &t->map, corners[i], corners[i + 1], 0));
    add_walls(t, grids[seed % 3]);
    add_glass(t, grids[seed % 3]);
    assert_ok(t->context, sl_map_clean(t->context, &t->map, NULL, NULL));
    assert_ok(t->context, sli_subdivide_mesh(t->context, &t->map, &t->space));
    const sli_filtered_space one_way = {.one_way = true, .dark_walls = true};
    assert_ok(t->context, sli_filtered_space_make(t->context, &t->space, &one_way, NULL, &t->dark));
    assert_ok(t->context, sli_outline_make(t->context, &t->dark, &t->outline));
    assert_ok(t->context, sli_room_mirrors_make(t->context, &t->outline, &t->map, &t->mirrors));
    bake(t);
}

static void end(trial *t) {
    sl_visibility_destroy(t->context, &t->baked);
    sli_room_mirrors_destroy(t->context, &t->mirrors);
    sli_outline_destroy(t->context, &t->outline);
    sl_space_destroy(t->context, &t->space);
    sl_space_destroy(t->context, &t->dark);
    sl_map_destroy(t->context, &t->map);
    sl_context_destroy(t->context);
}

/// The boxes that a reflected leg passes or ends at are seen.
static void check_boxes_met(const trial *t, sl_point eye, const oracle_ray *ray) {
    for (uint32_t leg = 1; leg < ray->count; leg++)
        for (size_t i = 0; i < t->box_count; i++) {
            oracle_leg way = ray->legs[leg];
            // A little farther: one that blocks is not entered.
            const sl_point d = {way.to.x - way.from.x, way.to.y - way.from.y};
            const double length = hypot(d.x, d.y), more = 1e-4 * t->size / length;
            if (leg + 1 == ray->count && t->boxes[i].blocks) {
                const sl_point on = {way.to.x + more * d.x, way.to.y + more * d.y};
                const sl_box b = t->boxes[i].box;
                if (!(b.min.x < on.x && on.x < b.max.x && b.min.y < on.y && on.y < b.max.y))
                    continue;
                way.to = on;
            }
            if (!t->seen[i] && mirror_rays_meet_box(&way, t->boxes[i].box))
                fail_msg("seed %llu, eye %.17g,%.17g: box %zu is met on the way from %.17g,%.17g "
                         "to %.17g,%.17g",
                         (unsigned long long)t->seed, eye.x, eye.y, i, way.from.x, way.from.y,
                         way.to.x, way.to.y);
        }
}

/// Rays that keep clear of all ends are found.
static void check_rays(trial *t, sl_point eye, const uint64_t *cells,
                       const sl_mirrored_region *region) {
    const uint32_t from = sl_space_locate(&t->space, eye);
    if (mirror_rays_depth_in(&t->space, from, eye) < CLEAR * t->size) return;
    for (int i = 0; i < RAYS; i++) {
        const double angle = sl_random_unit(&t->random) * 6.283185307179586;
        const oracle_ray ray =
            oracle_ray_of(&t->map, eye, (sl_point){cos(angle), sin(angle)}, DEPTH);
        if (ray.margin < CLEAR * t->size) continue;
        check_boxes_met(t, eye, &ray);
        for (uint32_t leg = 1; leg < ray.count; leg++) {
            const sl_point a = ray.legs[leg].from, b = ray.legs[leg].to;
            const double share = sl_random_unit(&t->random);
            const sl_point p = {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
            const uint32_t cell = sl_space_locate(&t->space, p);
            if (mirror_rays_depth_in(&t->space, cell, p) < CLEAR * t->size) continue;
            t->rays++;
            const bool baked = sl_pvs_sees(&t->baked.mirrored, from, cell);
            const bool culled = sl_eye_sees(cells, cell),
                       shown = mirror_rays_show(region, &ray, leg, p);
            if (!baked || !culled || !shown)
                fail_msg("seed %llu, eye %.17g,%.17g, angle %.17g: reflection %u shows %.17g,%.17g "
                         "in cell %u; bake %d, eye %d, region %d",
                         (unsigned long long)t->seed, eye.x, eye.y, angle, leg, p.x, p.y, cell,
                         baked, culled, shown);
        }
    }
}

/// A ray to where a wall is seen to be ends on that wall, by the same mirrors.
static void check_part(trial *t, sl_point eye, const sl_mirrored_region *region, uint32_t number) {
    const size_t edge = mirror_rays_wrong_edge(&t->map, eye, region, number, t->size, &t->points);
    if (edge != SIZE_MAX)
        fail_msg("seed %llu, eye %.17g,%.17g, part %u: no ray ends at edge %zu",
                 (unsigned long long)t->seed, eye.x, eye.y, number, edge);
}

static void check_eye(trial *t, sl_point eye) {
    const sl_visibility bare = {.sight = SL_OPEN};
    const sl_view view = sl_view_all_round(eye);
    uint64_t *cells = calloc(sl_eye_words(&t->space), sizeof *cells);
    assert_non_null(cells);
    sli_eye_search *search;
    sl_eye_account account;
    sl_mirrored_region region = {0};
    size_t count;
    const sl_eye_method *exact = sl_eye_methods(&count) + count - 1;
    assert_ok(t->context, sli_eye_search_create(t->context, &t->dark, &bare, &search));
    assert_ok(t->context, sli_eye_search_add_mirrors(t->context, search, &t->map, DEPTH));
    assert_ok(t->context, exact->mirrored(t->context, search, &view, cells, &account));
    assert_ok(t->context,
              sli_mirrored_region_make(t->context, &t->mirrors, &view, 0, DEPTH, &region));
    check_rays(t, eye, cells, &region);
    for (uint32_t i = 0; i < region.part_count; i++) check_part(t, eye, &region, i);
    sl_mirrored_region_destroy(t->context, &region);
    sli_eye_search_destroy(t->context, search);
    free(cells);
}

// --- past boxes

static sl_box random_box(trial *t) {
    const sl_box b = t->space.bounds;
    const double width = b.max.x - b.min.x, height = b.max.y - b.min.y;
    const double x = b.min.x + width * sl_random_unit(&t->random);
    const double y = b.min.y + height * sl_random_unit(&t->random);
    return (sl_box){
        {x, y},
        {x + width / 4 * sl_random_unit(&t->random), y + height / 4 * sl_random_unit(&t->random)}};
}

/// The map with the sides of boxes that block, for the oracle alone.
static void add_box_walls(trial *t, const sl_map *from) {
    t->map.walls = malloc((from->wall_count + 4 * BOXES) * sizeof *t->map.walls);
    assert_non_null(t->map.walls);
    memcpy(t->map.walls, from->walls, from->wall_count * sizeof *t->map.walls);
    for (size_t i = 0; i < t->box_count; i++) {
        const sl_box b = t->boxes[i].box;
        const sl_point c[4] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}};
        for (int k = 0; k < 4 && t->boxes[i].blocks; k++)
            t->map.walls[t->map.wall_count++] = (sl_wall){c[k], c[(k + 1) % 4], 0, 0};
    }
}

/// What of a region lies in a box.
static double area_in(const sl_region *region, sl_box box) {
    sl_point in[256], out[256];
    size_t count = region->count;
    assert_true(count < 100);
    memcpy(in, region->points, count * sizeof *in);
    const sl_point c[4] = {box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
    for (int k = 0; k < 4; k++) {
        size_t kept = 0;
        for (size_t i = 0; i < count; i++) {
            const sl_point p = in[i], q = in[(i + 1) % count];
            const double at_p = mirror_rays_cross(c[k], c[(k + 1) % 4], p),
                         at_q = mirror_rays_cross(c[k], c[(k + 1) % 4], q);
            if (at_p >= 0) out[kept++] = p;
            if ((at_p >= 0) != (at_q >= 0)) {
                const double s = at_p / (at_p - at_q);
                out[kept++] = (sl_point){p.x + s * (q.x - p.x), p.y + s * (q.y - p.y)};
            }
            assert_true(kept < 255);
        }
        count = kept;
        memcpy(in, out, count * sizeof *in);
    }
    double sum = 0;
    for (size_t i = 1; i + 1 < count; i++) sum += mirror_rays_cross(in[0], in[i], in[i + 1]) / 2;
    return fabs(sum);
}

/// A box that is seen through is seen where some of the region is in it.
static void check_boxes_shown(trial *t, sl_point eye, const sl_mirrored_region *region) {
    for (size_t i = 0; i < t->box_count; i++) {
        double area = 0;
        if (t->boxes[i].blocks) continue;
        for (uint32_t k = 0; k < region->part_count; k++)
            area += area_in(&region->parts[k].region, t->boxes[i].box) / (t->size * t->size);
        if (t->seen[i] ? area < 1e-13 : area > 1e-9)
            fail_msg("seed %llu, eye %.17g,%.17g: box %zu is said to be %s, area %g",
                     (unsigned long long)t->seed, eye.x, eye.y, i, t->seen[i] ? "seen" : "hidden",
                     area);
        *(t->seen[i] ? &t->boxes_met : &t->boxes_hidden) += 1;
    }
}

static void check_boxes(trial *t, sl_point eye) {
    const sl_visibility bare = {.sight = SL_OPEN};
    const sl_view view = sl_view_all_round(eye);
    const sl_map map = t->map;
    uint64_t *cells = calloc(sl_eye_words(&t->space), sizeof *cells);
    assert_non_null(cells);
    sli_moving *moving;
    sl_eye_account account;
    const sl_outline *outline;
    sli_room_mirrors mirrors = {0};
    sl_mirrored_region region = {0};
    t->box_count = BOXES;
    for (size_t i = 0; i < BOXES; i++)
        t->boxes[i] = (sl_moving_box){random_box(t), sl_random_below(&t->random, 2)};
    assert_ok(t->context, sli_moving_create(t->context, &t->space, &bare, &moving));
    assert_ok(t->context, sli_moving_add_glass(t->context, moving));
    assert_ok(t->context, sli_moving_add_mirrors(t->context, moving, &map, DEPTH));
    assert_ok(t->context, sli_moving_set_boxes(t->context, moving, t->boxes, BOXES));
    assert_ok(t->context,
              sli_moving_look_mirrored(t->context, moving, &view, cells, t->seen, &account));
    assert_ok(t->context, sli_moving_outline(t->context, moving, &outline));
    assert_ok(t->context, sli_room_mirrors_make(t->context, outline, &map, &mirrors));
    assert_ok(t->context, sli_mirrored_region_make(t->context, &mirrors, &view, 0, DEPTH, &region));
    add_box_walls(t, &map);
    check_rays(t, eye, cells, &region);
    for (uint32_t i = 0; i < region.part_count; i++) check_part(t, eye, &region, i);
    check_boxes_shown(t, eye, &region);
    free(t->map.walls);
    t->map = map;
    t->box_count = 0;
    sl_mirrored_region_destroy(t->context, &region);
    sli_room_mirrors_destroy(t->context, &mirrors);
    sli_moving_destroy(t->context, moving);
    free(cells);
}

static void random_maps(void **state) {
    (void)state;
    const uint64_t maps = testing_seeds(MAPS);
    trial t = {0};
    for (uint64_t seed = 1; seed <= maps; seed++) {
        begin(&t, seed);
        for (int i = 0; i < EYES; i++) {
            const sl_point eye = {sl_random_unit(&t.random) * t.size - 1,
                                  sl_random_unit(&t.random) * t.size - 1};
            check_eye(&t, eye);
            check_boxes(&t, eye);
        }
        end(&t);
    }
    assert_true(t.rounded > maps / 2);
    assert_true(t.rays > 10 * maps);
    assert_true(t.points > maps);
    assert_true(t.boxes_met > maps && t.boxes_hidden > maps);
}

/// Without glass, who is seen by mirror sees as well; also where ends of walls and mirrors are in
/// line. `hidden`: two cells that see nothing of each other by mirror, or the same cell.
static void check_mutual(trial *t, const char *name, const uint32_t hidden[2]) {
    sl_plan plan = sl_plan_make(&t->map);
    sl_see_options options = sl_see_options_default();
    sl_visibility open = {0};
    plan.mirror_depth = DEPTH;
    options.solver = sl_funnel();
    options.threads = 1;
    options.plan = &plan;
    options.sight = t->seed % 2 && hidden[0] == hidden[1] ? SL_CLOSED : SL_OPEN;
    assert_ok(t->context, testing_method("dfs")->see(t->context, &t->space, &options, &open));
    if (hidden[0] != hidden[1]) assert_false(sl_pvs_sees(&open.mirrored, hidden[0], hidden[1]));
    for (uint32_t a = 0; a < t->space.cell_count; a++)
        for (uint32_t b = 0; b < t->space.cell_count; b++)
            if (sl_pvs_sees(&open.mirrored, a, b) && !sl_pvs_sees(&open.mirrored, b, a))
                fail_msg("%s %llu: cell %u sees cell %u by mirror, and not the other way round",
                         name, (unsigned long long)t->seed, a, b);
    t->points += sl_pvs_count(&open.mirrored, 0);
    sl_visibility_destroy(t->context, &open);
}

static void sight_by_mirror_is_mutual(void **state) {
    (void)state;
    // The end of the first mirror and two portals are in one line: the one cell sees the other
    // along that line at most, which open sight does not count. And a mirror seen from one side.
    static const struct {
        const char *text;
        sl_point from, to; ///< in cells that see nothing of each other by mirror with open sight
    } cases[] = {
        {"walls 0 0 4 0 4 7 0 7 0 0\nmirror 1 7 2 4\nmirror 4 1 3 2 one\n", {3, 6}, {3.75, 1}},
        {"walls 0 0 5 0 5 12 0 12 0 0\nmirror 1 5 3 6 one\n", {4, 9}, {2, 2}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        trial t = {.context = testing_context(NULL), .seed = i};
        testing_space(t.context, cases[i].text, &t.map, &t.space);
        const uint32_t hidden[] = {sl_space_locate(&t.space, cases[i].from),
                                   sl_space_locate(&t.space, cases[i].to)};
        assert_int_not_equal(hidden[0], hidden[1]);
        check_mutual(&t, "text", hidden);
        end(&t);
    }
    const uint32_t none[2] = {0, 0};
    const uint64_t maps = testing_seeds(MAPS);
    for (uint64_t seed = 1; seed <= maps; seed++) {
        trial t = {0};
        begin(&t, seed);
        if (!t.map.oneway_count) check_mutual(&t, "seed", none);
        end(&t);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_maps),
        cmocka_unit_test(sight_by_mirror_is_mutual),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

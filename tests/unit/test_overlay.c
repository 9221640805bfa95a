/// What several eyes see together: by hand on small shapes, and on random maps against sli_sees.
#include "space/outline.h"
#include "testing.h"

#include "geometry/length.h"
#include "geometry/orient.h"
#include "oracle/random_map.h"
#include "oracle/random_oblique.h"
#include "sight/region.h"
#include "sightline/overlay.h"
#include "space/subdivide.h"

#include <math.h>

static double area_of(const sl_shape *shape) {
    double twice = 0;
    const sl_point base = shape->count ? shape->points[0] : (sl_point){0, 0};
    for (size_t i = 0, from = 0; i < shape->count; from = shape->ends[i++])
        for (size_t k = from; k < shape->ends[i]; k++) {
            const sl_point a = shape->points[k],
                           b = shape->points[k + 1 < shape->ends[i] ? k + 1 : from];
            twice += (a.x - base.x) * (b.y - base.y) - (a.y - base.y) * (b.x - base.x);
        }
    return twice / 2;
}

/// How often the loops of a shape go around a point that is on none of them.
static int winding_of(const sl_shape *shape, sl_point p) {
    int winding = 0;
    for (size_t i = 0, from = 0; i < shape->count; from = shape->ends[i++])
        for (size_t k = from; k < shape->ends[i]; k++) {
            const sl_point a = shape->points[k],
                           b = shape->points[k + 1 < shape->ends[i] ? k + 1 : from];
            if ((a.y <= p.y) == (b.y <= p.y)) continue;
            const int side = sli_orient(a, b, p);
            if (a.y <= p.y ? side > 0 : side < 0) winding += side;
        }
    return winding;
}

/// A point within a piece, in no line with its corners by chance.
static sl_point point_in(const sl_space *pieces, uint32_t piece) {
    const sl_cell *cell = &pieces->cells[piece];
    const sl_point *corners = pieces->vertices + cell->first_vertex;
    sl_point at = {0, 0};
    double all = 0;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const double weight = 1 + sqrt(2 + i % 7) / 3;
        at.x += weight * (corners[i].x - corners[0].x);
        at.y += weight * (corners[i].y - corners[0].y);
        all += weight;
    }
    return (sl_point){corners[0].x + at.x / all, corners[0].y + at.y / all};
}

/// The distance of a point in a piece from its boundary.
static double depth_of(const sl_space *pieces, uint32_t piece, sl_point p) {
    const sl_cell *cell = &pieces->cells[piece];
    double depth = HUGE_VAL;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point a = pieces->vertices[cell->first_vertex + i];
        const sl_point b = pieces->vertices[cell->first_vertex + (i + 1) % cell->vertex_count];
        const sl_point way = {b.x - a.x, b.y - a.y}, to = {p.x - a.x, p.y - a.y};
        depth = fmin(depth, sli_cross(way, to) / sli_length(way.x, way.y));
    }
    return depth;
}

// --- by hand

typedef struct hand {
    sl_point points[24];
    size_t ends[4];
    sl_shape shape;
} hand;

/// Boxes as loops: x, y, width, height each; a negative height is a loop that runs clockwise.
static void set_boxes(hand *h, const double (*boxes)[4], size_t count) {
    for (size_t i = 0; i < count; i++) {
        const double x = boxes[i][0], y = boxes[i][1], w = boxes[i][2], t = boxes[i][3];
        const bool turned = t < 0;
        sl_point *p = h->points + 4 * i;
        p[0] = (sl_point){x, y};
        p[turned ? 3 : 1] = (sl_point){x + w, y};
        p[2] = (sl_point){x + w, y + fabs(t)};
        p[turned ? 1 : 3] = (sl_point){x, y + fabs(t)};
        h->ends[i] = 4 * (i + 1);
    }
    h->shape = (sl_shape){h->points, h->ends, count};
}

static void assert_outline(sl_context *context, const sl_overlay *overlay, size_t at_least,
                           size_t loops, size_t points, double area) {
    sl_shape outline;
    assert_ok(context, sl_overlay_outline(context, overlay, at_least, &outline));
    assert_int_equal(outline.count, loops);
    assert_int_equal(loops ? outline.ends[loops - 1] : 0, points);
    assert_true(area_of(&outline) == area);
    sl_shape_destroy(context, &outline);
}

static void boxes_on_each_other(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    hand h[4], within;
    sl_overlay overlay;
    set_boxes(&h[0], (const double[][4]){{0, 0, 4, 4}}, 1);
    set_boxes(&h[1], (const double[][4]){{2, 2, 4, 4}}, 1);
    set_boxes(&h[2], (const double[][4]){{2, 2, 4, 4}}, 1);
    set_boxes(&h[3], (const double[][4]){{6, 6, 1, 1}}, 1);
    set_boxes(&within, (const double[][4]){{1, 0, 9, 9}}, 1);
    const sl_shape shapes[] = {h[0].shape, h[1].shape, h[2].shape, h[3].shape};
    assert_ok(context, sl_overlay_make(context, &within.shape, shapes, 4, &overlay));
    const double areas[] = {81, 25, 16, 4, 0};
    for (int k = 0; k <= 4; k++) assert_true(overlay.areas[k] == areas[k]);
    const struct {
        sl_point at;
        uint32_t count, inside;
    } places[] = {{{0.5, 1}, 1, 0},   {{1.5, 1}, 1, 1}, {{3, 3}, 3, 1},  {{5, 5}, 2, 1},
                  {{6.5, 6.5}, 1, 1}, {{9, 1}, 0, 1},   {{0.5, 5}, 0, 0}};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const uint32_t piece = sl_space_locate(&overlay.pieces, places[i].at);
        assert_int_equal(overlay.counts[piece], places[i].count);
        assert_int_equal(overlay.pieces.cells[piece].inside, places[i].inside);
    }
    assert_outline(context, &overlay, 1, 2, 12, 29); // the last box touches in a point only
    assert_outline(context, &overlay, 2, 1, 4, 16);
    assert_outline(context, &overlay, 3, 1, 4, 4);
    assert_outline(context, &overlay, 4, 0, 0, 0);
    sl_overlay_destroy(context, &overlay);
    sl_context_destroy(context);
}

static void holes_and_loops_that_overlap(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    hand h[3];
    sl_overlay overlay;
    // A box with two holes: one touches its border in a point, one holds an island.
    set_boxes(&h[0], (const double[][4]){{0, 0, 9, 9}, {1, 1, 3, -3}, {4, 4, 4, -4}, {5, 5, 1, 1}},
              4);
    // Loops that overlap count once, and so do loops that run the other way.
    set_boxes(&h[1], (const double[][4]){{0, 0, 2, 9}, {1, 0, 2, 9}, {1, 0, 1, 9}}, 3);
    set_boxes(&h[2], (const double[][4]){{3, 0, 1, -9}}, 1);
    const sl_shape shapes[] = {h[0].shape, h[1].shape, h[2].shape};
    assert_ok(context, sl_overlay_make(context, NULL, shapes, 1, &overlay));
    assert_true(overlay.areas[0] == 57 && overlay.areas[1] == 57);
    assert_outline(context, &overlay, 1, 4, 16, 57);
    sl_overlay_destroy(context, &overlay);
    assert_ok(context, sl_overlay_make(context, NULL, shapes, 3, &overlay));
    assert_true(overlay.areas[1] == 57 + 9);
    assert_true(overlay.areas[2] == 27 - 6 + 6);
    assert_true(overlay.areas[3] == 0);
    sl_overlay_destroy(context, &overlay);
    sl_context_destroy(context);
}

/// Two hooks that touch in two points: two outlines, not one with a hole.
static void hooks_that_touch_twice(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    hand h;
    sl_overlay overlay;
    sl_shape outline;
    set_boxes(&h, (const double[][4]){{0, 0, 4, 1}, {0, 0, 1, 4}, {4, 1, 1, 4}, {1, 4, 4, 1}}, 4);
    assert_ok(context, sl_overlay_make(context, NULL, &h.shape, 1, &overlay));
    assert_outline(context, &overlay, 1, 2, 12, 14);
    assert_ok(context, sl_overlay_outline(context, &overlay, 1, &outline));
    for (size_t i = 0; i < 6; i++) assert_true(outline.points[i].x + outline.points[i].y < 6);
    sl_shape_destroy(context, &outline);
    sl_overlay_destroy(context, &overlay);
    sl_context_destroy(context);
}

static void nothing_and_wrong_arguments(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_overlay overlay;
    sl_shape outline = {0};
    const sl_shape none = {0};
    assert_ok(context, sl_overlay_make(context, NULL, &none, 1, &overlay));
    assert_int_equal(overlay.pieces.cell_count, 0);
    assert_true(overlay.areas[0] == 0 && overlay.areas[1] == 0);
    assert_outline(context, &overlay, 1, 0, 0, 0);
    assert_int_equal(sl_overlay_outline(context, &overlay, 0, &outline), SL_BAD_ARGUMENT);
    sl_overlay_destroy(context, &overlay);
    sl_point line[] = {{0, 0}, {3, 1}, {6, 2}}, wrong[] = {{0, 0}, {1, 0}, {1, HUGE_VAL}};
    const size_t end = 3;
    assert_ok(context, sl_overlay_make(context, NULL, &(sl_shape){line, &end, 1}, 1, &overlay));
    assert_true(overlay.areas[1] == 0);
    assert_outline(context, &overlay, 1, 0, 0, 0);
    sl_overlay_destroy(context, &overlay);
    assert_int_equal(sl_overlay_make(context, NULL, &(sl_shape){wrong, &end, 1}, 1, &overlay),
                     SL_BAD_ARGUMENT);
    sl_context_destroy(context);
}

// --- eyes on random maps

enum { EYES = 6 };

typedef struct scene {
    sl_context *context;
    uint64_t seed;
    sl_map map;
    sl_space space;
    sl_outline outline;
    sl_region regions[EYES];
    sl_point *flat[EYES];
    size_t ends[EYES];
    sl_shape shapes[EYES], inside;
    double tolerance; ///< of places
    double length;    ///< of all outlines
} scene;

/// In a room, at the end of a wall, at a corner of a cell, on a portal; every third again.
static sl_point place_eye(const scene *s, sl_random *random, int eye) {
    const sl_box *b = &s->space.bounds;
    const sl_portal *portal =
        s->space.portal_count ? &s->space.portals[sl_random_below(random, s->space.portal_count)]
                              : NULL;
    if (eye % 3 == 2) return s->regions[eye - 1].view.eye;
    switch (sl_random_below(random, 6)) {
    case 0:
        return s->space.walls[sl_random_below(random, s->space.wall_count)].a;
    case 1:
        return s->space.vertices[sl_random_below(random, s->space.vertex_count)];
    case 2:
        if (portal) return portal->left;
        // fall through
    case 3:
        // In line with walls: on axial maps it looks along them.
        return (sl_point){s->space.walls[sl_random_below(random, s->space.wall_count)].a.x,
                          s->space.walls[sl_random_below(random, s->space.wall_count)].b.y};
    default:
        return (sl_point){b->min.x + sl_random_unit(random) * (b->max.x - b->min.x),
                          b->min.y + sl_random_unit(random) * (b->max.y - b->min.y)};
    }
}

static void look(scene *s, sl_random *random) {
    for (int i = 0; i < EYES; i++) {
        const sl_view view = sl_view_all_round(place_eye(s, random, i));
        const double size = s->space.bounds.max.x - s->space.bounds.min.x;
        const double range = s->seed % 5 == 0 && i % 2 ? size / 3 : 0;
        sl_region *region = &s->regions[i];
        assert_ok(s->context, sli_region_make(s->context, &s->outline, &view, range, region));
        s->ends[i] = sl_region_flatten(region, size / 1000, NULL, 0);
        s->flat[i] = malloc((s->ends[i] + 1) * sizeof *s->flat[i]);
        assert_non_null(s->flat[i]);
        sl_region_flatten(region, size / 1000, s->flat[i], s->ends[i]);
        s->shapes[i] = (sl_shape){s->flat[i], &s->ends[i], s->ends[i] > 0};
        for (size_t k = 0; k < s->ends[i]; k++) {
            const sl_point a = s->flat[i][k], b = s->flat[i][(k + 1) % s->ends[i]];
            s->length += sli_length(b.x - a.x, b.y - a.y);
        }
    }
}

/// Of kinds that go by turns: axial on three grids, oblique, turned and moved.
static bool start_scene(sl_context *context, uint64_t seed, scene *s) {
    *s = (scene){.context = context, .seed = seed};
    sl_random random = {seed};
    const bool turned = seed % 4 == 2;
    if (seed % 4 == 3) {
        const oblique_grid grid = (oblique_grid)(seed / 4 % OBLIQUE_GRIDS);
        assert_ok(context, oblique_random_map(context, seed, grid, 30, &s->map));
    } else {
        const oracle_grid grid = turned ? ORACLE_GRID_INTEGER : (oracle_grid)(seed % 3);
        assert_ok(context, oracle_random_map(context, seed, grid, &s->map));
        if (turned) oblique_turn_map(&s->map, 17.3 + (double)seed, seed % 8 == 2 ? 1e6 : 0);
    }
    assert_ok(context, sl_map_clean(context, &s->map, NULL, NULL));
    if (!s->map.wall_count) return false;
    assert_ok(context, sl_subdivision_for(&s->map)->subdivide(context, &s->map, NULL, &s->space));
    assert_ok(context, sli_outline_make(context, &s->space, &s->outline));
    assert_ok(context, sl_shape_of_inside(context, &s->space, &s->inside));
    const sl_box *b = &s->space.bounds;
    const double largest =
        fmax(fmax(fabs(b->min.x), fabs(b->min.y)), fmax(fabs(b->max.x), fabs(b->max.y)));
    s->tolerance = 0x1p-46 * largest + SL_COORDINATE_MIN;
    for (uint32_t i = 0; i < s->space.wall_count; i++) {
        const sl_wall *w = &s->space.walls[i];
        s->length += 2 * sli_length(w->b.x - w->a.x, w->b.y - w->a.y);
    }
    look(s, &random);
    return true;
}

static void end_scene(scene *s) {
    for (int i = 0; i < EYES; i++) {
        sl_region_destroy(s->context, &s->regions[i]);
        free(s->flat[i]);
    }
    sl_shape_destroy(s->context, &s->inside);
    sli_outline_destroy(s->context, &s->outline);
    sl_space_destroy(s->context, &s->space);
    sl_map_destroy(s->context, &s->map);
}

static void assert_area(const scene *s, const char *what, double found, double expected) {
    if (fabs(found - expected) <= s->tolerance * s->length) return;
    fail_msg("seed %llu: %s %.17g, not %.17g", (unsigned long long)s->seed, what, found, expected);
}

/// The sums: all that is inside, each region, the union as an outline.
static void check_areas(const scene *s, const sl_overlay *overlay) {
    double inside = 0, regions = 0, layers = 0, by_piece[EYES + 1] = {0};
    for (uint32_t c = 0; c < s->space.cell_count; c++)
        if (s->space.cells[c].inside) inside += sl_space_area(&s->space, c);
    assert_area(s, "the inside", overlay->areas[0], inside);
    for (int i = 0; i < EYES; i++) {
        const sl_shape *shape = &s->shapes[i];
        regions += area_of(shape);
    }
    double anywhere[EYES + 1] = {0};
    for (uint32_t c = 0; c < overlay->pieces.cell_count; c++) {
        const double area = sl_space_area(&overlay->pieces, c);
        layers += overlay->counts[c] * area;
        for (uint32_t k = 0; k <= overlay->counts[c]; k++) {
            anywhere[k] += area;
            if (overlay->pieces.cells[c].inside) by_piece[k] += area;
        }
    }
    assert_area(s, "the regions", layers, regions);
    for (size_t k = 0; k <= EYES; k++) {
        assert_area(s, "pieces", by_piece[k], overlay->areas[k]);
        if (k) assert_true(overlay->areas[k] <= overlay->areas[k - 1]);
        sl_shape outline = {0};
        if (k) assert_ok(s->context, sl_overlay_outline(s->context, overlay, k, &outline));
        if (k) assert_area(s, "an outline", area_of(&outline), anywhere[k]);
        sl_shape_destroy(s->context, &outline);
    }
}

/// Each piece that is wide enough for a point away from all rounding.
static uint32_t check_pieces(const scene *s, const sl_overlay *overlay) {
    uint32_t checked = 0;
    sl_shape outlines[EYES + 1] = {{0}};
    for (size_t k = 1; k <= EYES; k++)
        assert_ok(s->context, sl_overlay_outline(s->context, overlay, k, &outlines[k]));
    for (uint32_t c = 0; c < overlay->pieces.cell_count; c++) {
        const sl_point p = point_in(&overlay->pieces, c);
        if (!(depth_of(&overlay->pieces, c, p) > 8 * s->tolerance)) continue;
        const uint32_t cell = sl_space_locate(&s->space, p);
        const bool inside = cell != SL_NO_CELL && s->space.cells[cell].inside;
        uint32_t seen = 0;
        for (int i = 0; i < EYES; i++) {
            bool sees = false;
            if (s->regions[i].range > 0)
                sees = winding_of(&s->shapes[i], p) != 0;
            else
                assert_ok(s->context, sli_sees(s->context, &s->outline, s->regions[i].view.eye, p,
                                               SL_CLOSED, &sees));
            seen += sees;
        }
        if (seen != overlay->counts[c] || inside != overlay->pieces.cells[c].inside)
            fail_msg("seed %llu: %.17g %.17g is seen by %u and inside %d, not %u and %u",
                     (unsigned long long)s->seed, p.x, p.y, seen, inside, overlay->counts[c],
                     overlay->pieces.cells[c].inside);
        for (size_t k = 1; k <= EYES; k++) assert_int_equal(winding_of(&outlines[k], p), seen >= k);
        checked++;
    }
    for (size_t k = 1; k <= EYES; k++) sl_shape_destroy(s->context, &outlines[k]);
    return checked;
}

static bool same_bytes(const void *a, const void *b, size_t count, size_t size) {
    return !count || memcmp(a, b, count * size) == 0;
}

/// Another order, and loops that start elsewhere.
static void check_order(const scene *s, const sl_overlay *overlay) {
    sl_shape shapes[EYES];
    sl_overlay other;
    for (int i = 0; i < EYES; i++) {
        shapes[i] = s->shapes[(i + s->seed) % EYES];
        sl_point *points = (sl_point *)(uintptr_t)shapes[i].points;
        const size_t count = shapes[i].count ? shapes[i].ends[0] : 0;
        for (size_t k = 1; k < count; k++) {
            const sl_point moved = points[k];
            points[k] = points[k - 1];
            points[k - 1] = moved;
        }
    }
    assert_ok(s->context, sl_overlay_make(s->context, &s->inside, shapes, EYES, &other));
    const sl_space *a = &overlay->pieces, *b = &other.pieces;
    assert_int_equal(a->cell_count, b->cell_count);
    assert_int_equal(a->vertex_count, b->vertex_count);
    assert_true(same_bytes(a->cells, b->cells, a->cell_count, sizeof *a->cells));
    assert_true(same_bytes(a->vertices, b->vertices, a->vertex_count, sizeof *a->vertices));
    assert_true(same_bytes(overlay->counts, other.counts, a->cell_count, sizeof *other.counts));
    assert_true(same_bytes(overlay->areas, other.areas, EYES + 1, sizeof *other.areas));
    sl_overlay_destroy(s->context, &other);
}

/// One region is itself; regions added one after the other make their union.
static void check_growing(const scene *s, const sl_overlay *overlay) {
    sl_shape explored = {0};
    for (int i = 0; i < EYES; i++) {
        sl_overlay both;
        const sl_shape shapes[] = {s->shapes[i], explored};
        assert_ok(s->context, sl_overlay_make(s->context, NULL, shapes, 1, &both));
        assert_area(s, "a region", both.areas[1], area_of(&s->shapes[i]));
        if (s->regions[i].range == 0)
            assert_area(s, "a region's area", both.areas[1], sl_region_area(&s->regions[i]));
        sl_overlay_destroy(s->context, &both);
        assert_ok(s->context, sl_overlay_make(s->context, NULL, shapes, 2, &both));
        sl_shape_destroy(s->context, &explored);
        assert_ok(s->context, sl_overlay_outline(s->context, &both, 1, &explored));
        sl_overlay_destroy(s->context, &both);
    }
    sl_shape at_once;
    assert_ok(s->context, sl_overlay_outline(s->context, overlay, 1, &at_once));
    assert_area(s, "what was explored", area_of(&explored), area_of(&at_once));
    sl_shape_destroy(s->context, &explored);
    sl_shape_destroy(s->context, &at_once);
}

static void eyes_on_random_maps(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const uint64_t seeds = testing_seeds(240);
    uint64_t checked = 0;
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        scene s;
        if (start_scene(context, seed, &s)) {
            sl_overlay overlay;
            assert_ok(context, sl_overlay_make(context, &s.inside, s.shapes, EYES, &overlay));
            check_areas(&s, &overlay);
            checked += check_pieces(&s, &overlay);
            check_growing(&s, &overlay);
            check_order(&s, &overlay);
            sl_overlay_destroy(context, &overlay);
        }
        end_scene(&s);
    }
    assert_true(checked > 20 * seeds);
    sl_context_destroy(context);
}

// --- failures

static void memory_that_runs_out(void **state) {
    (void)state;
    hand h[2];
    set_boxes(&h[0], (const double[][4]){{0, 0, 4, 4}, {1, 1, 2, -2}}, 2);
    set_boxes(&h[1], (const double[][4]){{2, 2, 4, 4}}, 1);
    const sl_shape shapes[] = {h[0].shape, h[1].shape};
    sl_context *steady = testing_context(NULL);
    sl_map map = {0};
    sl_space rooms = {0};
    testing_space(steady, "walls 0 0 4 0 4 4 0 4 0 0\nwall 2 0 2 3\n", &map, &rooms);
    for (long fail_at = 1;; fail_at++) {
        testing_memory memory = {0};
        sl_context *context = testing_context(&memory);
        const long before = memory.live;
        memory.calls = 0;
        memory.fail_at = fail_at;
        sl_overlay overlay = {0};
        sl_shape outline = {0};
        sl_status status = sl_overlay_make(context, &shapes[0], shapes, 2, &overlay);
        if (status == SL_OK) status = sl_overlay_outline(context, &overlay, 1, &outline);
        if (status == SL_OK) {
            sl_shape_destroy(context, &outline);
            status = sl_shape_of_inside(context, &rooms, &outline);
        }
        sl_shape_destroy(context, &outline);
        sl_overlay_destroy(context, &overlay);
        assert_int_equal(memory.live, before);
        sl_context_destroy(context);
        if (status == SL_OK) break;
        assert_int_equal(status, SL_NO_MEMORY);
    }
    sl_space_destroy(steady, &rooms);
    sl_map_destroy(steady, &map);
    sl_context_destroy(steady);
}

/// The wall that ends within the room is no part of the outline; a court is a hole in it.
static void outline_of_the_inside(void **state) {
    (void)state;
    static const char walls[] = "walls 0 0 9 0 9 9 0 9 0 0\nwall 2 0 2 3\n"
                                "solid 4 4 6 4 6 6 4 6\n";
    sl_context *context = testing_context(NULL);
    for (int mesh = 0; mesh < 2; mesh++) {
        sl_map map = {0};
        sl_space space = {0};
        sl_shape inside;
        testing_space(context, walls, &map, &space);
        if (mesh) {
            sl_space_destroy(context, &space);
            assert_ok(context, sli_subdivide_mesh(context, &map, &space));
        }
        assert_ok(context, sl_shape_of_inside(context, &space, &inside));
        assert_int_equal(inside.count, 2);
        assert_int_equal(inside.ends[1], 8);
        assert_true(area_of(&inside) == 77);
        sl_shape_destroy(context, &inside);
        sl_space_destroy(context, &space);
        sl_map_destroy(context, &map);
    }
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes_on_each_other),    cmocka_unit_test(holes_and_loops_that_overlap),
        cmocka_unit_test(hooks_that_touch_twice), cmocka_unit_test(nothing_and_wrong_arguments),
        cmocka_unit_test(eyes_on_random_maps),    cmocka_unit_test(outline_of_the_inside),
        cmocka_unit_test(memory_that_runs_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

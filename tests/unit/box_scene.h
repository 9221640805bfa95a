/// Scenes with boxes: a random map, and boxes that touch walls and each other, huge or tiny.
#ifndef SL_TESTS_BOX_SCENE_H
#define SL_TESTS_BOX_SCENE_H

#include "testing.h"

#include "geometry/orient.h"
#include "oracle/random_map.h"
#include "oracle/random_oblique.h"
#include "sightline/effects.h"
#include "sightline/query.h"
#include "sightline/support.h"

#include <math.h>

enum { BOXES = 6 };

typedef struct scene {
    sl_context *context;
    sl_map map, walled; ///< without the boxes, and with their sides as walls
    sl_space space, other;
    sl_query *query;
    sl_moving_box boxes[BOXES];
    size_t box_count;
    sl_random random;
    uint64_t seed;
} scene;

/// A coordinate: on the lines of walls, or anywhere.
static inline double any_coordinate(scene *s, bool y) {
    const sl_box *b = &s->space.bounds;
    const sl_wall *wall = &s->space.walls[sl_random_below(&s->random, s->space.wall_count)];
    if (sl_random_below(&s->random, 3)) return y ? wall->a.y : wall->b.x;
    const double low = y ? b->min.y : b->min.x, high = y ? b->max.y : b->max.x;
    return low + sl_random_unit(&s->random) * (high - low);
}

static inline sl_point any_point(scene *s) {
    return (sl_point){any_coordinate(s, false), any_coordinate(s, true)};
}

static inline sl_moving_box any_box(scene *s) {
    sl_point p = any_point(s), q = any_point(s);
    const double size = s->space.bounds.max.x - s->space.bounds.min.x;
    switch (sl_random_below(&s->random, 4)) {
    case 0: // tiny
        q = (sl_point){p.x + size * 0x1p-30, p.y + size * 0x1p-30};
        break;
    case 1: // over the bounds
        p.x -= size;
        break;
    default:
        break;
    }
    if (s->box_count && sl_random_below(&s->random, 3) == 0) // beside another one
        p = s->boxes[sl_random_below(&s->random, s->box_count)].box.max;
    const sl_box box = {{fmin(p.x, q.x), fmin(p.y, q.y)}, {fmax(p.x, q.x), fmax(p.y, q.y)}};
    return (sl_moving_box){box, sl_random_below(&s->random, 8) != 0};
}

/// Adds the sides of the boxes that block to the second map, within the bounds.
static inline void wall_boxes(scene *s) {
    for (size_t i = 0; i < s->box_count; i++) {
        const sl_box *c = &s->space.bounds, b = s->boxes[i].box;
        const sl_point corners[4] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}};
        for (int k = 0; k < 4 && s->boxes[i].blocks; k++) {
            sl_point p = corners[k], q = corners[(k + 1) % 4];
            p = (sl_point){fmin(fmax(p.x, c->min.x), c->max.x),
                           fmin(fmax(p.y, c->min.y), c->max.y)};
            q = (sl_point){fmin(fmax(q.x, c->min.x), c->max.x),
                           fmin(fmax(q.y, c->min.y), c->max.y)};
            // A side outside has no place on the border.
            const bool outside = k % 2 ? corners[k].x < c->min.x || corners[k].x > c->max.x
                                       : corners[k].y < c->min.y || corners[k].y > c->max.y;
            if (!outside && !sli_same_point(p, q))
                assert_ok(s->context, sl_map_add_wall(s->context, &s->walled, p, q, 0));
        }
    }
}

static inline void subdivide(scene *s, sl_map *map, sl_space *space) {
    assert_ok(s->context, sl_subdivision_for(map)->subdivide(s->context, map, NULL, space));
}

/// Makes a scene; false where the map has no walls.
static inline bool make_scene(scene *s, uint64_t seed, double degrees, double move) {
    const oracle_grid grid = degrees != 0 ? ORACLE_GRID_INTEGER : (oracle_grid)(seed % 3);
    *s = (scene){.context = s->context, .random = {seed}, .seed = seed};
    sl_map *maps[2] = {&s->map, &s->walled};
    for (int i = 0; i < 2; i++) {
        assert_ok(s->context, oracle_random_map(s->context, seed, grid, maps[i]));
        if (degrees != 0) oblique_turn_map(maps[i], degrees, move);
        assert_ok(s->context, sl_map_clean(s->context, maps[i], NULL, NULL));
    }
    if (!s->map.wall_count) return false;
    subdivide(s, &s->map, &s->space);
    const uint64_t count = 1 + sl_random_below(&s->random, BOXES);
    while (s->box_count < count) {
        s->boxes[s->box_count] = any_box(s);
        s->box_count++;
    }
    wall_boxes(s);
    assert_ok(s->context, sl_map_clean(s->context, &s->walled, NULL, NULL));
    subdivide(s, &s->walled, &s->other);
    testing_take_inside(&s->space, &s->other);
    assert_ok(s->context, sl_query_over(s->context, &s->space, &s->map, NULL, &s->query));
    assert_ok(s->context, sl_query_set_boxes(s->context, s->query, s->boxes, s->box_count));
    return true;
}

static inline void destroy_scene(scene *s) {
    sl_query_destroy(s->context, s->query);
    sl_space_destroy(s->context, &s->space);
    sl_space_destroy(s->context, &s->other);
    sl_map_destroy(s->context, &s->map);
    sl_map_destroy(s->context, &s->walled);
}

static inline sl_view any_view(scene *s, sl_point eye) {
    if (sl_random_below(&s->random, 3)) return sl_view_all_round(eye);
    sl_view view = {.eye = eye};
    do {
        view.left = any_point(s);
        view.right = any_point(s);
    } while (sli_same_point(view.left, eye) || sli_same_point(view.right, eye));
    return view;
}

/// Whether a point is on the border of a box that blocks: the space is cut for it.
static inline bool is_on_box(const scene *s, sl_point p) {
    for (size_t i = 0; i < s->box_count; i++) {
        const sl_box b = s->boxes[i].box;
        if (s->boxes[i].blocks && b.min.x <= p.x && p.x <= b.max.x && b.min.y <= p.y &&
            p.y <= b.max.y && !(b.min.x < p.x && p.x < b.max.x && b.min.y < p.y && p.y < b.max.y))
            return true;
    }
    return false;
}

static inline bool is_outside(const scene *s, sl_point p) {
    const sl_box *b = &s->space.bounds;
    return p.x < b->min.x || p.x > b->max.x || p.y < b->min.y || p.y > b->max.y;
}

static inline sl_point any_eye(scene *s, bool turned) {
    const sl_box *b = &s->space.bounds;
    if (!turned) return any_point(s);
    return (sl_point){b->min.x + sl_random_unit(&s->random) * (b->max.x - b->min.x),
                      b->min.y + sl_random_unit(&s->random) * (b->max.y - b->min.y)};
}

#endif

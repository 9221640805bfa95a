/// Random axial maps in a square, with effects: walls, doors, glass and mirrors on a grid of 8 by 8
/// points, touching, crossing and covering each other.
#ifndef SL_TESTS_RANDOM_EFFECTS_H
#define SL_TESTS_RANDOM_EFFECTS_H

#include "testing.h"

#include "sightline/effects.h"
#include "sightline/support.h"
#include "sightline/view.h"

enum { RANDOM_EFFECTS_SIZE = 7 };

static inline sl_segment random_effects_segment(sl_random *random, double scale) {
    const uint64_t points = RANDOM_EFFECTS_SIZE + 1;
    const bool upright = sl_random_below(random, 2);
    const double at = scale * (double)sl_random_below(random, points);
    const double from = scale * (double)sl_random_below(random, points);
    double to;
    do to = scale * (double)sl_random_below(random, points);
    while (to == from);
    return upright ? (sl_segment){{at, from}, {at, to}} : (sl_segment){{from, at}, {to, at}};
}

/// Anywhere on an eighth of the grid: within cells, on walls, mirrors, portals and corners.
static inline sl_point random_effects_point(sl_random *random, double scale) {
    const uint64_t steps = sl_random_below(random, 2) ? 8 : 1;
    const double step = scale / (double)steps;
    return (sl_point){(double)sl_random_below(random, RANDOM_EFFECTS_SIZE * steps + 1) * step,
                      (double)sl_random_below(random, RANDOM_EFFECTS_SIZE * steps + 1) * step};
}

/// A cone from an eye, with its sides through anywhere.
static inline sl_view random_effects_view(sl_random *random, sl_point eye, bool full,
                                          double scale) {
    sl_view view = {.eye = eye, .full = full};
    do view.right = random_effects_point(random, scale);
    while (testing_same_point(view.right, eye));
    do view.left = random_effects_point(random, scale);
    while (testing_same_point(view.left, eye));
    return view;
}

/// `effects`: bits of those that the map has; three doors, two of the others. `scale`: the grid's
/// step. The map is clean.
static inline void random_effects_map(sl_context *context, sl_random *random, unsigned effects,
                                      double scale, sl_map *map) {
    const double size = scale * RANDOM_EFFECTS_SIZE;
    const sl_point corners[5] = {{0, 0}, {size, 0}, {size, size}, {0, size}, {0, 0}};
    for (int i = 0; i < 4; i++)
        assert_ok(context, sl_map_add_wall(context, map, corners[i], corners[i + 1], 0));
    for (uint64_t i = sl_random_below(random, 5); i > 0; i--) {
        const sl_segment at = random_effects_segment(random, scale);
        assert_ok(context, sl_map_add_wall(context, map, at.a, at.b, 0));
    }
    for (int i = 0; i < 3 && effects & SL_EFFECT_DOOR; i++) {
        char name[] = {(char)('a' + i), 0};
        assert_ok(context, sl_map_add_door(context, map, name,
                                           random_effects_segment(random, scale), true, 0));
    }
    for (int i = 0; i < 2 && effects & SL_EFFECT_ONEWAY; i++)
        assert_ok(context,
                  sl_map_add_oneway(context, map, random_effects_segment(random, scale), 0));
    for (int i = 0; i < 2 && effects & SL_EFFECT_MIRROR; i++) {
        assert_ok(context,
                  sl_map_add_mirror(context, map, random_effects_segment(random, scale), 0));
        map->mirrors[i].one_sided = sl_random_below(random, 2);
    }
    if (effects & SL_EFFECT_RANGE)
        map->range = scale * (0.37 + (double)sl_random_below(random, RANDOM_EFFECTS_SIZE));
    assert_ok(context, sl_map_clean(context, map, NULL, NULL));
}

#endif

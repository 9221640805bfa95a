/// Random maps of oblique walls, degenerate on purpose: walls that cross, touch, overlap, repeat,
/// meet by the dozen in one point or all but there, at every scale and place. The same seed gives
/// the same map everywhere. And random places in them, with an oracle of what is free between two.
#ifndef SL_TESTS_RANDOM_OBLIQUE_H
#define SL_TESTS_RANDOM_OBLIQUE_H

#include "geometry/orient.h"
#include "sightline/map.h"
#include "sightline/support.h"

#include <math.h>

/// Where ends may be.
typedef enum oblique_grid {
    OBLIQUE_SQUARES,  ///< integers 0 .. 9
    OBLIQUE_ANYWHERE, ///< 0 .. 100
    OBLIQUE_TENTHS,   ///< multiples of 0.1 as rounded
    OBLIQUE_DOOM,     ///< integers -1000 .. 999
    OBLIQUE_TINY,     ///< about 1e-148
    OBLIQUE_HUGE,     ///< about 1e149
    OBLIQUE_SCALES,   ///< magnitudes from 1e-13 to 1e13, of both signs
    OBLIQUE_FAR,      ///< from 1e15 on, all within forty steps of doubles
    OBLIQUE_ULPS,     ///< from 1 on, all within twenty steps of doubles
    OBLIQUE_NEARLY,   ///< integers 0 .. 4, some a few steps of doubles off
    OBLIQUE_GRIDS,
} oblique_grid;

static inline double oblique_coordinate(sl_random *random, oblique_grid grid) {
    double value;
    switch (grid) {
    case OBLIQUE_SQUARES:
        return (double)sl_random_below(random, 10);
    case OBLIQUE_ANYWHERE:
        return sl_random_unit(random) * 100;
    case OBLIQUE_TENTHS:
        return (double)sl_random_below(random, 100) / 10;
    case OBLIQUE_DOOM:
        return (double)sl_random_below(random, 2000) - 1000;
    case OBLIQUE_TINY:
        return 1e-150 * (1 + (double)sl_random_below(random, 1000));
    case OBLIQUE_HUGE:
        return 1e148 * (double)sl_random_below(random, 100);
    case OBLIQUE_SCALES:
        value = ldexp(1 + sl_random_unit(random), (int)sl_random_below(random, 87) - 43);
        return sl_random_below(random, 2) ? value : -value;
    case OBLIQUE_FAR:
        return 1e15 + (double)sl_random_below(random, 40) * 0.125;
    case OBLIQUE_ULPS:
        return 1 + (double)sl_random_below(random, 20) * 0x1p-52;
    default:
        value = (double)sl_random_below(random, 5);
        return sl_random_below(random, 2) ? value
                                          : value + (double)sl_random_below(random, 7) * 0x1p-50;
    }
}

/// Fills an empty map with up to `most` walls: anywhere, in one line of walls, out of one point, or
/// most of them through one point but for rounding.
static inline sl_status oblique_random_map(sl_context *context, uint64_t seed, oblique_grid grid,
                                           uint64_t most, sl_map *map) {
    sl_random random = {seed};
    const uint64_t count = 1 + sl_random_below(&random, most), kind = sl_random_below(&random, 4);
    sl_point last = {0}, centre = {0};
    last.x = oblique_coordinate(&random, grid);
    last.y = oblique_coordinate(&random, grid);
    centre.x = oblique_coordinate(&random, grid);
    centre.y = oblique_coordinate(&random, grid);
    for (uint64_t i = 0; i < count; i++) {
        double at[4];
        for (int k = 0; k < 4; k++) at[k] = oblique_coordinate(&random, grid);
        sl_point a = {at[0], at[1]}, b = {at[2], at[3]};
        if (kind == 1) a = last;
        if (kind == 2) a = centre;
        const sl_point across = {2 * centre.x - a.x, 2 * centre.y - a.y};
        if (kind == 3 && i % 3 && sl_coordinate_usable(across.x) && sl_coordinate_usable(across.y))
            b = across;
        last = b;
        const sl_status status = sl_map_add_wall(context, map, a, b, (uint32_t)i + 1);
        if (status != SL_OK) return status;
    }
    return SL_OK;
}

/// A place turned about the origin and moved along both axes, as a program without much care does.
static inline sl_point oblique_turned(sl_point p, double degrees, double move) {
    const double angle = degrees * acos(-1) / 180, c = cos(angle), s = sin(angle);
    const sl_point at = {p.x * c - p.y * s + move, p.x * s + p.y * c + move};
    return (sl_point){fabs(at.x) < SL_COORDINATE_MIN ? 0 : at.x,
                      fabs(at.y) < SL_COORDINATE_MIN ? 0 : at.y};
}

static inline void oblique_turn_segment(sl_segment *s, double degrees, double move) {
    *s = (sl_segment){oblique_turned(s->a, degrees, move), oblique_turned(s->b, degrees, move)};
}

/// Turns and moves walls, what is set in them, and starts.
static inline void oblique_turn_map(sl_map *map, double degrees, double move) {
    for (size_t i = 0; i < map->wall_count; i++) {
        map->walls[i].a = oblique_turned(map->walls[i].a, degrees, move);
        map->walls[i].b = oblique_turned(map->walls[i].b, degrees, move);
    }
    for (size_t i = 0; i < map->door_count; i++)
        oblique_turn_segment(&map->doors[i].segment, degrees, move);
    for (size_t i = 0; i < map->mirror_count; i++)
        oblique_turn_segment(&map->mirrors[i].segment, degrees, move);
    for (size_t i = 0; i < map->oneway_count; i++)
        oblique_turn_segment(&map->oneways[i].segment, degrees, move);
    for (size_t i = 0; i < map->seam_count; i++)
        oblique_turn_segment(&map->seams[i].segment, degrees, move);
    for (size_t i = 0; i < map->start_count; i++)
        map->starts[i].at = oblique_turned(map->starts[i].at, degrees, move);
}

/// Whether a segment touches no wall: by exact signs alone.
static inline bool oblique_is_free(const sl_map *map, sl_point p, sl_point q) {
    for (size_t i = 0; i < map->wall_count; i++) {
        const sl_wall *w = &map->walls[i];
        if (w->a.x == w->b.x && w->a.y == w->b.y) continue;
        if (fmax(p.x, q.x) < fmin(w->a.x, w->b.x) || fmin(p.x, q.x) > fmax(w->a.x, w->b.x) ||
            fmax(p.y, q.y) < fmin(w->a.y, w->b.y) || fmin(p.y, q.y) > fmax(w->a.y, w->b.y))
            continue;
        const int p_side = sli_orient_exact(w->a, w->b, p),
                  q_side = sli_orient_exact(w->a, w->b, q);
        if (p_side * q_side > 0) continue;
        const int a_side = sli_orient_exact(p, q, w->a), b_side = sli_orient_exact(p, q, w->b);
        if (a_side * b_side <= 0) return false;
    }
    return true;
}

/// Anywhere within bounds, or near a wall, down to as near as doubles are to each other.
static inline sl_point oblique_random_point(sl_random *random, const sl_map *map, sl_box bounds) {
    const double width = bounds.max.x - bounds.min.x, height = bounds.max.y - bounds.min.y;
    if (sl_random_below(random, 3) == 0)
        return (sl_point){bounds.min.x + sl_random_unit(random) * width,
                          bounds.min.y + sl_random_unit(random) * height};
    const sl_wall *w = &map->walls[sl_random_below(random, map->wall_count)];
    const double t =
        sl_random_below(random, 2) ? sl_random_unit(random) : (double)sl_random_below(random, 2);
    const double off = ldexp(width, -6 - (int)sl_random_below(random, 46));
    return (sl_point){w->a.x + t * (w->b.x - w->a.x) + off * (sl_random_unit(random) - 0.5),
                      w->a.y + t * (w->b.y - w->a.y) + off * (sl_random_unit(random) - 0.5)};
}

#endif

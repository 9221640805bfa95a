/// Random axial maps on a small grid: walls that cross, touch, overlap, repeat and have no length,
/// on purpose; most of them in an enclosing box. The same seed gives the same map everywhere.
#ifndef SL_TESTS_RANDOM_MAP_H
#define SL_TESTS_RANDOM_MAP_H

#include "sightline/map.h"
#include "sightline/support.h"

typedef enum oracle_grid {
    ORACLE_GRID_INTEGER, ///< 0 .. 15
    ORACLE_GRID_SCALED,  ///< those times a power of two, and on both sides of 0
    ORACLE_GRID_TENTHS,  ///< multiples of 0.1 as rounded: what looks aligned is so but for a last
                         ///< bit
} oracle_grid;

/// Fills an empty map.
static inline sl_status oracle_random_map(sl_context *context, uint64_t seed, oracle_grid grid,
                                          sl_map *map) {
    sl_random random = {seed};
    uint64_t size = 8 + sl_random_below(&random, 8), count = 3 + sl_random_below(&random, 18);
    double unit = grid == ORACLE_GRID_SCALED ? (seed % 2 ? 0x1p-70 : 0x1p40) : 1;
    double shift = grid == ORACLE_GRID_SCALED ? (double)(size / 2) : 0;
    bool boxed = sl_random_below(&random, 8) != 0;
    for (uint64_t i = 0; i < count + (boxed ? 4 : 0); i++) {
        bool upright = sl_random_below(&random, 2);
        double line = (double)sl_random_below(&random, size);
        double from = (double)sl_random_below(&random, size);
        double to = (double)sl_random_below(&random, size);
        if (i >= count) { // the box
            upright = i % 2;
            line = (i - count) / 2 ? (double)size : -1;
            from = -1;
            to = (double)size;
        }
        double values[3] = {line, from, to};
        for (int k = 0; k < 3; k++) {
            values[k] = grid == ORACLE_GRID_TENTHS ? values[k] * 0.1 : (values[k] - shift) * unit;
        }
        sl_point a = {values[0], values[1]}, b = {values[0], values[2]};
        if (!upright) {
            a = (sl_point){values[1], values[0]};
            b = (sl_point){values[2], values[0]};
        }
        sl_status status = sl_map_add_wall(context, map, a, b, 0);
        if (status != SL_OK) return status;
    }
    return SL_OK;
}

#endif

/// Floors of any size for measurements, seeded: one outer loop, and holes that are crosses of thick
/// wall at the nodes of a grid. Their arms leave doorways between the rooms.
#ifndef SL_BENCH_OFFICE_MAPS_H
#define SL_BENCH_OFFICE_MAPS_H

#include "base/random.h"
#include "sightline/map.h"

/// A multiple of 1/64 from `low` to `high`: sums of such are exact.
static inline double bench_length(sl_random *random, double low, double high) {
    const uint64_t steps = (uint64_t)((high - low) * 64);
    return low + (double)sl_random_below(random, steps + 1) / 64;
}

static inline sl_status bench_add_loop(sl_context *context, sl_map *map, const sl_point *corners,
                                       int count) {
    for (int i = 0; i < count; i++) {
        const sl_status status =
            sl_map_add_wall(context, map, corners[i], corners[(i + 1) % count], 0);
        if (status != SL_OK) return status;
    }
    return SL_OK;
}

/// A floor of `crosses` x `crosses` crosses, 12 corners each; fills an empty map.
static inline sl_status bench_office_map(sl_context *context, int crosses, uint64_t seed,
                                         sl_map *map) {
    sl_random random = {seed};
    const double pitch = 8, size = pitch * (crosses + 1), thick = 0.25;
    const sl_point loop[4] = {{0, 0}, {size, 0}, {size, size}, {0, size}};
    sl_status status = bench_add_loop(context, map, loop, 4);
    for (int i = 0; i < crosses * crosses && status == SL_OK; i++) {
        const double x = pitch * (i % crosses + 1) + bench_length(&random, -0.5, 0.5);
        const double y = pitch * (i / crosses + 1) + bench_length(&random, -0.5, 0.5);
        double arm[4];
        for (int k = 0; k < 4; k++) arm[k] = bench_length(&random, 1, 3.25);
        const double t = thick + bench_length(&random, 0, 0.125);
        const sl_point cross[12] = {{x + arm[0], y - t}, {x + arm[0], y + t}, {x + t, y + t},
                                    {x + t, y + arm[1]}, {x - t, y + arm[1]}, {x - t, y + t},
                                    {x - arm[2], y + t}, {x - arm[2], y - t}, {x - t, y - t},
                                    {x - t, y - arm[3]}, {x + t, y - arm[3]}, {x + t, y - t}};
        status = bench_add_loop(context, map, cross, 12);
    }
    return status;
}

#endif

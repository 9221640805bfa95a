/// Shortest ways among walls, apart from the library: a graph of all corners that see each other,
/// by exact signs, and Dijkstra's search on it.
#ifndef SL_TESTS_WALKS_H
#define SL_TESTS_WALKS_H

#include "sightline/geometry.h"

#include <stdbool.h>
#include <stddef.h>

/// A point, and a place beside it, on the side of all walls at the point that it stands on.
typedef struct walk_end {
    sl_point at, side;
} walk_end;

/// The length of the shortest way; INFINITY for none. Walls may only meet in ends or touch each
/// other by ends; they may lie on each other. Ways may leave the walls' bounds. Aborts where there
/// is no memory. Cost: about the cube of the number of walls.
double oracle_walk(const sl_segment *walls, size_t count, walk_end from, walk_end to);

/// Whether one can walk along a polyline from one end to the other. It turns at ends of walls only.
bool oracle_can_walk(const sl_segment *walls, size_t count, walk_end from, walk_end to,
                     const sl_point *points, size_t point_count);

#endif

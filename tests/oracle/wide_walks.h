/// Ways of a disc among walls, apart from the library: a graph of points around the ends of walls,
/// and Dijkstra's search on it. Distances are doubles with a margin, so lengths are bounds.
#ifndef SL_TESTS_WIDE_WALKS_H
#define SL_TESTS_WIDE_WALKS_H

#include "sightline/geometry.h"

#include <stddef.h>

/// How far a segment is from the nearest wall, but for a relative rounding of 1e-14 of the
/// coordinates; 0 if they meet, exactly.
double oracle_room(const sl_segment *walls, size_t count, sl_segment s);

/// No way of a disc is shorter: points as far as the radius from ends of walls, which are passed
/// by somewhat smaller discs. INFINITY: there is no way. `bounds` hold the middle of the disc.
double oracle_wide_walk_least(const sl_segment *walls, size_t count, sl_box bounds, sl_point from,
                              sl_point to, double radius);

/// A disc has a way that is no longer: points somewhat farther than the radius from ends of walls.
/// INFINITY: none is known.
double oracle_wide_walk_most(const sl_segment *walls, size_t count, sl_box bounds, sl_point from,
                             sl_point to, double radius);

#endif

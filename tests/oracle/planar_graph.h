/// The proof that a planar graph is one, and is that of its segments: by rationals, and nothing of
/// the library's own. Quadratic where edges crowd; lack of memory aborts.
#ifndef SL_TESTS_PLANAR_GRAPH_H
#define SL_TESTS_PLANAR_GRAPH_H

#include "map/planar.h"

enum { ORACLE_WHY = 200 };

/// Whether no two edges cross, overlap or touch but in common ends; the first pair found is put
/// into `why`. Edges without length, and edges that are there twice, do overlap.
bool oracle_is_planar(const sl_segment *edges, size_t count, char why[ORACLE_WHY]);

/// Whether the graph is planar and each chain joins the ends of its segment, welded within `weld`:
/// no point of a chain is farther from its segment than largest_move, which is 0 where none is off,
/// and not above the largest distance by more than 2^-47 of the size. All points and edges are of
/// use to some chain, points are sorted, as far apart as the tolerance asks, and half as far from
/// edges.
bool oracle_is_graph_of(const sli_planar *graph, const sl_segment *segments, size_t count,
                        double weld, char why[ORACLE_WHY]);

#endif

/// The visibility graph of a grid of points in the open map, and the measures of it that a heat map
/// can show, under the names of `sightline vga`. A task works on it, a group of measures at a time.
#ifndef VIEWER_HEAT_GRAPH_H
#define VIEWER_HEAT_GRAPH_H

#include "sightline/query.h"
#include "sightline/vga.h"

/// The measures that it shows, by number: those of the table of SL_VGA that are of the graph, the
/// usual one first; the last one is the number of steps from a point. NULL: there is none of this
/// number.
const sl_measure *heat_measure(size_t number);
/// How many there are.
size_t heat_measure_count(void);
/// The part that computes a measure, of sl_vga_part; 0: steps, which need the graph alone.
unsigned heat_measure_part(const sl_measure *measure);

/// Zeroed to start. The caller fills the first block.
typedef struct heat_graph {
    sl_query *query;     ///< a copy of its own
    sl_vga_steps *steps; ///< its own; NULL where steps go as sight does
    double step, range;
    unsigned wanted; ///< the group to measure next; 0: none

    const sl_outline *outline;
    sl_vga_grid grid;
    sl_vga_graph graph;
    sl_vga_measures *measures; ///< by point
    uint32_t *points;          ///< by square of the grid; UINT32_MAX: none
    unsigned parts;            ///< groups that are measured
    bool made;                 ///< the graph is there
} heat_graph;

/// Takes a copy of the query of a plan for the graph. SL_UNSUPPORTED for mirrors.
sl_status heat_graph_begin(sl_context *context, const sl_baked *baked, const sl_query *query,
                           double step, double range, heat_graph *graph);

/// A grid has no more points than this: the bits of their graph take 50 MB.
enum { HEAT_POINTS_MOST = 20000 };

/// Makes the graph, if it is not there, and measures what is wanted. For task_start; `data` is the
/// heat_graph. What was there before a failure stays.
sl_status heat_graph_work(sl_context *context, void *data);

/// The point in whose square a place lies; UINT32_MAX: none.
uint32_t heat_graph_square(const heat_graph *graph, sl_point at);
/// The nearest point that is seen from a place, in its square or one beside it; UINT32_MAX: none.
uint32_t heat_graph_nearest(sl_context *context, const heat_graph *graph, sl_point at);

void heat_graph_destroy(sl_context *context, heat_graph *graph); ///< and zeroes it

#endif

/// Visibility graph analysis (Turner, Doxa, O'Sullivan and Penn 2001): a grid of points, which of
/// them see each other, and measures of that graph under the names that depthmapX gives them.
///
///     const sl_outline *outline;
///     sl_vga_grid grid = {0};
///     sl_vga_graph graph = {0};
///     sl_vga_options options = sl_vga_options_default();
///     sl_query_outline(context, query, &outline);
///     sl_vga_grid_make(context, outline, 0.5, seeds, seed_count, &grid);
///     sl_vga_graph_make(context, outline, &grid, 0, 0, &graph);
///     sl_vga_measures *measures = calloc(grid.count, sizeof *measures);
///     sl_vga_measure(context, outline, &grid, &graph, &options, measures);
///
/// Which points see each other is exact: closed sight, as of sl_query_sees. So is the graph, and so
/// are all counts. Measures are doubles.
#ifndef SIGHTLINE_VGA_H
#define SIGHTLINE_VGA_H

#include "sightline/bake.h"
#include "sightline/measures.h"
#include "sightline/query.h"
#include "sightline/space.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Points at multiples of a step, column by column, each from the lowest up. Zero it to start.
typedef struct sl_vga_grid {
    double step;
    int64_t left, bottom;   ///< the square of the first column and row: x = left * step
    uint32_t columns, rows; ///< of the squares around all points
    uint32_t count;
    sl_point *points;
    uint32_t *squares; ///< by point: column * rows + row
} sl_vga_grid;

/// Fills a grid: all points that free steps to a neighbour, up, down, left or right, lead to from
/// the seeds. Each seed stands for the grid point nearest to it. Without seeds: all points inside,
/// which are neither on a wall nor in solid ground. Points lie at multiples of the step, as
/// depthmapX puts them. A step through one-way glass is free from where it is seen through.
/// SL_BAD_ARGUMENT for a step that is not over 0, for a seed whose point is not inside the bounds,
/// for more than 2^31 squares and for more than SL_VGA_POINTS_MOST points.
SL_API sl_status sl_vga_grid_make(sl_context *context, const sl_outline *outline, double step,
                                  const sl_point *seeds, size_t seed_count, sl_vga_grid *out);
SL_API void sl_vga_grid_destroy(sl_context *context, sl_vga_grid *grid); ///< and zeroes it

/// Keeps the points of a set (bit p % 64 of word p / 64), and drops all others.
SL_API void sl_vga_grid_keep(sl_vga_grid *grid, const uint64_t *kept);
/// Adds to a zeroed set the points at the border of a grid: one of the eight squares around them
/// has no point.
SL_API sl_status sl_vga_grid_border(sl_context *context, const sl_vga_grid *grid, uint64_t *border);
/// The grid's point nearest to a place, if the place lies in its square; UINT32_MAX for none.
SL_API uint32_t sl_vga_grid_find(const sl_vga_grid *grid, sl_point place);

/// Which points see each other. No point sees itself. A row lists the points that one point sees,
/// as runs of consecutive numbers: a column of the grid is seen in few pieces. A run is two
/// numbers, each in groups of 7 bits, the lowest first: its length, and the points between it and
/// the run before. Length 0 ends a row. Zero it to start.
typedef struct sl_vga_graph {
    uint32_t count;  ///< of points
    bool directed;   ///< through one-way glass, a point may see one that does not see it
    uint64_t edges;  ///< ordered pairs that see each other
    uint8_t **rows;  ///< by 64 points: their rows, one after the other
    uint32_t *first; ///< by point: where its row begins there
} sl_vga_graph;

/// A run of a row: the points from `first` up to `stop`, without it.
typedef struct sl_vga_run {
    const uint8_t *next;
    uint32_t first, stop;
} sl_vga_run;

/// The row of a point, before its first run.
static inline sl_vga_run sl_vga_row(const sl_vga_graph *graph, uint32_t point) {
    const sl_vga_run run = {graph->rows[point / 64] + graph->first[point], 0, 0};
    return run;
}

/// Takes the next run; false at the end of the row.
///
///     for (sl_vga_run run = sl_vga_row(graph, point); sl_vga_next(&run);)
///         for (uint32_t seen = run.first; seen < run.stop; seen++) ...
static inline bool sl_vga_next(sl_vga_run *run) {
    uint32_t numbers[2] = {0, 0};
    for (int i = 0; i < 2; i++) {
        for (int shift = 0;; shift += 7) {
            const uint8_t byte = *run->next++;
            numbers[i] |= (uint32_t)(byte & 127) << shift;
            if (byte < 128) break;
        }
        if (!numbers[0]) return false;
    }
    run->first = run->stop + numbers[1];
    run->stop = run->first + numbers[0];
    return true;
}

/// Whether a point sees another. Cost: O(runs of its row).
SL_API bool sl_vga_sees(const sl_vga_graph *graph, uint32_t point, uint32_t other);

/// The most points of a grid.
#define SL_VGA_POINTS_MOST 67108864u

/// About the bytes of the graph of a grid, for those who ask before it is made: by the rows of up
/// to 256 points. `range` as below.
SL_API sl_status sl_vga_graph_bytes(sl_context *context, const sl_outline *outline,
                                    const sl_vga_grid *grid, double range, uint64_t *bytes);

/// Connects the points of a grid that see each other. `range`: no farther than this; 0 for no
/// limit. `threads`: 0 for one per core; the graph is the same for any number. SL_NO_MEMORY. Cost:
/// for each point, the rooms that it sees and the columns of points in them. With one-way glass
/// row p has the points that p sees, and measures follow those.
SL_API sl_status sl_vga_graph_make(sl_context *context, const sl_outline *outline,
                                   const sl_vga_grid *grid, double range, unsigned threads,
                                   sl_vga_graph *out);
SL_API void sl_vga_graph_destroy(sl_context *context, sl_vga_graph *graph); ///< and zeroes it
/// Several graphs as one: the points of the first come first, and no point sees one of another.
/// They have up to 2^32 - 1 points together.
SL_API sl_status sl_vga_graph_join(sl_context *context, const sl_vga_graph *graphs, size_t count,
                                   sl_vga_graph *out);

/// Groups of measures, or-ed: bits of sl_measure_group.
typedef enum sl_vga_part {
    SL_VGA_LOCAL = 1 << SL_GROUP_LOCAL,     ///< of a point, its neighbours and theirs
    SL_VGA_GLOBAL = 1 << SL_GROUP_GLOBAL,   ///< of the steps along the graph to all points
    SL_VGA_THROUGH = 1 << SL_GROUP_THROUGH, ///< of the lines that pass a point
    SL_VGA_METRIC = 1 << SL_GROUP_METRIC,   ///< of shortest paths
    SL_VGA_ANGULAR = 1 << SL_GROUP_ANGULAR  ///< of paths that turn least
} sl_vga_part;

/// Start from sl_vga_options_default().
typedef struct sl_vga_options {
    unsigned parts;        ///< of sl_vga_part; by default local and global
    uint32_t radius;       ///< steps up to this number; 0 (default): no limit
    double metric_radius;  ///< paths up to this length; 0 (default): no limit
    double angular_radius; ///< paths up to this turn, in right angles; 0 (default): no limit
    unsigned threads;      ///< 0: one per core; the result is the same for any number
    /// Points to measure: `count` from `first` on; count 0 (default): all. The values are the same.
    /// Through vision is of all points in any case.
    uint32_t first, count;
} sl_vga_options;

/// The default options.
SL_API sl_vga_options sl_vga_options_default(void);

/// What depthmapX gives a point. NAN for a measure that is not defined, because its formula divides
/// by 0 or takes the logarithm of 0 (no neighbour, one point, no point deeper than a step, a
/// neighbour that sees nothing through one-way glass), or of a part that was not asked for. Values
/// are never infinite. measures.h says what each is. Connectivity is of the global measures too.
typedef struct sl_vga_measures {
    SL_GRAPH_MEASURES(SL_MEASURE_MEMBER)
    SL_GRAPH_COUNTS(SL_MEASURE_MEMBER)
} sl_vga_measures;

/// Measures all points; `measures` has an entry for each. Paths go from point to point along the
/// graph. They turn only at points beside walls, as those of depthmapX do: where a wall touches one
/// of the nine squares about the point. Their lengths and turns are added up in single precision,
/// likewise.
SL_API sl_status sl_vga_measure(sl_context *context, const sl_outline *outline,
                                const sl_vga_grid *grid, const sl_vga_graph *graph,
                                const sl_vga_options *options, sl_vga_measures *measures);

/// About the bytes that sl_vga_measure takes, for those who ask before the work. The graph and
/// `measures` count too. Up to 2.5 times the true number: lists have room, and queues are guessed.
/// Cost: O(edges).
SL_API sl_status sl_vga_measure_bytes(sl_context *context, const sl_outline *outline,
                                      const sl_vga_grid *grid, const sl_vga_graph *graph,
                                      const sl_vga_options *options, uint64_t *bytes);

/// How mean depths are estimated. Start from sl_vga_estimate_default().
typedef struct sl_vga_estimate {
    uint32_t roots;    ///< points to search from, of each part of the graph; by default 256
    double confidence; ///< between 0 and 1; by default 0.99
    uint64_t seed;     ///< roots are drawn by it
    unsigned threads;  ///< 0: one per core; the result is the same for any number
} sl_vga_estimate;

/// The default options.
SL_API sl_vga_estimate sl_vga_estimate_default(void);

/// Where the exact value lies, ends included. NAN where it is not defined.
typedef struct sl_vga_interval {
    double least, most;
} sl_vga_interval;

/// Estimates visual_mean_depth, and integration from it, by searches from a few roots alone. The
/// other measures are NAN, but connectivity and visual_node_count, which are exact. `intervals`, by
/// point, are of the mean depth. Integration falls as depth grows, so their ends bound it, too.
///
/// Guarantee: for each point that is no root, over all ways to draw roots, the probability that its
/// exact mean depth is outside its interval is at most 1 - confidence (Hoeffding 1963). It is of
/// one point, not of all at once: errors of points near each other go together. Of n roots, ends
/// are about the square root of 1 / n apart. Values of roots are exact, and of all points in parts
/// with no more points than roots.
///
/// SL_UNSUPPORTED for a directed graph. Cost: a search for each root; the graph is needed whole.
SL_API sl_status sl_vga_estimate_depths(sl_context *context, const sl_vga_grid *grid,
                                        const sl_vga_graph *graph, const sl_vga_estimate *options,
                                        sl_vga_measures *measures, sl_vga_interval *intervals);

/// Whether sl_vga_estimate_depths gives a measure of sl_vga_measures.
SL_API bool sl_vga_is_estimated(const sl_measure *measure);

/// Two points of a grid that are one place, as stairs and lifts make them. Links that share a point
/// join all of their points.
typedef struct sl_vga_link {
    uint32_t a, b;
} sl_vga_link;

/// As sl_vga_measure, with links, as depthmapX treats merged points. Linked points count as one
/// place in steps and paths: a link takes no step, no length and no turn. Local measures and
/// through vision do not change. Paths may turn at linked points. SL_BAD_ARGUMENT for a link of a
/// point with itself, or to no point, and for links with options.count. Cost of metric and angular
/// measures: O(pairs that see each other) for each point.
SL_API sl_status sl_vga_measure_linked(sl_context *context, const sl_outline *outline,
                                       const sl_vga_grid *grid, const sl_vga_graph *graph,
                                       const sl_vga_link *links, size_t link_count,
                                       const sl_vga_options *options, sl_vga_measures *measures);

/// How far a point is from chosen points, under depthmapX' names. NAN where nothing leads to it, or
/// for a part that was not asked for. The paths are those of sl_vga_measure: "shortest" is the
/// shortest among those that turn only at points beside walls. It may be longer than the shortest
/// path of the plan, which turns at corners. Lengths and turns are added up in single precision, as
/// in depthmapX. measures.h says what each is.
typedef struct sl_vga_depths {
    SL_DEPTH_MEASURES(SL_MEASURE_MEMBER)
} sl_vga_depths;

/// The depths of all points from the nearest of some points. `parts`: SL_VGA_GLOBAL for steps,
/// SL_VGA_METRIC, SL_VGA_ANGULAR, or-ed. Paths and links are those of sl_vga_measure_linked.
/// `depths` has an entry for each point.
SL_API sl_status sl_vga_depth(sl_context *context, const sl_outline *outline,
                              const sl_vga_grid *grid, const sl_vga_graph *graph,
                              const sl_vga_link *links, size_t link_count, unsigned parts,
                              const uint32_t *from, size_t from_count, sl_vga_depths *depths);

/// How one steps in a map where some walls stop steps and not sight, or sight and not steps: a low
/// wall, a window, a curtain (sl_map_steps_differ). The grid, paths and agents go by steps, all
/// else by sight. NULL stands for a map where both are the same.
typedef struct sl_vga_steps sl_vga_steps;

/// Makes it, with a note; *out stays NULL where both are the same. `sight`: what was cut for sight,
/// or read. `doors`: a query over it, whose doors stand as they shall; NULL: as the map has them.
/// `options`: how its walls were cleaned and cut; NULL: the defaults. Cost: as sl_bake_cells.
SL_API sl_status sl_vga_steps_create(sl_context *context, const sl_baked *sight,
                                     const sl_query *doors, const sl_bake_options *options,
                                     sl_vga_steps **out);
SL_API void sl_vga_steps_destroy(sl_context *context, sl_vga_steps *steps); ///< NULL: nothing
/// The outline that the grid is filled in; `sight` where `steps` is NULL.
SL_API const sl_outline *sl_vga_steps_outline(const sl_vga_steps *steps, const sl_outline *sight);
/// Connects points that see each other and between which one steps straight, for agents. `sights`:
/// which see each other.
SL_API sl_status sl_vga_steps_connect(sl_context *context, const sl_vga_steps *steps,
                                      const sl_vga_grid *grid, const sl_vga_graph *sights,
                                      unsigned threads, sl_vga_graph *out);
/// sl_vga_measure, but that shortest and straightest paths go by steps. The graph of these is made
/// once and kept. Memory: with `steps`, that graph and a second `measures`.
SL_API sl_status sl_vga_measure_walked(sl_context *context, const sl_outline *outline,
                                       const sl_vga_grid *grid, const sl_vga_graph *graph,
                                       sl_vga_steps *steps, const sl_vga_options *options,
                                       sl_vga_measures *measures);
/// sl_vga_measure_linked, likewise.
SL_API sl_status sl_vga_measure_walked_linked(sl_context *context, const sl_outline *outline,
                                              const sl_vga_grid *grid, const sl_vga_graph *graph,
                                              sl_vga_steps *steps, const sl_vga_link *links,
                                              size_t link_count, const sl_vga_options *options,
                                              sl_vga_measures *measures);
/// sl_vga_depth, likewise. `threads` make the graph of steps.
SL_API sl_status sl_vga_depth_walked(sl_context *context, const sl_outline *outline,
                                     const sl_vga_grid *grid, const sl_vga_graph *graph,
                                     sl_vga_steps *steps, const sl_vga_link *links,
                                     size_t link_count, unsigned parts, const uint32_t *from,
                                     size_t from_count, unsigned threads, sl_vga_depths *depths);

/// The number of points in the part of each point: all that steps join to it, in either direction,
/// and links. `sizes` has an entry for each point. Cost: O(runs).
SL_API sl_status sl_vga_part_sizes(sl_context *context, const sl_vga_graph *graph,
                                   const sl_vga_link *links, size_t link_count, uint32_t *sizes);

/// The part of each point, by number: the largest is 0, of two alike the one whose first point
/// comes first. `parts` has an entry for each point. Cost as above.
SL_API sl_status sl_vga_parts(sl_context *context, const sl_vga_graph *graph,
                              const sl_vga_link *links, size_t link_count, uint32_t *parts,
                              uint32_t *part_count);

/// The ends of a colour scale that small parts do not set. A courtyard that nobody looks into may
/// score many times as high as all rooms of the plan.
typedef struct sl_vga_scale {
    double least, most;    ///< of the points in other parts; no value: INFINITY and -INFINITY
    uint32_t small_points; ///< points in parts with less than a tenth of the largest one's points
    uint32_t small_parts;
    uint32_t beyond; ///< values beyond the ends: all are in small parts
} sl_vga_scale;

/// Finds the scale of a measure. `values` (NAN for none) and `sizes` (sl_vga_part_sizes) are by
/// point.
SL_API sl_vga_scale sl_vga_scale_of(const double *values, const uint32_t *sizes, uint32_t count);

/// Agents that walk by sight. Start from sl_vga_agents_default().
typedef struct sl_vga_agents {
    uint32_t agents, steps; ///< their number, and the steps of each; 1000 by default
    uint32_t look;          ///< steps until an agent picks its next goal; by default 3
    double view;            ///< the field of view in degrees, over 0; by default 170
    uint64_t seed;
    const uint32_t *starts; ///< the points to start from, by chance; none: all points
    size_t start_count;
    unsigned threads; ///< 0: one per core; the result is the same for any number
} sl_vga_agents;

/// The default options: those of Turner and Penn 2002.
SL_API sl_vga_agents sl_vga_agents_default(void);

/// Counts how often agents step onto each point ("gate counts" of depthmapX). `counts` has an entry
/// for each point. An agent picks a point ahead that it sees, walks towards it for some steps, and
/// picks anew. SL_BAD_ARGUMENT for a start that is no point, for `look` 0, and for a field of view
/// that is not over 0 and at most 360. Agents walk wherever they see: leave out glass.
SL_API sl_status sl_vga_walk_agents(sl_context *context, const sl_vga_grid *grid,
                                    const sl_vga_graph *graph, const sl_vga_agents *options,
                                    uint64_t *counts);

/// Turns a graph over: row p then has the points that see p. For graphs with one-way glass.
SL_API sl_status sl_vga_graph_turn(sl_context *context, sl_vga_graph *graph);

/// The number of steps from the nearest of some points to each point; UINT32_MAX for those that no
/// steps lead to. `depths` has an entry for each point.
SL_API sl_status sl_vga_step_depth(sl_context *context, const sl_vga_graph *graph,
                                   const uint32_t *from, size_t from_count, uint32_t *depths);

#ifdef __cplusplus
}
#endif

#endif

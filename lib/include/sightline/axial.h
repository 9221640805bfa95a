/// Axial and segment analysis (Hillier and Hanson 1984): the longest lines of sight and access of a
/// plan, the network that they or drawn lines make, and measures of it under depthmapX' names.
///
///     const sl_outline *outline;
///     sl_axial_lines lines = {0};
///     sl_line_graph graph = {0};
///     sl_axial_options options = {0};
///     sl_query_outline(context, query, &outline);
///     sl_axial_all_lines(context, outline, 0, &lines);
///     sl_axial_fewest(context, &lines, true);
///     sl_line_graph_make(context, lines.lines, lines.count, &graph);
///     sl_axial_measure(context, lines.lines, &graph, &options, measures);
///
/// Who crosses whom is exact for the coordinates of the lines. Counts are exact, measures are
/// doubles. Results are the same for any number of threads.
#ifndef SIGHTLINE_AXIAL_H
#define SIGHTLINE_AXIAL_H

#include "sightline/measures.h"
#include "sightline/space.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Lines of a plan. `probes`: what the lines must cross to cover the plan (sl_axial_fewest). Zero
/// it to start.
typedef struct sl_axial_lines {
    sl_segment *lines;
    sl_segment *probes;
    uint32_t count, probe_count;
} sl_axial_lines;

/// The all-line map (Penn, Conroy, Dalton, Dekker, Mottram and Turner 1997): each line that passes
/// two corners of walls that see each other, made as long as no wall crosses it. It passes a corner
/// at which all walls are on one side. It ends at a corner of a room. Which corners it passes is
/// exact; its ends are rounded where they are not corners. Only lines inside are taken: the cells
/// beside walls say it, exactly. A line may lie within a longer one, as walls have two sides. A
/// plan that is turned by quarters or mirrored has the same lines. Probes are
/// the walls' own lines, extended beyond corners into the open (the s-lines of Peponis, Wineman,
/// Bafna, Rashid and Kim 1998). `threads`: 0 for one per core. Cost: O(corners^2) tests of sight,
/// and the walls near the line for each pair in sight.
SL_API sl_status sl_axial_all_lines(sl_context *context, const sl_outline *outline,
                                    unsigned threads, sl_axial_lines *out);
SL_API void sl_axial_lines_destroy(sl_context *context, sl_axial_lines *lines); ///< and zeroes it

/// Drops lines, shortest first, but keeps two things (after Turner, Penn and Hillier 2005): each
/// probe that was crossed, from side to side, is crossed by a line that stays, and lines that a
/// line joins stay joined. First all lines go that cross no probe beside those that one longer line
/// crosses. With `fewest`, then all that can go alone. Each part of a plan keeps a line. Lines keep
/// their order. Of equally long lines the one that crosses more probes stays, then the first. Which
/// is first may change if the plan is turned.
SL_API sl_status sl_axial_fewest(sl_context *context, sl_axial_lines *lines, bool fewest);

/// Which lines have a point in common: others[first[i] .. first[i + 1]), ascending. Zero it to
/// start.
typedef struct sl_line_graph {
    uint32_t count;
    size_t *first;
    uint32_t *others;
} sl_line_graph;

/// Exact: closed segments that touch are joined. SL_UNSUPPORTED for more pairs than fit into half
/// of the machine's memory. Cost: O(n log n + pairs whose extents in x overlap).
SL_API sl_status sl_line_graph_make(sl_context *context, const sl_segment *lines, uint32_t count,
                                    sl_line_graph *out);
SL_API void sl_line_graph_destroy(sl_context *context, sl_line_graph *graph); ///< and zeroes it

/// Zeroed: no limits, one thread per core.
typedef struct sl_axial_options {
    uint32_t radius; ///< steps up to this number
    unsigned threads;
} sl_axial_options;

/// Of an axial line: measures.h says what each is. NAN for a measure that is not defined.
typedef struct sl_axial_measures {
    SL_AXIAL_MEASURES(SL_MEASURE_MEMBER)
} sl_axial_measures;

/// Measures all lines: a step leads to a line that touches. Choice is betweenness (Brandes 2001):
/// several shortest paths share the 1 of their pair. Cost: O(lines * pairs that touch).
SL_API sl_status sl_axial_measure(sl_context *context, const sl_segment *lines,
                                  const sl_line_graph *graph, const sl_axial_options *options,
                                  sl_axial_measures *measures);

/// Zeroed: no limits, one thread per core.
typedef struct sl_segment_options {
    double metric_radius;  ///< segments up to this far along the network, from middle to middle
    double angular_radius; ///< segments that paths lead to with up to this turn, in right angles
    unsigned threads;
    const double *weights;   ///< by segment, from 0 to SL_SEGMENT_WEIGHT_MAX; NULL: 1
    const sl_point *unlinks; ///< crossings that are no junctions (sl_segment_crossing)
    uint32_t unlink_count;
} sl_segment_options;

/// The largest weight of a segment (sl_segment_options.weights).
#define SL_SEGMENT_WEIGHT_MAX 1e100

/// Of a segment (Turner 2007, From axial to road-centre lines). Angles are rounded to the nearest
/// 1024th part of a full turn. depthmapX' analyses T1024 round them down to a 513th of a half turn.
/// NAN for a measure that is not defined. measures.h says what each is.
typedef struct sl_segment_measures {
    SL_SEGMENT_MEASURES(SL_MEASURE_MEMBER)
} sl_segment_measures;

/// Measures segments that meet at common ends only, as walls of a clean map do (sl_map_clean).
/// Paths turn least. Of those that turn equally, the ones of the fewest segments count, and share
/// the 1 of their pair. With weights, a segment counts as its weight in node count and total depth,
/// and a pair as the product of both weights in choice. A pair does not count for its own two
/// segments; in depthmapX, half of the product does. At an unlinked crossing, where four segments
/// meet, a path only goes straight on: from each to the second one around.
///
/// Choice is a sum of whole units, so it is the same for any number of threads. Each share of a tie
/// is rounded to a unit. So where there are ties, its last digits may change with the order of the
/// segments, and when the network is turned. A unit is 2^-24 up to 262,143 segments. From 2^(k-1)
/// to below 2^k segments, k from 19 on, it is 2^(2k-61). With weights it is that for their sum.
///
/// SL_BAD_ARGUMENT for a segment without length, a weight out of range, and an unlink where there
/// are not four.
SL_API sl_status sl_segment_measure(sl_context *context, const sl_segment *segments, uint32_t count,
                                    const sl_segment_options *options,
                                    sl_segment_measures *measures);

/// The end of segments that is nearest to a point: the crossing that is meant by it.
/// SL_BAD_ARGUMENT if there are not four segments, or if the point is farther from it than half the
/// shortest of them. Time O(count).
SL_API sl_status sl_segment_crossing(sl_context *context, const sl_segment *segments,
                                     uint32_t count, sl_point point, sl_point *crossing);

/// Weights of segments that are pieces of streets: pieces share the value of their street by their
/// lengths. `streets`: by segment, the place of its street in `values`. `weights` has room for
/// `count`. SL_BAD_ARGUMENT for a street that is not there, and for a segment without length.
SL_API sl_status sl_segment_share(sl_context *context, const sl_segment *segments, uint32_t count,
                                  const uint32_t *streets, const double *values,
                                  uint32_t street_count, double *weights);

#ifdef __cplusplus
}
#endif

#endif

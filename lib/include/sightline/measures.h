/// All measures of isovists, visibility graphs, axial lines and segments: one row each.
///
/// A row is all of a measure but its computation: name, group, unit, and what it means.
/// The structures of values (sl_region_measures, sl_vga_measures and so on) have a double for each
/// row, in this order. Commands, the viewer, the bindings and their help take their lists from
/// sl_measures().
#ifndef SIGHTLINE_MEASURES_H
#define SIGHTLINE_MEASURES_H

#include "sightline/context.h"

#ifdef __cplusplus
extern "C" {
#endif

// --- the rows: name, group, unit, meaning

// clang-format off
/// Of a visible region (sl_region_measures).
#define SL_ISOVIST_MEASURES(row) \
    row(area,            ISOVIST, AREA,    "area of the visible region") \
    row(perimeter,       ISOVIST, LENGTH, \
        "length of all its edges, borders of a view cone among them") \
    row(compactness,     ISOVIST, NONE,    "4 pi area / perimeter^2: 1 for a circle") \
    row(occlusivity,     ISOVIST, LENGTH,  "length of the occluding edges: more is behind them") \
    row(drift_magnitude, ISOVIST, LENGTH,  "from the eye to the region's centre of gravity") \
    row(drift_angle,     ISOVIST, DEGREES, \
        "direction of the drift: 0 to 360, counter-clockwise from +x") \
    row(min_radial,      ISOVIST, LENGTH, \
        "to the nearest point of an edge that is not of the view cone") \
    row(max_radial,      ISOVIST, LENGTH,  "to the farthest point")
/// Likewise, over all directions of the view, by angle (Benedikt 1979, To Take Hold of Space). Not
/// in the table of visibility graphs.
#define SL_RADIAL_MEASURES(row) \
    row(mean_radial,     RADIAL, LENGTH, "mean length of the radials") \
    row(radial_variance, RADIAL, AREA,   "second moment of the radials about their mean") \
    row(radial_skewness, RADIAL, VOLUME, "third moment of the radials about their mean")

/// Of a point of a visibility graph (sl_vga_measures). Integration: Hillier and Hanson 1984;
/// Teklenburg, Timmermans and van Wagenberg 1993.
#define SL_GRAPH_MEASURES(row) \
    row(connectivity,                       LOCAL,   NONE,   "number of points seen") \
    row(visual_mean_depth,                  GLOBAL,  NONE,   "mean number of steps to all points") \
    row(visual_node_count,                  GLOBAL,  NONE, \
        "points that steps lead to, itself included") \
    row(visual_integration_hh,              GLOBAL,  NONE, \
        "1 / real relative asymmetry (Hillier and Hanson 1984)") \
    row(visual_integration_tekl,            GLOBAL,  NONE, \
        "integration of Teklenburg et al. 1993; none with one point two steps away") \
    row(visual_integration_pvalue,          GLOBAL,  NONE,   "integration relative to a pyramid") \
    row(visual_entropy,                     GLOBAL,  BITS,   "of the numbers of points by depth") \
    row(visual_relativised_entropy,         GLOBAL,  BITS, \
        "against a Poisson distribution of the same mean") \
    row(visual_clustering_coefficient,      LOCAL,   NONE, \
        "share of the pairs of neighbours that see each other") \
    row(visual_control,                     LOCAL,   NONE, \
        "sum over the neighbours of 1 / their connectivity") \
    row(visual_controllability,             LOCAL,   NONE, \
        "neighbours, of all points that they see together") \
    row(point_first_moment,                 LOCAL,   LENGTH, \
        "sum of the distances to the points seen") \
    row(point_second_moment,                LOCAL,   AREA, \
        "sum of the squares of these distances") \
    row(through_vision,                     THROUGH, NONE, \
        "lines between two points that see each other, both ways, through it") \
    row(metric_mean_shortest_path_distance, METRIC,  LENGTH, "mean length of the shortest paths") \
    row(metric_mean_shortest_path_angle,    METRIC,  TURNS,  "mean turn along the shortest paths") \
    row(metric_mean_straight_line_distance, METRIC,  LENGTH, "mean distance, through walls") \
    row(angular_mean_depth,                 ANGULAR, TURNS, \
        "mean turn along paths that turn least") \
    row(angular_total_depth,                ANGULAR, TURNS,  "sum of the turns along these paths")
/// Likewise. In tables they follow the isovists.
#define SL_GRAPH_COUNTS(row) \
    row(metric_node_count,  METRIC,  NONE, "points that paths lead to, itself included") \
    row(angular_node_count, ANGULAR, NONE, "points that paths lead to, itself included")
/// Of a point: how far it is from chosen points (sl_vga_depths).
#define SL_DEPTH_MEASURES(row) \
    row(visual_step_depth,                GLOBAL,  NONE,   "steps along the graph") \
    row(metric_step_shortest_path_length, METRIC,  LENGTH, \
        "length of the shortest path that turns beside walls") \
    row(metric_step_shortest_path_angle,  METRIC,  TURNS,  "turn along this path") \
    row(metric_straight_line_distance,    METRIC,  LENGTH, "distance, through walls") \
    row(angular_step_depth,               ANGULAR, TURNS,  "turn along the path that turns least")
/// Of a point: what sl_vga_walk_agents counts.
#define SL_AGENT_MEASURES(row) \
    row(gate_counts, AGENTS, NONE, "steps of agents onto the point")

/// Of an axial line (sl_axial_measures).
#define SL_AXIAL_MEASURES(row) \
    row(connectivity,       LINE,    NONE,   "lines that it touches") \
    row(line_length,        LINE,    LENGTH, "length of the line") \
    row(control,            LINE,    NONE, \
        "sum over the lines that it touches of 1 / their connectivity") \
    row(controllability,    LINE,    NONE, \
        "lines that it touches, of all lines that these touch together") \
    row(choice,             NETWORK, NONE, \
        "shortest paths between two other lines through it: each pair counts 1") \
    row(choice_norm,        NETWORK, NONE,   "choice, of all pairs within reach") \
    row(node_count,         NETWORK, NONE,   "lines that steps lead to, itself included") \
    row(total_depth,        NETWORK, NONE,   "sum of the steps to all lines") \
    row(mean_depth,         NETWORK, NONE,   "mean number of steps to all lines") \
    row(integration_hh,     NETWORK, NONE, \
        "1 / real relative asymmetry (Hillier and Hanson 1984)") \
    row(integration_pvalue, NETWORK, NONE,   "integration relative to a pyramid") \
    row(integration_tekl,   NETWORK, NONE, \
        "integration of Teklenburg et al. 1993; none with one line two steps away") \
    row(entropy,            NETWORK, BITS,   "of the numbers of lines by depth")

/// Of a segment (sl_segment_measures).
#define SL_SEGMENT_MEASURES(row) \
    row(connectivity,      LINE,    NONE,   "segments at its two ends") \
    row(segment_length,    LINE,    LENGTH, "length of the segment") \
    row(t1024_choice,      NETWORK, NONE, \
        "paths between two others through it: each pair counts 1") \
    row(t1024_integration, NETWORK, NONE,   "node count^2 / total depth") \
    row(t1024_node_count,  NETWORK, NONE,   "segments that paths lead to, itself included") \
    row(t1024_total_depth, NETWORK, TURNS,  "sum of the turns to all segments") \
    row(nach,              NETWORK, NONE, \
        "log10(choice + 1) / log10(total depth + 3) (Hillier et al. 2012)") \
    row(nain,              NETWORK, NONE,   "node count^1.2 / total depth (Hillier et al. 2012)")
// clang-format on

/// The member that a row stands for in a structure of values.
#define SL_MEASURE_MEMBER(name, group, unit, meaning) double name;

// --- the table

/// What has measures.
typedef enum sl_analysis {
    SL_ISOVIST, ///< visible regions
    SL_VGA,     ///< visibility graphs, with isovists, depths and agents
    SL_AXIAL,   ///< axial lines
    SL_SEGMENTS ///< segments of lines
} sl_analysis;

/// What holds the values of a measure.
typedef enum sl_measure_of {
    SL_OF_REGION, ///< sl_region_measures
    SL_OF_GRAPH,  ///< sl_vga_measures
    SL_OF_DEPTH,  ///< sl_vga_depths
    SL_OF_AGENTS, ///< the counts of sl_vga_walk_agents
    SL_OF_LINE,   ///< sl_axial_measures
    SL_OF_SEGMENT ///< sl_segment_measures
} sl_measure_of;

/// Groups of measures. The first ones, as bits, are the parts of sl_vga_part: 1 << SL_GROUP_METRIC.
typedef enum sl_measure_group {
    SL_GROUP_LOCAL,   ///< of a point, its neighbours and theirs
    SL_GROUP_GLOBAL,  ///< of the steps along the graph to all points
    SL_GROUP_THROUGH, ///< of the lines that pass a point
    SL_GROUP_METRIC,  ///< of shortest paths
    SL_GROUP_ANGULAR, ///< of paths that turn least
    SL_GROUP_ISOVIST, ///< of visible regions
    SL_GROUP_RADIAL,  ///< of visible regions, over all directions
    SL_GROUP_AGENTS,  ///< of agents that walk
    SL_GROUP_LINE,    ///< of a line and those that it meets
    SL_GROUP_NETWORK  ///< of the paths along all lines; a radius limits them
} sl_measure_group;

/// Units.
typedef enum sl_measure_unit {
    SL_UNIT_NONE,   ///< a number, or a ratio
    SL_UNIT_LENGTH, ///< that of the map
    SL_UNIT_AREA,   ///< its square
    SL_UNIT_VOLUME, ///< its cube
    SL_UNIT_DEGREES,
    SL_UNIT_TURNS, ///< right angles
    SL_UNIT_BITS
} sl_measure_unit;

/// A row of the table.
typedef struct sl_measure {
    const char *name; ///< of columns
    sl_measure_of of;
    sl_measure_group group;
    sl_measure_unit unit;
    const char *meaning; ///< in a few words
    size_t index;        ///< of its double in the structure of values
} sl_measure;

/// The measures of an analysis, in the order of its columns. Static.
SL_API const sl_measure *sl_measures(sl_analysis analysis, size_t *count);

/// The place of a measure in that table; the count of rows for none of that name.
SL_API size_t sl_measure_find(sl_analysis analysis, const char *name);

/// The value of a measure, out of the structure that holds it. Not of SL_OF_AGENTS.
SL_API double sl_measure_value(const sl_measure *measure, const void *values);

/// The group as users choose it: "visual" for local and global ones, "isovist" for radial ones too.
SL_API const char *sl_measure_group_name(sl_measure_group group);

/// Room for a unit as text.
#define SL_UNIT_TEXT 48

/// The unit of a measure of a map whose lengths are in `unit`: "m²"; "" for none, and for lengths
/// without a unit.
SL_API void sl_measure_say_unit(const sl_measure *measure, const char *unit,
                                char text[SL_UNIT_TEXT]);

#ifdef __cplusplus
}
#endif

#endif

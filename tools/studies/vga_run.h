/// A visibility graph from a map to its measures, as `sightline vga` asks for it.
#ifndef VGA_RUN_H
#define VGA_RUN_H

#include "inputs/pipeline.h"
#include "sightline/draw.h"
#include "sightline/query.h"
#include "studies/vga_grid.h"
#include "studies/vga_table.h"

/// What is asked.
typedef struct vga_plan {
    const char *command; ///< what messages call it
    const char *storey;  ///< of a building: which one the picture shows
    bool of_building;    ///< a storey: what goes over links is left to the building
    const char *input, *output, *picture, *pairs;
    const char *compare;      ///< another plan, to be compared
    const sl_map *first;      ///< of the other plan: the map that it is compared with
    const char *compare_shut; ///< its doors that are shut
    door_choice doors;
    map_pipeline pipeline;
    vga_grid_plan points;
    option_list from, agents_from;
    sl_vga_agents agents;
    const char *agents_given, *agent_option;
    double range;
    table_part part; ///< of the table: other rows have no values
    sl_vga_estimate estimate;
    const char *estimate_given, *seed_given;
    bool turned;      ///< who sees a point, in place of what it sees
    bool global_only; ///< no local measures
    unsigned parts;
    const char *step_given, *parts_given, *range_given, *measure_given, *scale_given;
    const char *visual_given, *metric_given, *angular_given; ///< radii
    size_t measure;
    sl_point scale; ///< from x to y
    sl_vga_options options;
    sl_draw_options drawing;
} vga_plan;

/// What comes of it. Zeroed, nothing.
typedef struct vga_work {
    sl_baked baked;
    sl_query *query;
    const sl_outline *outline; ///< the query's
    sl_vga_steps *steps;       ///< NULL where steps go as sight does
    sl_vga_graph graph;
    sl_vga_link *links;
    size_t link_count;
    eye_places eyes; ///< the points again, for their regions
    vga_table table;
} vga_work;

/// From the map to its measures. Without a step (points.step is 0) one is chosen: the largest round
/// one that gives at least about 2000 points. Notes what is in doubt. The caller destroys `w` after
/// a failure, too.
sl_status vga_compute(sl_context *context, vga_plan *plan, vga_work *w);
void vga_work_destroy(sl_context *context, vga_work *w);

#endif

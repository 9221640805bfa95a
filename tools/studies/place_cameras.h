/// `place --from`: which of given places and headings see the area. Places come from walls,
/// corners, a grid or a table.
#ifndef PLACE_CAMERAS_H
#define PLACE_CAMERAS_H

#include "inputs/pipeline.h"
#include "inputs/see_lines.h"
#include "reports/json_print.h"
#include "sightline/place_proof.h"
#include "studies/cover_path.h"
#include "studies/cover_zones.h"

/// Lengths of a thing made of lines: inside, and what is seen of that.
typedef struct line_cover {
    double inside, seen;
} line_cover;

/// What the options say.
typedef struct camera_plan {
    const char *from, *see, *path, *forbid, *fixed, *weight;
    sl_viewpoint like; ///< what a table leaves out, and all other places
    uint32_t headings, cover, count;
    bool network;                  ///< lines of sight join all viewpoints
    double scan_angle, scan_range; ///< walls are to be seen so; 0: the area is
} camera_plan;

typedef struct camera_work {
    sl_cameras places; ///< to choose from: the fixed ones first
    sl_viewpoint *views;
    uint32_t *costs, *fixed;
    double scale;     ///< costs are those of the tables times this
    size_t points;    ///< different ones among the places
    size_t forbidden; ///< points that --forbid took away
    zone_list see;
    sl_shape shape;
    sl_shape *zones; ///< of `see`, with `zone_ends` and `weights`; NULL where no weight is given
    size_t *zone_ends;
    double *weights;
    see_lines lines;      ///< to be seen: doors and routes
    double *line_weights; ///< by segment of `lines`, with `weights`
    sl_place_area task;
    sl_area_placement placed;
    zone_covers covers; ///< by zone of `see`, and by thing of `lines`: what is seen in the end
    line_cover *line_covers;
} camera_work;

camera_plan camera_plan_default(void);
option_table camera_option_table(camera_plan *plan);

/// Whether the options ask for chosen places, and not for viewpoints anywhere.
bool camera_plan_chooses(const camera_plan *plan);

/// Refuses options that say too little or contradict each other. `proof`: the name of an option for
/// proofs, which goes with less; NULL without one.
sl_status camera_plan_check(sl_context *context, const camera_plan *plan, const char *proof);

/// The places to choose from, and what is to be seen. `step`: between places along walls, where the
/// options do not say.
sl_status camera_work_prepare(sl_context *context, const camera_plan *plan,
                              const input_options *input, const sl_baked *baked, sl_query *query,
                              camera_work *w);

/// Whether walls are to be seen, and not the area.
bool camera_work_scans(const camera_work *w);

/// The chosen places, to print and draw.
sl_status camera_work_chosen(sl_context *context, const camera_work *w, sl_cameras *out);

/// What is proven, in a sentence or two; `stopped`: the work ended early.
void camera_work_say(const camera_work *w, bool stopped, char *text, size_t size);

/// Bounds, and areas of what is to be seen.
void camera_work_add_json(json_fields *fields, const camera_work *w);

/// What holds of a proof.
void camera_work_print_verdict(const camera_work *w, const sl_place_area_verdict *v, int digits);
void camera_work_add_verdict_json(json_fields *fields, const camera_work *w,
                                  const sl_place_area_verdict *v);

/// What the chosen places see of each thing that is to be seen. Refuses a thing of which nothing is
/// inside, or that no place sees: names it, and the nearest place that could see it.
sl_status camera_work_survey(sl_context *context, const camera_plan *plan, sl_query *query,
                             const cover_report *report, const sl_viewpoint *viewpoints,
                             camera_work *w);
/// A single route that is to be seen, for pictures; else `out` stays empty.
sl_status camera_work_trace(sl_context *context, const cover_report *report, sl_query *query,
                            const sl_viewpoint *viewpoints, const camera_work *w, cover_path *out);
/// A line for each thing that is to be seen.
void camera_work_print_things(const camera_work *w, const cover_report *report);
/// "zones" and "lines"
void camera_work_add_things_json(json_fields *fields, const camera_work *w);

/// Prints what no place sees, and a place that could see the largest part of it.
sl_status camera_work_print_blind(sl_context *context, const camera_work *w,
                                  const camera_plan *plan, sl_query *query, const char *unit);

void camera_work_destroy(sl_context *context, camera_work *w);

#endif

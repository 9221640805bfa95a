/// The axial lines of the plan, or their segments, in the colours of a measure. The lines are those
/// of `sightline axial`, or the ones that are drawn; segments are these, cut where they cross.
#ifndef VIEWER_LINE_MAP_H
#define VIEWER_LINE_MAP_H

#include "plan/tool_job.h"
#include "plan/value_scale.h"
#include "sightline/axial.h"

struct line_map {
    tool_job job;
    bool segments, drawn; ///< what it is of
    // The job's until it is made:
    sl_segment *lines;
    uint32_t count;
    void *measures;  ///< by line: sl_axial_measures or sl_segment_measures
    uint32_t *parts; ///< by line: of the network, which no way along lines joins, the largest is 0
    uint32_t part_count;
    uint32_t chosen; ///< a line, by click or in the table; none from the count on
    // For the colours:
    bool scaled;
    size_t measure;  ///< that the scale is of
    uint32_t part;   ///< that has the scale: the chosen line's, or the largest
    uint32_t within; ///< lines in it
    value_scale scale;
};

/// Starts the work for the tool at hand, and takes over its results. Waits for it with `wait`.
void line_map_update(view_state *view, bool wait);
/// What is shown now; NULL: nothing.
const line_map *line_map_shown(const view_state *view);
/// Begins work anew that was stopped or has failed.
void line_map_try_again(view_state *view);
/// Stops the work; false if none runs.
bool line_map_stop(view_state *view);
job_progress line_map_progress(const view_state *view);
void line_map_destroy(sl_context *context, line_map *map); ///< NULL: nothing

// --- measures

const sl_measure *line_map_measures(const line_map *map, size_t *count);
double line_map_value(const line_map *map, size_t measure, uint32_t line);
/// The number of the chosen measure; NULL: no such tool is at hand.
size_t *line_map_choice(view_state *view);
/// The next measure, or one before.
void line_map_choose(view_state *view, int by);
/// The lines as they are drawn, or those that the plan has.
void line_map_toggle_drawn(view_state *view);

// --- on the page

/// The line nearest to a place, within reach of a pointer; UINT32_MAX: none.
uint32_t line_map_at(const view_state *view, sl_point at);
/// Chooses a line: its part has the colours. UINT32_MAX: none, and the largest part has them.
void line_map_pick(view_state *view, uint32_t line);
void line_map_draw(const view_state *view, const sl_frame *frame);
/// The key: measure, value under the pointer, colours. False where nothing is shown.
bool line_map_key(const view_state *view, legend_key *key);

#endif

/// Another plan laid over the open one: walls added and removed, and what a measure of the
/// visibility graph gains or loses, as `sightline vga --compare` has it.
#ifndef VIEWER_COMPARE_H
#define VIEWER_COMPARE_H

#include "plan/heat_graph.h"
#include "plan/tool_job.h"
#include "plan/wall_change.h"

struct plan_compare {
    document_source source; ///< of the other plan
    task *reads;            ///< NULL: it is read, or could not be
    sl_map map;             ///< these three: the other plan; the task's while it reads
    sl_baked baked;
    sl_query *query;
    bool read;
    double area; ///< inside

    tool_job job;             ///< of the walls
    wall_list now, other;     ///< as they are drawn
    wall_list added, removed; ///< the job's until it is made
    heat_graph graph;         ///< the graph job's while it runs
    task *graph_job;          ///< NULL: none runs
    uint32_t stamp;           ///< grows with what is measured of it
    bool graph_failed;
};

/// Reads a plan to compare with, with the options of the open one.
void compare_open(view_state *view, const char *path);
void compare_update(view_state *view, bool wait);
/// The other plan, read; NULL: the tool is not at hand, or there is none.
const plan_compare *compare_shown(const view_state *view);
/// Whether the tool is at hand: the heat map shows changes.
bool compare_changes(const view_state *view);
/// The other plan's graph with these parts measured, on the same grid; NULL: not yet.
const heat_graph *compare_graph(const view_state *view, unsigned part);
job_progress compare_progress(const view_state *view);
/// Stops what runs; false for nothing.
bool compare_stop(view_state *view);
void compare_draw(const view_state *view, const sl_frame *frame);
/// The colours of walls that were added, and of those that were removed.
sl_colour compare_colour(const ui_state *ui, bool added);
/// Forgets the other plan.
void compare_clear(view_state *view);

#endif

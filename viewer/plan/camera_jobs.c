/// What cameras see together, and the fewest that see everything: two tasks in the background.
///
/// A task has a copy of the map, and cells and a query of its own. The survey keeps those from one
/// run to the next, as long as the map stays. So a camera that is dragged costs its coverage alone,
/// and the plan is behind the pointer by as long as that takes. The search has others: both may run
/// at the same time.
#include "plan/cameras.h"

#include "document/task.h"
#include "sightline/glpk.h"
#include "sightline/place.h"

#include <stdio.h>
#include <string.h>

/// What a task looks at.
typedef struct ground {
    sl_map map; ///< a copy; taken over once the cells are made
    double weld;
    sl_moving_box boxes[OBJECTS_MOST];
    size_t box_count;
    sl_baked baked;
    sl_query *query; ///< NULL: not made yet
} ground;

typedef struct survey_job {
    task *task; ///< NULL: none runs
    ground ground;
    uint32_t version, touched; ///< of the document that the ground is of
    bool begun;                ///< there is a ground
    uint32_t stamp;            ///< of the table
    sl_viewpoint *viewpoints;
    size_t count;
    sl_coverage coverage;
} survey_job;

typedef struct search_job {
    task *task;
    ground ground;
    uint32_t version, touched;
    sl_placement placement;
    bool stopped; ///< it was stopped, and has a set
} search_job;

/// The stage whose progress is the bounds (place.h).
#define PLACE_STAGE "place"

struct camera_jobs {
    survey_job survey;
    search_job search;
    uint32_t failed; ///< the stamp of the table whose survey failed: it is not tried again
};

// --- what both look at

static sl_status copy_ground(const view_state *view, ground *g) {
    const document_state *document = view->document;
    *g = (ground){.weld = document->weld};
    for (size_t i = 0; i < document->object_count; i++)
        g->boxes[g->box_count++] =
            (sl_moving_box){document->map.objects[i].box, document->blocks[i]};
    return sl_map_copy(view->context, &document->map, &g->map);
}

static sl_status make_ground(sl_context *context, ground *g) {
    if (g->query) return SL_OK;
    sl_bake_options options = sl_bake_options_default();
    options.clean.weld = g->weld;
    SL_TRY(sl_bake_cells(context, &g->map, &options, &g->baked));
    SL_TRY(sl_query_over(context, &g->baked.space, &g->baked.map, NULL, &g->query));
    return sl_query_set_boxes(context, g->query, g->boxes, g->box_count);
}

static void drop_ground(sl_context *context, ground *g) {
    sl_query_destroy(context, g->query);
    sl_baked_destroy(context, &g->baked);
    sl_map_destroy(context, &g->map);
    *g = (ground){0};
}

// --- the survey

static sl_status survey(sl_context *context, void *data) {
    survey_job *job = data;
    SL_TRY(make_ground(context, &job->ground));
    return sl_coverage_make(context, job->ground.query, job->viewpoints, job->count,
                            &job->coverage);
}

static void end_survey(sl_context *context, survey_job *job) {
    task_drop(context, job->task);
    job->task = NULL;
    sl_coverage_destroy(context, &job->coverage);
    sl_free(context, job->viewpoints);
    job->viewpoints = NULL;
}

static void drop_survey(sl_context *context, survey_job *job) {
    end_survey(context, job);
    drop_ground(context, &job->ground);
    job->begun = false;
}

static bool is_of(const view_state *view, uint32_t version, uint32_t touched) {
    return version == view->document->version && touched == view->document->touched;
}

static sl_status start_survey(view_state *view, survey_job *job) {
    const sl_cameras *table = &view->cameras->table;
    if (!job->begun) {
        job->version = view->document->version;
        job->touched = view->document->touched;
        job->begun = true;
        SL_TRY(copy_ground(view, &job->ground));
    }
    job->stamp = view->cameras->stamp;
    job->count = table->count;
    job->viewpoints = sl_alloc_array(view->context, table->count, sizeof *job->viewpoints);
    if (!job->viewpoints) return SL_NO_MEMORY;
    for (size_t i = 0; i < table->count; i++) job->viewpoints[i] = table->items[i].view;
    return task_start(view->context, survey, job, "coverage", NULL, &job->task);
}

static sl_status take_survey(view_state *view, survey_job *job) {
    camera_layer *layer = view->cameras;
    const sl_status status = task_end(view->context, job->task);
    job->task = NULL;
    if (status == SL_OK) {
        sl_coverage_destroy(view->context, &layer->coverage);
        layer->coverage = job->coverage;
        job->coverage = (sl_coverage){0};
        layer->seen_stamp = job->stamp;
        layer->known = true;
        if (layer->spot > layer->coverage.blind_count) layer->spot = 0;
    }
    end_survey(view->context, job);
    return status;
}

/// A survey that fails is not made again before something changes.
static void give_up(view_state *view, camera_jobs *jobs) {
    jobs->failed = view->cameras->stamp;
    view->cameras->known = false;
    drop_survey(view->context, &jobs->survey);
}

static void follow_table(view_state *view, camera_jobs *jobs, bool wait) {
    camera_layer *layer = view->cameras;
    survey_job *job = &jobs->survey;
    if (job->begun && !is_of(view, job->version, job->touched)) {
        drop_survey(view->context, job);
        layer->known = false;
        jobs->failed = 0;
    }
    do {
        sl_status status = SL_OK;
        if (job->task && (wait || task_done(job->task))) status = take_survey(view, job);
        const bool late = !layer->known || layer->seen_stamp != layer->stamp;
        if (status == SL_OK && !job->task && late && jobs->failed != layer->stamp)
            status = start_survey(view, job);
        if (status != SL_OK) {
            view_check(view, status);
            give_up(view, jobs);
        }
    } while (wait && job->task);
}

// --- the search

/// Stopped, it keeps the best set.
static sl_status search(sl_context *context, void *data) {
    search_job *job = data;
    sl_place_options options = sl_place_options_default();
    options.program = sl_cover_glpk();
    SL_TRY(make_ground(context, &job->ground));
    const sl_status status = sl_place(context, job->ground.query, &options, &job->placement);
    job->stopped = status == SL_CANCELLED && job->placement.count;
    return job->stopped ? SL_OK : status;
}

static void drop_search(sl_context *context, search_job *job) {
    task_drop(context, job->task);
    drop_ground(context, &job->ground);
    sl_placement_destroy(context, &job->placement);
    *job = (search_job){0};
}

/// The set becomes the table, to be undone. It looks all round and without limit.
static sl_status take_set(view_state *view, const search_job *job) {
    sl_cameras table = {0};
    sl_status status = SL_OK;
    for (uint32_t i = 0; i < job->placement.count && status == SL_OK; i++) {
        const sl_camera camera = {.view = job->placement.viewpoints[i], .cost = 1};
        status = sl_cameras_add(view->context, &table, &camera);
    }
    if (status != SL_OK) {
        sl_cameras_destroy(view->context, &table);
        return status;
    }
    cameras_replace(view, &table);
    sl_placement_say(&job->placement, "camera", job->stopped, view->cameras->proof,
                     sizeof view->cameras->proof);
    ui_say(view->ui, false, "%s Ctrl+Z brings the cameras before back.", view->cameras->proof);
    return SL_OK;
}

static void follow_search(view_state *view, search_job *job, bool wait) {
    if (!job->task) return;
    if (!is_of(view, job->version, job->touched)) {
        drop_search(view->context, job);
        ui_say(view->ui, false, "the map has changed: the search has ended");
        return;
    }
    if (!wait && !task_done(job->task)) return;
    sl_status status = task_end(view->context, job->task);
    job->task = NULL;
    if (status == SL_OK) status = take_set(view, job);
    view_check(view, status);
    drop_search(view->context, job);
}

// --- both

void cameras_update(view_state *view, bool wait) {
    const bool settled = !(view->document->job && !view->document->has_visibility);
    camera_layer *layer = view->mode == MODE_CAMERAS ? cameras_of(view) : view->cameras;
    if (!layer || !view->document->baked || !settled) return;
    if (!layer->jobs) layer->jobs = sl_alloc_array(view->context, 1, sizeof *layer->jobs);
    if (!layer->jobs) return;
    follow_search(view, &layer->jobs->search, wait);
    if (view->mode == MODE_CAMERAS) follow_table(view, layer->jobs, wait);
}

void cameras_find(view_state *view) {
    camera_layer *layer = cameras_of(view);
    if (!layer || !view->document->baked) return;
    if (!layer->jobs) layer->jobs = sl_alloc_array(view->context, 1, sizeof *layer->jobs);
    if (!layer->jobs || layer->jobs->search.task) return;
    search_job *job = &layer->jobs->search;
    job->version = view->document->version;
    job->touched = view->document->touched;
    sl_status status = copy_ground(view, &job->ground);
    if (status == SL_OK)
        status = task_start(view->context, search, job, "prepare", NULL, &job->task);
    view_check(view, status);
    if (status == SL_OK)
        ui_say_working(view->ui, "looking for the fewest cameras; Esc stops, and keeps the best");
    else
        drop_search(view->context, job);
}

bool cameras_stop(view_state *view) {
    camera_jobs *jobs = view->cameras ? view->cameras->jobs : NULL;
    if (!jobs || !jobs->search.task) return false;
    task_cancel(jobs->search.task);
    return true;
}

job_progress cameras_progress(const camera_layer *layer) {
    const camera_jobs *jobs = layer ? layer->jobs : NULL;
    if (!jobs || !jobs->search.task) return (job_progress){0};
    job_progress p = task_progress(jobs->search.task);
    const bool bounds = p.stage && strcmp(p.stage, PLACE_STAGE) == 0;
    if (!bounds) p.done = p.total = 0;
    return p;
}

void camera_jobs_destroy(sl_context *context, camera_jobs *jobs) {
    if (!jobs) return;
    drop_search(context, &jobs->search);
    drop_survey(context, &jobs->survey);
    sl_free(context, jobs);
}

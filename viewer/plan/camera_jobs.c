/// What cameras see together, and the fewest that see everything: two tasks in the background.
/// Cameras that look all round and without limit are looked for anywhere; others on walls, in
/// eight directions; and so are those that are added to what stands.
///
/// A task has a copy of the map, and cells and a query of its own. The survey keeps those from one
/// run to the next, as long as the map stays. So a camera that is dragged costs its coverage alone,
/// and the plan is behind the pointer by as long as that takes. The search has others: both may run
/// at the same time.
#include "plan/cameras.h"

#include "document/measure.h"
#include "document/task.h"
#include "sightline/glpk.h"
#include "sightline/place_area.h"

#include <stdio.h>
#include <string.h>

enum { HEADINGS = 8 };

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
    camera_search kind;
    sl_cameras stand;       ///< that are kept
    sl_viewpoint like;      ///< what those that are looked for look like
    sl_placement placement; ///< anywhere
    sl_viewpoint *places;   ///< else, where they may be: first those that stand
    uint32_t *fixed;
    sl_place_area area; ///< of these places
    sl_area_placement placed;
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

static bool is_anywhere(const search_job *job) {
    return job->kind == SEARCH_FEWEST && job->like.fov >= 360 && !(job->like.range > 0) &&
           !(job->like.nearest > 0);
}

/// Those that stand, then places on walls in all directions.
static sl_status make_places(sl_context *context, search_job *job) {
    const uint32_t headings = job->like.fov < 360 ? HEADINGS : 1;
    const size_t stand = job->stand.count;
    sl_query *query = job->ground.query;
    sl_point *points = NULL;
    uint32_t count = 0;
    SL_TRY(sl_place_points(context, query, SL_PLACE_WALLS,
                           sl_place_step(&job->ground.baked.space, job->like.range), &points,
                           &count));
    job->places = sl_alloc_array(context, stand + (size_t)count * headings, sizeof *job->places);
    job->fixed = sl_alloc_array(context, stand, sizeof *job->fixed);
    const bool good = job->places && job->fixed;
    sl_place_area *area = &job->area;
    for (; good && area->place_count < stand; area->place_count++) {
        job->places[area->place_count] = job->stand.items[area->place_count].view;
        job->fixed[area->place_count] = area->place_count;
    }
    for (uint32_t i = 0; good && i < count * headings; i++) {
        sl_viewpoint *v = &job->places[area->place_count++];
        *v = job->like;
        v->at = points[i / headings];
        v->heading = 360.0 * (i % headings) / headings;
    }
    sl_free(context, points);
    area->places = job->places;
    area->fixed = job->fixed;
    area->fixed_count = (uint32_t)stand;
    area->count = job->kind == SEARCH_ONE ? 1 : 0;
    return good ? SL_OK : SL_NO_MEMORY;
}

/// Stopped, it keeps the best set.
static sl_status search(sl_context *context, void *data) {
    search_job *job = data;
    sl_place_options options = sl_place_options_default();
    options.program = sl_cover_glpk();
    SL_TRY(make_ground(context, &job->ground));
    sl_status status;
    if (is_anywhere(job)) {
        status = sl_place(context, job->ground.query, &options, &job->placement);
    } else {
        SL_TRY(make_places(context, job));
        status =
            sl_place_area_cover(context, job->ground.query, &job->area, &options, &job->placed);
    }
    job->stopped = status == SL_CANCELLED && (job->placement.count || job->placed.count);
    return job->stopped ? SL_OK : status;
}

static void drop_search(sl_context *context, search_job *job) {
    task_drop(context, job->task);
    drop_ground(context, &job->ground);
    sl_placement_destroy(context, &job->placement);
    sl_area_placement_destroy(context, &job->placed);
    sl_cameras_destroy(context, &job->stand);
    sl_free(context, job->places);
    sl_free(context, job->fixed);
    *job = (search_job){0};
}

/// The chosen one of a set.
static sl_camera found(const search_job *job, uint32_t number) {
    if (is_anywhere(job)) return (sl_camera){.view = job->placement.viewpoints[number], .cost = 1};
    const uint32_t place = job->placed.chosen[number];
    if (place < job->stand.count) return job->stand.items[place];
    return (sl_camera){.view = job->places[place], .cost = 1};
}

/// "field of view 90°, range 15 m": what those that are looked for are like.
enum { LIKE_TEXT = MEASURE_TEXT + 48 };
static void say_like(const view_state *view, const sl_viewpoint *like, char text[LIKE_TEXT]) {
    char range[MEASURE_TEXT];
    measure_say(like->range, view->document->map.unit, "", range);
    snprintf(text, LIKE_TEXT, "field of view %.4g\xc2\xb0, %s%s", like->fov,
             like->range > 0 ? "range " : "no limit of range", like->range > 0 ? range : "");
}

/// The set becomes the table, to be undone.
static sl_status take_set(view_state *view, const search_job *job) {
    const uint32_t count = is_anywhere(job) ? job->placement.count : job->placed.count;
    sl_cameras table = {0};
    sl_status status = SL_OK;
    for (uint32_t i = 0; i < count && status == SL_OK; i++) {
        const sl_camera camera = found(job, i);
        status = sl_cameras_add(view->context, &table, &camera);
    }
    if (status != SL_OK) {
        sl_cameras_destroy(view->context, &table);
        return status;
    }
    cameras_replace(view, &table);
    char *proof = view->cameras->proof;
    if (is_anywhere(job))
        sl_placement_say(&job->placement, "camera", job->stopped, proof, PROOF_TEXT);
    else
        sl_area_placement_say(&job->area, &job->placed, 1, job->stopped, proof, PROOF_TEXT);
    char like[LIKE_TEXT];
    say_like(view, &job->like, like);
    ui_say(view->ui, false, "%s Looked for: %s. Ctrl+Z brings the cameras before back.", proof,
           like);
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

/// What those that are looked for look like: the chosen one, else as the last that was set.
static sl_viewpoint wanted(const view_state *view) {
    const sl_viewpoint *chosen = camera_chosen(view);
    return chosen ? *chosen : view->cameras->like;
}

/// Those that are kept. One that stands in no room sees nothing, and is named.
static sl_status keep_standing(view_state *view, search_job *job) {
    const camera_layer *layer = view->cameras;
    char name[CAMERA_NAME];
    for (size_t i = 0; job->kind != SEARCH_FEWEST && i < layer->table.count; i++) {
        camera_name(layer, i, name);
        if (!camera_has_ground(view, layer->table.items[i].view.at))
            return sl_fail(view->context, SL_BAD_ARGUMENT,
                           "camera %s stands in no room: drag it into one, or delete it", name);
        SL_TRY(sl_cameras_add(view->context, &job->stand, &layer->table.items[i]));
    }
    return SL_OK;
}

void cameras_find(view_state *view, camera_search kind) {
    camera_layer *layer = cameras_of(view);
    if (!layer || !view->document->baked) return;
    if (!layer->jobs) layer->jobs = sl_alloc_array(view->context, 1, sizeof *layer->jobs);
    if (!layer->jobs || layer->jobs->search.task) return;
    search_job *job = &layer->jobs->search;
    job->version = view->document->version;
    job->touched = view->document->touched;
    job->kind = kind;
    job->like = wanted(view);
    sl_status status = keep_standing(view, job);
    if (status == SL_OK) status = copy_ground(view, &job->ground);
    if (status == SL_OK)
        status = task_start(view->context, search, job, "prepare", NULL, &job->task);
    view_check(view, status);
    char like[LIKE_TEXT];
    say_like(view, &job->like, like);
    if (status == SL_OK)
        ui_say_working(view->ui, "looking for %s (%s)%s; Esc stops, and keeps the best",
                       kind == SEARCH_ONE ? "one more camera" : "the fewest cameras", like,
                       kind == SEARCH_MORE                           ? ", with those that stand"
                       : kind == SEARCH_FEWEST && layer->table.count ? ", in place of these"
                                                                     : "");
    else
        drop_search(view->context, job);
}

bool cameras_stop(view_state *view) {
    camera_jobs *jobs = view->cameras ? view->cameras->jobs : NULL;
    if (!jobs || !jobs->search.task) return false;
    task_cancel(jobs->search.task);
    return true;
}

camera_search cameras_search(const camera_layer *layer) {
    return layer->jobs->search.kind;
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

#include "view_job.h"

#include "sightline/support.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>

/// Lines that tell costs, for each that makes the cells.
#define TELLING 2

struct view_job {
    sl_map map;
    sl_space space;
    sl_outline outline;
    sl_view_places places;
    sl_view_segments segments, telling;
    sl_view_hierarchy merged; ///< as told by the lines that made it
    view_history history;
    sl_status status; ///< when `done`
    char message[1024];
    pthread_t thread;
    atomic_bool cancel, done;
    _Atomic(const char *) stage;
    atomic_uint_fast64_t count, total;
};

void view_history_destroy(sl_context *context, view_history *history) {
    sl_view_hierarchy_destroy(context, &history->hierarchy);
    sl_view_tree_destroy(context, &history->tree);
    *history = (view_history){0};
}

static bool is_cancelled(void *user) {
    return atomic_load(&((view_job *)user)->cancel);
}

static void take_progress(void *user, const sl_progress *progress) {
    view_job *job = user;
    atomic_store(&job->stage, progress->stage);
    atomic_store(&job->count, progress->done);
    atomic_store(&job->total, progress->total);
}

static const sl_view_method *method_that_merges(void) {
    size_t count, i = 0;
    const sl_view_method *methods = sl_view_methods(&count);
    while (i + 1 < count && !methods[i].merges) i++;
    return &methods[i];
}

static sl_status merge(sl_context *context, const sl_view_scene *scene, view_job *job) {
    sl_view_sets sets = {0};
    SL_TRY(sl_view_sets_sample(context, scene, &job->history.tree, &job->segments, 0, &sets));
    const sl_status status = sl_view_merge(context, scene, &job->history.tree, &sets, &job->merged);
    sl_view_sets_destroy(context, &sets);
    return status;
}

/// By other lines: those that made the cells flatter them.
static sl_status tell(sl_context *context, const sl_view_scene *scene, view_job *job) {
    sl_view_sampling sampling = sl_view_sampling_default();
    sampling.samples *= TELLING;
    sampling.seed = ~sampling.seed;
    sl_view_sets sets = {0};
    SL_TRY(sl_view_sample(context, &job->outline, &sampling, &job->telling));
    SL_TRY(sl_view_sets_sample(context, scene, &job->history.tree, &job->telling, 0, &sets));
    const sl_status status = sl_view_evaluate(context, scene, &job->history.tree, &job->merged,
                                              &sets, &job->history.hierarchy);
    sl_view_sets_destroy(context, &sets);
    return status;
}

static sl_status work(sl_context *context, view_job *job) {
    const sl_view_sampling sampling = sl_view_sampling_default();
    sl_view_subdivision subdivision = sl_view_subdivision_default();
    subdivision.seed = sampling.seed;
    SL_TRY(sl_map_clean(context, &job->map, NULL, NULL));
    SL_TRY(sl_subdivision_for(&job->map)->subdivide(context, &job->map, NULL, &job->space));
    SL_TRY(sl_outline_make(context, &job->space, &job->outline));
    SL_TRY(sl_view_places_inside(context, &job->space, &job->places));
    const sl_view_scene scene = {&job->space, sampling.objects, sl_render_cost_default(),
                                 &job->places};
    SL_TRY(sl_view_sample(context, &job->outline, &sampling, &job->segments));
    SL_TRY(method_that_merges()->divide(context, &scene, &job->segments, &subdivision,
                                        &job->history.tree, NULL));
    SL_TRY(merge(context, &scene, job));
    return tell(context, &scene, job);
}

static void *run(void *user) {
    view_job *job = user;
    const sl_hooks hooks = {.user = job, .progress = take_progress, .cancelled = is_cancelled};
    sl_context *context = sl_context_create(&hooks);
    job->status = context ? work(context, job) : SL_NO_MEMORY;
    snprintf(job->message, sizeof job->message, "%s",
             context ? sl_context_message(context) : "out of memory");
    if (context) sl_context_destroy(context);
    atomic_store(&job->done, true);
    return NULL;
}

static void free_job(sl_context *context, view_job *job) {
    view_history_destroy(context, &job->history);
    sl_view_hierarchy_destroy(context, &job->merged);
    sl_view_segments_destroy(context, &job->telling);
    sl_view_segments_destroy(context, &job->segments);
    sl_view_places_destroy(context, &job->places);
    sl_outline_destroy(context, &job->outline);
    sl_space_destroy(context, &job->space);
    sl_map_destroy(context, &job->map);
    sl_free(context, job);
}

sl_status view_job_start(sl_context *context, const sl_map *map, view_job **out) {
    view_job *job = sl_alloc_array(context, 1, sizeof *job);
    if (!job) return SL_NO_MEMORY;
    atomic_store(&job->stage, "sample");
    const sl_status status = sl_map_copy(context, map, &job->map);
    if (status == SL_OK && pthread_create(&job->thread, NULL, run, job) == 0) {
        *out = job;
        return SL_OK;
    }
    free_job(context, job);
    if (status != SL_OK) return status;
    return sl_fail(context, SL_NO_MEMORY, "no thread for view cells in the background");
}

void view_job_cancel(view_job *job) {
    atomic_store(&job->cancel, true);
}

bool view_job_is_done(const view_job *job) {
    return atomic_load(&job->done);
}

job_progress view_job_progress(const view_job *job) {
    const uint64_t total = atomic_load(&job->total), count = atomic_load(&job->count);
    return (job_progress){.running = true,
                          .stage = atomic_load(&job->stage),
                          .share = total ? (double)count / (double)total : -1};
}

sl_status view_job_end(sl_context *context, view_job *job, view_history *out) {
    pthread_join(job->thread, NULL);
    const sl_status status = job->status;
    if (status == SL_OK) {
        *out = job->history;
        job->history = (view_history){0};
    } else {
        sl_fail(context, status, "view cells: %s", job->message);
    }
    free_job(context, job);
    return status;
}

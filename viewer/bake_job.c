#include "bake_job.h"

#include "clock.h"
#include "sightline/io.h"
#include "sightline/solvers.h"
#include "sightline/support.h"

#include <string.h>

/// A stab tree is kept as long as all fit into this.
#define TREE_BYTES ((uint64_t)128 << 20)

/// Stab trees are searched for no longer than this: open places have too many sequences.
#define TREE_SECONDS 20

static bool is_cancelled(void *user) {
    const sl_bake_job *job = user;
    return atomic_load(&job->cancel) || (job->until > 0 && sl_clock_seconds() > job->until);
}

static void take_progress(void *user, const sl_progress *progress) {
    sl_bake_job *job = user;
    atomic_store(&job->stage, progress->stage);
    atomic_store(&job->count, progress->done);
    atomic_store(&job->total, progress->total);
}

/// Puts other walls in place of a map's own.
static sl_status set_walls(sl_context *context, sl_map *map, const sl_wall *walls, size_t count) {
    map->wall_count = 0;
    for (size_t i = 0; i < count; i++)
        SL_TRY(sl_map_add_wall(context, map, walls[i].a, walls[i].b, walls[i].line));
    return SL_OK;
}

/// A baked file has everything but the map as drawn, which its space's walls stand for.
static sl_status read_baked(sl_context *context, sl_bake_job *job) {
    SL_TRY(sl_baked_read(context, job->source.path, job->baked));
    SL_TRY(sl_map_copy(context, &job->baked->map, &job->map));
    SL_TRY(set_walls(context, &job->map, job->baked->space.walls, job->baked->space.wall_count));
    job->visibility = job->baked->visibility;
    job->baked->visibility = (sl_visibility){0};
    atomic_store(&job->space_ready, true);
    atomic_store(&job->seen_ready, true);
    return SL_OK;
}

static sl_status read_map(sl_context *context, sl_bake_job *job) {
    const sl_document_source *source = &job->source;
    SL_TRY(sl_map_read(context, source->path, &source->options, &job->map));
    if (!source->has_start) return SL_OK;
    const sl_box b = sl_map_bounds(&job->map);
    const sl_point at = source->start;
    if (at.x < b.min.x || at.x > b.max.x || at.y < b.min.y || at.y > b.max.y)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--start %.10g,%.10g: outside the map, which is %.10g,%.10g to %.10g,%.10g",
                       at.x, at.y, b.min.x, b.min.y, b.max.x, b.max.y);
    return sl_map_add_start(context, &job->map, source->start, 0, 0);
}

static const sl_see_method *method_named(const char *name) {
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    for (size_t i = 0; i < count; i++)
        if (strcmp(methods[i].name, name) == 0) return &methods[i];
    return &methods[0];
}

/// The sweep is the fastest by far. A search knows all that a map can call for.
static const sl_see_method *method_for(const sl_plan *plan) {
    const sl_see_method *sweep = method_named("sweep");
    return plan->effects & ~sweep->knows ? method_named("prune") : sweep;
}

/// The walls of a baked map are its space's.
static void drop_walls(sl_map *map) {
    map->wall_count = 0;
}

static sl_status see_all(sl_context *context, sl_bake_job *job, const sl_plan *plan) {
    const sl_see_method *method = method_for(plan);
    sl_see_options options = sl_see_options_default();
    options.plan = plan;
    options.solver = sl_funnel();
    snprintf(job->baked->method, sizeof job->baked->method, "%s", method->name);
    atomic_store(&job->space_ready, true);
    SL_TRY(sl_see_check(context, method, options.solver, &job->clean));
    SL_TRY(method->see(context, &job->baked->space, &options, &job->visibility));
    atomic_store(&job->seen_ready, true);
    return SL_OK;
}

/// The search knows the stab trees too. Where it takes too long there are none.
static sl_status search_trees(sl_context *context, sl_bake_job *job, const sl_plan *plan) {
    sl_see_options options = sl_see_options_default();
    options.plan = plan;
    options.solver = sl_funnel();
    options.trees = true;
    options.tree_bytes = TREE_BYTES;
    job->until = sl_clock_seconds() + TREE_SECONDS;
    const sl_status status =
        method_named("dfs")->see(context, &job->baked->space, &options, &job->with_trees);
    return status == SL_CANCELLED && !atomic_load(&job->cancel) ? SL_OK : status;
}

static sl_status bake(sl_context *context, sl_bake_job *job) {
    sl_baked *baked = job->baked;
    SL_TRY(sl_map_copy(context, &job->map, &job->clean));
    SL_TRY(sl_map_clean(context, &job->clean, NULL, NULL));
    SL_TRY(sl_subdivision_for(&job->clean)->subdivide(context, &job->clean, NULL, &baked->space));
    drop_walls(&job->clean);
    SL_TRY(sl_map_copy(context, &job->clean, &baked->map));
    // Not of the copy: from space_ready on that is the main thread's.
    sl_plan plan = sl_plan_make(&job->clean);
    plan.mirror_depth = job->mirror_depth;
    SL_TRY(see_all(context, job, &plan));
    return search_trees(context, job, &plan);
}

static sl_status work(sl_context *context, sl_bake_job *job) {
    if (job->source.path && sl_document_is_baked(job->source.path)) return read_baked(context, job);
    if (job->source.path) SL_TRY(read_map(context, job));
    return bake(context, job);
}

static void *run(void *user) {
    sl_bake_job *job = user;
    const sl_hooks hooks = {.user = job, .progress = take_progress, .cancelled = is_cancelled};
    sl_context *context = sl_context_create(&hooks);
    job->status = context ? sl_io_use(context) : SL_NO_MEMORY;
    if (job->status == SL_OK) job->status = work(context, job);
    snprintf(job->message, sizeof job->message, "%s",
             context ? sl_context_message(context) : "out of memory");
    if (context) sl_context_destroy(context);
    atomic_store(&job->done, true);
    return NULL;
}

static void free_job(sl_context *context, sl_bake_job *job) {
    if (!job->taken && job->baked) {
        sl_baked_destroy(context, job->baked);
        sl_free(context, job->baked);
    }
    sl_visibility_destroy(context, &job->visibility);
    sl_visibility_destroy(context, &job->with_trees);
    sl_map_destroy(context, &job->map);
    sl_map_destroy(context, &job->clean);
    sl_document_source_destroy(context, &job->source);
    sl_free(context, job);
}

sl_status sl_bake_job_start(sl_context *context, sl_bake_job *job) {
    atomic_store(&job->stage, "read");
    job->baked = sl_alloc_array(context, 1, sizeof *job->baked);
    if (job->baked && pthread_create(&job->thread, NULL, run, job) == 0) return SL_OK;
    free_job(context, job);
    return sl_fail(context, SL_NO_MEMORY, "no thread for the work in the background");
}

void sl_bake_job_end(sl_context *context, sl_bake_job *job) {
    pthread_join(job->thread, NULL);
    free_job(context, job);
}

/// What is open, and the job in the background: from a file or a map to its space, and on to its
/// visibility, in a thread of its own.
///
/// A job owns all that it makes until it sets a flag (space_ready, seen_ready) or ends. After that
/// that part belongs to the main thread. document_poll takes it over and never waits. A change by
/// hand cancels the job and starts another one. The old map stays until the new one has its space.
///
/// While something is dragged, jobs are live: they make the space alone, which is all that the
/// visible region and the eye's culling need. A live job runs to its end before the next one
/// starts, with the map as it is then. So the picture is late by one job, however fast the drag.
/// Cost: one whole bake of the space per frame. That is a few ms for some thousand walls, and
/// simpler than to mend the old space.
#include "document/document.h"

#include "document/task.h"
#include "sightline/stab.h"
#include "sightline/support.h"

#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <time.h>

// --- the job

struct bake_job {
    document_source source; ///< what to read; no path: `map` is what to bake
    bool begins;            ///< `map` is a new one, and not the open one after a change
    double wanted_weld;     ///< negative: the usual
    uint32_t mirror_depth;
    sl_map map;      ///< as drawn; filled by the job where it reads
    sl_map clean;    ///< the job's, to the end
    sl_baked *baked; ///< the job's until space_ready, then only its visibility is
    sl_query *query; ///< these three as well
    sli_split *splits;
    double *areas;
    double weld;
    sl_visibility visibility; ///< the job's until seen_ready
    sl_visibility
        with_trees;         ///< the same with stab trees, when it ends; empty where there are none
    char notes[NOTES_TEXT]; ///< the job's until space_ready
    char inside[SL_INSIDE_TEXT];
    task *task;
    atomic_bool space_ready, seen_ready;
    bool live;              ///< the space alone
    uint32_t edit;          ///< of the document, when the job started
    double started;         ///< by the clock
    double until;           ///< the clock's time at which the job gives up stab trees; 0: never
    bool taken, seen_taken; ///< the main thread has the space, the visibility
};

/// Stab trees are kept if all of them fit into this.
#define TREE_BYTES ((uint64_t)128 << 20)

/// The progress of a drag's space is shown after this time, seconds.
#define SOON 0.25

/// The search for stab trees ends after this time: open places have too many sequences.
#define TREE_SECONDS 20

static bool is_over(void *data) {
    const bake_job *job = data;
    return job->until > 0 && sl_seconds() > job->until;
}

/// Keeps what the reader says. Notes that come after the space are dropped.
static void take_note(void *data, const char *message) {
    bake_job *job = data;
    const size_t used = strlen(job->notes);
    if (!atomic_load(&job->space_ready))
        snprintf(job->notes + used, sizeof job->notes - used, "%s%s", used ? "\n" : "", message);
}

/// Makes what the plan, the lessons and the eye need of the space.
static sl_status measure_space(sl_context *context, bake_job *job) {
    const sl_space *space = &job->baked->space;
    const sl_outline *outline;
    job->areas = sl_alloc_array(context, space->cell_count, sizeof *job->areas);
    if (!job->areas) return SL_NO_MEMORY;
    for (uint32_t cell = 0; cell < space->cell_count; cell++)
        job->areas[cell] = sl_space_area(space, cell);
    SL_TRY(sli_splits_make(context, space, &job->splits));
    SL_TRY(sl_query_over(context, space, &job->baked->map, NULL, &job->query));
    return sl_query_outline(context, job->query, &outline); // here, for it takes time
}

/// A baked file has all but the map as drawn: the walls of its space take its place.
static sl_status read_baked(sl_context *context, bake_job *job) {
    SL_TRY(sl_baked_read(context, job->source.path, job->baked));
    SL_TRY(sl_baked_copy_map(context, job->baked, &job->map));
    job->visibility = job->baked->visibility;
    job->baked->visibility = (sl_visibility){0};
    SL_TRY(measure_space(context, job));
    atomic_store(&job->space_ready, true);
    atomic_store(&job->seen_ready, true);
    return SL_OK;
}

sl_status document_source_read(sl_context *context, const document_source *source, sl_map *out) {
    SL_TRY(sl_map_read(context, source->path, &source->options, out));
    for (size_t i = 0; i < source->closed_count; i++)
        SL_TRY(sl_map_add_wall(context, out, source->closed[i].a, source->closed[i].b, 0));
    if (!source->has_start) return SL_OK;
    const sl_box b = sl_map_bounds(out);
    const sl_point at = source->start;
    if (at.x < b.min.x || at.x > b.max.x || at.y < b.min.y || at.y > b.max.y)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--start %.10g,%.10g: outside the map, which is %.10g,%.10g to %.10g,%.10g",
                       at.x, at.y, b.min.x, b.min.y, b.max.x, b.max.y);
    return sl_map_add_start(context, out, source->start, 0, 0);
}

/// Finds what `options` ask for. It uses a map of the job, since the baked map belongs to the main
/// thread by now.
static sl_status find_visibility(sl_context *context, const bake_job *job, sl_bake_options *options,
                                 sl_visibility *out) {
    sl_plan plan = sl_plan_make(&job->clean);
    plan.mirror_depth = job->mirror_depth;
    options->see.plan = &plan;
    return options->method->see(context, &job->baked->space, &options->see, out);
}

/// The search also finds the stab trees. If it takes too long there are none.
static sl_status see_with_trees(sl_context *context, bake_job *job, sl_bake_options options) {
    options.method = sl_see_method_named("dfs");
    options.see.solver = sl_funnel();
    options.see.trees = true;
    options.see.tree_bytes = TREE_BYTES;
    job->until = sl_seconds() + TREE_SECONDS;
    const sl_status status = find_visibility(context, job, &options, &job->with_trees);
    job->until = 0;
    return status == SL_CANCELLED ? sl_check_cancelled(context) : status;
}

static sl_status bake_map(sl_context *context, bake_job *job) {
    sl_bake_options options = sl_bake_options_default();
    sl_bake_account account = {0};
    sl_map map = {0};
    options.mirror_depth = job->mirror_depth;
    options.clean.weld = job->wanted_weld;
    SL_TRY(sl_map_copy(context, &job->map, &map));
    const sl_status status = sl_bake_space(context, &map, &options, job->baked, &account);
    sl_map_destroy(context, &map);
    SL_TRY(status);
    job->weld = account.cleaning.tolerance;
    SL_TRY(sl_say_inside(context, &job->baked->map, &job->baked->space, job->inside));
    if (job->inside[0]) sl_note(context, "%s", job->inside);
    SL_TRY(measure_space(context, job));
    if (!job->live) SL_TRY(sl_map_copy(context, &job->baked->map, &job->clean));
    atomic_store(&job->space_ready, true);
    if (job->live) return SL_OK;
    SL_TRY(find_visibility(context, job, &options, &job->visibility));
    atomic_store(&job->seen_ready, true);
    return see_with_trees(context, job, options);
}

static sl_status run_job(sl_context *context, void *data) {
    bake_job *job = data;
    if (job->source.path && document_is_baked(job->source.path)) return read_baked(context, job);
    if (job->source.path) SL_TRY(document_source_read(context, &job->source, &job->map));
    return bake_map(context, job);
}

static void free_job(sl_context *context, bake_job *job) {
    if (!job->taken) {
        sl_query_destroy(context, job->query);
        sl_free(context, job->splits);
        sl_free(context, job->areas);
    }
    if (!job->taken && job->baked) {
        sl_baked_destroy(context, job->baked);
        sl_free(context, job->baked);
    }
    sl_visibility_destroy(context, &job->visibility);
    sl_visibility_destroy(context, &job->with_trees);
    sl_map_destroy(context, &job->map);
    sl_map_destroy(context, &job->clean);
    document_source_destroy(context, &job->source);
    sl_free(context, job);
}

/// Starts the thread. Owns the content of the job also on failure.
static sl_status bake_job_start(sl_context *context, bake_job *job) {
    const task_hooks hooks = {.note = take_note, .over = is_over};
    job->started = sl_seconds();
    job->baked = sl_alloc_array(context, 1, sizeof *job->baked);
    const sl_status status =
        job->baked ? task_start(context, run_job, job, "read", &hooks, &job->task) : SL_NO_MEMORY;
    if (status != SL_OK) free_job(context, job);
    return status;
}

// --- the document

static sl_status copy_text(sl_context *context, const char *text, char **out) {
    *out = text ? sl_copy_text(context, text, strlen(text)) : NULL;
    return text && !*out ? SL_NO_MEMORY : SL_OK;
}

void document_source_destroy(sl_context *context, document_source *source) {
    sl_free(context, source->path);
    sl_free(context, (char *)(uintptr_t)source->options.map);
    sl_free(context, (char *)(uintptr_t)source->options.layers);
    sl_free(context, (char *)(uintptr_t)source->options.start_names);
    sl_free(context, (char *)(uintptr_t)source->options.unit);
    sl_free(context, source->closed);
    *source = (document_source){0};
}

sl_status document_source_copy(sl_context *context, const document_source *from,
                               document_source *to) {
    char *path = NULL, *map = NULL, *layers = NULL, *start_names = NULL, *unit = NULL;
    sl_status status = copy_text(context, from->path, &path);
    if (status == SL_OK) status = copy_text(context, from->options.map, &map);
    if (status == SL_OK) status = copy_text(context, from->options.layers, &layers);
    if (status == SL_OK) status = copy_text(context, from->options.start_names, &start_names);
    if (status == SL_OK) status = copy_text(context, from->options.unit, &unit);
    sl_segment *closed = NULL;
    if (status == SL_OK && from->closed_count) {
        closed = sl_alloc_array(context, from->closed_count, sizeof *closed);
        if (closed)
            memcpy(closed, from->closed, from->closed_count * sizeof *closed);
        else
            status = SL_NO_MEMORY;
    }
    document_source copy = *from;
    copy.closed = closed;
    copy.path = path;
    copy.options.map = map;
    copy.options.layers = layers;
    copy.options.start_names = start_names;
    copy.options.unit = unit;
    if (status == SL_OK)
        *to = copy;
    else
        document_source_destroy(context, &copy);
    return status;
}

static bool same_text(const char *a, const char *b) {
    return a && b ? strcmp(a, b) == 0 : a == b;
}

static bool same_point(sl_point a, sl_point b) {
    return a.x == b.x && a.y == b.y;
}

bool document_source_same(const document_source *a, const document_source *b) {
    const sl_import_options *o = &a->options, *p = &b->options;
    bool same = same_text(a->path, b->path) && same_text(o->map, p->map) &&
                same_text(o->layers, p->layers) && same_text(o->start_names, p->start_names) &&
                same_text(o->unit, p->unit) && o->tolerance == p->tolerance &&
                o->threshold == p->threshold && o->entrance == p->entrance &&
                o->has_slice == p->has_slice && o->slice == p->slice && o->doors == p->doors &&
                o->cells == p->cells && a->has_weld == b->has_weld && a->weld == b->weld &&
                a->has_start == b->has_start && same_point(a->start, b->start) &&
                a->closed_count == b->closed_count;
    for (size_t i = 0; same && i < a->closed_count; i++)
        same = same_point(a->closed[i].a, b->closed[i].a) &&
               same_point(a->closed[i].b, b->closed[i].b);
    return same;
}

sl_status document_source_close(sl_context *context, document_source *source, sl_segment opening) {
    sl_segment *closed = sl_alloc_array(context, source->closed_count + 1, sizeof *closed);
    if (!closed) return SL_NO_MEMORY;
    if (source->closed_count) memcpy(closed, source->closed, source->closed_count * sizeof *closed);
    closed[source->closed_count++] = opening;
    sl_free(context, source->closed);
    source->closed = closed;
    return SL_OK;
}

static sl_status start_job(sl_context *context, document_state *document, bake_job *job) {
    document_cancel(context, document);
    SL_TRY(bake_job_start(context, job));
    document->job = job;
    return SL_OK;
}

bool document_is_baked(const char *path) {
    const size_t length = strlen(path);
    return length > 4 && strcasecmp(path + length - 4, ".slv") == 0;
}

static bake_job *make_job(sl_context *context, const document_state *document,
                          const document_source *source) {
    bake_job *job = sl_alloc_array(context, 1, sizeof *job);
    if (!job) return NULL;
    job->mirror_depth = document->mirror_depth;
    job->wanted_weld = source && source->has_weld ? source->weld : sl_clean_options_default().weld;
    return job;
}

sl_status document_open(sl_context *context, document_state *document,
                        const document_source *source) {
    bake_job *job = make_job(context, document, source);
    if (!job) return SL_NO_MEMORY;
    const sl_status status = document_source_copy(context, source, &job->source);
    if (status != SL_OK) {
        sl_free(context, job);
        return status;
    }
    return start_job(context, document, job);
}

sl_status document_begin(sl_context *context, document_state *document, sl_map *map) {
    bake_job *job = make_job(context, document, NULL);
    if (!job) return SL_NO_MEMORY;
    job->begins = true;
    job->map = *map;
    *map = (sl_map){0};
    return start_job(context, document, job);
}

const char *document_opening(const document_state *document) {
    return document_awaits_space(document) ? document->job->source.path : NULL;
}

sl_status document_rebuild(sl_context *context, document_state *document, bool live) {
    document->edit++;
    bake_job *job = make_job(context, document, &document->source);
    if (!job) return SL_NO_MEMORY;
    job->live = live;
    job->edit = document->edit;
    const sl_status status = sl_map_copy(context, &document->map, &job->map);
    if (status != SL_OK) {
        sl_free(context, job);
        return status;
    }
    return start_job(context, document, job);
}

bool document_has_rows(const document_state *document) {
    const double now = document->map.range, baked = document->baked->map.range;
    return document->has_visibility && (baked == 0 || (now > 0 && now <= baked));
}

sl_status document_keep_up(sl_context *context, document_state *document) {
    if (!document->stale || document_awaits_space(document)) return SL_OK;
    document->stale = false;
    return document_rebuild(context, document, true);
}

bool document_is_late(const document_state *document) {
    return document->baked && (document->stale || document->shown != document->edit);
}

bool document_awaits_space(const document_state *document) {
    return document->job && !document->job->taken;
}

/// The doors of the clean map stand in the order of the map's, without those of no length.
static void copy_door_states(const sl_map *map, sl_map *clean) {
    size_t next = 0;
    for (size_t i = 0; i < clean->door_count; i++) {
        while (next < map->door_count && strcmp(map->doors[next].name, clean->doors[i].name) != 0)
            next++;
        if (next == map->door_count) return;
        clean->doors[i].open = map->doors[next++].open;
    }
}

void document_touch(document_state *document) {
    const sl_map *map = &document->map;
    document->touched++;
    if (!document->baked) return;
    copy_door_states(map, &document->baked->map);
    if (document->baked->map.object_count != map->object_count) return;
    for (size_t i = 0; i < map->object_count; i++)
        document->baked->map.objects[i].box = map->objects[i].box;
}

/// Of a map that was just opened: no object blocks sight.
static sl_status take_objects(sl_context *context, document_state *document) {
    const size_t count = document->map.object_count;
    sl_free(context, document->blocks);
    document->object_count = 0;
    document->blocks = sl_alloc_array(context, count, sizeof *document->blocks);
    if (!document->blocks) return SL_NO_MEMORY;
    if (count <= OBJECTS_MOST) document->object_count = count;
    return SL_OK;
}

static void drop_baked(sl_context *context, document_state *document) {
    sl_query_destroy(context, document->query);
    document->query = NULL;
    sl_free(context, document->splits);
    sl_free(context, document->areas);
    document->splits = NULL;
    document->areas = NULL;
    if (document->baked) {
        sl_baked_destroy(context, document->baked);
        sl_free(context, document->baked);
    }
    document->baked = NULL;
    document->has_visibility = false;
}

static void count_cells(document_state *document) {
    const sl_space *space = &document->baked->space;
    document->area = document->inside_area = 0;
    document->counted = document->solid = 0;
    for (uint32_t cell = 0; cell < space->cell_count; cell++) {
        document->solid += space->cells[cell].solid;
        if (space->cells[cell].inside) document->inside_area += document->areas[cell];
        if (!sl_baked_counts(document->baked, cell)) continue;
        document->area += document->areas[cell];
        document->counted++;
    }
}

static void take_made(document_state *document, bake_job *job) {
    document->baked = job->baked;
    document->baked_depth = job->mirror_depth;
    document->query = job->query;
    document->splits = job->splits;
    document->areas = job->areas;
    document->weld = job->weld;
    document->live = job->live;
    document->shown = job->edit;
    job->taken = true;
    document->version++;
}

/// Takes over the space: it is shown from now on.
static sl_status take_space(sl_context *context, document_state *document) {
    bake_job *job = document->job;
    drop_baked(context, document);
    take_made(document, job);
    memcpy(document->inside, job->inside, sizeof document->inside);
    if (job->source.path || job->begins) {
        document->shown = document->edit; // the file's map takes the place of all changes
        sl_map_destroy(context, &document->map);
        SL_TRY(sl_map_copy(context, &job->map, &document->map));
        SL_TRY(take_objects(context, document));
        document_source_destroy(context, &document->source);
        document->source = job->source;
        job->source = (document_source){0};
        memcpy(document->notes, job->notes, sizeof document->notes);
        document->opened += !document->source.again;
        document->read++;
    }
    document_touch(document); // doors may have been turned while the job was at work
    count_cells(document);
    return SL_OK;
}

/// Takes over the visible sets. They come a second time, equal but with stab trees.
static void take_visibility(sl_context *context, document_state *document, sl_visibility *from) {
    sl_visibility_destroy(context, &document->baked->visibility);
    document->baked->visibility = *from;
    *from = (sl_visibility){0};
    document->version += !document->has_visibility;
    document->has_visibility = true;
    document->sets++;
}

static sl_status take_job(sl_context *context, document_state *document) {
    bake_job *job = document->job;
    const sl_status status = task_end(context, job->task);
    if (status == SL_OK && job->with_trees.pvs.cell_count)
        take_visibility(context, document, &job->with_trees);
    document->job = NULL;
    free_job(context, job);
    return status;
}

sl_status document_poll(sl_context *context, document_state *document, bool *changed) {
    *changed = false;
    bake_job *job = document->job;
    if (!job) return SL_OK;
    const bool done = task_done(job->task);
    if (!job->taken && atomic_load(&job->space_ready)) {
        *changed = true;
        const sl_status status = take_space(context, document);
        if (status != SL_OK) {
            document_close(context, document);
            return status;
        }
    }
    if (job->taken && !job->seen_taken && atomic_load(&job->seen_ready)) {
        *changed = true;
        job->seen_taken = true;
        take_visibility(context, document, &job->visibility);
    }
    if (!done) return SL_OK;
    *changed = true;
    return take_job(context, document);
}

void document_wait_space(const document_state *document, double seconds) {
    const double end = sl_seconds() + seconds;
    const bake_job *job = document->job;
    while (job && !job->taken && !atomic_load(&job->space_ready) && !task_done(job->task) &&
           sl_seconds() < end) {
        const struct timespec pause = {0, 100000};
        nanosleep(&pause, NULL);
    }
}

sl_status document_wait(sl_context *context, document_state *document, bool *changed) {
    bool any = false;
    sl_status status = SL_OK;
    while (document->job) {
        bool now;
        status = document_poll(context, document, &now);
        any |= now;
        if (document->job && !now) {
            const struct timespec pause = {0, 500000};
            nanosleep(&pause, NULL);
        }
    }
    *changed = any;
    return status;
}

job_progress document_progress(const document_state *document) {
    const bake_job *job = document->job;
    if (!job || (job->live && sl_seconds() < job->started + SOON)) return (job_progress){0};
    return task_progress(job->task);
}

void document_stop_soon(document_state *document) {
    if (document->job) task_cancel(document->job->task);
}

void document_cancel(sl_context *context, document_state *document) {
    bake_job *job = document->job;
    if (!job) return;
    task_drop(context, job->task);
    document->job = NULL;
    free_job(context, job);
}

void document_close(sl_context *context, document_state *document) {
    document_cancel(context, document);
    drop_baked(context, document);
    sl_map_destroy(context, &document->map);
    document_source_destroy(context, &document->source);
    sl_free(context, document->blocks);
    *document = (document_state){.version = document->version + 1,
                                 .touched = document->touched,
                                 .sets = document->sets,
                                 .opened = document->opened,
                                 .read = document->read,
                                 .history = document->history,
                                 .stale = document->stale};
}

#include "document.h"

#include "bake_job.h"
#include "sightline/support.h"

#include <string.h>
#include <strings.h>
#include <time.h>

static sl_status copy_text(sl_context *context, const char *text, char **out) {
    *out = text ? sl_copy_text(context, text, strlen(text)) : NULL;
    return text && !*out ? SL_NO_MEMORY : SL_OK;
}

void document_source_destroy(sl_context *context, document_source *source) {
    sl_free(context, source->path);
    sl_free(context, (char *)(uintptr_t)source->options.map);
    sl_free(context, (char *)(uintptr_t)source->options.layers);
    *source = (document_source){0};
}

sl_status document_source_copy(sl_context *context, const document_source *from,
                               document_source *to) {
    char *path = NULL, *map = NULL, *layers = NULL;
    sl_status status = copy_text(context, from->path, &path);
    if (status == SL_OK) status = copy_text(context, from->options.map, &map);
    if (status == SL_OK) status = copy_text(context, from->options.layers, &layers);
    document_source copy = *from;
    copy.path = path;
    copy.options.map = map;
    copy.options.layers = layers;
    if (status == SL_OK)
        *to = copy;
    else
        document_source_destroy(context, &copy);
    return status;
}

static sl_status start(sl_context *context, document_state *document, bake_job *job) {
    document_cancel(context, document);
    SL_TRY(bake_job_start(context, job));
    document->job = job;
    return SL_OK;
}

bool document_is_baked(const char *path) {
    const size_t length = strlen(path);
    return length > 4 && strcasecmp(path + length - 4, ".slv") == 0;
}

sl_status document_open(sl_context *context, document_state *document,
                        const document_source *source) {
    bake_job *job = sl_alloc_array(context, 1, sizeof *job);
    if (!job) return SL_NO_MEMORY;
    job->mirror_depth = document->mirror_depth;
    const sl_status status = document_source_copy(context, source, &job->source);
    if (status != SL_OK) {
        sl_free(context, job);
        return status;
    }
    return start(context, document, job);
}

sl_status document_rebuild(sl_context *context, document_state *document) {
    bake_job *job = sl_alloc_array(context, 1, sizeof *job);
    if (!job) return SL_NO_MEMORY;
    job->mirror_depth = document->mirror_depth;
    const sl_status status = sl_map_copy(context, &document->map, &job->map);
    if (status != SL_OK) {
        sl_free(context, job);
        return status;
    }
    return start(context, document, job);
}

bool document_has_rows(const document_state *document) {
    const double now = document->map.range, baked = document->baked->map.range;
    return document->has_visibility && (baked == 0 || (now > 0 && now <= baked));
}

void document_touch(document_state *document) {
    const sl_map *map = &document->map;
    document->touched++;
    if (!document->baked || document->baked->map.door_count != map->door_count) return;
    for (size_t i = 0; i < map->door_count; i++)
        document->baked->map.doors[i].open = map->doors[i].open;
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
    if (document->search) sl_eye_search_destroy(context, document->search);
    document->search = NULL;
    sl_outline_destroy(context, &document->outline);
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

sl_status document_add_mirrors(sl_context *context, const document_state *document,
                               sl_eye_search *search) {
    const sl_map *map = &document->baked->map;
    if (!map->mirror_count) return SL_OK;
    return sl_eye_search_add_mirrors(context, search, map, document->mirror_depth);
}

static sl_status make_search(sl_context *context, document_state *document) {
    if (document->search) sl_eye_search_destroy(context, document->search);
    document->search = NULL;
    SL_TRY(sl_eye_search_create(context, &document->baked->space, &document->baked->visibility,
                                &document->search));
    return document_add_mirrors(context, document, document->search);
}

sl_status document_renew_search(sl_context *context, document_state *document) {
    return document->search ? make_search(context, document) : SL_OK;
}

static sl_status measure_cells(sl_context *context, document_state *document) {
    const sl_space *space = &document->baked->space;
    document->areas = sl_alloc_array(context, space->cell_count, sizeof *document->areas);
    if (!document->areas) return SL_NO_MEMORY;
    document->area = 0;
    document->counted = 0;
    for (uint32_t cell = 0; cell < space->cell_count; cell++) {
        document->areas[cell] = sl_space_area(space, cell);
        if (!sl_baked_counts(document->baked, cell)) continue;
        document->area += document->areas[cell];
        document->counted++;
    }
    return SL_OK;
}

/// The space is there: from now on it is what is shown.
static sl_status take_space(sl_context *context, document_state *document) {
    bake_job *job = document->job;
    drop_baked(context, document);
    document->baked = job->baked;
    document->baked_depth = job->mirror_depth;
    job->taken = true;
    document->version++;
    if (job->source.path) {
        sl_map_destroy(context, &document->map);
        SL_TRY(sl_map_copy(context, &job->map, &document->map));
        SL_TRY(take_objects(context, document));
        document_source_destroy(context, &document->source);
        document->source = job->source;
        job->source = (document_source){0};
        document->opened += !document->source.again;
    }
    document_touch(document); // doors may have been turned while the job was at work
    SL_TRY(measure_cells(context, document));
    SL_TRY(sl_outline_make(context, &document->baked->space, &document->outline));
    SL_TRY(sl_splits_make(context, &document->baked->space, &document->splits));
    return make_search(context, document);
}

/// What is seen is there, or, with no change but for them, is there with its stab trees.
static sl_status take_visibility(sl_context *context, document_state *document,
                                 sl_visibility *from) {
    if (document->search) sl_eye_search_destroy(context, document->search);
    document->search = NULL;
    sl_visibility_destroy(context, &document->baked->visibility);
    document->baked->visibility = *from;
    *from = (sl_visibility){0};
    document->version += !document->has_visibility;
    document->has_visibility = true;
    return make_search(context, document);
}

static sl_status finish(sl_context *context, document_state *document) {
    bake_job *job = document->job;
    sl_status status = job->status;
    if (status != SL_OK)
        sl_fail(context, status, "%s", job->message);
    else if (job->with_trees.pvs.cell_count)
        status = take_visibility(context, document, &job->with_trees);
    document->job = NULL;
    bake_job_end(context, job);
    return status;
}

sl_status document_poll(sl_context *context, document_state *document, bool *changed) {
    *changed = false;
    bake_job *job = document->job;
    if (!job) return SL_OK;
    const bool done = atomic_load(&job->done);
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
        SL_TRY(take_visibility(context, document, &job->visibility));
    }
    if (!done) return SL_OK;
    *changed = true;
    return finish(context, document);
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
    if (!job) return (job_progress){0};
    const uint64_t total = atomic_load(&job->total), count = atomic_load(&job->count);
    return (job_progress){.running = true,
                          .stage = atomic_load(&job->stage),
                          .share = total ? (double)count / (double)total : -1};
}

void document_cancel(sl_context *context, document_state *document) {
    bake_job *job = document->job;
    if (!job) return;
    atomic_store(&job->cancel, true);
    document->job = NULL;
    bake_job_end(context, job);
}

void document_close(sl_context *context, document_state *document) {
    document_cancel(context, document);
    drop_baked(context, document);
    sl_map_destroy(context, &document->map);
    document_source_destroy(context, &document->source);
    sl_free(context, document->blocks);
    *document = (document_state){.version = document->version + 1,
                                 .touched = document->touched,
                                 .opened = document->opened,
                                 .history = document->history,
                                 .stale = document->stale};
}

/// Saving works on a copy of the map, in a thread: the map may change meanwhile.
#include "document/save_job.h"

#include "document/files.h"
#include "sightline/support.h"

#include <stdio.h>
#include <string.h>

// --- in the thread

static sl_status copy_file(sl_context *context, const save_job *job) {
    sl_bytes bytes;
    sl_output output;
    SL_TRY(sl_file_read(context, job->from, &bytes));
    sl_status status = sl_output_open(context, job->path, &output);
    if (status == SL_OK) {
        const bool whole = fwrite(bytes.data, 1, bytes.size, output.stream) == bytes.size;
        if (!whole) status = sl_fail(context, SL_IO, "%s: not written", job->path);
        status = sl_output_close(context, &output, status);
    }
    sl_free(context, bytes.data);
    return status;
}

static sl_status write_baked(sl_context *context, save_job *job) {
    sl_bake_options options = sl_bake_options_default();
    sl_baked baked = {0};
    options.mirror_depth = job->mirror_depth;
    options.clean.weld = job->weld;
    SL_TRY(sl_bake(context, &job->map, &options, &baked, NULL));
    const sl_status status = sl_baked_write(context, &baked, job->path);
    sl_baked_destroy(context, &baked);
    return status;
}

static sl_status write_file(sl_context *context, void *data) {
    save_job *job = data;
    if (job->from) return copy_file(context, job);
    if (!job->recover && files_end_in(job->path, ".slv")) return write_baked(context, job);
    const sl_clean_options clean = {.weld = job->weld};
    if (job->welds) SL_TRY(sl_map_clean(context, &job->map, &clean, NULL));
    SL_TRY(sl_map_settle_ground(context, &job->map));
    return sl_map_write(context, &job->map, NULL, job->path);
}

// --- the job

static sl_status fill_job(sl_context *context, save_job *job, const document_state *document,
                          const char *path, bool unchanged) {
    const document_source *source = &document->source;
    job->weld = source->has_weld ? source->weld : sl_clean_options_default().weld;
    job->welds = source->has_weld || document->map.precision > 0;
    job->mirror_depth = document->mirror_depth;
    job->state = document->history.state;
    SL_TRY(files_set_text(context, &job->path, path));
    if (unchanged && files_end_in(path, ".slv") && source->path && document_is_baked(source->path))
        return files_set_text(context, &job->from, source->path);
    return sl_map_copy(context, &document->map, &job->map);
}

sl_status save_start(sl_context *context, const document_state *document, const char *path,
                     bool unchanged, bool recover, save_job **out) {
    save_job *job = sl_alloc_array(context, 1, sizeof *job);
    if (!job) return SL_NO_MEMORY;
    job->recover = recover;
    sl_status status = fill_job(context, job, document, path, unchanged);
    if (status == SL_OK) status = task_start(context, write_file, job, NULL, NULL, &job->task);
    if (status == SL_OK)
        *out = job;
    else
        save_free(context, job);
    return status;
}

sl_status save_end(sl_context *context, save_job *job) {
    const sl_status status = task_end(context, job->task);
    job->task = NULL;
    return status;
}

void save_free(sl_context *context, save_job *job) {
    if (!job) return;
    task_drop(context, job->task);
    sl_map_destroy(context, &job->map);
    sl_free(context, job->path);
    sl_free(context, job->from);
    sl_free(context, job);
}

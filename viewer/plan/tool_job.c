/// The query is a copy, so that the document can change while the work goes on.
#include "plan/tool_job.h"

void tool_job_drop(sl_context *context, tool_job *job) {
    task_drop(context, job->task);
    sl_query_destroy(context, job->query);
    *job = (tool_job){0};
}

bool tool_job_is_old(const view_state *view, const tool_job *job) {
    return (job->task || job->made || job->stopped) && job->version != view->present.version;
}

static sl_status start_work(view_state *view, tool_job *job,
                            sl_status (*work)(sl_context *context, void *data), void *data) {
    job->version = view->present.version;
    job->stopped = true; // where it fails too, so that it is not tried again and again
    SL_TRY(sl_query_copy(view->context, view->present.query, &job->query));
    SL_TRY(task_start(view->context, work, data, NULL, NULL, &job->task));
    job->stopped = false;
    return SL_OK;
}

bool tool_job_update(view_state *view, tool_job *job, bool wait,
                     sl_status (*work)(sl_context *context, void *data), void *data) {
    const document_state *document = view->document;
    const bool settled = document->has_visibility || !(document->job || document->live);
    if (!job->task && !job->made && !job->stopped && settled && view->present.query)
        view_check(view, start_work(view, job, work, data));
    if (!job->task || !(wait || task_done(job->task))) return false;
    const sl_status status = task_end(view->context, job->task);
    job->task = NULL;
    job->made = status == SL_OK;
    job->stopped = !job->made;
    view_check(view, status);
    return job->made;
}

bool tool_job_stop(sl_context *context, tool_job *job) {
    if (!job->task) return false;
    task_drop(context, job->task);
    job->task = NULL;
    job->stopped = true;
    return true;
}

job_progress tool_job_progress(const tool_job *job) {
    return job->task ? task_progress(job->task) : (job_progress){0};
}

/// One thread a task. Its notes and progress are read by the thread that draws.
#include "document/task.h"

#include "sightline/io.h"
#include "sightline/support.h"

#include <pthread.h>
#include <stdatomic.h>

struct task {
    sl_status (*work)(sl_context *context, void *data);
    void *data;
    task_hooks hooks;
    sl_status status; ///< when `done`
    char message[1024];
    pthread_t thread;
    atomic_bool cancel, done;
    _Atomic(const char *) stage;
    atomic_uint_fast64_t count, total;
};

static bool is_cancelled(void *user) {
    const task *t = user;
    return atomic_load(&t->cancel) || (t->hooks.over && t->hooks.over(t->data));
}

static void take_note(void *user, const char *message) {
    const task *t = user;
    if (t->hooks.note) t->hooks.note(t->data, message);
}

static void take_progress(void *user, const sl_progress *progress) {
    task *t = user;
    // The stage comes last: numbers of a stage are never seen under the name of the next.
    atomic_store(&t->count, progress->done);
    atomic_store(&t->total, progress->total);
    atomic_store(&t->stage, progress->stage);
}

static void *run_task(void *user) {
    task *t = user;
    const sl_hooks hooks = {
        .user = t, .progress = take_progress, .note = take_note, .cancelled = is_cancelled};
    sl_context *context = sl_context_create(&hooks);
    t->status = context ? sl_io_use(context) : SL_NO_MEMORY;
    if (t->status == SL_OK) t->status = t->work(context, t->data);
    snprintf(t->message, sizeof t->message, "%s",
             context ? sl_context_message(context) : "out of memory");
    if (context) sl_context_destroy(context);
    atomic_store(&t->done, true);
    return NULL;
}

sl_status task_start(sl_context *context, sl_status (*work)(sl_context *context, void *data),
                     void *data, const char *stage, const task_hooks *hooks, task **out) {
    task *t = sl_alloc_array(context, 1, sizeof *t);
    if (!t) return SL_NO_MEMORY;
    t->work = work;
    t->data = data;
    if (hooks) t->hooks = *hooks;
    atomic_store(&t->stage, stage);
    if (pthread_create(&t->thread, NULL, run_task, t) != 0) {
        sl_free(context, t);
        return sl_fail(context, SL_NO_MEMORY, "no thread for the work in the background");
    }
    *out = t;
    return SL_OK;
}

bool task_done(const task *t) {
    return atomic_load(&t->done);
}

void task_cancel(task *t) {
    atomic_store(&t->cancel, true);
}

job_progress task_progress(const task *t) {
    const uint64_t total = atomic_load(&t->total), count = atomic_load(&t->count);
    return (job_progress){.running = true,
                          .stage = atomic_load(&t->stage),
                          .share = total ? (double)count / (double)total : -1,
                          .done = count,
                          .total = total};
}

sl_status task_end(sl_context *context, task *t) {
    pthread_join(t->thread, NULL);
    const sl_status status = t->status;
    if (status != SL_OK) sl_fail(context, status, "%s", t->message);
    sl_free(context, t);
    return status;
}

void task_drop(sl_context *context, task *t) {
    if (!t) return;
    task_cancel(t);
    pthread_join(t->thread, NULL);
    sl_free(context, t);
}

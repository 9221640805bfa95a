/// Work in numbered units, shared out between threads by one counter: whoever is free takes the
/// next unit. Every thread has a context of its own, so that messages do not mix. The first failure
/// stops the rest. Among several failures, the one of the lowest unit is reported, so that the
/// result does not depend on who was faster.
#include "base/base.h"

#include <assert.h>
#include <pthread.h>
#include <stdatomic.h>
#include <string.h>

#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#else
#include <unistd.h>
#endif

typedef struct crew {
    const sl_work *work;
    size_t count;
    atomic_size_t next, done;
    atomic_bool failed;
    pthread_mutex_t lock; ///< with `moved`: where units wait for others, so that they hear of these
    pthread_cond_t moved;
} crew;

typedef struct worker {
    crew *crew;
    sl_context context; // its own message; the hooks are the caller's
    pthread_t thread;
    sl_status status;
    size_t failed_unit;
    bool reports;
} worker;

/// Wakes threads that wait for a change.
static void wake(crew *c) {
    if (!c->work->after) return;
    pthread_mutex_lock(&c->lock);
    pthread_cond_broadcast(&c->moved);
    pthread_mutex_unlock(&c->lock);
}

/// Waits until a unit's wave may start; false where another unit has failed. Units are handed out
/// in order, so every unit that this one waits for is in some thread's hands. No unit of this wave
/// starts before those are done, so it is enough to count how many are done.
static bool is_ready(crew *c, size_t unit) {
    const size_t *after = c->work->after;
    if (!after) return true;
    assert(after[unit] == unit || after[unit] == after[unit - 1]);
    pthread_mutex_lock(&c->lock);
    while (atomic_load(&c->done) < after[unit] && !atomic_load(&c->failed))
        pthread_cond_wait(&c->moved, &c->lock);
    pthread_mutex_unlock(&c->lock);
    return !atomic_load(&c->failed);
}

static sl_status run_units(worker *w, void *state) {
    crew *c = w->crew;
    while (!atomic_load(&c->failed)) {
        const size_t unit = atomic_fetch_add(&c->next, 1);
        if (unit >= c->count) break;
        w->failed_unit = unit;
        SL_TRY(sl_check_cancelled(&w->context));
        if (!is_ready(c, unit)) break;
        SL_TRY(c->work->unit(&w->context, c->work->job, state, unit));
        const size_t done = atomic_fetch_add(&c->done, 1) + 1;
        wake(c);
        if (w->reports) sl_report(&w->context, c->work->stage, c->work->units, done, c->count);
    }
    return SL_OK;
}

static void run_worker(worker *w) {
    const sl_work *work = w->crew->work;
    void *state = NULL;
    w->status = work->begin ? work->begin(&w->context, work->job, &state) : SL_OK;
    if (w->status == SL_OK) {
        w->status = run_units(w, state);
        if (work->end) work->end(&w->context, work->job, state);
    }
    if (w->status == SL_OK) return;
    atomic_store(&w->crew->failed, true);
    wake(w->crew);
}

static void *run_thread(void *argument) {
    worker *w = argument;
    run_worker(w);
    if (w->crew->work->leave_thread) w->crew->work->leave_thread();
    return NULL;
}

static sl_status first_failure(sl_context *context, const worker *workers, size_t count) {
    const worker *first = NULL;
    for (size_t i = 0; i < count; i++) {
        const worker *w = &workers[i];
        if (w->status != SL_OK && (!first || w->failed_unit < first->failed_unit)) first = w;
    }
    if (!first) return SL_OK;
    memcpy(context->message, first->context.message, sizeof context->message);
    return first->status;
}

sl_status sl_work_run(sl_context *context, const sl_work *work, size_t count, unsigned threads) {
    size_t wanted = threads ? threads : sl_core_count();
    if (wanted > count) wanted = count ? count : 1;
    crew c = {.work = work, .count = count};
    worker *workers = sl_alloc_array(context, wanted, sizeof *workers);
    if (!workers) return SL_NO_MEMORY;
    for (size_t i = 0; i < wanted; i++)
        workers[i] = (worker){.crew = &c, .context = *context, .reports = i == 0 && work->stage};

    pthread_mutex_init(&c.lock, NULL);
    pthread_cond_init(&c.moved, NULL);
    if (work->stage) sl_report(context, work->stage, work->units, 0, count);
    // A thread that the system refuses is work for the others, not a failure.
    size_t started = 1;
    while (started < wanted &&
           pthread_create(&workers[started].thread, NULL, run_thread, &workers[started]) == 0)
        started++;
    run_worker(&workers[0]);
    for (size_t i = 1; i < started; i++) pthread_join(workers[i].thread, NULL);
    pthread_cond_destroy(&c.moved);
    pthread_mutex_destroy(&c.lock);
    const sl_status status = first_failure(context, workers, started);
    if (status == SL_OK && work->stage) sl_report(context, work->stage, work->units, count, count);
    sl_free(context, workers);
    return status;
}

unsigned sl_core_count(void) {
#ifdef _WIN32
    const DWORD cores = GetActiveProcessorCount(ALL_PROCESSOR_GROUPS);
#else
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
#endif
    return cores < 1 ? 1 : cores > 1024 ? 1024 : (unsigned)cores;
}

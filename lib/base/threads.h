/// Independent work in numbered units, spread over threads.
#ifndef SL_THREADS_H
#define SL_THREADS_H

#include "base/base.h"

/// What a thread does. `begin` makes what the thread needs for itself (out into *state), `unit`
/// does one unit, `end` frees the state; begin, units and end of a state run in one thread. Units
/// are handed out in ascending order, any thread may get any unit. `begin` and `end` may be NULL.
/// `after`: NULL, or for each unit the number of the first unit of its wave: waves are runs of
/// units, and one starts when all before it are done.
typedef struct sl_work {
    void *job;
    sl_status (*begin)(sl_context *context, void *job, void **state);
    sl_status (*unit)(sl_context *context, void *job, void *state, size_t unit);
    void (*end)(sl_context *context, void *job, void *state);
    void (*leave_thread)(void);
    const char *stage, *units; ///< for the progress report; NULL: none
    const size_t *after;
} sl_work;

/// Runs units 0 .. count-1 on `threads` threads (0: one a core), the caller's among them. The first
/// failure stops the rest; with several at once, that of the lowest unit is returned.
sl_status sl_work_run(sl_context *context, const sl_work *work, size_t count, unsigned threads);

/// The number of threads that 0 stands for.
unsigned sl_core_count(void);

#endif

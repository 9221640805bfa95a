/// The work in the background: from a file or a map to its space, and on to its visibility, in a
/// thread of its own.
#ifndef VIEWER_BAKE_JOB_H
#define VIEWER_BAKE_JOB_H

#include "document.h"

#include <pthread.h>
#include <stdatomic.h>

struct bake_job {
    document_source source; ///< what to read; no path: `map` is what to bake
    uint32_t mirror_depth;
    sl_map map;               ///< as drawn; filled by the job where it reads
    sl_map clean;             ///< the job's, to the end
    sl_baked *baked;          ///< the job's until space_ready, then only its visibility is
    sl_visibility visibility; ///< the job's until seen_ready
    sl_visibility with_trees; ///< the same with stab trees, when `done`; empty where there are none
    sl_status status;         ///< when `done`
    char message[1024];
    pthread_t thread;
    atomic_bool cancel, space_ready, seen_ready, done;
    double until; ///< the clock's time at which the job gives up stab trees; 0: never
    _Atomic(const char *) stage;
    atomic_uint_fast64_t count, total;
    bool taken, seen_taken; ///< the main thread has the space, the visibility
};

/// Starts the thread. Takes what the job holds in any case.
sl_status bake_job_start(sl_context *context, bake_job *job);

/// Waits for the thread and frees the job with what nobody has taken.
void bake_job_end(sl_context *context, bake_job *job);

#endif

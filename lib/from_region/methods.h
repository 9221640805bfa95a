/// The methods, and what they share: looking from all faces by several threads.
#ifndef SL_REGION_METHODS_H
#define SL_REGION_METHODS_H

#include "base/threads.h"
#include "from_region/solver.h"

#include <pthread.h>

struct sl_from_region_thread;

/// A method at work. Units of work are its own to number.
typedef struct sl_from_region_work {
    const sl_regions *scene;
    const sl_from_region_options *options;
    const sl_from_region_looker *looker;
    pthread_mutex_t lock;
    sl_from_region_account account; ///< under the lock
    uint64_t candidates, relations; ///< under the lock
    sl_bits *all;                   ///< every object
    sl_bits *seen;                  ///< the result: by view cell
    void *own;                      ///< the method's
    sl_status (*unit)(sl_context *context, struct sl_from_region_work *work,
                      struct sl_from_region_thread *thread, size_t unit);
} sl_from_region_work;

/// One thread's own.
typedef struct sl_from_region_thread {
    void *looker;
    sl_from_region_account account;
    uint64_t candidates, relations;
    sl_bits *set, *refine; ///< scratch, a row each
} sl_from_region_thread;

/// Looks from a face in all quadrants that it faces, or in one (`quadrant` 0 .. 3; -1 for all).
sl_status sl_from_region_look(sl_context *context, const sl_from_region_work *work,
                              sl_from_region_thread *thread, uint32_t face, int quadrant,
                              const sl_bits *refine, sl_bits *seen);

/// Runs units by all threads, in order; `after` as that of sl_work.
sl_status sl_from_region_run(sl_context *context, sl_from_region_work *work, size_t count,
                             const size_t *after);

static inline bool sl_face_faces(const sl_regions *scene, uint32_t face, int quadrant) {
    return scene->passes[quadrant].leaves.faces[scene->faces.items[face].directed] != SL_NO_FACE;
}

static inline void sl_row_or(sl_bits *to, const sl_bits *from, size_t words) {
    for (size_t i = 0; i < words; i++) to[i] |= from[i];
}

static inline uint64_t sl_row_count(const sl_bits *row, size_t words) {
    uint64_t count = 0;
    for (size_t i = 0; i < words; i++) count += (uint64_t)__builtin_popcountll(row[i]);
    return count;
}

/// Each fills work->seen, which is zeroed.
sl_status sl_from_region_hierarchy(sl_context *context, sl_from_region_work *work);
sl_status sl_from_region_multipass(sl_context *context, sl_from_region_work *work);

#endif

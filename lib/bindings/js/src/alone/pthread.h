/// Threads where there are none: WebAssembly in one thread. Locks do nothing, and no thread starts:
/// the library then does all work in the caller's thread.
#ifndef SIGHTLINE_ALONE_PTHREAD_H
#define SIGHTLINE_ALONE_PTHREAD_H

#include <errno.h>
#include <stddef.h>

typedef int sl_alone_lock;
#define pthread_t       sl_alone_lock
#define pthread_mutex_t sl_alone_lock
#define pthread_cond_t  sl_alone_lock

static inline int sl_alone_nothing(const sl_alone_lock *lock) {
    (void)lock;
    return 0;
}

static inline int sl_alone_begin(sl_alone_lock *lock) {
    *lock = 0;
    return 0;
}

#define pthread_mutex_init(lock, how)                   sl_alone_begin(lock)
#define pthread_mutex_destroy(lock)                     sl_alone_nothing(lock)
#define pthread_mutex_lock(lock)                        sl_alone_nothing(lock)
#define pthread_mutex_unlock(lock)                      sl_alone_nothing(lock)
#define pthread_cond_init(condition, how)               sl_alone_begin(condition)
#define pthread_cond_destroy(condition)                 sl_alone_nothing(condition)
#define pthread_cond_broadcast(condition)               sl_alone_nothing(condition)
#define pthread_cond_wait(condition, lock)              sl_alone_nothing(condition)
#define pthread_create(thread, how, function, argument) ((void)(function), EAGAIN)
#define pthread_join(thread, result)                    ((void)(thread), 0)

#endif

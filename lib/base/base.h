/// What all of the library stands on: failing with a message, memory, notes, progress.
#ifndef SL_BASE_H
#define SL_BASE_H

#include "sightline/context.h"

#include <stdarg.h>
#include <stdio.h>

#if defined(__GNUC__)
#define SL_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define SL_PRINTF(text, first)
#endif

/// Returns early with the status of a call that failed.
#define SL_TRY(call)                                                                               \
    do {                                                                                           \
        sl_status sl_try_status = (call);                                                          \
        if (sl_try_status != SL_OK) return sl_try_status;                                          \
    } while (0)

struct sl_context {
    sl_hooks hooks;
    char message[1024];
};

/// Keeps the message and returns `status`, so that `return sl_fail(...)` reads well.
sl_status sl_fail(sl_context *context, sl_status status, const char *format, ...) SL_PRINTF(3, 4);

/// As sl_fail with SL_BAD_INPUT, the message led by "FILE:LINE: " ("FILE: " where line is 0).
sl_status sl_fail_at(sl_context *context, const char *file, unsigned line, const char *format, ...)
    SL_PRINTF(4, 5);

sl_status sl_fail_memory(sl_context *context);

/// SL_CANCELLED when the user wants to stop, else SL_OK.
sl_status sl_check_cancelled(sl_context *context);

void sl_note(sl_context *context, const char *format, ...) SL_PRINTF(2, 3);
void sl_report(sl_context *context, const char *stage, const char *unit, uint64_t done,
               uint64_t total);

/// NULL and a kept message where there is no memory. Never called with bytes 0.
void *sl_alloc(sl_context *context, size_t bytes);
/// Zeroed; safe under overflow of count * size. A count of 0 gives a block that can be freed.
void *sl_alloc_array(sl_context *context, size_t count, size_t size);
void sl_free(sl_context *context, void *block);
/// Bytes that the machine has, UINT64_MAX where the system does not tell.
uint64_t sl_machine_memory(void);
/// A copy of `length` bytes with a 0 behind them.
char *sl_copy_text(sl_context *context, const char *text, size_t length);

/// Makes room for `needed` items in a growing array; doubles. Items keep their values. `items` is
/// the address of the array's pointer.
sl_status sl_reserve(sl_context *context, void *items, size_t *capacity, size_t needed,
                     size_t item_size);

/// Gives back the room behind `count` items, one or more, where the system takes it.
void sl_shrink(sl_context *context, void *items, size_t *capacity, size_t count, size_t item_size);

/// A growing array of T: zero it to start, sl_free its items to end.
#define SL_ARRAY(T)                                                                                \
    struct {                                                                                       \
        T *items;                                                                                  \
        size_t count, capacity;                                                                    \
    }

/// Room for `more` items in an SL_ARRAY; a status. `array` is a pointer to it.
#define SL_ARRAY_ROOM(context, array, more)                                                        \
    ((array)->count + (more) <= (array)->capacity                                                  \
         ? SL_OK                                                                                   \
         : sl_reserve((context), &(array)->items, &(array)->capacity, (array)->count + (more),     \
                      sizeof *(array)->items))

#endif

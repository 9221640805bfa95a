/// What every call that can fail needs: memory, messages, progress, cancellation.
///
/// Whatever can fail returns an sl_status and gives its result by an out-pointer, which is left
/// untouched on failure. The message of the last failure stays in the context. A context serves one
/// thread at a time; stages that use threads split it by themselves.
#ifndef SIGHTLINE_CONTEXT_H
#define SIGHTLINE_CONTEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if defined(SIGHTLINE_SHARED) && defined(__GNUC__)
/// Marks what a shared library shows.
#define SL_API __attribute__((visibility("default")))
#else
/// Marks what a shared library shows.
#define SL_API
#endif

/// Lets compilers check the arguments of a function against its format.
#if defined(__MINGW32__)
#define SL_PRINTF(text, first) __attribute__((format(gnu_printf, text, first)))
#elif defined(__GNUC__)
#define SL_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define SL_PRINTF(text, first)
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// How a call ended.
typedef enum sl_status {
    SL_OK = 0,
    SL_BAD_ARGUMENT, ///< an argument makes no sense; the message names it
    SL_BAD_INPUT, ///< an input file is wrong; the message starts with FILE:LINE where there is one
    SL_UNSUPPORTED, ///< the map calls for something that the chosen method does not know
    SL_NO_MEMORY,   ///< the allocator gave nothing
    SL_CANCELLED,   ///< the cancelled hook said so
    SL_IO,          ///< the system refused to read or write
} sl_status;

/// The bytes of a file, as read or made. Who is given them frees them: sl_free(context, data).
typedef struct sl_bytes {
    char *data; ///< `size` bytes and a 0 behind them
    size_t size;
} sl_bytes;

/// How far a stage has come. `total` is 0 while it is not known.
typedef struct sl_progress {
    const char *stage; ///< "read", "subdivide", "cell_to_cell", "write"
    const char *unit;  ///< what is counted, plural: "cells"
    uint64_t done;
    uint64_t total;
} sl_progress;

/// Every hook may be NULL. `resize` and `cancelled` are called from several threads at once where a
/// stage is given more than one; `progress` and `note` only from the thread that made the call.
typedef struct sl_hooks {
    void *user;
    /// As realloc; `bytes` 0 frees and returns NULL. NULL for the C library's allocator.
    void *(*resize)(void *user, void *block, size_t bytes);
    void (*progress)(void *user, const sl_progress *progress);
    /// An account of something done that the user may want to know: one line, no line end.
    void (*note)(void *user, const char *message);
    /// Asked often; true makes the running call return SL_CANCELLED.
    bool (*cancelled)(void *user);
} sl_hooks;

/// What calls that can fail are given: hooks, and the message of the last failure.
typedef struct sl_context sl_context;

/// A context with the given hooks (NULL for none). NULL where the allocator gives nothing.
SL_API sl_context *sl_context_create(const sl_hooks *hooks);
/// Frees a context; NULL is fine.
SL_API void sl_context_destroy(sl_context *context);

/// The hooks it was made with: for a context beside it that passes them on.
SL_API const sl_hooks *sl_context_hooks(const sl_context *context);

/// How much readers of maps make of a file at most, so that a short file cannot ask for all memory.
/// 0 stands for the usual limit. A file that gives more is refused (SL_BAD_INPUT) before it is
/// unpacked or drawn; the table in lib/io/FORMATS.md says what each reader counts.
typedef struct sl_limits {
    uint64_t squares;  ///< tiles and cells of all layers, and squares of a grid; usual 2^27
    uint64_t pixels;   ///< of a picture; usual 2^28
    uint64_t walls;    ///< drawn by lines and curves; usual 2^24
    uint64_t entities; ///< shapes of a drawing, as often as blocks and uses repeat them; usual 2^24
    uint64_t depth;    ///< blocks in blocks, groups and uses in groups; usual 512
} sl_limits;

/// Sets the limits of all reading with this context; NULL for the usual ones.
SL_API void sl_context_set_limits(sl_context *context, const sl_limits *limits);

/// What the last failed call said: one line, no line end, "" when none failed.
SL_API const char *sl_context_message(const sl_context *context);

/// The status in words: "bad input".
SL_API const char *sl_status_name(sl_status status);

#ifdef __cplusplus
}
#endif

#endif

/// For programs and parts that are written as the library itself is: statuses that lead to an early
/// return, memory, growing arrays, sets of bits, random numbers, work on threads, numbers as text,
/// whole files. Programs that only ask what is seen do not need it.
#ifndef SIGHTLINE_SUPPORT_H
#define SIGHTLINE_SUPPORT_H

#include "sightline/context.h"

#include <stdarg.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Returns early with the status of a call that failed.
#define SL_TRY(call)                                                                               \
    do {                                                                                           \
        sl_status sl_try_status = (call);                                                          \
        if (sl_try_status != SL_OK) return sl_try_status;                                          \
    } while (0)

/// Keeps the message and returns `status`, so that `return sl_fail(...)` reads well.
SL_API sl_status sl_fail(sl_context *context, sl_status status, const char *format, ...)
    SL_PRINTF(3, 4);

/// As sl_fail with SL_BAD_INPUT, the message led by "FILE:LINE: " ("FILE: " where line is 0).
SL_API sl_status sl_fail_at(sl_context *context, const char *file, unsigned line,
                            const char *format, ...) SL_PRINTF(4, 5);

/// Says that there is no memory; gives SL_NO_MEMORY.
SL_API sl_status sl_fail_memory(sl_context *context);

/// SL_CANCELLED when the user wants to stop, else SL_OK.
SL_API sl_status sl_check_cancelled(sl_context *context);

/// Hands a message, as printf makes it, to the note hook.
SL_API void sl_note(sl_context *context, const char *format, ...) SL_PRINTF(2, 3);
/// Hands progress to the hook.
SL_API void sl_report(sl_context *context, const char *stage, const char *unit, uint64_t done,
                      uint64_t total);

/// NULL and a kept message where there is no memory. Never called with bytes 0.
SL_API void *sl_alloc(sl_context *context, size_t bytes);
/// Zeroed; safe under overflow of count * size. A count of 0 gives a block that can be freed.
SL_API void *sl_alloc_array(sl_context *context, size_t count, size_t size);
/// Frees what sl_alloc and its like gave; NULL is fine.
SL_API void sl_free(sl_context *context, void *block);
/// Bytes that the machine has, UINT64_MAX where the system does not tell.
SL_API uint64_t sl_machine_memory(void);
/// Seconds on a clock that only goes forward, since some moment.
SL_API double sl_seconds(void);
/// A copy of `length` bytes with a 0 behind them.
SL_API char *sl_copy_text(sl_context *context, const char *text, size_t length);

/// Makes room for `needed` items in a growing array; doubles. Items keep their values. `items` is
/// the address of the array's pointer.
SL_API sl_status sl_reserve(sl_context *context, void *items, size_t *capacity, size_t needed,
                            size_t item_size);

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

// --- sets of small numbers, a bit each

/// A word of a bit set: bit i of a set is word i / 64, bit i % 64.
typedef uint64_t sl_bits;

/// Words of a set of `count` bits.
static inline size_t sl_bits_words(size_t count) {
    return (count + 63) / 64;
}

/// Whether bit i is set.
static inline bool sl_bits_has(const sl_bits *set, size_t i) {
    return set[i / 64] >> (i % 64) & 1;
}

/// Sets bit i.
static inline void sl_bits_add(sl_bits *set, size_t i) {
    set[i / 64] |= (sl_bits)1 << (i % 64);
}

/// Turns bit i over.
static inline void sl_bits_flip(sl_bits *set, size_t i) {
    set[i / 64] ^= (sl_bits)1 << (i % 64);
}

// --- disjoint sets of numbers: parent[i] == i at first

/// The root of the set that a number is in; shortens the way to it.
static inline uint32_t sl_root_of(uint32_t *parent, uint32_t at) {
    while (parent[at] != at) at = parent[at] = parent[parent[at]];
    return at;
}

// --- random numbers: the same on every machine (SplitMix64; Steele, Lea & Flood 2014)

/// A source of random numbers; `state` is the seed at first. The same on every machine.
typedef struct sl_random {
    uint64_t state;
} sl_random;

/// The next 64 random bits.
static inline uint64_t sl_random_next(sl_random *random) {
    uint64_t z = random->state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

/// Uniform in 0 .. bound - 1, up to a bias below bound / 2^64.
static inline uint64_t sl_random_below(sl_random *random, uint64_t bound) {
    return sl_random_next(random) % bound;
}

/// Uniform in [0, 1), 53 bits.
static inline double sl_random_unit(sl_random *random) {
    return (double)(sl_random_next(random) >> 11) * 1.1102230246251565e-16; // 2^-53
}

// --- independent work in numbered units, spread over threads

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
SL_API sl_status sl_work_run(sl_context *context, const sl_work *work, size_t count,
                             unsigned threads);

/// The number of threads that 0 stands for.
SL_API unsigned sl_core_count(void);

// --- numbers as text, both ways, the same in every locale

/// The longest text of sl_number_write, its 0 included.
#define SL_NUMBER_TEXT 32

/// The shortest decimal (at most 17 digits) that reads back to the same double. Finite values only.
SL_API void sl_number_write(double value, char text[SL_NUMBER_TEXT]);

/// Reads a decimal number that is all of text[0 .. length): sign, digits, point, exponent. False
/// for anything else: "nan", "inf", "0x1", "1e", "", more than 2048 characters. A magnitude too
/// large reads as an infinity, one too small as the nearest double, which may be 0.
SL_API bool sl_number_read(const char *text, size_t length, double *value);

/// What stands between the fields of a table, by its first line: ';' where that has one, else a
/// tab where it has one, else ','.
SL_API char sl_table_separator(const char *line, size_t length);

/// Reads a number of a table as sl_number_read. Where the separator is no comma, a comma is read as
/// the decimal point.
SL_API bool sl_table_number_read(char separator, const char *text, size_t length, double *value);

/// Writes a text as a field of a table. Quotes stand around one that needs them (RFC 4180), and
/// around all where `quoted`. It stays on one line, so that line numbers are those of rows.
SL_API void sl_table_text_write(FILE *out, const char *text, bool quoted);

/// The order of two doubles by value, for qsort.
SL_API int sl_compare_numbers(const void *left, const void *right);

// --- whole files: a file is written beside its target and renamed, so that a failure leaves the
// --- old one as it was and nothing half-written. A program that is killed meanwhile may leave
// --- the file beside it: the target's name, a dot and six characters. It may be deleted.

/// Reads all of a file, or of stdin where path is "-"; sl_free(data) is the caller's. SL_IO with
/// the system's reason on failure, SL_BAD_INPUT where it is too large: of more
/// bytes than a quarter of the machine's memory or, of a pipe or a device, than 1 GiB.
SL_API sl_status sl_file_read(sl_context *context, const char *path, sl_bytes *out);

/// What is at a path.
typedef enum sl_path_kind {
    SL_PATH_NOTHING, ///< or what cannot be asked; errno says why
    SL_PATH_FILE,
    SL_PATH_FOLDER,
    SL_PATH_STREAM ///< a device or a pipe
} sl_path_kind;

/// The last part of a path: the name of a file without its folders, and on Windows without a drive.
SL_API const char *sl_path_name(const char *path);

/// What a path, or the link there, leads to.
SL_API sl_path_kind sl_path_look(const char *path);

/// A file in the making: written beside its target, and put in its place by sl_output_close.
typedef struct sl_output {
    FILE *stream;
    char *path, *temporary;
} sl_output;

/// Opens a file beside `path` (or what a link there leads to) for writing; stdout where path is
/// "-"; a device or a pipe itself.
SL_API sl_status sl_output_open(sl_context *context, const char *path, sl_output *out);
/// Fails as sl_output_open() would, and leaves nothing: asked before work that takes long. A device
/// or a pipe is not touched.
SL_API sl_status sl_output_try(sl_context *context, const char *path);
/// Where `status` is SL_OK, flushes to the disk and takes the target's place; on failure the target
/// is left as it was. Else gives up and removes what was written. Returns what came of it.
SL_API sl_status sl_output_close(sl_context *context, sl_output *output, sl_status status);

#ifdef __cplusplus
}
#endif

#endif

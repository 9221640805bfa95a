/// The context: hooks, the message of the last failure, memory, and the tables of formats.
#include "base/base.h"
#include "sightline/version.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#else
#include <unistd.h>
#endif

static void *resize(const sl_hooks *hooks, void *block, size_t bytes) {
    if (hooks->resize) return hooks->resize(hooks->user, block, bytes);
    if (bytes) return realloc(block, bytes);
    free(block);
    return NULL;
}

sl_context *sl_context_create(const sl_hooks *hooks) {
    const sl_hooks none = {0};
    if (!hooks) hooks = &none;
    sl_context *context = resize(hooks, NULL, sizeof *context);
    if (!context) return NULL;
    *context = (sl_context){.hooks = *hooks};
    return context;
}

void sl_context_destroy(sl_context *context) {
    if (!context) return;
    const sl_hooks hooks = context->hooks;
    sl_free(context, context->map_formats.items);
    sl_free(context, context->export_formats.items);
    resize(&hooks, context, 0);
}

const sl_hooks *sl_context_hooks(const sl_context *context) {
    return &context->hooks;
}

void sl_context_set_limits(sl_context *context, const sl_limits *limits) {
    context->limits = limits ? *limits : (sl_limits){0};
}

const char *sl_context_message(const sl_context *context) {
    return context->message;
}

const char *sl_version(void) {
    return SL_VERSION;
}

const char *sl_status_name(sl_status status) {
    switch (status) {
    case SL_OK:
        return "ok";
    case SL_BAD_ARGUMENT:
        return "bad argument";
    case SL_BAD_INPUT:
        return "bad input";
    case SL_UNSUPPORTED:
        return "unsupported";
    case SL_NO_MEMORY:
        return "out of memory";
    case SL_CANCELLED:
        return "interrupted";
    case SL_IO:
        return "input/output error";
    }
    return "unknown status";
}

sl_status sl_fail(sl_context *context, sl_status status, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(context->message, sizeof context->message, format, arguments);
    va_end(arguments);
    return status;
}

sl_status sl_fail_at(sl_context *context, const char *file, unsigned line, const char *format,
                     ...) {
    char what[sizeof context->message];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    if (line) return sl_fail(context, SL_BAD_INPUT, "%s:%u: %s", file, line, what);
    return sl_fail(context, SL_BAD_INPUT, "%s: %s", file, what);
}

sl_status sl_fail_memory(sl_context *context) {
    return sl_fail(context, SL_NO_MEMORY, "out of memory");
}

sl_status sl_check_cancelled(sl_context *context) {
    if (context->hooks.cancelled && context->hooks.cancelled(context->hooks.user))
        return sl_fail(context, SL_CANCELLED, "interrupted");
    return SL_OK;
}

void sl_note(sl_context *context, const char *format, ...) {
    if (!context->hooks.note) return;
    char what[sizeof context->message];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    context->hooks.note(context->hooks.user, what);
}

void sl_report(sl_context *context, const char *stage, const char *unit, uint64_t done,
               uint64_t total) {
    if (!context->hooks.progress) return;
    const sl_progress progress = {.stage = stage, .unit = unit, .done = done, .total = total};
    context->hooks.progress(context->hooks.user, &progress);
}

void *sl_alloc(sl_context *context, size_t bytes) {
    void *block = resize(&context->hooks, NULL, bytes);
    if (!block) sl_fail_memory(context);
    return block;
}

void *sl_alloc_array(sl_context *context, size_t count, size_t size) {
    if (count > SIZE_MAX / 2 / size) {
        sl_fail_memory(context);
        return NULL;
    }
    const size_t bytes = count ? count * size : 1;
    void *block = sl_alloc(context, bytes);
    if (block) memset(block, 0, bytes);
    return block;
}

void sl_free(sl_context *context, void *block) {
    if (block) resize(&context->hooks, block, 0);
}

uint64_t sl_machine_memory(void) {
#ifdef _WIN32
    MEMORYSTATUSEX memory = {.dwLength = sizeof memory};
    return GlobalMemoryStatusEx(&memory) ? memory.ullTotalPhys : UINT64_MAX;
#else
    const long pages = sysconf(_SC_PHYS_PAGES), bytes = sysconf(_SC_PAGESIZE);
    return pages > 0 && bytes > 0 ? (uint64_t)pages * (uint64_t)bytes : UINT64_MAX;
#endif
}

const char *sl_path_name(const char *path) {
#ifdef _WIN32
    static const char separators[] = "/\\:";
#else
    static const char separators[] = "/";
#endif
    const char *name = path;
    for (; *path; path++)
        if (strchr(separators, *path)) name = path + 1;
    return name;
}

char *sl_copy_text(sl_context *context, const char *text, size_t length) {
    char *copy = sl_alloc(context, length + 1);
    if (!copy) return NULL;
    if (length) memcpy(copy, text, length);
    copy[length] = '\0';
    return copy;
}

sl_status sl_reserve(sl_context *context, void *items, size_t *capacity, size_t needed,
                     size_t item_size) {
    if (needed <= *capacity) return SL_OK;
    size_t grown = *capacity < 8 ? 8 : *capacity * 2;
    if (grown < needed) grown = needed;
    if (grown > SIZE_MAX / 2 / item_size) return sl_fail_memory(context);
    // `items` points to a T *: read and written as bytes, since a T * is no void * to the compiler.
    void *block;
    memcpy(&block, items, sizeof block);
    block = resize(&context->hooks, block, grown * item_size);
    if (!block) return sl_fail_memory(context);
    memcpy(items, &block, sizeof block);
    *capacity = grown;
    return SL_OK;
}

void sli_shrink(sl_context *context, void *items, size_t *capacity, size_t count,
                size_t item_size) {
    if (!count || count >= *capacity) return;
    void *block;
    memcpy(&block, items, sizeof block);
    block = resize(&context->hooks, block, count * item_size);
    if (!block) return;
    memcpy(items, &block, sizeof block);
    *capacity = count;
}

double sl_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

// --- tables that other libraries add to

static const char *name_of(const char *item) {
    const char *name;
    memcpy(&name, item, sizeof name);
    return name;
}

static bool has_name(const char *items, size_t count, size_t size, const char *name) {
    for (size_t i = 0; i < count; i++)
        if (strcmp(name_of(items + i * size), name) == 0) return true;
    return false;
}

const void *sli_table_items(const sli_table *table, const void *own, size_t own_count,
                            size_t *count) {
    *count = table->items ? table->count : own_count;
    return table->items ? table->items : own;
}

sl_status sli_table_add(sl_context *context, sli_table *table, size_t size, const void *own,
                        size_t own_count, const void *more, size_t count) {
    size_t total, added = 0;
    const void *before = sli_table_items(table, own, own_count, &total);
    for (const char *item = more, *end = item + count * size; item < end; item += size)
        added += !has_name(before, total, size, name_of(item));
    if (!added) return SL_OK;
    char *items = sl_alloc_array(context, total + count, size);
    if (!items) return SL_NO_MEMORY;
    memcpy(items, before, total * size);
    for (const char *item = more, *end = item + count * size; item < end; item += size)
        if (!has_name(items, total, size, name_of(item)))
            memcpy(items + total++ * size, item, size);
    sl_free(context, table->items);
    *table = (sli_table){items, total};
    return SL_OK;
}

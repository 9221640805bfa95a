#include "base/file.h"
#include "sightline/import.h"

#include <string.h>

sl_import_options sl_import_options_default(void) {
    return (sl_import_options){.has_slice = false};
}

static sl_status read_text(sl_context *context, const char *name, const char *text, size_t size,
                           const sl_import_options *options, sl_map *map) {
    (void)options;
    return sl_map_read_text(context, name, text, size, map);
}

static sl_status read_plan(sl_context *context, const char *name, const char *text, size_t size,
                           const sl_import_options *options, sl_map *map) {
    (void)options;
    return sl_map_read_plan(context, name, text, size, map);
}

static const sl_map_format formats[] = {
    {"text", ".map", "the map text", read_text},
    {"plan", ".txt", "an ASCII plan", read_plan},
    {"unigrafix", ".ug", "a UniGrafix model, cut at a height", sl_map_read_unigrafix},
};
#define FORMAT_COUNT (sizeof formats / sizeof *formats)

const sl_map_format *sl_map_formats(size_t *count) {
    *count = FORMAT_COUNT;
    return formats;
}

static char lower(char c) {
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

/// Whether a path ends so, in small letters or capitals.
static bool ends_in(const char *path, const char *ending, size_t length) {
    const size_t all = strlen(path);
    if (all < length) return false;
    for (size_t i = 0; i < length; i++)
        if (lower(path[all - length + i]) != ending[i]) return false;
    return true;
}

static const sl_map_format *find_format(const char *path) {
    for (size_t i = 0; i < FORMAT_COUNT; i++) {
        for (const char *at = formats[i].endings; *at;) {
            const size_t length = strcspn(at, " ");
            if (ends_in(path, at, length)) return &formats[i];
            at += length + strspn(at + length, " ");
        }
    }
    return &formats[0];
}

sl_status sl_map_read(sl_context *context, const char *path, const sl_import_options *options,
                      sl_map *map) {
    sl_bytes bytes;
    const sl_import_options usual = sl_import_options_default();
    if (!options) options = &usual;
    SL_TRY(sl_file_read(context, path, &bytes));
    sl_map read = {0};
    char *source = sl_copy_text(context, path, strlen(path));
    sl_status status = source ? SL_OK : SL_NO_MEMORY;
    if (source)
        status = find_format(path)->read(context, path, bytes.data, bytes.size, options, &read);
    sl_free(context, bytes.data);
    if (status != SL_OK) {
        sl_free(context, source);
        return status;
    }
    read.source = source;
    *map = read;
    sl_report(context, "read", "bytes", bytes.size, bytes.size);
    return SL_OK;
}

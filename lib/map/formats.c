/// Which reader a map file needs: by the ending of its name, else by its first bytes.
#include "sightline/import.h"

#include "base/base.h"

#include <string.h>
#include <strings.h>

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
    {.name = "text",
     .endings = ".map",
     .what = "the map text",
     .read = read_text,
     .takes = SL_TAKES_CELLS},
    {.name = "plan", .endings = ".txt", .what = "an ASCII plan", .read = read_plan},
};
enum { FORMAT_COUNT = sizeof formats / sizeof *formats };

const sl_map_format *sl_map_formats(const sl_context *context, size_t *count) {
    return sli_table_items(&context->map_formats, formats, FORMAT_COUNT, count);
}

sl_status sl_map_formats_add(sl_context *context, const sl_map_format *more, size_t count) {
    return sli_table_add(context, &context->map_formats, sizeof *formats, formats, FORMAT_COUNT,
                         more, count);
}

// --- which format

/// Whether a path ends so, in small letters or capitals.
static bool ends_in(const char *path, const char *ending, size_t length) {
    const size_t all = strlen(path);
    return all >= length && strncasecmp(path + all - length, ending, length) == 0;
}

static bool has_ending(const sl_map_format *format, const char *path) {
    for (const char *at = format->endings; *at;) {
        const size_t length = strcspn(at, " ");
        if (ends_in(path, at, length)) return true;
        at += length + strspn(at + length, " ");
    }
    return false;
}

/// The format that the ending tells; where it tells several or none, the one that knows the bytes.
static const sl_map_format *find_format(const sl_context *context, const char *path,
                                        const char *text, size_t size) {
    const sl_map_format *by_ending = NULL, *by_bytes = NULL;
    size_t fitting = 0, count;
    const sl_map_format *known = sl_map_formats(context, &count);
    for (size_t i = count; i-- > 0;) {
        if (!has_ending(&known[i], path)) continue;
        by_ending = &known[i];
        fitting++;
    }
    if (fitting == 1) return by_ending;
    for (size_t i = count; i-- > 0;) {
        if (fitting && !has_ending(&known[i], path)) continue;
        if (known[i].knows && known[i].knows(text, size)) by_bytes = &known[i];
    }
    return by_bytes ? by_bytes : by_ending ? by_ending : &known[0];
}

// --- which of its maps

void sl_map_list_destroy(sl_context *context, sl_map_list *list) {
    for (size_t i = 0; i < list->count; i++) sl_free(context, list->names[i]);
    sl_free(context, list->names);
    *list = (sl_map_list){0};
}

sl_status sl_map_list_add(sl_context *context, sl_map_list *list, const char *name, size_t length) {
    SL_TRY(sl_reserve(context, &list->names, &list->room, list->count + 1, sizeof *list->names));
    char *copy = sl_copy_text(context, name, length);
    if (!copy) return SL_NO_MEMORY;
    list->names[list->count++] = copy;
    return SL_OK;
}

/// SL_BAD_ARGUMENT: "FILE: LEAD holds 36 maps, E1M1, E1M2, E1M3 ...: TAIL"
static sl_status fail_choice(sl_context *context, const char *path, const sl_map_list *list,
                             const char *lead, const char *tail) {
    enum { SHOWN = 6, MOST = 64 };
    char names[SHOWN * (MOST + 2) + 8] = "";
    for (size_t i = 0; i < list->count && i < SHOWN; i++) {
        const size_t used = strlen(names);
        snprintf(names + used, sizeof names - used, "%s%.*s", i ? ", " : "", (int)MOST,
                 list->names[i]);
    }
    return sl_fail(context, SL_BAD_ARGUMENT, "%s: %sit holds %zu map%s, %s%s%s", path, lead,
                   list->count, list->count == 1 ? "" : "s", names,
                   list->count > SHOWN ? " ..." : "", tail);
}

/// Puts the name of the map to read, as the file has it, into options->map.
static sl_status choose_map(sl_context *context, const char *path, const sl_map_list *list,
                            sl_import_options *options) {
    if (list->count == 0) return sl_fail_at(context, path, 0, "holds no map");
    if (!options->map && list->count > 1)
        return fail_choice(context, path, list, "", ": choose one by --map NAME");
    if (!options->map) {
        options->map = list->names[0];
        return SL_OK;
    }
    for (size_t i = 0; i < list->count; i++) {
        if (strcasecmp(list->names[i], options->map) != 0) continue;
        options->map = list->names[i];
        return SL_OK;
    }
    char lead[128];
    snprintf(lead, sizeof lead, "there is no map '%.64s': ", options->map);
    return fail_choice(context, path, list, lead, "");
}

// --- reading

/// SL_BAD_ARGUMENT where an option is given that the format does not take.
static sl_status check_options(sl_context *context, const char *path, const sl_map_format *format,
                               const sl_import_options *options) {
    const struct {
        const char *name;
        bool given, taken;
    } all[] = {
        {"map", options->map, format->list},
        {"slice", options->has_slice, format->takes & SL_TAKES_SLICE},
        {"layers", options->layers, format->takes & SL_TAKES_LAYERS},
        {"start-names", options->start_names, format->takes & SL_TAKES_STARTS},
        {"tolerance", options->tolerance != 0, format->takes & SL_TAKES_TOLERANCE},
        {"unit", options->unit, format->takes & SL_TAKES_UNIT},
        {"threshold", options->threshold != 0, format->takes & SL_TAKES_THRESHOLD},
        {"doors", options->doors, format->takes & SL_TAKES_DOORS},
        {"sectors", options->sectors, format->takes & SL_TAKES_SECTORS},
        {"subdivide given", options->cells, format->takes & SL_TAKES_CELLS},
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (all[i].given && !all[i].taken)
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "--%s: %s is read as %s, which has no use for it", all[i].name, path,
                           format->what);
    return SL_OK;
}

static sl_status read_format(sl_context *context, const char *path, const sl_map_format *format,
                             const char *text, size_t size, const sl_import_options *given,
                             sl_map *map) {
    SL_TRY(check_options(context, path, format, given));
    sl_import_options options = *given;
    sl_map_list list = {0};
    sl_status status = SL_OK;
    if (format->list) {
        status = format->list(context, path, text, size, &list);
        if (status == SL_OK) status = choose_map(context, path, &list, &options);
    }
    if (status == SL_OK) status = format->read(context, path, text, size, &options, map);
    sl_map_list_destroy(context, &list);
    return status;
}

/// A foreign file that was taken for map text: the message says how to read it.
static sl_status tell_of_formats(sl_context *context, const char *path, sl_status status) {
    size_t count;
    const sl_map_format *known = sl_map_formats(context, &count);
    const char *slash = strrchr(path, '/'), *ending = strrchr(slash ? slash : path, '.');
    char message[sizeof context->message];
    if (status != SL_BAD_INPUT || context->map_formats.items || !ending) return status;
    for (size_t i = 0; i < count; i++)
        if (has_ending(&known[i], path)) return status;
    memcpy(message, context->message, sizeof message);
    return sl_fail(context, status, "%.900s (read as map text: sl_io_use() adds other formats)",
                   message);
}

sl_status sl_map_parse(sl_context *context, const char *path, const char *text, size_t size,
                       const sl_import_options *options, sl_map *map) {
    const sl_import_options usual = sl_import_options_default();
    if (!options) options = &usual;
    sl_map read = {0};
    char *source = sl_copy_text(context, path, strlen(path));
    sl_status status = source ? SL_OK : SL_NO_MEMORY;
    if (source)
        status = read_format(context, path, find_format(context, path, text, size), text, size,
                             options, &read);
    if (status != SL_OK) {
        sl_free(context, source);
        return tell_of_formats(context, path, status);
    }
    read.source = source;
    *map = read;
    sl_report(context, "read", "bytes", size, size);
    return SL_OK;
}

sl_status sl_map_read(sl_context *context, const char *path, const sl_import_options *options,
                      sl_map *map) {
    sl_bytes bytes;
    SL_TRY(sl_file_read(context, path, &bytes));
    const sl_status status = sl_map_parse(context, path, bytes.data, bytes.size, options, map);
    sl_free(context, bytes.data);
    return status;
}

void sl_map_choice_destroy(sl_context *context, sl_map_choice *choice) {
    sl_map_list_destroy(context, &choice->maps);
    sl_map_list_destroy(context, &choice->layers);
    *choice = (sl_map_choice){0};
}

sl_status sl_map_choice_parse(sl_context *context, const char *path, const char *text, size_t size,
                              sl_map_choice *out) {
    sl_map_choice read = {.format = find_format(context, path, text, size)};
    const sl_map_format *format = read.format;
    sl_status status = SL_OK;
    if (format->list) status = format->list(context, path, text, size, &read.maps);
    if (status == SL_OK && format->heights)
        status = format->heights(context, path, text, size, &read.lowest, &read.highest);
    if (status == SL_OK && format->layers)
        status = format->layers(context, path, text, size, &read.layers, &read.layers_unsaid);
    if (status == SL_OK)
        *out = read;
    else
        sl_map_choice_destroy(context, &read);
    return status;
}

sl_status sl_map_choice_read(sl_context *context, const char *path, sl_map_choice *out) {
    sl_bytes bytes;
    SL_TRY(sl_file_read(context, path, &bytes));
    const sl_status status = sl_map_choice_parse(context, path, bytes.data, bytes.size, out);
    sl_free(context, bytes.data);
    return status;
}

sl_status sl_map_list_read(sl_context *context, const char *path, sl_map_list *list) {
    sl_map_choice choice;
    SL_TRY(sl_map_choice_read(context, path, &choice));
    *list = choice.maps;
    choice.maps = (sl_map_list){0};
    sl_map_choice_destroy(context, &choice);
    return SL_OK;
}

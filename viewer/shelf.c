#include "shelf.h"

#include "sightline/import.h"
#include "sightline/support.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum { FILES_MOST = 200, PATH = 4096 };

/// By ending. Text files and pictures can be anything, and are listed only where they lie with
/// maps.
static bool is_map(const sl_context *context, const char *name, bool with_maps) {
    const char *dot = strrchr(name, '.');
    if (!dot) return false;
    if (strcasecmp(dot, ".slv") == 0) return true;
    const char *const vague[] = {".txt", ".png", ".svg", ".yaml", ".json", ".xml", ".pgm", ".pbm"};
    for (size_t i = 0; i < sizeof vague / sizeof *vague; i++)
        if (strcasecmp(dot, vague[i]) == 0 && (!with_maps || i > 0)) return false;
    size_t count;
    const sl_map_format *formats = sl_map_formats(context, &count);
    for (size_t i = 0; i < count; i++) {
        for (const char *at = formats[i].endings; *at;) {
            const size_t length = strcspn(at, " ");
            if (strlen(dot) == length && strncasecmp(dot, at, length) == 0) return true;
            for (at += length; *at == ' ';) at++;
        }
    }
    return false;
}

static int by_name(const void *a, const void *b) {
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static void add_folder(sl_app *app, const char *folder, bool with_maps) {
    DIR *dir = opendir(folder);
    if (!dir) return;
    sl_map_list *files = &app->shelf.files;
    const size_t first = files->count;
    char path[PATH];
    for (struct dirent *entry; (entry = readdir(dir)) && files->count < FILES_MOST;) {
        const int length = snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        struct stat info;
        if (length < 0 || length >= PATH || !is_map(app->context, entry->d_name, with_maps) ||
            stat(path, &info) != 0 || !S_ISREG(info.st_mode))
            continue;
        if (sl_map_list_add(app->context, files, path, (size_t)length) != SL_OK) break;
    }
    closedir(dir);
    if (files->count > first)
        qsort(files->names + first, files->count - first, sizeof *files->names, by_name);
}

static bool same_folder(const char *a, const char *b) {
    struct stat x, y;
    return stat(a, &x) == 0 && stat(b, &y) == 0 && x.st_dev == y.st_dev && x.st_ino == y.st_ino;
}

void sl_shelf_fill(sl_app *app, const char *beside) {
    char folder[PATH] = ".";
    const char *slash = beside ? strrchr(beside, '/') : NULL;
    if (slash && slash - beside < PATH - 1)
        snprintf(folder, sizeof folder, "%.*s", (int)(slash - beside),
                 slash == beside ? "/" : beside);
    add_folder(app, folder, true);
    if (!same_folder(folder, "maps")) add_folder(app, "maps", true);
    if (!same_folder(folder, "maps/oblique")) add_folder(app, "maps/oblique", true);
    if (!same_folder(folder, ".")) add_folder(app, ".", false);
}

void sl_shelf_forget_maps(sl_app *app) {
    sl_map_list_destroy(app->context, &app->shelf.maps);
    sl_document_source_destroy(app->context, &app->shelf.source);
    app->shelf.at = app->shelf.first = 0;
}

void sl_shelf_empty(sl_app *app) {
    sl_shelf_forget_maps(app);
    sl_map_list_destroy(app->context, &app->shelf.files);
}

// --- opening

static void keep_useful(sl_import_options *options, unsigned takes) {
    const sl_import_options usual = sl_import_options_default();
    if (!(takes & SL_TAKES_SLICE)) options->has_slice = false;
    if (!(takes & SL_TAKES_LAYERS)) options->layers = NULL;
    if (!(takes & SL_TAKES_TOLERANCE)) options->tolerance = usual.tolerance;
    if (!(takes & SL_TAKES_UNIT)) options->unit = NULL;
    if (!(takes & SL_TAKES_THRESHOLD)) options->threshold = usual.threshold;
    if (!(takes & SL_TAKES_DOORS)) options->doors = false;
    if (!(takes & SL_TAKES_CELLS)) options->cells = false;
}

/// What the file is, and what there is to choose.
static sl_status look(sl_context *context, sl_document_source *source, sl_map_choice *choice) {
    if (sl_document_is_baked(source->path)) return SL_OK;
    SL_TRY(sl_map_choice_read(context, source->path, choice));
    source->takes = choice->format->takes;
    source->lowest = choice->lowest;
    source->highest = choice->highest;
    return SL_OK;
}

static sl_status open_source(sl_app *app, sl_document_source source, bool ask, bool all_meant) {
    sl_context *context = app->context;
    sl_map_choice choice = {0};
    sl_shelf_forget_maps(app);
    SL_TRY(look(context, &source, &choice));
    if (!all_meant) keep_useful(&source.options, source.takes);
    if (source.highest > source.lowest && !source.options.has_slice) {
        source.options.has_slice = true;
        source.options.slice = source.lowest + (source.highest - source.lowest) / 2;
    }
    sl_status status = SL_OK;
    if (ask && choice.maps.count > 1 && !source.options.map) {
        status = sl_document_source_copy(context, &source, &app->shelf.source);
        app->shelf.maps = choice.maps;
        choice.maps = (sl_map_list){0};
        app->maps_open = true;
    } else {
        status = sl_document_open(context, &app->document, &source);
    }
    sl_map_choice_destroy(context, &choice);
    return status;
}

sl_status sl_shelf_open_source(sl_app *app, const sl_document_source *source, bool ask) {
    return open_source(app, *source, ask, true);
}

void sl_shelf_open(sl_app *app, const char *path) {
    const sl_document_source source = {.path = (char *)(uintptr_t)path, .options = app->options};
    app->maps_open = false;
    sl_app_check(app, open_source(app, source, true, false));
}

void sl_shelf_open_again(sl_app *app, const sl_import_options *options) {
    sl_document_source source = app->document.source;
    if (!source.path) return;
    source.options = *options;
    source.again = true;
    sl_history_clear(app->context, &app->history);
    sl_app_check(app, sl_document_open(app->context, &app->document, &source));
}

const sl_map_list *sl_shelf_list(const sl_app *app) {
    return app->shelf.source.path ? &app->shelf.maps : &app->shelf.files;
}

void sl_shelf_choose(sl_app *app, size_t row) {
    const sl_map_list *list = sl_shelf_list(app);
    if (row >= list->count) return;
    if (list == &app->shelf.files) {
        sl_shelf_open(app, list->names[row]);
        return;
    }
    sl_document_source source = app->shelf.source;
    source.options.map = list->names[row];
    app->maps_open = false;
    sl_app_check(app, sl_document_open(app->context, &app->document, &source));
    sl_shelf_forget_maps(app);
}

void sl_shelf_move(sl_app *app, int by) {
    const size_t count = sl_shelf_list(app)->count;
    sl_shelf *shelf = &app->shelf;
    if (by < 0)
        shelf->at -= shelf->at < (size_t)-by ? shelf->at : (size_t)-by;
    else if (count)
        shelf->at = shelf->at + (size_t)by < count ? shelf->at + (size_t)by : count - 1;
}

/// Settings that are kept between runs ($XDG_CONFIG_HOME/sightline/view.conf), the files at hand,
/// and how they are opened.
#include "files.h"

#include "sightline/import.h"
#include "sightline/support.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

// --- settings

enum { PATH = 4096 };

/// False without a home folder. Makes the folders if `make` is set.
static bool find_path(char path[PATH], bool make) {
    const char *config = getenv("XDG_CONFIG_HOME"), *home = getenv("HOME");
    char folder[PATH - 64];
    int length;
    if (config && config[0] == '/')
        length = snprintf(folder, sizeof folder, "%s", config);
    else if (home && home[0] == '/')
        length = snprintf(folder, sizeof folder, "%s/.config", home);
    else
        return false;
    if (length < 0 || (size_t)length >= sizeof folder) return false;
    if (make) mkdir(folder, 0700);
    snprintf(path, PATH, "%s/sightline", folder);
    if (make) mkdir(path, 0700);
    snprintf(path, PATH, "%s/sightline/view.conf", folder);
    return true;
}

/// A setting as a number within bounds.
typedef struct setting {
    const char *name;
    double low, high, value;
} setting;

enum {
    DARK,
    TEXT,
    SHOW,
    CONE,
    METHOD,
    WIDTH,
    HEIGHT,
    PANEL,
    FIRST_PERSON,
    ACCOUNT,
    EFFECTS,
    FILL,
    LEGEND,
    SIDE,
    BELOW,
    SETTINGS
};

static void describe(const app_state *app, setting list[SETTINGS]) {
    size_t count;
    sl_eye_methods(&count);
    const setting all[SETTINGS] = {
        [DARK] = {"dark", 0, 1, app->ui.dark},
        [TEXT] = {"text", 0.7, 3, app->ui.text_scale},
        [SHOW] = {"layers", 0, SHOW_ALL, app->view.show},
        [CONE] = {"cone", 1, 360, app->view.eye.fov},
        [METHOD] = {"method", 0, (double)count - 1, (double)app->view.method},
        [WIDTH] = {"width", 320, 8192, round(app->ui.window_width / app->ui.density)},
        [HEIGHT] = {"height", 240, 8192, round(app->ui.window_height / app->ui.density)},
        [PANEL] = {"panel", 0, 1, app->ui.side_panel},
        [FIRST_PERSON] = {"first_person", 0, 1, app->ui.first_person},
        [ACCOUNT] = {"account", 0, 1, app->ui.accounts},
        [EFFECTS] = {"effects", 0, 1, app->ui.effects},
        [FILL] = {"fill", 0, LAYER_COUNT, app->view.fill},
        [LEGEND] = {"legend", 0, 1, app->ui.legend},
        [SIDE] = {"side", 0, 200, app->ui.edges[EDGE_SIDE]},
        [BELOW] = {"below", 0, 1, app->ui.edges[EDGE_BELOW]},
    };
    memcpy(list, all, sizeof all);
}

void settings_load(app_state *app) {
    char path[PATH];
    sl_bytes bytes;
    if (!find_path(path, false) || sl_file_read(app->context, path, &bytes) != SL_OK) return;
    setting list[SETTINGS];
    describe(app, list);
    for (char *line = bytes.data, *next; line && *line; line = next) {
        next = strchr(line, '\n');
        if (next) *next++ = '\0';
        const size_t length = strcspn(line, " ");
        if (!line[length]) continue;
        const double value = strtod(line + length, NULL);
        for (int i = 0; i < SETTINGS; i++)
            if (strlen(list[i].name) == length && strncmp(list[i].name, line, length) == 0 &&
                value >= list[i].low && value <= list[i].high)
                list[i].value = value;
    }
    sl_free(app->context, bytes.data);
    app->ui.dark = list[DARK].value != 0;
    app->ui.text_scale = list[TEXT].value;
    app->view.show = (unsigned)list[SHOW].value;
    app->view.eye.fov = list[CONE].value;
    app->view.method = (size_t)list[METHOD].value;
    app->ui.width = (int)list[WIDTH].value;
    app->ui.height = (int)list[HEIGHT].value;
    app->ui.side_panel = list[PANEL].value != 0;
    app->ui.first_person = list[FIRST_PERSON].value != 0;
    app->ui.accounts = list[ACCOUNT].value != 0;
    app->ui.effects = list[EFFECTS].value != 0;
    app->view.fill = (unsigned)list[FILL].value;
    app->ui.legend = list[LEGEND].value != 0;
    app->ui.edges[EDGE_SIDE] = list[SIDE].value;
    app->ui.edges[EDGE_BELOW] = list[BELOW].value;
}

void settings_save(app_state *app) {
    char path[PATH];
    sl_output output;
    if (!find_path(path, true) || sl_output_open(app->context, path, &output) != SL_OK) return;
    setting list[SETTINGS];
    describe(app, list);
    for (int i = 0; i < SETTINGS; i++)
        fprintf(output.stream, "%s %.6g\n", list[i].name, list[i].value);
    sl_output_close(app->context, &output, SL_OK);
}

// --- maps at hand

enum { FILES_MOST = 200 };

/// Whether a file is a map, by its ending. Text files and pictures can be anything: they are listed
/// only in folders of maps.
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

static void add_folder(app_state *app, const char *folder, bool with_maps) {
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

void shelf_fill(app_state *app, const char *beside) {
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

void shelf_forget_maps(app_state *app) {
    sl_map_list_destroy(app->context, &app->shelf.maps);
    document_source_destroy(app->context, &app->shelf.source);
    app->shelf.at = app->shelf.first = 0;
}

void shelf_empty(app_state *app) {
    shelf_forget_maps(app);
    sl_map_list_destroy(app->context, &app->shelf.files);
}

// --- opening

static void keep_useful(sl_import_options *options, unsigned takes) {
    const sl_import_options usual = sl_import_options_default();
    if (!(takes & SL_TAKES_SLICE)) options->has_slice = false;
    if (!(takes & SL_TAKES_LAYERS)) options->layers = NULL;
    if (!(takes & SL_TAKES_STARTS)) options->start_names = NULL;
    if (!(takes & SL_TAKES_TOLERANCE)) options->tolerance = usual.tolerance;
    if (!(takes & SL_TAKES_UNIT)) options->unit = NULL;
    if (!(takes & SL_TAKES_THRESHOLD)) options->threshold = usual.threshold;
    if (!(takes & SL_TAKES_DOORS)) options->doors = false;
    if (!(takes & SL_TAKES_CELLS)) options->cells = false;
}

/// Reads what kind of file it is, and which choices it offers.
static sl_status look(sl_context *context, document_source *source, sl_map_choice *choice) {
    if (document_is_baked(source->path)) return SL_OK;
    SL_TRY(sl_map_choice_read(context, source->path, choice));
    source->takes = choice->format->takes;
    source->lowest = choice->lowest;
    source->highest = choice->highest;
    return SL_OK;
}

static sl_status open_source(app_state *app, document_source source, bool ask, bool all_meant) {
    sl_context *context = app->context;
    sl_map_choice choice = {0};
    shelf_forget_maps(app);
    SL_TRY(look(context, &source, &choice));
    if (!all_meant) keep_useful(&source.options, source.takes);
    if (source.highest > source.lowest && !source.options.has_slice) {
        source.options.has_slice = true;
        source.options.slice = source.lowest + (source.highest - source.lowest) / 2;
    }
    sl_status status = SL_OK;
    if (ask && choice.maps.count > 1 && !source.options.map) {
        status = document_source_copy(context, &source, &app->shelf.source);
        app->shelf.maps = choice.maps;
        choice.maps = (sl_map_list){0};
        app->ui.maps_open = true;
    } else {
        status = document_open(context, &app->document, &source);
    }
    sl_map_choice_destroy(context, &choice);
    return status;
}

sl_status shelf_open_source(app_state *app, const document_source *source, bool ask) {
    return open_source(app, *source, ask, true);
}

void shelf_open(app_state *app, const char *path) {
    const document_source source = {.path = (char *)(uintptr_t)path, .options = app->options};
    app->ui.maps_open = false;
    app_check(app, open_source(app, source, true, false));
}

void shelf_open_again(app_state *app, const sl_import_options *options) {
    document_source source = app->document.source;
    if (!source.path) return;
    source.options = *options;
    source.again = true;
    history_clear(app->context, &app->document.history);
    app_check(app, document_open(app->context, &app->document, &source));
}

const sl_map_list *shelf_list(const map_shelf *shelf) {
    return shelf->source.path ? &shelf->maps : &shelf->files;
}

void shelf_choose(app_state *app, size_t row) {
    const sl_map_list *list = shelf_list(&app->shelf);
    if (row >= list->count) return;
    if (list == &app->shelf.files) {
        shelf_open(app, list->names[row]);
        return;
    }
    document_source source = app->shelf.source;
    source.options.map = list->names[row];
    app->ui.maps_open = false;
    app_check(app, document_open(app->context, &app->document, &source));
    shelf_forget_maps(app);
}

void shelf_move(app_state *app, int by) {
    const size_t count = shelf_list(&app->shelf)->count;
    map_shelf *shelf = &app->shelf;
    if (by < 0)
        shelf->at -= shelf->at < (size_t)-by ? shelf->at : (size_t)-by;
    else if (count)
        shelf->at = shelf->at + (size_t)by < count ? shelf->at + (size_t)by : count - 1;
}

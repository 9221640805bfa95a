/// What is kept between runs in $XDG_CONFIG_HOME/sightline: settings (view.conf) and the files
/// opened last (recent); and how a file is opened.
#include "document/files.h"

#include "dialogs/import_dialog.h"
#include "dialogs/question.h"
#include "document/map_file.h"
#include "sightline/import.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

// --- settings

bool files_folder(const char *variable, const char *beside_home, char path[PATH_TEXT], bool make) {
    const char *given = getenv(variable), *home = getenv("HOME");
    char folder[PATH_TEXT - 64];
    int length;
    if (given && given[0] == '/')
        length = snprintf(folder, sizeof folder, "%s", given);
    else if (home && home[0] == '/')
        length = snprintf(folder, sizeof folder, "%s/%s", home, beside_home);
    else
        return false;
    if (length < 0 || (size_t)length >= sizeof folder) return false;
    // Folders on the way are made too: a fresh account has no ~/.local.
    for (char *at = folder + 1; make && (at = strchr(at, '/')) != NULL; at++) {
        *at = '\0';
        mkdir(folder, 0700);
        *at = '/';
    }
    if (make) mkdir(folder, 0700);
    snprintf(path, PATH_TEXT, "%s/sightline", folder);
    if (make) mkdir(path, 0700);
    return true;
}

/// False without a home folder. Makes the folders if `make` is set.
static bool find_path(const char *name, char path[PATH_TEXT], bool make) {
    if (!files_folder("XDG_CONFIG_HOME", ".config", path, make)) return false;
    const size_t length = strlen(path);
    snprintf(path + length, PATH_TEXT - length, "/%s", name);
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
        [SHOW] = {"shown", 0, SHOW_ALL, app->view.show},
        [CONE] = {"cone", 1, 360, app->view.eye.fov},
        [METHOD] = {"method", 0, (double)count - 1, (double)app->view.method},
        [WIDTH] = {"width", 320, 8192, round(app->ui.window_width / app->ui.density)},
        [HEIGHT] = {"height", 240, 8192, round(app->ui.window_height / app->ui.density)},
        [PANEL] = {"panel", 0, 1, app->ui.side_panel},
        [FIRST_PERSON] = {"first_person", 0, 1, app->ui.first_person},
        [ACCOUNT] = {"account", 0, 1, app->ui.accounts},
        [EFFECTS] = {"effects", 0, 1, app->ui.effects},
        [FILL] = {"filled", 0, LAYER_COUNT, layers_fill(&app->view)},
        [LEGEND] = {"legend", 0, 1, app->ui.legend},
        [SIDE] = {"side", 0, 200, app->ui.edges[EDGE_SIDE]},
        [BELOW] = {"below", 0, 1, app->ui.edges[EDGE_BELOW]},
    };
    memcpy(list, all, sizeof all);
}

void settings_load(app_state *app) {
    char path[PATH_TEXT];
    sl_bytes bytes;
    if (!find_path("view.conf", path, false) || sl_file_read(app->context, path, &bytes) != SL_OK)
        return;
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
    layers_set_fill(&app->view, (unsigned)list[FILL].value);
    app->ui.legend = list[LEGEND].value != 0;
    app->ui.edges[EDGE_SIDE] = list[SIDE].value;
    app->ui.edges[EDGE_BELOW] = list[BELOW].value;
}

void settings_save(app_state *app) {
    char path[PATH_TEXT];
    sl_output output;
    if (!find_path("view.conf", path, true) || sl_output_open(app->context, path, &output) != SL_OK)
        return;
    setting list[SETTINGS];
    describe(app, list);
    for (int i = 0; i < SETTINGS; i++)
        fprintf(output.stream, "%s %.6g\n", list[i].name, list[i].value);
    sl_output_close(app->context, &output, SL_OK);
}

// --- recent files

enum { RECENT_MOST = 12 };

sl_status recent_list(sl_context *context, sl_map_list *list) {
    char path[PATH_TEXT];
    sl_bytes bytes;
    if (!find_path("recent", path, false) || sl_file_read(context, path, &bytes) != SL_OK)
        return SL_OK;
    sl_status status = SL_OK;
    for (char *line = bytes.data, *next; line && *line && status == SL_OK; line = next) {
        next = strchr(line, '\n');
        if (next) *next++ = '\0';
        if (*line == '/' && list->count < RECENT_MOST)
            status = sl_map_list_add(context, list, line, strlen(line));
    }
    sl_free(context, bytes.data);
    return status;
}

void recent_add(app_state *app, const char *name) {
    char path[PATH_TEXT];
    char *full = realpath(name, NULL);
    sl_map_list before = {0};
    sl_output output;
    if (!app->ui.steady && !app->file.locked && full && !strchr(full, '\n') &&
        find_path("recent", path, true) && recent_list(app->context, &before) == SL_OK &&
        sl_output_open(app->context, path, &output) == SL_OK) {
        fprintf(output.stream, "%s\n", full);
        size_t kept = 1;
        for (size_t i = 0; i < before.count && kept < RECENT_MOST; i++) {
            if (strcmp(before.names[i], full) == 0) continue;
            fprintf(output.stream, "%s\n", before.names[i]);
            kept++;
        }
        sl_output_close(app->context, &output, SL_OK);
    }
    sl_map_list_destroy(app->context, &before);
    free(full);
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

sl_status files_look(sl_context *context, document_source *source, sl_map_choice *choice) {
    if (document_is_baked(source->path)) return SL_OK;
    SL_TRY(sl_map_choice_read(context, source->path, choice));
    source->takes = choice->format->takes;
    source->lowest = choice->lowest;
    source->highest = choice->highest;
    if (source->highest > source->lowest && !source->options.has_slice) {
        source->options.has_slice = true;
        source->options.slice = source->lowest + (source->highest - source->lowest) / 2;
    }
    return SL_OK;
}

/// Whether the file has to be asked about.
static bool is_open_question(const document_source *source, const sl_map_choice *choice) {
    return (choice->maps.count > 1 && !source->options.map) ||
           (choice->layers_unsaid && !source->options.layers);
}

void files_open(app_state *app, const char *path, bool ask) {
    document_source source = {.path = (char *)(uintptr_t)path, .options = app->options};
    sl_map_choice choice = {0};
    sl_status status = files_look(app->context, &source, &choice);
    if (choice.format) keep_useful(&source.options, source.takes);
    if (status == SL_OK && choice.format && (ask || is_open_question(&source, &choice)))
        status = import_open(app, &source, &choice, ask);
    else if (status == SL_OK)
        map_file_start(app, &source);
    files_check(app, path, status);
    sl_map_choice_destroy(app->context, &choice);
}

void files_drop(app_state *app, const char *path) {
    if (dialog_clear(app))
        files_open(app, path, false);
    else
        ui_say(&app->ui, true, "answer the question first, then drop the file again");
}

sl_status files_open_source(app_state *app, const document_source *given, bool ask) {
    document_source source = *given;
    sl_map_choice choice = {0};
    SL_TRY(files_look(app->context, &source, &choice));
    sl_status status;
    if (ask && choice.format && is_open_question(&source, &choice))
        status = import_open(app, &source, &choice, false);
    else
        status = document_open(app->context, &app->document, &source);
    sl_map_choice_destroy(app->context, &choice);
    return status;
}

void files_open_again(app_state *app, const sl_import_options *options) {
    document_source source = app->document.source;
    if (!source.path) return;
    source.options = *options;
    source.again = true;
    map_file_start(app, &source);
}

/// Another try with other options.
static void take_answer(app_state *app, int answer) {
    document_source source = app->file.tried;
    sl_map_choice choice = {0};
    if (answer != 0) return;
    sl_status status = files_look(app->context, &source, &choice);
    if (status == SL_OK) status = import_open(app, &source, &choice, true);
    files_check(app, source.path, status);
    sl_map_choice_destroy(app->context, &choice);
}

void files_check(app_state *app, const char *path, sl_status status) {
    static const char *const answers[] = {"O:Options...", "C:Close"};
    if (status == SL_OK || status == SL_CANCELLED) return;
    // Options help where the file can be read at all.
    const char *tried = app->file.tried.path;
    const bool again =
        tried && strcmp(tried, path) == 0 && app->file.tried.takes & ~(unsigned)SL_TAKES_CELLS;
    char text[1200];
    const char *slash = strrchr(path, '/');
    snprintf(text, sizeof text, "%s", sl_context_message(app->context));
    ui_say(&app->ui, true, "%s was not opened", slash ? slash + 1 : path);
    if (!again) {
        question_tell(app, "The file was not opened", text);
        return;
    }
    question_ask(app, "The file was not opened", text, answers, 2, take_answer);
    app->dialog.focus[app->dialog.depth - 1] = DIALOG_OWN + 1;
}

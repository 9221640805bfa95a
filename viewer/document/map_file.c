/// The file of the map that is open.
///
/// The history of changes numbers each state of the map. The map is unsaved where its state is not
/// the one that the file has, so undoing all changes makes it saved again. Saving works on a copy
/// of the map, in a thread: the map may change meanwhile.
#include "document/map_file.h"

#include "app/app.h"
#include "dialogs/browser.h"
#include "dialogs/question.h"
#include "document/files.h"
#include "document/recovery.h"
#include "sightline/support.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

// --- names

static bool ends_in(const char *path, const char *ending) {
    const size_t length = strlen(path), more = strlen(ending);
    return length > more && strcasecmp(path + length - more, ending) == 0;
}

static bool is_savable(const char *path) {
    return ends_in(path, ".map") || ends_in(path, ".slv");
}

static const char *base_of(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

void map_file_name(const app_state *app, char text[TITLE_TEXT]) {
    const document_source *source = &app->document.source;
    const char *path = app->file.path ? app->file.path : app->file.of ? app->file.of : source->path;
    const char *map = app->file.path ? NULL : source->options.map;
    snprintf(text, TITLE_TEXT, "%.200s%s%.100s", path ? base_of(path) : "Untitled", map ? " " : "",
             map ? map : "");
}

void map_file_title(const app_state *app, char text[TITLE_TEXT]) {
    char name[TITLE_TEXT];
    if (!app->document.baked) {
        snprintf(text, TITLE_TEXT, "Sightline");
        return;
    }
    map_file_name(app, name);
    snprintf(text, TITLE_TEXT, "%s%.300s - Sightline", map_file_changed(app) ? "*" : "", name);
}

bool map_file_changed(const app_state *app) {
    return app->document.baked && app->document.history.state != app->file.saved;
}

static sl_status set_text(app_state *app, char **to, const char *text) {
    char *copy = text ? sl_copy_text(app->context, text, strlen(text)) : NULL;
    if (text && !copy) return SL_NO_MEMORY;
    sl_free(app->context, *to);
    *to = copy;
    return SL_OK;
}

// --- what loses changes

/// The frame of a new map: 40 by 30, with a start in its middle.
static sl_status make_new(sl_context *context, sl_map *map) {
    const sl_point corners[5] = {{0, 0}, {40, 0}, {40, 30}, {0, 30}, {0, 0}};
    sl_status status = SL_OK;
    for (int i = 0; i < 4 && status == SL_OK; i++)
        status = sl_map_add_wall(context, map, corners[i], corners[i + 1], 0);
    if (status == SL_OK) status = sl_map_add_start(context, map, (sl_point){20, 15}, 0, 0);
    if (status != SL_OK) sl_map_destroy(context, map);
    return status;
}

static void begin_new(app_state *app) {
    sl_map map = {0};
    sl_status status = make_new(app->context, &map);
    if (status == SL_OK) status = document_begin(app->context, &app->document, &map);
    view_check(&app->view, status);
}

static void begin_open(app_state *app, document_source *source) {
    document_source_destroy(app->context, &app->file.tried);
    view_check(&app->view, document_source_copy(app->context, source, &app->file.tried));
    const sl_status status = document_open(app->context, &app->document, source);
    if (status == SL_OK) {
        if (source->again) history_clear(app->context, &app->document.history);
        if (source->again) app->file.saved = app->document.history.state;
        ui_say_working(&app->ui, "reading %s", base_of(source->path));
    }
    files_check(app, source->path, status);
}

/// Does what has waited.
static void go_on(app_state *app) {
    const pending_kind pending = app->file.pending;
    document_source source = app->file.source;
    app->file.pending = PENDING_NONE;
    app->file.source = (document_source){0};
    if (pending == PENDING_QUIT) app->quit = true;
    if (pending == PENDING_NEW) begin_new(app);
    if (pending == PENDING_OPEN) begin_open(app, &source);
    document_source_destroy(app->context, &source);
}

static void take_answer(app_state *app, int answer) {
    if (answer == 0)
        map_file_save(app);
    else if (answer == 1)
        go_on(app);
    else
        app->file.pending = PENDING_NONE;
}

static void ask(app_state *app) {
    static const char *const answers[] = {"S:Save", "D:Don't save", "C:Cancel"};
    char name[TITLE_TEXT], text[TITLE_TEXT + 64];
    map_file_name(app, name);
    snprintf(text, sizeof text, "%s has changes that are not saved.", name);
    question_ask(app, "Save the changes?", text, answers, 3, take_answer);
}

static void start_pending(app_state *app, pending_kind kind) {
    const bool asked = app->file.pending != PENDING_NONE;
    app->file.pending = kind;
    if (map_file_progress(app).running) return; // it goes on once the file is there
    if (!map_file_changed(app))
        go_on(app);
    else if (!asked || dialog_open_now(app) == DIALOG_NONE)
        ask(app);
}

void map_file_new(app_state *app) {
    start_pending(app, PENDING_NEW);
}

void map_file_quit(app_state *app) {
    start_pending(app, PENDING_QUIT);
}

void map_file_start(app_state *app, const document_source *source) {
    document_source copy;
    const sl_status status = document_source_copy(app->context, source, &copy);
    view_check(&app->view, status);
    if (status != SL_OK) return;
    document_source_destroy(app->context, &app->file.source);
    app->file.source = copy;
    start_pending(app, PENDING_OPEN);
}

void map_file_give_up(app_state *app) {
    app->file.saved = app->document.history.state;
}

// --- saving

struct save_job {
    sl_map map;
    char *path;
    char *from;   ///< a baked file that has not changed: it is copied; NULL: none
    bool recover; ///< a copy of unsaved changes
    double weld;  ///< negative: the usual
    bool welds;   ///< the map is welded otherwise than its text says: its walls are saved welded
    uint32_t mirror_depth;
    uint64_t state;
};

static sl_status copy_file(sl_context *context, const save_job *job) {
    sl_bytes bytes;
    sl_output output;
    SL_TRY(sl_file_read(context, job->from, &bytes));
    sl_status status = sl_output_open(context, job->path, &output);
    if (status == SL_OK) {
        const bool whole = fwrite(bytes.data, 1, bytes.size, output.stream) == bytes.size;
        if (!whole) status = sl_fail(context, SL_IO, "%s: not written", job->path);
        status = sl_output_close(context, &output, status);
    }
    sl_free(context, bytes.data);
    return status;
}

static sl_status write_baked(sl_context *context, save_job *job) {
    sl_bake_options options = sl_bake_options_default();
    sl_baked baked = {0};
    options.mirror_depth = job->mirror_depth;
    options.clean.weld = job->weld;
    SL_TRY(sl_bake(context, &job->map, &options, &baked, NULL));
    const sl_status status = sl_baked_write(context, &baked, job->path);
    sl_baked_destroy(context, &baked);
    return status;
}

static sl_status write_file(sl_context *context, void *data) {
    save_job *job = data;
    if (job->from) return copy_file(context, job);
    if (!job->recover && ends_in(job->path, ".slv")) return write_baked(context, job);
    const sl_clean_options clean = {.weld = job->weld};
    if (job->welds) SL_TRY(sl_map_clean(context, &job->map, &clean, NULL));
    SL_TRY(sl_map_settle_ground(context, &job->map));
    return sl_map_write(context, &job->map, NULL, job->path);
}

static void free_job(app_state *app, save_job *job) {
    if (!job) return;
    sl_map_destroy(app->context, &job->map);
    sl_free(app->context, job->path);
    sl_free(app->context, job->from);
    sl_free(app->context, job);
}

static sl_status fill_job(app_state *app, save_job *job, const char *path, bool recover) {
    const document_state *document = &app->document;
    const document_source *source = &document->source;
    job->recover = recover;
    job->weld = source->has_weld ? source->weld : sl_clean_options_default().weld;
    job->welds = source->has_weld || document->map.precision > 0;
    job->mirror_depth = document->mirror_depth;
    job->state = document->history.state;
    SL_TRY(set_text(app, &job->path, path));
    if (ends_in(path, ".slv") && !map_file_changed(app) && source->path &&
        document_is_baked(source->path))
        return set_text(app, &job->from, source->path);
    return sl_map_copy(app->context, &document->map, &job->map);
}

static sl_status start_job(app_state *app, const char *path, bool recover) {
    if (app->file.locked)
        return sl_fail(app->context, SL_IO, "%s: nothing is written while events are random", path);
    save_job *job = sl_alloc_array(app->context, 1, sizeof *job);
    if (!job) return SL_NO_MEMORY;
    sl_status status = fill_job(app, job, path, recover);
    if (status == SL_OK)
        status = task_start(app->context, write_file, job, NULL, NULL, &app->file.task);
    if (status == SL_OK)
        app->file.job = job;
    else
        free_job(app, job);
    return status;
}

/// The path that was typed is not lost.
static void try_again(app_state *app, int answer) {
    if (answer == 0 && app->file.failed) browser_save_to(app, app->file.failed);
}

static void fail_save(app_state *app, const char *path) {
    static const char *const answers[] = {"A:Another path", "C:Close"};
    char text[1200];
    snprintf(text, sizeof text, "%s", sl_context_message(app->context));
    app->file.pending = PENDING_NONE;
    ui_say(&app->ui, true, "%s was not saved", base_of(path));
    view_check(&app->view, set_text(app, &app->file.failed, path));
    question_ask(app, "The map was not saved", text, answers, 2, try_again);
}

static void take_saved(app_state *app, const save_job *job) {
    const sl_status status = set_text(app, &app->file.path, job->path);
    if (status != SL_OK) {
        view_check(&app->view, status);
        return;
    }
    app->file.saved = job->state;
    recent_add(app, job->path);
    recovery_forget(app);
    ui_say(&app->ui, false, "saved %s%s", job->path,
           job->welds && !ends_in(job->path, ".slv") ? "; its walls are welded, as shown" : "");
    if (app->file.pending == PENDING_NONE) return;
    const pending_kind pending = app->file.pending;
    app->file.pending = PENDING_NONE;
    start_pending(app, pending);
}

static void end_job(app_state *app) {
    save_job *job = app->file.job;
    const sl_status status = task_end(app->context, app->file.task);
    app->file.task = NULL;
    app->file.job = NULL;
    if (job->recover)
        recovery_take(app, status, job->state);
    else if (status == SL_OK)
        take_saved(app, job);
    else if (status == SL_CANCELLED)
        app->file.pending = PENDING_NONE;
    else
        fail_save(app, job->path);
    free_job(app, job);
}

void map_file_tick(app_state *app, bool wait) {
    // What is saved may start something that is saved too.
    for (int i = 0; i < 4 && app->file.task && (wait || task_done(app->file.task)); i++)
        end_job(app);
}

job_progress map_file_progress(const app_state *app) {
    const bool shown = app->file.task && !app->file.job->recover;
    return shown ? task_progress(app->file.task) : (job_progress){0};
}

bool map_file_stop(app_state *app) {
    if (!map_file_progress(app).running) return false;
    task_cancel(app->file.task);
    return true;
}

void map_file_save_to(app_state *app, const char *path) {
    char name[PATH_TEXT];
    const char *base = base_of(path);
    snprintf(name, sizeof name, "%s%s", path, strchr(base, '.') ? "" : ".map");
    if (app->file.task) end_job(app); // one at a time
    sl_status status = SL_OK;
    if (!is_savable(name))
        status = sl_fail(app->context, SL_BAD_ARGUMENT,
                         "%s: a map is saved as map text (.map) or baked (.slv)", name);
    if (status == SL_OK) status = start_job(app, name, false);
    if (status != SL_OK)
        fail_save(app, name);
    else
        ui_say_working(&app->ui, "saving %s", base_of(name));
}

void map_file_save(app_state *app) {
    if (!app->document.baked) return;
    if (app->file.path)
        map_file_save_to(app, app->file.path);
    else
        browser_save(app);
}

void map_file_save_as(app_state *app) {
    if (app->document.baked) browser_save(app);
}

void map_file_copy_to(app_state *app, const char *path) {
    if (app->file.task) return;
    const sl_status status = start_job(app, path, true);
    if (status != SL_OK) recovery_take(app, status, app->document.history.state);
}

// --- what is open

void map_file_recover(app_state *app, sl_map *map, const char *of) {
    app->file.recovered = true;
    sl_status status = set_text(app, &app->file.of, of);
    if (status == SL_OK) status = document_begin(app->context, &app->document, map);
    if (status != SL_OK) app->file.recovered = false;
    view_check(&app->view, status);
}

void map_file_taken(app_state *app) {
    file_state *file = &app->file;
    const char *path = file->recovered ? file->of : app->document.source.path;
    view_check(&app->view, set_text(app, &file->path, path && is_savable(path) ? path : NULL));
    if (!file->recovered) {
        recovery_forget(app);
        view_check(&app->view, set_text(app, &file->of, NULL));
    }
    file->saved = file->recovered ? UINT64_MAX : app->document.history.state;
    file->recovered = false;
    if (app->document.source.path) recent_add(app, app->document.source.path);
}

void map_file_destroy(app_state *app) {
    file_state *file = &app->file;
    if (file->task) {
        task_drop(app->context, file->task);
        free_job(app, file->job);
        file->task = NULL;
    }
    // A session that fails leaves its copy.
    if (app->quit || !map_file_changed(app)) recovery_forget(app);
    sl_free(app->context, file->copy);
    sl_free(app->context, file->offer);
    document_source_destroy(app->context, &file->source);
    document_source_destroy(app->context, &file->tried);
    sl_free(app->context, file->path);
    sl_free(app->context, file->of);
    sl_free(app->context, file->failed);
    file->path = file->of = file->failed = NULL;
}

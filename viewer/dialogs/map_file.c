/// The file of the map that is open.
///
/// The history of changes numbers each state of the map. The map is unsaved where its state is not
/// the one that the file has, so undoing all changes makes it saved again.
#include "dialogs/map_file.h"

#include "dialogs/browser.h"
#include "dialogs/import_dialog.h"
#include "dialogs/question.h"
#include "document/drawings.h"
#include "document/files.h"
#include "sightline/support.h"

#include <stdio.h>
#include <string.h>

// --- names

void map_file_name(const desk_state *desk, char text[TITLE_TEXT]) {
    const document_source *source = &desk->document->source;
    const char *path = desk->file.path ? desk->file.path
                       : desk->file.of ? desk->file.of
                                       : source->path;
    const char *map = desk->file.path ? NULL : source->options.map;
    snprintf(text, TITLE_TEXT, "%.200s%s%.100s", path ? files_base(path) : "Untitled",
             map ? " " : "", map ? map : "");
}

void map_file_title(const desk_state *desk, char text[TITLE_TEXT]) {
    char name[TITLE_TEXT];
    if (!desk->document->baked) {
        snprintf(text, TITLE_TEXT, "Sightline");
        return;
    }
    map_file_name(desk, name);
    snprintf(text, TITLE_TEXT, "%s%.300s - Sightline", map_file_changed(desk) ? "*" : "", name);
}

bool map_file_changed(const desk_state *desk) {
    return desk->document->baked && desk->document->history.state != desk->file.saved;
}

// --- what is not opened

/// Another try with other options.
static void take_options(desk_state *desk, int answer) {
    document_source source = desk->file.tried;
    sl_map_choice choice = {0};
    if (answer != 0) return;
    sl_status status = files_look(desk->context, &source, &choice);
    if (status == SL_OK) status = import_open(desk, &source, &choice, true, map_file_start);
    map_file_check(desk, source.path, status);
    sl_map_choice_destroy(desk->context, &choice);
}

void map_file_check(desk_state *desk, const char *path, sl_status status) {
    static const char *const answers[] = {"O:Options...", "C:Close"};
    if (status == SL_OK || status == SL_CANCELLED) return;
    if (import_take_failure(desk, sl_context_message(desk->context))) return;
    // What was chosen for a drawing is kept as it could be read.
    const char *open = desk->document->source.path;
    if (!desk->ui->steady && open && strcmp(open, path) == 0 && drawing_is(path))
        drawing_remember(desk->context, &desk->document->source);
    // Options help where the file can be read at all.
    const char *tried = desk->file.tried.path;
    const bool again =
        tried && strcmp(tried, path) == 0 && desk->file.tried.takes & ~(unsigned)SL_TAKES_CELLS;
    char text[1200];
    snprintf(text, sizeof text, "%s", sl_context_message(desk->context));
    ui_say(desk->ui, true, "%s was not opened", files_base(path));
    if (!again) {
        question_tell(desk, "The file was not opened", text);
        return;
    }
    question_ask(desk, "The file was not opened", text, answers, 2, take_options);
    desk->dialog.focus[desk->dialog.depth - 1] = DIALOG_OWN + 1;
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

static void start_new(desk_state *desk) {
    sl_map map = {0};
    sl_status status = make_new(desk->context, &map);
    if (status == SL_OK) status = document_begin(desk->context, desk->document, &map);
    ui_report(desk->ui, desk->context, status);
}

static void start_open(desk_state *desk, document_source *source) {
    document_source_destroy(desk->context, &desk->file.tried);
    ui_report(desk->ui, desk->context,
              document_source_copy(desk->context, source, &desk->file.tried));
    const sl_status status = document_open(desk->context, desk->document, source);
    if (status == SL_OK) {
        if (source->again) history_clear(desk->context, &desk->document->history);
        if (source->again) desk->file.saved = desk->document->history.state;
        ui_say_working(desk->ui, "reading %s", files_base(source->path));
    }
    map_file_check(desk, source->path, status);
}

/// Does what has waited.
static void do_pending(desk_state *desk) {
    const pending_kind pending = desk->file.pending;
    document_source source = desk->file.source;
    desk->file.pending = PENDING_NONE;
    desk->file.source = (document_source){0};
    if (pending == PENDING_QUIT) desk->quit = true;
    if (pending == PENDING_NEW) start_new(desk);
    if (pending == PENDING_OPEN) start_open(desk, &source);
    document_source_destroy(desk->context, &source);
}

static void take_export(desk_state *desk, int answer) {
    if (answer == 0)
        desk->dialog.chosen = "camera_export";
    else if (answer == 1)
        do_pending(desk);
    else
        desk->file.pending = PENDING_NONE;
}

/// Asks first where cameras would be lost. With other options for the same file it does not.
static void go_on(desk_state *desk) {
    static const char *const answers[] = {"E:Export", "D:Don't export", "C:Cancel"};
    const size_t count = desk->file.cameras;
    const bool again = desk->file.pending == PENDING_OPEN && desk->file.source.again;
    char text[96];
    if (!count || again) {
        do_pending(desk);
        return;
    }
    snprintf(text, sizeof text, "%zu camera%s not exported.", count, count == 1 ? " is" : "s are");
    question_ask(desk, "Export the cameras?", text, answers, 3, take_export);
}

static void take_answer(desk_state *desk, int answer) {
    if (answer == 0)
        map_file_save(desk);
    else if (answer == 1)
        go_on(desk);
    else
        desk->file.pending = PENDING_NONE;
}

static void ask_to_save(desk_state *desk) {
    static const char *const answers[] = {"S:Save", "D:Don't save", "C:Cancel"};
    char name[TITLE_TEXT], text[TITLE_TEXT + 64];
    map_file_name(desk, name);
    snprintf(text, sizeof text, "%s has changes that are not saved.", name);
    question_ask(desk, "Save the changes?", text, answers, 3, take_answer);
}

static void start_pending(desk_state *desk, pending_kind kind) {
    const bool asked = desk->file.pending != PENDING_NONE;
    desk->file.pending = kind;
    if (map_file_progress(desk).running) return; // it goes on once the file is there
    if (asked && dialog_open_now(&desk->dialog) != DIALOG_NONE) return;
    if (map_file_changed(desk))
        ask_to_save(desk);
    else
        go_on(desk);
}

void map_file_exported(desk_state *desk, bool done) {
    if (done && desk->file.pending != PENDING_NONE)
        do_pending(desk);
    else
        desk->file.pending = PENDING_NONE;
}

void map_file_new(desk_state *desk) {
    start_pending(desk, PENDING_NEW);
}

void map_file_quit(desk_state *desk) {
    start_pending(desk, PENDING_QUIT);
}

void map_file_start(desk_state *desk, const document_source *source) {
    document_source copy;
    const sl_status status = document_source_copy(desk->context, source, &copy);
    ui_report(desk->ui, desk->context, status);
    if (status != SL_OK) return;
    document_source_destroy(desk->context, &desk->file.source);
    desk->file.source = copy;
    start_pending(desk, PENDING_OPEN);
}

void map_file_give_up(desk_state *desk) {
    desk->file.saved = desk->document->history.state;
    desk->file.cameras = 0;
}

// --- saving

static sl_status start_job(desk_state *desk, const char *path, bool recover) {
    if (desk->file.locked)
        return sl_fail(desk->context, SL_IO, "%s: nothing is written while events are random",
                       path);
    return save_start(desk->context, desk->document, path, !map_file_changed(desk), recover,
                      &desk->file.job);
}

static void save_to(desk_state *desk, const char *path);

/// The path that was typed is not lost.
static void try_again(desk_state *desk, int answer) {
    if (answer == 0 && desk->file.failed) browser_save_to(desk, desk->file.failed, save_to);
}

static void fail_save(desk_state *desk, const char *path) {
    static const char *const answers[] = {"A:Another path", "C:Close"};
    char text[1200];
    snprintf(text, sizeof text, "%s", sl_context_message(desk->context));
    desk->file.pending = PENDING_NONE;
    ui_say(desk->ui, true, "%s was not saved", files_base(path));
    ui_report(desk->ui, desk->context, files_set_text(desk->context, &desk->file.failed, path));
    question_ask(desk, "The map was not saved", text, answers, 2, try_again);
}

static void note_recent(desk_state *desk, const char *path) {
    if (!desk->ui->steady && !desk->file.locked) recent_add(desk->context, path);
}

static void take_saved(desk_state *desk, const save_job *job) {
    const sl_status status = files_set_text(desk->context, &desk->file.path, job->path);
    if (status != SL_OK) {
        ui_report(desk->ui, desk->context, status);
        return;
    }
    desk->file.saved = job->state;
    note_recent(desk, job->path);
    session_remove(desk->context, &desk->file.copy);
    ui_say(desk->ui, false, "saved %s%s", job->path,
           job->welds && !files_end_in(job->path, ".slv") ? "; its walls are welded, as shown"
                                                          : "");
    if (desk->file.pending == PENDING_NONE) return;
    const pending_kind pending = desk->file.pending;
    desk->file.pending = PENDING_NONE;
    start_pending(desk, pending);
}

/// A copy was written, or not.
static void take_copied(desk_state *desk, sl_status status, uint64_t state) {
    if (status == SL_CANCELLED) return;
    desk->file.copy_state = state;
    if (status == SL_OK) return;
    desk->file.copies = false;
    ui_say(desk->ui, true, "changes are not kept for a crash: %s",
           sl_context_message(desk->context));
}

static void end_job(desk_state *desk) {
    save_job *job = desk->file.job;
    const sl_status status = save_end(desk->context, job);
    desk->file.job = NULL;
    if (job->recover)
        take_copied(desk, status, job->state);
    else if (status == SL_OK)
        take_saved(desk, job);
    else if (status == SL_CANCELLED)
        desk->file.pending = PENDING_NONE;
    else
        fail_save(desk, job->path);
    save_free(desk->context, job);
}

void map_file_tick(desk_state *desk, bool wait) {
    // What is saved may start something that is saved too.
    for (int i = 0; i < 4 && desk->file.job && (wait || task_done(desk->file.job->task)); i++)
        end_job(desk);
}

job_progress map_file_progress(const desk_state *desk) {
    const bool shown = desk->file.job && !desk->file.job->recover;
    return shown ? task_progress(desk->file.job->task) : (job_progress){0};
}

bool map_file_stop(desk_state *desk) {
    if (!map_file_progress(desk).running) return false;
    task_cancel(desk->file.job->task);
    return true;
}

/// Saves under a name, which becomes the map's. Without an ending it gets ".map". A failure gets a
/// dialog.
static void save_to(desk_state *desk, const char *path) {
    char name[PATH_TEXT];
    const char *base = files_base(path);
    snprintf(name, sizeof name, "%s%s", path, strchr(base, '.') ? "" : ".map");
    if (desk->file.job) end_job(desk); // one at a time
    sl_status status = SL_OK;
    if (!files_savable(name))
        status = sl_fail(desk->context, SL_BAD_ARGUMENT,
                         "%s: a map is saved as map text (.map) or baked (.slv)", name);
    if (status == SL_OK) status = start_job(desk, name, false);
    if (status != SL_OK)
        fail_save(desk, name);
    else
        ui_say_working(desk->ui, "saving %s", files_base(name));
}

void map_file_save(desk_state *desk) {
    if (desk->document->baked && desk->file.path)
        save_to(desk, desk->file.path);
    else
        map_file_save_as(desk);
}

void map_file_name_output(const desk_state *desk, const char *ending, char text[TITLE_TEXT]) {
    const char *map = desk->file.path ? NULL : desk->document->source.options.map;
    char name[TITLE_TEXT];
    map_file_name(desk, name);
    if (map) snprintf(name, sizeof name, "%.200s", map);
    char *dot = strrchr(name, '.');
    if (dot) *dot = '\0';
    for (char *at = name; *at; at++)
        if (*at == '/' || *at == ' ') *at = '-';
    snprintf(text, TITLE_TEXT, "%.300s%s", name, ending);
}

void map_file_save_as(desk_state *desk) {
    char name[TITLE_TEXT];
    const bool baked = desk->file.path && document_is_baked(desk->file.path);
    if (!desk->document->baked) return;
    map_file_name_output(desk, baked ? ".slv" : ".map", name);
    browser_save(desk, BROWSE_MAPS, name, save_to);
}

void map_file_copy_to(desk_state *desk, const char *path) {
    if (desk->file.job) return;
    const sl_status status = start_job(desk, path, true);
    if (status != SL_OK) take_copied(desk, status, desk->document->history.state);
}

// --- what is open

void map_file_recover(desk_state *desk, sl_map *map, const char *of) {
    desk->file.recovered = true;
    sl_status status = files_set_text(desk->context, &desk->file.of, of);
    if (status == SL_OK) status = document_begin(desk->context, desk->document, map);
    if (status != SL_OK) desk->file.recovered = false;
    ui_report(desk->ui, desk->context, status);
}

void map_file_taken(desk_state *desk) {
    file_state *file = &desk->file;
    const char *path = file->recovered ? file->of : desk->document->source.path;
    ui_report(
        desk->ui, desk->context,
        files_set_text(desk->context, &file->path, path && files_savable(path) ? path : NULL));
    if (!file->recovered) {
        session_remove(desk->context, &desk->file.copy);
        ui_report(desk->ui, desk->context, files_set_text(desk->context, &file->of, NULL));
    }
    file->saved = file->recovered ? UINT64_MAX : desk->document->history.state;
    file->recovered = false;
    if (desk->document->source.path) note_recent(desk, desk->document->source.path);
}

void map_file_destroy(desk_state *desk) {
    file_state *file = &desk->file;
    save_free(desk->context, file->job);
    file->job = NULL;
    // A session that fails leaves its copy.
    if (desk->quit || !map_file_changed(desk)) session_remove(desk->context, &desk->file.copy);
    session_leave(desk->context, &file->copy);
    session_leave(desk->context, &file->offer);
    document_source_destroy(desk->context, &file->source);
    document_source_destroy(desk->context, &file->tried);
    sl_free(desk->context, file->path);
    sl_free(desk->context, file->of);
    sl_free(desk->context, file->building);
    sl_free(desk->context, file->failed);
    file->path = file->of = file->building = file->failed = NULL;
}

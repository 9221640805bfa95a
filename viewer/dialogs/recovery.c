/// When copies are made, and what is asked at the next start.
#include "dialogs/recovery.h"

#include "dialogs/map_file.h"
#include "dialogs/question.h"
#include "sightline/import.h"
#include "sightline/support.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <time.h>

/// Seconds between two copies.
#define COPY_STEP 3

// --- this session's copy

/// Notes which file the map is of. Nothing for one that is in no file.
static void write_of(desk_state *desk) {
    char path[PATH_TEXT], full[PATH_TEXT];
    const char *of = desk->file.path ? desk->file.path
                     : desk->file.of ? desk->file.of
                                     : desk->document->source.path;
    sl_output output;
    if (!of || !realpath(of, full)) return;
    session_path(&desk->file.copy, ".of", path);
    if (sl_output_open(desk->context, path, &output) != SL_OK) return;
    fputs(full, output.stream);
    sl_output_close(desk->context, &output, SL_OK);
}

void recovery_tick(desk_state *desk) {
    file_state *file = &desk->file;
    if (!file->copies || file->job || !map_file_changed(desk)) return;
    if (file->copy.name && file->copy_state == desk->document->history.state) return;
    if (sl_seconds() < file->copy_next) return;
    file->copy_next = sl_seconds() + COPY_STEP;
    if (!file->copy.name) {
        if (!session_begin(desk->context, &file->copy)) {
            file->copies = false;
            ui_say(desk->ui, true, "changes are not kept for a crash: no folder for them");
            return;
        }
        write_of(desk);
    }
    char path[PATH_TEXT];
    session_path(&file->copy, ".map", path);
    map_file_copy_to(desk, path);
}

// --- what earlier sessions have left

static void offer_next(desk_state *desk, const char *after);

static void recover(desk_state *desk) {
    file_state *file = &desk->file;
    char path[PATH_TEXT];
    sl_bytes of = {0};
    sl_map map = {0};
    session_path(&file->offer, ".of", path);
    const bool known = sl_file_read(desk->context, path, &of) == SL_OK;
    session_path(&file->offer, ".map", path);
    const sl_status status = sl_map_read(desk->context, path, NULL, &map);
    if (status == SL_OK) {
        // The copy is this session's from now on.
        session_remove(desk->context, &file->copy);
        file->copy = file->offer;
        file->offer = (session){0};
        map_file_recover(desk, &map, known ? of.data : NULL);
    } else {
        session_leave(desk->context, &file->offer);
    }
    map_file_check(desk, path, status);
    sl_free(desk->context, of.data);
}

static void take_answer(desk_state *desk, int answer) {
    char last[PATH_TEXT];
    if (answer == 0) {
        recover(desk);
        return;
    }
    session_path(&desk->file.offer, "", last);
    if (answer == 1)
        session_remove(desk->context, &desk->file.offer);
    else
        session_leave(desk->context, &desk->file.offer);
    offer_next(desk, last);
}

/// Asks about the session that is over and comes next. Its lock is ours until there is an answer.
static void offer_next(desk_state *desk, const char *after) {
    static const char *const answers[] = {"R:Recover", "D:Discard", "L:Later"};
    char path[PATH_TEXT], when[64] = "", text[PATH_TEXT + 128];
    struct stat info;
    struct tm local;
    sl_bytes of;
    if (!session_find(desk->context, after, &desk->file.offer)) return;
    session_path(&desk->file.offer, ".map", path);
    if (stat(path, &info) == 0 && localtime_r(&info.st_mtime, &local))
        strftime(when, sizeof when, "%Y-%m-%d %H:%M", &local);
    session_path(&desk->file.offer, ".of", path);
    const bool known = sl_file_read(desk->context, path, &of) == SL_OK;
    snprintf(text, sizeof text,
             "Sightline ended before changes were saved.\n%.1500s, changed on %s.",
             known ? of.data : "A map without a name", when);
    if (known) sl_free(desk->context, of.data);
    question_ask(desk, "Recover unsaved changes?", text, answers, 3, take_answer);
}

void recovery_begin(desk_state *desk) {
    desk->file.copies = true;
    offer_next(desk, "");
}

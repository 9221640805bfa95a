/// Copies of maps with unsaved changes.
///
/// A session has three files: unsaved-ID.lock, which it keeps locked while it runs, unsaved-ID.map,
/// the copy, and unsaved-ID.of, the name of the file that the map is of. The system drops the lock
/// when the program ends, however it ends. A lock that can be taken is of a session that is over:
/// a copy beside it was never saved. The lock comes first and goes last.
#include "dialogs/recovery.h"

#include "dialogs/map_file.h"
#include "dialogs/opening.h"
#include "dialogs/question.h"
#include "document/files.h"
#include "sightline/import.h"
#include "sightline/support.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/// Seconds between two copies.
#define COPY_STEP 3

/// Room for the name of a session: that of its files without their endings.
enum { SESSION_TEXT = PATH_TEXT - 16 };

static void name_file(char path[PATH_TEXT], const char *session, const char *ending) {
    snprintf(path, PATH_TEXT, "%s%s", session, ending);
}

static void remove_session(const char *session, int lock) {
    static const char *const endings[] = {".map", ".of", ".lock"};
    char path[PATH_TEXT];
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        name_file(path, session, endings[i]);
        unlink(path);
    }
    close(lock);
}

// --- this session's copy

/// A new lock in the folder; false without one.
static bool begin_session(desk_state *desk) {
    char folder[PATH_TEXT], session[SESSION_TEXT], path[PATH_TEXT];
    if (!files_folder("XDG_STATE_HOME", ".local/state", folder, true)) return false;
    for (int i = 0; i < 100; i++) {
        const int length =
            snprintf(session, sizeof session, "%s/unsaved-%ld-%d", folder, (long)getpid(), i);
        if (length < 0 || (size_t)length >= sizeof session) return false;
        name_file(path, session, ".lock");
        const int lock = open(path, O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0600);
        if (lock < 0) continue;
        char *copy = sl_copy_text(desk->context, session, strlen(session));
        if (copy && flock(lock, LOCK_EX | LOCK_NB) == 0) {
            desk->file.copy = copy;
            desk->file.lock = lock;
            return true;
        }
        sl_free(desk->context, copy);
        close(lock);
        unlink(path);
        return false;
    }
    return false;
}

/// Notes which file the map is of. Nothing for one that is in no file.
static void write_of(desk_state *desk) {
    char path[PATH_TEXT], full[PATH_TEXT];
    const char *of = desk->file.path ? desk->file.path
                     : desk->file.of ? desk->file.of
                                     : desk->document->source.path;
    sl_output output;
    if (!of || !realpath(of, full)) return;
    name_file(path, desk->file.copy, ".of");
    if (sl_output_open(desk->context, path, &output) != SL_OK) return;
    fputs(full, output.stream);
    sl_output_close(desk->context, &output, SL_OK);
}

void recovery_tick(desk_state *desk) {
    file_state *file = &desk->file;
    if (!file->copies || file->job || !map_file_changed(desk)) return;
    if (file->copy && file->copy_state == desk->document->history.state) return;
    if (sl_seconds() < file->copy_next) return;
    file->copy_next = sl_seconds() + COPY_STEP;
    if (!file->copy) {
        if (!begin_session(desk)) {
            file->copies = false;
            ui_say(desk->ui, true, "changes are not kept for a crash: no folder for them");
            return;
        }
        write_of(desk);
    }
    char path[PATH_TEXT];
    name_file(path, file->copy, ".map");
    map_file_copy_to(desk, path);
}

void recovery_take(desk_state *desk, sl_status status, uint64_t state) {
    if (status == SL_CANCELLED) return;
    desk->file.copy_state = state;
    if (status == SL_OK) return;
    desk->file.copies = false;
    ui_say(desk->ui, true, "changes are not kept for a crash: %s",
           sl_context_message(desk->context));
}

void recovery_forget(desk_state *desk) {
    file_state *file = &desk->file;
    if (!file->copy) return;
    remove_session(file->copy, file->lock);
    sl_free(desk->context, file->copy);
    file->copy = NULL;
}

// --- what earlier sessions have left

static void offer_next(desk_state *desk, const char *after);

static void take_answer(desk_state *desk, int answer) {
    file_state *file = &desk->file;
    char path[PATH_TEXT];
    sl_bytes of = {0};
    sl_map map = {0};
    if (answer == 1) remove_session(file->offer, file->offer_lock);
    if (answer == 2) close(file->offer_lock);
    if (answer != 0) {
        char last[SESSION_TEXT];
        snprintf(last, sizeof last, "%s", file->offer);
        sl_free(desk->context, file->offer);
        file->offer = NULL;
        offer_next(desk, last);
        return;
    }
    name_file(path, file->offer, ".of");
    const bool known = sl_file_read(desk->context, path, &of) == SL_OK;
    name_file(path, file->offer, ".map");
    const sl_status status = sl_map_read(desk->context, path, NULL, &map);
    if (status == SL_OK) {
        // The copy is this session's from now on.
        recovery_forget(desk);
        file->copy = file->offer;
        file->lock = file->offer_lock;
        map_file_recover(desk, &map, known ? of.data : NULL);
    } else {
        close(file->offer_lock);
        sl_free(desk->context, file->offer);
    }
    file->offer = NULL;
    files_check(desk, path, status);
    sl_free(desk->context, of.data);
}

/// Asks about a session that is over. Its lock is ours until there is an answer.
static void offer_session(desk_state *desk, const char *session, int lock) {
    static const char *const answers[] = {"R:Recover", "D:Discard", "L:Later"};
    char path[PATH_TEXT], when[64] = "", text[PATH_TEXT + 128];
    struct stat info;
    struct tm local;
    sl_bytes of;
    desk->file.offer = sl_copy_text(desk->context, session, strlen(session));
    if (!desk->file.offer) {
        close(lock);
        return;
    }
    desk->file.offer_lock = lock;
    name_file(path, session, ".map");
    if (stat(path, &info) == 0 && localtime_r(&info.st_mtime, &local))
        strftime(when, sizeof when, "%Y-%m-%d %H:%M", &local);
    name_file(path, session, ".of");
    const bool known = sl_file_read(desk->context, path, &of) == SL_OK;
    snprintf(text, sizeof text,
             "Sightline ended before changes were saved.\n%.1500s, changed on %s.",
             known ? of.data : "A map without a name", when);
    if (known) sl_free(desk->context, of.data);
    question_ask(desk, "Recover unsaved changes?", text, answers, 3, take_answer);
}

/// Whether a session is over and has left a copy: then its lock is open. Without a copy its files
/// are removed.
static bool take_session(const char *session, int *lock) {
    char path[PATH_TEXT];
    name_file(path, session, ".lock");
    *lock = open(path, O_RDWR | O_CLOEXEC);
    if (*lock < 0) return false;
    if (flock(*lock, LOCK_EX | LOCK_NB) != 0) {
        close(*lock);
        return false;
    }
    name_file(path, session, ".map");
    if (access(path, R_OK) == 0) return true;
    remove_session(session, *lock);
    return false;
}

/// Finds the session that is over and comes next by name after another one ("": the first), so that
/// none is asked about twice. Takes its lock. False where there is none.
static bool next_session(const char *folder, const char *after, char session[SESSION_TEXT],
                         int *lock) {
    DIR *dir = opendir(folder);
    char name[SESSION_TEXT];
    int found_lock = -1;
    if (!dir) return false;
    session[0] = '\0';
    for (struct dirent *entry; (entry = readdir(dir)) != NULL;) {
        const size_t length = strlen(entry->d_name);
        if (strncmp(entry->d_name, "unsaved-", 8) != 0 || length < 6 ||
            strcmp(entry->d_name + length - 5, ".lock") != 0)
            continue;
        const int room =
            snprintf(name, sizeof name, "%s/%.*s", folder, (int)(length - 5), entry->d_name);
        if (room < 0 || (size_t)room >= sizeof name || strcmp(name, after) <= 0) continue;
        if (*session && strcmp(name, session) > 0) continue;
        if (!take_session(name, lock)) continue;
        if (found_lock >= 0) close(found_lock);
        found_lock = *lock;
        snprintf(session, SESSION_TEXT, "%s", name);
    }
    closedir(dir);
    *lock = found_lock;
    return *session != '\0';
}

static void offer_next(desk_state *desk, const char *after) {
    char folder[PATH_TEXT], session[SESSION_TEXT];
    int lock;
    if (!files_folder("XDG_STATE_HOME", ".local/state", folder, false)) return;
    if (next_session(folder, after, session, &lock)) offer_session(desk, session, lock);
}

void recovery_begin(desk_state *desk) {
    desk->file.copies = true;
    offer_next(desk, "");
}

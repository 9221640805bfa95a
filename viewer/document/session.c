/// The files of sessions, and their locks.
#include "document/session.h"

#include "sightline/support.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

/// Room for the name of a session.
enum { SESSION_TEXT = PATH_TEXT - 16 };

static void name_file(char path[PATH_TEXT], const char *of, const char *ending) {
    snprintf(path, PATH_TEXT, "%s%s", of, ending);
}

void session_path(const session *s, const char *ending, char path[PATH_TEXT]) {
    name_file(path, s->name, ending);
}

static void remove_files(const char *of, int lock) {
    static const char *const endings[] = {".map", ".of", ".lock"};
    char path[PATH_TEXT];
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        name_file(path, of, endings[i]);
        unlink(path);
    }
    close(lock);
}

void session_remove(sl_context *context, session *s) {
    if (s->name) remove_files(s->name, s->lock);
    sl_free(context, s->name);
    *s = (session){0};
}

void session_leave(sl_context *context, session *s) {
    if (s->name) close(s->lock);
    sl_free(context, s->name);
    *s = (session){0};
}

/// False without memory: the lock is let go then.
static bool keep_session(sl_context *context, session *s, const char *name, int lock) {
    *s = (session){.name = sl_copy_text(context, name, strlen(name)), .lock = lock};
    if (!s->name) close(lock);
    return s->name != NULL;
}

bool session_begin(sl_context *context, session *s) {
    char folder[PATH_TEXT], name[SESSION_TEXT], path[PATH_TEXT];
    if (!files_folder("XDG_STATE_HOME", ".local/state", folder, true)) return false;
    for (int i = 0; i < 100; i++) {
        const int length =
            snprintf(name, sizeof name, "%s/unsaved-%ld-%d", folder, (long)getpid(), i);
        if (length < 0 || (size_t)length >= sizeof name) return false;
        name_file(path, name, ".lock");
        const int lock = open(path, O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0600);
        if (lock < 0) continue;
        const bool locked = flock(lock, LOCK_EX | LOCK_NB) == 0;
        if (!locked) close(lock);
        if (locked && keep_session(context, s, name, lock)) return true;
        unlink(path);
        return false;
    }
    return false;
}

/// Whether a session is over and has left a copy: then its lock is open. Without a copy its files
/// are removed.
static bool take_lock(const char *of, int *lock) {
    char path[PATH_TEXT];
    name_file(path, of, ".lock");
    *lock = open(path, O_RDWR | O_CLOEXEC);
    if (*lock < 0) return false;
    if (flock(*lock, LOCK_EX | LOCK_NB) != 0) {
        close(*lock);
        return false;
    }
    name_file(path, of, ".map");
    if (access(path, R_OK) == 0) return true;
    remove_files(of, *lock);
    return false;
}

bool session_find(sl_context *context, const char *after, session *s) {
    char folder[PATH_TEXT], name[SESSION_TEXT], found[SESSION_TEXT] = "";
    int lock, found_lock = -1;
    if (!files_folder("XDG_STATE_HOME", ".local/state", folder, false)) return false;
    DIR *dir = opendir(folder);
    if (!dir) return false;
    for (struct dirent *entry; (entry = readdir(dir)) != NULL;) {
        const size_t length = strlen(entry->d_name);
        if (strncmp(entry->d_name, "unsaved-", 8) != 0 || length < 6 ||
            strcmp(entry->d_name + length - 5, ".lock") != 0)
            continue;
        const int room =
            snprintf(name, sizeof name, "%s/%.*s", folder, (int)(length - 5), entry->d_name);
        if (room < 0 || (size_t)room >= sizeof name || strcmp(name, after) <= 0) continue;
        if (*found && strcmp(name, found) > 0) continue;
        if (!take_lock(name, &lock)) continue;
        if (found_lock >= 0) close(found_lock);
        found_lock = lock;
        snprintf(found, sizeof found, "%s", name);
    }
    closedir(dir);
    return *found && keep_session(context, s, found, found_lock);
}

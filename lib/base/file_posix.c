/// Files by POSIX.
#include "base/file_system.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

sl_path_kind sl_path_look(const char *path) {
    struct stat there;
    errno = 0;
    if (stat(path, &there) != 0) return SL_PATH_NOTHING;
    if (S_ISDIR(there.st_mode)) return SL_PATH_FOLDER;
    return S_ISREG(there.st_mode) ? SL_PATH_FILE : SL_PATH_STREAM;
}

bool sli_path_is_stdout(const char *path) {
    struct stat out, there;
    return fstat(STDOUT_FILENO, &out) == 0 && stat(path, &there) == 0 &&
           out.st_dev == there.st_dev && out.st_ino == there.st_ino;
}

/// Where a link leads, one step: a path that the caller frees. A link is relative to its folder.
static char *follow_link(sl_context *context, const char *path) {
    char text[4096];
    const ssize_t length = readlink(path, text, sizeof text - 1);
    if (length < 0) return sl_copy_text(context, path, strlen(path));
    text[length] = '\0';
    const char *slash = text[0] == '/' ? NULL : strrchr(path, '/');
    const size_t folder = slash ? (size_t)(slash + 1 - path) : 0;
    char *target = sl_alloc(context, folder + (size_t)length + 1);
    if (!target) return NULL;
    memcpy(target, path, folder);
    memcpy(target + folder, text, (size_t)length + 1);
    return target;
}

char *sli_path_target(sl_context *context, const char *path) {
    enum { MOST_LINKS = 40 };
    struct stat here;
    char *target = sl_copy_text(context, path, strlen(path));
    for (int i = 0; target && i < MOST_LINKS; i++) {
        if (lstat(target, &here) != 0 || !S_ISLNK(here.st_mode)) break;
        char *next = follow_link(context, target);
        sl_free(context, target);
        target = next;
    }
    return target;
}

FILE *sli_file_open(const char *path, const char *mode) {
    return fopen(path, mode);
}

bool sli_file_is_whole(FILE *stream, uint64_t *size) {
    struct stat file;
    if (fstat(fileno(stream), &file) != 0 || !S_ISREG(file.st_mode)) return false;
    *size = (uint64_t)file.st_size;
    return true;
}

/// mkstemp makes files private. A result keeps the mode of the file that it replaces; a new one is
/// as readable as any file the user writes.
static void set_mode(int descriptor, const struct stat *older) {
    const mode_t mask = umask(0);
    umask(mask);
    (void)!fchmod(descriptor, older ? older->st_mode & 0777 : 0666 & ~mask);
}

FILE *sli_file_make_beside(const char *path, char *temporary) {
    struct stat older;
    temporary[0] = '\0';
    const bool exists = stat(path, &older) == 0;
    // A file that the user may not write is not replaced either.
    if (exists && access(path, W_OK) != 0) return NULL;
    sprintf(temporary, "%s.XXXXXX", path);
    const int descriptor = mkstemp(temporary);
    if (descriptor < 0) {
        temporary[0] = '\0';
        return NULL;
    }
    set_mode(descriptor, exists ? &older : NULL);
    FILE *stream = fdopen(descriptor, "wb");
    if (stream) return stream;
    const int reason = errno;
    close(descriptor);
    errno = reason;
    return NULL;
}

bool sli_file_to_disk(FILE *stream) {
    int failed;
    do failed = fsync(fileno(stream));
    while (failed && errno == EINTR);
    return !failed || errno == EINVAL || errno == ENOTSUP || errno == EROFS;
}

bool sli_file_replace(const char *from, const char *to) {
    return rename(from, to) == 0;
}

void sli_file_remove(const char *path) {
    unlink(path);
}

/// Whole files. A file is written beside its target, brought to the disk and renamed. So a failure
/// at any moment leaves the old file as it was, and nothing half-written. Devices and pipes cannot
/// be replaced: they are written to directly.
#include "sightline/support.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef SL_ARRAY(char) characters;

/// A device may never end: it would take all memory there is.
static const uint64_t most_of_stream = (uint64_t)1 << 30;

static sl_status fail_size(sl_context *context, const char *path, uint64_t most) {
    return sl_fail(context, SL_BAD_INPUT, "%s: has more than the %llu MiB that can be read", path,
                   (unsigned long long)(most >> 20));
}

static sl_status read_to_end(sl_context *context, FILE *stream, const char *path, uint64_t most,
                             characters *data) {
    for (;;) {
        const size_t more = data->count < 65536 ? 65536 : data->count;
        SL_TRY(sl_check_cancelled(context));
        SL_TRY(SL_ARRAY_ROOM(context, data, more + 1));
        const size_t got = fread(data->items + data->count, 1, more, stream);
        data->count += got;
        if (ferror(stream)) {
            const sl_status status = errno == EISDIR ? SL_BAD_ARGUMENT : SL_IO;
            return sl_fail(context, status, "%s: cannot read: %s", path, strerror(errno));
        }
        if (data->count > most) return fail_size(context, path, most);
        if (got < more) break;
    }
    data->items[data->count] = '\0';
    return SL_OK;
}

static sl_status read_stream(sl_context *context, FILE *stream, const char *path, sl_bytes *out) {
    characters data = {0};
    struct stat file;
    const bool whole = fstat(fileno(stream), &file) == 0 && S_ISREG(file.st_mode);
    const uint64_t most = whole ? sl_machine_memory() / 4 : most_of_stream;
    sl_status status = SL_OK;
    if (whole && (uint64_t)file.st_size > most) status = fail_size(context, path, most);
    if (status == SL_OK) status = read_to_end(context, stream, path, most, &data);
    if (status == SL_OK)
        *out = (sl_bytes){.data = data.items, .size = data.count};
    else
        sl_free(context, data.items);
    return status;
}

sl_status sl_file_read(sl_context *context, const char *path, sl_bytes *out) {
    if (strcmp(path, "-") == 0) return read_stream(context, stdin, "standard input", out);
    errno = 0;
    FILE *stream = fopen(path, "rb");
    if (!stream) {
        // A file that is not there is a mistake in the arguments; one that cannot be read is not.
        const sl_status status = errno == ENOENT || errno == ENOTDIR ? SL_BAD_ARGUMENT : SL_IO;
        return sl_fail(context, status, "%s: cannot open: %s", path, strerror(errno));
    }
    const sl_status status = read_stream(context, stream, path, out);
    fclose(stream);
    return status;
}

/// mkstemp makes files private. A result keeps the mode of the file that it replaces; a new one is
/// as readable as any file the user writes.
static void set_mode(int descriptor, const struct stat *older) {
    const mode_t mask = umask(0);
    umask(mask);
    (void)!fchmod(descriptor, older ? older->st_mode & 0777 : 0666 & ~mask);
}

static sl_status fail_write(sl_context *context, const char *path, int reason) {
    return sl_fail(context, SL_IO, "%s: cannot write: %s", path,
                   reason ? strerror(reason) : "the system refused");
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

/// The file that a path leads to, also where that file is not there yet; the path itself where it
/// is no link. To be freed.
static char *final_target(sl_context *context, const char *path) {
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

static sl_status open_beside(sl_context *context, const char *path, const struct stat *older,
                             sl_output *out) {
    // A file that the user may not write is not replaced either.
    if (older && access(out->path, W_OK) != 0) return fail_write(context, path, errno);
    const size_t length = strlen(out->path);
    out->temporary = sl_alloc(context, length + 8);
    if (!out->temporary) return SL_NO_MEMORY;
    snprintf(out->temporary, length + 8, "%s.XXXXXX", out->path);
    const int descriptor = mkstemp(out->temporary);
    if (descriptor < 0) {
        out->temporary[0] = '\0';
        return fail_write(context, path, errno);
    }
    set_mode(descriptor, older);
    out->stream = fdopen(descriptor, "wb");
    if (out->stream) return SL_OK;
    const int reason = errno;
    close(descriptor);
    return fail_write(context, path, reason);
}

/// Gives up: removes what was written.
static void abandon(sl_context *context, sl_output *output) {
    if (output->stream && output->stream != stdout) fclose(output->stream);
    if (output->temporary && output->temporary[0]) unlink(output->temporary);
    sl_free(context, output->temporary);
    sl_free(context, output->path);
    *output = (sl_output){0};
}

/// Whether a path is what stdout goes to, as /dev/stdout is: to replace it would lose its reader.
static bool is_stdout(const struct stat *target) {
    struct stat out;
    return fstat(STDOUT_FILENO, &out) == 0 && out.st_dev == target->st_dev &&
           out.st_ino == target->st_ino;
}

sl_status sl_output_open(sl_context *context, const char *path, sl_output *out) {
    *out = (sl_output){0};
    struct stat target;
    const bool dash = strcmp(path, "-") == 0;
    const bool exists = !dash && stat(path, &target) == 0;
    if (dash || (exists && is_stdout(&target))) {
        out->stream = stdout;
        return SL_OK;
    }
    if (exists && S_ISDIR(target.st_mode))
        return sl_fail(context, SL_BAD_ARGUMENT, "%s: cannot write: is a directory", path);
    if (!exists && errno == ELOOP) return fail_write(context, path, errno);
    out->path = final_target(context, path);
    sl_status status = out->path ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK && exists && !S_ISREG(target.st_mode)) {
        // A device or a pipe is written to, never replaced.
        out->stream = fopen(path, "wb");
        if (!out->stream) status = fail_write(context, path, errno);
    } else if (status == SL_OK)
        status = open_beside(context, path, exists ? &target : NULL, out);
    if (status != SL_OK) abandon(context, out);
    return status;
}

sl_status sl_output_try(sl_context *context, const char *path) {
    struct stat target;
    const bool exists = stat(path, &target) == 0;
    if (strcmp(path, "-") == 0 || (exists && !S_ISREG(target.st_mode) && !S_ISDIR(target.st_mode)))
        return SL_OK;
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    abandon(context, &output);
    return SL_OK;
}

/// Whether a stream's descriptor can be brought to the disk: pipes and devices cannot.
static bool bring_to_disk(FILE *stream) {
    return fsync(fileno(stream)) == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS;
}

/// Closes the stream; 0, or why some write to it was refused (-1: the reason is lost).
static int finish_stream(FILE *stream) {
    const bool refused = ferror(stream) != 0;
    errno = 0;
    bool good = fflush(stream) == 0 && !refused;
    if (good && stream != stdout) good = bring_to_disk(stream);
    int reason = good ? 0 : errno ? errno : -1;
    if (stream != stdout && fclose(stream) != 0 && !reason) reason = errno;
    return reason;
}

sl_status sl_output_commit(sl_context *context, sl_output *output) {
    const char *name = output->path ? output->path : "standard output";
    int reason = finish_stream(output->stream);
    output->stream = NULL;
    if (!reason && output->temporary) {
        if (rename(output->temporary, output->path) != 0)
            reason = errno;
        else
            output->temporary[0] = '\0';
    }
    const sl_status status = reason ? fail_write(context, name, reason < 0 ? 0 : reason) : SL_OK;
    abandon(context, output);
    return status;
}

sl_status sl_output_close(sl_context *context, sl_output *output, sl_status status) {
    if (status == SL_OK) return sl_output_commit(context, output);
    abandon(context, output);
    return status;
}

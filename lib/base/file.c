/// Whole files. A file is written beside its target, brought to the disk and renamed. So a failure
/// at any moment leaves the old file as it was, and nothing half-written. Devices and pipes cannot
/// be replaced: they are written to directly.
#include "base/base.h"
#include "base/file_system.h"
#include "sightline/support.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

typedef SL_ARRAY(char) characters;

/// A device may never end: it would take all memory there is.
static const uint64_t most_of_stream = (uint64_t)1 << 30;

/// A folder is no file. One of LevelDB is what Foundry 11 and later keep packs and worlds in.
static sl_status fail_folder(sl_context *context, const char *path) {
    char current[1024];
    const int length = snprintf(current, sizeof current, "%s/CURRENT", path);
    const bool is_database =
        length > 0 && (size_t)length < sizeof current && sl_path_look(current) == SL_PATH_FILE;
    return sl_fail(context, SL_BAD_ARGUMENT, "%s: cannot read: %s%s", path, strerror(EISDIR),
                   is_database ? ": a database of LevelDB; in Foundry, right-click the scene and "
                                 "choose Export Data, or unpack the folder (fvtt package unpack)"
                               : "");
}

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
        errno = 0;
        const size_t got = fread(data->items + data->count, 1, more, stream);
        data->count += got;
        if (ferror(stream) && errno == EINTR) {
            clearerr(stream);
            continue;
        }
        if (ferror(stream) && errno == EISDIR) return fail_folder(context, path);
        if (ferror(stream))
            return sl_fail(context, SL_IO, "%s: cannot read: %s", path, strerror(errno));
        if (data->count > most) return fail_size(context, path, most);
        if (got < more) break;
    }
    data->items[data->count] = '\0';
    return SL_OK;
}

static sl_status read_stream(sl_context *context, FILE *stream, const char *path, sl_bytes *out) {
    characters data = {0};
    uint64_t size = 0;
    const bool whole = sli_file_is_whole(stream, &size);
    const uint64_t most = whole ? sl_machine_memory() / 4 : most_of_stream;
    sl_status status = SL_OK;
    if (whole && size > most) status = fail_size(context, path, most);
    if (status == SL_OK) status = read_to_end(context, stream, path, most, &data);
    if (status == SL_OK)
        *out = (sl_bytes){.data = data.items, .size = data.count};
    else
        sl_free(context, data.items);
    return status;
}

/// Opens a file, or gives NULL and errno. A pipe may wait here, which a signal of the caller's ends
/// early.
static sl_status open_to_read(sl_context *context, const char *path, FILE **out) {
    for (;;) {
        errno = 0;
        *out = sli_file_open(path, "rb");
        if (*out || errno != EINTR) return SL_OK;
        SL_TRY(sl_check_cancelled(context));
    }
}

sl_status sl_file_read(sl_context *context, const char *path, sl_bytes *out) {
    if (strcmp(path, "-") == 0) return read_stream(context, stdin, "standard input", out);
    FILE *stream = NULL;
    SL_TRY(open_to_read(context, path, &stream));
    if (!stream) {
        // A file that is not there is a mistake in the arguments; one that cannot be read is not.
        const sl_status status = errno == ENOENT || errno == ENOTDIR ? SL_BAD_ARGUMENT : SL_IO;
        return sl_fail(context, status, "%s: cannot open: %s", path, strerror(errno));
    }
    const sl_status status = read_stream(context, stream, path, out);
    fclose(stream);
    return status;
}

static sl_status fail_write(sl_context *context, const char *path, int reason) {
    return sl_fail(context, SL_IO, "%s: cannot write: %s", path,
                   reason ? strerror(reason) : "the system refused");
}

static sl_status open_beside(sl_context *context, const char *path, sl_output *out) {
    out->temporary = sl_alloc(context, strlen(out->path) + 8);
    if (!out->temporary) return SL_NO_MEMORY;
    out->stream = sli_file_make_beside(out->path, out->temporary);
    return out->stream ? SL_OK : fail_write(context, path, errno);
}

/// Gives up: removes what was written.
static void abandon(sl_context *context, sl_output *output) {
    if (output->stream && output->stream != stdout) fclose(output->stream);
    if (output->temporary && output->temporary[0]) sli_file_remove(output->temporary);
    sl_free(context, output->temporary);
    sl_free(context, output->path);
    *output = (sl_output){0};
}

sl_status sl_output_open(sl_context *context, const char *path, sl_output *out) {
    *out = (sl_output){0};
    const bool dash = strcmp(path, "-") == 0;
    const sl_path_kind there = dash ? SL_PATH_STREAM : sl_path_look(path);
    // To replace what stdout goes to would lose its reader.
    if (dash || (there != SL_PATH_NOTHING && sli_path_is_stdout(path))) {
        out->stream = stdout;
        return SL_OK;
    }
    if (there == SL_PATH_FOLDER)
        return sl_fail(context, SL_BAD_ARGUMENT, "%s: cannot write: is a directory", path);
    if (there == SL_PATH_NOTHING && errno == ELOOP) return fail_write(context, path, errno);
    out->path = sli_path_target(context, path);
    sl_status status = out->path ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK && there == SL_PATH_STREAM) {
        // A device or a pipe is written to, never replaced.
        out->stream = sli_file_open(path, "wb");
        if (!out->stream) status = fail_write(context, path, errno);
    } else if (status == SL_OK)
        status = open_beside(context, path, out);
    if (status != SL_OK) abandon(context, out);
    return status;
}

sl_status sl_output_try(sl_context *context, const char *path) {
    if (strcmp(path, "-") == 0 || sl_path_look(path) == SL_PATH_STREAM) return SL_OK;
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    abandon(context, &output);
    return SL_OK;
}

/// Closes the stream; 0, or why some write to it was refused (-1: the reason is lost).
static int finish_stream(FILE *stream) {
    const bool refused = ferror(stream) != 0;
    errno = 0;
    bool good = fflush(stream) == 0 && !refused;
    if (good && stream != stdout) good = sli_file_to_disk(stream);
    int reason = good ? 0 : errno ? errno : -1;
    if (stream != stdout && fclose(stream) != 0 && !reason) reason = errno;
    return reason;
}

static sl_status commit(sl_context *context, sl_output *output) {
    const char *name = output->path ? output->path : "standard output";
    int reason = finish_stream(output->stream);
    output->stream = NULL;
    if (!reason && output->temporary) {
        if (!sli_file_replace(output->temporary, output->path))
            reason = errno;
        else
            output->temporary[0] = '\0';
    }
    const sl_status status = reason ? fail_write(context, name, reason < 0 ? 0 : reason) : SL_OK;
    abandon(context, output);
    return status;
}

sl_status sl_output_close(sl_context *context, sl_output *output, sl_status status) {
    if (status == SL_OK) return commit(context, output);
    abandon(context, output);
    return status;
}

static sl_status read_back_file(sl_context *context, const char *path, const sl_output *output,
                                const sli_to_write *file) {
    errno = 0;
    if (fflush(output->stream) != 0 || ferror(output->stream))
        return fail_write(context, path, errno);
    sli_again again = {.stream = sli_file_open(output->temporary, "rb")};
    if (!again.stream)
        return sl_fail(context, SL_IO, "%s: cannot read back: %s", path, strerror(errno));
    sl_status status = SL_OK;
    if (!sli_file_is_whole(again.stream, &again.left))
        status = sl_fail(context, SL_IO, "%s: cannot read back", path);
    if (status == SL_OK) status = sli_read_back(context, path, file, again);
    if (fclose(again.stream) != 0 && status == SL_OK) status = fail_write(context, path, errno);
    return status;
}

/// For what cannot be replaced, nor read back.
static sl_status write_by_memory(sl_context *context, const char *path, FILE *stream,
                                 const sli_to_write *file) {
    sli_memory_stream memory;
    if (!sli_memory_open(&memory)) return sl_fail_memory(context);
    sl_status status = file->print(context, file->user, memory.stream);
    if (!sli_memory_close(&memory)) return sl_fail_memory(context);
    const sli_again again = {.at = memory.text, .left = memory.size};
    if (status == SL_OK) status = sli_read_back(context, path, file, again);
    errno = 0;
    if (status == SL_OK &&
        (fwrite(memory.text, 1, memory.size, stream) != memory.size || fflush(stream) != 0))
        status = fail_write(context, path, errno);
    free(memory.text);
    return status;
}

sl_status sli_file_write(sl_context *context, const char *path, const sli_to_write *file) {
    sl_output output;
    sl_status status;
    SL_TRY(sl_output_open(context, path, &output));
    if (output.temporary) {
        status = file->print(context, file->user, output.stream);
        if (status == SL_OK) status = read_back_file(context, path, &output, file);
    } else {
        const char *name = output.path ? path : "standard output";
        status = write_by_memory(context, name, output.stream, file);
    }
    return sl_output_close(context, &output, status);
}

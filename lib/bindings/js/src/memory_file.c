/// Files where there are none: what the library writes goes to memory, and no file can be read.
/// It stands in the place of base/file.c in WebAssembly.
///
/// One file is written at a time. sl_output_close() keeps its bytes until the next one is written;
/// `path` is not looked at. bindings.h says how to take them.
#include "base/base.h"
#include "base/file_system.h"
#include "bindings/js/src/bindings.h"

#include <stdlib.h>

static char *written;
static size_t written_size;

const char *sli_written(size_t *size) {
    *size = written_size;
    return written;
}

static sl_status fail(sl_context *context, const char *path) {
    return sl_fail(context, SL_IO, "%s: there are no files here", path);
}

sl_status sl_file_read(sl_context *context, const char *path, sl_bytes *out) {
    (void)out;
    return fail(context, path);
}

sl_status sl_output_open(sl_context *context, const char *path, sl_output *out) {
    (void)path;
    free(written);
    written = NULL;
    written_size = 0;
    *out = (sl_output){.stream = open_memstream(&written, &written_size)};
    return out->stream ? SL_OK : sl_fail_memory(context);
}

sl_status sl_output_try(sl_context *context, const char *path) {
    (void)context;
    (void)path;
    return SL_OK;
}

static sl_status commit(sl_context *context, sl_output *output) {
    const int failed = ferror(output->stream);
    const int lost = fclose(output->stream);
    output->stream = NULL;
    return failed || lost ? sl_fail_memory(context) : SL_OK;
}

sl_status sl_output_close(sl_context *context, sl_output *output, sl_status status) {
    if (status == SL_OK) return commit(context, output);
    fclose(output->stream);
    output->stream = NULL;
    return status;
}

sl_status sli_file_write(sl_context *context, const char *path, const sli_to_write *file) {
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    sl_status status = file->print(context, file->user, output.stream);
    if (status == SL_OK && fflush(output.stream) == 0 && !ferror(output.stream))
        status = sli_read_back(context, "the map", file,
                               (sli_again){.at = written, .left = written_size});
    return sl_output_close(context, &output, status);
}

sl_path_kind sl_path_look(const char *path) {
    (void)path;
    return SL_PATH_NOTHING;
}

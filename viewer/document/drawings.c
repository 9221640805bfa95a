/// The file "drawings": for each drawing a line "file PATH", and behind it lines of what was
/// chosen, a word and its value. The drawing that was read last comes first.
#include "document/drawings.h"

#include "sightline/support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { DRAWINGS_MOST = 64 };

bool drawing_is(const char *path) {
    static const char *const endings[] = {".dxf", ".svg", ".svgz", ".geojson", ".png", ".pgm"};
    const char *dot = path ? strrchr(path, '.') : NULL;
    for (size_t i = 0; dot && i < sizeof endings / sizeof *endings; i++)
        if (strcasecmp(dot, endings[i]) == 0) return true;
    return false;
}

/// Numbers with blanks between; how many there are.
static int read_numbers(const char *text, double numbers[4]) {
    int count = 0;
    while (count < 4 && *text) {
        const size_t length = strcspn(text, " ");
        if (!sl_number_read(text, length, &numbers[count])) break;
        count++;
        text += length + (text[length] == ' ');
    }
    return count;
}

static sl_status take_text(sl_context *context, const char **to, const char *value) {
    char *own = (char *)(uintptr_t)*to;
    const sl_status status = files_set_text(context, &own, value);
    *to = own;
    return status;
}

/// Takes a line of what was chosen; other words are of other versions of the program.
static sl_status take_line(sl_context *context, const char *word, const char *value,
                           document_source *source) {
    sl_import_options *o = &source->options;
    double at[4];
    const int count = read_numbers(value, at);
    if (strcmp(word, "layers") == 0) return take_text(context, &o->layers, value);
    if (strcmp(word, "unit") == 0) return take_text(context, &o->unit, value);
    if (strcmp(word, "entrance") == 0 && count == 1) o->entrance = at[0];
    if (strcmp(word, "doors") == 0) o->doors = true;
    if (strcmp(word, "weld") == 0 && count == 1) {
        source->has_weld = true;
        source->weld = at[0];
    }
    if (strcmp(word, "start") == 0 && count == 2) {
        source->has_start = true;
        source->start = (sl_point){at[0], at[1]};
    }
    if (strcmp(word, "closed") == 0 && count == 4)
        return document_source_close(context, source, (sl_segment){{at[0], at[1]}, {at[2], at[3]}});
    return SL_OK;
}

/// Calls back for each line of the file, with whether it is of this drawing.
typedef sl_status each_line(sl_context *context, void *user, bool own, const char *word,
                            const char *value);

static sl_status read_lines(sl_context *context, const char *full, each_line *take, void *user) {
    char path[PATH_TEXT];
    sl_bytes bytes;
    bool own = false;
    sl_status status = SL_OK;
    if (!files_kept("drawings", path, false) || sl_file_read(context, path, &bytes) != SL_OK)
        return SL_OK;
    for (char *line = bytes.data, *next; line && *line && status == SL_OK; line = next) {
        next = strchr(line, '\n');
        if (next) *next++ = '\0';
        char *value = line + strcspn(line, " ");
        if (*value) *value++ = '\0';
        if (strcmp(line, "file") == 0) own = strcmp(value, full) == 0;
        status = take(context, user, own, line, value);
    }
    sl_free(context, bytes.data);
    return status;
}

typedef struct recalled {
    document_source *source;
    bool any;
} recalled;

static sl_status recall_line(sl_context *context, void *user, bool own, const char *word,
                             const char *value) {
    recalled *r = user;
    if (!own) return SL_OK;
    r->any = true;
    return take_line(context, word, value, r->source);
}

bool drawing_recall(sl_context *context, document_source *source, sl_status *status) {
    recalled r = {.source = source};
    char *full = realpath(source->path, NULL);
    *status = full ? read_lines(context, full, recall_line, &r) : SL_OK;
    free(full);
    return r.any;
}

typedef struct copied {
    FILE *stream;
    size_t drawings;
} copied;

static sl_status copy_line(sl_context *context, void *user, bool own, const char *word,
                           const char *value) {
    copied *c = user;
    (void)context;
    c->drawings += !own && strcmp(word, "file") == 0;
    if (!own && c->drawings < DRAWINGS_MOST) fprintf(c->stream, "%s %s\n", word, value);
    return SL_OK;
}

static void put_numbers(FILE *stream, const char *word, const double *numbers, int count) {
    fputs(word, stream);
    for (int i = 0; i < count; i++) {
        char text[SL_NUMBER_TEXT];
        sl_number_write(numbers[i], text);
        fprintf(stream, " %s", text);
    }
    fputc('\n', stream);
}

static void put_text(FILE *stream, const char *word, const char *text) {
    if (text && !strchr(text, '\n')) fprintf(stream, "%s %s\n", word, text);
}

void drawing_remember(sl_context *context, const document_source *source) {
    const sl_import_options *o = &source->options;
    char path[PATH_TEXT];
    sl_output output;
    char *full = realpath(source->path, NULL);
    if (full && !strchr(full, '\n') && files_kept("drawings", path, true) &&
        sl_output_open(context, path, &output) == SL_OK) {
        copied c = {.stream = output.stream};
        fprintf(output.stream, "file %s\n", full);
        put_text(output.stream, "layers", o->layers);
        put_text(output.stream, "unit", o->unit);
        if (o->entrance > 0) put_numbers(output.stream, "entrance", &o->entrance, 1);
        if (o->doors) fputs("doors \n", output.stream);
        if (source->has_weld) put_numbers(output.stream, "weld", &source->weld, 1);
        if (source->has_start)
            put_numbers(output.stream, "start", (double[]){source->start.x, source->start.y}, 2);
        for (size_t i = 0; i < source->closed_count; i++) {
            const sl_segment s = source->closed[i];
            put_numbers(output.stream, "closed", (double[]){s.a.x, s.a.y, s.b.x, s.b.y}, 4);
        }
        sl_output_close(context, &output, read_lines(context, full, copy_line, &c));
    }
    free(full);
}

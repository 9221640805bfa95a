/// The file "drawings": for each drawing a line "file PATH", and behind it lines of what was
/// chosen, a word and its value. The drawing that was read last comes first. The file "rooms" is
/// alike: "room X Y NAME" and "zone X0 Y0 X1 Y1 NAME".
#include "document/drawings.h"

#include "draw/draw_plan.h" // private: names are cut as in pictures

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

const char *drawing_unit_hint(const char *path) {
    if (drawing_is(path)) return "Ctrl+I sets it, or measures a line";
    if (path && files_end_in(path, ".map")) return "write 'unit m' in the file";
    if (path && document_is_baked(path)) return "bake it from a map with a unit";
    return "save it as .map, then write 'unit m' in it";
}

/// Numbers with blanks between, up to `most`; how many there are. `text` goes on to what follows.
static int read_numbers(const char **text, double *numbers, int most) {
    int count = 0;
    while (count < most && **text) {
        const size_t length = strcspn(*text, " ");
        if (!sl_number_read(*text, length, &numbers[count])) break;
        count++;
        *text += length + ((*text)[length] == ' ');
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
    const char *rest = value;
    const int count = read_numbers(&rest, at, 4);
    if (strcmp(word, "layers") == 0) return take_text(context, &o->layers, value);
    if (strcmp(word, "unit") == 0) return take_text(context, &o->unit, value);
    if (strcmp(word, "entrance") == 0 && count == 1) o->entrance = at[0];
    if (strcmp(word, "tolerance") == 0 && count == 1) o->tolerance = at[0];
    if (strcmp(word, "threshold") == 0 && count == 1) o->threshold = at[0];
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

static sl_status read_lines(sl_context *context, const char *kept, const char *full,
                            each_line *take, void *user) {
    char path[PATH_TEXT];
    sl_bytes bytes;
    bool own = false;
    sl_status status = SL_OK;
    if (!files_kept(kept, path, false) || sl_file_read(context, path, &bytes) != SL_OK)
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
    *status = full ? read_lines(context, "drawings", full, recall_line, &r) : SL_OK;
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

/// A word, numbers, and the text behind them, "" for none.
static void put_numbers(FILE *stream, const char *word, const double *numbers, int count,
                        const char *text) {
    fputs(word, stream);
    for (int i = 0; i < count; i++) {
        char number[SL_NUMBER_TEXT];
        sl_number_write(numbers[i], number);
        fprintf(stream, " %s", number);
    }
    fprintf(stream, "%s%s\n", *text ? " " : "", text);
}

static void put_text(FILE *stream, const char *word, const char *text) {
    if (text && !strchr(text, '\n')) fprintf(stream, "%s %s\n", word, text);
}

/// Writes the lines that are kept for one file.
typedef void put_lines(FILE *stream, const void *user);

/// Puts the lines of a file before those of all others; without `put` it has none any more.
static void remember(sl_context *context, const char *kept, const char *name, put_lines *put,
                     const void *user) {
    char path[PATH_TEXT];
    sl_output output;
    char *full = realpath(name, NULL);
    if (full && !strchr(full, '\n') && files_kept(kept, path, true) &&
        sl_output_open(context, path, &output) == SL_OK) {
        copied c = {.stream = output.stream};
        if (put) {
            fprintf(output.stream, "file %s\n", full);
            put(output.stream, user);
        }
        sl_output_close(context, &output, read_lines(context, kept, full, copy_line, &c));
    }
    free(full);
}

static void put_choices(FILE *stream, const void *user) {
    const document_source *source = user;
    const sl_import_options *o = &source->options;
    put_text(stream, "layers", o->layers);
    put_text(stream, "unit", o->unit);
    if (o->entrance > 0) put_numbers(stream, "entrance", &o->entrance, 1, "");
    if (o->tolerance > 0) put_numbers(stream, "tolerance", &o->tolerance, 1, "");
    if (o->threshold > 0) put_numbers(stream, "threshold", &o->threshold, 1, "");
    if (o->doors) fputs("doors \n", stream);
    if (source->has_weld) put_numbers(stream, "weld", &source->weld, 1, "");
    if (source->has_start)
        put_numbers(stream, "start", (double[]){source->start.x, source->start.y}, 2, "");
    for (size_t i = 0; i < source->closed_count; i++) {
        const sl_segment s = source->closed[i];
        put_numbers(stream, "closed", (double[]){s.a.x, s.a.y, s.b.x, s.b.y}, 4, "");
    }
}

void drawing_remember(sl_context *context, const document_source *source) {
    remember(context, "drawings", source->path, put_choices, source);
}

// --- rooms and zones

/// Of one plan: rooms and zones.
typedef struct places {
    named_places *rooms, *zones;
} places;

static sl_status take_place(sl_context *context, void *user, bool own, const char *word,
                            const char *value) {
    const places *p = user;
    const bool zone = strcmp(word, "zone") == 0;
    const int count = zone ? 4 : 2;
    double at[4];
    if (!own || !(zone || strcmp(word, "room") == 0) || read_numbers(&value, at, count) != count ||
        !*value)
        return SL_OK;
    named_places *list = zone ? p->zones : p->rooms;
    SL_TRY(SL_ARRAY_ROOM(context, list, 1));
    named_place *place = &list->items[list->count++];
    *place = (named_place){{{at[0], at[1]}, {at[count - 2], at[count - 1]}}, ""};
    sli_text_copy(value, strlen(value), place->name, sizeof place->name);
    return SL_OK;
}

sl_status places_recall(sl_context *context, const char *path, named_places *rooms,
                        named_places *zones) {
    places p = {rooms, zones};
    char *full = realpath(path, NULL);
    const sl_status status = full ? read_lines(context, "rooms", full, take_place, &p) : SL_OK;
    free(full);
    return status;
}

static void put_places(FILE *stream, const void *user) {
    const places *p = user;
    for (size_t i = 0; i < p->rooms->count; i++) {
        const named_place *room = &p->rooms->items[i];
        put_numbers(stream, "room", (double[]){room->box.min.x, room->box.min.y}, 2, room->name);
    }
    for (size_t i = 0; i < p->zones->count; i++) {
        const named_place *zone = &p->zones->items[i];
        const sl_box b = zone->box;
        put_numbers(stream, "zone", (double[]){b.min.x, b.min.y, b.max.x, b.max.y}, 4, zone->name);
    }
}

void places_remember(sl_context *context, const char *path, const named_places *rooms,
                     const named_places *zones) {
    const places p = {(named_places *)(uintptr_t)rooms, (named_places *)(uintptr_t)zones};
    remember(context, "rooms", path, rooms->count + zones->count ? put_places : NULL, &p);
}

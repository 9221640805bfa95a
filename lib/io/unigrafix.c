// UniGrafix text (Séquin & Smith, U.C. Berkeley): "v name x y z ;", "f name (v v v) ... colour ;",
// comments in nested braces.
#include "io/io_formats.h"
#include "map/scan.h"
#include "map/source.h"
#include "sightline/io.h"

#include <math.h>
#include <stdlib.h>

typedef struct vertex {
    sli_word name;
    double x, y, z;
    uint32_t line;
} vertex;

typedef SL_ARRAY(char) note_text;

/// A model while it is read: once for its vertices, once for its faces.
typedef struct ug_model {
    sl_context *context;
    const char *name;
    const char *at, *end;
    uint32_t line;
    sl_map *map;
    SL_ARRAY(vertex) vertices;
    uint32_t *slots; ///< hash table: a vertex's number + 1, 0 for none
    size_t slot_count;
    SL_ARRAY(sl_point) crossings; ///< of the face at hand with the plane
    sl_point normal;              ///< of that face: its part in the plane
    note_text notes;
    double slice, lowest, highest;
    size_t faces, cut, flat, walls, skipped;
} ug_model;

/// Keeps a comment's text: its lines as they are, without the blank around them.
static sl_status keep_note(ug_model *model, const char *text, const char *end) {
    while (end > text && strchr(" \t\r\n", end[-1])) end--;
    const char *word = text, *line = NULL;
    for (; word < end && strchr(" \t\r\n", *word); word++)
        if (*word == '\n') line = word + 1;
    // Text right behind the brace has no indentation to keep.
    text = line ? line : word;
    if (text == end) return SL_OK;
    const size_t length = (size_t)(end - text);
    SL_TRY(SL_ARRAY_ROOM(model->context, &model->notes, length + 2));
    memcpy(model->notes.items + model->notes.count, text, length);
    model->notes.count += length;
    model->notes.items[model->notes.count++] = '\n';
    return SL_OK;
}

static void step(ug_model *model) {
    if (*model->at++ == '\n' && model->line < UINT32_MAX) model->line++;
}

/// Passes over a comment, braces in it nested; the text is at its opening brace.
static sl_status skip_comment(ug_model *model, bool keep) {
    const uint32_t line = model->line;
    const char *text = model->at + 1;
    size_t depth = 0;
    do {
        if (model->at == model->end)
            return sl_fail_at(model->context, model->name, line, "this comment's '{' has no '}'");
        if (*model->at == '{') depth++;
        if (*model->at == '}') depth--;
        step(model);
    } while (depth);
    return keep ? keep_note(model, text, model->at - 1) : SL_OK;
}

/// Passes over white space and comments.
static sl_status skip_blank(ug_model *model, bool keep) {
    while (model->at < model->end && strchr(" \t\r\n\f\v{", *model->at)) {
        if (*model->at == '{')
            SL_TRY(skip_comment(model, keep));
        else
            step(model);
    }
    return SL_OK;
}

/// The next word, "(", ")" or ";"; one of no length at the end of the text.
static sl_status next_word(ug_model *model, sli_word *word) {
    SL_TRY(skip_blank(model, false));
    const char *first = model->at;
    if (first < model->end && *first == '}')
        return sl_fail_at(model->context, model->name, model->line, "'}' without a '{' before it");
    if (first < model->end && strchr("();", *first))
        model->at++;
    else
        while (model->at < model->end && !strchr(" \t\r\n\f\v(){};", *model->at)) model->at++;
    *word = (sli_word){first, (size_t)(model->at - first)};
    return SL_OK;
}

static bool is_mark(sli_word word) {
    return word.length == 0 || strchr("();", word.at[0]);
}

static sl_status fail_expected(ug_model *model, const char *expected, uint32_t line,
                               sli_word found) {
    return sl_fail_at(model->context, model->name, model->line,
                      "expected %s in the statement of line %u, found %s%s%s", expected, line,
                      found.length ? "'" : "", found.length ? sli_show(found).text : "the end",
                      found.length ? "'" : "");
}

/// Passes over the rest of a statement, its ';' included.
static sl_status skip_statement(ug_model *model, uint32_t line) {
    for (;;) {
        sli_word word;
        SL_TRY(next_word(model, &word));
        if (word.length == 0) return fail_expected(model, "';'", line, word);
        if (sli_word_is(word, ";")) return SL_OK;
    }
}

/// FNV-1a, the upper half folded in.
static size_t hash(sli_word word) {
    uint64_t value = 0xcbf29ce484222325u;
    for (size_t i = 0; i < word.length; i++)
        value = (value ^ (unsigned char)word.at[i]) * 0x100000001b3u;
    return (size_t)(value ^ value >> 32);
}

/// The slot that has the vertex of this name, or the empty one where it belongs.
static uint32_t *find_slot(const ug_model *model, sli_word name) {
    size_t i = hash(name) & (model->slot_count - 1);
    for (;; i = (i + 1) & (model->slot_count - 1)) {
        uint32_t *slot = &model->slots[i];
        if (!*slot) return slot;
        const sli_word other = model->vertices.items[*slot - 1].name;
        if (other.length == name.length && memcmp(other.at, name.at, name.length) == 0) return slot;
    }
}

/// Keeps the table at most half full; its size is a power of two.
static sl_status grow_table(ug_model *model) {
    if (model->slot_count > 2 * model->vertices.count) return SL_OK;
    const size_t count = model->slot_count ? 2 * model->slot_count : 64;
    uint32_t *slots = sl_alloc_array(model->context, count, sizeof *slots);
    if (!slots) return SL_NO_MEMORY;
    sl_free(model->context, model->slots);
    model->slots = slots;
    model->slot_count = count;
    for (size_t i = 0; i < model->vertices.count; i++)
        *find_slot(model, model->vertices.items[i].name) = (uint32_t)i + 1;
    return SL_OK;
}

static sl_status read_vertex(ug_model *model, uint32_t line) {
    vertex read = {.line = line};
    double *const values[] = {&read.x, &read.y, &read.z};
    SL_TRY(next_word(model, &read.name));
    if (is_mark(read.name)) return fail_expected(model, "a vertex name", line, read.name);
    sli_word word;
    for (int i = 0; i < 3; i++) {
        SL_TRY(next_word(model, &word));
        if (is_mark(word)) return fail_expected(model, "x, y and z", line, word);
        SL_TRY(sli_read_coordinate(model->context, model->name, model->line, word, values[i]));
    }
    SL_TRY(next_word(model, &word));
    if (!sli_word_is(word, ";")) return fail_expected(model, "';'", line, word);
    if (model->vertices.count == UINT32_MAX - 1)
        return sl_fail_at(model->context, model->name, line, "more vertices than can be counted");
    SL_TRY(grow_table(model));
    uint32_t *slot = find_slot(model, read.name);
    if (*slot)
        return sl_fail_at(model->context, model->name, line,
                          "vertex '%s' once more: it is defined on line %u",
                          sli_show(read.name).text, model->vertices.items[*slot - 1].line);
    SL_TRY(SL_ARRAY_ROOM(model->context, &model->vertices, 1));
    model->vertices.items[model->vertices.count++] = read;
    *slot = (uint32_t)model->vertices.count;
    model->lowest = fmin(model->lowest, read.z);
    model->highest = fmax(model->highest, read.z);
    return SL_OK;
}

/// Where one coordinate of an edge crosses the plane. Exact where both ends agree; never out of
/// their range. Computed from the lower end to the upper, so that the faces at an edge agree.
static double cross(double low, double high, double share) {
    const double value = low + (high - low) * share;
    if (value < fmin(low, high) || value > fmax(low, high)) return high;
    return sli_coordinate(value);
}

/// Adds the crossing of an edge with the plane; a vertex in the plane counts as above it.
static sl_status cross_edge(ug_model *model, const vertex *a, const vertex *b) {
    const vertex *low = a->z < b->z ? a : b, *high = a->z < b->z ? b : a;
    if (!(low->z < model->slice && high->z >= model->slice)) return SL_OK;
    const double share = (model->slice - low->z) / (high->z - low->z);
    const bool at_end = high->z == model->slice;
    const sl_point at = {at_end ? high->x : cross(low->x, high->x, share),
                         at_end ? high->y : cross(low->y, high->y, share)};
    SL_TRY(SL_ARRAY_ROOM(model->context, &model->crossings, 1));
    model->crossings.items[model->crossings.count++] = at;
    return SL_OK;
}

/// Reads one contour of a face behind its '('. Says whether all of it lies in the plane.
/// Takes an edge of the face at hand. The normal is Newell's: the sum over all edges.
static sl_status take_edge(ug_model *model, const vertex *from, const vertex *to) {
    model->normal.x += (from->y - to->y) * (from->z + to->z);
    model->normal.y += (from->z - to->z) * (from->x + to->x);
    return cross_edge(model, from, to);
}

static sl_status read_contour(ug_model *model, uint32_t line, bool *flat) {
    const vertex *first = NULL, *previous = NULL;
    size_t count = 0;
    for (;;) {
        sli_word word;
        SL_TRY(next_word(model, &word));
        if (sli_word_is(word, ")")) break;
        if (is_mark(word)) return fail_expected(model, "vertex names and ')'", line, word);
        const uint32_t slot = model->slot_count ? *find_slot(model, word) : 0;
        if (!slot)
            return sl_fail_at(model->context, model->name, model->line, "unknown vertex '%s'",
                              sli_show(word).text);
        const vertex *next = &model->vertices.items[slot - 1];
        if (previous)
            SL_TRY(take_edge(model, previous, next));
        else
            first = next;
        previous = next;
        if (next->z != model->slice) *flat = false;
        count++;
    }
    if (count < 3)
        return sl_fail_at(model->context, model->name, line,
                          "a face has at least 3 vertices, this one has %zu", count);
    return take_edge(model, previous, first);
}

static int compare_x(const void *left, const void *right) {
    const sl_point *a = left, *b = right;
    const int order = (a->x > b->x) - (a->x < b->x);
    return order ? order : (a->y > b->y) - (a->y < b->y);
}

static int compare_y(const void *left, const void *right) {
    const sl_point *a = left, *b = right;
    const int order = (a->y > b->y) - (a->y < b->y);
    return order ? order : (a->x > b->x) - (a->x < b->x);
}

/// The ground beside a face's wall.
static uint32_t ground_of(const ug_model *model, sl_point a, sl_point b) {
    const double side = (b.x - a.x) * model->normal.y - (b.y - a.y) * model->normal.x;
    if (side == 0) return 0;
    const uint32_t ground = SL_SOLID_LEFT | SL_OPEN_RIGHT;
    return side > 0 ? sl_ground_turned(ground) : ground;
}

/// Makes walls of a face's crossings: along the cut, every other gap between them is in the face.
static sl_status add_walls(ug_model *model, uint32_t line) {
    const size_t count = model->crossings.count;
    sl_point *points = model->crossings.items;
    if (count == 0) return SL_OK;
    sl_point low = points[0], high = points[0];
    for (size_t i = 1; i < count; i++) {
        low = (sl_point){fmin(low.x, points[i].x), fmin(low.y, points[i].y)};
        high = (sl_point){fmax(high.x, points[i].x), fmax(high.y, points[i].y)};
    }
    // The cut is a line but for rounding: the axis that it runs along more sorts it rightly.
    const bool along_x = high.x - low.x >= high.y - low.y;
    qsort(points, count, sizeof *points, along_x ? compare_x : compare_y);
    model->cut++;
    for (size_t i = 0; i + 1 < count; i += 2) {
        if (compare_x(&points[i], &points[i + 1]) == 0) continue;
        SL_TRY(sl_map_add_wall(model->context, model->map, points[i], points[i + 1], line));
        model->map->walls[model->map->wall_count - 1].ground =
            ground_of(model, points[i], points[i + 1]);
        model->walls++;
    }
    return SL_OK;
}

/// "face W12"
static sl_status name_face(ug_model *model, uint32_t line, sli_word name) {
    char label[SL_LINE_TEXT];
    if (!name.length) return SL_OK;
    snprintf(label, sizeof label, "face %s", sli_show(name).text);
    return sli_map_add_label(model->context, model->map, line, label);
}

/// Reads a face: a name (or none), contours, then at most a colour and an illumination.
static sl_status read_face(ug_model *model, uint32_t line) {
    model->crossings.count = 0;
    model->normal = (sl_point){0};
    bool flat = true;
    sli_word word;
    SL_TRY(next_word(model, &word));
    const sli_word name = {word.at, is_mark(word) ? 0 : word.length};
    if (name.length) SL_TRY(next_word(model, &word));
    if (!sli_word_is(word, "(")) return fail_expected(model, "'('", line, word);
    while (sli_word_is(word, "(")) {
        SL_TRY(read_contour(model, line, &flat));
        SL_TRY(next_word(model, &word));
    }
    for (int i = 0; i < 2 && !is_mark(word); i++) SL_TRY(next_word(model, &word));
    if (!sli_word_is(word, ";")) return fail_expected(model, "';'", line, word);
    model->faces++;
    model->flat += flat;
    const size_t before = model->map->wall_count;
    SL_TRY(add_walls(model, line));
    return model->map->wall_count > before ? name_face(model, line, name) : SL_OK;
}

/// Goes through all statements, for the vertices or for the faces.
static sl_status read_statements(ug_model *model, const char *text, bool faces) {
    model->at = text;
    model->line = 1;
    SL_TRY(skip_blank(model, !faces));
    for (size_t count = 0; model->at < model->end; count++) {
        if (count % 1024 == 0) SL_TRY(sl_check_cancelled(model->context));
        sli_word word;
        const uint32_t line = model->line;
        SL_TRY(next_word(model, &word));
        if (is_mark(word)) return fail_expected(model, "a statement", line, word);
        const bool point = sli_word_is(word, "v"), face = sli_word_is(word, "f");
        if (point && !faces)
            SL_TRY(read_vertex(model, line));
        else if (face && faces)
            SL_TRY(read_face(model, line));
        else
            SL_TRY(skip_statement(model, line));
        const bool colour = sli_word_is(word, "c_rgb") || sli_word_is(word, "c");
        model->skipped += faces && !point && !face && !colour;
        // What follows the last statement is kept, as is what leads the first one.
        const size_t kept = model->notes.count;
        SL_TRY(skip_blank(model, !faces));
        if (model->at < model->end) model->notes.count = kept;
    }
    return SL_OK;
}

static sl_status check_slice(const ug_model *model, const sl_import_options *options) {
    char text[3][SL_NUMBER_TEXT];
    sl_number_write(model->lowest, text[0]);
    sl_number_write(model->highest, text[1]);
    if (!options->has_slice)
        return sl_fail(model->context, SL_BAD_ARGUMENT,
                       "%s: a 3D model: give --slice Z, the height of the cut: the model's z goes "
                       "from %s to %s",
                       model->name, text[0], text[1]);
    if (options->slice >= model->lowest && options->slice <= model->highest) return SL_OK;
    if (isfinite(options->slice))
        sl_number_write(options->slice, text[2]);
    else
        snprintf(text[2], sizeof text[2], "%g", options->slice);
    return sl_fail(model->context, SL_BAD_ARGUMENT,
                   "%s: --slice %s misses the model: its z goes from %s to %s", model->name,
                   text[2], text[0], text[1]);
}

/// The points alone.
static sl_status read_points(ug_model *model, const char *text, size_t size) {
    SL_TRY(sli_refuse_nul(model->context, model->name, text, size));
    model->end = size ? text + size : text;
    SL_TRY(read_statements(model, sli_skip_mark(text, size), false));
    if (model->vertices.count) return SL_OK;
    return sl_fail_at(model->context, model->name, 0, "the model has no vertices");
}

static sl_status read_model(ug_model *model, const char *text, size_t size,
                            const sl_import_options *options) {
    SL_TRY(read_points(model, text, size));
    SL_TRY(check_slice(model, options));
    model->slice = options->slice;
    model->map->ground_guessed = true;
    SL_TRY(read_statements(model, sli_skip_mark(text, size), true));
    if (model->notes.count) {
        model->notes.items[model->notes.count] = '\0';
        SL_TRY(sli_map_add_note(model->context, model->map, model->notes.items));
    }
    char slice[SL_NUMBER_TEXT];
    sl_number_write(model->slice, slice);
    sl_note(model->context,
            "%s: cut at z = %s: %zu of %zu faces give %zu wall%s; %zu faces in the plane left out; "
            "%zu statements of other kinds passed over",
            model->name, slice, model->cut, model->faces, model->walls,
            model->walls == 1 ? "" : "s", model->flat, model->skipped);
    return SL_OK;
}

static void free_model(ug_model *model) {
    sl_free(model->context, model->vertices.items);
    sl_free(model->context, model->slots);
    sl_free(model->context, model->crossings.items);
    sl_free(model->context, model->notes.items);
}

sl_status sli_map_read_unigrafix(sl_context *context, const char *name, const char *text,
                                 size_t size, const sl_import_options *options, sl_map *map) {
    sl_map read = {0};
    ug_model model = {
        .context = context, .name = name, .map = &read, .lowest = HUGE_VAL, .highest = -HUGE_VAL};
    const sl_status status = read_model(&model, text, size, options);
    free_model(&model);
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}

sl_status sli_map_heights_unigrafix(sl_context *context, const char *name, const char *text,
                                    size_t size, double *lowest, double *highest) {
    ug_model model = {.context = context, .name = name, .lowest = HUGE_VAL, .highest = -HUGE_VAL};
    const sl_status status = read_points(&model, text, size);
    free_model(&model);
    if (status != SL_OK) return status;
    *lowest = model.lowest;
    *highest = model.highest;
    return SL_OK;
}

/// Tables of viewpoints. They come from planners' spreadsheets: names of columns in any case, the
/// separator of the country, decimal commas, quotes.
///
/// The first line decides. What stands between its fields is the separator. If none of them is a
/// number, they are names. Where none of the names is known, the first columns are x, y and so on.
#include "sightline/json.h"
#include "sightline/support.h"
#include "sightline/viewpoint.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/// The columns, in the order of a table without names; there `name` comes last.
typedef enum column {
    COLUMN_X,
    COLUMN_Y,
    COLUMN_HEADING,
    COLUMN_FOV,
    COLUMN_RANGE,
    NUMBERED, ///< so many have a place in a table without names
    COLUMN_HEIGHT = NUMBERED,
    COLUMN_TILT,
    COLUMN_LETTERS,
    COLUMN_SIGN,
    COLUMN_COST,
    COLUMN_NEAREST,
    COLUMN_NAME,
    COLUMNS,
    UNKNOWN = COLUMNS
} column;

static const char *const column_names[COLUMNS][4] = {
    {"x"},
    {"y"},
    {"heading", "angle", "look", "direction"},
    {"fov", "field of view", "field_of_view"},
    {"range", "reach"},
    {"height"},
    {"tilt"},
    {"letters", "letter height", "letter_height"},
    {"sign"},
    {"cost", "price"},
    {"nearest", "dead_zone", "dead zone"},
    {"name", "label", "id", "camera"},
};

enum { FIELDS_MOST = 256, FIELD_TEXT = 512 };

/// A field, without blanks and quotes around it.
typedef struct field {
    char text[FIELD_TEXT];
    size_t length;
} field;

typedef struct reader {
    sl_context *context;
    const char *path;
    const sl_viewpoint *like;
    sl_cameras *to;
    char separator;
    unsigned line;
    bool named;
    column columns[FIELDS_MOST];
    size_t column_count; ///< 0 before the first line
} reader;

void sl_viewpoint_tilt(sl_viewpoint *viewpoint, double height, double tilt, double aspect) {
    if (!(height > 0) || !(viewpoint->fov < 180)) return;
    const double degree = atan(1) / 45;
    const double half = atan(tan(viewpoint->fov / 2 * degree) / aspect);
    const double lower = tilt * degree + half, upper = tilt * degree - half;
    if (lower > 0 && lower < 90 * degree) viewpoint->nearest = height / tan(lower);
    if (!(upper > 0)) return;
    const double far = height / tan(upper);
    if (!(viewpoint->range > 0) || far < viewpoint->range) viewpoint->range = far;
}

void sl_viewpoint_sign(sl_viewpoint *viewpoint, double letters) {
    viewpoint->sign = true;
    viewpoint->fov = 180;
    const double range = SL_SIGN_FACTOR * letters;
    if (letters > 0 && !(viewpoint->range > 0 && viewpoint->range < range))
        viewpoint->range = range;
}

// --- fields

/// Takes the next field of a line. False behind the last. `*wrong`: it is too long, or its quotes
/// do not close.
static bool next_field(const reader *r, const char *line, size_t length, size_t *at, field *out,
                       bool *wrong) {
    if (*at > length) return false;
    out->length = 0;
    bool quoted = false;
    size_t i = *at;
    for (; i < length && (quoted || line[i] != r->separator); i++) {
        if (line[i] == '"') {
            if (quoted && i + 1 < length && line[i + 1] == '"')
                i++; // a quote in a quoted field
            else {
                quoted = !quoted;
                continue;
            }
        }
        const char c = line[i] == '\r' ? ' ' : line[i]; // as names are written
        if (!quoted && !out->length && (c == ' ' || c == '\t')) continue;
        *wrong |= out->length + 1 >= FIELD_TEXT;
        if (!*wrong) out->text[out->length++] = c;
    }
    *wrong |= quoted;
    while (out->length && strchr(" \t", out->text[out->length - 1])) out->length--;
    out->text[out->length] = '\0';
    *at = i + 1;
    return true;
}

static bool read_number(const reader *r, const field *f, double *value) {
    return sl_table_number_read(r->separator, f->text, f->length, value) && isfinite(*value);
}

static bool same_word(const char *a, const char *b) {
    while (*a && tolower((unsigned char)*a) == *b) a++, b++;
    return !*a && !*b;
}

static column column_of(const field *f) {
    for (int c = 0; c < COLUMNS; c++)
        for (int n = 0; n < 4 && column_names[c][n]; n++)
            if (same_word(f->text, column_names[c][n])) return (column)c;
    return UNKNOWN;
}

// --- the first line

/// Notes the columns that are passed over.
static sl_status name_columns(reader *r, const char *line, size_t length) {
    char others[256] = "";
    size_t at = 0, count = 0, used = 0;
    field f;
    bool wrong = false, known[COLUMNS + 1] = {false};
    while (r->column_count < FIELDS_MOST && next_field(r, line, length, &at, &f, &wrong)) {
        const column c = column_of(&f);
        if (c != UNKNOWN && known[c])
            return sl_fail_at(r->context, r->path, r->line, "two columns '%s'", column_names[c][0]);
        known[c] = true;
        r->columns[r->column_count++] = c;
        if (c != UNKNOWN || !f.length) continue;
        const int put =
            snprintf(others + used, sizeof others - used, "%s'%.40s'", count++ ? ", " : "", f.text);
        if (put > 0 && used + (size_t)put < sizeof others) used += (size_t)put;
    }
    others[used] = '\0';
    bool any = false;
    for (int c = 0; c < COLUMNS; c++) any |= known[c];
    if (!any && r->column_count >= 2) {
        for (size_t i = 0; i < r->column_count; i++)
            r->columns[i] = i < NUMBERED ? (column)i : UNKNOWN;
        sl_note(
            r->context,
            "%s: the first line names neither x nor y: the first two columns are taken as x and y",
            r->path);
        return SL_OK;
    }
    if (!known[COLUMN_X] || !known[COLUMN_Y])
        return sl_fail_at(r->context, r->path, r->line,
                          "the columns x and y are needed; others may be name, heading, fov, "
                          "range, height, tilt, letters, sign, cost");
    if (count && sl_text_is_utf8(others))
        sl_note(r->context, "%s: column%s passed over: %s", r->path, count == 1 ? "" : "s", others);
    return SL_OK;
}

/// Whether no field of a line is a number.
static bool has_names(const reader *r, const char *line, size_t length) {
    size_t at = 0;
    field f;
    bool wrong = false;
    double value;
    while (next_field(r, line, length, &at, &f, &wrong))
        if (read_number(r, &f, &value)) return false;
    return true;
}

// --- rows

static sl_status check_row(const reader *r, const sl_camera *camera) {
    const sl_viewpoint *v = &camera->view;
    const char *wrong = !(v->fov > 0 && v->fov <= 360) ? "fov must be over 0 and up to 360 degrees"
                        : !(v->range >= 0)             ? "range must be 0 (no limit) or more"
                        : !(v->nearest >= 0)           ? "nearest must be 0 or more"
                        : !(camera->height >= 0)       ? "height must be 0 or more"
                        : !(camera->tilt >= 0 && camera->tilt <= 90)
                            ? "tilt must be 0 to 90 degrees below the horizon"
                        : camera->tilt > 0 && !(camera->height > 0)
                            ? "a tilt needs a height over the ground"
                        : !(camera->letters >= 0) ? "letters must be 0 or more high"
                        : camera->view.sign && !(camera->view.range > 0)
                            ? "a sign needs letters, their height, or a range: how far it is read"
                        : !(camera->cost > 0) ? "cost must be over 0"
                                              : NULL;
    return wrong ? sl_fail_at(r->context, r->path, r->line, "%s", wrong) : SL_OK;
}

/// Takes a field of a row.
static sl_status take_field(reader *r, size_t place, const field *f, sl_camera *camera, char *name,
                            size_t *needed) {
    const column c = r->columns[place];
    double sign = 0;
    double *const targets[] = {&camera->view.at.x, &camera->view.at.y,   &camera->view.heading,
                               &camera->view.fov,  &camera->view.range,  &camera->height,
                               &camera->tilt,      &camera->letters,     &sign,
                               &camera->cost,      &camera->view.nearest};
    if (c == UNKNOWN || !f->length) return SL_OK;
    if (c == COLUMN_NAME) {
        if (!sl_text_is_utf8(f->text))
            return sl_fail_at(r->context, r->path, r->line, "the name is no UTF-8");
        memcpy(name, f->text, f->length + 1);
        camera->name = name;
        return SL_OK;
    }
    *needed += c == COLUMN_X || c == COLUMN_Y;
    if (!read_number(r, f, targets[c]))
        return sl_fail_at(r->context, r->path, r->line, "%s: '%.40s' is no finite number",
                          column_names[c][0], sl_text_is_utf8(f->text) ? f->text : "?");
    if (c == COLUMN_SIGN) camera->view.sign = sign != 0;
    return SL_OK;
}

static sl_status read_row(reader *r, const char *line, size_t length) {
    sl_camera camera = {.view = *r->like, .cost = 1, .line = r->line};
    char name[FIELD_TEXT];
    size_t at = 0, place = 0, needed = 0;
    bool wrong = false;
    field f;
    for (; next_field(r, line, length, &at, &f, &wrong); place++) {
        if (wrong)
            return sl_fail_at(r->context, r->path, r->line,
                              "a field is too long, or its quotes do not close");
        if (place >= r->column_count && f.length)
            return sl_fail_at(r->context, r->path, r->line,
                              "%zu columns, and the first line %s %zu", place + 1,
                              r->named ? "names" : "has", r->column_count);
        if (place < r->column_count) SL_TRY(take_field(r, place, &f, &camera, name, &needed));
    }
    if (needed < 2) return sl_fail_at(r->context, r->path, r->line, "x and y are needed");
    if (camera.letters > 0 || camera.view.sign) sl_viewpoint_sign(&camera.view, camera.letters);
    SL_TRY(check_row(r, &camera));
    if (camera.height > 0)
        sl_viewpoint_tilt(&camera.view, camera.height, camera.tilt, SL_PICTURE_ASPECT);
    return sl_cameras_add(r->context, r->to, &camera);
}

static sl_status first_line(reader *r, const char *line, size_t length) {
    r->separator = sl_table_separator(line, length);
    r->named = has_names(r, line, length);
    if (r->named) return name_columns(r, line, length);
    field f;
    bool wrong = false;
    for (size_t at = 0; next_field(r, line, length, &at, &f, &wrong);) r->column_count++;
    if (r->column_count < 2 || r->column_count > NUMBERED)
        return sl_fail_at(r->context, r->path, r->line,
                          "x, y, and maybe heading, fov and range are needed, or a first line that "
                          "names the columns");
    for (r->column_count = 0; r->column_count < NUMBERED; r->column_count++)
        r->columns[r->column_count] = (column)r->column_count;
    return read_row(r, line, length);
}

static sl_status read_lines(reader *r, const char *text, size_t size) {
    const bool marked = size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0;
    for (size_t at = marked ? 3 : 0; at < size;) {
        const char *line = text + at, *end = memchr(line, '\n', size - at);
        size_t length = end ? (size_t)(end - line) : size - at;
        at += length + 1;
        r->line++;
        if (length && line[length - 1] == '\r') length--;
        if (memchr(line, '\0', length))
            return sl_fail_at(r->context, r->path, r->line,
                              "a NUL byte: expected a table as plain text (ASCII or UTF-8)");
        size_t blank = 0;
        while (blank < length && strchr(" \t,;", line[blank])) blank++;
        if (blank == length) continue;
        SL_TRY(r->column_count ? read_row(r, line, length) : first_line(r, line, length));
    }
    if (r->to->count) return SL_OK;
    return sl_fail(r->context, SL_BAD_INPUT, "%s: there is no viewpoint in it", r->path);
}

sl_status sl_cameras_parse(sl_context *context, const char *path, const char *text, size_t size,
                           const sl_viewpoint *like, sl_cameras *out) {
    *out = (sl_cameras){0};
    reader r = {.context = context, .path = path, .like = like, .to = out};
    const sl_status status = read_lines(&r, text, size);
    if (status != SL_OK) sl_cameras_destroy(context, out);
    return status;
}

sl_status sl_cameras_read(sl_context *context, const char *path, const sl_viewpoint *like,
                          sl_cameras *out) {
    sl_bytes text;
    SL_TRY(sl_file_read(context, path, &text));
    const sl_status status = sl_cameras_parse(context, path, text.data, text.size, like, out);
    sl_free(context, text.data);
    return status;
}

sl_status sl_cameras_add(sl_context *context, sl_cameras *cameras, const sl_camera *camera) {
    SL_TRY(SL_ARRAY_ROOM(context, cameras, 1));
    sl_camera copy = *camera;
    if (camera->name) {
        copy.name = sl_copy_text(context, camera->name, strlen(camera->name));
        if (!copy.name) return SL_NO_MEMORY;
    }
    cameras->items[cameras->count++] = copy;
    return SL_OK;
}

void sl_cameras_destroy(sl_context *context, sl_cameras *cameras) {
    for (size_t i = 0; i < cameras->count; i++) sl_free(context, cameras->items[i].name);
    sl_free(context, cameras->items);
    *cameras = (sl_cameras){0};
}

// --- writing

/// Whether a row has a value other than the usual one in a column.
static bool needs(const sl_camera *camera, column c) {
    switch (c) {
    case COLUMN_HEADING:
        return camera->view.heading != 0;
    case COLUMN_FOV:
        return camera->view.fov != 360;
    case COLUMN_RANGE:
        return camera->view.range > 0;
    case COLUMN_HEIGHT:
        return camera->height > 0;
    case COLUMN_TILT:
        return camera->tilt > 0;
    case COLUMN_LETTERS:
        return camera->letters > 0;
    case COLUMN_SIGN:
        return camera->view.sign && !(camera->letters > 0);
    case COLUMN_COST:
        return camera->cost != 1;
    case COLUMN_NEAREST:
        return camera->view.nearest > 0 && !(camera->height > 0);
    case COLUMN_NAME:
        return camera->name != NULL;
    default:
        return true;
    }
}

static double value_of(const sl_camera *camera, column c) {
    const double values[] = {camera->view.at.x, camera->view.at.y,   camera->view.heading,
                             camera->view.fov,  camera->view.range,  camera->height,
                             camera->tilt,      camera->letters,     camera->view.sign,
                             camera->cost,      camera->view.nearest};
    return values[c];
}

static void put_row(FILE *out, const sl_camera *camera, const column *columns, size_t count) {
    char text[SL_NUMBER_TEXT];
    for (size_t i = 0; i < count; i++) {
        if (i) fputc(',', out);
        if (columns[i] == COLUMN_NAME) {
            if (camera->name) sl_table_text_write(out, camera->name, true);
            continue;
        }
        sl_number_write(value_of(camera, columns[i]), text);
        fputs(text, out);
    }
    fputc('\n', out);
}

void sl_cameras_print(const sl_cameras *cameras, FILE *out) {
    static const column order[COLUMNS] = {
        COLUMN_NAME,   COLUMN_X,    COLUMN_Y,       COLUMN_HEADING, COLUMN_FOV,  COLUMN_RANGE,
        COLUMN_HEIGHT, COLUMN_TILT, COLUMN_NEAREST, COLUMN_LETTERS, COLUMN_SIGN, COLUMN_COST};
    column columns[COLUMNS];
    size_t count = 0;
    for (size_t k = 0; k < COLUMNS; k++) {
        bool needed = order[k] == COLUMN_X || order[k] == COLUMN_Y;
        for (size_t i = 0; i < cameras->count && !needed; i++)
            needed = needs(&cameras->items[i], order[k]);
        if (needed) columns[count++] = order[k];
    }
    for (size_t k = 0; k < count; k++)
        fprintf(out, "%s%s", k ? "," : "", column_names[columns[k]][0]);
    fputc('\n', out);
    for (size_t i = 0; i < cameras->count && !ferror(out); i++)
        put_row(out, &cameras->items[i], columns, count);
}

sl_status sl_cameras_write(sl_context *context, const sl_cameras *cameras, const char *path) {
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    sl_cameras_print(cameras, output.stream);
    return sl_output_close(context, &output, SL_OK);
}

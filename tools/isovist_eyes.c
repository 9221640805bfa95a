#include "isovist_eyes.h"

#include "sightline/support.h"

#include <math.h>
#include <string.h>

enum { MOST_SQUARES = 1 << 26 };

void sl_eyes_destroy(sl_context *context, sl_eyes *eyes) {
    sl_free(context, eyes->list.items);
    sl_free(context, eyes->squares.items);
    *eyes = (sl_eyes){0};
}

sl_status sl_eyes_add(sl_context *context, sl_eyes *eyes, sl_eye eye) {
    SL_TRY(SL_ARRAY_ROOM(context, &eyes->list, 1));
    eyes->list.items[eyes->list.count++] = eye;
    return SL_OK;
}

sl_status sl_eyes_add_grid(sl_context *context, const sl_space *space, double step, sl_eye like,
                           sl_eyes *eyes) {
    const sl_box *b = &space->bounds;
    const double columns = ceil((b->max.x - b->min.x) / step);
    const double rows = ceil((b->max.y - b->min.y) / step);
    if (!(columns * rows <= MOST_SQUARES))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "a grid of step %g has %.0f squares; at most %d can be", step,
                       columns * rows, MOST_SQUARES);
    eyes->corner = b->min;
    eyes->step = step;
    eyes->columns = (size_t)columns;
    eyes->rows = (size_t)rows;
    for (size_t i = 0; i < eyes->columns * eyes->rows; i++) {
        if (i % 65536 == 0) SL_TRY(sl_check_cancelled(context));
        like.at.x = b->min.x + step * ((double)(i % eyes->columns) + 0.5);
        like.at.y = b->min.y + step * ((double)(i / eyes->columns) + 0.5);
        const uint32_t cell = sl_space_locate(space, like.at);
        if (cell == SL_NO_CELL || !space->cells[cell].inside) continue;
        SL_TRY(SL_ARRAY_ROOM(context, &eyes->squares, 1));
        eyes->squares.items[eyes->squares.count++] = i;
        SL_TRY(sl_eyes_add(context, eyes, like));
    }
    return SL_OK;
}

sl_status sl_eyes_add_path(sl_context *context, const sl_path *path, double step, sl_eye like,
                           sl_eyes *eyes) {
    double over = 0; // from the last eye to the point reached
    for (size_t i = 0; i < path->count; i++) {
        const sl_point to = path->points[i];
        if (i == 0 || step == 0) {
            like.at = to;
            SL_TRY(sl_eyes_add(context, eyes, like));
            continue;
        }
        const sl_point from = path->points[i - 1];
        const double length = hypot(to.x - from.x, to.y - from.y);
        if (length / step > MOST_SQUARES)
            return sl_fail(context, SL_BAD_ARGUMENT, "--step %g: too small for path '%s'", step,
                           path->name);
        double along = step - over;
        for (; along <= length; along += step) {
            like.at = (sl_point){from.x + along / length * (to.x - from.x),
                                 from.y + along / length * (to.y - from.y)};
            SL_TRY(sl_eyes_add(context, eyes, like));
        }
        over = length - (along - step);
    }
    return SL_OK;
}

/// The fields of a line as numbers; how many, or -1 where one is none.
static int read_fields(const char *line, size_t length, double fields[4]) {
    int count = 0;
    for (size_t at = 0; at <= length; count++) {
        const char *comma = memchr(line + at, ',', length - at);
        size_t end = comma ? (size_t)(comma - line) : length, start = at;
        at = end + 1;
        while (start < end && (line[start] == ' ' || line[start] == '\t')) start++;
        while (start < end && (line[end - 1] == ' ' || line[end - 1] == '\t')) end--;
        if (count == 4 || !sl_number_read(line + start, end - start, &fields[count]) ||
            !isfinite(fields[count]))
            return -1;
    }
    return count;
}

static bool is_blank(const char *line, size_t length) {
    for (size_t i = 0; i < length; i++)
        if (line[i] != ' ' && line[i] != '\t') return false;
    return true;
}

/// A line without a digit, which no numbers can be in.
static bool is_header(const char *line, size_t length) {
    for (size_t i = 0; i < length; i++)
        if (line[i] >= '0' && line[i] <= '9') return false;
    return true;
}

static sl_status read_line(sl_context *context, const char *path, unsigned number, const char *line,
                           size_t length, const sl_space *space, sl_eye like, sl_eyes *eyes) {
    double fields[4] = {0, 0, like.look, like.fov};
    const int count = read_fields(line, length, fields);
    if (count < 2)
        return sl_fail_at(context, path, number,
                          "two to four finite numbers are needed: x, y, angle, field of view");
    const sl_eye eye = {{fields[0], fields[1]}, fields[2], fields[3]};
    if (!(eye.fov >= 0 && eye.fov <= 360))
        return sl_fail_at(context, path, number, "the field of view must be 0 to 360 degrees");
    if (sl_space_locate(space, eye.at) == SL_NO_CELL)
        return sl_fail_at(context, path, number, "the point lies outside the map");
    return sl_eyes_add(context, eyes, eye);
}

sl_status sl_eyes_read_csv(sl_context *context, const char *path, const sl_space *space,
                           sl_eye like, sl_eyes *eyes) {
    sl_bytes text;
    SL_TRY(sl_file_read(context, path, &text));
    sl_status status = SL_OK;
    unsigned number = 0;
    for (size_t at = 0; at < text.size && status == SL_OK;) {
        const char *line = text.data + at, *end = memchr(line, '\n', text.size - at);
        size_t length = end ? (size_t)(end - line) : text.size - at;
        at += length + 1;
        if (length && line[length - 1] == '\r') length--;
        number++;
        if (is_blank(line, length) || (number == 1 && is_header(line, length))) continue;
        status = read_line(context, path, number, line, length, space, like, eyes);
    }
    sl_free(context, text.data);
    return status;
}

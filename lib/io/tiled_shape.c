#include "io/tiled_shape.h"

#include "map/scan.h"

static const double full_turn = 6.28318530717958647692;

sl_status sl_tiled_read_shape(const sl_json *object, sl_tiled_shape *shape) {
    SL_TRY(sl_json_object(object));
    sl_tiled_shape read = {.kind = SL_TILED_RECTANGLE};
    const struct {
        const char *key;
        double *to;
    } numbers[] = {
        {"x", &read.x},
        {"y", &read.y},
        {"width", &read.width},
        {"height", &read.height},
        {"rotation", &read.rotation},
    };
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        const sl_json number = sl_json_member(object, numbers[i].key);
        SL_TRY(sl_json_number_if(&number, numbers[i].to));
    }
    const sl_json gid = sl_json_member(object, "gid"), line = sl_json_member(object, SL_JSON_LINE);
    int64_t whole = 0;
    SL_TRY(sl_json_whole_if(&gid, 0, UINT32_MAX, &whole));
    read.gid = (uint32_t)whole;
    read.line = (uint32_t)json_integer_value(line.value);
    if (read.gid) read.kind = SL_TILED_PICTURE;
    static const struct {
        const char *key;
        sl_tiled_kind kind;
    } kinds[] = {
        {"ellipse", SL_TILED_ELLIPSE},   {"polygon", SL_TILED_POLYGON},
        {"polyline", SL_TILED_POLYLINE}, {"point", SL_TILED_OTHER},
        {"text", SL_TILED_OTHER},        {"capsule", SL_TILED_OTHER},
        {"template", SL_TILED_OTHER},
    };
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const sl_json mark = sl_json_member(object, kinds[i].key);
        if (!mark.value || json_is_false(mark.value)) continue;
        read.kind = kinds[i].kind;
        read.points = mark;
    }
    *shape = read;
    return SL_OK;
}

/// A walk over a shape's points: an array of objects with x and y, or the text "x,y x,y".
typedef struct walk {
    const sl_json *points;
    size_t next;
    const char *at;
} walk;

static sl_status read_text_number(walk *steps, double *number) {
    const size_t length = strcspn(steps->at, ", \t\r\n");
    const sl_word word = {steps->at, length};
    if (!sl_number_read(word.at, word.length, number) || !sl_coordinate_usable(*number))
        return sl_json_fail(steps->points, "point %zu: expected x,y; found '%s'", steps->next + 1,
                            sl_show(word).text);
    steps->at += length;
    return SL_OK;
}

static sl_status next_text_point(walk *steps, sl_point *point, bool *any) {
    steps->at += strspn(steps->at, " \t\r\n");
    *any = *steps->at != '\0';
    if (!*any) return SL_OK;
    SL_TRY(read_text_number(steps, &point->x));
    steps->at += *steps->at == ',';
    SL_TRY(read_text_number(steps, &point->y));
    steps->next++;
    return SL_OK;
}

/// The next point; `*any` is false at the end.
static sl_status next_point(walk *steps, sl_point *point, bool *any) {
    if (steps->at) return next_text_point(steps, point, any);
    *any = steps->next < json_array_size(steps->points->value);
    if (!*any) return SL_OK;
    const sl_json item = sl_json_item(steps->points, steps->next++);
    SL_TRY(sl_json_object(&item));
    const sl_json x = sl_json_member(&item, "x"), y = sl_json_member(&item, "y");
    SL_TRY(sl_json_number(&x, &point->x));
    return sl_json_number(&y, &point->y);
}

static sl_status draw_points(sl_pen *pen, const sl_tiled_shape *shape) {
    walk steps = {.points = &shape->points};
    if (json_is_string(shape->points.value))
        steps.at = json_string_value(shape->points.value);
    else if (!json_is_array(shape->points.value))
        return sl_json_fail(&shape->points, "expected a list of points");
    const size_t least = shape->kind == SL_TILED_POLYGON ? 3 : 2;
    sl_point first = {0};
    for (;;) {
        sl_point point;
        bool any;
        SL_TRY(next_point(&steps, &point, &any));
        if (!any) break;
        if (steps.next == 1)
            pen->at = first = point;
        else
            SL_TRY(sl_pen_line(pen, point));
    }
    if (steps.next < least)
        return sl_json_fail(&shape->points, "%zu points, at least %zu are needed", steps.next,
                            least);
    return shape->kind == SL_TILED_POLYGON ? sl_pen_line(pen, first) : SL_OK;
}

/// The corners in the order of the box's sides; `top` is over the shape's place for a picture.
static sl_status draw_box(sl_pen *pen, double width, double top, double bottom) {
    const sl_point corners[] = {{width, top}, {width, bottom}, {0, bottom}, {0, top}};
    pen->at = corners[3];
    for (size_t i = 0; i < 4; i++) SL_TRY(sl_pen_line(pen, corners[i]));
    return SL_OK;
}

static sl_status draw_ellipse(sl_pen *pen, double width, double height) {
    const double a = width / 2, b = height / 2;
    pen->at = (sl_point){width, b};
    return sl_pen_arc(pen, (sl_point){a, b}, (sl_point){a, 0}, (sl_point){0, b}, full_turn,
                      pen->at);
}

sl_status sl_tiled_draw_shape(sl_pen *pen, const sl_tiled_shape *shape) {
    const sl_affine outer = pen->affine;
    sl_affine turn = sl_affine_turn(shape->rotation);
    turn.x0 = shape->x;
    turn.y0 = shape->y;
    pen->affine = sl_affine_after(outer, turn);
    pen->line = shape->line;
    sl_status status = SL_OK;
    switch (shape->kind) {
    case SL_TILED_RECTANGLE:
        status = draw_box(pen, shape->width, 0, shape->height);
        break;
    case SL_TILED_PICTURE:
        status = draw_box(pen, shape->width, -shape->height, 0);
        break;
    case SL_TILED_ELLIPSE:
        status = draw_ellipse(pen, shape->width, shape->height);
        break;
    case SL_TILED_POLYGON:
    case SL_TILED_POLYLINE:
        status = draw_points(pen, shape);
        break;
    case SL_TILED_OTHER:
        break;
    }
    pen->affine = outer;
    return status;
}

/// Numbers and paths of SVG: lines, Béziers and arcs, with all the shorter ways to write them.
#include "io/svg/svg_path.h"

#include "base/base.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

// --- numbers

sli_svg_text sli_svg_text_of(const char *text, const char *what) {
    return (sli_svg_text){.at = text, .end = text + strlen(text), .what = what};
}

void sli_svg_skip_space(sli_svg_text *text) {
    while (text->at < text->end && strchr(" \t\r\n\f", *text->at)) text->at++;
}

void sli_svg_skip(sli_svg_text *text) {
    sli_svg_skip_space(text);
    if (text->at < text->end && *text->at == ',') text->at++;
    sli_svg_skip_space(text);
}

sl_status sli_svg_fail(const sli_pen *pen, sli_svg_text *text, const char *expected) {
    text->wrong = true;
    const sli_word rest = {text->at, (size_t)(text->end - text->at)};
    return sl_fail_at(pen->context, pen->name, pen->line, "%s: expected %s, found %s%s%s",
                      text->what, expected, rest.length ? "'" : "",
                      rest.length ? sli_show(rest).text : "the end", rest.length ? "'" : "");
}

sl_status sli_svg_number(const sli_pen *pen, sli_svg_text *text, double *value) {
    sli_svg_skip(text);
    const size_t length = sli_number_length(text->at, (size_t)(text->end - text->at));
    if (!length || !sl_number_read(text->at, length, value) || !isfinite(*value))
        return sli_svg_fail(pen, text, "a number");
    text->at += length;
    return SL_OK;
}

sl_status sli_svg_coordinate(sli_pen *pen, sli_svg_text *text, double *value) {
    sli_svg_skip(text);
    const char *begin = text->at;
    SL_TRY(sli_svg_number(pen, text, value));
    sli_pen_digits(pen, begin, (size_t)(text->at - begin), 1);
    return SL_OK;
}

// --- paths

typedef struct path {
    sli_pen *pen;
    sli_svg_text text;
    sl_point start;   ///< of the subpath
    sl_point control; ///< the last curve's, which smooth ones mirror
    char before;      ///< the command before, in capitals
} path;

/// A flag of an arc: one digit, which may stand right before the next number.
static sl_status read_flag(path *p, bool *flag) {
    sli_svg_skip(&p->text);
    if (p->text.at == p->text.end || (*p->text.at != '0' && *p->text.at != '1'))
        return sli_svg_fail(p->pen, &p->text, "a flag, 0 or 1");
    *flag = *p->text.at++ == '1';
    return SL_OK;
}

static sl_status read_point(path *p, bool relative, sl_point *point) {
    SL_TRY(sli_svg_coordinate(p->pen, &p->text, &point->x));
    SL_TRY(sli_svg_coordinate(p->pen, &p->text, &point->y));
    if (relative) {
        point->x += p->pen->at.x;
        point->y += p->pen->at.y;
    }
    return SL_OK;
}

static sl_point mirrored(sl_point point, sl_point at) {
    return (sl_point){2 * at.x - point.x, 2 * at.y - point.y};
}

static sl_status draw_cubic(path *p, bool smooth, bool relative) {
    sl_point first = strchr("CS", p->before) ? mirrored(p->control, p->pen->at) : p->pen->at;
    sl_point second, to;
    if (!smooth) SL_TRY(read_point(p, relative, &first));
    SL_TRY(read_point(p, relative, &second));
    SL_TRY(read_point(p, relative, &to));
    p->control = second;
    return sli_pen_cubic(p->pen, first, second, to);
}

static sl_status draw_quadratic(path *p, bool smooth, bool relative) {
    const sl_point from = p->pen->at;
    sl_point control = strchr("QT", p->before) ? mirrored(p->control, from) : from, to;
    if (!smooth) SL_TRY(read_point(p, relative, &control));
    SL_TRY(read_point(p, relative, &to));
    p->control = control;
    const sl_point first = {from.x + (control.x - from.x) * 2 / 3,
                            from.y + (control.y - from.y) * 2 / 3};
    const sl_point second = {to.x + (control.x - to.x) * 2 / 3, to.y + (control.y - to.y) * 2 / 3};
    return sli_pen_cubic(p->pen, first, second, to);
}

/// From two ends and radii to a centre (SVG 1.1, F.6.5), in the frame where the ellipse is the unit
/// circle.
static sl_status draw_ellipse_arc(path *p, sl_point radii, double turn, bool large, bool sweeps,
                                  sl_point to) {
    const sl_point from = p->pen->at;
    if (radii.x == 0 || radii.y == 0 || (from.x == to.x && from.y == to.y))
        return sli_pen_line(p->pen, to);
    double rx = fabs(radii.x), ry = fabs(radii.y);
    const sli_affine along = sli_affine_turn(turn);
    const double dx = (from.x - to.x) / 2, dy = (from.y - to.y) / 2;
    double x = (along.xx * dx + along.yx * dy) / rx, y = (along.xy * dx + along.yy * dy) / ry;
    const double half = hypot(x, y);
    if (half > 1) {
        rx *= half;
        ry *= half;
        x /= half;
        y /= half;
    }
    const double length = fmin(half, 1);
    const double away = sqrt(1 - length * length) / length * (large == sweeps ? -1 : 1);
    const double cx = away * y, cy = -away * x;
    const double begin = atan2(y - cy, x - cx), end = atan2(-y - cy, -x - cx);
    double angle = end - begin;
    if (sweeps && angle < 0) angle += 2 * pi;
    if (!sweeps && angle > 0) angle -= 2 * pi;
    const sl_point u = {along.xx * rx, along.yx * rx}, v = {along.xy * ry, along.yy * ry};
    const sl_point centre = {(from.x + to.x) / 2 + cx * u.x + cy * v.x,
                             (from.y + to.y) / 2 + cx * u.y + cy * v.y};
    const double c = cos(begin), s = sin(begin);
    return sli_pen_arc(p->pen, centre, (sl_point){c * u.x + s * v.x, c * u.y + s * v.y},
                       (sl_point){c * v.x - s * u.x, c * v.y - s * u.y}, angle, to);
}

static sl_status draw_arc(path *p, bool relative) {
    sl_point radii, to;
    double turn = 0;
    bool large = false, sweeps = false;
    SL_TRY(read_point(p, false, &radii));
    SL_TRY(sli_svg_number(p->pen, &p->text, &turn));
    SL_TRY(read_flag(p, &large));
    SL_TRY(read_flag(p, &sweeps));
    SL_TRY(read_point(p, relative, &to));
    return draw_ellipse_arc(p, radii, turn, large, sweeps, to);
}

static sl_status draw_straight(path *p, char command, bool relative) {
    sl_point to = p->pen->at;
    double value;
    if (command == 'L') {
        SL_TRY(read_point(p, relative, &to));
        return sli_pen_line(p->pen, to);
    }
    SL_TRY(sli_svg_coordinate(p->pen, &p->text, &value));
    if (command == 'H')
        to.x = relative ? to.x + value : value;
    else
        to.y = relative ? to.y + value : value;
    return sli_pen_line(p->pen, to);
}

static sl_status draw_command(path *p, char command, bool relative) {
    switch (command) {
    case 'M':
        SL_TRY(read_point(p, relative, &p->start));
        p->pen->at = p->start;
        return SL_OK;
    case 'Z': {
        const sl_point at = p->pen->at;
        const bool there = at.x == p->start.x && at.y == p->start.y;
        return there ? SL_OK : sli_pen_line(p->pen, p->start);
    }
    case 'C':
    case 'S':
        return draw_cubic(p, command == 'S', relative);
    case 'Q':
    case 'T':
        return draw_quadratic(p, command == 'T', relative);
    case 'A':
        return draw_arc(p, relative);
    default:
        return draw_straight(p, command, relative);
    }
}

static sl_status draw_all(path *p) {
    sli_pen *pen = p->pen;
    char command = 0;
    pen->at = (sl_point){0, 0};
    for (sli_svg_skip(&p->text); p->text.at < p->text.end; sli_svg_skip(&p->text)) {
        const bool named = (*p->text.at | 0x20) >= 'a' && (*p->text.at | 0x20) <= 'z';
        if (named) {
            command = *p->text.at;
            if (!strchr("MmZzLlHhVvCcSsQqTtAa", command) ||
                (!p->before && (command & ~0x20) != 'M'))
                return sli_svg_fail(pen, &p->text,
                                    p->before ? "one of MZLHVCSQTA" : "an M to start with");
            p->text.at++;
        } else if (!command || (command & ~0x20) == 'Z') {
            return sli_svg_fail(pen, &p->text, "a command");
        }
        const char capital = (char)(command & ~0x20);
        // Numbers behind those of a move are lines.
        const bool line = capital == 'M' && !named;
        SL_TRY(draw_command(p, line ? 'L' : capital, (command & 0x20) != 0));
        p->before = line ? 'L' : capital;
    }
    return SL_OK;
}

sl_status sli_svg_path(sli_pen *pen, const char *data, bool *wrong) {
    path p = {.pen = pen, .text = sli_svg_text_of(data, "path data")};
    const sl_status status = draw_all(&p);
    *wrong = status == SL_BAD_INPUT && p.text.wrong;
    return *wrong ? SL_OK : status;
}

// What SVG writes in attributes: numbers, transforms, and the commands of a path.
#include "io/svg.h"

#include "map/scan.h"
#include "sightline/support.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

sl_svg_text sl_svg_text_of(const char *text, const char *what) {
    return (sl_svg_text){.at = text, .end = text + strlen(text), .what = what};
}

static void skip_space(sl_svg_text *text) {
    while (text->at < text->end && strchr(" \t\r\n\f", *text->at)) text->at++;
}

void sl_svg_skip(sl_svg_text *text) {
    skip_space(text);
    if (text->at < text->end && *text->at == ',') text->at++;
    skip_space(text);
}

static sl_status fail_expected(const sl_pen *pen, const sl_svg_text *text, const char *expected) {
    const sl_word rest = {text->at, (size_t)(text->end - text->at)};
    return sl_fail_at(pen->context, pen->name, pen->line, "%s: expected %s, found %s%s%s",
                      text->what, expected, rest.length ? "'" : "",
                      rest.length ? sl_show(rest).text : "the end", rest.length ? "'" : "");
}

sl_status sl_svg_number(const sl_pen *pen, sl_svg_text *text, double *value) {
    sl_svg_skip(text);
    const size_t length = sl_number_length(text->at, (size_t)(text->end - text->at));
    if (!length || !sl_number_read(text->at, length, value) || !isfinite(*value))
        return fail_expected(pen, text, "a number");
    text->at += length;
    return SL_OK;
}

// --- transforms

static sl_affine skewed(bool x, double degrees) {
    const double slope = tan(degrees * (pi / 180));
    return (sl_affine){.xx = 1, .xy = x ? slope : 0, .yx = x ? 0 : slope, .yy = 1};
}

static sl_affine moved(double x, double y) {
    return (sl_affine){.xx = 1, .x0 = x, .yy = 1, .y0 = y};
}

/// What a transform's name and numbers mean; false where there is none of that name and number.
static bool make_transform(sl_word name, const double n[6], int count, sl_affine *out) {
    if (sl_word_is(name, "matrix") && count == 6)
        *out = (sl_affine){n[0], n[2], n[4], n[1], n[3], n[5]};
    else if (sl_word_is(name, "translate") && (count == 1 || count == 2))
        *out = moved(n[0], count == 2 ? n[1] : 0);
    else if (sl_word_is(name, "scale") && (count == 1 || count == 2))
        *out = (sl_affine){.xx = n[0], .yy = count == 2 ? n[1] : n[0]};
    else if (sl_word_is(name, "rotate") && (count == 1 || count == 3))
        *out =
            sl_affine_after(moved(count == 3 ? n[1] : 0, count == 3 ? n[2] : 0),
                            sl_affine_after(sl_affine_turn(n[0]),
                                            moved(count == 3 ? -n[1] : 0, count == 3 ? -n[2] : 0)));
    else if ((sl_word_is(name, "skewX") || sl_word_is(name, "skewY")) && count == 1)
        *out = skewed(sl_word_is(name, "skewX"), n[0]);
    else
        return false;
    return true;
}

sl_status sl_svg_transform(const sl_pen *pen, const char *data, sl_affine *affine) {
    sl_svg_text text = sl_svg_text_of(data, "transform");
    *affine = SL_AFFINE_NONE;
    for (sl_svg_skip(&text); text.at < text.end; sl_svg_skip(&text)) {
        sl_word name = {text.at, 0};
        while (text.at < text.end && ((*text.at | 0x20) >= 'a' && (*text.at | 0x20) <= 'z'))
            text.at++, name.length++;
        skip_space(&text);
        if (text.at == text.end || *text.at != '(') return fail_expected(pen, &text, "'('");
        text.at++;
        double numbers[6] = {0};
        int count = 0;
        for (sl_svg_skip(&text); text.at < text.end && *text.at != ')'; sl_svg_skip(&text)) {
            if (count == 6) return fail_expected(pen, &text, "')'");
            SL_TRY(sl_svg_number(pen, &text, &numbers[count++]));
        }
        if (text.at == text.end) return fail_expected(pen, &text, "')'");
        text.at++;
        sl_affine one;
        if (!make_transform(name, numbers, count, &one))
            return sl_fail_at(pen->context, pen->name, pen->line,
                              "transform: there is no '%s' of %d numbers", sl_show(name).text,
                              count);
        *affine = sl_affine_after(*affine, one);
    }
    return SL_OK;
}

// --- paths

typedef struct path {
    sl_pen *pen;
    sl_svg_text text;
    sl_point start;   ///< of the subpath
    sl_point control; ///< the last curve's, which smooth ones mirror
    char before;      ///< the command before, in capitals
} path;

/// A flag of an arc: one digit, which may stand right before the next number.
static sl_status read_flag(path *p, bool *flag) {
    sl_svg_skip(&p->text);
    if (p->text.at == p->text.end || (*p->text.at != '0' && *p->text.at != '1'))
        return fail_expected(p->pen, &p->text, "a flag, 0 or 1");
    *flag = *p->text.at++ == '1';
    return SL_OK;
}

static sl_status read_point(path *p, bool relative, sl_point *point) {
    SL_TRY(sl_svg_number(p->pen, &p->text, &point->x));
    SL_TRY(sl_svg_number(p->pen, &p->text, &point->y));
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
    return sl_pen_cubic(p->pen, first, second, to);
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
    return sl_pen_cubic(p->pen, first, second, to);
}

/// From two ends and radii to a centre (SVG 1.1, F.6.5), in the frame where the ellipse is the unit
/// circle.
static sl_status draw_ellipse_arc(path *p, sl_point radii, double turn, bool large, bool sweeps,
                                  sl_point to) {
    const sl_point from = p->pen->at;
    if (radii.x == 0 || radii.y == 0 || (from.x == to.x && from.y == to.y))
        return sl_pen_line(p->pen, to);
    double rx = fabs(radii.x), ry = fabs(radii.y);
    const sl_affine along = sl_affine_turn(turn);
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
    return sl_pen_arc(p->pen, centre, (sl_point){c * u.x + s * v.x, c * u.y + s * v.y},
                      (sl_point){c * v.x - s * u.x, c * v.y - s * u.y}, angle, to);
}

static sl_status draw_arc(path *p, bool relative) {
    sl_point radii, to;
    double turn = 0;
    bool large = false, sweeps = false;
    SL_TRY(read_point(p, false, &radii));
    SL_TRY(sl_svg_number(p->pen, &p->text, &turn));
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
        return sl_pen_line(p->pen, to);
    }
    SL_TRY(sl_svg_number(p->pen, &p->text, &value));
    if (command == 'H')
        to.x = relative ? to.x + value : value;
    else
        to.y = relative ? to.y + value : value;
    return sl_pen_line(p->pen, to);
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
        return there ? SL_OK : sl_pen_line(p->pen, p->start);
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

sl_status sl_svg_path(sl_pen *pen, const char *data) {
    path p = {.pen = pen, .text = sl_svg_text_of(data, "path data")};
    char command = 0;
    pen->at = (sl_point){0, 0};
    for (sl_svg_skip(&p.text); p.text.at < p.text.end; sl_svg_skip(&p.text)) {
        const bool named = (*p.text.at | 0x20) >= 'a' && (*p.text.at | 0x20) <= 'z';
        if (named) {
            command = *p.text.at;
            if (!strchr("MmZzLlHhVvCcSsQqTtAa", command) || (!p.before && (command & ~0x20) != 'M'))
                return fail_expected(pen, &p.text,
                                     p.before ? "one of MZLHVCSQTA" : "an M to start with");
            p.text.at++;
        } else if (!command || (command & ~0x20) == 'Z') {
            return fail_expected(pen, &p.text, "a command");
        }
        const char capital = (char)(command & ~0x20);
        // Numbers behind those of a move are lines.
        const bool line = capital == 'M' && !named;
        SL_TRY(draw_command(&p, line ? 'L' : capital, (command & 0x20) != 0));
        p.before = line ? 'L' : capital;
    }
    return SL_OK;
}

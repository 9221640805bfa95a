/// SVG (W3C, SVG 1.1): the outline of every line, polyline, polygon, rect, circle, ellipse and path
/// is walls, through the transforms of its groups. Hidden shapes and those of other layers are left
/// out. A use draws another element once more, so depth and work are bounded. Groups whose names
/// begin with "sightline-" hold doors, solid ground and so on (layers.h).
#include "base/base.h"
#include "io/io_formats.h"
#include "io/parts/contents.h"
#include "io/parts/document.h"
#include "io/parts/layers.h"
#include "io/parts/names.h"
#include "io/parts/shapes.h"
#include "io/svg/svg_count.h"
#include "io/svg/svg_group.h"
#include "io/svg/svg_style.h"
#include "map/scan.h"
#include "map/source.h"
#include "sightline/io.h"
#include "sightline/support.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

// --- attributes: numbers, transforms, paths

/// A walk over the text of an attribute.
typedef struct svg_text {
    const char *at, *end;
    const char *what; ///< the attribute, for messages
} svg_text;

static svg_text svg_text_of(const char *text, const char *what) {
    return (svg_text){.at = text, .end = text + strlen(text), .what = what};
}

static void skip_space(svg_text *text) {
    while (text->at < text->end && strchr(" \t\r\n\f", *text->at)) text->at++;
}

/// Passes over white space and at most one comma.
static void svg_skip(svg_text *text) {
    skip_space(text);
    if (text->at < text->end && *text->at == ',') text->at++;
    skip_space(text);
}

static sl_status fail_expected(const sli_pen *pen, const svg_text *text, const char *expected) {
    const sli_word rest = {text->at, (size_t)(text->end - text->at)};
    return sl_fail_at(pen->context, pen->name, pen->line, "%s: expected %s, found %s%s%s",
                      text->what, expected, rest.length ? "'" : "",
                      rest.length ? sli_show(rest).text : "the end", rest.length ? "'" : "");
}

/// The next number. SL_BAD_INPUT, at the pen's line, where there is none.
static sl_status svg_number(const sli_pen *pen, svg_text *text, double *value) {
    svg_skip(text);
    const size_t length = sli_number_length(text->at, (size_t)(text->end - text->at));
    if (!length || !sl_number_read(text->at, length, value) || !isfinite(*value))
        return fail_expected(pen, text, "a number");
    text->at += length;
    return SL_OK;
}

/// The next number, as a coordinate of what is drawn.
static sl_status svg_coordinate(sli_pen *pen, svg_text *text, double *value) {
    svg_skip(text);
    const char *begin = text->at;
    SL_TRY(svg_number(pen, text, value));
    sli_pen_digits(pen, begin, (size_t)(text->at - begin), 1);
    return SL_OK;
}

// --- transforms

static sli_affine skewed(bool x, double degrees) {
    const double slope = tan(degrees * (pi / 180));
    return (sli_affine){.xx = 1, .xy = x ? slope : 0, .yx = x ? 0 : slope, .yy = 1};
}

static sli_affine moved(double x, double y) {
    return (sli_affine){.xx = 1, .x0 = x, .yy = 1, .y0 = y};
}

/// What a transform's name and numbers mean; false where there is none of that name and number.
static bool make_transform(sli_word name, const double n[6], int count, sli_affine *out) {
    if (sli_word_is(name, "matrix") && count == 6)
        *out = (sli_affine){n[0], n[2], n[4], n[1], n[3], n[5]};
    else if (sli_word_is(name, "translate") && (count == 1 || count == 2))
        *out = moved(n[0], count == 2 ? n[1] : 0);
    else if (sli_word_is(name, "scale") && (count == 1 || count == 2))
        *out = (sli_affine){.xx = n[0], .yy = count == 2 ? n[1] : n[0]};
    else if (sli_word_is(name, "rotate") && (count == 1 || count == 3))
        *out = sli_affine_after(
            moved(count == 3 ? n[1] : 0, count == 3 ? n[2] : 0),
            sli_affine_after(sli_affine_turn(n[0]),
                             moved(count == 3 ? -n[1] : 0, count == 3 ? -n[2] : 0)));
    else if ((sli_word_is(name, "skewX") || sli_word_is(name, "skewY")) && count == 1)
        *out = skewed(sli_word_is(name, "skewX"), n[0]);
    else
        return false;
    return true;
}

/// Reads a list of transforms: matrix, translate, scale, rotate, skewX, skewY (SVG 1.1, 7.6).
static sl_status svg_transform(const sli_pen *pen, const char *data, sli_affine *affine) {
    svg_text text = svg_text_of(data, "transform");
    *affine = SLI_AFFINE_NONE;
    for (svg_skip(&text); text.at < text.end; svg_skip(&text)) {
        sli_word name = {text.at, 0};
        while (text.at < text.end && ((*text.at | 0x20) >= 'a' && (*text.at | 0x20) <= 'z'))
            text.at++, name.length++;
        skip_space(&text);
        if (text.at == text.end || *text.at != '(') return fail_expected(pen, &text, "'('");
        text.at++;
        double numbers[6] = {0};
        int count = 0;
        for (svg_skip(&text); text.at < text.end && *text.at != ')'; svg_skip(&text)) {
            if (count == 6) return fail_expected(pen, &text, "')'");
            SL_TRY(svg_number(pen, &text, &numbers[count++]));
        }
        if (text.at == text.end) return fail_expected(pen, &text, "')'");
        text.at++;
        sli_affine one;
        if (!make_transform(name, numbers, count, &one))
            return sl_fail_at(pen->context, pen->name, pen->line,
                              "transform: there is no '%s' of %d numbers", sli_show(name).text,
                              count);
        *affine = sli_affine_after(*affine, one);
    }
    return SL_OK;
}

// --- paths

typedef struct path {
    sli_pen *pen;
    svg_text text;
    sl_point start;   ///< of the subpath
    sl_point control; ///< the last curve's, which smooth ones mirror
    char before;      ///< the command before, in capitals
} path;

/// A flag of an arc: one digit, which may stand right before the next number.
static sl_status read_flag(path *p, bool *flag) {
    svg_skip(&p->text);
    if (p->text.at == p->text.end || (*p->text.at != '0' && *p->text.at != '1'))
        return fail_expected(p->pen, &p->text, "a flag, 0 or 1");
    *flag = *p->text.at++ == '1';
    return SL_OK;
}

static sl_status read_point(path *p, bool relative, sl_point *point) {
    SL_TRY(svg_coordinate(p->pen, &p->text, &point->x));
    SL_TRY(svg_coordinate(p->pen, &p->text, &point->y));
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
    SL_TRY(svg_number(p->pen, &p->text, &turn));
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
    SL_TRY(svg_coordinate(p->pen, &p->text, &value));
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

/// Draws a path's data, all commands (SVG 1.1, 8.3).
static sl_status svg_path(sli_pen *pen, const char *data) {
    path p = {.pen = pen, .text = svg_text_of(data, "path data")};
    char command = 0;
    pen->at = (sl_point){0, 0};
    for (svg_skip(&p.text); p.text.at < p.text.end; svg_skip(&p.text)) {
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

// --- elements

typedef struct svg {
    sl_context *context;
    const sl_import_options *options;
    xmlDoc *document;
    sli_svg_style style;
    sli_svg_ids ids;
    sli_pen pen;
    sli_contents contents;
    size_t work, shapes, hidden, other;
    char *mark;     ///< the sum of the digits that the file's writer knew
    bool by_number; ///< walls have the number of their shape in place of its line
} svg;

/// Where an element stands.
typedef struct place {
    sli_affine affine;
    bool taken; ///< on a layer that is asked for
    sli_layer layer;
    uint32_t group; ///< that it belongs to by name
    unsigned depth;
} place;

static sl_status draw_element(svg *s, xmlNode *node, place at);

// --- attributes

/// A length: a number with a unit, in user units (SVG 1.1, 7.10: 96 a CSS inch).
static sl_status read_length(svg *s, xmlNode *node, const char *name, double *value) {
    static const struct {
        const char *name;
        double size;
    } units[] = {{"", 1},           {"px", 1},         {"in", 96},      {"cm", 96 / 2.54},
                 {"mm", 96 / 25.4}, {"pt", 96.0 / 72}, {"pc", 96.0 / 6}};
    char *text = sli_xml_attribute(node, name);
    if (!text) return SL_OK;
    svg_text scan = svg_text_of(text, name);
    double number = 0;
    skip_space(&scan);
    const char *begin = scan.at;
    sl_status status = svg_number(&s->pen, &scan, &number);
    const size_t written = (size_t)(scan.at - begin);
    if (status == SL_OK) {
        size_t length = strcspn(scan.at, " \t\r\n"), i = 0;
        const sli_word unit = {scan.at, length};
        while (i < sizeof units / sizeof *units && !sli_word_is(unit, units[i].name)) i++;
        if (i < sizeof units / sizeof *units) {
            *value = number * units[i].size;
            sli_pen_digits(&s->pen, begin, written, units[i].size);
        } else {
            status = sl_fail_at(s->context, s->pen.name, s->pen.line,
                                "%s: the unit '%s' is not known here (px, in, cm, mm, pt, pc are)",
                                name, sli_show(unit).text);
        }
    }
    sli_xml_free(text);
    return status;
}

/// A share of a window that a map has not.
static bool has_percent(xmlNode *node, const char *name) {
    char *text = sli_xml_attribute(node, name);
    const bool percent = text && strchr(text, '%');
    sli_xml_free(text);
    return percent;
}

static bool attribute_is(xmlNode *node, const char *name, const char *value) {
    char *text = sli_xml_attribute(node, name);
    const bool same = text && strcmp(text, value) == 0;
    sli_xml_free(text);
    return same;
}

static bool names_layer(const char *list, const char *name) {
    return name && sli_layers_have(list, name);
}

/// Whether the group's id or label is among the layers asked for.
static bool is_layer(const svg *s, xmlNode *node) {
    char *id = sli_xml_attribute(node, "id"), *label = sli_xml_attribute(node, "label");
    const bool is = names_layer(s->options->layers, id) || names_layer(s->options->layers, label);
    sli_xml_free(id);
    sli_xml_free(label);
    return is;
}

// --- layers that are asked for and not there

/// Looks for an element of a name, and lists the names of all groups, the label before the id.
static bool has_layer(xmlNode *parent, sli_word wanted, sli_name_list *there) {
    bool found = false;
    for (xmlNode *node = parent->children; node; node = node->next) {
        if (node->type != XML_ELEMENT_NODE) continue;
        char *id = sli_xml_attribute(node, "id"), *label = sli_xml_attribute(node, "label");
        const char *shown = label ? label : id;
        found |= (id && sli_word_is(wanted, id)) || (label && sli_word_is(wanted, label));
        if (shown && strcmp((const char *)node->name, "g") == 0)
            sli_name_list_add(there, (sli_word){shown, strlen(shown)});
        sli_xml_free(id);
        sli_xml_free(label);
        found |= has_layer(node, wanted, there);
    }
    return found;
}

static sl_status check_layers(const svg *s, xmlNode *root) {
    const char *list = s->options->layers;
    for (sli_word wanted; list && sli_layers_next(&list, &wanted);) {
        sli_name_list there = {.full = false};
        if (!has_layer(root, wanted, &there))
            return sli_fail_layer(s->context, s->pen.name, wanted, "drawing", &there);
    }
    return SL_OK;
}

// --- shapes

static sl_status draw_points(svg *s, xmlNode *node, bool closed) {
    char *data = sli_xml_attribute(node, "points");
    if (!data) return SL_OK;
    svg_text text = svg_text_of(data, "points");
    sl_point first = {0, 0};
    sl_status status = SL_OK;
    size_t count = 0;
    for (svg_skip(&text); status == SL_OK && text.at < text.end; svg_skip(&text)) {
        sl_point to;
        status = svg_coordinate(&s->pen, &text, &to.x);
        if (status == SL_OK) status = svg_coordinate(&s->pen, &text, &to.y);
        if (status != SL_OK) break;
        if (count++)
            status = sli_pen_line(&s->pen, to);
        else
            first = s->pen.at = to;
    }
    if (status == SL_OK && closed && count > 2) status = sli_pen_line(&s->pen, first);
    sli_xml_free(data);
    return status;
}

static sl_status draw_line(svg *s, xmlNode *node) {
    sl_point to = {0, 0};
    s->pen.at = to;
    SL_TRY(read_length(s, node, "x1", &s->pen.at.x));
    SL_TRY(read_length(s, node, "y1", &s->pen.at.y));
    SL_TRY(read_length(s, node, "x2", &to.x));
    SL_TRY(read_length(s, node, "y2", &to.y));
    return sli_pen_line(&s->pen, to);
}

/// A quarter of an ellipse at a rectangle's corner.
static sl_status draw_corner(svg *s, sl_point centre, sl_point to) {
    const sl_point from = s->pen.at;
    const sl_point u = {from.x - centre.x, from.y - centre.y};
    const sl_point v = {to.x - centre.x, to.y - centre.y};
    return sli_pen_arc(&s->pen, centre, u, v, pi / 2, to);
}

static sl_status draw_rect(svg *s, xmlNode *node) {
    double x = 0, y = 0, w = 0, h = 0, rx = -1, ry = -1;
    SL_TRY(read_length(s, node, "x", &x));
    SL_TRY(read_length(s, node, "y", &y));
    SL_TRY(read_length(s, node, "width", &w));
    SL_TRY(read_length(s, node, "height", &h));
    if (!(w > 0 && h > 0)) return SL_OK;
    SL_TRY(read_length(s, node, "rx", &rx));
    SL_TRY(read_length(s, node, "ry", &ry));
    if (rx < 0) rx = fmax(ry, 0);
    if (ry < 0) ry = rx;
    rx = fmin(rx, w / 2);
    ry = fmin(ry, h / 2);
    const bool round = rx > 0 && ry > 0;
    if (!round) rx = ry = 0;
    const sl_point low = {x, y}, high = {x + w, y + h};
    const sl_point ends[8] = {{low.x + rx, low.y},   {high.x - rx, low.y},  {high.x, low.y + ry},
                              {high.x, high.y - ry}, {high.x - rx, high.y}, {low.x + rx, high.y},
                              {low.x, high.y - ry},  {low.x, low.y + ry}};
    s->pen.at = ends[0];
    for (int side = 0; side < 4; side++) {
        const sl_point next = ends[(2 * side + 2) % 8];
        SL_TRY(sli_pen_line(&s->pen, ends[2 * side + 1]));
        const sl_point centre = {side == 0 || side == 1 ? high.x - rx : low.x + rx,
                                 side == 1 || side == 2 ? high.y - ry : low.y + ry};
        if (round) SL_TRY(draw_corner(s, centre, next));
    }
    return SL_OK;
}

static sl_status draw_round(svg *s, xmlNode *node, bool circle) {
    sl_point centre = {0, 0}, radii = {0, 0};
    SL_TRY(read_length(s, node, "cx", &centre.x));
    SL_TRY(read_length(s, node, "cy", &centre.y));
    SL_TRY(read_length(s, node, circle ? "r" : "rx", &radii.x));
    radii.y = radii.x;
    if (!circle) SL_TRY(read_length(s, node, "ry", &radii.y));
    if (!(radii.x > 0 && radii.y > 0)) return SL_OK;
    s->pen.at = (sl_point){centre.x + radii.x, centre.y};
    return sli_pen_arc(&s->pen, centre, (sl_point){radii.x, 0}, (sl_point){0, radii.y}, 2 * pi,
                       s->pen.at);
}

static sl_status draw_path(svg *s, xmlNode *node) {
    char *data = sli_xml_attribute(node, "d");
    if (!data) return SL_OK;
    const sl_status status = svg_path(&s->pen, data);
    sli_xml_free(data);
    return status;
}

typedef enum shape { LINE, POLYLINE, POLYGON, RECT, CIRCLE, ELLIPSE, PATH, NO_SHAPE } shape;

static shape shape_of(xmlNode *node) {
    static const char *const names[] = {"line",   "polyline", "polygon", "rect",
                                        "circle", "ellipse",  "path"};
    for (int i = 0; i < NO_SHAPE; i++)
        if (sli_xml_is(node, names[i])) return (shape)i;
    return NO_SHAPE;
}

static sl_status draw_shape(svg *s, xmlNode *node, shape kind) {
    s->shapes++;
    switch (kind) {
    case LINE:
        return draw_line(s, node);
    case POLYLINE:
    case POLYGON:
        return draw_points(s, node, kind == POLYGON);
    case RECT:
        return draw_rect(s, node);
    case CIRCLE:
    case ELLIPSE:
        return draw_round(s, node, kind == CIRCLE);
    default:
        return draw_path(s, node);
    }
}

// --- shapes of layers that say what they hold

/// The layer of a group, by its id or its label.
static sli_layer layer_of_group(xmlNode *node) {
    char *id = sli_xml_attribute(node, "id"), *label = sli_xml_attribute(node, "label");
    sli_layer layer = label ? sli_layer_of((sli_word){label, strlen(label)}, NULL) : SLI_LAYER_NONE;
    if (!layer && id) layer = sli_layer_of((sli_word){id, strlen(id)}, NULL);
    sli_xml_free(id);
    sli_xml_free(label);
    return layer;
}

/// An attribute that is a number, if it is there.
static sl_status read_own_number(svg *s, xmlNode *node, const char *name, bool *found,
                                 double *value) {
    char *data = sli_xml_attribute(node, name);
    if (!data) return SL_OK;
    svg_text text = svg_text_of(data, name);
    sl_status status = svg_number(&s->pen, &text, value);
    if (status == SL_OK && text.at < text.end) status = fail_expected(&s->pen, &text, "the end");
    *found = status == SL_OK;
    sli_xml_free(data);
    return status;
}

/// A start is the middle of a circle.
static sl_status read_start(svg *s, xmlNode *node, sl_point *at, double *heading) {
    bool found;
    SL_TRY(read_length(s, node, "cx", &at->x));
    SL_TRY(read_length(s, node, "cy", &at->y));
    SL_TRY(read_own_number(s, node, "data-heading", &found, heading));
    const sli_affine down = {.xx = 1, .yy = -1};
    *heading = sli_heading_through(sli_affine_after(s->pen.affine, down), *heading);
    *at = sli_affine_apply(s->pen.affine, *at);
    return SL_OK;
}

/// Draws a shape into a map of its own; the lines become what the layer says.
static sl_status draw_in_layer(svg *s, xmlNode *node, shape kind, sli_layer layer) {
    sl_map drawn = {0}, *map = s->pen.map;
    sl_point start = {0, 0};
    sli_layer_item item = {.layer = layer, .points = &start};
    const size_t walls = s->pen.walls;
    const bool is_start = layer == SLI_LAYER_START && (kind == CIRCLE || kind == ELLIPSE);
    sl_status status = SL_OK;
    s->pen.map = &drawn;
    if (is_start) status = read_start(s, node, &start, &item.heading);
    if (layer != SLI_LAYER_START) status = draw_shape(s, node, kind);
    s->pen.map = map;
    if (layer != SLI_LAYER_WALL) s->pen.walls = walls;
    char *name = sli_xml_attribute(node, "data-name");
    item.name = name;
    item.open = !attribute_is(node, "data-open", "false");
    item.count = is_start;
    s->other += layer == SLI_LAYER_START && !is_start;
    if (status == SL_OK)
        status = sli_layer_take(s->context, s->pen.name, map, &item, &drawn,
                                s->pen.item ? s->pen.item : s->pen.line);
    sli_xml_free(name);
    sl_map_destroy(s->context, &drawn);
    return status;
}

/// Draws a shape, and tells whose it is.
static sl_status draw_in_group(svg *s, xmlNode *node, shape kind, uint32_t group) {
    if (!sli_contents_asks(&s->contents)) return draw_shape(s, node, kind);
    sli_contents_begin(&s->contents, &s->pen);
    SL_TRY(draw_shape(s, node, kind));
    return sli_contents_end(&s->contents, &s->pen, group);
}

// --- groups

static sl_status draw_children(svg *s, xmlNode *node, place at) {
    for (xmlNode *child = node->children; child; child = child->next)
        if (child->type == XML_ELEMENT_NODE) SL_TRY(draw_element(s, child, at));
    return SL_OK;
}

/// The box of a drawing, as its attribute viewBox or its size has it; no box where `box[2]` is 0.
static sl_status read_view_box(svg *s, xmlNode *node, double box[4]) {
    memset(box, 0, 4 * sizeof *box);
    char *data = sli_xml_attribute(node, "viewBox");
    if (!data) return SL_OK;
    svg_text text = svg_text_of(data, "viewBox");
    sl_status status = SL_OK;
    for (int i = 0; i < 4 && status == SL_OK; i++) status = svg_number(&s->pen, &text, &box[i]);
    if (status == SL_OK && !(box[2] > 0 && box[3] > 0))
        status = sl_fail_at(s->context, s->pen.name, s->pen.line,
                            "viewBox: its width and height must be positive");
    sli_xml_free(data);
    return status;
}

/// A drawing within the drawing: its box is fitted into its place, in the middle and not stretched.
static sl_status enter_drawing(svg *s, xmlNode *node, sli_affine *inner) {
    double x = 0, y = 0, box[4];
    SL_TRY(read_view_box(s, node, box));
    double width = box[2], height = box[3];
    SL_TRY(read_length(s, node, "x", &x));
    SL_TRY(read_length(s, node, "y", &y));
    if (!has_percent(node, "width")) SL_TRY(read_length(s, node, "width", &width));
    if (!has_percent(node, "height")) SL_TRY(read_length(s, node, "height", &height));
    const double scale = box[2] > 0 ? fmin(width / box[2], height / box[3]) : 1;
    *inner =
        (sli_affine){.xx = scale, .x0 = x - scale * box[0], .yy = scale, .y0 = y - scale * box[1]};
    if (box[2] > 0) {
        inner->x0 += (width - scale * box[2]) / 2;
        inner->y0 += (height - scale * box[3]) / 2;
    }
    return SL_OK;
}

static sl_status draw_use(svg *s, xmlNode *node, place at) {
    double x = 0, y = 0;
    SL_TRY(read_length(s, node, "x", &x));
    SL_TRY(read_length(s, node, "y", &y));
    char *link = sli_xml_attribute(node, "href");
    xmlNode *used = link && *link == '#' ? sli_svg_find(&s->ids, link + 1) : NULL;
    const sl_status status =
        used ? SL_OK
             : sl_fail_at(s->context, s->pen.name, s->pen.line, "use: there is no element '%s'",
                          link ? sli_show((sli_word){link, strlen(link)}).text : "");
    sli_xml_free(link);
    SL_TRY(status);
    at.affine = sli_affine_after(at.affine, (sli_affine){.xx = 1, .x0 = x, .yy = 1, .y0 = y});
    at.depth++;
    if (sli_xml_is(used, "symbol")) SL_TRY(sli_svg_find_group(&s->contents, used, &at.group));
    return sli_xml_is(used, "symbol") ? draw_children(s, used, at) : draw_element(s, used, at);
}

static sl_status draw_group(svg *s, xmlNode *node, place at) {
    if (sli_xml_is(node, "use")) return draw_use(s, node, at);
    at.depth++;
    if (sli_xml_is(node, "svg")) {
        sli_affine inner;
        SL_TRY(enter_drawing(s, node, &inner));
        at.affine = sli_affine_after(at.affine, inner);
    }
    return draw_children(s, node, at);
}

static bool is_group(xmlNode *node) {
    return sli_xml_is(node, "g") || sli_xml_is(node, "a") || sli_xml_is(node, "svg") ||
           sli_xml_is(node, "switch") || sli_xml_is(node, "use");
}

/// Text, pictures and what is drawn only where it is used give no walls; the former are counted.
static void pass_over(svg *s, xmlNode *node) {
    s->other +=
        sli_xml_is(node, "text") || sli_xml_is(node, "image") || sli_xml_is(node, "foreignObject");
}

static sl_status draw_element(svg *s, xmlNode *node, place at) {
    s->pen.line = sli_xml_line(node);
    s->work++;
    if (s->work % 1024 == 0) SL_TRY(sl_check_cancelled(s->context));
    const shape kind = shape_of(node);
    if (kind == NO_SHAPE && !is_group(node)) {
        pass_over(s, node);
        return SL_OK;
    }
    if (sli_svg_hides(&s->style, node)) {
        s->hidden++;
        return SL_OK;
    }
    char *transform = sli_xml_attribute(node, "transform");
    if (transform) {
        sli_affine own;
        const sl_status status = svg_transform(&s->pen, transform, &own);
        sli_xml_free(transform);
        SL_TRY(status);
        at.affine = sli_affine_after(at.affine, own);
    }
    at.taken |= s->options->layers && is_layer(s, node);
    if (sli_contents_asks(&s->contents)) SL_TRY(sli_svg_find_group(&s->contents, node, &at.group));
    if (kind == NO_SHAPE) {
        const sli_layer own = layer_of_group(node);
        if (own) at.layer = own;
        return draw_group(s, node, at);
    }
    if (!at.taken) return SL_OK;
    s->pen.affine = at.affine;
    s->pen.item = s->by_number ? (uint32_t)(uintptr_t)node->_private : 0;
    return at.layer ? draw_in_layer(s, node, kind, at.layer)
                    : draw_in_group(s, node, kind, at.group);
}

// --- names for walls

/// The name of a layer about an element: the nearest group's label, else its id.
static char *layer_of(const xmlNode *node) {
    for (node = node->parent; node && node->type == XML_ELEMENT_NODE; node = node->parent) {
        if (!sli_xml_is(node, "g")) continue;
        char *label = sli_xml_attribute(node, "label");
        if (!label) label = sli_xml_attribute(node, "id");
        if (label) return label;
    }
    return NULL;
}

/// "rect, id rect5, layer walls"
static sl_status name_shape(svg *s, const xmlNode *node, uint32_t number) {
    char *id = sli_xml_attribute(node, "id"), *layer = layer_of(node);
    char label[SL_LINE_TEXT] = "";
    size_t used = 0;
    if (s->by_number && sli_xml_line(node))
        used = (size_t)snprintf(label, sizeof label, "line %u, ", (unsigned)sli_xml_line(node));
    snprintf(label + used, sizeof label - used, "%s%s%s%s%s", (const char *)node->name,
             id ? ", id " : "", id ? sli_show((sli_word){id, strlen(id)}).text : "",
             layer ? ", layer " : "", layer ? sli_show((sli_word){layer, strlen(layer)}).text : "");
    sli_xml_free(id);
    sli_xml_free(layer);
    return sli_map_add_label(s->context, s->pen.map, s->by_number ? number : sli_xml_line(node),
                             label);
}

/// Numbers the shapes from 1, in the order of the file. Tells whether each has a line of its own.
static void number_shapes(xmlNode *node, uint32_t *count, uint32_t *line, bool *own_lines) {
    for (; node; node = node->next) {
        if (node->type != XML_ELEMENT_NODE) continue;
        if (shape_of(node) != NO_SHAPE) {
            *own_lines &= sli_xml_line(node) > *line;
            *line = sli_xml_line(node);
            node->_private = (void *)(uintptr_t)++ * count;
        }
        number_shapes(node->children, count, line, own_lines);
    }
}

static sl_status name_shapes(svg *s, const xmlNode *node) {
    for (; node; node = node->next) {
        if (node->type != XML_ELEMENT_NODE) continue;
        if (node->_private) SL_TRY(name_shape(s, node, (uint32_t)(uintptr_t)node->_private));
        SL_TRY(name_shapes(s, node->children));
    }
    return SL_OK;
}

/// Walls have the line of their shape. Where several shapes stand on one line, walls have the
/// number of their shape.
static sl_status name_walls(svg *s, xmlNode *root) {
    uint32_t count = 0, line = 0;
    bool own_lines = true;
    number_shapes(root, &count, &line, &own_lines);
    s->by_number = s->pen.map->source.lines_are_items = !own_lines;
    return name_shapes(s, root);
}

// --- the whole

/// What a file of our own says of the whole map: the range, the snap, the sum of its digits.
static sl_status read_marks(svg *s, xmlNode *root) {
    sl_map *map = s->pen.map;
    bool range = false, snap = false;
    SL_TRY(read_own_number(s, root, "data-sightline-range", &range, &map->range));
    SL_TRY(read_own_number(s, root, "data-sightline-snap", &snap, &map->snap));
    if ((range && !(map->range > 0)) || (snap && !(map->snap > 0)))
        return sl_fail_at(s->context, s->pen.name, s->pen.line,
                          "data-sightline-%s: expected a number greater than 0",
                          range && !(map->range > 0) ? "range" : "snap");
    for (xmlNode *child = root->children; child && !s->mark; child = child->next)
        if (sli_xml_is(child, "metadata"))
            s->mark = sli_xml_attribute(child, "data-sightline-digits");
    return SL_OK;
}

/// A user unit is a pixel, unless the width is written in another unit and the box is as wide:
/// width="210mm" viewBox="0 0 210 297".
static void find_unit(svg *s, xmlNode *root, double box_width) {
    static const char *const units[] = {"px", "in", "cm", "mm", "pt", "pc"};
    char *text = sli_xml_attribute(root, "width"), *unit = s->pen.map->unit;
    const size_t length = text ? sli_number_length(text, strlen(text)) : 0;
    double width = 0;
    if (box_width == 0) strcpy(unit, units[0]);
    if (box_width != 0 && length && sl_number_read(text, length, &width) && width == box_width) {
        const sli_word rest = {text + length, strcspn(text + length, " \t\r\n")};
        if (!rest.length) strcpy(unit, units[0]);
        for (size_t i = 0; i < sizeof units / sizeof *units; i++)
            if (sli_word_is(rest, units[i])) strcpy(unit, units[i]);
    }
    sli_xml_free(text);
}

/// The map's unit is the drawing's own, y turned up: the lower edge of its box, where it has one,
/// is at y 0, unless the drawing says where y is 0.
static sl_status draw_root(svg *s, xmlNode *root) {
    double box[4], height = 0;
    bool told = false;
    s->pen.line = sli_xml_line(root);
    SL_TRY(check_layers(s, root));
    SL_TRY(read_view_box(s, root, box));
    if (box[2] > 0)
        height = box[1] + box[3];
    else if (!has_percent(root, "height"))
        SL_TRY(read_length(s, root, "height", &height));
    SL_TRY(read_own_number(s, root, "data-sightline-y0", &told, &height));
    SL_TRY(read_marks(s, root));
    if (box[2] > 0)
        s->pen.map->source.page =
            (sl_box){{box[0], height - (box[1] + box[3])}, {box[0] + box[2], height - box[1]}};
    s->pen.map->source.transform = sli_y_down(height, 1);
    s->pen.map->source.pixels = 1;
    SL_TRY(name_walls(s, root));
    SL_TRY(sli_svg_style_read(s->context, root, &s->style));
    find_unit(s, root, box[2]);
    SL_TRY(sli_svg_ids_read(s->context, root, &s->ids));
    SL_TRY(sli_svg_check_amount(s->context, s->pen.name, s->options, root, &s->style, &s->ids));
    const place at = {.affine = {.xx = 1, .yy = -1, .y0 = height}, .taken = !s->options->layers};
    SL_TRY(draw_children(s, root, at));
    SL_TRY(sli_contents_choose(&s->contents, 0, &s->pen));
    s->shapes -= s->contents.left_out;
    s->pen.map->precision = sli_marked_precision(s->pen.map, s->pen.finest, s->mark, s->pen.sum);
    const sli_tally left[] = {{s->hidden, "hidden element or group", "hidden elements or groups"},
                              {s->other, "text or picture", "texts and pictures"},
                              {s->pen.points, "line of no length", "lines of no length"},
                              {s->style.unread, "rule of a style sheet", "rules of style sheets"}};
    char without[SLI_TALLY_TEXT];
    sl_note(s->context, "%s: %zu shapes give %zu walls%s", s->pen.name, s->shapes, s->pen.walls,
            sli_tally_write("; left out: ", left, 4, without));
    sli_layers_note(s->context, s->pen.name, s->pen.map);
    return SL_OK;
}

sl_status sli_map_read_svg(sl_context *context, const char *name, const char *text, size_t size,
                           const sl_import_options *options, sl_map *map) {
    const sl_import_options own = sli_drawing_options(options);
    sl_map read = {0};
    svg s = {.context = context,
             .options = &own,
             .contents = {.context = context, .file = name, .options = &own},
             .pen = {.context = context, .name = name, .map = &read, .tolerance = own.tolerance}};
    SL_TRY(sli_xml_read(context, name, text, size, &s.document));
    xmlNode *root = xmlDocGetRootElement(s.document);
    const sl_status status =
        sli_xml_is(root, "svg")
            ? draw_root(&s, root)
            : sl_fail_at(
                  context, name, sli_xml_line(root), "expected an svg element, found '%s'",
                  sli_show((sli_word){(const char *)root->name, strlen((const char *)root->name)})
                      .text);
    sli_svg_style_destroy(context, &s.style);
    sli_svg_ids_destroy(context, &s.ids);
    sli_contents_destroy(&s.contents);
    sli_xml_free(s.mark);
    xmlFreeDoc(s.document);
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}

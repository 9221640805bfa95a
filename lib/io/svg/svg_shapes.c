/// The shapes of an SVG drawing and the lengths in their attributes. A path or a list of points
/// that is wrong is drawn up to there, as SVG asks for; a shape with a length that is not known
/// here is passed over.
#include "io/parts/document.h"
#include "io/svg/svg.h"
#include "io/svg/svg_path.h"
#include "io/svg/svg_transform.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

typedef sli_svg svg;

// --- lengths

static const sli_fault percent = {"size in percent of a window", "sizes in percent of a window"};
static const sli_fault bad_unit = {"length whose unit is not known here",
                                   "lengths whose units are not known here"};
static const sli_fault bad_length = {"length that is no number", "lengths that are no numbers"};

sl_status sli_svg_fault(svg *s, const sli_fault *kind) {
    s->fault = kind;
    return SL_BAD_INPUT;
}

sl_status sli_svg_length(svg *s, xmlNode *node, const char *name, double *value) {
    char *text = sli_xml_attribute(node, name);
    if (!text) return SL_OK;
    sli_svg_text scan = sli_svg_text_of(text, name);
    double number = 0;
    sli_svg_skip_space(&scan);
    const char *begin = scan.at;
    sl_status status = sli_svg_number(&s->pen, &scan, &number);
    const size_t written = (size_t)(scan.at - begin);
    const sli_word unit = {scan.at, strcspn(scan.at, " \t\r\n")};
    const double size = sli_svg_unit(unit);
    if (status != SL_OK) {
        status = sli_svg_fault(s, &bad_length);
    } else if (size > 0) {
        *value = number * size;
        sli_pen_digits(&s->pen, begin, written, size);
    } else {
        status = sli_svg_fault(s, sli_word_is(unit, "%") ? &percent : &bad_unit);
    }
    sli_xml_free(text);
    return status;
}

// --- shapes

static const sli_fault bad_points = {"list of points that is wrong: drawn up to there",
                                     "lists of points that are wrong: drawn up to there"};
static const sli_fault bad_path = {"path that is wrong: drawn up to there",
                                   "paths that are wrong: drawn up to there"};

static sl_status draw_points(svg *s, xmlNode *node, bool closed) {
    char *data = sli_xml_attribute(node, "points");
    if (!data) return SL_OK;
    sli_svg_text text = sli_svg_text_of(data, "points");
    sl_point first = {0, 0};
    sl_status status = SL_OK;
    size_t count = 0;
    for (sli_svg_skip(&text); status == SL_OK && text.at < text.end; sli_svg_skip(&text)) {
        sl_point to;
        status = sli_svg_coordinate(&s->pen, &text, &to.x);
        if (status == SL_OK) status = sli_svg_coordinate(&s->pen, &text, &to.y);
        if (status != SL_OK) break;
        if (count++)
            status = sli_pen_line(&s->pen, to);
        else
            first = s->pen.at = to;
    }
    if (status == SL_BAD_INPUT && text.wrong) {
        sli_faults_add(&s->faults, &bad_points, s->pen.line);
        status = SL_OK;
    }
    if (status == SL_OK && closed && count > 2) status = sli_pen_line(&s->pen, first);
    sli_xml_free(data);
    return status;
}

static sl_status draw_line(svg *s, xmlNode *node) {
    sl_point to = {0, 0};
    s->pen.at = to;
    SL_TRY(sli_svg_length(s, node, "x1", &s->pen.at.x));
    SL_TRY(sli_svg_length(s, node, "y1", &s->pen.at.y));
    SL_TRY(sli_svg_length(s, node, "x2", &to.x));
    SL_TRY(sli_svg_length(s, node, "y2", &to.y));
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
    SL_TRY(sli_svg_length(s, node, "x", &x));
    SL_TRY(sli_svg_length(s, node, "y", &y));
    SL_TRY(sli_svg_length(s, node, "width", &w));
    SL_TRY(sli_svg_length(s, node, "height", &h));
    if (!(w > 0 && h > 0)) return SL_OK;
    SL_TRY(sli_svg_length(s, node, "rx", &rx));
    SL_TRY(sli_svg_length(s, node, "ry", &ry));
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
    SL_TRY(sli_svg_length(s, node, "cx", &centre.x));
    SL_TRY(sli_svg_length(s, node, "cy", &centre.y));
    SL_TRY(sli_svg_length(s, node, circle ? "r" : "rx", &radii.x));
    radii.y = radii.x;
    if (!circle) SL_TRY(sli_svg_length(s, node, "ry", &radii.y));
    if (!(radii.x > 0 && radii.y > 0)) return SL_OK;
    s->pen.at = (sl_point){centre.x + radii.x, centre.y};
    return sli_pen_arc(&s->pen, centre, (sl_point){radii.x, 0}, (sl_point){0, radii.y}, 2 * pi,
                       s->pen.at);
}

static sl_status draw_path(svg *s, xmlNode *node) {
    char *data = sli_xml_attribute(node, "d");
    if (!data) return SL_OK;
    bool wrong;
    const sl_status status = sli_svg_path(&s->pen, data, &wrong);
    if (wrong) sli_faults_add(&s->faults, &bad_path, s->pen.line);
    sli_xml_free(data);
    return status;
}

sli_svg_shape sli_svg_shape_of(const xmlNode *node) {
    static const char *const names[] = {"line",   "polyline", "polygon", "rect",
                                        "circle", "ellipse",  "path"};
    for (int i = 0; i < SLI_SVG_NO_SHAPE; i++)
        if (sli_xml_is(node, names[i])) return (sli_svg_shape)i;
    return SLI_SVG_NO_SHAPE;
}

sl_status sli_svg_draw(svg *s, xmlNode *node, sli_svg_shape kind) {
    s->shapes++;
    switch (kind) {
    case SLI_SVG_LINE:
        return draw_line(s, node);
    case SLI_SVG_POLYLINE:
    case SLI_SVG_POLYGON:
        return draw_points(s, node, kind == SLI_SVG_POLYGON);
    case SLI_SVG_RECT:
        return draw_rect(s, node);
    case SLI_SVG_CIRCLE:
    case SLI_SVG_ELLIPSE:
        return draw_round(s, node, kind == SLI_SVG_CIRCLE);
    default:
        return draw_path(s, node);
    }
}

/// Transforms: those of the attribute are a part of those of CSS, which have units and a few more
/// functions. Both are read alike.
#include "io/svg/svg_transform.h"

#include "base/base.h"

#include <math.h>

static const double pi = 3.14159265358979323846;
static const char blanks[] = " \t\r\n\f";

// --- numbers with units

double sli_svg_unit(sli_word unit) {
    static const struct {
        const char *name;
        double size;
    } units[] = {{"", 1},           {"px", 1},         {"in", 96},      {"cm", 96 / 2.54},
                 {"mm", 96 / 25.4}, {"pt", 96.0 / 72}, {"pc", 96.0 / 6}};
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (sli_word_is(unit, units[i].name)) return units[i].size;
    return 0;
}

/// Degrees a unit; 0 where it is not known.
static double angle_unit(sli_word unit) {
    static const struct {
        const char *name;
        double degrees;
    } units[] = {{"", 1}, {"deg", 1}, {"grad", 0.9}, {"turn", 360}, {"rad", 180 / pi}};
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (sli_word_is(unit, units[i].name)) return units[i].degrees;
    return 0;
}

/// A number and what stands right behind it.
typedef struct value {
    double number;
    sli_word unit;
} value;

static void skip(sli_word *text, const char *any) {
    while (text->length && strchr(any, *text->at)) text->at++, text->length--;
}

static sli_word take_letters(sli_word *text) {
    sli_word word = {text->at, 0};
    while (text->length && (((*text->at | 0x20) >= 'a' && (*text->at | 0x20) <= 'z') ||
                            (word.length && *text->at >= '0' && *text->at <= '9')))
        text->at++, text->length--, word.length++;
    return word;
}

static bool take_value(sli_word *text, value *out) {
    const size_t length = sli_number_length(text->at, text->length);
    if (!length || !sl_number_read(text->at, length, &out->number) || !isfinite(out->number))
        return false;
    text->at += length;
    text->length -= length;
    if (text->length && *text->at == '%') {
        out->unit = (sli_word){text->at++, 1};
        text->length--;
    } else {
        out->unit = take_letters(text);
    }
    return true;
}

/// A length along an axis, where all of it is `size`; below 0: not known.
static sli_svg_result length_of(value v, double size, double *out) {
    const bool share = sli_word_is(v.unit, "%");
    const double unit = share ? size / 100 : sli_svg_unit(v.unit);
    *out = v.number * unit;
    return share ? (size < 0 ? SLI_SVG_BEYOND : SLI_SVG_READ)
                 : (unit > 0 ? SLI_SVG_READ : SLI_SVG_BEYOND);
}

// --- functions

static sli_affine moved(double x, double y) {
    return (sli_affine){.xx = 1, .x0 = x, .yy = 1, .y0 = y};
}

static double slope(double degrees) {
    return tan(degrees * (pi / 180));
}

/// A function's kind: what its numbers are, and how many there may be.
typedef struct function {
    const char *name;
    enum { PLAIN, ANGLES, X_LENGTH, Y_LENGTH, LENGTHS, TURN } kind;
    int least, most;
} function;

static const function functions[] = {
    {"matrix", PLAIN, 6, 6},        {"translate", LENGTHS, 1, 2},   {"scale", PLAIN, 1, 2},
    {"rotate", TURN, 1, 3},         {"skewX", ANGLES, 1, 1},        {"skewY", ANGLES, 1, 1},
    {"skew", ANGLES, 1, 2},         {"scaleX", PLAIN, 1, 1},        {"scaleY", PLAIN, 1, 1},
    {"translateX", X_LENGTH, 1, 1}, {"translateY", Y_LENGTH, 1, 1}, {"rotateZ", ANGLES, 1, 1},
};

/// Functions that leave the plane, and values that are worked out.
static bool is_beyond(sli_word name) {
    static const char *const others[] = {
        "translate3d", "translateZ",  "scale3d", "scaleZ", "rotate3d", "rotateX", "rotateY",
        "matrix3d",    "perspective", "calc",    "var",    "min",      "max",     "clamp"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (sli_word_is(name, others[i])) return true;
    return false;
}

static sli_affine make_transform(const char *name, const double n[6], int count) {
    const bool two = count == 2;
    if (strcmp(name, "matrix") == 0) return (sli_affine){n[0], n[2], n[4], n[1], n[3], n[5]};
    if (strcmp(name, "translate") == 0) return moved(n[0], two ? n[1] : 0);
    if (strcmp(name, "translateX") == 0) return moved(n[0], 0);
    if (strcmp(name, "translateY") == 0) return moved(0, n[0]);
    if (strcmp(name, "scale") == 0) return (sli_affine){.xx = n[0], .yy = two ? n[1] : n[0]};
    if (strcmp(name, "scaleX") == 0) return (sli_affine){.xx = n[0], .yy = 1};
    if (strcmp(name, "scaleY") == 0) return (sli_affine){.xx = 1, .yy = n[0]};
    if (strcmp(name, "skewX") == 0) return (sli_affine){.xx = 1, .xy = slope(n[0]), .yy = 1};
    if (strcmp(name, "skewY") == 0) return (sli_affine){.xx = 1, .yx = slope(n[0]), .yy = 1};
    if (strcmp(name, "skew") == 0)
        return (sli_affine){.xx = 1, .xy = slope(n[0]), .yx = two ? slope(n[1]) : 0, .yy = 1};
    const sl_point about = {count == 3 ? n[1] : 0, count == 3 ? n[2] : 0};
    return sli_affine_after(moved(about.x, about.y),
                            sli_affine_after(sli_affine_turn(n[0]), moved(-about.x, -about.y)));
}

static sli_svg_result number_of(const function *f, int index, value v, const sl_box *box,
                                double *out) {
    const double width = box ? box->max.x - box->min.x : -1;
    const double height = box ? box->max.y - box->min.y : -1;
    if (f->kind == X_LENGTH || (f->kind == LENGTHS && index == 0)) return length_of(v, width, out);
    if (f->kind == Y_LENGTH || f->kind == LENGTHS) return length_of(v, height, out);
    if (f->kind == TURN && index > 0) return length_of(v, -1, out);
    const bool angle = f->kind != PLAIN;
    const double unit = angle ? angle_unit(v.unit) : 1;
    *out = v.number * unit;
    if (!angle && sli_word_is(v.unit, "%"))
        *out /= 100;
    else if (!angle && v.unit.length && sli_svg_unit(v.unit) != 1)
        return SLI_SVG_WRONG;
    return unit > 0 ? SLI_SVG_READ : SLI_SVG_WRONG;
}

/// The next function of a list, with its brackets.
static sli_svg_result take_function(sli_word *text, const sl_box *box, sli_affine *out) {
    const sli_word name = take_letters(text);
    const function *f = functions, *end = functions + sizeof functions / sizeof *functions;
    while (f < end && !sli_word_is(name, f->name)) f++;
    if (f == end) return is_beyond(name) ? SLI_SVG_BEYOND : SLI_SVG_WRONG;
    skip(text, blanks);
    if (!text->length || *text->at != '(') return SLI_SVG_WRONG;
    text->at++, text->length--;
    double numbers[6] = {0};
    int count = 0;
    for (skip(text, " \t\r\n\f,"); text->length && *text->at != ')'; skip(text, " \t\r\n\f,")) {
        value v;
        if (count == f->most) return SLI_SVG_WRONG;
        if (!take_value(text, &v))
            return is_beyond(take_letters(text)) ? SLI_SVG_BEYOND : SLI_SVG_WRONG;
        const sli_svg_result result = number_of(f, count, v, box, &numbers[count]);
        if (result != SLI_SVG_READ) return result;
        count++;
    }
    if (!text->length || count < f->least || (f->kind == TURN && count == 2)) return SLI_SVG_WRONG;
    text->at++, text->length--;
    *out = make_transform(f->name, numbers, count);
    return SLI_SVG_READ;
}

sli_svg_result sli_svg_transform(sli_word text, const sl_box *box, sli_affine *out) {
    *out = SLI_AFFINE_NONE;
    if (sli_word_is(text, "none") || sli_word_is(text, "initial")) return SLI_SVG_READ;
    for (skip(&text, " \t\r\n\f,"); text.length; skip(&text, " \t\r\n\f,")) {
        sli_affine one;
        const sli_svg_result result = take_function(&text, box, &one);
        if (result != SLI_SVG_READ) return result;
        *out = sli_affine_after(*out, one);
    }
    return SLI_SVG_READ;
}

// --- the origin

sli_svg_result sli_svg_origin(sli_word text, const sl_box *box, sl_point *out) {
    static const struct {
        const char *name;
        int axis; ///< 2: either
        double share;
    } words[] = {
        {"left", 0, 0}, {"right", 0, 100}, {"top", 1, 0}, {"bottom", 1, 100}, {"center", 2, 50}};
    value values[2] = {{50, {"%", 1}}, {50, {"%", 1}}};
    int axis = 0, count = 0;
    for (skip(&text, blanks); text.length && count < 2; skip(&text, blanks), count++) {
        value v;
        axis = count;
        if (!take_value(&text, &v)) {
            const sli_word name = take_letters(&text);
            size_t i = 0;
            while (i < 5 && !sli_word_is(name, words[i].name)) i++;
            if (i == 5) return SLI_SVG_BEYOND;
            v = (value){words[i].share, {"%", 1}};
            if (words[i].axis < 2) axis = words[i].axis;
        }
        values[axis] = v;
    }
    if (!count) return SLI_SVG_WRONG;
    const double width = box ? box->max.x - box->min.x : -1;
    const double height = box ? box->max.y - box->min.y : -1;
    const sli_svg_result x = length_of(values[0], width, &out->x);
    const sli_svg_result y = length_of(values[1], height, &out->y);
    if (x != SLI_SVG_READ || y != SLI_SVG_READ) return SLI_SVG_BEYOND;
    if (box) *out = (sl_point){out->x + box->min.x, out->y + box->min.y};
    return SLI_SVG_READ;
}

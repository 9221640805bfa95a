// The entities of a DXF drawing that are walls: LINE, LWPOLYLINE and POLYLINE with bulges, ARC,
// CIRCLE, ELLIPSE, and INSERT, which draws a block's entities once more.
#include "io/dxf.h"

#include <math.h>

/// Blocks within blocks; a block that inserts itself goes deeper than any drawing does.
#define MOST_DEPTH 64
/// Entities drawn and blocks inserted, and no more: a few nested blocks could ask for any number.
#define MOST_WORK ((size_t)1 << 24)

static const double pi = 3.14159265358979323846;

static sl_status read_point(sl_dxf *dxf, sl_dxf_range entity, int code, sl_point *point) {
    SL_TRY(sl_dxf_number(dxf, entity, code, &point->x));
    return sl_dxf_number(dxf, entity, code + 10, &point->y);
}

/// Entities drawn in their own plane: one seen from below is mirrored, one that leans is left out.
typedef enum plane { LEVEL, FROM_BELOW, LEANING } plane;

static sl_status read_plane(sl_dxf *dxf, sl_dxf_range entity, plane *out) {
    double x = 0, y = 0, z = 1;
    SL_TRY(sl_dxf_number(dxf, entity, 210, &x));
    SL_TRY(sl_dxf_number(dxf, entity, 220, &y));
    SL_TRY(sl_dxf_number(dxf, entity, 230, &z));
    // Writers round: a normal that leans by a millionth is meant to be upright.
    *out = fabs(x) + fabs(y) > 1e-6 * fabs(z) || z == 0 ? LEANING : z < 0 ? FROM_BELOW : LEVEL;
    return SL_OK;
}

// --- lines and polylines

static sl_status draw_line(sl_dxf *dxf, sl_dxf_range entity) {
    sl_point to = {0, 0};
    dxf->pen.at = to;
    SL_TRY(read_point(dxf, entity, 10, &dxf->pen.at));
    SL_TRY(read_point(dxf, entity, 11, &to));
    return sl_pen_line(&dxf->pen, to);
}

/// A piece of a polyline: straight, or an arc whose bulge is the tangent of a quarter of its angle,
/// positive counter-clockwise.
static sl_status draw_piece(sl_pen *pen, sl_point to, double bulge) {
    const sl_point from = pen->at;
    const sl_point chord = {to.x - from.x, to.y - from.y};
    if (bulge == 0 || (chord.x == 0 && chord.y == 0)) return sl_pen_line(pen, to);
    const double across = (1 - bulge * bulge) / (4 * bulge);
    const sl_point centre = {from.x + chord.x / 2 - across * chord.y,
                             from.y + chord.y / 2 + across * chord.x};
    const sl_point u = {from.x - centre.x, from.y - centre.y};
    return sl_pen_arc(pen, centre, u, (sl_point){-u.y, u.x}, 4 * atan(bulge), to);
}

/// A polyline's corners as they come; `next` draws up to the corner given.
typedef struct corners {
    sl_point first;
    double bulge; ///< of the piece that starts at the last corner
    size_t count;
} corners;

static sl_status next_corner(sl_dxf *dxf, corners *line, sl_point to, double bulge) {
    const double last = line->bulge;
    line->bulge = bulge;
    if (line->count++) return draw_piece(&dxf->pen, to, last);
    line->first = dxf->pen.at = to;
    return SL_OK;
}

static sl_status end_corners(sl_dxf *dxf, const corners *line, bool closed) {
    return closed && line->count > 1 ? draw_piece(&dxf->pen, line->first, line->bulge) : SL_OK;
}

static sl_status draw_light_polyline(sl_dxf *dxf, sl_dxf_range entity) {
    corners line = {0};
    int flags = 0;
    SL_TRY(sl_dxf_integer(dxf, entity, 70, &flags));
    for (size_t i = entity.begin; i < entity.end;) {
        if (sl_dxf_at(dxf, i)->code != 10) {
            i++;
            continue;
        }
        sl_dxf_range corner = {i, i + 1};
        while (corner.end < entity.end && sl_dxf_at(dxf, corner.end)->code != 10) corner.end++;
        sl_point at = {0, 0};
        double bulge = 0;
        SL_TRY(read_point(dxf, corner, 10, &at));
        SL_TRY(sl_dxf_number(dxf, corner, 42, &bulge));
        SL_TRY(next_corner(dxf, &line, at, bulge));
        i = corner.end;
    }
    return end_corners(dxf, &line, flags & 1);
}

/// A POLYLINE's corners are VERTEX entities of their own, up to a SEQEND.
static sl_status draw_polyline(sl_dxf *dxf, sl_dxf_range entity, size_t end) {
    enum { MESH = 16, POLYFACE = 64, FRAME = 16 };
    corners line = {0};
    int flags = 0;
    SL_TRY(sl_dxf_integer(dxf, entity, 70, &flags));
    if (flags & (MESH | POLYFACE)) {
        dxf->drawn--;
        dxf->other_kinds++;
        return SL_OK;
    }
    for (size_t i = entity.end; i < end && sl_word_is(sl_dxf_at(dxf, i)->value, "VERTEX");) {
        const sl_dxf_range vertex = sl_dxf_entity(dxf, i, end);
        sl_point at = {0, 0};
        double bulge = 0;
        int kind = 0;
        SL_TRY(read_point(dxf, vertex, 10, &at));
        SL_TRY(sl_dxf_number(dxf, vertex, 42, &bulge));
        SL_TRY(sl_dxf_integer(dxf, vertex, 70, &kind));
        if (!(kind & FRAME)) SL_TRY(next_corner(dxf, &line, at, bulge));
        i = vertex.end;
    }
    return end_corners(dxf, &line, flags & 1);
}

// --- arcs

static sl_point on_arc(sl_point centre, sl_point u, sl_point v, double angle) {
    return (sl_point){centre.x + cos(angle) * u.x + sin(angle) * v.x,
                      centre.y + cos(angle) * u.y + sin(angle) * v.y};
}

/// The arc about a centre from one angle to another, counter-clockwise, in radians.
static sl_status draw_round(sl_dxf *dxf, sl_point centre, sl_point u, sl_point v, double from,
                            double to) {
    double sweep = to - from;
    if (!(fabs(sweep) <= 1e6))
        return sl_fail_at(dxf->context, dxf->name, dxf->pen.line, "an arc's angles make no sense");
    sweep -= 2 * pi * floor(sweep / (2 * pi));
    if (sweep == 0) sweep = 2 * pi;
    const sl_point start = on_arc(centre, u, v, from);
    const sl_point turned = {start.x - centre.x, start.y - centre.y};
    const double c = cos(from), s = sin(from);
    const sl_point across = {c * v.x - s * u.x, c * v.y - s * u.y};
    dxf->pen.at = start;
    return sl_pen_arc(&dxf->pen, centre, turned, across, sweep,
                      sweep < 2 * pi ? on_arc(centre, u, v, to) : start);
}

static sl_status draw_circle(sl_dxf *dxf, sl_dxf_range entity, bool whole) {
    sl_point centre = {0, 0};
    double radius = 0, from = 0, to = 360;
    SL_TRY(read_point(dxf, entity, 10, &centre));
    SL_TRY(sl_dxf_number(dxf, entity, 40, &radius));
    if (!whole) {
        SL_TRY(sl_dxf_number(dxf, entity, 50, &from));
        SL_TRY(sl_dxf_number(dxf, entity, 51, &to));
    }
    if (!(radius > 0))
        return sl_fail_at(dxf->context, dxf->name, dxf->pen.line,
                          "a circle's or arc's radius (group 40) must be positive");
    return draw_round(dxf, centre, (sl_point){radius, 0}, (sl_point){0, radius}, from * (pi / 180),
                      to * (pi / 180));
}

/// Given in space, not in its plane; one seen from below turns the other way.
static sl_status draw_ellipse(sl_dxf *dxf, sl_dxf_range entity, plane lies) {
    sl_point centre = {0, 0}, major = {0, 0};
    double ratio = 1, from = 0, to = 2 * pi;
    SL_TRY(read_point(dxf, entity, 10, &centre));
    SL_TRY(read_point(dxf, entity, 11, &major));
    SL_TRY(sl_dxf_number(dxf, entity, 40, &ratio));
    SL_TRY(sl_dxf_number(dxf, entity, 41, &from));
    SL_TRY(sl_dxf_number(dxf, entity, 42, &to));
    if (lies == FROM_BELOW) ratio = -ratio;
    return draw_round(dxf, centre, major, (sl_point){-ratio * major.y, ratio * major.x}, from, to);
}

// --- insertions

/// From a block's coordinates to those of what inserts it, for one of the rows and columns.
static sl_affine insertion(sl_point at, sl_point step, sl_point scale, double turn, sl_point base) {
    const sl_affine to_origin = {.xx = scale.x,
                                 .x0 = -scale.x * base.x + step.x,
                                 .yy = scale.y,
                                 .y0 = -scale.y * base.y + step.y};
    sl_affine affine = sl_affine_after(sl_affine_turn(turn), to_origin);
    affine.x0 += at.x;
    affine.y0 += at.y;
    return affine;
}

static sl_status count_work(sl_dxf *dxf, uint32_t line) {
    if (++dxf->work > MOST_WORK)
        return sl_fail_at(dxf->context, dxf->name, line,
                          "the drawing's blocks insert one another more than %zu times", MOST_WORK);
    return dxf->work % 4096 == 0 ? sl_check_cancelled(dxf->context) : SL_OK;
}

static sl_status draw_insert(sl_dxf *dxf, sl_dxf_range entity, sl_word layer, unsigned depth) {
    const sl_word name = sl_dxf_text(dxf, entity, 2);
    const sl_dxf_block *block = sl_dxf_find_block(dxf, name);
    const uint32_t line = dxf->pen.line;
    if (!block)
        return sl_fail_at(dxf->context, dxf->name, line, "there is no block '%s'",
                          sl_show(name).text);
    if (depth == MOST_DEPTH)
        return sl_fail_at(dxf->context, dxf->name, line,
                          "block '%s' is inserted more than %d blocks deep: does it hold itself?",
                          sl_show(name).text, MOST_DEPTH);
    sl_point at = {0, 0}, scale = {1, 1}, gap = {0, 0};
    double turn = 0;
    int columns = 1, rows = 1;
    SL_TRY(read_point(dxf, entity, 10, &at));
    SL_TRY(sl_dxf_number(dxf, entity, 41, &scale.x));
    SL_TRY(sl_dxf_number(dxf, entity, 42, &scale.y));
    SL_TRY(sl_dxf_number(dxf, entity, 50, &turn));
    SL_TRY(sl_dxf_integer(dxf, entity, 70, &columns));
    SL_TRY(sl_dxf_integer(dxf, entity, 71, &rows));
    SL_TRY(sl_dxf_number(dxf, entity, 44, &gap.x));
    SL_TRY(sl_dxf_number(dxf, entity, 45, &gap.y));
    const sl_affine outer = dxf->pen.affine;
    for (int row = 0; row < rows; row++) {
        for (int column = 0; column < columns; column++) {
            SL_TRY(count_work(dxf, line));
            const sl_point step = {column * gap.x, row * gap.y};
            dxf->pen.affine = sl_affine_after(outer, insertion(at, step, scale, turn, block->base));
            SL_TRY(sl_dxf_draw(dxf, block->entities, layer, depth + 1));
        }
    }
    return SL_OK;
}

// --- all of them

static sl_status draw_shape(sl_dxf *dxf, sl_dxf_range entity, size_t end, sl_word layer, plane lies,
                            unsigned depth) {
    const sl_word kind = sl_dxf_at(dxf, entity.begin)->value;
    dxf->drawn++;
    if (sl_word_is(kind, "LINE")) return draw_line(dxf, entity);
    if (sl_word_is(kind, "LWPOLYLINE")) return draw_light_polyline(dxf, entity);
    if (sl_word_is(kind, "POLYLINE")) return draw_polyline(dxf, entity, end);
    if (sl_word_is(kind, "ARC")) return draw_circle(dxf, entity, false);
    if (sl_word_is(kind, "CIRCLE")) return draw_circle(dxf, entity, true);
    if (sl_word_is(kind, "ELLIPSE")) return draw_ellipse(dxf, entity, lies);
    dxf->drawn--;
    if (sl_word_is(kind, "INSERT")) return draw_insert(dxf, entity, layer, depth);
    dxf->other_kinds++;
    return SL_OK;
}

static sl_status draw_entity(sl_dxf *dxf, sl_dxf_range entity, size_t end, sl_word layer,
                             unsigned depth) {
    const sl_word kind = sl_dxf_at(dxf, entity.begin)->value;
    sl_word own = sl_dxf_text(dxf, entity, 8);
    if (sl_word_is(own, "0") && layer.length) own = layer;
    int on_paper = 0;
    SL_TRY(sl_dxf_integer(dxf, entity, 67, &on_paper));
    const bool part = sl_word_is(kind, "VERTEX") || sl_word_is(kind, "SEQEND");
    if (part || sl_word_is(kind, "ATTRIB")) return SL_OK;
    if (on_paper) {
        dxf->on_paper++;
        return SL_OK;
    }
    if (!sl_word_is(kind, "INSERT") && !sl_dxf_takes_layer(dxf, own)) {
        dxf->other_layers++;
        return SL_OK;
    }
    plane lies = LEVEL;
    if (!sl_word_is(kind, "LINE")) SL_TRY(read_plane(dxf, entity, &lies));
    if (lies == LEANING) {
        dxf->out_of_plane++;
        return SL_OK;
    }
    const sl_affine outer = dxf->pen.affine;
    if (lies == FROM_BELOW && !sl_word_is(kind, "ELLIPSE"))
        dxf->pen.affine = sl_affine_after(outer, (sl_affine){.xx = -1, .yy = 1});
    dxf->pen.line = sl_dxf_at(dxf, entity.begin)->line;
    const sl_status status = draw_shape(dxf, entity, end, own, lies, depth);
    dxf->pen.affine = outer;
    return status;
}

sl_status sl_dxf_draw(sl_dxf *dxf, sl_dxf_range range, sl_word layer, unsigned depth) {
    for (size_t i = range.begin; i < range.end;) {
        const sl_dxf_range entity = sl_dxf_entity(dxf, i, range.end);
        SL_TRY(count_work(dxf, sl_dxf_at(dxf, i)->line));
        SL_TRY(draw_entity(dxf, entity, range.end, layer, depth));
        i = entity.end;
    }
    return SL_OK;
}

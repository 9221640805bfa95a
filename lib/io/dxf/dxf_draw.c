/// The entities of a DXF drawing: each one that is walls is drawn by the pen. LINE, LWPOLYLINE and
/// POLYLINE with bulges, ARC, CIRCLE, ELLIPSE, SPLINE, and INSERT, which draws a block's entities
/// once more. Blocks within blocks could ask for any amount of work: their depth and the number of
/// entities drawn are bounded. Layers whose names begin with "sightline-" hold doors, solid ground
/// and so on (layers.h). An entity that is faulty is passed over as a whole.
#include "io/dxf/dxf.h"

#include <math.h>

// --- entities: points and planes

static const double pi = 3.14159265358979323846;

static sl_status read_coordinate(sli_dxf *dxf, sli_dxf_range entity, int code, double *value) {
    const sli_dxf_pair *pair = sli_dxf_find(dxf, entity, code);
    if (!pair) return SL_OK;
    sli_pen_digits(&dxf->pen, pair->value.at, pair->value.length, 1);
    return sli_dxf_read_number(dxf, pair, value);
}

static sl_status read_point(sli_dxf *dxf, sli_dxf_range entity, int code, sl_point *point) {
    SL_TRY(read_coordinate(dxf, entity, code, &point->x));
    return read_coordinate(dxf, entity, code + 10, &point->y);
}

static const sli_fault missing = {"entity without a number that it needs",
                                  "entities without numbers that they need"};
static const sli_fault no_radius = {"arc or circle without a radius",
                                    "arcs and circles without a radius"};
static const sli_fault no_size = {"ellipse without a size", "ellipses without a size"};
static const sli_fault no_angle = {"arc whose angles make no sense",
                                   "arcs whose angles make no sense"};
static const sli_fault no_length = {"polyline of fewer than two corners",
                                    "polylines of fewer than two corners"};
static const sli_fault no_spline = {"spline whose knots do not fit its points",
                                    "splines whose knots do not fit their points"};
static const sli_fault no_block = {"insertion of a block that is not there",
                                   "insertions of blocks that are not there"};
static const sli_fault too_far = {"entity with a coordinate out of range",
                                  "entities with coordinates out of range"};

/// An entity has all of these groups; a 0 ends them.
static sl_status need(sli_dxf *dxf, sli_dxf_range entity, const int *codes) {
    for (; *codes; codes++)
        if (!sli_dxf_find(dxf, entity, *codes))
            return sli_dxf_fault(dxf, &missing, sli_dxf_at(dxf, entity.begin)->line);
    return SL_OK;
}
#define NEED(entity, ...) SL_TRY(need(dxf, entity, (const int[]){__VA_ARGS__, 0}))

/// Entities drawn in their own plane: one seen from below is mirrored, one that leans is left out.
typedef enum plane { LEVEL, FROM_BELOW, LEANING } plane;

static sl_status read_plane(sli_dxf *dxf, sli_dxf_range entity, plane *out) {
    double x = 0, y = 0, z = 1;
    SL_TRY(sli_dxf_number(dxf, entity, 210, &x));
    SL_TRY(sli_dxf_number(dxf, entity, 220, &y));
    SL_TRY(sli_dxf_number(dxf, entity, 230, &z));
    // Writers round: a normal that leans by a millionth is meant to be upright.
    *out = fabs(x) + fabs(y) > 1e-6 * fabs(z) || z == 0 ? LEANING : z < 0 ? FROM_BELOW : LEVEL;
    return SL_OK;
}

/// Counts an entity that is no wall.
static void leave_out(sli_dxf *dxf, sli_word kind, sli_word layer) {
    size_t i = 0;
    while (i < dxf->others_count && !(sli_dxf_same_name(dxf->others[i].kind, kind) &&
                                      sli_dxf_same_name(dxf->others[i].layer, layer)))
        i++;
    if (i == SLI_DXF_OTHERS) {
        dxf->other_kinds++;
        return;
    }
    if (i == dxf->others_count) dxf->others[dxf->others_count++] = (sli_dxf_other){kind, layer, 0};
    dxf->others[i].count++;
}

// --- entities: lines and polylines

static sl_status draw_line(sli_dxf *dxf, sli_dxf_range entity) {
    sl_point to = {0, 0};
    dxf->pen.at = to;
    NEED(entity, 10, 20, 11, 21);
    SL_TRY(read_point(dxf, entity, 10, &dxf->pen.at));
    SL_TRY(read_point(dxf, entity, 11, &to));
    return sli_pen_line(&dxf->pen, to);
}

/// A piece of a polyline: straight, or an arc whose bulge is the tangent of a quarter of its angle,
/// positive counter-clockwise.
static sl_status draw_piece(sli_pen *pen, sl_point to, double bulge) {
    const sl_point from = pen->at;
    const sl_point chord = {to.x - from.x, to.y - from.y};
    if (bulge == 0 || (chord.x == 0 && chord.y == 0)) return sli_pen_line(pen, to);
    const double across = (1 - bulge * bulge) / (4 * bulge);
    const sl_point centre = {from.x + chord.x / 2 - across * chord.y,
                             from.y + chord.y / 2 + across * chord.x};
    const sl_point u = {from.x - centre.x, from.y - centre.y};
    return sli_pen_arc(pen, centre, u, (sl_point){-u.y, u.x}, 4 * atan(bulge), to);
}

/// A polyline's corners as they come; `next` draws up to the corner given.
typedef struct corners {
    sl_point first;
    double bulge; ///< of the piece that starts at the last corner
    size_t count;
} corners;

static sl_status next_corner(sli_dxf *dxf, corners *line, sl_point to, double bulge) {
    const double last = line->bulge;
    line->bulge = bulge;
    if (line->count++) return draw_piece(&dxf->pen, to, last);
    line->first = dxf->pen.at = to;
    return SL_OK;
}

static sl_status end_corners(sli_dxf *dxf, const corners *line, bool closed) {
    if (line->count < 2) return sli_dxf_fault(dxf, &no_length, dxf->pen.line);
    return closed ? draw_piece(&dxf->pen, line->first, line->bulge) : SL_OK;
}

static sl_status draw_light_polyline(sli_dxf *dxf, sli_dxf_range entity) {
    corners line = {0};
    int flags = 0;
    SL_TRY(sli_dxf_integer(dxf, entity, 70, &flags));
    for (size_t i = entity.begin; i < entity.end;) {
        if (sli_dxf_at(dxf, i)->code != 10) {
            i++;
            continue;
        }
        sli_dxf_range corner = {i, i + 1};
        while (corner.end < entity.end && sli_dxf_at(dxf, corner.end)->code != 10) corner.end++;
        sl_point at = {0, 0};
        double bulge = 0;
        NEED(corner, 20);
        SL_TRY(read_point(dxf, corner, 10, &at));
        SL_TRY(sli_dxf_number(dxf, corner, 42, &bulge));
        SL_TRY(next_corner(dxf, &line, at, bulge));
        i = corner.end;
    }
    return end_corners(dxf, &line, flags & 1);
}

/// A POLYLINE's corners are VERTEX entities of their own, up to a SEQEND.
static sl_status draw_polyline(sli_dxf *dxf, sli_dxf_range entity, size_t end, sli_word layer) {
    enum { MESH = 16, POLYFACE = 64, FRAME = 16 };
    corners line = {0};
    int flags = 0;
    SL_TRY(sli_dxf_integer(dxf, entity, 70, &flags));
    if (flags & (MESH | POLYFACE)) {
        dxf->drawn--;
        leave_out(dxf, sli_dxf_at(dxf, entity.begin)->value, layer);
        return SL_OK;
    }
    for (size_t i = entity.end; i < end && sli_word_is(sli_dxf_at(dxf, i)->value, "VERTEX");) {
        const sli_dxf_range vertex = sli_dxf_entity(dxf, i, end);
        sl_point at = {0, 0};
        double bulge = 0;
        int kind = 0;
        NEED(vertex, 10, 20);
        SL_TRY(read_point(dxf, vertex, 10, &at));
        SL_TRY(sli_dxf_number(dxf, vertex, 42, &bulge));
        SL_TRY(sli_dxf_integer(dxf, vertex, 70, &kind));
        if (!(kind & FRAME)) SL_TRY(next_corner(dxf, &line, at, bulge));
        i = vertex.end;
    }
    return end_corners(dxf, &line, flags & 1);
}

// --- entities: arcs

static sl_point on_arc(sl_point centre, sl_point u, sl_point v, double angle) {
    return (sl_point){centre.x + cos(angle) * u.x + sin(angle) * v.x,
                      centre.y + cos(angle) * u.y + sin(angle) * v.y};
}

/// The arc about a centre from one angle to another, counter-clockwise, in radians.
static sl_status draw_round(sli_dxf *dxf, sl_point centre, sl_point u, sl_point v, double from,
                            double to) {
    double sweep = to - from;
    if (!(fabs(sweep) <= 1e6)) return sli_dxf_fault(dxf, &no_angle, dxf->pen.line);
    sweep -= 2 * pi * floor(sweep / (2 * pi));
    if (sweep == 0) sweep = 2 * pi;
    const sl_point start = on_arc(centre, u, v, from);
    const sl_point turned = {start.x - centre.x, start.y - centre.y};
    const double c = cos(from), s = sin(from);
    const sl_point across = {c * v.x - s * u.x, c * v.y - s * u.y};
    dxf->pen.at = start;
    return sli_pen_arc(&dxf->pen, centre, turned, across, sweep,
                       sweep < 2 * pi ? on_arc(centre, u, v, to) : start);
}

static sl_status draw_circle(sli_dxf *dxf, sli_dxf_range entity, bool whole) {
    sl_point centre = {0, 0};
    double radius = 0, from = 0, to = 360;
    NEED(entity, 10, 20, 40);
    SL_TRY(read_point(dxf, entity, 10, &centre));
    SL_TRY(sli_dxf_number(dxf, entity, 40, &radius));
    if (!whole) {
        NEED(entity, 50, 51);
        SL_TRY(sli_dxf_number(dxf, entity, 50, &from));
        SL_TRY(sli_dxf_number(dxf, entity, 51, &to));
    }
    if (!(radius > 0)) return sli_dxf_fault(dxf, &no_radius, dxf->pen.line);
    return draw_round(dxf, centre, (sl_point){radius, 0}, (sl_point){0, radius}, from * (pi / 180),
                      to * (pi / 180));
}

/// Given in space, not in its plane; one seen from below turns the other way.
static sl_status draw_ellipse(sli_dxf *dxf, sli_dxf_range entity, plane lies) {
    sl_point centre = {0, 0}, major = {0, 0};
    double ratio = 1, from = 0, to = 2 * pi;
    NEED(entity, 10, 20, 11, 21, 40);
    SL_TRY(read_point(dxf, entity, 10, &centre));
    SL_TRY(read_point(dxf, entity, 11, &major));
    SL_TRY(sli_dxf_number(dxf, entity, 40, &ratio));
    SL_TRY(sli_dxf_number(dxf, entity, 41, &from));
    SL_TRY(sli_dxf_number(dxf, entity, 42, &to));
    if (ratio == 0 || (major.x == 0 && major.y == 0))
        return sli_dxf_fault(dxf, &no_size, dxf->pen.line);
    if (lies == FROM_BELOW) ratio = -ratio;
    return draw_round(dxf, centre, major, (sl_point){-ratio * major.y, ratio * major.x}, from, to);
}

// --- entities: splines

/// A B-spline: its knots and control points. Those of degree up to 3 without weights are drawn.
typedef struct spline {
    int degree;
    bool plain, sound;
    SL_ARRAY(double) knots;
    SL_ARRAY(sl_point) points;
} spline;

static sl_status read_spline(sli_dxf *dxf, sli_dxf_range entity, spline *out) {
    out->plain = out->sound = true;
    SL_TRY(sli_dxf_integer(dxf, entity, 71, &out->degree));
    for (size_t i = entity.begin; i < entity.end; i++) {
        const sli_dxf_pair *pair = sli_dxf_at(dxf, i);
        double value = 0;
        if (pair->code == 40) {
            SL_TRY(SL_ARRAY_ROOM(dxf->context, &out->knots, 1));
            SL_TRY(sli_dxf_read_number(dxf, pair, &value));
            out->sound &= !out->knots.count || value >= out->knots.items[out->knots.count - 1];
            out->knots.items[out->knots.count++] = value;
        } else if (pair->code == 41) {
            SL_TRY(sli_dxf_read_number(dxf, pair, &value));
            out->plain &= value == 1;
        } else if (pair->code == 10) {
            sl_point at = {0, 0};
            SL_TRY(SL_ARRAY_ROOM(dxf->context, &out->points, 1));
            SL_TRY(read_point(dxf, (sli_dxf_range){i, entity.end}, 10, &at));
            out->points.items[out->points.count++] = at;
        }
    }
    out->plain &= out->degree <= 3 && out->points.count > 0;
    out->sound &= out->degree >= 1 && out->points.count > (size_t)out->degree &&
                  out->knots.count == out->points.count + (size_t)out->degree + 1;
    return SL_OK;
}

static sl_status draw_spline(sli_dxf *dxf, sli_dxf_range entity, sli_word layer) {
    spline s = {0};
    sl_status status = read_spline(dxf, entity, &s);
    if (status == SL_OK && s.plain && !s.sound) {
        status = sli_dxf_fault(dxf, &no_spline, dxf->pen.line);
    } else if (status == SL_OK && s.plain) {
        status = sli_pen_spline(&dxf->pen, s.degree, s.knots.items, s.points.items, s.points.count);
    } else if (status == SL_OK) {
        dxf->drawn--;
        leave_out(dxf, sli_dxf_at(dxf, entity.begin)->value, layer);
    }
    sl_free(dxf->context, s.knots.items);
    sl_free(dxf->context, s.points.items);
    return status;
}

// --- entities: blocks inserted

/// From a block's coordinates to those of what inserts it, for one of the rows and columns.
static sli_affine insertion(sl_point at, sl_point step, sl_point scale, double turn,
                            sl_point base) {
    const sli_affine to_origin = {.xx = scale.x,
                                  .x0 = -scale.x * base.x + step.x,
                                  .yy = scale.y,
                                  .y0 = -scale.y * base.y + step.y};
    sli_affine affine = sli_affine_after(sli_affine_turn(turn), to_origin);
    affine.x0 += at.x;
    affine.y0 += at.y;
    return affine;
}

/// How much there is was checked before (dxf_count.c).
static sl_status count_work(sli_dxf *dxf) {
    return ++dxf->work % 4096 == 0 ? sl_check_cancelled(dxf->context) : SL_OK;
}

/// Whether a field for a text is shown, as its flags say: those of a part's price and the like are
/// hidden.
static bool is_shown(const sli_dxf *dxf, sli_dxf_range field) {
    const sli_word flags = sli_dxf_text(dxf, field, 70);
    return !flags.length || !((flags.at[flags.length - 1] - '0') & 1);
}

/// Whether a block is a tag, as of a room: fields for texts, and fewer lines between or under them.
static bool is_tag(const sli_dxf *dxf, const sli_dxf_block *block) {
    size_t fields = 0, lines = 0;
    for (size_t i = block->entities.begin; i < block->entities.end; i++) {
        const sli_dxf_pair *pair = sli_dxf_at(dxf, i);
        if (pair->code != 0) continue;
        if (sli_word_is(pair->value, "ATTDEF"))
            fields += is_shown(dxf, sli_dxf_entity(dxf, i, block->entities.end));
        else if (sli_word_is(pair->value, "LINE"))
            lines++;
        else if (!sli_dxf_is_text(pair->value))
            return false;
    }
    return fields > lines;
}

/// The group of a block: by its name, or of tags where neither this nor its layer says anything; 0
/// for none.
static sl_status group_of_block(sli_dxf *dxf, const sli_dxf_block *block, sli_word layer,
                                uint32_t *out) {
    static const char tags[] = "tag blocks";
    uint32_t named, on;
    *out = 0;
    SL_TRY(sli_contents_group(&dxf->contents, block->name, &named));
    if (sli_contents_means(&dxf->contents, named)) {
        *out = named;
        return SL_OK;
    }
    if (!is_tag(dxf, block)) return SL_OK;
    SL_TRY(sli_contents_group(&dxf->contents, layer, &on));
    if (sli_contents_means(&dxf->contents, on)) return SL_OK;
    return sli_contents_group(&dxf->contents, (sli_word){tags, sizeof tags - 1}, out);
}

static sl_status draw_insert(sli_dxf *dxf, sli_dxf_range entity, sli_word layer, unsigned depth) {
    const sli_word name = sli_dxf_text(dxf, entity, 2);
    const sli_dxf_block *block = sli_dxf_find_block(dxf, name);
    if (!block) return sli_dxf_fault(dxf, &no_block, dxf->pen.line);
    sl_point at = {0, 0}, scale = {1, 1}, gap = {0, 0};
    double turn = 0;
    int columns = 1, rows = 1;
    SL_TRY(read_point(dxf, entity, 10, &at));
    SL_TRY(sli_dxf_number(dxf, entity, 41, &scale.x));
    SL_TRY(sli_dxf_number(dxf, entity, 42, &scale.y));
    SL_TRY(sli_dxf_number(dxf, entity, 50, &turn));
    SL_TRY(sli_dxf_integer(dxf, entity, 70, &columns));
    SL_TRY(sli_dxf_integer(dxf, entity, 71, &rows));
    SL_TRY(sli_dxf_number(dxf, entity, 44, &gap.x));
    SL_TRY(sli_dxf_number(dxf, entity, 45, &gap.y));
    const sli_affine outer = dxf->pen.affine;
    sli_dxf_clip clip;
    const uint32_t block_before = dxf->block;
    uint32_t named;
    SL_TRY(group_of_block(dxf, block, layer, &named));
    sl_status status = sli_dxf_read_clip(dxf, entity, &clip);
    if (named) dxf->block = named;
    for (int row = 0; row < rows && status == SL_OK; row++) {
        for (int column = 0; column < columns && status == SL_OK; column++) {
            const size_t first = dxf->pen.map->wall_count;
            const sl_point step = {column * gap.x, row * gap.y};
            const sli_affine inner =
                sli_affine_after(outer, insertion(at, step, scale, turn, block->base));
            dxf->pen.affine = inner;
            status = count_work(dxf);
            if (status == SL_OK) status = sli_dxf_draw(dxf, block->entities, layer, depth + 1);
            if (status == SL_OK) status = sli_dxf_cut(dxf, &clip, inner, first);
        }
    }
    dxf->block = block_before;
    sl_free(dxf->context, clip.corners);
    return status;
}

// --- entities: all of them

static sl_status draw_shape(sli_dxf *dxf, sli_dxf_range entity, size_t end, sli_word layer,
                            plane lies, unsigned depth) {
    const sli_word kind = sli_dxf_at(dxf, entity.begin)->value;
    dxf->drawn++;
    if (!sli_word_is(kind, "INSERT")) sl_bits_add(dxf->walls, entity.begin);
    if (sli_word_is(kind, "LINE") || sli_word_is(kind, "3DLINE")) return draw_line(dxf, entity);
    if (sli_word_is(kind, "LWPOLYLINE")) return draw_light_polyline(dxf, entity);
    if (sli_word_is(kind, "POLYLINE")) return draw_polyline(dxf, entity, end, layer);
    if (sli_word_is(kind, "ARC")) return draw_circle(dxf, entity, false);
    if (sli_word_is(kind, "CIRCLE")) return draw_circle(dxf, entity, true);
    if (sli_word_is(kind, "ELLIPSE")) return draw_ellipse(dxf, entity, lies);
    if (sli_word_is(kind, "SPLINE")) return draw_spline(dxf, entity, layer);
    dxf->drawn--;
    if (sli_word_is(kind, "INSERT")) return draw_insert(dxf, entity, layer, depth);
    leave_out(dxf, kind, layer);
    return SL_OK;
}

// --- entities of layers that say what they hold

/// "open-NAME" or "shut-NAME", behind the name of the layer of doors; else a name alone.
static void read_door_layer(sli_word *rest, bool *open) {
    static const char *const words[] = {"shut", "open"};
    *open = true;
    for (size_t i = 0; i < 2; i++) {
        if (rest->length < 4 ||
            !sli_dxf_same_name((sli_word){rest->at, 4}, (sli_word){words[i], 4}))
            continue;
        if (rest->length > 4 && rest->at[4] != '-') continue;
        const size_t behind = rest->length > 4 ? 5 : 4;
        *open = i == 1;
        *rest = (sli_word){rest->at + behind, rest->length - behind};
        return;
    }
}

/// A start is a POINT; its heading is the angle of the point's axis.
static sl_status read_start(sli_dxf *dxf, sli_dxf_range entity, sl_point *at, double *heading) {
    SL_TRY(read_point(dxf, entity, 10, at));
    SL_TRY(sli_dxf_number(dxf, entity, 50, heading));
    *at = sli_affine_apply(dxf->pen.affine, *at);
    *heading = sli_heading_through(dxf->pen.affine, *heading);
    return SL_OK;
}

/// Draws an entity, and tells whose it is: its layer's, or the block's about it, where the layer
/// says nothing, or is that of the insertion.
static sl_status draw_in_group(sli_dxf *dxf, sli_dxf_range entity, size_t end, sli_word layer,
                               plane lies, unsigned depth) {
    sli_contents *contents = &dxf->contents;
    uint32_t group;
    if (!sli_contents_asks(contents)) return draw_shape(dxf, entity, end, layer, lies, depth);
    SL_TRY(sli_contents_group(contents, layer, &group));
    const sli_meaning block = sli_contents_means(contents, dxf->block);
    const bool inserted = sli_word_is(sli_dxf_text(dxf, entity, 8), "0") && block != SLI_MEANS_WALL;
    if (block && (inserted || !sli_contents_means(contents, group))) group = dxf->block;
    sli_contents_begin(contents, &dxf->pen);
    SL_TRY(draw_shape(dxf, entity, end, layer, lies, depth));
    return sli_contents_end(contents, &dxf->pen, group);
}

/// Draws an entity; on a layer that says what it holds, into a map of its own, and its lines become
/// that.
static sl_status draw_in_layer(sli_dxf *dxf, sli_dxf_range entity, size_t end, sli_word layer,
                               plane lies, unsigned depth) {
    const sli_word kind = sli_dxf_at(dxf, entity.begin)->value;
    sli_word rest = {"", 0};
    sl_point start = {0, 0};
    sli_layer_item item = {.layer = sli_layer_of(layer, &rest), .points = &start};
    if (sli_word_is(kind, "INSERT")) return draw_shape(dxf, entity, end, layer, lies, depth);
    if (!item.layer) return draw_in_group(dxf, entity, end, layer, lies, depth);
    if (item.layer == SLI_LAYER_DOOR) read_door_layer(&rest, &item.open);
    char *name = sl_copy_text(dxf->context, rest.at, rest.length);
    if (!name) return SL_NO_MEMORY;
    item.name = name;
    sl_map drawn = {0}, *map = dxf->pen.map;
    const size_t walls = dxf->pen.walls;
    sl_status status = SL_OK;
    dxf->pen.map = &drawn;
    if (item.layer != SLI_LAYER_START) {
        status = draw_shape(dxf, entity, end, layer, lies, depth);
    } else if (sli_word_is(kind, "POINT")) {
        status = read_start(dxf, entity, &start, &item.heading);
        item.count = 1;
    } else {
        leave_out(dxf, kind, layer);
    }
    dxf->pen.map = map;
    if (item.layer != SLI_LAYER_WALL) dxf->pen.walls = walls;
    if (status == SL_OK)
        status = sli_layer_take(dxf->context, dxf->name, map, &item, &drawn, dxf->pen.line);
    sl_map_destroy(dxf->context, &drawn);
    sl_free(dxf->context, name);
    return status;
}

static sl_status draw_taken(sli_dxf *dxf, sli_dxf_range entity, size_t end, sli_word layer,
                            unsigned depth) {
    const sli_word kind = sli_dxf_at(dxf, entity.begin)->value;
    plane lies = LEVEL;
    if (!sli_word_is(kind, "LINE") && !sli_word_is(kind, "3DLINE"))
        SL_TRY(read_plane(dxf, entity, &lies));
    if (lies == LEANING) {
        dxf->out_of_plane++;
        return SL_OK;
    }
    if (lies == FROM_BELOW && !sli_word_is(kind, "ELLIPSE"))
        dxf->pen.affine = sli_affine_after(dxf->pen.affine, (sli_affine){.xx = -1, .yy = 1});
    dxf->pen.line = sli_dxf_at(dxf, entity.begin)->line;
    return draw_in_layer(dxf, entity, end, layer, lies, depth);
}

static sl_status draw_entity(sli_dxf *dxf, sli_dxf_range entity, size_t end, sli_word layer,
                             unsigned depth) {
    const sli_word kind = sli_dxf_at(dxf, entity.begin)->value;
    sli_word own = sli_dxf_text(dxf, entity, 8);
    if (sli_word_is(own, "0") && layer.length) own = layer;
    int on_paper = 0;
    const bool part = sli_word_is(kind, "VERTEX") || sli_word_is(kind, "SEQEND");
    if (part) return SL_OK;
    SL_TRY(sli_dxf_integer(dxf, entity, 67, &on_paper));
    if (sli_dxf_is_text(kind) && !on_paper && sli_dxf_layer_is_on(dxf, own))
        SL_TRY(sli_dxf_take_text(dxf, entity));
    if (sli_word_is(kind, "ATTRIB")) return SL_OK;
    if (on_paper) {
        dxf->on_paper++;
        return SL_OK;
    }
    bool taken = true;
    if (!sli_word_is(kind, "INSERT")) SL_TRY(sli_dxf_take_layer(dxf, own, &taken));
    if (taken) return draw_taken(dxf, entity, end, own, depth);
    dxf->other_layers++;
    return SL_OK;
}

/// Draws an entity, all of it or, if it is faulty, none.
static sl_status draw_or_pass(sli_dxf *dxf, sli_dxf_range entity, size_t end, sli_word layer,
                              unsigned depth) {
    const sli_pen before = dxf->pen;
    const size_t drawn = dxf->drawn, walls = before.map->wall_count;
    const bool named = sl_bits_has(dxf->walls, entity.begin);
    dxf->fault = NULL;
    sl_status status = draw_entity(dxf, entity, end, layer, depth);
    if (status == SL_BAD_INPUT && !dxf->fault && dxf->pen.too_far)
        status = sli_dxf_fault(dxf, &too_far, dxf->pen.line);
    dxf->pen.affine = before.affine;
    if (status != SL_BAD_INPUT || !dxf->fault) return status;
    sli_faults_add(&dxf->faults, dxf->fault, dxf->fault_line);
    dxf->fault = NULL;
    dxf->pen.walls = before.walls;
    dxf->pen.points = before.points;
    dxf->pen.too_far = false;
    dxf->pen.map->wall_count = walls;
    dxf->drawn = drawn;
    if (!named && sl_bits_has(dxf->walls, entity.begin)) sl_bits_flip(dxf->walls, entity.begin);
    return SL_OK;
}

sl_status sli_dxf_draw(sli_dxf *dxf, sli_dxf_range range, sli_word layer, unsigned depth) {
    for (size_t i = range.begin; i < range.end;) {
        const sli_dxf_range entity = sli_dxf_entity(dxf, i, range.end);
        SL_TRY(count_work(dxf));
        SL_TRY(draw_or_pass(dxf, entity, range.end, layer, depth));
        i = entity.end;
    }
    return SL_OK;
}

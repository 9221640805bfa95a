/// DXF (Autodesk, DXF Reference). A drawing is lines in pairs, a group code and a value, in
/// sections HEADER, TABLES, BLOCKS and ENTITIES. The pairs are read first; then every entity that
/// is walls is drawn by the pen: LINE, LWPOLYLINE and POLYLINE with bulges, ARC, CIRCLE, ELLIPSE,
/// SPLINE, and INSERT, which draws a block's entities once more. Blocks within blocks could ask for
/// any amount of work: their depth and the number of entities drawn are bounded. Layers whose names
/// begin with "sightline-" hold doors, solid ground and so on (layers.h).
#include "io/layers.h"
#include "io/names.h"
#include "io/shapes.h"
#include "map/scan.h"
#include "sightline/io.h"
#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>

/// A group code and its value.
typedef struct dxf_pair {
    int code;
    uint32_t line; ///< of the value
    sli_word value;
} dxf_pair;

/// Pairs begin .. end - 1.
typedef struct dxf_range {
    size_t begin, end;
} dxf_range;

typedef struct dxf_block {
    sli_word name;
    dxf_range entities;
    sl_point base;
} dxf_block;

typedef struct dxf_layer {
    sli_word name;
    bool on; ///< and not frozen
    bool taken;
    size_t entities;
} dxf_layer;

/// Entities of a kind that is no wall, on a layer.
typedef struct dxf_other {
    sli_word kind, layer;
    size_t count;
} dxf_other;

/// So many of them are told apart.
enum { MOST_OTHERS = 6 };

typedef struct drawing {
    sl_context *context;
    const char *name;
    const sl_import_options *options;
    SL_ARRAY(dxf_pair) pairs;
    SL_ARRAY(dxf_block) blocks;
    SL_ARRAY(dxf_layer) layers; ///< of the table, and behind them those that entities name
    size_t table_layers;        ///< of the table
    dxf_other others[MOST_OTHERS];
    size_t others_count;
    dxf_range entities;
    int unit; ///< $INSUNITS; 0 where the drawing does not tell
    sli_pen pen;
    size_t work;    ///< entities and insertions gone through
    sl_bits *walls; ///< the pairs that start an entity that was drawn
    /// Entities drawn; those of other layers, further kinds, of the paper or out of the plane.
    size_t drawn, other_layers, other_kinds, on_paper, out_of_plane;
} drawing;

static inline const dxf_pair *dxf_at(const drawing *dxf, size_t i) {
    return &dxf->pairs.items[i];
}

// --- names

static sli_word trimmed(sli_word word) {
    while (word.length && strchr(" \t", *word.at)) word.at++, word.length--;
    while (word.length && strchr(" \t", word.at[word.length - 1])) word.length--;
    return word;
}

static char small(char c) {
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static bool same_name(sli_word a, sli_word b) {
    if (a.length != b.length) return false;
    for (size_t i = 0; i < a.length; i++)
        if (small(a.at[i]) != small(b.at[i])) return false;
    return true;
}

// --- pairs

static bool read_code(sli_word word, int *code) {
    double value;
    if (!sl_number_read(word.at, word.length, &value)) return false;
    *code = value >= -5 && value <= 1071 ? (int)value : -6;
    return *code == value;
}

static sl_status refuse_other_files(drawing *dxf, const char *text, size_t size) {
    static const char binary[] = "AutoCAD Binary DXF";
    if (size >= sizeof binary - 1 && memcmp(text, binary, sizeof binary - 1) == 0)
        return sl_fail_at(dxf->context, dxf->name, 0, "binary DXF: save the drawing as ASCII DXF");
    if (size >= 6 && memcmp(text, "AC10", 4) == 0)
        return sl_fail_at(dxf->context, dxf->name, 0,
                          "a DWG drawing: save it as ASCII DXF in the program that it is from");
    return sli_refuse_nul(dxf->context, dxf->name, text, size);
}

/// Reads all pairs up to the one that says EOF.
static sl_status read_pairs(drawing *dxf, const char *text, size_t size) {
    sli_lines lines = sli_lines_of(text, size);
    sli_word code, value;
    while (sli_lines_next(&lines, &code)) {
        dxf_pair pair;
        code = trimmed(code);
        if (!read_code(code, &pair.code))
            return sl_fail_at(dxf->context, dxf->name, lines.line,
                              "expected a group code (a whole number), found '%s'",
                              sli_show(code).text);
        if (!sli_lines_next(&lines, &value))
            return sl_fail_at(dxf->context, dxf->name, lines.line,
                              "the file ends where the value of group %d should be", pair.code);
        pair.line = lines.line;
        pair.value = trimmed(value);
        SL_TRY(SL_ARRAY_ROOM(dxf->context, &dxf->pairs, 1));
        dxf->pairs.items[dxf->pairs.count++] = pair;
        if (pair.code == 0 && sli_word_is(pair.value, "EOF")) return SL_OK;
        if (dxf->pairs.count % 4096 == 0) SL_TRY(sl_check_cancelled(dxf->context));
    }
    return sl_fail_at(dxf->context, dxf->name, lines.line,
                      "the drawing ends without an EOF: the file is not all there");
}

/// From the pair `begin`, which starts an entity, to the next one that starts another.
static dxf_range dxf_entity(const drawing *dxf, size_t begin, size_t end) {
    size_t stop = begin + 1;
    while (stop < end && dxf_at(dxf, stop)->code != 0) stop++;
    return (dxf_range){begin, stop};
}

/// The value of a pair.
static sl_status read_number(drawing *dxf, const dxf_pair *pair, double *value) {
    double number;
    if (!sl_number_read(pair->value.at, pair->value.length, &number) ||
        !(number <= SL_COORDINATE_MAX && number >= -SL_COORDINATE_MAX))
        return sl_fail_at(dxf->context, dxf->name, pair->line,
                          "expected a number up to %g for group %d, found '%s'", SL_COORDINATE_MAX,
                          pair->code, sli_show(pair->value).text);
    *value = number;
    return SL_OK;
}

static const dxf_pair *find(const drawing *dxf, dxf_range entity, int code) {
    for (size_t i = entity.begin; i < entity.end; i++)
        if (dxf_at(dxf, i)->code == code) return dxf_at(dxf, i);
    return NULL;
}

/// The first value of a group in an entity; `value` stays as it is where there is none.
static sl_status dxf_number(drawing *dxf, dxf_range entity, int code, double *value) {
    const dxf_pair *pair = find(dxf, entity, code);
    return pair ? read_number(dxf, pair, value) : SL_OK;
}

static sl_status dxf_integer(drawing *dxf, dxf_range entity, int code, int *value) {
    const dxf_pair *pair = find(dxf, entity, code);
    if (!pair) return SL_OK;
    double number = 0;
    SL_TRY(read_number(dxf, pair, &number));
    if (!(number >= -32768 && number <= 65535) || number != (int)number)
        return sl_fail_at(dxf->context, dxf->name, pair->line,
                          "expected a whole number of 16 bits for group %d, found '%s'", code,
                          sli_show(pair->value).text);
    *value = (int)number;
    return SL_OK;
}

static sli_word dxf_text(const drawing *dxf, dxf_range entity, int code) {
    const dxf_pair *pair = find(dxf, entity, code);
    return pair ? pair->value : (sli_word){"", 0};
}

// --- header and tables

static sl_status read_header(drawing *dxf, dxf_range section) {
    for (size_t i = section.begin; i + 1 < section.end; i++) {
        if (dxf_at(dxf, i)->code != 9 || !sli_word_is(dxf_at(dxf, i)->value, "$INSUNITS")) continue;
        return dxf_integer(dxf, (dxf_range){i + 1, i + 2}, 70, &dxf->unit);
    }
    return SL_OK;
}

static bool is_asked_for(const char *list, sli_word layer) {
    for (sli_word name; sli_layers_next(&list, &name);)
        if (same_name(name, layer)) return true;
    return false;
}

/// Layers of the table: without the option those are taken that are on and not frozen.
static sl_status read_tables(drawing *dxf, dxf_range section) {
    for (size_t i = section.begin; i < section.end; i++) {
        const dxf_pair *pair = dxf_at(dxf, i);
        if (pair->code != 0 || !sli_word_is(pair->value, "LAYER")) continue;
        const dxf_range entry = dxf_entity(dxf, i, section.end);
        const char *list = dxf->options->layers;
        int colour = 7, flags = 0;
        SL_TRY(dxf_integer(dxf, entry, 62, &colour));
        SL_TRY(dxf_integer(dxf, entry, 70, &flags));
        dxf_layer layer = {.name = dxf_text(dxf, entry, 2), .on = colour >= 0 && !(flags & 1)};
        layer.taken = list ? is_asked_for(list, layer.name) : layer.on;
        SL_TRY(SL_ARRAY_ROOM(dxf->context, &dxf->layers, 1));
        dxf->layers.items[dxf->layers.count++] = layer;
        dxf->table_layers++;
    }
    return SL_OK;
}

/// Layers that the table does not have: so many are counted. Finding them takes time.
enum { MOST_UNLISTED = 256 };

/// Counts an entity for its layer, and says whether those of the layer are taken. Names are the
/// same in small letters and capitals.
static sl_status dxf_take_layer(drawing *dxf, sli_word name, bool *taken) {
    for (size_t i = 0; i < dxf->layers.count; i++) {
        dxf_layer *layer = &dxf->layers.items[i];
        if (!same_name(layer->name, name)) continue;
        layer->entities++;
        *taken = layer->taken;
        return SL_OK;
    }
    const char *list = dxf->options->layers;
    *taken = !list || is_asked_for(list, name);
    if (dxf->layers.count - dxf->table_layers == MOST_UNLISTED) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(dxf->context, &dxf->layers, 1));
    dxf->layers.items[dxf->layers.count++] = (dxf_layer){name, true, *taken, 1};
    return SL_OK;
}

// --- blocks

static int compare_blocks(const void *left, const void *right) {
    const dxf_block *a = left, *b = right;
    const size_t least = a->name.length < b->name.length ? a->name.length : b->name.length;
    for (size_t i = 0; i < least; i++) {
        const int order = small(a->name.at[i]) - small(b->name.at[i]);
        if (order) return order;
    }
    return (a->name.length > least) - (b->name.length > least);
}

static const dxf_block *dxf_find_block(const drawing *dxf, sli_word name) {
    const dxf_block wanted = {.name = name};
    if (!dxf->blocks.count) return NULL;
    return bsearch(&wanted, dxf->blocks.items, dxf->blocks.count, sizeof wanted, compare_blocks);
}

static sl_status read_blocks(drawing *dxf, dxf_range section) {
    dxf_block block = {0};
    bool within = false;
    for (size_t i = section.begin; i < section.end;) {
        const dxf_range entity = dxf_entity(dxf, i, section.end);
        const dxf_pair *kind = dxf_at(dxf, i);
        if (sli_word_is(kind->value, "BLOCK")) {
            block = (dxf_block){.name = dxf_text(dxf, entity, 2), .entities = {entity.end, 0}};
            SL_TRY(dxf_number(dxf, entity, 10, &block.base.x));
            SL_TRY(dxf_number(dxf, entity, 20, &block.base.y));
            within = true;
        } else if (sli_word_is(kind->value, "ENDBLK") && within) {
            block.entities.end = i;
            SL_TRY(SL_ARRAY_ROOM(dxf->context, &dxf->blocks, 1));
            dxf->blocks.items[dxf->blocks.count++] = block;
            within = false;
        }
        i = entity.end;
    }
    if (within)
        return sl_fail_at(dxf->context, dxf->name, dxf_at(dxf, section.end)->line,
                          "block '%s' has no ENDBLK", sli_show(block.name).text);
    if (dxf->blocks.count)
        qsort(dxf->blocks.items, dxf->blocks.count, sizeof *dxf->blocks.items, compare_blocks);
    return SL_OK;
}

// --- sections

/// Finds the section that starts at pair `begin`, and reads what is in it.
static sl_status read_section(drawing *dxf, size_t begin, size_t *after) {
    const size_t count = dxf->pairs.count;
    const dxf_pair *name = dxf_at(dxf, begin + 1);
    if (name->code != 2)
        return sl_fail_at(dxf->context, dxf->name, name->line, "a section without a name");
    dxf_range section = {begin + 2, begin + 2};
    while (section.end < count) {
        const dxf_pair *pair = dxf_at(dxf, section.end);
        if (pair->code == 0 &&
            (sli_word_is(pair->value, "ENDSEC") || sli_word_is(pair->value, "EOF")))
            break;
        section.end++;
    }
    if (!sli_word_is(dxf_at(dxf, section.end)->value, "ENDSEC"))
        return sl_fail_at(dxf->context, dxf->name, name->line, "section '%s' has no ENDSEC",
                          sli_show(name->value).text);
    *after = section.end + 1;
    if (sli_word_is(name->value, "HEADER")) return read_header(dxf, section);
    if (sli_word_is(name->value, "TABLES")) return read_tables(dxf, section);
    if (sli_word_is(name->value, "BLOCKS")) return read_blocks(dxf, section);
    if (sli_word_is(name->value, "ENTITIES")) dxf->entities = section;
    return SL_OK;
}

static sl_status read_sections(drawing *dxf) {
    size_t i = 0;
    while (dxf_at(dxf, i)->code == 999) i++;
    while (i + 1 < dxf->pairs.count) {
        const dxf_pair *pair = dxf_at(dxf, i);
        if (pair->code != 0 || !sli_word_is(pair->value, "SECTION"))
            return sl_fail_at(dxf->context, dxf->name, pair->line,
                              "expected a SECTION, found '%s': is it a DXF drawing?",
                              sli_show(pair->value).text);
        SL_TRY(read_section(dxf, i, &i));
    }
    if (dxf->entities.begin == 0)
        return sl_fail_at(dxf->context, dxf->name, 0, "the drawing has no section ENTITIES");
    return SL_OK;
}

// --- entities: points and planes

/// Blocks within blocks; a block that inserts itself goes deeper than any drawing does.
#define MOST_DEPTH 64
/// Entities drawn and blocks inserted, and no more: a few nested blocks could ask for any number.
#define MOST_WORK ((size_t)1 << 24)

static const double pi = 3.14159265358979323846;

static sl_status read_coordinate(drawing *dxf, dxf_range entity, int code, double *value) {
    const dxf_pair *pair = find(dxf, entity, code);
    if (!pair) return SL_OK;
    sli_pen_digits(&dxf->pen, pair->value.at, pair->value.length, 1);
    return read_number(dxf, pair, value);
}

static sl_status read_point(drawing *dxf, dxf_range entity, int code, sl_point *point) {
    SL_TRY(read_coordinate(dxf, entity, code, &point->x));
    return read_coordinate(dxf, entity, code + 10, &point->y);
}

/// Entities drawn in their own plane: one seen from below is mirrored, one that leans is left out.
typedef enum plane { LEVEL, FROM_BELOW, LEANING } plane;

static sl_status read_plane(drawing *dxf, dxf_range entity, plane *out) {
    double x = 0, y = 0, z = 1;
    SL_TRY(dxf_number(dxf, entity, 210, &x));
    SL_TRY(dxf_number(dxf, entity, 220, &y));
    SL_TRY(dxf_number(dxf, entity, 230, &z));
    // Writers round: a normal that leans by a millionth is meant to be upright.
    *out = fabs(x) + fabs(y) > 1e-6 * fabs(z) || z == 0 ? LEANING : z < 0 ? FROM_BELOW : LEVEL;
    return SL_OK;
}

/// Counts an entity that is no wall.
static sl_status leave_out(drawing *dxf, sli_word kind, sli_word layer) {
    size_t i = 0;
    while (i < dxf->others_count &&
           !(same_name(dxf->others[i].kind, kind) && same_name(dxf->others[i].layer, layer)))
        i++;
    if (i == MOST_OTHERS) {
        dxf->other_kinds++;
        return SL_OK;
    }
    if (i == dxf->others_count) dxf->others[dxf->others_count++] = (dxf_other){kind, layer, 0};
    dxf->others[i].count++;
    return SL_OK;
}

// --- entities: lines and polylines

static sl_status draw_line(drawing *dxf, dxf_range entity) {
    sl_point to = {0, 0};
    dxf->pen.at = to;
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

static sl_status next_corner(drawing *dxf, corners *line, sl_point to, double bulge) {
    const double last = line->bulge;
    line->bulge = bulge;
    if (line->count++) return draw_piece(&dxf->pen, to, last);
    line->first = dxf->pen.at = to;
    return SL_OK;
}

static sl_status end_corners(drawing *dxf, const corners *line, bool closed) {
    return closed && line->count > 1 ? draw_piece(&dxf->pen, line->first, line->bulge) : SL_OK;
}

static sl_status draw_light_polyline(drawing *dxf, dxf_range entity) {
    corners line = {0};
    int flags = 0;
    SL_TRY(dxf_integer(dxf, entity, 70, &flags));
    for (size_t i = entity.begin; i < entity.end;) {
        if (dxf_at(dxf, i)->code != 10) {
            i++;
            continue;
        }
        dxf_range corner = {i, i + 1};
        while (corner.end < entity.end && dxf_at(dxf, corner.end)->code != 10) corner.end++;
        sl_point at = {0, 0};
        double bulge = 0;
        SL_TRY(read_point(dxf, corner, 10, &at));
        SL_TRY(dxf_number(dxf, corner, 42, &bulge));
        SL_TRY(next_corner(dxf, &line, at, bulge));
        i = corner.end;
    }
    return end_corners(dxf, &line, flags & 1);
}

/// A POLYLINE's corners are VERTEX entities of their own, up to a SEQEND.
static sl_status draw_polyline(drawing *dxf, dxf_range entity, size_t end, sli_word layer) {
    enum { MESH = 16, POLYFACE = 64, FRAME = 16 };
    corners line = {0};
    int flags = 0;
    SL_TRY(dxf_integer(dxf, entity, 70, &flags));
    if (flags & (MESH | POLYFACE)) {
        dxf->drawn--;
        return leave_out(dxf, dxf_at(dxf, entity.begin)->value, layer);
    }
    for (size_t i = entity.end; i < end && sli_word_is(dxf_at(dxf, i)->value, "VERTEX");) {
        const dxf_range vertex = dxf_entity(dxf, i, end);
        sl_point at = {0, 0};
        double bulge = 0;
        int kind = 0;
        SL_TRY(read_point(dxf, vertex, 10, &at));
        SL_TRY(dxf_number(dxf, vertex, 42, &bulge));
        SL_TRY(dxf_integer(dxf, vertex, 70, &kind));
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
static sl_status draw_round(drawing *dxf, sl_point centre, sl_point u, sl_point v, double from,
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
    return sli_pen_arc(&dxf->pen, centre, turned, across, sweep,
                       sweep < 2 * pi ? on_arc(centre, u, v, to) : start);
}

static sl_status draw_circle(drawing *dxf, dxf_range entity, bool whole) {
    sl_point centre = {0, 0};
    double radius = 0, from = 0, to = 360;
    SL_TRY(read_point(dxf, entity, 10, &centre));
    SL_TRY(dxf_number(dxf, entity, 40, &radius));
    if (!whole) {
        SL_TRY(dxf_number(dxf, entity, 50, &from));
        SL_TRY(dxf_number(dxf, entity, 51, &to));
    }
    if (!(radius > 0))
        return sl_fail_at(dxf->context, dxf->name, dxf->pen.line,
                          "a circle's or arc's radius (group 40) must be positive");
    return draw_round(dxf, centre, (sl_point){radius, 0}, (sl_point){0, radius}, from * (pi / 180),
                      to * (pi / 180));
}

/// Given in space, not in its plane; one seen from below turns the other way.
static sl_status draw_ellipse(drawing *dxf, dxf_range entity, plane lies) {
    sl_point centre = {0, 0}, major = {0, 0};
    double ratio = 1, from = 0, to = 2 * pi;
    SL_TRY(read_point(dxf, entity, 10, &centre));
    SL_TRY(read_point(dxf, entity, 11, &major));
    SL_TRY(dxf_number(dxf, entity, 40, &ratio));
    SL_TRY(dxf_number(dxf, entity, 41, &from));
    SL_TRY(dxf_number(dxf, entity, 42, &to));
    if (lies == FROM_BELOW) ratio = -ratio;
    return draw_round(dxf, centre, major, (sl_point){-ratio * major.y, ratio * major.x}, from, to);
}

// --- entities: splines

/// A B-spline of degree up to 3 without weights: its knots and control points.
typedef struct spline {
    int degree;
    SL_ARRAY(double) knots;
    SL_ARRAY(sl_point) points;
} spline;

static sl_status read_spline(drawing *dxf, dxf_range entity, spline *out, bool *plain) {
    *plain = true;
    SL_TRY(dxf_integer(dxf, entity, 71, &out->degree));
    for (size_t i = entity.begin; i < entity.end; i++) {
        const dxf_pair *pair = dxf_at(dxf, i);
        double value = 0;
        if (pair->code == 40) {
            SL_TRY(SL_ARRAY_ROOM(dxf->context, &out->knots, 1));
            SL_TRY(read_number(dxf, pair, &value));
            *plain &= !out->knots.count || value >= out->knots.items[out->knots.count - 1];
            out->knots.items[out->knots.count++] = value;
        } else if (pair->code == 41) {
            SL_TRY(read_number(dxf, pair, &value));
            *plain &= value == 1;
        } else if (pair->code == 10) {
            sl_point at = {0, 0};
            SL_TRY(SL_ARRAY_ROOM(dxf->context, &out->points, 1));
            SL_TRY(read_point(dxf, (dxf_range){i, entity.end}, 10, &at));
            out->points.items[out->points.count++] = at;
        }
    }
    *plain &= out->degree >= 1 && out->degree <= 3 && out->points.count > (size_t)out->degree &&
              out->knots.count == out->points.count + (size_t)out->degree + 1;
    return SL_OK;
}

static sl_status draw_spline(drawing *dxf, dxf_range entity, sli_word layer) {
    spline s = {0};
    bool plain = true;
    sl_status status = read_spline(dxf, entity, &s, &plain);
    if (status == SL_OK && plain) {
        status = sli_pen_spline(&dxf->pen, s.degree, s.knots.items, s.points.items, s.points.count);
    } else if (status == SL_OK) {
        dxf->drawn--;
        status = leave_out(dxf, dxf_at(dxf, entity.begin)->value, layer);
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

static sl_status count_work(drawing *dxf, uint32_t line) {
    if (++dxf->work > MOST_WORK)
        return sl_fail_at(dxf->context, dxf->name, line,
                          "the drawing's blocks insert one another more than %zu times", MOST_WORK);
    return dxf->work % 4096 == 0 ? sl_check_cancelled(dxf->context) : SL_OK;
}

/// Draws the entities of a range with the pen. `layer` is the one that things on layer "0" are on:
/// that of the insertion; of no length at the top.
static sl_status dxf_draw(drawing *dxf, dxf_range range, sli_word layer, unsigned depth);

static sl_status draw_insert(drawing *dxf, dxf_range entity, sli_word layer, unsigned depth) {
    const sli_word name = dxf_text(dxf, entity, 2);
    const dxf_block *block = dxf_find_block(dxf, name);
    const uint32_t line = dxf->pen.line;
    if (!block)
        return sl_fail_at(dxf->context, dxf->name, line, "there is no block '%s'",
                          sli_show(name).text);
    if (depth == MOST_DEPTH)
        return sl_fail_at(dxf->context, dxf->name, line,
                          "block '%s' is inserted more than %d blocks deep: does it hold itself?",
                          sli_show(name).text, MOST_DEPTH);
    sl_point at = {0, 0}, scale = {1, 1}, gap = {0, 0};
    double turn = 0;
    int columns = 1, rows = 1;
    SL_TRY(read_point(dxf, entity, 10, &at));
    SL_TRY(dxf_number(dxf, entity, 41, &scale.x));
    SL_TRY(dxf_number(dxf, entity, 42, &scale.y));
    SL_TRY(dxf_number(dxf, entity, 50, &turn));
    SL_TRY(dxf_integer(dxf, entity, 70, &columns));
    SL_TRY(dxf_integer(dxf, entity, 71, &rows));
    SL_TRY(dxf_number(dxf, entity, 44, &gap.x));
    SL_TRY(dxf_number(dxf, entity, 45, &gap.y));
    const sli_affine outer = dxf->pen.affine;
    for (int row = 0; row < rows; row++) {
        for (int column = 0; column < columns; column++) {
            SL_TRY(count_work(dxf, line));
            const sl_point step = {column * gap.x, row * gap.y};
            dxf->pen.affine =
                sli_affine_after(outer, insertion(at, step, scale, turn, block->base));
            SL_TRY(dxf_draw(dxf, block->entities, layer, depth + 1));
        }
    }
    return SL_OK;
}

// --- entities: all of them

static sl_status draw_shape(drawing *dxf, dxf_range entity, size_t end, sli_word layer, plane lies,
                            unsigned depth) {
    const sli_word kind = dxf_at(dxf, entity.begin)->value;
    dxf->drawn++;
    if (!sli_word_is(kind, "INSERT")) sl_bits_add(dxf->walls, entity.begin);
    if (sli_word_is(kind, "LINE")) return draw_line(dxf, entity);
    if (sli_word_is(kind, "LWPOLYLINE")) return draw_light_polyline(dxf, entity);
    if (sli_word_is(kind, "POLYLINE")) return draw_polyline(dxf, entity, end, layer);
    if (sli_word_is(kind, "ARC")) return draw_circle(dxf, entity, false);
    if (sli_word_is(kind, "CIRCLE")) return draw_circle(dxf, entity, true);
    if (sli_word_is(kind, "ELLIPSE")) return draw_ellipse(dxf, entity, lies);
    if (sli_word_is(kind, "SPLINE")) return draw_spline(dxf, entity, layer);
    dxf->drawn--;
    if (sli_word_is(kind, "INSERT")) return draw_insert(dxf, entity, layer, depth);
    return leave_out(dxf, kind, layer);
}

// --- entities of layers that say what they hold

/// "open-NAME" or "shut-NAME", behind the name of the layer of doors; else a name alone.
static void read_door_layer(sli_word *rest, bool *open) {
    static const char *const words[] = {"shut", "open"};
    *open = true;
    for (size_t i = 0; i < 2; i++) {
        if (rest->length < 4 || !same_name((sli_word){rest->at, 4}, (sli_word){words[i], 4}))
            continue;
        if (rest->length > 4 && rest->at[4] != '-') continue;
        const size_t behind = rest->length > 4 ? 5 : 4;
        *open = i == 1;
        *rest = (sli_word){rest->at + behind, rest->length - behind};
        return;
    }
}

/// A start is a POINT; its heading is the angle of the point's axis.
static sl_status read_start(drawing *dxf, dxf_range entity, sl_point *at, double *heading) {
    SL_TRY(read_point(dxf, entity, 10, at));
    SL_TRY(dxf_number(dxf, entity, 50, heading));
    *at = sli_affine_apply(dxf->pen.affine, *at);
    *heading = sli_heading_through(dxf->pen.affine, *heading);
    return SL_OK;
}

/// Draws an entity; on a layer that says what it holds, into a map of its own, and its lines become
/// that.
static sl_status draw_in_layer(drawing *dxf, dxf_range entity, size_t end, sli_word layer,
                               plane lies, unsigned depth) {
    const sli_word kind = dxf_at(dxf, entity.begin)->value;
    sli_word rest = {"", 0};
    sl_point start = {0, 0};
    sli_layer_item item = {.layer = sli_layer_of(layer, &rest), .points = &start};
    if (!item.layer || sli_word_is(kind, "INSERT"))
        return draw_shape(dxf, entity, end, layer, lies, depth);
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
        status = leave_out(dxf, kind, layer);
    }
    dxf->pen.map = map;
    if (item.layer != SLI_LAYER_WALL) dxf->pen.walls = walls;
    if (status == SL_OK)
        status = sli_layer_take(dxf->context, dxf->name, map, &item, &drawn, dxf->pen.line);
    sl_map_destroy(dxf->context, &drawn);
    sl_free(dxf->context, name);
    return status;
}

static sl_status draw_entity(drawing *dxf, dxf_range entity, size_t end, sli_word layer,
                             unsigned depth) {
    const sli_word kind = dxf_at(dxf, entity.begin)->value;
    sli_word own = dxf_text(dxf, entity, 8);
    if (sli_word_is(own, "0") && layer.length) own = layer;
    int on_paper = 0;
    SL_TRY(dxf_integer(dxf, entity, 67, &on_paper));
    const bool part = sli_word_is(kind, "VERTEX") || sli_word_is(kind, "SEQEND");
    if (part || sli_word_is(kind, "ATTRIB")) return SL_OK;
    if (on_paper) {
        dxf->on_paper++;
        return SL_OK;
    }
    bool taken = true;
    if (!sli_word_is(kind, "INSERT")) SL_TRY(dxf_take_layer(dxf, own, &taken));
    if (!taken) {
        dxf->other_layers++;
        return SL_OK;
    }
    plane lies = LEVEL;
    if (!sli_word_is(kind, "LINE")) SL_TRY(read_plane(dxf, entity, &lies));
    if (lies == LEANING) {
        dxf->out_of_plane++;
        return SL_OK;
    }
    const sli_affine outer = dxf->pen.affine;
    if (lies == FROM_BELOW && !sli_word_is(kind, "ELLIPSE"))
        dxf->pen.affine = sli_affine_after(outer, (sli_affine){.xx = -1, .yy = 1});
    dxf->pen.line = dxf_at(dxf, entity.begin)->line;
    const sl_status status = draw_in_layer(dxf, entity, end, own, lies, depth);
    dxf->pen.affine = outer;
    return status;
}

static sl_status dxf_draw(drawing *dxf, dxf_range range, sli_word layer, unsigned depth) {
    for (size_t i = range.begin; i < range.end;) {
        const dxf_range entity = dxf_entity(dxf, i, range.end);
        SL_TRY(count_work(dxf, dxf_at(dxf, i)->line));
        SL_TRY(draw_entity(dxf, entity, range.end, layer, depth));
        i = entity.end;
    }
    return SL_OK;
}

// --- names for walls

/// Adds a part to a label: "layer WALLS, handle 1F".
static void add_part(char *label, size_t size, const char *what, sli_word name) {
    const size_t used = strlen(label);
    if (name.length)
        snprintf(label + used, size - used, "%s%s %s", used ? ", " : "", what, sli_show(name).text);
}

/// Names the entities that were drawn by their layer and handle; those of a block by its name too.
static sl_status name_walls(drawing *dxf) {
    sli_word block = {"", 0};
    for (size_t i = 0; i < dxf->pairs.count; i++) {
        const dxf_pair *pair = dxf_at(dxf, i);
        if (pair->code != 0) continue;
        const dxf_range entity = dxf_entity(dxf, i, dxf->pairs.count);
        if (sli_word_is(pair->value, "BLOCK")) block = dxf_text(dxf, entity, 2);
        if (sli_word_is(pair->value, "ENDBLK")) block.length = 0;
        if (!sl_bits_has(dxf->walls, i)) continue;
        char label[SL_LINE_TEXT] = "";
        add_part(label, sizeof label, "block", block);
        add_part(label, sizeof label, "layer", dxf_text(dxf, entity, 8));
        add_part(label, sizeof label, "handle", dxf_text(dxf, entity, 5));
        if (*label) SL_TRY(sl_map_add_label(dxf->context, dxf->pen.map, pair->line, label));
    }
    return SL_OK;
}

// --- the drawing

static sl_status fail_layer(const drawing *dxf, sli_word name) {
    char names[512] = "";
    for (size_t i = 0; i < dxf->layers.count; i++) {
        const size_t used = strlen(names);
        if (used > sizeof names - 80) {
            snprintf(names + used, sizeof names - used, " ...");
            break;
        }
        snprintf(names + used, sizeof names - used, "%s%.60s", i ? ", " : "",
                 sli_show(dxf->layers.items[i].name).text);
    }
    return sl_fail(dxf->context, SL_BAD_ARGUMENT,
                   "%s: there is no layer '%s' in the drawing; it has %s", dxf->name,
                   sli_show(name).text, names);
}

/// A layer that is asked for and not there is a mistake worth telling of.
static sl_status check_layers(const drawing *dxf) {
    const char *list = dxf->options->layers;
    for (sli_word name; list && sli_layers_next(&list, &name);) {
        bool known = dxf->layers.count == 0;
        for (size_t i = 0; i < dxf->layers.count; i++)
            known |= same_name(dxf->layers.items[i].name, name);
        if (!known) return fail_layer(dxf, name);
    }
    return SL_OK;
}

/// By $INSUNITS: what a drawing's coordinates are in, and how long that is in metres.
static const struct {
    const char *name, *sign; ///< the sign for it
    bool known;              ///< the sign asks for it
    double metres;
} units[] = {
    {"unknown", "", false, 0},
    {"inches", "in", true, 0.0254},
    {"feet", "ft", true, 0.3048},
    {"miles", "mi", false, 1609.344},
    {"millimetres", "mm", true, 1e-3},
    {"centimetres", "cm", true, 1e-2},
    {"metres", "m", true, 1},
    {"kilometres", "km", true, 1e3},
    {"microinches", "\xc2\xb5in", false, 2.54e-8},
    {"mils", "mil", false, 2.54e-5},
    {"yards", "yd", true, 0.9144},
    {"angstroms", "\xc3\x85", false, 1e-10},
    {"nanometres", "nm", false, 1e-9},
    {"microns", "\xc2\xb5m", false, 1e-6},
    {"decimetres", "dm", false, 0.1},
};
enum { UNITS = sizeof units / sizeof *units };

static const char *unit_name(int unit) {
    return unit >= 0 && unit < UNITS ? units[unit].name : "unusual";
}

static void set_unit(const drawing *dxf, const char *sign) {
    snprintf(dxf->pen.map->unit, sizeof dxf->pen.map->unit, "%s", sign);
}

/// The number of a unit that is asked for.
static sl_status find_unit(const drawing *dxf, const char *sign, size_t *unit) {
    size_t i = 0;
    while (i < UNITS && !(units[i].known && strcmp(units[i].sign, sign) == 0)) i++;
    *unit = i;
    if (i < UNITS) return SL_OK;
    return sl_fail(dxf->context, SL_BAD_ARGUMENT,
                   "there is no unit '%s'; choose from mm, cm, m, km, in, ft, yd", sign);
}

/// Has the pen draw in the unit that is asked for: "m", or "mm=m" for a drawing that is in mm,
/// whatever it says itself.
static sl_status take_unit(drawing *dxf) {
    const char *word = dxf->options->unit, *told = word ? strchr(word, '=') : NULL;
    size_t from = dxf->unit >= 0 && dxf->unit < UNITS ? (size_t)dxf->unit : 0, to;
    if (told) {
        char own[16];
        snprintf(own, sizeof own, "%.*s", (int)(told - word < 16 ? told - word : 16), word);
        SL_TRY(find_unit(dxf, own, &from));
        word = told + 1;
    }
    dxf->pen.map->drawing_unit = (int)from;
    if (!word) {
        set_unit(dxf, units[from].sign);
        return SL_OK;
    }
    SL_TRY(find_unit(dxf, word, &to));
    if (!from)
        return sl_fail(dxf->context, SL_BAD_ARGUMENT,
                       "%s: the drawing's own unit is %s, so it cannot be turned into %s; if it is "
                       "in mm, say --unit mm=%s",
                       dxf->name, unit_name(dxf->unit), units[to].name, word);
    set_unit(dxf, word);
    if (from == to) return SL_OK;
    dxf->pen.map->drawing_unit = (int)to;
    const double scale = units[from].metres / units[to].metres;
    dxf->pen.affine = (sli_affine){.xx = scale, .yy = scale};
    return SL_OK;
}

/// The comment of a file of our own, with the sum of its digits; a drawing that is turned into
/// another unit has other numbers. NULL for none. To be freed.
static sl_status find_mark(const drawing *dxf, char **mark) {
    static const char word[] = "sightline-digits ";
    const size_t length = sizeof word - 1;
    for (size_t i = dxf->pairs.count; i-- > 0 && !dxf->options->unit && !*mark;) {
        const dxf_pair *pair = dxf_at(dxf, i);
        if (pair->code != 999 || pair->value.length < length ||
            memcmp(pair->value.at, word, length) != 0)
            continue;
        *mark = sl_copy_text(dxf->context, pair->value.at + length, pair->value.length - length);
        if (!*mark) return SL_NO_MEMORY;
    }
    return SL_OK;
}

static sl_status draw_drawing(drawing *dxf, const char *text, size_t size) {
    SL_TRY(refuse_other_files(dxf, text, size));
    SL_TRY(read_pairs(dxf, text, size));
    SL_TRY(read_sections(dxf));
    SL_TRY(check_layers(dxf));
    SL_TRY(take_unit(dxf));
    dxf->walls = sl_alloc_array(dxf->context, sl_bits_words(dxf->pairs.count), sizeof(sl_bits));
    if (!dxf->walls) return SL_NO_MEMORY;
    return dxf_draw(dxf, dxf->entities, (sli_word){"", 0}, 0);
}

/// What was taken, and what was left out.
static void note_drawing(const drawing *dxf) {
    char kinds[MOST_OTHERS][96];
    sli_tally left[5 + MOST_OTHERS];
    size_t count = 0;
    left[count++] = (sli_tally){dxf->other_layers, "on another layer", "on other layers"};
    for (size_t i = 0; i < dxf->others_count; i++) {
        const dxf_other *other = &dxf->others[i];
        snprintf(kinds[i], sizeof kinds[i], "%.24s%s%.60s", sli_show(other->kind).text,
                 other->layer.length ? " on " : "", sli_show(other->layer).text);
        left[count++] = (sli_tally){other->count, kinds[i], kinds[i]};
    }
    left[count++] = (sli_tally){dxf->other_kinds, "that is no wall either", "that are no walls"};
    left[count++] =
        (sli_tally){dxf->on_paper, "on a layout (paper space)", "on layouts (paper space)"};
    left[count++] = (sli_tally){dxf->out_of_plane, "out of the plane", "out of the plane"};
    left[count++] = (sli_tally){dxf->pen.points, "line of no length", "lines of no length"};
    const char *asked = dxf->options->unit;
    char without[SLI_TALLY_TEXT];
    sl_note(dxf->context, "%s: %zu entities give %zu walls%s; unit: %s%s%s", dxf->name, dxf->drawn,
            dxf->pen.walls, sli_tally_write("; left out: ", left, count, without),
            unit_name(dxf->unit),
            asked ? strchr(asked, '=') ? ", read as " : ", converted to " : "", asked ? asked : "");
    if (!dxf->drawn && dxf->options->layers)
        sl_note(dxf->context,
                "%s: nothing on the layers %s is a wall; sightline info %s lists all layers",
                dxf->name, dxf->options->layers, dxf->name);
    sli_layers_note(dxf->context, dxf->name, dxf->pen.map);
}

static sl_status read_drawing(drawing *dxf, const char *text, size_t size) {
    SL_TRY(draw_drawing(dxf, text, size));
    SL_TRY(name_walls(dxf));
    char *mark = NULL;
    SL_TRY(find_mark(dxf, &mark));
    dxf->pen.map->precision =
        sli_marked_precision(dxf->pen.map, dxf->pen.finest, mark, dxf->pen.sum);
    sl_free(dxf->context, mark);
    note_drawing(dxf);
    return SL_OK;
}

static void drawing_destroy(drawing *dxf) {
    sl_free(dxf->context, dxf->pairs.items);
    sl_free(dxf->context, dxf->blocks.items);
    sl_free(dxf->context, dxf->layers.items);
    sl_free(dxf->context, dxf->walls);
}

sl_status sl_map_read_dxf(sl_context *context, const char *name, const char *text, size_t size,
                          const sl_import_options *options, sl_map *map) {
    sl_map read = {0};
    drawing dxf = {.context = context,
                   .name = name,
                   .options = options,
                   .pen = {.context = context,
                           .name = name,
                           .map = &read,
                           .affine = SLI_AFFINE_NONE,
                           .tolerance = options->tolerance}};
    const sl_status status = read_drawing(&dxf, text, size);
    drawing_destroy(&dxf);
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}

void sl_drawing_layers_destroy(sl_context *context, sl_drawing_layers *layers) {
    for (size_t i = 0; i < layers->count; i++) sl_free(context, layers->items[i].name);
    sl_free(context, layers->items);
    *layers = (sl_drawing_layers){0};
}

static sl_status copy_layers(const drawing *dxf, sl_drawing_layers *out) {
    out->items = sl_alloc_array(dxf->context, dxf->layers.count, sizeof *out->items);
    if (!out->items) return SL_NO_MEMORY;
    for (size_t i = 0; i < dxf->layers.count; i++) {
        const dxf_layer *from = &dxf->layers.items[i];
        sl_drawing_layer *to = &out->items[i];
        *to = (sl_drawing_layer){sl_copy_text(dxf->context, from->name.at, from->name.length),
                                 from->entities, from->on};
        if (!to->name) return SL_NO_MEMORY;
        out->count++;
    }
    return SL_OK;
}

sl_status sl_drawing_layers_dxf(sl_context *context, const char *name, const char *text,
                                size_t size, sl_drawing_layers *out) {
    const sl_import_options options = sl_import_options_default();
    sl_drawing_layers read = {0};
    sl_map map = {0};
    drawing dxf = {
        .context = context,
        .name = name,
        .options = &options,
        .pen = {.context = context, .name = name, .map = &map, .affine = SLI_AFFINE_NONE}};
    sl_status status = draw_drawing(&dxf, text, size);
    if (status == SL_OK) status = copy_layers(&dxf, &read);
    drawing_destroy(&dxf);
    sl_map_destroy(context, &map);
    if (status == SL_OK)
        *out = read;
    else
        sl_drawing_layers_destroy(context, &read);
    return status;
}

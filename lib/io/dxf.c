// DXF (Autodesk, DXF Reference): lines in pairs, a group code and a value; sections HEADER, TABLES,
// BLOCKS, ENTITIES. Its entities are drawn by dxf_entities.c.
#include "io/dxf.h"

#include "io/layers.h"

#include <stdlib.h>

static sl_word trimmed(sl_word word) {
    while (word.length && strchr(" \t", *word.at)) word.at++, word.length--;
    while (word.length && strchr(" \t", word.at[word.length - 1])) word.length--;
    return word;
}

static char small(char c) {
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static bool same_name(sl_word a, sl_word b) {
    if (a.length != b.length) return false;
    for (size_t i = 0; i < a.length; i++)
        if (small(a.at[i]) != small(b.at[i])) return false;
    return true;
}

// --- pairs

static bool read_code(sl_word word, int *code) {
    double value;
    if (!sl_number_read(word.at, word.length, &value)) return false;
    *code = value >= -5 && value <= 1071 ? (int)value : -6;
    return *code == value;
}

static sl_status refuse_other_files(sl_dxf *dxf, const char *text, size_t size) {
    static const char binary[] = "AutoCAD Binary DXF";
    if (size >= sizeof binary - 1 && memcmp(text, binary, sizeof binary - 1) == 0)
        return sl_fail_at(dxf->context, dxf->name, 0, "binary DXF: save the drawing as ASCII DXF");
    if (size >= 6 && memcmp(text, "AC10", 4) == 0)
        return sl_fail_at(dxf->context, dxf->name, 0, "a DWG drawing: save it as ASCII DXF");
    return sl_refuse_nul(dxf->context, dxf->name, text, size);
}

/// Reads all pairs up to the one that says EOF.
static sl_status read_pairs(sl_dxf *dxf, const char *text, size_t size) {
    sl_lines lines = sl_lines_of(text, size);
    sl_word code, value;
    while (sl_lines_next(&lines, &code)) {
        sl_dxf_pair pair;
        code = trimmed(code);
        if (!read_code(code, &pair.code))
            return sl_fail_at(dxf->context, dxf->name, lines.line,
                              "expected a group code (a whole number), found '%s'",
                              sl_show(code).text);
        if (!sl_lines_next(&lines, &value))
            return sl_fail_at(dxf->context, dxf->name, lines.line,
                              "the file ends where the value of group %d should be", pair.code);
        pair.line = lines.line;
        pair.value = trimmed(value);
        SL_TRY(SL_ARRAY_ROOM(dxf->context, &dxf->pairs, 1));
        dxf->pairs.items[dxf->pairs.count++] = pair;
        if (pair.code == 0 && sl_word_is(pair.value, "EOF")) return SL_OK;
        if (dxf->pairs.count % 4096 == 0) SL_TRY(sl_check_cancelled(dxf->context));
    }
    return sl_fail_at(dxf->context, dxf->name, lines.line,
                      "the drawing ends without an EOF: the file is not all there");
}

sl_dxf_range sl_dxf_entity(const sl_dxf *dxf, size_t begin, size_t end) {
    size_t stop = begin + 1;
    while (stop < end && sl_dxf_at(dxf, stop)->code != 0) stop++;
    return (sl_dxf_range){begin, stop};
}

/// The value of a pair.
static sl_status read_number(sl_dxf *dxf, const sl_dxf_pair *pair, double *value) {
    double number;
    if (!sl_number_read(pair->value.at, pair->value.length, &number) ||
        !(number <= SL_COORDINATE_MAX && number >= -SL_COORDINATE_MAX))
        return sl_fail_at(dxf->context, dxf->name, pair->line,
                          "expected a number up to %g for group %d, found '%s'", SL_COORDINATE_MAX,
                          pair->code, sl_show(pair->value).text);
    *value = number;
    return SL_OK;
}

static const sl_dxf_pair *find(const sl_dxf *dxf, sl_dxf_range entity, int code) {
    for (size_t i = entity.begin; i < entity.end; i++)
        if (sl_dxf_at(dxf, i)->code == code) return sl_dxf_at(dxf, i);
    return NULL;
}

sl_status sl_dxf_number(sl_dxf *dxf, sl_dxf_range entity, int code, double *value) {
    const sl_dxf_pair *pair = find(dxf, entity, code);
    return pair ? read_number(dxf, pair, value) : SL_OK;
}

sl_status sl_dxf_integer(sl_dxf *dxf, sl_dxf_range entity, int code, int *value) {
    const sl_dxf_pair *pair = find(dxf, entity, code);
    if (!pair) return SL_OK;
    double number = 0;
    SL_TRY(read_number(dxf, pair, &number));
    if (!(number >= -32768 && number <= 65535) || number != (int)number)
        return sl_fail_at(dxf->context, dxf->name, pair->line,
                          "expected a whole number of 16 bits for group %d, found '%s'", code,
                          sl_show(pair->value).text);
    *value = (int)number;
    return SL_OK;
}

sl_word sl_dxf_text(const sl_dxf *dxf, sl_dxf_range entity, int code) {
    const sl_dxf_pair *pair = find(dxf, entity, code);
    return pair ? pair->value : (sl_word){"", 0};
}

// --- header and tables

static sl_status read_header(sl_dxf *dxf, sl_dxf_range section) {
    for (size_t i = section.begin; i + 1 < section.end; i++) {
        if (sl_dxf_at(dxf, i)->code != 9 || !sl_word_is(sl_dxf_at(dxf, i)->value, "$INSUNITS"))
            continue;
        return sl_dxf_integer(dxf, (sl_dxf_range){i + 1, i + 2}, 70, &dxf->unit);
    }
    return SL_OK;
}

static bool is_asked_for(const char *list, sl_word layer) {
    for (sl_word name; sl_layers_next(&list, &name);)
        if (same_name(name, layer)) return true;
    return false;
}

/// Layers of the table: without the option those are taken that are on and not frozen.
static sl_status read_tables(sl_dxf *dxf, sl_dxf_range section) {
    for (size_t i = section.begin; i < section.end; i++) {
        const sl_dxf_pair *pair = sl_dxf_at(dxf, i);
        if (pair->code != 0 || !sl_word_is(pair->value, "LAYER")) continue;
        const sl_dxf_range entry = sl_dxf_entity(dxf, i, section.end);
        const char *list = dxf->options->layers;
        int colour = 7, flags = 0;
        SL_TRY(sl_dxf_integer(dxf, entry, 62, &colour));
        SL_TRY(sl_dxf_integer(dxf, entry, 70, &flags));
        sl_dxf_layer layer = {.name = sl_dxf_text(dxf, entry, 2)};
        layer.taken = list ? is_asked_for(list, layer.name) : colour >= 0 && !(flags & 1);
        SL_TRY(SL_ARRAY_ROOM(dxf->context, &dxf->layers, 1));
        dxf->layers.items[dxf->layers.count++] = layer;
    }
    return SL_OK;
}

bool sl_dxf_takes_layer(const sl_dxf *dxf, sl_word name) {
    for (size_t i = 0; i < dxf->layers.count; i++)
        if (same_name(dxf->layers.items[i].name, name)) return dxf->layers.items[i].taken;
    return !dxf->options->layers || is_asked_for(dxf->options->layers, name);
}

// --- blocks

static int compare_blocks(const void *left, const void *right) {
    const sl_dxf_block *a = left, *b = right;
    const size_t least = a->name.length < b->name.length ? a->name.length : b->name.length;
    for (size_t i = 0; i < least; i++) {
        const int order = small(a->name.at[i]) - small(b->name.at[i]);
        if (order) return order;
    }
    return (a->name.length > least) - (b->name.length > least);
}

const sl_dxf_block *sl_dxf_find_block(const sl_dxf *dxf, sl_word name) {
    const sl_dxf_block wanted = {.name = name};
    if (!dxf->blocks.count) return NULL;
    return bsearch(&wanted, dxf->blocks.items, dxf->blocks.count, sizeof wanted, compare_blocks);
}

static sl_status read_blocks(sl_dxf *dxf, sl_dxf_range section) {
    sl_dxf_block block = {0};
    bool within = false;
    for (size_t i = section.begin; i < section.end;) {
        const sl_dxf_range entity = sl_dxf_entity(dxf, i, section.end);
        const sl_dxf_pair *kind = sl_dxf_at(dxf, i);
        if (sl_word_is(kind->value, "BLOCK")) {
            block =
                (sl_dxf_block){.name = sl_dxf_text(dxf, entity, 2), .entities = {entity.end, 0}};
            SL_TRY(sl_dxf_number(dxf, entity, 10, &block.base.x));
            SL_TRY(sl_dxf_number(dxf, entity, 20, &block.base.y));
            within = true;
        } else if (sl_word_is(kind->value, "ENDBLK") && within) {
            block.entities.end = i;
            SL_TRY(SL_ARRAY_ROOM(dxf->context, &dxf->blocks, 1));
            dxf->blocks.items[dxf->blocks.count++] = block;
            within = false;
        }
        i = entity.end;
    }
    if (within)
        return sl_fail_at(dxf->context, dxf->name, sl_dxf_at(dxf, section.end)->line,
                          "block '%s' has no ENDBLK", sl_show(block.name).text);
    if (dxf->blocks.count)
        qsort(dxf->blocks.items, dxf->blocks.count, sizeof *dxf->blocks.items, compare_blocks);
    return SL_OK;
}

// --- the whole

/// Finds the section that starts at pair `begin`, and reads what is in it.
static sl_status read_section(sl_dxf *dxf, size_t begin, size_t *after) {
    const size_t count = dxf->pairs.count;
    const sl_dxf_pair *name = sl_dxf_at(dxf, begin + 1);
    if (name->code != 2)
        return sl_fail_at(dxf->context, dxf->name, name->line, "a section without a name");
    sl_dxf_range section = {begin + 2, begin + 2};
    while (section.end < count) {
        const sl_dxf_pair *pair = sl_dxf_at(dxf, section.end);
        if (pair->code == 0 &&
            (sl_word_is(pair->value, "ENDSEC") || sl_word_is(pair->value, "EOF")))
            break;
        section.end++;
    }
    if (!sl_word_is(sl_dxf_at(dxf, section.end)->value, "ENDSEC"))
        return sl_fail_at(dxf->context, dxf->name, name->line, "section '%s' has no ENDSEC",
                          sl_show(name->value).text);
    *after = section.end + 1;
    if (sl_word_is(name->value, "HEADER")) return read_header(dxf, section);
    if (sl_word_is(name->value, "TABLES")) return read_tables(dxf, section);
    if (sl_word_is(name->value, "BLOCKS")) return read_blocks(dxf, section);
    if (sl_word_is(name->value, "ENTITIES")) dxf->entities = section;
    return SL_OK;
}

static sl_status read_sections(sl_dxf *dxf) {
    size_t i = 0;
    while (sl_dxf_at(dxf, i)->code == 999) i++;
    while (i + 1 < dxf->pairs.count) {
        const sl_dxf_pair *pair = sl_dxf_at(dxf, i);
        if (pair->code != 0 || !sl_word_is(pair->value, "SECTION"))
            return sl_fail_at(dxf->context, dxf->name, pair->line,
                              "expected a SECTION, found '%s': is it a DXF drawing?",
                              sl_show(pair->value).text);
        SL_TRY(read_section(dxf, i, &i));
    }
    if (dxf->entities.begin == 0)
        return sl_fail_at(dxf->context, dxf->name, 0, "the drawing has no section ENTITIES");
    return SL_OK;
}

/// A layer that is asked for and not there is a mistake worth telling of.
static sl_status check_layers(const sl_dxf *dxf) {
    const char *list = dxf->options->layers;
    for (sl_word name; list && sl_layers_next(&list, &name);) {
        bool known = dxf->layers.count == 0;
        for (size_t i = 0; i < dxf->layers.count; i++)
            known |= same_name(dxf->layers.items[i].name, name);
        if (!known)
            return sl_fail(dxf->context, SL_BAD_ARGUMENT,
                           "%s: there is no layer '%s' among the drawing's %zu; the first is '%s'",
                           dxf->name, sl_show(name).text, dxf->layers.count,
                           sl_show(dxf->layers.items[0].name).text);
    }
    return SL_OK;
}

/// By $INSUNITS: what a drawing's coordinates are in, and how long that is in metres.
static const struct {
    const char *name, *word; ///< the word that asks for it, NULL for none
    double metres;
} units[] = {
    {"not told", NULL, 0},      {"inches", "in", 0.0254},    {"feet", "ft", 0.3048},
    {"miles", NULL, 1609.344},  {"millimetres", "mm", 1e-3}, {"centimetres", "cm", 1e-2},
    {"metres", "m", 1},         {"kilometres", "km", 1e3},   {"microinches", NULL, 2.54e-8},
    {"mils", NULL, 2.54e-5},    {"yards", "yd", 0.9144},     {"angstroms", NULL, 1e-10},
    {"nanometres", NULL, 1e-9}, {"microns", NULL, 1e-6},     {"decimetres", NULL, 0.1},
};
enum { UNITS = sizeof units / sizeof *units };

static const char *unit_name(int unit) {
    return unit >= 0 && unit < UNITS ? units[unit].name : "unusual";
}

/// Has the pen draw in the unit that is asked for.
static sl_status take_unit(sl_dxf *dxf) {
    const char *word = dxf->options->unit;
    if (!word) return SL_OK;
    size_t to = 0;
    while (to < UNITS && !(units[to].word && strcmp(units[to].word, word) == 0)) to++;
    if (to == UNITS)
        return sl_fail(dxf->context, SL_BAD_ARGUMENT,
                       "there is no unit '%s'; choose from mm, cm, m, km, in, ft, yd", word);
    if (dxf->unit <= 0 || dxf->unit >= UNITS)
        return sl_fail(dxf->context, SL_BAD_ARGUMENT,
                       "%s: the drawing's own unit is %s, so it cannot be turned into %s",
                       dxf->name, unit_name(dxf->unit), units[to].name);
    if ((size_t)dxf->unit == to) return SL_OK;
    const double scale = units[dxf->unit].metres / units[to].metres;
    dxf->pen.affine = (sl_affine){.xx = scale, .yy = scale};
    return SL_OK;
}

static sl_status read_drawing(sl_dxf *dxf, const char *text, size_t size) {
    SL_TRY(refuse_other_files(dxf, text, size));
    SL_TRY(read_pairs(dxf, text, size));
    SL_TRY(read_sections(dxf));
    SL_TRY(check_layers(dxf));
    SL_TRY(take_unit(dxf));
    SL_TRY(sl_dxf_draw(dxf, dxf->entities, (sl_word){"", 0}, 0));
    sl_note(dxf->context,
            "%s: %zu entities give %zu walls (unit: %s%s%s); left out: %zu on other layers, %zu of "
            "other kinds, %zu on the paper, %zu out of the plan's plane, %zu lines of no length",
            dxf->name, dxf->drawn, dxf->pen.walls, unit_name(dxf->unit),
            dxf->options->unit ? ", turned into " : "",
            dxf->options->unit ? dxf->options->unit : "", dxf->other_layers, dxf->other_kinds,
            dxf->on_paper, dxf->out_of_plane, dxf->pen.points);
    return SL_OK;
}

sl_status sl_map_read_dxf(sl_context *context, const char *name, const char *text, size_t size,
                          const sl_import_options *options, sl_map *map) {
    sl_map read = {0};
    sl_dxf dxf = {.context = context,
                  .name = name,
                  .options = options,
                  .pen = {.context = context,
                          .name = name,
                          .map = &read,
                          .affine = SL_AFFINE_NONE,
                          .tolerance = options->tolerance}};
    const sl_status status = read_drawing(&dxf, text, size);
    sl_free(context, dxf.pairs.items);
    sl_free(context, dxf.blocks.items);
    sl_free(context, dxf.layers.items);
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}

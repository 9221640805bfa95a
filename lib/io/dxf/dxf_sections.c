/// The parts of a DXF drawing: pairs of a group code and a value; of the section HEADER the unit,
/// of TABLES the layers, of BLOCKS the blocks. The section ENTITIES is found.
#include "io/dxf/dxf.h"

#include <stdlib.h>

// --- names

static char small(char c) {
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

bool sli_dxf_same_name(sli_word a, sli_word b) {
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

static sl_status refuse_other_files(sli_dxf *dxf, const char *text, size_t size) {
    static const char *const begins[] = {"AC10", "AC1.", "AC2.", "MC0."}; // by release
    bool other = false;
    for (int i = 0; i < 4; i++) other |= size >= 6 && memcmp(text, begins[i], 4) == 0;
    if (other)
        return sl_fail_at(dxf->context, dxf->name, 0,
                          "a DWG drawing: save it as ASCII DXF in the program that it is from");
    return sli_refuse_nul(dxf->context, dxf->name, text, size);
}

/// Whether pairs begin here: group codes with values, up to a 0 with the name of what is next. A
/// line too many turns values into codes, so that a name stands where a code should be. Also true
/// where the file ends before that.
static bool are_pairs(sli_lines lines) {
    sli_word code, value;
    int number;
    while (sli_lines_next(&lines, &code) && read_code(sli_trimmed(code), &number)) {
        double read;
        if (!sli_lines_next(&lines, &value)) return true;
        value = sli_trimmed(value);
        if (number == 0) return value.length && !sl_number_read(value.at, value.length, &read);
    }
    return lines.at == lines.end;
}

/// Some programs write texts of several lines as they are. Passes over lines behind the text that
/// was read, up to where pairs begin again.
static sl_status pass_continued(sli_dxf *dxf, sli_lines *lines) {
    enum { MOST = 64 };
    static const sli_fault continued = {"continued line of a text (skipped)",
                                        "continued lines of texts (skipped)"};
    sli_lines from = *lines;
    sli_word line;
    for (size_t count = 0; count <= MOST && !are_pairs(from); count++)
        if (count == MOST || !sli_lines_next(&from, &line))
            return sl_fail_at(dxf->context, dxf->name, lines->line,
                              "the text has more lines, and what follows are no pairs of a group "
                              "code and a value");
    while (lines->line < from.line && sli_lines_next(lines, &line))
        sli_faults_add(&dxf->faults, &continued, (uint32_t)lines->line);
    return SL_OK;
}

/// Reads all pairs up to the one that says EOF.
static sl_status read_pairs(sli_dxf *dxf, const char *text, size_t size) {
    sli_lines lines = sli_lines_of(text, size);
    sli_word code, value;
    bool may_go_on = false;
    while (sli_lines_next(&lines, &code)) {
        sli_dxf_pair pair;
        code = sli_trimmed(code);
        if (!read_code(code, &pair.code))
            return sl_fail_at(dxf->context, dxf->name, lines.line,
                              "expected a group code (a whole number), found '%s'",
                              sli_show(code).text);
        if (!sli_lines_next(&lines, &value))
            return sl_fail_at(dxf->context, dxf->name, lines.line,
                              "the file ends where the value of group %d should be", pair.code);
        pair.line = lines.line;
        pair.value = sli_trimmed(value);
        SL_TRY(SL_ARRAY_ROOM(dxf->context, &dxf->pairs, 1));
        dxf->pairs.items[dxf->pairs.count++] = pair;
        if (pair.code == 0 && sli_word_is(pair.value, "EOF")) return SL_OK;
        if (pair.code == 0) may_go_on = sli_dxf_is_text(pair.value);
        if (may_go_on && (pair.code == 1 || pair.code == 3)) {
            SL_TRY(pass_continued(dxf, &lines));
            may_go_on = false; // pairs are there up to the next name
        }
        if (dxf->pairs.count % 4096 == 0) SL_TRY(sl_check_cancelled(dxf->context));
    }
    return sl_fail_at(dxf->context, dxf->name, lines.line,
                      "the drawing ends without an EOF: the file is not all there");
}

sli_dxf_range sli_dxf_entity(const sli_dxf *dxf, size_t begin, size_t end) {
    size_t stop = begin + 1;
    while (stop < end && sli_dxf_at(dxf, stop)->code != 0) stop++;
    return (sli_dxf_range){begin, stop};
}

sl_status sli_dxf_fault(sli_dxf *dxf, const sli_fault *kind, uint32_t line) {
    dxf->fault = kind;
    dxf->fault_line = line;
    return SL_BAD_INPUT;
}

static const sli_fault wrong_number = {"entity with a wrong number", "entities with wrong numbers"};

sl_status sli_dxf_read_number(sli_dxf *dxf, const sli_dxf_pair *pair, double *value) {
    double number;
    if (!sl_number_read(pair->value.at, pair->value.length, &number) ||
        !(number <= SL_COORDINATE_MAX && number >= -SL_COORDINATE_MAX)) {
        (void)sli_dxf_fault(dxf, &wrong_number, pair->line);
        return sl_fail_at(dxf->context, dxf->name, pair->line,
                          "expected a number up to %g for group %d, found '%s'", SL_COORDINATE_MAX,
                          pair->code, sli_show(pair->value).text);
    }
    *value = number;
    return SL_OK;
}

const sli_dxf_pair *sli_dxf_find(const sli_dxf *dxf, sli_dxf_range entity, int code) {
    for (size_t i = entity.begin; i < entity.end; i++)
        if (sli_dxf_at(dxf, i)->code == code) return sli_dxf_at(dxf, i);
    return NULL;
}

sl_status sli_dxf_number(sli_dxf *dxf, sli_dxf_range entity, int code, double *value) {
    const sli_dxf_pair *pair = sli_dxf_find(dxf, entity, code);
    return pair ? sli_dxf_read_number(dxf, pair, value) : SL_OK;
}

sl_status sli_dxf_integer(sli_dxf *dxf, sli_dxf_range entity, int code, int *value) {
    const sli_dxf_pair *pair = sli_dxf_find(dxf, entity, code);
    if (!pair) return SL_OK;
    double number = 0;
    SL_TRY(sli_dxf_read_number(dxf, pair, &number));
    if (!(number >= -32768 && number <= 65535) || number != (int)number) {
        (void)sli_dxf_fault(dxf, &wrong_number, pair->line);
        return sl_fail_at(dxf->context, dxf->name, pair->line,
                          "expected a whole number of 16 bits for group %d, found '%s'", code,
                          sli_show(pair->value).text);
    }
    *value = (int)number;
    return SL_OK;
}

sli_word sli_dxf_text(const sli_dxf *dxf, sli_dxf_range entity, int code) {
    const sli_dxf_pair *pair = sli_dxf_find(dxf, entity, code);
    return pair ? pair->value : (sli_word){"", 0};
}

// --- header and tables

static sl_status read_header(sli_dxf *dxf, sli_dxf_range section) {
    for (size_t i = section.begin; i + 1 < section.end; i++) {
        if (sli_dxf_at(dxf, i)->code != 9 || !sli_word_is(sli_dxf_at(dxf, i)->value, "$INSUNITS"))
            continue;
        return sli_dxf_integer(dxf, (sli_dxf_range){i + 1, i + 2}, 70, &dxf->unit);
    }
    return SL_OK;
}

static bool is_asked_for(const char *list, sli_word layer) {
    for (sli_word name; sli_layers_next(&list, &name);)
        if (sli_dxf_same_name(name, layer)) return true;
    return false;
}

/// Layers of the table: without the option those are taken that are on and not frozen.
static sl_status read_tables(sli_dxf *dxf, sli_dxf_range section) {
    for (size_t i = section.begin; i < section.end; i++) {
        const sli_dxf_pair *pair = sli_dxf_at(dxf, i);
        if (pair->code != 0 || !sli_word_is(pair->value, "LAYER")) continue;
        const sli_dxf_range entry = sli_dxf_entity(dxf, i, section.end);
        const char *list = dxf->options->layers;
        int colour = 7, flags = 0;
        SL_TRY(sli_dxf_integer(dxf, entry, 62, &colour));
        SL_TRY(sli_dxf_integer(dxf, entry, 70, &flags));
        sli_dxf_layer layer = {.name = sli_dxf_text(dxf, entry, 2),
                               .on = colour >= 0 && !(flags & 1)};
        layer.taken = list ? is_asked_for(list, layer.name) : layer.on;
        sli_meaning means;
        if (sli_roles_find(dxf->contents.roles, layer.name, &means)) layer.taken = true;
        SL_TRY(SL_ARRAY_ROOM(dxf->context, &dxf->layers, 1));
        dxf->layers.items[dxf->layers.count++] = layer;
        dxf->table_layers++;
    }
    return SL_OK;
}

/// Layers that the table does not have: so many are counted. Finding them takes time.
enum { MOST_UNLISTED = 256 };

sl_status sli_dxf_take_layer(sli_dxf *dxf, sli_word name, bool *taken) {
    for (size_t i = 0; i < dxf->layers.count; i++) {
        sli_dxf_layer *layer = &dxf->layers.items[i];
        if (!sli_dxf_same_name(layer->name, name)) continue;
        layer->entities++;
        *taken = layer->taken;
        return SL_OK;
    }
    const char *list = dxf->options->layers;
    *taken = !list || is_asked_for(list, name);
    if (dxf->layers.count - dxf->table_layers == MOST_UNLISTED) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(dxf->context, &dxf->layers, 1));
    dxf->layers.items[dxf->layers.count++] = (sli_dxf_layer){name, true, *taken, 1};
    return SL_OK;
}

bool sli_dxf_layer_is_on(const sli_dxf *dxf, sli_word name) {
    for (size_t i = 0; i < dxf->layers.count; i++)
        if (sli_dxf_same_name(dxf->layers.items[i].name, name)) return dxf->layers.items[i].on;
    return true;
}

// --- blocks

static int compare_blocks(const void *left, const void *right) {
    const sli_dxf_block *a = left, *b = right;
    const size_t least = a->name.length < b->name.length ? a->name.length : b->name.length;
    for (size_t i = 0; i < least; i++) {
        const int order = small(a->name.at[i]) - small(b->name.at[i]);
        if (order) return order;
    }
    return (a->name.length > least) - (b->name.length > least);
}

const sli_dxf_block *sli_dxf_find_block(const sli_dxf *dxf, sli_word name) {
    const sli_dxf_block wanted = {.name = name};
    if (!dxf->blocks.count) return NULL;
    return bsearch(&wanted, dxf->blocks.items, dxf->blocks.count, sizeof wanted, compare_blocks);
}

static sl_status read_blocks(sli_dxf *dxf, sli_dxf_range section) {
    sli_dxf_block block = {0};
    bool within = false;
    for (size_t i = section.begin; i < section.end;) {
        const sli_dxf_range entity = sli_dxf_entity(dxf, i, section.end);
        const sli_dxf_pair *kind = sli_dxf_at(dxf, i);
        if (sli_word_is(kind->value, "BLOCK")) {
            block =
                (sli_dxf_block){.name = sli_dxf_text(dxf, entity, 2), .entities = {entity.end, 0}};
            SL_TRY(sli_dxf_number(dxf, entity, 10, &block.base.x));
            SL_TRY(sli_dxf_number(dxf, entity, 20, &block.base.y));
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
        return sl_fail_at(dxf->context, dxf->name, sli_dxf_at(dxf, section.end)->line,
                          "block '%s' has no ENDBLK", sli_show(block.name).text);
    if (dxf->blocks.count)
        qsort(dxf->blocks.items, dxf->blocks.count, sizeof *dxf->blocks.items, compare_blocks);
    return SL_OK;
}

// --- sections

/// Finds the section that starts at pair `begin`, and reads what is in it.
static sl_status read_section(sli_dxf *dxf, size_t begin, size_t *after) {
    const size_t count = dxf->pairs.count;
    const sli_dxf_pair *name = sli_dxf_at(dxf, begin + 1);
    if (name->code != 2)
        return sl_fail_at(dxf->context, dxf->name, name->line, "a section without a name");
    sli_dxf_range section = {begin + 2, begin + 2};
    while (section.end < count) {
        const sli_dxf_pair *pair = sli_dxf_at(dxf, section.end);
        if (pair->code == 0 &&
            (sli_word_is(pair->value, "ENDSEC") || sli_word_is(pair->value, "EOF")))
            break;
        section.end++;
    }
    if (!sli_word_is(sli_dxf_at(dxf, section.end)->value, "ENDSEC"))
        return sl_fail_at(dxf->context, dxf->name, name->line, "section '%s' has no ENDSEC",
                          sli_show(name->value).text);
    *after = section.end + 1;
    if (sli_word_is(name->value, "HEADER")) return read_header(dxf, section);
    if (sli_word_is(name->value, "TABLES")) return read_tables(dxf, section);
    if (sli_word_is(name->value, "BLOCKS")) return read_blocks(dxf, section);
    if (sli_word_is(name->value, "ENTITIES")) dxf->entities = section;
    if (sli_word_is(name->value, "OBJECTS")) dxf->objects = section;
    return SL_OK;
}

static sl_status read_sections(sli_dxf *dxf) {
    size_t i = 0;
    while (sli_dxf_at(dxf, i)->code == 999) i++;
    while (i + 1 < dxf->pairs.count) {
        const sli_dxf_pair *pair = sli_dxf_at(dxf, i);
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

sl_status sli_dxf_read(sli_dxf *dxf, const char *text, size_t size) {
    if (sli_dxf_is_binary(text, size)) {
        SL_TRY(sli_dxf_from_binary(dxf, text, size));
        text = dxf->text.items;
        size = dxf->text.count;
    }
    SL_TRY(refuse_other_files(dxf, text, size));
    SL_TRY(read_pairs(dxf, text, size));
    SL_TRY(sli_dxf_decode_names(dxf));
    SL_TRY(read_sections(dxf));
    return sli_dxf_find_clips(dxf);
}

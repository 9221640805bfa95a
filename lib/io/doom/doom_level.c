/// The lines and sectors of a Doom map. They are written in one of two ways: as lumps of records
/// (Doom's, or Hexen's where there is a BEHAVIOR), or as a text, TEXTMAP (the Universal Doom Map
/// Format, version 1.1: "name = value;" and "block { name = value; ... }"; what is unknown is
/// passed over, as the format wants). Both give the same records, whose references are then looked
/// up.
#include "io/doom/wad.h"

#include "geometry/orient.h"
#include "map/scan.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

// --- records, before anything is looked up

/// Numbers of other records, as they are written.
typedef struct doom_linedef {
    int64_t vertex[2]; ///< from, to
    int64_t side[2];   ///< right, left; -1 for none
    int special, tag;
    uint32_t line; ///< of the TEXTMAP; 0 in lumps of records
} doom_linedef;

typedef struct doom_sidedef {
    int64_t sector;
    uint32_t line;
} doom_sidedef;

/// Zeroed, it is empty.
typedef struct doom_records {
    SL_ARRAY(sl_point) vertices;
    SL_ARRAY(doom_linedef) linedefs;
    SL_ARRAY(doom_sidedef) sidedefs;
    SL_ARRAY(sli_doom_sector) sectors;
    SL_ARRAY(sli_doom_start) starts;
    bool hexen_specials;
    const char *format;
} doom_records;

static bool is_start(int64_t type) {
    return (type >= 1 && type <= SLI_DOOM_PLAYERS) || type == SLI_DOOM_DEATHMATCH ||
           type == SLI_DOOM_ARRIVAL;
}

// --- lumps of records

/// The records of one lump.
typedef struct record_lump {
    const unsigned char *bytes;
    size_t count;
} record_lump;

static sl_status open_lump(sl_context *context, const sli_wad *wad, const sli_wad_map *map,
                           const char *name, size_t record_bytes, record_lump *out) {
    const uint32_t index = sli_wad_find_lump(wad, map, name);
    if (index == wad->lump_count)
        return sl_fail_at(context, wad->name, 0, "map %s has no lump %s", map->name, name);
    sli_lump lump;
    SL_TRY(sli_wad_lump(context, wad, index, &lump));
    if (lump.size % record_bytes)
        return sl_fail_at(context, wad->name, 0,
                          "map %s, lump %s: %zu bytes are no whole number of records of %zu bytes",
                          map->name, name, lump.size, record_bytes);
    *out = (record_lump){.bytes = lump.bytes, .count = lump.size / record_bytes};
    return SL_OK;
}

static sl_status read_vertices(sl_context *context, const sli_wad *wad, const sli_wad_map *map,
                               doom_records *records) {
    enum { BYTES = 4 };
    record_lump lump;
    SL_TRY(open_lump(context, wad, map, "VERTEXES", BYTES, &lump));
    SL_TRY(SL_ARRAY_ROOM(context, &records->vertices, lump.count));
    for (size_t i = 0; i < lump.count; i++) {
        const unsigned char *at = lump.bytes + i * BYTES;
        records->vertices.items[records->vertices.count++] =
            (sl_point){sli_wad_i16(at), sli_wad_i16(at + 2)};
    }
    return SL_OK;
}

static int64_t side_at(const unsigned char *at) {
    const unsigned side = sli_wad_u16(at);
    return side == 0xffff ? -1 : (int64_t)side;
}

static sl_status read_linedefs(sl_context *context, const sli_wad *wad, const sli_wad_map *map,
                               bool hexen, doom_records *records) {
    const size_t bytes = hexen ? 16 : 14;
    record_lump lump;
    SL_TRY(open_lump(context, wad, map, "LINEDEFS", bytes, &lump));
    SL_TRY(SL_ARRAY_ROOM(context, &records->linedefs, lump.count));
    for (size_t i = 0; i < lump.count; i++) {
        const unsigned char *at = lump.bytes + i * bytes;
        // Hexen has a special of one byte and five arguments where Doom has special and tag.
        records->linedefs.items[records->linedefs.count++] = (doom_linedef){
            .vertex = {sli_wad_u16(at), sli_wad_u16(at + 2)},
            .special = hexen ? at[6] : (int)sli_wad_u16(at + 6),
            .tag = hexen ? at[7] : sli_wad_i16(at + 8),
            .side = {side_at(at + bytes - 4), side_at(at + bytes - 2)},
        };
    }
    return SL_OK;
}

static sl_status read_sidedefs(sl_context *context, const sli_wad *wad, const sli_wad_map *map,
                               doom_records *records) {
    enum { BYTES = 30, SECTOR = 28 };
    record_lump lump;
    SL_TRY(open_lump(context, wad, map, "SIDEDEFS", BYTES, &lump));
    SL_TRY(SL_ARRAY_ROOM(context, &records->sidedefs, lump.count));
    for (size_t i = 0; i < lump.count; i++)
        records->sidedefs.items[records->sidedefs.count++] =
            (doom_sidedef){.sector = sli_wad_u16(lump.bytes + i * BYTES + SECTOR)};
    return SL_OK;
}

static sl_status read_sectors(sl_context *context, const sli_wad *wad, const sli_wad_map *map,
                              doom_records *records) {
    enum { BYTES = 26, TAG = 24 };
    record_lump lump;
    SL_TRY(open_lump(context, wad, map, "SECTORS", BYTES, &lump));
    SL_TRY(SL_ARRAY_ROOM(context, &records->sectors, lump.count));
    for (size_t i = 0; i < lump.count; i++) {
        const unsigned char *at = lump.bytes + i * BYTES;
        records->sectors.items[records->sectors.count++] = (sli_doom_sector){
            .floor = sli_wad_i16(at), .ceiling = sli_wad_i16(at + 2), .tag = sli_wad_i16(at + TAG)};
    }
    return SL_OK;
}

static sl_status read_things(sl_context *context, const sli_wad *wad, const sli_wad_map *map,
                             bool hexen, doom_records *records) {
    const size_t bytes = hexen ? 20 : 10;
    record_lump lump;
    SL_TRY(open_lump(context, wad, map, "THINGS", bytes, &lump));
    for (size_t i = 0; i < lump.count; i++) {
        // A Hexen thing has an id in front, and its height behind its place.
        const unsigned char *at = lump.bytes + i * bytes + (hexen ? 2 : 0);
        const unsigned char *angle = at + (hexen ? 6 : 4);
        const unsigned type = sli_wad_u16(angle + 2);
        if (!is_start(type)) continue;
        SL_TRY(SL_ARRAY_ROOM(context, &records->starts, 1));
        const sl_start start = {.at = {sli_wad_i16(at), sli_wad_i16(at + 2)},
                                .heading = sli_wad_i16(angle)};
        records->starts.items[records->starts.count++] = (sli_doom_start){start, (int)type};
    }
    return SL_OK;
}

/// Reads lumps of records: Doom's, or Hexen's where there is a BEHAVIOR.
static sl_status doom_read_lumps(sl_context *context, const sli_wad *wad, const sli_wad_map *map,
                                 doom_records *records) {
    const bool hexen = sli_wad_find_lump(wad, map, "BEHAVIOR") < wad->lump_count;
    if (sli_wad_find_lump(wad, map, "LEAFS") < wad->lump_count)
        return sl_fail_at(context, wad->name, 0,
                          "map %s is one of Doom 64 (it has a lump LEAFS), whose records are not "
                          "read: save it in the format UDMF or Doom with a level editor",
                          map->name);
    records->format = hexen ? "Hexen" : "Doom";
    records->hexen_specials = hexen;
    SL_TRY(read_vertices(context, wad, map, records));
    SL_TRY(read_linedefs(context, wad, map, hexen, records));
    SL_TRY(read_sidedefs(context, wad, map, records));
    SL_TRY(read_sectors(context, wad, map, records));
    return read_things(context, wad, map, hexen, records);
}

// --- TEXTMAP

typedef struct text_map {
    sl_context *context;
    const sli_wad *wad;
    const char *map, *at, *end;
    uint32_t line;
    doom_records *records;
} text_map;

static sl_status fail_text(const text_map *text, uint32_t line, const char *format, ...)
    SL_PRINTF(3, 4);

/// "FILE:12: map MAP01, lump TEXTMAP: what is wrong", the line counted in the lump.
static sl_status fail_text(const text_map *text, uint32_t line, const char *format, ...) {
    char what[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return sl_fail_at(text->context, text->wad->name, line, "map %s, lump TEXTMAP: %s", text->map,
                      what);
}

// --- TEXTMAP: words

static void step(text_map *text) {
    if (*text->at++ == '\n' && text->line < UINT32_MAX) text->line++;
}

static bool is_next(const text_map *text, const char *what) {
    const size_t length = strlen(what);
    return (size_t)(text->end - text->at) >= length && memcmp(text->at, what, length) == 0;
}

/// Passes over white space and comments.
static sl_status skip_blank(text_map *text) {
    for (;;) {
        while (text->at < text->end && strchr(" \t\r\n\f\v", *text->at)) step(text);
        if (is_next(text, "//")) {
            while (text->at < text->end && *text->at != '\n') step(text);
        } else if (is_next(text, "/*")) {
            const uint32_t line = text->line;
            text->at += 2;
            while (!is_next(text, "*/")) {
                if (text->at == text->end) return fail_text(text, line, "'/*' without '*/'");
                step(text);
            }
            text->at += 2;
        } else {
            return SL_OK;
        }
    }
}

/// The next word: a string with its quotes, one of "{};=", or any other run of characters; one of
/// no length at the end of the text.
static sl_status next_word(text_map *text, sli_word *word) {
    SL_TRY(skip_blank(text));
    const char *first = text->at;
    const uint32_t line = text->line;
    if (first < text->end && *first == '"') {
        for (step(text); text->at == text->end || *text->at != '"'; step(text)) {
            if (text->at < text->end && *text->at == '\\') step(text);
            if (text->at >= text->end) return fail_text(text, line, "'\"' without a second one");
        }
        step(text);
    } else if (first < text->end && strchr("{};=", *first)) {
        step(text);
    } else {
        while (text->at < text->end && !strchr(" \t\r\n\f\v{};=\"", *text->at) &&
               !is_next(text, "//") && !is_next(text, "/*"))
            step(text);
    }
    *word = (sli_word){first, (size_t)(text->at - first)};
    return SL_OK;
}

static bool same_word(sli_word word, const char *name) {
    return word.length == strlen(name) && strncasecmp(word.at, name, word.length) == 0;
}

static bool is_mark(sli_word word) {
    return word.length == 0 || strchr("{};=\"", word.at[0]);
}

static sl_status fail_expected(const text_map *text, const char *expected, sli_word found) {
    if (!found.length)
        return fail_text(text, text->line, "expected %s, found the end of the lump", expected);
    return fail_text(text, text->line, "expected %s, found '%s'", expected, sli_show(found).text);
}

static sl_status expect(text_map *text, const char *mark) {
    sli_word word;
    char expected[4];
    SL_TRY(next_word(text, &word));
    if (sli_word_is(word, mark)) return SL_OK;
    snprintf(expected, sizeof expected, "'%s'", mark);
    return fail_expected(text, expected, word);
}

/// "= value ;" behind a name.
static sl_status read_value(text_map *text, sli_word *value) {
    SL_TRY(expect(text, "="));
    SL_TRY(next_word(text, value));
    if (value->length == 0 || strchr("{};=", value->at[0]))
        return fail_expected(text, "a value", *value);
    return expect(text, ";");
}

// --- TEXTMAP: numbers

/// Digits of a base, all of the word from `at` on.
static bool read_digits(sli_word word, size_t at, unsigned base, double *value) {
    *value = 0;
    for (size_t i = at; i < word.length; i++) {
        const char c = word.at[i], small = (char)(c | 0x20);
        const unsigned digit = c >= '0' && c <= '9'           ? (unsigned)(c - '0')
                               : small >= 'a' && small <= 'f' ? (unsigned)(small - 'a') + 10
                                                              : 99;
        if (digit >= base) return false;
        *value = *value * base + digit;
    }
    return at < word.length;
}

/// A decimal, or a whole number by 0x or 0 in base 16 or 8.
static bool read_number(sli_word word, double *value) {
    const size_t sign = word.length && (word.at[0] == '-' || word.at[0] == '+');
    bool read;
    if (word.length > sign + 2 && word.at[sign] == '0' && (word.at[sign + 1] | 0x20) == 'x')
        read = read_digits(word, sign + 2, 16, value);
    else if (word.length > sign + 1 && word.at[sign] == '0' && read_digits(word, sign, 8, value))
        read = true;
    else
        return sl_number_read(word.at, word.length, value);
    if (sign && word.at[0] == '-') *value = -*value;
    return read;
}

/// A field of a block that is wanted: whole numbers into `whole`, others into `real`.
typedef struct field {
    const char *name;
    int64_t *whole;
    double *real;
    bool needed, given;
} field;

static sl_status read_field(const text_map *text, field *at, sli_word value) {
    double number;
    if (!read_number(value, &number) || !sl_coordinate_usable(sli_coordinate(number)))
        return fail_text(text, text->line, "%s: expected a number, found '%s'", at->name,
                         sli_show(value).text);
    number = sli_coordinate(number);
    at->given = true;
    if (at->real) {
        *at->real = number;
        return SL_OK;
    }
    if (number != floor(number) || fabs(number) > INT_MAX)
        return fail_text(text, text->line, "%s: expected a whole number, found '%s'", at->name,
                         sli_show(value).text);
    *at->whole = (int64_t)number;
    return SL_OK;
}

/// Reads "{ name = value; ... }" behind the block's name; fields that are not listed are passed
/// over. `line` is that of the name.
static sl_status read_block(text_map *text, const char *block, uint32_t line, field *fields,
                            size_t count) {
    SL_TRY(expect(text, "{"));
    for (;;) {
        sli_word name, value;
        SL_TRY(next_word(text, &name));
        if (sli_word_is(name, "}")) break;
        if (is_mark(name)) return fail_expected(text, "a field's name or '}'", name);
        SL_TRY(read_value(text, &value));
        for (size_t i = 0; i < count; i++)
            if (same_word(name, fields[i].name)) SL_TRY(read_field(text, &fields[i], value));
    }
    for (size_t i = 0; i < count; i++)
        if (fields[i].needed && !fields[i].given)
            return fail_text(text, line, "this %s has no %s", block, fields[i].name);
    return SL_OK;
}

#define FIELD_COUNT(fields) (sizeof(fields) / sizeof *(fields))

// --- TEXTMAP: blocks

static sl_status read_vertex(text_map *text, uint32_t line) {
    sl_point point = {0};
    field fields[] = {{.name = "x", .real = &point.x, .needed = true},
                      {.name = "y", .real = &point.y, .needed = true}};
    SL_TRY(read_block(text, "vertex", line, fields, FIELD_COUNT(fields)));
    SL_TRY(SL_ARRAY_ROOM(text->context, &text->records->vertices, 1));
    text->records->vertices.items[text->records->vertices.count++] = point;
    return SL_OK;
}

static sl_status read_linedef(text_map *text, uint32_t line) {
    doom_linedef linedef = {.side = {-1, -1}, .line = line};
    int64_t special = 0, id = -1, argument = 0;
    field fields[] = {
        {.name = "v1", .whole = &linedef.vertex[0], .needed = true},
        {.name = "v2", .whole = &linedef.vertex[1], .needed = true},
        {.name = "sidefront", .whole = &linedef.side[0]},
        {.name = "sideback", .whole = &linedef.side[1]},
        {.name = "special", .whole = &special},
        {.name = "id", .whole = &id},
        {.name = "arg0", .whole = &argument},
    };
    SL_TRY(read_block(text, "linedef", line, fields, FIELD_COUNT(fields)));
    linedef.special = (int)special;
    // No id is the tag 0 of the older formats.
    linedef.tag = (int)(text->records->hexen_specials ? argument : id == -1 ? 0 : id);
    SL_TRY(SL_ARRAY_ROOM(text->context, &text->records->linedefs, 1));
    text->records->linedefs.items[text->records->linedefs.count++] = linedef;
    return SL_OK;
}

static sl_status read_sidedef(text_map *text, uint32_t line) {
    doom_sidedef sidedef = {.line = line};
    field fields[] = {{.name = "sector", .whole = &sidedef.sector, .needed = true}};
    SL_TRY(read_block(text, "sidedef", line, fields, FIELD_COUNT(fields)));
    SL_TRY(SL_ARRAY_ROOM(text->context, &text->records->sidedefs, 1));
    text->records->sidedefs.items[text->records->sidedefs.count++] = sidedef;
    return SL_OK;
}

static sl_status read_sector(text_map *text, uint32_t line) {
    sli_doom_sector sector = {0};
    int64_t tag = 0;
    field fields[] = {{.name = "heightfloor", .real = &sector.floor},
                      {.name = "heightceiling", .real = &sector.ceiling},
                      {.name = "id", .whole = &tag}};
    SL_TRY(read_block(text, "sector", line, fields, FIELD_COUNT(fields)));
    sector.tag = (int)tag;
    SL_TRY(SL_ARRAY_ROOM(text->context, &text->records->sectors, 1));
    text->records->sectors.items[text->records->sectors.count++] = sector;
    return SL_OK;
}

static sl_status read_thing(text_map *text, uint32_t line) {
    sl_start start = {.line = line};
    int64_t type = 0;
    field fields[] = {{.name = "x", .real = &start.at.x, .needed = true},
                      {.name = "y", .real = &start.at.y, .needed = true},
                      {.name = "angle", .real = &start.heading},
                      {.name = "type", .whole = &type, .needed = true}};
    SL_TRY(read_block(text, "thing", line, fields, FIELD_COUNT(fields)));
    if (!is_start(type)) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(text->context, &text->records->starts, 1));
    text->records->starts.items[text->records->starts.count++] = (sli_doom_start){start, (int)type};
    return SL_OK;
}

static sl_status read_named_block(text_map *text, sli_word name, uint32_t line) {
    static const struct {
        const char *name;
        sl_status (*read)(text_map *text, uint32_t line);
    } blocks[] = {{"vertex", read_vertex},
                  {"linedef", read_linedef},
                  {"sidedef", read_sidedef},
                  {"sector", read_sector},
                  {"thing", read_thing}};
    for (size_t i = 0; i < FIELD_COUNT(blocks); i++)
        if (same_word(name, blocks[i].name)) return blocks[i].read(text, line);
    return read_block(text, "block", line, NULL, 0);
}

/// Doom's own specials stand in the namespaces of the older games; all others have Hexen's.
static void take_namespace(text_map *text, sli_word value) {
    text->records->hexen_specials = !same_word(value, "\"doom\"") &&
                                    !same_word(value, "\"heretic\"") &&
                                    !same_word(value, "\"strife\"");
}

static sl_status read_all(text_map *text) {
    for (size_t count = 0;; count++) {
        if (count % 1024 == 0) SL_TRY(sl_check_cancelled(text->context));
        sli_word name, value;
        SL_TRY(next_word(text, &name));
        if (name.length == 0) return SL_OK;
        if (is_mark(name)) return fail_expected(text, "a name", name);
        const uint32_t line = text->line;
        SL_TRY(skip_blank(text));
        if (!is_next(text, "=")) {
            SL_TRY(read_named_block(text, name, line));
            continue;
        }
        SL_TRY(read_value(text, &value));
        if (same_word(name, "namespace")) take_namespace(text, value);
    }
}

/// Reads a TEXTMAP.
static sl_status doom_read_textmap(sl_context *context, const sli_wad *wad, const sli_wad_map *map,
                                   doom_records *records) {
    sli_lump lump;
    SL_TRY(sli_wad_lump(context, wad, map->header + 1, &lump));
    if (map->end == wad->lump_count)
        return sl_fail_at(context, wad->name, 0, "map %s has no lump ENDMAP", map->name);
    records->format = "UDMF";
    text_map text = {.context = context,
                     .wad = wad,
                     .map = map->name,
                     .at = (const char *)lump.bytes,
                     .end = (const char *)lump.bytes + lump.size,
                     .line = 1,
                     .records = records};
    return read_all(&text);
}

// --- references

/// What is needed to look up one record's references.
typedef struct lookup {
    sl_context *context;
    const sli_wad *wad;
    const sli_wad_map *map;
    const doom_records *records;
} lookup;

/// "FILE:12: map MAP01, linedef 3: vertex 99, but there are 8"
static sl_status fail_reference(const lookup *look, const char *record, size_t index, uint32_t line,
                                const char *what, int64_t reference, size_t count) {
    return sl_fail_at(look->context, look->wad->name, line,
                      "map %s, %s %zu: %s %lld, but there are %zu", look->map->name, record, index,
                      what, (long long)reference, count);
}

static sl_status find_sector(const lookup *look, size_t linedef, int side, uint32_t *sector) {
    const doom_records *records = look->records;
    const doom_linedef *line = &records->linedefs.items[linedef];
    const int64_t index = line->side[side];
    *sector = SLI_NO_SECTOR;
    if (index == -1) return SL_OK;
    if (index < 0 || (uint64_t)index >= records->sidedefs.count)
        return fail_reference(look, "linedef", linedef, line->line, "sidedef", index,
                              records->sidedefs.count);
    const doom_sidedef *found = &records->sidedefs.items[index];
    if (found->sector < 0 || (uint64_t)found->sector >= records->sectors.count)
        return fail_reference(look, "sidedef", (size_t)index, found->line, "sector", found->sector,
                              records->sectors.count);
    *sector = (uint32_t)found->sector;
    return SL_OK;
}

static sl_status find_line(const lookup *look, size_t linedef, sli_doom_line *out) {
    const doom_records *records = look->records;
    const doom_linedef *line = &records->linedefs.items[linedef];
    sl_point ends[2];
    for (int i = 0; i < 2; i++) {
        if (line->vertex[i] < 0 || (uint64_t)line->vertex[i] >= records->vertices.count)
            return fail_reference(look, "linedef", linedef, line->line, "vertex", line->vertex[i],
                                  records->vertices.count);
        ends[i] = records->vertices.items[line->vertex[i]];
    }
    *out = (sli_doom_line){.from = ends[0],
                           .to = ends[1],
                           .special = line->special,
                           .tag = line->tag,
                           .line = line->line};
    SL_TRY(find_sector(look, linedef, 0, &out->right));
    return find_sector(look, linedef, 1, &out->left);
}

static sl_status find_lines(const lookup *look, sli_doom_level *level) {
    const size_t count = look->records->linedefs.count;
    level->lines = sl_alloc_array(look->context, count, sizeof *level->lines);
    if (!level->lines) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) SL_TRY(find_line(look, i, &level->lines[i]));
    level->line_count = count;
    return SL_OK;
}

// --- polyobjects: a line that starts one, and the lines from end to end up to its beginning; or
// --- lines that each say so. The game moves them as one, and begins by moving most of them away.

typedef struct line_start {
    sl_point at;
    size_t line;
} line_start;

static int compare_starts(const void *left, const void *right) {
    const line_start *a = left, *b = right;
    const int order = sli_compare_points(a->at, b->at);
    return order ? order : (a->line > b->line) - (a->line < b->line);
}

/// The first line that starts at a point; `count` for none.
static size_t find_start(const line_start *starts, size_t count, sl_point at) {
    size_t low = 0, high = count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (sli_compare_points(starts[middle].at, at) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low < count && sli_compare_points(starts[low].at, at) == 0 ? starts[low].line : count;
}

/// Each step marks a line, or is the chain's last.
static void mark_chain(sli_doom_level *level, const line_start *starts, size_t first) {
    for (size_t i = first; i < level->line_count && !level->lines[i].moves;
         i = find_start(starts, level->line_count, level->lines[i].to))
        level->lines[i].moves = true;
}

static sl_status mark_polyobjects(sl_context *context, sli_doom_level *level) {
    enum { START_LINE = 1, EXPLICIT_LINE = 5 };
    const size_t count = level->line_count;
    if (!level->hexen_specials) return SL_OK;
    line_start *starts = sl_alloc_array(context, count, sizeof *starts);
    if (!starts) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) starts[i] = (line_start){level->lines[i].from, i};
    if (count) qsort(starts, count, sizeof *starts, compare_starts);
    for (size_t i = 0; i < count; i++)
        if (level->lines[i].special == START_LINE) mark_chain(level, starts, i);
    for (size_t i = 0; i < count; i++)
        if (level->lines[i].special == EXPLICIT_LINE) level->lines[i].moves = true;
    sl_free(context, starts);
    return SL_OK;
}

// --- the level

sl_status sli_doom_read(sl_context *context, const sli_wad *wad, const sli_wad_map *map,
                        sli_doom_level *level) {
    doom_records records = {0};
    const lookup look = {.context = context, .wad = wad, .map = map, .records = &records};
    sli_doom_level read = {0};
    sl_status status = map->is_text ? doom_read_textmap(context, wad, map, &records)
                                    : doom_read_lumps(context, wad, map, &records);
    if (status == SL_OK) status = find_lines(&look, &read);
    read.hexen_specials = records.hexen_specials;
    if (status == SL_OK) status = mark_polyobjects(context, &read);
    sl_free(context, records.vertices.items);
    sl_free(context, records.linedefs.items);
    sl_free(context, records.sidedefs.items);
    memcpy(read.name, map->name, sizeof read.name);
    read.format = records.format;
    read.sectors = records.sectors.items;
    read.sector_count = records.sectors.count;
    read.starts = records.starts.items;
    read.start_count = records.starts.count;
    if (status == SL_OK)
        *level = read;
    else
        sli_doom_level_destroy(context, &read);
    return status;
}

void sli_doom_level_destroy(sl_context *context, sli_doom_level *level) {
    sl_free(context, level->lines);
    sl_free(context, level->sectors);
    sl_free(context, level->starts);
    *level = (sli_doom_level){0};
}

// --- doors

/// Whether a special of Doom or Boom is a door's. A manual one moves the sector at its left side,
/// the others those of their tag.
static bool is_doom_door(int special, bool *manual) {
    static const unsigned char by_hand[] = {1, 26, 27, 28, 31, 32, 33, 34, 117, 118};
    static const unsigned char by_tag[] = {
        2,   3,   4,   16,  29,  42,  46,  50,  61,  63,  75,  76,  86,  90,  99,  103, 105, 106,
        107, 108, 109, 110, 111, 112, 113, 114, 115, 116, 133, 134, 135, 136, 137, 175, 196};
    // Boom's generalized doors, the locked ones among them: the low three bits say how they are
    // triggered, 6 and 7 by hand.
    if (special >= 0x3800 && special < 0x4000) {
        *manual = (special & 7) >= 6;
        return true;
    }
    if (special <= 0 || special > 255) return false;
    *manual = memchr(by_hand, special, sizeof by_hand) != NULL;
    return *manual || memchr(by_tag, special, sizeof by_tag) != NULL;
}

/// Whether a special of Hexen or ZDoom is a door's; one with the tag 0 moves the sector at its
/// left.
static bool is_hexen_door(int special) {
    return (special >= 10 && special <= 14) || (special >= 105 && special <= 107) ||
           special == 202 || special == 249;
}

void sli_doom_find_doors(const sli_doom_level *level, bool *is_door) {
    for (size_t i = 0; i < level->sector_count; i++)
        is_door[i] = level->sectors[i].ceiling <= level->sectors[i].floor;
    for (size_t i = 0; i < level->line_count; i++) {
        const sli_doom_line *line = &level->lines[i];
        bool manual = line->tag == 0;
        if (!(level->hexen_specials ? is_hexen_door(line->special)
                                    : is_doom_door(line->special, &manual)))
            continue;
        if (manual && line->left != SLI_NO_SECTOR) is_door[line->left] = true;
        if (manual || line->tag == 0) continue;
        for (size_t k = 0; k < level->sector_count; k++)
            if (level->sectors[k].tag == line->tag) is_door[k] = true;
    }
}

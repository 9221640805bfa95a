// The Universal Doom Map Format, version 1.1: "name = value;" and "block { name = value; ... }".
// What it does not know is passed over, as the format wants.
#include "io/doom_records.h"
#include "map/scan.h"

#include <limits.h>
#include <math.h>
#include <strings.h>

typedef struct text_map {
    sl_context *context;
    const sl_wad *wad;
    const char *map, *at, *end;
    uint32_t line;
    sl_doom_records *records;
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

// --- words

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
static sl_status next_word(text_map *text, sl_word *word) {
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
    *word = (sl_word){first, (size_t)(text->at - first)};
    return SL_OK;
}

static bool same_word(sl_word word, const char *name) {
    return word.length == strlen(name) && strncasecmp(word.at, name, word.length) == 0;
}

static bool is_mark(sl_word word) {
    return word.length == 0 || strchr("{};=\"", word.at[0]);
}

static sl_status fail_expected(const text_map *text, const char *expected, sl_word found) {
    if (!found.length)
        return fail_text(text, text->line, "expected %s, found the end of the lump", expected);
    return fail_text(text, text->line, "expected %s, found '%s'", expected, sl_show(found).text);
}

static sl_status expect(text_map *text, const char *mark) {
    sl_word word;
    char expected[4];
    SL_TRY(next_word(text, &word));
    if (sl_word_is(word, mark)) return SL_OK;
    snprintf(expected, sizeof expected, "'%s'", mark);
    return fail_expected(text, expected, word);
}

/// "= value ;" behind a name.
static sl_status read_value(text_map *text, sl_word *value) {
    SL_TRY(expect(text, "="));
    SL_TRY(next_word(text, value));
    if (value->length == 0 || strchr("{};=", value->at[0]))
        return fail_expected(text, "a value", *value);
    return expect(text, ";");
}

// --- numbers

/// Digits of a base, all of the word from `at` on.
static bool read_digits(sl_word word, size_t at, unsigned base, double *value) {
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
static bool read_number(sl_word word, double *value) {
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

static sl_status read_field(const text_map *text, field *at, sl_word value) {
    double number;
    if (!read_number(value, &number) || !sl_coordinate_usable(number))
        return fail_text(text, text->line, "%s: expected a number, found '%s'", at->name,
                         sl_show(value).text);
    at->given = true;
    if (at->real) {
        *at->real = number;
        return SL_OK;
    }
    if (number != floor(number) || fabs(number) > INT_MAX)
        return fail_text(text, text->line, "%s: expected a whole number, found '%s'", at->name,
                         sl_show(value).text);
    *at->whole = (int64_t)number;
    return SL_OK;
}

/// Reads "{ name = value; ... }" behind the block's name; fields that are not listed are passed
/// over. `line` is that of the name.
static sl_status read_block(text_map *text, const char *block, uint32_t line, field *fields,
                            size_t count) {
    SL_TRY(expect(text, "{"));
    for (;;) {
        sl_word name, value;
        SL_TRY(next_word(text, &name));
        if (sl_word_is(name, "}")) break;
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

// --- blocks

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
    sl_doom_linedef linedef = {.side = {-1, -1}, .line = line};
    int64_t special = 0, id = -1, argument = 0;
    field fields[] = {
        {.name = "v1", .whole = &linedef.vertex[0], .needed = true},
        {.name = "v2", .whole = &linedef.vertex[1], .needed = true},
        {.name = "sidefront", .whole = &linedef.side[0], .needed = true},
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
    sl_doom_sidedef sidedef = {.line = line};
    field fields[] = {{.name = "sector", .whole = &sidedef.sector, .needed = true}};
    SL_TRY(read_block(text, "sidedef", line, fields, FIELD_COUNT(fields)));
    SL_TRY(SL_ARRAY_ROOM(text->context, &text->records->sidedefs, 1));
    text->records->sidedefs.items[text->records->sidedefs.count++] = sidedef;
    return SL_OK;
}

static sl_status read_sector(text_map *text, uint32_t line) {
    sl_doom_sector sector = {0};
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
    if (type != SL_DOOM_PLAYER_1) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(text->context, &text->records->starts, 1));
    text->records->starts.items[text->records->starts.count++] = start;
    return SL_OK;
}

static sl_status read_named_block(text_map *text, sl_word name, uint32_t line) {
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
static void take_namespace(text_map *text, sl_word value) {
    text->records->hexen_specials = !same_word(value, "\"doom\"") &&
                                    !same_word(value, "\"heretic\"") &&
                                    !same_word(value, "\"strife\"");
}

static sl_status read_all(text_map *text) {
    for (size_t count = 0;; count++) {
        if (count % 1024 == 0) SL_TRY(sl_check_cancelled(text->context));
        sl_word name, value;
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

sl_status sl_doom_read_textmap(sl_context *context, const sl_wad *wad, const sl_wad_map *map,
                               sl_doom_records *records) {
    sl_lump lump;
    SL_TRY(sl_wad_lump(context, wad, map->header + 1, &lump));
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

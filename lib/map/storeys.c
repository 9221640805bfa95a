/// The reader of buildings: statements of words, one on each line, as in the map text.
#include "sightline/storeys.h"
#include "map/scan.h"
#include "sightline/support.h"

#include <string.h>

enum { WORDS_MOST = 8 };

typedef struct building_reader {
    sl_context *context;
    const char *path;
    uint32_t line;
    sl_building building;
    bool begun; ///< by "storeys 1"
    sli_word words[WORDS_MOST];
    size_t count;
} building_reader;

static bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

/// Cuts a line into words, up to a '#'. A word in quotes may have blanks.
static sl_status split(building_reader *r, sli_word line) {
    const char *at = line.at, *end = line.at + line.length;
    r->count = 0;
    for (;;) {
        while (at < end && is_blank(*at)) at++;
        if (at == end || *at == '#') return SL_OK;
        if (r->count == WORDS_MOST)
            return sl_fail_at(r->context, r->path, r->line, "more than %d words", WORDS_MOST);
        const bool quoted = *at == '"';
        const char *begin = at + quoted;
        for (at = begin; at < end && (quoted ? *at != '"' : !is_blank(*at) && *at != '#');) at++;
        if (quoted && at == end)
            return sl_fail_at(r->context, r->path, r->line, "a word begins with \" and has no end");
        r->words[r->count++] = (sli_word){begin, (size_t)(at - begin)};
        at += quoted;
    }
}

static sl_status refuse(building_reader *r, const char *form) {
    return sl_fail_at(r->context, r->path, r->line, "expected '%s'", form);
}

// --- statements

/// Names stand in tables, and before the ':' of a place.
static sl_status check_name(building_reader *r, const char *what, sli_word name) {
    bool usable = sli_name_usable(name.at, name.length);
    for (size_t i = 0; i < name.length; i++) usable &= !strchr(":,\"\\", name.at[i]);
    if (usable) return SL_OK;
    return sl_fail_at(r->context, r->path, r->line,
                      "%s: '%s' is no name: expected one word without : , \" and \\", what,
                      sli_show(name).text);
}

static sl_status read_storey(building_reader *r) {
    sl_building *b = &r->building;
    if (r->count != 3 || !r->words[2].length) return refuse(r, "storey NAME FILE");
    const sli_word name = r->words[1];
    SL_TRY(check_name(r, "storey", name));
    const size_t other = sl_building_find(b, name.at, name.length);
    if (other != SL_NO_STOREY)
        return sl_fail_at(r->context, r->path, r->line,
                          "storey: '%s' is the name of the storey in line %u", sli_show(name).text,
                          (unsigned)b->storeys[other].line);
    SL_TRY(sl_reserve(r->context, &b->storeys, &b->storey_room, b->storey_count + 1,
                      sizeof *b->storeys));
    sl_storey *s = &b->storeys[b->storey_count];
    *s = (sl_storey){.name = sl_copy_text(r->context, name.at, name.length),
                     .path = sli_beside_path(r->context, r->path, r->words[2]),
                     .line = r->line};
    b->storey_count++;
    return s->name && s->path ? SL_OK : SL_NO_MEMORY;
}

/// "3,4"
static sl_status read_place(building_reader *r, sli_word word, sl_point *out) {
    const char *comma = memchr(word.at, ',', word.length);
    if (!comma)
        return sl_fail_at(r->context, r->path, r->line, "link: expected a place X,Y, found '%s'",
                          sli_show(word).text);
    const sli_word x = {word.at, (size_t)(comma - word.at)};
    const sli_word y = {comma + 1, word.length - x.length - 1};
    SL_TRY(sli_read_coordinate(r->context, r->path, r->line, x, &out->x));
    return sli_read_coordinate(r->context, r->path, r->line, y, &out->y);
}

static sl_status read_end(building_reader *r, size_t word, sl_storey_link *link, int end) {
    const sli_word name = r->words[word];
    link->storeys[end] = sl_building_find(&r->building, name.at, name.length);
    if (link->storeys[end] == SL_NO_STOREY)
        return sl_fail_at(r->context, r->path, r->line,
                          "link: no storey '%s' stands before this line", sli_show(name).text);
    return read_place(r, r->words[word + 1], &link->places[end]);
}

static sl_status read_link(building_reader *r) {
    sl_building *b = &r->building;
    sl_storey_link link = {.line = r->line};
    if (r->count != 6 && r->count != 7)
        return refuse(r, "link NAME STOREY X,Y STOREY X,Y [LENGTH]");
    SL_TRY(check_name(r, "link", r->words[1]));
    for (int end = 0; end < 2; end++) SL_TRY(read_end(r, end ? 4 : 2, &link, end));
    if (link.storeys[0] == link.storeys[1] && link.places[0].x == link.places[1].x &&
        link.places[0].y == link.places[1].y)
        return sl_fail_at(r->context, r->path, r->line, "link: expected two different places");
    if (r->count == 7)
        SL_TRY(sli_read_coordinate(r->context, r->path, r->line, r->words[6], &link.length));
    if (link.length < 0)
        return sl_fail_at(r->context, r->path, r->line,
                          "link: expected a length of 0 or more, found '%s'",
                          sli_show(r->words[6]).text);
    SL_TRY(sl_reserve(r->context, &b->links, &b->link_room, b->link_count + 1, sizeof *b->links));
    link.name = sl_copy_text(r->context, r->words[1].at, r->words[1].length);
    if (!link.name) return SL_NO_MEMORY;
    b->links[b->link_count++] = link;
    return SL_OK;
}

static sl_status read_statement(building_reader *r) {
    if (!r->begun) {
        r->begun =
            r->count == 2 && sli_word_is(r->words[0], "storeys") && sli_word_is(r->words[1], "1");
        return r->begun ? SL_OK : refuse(r, "storeys 1");
    }
    if (sli_word_is(r->words[0], "storey")) return read_storey(r);
    if (sli_word_is(r->words[0], "link")) return read_link(r);
    return sl_fail_at(r->context, r->path, r->line, "expected 'storey' or 'link', found '%s'",
                      sli_show(r->words[0]).text);
}

// --- the file

void sl_building_destroy(sl_context *context, sl_building *building) {
    for (size_t i = 0; i < building->storey_count; i++) {
        sl_free(context, building->storeys[i].name);
        sl_free(context, building->storeys[i].path);
    }
    for (size_t i = 0; i < building->link_count; i++) sl_free(context, building->links[i].name);
    sl_free(context, building->storeys);
    sl_free(context, building->links);
    *building = (sl_building){0};
}

size_t sl_building_find(const sl_building *building, const char *name, size_t length) {
    for (size_t i = 0; i < building->storey_count; i++)
        if (sli_word_is((sli_word){name, length}, building->storeys[i].name)) return i;
    return SL_NO_STOREY;
}

sl_status sl_building_parse(sl_context *context, const char *path, const char *text, size_t size,
                            sl_building *out) {
    building_reader r = {.context = context, .path = path};
    sli_lines lines = sli_lines_of(text, size);
    sli_word line;
    sl_status status = sli_refuse_nul(context, path, text, size);
    while (status == SL_OK && sli_lines_next(&lines, &line)) {
        r.line = lines.line;
        status = split(&r, line);
        if (status == SL_OK && r.count) status = read_statement(&r);
    }
    if (status == SL_OK && !r.building.storey_count)
        status = sl_fail_at(context, path, 0,
                            "no storey: expected 'storeys 1', then 'storey NAME FILE'");
    if (status == SL_OK)
        *out = r.building;
    else
        sl_building_destroy(context, &r.building);
    return status;
}

sl_status sl_building_read(sl_context *context, const char *path, sl_building *out) {
    sl_bytes bytes;
    SL_TRY(sl_file_read(context, path, &bytes));
    const sl_status status = sl_building_parse(context, path, bytes.data, bytes.size, out);
    sl_free(context, bytes.data);
    return status;
}

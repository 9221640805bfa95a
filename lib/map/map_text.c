/// The map text: one statement on each line, with a keyword first. One table has the form of every
/// statement. Error messages name file and line. maps/FORMAT.md describes the format for users.
///
/// Comments stay with their statements. One on a line of its own belongs to the next statement, one
/// behind a statement to that one. map_text_write.c writes them.
#include "map/ground.h"
#include "map/scan.h"
#include "map/source.h"
#include "map/unit.h"
#include "sightline/support.h"

#include <math.h>

/// The reading of a map text. `words` and `numbers` are those of the current statement, without its
/// first word and its name.
typedef struct text_reader {
    sl_context *context;
    const char *name;
    uint32_t line;
    sl_map *map;
    SL_ARRAY(sli_word) words;
    SL_ARRAY(double) numbers;
    SL_ARRAY(char) notes;
    char *label;      ///< the name of a door, path or object
    uint32_t stops;   ///< of the current statement
    sli_word comment; ///< of the current line; empty for none
    size_t waiting;   ///< from this comment on they wait for their statement
} text_reader;

static sl_point point_of(const text_reader *reader, size_t i) {
    return (sl_point){reader->numbers.items[2 * i], reader->numbers.items[2 * i + 1]};
}

static sl_segment segment_of(const text_reader *reader) {
    return (sl_segment){point_of(reader, 0), point_of(reader, 1)};
}

static sl_status refuse_no_length(const text_reader *reader, const char *what) {
    const sl_segment at = segment_of(reader);
    if (at.a.x != at.b.x || at.a.y != at.b.y) return SL_OK;
    return sl_fail_at(reader->context, reader->name, reader->line,
                      "%s: expected two different ends", what);
}

static sl_status read_wall(text_reader *reader) {
    const bool solid = reader->words.count == 5;
    if (solid && !sli_word_is(reader->words.items[4], "solid"))
        return sl_fail_at(reader->context, reader->name, reader->line,
                          "wall: expected 'solid' or nothing after the coordinates, found '%s'",
                          sli_show(reader->words.items[4]).text);
    const sl_segment at = segment_of(reader);
    SL_TRY(sl_map_add_wall(reader->context, reader->map, at.a, at.b, reader->line));
    if (solid)
        reader->map->walls[reader->map->wall_count - 1].ground = SL_SOLID_LEFT | SL_SOLID_BEGINS;
    return SL_OK;
}

static sl_status read_walls(text_reader *reader) {
    for (size_t i = 0; i + 1 < reader->numbers.count / 2; i++)
        SL_TRY(sl_map_add_wall(reader->context, reader->map, point_of(reader, i),
                               point_of(reader, i + 1), reader->line));
    return SL_OK;
}

/// How a door stands, what it is, or both.
static sl_status read_door(text_reader *reader) {
    sl_door_kind kind = SL_DOOR_PLAIN;
    int open = -1;
    for (size_t i = 4; i < reader->words.count; i++) {
        const sli_word word = reader->words.items[i];
        const bool last = i + 1 == reader->words.count;
        if (i == 4 && (sli_word_is(word, "open") || sli_word_is(word, "shut")))
            open = sli_word_is(word, "open");
        else if (last && sli_word_is(word, "breakable"))
            kind = SL_DOOR_BREAKABLE;
        else if (last && sli_word_is(word, "site"))
            kind = SL_DOOR_SITE;
        else
            return sl_fail_at(
                reader->context, reader->name, reader->line, "door: expected %s, found '%s'",
                i == 4 ? "'open' or 'shut', 'breakable' or 'site'" : "'breakable' or 'site'",
                sli_show(word).text);
    }
    if (open < 0) open = kind != SL_DOOR_BREAKABLE;
    SL_TRY(refuse_no_length(reader, "door"));
    SL_TRY(sl_map_add_door(reader->context, reader->map, reader->label, segment_of(reader), open,
                           reader->line));
    reader->map->doors[reader->map->door_count - 1].kind = kind;
    return SL_OK;
}

static sl_status read_mirror(text_reader *reader) {
    SL_TRY(refuse_no_length(reader, "mirror"));
    bool one_sided = false;
    if (reader->words.count == 5) {
        const sli_word word = reader->words.items[4];
        one_sided = sli_word_is(word, "one");
        if (!one_sided && !sli_word_is(word, "both"))
            return sl_fail_at(reader->context, reader->name, reader->line,
                              "mirror: expected 'one' or 'both', found '%s'", sli_show(word).text);
    }
    SL_TRY(sl_map_add_mirror(reader->context, reader->map, segment_of(reader), reader->line));
    reader->map->mirrors[reader->map->mirror_count - 1].one_sided = one_sided;
    return SL_OK;
}

static sl_status read_oneway(text_reader *reader) {
    SL_TRY(refuse_no_length(reader, "oneway"));
    return sl_map_add_oneway(reader->context, reader->map, segment_of(reader), reader->line);
}

static sl_status read_seam(text_reader *reader) {
    SL_TRY(refuse_no_length(reader, "seam"));
    return sl_map_add_seam(reader->context, reader->map, segment_of(reader), reader->line);
}

static sl_status read_over_0(text_reader *reader, const char *word, double *value) {
    if (!(reader->numbers.items[0] > 0))
        return sl_fail_at(reader->context, reader->name, reader->line,
                          "%s: expected a number greater than 0, found '%s'", word,
                          sli_show(reader->words.items[0]).text);
    *value = reader->numbers.items[0];
    return SL_OK;
}

static sl_status read_range(text_reader *reader) {
    if (reader->map->range > 0)
        return sl_fail_at(reader->context, reader->name, reader->line,
                          "a second range: the first is on line %u", reader->map->range_line);
    SL_TRY(read_over_0(reader, "range", &reader->map->range));
    reader->map->range_line = reader->line;
    return SL_OK;
}

static sl_status read_entrance(text_reader *reader) {
    if (reader->map->entrance > 0)
        return sl_fail_at(reader->context, reader->name, reader->line,
                          "a second entrance: the first is on line %u", reader->map->entrance_line);
    if (reader->words.count > 1 && !sli_word_is(reader->words.items[1], "doors"))
        return sl_fail_at(reader->context, reader->name, reader->line,
                          "entrance: expected 'doors' or nothing behind the width, found '%s'",
                          sli_show(reader->words.items[1]).text);
    SL_TRY(read_over_0(reader, "entrance", &reader->map->entrance));
    reader->map->entrance_by_doors = reader->words.count > 1;
    reader->map->entrance_line = reader->line;
    return SL_OK;
}

/// A unit may be of two words, such as grid units.
static sl_status read_unit(text_reader *reader) {
    char *unit = reader->map->unit;
    if (*unit)
        return sl_fail_at(reader->context, reader->name, reader->line,
                          "a second unit: the first is %s", unit);
    size_t length = 0;
    for (size_t i = 0; i < reader->words.count; i++) {
        const sli_word word = reader->words.items[i];
        if (length + !!i + word.length >= sizeof reader->map->unit ||
            !sli_name_usable(word.at, word.length)) {
            *unit = '\0';
            return sl_fail_at(reader->context, reader->name, reader->line,
                              "unit: expected a short word such as m, mm or ft, found '%s'",
                              sli_show(word).text);
        }
        if (i) unit[length++] = ' ';
        memcpy(unit + length, word.at, word.length);
        unit[length += word.length] = '\0';
    }
    reader->map->unit_line = reader->line;
    return SL_OK;
}

/// Two angles, not coordinates.
static sl_status read_earth(text_reader *reader) {
    double degrees[2];
    if (reader->map->earth.known)
        return sl_fail_at(reader->context, reader->name, reader->line, "a second earth");
    if (reader->map->earth.epsg)
        return sl_fail_at(reader->context, reader->name, reader->line, "earth beside crs");
    for (int i = 0; i < 2; i++) {
        const sli_word word = reader->words.items[i];
        if (!sl_number_read(word.at, word.length, &degrees[i]) ||
            !(fabs(degrees[i]) <= (i ? 90 : 180)))
            return sl_fail_at(reader->context, reader->name, reader->line,
                              "earth: expected a longitude up to 180 and a latitude up to 90 "
                              "degrees, found '%s'",
                              sli_show(word).text);
    }
    reader->map->earth = (sl_earth){.known = true, .longitude = degrees[0], .latitude = degrees[1]};
    reader->map->earth_line = reader->line;
    return SL_OK;
}

static sl_status read_crs(text_reader *reader) {
    const sli_word word = reader->words.items[0];
    if (reader->map->earth.epsg || reader->map->earth.known)
        return sl_fail_at(reader->context, reader->name, reader->line,
                          reader->map->earth.known ? "crs beside earth" : "a second crs");
    if (!sl_earth_read_epsg(word.at, word.length, &reader->map->earth.epsg))
        return sl_fail_at(reader->context, reader->name, reader->line,
                          "crs: expected EPSG:NUMBER, found '%s'", sli_show(word).text);
    reader->map->earth_line = reader->line;
    return SL_OK;
}

static sl_status read_snap(text_reader *reader) {
    if (reader->map->snap > 0)
        return sl_fail_at(reader->context, reader->name, reader->line,
                          "a second snap: the first is on line %u", reader->map->snap_line);
    SL_TRY(read_over_0(reader, "snap", &reader->map->snap));
    reader->map->snap_line = reader->line;
    return SL_OK;
}

static sl_status read_precision(text_reader *reader) {
    if (reader->map->precision > 0)
        return sl_fail_at(reader->context, reader->name, reader->line, "a second precision");
    return read_over_0(reader, "precision", &reader->map->precision);
}

/// The heading may be any finite number, as it is an angle and not a coordinate.
static sl_status read_start(text_reader *reader) {
    const sli_word word = reader->words.items[2];
    double heading;
    if (!sl_number_read(word.at, word.length, &heading) || !isfinite(heading))
        return sl_fail_at(reader->context, reader->name, reader->line,
                          "start: expected a heading in degrees, found '%s'", sli_show(word).text);
    return sl_map_add_start(reader->context, reader->map, point_of(reader, 0), heading,
                            reader->line);
}

/// All points of the statement; the caller frees them.
static sl_point *copy_points(text_reader *reader, size_t *count) {
    *count = reader->numbers.count / 2;
    sl_point *points = sl_alloc_array(reader->context, *count, sizeof *points);
    for (size_t i = 0; points && i < *count; i++) points[i] = point_of(reader, i);
    return points;
}

static sl_status read_path(text_reader *reader) {
    size_t count;
    sl_point *points = copy_points(reader, &count);
    if (!points) return SL_NO_MEMORY;
    const sl_status status =
        sl_map_add_path(reader->context, reader->map, reader->label, points, count, reader->line);
    sl_free(reader->context, points);
    return status;
}

static sl_status read_cell(text_reader *reader) {
    size_t count;
    sl_point *points = copy_points(reader, &count);
    if (!points) return SL_NO_MEMORY;
    const sl_status status =
        sli_distinct_corners(points, count) < 3
            ? sl_fail_at(reader->context, reader->name, reader->line,
                         "cell: expected at least three different corners")
            : sl_map_add_cell(reader->context, reader->map, points, count, reader->line);
    sl_free(reader->context, points);
    return status;
}

static sl_status read_ground(text_reader *reader, bool open) {
    size_t count;
    sl_point *points = copy_points(reader, &count);
    if (!points) return SL_NO_MEMORY;
    const sl_status status = sli_map_add_ground(reader->context, reader->map, reader->name, open,
                                                points, count, reader->line);
    sl_free(reader->context, points);
    return status;
}

static sl_status read_solid(text_reader *reader) {
    return read_ground(reader, false);
}

static sl_status read_open(text_reader *reader) {
    return read_ground(reader, true);
}

/// Any two opposite corners give the box.
static sl_status read_object(text_reader *reader) {
    const sl_point a = point_of(reader, 0), b = point_of(reader, 1);
    const sl_box box = {.min = {b.x < a.x ? b.x : a.x, b.y < a.y ? b.y : a.y},
                        .max = {b.x < a.x ? a.x : b.x, b.y < a.y ? a.y : b.y}};
    return sl_map_add_object(reader->context, reader->map, reader->label, box, reader->line);
}

/// The form of a statement: its first word, whether a name follows, then from `least` to `most`
/// words. The first `numbers` of these are coordinates; with ANY all are, in pairs.
typedef struct statement {
    const char *word, *usage;
    bool named;
    size_t least, most, numbers;
    sl_status (*read)(text_reader *reader);
} statement;

#define ANY SIZE_MAX

static const statement statements[] = {
    {"wall", "wall x0 y0 x1 y1 [solid] [stops WHAT]", false, 4, 5, 4, read_wall},
    {"walls", "walls x0 y0 x1 y1 ... [stops WHAT]", false, 4, ANY, ANY, read_walls},
    {"solid", "solid x0 y0 x1 y1 x2 y2 ... [stops WHAT]", false, 6, ANY, ANY, read_solid},
    {"open", "open x0 y0 x1 y1 x2 y2 ...", false, 6, ANY, ANY, read_open},
    {"door", "door NAME x0 y0 x1 y1 [open|shut] [breakable|site]", true, 4, 6, 4, read_door},
    {"mirror", "mirror x0 y0 x1 y1 [one|both]", false, 4, 5, 4, read_mirror},
    {"oneway", "oneway x0 y0 x1 y1", false, 4, 4, 4, read_oneway},
    {"seam", "seam x0 y0 x1 y1", false, 4, 4, 4, read_seam},
    {"range", "range r", false, 1, 1, 1, read_range},
    {"entrance", "entrance w [doors]", false, 1, 2, 1, read_entrance},
    {"unit", "unit NAME", false, 1, 2, 0, read_unit},
    {"earth", "earth LONGITUDE LATITUDE", false, 2, 2, 0, read_earth},
    {"crs", "crs EPSG:NUMBER", false, 1, 1, 0, read_crs},
    {"start", "start x y heading", false, 3, 3, 2, read_start},
    {"path", "path NAME x y ...", true, 2, ANY, ANY, read_path},
    {"object", "object NAME x0 y0 x1 y1", true, 4, 4, 4, read_object},
    {"cell", "cell x0 y0 x1 y1 x2 y2 ...", false, 6, ANY, ANY, read_cell},
    {"snap", "snap d", false, 1, 1, 1, read_snap},
    {"precision", "precision d", false, 1, 1, 1, read_precision},
};

static const statement *find_statement(sli_word word) {
    for (size_t i = 0; i < sizeof statements / sizeof *statements; i++)
        if (sli_word_is(word, statements[i].word)) return &statements[i];
    return NULL;
}

/// Splits a line into words, up to a '#', where the comment begins.
static sl_status split(text_reader *reader, sli_word line) {
    const char *hash = line.length ? memchr(line.at, '#', line.length) : NULL;
    reader->comment =
        hash ? (sli_word){hash, (size_t)(line.at + line.length - hash)} : (sli_word){NULL, 0};
    // One more at the end would be taken for a part of the line's end where it is read again.
    while (reader->comment.length && hash[reader->comment.length - 1] == '\r')
        reader->comment.length--;
    reader->words.count = 0;
    for (size_t i = 0; i < line.length && line.at[i] != '#';) {
        if (line.at[i] == ' ' || line.at[i] == '\t') {
            i++;
            continue;
        }
        const size_t first = i;
        while (i < line.length && line.at[i] != ' ' && line.at[i] != '\t' && line.at[i] != '#') i++;
        SL_TRY(SL_ARRAY_ROOM(reader->context, &reader->words, 1));
        reader->words.items[reader->words.count++] = (sli_word){line.at + first, i - first};
    }
    return SL_OK;
}

static sl_status read_label(text_reader *reader, sli_word word) {
    if (!sli_name_usable(word.at, word.length))
        return sl_fail_at(reader->context, reader->name, reader->line,
                          "expected a name of printable UTF-8, found '%s'", sli_show(word).text);
    reader->label = sl_copy_text(reader->context, word.at, word.length);
    return reader->label ? SL_OK : SL_NO_MEMORY;
}

static sl_status read_numbers(text_reader *reader, size_t count) {
    reader->numbers.count = 0;
    SL_TRY(SL_ARRAY_ROOM(reader->context, &reader->numbers, count));
    for (size_t i = 0; i < count; i++)
        SL_TRY(sli_read_coordinate(reader->context, reader->name, reader->line,
                                   reader->words.items[i], &reader->numbers.items[i]));
    reader->numbers.count = count;
    return SL_OK;
}

/// Takes the end of a statement that says what its walls stop.
static sl_status take_stops(text_reader *reader, const statement *row) {
    size_t *count = &reader->words.count;
    reader->stops = SL_STOPS_ALL;
    if (row->read != read_wall && row->read != read_walls && row->read != read_solid) return SL_OK;
    for (size_t i = 0; i < *count; i++) {
        if (!sli_word_is(reader->words.items[i], "stops")) continue;
        const sli_word what = i + 1 < *count ? reader->words.items[i + 1] : (sli_word){"", 0};
        if (i + 2 != *count || !sl_stops_read(what.at, what.length, &reader->stops))
            return sl_fail_at(reader->context, reader->name, reader->line,
                              "%s: expected sight or limited, steps, sound or several joined by "
                              "commas after 'stops', at the end, found '%s'",
                              row->word, sli_show(what).text);
        *count = i;
    }
    return SL_OK;
}

/// Reads the words after the first one, by the statement's row of the table.
static sl_status read_by(text_reader *reader, const statement *row) {
    SL_TRY(take_stops(reader, row));
    const size_t values = reader->words.count, names = row->named;
    const size_t walls = reader->map->wall_count;
    const bool any = row->numbers == ANY;
    if (values < row->least + names || (!any && values > row->most + names) ||
        (any && (values - names) % 2))
        return sl_fail_at(reader->context, reader->name, reader->line,
                          "expected '%s', found '%s' with %zu value%s", row->usage, row->word,
                          values, values == 1 ? "" : "s");
    if (names) {
        SL_TRY(read_label(reader, reader->words.items[0]));
        memmove(reader->words.items, reader->words.items + 1,
                --reader->words.count * sizeof(sli_word));
    }
    SL_TRY(read_numbers(reader, any ? reader->words.count : row->numbers));
    SL_TRY(row->read(reader));
    return sl_map_walls_stop(reader->context, reader->map, walls, reader->stops);
}

static sl_status read_statement(text_reader *reader) {
    const sli_word word = reader->words.items[0];
    if (sli_word_is(word, "sightline"))
        return sl_fail_at(reader->context, reader->name, reader->line,
                          "a second 'sightline': it is only the first statement");
    const statement *row = find_statement(word);
    if (!row)
        return sl_fail_at(
            reader->context, reader->name, reader->line,
            "unknown statement '%s': expected wall, walls, solid, open, door, mirror, "
            "oneway, seam, range, entrance, unit, earth, crs, start, path, object, cell, snap or "
            "precision",
            sli_show(word).text);
    memmove(reader->words.items, reader->words.items + 1, --reader->words.count * sizeof(sli_word));
    const sl_status status = read_by(reader, row);
    sl_free(reader->context, reader->label);
    reader->label = NULL;
    return status;
}

static sl_status read_first(text_reader *reader) {
    const sli_word *words = reader->words.items;
    if (words[0].at[0] == '{')
        return sl_fail_at(reader->context, reader->name, reader->line,
                          "expected 'sightline 1' as the first statement, found JSON");
    if (sli_word_is(words[0], "storeys"))
        return sl_fail_at(reader->context, reader->name, reader->line,
                          "a building, which 'sightline vga' and 'path' read: give the file of one "
                          "of its storeys");
    if (!sli_word_is(words[0], "sightline"))
        return sl_fail_at(reader->context, reader->name, reader->line,
                          "expected 'sightline 1' as the first statement, found '%s'",
                          sli_show(words[0]).text);
    if (reader->words.count != 2 || !sli_word_is(words[1], "1"))
        return sl_fail_at(reader->context, reader->name, reader->line,
                          "expected version 1 alone ('sightline 1'), found '%s'%s",
                          reader->words.count < 2 ? "" : sli_show(words[1]).text,
                          reader->words.count > 2 ? " and more" : "");
    return SL_OK;
}

/// Keeps a note, a line "#! text". Notes stand between the first statement and the second.
static sl_status read_note(text_reader *reader, sli_word line) {
    const size_t lead = line.length > 2 && line.at[2] == ' ' ? 3 : 2;
    const size_t length = line.length - lead;
    // Also room for the 0 after the last line.
    SL_TRY(SL_ARRAY_ROOM(reader->context, &reader->notes, length + 2));
    if (length) memcpy(reader->notes.items + reader->notes.count, line.at + lead, length);
    reader->notes.count += length;
    reader->notes.items[reader->notes.count++] = '\n';
    return SL_OK;
}

static bool is_note(sli_word line) {
    return line.length >= 2 && memcmp(line.at, "#!", 2) == 0 &&
           (line.length == 2 || line.at[2] == ' ');
}

/// Keeps the comment of a line without a statement, or the empty line below one.
static sl_status keep_waiting(text_reader *reader) {
    sl_map *map = reader->map;
    const sli_word comment = reader->comment;
    if (!comment.length && reader->waiting == map->source.comment_count) return SL_OK;
    return sli_map_add_comment(reader->context, map, comment.length ? comment.at : "",
                               comment.length, UINT32_MAX, false);
}

/// Gives the comments that waited to the statement on a line, and the one behind it.
static sl_status give_comments(text_reader *reader, uint32_t line) {
    sl_map *map = reader->map;
    for (size_t i = reader->waiting; i < map->source.comment_count; i++)
        map->source.comments[i].line = line;
    sl_status status = SL_OK;
    if (reader->comment.length)
        status = sli_map_add_comment(reader->context, map, reader->comment.at,
                                     reader->comment.length, line, true);
    reader->waiting = map->source.comment_count;
    return status;
}

static sl_status read_lines(text_reader *reader, const char *text, size_t size) {
    SL_TRY(sli_refuse_nul(reader->context, reader->name, text, size));
    sli_lines lines = sli_lines_of(text, size);
    size_t statements_read = 0;
    for (sli_word line; sli_lines_next(&lines, &line);) {
        reader->line = lines.line;
        if (lines.line % 4096 == 0) SL_TRY(sl_check_cancelled(reader->context));
        if (statements_read == 1 && is_note(line)) {
            SL_TRY(read_note(reader, line));
            continue;
        }
        SL_TRY(split(reader, line));
        if (reader->words.count == 0) {
            SL_TRY(keep_waiting(reader));
            continue;
        }
        SL_TRY(give_comments(reader, statements_read ? reader->line : 0));
        SL_TRY(statements_read++ ? read_statement(reader) : read_first(reader));
    }
    if (statements_read == 0)
        return sl_fail_at(reader->context, reader->name, lines.line,
                          "expected 'sightline 1' as the first statement, found none");
    if (reader->notes.count == 0) return SL_OK;
    reader->notes.items[reader->notes.count] = '\0';
    return sli_map_add_note(reader->context, reader->map, reader->notes.items);
}

sl_status sli_map_read_text(sl_context *context, const char *name, const char *text, size_t size,
                            sl_map *map) {
    sl_map read = {0};
    text_reader reader = {.context = context, .name = name, .map = &read};
    const sl_status status = read_lines(&reader, text, size);
    sl_free(context, reader.words.items);
    sl_free(context, reader.numbers.items);
    sl_free(context, reader.notes.items);
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}

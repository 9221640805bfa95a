/// Text of maps: lines, words and numbers for readers, their form in messages, and the writers.
#ifndef SL_MAP_SCAN_H
#define SL_MAP_SCAN_H

#include "geometry/orient.h"
#include "sightline/map.h"
#include "sightline/support.h"

#include <string.h>

/// A piece of the text; not ended by a 0.
typedef struct sli_word {
    const char *at;
    size_t length;
} sli_word;

static inline bool sli_word_is(sli_word word, const char *text) {
    return word.length == strlen(text) && memcmp(word.at, text, word.length) == 0;
}

/// A word without the spaces and tabs around it.
static inline sli_word sli_trimmed(sli_word word) {
    while (word.length && strchr(" \t", *word.at)) word.at++, word.length--;
    while (word.length && strchr(" \t", word.at[word.length - 1])) word.length--;
    return word;
}

/// A word for a message. It lives to the end of the expression: sli_show(word).text.
typedef struct sli_shown {
    char text[48];
} sli_shown;

/// Shortens a word, and replaces control characters, which could play tricks on a terminal.
static inline sli_shown sli_show(sli_word word) {
    sli_shown shown = {{0}};
    const size_t most = sizeof shown.text - 4;
    size_t length = word.length;
    if (length > most) {
        length = most;
        while (length && ((unsigned char)word.at[length] & 0xc0) == 0x80) length--;
    }
    for (size_t i = 0; i < length; i++) {
        const unsigned char c = (unsigned char)word.at[i];
        shown.text[i] = c < 0x20 || c == 0x7f ? '?' : word.at[i];
    }
    if (length < word.length) memcpy(shown.text + length, "...", 4);
    return shown;
}

/// A walk over the lines of a text. `line` is the number of the line last given.
typedef struct sli_lines {
    const char *at, *end;
    char ending;
    uint32_t line;
} sli_lines;

/// The text behind a byte order mark, if it begins with one.
static inline const char *sli_skip_mark(const char *text, size_t size) {
    return size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0 ? text + 3 : text;
}

/// Lines end with LF or CR LF; in a text without any LF, with CR.
static inline sli_lines sli_lines_of(const char *text, size_t size) {
    return (sli_lines){.at = sli_skip_mark(text, size),
                       .end = size ? text + size : text,
                       .ending = size && !memchr(text, '\n', size) ? '\r' : '\n'};
}

/// The next line without its end; false after the last.
static inline bool sli_lines_next(sli_lines *lines, sli_word *line) {
    if (lines->at == lines->end) return false;
    const char *stop = memchr(lines->at, lines->ending, (size_t)(lines->end - lines->at));
    const char *next = stop ? stop + 1 : lines->end;
    if (!stop) stop = lines->end;
    if (stop > lines->at && stop[-1] == '\r') stop--;
    *line = (sli_word){lines->at, (size_t)(stop - lines->at)};
    lines->at = next;
    if (lines->line < UINT32_MAX) lines->line++;
    return true;
}

/// Refuses NUL bytes. A file that has one is not text, or text of 16-bit characters; or an archive.
static inline sl_status sli_refuse_nul(sl_context *context, const char *name, const char *text,
                                       size_t size) {
    const char *nul = size ? memchr(text, '\0', size) : NULL;
    if (!nul) return SL_OK;
    if (size >= 4 && memcmp(text, "PK\3\4", 4) == 0)
        return sl_fail_at(
            context, name, 0,
            "a ZIP archive, as .pk3 files are: unpack it, and give a file that it holds");
    unsigned line = 1;
    for (const char *at = text; at < nul; at++) line += *at == '\n';
    return sl_fail_at(context, name, line, "a NUL byte: expected plain text (ASCII or UTF-8)");
}

/// Reads a coordinate: one too small to be used is 0. A message names the line and the wrong word.
static inline sl_status sli_read_coordinate(sl_context *context, const char *name, uint32_t line,
                                            sli_word word, double *value) {
    double number;
    if (!sl_number_read(word.at, word.length, &number))
        return sl_fail_at(context, name, line, "expected a finite decimal number, found '%s'",
                          sli_show(word).text);
    number = sli_coordinate(number);
    if (!sl_coordinate_usable(number))
        return sl_fail_at(context, name, line,
                          "'%s' is out of range: expected a magnitude up to %g",
                          sli_show(word).text, SL_COORDINATE_MAX);
    *value = number;
    return SL_OK;
}

/// The path of a file as the file `name` calls it: from where that one lies, unless it is a whole
/// path; `\` is as good as `/`. sl_free is the caller's; NULL for lack of memory.
static inline char *sli_beside_path(sl_context *context, const char *name, sli_word relative) {
    const bool whole = relative.length && *relative.at == '/';
    const size_t folder = whole ? 0 : (size_t)(sl_path_name(name) - name);
    char *path = sl_alloc(context, folder + relative.length + 1);
    if (!path) return NULL;
    memcpy(path, name, folder);
    for (size_t i = 0; i < relative.length; i++)
        path[folder + i] = relative.at[i] == '\\' ? '/' : relative.at[i];
    path[folder + relative.length] = '\0';
    return path;
}

/// Whether a name can be written as one word of the map text: UTF-8, not empty, without white
/// space, control characters and '#'.
bool sli_name_usable(const char *name, size_t length);

/// A copy of points, for sl_free(), in which coordinates too small to be used are 0.
/// SL_BAD_ARGUMENT, naming what they are of, where one is out of range.
sl_status sli_copy_points(sl_context *context, const char *what, const sl_point *points,
                          size_t count, sl_point **out);

/// Adds a computed border as a seam. SL_BAD_ARGUMENT where a coordinate is too small to be used: a
/// border at 0 instead would be another one.
sl_status sli_map_add_border(sl_context *context, sl_map *map, sl_segment at);

// --- readers of our own formats

/// Reads the map text. SL_BAD_INPUT, with file and line, for anything unknown. `name` is the name
/// of the text in messages. The map must be empty; it stays empty on failure.
sl_status sli_map_read_text(sl_context *context, const char *name, const char *text, size_t size,
                            sl_map *map);
/// Reads the ASCII plan: each character is a unit square, and the last line is at y = 0. '#' is
/// solid, ' ' and '.' are open, '+' is a door across the passage, '@' is a start heading +x.
/// Outside the plan all is solid.
sl_status sli_map_read_plan(sl_context *context, const char *name, const char *text, size_t size,
                            sl_map *map);

// --- writers of maps, to a stream that is open; the caller asks the stream for errors

sl_status sli_map_print_text(sl_context *context, const sl_map *map, FILE *stream);

/// Prints nothing on failure.
sl_status sli_map_print_plan(sl_context *context, const sl_map *map, FILE *stream);

/// Fails where a map that was read back has not as many doors, mirrors ... as the one that was
/// written. Walls are not counted: a text may write several in one.
sl_status sli_map_check_again(sl_context *context, const char *name, const sl_map *written,
                              const sl_map *again);

#endif

// Polygons of AGPLIB, the benchmark of the art gallery problem (Couto, de Rezende and de Souza
// 2009): the number of corners and their coordinates, as fractions "a/b" or decimals, the outline
// counter-clockwise; then the number of holes, and each hole likewise.
#include "io/fraction.h"
#include "io/io_formats.h"
#include "map/ground.h"
#include "map/scan.h"

#include <math.h>

typedef struct agp_reader {
    sl_context *context;
    const char *name;
    sli_lines lines;
    sli_word line; ///< what is left of the current one
    SL_ARRAY(sl_point) corners;
    size_t holes, corner_count;
    size_t rounded; ///< coordinates that are no doubles
} agp_reader;

/// The next word; empty at the end.
static sli_word next_word(agp_reader *r) {
    for (;;) {
        r->line = sli_trimmed(r->line);
        size_t length = 0;
        while (length < r->line.length && !strchr(" \t", r->line.at[length])) length++;
        const sli_word word = {r->line.at, length};
        if (length) {
            r->line = (sli_word){r->line.at + length, r->line.length - length};
            return word;
        }
        if (!sli_lines_next(&r->lines, &r->line)) return (sli_word){"", 0};
    }
}

/// A decimal, or a fraction: of whole numbers the double nearest to it, else the quotient of two
/// doubles.
static sl_status read_fraction(agp_reader *r, double *value) {
    const sli_word word = next_word(r);
    const char *slash = word.length ? memchr(word.at, '/', word.length) : NULL;
    if (!word.length)
        return sl_fail_at(r->context, r->name, r->lines.line,
                          "the file ends before the last coordinate");
    if (!slash) return sli_read_coordinate(r->context, r->name, r->lines.line, word, value);
    const size_t above = (size_t)(slash - word.at), below = word.length - above - 1;
    double a, b;
    bool exact = true;
    if (!sli_fraction_read(word.at, above, slash + 1, below, value, &exact)) {
        if (!sl_number_read(word.at, above, &a) || !sl_number_read(slash + 1, below, &b) ||
            !isfinite(a) || !isfinite(b) || b == 0)
            return sl_fail_at(r->context, r->name, r->lines.line,
                              "expected a number or a fraction such as 3/4, found '%s'",
                              sli_show(word).text);
        *value = a / b;
    }
    r->rounded += !exact;
    *value = sli_coordinate(*value) + 0.0; // no -0
    if (sl_coordinate_usable(*value)) return SL_OK;
    return sl_fail_at(r->context, r->name, r->lines.line,
                      "'%s' is out of range: expected a magnitude up to %g", sli_show(word).text,
                      SL_COORDINATE_MAX);
}

static sl_status read_count(agp_reader *r, const char *what, double least, size_t *count) {
    const sli_word word = next_word(r);
    double number;
    // No more than there are characters.
    const double most = (double)(r->lines.end - r->lines.at) + (double)r->line.length;
    if (!sl_number_read(word.at, word.length, &number) || number != floor(number) || number < least)
        return sl_fail_at(r->context, r->name, r->lines.line,
                          "expected the number of %s, at least %g, found '%s'", what, least,
                          sli_show(word).text);
    if (number > most)
        return sl_fail_at(r->context, r->name, r->lines.line, "the file is too short for %s %s",
                          sli_show(word).text, what);
    *count = (size_t)number;
    return SL_OK;
}

static sl_status read_ring(agp_reader *r, bool hole, sl_map *map) {
    size_t count;
    SL_TRY(read_count(r, hole ? "a hole's corners" : "corners", 3, &count));
    const uint32_t line = r->lines.line;
    r->corners.count = 0;
    SL_TRY(SL_ARRAY_ROOM(r->context, &r->corners, count));
    for (size_t i = 0; i < count; i++) {
        sl_point *corner = &r->corners.items[r->corners.count++];
        SL_TRY(read_fraction(r, &corner->x));
        SL_TRY(read_fraction(r, &corner->y));
    }
    r->corner_count += count;
    return sli_map_add_ground(r->context, map, r->name, !hole, r->corners.items, count, line);
}

static sl_status read_polygon(agp_reader *r, sl_map *map) {
    SL_TRY(read_ring(r, false, map));
    const agp_reader at_end = *r;
    if (next_word(r).length) {
        *r = at_end;
        SL_TRY(read_count(r, "holes", 0, &r->holes));
    }
    for (size_t i = 0; i < r->holes; i++) SL_TRY(read_ring(r, true, map));
    const sli_word more = next_word(r);
    if (!more.length) return SL_OK;
    return sl_fail_at(r->context, r->name, r->lines.line,
                      "expected the end of the file, found '%s'", sli_show(more).text);
}

sl_status sli_map_read_agp(sl_context *context, const char *name, const char *text, size_t size,
                           const sl_import_options *options, sl_map *map) {
    (void)options;
    SL_TRY(sli_refuse_nul(context, name, text, size));
    agp_reader r = {.context = context, .name = name, .lines = sli_lines_of(text, size)};
    r.line = (sli_word){"", 0};
    const sl_status status = read_polygon(&r, map);
    sl_free(context, r.corners.items);
    if (status != SL_OK) {
        sl_map_destroy(context, map);
        return status;
    }
    sl_note(context, "%s: a polygon of %zu corners and %zu holes", name, r.corner_count, r.holes);
    if (r.rounded)
        sl_note(context, "%s: the nearest doubles are taken for fractions that are none: %zu", name,
                r.rounded);
    return SL_OK;
}

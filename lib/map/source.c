/// What a map keeps of its file: notes, comments, and what the file calls its lines.
#include "map/source.h"

#include "sightline/support.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void sli_source_destroy(sl_context *context, sl_map_source *source) {
    sl_free(context, source->name);
    sl_free(context, source->notes);
    sl_free(context, source->labels);
    sl_free(context, source->label_text);
    for (size_t i = 0; i < source->comment_count; i++) sl_free(context, source->comments[i].text);
    sl_free(context, source->comments);
    for (size_t i = 0; i < source->text_count; i++) sl_free(context, source->texts[i].text);
    sl_free(context, source->texts);
    *source = (sl_map_source){0};
}

sl_status sli_map_add_note(sl_context *context, sl_map *map, const char *text) {
    sl_map_source *source = &map->source;
    const size_t old = source->notes ? strlen(source->notes) : 0, length = strlen(text);
    char *notes = sl_alloc(context, old + length + 2);
    if (!notes) return SL_NO_MEMORY;
    if (old) memcpy(notes, source->notes, old);
    size_t end = old;
    for (size_t i = 0; i < length; i++) {
        // The map text would not keep CR LF.
        if (text[i] == '\n')
            while (end > old && notes[end - 1] == '\r') end--;
        notes[end++] = text[i];
    }
    while (end > old && notes[end - 1] == '\r') end--;
    if (length == 0 || text[length - 1] != '\n') notes[end++] = '\n';
    notes[end] = '\0';
    sl_free(context, source->notes);
    source->notes = notes;
    return SL_OK;
}

static sl_status add_comment(sl_context *context, sl_map_source *source, const char *text,
                             size_t length, uint32_t line, bool behind) {
    SL_TRY(sl_reserve(context, &source->comments, &source->comment_room, source->comment_count + 1,
                      sizeof *source->comments));
    char *copy = sl_copy_text(context, text, length);
    if (!copy) return SL_NO_MEMORY;
    source->comments[source->comment_count++] = (sl_comment){copy, line, behind};
    return SL_OK;
}

sl_status sli_map_add_comment(sl_context *context, sl_map *map, const char *text, size_t length,
                              uint32_t line, bool behind) {
    return add_comment(context, &map->source, text, length, line, behind);
}

// --- texts of a drawing

sl_status sli_source_add_text(sl_context *context, sl_map_source *source, const char *text,
                              size_t length, sl_point at, double height) {
    size_t begin = 0, end;
    if (!sl_coordinate_usable(at.x) || !sl_coordinate_usable(at.y)) return SL_OK;
    while (begin < length && (unsigned char)text[begin] <= ' ') begin++;
    end = begin;
    while (end < length && (unsigned char)text[end] >= ' ') end++;
    while (end > begin && text[end - 1] == ' ') end--;
    if (end == begin) return SL_OK;
    SL_TRY(sl_reserve(context, &source->texts, &source->text_room, source->text_count + 1,
                      sizeof *source->texts));
    char *copy = sl_copy_text(context, text + begin, end - begin);
    if (!copy) return SL_NO_MEMORY;
    source->texts[source->text_count++] = (sl_map_text){copy, at, height};
    return SL_OK;
}

// --- what the file calls its lines

/// The number of labels for lines below `line`.
static size_t labels_below(const sl_map_source *source, uint32_t line) {
    size_t low = 0, high = source->label_count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (source->labels[middle].line < line)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

const char *sl_map_label(const sl_map *map, uint32_t line) {
    const sl_map_source *source = &map->source;
    const size_t at = labels_below(source, line);
    const bool found = at < source->label_count && source->labels[at].line == line;
    return found ? source->label_text + source->labels[at].text : NULL;
}

/// The last label; NULL for none.
static sl_label *last_label(const sl_map_source *source) {
    return source->label_count ? &source->labels[source->label_count - 1] : NULL;
}

/// Where a text stands at the end of label_text, which it is added to.
static sl_status add_label_text(sl_context *context, sl_map_source *source, const char *text,
                                uint32_t *begin) {
    char shown[SL_LINE_TEXT];
    size_t length = 0;
    for (; text[length] && length < sizeof shown - 32; length++) {
        const unsigned char c = (unsigned char)text[length];
        shown[length] = c < 0x20 || c == 0x7f ? '?' : text[length];
    }
    // A cut leaves no character in part.
    if (text[length])
        while (length && ((unsigned char)text[length] & 0xc0) == 0x80) length--;
    shown[length] = '\0';
    const sl_label *last = last_label(source);
    if (last && strcmp(source->label_text + last->text, shown) == 0) {
        *begin = last->text;
        return SL_OK;
    }
    if (source->label_length > UINT32_MAX - sizeof shown) return sl_fail_memory(context);
    SL_TRY(sl_reserve(context, &source->label_text, &source->label_text_room,
                      source->label_length + length + 1, 1));
    *begin = (uint32_t)source->label_length;
    memcpy(source->label_text + source->label_length, shown, length + 1);
    source->label_length += length + 1;
    return SL_OK;
}

/// Several things on one line: the last label names the first, and says that there are others.
static sl_status share_label(sl_context *context, sl_map_source *source, const char *text) {
    static const char others[] = " or another on this line";
    sl_label *last = last_label(source);
    const char *first = source->label_text + last->text;
    char both[SL_LINE_TEXT];
    if (strcmp(first, text) == 0 || strstr(first, others)) return SL_OK;
    snprintf(both, sizeof both, "%.96s%s", first, others);
    return add_label_text(context, source, both, &last->text);
}

sl_status sli_map_add_label(sl_context *context, sl_map *map, uint32_t line, const char *text) {
    sl_map_source *source = &map->source;
    const uint32_t last = source->label_count ? last_label(source)->line : 0;
    uint32_t begin = 0;
    if (line < last || line == 0)
        return sl_fail(context, SL_BAD_ARGUMENT, "label: line %u comes after line %u",
                       (unsigned)line, (unsigned)last);
    if (line == last) return share_label(context, source, text);
    SL_TRY(sl_reserve(context, &source->labels, &source->label_room, source->label_count + 1,
                      sizeof *source->labels));
    SL_TRY(add_label_text(context, source, text, &begin));
    source->labels[source->label_count++] = (sl_label){.line = line, .text = begin};
    return SL_OK;
}

void sl_map_say_line(const sl_map *map, uint32_t line, char text[SL_LINE_TEXT]) {
    const bool items = map->source.lines_are_items;
    const char *label = sl_map_label(map, line), *word = items ? "item" : "line";
    if (!line)
        text[0] = '\0';
    else if (!label)
        snprintf(text, SL_LINE_TEXT, "%s %u", word, (unsigned)line);
    else if (items)
        snprintf(text, SL_LINE_TEXT, "%s", label);
    else
        snprintf(text, SL_LINE_TEXT, "line %u (%s)", (unsigned)line, label);
}

sl_status sli_map_fail(sl_context *context, const sl_map *map, sl_status status, uint32_t line,
                       const char *format, ...) {
    char what[512], number[16] = "", named[SL_LINE_TEXT + 2] = "";
    const bool items = map->source.lines_are_items;
    const char *label = sl_map_label(map, line);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    if (line && !items)
        snprintf(number, sizeof number, "%u:", (unsigned)line);
    else if (line && !label)
        snprintf(named, sizeof named, "item %u: ", (unsigned)line);
    if (label) snprintf(named, sizeof named, "%s: ", label);
    return sl_fail(context, status, "%s:%s %s%s", sli_map_name(map), number, named, what);
}

// --- copies

static sl_status copy_text(sl_context *context, const char *from, char **to) {
    *to = from ? sl_copy_text(context, from, strlen(from)) : NULL;
    return from && !*to ? SL_NO_MEMORY : SL_OK;
}

static sl_status copy_labels(sl_context *context, const sl_map_source *from, sl_map_source *to) {
    if (!from->label_count) return SL_OK;
    to->labels = sl_alloc_array(context, from->label_count, sizeof *to->labels);
    to->label_text = sl_alloc_array(context, from->label_length, 1);
    if (!to->labels || !to->label_text) return SL_NO_MEMORY;
    memcpy(to->labels, from->labels, from->label_count * sizeof *to->labels);
    memcpy(to->label_text, from->label_text, from->label_length);
    to->label_count = to->label_room = from->label_count;
    to->label_length = to->label_text_room = from->label_length;
    return SL_OK;
}

sl_status sli_source_copy(sl_context *context, const sl_map_source *from, sl_map_source *to) {
    *to = (sl_map_source){.lines_are_items = from->lines_are_items,
                          .transform = from->transform,
                          .page = from->page,
                          .pixels = from->pixels,
                          .drawing_unit = from->drawing_unit,
                          .plans = from->plans,
                          .joined = from->joined};
    SL_TRY(copy_text(context, from->name, &to->name));
    SL_TRY(copy_text(context, from->notes, &to->notes));
    SL_TRY(copy_labels(context, from, to));
    for (size_t i = 0; i < from->comment_count; i++) {
        const sl_comment *c = &from->comments[i];
        SL_TRY(add_comment(context, to, c->text, strlen(c->text), c->line, c->behind));
    }
    for (size_t i = 0; i < from->text_count; i++) {
        const sl_map_text *t = &from->texts[i];
        SL_TRY(sli_source_add_text(context, to, t->text, strlen(t->text), t->at, t->height));
    }
    return SL_OK;
}

/// Layers of a PDF.
///
/// cairo has none. So a layer begins a new page, and the file that cairo has written is put
/// together anew, with one page: what was the content of a page becomes a form, which the page
/// draws between the marks of an optional content group (ISO 32000-1, 8.11), and all that cairo has
/// numbered stays. Objects and the table of their places must be plain text (page.c sees to it).
///
///     page 1: content a                        page: /OC /L0 BDC /X0 Do EMC  -> form a
///     page 2: content b     becomes                  /OC /L1 BDC /X1 Do EMC  -> form b
#include "draw/live.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/// A file of cairo's, and what is made of it.
typedef struct pdf {
    sl_context *context;
    const char *at, *end;
    const char **objects; ///< by number, as the table says; NULL for none
    size_t count;
    sli_text_buffer out;
    SL_ARRAY(size_t) places;  ///< by number, of `out`
    SL_ARRAY(size_t) pages;   ///< their numbers
    SL_ARRAY(size_t) forms;   ///< by page: the number of its content
    SL_ARRAY(size_t) lookups; ///< by page: the number of its resources
} pdf;

static sl_status fail(const pdf *p) {
    return sl_fail(p->context, SL_IO,
                   "this version of cairo writes PDF in a way that has no layers");
}

static const char *find(const char *at, const char *end, const char *word) {
    const size_t length = strlen(word);
    for (; at + length <= end; at++)
        if (*at == *word && memcmp(at, word, length) == 0) return at;
    return NULL;
}

/// The number behind a word, as in "/Contents 3 0 R"; 0 for none.
static size_t number_after(const char *at, const char *end, const char *word) {
    const char *found = find(at, end, word);
    return found ? (size_t)strtoul(found + strlen(word), NULL, 10) : 0;
}

static sl_status put(pdf *p, const char *bytes, size_t count) {
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->out, count));
    memcpy(p->out.items + p->out.count, bytes, count);
    p->out.count += count;
    return SL_OK;
}

SL_PRINTF(2, 3) static sl_status say(pdf *p, const char *format, ...) {
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return put(p, text, (size_t)length);
}

// --- reading

static sl_status read_table(pdf *p) {
    const char *last = NULL;
    for (const char *at = p->at; (at = find(at, p->end, "\nstartxref\n")); at++) last = at;
    const size_t place = last ? (size_t)strtoul(last + 11, NULL, 10) : 0;
    const char *table = p->at + place, *entry;
    if (!place || table + 8 > p->end || memcmp(table, "xref\n0 ", 7) != 0) return fail(p);
    char *behind;
    p->count = (size_t)strtoul(table + 7, &behind, 10);
    entry = behind + 1;
    if ((size_t)(p->end - entry) / 20 < p->count) return fail(p);
    p->objects = sl_alloc_array(p->context, p->count + 1, sizeof *p->objects);
    if (!p->objects) return SL_NO_MEMORY;
    for (size_t i = 1; i < p->count; i++) {
        const size_t object = (size_t)strtoul(entry + 20 * i, NULL, 10);
        if (object >= place) return fail(p);
        p->objects[i] = entry[20 * i + 17] == 'n' ? p->at + object : NULL;
    }
    return SL_OK;
}

/// Where an object ends, behind "endobj". Its stream may have any bytes: its length is known.
static const char *end_of(const pdf *p, size_t number) {
    const char *at = p->objects[number];
    const char *stream = find(at, p->end, "\nstream\n"), *end = find(at, p->end, "endobj\n");
    if (stream && end && stream < end) {
        const char *length = find(at, stream, "/Length ");
        size_t size = number_after(at, stream, "/Length ");
        const char *reference = length ? strchr(length, 'R') : NULL;
        if (reference && reference < stream && reference - length < 24) {
            if (size >= p->count || !p->objects[size]) return NULL;
            size = number_after(p->objects[size], p->end, " obj\n");
        }
        if ((size_t)(p->end - stream) < size + 8) return NULL;
        end = find(stream + 8 + size, p->end, "endobj\n");
    }
    return end ? end + 7 : NULL;
}

static sl_status add_page(pdf *p, size_t number) {
    const char *at = p->objects[number], *end = find(at, p->end, "endobj\n");
    const size_t form = number_after(at, end, "/Contents ");
    const size_t lookup = number_after(at, end, "/Resources ");
    if (!form || !lookup || form >= p->count || !p->objects[form]) return fail(p);
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->pages, 1));
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->forms, 1));
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->lookups, 1));
    p->pages.items[p->pages.count++] = number;
    p->forms.items[p->forms.count++] = form;
    p->lookups.items[p->lookups.count++] = lookup;
    return SL_OK;
}

/// The pages, in the order of the file's list.
static sl_status read_pages(pdf *p, size_t *root, size_t *list) {
    const char *trailer = find(p->at, p->end, "\ntrailer\n");
    *root = trailer ? number_after(trailer, p->end, "/Root ") : 0;
    if (!*root || *root >= p->count || !p->objects[*root]) return fail(p);
    *list = number_after(p->objects[*root], p->end, "/Pages ");
    if (!*list || *list >= p->count || !p->objects[*list]) return fail(p);
    const char *at = find(p->objects[*list], p->end, "/Kids [");
    if (!at) return fail(p);
    at += 7;
    for (;;) {
        char *behind;
        const size_t page = (size_t)strtoul(at, &behind, 10);
        if (behind == at) return SL_OK;
        if (page >= p->count || !p->objects[page]) return fail(p);
        SL_TRY(add_page(p, page));
        at = find(behind, p->end, "R");
        if (!at) return fail(p);
        at++;
    }
}

// --- writing

static sl_status begin_object(pdf *p, size_t number) {
    while (p->places.count <= number) {
        SL_TRY(SL_ARRAY_ROOM(p->context, &p->places, 1));
        p->places.items[p->places.count++] = 0;
    }
    p->places.items[number] = p->out.count;
    return say(p, "%zu 0 obj\n", number);
}

/// The content of a page, as a form with its resources. `box` is the page's.
static sl_status put_form(pdf *p, size_t page, const char *box, size_t box_length) {
    const size_t number = p->forms.items[page];
    const char *at = p->objects[number], *end = end_of(p, number);
    const char *dictionary = find(at, p->end, "<<");
    if (!end || !dictionary) return fail(p);
    SL_TRY(begin_object(p, number));
    SL_TRY(say(p, "<< /Type /XObject /Subtype /Form /Resources %zu 0 R\n   /BBox ",
               p->lookups.items[page]));
    SL_TRY(put(p, box, box_length));
    SL_TRY(say(p, "\n   /Group << /Type /Group /S /Transparency /I true /CS /DeviceRGB >>\n"));
    return put(p, dictionary + 2, (size_t)(end - dictionary) - 2);
}

static sl_status put_page(pdf *p, size_t list, const char *box, size_t box_length) {
    const size_t first = p->count, pages = p->pages.count; // groups, then the page's content
    SL_TRY(begin_object(p, p->pages.items[0]));
    SL_TRY(say(p, "<< /Type /Page /Parent %zu 0 R /Contents %zu 0 R\n   /MediaBox ", list,
               first + pages));
    SL_TRY(put(p, box, box_length));
    SL_TRY(say(p, "\n   /Resources << /XObject <<"));
    for (size_t i = 0; i < pages; i++) SL_TRY(say(p, " /X%zu %zu 0 R", i, p->forms.items[i]));
    SL_TRY(say(p, " >>\n   /Properties <<"));
    for (size_t i = 0; i < pages; i++) SL_TRY(say(p, " /L%zu %zu 0 R", i, first + i));
    return say(p, " >> >> >>\nendobj\n");
}

/// The groups, with their names, and the content of the page.
static sl_status put_groups(pdf *p, const char *const *names) {
    const size_t first = p->count, pages = p->pages.count;
    size_t length = 0;
    for (size_t i = 0; i < pages; i++) {
        SL_TRY(begin_object(p, first + i));
        SL_TRY(say(p, "<< /Type /OCG /Name (%s) >>\nendobj\n", names[i]));
        length += (size_t)snprintf(NULL, 0, "/OC /L%zu BDC /X%zu Do EMC\n", i, i);
    }
    SL_TRY(begin_object(p, first + pages));
    SL_TRY(say(p, "<< /Length %zu >>\nstream\n", length));
    for (size_t i = 0; i < pages; i++) SL_TRY(say(p, "/OC /L%zu BDC /X%zu Do EMC\n", i, i));
    return say(p, "endstream\nendobj\n");
}

static sl_status put_root(pdf *p, size_t root, size_t list) {
    SL_TRY(begin_object(p, root));
    SL_TRY(say(p, "<< /Type /Catalog /Pages %zu 0 R\n   /OCProperties << /OCGs [", list));
    for (size_t i = 0; i < p->pages.count; i++) SL_TRY(say(p, " %zu 0 R", p->count + i));
    SL_TRY(say(p, " ] /D << /Order ["));
    for (size_t i = 0; i < p->pages.count; i++) SL_TRY(say(p, " %zu 0 R", p->count + i));
    return say(p, " ] >> >> >>\nendobj\n");
}

static bool is_one_of(const size_t *numbers, size_t count, size_t number, size_t *which) {
    for (*which = 0; *which < count; ++*which)
        if (numbers[*which] == number) return true;
    return false;
}

static sl_status put_objects(pdf *p, size_t root, size_t list, const char *box, size_t length) {
    for (size_t i = 1, which; i < p->count; i++) {
        if (!p->objects[i]) continue;
        if (i == root) {
            SL_TRY(put_root(p, root, list));
        } else if (i == list) {
            SL_TRY(begin_object(p, list));
            SL_TRY(say(p, "<< /Type /Pages /Kids [ %zu 0 R ] /Count 1 >>\nendobj\n",
                       p->pages.items[0]));
        } else if (is_one_of(p->pages.items, p->pages.count, i, &which)) {
            if (!which) SL_TRY(put_page(p, list, box, length));
        } else if (is_one_of(p->forms.items, p->forms.count, i, &which)) {
            SL_TRY(put_form(p, which, box, length));
        } else {
            const char *end = end_of(p, i);
            if (!end) return fail(p);
            SL_TRY(begin_object(p, i));
            const char *body = find(p->objects[i], end, "obj\n");
            if (!body) return fail(p);
            SL_TRY(put(p, body + 4, (size_t)(end - body) - 4));
        }
    }
    return SL_OK;
}

static sl_status put_table(pdf *p, size_t root) {
    const size_t place = p->out.count;
    const char *trailer = find(p->at, p->end, "\ntrailer\n");
    const size_t about = number_after(trailer, p->end, "/Info ");
    SL_TRY(say(p, "xref\n0 %zu\n", p->places.count));
    for (size_t i = 0; i < p->places.count; i++)
        SL_TRY(p->places.items[i] ? say(p, "%010zu 00000 n \n", p->places.items[i])
                                  : say(p, "0000000000 65535 f \n"));
    SL_TRY(say(p, "trailer\n<< /Size %zu /Root %zu 0 R", p->places.count, root));
    if (about) SL_TRY(say(p, " /Info %zu 0 R", about));
    return say(p, " >>\nstartxref\n%zu\n%%%%EOF\n", place);
}

static sl_status rewrite(pdf *p, const char *const *names, size_t name_count) {
    size_t root = 0, list = 0;
    SL_TRY(read_table(p));
    SL_TRY(read_pages(p, &root, &list));
    if (p->pages.count != name_count || !name_count) return fail(p);
    const char *page = p->objects[p->pages.items[0]];
    const char *box = find(page, p->end, "/MediaBox "), *end = box ? strchr(box, ']') : NULL;
    if (!end) return fail(p);
    box += 10;
    SL_TRY(say(p, "%%PDF-1.5\n%%\xb5\xed\xae\xfb\n"));
    SL_TRY(put_objects(p, root, list, box, (size_t)(end - box) + 1));
    SL_TRY(put_groups(p, names));
    return put_table(p, root);
}

sl_status sli_live_write_pdf(sl_context *context, cairo_surface_t *surface, sli_text_buffer *file) {
    size_t count;
    const char *const *names;
    SL_TRY(sli_live_layers(context, surface, &names, &count));
    pdf p = {.context = context, .at = file->items, .end = file->items + file->count};
    const sl_status status = rewrite(&p, names, count);
    void *const arrays[] = {p.objects, p.places.items, p.pages.items, p.forms.items,
                            p.lookups.items};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) sl_free(context, arrays[i]);
    sl_free(context, status == SL_OK ? file->items : p.out.items);
    if (status == SL_OK) *file = p.out;
    return status;
}

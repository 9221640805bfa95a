/// Layers and texts of an SVG.
///
/// cairo writes letters as outlines, and it has no layers. So a layer begins a new page, and the
/// pages of the finished file become groups, one over the other, with the names that Inkscape shows
/// as layers. Texts are kept apart and written at the end, as the topmost layer.
#include "draw/live.h"

#include <stdlib.h>
#include <string.h>

typedef struct live {
    sl_context *context;
    SL_ARRAY(const char *) names; ///< of the pages
    bool keeps_texts, out_of_memory;
    sli_text_buffer texts; ///< as elements of SVG
} live;

static const cairo_user_data_key_t live_key = {0};

static void drop_live(void *data) {
    live *l = data;
    sl_free(l->context, l->names.items);
    sl_free(l->context, l->texts.items);
    sl_free(l->context, l);
}

sl_status sli_live_begin(sl_context *context, cairo_surface_t *surface, bool texts) {
    live *l = sl_alloc_array(context, 1, sizeof *l);
    if (!l) return SL_NO_MEMORY;
    *l = (live){.context = context, .keeps_texts = texts};
    if (cairo_surface_set_user_data(surface, &live_key, l, drop_live) == CAIRO_STATUS_SUCCESS)
        return SL_OK;
    drop_live(l);
    return sl_fail_memory(context);
}

static live *live_of(cairo_t *cairo) {
    return cairo_surface_get_user_data(cairo_get_target(cairo), &live_key);
}

void sli_layer_begin(cairo_t *cairo, const char *name) {
    live *l = live_of(cairo);
    if (!l) return;
    if (l->names.count) cairo_show_page(cairo);
    if (SL_ARRAY_ROOM(l->context, &l->names, 1) == SL_OK)
        l->names.items[l->names.count++] = name;
    else
        l->out_of_memory = true;
}

sl_status sli_live_layers(sl_context *context, cairo_surface_t *surface, const char *const **names,
                          size_t *count) {
    const live *l = cairo_surface_get_user_data(surface, &live_key);
    *names = l ? l->names.items : NULL;
    *count = l ? l->names.count : 0;
    return l && l->out_of_memory ? sl_fail_memory(context) : SL_OK;
}

// --- texts

static sl_status add(sl_context *context, sli_text_buffer *to, const char *bytes, size_t count) {
    SL_TRY(SL_ARRAY_ROOM(context, to, count));
    memcpy(to->items + to->count, bytes, count);
    to->count += count;
    return SL_OK;
}

static sl_status add_text(sl_context *context, sli_text_buffer *to, const char *text) {
    return add(context, to, text, strlen(text));
}

static sl_status add_escaped(sl_context *context, sli_text_buffer *to, const char *text,
                             size_t length) {
    for (size_t i = 0; i < length; i++) {
        const char *as = text[i] == '&' ? "&amp;" : text[i] == '<' ? "&lt;" : NULL;
        SL_TRY(as ? add_text(context, to, as) : add(context, to, text + i, 1));
    }
    return SL_OK;
}

static sl_status add_attribute(sl_context *context, sli_text_buffer *to, const char *name,
                               double value) {
    char number[SL_NUMBER_TEXT], text[SL_NUMBER_TEXT + 32];
    snprintf(number, sizeof number, "%.4f", value);
    snprintf(text, sizeof text, " %s=\"%s\"", name, number);
    return add_text(context, to, text);
}

static sl_status add_element(live *l, sl_colour colour, double x, double y,
                             const sli_live_text *text) {
    char fill[48];
    SL_TRY(add_text(l->context, &l->texts, "<text xml:space=\"preserve\""));
    SL_TRY(add_attribute(l->context, &l->texts, "x", x));
    SL_TRY(add_attribute(l->context, &l->texts, "y", y));
    SL_TRY(add_attribute(l->context, &l->texts, "font-size", text->size));
    SL_TRY(add_attribute(l->context, &l->texts, "textLength", text->width));
    if (text->bold) SL_TRY(add_text(l->context, &l->texts, " font-weight=\"bold\""));
    snprintf(fill, sizeof fill, " fill=\"#%02x%02x%02x\">", (unsigned)(colour.red * 255 + 0.5),
             (unsigned)(colour.green * 255 + 0.5), (unsigned)(colour.blue * 255 + 0.5));
    SL_TRY(add_text(l->context, &l->texts, fill));
    SL_TRY(add_escaped(l->context, &l->texts, text->text, text->length));
    return add_text(l->context, &l->texts, "</text>\n");
}

bool sli_live_keep(cairo_t *cairo, sl_colour colour, double x, double y,
                   const sli_live_text *text) {
    live *l = live_of(cairo);
    if (!l || !l->keeps_texts) return false;
    cairo_user_to_device(cairo, &x, &y);
    if (text->length && add_element(l, colour, x, y, text) != SL_OK) l->out_of_memory = true;
    return true;
}

// --- the file

#define INKSCAPE " xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\""
#define TEXTS                                                                                      \
    "<g id=\"text\" inkscape:groupmode=\"layer\" inkscape:label=\"text\" "                         \
    "font-family=\"DejaVu Sans, sans-serif\">\n"

static size_t count_before(const live *l, size_t layer) {
    size_t count = 0;
    for (size_t i = 0; i < layer; i++)
        count += strcmp(l->names.items[i], l->names.items[layer]) == 0;
    return count;
}

/// The group of a layer. Its id is its name, with a number where the name was there before.
static sl_status add_group(live *l, size_t layer, sli_text_buffer *out) {
    const char *name = l->names.items[layer];
    const size_t before = count_before(l, layer);
    char number[24] = "", group[256];
    if (before) snprintf(number, sizeof number, "-%zu", before + 1);
    snprintf(group, sizeof group,
             "<g id=\"%s%s\" inkscape:groupmode=\"layer\" inkscape:label=\"%s%s\">\n", name, number,
             name, number);
    return add_text(l->context, out, group);
}

/// What stands in place of a line of cairo's; false to keep the line.
static bool replace(live *l, const char *line, size_t length, size_t *layer, sli_text_buffer *out,
                    sl_status *status) {
    static const char *const words[] = {"<pageSet>\n",    "</pageSet>\n", "<page>\n",
                                        "</page>\n",      "</svg>\n",     "<svg ",
                                        "<g id=\"surface"};
    enum { WORDS = sizeof words / sizeof *words };
    size_t w = 0;
    while (w < WORDS &&
           (length < strlen(words[w]) || memcmp(line, words[w], strlen(words[w])) != 0))
        w++;
    if (w == WORDS) return false;
    if (w == 6) *status = add_text(l->context, out, "<g>\n"); // the number of a surface
    if (w == 2) *status = add_group(l, (*layer)++, out);
    if (w == 3) *status = add_text(l->context, out, "</g>\n");
    if (w == 5) {
        *status = add_text(l->context, out, "<svg" INKSCAPE);
        if (*status == SL_OK) *status = add(l->context, out, line + 4, length - 4);
    }
    if (w != 4) return true;
    *status = add_text(l->context, out, TEXTS);
    if (*status == SL_OK) *status = add(l->context, out, l->texts.items, l->texts.count);
    if (*status == SL_OK) *status = add_text(l->context, out, "</g>\n</svg>\n");
    return true;
}

sl_status sli_live_write_svg(sl_context *context, cairo_surface_t *surface, sli_text_buffer *svg) {
    live *l = cairo_surface_get_user_data(surface, &live_key);
    sli_text_buffer out = {0};
    size_t layer = 0;
    if (!l) return SL_OK;
    if (l->out_of_memory) return sl_fail_memory(context);
    sl_status status = SL_OK;
    for (size_t at = 0, next; at < svg->count && status == SL_OK; at = next) {
        const char *line = svg->items + at, *end = memchr(line, '\n', svg->count - at);
        next = end ? (size_t)(end - svg->items) + 1 : svg->count;
        if (!replace(l, line, next - at, &layer, &out, &status) && status == SL_OK)
            status = add(context, &out, line, next - at);
    }
    sl_free(context, status == SL_OK ? svg->items : out.items);
    if (status == SL_OK) *svg = out;
    return status;
}

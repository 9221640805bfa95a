/// The page of a picture in a file. It is measured first, since a file's size must be known before
/// anything is drawn; then the same functions draw it. The file is PNG, SVG or PDF.
#include "draw/page.h"
#include "draw/marks.h"
#include "draw/sheet.h"
#include "sightline/json.h"
#include "sightline/support.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <string.h>
#include <strings.h>

// --- files

struct sli_paper_kind {
    const char *ending;
    cairo_surface_t *(*create)(sli_paper *paper, double width, double height);
    void (*describe)(cairo_surface_t *surface, const char *title); ///< NULL for nothing to say
    sl_status (*finish)(sl_context *context, sli_paper *paper);
    bool layered; ///< sheets of it have layers (live.h)
};

/// cairo knows no other way to be stopped than a failure to write.
static bool is_stopped(sli_paper *paper) {
    if (sl_check_cancelled(paper->context) != SL_OK) paper->stopped = true;
    return paper->stopped;
}

static cairo_status_t write_through(void *user, const unsigned char *bytes, unsigned size) {
    sli_paper *paper = user;
    if (is_stopped(paper)) return CAIRO_STATUS_WRITE_ERROR;
    return fwrite(bytes, 1, size, paper->output.stream) == size ? CAIRO_STATUS_SUCCESS
                                                                : CAIRO_STATUS_WRITE_ERROR;
}

static cairo_status_t keep_back(void *user, const unsigned char *bytes, unsigned size) {
    sli_paper *paper = user;
    if (is_stopped(paper)) return CAIRO_STATUS_WRITE_ERROR;
    if (SL_ARRAY_ROOM(paper->context, &paper->text, size) != SL_OK) {
        paper->out_of_memory = true;
        return CAIRO_STATUS_WRITE_ERROR;
    }
    memcpy(paper->text.items + paper->text.count, bytes, size);
    paper->text.count += size;
    return CAIRO_STATUS_SUCCESS;
}

/// Reports a failure of cairo.
static sl_status fail_cairo(sl_context *context, const char *path, cairo_status_t status) {
    switch (status) {
    case CAIRO_STATUS_NO_MEMORY:
        return sl_fail_memory(context);
    case CAIRO_STATUS_INVALID_STRING:
        return sl_fail(context, SL_BAD_ARGUMENT, "%s: a text is not UTF-8", path);
    case CAIRO_STATUS_WRITE_ERROR:
        return sl_fail(context, SL_IO, "%s: cannot write: %s", path,
                       errno ? strerror(errno) : "the system refused");
    default:
        return sl_fail(context, SL_IO, "%s: cannot draw: %s", path, cairo_status_to_string(status));
    }
}

static sl_status finish_surface(sl_context *context, sli_paper *paper) {
    errno = 0;
    cairo_surface_finish(paper->surface);
    const cairo_status_t status = cairo_surface_status(paper->surface);
    if (paper->out_of_memory) return sl_fail_memory(context);
    return status ? fail_cairo(context, paper->path, status) : SL_OK;
}

static cairo_surface_t *create_png(sli_paper *paper, double width, double height) {
    (void)paper;
    return cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)width, (int)height);
}

static sl_status finish_png(sl_context *context, sli_paper *paper) {
    errno = 0;
    const cairo_status_t status =
        cairo_surface_write_to_png_stream(paper->surface, write_through, paper);
    return status ? fail_cairo(context, paper->path, status) : SL_OK;
}

static cairo_surface_t *create_pdf(sli_paper *paper, double width, double height) {
    cairo_surface_t *surface = cairo_pdf_surface_create_for_stream(
        paper->to_scale ? keep_back : write_through, paper, width, height);
    // live_pdf.c reads plain text: cairo 1.18 packs objects from PDF 1.5 on. Files of 1.4 do not
    // say which letters a ligature stands for, so older versions keep to 1.5.
    if (paper->to_scale && cairo_surface_status(surface) == CAIRO_STATUS_SUCCESS)
        cairo_pdf_surface_restrict_to_version(
            surface, cairo_version() < CAIRO_VERSION_ENCODE(1, 17, 0) ? CAIRO_PDF_VERSION_1_5
                                                                      : CAIRO_PDF_VERSION_1_4);
    return surface;
}

static sl_status finish_pdf(sl_context *context, sli_paper *paper) {
    SL_TRY(finish_surface(context, paper));
    if (!paper->to_scale) return SL_OK;
    SL_TRY(sli_live_write_pdf(context, paper->surface, &paper->text));
    const size_t size = paper->text.count;
    return fwrite(paper->text.items, 1, size, paper->output.stream) == size
               ? SL_OK
               : fail_cairo(context, paper->path, CAIRO_STATUS_WRITE_ERROR);
}

static void describe_pdf(cairo_surface_t *surface, const char *title) {
    // The day of writing is what cairo would put in; the bytes must not depend on it.
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
    if (title) cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, title);
}

static cairo_surface_t *create_svg(sli_paper *paper, double width, double height) {
    cairo_surface_t *surface = cairo_svg_surface_create_for_stream(keep_back, paper, width, height);
    if (cairo_surface_status(surface) != CAIRO_STATUS_SUCCESS) return surface;
    cairo_svg_surface_set_document_unit(surface,
                                        paper->to_scale ? CAIRO_SVG_UNIT_PT : CAIRO_SVG_UNIT_PX);
    if (paper->to_scale) cairo_svg_surface_restrict_to_version(surface, CAIRO_SVG_VERSION_1_2);
    return surface;
}

/// cairo numbers the surfaces of a process, and the file holds such a number. It is written as 0,
/// so that the bytes depend on the picture alone.
static sl_status finish_svg(sl_context *context, sli_paper *paper) {
    static const char word[] = "\"surface";
    const size_t length = sizeof word - 1;
    SL_TRY(finish_surface(context, paper));
    SL_TRY(sli_live_write_svg(context, paper->surface, &paper->text));
    const char *at = paper->text.items, *end = at + paper->text.count;
    bool good = true;
    while (at < end && good) {
        const char *next = at;
        while (next < end && ((size_t)(end - next) < length || memcmp(next, word, length) != 0))
            next++;
        if (next < end) next += length;
        good = fwrite(at, 1, (size_t)(next - at), paper->output.stream) == (size_t)(next - at);
        if (next < end) good = good && fputc('0', paper->output.stream) != EOF;
        for (at = next; at < end && isdigit((unsigned char)*at);) at++;
    }
    return good ? SL_OK : fail_cairo(context, paper->path, CAIRO_STATUS_WRITE_ERROR);
}

static const sli_paper_kind kinds[] = {
    {".png", create_png, NULL, finish_png, false},
    {".svg", create_svg, NULL, finish_svg, true},
    {".pdf", create_pdf, describe_pdf, finish_pdf, true},
};

sl_status sli_paper_kind_of(sl_context *context, const char *path, const sli_paper_kind **out) {
    const size_t length = strlen(path);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const size_t ending = strlen(kinds[i].ending);
        if (length <= ending || strcasecmp(path + length - ending, kinds[i].ending) != 0) continue;
        *out = &kinds[i];
        return SL_OK;
    }
    return sl_fail(context, SL_BAD_ARGUMENT, "%s: a picture's name ends in .png, .svg or .pdf",
                   path);
}

sl_status sli_paper_open(sl_context *context, const sli_paper_kind *kind, const char *path,
                         double width, double height, bool to_scale, const char *title,
                         sli_paper *out) {
    *out = (sli_paper){.kind = kind, .path = path, .context = context, .to_scale = to_scale};
    if (title && !sl_text_is_utf8(title))
        return sl_fail(context, SL_BAD_ARGUMENT, "%s: the title is not UTF-8", path);
    SL_TRY(sl_output_open(context, path, &out->output));
    out->surface = kind->create(out, width, height);
    out->cairo = cairo_create(out->surface);
    if (kind->describe) kind->describe(out->surface, title);
    const cairo_status_t status = cairo_status(out->cairo);
    if (status == CAIRO_STATUS_SUCCESS && kind->layered && to_scale) {
        const sl_status kept = sli_live_begin(context, out->surface, kind->create == create_svg);
        return kept == SL_OK ? SL_OK : sli_paper_close(context, out, kept);
    }
    if (status == CAIRO_STATUS_SUCCESS) return SL_OK;
    return sli_paper_close(context, out, fail_cairo(context, path, status));
}

sl_status sli_paper_close(sl_context *context, sli_paper *paper, sl_status status) {
    const cairo_status_t drawn = cairo_status(paper->cairo);
    if (status == SL_OK && drawn) status = fail_cairo(context, paper->path, drawn);
    cairo_destroy(paper->cairo);
    if (status == SL_OK) status = paper->kind->finish(context, paper);
    // Before the stream goes: cairo may still write when it lets go of a surface that failed.
    cairo_surface_destroy(paper->surface);
    sl_free(context, paper->text.items);
    if (paper->stopped) status = sl_fail(context, SL_CANCELLED, "interrupted");
    return sl_output_close(context, &paper->output, status);
}

// --- pages

sl_status sli_page_check_width(sl_context *context, double width) {
    if (width >= SL_DRAW_WIDTH_MIN && width <= SL_DRAW_WIDTH_MAX) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT, "width %g: must be %d to %d", width, SL_DRAW_WIDTH_MIN,
                   SL_DRAW_WIDTH_MAX);
}

sli_page sli_page_of_width(double width) {
    const double whole = round(width), margin = 0.04 * whole;
    return (sli_page){.width = whole,
                      .margin = margin,
                      .inner = whole - 2 * margin,
                      .text = 16.5 * pow(whole / 1200, 0.75)};
}

void sli_page_place_plan(sli_page *page, sl_box bounds, double top, double tallest) {
    const double wide = bounds.max.x - bounds.min.x, high = bounds.max.y - bounds.min.y;
    const double ratio = wide > 0 ? high / wide : high > 0 ? INFINITY : 1;
    const bool to_scale = page->plan_scale > 0;
    const double height =
        to_scale ? high * page->plan_scale : page->inner * fmin(fmax(ratio, 1.0 / 6), tallest);
    page->frame = sl_frame_fit(bounds, page->margin, top, page->inner, height, page->width / 1200);
    if (to_scale) {
        page->frame.scale = page->plan_scale;
        page->frame.width = wide * page->plan_scale;
        page->frame.height = height;
        page->frame.left = page->margin + (page->inner - page->frame.width) / 2;
        page->frame.top = top;
        page->frame.unit = 0.6;
    }
    page->bottom = top + height;
    page->key = page->bottom + 1.1 * page->text;
}

double sli_page_heading(cairo_t *cairo, const sli_page *page, const sl_palette *palette,
                        const char *title, const char *subtitle, bool paint) {
    const double text = page->text;
    double y = page->margin;
    if (title) {
        y += 1.7 * text;
        if (paint)
            sl_text_show_within(cairo, palette->ink, page->margin, y, page->inner, 1.9 * text, true,
                                title);
    }
    if (subtitle) {
        y += 1.7 * text;
        if (paint)
            sl_text_show_within(cairo, palette->faint, page->margin, y, page->inner, text, false,
                                subtitle);
    }
    return title || subtitle ? y + 1.3 * text : y;
}

sl_status sli_page_measure(sl_context *context, const char *path,
                           sl_status (*lay_out)(sl_context *context, cairo_t *cairo, void *what),
                           void *what) {
    cairo_surface_t *scratch = cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1);
    cairo_t *cairo = cairo_create(scratch);
    sl_status status = lay_out(context, cairo, what);
    const cairo_status_t drawn = cairo_status(cairo);
    cairo_destroy(cairo);
    cairo_surface_destroy(scratch);
    if (status == SL_OK && drawn) status = fail_cairo(context, path, drawn);
    return status;
}

void sli_page_set(cairo_t *cairo, const sli_page_parts *parts, sli_page *page, bool paint) {
    parts->set(cairo, parts->what, page, paint);
    if (!parts->scene) return;
    const double top = page->height - 0.5 * page->margin;
    page->height += ceil(sli_draw_over_key(cairo, parts->scene, page, top, paint));
}

typedef struct measured {
    const sli_page_parts *parts;
    sli_page page;
    sli_sheet sheet; ///< `paper` is NULL where the page is none
} measured;

static sl_status lay_out_parts(sl_context *context, cairo_t *cairo, void *what) {
    measured *m = what;
    if (m->sheet.paper) return sli_sheet_lay_out(context, cairo, m->parts, &m->sheet, &m->page);
    sli_page_set(cairo, m->parts, &m->page, false);
    return SL_OK;
}

static sl_status draw_plan(sl_context *context, cairo_t *cairo, const sli_page_parts *parts,
                           const sli_page *page) {
    SL_TRY(parts->draw_plan(context, cairo, parts->what, &page->frame));
    return parts->scene ? sli_draw_over_plan(context, cairo, parts->scene, &page->frame, page->text)
                        : SL_OK;
}

static sl_status draw_page(sl_context *context, cairo_t *cairo, measured *m) {
    const sli_page_parts *parts = m->parts;
    sli_page set = m->page; // drawing may set its height anew
    sli_layer_begin(cairo, "paper");
    const bool white = m->sheet.paper && !parts->scene->palette.dark; // as paper is
    sl_set_colour(cairo, white ? (sl_colour){1, 1, 1} : parts->ground);
    cairo_paint(cairo);
    SL_TRY(draw_plan(context, cairo, parts, &m->page));
    sli_layer_begin(cairo, "legend");
    sli_page_set(cairo, parts, &set, true);
    sli_layer_begin(cairo, "title-block");
    if (m->sheet.paper) sli_sheet_paint(cairo, &m->sheet, &m->page);
    return SL_OK;
}

sl_status sli_page_write(sl_context *context, const sli_page_parts *parts, double width,
                         const sli_paper_kind *kind, const char *path) {
    measured m = {.parts = parts, .page = sli_page_of_width(width)};
    sli_paper paper;
    if (parts->scene && parts->scene->options.sheet.paper)
        SL_TRY(sli_sheet_read(context, parts->scene, parts->title, path, &m.sheet));
    SL_TRY(sli_page_measure(context, path, lay_out_parts, &m));
    SL_TRY(sli_paper_open(context, kind, path, m.page.width, m.page.height, m.sheet.paper != NULL,
                          parts->title, &paper));
    return sli_paper_close(context, &paper, draw_page(context, paper.cairo, &m));
}

/// Without `paint`, a page of the plan alone, with so much free below it.
typedef struct bare {
    sl_scene scene;
    double free;
} bare;

static void set_bare(cairo_t *cairo, const void *what, sli_page *page, bool paint) {
    const bare *b = what;
    (void)cairo;
    if (!paint)
        sli_page_place_plan(page, b->scene.baked->space.bounds, page->margin, SLI_PAGE_TALLEST);
    page->height = page->bottom + b->free;
}

sl_status sl_draw_check_sheet(sl_context *context, const sl_baked *baked,
                              const sl_draw_options *options, const char *path) {
    enum { LINES = 10 }; ///< of a usual key and caption
    bare b = {.free = 0};
    if (!options->sheet.paper) return SL_OK;
    SL_TRY(sli_scene_make(context, baked, options, NULL, &b.scene));
    const sli_page_parts parts = {.set = set_bare, .what = &b, .scene = &b.scene};
    measured m = {.parts = &parts, .page = sli_page_of_width(options->width)};
    sl_status status = sli_sheet_read(context, &b.scene, options->title, path, &m.sheet);
    const double scale = m.sheet.scale;
    if (status == SL_OK) status = sli_page_measure(context, path, lay_out_parts, &m);
    if (status == SL_BAD_ARGUMENT && scale > 0) {
        b.free = LINES * m.page.text; // it does not fit so either, which the message tells
        status = sli_page_measure(context, path, lay_out_parts, &m);
    }
    sli_scene_clear(context, &b.scene);
    return status;
}

/// Onto another page, without a ground of its own.
static sl_status draw_onto(sl_context *context, const sli_page_parts *parts, double width,
                           sli_page_target *target) {
    sli_page page = sli_page_of_width(width);
    sli_page_set(target->cairo, parts, &page, false);
    target->height = page.height;
    if (!target->paint) return SL_OK;
    cairo_save(target->cairo);
    cairo_translate(target->cairo, target->at.x, target->at.y);
    const sl_status status = draw_plan(context, target->cairo, parts, &page);
    sli_page_set(target->cairo, parts, &page, true);
    cairo_restore(target->cairo);
    return status;
}

sl_status sli_page_draw_map(sl_context *context, const sl_baked *baked,
                            const sl_draw_options *options, unsigned layers, sl_scene *scene,
                            sli_page_parts parts, sli_page_target *target) {
    const sli_paper_kind *kind = &kinds[0];
    if (target->path) SL_TRY(sli_paper_kind_of(context, target->path, &kind));
    SL_TRY(sli_page_check_width(context, options->width));
    sl_draw_options plain = *options;
    plain.layers = layers;
    plain.cell = SL_NO_CELL;
    if (plain.sheet.paper) plain.title = NULL; // it stands in the title block
    SL_TRY(sli_scene_make(context, baked, &plain, NULL, scene));
    parts.scene = scene;
    parts.ground = scene->palette.page;
    parts.title = options->title;
    const sl_status status =
        target->path ? sli_page_write(context, &parts, options->width, kind, target->path)
                     : draw_onto(context, &parts, options->width, target);
    sli_scene_clear(context, scene);
    return status;
}

sli_key sli_key_at(sl_point at, double width, double size) {
    return (sli_key){.left = at.x, .width = width, .size = size, .at = at};
}

sl_point sli_key_entry(cairo_t *cairo, sl_colour ink, sli_key *key, const char *text, bool paint) {
    const double size = key->size;
    sl_text_font(cairo, size, false);
    const double wide = 2.55 * size + sl_text_width(cairo, text);
    if (key->at.x > key->left && key->at.x + wide > key->left + key->width)
        key->at = (sl_point){key->left, sli_key_end(key)};
    const sl_point at = key->at;
    if (paint) sl_text_show(cairo, ink, at.x + 2.55 * size, at.y + 1.16 * size, text);
    key->at.x += wide + 1.9 * size;
    return at;
}

double sli_key_end(const sli_key *key) {
    return key->at.y + 1.95 * key->size;
}

double sli_page_caption(cairo_t *cairo, const sli_page *page, const sl_palette *palette, double y,
                        const char *caption, bool paint) {
    if (!caption) return 0;
    sl_text_font(cairo, page->text, false);
    const unsigned lines = sl_text_lines(cairo, page->inner, caption);
    if (paint)
        sl_text_show_lines(cairo, palette->ink, page->margin, y + 1.1 * page->text, page->inner,
                           1.5 * page->text, caption);
    return 1.5 * page->text * lines + 0.1 * page->text;
}

sl_status sl_draw_page_file(sl_context *context, const char *path, int width, int height,
                            const char *title, void (*draw)(void *user, cairo_t *cairo),
                            void *user) {
    const sli_paper_kind *kind = &kinds[0];
    sli_paper paper;
    SL_TRY(sli_paper_kind_of(context, path, &kind));
    SL_TRY(sli_paper_open(context, kind, path, width, height, false, title, &paper));
    draw(user, paper.cairo);
    return sli_paper_close(context, &paper, SL_OK);
}

#include "draw/page.h"

#include "draw/marks.h"
#include "draw/text.h"
#include "sightline/draw.h"

#include <math.h>

sl_status sl_page_check_width(sl_context *context, double width) {
    if (width >= SL_DRAW_WIDTH_MIN && width <= SL_DRAW_WIDTH_MAX) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT, "width %g: must be %d to %d", width, SL_DRAW_WIDTH_MIN,
                   SL_DRAW_WIDTH_MAX);
}

sl_page sl_page_of_width(double width) {
    const double whole = round(width), margin = 0.04 * whole;
    return (sl_page){.width = whole,
                     .margin = margin,
                     .inner = whole - 2 * margin,
                     .text = 16.5 * pow(whole / 1200, 0.75)};
}

void sl_page_place_plan(sl_page *page, sl_box bounds, double top, double tallest) {
    const double wide = bounds.max.x - bounds.min.x, high = bounds.max.y - bounds.min.y;
    const double ratio = wide > 0 ? high / wide : high > 0 ? INFINITY : 1;
    const double height = page->inner * fmin(fmax(ratio, 1.0 / 6), tallest);
    page->frame = sl_frame_fit(bounds, page->margin, top, page->inner, height, page->width / 1200);
    page->bottom = top + height;
    page->key = page->bottom + 1.1 * page->text;
}

double sl_page_heading(cairo_t *cairo, const sl_page *page, const sl_palette *palette,
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

sl_status sl_page_measure(sl_context *context, const char *path,
                          sl_status (*lay_out)(sl_context *context, cairo_t *cairo, void *what),
                          void *what) {
    cairo_surface_t *scratch = cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1);
    cairo_t *cairo = cairo_create(scratch);
    sl_status status = lay_out(context, cairo, what);
    const cairo_status_t drawn = cairo_status(cairo);
    cairo_destroy(cairo);
    cairo_surface_destroy(scratch);
    if (status == SL_OK && drawn) status = sl_fail_cairo(context, path, drawn);
    return status;
}

typedef struct measured {
    const sl_page_parts *parts;
    sl_page page;
} measured;

static sl_status lay_out_parts(sl_context *context, cairo_t *cairo, void *what) {
    (void)context;
    measured *m = what;
    m->parts->set(cairo, m->parts->what, &m->page, false);
    return SL_OK;
}

static sl_status draw(sl_context *context, cairo_t *cairo, const sl_page_parts *parts,
                      sl_page *page) {
    sl_set_colour(cairo, parts->ground);
    cairo_paint(cairo);
    SL_TRY(parts->draw_plan(context, cairo, parts->what, &page->frame));
    parts->set(cairo, parts->what, page, true);
    return SL_OK;
}

sl_status sl_page_write(sl_context *context, const sl_page_parts *parts, double width,
                        const sl_paper_kind *kind, const char *path) {
    measured m = {.parts = parts, .page = sl_page_of_width(width)};
    sl_paper paper;
    SL_TRY(sl_page_measure(context, path, lay_out_parts, &m));
    SL_TRY(sl_paper_open(context, kind, path, (int)m.page.width, (int)m.page.height, parts->title,
                         &paper));
    return sl_paper_close(context, &paper, draw(context, paper.cairo, parts, &m.page));
}

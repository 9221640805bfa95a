/// How a chart is painted: heading, key, axes, marks. Each part can be measured first.
#include "draw/chart.h"
#include "draw/marks.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static sl_colour series_colour(const sl_palette *palette, const sl_chart_series *series) {
    switch (series->colour) {
    case 0:
        return palette->portal; // green
    case 1:
        return palette->start; // vermilion
    case 2:
        return palette->glass; // blue
    case 3:
        return palette->door; // purple
    case 4:
        return palette->source; // orange
    }
    return palette->path; // violet
}

static void line(cairo_t *cairo, double x0, double y0, double x1, double y1) {
    cairo_move_to(cairo, x0, y0);
    cairo_line_to(cairo, x1, y1);
}

// --- heading, key, notes

double sli_chart_heading(cairo_t *cairo, const sli_chart_page *page, bool paint) {
    const sl_chart *chart = page->chart;
    const double width = page->width - 2 * page->margin, size = page->text;
    double y = page->margin;
    if (chart->title) {
        y += 1.9 * size;
        if (paint)
            sl_text_show_within(cairo, page->palette.ink, page->margin, y, width, 1.9 * size, true,
                                chart->title);
        y += 0.45 * size;
    }
    if (chart->subtitle) {
        y += 1.15 * size;
        if (paint)
            sl_text_show_within(cairo, page->palette.faint, page->margin, y, width, size, false,
                                chart->subtitle);
        y += 0.2 * size;
    }
    return y - page->margin;
}

static void draw_disc(cairo_t *cairo, const sl_palette *palette, sl_colour colour, sl_point at,
                      double radius) {
    cairo_new_sub_path(cairo);
    cairo_arc(cairo, at.x, at.y, radius, 0, SLI_FULL_TURN);
    sl_set_colour(cairo, colour);
    cairo_fill_preserve(cairo);
    sli_pen_stroke(cairo, palette->floor[0], 0.28 * radius);
}

static void set_frontier_dash(cairo_t *cairo, double size) {
    const double dashes[2] = {0.42 * size, 0.26 * size};
    cairo_set_dash(cairo, dashes, 2, 0);
}

/// Draws the sign of a series into a box of the key.
static void draw_swatch(cairo_t *cairo, const sli_chart_page *page, const sl_chart_series *series,
                        sl_box box) {
    const double size = page->text, middle = (box.min.y + box.max.y) / 2;
    const sl_palette *palette = &page->palette;
    switch (series->style) {
    case SL_CHART_MARKS:
        draw_disc(cairo, palette, series_colour(palette, series),
                  (sl_point){(box.min.x + box.max.x) / 2, middle}, SLI_CHART_DISC * size);
        return;
    case SL_CHART_LINE:
        line(cairo, box.min.x, middle, box.max.x, middle);
        sli_pen_stroke(cairo, series_colour(palette, series), 0.14 * size);
        return;
    case SL_CHART_FRONTIER_OVER:
    case SL_CHART_FRONTIER_UNDER:
        cairo_rectangle(cairo, box.min.x, box.min.y, box.max.x - box.min.x, middle - box.min.y);
        sl_set_colour(cairo, palette->floor[0]);
        cairo_fill(cairo);
        cairo_rectangle(cairo, box.min.x, middle, box.max.x - box.min.x, box.max.y - middle);
        sl_set_colour(cairo, palette->ground);
        cairo_fill(cairo);
        line(cairo, box.min.x, middle, box.max.x, middle);
        set_frontier_dash(cairo, size);
        sli_pen_stroke(cairo, palette->ink, 0.09 * size);
        cairo_set_dash(cairo, NULL, 0, 0);
        return;
    }
}

/// Fills the path as bands of a colour are filled.
static void fill_band(cairo_t *cairo, sl_colour colour) {
    sli_set_faded(cairo, colour, 0.3);
    cairo_fill(cairo);
}

/// The colour of the first series with a band.
static sl_colour band_colour(const sli_chart_page *page) {
    for (size_t i = 0; i < page->spot_count; i++) {
        const sl_chart_span band = page->spots[i].mark->y_band;
        if (band.low != band.high) return series_colour(&page->palette, page->spots[i].series);
    }
    return page->palette.faint;
}

static void draw_band_swatch(cairo_t *cairo, const sli_chart_page *page, sl_box box) {
    const double half = SLI_CHART_DISC * page->text, x = (box.min.x + box.max.x) / 2;
    cairo_rectangle(cairo, x - half, box.min.y, 2 * half, box.max.y - box.min.y);
    fill_band(cairo, band_colour(page));
}

/// Where the next entry of the key stands; entries flow into lines.
typedef struct flow {
    double x, y;
} flow;

static void add_entry(cairo_t *cairo, const sli_chart_page *page, flow *at,
                      const sl_chart_series *series, const char *name, bool paint) {
    const double size = page->text, swatch = (series && series->style ? 2.0 : 1.2) * size;
    sl_text_font(cairo, size, false);
    const double wide = swatch + 0.5 * size + sl_text_width(cairo, name);
    if (at->x > page->margin && at->x + wide > page->width - page->margin) {
        at->x = page->margin;
        at->y += 1.75 * size;
    }
    if (paint) {
        const sl_box box = {{at->x, at->y + 0.3 * size}, {at->x + swatch, at->y + 1.5 * size}};
        if (series)
            draw_swatch(cairo, page, series, box);
        else
            draw_band_swatch(cairo, page, box);
        const double room = page->width - page->margin - box.max.x - 0.5 * size;
        sl_text_show_within(cairo, page->palette.ink, box.max.x + 0.5 * size, at->y + 1.26 * size,
                            fmax(room, size), size, false, name);
    }
    at->x += wide + 1.7 * size;
}

static bool named_before(const sl_chart *chart, size_t i) {
    for (size_t k = 0; k < i; k++)
        if (chart->series[k].name && strcmp(chart->series[k].name, chart->series[i].name) == 0)
            return true;
    return false;
}

static double draw_note(cairo_t *cairo, const sli_chart_page *page, double y, const char *text,
                        bool paint) {
    const double size = 0.9 * page->text, width = page->width - 2 * page->margin;
    y += 1.4 * size;
    if (paint)
        sl_text_show_within(cairo, page->palette.faint, page->margin, y, width, size, false, text);
    return y;
}

/// Adds to a text, as far as there is room.
static void append(char *text, size_t room, const char *lead, const char *more) {
    const char *const parts[] = {lead, more};
    for (int i = 0; i < 2; i++) {
        const size_t used = strlen(text);
        sli_text_copy(parts[i], strlen(parts[i]), text + used, room - used);
    }
}

/// The chart's notes, and the labels that found no room.
static double draw_notes(cairo_t *cairo, const sli_chart_page *page, double y, bool paint) {
    char shown[1024];
    for (const char *text = page->chart->notes; text && *text;) {
        const size_t length = strcspn(text, "\n");
        sli_text_copy(text, length, shown, sizeof shown);
        y = draw_note(cairo, page, y, shown, paint);
        text += length + (text[length] == '\n');
    }
    shown[0] = '\0';
    for (size_t i = 0; i < page->label_count; i++)
        if (!page->labels[i].placed)
            append(shown, sizeof shown,
                   shown[0] ? ", " : "No room for the labels of: ", page->spots[i].mark->label);
    return shown[0] ? draw_note(cairo, page, y, shown, paint) : y;
}

double sli_chart_key(cairo_t *cairo, const sli_chart_page *page, bool paint) {
    const sl_chart *chart = page->chart;
    flow at = {page->margin, page->key_top};
    for (size_t i = 0; i < chart->series_count; i++)
        if (chart->series[i].name && !named_before(chart, i))
            add_entry(cairo, page, &at, &chart->series[i], chart->series[i].name, paint);
    if (chart->band) add_entry(cairo, page, &at, NULL, chart->band, paint);
    if (at.x > page->margin) at.y += 1.9 * page->text;
    return draw_notes(cairo, page, at.y, paint) - page->key_top;
}

// --- axes

double sli_chart_gutter(cairo_t *cairo, const sli_chart_page *page) {
    double widest = 0;
    sl_text_font(cairo, SLI_CHART_NUMBER * page->text, false);
    for (size_t i = 0; i < page->y_tick_count; i++)
        widest = fmax(widest, sl_text_width(cairo, page->y_ticks[i].text));
    return widest + 0.7 * page->text + (page->chart->y.label ? 1.9 * page->text : 0);
}

#define UP_ARROW   "\xe2\x86\x91 "
#define DOWN_ARROW "\xe2\x86\x93 "

static bool write_words(const sli_chart_page *page, bool over, char *text, size_t room) {
    const char *words = over ? page->chart->y.over : page->chart->y.under;
    if (!words) return false;
    text[0] = '\0';
    append(text, room, over ? UP_ARROW : DOWN_ARROW, words);
    return true;
}

sl_box sli_chart_words(cairo_t *cairo, const sli_chart_page *page, bool over) {
    char text[256];
    if (!write_words(page, over, text, sizeof text)) return (sl_box){0};
    const double size = SLI_CHART_NUMBER * page->text, inset = 0.5 * page->text;
    sl_text_font(cairo, size, false);
    const double width = sl_text_width(cairo, text), left = page->frame.max.x - inset - width;
    const double top = over ? page->frame.min.y + inset : page->frame.max.y - inset - 1.25 * size;
    return (sl_box){{left, top}, {left + width, top + 1.25 * size}};
}

static void draw_words(cairo_t *cairo, const sli_chart_page *page) {
    for (int over = 0; over < 2; over++) {
        char text[256];
        if (!write_words(page, over, text, sizeof text)) continue;
        const sl_box box = sli_chart_words(cairo, page, over);
        sl_text_show(cairo, page->palette.faint, box.min.x,
                     box.max.y - 0.3 * SLI_CHART_NUMBER * page->text, text);
    }
}

static void draw_grid(cairo_t *cairo, const sli_chart_page *page) {
    const sl_box *frame = &page->frame;
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
    for (size_t i = 0; i < page->x_tick_count; i++) {
        const double x = sli_axis_place(&page->x, page->x_ticks[i].value);
        if (!page->x_ticks[i].minor) line(cairo, x, frame->min.y, x, frame->max.y);
    }
    for (size_t i = 0; i < page->y_tick_count; i++) {
        const double y = sli_axis_place(&page->y, page->y_ticks[i].value);
        if (!page->y_ticks[i].minor) line(cairo, frame->min.x, y, frame->max.x, y);
    }
    sli_set_faded(cairo, page->palette.outline, 0.55);
    cairo_set_line_width(cairo, 0.055 * page->text);
    cairo_stroke(cairo);
}

/// Leaves out numbers that would touch the one before.
static void draw_x_numbers(cairo_t *cairo, const sli_chart_page *page) {
    const double size = SLI_CHART_NUMBER * page->text, base = page->frame.max.y + 1.55 * page->text;
    double free_from = 0;
    sl_text_font(cairo, size, false);
    for (size_t i = 0; i < page->x_tick_count; i++) {
        const sli_tick *tick = &page->x_ticks[i];
        const double x = sli_axis_place(&page->x, tick->value);
        const double long_tick = (tick->minor ? 0.25 : 0.45) * page->text;
        line(cairo, x, page->frame.max.y, x, page->frame.max.y + long_tick);
        sli_pen_stroke(cairo, page->palette.faint, 0.07 * page->text);
        const double wide = sl_text_width(cairo, tick->text), left = x - wide / 2;
        if (tick->minor || left < free_from || left + wide > page->width) continue;
        sl_text_show(cairo, page->palette.ink, left, base, tick->text);
        free_from = left + wide + 0.6 * size;
    }
}

static void draw_y_numbers(cairo_t *cairo, const sli_chart_page *page) {
    const double size = SLI_CHART_NUMBER * page->text;
    double free_from = page->frame.max.y + size; // upwards
    for (size_t i = 0; i < page->y_tick_count; i++) {
        const sli_tick *tick = &page->y_ticks[i];
        const bool named = tick->value == 0 && page->chart->y.zero;
        const double y = sli_axis_place(&page->y, tick->value), base = y + 0.36 * size;
        sl_text_font(cairo, size, named);
        if (tick->minor || base > free_from) continue;
        const double left = page->frame.min.x - 0.5 * page->text;
        sl_text_show(cairo, page->palette.ink, left - sl_text_width(cairo, tick->text), base,
                     tick->text);
        free_from = base - 1.15 * size;
    }
}

static void draw_axis_labels(cairo_t *cairo, const sli_chart_page *page) {
    const sl_box *frame = &page->frame;
    const double size = page->text;
    sl_text_font(cairo, size, false);
    if (page->chart->x.label) {
        const double wide = sl_text_width(cairo, page->chart->x.label);
        sl_text_show(cairo, page->palette.faint, (frame->min.x + frame->max.x - wide) / 2,
                     frame->max.y + 3.0 * size, page->chart->x.label);
    }
    if (page->chart->y.label) {
        const double wide = sl_text_width(cairo, page->chart->y.label);
        cairo_save(cairo);
        cairo_translate(cairo, page->margin + 0.9 * size, (frame->min.y + frame->max.y + wide) / 2);
        cairo_rotate(cairo, -3.14159265358979323846 / 2);
        sl_text_show(cairo, page->palette.faint, 0, 0, page->chart->y.label);
        cairo_restore(cairo);
    }
}

// --- what is shown

/// The stairs, from the edge of the frame over (or under) the first mark to its right edge.
static void add_stairs(cairo_t *cairo, const sli_chart_page *page, const sl_chart_series *series) {
    const bool over = series->style == SL_CHART_FRONTIER_OVER;
    double y = over ? page->frame.min.y : page->frame.max.y;
    for (size_t i = 0; i < series->mark_count; i++) {
        const double x = sli_axis_place(&page->x, series->marks[i].x);
        cairo_line_to(cairo, x, y);
        y = sli_axis_place(&page->y, series->marks[i].y);
        cairo_line_to(cairo, x, y);
    }
    cairo_line_to(cairo, page->frame.max.x, y);
}

/// Shades what no mark reaches: from the stairs to 0 (or to the edge of the frame), and all left of
/// them.
static void shade_frontier(cairo_t *cairo, const sli_chart_page *page,
                           const sl_chart_series *series) {
    const sl_box *frame = &page->frame;
    const bool over = series->style == SL_CHART_FRONTIER_OVER;
    const bool log = page->chart->y.scale == SL_CHART_LOG;
    const double zero = log ? frame->max.y : sli_axis_place(&page->y, 0);
    const double base = fmin(fmax(zero, frame->min.y), frame->max.y);
    if (!series->mark_count) return;
    cairo_move_to(cairo, frame->min.x, base);
    cairo_line_to(cairo, frame->min.x, over ? frame->min.y : frame->max.y);
    add_stairs(cairo, page, series);
    cairo_line_to(cairo, frame->max.x, base);
    cairo_close_path(cairo);
    sl_set_colour(cairo, page->palette.ground);
    cairo_fill(cairo);
}

static void draw_frontier(cairo_t *cairo, const sli_chart_page *page,
                          const sl_chart_series *series) {
    if (!series->mark_count) return;
    cairo_new_path(cairo);
    add_stairs(cairo, page, series);
    set_frontier_dash(cairo, page->text);
    sli_pen_stroke(cairo, page->palette.ink, 0.09 * page->text);
    cairo_set_dash(cairo, NULL, 0, 0);
}

static void draw_line(cairo_t *cairo, const sli_chart_page *page, const sl_chart_series *series) {
    cairo_new_path(cairo);
    for (size_t i = 0; i < series->mark_count; i++)
        cairo_line_to(cairo, sli_axis_place(&page->x, series->marks[i].x),
                      sli_axis_place(&page->y, series->marks[i].y));
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    sli_pen_stroke(cairo, series_colour(&page->palette, series), 0.14 * page->text);
}

static void draw_spans(cairo_t *cairo, const sli_chart_page *page, const sli_spot *spot) {
    const sl_chart_mark *m = spot->mark;
    const sl_colour colour = series_colour(&page->palette, spot->series);
    const double half = SLI_CHART_DISC * page->text, cap = 0.5 * half;
    if (m->y_band.low != m->y_band.high) {
        const double y0 = sli_axis_place(&page->y, m->y_band.low);
        const double y1 = sli_axis_place(&page->y, m->y_band.high);
        cairo_rectangle(cairo, spot->at.x - half, fmin(y0, y1), 2 * half, fabs(y1 - y0));
        fill_band(cairo, colour);
    }
    if (m->x_whisker.low != m->x_whisker.high) {
        const double x0 = sli_axis_place(&page->x, m->x_whisker.low);
        const double x1 = sli_axis_place(&page->x, m->x_whisker.high);
        line(cairo, x0, spot->at.y, x1, spot->at.y);
        line(cairo, x0, spot->at.y - cap, x0, spot->at.y + cap);
        line(cairo, x1, spot->at.y - cap, x1, spot->at.y + cap);
    }
    if (m->y_whisker.low != m->y_whisker.high) {
        const double y0 = sli_axis_place(&page->y, m->y_whisker.low);
        const double y1 = sli_axis_place(&page->y, m->y_whisker.high);
        line(cairo, spot->at.x, y0, spot->at.x, y1);
        line(cairo, spot->at.x - cap, y0, spot->at.x + cap, y0);
        line(cairo, spot->at.x - cap, y1, spot->at.x + cap, y1);
    }
    sli_pen_stroke(cairo, colour, 0.1 * page->text);
}

static void draw_label(cairo_t *cairo, const sli_chart_page *page, size_t i) {
    const sli_label *label = &page->labels[i];
    const sl_chart_mark *mark = page->spots[i].mark;
    if (!label->placed) return;
    const double size = SLI_CHART_LABEL * page->text, small = SLI_CHART_NOTE * page->text;
    // Each line is centred, or flush with the side that the mark is on.
    const double lean = label->knee.x <= label->box.min.x + label->height / 2   ? 0
                        : label->knee.x >= label->box.max.x - label->height / 2 ? 1
                                                                                : 0.5;
    double y = label->box.min.y + 0.98 * size;
    sl_text_font(cairo, size, true);
    double free = label->width - sl_text_width(cairo, mark->label);
    sl_text_show(cairo, page->palette.ink, label->box.min.x + lean * free, y, mark->label);
    if (!mark->note || page->bare) return;
    sl_text_font(cairo, small, false);
    y += SLI_CHART_LINE_HEIGHT * small + 0.1 * size;
    free = label->width - sl_text_width(cairo, mark->note);
    sl_text_show(cairo, page->palette.faint, label->box.min.x + lean * free, y, mark->note);
}

static void draw_leaders(cairo_t *cairo, const sli_chart_page *page) {
    for (size_t i = 0; i < page->label_count; i++) {
        const sli_label *label = &page->labels[i];
        if (label->placed)
            line(cairo, label->anchor.x, label->anchor.y, label->knee.x, label->knee.y);
    }
    sli_pen_stroke(cairo, page->palette.faint, 0.06 * page->text);
}

static void draw_frame(cairo_t *cairo, const sli_chart_page *page) {
    const sl_box *frame = &page->frame;
    if (page->chart->y.over && page->chart->y.under) {
        const double zero = sli_axis_place(&page->y, 0);
        line(cairo, frame->min.x, zero, frame->max.x, zero);
        sli_pen_stroke(cairo, page->palette.ink, 0.1 * page->text);
    }
    cairo_rectangle(cairo, frame->min.x, frame->min.y, frame->max.x - frame->min.x,
                    frame->max.y - frame->min.y);
    sli_pen_stroke(cairo, page->palette.outline, 0.08 * page->text);
}

static void draw_series(cairo_t *cairo, const sli_chart_page *page) {
    const sl_chart *chart = page->chart;
    for (size_t i = 0; i < chart->series_count; i++) {
        const sl_chart_series *series = &chart->series[i];
        if (series->style == SL_CHART_LINE)
            draw_line(cairo, page, series);
        else if (series->style != SL_CHART_MARKS)
            draw_frontier(cairo, page, series);
    }
    draw_leaders(cairo, page);
    for (size_t i = 0; i < page->spot_count; i++) draw_spans(cairo, page, &page->spots[i]);
    for (size_t i = 0; i < page->spot_count; i++) {
        const sli_spot *spot = &page->spots[i];
        if (spot->series->style == SL_CHART_MARKS)
            draw_disc(cairo, &page->palette, series_colour(&page->palette, spot->series), spot->at,
                      SLI_CHART_DISC * page->text);
    }
    for (size_t i = 0; i < page->label_count; i++) draw_label(cairo, page, i);
}

void sli_chart_paint(cairo_t *cairo, const sli_chart_page *page) {
    const sl_chart *chart = page->chart;
    const sl_box *frame = &page->frame;
    sl_set_colour(cairo, page->palette.page);
    cairo_paint(cairo);
    sli_chart_heading(cairo, page, true);
    cairo_rectangle(cairo, frame->min.x, frame->min.y, frame->max.x - frame->min.x,
                    frame->max.y - frame->min.y);
    sl_set_colour(cairo, page->palette.floor[0]);
    cairo_fill(cairo);
    for (size_t i = 0; i < chart->series_count; i++)
        if (chart->series[i].style == SL_CHART_FRONTIER_OVER ||
            chart->series[i].style == SL_CHART_FRONTIER_UNDER)
            shade_frontier(cairo, page, &chart->series[i]);
    draw_grid(cairo, page);
    draw_frame(cairo, page);
    draw_words(cairo, page);
    draw_series(cairo, page);
    draw_x_numbers(cairo, page);
    draw_y_numbers(cairo, page);
    draw_axis_labels(cairo, page);
    sli_chart_key(cairo, page, true);
}

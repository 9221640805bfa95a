/// Charts: the check of their values, the axes, and the page.
///
/// An axis reaches a little beyond the values. Its ticks stand at powers of ten, or at 1, 2 and 5
/// times a power of ten. The frame grows in height until all labels find room beside their marks
/// (chart_labels.c). If even the highest frame has no room, labels lose their notes. Labels that
/// still find no room are listed below the chart.
#include "draw/chart.h"
#include "draw/page.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- axes

#define MICRO "\xc2\xb5"

/// How long the linear part of a symmetric logarithm is, to either side, in decades.
#define LINEAR_PART 0.5

static double scaled(sl_chart_scale scale, double value) {
    switch (scale) {
    case SL_CHART_LOG:
        return log10(value);
    case SL_CHART_SYMLOG:
        return fabs(value) < 1 ? LINEAR_PART * value
                               : copysign(LINEAR_PART + log10(fabs(value)), value);
    case SL_CHART_LINEAR:
        break;
    }
    return value;
}

/// The least length of an axis: a decade, so that it has ticks; or what doubles can tell apart.
static double least_length(sl_chart_scale scale, double low, double high) {
    const double most = fmax(fabs(low), fabs(high));
    if (scale == SL_CHART_SYMLOG && most <= LINEAR_PART) return LINEAR_PART; // 0 is there
    if (scale != SL_CHART_LINEAR) return 1;
    return most > 0 ? 1e-6 * most : 1;
}

sli_axis sli_axis_fit(const sl_chart_axis *what, double least, double most) {
    double low = scaled(what->scale, least), high = scaled(what->scale, most);
    if (what->over && what->under) {
        high = fmax(fabs(low), fabs(high));
        // Up to 10 at least: a chart whose values are all 0 shows how far off they could have been.
        if (what->scale == SL_CHART_SYMLOG) high = fmax(high, LINEAR_PART + 1);
        if (!(high > 0)) high = 1;
        low = -high;
    }
    const double missing = least_length(what->scale, low, high) - (high - low);
    if (missing > 0) {
        low -= missing / 2;
        high += missing / 2;
    }
    const double around = 0.06 * (high - low);
    return (sli_axis){.what = what, .low = low - around, .high = high + around, .to = 1};
}

double sli_axis_place(const sli_axis *axis, double value) {
    const double share = (scaled(axis->what->scale, value) - axis->low) / (axis->high - axis->low);
    return axis->from + (axis->to - axis->from) * share;
}

// --- ticks

/// `digits` times ten to `power`, as the nearest double.
static double decimal(long long digits, int power) {
    char text[48];
    double value = 0;
    const int length = snprintf(text, sizeof text, "%llde%d", digits, power);
    sl_number_read(text, (size_t)length, &value);
    return value;
}

static void write_number(long long digits, int power, const char *unit, char *text) {
    char number[SL_COUNT_TEXT];
    const double value = decimal(digits, power);
    if (fabs(value) < 1e6 && value == trunc(value)) {
        sl_text_count((uint64_t)fabs(value), "", number);
        snprintf(text, SL_COUNT_TEXT, "%s%.*s%s", value < 0 ? "-" : "", SL_COUNT_TEXT - 8, number,
                 unit);
        return;
    }
    char plain[SL_NUMBER_TEXT];
    if (llabs(digits) < 10 && (power >= 6 || power < -4))
        snprintf(plain, sizeof plain, "%llde%d", digits, power);
    else
        sl_number_write(value, plain);
    snprintf(text, SL_COUNT_TEXT, "%s%s", plain, unit);
}

/// In the unit that suits a power of ten.
static void write_seconds(long long digits, int power, int unit_power, char *text) {
    static const char *const units[] = {" s", " ms", " " MICRO "s", " ns"};
    int unit = 0;
    while (unit < 3 && unit_power < -3 * unit) unit++;
    write_number(digits, power + 3 * unit, digits ? units[unit] : "", text);
}

static void write_tick(const sli_axis *axis, long long digits, int power, int unit_power,
                       char *text) {
    const bool plain = axis->what->over && axis->what->under && digits < 0;
    if (digits == 0 && axis->what->zero)
        sli_text_copy(axis->what->zero, strlen(axis->what->zero), text, SL_COUNT_TEXT);
    else if (axis->what->seconds)
        write_seconds(plain ? -digits : digits, power, unit_power, text);
    else
        write_number(plain ? -digits : digits, power, "", text);
}

typedef struct tick_list {
    const sli_axis *axis;
    sli_tick *items;
    size_t count;
} tick_list;

static void add_tick(tick_list *list, long long digits, int power, int unit_power, bool minor) {
    const sli_axis *axis = list->axis;
    const double value = decimal(digits, power), at = scaled(axis->what->scale, value);
    if (!(at >= axis->low && at <= axis->high) || list->count == SLI_TICKS_MOST) return;
    sli_tick *tick = &list->items[list->count++];
    *tick = (sli_tick){.value = value, .minor = minor};
    if (!minor) write_tick(axis, digits, power, unit_power, tick->text);
}

/// Adds every decade that fits, or every second or third; on short axes also 2 and 5 between them.
static void add_decades(tick_list *list, double low, double high, int sign) {
    const int first = (int)floor(low), last = (int)ceil(high), step = 1 + (last - first) / 11;
    const bool few = high - low < 2.5, fine = step == 1 && last - first <= 10;
    for (int n = 0; n <= last - first; n++) {
        const int power = sign > 0 ? first + n : last - n;
        for (int m = 1; m <= 9; m++) {
            const int digit = sign > 0 ? m : 10 - m;
            const bool major = digit == 1 ? power % step == 0 : few && (digit == 2 || digit == 5);
            if (major || fine) add_tick(list, sign * digit, power, power, !major);
        }
    }
}

static void add_symlog(tick_list *list) {
    const sli_axis *axis = list->axis;
    if (axis->low < -LINEAR_PART)
        add_decades(list, fmax(-axis->high - LINEAR_PART, 0), -axis->low - LINEAR_PART, -1);
    add_tick(list, 0, 0, 0, false);
    if (axis->high > LINEAR_PART)
        add_decades(list, fmax(axis->low - LINEAR_PART, 0), axis->high - LINEAR_PART, 1);
}

/// At 1, 2 or 5 times a power of ten: about six of them.
static void add_linear(tick_list *list) {
    const sli_axis *axis = list->axis;
    const double wanted = (axis->high - axis->low) / 6;
    const int power = (int)floor(log10(wanted));
    const double most = fmax(fabs(axis->low), fabs(axis->high));
    const int unit_power = most > 0 ? (int)floor(log10(most)) : 0;
    static const int leads[] = {1, 2, 5, 10};
    int i = 0;
    while (i < 3 && leads[i] * pow(10, power) < wanted) i++;
    const double step = leads[i] * pow(10, power);
    const long long last = (long long)floor(axis->high / step);
    for (long long n = (long long)ceil(axis->low / step); n <= last; n++)
        add_tick(list, n * leads[i], power, unit_power, false);
}

size_t sli_axis_ticks(const sli_axis *axis, sli_tick ticks[SLI_TICKS_MOST]) {
    tick_list list = {.axis = axis, .items = ticks};
    switch (axis->what->scale) {
    case SL_CHART_LOG:
        add_decades(&list, axis->low, axis->high, 1);
        break;
    case SL_CHART_SYMLOG:
        add_symlog(&list);
        break;
    case SL_CHART_LINEAR:
        add_linear(&list);
        break;
    }
    return list.count;
}

#define LARGEST 1e300

static bool is_frontier(const sl_chart_series *series) {
    return series->style == SL_CHART_FRONTIER_OVER || series->style == SL_CHART_FRONTIER_UNDER;
}

// --- what is refused

static sl_status check_value(sl_context *context, const sl_chart_axis *axis, double value) {
    if (!(fabs(value) <= LARGEST))
        return sl_fail(context, SL_BAD_ARGUMENT, "a chart's value is %g: at most %g is drawn",
                       value, LARGEST);
    if (axis->scale == SL_CHART_LOG && !(value > 0))
        return sl_fail(context, SL_BAD_ARGUMENT, "a chart's value is %g on a logarithmic axis",
                       value);
    return SL_OK;
}

static sl_status check_span(sl_context *context, const sl_chart_axis *axis, sl_chart_span span) {
    if (span.low == span.high) return SL_OK;
    SL_TRY(check_value(context, axis, span.low));
    return check_value(context, axis, span.high);
}

static sl_status check_mark(sl_context *context, const sl_chart *chart, const sl_chart_mark *mark) {
    SL_TRY(check_value(context, &chart->x, mark->x));
    SL_TRY(check_value(context, &chart->y, mark->y));
    SL_TRY(check_span(context, &chart->x, mark->x_whisker));
    SL_TRY(check_span(context, &chart->y, mark->y_whisker));
    return check_span(context, &chart->y, mark->y_band);
}

static sl_status check_chart(sl_context *context, const sl_chart *chart) {
    SL_TRY(sli_page_check_width(context, chart->width));
    for (size_t i = 0; i < chart->series_count; i++) {
        const sl_chart_series *series = &chart->series[i];
        if (series->colour >= SL_CHART_COLOURS)
            return sl_fail(context, SL_BAD_ARGUMENT, "colour %u: a chart has %d", series->colour,
                           SL_CHART_COLOURS);
        for (size_t k = 0; k < series->mark_count; k++)
            SL_TRY(check_mark(context, chart, &series->marks[k]));
    }
    return SL_OK;
}

// --- fitting the axes

typedef struct extent {
    double least, most;
} extent;

static void take(extent *e, double value) {
    e->least = fmin(e->least, value);
    e->most = fmax(e->most, value);
}

static void take_span(extent *e, sl_chart_span span) {
    if (span.low == span.high) return;
    take(e, span.low);
    take(e, span.high);
}

/// An axis without values has a range all the same.
static sli_axis fit(const sl_chart_axis *axis, const extent *e) {
    if (e->least <= e->most) return sli_axis_fit(axis, e->least, e->most);
    return sli_axis_fit(axis, axis->scale == SL_CHART_LOG ? 1 : 0, 1);
}

static void fit_axes(sli_chart_page *page) {
    const sl_chart *chart = page->chart;
    extent x = {INFINITY, -INFINITY}, y = x;
    for (size_t i = 0; i < chart->series_count; i++) {
        for (size_t k = 0; k < chart->series[i].mark_count; k++) {
            const sl_chart_mark *mark = &chart->series[i].marks[k];
            take(&x, mark->x);
            take_span(&x, mark->x_whisker);
            take(&y, mark->y);
            take_span(&y, mark->y_whisker);
            take_span(&y, mark->y_band);
        }
    }
    page->x = fit(&chart->x, &x);
    page->y = fit(&chart->y, &y);
    page->x_tick_count = sli_axis_ticks(&page->x, page->x_ticks);
    page->y_tick_count = sli_axis_ticks(&page->y, page->y_ticks);
}

// --- the marks

/// Orders marks by x: labels find room best in this order.
static int compare_spots(const void *left, const void *right) {
    const sli_spot *a = left, *b = right;
    if (a->mark->x != b->mark->x) return a->mark->x < b->mark->x ? -1 : 1;
    if (a->mark->y != b->mark->y) return a->mark->y < b->mark->y ? -1 : 1;
    return a->mark < b->mark ? -1 : a->mark > b->mark;
}

static void gather_spots(sli_chart_page *page, bool labelled) {
    const sl_chart *chart = page->chart;
    for (size_t i = 0; i < chart->series_count; i++) {
        const sl_chart_series *series = &chart->series[i];
        for (size_t k = 0; k < series->mark_count && !is_frontier(series); k++)
            if ((series->marks[k].label != NULL) == labelled)
                page->spots[page->spot_count++] = (sli_spot){&series->marks[k], series, {0, 0}};
    }
}

static sl_status make_spots(sl_context *context, sli_chart_page *page) {
    size_t most = 0;
    for (size_t i = 0; i < page->chart->series_count; i++)
        most += page->chart->series[i].mark_count;
    page->spots = sl_alloc_array(context, most, sizeof *page->spots);
    if (!page->spots) return SL_NO_MEMORY;
    gather_spots(page, true);
    page->label_count = page->spot_count;
    qsort(page->spots, page->label_count, sizeof *page->spots, compare_spots);
    gather_spots(page, false);
    page->labels = sl_alloc_array(context, page->label_count, sizeof *page->labels);
    return page->labels ? SL_OK : SL_NO_MEMORY;
}

static void measure_labels(cairo_t *cairo, sli_chart_page *page) {
    const double size = SLI_CHART_LABEL * page->text, small = SLI_CHART_NOTE * page->text;
    for (size_t i = 0; i < page->label_count; i++) {
        const sl_chart_mark *mark = page->spots[i].mark;
        sli_label *label = &page->labels[i];
        sl_text_font(cairo, size, true);
        label->width = sl_text_width(cairo, mark->label);
        label->height = SLI_CHART_LINE_HEIGHT * size;
        if (!mark->note || page->bare) continue;
        sl_text_font(cairo, small, false);
        label->width = fmax(label->width, sl_text_width(cairo, mark->note));
        label->height += SLI_CHART_LINE_HEIGHT * small;
    }
}

// --- the page

typedef SL_ARRAY(sli_obstacle) obstacles;

static sl_status keep_off(sl_context *context, obstacles *list, sli_obstacle obstacle) {
    SL_TRY(SL_ARRAY_ROOM(context, list, 1));
    list->items[list->count++] = obstacle;
    return SL_OK;
}

static sl_box box_around(double x0, double y0, double x1, double y1, double by) {
    return (sl_box){{fmin(x0, x1) - by, fmin(y0, y1) - by}, {fmax(x0, x1) + by, fmax(y0, y1) + by}};
}

static sl_status keep_off_spot(sl_context *context, const sli_chart_page *page, size_t i,
                               obstacles *list) {
    const sli_spot *spot = &page->spots[i];
    const sl_chart_mark *m = spot->mark;
    const double disc = SLI_CHART_DISC * page->text, thin = disc / 4;
    const sl_point at = spot->at;
    const size_t owner = i < page->label_count ? i : SIZE_MAX;
    const double x0 = sli_axis_place(&page->x, m->x_whisker.low);
    const double x1 = sli_axis_place(&page->x, m->x_whisker.high);
    const double y0 = sli_axis_place(&page->y, m->y_whisker.low);
    const double y1 = sli_axis_place(&page->y, m->y_whisker.high);
    SL_TRY(keep_off(context, list,
                    (sli_obstacle){box_around(at.x, at.y, at.x, at.y, disc), owner, false}));
    if (m->x_whisker.low != m->x_whisker.high)
        SL_TRY(keep_off(context, list,
                        (sli_obstacle){box_around(x0, at.y, x1, at.y, thin), owner, true}));
    if (m->y_whisker.low != m->y_whisker.high)
        SL_TRY(keep_off(context, list,
                        (sli_obstacle){box_around(at.x, y0, at.x, y1, thin), owner, true}));
    if (m->y_band.low == m->y_band.high) return SL_OK;
    const double b0 = sli_axis_place(&page->y, m->y_band.low);
    const double b1 = sli_axis_place(&page->y, m->y_band.high);
    return keep_off(context, list,
                    (sli_obstacle){box_around(at.x, b0, at.x, b1, disc), owner, true});
}

static sl_status keep_off_frontier(sl_context *context, const sli_chart_page *page,
                                   const sl_chart_series *series, obstacles *list) {
    const double thin = 0.15 * page->text;
    double y = series->style == SL_CHART_FRONTIER_OVER ? page->frame.min.y : page->frame.max.y;
    for (size_t i = 0; i < series->mark_count; i++) {
        const double x = sli_axis_place(&page->x, series->marks[i].x);
        const double next = sli_axis_place(&page->y, series->marks[i].y);
        const double end = i + 1 < series->mark_count
                               ? sli_axis_place(&page->x, series->marks[i + 1].x)
                               : page->frame.max.x;
        SL_TRY(keep_off(context, list,
                        (sli_obstacle){box_around(x, y, x, next, thin), SIZE_MAX, true}));
        SL_TRY(keep_off(context, list,
                        (sli_obstacle){box_around(x, next, end, next, thin), SIZE_MAX, true}));
        y = next;
    }
    return SL_OK;
}

static sl_status gather_obstacles(sl_context *context, cairo_t *cairo, const sli_chart_page *page,
                                  obstacles *list) {
    const sl_chart *chart = page->chart;
    for (size_t i = 0; i < page->spot_count; i++) SL_TRY(keep_off_spot(context, page, i, list));
    for (size_t i = 0; i < chart->series_count; i++)
        if (is_frontier(&chart->series[i]))
            SL_TRY(keep_off_frontier(context, page, &chart->series[i], list));
    for (int over = 0; over < 2; over++) {
        const sl_box words = sli_chart_words(cairo, page, over);
        if (words.max.y > words.min.y)
            SL_TRY(keep_off(context, list, (sli_obstacle){words, SIZE_MAX, false}));
    }
    if (!(chart->y.over && chart->y.under)) return SL_OK;
    const double zero = sli_axis_place(&page->y, 0), thin = 0.15 * page->text;
    return keep_off(
        context, list,
        (sli_obstacle){box_around(page->frame.min.x, zero, page->frame.max.x, zero, thin), SIZE_MAX,
                       true});
}

static void set_frame(sli_chart_page *page, double left, double top, double height) {
    page->frame = (sl_box){{left, top}, {page->width - page->margin, top + height}};
    page->x.from = page->frame.min.x;
    page->x.to = page->frame.max.x;
    page->y.from = page->frame.max.y;
    page->y.to = page->frame.min.y;
    for (size_t i = 0; i < page->spot_count; i++) {
        sli_spot *spot = &page->spots[i];
        spot->at.x = sli_axis_place(&page->x, spot->mark->x);
        spot->at.y = sli_axis_place(&page->y, spot->mark->y);
        if (i < page->label_count) page->labels[i].anchor = spot->at;
    }
}

static bool place_labels(const sli_chart_page *page, const obstacles *list) {
    const sl_box f = page->frame;
    const double gap = 0.3 * page->text;
    const sli_label_room room = {
        .frame = {{f.min.x + gap, f.min.y + gap}, {f.max.x - gap, f.max.y - gap}},
        .obstacles = list->items,
        .obstacle_count = list->count,
        .gap = gap,
        .clearance = SLI_CHART_DISC * page->text + 1.1 * gap,
    };
    return sli_labels_place(page->labels, page->label_count, &room);
}

/// Tries a frame of that height: do all labels find room?
static sl_status try_frame(sl_context *context, cairo_t *cairo, sli_chart_page *page, double top,
                           double height, bool *fits) {
    obstacles list = {0};
    set_frame(page, page->margin + sli_chart_gutter(cairo, page), top, height);
    measure_labels(cairo, page);
    const sl_status status = gather_obstacles(context, cairo, page, &list);
    if (status == SL_OK) *fits = place_labels(page, &list);
    sl_free(context, list.items);
    return status;
}

/// The frame grows until all labels find room.
static sl_status grow_frame(sl_context *context, cairo_t *cairo, sli_chart_page *page, double top,
                            bool *fits) {
    const double inner = page->width - 2 * page->margin - sli_chart_gutter(cairo, page);
    *fits = false;
    for (double height = 0.48 * inner; !*fits && height < page->width; height *= 1.2) {
        SL_TRY(try_frame(context, cairo, page, top, height, fits));
        SL_TRY(sl_check_cancelled(context));
    }
    return SL_OK;
}

/// If even the highest frame has no room, labels lose their notes. Those that still find no room
/// are left out.
static sl_status lay_out_frame(sl_context *context, cairo_t *cairo, sli_chart_page *page,
                               double top) {
    bool fits;
    SL_TRY(grow_frame(context, cairo, page, top, &fits));
    page->bare = !fits;
    return fits ? SL_OK : grow_frame(context, cairo, page, top, &fits);
}

/// Puts the heading on the page; gives the top of the frame.
static sl_status begin_page(sl_context *context, cairo_t *cairo, sli_chart_page *page,
                            double *top) {
    page->palette = sl_palette_make(page->chart->dark);
    fit_axes(page);
    SL_TRY(make_spots(context, page));
    *top = page->margin + sli_chart_heading(cairo, page, false);
    if (*top > page->margin) *top += 0.5 * page->margin;
    return SL_OK;
}

/// The height between the frame and the key.
static double below_frame(const sli_chart_page *page) {
    return (page->chart->x.label ? 3.6 : 2.1) * page->text;
}

static sl_status lay_out(sl_context *context, cairo_t *cairo, void *what) {
    sli_chart_page *page = what;
    const sli_page blank = sli_page_of_width(page->chart->width);
    double top;
    page->width = blank.width;
    page->margin = blank.margin;
    page->text = blank.text;
    SL_TRY(begin_page(context, cairo, page, &top));
    SL_TRY(lay_out_frame(context, cairo, page, top));
    const double y = page->frame.max.y + below_frame(page);
    page->key_top = y;
    page->height = ceil(y + sli_chart_key(cairo, page, false) + 0.8 * page->margin);
    return SL_OK;
}

static sl_status draw(sl_context *context, const sli_chart_page *page, const sli_paper_kind *kind,
                      const char *path) {
    sli_paper paper;
    SL_TRY(sli_paper_open(context, kind, path, page->width, page->height, false, page->chart->title,
                          &paper));
    sli_chart_paint(paper.cairo, page);
    return sli_paper_close(context, &paper, sl_check_cancelled(context));
}

sl_status sl_draw_chart_file(sl_context *context, const sl_chart *chart, const char *path) {
    const sli_paper_kind *kind;
    SL_TRY(sli_paper_kind_of(context, path, &kind));
    SL_TRY(check_chart(context, chart));
    sli_chart_page *page = sl_alloc_array(context, 1, sizeof *page);
    if (!page) return SL_NO_MEMORY;
    page->chart = chart;
    sl_status status = sli_page_measure(context, path, lay_out, page);
    if (status == SL_OK) status = draw(context, page, kind, path);
    sl_free(context, page->spots);
    sl_free(context, page->labels);
    sl_free(context, page);
    return status;
}

static sl_status lay_out_within(sl_context *context, cairo_t *cairo, sli_chart_page *page) {
    double top;
    bool fits;
    SL_TRY(begin_page(context, cairo, page, &top));
    const double key = sli_chart_key(cairo, page, false), below = below_frame(page);
    const double height = fmax(page->height - top - below - key - 0.5 * page->margin, page->text);
    SL_TRY(try_frame(context, cairo, page, top, height, &fits));
    page->key_top = top + height + below;
    page->bare = !fits;
    return fits ? SL_OK : try_frame(context, cairo, page, top, height, &fits);
}

sl_status sl_draw_chart_onto(sl_context *context, cairo_t *cairo, const sl_chart *chart, sl_box box,
                             double text) {
    SL_TRY(check_chart(context, chart));
    sli_chart_page *page = sl_alloc_array(context, 1, sizeof *page);
    if (!page) return SL_NO_MEMORY;
    page->chart = chart;
    page->width = box.max.x - box.min.x;
    page->height = box.max.y - box.min.y;
    page->text = text;
    page->margin = text;
    cairo_save(cairo);
    cairo_rectangle(cairo, box.min.x, box.min.y, page->width, page->height);
    cairo_clip(cairo);
    cairo_translate(cairo, box.min.x, box.min.y);
    const sl_status status = lay_out_within(context, cairo, page);
    if (status == SL_OK) sli_chart_paint(cairo, page);
    cairo_restore(cairo);
    sl_free(context, page->spots);
    sl_free(context, page->labels);
    sl_free(context, page);
    return status;
}

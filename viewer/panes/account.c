/// The account: what each culling method keeps of the view, and what that costs. The chart is drawn
/// again a few times a second, so that one can read it while times change.
#include "panes/account.h"

#include "panes/panes.h"
#include "sightline/draw.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MARKS_MOST = SEEN_MOST + 1, TEXT = 96 };

/// A chart and what its pointers lead to.
typedef struct account {
    sl_chart_mark marks[MARKS_MOST];
    char labels[MARKS_MOST][64], notes[MARKS_MOST][TEXT];
    sl_chart_series series[2];
    char title[TEXT];
    sl_chart chart;
} account;

/// Scripts count tests in place of time, so that pictures are the same each time.
static double cost_of(const ui_state *ui, double seconds, uint64_t tests) {
    return ui->steady ? fmax((double)tests, 1) : fmax(seconds, 1e-8);
}

static void write_cost(const ui_state *ui, double cost, char text[32]) {
    if (ui->steady)
        snprintf(text, 32, "%.0f test%s", cost, cost == 1 ? "" : "s");
    else if (cost < 1e-3)
        snprintf(text, 32, "%.3g \xc2\xb5s", 1e6 * cost);
    else
        snprintf(text, 32, "%.3g ms", 1e3 * cost);
}

static void add_mark(account *a, size_t i, double cost, double share) {
    a->marks[i] =
        (sl_chart_mark){.x = cost, .y = 100 * share, .label = a->labels[i], .note = a->notes[i]};
}

/// Adds the marks of the methods that could answer, from loose to exact. Returns their number.
static size_t add_methods(const view_state *view, account *a) {
    size_t count, marks = 0;
    const sl_eye_method *methods = sl_eye_methods(&count);
    for (size_t i = 0; i < count && i < SEEN_MOST; i++) {
        const seen_method *m = &view->seen.methods[i];
        if (!m->known) continue;
        char cost[32];
        const double spent = cost_of(view->ui, m->seconds, m->account.orientations);
        const double share = view->document->area > 0 ? m->area / view->document->area : 0;
        write_cost(view->ui, spent, cost);
        snprintf(a->labels[marks], sizeof a->labels[marks], "%s", methods[i].name);
        ui_spaces(a->labels[marks]);
        snprintf(a->notes[marks], TEXT, "%u cells, %.1f %% in %s", m->count, 100 * share, cost);
        add_mark(a, marks++, spent, share);
    }
    return marks;
}

static void add_region(const view_state *view, account *a, size_t i) {
    char cost[32];
    const double spent =
        cost_of(view->ui, view->seen.region_seconds, view->seen.region.portals_passed);
    const double share =
        view->document->area > 0 ? view->seen.region_area / view->document->area : 0;
    write_cost(view->ui, spent, cost);
    snprintf(a->labels[i], sizeof a->labels[i], "visible region");
    snprintf(a->notes[i], TEXT, "%.1f %% in %s", 100 * share, cost);
    add_mark(a, i, spent, share);
}

/// The axis is logarithmic, since methods differ by factors; it is not where an area is 0.
static sl_chart_scale area_scale(const account *a, size_t marks) {
    for (size_t i = 0; i < marks; i++)
        if (!(a->marks[i].y > 0)) return SL_CHART_LINEAR;
    return SL_CHART_LOG;
}

/// Where there is little room the title is a line of plain size.
static void make_chart(const view_state *view, account *a, bool small) {
    const size_t methods = view->seen.valid ? add_methods(view, a) : 0;
    if (view->seen.valid) add_region(view, a, methods);
    const size_t marks = view->seen.valid ? methods + 1 : 0;
    a->series[0] = (sl_chart_series){.name = "cells kept by culling",
                                     .style = SL_CHART_MARKS,
                                     .colour = 0,
                                     .marks = a->marks,
                                     .mark_count = methods};
    a->series[1] = (sl_chart_series){.name = "what is visible of them",
                                     .style = SL_CHART_MARKS,
                                     .colour = 1,
                                     .marks = a->marks + methods,
                                     .mark_count = marks - methods};
    char cell[32];
    snprintf(cell, sizeof cell, "cell %u", view->seen.cell);
    snprintf(a->title, sizeof a->title, "What accuracy costs here: %s, cone of %.0f\xc2\xb0",
             view->seen.cell == SL_NO_CELL ? "no cell" : cell, view->eye.fov);
    a->chart = (sl_chart){
        .title = small ? NULL : a->title,
        .subtitle = small ? a->title : NULL,
        .x = {.label = view->ui->steady ? "tests" : "time of a query",
              .scale = SL_CHART_LOG,
              .seconds = !view->ui->steady},
        .y = {.label = "% of the area", .scale = area_scale(a, marks)},
        .series = a->series,
        .series_count = 2,
        .width = sl_draw_options_default().width,
        .dark = view->ui->dark,
    };
}

/// Draws the chart into a box of the page.
static void draw_chart(view_state *view, cairo_t *cairo, sl_box box) {
    account a;
    make_chart(view, &a, true);
    view_check(view,
               sl_draw_chart_onto(view->context, cairo, &a.chart, box, 0.92 * view->ui->text));
}

sl_status account_save(view_state *view, const char *path) {
    account a;
    make_chart(view, &a, false);
    return sl_draw_chart_file(view->context, &a.chart, path);
}

// --- the pane

#define SECONDS_BETWEEN 0.25

static bool is_stale(const view_state *view, const account_picture *kept, int width, int height) {
    if (!kept->surface || view->ui->steady || kept->version != view->document->version ||
        kept->dark != view->ui->dark || kept->text != view->ui->text ||
        cairo_image_surface_get_width(kept->surface) != width ||
        cairo_image_surface_get_height(kept->surface) != height)
        return true;
    return sl_seconds() - kept->made > SECONDS_BETWEEN;
}

static void remake_picture(view_state *view, account_picture *kept, int width, int height) {
    if (kept->surface) cairo_surface_destroy(kept->surface);
    kept->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    kept->version = view->document->version;
    kept->dark = view->ui->dark;
    kept->text = view->ui->text;
    kept->made = sl_seconds();
    cairo_t *cairo = cairo_create(kept->surface);
    draw_chart(view, cairo, (sl_box){{0, 0}, {width, height}});
    cairo_destroy(cairo);
}

void pane_account(learn_state *learn, sl_box box) {
    view_state *view = learn->view;
    ui_state *ui = view->ui;
    const int width = (int)ceil(box_width(box)), height = (int)ceil(box_height(box));
    ui_hit(ui, HIT_PANEL, 0, box);
    if (is_stale(view, &view->account, width, height))
        remake_picture(view, &view->account, width, height);
    cairo_save(ui->cairo);
    cairo_rectangle(ui->cairo, box.min.x, box.min.y, box_width(box), box_height(box));
    cairo_clip(ui->cairo);
    cairo_set_source_surface(ui->cairo, view->account.surface, box.min.x, box.min.y);
    cairo_paint(ui->cairo);
    cairo_restore(ui->cairo);
    ui_line(ui, box.min.x, box.min.y + 0.5, box.max.x, box.min.y + 0.5, ui->palette.outline);
}

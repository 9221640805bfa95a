#include "walk_report.h"

#include "sightline/draw.h"
#include "sightline/support.h"

#include <string.h>

/// The share of node visibility tests that a walk saves beside the classical method with the same
/// test, the same speed and the same way; 0 where there is no such row, or none to save.
static double saving(const sl_walk_rows *rows, size_t row) {
    const sl_walk_row *r = &rows->items[row];
    const sl_walk_method *classical = sl_walk_methods(&(size_t){0});
    for (size_t i = 0; i < rows->count && r->choice.method; i++) {
        const sl_walk_row *c = &rows->items[i];
        if (c->choice.method == classical && c->speed == r->speed &&
            c->choice.options.test == r->choice.options.test && c->means[SL_FIGURE_TESTS] > 0)
            return 1 - r->means[SL_FIGURE_TESTS] / c->means[SL_FIGURE_TESTS];
    }
    return 0;
}

void sl_walk_print(const sl_walk_rows *rows) {
    printf("%-20s %-9s %6s %6s %6s %6s %6s %6s %6s %8s %8s %8s\n", "method", "test", "tests",
           "saved", "cone", "prop.", "skip", "cells", "walls", "see \xc2\xb5s", "draw \xc2\xb5s",
           "frame \xc2\xb5s");
    for (size_t i = 0; i < rows->count; i++) {
        const sl_walk_row *r = &rows->items[i];
        const double *m = r->means;
        printf("%-20s %-9s ", sl_walk_choice_name(&r->choice), sl_walk_choice_test(&r->choice));
        if (r->choice.method)
            printf("%6.1f %5.1f%% %6.1f %6.2f %6.1f", m[SL_FIGURE_TESTS], 100 * saving(rows, i),
                   m[SL_FIGURE_FRUSTUM_TESTS], m[SL_FIGURE_PROPAGATED],
                   m[SL_FIGURE_SKIPPED] + m[SL_FIGURE_BOUNDED]);
        else
            printf("%6s %6s %6s %6s %6s", "-", "-", "-", "-", "-");
        printf(" %6.1f %6.1f %7.2f %7.2f %7.2f\n", m[SL_FIGURE_CELLS], m[SL_FIGURE_WALLS],
               1e6 * m[SL_FIGURE_VISIBILITY], 1e6 * m[SL_FIGURE_DRAWING], 1e6 * m[SL_FIGURE_FRAME]);
    }
}

// --- CSV

static void put_number(FILE *out, double value, char end) {
    char text[SL_NUMBER_TEXT];
    sl_number_write(value, text);
    fprintf(out, "%s%c", text, end);
}

static void put_choice(FILE *out, const sl_walk_row *r) {
    fprintf(out, "%s,%s,", sl_walk_choice_name(&r->choice), sl_walk_choice_test(&r->choice));
}

static void put_figures(FILE *out, const double figures[SL_FIGURES]) {
    for (int f = 0; f < SL_FIGURES; f++)
        put_number(out, figures[f], f + 1 < SL_FIGURES ? ',' : '\n');
}

static void put_figure_names(FILE *out) {
    for (int f = 0; f < SL_FIGURES; f++)
        fprintf(out, "%s%c", sl_walk_figure_name((sl_walk_figure)f),
                f + 1 < SL_FIGURES ? ',' : '\n');
}

sl_status sl_walk_write_rows(sl_context *context, const sl_walk_rows *rows, const char *path) {
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    fputs("method,test,p_vp,p_skip,speed,steps,saved,", output.stream);
    put_figure_names(output.stream);
    for (size_t i = 0; i < rows->count; i++) {
        const sl_walk_row *r = &rows->items[i];
        put_choice(output.stream, r);
        put_number(output.stream, r->choice.options.p_vp, ',');
        put_number(output.stream, r->choice.options.p_skip, ',');
        put_number(output.stream, r->speed, ',');
        fprintf(output.stream, "%zu,", r->steps);
        put_number(output.stream, saving(rows, i), ',');
        put_figures(output.stream, r->means);
    }
    return sl_output_close(context, &output, SL_OK);
}

sl_status sl_walk_write_frames(sl_context *context, const sl_walk_rows *rows, const sl_eyes *eyes,
                               double *const *frames, const char *path) {
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    fputs("method,test,frame,x,y,look,", output.stream);
    put_figure_names(output.stream);
    for (size_t i = 0; i < rows->count; i++) {
        if (!frames[i]) continue;
        for (size_t k = 0; k < eyes->list.count; k++) {
            const sl_eye *eye = &eyes->list.items[k];
            put_choice(output.stream, &rows->items[i]);
            fprintf(output.stream, "%zu,", k);
            put_number(output.stream, eye->at.x, ',');
            put_number(output.stream, eye->at.y, ',');
            put_number(output.stream, eye->look, ',');
            put_figures(output.stream, frames[i] + k * SL_FIGURES);
        }
    }
    return sl_output_close(context, &output, SL_OK);
}

// --- charts

#define FRAME_LABEL "visibility and drawing, a frame"

enum { MOST_MARKS = 64, MOST_SERIES = SL_CHART_COLOURS };

typedef struct lines {
    sl_chart_mark marks[MOST_SERIES][MOST_MARKS];
    sl_chart_series series[MOST_SERIES];
    size_t count;
} lines;

/// Adds a mark to the line of a name, which is begun where it is new.
static void add_mark(lines *l, const char *name, double x, double y) {
    size_t i = 0;
    while (i < l->count && strcmp(l->series[i].name, name) != 0) i++;
    if (i == MOST_SERIES) return;
    if (i == l->count)
        l->series[l->count++] = (sl_chart_series){
            .name = name, .style = SL_CHART_LINE, .colour = (unsigned)i, .marks = l->marks[i]};
    sl_chart_series *s = &l->series[i];
    if (s->mark_count < MOST_MARKS) l->marks[i][s->mark_count++] = (sl_chart_mark){.x = x, .y = y};
}

static sl_status draw(sl_context *context, const lines *l, const char *title, sl_chart_axis x,
                      sl_chart_axis y, const char *path) {
    const sl_chart chart = {.title = title,
                            .x = x,
                            .y = y,
                            .series = l->series,
                            .series_count = l->count,
                            .width = sl_draw_options_default().width};
    return sl_draw_chart_file(context, &chart, path);
}

sl_status sl_walk_draw_speeds(sl_context *context, const sl_walk_rows *rows,
                              const sl_walk_chart *chart, const char *test, const char *path) {
    lines *l = sl_alloc_array(context, 1, sizeof *l);
    if (!l) return SL_NO_MEMORY;
    const sl_walk_method *methods = sl_walk_methods(&(size_t){0});
    for (size_t i = 0; i < rows->count; i++) {
        const sl_walk_row *r = &rows->items[i];
        const sl_walk_method *method = r->choice.method;
        if (method && chart->methods >> (method - methods) & 1 &&
            strcmp(r->choice.options.test->name, test) == 0)
            add_mark(l, method->name, r->speed, r->means[chart->figure]);
    }
    const char *label = chart->figure == SL_FIGURE_TESTS        ? "node visibility tests a frame"
                        : chart->figure == SL_FIGURE_VISIBILITY ? "visibility, a frame"
                                                                : FRAME_LABEL;
    const sl_chart_axis y = {.label = label, .seconds = chart->figure >= SL_FIGURE_VISIBILITY};
    const sl_chart_axis x = {.label = "relative speed", .scale = SL_CHART_LOG};
    const sl_status status = draw(context, l, chart->title, x, y, path);
    sl_free(context, l);
    return status;
}

sl_status sl_walk_draw_chances(sl_context *context, const sl_walk_rows *rows, const char *title,
                               const char *path) {
    lines *l = sl_alloc_array(context, 1, sizeof *l);
    if (!l) return SL_NO_MEMORY;
    for (size_t i = 0; i < rows->count; i++) {
        const sl_walk_row *r = &rows->items[i];
        add_mark(l, r->choice.options.test->name, r->choice.options.p_skip,
                 r->means[SL_FIGURE_FRAME]);
    }
    const sl_chart_axis x = {.label = "p_skip"};
    const sl_chart_axis y = {.label = FRAME_LABEL, .seconds = true};
    const sl_status status = draw(context, l, title, x, y, path);
    sl_free(context, l);
    return status;
}

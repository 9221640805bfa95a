/// The results of a comparison as charts: accuracy against time.
#include "studies/compare.h"

#include "arguments/names.h"
#include "inputs/inputs.h"
#include "reports/fields.h"
#include "reports/json_print.h"
#include "reports/report.h"
#include "sightline/draw.h"
#include "sightline/support.h"
#include "system/built.h"

#include <inttypes.h>

// The comparison as a chart: time across, pairs too many up and pairs too few down.

#define DOT   "  \xc2\xb7  "
#define MICRO "\xc2\xb5"
#define TIMES "\xc3\x97"

enum { GUARANTEES = 4, NOTE_TEXT = 256, NOTES_TEXT = 1024 };

/// The text at the mark of a run.
typedef struct mark_text {
    char label[RUN_NAME], note[NOTE_TEXT];
} mark_text;

typedef struct chart_parts {
    const compare_result *comparison;
    sl_chart_mark *marks, *over, *under; ///< by guarantee; of the frontier
    mark_text *texts;
    sl_chart_series series[GUARANTEES + 2];
    char title[320], subtitle[256], notes[NOTES_TEXT];
    sl_chart chart;
} chart_parts;

/// "53.4 ms, 129 x · 43 us a test · 12 pairs doubtful"
static void write_note(const compare_run *run, char *note) {
    const sl_see_account *account = &run->visibility.account;
    char seconds[SECONDS_TEXT];
    seconds_write(run->seconds, MICRO, seconds);
    text_append(note, NOTE_TEXT, "%s", seconds);
    if (run->ratio > 1)
        text_append(note, NOTE_TEXT, ", %.*f " TIMES " as long", run->ratio < 9.95 ? 1 : 0,
                    run->ratio);
    if (account->tests) {
        seconds_write(run->seconds / (double)account->tests, MICRO, seconds);
        text_append(note, NOTE_TEXT, DOT "%s a test", seconds);
    }
    if (run->too_many) text_append(note, NOTE_TEXT, DOT "%" PRIu64 " too many", run->too_many);
    if (run->too_few) text_append(note, NOTE_TEXT, DOT "%" PRIu64 " too few", run->too_few);
    if (account->doubtful_pairs)
        text_append(note, NOTE_TEXT, DOT "%" PRIu64 " doubtful", account->doubtful_pairs);
}

/// A run that errs both ways stands where it errs more, with a whisker to the other side.
static sl_chart_mark mark_of(const chart_parts *parts, const compare_run *run,
                             const mark_text *text) {
    const double many = (double)run->too_many, few = (double)run->too_few;
    const double doubtful = (double)run->visibility.account.doubtful_pairs;
    sl_chart_mark mark = {.x = run->seconds,
                          .y = many >= few ? many : -few,
                          .x_whisker = {run->low, run->high},
                          .label = text->label,
                          .note = text->note};
    if (many > 0 && few > 0) mark.y_whisker = (sl_chart_span){-few, many};
    // Doubtful pairs count as seen with closed sight only, so they can err one way only.
    if (run->judged)
        mark.y_band = parts->comparison->sight == SL_CLOSED ? (sl_chart_span){0, doubtful}
                                                            : (sl_chart_span){-doubtful, 0};
    return mark;
}

static void add_guarantee(chart_parts *parts, sl_guarantee guarantee, size_t *used) {
    const compare_result *comparison = parts->comparison;
    sl_chart_series *series = &parts->series[parts->chart.series_count];
    *series = (sl_chart_series){.name = sl_guarantee_name(guarantee),
                                .style = SL_CHART_MARKS,
                                .colour = guarantee == SL_EXACT          ? 0
                                          : guarantee == SL_ROUNDED      ? 1
                                          : guarantee == SL_CONSERVATIVE ? 2
                                                                         : 3,
                                .marks = parts->marks + *used};
    for (size_t i = 0; i < comparison->run_count; i++) {
        const compare_run *run = &comparison->runs[i];
        if (run->outcome != RUN_DONE || run->guarantee != guarantee) continue;
        mark_text *text = &parts->texts[*used];
        run_name(run, text->label);
        write_note(run, text->note);
        parts->marks[(*used)++] = mark_of(parts, run, text);
        series->mark_count++;
    }
    if (series->mark_count) parts->chart.series_count++;
}

/// Runs that miss no pair make the frontier over 0. Runs that add no pair make the one under it.
/// Exact runs belong to both.
static void add_frontier(chart_parts *parts, bool over) {
    const compare_result *comparison = parts->comparison;
    sl_chart_mark *marks = over ? parts->over : parts->under;
    size_t count = 0;
    for (size_t i = 0; i < comparison->run_count; i++) {
        const compare_run *run = &comparison->runs[comparison->order[i]];
        if (!run->frontier || (over ? run->too_few : run->too_many)) continue;
        const double y = over ? (double)run->too_many : -(double)run->too_few;
        marks[count++] = (sl_chart_mark){.x = run->seconds, .y = y};
    }
    if (!count) return;
    parts->series[parts->chart.series_count++] =
        (sl_chart_series){.name = "Pareto frontier: no other run is both faster and more accurate",
                          .style = over ? SL_CHART_FRONTIER_OVER : SL_CHART_FRONTIER_UNDER,
                          .marks = marks,
                          .mark_count = count};
}

static void list_runs(const compare_result *comparison, run_outcome outcome, const char *lead,
                      char *notes) {
    bool begun = false;
    for (size_t i = 0; i < comparison->run_count; i++) {
        if (comparison->runs[i].outcome != outcome) continue;
        char name[RUN_NAME];
        run_name(&comparison->runs[i], name);
        text_append(notes, NOTES_TEXT, "%s%s", begun ? ", " : lead, name);
        begun = true;
    }
    if (begun) text_append(notes, NOTES_TEXT, "\n");
}

static void write_notes(const compare_result *comparison, char *notes) {
    char lead[64];
    size_t done = 0;
    for (size_t i = 0; i < comparison->run_count; i++)
        done += comparison->runs[i].outcome == RUN_DONE;
    if (comparison->reference == NO_RUN)
        text_append(notes, NOTES_TEXT,
                    "No exact run is done: how right the others are is not known.\n");
    else if (done > 1 && compare_all_agree(comparison))
        text_append(notes, NOTES_TEXT,
                    "All %zu runs agree on every pair: what differs is the time.\n", done);
    snprintf(lead, sizeof lead, "Not done in %g s: ", comparison->limit);
    list_runs(comparison, RUN_NOT_DONE, lead, notes);
    list_runs(comparison, RUN_REFUSED, "Refused the map: ", notes);
}

static void write_heading(chart_parts *parts) {
    const compare_result *comparison = parts->comparison;
    char readable[256];
    size_t length;
    text_make_readable(comparison->input, readable, sizeof readable);
    const char *name = input_base_name(readable, &length);
    snprintf(parts->title, sizeof parts->title, "%.*s: what accuracy costs in time", (int)length,
             name);
    text_append(parts->subtitle, sizeof parts->subtitle,
                "%" PRIu32 " cells" DOT "%" PRIu32 " portals", comparison->space->cell_count,
                comparison->space->portal_count);
    if (comparison->reference != NO_RUN) {
        const compare_run *exact = &comparison->runs[comparison->reference];
        char by[RUN_NAME];
        run_name(exact, by);
        text_append(parts->subtitle, sizeof parts->subtitle, DOT "%" PRIu64 " pairs seen, by %s",
                    exact->visibility.account.pairs, by);
    }
    text_append(parts->subtitle, sizeof parts->subtitle, DOT "%s sight",
                sight_name(comparison->sight));
}

static void fill_chart(chart_parts *parts, bool dark) {
    sl_chart *chart = &parts->chart;
    const bool judged = parts->comparison->reference != NO_RUN;
    size_t used = 0;
    *chart = (sl_chart){
        .title = parts->title,
        .subtitle = parts->subtitle,
        .notes = parts->notes,
        .x = {.label = "time for all cells, one thread (medians)",
              .scale = SL_CHART_LOG,
              .seconds = true},
        .y = {.scale = SL_CHART_SYMLOG, .zero = judged ? "exact" : "not known"},
        .series = parts->series,
        .width = built_draw_options().width,
        .dark = dark,
    };
    if (judged) {
        chart->y.over = "pairs too many: hidden, but said to be seen";
        chart->y.under = "pairs too few: seen, but said to be hidden";
    }
    add_guarantee(parts, SL_EXACT, &used);
    add_guarantee(parts, SL_CONSERVATIVE, &used);
    add_guarantee(parts, SL_AGGRESSIVE, &used);
    add_guarantee(parts, SL_ROUNDED, &used);
    for (size_t i = 0; i < used; i++)
        if (parts->marks[i].y_band.low != parts->marks[i].y_band.high)
            chart->band = "pairs left to rounding";
    add_frontier(parts, true);
    add_frontier(parts, false);
    write_heading(parts);
    write_notes(parts->comparison, parts->notes);
}

sl_status compare_draw(sl_context *context, const compare_result *comparison, bool dark,
                       const char *path) {
    const size_t count = comparison->run_count;
    chart_parts parts = {.comparison = comparison};
    parts.marks = sl_alloc_array(context, count, sizeof *parts.marks);
    parts.over = sl_alloc_array(context, count, sizeof *parts.over);
    parts.under = sl_alloc_array(context, count, sizeof *parts.under);
    parts.texts = sl_alloc_array(context, count, sizeof *parts.texts);
    sl_status status = SL_NO_MEMORY;
    if (parts.marks && parts.over && parts.under && parts.texts) {
        fill_chart(&parts, dark);
        status = built_pictures()->chart(context, &parts.chart, path);
    }
    sl_free(context, parts.marks);
    sl_free(context, parts.over);
    sl_free(context, parts.under);
    sl_free(context, parts.texts);
    return status;
}

// --- culling for an eye

/// The comparison of culling methods as a chart: the time of a query across, the area kept up.

typedef struct eye_mark_text {
    char label[64], note[64];
} eye_mark_text;

typedef struct eye_chart_parts {
    const eye_comparison *comparison;
    sl_chart_mark *marks;
    eye_mark_text *texts;
    sl_chart_series series[FOVS_MOST];
    char names[FOVS_MOST][48];
    char title[320], subtitle[256];
} eye_chart_parts;

static void fill_mark(const compare_eye_row *row, eye_mark_text *text, sl_chart_mark *mark) {
    char seconds[SECONDS_TEXT];
    seconds_write(row->seconds, MICRO, seconds);
    words_of(row->name, text->label, sizeof text->label);
    snprintf(text->note, sizeof text->note, "%.2f %% in %s", 100 * row->share, seconds);
    *mark = (sl_chart_mark){
        .x = row->seconds, .y = 100 * row->share, .label = text->label, .note = text->note};
}

static void fill_series(eye_chart_parts *parts) {
    const eye_comparison *c = parts->comparison;
    const size_t count = c->row_count / c->plan->fov_count;
    for (size_t f = 0; f < c->plan->fov_count; f++) {
        snprintf(parts->names[f], sizeof parts->names[f], "view cone of %g\xc2\xb0",
                 c->plan->fovs[f]);
        for (size_t i = f * count; i < (f + 1) * count; i++)
            fill_mark(&c->rows[i], &parts->texts[i], &parts->marks[i]);
        parts->series[f] = (sl_chart_series){.name = parts->names[f],
                                             .style = SL_CHART_MARKS,
                                             .colour = (unsigned)(f % SL_CHART_COLOURS),
                                             .marks = parts->marks + f * count,
                                             .mark_count = count};
    }
}

/// Logarithmic, since methods differ by factors. Linear where an area is 0.
static sl_chart_scale scale_of(const eye_comparison *comparison) {
    for (size_t i = 0; i < comparison->row_count; i++)
        if (!(comparison->rows[i].share > 0)) return SL_CHART_LINEAR;
    return SL_CHART_LOG;
}

static void write_eye_heading(eye_chart_parts *parts) {
    const eye_comparison *c = parts->comparison;
    char readable[256];
    size_t length;
    text_make_readable(c->input, readable, sizeof readable);
    const char *name = input_base_name(readable, &length);
    snprintf(parts->title, sizeof parts->title, "%.*s: what culling for an eye keeps", (int)length,
             name);
    snprintf(parts->subtitle, sizeof parts->subtitle,
             "%" PRIu32 " inside cells" DOT "%" PRIu64 " viewpoints, seed %" PRIu64 DOT "%s sight",
             c->space->inside_count, c->plan->viewpoints, c->plan->seed, sight_name(c->sight));
}

sl_status compare_eye_draw(sl_context *context, const eye_comparison *comparison, bool dark,
                           const char *path) {
    eye_chart_parts parts = {.comparison = comparison};
    parts.marks = sl_alloc_array(context, comparison->row_count, sizeof *parts.marks);
    parts.texts = sl_alloc_array(context, comparison->row_count, sizeof *parts.texts);
    sl_status status = SL_NO_MEMORY;
    if (parts.marks && parts.texts) {
        write_eye_heading(&parts);
        fill_series(&parts);
        const sl_chart chart = {
            .title = parts.title,
            .subtitle = parts.subtitle,
            .notes = "Each method keeps some of what the one before it does; the exact ones all "
                     "that is seen.",
            .x = {.label = "time of a query, one thread (medians)",
                  .scale = SL_CHART_LOG,
                  .seconds = true},
            .y = {.label = "area kept, % of the inside", .scale = scale_of(comparison)},
            .series = parts.series,
            .series_count = comparison->plan->fov_count,
            .width = built_draw_options().width,
            .dark = dark,
        };
        status = built_pictures()->chart(context, &chart, path);
    }
    sl_free(context, parts.marks);
    sl_free(context, parts.texts);
    return status;
}

/// The comparison of culling methods as a chart: the time of a query across, the area kept up.
#include "compare_eye.h"
#include "compare_report.h"
#include "inputs.h"
#include "json_print.h"
#include "names.h"
#include "sightline/draw.h"
#include "sightline/support.h"

#include <inttypes.h>

#define DOT   "  \xc2\xb7  "
#define MICRO "\xc2\xb5"

typedef struct mark_text {
    char label[64], note[64];
} mark_text;

typedef struct chart_parts {
    const sl_compare_eye *comparison;
    sl_chart_mark *marks;
    mark_text *texts;
    sl_chart_series series[SL_FOVS_MOST];
    char names[SL_FOVS_MOST][48];
    char title[320], subtitle[256];
} chart_parts;

static void fill_mark(const sl_compare_eye_row *row, mark_text *text, sl_chart_mark *mark) {
    char seconds[SL_SECONDS_TEXT];
    sl_seconds_write(row->seconds, MICRO, seconds);
    snprintf(text->label, sizeof text->label, "%s", row->name);
    for (char *at = text->label; *at; at++)
        if (*at == '_') *at = ' ';
    snprintf(text->note, sizeof text->note, "%.2f %% in %s", 100 * row->share, seconds);
    *mark = (sl_chart_mark){
        .x = row->seconds, .y = 100 * row->share, .label = text->label, .note = text->note};
}

static void fill_series(chart_parts *parts) {
    const sl_compare_eye *c = parts->comparison;
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

/// Logarithmic, as methods differ by factors, but for areas that are nothing.
static sl_chart_scale scale_of(const sl_compare_eye *comparison) {
    for (size_t i = 0; i < comparison->row_count; i++)
        if (!(comparison->rows[i].share > 0)) return SL_CHART_LINEAR;
    return SL_CHART_LOG;
}

static void write_heading(chart_parts *parts) {
    const sl_compare_eye *c = parts->comparison;
    char readable[256];
    size_t length;
    sl_text_make_readable(c->input, readable, sizeof readable);
    const char *name = sl_input_base_name(readable, &length);
    snprintf(parts->title, sizeof parts->title, "%.*s: what culling for an eye keeps", (int)length,
             name);
    snprintf(parts->subtitle, sizeof parts->subtitle,
             "%" PRIu32 " inside cells" DOT "%" PRIu64 " viewpoints, seed %" PRIu64 DOT "%s sight",
             c->space->inside_count, c->plan->viewpoints, c->plan->seed, sl_sight_name(c->sight));
}

sl_status sl_compare_eye_draw(sl_context *context, const sl_compare_eye *comparison, bool dark,
                              const char *path) {
    chart_parts parts = {.comparison = comparison};
    parts.marks = sl_alloc_array(context, comparison->row_count, sizeof *parts.marks);
    parts.texts = sl_alloc_array(context, comparison->row_count, sizeof *parts.texts);
    sl_status status = SL_NO_MEMORY;
    if (parts.marks && parts.texts) {
        write_heading(&parts);
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
            .width = sl_draw_options_default().width,
            .dark = dark,
        };
        status = sl_draw_chart_file(context, &chart, path);
    }
    sl_free(context, parts.marks);
    sl_free(context, parts.texts);
    return status;
}

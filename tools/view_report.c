#include "view_report.h"

#include "json_print.h"
#include "sightline/support.h"
#include "sizes.h"

#include <inttypes.h>
#include <string.h>

/// Costs of the whole and of the cut, as the report tells them.
typedef struct totals {
    double whole, cut, finest;
    uint64_t cut_bytes, finest_bytes;
} totals;

static sl_status add_up(sl_context *context, const sl_view_run *run, totals *out) {
    const sl_view_hierarchy *h = sl_view_run_told(run);
    uint64_t unused;
    SL_TRY(sl_view_run_cost(context, h, 1, &out->whole, &unused));
    SL_TRY(sl_view_run_cost(context, h, run->cell_count, &out->cut, &out->cut_bytes));
    return sl_view_run_cost(context, h, h->cell_count, &out->finest, &out->finest_bytes);
}

static const char *objects_name(const sl_view_report *report) {
    return report->run->scene.objects == SL_VIEW_WALLS ? "walls" : "cells";
}

static bool is_told_exactly(const sl_view_report *report) {
    const sl_view_run_options *o = report->options;
    return (o->exact || o->method->exact) && !report->run->evaluated.cell_count;
}

static void print_work(const sl_view_work *w) {
    printf("looks             %" PRIu64 " from %" PRIu64 " rooms and the halves of %" PRIu64
           " cuts: %" PRIu64 " candidates, %" PRIu64 " relations, %" PRIu64 " tests\n",
           w->looks, w->rooms, w->cuts, w->candidates, w->relations, w->tests);
}

static void add_work(sl_json_fields *fields, const sl_view_work *work) {
    sl_json_add_count(fields, "rooms", work->rooms);
    sl_json_add_count(fields, "cuts", work->cuts);
    sl_json_add_count(fields, "looks", work->looks);
    sl_json_add_count(fields, "candidates", work->candidates);
    sl_json_add_count(fields, "relations", work->relations);
    sl_json_add_count(fields, "tests", work->tests);
    sl_json_add_count(fields, "weighed", work->weighed);
}

sl_status sl_view_report_print(sl_context *context, const sl_view_report *report) {
    const sl_view_run *run = report->run;
    const sl_view_segments *s = &run->segments;
    totals t;
    char size[SL_SIZE_TEXT], finest[SL_SIZE_TEXT];
    SL_TRY(add_up(context, run, &t));
    sl_size_write(t.cut_bytes, size);
    sl_size_write(t.finest_bytes, finest);
    printf("%u view cells by %s: expected cost %.6g %s, sets of %s\n", run->cell_count,
           report->options->method->name, t.cut, objects_name(report), size);
    printf("  with one cell   %.6g\n", t.whole);
    printf("  with all %-7u%.6g, sets of %s\n", run->tree.cell_count, t.finest, finest);
    if (report->options->method->exact)
        print_work(&run->found.work);
    else
        printf("segments          %u of %" PRIu64 " samples (%" PRIu64 " in empty space, %" PRIu64
               " saw no wall, %" PRIu64 " lost)\n",
               s->count, s->drawn, s->empty, s->unseeing, s->lost);
    if (run->has_exact) {
        char plain[SL_SIZE_TEXT], rows[SL_SIZE_TEXT], cells[SL_SIZE_TEXT];
        const sl_pvs *pulled = &run->exact.views.rows;
        sl_size_write(run->plain_bytes, plain);
        sl_size_write(pulled->offsets[pulled->cell_count], rows);
        sl_size_write(run->cell_bytes, cells);
        printf("exact sets        %s in rows of the %u cells, %s in those of view cells", cells,
               run->exact.space.cell_count, plain);
        if (run->exact.views.node_count > run->cell_count) printf(", %s pulled up", rows);
        putchar('\n');
        if (run->exact_cost > 0) printf("exact cost        %.6g cells\n", run->exact_cost);
    }
    if (is_told_exactly(report)) printf("costs             by exact sets\n");
    if (run->evaluated.cell_count)
        printf("evaluated by      %" PRIu64 " other samples\n", report->options->evaluation);
    printf("seconds           read %.3f, subdivide %.3f, sample %.3f, divide %.3f, merge %.3f, "
           "evaluate %.3f\n",
           run->seconds.read, run->seconds.subdivide, run->seconds.sample, run->seconds.divide,
           run->seconds.merge, run->seconds.evaluate);
    return SL_OK;
}

static void add_seconds(sl_json_fields *fields, const sl_view_seconds *seconds) {
    sl_json_fields inner = sl_json_begin();
    sl_json_add_real(&inner, "read", seconds->read);
    sl_json_add_real(&inner, "subdivide", seconds->subdivide);
    sl_json_add_real(&inner, "sample", seconds->sample);
    sl_json_add_real(&inner, "divide", seconds->divide);
    sl_json_add_real(&inner, "merge", seconds->merge);
    sl_json_add_real(&inner, "evaluate", seconds->evaluate);
    sl_json_add_real(&inner, "see", seconds->see);
    sl_json_add_fields(fields, "seconds", &inner);
}

sl_status sl_view_report_print_json(sl_context *context, const sl_view_report *report) {
    const sl_view_run *run = report->run;
    const sl_view_segments *s = &run->segments;
    totals t;
    SL_TRY(add_up(context, run, &t));
    sl_json_fields fields = sl_json_begin();
    sl_json_add_text(&fields, "map", report->input);
    sl_json_add_text(&fields, "subdivide", report->subdivide);
    sl_json_add_text(&fields, "method", report->options->method->name);
    sl_json_add_text(&fields, "objects", objects_name(report));
    sl_json_add_count(&fields, "walls", run->baked.space.wall_count);
    sl_json_add_count(&fields, "cells", run->baked.space.cell_count);
    sl_json_add_count(&fields, "samples", s->drawn);
    sl_json_add_count(&fields, "samples_in_empty_space", s->empty);
    sl_json_add_count(&fields, "samples_that_saw_no_wall", s->unseeing);
    sl_json_add_count(&fields, "samples_lost", s->lost);
    sl_json_add_count(&fields, "segments", s->count);
    sl_json_add_count(&fields, "evaluation_samples", report->options->evaluation);
    sl_json_add_flag(&fields, "exact", is_told_exactly(report));
    if (report->options->method->exact) add_work(&fields, &run->found.work);
    sl_json_add_count(&fields, "elementary_view_cells", run->tree.cell_count);
    sl_json_add_count(&fields, "view_cells", run->cell_count);
    sl_json_add_real(&fields, "cost_of_one", t.whole);
    sl_json_add_real(&fields, "cost", t.cut);
    sl_json_add_real(&fields, "cost_of_all", t.finest);
    sl_json_add_count(&fields, "bytes", t.cut_bytes);
    sl_json_add_count(&fields, "bytes_of_all", t.finest_bytes);
    if (run->has_exact) {
        const sl_pvs *pulled = &run->exact.views.rows;
        sl_json_add_count(&fields, "exact_cells", run->exact.space.cell_count);
        sl_json_add_count(&fields, "exact_row_bytes_of_cells", run->cell_bytes);
        sl_json_add_count(&fields, "exact_row_bytes", run->plain_bytes);
        sl_json_add_count(&fields, "exact_row_bytes_pulled_up",
                          pulled->offsets[pulled->cell_count]);
        if (run->exact_cost > 0) sl_json_add_real(&fields, "exact_cost", run->exact_cost);
    }
    add_seconds(&fields, &run->seconds);
    sl_json_add_count(&fields, "peak_memory_bytes", sl_size_of_peak_memory());
    return sl_json_print(context, &fields);
}

static void put(FILE *out, double value, char after) {
    char text[SL_NUMBER_TEXT];
    sl_number_write(value, text);
    fprintf(out, "%s%c", text, after);
}

static sl_point middle_of(const sl_view_tree *tree, uint32_t leaf) {
    sl_point sum = {0, 0};
    const uint32_t first = tree->first[leaf], count = tree->first[leaf + 1] - first;
    for (uint32_t i = 0; i < count; i++) {
        sum.x += tree->corners[first + i].x / count;
        sum.y += tree->corners[first + i].y / count;
    }
    return sum;
}

/// What the elementary cells of a view cell come to.
typedef struct members {
    uint32_t count, largest;
} members;

static sl_status write_rows(sl_context *context, const sl_view_run *run, FILE *out) {
    const sl_view_hierarchy *h = sl_view_run_told(run);
    members *of = sl_alloc_array(context, run->cell_count, sizeof *of);
    if (!of) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < h->cell_count; i++) {
        members *m = &of[run->view_cells[i]];
        if (!m->count++ || run->tree.mass[i] > run->tree.mass[m->largest]) m->largest = i;
    }
    fputs("view_cell,probability,cost,objects,bytes,elementary_cells,x,y\n", out);
    for (uint32_t i = 0; i < run->cell_count; i++) {
        const uint32_t number = run->numbers[i];
        const sl_point at = middle_of(&run->tree, of[i].largest);
        fprintf(out, "%u,", i);
        put(out, h->mass[number], ',');
        put(out, h->cost[number], ',');
        fprintf(out, "%u,%" PRIu64 ",%u,", h->objects[number], h->bytes[number], of[i].count);
        put(out, at.x, ',');
        put(out, at.y, '\n');
    }
    sl_free(context, of);
    return SL_OK;
}

sl_status sl_view_report_write_csv(sl_context *context, const sl_view_run *run, const char *path) {
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    return sl_output_close(context, &output, write_rows(context, run, output.stream));
}

sl_status sl_view_report_draw(sl_context *context, const sl_view_report *report,
                              const sl_draw_options *options, const char *path) {
    const sl_view_run *run = report->run;
    const sl_view_hierarchy *h = sl_view_run_told(run);
    totals t;
    SL_TRY(add_up(context, run, &t));
    double *values = sl_alloc_array(context, h->cell_count, sizeof *values);
    if (!values) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < h->cell_count; i++)
        values[i] = h->cost[run->numbers[run->view_cells[i]]];
    char name[64], caption[160];
    snprintf(name, sizeof name, "render cost (%s)", objects_name(report));
    snprintf(caption, sizeof caption,
             "%u view cells by %s  \xc2\xb7  expected cost %.4g, with one cell %.4g",
             run->cell_count, report->options->method->name, t.cut, t.whole);
    sl_patches patches = {.name = name,
                          .points = run->tree.corners,
                          .first = run->tree.first,
                          .values = values,
                          .count = h->cell_count};
    sl_segment *lines = NULL;
    sl_status status =
        sl_view_borders(context, &run->tree, run->view_cells, &lines, &patches.line_count);
    patches.lines = lines;
    if (status == SL_OK)
        status = sl_draw_patches_file(context, &run->baked, &patches, caption, options, path);
    sl_view_borders_free(context, lines);
    sl_free(context, values);
    return status;
}

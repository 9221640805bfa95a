/// The table of from-region methods, and its two charts: refinement, and work by output.
#include "studies/regions_report.h"

#include "sightline/draw.h"
#include "sightline/support.h"
#include "system/built.h"

#include <inttypes.h>
#include <string.h>

// --- the table

/// The cost of a method by name; NULL where it did not run.
static const regions_cost *regions_cost_of(const regions_row *row, const char *method) {
    for (size_t i = 0; i < row->cost_count; i++)
        if (strcmp(row->costs[i].method, method) == 0) return &row->costs[i];
    return NULL;
}

/// The table on stdout, and the same as CSV.

static void print_heading(const regions_row *row) {
    printf("\nview cells: %s\n", row->view_cells);
    printf("  %-20s%10s%9s", "map", "cells", "objects");
    for (size_t i = 0; i < row->cost_count; i++) printf("%11s %%", row->costs[i].method);
    for (size_t i = 0; i < row->cost_count; i++) printf("%11s s", row->costs[i].method);
    printf("%8s%11s\n", "PVS %", "work/seen");
}

static void print_row(const regions_row *row) {
    printf("  %-20s%10" PRIu32 "%9" PRIu32, row->map, row->counts.view_cells, row->counts.objects);
    for (size_t i = 0; i < row->cost_count; i++) printf("%13.3f", 100 * row->costs[i].refined);
    for (size_t i = 0; i < row->cost_count; i++) printf("%13.3f", row->costs[i].seconds);
    printf("%8.2f", 100 * regions_mean_pvs(row));
    const regions_cost *multipass = regions_cost_of(row, "multipass");
    if (multipass && multipass->relations)
        printf("%11.3f", (double)multipass->candidates / (double)multipass->relations);
    putchar('\n');
    if (row->counts.boundary_faces)
        printf("  %20s%" PRIu32 " of %" PRIu32 " faces lead out of all view cells\n", "",
               row->counts.boundary_faces, row->counts.faces);
}

void regions_print(const regions_rows *rows) {
    puts(
        "METHOD %: objects given to the solver, an image's mean share of all, after view-frustum\n"
        "culling; METHOD s: seconds of processor time; PVS %: a view cell's mean share of the "
        "objects\n"
        "seen; work/seen: multipass's candidates over what it found in all quadrants. All methods\n"
        "took the same samples and found the same.");
    const char *last = NULL;
    for (size_t i = 0; i < rows->count; i++) {
        if (!last || strcmp(last, rows->items[i].view_cells) != 0) print_heading(&rows->items[i]);
        last = rows->items[i].view_cells;
        print_row(&rows->items[i]);
    }
}

static void write_row(FILE *stream, const regions_row *row, const regions_cost *cost) {
    char pvs[SL_NUMBER_TEXT], refined[SL_NUMBER_TEXT], seconds[SL_NUMBER_TEXT];
    sl_number_write(regions_mean_pvs(row), pvs);
    sl_number_write(cost->refined, refined);
    sl_number_write(cost->seconds, seconds);
    const sl_from_region_counts *c = &row->counts;
    for (const char *at = row->map; *at; at++) fputc(*at == ',' || *at == '"' ? '_' : *at, stream);
    fprintf(stream, ",%s,%" PRIu32 ",%" PRIu32 ",%" PRIu32 ",%" PRIu32 ",%" PRIu32 ",%" PRIu32,
            row->view_cells, c->view_cells, c->objects, c->leaves, c->faces, c->boundary_faces,
            c->dependents);
    fprintf(stream, ",%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%s,%s,%s,%s,%" PRIu64, row->images,
            row->rays, row->pairs, pvs, cost->method, refined, seconds, cost->candidates);
    if (cost->relations)
        fprintf(stream, ",%" PRIu64 "\n", cost->relations);
    else
        fputs(",\n", stream);
}

sl_status regions_write_csv(sl_context *context, const regions_rows *rows, const char *path) {
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    fputs("map,view_cells,cells,objects,leaves,faces,boundary_faces,dependents,images,rays,pairs,"
          "mean_pvs,method,mean_refine,seconds,candidates,relations\n",
          output.stream);
    for (size_t i = 0; i < rows->count; i++)
        for (size_t k = 0; k < rows->items[i].cost_count; k++)
            write_row(output.stream, &rows->items[i], &rows->items[i].costs[k]);
    return sl_output_close(context, &output, SL_OK);
}

// --- charts

/// The charts of "regions": a series for each set of view cells, a mark for each map.

enum { SERIES_MOST = 8 };

typedef struct points {
    sl_chart_mark *marks;
    sl_chart_series series[SERIES_MOST + 1];
    size_t series_count;
    sl_chart_mark bound[2];
} points;

static size_t same_view_cells(const regions_rows *rows, size_t first) {
    size_t end = first + 1;
    while (end < rows->count &&
           strcmp(rows->items[end].view_cells, rows->items[first].view_cells) == 0)
        end++;
    return end;
}

/// A mark for each row: its mean visible set across, `value` up.
static sl_status make_points(sl_context *context, const regions_rows *rows,
                             double (*value)(const regions_row *), points *p) {
    p->marks = sl_alloc_array(context, rows->count, sizeof *p->marks);
    if (!p->marks) return SL_NO_MEMORY;
    for (size_t i = 0; i < rows->count; i++)
        p->marks[i] = (sl_chart_mark){.x = 100 * regions_mean_pvs(&rows->items[i]),
                                      .y = value(&rows->items[i]),
                                      .label = rows->items[i].map};
    for (size_t first = 0, end; first < rows->count && p->series_count < SERIES_MOST; first = end) {
        end = same_view_cells(rows, first);
        p->series[p->series_count] =
            (sl_chart_series){.name = rows->items[first].view_cells,
                              .style = end - first > 1 ? SL_CHART_LINE : SL_CHART_MARKS,
                              .colour = (unsigned)(p->series_count % SL_CHART_COLOURS),
                              .marks = p->marks + first,
                              .mark_count = end - first};
        p->series_count++;
    }
    return SL_OK;
}

static double hierarchy_over_multipass(const regions_row *row) {
    const regions_cost *hierarchy = regions_cost_of(row, "hierarchy");
    const regions_cost *multipass = regions_cost_of(row, "multipass");
    return hierarchy && multipass && multipass->refined > 0
               ? hierarchy->refined / multipass->refined
               : 1;
}

static double work_over_output(const regions_row *row) {
    const regions_cost *cost = regions_cost_of(row, "multipass");
    return cost && cost->relations ? (double)cost->candidates / (double)cost->relations : 0;
}

/// The paper's K over the whole width.
static void add_bound(const regions_rows *rows, points *p) {
    uint32_t most = 0;
    double low = 100, high = 0;
    for (size_t i = 0; i < rows->count; i++) {
        const double x = 100 * regions_mean_pvs(&rows->items[i]);
        if (rows->items[i].counts.dependents > most) most = rows->items[i].counts.dependents;
        if (x < low) low = x;
        if (x > high) high = x;
    }
    p->bound[0] = (sl_chart_mark){.x = low, .y = most};
    p->bound[1] = (sl_chart_mark){.x = high, .y = most};
    p->series[p->series_count++] =
        (sl_chart_series){.name = "the bound: the most view cells that depend on one",
                          .style = SL_CHART_LINE,
                          .colour = SL_CHART_COLOURS - 1,
                          .marks = p->bound,
                          .mark_count = 2};
}

sl_status regions_draw_refine(sl_context *context, const regions_rows *rows, bool dark,
                              const char *path) {
    points p = {0};
    sl_status status = make_points(context, rows, hierarchy_over_multipass, &p);
    if (status == SL_OK) {
        const sl_chart chart = {
            .title = "Refine sets: hierarchy over multipass",
            .subtitle = "how many times smaller multipass's are, by view cells",
            .notes = "After Laine 2005, figure 11.",
            .x = {.label = "mean visible set, % of objects", .scale = SL_CHART_LOG},
            .y = {.label = "hierarchy's mean refine set / multipass's"},
            .series = p.series,
            .series_count = p.series_count,
            .width = built_draw_options().width,
            .dark = dark,
        };
        status = built_pictures()->chart(context, &chart, path);
    }
    sl_free(context, p.marks);
    return status;
}

sl_status regions_draw_work(sl_context *context, const regions_rows *rows, bool dark,
                            const char *path) {
    points p = {0};
    sl_status status = make_points(context, rows, work_over_output, &p);
    if (status == SL_OK) {
        add_bound(rows, &p);
        const sl_chart chart = {
            .title = "Work against output: multipass",
            .subtitle = "candidates tested for each visible relation found, by view cells",
            .notes = "The bound is that of Laine 2005, section 6.3; it holds where no sightline "
                     "leaves the view cells.",
            .x = {.label = "mean visible set, % of objects", .scale = SL_CHART_LOG},
            .y = {.label = "candidates / relations"},
            .series = p.series,
            .series_count = p.series_count,
            .width = built_draw_options().width,
            .dark = dark,
        };
        status = built_pictures()->chart(context, &chart, path);
    }
    sl_free(context, p.marks);
    return status;
}

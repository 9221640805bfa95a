/// What "regions" tells: the table on stdout, and the same as CSV.
#include "regions_run.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <string.h>

static void print_heading(const sl_regions_row *row) {
    printf("\nview cells: %s\n", row->view_cells);
    printf("  %-20s%10s%9s", "map", "cells", "objects");
    for (size_t i = 0; i < row->cost_count; i++) printf("%11s %%", row->costs[i].method);
    for (size_t i = 0; i < row->cost_count; i++) printf("%11s s", row->costs[i].method);
    printf("%8s%11s\n", "PVS %", "work/seen");
}

static void print_row(const sl_regions_row *row) {
    printf("  %-20s%10" PRIu32 "%9" PRIu32, row->map, row->counts.view_cells, row->counts.objects);
    for (size_t i = 0; i < row->cost_count; i++) printf("%13.3f", 100 * row->costs[i].refined);
    for (size_t i = 0; i < row->cost_count; i++) printf("%13.3f", row->costs[i].seconds);
    printf("%8.2f", 100 * sl_regions_mean_pvs(row));
    const sl_regions_cost *multipass = sl_regions_cost_of(row, "multipass");
    if (multipass && multipass->relations)
        printf("%11.3f", (double)multipass->candidates / (double)multipass->relations);
    putchar('\n');
    if (row->counts.boundary_faces)
        printf("  %20s%" PRIu32 " of %" PRIu32 " faces lead out of all view cells\n", "",
               row->counts.boundary_faces, row->counts.faces);
}

void sl_regions_print(const sl_regions_rows *rows) {
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

static void write_row(FILE *stream, const sl_regions_row *row, const sl_regions_cost *cost) {
    char pvs[SL_NUMBER_TEXT], refined[SL_NUMBER_TEXT], seconds[SL_NUMBER_TEXT];
    sl_number_write(sl_regions_mean_pvs(row), pvs);
    sl_number_write(cost->refined, refined);
    sl_number_write(cost->seconds, seconds);
    const sl_regions_counts *c = &row->counts;
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

sl_status sl_regions_write_csv(sl_context *context, const sl_regions_rows *rows, const char *path) {
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

#include "compare_eye.h"
#include "compare_report.h"
#include "json_print.h"
#include "names.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

bool sl_compare_eye_paper(const char *name, double fov, double *share, double *reduction) {
    // Teller & Séquin 1991, Results; the reduction factors are rounded there.
    static const struct {
        const char *name;
        double fov, percent, reduction;
    } told[] = {
        {"cell_to_cell", 360, 8.1, 10},
        {"cell_to_cell", 60, 8.1, 10},
        {"disjoint_cell", 360, 8.1, 10},
        {"disjoint_cell", 60, 3.1, 30},
        {"connected_component", 360, 8.1, 10},
        {"connected_component", 60, 2.4, 40},
        {"incident_portals", 360, 8.1, 10},
        {"incident_portals", 60, 2.2, 40},
        {"exact", 360, 4.9, 20},
        {"exact", 60, 1.8, 50},
        {"visible_area", 360, 2.1, 50},
        {"visible_area", 60, 0.3, 300},
    };
    for (size_t i = 0; i < sizeof told / sizeof *told; i++)
        if (told[i].fov == fov && strcmp(told[i].name, name) == 0) {
            *share = told[i].percent / 100;
            *reduction = told[i].reduction;
            return true;
        }
    return false;
}

static double reduction_of(const sl_compare_eye_row *row) {
    return row->share > 0 ? 1 / row->share : 0;
}

// --- the table

static void print_row(const sl_compare_eye_row *row) {
    char seconds[SL_SECONDS_TEXT], paper[64] = "";
    double share, reduction;
    sl_seconds_write(row->seconds, "u", seconds);
    if (sl_compare_eye_paper(row->name, row->fov, &share, &reduction))
        snprintf(paper, sizeof paper, "%12.1f %% %8.0f x", 100 * share, reduction);
    printf("  %-20s %8.2f %% %8.1f x %8.1f %9.1f %13.1f %9s%s\n", row->name, 100 * row->share,
           reduction_of(row), row->cells, row->nodes, row->orientations, seconds, paper);
}

void sl_compare_eye_print(const sl_compare_eye *comparison) {
    const sl_space *space = comparison->space;
    char seconds[SL_SECONDS_TEXT];
    sl_seconds_write(comparison->pvs_seconds, "u", seconds);
    printf("%s: %" PRIu32 " walls, %" PRIu32 " cells (%" PRIu32 " inside), %" PRIu32
           " portals; %s sight\n%" PRIu64 " viewpoints, seed %" PRIu64
           ", spread evenly over the inside area; visible sets made in %s\n",
           comparison->input, space->wall_count, space->cell_count, space->inside_count,
           space->portal_count, sl_sight_name(comparison->sight), comparison->plan->viewpoints,
           comparison->plan->seed, seconds);
    double fov = -1;
    for (size_t i = 0; i < comparison->row_count; i++) {
        const sl_compare_eye_row *row = &comparison->rows[i];
        if (row->fov != fov)
            printf("\n%g degrees              area kept  reduction    cells     nodes  "
                   "orientations      time   paper: area  reduction\n",
                   row->fov);
        fov = row->fov;
        print_row(row);
    }
    puts("\nmeans over all viewpoints (time: the median), a query; reduction: 1 / area kept; "
         "paper: Teller & Sequin "
         "1991,\nof Soda Hall");
}

// --- CSV and JSON

static void write_real(FILE *stream, double value) {
    char text[SL_NUMBER_TEXT];
    sl_number_write(value, text);
    fprintf(stream, ",%s", text);
}

sl_status sl_compare_eye_write_csv(sl_context *context, const sl_compare_eye *comparison,
                                   const char *path) {
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    fputs("fov,method,guarantee,share,reduction,cells,nodes,orientations,seconds,paper_share,"
          "paper_reduction\n",
          output.stream);
    for (size_t i = 0; i < comparison->row_count; i++) {
        const sl_compare_eye_row *row = &comparison->rows[i];
        const double values[] = {row->share, reduction_of(row), row->cells,
                                 row->nodes, row->orientations, row->seconds};
        double share, reduction;
        char fov[SL_NUMBER_TEXT];
        sl_number_write(row->fov, fov);
        fprintf(output.stream, "%s,%s,%s", fov, row->name, sl_guarantee_name(row->guarantee));
        for (size_t k = 0; k < sizeof values / sizeof *values; k++)
            write_real(output.stream, values[k]);
        if (sl_compare_eye_paper(row->name, row->fov, &share, &reduction)) {
            write_real(output.stream, share);
            write_real(output.stream, reduction);
            fputc('\n', output.stream);
        } else
            fputs(",,\n", output.stream);
    }
    return sl_output_close(context, &output, SL_OK);
}

void sl_compare_eye_print_columns(void) {
    puts("\ncolumns of eye.csv, a line for each cone and method; means over all viewpoints:\n"
         "  fov                 the view cone, degrees\n"
         "  method, guarantee   as 'sightline eye --help' lists them\n"
         "  share, reduction    the area kept, as a share of all inside; 1 / share\n"
         "  cells               those kept\n"
         "  nodes               cells looked at; exact: nodes of the stab tree visited\n"
         "  orientations        orientation tests\n"
         "  seconds             a query, on one thread (the median)\n"
         "  paper_share, paper_reduction\n"
         "                      what Teller & Sequin 1991 tell of Soda Hall");
}

static sl_json_fields fields_of_row(const sl_compare_eye_row *row) {
    sl_json_fields fields = sl_json_begin();
    double share, reduction;
    sl_json_add_real(&fields, "fov", row->fov);
    sl_json_add_text(&fields, "method", row->name);
    sl_json_add_text(&fields, "guarantee", sl_guarantee_name(row->guarantee));
    sl_json_add_real(&fields, "share", row->share);
    sl_json_add_real(&fields, "reduction", reduction_of(row));
    sl_json_add_real(&fields, "cells", row->cells);
    sl_json_add_real(&fields, "nodes", row->nodes);
    sl_json_add_real(&fields, "orientations", row->orientations);
    sl_json_add_real(&fields, "seconds", row->seconds);
    if (sl_compare_eye_paper(row->name, row->fov, &share, &reduction)) {
        sl_json_add_real(&fields, "paper_share", share);
        sl_json_add_real(&fields, "paper_reduction", reduction);
    }
    return fields;
}

sl_status sl_compare_eye_print_json(sl_context *context, const sl_compare_eye *comparison) {
    const sl_space *space = comparison->space;
    sl_json_fields *rows = sl_alloc_array(context, comparison->row_count, sizeof *rows);
    if (!rows) return SL_NO_MEMORY;
    for (size_t i = 0; i < comparison->row_count; i++)
        rows[i] = fields_of_row(&comparison->rows[i]);
    sl_json_fields fields = sl_json_begin();
    sl_json_add_text(&fields, "map", comparison->input);
    sl_json_add_text(&fields, "sight", sl_sight_name(comparison->sight));
    sl_json_add_count(&fields, "walls", space->wall_count);
    sl_json_add_count(&fields, "cells", space->cell_count);
    sl_json_add_count(&fields, "inside_cells", space->inside_count);
    sl_json_add_count(&fields, "portals", space->portal_count);
    sl_json_add_count(&fields, "viewpoints", comparison->plan->viewpoints);
    sl_json_add_count(&fields, "seed", comparison->plan->seed);
    sl_json_add_real(&fields, "cell_to_cell_seconds", comparison->pvs_seconds);
    sl_json_add_list(&fields, "rows", rows, comparison->row_count);
    sl_free(context, rows);
    return sl_json_print(context, &fields);
}

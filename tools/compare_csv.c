#include "cell_to_cell/pvs_rows.h"
#include "compare_columns.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <string.h>

static void write_value(FILE *stream, sl_value value) {
    char number[SL_NUMBER_TEXT];
    switch (value.kind) {
    case SL_VALUE_NONE:
        return;
    case SL_VALUE_TEXT:
        fputs(value.text, stream);
        return;
    case SL_VALUE_REAL:
        sl_number_write(value.real, number);
        fputs(number, stream);
        return;
    case SL_VALUE_COUNT:
        fprintf(stream, "%" PRIu64, value.count);
        return;
    }
}

sl_status sl_compare_write_csv(sl_context *context, const sl_comparison *comparison,
                               const char *path) {
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    size_t count;
    const sl_compare_column *columns = sl_compare_columns(&count);
    for (size_t i = 0; i < count; i++)
        fprintf(output.stream, "%s%s", i ? "," : "", columns[i].name);
    for (size_t k = 0; k < comparison->run_count; k++) {
        fputc('\n', output.stream);
        for (size_t i = 0; i < count; i++) {
            if (i) fputc(',', output.stream);
            write_value(output.stream, columns[i].value(comparison, &comparison->runs[k]));
        }
    }
    fputc('\n', output.stream);
    return sl_output_close(context, &output, SL_OK);
}

void sl_compare_print_columns(void) {
    size_t count;
    const sl_compare_column *columns = sl_compare_columns(&count);
    puts("\ncolumns of compare.csv, a line a run (empty where not known), and fields of --json:");
    for (size_t i = 0; i < count; i++) printf("  %-20s%s\n", columns[i].name, columns[i].what);
    puts("\ncolumns of pairs.csv, a line for each ordered pair on which two runs disagree:\n"
         "  a, b                the cells, by number\n"
         "  ax, ay, bx, by      a point in each\n"
         "  METHOD/SOLVER ...   1 where that run says that a sees b, else 0");
}

// --- pairs that runs disagree on

/// A point inside a cell: the mean of its corners.
static sl_point middle_of(const sl_space *space, uint32_t number) {
    const sl_cell *cell = &space->cells[number];
    const sl_point *corners = &space->vertices[cell->first_vertex];
    sl_point middle = {0, 0};
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        middle.x += corners[i].x / cell->vertex_count;
        middle.y += corners[i].y / cell->vertex_count;
    }
    return middle;
}

static void write_point(FILE *stream, sl_point point) {
    char x[SL_NUMBER_TEXT], y[SL_NUMBER_TEXT];
    sl_number_write(point.x, x);
    sl_number_write(point.y, y);
    fprintf(stream, ",%s,%s", x, y);
}

typedef struct disagreement {
    const sl_comparison *comparison;
    size_t words;
    sl_bits *rows; ///< of one cell: what each run sees, run by run
} disagreement;

static void write_pair(FILE *stream, const disagreement *d, uint32_t a, uint32_t b) {
    const sl_space *space = d->comparison->space;
    fprintf(stream, "%" PRIu32 ",%" PRIu32, a, b);
    write_point(stream, middle_of(space, a));
    write_point(stream, middle_of(space, b));
    for (size_t k = 0; k < d->comparison->run_count; k++)
        if (d->comparison->runs[k].outcome == SL_RUN_DONE)
            fprintf(stream, ",%d", sl_bits_has(d->rows + k * d->words, b));
    fputc('\n', stream);
}

static void write_pairs_of(FILE *stream, const disagreement *d, uint32_t a) {
    const sl_comparison *comparison = d->comparison;
    memset(d->rows, 0, comparison->run_count * d->words * sizeof *d->rows);
    for (size_t k = 0; k < comparison->run_count; k++)
        if (comparison->runs[k].outcome == SL_RUN_DONE)
            sl_row_add_to(&comparison->runs[k].visibility.pvs, a, d->rows + k * d->words);
    for (size_t word = 0; word < d->words; word++) {
        sl_bits some = 0, all = ~(sl_bits)0;
        for (size_t k = 0; k < comparison->run_count; k++) {
            if (comparison->runs[k].outcome != SL_RUN_DONE) continue;
            some |= d->rows[k * d->words + word];
            all &= d->rows[k * d->words + word];
        }
        for (uint32_t bit = 0; bit < 64 && some & ~all; bit++)
            if ((some & ~all) >> bit & 1) write_pair(stream, d, a, (uint32_t)(64 * word + bit));
    }
}

sl_status sl_compare_write_pairs(sl_context *context, const sl_comparison *comparison,
                                 const char *path) {
    disagreement d = {.comparison = comparison,
                      .words = sl_bits_words(comparison->space->cell_count)};
    d.rows = sl_alloc_array(context, comparison->run_count * d.words, sizeof *d.rows);
    if (!d.rows) return SL_NO_MEMORY;
    sl_output output;
    sl_status status = sl_output_open(context, path, &output);
    if (status == SL_OK) {
        fputs("a,b,ax,ay,bx,by", output.stream);
        for (size_t k = 0; k < comparison->run_count; k++) {
            const sl_compare_run *run = &comparison->runs[k];
            if (run->outcome == SL_RUN_DONE)
                fprintf(output.stream, ",%s%s%s", run->method->name, run->solver ? "/" : "",
                        run->solver ? run->solver->name : "");
        }
        fputc('\n', output.stream);
        for (uint32_t a = 0; a < comparison->space->cell_count && status == SL_OK; a++) {
            write_pairs_of(output.stream, &d, a);
            status = sl_check_cancelled(context);
        }
        status = sl_output_close(context, &output, status);
    }
    sl_free(context, d.rows);
    return status;
}

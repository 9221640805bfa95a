/// The results of a comparison as a table, as CSV and as JSON.
#include "studies/compare.h"

#include "arguments/names.h"
#include "reports/fields.h"
#include "reports/report.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <string.h>

typedef struct compare_column {
    const char *name, *what;
    table_field (*value)(const compare_result *comparison, const compare_run *run);
} compare_column;

// --- columns

/// "done", "not done", "refused"
static const char *outcome_name(run_outcome outcome) {
    static const char *const names[] = {
        [RUN_REFUSED] = "refused", [RUN_NOT_DONE] = "not done", [RUN_DONE] = "done"};
    return names[outcome];
}

static table_field of_text(const char *text) {
    return field_text(NULL, text);
}

static table_field real_if(bool known, double real) {
    return known ? field_real(NULL, real) : of_text(NULL);
}

static table_field count_if(bool known, uint64_t count) {
    return known ? field_count(NULL, count) : of_text(NULL);
}

static bool done(const compare_run *run) {
    return run->outcome == RUN_DONE;
}

static const sl_see_account *account(const compare_run *run) {
    return &run->visibility.account;
}

/// One function a column: its name, and the value it gives for `run`.
#define COLUMN(name, expression)                                                                   \
    static table_field column_##name(const compare_result *comparison, const compare_run *run) {   \
        (void)comparison, (void)run;                                                               \
        table_field field = expression;                                                            \
        field.key = #name;                                                                         \
        return field;                                                                              \
    }

COLUMN(method, of_text(run->method->name))
COLUMN(solver, of_text(run->solver ? run->solver->name : NULL))
COLUMN(sight, of_text(sight_name(comparison->sight)))
COLUMN(guarantee, of_text(sl_guarantee_name(run->guarantee)))
COLUMN(outcome, of_text(outcome_name(run->outcome)))
COLUMN(timings, count_if(done(run), run->timings))
COLUMN(seconds, real_if(done(run), run->seconds))
COLUMN(seconds_low, real_if(done(run), run->low))
COLUMN(seconds_high, real_if(done(run), run->high))
COLUMN(ratio, real_if(run->ratio > 0, run->ratio))
COLUMN(tests, count_if(done(run), account(run)->tests))
COLUMN(seconds_per_test,
       real_if(account(run)->tests > 0, run->seconds / (double)account(run)->tests))
COLUMN(tree_nodes, count_if(done(run), account(run)->nodes))
COLUMN(longest_sequence, count_if(done(run), account(run)->deepest))
COLUMN(pairs, count_if(done(run), account(run)->pairs))
COLUMN(pairs_too_many, count_if(run->judged, run->too_many))
COLUMN(pairs_too_few, count_if(run->judged, run->too_few))
COLUMN(doubtful_pairs, count_if(done(run), account(run)->doubtful_pairs))
COLUMN(frontier, count_if(run->judged, run->frontier))
COLUMN(orientations, count_if(done(run), account(run)->stab.orientations))
COLUMN(exact_orientations, count_if(done(run), account(run)->stab.exact))
COLUMN(filter_share,
       real_if(account(run)->stab.orientations > 0,
               1 - (double)account(run)->stab.exact / (double)account(run)->stab.orientations))
COLUMN(certified, count_if(done(run), account(run)->stab.certified))
COLUMN(fallbacks, count_if(done(run), account(run)->stab.fallbacks))

static const compare_column *compare_columns(size_t *count) {
#define ROW(name, what)                                                                            \
    { #name, what, column_##name }
    static const compare_column columns[] = {
        ROW(method, "how cells were searched"),
        ROW(solver, "what stabbed portal sequences"),
        ROW(sight, "closed or open"),
        ROW(guarantee, "what is promised of the answer"),
        ROW(outcome, "done; not done, in the time given; refused, as the map\n                     "
                     " asks for what the method cannot do"),
        ROW(timings, "how often the run was timed"),
        ROW(seconds, "for all cells: the median, on one thread"),
        ROW(seconds_low, "the lower quartile"),
        ROW(seconds_high, "the upper quartile"),
        ROW(ratio, "seconds, to those of the fastest exact run"),
        ROW(tests, "portal sequences tested for a sightline"),
        ROW(seconds_per_test, "seconds / tests"),
        ROW(tree_nodes, "sequences that have one"),
        ROW(longest_sequence, "portals in the longest of them"),
        ROW(pairs, "ordered pairs of cells seen, each with itself included"),
        ROW(pairs_too_many, "of them those hidden by the exact answer"),
        ROW(pairs_too_few, "pairs seen by the exact answer only"),
        ROW(doubtful_pairs, "pairs of which rounding decided"),
        ROW(frontier, "1: no run is as fast and as right, and better in one"),
        ROW(orientations, "orientation tests by the solver"),
        ROW(exact_orientations, "those that the filter left to exact arithmetic"),
        ROW(filter_share, "the share that the filter decided"),
        ROW(certified, "rounded verdicts that predicates confirmed"),
        ROW(fallbacks, "verdicts that an exact solver gave instead"),
    };
#undef ROW
    *count = sizeof columns / sizeof *columns;
    return columns;
}

// --- CSV

static size_t list_fields(const void *of, size_t row, table_field fields[FIELDS_MOST]) {
    const compare_result *comparison = of;
    size_t count;
    const compare_column *columns = compare_columns(&count);
    for (size_t i = 0; i < count; i++)
        fields[i] = columns[i].value(comparison, &comparison->runs[row]);
    return count;
}

static field_rows rows_of(const compare_result *comparison) {
    return (field_rows){list_fields, comparison, comparison->run_count};
}

sl_status compare_write_csv(sl_context *context, const compare_result *comparison,
                            const char *path) {
    const field_rows rows = rows_of(comparison);
    return fields_write_csv(context, &rows, path);
}

void compare_print_columns(void) {
    size_t count;
    const compare_column *columns = compare_columns(&count);
    puts("\ncolumns of compare.csv (a line for each run), and fields of --json:");
    for (size_t i = 0; i < count; i++) printf("  %-20s%s\n", columns[i].name, columns[i].what);
    puts("\ncolumns of pairs.csv, a line for each ordered pair on which two runs disagree:\n"
         "  a, b                the cells, by number\n"
         "  ax, ay, bx, by      a point in each\n"
         "  METHOD/SOLVER ...   1 where that run says that a sees b, else 0");
}

// --- pairs that runs disagree on

static void write_point(FILE *stream, sl_point point) {
    char x[SL_NUMBER_TEXT], y[SL_NUMBER_TEXT];
    sl_number_write(point.x, x);
    sl_number_write(point.y, y);
    fprintf(stream, ",%s,%s", x, y);
}

typedef struct disagreement {
    const compare_result *comparison;
    size_t words;
    sl_bits *rows; ///< of one cell: what each run sees, run by run
} disagreement;

static void write_pair(FILE *stream, const disagreement *d, uint32_t a, uint32_t b) {
    const sl_space *space = d->comparison->space;
    fprintf(stream, "%" PRIu32 ",%" PRIu32, a, b);
    write_point(stream, sl_space_middle(space, a));
    write_point(stream, sl_space_middle(space, b));
    for (size_t k = 0; k < d->comparison->run_count; k++)
        if (d->comparison->runs[k].outcome == RUN_DONE)
            fprintf(stream, ",%d", sl_bits_has(d->rows + k * d->words, b));
    fputc('\n', stream);
}

/// Sets the bits of the cells of a row.
static void add_row(const sl_pvs *pvs, uint32_t cell, sl_bits *set) {
    for (sl_pvs_run run = sl_pvs_begin(pvs, cell); sl_pvs_next(&run);)
        for (uint32_t c = run.first; c < run.end; c++) sl_bits_add(set, c);
}

static void write_pairs_of(FILE *stream, const disagreement *d, uint32_t a) {
    const compare_result *comparison = d->comparison;
    memset(d->rows, 0, comparison->run_count * d->words * sizeof *d->rows);
    for (size_t k = 0; k < comparison->run_count; k++)
        if (comparison->runs[k].outcome == RUN_DONE)
            add_row(&comparison->runs[k].visibility.pvs, a, d->rows + k * d->words);
    for (size_t word = 0; word < d->words; word++) {
        sl_bits some = 0, all = ~(sl_bits)0;
        for (size_t k = 0; k < comparison->run_count; k++) {
            if (comparison->runs[k].outcome != RUN_DONE) continue;
            some |= d->rows[k * d->words + word];
            all &= d->rows[k * d->words + word];
        }
        for (uint32_t bit = 0; bit < 64 && some & ~all; bit++)
            if ((some & ~all) >> bit & 1) write_pair(stream, d, a, (uint32_t)(64 * word + bit));
    }
}

sl_status compare_write_pairs(sl_context *context, const compare_result *comparison,
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
            const compare_run *run = &comparison->runs[k];
            if (run->outcome == RUN_DONE)
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

void run_name(const compare_run *run, char name[RUN_NAME]) {
    snprintf(name, RUN_NAME, "%s%s%s", run->method->name, run->solver ? " with " : "",
             run->solver ? run->solver->name : "");
}

// --- the table

/// "-" where it is not known.
static void write_count(bool known, uint64_t count, char text[24]) {
    if (known)
        snprintf(text, 24, "%" PRIu64, count);
    else
        snprintf(text, 24, "-");
}

static void print_names(const compare_run *run) {
    printf("  %-9s %-11s %-12s ", run->method->name, run->solver ? run->solver->name : "-",
           sl_guarantee_name(run->guarantee));
}

static void print_run(const compare_result *comparison, const compare_run *run) {
    const sl_see_account *account = &run->visibility.account;
    char seconds[SECONDS_TEXT], a_test[SECONDS_TEXT] = "-", ratio[24] = "-", many[24], few[24];
    print_names(run);
    if (run->outcome == RUN_NOT_DONE) {
        printf(" not done in %g s\n", comparison->limit);
        return;
    }
    if (run->outcome == RUN_REFUSED) {
        printf(" refused: %s\n", run->refusal);
        return;
    }
    seconds_write(run->seconds, "u", seconds);
    if (account->tests) seconds_write(run->seconds / (double)account->tests, "u", a_test);
    if (run->ratio > 0)
        snprintf(ratio, sizeof ratio, "%.*f", run->ratio < 99.95 ? 2 : 0, run->ratio);
    write_count(run->judged, run->too_many, many);
    write_count(run->judged, run->too_few, few);
    printf("%9s %9s%c %10" PRIu64 " %9s %10" PRIu64 " %9s %9s %9" PRIu64 "\n", seconds, ratio,
           run->frontier ? '*' : ' ', account->tests, a_test, account->pairs, many, few,
           account->doubtful_pairs);
}

static void print_stabbing(const compare_run *run) {
    const sl_stab_account *stab = &run->visibility.account.stab;
    char share[24] = "-";
    if (stab->orientations)
        snprintf(share, sizeof share, "%.3f %%",
                 100 * (1 - (double)stab->exact / (double)stab->orientations));
    print_names(run);
    printf("%12" PRIu64 " %12" PRIu64 " %11s %11" PRIu64 " %11" PRIu64 "\n", stab->orientations,
           stab->exact, share, stab->certified, stab->fallbacks);
}

static bool tells_of_stabbing(const compare_run *run) {
    const sl_stab_account *stab = &run->visibility.account.stab;
    return stab->orientations || stab->certified || stab->fallbacks;
}

static void print_all_stabbing(const compare_result *comparison) {
    bool headed = false;
    for (size_t i = 0; i < comparison->run_count; i++) {
        const compare_run *run = &comparison->runs[comparison->order[i]];
        if (!tells_of_stabbing(run)) continue;
        if (!headed)
            puts("\n  method    solver      guarantee    orientations   left exact   by filter   "
                 "certified   fallbacks");
        headed = true;
        print_stabbing(run);
    }
}

bool compare_all_agree(const compare_result *comparison) {
    for (size_t i = 0; i < comparison->run_count; i++) {
        const compare_run *run = &comparison->runs[i];
        if (run->judged && (run->too_many || run->too_few)) return false;
    }
    return true;
}

static void print_verdict(const compare_result *comparison) {
    char name[RUN_NAME];
    if (comparison->reference == NO_RUN) {
        puts("\nno exact run is done: pairs too many and too few are not known");
        return;
    }
    run_name(&comparison->runs[comparison->reference], name);
    printf("\ntoo many, too few: pairs beside those of %s, which is exact%s\n", name,
           compare_all_agree(comparison) ? "; all runs that are done agree on every pair" : "");
    puts("ratio: of seconds to those of the fastest exact run; * on the frontier: no other run is\n"
         "as fast and as right, and better in one of the two");
}

void compare_print(const compare_result *comparison) {
    const sl_space *space = comparison->space;
    printf("%s: %" PRIu32 " walls after cleaning, %" PRIu32 " cells, %" PRIu32
           " portals; %s sight, one thread\n",
           comparison->input, space->wall_count, space->cell_count, space->portal_count,
           sight_name(comparison->sight));
    ground_print(space);
    puts("\n  method    solver      guarantee      seconds     ratio       tests  per test      "
         "pairs  too many   too few  doubtful");
    for (size_t i = 0; i < comparison->run_count; i++)
        print_run(comparison, &comparison->runs[comparison->order[i]]);
    print_all_stabbing(comparison);
    print_verdict(comparison);
    compare_subdivisions_print(&comparison->subdivisions);
}

// --- JSON

sl_status compare_print_json(sl_context *context, const compare_result *comparison) {
    const sl_space *space = comparison->space;
    const field_rows rows = rows_of(comparison);
    char reference[RUN_NAME] = "";
    if (comparison->reference != NO_RUN)
        run_name(&comparison->runs[comparison->reference], reference);
    json_fields fields = json_begin();
    json_add_text(&fields, "map", comparison->input);
    json_add_text(&fields, "sight", sight_name(comparison->sight));
    json_add_count(&fields, "walls", space->wall_count);
    json_add_count(&fields, "cells", space->cell_count);
    ground_add_json(&fields, space);
    json_add_count(&fields, "portals", space->portal_count);
    json_add_count(&fields, "threads", 1);
    json_add_real(&fields, "time_limit", comparison->limit);
    json_add_text(&fields, "reference", reference[0] ? reference : NULL);
    fields_add_json(&fields, "runs", &rows);
    compare_subdivisions_add_json(&fields, &comparison->subdivisions);
    return json_print(context, &fields);
}

#include "compare_report.h"

#include "compare_columns.h"
#include "json_print.h"
#include "names.h"
#include "sightline/support.h"

#include <inttypes.h>

void sl_run_name(const sl_compare_run *run, char name[SL_RUN_NAME]) {
    snprintf(name, SL_RUN_NAME, "%s%s%s", run->method->name, run->solver ? " with " : "",
             run->solver ? run->solver->name : "");
}

void sl_seconds_write(double seconds, const char *micro, char text[SL_SECONDS_TEXT]) {
    const char *const units[] = {"s", "ms", micro, "ns"};
    int unit = 0;
    // What would round up to 1000 of a unit belongs to the next larger.
    for (; unit < 3 && seconds < 0.9995; unit++) seconds *= 1000;
    const int decimals = seconds < 9.995 ? 2 : seconds < 99.95 ? 1 : 0;
    snprintf(text, SL_SECONDS_TEXT, "%.*f %s%s", decimals, seconds, units[unit],
             unit == 2 ? "s" : "");
}

// --- the table

/// "-" where it is not known.
static void write_count(bool known, uint64_t count, char text[24]) {
    if (known)
        snprintf(text, 24, "%" PRIu64, count);
    else
        snprintf(text, 24, "-");
}

static void print_names(const sl_compare_run *run) {
    printf("  %-9s %-11s %-12s ", run->method->name, run->solver ? run->solver->name : "-",
           sl_guarantee_name(run->guarantee));
}

static void print_run(const sl_comparison *comparison, const sl_compare_run *run) {
    const sl_see_account *account = &run->visibility.account;
    char seconds[SL_SECONDS_TEXT], a_test[SL_SECONDS_TEXT] = "-", ratio[24] = "-", many[24],
                                   few[24];
    print_names(run);
    if (run->outcome == SL_RUN_NOT_DONE) {
        printf(" not done in %g s\n", comparison->limit);
        return;
    }
    if (run->outcome == SL_RUN_REFUSED) {
        printf(" refused: %s\n", run->refusal);
        return;
    }
    sl_seconds_write(run->seconds, "u", seconds);
    if (account->tests) sl_seconds_write(run->seconds / (double)account->tests, "u", a_test);
    if (run->ratio > 0)
        snprintf(ratio, sizeof ratio, "%.*f", run->ratio < 99.95 ? 2 : 0, run->ratio);
    write_count(run->judged, run->too_many, many);
    write_count(run->judged, run->too_few, few);
    printf("%9s %9s%c %10" PRIu64 " %9s %10" PRIu64 " %9s %9s %9" PRIu64 "\n", seconds, ratio,
           run->frontier ? '*' : ' ', account->tests, a_test, account->pairs, many, few,
           account->doubtful_pairs);
}

static void print_stabbing(const sl_compare_run *run) {
    const sl_stab_account *stab = &run->visibility.account.stab;
    char share[24] = "-";
    if (stab->orientations)
        snprintf(share, sizeof share, "%.3f %%",
                 100 * (1 - (double)stab->exact / (double)stab->orientations));
    print_names(run);
    printf("%12" PRIu64 " %12" PRIu64 " %11s %11" PRIu64 " %11" PRIu64 "\n", stab->orientations,
           stab->exact, share, stab->certified, stab->fallbacks);
}

static bool tells_of_stabbing(const sl_compare_run *run) {
    const sl_stab_account *stab = &run->visibility.account.stab;
    return stab->orientations || stab->certified || stab->fallbacks;
}

static void print_all_stabbing(const sl_comparison *comparison) {
    bool headed = false;
    for (size_t i = 0; i < comparison->run_count; i++) {
        const sl_compare_run *run = &comparison->runs[comparison->order[i]];
        if (!tells_of_stabbing(run)) continue;
        if (!headed)
            puts("\n  method    solver      guarantee    orientations   left exact   by filter   "
                 "certified   fallbacks");
        headed = true;
        print_stabbing(run);
    }
}

bool sl_compare_all_agree(const sl_comparison *comparison) {
    for (size_t i = 0; i < comparison->run_count; i++) {
        const sl_compare_run *run = &comparison->runs[i];
        if (run->judged && (run->too_many || run->too_few)) return false;
    }
    return true;
}

static void print_verdict(const sl_comparison *comparison) {
    char name[SL_RUN_NAME];
    if (comparison->reference == SL_NO_RUN) {
        puts("\nno exact run is done: pairs too many and too few are not known");
        return;
    }
    sl_run_name(&comparison->runs[comparison->reference], name);
    printf("\ntoo many, too few: pairs beside those of %s, which is exact%s\n", name,
           sl_compare_all_agree(comparison) ? "; all runs that are done agree on every pair" : "");
    puts("ratio: of seconds to those of the fastest exact run; * on the frontier: no other run is\n"
         "as fast and as right, and better in one of the two");
}

void sl_compare_print(const sl_comparison *comparison) {
    const sl_space *space = comparison->space;
    printf("%s: %" PRIu32 " walls, %" PRIu32 " cells, %" PRIu32 " portals; %s sight, one thread\n",
           comparison->input, space->wall_count, space->cell_count, space->portal_count,
           sl_sight_name(comparison->sight));
    puts("\n  method    solver      guarantee      seconds     ratio       tests  per test      "
         "pairs  too many   too few  doubtful");
    for (size_t i = 0; i < comparison->run_count; i++)
        print_run(comparison, &comparison->runs[comparison->order[i]]);
    print_all_stabbing(comparison);
    print_verdict(comparison);
    sl_compare_subdivisions_print(&comparison->subdivisions);
}

// --- JSON

static void add_value(sl_json_fields *fields, const char *key, sl_value value) {
    switch (value.kind) {
    case SL_VALUE_NONE:
        sl_json_add_text(fields, key, NULL);
        return;
    case SL_VALUE_TEXT:
        sl_json_add_text(fields, key, value.text);
        return;
    case SL_VALUE_REAL:
        sl_json_add_real(fields, key, value.real);
        return;
    case SL_VALUE_COUNT:
        sl_json_add_count(fields, key, value.count);
        return;
    }
}

static sl_json_fields fields_of_run(const sl_comparison *comparison, const sl_compare_run *run) {
    size_t count;
    const sl_compare_column *columns = sl_compare_columns(&count);
    sl_json_fields fields = sl_json_begin();
    for (size_t i = 0; i < count; i++)
        add_value(&fields, columns[i].name, columns[i].value(comparison, run));
    return fields;
}

sl_status sl_compare_print_json(sl_context *context, const sl_comparison *comparison) {
    const sl_space *space = comparison->space;
    char reference[SL_RUN_NAME] = "";
    if (comparison->reference != SL_NO_RUN)
        sl_run_name(&comparison->runs[comparison->reference], reference);
    sl_json_fields *runs = sl_alloc_array(context, comparison->run_count, sizeof *runs);
    if (!runs) return SL_NO_MEMORY;
    for (size_t i = 0; i < comparison->run_count; i++)
        runs[i] = fields_of_run(comparison, &comparison->runs[i]);
    sl_json_fields fields = sl_json_begin();
    sl_json_add_text(&fields, "map", comparison->input);
    sl_json_add_text(&fields, "sight", sl_sight_name(comparison->sight));
    sl_json_add_count(&fields, "walls", space->wall_count);
    sl_json_add_count(&fields, "cells", space->cell_count);
    sl_json_add_count(&fields, "portals", space->portal_count);
    sl_json_add_count(&fields, "threads", 1);
    sl_json_add_real(&fields, "time_limit", comparison->limit);
    sl_json_add_text(&fields, "reference", reference[0] ? reference : NULL);
    sl_json_add_list(&fields, "runs", runs, comparison->run_count);
    sl_compare_subdivisions_add_json(&fields, &comparison->subdivisions);
    sl_free(context, runs);
    return sl_json_print(context, &fields);
}

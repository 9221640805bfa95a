/// Times runs: again and again until the time is known, within a limit.
#include "studies/compare.h"

#include "reports/report.h"
#include "sightline/support.h"
#include "system/deadline.h"

#include <inttypes.h>

/// Default of --repeat: at least three runs and 0.2 seconds, but none after 5 seconds.
enum { LEAST_TIMINGS = 3 };
#define ENOUGH_SECONDS 0.2
#define MOST_SECONDS   5.0

static bool is_enough(const run_timing *timing, size_t count, double sum) {
    if (timing->repeat) return count >= timing->repeat;
    return (count >= LEAST_TIMINGS && sum >= ENOUGH_SECONDS) || sum >= MOST_SECONDS;
}

typedef SL_ARRAY(double) durations;

/// Runs until the time is known well enough. Keeps the first answer; the others are the same.
static sl_status run_often(sl_context *context, deadline *limit, const sl_space *space,
                           const sl_see_options *options, const run_timing *timing,
                           durations *taken, compare_run *run) {
    double sum = 0;
    while (!is_enough(timing, taken->count, sum)) {
        SL_TRY(SL_ARRAY_ROOM(context, taken, 1));
        sl_visibility visibility = {0};
        const double start = sl_seconds();
        limit->at = start + timing->limit;
        SL_TRY(run->method->see(context, space, options, &visibility));
        const double seconds = sl_seconds() - start;
        if (taken->count)
            sl_visibility_destroy(context, &visibility);
        else
            run->visibility = visibility;
        taken->items[taken->count++] = seconds;
        sum += seconds;
    }
    return SL_OK;
}

static void summarise(const durations *taken, compare_run *run) {
    const size_t n = taken->count;
    sort_doubles(taken->items, n);
    run->timings = (unsigned)n;
    run->low = taken->items[(n - 1) / 4];
    run->high = taken->items[n - 1 - (n - 1) / 4];
    run->seconds = (taken->items[(n - 1) / 2] + taken->items[n / 2]) / 2;
}

sl_status compare_time(command_console *console, const sl_space *space,
                       const sl_see_options *options, const run_timing *timing, const char *label,
                       compare_run *run) {
    deadline limit = {.label = label};
    sl_context *context;
    SL_TRY(deadline_open(console, &limit, &context));
    durations taken = {0};
    sl_status status = run_often(context, &limit, space, options, timing, &taken, run);
    run->outcome = RUN_DONE;
    if (status == SL_UNSUPPORTED)
        snprintf(run->refusal, sizeof run->refusal, "%s", sl_context_message(context));
    if (status == SL_UNSUPPORTED || (status == SL_CANCELLED && limit.late)) {
        run->outcome = status == SL_UNSUPPORTED ? RUN_REFUSED : RUN_NOT_DONE;
        status = SL_OK;
    }
    if (taken.count && status == SL_OK) {
        run->outcome = RUN_DONE; // a later run that was late, or none
        summarise(&taken, run);
    }
    if (status != SL_OK) sl_fail(console->context, status, "%s", sl_context_message(context));
    sl_free(context, taken.items);
    sl_context_destroy(context);
    return status;
}

// --- subdivisions

static sl_status time_one(command_console *console, const sl_map *map,
                          const sl_see_options *options, const run_timing *timing,
                          const compare_run *like, compare_subdivision *one) {
    sl_context *context = console->context;
    sl_space space = {0};
    compare_run run = {.method = like->method, .solver = like->solver};
    char label[64];
    const double start = sl_seconds();
    SL_TRY(one->subdivision->subdivide(context, map, NULL, &space));
    one->subdivide_seconds = sl_seconds() - start;
    one->cells = space.cell_count;
    one->portals = space.portal_count;
    snprintf(label, sizeof label, "%s, %s", one->subdivision->name, like->method->name);
    const sl_status status = compare_time(console, &space, options, timing, label, &run);
    one->done = run.outcome == RUN_DONE;
    one->seconds = run.seconds;
    one->pairs = run.visibility.account.pairs;
    sl_visibility_destroy(context, &run.visibility);
    sl_space_destroy(context, &space);
    return status;
}

sl_status compare_subdivisions_time(command_console *console, const sl_map *map,
                                    const sl_see_options *options, const run_timing *timing,
                                    const compare_run *like, compare_subdivisions *out) {
    size_t count;
    const sl_subdivision *ways = sl_subdivisions(&count);
    sl_see_options see = *options;
    see.solver = out->solver = like->solver;
    out->method = like->method;
    for (size_t i = 0; i < count && out->count < SUBDIVISIONS_MOST; i++) {
        if (ways[i].takes_cells) continue;
        compare_subdivision *one = &out->items[out->count++];
        *one = (compare_subdivision){.subdivision = &ways[i]};
        SL_TRY(time_one(console, map, &see, timing, like, one));
    }
    return SL_OK;
}

static void print_one(const compare_subdivision *one) {
    char subdivide[SECONDS_TEXT], seconds[SECONDS_TEXT];
    seconds_write(one->subdivide_seconds, "u", subdivide);
    seconds_write(one->seconds, "u", seconds);
    printf("  %-12s %8" PRIu32 " %9" PRIu32 " %10s ", one->subdivision->name, one->cells,
           one->portals, subdivide);
    if (one->done)
        printf("%9s %11" PRIu64 "\n", seconds, one->pairs);
    else
        puts(" not done");
}

void compare_subdivisions_print(const compare_subdivisions *all) {
    if (!all->count) return;
    puts("\n  subdivision     cells   portals  subdivide   seconds       pairs");
    for (size_t i = 0; i < all->count; i++) print_one(&all->items[i]);
    printf("\nseconds and pairs of each subdivision: by %s%s%s, the fastest exact run; pairs of\n"
           "different cells: they are no measure of how right a subdivision is\n",
           all->method->name, all->solver ? " with " : "", all->solver ? all->solver->name : "");
}

void compare_subdivisions_add_json(json_fields *fields, const compare_subdivisions *all) {
    if (!all->count) return;
    json_open_list(fields, "subdivisions");
    for (size_t i = 0; i < all->count; i++) {
        const compare_subdivision *one = &all->items[i];
        json_open_item(fields);
        json_add_text(fields, "name", one->subdivision->name);
        json_add_count(fields, "cells", one->cells);
        json_add_count(fields, "portals", one->portals);
        json_add_real(fields, "subdivide_seconds", one->subdivide_seconds);
        json_add_text(fields, "method", all->method->name);
        json_add_text(fields, "solver", all->solver ? all->solver->name : NULL);
        json_add_flag(fields, "done", one->done);
        json_add_real(fields, "seconds", one->seconds);
        json_add_count(fields, "pairs", one->pairs);
        json_close(fields);
    }
    json_close_list(fields);
}

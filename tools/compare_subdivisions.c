#include "compare_subdivisions.h"

#include "compare_report.h"
#include "sightline/support.h"

#include <inttypes.h>

static sl_status time_one(sl_console *console, const sl_map *map, const sl_see_options *options,
                          const sl_timing *timing, const sl_compare_run *like,
                          sl_compare_subdivision *one) {
    sl_context *context = console->context;
    sl_space space = {0};
    sl_compare_run run = {.method = like->method, .solver = like->solver};
    char label[64];
    const double start = sl_now();
    SL_TRY(one->subdivision->subdivide(context, map, NULL, &space));
    one->subdivide_seconds = sl_now() - start;
    one->cells = space.cell_count;
    one->portals = space.portal_count;
    snprintf(label, sizeof label, "%s, %s", one->subdivision->name, like->method->name);
    const sl_status status = sl_compare_time(console, &space, options, timing, label, &run);
    one->done = run.outcome == SL_RUN_DONE;
    one->seconds = run.seconds;
    one->pairs = run.visibility.account.pairs;
    sl_visibility_destroy(context, &run.visibility);
    sl_space_destroy(context, &space);
    return status;
}

sl_status sl_compare_subdivisions_time(sl_console *console, const sl_map *map,
                                       const sl_see_options *options, const sl_timing *timing,
                                       const sl_compare_run *like, sl_compare_subdivisions *out) {
    size_t count;
    const sl_subdivision *ways = sl_subdivisions(&count);
    sl_see_options see = *options;
    see.solver = out->solver = like->solver;
    out->method = like->method;
    for (size_t i = 0; i < count && out->count < SL_SUBDIVISIONS_MOST; i++) {
        if (ways[i].takes_cells) continue;
        sl_compare_subdivision *one = &out->items[out->count++];
        *one = (sl_compare_subdivision){.subdivision = &ways[i]};
        SL_TRY(time_one(console, map, &see, timing, like, one));
    }
    return SL_OK;
}

static void print_one(const sl_compare_subdivision *one) {
    char subdivide[SL_SECONDS_TEXT], seconds[SL_SECONDS_TEXT];
    sl_seconds_write(one->subdivide_seconds, "u", subdivide);
    sl_seconds_write(one->seconds, "u", seconds);
    printf("  %-12s %8" PRIu32 " %9" PRIu32 " %10s ", one->subdivision->name, one->cells,
           one->portals, subdivide);
    if (one->done)
        printf("%9s %11" PRIu64 "\n", seconds, one->pairs);
    else
        puts(" not done");
}

void sl_compare_subdivisions_print(const sl_compare_subdivisions *all) {
    if (!all->count) return;
    puts("\n  subdivision     cells   portals  subdivide   seconds       pairs");
    for (size_t i = 0; i < all->count; i++) print_one(&all->items[i]);
    printf("\nseconds and pairs of each subdivision: by %s%s%s, the fastest exact run\n",
           all->method->name, all->solver ? " with " : "", all->solver ? all->solver->name : "");
}

void sl_compare_subdivisions_add_json(sl_json_fields *fields, const sl_compare_subdivisions *all) {
    sl_json_fields list[SL_SUBDIVISIONS_MOST];
    for (size_t i = 0; i < all->count; i++) {
        const sl_compare_subdivision *one = &all->items[i];
        list[i] = sl_json_begin();
        sl_json_add_text(&list[i], "name", one->subdivision->name);
        sl_json_add_count(&list[i], "cells", one->cells);
        sl_json_add_count(&list[i], "portals", one->portals);
        sl_json_add_real(&list[i], "subdivide_seconds", one->subdivide_seconds);
        sl_json_add_text(&list[i], "method", all->method->name);
        sl_json_add_text(&list[i], "solver", all->solver ? all->solver->name : NULL);
        sl_json_add_flag(&list[i], "done", one->done);
        sl_json_add_real(&list[i], "seconds", one->seconds);
        sl_json_add_count(&list[i], "pairs", one->pairs);
    }
    if (all->count) sl_json_add_list(fields, "subdivisions", list, all->count);
}

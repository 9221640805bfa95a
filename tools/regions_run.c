#include "regions_run.h"

#include <string.h>
#include <time.h>

const sl_regions_cost *sl_regions_cost_of(const sl_regions_row *row, const char *method) {
    for (size_t i = 0; i < row->cost_count; i++)
        if (strcmp(row->costs[i].method, method) == 0) return &row->costs[i];
    return NULL;
}

/// Of all threads: other programs on the machine make no difference to it.
static double processor_seconds(void) {
    struct timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static sl_status check_same(sl_context *context, const sl_from_region_result *a,
                            const sl_from_region_result *b, const char *first, const char *second) {
    const size_t bytes = (size_t)a->view_cells * a->words * sizeof *a->seen;
    if (memcmp(a->seen, b->seen, bytes) == 0) return SL_OK;
    return sl_fail(context, SL_BAD_INPUT,
                   "the methods '%s' and '%s' see different objects, which they must not: please "
                   "report it with the map",
                   first, second);
}

static sl_status run_methods(sl_context *context, const sl_regions *regions,
                             const sl_from_region_options *how, sl_regions_row *row,
                             sl_from_region_result results[SL_REGIONS_METHODS_MOST]) {
    size_t count;
    const sl_from_region_method *methods = sl_from_region_methods(&count);
    for (size_t i = 0; i < count && i < SL_REGIONS_METHODS_MOST; i++) {
        const double start = processor_seconds();
        SL_TRY(methods[i].see(context, regions, how, &results[i]));
        const sl_from_region_result *r = &results[i];
        const double asked = (double)r->images * row->counts.objects;
        row->costs[row->cost_count++] =
            (sl_regions_cost){.method = methods[i].name,
                              .seconds = processor_seconds() - start,
                              .refined = asked > 0 ? (double)r->refined / asked : 0,
                              .candidates = r->candidates,
                              .relations = r->relations};
        SL_TRY(check_same(context, &results[0], r, methods[0].name, methods[i].name));
    }
    row->images = results[0].images;
    row->rays = results[0].rays;
    row->pairs = sl_from_region_pairs(&results[0]);
    return SL_OK;
}

static void name_view_cells(const sl_regions_options *what, char *text, size_t size) {
    if (what->view_cells == SL_VIEW_CELLS_GRID)
        snprintf(text, size, "%u x %u", what->grid, what->grid);
    else
        snprintf(text, size, "%s", what->view_cells == SL_VIEW_CELLS_BOXES ? "boxes" : "leaves");
}

sl_status sl_regions_measure(sl_context *context, const sl_map *map, const char *name,
                             const sl_regions_options *what, const sl_from_region_options *how,
                             sl_regions_rows *rows) {
    sl_regions *regions;
    SL_TRY(SL_ARRAY_ROOM(context, rows, 1));
    SL_TRY(sl_regions_create(context, map, what, &regions));
    sl_regions_row row = {.counts = sl_regions_count(regions)};
    snprintf(row.map, sizeof row.map, "%s", name);
    name_view_cells(what, row.view_cells, sizeof row.view_cells);
    sl_from_region_result results[SL_REGIONS_METHODS_MOST] = {{0}};
    const sl_status status = run_methods(context, regions, how, &row, results);
    for (size_t i = 0; i < SL_REGIONS_METHODS_MOST; i++)
        sl_from_region_result_destroy(context, &results[i]);
    sl_regions_destroy(context, regions);
    if (status == SL_OK) rows->items[rows->count++] = row;
    return status;
}

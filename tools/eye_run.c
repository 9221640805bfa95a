#include "eye_run.h"

#include "progress_line.h"
#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>

/// A query is timed in rounds of at least ROUND_SECONDS; the median of ROUNDS is told.
enum { ROUNDS = 5, QUERIES_MOST = 1 << 20 };
#define ROUND_SECONDS 0.002

double sl_eye_reach(const sl_space *space) {
    const sl_box b = space->bounds;
    const double x = fmax(fabs(b.min.x), fabs(b.max.x)), y = fmax(fabs(b.min.y), fabs(b.max.y));
    return fmax(fmax(x, y), fmax(b.max.x - b.min.x, b.max.y - b.min.y));
}

static int compare_doubles(const void *left, const void *right) {
    const double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

/// A query of one kind, to be asked again and again.
typedef struct query {
    sl_context *context;
    const sl_eye_method *method; ///< NULL for the region
    sl_eye_search *search;
    const sl_outline *outline;
    const sl_view *view;
    sl_eye_result *result;
    sl_region *region;
    double range;
} query;

static sl_status ask(const query *q) {
    if (!q->method) return sl_region_make(q->context, q->outline, q->view, q->range, q->region);
    return q->method->cull(q->context, q->search, q->view, q->result->cells, &q->result->account);
}

static sl_status time_queries(const query *q, double *out) {
    double seconds[ROUNDS];
    size_t queries = 1;
    for (int round = 0; round < ROUNDS;) {
        const double start = sl_now();
        for (size_t i = 0; i < queries; i++) SL_TRY(ask(q));
        const double taken = sl_now() - start;
        if (taken < ROUND_SECONDS && queries < QUERIES_MOST) {
            queries *= 2;
            continue;
        }
        seconds[round++] = taken / (double)queries;
        SL_TRY(sl_check_cancelled(q->context));
    }
    qsort(seconds, ROUNDS, sizeof *seconds, compare_doubles);
    *out = seconds[ROUNDS / 2];
    return SL_OK;
}

/// The area of the cells on a cell's side of sl_baked_counts.
static double area_of_side(const sl_baked *baked, uint32_t cell) {
    const bool side = sl_baked_counts(baked, cell);
    double whole = 0;
    for (uint32_t c = 0; c < baked->space.cell_count; c++)
        if (sl_baked_counts(baked, c) == side) whole += sl_space_area(&baked->space, c);
    return whole;
}

void sl_eye_measure(const sl_baked *baked, uint32_t eye_cell, const uint64_t *cells,
                    uint32_t *count, double *share) {
    const sl_space *space = &baked->space;
    const bool side = sl_baked_counts(baked, eye_cell);
    const double whole = area_of_side(baked, eye_cell);
    double kept = 0;
    for (uint32_t c = 0; c < space->cell_count; c++) {
        const bool seen = sl_eye_sees(cells, c);
        const double area = sl_baked_counts(baked, c) == side ? sl_space_area(space, c) : 0;
        kept += seen ? area : 0;
        *count += seen;
    }
    *share = whole > 0 ? kept / whole : 0;
}

/// What a method keeps of what is seen by mirror, if it knows.
static sl_status run_mirrored(sl_context *context, const sl_baked *baked,
                              const sl_eye_method *method, sl_eye_search *search, sl_eye_run *run,
                              sl_eye_result *result) {
    if (!run->has_mirrors || !method->mirrored) return SL_OK;
    sl_eye_account account;
    result->mirrored =
        sl_alloc_array(context, sl_eye_words(&baked->space), sizeof *result->mirrored);
    if (!result->mirrored) return SL_NO_MEMORY;
    SL_TRY(method->mirrored(context, search, &run->view, result->mirrored, &account));
    result->rounded = account.rounded;
    sl_eye_measure(baked, run->cell, result->mirrored, &result->mirrored_count,
                   &result->mirrored_share);
    return SL_OK;
}

static sl_status run_methods(sl_context *context, const sl_baked *baked, sl_eye_search *search,
                             bool timed, sl_eye_run *run) {
    const sl_eye_method *methods = sl_eye_methods(&run->result_count);
    run->results = sl_alloc_array(context, run->result_count, sizeof *run->results);
    if (!run->results) return SL_NO_MEMORY;
    for (size_t i = 0; i < run->result_count; i++) {
        sl_eye_result *result = &run->results[i];
        result->cells = sl_alloc_array(context, sl_eye_words(&baked->space), sizeof *result->cells);
        if (!result->cells) return SL_NO_MEMORY;
        const query q = {.context = context,
                         .method = &methods[i],
                         .search = search,
                         .view = &run->view,
                         .result = result};
        SL_TRY(timed ? time_queries(&q, &result->seconds) : ask(&q));
        sl_eye_measure(baked, run->cell, result->cells, &result->count, &result->share);
        SL_TRY(run_mirrored(context, baked, &methods[i], search, run, result));
    }
    return SL_OK;
}

static sl_status run_region(sl_context *context, const sl_baked *baked, bool timed,
                            sl_eye_run *run) {
    sl_outline outline;
    SL_TRY(sl_outline_make(context, &baked->space, &outline));
    const query q = {.context = context,
                     .outline = &outline,
                     .view = &run->view,
                     .range = run->range,
                     .region = &run->region};
    sl_status status = timed ? time_queries(&q, &run->region_seconds) : ask(&q);
    sl_room_mirrors mirrors = {0};
    if (status == SL_OK && run->has_mirrors) {
        status = sl_room_mirrors_make(context, &outline, &baked->map, &mirrors);
        if (status == SL_OK)
            status = sl_mirrored_region_make(context, &mirrors, &run->view, run->range,
                                             run->mirror_depth, &run->mirrored);
        sl_room_mirrors_destroy(context, &mirrors);
    }
    sl_outline_destroy(context, &outline);
    const double whole = area_of_side(baked, run->cell);
    run->region_share = whole > 0 ? sl_region_area(&run->region) / whole : 0;
    return status;
}

sl_status sl_eye_run_make(sl_context *context, const sl_baked *baked, const sl_view *view,
                          uint32_t depth, double range, bool timed, sl_eye_run *out) {
    sl_eye_search *search;
    sl_eye_run run = {.view = *view,
                      .cell = sl_space_locate(&baked->space, view->eye),
                      .has_mirrors = baked->map.mirror_count > 0,
                      .mirror_depth = depth,
                      .range = range};
    SL_TRY(sl_eye_search_create(context, &baked->space, &baked->visibility, &search));
    sl_eye_search_limit(search, range);
    sl_status status =
        run.has_mirrors ? sl_eye_search_add_mirrors(context, search, &baked->map, depth) : SL_OK;
    if (status == SL_OK) status = run_methods(context, baked, search, timed, &run);
    if (status == SL_OK) status = run_region(context, baked, timed, &run);
    sl_eye_search_destroy(context, search);
    if (status == SL_OK)
        *out = run;
    else
        sl_eye_run_destroy(context, &run);
    return status;
}

void sl_eye_run_destroy(sl_context *context, sl_eye_run *run) {
    for (size_t i = 0; run->results && i < run->result_count; i++) {
        sl_free(context, run->results[i].cells);
        sl_free(context, run->results[i].mirrored);
    }
    sl_free(context, run->results);
    sl_region_destroy(context, &run->region);
    sl_mirrored_region_destroy(context, &run->mirrored);
    *run = (sl_eye_run){0};
}

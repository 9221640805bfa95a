#include "eye_run.h"

#include "base/base.h"
#include "progress_line.h"

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

static sl_status time_queries(sl_context *context, sl_eye_search *search,
                              const sl_eye_method *method, const sl_view *view,
                              sl_eye_result *result) {
    double seconds[ROUNDS];
    size_t queries = 1;
    for (int round = 0; round < ROUNDS;) {
        const double start = sl_now();
        for (size_t i = 0; i < queries; i++)
            SL_TRY(method->cull(context, search, view, result->cells, &result->account));
        const double taken = sl_now() - start;
        if (taken < ROUND_SECONDS && queries < QUERIES_MOST) {
            queries *= 2;
            continue;
        }
        seconds[round++] = taken / (double)queries;
        SL_TRY(sl_check_cancelled(context));
    }
    qsort(seconds, ROUNDS, sizeof *seconds, compare_doubles);
    result->seconds = seconds[ROUNDS / 2];
    return SL_OK;
}

static void measure(const sl_baked *baked, uint32_t eye_cell, sl_eye_result *result) {
    const sl_space *space = &baked->space;
    const bool side = sl_baked_counts(baked, eye_cell);
    double whole = 0, kept = 0;
    for (uint32_t c = 0; c < space->cell_count; c++) {
        const bool seen = sl_eye_sees(result->cells, c);
        const double area = sl_baked_counts(baked, c) == side ? sl_space_area(space, c) : 0;
        whole += area;
        kept += seen ? area : 0;
        result->count += seen;
    }
    result->share = whole > 0 ? kept / whole : 0;
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
        if (timed)
            SL_TRY(time_queries(context, search, &methods[i], &run->view, result));
        else
            SL_TRY(methods[i].cull(context, search, &run->view, result->cells, &result->account));
        measure(baked, run->cell, result);
    }
    return SL_OK;
}

sl_status sl_eye_run_make(sl_context *context, const sl_baked *baked, const sl_view *view,
                          bool timed, sl_eye_run *out) {
    sl_eye_search *search;
    sl_eye_run run = {.view = *view, .cell = sl_space_locate(&baked->space, view->eye)};
    SL_TRY(sl_eye_search_create(context, &baked->space, &baked->visibility, &search));
    const sl_status status = run_methods(context, baked, search, timed, &run);
    sl_eye_search_destroy(context, search);
    if (status == SL_OK)
        *out = run;
    else
        sl_eye_run_destroy(context, &run);
    return status;
}

void sl_eye_run_destroy(sl_context *context, sl_eye_run *run) {
    for (size_t i = 0; run->results && i < run->result_count; i++)
        sl_free(context, run->results[i].cells);
    sl_free(context, run->results);
    *run = (sl_eye_run){0};
}

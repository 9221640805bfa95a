/// A welding tolerance for a map whose walls miss each other by rounding.
///
/// The gaps of such a map come in two sizes: those of rounding, and those that are meant, such as
/// a slit or a door. Sorted by width there is a step between them:
///
///     width   ........  ::::::                      |    |   |     |
///             rounding          ^ the tolerance     slits, the shortest wall
///
/// The widest step (as a ratio) is looked for. The tolerance lies above it, with room for walls
/// that overshoot or are rounded more than those that were found. Then the map is cleaned with it
/// for trial: it is suggested only if it leaves no gap up to that width. Time: that of two
/// searches.
#include "space/faults.h"

#include <stdlib.h>

enum {
    LEAST_STEP = 8, ///< between rounding and what is meant, as a ratio
    ROOM = 4,       ///< between the widest gap of rounding and the tolerance
};

static int compare(const void *left, const void *right) {
    const double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

/// The widths of a map's gaps up to `widest`, and its walls' lengths that are above 0; sorted.
typedef struct widths {
    SL_ARRAY(double) gaps;
    SL_ARRAY(double) walls;
} widths;

static sl_status find_gaps(sl_context *context, const sl_map *map, double widest, widths *out) {
    sli_fault_list gaps = {0};
    out->gaps.count = 0;
    sl_status status = sli_list_gaps(context, map, widest, false, &gaps);
    if (status == SL_OK) status = SL_ARRAY_ROOM(context, &out->gaps, gaps.count);
    for (size_t i = 0; i < gaps.count && status == SL_OK; i++)
        if (gaps.items[i].size > 0) out->gaps.items[out->gaps.count++] = gaps.items[i].size;
    sl_free(context, gaps.items);
    if (out->gaps.count) qsort(out->gaps.items, out->gaps.count, sizeof(double), compare);
    return status;
}

static sl_status find_lengths(sl_context *context, const sl_map *map, widths *out) {
    for (size_t i = 0; i < map->wall_count; i++) {
        const double length = sli_apart(map->walls[i].a, map->walls[i].b);
        if (!(length > 0)) continue;
        SL_TRY(SL_ARRAY_ROOM(context, &out->walls, 1));
        out->walls.items[out->walls.count++] = length;
    }
    if (out->walls.count) qsort(out->walls.items, out->walls.count, sizeof(double), compare);
    return SL_OK;
}

/// The shortest wall that is longer than `width`; HUGE_VAL for none.
static double wall_above(const widths *w, double width) {
    size_t low = 0, high = w->walls.count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (w->walls.items[middle] > width)
            high = middle;
        else
            low = middle + 1;
    }
    return low < w->walls.count ? w->walls.items[low] : HUGE_VAL;
}

/// The tolerance at the widest step; 0 where no step is wide enough.
static double tolerance_at_step(const widths *w) {
    double step = LEAST_STEP, tolerance = 0;
    for (size_t i = 0; i < w->gaps.count; i++) {
        const double width = w->gaps.items[i];
        double next = wall_above(w, width);
        if (i + 1 < w->gaps.count) next = fmin(next, w->gaps.items[i + 1]);
        if (!(next / width > step)) continue;
        step = next / width;
        tolerance = fmin(ROOM * width, sqrt(width) * sqrt(next));
    }
    if (!(tolerance > 0)) return 0;
    // Rounded up to one digit where that stays below the step.
    const double unit = pow(10, floor(log10(tolerance)));
    const double round = ceil(tolerance / unit) * unit;
    return round < 2 * tolerance ? round : tolerance;
}

static sl_status suggest(sl_context *context, const sl_map *map, widths *w, sl_map *copy,
                         double *weld) {
    const sl_box box = sl_map_bounds(map);
    SL_TRY(find_gaps(context, map, sli_apart(box.min, box.max) / 1000, w));
    SL_TRY(find_lengths(context, map, w));
    const double tolerance = tolerance_at_step(w);
    if (!(tolerance > 0)) return SL_OK;
    const sl_clean_options trial = {.weld = tolerance};
    SL_TRY(sl_map_copy(context, map, copy));
    const sl_status status = sl_map_clean(context, copy, &trial, NULL);
    if (status == SL_UNSUPPORTED) return SL_OK;
    SL_TRY(status);
    SL_TRY(find_gaps(context, copy, tolerance, w));
    if (!w->gaps.count) *weld = tolerance;
    return SL_OK;
}

sl_status sl_suggest_weld(sl_context *context, const sl_map *map, double *weld) {
    widths w = {0};
    sl_map copy = {0};
    *weld = 0;
    const sl_status status = map->wall_count ? suggest(context, map, &w, &copy, weld) : SL_OK;
    sl_map_destroy(context, &copy);
    sl_free(context, w.gaps.items);
    sl_free(context, w.walls.items);
    return status;
}

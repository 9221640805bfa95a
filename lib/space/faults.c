#include "space/faults.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *sl_fault_name(sl_fault_kind kind) {
    static const char *const names[] = {"leak",     "gap",  "overlap",
                                        "crossing", "thin", "unreachable"};
    return (size_t)kind < SL_FAULT_KINDS ? names[kind] : "?";
}

void sl_faults_destroy(sl_context *context, sl_faults *faults) {
    sl_free(context, faults->items);
    sl_free(context, faults->points);
    *faults = (sl_faults){0};
}

static int compare(const void *left, const void *right) {
    const sl_fault *a = left, *b = right;
    if (a->kind != b->kind) return a->kind < b->kind ? -1 : 1;
    const bool largest_first = a->kind == SL_FAULT_OVERLAP || a->kind == SL_FAULT_UNREACHABLE;
    if (a->size != b->size) return (a->size < b->size) == largest_first ? 1 : -1;
    for (int i = 0; i < 2; i++)
        if (a->walls[i] != b->walls[i]) return a->walls[i] < b->walls[i] ? -1 : 1;
    if (a->cell != b->cell) return a->cell < b->cell ? -1 : 1;
    if (a->at.a.x != b->at.a.x) return a->at.a.x < b->at.a.x ? -1 : 1;
    if (a->at.a.y != b->at.a.y) return a->at.a.y < b->at.a.y ? -1 : 1;
    return (a->first_point > b->first_point) - (a->first_point < b->first_point);
}

/// Walls that lie side by side in several squares are found in each of them.
static bool is_same(const sl_fault *a, const sl_fault *b) {
    return a->kind == b->kind && a->walls[0] == b->walls[0] && a->walls[1] == b->walls[1] &&
           a->walls[0] != UINT32_MAX && a->at.a.x == b->at.a.x && a->at.a.y == b->at.a.y;
}

static void finish(sl_fault_search *search, sl_faults *out) {
    sl_faults faults = {.items = search->faults.items,
                        .points = search->points.items,
                        .point_count = (uint32_t)search->points.count,
                        .has_starts = search->map->start_count > 0};
    if (search->faults.count) qsort(faults.items, search->faults.count, sizeof(sl_fault), compare);
    for (size_t i = 0; i < search->faults.count; i++) {
        const sl_fault fault = faults.items[i];
        if (faults.count && is_same(&faults.items[faults.count - 1], &fault)) continue;
        faults.items[faults.count++] = fault;
        faults.counts[fault.kind]++;
    }
    *out = faults;
}

sl_status sl_find_faults(sl_context *context, const sl_map *map, const sl_space *space,
                         const sl_faults_options *options, sl_faults *out) {
    const sl_box box = sl_map_bounds(map);
    const double usual = sl_apart(box.min, box.max) / 1000;
    sl_fault_search search = {.context = context, .map = map, .space = space, .options = *options};
    if (!(options->gap >= 0 && options->thin >= 0))
        return sl_fail(context, SL_BAD_ARGUMENT, "a gap or width cannot be less than 0");
    if (options->gap == 0) search.options.gap = usual;
    if (options->thin == 0) search.options.thin = usual;
    sl_status status = sl_find_wall_faults(&search);
    if (status == SL_OK) status = sl_find_space_faults(&search);
    if (status == SL_OK) {
        finish(&search, out);
        return SL_OK;
    }
    sl_free(context, search.faults.items);
    sl_free(context, search.points.items);
    return status;
}

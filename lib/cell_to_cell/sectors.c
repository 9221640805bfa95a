#include "cell_to_cell/sectors.h"

#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// A direction within the half-turn from +x, that included, and what is known of it.
typedef struct candidate {
    sl_line line;
    double length; ///< of all portals along it; only which are kept depends on its rounding
    bool axis;
} candidate;

/// The same line's direction within the half-turn from +x.
static sl_line upwards(sl_point a, sl_point b) {
    const bool up = a.y != b.y ? b.y > a.y : b.x > a.x;
    return up ? (sl_line){a, b} : (sl_line){b, a};
}

static int by_angle(const void *a, const void *b) {
    const candidate *p = a, *q = b;
    return -sl_turn(p->line.a, p->line.b, q->line.a, q->line.b);
}

/// Axes first, then the longer ones; of equal length by angle, so that the order is a total one.
static int by_worth(const void *a, const void *b) {
    const candidate *p = a, *q = b;
    if (p->axis != q->axis) return p->axis ? -1 : 1;
    if (p->length != q->length) return p->length > q->length ? -1 : 1;
    return by_angle(a, b);
}

/// Sorted by angle, each direction once.
static size_t join_same(candidate *candidates, size_t count) {
    qsort(candidates, count, sizeof *candidates, by_angle);
    size_t kept = 0;
    for (size_t i = 1; i < count; i++) {
        if (by_angle(&candidates[kept], &candidates[i]) == 0) {
            candidates[kept].length += candidates[i].length;
            candidates[kept].axis |= candidates[i].axis;
        } else {
            candidates[++kept] = candidates[i];
        }
    }
    return kept + 1;
}

static size_t choose(const sl_space *space, uint32_t most, candidate *candidates) {
    const sl_point zero = {0, 0};
    size_t count = 0;
    candidates[count++] = (candidate){.line = {zero, {1, 0}}, .axis = true};
    candidates[count++] = (candidate){.line = {zero, {0, 1}}, .axis = true};
    for (uint32_t i = 0; i < space->portal_count; i++) {
        const sl_point a = space->portals[i].left, b = space->portals[i].right;
        candidates[count++] =
            (candidate){.line = upwards(a, b), .length = hypot(b.x - a.x, b.y - a.y)};
    }
    count = join_same(candidates, count);
    if (!most || count <= most / 2) return count;
    qsort(candidates, count, sizeof *candidates, by_worth);
    count = most < 4 ? 2 : most / 2;
    qsort(candidates, count, sizeof *candidates, by_angle);
    return count;
}

sl_status sl_sectors_create(sl_context *context, const sl_space *space, uint32_t most,
                            sl_sectors *out) {
    candidate *candidates =
        sl_alloc_array(context, (size_t)space->portal_count + 2, sizeof *candidates);
    if (!candidates) return SL_NO_MEMORY;
    const size_t count = choose(space, most, candidates);
    sl_line *bounds = sl_alloc_array(context, 2 * count, sizeof *bounds);
    for (size_t i = 0; i < count && bounds; i++) {
        const sl_line line = candidates[i].line;
        bounds[i] = line;
        bounds[count + i] = (sl_line){line.b, line.a};
    }
    sl_free(context, candidates);
    if (!bounds) return SL_NO_MEMORY;
    *out = (sl_sectors){.count = (uint32_t)(2 * count), .bounds = bounds};
    return SL_OK;
}

void sl_sectors_destroy(sl_context *context, sl_sectors *sectors) {
    sl_free(context, sectors->bounds);
    *sectors = (sl_sectors){0};
}

#include "plan/wall_change.h"

#include "sightline/geometry.h"

#include <math.h>
#include <stdlib.h>

static int compare_points(sl_point a, sl_point b) {
    if (a.x != b.x) return (a.x > b.x) - (a.x < b.x);
    return (a.y > b.y) - (a.y < b.y);
}

static int compare_walls(const void *p, const void *q) {
    const sl_segment *a = p, *b = q;
    const int first = compare_points(a->a, b->a);
    return first ? first : compare_points(a->b, b->b);
}

/// A copy in order, each wall from its lesser end.
static sl_segment *sorted_copy(sl_context *context, const wall_list *walls) {
    sl_segment *copy = sl_alloc_array(context, walls->count + 1, sizeof *copy);
    for (size_t i = 0; copy && i < walls->count; i++) {
        copy[i] = walls->items[i];
        if (compare_points(copy[i].a, copy[i].b) > 0)
            copy[i] = (sl_segment){walls->items[i].b, walls->items[i].a};
    }
    if (copy) qsort(copy, walls->count, sizeof *copy, compare_walls);
    return copy;
}

static bool overlaps(const sl_segment *s, const sl_segment *o) {
    return compare_points(s->a, o->b) < 0 && compare_points(o->a, s->b) < 0 &&
           sl_orient(s->a, s->b, o->a) == 0 && sl_orient(s->a, s->b, o->b) == 0;
}

/// Along a line, the order of points by x, then y, is that of the line. So parts are found by
/// going from the lesser end: the least uncovered place, to the next wall that covers.
static sl_status add_uncovered(sl_context *context, const sl_segment *wall,
                               const sl_segment *others, size_t count, wall_list *out) {
    sl_point at = wall->a;
    while (compare_points(at, wall->b) < 0) {
        const sl_segment rest = {at, wall->b};
        sl_point next = wall->b;
        bool covered = false;
        // `others` ascend by their lesser ends: one that begins behind the wall ends the search.
        for (size_t i = 0; i < count && compare_points(others[i].a, wall->b) < 0 && !covered; i++) {
            if (!overlaps(&rest, &others[i])) continue;
            if (compare_points(others[i].a, at) <= 0) {
                at = others[i].b;
                covered = true;
            } else if (compare_points(others[i].a, next) < 0) {
                next = others[i].a;
            }
        }
        if (covered) continue;
        SL_TRY(SL_ARRAY_ROOM(context, out, 1));
        out->items[out->count++] = (sl_segment){at, next};
        at = next;
    }
    return SL_OK;
}

sl_status wall_change_add(sl_context *context, const wall_list *walls, const wall_list *others,
                          wall_list *out) {
    sl_segment *a = sorted_copy(context, walls), *b = sorted_copy(context, others);
    sl_status status = a && b ? SL_OK : SL_NO_MEMORY;
    size_t k = 0;
    for (size_t i = 0; status == SL_OK && i < walls->count; i++) {
        if (i % 256 == 0) status = sl_check_cancelled(context);
        while (k < others->count && compare_walls(&b[k], &a[i]) < 0) k++;
        const bool same = k < others->count && compare_walls(&b[k], &a[i]) == 0;
        const bool twice = i && compare_walls(&a[i - 1], &a[i]) == 0;
        if (status == SL_OK && !same && !twice)
            status = add_uncovered(context, &a[i], b, others->count, out);
    }
    sl_free(context, a);
    sl_free(context, b);
    return status;
}

double wall_change_length(const wall_list *walls) {
    double length = 0;
    for (size_t i = 0; i < walls->count; i++)
        length += hypot(walls->items[i].b.x - walls->items[i].a.x,
                        walls->items[i].b.y - walls->items[i].a.y);
    return length;
}

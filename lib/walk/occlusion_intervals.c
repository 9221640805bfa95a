/// Merged angular intervals: the leaves in one array, by the ray that each starts at, counter-
/// clockwise. A shape is looked up from the leaf of its rightmost direction on.
#include "walk/occlusion.h"

#include <math.h>
#include <string.h>

/// From its ray to that of the next one, around: at most 180 degrees.
typedef struct interval {
    sl_ray right;
    int32_t shadows; ///< -1 for none
} interval;

typedef struct intervals {
    sl_occlusion base;
    SL_ARRAY(interval) all;
} intervals;

static sl_status create(sl_context *context, sl_occlusion **out) {
    intervals *v = sl_alloc_array(context, 1, sizeof *v);
    if (!v) return SL_NO_MEMORY;
    *out = &v->base;
    return SL_OK;
}

static void destroy(sl_context *context, sl_occlusion *occlusion) {
    intervals *v = (intervals *)occlusion;
    sl_free(context, v->all.items);
    sl_free(context, v);
}

/// Two halves of the plane to start with: right of the eye is where the order begins.
static sl_status clear(sl_context *context, sl_occlusion *occlusion, sl_point eye) {
    intervals *v = (intervals *)occlusion;
    v->all.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &v->all, 2));
    const sl_ray east = sl_ray_to((sl_point){eye.x + fabs(eye.x) + 1, eye.y});
    v->all.items[v->all.count++] = (interval){east, -1};
    v->all.items[v->all.count++] = (interval){sl_ray_back(east), -1};
    return SL_OK;
}

/// Whether a ray is in the first half of the order, counter-clockwise from right of the eye.
static bool in_first_half(const intervals *v, sl_ray ray) {
    const sl_point eye = v->base.shadows.pivot.eye;
    const bool up = ray.point.y > eye.y || (ray.point.y == eye.y && ray.point.x > eye.x);
    return up != ray.away;
}

/// The order of two rays: -1, 0, 1.
static int compare(intervals *v, sl_ray a, sl_ray b) {
    const bool first_a = in_first_half(v, a), first_b = in_first_half(v, b);
    if (first_a != first_b) return first_a ? -1 : 1;
    return -sl_ray_turn(&v->base.shadows.pivot, a, b);
}

/// The interval that a ray is in, its own start included.
static size_t find(intervals *v, sl_ray ray, bool *at_start) {
    size_t low = 0, high = v->all.count;
    *at_start = false;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        const int order = compare(v, v->all.items[middle].right, ray);
        if (order > 0)
            high = middle;
        else
            low = middle;
        if (order == 0) break;
    }
    *at_start = compare(v, v->all.items[low].right, ray) == 0;
    return low;
}

static size_t after(const intervals *v, size_t i) {
    return i + 1 < v->all.count ? i + 1 : 0;
}

/// Starts an interval at a ray, within the one that it is in; returns its place.
static sl_status start_at(sl_context *context, intervals *v, sl_ray ray, size_t *place) {
    bool there;
    *place = find(v, ray, &there);
    if (there) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, &v->all, 1));
    interval *at = &v->all.items[*place + 1];
    memmove(at + 1, at, (v->all.count - *place - 1) * sizeof *at);
    *at = (interval){ray, v->all.items[*place].shadows};
    v->all.count++;
    (*place)++;
    return SL_OK;
}

/// The first and the last of the intervals that have directions in common with a sector.
static void span(intervals *v, const sl_sector *sector, size_t *first, size_t *last) {
    bool at_start;
    *first = find(v, sector->right, &at_start);
    *last = find(v, sector->left, &at_start);
    if (at_start) *last = *last ? *last - 1 : v->all.count - 1;
}

static bool hides_all(intervals *v, const sl_sector *sector, uint32_t occluder) {
    size_t first, last;
    span(v, sector, &first, &last);
    for (size_t i = first;; i = after(v, i)) {
        if (!sl_shadows_hide(&v->base.shadows, v->all.items[i].shadows, occluder)) return false;
        if (i == last) return true;
    }
}

static sl_status add(sl_context *context, sl_occlusion *occlusion, uint32_t occluder,
                     const sl_sector *sector, bool *added) {
    intervals *v = (intervals *)occlusion;
    size_t first, last;
    if (hides_all(v, sector, occluder)) return SL_OK;
    SL_TRY(start_at(context, v, sector->right, &first));
    SL_TRY(start_at(context, v, sector->left, &last));
    span(v, sector, &first, &last);
    *added = true;
    for (size_t i = first;; i = after(v, i)) {
        int32_t *shadows = &v->all.items[i].shadows;
        if (!sl_shadows_hide(&v->base.shadows, *shadows, occluder))
            SL_TRY(sl_shadows_add(context, &v->base.shadows, *shadows, occluder, shadows));
        if (i == last) return SL_OK;
    }
}

static void look(sl_occlusion *occlusion, const sl_shape *shape, const sl_sector *sector,
                 unsigned *bits) {
    intervals *v = (intervals *)occlusion;
    size_t first, last;
    span(v, sector, &first, &last);
    for (size_t i = first; *bits != SL_LOOK_BOTH; i = after(v, i)) {
        sl_sector part = *sector;
        if (i != first) part.right = v->all.items[i].right;
        if (i != last) part.left = v->all.items[after(v, i)].right;
        sl_shadows_look(&v->base.shadows, v->all.items[i].shadows, shape, &part, bits);
        if (i == last) return;
    }
}

const sl_node_test_calls sl_occlusion_intervals = {create, destroy, clear, add, look};

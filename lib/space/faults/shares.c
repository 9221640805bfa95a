/// The shares of a map's area: inside, outside and solid ground, and how much of the area among the
/// walls these enclose. What is among the walls is their convex hull: the border may lie far away.
/// Time O(n log n).
#include "geometry/orient.h"
#include "sightline/faults.h"
#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>

sl_ground_shares sl_space_ground(const sl_space *space) {
    sl_ground_shares areas = {0};
    for (uint32_t i = 0; i < space->cell_count; i++) {
        const sl_cell *cell = &space->cells[i];
        *(cell->solid    ? &areas.solid
          : cell->inside ? &areas.inside
                         : &areas.outside) += sl_space_area(space, i);
    }
    const double all = areas.inside + areas.outside + areas.solid;
    if (!(all > 0)) return areas;
    return (sl_ground_shares){areas.inside / all, areas.outside / all, areas.solid / all};
}

static int compare_corners(const void *left, const void *right) {
    return sli_compare_points(*(const sl_point *)left, *(const sl_point *)right);
}

/// Keeps the corners of the convex hull of sorted points, counter-clockwise (Andrew 1979: the lower
/// chain, then the upper one). `hull` has room for twice the points. Exact.
static size_t find_hull(const sl_point *points, size_t count, sl_point *hull) {
    size_t kept = 0;
    for (int chain = 0; chain < 2; chain++) {
        const size_t first = kept;
        for (size_t i = 0; i < count; i++) {
            const sl_point p = points[chain ? count - 1 - i : i];
            while (kept >= first + 2 && sli_orient(hull[kept - 2], hull[kept - 1], p) <= 0) kept--;
            hull[kept++] = p;
        }
        if (kept) kept--; // the next chain begins there
    }
    return kept;
}

static double area_of(const sl_point *corners, size_t count) {
    double twice = 0;
    for (size_t i = 2; i < count; i++) {
        const sl_point a = corners[0], b = corners[i - 1], c = corners[i];
        twice += (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    }
    return twice / 2;
}

sl_status sl_space_enclosed(sl_context *context, const sl_space *space, double *share) {
    const sl_box *b = &space->bounds;
    const double box = (b->max.x - b->min.x) * (b->max.y - b->min.y);
    const sl_ground_shares shares = sl_space_ground(space);
    const size_t count = 2 * (size_t)space->wall_count;
    sl_point *points = sl_alloc_array(context, count + 1, sizeof *points);
    sl_point *hull = sl_alloc_array(context, 2 * count + 2, sizeof *hull);
    if (points && hull) {
        for (uint32_t i = 0; i < space->wall_count; i++) {
            points[2 * i] = space->walls[i].a;
            points[2 * i + 1] = space->walls[i].b;
        }
        if (count) qsort(points, count, sizeof *points, compare_corners);
        // What is beyond the hull is not outside. Differences of shares of the hull alone: it may
        // be a sliver of the bounds.
        const double within = area_of(hull, find_hull(points, count, hull)) / box;
        const double outside = fmax(within - shares.inside - shares.solid, 0);
        *share = shares.inside > 0 ? shares.inside / (shares.inside + outside) : 0;
    }
    const bool done = points && hull;
    sl_free(context, points);
    sl_free(context, hull);
    return done ? SL_OK : SL_NO_MEMORY;
}

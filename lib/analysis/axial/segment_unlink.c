/// Crossings that are no junctions: bridges and tunnels. The corner becomes two, each with the two
/// segments that lie opposite to each other around it:
///
///         1               1
///         |               |
///      0--o--2   ->    0-- --2      0 and 2 meet, and 1 and 3.
///         |               |
///         3               3
#include "analysis/axial/segment_network.h"
#include "geometry/length.h"
#include "geometry/orient.h"

#include <math.h>
#include <stdlib.h>

enum { ARMS = 4 };

static sl_point end_point(const sl_segment *segments, uint32_t end) {
    return end % 2 ? segments[end / 2].b : segments[end / 2].a;
}

static sl_point corner_point(const sli_segment_network *n, uint32_t corner) {
    return end_point(n->segments, n->at[n->first_at[corner]]);
}

/// The corner at a point; the number of corners if there is none. Corners are in order.
static uint32_t corner_at(const sli_segment_network *n, sl_point point) {
    uint32_t low = 0, high = n->corner_count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (sli_compare_points(corner_point(n, middle), point) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low < n->corner_count && sli_same_point(corner_point(n, low), point) ? low
                                                                                : n->corner_count;
}

/// Puts opposite ones of four segments side by side: those with the first one in front.
static void pair_opposite(const sli_segment_network *n, sl_point corner, uint32_t *at) {
    uint32_t around[ARMS];
    for (uint32_t i = 0; i < ARMS; i++) {
        uint32_t k = i;
        for (; k && sli_compare_around(corner, end_point(n->segments, at[i] ^ 1),
                                       end_point(n->segments, around[k - 1] ^ 1)) < 0;
             k--)
            around[k] = around[k - 1];
        around[k] = at[i];
    }
    for (uint32_t i = 0; i < ARMS; i++) at[i] = around[i / 2 + i % 2 * 2];
}

static void split_corners(sli_segment_network *n, const bool *unlinked, uint32_t count) {
    uint32_t write = n->corner_count + count;
    n->first_at[write] = 2 * n->count;
    for (uint32_t corner = n->corner_count; corner-- > 0;) {
        const uint32_t first = n->first_at[corner];
        if (unlinked[corner]) {
            pair_opposite(n, end_point(n->segments, n->at[first]), &n->at[first]);
            n->first_at[--write] = first + 2;
        }
        n->first_at[--write] = first;
    }
    n->corner_count += count;
    for (uint32_t corner = 0; corner < n->corner_count; corner++)
        for (uint32_t i = n->first_at[corner]; i < n->first_at[corner + 1]; i++)
            n->corners[n->at[i] / 2][n->at[i] % 2] = corner;
}

sl_status sli_segment_unlink(sl_context *context, const sl_segment_options *options,
                             sli_segment_network *n) {
    if (!options->unlink_count) return SL_OK;
    bool *unlinked = sl_alloc_array(context, (size_t)n->corner_count + 1, sizeof *unlinked);
    if (!unlinked) return SL_NO_MEMORY;
    sl_status status = SL_OK;
    for (uint32_t i = 0; i < options->unlink_count && status == SL_OK; i++) {
        const uint32_t corner = corner_at(n, options->unlinks[i]);
        if (corner == n->corner_count || n->first_at[corner + 1] - n->first_at[corner] != ARMS)
            status = sl_fail(context, SL_BAD_ARGUMENT,
                             "unlink %u is no crossing where four segments meet", i);
        else if (unlinked[corner])
            status = sl_fail(context, SL_BAD_ARGUMENT, "unlink %u is there twice", i);
        else
            unlinked[corner] = true;
    }
    if (status == SL_OK) split_corners(n, unlinked, options->unlink_count);
    sl_free(context, unlinked);
    return status;
}

sl_status sl_segment_crossing(sl_context *context, const sl_segment *segments, uint32_t count,
                              sl_point point, sl_point *crossing) {
    double least = INFINITY, shortest = INFINITY;
    uint32_t arms = 0;
    for (uint32_t end = 0; end < 2 * count; end++) {
        const sl_point at = end_point(segments, end);
        const double far = sli_length(at.x - point.x, at.y - point.y);
        if (far > least || (far == least && sli_compare_points(at, *crossing) >= 0)) continue;
        least = far;
        *crossing = at;
    }
    for (uint32_t end = 0; end < 2 * count; end++) {
        const sl_point at = end_point(segments, end), other = end_point(segments, end ^ 1);
        if (!sli_same_point(at, *crossing)) continue;
        arms++;
        shortest = fmin(shortest, sli_length(at.x - other.x, at.y - other.y));
    }
    if (arms == ARMS && least <= shortest / 2) return SL_OK;
    if (!count) return sl_fail(context, SL_BAD_ARGUMENT, "there are no segments");
    return sl_fail(context, SL_BAD_ARGUMENT,
                   arms == ARMS ? "no crossing is near %.10g,%.10g: the nearest one is %.10g,%.10g"
                                : "no crossing is near %.10g,%.10g: %.10g,%.10g is the nearest end "
                                  "of lines, and two lines do not cross there",
                   point.x, point.y, crossing->x, crossing->y);
}

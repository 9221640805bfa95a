/// Walls inside faces that do not know of them. Where no double is near to where a line crosses a
/// portal, the piece beside it may get more than a sliver of the face beyond, and a wall with it.
#include "space/bsp.h"

#include <math.h>

static sl_point corner(const void *first, size_t stride, size_t number) {
    return *(const sl_point *)((const char *)first + number * stride);
}

double sl_wall_depth(const void *first, size_t stride, size_t count, const sl_wall *wall) {
    double low = 0, high = 1;
    for (int round = 0; round < 2; round++) {
        const double middle = (low + high) / 2;
        const sl_point p = {wall->a.x + middle * (wall->b.x - wall->a.x),
                            wall->a.y + middle * (wall->b.y - wall->a.y)};
        double depth = INFINITY;
        for (size_t i = 0; i < count; i++) {
            const sl_point a = corner(first, stride, i);
            const sl_point b = corner(first, stride, i + 1 == count ? 0 : i + 1);
            const double length = hypot(b.x - a.x, b.y - a.y);
            const double ux = (b.x - a.x) / length, uy = (b.y - a.y) / length;
            const double from = ux * (wall->a.y - a.y) - uy * (wall->a.x - a.x);
            const double to = ux * (wall->b.y - a.y) - uy * (wall->b.x - a.x);
            if (from <= 0 && to <= 0) return 0;
            if (from < 0)
                low = fmax(low, from / (from - to));
            else if (to < 0)
                high = fmin(high, from / (from - to));
            depth = fmin(depth, ux * (p.y - a.y) - uy * (p.x - a.x));
        }
        if (low >= high) return 0;
        if (round) return depth;
    }
    return 0;
}

double sl_bsp_slack(const sl_box *b) {
    const double size = fmax(b->max.x - b->min.x, b->max.y - b->min.y);
    const double farthest =
        fmax(fmax(fabs(b->min.x), fabs(b->max.x)), fmax(fabs(b->min.y), fabs(b->max.y)));
    return 0x1p-30 * size + 0x1p-49 * farthest;
}

double sl_bsp_seam_slack(const sl_box *b) {
    return 64 * sl_bsp_slack(b);
}

/// Follows a wall down the tree.
static sl_status find_wall(sl_bsp *bsp, uint32_t number, double slack, int32_t *stack) {
    const sl_wall *wall = &bsp->walls[number];
    size_t count = 0;
    stack[count++] = bsp->root;
    while (count) {
        const int32_t at = stack[--count];
        if (at < 0) {
            const sl_bsp_face *face = &bsp->faces.items[~at];
            const sl_bsp_side *sides = face->sides.items;
            if (sl_wall_depth(&sides->from, sizeof *sides, face->sides.count, wall) > slack &&
                !sl_bsp_has_wall(face, number))
                SL_TRY(sl_bsp_add_wall(bsp, (uint32_t)~at, number));
            continue;
        }
        const sl_segment *line = &bsp->lines.items[bsp->nodes.items[at].line];
        const int a = sl_orient(line->a, line->b, wall->a);
        const int b = sl_orient(line->a, line->b, wall->b);
        if (a > 0 || b > 0) stack[count++] = bsp->nodes.items[at].above;
        if (a < 0 || b < 0) stack[count++] = bsp->nodes.items[at].below;
    }
    return SL_OK;
}

sl_status sl_bsp_find_lost(sl_bsp *bsp) {
    int32_t *stack = sl_alloc_array(bsp->context, bsp->nodes.count + 2, sizeof *stack);
    if (!stack) return SL_NO_MEMORY;
    const double slack = sl_bsp_slack(&bsp->bounds);
    sl_status status = SL_OK;
    for (uint32_t i = 0; i < bsp->wall_count && status == SL_OK; i++)
        if (!sl_same_point(bsp->walls[i].a, bsp->walls[i].b))
            status = find_wall(bsp, i, slack, stack);
    sl_free(bsp->context, stack);
    return status;
}

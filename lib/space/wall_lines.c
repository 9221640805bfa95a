#include "space/wall_lines.h"

#include <stdlib.h>

static int compare_numbers(double a, double b) {
    return (a > b) - (a < b);
}

static int compare_pieces(const void *left, const void *right) {
    const sl_piece *a = left, *b = right;
    if (a->axis != b->axis) return a->axis - b->axis;
    const int at = compare_numbers(a->at, b->at);
    return at ? at : compare_numbers(a->lo, b->lo);
}

static sl_piece make_piece(const sl_wall *wall) {
    const int axis = wall->a.x == wall->b.x ? 0 : 1;
    const double at = axis ? wall->a.y : wall->a.x;
    const double one = axis ? wall->a.x : wall->a.y, other = axis ? wall->b.x : wall->b.y;
    return (sl_piece){
        .axis = axis, .at = at, .lo = one < other ? one : other, .hi = one < other ? other : one};
}

static sl_status check_axial(sl_context *context, const char *source, const sl_wall *wall) {
    const bool vertical = wall->a.x == wall->b.x, horizontal = wall->a.y == wall->b.y;
    if (vertical && horizontal)
        return sl_fail_at(context, source, wall->line,
                          "a wall of zero length at %.17g %.17g: clean the map first", wall->a.x,
                          wall->a.y);
    if (vertical || horizontal) return SL_OK;
    return sl_fail_at(context, source, wall->line,
                      "the wall from %.17g %.17g to %.17g %.17g is neither horizontal nor "
                      "vertical, which the kd-tree needs: make it axial or leave it out",
                      wall->a.x, wall->a.y, wall->b.x, wall->b.y);
}

sl_status sl_wall_lines(sl_context *context, const char *source, const sl_wall *walls, size_t count,
                        sl_piece **out) {
    if (!source) source = "the map";
    for (size_t i = 0; i < count; i++) SL_TRY(check_axial(context, source, &walls[i]));
    sl_piece *pieces = sl_alloc_array(context, count, sizeof *pieces);
    if (!pieces) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) pieces[i] = make_piece(&walls[i]);
    qsort(pieces, count, sizeof *pieces, compare_pieces);
    for (size_t i = 1; i < count; i++) {
        const sl_piece *a = &pieces[i - 1], *b = &pieces[i];
        if (a->axis != b->axis || a->at != b->at || b->lo >= a->hi) continue;
        const sl_status status =
            sl_fail_at(context, source, 0, "two walls overlap on %s = %.17g: clean the map first",
                       a->axis ? "y" : "x", a->at);
        sl_free(context, pieces);
        return status;
    }
    *out = pieces;
    return SL_OK;
}

size_t sl_wall_lines_find(const sl_piece *pieces, size_t count, int axis, double at, double lo) {
    size_t first = 0, end = count;
    while (first < end) {
        const size_t middle = first + (end - first) / 2;
        const sl_piece *p = &pieces[middle];
        const bool before = p->axis != axis ? p->axis < axis
                            : p->at != at   ? p->at < at
                                            : p->hi <= lo;
        if (before)
            first = middle + 1;
        else
            end = middle;
    }
    return first;
}

bool sl_wall_lines_cover(const sl_piece *pieces, size_t count, int axis, double at, double lo,
                         double hi) {
    for (size_t i = sl_wall_lines_find(pieces, count, axis, at, lo); lo < hi; i++) {
        if (i == count || pieces[i].axis != axis || pieces[i].at != at || pieces[i].lo > lo)
            return false;
        lo = pieces[i].hi;
    }
    return true;
}

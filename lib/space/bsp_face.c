/// Faces of the BSP: what is asked of polygons, all by exact predicates.
#include "space/bsp.h"

#include <string.h>

sl_status sl_bsp_add_side(sl_context *context, sl_bsp_sides *sides, sl_bsp_side side) {
    SL_TRY(SL_ARRAY_ROOM(context, sides, 1));
    sides->items[sides->count++] = side;
    return SL_OK;
}

static sl_point corner(const sl_bsp_sides *sides, size_t i) {
    return sides->items[i].from;
}

static sl_point corner_before(const sl_bsp_sides *sides, size_t i) {
    return sides->items[i ? i - 1 : sides->count - 1].from;
}

static int turn_at(const sl_bsp_sides *sides, size_t i) {
    return sl_orient(corner_before(sides, i), corner(sides, i), sl_side_end(sides, i));
}

/// Whether going from a to b heads upwards, or level to the right.
static bool heads_up(sl_point a, sl_point b) {
    return b.y > a.y || (b.y == a.y && b.x > a.x);
}

static sl_point point_at(const void *first, size_t stride, size_t i) {
    sl_point p;
    memcpy(&p, (const char *)first + i * stride, sizeof p);
    return p;
}

bool sl_convex_corners(const void *first, size_t stride, size_t count) {
    size_t bends = 0, rounds = 0;
    for (size_t i = 0; i < count; i++) {
        const sl_point before = point_at(first, stride, i ? i - 1 : count - 1);
        const sl_point at = point_at(first, stride, i);
        const sl_point after = point_at(first, stride, i + 1 == count ? 0 : i + 1);
        if (sl_same_point(at, after)) return false;
        const int turn = sl_orient(before, at, after);
        const bool up_before = heads_up(before, at), up_after = heads_up(at, after);
        if (turn < 0 || (turn == 0 && up_before != up_after)) return false;
        bends += turn > 0;
        rounds += !up_before && up_after;
    }
    return bends >= 3 && rounds == 1;
}

bool sl_bsp_convex(const sl_bsp_sides *sides) {
    return sl_convex_corners(sides->items, sizeof *sides->items, sides->count);
}

bool sl_bsp_holds(const sl_bsp_sides *sides, sl_point point) {
    for (size_t i = 0; i < sides->count; i++)
        if (sl_orient(corner(sides, i), sl_side_end(sides, i), point) <= 0) return false;
    return true;
}

/// A segment and an open convex polygon are apart where a side's line or the segment's own parts
/// them (the separating axis theorem).
bool sl_bsp_hits(const sl_bsp_sides *sides, const sl_wall *wall, size_t *along) {
    *along = SIZE_MAX;
    bool left = false, right = false, parted = false;
    for (size_t i = 0; i < sides->count; i++) {
        const sl_point from = corner(sides, i), to = sl_side_end(sides, i);
        const int a = sl_orient(from, to, wall->a);
        if (a > 0) continue;
        const int b = sl_orient(from, to, wall->b);
        if (b > 0) continue;
        parted = true;
        if (a == 0 && b == 0) *along = i;
    }
    if (parted) return false;
    for (size_t i = 0; i < sides->count && !(left && right); i++) {
        const int sign = sl_orient(wall->a, wall->b, corner(sides, i));
        left |= sign > 0;
        right |= sign < 0;
    }
    return left && right;
}

bool sl_bsp_behind(const sl_wall *wall, bool reversed, sl_point point) {
    const int sign = sl_orient(wall->a, wall->b, point);
    return reversed ? sign >= 0 : sign <= 0;
}

// --- diagonals

/// Whether a diagonal from an inner corner leaves less than half a turn on either side of it.
static bool straightens(const sl_bsp_sides *sides, size_t from, sl_point to) {
    return sl_orient(corner_before(sides, from), corner(sides, from), to) >= 0 &&
           sl_orient(corner(sides, from), sl_side_end(sides, from), to) >= 0;
}

/// Whether the way from a corner to a point starts into the polygon.
static bool starts_inside(const sl_bsp_sides *sides, size_t i, sl_point to) {
    const int before = sl_orient(corner_before(sides, i), corner(sides, i), to);
    const int after = sl_orient(corner(sides, i), sl_side_end(sides, i), to);
    return turn_at(sides, i) < 0 ? before > 0 || after > 0 : before > 0 && after > 0;
}

/// Whether a side meets the diagonal other than in its ends.
static bool is_in_the_way(const sl_bsp_sides *sides, size_t i, size_t from, size_t to) {
    const size_t next = i + 1 == sides->count ? 0 : i + 1;
    const sl_point p = corner(sides, from), q = corner(sides, to);
    const sl_point a = corner(sides, i), b = corner(sides, next);
    if (i == from || i == to || next == from || next == to) {
        // It shares a corner with the diagonal, into which its other end must not come to lie.
        const sl_point other = i == from || i == to ? b : a;
        if (sl_same_point(other, p) || sl_same_point(other, q)) return false;
        return sl_orient(p, q, other) == 0 &&
               (fmin(p.x, q.x) <= other.x && other.x <= fmax(p.x, q.x)) &&
               (fmin(p.y, q.y) <= other.y && other.y <= fmax(p.y, q.y));
    }
    const int sides_a = sl_orient(p, q, a), sides_b = sl_orient(p, q, b);
    if ((sides_a > 0 && sides_b > 0) || (sides_a < 0 && sides_b < 0)) return false;
    const int sides_p = sl_orient(a, b, p), sides_q = sl_orient(a, b, q);
    return !((sides_p > 0 && sides_q > 0) || (sides_p < 0 && sides_q < 0));
}

static bool is_free(const sl_bsp_sides *sides, size_t from, size_t to) {
    if (!starts_inside(sides, from, corner(sides, to)) ||
        !starts_inside(sides, to, corner(sides, from)))
        return false;
    for (size_t i = 0; i < sides->count; i++)
        if (is_in_the_way(sides, i, from, to)) return false;
    return true;
}

/// The shortest of those that leave no inner corner at its start; else the shortest.
static bool choose_diagonal(const sl_bsp_sides *sides, size_t from, size_t *to) {
    double least = INFINITY;
    bool found = false, straight = false;
    for (size_t k = 2; k + 1 < sides->count; k++) {
        const size_t i = (from + k) % sides->count;
        const sl_point p = corner(sides, from), q = corner(sides, i);
        const bool good = straightens(sides, from, q);
        const double length = hypot(q.x - p.x, q.y - p.y);
        if (found && (straight != good ? straight : length >= least)) continue;
        if (!is_free(sides, from, i)) continue;
        found = true;
        straight = good;
        least = length;
        *to = i;
    }
    return found;
}

bool sl_bsp_diagonal(const sl_bsp_sides *sides, size_t *from, size_t *to) {
    for (*from = 0; *from < sides->count; ++*from)
        if (turn_at(sides, *from) < 0 && choose_diagonal(sides, *from, to)) return true;
    return false;
}

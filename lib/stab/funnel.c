/// The incremental exact solver: the two convex chains between which the line may swing.
///
/// The lines that stab a sequence form a convex polygon in the plane of lines. Its corners are
/// lines through two portal ends; an edge of it is a turn about one end. Going round, the line
/// first turns clockwise about left ends (the left chain), then back about right ends (the right
/// chain), so that the list of corners is the funnel. A new end is a half-plane that cuts the
/// polygon: an orientation test a corner says what it cuts off, and each new corner is the line
/// through the new end and the end of the edge that it cuts. No coordinate is ever computed: all is
/// decided by exact orientation tests on portal ends, and directions follow from the order round
/// the polygon.
///
/// The polygon has inner points, and the sequence a line strictly between its ends, exactly if it
/// had them before the cut and some corner lies strictly inside the new half-plane. Without inner
/// points what is left is a single line or a turn about one point: lines that graze.
///
/// While all ends lie on one line (the first portal's) the lines through it form no polygon but all
/// that crosses an interval of it; the first end off that line makes them one.
///
/// Cost: a push takes two orientation tests for each corner of the list, of which there are three
/// to five in floor plans; a list is copied only when it is cut, so that a pop restores the old
/// one.
#include "sightline/solvers.h"

#include "base/base.h"
#include "geometry/orient.h"

#include <math.h>

/// A line through two ends, and the end about which it turns to become the next corner's.
typedef struct corner {
    sl_point from, to;
    sl_point pivot;
    bool left; ///< the pivot is a left end: the turn is clockwise
} corner;

/// The lines through the sequence up to one push.
typedef struct level {
    size_t first, count; ///< its corners; none while on_line
    size_t corners_before;
    bool on_line, strict, hidden;
    sl_point low, high; ///< while on_line: right and left end of the interval that is crossed
} level;

typedef struct funnel {
    SL_ARRAY(corner) corners;
    SL_ARRAY(level) levels;
    SL_ARRAY(sl_portal_ends) portals;
    SL_ARRAY(signed char) sides; ///< scratch of a cut, one a corner; its count stays 0
} funnel;

static sl_status create(sl_context *context, sl_box bounds, void **state) {
    (void)bounds;
    *state = sl_alloc_array(context, 1, sizeof(funnel));
    return *state ? SL_OK : SL_NO_MEMORY;
}

static void destroy(sl_context *context, void *state) {
    funnel *f = state;
    if (!f) return;
    sl_free(context, f->corners.items);
    sl_free(context, f->levels.items);
    sl_free(context, f->portals.items);
    sl_free(context, f->sides.items);
    sl_free(context, f);
}

/// The corner made by end `p` on the edge that turns about `pivot`. `leaving`: going round, the cut
/// starts here. Which of the two points comes first on the line follows from the sense of the turn.
static corner cut_edge(sl_point pivot, bool pivot_left, sl_point p, bool p_left, bool leaving) {
    const bool pivot_first = (pivot_left != leaving) == p_left;
    return (corner){.from = pivot_first ? pivot : p,
                    .to = pivot_first ? p : pivot,
                    .pivot = leaving ? p : pivot,
                    .left = leaving ? p_left : pivot_left};
}

/// Which of two points on the first portal's line comes first, going from its right to its left
/// end.
static bool comes_before(const funnel *f, sl_point a, sl_point b) {
    const sl_point right = f->portals.items[0].right, left = f->portals.items[0].left;
    if (left.x != right.x) return left.x > right.x ? a.x < b.x : a.x > b.x;
    return left.y > right.y ? a.y < b.y : a.y > b.y;
}

/// Cuts while all ends so far lie on the first portal's line. Room for three corners is there.
static void cut_interval(funnel *f, level *l, sl_point p, bool p_left) {
    const sl_point right = f->portals.items[0].right, left = f->portals.items[0].left;
    const int side = sl_orient(right, left, p);
    if (side == 0) {
        if (p_left && comes_before(f, p, l->high)) l->high = p;
        if (!p_left && comes_before(f, l->low, p)) l->low = p;
        l->strict = comes_before(f, l->low, l->high);
        return;
    }
    // Of the two directions along the line, the new end leaves one. Upwards: from right to left.
    const bool upwards = p_left == (side > 0);
    corner *to = f->corners.items + f->corners.count;
    l->first = f->corners.count;
    l->count = 1;
    l->on_line = false;
    to[0] = upwards ? (corner){right, left, l->high, true} : (corner){left, right, l->low, false};
    if (!comes_before(f, l->high, l->low)) {
        to[1] = cut_edge(to[0].pivot, to[0].left, p, p_left, true);
        to[2] = upwards ? cut_edge(l->low, false, p, p_left, false)
                        : cut_edge(l->high, true, p, p_left, false);
        l->count = 3;
    }
    f->corners.count += l->count;
}

/// Copies the corners that the cut leaves, with the new ones, behind all others. `sides`: of the
/// old corners, above 0 where the line keeps the end strictly on its side.
static void copy_cut(funnel *f, level *l, const signed char *sides, sl_point p, bool p_left) {
    const corner *from = f->corners.items + l->first;
    corner *to = f->corners.items + f->corners.count;
    size_t count = 0;
    for (size_t i = 0; i < l->count; i++) {
        const signed char here = sides[i], next = sides[i + 1 < l->count ? i + 1 : 0];
        if (here >= 0) to[count++] = from[i];
        if (here > 0 && next < 0)
            to[count++] = cut_edge(from[i].pivot, from[i].left, p, p_left, true);
        if (here == 0 && next < 0) {
            to[count - 1].pivot = p;
            to[count - 1].left = p_left;
        }
        if (here < 0 && next > 0)
            to[count++] = cut_edge(from[i].pivot, from[i].left, p, p_left, false);
    }
    l->first = f->corners.count;
    l->count = count;
    f->corners.count += count;
}

/// Cuts the lines by an end that they must keep at their left or right. Room for the corners is
/// there.
static void cut(funnel *f, level *l, sl_point p, bool p_left) {
    if (l->on_line) {
        cut_interval(f, l, p, p_left);
        return;
    }
    const corner *corners = f->corners.items + l->first;
    signed char *sides = f->sides.items;
    bool any_inside = false, any_outside = false, any_kept = false;
    for (size_t i = 0; i < l->count; i++) {
        const int side = sl_orient(corners[i].from, corners[i].to, p);
        sides[i] = (signed char)(p_left ? side : -side);
        any_inside |= sides[i] > 0;
        any_outside |= sides[i] < 0;
        any_kept |= sides[i] >= 0;
    }
    l->strict = l->strict && any_inside;
    l->hidden = !any_kept;
    if (any_kept && any_outside) copy_cut(f, l, sides, p, p_left);
}

static sl_status make_room(sl_context *context, funnel *f) {
    // An end adds at most one corner; each of the two cuts of a push may copy the list.
    const size_t most = f->levels.count ? f->levels.items[f->levels.count - 1].count + 2 : 3;
    SL_TRY(SL_ARRAY_ROOM(context, &f->levels, 1));
    SL_TRY(SL_ARRAY_ROOM(context, &f->portals, 1));
    SL_TRY(SL_ARRAY_ROOM(context, &f->corners, 2 * most + 3));
    return SL_ARRAY_ROOM(context, &f->sides, most + 3);
}

static sl_status push(sl_context *context, void *state, sl_point left, sl_point right,
                      sl_stab_verdict *verdict) {
    funnel *f = state;
    SL_TRY(make_room(context, f));
    f->portals.items[f->portals.count++] = (sl_portal_ends){left, right};
    level *l = &f->levels.items[f->levels.count++];
    if (f->levels.count == 1) {
        *l = (level){.on_line = true, .strict = true, .low = right, .high = left};
    } else {
        *l = l[-1];
        l->corners_before = f->corners.count;
        cut(f, l, left, true);
        if (!l->hidden) cut(f, l, right, false);
    }
    *verdict = l->hidden ? SL_HIDDEN : l->strict ? SL_STABBED : SL_GRAZING;
    return SL_OK;
}

static void pop(void *state) {
    funnel *f = state;
    f->corners.count = f->levels.items[--f->levels.count].corners_before;
    f->portals.count--;
}

/// Whether the line keeps all left ends strictly at its left and all right ends at its right.
static bool is_strict(const funnel *f, sl_line line) {
    for (size_t i = 0; i < f->portals.count; i++) {
        const sl_portal_ends *p = &f->portals.items[i];
        if (sl_orient(line.a, line.b, p->left) <= 0 || sl_orient(line.a, line.b, p->right) >= 0)
            return false;
    }
    return true;
}

/// Where the line ux (y - oy) - uy (x - ox) + c = 0 crosses a portal's line, o the first left end.
static sl_point crossing_point(const funnel *f, double ux, double uy, double c,
                               const sl_portal_ends *p) {
    const sl_point o = f->portals.items[0].left;
    const double at_left = ux * (p->left.y - o.y) - uy * (p->left.x - o.x) + c;
    const double at_right = ux * (p->right.y - o.y) - uy * (p->right.x - o.x) + c;
    const double t = at_left / (at_left - at_right);
    return (sl_point){p->left.x + t * (p->right.x - p->left.x),
                      p->left.y + t * (p->right.y - p->left.y)};
}

/// A line in the middle of all, as near as doubles come: the mean of the corners, directions of
/// unit length, between where it crosses the first portal and where the last.
static sl_line middle_line(const funnel *f, const level *l) {
    const sl_portal_ends *first = f->portals.items, *last = first + f->portals.count - 1;
    if (l->on_line) {
        const sl_point middle = {l->low.x + (l->high.x - l->low.x) / 2,
                                 l->low.y + (l->high.y - l->low.y) / 2};
        return (sl_line){middle,
                         {middle.x + (first->left.y - first->right.y),
                          middle.y + (first->right.x - first->left.x)}};
    }
    double ux = 0, uy = 0, c = 0;
    for (size_t i = 0; i < l->count; i++) {
        const corner *k = &f->corners.items[l->first + i];
        const double x = k->to.x - k->from.x, y = k->to.y - k->from.y, length = hypot(x, y);
        ux += x / length;
        uy += y / length;
        c -= x / length * (k->from.y - first->left.y) - y / length * (k->from.x - first->left.x);
    }
    return (sl_line){crossing_point(f, ux, uy, c, first), crossing_point(f, ux, uy, c, last)};
}

static sl_line witness(const void *state) {
    const funnel *f = state;
    const level *l = &f->levels.items[f->levels.count - 1];
    if (l->strict) {
        const sl_line line = middle_line(f, l);
        if (is_strict(f, line)) return line;
    }
    if (l->on_line) return (sl_line){f->portals.items[0].right, f->portals.items[0].left};
    const corner *k = &f->corners.items[l->first];
    return (sl_line){k->from, k->to};
}

const sl_solver *sl_funnel(void) {
    static const sl_solver solver = {
        .name = "funnel",
        .what = "the two convex chains between which the line may swing, by exact predicates",
        .guarantee = SL_EXACT,
        .create = create,
        .destroy = destroy,
        .push = push,
        .pop = pop,
        .witness = witness,
    };
    return &solver;
}

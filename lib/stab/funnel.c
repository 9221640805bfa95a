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
#include "stab/conflict.h"

#include <math.h>

/// Portal i's ends are number 2 i, the left one, and 2 i + 1: a number tells the side.
typedef uint32_t end_number;

/// A line through two ends, and the end about which it turns to become the next corner's.
typedef struct corner {
    sl_point at, direction; ///< the end `from`, and the way from there to `to`, rounded
    end_number from, to, pivot;
} corner;

/// The lines through the sequence up to one push.
typedef struct level {
    size_t first, corners_before; ///< its corners, and where they stood before the push
    uint32_t count;               ///< none while on_line
    end_number low, high;         ///< while on_line: right and left end of the interval crossed
    bool on_line, strict, hidden;
} level;

typedef struct funnel {
    SL_ARRAY(corner) corners;
    SL_ARRAY(level) levels;
    SL_ARRAY(sl_portal_ends) portals;
    SL_ARRAY(signed char) sides; ///< scratch of a cut, one a corner; its count stays 0
    sl_box box;                  ///< around all ends so far, popped ones too
    double bound;                ///< of the rounding error of a side, for ends in the box
    sl_stab_account account;
} funnel;

static sl_status create(sl_context *context, sl_box bounds, void **state) {
    (void)bounds;
    funnel *f = sl_alloc_array(context, 1, sizeof *f);
    if (!f) return SL_NO_MEMORY;
    f->box = (sl_box){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    *state = f;
    return SL_OK;
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

static bool is_left(end_number e) {
    return e % 2 == 0;
}

static sl_point place_of(const funnel *f, end_number e) {
    const sl_portal_ends *p = &f->portals.items[e / 2];
    return is_left(e) ? p->left : p->right;
}

/// Widens the box, and with it the bound on the error of a side. That is Shewchuk's
/// (geometry/orient.h) with the largest that the two products can be in place of what they are, so
/// that it need not be computed for each side.
static void enclose(funnel *f, sl_point p) {
    sl_box *b = &f->box;
    if (p.x >= b->min.x && p.x <= b->max.x && p.y >= b->min.y && p.y <= b->max.y) return;
    b->min = (sl_point){fmin(b->min.x, p.x), fmin(b->min.y, p.y)};
    b->max = (sl_point){fmax(b->max.x, p.x), fmax(b->max.y, p.y)};
    f->bound = 4 * 0x1p-53 * 2 * (b->max.x - b->min.x) * (b->max.y - b->min.y) + 0x1p-1000;
}

/// On which side of a corner's line an end lies: 1 left, -1 right, 0 on it.
static int side_of(funnel *f, const corner *c, sl_point p) {
    const double determinant = c->direction.x * (p.y - c->at.y) - c->direction.y * (p.x - c->at.x);
    const int sign = (determinant > f->bound) - (determinant < -f->bound);
    if (sign) return sign;
    f->account.exact++;
    return sl_orient_exact(c->at, place_of(f, c->to), p);
}

static corner make_corner(const funnel *f, end_number from, end_number to, end_number pivot) {
    const sl_point a = place_of(f, from), b = place_of(f, to);
    return (corner){
        .at = a, .direction = {b.x - a.x, b.y - a.y}, .from = from, .to = to, .pivot = pivot};
}

/// The corner made by a new end on the edge that turns about `pivot`. `leaving`: going round, the
/// cut starts here. Which of the two ends comes first on the line follows from the sense of the
/// turn.
static corner cut_edge(const funnel *f, end_number pivot, end_number new, bool leaving) {
    const bool pivot_first = (is_left(pivot) != leaving) == is_left(new);
    return make_corner(f, pivot_first ? pivot : new, pivot_first ? new : pivot,
                       leaving ? new : pivot);
}

/// Which of two ends on the first portal's line comes first, going from its right to its left end.
static bool comes_before(const funnel *f, end_number a, end_number b) {
    const sl_point right = f->portals.items[0].right, left = f->portals.items[0].left;
    const sl_point p = place_of(f, a), q = place_of(f, b);
    if (left.x != right.x) return left.x > right.x ? p.x < q.x : p.x > q.x;
    return left.y > right.y ? p.y < q.y : p.y > q.y;
}

enum { FIRST_LEFT, FIRST_RIGHT };

/// Cuts while all ends so far lie on the first portal's line. Room for three corners is there.
static void cut_interval(funnel *f, level *l, end_number new) {
    const int side =
        sl_orient(f->portals.items[0].right, f->portals.items[0].left, place_of(f, new));
    f->account.orientations++;
    if (side == 0) {
        if (is_left(new) && comes_before(f, new, l->high)) l->high = new;
        if (!is_left(new) && comes_before(f, l->low, new)) l->low = new;
        l->strict = comes_before(f, l->low, l->high);
        return;
    }
    // Of the two directions along the line, the new end leaves one. Upwards: from right to left.
    const bool upwards = is_left(new) == (side > 0);
    corner *to = f->corners.items + f->corners.count;
    l->first = f->corners.count;
    l->count = 1;
    l->on_line = false;
    to[0] = upwards ? make_corner(f, FIRST_RIGHT, FIRST_LEFT, l->high)
                    : make_corner(f, FIRST_LEFT, FIRST_RIGHT, l->low);
    if (!comes_before(f, l->high, l->low)) {
        to[1] = cut_edge(f, upwards ? l->high : l->low, new, true);
        to[2] = cut_edge(f, upwards ? l->low : l->high, new, false);
        l->count = 3;
    }
    f->corners.count += l->count;
}

/// Takes for each corner on which side its line leaves an end: above 0 where strictly on the right
/// one. Tells the least and the greatest.
static void take_sides(funnel *f, const level *l, sl_point p, int right_side, int *least,
                       int *most) {
    const corner *corners = f->corners.items + l->first;
    signed char *sides = f->sides.items;
    *least = 1;
    *most = -1;
    for (size_t i = 0; i < l->count; i++) {
        const int side = right_side * side_of(f, &corners[i], p);
        sides[i] = (signed char)side;
        *least = side < *least ? side : *least;
        *most = side > *most ? side : *most;
    }
    f->account.orientations += l->count;
}

/// Makes the list anew behind all others, without the corners on the wrong side (they follow on
/// each other, since the polygon is convex) and with those of the cut in their place.
static void splice(funnel *f, level *l, end_number new) {
    const corner *from = f->corners.items + l->first;
    const signed char *sides = f->sides.items;
    const size_t count = l->count;
    size_t end = 0; // of what is kept: the first cut off after one that is not
    while (sides[end] >= 0 || sides[end ? end - 1 : count - 1] < 0) end++;
    size_t first = end; // of what is kept
    do first = first + 1 < count ? first + 1 : 0;
    while (sides[first] < 0);

    corner *const start = f->corners.items + f->corners.count, *to = start;
    for (size_t i = first; i != end; i = i + 1 < count ? i + 1 : 0) *to++ = from[i];
    const size_t last = end ? end - 1 : count - 1, gone = first ? first - 1 : count - 1;
    if (sides[last] > 0) *to++ = cut_edge(f, from[last].pivot, new, true);
    to[-1].pivot = new;
    if (sides[first] > 0) *to++ = cut_edge(f, from[gone].pivot, new, false);
    l->first = f->corners.count;
    l->count = (uint32_t)(to - start);
    f->corners.count += l->count;
}

/// Cuts the lines by an end that they must keep on its side. Room for the corners is there.
static inline void cut(funnel *f, level *l, end_number new, sl_point p) {
    if (l->on_line) {
        cut_interval(f, l, new);
        return;
    }
    int least, most;
    take_sides(f, l, p, is_left(new) ? 1 : -1, &least, &most);
    l->strict = l->strict && most > 0;
    l->hidden = most < 0;
    if (least < 0 && most >= 0) splice(f, l, new);
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
    enclose(f, left);
    enclose(f, right);
    const end_number new = (end_number)(2 * f->portals.count);
    f->portals.items[f->portals.count++] = (sl_portal_ends){left, right};
    level *l = &f->levels.items[f->levels.count++];
    if (f->levels.count == 1) {
        *l = (level){.on_line = true, .strict = true, .low = FIRST_RIGHT, .high = FIRST_LEFT};
    } else {
        *l = l[-1];
        l->corners_before = f->corners.count;
        cut(f, l, new, left);
        if (!l->hidden) cut(f, l, new + 1, right);
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
/// unit length, between where it crosses the first portal and where the last; or (`by_direction`)
/// from the first on in its direction, for portals that lie beside each other.
static sl_line middle_line(const funnel *f, const level *l, bool by_direction) {
    const sl_portal_ends *first = f->portals.items, *last = first + f->portals.count - 1;
    if (l->on_line) {
        const sl_point low = place_of(f, l->low), high = place_of(f, l->high);
        const sl_point middle = {low.x + (high.x - low.x) / 2, low.y + (high.y - low.y) / 2};
        return (sl_line){middle,
                         {middle.x + (first->left.y - first->right.y),
                          middle.y + (first->right.x - first->left.x)}};
    }
    double ux = 0, uy = 0, c = 0;
    for (size_t i = 0; i < l->count; i++) {
        const corner *k = &f->corners.items[l->first + i];
        const double x = k->direction.x, y = k->direction.y, length = hypot(x, y);
        ux += x / length;
        uy += y / length;
        c -= x / length * (k->at.y - first->left.y) - y / length * (k->at.x - first->left.x);
    }
    const sl_point a = crossing_point(f, ux, uy, c, first);
    if (!by_direction) return (sl_line){a, crossing_point(f, ux, uy, c, last)};
    const double size = hypot(first->left.x - first->right.x, first->left.y - first->right.y);
    return (sl_line){a, {a.x + ux * size, a.y + uy * size}};
}

static sl_line witness(const void *state) {
    const funnel *f = state;
    const level *l = &f->levels.items[f->levels.count - 1];
    for (int way = 0; l->strict && way < 2; way++) {
        const sl_line line = middle_line(f, l, way == 1);
        if (is_strict(f, line)) return line;
    }
    if (l->on_line) return (sl_line){f->portals.items[0].right, f->portals.items[0].left};
    const corner *k = &f->corners.items[l->first];
    return (sl_line){k->at, place_of(f, k->to)};
}

static sl_status conflict(sl_context *context, const void *state,
                          sl_stab_end ends[SL_CONFLICT_MOST], uint32_t *count) {
    const funnel *f = state;
    const level *l = &f->levels.items[f->levels.count - 1];
    return sl_conflict_find(context, f->portals.items, f->portals.count, !l->hidden, ends, count);
}

static void account(const void *state, sl_stab_account *sum) {
    const funnel *f = state;
    sum->orientations += f->account.orientations;
    sum->exact += f->account.exact;
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
        .conflict = conflict,
        .account = account,
    };
    return &solver;
}

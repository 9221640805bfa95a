/// The funnel: the incremental exact solver.
///
/// The lines that stab a sequence form a convex polygon in the plane of lines (dual.c). A corner of
/// it is a line through two portal ends. An edge of it is a rotation about one end. Going round the
/// polygon, the line first rotates clockwise about left ends (the left chain), then back about
/// right ends (the right chain). So the list of corners is the funnel between two convex chains.
///
/// A new end is a half-plane that cuts the polygon. One orientation test for each corner says what
/// the cut takes off. Each new corner is the line through the new end and the end of the edge that
/// is cut. No coordinate is ever computed: everything is an orientation test on portal ends.
///
/// Invariant: the list is the polygon of all lines that stab the sequence. The polygon has inner
/// points, and the sequence a line strictly between its ends, exactly if it had them before the cut
/// and some corner lies strictly inside the new half-plane. Without inner points a single line or a
/// rotation about one point is left: lines that graze. While all ends lie on one line, the first
/// portal's, there is no polygon yet but an interval of that line.
///
/// Cost: two orientation tests for each corner of the list. In floor plans there are three to five
/// corners, and four are tested at once. A list is copied only when it is cut, so that a pop
/// restores the old one.
#include "stab/funnel.h"
#include "geometry/length.h"
#include "geometry/orient.h"
#include "sightline/stab.h"
#include "sightline/support.h"

#include <math.h>

/// Two numbers on which one instruction works: x and y of a point, or a number of each of two
/// corners. (Memory is aligned for doubles only.)
typedef double pair __attribute__((vector_size(16), aligned(8)));
typedef int64_t pair_mask __attribute__((vector_size(16)));

/// For what a push does twice, once a side.
#define INLINE __attribute__((always_inline)) static inline

/// Portal i's ends are number 2 i, the left one, and 2 i + 1: a number tells the side.
typedef uint32_t end_number;
enum { FIRST_LEFT, FIRST_RIGHT };

/// A line through two ends, and the end about which it turns to become the next corner's.
typedef struct corner {
    pair at, leftwards; ///< the end `from`, and the way from there to `to` turned left, rounded
    end_number from, to, pivot;
} corner;

/// The lines through the sequence up to one push.
typedef struct level {
    size_t first, count;  ///< its corners; none while all ends lie on one line
    end_number low, high; ///< while they do: right and left end of the interval crossed
    sl_stab_verdict verdict;
} level;

typedef struct funnel {
    SL_ARRAY(corner) corners;
    SL_ARRAY(level) levels;
    SL_ARRAY(pair) ends;     ///< by end_number
    pair least, most;        ///< corners of a box around all ends so far, popped ones too
    pair bound, minus_bound; ///< of the rounding error of a side, for ends in the box; in pairs
    sl_stab_account account;
} funnel;

static sl_status create(sl_context *context, sl_box bounds, void **state) {
    (void)bounds;
    funnel *f = sl_alloc_array(context, 1, sizeof *f);
    if (!f) return SL_NO_MEMORY;
    f->least = (pair){INFINITY, INFINITY};
    f->most = -f->least;
    *state = f;
    return SL_OK;
}

static void destroy(sl_context *context, void *state) {
    funnel *f = state;
    if (!f) return;
    sl_free(context, f->corners.items);
    sl_free(context, f->levels.items);
    sl_free(context, f->ends.items);
    sl_free(context, f);
}

static bool is_left(end_number e) {
    return e % 2 == 0;
}

static sl_point place_of(const funnel *f, end_number e) {
    const pair p = f->ends.items[e];
    return (sl_point){p[0], p[1]};
}

/// Widens the box, and with it the bound on the error of a side. That is Shewchuk's
/// (geometry/orient.h) with the largest that the two products can be in place of what they are, so
/// that it need not be computed for each side.
static inline void enclose(funnel *f, pair p, pair q) {
    const pair_mask outside = (p < f->least) | (p > f->most) | (q < f->least) | (q > f->most);
    if (!(outside[0] | outside[1])) return;
    for (int i = 0; i < 2; i++) {
        f->least[i] = fmin(f->least[i], fmin(p[i], q[i]));
        f->most[i] = fmax(f->most[i], fmax(p[i], q[i]));
    }
    const pair size = f->most - f->least;
    const double bound = 4 * 0x1p-53 * 2 * size[0] * size[1] + 0x1p-1000;
    f->bound = (pair){bound, bound};
    f->minus_bound = -f->bound;
}

/// The two products of a side; their sum is the determinant.
static inline pair products(const corner *c, pair p) {
    return c->leftwards * (p - c->at);
}

/// On which side of the lines of four corners a point lies: bit i says to the left of corner i, bit
/// 4 + i to the right; neither where rounding may have decided.
static inline uint32_t sides_of_four(const corner *c, pair p, pair bound, pair minus_bound) {
    const pair a = products(c, p), b = products(c + 1, p);
    const pair d = products(c + 2, p), e = products(c + 3, p);
    const pair ab = (pair){a[0], b[0]} + (pair){a[1], b[1]};
    const pair de = (pair){d[0], e[0]} + (pair){d[1], e[1]};
    const pair_mask sides =
        ((ab > bound) & (pair_mask){1, 2}) | ((de > bound) & (pair_mask){4, 8}) |
        ((ab < minus_bound) & (pair_mask){16, 32}) | ((de < minus_bound) & (pair_mask){64, 128});
    return (uint32_t)(sides[0] | sides[1]);
}

static inline corner make_corner(const funnel *f, end_number from, end_number to,
                                 end_number pivot) {
    const pair at = f->ends.items[from], forwards = f->ends.items[to] - at;
    return (corner){
        .at = at, .leftwards = {-forwards[1], forwards[0]}, .from = from, .to = to, .pivot = pivot};
}

/// The corner made by a new end on the edge that turns about `pivot`. `leaving`: going round, the
/// cut starts here. Which of the two ends comes first on the line follows from the sense of the
/// turn.
static inline corner cut_edge(const funnel *f, end_number pivot, end_number new, bool leaving) {
    const bool pivot_first = (is_left(pivot) != leaving) == is_left(new);
    return make_corner(f, pivot_first ? pivot : new, pivot_first ? new : pivot,
                       leaving ? new : pivot);
}

/// Which of two ends on the first portal's line comes first, going from its right to its left end.
static bool comes_before(const funnel *f, end_number a, end_number b) {
    const sl_point right = place_of(f, FIRST_RIGHT), left = place_of(f, FIRST_LEFT);
    const sl_point p = place_of(f, a), q = place_of(f, b);
    if (left.x != right.x) return left.x > right.x ? p.x < q.x : p.x > q.x;
    return left.y > right.y ? p.y < q.y : p.y > q.y;
}

/// Cuts while all ends so far lie on the first portal's line. Room for three corners is there.
static void cut_interval(funnel *f, level *l, end_number new) {
    const int side =
        sli_orient(place_of(f, FIRST_RIGHT), place_of(f, FIRST_LEFT), place_of(f, new));
    f->account.orientations++;
    if (side == 0) {
        if (is_left(new) && comes_before(f, new, l->high)) l->high = new;
        if (!is_left(new) && comes_before(f, l->low, new)) l->low = new;
        if (!comes_before(f, l->low, l->high)) l->verdict = SL_GRAZING;
        return;
    }
    // Of the two directions along the line, the new end leaves one. Upwards: from right to left.
    const bool upwards = is_left(new) == (side > 0);
    corner *to = f->corners.items + f->corners.count;
    l->first = f->corners.count;
    l->count = 1;
    to[0] = upwards ? make_corner(f, FIRST_RIGHT, FIRST_LEFT, l->high)
                    : make_corner(f, FIRST_LEFT, FIRST_RIGHT, l->low);
    if (!comes_before(f, l->high, l->low)) {
        to[1] = cut_edge(f, upwards ? l->high : l->low, new, true);
        to[2] = cut_edge(f, upwards ? l->low : l->high, new, false);
        l->count = 3;
    }
    f->corners.count += l->count;
}

/// What a cut leaves of a list. The polygon is convex: going round, the corners outside follow on
/// each other.
typedef struct run {
    size_t last_out, kept; ///< the last corner outside, and how many kept ones follow it
    /// Whether the first and the last of these are strictly inside, so that the edge to the one
    /// next to it is cut.
    bool cuts_entering, cuts_leaving;
} run;

enum { MOST_IN_SETS = 32 };

/// Of at most MOST_IN_SETS corners, a bit each, those strictly inside and those outside.
typedef struct corner_sets {
    uint32_t in, out;
} corner_sets;

/// Decides by exact arithmetic what the filter left open.
static corner_sets decide(funnel *f, const corner *corners, uint32_t open, end_number new,
                          corner_sets sets) {
    for (; open; open &= open - 1) {
        const corner *c = &corners[__builtin_ctz(open)];
        const int side =
            sli_orient_exact(place_of(f, c->from), place_of(f, c->to), place_of(f, new));
        const uint32_t bit = open & -open;
        if (side) *((side > 0) == is_left(new) ? &sets.in : &sets.out) |= bit;
        f->account.exact++;
    }
    return sets;
}

/// On which side of a new end's half-plane the corners are; `all` has a bit for each. The last four
/// may be fewer: what lies behind them is looked at, and left out.
static inline corner_sets meet(funnel *f, const corner *corners, uint32_t count, uint32_t all,
                               end_number new, pair p) {
    uint32_t left = 0, right = 0;
    for (uint32_t i = 0; i < count; i += 4) {
        const uint32_t sides = sides_of_four(corners + i, p, f->bound, f->minus_bound);
        left |= (sides & 15) << i;
        right |= sides >> 4 << i;
    }
    left &= all, right &= all;
    const corner_sets sets = is_left(new) ? (corner_sets){left, right} : (corner_sets){right, left};
    const uint32_t open = all & ~(left | right);
    return open ? decide(f, corners, open, new, sets) : sets;
}

/// Where there are corners of both kinds, outside and not.
static inline run find_run(corner_sets sets, uint32_t count) {
    // Twice round, so that each run is found in one piece.
    const uint64_t out = (uint64_t)sets.out << count | sets.out;
    const uint64_t in = (uint64_t)sets.in << count | sets.in;
    run r;
    r.last_out = (size_t)__builtin_ctzll(out & ~(out >> 1));
    const uint64_t in_kept = in >> (r.last_out + 1);
    r.kept = (size_t)__builtin_ctzll(out >> (r.last_out + 1));
    r.cuts_entering = in_kept & 1;
    r.cuts_leaving = in_kept >> (r.kept - 1) & 1;
    return r;
}

/// Makes the list anew behind all others, without the corners outside and with those of the cut in
/// their place.
INLINE void splice(funnel *f, level *l, run r, end_number new) {
    const corner *from = f->corners.items + l->first;
    corner *const start = f->corners.items + f->corners.count, *to = start;
    size_t i = r.last_out;
    for (size_t kept = 0; kept < r.kept; kept++) {
        i = i + 1 < l->count ? i + 1 : 0;
        *to++ = from[i];
    }
    if (r.cuts_leaving) *to++ = cut_edge(f, from[i].pivot, new, true);
    to[-1].pivot = new;
    if (r.cuts_entering) *to++ = cut_edge(f, from[r.last_out].pivot, new, false);
    l->first = f->corners.count;
    l->count = (size_t)(to - start);
    f->corners.count += l->count;
}

/// As `cut`, for more corners than sets hold.
static void cut_long(funnel *f, level *l, end_number new) {
    const corner *corners = f->corners.items + l->first;
    size_t in = 0, out = 0;
    run r = {0};
    int before = 0;
    for (size_t step = 0; step <= l->count; step++) {
        const size_t i = step ? step - 1 : l->count - 1;
        const sl_point from = place_of(f, corners[i].from), to = place_of(f, corners[i].to);
        const int left = sli_orient(from, to, place_of(f, new)), side = is_left(new) ? left : -left;
        if (step && side >= 0 && before < 0) {
            r.last_out = i ? i - 1 : l->count - 1;
            r.cuts_entering = side > 0;
        }
        if (step && side < 0 && before >= 0) r.cuts_leaving = before > 0;
        in += step && side > 0;
        out += step && side < 0;
        before = side;
    }
    r.kept = l->count - out;
    f->account.orientations += l->count;
    if (!in) l->verdict = r.kept ? SL_GRAZING : SL_HIDDEN;
    if (out && r.kept) splice(f, l, r, new);
}

/// Cuts the lines by an end that they must keep on its side. Room for the corners is there.
INLINE void cut(funnel *f, level *l, end_number new, pair p) {
    if (l->count > MOST_IN_SETS) {
        cut_long(f, l, new);
        return;
    }
    const uint32_t count = (uint32_t)l->count, all = UINT32_MAX >> (MOST_IN_SETS - count);
    const corner_sets sets = meet(f, f->corners.items + l->first, count, all, new, p);
    f->account.orientations += count;
    if (sets.out == all) {
        l->verdict = SL_HIDDEN;
        return;
    }
    if (!sets.in) l->verdict = SL_GRAZING;
    if (sets.out) splice(f, l, find_run(sets, count), new);
}

static sl_status make_room(sl_context *context, funnel *f) {
    // An end adds at most one corner, the first ones three; each of the two cuts of a push may copy
    // the list; and corners are looked at in fours, past the last one too.
    const size_t count = f->levels.count ? f->levels.items[f->levels.count - 1].count : 0;
    SL_TRY(SL_ARRAY_ROOM(context, &f->levels, 1));
    SL_TRY(SL_ARRAY_ROOM(context, &f->ends, 2));
    return SL_ARRAY_ROOM(context, &f->corners, 2 * count + 12);
}

/// Takes over the lines of the level before. Field by field: a load that is wider than the stores
/// which wrote it, a moment ago, must wait for them.
static inline void inherit(level *l) {
    l->first = l[-1].first;
    l->count = l[-1].count;
    l->low = l[-1].low;
    l->high = l[-1].high;
    l->verdict = l[-1].verdict;
}

static sl_status funnel_push(sl_context *context, void *state, sl_point left, sl_point right,
                             sl_stab_verdict *verdict) {
    funnel *f = state;
    SL_TRY(make_room(context, f));
    const pair l = {left.x, left.y}, r = {right.x, right.y};
    enclose(f, l, r);
    const end_number new = (end_number)f->ends.count;
    f->ends.items[new] = l;
    f->ends.items[new + 1] = r;
    f->ends.count += 2;
    level *now = &f->levels.items[f->levels.count++];
    if (new == FIRST_LEFT) {
        *now = (level){.verdict = SL_STABBED, .low = FIRST_RIGHT, .high = FIRST_LEFT};
    } else {
        inherit(now);
        if (now->count)
            cut(f, now, new, l);
        else
            cut_interval(f, now, new);
        if (!now->count)
            cut_interval(f, now, new + 1);
        else if (now->verdict != SL_HIDDEN)
            cut(f, now, new + 1, r);
    }
    *verdict = now->verdict;
    return SL_OK;
}

static void pop(void *state) {
    funnel *f = state;
    f->ends.count -= 2;
    f->levels.count--;
    const level *l = f->levels.items + f->levels.count - 1;
    f->corners.count = f->levels.count ? l->first + l->count : 0;
}

/// The lines found form a convex polygon, so that their directions are those between the corners'.
/// A corner may lie along a portal that bounds the directions asked for, on the far side from them;
/// it then counts as beyond that bound, which is where its neighbours are.
static sl_status toward(sl_context *context, void *state, sl_line right, sl_line left,
                        sl_stab_verdict *verdict) {
    (void)context;
    const funnel *f = state;
    const level *l = &f->levels.items[f->levels.count - 1];
    // Lines through one line's ends alone go in all directions that cross it.
    bool low = !l->count, high = !l->count, between = false, on_bound = false;
    for (size_t i = 0; i < l->count; i++) {
        const corner *c = &f->corners.items[l->first + i];
        const sl_point from = place_of(f, c->from), to = place_of(f, c->to);
        const int of_right = sli_turn(right.a, right.b, from, to);
        const int of_left = sli_turn(left.a, left.b, from, to);
        if (of_right > 0 && of_left < 0) between = true;
        if (of_right >= 0 && of_left <= 0) on_bound = true;
        low |= of_right < 0 || (of_right == 0 && of_left < 0);
        high |= of_left > 0 || (of_left == 0 && of_right > 0);
    }
    if (between || (low && high))
        *verdict = l->verdict;
    else
        *verdict = on_bound ? SL_GRAZING : SL_HIDDEN;
    return SL_OK;
}

/// Whether the line keeps all left ends strictly at its left and all right ends at its right.
static bool is_strict(const funnel *f, sl_line line) {
    for (end_number e = 0; e < f->ends.count; e++)
        if (sli_orient(line.a, line.b, place_of(f, e)) * (is_left(e) ? 1 : -1) <= 0) return false;
    return true;
}

/// Where the line ux (y - oy) - uy (x - ox) + c = 0 crosses the line of a portal, given by its left
/// end; o is the first left end.
static sl_point crossing_point(const funnel *f, double ux, double uy, double c, end_number end) {
    const sl_point o = place_of(f, FIRST_LEFT), left = place_of(f, end);
    const sl_point right = place_of(f, end + 1);
    const double at_left = ux * (left.y - o.y) - uy * (left.x - o.x) + c;
    const double at_right = ux * (right.y - o.y) - uy * (right.x - o.x) + c;
    const double t = at_left / (at_left - at_right);
    return (sl_point){left.x + t * (right.x - left.x), left.y + t * (right.y - left.y)};
}

/// A line in the middle of all, as near as doubles come: the mean of the corners, directions of
/// unit length, between where it crosses the first portal and where the last; or (`by_direction`)
/// from the first on in its direction, for portals that lie beside each other.
static sl_line middle_line(const funnel *f, const level *l, bool by_direction) {
    const sl_point left = place_of(f, FIRST_LEFT), right = place_of(f, FIRST_RIGHT);
    if (!l->count) {
        const sl_point low = place_of(f, l->low), high = place_of(f, l->high);
        const sl_point middle = {low.x + (high.x - low.x) / 2, low.y + (high.y - low.y) / 2};
        return (sl_line){middle, {middle.x + (left.y - right.y), middle.y + (right.x - left.x)}};
    }
    double ux = 0, uy = 0, c = 0;
    for (size_t i = 0; i < l->count; i++) {
        const corner *k = &f->corners.items[l->first + i];
        const double x = k->leftwards[1], y = -k->leftwards[0], length = sli_length(x, y);
        ux += x / length;
        uy += y / length;
        c -= x / length * (k->at[1] - left.y) - y / length * (k->at[0] - left.x);
    }
    const sl_point a = crossing_point(f, ux, uy, c, FIRST_LEFT);
    const end_number last = (end_number)f->ends.count - 2;
    if (!by_direction) return (sl_line){a, crossing_point(f, ux, uy, c, last)};
    const double size = sli_length(left.x - right.x, left.y - right.y);
    return (sl_line){a, {a.x + ux * size, a.y + uy * size}};
}

static sl_line witness(const void *state) {
    const funnel *f = state;
    const level *l = &f->levels.items[f->levels.count - 1];
    for (int way = 0; l->verdict == SL_STABBED && way < 2; way++) {
        const sl_line line = middle_line(f, l, way == 1);
        if (is_strict(f, line)) return line;
    }
    if (!l->count) return (sl_line){place_of(f, FIRST_RIGHT), place_of(f, FIRST_LEFT)};
    const corner *k = &f->corners.items[l->first];
    return (sl_line){place_of(f, k->from), place_of(f, k->to)};
}

static sl_status conflict(sl_context *context, const void *state,
                          sl_stab_end ends[SL_CONFLICT_MOST], uint32_t *count) {
    const funnel *f = state;
    const size_t portal_count = f->levels.count;
    sl_portal_ends *portals = sl_alloc_array(context, portal_count, sizeof *portals);
    if (!portals) return SL_NO_MEMORY;
    for (end_number e = 0; e < f->ends.count; e += 2)
        portals[e / 2] = (sl_portal_ends){place_of(f, e), place_of(f, e + 1)};
    const bool grazing = f->levels.items[portal_count - 1].verdict != SL_HIDDEN;
    const sl_status status =
        sli_conflict_find(context, portals, portal_count, grazing, ends, count);
    sl_free(context, portals);
    return status;
}

static void account(const void *state, sl_stab_account *sum) {
    const funnel *f = state;
    sum->orientations += f->account.orientations;
    sum->exact += f->account.exact;
}

uint32_t sli_funnel_corner_count(const void *state) {
    const funnel *f = state;
    return (uint32_t)f->levels.items[f->levels.count - 1].count;
}

sli_funnel_corner sli_funnel_corner_at(const void *state, uint32_t i) {
    const funnel *f = state;
    const corner *c = &f->corners.items[f->levels.items[f->levels.count - 1].first + i];
    return (sli_funnel_corner){place_of(f, c->from), place_of(f, c->to), place_of(f, c->pivot)};
}

/// The first or the last.
static sl_portal_ends portal_at(const void *state, bool last) {
    const funnel *f = state;
    const end_number left = last ? (end_number)f->ends.count - 2 : FIRST_LEFT;
    return (sl_portal_ends){place_of(f, left), place_of(f, left + 1)};
}

const sl_solver *sl_funnel(void) {
    static const sl_solver solver = {
        .name = "funnel",
        .what = "the two convex chains between which the line may swing, by exact predicates",
        .guarantee = SL_EXACT,
        .create = create,
        .destroy = destroy,
        .push = funnel_push,
        .pop = pop,
        .toward = toward,
        .witness = witness,
        .conflict = conflict,
        .account = account,
    };
    return &solver;
}

// --- the shortest sightline

/// Between two portals, along lines through a point.
typedef struct piece {
    sl_portal_ends first, last;
    sl_point pivot;
} piece;

typedef struct way {
    double x, y; ///< of unit length
} way;

static way way_of(sl_point from, sl_point to) {
    const double x = to.x - from.x, y = to.y - from.y, length = sli_length(x, y);
    return (way){x / length, y / length};
}

static way between(way a, way b, double share) {
    const double x = a.x + share * (b.x - a.x), y = a.y + share * (b.y - a.y);
    const double length = sli_length(x, y);
    return (way){x / length, y / length};
}

/// How far along the way from the pivot a portal is crossed. A portal along the way is crossed
/// where that makes the piece shortest: `late` at its far end, else at its near one.
static double crossed_at(const piece *p, const sl_portal_ends *portal, way d, bool late) {
    const double lx = portal->left.x - p->pivot.x, ly = portal->left.y - p->pivot.y;
    const double rx = portal->right.x - p->pivot.x, ry = portal->right.y - p->pivot.y;
    const double left = d.x * lx + d.y * ly, right = d.x * rx + d.y * ry;
    const double left_off = d.x * ly - d.y * lx, right_off = d.x * ry - d.y * rx;
    const double low = fmin(left, right), high = fmax(left, right);
    if (left_off == right_off) return late ? high : low;
    const double at = left + (right - left) * (left_off / (left_off - right_off));
    return fmin(high, fmax(low, at));
}

static double length_at(const piece *p, way d) {
    const double length = crossed_at(p, &p->last, d, false) - crossed_at(p, &p->first, d, true);
    return fmax(0, length);
}

/// The least over a turn from one way to another, by golden section: the length is convex in the
/// angle, and so has one low.
static double shortest_of_turn(const piece *p, way from, way to) {
    const double golden = 0.6180339887498949;
    double low = 0, high = 1, a = 1 - golden, b = golden;
    double at_a = length_at(p, between(from, to, a)), at_b = length_at(p, between(from, to, b));
    double least = fmin(length_at(p, from), length_at(p, to));
    for (int i = 0; i < 60; i++) {
        if (at_a <= at_b) {
            high = b;
            b = a, at_b = at_a;
            a = high - golden * (high - low);
            at_a = length_at(p, between(from, to, a));
        } else {
            low = a;
            a = b, at_a = at_b;
            b = low + golden * (high - low);
            at_b = length_at(p, between(from, to, b));
        }
        least = fmin(least, fmin(at_a, at_b));
    }
    return least;
}

/// Between two portals on one line.
static double gap(const sl_portal_ends *a, const sl_portal_ends *b) {
    const sl_point p[2] = {a->left, a->right}, q[2] = {b->left, b->right};
    const bool flat = fabs(p[0].x - p[1].x) >= fabs(p[0].y - p[1].y);
    const double a_low = flat ? fmin(p[0].x, p[1].x) : fmin(p[0].y, p[1].y);
    const double a_high = flat ? fmax(p[0].x, p[1].x) : fmax(p[0].y, p[1].y);
    const double b_low = flat ? fmin(q[0].x, q[1].x) : fmin(q[0].y, q[1].y);
    const double b_high = flat ? fmax(q[0].x, q[1].x) : fmax(q[0].y, q[1].y);
    if (a_high >= b_low && b_high >= a_low) return 0;
    double least = INFINITY;
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++)
            least = fmin(least, sli_length(p[i].x - q[k].x, p[i].y - q[k].y));
    return least;
}

double sli_funnel_shortest(const void *state) {
    piece p = {.first = portal_at(state, false), .last = portal_at(state, true)};
    const uint32_t count = sli_funnel_corner_count(state);
    if (!count) return gap(&p.first, &p.last);
    double least = INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        const sli_funnel_corner now = sli_funnel_corner_at(state, i);
        const sli_funnel_corner next = sli_funnel_corner_at(state, i + 1 < count ? i + 1 : 0);
        p.pivot = now.pivot;
        least =
            fmin(least, shortest_of_turn(&p, way_of(now.from, now.to), way_of(next.from, next.to)));
    }
    return least;
}

/// The all-line map: all maximal lines through two corners that see each other (Penn, Conroy,
/// Dalton, Dekker, Mottram and Turner 1997).
///
///     +--------------+           A line is pushed against corners until it cannot move. Then it
///     | .            |           touches two: it grazes a corner, with all walls of the corner on
///     |    ' .       |           one side of it, and goes on (g); or it ends in the corner of a
///     |        g=====+           room (e). At other corners it could still be turned.
///     |        #
///     +--------+                 So each pair of corners is tried. All signs are exact: which
///     walls e                          cross the line, which corners it passes, on which side
///     walls lie.
///
/// Invariant: a line counts once, however many pairs of corners on it find it. What it meets tells
/// it from others in line with it, not its rounded ends. So turned plans have turned lines. Ends
/// are corners, or the rounded places where walls stop it.
///
/// Cost: a walk through the buckets of a grid for each pair of corners, and one across the map for
/// each pair in sight. Most pairs need no walk: what stopped the line to a corner stops those to
/// the corners near it, so the last walls that did are tried first. Corners are independent, so
/// threads take them one by one.
#include "sightline/axial.h"

#include "geometry/orient.h"
#include "sightline/support.h"
#include "space/index.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void sl_axial_lines_destroy(sl_context *context, sl_axial_lines *lines) {
    sl_free(context, lines->lines);
    sl_free(context, lines->probes);
    *lines = (sl_axial_lines){0};
}

#define NONE UINT32_MAX

// --- corners, and walls by place

/// Corners are sorted. Walls are pairs of corners; the walls at corner c lead to the corners
/// ends[first[c] .. first[c + 1]). `open` has the sides of each, going from c, that are inside.
typedef struct plan {
    const sl_space *space;
    sl_point *corners;
    uint32_t (*walls)[2];
    uint32_t *first, *ends;
    uint8_t *open;
    uint32_t count, wall_count;
    // Buckets: columns * rows, with the walls that touch them. Their limits are corners'
    // coordinates such that as many corners lie in each column and row, wherever corners are. The
    // first and the last column and row have no end.
    double *column_limits, *row_limits; ///< columns - 1 and rows - 1, ascending
    uint32_t columns, rows;
    uint32_t *bucket_first, *bucket;
} plan;

static int compare_corners(const void *left, const void *right) {
    return sli_compare_points(*(const sl_point *)left, *(const sl_point *)right);
}

static uint32_t find_corner(const plan *p, sl_point at) {
    uint32_t low = 0, high = p->count;
    while (low + 1 < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (sli_compare_points(p->corners[middle], at) <= 0)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static void plan_destroy(sl_context *context, plan *p) {
    sl_free(context, p->corners);
    sl_free(context, p->walls);
    sl_free(context, p->first);
    sl_free(context, p->ends);
    sl_free(context, p->open);
    sl_free(context, p->column_limits);
    sl_free(context, p->row_limits);
    sl_free(context, p->bucket_first);
    sl_free(context, p->bucket);
}

static sl_status find_corners(sl_context *context, const sl_space *space, plan *p) {
    const uint32_t n = space->wall_count;
    p->space = space;
    p->wall_count = n;
    p->corners = sl_alloc_array(context, 2 * (size_t)n + 1, sizeof *p->corners);
    p->walls = sl_alloc_array(context, (size_t)n + 1, sizeof *p->walls);
    p->ends = sl_alloc_array(context, 2 * (size_t)n + 1, sizeof *p->ends);
    p->open = sl_alloc_array(context, 2 * (size_t)n + 1, sizeof *p->open);
    if (!p->corners || !p->walls || !p->ends || !p->open) return SL_NO_MEMORY;
    for (uint32_t w = 0; w < n; w++) {
        p->corners[2 * w] = space->walls[w].a;
        p->corners[2 * w + 1] = space->walls[w].b;
    }
    qsort(p->corners, 2 * (size_t)n, sizeof *p->corners, compare_corners);
    for (uint32_t i = 0; i < 2 * n; i++)
        if (i == 0 || !sli_same_point(p->corners[i], p->corners[p->count - 1]))
            p->corners[p->count++] = p->corners[i];
    p->first = sl_alloc_array(context, (size_t)p->count + 2, sizeof *p->first);
    if (!p->first) return SL_NO_MEMORY;
    for (uint32_t w = 0; w < n; w++) {
        p->walls[w][0] = find_corner(p, space->walls[w].a);
        p->walls[w][1] = find_corner(p, space->walls[w].b);
        for (int e = 0; e < 2; e++) p->first[p->walls[w][e] + 2]++;
    }
    for (uint32_t c = 0; c < p->count; c++) p->first[c + 2] += p->first[c + 1];
    for (uint32_t w = 0; w < n; w++)
        for (int e = 0; e < 2; e++) p->ends[p->first[p->walls[w][e] + 1]++] = p->walls[w][1 - e];
    return SL_OK;
}

// --- what is inside

enum { LEFT = 1, RIGHT = 2, BOTH = 3 };

static void mark_open(plan *p, uint32_t corner, uint32_t to, int side) {
    for (uint32_t i = p->first[corner]; i < p->first[corner + 1]; i++)
        if (p->ends[i] == to) p->open[i] |= (uint8_t)side;
}

/// Rooms lie at the left of their sides. At a wall's end, the room that touches it there counts.
static void mark_side(plan *p, const sl_outline *outline, const sl_side *side) {
    if (side->neighbour < SL_SIDE_WALL || side->neighbour >= SL_SIDE_BORDER) return;
    const uint32_t wall = side->neighbour - SL_SIDE_WALL;
    if (wall >= p->wall_count) return;
    for (int e = 0; e < 2; e++) {
        const uint32_t corner = p->walls[wall][e], to = p->walls[wall][1 - e];
        if (sli_same_point(side->start, p->corners[corner])) mark_open(p, corner, to, LEFT);
        if (sli_same_point(outline->sides[side->next].start, p->corners[corner]))
            mark_open(p, corner, to, RIGHT);
    }
}

/// Finds on which sides of walls it is inside. No coordinate is computed: cells say it. A line that
/// starts inside stays inside, as no wall crosses it.
static void find_open_sides(const sl_outline *outline, plan *p) {
    for (uint32_t c = 0; c < p->space->cell_count; c++) {
        if (!p->space->cells[c].inside) continue;
        for (uint32_t k = outline->first_part[c]; k < outline->first_part[c + 1]; k++) {
            const uint32_t room = outline->parts[k];
            for (uint32_t i = outline->first[room]; i < sl_outline_stop(outline, room); i++)
                mark_side(p, outline, &outline->sides[i]);
        }
    }
}

// --- buckets

typedef struct span {
    uint32_t from, to; ///< rows
} span;

/// How many limits are at a value or below it: the column or row of the value.
static uint32_t bucket_at(const double *limits, uint32_t count, double value) {
    uint32_t low = 0, high = count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (limits[middle] <= value)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/// More than the rounding of a place between two others.
static double slack_of(double a, double b) {
    return 1e-12 * (fabs(a) + fabs(b));
}

/// The rows that a segment touches in a column; a little more, so that rounding loses none.
static span rows_of(const plan *p, sl_point a, sl_point b, uint32_t column) {
    const double wide = b.x - a.x, slack = slack_of(a.x, b.x);
    double low = fmin(a.y, b.y), high = fmax(a.y, b.y);
    if (fabs(wide) > slack) {
        const double least = fmin(a.x, b.x), most = fmax(a.x, b.x);
        const double left = column ? p->column_limits[column - 1] - slack : least;
        const double right = column + 1 < p->columns ? p->column_limits[column] + slack : most;
        const double in = a.y + (fmin(fmax(left, least), most) - a.x) / wide * (b.y - a.y);
        const double out = a.y + (fmin(fmax(right, least), most) - a.x) / wide * (b.y - a.y);
        low = fmax(low, fmin(in, out));
        high = fmin(high, fmax(in, out));
    }
    const double above = slack_of(a.y, b.y);
    return (span){bucket_at(p->row_limits, p->rows - 1, low - above),
                  bucket_at(p->row_limits, p->rows - 1, high + above)};
}

static span columns_of(const plan *p, sl_point a, sl_point b) {
    const double slack = slack_of(a.x, b.x);
    return (span){bucket_at(p->column_limits, p->columns - 1, fmin(a.x, b.x) - slack),
                  bucket_at(p->column_limits, p->columns - 1, fmax(a.x, b.x) + slack)};
}

/// Keeps, of sorted values, every so many: at most `most`, all different. Returns their number.
static uint32_t keep_limits(double *values, size_t count, uint32_t most) {
    uint32_t kept = 0;
    for (uint32_t i = 1; i <= most; i++) {
        const double value = values[count * i / ((size_t)most + 1)];
        if (!kept || value > values[kept - 1]) values[kept++] = value;
    }
    return kept;
}

/// Sets the limits of about as many buckets as there are walls.
static sl_status choose_limits(sl_context *context, plan *p) {
    const uint32_t most = (uint32_t)sqrt(p->wall_count + 1.0);
    p->column_limits = sl_alloc_array(context, p->count, sizeof *p->column_limits);
    p->row_limits = sl_alloc_array(context, p->count, sizeof *p->row_limits);
    if (!p->column_limits || !p->row_limits) return SL_NO_MEMORY;
    for (uint32_t c = 0; c < p->count; c++) {
        p->column_limits[c] = p->corners[c].x;
        p->row_limits[c] = p->corners[c].y;
    }
    qsort(p->column_limits, p->count, sizeof *p->column_limits, sl_compare_numbers);
    qsort(p->row_limits, p->count, sizeof *p->row_limits, sl_compare_numbers);
    p->columns = 1 + (p->count ? keep_limits(p->column_limits, p->count, most) : 0);
    p->rows = 1 + (p->count ? keep_limits(p->row_limits, p->count, most) : 0);
    return SL_OK;
}

static sl_status fill_buckets(sl_context *context, plan *p) {
    SL_TRY(choose_limits(context, p));
    const size_t squares = (size_t)p->columns * p->rows;
    p->bucket_first = sl_alloc_array(context, squares + 2, sizeof *p->bucket_first);
    if (!p->bucket_first) return SL_NO_MEMORY;
    for (int fill = 0; fill < 2; fill++) {
        for (uint32_t w = 0; w < p->wall_count; w++) {
            const sl_point u = p->corners[p->walls[w][0]], v = p->corners[p->walls[w][1]];
            const span columns = columns_of(p, u, v);
            for (uint32_t c = columns.from; c <= columns.to; c++) {
                const span rows = rows_of(p, u, v, c);
                for (uint32_t r = rows.from; r <= rows.to; r++) {
                    const size_t square = (size_t)c * p->rows + r;
                    if (fill)
                        p->bucket[p->bucket_first[square + 1]++] = w;
                    else
                        p->bucket_first[square + 2]++;
                }
            }
        }
        if (fill) break;
        for (size_t s = 0; s < squares; s++) p->bucket_first[s + 2] += p->bucket_first[s + 1];
        p->bucket =
            sl_alloc_array(context, (size_t)p->bucket_first[squares + 1] + 1, sizeof *p->bucket);
        if (!p->bucket) return SL_NO_MEMORY;
    }
    return SL_OK;
}

// --- a line at a corner

/// The sides of the line from a to b on which walls leave a corner.
static int sides_at(const plan *p, uint32_t corner, sl_point a, sl_point b) {
    int sides = 0;
    for (uint32_t i = p->first[corner]; i < p->first[corner + 1]; i++) {
        const int sign = sli_orient(a, b, p->corners[p->ends[i]]);
        sides |= sign > 0 ? LEFT : sign < 0 ? RIGHT : 0;
    }
    return sides;
}

static bool has_wall(const plan *p, uint32_t corner, uint32_t to) {
    for (uint32_t i = p->first[corner]; i < p->first[corner + 1]; i++)
        if (p->ends[i] == to) return true;
    return false;
}

/// Whether `other` comes before `best` as one turns left from the direction at -> from.
static bool is_sooner(sl_point at, sl_point from, sl_point other, sl_point best) {
    const int to_other = sli_orient(at, from, other), to_best = sli_orient(at, from, best);
    const int half_other = to_other < 0, half_best = to_best < 0;
    if (half_other != half_best) return half_other < half_best;
    return sli_orient(at, other, best) > 0;
}

/// Whether a line that comes from `from` ends at a corner of a room: the open angle about the line
/// is less than half a turn.
static bool ends_in(const plan *p, uint32_t corner, sl_point from) {
    const sl_point at = p->corners[corner];
    uint32_t left = UINT32_MAX, right = UINT32_MAX;
    for (uint32_t i = p->first[corner]; i < p->first[corner + 1]; i++) {
        const uint32_t e = p->ends[i];
        const sl_point end = p->corners[e];
        if (sli_orient(at, from, end) == 0 && sli_goes_on(end, at, from) == false) {
            left = right = e; // along the line
            break;
        }
        if (left == UINT32_MAX || is_sooner(at, from, end, p->corners[left])) left = e;
        if (right == UINT32_MAX || is_sooner(at, from, p->corners[right], end)) right = e;
    }
    if (left == UINT32_MAX) return false;
    if (left != right) return sli_orient(at, p->corners[right], p->corners[left]) > 0;
    return p->first[corner + 1] - p->first[corner] > 1; // along a wall, into its corner
}

/// Whether a corner may be one of the two of a line.
static bool holds_line(const plan *p, uint32_t corner, uint32_t other) {
    const sl_point at = p->corners[corner], from = p->corners[other];
    return sides_at(p, corner, from, at) != BOTH || ends_in(p, corner, from);
}

// --- a pair of corners

static bool is_between(sl_point a, sl_point c, sl_point b) {
    const bool ab = sli_compare_points(a, b) < 0;
    return ab ? sli_compare_points(a, c) < 0 && sli_compare_points(c, b) < 0
              : sli_compare_points(b, c) < 0 && sli_compare_points(c, a) < 0;
}

/// Whether a wall crosses the segment between two corners, or a corner lies on it between them.
static bool is_stopped(const plan *p, const uint32_t wall[2], sl_point a, sl_point b) {
    const sl_point u = p->corners[wall[0]], v = p->corners[wall[1]];
    const int to_u = sli_orient(a, b, u), to_v = sli_orient(a, b, v);
    if (to_u == 0 && is_between(a, u, b)) return true;
    if (to_v == 0 && is_between(a, v, b)) return true;
    return to_u * to_v < 0 && sli_orient(u, v, a) * sli_orient(u, v, b) < 0;
}

/// The first wall found that stops the line between two corners, or NONE.
static uint32_t find_stop(const plan *p, sl_point a, sl_point b) {
    const span columns = columns_of(p, a, b);
    const bool back = a.x > b.x;
    for (uint32_t k = columns.from; k <= columns.to; k++) {
        const uint32_t c = back ? columns.to - (k - columns.from) : k;
        const span rows = rows_of(p, a, b, c);
        for (uint32_t r = rows.from; r <= rows.to; r++) {
            const size_t square = (size_t)c * p->rows + r;
            for (uint32_t i = p->bucket_first[square]; i < p->bucket_first[square + 1]; i++)
                if (is_stopped(p, p->walls[p->bucket[i]], a, b)) return p->bucket[i];
        }
    }
    return NONE;
}

/// The sides of the wall from a corner to another that are inside.
static int open_sides(const plan *p, uint32_t corner, uint32_t to) {
    int sides = 0;
    for (uint32_t i = p->first[corner]; i < p->first[corner + 1]; i++)
        if (p->ends[i] == to) sides |= p->open[i];
    return sides;
}

/// Whether a point is on the border of the bounds; *out is then a place beyond it.
static bool is_on_border(const sl_box *bounds, sl_point at, sl_point *out) {
    *out = at;
    if (at.x == bounds->min.x || at.x == bounds->max.x)
        out->x += (at.x == bounds->min.x ? -1 : 1) * (fabs(at.x) + 1);
    else if (at.y == bounds->min.y || at.y == bounds->max.y)
        out->y += (at.y == bounds->min.y ? -1 : 1) * (fabs(at.y) + 1);
    return !sli_same_point(*out, at);
}

/// Whether the open line from a to b is inside. Along a wall: on that side of it. Else it leaves a
/// between two walls, and is in the room at the left of the one at its right. Where the border of
/// the map lies between these, it is in the room at the right of the other.
static bool is_inside(const plan *p, uint32_t a, uint32_t b, int side) {
    if (side) return open_sides(p, a, b) & side;
    const sl_point at = p->corners[a], to = p->corners[b];
    uint32_t left = p->ends[p->first[a]], right = left;
    for (uint32_t i = p->first[a] + 1; i < p->first[a + 1]; i++) {
        const uint32_t e = p->ends[i];
        if (is_sooner(at, to, p->corners[e], p->corners[left])) left = e;
        if (is_sooner(at, to, p->corners[right], p->corners[e])) right = e;
    }
    sl_point out;
    if (is_on_border(&p->space->bounds, at, &out) && is_sooner(at, to, p->corners[right], out))
        return open_sides(p, a, left) & RIGHT;
    return open_sides(p, a, right) & LEFT;
}

// --- as long as it can be

/// Where something is on the line through a and b: `place` 0 at a, 1 at b.
typedef struct event {
    double place;
    uint32_t corner; ///< NONE: a wall crosses here
    uint32_t wall;
} event;

enum { STOPS = 8 };

typedef struct finder {
    const plan *plan;
    SL_ARRAY(event) events;
    uint32_t stops[STOPS]; ///< walls that stopped lines from this corner, the last one first
    uint32_t stop_count;
} finder;

/// Whether it is on b's side of the line. There is nothing between a and b, so rounding is no harm.
static bool is_ahead(const event *e) {
    return e->place > 0.5;
}

static int compare_events(const void *left, const void *right) {
    const event *a = left, *b = right;
    if (a->place != b->place) return a->place < b->place ? -1 : 1;
    // Corners that rounding does not tell apart keep their order. Walls stop the line after them.
    if ((a->corner == NONE) != (b->corner == NONE))
        return (a->corner == NONE) == is_ahead(a) ? 1 : -1;
    if (a->corner != b->corner) return a->corner < b->corner ? -1 : 1;
    return (a->wall > b->wall) - (a->wall < b->wall);
}

static double place_of(sl_point a, sl_point b, sl_point at) {
    const double dx = b.x - a.x, dy = b.y - a.y;
    return fabs(dx) >= fabs(dy) ? (at.x - a.x) / dx : (at.y - a.y) / dy;
}

/// Adds what one wall does to the line.
static sl_status add_events(sl_context *context, finder *f, uint32_t wall, sl_point a, sl_point b) {
    const plan *p = f->plan;
    const uint32_t *ends = p->walls[wall];
    const sl_point u = p->corners[ends[0]], v = p->corners[ends[1]];
    const int to_u = sli_orient(a, b, u), to_v = sli_orient(a, b, v);
    if (to_u * to_v > 0) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, &f->events, 2));
    if (to_u == 0) f->events.items[f->events.count++] = (event){place_of(a, b, u), ends[0], wall};
    if (to_v == 0) f->events.items[f->events.count++] = (event){place_of(a, b, v), ends[1], wall};
    if (to_u * to_v < 0) {
        const double far = (u.x - a.x) * (b.y - a.y) - (u.y - a.y) * (b.x - a.x);
        const double near = (v.x - a.x) * (b.y - a.y) - (v.y - a.y) * (b.x - a.x);
        double share = far / (far - near);
        if (!(share >= 0 && share <= 1)) share = 0.5; // nearly in one line: somewhere on the wall
        const sl_point at = {u.x + (v.x - u.x) * share, u.y + (v.y - u.y) * share};
        f->events.items[f->events.count++] = (event){place_of(a, b, at), NONE, wall};
    }
    return SL_OK;
}

/// The part of the line through a and b that lies within the bounds, or a little more.
static sl_segment within_bounds(const sl_box *bounds, sl_point a, sl_point b) {
    const double d[2] = {b.x - a.x, b.y - a.y}, at[2] = {a.x, a.y};
    const double least[2] = {bounds->min.x, bounds->min.y};
    const double most[2] = {bounds->max.x, bounds->max.y};
    double from = -INFINITY, to = INFINITY;
    for (int k = 0; k < 2; k++) {
        if (d[k] == 0) continue;
        const double s = (least[k] - at[k]) / d[k], t = (most[k] - at[k]) / d[k];
        from = fmax(from, fmin(s, t));
        to = fmin(to, fmax(s, t));
    }
    return (sl_segment){{a.x + d[0] * from, a.y + d[1] * from}, {a.x + d[0] * to, a.y + d[1] * to}};
}

/// All that the line through two corners meets. A wall may come several times: follow() passes over
/// what it has met.
static sl_status find_events(sl_context *context, finder *f, sl_point a, sl_point b) {
    const plan *p = f->plan;
    const sl_segment whole = within_bounds(&p->space->bounds, a, b);
    const span columns = columns_of(p, whole.a, whole.b);
    f->events.count = 0;
    for (uint32_t c = columns.from; c <= columns.to; c++) {
        const span rows = rows_of(p, whole.a, whole.b, c);
        for (uint32_t r = rows.from; r <= rows.to; r++) {
            const size_t square = (size_t)c * p->rows + r;
            for (uint32_t i = p->bucket_first[square]; i < p->bucket_first[square + 1]; i++)
                SL_TRY(add_events(context, f, p->bucket[i], a, b));
        }
    }
    if (f->events.count)
        qsort(f->events.items, f->events.count, sizeof *f->events.items, compare_events);
    return SL_OK;
}

/// An end of a line. `corner`: the last on the way to it. `wall`: the one that stops it behind that
/// corner; NONE if the corner is the end.
typedef struct tip {
    sl_point at;
    uint32_t corner, wall;
} tip;

/// Follows the line from a corner on it, forwards or backwards, to its end. `sides`: where walls
/// keep it from being. Walls along the line add up: it slides along them on one side, and does not
/// cross over. In a gap between two it may change the side, as a line that is turned a little does.
/// A probe ends where it comes to a wall along it.
static tip follow(const finder *f, uint32_t a, uint32_t b, bool forwards, int sides, bool probe) {
    const plan *p = f->plan;
    const sl_point u = p->corners[a], v = p->corners[b];
    const size_t count = f->events.count;
    uint32_t last = forwards ? b : a;
    sides |= sides_at(p, last, u, v);
    for (size_t k = 0; k < count && sides != BOTH; k++) {
        const event *e = &f->events.items[forwards ? k : count - 1 - k];
        if (is_ahead(e) != forwards || e->corner == last || e->corner == a || e->corner == b)
            continue;
        if (e->corner == NONE)
            return (tip){
                {u.x + (v.x - u.x) * e->place, u.y + (v.y - u.y) * e->place}, last, e->wall};
        const int here = sides_at(p, e->corner, u, v);
        const bool along = has_wall(p, last, e->corner);
        if (along && probe) break;
        sides = along ? sides | here : here;
        last = e->corner;
    }
    return (tip){p->corners[last], last, NONE}; // or the border of the map, if it has no wall
}

// --- all corners

/// A line, and what tells it from others: its first two corners and its last one, and the walls
/// that stop it before and behind them.
typedef struct candidate {
    uint32_t key[5];
    uint32_t by; ///< the corner that found it
    sl_segment line;
} candidate;

typedef struct found {
    SL_ARRAY(candidate) lines;
    SL_ARRAY(sl_segment) probes;
} found;

typedef struct job {
    plan plan;
    found *found; ///< by corner
} job;

static sl_status begin_axial_worker(sl_context *context, void *all, void **state) {
    finder *f = sl_alloc_array(context, 1, sizeof *f);
    if (!f) return SL_NO_MEMORY;
    f->plan = &((job *)all)->plan;
    *state = f;
    return SL_OK;
}

static void end_axial_worker(sl_context *context, void *all, void *state) {
    (void)all;
    sl_free(context, ((finder *)state)->events.items);
    sl_free(context, state);
}

/// The corner after `corner`, going towards b: on a line that comes from before a, to a.
static uint32_t corner_after(const finder *f, uint32_t corner, uint32_t a, uint32_t b) {
    uint32_t next = corner == a ? b : a;
    for (size_t k = f->events.count; k-- > 0 && corner != a;) {
        const event *e = &f->events.items[k];
        if (is_ahead(e) || e->corner == NONE) continue;
        if (e->corner == corner) break;
        next = e->corner;
    }
    return next;
}

/// `side`: of a wall between the two corners, on which the line is; 0 for none.
static sl_status add_line(sl_context *context, finder *f, uint32_t a, uint32_t b, int side,
                          found *out) {
    const int other = side ? BOTH ^ side : 0;
    if (!is_inside(f->plan, a, b, side)) return SL_OK;
    const tip from = follow(f, a, b, false, other, false);
    const tip to = follow(f, a, b, true, other, false);
    SL_TRY(SL_ARRAY_ROOM(context, &out->lines, 1));
    out->lines.items[out->lines.count++] = (candidate){
        {from.corner, corner_after(f, from.corner, a, b), to.corner, from.wall, to.wall},
        a,
        {from.at, to.at}};
    return SL_OK;
}

/// Notes a wall to be tried first from now on; `place`: where it stood, or the number of all.
static void try_first(finder *f, uint32_t wall, uint32_t place) {
    if (place == f->stop_count && place < STOPS) f->stop_count++;
    if (place == STOPS) place--;
    memmove(f->stops + 1, f->stops, place * sizeof *f->stops);
    f->stops[0] = wall;
}

/// Whether a wall that stopped lines to other corners stops this one.
static bool is_stopped_again(finder *f, sl_point a, sl_point b) {
    const plan *p = f->plan;
    for (uint32_t k = 0; k < f->stop_count; k++)
        if (is_stopped(p, p->walls[f->stops[k]], a, b)) {
            try_first(f, f->stops[k], k);
            return true;
        }
    return false;
}

static bool sees_next(finder *f, sl_point a, sl_point b) {
    const uint32_t stop = find_stop(f->plan, a, b);
    if (stop != NONE) try_first(f, stop, f->stop_count);
    return stop == NONE;
}

static sl_status try_pair(sl_context *context, finder *f, uint32_t a, uint32_t b, found *out) {
    const plan *p = f->plan;
    if (is_stopped_again(f, p->corners[a], p->corners[b])) return SL_OK;
    if (!holds_line(p, a, b) || !holds_line(p, b, a)) return SL_OK;
    if (!sees_next(f, p->corners[a], p->corners[b])) return SL_OK;
    const bool along = has_wall(p, a, b);
    if (!along && !is_inside(p, a, b, 0)) return SL_OK;
    SL_TRY(find_events(context, f, p->corners[a], p->corners[b]));
    if (!along) return add_line(context, f, a, b, 0, out);
    SL_TRY(add_line(context, f, a, b, LEFT, out));
    return add_line(context, f, a, b, RIGHT, out);
}

/// The walls at a corner, extended beyond it.
static sl_status extend_walls(sl_context *context, finder *f, uint32_t corner, found *out) {
    const plan *p = f->plan;
    for (uint32_t i = p->first[corner]; i < p->first[corner + 1]; i++) {
        const uint32_t end = p->ends[i];
        const sl_point u = p->corners[end], v = p->corners[corner];
        const int sides = sides_at(p, corner, u, v);
        // Beside the wall there is room on a side without walls, and it goes on beyond the corner.
        if (sides == BOTH || !(open_sides(p, end, corner) & ~sides)) continue;
        SL_TRY(find_events(context, f, u, v));
        const sl_point to = follow(f, end, corner, true, 0, true).at;
        if (sli_same_point(v, to)) continue;
        SL_TRY(SL_ARRAY_ROOM(context, &out->probes, 1));
        out->probes.items[out->probes.count++] = (sl_segment){v, to};
    }
    return SL_OK;
}

static sl_status look_from(sl_context *context, void *all, void *state, size_t corner) {
    job *j = all;
    SL_TRY(sl_check_cancelled(context));
    ((finder *)state)->stop_count = 0;
    for (uint32_t b = (uint32_t)corner + 1; b < j->plan.count; b++)
        SL_TRY(try_pair(context, state, (uint32_t)corner, b, &j->found[corner]));
    return extend_walls(context, state, (uint32_t)corner, &j->found[corner]);
}

static int compare_candidates(const void *left, const void *right) {
    const candidate *a = left, *b = right;
    for (int k = 0; k < 5; k++)
        if (a->key[k] != b->key[k]) return a->key[k] < b->key[k] ? -1 : 1;
    // The same line: as the first pair of corners found it. Others may round its ends otherwise.
    return (a->by > b->by) - (a->by < b->by);
}

/// Each line once, in the order of their corners.
static void gather_lines(const job *j, candidate *all, sl_axial_lines *out) {
    size_t count = 0;
    for (uint32_t c = 0; c < j->plan.count; c++)
        for (size_t i = 0; i < j->found[c].lines.count; i++)
            all[count++] = j->found[c].lines.items[i];
    qsort(all, count, sizeof *all, compare_candidates);
    for (size_t i = 0; i < count; i++)
        if (i == 0 || memcmp(all[i].key, all[i - 1].key, sizeof all[i].key) != 0)
            out->lines[out->count++] = all[i].line;
}

static sl_status gather(sl_context *context, const job *j, sl_axial_lines *out) {
    size_t lines = 0, probes = 0;
    for (uint32_t c = 0; c < j->plan.count; c++) {
        lines += j->found[c].lines.count;
        probes += j->found[c].probes.count;
    }
    if (lines > INT32_MAX || probes > INT32_MAX)
        return sl_fail(context, SL_UNSUPPORTED, "%zu axial lines are too many", lines);
    candidate *all = sl_alloc_array(context, lines + 1, sizeof *all);
    out->lines = sl_alloc_array(context, lines + 1, sizeof *out->lines);
    out->probes = sl_alloc_array(context, probes + 1, sizeof *out->probes);
    if (!all || !out->lines || !out->probes) {
        sl_free(context, all);
        return SL_NO_MEMORY;
    }
    gather_lines(j, all, out);
    sl_free(context, all);
    for (uint32_t c = 0; c < j->plan.count; c++)
        for (size_t i = 0; i < j->found[c].probes.count; i++)
            out->probes[out->probe_count++] = j->found[c].probes.items[i];
    return SL_OK;
}

sl_status sl_axial_all_lines(sl_context *context, const sl_outline *outline, unsigned threads,
                             sl_axial_lines *out) {
    job j = {0};
    sl_axial_lines lines = {0};
    SL_TRY(sli_refuse_limited(context, outline->space, "an axial map", ""));
    sl_status status = find_corners(context, outline->space, &j.plan);
    if (status == SL_OK) find_open_sides(outline, &j.plan);
    if (status == SL_OK) status = fill_buckets(context, &j.plan);
    if (status == SL_OK) {
        j.found = sl_alloc_array(context, (size_t)j.plan.count + 1, sizeof *j.found);
        if (!j.found) status = SL_NO_MEMORY;
    }
    const sl_work work = {.job = &j,
                          .begin = begin_axial_worker,
                          .unit = look_from,
                          .end = end_axial_worker,
                          .stage = "axial lines",
                          .units = "corners"};
    if (status == SL_OK) status = sl_work_run(context, &work, j.plan.count, threads);
    if (status == SL_OK) status = gather(context, &j, &lines);
    for (uint32_t c = 0; c < j.plan.count && j.found; c++) {
        sl_free(context, j.found[c].lines.items);
        sl_free(context, j.found[c].probes.items);
    }
    sl_free(context, j.found);
    plan_destroy(context, &j.plan);
    if (status == SL_OK)
        *out = lines;
    else
        sl_axial_lines_destroy(context, &lines);
    return status;
}

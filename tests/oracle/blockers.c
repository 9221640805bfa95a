/// A grid of walls, and signs that ask rationals where doubles cannot tell.
#include "oracle/blockers.h"
#include "oracle/must.h"

#include <gmp.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct blockers {
    sl_segment *walls;
    size_t count;
    sl_box bounds;
    double pitch; ///< size of a square of the grid
    size_t columns, rows;
    size_t *first; ///< of each square in `walls_of`, and one behind the last
    size_t *walls_of;
    uint64_t *asked; ///< of each wall, the last question that it was looked at for
    uint64_t question;
};

// --- signs

static int turn_by_rationals(sl_point a, sl_point b, sl_point c) {
    mpq_t v[6];
    const double values[6] = {a.x, a.y, b.x, b.y, c.x, c.y};
    for (int i = 0; i < 6; i++) {
        mpq_init(v[i]);
        mpq_set_d(v[i], values[i]);
    }
    mpq_sub(v[2], v[2], v[0]);
    mpq_sub(v[3], v[3], v[1]);
    mpq_sub(v[4], v[4], v[0]);
    mpq_sub(v[5], v[5], v[1]);
    mpq_mul(v[2], v[2], v[5]);
    mpq_mul(v[3], v[3], v[4]);
    const int order = mpq_cmp(v[2], v[3]);
    for (int i = 0; i < 6; i++) mpq_clear(v[i]);
    return (order > 0) - (order < 0);
}

int blockers_turn(sl_point a, sl_point b, sl_point c) {
    const double left = (b.x - a.x) * (c.y - a.y), right = (b.y - a.y) * (c.x - a.x);
    // Each factor and product is off by a relative 2^-53, the difference too: eight of them are
    // more than all that. A product below 1e-290 may have lost bits to underflow.
    const double bound = 8 * 0x1p-53 * (fabs(left) + fabs(right)) + 1e-290;
    const double difference = left - right;
    if (difference > bound) return 1;
    if (difference < -bound) return -1;
    return turn_by_rationals(a, b, c);
}

static bool ranges_meet(double a, double b, double c, double d) {
    return fmin(a, b) <= fmax(c, d) && fmin(c, d) <= fmax(a, b);
}

bool blockers_meet(sl_segment s, sl_segment t) {
    if (!ranges_meet(s.a.x, s.b.x, t.a.x, t.b.x) || !ranges_meet(s.a.y, s.b.y, t.a.y, t.b.y))
        return false;
    // With their boxes meeting, segments on one line do too.
    return blockers_turn(s.a, s.b, t.a) * blockers_turn(s.a, s.b, t.b) <= 0 &&
           blockers_turn(t.a, t.b, s.a) * blockers_turn(t.a, t.b, s.b) <= 0;
}

// --- the grid

static size_t square_of(double value, double least, double pitch, size_t count) {
    const double at = floor((value - least) / pitch);
    if (!(at > 0)) return 0;
    return at < (double)count ? (size_t)at : count - 1;
}

typedef struct squares {
    size_t row, first, last; ///< columns, both included
} squares;

/// The squares of one row that a segment may reach: one more at each side than computed, which
/// covers all rounding.
static squares squares_of(const blockers *walls, sl_segment s, size_t row) {
    const sl_point low = s.a.y <= s.b.y ? s.a : s.b, high = s.a.y <= s.b.y ? s.b : s.a;
    const double bottom = walls->bounds.min.y + ((double)row - 0.5) * walls->pitch;
    const double top = bottom + 2 * walls->pitch;
    double x0 = low.x, x1 = high.x;
    if (high.y - low.y > walls->pitch) {
        const double slope = (high.x - low.x) / (high.y - low.y);
        if (bottom > low.y) x0 = low.x + (bottom - low.y) * slope;
        if (top < high.y) x1 = low.x + (top - low.y) * slope;
    }
    size_t first = square_of(fmin(x0, x1), walls->bounds.min.x, walls->pitch, walls->columns);
    size_t last = square_of(fmax(x0, x1), walls->bounds.min.x, walls->pitch, walls->columns);
    first -= first > 0;
    last += last + 1 < walls->columns;
    return (squares){.row = row, .first = first, .last = last};
}

static void rows_of(const blockers *walls, sl_segment s, size_t *first, size_t *last) {
    *first = square_of(fmin(s.a.y, s.b.y), walls->bounds.min.y, walls->pitch, walls->rows);
    *last = square_of(fmax(s.a.y, s.b.y), walls->bounds.min.y, walls->pitch, walls->rows);
    *first -= *first > 0;
    *last += *last + 1 < walls->rows;
}

/// Counts each square's walls, or writes them where `place` is given.
static void spread(blockers *walls, size_t *counts, size_t *place) {
    for (size_t i = 0; i < walls->count; i++) {
        size_t first, last;
        rows_of(walls, walls->walls[i], &first, &last);
        for (size_t row = first; row <= last; row++) {
            const squares in = squares_of(walls, walls->walls[i], row);
            for (size_t k = in.first; k <= in.last; k++) {
                const size_t square = row * walls->columns + k;
                if (place) place[counts[square]] = i;
                counts[square]++;
            }
        }
    }
}

static void fill_grid(blockers *walls) {
    const size_t squares_count = walls->columns * walls->rows;
    size_t *counts = must(calloc(squares_count + 1, sizeof *counts));
    walls->first = must(calloc(squares_count + 1, sizeof *walls->first));
    spread(walls, counts, NULL);
    for (size_t i = 0; i < squares_count; i++) walls->first[i + 1] = walls->first[i] + counts[i];
    walls->walls_of = must(calloc(walls->first[squares_count] + 1, sizeof *walls->walls_of));
    memcpy(counts, walls->first, (squares_count + 1) * sizeof *counts);
    spread(walls, counts, walls->walls_of);
    free(counts);
}

blockers *blockers_create(const sl_segment *segments, size_t count) {
    blockers *walls = must(calloc(1, sizeof *walls));
    walls->walls = must(calloc(count + 1, sizeof *walls->walls));
    walls->asked = must(calloc(count + 1, sizeof *walls->asked));
    walls->count = count;
    sl_box *box = &walls->bounds;
    for (size_t i = 0; i < count; i++) {
        const sl_segment s = walls->walls[i] = segments[i];
        if (i == 0) *box = (sl_box){s.a, s.a};
        box->min.x = fmin(box->min.x, fmin(s.a.x, s.b.x));
        box->min.y = fmin(box->min.y, fmin(s.a.y, s.b.y));
        box->max.x = fmax(box->max.x, fmax(s.a.x, s.b.x));
        box->max.y = fmax(box->max.y, fmax(s.a.y, s.b.y));
    }
    const double width = box->max.x - box->min.x, height = box->max.y - box->min.y;
    walls->pitch = fmax(width, height) / (2 + 2 * sqrt((double)count));
    if (!(walls->pitch > 0)) walls->pitch = 1;
    walls->columns = (size_t)(width / walls->pitch) + 1;
    walls->rows = (size_t)(height / walls->pitch) + 1;
    fill_grid(walls);
    return walls;
}

void blockers_destroy(blockers *walls) {
    free(walls->walls);
    free(walls->asked);
    free(walls->first);
    free(walls->walls_of);
    free(walls);
}

// --- questions

/// The share of the way at which the segment's line meets the wall's; infinite where it does not.
static double share_to(sl_segment s, sl_segment wall) {
    const double dx = s.b.x - s.a.x, dy = s.b.y - s.a.y;
    const double wx = wall.b.x - wall.a.x, wy = wall.b.y - wall.a.y;
    const double across = dx * wy - dy * wx;
    if (across == 0) return HUGE_VAL;
    const double ax = wall.a.x - s.a.x, ay = wall.a.y - s.a.y;
    const double along = (ax * dy - ay * dx) / across;
    const double share = (ax * wy - ay * wx) / across;
    return along >= -1e-9 && along <= 1 + 1e-9 && share >= 0 ? share : HUGE_VAL;
}

/// Calls back with each wall that the segment may meet, once, as long as that says to go on.
static void visit(blockers *walls, sl_segment s, bool (*each)(void *user, size_t wall),
                  void *user) {
    size_t first, last;
    rows_of(walls, s, &first, &last);
    walls->question++;
    for (size_t row = first; row <= last; row++) {
        const squares in = squares_of(walls, s, row);
        const size_t *const starts = walls->first + row * walls->columns;
        for (size_t k = starts[in.first]; k < starts[in.last + 1]; k++) {
            const size_t wall = walls->walls_of[k];
            if (walls->asked[wall] == walls->question) continue;
            walls->asked[wall] = walls->question;
            if (!each(user, wall)) return;
        }
    }
}

typedef struct question {
    const blockers *walls;
    sl_segment segment;
    bool met;
    double reach;
    size_t nearest;
} question;

static bool ask_free(void *user, size_t wall) {
    question *asked = user;
    asked->met = blockers_meet(asked->segment, asked->walls->walls[wall]);
    return !asked->met;
}

bool blockers_free(blockers *walls, sl_segment sightline) {
    question asked = {.walls = walls, .segment = sightline};
    visit(walls, sightline, ask_free, &asked);
    return !asked.met;
}

static bool ask_reach(void *user, size_t wall) {
    question *asked = user;
    const double share = share_to(asked->segment, asked->walls->walls[wall]);
    if (share < asked->reach) {
        asked->reach = share;
        asked->nearest = wall;
    }
    return true;
}

double blockers_reach(blockers *walls, sl_segment s, size_t *wall) {
    const double length = hypot(s.b.x - s.a.x, s.b.y - s.a.y);
    question asked = {.walls = walls, .segment = s, .reach = 1, .nearest = SIZE_MAX};
    // Near walls are found without going all the way.
    for (double part = 4 * walls->pitch / length;; part *= 4) {
        part = part < 1 ? part : 1;
        const sl_point end = {s.a.x + (s.b.x - s.a.x) * part, s.a.y + (s.b.y - s.a.y) * part};
        visit(walls, (sl_segment){s.a, end}, ask_reach, &asked);
        if (asked.reach <= part || part == 1) break;
    }
    *wall = asked.nearest;
    return asked.reach;
}

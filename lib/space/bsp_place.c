/// Choosing the corners of a split: the only place of the library where coordinates of the space
/// are computed. What is computed is a guess, of which exact predicates take or refuse what stands
/// near it in doubles.
#include "space/bsp.h"

/// How many doubles about the computed place are tried, each way.
enum { AROUND = 3 };

/// A side that the line crosses, with what limits new corners near it.
typedef struct gate {
    const sl_bsp *bsp;
    sl_point left, right; ///< the side's ends, on either side of the line
    sl_point guess;
    double step_x, step_y; ///< between neighbouring doubles there
    const sl_wall *wall;   ///< on the side, or NULL
    bool reversed;
    /// Sides that follow on the left end, and on the right end: faces stay convex where a new
    /// corner is not to the right of them.
    sl_segment at_left[2], at_right[2];
    int left_count, right_count;
} gate;

static sl_point corner_at(const sl_bsp_sides *sides, size_t i, int offset) {
    const size_t count = sides->count;
    return sides->items[(i + count + (size_t)(offset + (int)count)) % count].from;
}

/// Adds what the face has beside one of its sides, which the line leaves through or comes in by.
static void add_neighbours(gate *g, const sl_bsp_face *face, size_t side, bool out) {
    const sl_bsp_sides *s = &face->sides;
    const sl_segment before = {corner_at(s, side, -1), corner_at(s, side, 0)};
    const sl_segment after = {corner_at(s, side, 1), corner_at(s, side, 2)};
    g->at_left[g->left_count++] = out ? after : before;
    g->at_right[g->right_count++] = out ? before : after;
}

static double spacing(double a, double b) {
    const double size = fmax(fabs(a), fabs(b));
    return nextafter(size, INFINITY) - size;
}

/// Where the line crosses the side, about. In long doubles where they are any longer.
static sl_point cross_at(const gate *g) {
    const long double ax = g->bsp->a.x, ay = g->bsp->a.y;
    const long double dx = g->bsp->b.x - ax, dy = g->bsp->b.y - ay;
    const long double left = dx * (g->left.y - ay) - dy * (g->left.x - ax);
    const long double right = dx * (g->right.y - ay) - dy * (g->right.x - ax);
    long double t = right / (right - left);
    // The ends' signs are exact, their distances not: the one that has lost its sign is the nearer.
    if (!(t >= 0 && t <= 1)) t = fabsl(left) < fabsl(right) ? 1 : 0;
    sl_point p = {(double)(g->right.x + t * ((long double)g->left.x - g->right.x)),
                  (double)(g->right.y + t * ((long double)g->left.y - g->right.y))};
    if (g->bsp->a.x == g->bsp->b.x) p.x = g->bsp->a.x;
    if (g->bsp->a.y == g->bsp->b.y) p.y = g->bsp->a.y;
    if (g->left.x == g->right.x) p.x = g->left.x;
    if (g->left.y == g->right.y) p.y = g->left.y;
    return p;
}

static gate make_gate(const sl_bsp *bsp, const sl_bsp_passage *passage, bool out) {
    const sl_bsp_face *face = &bsp->faces.items[passage->face];
    const size_t number = out ? passage->exit.side : passage->entry.side;
    const sl_bsp_side *side = &face->sides.items[number];
    const sl_point end = sl_side_end(&face->sides, number);
    gate g = {.bsp = bsp, .left = out ? end : side->from, .right = out ? side->from : end};
    if (side->what < SL_BEYOND_BORDER) {
        g.wall = &bsp->walls[side->what];
        g.reversed = side->reversed;
    }
    g.guess = cross_at(&g);
    g.step_x = g.left.x == g.right.x ? 0 : spacing(g.left.x, g.right.x);
    g.step_y = g.left.y == g.right.y ? 0 : spacing(g.left.y, g.right.y);
    add_neighbours(&g, face, number, out);
    return g;
}

/// Between the side's ends, seen along the axis that it follows more.
static bool is_between(const gate *g, sl_point p) {
    const sl_point a = g->left, b = g->right;
    if (fabs(a.x - b.x) >= fabs(a.y - b.y)) return fmin(a.x, b.x) < p.x && p.x < fmax(a.x, b.x);
    return fmin(a.y, b.y) < p.y && p.y < fmax(a.y, b.y);
}

static int count_bent(const sl_segment *sides, int count, sl_point p) {
    int bent = 0;
    for (int i = 0; i < count; i++) bent += sl_orient(sides[i].a, sides[i].b, p) < 0;
    return bent;
}

static double distance(sl_point a, sl_point b) {
    return hypot(a.x - b.x, a.y - b.y);
}

// --- where a wall passes: a corner for each side of it

typedef struct choice {
    sl_point at;
    double faults, distance;
} choice;

/// Weighs a corner for the faces on one side of a wall: it must be on the wall's line or beyond.
static void weigh(const gate *g, bool left, sl_point p, choice *best) {
    if (!sl_coordinate_usable(p.x) || !sl_coordinate_usable(p.y) || !is_between(g, p)) return;
    const int side = sl_orient(g->bsp->a, g->bsp->b, p);
    if (left ? side > 0 : side < 0) return;
    if (g->wall && !sl_bsp_behind(g->wall, g->reversed, p)) return;
    const int bent = left ? count_bent(g->at_left, g->left_count, p)
                          : count_bent(g->at_right, g->right_count, p);
    const choice new = {p, 2 * bent + (side != 0), distance(p, g->guess)};
    if (new.faults < best->faults || (new.faults == best->faults &&new.distance < best->distance))
        *best = new;
}

static void weigh_around(const gate *g, bool left, sl_point p, int around, choice *best) {
    const int x = g->step_x ? around : 0, y = g->step_y ? around : 0;
    for (int i = -x; i <= x; i++)
        for (int k = -y; k <= y; k++)
            weigh(g, left, (sl_point){p.x + i * g->step_x, p.y + k * g->step_y}, best);
}

/// As near as can be; at higher tries at a distance from the wall, eight times larger at every
/// other one, so that pieces which rounding has left without any area get some. Between them
/// `before`, the corner where the wall enters the face, is taken if it will do: a needle is so thin
/// that in doubles both corners are one.
static sl_point place_behind(const gate *g, bool left, uint32_t try, const sl_point *before) {
    const sl_point far = left ? g->right : g->left;
    const double reach = distance(g->guess, far);
    double share = ldexp(fmax(g->step_x, g->step_y), 3 * (int)(try / 2)) / reach;
    choice best = {far, INFINITY, INFINITY};
    if (before && try % 2) {
        weigh(g, left, *before, &best);
        if (best.faults < 2) return best.at;
        best = (choice){far, INFINITY, INFINITY};
    }
    if (try < 2) {
        weigh_around(g, left, g->guess, AROUND, &best);
        share = 0x1p-48;
    }
    // Where the wall runs nearly along the side, what is behind it begins farther off.
    for (; share < 1 && best.faults == INFINITY; share *= 2)
        weigh_around(g, left,
                     (sl_point){g->guess.x + share * (far.x - g->guess.x),
                                g->guess.y + share * (far.y - g->guess.y)},
                     1, &best);
    return best.at;
}

// --- where a seam passes: one corner for both sides of it

static void weigh_seam(const gate *g, sl_point p, choice *best) {
    if (!sl_coordinate_usable(p.x) || !sl_coordinate_usable(p.y) || !is_between(g, p)) return;
    if (g->wall && !sl_bsp_behind(g->wall, g->reversed, p)) return;
    const int bent =
        count_bent(g->at_left, g->left_count, p) + count_bent(g->at_right, g->right_count, p);
    const int side = sl_orient(g->bsp->a, g->bsp->b, p);
    const choice new = {p, 2 * bent + (side != 0), distance(p, g->guess)};
    if (new.faults < best->faults || (new.faults == best->faults &&new.distance < best->distance))
        *best = new;
}

/// A vector made as short as whole multiples of powers of two allow: both parts are whole, without
/// a common factor.
static sl_point shorten(double dx, double dy) {
    double factor = fabs(dx), rest = fabs(dy);
    while (rest > 0) {
        const double left = fmod(factor, rest);
        factor = rest;
        rest = left;
    }
    return (sl_point){dx / factor, dy / factor};
}

/// Places on the line of the side itself, no nearer than `least` and no farther than `most`: where
/// faces go on along it beyond both of the side's ends, only those bend none. Doubles hold some
/// where its slope is simple.
static void weigh_on_side(const gate *g, double least, double most, choice *best) {
    const sl_point a = g->wall ? g->wall->a : g->right, b = g->wall ? g->wall->b : g->left;
    const sl_point d = shorten(b.x - a.x, b.y - a.y);
    const double t = fabs(d.x) >= fabs(d.y) ? (g->guess.x - a.x) / d.x : (g->guess.y - a.y) / d.y;
    double step = fmax(g->step_x, g->step_y);
    for (int i = 0; i < 8 && best->faults >= 2; i++, step *= 8)
        for (int k = -1; k <= 2; k++) {
            const double part = (floor(t / step) + k) * step;
            const sl_point p = {a.x + part * d.x, a.y + part * d.y};
            const double away = distance(p, g->guess);
            if (away >= least && away <= most) weigh_seam(g, p, best);
        }
}

/// The nearest place that bends no face, on the seam's line if there is one. At higher tries what
/// is near is passed over. False where there is none nearer than rounding explains.
static bool place_seam(const gate *g, uint32_t try, sl_point *at) {
    const double length = distance(g->left, g->right);
    // What rounding adds to it stays below the other half.
    const double most = fmin(0x1p-20 * length, sl_bsp_seam_slack(&g->bsp->bounds) / 2);
    const double step = fmax(g->step_x, g->step_y);
    const double ux = (g->left.x - g->right.x) / length, uy = (g->left.y - g->right.y) / length;
    choice best = {g->guess, INFINITY, INFINITY};
    for (int k = (int)try; best.faults >= 2 && k < 40; k++) {
        const double off = k ? ldexp(step, k + 1) : 0;
        if (off > most) break;
        for (int sign = -1; sign <= 1; sign += 2)
            for (int i = g->step_x ? -AROUND : 0; i <= (g->step_x ? AROUND : 0); i++)
                for (int j = g->step_y ? -AROUND : 0; j <= (g->step_y ? AROUND : 0); j++)
                    weigh_seam(g,
                               (sl_point){g->guess.x + sign * off * ux + i * g->step_x,
                                          g->guess.y + sign * off * uy + j * g->step_y},
                               &best);
        if (k == (int)try) weigh_on_side(g, off, most, &best);
    }
    *at = best.at;
    return best.faults < INFINITY;
}

// --- where the line is free: a new corner exactly on it, or one that is there

/// Whether a free line may end in a point: on the side or, where a portal or a wall leaves room,
/// beside it, with no face bent by it.
static bool may_end(const gate *g, const sl_bsp_passage *passage, bool out, sl_point last,
                    sl_point p) {
    const sl_bsp *bsp = g->bsp;
    if (!sl_coordinate_usable(p.x) || !sl_coordinate_usable(p.y) || !is_between(g, p) ||
        sl_orient(bsp->a, bsp->b, p) != 0)
        return false;
    const double ahead = sl_bsp_key(bsp, p) - sl_bsp_key(bsp, last);
    if (out ? ahead <= 0 : ahead >= 0) return false;
    const double room = fmin(distance(g->left, g->right), distance(last, g->guess));
    if (!(distance(p, g->guess) <= 0x1p-30 * room)) return false;
    const sl_bsp_face *face = &bsp->faces.items[passage->face];
    const size_t number = out ? passage->exit.side : passage->entry.side;
    const uint32_t what = face->sides.items[number].what;
    const int inside =
        sl_orient(face->sides.items[number].from, sl_side_end(&face->sides, number), p);
    if (what == SL_BEYOND_BORDER ? inside != 0
        : g->wall                ? !sl_bsp_behind(g->wall, g->reversed, p)
                                 : inside < 0)
        return false;
    if (count_bent(g->at_left, g->left_count, p) || count_bent(g->at_right, g->right_count, p))
        return false;
    const size_t count = face->sides.count;
    for (size_t i = 2; i + 1 < count; i++) {
        const size_t k = (number + i) % count;
        if (sl_orient(face->sides.items[k].from, sl_side_end(&face->sides, k), p) <= 0)
            return false;
    }
    return true;
}

/// Points that are some 2^-m-th part of the wall along its line: doubles hold them where the wall's
/// own coordinates have few bits.
static bool place_on_line(const gate *g, const sl_bsp_passage *passage, bool out, sl_point last,
                          sl_point *at) {
    for (int i = g->step_x ? -AROUND : 0; i <= (g->step_x ? AROUND : 0); i++)
        for (int k = g->step_y ? -AROUND : 0; k <= (g->step_y ? AROUND : 0); k++) {
            *at = (sl_point){g->guess.x + i * g->step_x, g->guess.y + k * g->step_y};
            if (may_end(g, passage, out, last, *at)) return true;
        }
    const sl_point a = g->bsp->a, b = g->bsp->b;
    const double dx = b.x - a.x, dy = b.y - a.y;
    const double t = fabs(dx) >= fabs(dy) ? (g->guess.x - a.x) / dx : (g->guess.y - a.y) / dy;
    for (int bits = 48; bits >= 32; bits -= 4)
        for (int i = -1; i <= 2; i++) {
            const double part = ldexp(floor(ldexp(t, bits)) + i, -bits);
            *at = (sl_point){a.x + part * dx, a.y + part * dy};
            if (may_end(g, passage, out, last, *at)) return true;
        }
    return false;
}

// --- the corners of all passages

static void set_ends(sl_bsp_passage *passage, bool out, sl_point left, sl_point right) {
    *(out ? &passage->exit_left : &passage->entry_left) = left;
    *(out ? &passage->exit_right : &passage->entry_right) = right;
}

/// Corners for a wall that passes a side, or meets a wall on it.
static void place_walled(sl_bsp *bsp, sl_bsp_passage *passage, bool out, sl_bsp_passage *next) {
    gate g = make_gate(bsp, passage, out);
    if (next) {
        const size_t side = out ? next->entry.side : next->exit.side;
        add_neighbours(&g, &bsp->faces.items[next->face], side, !out);
    }
    const uint32_t *tries = out ? passage->exit_try : passage->entry_try;
    if (sl_bsp_is_seam(bsp, out ? passage->exit_wall : passage->entry_wall)) {
        sl_point at;
        if (!place_seam(&g, tries[0] > tries[1] ? tries[0] : tries[1], &at)) bsp->unplaced = true;
        set_ends(passage, out, at, at);
        if (next) set_ends(next, !out, at, at);
        return;
    }
    const bool entered = out && (passage->entry.at_corner || passage->entry.walled);
    const sl_point left = place_behind(&g, true, tries[1], entered ? &passage->entry_left : NULL);
    const sl_point right =
        place_behind(&g, false, tries[0], entered ? &passage->entry_right : NULL);
    set_ends(passage, out, left, right);
    if (next) set_ends(next, !out, left, right);
}

/// Whether the last stop before a free end is in line with what comes before it.
static bool is_straight(const sl_bsp_passage *passage, bool out) {
    if (passage->stop_count > 1) return true;
    return out ? sl_same_point(passage->entry_left, passage->entry_right)
               : sl_same_point(passage->exit_left, passage->exit_right);
}

/// Whether the face has one corner only to the right of the line.
static bool is_right_corner_alone(const sl_bsp *bsp, const sl_bsp_passage *passage) {
    const size_t count = bsp->faces.items[passage->face].sides.count;
    const size_t last = passage->exit.side + (passage->exit.at_corner ? count - 1 : 0);
    return last % count == (passage->entry.side + 1) % count;
}

static void place_free(sl_bsp *bsp, sl_bsp_passage *passage, bool out) {
    const sl_bsp_stop *stops = bsp->stops.items + passage->first_stop;
    const sl_point last = stops[out ? passage->stop_count - 1 : 0].at;
    gate g = make_gate(bsp, passage, out);
    const sl_bsp_sides *sides = &bsp->faces.items[passage->face].sides;
    const size_t number = out ? passage->exit.side : passage->entry.side;
    const sl_bsp_side *side = &sides->items[number];
    if (side->what == SL_BEYOND_EXIT) {
        const sl_bsp_face *beyond = &bsp->faces.items[side->beyond];
        for (size_t i = 0; i < beyond->sides.count; i++)
            if (sl_same_point(beyond->sides.items[i].from, sl_side_end(sides, number)) &&
                sl_same_point(sl_side_end(&beyond->sides, i), side->from))
                add_neighbours(&g, beyond, i, !out);
    }
    sl_point at;
    const bool fresh = !passage->failures[0] && !passage->failures[1];
    if (fresh && is_straight(passage, out) && place_on_line(&g, passage, out, last, &at)) {
        *(out ? &passage->exit_new : &passage->entry_new) = true;
        set_ends(passage, out, at, at);
        return;
    }
    // A lone corner may have to serve the wall at its other end.
    at = is_right_corner_alone(bsp, passage) ? g.left : g.right;
    set_ends(passage, out, at, at);
}

static void place_exact(sl_bsp *bsp, sl_bsp_passage *passage, bool out) {
    const sl_bsp_crossing *c = out ? &passage->exit : &passage->entry;
    const sl_bsp_side *side = &bsp->faces.items[passage->face].sides.items[c->side];
    const sl_point at = c->at_corner ? side->from : c->touch;
    *(out ? &passage->exit_new : &passage->entry_new) = c->touches;
    set_ends(passage, out, at, at);
}

void sl_bsp_place(sl_bsp *bsp) {
    bsp->unplaced = false;
    const size_t count = bsp->passages.count;
    for (size_t i = 0; i < count; i++)
        for (int out = 0; out < 2; out++) {
            sl_bsp_passage *passage = &bsp->passages.items[i];
            const sl_bsp_crossing *c = out ? &passage->exit : &passage->entry;
            *(out ? &passage->exit_new : &passage->entry_new) = false;
            if (c->at_corner || c->touches)
                place_exact(bsp, passage, out);
            else if (c->walled && !(i && !out)) // the passage before has placed that
                place_walled(bsp, passage, out, i + 1 < count && out ? passage + 1 : NULL);
        }
    // Free ends come last: how they are placed depends on the other end.
    for (size_t i = 0; i < count; i++)
        for (int out = 0; out < 2; out++) {
            sl_bsp_passage *passage = &bsp->passages.items[i];
            const sl_bsp_crossing *c = out ? &passage->exit : &passage->entry;
            if (!c->at_corner && !c->touches && !c->walled) place_free(bsp, passage, out);
        }
}

/// Counts a try for the corner where a wall leaves or enters a passage.
static bool count_try(sl_bsp *bsp, size_t number, bool out, bool left) {
    enum { MOST_TRIES = 40 };
    sl_bsp_passage *passage = &bsp->passages.items[number];
    const sl_bsp_crossing *c = out ? &passage->exit : &passage->entry;
    if (c->at_corner || c->touches || !c->walled) return false;
    if (!out && number) passage = &bsp->passages.items[number - 1];
    uint32_t *tries = out || number ? passage->exit_try : passage->entry_try;
    return tries[left]++ < MOST_TRIES;
}

bool sl_bsp_try_farther(sl_bsp *bsp) {
    const size_t number = bsp->failed_passage;
    const bool left = bsp->failed_left;
    // One corner farther off, then the other, then both.
    const uint32_t round = bsp->passages.items[number].failures[left]++;
    bool tried = round <= SL_BSP_PATIENCE;
    if (round % 3 != 1) tried |= count_try(bsp, number, true, left);
    if (round % 3 != 0) tried |= count_try(bsp, number, false, left);
    return tried || (round % 3 != 2);
}

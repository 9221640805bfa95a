// Cells come in two ways. Over portals: of a ray that goes from cell to cell through portals and
// mirrors that it meets, ends included, and of what lies along it, crosses all to the same side; at
// a mirror ray and eye are reflected. And, of rays that touch nothing, from the walls alone: each
// is cut at the first wall, and goes on from there where that is a mirror. The two must agree.
#include "oracle/mirrored.h"

#include "oracle/dyadic.h"
#include "oracle/must.h"

#include <assert.h>
#include <gmp.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

typedef struct vector {
    mpz_t x, y;
} vector;

/// Of a wall, portal or piece of a mirror: as crossed on the way out of its cell, where it has one.
typedef struct piece {
    vector left, right;
    uint32_t cell, to;
    uint32_t mirror; ///< UINT32_MAX for none
} piece;

typedef struct looker {
    const sl_space *space;
    const sl_map *map;
    uint32_t depth;
    bool *sources; ///< by cell: whether the eye stands in it
    double range;
    int exponent;
    piece *ways; ///< portals and mirrors, by cell
    size_t way_count;
    vector *dark; ///< two a piece of glass, left and right as crossed from where it is dark
    size_t dark_count;
    vector *walls, *corners; ///< two a wall; corners by vertex
    vector *mirrors;         ///< two a mirror
    vector *directions;      ///< sorted
    size_t direction_count, room;
    oracle_mirrored out;
    vector s, t, u; ///< scratch
    mpz_t p, q;
} looker;

static void init(vector *v) {
    mpz_inits(v->x, v->y, NULL);
}

static void clear(vector *v) {
    mpz_clears(v->x, v->y, NULL);
}

static void copy(vector *out, const vector *v) {
    mpz_set(out->x, v->x);
    mpz_set(out->y, v->y);
}

static void set_point(const looker *l, vector *out, sl_point p) {
    const double values[2] = {p.x, p.y};
    for (int i = 0; i < 2; i++) {
        const dyadic d = dyadic_of(values[i]);
        mpz_ptr z = i ? out->y : out->x;
        mpz_set_d(z, (double)d.odd); // as in eye.c
        if (d.odd) mpz_mul_2exp(z, z, (mp_bitcnt_t)(d.exponent - l->exponent));
    }
}

static void subtract(vector *out, const vector *a, const vector *b) {
    mpz_sub(out->x, a->x, b->x);
    mpz_sub(out->y, a->y, b->y);
}

static int turn(looker *l, const vector *a, const vector *b) {
    mpz_mul(l->p, a->x, b->y);
    mpz_submul(l->p, a->y, b->x);
    return mpz_sgn(l->p);
}

static int forward(looker *l, const vector *a, const vector *b) {
    mpz_mul(l->p, a->x, b->x);
    mpz_addmul(l->p, a->y, b->y);
    return mpz_sgn(l->p);
}

/// Of a point, or of a direction (`free`), in the line of a mirror.
static void reflect(const looker *l, uint32_t mirror, bool free, vector *v) {
    const vector *at = &l->mirrors[2 * mirror];
    const bool upright = mpz_cmp(at[0].x, at[1].x) == 0;
    mpz_ptr z = upright ? v->x : v->y;
    mpz_neg(z, z);
    if (free) return;
    mpz_add(z, z, upright ? at[0].x : at[0].y);
    mpz_add(z, z, upright ? at[0].x : at[0].y);
}

// --- directions

static int half_of(const vector *v) {
    const int y = mpz_sgn(v->y);
    return y < 0 || (y == 0 && mpz_sgn(v->x) < 0);
}

static int by_direction(const void *left, const void *right) {
    const vector *a = left, *b = right;
    const int halves = half_of(a) - half_of(b);
    if (halves) return halves;
    mpz_t p;
    mpz_init(p);
    mpz_mul(p, a->x, b->y);
    mpz_submul(p, a->y, b->x);
    const int sign = mpz_sgn(p);
    mpz_clear(p);
    return -sign;
}

/// Towards a point where mirrored space has it, and away from it.
static void add_direction(looker *l, const vector *eye, const vector *point) {
    subtract(&l->s, point, eye);
    if (mpz_sgn(l->s.x) == 0 && mpz_sgn(l->s.y) == 0) return;
    if (l->direction_count + 2 > l->room) {
        l->room = 2 * l->room + 64;
        l->directions = must(realloc(l->directions, l->room * sizeof *l->directions));
    }
    for (int i = 0; i < 2; i++) {
        vector *to = &l->directions[l->direction_count++];
        init(to);
        copy(to, &l->s);
        mpz_neg(l->s.x, l->s.x);
        mpz_neg(l->s.y, l->s.y);
    }
}

/// Of all points, as seen behind a chain of mirrors: instead of the points the eye is reflected, by
/// the chain's first mirror first, and directions back.
static void add_directions(looker *l, const vector *eye, uint32_t *chain, uint32_t length) {
    const size_t first = l->direction_count;
    for (uint32_t i = 0; i < l->space->vertex_count; i++) add_direction(l, eye, &l->corners[i]);
    for (uint32_t i = 0; i < 2 * l->space->wall_count; i++) add_direction(l, eye, &l->walls[i]);
    for (uint32_t i = 0; i < 2 * l->map->mirror_count; i++) add_direction(l, eye, &l->mirrors[i]);
    for (size_t i = 0; i < 2 * l->dark_count; i++) add_direction(l, eye, &l->dark[i]);
    for (size_t i = 0; i < l->way_count; i++) {
        add_direction(l, eye, &l->ways[i].left);
        add_direction(l, eye, &l->ways[i].right);
    }
    for (size_t i = first; i < l->direction_count; i++)
        for (uint32_t k = length; k-- > 0;) reflect(l, chain[k], true, &l->directions[i]);
    if (length == l->depth) return;
    for (uint32_t m = 0; m < l->map->mirror_count; m++) {
        if (length && chain[length - 1] == m) continue;
        vector image;
        init(&image);
        copy(&image, eye);
        reflect(l, m, false, &image);
        chain[length] = m;
        add_directions(l, &image, chain, length + 1);
        clear(&image);
    }
}

/// Towards the nearest place of all lines: those of portals are axial, and so are mirrors.
static void add_axes(looker *l, const vector *eye) {
    vector beside;
    init(&beside);
    for (int axis = 0; axis < 2; axis++) {
        copy(&beside, eye);
        mpz_add_ui(axis ? beside.y : beside.x, axis ? beside.y : beside.x, 1);
        add_direction(l, eye, &beside);
    }
    clear(&beside);
}

static void sort_directions(looker *l) {
    qsort(l->directions, l->direction_count, sizeof *l->directions, by_direction);
    size_t kept = 0;
    for (size_t i = 0; i < l->direction_count; i++) {
        if (kept && by_direction(&l->directions[kept - 1], &l->directions[i]) == 0)
            clear(&l->directions[i]);
        else
            l->directions[kept++] = l->directions[i];
    }
    l->direction_count = kept;
}

// --- over portals

/// A direction along which cells are entered, and those between which the nearest place counts that
/// is seen of a portal: for closed sight the direction itself.
typedef struct beam {
    vector eye, to, borders[2];
    bool open;
} beam;

static void init_beam(beam *b, const vector *eye, const vector *to, const vector *right,
                      const vector *left) {
    init(&b->eye), init(&b->to), init(&b->borders[0]), init(&b->borders[1]);
    copy(&b->eye, eye), copy(&b->to, to);
    copy(&b->borders[0], right), copy(&b->borders[1], left);
    b->open = right != left;
}

static void clear_beam(beam *b) {
    clear(&b->eye), clear(&b->to), clear(&b->borders[0]), clear(&b->borders[1]);
}

/// Of two squares, top / under and the range's.
static bool is_within(const looker *l, const mpz_t top, const mpz_t under, bool open) {
    mpq_t square, range;
    mpq_inits(square, range, NULL);
    mpz_set(mpq_numref(square), top);
    mpz_set(mpq_denref(square), under);
    mpq_canonicalize(square);
    mpq_set_d(range, l->range);
    mpq_mul(range, range, range);
    if (l->exponent < 0)
        mpq_mul_2exp(range, range, (mp_bitcnt_t)(-2 * l->exponent));
    else
        mpq_div_2exp(range, range, (mp_bitcnt_t)(2 * l->exponent));
    const int order = mpq_cmp(square, range);
    mpq_clears(square, range, NULL);
    return open ? order < 0 : order <= 0;
}

/// Whether a border meets a portal's line within the range.
static bool border_reaches(looker *l, const beam *b, int border, const piece *way) {
    mpz_t top, under;
    mpz_inits(top, under, NULL);
    subtract(&l->s, &way->left, &way->right);
    subtract(&l->t, &way->right, &b->eye);
    turn(l, &l->t, &l->s);
    mpz_mul(top, l->p, l->p);
    forward(l, &b->borders[border], &b->borders[border]);
    mpz_mul(top, top, l->p);
    turn(l, &b->borders[border], &l->s);
    mpz_mul(under, l->p, l->p);
    const bool reaches = mpz_sgn(under) && is_within(l, top, under, b->open);
    mpz_clears(top, under, NULL);
    return reaches;
}

/// Whether an end of a portal is at the eye or within the range.
static bool end_reaches(looker *l, const beam *b, const vector *end) {
    mpz_t top, under;
    mpz_inits(top, under, NULL);
    mpz_set_ui(under, 1);
    subtract(&l->s, end, &b->eye);
    forward(l, &l->s, &l->s);
    mpz_set(top, l->p);
    const bool reaches = is_within(l, top, under, b->open);
    mpz_clears(top, under, NULL);
    return reaches;
}

/// Whether what is seen of a portal, which the beam meets, is within the range.
static bool reaches(looker *l, const beam *b, const piece *way) {
    if (!(l->range > 0)) return true;
    subtract(&l->s, &way->left, &b->eye);
    subtract(&l->t, &way->right, &b->eye);
    if (turn(l, &l->t, &l->s) == 0)
        return forward(l, &l->t, &l->s) <= 0 || end_reaches(l, b, &way->left) ||
               end_reaches(l, b, &way->right);
    return border_reaches(l, b, 0, way) || border_reaches(l, b, 1, way);
}

static bool meets(looker *l, const vector *eye, const vector *to, const piece *way, int *side) {
    subtract(&l->s, &way->left, eye);
    subtract(&l->t, &way->right, eye);
    subtract(&l->u, &l->s, &l->t);
    *side = 0;
    if (turn(l, to, &l->s) < 0 || turn(l, to, &l->t) > 0) return false;
    if (turn(l, to, &l->u) != 0) return turn(l, &l->t, &l->u) >= 0;
    *side = forward(l, to, &l->u) > 0 ? 2 : 1;
    return forward(l, to, &l->s) >= 0 || forward(l, to, &l->t) >= 0;
}

/// Whether a direction enters a cell that the eye stands in, or runs along its border.
static bool leads_into(looker *l, const beam *b, uint32_t number) {
    const sl_cell *cell = &l->space->cells[number];
    const vector *corners = l->corners + cell->first_vertex;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        subtract(&l->s, &corners[(i + 1) % cell->vertex_count], &corners[i]);
        subtract(&l->t, &b->eye, &corners[i]);
        if (turn(l, &l->s, &l->t) == 0 && turn(l, &l->s, &b->to) < 0) return false;
    }
    return true;
}

/// `cells`: those seen directly, and those seen by mirror.
static void walk(looker *l, const beam *b, uint32_t cell, int side, uint32_t depth, uint32_t last,
                 bool *seen, bool *const cells[2]) {
    if (seen[3 * cell + (uint32_t)side]) return;
    seen[3 * cell + (uint32_t)side] = true;
    cells[depth > 0][cell] =
        depth > 0 || !l->sources[cell] || cells[0][cell] || leads_into(l, b, cell);
    for (size_t i = 0; i < l->way_count; i++) {
        const piece *way = &l->ways[i];
        const bool is_mirror = way->mirror != UINT32_MAX;
        int crossed;
        if (way->cell != cell || !meets(l, &b->eye, &b->to, way, &crossed)) continue;
        if ((side && crossed && side != crossed) || !reaches(l, b, way)) continue;
        const int now = side ? side : crossed;
        if (!is_mirror) {
            walk(l, b, way->to, now, depth, UINT32_MAX, seen, cells);
        } else if (depth < l->depth && last != way->mirror) {
            beam on;
            init_beam(&on, &b->eye, &b->to, &b->borders[0], &b->borders[1]);
            on.open = b->open;
            reflect(l, way->mirror, false, &on.eye);
            reflect(l, way->mirror, true, &on.to);
            for (int k = 0; k < 2; k++) reflect(l, way->mirror, true, &on.borders[k]);
            bool *fresh = must(calloc(3 * (size_t)l->space->cell_count, sizeof *fresh));
            walk(l, &on, cell, now ? 3 - now : 0, depth + 1, way->mirror, fresh, cells);
            free(fresh);
            clear_beam(&on);
        }
    }
}

// --- from the walls alone

/// A wedge of rays that touch nothing: the eye's image, a ray within, the borders.
typedef struct wedge {
    vector eye, middle, right, left;
} wedge;

/// How far along the middle a line is met, num / den with den > 0; false where it is not ahead.
static bool meet_line(looker *l, const wedge *w, const vector *a, const vector *b, mpz_t num,
                      mpz_t den) {
    subtract(&l->s, b, a);
    subtract(&l->t, a, &w->eye);
    turn(l, &l->t, &l->s);
    mpz_set(num, l->p);
    turn(l, &w->middle, &l->s);
    mpz_set(den, l->p);
    if (mpz_sgn(den) < 0) {
        mpz_neg(num, num);
        mpz_neg(den, den);
    }
    return mpz_sgn(den) > 0 && mpz_sgn(num) > 0;
}

static bool middle_meets(looker *l, const wedge *w, const vector *a, const vector *b) {
    subtract(&l->s, a, &w->eye);
    subtract(&l->t, b, &w->eye);
    return turn(l, &w->middle, &l->s) * turn(l, &w->middle, &l->t) < 0;
}

/// The first wall or dark glass beyond a place on the middle: its ends.
static bool first_wall(looker *l, const wedge *w, const mpz_t from_num, const mpz_t from_den,
                       mpz_t num, mpz_t den, const vector **wall) {
    mpz_t n, d, x, y;
    mpz_inits(n, d, x, y, NULL);
    bool found = false;
    const size_t walls = l->space->wall_count;
    for (size_t i = 0; i < walls + l->dark_count; i++) {
        const vector *at = i < walls ? &l->walls[2 * i] : &l->dark[2 * (i - walls)];
        subtract(&l->s, &at[0], &at[1]);
        if (i >= walls && turn(l, &w->middle, &l->s) <= 0) continue; // from where glass is clear
        if (!middle_meets(l, w, &at[0], &at[1]) || !meet_line(l, w, &at[0], &at[1], n, d)) continue;
        mpz_mul(x, n, from_den);
        mpz_mul(y, from_num, d);
        if (mpz_cmp(x, y) <= 0) continue;
        mpz_mul(x, n, den);
        mpz_mul(y, num, d);
        if (found && mpz_cmp(x, y) >= 0) continue;
        found = true;
        mpz_set(num, n);
        mpz_set(den, d);
        *wall = at;
    }
    mpz_clears(n, d, x, y, NULL);
    return found;
}

/// The mirror that reflects the middle where it meets a wall; UINT32_MAX for none.
static uint32_t mirror_there(looker *l, const wedge *w, const vector *at) {
    for (uint32_t i = 0; i < l->map->mirror_count; i++) {
        const vector *m = &l->mirrors[2 * i];
        subtract(&l->s, &m[1], &m[0]);
        subtract(&l->t, &at[0], &m[0]);
        subtract(&l->u, &at[1], &m[0]);
        if (turn(l, &l->s, &l->t) || turn(l, &l->s, &l->u)) continue;
        // It comes from the mirror's left where it goes to its right.
        if (l->map->mirrors[i].one_sided && turn(l, &l->s, &w->middle) > 0) continue;
        if (middle_meets(l, w, &m[0], &m[1])) return i;
    }
    return UINT32_MAX;
}

/// Whether the middle passes the inside of a box between two places.
static void cross_cells(looker *l, const wedge *w, mpz_t from_num, mpz_t from_den, mpz_t to_num,
                        mpz_t to_den, bool *cells) {
    mpq_t from, to, low, high, q;
    mpq_inits(from, to, low, high, q, NULL);
    for (uint32_t c = 0; c < l->space->cell_count; c++) {
        const vector *box = &l->corners[l->space->cells[c].first_vertex];
        mpq_set_num(from, from_num);
        mpq_set_den(from, from_den);
        mpq_set_num(to, to_num);
        mpq_set_den(to, to_den);
        mpq_canonicalize(from);
        mpq_canonicalize(to);
        bool passes = true;
        for (int axis = 0; axis < 2 && passes; axis++) {
            mpz_srcptr d = axis ? w->middle.y : w->middle.x, e = axis ? w->eye.y : w->eye.x;
            mpz_srcptr a = axis ? box[0].y : box[0].x, b = axis ? box[2].y : box[2].x;
            if (mpz_cmp(a, b) > 0) {
                mpz_srcptr swap = a;
                a = b;
                b = swap;
            }
            if (mpz_sgn(d) == 0) {
                passes = mpz_cmp(a, e) < 0 && mpz_cmp(e, b) < 0;
                continue;
            }
            for (int end = 0; end < 2; end++) {
                mpq_t *out = (end == 0) == (mpz_sgn(d) > 0) ? &low : &high;
                mpz_sub(mpq_numref(*out), end ? b : a, e);
                mpz_set(mpq_denref(*out), d);
                mpq_canonicalize(*out);
            }
            if (mpq_cmp(low, from) > 0) mpq_set(from, low);
            if (mpq_cmp(high, to) < 0) mpq_set(to, high);
        }
        if (passes && mpq_cmp(from, to) < 0) cells[c] = true;
    }
    mpq_clears(from, to, low, high, q, NULL);
}

/// Where a ray of the wedge meets a line, as seen from the eye, in the map's unit.
static sl_point place_on(looker *l, const wedge *w, const vector *to, const vector *line) {
    subtract(&l->s, &line[1], &line[0]);
    subtract(&l->t, &line[0], &w->eye);
    turn(l, &l->t, &l->s);
    mpz_set(l->q, l->p);
    turn(l, to, &l->s);
    mpq_t share, x;
    mpq_inits(share, x, NULL);
    mpz_set(mpq_numref(share), l->q);
    mpz_set(mpq_denref(share), l->p);
    mpq_canonicalize(share);
    sl_point out;
    for (int i = 0; i < 2; i++) {
        mpq_set_z(x, i ? to->y : to->x);
        mpq_mul(x, x, share);
        *(i ? &out.y : &out.x) = ldexp(mpq_get_d(x), l->exponent);
    }
    mpq_clears(share, x, NULL);
    return out;
}

/// Twice the area of the triangle of the eye and p, q, within the range.
static double area_within(sl_point p, sl_point q, double range) {
    const double whole = fabs(p.x * q.y - p.y * q.x); // 0 where they are one
    if (!(range > 0) || (p.x == q.x && p.y == q.y)) return whole;
    const double dx = q.x - p.x, dy = q.y - p.y, length = hypot(dx, dy);
    const double ux = dx / length, uy = dy / length, far = fabs(p.x * uy - p.y * ux);
    const double from = p.x * ux + p.y * uy, to = q.x * ux + q.y * uy;
    const double half = far < range ? sqrt(range * range - far * far) : 0;
    const double a = fmin(fmax(from, -half), half), b = fmin(fmax(to, -half), half);
    const double inside = far * fabs(b - a);
    const double angle =
        fabs(atan2(to, far) - atan2(from, far)) - fabs(atan2(b, far) - atan2(a, far));
    return inside + (far < range ? angle : fabs(atan2(to, far) - atan2(from, far))) * range * range;
}

static void add_area(looker *l, const wedge *w, const vector *far, uint32_t mirror, size_t chain) {
    double area =
        area_within(place_on(l, w, &w->right, far), place_on(l, w, &w->left, far), l->range);
    if (mirror != UINT32_MAX) {
        const vector *near = &l->mirrors[2 * mirror];
        area -=
            area_within(place_on(l, w, &w->right, near), place_on(l, w, &w->left, near), l->range);
    }
    l->out.areas[chain] += area / 2;
}

/// Follows a wedge that touches nothing from wall to wall.
static void trace(looker *l, wedge *w, bool *cells) {
    mpz_t from_num, from_den, num, den;
    mpz_inits(from_num, from_den, num, den, NULL);
    mpz_set_ui(from_den, 1);
    size_t chain = 0;
    uint32_t mirror = UINT32_MAX;
    const vector *wall = NULL;
    for (uint32_t depth = 0; first_wall(l, w, from_num, from_den, num, den, &wall); depth++) {
        if (depth) cross_cells(l, w, from_num, from_den, num, den, cells);
        add_area(l, w, wall, mirror, chain);
        mirror = mirror_there(l, w, wall);
        if (mirror == UINT32_MAX || depth == l->depth) break;
        chain = chain * (l->map->mirror_count + 1) + mirror + 1;
        reflect(l, mirror, false, &w->eye);
        vector *const rays[3] = {&w->middle, &w->right, &w->left};
        for (int i = 0; i < 3; i++) reflect(l, mirror, true, rays[i]);
        mpz_set(from_num, num);
        mpz_set(from_den, den);
    }
    mpz_clears(from_num, from_den, num, den, NULL);
}

// --- all directions

/// Whether a direction is within the view; `middle`: strictly.
static bool in_view(looker *l, const sl_view *view, const vector *eye, const vector *to) {
    if (view->full) return true;
    vector right, left;
    init(&right);
    init(&left);
    set_point(l, &right, view->right);
    set_point(l, &left, view->left);
    subtract(&right, &right, eye);
    subtract(&left, &left, eye);
    const int from = turn(l, &right, to), upto = turn(l, to, &left), all = turn(l, &right, &left);
    const bool at_right = from == 0 && forward(l, &right, to) > 0;
    const bool at_left = upto == 0 && forward(l, to, &left) > 0;
    bool in = at_right || at_left;
    if (all > 0) in = in || (from > 0 && upto > 0);
    if (all < 0) in = in || from > 0 || upto > 0;
    if (all == 0 && forward(l, &right, &left) < 0) in = in || from > 0;
    clear(&right);
    clear(&left);
    return in;
}

static void look_along(looker *l, const beam *b, bool *direct, bool *mirrored) {
    bool *seen = must(calloc(3 * (size_t)l->space->cell_count, sizeof *seen));
    for (uint32_t c = 0; c < l->space->cell_count; c++)
        if (l->sources[c]) walk(l, b, c, 0, 0, UINT32_MAX, seen, (bool *const[]){direct, mirrored});
    free(seen);
}

static void look_between(looker *l, const sl_view *view, const vector *eye, size_t i,
                         bool *traced) {
    const vector *a = &l->directions[i], *b = &l->directions[(i + 1) % l->direction_count];
    wedge w;
    init(&w.eye), init(&w.middle), init(&w.right), init(&w.left);
    copy(&w.eye, eye), copy(&w.right, a), copy(&w.left, b);
    assert(turn(l, a, b) > 0);
    mpz_add(w.middle.x, a->x, b->x);
    mpz_add(w.middle.y, a->y, b->y);
    if (in_view(l, view, eye, &w.middle)) {
        beam between;
        init_beam(&between, eye, &w.middle, a, b);
        look_along(l, &between, l->out.direct_open, l->out.open);
        clear_beam(&between);
        if (!l->out.on_wall) trace(l, &w, traced);
    }
    clear(&w.eye), clear(&w.middle), clear(&w.right), clear(&w.left);
}

static void look(looker *l, const sl_view *view, const vector *eye) {
    const uint32_t cells = l->space->cell_count;
    bool *traced = must(calloc(cells, sizeof *traced));
    for (size_t i = 0; i < l->direction_count; i++) {
        const vector *to = &l->directions[i];
        beam along;
        init_beam(&along, eye, to, to, to);
        if (in_view(l, view, eye, to)) look_along(l, &along, l->out.direct_closed, l->out.closed);
        clear_beam(&along);
        look_between(l, view, eye, i, traced);
    }
    for (uint32_t c = 0; c < cells; c++) {
        // The walls alone know nothing of the range.
        assert(l->range > 0 || l->out.on_wall || traced[c] == l->out.open[c]);
        l->out.closed[c] |= l->out.open[c];
        l->out.direct_closed[c] |= l->out.direct_open[c];
        if (l->sources[c]) l->out.direct_open[c] = l->out.direct_closed[c];
    }
    free(traced);
}

// --- begin and end

static void lower(int *exponent, double value) {
    const dyadic d = dyadic_of(value);
    if (d.odd && d.exponent < *exponent) *exponent = d.exponent;
}

static void find_exponent(looker *l, const sl_view *view) {
    const sl_space *s = l->space;
    const sl_point points[3] = {view->eye, view->left, view->right};
    l->exponent = INT_MAX;
    for (uint32_t i = 0; i < s->vertex_count; i++) {
        lower(&l->exponent, s->vertices[i].x);
        lower(&l->exponent, s->vertices[i].y);
    }
    for (uint32_t i = 0; i < s->wall_count; i++) {
        const double at[4] = {s->walls[i].a.x, s->walls[i].a.y, s->walls[i].b.x, s->walls[i].b.y};
        for (int k = 0; k < 4; k++) lower(&l->exponent, at[k]);
    }
    for (size_t i = 0; i < l->map->mirror_count; i++) {
        const sl_segment m = l->map->mirrors[i].segment;
        const double at[4] = {m.a.x, m.a.y, m.b.x, m.b.y};
        for (int k = 0; k < 4; k++) lower(&l->exponent, at[k]);
    }
    for (uint32_t i = 0; i < s->directed_count; i++) {
        const double at[4] = {s->directed[i].left.x, s->directed[i].left.y, s->directed[i].right.x,
                              s->directed[i].right.y};
        for (int k = 0; k < 4; k++) lower(&l->exponent, at[k]);
    }
    for (int i = 0; i < (view->full ? 1 : 3); i++) {
        lower(&l->exponent, points[i].x);
        lower(&l->exponent, points[i].y);
    }
}

static void add_way(looker *l, sl_point left, sl_point right, uint32_t cell, uint32_t to,
                    uint32_t mirror) {
    l->ways = must(realloc(l->ways, (l->way_count + 1) * sizeof *l->ways));
    piece *way = &l->ways[l->way_count++];
    init(&way->left);
    init(&way->right);
    set_point(l, &way->left, left);
    set_point(l, &way->right, right);
    way->cell = cell;
    way->to = to;
    way->mirror = mirror;
}

/// What of a mirror lies on a side of a box, counter-clockwise.
static void add_mirror(looker *l, uint32_t cell, sl_point from, sl_point to, uint32_t mirror) {
    const sl_segment at = l->map->mirrors[mirror].segment;
    const bool upright = at.a.x == at.b.x;
    if (upright != (from.x == to.x) || (upright ? at.a.x != from.x : at.a.y != from.y)) return;
    const double sign = upright ? (to.y > from.y ? 1 : -1) : (to.x > from.x ? 1 : -1);
    const double low = sign * (upright ? from.y : from.x), high = sign * (upright ? to.y : to.x);
    const double a = sign * (upright ? at.a.y : at.a.x), b = sign * (upright ? at.b.y : at.b.x);
    if (l->map->mirrors[mirror].one_sided && a > b) return;
    const double start = fmax(low, fmin(a, b)), stop = fmin(high, fmax(a, b));
    if (start >= stop) return;
    const sl_point right =
        upright ? (sl_point){from.x, sign * start} : (sl_point){sign * start, from.y};
    const sl_point left =
        upright ? (sl_point){from.x, sign * stop} : (sl_point){sign * stop, from.y};
    add_way(l, left, right, cell, cell, mirror);
}

/// The portals that a cell has no directed portal to: as crossed from there, had it one.
static void gather_dark(looker *l) {
    const sl_space *s = l->space;
    l->dark = must(calloc(4 * (size_t)s->portal_count + 1, sizeof *l->dark));
    for (uint32_t i = 0; i < s->portal_count; i++)
        for (int side = 0; side < 2; side++) {
            const sl_portal *p = &s->portals[i];
            const sl_cell *cell = &s->cells[p->cell[side]];
            bool directed = false;
            for (uint32_t k = cell->first_directed; k < cell->first_directed + cell->directed_count;
                 k++)
                directed |= s->directed[k].portal == i;
            if (directed) continue;
            vector *ends = &l->dark[2 * l->dark_count++];
            init(&ends[0]), init(&ends[1]);
            set_point(l, &ends[0], side ? p->right : p->left);
            set_point(l, &ends[1], side ? p->left : p->right);
        }
}

static void gather(looker *l) {
    const sl_space *s = l->space;
    l->walls = must(calloc(2 * (size_t)s->wall_count + 1, sizeof *l->walls));
    l->corners = must(calloc(s->vertex_count, sizeof *l->corners));
    l->mirrors = must(calloc(2 * l->map->mirror_count + 1, sizeof *l->mirrors));
    for (uint32_t i = 0; i < 2 * s->wall_count; i++) {
        init(&l->walls[i]);
        set_point(l, &l->walls[i], i % 2 ? s->walls[i / 2].b : s->walls[i / 2].a);
    }
    for (uint32_t i = 0; i < s->vertex_count; i++) {
        init(&l->corners[i]);
        set_point(l, &l->corners[i], s->vertices[i]);
    }
    for (uint32_t i = 0; i < 2 * l->map->mirror_count; i++) {
        const sl_segment at = l->map->mirrors[i / 2].segment;
        init(&l->mirrors[i]);
        set_point(l, &l->mirrors[i], i % 2 ? at.b : at.a);
    }
    for (uint32_t c = 0; c < s->cell_count; c++) {
        const sl_cell *cell = &s->cells[c];
        const sl_point *v = s->vertices + cell->first_vertex;
        for (uint32_t i = cell->first_directed; i < cell->first_directed + cell->directed_count;
             i++)
            add_way(l, s->directed[i].left, s->directed[i].right, c, s->directed[i].cell,
                    UINT32_MAX);
        for (uint32_t k = 0; k < 4; k++)
            for (uint32_t m = 0; m < l->map->mirror_count; m++)
                add_mirror(l, c, v[k], v[(k + 1) % 4], m);
    }
}

static bool touches(looker *l, const vector *eye, const vector *a, const vector *b) {
    subtract(&l->s, a, eye);
    subtract(&l->t, b, eye);
    return turn(l, &l->s, &l->t) == 0 && forward(l, &l->s, &l->t) <= 0;
}

/// The eye stands in its cell, and in those that portals at the eye join with it.
static void stand_in(looker *l, const vector *eye, uint32_t cell) {
    l->sources[cell] = true;
    for (size_t i = 0; i < l->way_count; i++) {
        const piece *way = &l->ways[i];
        if (way->cell == cell && !l->sources[way->to] && touches(l, eye, &way->left, &way->right))
            stand_in(l, eye, way->to);
    }
}

static void release(looker *l) {
    for (uint32_t i = 0; i < 2 * l->space->wall_count; i++) clear(&l->walls[i]);
    for (uint32_t i = 0; i < l->space->vertex_count; i++) clear(&l->corners[i]);
    for (uint32_t i = 0; i < 2 * l->map->mirror_count; i++) clear(&l->mirrors[i]);
    for (size_t i = 0; i < l->way_count; i++) {
        clear(&l->ways[i].left);
        clear(&l->ways[i].right);
    }
    for (size_t i = 0; i < l->direction_count; i++) clear(&l->directions[i]);
    for (size_t i = 0; i < 2 * l->dark_count; i++) clear(&l->dark[i]);
    free(l->dark);
    free(l->sources), free(l->walls), free(l->corners), free(l->mirrors), free(l->ways),
        free(l->directions);
    clear(&l->s), clear(&l->t), clear(&l->u);
    mpz_clears(l->p, l->q, NULL);
}

size_t oracle_chains(const sl_map *map, uint32_t depth) {
    size_t count = 1;
    while (depth-- > 0) count *= map->mirror_count + 1;
    return count;
}

oracle_mirrored oracle_mirrored_of(const sl_space *space, const sl_map *map, const sl_view *view,
                                   double range, uint32_t depth) {
    looker l = {.space = space, .map = map, .depth = depth, .range = range};
    vector eye;
    init(&eye), init(&l.s), init(&l.t), init(&l.u);
    mpz_inits(l.p, l.q, NULL);
    l.sources = must(calloc(space->cell_count, sizeof(bool)));
    l.out.closed = must(calloc(space->cell_count, sizeof(bool)));
    l.out.open = must(calloc(space->cell_count, sizeof(bool)));
    l.out.direct_closed = must(calloc(space->cell_count, sizeof(bool)));
    l.out.direct_open = must(calloc(space->cell_count, sizeof(bool)));
    l.out.areas = must(calloc(oracle_chains(map, depth), sizeof(double)));
    find_exponent(&l, view);
    set_point(&l, &eye, view->eye);
    gather(&l);
    stand_in(&l, &eye, sl_space_locate(space, view->eye));
    gather_dark(&l);
    uint32_t chain[16];
    assert(depth < 16);
    add_directions(&l, &eye, chain, 0);
    for (int i = 0; i < 2 && !view->full; i++) {
        vector border;
        init(&border);
        set_point(&l, &border, i ? view->left : view->right);
        add_direction(&l, &eye, &border);
        clear(&border);
    }
    add_axes(&l, &eye);
    sort_directions(&l);
    for (uint32_t i = 0; i < space->wall_count; i++)
        l.out.on_wall |= touches(&l, &eye, &l.walls[2 * i], &l.walls[2 * i + 1]);
    for (size_t i = 0; i < l.dark_count; i++)
        l.out.on_wall |= touches(&l, &eye, &l.dark[2 * i], &l.dark[2 * i + 1]);
    look(&l, view, &eye);
    release(&l);
    clear(&eye);
    return l.out;
}

void oracle_mirrored_free(oracle_mirrored *o) {
    free(o->closed);
    free(o->open);
    free(o->direct_closed);
    free(o->direct_open);
    free(o->areas);
}

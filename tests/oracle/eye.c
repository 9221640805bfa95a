// The directions that matter are those from the eye to corners of cells (wall and portal ends are
// on cells' borders, and are taken as well) and to the views' borders, each with its opposite. What
// is seen changes at these only: so one ray between two neighbouring ones will do for open sight,
// and for closed sight, where what is seen from between is touched by a border, the directions
// themselves.
//
// The eye stands in its cell and in those that portals at the eye join with it. What it sees from
// any of them counts. It sees those of them that the view leads into: a direction that matters does
// not cross a side of the cell that the eye is on, from within.
//
// Open sight: the eye may be on walls or in corners. So it is moved into each of its cells by next
// to nothing, much less than anything that matters is apart: beside either of the two borders that
// the cell has at the eye, so that a ray can pass the eye on either side. What is seen from one of
// the two counts.
//
// Closed sight: of a ray that goes from cell to cell through portals that it meets, ends included,
// and of portals along it, crosses all to the same side.
#include "oracle/eye.h"

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

/// A direction and what is seen that way.
typedef struct ray {
    vector to;
    bool *cells;
} ray;

struct oracle_eye {
    const sl_space *space;
    int exponent;  ///< coordinates are integers times 2 ^ exponent
    bool *sources; ///< by cell: whether the eye stands in it
    vector eye;
    vector *corners; ///< as space.vertices
    struct oracle_ends {
        vector a, b;
    } * walls, *directed;    ///< a left, b right
    ray *touching, *between; ///< round the eye; between[i] comes after touching[i]
    size_t ray_count;
};

/// Binary places below the coordinates' last, and how they are used: the eye is moved along its
/// cell's border by about 2^-147 of the last place at most, and inwards by 2^-130 of that. With
/// coordinates of 53 bits, a ray between two others keeps 2^-53 of a last place from what they
/// pass.
enum { PLACES = 400, ALONG = 130, DOWN = 330 };

static void init(vector *v) {
    mpz_inits(v->x, v->y, NULL);
}

static void clear(vector *v) {
    mpz_clears(v->x, v->y, NULL);
}

static void set_integer(mpz_t out, double value, int exponent) {
    const dyadic d = dyadic_of(value);
    mpz_set_d(out, (double)d.odd); // not by a long, which has 32 bits on some machines
    if (d.odd) mpz_mul_2exp(out, out, (mp_bitcnt_t)(d.exponent - exponent));
}

static void init_point(vector *out, sl_point p, int exponent) {
    init(out);
    set_integer(out->x, p.x, exponent);
    set_integer(out->y, p.y, exponent);
}

static void subtract(vector *out, const vector *a, const vector *b) {
    mpz_sub(out->x, a->x, b->x);
    mpz_sub(out->y, a->y, b->y);
}

/// The direction from a to b, neither of them moved: without the places that only moving needs.
static void direction(vector *out, const vector *a, const vector *b) {
    subtract(out, b, a);
    mpz_tdiv_q_2exp(out->x, out->x, PLACES);
    mpz_tdiv_q_2exp(out->y, out->y, PLACES);
}

/// out = u x v
static void cross(mpz_t out, const vector *u, const vector *v) {
    mpz_mul(out, u->x, v->y);
    mpz_submul(out, u->y, v->x);
}

static int turn(const vector *u, const vector *v) {
    mpz_t product;
    mpz_init(product);
    cross(product, u, v);
    const int sign = mpz_sgn(product);
    mpz_clear(product);
    return sign;
}

static int forward(const vector *u, const vector *v) {
    mpz_t product;
    mpz_init(product);
    mpz_mul(product, u->x, v->x);
    mpz_addmul(product, u->y, v->y);
    const int sign = mpz_sgn(product);
    mpz_clear(product);
    return sign;
}

// --- directions

/// 0 for directions from +x up to, but without, -x; 1 for the others.
static int half_of(const vector *v) {
    const int y = mpz_sgn(v->y);
    return y < 0 || (y == 0 && mpz_sgn(v->x) < 0);
}

static int by_direction(const void *left, const void *right) {
    const ray *a = left, *b = right;
    const int halves = half_of(&a->to) - half_of(&b->to);
    return halves ? halves : -turn(&a->to, &b->to);
}

static void add_direction(oracle_eye *o, const vector *point) {
    for (int opposite = 0; opposite < 2; opposite++) {
        vector *to = &o->touching[o->ray_count].to;
        init(to);
        direction(to, &o->eye, point);
        if (opposite) {
            mpz_neg(to->x, to->x);
            mpz_neg(to->y, to->y);
        }
        if (mpz_sgn(to->x) || mpz_sgn(to->y))
            o->ray_count++;
        else
            clear(to);
    }
}

/// Sorts the directions, each once, and puts one between every two neighbours.
static void settle_directions(oracle_eye *o) {
    qsort(o->touching, o->ray_count, sizeof *o->touching, by_direction);
    size_t kept = 0;
    for (size_t i = 0; i < o->ray_count; i++) {
        if (kept && by_direction(&o->touching[kept - 1], &o->touching[i]) == 0)
            clear(&o->touching[i].to);
        else
            o->touching[kept++] = o->touching[i];
    }
    o->ray_count = kept;
    o->between = must(calloc(kept, sizeof *o->between));
    for (size_t i = 0; i < kept; i++) {
        const vector *a = &o->touching[i].to, *b = &o->touching[(i + 1) % kept].to;
        vector *to = &o->between[i].to;
        init(to);
        // Opposite ones are both there, so that neighbours are less than 180 degrees apart, but for
        // a single pair of opposites: then straight away from both.
        if (turn(a, b) > 0) {
            mpz_add(to->x, a->x, b->x);
            mpz_add(to->y, a->y, b->y);
        } else {
            mpz_neg(to->x, a->y);
            mpz_set(to->y, a->x);
        }
    }
}

// --- closed sight: along a ray

typedef struct walk {
    const oracle_eye *o;
    const vector *to;
    bool *seen; ///< [3 * cell + side], of portals along the ray: none, crossed to the left, right
    bool *cells;
} walk;

/// Whether the ray meets a directed portal as it leaves a cell; the side to which it crosses one
/// along it.
static bool meets(const oracle_eye *o, const vector *to, const struct oracle_ends *directed,
                  int *side) {
    vector left, right, portal;
    init(&left);
    init(&right);
    init(&portal);
    direction(&left, &o->eye, &directed->a);
    direction(&right, &o->eye, &directed->b);
    subtract(&portal, &left, &right);
    bool met = turn(to, &left) >= 0 && turn(to, &right) <= 0;
    *side = 0;
    if (met && turn(to, &portal) == 0) {
        *side = forward(to, &portal) > 0 ? 2 : 1;
        met = forward(to, &left) >= 0 || forward(to, &right) >= 0;
    } else if (met) {
        met = turn(&right, &portal) >= 0;
    }
    clear(&left);
    clear(&right);
    clear(&portal);
    return met;
}

/// Whether a direction enters a cell that the eye stands in, or runs along its border.
static bool leads_into(const oracle_eye *o, uint32_t number, const vector *to) {
    const sl_cell *cell = &o->space->cells[number];
    const vector *corners = o->corners + cell->first_vertex;
    vector side, eye;
    bool into = true;
    init(&side);
    init(&eye);
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        direction(&side, &corners[i], &corners[(i + 1) % cell->vertex_count]);
        direction(&eye, &corners[i], &o->eye);
        into = into && (turn(&side, &eye) != 0 || turn(&side, to) >= 0);
    }
    clear(&side);
    clear(&eye);
    return into;
}

static void go_on(walk *w, uint32_t cell, int side) {
    const sl_space *space = w->o->space;
    if (w->seen[3 * cell + (uint32_t)side]) return;
    w->seen[3 * cell + (uint32_t)side] = true;
    w->cells[cell] = !w->o->sources[cell] || leads_into(w->o, cell, w->to);
    const sl_cell *c = &space->cells[cell];
    for (uint32_t i = c->first_directed; i < c->first_directed + c->directed_count; i++) {
        int crossed;
        if (!meets(w->o, w->to, &w->o->directed[i], &crossed)) continue;
        if (side && crossed && side != crossed) continue;
        go_on(w, space->directed[i].cell, side ? side : crossed);
    }
}

static void walk_along(const oracle_eye *o, ray *r) {
    r->cells = must(calloc(o->space->cell_count, sizeof *r->cells));
    walk w = {o, &r->to, must(calloc(3 * (size_t)o->space->cell_count, sizeof(bool))), r->cells};
    for (uint32_t c = 0; c < o->space->cell_count; c++)
        if (o->sources[c]) go_on(&w, c, 0);
    free(w.seen);
}

// --- open sight: to the first wall

/// A place on a ray: num / den, den > 0.
typedef struct place {
    mpz_t num, den;
} place;

static int compare(const place *a, const place *b) {
    mpz_t left, right;
    mpz_inits(left, right, NULL);
    mpz_mul(left, a->num, b->den);
    mpz_mul(right, b->num, a->den);
    const int order = mpz_cmp(left, right);
    mpz_clears(left, right, NULL);
    return order;
}

static void keep(place *out, const place *p) {
    mpz_set(out->num, p->num);
    mpz_set(out->den, p->den);
}

/// Where the line from `from` on meets the line through a and b. `into` is 1 where it comes to its
/// left there, 0 where it is parallel: then `num` is positive where it runs at its left.
static void meet(place *out, int *into, const vector *from, const vector *to, const vector *a,
                 const vector *b) {
    vector line, reach;
    init(&line);
    init(&reach);
    direction(&line, a, b);
    subtract(&reach, a, from);
    cross(out->num, &reach, &line);
    cross(out->den, to, &line);
    *into = -mpz_sgn(out->den);
    if (mpz_sgn(out->den) < 0) {
        mpz_neg(out->num, out->num);
        mpz_neg(out->den, out->den);
    }
    clear(&line);
    clear(&reach);
}

/// Where the ray meets the first wall; false where it meets none.
static bool first_wall(const oracle_eye *o, const vector *from, const vector *to, place *first) {
    vector a, b;
    place hit;
    bool any = false;
    init(&a);
    init(&b);
    mpz_inits(hit.num, hit.den, NULL);
    for (uint32_t i = 0; i < o->space->wall_count; i++) {
        int into;
        subtract(&a, &o->walls[i].a, from);
        subtract(&b, &o->walls[i].b, from);
        const int sides = turn(to, &a) * turn(to, &b);
        assert(turn(to, &a) && turn(to, &b)); // no ray is so directed
        if (sides > 0) continue;
        meet(&hit, &into, from, to, &o->walls[i].a, &o->walls[i].b);
        if (mpz_sgn(hit.num) < 0 || (any && compare(&hit, first) >= 0)) continue;
        keep(first, &hit);
        any = true;
    }
    mpz_clears(hit.num, hit.den, NULL);
    clear(&a);
    clear(&b);
    return any;
}

/// Whether the ray runs through the inside of a cell before `end` (NULL: at all).
static bool enters(const oracle_eye *o, const vector *from, const vector *to, const place *end,
                   uint32_t number) {
    const sl_cell *cell = &o->space->cells[number];
    const vector *corners = o->corners + cell->first_vertex;
    place low, high, hit;
    bool has_high = end != NULL, beside = true;
    mpz_inits(low.num, low.den, high.num, high.den, hit.num, hit.den, NULL);
    mpz_set_ui(low.den, 1);
    if (end) keep(&high, end);
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        int into;
        meet(&hit, &into, from, to, &corners[i], &corners[(i + 1) % cell->vertex_count]);
        if (into == 0) beside = beside && mpz_sgn(hit.num) > 0;
        if (into > 0 && compare(&hit, &low) > 0) keep(&low, &hit);
        if (into < 0 && (!has_high || compare(&hit, &high) < 0)) {
            keep(&high, &hit);
            has_high = true;
        }
    }
    const bool inside = beside && compare(&low, &high) < 0;
    mpz_clears(low.num, low.den, high.num, high.den, hit.num, hit.den, NULL);
    return inside;
}

/// A cell with flat corners has several edges in one line.
enum { WAYS_MOST = 64 };

/// Where to move the eye along its cell's border: towards the ends of the edges that it is on;
/// where it is on none, anywhere. Returns how many ways, which are initialised.
static size_t find_ways(const oracle_eye *o, uint32_t source, vector ways[WAYS_MOST]) {
    const sl_cell *cell = &o->space->cells[source];
    const vector *corners = o->corners + cell->first_vertex;
    size_t count = 0;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const vector *ends[2] = {&corners[i], &corners[(i + 1) % cell->vertex_count]};
        vector edge, to;
        init(&edge);
        init(&to);
        subtract(&edge, ends[1], ends[0]);
        subtract(&to, &o->eye, ends[0]);
        const bool on_edge = turn(&edge, &to) == 0;
        for (int k = 0; on_edge && k < 2; k++) {
            subtract(&to, ends[k], &o->eye);
            if (!mpz_sgn(to.x) && !mpz_sgn(to.y)) continue;
            assert(count < WAYS_MOST);
            init(&ways[count]);
            subtract(&ways[count++], ends[k], &o->eye);
        }
        clear(&edge);
        clear(&to);
    }
    if (count) return count;
    init(&ways[0]);
    subtract(&ways[0], &corners[0], &o->eye);
    return 1;
}

/// The eye, moved into a cell of its own: along its border and, by far less, to its middle.
static void move_eye(const oracle_eye *o, uint32_t source, const vector *way, vector *moved) {
    const sl_cell *cell = &o->space->cells[source];
    const vector *corners = o->corners + cell->first_vertex;
    vector by;
    init(&by);
    mpz_mul_2exp(by.x, way->x, ALONG);
    mpz_mul_2exp(by.y, way->y, ALONG);
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        mpz_add(by.x, by.x, corners[i].x);
        mpz_add(by.y, by.y, corners[i].y);
    }
    mpz_submul_ui(by.x, o->eye.x, cell->vertex_count);
    mpz_submul_ui(by.y, o->eye.y, cell->vertex_count);
    mpz_tdiv_q_2exp(by.x, by.x, DOWN);
    mpz_tdiv_q_2exp(by.y, by.y, DOWN);
    mpz_add(moved->x, o->eye.x, by.x);
    mpz_add(moved->y, o->eye.y, by.y);
    clear(&by);
}

static void look_between(const oracle_eye *o, const vector *from, ray *r) {
    place end;
    mpz_inits(end.num, end.den, NULL);
    const bool stops = first_wall(o, from, &r->to, &end);
    for (uint32_t c = 0; c < o->space->cell_count; c++)
        if (!r->cells[c] && enters(o, from, &r->to, stops ? &end : NULL, c)) r->cells[c] = true;
    mpz_clears(end.num, end.den, NULL);
}

static void look_from_within(oracle_eye *o, uint32_t source) {
    vector ways[WAYS_MOST], from;
    const size_t way_count = find_ways(o, source, ways);
    init(&from);
    for (size_t k = 0; k < way_count; k++) {
        move_eye(o, source, &ways[k], &from);
        for (size_t i = 0; i < o->ray_count; i++) look_between(o, &from, &o->between[i]);
        clear(&ways[k]);
    }
    clear(&from);
}

static void look_all_round(oracle_eye *o) {
    for (size_t i = 0; i < o->ray_count; i++) {
        walk_along(o, &o->touching[i]);
        o->between[i].cells = must(calloc(o->space->cell_count, sizeof(bool)));
    }
    for (uint32_t c = 0; c < o->space->cell_count; c++)
        if (o->sources[c]) look_from_within(o, c);
}

// --- the eye's cells

static bool touches_eye(const oracle_eye *o, const struct oracle_ends *directed) {
    vector a, b;
    init(&a);
    init(&b);
    subtract(&a, &directed->a, &o->eye);
    subtract(&b, &directed->b, &o->eye);
    const bool touches = turn(&a, &b) == 0 && forward(&a, &b) <= 0;
    clear(&a);
    clear(&b);
    return touches;
}

static void stand_in(oracle_eye *o, uint32_t cell) {
    const sl_cell *c = &o->space->cells[cell];
    o->sources[cell] = true;
    for (uint32_t i = c->first_directed; i < c->first_directed + c->directed_count; i++)
        if (!o->sources[o->space->directed[i].cell] && touches_eye(o, &o->directed[i]))
            stand_in(o, o->space->directed[i].cell);
}

// --- all together

static int lowest_exponent(const sl_space *space, sl_point eye, const sl_point *borders,
                           size_t border_count) {
    int lowest = INT_MAX;
    for (size_t i = 0; i < space->vertex_count + 2 * (size_t)space->directed_count +
                               2 * (size_t)space->wall_count + border_count + 1;
         i++) {
        size_t k = i;
        sl_point p = eye;
        if (k < space->vertex_count)
            p = space->vertices[k];
        else if ((k -= space->vertex_count) < 2 * (size_t)space->directed_count)
            p = k % 2 ? space->directed[k / 2].left : space->directed[k / 2].right;
        else if ((k -= 2 * (size_t)space->directed_count) < 2 * (size_t)space->wall_count)
            p = k % 2 ? space->walls[k / 2].a : space->walls[k / 2].b;
        else if ((k -= 2 * (size_t)space->wall_count) < border_count)
            p = borders[k];
        const dyadic x = dyadic_of(p.x), y = dyadic_of(p.y);
        if (x.odd && x.exponent < lowest) lowest = x.exponent;
        if (y.odd && y.exponent < lowest) lowest = y.exponent;
    }
    return lowest == INT_MAX ? 0 : lowest;
}

static void take_points(oracle_eye *o) {
    const sl_space *space = o->space;
    o->corners = must(calloc(space->vertex_count, sizeof *o->corners));
    o->walls = must(calloc((size_t)space->wall_count + 1, sizeof *o->walls));
    o->directed = must(calloc((size_t)space->directed_count + 1, sizeof *o->directed));
    for (uint32_t i = 0; i < space->vertex_count; i++)
        init_point(&o->corners[i], space->vertices[i], o->exponent);
    for (uint32_t i = 0; i < space->wall_count; i++) {
        init_point(&o->walls[i].a, space->walls[i].a, o->exponent);
        init_point(&o->walls[i].b, space->walls[i].b, o->exponent);
    }
    for (uint32_t i = 0; i < space->directed_count; i++) {
        init_point(&o->directed[i].a, space->directed[i].left, o->exponent);
        init_point(&o->directed[i].b, space->directed[i].right, o->exponent);
    }
}

oracle_eye *oracle_eye_create(const sl_space *space, sl_point eye, const sl_point *borders,
                              size_t border_count) {
    oracle_eye *o = must(calloc(1, sizeof *o));
    o->space = space;
    const uint32_t cell = sl_space_locate(space, eye);
    assert(cell != SL_NO_CELL);
    o->sources = must(calloc(space->cell_count, sizeof *o->sources));
    o->exponent = lowest_exponent(space, eye, borders, border_count) - PLACES;
    init_point(&o->eye, eye, o->exponent);
    take_points(o);
    stand_in(o, cell);
    const size_t most = space->vertex_count + 2 * (size_t)space->directed_count +
                        2 * (size_t)space->wall_count + border_count;
    o->touching = must(calloc(2 * most + 2, sizeof *o->touching));
    for (uint32_t i = 0; i < space->vertex_count; i++) add_direction(o, &o->corners[i]);
    for (uint32_t i = 0; i < space->directed_count; i++) {
        add_direction(o, &o->directed[i].a);
        add_direction(o, &o->directed[i].b);
    }
    for (uint32_t i = 0; i < space->wall_count; i++) {
        add_direction(o, &o->walls[i].a);
        add_direction(o, &o->walls[i].b);
    }
    for (size_t i = 0; i < border_count; i++) {
        vector border;
        init_point(&border, borders[i], o->exponent);
        add_direction(o, &border);
        clear(&border);
    }
    settle_directions(o);
    look_all_round(o);
    return o;
}

void oracle_eye_destroy(oracle_eye *o) {
    for (uint32_t i = 0; i < o->space->vertex_count; i++) clear(&o->corners[i]);
    for (uint32_t i = 0; i < o->space->wall_count; i++) {
        clear(&o->walls[i].a);
        clear(&o->walls[i].b);
    }
    for (uint32_t i = 0; i < o->space->directed_count; i++) {
        clear(&o->directed[i].a);
        clear(&o->directed[i].b);
    }
    for (size_t i = 0; i < o->ray_count; i++) {
        clear(&o->touching[i].to);
        clear(&o->between[i].to);
        free(o->touching[i].cells);
        free(o->between[i].cells);
    }
    clear(&o->eye);
    free(o->sources);
    free(o->corners);
    free(o->walls);
    free(o->directed);
    free(o->touching);
    free(o->between);
    free(o);
}

/// Whether a direction is within the cone from `right` counter-clockwise to `left`.
static bool within(const vector *right, const vector *left, const vector *to) {
    const int width = turn(right, left);
    const bool after_right =
        turn(right, to) > 0 || (turn(right, to) == 0 && forward(right, to) > 0);
    const bool before_left = turn(to, left) > 0 || (turn(to, left) == 0 && forward(to, left) > 0);
    if (width > 0) return after_right && before_left;
    if (width < 0) return after_right || before_left;
    if (forward(right, left) > 0) return turn(right, to) == 0 && forward(right, to) > 0;
    return turn(right, to) >= 0;
}

void oracle_eye_sees(const oracle_eye *o, const sl_view *view, bool *closed, bool *open) {
    const uint32_t count = o->space->cell_count;
    vector right, left;
    init_point(&right, view->full ? view->eye : view->right, o->exponent);
    init_point(&left, view->full ? view->eye : view->left, o->exponent);
    subtract(&right, &right, &o->eye);
    subtract(&left, &left, &o->eye);
    memset(closed, 0, count * sizeof *closed);
    memset(open, 0, count * sizeof *open);
    for (size_t i = 0; i < o->ray_count; i++)
        for (uint32_t c = 0; c < count; c++) {
            if (o->touching[i].cells[c] && !closed[c])
                closed[c] = view->full || within(&right, &left, &o->touching[i].to);
            if (o->between[i].cells[c] && !open[c])
                open[c] = view->full || within(&right, &left, &o->between[i].to);
        }
    for (uint32_t c = 0; c < count; c++)
        if (o->sources[c]) open[c] = closed[c];
    clear(&right);
    clear(&left);
}

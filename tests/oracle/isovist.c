/// Vectors from the eye to walls, sorted by rationals.
#include "isovist.h"

#include <gmp.h>
#include <math.h>
#include <stdlib.h>

/// A vector from the eye.
typedef struct vector {
    mpq_t x, y;
} vector;

/// A wall or a piece of border, its ends as seen from the eye.
typedef struct blocker {
    vector a, b;
    bool border;
} blocker;

typedef struct sweeper {
    const sl_view *view;
    vector right, left; ///< of the cone
    int side[2];        ///< the quadrant that an eye on walls looks from
    blocker *blockers;
    vector *directions;
    size_t blocker_count, direction_count;
    mpq_t scratch[4];
} sweeper;

static void start_vector(vector *v) {
    mpq_inits(v->x, v->y, NULL);
}

static void clear_vector(vector *v) {
    mpq_clears(v->x, v->y, NULL);
}

static void set_from(sl_point eye, sl_point to, vector *v) {
    mpq_t base;
    mpq_init(base);
    mpq_set_d(v->x, to.x);
    mpq_set_d(base, eye.x);
    mpq_sub(v->x, v->x, base);
    mpq_set_d(v->y, to.y);
    mpq_set_d(base, eye.y);
    mpq_sub(v->y, v->y, base);
    mpq_clear(base);
}

static void cross(const vector *a, const vector *b, mpq_t out) {
    mpq_t other;
    mpq_init(other);
    mpq_mul(out, a->x, b->y);
    mpq_mul(other, a->y, b->x);
    mpq_sub(out, out, other);
    mpq_clear(other);
}

static int turn(const vector *a, const vector *b) {
    mpq_t value;
    mpq_init(value);
    cross(a, b, value);
    const int sign = mpq_sgn(value);
    mpq_clear(value);
    return sign;
}

static bool is_zero(const vector *v) {
    return mpq_sgn(v->x) == 0 && mpq_sgn(v->y) == 0;
}

static int half_of(const vector *v) {
    return mpq_sgn(v->y) < 0 || (mpq_sgn(v->y) == 0 && mpq_sgn(v->x) < 0);
}

static int compare_directions(const void *left, const void *right) {
    const vector *a = left, *b = right;
    const int halves = half_of(a) - half_of(b);
    return halves ? halves : -turn(a, b);
}

static void add_direction(sweeper *s, const vector *v) {
    if (is_zero(v)) return;
    vector *d = &s->directions[s->direction_count++];
    start_vector(d);
    mpq_set(d->x, v->x);
    mpq_set(d->y, v->y);
}

static void add_axes(sweeper *s) {
    for (int i = 0; i < 4; i++) {
        vector v;
        start_vector(&v);
        mpq_set_si(v.x, i == 0 ? 1 : i == 2 ? -1 : 0, 1);
        mpq_set_si(v.y, i == 1 ? 1 : i == 3 ? -1 : 0, 1);
        add_direction(s, &v);
        clear_vector(&v);
    }
}

static void sort_directions(sweeper *s) {
    qsort(s->directions, s->direction_count, sizeof *s->directions, compare_directions);
    size_t kept = 0;
    for (size_t i = 0; i < s->direction_count; i++) {
        if (kept && compare_directions(&s->directions[kept - 1], &s->directions[i]) == 0)
            clear_vector(&s->directions[i]);
        else
            s->directions[kept++] = s->directions[i];
    }
    s->direction_count = kept;
}

/// Whether a number is in a cell's reach, or on the border that the eye looks in from.
static bool is_beside(double low, double at, double high, int side) {
    return side > 0 ? low <= at && at < high : low < at && at <= high;
}

/// The first quadrant at the eye whose cell is inside, else the first not in solid ground.
static void find_side(sweeper *s, const sl_space *space, sl_point eye) {
    int best = -1;
    for (int q = 0; q < 4; q++) {
        const int right = q & 1 ? -1 : 1, up = q & 2 ? -1 : 1;
        for (uint32_t i = 0; i < space->cell_count; i++) {
            const sl_cell *cell = &space->cells[i];
            const sl_point *v = space->vertices + cell->first_vertex;
            sl_box box = {v[0], v[0]};
            for (uint32_t k = 1; k < cell->vertex_count; k++) {
                box.min = (sl_point){fmin(box.min.x, v[k].x), fmin(box.min.y, v[k].y)};
                box.max = (sl_point){fmax(box.max.x, v[k].x), fmax(box.max.y, v[k].y)};
            }
            const int worth = cell->inside ? 2 : !cell->solid;
            if (worth <= best || !is_beside(box.min.x, eye.x, box.max.x, right) ||
                !is_beside(box.min.y, eye.y, box.max.y, up))
                continue;
            best = worth;
            s->side[0] = right;
            s->side[1] = up;
        }
    }
}

static void start(sweeper *s, const sl_space *space) {
    const sl_box *b = &space->bounds;
    const sl_point eye = s->view->eye;
    const sl_point corners[4] = {b->min, {b->max.x, b->min.y}, b->max, {b->min.x, b->max.y}};
    s->blockers = calloc(space->wall_count + 4, sizeof *s->blockers);
    s->directions = calloc(2 * (size_t)space->wall_count + 16, sizeof *s->directions);
    if (!s->blockers || !s->directions) abort();
    for (size_t i = 0; i < space->wall_count + 4u; i++) {
        blocker *o = &s->blockers[s->blocker_count++];
        start_vector(&o->a);
        start_vector(&o->b);
        o->border = i >= space->wall_count;
        const size_t k = o->border ? i - space->wall_count : 0;
        set_from(eye, o->border ? corners[k] : space->walls[i].a, &o->a);
        set_from(eye, o->border ? corners[(k + 1) % 4] : space->walls[i].b, &o->b);
        add_direction(s, &o->a);
        add_direction(s, &o->b);
    }
    start_vector(&s->right);
    start_vector(&s->left);
    if (!s->view->full) {
        set_from(eye, s->view->right, &s->right);
        set_from(eye, s->view->left, &s->left);
        add_direction(s, &s->right);
        add_direction(s, &s->left);
    }
    add_axes(s);
    sort_directions(s);
    find_side(s, space, eye);
}

static void end(sweeper *s) {
    for (size_t i = 0; i < s->blocker_count; i++) {
        clear_vector(&s->blockers[i].a);
        clear_vector(&s->blockers[i].b);
    }
    for (size_t i = 0; i < s->direction_count; i++) clear_vector(&s->directions[i]);
    clear_vector(&s->right);
    clear_vector(&s->left);
    free(s->blockers);
    free(s->directions);
}

static bool in_cone(const sweeper *s, const vector *d) {
    if (s->view->full) return true;
    const int width = turn(&s->right, &s->left);
    const bool from_right = turn(&s->right, d) > 0, from_left = turn(d, &s->left) > 0;
    if (width > 0) return from_right && from_left;
    if (width < 0) return from_right || from_left;
    const bool one =
        mpq_sgn(s->right.x) == mpq_sgn(s->left.x) && mpq_sgn(s->right.y) == mpq_sgn(s->left.y);
    return !one && from_right;
}

/// Whether the eye is on a blocker, and how far that reaches along a ray: 0 for not at all.
static double reach_along(const blocker *o, const vector *ray) {
    if (turn(&o->a, &o->b) != 0) return 0;
    double reach = 0;
    const vector *ends[2] = {&o->a, &o->b};
    const int ax = mpq_sgn(o->a.x) * mpq_sgn(o->b.x), ay = mpq_sgn(o->a.y) * mpq_sgn(o->b.y);
    if (ax > 0 || ay > 0) return 0;
    for (int i = 0; i < 2; i++)
        if (!is_zero(ends[i]) && turn(ends[i], ray) == 0 &&
            mpq_sgn(ends[i]->x) == mpq_sgn(ray->x) && mpq_sgn(ends[i]->y) == mpq_sgn(ray->y))
            reach = fabs(mpq_get_d(ends[i]->x)) + fabs(mpq_get_d(ends[i]->y));
    return reach;
}

/// Whether no wall at the eye stands between a direction and the quadrant that the eye looks from:
/// one of the two ways round is free. Walls at the eye run along the axes, so that quadrants are
/// what they part.
static bool on_our_side(const sweeper *s, const vector *d) {
    static const int turns[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    bool blocked[4] = {false};
    for (int i = 0; i < 4; i++) {
        vector axis;
        start_vector(&axis);
        mpq_set_si(axis.x, turns[i][0], 1);
        mpq_set_si(axis.y, turns[i][1], 1);
        for (size_t k = 0; k < s->blocker_count; k++)
            if (reach_along(&s->blockers[k], &axis) > 0) blocked[i] = true;
        clear_vector(&axis);
    }
    // Quadrant q lies between axis q and axis q + 1.
    const int home = s->side[1] > 0 ? (s->side[0] > 0 ? 0 : 1) : (s->side[0] > 0 ? 3 : 2);
    const int there = mpq_sgn(d->y) > 0 ? (mpq_sgn(d->x) > 0 ? 0 : 1) : (mpq_sgn(d->x) > 0 ? 3 : 2);
    bool left = true, right = true;
    for (int q = home; q != there; q = (q + 1) % 4) left = left && !blocked[(q + 1) % 4];
    for (int q = home; q != there; q = (q + 3) % 4) right = right && !blocked[q];
    return left || right;
}

/// The share of a direction at which it meets the line of a blocker.
static void share_of(const blocker *o, const vector *d, mpq_t out) {
    vector along;
    mpq_t below;
    start_vector(&along);
    mpq_init(below);
    mpq_sub(along.x, o->b.x, o->a.x);
    mpq_sub(along.y, o->b.y, o->a.y);
    cross(&o->a, &along, out);
    cross(d, &along, below);
    mpq_div(out, out, below);
    clear_vector(&along);
    mpq_clear(below);
}

/// The nearest blocker that a direction crosses, which passes through no end.
static const blocker *nearest(const sweeper *s, const vector *d) {
    const blocker *best = NULL;
    mpq_t least, share;
    mpq_inits(least, share, NULL);
    for (size_t i = 0; i < s->blocker_count; i++) {
        const blocker *o = &s->blockers[i];
        if (turn(d, &o->a) * turn(d, &o->b) >= 0) continue;
        share_of(o, d, share);
        if (mpq_sgn(share) <= 0 || (best && mpq_cmp(share, least) >= 0)) continue;
        mpq_set(least, share);
        best = o;
    }
    mpq_clears(least, share, NULL);
    return best;
}

static void meet(const blocker *o, const vector *d, vector *out) {
    mpq_t share;
    mpq_init(share);
    share_of(o, d, share);
    mpq_mul(out->x, d->x, share);
    mpq_mul(out->y, d->y, share);
    mpq_clear(share);
}

static double length(const vector *from, const vector *to) {
    mpq_t x, y;
    mpq_inits(x, y, NULL);
    mpq_sub(x, to->x, from->x);
    mpq_sub(y, to->y, from->y);
    const double result = hypot(mpq_get_d(x), mpq_get_d(y));
    mpq_clears(x, y, NULL);
    return result;
}

/// From where a stretch of seen directions borders on one that is not, or on another one.
typedef struct stretch {
    bool seen;
    const blocker *on;
    vector from, to;
} stretch;

static void see(const sweeper *s, size_t i, stretch *out, mpq_t area) {
    const vector *u = &s->directions[i], *v = &s->directions[(i + 1) % s->direction_count];
    vector middle;
    start_vector(&middle);
    mpq_add(middle.x, u->x, v->x);
    mpq_add(middle.y, u->y, v->y);
    out->seen = in_cone(s, &middle) && on_our_side(s, &middle);
    if (out->seen) {
        out->on = nearest(s, &middle);
        if (!out->on) abort();
        meet(out->on, u, &out->from);
        meet(out->on, v, &out->to);
        mpq_t part;
        mpq_init(part);
        cross(&out->from, &out->to, part);
        mpq_add(area, area, part);
        mpq_clear(part);
    }
    clear_vector(&middle);
}

static bool same_ray(const vector *a, const vector *b) {
    return turn(a, b) == 0 && mpq_sgn(a->x) == mpq_sgn(b->x) && mpq_sgn(a->y) == mpq_sgn(b->y);
}

/// The edge between the eye and the end of what is seen: on the border of the cone, or else on a
/// wall at the eye as far as that goes, and occluding from there on; or on the map's border.
static void add_side(const sweeper *s, const vector *to, oracle_isovist *out) {
    vector eye;
    start_vector(&eye);
    const double whole = length(&eye, to);
    clear_vector(&eye);
    out->perimeter += whole;
    if (!s->view->full && (same_ray(to, &s->right) || same_ray(to, &s->left))) return;
    double wall = 0;
    for (size_t i = 0; i < s->blocker_count; i++)
        if (!s->blockers[i].border) wall = fmax(wall, reach_along(&s->blockers[i], to));
    if (wall > 0 && wall < whole) out->occlusivity += whole - wall;
}

oracle_isovist oracle_isovist_of(const sl_space *space, const sl_view *view) {
    sweeper s = {.view = view};
    oracle_isovist out = {0};
    mpq_t area;
    mpq_init(area);
    start(&s, space);
    stretch *all = calloc(s.direction_count, sizeof *all);
    if (!all) abort();
    for (size_t i = 0; i < s.direction_count; i++) {
        start_vector(&all[i].from);
        start_vector(&all[i].to);
        see(&s, i, &all[i], area);
        if (all[i].seen) out.perimeter += length(&all[i].from, &all[i].to);
    }
    for (size_t i = 0; i < s.direction_count; i++) {
        const stretch *before = &all[i], *after = &all[(i + 1) % s.direction_count];
        if (before->seen && after->seen) {
            const double step = length(&before->to, &after->from);
            out.perimeter += step;
            out.occlusivity += step;
        } else if (before->seen)
            add_side(&s, &before->to, &out);
        else if (after->seen)
            add_side(&s, &after->from, &out);
    }
    for (size_t i = 0; i < s.direction_count; i++) {
        clear_vector(&all[i].from);
        clear_vector(&all[i].to);
    }
    free(all);
    out.area = mpq_get_d(area) / 2;
    mpq_clear(area);
    end(&s);
    return out;
}

/// Stabbing as a linear program (Teller & Séquin 1991, Finding Sightlines), solved by GLPK's
/// simplex.
///
/// The line is S(P) = ux Py - uy Px + c, positive to its left; the columns are ux, uy, c and the
/// margin d that is maximised. Each portal gives two rows, S(L) - d >= 0 and S(R) + d <= 0. Row 1
/// makes the trivial line impossible: w·u = 1, where w is the sum of the crossing directions of the
/// two portals that differ most in direction. Every u but 0 that crosses all portals forwards has
/// w·u > 0 (unless all lie on one line), so the row takes no line away; it only fixes the length of
/// u.
#include "stab/glpk_shared.h"

#include "sightline/support.h"

#include <math.h>

/// Margins this near to zero, as a share of the bounds' size, are not trusted: simplex stops when
/// rows hold to about its tolerance.
#define TOLERANCE         1e-9
#define SIMPLEX_TOLERANCE 1e-10

/// A warm start takes a few; where rounding makes the simplex go in circles it would never end.
#define MOST_ITERATIONS 1000

enum { UX = 1, UY, C, D, COLUMNS = D };

typedef struct vector {
    double x, y;
} vector;

/// A pushed portal, and what its push left behind.
typedef struct level {
    vector rightmost, leftmost; ///< extremes of the crossing directions so far
    uint32_t rightmost_portal, leftmost_portal;
    double ux, uy, c; ///< the line found, and its margin as GLPK has it
    double margin;
    size_t statuses; ///< where this level's basis starts in the stack of statuses
} level;

typedef struct simplex {
    glp_prob *problem;
    glp_smcp settings;
    sl_point origin; ///< the bounds' middle
    double scale;    ///< a power of two that brings the bounds to unit size
    SL_ARRAY(level) levels;
    SL_ARRAY(uint8_t) statuses;
    SL_ARRAY(vector) ends; ///< of the rows from row 2 on, scaled: left and right in turn
    sli_glpk_guard guard;
} simplex;

static void make_problem(simplex *s) {
    s->problem = glp_create_prob();
    glp_set_obj_dir(s->problem, GLP_MAX);
    glp_add_cols(s->problem, COLUMNS);
    for (int column = 1; column <= COLUMNS; column++)
        glp_set_col_bnds(s->problem, column, GLP_FR, 0, 0);
    glp_set_obj_coef(s->problem, D, 1);
    glp_add_rows(s->problem, 1);
    glp_set_row_bnds(s->problem, 1, GLP_FX, 1, 1);
    glp_init_smcp(&s->settings);
    s->settings.msg_lev = GLP_MSG_OFF;
    s->settings.meth = GLP_DUALP;
    s->settings.tol_bnd = s->settings.tol_dj = SIMPLEX_TOLERANCE;
    s->settings.it_lim = MOST_ITERATIONS;
}

static sl_status create(sl_context *context, sl_box bounds, void **state) {
    SL_TRY(sli_glpk_start(context));
    simplex *s = sl_alloc_array(context, 1, sizeof *s);
    if (!s) return SL_NO_MEMORY;
    const double width = bounds.max.x / 2 - bounds.min.x / 2;
    const double height = bounds.max.y / 2 - bounds.min.y / 2;
    int exponent;
    (void)frexp(fmax(width, height), &exponent);
    s->scale = ldexp(1, -exponent);
    s->origin = (sl_point){bounds.min.x + width, bounds.min.y + height};
    if (setjmp(s->guard.left)) {
        sl_free(context, s);
        return sli_glpk_failed(context);
    }
    sli_glpk_enter(&s->guard);
    make_problem(s);
    sli_glpk_leave();
    *state = s;
    return SL_OK;
}

static void destroy(sl_context *context, void *state) {
    simplex *s = state;
    if (!s) return;
    if (s->problem) glp_delete_prob(s->problem);
    sl_free(context, s->levels.items);
    sl_free(context, s->statuses.items);
    sl_free(context, s->ends.items);
    sl_free(context, s);
}

static bool same(vector a, vector b) {
    return a.x == b.x && a.y == b.y;
}

static double cross(vector a, vector b) {
    return a.x * b.y - a.y * b.x;
}

/// The unit direction that crosses a portal forwards: from right to left, turned clockwise.
static vector crossing(sl_point left, sl_point right) {
    const vector n = {left.y - right.y, right.x - left.x};
    const double length = hypot(n.x, n.y);
    return (vector){n.x / length, n.y / length};
}

/// Takes over the extremes of the level before, or what the new portal makes of them.
static void widen(level *to, const level *from, vector direction, uint32_t portal) {
    const bool first = !from;
    *to = first ? (level){0} : *from;
    if (first || cross(direction, from->rightmost) > 0) {
        to->rightmost = direction;
        to->rightmost_portal = portal;
    }
    if (first || cross(from->leftmost, direction) > 0) {
        to->leftmost = direction;
        to->leftmost_portal = portal;
    }
}

/// The sum of the two crossing directions that differ most.
static vector crossing_sum(const level *l) {
    vector w = l->rightmost;
    if (cross(l->rightmost, l->leftmost) > 0) {
        w.x += l->leftmost.x;
        w.y += l->leftmost.y;
    }
    return w;
}

static void set_normalisation(simplex *s, const level *l) {
    const vector w = crossing_sum(l);
    const int columns[] = {0, UX, UY};
    const double values[] = {0, w.x, w.y};
    glp_set_mat_row(s->problem, 1, 2, columns, values);
}

static void set_end_row(simplex *s, int row, sl_point at, bool left) {
    const vector end = {(at.x - s->origin.x) * s->scale, (at.y - s->origin.y) * s->scale};
    s->ends.items[s->ends.count++] = end;
    const int columns[] = {0, UX, UY, C, D};
    const double values[] = {0, end.y, -end.x, 1, left ? -1 : 1};
    glp_set_mat_row(s->problem, row, COLUMNS, columns, values);
    glp_set_row_bnds(s->problem, row, left ? GLP_LO : GLP_UP, 0, 0);
}

static void save_basis(simplex *s, level *l) {
    l->statuses = s->statuses.count;
    uint8_t *to = s->statuses.items + l->statuses;
    for (int i = 1; i <= COLUMNS; i++) *to++ = (uint8_t)glp_get_col_stat(s->problem, i);
    for (int i = 1; i <= glp_get_num_rows(s->problem); i++)
        *to++ = (uint8_t)glp_get_row_stat(s->problem, i);
    s->statuses.count = (size_t)(to - s->statuses.items);
}

static void restore_basis(simplex *s, const level *l) {
    const uint8_t *from = s->statuses.items + l->statuses;
    for (int i = 1; i <= COLUMNS; i++) glp_set_col_stat(s->problem, i, *from++);
    for (int i = 1; i <= glp_get_num_rows(s->problem); i++)
        glp_set_row_stat(s->problem, i, *from++);
}

/// The smallest margin that the line really has to the ends in the rows.
static double margin_of(const simplex *s, double ux, double uy, double c) {
    double least = INFINITY;
    for (int row = 2; row <= glp_get_num_rows(s->problem); row++) {
        const vector end = s->ends.items[row - 2];
        const double side = ux * end.y - uy * end.x + c;
        least = fmin(least, row % 2 == 0 ? side : -side);
    }
    return least;
}

/// Solves from the basis at hand. True where the optimum that GLPK tells is that of a line: an
/// ill-conditioned basis makes it tell optima that are none.
static bool solve_once(simplex *s, level *l) {
    if (glp_simplex(s->problem, &s->settings) != 0 || glp_get_status(s->problem) != GLP_OPT)
        return false;
    l->ux = glp_get_col_prim(s->problem, UX);
    l->uy = glp_get_col_prim(s->problem, UY);
    l->c = glp_get_col_prim(s->problem, C);
    const double length = hypot(l->ux, l->uy), margin = margin_of(s, l->ux, l->uy, l->c);
    l->margin = glp_get_obj_val(s->problem) / length;
    return fabs(margin / length - l->margin) <= TOLERANCE;
}

/// Solves from the basis of the push before, or from a fresh one where the program has changed too
/// much for it or it fails. False where neither comes to an end that can be trusted.
static bool solve(simplex *s, level *l) {
    const bool turned = s->levels.count && (!same(l->rightmost, l[-1].rightmost) ||
                                            !same(l->leftmost, l[-1].leftmost));
    if (!turned && solve_once(s, l)) return true;
    glp_std_basis(s->problem);
    return solve_once(s, l);
}

/// Whether a line square to w is a sightline within the tolerance. Row 1 leaves such lines out, and
/// those near to them need a u too long for doubles; it happens where all ends lie near one line.
static bool grazes_across(const simplex *s, const level *l) {
    const vector w = crossing_sum(l);
    const double length = hypot(w.x, w.y);
    for (int way = -1; way <= 1; way += 2) {
        const double ux = -way * w.y / length, uy = way * w.x / length;
        double left = INFINITY, right = -INFINITY;
        for (size_t i = 0; i < s->ends.count; i++) {
            const double side = ux * s->ends.items[i].y - uy * s->ends.items[i].x;
            if (i % 2)
                right = fmax(right, side);
            else
                left = fmin(left, side);
        }
        if ((left - right) / 2 >= -TOLERANCE) return true;
    }
    return false;
}

static sl_status simplex_push(sl_context *context, void *state, sl_point left, sl_point right,
                              sl_stab_verdict *verdict) {
    simplex *s = state;
    if (!s->problem) return sl_fail(context, SL_NO_MEMORY, "GLPK gave up earlier");
    SL_TRY(SL_ARRAY_ROOM(context, &s->levels, 1));
    // Four columns, row 1, and two rows a portal, this one's included.
    SL_TRY(SL_ARRAY_ROOM(context, &s->statuses, COLUMNS + 1 + 2 * (s->levels.count + 1)));
    SL_TRY(SL_ARRAY_ROOM(context, &s->ends, 2));
    level *l = &s->levels.items[s->levels.count];
    widen(l, s->levels.count ? l - 1 : NULL, crossing(left, right), (uint32_t)s->levels.count);
    if (setjmp(s->guard.left)) {
        s->problem = NULL;
        return sli_glpk_failed(context);
    }
    sli_glpk_enter(&s->guard);
    set_normalisation(s, l);
    const int row = glp_add_rows(s->problem, 2);
    set_end_row(s, row, left, true);
    set_end_row(s, row + 1, right, false);
    const bool solved = solve(s, l);
    save_basis(s, l);
    s->levels.count++;
    sli_glpk_leave();
    if (!solved) {
        // A bounded, feasible program has an optimum: that GLPK finds none is rounding's doing.
        l->ux = l->rightmost.x;
        l->uy = l->rightmost.y;
        l->c = 0;
        *verdict = SL_GRAZING;
        return SL_OK;
    }
    *verdict = l->margin > TOLERANCE                            ? SL_STABBED
               : l->margin >= -TOLERANCE || grazes_across(s, l) ? SL_GRAZING
                                                                : SL_HIDDEN;
    return SL_OK;
}

static void pop(void *state) {
    simplex *s = state;
    const level *l = &s->levels.items[--s->levels.count];
    s->statuses.count = l->statuses;
    s->ends.count -= 2;
    if (!s->problem) return;
    const int last = glp_get_num_rows(s->problem);
    const int rows[] = {0, last - 1, last};
    glp_del_rows(s->problem, 2, rows);
    if (!s->levels.count) {
        glp_std_basis(s->problem);
        return;
    }
    set_normalisation(s, l - 1);
    restore_basis(s, l - 1);
}

static sl_line witness(const void *state) {
    const simplex *s = state;
    const level *l = &s->levels.items[s->levels.count - 1];
    // The point of the line nearest to the middle of the bounds, and one further on.
    const double square = l->ux * l->ux + l->uy * l->uy;
    const double x = l->c * l->uy / square, y = -l->c * l->ux / square;
    return (sl_line){{s->origin.x + x / s->scale, s->origin.y + y / s->scale},
                     {s->origin.x + (x + l->ux) / s->scale, s->origin.y + (y + l->uy) / s->scale}};
}

/// A direction is an end at infinity: its row has no c.
static void set_direction_row(simplex *s, int row, sl_line direction, bool left) {
    const double x = direction.b.x - direction.a.x, y = direction.b.y - direction.a.y;
    const double length = hypot(x, y);
    const int columns[] = {0, UX, UY, D};
    const double values[] = {0, y / length, -x / length, left ? -1 : 1};
    glp_set_mat_row(s->problem, row, 3, columns, values);
    glp_set_row_bnds(s->problem, row, left ? GLP_LO : GLP_UP, 0, 0);
}

/// Solves with two more rows, which are taken away again.
static sl_status toward(sl_context *context, void *state, sl_line right, sl_line left,
                        sl_stab_verdict *verdict) {
    simplex *s = state;
    if (!s->problem) return sl_fail(context, SL_NO_MEMORY, "GLPK gave up earlier");
    const level *l = &s->levels.items[s->levels.count - 1];
    if (setjmp(s->guard.left)) {
        s->problem = NULL;
        return sli_glpk_failed(context);
    }
    sli_glpk_enter(&s->guard);
    const int row = glp_add_rows(s->problem, 2);
    set_direction_row(s, row, left, true);
    set_direction_row(s, row + 1, right, false);
    glp_std_basis(s->problem);
    const bool solved = glp_simplex(s->problem, &s->settings) == 0;
    const int found = glp_get_status(s->problem);
    const double length = hypot(glp_get_col_prim(s->problem, UX), glp_get_col_prim(s->problem, UY));
    const double margin = glp_get_obj_val(s->problem) / length;
    const int rows[] = {0, row, row + 1};
    glp_del_rows(s->problem, 2, rows);
    restore_basis(s, l);
    sli_glpk_leave();
    // What cannot be told within the tolerance counts as grazing, as in a push.
    *verdict = !solved || found != GLP_OPT || fabs(margin) <= TOLERANCE ? SL_GRAZING
               : margin > 0                                             ? SL_STABBED
                                                                        : SL_HIDDEN;
    return SL_OK;
}

static bool is_tight(const simplex *s, uint32_t portal) {
    const int row = 2 + 2 * (int)portal;
    return glp_get_row_stat(s->problem, row) != GLP_BS ||
           glp_get_row_stat(s->problem, row + 1) != GLP_BS;
}

size_t sli_glpk_tight_portals(const void *state, uint32_t portals[SLI_GLPK_TIGHT_MOST]) {
    const simplex *s = state;
    const level *l = &s->levels.items[s->levels.count - 1];
    size_t count = 0;
    if (!s->problem) return 0;
    for (uint32_t i = 0; i < s->levels.count && count < SLI_GLPK_TIGHT_MOST; i++)
        if (i == l->rightmost_portal || i == l->leftmost_portal || is_tight(s, i))
            portals[count++] = i;
    return count;
}

static void leave_thread(void) {
    glp_free_env();
}

const sl_solver *sl_glpk_simplex(void) {
    static const sl_solver solver = {
        .name = "glpk",
        .what = "linear program by GLPK's simplex, in doubles: the teaching reference",
        .guarantee = SL_ROUNDED,
        .create = create,
        .destroy = destroy,
        .push = simplex_push,
        .pop = pop,
        .toward = toward,
        .witness = witness,
        .leave_thread = leave_thread,
    };
    return &solver;
}

// --- the program itself

/// Copies row `number` of the problem, from 1.
static void read_row(const simplex *s, int number, sl_program_row *row) {
    int columns[COLUMNS + 1];
    double values[COLUMNS + 1];
    const int length = glp_get_mat_row(s->problem, number, columns, values);
    *row = (sl_program_row){.portal = number == 1 ? SL_PROGRAM_FIXED : (uint32_t)number / 2 - 1,
                            .left = number > 1 && number % 2 == 0};
    for (int i = 1; i <= length; i++) row->coefficients[columns[i] - 1] = values[i];
}

static void read_optimum(const simplex *s, sl_program *program) {
    const level *l = &s->levels.items[s->levels.count - 1];
    for (uint32_t i = 0; i < program->row_count; i++) {
        sl_program_row *row = &program->rows[i];
        row->value = glp_get_row_prim(s->problem, (int)i + 1);
        row->price = glp_get_row_dual(s->problem, (int)i + 1);
        row->basic = glp_get_row_stat(s->problem, (int)i + 1) == GLP_BS;
    }
    for (int i = 0; i < SL_PROGRAM_COLUMNS; i++) {
        program->values[i] = glp_get_col_prim(s->problem, i + 1);
        program->basic[i] = glp_get_col_stat(s->problem, i + 1) == GLP_BS;
    }
    program->objective = glp_get_obj_val(s->problem);
    program->margin = l->margin / s->scale;
}

/// GLPK's calls that read do not fail.
static sl_status read_program(sl_context *context, const simplex *s, sl_program *out) {
    if (!s->problem) return sl_fail(context, SL_NO_MEMORY, "GLPK gave up earlier");
    const int count = glp_get_num_rows(s->problem);
    out->rows = sl_alloc_array(context, (size_t)count, sizeof *out->rows);
    if (!out->rows) return SL_NO_MEMORY;
    out->row_count = (uint32_t)count;
    out->origin = s->origin;
    out->unit = 1 / s->scale;
    for (int i = 1; i <= count; i++) read_row(s, i, &out->rows[i - 1]);
    out->solved = glp_get_status(s->problem) == GLP_OPT;
    if (out->solved) read_optimum(s, out);
    return SL_OK;
}

sl_status sl_program_make(sl_context *context, const sl_portal_ends *portals, uint32_t count,
                          sl_program *out) {
    void *state;
    sl_stab_verdict verdict;
    sl_program made = {0};
    if (!count) return sl_fail(context, SL_BAD_ARGUMENT, "a program needs at least one portal");
    sl_box bounds = {portals[0].left, portals[0].left};
    for (uint32_t i = 0; i < 2 * count; i++) {
        const sl_point p = i % 2 ? portals[i / 2].right : portals[i / 2].left;
        bounds.min = (sl_point){fmin(bounds.min.x, p.x), fmin(bounds.min.y, p.y)};
        bounds.max = (sl_point){fmax(bounds.max.x, p.x), fmax(bounds.max.y, p.y)};
    }
    SL_TRY(create(context, bounds, &state));
    sl_status status = SL_OK;
    for (uint32_t i = 0; i < count && status == SL_OK; i++)
        status = simplex_push(context, state, portals[i].left, portals[i].right, &verdict);
    if (status == SL_OK) status = read_program(context, state, &made);
    destroy(context, state);
    if (status == SL_OK)
        *out = made;
    else
        sl_program_destroy(context, &made);
    return status;
}

void sl_program_destroy(sl_context *context, sl_program *program) {
    sl_free(context, program->rows);
    *program = (sl_program){0};
}

/// Stabbing as a linear program in rational arithmetic, by GLPK's exact simplex.
///
/// The program is that of glpk_simplex.c, built anew for every push. GLPK takes a coefficient that
/// is no integer for the nearest simple fraction, within 1e-9, so that truly visible sequences get
/// lost: it is given integers alone, and what does not fit is refused. Coordinates are counted from
/// the first end in steps of the coarsest power of two that all of them are multiples of.
#include "sightline/glpk.h"

#include "geometry/orient.h"
#include "sightline/support.h"
#include "stab/glpk_shared.h"

#include <math.h>

/// Coordinates up to here have differences whose sums are exact.
#define LARGEST 0x1p51

enum { UX = 1, UY, C, D, COLUMNS = D };

typedef struct program {
    SL_ARRAY(sl_portal_ends) portals;
    double step;
    double ux, uy,
        c; ///< the line found, in steps from the first end; all 0 for the ends' common line
    sli_glpk_guard guard;
} program;

static sl_status create(sl_context *context, sl_box bounds, void **state) {
    (void)bounds;
    SL_TRY(sli_glpk_start(context));
    *state = sl_alloc_array(context, 1, sizeof(program));
    return *state ? SL_OK : SL_NO_MEMORY;
}

static void destroy(sl_context *context, void *state) {
    program *p = state;
    if (!p) return;
    sl_free(context, p->portals.items);
    sl_free(context, p);
}

/// Whether b can be taken from a without rounding (Knuth's two-sum tells what is lost).
static bool difference_is_exact(double a, double b) {
    const double difference = a - b, back = a - difference;
    return isfinite(difference) && (a - (difference + back)) + (back - b) == 0;
}

/// The exponent of the lowest bit set; large for 0.
static int lowest_bit(double value) {
    if (value == 0) return 2000;
    int exponent;
    double fraction = ldexp(frexp(value, &exponent), 53);
    exponent -= 53;
    while (fmod(fraction, 2) == 0) {
        fraction /= 2;
        exponent++;
    }
    return exponent;
}

/// Chooses the step. False where no step makes integers of all that are small enough.
static bool choose_step(program *p) {
    const sl_point o = p->portals.items[0].left;
    int lowest = 2000;
    double largest = 0;
    for (size_t i = 0; i < p->portals.count; i++) {
        const sl_portal_ends *e = &p->portals.items[i];
        const double pairs[4][2] = {
            {e->left.x, o.x}, {e->left.y, o.y}, {e->right.x, o.x}, {e->right.y, o.y}};
        for (int k = 0; k < 4; k++) {
            const double d = pairs[k][0] - pairs[k][1];
            if (!difference_is_exact(pairs[k][0], pairs[k][1])) return false;
            if (lowest_bit(d) < lowest) lowest = lowest_bit(d);
            largest = fmax(largest, fabs(d));
        }
    }
    p->step = lowest < 2000 ? ldexp(1, lowest) : 1;
    return p->step > 0 && largest / p->step <= LARGEST;
}

static sl_point in_steps(const program *p, sl_point at) {
    const sl_point o = p->portals.items[0].left;
    return (sl_point){(at.x - o.x) / p->step, (at.y - o.y) / p->step};
}

/// The sum of the two crossing directions that differ most; one of them where all are the same.
static sl_point crossing_sum(const program *p) {
    const sl_point zero = {0, 0};
    sl_point rightmost = {0, 0}, leftmost = {0, 0};
    for (size_t i = 0; i < p->portals.count; i++) {
        const sl_point left = in_steps(p, p->portals.items[i].left);
        const sl_point right = in_steps(p, p->portals.items[i].right);
        const sl_point n = {left.y - right.y, right.x - left.x};
        if (i == 0 || sli_orient(zero, n, rightmost) > 0) rightmost = n;
        if (i == 0 || sli_orient(zero, leftmost, n) > 0) leftmost = n;
    }
    if (sli_orient(zero, rightmost, leftmost) == 0) return rightmost;
    return (sl_point){rightmost.x + leftmost.x, rightmost.y + leftmost.y};
}

static void set_end_row(glp_prob *problem, int row, sl_point end, bool left) {
    const int columns[] = {0, UX, UY, C, D};
    const double values[] = {0, end.y, -end.x, 1, left ? -1 : 1};
    glp_set_mat_row(problem, row, COLUMNS, columns, values);
    glp_set_row_bnds(problem, row, left ? GLP_LO : GLP_UP, 0, 0);
}

static glp_prob *make_problem(const program *p) {
    glp_prob *problem = glp_create_prob();
    glp_set_obj_dir(problem, GLP_MAX);
    glp_add_cols(problem, COLUMNS);
    for (int column = 1; column <= COLUMNS; column++)
        glp_set_col_bnds(problem, column, GLP_FR, 0, 0);
    glp_set_obj_coef(problem, D, 1);
    glp_add_rows(problem, 1 + 2 * (int)p->portals.count);
    const sl_point w = crossing_sum(p);
    const int columns[] = {0, UX, UY};
    const double values[] = {0, w.x, w.y};
    glp_set_mat_row(problem, 1, 2, columns, values);
    glp_set_row_bnds(problem, 1, GLP_FX, 1, 1);
    for (size_t i = 0; i < p->portals.count; i++) {
        set_end_row(problem, 2 + 2 * (int)i, in_steps(p, p->portals.items[i].left), true);
        set_end_row(problem, 3 + 2 * (int)i, in_steps(p, p->portals.items[i].right), false);
    }
    return problem;
}

/// Whether all ends lie on one line, which then is a sightline that row 1 leaves out.
static bool all_on_one_line(const program *p) {
    const sl_portal_ends *first = p->portals.items;
    for (size_t i = 1; i < p->portals.count; i++)
        if (sli_orient(first->right, first->left, p->portals.items[i].left) != 0 ||
            sli_orient(first->right, first->left, p->portals.items[i].right) != 0)
            return false;
    return true;
}

/// The largest margin; false where GLPK comes to no end.
static bool maximise(glp_prob *problem, double *margin) {
    glp_smcp settings;
    glp_init_smcp(&settings);
    settings.msg_lev = GLP_MSG_OFF;
    const bool solved = glp_exact(problem, &settings) == 0 && glp_get_status(problem) == GLP_OPT;
    *margin = glp_get_obj_val(problem);
    return solved;
}

static bool solve(program *p, double *margin) {
    glp_prob *problem = make_problem(p);
    const bool solved = maximise(problem, margin);
    p->ux = glp_get_col_prim(problem, UX);
    p->uy = glp_get_col_prim(problem, UY);
    p->c = glp_get_col_prim(problem, C);
    glp_delete_prob(problem);
    return solved;
}

static sl_status exact_push(sl_context *context, void *state, sl_point left, sl_point right,
                            sl_stab_verdict *verdict) {
    program *p = state;
    SL_TRY(SL_ARRAY_ROOM(context, &p->portals, 1));
    p->portals.items[p->portals.count++] = (sl_portal_ends){left, right};
    if (!choose_step(p))
        return sl_fail(context, SL_UNSUPPORTED,
                       "glpk-exact needs coordinates that are multiples of one power of two, "
                       "2^51 of it at most apart; take the solver 'funnel'");
    if (setjmp(p->guard.left)) return sli_glpk_failed(context);
    sli_glpk_enter(&p->guard);
    double margin;
    const bool solved = solve(p, &margin);
    sli_glpk_leave();
    if (!solved) return sl_fail(context, SL_UNSUPPORTED, "glpk-exact found no optimum");
    *verdict = margin > 0 ? SL_STABBED : margin < 0 ? SL_HIDDEN : SL_GRAZING;
    if (*verdict == SL_HIDDEN && all_on_one_line(p)) {
        p->ux = p->uy = p->c = 0;
        *verdict = SL_GRAZING;
    }
    return SL_OK;
}

/// A direction in whole numbers, up to its length. False where they do not fit.
static bool in_whole_numbers(sl_line direction, sl_point *out) {
    const sl_point a = direction.a, b = direction.b;
    if (!difference_is_exact(b.x, a.x) || !difference_is_exact(b.y, a.y)) return false;
    const double x = b.x - a.x, y = b.y - a.y;
    const int lowest = lowest_bit(x) < lowest_bit(y) ? lowest_bit(x) : lowest_bit(y);
    *out = (sl_point){ldexp(x, -lowest), ldexp(y, -lowest)};
    return fabs(out->x) <= LARGEST && fabs(out->y) <= LARGEST;
}

/// A direction is an end at infinity: its row has no c.
static void set_direction_row(glp_prob *problem, int row, sl_point direction, bool left) {
    const int columns[] = {0, UX, UY, D};
    const double values[] = {0, direction.y, -direction.x, left ? -1 : 1};
    glp_set_mat_row(problem, row, 3, columns, values);
    glp_set_row_bnds(problem, row, left ? GLP_LO : GLP_UP, 0, 0);
}

static sl_status toward(sl_context *context, void *state, sl_line right, sl_line left,
                        sl_stab_verdict *verdict) {
    program *p = state;
    sl_point of_right, of_left;
    if (!in_whole_numbers(right, &of_right) || !in_whole_numbers(left, &of_left))
        return sl_fail(context, SL_UNSUPPORTED,
                       "glpk-exact needs directions in whole numbers up to 2^51; take the solver "
                       "'funnel'");
    if (setjmp(p->guard.left)) return sli_glpk_failed(context);
    sli_glpk_enter(&p->guard);
    double margin;
    glp_prob *problem = make_problem(p);
    const int row = glp_add_rows(problem, 2);
    set_direction_row(problem, row, of_left, true);
    set_direction_row(problem, row + 1, of_right, false);
    const bool solved = maximise(problem, &margin);
    glp_delete_prob(problem);
    sli_glpk_leave();
    if (!solved) return sl_fail(context, SL_UNSUPPORTED, "glpk-exact found no optimum");
    *verdict = margin > 0 ? SL_STABBED : margin < 0 ? SL_HIDDEN : SL_GRAZING;
    // Row 1 leaves out the line that all ends lie on.
    if (*verdict == SL_HIDDEN && all_on_one_line(p)) *verdict = SL_GRAZING;
    return SL_OK;
}

static void pop(void *state) {
    program *p = state;
    p->portals.count--;
}

static sl_line witness(const void *state) {
    const program *p = state;
    const sl_portal_ends *first = p->portals.items;
    const double square = p->ux * p->ux + p->uy * p->uy;
    if (square == 0) return (sl_line){first->right, first->left};
    // The point of the line nearest to the first end, and one a portal's length further on.
    const double length = hypot(first->left.x - first->right.x, first->left.y - first->right.y);
    const sl_point a = {first->left.x + p->c * p->uy / square * p->step,
                        first->left.y - p->c * p->ux / square * p->step};
    const sl_point b = {a.x + p->ux / sqrt(square) * length, a.y + p->uy / sqrt(square) * length};
    return (sl_line){a, b};
}

static void leave_thread(void) {
    glp_free_env();
}

const sl_solver *sl_glpk_exact(void) {
    static const sl_solver solver = {
        .name = "glpk-exact",
        .what = "the linear program in rational arithmetic; refuses what does not fit integers",
        .guarantee = SL_EXACT,
        .create = create,
        .destroy = destroy,
        .push = exact_push,
        .pop = pop,
        .toward = toward,
        .witness = witness,
        .leave_thread = leave_thread,
    };
    return &solver;
}

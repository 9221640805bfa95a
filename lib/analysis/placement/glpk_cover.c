/// Set cover's linear and integer programs by GLPK: a row each, sum of its columns >= its demand.
///
/// The relaxation begins with no column taken, which is dual feasible, as costs are positive; so
/// the dual simplex runs from the first step on. A column that is fixed changes its bounds alone,
/// and the basis stays dual feasible: the next run goes on from it.
#include "sightline/set_cover.h"
#include "stab/glpk_shared.h"

#include <float.h>
#include <limits.h>

typedef struct relaxation {
    const sl_cover_problem *problem;
    glp_prob *lp;
    glp_smcp settings;
    uint8_t *fixed; ///< by column, as the program has it
    bool bounded;   ///< a row demands several columns: none counts for more than one
    sli_glpk_guard guard;
} relaxation;

static size_t begin_of(const sl_cover_problem *p, uint32_t column) {
    return column ? p->ends[column - 1] : 0;
}

static void bind(const relaxation *r, uint32_t column, uint8_t how) {
    const double at = how == 2;
    if (how)
        glp_set_col_bnds(r->lp, (int)column + 1, GLP_FX, at, at);
    else
        glp_set_col_bnds(r->lp, (int)column + 1, r->bounded ? GLP_DB : GLP_LO, 0, 1);
}

/// Adds the rows of the problem from `first` on, and puts in the entries of all columns. `numbers`
/// and `ones`: room for a column.
static void fill(relaxation *r, uint32_t first, int *numbers, double *ones) {
    const sl_cover_problem *p = r->problem;
    const bool bounded = r->bounded;
    if (p->row_count > first) glp_add_rows(r->lp, (int)(p->row_count - first));
    for (uint32_t i = first; i < p->row_count; i++) {
        const uint32_t demand = p->demands ? p->demands[i] : 1;
        r->bounded |= demand > 1;
        glp_set_row_bnds(r->lp, (int)i + 1, GLP_LO, demand, demand);
    }
    for (uint32_t j = 0; j < p->column_count && r->bounded != bounded; j++) bind(r, j, r->fixed[j]);
    for (uint32_t j = 0; j < p->column_count; j++) {
        int count = 0;
        for (size_t i = begin_of(p, j); i < p->ends[j]; i++) {
            const bool repeats = count && numbers[count] == (int)p->entries[i] + 1;
            if (!repeats) numbers[++count] = (int)p->entries[i] + 1;
            ones[count] = repeats ? ones[count] + 1 : 1;
        }
        glp_set_mat_col(r->lp, (int)j + 1, count, numbers, ones);
    }
}

static void create(relaxation *r) {
    const sl_cover_problem *p = r->problem;
    r->lp = glp_create_prob();
    glp_add_cols(r->lp, (int)p->column_count);
    for (uint32_t j = 0; j < p->column_count; j++) {
        glp_set_obj_coef(r->lp, (int)j + 1, p->costs ? p->costs[j] : 1);
        bind(r, j, 0);
    }
    glp_init_smcp(&r->settings);
    r->settings.msg_lev = GLP_MSG_OFF;
    r->settings.meth = GLP_DUALP;
}

/// Creates the program where there is none, takes out the rows that are gone, and puts in those of
/// the problem from `first` on.
static sl_status load(sl_context *context, relaxation *r, uint32_t first, int gone_count,
                      const int *gone) {
    const sl_cover_problem *p = r->problem;
    int *numbers = sl_alloc_array(context, (size_t)p->row_count + 1, sizeof *numbers);
    double *ones = sl_alloc_array(context, (size_t)p->row_count + 1, sizeof *ones);
    sl_status status = numbers && ones ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) {
        if (setjmp(r->guard.left)) {
            r->lp = NULL;
            status = sli_glpk_failed(context);
        } else {
            sli_glpk_enter(&r->guard);
            if (!r->lp) create(r);
            if (gone_count) glp_del_rows(r->lp, gone_count, gone);
            fill(r, first, numbers, ones);
            sli_glpk_leave();
        }
    }
    sl_free(context, numbers);
    sl_free(context, ones);
    return status;
}

static void end(sl_context *context, void *state) {
    relaxation *r = state;
    if (!r) return;
    if (r->lp) glp_delete_prob(r->lp);
    sl_free(context, r->fixed);
    sl_free(context, r);
}

static sl_status begin(sl_context *context, const sl_cover_problem *problem, void **state) {
    if (problem->row_count >= INT_MAX / 2 || problem->column_count >= INT_MAX / 2)
        return sl_fail(context, SL_UNSUPPORTED, "too many rows or columns for GLPK");
    SL_TRY(sli_glpk_start(context));
    relaxation *r = sl_alloc_array(context, 1, sizeof *r);
    if (!r) return SL_NO_MEMORY;
    r->problem = problem;
    r->fixed = sl_alloc_array(context, problem->column_count, sizeof *r->fixed);
    const sl_status status = r->fixed ? load(context, r, 0, 0, NULL) : SL_NO_MEMORY;
    if (status == SL_OK)
        *state = r;
    else
        end(context, r);
    return status;
}

/// Solves, from the last basis or else from scratch. False where there is neither an optimum nor a
/// bound that is enough.
static bool solve(relaxation *r) {
    for (int tries = 0; tries < 2; tries++) {
        const int ended = glp_simplex(r->lp, &r->settings);
        const bool optimal = ended == 0 && glp_get_status(r->lp) == GLP_OPT;
        if (optimal || ended == GLP_EOBJUL || ended == GLP_EITLIM) return ended != GLP_EITLIM;
        glp_std_basis(r->lp);
    }
    return false;
}

static sl_status again(sl_context *context, void *state, const uint8_t *fixed, uint64_t work,
                       double enough, double *duals, double *values) {
    relaxation *r = state;
    const sl_cover_problem *p = r->problem;
    if (!r->lp) return sl_fail(context, SL_NO_MEMORY, "GLPK gave up earlier");
    if (setjmp(r->guard.left)) {
        r->lp = NULL;
        return sli_glpk_failed(context);
    }
    sli_glpk_enter(&r->guard);
    for (uint32_t j = 0; j < p->column_count; j++)
        if (r->fixed[j] != fixed[j]) bind(r, j, r->fixed[j] = fixed[j]);
    r->settings.it_lim = work && work < INT_MAX ? (int)work : INT_MAX;
    r->settings.obj_ul = enough > 0 ? enough : DBL_MAX;
    const bool solved = solve(r);
    for (uint32_t i = 0; i < p->row_count && solved; i++)
        duals[i] = glp_get_row_dual(r->lp, (int)i + 1);
    for (uint32_t j = 0; j < p->column_count && solved; j++)
        values[j] = glp_get_col_prim(r->lp, (int)j + 1);
    sli_glpk_leave();
    return solved ? SL_OK
                  : sl_fail(context, SL_UNSUPPORTED, "GLPK finds no optimum of the relaxation");
}

static sl_status change(sl_context *context, void *state, const sl_cover_problem *problem,
                        const bool *gone) {
    relaxation *r = state;
    if (!r->lp) return sl_fail(context, SL_NO_MEMORY, "GLPK gave up earlier");
    const int before = glp_get_num_rows(r->lp); // `problem` may be where the one before was
    if (problem->row_count >= INT_MAX / 2)
        return sl_fail(context, SL_UNSUPPORTED, "too many rows for GLPK");
    int *rows = sl_alloc_array(context, (size_t)before + 1, sizeof *rows), count = 0;
    if (!rows) return SL_NO_MEMORY;
    for (int i = 0; i < before; i++)
        if (gone[i]) rows[++count] = i + 1;
    r->problem = problem;
    const sl_status status = load(context, r, (uint32_t)(before - count), count, rows);
    sl_free(context, rows);
    return status;
}

static sl_status relax(sl_context *context, const sl_cover_problem *problem, uint64_t work,
                       double *duals, double *values) {
    void *state = NULL;
    SL_TRY(begin(context, problem, &state));
    const relaxation *r = state;
    const sl_status status = again(context, state, r->fixed, work, 0, duals, values);
    end(context, state);
    return status;
}

// --- the integer program

typedef struct nodes {
    uint64_t left;
} nodes;

static void count_nodes(glp_tree *tree, void *info) {
    nodes *n = info;
    if (glp_ios_reason(tree) != GLP_ISELECT) return;
    if (!n->left)
        glp_ios_terminate(tree);
    else
        n->left--;
}

static sl_status branch(sl_context *context, const sl_cover_problem *problem, uint64_t limit,
                        uint32_t *columns, uint32_t *count) {
    void *state = NULL;
    SL_TRY(begin(context, problem, &state));
    relaxation *r = state;
    nodes n = {limit};
    glp_iocp settings;
    glp_init_iocp(&settings);
    settings.msg_lev = GLP_MSG_OFF;
    settings.cb_func = count_nodes;
    settings.cb_info = &n;

    if (setjmp(r->guard.left)) {
        r->lp = NULL;
        end(context, r);
        return sli_glpk_failed(context);
    }
    sli_glpk_enter(&r->guard);
    for (uint32_t j = 0; j < problem->column_count; j++)
        glp_set_col_kind(r->lp, (int)j + 1, GLP_BV);
    bool found = solve(r);
    if (found) {
        (void)glp_intopt(r->lp, &settings);
        found = glp_mip_status(r->lp) == GLP_OPT || glp_mip_status(r->lp) == GLP_FEAS;
    }
    *count = 0;
    for (uint32_t j = 0; j < problem->column_count && found; j++)
        if (glp_mip_col_val(r->lp, (int)j + 1) > 0.5) columns[(*count)++] = j;
    sli_glpk_leave();
    end(context, r);
    return found ? SL_OK : sl_fail(context, SL_UNSUPPORTED, "GLPK finds no set within its limit");
}

const sl_cover_program *sl_cover_glpk(void) {
    static const sl_cover_program program = {
        .name = "glpk",
        .what = "dual simplex in doubles, by GLPK",
        .relax = relax,
        .branch = branch,
        .begin = begin,
        .again = again,
        .end = end,
        .change = change,
    };
    return &program;
}

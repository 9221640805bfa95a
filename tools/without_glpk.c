// A build without sightline_glpk: its solvers are known by name and refused.
#include "sightline/glpk.h"
#include "sightline/support.h"

static sl_status refuse(sl_context *context, sl_box bounds, void **state) {
    (void)bounds, (void)state;
    return sl_fail(context, SL_UNSUPPORTED, "this build has no GLPK (SIGHTLINE_GLPK is off)");
}

static void destroy(sl_context *context, void *state) {
    (void)context, (void)state;
}

#define WHAT "not in this build (SIGHTLINE_GLPK is off)"

const sl_solver *sl_glpk_simplex(void) {
    static const sl_solver solver = {.name = "glpk",
                                     .what = WHAT,
                                     .guarantee = SL_ROUNDED,
                                     .create = refuse,
                                     .destroy = destroy};
    return &solver;
}

const sl_solver *sl_glpk_hybrid(void) {
    static const sl_solver solver = {.name = "hybrid",
                                     .what = WHAT,
                                     .guarantee = SL_EXACT,
                                     .create = refuse,
                                     .destroy = destroy};
    return &solver;
}

const sl_solver *sl_glpk_exact(void) {
    static const sl_solver solver = {.name = "glpk-exact",
                                     .what = WHAT,
                                     .guarantee = SL_EXACT,
                                     .create = refuse,
                                     .destroy = destroy};
    return &solver;
}

/// Registers the solvers of sightline_glpk.
#include "sightline/glpk.h"
#include "system/built.h"

static const sl_solver *(*const solvers[])(void) = {sl_glpk_simplex, sl_glpk_hybrid, sl_glpk_exact,
                                                    NULL};

const built_part with_glpk = {.solvers = solvers, .cover = sl_cover_glpk};

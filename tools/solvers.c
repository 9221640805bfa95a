#include "solvers.h"

#include "sightline/glpk.h"
#include "sightline/stab.h"

const sl_solver *solver_at(size_t index) {
    static const sl_solver *(*const solvers[])(void) = {sl_funnel, sl_glpk_simplex, sl_glpk_hybrid,
                                                        sl_glpk_exact};
    return index < sizeof solvers / sizeof *solvers ? solvers[index]() : NULL;
}

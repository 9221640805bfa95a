/// The solvers that are built, for tests that ask each of them the same.
#ifndef SL_TESTS_SOLVER_TABLE_H
#define SL_TESTS_SOLVER_TABLE_H

#include "oracle/oracle.h"
#include "sightline/stab.h"

#ifdef SIGHTLINE_TESTS_GLPK
#include "sightline/glpk.h"
#endif

/// The most solvers, for tables with a line for each.
#define SOLVERS_MOST 8

/// NULL behind the last.
static inline const sl_solver *solver_at(size_t index) {
    static const sl_solver *(*const solvers[])(void) = {
        sl_funnel,
#ifdef SIGHTLINE_TESTS_GLPK
        sl_glpk_simplex,
        sl_glpk_hybrid,
        sl_glpk_exact,
#endif
    };
    return index < sizeof solvers / sizeof *solvers ? solvers[index]() : NULL;
}

/// The longest sequence that a solver can be asked about without a long wait.
static inline size_t solver_patience(const sl_solver *solver) {
#ifdef SIGHTLINE_TESTS_GLPK
    if (solver == sl_glpk_exact()) return 48;
#endif
    (void)solver;
    return SIZE_MAX;
}

/// Frees what the solvers' libraries keep, once no solver lives.
static inline void solvers_leave(void) {
    for (size_t i = 0; solver_at(i); i++)
        if (solver_at(i)->leave_thread) solver_at(i)->leave_thread();
}

static inline const char *verdict_name(sl_stab_verdict verdict) {
    static const char *const names[] = {"hidden", "grazing", "stabbed"};
    return names[verdict];
}

#endif

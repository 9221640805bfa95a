/// The solvers that a bake may use.
#ifndef SOLVERS_H
#define SOLVERS_H

#include "sightline/stab.h"

/// The solver of that number, from 0, which is the default; NULL past the last.
const sl_solver *solver_at(size_t index);

#endif

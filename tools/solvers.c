#include "solvers.h"

#include "built.h"
#include "sightline/stab.h"

const sl_solver *solver_at(size_t index) {
    return index ? built_solver(index - 1) : sl_funnel();
}

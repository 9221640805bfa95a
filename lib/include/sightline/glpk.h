/// Stabbing by GLPK's linear programs. In a library of its own, sightline_glpk, since GLPK is under
/// the GPL, version 3.
#ifndef SIGHTLINE_GLPK_H
#define SIGHTLINE_GLPK_H

#include "sightline/stab.h"

#ifdef __cplusplus
extern "C" {
#endif

/// "glpk": the teaching reference. A linear program in doubles that maximises the line's margin to
/// the portals' ends, warm started from push to push. SL_ROUNDED: a margin within 1e-9 of the
/// bounds' size either way is SL_GRAZING.
SL_API const sl_solver *sl_glpk_simplex(void);

/// "glpk-exact": the same program in rational arithmetic. GLPK rounds coefficients that are not
/// integers, so it is given integers: coordinates as multiples of a power of two, from the
/// sequence's first end. SL_EXACT; a sequence that needs integers beyond 2^51 is refused with
/// SL_UNSUPPORTED.
SL_API const sl_solver *sl_glpk_exact(void);

/// "hybrid": the program in doubles, its answer confirmed by exact predicates: a line by the line
/// itself, a hidden sequence by the few portals that the program says are in each other's way. What
/// cannot be confirmed is decided by the funnel. SL_EXACT for all finite coordinates.
SL_API const sl_solver *sl_glpk_hybrid(void);

#ifdef __cplusplus
}
#endif

#endif

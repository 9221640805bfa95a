/// Stabbing by GLPK's simplex: the teaching reference. In a library of its own, sightline_glpk,
/// since GLPK is under the GPL, version 3.
#ifndef SIGHTLINE_GLPK_H
#define SIGHTLINE_GLPK_H

#include "sightline/stab.h"

#ifdef __cplusplus
extern "C" {
#endif

/// "glpk": a linear program in doubles that maximises the line's margin to the portals' ends, warm
/// started from push to push. SL_ROUNDED: a margin within 1e-9 of the bounds' size either way is
/// SL_GRAZING.
SL_API const sl_solver *sl_glpk_simplex(void);

#ifdef __cplusplus
}
#endif

#endif

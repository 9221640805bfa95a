/// The core library's own solvers. Those that need GLPK are in glpk.h.
#ifndef SIGHTLINE_SOLVERS_H
#define SIGHTLINE_SOLVERS_H

#include "sightline/stab.h"

#ifdef __cplusplus
extern "C" {
#endif

/// "funnel": the incremental exact solver. SL_EXACT for all finite coordinates, whatever their
/// size. Its witness passes strictly between the ends where doubles can express such a line, and
/// else goes through two ends.
SL_API const sl_solver *sl_funnel(void);

#ifdef __cplusplus
}
#endif

#endif

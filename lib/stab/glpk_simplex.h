/// What a solver that confirms GLPK's answers needs to see of them.
#ifndef SL_GLPK_SIMPLEX_H
#define SL_GLPK_SIMPLEX_H

#include "sightline/glpk.h"

#include <stddef.h>

/// Portals of the sequence that the last answer rests on, ascending, each once: those with an end
/// that the line found is tight to, and the two that bound its direction. At most 6 are told.
enum { SL_GLPK_TIGHT_MOST = 6 };
size_t sl_glpk_tight_portals(const void *simplex, uint32_t portals[SL_GLPK_TIGHT_MOST]);

#endif

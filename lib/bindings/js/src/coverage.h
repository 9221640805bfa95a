/// What given viewpoints see together, for modules that answer more than that.
#ifndef SIGHTLINE_JS_COVERAGE_H
#define SIGHTLINE_JS_COVERAGE_H

#include "bindings/js/src/floor.h"
#include "sightline/coverage.h"

typedef struct sli_covered {
    sl_coverage coverage;
    uint32_t *pieces; ///< by piece that is inside: its corners, how many see it, its blind spot
    double *corners;
    double *rows; ///< of viewpoints, then of blind spots
} sli_covered;

/// What a module keeps of it for a floor; NULL where there is no memory. Each module has its own.
sli_covered *sli_covered_of(sli_floor *floor);
void sli_covered_forget(sli_covered *covered);
/// Viewpoints of rows x, y, heading, fov, range, nearest. The caller frees them (sl_free).
sl_viewpoint *sli_viewpoints(const double *given, size_t count);

#endif

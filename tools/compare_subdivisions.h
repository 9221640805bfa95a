/// A map that several subdivisions can take, by each of them: what the fastest exact run makes of
/// it.
#ifndef COMPARE_SUBDIVISIONS_H
#define COMPARE_SUBDIVISIONS_H

#include "compare_time.h"
#include "json_print.h"
#include "sightline/space.h"

enum { SL_SUBDIVISIONS_MOST = 8 };

typedef struct sl_compare_subdivision {
    const sl_subdivision *subdivision;
    uint32_t cells, portals;
    double subdivide_seconds;
    bool done;      ///< the run; else these are 0:
    double seconds; ///< the median of its timings
    uint64_t pairs;
} sl_compare_subdivision;

typedef struct sl_compare_subdivisions {
    sl_compare_subdivision items[SL_SUBDIVISIONS_MOST];
    size_t count; ///< 0 where only one can be
    const sl_see_method *method;
    const sl_solver *solver; ///< NULL for none
} sl_compare_subdivisions;

/// Subdivides a clean axial map by the kd-tree and as a mesh, and times `like` on both.
sl_status sl_compare_subdivisions_time(sl_console *console, const sl_map *map,
                                       const sl_see_options *options, const sl_timing *timing,
                                       const sl_compare_run *like, sl_compare_subdivisions *out);

void sl_compare_subdivisions_print(const sl_compare_subdivisions *all);
/// A list "subdivisions".
void sl_compare_subdivisions_add_json(sl_json_fields *fields, const sl_compare_subdivisions *all);

#endif

/// How much a cell sees, in the mean.
#ifndef MEAN_PVS_H
#define MEAN_PVS_H

#include "json_print.h"
#include "sightline/bake.h"

/// Means over the cells that count (sl_baked_counts), each weighted equally, as sources and as what
/// is seen.
typedef struct sl_mean_pvs {
    bool inside_only;
    uint32_t cell_count;   ///< cells looked at
    double cells;          ///< seen, the source itself included
    double share_of_cells; ///< cells / cell_count
    double share_of_area;  ///< area seen / area of all cells looked at
} sl_mean_pvs;

sl_status sl_mean_pvs_of(sl_context *context, const sl_baked *baked, sl_mean_pvs *out);

/// As lines of a report.
void sl_mean_pvs_print(const sl_mean_pvs *mean);
/// As fields "mean_pvs_...".
void sl_mean_pvs_add_json(sl_json_fields *fields, const sl_mean_pvs *mean);

#endif

/// Parts of reports that several commands print: the plan of a map, how much a cell sees.
#ifndef REPORT_H
#define REPORT_H

#include "json_print.h"
#include "names.h"
#include "sightline/bake.h"
#include "sightline/effects.h"

/// The names of all effects; what the table points to is the caller's.
typedef struct sl_effect_names {
    const char *names[32];
} sl_effect_names;

sl_name_table sl_effect_table(sl_effect_names *names);

/// What a map calls for, what each adds to the work, and what is left out as nothing calls for it.
void sl_plan_print(const sl_map *map);

/// "effects": a flag for each.
void sl_plan_add_json(sl_json_fields *fields, const sl_map *map);

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

/// Parts of reports that several commands print: the plan of a map, the account of cleaning, how
/// much a cell sees on average, and times.
#ifndef REPORT_H
#define REPORT_H

#include "reports/json_print.h"
#include "sightline/bake.h"

/// Prints the effects that a map has, what each adds to the work, and the effects that it does not
/// have.
void plan_print(const sl_map *map);

/// Adds "effects": a flag for each.
void plan_add_json(json_fields *fields, const sl_map *map);

/// Prints what cleaning did, if anything: the rest of a line, and a line about welding.
void cleaning_print(const sl_clean_account *account);

/// Prints the shares of inside, outside and solid ground, unless all is inside.
void ground_print(const sl_space *space);
/// Adds "inside_share", "outside_share" and "solid_share" of the area, 0 to 1.
void ground_add_json(json_fields *fields, const sl_space *space);

/// Means over the cells that count (sl_baked_counts), with equal weights. Only these cells count as
/// seen, too.
typedef struct pvs_means {
    bool inside_only;
    uint32_t cell_count;   ///< cells looked at
    double cells;          ///< seen, the source itself included
    double share_of_cells; ///< cells / cell_count
    double share_of_area;  ///< area seen / area of all cells looked at
} pvs_means;

sl_status mean_pvs_of(sl_context *context, const sl_baked *baked, pvs_means *out);

/// As lines of a report.
void mean_pvs_print(const pvs_means *mean);
/// As fields "mean_pvs_...".
void mean_pvs_add_json(json_fields *fields, const pvs_means *mean);

void sort_doubles(double *values, size_t count); ///< ascending

enum { SECONDS_TEXT = 32 };

/// "412 us", "53.4 ms", "61 s"; `micro` is how a millionth is written.
void seconds_write(double seconds, const char *micro, char text[SECONDS_TEXT]);

#endif

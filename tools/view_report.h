/// What the command tells of view cells: a table, a report, a picture.
#ifndef VIEW_REPORT_H
#define VIEW_REPORT_H

#include "sightline/draw.h"
#include "view_run.h"

typedef struct sl_view_report {
    const char *input, *subdivide;
    const sl_view_run_options *options;
    const sl_view_run *run;
} sl_view_report;

sl_status sl_view_report_print(sl_context *context, const sl_view_report *report);
sl_status sl_view_report_print_json(sl_context *context, const sl_view_report *report);

/// A row a view cell: its number, probability, cost, objects, bytes, elementary cells, and a point
/// in the largest of those.
sl_status sl_view_report_write_csv(sl_context *context, const sl_view_run *run, const char *path);

/// The view cells by their cost.
sl_status sl_view_report_draw(sl_context *context, const sl_view_report *report,
                              const sl_draw_options *options, const char *path);

#endif

/// The report of a plan: pictures, tables and words, as blocks of a document.
#ifndef PLAN_REPORT_H
#define PLAN_REPORT_H

#include "studies/vga_field.h"

/// What is asked. `graph.points.step` may be 0 (vga_compute).
typedef struct plan_report_plan {
    vga_plan graph;
    const char *title;    ///< NULL: the name of the file
    option_list measures; ///< heat maps, by name; none: the usual ones
    const char *cameras;  ///< a table of viewpoints; NULL: none
} plan_report_plan;

/// Computes and writes the report to a PDF.
sl_status plan_report_write(sl_context *context, plan_report_plan *plan, const char *path);

#endif

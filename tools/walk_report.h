/// What walks come to, as tables; and as charts over speed and chance, as the paper has them.
#ifndef WALK_REPORT_H
#define WALK_REPORT_H

#include "walk_run.h"

/// A walk that was made: what it was made with, and its means.
typedef struct sl_walk_row {
    sl_walk_choice choice;
    double speed; ///< relative
    size_t steps;
    double means[SL_FIGURES];
} sl_walk_row;

typedef SL_ARRAY(sl_walk_row) sl_walk_rows;

/// Prints the rows.
void sl_walk_print(const sl_walk_rows *rows);

/// All figures of all rows as CSV.
sl_status sl_walk_write_rows(sl_context *context, const sl_walk_rows *rows, const char *path);

/// Frames as CSV: `frames[i]` has those of row i, or is NULL.
sl_status sl_walk_write_frames(sl_context *context, const sl_walk_rows *rows, const sl_eyes *eyes,
                               double *const *frames, const char *path);

/// A chart of a figure over the speed: a line for each of some methods (bits, in the order of the
/// table; no more than a chart has colours) with one test.
typedef struct sl_walk_chart {
    const char *title;
    sl_walk_figure figure;
    unsigned methods;
} sl_walk_chart;

sl_status sl_walk_draw_speeds(sl_context *context, const sl_walk_rows *rows,
                              const sl_walk_chart *chart, const char *test, const char *path);

/// The time of a frame over p_skip, a line for each test.
sl_status sl_walk_draw_chances(sl_context *context, const sl_walk_rows *rows, const char *title,
                               const char *path);

#endif

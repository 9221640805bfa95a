/// What came of a comparison: as a table for people, as CSV and JSON for programs, as a chart.
#ifndef COMPARE_REPORT_H
#define COMPARE_REPORT_H

#include "compare_judge.h"
#include "compare_subdivisions.h"

typedef struct sl_comparison {
    const char *input; ///< the map's file
    const sl_space *space;
    sl_sight sight;
    sl_compare_run *runs;
    size_t run_count;
    const size_t *order; ///< of the runs: see sl_compare_order
    size_t reference;    ///< see sl_compare_reference
    double limit;        ///< seconds that a run was given
    sl_compare_subdivisions subdivisions;
} sl_comparison;

enum { SL_RUN_NAME = 64 };

/// "dfs with funnel"
void sl_run_name(const sl_compare_run *run, char name[SL_RUN_NAME]);

enum { SL_SECONDS_TEXT = 32 };

/// "412 us", "53.4 ms", "61 s"; `micro` is how a millionth is written.
void sl_seconds_write(double seconds, const char *micro, char text[SL_SECONDS_TEXT]);

/// Whether no run that is judged has pairs too many or too few.
bool sl_compare_all_agree(const sl_comparison *comparison);

void sl_compare_print(const sl_comparison *comparison);
sl_status sl_compare_print_json(sl_context *context, const sl_comparison *comparison);

/// A line a run.
sl_status sl_compare_write_csv(sl_context *context, const sl_comparison *comparison,
                               const char *path);
/// For --help: what its columns are.
void sl_compare_print_columns(void);

/// A line for each ordered pair of cells on which two runs disagree.
sl_status sl_compare_write_pairs(sl_context *context, const sl_comparison *comparison,
                                 const char *path);

/// Accuracy against time; .png, .svg or .pdf by the ending of the path.
sl_status sl_compare_draw(sl_context *context, const sl_comparison *comparison, bool dark,
                          const char *path);

#endif

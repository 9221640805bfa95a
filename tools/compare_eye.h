/// Culling methods on many viewpoints of one map: what each keeps, and what it costs. This is the
/// table of Teller & Séquin 1991, Results.
#ifndef COMPARE_EYE_H
#define COMPARE_EYE_H

#include "console.h"
#include "pipeline.h"
#include "sightline/eye_to_cell.h"

enum { SL_FOVS_MOST = 8 };

/// The options as they are given.
typedef struct sl_compare_eye_texts {
    const char *viewpoints, *seed, *fov;
} sl_compare_eye_texts;

/// What is asked for.
typedef struct sl_compare_eye_plan {
    uint64_t viewpoints, seed;
    double fovs[SL_FOVS_MOST]; ///< widths of view cones in degrees
    size_t fov_count;
} sl_compare_eye_plan;

sl_status sl_compare_eye_plan_make(sl_context *context, const sl_compare_eye_texts *texts,
                                   sl_compare_eye_plan *out);

/// One way to say what is seen, with one cone: means over all viewpoints but
/// for the time.
typedef struct sl_compare_eye_row {
    const char *name; ///< of the method, as in the library's table
    sl_guarantee guarantee;
    double fov;
    double share;               ///< of the map's area that is kept
    double cells;               ///< that are kept
    double nodes, orientations; ///< see sl_eye_account
    double seconds;             ///< a query: the median over batches of some
} sl_compare_eye_row;

typedef struct sl_compare_eye {
    const char *input;
    const sl_space *space;
    sl_sight sight;
    const sl_compare_eye_plan *plan;
    double pvs_seconds;       ///< that the visible sets took
    sl_compare_eye_row *rows; ///< cone by cone, the loosest method first
    size_t row_count;
} sl_compare_eye;

/// Viewpoints are spread evenly over the area of the inside cells, and look any way; shares are of
/// that area. `out` refers to the plan and the space; sl_free(out->rows) is the caller's.
sl_status sl_compare_eye_run(sl_console *console, const sl_compare_eye_plan *plan,
                             const sl_space *space, sl_sight sight, sl_compare_eye *out);

/// What the paper tells of a method; false where it does not.
bool sl_compare_eye_paper(const char *name, double fov, double *share, double *reduction);

void sl_compare_eye_print(const sl_compare_eye *comparison);
sl_status sl_compare_eye_print_json(sl_context *context, const sl_compare_eye *comparison);
sl_status sl_compare_eye_write_csv(sl_context *context, const sl_compare_eye *comparison,
                                   const char *path);
/// Accuracy against time; .png, .svg or .pdf by the ending of the path.
sl_status sl_compare_eye_draw(sl_context *context, const sl_compare_eye *comparison, bool dark,
                              const char *path);
/// For --help: what the columns of the CSV are.
void sl_compare_eye_print_columns(void);

#endif

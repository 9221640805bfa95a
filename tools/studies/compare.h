/// Compares methods on one map: those of cell-to-cell visibility, or those that cull for an eye.
#ifndef COMPARE_H
#define COMPARE_H

#include "reports/json_print.h"
#include "sightline/cell_to_cell.h"
#include "sightline/space.h"
#include "sightline/view.h"
#include "system/console.h"

typedef enum run_outcome {
    RUN_REFUSED,  ///< the map calls for what the method does not know
    RUN_NOT_DONE, ///< it took longer than it was given
    RUN_DONE,
} run_outcome;

/// One method, with a solver if it needs one. The lower part is zero unless the run is done.
typedef struct compare_run {
    const sl_see_method *method;
    const sl_solver *solver; ///< NULL for none
    sl_guarantee guarantee;
    run_outcome outcome;
    char refusal[1024]; ///< why, where it is refused

    unsigned timings;
    double seconds;   ///< the median of the timings
    double low, high; ///< their quartiles
    sl_visibility visibility;

    bool judged; ///< against an exact answer; else these are 0:
    uint64_t too_many, too_few;
    double ratio;  ///< to the fastest exact run's seconds
    bool frontier; ///< no other run is as fast and as right, and better in one of the two
} compare_run;

#define NO_RUN SIZE_MAX

/// The number of pairs that are in `a` but not in `b`. Both are of the same cells.
uint64_t pvs_pairs_beyond(const sl_pvs *a, const sl_pvs *b);

/// The first exact run that is done; NO_RUN for none. All other runs are compared with it.
size_t compare_reference(const compare_run *runs, size_t count);

/// Compares the finished runs with the reference. Does nothing where there is no reference.
void compare_judge(compare_run *runs, size_t count);

/// Sorts the numbers of the runs: finished runs first, the fastest at the front. Ties keep their
/// order.
void compare_order(const compare_run *runs, size_t count, size_t *order);

typedef struct run_timing {
    unsigned repeat; ///< how often; 0 for as often as the time needs to be known well
    double limit;    ///< seconds that one run may take
} run_timing;

/// Runs a method until its time is known well, and fills in outcome, times and visibility. A run
/// that reaches the time limit is no failure, nor is one that the method refuses. `label` leads the
/// progress line.
sl_status compare_time(command_console *console, const sl_space *space,
                       const sl_see_options *options, const run_timing *timing, const char *label,
                       compare_run *run);

enum { SUBDIVISIONS_MOST = 8 };

typedef struct compare_subdivision {
    const sl_subdivision *subdivision;
    uint32_t cells, portals;
    double subdivide_seconds;
    bool done;      ///< the run; else these are 0:
    double seconds; ///< the median of its timings
    uint64_t pairs;
} compare_subdivision;

typedef struct compare_subdivisions {
    compare_subdivision items[SUBDIVISIONS_MOST];
    size_t count; ///< 0 where only one can be
    const sl_see_method *method;
    const sl_solver *solver; ///< NULL for none
} compare_subdivisions;

/// Subdivides a clean axial map by the kd-tree and as a mesh, and times `like` on both.
sl_status compare_subdivisions_time(command_console *console, const sl_map *map,
                                    const sl_see_options *options, const run_timing *timing,
                                    const compare_run *like, compare_subdivisions *out);

void compare_subdivisions_print(const compare_subdivisions *all);
/// A list "subdivisions".
void compare_subdivisions_add_json(json_fields *fields, const compare_subdivisions *all);

typedef struct compare_result {
    const char *input; ///< the map's file
    const sl_space *space;
    sl_sight sight;
    compare_run *runs;
    size_t run_count;
    const size_t *order; ///< of the runs: see compare_order
    size_t reference;    ///< see compare_reference
    double limit;        ///< seconds that a run was given
    compare_subdivisions subdivisions;
} compare_result;

enum { RUN_NAME = 64 };

/// "dfs with funnel"
void run_name(const compare_run *run, char name[RUN_NAME]);

/// Whether no run that is judged has pairs too many or too few.
bool compare_all_agree(const compare_result *comparison);

void compare_print(const compare_result *comparison);
sl_status compare_print_json(sl_context *context, const compare_result *comparison);

/// A line a run.
sl_status compare_write_csv(sl_context *context, const compare_result *comparison,
                            const char *path);
/// For --help: what its columns are.
void compare_print_columns(void);

/// A line for each ordered pair of cells on which two runs disagree.
sl_status compare_write_pairs(sl_context *context, const compare_result *comparison,
                              const char *path);

/// Accuracy against time; .png, .svg or .pdf by the ending of the path.
sl_status compare_draw(sl_context *context, const compare_result *comparison, bool dark,
                       const char *path);

enum { FOVS_MOST = 8 };

/// What is asked for.
typedef struct compare_eye_plan {
    uint64_t viewpoints, seed;
    double fovs[FOVS_MOST]; ///< widths of view cones in degrees
    size_t fov_count;
} compare_eye_plan;

compare_eye_plan compare_eye_plan_default(void);
/// Reads view cones, degrees with commas between: "360,60".
sl_status compare_eye_read_fovs(sl_context *context, const char *text, compare_eye_plan *plan);

/// One method with one view cone: means over all viewpoints, except for the time.
typedef struct compare_eye_row {
    const char *name; ///< of the method, as in the library's table
    sl_guarantee guarantee;
    double fov;
    double share; ///< of the map's area that is kept
    double cells; ///< that are kept; NAN for the visible region, which is not made of cells
    double nodes, orientations; ///< see sl_eye_account
    double seconds;             ///< a query: the median over batches of some
} compare_eye_row;

typedef struct eye_comparison {
    const char *input;
    const sl_space *space;
    sl_sight sight;
    const compare_eye_plan *plan;
    double pvs_seconds;    ///< that the visible sets took
    compare_eye_row *rows; ///< cone by cone, the loosest method first
    size_t row_count;
} eye_comparison;

/// Viewpoints are spread evenly over the area of the inside cells, with random headings. Shares are
/// of that area. `out` refers to the plan and the space. The caller frees out->rows (sl_free).
sl_status compare_eye_run(command_console *console, const compare_eye_plan *plan, const sl_map *map,
                          const sl_space *space, sl_sight sight, eye_comparison *out);

void compare_eye_print(const eye_comparison *comparison);
sl_status compare_eye_print_json(sl_context *context, const eye_comparison *comparison);
sl_status compare_eye_write_csv(sl_context *context, const eye_comparison *comparison,
                                const char *path);
/// Accuracy against time; .png, .svg or .pdf by the ending of the path.
sl_status compare_eye_draw(sl_context *context, const eye_comparison *comparison, bool dark,
                           const char *path);
/// For --help: what the columns of the CSV are.
void compare_eye_print_columns(void);

#endif

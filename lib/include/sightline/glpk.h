/// Stabbing and set cover by GLPK's linear programs. In a library of its own, sightline_glpk, since
/// GLPK is under the GPL, version 3.
#ifndef SIGHTLINE_GLPK_H
#define SIGHTLINE_GLPK_H

#include "sightline/stab.h"

#ifdef __cplusplus
extern "C" {
#endif

/// "glpk": the teaching reference. A linear program in doubles that maximises the line's margin to
/// the portals' ends, warm started from push to push. SL_ROUNDED: a margin within 1e-9 of the
/// bounds' size either way is SL_GRAZING.
SL_API const sl_solver *sl_glpk_simplex(void);

/// "glpk-exact": the same program in rational arithmetic. GLPK rounds coefficients that are not
/// integers, so it is given integers: coordinates as multiples of a power of two, from the
/// sequence's first end. SL_EXACT; a sequence that needs integers beyond 2^51 is refused with
/// SL_UNSUPPORTED.
SL_API const sl_solver *sl_glpk_exact(void);

/// "hybrid": the program in doubles, its answer confirmed by exact predicates: a line by the line
/// itself, a hidden sequence by the few portals that the program says are in each other's way. What
/// cannot be confirmed is decided by the funnel. SL_EXACT for all finite coordinates.
SL_API const sl_solver *sl_glpk_hybrid(void);

/// Set cover's linear and integer programs: dual simplex in doubles, and branch and bound with
/// cuts. A guide for sl_cover_solve() (sightline/set_cover.h), which proves its bounds by itself.
SL_API const struct sl_cover_program *sl_cover_glpk(void);

// --- the program itself, to be shown

/// The columns: the line is ux y - uy x + c, positive to its left; d is its margin.
enum { SL_PROGRAM_UX, SL_PROGRAM_UY, SL_PROGRAM_C, SL_PROGRAM_D, SL_PROGRAM_COLUMNS };

/// The row that fixes the length of u has no portal.
#define SL_PROGRAM_FIXED UINT32_MAX

/// A row, as GLPK has it. A left end's is at least 0, a right end's at most 0, the first row is 1.
typedef struct sl_program_row {
    uint32_t portal; ///< SL_PROGRAM_FIXED: the first row
    bool left;
    double coefficients[SL_PROGRAM_COLUMNS];
    double value; ///< at the optimum
    double price; ///< what the margin gains when the bound gives way by 1: its dual value
    bool basic;   ///< the row is in the basis: the bound does not hold the optimum back
} sl_program_row;

/// The linear program of a sequence and its optimum in doubles. Coordinates count from the middle
/// of the portal ends, in a unit that is a power of two. Zeroed, it is empty.
typedef struct sl_program {
    sl_point origin;
    double unit; ///< in units of the map
    uint32_t row_count;
    sl_program_row *rows;              ///< the first row, then left and right end of each portal
    bool solved;                       ///< GLPK found an optimum; else the rest is 0
    double values[SL_PROGRAM_COLUMNS]; ///< of the columns
    bool basic[SL_PROGRAM_COLUMNS];
    double objective; ///< the value of d
    double margin;    ///< d for a u of length 1, in units of the map
} sl_program;

/// Sets up the program of "glpk" for a sequence and solves it. SL_ROUNDED.
SL_API sl_status sl_program_make(sl_context *context, const sl_portal_ends *portals, uint32_t count,
                                 sl_program *out);
SL_API void sl_program_destroy(sl_context *context, sl_program *program); ///< and zeroes it

#ifdef __cplusplus
}
#endif

#endif

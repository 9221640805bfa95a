/// Stabbing: is there a sightline through a sequence of portals?
///
/// A sightline is a directed line S with S·L >= 0 for every left end and S·R <= 0 for every right
/// end of the portals, crossed in order; S·P is positive to the left of the line. Sequences whose
/// portals no single direction crosses all strictly forwards have none (the searches never ask).
#ifndef SIGHTLINE_STAB_H
#define SIGHTLINE_STAB_H

#include "sightline/context.h"
#include "sightline/geometry.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Which lines count. Closed sight takes lines that only touch portal ends; open sight asks for
/// lines that pass strictly between them.
typedef enum sl_sight { SL_CLOSED, SL_OPEN } sl_sight;

/// What a method promises of its answer.
typedef enum sl_guarantee {
    SL_EXACT,        ///< right, always
    SL_CONSERVATIVE, ///< never misses
    SL_AGGRESSIVE,   ///< never adds
    SL_ROUNDED,      ///< may err either way, by rounding; its answers near zero are marked
} sl_guarantee;

SL_API const char *sl_guarantee_name(sl_guarantee guarantee);

typedef enum sl_stab_verdict {
    SL_HIDDEN,  ///< no line
    SL_GRAZING, ///< lines that touch ends only (rounded solvers: within the tolerance of that)
    SL_STABBED, ///< a line passes strictly between the ends of every portal
} sl_stab_verdict;

/// A directed line through two different points, from `a` towards `b`.
typedef struct sl_line {
    sl_point a, b;
} sl_line;

/// A portal's ends as a sequence crosses it; two different points.
typedef struct sl_portal_ends {
    sl_point left, right;
} sl_portal_ends;

/// A solver holds a sequence of portals, pushed and popped at its end, and answers after each push.
/// Made and destroyed in the same thread; several may live at once.
typedef struct sl_solver {
    const char *name, *what;
    sl_guarantee guarantee;
    /// `bounds`: a box around every portal that will come.
    sl_status (*create)(sl_context *context, sl_box bounds, void **state);
    void (*destroy)(sl_context *context, void *state);
    /// Appends a portal. After SL_HIDDEN (and after a failure) it must be popped before the next
    /// push.
    sl_status (*push)(sl_context *context, void *state, sl_point left, sl_point right,
                      sl_stab_verdict *verdict);
    void (*pop)(void *state);
    /// The line found for the sequence as it stands, which must not be SL_HIDDEN or empty.
    sl_line (*witness)(const void *state);
    /// Frees what the solver's library keeps for the calling thread, once no solver lives in it;
    /// NULL for nothing. For threads that end.
    void (*leave_thread)(void);
} sl_solver;

#ifdef __cplusplus
}
#endif

#endif

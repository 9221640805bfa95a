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

/// A guarantee in words: "exact".
SL_API const char *sl_guarantee_name(sl_guarantee guarantee);

/// What a solver says of a portal sequence.
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

/// An end of a portal of the sequence, the first pushed being portal 0.
typedef struct sl_stab_end {
    uint32_t portal;
    bool left;
} sl_stab_end;

/// The most ends that a conflict can have. Four always do where no strict line is asked away
/// (Radon: two left and two right ends whose segments meet, or one within the triangle of three of
/// the other side); that not even a grazing line is left can take one or two more, where ends of
/// both sides coincide or lie on common lines.
#define SL_CONFLICT_MOST 6

/// What a solver has done since it was made.
typedef struct sl_stab_account {
    uint64_t orientations; ///< orientation tests
    uint64_t exact;        ///< of them those that the filter left to exact arithmetic
    uint64_t certified;    ///< verdicts of a rounded solver that predicates confirmed
    uint64_t fallbacks;    ///< verdicts that an exact solver had to give instead
} sl_stab_account;

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
    /// The verdict on lines of the sequence as it stands (not SL_HIDDEN, not empty) whose direction
    /// lies from that of `right` counter-clockwise to that of `left`, both included: less than half
    /// a turn, of which what lies between crosses every portal forwards. Leaves the sequence as it
    /// is. NULL where the solver cannot tell.
    sl_status (*toward)(sl_context *context, void *state, sl_line right, sl_line left,
                        sl_stab_verdict *verdict);
    /// The line found for the sequence as it stands, which must not be SL_HIDDEN or empty.
    sl_line (*witness)(const void *state);
    /// The ends that alone prove the last push's verdict: after SL_HIDDEN no line keeps them on
    /// their sides, after SL_GRAZING none strictly. None can be spared. Not to be asked after
    /// SL_STABBED. NULL where the solver cannot tell.
    sl_status (*conflict)(sl_context *context, const void *state,
                          sl_stab_end ends[SL_CONFLICT_MOST], uint32_t *count);
    /// Adds what the solver has done; NULL for nothing to tell.
    void (*account)(const void *state, sl_stab_account *sum);
    /// Frees what the solver's library keeps for the calling thread, once no solver lives in it;
    /// NULL for nothing. For threads that end.
    void (*leave_thread)(void);
} sl_solver;

/// The core library's own solver (those that need GLPK are in glpk.h), "funnel": the incremental
/// exact solver. SL_EXACT for all finite coordinates, whatever their size. Its witness passes
/// strictly between the ends where doubles can express such a line, and else goes through two ends.
SL_API const sl_solver *sl_funnel(void);

#ifdef __cplusplus
}
#endif

#endif

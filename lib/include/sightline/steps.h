/// The depth-first search of one source cell, step by step: for lessons and for pictures.
#ifndef SIGHTLINE_STEPS_H
#define SIGHTLINE_STEPS_H

#include "sightline/space.h"
#include "sightline/stab.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What a step of the search is.
typedef enum sl_step_kind {
    SL_STEP_ENTER,     ///< the sequence has a sightline: the cell behind it is entered
    SL_STEP_BACKWARDS, ///< no one direction crosses all portals forwards: passed over
    SL_STEP_HIDDEN,    ///< with the directed portal the sequence has no sightline: passed over
    SL_STEP_LEAVE,     ///< all directed portals of the cell are tried: back to the cell before
} sl_step_kind;

/// A step. Step 0 enters the source cell, without a directed portal.
typedef struct sl_step {
    sl_step_kind kind;
    uint32_t
        directed;  ///< tried; of a cell left, that by which it was entered; UINT32_MAX: the source
    uint32_t cell; ///< behind the directed portal; the one left
    uint32_t parent; ///< the step that entered the cell searched (or left); of step 0 itself
    uint32_t depth;  ///< portals of the sequence, the directed portal tried included
    uint32_t node;   ///< nodes that the stab tree has after the step
    uint32_t seen;   ///< cells that are known to be seen after the step
    bool first;      ///< ENTER: the cell was not known to be seen before
    bool grazing;    ///< ENTER, HIDDEN: the last verdict was SL_GRAZING
} sl_step;

/// Start from sl_steps_options_default().
typedef struct sl_steps_options {
    sl_sight sight;
    const sl_solver *solver; ///< exact; usually sl_funnel()
    bool inside_only;        ///< at inside cells only
    size_t most;             ///< steps after which to stop; usually 200 000
} sl_steps_options;

/// The usual options, as told at each field.
SL_API sl_steps_options sl_steps_options_default(void);

/// Zeroed, it is empty.
typedef struct sl_steps {
    sl_step *steps;
    size_t count;
    bool complete; ///< false: `most` ended it
} sl_steps;

/// Records the search that the method "dfs" makes from one cell (Teller & Séquin 1991, Cell to Cell
/// Visibility), directed portal by directed portal in the same order. Exact with an exact solver.
/// SL_BAD_ARGUMENT where the cell is none of the space, or without a solver.
SL_API sl_status sl_steps_record(sl_context *context, const sl_space *space,
                                 const sl_steps_options *options, uint32_t source, sl_steps *out);
SL_API void sl_steps_destroy(sl_context *context, sl_steps *steps); ///< and zeroes it

/// The portal sequence that a step is about, the directed portal tried last. Writes up to `room`
/// directed portals and returns how many there are: the step's depth.
SL_API uint32_t sl_steps_sequence(const sl_steps *steps, size_t step, uint32_t *directed,
                                  uint32_t room);

#ifdef __cplusplus
}
#endif

#endif

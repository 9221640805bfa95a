/// GLPK ends the process where it runs out of memory or meets an error of its own; its hook lets us
/// leave instead:
///
///     if (setjmp(guard.left)) return sli_glpk_failed(context);
///     sli_glpk_enter(&guard);
///     ... calls of GLPK ...
///     sli_glpk_leave();
///
/// After a failure all that GLPK holds for the thread is gone, every problem included.
#ifndef SL_GLPK_SHARED_H
#define SL_GLPK_SHARED_H

#include "sightline/glpk.h"
#include "sightline/support.h"

#include <glpk.h>
#include <setjmp.h>
#include <stddef.h>

// --- leaving GLPK on errors

typedef struct sli_glpk_guard {
    jmp_buf left;
} sli_glpk_guard;

static inline void sli_glpk_jump(void *guard) {
    longjmp(((sli_glpk_guard *)guard)->left, 1);
}

static inline void sli_glpk_enter(sli_glpk_guard *guard) {
    glp_error_hook(sli_glpk_jump, guard);
}

static inline void sli_glpk_leave(void) {
    glp_error_hook(NULL, NULL);
}

static inline sl_status sli_glpk_failed(sl_context *context) {
    glp_error_hook(NULL, NULL);
    glp_free_env();
    return sl_fail(context, SL_NO_MEMORY, "GLPK gave up: out of memory, or an error of its own");
}

/// Makes GLPK ready in this thread, and silent. First of all calls, since at its very start there
/// is no hook yet.
static inline sl_status sli_glpk_start(sl_context *context) {
    if (glp_init_env() > 1) return sl_fail(context, SL_NO_MEMORY, "GLPK finds no memory to start");
    glp_term_out(GLP_OFF);
    return SL_OK;
}

// --- confirming its answers

/// Portals of the sequence that the last answer rests on, ascending, each once: those with an end
/// that the line found is tight to, and the two that bound its direction. At most 6 are told.
enum { SLI_GLPK_TIGHT_MOST = 6 };
size_t sli_glpk_tight_portals(const void *simplex, uint32_t portals[SLI_GLPK_TIGHT_MOST]);

#endif

/// A build without sightline_glpk: the pane of the linear program says so, and cameras are placed
/// without a linear program.
#include "sightline/glpk.h"
#include "sightline/support.h"

sl_status sl_program_make(sl_context *context, const sl_portal_ends *portals, uint32_t count,
                          sl_program *out) {
    (void)portals, (void)count, (void)out;
    return sl_fail(context, SL_UNSUPPORTED,
                   "The linear program needs GLPK. This viewer was built without it "
                   "(-DSIGHTLINE_GLPK=ON).");
}

const struct sl_cover_program *sl_cover_glpk(void) {
    return NULL;
}

void sl_program_destroy(sl_context *context, sl_program *program) {
    sl_free(context, program->rows);
    *program = (sl_program){0};
}

// The solver that needs GLPK: one gap has a line through it.
#include <sightline/glpk.h>

#include <stdio.h>

int main(void) {
    sl_context *context = sl_context_create(NULL);
    if (!context) return 1;
    const sl_solver *solver = sl_glpk_simplex();
    sl_box bounds = {{0, 0}, {10, 10}};
    void *state = NULL;
    sl_stab_verdict verdict = SL_HIDDEN;
    sl_status status = solver->create(context, bounds, &state);
    if (status == SL_OK) {
        sl_point left = {5, 6}, right = {5, 4};
        status = solver->push(context, state, left, right, &verdict);
        solver->destroy(context, state);
        if (solver->leave_thread) solver->leave_thread();
    }
    printf("%s: %s, verdict %d\n", solver->name, sl_status_name(status), (int)verdict);
    sl_context_destroy(context);
    return status == SL_OK && verdict == SL_STABBED ? 0 : 1;
}

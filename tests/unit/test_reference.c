// The exact solvers against the rational reference on real maps: every map of maps/, and the fifth
// floor of Soda Hall where its model lies beside the project.
#include "map_files.h"

#include "oracle/oracle.h"
#include "solver_table.h"

/// Portals that the reference may push for one map.
enum { PUSH_LIMIT = 10000000 };

/// Under a sanitizer GLPK's rational simplex, which takes most of the time, is asked of small maps
/// alone.
static bool has_patience(const sl_solver *solver, const char *path, const sl_space *space) {
#ifdef SIGHTLINE_SANITIZED
    if (solver_patience(solver) < SIZE_MAX && space->portal_count > 50) {
        print_message("not by %s, as a sanitizer is on: %s\n", solver->name, path);
        return false;
    }
#endif
    (void)solver, (void)path, (void)space;
    return true;
}

static void check_solver(sl_context *context, const char *path, const sl_space *space,
                         const sl_solver *solver, sl_sight sight, const bool *sees) {
    size_t methods;
    sl_visibility visibility;
    sl_see_options options = sl_see_options_default();
    options.solver = solver;
    options.sight = sight;
    const sl_status status = sl_see_methods(&methods)->see(context, space, &options, &visibility);
    if (status == SL_UNSUPPORTED && solver != sl_funnel()) {
        print_message("refused: %s\n", sl_context_message(context));
        return;
    }
    assert_ok(context, status);
    for (uint32_t a = 0; a < space->cell_count; a++)
        for (uint32_t b = 0; b < space->cell_count; b++)
            if (sl_pvs_sees(&visibility.pvs, a, b) != sees[(size_t)a * space->cell_count + b])
                fail_msg("%s, %s, %s sight: cells %u and %u", path, solver->name,
                         sight == SL_CLOSED ? "closed" : "open", a, b);
    sl_visibility_destroy(context, &visibility);
}

static void check_map(const char *path) {
    sl_context *context = testing_context(NULL);
    sl_map map = {0};
    sl_space space;
    map_files_cut(context, path, &map, &space);
    const size_t pairs = (size_t)space.cell_count * space.cell_count;
    bool *closed = calloc(pairs, sizeof *closed), *open = calloc(pairs, sizeof *open);
    assert_true(closed && open);
    assert_true(oracle_by_sequences(&space, PUSH_LIMIT, closed, open));
    for (size_t i = 0; solver_at(i); i++) {
        if (solver_at(i)->guarantee != SL_EXACT || !has_patience(solver_at(i), path, &space))
            continue;
        check_solver(context, path, &space, solver_at(i), SL_CLOSED, closed);
        check_solver(context, path, &space, solver_at(i), SL_OPEN, open);
    }
    free(closed);
    free(open);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
}

static void own_maps_are_seen_as_the_reference_sees_them(void **state) {
    (void)state;
    map_files_each(MAP_FILES_OWN, check_map);
}

static void soda_hall_is_seen_as_the_reference_sees_it(void **state) {
    (void)state;
    map_files_each(MAP_FILES_SODA_HALL, check_map);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(own_maps_are_seen_as_the_reference_sees_them),
        cmocka_unit_test(soda_hall_is_seen_as_the_reference_sees_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

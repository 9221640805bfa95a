// Each stage of a bake asks again and again whether to go on, ends when it is told to stop, and
// leaves its result alone.
#include "space/outline.h"
#include "testing.h"

#include "sightline/bake.h"
#include "sightline/faults.h"
#include "sightline/generate.h"
#include "sightline/space.h"
#include "sightline/support.h"
#include "sightline/view_cells.h"

#include <limits.h>
#include <stdatomic.h>

enum { WALLS = 20000, WALLS_A_QUESTION = 8192 };

/// Stops at a question; counts those after it as well.
typedef struct patience {
    atomic_ulong asked;
    unsigned long most;
} patience;

static bool is_over(void *user) {
    patience *p = user;
    return atomic_fetch_add(&p->asked, 1) >= p->most;
}

/// What the stages work on, and what they make.
typedef struct work {
    sl_map map, clean;
    sl_space space;
    sl_outline outline;
    sl_view_places places;
    sl_view_segments segments;
    sl_view_sampling sampling;
    sl_view_tree tree;
    sl_view_sets sets;
    sl_view_hierarchy merged;
} work;

static sl_view_scene scene_of(const work *w) {
    return (sl_view_scene){&w->space, w->sampling.objects, sl_render_cost_default(), &w->places};
}

static sl_status clean(sl_context *context, work *w) {
    sl_map copy = {0};
    SL_TRY(sl_map_copy(context, &w->map, &copy));
    const sl_status status = sl_map_clean(context, &copy, NULL, NULL);
    if (status == SL_OK) {
        sl_map_destroy(context, &w->clean);
        w->clean = copy;
        return SL_OK;
    }
    assert_int_equal(copy.wall_count, w->map.wall_count);
    sl_map_destroy(context, &copy);
    return status;
}

static sl_status subdivide(sl_context *context, work *w) {
    sl_space made = {0};
    const sl_status status =
        sl_subdivision_for(&w->clean)->subdivide(context, &w->clean, NULL, &made);
    assert_true((status == SL_OK) == (made.cell_count > 0));
    if (status != SL_OK) return status;
    sl_space_destroy(context, &w->space);
    w->space = made;
    return SL_OK;
}

static sl_status check(sl_context *context, work *w) {
    return sl_space_check(context, &w->space);
}

static sl_status outline(sl_context *context, work *w) {
    sl_outline made = {0};
    const sl_status status = sli_outline_make(context, &w->space, &made);
    assert_true((status == SL_OK) == (made.room_count > 0));
    if (status != SL_OK) return status;
    sli_outline_destroy(context, &w->outline);
    w->outline = made;
    return SL_OK;
}

static sl_status see(sl_context *context, work *w) {
    sl_see_options options = sl_see_options_default();
    sl_visibility made = {0};
    options.threads = 1;
    const sl_status status =
        sl_see_method_for(&w->clean, &options)->see(context, &w->space, &options, &made);
    assert_true((status == SL_OK) == (made.pvs.cell_count > 0));
    sl_visibility_destroy(context, &made);
    return status;
}

static sl_status find_faults(sl_context *context, work *w) {
    const sl_faults_options options = {0};
    sl_faults made = {0};
    const sl_status status = sl_find_faults(context, &w->map, &w->space, &options, &made);
    sl_faults_destroy(context, &made);
    return status;
}

static sl_status sample(sl_context *context, work *w) {
    sl_view_segments made = {0};
    SL_TRY(sl_view_sample(context, &w->outline, &w->sampling, &made));
    sl_view_segments_destroy(context, &w->segments);
    w->segments = made;
    return SL_OK;
}

static sl_status divide(sl_context *context, work *w) {
    size_t count, i = 0;
    const sl_view_method *methods = sl_view_methods(&count);
    while (!methods[i].merges) i++;
    sl_view_subdivision options = sl_view_subdivision_default();
    options.cells = 40;
    options.candidates = 64;
    const sl_view_scene scene = scene_of(w);
    sl_view_tree made = {0};
    SL_TRY(methods[i].divide(context, &scene, &w->segments, &options, &made, NULL));
    sl_view_tree_destroy(context, &w->tree);
    w->tree = made;
    sl_view_sets_destroy(context, &w->sets);
    return sl_view_sets_sample(context, &scene, &w->tree, &w->segments, 1, &w->sets);
}

static sl_status merge(sl_context *context, work *w) {
    const sl_view_scene scene = scene_of(w);
    sl_view_hierarchy made = {0};
    SL_TRY(sl_view_hierarchy_make(context, &scene, &w->tree, &w->sets, true, &made));
    sl_view_hierarchy_destroy(context, &w->merged);
    w->merged = made;
    return SL_OK;
}

/// The stages in order; `questions`: at least so many, for those whose work does not follow the
/// number of walls.
static const struct stage {
    const char *name;
    sl_status (*run)(sl_context *context, work *w);
    unsigned long questions;
} stages[] = {
    {"clean", clean, 0},
    {"subdivide", subdivide, 0},
    {"check", check, 0},
    {"outline", outline, 0},
    {"see", see, 0},
    {"find faults", find_faults, 0},
    {"sample", sample, 0},
    {"divide view cells", divide, 300},
    {"merge view cells", merge, 2},
};

static void run_stage(sl_context *context, patience *p, const struct stage *stage, work *w) {
    const unsigned long least =
        stage->questions ? stage->questions : w->map.wall_count / WALLS_A_QUESTION;
    p->asked = 0;
    p->most = ULONG_MAX;
    assert_int_equal(stage->run(context, w), SL_OK);
    const unsigned long asked = p->asked;
    if (asked < least) fail_msg("%s asks %lu times, not %lu", stage->name, asked, least);
    const unsigned long at[] = {0, 1, asked / 4, asked / 2, asked - 1};
    for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
        p->asked = 0;
        p->most = at[i];
        if (stage->run(context, w) != SL_CANCELLED)
            fail_msg("%s goes on after question %lu of %lu", stage->name, at[i], asked);
        if (p->asked > at[i] + 2) fail_msg("%s asks again after it was told to stop", stage->name);
    }
    // What was made before is whole.
    p->most = ULONG_MAX;
    p->asked = 0;
    assert_int_equal(stage->run(context, w), SL_OK);
    assert_int_equal(p->asked, asked);
}

static void run_all(double turned) {
    patience p = {.most = ULONG_MAX};
    const sl_hooks hooks = {.user = &p, .cancelled = is_over};
    sl_context *context = sl_context_create(&hooks);
    work w = {.sampling = sl_view_sampling_default()};
    w.sampling.samples = 5000;
    w.sampling.threads = 1;
    sl_generate_options options = sl_generate_options_default();
    options.walls = WALLS;
    options.turned = turned;
    size_t count, kind = 0;
    const sl_map_kind *kinds = sl_map_kinds(&count);
    while (strcmp(kinds[kind].name, "city") != 0) kind++;
    assert_int_equal(sl_generate(context, &kinds[kind], &options, &w.map), SL_OK);
    for (size_t i = 0; i < sizeof stages / sizeof *stages; i++) {
        if (strcmp(stages[i].name, "sample") == 0)
            assert_int_equal(sl_view_places_inside(context, &w.space, &w.places), SL_OK);
        run_stage(context, &p, &stages[i], &w);
        // The outline is that of the space as it is now.
        if (stages[i].run == subdivide) sli_outline_destroy(context, &w.outline);
    }
    sl_view_hierarchy_destroy(context, &w.merged);
    sl_view_sets_destroy(context, &w.sets);
    sl_view_tree_destroy(context, &w.tree);
    sl_view_segments_destroy(context, &w.segments);
    sl_view_places_destroy(context, &w.places);
    sli_outline_destroy(context, &w.outline);
    sl_space_destroy(context, &w.space);
    sl_map_destroy(context, &w.clean);
    sl_map_destroy(context, &w.map);
    sl_context_destroy(context);
}

static void test_axial(void **state) {
    (void)state;
    run_all(0);
}

static void test_oblique(void **state) {
    (void)state;
    run_all(30);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_axial),
                                       cmocka_unit_test(test_oblique)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

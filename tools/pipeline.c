#include "pipeline.h"

#include "inputs.h"
#include "report.h"
#include "sightline/support.h"
#include "solvers.h"

#include <string.h>

static sl_name_table subdivision_names(void) {
    sl_name_table names = {.kind = "subdivision", .stride = sizeof(sl_subdivision)};
    names.items = sl_subdivisions(&names.count);
    return names;
}

static const char *const kd_rules[] = {"spanning", "obscured", "cleaving", "median"};
enum { SPANNING = 1, OBSCURED = 2, CLEAVING = 4, MEDIAN = 8, ALL_RULES = 15 };
static const sl_name_table kd_rule_names = {"rule", kd_rules, sizeof *kd_rules, 4};

static sl_status plan_subdivision(sl_context *context, const sl_pipeline_texts *texts,
                                  sl_pipeline *plan) {
    const sl_name_table names = subdivision_names();
    size_t subdivide = 0; // which takes rules
    unsigned rules = ALL_RULES;
    SL_TRY(sl_option_choice(context, "--subdivide", texts->subdivide, &names, &subdivide));
    SL_TRY(sl_option_choices(context, "--kd-rules", texts->kd_rules, &kd_rule_names, &rules));
    sl_subdivide_options *options = &plan->options;
    *options = sl_subdivide_options_default();
    SL_TRY(sl_option_number(context, "--kd-obscured", texts->kd_obscured, &options->obscured));
    if (options->obscured < 0 || options->obscured > 1)
        return sl_fail(context, SL_BAD_ARGUMENT, "--kd-obscured %s: a share from 0 to 1 is needed",
                       texts->kd_obscured);
    if (texts->kd_obscured && !(rules & OBSCURED))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--kd-obscured needs the rule 'obscured', which --kd-rules leaves out");
    if (texts->kd_rules) {
        options->spanning = rules & SPANNING;
        if (!(rules & OBSCURED)) options->obscured = 0;
        options->cleaving = rules & CLEAVING;
        options->median = rules & MEDIAN;
    }
    const bool kd_wanted = texts->kd_rules || texts->kd_obscured;
    const sl_subdivision *chosen = (const sl_subdivision *)names.items + subdivide;
    if (!chosen->takes_rules && kd_wanted)
        return sl_fail(context, SL_BAD_ARGUMENT, "%s is for --subdivide kd, not %s",
                       texts->kd_rules ? "--kd-rules" : "--kd-obscured", texts->subdivide);
    if (texts->subdivide || kd_wanted) plan->subdivision = chosen;
    plan->texts.cells = texts->subdivide && chosen->takes_cells;
    return SL_OK;
}

sl_status sl_pipeline_plan(sl_context *context, const char *input, const sl_pipeline_texts *texts,
                           sl_pipeline *out) {
    sl_pipeline plan = {.input = input, .texts = texts->input, .start = texts->start};
    sl_effect_names list;
    const sl_name_table effects = sl_effect_table(&list);
    SL_TRY(sl_option_choices(context, "--without", texts->without, &effects, &plan.without));
    SL_TRY(plan_subdivision(context, texts, &plan));
#ifdef NDEBUG
    plan.check = texts->check;
#else
    plan.check = true;
#endif
    *out = plan;
    return SL_OK;
}

static sl_status add_start(sl_context *context, const sl_pipeline *pipeline, sl_map *map) {
    if (!pipeline->start) return SL_OK;
    sl_point at = {0};
    SL_TRY(sl_option_point(context, "--start", pipeline->start, &at));
    const sl_box b = sl_map_bounds(map);
    if (at.x < b.min.x || at.x > b.max.x || at.y < b.min.y || at.y > b.max.y)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--start %s: outside the map; sightline info %s tells its bounds",
                       pipeline->start, pipeline->input);
    return sl_map_add_start(context, map, at, 0, 0);
}

sl_status sl_pipeline_read(sl_context *context, const sl_pipeline *pipeline, sl_map *map) {
    SL_TRY(sl_input_read_map(context, pipeline->input, &pipeline->texts, map));
    if (pipeline->subdivision && !pipeline->subdivision->takes_cells)
        sl_map_drop_cells(context, map);
    SL_TRY(add_start(context, pipeline, map));
    sl_effects_leave_out(context, map, pipeline->without);
    return SL_OK;
}

sl_status sl_pipeline_read_clean(sl_context *context, const sl_pipeline *pipeline, sl_map *map,
                                 sl_clean_account *account) {
    SL_TRY(sl_pipeline_read(context, pipeline, map));
    return sl_input_clean(context, &pipeline->texts, map, account);
}

const sl_subdivision *sl_pipeline_subdivision(const sl_pipeline *pipeline, const sl_map *map) {
    return pipeline->subdivision ? pipeline->subdivision : sl_subdivision_for(map);
}

sl_status sl_pipeline_subdivide(sl_context *context, const sl_pipeline *pipeline, const sl_map *map,
                                sl_space *space) {
    const sl_subdivision *subdivision = sl_pipeline_subdivision(pipeline, map);
    return subdivision->subdivide(context, map, &pipeline->options, space);
}

bool sl_pipeline_checks(const sl_pipeline *pipeline, const sl_space *space) {
    return pipeline->check || space->neighbour;
}

sl_status sl_pipeline_check(sl_context *context, const sl_pipeline *pipeline,
                            const sl_space *space) {
    return sl_pipeline_checks(pipeline, space) ? sl_space_check(context, space) : SL_OK;
}

sl_name_table sl_pipeline_solver_names(sl_solver solvers[SL_SOLVERS_MOST]) {
    sl_name_table names = {"solver", solvers, sizeof *solvers, 0};
    while (names.count < SL_SOLVERS_MOST && sl_solver_at(names.count)) {
        solvers[names.count] = *sl_solver_at(names.count);
        names.count++;
    }
    return names;
}

void sl_pipeline_print_subdivisions(void) {
    puts("\nsubdivisions (default: given where a map text brings cells, kd where all\nwalls are "
         "axial, else mesh):");
    size_t count;
    const sl_subdivision *subdivisions = sl_subdivisions(&count);
    for (size_t i = 0; i < count; i++)
        printf("  %-12s%s\n", subdivisions[i].name, subdivisions[i].what);
    printf("              (kd's rules: spanning, obscured at a share of %g, cleaving, median)\n",
           sl_subdivide_options_default().obscured);
}

void sl_pipeline_print_effects(void) {
    sl_effect_names list;
    const sl_name_table effects = sl_effect_table(&list);
    printf("\neffects, for --without: ");
    for (size_t i = 0; i < effects.count; i++)
        printf("%s%s", i ? ", " : "", sl_name_table_at(&effects, i));
    putchar('\n');
}

void sl_pipeline_print_methods(const char *on_methods, const char *on_solvers) {
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    printf("\nmethods%s:\n", on_methods);
    for (size_t i = 0; i < count; i++)
        printf("  %-12s%s; %s\n", methods[i].name, methods[i].what,
               methods[i].stabs ? "as exact as the solver"
                                : sl_guarantee_name(methods[i].guarantee));
    printf("\nsolvers%s:\n", on_solvers);
    for (size_t i = 0; sl_solver_at(i); i++)
        printf("  %-12s%s; %s\n", sl_solver_at(i)->name, sl_solver_at(i)->what,
               sl_guarantee_name(sl_solver_at(i)->guarantee));
}

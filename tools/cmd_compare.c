#include "built.h"
#include "commands.h"
#include "compare_eye.h"
#include "compare_report.h"
#include "compare_time.h"
#include "folder.h"
#include "inputs.h"
#include "pipeline.h"
#include "sightline/support.h"
#include "solvers.h"

#include <string.h>

enum { MAX_REPEAT = 100000 };
#define MAX_LIMIT 1e9

/// The options as they are given.
typedef struct compare_texts {
    sl_pipeline_texts pipeline;
    sl_compare_eye_texts eye_texts;
    const char *output, *methods, *solvers, *sight, *repeat, *time_limit;
    bool inside, dark, json, eye;
} compare_texts;

/// The options as they are meant.
typedef struct compare_plan {
    sl_pipeline pipeline;
    const char *output;
    unsigned methods, solvers; ///< bits of both tables
    sl_timing timing;
    sl_see_options see;
    sl_compare_eye_plan eye;
    bool dark, json;
} compare_plan;

/// In the order of a reader's interest.
static const char *const file_names[] = {"compare.csv", "compare.png", "compare.svg", "pairs.csv",
                                         NULL};
static const char *const eye_file_names[] = {"eye.csv", "eye.png", "eye.svg", NULL};

/// What is worked with, from the map to the runs.
typedef struct comparing {
    const compare_plan *plan;
    sl_map map;
    sl_space space;
    SL_ARRAY(sl_compare_run) runs;
    size_t *order;
} comparing;

// --- reading the options

static sl_status plan_seeing(sl_context *context, const compare_texts *texts, compare_plan *plan) {
    size_t sight = SL_CLOSED, count;
    const sl_see_method *methods = sl_see_methods(&count);
    const sl_name_table method_names = {"method", methods, sizeof *methods, count};
    sl_solver solvers[SL_SOLVERS_MOST];
    const sl_name_table solver_names = sl_pipeline_solver_names(solvers);
    const sl_name_table sight_names = sl_sight_table();
    plan->methods = plan->solvers = ~0u;
    SL_TRY(sl_option_choices(context, "--methods", texts->methods, &method_names, &plan->methods));
    SL_TRY(sl_option_choices(context, "--solvers", texts->solvers, &solver_names, &plan->solvers));
    SL_TRY(sl_option_choice(context, "--sight", texts->sight, &sight_names, &sight));
    plan->see = sl_see_options_default();
    plan->see.sight = (sl_sight)sight;
    plan->see.threads = 1;
    plan->see.inside_only = texts->inside;
    return SL_OK;
}

static sl_status plan_timing(sl_context *context, const compare_texts *texts, sl_timing *timing) {
    uint64_t repeat = 0;
    *timing = (sl_timing){.limit = 60};
    SL_TRY(sl_option_count(context, "--repeat", texts->repeat, MAX_REPEAT, &repeat));
    timing->repeat = (unsigned)repeat;
    SL_TRY(sl_option_number(context, "--time-limit", texts->time_limit, &timing->limit));
    if (!(timing->limit > 0 && timing->limit <= MAX_LIMIT))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--time-limit %s: a number of seconds over 0 is needed", texts->time_limit);
    return SL_OK;
}

/// Of the two comparisons, each has options that the other cannot have.
static sl_status check_options_fit(sl_context *context, const compare_texts *texts) {
    const struct {
        const char *name;
        bool given, for_eye;
    } options[] = {
        {"--methods", texts->methods, false},
        {"--solvers", texts->solvers, false},
        {"--inside", texts->inside, false},
        {"--repeat", texts->repeat, false},
        {"--time-limit", texts->time_limit, false},
        {"--viewpoints", texts->eye_texts.viewpoints, true},
        {"--seed", texts->eye_texts.seed, true},
        {"--fov", texts->eye_texts.fov, true},
    };
    for (size_t i = 0; i < sizeof options / sizeof *options; i++)
        if (options[i].given && options[i].for_eye != texts->eye)
            return sl_fail(context, SL_BAD_ARGUMENT, "%s is of no use %s --eye", options[i].name,
                           texts->eye ? "with" : "without");
    return SL_OK;
}

static sl_status make_plan(sl_context *context, const char *input, const compare_texts *texts,
                           compare_plan *plan) {
    *plan = (compare_plan){.output = texts->output, .dark = texts->dark, .json = texts->json};
    SL_TRY(check_options_fit(context, texts));
    SL_TRY(sl_pipeline_plan(context, input, &texts->pipeline, &plan->pipeline));
    SL_TRY(sl_compare_eye_plan_make(context, &texts->eye_texts, &plan->eye));
    SL_TRY(plan_seeing(context, texts, plan));
    SL_TRY(plan_timing(context, texts, &plan->timing));
    if (texts->output) SL_TRY(sl_built_need_pictures(context));
    if (texts->dark && !texts->output)
        return sl_fail(context, SL_BAD_ARGUMENT, "--dark is for the chart, which needs -o");
    return SL_OK;
}

// --- the runs

static sl_status add_run(sl_context *context, comparing *all, const sl_see_method *method,
                         const sl_solver *solver) {
    SL_TRY(SL_ARRAY_ROOM(context, &all->runs, 1));
    all->runs.items[all->runs.count++] = (sl_compare_run){
        .method = method,
        .solver = solver,
        .guarantee = solver ? solver->guarantee : method->guarantee,
        .outcome = SL_RUN_NOT_DONE,
    };
    return SL_OK;
}

/// Every method, with every solver where it stabs.
static sl_status list_runs(sl_context *context, comparing *all) {
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    for (size_t m = 0; m < count; m++) {
        if (!(all->plan->methods >> m & 1)) continue;
        if (!methods[m].stabs) SL_TRY(add_run(context, all, &methods[m], NULL));
        for (size_t s = 0; methods[m].stabs && sl_solver_at(s); s++)
            if (all->plan->solvers >> s & 1)
                SL_TRY(add_run(context, all, &methods[m], sl_solver_at(s)));
    }
    return all->runs.count ? SL_OK
                           : sl_fail(context, SL_BAD_ARGUMENT,
                                     "--methods and --solvers leave nothing to compare");
}

/// Where every run refuses the map there is nothing to compare: that is a failure.
static sl_status fail_if_all_refuse(sl_context *context, const comparing *all) {
    for (size_t i = 0; i < all->runs.count; i++)
        if (all->runs.items[i].outcome != SL_RUN_REFUSED) return SL_OK;
    return sl_fail(context, SL_UNSUPPORTED, "%s", all->runs.items[0].refusal);
}

static void refuse_effects(sl_context *context, comparing *all) {
    for (size_t i = 0; i < all->runs.count; i++) {
        sl_compare_run *run = &all->runs.items[i];
        if (sl_see_check(context, run->method, run->solver, &all->map) == SL_OK) continue;
        run->outcome = SL_RUN_REFUSED;
        snprintf(run->refusal, sizeof run->refusal, "%s", sl_context_message(context));
    }
}

static sl_status time_runs(sl_console *console, comparing *all) {
    sl_see_options see = all->plan->see;
    const sl_plan effects = sl_plan_make(&all->map);
    see.plan = &effects;
    for (size_t i = 0; i < all->runs.count; i++) {
        sl_compare_run *run = &all->runs.items[i];
        if (run->outcome == SL_RUN_REFUSED) continue;
        char name[SL_RUN_NAME], label[SL_RUN_NAME + 24];
        sl_run_name(run, name);
        snprintf(label, sizeof label, "%zu/%zu %s", i + 1, all->runs.count, name);
        see.solver = run->solver;
        SL_TRY(sl_compare_time(console, &all->space, &see, &all->plan->timing, label, run));
    }
    SL_TRY(fail_if_all_refuse(console->context, all));
    sl_compare_judge(all->runs.items, all->runs.count);
    return SL_OK;
}

// --- what comes of them

typedef sl_status writer(sl_context *context, const sl_comparison *comparison, const char *path);

static sl_status draw_light(sl_context *context, const sl_comparison *comparison,
                            const char *path) {
    return sl_compare_draw(context, comparison, false, path);
}

static sl_status draw_dark(sl_context *context, const sl_comparison *comparison, const char *path) {
    return sl_compare_draw(context, comparison, true, path);
}

static sl_status write_file(sl_context *context, const sl_folder *folder, const char *name,
                            writer *write, const sl_comparison *comparison) {
    char *path = sl_folder_file(context, folder, name);
    if (!path) return SL_NO_MEMORY;
    const sl_status status = write(context, comparison, path);
    sl_free(context, path);
    return status;
}

static sl_status write_files(sl_context *context, const compare_plan *plan, const sl_folder *folder,
                             const sl_comparison *comparison) {
    writer *const draw = plan->dark ? draw_dark : draw_light;
    writer *const writers[] = {sl_compare_write_csv, draw, draw, sl_compare_write_pairs};
    for (size_t i = 0; file_names[i]; i++)
        SL_TRY(write_file(context, folder, file_names[i], writers[i], comparison));
    return SL_OK;
}

static sl_status prepare(sl_context *context, comparing *all) {
    const sl_pipeline *pipeline = &all->plan->pipeline;
    SL_TRY(list_runs(context, all));
    SL_TRY(sl_pipeline_read_clean(context, pipeline, &all->map, NULL));
    refuse_effects(context, all);
    SL_TRY(fail_if_all_refuse(context, all));
    SL_TRY(sl_pipeline_subdivide(context, pipeline, &all->map, &all->space));
    return sl_pipeline_check(context, pipeline, &all->space);
}

/// Where the map leaves the choice, what each subdivision makes of it.
static sl_status time_subdivisions(sl_console *console, const comparing *all,
                                   sl_comparison *comparison) {
    const compare_plan *plan = all->plan;
    const sl_compare_run *like = &all->runs.items[all->order[0]];
    if (plan->pipeline.subdivision || all->map.cell_count || !sl_map_is_axial(&all->map))
        return SL_OK;
    for (size_t i = 1; i < all->runs.count && like->guarantee != SL_EXACT; i++)
        like = &all->runs.items[all->order[i]];
    if (like->guarantee != SL_EXACT || like->outcome != SL_RUN_DONE) return SL_OK;
    sl_see_options see = plan->see;
    const sl_plan effects = sl_plan_make(&all->map);
    see.plan = &effects;
    return sl_compare_subdivisions_time(console, &all->map, &see, &plan->timing, like,
                                        &comparison->subdivisions);
}

/// `folder` is NULL without -o.
static sl_status compare(sl_console *console, comparing *all, const sl_folder *folder,
                         sl_comparison *out) {
    sl_context *context = console->context;
    SL_TRY(prepare(context, all));
    SL_TRY(time_runs(console, all));
    all->order = sl_alloc_array(context, all->runs.count, sizeof *all->order);
    if (!all->order) return SL_NO_MEMORY;
    sl_compare_order(all->runs.items, all->runs.count, all->order);
    *out = (sl_comparison){.input = all->plan->pipeline.input,
                           .space = &all->space,
                           .sight = all->plan->see.sight,
                           .runs = all->runs.items,
                           .run_count = all->runs.count,
                           .order = all->order,
                           .reference = sl_compare_reference(all->runs.items, all->runs.count),
                           .limit = all->plan->timing.limit};
    SL_TRY(time_subdivisions(console, all, out));
    return folder ? write_files(context, all->plan, folder, out) : SL_OK;
}

static sl_status compare_and_report(sl_console *console, const compare_plan *plan) {
    sl_context *context = console->context;
    comparing all = {.plan = plan};
    sl_comparison comparison;
    sl_folder folder;
    if (plan->output) SL_TRY(sl_folder_open(context, plan->output, file_names, &folder));
    sl_status status = compare(console, &all, plan->output ? &folder : NULL, &comparison);
    if (plan->output) status = sl_folder_close(context, &folder, status);
    sl_progress_line_clear(&console->line);
    if (status == SL_OK && plan->json)
        status = sl_compare_print_json(context, &comparison);
    else if (status == SL_OK && !(console->quiet && plan->output))
        sl_compare_print(&comparison);
    for (size_t i = 0; i < all.runs.count; i++)
        sl_visibility_destroy(context, &all.runs.items[i].visibility);
    sl_free(context, all.runs.items);
    sl_free(context, all.order);
    sl_space_destroy(context, &all.space);
    sl_map_destroy(context, &all.map);
    return status;
}

// --- culling for an eye

static sl_status write_eye_files(sl_context *context, const sl_compare_eye *comparison, bool dark,
                                 const sl_folder *folder) {
    for (size_t i = 0; eye_file_names[i]; i++) {
        char *path = sl_folder_file(context, folder, eye_file_names[i]);
        if (!path) return SL_NO_MEMORY;
        const sl_status status = i == 0 ? sl_compare_eye_write_csv(context, comparison, path)
                                        : sl_compare_eye_draw(context, comparison, dark, path);
        sl_free(context, path);
        SL_TRY(status);
    }
    return SL_OK;
}

/// `folder` is NULL without -o.
static sl_status compare_eye(sl_console *console, comparing *all, const sl_folder *folder,
                             sl_compare_eye *out) {
    sl_context *context = console->context;
    const sl_pipeline *pipeline = &all->plan->pipeline;
    SL_TRY(sl_pipeline_read_clean(context, pipeline, &all->map, NULL));
    SL_TRY(sl_effects_check(context, &all->map, "compare --eye", 0));
    SL_TRY(sl_pipeline_subdivide(context, pipeline, &all->map, &all->space));
    SL_TRY(sl_pipeline_check(context, pipeline, &all->space));
    SL_TRY(sl_compare_eye_run(console, &all->plan->eye, &all->space, all->plan->see.sight, out));
    out->input = pipeline->input;
    return folder ? write_eye_files(context, out, all->plan->dark, folder) : SL_OK;
}

static sl_status compare_eye_and_report(sl_console *console, const compare_plan *plan) {
    sl_context *context = console->context;
    comparing all = {.plan = plan};
    sl_compare_eye comparison = {0};
    sl_folder folder;
    if (plan->output) SL_TRY(sl_folder_open(context, plan->output, eye_file_names, &folder));
    sl_status status = compare_eye(console, &all, plan->output ? &folder : NULL, &comparison);
    if (plan->output) status = sl_folder_close(context, &folder, status);
    sl_progress_line_clear(&console->line);
    if (status == SL_OK && plan->json)
        status = sl_compare_eye_print_json(context, &comparison);
    else if (status == SL_OK && !(console->quiet && plan->output))
        sl_compare_eye_print(&comparison);
    sl_free(context, comparison.rows);
    sl_space_destroy(context, &all.space);
    sl_map_destroy(context, &all.map);
    return status;
}

// --- help

static void print_tables(void) {
    sl_compare_print_columns();
    sl_compare_eye_print_columns();
    sl_pipeline_print_methods("", "");
    sl_pipeline_print_subdivisions();
    sl_pipeline_print_effects();
    sl_input_print_formats();
}

sl_status sl_cmd_compare(sl_console *console, int argc, char **argv) {
    compare_texts t = {0};
    const sl_option_spec options[] = {
        {"output", 'o', "DIR", NULL, &t.output,
         "a folder for compare.csv, compare.png, compare.svg\nand pairs.csv; made if missing"},
        {"methods", 0, "NAME,...", NULL, &t.methods, "only these (without it: all)"},
        {"solvers", 0, "NAME,...", NULL, &t.solvers, "only these (without it: all)"},
        {"sight", 0, "closed|open", NULL, &t.sight,
         "closed (the default): lines that only touch\nwall ends count; open: they do not"},
        {"inside", 0, NULL, &t.inside, NULL,
         "look from and at inside cells only: those that a\nstart leads to or that walls enclose"},
        {"repeat", 0, "N", NULL, &t.repeat,
         "time each run N times; 0, the default: three times\nand 0.2 s at least, until 5 s"},
        {"time-limit", 0, "S", NULL, &t.time_limit,
         "give up on a run that takes longer, in seconds\n(the default is 60)"},
        {"eye", 0, NULL, &t.eye, NULL,
         "compare what culling for an eye keeps instead, over\nmany viewpoints, as Teller & Sequin "
         "1991 do; -o then\nwrites eye.csv, eye.png and eye.svg"},
        {"viewpoints", 0, "N", NULL, &t.eye_texts.viewpoints, "how many; 10000 without it"},
        {"seed", 0, "S", NULL, &t.eye_texts.seed, "what they are drawn from; 1 without it"},
        {"fov", 0, "DEG,...", NULL, &t.eye_texts.fov, "view cones in degrees; 360,60 without it"},
        {"dark", 0, NULL, &t.dark, NULL, "the chart light on dark"},
        {"json", 0, NULL, &t.json, NULL, "print one JSON object instead of the table"},
        SL_PIPELINE_OPTIONS(t.pipeline),
    };
    const sl_command_usage usage = {
        .name = "compare",
        .synopsis = "MAP [-o DIR] [options]",
        .operands = {"MAP"},
        .what = "Shows what accuracy costs in time: runs every method with every solver on one\n"
                "map, each on one thread, and holds what it sees against the first exact answer.",
        .tables = print_tables,
        .examples = "  sightline compare office.map\n"
                    "  sightline compare office.map -o out --sight open --time-limit 10\n"
                    "  sightline compare office.map --eye --viewpoints 100000 -o out",
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    const char *input;
    bool helped;
    SL_TRY(sl_option_parse(console, &usage, argc, argv, &input, &helped));
    if (helped) return SL_OK;
    compare_plan plan;
    SL_TRY(make_plan(console->context, input, &t, &plan));
    return t.eye ? compare_eye_and_report(console, &plan) : compare_and_report(console, &plan);
}

/// `sightline compare`: every method on one map, accuracy against time, as table and chart.
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "inputs/inputs.h"
#include "inputs/pipeline.h"
#include "sightline/support.h"
#include "studies/compare.h"
#include "system/built.h"

enum { MAX_REPEAT = 100000 };
#define MAX_LIMIT      1e9
#define MAX_VIEWPOINTS 1000000000

typedef struct compare_plan {
    map_pipeline pipeline;
    const char *output;
    unsigned methods, solvers; ///< bits of both tables
    run_timing timing;
    sl_see_options see;
    compare_eye_plan eye_plan;
    const char *fov; ///< as it is given
    bool dark, json, eye;
    const char *for_cells, *for_eye; ///< options that only one of the two comparisons has
} compare_plan;

/// The most interesting file first.
static const char *const file_names[] = {"compare.csv", "compare.png", "compare.svg", "pairs.csv",
                                         NULL};
static const char *const eye_file_names[] = {"eye.csv", "eye.png", "eye.svg", NULL};

/// The map, its space, and the runs.
typedef struct comparing {
    const compare_plan *plan;
    sl_map map;
    sl_space space;
    SL_ARRAY(compare_run) runs;
    size_t *order;
} comparing;

// --- reading the options

static sl_status make_plan(sl_context *context, const char *input, compare_plan *plan) {
    const char *useless = plan->eye ? plan->for_cells : plan->for_eye;
    if (useless)
        return sl_fail(context, SL_BAD_ARGUMENT, "--%s is of no use %s --eye", useless,
                       plan->eye ? "with" : "without");
    SL_TRY(pipeline_plan(context, input, &plan->pipeline));
    SL_TRY(compare_eye_read_fovs(context, plan->fov, &plan->eye_plan));
    if (plan->output) SL_TRY(built_need_pictures(context));
    return SL_OK;
}

// --- the runs

static sl_status add_run(sl_context *context, comparing *all, const sl_see_method *method,
                         const sl_solver *solver) {
    SL_TRY(SL_ARRAY_ROOM(context, &all->runs, 1));
    all->runs.items[all->runs.count++] = (compare_run){
        .method = method,
        .solver = solver,
        .guarantee = solver ? solver->guarantee : method->guarantee,
        .outcome = RUN_NOT_DONE,
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
        for (size_t s = 0; methods[m].stabs && built_solver(s); s++)
            if (all->plan->solvers >> s & 1)
                SL_TRY(add_run(context, all, &methods[m], built_solver(s)));
    }
    return all->runs.count ? SL_OK
                           : sl_fail(context, SL_BAD_ARGUMENT,
                                     "--methods and --solvers leave nothing to compare");
}

/// Fails where every run refuses the map: then there is nothing to compare.
static sl_status fail_if_all_refuse(sl_context *context, const comparing *all) {
    for (size_t i = 0; i < all->runs.count; i++)
        if (all->runs.items[i].outcome != RUN_REFUSED) return SL_OK;
    return sl_fail(context, SL_UNSUPPORTED, "%s", all->runs.items[0].refusal);
}

static void refuse_effects(sl_context *context, comparing *all) {
    for (size_t i = 0; i < all->runs.count; i++) {
        compare_run *run = &all->runs.items[i];
        if (sl_see_check(context, run->method, run->solver, &all->map) == SL_OK) continue;
        run->outcome = RUN_REFUSED;
        snprintf(run->refusal, sizeof run->refusal, "%s", sl_context_message(context));
    }
}

static sl_status time_runs(command_console *console, comparing *all) {
    sl_see_options see = all->plan->see;
    const sl_plan effects = sl_plan_make(&all->map);
    see.plan = &effects;
    for (size_t i = 0; i < all->runs.count; i++) {
        compare_run *run = &all->runs.items[i];
        if (run->outcome == RUN_REFUSED) continue;
        char name[RUN_NAME], label[RUN_NAME + 24];
        run_name(run, name);
        snprintf(label, sizeof label, "%zu/%zu %s", i + 1, all->runs.count, name);
        see.solver = run->solver;
        SL_TRY(compare_time(console, &all->space, &see, &all->plan->timing, label, run));
    }
    SL_TRY(fail_if_all_refuse(console->context, all));
    compare_judge(all->runs.items, all->runs.count);
    return SL_OK;
}

// --- what comes of them

typedef sl_status writer(sl_context *context, const compare_result *comparison, const char *path);

static sl_status draw_light(sl_context *context, const compare_result *comparison,
                            const char *path) {
    return compare_draw(context, comparison, false, path);
}

static sl_status draw_dark(sl_context *context, const compare_result *comparison,
                           const char *path) {
    return compare_draw(context, comparison, true, path);
}

static sl_status write_file(sl_context *context, const output_folder *folder, const char *name,
                            writer *write, const compare_result *comparison) {
    char *path = folder_file(context, folder, name);
    if (!path) return SL_NO_MEMORY;
    const sl_status status = write(context, comparison, path);
    sl_free(context, path);
    return status;
}

static sl_status write_files(sl_context *context, const compare_plan *plan,
                             const output_folder *folder, const compare_result *comparison) {
    writer *const draw = plan->dark ? draw_dark : draw_light;
    writer *const writers[] = {compare_write_csv, draw, draw, compare_write_pairs};
    for (size_t i = 0; file_names[i]; i++)
        SL_TRY(write_file(context, folder, file_names[i], writers[i], comparison));
    return SL_OK;
}

static sl_status prepare(sl_context *context, comparing *all) {
    const map_pipeline *pipeline = &all->plan->pipeline;
    SL_TRY(list_runs(context, all));
    SL_TRY(pipeline_read_clean(context, pipeline, &all->map, NULL));
    refuse_effects(context, all);
    SL_TRY(fail_if_all_refuse(context, all));
    SL_TRY(pipeline_subdivide(context, pipeline, &all->map, &all->space));
    return pipeline_note_inside(context, pipeline, &all->map, &all->space);
}

/// Times each subdivision, where the map leaves the choice.
static sl_status time_subdivisions(command_console *console, const comparing *all,
                                   compare_result *comparison) {
    const compare_plan *plan = all->plan;
    const compare_run *like = &all->runs.items[all->order[0]];
    if (plan->pipeline.bake.subdivision || all->map.cell_count || !sl_map_is_axial(&all->map))
        return SL_OK;
    for (size_t i = 1; i < all->runs.count && like->guarantee != SL_EXACT; i++)
        like = &all->runs.items[all->order[i]];
    if (like->guarantee != SL_EXACT || like->outcome != RUN_DONE) return SL_OK;
    sl_see_options see = plan->see;
    const sl_plan effects = sl_plan_make(&all->map);
    see.plan = &effects;
    return compare_subdivisions_time(console, &all->map, &see, &plan->timing, like,
                                     &comparison->subdivisions);
}

/// `folder` is NULL without -o.
static sl_status compare(command_console *console, comparing *all, const output_folder *folder,
                         compare_result *out) {
    sl_context *context = console->context;
    SL_TRY(prepare(context, all));
    SL_TRY(time_runs(console, all));
    all->order = sl_alloc_array(context, all->runs.count, sizeof *all->order);
    if (!all->order) return SL_NO_MEMORY;
    compare_order(all->runs.items, all->runs.count, all->order);
    *out = (compare_result){.input = all->plan->pipeline.path,
                            .space = &all->space,
                            .sight = all->plan->see.sight,
                            .runs = all->runs.items,
                            .run_count = all->runs.count,
                            .order = all->order,
                            .reference = compare_reference(all->runs.items, all->runs.count),
                            .limit = all->plan->timing.limit};
    SL_TRY(time_subdivisions(console, all, out));
    return folder ? write_files(context, all->plan, folder, out) : SL_OK;
}

static sl_status compare_and_report(command_console *console, const compare_plan *plan) {
    sl_context *context = console->context;
    comparing all = {.plan = plan};
    compare_result comparison;
    output_folder folder;
    if (plan->output) SL_TRY(folder_open(context, plan->output, file_names, &folder));
    sl_status status = compare(console, &all, plan->output ? &folder : NULL, &comparison);
    if (plan->output) status = folder_close(context, &folder, status);
    progress_line_clear(&console->line);
    if (status == SL_OK && plan->json)
        status = compare_print_json(context, &comparison);
    else if (status == SL_OK && !(console->quiet && plan->output))
        compare_print(&comparison);
    for (size_t i = 0; i < all.runs.count; i++)
        sl_visibility_destroy(context, &all.runs.items[i].visibility);
    sl_free(context, all.runs.items);
    sl_free(context, all.order);
    sl_space_destroy(context, &all.space);
    sl_map_destroy(context, &all.map);
    return status;
}

// --- culling for an eye

static sl_status write_eye_files(sl_context *context, const eye_comparison *comparison, bool dark,
                                 const output_folder *folder) {
    for (size_t i = 0; eye_file_names[i]; i++) {
        char *path = folder_file(context, folder, eye_file_names[i]);
        if (!path) return SL_NO_MEMORY;
        const sl_status status = i == 0 ? compare_eye_write_csv(context, comparison, path)
                                        : compare_eye_draw(context, comparison, dark, path);
        sl_free(context, path);
        SL_TRY(status);
    }
    return SL_OK;
}

/// Doors as the map has them: walls of the space where they are shut.
static sl_status settle_doors(sl_context *context, comparing *all) {
    const sl_map *map = &all->map;
    if (!map->door_count) return SL_OK;
    const door_choice as_they_are = {0};
    sl_baked baked = {.map = *map, .space = all->space};
    SL_TRY(doors_shut(context, &as_they_are, &baked));
    sl_visibility_destroy(context, &baked.visibility);
    all->space = baked.space;
    sl_effects_note_doors(context, map);
    return SL_OK;
}

/// `folder` is NULL without -o.
static sl_status compare_eye(command_console *console, comparing *all, const output_folder *folder,
                             eye_comparison *out) {
    sl_context *context = console->context;
    const map_pipeline *pipeline = &all->plan->pipeline;
    SL_TRY(pipeline_read_clean(context, pipeline, &all->map, NULL));
    if (all->map.mirror_count) sl_note(context, "mirrors are walls here: direct sight is compared");
    SL_TRY(pipeline_subdivide(context, pipeline, &all->map, &all->space));
    SL_TRY(pipeline_note_inside(context, pipeline, &all->map, &all->space));
    SL_TRY(settle_doors(context, all));
    SL_TRY(compare_eye_run(console, &all->plan->eye_plan, &all->map, &all->space,
                           all->plan->see.sight, out));
    out->input = pipeline->path;
    return folder ? write_eye_files(context, out, all->plan->dark, folder) : SL_OK;
}

static sl_status compare_eye_and_report(command_console *console, const compare_plan *plan) {
    sl_context *context = console->context;
    comparing all = {.plan = plan};
    eye_comparison comparison = {0};
    output_folder folder;
    if (plan->output) SL_TRY(folder_open(context, plan->output, eye_file_names, &folder));
    sl_status status = compare_eye(console, &all, plan->output ? &folder : NULL, &comparison);
    if (plan->output) status = folder_close(context, &folder, status);
    progress_line_clear(&console->line);
    if (status == SL_OK && plan->json)
        status = compare_eye_print_json(context, &comparison);
    else if (status == SL_OK && !(console->quiet && plan->output))
        compare_eye_print(&comparison);
    sl_free(context, comparison.rows);
    sl_space_destroy(context, &all.space);
    sl_map_destroy(context, &all.map);
    return status;
}

// --- help

static void print_tables(void) {
    compare_print_columns();
    compare_eye_print_columns();
    pipeline_print_methods();
    pipeline_print_subdivisions();
    pipeline_print_effects();
    input_print_formats();
}

sl_status cmd_compare(command_console *console, int argc, char **argv) {
    compare_plan plan = {.pipeline = pipeline_default(),
                         .methods = ~0u,
                         .solvers = ~0u,
                         .timing = {.limit = 60},
                         .see = sl_see_options_default(),
                         .eye_plan = compare_eye_plan_default(),
                         .fov = "360,60"};
    plan.see.threads = 1;
    const char **for_cells = &plan.for_cells, **for_eye = &plan.for_eye;
    const option_table pipeline = pipeline_option_table(&plan.pipeline);
    const option_spec options[] = {
        {"output", 'o', "DIR",
         "write compare.csv, compare.png, compare.svg and pairs.csv to this folder",
         .text = &plan.output},
        {"methods", 0, "NAME,...", "run only these methods (default: all)",
         .choices = &plan.methods, .names = method_table(), .given = for_cells},
        {"solvers", 0, "NAME,...", "run only these solvers (default: all)",
         .choices = &plan.solvers, .names = solver_table(), .given = for_cells},
        {"eye", 0, NULL,
         "compare the methods that cull for one eye, over many viewpoints, as Teller & Sequin 1991 "
         "do; writes eye.csv, eye.png and eye.svg",
         .flag = &plan.eye},
        {"json", 0, NULL, "print one JSON object in place of the table", .flag = &plan.json},
        {"sight", 0, "closed|open",
         "whether lines that only touch wall ends count: closed (default): yes; open: no",
         .sight = &plan.see.sight, .rare = true},
        {"inside", 0, NULL, "compute inside cells only", .flag = &plan.see.inside_only,
         .given = for_cells, .rare = true},
        {"repeat", 0, "N", "time each run N times (default: three times and for 0.2 s, up to 5 s)",
         .count32 = &plan.timing.repeat, .most = MAX_REPEAT, .given = for_cells, .rare = true},
        {"time-limit", 0, "SECONDS", "stop a run after this many seconds (default 60)",
         .number = &plan.timing.limit, .over_0 = true, .most = MAX_LIMIT,
         .needs = "a number of seconds over 0 is needed", .given = for_cells, .rare = true},
        {"viewpoints", 0, "N", "number of viewpoints for --eye (default 10000)",
         .count = &plan.eye_plan.viewpoints, .least = 1, .most = MAX_VIEWPOINTS,
         .needs = "one at least is needed", .given = for_eye, .rare = true},
        {"seed", 0, "N", "seed of the viewpoints (default 1)", .count = &plan.eye_plan.seed,
         .given = for_eye, .rare = true},
        {"fov", 0, "DEG,...", "view cones for --eye, in degrees (default 360,60)",
         .text = &plan.fov, .given = for_eye, .rare = true},
        {"dark", 0, NULL, "draw the chart light on dark", .flag = &plan.dark, .without = "output",
         .rare = true},
        {.group = &pipeline},
    };
    const command_usage usage = {
        .name = "compare",
        .synopsis = "MAP [-o DIR] [options]",
        .operands = {"MAP"},
        .what =
            "Shows what accuracy costs in time: runs every method with every solver on one map, "
            "on one thread, and compares each answer with the first exact one.",
        .tables = print_tables,
        .examples = "  sightline compare office.map\n"
                    "  sightline compare office.map -o out --sight open --time-limit 10\n"
                    "  sightline compare office.map --eye --viewpoints 100000 -o out",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .given = &plan.pipeline.given,
    };
    const char *input;
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, &input, &helped));
    if (helped) return SL_OK;
    SL_TRY(make_plan(console->context, input, &plan));
    return plan.eye ? compare_eye_and_report(console, &plan) : compare_and_report(console, &plan);
}

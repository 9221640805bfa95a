#include "commands.h"
#include "pictures.h"
#include "pipeline.h"
#include "sightline/support.h"
#include "view_report.h"

#include <string.h>

/// The options as they are given.
typedef struct viewcells_texts {
    sl_pipeline_texts pipeline;
    const char *input, *cells, *memory, *tolerance, *method, *objects, *elementary, *samples;
    const char *evaluate, *render, *step, *density, *candidates, *wall_splits, *seed, *threads;
    const char *output, *picture, *width, *title, *slv, *see;
    bool paths, exact, by_views, dark, json;
} viewcells_texts;

/// The options as they are meant.
typedef struct viewcells_plan {
    const viewcells_texts *texts;
    sl_pipeline pipeline;
    sl_view_run_options run;
    sl_draw_options drawing;
    const sl_see_method *see; ///< for exact sets
} viewcells_plan;

static const char *const object_names[] = {"walls", "cells"};
static const sl_name_table object_table = {"kind of objects", object_names, sizeof *object_names,
                                           2};

// --- the options

static sl_status plan_budget(sl_context *context, const viewcells_texts *t,
                             sl_view_run_options *run) {
    if (!!t->cells + !!t->memory + !!t->tolerance > 1)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "give one of --cells, --memory and --tolerance: each says where to stop");
    run->tolerance = 0.1;
    if (t->cells) run->budget = SL_BUDGET_CELLS;
    if (t->memory) run->budget = SL_BUDGET_BYTES;
    SL_TRY(sl_option_count(context, "--cells", t->cells, UINT32_MAX / 4, &run->cells));
    if (t->cells && !run->cells)
        return sl_fail(context, SL_BAD_ARGUMENT, "--cells 0: at least 1 is needed");
    SL_TRY(sl_option_size(context, "--memory", t->memory, &run->bytes));
    SL_TRY(sl_option_number(context, "--tolerance", t->tolerance, &run->tolerance));
    if (!(run->tolerance >= 0))
        return sl_fail(context, SL_BAD_ARGUMENT, "--tolerance %s: 0 or more is needed",
                       t->tolerance);
    return SL_OK;
}

static sl_status read_count(sl_context *context, const char *option, const char *text,
                            uint32_t *value) {
    uint64_t count = *value;
    SL_TRY(sl_option_count(context, option, text, UINT32_MAX / 4, &count));
    *value = (uint32_t)count;
    return SL_OK;
}

static sl_status plan_subdivision(sl_context *context, const viewcells_texts *t,
                                  sl_view_run_options *run) {
    size_t method = 0, count;
    const sl_view_method *methods = sl_view_methods(&count);
    const sl_name_table names = {"method", methods, sizeof *methods, count};
    SL_TRY(sl_option_choice(context, "--method", t->method, &names, &method));
    run->method = &methods[method];
    run->subdivision = sl_view_subdivision_default();
    // Merging has something to choose from where there are several times as many.
    if (run->budget == SL_BUDGET_CELLS && 4 * run->cells > run->subdivision.cells)
        run->subdivision.cells = (uint32_t)(4 * run->cells);
    if (run->budget == SL_BUDGET_CELLS && !run->method->merges)
        run->subdivision.cells = (uint32_t)run->cells;
    SL_TRY(read_count(context, "--elementary", t->elementary, &run->subdivision.cells));
    if (!run->subdivision.cells)
        return sl_fail(context, SL_BAD_ARGUMENT, "--elementary 0: at least 1 is needed");
    SL_TRY(read_count(context, "--candidates", t->candidates, &run->subdivision.candidates));
    return read_count(context, "--wall-splits", t->wall_splits, &run->subdivision.wall_splits);
}

/// "A,B,C"
static sl_status read_render(sl_context *context, const char *text, sl_render_cost *cost) {
    *cost = sl_render_cost_default();
    if (!text) return SL_OK;
    double *const parts[3] = {&cost->a, &cost->b, &cost->c};
    char copy[256];
    snprintf(copy, sizeof copy, "%s", text);
    char *rest = copy;
    sl_status status = strlen(text) < sizeof copy ? SL_OK : SL_BAD_ARGUMENT;
    for (int i = 0; i < 3 && status == SL_OK; i++) {
        char *comma = strchr(rest, ',');
        if ((i < 2) != (comma != NULL)) status = SL_BAD_ARGUMENT;
        if (comma) *comma = 0;
        if (status == SL_OK) status = sl_option_number(context, "--render", rest, parts[i]);
        if (status == SL_OK && !(*parts[i] >= 0)) status = SL_BAD_ARGUMENT;
        if (comma) rest = comma + 1;
    }
    if (status != SL_OK)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--render %s: three numbers A,B,C are needed, 0 or more", text);
    return SL_OK;
}

static sl_status plan_sampling(sl_context *context, const viewcells_texts *t,
                               sl_view_run_options *run) {
    size_t objects = SL_VIEW_WALLS;
    uint64_t threads = 0;
    run->sampling = sl_view_sampling_default();
    run->evaluation = 2 * run->sampling.samples;
    SL_TRY(sl_option_choice(context, "--objects", t->objects, &object_table, &objects));
    if (t->exact && t->objects && objects == SL_VIEW_WALLS)
        return sl_fail(context, SL_BAD_ARGUMENT, "--exact: exact sets are of --objects cells");
    if (t->exact && t->evaluate)
        return sl_fail(context, SL_BAD_ARGUMENT, "--exact needs no --evaluate");
    run->exact = t->exact;
    if (t->exact || run->method->exact) run->evaluation = 0;
    run->sampling.objects = t->exact ? SL_VIEW_CELLS : (sl_view_objects)objects;
    SL_TRY(sl_option_count(context, "--samples", t->samples, UINT32_MAX, &run->sampling.samples));
    if (!run->sampling.samples &&
        (run->method->needs_segments || !(t->exact || run->method->exact)))
        return sl_fail(context, SL_BAD_ARGUMENT, "--samples 0: at least 1 is needed");
    SL_TRY(sl_option_count(context, "--evaluate", t->evaluate, UINT32_MAX, &run->evaluation));
    SL_TRY(sl_option_count(context, "--seed", t->seed, UINT64_MAX, &run->sampling.seed));
    run->subdivision.seed = run->sampling.seed;
    SL_TRY(sl_option_count(context, "--threads", t->threads, 1024, &threads));
    run->sampling.threads = (unsigned)threads;
    run->subdivision.threads = (unsigned)threads;
    if (t->paths && t->density)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "give one of --paths and --density: each says where viewpoints are");
    if (t->step && !t->paths)
        return sl_fail(context, SL_BAD_ARGUMENT, "--step is for --paths, which is not given");
    run->paths = t->paths;
    run->density = t->density;
    SL_TRY(sl_option_number(context, "--step", t->step, &run->step));
    if (t->step && !(run->step > 0))
        return sl_fail(context, SL_BAD_ARGUMENT, "--step %s: a number over 0 is needed", t->step);
    return read_render(context, t->render, &run->render);
}

static sl_status plan_drawing(sl_context *context, const viewcells_texts *t,
                              sl_draw_options *drawing) {
    SL_TRY(sl_picture_plan(context, t->width, t->title, t->dark, drawing));
    return sl_picture_check(context, t->input, "--picture", t->picture);
}

static sl_status plan_seeing(sl_context *context, const viewcells_texts *t, viewcells_plan *plan) {
    size_t count, method = 0;
    const sl_see_method *methods = sl_see_methods(&count);
    const sl_name_table names = {"method", methods, sizeof *methods, count};
    SL_TRY(sl_option_choice(context, "--see", t->see ? t->see : "sweep", &names, &method));
    if (t->see && !t->slv)
        return sl_fail(context, SL_BAD_ARGUMENT, "--see is for --slv, which is not given");
    if (t->by_views && !t->slv)
        return sl_fail(context, SL_BAD_ARGUMENT, "--by-views is for --slv, which is not given");
    plan->see = &methods[method];
    return sl_output_check_baked(context, t->input, "--slv", t->slv);
}

static sl_status make_plan(sl_context *context, const viewcells_texts *t, viewcells_plan *plan) {
    plan->texts = t;
    SL_TRY(plan_seeing(context, t, plan));
    SL_TRY(plan_budget(context, t, &plan->run));
    SL_TRY(plan_subdivision(context, t, &plan->run));
    SL_TRY(plan_sampling(context, t, &plan->run));
    SL_TRY(plan_drawing(context, t, &plan->drawing));
    SL_TRY(sl_output_check(context, t->input, "-o", t->output));
    return sl_pipeline_plan(context, t->input, &t->pipeline, &plan->pipeline);
}

// --- the work

static sl_status read_space(sl_context *context, viewcells_plan *plan, sl_view_run *run) {
    sl_baked *baked = &run->baked;
    const double start = sl_view_clock();
    SL_TRY(sl_pipeline_read_clean(context, &plan->pipeline, &baked->map, NULL));
    SL_TRY(sl_effects_check(context, &baked->map, "viewcells", 0));
    const double read = sl_view_clock();
    SL_TRY(sl_pipeline_subdivide(context, &plan->pipeline, &baked->map, &baked->space));
    run->seconds.read = read - start;
    run->seconds.subdivide = sl_view_clock() - read;
    if (!plan->texts->step) {
        const sl_box *b = &baked->space.bounds;
        plan->run.step = (b->max.x - b->min.x + b->max.y - b->min.y) / 4000;
    }
    return sl_pipeline_check(context, &plan->pipeline, &baked->space);
}

static sl_status work(sl_console *console, viewcells_plan *plan, sl_view_run *run) {
    sl_context *context = console->context;
    const viewcells_texts *t = plan->texts;
    SL_TRY(read_space(context, plan, run));
    SL_TRY(sl_view_run_make(context, &plan->run, run));
    const sl_view_report report = {
        .input = t->input,
        .subdivide = sl_pipeline_subdivision(&plan->pipeline, &run->baked.map)->name,
        .options = &plan->run,
        .run = run};
    if (t->output) SL_TRY(sl_view_report_write_csv(context, run, t->output));
    if (t->picture) SL_TRY(sl_view_report_draw(context, &report, &plan->drawing, t->picture));
    if (t->slv) {
        SL_TRY(sl_view_run_see(context, &plan->run, plan->see, t->by_views, run));
        SL_TRY(sl_baked_write(context, &run->exact, t->slv));
    }
    sl_progress_line_clear(&console->line);
    if (t->json) return sl_view_report_print_json(context, &report);
    return t->output && strcmp(t->output, "-") == 0 ? SL_OK
                                                    : sl_view_report_print(context, &report);
}

static void print_tables(void) {
    size_t count;
    const sl_view_method *methods = sl_view_methods(&count);
    puts("\nmethods:");
    for (size_t i = 0; i < count; i++) printf("  %-12s%s\n", methods[i].name, methods[i].what);
    sl_pipeline_print_subdivisions();
    sl_pipeline_print_effects();
    sl_input_print_formats();
}

sl_status sl_cmd_viewcells(sl_console *console, int argc, char **argv) {
    viewcells_texts t = {0};
    const sl_option_spec options[] = {
        {"cells", 0, "N", NULL, &t.cells, "so many view cells"},
        {"memory", 0, "BYTES", NULL, &t.memory,
         "as many as their visible sets fit into: 4096, 64K, 2M"},
        {"tolerance", 0, "X", NULL, &t.tolerance,
         "as few as cost no more than 1 + X times the least;\nwithout a word 0.1"},
        {"method", 0, "NAME", NULL, &t.method, "how to make them; av-m without it"},
        {"elementary", 0, "N", NULL, &t.elementary,
         "elementary view cells to divide into first: 2000,\nor four times as many as --cells"},
        {"samples", 0, "N", NULL, &t.samples, "lines to sample visibility by, 200000 unless told"},
        {"evaluate", 0, "N", NULL, &t.evaluate,
         "other lines to tell costs by: 400000; 0, as without it\nfor hybrid: by what cells were "
         "merged by"},
        {"exact", 0, NULL, &t.exact, NULL,
         "merge by, and tell costs by, the exact sets of all\nelementary cells, in cells of the "
         "space"},
        {"objects", 0, "KIND", NULL, &t.objects,
         "what is seen: walls, at the ends of lines, or cells\nof the space, along them"},
        {"render", 0, "A,B,C", NULL, &t.render,
         "an object costs max(A, B * walls, C * share of the\nfull circle); 1,0,0 unless told"},
        {"paths", 0, NULL, &t.paths, NULL, "viewpoints are along the map's paths"},
        {"step", 0, "STEP", NULL, &t.step, "how far apart on them"},
        {"density", 0, "PICTURE", NULL, &t.density,
         "viewpoints are where a picture over the map's bounds\nis light: .png, .pgm"},
        {"candidates", 0, "N", NULL, &t.candidates,
         "splits tried for a cell, drawn at random; 0, as\nwithout it: all that can be best"},
        {"wall-splits", 0, "N", NULL, &t.wall_splits,
         "walls' own lines tried for a cell; 0 without it"},
        {"seed", 0, "N", NULL, &t.seed, "of what is drawn at random, 1 without it"},
        {"threads", 0, "N", NULL, &t.threads, "0, as without it: one a core"},
        {"output", 'o', "FILE.csv", NULL, &t.output, "a table of the view cells; - for stdout"},
        {"picture", 0, "PICTURE", NULL, &t.picture,
         "draw the cells by their cost: .png, .svg or .pdf"},
        {"slv", 0, "FILE.slv", NULL, &t.slv,
         "bake the map with these view cells: exact sets, for\nthe tools and for games"},
        {"by-views", 0, NULL, &t.by_views, NULL,
         "leave out of it what single cells see: each then sees\nwhat its view cell does, and the "
         "file is smaller"},
        {"see", 0, "NAME", NULL, &t.see, "the method of bake for that; sweep without it"},
        {"width", 0, "PX", NULL, &t.width, "of the picture, 64 to 20000 pixels or points"},
        {"dark", 0, NULL, &t.dark, NULL, "light on dark"},
        {"title", 0, "TEXT", NULL, &t.title, "a line over the picture"},
        {"json", 0, NULL, &t.json, NULL, "print the report as one JSON object"},
        SL_PIPELINE_OPTIONS(t.pipeline),
    };
    const sl_command_usage usage = {
        .name = "viewcells",
        .synopsis = "MAP [--cells N | --memory BYTES | --tolerance X] [options]",
        .operands = {"MAP"},
        .what = "Finds view cells that adapt to what is seen (Mattausch et al. 2006): regions of "
                "the map,\neach with one visible set, such that rendering these costs least for "
                "their number.\nVisibility is sampled by lines, the map divided where that pays "
                "most, and neighbours\nare merged where that costs least.",
        .tables = print_tables,
        .examples = "  sightline viewcells office.map --cells 60 --picture cells.png\n"
                    "  sightline viewcells office.map --memory 4K -o cells.csv --json\n"
                    "  sightline viewcells office.map --objects cells --cells 60 --slv office.slv",
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    bool helped;
    SL_TRY(sl_option_parse(console, &usage, argc, argv, &t.input, &helped));
    if (helped) return SL_OK;
    viewcells_plan plan = {0};
    SL_TRY(make_plan(console->context, &t, &plan));
    sl_view_run run = {0};
    const sl_status status = work(console, &plan, &run);
    sl_view_run_destroy(console->context, &run);
    return status;
}

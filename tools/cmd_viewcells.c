/// `sightline viewcells`: view cells that adapt to what is seen (Mattausch et al. 2006).
#include "commands.h"
#include "json_print.h"
#include "outputs.h"
#include "pipeline.h"
#include "report.h"
#include "sightline/draw.h"
#include "sightline/support.h"
#include "view_run.h"

#include <inttypes.h>
#include <string.h>

typedef struct view_report {
    const char *input, *subdivide;
    const view_run_options *options;
    const view_run *run;
} view_report;

// --- the report

/// Costs of one view cell, of the cut and of all elementary cells.
typedef struct totals {
    double whole, cut, finest;
    uint64_t cut_bytes, finest_bytes;
} totals;

static sl_status add_up(sl_context *context, const view_run *run, totals *out) {
    const sl_view_hierarchy *h = view_run_told(run);
    uint64_t unused;
    SL_TRY(view_run_cost(context, h, 1, &out->whole, &unused));
    SL_TRY(view_run_cost(context, h, run->cell_count, &out->cut, &out->cut_bytes));
    return view_run_cost(context, h, h->cell_count, &out->finest, &out->finest_bytes);
}

static const char *objects_name(const view_report *report) {
    return report->run->scene.objects == SL_VIEW_WALLS ? "walls" : "cells";
}

static bool is_told_exactly(const view_report *report) {
    const view_run_options *o = report->options;
    return (o->exact || o->method->exact) && !report->run->evaluated.cell_count;
}

static void print_work(const sl_view_work *w) {
    printf("looks             %" PRIu64 " from %" PRIu64 " rooms and the halves of %" PRIu64
           " cuts: %" PRIu64 " candidates, %" PRIu64 " relations, %" PRIu64 " tests\n",
           w->looks, w->rooms, w->cuts, w->candidates, w->relations, w->tests);
}

static void add_work(json_fields *fields, const sl_view_work *work) {
    json_add_count(fields, "rooms", work->rooms);
    json_add_count(fields, "cuts", work->cuts);
    json_add_count(fields, "looks", work->looks);
    json_add_count(fields, "candidates", work->candidates);
    json_add_count(fields, "relations", work->relations);
    json_add_count(fields, "tests", work->tests);
    json_add_count(fields, "weighed", work->weighed);
}

static sl_status view_report_print(sl_context *context, const view_report *report) {
    const view_run *run = report->run;
    const sl_view_segments *s = &run->segments;
    totals t;
    char size[SIZE_TEXT], finest[SIZE_TEXT];
    SL_TRY(add_up(context, run, &t));
    size_write(t.cut_bytes, size);
    size_write(t.finest_bytes, finest);
    printf("%u view cells by %s: expected cost %.6g %s, sets of %s\n", run->cell_count,
           report->options->method->name, t.cut, objects_name(report), size);
    ground_print(&run->baked.space);
    printf("  with one cell   %.6g\n", t.whole);
    printf("  with all %-7u%.6g, sets of %s\n", run->tree.cell_count, t.finest, finest);
    if (report->options->method->exact)
        print_work(&run->found.work);
    else
        printf("segments          %u of %" PRIu64 " samples (%" PRIu64 " in empty space, %" PRIu64
               " saw no wall, %" PRIu64 " lost)\n",
               s->count, s->drawn, s->empty, s->unseeing, s->lost);
    if (run->has_exact) {
        char plain[SIZE_TEXT], rows[SIZE_TEXT], cells[SIZE_TEXT];
        const sl_pvs *pulled = &run->exact.views.rows;
        size_write(run->plain_bytes, plain);
        size_write(pulled->offsets[pulled->cell_count], rows);
        size_write(run->cell_bytes, cells);
        printf("exact sets        %s in rows of the %u cells, %s in those of view cells", cells,
               run->exact.space.cell_count, plain);
        if (run->exact.views.node_count > run->cell_count) printf(", %s pulled up", rows);
        putchar('\n');
        if (run->exact_cost > 0) printf("exact cost        %.6g cells\n", run->exact_cost);
    }
    if (is_told_exactly(report)) printf("costs             by exact sets\n");
    if (run->evaluated.cell_count)
        printf("evaluated by      %" PRIu64 " other samples\n", report->options->evaluation);
    printf("seconds           read %.3f, subdivide %.3f, sample %.3f, divide %.3f, merge %.3f, "
           "evaluate %.3f\n",
           run->seconds.read, run->seconds.subdivide, run->seconds.sample, run->seconds.divide,
           run->seconds.merge, run->seconds.evaluate);
    return SL_OK;
}

static void add_seconds(json_fields *fields, const view_seconds *seconds) {
    json_fields inner = json_begin();
    json_add_real(&inner, "read", seconds->read);
    json_add_real(&inner, "subdivide", seconds->subdivide);
    json_add_real(&inner, "sample", seconds->sample);
    json_add_real(&inner, "divide", seconds->divide);
    json_add_real(&inner, "merge", seconds->merge);
    json_add_real(&inner, "evaluate", seconds->evaluate);
    json_add_real(&inner, "see", seconds->see);
    json_add_fields(fields, "seconds", &inner);
}

static sl_status view_report_print_json(sl_context *context, const view_report *report) {
    const view_run *run = report->run;
    const sl_view_segments *s = &run->segments;
    totals t;
    SL_TRY(add_up(context, run, &t));
    json_fields fields = json_begin();
    json_add_text(&fields, "map", report->input);
    json_add_text(&fields, "subdivide", report->subdivide);
    json_add_text(&fields, "method", report->options->method->name);
    json_add_text(&fields, "objects", objects_name(report));
    json_add_count(&fields, "walls", run->baked.space.wall_count);
    json_add_count(&fields, "cells", run->baked.space.cell_count);
    ground_add_json(&fields, &run->baked.space);
    json_add_count(&fields, "samples", s->drawn);
    json_add_count(&fields, "samples_in_empty_space", s->empty);
    json_add_count(&fields, "samples_that_saw_no_wall", s->unseeing);
    json_add_count(&fields, "samples_lost", s->lost);
    json_add_count(&fields, "segments", s->count);
    json_add_count(&fields, "evaluation_samples", report->options->evaluation);
    json_add_flag(&fields, "exact", is_told_exactly(report));
    if (report->options->method->exact) add_work(&fields, &run->found.work);
    json_add_count(&fields, "elementary_view_cells", run->tree.cell_count);
    json_add_count(&fields, "view_cells", run->cell_count);
    json_add_real(&fields, "cost_of_one", t.whole);
    json_add_real(&fields, "cost", t.cut);
    json_add_real(&fields, "cost_of_all", t.finest);
    json_add_count(&fields, "bytes", t.cut_bytes);
    json_add_count(&fields, "bytes_of_all", t.finest_bytes);
    if (run->has_exact) {
        const sl_pvs *pulled = &run->exact.views.rows;
        json_add_count(&fields, "exact_cells", run->exact.space.cell_count);
        json_add_count(&fields, "exact_row_bytes_of_cells", run->cell_bytes);
        json_add_count(&fields, "exact_row_bytes", run->plain_bytes);
        json_add_count(&fields, "exact_row_bytes_pulled_up", pulled->offsets[pulled->cell_count]);
        if (run->exact_cost > 0) json_add_real(&fields, "exact_cost", run->exact_cost);
    }
    add_seconds(&fields, &run->seconds);
    json_add_count(&fields, "peak_memory_bytes", size_of_peak_memory());
    return json_print(context, &fields);
}

static void put(FILE *out, double value, char after) {
    char text[SL_NUMBER_TEXT];
    sl_number_write(value, text);
    fprintf(out, "%s%c", text, after);
}

static sl_point middle_of(const sl_view_tree *tree, uint32_t leaf) {
    sl_point sum = {0, 0};
    const uint32_t first = tree->first[leaf], count = tree->first[leaf + 1] - first;
    for (uint32_t i = 0; i < count; i++) {
        sum.x += tree->corners[first + i].x / count;
        sum.y += tree->corners[first + i].y / count;
    }
    return sum;
}

/// The elementary cells of a view cell: their number, and the one with the largest mass.
typedef struct members {
    uint32_t count, largest;
} members;

static sl_status write_rows(sl_context *context, const view_run *run, FILE *out) {
    const sl_view_hierarchy *h = view_run_told(run);
    members *of = sl_alloc_array(context, run->cell_count, sizeof *of);
    if (!of) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < h->cell_count; i++) {
        members *m = &of[run->view_cells[i]];
        if (!m->count++ || run->tree.mass[i] > run->tree.mass[m->largest]) m->largest = i;
    }
    fputs("view_cell,probability,cost,objects,bytes,elementary_cells,x,y\n", out);
    for (uint32_t i = 0; i < run->cell_count; i++) {
        const uint32_t number = run->numbers[i];
        const sl_point at = middle_of(&run->tree, of[i].largest);
        fprintf(out, "%u,", i);
        put(out, h->mass[number], ',');
        put(out, h->cost[number], ',');
        fprintf(out, "%u,%" PRIu64 ",%u,", h->objects[number], h->bytes[number], of[i].count);
        put(out, at.x, ',');
        put(out, at.y, '\n');
    }
    sl_free(context, of);
    return SL_OK;
}

/// Writes one row for each view cell: number, probability, cost, objects, bytes, number of
/// elementary cells, and a point in the largest of them.
static sl_status view_report_write_csv(sl_context *context, const view_run *run, const char *path) {
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    return sl_output_close(context, &output, write_rows(context, run, output.stream));
}

/// Draws the view cells, coloured by cost.
static sl_status view_report_draw(sl_context *context, const view_report *report,
                                  const sl_draw_options *options, const char *path) {
    const view_run *run = report->run;
    const sl_view_hierarchy *h = view_run_told(run);
    totals t;
    SL_TRY(add_up(context, run, &t));
    double *values = sl_alloc_array(context, h->cell_count, sizeof *values);
    if (!values) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < h->cell_count; i++)
        values[i] = h->cost[run->numbers[run->view_cells[i]]];
    char name[64], caption[160];
    snprintf(name, sizeof name, "render cost (%s)", objects_name(report));
    snprintf(caption, sizeof caption,
             "%u view cells by %s  \xc2\xb7  expected cost %.4g, with one cell %.4g",
             run->cell_count, report->options->method->name, t.cut, t.whole);
    sl_patches patches = {.name = name,
                          .points = run->tree.corners,
                          .first = run->tree.first,
                          .values = values,
                          .count = h->cell_count};
    sl_segment *lines = NULL;
    sl_status status =
        sl_view_borders(context, &run->tree, run->view_cells, &lines, &patches.line_count);
    patches.lines = lines;
    if (status == SL_OK)
        status = sl_draw_patches_file(context, &run->baked, &patches, caption, options, path);
    sl_view_borders_free(context, lines);
    sl_free(context, values);
    return status;
}

// --- the command

typedef struct viewcells_plan {
    const char *input, *output, *picture, *slv, *render;
    map_pipeline pipeline;
    view_run_options run;
    sl_draw_options drawing;
    size_t method, objects, see; ///< in their tables
    uint32_t elementary;
    bool by_views, json;
    const char *cells_given, *memory_given, *tolerance_given, *objects_given, *elementary_given;
    const char *evaluate_given, *step_given, *see_given;
} viewcells_plan;

enum { MAX_COUNT = UINT32_MAX / 4 };

static const char *const object_names[] = {"walls", "cells"};
static const name_table object_table = {"kind of objects", object_names, sizeof *object_names, 2,
                                        NULL};

// --- the options

static sl_status plan_budget(sl_context *context, viewcells_plan *p) {
    if (!!p->cells_given + !!p->memory_given + !!p->tolerance_given > 1)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "give one of --cells, --memory and --tolerance: each says where to stop");
    if (p->cells_given) p->run.budget = BUDGET_CELLS;
    if (p->memory_given) p->run.budget = BUDGET_BYTES;
    return SL_OK;
}

static void plan_subdivision(viewcells_plan *p) {
    view_run_options *run = &p->run;
    size_t count;
    run->method = &sl_view_methods(&count)[p->method];
    // Merging needs a choice: start from four times as many cells.
    if (run->budget == BUDGET_CELLS && 4 * run->cells > run->subdivision.cells)
        run->subdivision.cells = (uint32_t)(4 * run->cells);
    if (run->budget == BUDGET_CELLS && !run->method->merges)
        run->subdivision.cells = (uint32_t)run->cells;
    if (p->elementary_given) run->subdivision.cells = p->elementary;
    run->subdivision.seed = run->sampling.seed;
    run->subdivision.threads = run->sampling.threads;
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
        if (status == SL_OK) status = read_number(context, "--render", rest, parts[i]);
        if (status == SL_OK && !(*parts[i] >= 0)) status = SL_BAD_ARGUMENT;
        if (comma) rest = comma + 1;
    }
    if (status != SL_OK)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--render %s: three numbers A,B,C are needed, 0 or more", text);
    return SL_OK;
}

static sl_status plan_sampling(sl_context *context, viewcells_plan *p) {
    view_run_options *run = &p->run;
    if (run->exact && p->objects_given && p->objects == SL_VIEW_WALLS)
        return sl_fail(context, SL_BAD_ARGUMENT, "--exact: exact sets are of --objects cells");
    if (run->exact && p->evaluate_given)
        return sl_fail(context, SL_BAD_ARGUMENT, "--exact needs no --evaluate");
    const bool exact = run->exact || run->method->exact;
    if (exact && !p->evaluate_given) run->evaluation = 0;
    run->sampling.objects = run->exact ? SL_VIEW_CELLS : (sl_view_objects)p->objects;
    if (!run->sampling.samples && (run->method->needs_segments || !exact))
        return sl_fail(context, SL_BAD_ARGUMENT, "--samples 0: at least 1 is needed");
    if (run->paths && run->density)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "give one of --paths and --density: each says where viewpoints are");
    if (p->step_given && !run->paths)
        return sl_fail(context, SL_BAD_ARGUMENT, "--step is for --paths, which is not given");
    return read_render(context, p->render, &run->render);
}

static sl_status make_plan(sl_context *context, viewcells_plan *p) {
    if ((p->see_given || p->by_views) && !p->slv)
        return sl_fail(context, SL_BAD_ARGUMENT, "--%s is for --slv, which is not given",
                       p->see_given ? p->see_given : "by-views");
    SL_TRY(plan_budget(context, p));
    plan_subdivision(p);
    SL_TRY(plan_sampling(context, p));
    return pipeline_plan(context, p->input, &p->pipeline);
}

// --- the work

static sl_status read_space(sl_context *context, viewcells_plan *plan, view_run *run) {
    sl_baked *baked = &run->baked;
    const double start = sl_seconds();
    SL_TRY(pipeline_read_clean(context, &plan->pipeline, &baked->map, NULL));
    SL_TRY(sl_effects_check_because(context, &baked->map, "viewcells", 0,
                                    "the lines that it samples end at walls alone"));
    const double read = sl_seconds();
    SL_TRY(pipeline_subdivide(context, &plan->pipeline, &baked->map, &baked->space));
    SL_TRY(pipeline_note_inside(context, &plan->pipeline, &baked->map, &baked->space));
    run->seconds.read = read - start;
    run->seconds.subdivide = sl_seconds() - read;
    if (!plan->step_given) {
        const sl_box *b = &baked->space.bounds;
        plan->run.step = (b->max.x - b->min.x + b->max.y - b->min.y) / 4000;
    }
    return SL_OK;
}

static sl_status work(command_console *console, viewcells_plan *plan, view_run *run) {
    sl_context *context = console->context;
    SL_TRY(read_space(context, plan, run));
    SL_TRY(view_run_make(context, &plan->run, run));
    const sl_subdivision *asked = plan->pipeline.bake.subdivision;
    const sl_subdivision *way = asked ? asked : sl_subdivision_for(&run->baked.map);
    const view_report report = {
        .input = plan->input, .subdivide = way->name, .options = &plan->run, .run = run};
    if (plan->output) SL_TRY(view_report_write_csv(context, run, plan->output));
    if (plan->picture) SL_TRY(view_report_draw(context, &report, &plan->drawing, plan->picture));
    if (plan->slv) {
        SL_TRY(view_run_see(context, &plan->run,
                            plan->see_given ? &sl_see_methods(&(size_t){0})[plan->see] : NULL,
                            plan->by_views, run));
        SL_TRY(sl_baked_write(context, &run->exact, plan->slv));
    }
    progress_line_clear(&console->line);
    if (plan->json) return view_report_print_json(context, &report);
    return plan->output && strcmp(plan->output, "-") == 0 ? SL_OK
                                                          : view_report_print(context, &report);
}

static void print_tables(void) {
    size_t count;
    const sl_view_method *methods = sl_view_methods(&count);
    puts("\nmethods:");
    for (size_t i = 0; i < count; i++) printf("  %-12s%s\n", methods[i].name, methods[i].what);
    pipeline_print_subdivisions();
    pipeline_print_effects();
    input_print_formats();
}

sl_status cmd_viewcells(command_console *console, int argc, char **argv) {
    viewcells_plan plan = {
        .pipeline = pipeline_default(),
        .drawing = sl_draw_options_default(),
        .run = {.sampling = sl_view_sampling_default(),
                .subdivision = sl_view_subdivision_default(),
                .tolerance = 0.1},
        .objects = SL_VIEW_WALLS,
    };
    view_run_options *run = &plan.run;
    plan.pipeline.settles_doors = true;
    run->evaluation = 2 * run->sampling.samples;
    size_t count;
    const sl_view_method *methods = sl_view_methods(&count);
    const name_table method_names = {"method", methods, sizeof *methods, count, NULL};
    const option_table pipeline = pipeline_option_table(&plan.pipeline);
    const option_table picture = picture_option_table(&plan.drawing, true);
    const option_spec options[] = {
        {"cells", 0, "N", "so many view cells", .count = &run->cells, .least = 1, .most = MAX_COUNT,
         .given = &plan.cells_given},
        {"memory", 0, "BYTES", "as many as their visible sets fit into: 4096, 64K, 2M",
         .bytes = &run->bytes, .given = &plan.memory_given},
        {"tolerance", 0, "X",
         "as few as cost no more than 1 + X times the least;\nwithout a word 0.1",
         .number = &run->tolerance, .needs = "0 or more is needed", .given = &plan.tolerance_given},
        {"method", 0, "NAME", "how to make them; av-m without it", .choice = &plan.method,
         .names = method_names},
        {"elementary", 0, "N",
         "elementary view cells to divide into first: 2000,\nor four times as many as --cells",
         .count32 = &plan.elementary, .least = 1, .most = MAX_COUNT,
         .given = &plan.elementary_given},
        {"samples", 0, "N", "lines to sample visibility by, 200000 unless told",
         .count = &run->sampling.samples, .most = UINT32_MAX},
        {"evaluate", 0, "N",
         "other lines to tell costs by: 400000; 0, as without it\nfor hybrid: by what cells were "
         "merged by",
         .count = &run->evaluation, .most = UINT32_MAX, .given = &plan.evaluate_given},
        {"exact", 0, NULL,
         "merge by, and tell costs by, the exact sets of all\nelementary cells, in cells of the "
         "space",
         .flag = &run->exact},
        {"objects", 0, "KIND",
         "what is seen: walls, at the ends of lines, or cells\nof the space, along them",
         .choice = &plan.objects, .names = object_table, .given = &plan.objects_given},
        {"render", 0, "A,B,C",
         "an object costs max(A, B * walls, C * share of the\nfull circle); 1,0,0 unless told",
         .text = &plan.render},
        {"paths", 0, NULL, "viewpoints are along the map's paths", .flag = &run->paths},
        {"step", 0, "STEP", "how far apart on them", .number = &run->step, .over_0 = true,
         .given = &plan.step_given},
        {"density", 0, "PICTURE",
         "viewpoints are where a picture over the map's bounds\nis light: .png, .pgm",
         .text = &run->density},
        {"candidates", 0, "N",
         "splits tried for a cell, drawn at random; 0, as\nwithout it: all that can be best",
         .count32 = &run->subdivision.candidates, .most = MAX_COUNT},
        {"wall-splits", 0, "N", "walls' own lines tried for a cell; 0 without it",
         .count32 = &run->subdivision.wall_splits, .most = MAX_COUNT},
        {"seed", 0, "N", "of what is drawn at random, 1 without it", .count = &run->sampling.seed},
        {"threads", 0, "N", "0, as without it: one a core", .count32 = &run->sampling.threads,
         .most = 1024},
        {"output", 'o', "FILE.csv", "a table of the view cells; - for stdout", .text = &plan.output,
         .check = CHECK_TABLE},
        {"picture", 0, "PICTURE", "draw the cells by their cost: .png, .svg or .pdf",
         .text = &plan.picture, .check = CHECK_PICTURE},
        {"slv", 0, "FILE.slv",
         "bake the map with these view cells: exact sets, for\nthe tools and for games",
         .text = &plan.slv, .check = CHECK_BAKED},
        {"by-views", 0, NULL,
         "leave out of it what single cells see: each then sees\nwhat its view cell does, and the "
         "file is smaller",
         .flag = &plan.by_views},
        {"see", 0, "NAME", "the method of bake for that; sweep without it", .choice = &plan.see,
         .names = method_table(), .given = &plan.see_given},
        {.group = &picture},
        {"json", 0, NULL, "print the report as one JSON object", .flag = &plan.json},
        {.group = &pipeline},
    };
    const command_usage usage = {
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
    SL_TRY(options_parse(console, &usage, argc, argv, &plan.input, &helped));
    if (helped) return SL_OK;
    SL_TRY(make_plan(console->context, &plan));
    view_run done = {0};
    const sl_status status = work(console, &plan, &done);
    view_run_destroy(console->context, &done);
    return status;
}

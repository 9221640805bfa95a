/// `sightline viewcells`: view cells that adapt to what is seen (Mattausch et al. 2006).
#include "arguments/help.h"
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "inputs/inputs.h"
#include "inputs/pipeline.h"
#include "reports/fields.h"
#include "reports/json_print.h"
#include "reports/report.h"
#include "sightline/draw.h"
#include "sightline/json.h"
#include "sightline/support.h"
#include "studies/view_run.h"
#include "system/built.h"
#include "system/system.h"

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
    json_open(fields, "seconds");
    json_add_real(fields, "read", seconds->read);
    json_add_real(fields, "subdivide", seconds->subdivide);
    json_add_real(fields, "sample", seconds->sample);
    json_add_real(fields, "divide", seconds->divide);
    json_add_real(fields, "merge", seconds->merge);
    json_add_real(fields, "evaluate", seconds->evaluate);
    json_add_real(fields, "see", seconds->see);
    json_close(fields);
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
    json_add_count(&fields, "peak_memory_bytes", system_peak_memory());
    return json_print(context, &fields);
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

/// The elementary cells of view cells.
typedef struct members {
    uint32_t *first;   ///< by view cell, and one more: list[first[i] .. first[i + 1])
    uint32_t *list;    ///< elementary cells, ascending for each view cell
    uint32_t *largest; ///< by view cell: the one with the largest mass
} members;

static void members_destroy(sl_context *context, members *of) {
    sl_free(context, of->first);
    sl_free(context, of->list);
    sl_free(context, of->largest);
}

static sl_status members_find(sl_context *context, const view_run *run, members *of) {
    const uint32_t all = view_run_told(run)->cell_count, count = run->cell_count;
    *of = (members){sl_alloc_array(context, (size_t)count + 2, sizeof *of->first),
                    sl_alloc_array(context, all, sizeof *of->list),
                    sl_alloc_array(context, count, sizeof *of->largest)};
    if (!of->first || !of->list || !of->largest) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < all; i++) of->first[run->view_cells[i] + 2]++;
    for (uint32_t i = 0; i < count; i++) of->first[i + 2] += of->first[i + 1];
    for (uint32_t i = 0; i < all; i++) of->list[of->first[run->view_cells[i] + 1]++] = i;
    for (uint32_t cell = 0; cell < count; cell++) {
        of->largest[cell] = of->list[of->first[cell]];
        for (uint32_t i = of->first[cell]; i < of->first[cell + 1]; i++)
            if (run->tree.mass[of->list[i]] > run->tree.mass[of->largest[cell]])
                of->largest[cell] = of->list[i];
    }
    return SL_OK;
}

static uint32_t members_count(const members *of, uint32_t view_cell) {
    return of->first[view_cell + 1] - of->first[view_cell];
}

/// What the table is of.
typedef struct cell_rows {
    const view_run *run;
    members of;
} cell_rows;

/// Number, probability, cost, objects, bytes, number of elementary cells, and a point in the
/// largest of them.
static size_t list_fields(const void *of, size_t row, table_field fields[FIELDS_MOST]) {
    const cell_rows *rows = of;
    const view_run *run = rows->run;
    const sl_view_hierarchy *h = view_run_told(run);
    const uint32_t number = run->numbers[row];
    const sl_point at = middle_of(&run->tree, rows->of.largest[row]);
    size_t count = 0;
    fields[count++] = field_count("view_cell", row);
    fields[count++] = field_real("probability", h->mass[number]);
    fields[count++] = field_real("cost", h->cost[number]);
    fields[count++] = field_count("objects", h->objects[number]);
    fields[count++] = field_count("bytes", h->bytes[number]);
    fields[count++] = field_count("elementary_cells", members_count(&rows->of, (uint32_t)row));
    fields[count++] = field_real("x", at.x);
    fields[count++] = field_real("y", at.y);
    return count;
}

static void put_members(sl_json_writer *json, const members *of, uint32_t view_cell) {
    sl_json_put_key(json, "members");
    sl_json_put_list(json);
    for (uint32_t i = of->first[view_cell]; i < of->first[view_cell + 1]; i++)
        sl_json_put_integer(json, of->list[i]);
    sl_json_put_end(json, ']');
}

/// Each view cell as its shape, with the columns of its line in the table and its members.
static sl_status write_places(sl_context *context, const field_rows *rows, FILE *file) {
    const cell_rows *of = rows->of;
    const view_run *run = of->run;
    sl_shapes shapes;
    SL_TRY(sl_view_shapes(context, &run->tree, run->view_cells, run->cell_count, &shapes));
    sl_geojson_writer out = sl_geojson_begin(file, &run->baked.map.earth);
    for (uint32_t i = 0; i < run->cell_count && !ferror(file); i++) {
        sl_geojson_put_shape(&out, "view_cell", &shapes, i);
        fields_add_properties(&out, rows, i);
        put_members(&out.json, &of->of, i);
        sl_geojson_end_feature(&out);
    }
    sl_geojson_end(&out);
    sl_view_shapes_destroy(context, &shapes);
    return SL_OK;
}

/// Writes a row or a feature for each view cell.
static sl_status view_report_write(sl_context *context, const view_run *run, const char *path) {
    cell_rows of = {.run = run};
    const field_rows rows = {list_fields, &of, run->cell_count};
    sl_output output;
    sl_status status = members_find(context, run, &of.of);
    if (status == SL_OK && !name_ends_with(path, ".geojson")) {
        status = fields_write_csv(context, &rows, path);
    } else if (status == SL_OK) {
        status = sl_output_open(context, path, &output);
        if (status == SL_OK)
            status = sl_output_close(context, &output, write_places(context, &rows, output.stream));
    }
    members_destroy(context, &of.of);
    return status;
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
        status = built_pictures()->patches(context, &run->baked, &patches, caption, options, path);
    sl_free(context, lines);
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
    SL_TRY(sl_effects_check(context, &baked->map, "viewcells", 0,
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
    if (plan->output) SL_TRY(view_report_write(context, run, plan->output));
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
    for (size_t i = 0; i < count; i++) help_name(methods[i].name, 12, methods[i].what, NULL);
    pipeline_print_subdivisions();
    pipeline_print_effects();
    input_print_formats();
}

sl_status cmd_viewcells(command_console *console, int argc, char **argv) {
    viewcells_plan plan = {
        .pipeline = pipeline_default(),
        .drawing = built_draw_options(),
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
    const option_table picture = picture_option_table(&plan.drawing, "picture", true);
    const option_spec options[] = {
        {"cells", 0, "N", "make this number of view cells", .count = &run->cells, .least = 1,
         .most = MAX_COUNT, .given = &plan.cells_given},
        {"memory", 0, "SIZE", "make as many as their visible sets fit into: 4096, 64K, 2M",
         .bytes = &run->bytes, .given = &plan.memory_given},
        {"tolerance", 0, "X",
         "make the fewest whose cost is within a factor 1 + X of the minimum (default 0.1)",
         .number = &run->tolerance, .needs = "0 or more is needed", .given = &plan.tolerance_given},
        {"method", 0, "NAME", "how to make view cells (default: av-m)", .choice = &plan.method,
         .names = method_names},
        {"output", 'o', "TABLE", "table of the view cells: .csv, or .geojson with their shapes",
         .text = &plan.output, .check = CHECK_TABLE, .endings = ".geojson"},
        {"picture", 0, "PICTURE", "draw the cells by their cost: .png, .svg or .pdf",
         .text = &plan.picture, .check = CHECK_PICTURE},
        {"slv", 0, "FILE.slv", "bake the map with these view cells: exact sets, for games",
         .text = &plan.slv, .check = CHECK_BAKED},
        {"json", 0, NULL, "print the report as one JSON object", .flag = &plan.json},
        {"by-views", 0, NULL,
         "with --slv: leave out the sets of single cells; the file is smaller, and a cell sees "
         "what its view cell does",
         .flag = &plan.by_views, .rare = true},
        {"see", 0, "NAME", "with --slv: the method of the bake (default: sweep)",
         .choice = &plan.see, .names = method_table(), .given = &plan.see_given, .rare = true},
        {"elementary", 0, "N",
         "number of elementary view cells to begin with (default: 2000, or four times --cells)",
         .count32 = &plan.elementary, .least = 1, .most = MAX_COUNT,
         .given = &plan.elementary_given, .topic = "sampling", .rare = true},
        {"samples", 0, "N", "number of lines that sample visibility (default 200000)",
         .count = &run->sampling.samples, .most = UINT32_MAX, .topic = "sampling", .rare = true},
        {"evaluate", 0, "N",
         "number of other lines that measure the cost (default 400000; 0: none, the cost is that "
         "of merging)",
         .count = &run->evaluation, .most = UINT32_MAX, .given = &plan.evaluate_given,
         .topic = "sampling", .rare = true},
        {"exact", 0, NULL, "merge and measure by exact sets of all elementary cells",
         .flag = &run->exact, .topic = "sampling", .rare = true},
        {"objects", 0, "KIND",
         "what is seen: walls (at the ends of lines), or cells of the space (along lines)",
         .choice = &plan.objects, .names = object_table, .given = &plan.objects_given,
         .topic = "sampling", .rare = true},
        {"render", 0, "A,B,C",
         "cost of an object: max(A, B * walls, C * share of the full circle) (default 1,0,0)",
         .text = &plan.render, .topic = "sampling", .rare = true},
        {"paths", 0, NULL, "take viewpoints from the map's paths", .flag = &run->paths,
         .topic = "sampling", .rare = true},
        {"step", 0, "STEP", "distance of the viewpoints on them", .number = &run->step,
         .over_0 = true, .given = &plan.step_given, .topic = "sampling", .rare = true},
        {"density", 0, "PICTURE",
         "take viewpoints where a picture over the map's bounds is light: .png, .pgm",
         .text = &run->density, .topic = "sampling", .rare = true},
        {"candidates", 0, "N",
         "number of random splits to try for a cell (default: all that count)",
         .count32 = &run->subdivision.candidates, .most = MAX_COUNT, .topic = "sampling",
         .rare = true},
        {"wall-splits", 0, "N", "number of walls whose lines are tried for a cell (default 0)",
         .count32 = &run->subdivision.wall_splits, .most = MAX_COUNT, .topic = "sampling",
         .rare = true},
        {"seed", 0, "N", "seed of all random numbers (default 1)", .count = &run->sampling.seed,
         .topic = "sampling", .rare = true},
        {"threads", 0, "N", "number of threads (default: one per core)",
         .count32 = &run->sampling.threads, .most = 1024, .topic = "sampling", .rare = true},
        {.group = &picture},
        {.group = &pipeline},
    };
    const command_usage usage = {
        .name = "viewcells",
        .synopsis = "MAP [--cells N | --memory SIZE] [options]",
        .operands = {"MAP"},
        .what =
            "Makes view cells that adapt to what is seen (Mattausch et al. 2006): regions of the "
            "map with one visible set each, so that rendering costs least for their number. "
            "Lines sample visibility; the map is divided where that saves most, and neighbours "
            "are merged where that costs least.",
        .tables = print_tables,
        .examples = "  sightline viewcells office.map --cells 60 --picture cells.png\n"
                    "  sightline viewcells office.map --memory 4K -o cells.csv --json\n"
                    "  sightline viewcells office.map --objects cells --cells 60 --slv office.slv",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .given = &plan.pipeline.given,
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

/// `sightline check`: leaks, gaps, overlaps and thin cells of a map; closes gaps with --snap.
#include "commands/commands.h"
#include "reports/faults_report.h"
#include "sightline/draw.h"
#include "sightline/support.h"
#include "system/built.h"

#include <math.h>
#include <stdlib.h>

typedef struct check_plan {
    map_pipeline pipeline;
    sl_faults_options faults;
    sl_draw_options drawing;
    const char *output, *snap;
    const char *for_one; ///< an option that is for one map
    uint64_t most;
    bool json, strict, every;
} check_plan;

static void destroy(sl_context *context, checked *c) {
    sl_map_destroy(context, &c->map);
    sl_map_destroy(context, &c->counted);
    sl_baked_destroy(context, &c->baked);
    sl_faults_destroy(context, &c->faults);
    sl_strays_destroy(context, &c->strays);
}

/// Subdivides and finds faults. c->map is as it was read; c->baked.map becomes a clean copy.
static sl_status examine(sl_context *context, const check_plan *plan, double gap, checked *c) {
    sl_faults_options options = plan->faults;
    options.gap = gap;
    options.clean = &plan->pipeline.input.clean;
    c->gap = gap > 0 ? gap : sl_usual_gap(&c->map);
    sl_map_destroy(context, &c->counted);
    sl_baked_destroy(context, &c->baked);
    sl_faults_destroy(context, &c->faults);
    sl_strays_destroy(context, &c->strays);
    SL_TRY(sl_find_strays(context, &c->map, &c->strays));
    SL_TRY(sl_map_copy(context, &c->map, &c->baked.map));
    SL_TRY(pipeline_clean(context, &plan->pipeline, &c->baked.map, NULL));
    map_pipeline pipeline = plan->pipeline;
    const sl_subdivision *way = pipeline.bake.subdivision;
    if (c->mended && way && way->takes_cells) pipeline.bake.subdivision = NULL;
    SL_TRY(pipeline_subdivide(context, &pipeline, &c->baked.map, &c->baked.space));
    SL_TRY(sl_doubt_inside(context, &c->baked.map, &c->baked.space, &c->inside));
    if (!sl_map_partial_walls(&c->map))
        return sl_find_faults(context, &c->map, &c->baked.space, &options, &c->faults);
    SL_TRY(sl_map_copy(context, &c->map, &c->counted));
    SL_TRY(sl_map_settle_stops(context, &c->counted, NULL));
    SL_TRY(sl_find_faults(context, &c->counted, &c->baked.space, &options, &c->faults));
    for (uint32_t i = 0; i < c->faults.count;
         i++) { // snapping moves no wall that does not stop all
        sl_fault *fault = &c->faults.items[i];
        for (int k = 0; k < 2 && fault->kind == SL_FAULT_GAP; k++)
            fault->stays |= fault->walls[k] != UINT32_MAX && fault->walls[k] >= c->map.wall_count;
    }
    return SL_OK;
}

/// Mends a copy of the map as read, and looks at what is left.
static sl_status mend_copy(sl_context *context, const check_plan *plan, const sl_map *map,
                           double gap, sl_mend_account *account, checked *after) {
    SL_TRY(sl_map_copy(context, map, &after->map));
    SL_TRY(sl_map_mend(context, &after->map, gap, &plan->pipeline.input.clean, account));
    if (!after->map.wall_count) return SL_OK;
    after->mended = true;
    return examine(context, plan, gap, after);
}

/// Closes gaps and writes the map.
static sl_status mend(sl_context *context, const check_plan *plan, faults_report *report,
                      checked *after) {
    const checked *c = report->found;
    SL_TRY(mend_copy(context, plan, &c->map, c->gap, &report->snap, after));
    if (!after->map.wall_count)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--snap %s: closing gaps up to %g (--gap) leaves no wall", plan->snap,
                       c->gap);
    SL_TRY(sl_map_write(context, &after->map, NULL, plan->snap));
    report->mended = plan->snap;
    report->left = after;
    return SL_OK;
}

/// The least number of two digits that is not below a width.
static double round_up(double width) {
    const double unit = pow(10, floor(log10(width)) - 1);
    char text[SL_NUMBER_TEXT];
    snprintf(text, sizeof text, "%.2g", width);
    double rounded = strtod(text, NULL);
    if (rounded < width) {
        snprintf(text, sizeof text, "%.2g", rounded + unit);
        rounded = strtod(text, NULL);
    }
    return rounded;
}

/// Tries whether snapping closes the narrowest leak, if it is small against the map. Openings that
/// are larger are meant.
static sl_status suggest_gap(sl_context *context, const check_plan *plan, const checked *c,
                             faults_report *report) {
    const sl_faults *faults = &c->faults;
    if (!faults->counts[SL_FAULT_LEAK] || !(faults->items[0].size > c->gap)) return SL_OK;
    const double gap = round_up(faults->items[0].size);
    if (gap > 20 * sl_usual_gap(&c->map)) return SL_OK;
    checked after = {0};
    sl_mend_account account = {0};
    const sl_status status = mend_copy(context, plan, &c->map, gap, &account, &after);
    if (status == SL_OK && after.map.wall_count &&
        after.faults.counts[SL_FAULT_LEAK] < faults->counts[SL_FAULT_LEAK])
        report->helps = gap;
    destroy(context, &after);
    // A trial that cannot be done is no help, and no failure.
    return status == SL_NO_MEMORY || status == SL_CANCELLED ? status : SL_OK;
}

/// What to type where an opening is in doubt, and how much is inside then.
static sl_status decide_opening(sl_context *context, const check_plan *plan, const checked *c,
                                faults_report *report) {
    if (c->inside != SL_INSIDE_OPENING) return SL_OK;
    SL_TRY(pipeline_decide_opening(context, &plan->pipeline, &c->baked.map, &c->baked.space,
                                   &report->opening));
    if (report->opening.start) return SL_OK;
    return pipeline_share_by_entrance(context, &plan->pipeline, &c->baked.map, &c->baked.space,
                                      report->opening.entrance, &report->inside);
}

/// Reads the map; of a baked file, the map that it was made from.
static sl_status read_map(sl_context *context, const map_pipeline *pipeline, sl_map *map) {
    SL_TRY(input_read_either(context, pipeline->path, &pipeline->input, map));
    return pipeline_prepare(context, pipeline, map);
}

static sl_status check(command_console *console, const check_plan *plan, checked *c,
                       checked *after) {
    sl_context *context = console->context;
    SL_TRY(read_map(context, &plan->pipeline, &c->map));
    SL_TRY(examine(context, plan, plan->faults.gap, c));
    SL_TRY(pipeline_note_sealed(context, &plan->pipeline, &c->baked.map, &c->baked.space));
    faults_report report = {.input = plan->pipeline.path,
                            .found = c,
                            .thin =
                                plan->faults.thin > 0 ? plan->faults.thin : sl_usual_gap(&c->map),
                            .most = plan->most,
                            .picture = plan->output,
                            .given = &plan->pipeline.given};
    if (plan->snap)
        SL_TRY(mend(context, plan, &report, after));
    else
        SL_TRY(suggest_gap(context, plan, c, &report));
    SL_TRY(decide_opening(context, plan, plan->snap ? after : c, &report));
    const uint32_t *counts = c->faults.counts;
    if (!plan->snap && (counts[SL_FAULT_GAP] || counts[SL_FAULT_LEAK]))
        SL_TRY(sl_suggest_weld(context, &c->map, &report.weld));
    if (plan->output) {
        sl_draw_options drawing = plan->drawing;
        drawing.faults = &c->faults;
        SL_TRY(built_pictures()->file(context, &c->baked, &drawing, plan->output));
    }
    console->fault = plan->strict && checked_has_fault(c);
    progress_line_clear(&console->line);
    if (plan->json) return faults_print_json(context, &report);
    return faults_print(context, &report);
}

// --- every map of a file

static void add_refused(json_fields *fields, const char *name, const sl_context *context) {
    json_open_item(fields);
    json_add_text(fields, "map", name);
    json_add_text(fields, "error", sl_context_message(context));
    json_close(fields);
}

/// A map that is broken does not keep others from being checked.
static sl_status check_each(command_console *console, const check_plan *plan,
                            const sl_map_list *list, json_fields *fields, size_t *broken) {
    sl_context *context = console->context;
    for (size_t i = 0; i < list->count; i++) {
        const char *name = list->names[i];
        checked c = {0};
        check_plan one = *plan;
        one.pipeline.input.import.map = name;
        sl_status status = read_map(context, &one.pipeline, &c.map);
        if (status == SL_OK) status = examine(context, &one, plan->faults.gap, &c);
        progress_line_clear(&console->line);
        const bool refused = status == SL_BAD_INPUT || status == SL_UNSUPPORTED;
        if (plan->json && refused)
            add_refused(fields, name, context);
        else if (plan->json && status == SL_OK)
            faults_add_line(fields, name, &c);
        else if (refused)
            printf("%s: %s\n", name,
                   text_without_folder(sl_context_message(context), plan->pipeline.path));
        else if (status == SL_OK)
            faults_print_line(name, &c);
        console->fault |= status == SL_OK && plan->strict && checked_has_fault(&c);
        *broken += refused;
        destroy(context, &c);
        if (!refused) SL_TRY(status);
    }
    return SL_OK;
}

static sl_status check_every(command_console *console, const check_plan *plan) {
    sl_context *context = console->context;
    const char *path = plan->pipeline.path;
    if (plan->for_one || plan->pipeline.input.import.map)
        return sl_fail(context, SL_BAD_ARGUMENT, "--every-map: --%s is for one map",
                       plan->for_one ? plan->for_one : "map");
    sl_map_choice choice;
    sl_context_set_limits(context, &plan->pipeline.input.limits);
    SL_TRY(sl_map_choice_read(context, path, &choice));
    size_t broken = 0;
    json_fields fields = json_begin();
    json_add_text(&fields, "file", path);
    json_open_list(&fields, "maps");
    sl_status status = choice.maps.count ? check_each(console, plan, &choice.maps, &fields, &broken)
                                         : sl_fail(context, SL_BAD_ARGUMENT,
                                                   "--every-map: %s does not name maps", path);
    json_close_list(&fields);
    if (plan->json && status == SL_OK)
        status = json_print(context, &fields);
    else
        json_drop(&fields);
    if (status == SL_OK && broken)
        status = sl_fail(context, SL_BAD_INPUT, "%s: %zu of %zu maps cannot be checked", path,
                         broken, choice.maps.count);
    sl_map_choice_destroy(context, &choice);
    return status;
}

static void print_tables(void) {
    pipeline_print_subdivisions();
    input_print_formats();
}

sl_status cmd_check(command_console *console, int argc, char **argv) {
    check_plan plan = {.pipeline = pipeline_default(), .drawing = built_draw_options(), .most = 10};
    plan.pipeline.channel = SL_STOPS_STEPS; // a window keeps a room closed, a curtain does not
    const option_table pipeline = pipeline_option_table(&plan.pipeline);
    const option_spec options[] = {
        {"gap", 0, "SIZE",
         "list gaps up to this width (default: 1/1000 of the map's diagonal, at most 1/8 of a "
         "usual wall)",
         .number = &plan.faults.gap, .over_0 = true},
        {"thin", 0, "SIZE", "list cells thinner than this (same default)",
         .number = &plan.faults.thin, .over_0 = true, .rare = true},
        {"snap", 0, "FIXED.map", "close such gaps, and write the result as map text",
         .text = &plan.snap, .check = CHECK_FILE, .endings = ".map", .given = &plan.for_one},
        {"output", 'o', "PICTURE", "draw the plan with all faults: .png, .svg or .pdf",
         .text = &plan.output, .check = CHECK_PICTURE, .given = &plan.for_one},
        {"width", 0, "PX", "width of the picture: 64 to 20000 pixels or points",
         .number = &plan.drawing.width, .least = SL_DRAW_WIDTH_MIN, .most = SL_DRAW_WIDTH_MAX,
         .given = &plan.for_one, .without = "output", .rare = true},
        {"dark", 0, NULL, "draw light on dark", .flag = &plan.drawing.dark, .given = &plan.for_one,
         .without = "output", .rare = true},
        {"most", 0, "N", "print up to N faults of each kind (default 10)", .count = &plan.most,
         .most = UINT32_MAX, .given = &plan.for_one, .rare = true},
        {"strict", 0, NULL, "exit with status 3 if there is a fault", .flag = &plan.strict},
        {"every-map", 0, NULL,
         "check each map of a file that holds several, such as a WAD; one line a map",
         .flag = &plan.every},
        {"json", 0, NULL, "print all faults as one JSON object", .flag = &plan.json},
        {.group = &pipeline},
    };
    const command_usage usage = {
        .name = "check",
        .synopsis = "MAP|FILE.slv [options]",
        .operands = {"MAP"},
        .what = "Lists what may be wrong with a map: leaks (openings through which a start leads "
                "out of the map), gaps between walls, overlaps, crossings, thin cells, rooms that "
                "no start reaches, and strays (what lies far away from the rest). Walls count that "
                "stop "
                "steps (--stops). Each fault has "
                "its place and the names of its walls in "
                "the file: line, layer, handle, id. The last line is the next command to run.\n"
                "\n"
                "--snap moves ends of walls by up to --gap. Faults that it cannot mend are marked "
                "with 'needs a decision'.",
        .tables = print_tables,
        .examples = "  sightline check office.map -o office-check.png\n"
                    "  sightline check doom.wad --every-map --strict\n"
                    "  sightline check plan.dxf --start 3,5\n"
                    "  sightline check plan.dxf --start 3,5 --gap 0.02 --snap plan-fixed.map",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .given = &plan.pipeline.given,
    };
    checked c = {0}, after = {0};
    bool helped;
    const char *input;
    SL_TRY(options_parse(console, &usage, argc, argv, &input, &helped));
    if (helped) return SL_OK;
    SL_TRY(pipeline_plan(console->context, input, &plan.pipeline));
    const sl_status status =
        plan.every ? check_every(console, &plan) : check(console, &plan, &c, &after);
    destroy(console->context, &c);
    destroy(console->context, &after);
    return status;
}

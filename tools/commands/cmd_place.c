/// `sightline place`: where viewpoints must stand, with a proof.
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "inputs/pipeline.h"
#include "sightline/place_proof.h"
#include "sightline/support.h"
#include "studies/cover_report.h"
#include "studies/place_cameras.h"
#include "system/built.h"
#include "system/deadline.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct place_plan {
    const char *input, *output, *picture, *proof, *verify;
    map_pipeline pipeline;
    door_choice doors;
    camera_plan cameras;
    double time_limit;
    bool json;
    sl_draw_options drawing;
} place_plan;

typedef struct place_work {
    sl_baked baked;
    sl_query *query;
    sl_placement placement;
    bool chooses; ///< among given places: `chosen`, and not `placement`
    camera_work chosen;
    sl_cameras cameras; ///< the viewpoints of the placement
    sl_viewpoint *viewpoints;
    sl_coverage coverage;
    cover_path route; ///< a single one that is to be seen, to draw it
    double seconds;
    bool late;     ///< the time limit or Ctrl-C ended it
    bool doubtful; ///< what is inside
} place_work;

enum { MANY_CELLS = 100 };

/// Keeps what there is when the time is over.
static sl_status place(command_console *console, const place_plan *plan, place_work *w) {
    const double start = sl_seconds();
    const char *const things = plan->cameras.see ? plan->cameras.see : plan->cameras.path;
    deadline limit = {.at = plan->time_limit > 0 ? start + plan->time_limit : INFINITY,
                      .asks = true};
    sl_context *context;
    sl_place_options options = sl_place_options_default();
    options.program = built_cover_program();
    SL_TRY(deadline_open(console, &limit, &context));
    sl_status status = w->chooses ? sl_place_area_cover(context, w->query, &w->chosen.task,
                                                        &options, &w->chosen.placed)
                                  : sl_place(context, w->query, &options, &w->placement);
    // One in each cell is what the search begins with. To survey many takes long.
    const uint32_t count = w->placement.count;
    const bool found = count && (count < MANY_CELLS || count != w->baked.space.inside_count);
    if (status == SL_CANCELLED && limit.late && (found || w->chosen.placed.count)) {
        status = SL_OK;
        w->late = true;
    }
    const unsigned places = (unsigned)w->chosen.task.place_count;
    if (status == SL_CANCELLED && limit.late && places)
        status = sl_fail(console->context, SL_CANCELLED,
                         "no set of viewpoints was found in time: give more with --time-limit, or "
                         "choose among fewer than %u places and headings: a longer step, as "
                         "--from walls:STEP or grid:STEP, or fewer --headings",
                         places);
    else if (status == SL_CANCELLED && limit.late)
        status = sl_fail(console->context, SL_CANCELLED,
                         "no set of viewpoints was found in time: give more with --time-limit");
    else if (status != SL_OK)
        sl_fail(console->context, status, "%s%s%s", things ? things : "", things ? ": " : "",
                sl_context_message(context));
    sl_context_destroy(context);
    w->seconds = sl_seconds() - start;
    return status;
}

/// Which numbers up to `most` are names already.
static void find_taken(const sl_cameras *cameras, size_t most, bool *taken) {
    char text[32];
    for (size_t i = 0; i < cameras->count; i++) {
        const char *name = cameras->items[i].name;
        const unsigned long long number = name ? strtoull(name, NULL, 10) : 0;
        snprintf(text, sizeof text, "%llu", number);
        if (name && number <= most && strcmp(name, text) == 0) taken[number] = true;
    }
}

/// Viewpoints without a name get their number, as reports and pictures show it; where one that
/// stands already has this name, the next number that is free.
static sl_status name_all(sl_context *context, sl_cameras *cameras) {
    char name[32];
    // Each name that is taken moves the numbers on by one at most.
    const size_t most = 2 * cameras->count;
    bool *taken = sl_alloc_array(context, most + 1, sizeof *taken);
    if (!taken) return SL_NO_MEMORY;
    find_taken(cameras, most, taken);
    sl_status status = SL_OK;
    for (size_t i = 0, last = 0; i < cameras->count && status == SL_OK; i++) {
        sl_camera *camera = &cameras->items[i];
        if (camera->name) continue;
        if (last < i) last = i;
        while (taken[++last]) continue;
        snprintf(name, sizeof name, "%zu", last);
        camera->name = sl_copy_text(context, name, strlen(name));
        if (!camera->name) status = SL_NO_MEMORY;
    }
    sl_free(context, taken);
    return status;
}

/// What the viewpoints see, found anew.
static sl_status survey(sl_context *context, place_work *w) {
    if (w->chooses) SL_TRY(camera_work_chosen(context, &w->chosen, &w->cameras));
    for (uint32_t i = 0; i < w->placement.count; i++) {
        const sl_camera camera = {.view = w->placement.viewpoints[i], .cost = 1};
        SL_TRY(sl_cameras_add(context, &w->cameras, &camera));
    }
    SL_TRY(name_all(context, &w->cameras));
    SL_TRY(cover_viewpoints(context, &w->cameras, &w->viewpoints));
    return sl_coverage_make(context, w->query, w->viewpoints, w->cameras.count, &w->coverage);
}

static sl_status print_json(sl_context *context, const place_work *w, const cover_report *report) {
    const sl_placement *p = &w->placement;
    json_fields fields = json_begin();
    json_add_text(&fields, "input", report->input);
    if (w->chooses) {
        camera_work_add_json(&fields, &w->chosen);
    } else {
        json_add_count(&fields, "lower", p->lower);
        json_add_count(&fields, "upper", p->upper);
        json_add_flag(&fields, "optimal", p->lower == p->upper);
        json_add_count(&fields, "witnesses", p->witness_count);
        json_add_count(&fields, "rounds", p->rounds);
    }
    json_add_real(&fields, "seconds", w->seconds);
    cover_add_json(&fields, report);
    camera_work_add_things_json(&fields, &w->chosen);
    return json_print(context, &fields);
}

/// Whether the check confirms less than a proof among given places says.
static bool is_refuted(const sl_area_placement *placed, const sl_place_area_verdict *v) {
    return v->lower < placed->lower || v->upper > placed->upper || !v->sees_as_all;
}

/// Writes the proof of a choice, if --verify is going to confirm it. Adds places for that.
static sl_status write_chosen_proof(sl_context *context, const place_plan *plan, place_work *w) {
    sl_area_placement *placed = &w->chosen.placed;
    sl_place_area_verdict v;
    uint32_t added;
    SL_TRY(sl_place_area_proof_complete(context, w->query, &w->chosen.task, placed, &added, &v));
    if (is_refuted(placed, &v))
        return sl_fail(context, SL_UNSUPPORTED,
                       "the check of the proof does not confirm it, as where borders of several "
                       "views lie on one line but for rounding: %s is not written. Turn or move "
                       "such places a little, or leave --proof out",
                       plan->proof);
    if (added)
        sl_note(
            context,
            "%u %s added for slivers that the search overlooked: with %s the proof holds exactly",
            (unsigned)added, added == 1 ? "viewpoint was" : "viewpoints were",
            added == 1 ? "it" : "them");
    return sl_place_area_proof_write(context, w->query, &w->chosen.task, placed, plan->proof);
}

/// Checks a proof among given places.
static sl_status verify_chosen(command_console *console, const place_plan *plan, place_work *w) {
    sl_place_area_verdict v;
    sl_context *context = console->context;
    const sl_place_area *task = &w->chosen.task;
    SL_TRY(sl_place_area_proof_read(context, w->query, task, plan->verify, &w->chosen.placed));
    SL_TRY(sl_place_area_proof_check(context, w->query, task, &w->chosen.placed, &v));
    console->refuted = is_refuted(&w->chosen.placed, &v);
    progress_line_clear(&console->line);
    if (!plan->json) {
        camera_work_print_verdict(&w->chosen, &v, sl_map_digits(sl_query_map(w->query)));
        return SL_OK;
    }
    json_fields fields = json_begin();
    json_add_text(&fields, "input", plan->input);
    json_add_flag(&fields, "verified", !console->refuted);
    camera_work_add_verdict_json(&fields, &w->chosen, &v);
    return json_print(context, &fields);
}

/// Checks a proof by other code than that which found it, and says what holds.
static sl_status verify(command_console *console, const place_plan *plan, place_work *w) {
    sl_place_verdict v;
    if (w->chooses) return verify_chosen(console, plan, w);
    SL_TRY(sl_place_proof_read(console->context, w->query, plan->verify, &w->placement));
    SL_TRY(sl_place_proof_check(console->context, w->query, &w->placement, &v));
    const sl_placement *p = &w->placement;
    const bool lower = v.lower >= p->lower;
    console->refuted = !lower || !v.sees_all;
    progress_line_clear(&console->line);
    if (plan->json) {
        json_fields fields = json_begin();
        json_add_text(&fields, "input", plan->input);
        json_add_flag(&fields, "verified", !console->refuted);
        json_add_count(&fields, "lower", v.lower);
        json_add_count(&fields, "upper", p->upper);
        json_add_flag(&fields, "sees_all", v.sees_all);
        json_add_flag(&fields, "optimal", v.sees_all && v.lower == p->upper);
        return json_print(console->context, &fields);
    }
    if (v.sees_all)
        printf("The %u viewpoints see everything.\n", (unsigned)p->count);
    else
        printf("The viewpoints do not see everything: not what is beside (%.9g, %.9g).\n",
               v.unseen.x, v.unseen.y);
    if (v.has_extra)
        printf("The lower bound does not hold: a place at (%.9g, %.9g) sees witnesses that no "
               "column has together.\n",
               v.extra.x, v.extra.y);
    else if (!lower)
        printf("The lower bound of %u does not hold: %u is proven.\n", (unsigned)p->lower,
               (unsigned)v.lower);
    else
        printf("At least %u are needed, wherever they stand.\n", (unsigned)v.lower);
    if (!console->refuted && v.lower == p->upper) printf("So no fewer can do it.\n");
    return SL_OK;
}

/// What a viewpoint may be needed for that sees no area alone.
static void needs_of(const camera_plan *cameras, const camera_work *w, char *text, size_t size) {
    if (cameras->cover > 1)
        snprintf(text, size, "each point must be seen by %u viewpoints", (unsigned)cameras->cover);
    else
        snprintf(text, size, "%s",
                 w->lines.ends.count    ? "doors and ways must be seen, too"
                 : camera_work_scans(w) ? "walls must be scanned"
                 : cameras->network     ? "lines of sight must join all viewpoints"
                                        : "for slivers that are too thin to measure");
}

static sl_status work(command_console *console, const place_plan *plan, place_work *w) {
    sl_context *context = console->context;
    const sl_baked *baked = &w->baked;
    w->chooses = camera_plan_chooses(&plan->cameras);
    SL_TRY(camera_plan_check(context, &plan->cameras,
                             plan->proof    ? "proof"
                             : plan->verify ? "verify"
                                            : NULL));
    const unsigned effects =
        SL_EFFECT_DOOR | (w->chooses ? SL_EFFECT_RANGE | SL_EFFECT_ONEWAY : 0u);
    SL_TRY(pipeline_read_space(context, &plan->pipeline, "place", effects, NULL, &w->baked));
    SL_TRY(
        pipeline_prove_inside(context, &plan->pipeline, &baked->map, &baked->space, &w->doubtful));
    SL_TRY(doors_shut(context, &plan->doors, &w->baked));
    SL_TRY(sl_query_over(context, &baked->space, &baked->map, NULL, &w->query));
    if (w->chooses)
        SL_TRY(camera_work_prepare(context, &plan->cameras, &plan->pipeline.input, baked, w->query,
                                   &w->chosen));
    if ((plan->proof || plan->verify) && w->chosen.task.line_count)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--%s does not go with doors and paths that must be seen",
                       plan->proof ? "proof" : "verify");
    if (plan->verify) return verify(console, plan, w);
    if (plan->picture)
        SL_TRY(built_pictures()->check_sheet(context, baked, &plan->drawing, plan->picture));
    SL_TRY(place(console, plan, w));
    if (plan->proof && w->chooses)
        SL_TRY(write_chosen_proof(context, plan, w));
    else if (plan->proof)
        SL_TRY(sl_place_proof_write(context, w->query, &w->placement, plan->proof));
    SL_TRY(survey(context, w));
    char needs[64];
    needs_of(&plan->cameras, &w->chosen, needs, sizeof needs);
    const cover_report report = {
        plan->input, plan->pipeline.input.import.map, baked, &w->cameras, &w->coverage, needs};
    char sentence[256], said[320], proof[400], caption[700];
    if (w->chooses)
        SL_TRY(camera_work_survey(context, &plan->cameras, w->query, &report, w->viewpoints,
                                  &w->chosen));
    cover_sentence(&report, sentence, sizeof sentence);
    if (w->chooses)
        camera_work_say(&w->chosen, w->late, said, sizeof said);
    else
        sl_placement_say(&w->placement, "viewpoint", w->late, said, sizeof said);
    snprintf(proof, sizeof proof, "%s%s",
             w->doubtful ? "Of what counts as inside, which is doubtful (see the notes): " : "",
             said);
    snprintf(caption, sizeof caption, "%s.\n%s", sentence, proof);
    if (plan->output) SL_TRY(sl_cameras_write(context, &w->cameras, plan->output));
    if (plan->picture) {
        SL_TRY(camera_work_trace(context, &report, w->query, w->viewpoints, &w->chosen, &w->route));
        SL_TRY(cover_draw(context, &report, w->route.count ? &w->route : NULL, caption,
                          &plan->drawing, plan->picture));
    }
    progress_line_clear(&console->line);
    if (plan->json) return print_json(context, w, &report);
    if (console->quiet && (plan->output || plan->picture || plan->proof)) return SL_OK;
    cover_print(&report);
    camera_work_print_things(&w->chosen, &report);
    printf("\n%s\n", proof);
    return w->chooses ? camera_work_print_blind(context, &w->chosen, &plan->cameras, w->query,
                                                baked->map.unit)
                      : SL_OK;
}

static void clear(sl_context *context, place_work *w) {
    sl_coverage_destroy(context, &w->coverage);
    sl_free(context, w->viewpoints);
    sl_cameras_destroy(context, &w->cameras);
    sl_placement_destroy(context, &w->placement);
    cover_path_destroy(context, &w->route);
    camera_work_destroy(context, &w->chosen);
    sl_query_destroy(context, w->query);
    sl_baked_destroy(context, &w->baked);
}

sl_status cmd_place(command_console *console, int argc, char **argv) {
    place_plan plan = {.pipeline = pipeline_default(),
                       .cameras = camera_plan_default(),
                       .drawing = built_draw_options()};
    const option_table pipeline = pipeline_option_table(&plan.pipeline);
    const option_table cameras = camera_option_table(&plan.cameras);
    option_table picture = picture_option_table(&plan.drawing, "picture", true);
    for (size_t i = 0; i < picture.count; i++) picture.items[i].rare = true;
    option_table doors = door_option_table(&plan.doors);
    for (size_t i = 1; i < doors.count; i++) doors.items[i].rare = true;
    const option_spec options[] = {
        {.group = &cameras},
        {"output", 'o', "FILE.csv", "the viewpoints as a table, which cover and isovist read",
         .text = &plan.output, .check = CHECK_FILE, .endings = ".csv .txt"},
        {"picture", 0, "PICTURE", "draw viewpoints and what they see: .png, .svg or .pdf",
         .text = &plan.picture, .check = CHECK_PICTURE},
        {"proof", 0, "FILE", "write a proof of both bounds (.json), for --verify",
         .text = &plan.proof, .check = CHECK_FILE, .endings = ".json"},
        {"verify", 0, "FILE",
         "check a proof for this map by other code, and trust nothing in it; --from and the "
         "options with it are those of the run that wrote it; exit with status 1 if it does not "
         "hold",
         .text = &plan.verify, .is_input = true, .rare = true},
        {"time-limit", 0, "SECONDS",
         "stop then, and give the best set and both bounds; so does Ctrl-C (default: no limit)",
         .number = &plan.time_limit, .over_0 = true, .needs = "seconds, more than 0"},
        {"json", 0, NULL, "print one JSON object", .flag = &plan.json},
        {.group = &doors},
        {.group = &picture},
        {.group = &pipeline},
    };
    const command_usage usage = {
        .name = "place",
        .synopsis = "MAP|FILE.slv [options]",
        .operands = {"MAP|FILE.slv"},
        .what = "Finds the fewest viewpoints that see all that is inside, and proves that no "
                "fewer can (the art gallery problem). By default they look all round and without "
                "limit, and may stand anywhere inside. With --from they are chosen among given "
                "places: cameras on walls, with a field of view and a range. Then everything is "
                "seen that these places can see, and none of their choices is smaller; the rest is "
                "shown. Angles are degrees, counter-clockwise from +x.",
        .examples = "  sightline place gallery.dxf -o cameras.csv --picture cameras.png\n"
                    "  sightline place office.map --from walls --fov 90 --range 12 -o cameras.csv\n"
                    "  sightline place office.map --from grid:2 --count 4 --json\n"
                    "  sightline place office.map --proof proof.json\n"
                    "  sightline place --verify proof.json office.map\n"
                    "  sightline place office.map --from walls --fov 90 --proof cameras.json\n"
                    "  sightline place office.map --from walls --fov 90 --verify cameras.json",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .given = &plan.pipeline.given,
    };
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, &plan.input, &helped));
    if (helped) return SL_OK;
    place_work w = {0};
    sl_status status = pipeline_plan(console->context, plan.input, &plan.pipeline);
    if (status == SL_OK) status = work(console, &plan, &w);
    clear(console->context, &w);
    return status;
}

/// `sightline cover`: what given viewpoints see together.
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "inputs/pipeline.h"
#include "sightline/support.h"
#include "studies/cover_path.h"
#include "studies/cover_report.h"
#include "studies/cover_zones.h"
#include "studies/room_table.h"
#include "system/built.h"

#include <stdio.h>

typedef struct cover_plan {
    const char *operands[2]; ///< the map, and the table
    const char *picture, *zones, *path, *output;
    map_pipeline pipeline;
    door_choice doors;
    sl_viewpoint like; ///< what rows of the table leave out
    bool skip_outside; ///< pass over rows that lie outside the map or in solid ground
    bool rooms;
    double door_width;
    bool json;
    sl_draw_options drawing;
} cover_plan;

typedef struct cover_work {
    sl_baked baked;
    sl_query *query;
    sl_cameras cameras;
    sl_viewpoint *viewpoints;
    sl_coverage coverage;
    zone_list zones;
    room_table rooms;
    zone_covers covers; ///< by zone or room
    cover_path path;
} cover_work;

/// Takes away rows outside the map or in solid ground, each with a note.
static void skip_outside(sl_context *context, const cover_plan *plan, cover_work *w) {
    const sl_space *space = &w->baked.space;
    size_t kept = 0;
    for (size_t i = 0; i < w->cameras.count; i++) {
        sl_camera *camera = &w->cameras.items[i];
        const uint32_t cell = sl_space_locate(space, camera->view.at);
        if (cell != SL_NO_CELL && !space->cells[cell].solid) {
            w->cameras.items[kept++] = *camera;
            continue;
        }
        sl_note(context, "%s:%u: %s lies %s; it is passed over", plan->operands[1], camera->line,
                camera->name ? camera->name : "the point",
                cell == SL_NO_CELL ? "outside the map" : "in solid ground");
        sl_free(context, camera->name);
    }
    w->cameras.count = kept;
}

static sl_status print_json(sl_context *context, const cover_work *w, const cover_report *report) {
    json_fields fields = json_begin();
    json_add_text(&fields, "input", report->input);
    cover_add_json(&fields, report);
    if (w->covers.what) cover_zones_add_json(&fields, &w->covers);
    if (w->path.count) cover_path_add_json(&fields, &w->path);
    return json_print(context, &fields);
}

static sl_status check_plan(sl_context *context, const cover_plan *plan) {
    if (plan->output && (plan->zones != NULL) + (plan->path != NULL) + plan->rooms > 1)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "-o makes one table: give one of --zones, --rooms and --path");
    if (plan->zones && plan->rooms)
        return sl_fail(context, SL_BAD_ARGUMENT, "give one of --zones and --rooms");
    if (plan->door_width > 0 && !plan->rooms)
        return sl_fail(context, SL_BAD_ARGUMENT, "--door-width is of no use without --rooms");
    return SL_OK;
}

static sl_status work(command_console *console, cover_plan *plan, cover_work *w) {
    sl_context *context = console->context;
    SL_TRY(check_plan(context, plan));
    SL_TRY(pipeline_plan(context, plan->operands[0], &plan->pipeline));
    if (plan->rooms) pipeline_take_drawn_doors(context, &plan->pipeline);
    const sl_baked *baked = &w->baked;
    SL_TRY(pipeline_read_space(
        context, &plan->pipeline, "cover",
        SL_EFFECT_RANGE | SL_EFFECT_MIRROR | SL_EFFECT_DOOR | SL_EFFECT_ONEWAY, NULL, &w->baked));
    SL_TRY(pipeline_need_inside(context, &plan->pipeline, &baked->map, &baked->space, ""));
    SL_TRY(doors_shut(context, &plan->doors, &w->baked));
    SL_TRY(sl_cameras_read(context, plan->operands[1], &plan->like, &w->cameras));
    if (plan->skip_outside) skip_outside(context, plan, w);
    if (!w->cameras.count)
        return sl_fail(context, SL_BAD_INPUT,
                       "%s: all viewpoints lie outside the map or in solid ground",
                       plan->operands[1]);
    SL_TRY(cover_check_places(context, plan->operands[1], &baked->space, &w->cameras));
    SL_TRY(sl_query_over(context, &baked->space, &baked->map, NULL, &w->query));
    if (baked->map.mirror_count)
        sl_note(context, "mirrors are walls here: cover counts what is seen directly");
    cover_note_headings(context, plan->operands[1], &w->cameras, "--fov or a column fov");
    SL_TRY(cover_viewpoints(context, &w->cameras, &w->viewpoints));
    SL_TRY(sl_coverage_make(context, w->query, w->viewpoints, w->cameras.count, &w->coverage));
    const cover_report report = {
        plan->operands[0], plan->pipeline.input.import.map, baked, &w->cameras, &w->coverage, NULL};
    cover_note_blind(context, plan->operands[1], &report);
    if (plan->zones) {
        SL_TRY(zones_read(context, "zones", plan->zones, &plan->pipeline.input, &baked->map,
                          &w->zones));
        SL_TRY(cover_zones_make(context, &report, &w->zones, &w->covers));
    }
    if (plan->rooms) {
        SL_TRY(room_table_make(context, baked, plan->door_width, &w->rooms));
        room_table_note(context, &w->rooms);
        SL_TRY(cover_rooms_make(context, &report, &w->rooms.rooms, &w->covers));
    }
    if (plan->path)
        SL_TRY(cover_path_make(context, &report, w->query, w->viewpoints, plan->path, &w->path));
    if (plan->output)
        SL_TRY(plan->path ? cover_path_write(context, &w->path, plan->output)
                          : cover_table_write(context, &report, &w->covers, plan->output));
    char caption[256];
    cover_sentence(&report, caption, sizeof caption);
    if (plan->picture)
        SL_TRY(cover_draw(context, &report, plan->path ? &w->path : NULL, caption, &plan->drawing,
                          plan->picture));
    progress_line_clear(&console->line);
    if (plan->json) return print_json(context, w, &report);
    if (console->quiet && (plan->output || plan->picture)) return SL_OK;
    cover_print(&report);
    if (w->covers.what) cover_zones_print(&report, &w->covers);
    if (plan->path) cover_path_print(&report, &w->path);
    return SL_OK;
}

static void clear(sl_context *context, cover_work *w) {
    sl_coverage_destroy(context, &w->coverage);
    cover_path_destroy(context, &w->path);
    zones_destroy(context, &w->zones);
    room_table_destroy(context, &w->rooms);
    cover_zones_destroy(context, &w->covers);
    sl_free(context, w->viewpoints);
    sl_cameras_destroy(context, &w->cameras);
    sl_query_destroy(context, w->query);
    sl_baked_destroy(context, &w->baked);
}

sl_status cmd_cover(command_console *console, int argc, char **argv) {
    cover_plan plan = {
        .pipeline = pipeline_default(), .like = {.fov = 360}, .drawing = built_draw_options()};
    const option_table pipeline = pipeline_option_table(&plan.pipeline);
    const option_table picture = picture_option_table(&plan.drawing, "picture", true);
    const option_table doors = door_option_table(&plan.doors);
    const option_spec options[] = {
        {"output", 'o', "FILE.csv",
         "a table: a row for each zone or room, with --path for each part that is not seen, else "
         "for each "
         "viewpoint",
         .text = &plan.output, .check = CHECK_FILE, .endings = ".csv .txt"},
        {"zones", 0, "ZONES",
         "what is seen of each zone: names of objects in the map, a drawing of closed outlines, or "
         "a table of corners (.csv: name,x,y)",
         .text = &plan.zones, .is_input = true},
        {"rooms", 0, NULL,
         "how much of each room is seen by 0, 1, 2, 3 or more; rooms are those that 'rooms' lists",
         .flag = &plan.rooms},
        {"door-width", 0, "W",
         "with --rooms: openings narrower than this are doors (default: 1.1 m if the unit is "
         "known, else found from the plan)",
         .number = &plan.door_width, .over_0 = true, .rare = true},
        {"path", 0, "PATH",
         "which parts of a path no viewpoint sees: a path of the map, or the points of a CSV table",
         .text = &plan.path, .is_input = true},
        {"signs", 0, NULL,
         "the table has signs: where they can be read. They face their heading, and they are read "
         "from --range, or from 100 times the column letters; at an angle from nearer",
         .flag = &plan.like.sign},
        {"picture", 0, "PICTURE", "draw classes of coverage: .png, .svg or .pdf",
         .text = &plan.picture, .check = CHECK_PICTURE},
        {"json", 0, NULL, "print one JSON object", .flag = &plan.json},
        {"fov", 0, "DEG", "width of view cones that the table does not give (default: 360)",
         .number = &plan.like.fov, .over_0 = true, .most = 360},
        {"range", 0, "R", "how far viewpoints see where the table does not say (default: no limit)",
         .number = &plan.like.range, .over_0 = true},
        {"skip-outside", 0, NULL,
         "pass over viewpoints that lie outside the map or in solid ground, and name them",
         .flag = &plan.skip_outside},
        {.group = &doors},
        {.group = &picture},
        {.group = &pipeline},
    };
    const command_usage usage = {
        .name = "cover",
        .synopsis = "MAP|FILE.slv TABLE [options]",
        .operands = {"MAP|FILE.slv", "TABLE"},
        .what = "Shows what given viewpoints see together: how much of the inside 0, 1, 2, 3 or "
                "more of them see, the blind spots by size, what each viewpoint sees and what it "
                "alone sees. The table has the columns x and y, and maybe name, heading, fov, "
                "range, height, tilt, letters, sign; commas, semicolons or tabs stand between "
                "them. Angles are "
                "degrees, counter-clockwise from +x; a camera of some height and tilt has a dead "
                "zone below.",
        .examples = "  sightline cover gallery.dxf cameras.csv --picture cover.png\n"
                    "  sightline cover office.map cameras.csv --fov 90 --range 12\n"
                    "  sightline cover office.map cameras.csv --zones parts.dxf -o parts.csv\n"
                    "  sightline cover office.map cameras.csv --rooms -o rooms.csv\n"
                    "  sightline cover office.map signs.csv --signs --path escape.csv",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .given = &plan.pipeline.given,
    };
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, plan.operands, &helped));
    if (helped) return SL_OK;
    cover_work w = {0};
    const sl_status status = work(console, &plan, &w);
    clear(console->context, &w);
    return status;
}

/// `sightline eye`: what one viewpoint sees, by every culling method.
#include "arguments/help.h"
#include "arguments/names.h"
#include "arguments/options.h"
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "inputs/inputs.h"
#include "reports/json_print.h"
#include "reports/report.h"
#include "sightline/draw.h"
#include "sightline/support.h"
#include "studies/eye_files.h"
#include "studies/eye_run.h"
#include "system/built.h"

#include <inttypes.h>
#include <stdio.h>

// --- the report

/// Prints what is seen by mirror: the cells of each method, and the parts of the region by the
/// number of reflections.
static void print_mirrored(const eye_run *run) {
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    uint64_t rounded = 0;
    printf("\nby mirror, %" PRIu32 " reflection%s at most:\n", run->mirror_depth,
           run->mirror_depth == 1 ? "" : "s");
    for (size_t i = 0; i < count; i++) {
        const eye_result *result = &run->results[i];
        rounded += result->rounded;
        if (!result->mirrored)
            printf("  %-20s refused: does not know mirrors\n", methods[i].name);
        else
            printf("  %-20s %-13s %7" PRIu32 " %6.2f %%\n", methods[i].name,
                   sl_guarantee_name(methods[i].guarantee), result->mirrored_count,
                   100 * result->mirrored_share);
    }
    for (uint32_t depth = 1; depth <= run->mirror_depth; depth++) {
        size_t parts = 0;
        double area = 0;
        for (size_t i = 0; i < run->mirrored.part_count; i++) {
            const sl_mirror_part *part = &run->mirrored.parts[i];
            if (part->depth != depth) continue;
            parts++;
            area += sl_region_area(&part->region);
        }
        if (parts)
            printf("  in %" PRIu32 " mirror%s: %zu part%s of the region, area %.6g\n", depth,
                   depth == 1 ? "" : "s", parts, parts == 1 ? "" : "s", area);
    }
    if (rounded) printf("  %" PRIu64 " images of the eye and its rays are rounded\n", rounded);
}

static void eye_print(const sl_baked *baked, const eye_run *run) {
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    char x[SL_NUMBER_TEXT], y[SL_NUMBER_TEXT], seconds[SECONDS_TEXT];
    sl_number_write(run->view.eye.x, x);
    sl_number_write(run->view.eye.y, y);
    printf("eye at %s,%s: cell %" PRIu32 ", %s sight\n", x, y, run->cell,
           sight_name(baked->visibility.sight));
    puts("\n  method               guarantee       cells     area     nodes  orientations     "
         "time");
    for (size_t i = 0; i < count; i++) {
        const eye_result *result = &run->results[i];
        seconds_write(result->seconds, "u", seconds);
        printf("  %-20s %-13s %7" PRIu32 " %6.2f %% %9" PRIu64 " %13" PRIu64 " %8s\n",
               methods[i].name, sl_guarantee_name(methods[i].guarantee), result->count,
               100 * result->share, result->account.nodes, result->account.orientations, seconds);
    }
    seconds_write(run->region_seconds, "u", seconds);
    printf("  %-20s %-13s %7s %6.2f %% %9" PRIu64 " %13s %8s\n", "visible_area",
           sl_guarantee_name(SL_EXACT), "", 100 * run->region_share, run->region.portals_passed, "",
           seconds);
    const sl_region_measures m = sl_region_measure(&run->region);
    printf("\nvisible region: area %.6g, perimeter %.6g, %zu corners\n", m.area, m.perimeter,
           run->region.count);
    if (run->has_mirrors) print_mirrored(run);
    if (!run->results[0].count)
        printf("\nthe file has no visible set for cell %" PRIu32
               ": it was baked for inside cells only\n",
               run->cell);
}

/// {"area": a, "perimeter": p, "polygon": [[x, y], ...]}
static void add_region(json_fields *fields, const sl_region *region) {
    const sl_region_measures measures = sl_region_measure(region);
    json_open(fields, "region");
    json_add_real(fields, "area", measures.area);
    json_add_real(fields, "perimeter", measures.perimeter);
    json_add_points(fields, "polygon", region->points, region->count);
    json_close(fields);
}

/// "mirrors": the chain by the map's numbers, from 0, the eye's end first.
static void add_chain(json_fields *fields, const sl_mirrored_region *region, uint32_t number) {
    uint32_t length = 0;
    for (uint32_t i = number; i != SL_NO_PART; i = region->parts[i].parent) length++;
    sl_json_writer *json = json_add(fields, "mirrors");
    sl_json_put_list(json);
    for (; length; length--) {
        uint32_t part = number;
        for (uint32_t i = 1; i < length; i++) part = region->parts[part].parent;
        sl_json_put_integer(json, region->parts[part].mirror);
    }
    sl_json_put_end(json, ']');
}

/// [{"mirrors": [0], "area": a, "rounded": false, "polygon": [...], "image": [...]}, ...]
static void add_parts(json_fields *fields, const sl_mirrored_region *region) {
    json_open_list(fields, "mirrored_region");
    for (uint32_t i = 0; i < region->part_count; i++) {
        const sl_mirror_part *part = &region->parts[i];
        json_open_item(fields);
        add_chain(fields, region, i);
        json_add_real(fields, "area", sl_region_area(&part->region));
        json_add_flag(fields, "rounded", part->rounded);
        json_add_points(fields, "polygon", part->region.points, part->region.count);
        json_add_points(fields, "image", part->image, part->region.count);
        json_close(fields);
    }
    json_close_list(fields);
}

static void add_mirrored(json_fields *fields, const sl_baked *baked, const eye_run *run) {
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    json_open(fields, "mirrored");
    for (size_t i = 0; i < count; i++)
        if (run->results[i].mirrored)
            json_add_members(fields, methods[i].name, run->results[i].mirrored,
                             baked->space.cell_count);
    json_close(fields);
    add_parts(fields, &run->mirrored);
}

static sl_status eye_print_json(sl_context *context, const sl_baked *baked, const eye_run *run,
                                const eye_objects *objects) {
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    json_fields fields = json_begin();
    json_add_count(&fields, "cell", run->cell);
    if (sl_partial_begun(&baked->partial)) json_add_flag(&fields, "finished", false);
    json_open(&fields, "methods");
    for (size_t i = 0; i < count; i++)
        json_add_members(&fields, methods[i].name, run->results[i].cells, baked->space.cell_count);
    json_close(&fields);
    add_region(&fields, &run->region);
    if (run->has_mirrors) add_mirrored(&fields, baked, run);
    eye_objects_add_json(&fields, baked, objects);
    return json_print(context, &fields);
}

// --- the command

typedef struct eye_plan {
    const char *input, *at_text, *output;
    door_choice doors;
    sl_point at;
    double look, fov, range;
    const char *look_given, *fov_given, *range_given, *picture_given;
    uint32_t mirror_depth;
    sl_draw_options drawing;
    option_list objects;
    bool json;
} eye_plan;

static sl_status check_view(sl_context *context, const eye_plan *plan, const sl_space *space) {
    if (!plan->at_text)
        return sl_fail(context, SL_BAD_ARGUMENT, "--at is missing: where the eye is");
    if (!plan->look_given != !plan->fov_given)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--look and --fov make a view cone together; without both the eye looks "
                       "all round");
    return input_locate(context, "--at", plan->at_text, space, plan->at, NULL);
}

/// Adds the objects to the picture, and the region past them; the whole `region` without objects.
static sl_status add_objects(sl_context *context, const sl_space *space, const eye_objects *objects,
                             const sl_region *region, seen_parts *parts, sl_drawn_box *boxes,
                             sl_draw_options *options) {
    for (size_t i = 0; i < objects->count; i++)
        boxes[i] = (sl_drawn_box){objects->boxes[i].box, objects->boxes[i].blocks,
                                  objects->seen[i] || objects->mirrored[i]};
    options->boxes = boxes;
    options->box_count = objects->count;
    return seen_parts_add_region(context, space, objects->count ? &objects->region : region, parts);
}

static sl_status draw_space(sl_context *context, const eye_plan *plan, const sl_baked *baked,
                            const eye_run *run, const eye_objects *objects) {
    sl_draw_options options = plan->drawing;
    sl_eye_layer layers[SL_EYE_LAYERS_MOST];
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    for (size_t i = 0; i < count; i++)
        layers[i] = (sl_eye_layer){methods[i].name, run->results[i].cells};
    if (objects->count) layers[count++] = (sl_eye_layer){"past_objects", objects->cells};
    seen_parts parts = {0};
    sl_drawn_box *boxes = sl_alloc_array(context, objects->count, sizeof *boxes);
    sl_status status = boxes ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK)
        status =
            add_objects(context, &baked->space, objects, &run->region, &parts, boxes, &options);
    if (status == SL_OK)
        status = seen_parts_add(context, &baked->space,
                                objects->count ? &objects->mirrored_region : &run->mirrored, false,
                                &parts);
    if (status == SL_OK)
        status = built_pictures()->eye(context, baked, &run->view, layers, count, parts.items,
                                       parts.count, &options, plan->output);
    seen_parts_destroy(context, &parts);
    sl_free(context, boxes);
    return status;
}

/// In the picture, one-way glass that is dark for the eye is a wall.
static sl_status draw(sl_context *context, const eye_plan *plan, const sl_baked *baked,
                      sl_query *query, const eye_run *run, const eye_objects *objects) {
    sl_baked dark = *baked;
    if (!baked->map.oneway_count) return draw_space(context, plan, baked, run, objects);
    dark.space = (sl_space){0};
    SL_TRY(sl_query_copy_space(context, query, plan->at, &dark.space));
    const sl_status status = draw_space(context, plan, &dark, run, objects);
    sl_space_destroy(context, &dark.space);
    return status;
}

static sl_status tell(command_console *console, const eye_plan *plan, const sl_baked *baked,
                      sl_query *query, const eye_run *run, const eye_objects *objects) {
    if (plan->output && output_has_ending(plan->output, EYE_FILES))
        SL_TRY(eye_files_write(console->context, baked, run, objects, plan->look, plan->fov,
                               plan->output));
    else if (plan->output)
        SL_TRY(draw(console->context, plan, baked, query, run, objects));
    progress_line_clear(&console->line);
    if (plan->json) return eye_print_json(console->context, baked, run, objects);
    if (console->quiet && plan->output) return SL_OK;
    eye_print(baked, run);
    eye_objects_print(objects);
    return SL_OK;
}

/// Shut doors are walls of `baked` by now.
static sl_status ask(command_console *console, const eye_plan *plan, const sl_baked *baked,
                     const sl_view *view, sl_query *query) {
    sl_context *context = console->context;
    eye_run run;
    sl_query_set_doors(context, query, true);
    SL_TRY(sl_query_set_mirror_depth(context, query, plan->mirror_depth));
    if (plan->range_given) SL_TRY(sl_query_set_range(context, query, plan->range));
    SL_TRY(eye_run_make(context, baked, query, view, plan->mirror_depth, !plan->json, &run));
    eye_objects objects = {0};
    sl_status status = eye_objects_read(context, &plan->objects, &baked->map, &objects);
    if (status == SL_OK) status = eye_objects_run(context, query, &run, !plan->json, &objects);
    if (status == SL_OK) status = tell(console, plan, baked, query, &run, &objects);
    eye_objects_destroy(context, &objects);
    eye_run_destroy(context, &run);
    return status;
}

static sl_status look(command_console *console, const eye_plan *plan, sl_baked *baked) {
    sl_context *context = console->context;
    sl_query *query;
    SL_TRY(check_view(context, plan, &baked->space));
    SL_TRY(sl_query_create(context, baked, &query));
    const sl_view view = sl_query_view(query, plan->at, plan->look, plan->fov);
    const sl_status status = ask(console, plan, baked, &view, query);
    sl_query_destroy(context, query);
    return status;
}

static void print_methods(void) {
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    puts("\nmethods, each within the one before:");
    for (size_t i = 0; i < count; i++)
        help_name(methods[i].name, 20, methods[i].what, sl_guarantee_name(methods[i].guarantee));
}

sl_status cmd_eye(command_console *console, int argc, char **argv) {
    eye_plan plan = {.fov = 360, .mirror_depth = 1, .drawing = built_draw_options()};
    option_table picture = picture_option_table(&plan.drawing, "output", false);
    for (size_t i = 0; i < picture.count; i++) picture.items[i].given = &plan.picture_given;
    const option_table doors = door_option_table(&plan.doors);
    const option_spec options[] = {
        {"at", 0, "X,Y", "the viewpoint", .point = &plan.at, .text = &plan.at_text},
        {"look", 0, "DEG", "heading in degrees, counter-clockwise from +x", .number = &plan.look,
         .given = &plan.look_given},
        {"fov", 0, "DEG", "width of the view cone in degrees (default: 360)", .number = &plan.fov,
         .most = 360, .needs = "degrees from 0 to 360 are needed", .given = &plan.fov_given},
        {"output", 'o', "PICTURE|TABLE",
         "a picture (.png, .svg, .pdf), or regions and cells (.geojson, .csv)",
         .text = &plan.output, .check = CHECK_PICTURE, .endings = EYE_FILES},
        {"json", 0, NULL, "print one JSON object: the cells that each method keeps",
         .flag = &plan.json},
        {.group = &doors},
        {"range", 0, "R",
         "see no farther than R, 0: no limit (default: the map's range); for the exact method and "
         "the region",
         .number = &plan.range, .needs = "must not be negative", .given = &plan.range_given},
        {"mirror-depth", 0, "N", "largest number of reflections, up to 16 (default 1)",
         .count32 = &plan.mirror_depth, .most = 16},
        {"object", 0, "BOX",
         "a box X0,Y0,X1,Y1 that is not in the map, or an object of the map by name: is it seen? "
         "',block' behind it lets it block sight; may be given several times",
         .list = &plan.objects},
        {.group = &picture},
    };
    const command_usage usage = {
        .name = "eye",
        .synopsis = "FILE.slv --at X,Y [--look DEG --fov DEG] [options]",
        .operands = {"FILE.slv"},
        .what =
            "Shows what one viewpoint sees: the cells that each culling method keeps, their share "
            "of the area, and the time.",
        .tables = print_methods,
        .examples = "  sightline eye office.slv --at 53,20\n"
                    "  sightline eye office.slv --at 53,20 --look 180 --fov 60 -o eye.png\n"
                    "  sightline eye office.slv --at 53,20 -o eye.geojson\n"
                    "  sightline eye office.slv --at 53,20 --object 40,18,41,21,block -o eye.png",
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, &plan.input, &helped));
    if (helped) return SL_OK;
    if (plan.picture_given && output_has_ending(plan.output, EYE_FILES))
        return sl_fail(console->context, SL_BAD_ARGUMENT, "--%s is for a picture, and %s is none",
                       plan.picture_given, plan.output);
    sl_baked baked = {0};
    SL_TRY(input_read_baked(console->context, plan.input, &baked));
    sl_status status = sl_effects_check(
        console->context, &baked.map, "eye",
        SL_EFFECT_DOOR | SL_EFFECT_MIRROR | SL_EFFECT_ONEWAY | SL_EFFECT_RANGE, NULL);
    if (status == SL_OK) status = doors_shut(console->context, &plan.doors, &baked);
    if (status == SL_OK) status = look(console, &plan, &baked);
    sl_baked_destroy(console->context, &baked);
    return status;
}

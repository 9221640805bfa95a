#include "commands.h"
#include "doors_shut.h"
#include "eye_objects.h"
#include "eye_report.h"
#include "eye_run.h"
#include "inputs.h"
#include "options.h"
#include "pictures.h"
#include "seen_parts.h"
#include "sightline/draw.h"
#include "sightline/support.h"

/// The operand and options as they are given.
typedef struct eye_texts {
    const char *input, *at, *look, *fov, *output, *width, *shut, *mirror_depth, *range;
    bool json, dark;
    sl_option_list objects;
} eye_texts;

static sl_status read_view(sl_context *context, const eye_texts *texts, const sl_space *space,
                           sl_view *view) {
    sl_point eye = {0};
    double heading = 0, fov = 360;
    if (!texts->at) return sl_fail(context, SL_BAD_ARGUMENT, "--at is missing: where the eye is");
    if (!texts->look != !texts->fov)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--look and --fov make a view cone together; without both the eye looks "
                       "all round");
    SL_TRY(sl_option_point(context, "--at", texts->at, &eye));
    SL_TRY(sl_option_number(context, "--look", texts->look, &heading));
    SL_TRY(sl_option_number(context, "--fov", texts->fov, &fov));
    if (fov < 0 || fov > 360)
        return sl_fail(context, SL_BAD_ARGUMENT, "--fov %s: degrees from 0 to 360 are needed",
                       texts->fov);
    if (sl_space_locate(space, eye) == SL_NO_CELL)
        return sl_input_fail_outside(context, "--at", texts->at, space->bounds);
    *view = sl_view_cone(eye, heading, fov, sl_eye_reach(space));
    return SL_OK;
}

/// What is to be drawn of the objects: the region past them, and themselves.
static sl_status add_objects(sl_context *context, const sl_space *space,
                             const sl_eye_objects *objects, sl_seen_parts *parts,
                             sl_drawn_box *boxes, sl_draw_options *options) {
    for (size_t i = 0; i < objects->count; i++)
        boxes[i] = (sl_drawn_box){objects->boxes[i].box, objects->boxes[i].blocks,
                                  objects->seen[i] || objects->mirrored[i]};
    options->boxes = boxes;
    options->box_count = objects->count;
    if (!objects->count) return SL_OK;
    return sl_seen_parts_add_region(context, space, &objects->region, parts);
}

static sl_status draw(sl_context *context, const eye_texts *texts, const sl_baked *baked,
                      const sl_eye_run *run, const sl_eye_objects *objects) {
    sl_draw_options options;
    sl_eye_layer layers[SL_EYE_LAYERS_MOST];
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    SL_TRY(sl_picture_plan(context, texts->width, NULL, texts->dark, &options));
    for (size_t i = 0; i < count; i++)
        layers[i] = (sl_eye_layer){methods[i].name, run->results[i].cells};
    if (objects->count) layers[count++] = (sl_eye_layer){"past_objects", objects->cells};
    sl_seen_parts parts = {0};
    sl_drawn_box *boxes = sl_alloc_array(context, objects->count, sizeof *boxes);
    sl_status status = boxes ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK)
        status = add_objects(context, &baked->space, objects, &parts, boxes, &options);
    if (status == SL_OK)
        status = sl_seen_parts_add(context, &baked->space,
                                   objects->count ? &objects->mirrored_region : &run->mirrored,
                                   false, &parts);
    if (status == SL_OK)
        status = sl_draw_eye(context, baked, &run->view, layers, count, parts.items, parts.count,
                             &options, texts->output);
    sl_seen_parts_destroy(context, &parts);
    sl_free(context, boxes);
    return status;
}

static sl_status tell(sl_console *console, const eye_texts *texts, const sl_baked *baked,
                      const sl_eye_run *run, const sl_eye_objects *objects) {
    if (texts->output) SL_TRY(draw(console->context, texts, baked, run, objects));
    sl_progress_line_clear(&console->line);
    if (texts->json) return sl_eye_print_json(console->context, baked, run, objects);
    if (console->quiet && texts->output) return SL_OK;
    sl_eye_print(baked, run);
    sl_eye_objects_print(objects);
    return SL_OK;
}

/// Glass that is dark for the eye becomes walls.
static sl_status darken(sl_context *context, sl_baked *baked, sl_point eye) {
    const sl_filtered_space filtered = {.eye = &eye};
    sl_space walled;
    if (!baked->map.oneway_count) return SL_OK;
    if (baked->visibility.mirrored.cell_count)
        return sl_fail(context, SL_UNSUPPORTED,
                       "glass that is dark from an eye may not be so in a mirror: bake the map "
                       "--without mirror or --without oneway");
    SL_TRY(sl_filtered_space_make(context, &baked->space, &filtered, NULL, &walled));
    sl_space_destroy(context, &baked->space);
    baked->space = walled;
    sl_visibility trees = {.trees = baked->visibility.trees};
    baked->visibility.trees = (sl_stab_trees){0};
    sl_visibility_destroy(context, &trees);
    return SL_OK;
}

static sl_status look(sl_console *console, const eye_texts *texts, sl_baked *baked) {
    sl_context *context = console->context;
    sl_view view;
    sl_eye_run run;
    SL_TRY(read_view(context, texts, &baked->space, &view));
    SL_TRY(sl_picture_check(context, texts->input, "-o", texts->output));
    SL_TRY(darken(context, baked, view.eye));
    uint64_t depth = 1;
    SL_TRY(sl_option_count(context, "--mirror-depth", texts->mirror_depth, 16, &depth));
    double range = baked->map.range;
    SL_TRY(sl_option_number(context, "--range", texts->range, &range));
    if (range < 0)
        return sl_fail(context, SL_BAD_ARGUMENT, "--range %s: must not be negative", texts->range);
    SL_TRY(sl_eye_run_make(context, baked, &view, (uint32_t)depth, range, !texts->json, &run));
    sl_eye_objects objects = {0};
    sl_status status = sl_eye_objects_read(context, &texts->objects, &baked->map, &objects);
    if (status == SL_OK) status = sl_eye_objects_run(context, baked, &run, !texts->json, &objects);
    if (status == SL_OK) status = tell(console, texts, baked, &run, &objects);
    sl_eye_objects_destroy(context, &objects);
    sl_eye_run_destroy(context, &run);
    return status;
}

static void print_methods(void) {
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    puts("\nmethods, each within the one before:");
    for (size_t i = 0; i < count; i++)
        printf("  %-20s%s; %s\n", methods[i].name, methods[i].what,
               sl_guarantee_name(methods[i].guarantee));
}

sl_status sl_cmd_eye(sl_console *console, int argc, char **argv) {
    eye_texts t = {0};
    const sl_option_spec options[] = {
        {"at", 0, "X,Y", NULL, &t.at, "where the eye is"},
        {"shut", 0, "NAME,...", NULL, &t.shut,
         "doors that are shut, the others being open; 'none':\nall open; without it as the map "
         "says"},
        {"mirror-depth", 0, "N", NULL, &t.mirror_depth,
         "how often mirrors reflect a sightline, 0 to 16;\n1 without it"},
        {"range", 0, "R", NULL, &t.range,
         "how far the exact method and the region see, 0 for no\nlimit; without it as far as the "
         "map says"},
        {"object", 0, "BOX", NULL, NULL,
         "X0,Y0,X1,Y1 or the name of the map's object: something\nthat stands or moves where the "
         "bake knows nothing of\nit: is it seen? With ',block' behind it, it blocks sight;\nmay "
         "be given several times"},
        {"look", 0, "DEG", NULL, &t.look,
         "which way it looks, in degrees counter-clockwise\nfrom +x"},
        {"fov", 0, "DEG", NULL, &t.fov,
         "how wide, 0 to 360 degrees in all; without --look\nand --fov all round"},
        {"output", 'o', "PICTURE", NULL, &t.output,
         "draw it too: .png, .svg or .pdf, by the ending"},
        {"width", 0, "PX", NULL, &t.width, "of the picture, 64 to 20000 pixels or points"},
        {"dark", 0, NULL, &t.dark, NULL, "the picture light on dark"},
        {"json", 0, NULL, &t.json, NULL, "print JSON: the cells that each method keeps"},
    };
    const sl_command_usage usage = {
        .name = "eye",
        .synopsis = "FILE.slv --at X,Y [--look DEG --fov DEG] [options]",
        .operands = {"FILE.slv"},
        .what = "Tells what one viewpoint sees: the cells that each culling method keeps, their "
                "share of\nthe area, and what it costs.",
        .tables = print_methods,
        .examples = "  sightline eye office.slv --at 53,20\n"
                    "  sightline eye office.slv --at 53,20 --look 180 --fov 60 -o eye.png\n"
                    "  sightline eye office.slv --at 53,20 --object 40,18,41,21,block -o eye.png",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .repeats = "object",
        .repeated = &t.objects,
    };
    bool helped;
    SL_TRY(sl_option_parse(console, &usage, argc, argv, &t.input, &helped));
    if (helped) return SL_OK;
    if ((t.width || t.dark) && !t.output)
        return sl_fail(console->context, SL_BAD_ARGUMENT,
                       "--width and --dark are for the picture, which needs -o");
    sl_baked baked = {0};
    SL_TRY(sl_input_read_baked(console->context, t.input, &baked));
    sl_status status =
        sl_effects_check(console->context, &baked.map, "eye",
                         SL_EFFECT_DOOR | SL_EFFECT_MIRROR | SL_EFFECT_ONEWAY | SL_EFFECT_RANGE);
    if (status == SL_OK) status = sl_doors_shut(console->context, t.shut, &baked);
    if (status == SL_OK) status = look(console, &t, &baked);
    sl_baked_destroy(console->context, &baked);
    return status;
}

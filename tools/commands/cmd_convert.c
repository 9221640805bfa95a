/// `sightline convert`: any map that can be read, in any format that can be written.
#include "arguments/help.h"
#include "arguments/options.h"
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "inputs/inputs.h"
#include "sightline/support.h"
#include "system/built.h"

#include <stdio.h>

/// In a plan that is drawn, an opening wider than usual may be the entrance. What is written says
/// so where it can, so that the same is inside.
static sl_status keep_wide_entrance(sl_context *context, const sl_map_format *format,
                                    const sl_clean_options *clean, sl_map *map) {
    sl_map copy = {0};
    if (!map->entrance_may_be_wide || !(format->keeps & SL_KEEPS_ENTRANCE)) return SL_OK;
    sl_status status = sl_map_copy(context, map, &copy);
    if (status == SL_OK) status = sl_map_clean(context, &copy, clean, NULL);
    if (status == SL_OK) status = sl_map_find_inside(context, &copy, clean, NULL);
    if (status == SL_OK && copy.interior.by == SL_ENTRANCE_WIDE) {
        map->entrance = copy.interior.width;
        map->entrance_by_doors = false;
    }
    sl_map_destroy(context, &copy);
    return status;
}

static sl_status convert(sl_context *context, const char *input, const input_options *reading,
                         bool clean, const sl_map_format *format, const char *output) {
    sl_map map = {0};
    SL_TRY(input_read_either(context, input, reading, &map));
    sl_status status = keep_wide_entrance(context, format, &reading->clean, &map);
    if (status == SL_OK && clean) status = input_clean(context, reading, &map, NULL);
    if (status == SL_OK) status = sl_map_settle_ground(context, &map);
    if (status == SL_OK) status = sl_map_write(context, &map, format, output);
    sl_map_destroy(context, &map);
    return status;
}

/// The formats that are written, and those that are only read.
static void print_formats(void) {
    sl_context *context = sl_context_create(NULL);
    if (!context) return;
    size_t count;
    (void)built_use_formats(context); // with no memory: the formats that are always there
    const sl_map_format *formats = sl_map_formats(context, &count);
    puts("\nformats that are written, by the ending of OUT:");
    for (size_t i = 0; i < count; i++)
        if (formats[i].write) help_name(formats[i].endings, 28, formats[i].name, formats[i].what);
    sl_context_destroy(context);
    input_print_formats();
}

/// Without --in-place, no output is the input. In place only our own formats are written: a file of
/// another program holds more than a map.
static sl_status choose_output(sl_context *context, const char *input, bool in_place,
                               const char *name, const char **output,
                               const sl_map_format **format) {
    const char *const option = in_place ? "--in-place" : "-o";
    if (in_place && *output && !output_is_same(input, *output))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--in-place and -o %s: give one of them; --in-place replaces %s", *output,
                       input);
    if (in_place && !output_is_plain_file(input))
        return sl_fail(context, SL_BAD_ARGUMENT, "--in-place: %s is no file that can be replaced",
                       input);
    if (in_place) *output = input;
    if (!*output) *output = "-";
    if (!**output) return output_check_file(context, option, *output, NULL);
    if (in_place && !output_has_ending(input, ".map .txt"))
        return output_fail_ending(context, option, input, ".map .txt");
    SL_TRY(sl_map_format_to_write(context, option, *output, name, format));
    SL_TRY(output_check_file(context, option, *output, NULL));
    if (in_place || output_check_apart(context, input, option, *output) == SL_OK) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "-o %s: is the input itself, which would be lost; give another name%s", *output,
                   output_has_ending(*output, ".map .txt") ? ", or --in-place" : "");
}

sl_status cmd_convert(command_console *console, int argc, char **argv) {
    const char *input = NULL, *output = NULL, *name = NULL;
    const sl_map_format *format = NULL;
    input_options reading = input_options_default();
    bool clean = false, in_place = false;
    const option_table reading_table = input_option_table(&reading);
    const option_spec options[] = {
        {"output", 'o', "OUT",
         "the file; its ending chooses the format (default: map text to standard output)",
         .text = &output},
        {"format", 0, "NAME", "the format, where the ending fits several (.json)", .text = &name},
        {"in-place", 0, NULL, "replace IN itself, a .map or .txt file", .flag = &in_place},
        {"clean", 0, NULL, "weld, merge and split walls, as 'bake' does (default: as read)",
         .flag = &clean},
        {.group = &reading_table},
    };
    const command_usage usage = {
        .name = "convert",
        .synopsis = "IN [-o OUT] [options]",
        .operands = {"IN"},
        .what = "Writes a map, or the map of a baked file, in another format. Reports what that "
                "format cannot hold.",
        .tables = print_formats,
        .examples = "  sightline convert plan.txt -o plan.map\n"
                    "  sightline convert tower.ug --slice 1040 -o floor.map\n"
                    "  sightline convert office.map --clean --in-place\n"
                    "  sightline convert cellar.dd2vtt --clean -o clean.dd2vtt\n"
                    "  sightline convert office.map -o scene.json --format foundry",
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, &input, &helped));
    if (helped) return SL_OK;
    if (reading.clean.weld >= 0 && !clean)
        return sl_fail(console->context, SL_BAD_ARGUMENT,
                       "--weld is for --clean, which is not given");
    SL_TRY(choose_output(console->context, input, in_place, name, &output, &format));
    return convert(console->context, input, &reading, clean, format, output);
}

/// `sightline convert`: any map that can be read, as map text or ASCII plan.
#include "commands.h"
#include "inputs.h"
#include "options.h"
#include "outputs.h"
#include "sightline/support.h"

static sl_status convert(sl_context *context, const char *input, const input_options *reading,
                         bool clean, const char *output) {
    sl_map map = {0};
    SL_TRY(input_read_either(context, input, reading, &map));
    sl_status status = clean ? input_clean(context, reading, &map, NULL) : SL_OK;
    if (status == SL_OK) status = sl_map_settle_ground(context, &map);
    const bool plan = input_ends_with(output, ".txt");
    if (status == SL_OK && plan && map.comment_count)
        sl_note(context, "%s: an ASCII plan has no place for comments, which are left out", output);
    if (status == SL_OK)
        status = plan ? sl_map_write_plan(context, &map, output)
                      : sl_map_write_text(context, &map, output);
    sl_map_destroy(context, &map);
    return status;
}

/// Without --in-place, no output is the input.
static sl_status choose_output(sl_context *context, const char *input, bool in_place,
                               const char **output) {
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
    SL_TRY(output_check_file(context, option, *output, ".map .txt"));
    if (in_place || output_check_apart(context, input, option, *output) == SL_OK) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "-o %s: is the input itself, which would be lost; give another name, or "
                   "--in-place",
                   *output);
}

sl_status cmd_convert(command_console *console, int argc, char **argv) {
    const char *input = NULL, *output = NULL;
    input_options reading = input_options_default();
    bool clean = false, in_place = false;
    const option_table reading_table = input_option_table(&reading);
    const option_spec options[] = {
        {"output", 'o', "OUT.map|OUT.txt",
         "map text or an ASCII plan, by the ending;\nwithout it, or for -, map text on stdout",
         .text = &output},
        {"in-place", 0, NULL, "replace IN itself, which is then named .map or .txt",
         .flag = &in_place},
        {.group = &reading_table},
        {"clean", 0, NULL,
         "weld, merge and split walls as bake does before it\nsubdivides (default: they stay as "
         "read)",
         .flag = &clean},
    };
    const command_usage usage = {
        .name = "convert",
        .synopsis = "IN [-o OUT.map|OUT.txt] [options]",
        .operands = {"IN"},
        .what =
            "Writes any map that can be read, or the map of a baked file (by its ending, .slv),\n"
            "as map text or as an ASCII plan.",
        .tables = input_print_formats,
        .examples = "  sightline convert plan.txt -o plan.map\n"
                    "  sightline convert tower.ug --slice 1040 -o floor.map\n"
                    "  sightline convert office.map --clean --in-place",
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, &input, &helped));
    if (helped) return SL_OK;
    if (reading.clean.weld >= 0 && !clean)
        return sl_fail(console->context, SL_BAD_ARGUMENT,
                       "--weld is for --clean, which is not given");
    SL_TRY(choose_output(console->context, input, in_place, &output));
    return convert(console->context, input, &reading, clean, output);
}

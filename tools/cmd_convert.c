/// `sightline convert`: any map that can be read, as map text or ASCII plan.
#include "commands.h"
#include "inputs.h"
#include "options.h"
#include "sightline/support.h"

static sl_status convert(sl_context *context, const char *input, const input_options *reading,
                         bool clean, const char *output) {
    sl_map map = {0};
    SL_TRY(input_read_either(context, input, reading, &map));
    sl_status status = clean ? input_clean(context, reading, &map, NULL) : SL_OK;
    if (status == SL_OK) status = sl_map_settle_ground(context, &map);
    if (status == SL_OK)
        status = input_ends_with(output, ".txt") ? sl_map_write_plan(context, &map, output)
                                                 : sl_map_write_text(context, &map, output);
    sl_map_destroy(context, &map);
    return status;
}

sl_status cmd_convert(command_console *console, int argc, char **argv) {
    const char *input = NULL, *output = NULL;
    input_options reading = input_options_default();
    bool clean = false;
    const option_table reading_table = input_option_table(&reading);
    const option_spec options[] = {
        {"output", 'o', "OUT.map|OUT.txt",
         "map text or an ASCII plan, by the ending;\nwithout it, or for -, map text on stdout",
         .text = &output},
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
                    "  sightline convert tower.ug --slice 1040 -o floor.map",
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, &input, &helped));
    if (helped) return SL_OK;
    if (reading.clean.weld >= 0 && !clean)
        return sl_fail(console->context, SL_BAD_ARGUMENT,
                       "--weld is for --clean, which is not given");
    if (!output) output = "-";
    const bool to_stdout = output[0] == '-' && !output[1];
    if (!to_stdout && !input_ends_with(output, ".map") && !input_ends_with(output, ".txt"))
        return sl_fail(console->context, SL_BAD_ARGUMENT,
                       "-o %s: end the name in .map for map text or in .txt for an ASCII plan",
                       output);
    return convert(console->context, input, &reading, clean, output);
}

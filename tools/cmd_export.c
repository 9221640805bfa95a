#include "built.h"
#include "commands.h"
#include "inputs.h"
#include "options.h"
#include "sightline/support.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static sl_name_table format_names(const sl_context *context) {
    size_t count;
    const sl_export_format *formats = sl_export_formats(context, &count);
    return (sl_name_table){"format", formats, sizeof *formats, count};
}

static void print_formats(void) {
    sl_context *context = sl_context_create(NULL);
    if (!context) return;
    (void)sl_built_use_formats(context); // with no memory: the formats that are always there
    size_t count;
    const sl_export_format *formats = sl_export_formats(context, &count);
    puts("\nformats (the first is the default):");
    for (size_t i = 0; i < count; i++) printf("  %-10s%s\n", formats[i].name, formats[i].what);
    sl_context_destroy(context);
}

/// --wad and --map are for the formats that take them, and the WAD is not written over.
static sl_status check_wad(sl_context *context, const sl_export_format *format,
                           const sl_export_options *given, const char *output) {
    if (!format->takes_wad && (given->wad || given->map))
        return sl_fail(context, SL_BAD_ARGUMENT, "--%s: the format %s has no use for it",
                       given->wad ? "wad" : "map", format->name);
    return given->wad ? sl_output_check(context, given->wad, "-o", output) : SL_OK;
}

sl_status sl_cmd_export(sl_console *console, int argc, char **argv) {
    const char *path = NULL, *format = NULL, *output = NULL;
    sl_export_options given = {0};
    const sl_option_spec options[] = {
        {"output", 'o', "FILE", NULL, &output, "where to write; stdout, or -, without it"},
        {"format", 0, "NAME", NULL, &format, "what to write"},
        {"wad", 0, "IN.wad", NULL, &given.wad, "reject: the WAD of the map that was baked"},
        {"map", 0, "NAME", NULL, &given.map, "reject: the name of that map"},
    };
    const sl_command_usage usage = {
        .name = "export",
        .synopsis = "FILE.slv [--format NAME] [-o FILE] [options]",
        .operands = {"FILE.slv"},
        .what = "Writes a baked file for other programs: cells, portals, and what each cell sees.",
        .tables = print_formats,
        .examples =
            "  sightline export office.slv --format json -o office.json\n"
            "  sightline export e1m1.slv --format reject --wad doom.wad --map E1M1 -o new.wad",
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    bool helped;
    SL_TRY(sl_option_parse(console, &usage, argc, argv, &path, &helped));
    if (helped) return SL_OK;
    size_t chosen = 0;
    const sl_name_table names = format_names(console->context);
    SL_TRY(sl_option_choice(console->context, "--format", format, &names, &chosen));
    const sl_export_format *formats = names.items;

    if (!output) output = "-";
    SL_TRY(sl_output_check(console->context, path, "-o", output));
    SL_TRY(check_wad(console->context, &formats[chosen], &given, output));
    sl_baked baked = {0};
    SL_TRY(sl_input_read_baked(console->context, path, &baked));
    sl_progress_line_clear(&console->line);
    if (strcmp(output, "-") == 0 && isatty(STDOUT_FILENO)) console->line.shows = false;
    // Exports hold what is seen with all doors open; what is seen by mirror they have no place for.
    sl_status status = sl_effects_check(console->context, &baked.map, "export",
                                        SL_EFFECT_DOOR | SL_EFFECT_ONEWAY | SL_EFFECT_RANGE);
    if (status == SL_OK) status = formats[chosen].write(console->context, &baked, &given, output);
    sl_baked_destroy(console->context, &baked);
    return status;
}

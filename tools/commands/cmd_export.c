/// `sightline export`: a baked file for other programs.
#include "arguments/help.h"
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "inputs/inputs.h"
#include "sightline/support.h"
#include "system/built.h"
#include "system/system.h"

#include <stdio.h>
#include <string.h>

static name_table format_table(const sl_context *context) {
    size_t count;
    const sl_export_format *formats = sl_export_formats(context, &count);
    return (name_table){"format", formats, sizeof *formats, count, NULL};
}

static void print_formats(void) {
    sl_context *context = sl_context_create(NULL);
    if (!context) return;
    (void)built_use_formats(context); // with no memory: the formats that are always there
    size_t count;
    const sl_export_format *formats = sl_export_formats(context, &count);
    puts("\nformats (the first is the default):");
    for (size_t i = 0; i < count; i++) help_name(formats[i].name, 10, formats[i].what, NULL);
    sl_context_destroy(context);
}

/// Refuses options for formats that do not take them.
static sl_status check_options(sl_context *context, const sl_export_format *format,
                               const sl_export_options *given) {
    if (!(format->takes & SL_EXPORT_TAKES_WAD) && (given->wad || given->map))
        return sl_fail(context, SL_BAD_ARGUMENT, "--%s: the format %s has no use for it",
                       given->wad ? "wad" : "map", format->name);
    if (given->json_version && !(format->takes & SL_EXPORT_TAKES_VERSION))
        return sl_fail(context, SL_BAD_ARGUMENT, "--json-version: the format %s has no use for it",
                       format->name);
    if (given->prefix && !(format->takes & SL_EXPORT_TAKES_PREFIX))
        return sl_fail(context, SL_BAD_ARGUMENT, "--prefix: the format %s has no use for it",
                       format->name);
    return SL_OK;
}

/// Refuses mirrors for formats that have no place for them: the REJECT of a WAD.
static sl_status check_effects(sl_context *context, const sl_export_format *format,
                               const sl_map *map) {
    if (format->shows_mirrors) return SL_OK;
    char name[64];
    snprintf(name, sizeof name, "export --format %s", format->name);
    return sl_effects_check(context, map, name, SL_EFFECT_DOOR | SL_EFFECT_ONEWAY | SL_EFFECT_RANGE,
                            "it has one bit for a pair, and Doom no mirrors");
}

sl_status cmd_export(command_console *console, int argc, char **argv) {
    const char *path = NULL, *output = NULL, *format_given = NULL;
    size_t chosen = 0, count;
    sl_export_options given = {0};
    const option_spec options[] = {
        {"output", 'o', "FILE", "the file (default: standard output)", .text = &output,
         .check = CHECK_FILE},
        {"format", 0, "NAME", "the format (default: by the ending of FILE, else json)",
         .choice = &chosen, .names = format_table(console->context), .given = &format_given},
        {"prefix", 0, "NAME",
         "c: the beginning of all names (default: " SL_PREFIX_DEFAULT
         "), so that a program can hold several maps",
         .text = &given.prefix},
        {"json-version", 0, "N", "json: the version of the format, 1 or 2 (default 2)",
         .count32 = &given.json_version, .least = 1, .most = SL_JSON_VERSION},
        {"wad", 0, "IN.wad", "reject: the WAD of the map that was baked", .text = &given.wad,
         .is_input = true},
        {"map", 0, "NAME", "reject: the name of that map", .text = &given.map},
    };
    const command_usage usage = {
        .name = "export",
        .synopsis = "FILE.slv [--format NAME] [-o FILE] [options]",
        .operands = {"FILE.slv"},
        .what = "Writes a baked file for other programs: cells, portals, and what each cell sees.",
        .tables = print_formats,
        .examples =
            "  sightline export office.slv --format json -o office.json\n"
            "  sightline export office.slv --prefix office -o office.h\n"
            "  sightline bake doom.wad --map E1M1 --sectors --sight open -o e1m1.slv\n"
            "  sightline export e1m1.slv --format reject --wad doom.wad --map E1M1 -o a.wad",
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, &path, &helped));
    if (helped) return SL_OK;
    const sl_export_format *formats = sl_export_formats(console->context, &count);
    if (!output) output = "-";
    const name_table names = format_table(console->context);
    SL_TRY(output_choose_export(console->context, &names, "-o", output, format_given, &chosen));
    SL_TRY(check_options(console->context, &formats[chosen], &given));
    sl_baked baked = {0};
    SL_TRY(input_read_baked(console->context, path, &baked));
    progress_line_clear(&console->line);
    if (strcmp(output, "-") == 0 && system_is_terminal(stdout)) console->line.shows = false;
    sl_status status = check_effects(console->context, &formats[chosen], &baked.map);
    if (status == SL_OK) status = formats[chosen].write(console->context, &baked, &given, output);
    sl_baked_destroy(console->context, &baked);
    return status;
}

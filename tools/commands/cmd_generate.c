/// `sightline generate`: procedural maps.
#include "arguments/help.h"
#include "arguments/options.h"
#include "commands/commands.h"
#include "inputs/inputs.h"
#include "sightline/generate.h"
#include "sightline/support.h"

#include <stdio.h>
#include <string.h>

static name_table kind_table(void) {
    size_t count;
    const sl_map_kind *kinds = sl_map_kinds(&count);
    return (name_table){"kind of map", kinds, sizeof *kinds, count, NULL};
}

static void print_kinds(void) {
    size_t count;
    const sl_map_kind *kinds = sl_map_kinds(&count);
    puts("\nkinds, and what --size counts (defaults in parentheses):");
    for (size_t i = 0; i < count; i++) {
        char size[80];
        snprintf(size, sizeof size, "%s (%llu)", kinds[i].size_is,
                 (unsigned long long)kinds[i].usual_size);
        help_name(kinds[i].name, 10, kinds[i].what, size);
    }
}

static sl_status generate(sl_context *context, const char *name, const sl_generate_options *options,
                          const char *output) {
    size_t index, count;
    const name_table table = kind_table();
    SL_TRY(read_choice(context, "KIND", name, &table, &index));
    sl_map map = {0};
    SL_TRY(sl_generate(context, &sl_map_kinds(&count)[index], options, &map));
    sl_note(context, "%s: %zu walls", name, map.wall_count);
    const sl_status status = sl_map_write(context, &map, NULL, output);
    sl_map_destroy(context, &map);
    return status;
}

sl_status cmd_generate(command_console *console, int argc, char **argv) {
    sl_generate_options options = sl_generate_options_default();
    const char *kind, *output = "-";
    bool turned = false;
    char walls[48];
    snprintf(walls, sizeof walls, "at least %d are needed", SL_GENERATE_WALLS_LEAST);
    const option_spec table[] = {
        {"output", 'o', "OUT.map", "the map text (default: standard output)", .text = &output,
         .check = CHECK_FILE, .endings = ".map"},
        {"seed", 0, "N", "seed (default 1); a seed gives the same map on every machine",
         .count = &options.seed},
        {"size", 0, "N", "size, in the unit of the kind", .count = &options.size, .least = 1,
         .most = UINT32_MAX},
        {"walls", 0, "N", "choose the size for about N walls, 100 to 10^7", .count = &options.walls,
         .least = 1, .most = SL_GENERATE_WALLS_MOST, .needs = walls},
        {"open", 0, "PERCENT", "tunnels: share of open ground (default 40)",
         .number = &options.open, .needs = "0 to 100 percent are needed"},
        {"turned", 0, "DEG",
         "turn the map counter-clockwise, in doubles: walls in line stay so but for rounding",
         .number = &options.turned, .flag = &turned},
        {"turned-exact", 0, "DEG", "turn the map so that walls in line stay exactly in line",
         .number = &options.turned, .flag = &options.in_line},
    };
    const command_usage usage = {
        .name = "generate",
        .synopsis = "KIND [-o OUT.map] [options]",
        .operands = {"KIND"},
        .what = "Generates a random map with clean walls and a start in each part. Doors are 1 "
                "wide. What a cell sees does not grow with the map.",
        .tables = print_kinds,
        .examples = "  sightline generate office -o office.map\n"
                    "  sightline generate tunnels --open 10 --seed 7 -o tunnels.map\n"
                    "  sightline generate city --walls 100000 --turned 30 -o city.map",
        .options = table,
        .option_count = sizeof table / sizeof *table,
    };
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, &kind, &helped));
    if (helped) return SL_OK;
    if (turned && options.in_line)
        return sl_fail(console->context, SL_BAD_ARGUMENT,
                       "--turned and --turned-exact: give one of them");
    return generate(console->context, kind, &options, output);
}

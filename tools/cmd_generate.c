#include "commands.h"
#include "inputs.h"
#include "options.h"
#include "sightline/generate.h"
#include "sightline/support.h"

#include <stdio.h>

/// The options as they are given.
typedef struct generate_texts {
    const char *output, *seed, *size, *walls, *open, *turned, *exact;
} generate_texts;

static sl_name_table kind_table(void) {
    size_t count;
    const sl_map_kind *kinds = sl_map_kinds(&count);
    return (sl_name_table){"kind of map", kinds, sizeof *kinds, count};
}

static void print_kinds(void) {
    size_t count;
    const sl_map_kind *kinds = sl_map_kinds(&count);
    puts("\nkinds, and what --size counts (in parentheses what it is unless told):");
    for (size_t i = 0; i < count; i++)
        printf("  %-9s %s\n            %s (%llu)\n", kinds[i].name, kinds[i].what, kinds[i].size_is,
               (unsigned long long)kinds[i].usual_size);
}

static sl_status read_options(sl_context *context, const generate_texts *t,
                              sl_generate_options *options) {
    SL_TRY(sl_option_count(context, "--seed", t->seed, UINT64_MAX, &options->seed));
    SL_TRY(sl_option_count(context, "--size", t->size, UINT32_MAX, &options->size));
    SL_TRY(sl_option_count(context, "--walls", t->walls, SL_GENERATE_WALLS_MOST, &options->walls));
    SL_TRY(sl_option_number(context, "--open", t->open, &options->open));
    if (t->turned && t->exact)
        return sl_fail(context, SL_BAD_ARGUMENT, "--turned and --turned-exact: give one of them");
    SL_TRY(sl_option_number(context, "--turned", t->turned, &options->turned));
    SL_TRY(sl_option_number(context, "--turned-exact", t->exact, &options->turned));
    options->in_line = t->exact != NULL;
    // In the library these stand for what is not asked for.
    if (t->size && !options->size)
        return sl_fail(context, SL_BAD_ARGUMENT, "--size 0: at least 1 is needed");
    if (t->walls && !options->walls)
        return sl_fail(context, SL_BAD_ARGUMENT, "--walls 0: at least %d are needed",
                       SL_GENERATE_WALLS_LEAST);
    if (t->open && options->open < 0)
        return sl_fail(context, SL_BAD_ARGUMENT, "--open %s: 0 to 100 percent are needed", t->open);
    return SL_OK;
}

static sl_status generate(sl_context *context, const char *name, const generate_texts *t) {
    size_t index, count;
    const sl_name_table table = kind_table();
    sl_generate_options options = sl_generate_options_default();
    SL_TRY(sl_option_choice(context, "KIND", name, &table, &index));
    SL_TRY(read_options(context, t, &options));
    sl_map map = {0};
    SL_TRY(sl_generate(context, &sl_map_kinds(&count)[index], &options, &map));
    sl_note(context, "%s: %zu walls", name, map.wall_count);
    const sl_status status = sl_map_write_text(context, &map, t->output ? t->output : "-");
    sl_map_destroy(context, &map);
    return status;
}

sl_status sl_cmd_generate(sl_console *console, int argc, char **argv) {
    generate_texts t = {0};
    const char *kind;
    const sl_option_spec options[] = {
        {"output", 'o', "OUT.map", NULL, &t.output, "map text; without it, or for -, on stdout"},
        {"seed", 0, "N", NULL, &t.seed,
         "the same map for the same number, on every machine;\n1 unless told"},
        {"size", 0, "N", NULL, &t.size, "how large, as the kind counts it"},
        {"walls", 0, "N", NULL, &t.walls, "as large as to have about so many walls, 100 to 10^7"},
        {"open", 0, "PERCENT", NULL, &t.open,
         "tunnels: the share that is open, 40 unless told; of one\nseed the same network"},
        {"turned", 0, "DEG", NULL, &t.turned,
         "turn the plan counter-clockwise, in doubles: walls are\nthen oblique, and in line but "
         "for rounding"},
        {"turned-exact", 0, "DEG", NULL, &t.exact,
         "turn it so that walls in line stay in line to the\nlast bit"},
    };
    const sl_command_usage usage = {
        .name = "generate",
        .synopsis = "KIND [-o OUT.map] [options]",
        .operands = {"KIND"},
        .what =
            "Makes a map by chance, walls clean and starts inside. A door is 1 wide. What a cell\n"
            "sees does not grow with the map.",
        .tables = print_kinds,
        .examples = "  sightline generate office -o office.map\n"
                    "  sightline generate tunnels --open 10 --seed 7 -o tunnels.map\n"
                    "  sightline generate city --walls 100000 --turned 30 -o city.map",
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    bool helped;
    SL_TRY(sl_option_parse(console, &usage, argc, argv, &kind, &helped));
    if (helped) return SL_OK;
    if (t.output && !(t.output[0] == '-' && !t.output[1]) && !sl_input_ends_with(t.output, ".map"))
        return sl_fail(console->context, SL_BAD_ARGUMENT,
                       "-o %s: end the name in .map, for it is map text", t.output);
    return generate(console->context, kind, &t);
}

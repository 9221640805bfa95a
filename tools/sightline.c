/// The command `sightline`: finds the subcommand and runs it.
#include "commands.h"
#include "crew.h"
#include "names.h"
#include "sightline/support.h"

#include <stdio.h>
#include <string.h>

typedef struct command {
    const char *name, *summary;
    sl_status (*run)(command_console *console, int argc, char **argv);
} command;

static const command commands[] = {
    {"info", "what a map or a baked file holds", cmd_info},
    {"bake", "cells, portals and cell-to-cell visibility of a map, into a file", cmd_bake},
    {"merge", "the shards of a bake, put together", cmd_merge},
    {"check", "what is wrong with a map: leaks, gaps, overlaps, thin cells", cmd_check},
    {"compare", "every method on one map: accuracy against time, as table and chart", cmd_compare},
    {"export", "a baked file for other programs", cmd_export},
    {"reject", "the REJECT of all maps of a Doom WAD, made anew in one go", cmd_reject},
    {"explain", "why a cell does or does not see another", cmd_explain},
    {"eye", "what one viewpoint sees, by every culling method", cmd_eye},
    {"isovist", "what is seen from points: regions, their measures, heat maps", cmd_isovist},
    {"viewcells", "view cells that adapt to what is seen, for a budget", cmd_viewcells},
    {"walk", "a walk, frame by frame: culling without visible sets, with coherence", cmd_walk},
    {"regions", "what view cells see: brute force, hierarchy and multipass compared", cmd_regions},
    {"draw", "a picture of a baked file", cmd_draw},
    {"convert", "any map that can be read, as map text or ASCII plan", cmd_convert},
    {"generate", "procedural maps: maze, office, city, pillars, tunnels, tower", cmd_generate},
};
enum { COMMAND_COUNT = sizeof commands / sizeof *commands };

static void print_help(void) {
    puts("usage: sightline COMMAND ...\n\n"
         "2D cell-and-portal visibility: which cells of a map can see which.\n\ncommands:");
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        printf("  %-11s%s\n", commands[i].name, commands[i].summary);
    puts("\n'sightline COMMAND --help', or 'sightline help COMMAND', tells what each takes.\n"
         "Exit status: 0 done; 1 the work failed; 2 the arguments or an input file are wrong;\n"
         "3 'check --strict' found a fault.\n\n"
         "example:\n"
         "  sightline bake office.map -o office.slv\n"
         "  sightline draw office.slv -o office.png");
}

static sl_status run(command_console *console, int argc, char **argv) {
    if (argc < 2)
        return sl_fail(console->context, SL_BAD_ARGUMENT,
                       "no command is given; 'sightline --help' lists them");
    const char *name = argv[1];
    if (strcmp(name, "help") == 0 && argc == 3) {
        char *about[] = {argv[0], argv[2], "--help", NULL};
        return run(console, 3, about);
    }
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0 || strcmp(name, "help") == 0) {
        print_help();
        return SL_OK;
    }
    if (strcmp(name, "--version") == 0) {
        puts("sightline " SIGHTLINE_VERSION);
        return SL_OK;
    }
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        if (strcmp(name, commands[i].name) == 0)
            return commands[i].run(console, argc - 1, argv + 1);

    const name_table table = {"command", commands, sizeof *commands, COMMAND_COUNT, NULL};
    const char *near = nearest_name(&table, name);
    return sl_fail(console->context, SL_BAD_ARGUMENT,
                   "there is no command '%s'%s%s%s; 'sightline --help' lists them", name,
                   near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "");
}

/// Several processes can share a bake, and no other command.
static sl_status run_in_crew(command_console *console, int argc, char **argv) {
    if (crew_size() > 1 && !(argc > 1 && strcmp(argv[1], "bake") == 0))
        return sl_fail(console->context, SL_BAD_ARGUMENT,
                       "several processes can share 'bake' alone");
    return run(console, argc, argv);
}

int main(int argc, char **argv) {
    command_console console;
    crew_begin(&argc, &argv);
    if (!console_open(&console)) return 1;
    const sl_status status = run_in_crew(&console, argc, argv);
    const int code = console_close(&console, crew_agree(console.context, status));
    crew_end();
    return code;
}

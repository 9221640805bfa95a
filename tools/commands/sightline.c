/// The program `sightline`: finds the command and runs it.
#include "arguments/help.h"
#include "arguments/names.h"
#include "built_with.h"
#include "commands/commands.h"
#include "sightline/support.h"
#include "system/built.h"
#include "system/crew.h"
#include "system/system.h"

#include <stdio.h>
#include <string.h>

typedef struct command {
    const char *name, *summary;
    sl_status (*run)(command_console *console, int argc, char **argv);
    const char *topic; ///< a heading over it in --help; NULL: as the one before
} command;

static const command commands[] = {
    {"info", "show what a map or a baked file holds", cmd_info, "maps"},
    {"check", "find faults of a map: leaks, gaps, overlaps, thin cells", cmd_check, NULL},
    {"convert", "write a map in another format", cmd_convert, NULL},
    {"generate", "generate a maze, office, city, or another map", built_run, NULL},
    {"bake", "compute cells, portals and cell-to-cell visibility", cmd_bake, "bake"},
    {"merge", "join the shards of a bake", cmd_merge, NULL},
    {"reject", "compute the REJECT tables of a Doom WAD", built_run, NULL},
    {"export", "write a baked file for other programs", cmd_export, NULL},
    {"draw", "draw a baked file", built_run, NULL},
    {"eye", "show what one viewpoint sees", cmd_eye, "questions"},
    {"isovist", "compute visible regions, their measures and heat maps", cmd_isovist, NULL},
    {"place", "find the fewest viewpoints that see everything, with a proof", cmd_place, NULL},
    {"cover", "show what given viewpoints see together, and blind spots", cmd_cover, NULL},
    {"path", "find shortest ways among walls, and how long they are", cmd_path, NULL},
    {"vga", "compute visibility graph analysis: integration, depth, control", cmd_vga, NULL},
    {"axial", "find axial lines and their measures", cmd_axial, NULL},
    {"segments", "compute angular segment analysis of a street network", cmd_segments, NULL},
    {"rooms", "list the rooms of a plan, and what is seen of each", cmd_rooms, NULL},
    {"report", "write a report of a plan as a PDF: measures, heat maps, method", built_run, NULL},
    {"explain", "show why a cell does or does not see another", cmd_explain, NULL},
    {"batch", "run a command for many plans: a table with a row for each", cmd_batch, "studies"},
    {"compare", "run every method on one map: accuracy against time", cmd_compare, NULL},
    {"walk", "cull frame by frame, without visible sets", built_run, NULL},
    {"regions", "compute what view cells see, by several methods", built_run, NULL},
    {"viewcells", "make view cells that adapt to what is seen", built_run, NULL},
};
enum { COMMAND_COUNT = sizeof commands / sizeof *commands };

static const command *find_command(const char *name) {
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        if (strcmp(name, commands[i].name) == 0) return &commands[i];
    return NULL;
}

// --- help

#define PURPOSE "Computes what can be seen from where in a 2D map, with cells and portals."

static void print_commands(void) {
    for (size_t i = 0; i < COMMAND_COUNT; i++) {
        if (commands[i].topic) printf("\n%s:\n", commands[i].topic);
        printf("  %-11s%s\n", commands[i].name, commands[i].summary);
    }
}

static void print_help(void) {
    puts("usage: sightline COMMAND ...\n\n" PURPOSE);
    print_commands();
    puts("\n'sightline COMMAND --help' shows the options of a command.\n\n"
         "examples:\n"
         "  sightline bake office.map -o office.slv\n"
         "  sightline draw office.slv -o office.png\n\n"
         "Exit status: 0 done; 1 the work failed; 2 the arguments or an input file are\n"
         "wrong; 3 'check --strict' found a fault, or 'path' no way.");
}

static void print_manual(void) {
    puts(
        ".TH SIGHTLINE 1 \"" SIGHTLINE_DATE "\" \"sightline " SIGHTLINE_VERSION "\" \"Sightline\"\n"
        ".SH NAME\nsightline \\- 2D cell-and-portal visibility\n"
        ".SH SYNOPSIS\n.B sightline\nCOMMAND ...\n.SH DESCRIPTION\n" PURPOSE "\n.SH COMMANDS\n.nf");
    print_commands();
    puts(".fi\n.SH SEE ALSO");
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        printf(".BR sightline\\-%s (1),\n", commands[i].name);
    puts(".BR sightline\\-view (1)");
}

static void print_help_form(const char *word) {
    const help_form form = help_form_of(word);
    if (form == HELP_MAN)
        print_manual();
    else if (form != HELP_WORDS)
        print_help();
    for (size_t i = 0; form == HELP_WORDS && i < COMMAND_COUNT; i++)
        printf("%s\t\t\t%s\n", commands[i].name, commands[i].summary);
}

// --- commands

static sl_status run(command_console *console, int argc, char **argv) {
    if (argc < 2)
        return sl_fail(console->context, SL_BAD_ARGUMENT,
                       "no command is given; 'sightline --help' lists them");
    const char *name = argv[1];
    const bool asks = strcmp(name, "help") == 0;
    if (asks && argc >= 3 && strcmp(argv[2], "all") != 0) {
        char *about[] = {argv[0], argv[2], "--help", argc > 3 ? argv[3] : NULL, NULL};
        return run(console, argc > 3 ? 4 : 3, about);
    }
    if (asks || strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0) {
        print_help_form(argc > 2 ? argv[2] : NULL);
        return SL_OK;
    }
    if (strcmp(name, "--version") == 0 || strcmp(name, "-V") == 0) {
        puts("sightline " SIGHTLINE_VERSION "\nbuilt by " BUILT_BY "\nlibraries: " BUILT_WITH
             "\nlicence: " BUILT_LICENCE);
        return SL_OK;
    }
    const command *found = find_command(name);
    if (found) {
        console->summary = found->summary;
        return found->run(console, argc - 1, argv + 1);
    }

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
    static const built_part *const parts[] = {BUILT_PARTS NULL};
    command_console console;
    built_register(parts);
    system_begin(&argc, &argv);
    // First the console: from then on a signal stops all processes, and no longer just this one.
    if (!console_open(&console)) return 1;
    crew_begin(&argc, &argv);
    console.words = argv;
    console.word_count = argc;
    const sl_status status = run_in_crew(&console, argc, argv);
    const int code = console_close(&console, crew_agree(console.context, status));
    crew_end();
    return code;
}

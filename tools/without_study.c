// A build without sightline_study: its commands are refused by name.
#include "commands.h"
#include "sightline/support.h"

static sl_status refuse(command_console *console, const char *command) {
    return sl_fail(console->context, SL_UNSUPPORTED,
                   "this build has no command '%s' (SIGHTLINE_STUDY is off)", command);
}

sl_status cmd_generate(command_console *console, int argc, char **argv) {
    (void)argc;
    return refuse(console, argv[0]);
}

sl_status cmd_regions(command_console *console, int argc, char **argv) {
    (void)argc;
    return refuse(console, argv[0]);
}

sl_status cmd_walk(command_console *console, int argc, char **argv) {
    (void)argc;
    return refuse(console, argv[0]);
}

sl_status cmd_viewcells(command_console *console, int argc, char **argv) {
    (void)argc;
    return refuse(console, argv[0]);
}

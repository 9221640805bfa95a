/// The subcommands: one file each.
#ifndef COMMANDS_H
#define COMMANDS_H

#include "system/console.h"

/// argv[0] is the name of the command. The message of a failure is in the console's context.
sl_status cmd_axial(command_console *console, int argc, char **argv);
sl_status cmd_bake(command_console *console, int argc, char **argv);
sl_status cmd_batch(command_console *console, int argc, char **argv);
sl_status cmd_check(command_console *console, int argc, char **argv);
sl_status cmd_compare(command_console *console, int argc, char **argv);
sl_status cmd_convert(command_console *console, int argc, char **argv);
sl_status cmd_cover(command_console *console, int argc, char **argv);
sl_status cmd_draw(command_console *console, int argc, char **argv);
sl_status cmd_explain(command_console *console, int argc, char **argv);
sl_status cmd_export(command_console *console, int argc, char **argv);
sl_status cmd_eye(command_console *console, int argc, char **argv);
sl_status cmd_generate(command_console *console, int argc, char **argv);
sl_status cmd_info(command_console *console, int argc, char **argv);
sl_status cmd_merge(command_console *console, int argc, char **argv);
sl_status cmd_isovist(command_console *console, int argc, char **argv);
sl_status cmd_place(command_console *console, int argc, char **argv);
sl_status cmd_path(command_console *console, int argc, char **argv);
sl_status cmd_reject(command_console *console, int argc, char **argv);
sl_status cmd_regions(command_console *console, int argc, char **argv);
sl_status cmd_report(command_console *console, int argc, char **argv);
sl_status cmd_rooms(command_console *console, int argc, char **argv);
sl_status cmd_segments(command_console *console, int argc, char **argv);
sl_status cmd_vga(command_console *console, int argc, char **argv);
sl_status cmd_viewcells(command_console *console, int argc, char **argv);
sl_status cmd_walk(command_console *console, int argc, char **argv);

#endif

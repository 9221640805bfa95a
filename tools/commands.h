/// The subcommands: one file each.
#ifndef COMMANDS_H
#define COMMANDS_H

#include "console.h"

/// Each is given its own name as argv[0]. A failure's message is in the console's context.
sl_status sl_cmd_bake(sl_console *console, int argc, char **argv);
sl_status sl_cmd_check(sl_console *console, int argc, char **argv);
sl_status sl_cmd_compare(sl_console *console, int argc, char **argv);
sl_status sl_cmd_convert(sl_console *console, int argc, char **argv);
sl_status sl_cmd_draw(sl_console *console, int argc, char **argv);
sl_status sl_cmd_explain(sl_console *console, int argc, char **argv);
sl_status sl_cmd_export(sl_console *console, int argc, char **argv);
sl_status sl_cmd_eye(sl_console *console, int argc, char **argv);
sl_status sl_cmd_generate(sl_console *console, int argc, char **argv);
sl_status sl_cmd_info(sl_console *console, int argc, char **argv);
sl_status sl_cmd_merge(sl_console *console, int argc, char **argv);
sl_status sl_cmd_isovist(sl_console *console, int argc, char **argv);
sl_status sl_cmd_reject(sl_console *console, int argc, char **argv);
sl_status sl_cmd_regions(sl_console *console, int argc, char **argv);
sl_status sl_cmd_viewcells(sl_console *console, int argc, char **argv);
sl_status sl_cmd_walk(sl_console *console, int argc, char **argv);

#endif

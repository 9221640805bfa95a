/// Command-line options: one table says what a command takes, and both parsing and --help follow
/// it.
#ifndef OPTIONS_H
#define OPTIONS_H

#include "console.h"
#include "names.h"
#include "sightline/geometry.h"

#define SL_OPTION_LIST_MOST 4096

/// The arguments of an option that may be given several times, in order.
typedef struct sl_option_list {
    const char *items[SL_OPTION_LIST_MOST];
    size_t count;
} sl_option_list;

/// An option: either a flag, or text that the functions below read. Given twice it is an error, but
/// for a command's option that may repeat.
typedef struct sl_option_spec {
    const char *name;     ///< without its dashes
    char letter;          ///< its short form, 0 for none
    const char *argument; ///< what --help calls its argument; NULL for a flag
    bool *flag;           ///< set where it is given
    const char **text;    ///< its argument where it is given, else left as it is
    const char *help;     ///< lines
} sl_option_spec;

/// What a command is called with, for --help and for messages.
typedef struct sl_command_usage {
    const char *name;
    const char *synopsis;    ///< what follows the name: "MAP [-o FILE.slv] [options]"
    const char *operands[4]; ///< what is given without an option, by the names that help uses
    const char *what;        ///< lines
    void (*tables)(void); ///< prints what may be chosen from, after the options; NULL for nothing
    const char *examples; ///< lines
    const sl_option_spec *options;
    size_t option_count;
    const char *repeats;      ///< the name of the option that may be given several times, or NULL
    sl_option_list *repeated; ///< where all its arguments go
    sl_option_list *more;     ///< where what follows the operands goes; NULL where nothing may
} sl_command_usage;

/// Reads the arguments after the command's name, argv[0]; adds --help and --quiet to the options.
/// `operands` has a place for each operand of the usage. After --help, *helped is true and nothing
/// else is to be done.
sl_status sl_option_parse(sl_console *console, const sl_command_usage *usage, int argc, char **argv,
                          const char **operands, bool *helped);

/// Each reads an option's text, all of it; `option` is for the message, as "--slice". Where text is
/// NULL, the option was not given: the value stays as it is.
sl_status sl_option_number(sl_context *context, const char *option, const char *text,
                           double *value);
sl_status sl_option_count(sl_context *context, const char *option, const char *text,
                          uint64_t maximum, uint64_t *value);
/// A number of bytes: "4096", "64K", "256M", "2G", "1T", by powers of 1024.
sl_status sl_option_size(sl_context *context, const char *option, const char *text,
                         uint64_t *bytes);
/// "X,Y"
sl_status sl_option_point(sl_context *context, const char *option, const char *text,
                          sl_point *point);

/// One of the table by name.
sl_status sl_option_choice(sl_context *context, const char *option, const char *text,
                           const sl_name_table *table, size_t *index);
/// Names of the table with commas between: a bit for each, of at most 32; "none" for none.
sl_status sl_option_choices(sl_context *context, const char *option, const char *text,
                            const sl_name_table *table, unsigned *bits);

#endif

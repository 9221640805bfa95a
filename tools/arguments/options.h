/// Command-line options. A command has one typed table of what it takes. Parsing, checking and
/// --help all follow the table.
#ifndef OPTIONS_H
#define OPTIONS_H

#include "arguments/names.h"
#include "sightline/geometry.h"
#include "system/console.h"

#define OPTION_LIST_MOST 4096

/// The arguments of an option that may be given several times, in order.
typedef struct option_list {
    const char *items[OPTION_LIST_MOST];
    size_t count;
} option_list;

/// How the name of an output file is checked before the work begins (outputs.h).
typedef enum output_check {
    CHECK_NONE,
    CHECK_FILE,    ///< any name, or one with one of the option's `endings`
    CHECK_TABLE,   ///< .csv, .txt, no ending, or one of the option's `endings`
    CHECK_PICTURE, ///< .png, .svg or .pdf, or one of the option's `endings`
    CHECK_BAKED,   ///< .slv
} output_check;

typedef struct option_table option_table;

/// An option. It has at most one of the targets from `number` to `list`; the type of the target
/// says how the argument is read. An option that is not given leaves its targets as they are. To
/// give an option twice is an error, unless its target is a list.
typedef struct option_spec {
    const char *name;     ///< without its dashes
    char letter;          ///< its short form, 0 for none
    const char *argument; ///< what --help calls its argument; NULL for a flag
    const char *help;     ///< what it does; --help breaks it into lines
    const char *topic;    ///< the heading over it in '--help all'; NULL: the first one
    bool rare;            ///< left out of the short --help

    bool *flag;         ///< set to true where the option is given
    const char **given; ///< set to its name, unless another option has set it before
    const char **text;  ///< its argument as it was given

    double *number;    ///< any finite number
    uint64_t *count;   ///< a whole number
    uint32_t *count32; ///< likewise
    uint64_t *bytes;   ///< "4096", "64K", "256M", "2G", "1T", by powers of 1024
    sl_point *point;   ///< "X,Y"
    sl_box *box;       ///< "X0,Y0,X1,Y1", two opposite corners
    sl_sight *sight;   ///< "closed" or "open"
    size_t *choice;    ///< one of `names`
    unsigned *choices; ///< names of `names` with commas between, a bit for each; "none" for none
    option_list *list; ///< may be given several times

    name_table names;
    double least, most; ///< of a number or a count; most = 0: no limit
    bool over_0;        ///< a number must be over 0
    const char *needs;  ///< says what is needed; NULL: as least, most and over_0 say
    output_check check;
    const char *endings; ///< ".map", ".map .txt"; for CHECK_FILE, NULL: any
    const char *without; ///< names of other options; this one is of no use without one of them
    bool is_input;       ///< it names a file to read, which no output may replace

    const option_table *group; ///< instead of all this: a group's options stand here
} option_spec;

/// A group of options that several commands share. Its targets belong to one command.
struct option_table {
    option_spec items[40];
    size_t count;
};

void option_table_add(option_table *table, const option_spec *items, size_t count);
/// Gives all options of a table a topic.
void option_table_topic(option_table *table, const char *topic);

/// Options that were given, in the order of their table. An argument is NULL for a flag.
typedef struct options_given {
    struct option_given {
        const char *name, *argument;
    } items[64];
    size_t count;
} options_given;

/// How a command is used: for parsing, --help and messages.
typedef struct command_usage {
    const char *name;
    const char *synopsis;    ///< what follows the name: "MAP [-o FILE.slv] [options]"
    const char *operands[4]; ///< what is given without an option, by the names that help uses
    const char *what;        ///< what it does (help_wrap breaks it into lines)
    void (*tables)(void);    ///< prints the names to choose from, for '--help all'; NULL: nothing
    const char *examples;    ///< lines
    const option_spec *options;
    size_t option_count;
    option_list *more;    ///< where what follows the operands goes; NULL where nothing may
    options_given *given; ///< gets the options that were given; NULL: not asked for
} command_usage;

/// Reads the arguments after the command's name, argv[0], and fills the targets. Adds --help and
/// --quiet to the options. `operands` has a place for each operand of the usage. No output file may
/// be one of them, or a file of an `is_input` option, or of another output. After --help, *helped
/// is true and nothing else is done. SL_BAD_ARGUMENT, with a message that names the option.
sl_status options_parse(command_console *console, const command_usage *usage, int argc, char **argv,
                        const char **operands, bool *helped);

/// For arguments that the table cannot describe. Each reads all of the text. `label` is for the
/// message: "--slice", or the name of an operand.
sl_status read_count(sl_context *context, const char *label, const char *text, uint64_t most,
                     uint64_t *value);
sl_status read_number(sl_context *context, const char *label, const char *text, double *value);
sl_status read_point(sl_context *context, const char *label, const char *text, sl_point *point);
/// Finds a name in a table.
sl_status read_choice(sl_context *context, const char *label, const char *text,
                      const name_table *table, size_t *index);

#endif

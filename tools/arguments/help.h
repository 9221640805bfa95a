/// What --help prints: from the option tables, in several forms.
#ifndef HELP_H
#define HELP_H

#include "arguments/options.h"

typedef enum help_form {
    HELP_SHORT, ///< the options that most people need
    HELP_ALL,   ///< all options by topic, and all names to choose from
    HELP_MAN,   ///< a manual page, in the macros of man(7)
    HELP_WORDS, ///< a line for each option, for shells that complete: its name and what it takes
} help_form;

/// The form that the word after --help asks for: "all", "man" or "words". Any other word, or none
/// (NULL), asks for the short one.
help_form help_form_of(const char *word);

/// Prints how a command is used. `summary` says what it does, in a few words. `options` are those
/// of the usage and of its groups, in order.
void help_print(const command_usage *usage, const char *summary, const option_spec *options,
                size_t count, help_form form);

/// Prints text in lines of up to 79 columns, those after the first indented. Printing begins at
/// `column`. A single line end counts as a space. Two begin a paragraph, and so do lines that
/// begin with a space, which stay as they are.
void help_wrap(const char *text, int column, int indent);

/// Prints a row of a table of names: the name in `width` columns, what it is, and "; after" (NULL:
/// nothing).
void help_name(const char *name, int width, const char *what, const char *after);

/// Prints a measure likewise: its name, what it means, and its unit where that is not of the map.
void help_measure(const sl_measure *measure, int width);

/// Prints all measures of an analysis, under a heading.
void help_measures(sl_analysis analysis);

#endif

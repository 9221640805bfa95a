/// Help as text for people, as a manual page, and as words for the completion of shells.
#include "arguments/help.h"

#include "sightline/support.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

enum { LINE = 79, COLUMN = 26 };

help_form help_form_of(const char *word) {
    static const char *const words[] = {
        [HELP_ALL] = "all", [HELP_MAN] = "man", [HELP_WORDS] = "words"};
    for (size_t i = 1; word && i < sizeof words / sizeof *words; i++)
        if (strcmp(word, words[i]) == 0) return (help_form)i;
    return HELP_SHORT;
}

void help_wrap(const char *text, int column, int indent) {
    for (int at = column; *text;) {
        while (*text == ' ' && at != column) text++;
        if (*text == '\n') {
            const bool blank = text[1] == '\n', paragraph = blank || text[1] == ' ';
            text += blank ? 2 : 1;
            if (!paragraph) continue;
            printf("%s\n%*s", blank ? "\n" : "", indent, "");
            at = column = indent;
            continue;
        }
        const size_t length = strcspn(text, at == column && *text == ' ' ? "\n" : " \n");
        if (at > column && at + 1 + (int)length > LINE) {
            printf("\n%*s", indent, "");
            at = column = indent;
        }
        printf("%s%.*s", at > column ? " " : "", (int)length, text);
        at += (at > column) + (int)length;
        text += length;
    }
    putchar('\n');
}

/// "-o, --output FILE.slv"
static int write_head(const option_spec *option, char *head, size_t size) {
    char letter[8] = "";
    if (option->letter) snprintf(letter, sizeof letter, "-%c, ", option->letter);
    return snprintf(head, size, "%s--%s%s%s", letter, option->name, option->argument ? " " : "",
                    option->argument ? option->argument : "");
}

static void print_option(const option_spec *option) {
    char head[80];
    if (write_head(option, head, sizeof head) + 4 > COLUMN)
        printf("  %s\n%*s", head, COLUMN, "");
    else
        printf("  %-*s", COLUMN - 2, head);
    help_wrap(option->help, COLUMN, COLUMN);
}

static bool same_topic(const char *a, const char *b) {
    return a == b || (a && b && strcmp(a, b) == 0);
}

/// Calls `begin` for each topic, in the order of their first options, and `print` for its options.
/// Options without a topic come first.
static void for_each_topic(const option_spec *options, size_t count,
                           void (*begin)(const char *topic),
                           void (*print)(const option_spec *option)) {
    for (size_t i = 0; i <= count; i++) {
        const char *topic = i ? options[i - 1].topic : NULL;
        bool is_first = i == 0 || topic;
        for (size_t j = 0; i && j + 1 < i; j++) is_first &= !same_topic(options[j].topic, topic);
        if (!is_first) continue;
        begin(topic);
        for (size_t j = 0; j < count; j++)
            if (same_topic(options[j].topic, topic)) print(&options[j]);
    }
}

static void begin_topic(const char *topic) {
    printf("\n%s:\n", topic ? topic : "options");
}

static void print_text(const command_usage *usage, const option_spec *options, size_t count,
                       bool all) {
    size_t rare = 0;
    for (size_t i = 0; i < count; i++) rare += options[i].rare;
    printf("usage: sightline %s %s\n\n", usage->name, usage->synopsis);
    help_wrap(usage->what, 0, 0);
    if (all || !rare) {
        for_each_topic(options, count, begin_topic, print_option);
        if (usage->tables) usage->tables();
    } else {
        begin_topic(NULL);
        for (size_t i = 0; i < count; i++)
            if (!options[i].rare) print_option(&options[i]);
    }
    printf("\nexamples:\n%s\n", usage->examples);
    if (!all && rare)
        printf("\n'sightline %s --help all' lists %zu more options%s.\n", usage->name, rare,
               usage->tables ? " and their values" : "");
}

void help_name(const char *name, int width, const char *what, const char *after) {
    char text[512];
    snprintf(text, sizeof text, "%s%s%s", what, after ? "; " : "", after ? after : "");
    printf("  %-*s", width, name);
    if ((int)strlen(name) >= width) printf("\n%*s", width + 2, "");
    help_wrap(text, width + 2, width + 2);
}

void help_measure(const sl_measure *measure, int width) {
    char unit[SL_UNIT_TEXT], after[SL_UNIT_TEXT + 4];
    sl_measure_say_unit(measure, "", unit);
    // Manual pages are plain ASCII.
    snprintf(after, sizeof after, "in %s", measure->unit == SL_UNIT_DEGREES ? "degrees" : unit);
    help_name(measure->name, width, measure->meaning, *unit ? after : NULL);
}

void help_measures(sl_analysis analysis) {
    size_t count;
    const sl_measure *measures = sl_measures(analysis, &count);
    puts("\nmeasures, for --measure:");
    for (size_t k = 0; k < count; k++) help_measure(&measures[k], 20);
}

// --- manual pages

/// Text for man(7): backslashes, dashes, and dots at the start of a line mean themselves.
static void print_roff(const char *text) {
    for (bool first = true; *text; text++) {
        if (first && (*text == '.' || *text == '\'')) fputs("\\&", stdout);
        first = *text == '\n';
        if (*text == '\\')
            fputs("\\e", stdout);
        else if (*text == '-')
            fputs("\\-", stdout);
        else
            putchar(*text);
    }
}

static void begin_topic_roff(const char *topic) {
    if (topic) printf(".SS %s\n", topic);
}

static void print_option_roff(const option_spec *option) {
    char head[80];
    write_head(option, head, sizeof head);
    fputs(".TP\n.B ", stdout);
    print_roff(head);
    putchar('\n');
    print_roff(option->help);
    putchar('\n');
}

static void print_manual(const command_usage *usage, const char *summary,
                         const option_spec *options, size_t count) {
    fputs(".TH SIGHTLINE\\-", stdout);
    for (const char *at = usage->name; *at; at++) putchar(toupper((unsigned char)*at));
    puts(" 1 \"" SIGHTLINE_DATE "\" \"sightline " SIGHTLINE_VERSION "\" \"Sightline\"");
    printf(".SH NAME\nsightline\\-%s \\- %s\n", usage->name, summary);
    printf(".SH SYNOPSIS\n.B sightline %s\n", usage->name);
    print_roff(usage->synopsis);
    puts("\n.SH DESCRIPTION");
    print_roff(usage->what);
    puts("\n.SH OPTIONS");
    for_each_topic(options, count, begin_topic_roff, print_option_roff);
    if (usage->tables) {
        puts(".SH NAMES TO CHOOSE FROM\n.nf");
        usage->tables();
        puts(".fi");
    }
    puts(".SH EXAMPLES\n.nf");
    print_roff(usage->examples);
    puts("\n.fi\n.SH EXIT STATUS\n"
         "0: done. 1: the work failed. 2: the arguments or an input file are wrong.");
    if (strcmp(usage->name, "check") == 0) puts("3: \\fB\\-\\-strict\\fR found a fault.");
    if (strcmp(usage->name, "path") == 0) puts("3: there is no way.");
    puts(".SH SEE ALSO\n.BR sightline (1)");
}

// --- words for shells

static void print_words(const option_spec *option) {
    printf("--%s\t%s\t", option->name, option->argument ? option->argument : "");
    const bool named = option->choice || option->choices;
    for (size_t i = 0; named && i < option->names.count; i++)
        printf("%s%s", i ? " " : "", name_table_at(&option->names, i));
    int length = (int)strcspn(option->help, ".:;(\n");
    while (length && option->help[length - 1] == ' ') length--;
    printf("%s\t%.*s\n", option->sight ? "closed open" : "", length, option->help);
}

void help_print(const command_usage *usage, const char *summary, const option_spec *options,
                size_t count, help_form form) {
    switch (form) {
    case HELP_SHORT:
    case HELP_ALL:
        print_text(usage, options, count, form == HELP_ALL);
        break;
    case HELP_MAN:
        print_manual(usage, summary, options, count);
        break;
    case HELP_WORDS:
        for (size_t i = 0; i < count; i++) print_words(&options[i]);
        break;
    }
}

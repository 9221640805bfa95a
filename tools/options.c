#include "options.h"

#include "sightline/support.h"

#include <assert.h>
#include <getopt.h>
#include <math.h>
#include <string.h>

enum { MAX_OPTIONS = 64, HELP_COLUMN = 26 };

// --- help

static void print_option(const sl_option_spec *option) {
    char head[64], letter[8] = "";
    if (option->letter) snprintf(letter, sizeof letter, "-%c, ", option->letter);
    const int width =
        snprintf(head, sizeof head, "  %s--%s%s%s", letter, option->name,
                 option->argument ? " " : "", option->argument ? option->argument : "");
    if (width < HELP_COLUMN)
        printf("%-*s", HELP_COLUMN, head);
    else
        printf("%s\n%*s", head, HELP_COLUMN, "");
    for (const char *line = option->help;;) {
        const size_t length = strcspn(line, "\n");
        printf("%.*s\n", (int)length, line);
        if (!line[length]) return;
        line += length + 1;
        printf("%*s", HELP_COLUMN, "");
    }
}

static void print_help(const sl_command_usage *usage, const sl_option_spec *options, size_t count) {
    printf("usage: sightline %s %s\n\n%s\n\noptions:\n", usage->name, usage->synopsis, usage->what);
    for (size_t i = 0; i < count; i++) print_option(&options[i]);
    if (usage->tables) usage->tables();
    printf("\nexamples:\n%s\n", usage->examples);
}

// --- parsing

static sl_status fail_unknown(sl_context *context, const sl_command_usage *usage, const char *word,
                              const sl_option_spec *options, size_t count) {
    if (word[1] == '.' || (word[1] >= '0' && word[1] <= '9'))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "'%s...' looks like an option; 'sightline %s [options] -- ...' takes what "
                       "follows the -- as it is",
                       word, usage->name);
    const sl_name_table names = {"option", options, sizeof *options, count};
    const char *bare = word + strspn(word, "-");
    const size_t length = strcspn(bare, "=");
    char name[64];
    snprintf(name, sizeof name, "%.*s", (int)length, bare);
    size_t fitting = 0;
    for (size_t i = 0; i < count; i++)
        fitting += word[1] == '-' && strncmp(options[i].name, name, length) == 0;
    if (fitting > 1)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--%s may mean several options; 'sightline %s --help' lists them", name,
                       usage->name);
    const char *near = sl_nearest_name(&names, name);
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "unknown option '%s'%s%s%s; 'sightline %s --help' lists the options", word,
                   near ? " (did you mean --" : "", near ? near : "", near ? "?)" : "",
                   usage->name);
}

/// What getopt_long is told: the long options, by their place in the table, and the letters.
static void fill_getopt(const sl_option_spec *options, size_t count, struct option *longs,
                        char *letters) {
    *letters++ = ':'; // tell a missing argument from an unknown option
    for (size_t i = 0; i < count; i++) {
        const int takes = options[i].argument ? required_argument : no_argument;
        longs[i] = (struct option){options[i].name, takes, NULL, 256 + (int)i};
        if (!options[i].letter) continue;
        *letters++ = options[i].letter;
        if (options[i].argument) *letters++ = ':';
    }
    longs[count] = (struct option){0};
    *letters = '\0';
}

static const sl_option_spec *find_option(const sl_option_spec *options, size_t count, int code) {
    for (size_t i = 0; i < count; i++)
        if (code == 256 + (int)i || (options[i].letter && code == options[i].letter))
            return &options[i];
    return NULL;
}

static sl_status take_option(sl_context *context, const sl_command_usage *usage,
                             const sl_option_spec *option) {
    if (usage->repeats && strcmp(option->name, usage->repeats) == 0) {
        sl_option_list *list = usage->repeated;
        if (list->count == SL_OPTION_LIST_MOST)
            return sl_fail(context, SL_BAD_ARGUMENT, "--%s is given more than %d times",
                           option->name, SL_OPTION_LIST_MOST);
        list->items[list->count++] = optarg;
        return SL_OK;
    }
    if (option->flag ? *option->flag : *option->text != NULL)
        return sl_fail(context, SL_BAD_ARGUMENT, "--%s is given twice", option->name);
    if (option->flag)
        *option->flag = true;
    else
        *option->text = optarg;
    return SL_OK;
}

static sl_status parse_options(sl_context *context, const sl_command_usage *usage,
                               const sl_option_spec *options, size_t count, int argc, char **argv) {
    struct option longs[MAX_OPTIONS + 1];
    char letters[2 * MAX_OPTIONS + 2];
    fill_getopt(options, count, longs, letters);
    opterr = 0;
    for (;;) {
        const int code = getopt_long(argc, argv, letters, longs, NULL);
        if (code == -1) return SL_OK;
        const sl_option_spec *option = find_option(options, count, code);
        if (option) {
            SL_TRY(take_option(context, usage, option));
            continue;
        }
        option = find_option(options, count, optopt);
        if (code == ':')
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "--%s needs an argument: %s; 'sightline %s --help' tells more",
                           option->name, option->argument, usage->name);
        if (option)
            return sl_fail(context, SL_BAD_ARGUMENT, "--%s takes no argument", option->name);
        const char short_word[3] = {'-', (char)optopt, '\0'};
        return fail_unknown(context, usage, optopt ? short_word : argv[optind - 1], options, count);
    }
}

static sl_status take_operands(sl_context *context, const sl_command_usage *usage, int argc,
                               char **argv, const char **operands) {
    size_t wanted = 0;
    while (wanted < 4 && usage->operands[wanted]) wanted++;
    const size_t given = (size_t)(argc - optind);
    if (given < wanted)
        return sl_fail(context, SL_BAD_ARGUMENT, "%s is missing; 'sightline %s --help' tells more",
                       usage->operands[given], usage->name);
    if (given > wanted && !usage->more)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "'%s' is one argument too many; 'sightline %s --help' tells more",
                       argv[optind + (int)wanted], usage->name);
    for (size_t i = 0; i < wanted; i++) {
        operands[i] = argv[optind + (int)i];
        if (!operands[i][0])
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "%s is empty; 'sightline %s --help' tells more", usage->operands[i],
                           usage->name);
    }
    for (size_t i = wanted; i < given; i++) {
        sl_option_list *list = usage->more;
        if (list->count == SL_OPTION_LIST_MOST)
            return sl_fail(context, SL_BAD_ARGUMENT, "more than %d arguments after %s",
                           SL_OPTION_LIST_MOST, usage->operands[wanted - 1]);
        list->items[list->count++] = argv[optind + (int)i];
    }
    return SL_OK;
}

sl_status sl_option_parse(sl_console *console, const sl_command_usage *usage, int argc, char **argv,
                          const char **operands, bool *helped) {
    sl_option_spec options[MAX_OPTIONS];
    size_t count = usage->option_count;
    assert(count + 2 <= MAX_OPTIONS);
    *helped = false;
    memcpy(options, usage->options, count * sizeof *options);
    options[count++] =
        (sl_option_spec){.name = "quiet",
                         .letter = 'q',
                         .flag = &console->quiet,
                         .help = "no notes, no progress, no report of what is written"};
    options[count++] =
        (sl_option_spec){.name = "help", .letter = 'h', .flag = helped, .help = "this text"};
    SL_TRY(parse_options(console->context, usage, options, count, argc, argv));
    if (*helped) {
        print_help(usage, options, count);
        return SL_OK;
    }
    return take_operands(console->context, usage, argc, argv, operands);
}

// --- numbers

sl_status sl_option_number(sl_context *context, const char *option, const char *text,
                           double *value) {
    if (!text) return SL_OK;
    double number;
    if (!sl_number_read(text, strlen(text), &number) || !isfinite(number))
        return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: a finite number is needed", option, text);
    *value = number;
    return SL_OK;
}

/// Digits, all of text[0 .. length), of a value up to the maximum.
static bool read_count(const char *text, size_t length, uint64_t maximum, uint64_t *value) {
    uint64_t number = 0;
    for (size_t i = 0; i < length; i++) {
        if (text[i] < '0' || text[i] > '9') return false;
        const unsigned digit = (unsigned)(text[i] - '0');
        if (digit > maximum || number > (maximum - digit) / 10) return false;
        number = number * 10 + digit;
    }
    *value = number;
    return length > 0;
}

sl_status sl_option_count(sl_context *context, const char *option, const char *text,
                          uint64_t maximum, uint64_t *value) {
    if (!text || read_count(text, strlen(text), maximum, value)) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: a whole number from 0 to %llu is needed",
                   option, text, (unsigned long long)maximum);
}

sl_status sl_option_size(sl_context *context, const char *option, const char *text,
                         uint64_t *bytes) {
    if (!text) return SL_OK;
    const char units[] = "KMGT";
    size_t length = strlen(text);
    unsigned shift = 0;
    const char *unit = length ? strchr(units, text[length - 1] & ~0x20) : NULL;
    if (unit && *unit) {
        shift = 10 * (unsigned)(unit - units + 1);
        length--;
    }
    uint64_t number;
    if (!read_count(text, length, UINT64_MAX >> shift, &number))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "%s %s: a number of bytes is needed, as 4096, 64K, 256M or 2G", option,
                       text);
    *bytes = number << shift;
    return SL_OK;
}

sl_status sl_option_point(sl_context *context, const char *option, const char *text,
                          sl_point *point) {
    if (!text) return SL_OK;
    const size_t comma = strcspn(text, ",");
    sl_point p;
    if (!text[comma] || !sl_number_read(text, comma, &p.x) ||
        !sl_number_read(text + comma + 1, strlen(text + comma + 1), &p.y) || !isfinite(p.x) ||
        !isfinite(p.y))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "%s %s: two finite numbers with a comma between are needed, as 3.5,2",
                       option, text);
    *point = p;
    return SL_OK;
}

// --- names

/// "dfs, sweep": as many as fit.
static void write_names(const sl_name_table *table, char *text, size_t size) {
    text[0] = '\0';
    for (size_t i = 0; i < table->count; i++) {
        const size_t used = strlen(text);
        snprintf(text + used, size - used, "%s%s", i ? ", " : "", sl_name_table_at(table, i));
    }
}

static sl_status find_name(sl_context *context, const char *option, const char *word, size_t length,
                           const sl_name_table *table, size_t *index) {
    for (size_t i = 0; i < table->count; i++) {
        const char *name = sl_name_table_at(table, i);
        if (strlen(name) == length && memcmp(name, word, length) == 0) {
            *index = i;
            return SL_OK;
        }
    }
    char known[512];
    write_names(table, known, sizeof known);
    return sl_fail(context, SL_BAD_ARGUMENT, "%s: there is no %s '%.*s'; choose from %s", option,
                   table->kind, (int)length, word, known);
}

sl_status sl_option_choice(sl_context *context, const char *option, const char *text,
                           const sl_name_table *table, size_t *index) {
    return text ? find_name(context, option, text, strlen(text), table, index) : SL_OK;
}

sl_status sl_option_choices(sl_context *context, const char *option, const char *text,
                            const sl_name_table *table, unsigned *bits) {
    if (!text) return SL_OK;
    unsigned chosen = 0;
    assert(table->count <= 32);
    for (const char *word = text; strcmp(text, "none") != 0;) {
        const size_t length = strcspn(word, ",");
        size_t index;
        SL_TRY(find_name(context, option, word, length, table, &index));
        chosen |= 1u << index;
        if (!word[length]) break;
        word += length + 1;
    }
    *bits = chosen;
    return SL_OK;
}

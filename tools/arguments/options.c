/// Takes the words of the command line by getopt, reads their values, and checks the outputs.
#include "arguments/options.h"

#include "arguments/help.h"
#include "arguments/outputs.h"
#include "sightline/support.h"

#include <assert.h>
#include <getopt.h>
#include <math.h>
#include <string.h>

enum { MAX_OPTIONS = 96 };

/// All options of a command, with those of its groups, and the argument of each: NULL where the
/// option is not given, "" for a flag. Arguments are gathered first and read afterwards, so that
/// --help works beside a wrong argument.
typedef struct parsing {
    sl_context *context;
    const command_usage *usage;
    option_spec options[MAX_OPTIONS];
    const char *arguments[MAX_OPTIONS];
    size_t count;
    char **operands; ///< words that are no options, moved to the front of argv
    size_t operand_count;
} parsing;

// --- tables

void option_table_topic(option_table *table, const char *topic) {
    for (size_t i = 0; i < table->count; i++) table->items[i].topic = topic;
}

void option_table_add(option_table *table, const option_spec *items, size_t count) {
    assert(table->count + count <= sizeof table->items / sizeof *table->items);
    memcpy(table->items + table->count, items, count * sizeof *items);
    table->count += count;
}

static void add_options(parsing *p, const option_spec *options, size_t count) {
    for (size_t i = 0; i < count; i++) {
        if (options[i].group) {
            add_options(p, options[i].group->items, options[i].group->count);
            continue;
        }
        assert(p->count < MAX_OPTIONS);
        p->options[p->count++] = options[i];
    }
}

// --- parsing

static sl_status fail_unknown(const parsing *p, const char *word) {
    const char *command = p->usage->name;
    const name_table names = {"option", p->options, sizeof *p->options, p->count, NULL};
    const char *bare = word + strspn(word, "-");
    const size_t length = strcspn(bare, "=");
    char name[64];
    snprintf(name, sizeof name, "%.*s", (int)length, bare);
    size_t fitting = 0;
    for (size_t i = 0; i < p->count; i++)
        fitting += word[1] == '-' && strncmp(p->options[i].name, name, length) == 0;
    if (fitting > 1)
        return sl_fail(p->context, SL_BAD_ARGUMENT,
                       "--%s may mean several options; 'sightline %s --help' lists them", name,
                       command);
    const char *near = nearest_name(&names, name);
    return sl_fail(p->context, SL_BAD_ARGUMENT,
                   "unknown option '%s'%s%s%s; 'sightline %s --help' lists the options", word,
                   near ? " (did you mean --" : "", near ? near : "", near ? "?)" : "", command);
}

static sl_status fail_half_name(const parsing *p, size_t i, const char *word) {
    return sl_fail(p->context, SL_BAD_ARGUMENT,
                   "unknown option '%.*s' (did you mean --%s?); 'sightline %s --help' lists the "
                   "options",
                   (int)strcspn(word, "="), word, p->options[i].name, p->usage->name);
}

/// The input of getopt_long: the long options, coded by their place in the table, and the letters.
static void fill_getopt(const parsing *p, struct option *longs, char *letters) {
    *letters++ = '-'; // return words that are no options where they stand, coded 1
    *letters++ = ':'; // tell a missing argument from an unknown option
    for (size_t i = 0; i < p->count; i++) {
        const option_spec *option = &p->options[i];
        const int takes = option->argument ? required_argument : no_argument;
        longs[i] = (struct option){option->name, takes, NULL, 256 + (int)i};
        if (!option->letter) continue;
        *letters++ = option->letter;
        if (option->argument) *letters++ = ':';
    }
    longs[p->count] = (struct option){0};
    *letters = '\0';
}

/// The place of an option by the code that getopt_long returned; p->count for none.
static size_t find_option(const parsing *p, int code) {
    size_t i = 0;
    while (i < p->count && code != 256 + (int)i &&
           !(p->options[i].letter && code == p->options[i].letter))
        i++;
    return i;
}

static sl_status take_argument(parsing *p, size_t i) {
    const option_spec *option = &p->options[i];
    option_list *list = option->list;
    if (!list && p->arguments[i])
        return sl_fail(p->context, SL_BAD_ARGUMENT, "--%s is given twice", option->name);
    if (list && list->count == OPTION_LIST_MOST)
        return sl_fail(p->context, SL_BAD_ARGUMENT, "--%s is given more than %d times",
                       option->name, OPTION_LIST_MOST);
    p->arguments[i] = option->argument ? optarg : "";
    if (list) list->items[list->count++] = optarg;
    if (option->flag) *option->flag = true;
    return SL_OK;
}

/// Whether a word is the beginning of an option's name up to a '-': --start for --start-names. That
/// is more likely an option of another command.
static bool is_half_name(const option_spec *option, const char *word) {
    const char *bare = word + strspn(word, "-");
    const size_t length = strcspn(bare, "=");
    return strncmp(word, "--", 2) == 0 && strncmp(option->name, bare, length) == 0 &&
           option->name[length] == '-';
}

/// Whether a word is a negative number, or a point that begins with one.
static bool is_negative(const char *word) {
    return word[0] == '-' && (word[1] == '.' || (word[1] >= '0' && word[1] <= '9'));
}

static sl_status take_words(parsing *p, int argc, char **argv) {
    struct option longs[MAX_OPTIONS + 1];
    char letters[2 * MAX_OPTIONS + 3];
    fill_getopt(p, longs, letters);
    opterr = 0;
    p->operands = argv + 1;
    for (;;) {
        if (optind < argc && is_negative(argv[optind])) {
            p->operands[p->operand_count++] = argv[optind++];
            continue;
        }
        const int code = getopt_long(argc, argv, letters, longs, NULL);
        if (code == 1) {
            p->operands[p->operand_count++] = optarg;
            continue;
        }
        if (code == -1) {
            while (optind < argc) p->operands[p->operand_count++] = argv[optind++];
            return SL_OK;
        }
        size_t i = find_option(p, code);
        if (i < p->count) {
            const bool apart = optarg && optarg == argv[optind - 1];
            const char *word = argv[optind - (apart ? 2 : 1)];
            if (code >= 256 && is_half_name(&p->options[i], word))
                return fail_half_name(p, i, word);
            SL_TRY(take_argument(p, i));
            continue;
        }
        i = find_option(p, optopt);
        if (code == ':')
            return sl_fail(p->context, SL_BAD_ARGUMENT,
                           "--%s needs an argument: %s; 'sightline %s --help' shows how",
                           p->options[i].name, p->options[i].argument, p->usage->name);
        if (i < p->count)
            return sl_fail(p->context, SL_BAD_ARGUMENT, "--%s takes no argument",
                           p->options[i].name);
        const char short_word[3] = {'-', (char)optopt, '\0'};
        return fail_unknown(p, optopt ? short_word : argv[optind - 1]);
    }
}

static sl_status take_operands(const parsing *p, const char **operands) {
    const command_usage *usage = p->usage;
    size_t wanted = 0;
    while (wanted < 4 && usage->operands[wanted]) wanted++;
    const size_t given = p->operand_count;
    if (given < wanted)
        return sl_fail(p->context, SL_BAD_ARGUMENT,
                       "%s is missing; 'sightline %s --help' shows how", usage->operands[given],
                       usage->name);
    if (given > wanted && !usage->more)
        return sl_fail(p->context, SL_BAD_ARGUMENT,
                       "'%s' is one argument too many; 'sightline %s --help' shows how",
                       p->operands[wanted], usage->name);
    for (size_t i = 0; i < wanted; i++) {
        operands[i] = p->operands[i];
        if (!operands[i][0])
            return sl_fail(p->context, SL_BAD_ARGUMENT,
                           "%s is empty; 'sightline %s --help' shows how", usage->operands[i],
                           usage->name);
    }
    for (size_t i = wanted; i < given; i++) {
        option_list *list = usage->more;
        if (list->count == OPTION_LIST_MOST)
            return sl_fail(p->context, SL_BAD_ARGUMENT, "more than %d arguments after %s",
                           OPTION_LIST_MOST, usage->operands[wanted - 1]);
        list->items[list->count++] = p->operands[i];
    }
    return SL_OK;
}

// --- numbers

sl_status read_number(sl_context *context, const char *label, const char *text, double *value) {
    double number;
    if (!sl_number_read(text, strlen(text), &number) || !isfinite(number))
        return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: a finite number is needed", label, text);
    *value = number;
    return SL_OK;
}

/// Reads text[0 .. length), all digits, as a value up to `most`.
static bool parse_count(const char *text, size_t length, uint64_t most, uint64_t *value) {
    uint64_t number = 0;
    for (size_t i = 0; i < length; i++) {
        if (text[i] < '0' || text[i] > '9') return false;
        const unsigned digit = (unsigned)(text[i] - '0');
        if (digit > most || number > (most - digit) / 10) return false;
        number = number * 10 + digit;
    }
    *value = number;
    return length > 0;
}

sl_status read_count(sl_context *context, const char *label, const char *text, uint64_t most,
                     uint64_t *value) {
    if (parse_count(text, strlen(text), most, value)) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: a whole number from 0 to %llu is needed",
                   label, text, (unsigned long long)most);
}

static sl_status read_bytes(sl_context *context, const char *label, const char *text,
                            uint64_t *bytes) {
    const char units[] = "KMGT";
    size_t length = strlen(text);
    unsigned shift = 0;
    const char *unit = length ? strchr(units, text[length - 1] & ~0x20) : NULL;
    if (unit && *unit) {
        shift = 10 * (unsigned)(unit - units + 1);
        length--;
    }
    uint64_t number;
    if (!parse_count(text, length, UINT64_MAX >> shift, &number))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "%s %s: a number of bytes is needed, as 4096, 64K, 256M or 2G", label, text);
    *bytes = number << shift;
    return SL_OK;
}

sl_status read_point(sl_context *context, const char *label, const char *text, sl_point *point) {
    const size_t comma = strcspn(text, ",");
    sl_point p;
    if (!text[comma] || !sl_number_read(text, comma, &p.x) ||
        !sl_number_read(text + comma + 1, strlen(text + comma + 1), &p.y) || !isfinite(p.x) ||
        !isfinite(p.y))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "%s %s: two finite numbers with a comma between are needed, as 3.5,2", label,
                       text);
    // Too small for a coordinate: 0, as in map files.
    if (fabs(p.x) < SL_COORDINATE_MIN) p.x = 0;
    if (fabs(p.y) < SL_COORDINATE_MIN) p.y = 0;
    *point = p;
    return SL_OK;
}

/// Two opposite corners, as the lower left and the upper right one.
static sl_status read_box(sl_context *context, const char *label, const char *text, sl_box *box) {
    double at[4];
    const char *from = text;
    for (int i = 0; i < 4; i++) {
        const size_t length = i < 3 ? strcspn(from, ",") : strlen(from);
        if ((i < 3 && !from[length]) || !sl_number_read(from, length, &at[i]) ||
            !sl_coordinate_usable(fabs(at[i]) < SL_COORDINATE_MIN ? 0 : at[i])) {
            from = NULL;
            break;
        }
        from += length + (i < 3);
    }
    if (!from || at[0] == at[2] || at[1] == at[3])
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "%s %s: two opposite corners of a box are needed, as 0,0,10,7.5", label,
                       text);
    *box = (sl_box){{fmin(at[0], at[2]), fmin(at[1], at[3])},
                    {fmax(at[0], at[2]), fmax(at[1], at[3])}};
    return SL_OK;
}

/// Checks that a number is in the range of its option.
static sl_status check_range(sl_context *context, const char *label, const char *text,
                             const option_spec *option, double value) {
    const bool fits = value >= option->least && !(option->over_0 && value <= 0) &&
                      (option->most == 0 || value <= option->most);
    if (fits) return SL_OK;
    char needs[80];
    if (option->count || option->count32)
        snprintf(needs, sizeof needs, "at least %g is needed", option->least);
    else if (option->over_0)
        snprintf(needs, sizeof needs, "a number over 0 is needed");
    else
        snprintf(needs, sizeof needs, "a number from %g to %g is needed", option->least,
                 option->most);
    return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: %s", label, text,
                   option->needs ? option->needs : needs);
}

// --- names

/// "dfs, sweep": as many names as fit.
static void write_names(const name_table *table, char *text, size_t size) {
    text[0] = '\0';
    for (size_t i = 0; i < table->count; i++) {
        const size_t used = strlen(text);
        snprintf(text + used, size - used, "%s%s", i ? ", " : "", name_table_at(table, i));
    }
}

static sl_status find_name(sl_context *context, const char *label, const char *word, size_t length,
                           const name_table *table, size_t *index) {
    for (size_t i = 0; i < table->count; i++) {
        const char *name = name_table_at(table, i);
        if (strlen(name) == length && memcmp(name, word, length) == 0) {
            *index = i;
            return SL_OK;
        }
    }
    char known[512];
    write_names(table, known, sizeof known);
    return sl_fail(context, SL_BAD_ARGUMENT, "%s: there is no %s '%.*s'; choose from %s", label,
                   table->kind, (int)length, word, known);
}

sl_status read_choice(sl_context *context, const char *label, const char *text,
                      const name_table *table, size_t *index) {
    return find_name(context, label, text, strlen(text), table, index);
}

static sl_status read_choices(sl_context *context, const char *label, const char *text,
                              const name_table *table, unsigned *bits) {
    unsigned chosen = 0;
    assert(table->count <= 32);
    for (const char *word = text; strcmp(text, "none") != 0;) {
        const size_t length = strcspn(word, ",");
        size_t index;
        SL_TRY(find_name(context, label, word, length, table, &index));
        chosen |= 1u << index;
        if (!word[length]) break;
        word += length + 1;
    }
    *bits = chosen;
    return SL_OK;
}

// --- from arguments to targets

/// SL_BAD_ARGUMENT: "1 or 2 is needed", "a whole number from 1 to 8 is needed".
static sl_status fail_count(sl_context *context, const char *label, const char *text,
                            uint64_t least, uint64_t most) {
    const unsigned long long low = least, high = most;
    if (high - low == 1)
        return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: %llu or %llu is needed", label, text, low,
                       high);
    return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: a whole number from %llu to %llu is needed",
                   label, text, low, high);
}

static sl_status set_count(sl_context *context, const char *label, const char *text,
                           const option_spec *option) {
    const uint64_t any = option->count ? UINT64_MAX : UINT32_MAX;
    const uint64_t most = option->most > 0 ? (uint64_t)option->most : any;
    const uint64_t least = (uint64_t)option->least;
    uint64_t count;
    if (!parse_count(text, strlen(text), most, &count) || (count < least && most - least == 1))
        return fail_count(context, label, text, least, most);
    SL_TRY(check_range(context, label, text, option, (double)count));
    if (option->count)
        *option->count = count;
    else
        *option->count32 = (uint32_t)count;
    return SL_OK;
}

static sl_status set_sight(sl_context *context, const char *label, const char *text,
                           sl_sight *sight) {
    const name_table names = sight_table();
    size_t index;
    SL_TRY(read_choice(context, label, text, &names, &index));
    *sight = (sl_sight)index;
    return SL_OK;
}

enum { LABEL = 40 };

static void write_label(const option_spec *option, char label[LABEL]) {
    if (option->letter)
        snprintf(label, LABEL, "-%c", option->letter);
    else
        snprintf(label, LABEL, "--%s", option->name);
}

static sl_status set_target(sl_context *context, const option_spec *option, const char *text) {
    char label[LABEL];
    write_label(option, label);
    if (option->given && !*option->given) *option->given = option->name;
    if (option->text) *option->text = text;
    if (option->number) {
        SL_TRY(read_number(context, label, text, option->number));
        const bool ranges = option->most != 0 || option->over_0 || option->needs;
        return ranges ? check_range(context, label, text, option, *option->number) : SL_OK;
    }
    if (option->count || option->count32) return set_count(context, label, text, option);
    if (option->bytes) return read_bytes(context, label, text, option->bytes);
    if (option->point) return read_point(context, label, text, option->point);
    if (option->box) return read_box(context, label, text, option->box);
    if (option->sight) return set_sight(context, label, text, option->sight);
    if (option->choice) return read_choice(context, label, text, &option->names, option->choice);
    if (option->choices) return read_choices(context, label, text, &option->names, option->choices);
    return SL_OK;
}

static sl_status check_output(sl_context *context, const option_spec *option, const char *label,
                              const char *text) {
    switch (option->check) {
    case CHECK_NONE:
        break;
    case CHECK_FILE:
        return output_check_file(context, label, text, option->endings);
    case CHECK_TABLE:
        return output_check_table(context, label, text, option->endings);
    case CHECK_PICTURE:
        return output_check_picture(context, label, text, option->endings);
    case CHECK_BAKED:
        return output_check_baked(context, label, text);
    }
    return SL_OK;
}

/// Checks an output file against all inputs and the outputs before it.
static sl_status check_apart(const parsing *p, size_t output, const char **operands) {
    const char *path = p->arguments[output];
    const option_list *more = p->usage->more;
    char label[LABEL], other[LABEL];
    write_label(&p->options[output], label);
    for (size_t i = 0; i < 4 && p->usage->operands[i]; i++)
        SL_TRY(output_check_apart(p->context, operands[i], label, path));
    for (size_t i = 0; more && i < more->count; i++)
        SL_TRY(output_check_apart(p->context, more->items[i], label, path));
    for (size_t i = 0; i < p->count; i++) {
        if (!p->arguments[i]) continue;
        if (p->options[i].is_input)
            SL_TRY(output_check_apart(p->context, p->arguments[i], label, path));
        write_label(&p->options[i], other);
        if (i < output && p->options[i].check && output_is_same(path, p->arguments[i]))
            return sl_fail(p->context, SL_BAD_ARGUMENT,
                           "%s and %s both write to %s; give them two names", other, label, path);
    }
    return SL_OK;
}

/// Whether an option is one of `names`, which have spaces between.
static bool is_among(const option_spec *option, const char *names) {
    const size_t length = option->name ? strlen(option->name) : 0;
    for (const char *at = names; length && *at; at += strspn(at, " ")) {
        const size_t size = strcspn(at, " ");
        if (size == length && memcmp(at, option->name, size) == 0) return true;
        at += size;
    }
    return false;
}

/// SL_BAD_ARGUMENT where an option is given without one that it belongs to. The message names the
/// first of these.
static sl_status check_useful(const parsing *p) {
    for (size_t i = 0; i < p->count; i++) {
        const option_spec *option = &p->options[i];
        char label[LABEL];
        if (!p->arguments[i] || !option->without) continue;
        bool useful = false;
        size_t first = p->count;
        for (size_t k = 0; k < p->count; k++) {
            if (!is_among(&p->options[k], option->without)) continue;
            if (first == p->count) first = k;
            useful |= p->arguments[k] != NULL;
        }
        if (useful) continue;
        write_label(&p->options[first], label);
        return sl_fail(p->context, SL_BAD_ARGUMENT, "--%s is of no use without %s", option->name,
                       label);
    }
    return SL_OK;
}

/// Names are checked when all options are known, and before the work begins.
static sl_status check_outputs(const parsing *p, const char **operands) {
    for (size_t i = 0; i < p->count; i++) {
        const option_spec *option = &p->options[i];
        char label[LABEL];
        if (!p->arguments[i] || !option->check) continue;
        write_label(option, label);
        SL_TRY(check_output(p->context, option, label, p->arguments[i]));
        SL_TRY(check_apart(p, i, operands));
    }
    return SL_OK;
}

sl_status options_parse(command_console *console, const command_usage *usage, int argc, char **argv,
                        const char **operands, bool *helped) {
    const option_spec common[] = {
        {"quiet", 'q', NULL, "print errors and asked-for data only", .flag = &console->quiet},
        {"help", 'h', NULL, "show this text; '--help all' shows everything", .flag = helped},
    };
    parsing p = {.context = console->context, .usage = usage};
    *helped = false;
    add_options(&p, usage->options, usage->option_count);
    add_options(&p, common, sizeof common / sizeof *common);
    SL_TRY(take_words(&p, argc, argv));
    if (*helped) {
        help_print(usage, console->summary, p.options, p.count,
                   help_form_of(p.operand_count ? p.operands[0] : NULL));
        return SL_OK;
    }
    SL_TRY(take_operands(&p, operands));
    for (size_t i = 0; i < p.count; i++) {
        const option_spec *option = &p.options[i];
        if (!p.arguments[i]) continue;
        SL_TRY(set_target(p.context, option, p.arguments[i]));
        if (!usage->given) continue;
        usage->given->items[usage->given->count++] =
            (struct option_given){option->name, option->argument ? p.arguments[i] : NULL};
    }
    SL_TRY(check_useful(&p));
    return check_outputs(&p, operands);
}

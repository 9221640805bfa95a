/// `sightline batch`: one command for many plans, and a table with a row for each. This program
/// runs once for each plan, several at a time: a plan that fails, or takes all memory, harms no
/// other. What the command prints is the row.
#include "arguments/options.h"
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "inputs/inputs.h"
#include "inputs/made_from.h"
#include "sightline/support.h"
#include "studies/batch.h"
#include "system/system.h"

#include <errno.h>
#include <inttypes.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

// --- which commands

typedef struct batched {
    const char *name;
    bool table;   ///< it prints a table; else a JSON object
    bool threads; ///< it takes --threads
    bool names;   ///< it names a file after the plan if nobody does
} batched;

static const batched commands[] = {
    {.name = "info"},
    {.name = "check"},
    {.name = "bake", .threads = true, .names = true},
    {.name = "eye"},
    {.name = "isovist", .table = true, .threads = true},
    {.name = "place"},
    {.name = "cover"},
    {.name = "path"},
    {.name = "vga", .table = true, .threads = true},
    {.name = "axial", .table = true, .threads = true},
    {.name = "segments", .table = true, .threads = true},
};

// --- the work

typedef struct batch {
    const batched *command;
    const char *output;     ///< of the table
    const char *program;    ///< this one
    const option_list *own; ///< arguments of the command
    bool is_one_thread;     ///< the command is not to take all cores
    char *list;             ///< the text of the list
    SL_ARRAY(const char *) plans;
    batch_row *rows, *old; ///< old: of the table that is resumed
    size_t old_count;
    size_t *open, open_count; ///< plans that must be run
    pthread_mutex_t lock;     ///< of the rows and what follows
    double written;           ///< when the table was written last
} batch;

static void batch_destroy(sl_context *context, batch *b) {
    for (size_t i = 0; b->rows && i < b->plans.count; i++) batch_row_destroy(context, &b->rows[i]);
    for (size_t i = 0; i < b->old_count; i++) batch_row_destroy(context, &b->old[i]);
    sl_free(context, b->rows);
    sl_free(context, b->open);
    sl_free(context, b->old);
    sl_free(context, b->plans.items);
    sl_free(context, b->list);
    pthread_mutex_destroy(&b->lock);
}

// --- the list

static sl_status add_plan(sl_context *context, batch *b, const char *path, unsigned line,
                          char *plan) {
    size_t length = strlen(plan);
    while (length && strchr(" \t\r", plan[length - 1])) plan[--length] = '\0';
    if (!length || *plan == '#') return SL_OK;
    if (*plan == '-')
        return sl_fail_at(context, path, line, "the path of a plan begins with '-': write ./%s",
                          plan);
    SL_TRY(SL_ARRAY_ROOM(context, &b->plans, 1));
    b->plans.items[b->plans.count++] = plan;
    return SL_OK;
}

static sl_status read_list(sl_context *context, const char *path, batch *b) {
    static const char mark[] = "\xef\xbb\xbf"; // some editors write it first
    sl_bytes text;
    SL_TRY(sl_file_read(context, path, &text));
    b->list = text.data;
    if (memchr(text.data, '\0', text.size))
        return sl_fail_at(context, path, 0, "a list of files is needed, a path on each line");
    char *at = text.data + (strncmp(text.data, mark, 3) == 0 ? 3 : 0);
    for (unsigned line = 1; *at; line++) {
        char *plan = at;
        at += strcspn(at, "\n");
        if (*at) *at++ = '\0';
        SL_TRY(add_plan(context, b, path, line, plan));
    }
    if (b->plans.count) return SL_OK;
    return sl_fail_at(context, path, 0, "no plan is listed: a path is needed on each line");
}

static bool has_same_name(const char *a, const char *b) {
    size_t length, other;
    a = input_base_name(a, &length);
    b = input_base_name(b, &other);
    return length == other && memcmp(a, b, length) == 0;
}

/// Plans of one name would write one file.
static sl_status check_names(sl_context *context, const batch *b) {
    bool named = b->command->names;
    for (size_t i = 0; i < b->own->count; i++) named |= strstr(b->own->items[i], "{}") != NULL;
    for (size_t i = 0; named && i < b->plans.count; i++)
        for (size_t k = 0; k < i; k++)
            if (has_same_name(b->plans.items[k], b->plans.items[i]))
                return sl_fail(context, SL_BAD_ARGUMENT,
                               "%s and %s have one name, so their files would, too: rename one",
                               b->plans.items[k], b->plans.items[i]);
    return SL_OK;
}

static sl_status check_arguments(sl_context *context, batch *b) {
    for (size_t i = 0; i < b->own->count; i++) {
        const char *word = b->own->items[i];
        const bool output = strncmp(word, "-o", 2) == 0 || strncmp(word, "--output", 8) == 0;
        if (b->command->table ? output : strcmp(word, "--json") == 0)
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "%s: batch itself takes what '%s' prints; leave it out", word,
                           b->command->name);
        b->is_one_thread &= strncmp(word, "--threads", 9) != 0;
    }
    for (size_t i = 0; i < b->plans.count; i++)
        SL_TRY(output_check_apart(context, b->plans.items[i], "-o", b->output));
    return check_names(context, b);
}

// --- a plan

enum { KEY_TEXT = 20, EXTRA = 8 };
static const char *const COLUMN_PLAN = "plan", *const COLUMN_STATUS = "exit_status",
                         *const COLUMN_MESSAGE = "message", *const COLUMN_NOTES = "notes",
                         *const COLUMN_KEY = "made_from";

/// A number for the version, the command with its arguments, and the plan's bytes. None where the
/// plan cannot be read: the command will say why.
static void write_key(sl_context *context, const batch *b, const char *plan, char key[KEY_TEXT]) {
    sl_bytes file;
    *key = '\0';
    if (sl_path_look(plan) != SL_PATH_FILE || sl_file_read(context, plan, &file) != SL_OK) return;
    uint64_t sum = made_from_command(b->command->name);
    for (size_t i = 0; i < b->own->count; i++)
        sum = made_from_bytes(sum, b->own->items[i], strlen(b->own->items[i]));
    sum = made_from_bytes(sum, file.data, file.size);
    snprintf(key, KEY_TEXT, "k%016" PRIx64, sum); // no number for a spreadsheet
    sl_free(context, file.data);
}

/// An argument with the name of the plan in place of each {}.
static char *fill_in(sl_context *context, const char *argument, const char *plan) {
    size_t length, count = 0;
    const char *name = input_base_name(plan, &length);
    for (const char *at = argument; (at = strstr(at, "{}")); at += 2) count++;
    char *text = sl_alloc(context, strlen(argument) + count * length + 1), *to = text;
    if (!text) return NULL;
    for (const char *hole; (hole = strstr(argument, "{}")); argument = hole + 2) {
        memcpy(to, argument, (size_t)(hole - argument));
        to += hole - argument;
        memcpy(to, name, length);
        to += length;
    }
    memcpy(to, argument, strlen(argument) + 1);
    return text;
}

static sl_status read_scratch(sl_context *context, FILE *file, sl_bytes *out) {
    const long size = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    *out = (sl_bytes){0};
    if (size < 0 || fseek(file, 0, SEEK_SET) != 0)
        return sl_fail(context, SL_IO, "a temporary file: %s", strerror(errno));
    out->data = sl_alloc(context, (size_t)size + 1);
    if (!out->data) return SL_NO_MEMORY;
    out->size = fread(out->data, 1, (size_t)size, file);
    out->data[out->size] = '\0';
    return SL_OK;
}

/// Adds what the command said on stderr: the last line that is no note, and all notes. Both texts
/// are as long as the whole.
static sl_status add_words(sl_context *context, batch_row *row, char *text, bool failed) {
    const char *message = failed ? "no word of why" : "";
    char *notes = sl_alloc(context, 2 * strlen(text) + 1);
    if (!notes) return SL_NO_MEMORY;
    *notes = '\0';
    for (char *line = text, *end; *line; line = end) {
        end = line + strcspn(line, "\r\n");
        while (*end && strchr("\r\n", *end)) *end++ = '\0';
        if (strncmp(line, "note: ", 6) == 0) {
            if (*notes) strcat(notes, "; ");
            strcat(notes, line + 6);
        } else if (failed) {
            message = strncmp(line, "sightline: ", 11) == 0 ? line + 11 : line;
        }
    }
    sl_status status = batch_row_add(context, row, COLUMN_MESSAGE, message);
    if (status == SL_OK) status = batch_row_add(context, row, COLUMN_NOTES, notes);
    sl_free(context, notes);
    return status;
}

/// 3: a check has found what it looks for. That is an answer.
static bool is_answer(int exit_status) {
    return exit_status == 0 || exit_status == 3;
}

static sl_status add_answer(sl_context *context, const batch *b, batch_row *row, const char *plan,
                            const char *key, int exit_status, const sl_bytes *out, sl_bytes *err) {
    batch_row answer = {0};
    char number[SL_NUMBER_TEXT];
    sl_status status = SL_OK;
    if (is_answer(exit_status))
        status = b->command->table ? batch_row_add_table(context, &answer, out->data, out->size)
                                   : batch_row_add_json(context, &answer, out->data, out->size);
    // No answer, as after '-- --help', is the plan's failure and no other's.
    const bool unread = status == SL_BAD_INPUT;
    if (unread) {
        batch_row_destroy(context, &answer);
        exit_status = 2;
        status = SL_OK;
    }
    snprintf(number, sizeof number, "%d", exit_status);
    if (status == SL_OK) status = batch_row_add(context, row, COLUMN_PLAN, plan);
    if (status == SL_OK) status = batch_row_add(context, row, COLUMN_STATUS, number);
    if (status == SL_OK && unread)
        status = batch_row_add(context, row, COLUMN_MESSAGE, sl_context_message(context));
    if (status == SL_OK && !unread)
        status = add_words(context, row, err->data, !is_answer(exit_status));
    if (status == SL_OK) status = batch_row_add(context, row, COLUMN_KEY, key);
    for (size_t i = 0; status == SL_OK && i < answer.cells.count; i++)
        status =
            batch_row_add(context, row, answer.cells.items[i].column, answer.cells.items[i].text);
    batch_row_destroy(context, &answer);
    return status;
}

static bool is_stopped(void *user) {
    return sl_check_cancelled(user) != SL_OK;
}

static sl_status run_words(sl_context *context, const batch *b, char *const *words,
                           const char *plan, const char *key, batch_row *row) {
    FILE *files[2] = {system_open_scratch(), system_open_scratch()};
    sl_bytes texts[2] = {{0}, {0}};
    int code = 0;
    sl_status status = SL_OK;
    if (!files[0] || !files[1])
        status = sl_fail(context, SL_IO, "a temporary file: %s", strerror(errno));
    else if (!system_run(words, files[0], files[1], is_stopped, context, &code))
        status = sl_fail(context, SL_IO, "%s: %s", words[0], strerror(errno));
    if (status == SL_OK) status = sl_check_cancelled(context);
    for (size_t i = 0; i < 2; i++) {
        if (status == SL_OK) status = read_scratch(context, files[i], &texts[i]);
        if (files[i]) fclose(files[i]);
    }
    if (status == SL_OK)
        status = add_answer(context, b, row, plan, key, code, &texts[0], &texts[1]);
    sl_free(context, texts[0].data);
    sl_free(context, texts[1].data);
    return status;
}

static sl_status run_plan(sl_context *context, const batch *b, const char *plan, const char *key,
                          batch_row *row) {
    const size_t own = b->own->count;
    char **words = sl_alloc_array(context, own + EXTRA, sizeof *words);
    if (!words) return SL_NO_MEMORY;
    size_t count = 0, i = 0;
    words[count++] = sl_copy_text(context, b->program, strlen(b->program));
    words[count++] = sl_copy_text(context, b->command->name, strlen(b->command->name));
    words[count++] = sl_copy_text(context, plan, strlen(plan));
    while (i < own) words[count++] = fill_in(context, b->own->items[i++], plan);
    const size_t made = count;
    words[count++] = b->command->table ? "--output=-" : "--json";
    if (b->is_one_thread) words[count++] = "--threads=1";
    for (i = 0; i < made && words[i];) i++;
    const sl_status status =
        i == made ? run_words(context, b, words, plan, key, row) : SL_NO_MEMORY;
    for (i = 0; i < made; i++) sl_free(context, words[i]);
    sl_free(context, words);
    return status;
}

// --- all plans

static int exit_status_of(const batch_row *row) {
    const char *text = batch_row_at(row, COLUMN_STATUS);
    return text ? (int)strtol(text, NULL, 10) : 1;
}

/// The row of the plan in the table that is resumed; NULL: it must be made.
static const batch_row *find_old(const batch *b, const char *plan, const char *key) {
    for (size_t i = 0; i < b->old_count && *key; i++) {
        const char *name = batch_row_at(&b->old[i], COLUMN_PLAN);
        const char *from = batch_row_at(&b->old[i], COLUMN_KEY);
        if (name && from && strcmp(name, plan) == 0 && strcmp(from, key) == 0 &&
            is_answer(exit_status_of(&b->old[i])))
            return &b->old[i];
    }
    return NULL;
}

/// Takes the rows that are kept from the table that is resumed, and lists all other plans. So the
/// time that is left is that of plans that are run.
static sl_status take_old(sl_context *context, batch *b) {
    for (size_t i = 0; i < b->plans.count; i++) {
        char key[KEY_TEXT] = "";
        SL_TRY(sl_check_cancelled(context));
        if (b->old_count) write_key(context, b, b->plans.items[i], key);
        const batch_row *old = find_old(b, b->plans.items[i], key);
        if (!old) b->open[b->open_count++] = i;
        for (size_t k = 0; old && k < old->cells.count; k++)
            SL_TRY(batch_row_add(context, &b->rows[i], old->cells.items[k].column,
                                 old->cells.items[k].text));
    }
    return SL_OK;
}

/// Keeps the row. The table is written once a second, so that what is done outlives the program.
static sl_status keep(sl_context *context, batch *b, size_t number, const batch_row *row) {
    sl_status status = SL_OK;
    pthread_mutex_lock(&b->lock);
    b->rows[number] = *row;
    const double now = sl_seconds();
    if (strcmp(b->output, "-") != 0 && now - b->written >= 1) {
        status = batch_write(context, b->rows, b->plans.count, b->output);
        b->written = sl_seconds();
    }
    pthread_mutex_unlock(&b->lock);
    return status;
}

static sl_status do_plan(sl_context *context, void *job, void *state, size_t number) {
    (void)state;
    batch *b = job;
    const char *plan = b->plans.items[b->open[number]];
    char key[KEY_TEXT];
    batch_row row = {0};
    write_key(context, b, plan, key);
    const sl_status status = run_plan(context, b, plan, key, &row);
    if (status == SL_OK) return keep(context, b, b->open[number], &row);
    batch_row_destroy(context, &row);
    return status;
}

/// Names the plans that failed. SL_BAD_INPUT where their input is wrong, SL_IO where work failed.
static sl_status judge(command_console *console, const batch *b) {
    size_t failed = 0;
    bool wrong = true;
    for (size_t i = 0; i < b->plans.count; i++) {
        const int code = exit_status_of(&b->rows[i]);
        console->fault |= code == 3;
        if (is_answer(code)) continue;
        failed++;
        wrong &= code == 2;
        const char *message = batch_row_at(&b->rows[i], COLUMN_MESSAGE), *plan = b->plans.items[i];
        const bool named = message && strncmp(message, plan, strlen(plan)) == 0;
        sl_note(console->context, "%s%s%s", named ? "" : plan, named ? "" : ": ", message);
    }
    if (!failed) return SL_OK;
    return sl_fail(console->context, wrong ? SL_BAD_INPUT : SL_IO,
                   "%zu of %zu plan%s failed; the table says why", failed, b->plans.count,
                   b->plans.count == 1 ? "" : "s");
}

static sl_status run_all(command_console *console, batch *b, uint32_t jobs) {
    sl_context *context = console->context;
    const sl_work work = {.job = b, .unit = do_plan, .stage = "batch", .units = "plans"};
    const bool is_file = strcmp(b->output, "-") != 0;
    b->rows = sl_alloc_array(context, b->plans.count, sizeof *b->rows);
    b->open = sl_alloc_array(context, b->plans.count, sizeof *b->open);
    if (!b->rows || !b->open) return SL_NO_MEMORY;
    b->written = sl_seconds();
    SL_TRY(take_old(context, b)); // the old table stays if this is interrupted
    const sl_status status = sl_work_run(context, &work, b->open_count, jobs);
    size_t done = 0;
    for (size_t i = 0; i < b->plans.count; i++) done += b->rows[i].cells.count > 0;
    if (status == SL_CANCELLED && is_file && done) {
        SL_TRY(batch_write(context, b->rows, b->plans.count, b->output));
        return sl_fail(context, status, "interrupted: %s has %zu of %zu plans; --resume goes on",
                       b->output, done, b->plans.count);
    }
    SL_TRY(status);
    SL_TRY(batch_write(context, b->rows, b->plans.count, b->output));
    if (is_file && !console->quiet)
        printf("%zu plan%s: %s\n", done, done == 1 ? "" : "s", b->output);
    return judge(console, b);
}

static sl_status run_batch(command_console *console, batch *b, const char *list, bool resume,
                           uint32_t jobs) {
    sl_context *context = console->context;
    SL_TRY(output_check_apart(context, list, "-o", b->output));
    SL_TRY(read_list(context, list, b));
    SL_TRY(check_arguments(context, b));
    if (resume && sl_path_look(b->output) == SL_PATH_FILE)
        SL_TRY(batch_read(context, b->output, COLUMN_KEY, &b->old, &b->old_count));
    return run_all(console, b, jobs);
}

sl_status cmd_batch(command_console *console, int argc, char **argv) {
    const char *operands[2], *output = "-";
    uint32_t jobs = 0;
    bool resume = false;
    option_list own = {.count = 0};
    const name_table names = {"command", commands, sizeof *commands,
                              sizeof commands / sizeof *commands, NULL};
    const option_spec table[] = {
        {"output", 'o', "FILE.csv", "the table (default: standard output)", .text = &output,
         .check = CHECK_TABLE},
        {"resume", 0, NULL,
         "keep the rows of the table whose plan, command, options and version are the same; run "
         "the others, and those that failed. Other files that options name are not compared",
         .flag = &resume, .without = "output"},
        {"jobs", 'j', "N", "number of plans at a time (default: one per core)", .count32 = &jobs,
         .least = 1, .most = 1024},
    };
    const command_usage usage = {
        .name = "batch",
        .synopsis = "COMMAND LIST [-o FILE.csv] [options] [-- OPTIONS]",
        .operands = {"COMMAND", "LIST"},
        .what = "Runs a command for each plan of a list, a path on each line ('-': standard input, "
                "'#': a comment), and writes a table with a row for each. COMMAND is info, check, "
                "bake, eye, isovist, place, cover, path, vga, axial or segments. Columns are the "
                "numbers and texts of its --json, or the mean and the deviation of each column of "
                "its table. Of a grid in several parts, measures of the graph count in the largest "
                "part only, as in the summary of vga. OPTIONS are those of the command; {} in one "
                "is the plan's name without folder and ending. A plan that fails is named, has its "
                "message in the table, and harms no other; the exit status is then 2, or 1 if the "
                "fault was not in the input.",
        .examples = "  ls schools/*.dxf | sightline batch check - -o schools.csv\n"
                    "  sightline batch vga schools.txt -o vga.csv -- --grid 1\n"
                    "  sightline batch vga schools.txt -o vga.csv --resume -- --grid 1\n"
                    "  sightline batch bake schools.txt -- --inside -o 'baked/{}.slv'",
        .options = table,
        .option_count = sizeof table / sizeof *table,
        .more = &own,
    };
    bool helped;
    size_t index;
    SL_TRY(options_parse(console, &usage, argc, argv, operands, &helped));
    if (helped) return SL_OK;
    SL_TRY(read_choice(console->context, "COMMAND", operands[0], &names, &index));
    if (own.count && (own.items[0][0] != '-' || !own.items[0][1]))
        return sl_fail(console->context, SL_BAD_ARGUMENT,
                       "'%s' is one argument too many; the options of %s come after '--'",
                       own.items[0], operands[0]);
    if (resume && strcmp(output, "-") == 0)
        return sl_fail(console->context, SL_BAD_ARGUMENT, "--resume needs a file: -o FILE.csv");
    batch b = {.command = &commands[index],
               .output = output,
               .program = console->words[0],
               .own = &own,
               .is_one_thread = commands[index].threads && jobs != 1,
               .lock = PTHREAD_MUTEX_INITIALIZER};
    const sl_status status = run_batch(console, &b, operands[1], resume, jobs);
    batch_destroy(console->context, &b);
    return status;
}

/// Checks the names of outputs, and writes folders of files all or none.
#include "arguments/outputs.h"

#include "sightline/support.h"
#include "system/built.h"
#include "system/system.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ENDINGS_TEXT = 96 };

// --- names

/// A name as system.h takes it: "-" is a standard stream.
static const char *named(const char *path) {
    return strcmp(path, "-") == 0 ? NULL : path;
}

bool output_is_same(const char *path, const char *other) {
    return strcmp(path, other) == 0 || system_is_one_file(named(path), 1, named(other), 1);
}

sl_status output_check_apart(sl_context *context, const char *input, const char *option,
                             const char *output) {
    const bool same = system_is_one_file(named(input), 0, named(output), 1);
    if (!same || strcmp(output, "-") == 0) return SL_OK; // the shell has opened stdout already
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "%s %s: is the input itself, which would be lost; give another name", option,
                   output);
}

/// Whether a name stands for stdout, a pipe or a device: such names have no ending.
static bool is_stream(const char *path) {
    return strcmp(path, "-") == 0 || sl_path_look(path) == SL_PATH_STREAM;
}

bool output_is_plain_file(const char *path) {
    return strcmp(path, "-") != 0 && sl_path_look(path) == SL_PATH_FILE;
}

bool output_has_ending(const char *path, const char *endings) {
    for (const char *word = endings; *word; word += strspn(word, " ")) {
        const size_t length = strcspn(word, " ");
        char ending[32];
        snprintf(ending, sizeof ending, "%.*s", (int)length, word);
        if (name_ends_with(path, ending)) return true;
        word += length;
    }
    return false;
}

sl_status output_fail_ending(sl_context *context, const char *option, const char *output,
                             const char *endings) {
    char list[160] = "";
    for (const char *word = endings; *word;) {
        const size_t length = strcspn(word, " "), used = strlen(list);
        const char *next = word + length + strspn(word + length, " ");
        const char *joint = word == endings ? "" : *next ? ", " : " or ";
        snprintf(list + used, sizeof list - used, "%s%.*s", joint, (int)length, word);
        word = next;
    }
    return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: end the name in %s", option, output, list);
}

/// Whether the last part of a path has a dot behind its first character.
static bool has_some_ending(const char *path) {
    const char *base = sl_path_name(path);
    const char *dot = strrchr(base, '.');
    return dot && dot > base;
}

sl_status output_check_file(sl_context *context, const char *option, const char *output,
                            const char *endings) {
    if (!*output) return sl_fail(context, SL_BAD_ARGUMENT, "%s is empty; name a file", option);
    if (endings && !is_stream(output) && !output_has_ending(output, endings))
        return output_fail_ending(context, option, output, endings);
    return sl_output_try(context, output);
}

/// Two lists of endings as one.
static void join_endings(const char *first, const char *more, char all[ENDINGS_TEXT]) {
    snprintf(all, ENDINGS_TEXT, "%s%s%s", first, more ? " " : "", more ? more : "");
}

sl_status output_check_table(sl_context *context, const char *option, const char *output,
                             const char *more) {
    char all[ENDINGS_TEXT];
    join_endings(OUTPUT_TABLES, more, all);
    return output_check_file(context, option, output, has_some_ending(output) ? all : NULL);
}

sl_status output_check_baked(sl_context *context, const char *option, const char *output) {
    if (!name_ends_with(output, ".slv"))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "%s %s: the name of a baked file ends in .slv, by which it is known", option,
                       output);
    return output_check_file(context, option, output, NULL);
}

sl_status output_check_picture(sl_context *context, const char *option, const char *output,
                               const char *more) {
    char all[ENDINGS_TEXT];
    join_endings(".png .svg .pdf", more, all);
    if (!more || !output_has_ending(output, more)) SL_TRY(built_need_pictures(context));
    if (!output_has_ending(output, all)) return output_fail_ending(context, option, output, all);
    return output_check_file(context, option, output, NULL);
}

/// What the names of exports end with; `named` where the format is given by name.
static const struct {
    const char *format, *endings, *named;
} exports[] = {
    {"json", ".json", ".json"}, {"csv", OUTPUT_TABLES, OUTPUT_TABLES},
    {"c", ".h", ".h"},          {"geojson", ".geojson", ".geojson .json"},
    {"png", ".png", ".png"},    {"reject", ".wad", ".wad"},
};

sl_status output_choose_export(sl_context *context, const name_table *formats, const char *option,
                               const char *output, const char *given, size_t *chosen) {
    char all[160] = "";
    if (is_stream(output) || !has_some_ending(output)) return SL_OK;
    for (size_t i = 0; i < formats->count; i++) {
        const char *endings = NULL, *name = name_table_at(formats, i);
        for (size_t k = 0; k < sizeof exports / sizeof *exports; k++)
            if (strcmp(exports[k].format, name) == 0)
                endings = given ? exports[k].named : exports[k].endings;
        if (given && i != *chosen) continue;
        if (!endings) return SL_OK; // a format that may have any ending
        if (output_has_ending(output, endings)) {
            *chosen = i;
            return SL_OK;
        }
        const size_t used = strlen(all);
        snprintf(all + used, sizeof all - used, "%s%s", used ? " " : "", endings);
    }
    return output_fail_ending(context, option, output, all);
}

option_table picture_option_table(sl_draw_options *drawing, const char *output, bool titled) {
    const bool rare = strcmp(output, "output") != 0; // a command that does more than draw
    const option_spec options[] = {
        {"width", 0, "PX", "width of the picture: 64 to 20000 pixels or points",
         .number = &drawing->width, .least = SL_DRAW_WIDTH_MIN, .most = SL_DRAW_WIDTH_MAX,
         .without = output},
        {"dark", 0, NULL, "draw light on dark", .flag = &drawing->dark, .without = output},
        {"title", 0, "TEXT", "write a line over the picture", .text = &drawing->title,
         .without = output},
        {"paper", 0, "A3",
         "draw on a sheet of paper to scale, A4 to A0, with a title block: .pdf or .svg",
         .text = &drawing->sheet.paper, .topic = "on paper", .without = output, .rare = rare},
        {"plot-scale", 0, "1:N",
         "with --paper: draw the plan at 1:N, as 1:100 (default: the largest round scale that "
         "fits)",
         .text = &drawing->sheet.scale, .topic = "on paper", .without = "paper", .rare = rare},
        {"north", 0, "X,Y",
         "with --paper: draw an arrow to north, which is this direction in the map, as 0,1",
         .point = &drawing->sheet.north, .topic = "on paper", .without = "paper", .rare = rare},
        {"note", 0, "TEXT", "with --paper: write a line under the title",
         .text = &drawing->sheet.note, .topic = "on paper", .without = "paper", .rare = rare},
    };
    option_table table = {0};
    option_table_add(&table, options, titled ? 7 : 2);
    return table;
}

// --- folders

static char *join(sl_context *context, const char *folder, const char *name) {
    const size_t length = strlen(folder) + strlen(name) + 2;
    char *path = sl_alloc(context, length);
    if (path) snprintf(path, length, "%s/%s", folder, name);
    return path;
}

char *folder_file(sl_context *context, const output_folder *folder, const char *name) {
    return join(context, folder->temporary, name);
}

static sl_status fail_write(sl_context *context, const char *path) {
    return sl_fail(context, SL_IO, "%s: cannot write: %s", path, strerror(errno));
}

/// Checks that nothing else has the names of the folder and its files.
static sl_status look(sl_context *context, output_folder *folder) {
    const sl_path_kind there = sl_path_look(folder->path);
    folder->exists = there != SL_PATH_NOTHING;
    if (!folder->exists) return SL_OK;
    if (there != SL_PATH_FOLDER)
        return sl_fail(context, SL_BAD_ARGUMENT, "%s: is no folder", folder->path);
    for (size_t i = 0; folder->names[i]; i++) {
        char *file = join(context, folder->path, folder->names[i]);
        if (!file) return SL_NO_MEMORY;
        sl_status status = SL_OK;
        const sl_path_kind kind = sl_path_look(file);
        if (kind != SL_PATH_NOTHING && kind != SL_PATH_FILE)
            status = sl_fail(context, SL_BAD_ARGUMENT, "%s: is in the way, and no file", file);
        sl_free(context, file);
        SL_TRY(status);
    }
    return SL_OK;
}

/// The temporary folder is in the folder if that exists, so that files never move between file
/// systems. Else it is beside it, and is renamed to it at the end.
static sl_status make_temporary(sl_context *context, output_folder *folder) {
    const size_t length = strlen(folder->path) + sizeof "/.XXXXXX";
    folder->temporary = sl_alloc(context, length);
    if (!folder->temporary) return SL_NO_MEMORY;
    snprintf(folder->temporary, length, "%s%s.XXXXXX", folder->path, folder->exists ? "/" : "");
    if (system_make_folder(folder->temporary)) return SL_OK;
    folder->temporary[0] = '\0';
    return fail_write(context, folder->path);
}

sl_status folder_open(sl_context *context, const char *path, const char *const *names,
                      output_folder *out) {
    size_t length = strlen(path);
    while (length > 1 && path[length - 1] == '/') length--;
    if (!length) return sl_fail(context, SL_BAD_ARGUMENT, "a folder without a name");
    *out = (output_folder){.names = names, .path = sl_copy_text(context, path, length)};
    sl_status status = out->path ? look(context, out) : SL_NO_MEMORY;
    if (status == SL_OK) status = make_temporary(context, out);
    return status == SL_OK ? SL_OK : folder_close(context, out, status);
}

/// Replaces what a link leads to, and leaves the link.
static sl_status copy_file(sl_context *context, const char *from, const char *to) {
    sl_bytes bytes;
    sl_output output;
    SL_TRY(sl_file_read(context, from, &bytes));
    sl_status status = sl_output_open(context, to, &output);
    if (status == SL_OK) {
        fwrite(bytes.data, 1, bytes.size, output.stream);
        status = sl_output_close(context, &output, SL_OK);
    }
    sl_free(context, bytes.data);
    return status;
}

static sl_status move_file(sl_context *context, const output_folder *folder, const char *name) {
    char *from = join(context, folder->temporary, name), *to = join(context, folder->path, name);
    sl_status status = from && to ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK && system_is_link(to)) {
        status = copy_file(context, from, to);
        system_remove_file(from);
    } else if (status == SL_OK && !system_move(from, to))
        status = fail_write(context, to);
    sl_free(context, from);
    sl_free(context, to);
    return status;
}

static void remove_file(sl_context *context, const output_folder *folder, const char *name) {
    char *path = join(context, folder->temporary, name);
    if (path) system_remove_file(path);
    sl_free(context, path);
}

sl_status folder_close(sl_context *context, output_folder *folder, sl_status status) {
    const bool made = folder->temporary && folder->temporary[0];
    if (status == SL_OK && !folder->exists && !system_move(folder->temporary, folder->path))
        status = fail_write(context, folder->path);
    for (size_t i = 0; folder->exists && folder->names[i] && status == SL_OK; i++)
        status = move_file(context, folder, folder->names[i]);
    if (made && (status != SL_OK || folder->exists)) {
        for (size_t i = 0; folder->names[i]; i++) remove_file(context, folder, folder->names[i]);
        system_remove_folder(folder->temporary);
    }
    sl_free(context, folder->path);
    sl_free(context, folder->temporary);
    *folder = (output_folder){0};
    return status;
}

// --- sizes

void size_write(uint64_t bytes, char text[SIZE_TEXT]) {
    static const char *const units[] = {"KiB", "MiB", "GiB", "TiB"};
    if (bytes < 1024) {
        snprintf(text, SIZE_TEXT, "%u bytes", (unsigned)bytes);
        return;
    }
    double size = (double)bytes / 1024;
    unsigned unit = 0;
    for (; size >= 1000 && unit < 3; unit++) size /= 1024;
    snprintf(text, SIZE_TEXT, "%.*f %s", size < 100 ? 1 : 0, size, units[unit]);
}

#include "inputs.h"

#include "built.h"
#include "options.h"
#include "sightline/support.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

bool sl_input_ends_with(const char *path, const char *ending) {
    const size_t length = strlen(path), tail = strlen(ending);
    return length > tail && strcasecmp(path + length - tail, ending) == 0;
}

const char *sl_input_base_name(const char *path, size_t *length) {
    const char *slash = strrchr(path, '/');
    const char *base = slash ? slash + 1 : path;
    const char *dot = strrchr(base, '.');
    *length = dot && dot > base ? (size_t)(dot - base) : strlen(base);
    return base;
}

static bool is_baked_name(const char *path) {
    return sl_input_ends_with(path, ".slv");
}

/// Whether the name ends as that of a map does, of any format.
static bool is_map_name(const sl_context *context, const char *path) {
    size_t count;
    const sl_map_format *formats = sl_map_formats(context, &count);
    for (size_t i = 0; i < count; i++) {
        for (const char *word = formats[i].endings; *word;) {
            const size_t length = strcspn(word, " ");
            char ending[32];
            snprintf(ending, sizeof ending, "%.*s", (int)length, word);
            if (sl_input_ends_with(path, ending)) return true;
            word += length;
            word += strspn(word, " ");
        }
    }
    return false;
}

static sl_status read_options(sl_context *context, const sl_input_texts *texts,
                              sl_import_options *options) {
    *options = sl_import_options_default();
    SL_TRY(sl_option_number(context, "--slice", texts->slice, &options->slice));
    SL_TRY(sl_option_number(context, "--tolerance", texts->tolerance, &options->tolerance));
    SL_TRY(sl_option_number(context, "--threshold", texts->threshold, &options->threshold));
    if (texts->tolerance && options->tolerance <= 0)
        return sl_fail(context, SL_BAD_ARGUMENT, "--tolerance %s: a number over 0 is needed",
                       texts->tolerance);
    if (texts->threshold && !(options->threshold > 0 && options->threshold <= 1))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--threshold %s: a number over 0, at most 1, is needed", texts->threshold);
    options->has_slice = texts->slice != NULL;
    options->map = texts->map;
    options->layers = texts->layers;
    options->unit = texts->unit;
    options->doors = texts->doors;
    options->sectors = texts->sectors;
    options->cells = texts->cells;
    return SL_OK;
}

sl_status sl_input_read_map(sl_context *context, const char *path, const sl_input_texts *texts,
                            sl_map *map) {
    if (is_baked_name(path))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "%s: is baked already; name the map that it was made from", path);
    sl_import_options options;
    SL_TRY(read_options(context, texts, &options));
    return sl_map_read(context, path, &options, map);
}

sl_status sl_input_clean(sl_context *context, const sl_input_texts *texts, sl_map *map,
                         sl_clean_account *account) {
    sl_clean_options options = sl_clean_options_default();
    SL_TRY(sl_option_number(context, "--weld", texts->weld, &options.weld));
    if (texts->weld && options.weld < 0)
        return sl_fail(context, SL_BAD_ARGUMENT, "--weld %s: 0 or a number over 0 is needed",
                       texts->weld);
    return sl_map_clean(context, map, &options, account);
}

sl_status sl_input_refuse_texts(sl_context *context, const char *path,
                                const sl_input_texts *texts) {
    const char *given = texts->map         ? "map"
                        : texts->slice     ? "slice"
                        : texts->layers    ? "layers"
                        : texts->tolerance ? "tolerance"
                        : texts->unit      ? "unit"
                        : texts->threshold ? "threshold"
                        : texts->weld      ? "weld"
                        : texts->doors     ? "doors"
                        : texts->sectors   ? "sectors"
                                           : NULL;
    if (!given) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT, "--%s: %s is baked; the option is for reading a map",
                   given, path);
}

sl_status sl_input_read_baked(sl_context *context, const char *path, sl_baked *baked) {
    if (is_map_name(context, path))
        return sl_fail(
            context, SL_BAD_ARGUMENT,
            "%s: is a map, not a baked file; bake it first: sightline bake %s -o FILE.slv", path,
            path);
    SL_TRY(sl_baked_read(context, path, baked));
    char partial[SL_PARTIAL_TEXT];
    sl_baked_say_partial(baked, partial);
    if (partial[0]) sl_note(context, "%s is %s", path, partial);
    return SL_OK;
}

static bool is_same_file(const char *path, const char *other) {
    struct stat a, b;
    return stat(path, &a) == 0 && stat(other, &b) == 0 && a.st_dev == b.st_dev &&
           a.st_ino == b.st_ino && S_ISREG(a.st_mode);
}

sl_status sl_output_check(sl_context *context, const char *path, const char *option,
                          const char *output) {
    if (!output) return SL_OK;
    if (!*output) return sl_fail(context, SL_BAD_ARGUMENT, "%s is empty; name a file", option);
    if (!is_same_file(path, output)) return sl_output_try(context, output);
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "%s %s: is the input itself, which would be lost; give another name", option,
                   output);
}

sl_status sl_output_check_baked(sl_context *context, const char *path, const char *option,
                                const char *output) {
    if (output && !is_baked_name(output))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "%s %s: the name of a baked file ends in .slv, by which it is known", option,
                       output);
    return sl_output_check(context, path, option, output);
}

/// The map that a baked file was made from: what it kept of it, and the walls of its space.
static sl_status read_map_of_baked(sl_context *context, const char *path, sl_map *map) {
    sl_baked baked = {0};
    SL_TRY(sl_baked_read(context, path, &baked));
    sl_status status = SL_OK;
    const sl_space *space = &baked.space;
    for (uint32_t i = 0; i < space->wall_count && status == SL_OK; i++) {
        const sl_wall *wall = &space->walls[i];
        status = sl_map_add_wall(context, &baked.map, wall->a, wall->b, wall->line);
    }
    if (status == SL_OK) {
        *map = baked.map;
        baked.map = (sl_map){0};
    }
    sl_baked_destroy(context, &baked);
    return status;
}

sl_status sl_input_read_either(sl_context *context, const char *path, const sl_input_texts *texts,
                               sl_map *map) {
    if (!is_baked_name(path)) return sl_input_read_map(context, path, texts, map);
    SL_TRY(sl_input_refuse_texts(context, path, texts));
    return read_map_of_baked(context, path, map);
}

void sl_input_print_formats(void) {
    sl_context *context = sl_context_create(NULL);
    if (!context) return;
    size_t count;
    (void)sl_built_use_formats(context); // with no memory: the formats that are always there
    const sl_map_format *formats = sl_map_formats(context, &count);
    puts("\nmaps, by the ending of the file's name:");
    for (size_t i = 0; i < count; i++) printf("  %-28s%s\n", formats[i].endings, formats[i].what);
    printf("  %-28s%s\n", "-", "standard input, by its first bytes, else as the map text");
    sl_context_destroy(context);
}

sl_status sl_input_fail_outside(sl_context *context, const char *name, const char *text,
                                sl_box bounds) {
    const double values[4] = {bounds.min.x, bounds.min.y, bounds.max.x, bounds.max.y};
    char numbers[4][SL_NUMBER_TEXT];
    for (int i = 0; i < 4; i++) sl_number_write(values[i], numbers[i]);
    return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: outside the map, which is %s,%s to %s,%s",
                   name, text, numbers[0], numbers[1], numbers[2], numbers[3]);
}

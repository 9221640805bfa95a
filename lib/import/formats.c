#include "import/wad.h"
#include "sightline/import.h"
#include "sightline/support.h"

#include <string.h>
#include <strings.h>

sl_import_options sl_import_options_default(void) {
    return (sl_import_options){.has_slice = false};
}

static sl_status read_text(sl_context *context, const char *name, const char *text, size_t size,
                           const sl_import_options *options, sl_map *map) {
    (void)options;
    return sl_map_read_text(context, name, text, size, map);
}

static sl_status read_plan(sl_context *context, const char *name, const char *text, size_t size,
                           const sl_import_options *options, sl_map *map) {
    (void)options;
    return sl_map_read_plan(context, name, text, size, map);
}

static bool knows_svg(const char *text, size_t size) {
    (void)size;
    return *text == '<' && strstr(text, "<svg");
}

static bool knows_image(const char *text, size_t size) {
    return (size > 4 && memcmp(text, "\x89PNG", 4) == 0) ||
           (size > 3 && text[0] == 'P' && strchr("1245", text[1]) && strchr(" \t\r\n#", text[2]));
}

static bool knows_tmx(const char *text, size_t size) {
    (void)size;
    return *text == '<' && strstr(text, "<map") && strstr(text, "tilewidth");
}

/// Whether the text begins as JSON does and has both words in quotation marks somewhere.
static bool is_json_with(const char *text, const char *word, const char *other) {
    const char *at = text + strspn(text, "\xef\xbb\xbf \t\r\n");
    return (*at == '{' || *at == '[') && strstr(at, word) && strstr(at, other);
}

static bool knows_tmj(const char *text, size_t size) {
    (void)size;
    return is_json_with(text, "\"tilewidth\"", "\"layers\"");
}

static bool knows_ldtk(const char *text, size_t size) {
    (void)size;
    return is_json_with(text, "\"__header__\"", "\"ldtk") ||
           is_json_with(text, "\"__header__\"", "LDtk");
}

static bool knows_uvtt(const char *text, size_t size) {
    (void)size;
    return is_json_with(text, "\"line_of_sight\"", "\"resolution\"");
}

static bool knows_export(const char *text, size_t size) {
    (void)size;
    return is_json_with(text, "\"format\"", "\"sightline\"");
}

static bool knows_foundry(const char *text, size_t size) {
    (void)size;
    return is_json_with(text, "\"c\"", "\"move\"") ||
           is_json_with(text, "\"walls\"", "\"padding\"");
}

static bool knows_wad(const char *text, size_t size) {
    return sl_wad_known(text, size);
}

static const sl_map_format formats[] = {
    {.name = "text",
     .endings = ".map",
     .what = "the map text",
     .read = read_text,
     .takes = SL_TAKES_CELLS},
    {.name = "plan", .endings = ".txt", .what = "an ASCII plan", .read = read_plan},
    {.name = "unigrafix",
     .endings = ".ug",
     .what = "a UniGrafix model, cut at a height",
     .read = sl_map_read_unigrafix,
     .heights = sl_map_heights_unigrafix,
     .takes = SL_TAKES_SLICE},
    {.name = "dxf",
     .endings = ".dxf",
     .what = "a DXF drawing",
     .read = sl_map_read_dxf,
     .takes = SL_TAKES_LAYERS | SL_TAKES_TOLERANCE | SL_TAKES_UNIT},
    {.name = "svg",
     .endings = ".svg",
     .what = "an SVG drawing",
     .read = sl_map_read_svg,
     .takes = SL_TAKES_LAYERS | SL_TAKES_TOLERANCE,
     .knows = knows_svg},
    {.name = "image",
     .endings = ".png .pgm .pbm",
     .what = "a picture: its dark pixels are solid",
     .read = sl_map_read_image,
     .takes = SL_TAKES_THRESHOLD,
     .knows = knows_image},
    {.name = "ros",
     .endings = ".yaml .yml",
     .what = "a map of ROS: a picture with its scale",
     .read = sl_map_read_ros,
     .takes = SL_TAKES_THRESHOLD},
    {.name = "tmx",
     .endings = ".tmx",
     .what = "a map of Tiled",
     .read = sl_map_read_tmx,
     .takes = SL_TAKES_LAYERS | SL_TAKES_TOLERANCE,
     .knows = knows_tmx},
    {.name = "export",
     .endings = ".json",
     .what = "the walls of an export of ours",
     .read = sl_map_read_export,
     .knows = knows_export},
    {.name = "tmj",
     .endings = ".tmj .json",
     .what = "a map of Tiled, as JSON",
     .read = sl_map_read_tmj,
     .takes = SL_TAKES_LAYERS | SL_TAKES_TOLERANCE,
     .knows = knows_tmj},
    {.name = "ldtk",
     .endings = ".ldtk .ldtkl .json",
     .what = "a project or a level of LDtk",
     .read = sl_map_read_ldtk,
     .takes = SL_TAKES_LAYERS,
     .list = sl_map_list_ldtk,
     .knows = knows_ldtk},
    {.name = "uvtt",
     .endings = ".dd2vtt .uvtt .df2vtt .json",
     .what = "a Universal VTT map",
     .read = sl_map_read_uvtt,
     .takes = SL_TAKES_LAYERS | SL_TAKES_DOORS,
     .knows = knows_uvtt},
    {.name = "foundry",
     .endings = ".json",
     .what = "a scene of Foundry VTT",
     .read = sl_map_read_foundry,
     .takes = SL_TAKES_DOORS,
     .knows = knows_foundry},
    {.name = "wad",
     .endings = ".wad",
     .what = "a Doom WAD, classic, Hexen's or UDMF",
     .read = sl_map_read_wad,
     .takes = SL_TAKES_DOORS | SL_TAKES_CELLS | SL_TAKES_SECTORS,
     .list = sl_map_list_wad,
     .knows = knows_wad},
};
#define FORMAT_COUNT (sizeof formats / sizeof *formats)

const sl_map_format *sl_map_formats(size_t *count) {
    *count = FORMAT_COUNT;
    return formats;
}

// --- which format

/// Whether a path ends so, in small letters or capitals.
static bool ends_in(const char *path, const char *ending, size_t length) {
    const size_t all = strlen(path);
    return all >= length && strncasecmp(path + all - length, ending, length) == 0;
}

static bool has_ending(const sl_map_format *format, const char *path) {
    for (const char *at = format->endings; *at;) {
        const size_t length = strcspn(at, " ");
        if (ends_in(path, at, length)) return true;
        at += length + strspn(at + length, " ");
    }
    return false;
}

/// The format that the ending tells; where it tells several or none, the one that knows the bytes.
static const sl_map_format *find_format(const char *path, const sl_bytes *bytes) {
    const sl_map_format *by_ending = NULL, *by_bytes = NULL;
    size_t fitting = 0;
    for (size_t i = FORMAT_COUNT; i-- > 0;) {
        if (!has_ending(&formats[i], path)) continue;
        by_ending = &formats[i];
        fitting++;
    }
    if (fitting == 1) return by_ending;
    for (size_t i = FORMAT_COUNT; i-- > 0;) {
        if (fitting && !has_ending(&formats[i], path)) continue;
        if (formats[i].knows && formats[i].knows(bytes->data, bytes->size)) by_bytes = &formats[i];
    }
    return by_bytes ? by_bytes : by_ending ? by_ending : &formats[0];
}

// --- which of its maps

void sl_map_list_destroy(sl_context *context, sl_map_list *list) {
    for (size_t i = 0; i < list->count; i++) sl_free(context, list->names[i]);
    sl_free(context, list->names);
    *list = (sl_map_list){0};
}

sl_status sl_map_list_add(sl_context *context, sl_map_list *list, const char *name, size_t length) {
    SL_TRY(sl_reserve(context, &list->names, &list->room, list->count + 1, sizeof *list->names));
    char *copy = sl_copy_text(context, name, length);
    if (!copy) return SL_NO_MEMORY;
    list->names[list->count++] = copy;
    return SL_OK;
}

/// SL_BAD_ARGUMENT: "FILE: LEAD holds 36 maps, E1M1, E1M2, E1M3 ...: TAIL"
static sl_status fail_choice(sl_context *context, const char *path, const sl_map_list *list,
                             const char *lead, const char *tail) {
    enum { SHOWN = 6, MOST = 64 };
    char names[SHOWN * (MOST + 2) + 8] = "";
    for (size_t i = 0; i < list->count && i < SHOWN; i++) {
        const size_t used = strlen(names);
        snprintf(names + used, sizeof names - used, "%s%.*s", i ? ", " : "", (int)MOST,
                 list->names[i]);
    }
    return sl_fail(context, SL_BAD_ARGUMENT, "%s: %sit holds %zu map%s, %s%s%s", path, lead,
                   list->count, list->count == 1 ? "" : "s", names,
                   list->count > SHOWN ? " ..." : "", tail);
}

/// Puts the name of the map to read, as the file has it, into options->map.
static sl_status choose_map(sl_context *context, const char *path, const sl_map_list *list,
                            sl_import_options *options) {
    if (list->count == 0) return sl_fail_at(context, path, 0, "holds no map");
    if (!options->map && list->count > 1)
        return fail_choice(context, path, list, "", ": choose one by --map NAME");
    if (!options->map) {
        options->map = list->names[0];
        return SL_OK;
    }
    for (size_t i = 0; i < list->count; i++) {
        if (strcasecmp(list->names[i], options->map) != 0) continue;
        options->map = list->names[i];
        return SL_OK;
    }
    char lead[128];
    snprintf(lead, sizeof lead, "there is no map '%.64s': ", options->map);
    return fail_choice(context, path, list, lead, "");
}

// --- reading

/// SL_BAD_ARGUMENT where an option is given that the format does not take.
static sl_status check_options(sl_context *context, const char *path, const sl_map_format *format,
                               const sl_import_options *options) {
    const struct {
        const char *name;
        bool given, taken;
    } all[] = {
        {"map", options->map, format->list},
        {"slice", options->has_slice, format->takes & SL_TAKES_SLICE},
        {"layers", options->layers, format->takes & SL_TAKES_LAYERS},
        {"tolerance", options->tolerance != 0, format->takes & SL_TAKES_TOLERANCE},
        {"unit", options->unit, format->takes & SL_TAKES_UNIT},
        {"threshold", options->threshold != 0, format->takes & SL_TAKES_THRESHOLD},
        {"doors", options->doors, format->takes & SL_TAKES_DOORS},
        {"sectors", options->sectors, format->takes & SL_TAKES_SECTORS},
        {"subdivide given", options->cells, format->takes & SL_TAKES_CELLS},
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (all[i].given && !all[i].taken)
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "--%s: %s is read as %s, which has no use for it", all[i].name, path,
                           format->what);
    return SL_OK;
}

static sl_status read_format(sl_context *context, const char *path, const sl_map_format *format,
                             const sl_bytes *bytes, const sl_import_options *given, sl_map *map) {
    SL_TRY(check_options(context, path, format, given));
    sl_import_options options = *given;
    sl_map_list list = {0};
    sl_status status = SL_OK;
    if (format->list) {
        status = format->list(context, path, bytes->data, bytes->size, &list);
        if (status == SL_OK) status = choose_map(context, path, &list, &options);
    }
    if (status == SL_OK)
        status = format->read(context, path, bytes->data, bytes->size, &options, map);
    sl_map_list_destroy(context, &list);
    return status;
}

sl_status sl_map_read(sl_context *context, const char *path, const sl_import_options *options,
                      sl_map *map) {
    sl_bytes bytes;
    const sl_import_options usual = sl_import_options_default();
    if (!options) options = &usual;
    SL_TRY(sl_file_read(context, path, &bytes));
    sl_map read = {0};
    char *source = sl_copy_text(context, path, strlen(path));
    sl_status status = source ? SL_OK : SL_NO_MEMORY;
    if (source)
        status = read_format(context, path, find_format(path, &bytes), &bytes, options, &read);
    sl_free(context, bytes.data);
    if (status != SL_OK) {
        sl_free(context, source);
        return status;
    }
    read.source = source;
    *map = read;
    sl_report(context, "read", "bytes", bytes.size, bytes.size);
    return SL_OK;
}

void sl_map_choice_destroy(sl_context *context, sl_map_choice *choice) {
    sl_map_list_destroy(context, &choice->maps);
    *choice = (sl_map_choice){0};
}

sl_status sl_map_choice_read(sl_context *context, const char *path, sl_map_choice *out) {
    sl_bytes bytes;
    SL_TRY(sl_file_read(context, path, &bytes));
    sl_map_choice read = {.format = find_format(path, &bytes)};
    const sl_map_format *format = read.format;
    sl_status status = SL_OK;
    if (format->list) status = format->list(context, path, bytes.data, bytes.size, &read.maps);
    if (status == SL_OK && format->heights)
        status =
            format->heights(context, path, bytes.data, bytes.size, &read.lowest, &read.highest);
    sl_free(context, bytes.data);
    if (status == SL_OK)
        *out = read;
    else
        sl_map_choice_destroy(context, &read);
    return status;
}

sl_status sl_map_list_read(sl_context *context, const char *path, sl_map_list *list) {
    sl_map_choice choice;
    SL_TRY(sl_map_choice_read(context, path, &choice));
    *list = choice.maps;
    return SL_OK;
}

/// Which reader a map file needs: by the ending of its name, else by its first bytes. Which writer
/// it needs: by the ending, or by name; and what the format leaves out.
#include "sightline/import.h"

#include "base/base.h"
#include "base/file_system.h"
#include "base/size.h"
#include "map/plans.h"
#include "map/scan.h"
#include "map/unit.h"

#include <string.h>
#include <strings.h>

sl_import_options sl_import_options_default(void) {
    return (sl_import_options){.has_slice = false};
}

static sl_status read_text(sl_context *context, const char *name, const char *text, size_t size,
                           const sl_import_options *options, sl_map *map) {
    (void)options;
    return sli_map_read_text(context, name, text, size, map);
}

static sl_status read_plan(sl_context *context, const char *name, const char *text, size_t size,
                           const sl_import_options *options, sl_map *map) {
    (void)options;
    return sli_map_read_plan(context, name, text, size, map);
}

// What only reads maps is smaller without the writers.
#ifdef SLI_WITHOUT_WRITERS
#define WRITER(function) NULL
#else
#define WRITER(function) function
#endif

// So is what reads no drawings without their sheets of several plans.
#ifdef SLI_WITHOUT_DRAWINGS
enum { SHEETS = 0 };
#else
enum { SHEETS = SL_TAKES_PLANS };
#endif

static const sl_map_format formats[] = {
    {.name = "text",
     .endings = ".map",
     .what = "the map text",
     .read = read_text,
     .takes = SL_TAKES_CELLS,
     .write = WRITER(sli_map_print_text),
     .keeps = SL_KEEPS_ALL},
    // The writer of plans refuses by itself what a plan cannot hold.
    {.name = "plan",
     .endings = ".txt",
     .what = "an ASCII plan",
     .read = read_plan,
     .write = WRITER(sli_map_print_plan),
     .keeps = SL_KEEPS_ALL & ~SL_KEEPS_COMMENTS & ~SL_KEEPS_NOTES & ~SL_KEEPS_UNIT &
              ~SL_KEEPS_ENTRANCE & ~SL_KEEPS_STOPS & ~SL_KEEPS_LIMITED & ~SL_KEEPS_EARTH},
};
enum { FORMAT_COUNT = sizeof formats / sizeof *formats };

const sl_map_format *sl_map_formats(const sl_context *context, size_t *count) {
    return sli_table_items(&context->map_formats, formats, FORMAT_COUNT, count);
}

sl_status sl_map_formats_add(sl_context *context, const sl_map_format *more, size_t count) {
    return sli_table_add(context, &context->map_formats, sizeof *formats, formats, FORMAT_COUNT,
                         more, count);
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
static const sl_map_format *find_format(const sl_context *context, const char *path,
                                        const char *text, size_t size) {
    const sl_map_format *by_ending = NULL, *by_bytes = NULL;
    size_t fitting = 0, count;
    const sl_map_format *known = sl_map_formats(context, &count);
    for (size_t i = count; i-- > 0;) {
        if (!has_ending(&known[i], path)) continue;
        by_ending = &known[i];
        fitting++;
    }
    if (fitting == 1) return by_ending;
    for (size_t i = count; i-- > 0;) {
        if (fitting && !has_ending(&known[i], path)) continue;
        if (known[i].knows && known[i].knows(text, size)) by_bytes = &known[i];
    }
    return by_bytes ? by_bytes : by_ending ? by_ending : &known[0];
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
    char next[480];
    snprintf(next, sizeof next,
             ": choose one by --map NAME, as in: sightline check '%.300s' --map '%.80s' -o map.png",
             path, list->count ? list->names[0] : "");
    if (!options->map && list->count > 1) return fail_choice(context, path, list, "", next);
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
        {"map", options->map, format->list || format->takes & SL_TAKES_PLANS},
        {"slice", options->has_slice, format->takes & SL_TAKES_SLICE},
        {"layers", options->layers, format->takes & SL_TAKES_LAYERS},
        {"start-names", options->start_names, format->takes & SL_TAKES_STARTS},
        {"tolerance", options->tolerance != 0, format->takes & SL_TAKES_TOLERANCE},
        {"unit", options->unit, format->takes & SL_TAKES_UNIT},
        {"threshold", options->threshold != 0, format->takes & SL_TAKES_THRESHOLD},
        {"doors", options->doors, format->takes & SL_TAKES_DOORS},
        {"sectors", options->sectors, format->takes & SL_TAKES_SECTORS},
        {"planar", options->planar, format->takes & SL_TAKES_DEGREES},
        {"degrees", options->degrees, format->takes & SL_TAKES_DEGREES},
        {"subdivide given", options->cells, format->takes & SL_TAKES_CELLS},
    };
    if (options->planar && options->degrees)
        return sl_fail(context, SL_BAD_ARGUMENT, "--planar and --degrees: give one of them");
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        if (!all[i].given || all[i].taken) continue;
        if (strcmp(all[i].name, "unit") == 0)
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "--unit: %s is read as %s, which takes only the length of its units, "
                           "as --unit 0.0254=m for inches",
                           path, format->what);
        return sl_fail(context, SL_BAD_ARGUMENT, "--%s: %s is read as %s, which has no use for it",
                       all[i].name, path, format->what);
    }
    return SL_OK;
}

/// "plan 1: 0,0 to 10,8; plan 2: ..."
static void say_plans(const sli_sheet *sheet, int digits, char *text, size_t size) {
    *text = '\0';
    for (size_t i = 0; i < sheet->count; i++) {
        const size_t used = strlen(text);
        const sl_box b = sheet->plans[i].bounds;
        snprintf(text + used, size - used, "%splan %zu: %.*g,%.*g to %.*g,%.*g", i ? "; " : "",
                 i + 1, digits, b.min.x, digits, b.min.y, digits, b.max.x, digits, b.max.y);
    }
}

/// Where a file is a sheet of several plans: takes the one that is asked for, or tells of them.
static sl_status take_plan(sl_context *context, const char *path, const char *wanted, bool cropped,
                           sl_map *map) {
    sli_sheet sheet;
    char list[SLI_PLANS_MOST * 128], name[32];
    SL_TRY(sli_sheet_find(context, map, &sheet));
    say_plans(&sheet, sl_map_digits(map), list, sizeof list);
    if (!sheet.count && wanted)
        return sl_fail(
            context, SL_BAD_ARGUMENT,
            "%s: there is no map '%.64s': the file holds one map, so --map is not needed", path,
            wanted);
    if (!sheet.count || ((cropped || map->source.joined) && !wanted)) return SL_OK;
    if (!wanted) {
        map->source.plans = (uint32_t)sheet.count;
        sl_note(context,
                "%s holds %zu plans apart from each other (%s): --map 'plan 1' reads one, --crop "
                "X0,Y0,X1,Y1 a part",
                path, sheet.count, list);
        return SL_OK;
    }
    for (size_t i = 0; i < sheet.count; i++) {
        snprintf(name, sizeof name, "plan %zu", i + 1);
        if (strcasecmp(name, wanted) != 0) continue;
        const size_t left = sli_sheet_take(context, &sheet, i, map);
        sl_note(context, "%s: plan %zu of %zu has %zu walls; %zu beside it are left out", path,
                i + 1, sheet.count, sheet.plans[i].walls, left);
        return SL_OK;
    }
    return sl_fail(context, SL_BAD_ARGUMENT, "%s: there is no map '%.64s': it holds %zu plans, %s",
                   path, wanted, sheet.count, list);
}

/// A file of another program that shows nothing to hide behind. Pictures say it themselves.
static void note_no_walls(sl_context *context, const char *path, const sl_map_format *format,
                          const sl_map *map) {
    const bool picture =
        (format->takes & SL_TAKES_THRESHOLD) && !(format->takes & SL_TAKES_TOLERANCE);
    if (map->wall_count || map->door_count || map->mirror_count || map->oneway_count ||
        sl_map_partial_walls(map) || picture || strcmp(format->name, "text") == 0)
        return;
    sl_note(context,
            "%s: it has no walls, so nothing is hidden in it: %sdraw them in the program "
            "that wrote it, and export it again",
            path, format->takes & SL_TAKES_LAYERS ? "take other layers with --layers, or " : "");
}

static sl_status read_format(sl_context *context, const char *path, const sl_map_format *format,
                             const char *text, size_t size, const sl_import_options *given,
                             sl_map *map) {
    SL_TRY(check_options(context, path, format, given));
    sl_import_options options = *given;
    sl_map_list list = {0};
    sl_status status = SL_OK;
    if (format->list) {
        status = format->list(context, path, text, size, &list);
        if (status == SL_OK && (list.count || !(format->takes & SL_TAKES_PLANS)))
            status = choose_map(context, path, &list, &options);
    }
    const bool sheets = format->takes & SHEETS && !list.count;
    if (sheets) options.map = NULL;
    if (status == SL_OK) status = format->read(context, path, text, size, &options, map);
    sl_map_list_destroy(context, &list);
    if (status == SL_OK && sheets) {
        status = take_plan(context, path, given->map, given->has_crop, map);
        if (status != SL_OK) sl_map_destroy(context, map);
    }
    sl_transform *transform = &map->source.transform;
    if (status == SL_OK && transform->scale == 0) transform->scale = 1; // the file's y is up
    if (status == SL_OK && !given->lines) note_no_walls(context, path, format, map);
    return status;
}

/// The part of the map that is asked for, and one line of what was left out.
static sl_status crop_map(sl_context *context, const char *path, const sl_import_options *options,
                          sl_map *map) {
    sl_crop_account a;
    const sl_box all = sl_map_bounds(map), box = options->crop;
    const int digits = sl_map_digits(map);
    if (!options->has_crop) return SL_OK;
    SL_TRY(sl_map_crop(context, map, box, &a));
    if (!a.inside && !a.cut)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "%s: nothing lies in the crop %.*g,%.*g,%.*g,%.*g; the map is %.*g,%.*g to "
                       "%.*g,%.*g",
                       path, digits, box.min.x, digits, box.min.y, digits, box.max.x, digits,
                       box.max.y, digits, all.min.x, digits, all.min.y, digits, all.max.x, digits,
                       all.max.y);
    const struct {
        size_t count;
        const char *one, *several;
    } things[] = {{a.doors, "door", "doors"},
                  {a.starts, "start", "starts"},
                  {a.paths, "path", "paths"},
                  {a.objects, "object", "objects"},
                  {a.cells, "cell", "cells"}};
    char left[160] = "";
    for (size_t i = 0; i < sizeof things / sizeof *things; i++) {
        const size_t used = strlen(left), count = things[i].count;
        if (count)
            snprintf(left + used, sizeof left - used, ", %zu %s", count,
                     count == 1 ? things[i].one : things[i].several);
    }
    sl_note(context,
            "%s: the crop keeps %zu of %zu walls, %zu of them cut at its border; left out: %zu%s",
            path, a.inside + a.cut, a.inside + a.cut + a.left_out, a.cut, a.left_out, left);
    return SL_OK;
}

/// A foreign file that was taken for map text: the message says how to read it.
static sl_status tell_of_formats(sl_context *context, const char *path, sl_status status) {
    size_t count;
    const sl_map_format *known = sl_map_formats(context, &count);
    const char *ending = strrchr(sl_path_name(path), '.');
    char message[sizeof context->message];
    if (status != SL_BAD_INPUT || context->map_formats.items || !ending) return status;
    for (size_t i = 0; i < count; i++)
        if (has_ending(&known[i], path)) return status;
    memcpy(message, context->message, sizeof message);
    return sl_fail(context, status, "%.900s (read as map text: sl_io_use() adds other formats)",
                   message);
}

/// Takes the coordinate system that the user names.
static sl_status name_crs(sl_context *context, const char *path, const sl_import_options *options,
                          sl_map *map) {
    uint32_t epsg;
    if (!options->crs) return SL_OK;
    if (!sl_earth_read_epsg(options->crs, strlen(options->crs), &epsg))
        return sl_fail(context, SL_BAD_ARGUMENT, "--crs %s: expected EPSG:NUMBER, as EPSG:2056",
                       options->crs);
    if (map->earth.known)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--crs: %s is in longitude and latitude; --planar takes them as plain units",
                       path);
    if (map->earth.epsg != epsg) map->earth_line = 0;
    map->earth.epsg = epsg;
    return SL_OK;
}

sl_status sl_map_parse(sl_context *context, const char *path, const char *text, size_t size,
                       const sl_import_options *options, sl_map *map) {
    const sl_import_options usual = sl_import_options_default();
    if (!options) options = &usual;
    if (options->entrance < 0 || !sl_coordinate_usable(options->entrance))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "the width of entrances must be a number from %g to %g", SL_COORDINATE_MIN,
                       SL_COORDINATE_MAX);
    sl_map read = {0};
    sl_import_options own = *options;
    const char *sign = "";
    double factor;
    const bool measured = sli_unit_is_measured(options->unit, &factor, &sign);
    if (measured) {
        own.unit = NULL;
        own.sized = true;
    }
    char *source = sl_copy_text(context, path, strlen(path));
    sl_status status = source ? SL_OK : SL_NO_MEMORY;
    if (source)
        status = read_format(context, path, find_format(context, path, text, size), text, size,
                             &own, &read);
    if (status == SL_OK && measured) {
        status = sli_map_measure(context, &read, factor, sign, options->unit);
        if (status != SL_OK) sl_map_destroy(context, &read);
    }
    if (status == SL_OK) {
        status = crop_map(context, path, options, &read);
        if (status == SL_OK) status = name_crs(context, path, options, &read);
        if (status != SL_OK) sl_map_destroy(context, &read);
    }
    if (status != SL_OK) {
        sl_free(context, source);
        return tell_of_formats(context, path, status);
    }
    read.source.name = source;
    if (options->entrance > 0) {
        read.entrance = options->entrance;
        read.entrance_line = 0;
        read.entrance_by_doors = false;
    }
    *map = read;
    sl_report(context, "read", "bytes", size, size);
    return SL_OK;
}

sl_status sl_map_read(sl_context *context, const char *path, const sl_import_options *options,
                      sl_map *map) {
    sl_bytes bytes;
    SL_TRY(sl_file_read(context, path, &bytes));
    const sl_status status = sl_map_parse(context, path, bytes.data, bytes.size, options, map);
    sl_free(context, bytes.data);
    return status;
}

void sl_map_choice_destroy(sl_context *context, sl_map_choice *choice) {
    sl_map_list_destroy(context, &choice->maps);
    sl_map_list_destroy(context, &choice->layers);
    *choice = (sl_map_choice){0};
}

sl_status sl_map_choice_parse(sl_context *context, const char *path, const char *text, size_t size,
                              sl_map_choice *out) {
    sl_map_choice read = {.format = find_format(context, path, text, size)};
    const sl_map_format *format = read.format;
    sl_status status = SL_OK;
    if (format->list) status = format->list(context, path, text, size, &read.maps);
    if (status == SL_OK && format->heights)
        status = format->heights(context, path, text, size, &read.lowest, &read.highest);
    if (status == SL_OK && format->layers)
        status = format->layers(context, path, text, size, &read.layers, &read.layers_unsaid);
    if (status == SL_OK)
        *out = read;
    else
        sl_map_choice_destroy(context, &read);
    return status;
}

sl_status sl_map_choice_read(sl_context *context, const char *path, sl_map_choice *out) {
    sl_bytes bytes;
    SL_TRY(sl_file_read(context, path, &bytes));
    const sl_status status = sl_map_choice_parse(context, path, bytes.data, bytes.size, out);
    sl_free(context, bytes.data);
    return status;
}

// --- writing

/// Adds a word to a list: "a", "a, b", "a, b or c".
static void add_choice(char *list, size_t size, const char *word, size_t length, bool last) {
    const size_t used = strlen(list);
    snprintf(list + used, size - used, "%s%.*s",
             !used  ? ""
             : last ? " or "
                    : ", ",
             (int)length, word);
}

static sl_status fail_name(sl_context *context, const char *name) {
    char list[256] = "";
    size_t count, left = 0;
    const sl_map_format *known = sl_map_formats(context, &count);
    for (size_t i = 0; i < count; i++) left += known[i].write != NULL;
    for (size_t i = 0; i < count; i++)
        if (known[i].write)
            add_choice(list, sizeof list, known[i].name, strlen(known[i].name), --left == 0);
    return sl_fail(context, SL_BAD_ARGUMENT, "--format: no map is written as '%.64s': choose %s",
                   name, list);
}

/// Fails with the endings of all formats that are written, or of the one given.
static sl_status fail_ending(sl_context *context, const char *option, const char *path,
                             const sl_map_format *only) {
    enum { MOST = 64 };
    sli_word endings[MOST];
    char list[256] = "";
    size_t count, found = 0;
    const sl_map_format *known = sl_map_formats(context, &count);
    for (size_t i = 0; i < count; i++) {
        if (!known[i].write || (only && only != &known[i])) continue;
        for (const char *at = known[i].endings; *at && found < MOST;) {
            const size_t length = strcspn(at, " ");
            size_t same = 0; // one ending may belong to several formats
            while (same < found &&
                   (endings[same].length != length || memcmp(endings[same].at, at, length) != 0))
                same++;
            if (same == found) endings[found++] = (sli_word){at, length};
            at += length + strspn(at + length, " ");
        }
    }
    for (size_t i = 0; i < found; i++)
        add_choice(list, sizeof list, endings[i].at, endings[i].length, i + 1 == found);
    return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: end the name in %s", option, path, list);
}

static sl_status fail_several(sl_context *context, const char *option, const char *path) {
    char list[128] = "";
    size_t count, left = 0;
    const sl_map_format *known = sl_map_formats(context, &count);
    for (size_t i = 0; i < count; i++) left += known[i].write && has_ending(&known[i], path);
    for (size_t i = 0; i < count; i++)
        if (known[i].write && has_ending(&known[i], path))
            add_choice(list, sizeof list, known[i].name, strlen(known[i].name), --left == 0);
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "%s %s: several formats have this ending; choose one by --format: %s", option,
                   path, list);
}

sl_status sl_map_format_to_write(sl_context *context, const char *option, const char *path,
                                 const char *name, const sl_map_format **out) {
    size_t count, fitting = 0;
    const sl_map_format *known = sl_map_formats(context, &count), *found = NULL;
    // There is no ending for stdout, a pipe or a device.
    const bool stream = strcmp(path, "-") == 0 || sl_path_look(path) == SL_PATH_STREAM;
    for (size_t i = 0; i < count; i++) {
        if (!known[i].write) continue;
        if (name ? strcmp(known[i].name, name) != 0 : !stream && !has_ending(&known[i], path))
            continue;
        if (!fitting++) found = &known[i];
    }
    if (!found) return name ? fail_name(context, name) : fail_ending(context, option, path, NULL);
    if (name && !stream && !has_ending(found, path))
        return fail_ending(context, option, path, found);
    if (!name && !stream && fitting > 1) return fail_several(context, option, path);
    *out = found;
    return SL_OK;
}

/// Says of `count` things what becomes of them: "3 mirrors are written as walls".
static void note_left_out(sl_context *context, const char *path, const sl_map_format *format,
                          size_t count, const char *one, const char *many, const char *how) {
    if (count)
        sl_note(context, "%s: %s has no place for %s: %zu %s %s %s", path, format->what, many,
                count, count == 1 ? one : many, count == 1 ? "is" : "are", how);
}

static size_t count_solid(const sl_map *map) {
    size_t count = 0;
    for (size_t i = 0; i < map->wall_count; i++)
        count += (map->walls[i].ground & (SL_SOLID_LEFT | SL_SOLID_RIGHT)) != 0;
    for (size_t i = 0; i < map->seam_count; i++)
        count += (map->seams[i].ground & (SL_SOLID_LEFT | SL_SOLID_RIGHT)) != 0;
    return count;
}

/// Says what the format does not keep of this map.
static void tell_left_out(sl_context *context, const sl_map *map, const sl_map_format *format,
                          const char *path) {
    const struct {
        unsigned keeps;
        size_t count;
        const char *one, *many, *how;
    } things[] = {
        {SL_KEEPS_DOORS, map->door_count, "door", "doors", "left out"},
        {SL_KEEPS_MIRRORS, map->mirror_count, "mirror", "mirrors", "written as walls"},
        {SL_KEEPS_ONEWAYS, map->oneway_count, "pane of one-way glass", "panes of one-way glass",
         "left open"},
        {SL_KEEPS_SEAMS, map->seam_count - sl_map_partial_walls(map), "seam", "seams", "left out"},
        {SL_KEEPS_STARTS, map->start_count, "start", "starts", "left out"},
        {SL_KEEPS_PATHS, map->path_count, "path", "paths", "left out"},
        {SL_KEEPS_OBJECTS, map->object_count, "object", "objects", "left out"},
        {SL_KEEPS_CELLS, map->cell_count, "cell of its own", "cells of its own", "left out"},
    };
    for (size_t i = 0; i < sizeof things / sizeof *things; i++)
        if (!(format->keeps & things[i].keeps))
            note_left_out(context, path, format, things[i].count, things[i].one, things[i].many,
                          things[i].how);
    if (!(format->keeps & SL_KEEPS_SOLID) && count_solid(map))
        sl_note(context, "%s: %s has no place for solid ground: its outlines are written as walls",
                path, format->what);
    if (!(format->keeps & SL_KEEPS_RANGE) && map->range > 0)
        sl_note(context, "%s: %s has no place for the view range, which is left out", path,
                format->what);
    if (!(format->keeps & SL_KEEPS_UNIT) && sli_unit_metres(map->unit) > 0)
        sl_note(context, "%s: %s has no place for the unit, which is left out", path, format->what);
    if (!(format->keeps & SL_KEEPS_EARTH) && map->earth.epsg)
        sl_note(context, "%s: %s has no place for the coordinate system, which is left out", path,
                format->what);
    if (!(format->keeps & SL_KEEPS_EARTH) && map->earth.known)
        sl_note(context,
                "%s: %s has no place for where the map lies on the earth, which is left out", path,
                format->what);
    if (!(format->keeps & SL_KEEPS_ENTRANCE) && map->entrance > 0)
        sl_note(context, "%s: %s has no place for the width of entrances, which is left out", path,
                format->what);
    if (!(format->keeps & SL_KEEPS_CELLS) && map->snap > 0)
        sl_note(context, "%s: %s has no place for the snap of cells, which is left out", path,
                format->what);
    if (!(format->keeps & SL_KEEPS_NOTES) && map->source.notes)
        sl_note(context, "%s: %s has no place for notes, which are left out", path, format->what);
    if (!(format->keeps & SL_KEEPS_NOTES) && map->source.label_count)
        sl_note(
            context,
            "%s: %s has no place for the names that walls have in their file, which are left out",
            path, format->what);
    if (!(format->keeps & SL_KEEPS_COMMENTS) && map->source.comment_count)
        sl_note(context, "%s: %s has no place for comments, which are left out", path,
                format->what);
}

sl_status sli_map_check_again(sl_context *context, const char *name, const sl_map *written,
                              const sl_map *again) {
    const struct {
        const char *what;
        size_t written, again;
    } things[] = {
        {"doors", written->door_count, again->door_count},
        {"mirrors", written->mirror_count, again->mirror_count},
        {"panes of one-way glass", written->oneway_count, again->oneway_count},
        {"seams", written->seam_count - sl_map_partial_walls(written),
         again->seam_count - sl_map_partial_walls(again)},
        {"starts", written->start_count, again->start_count},
        {"paths", written->path_count, again->path_count},
        {"objects", written->object_count, again->object_count},
    };
    for (size_t i = 0; i < sizeof things / sizeof *things; i++)
        if (things[i].written != things[i].again)
            return sl_fail_at(context, name, 0, "%zu %s instead of %zu", things[i].again,
                              things[i].what, things[i].written);
    return SL_OK;
}

/// A map to write, and how.
typedef struct map_file {
    const sl_map *map;
    const sl_map_format *format;
} map_file;

static sl_status print_map(sl_context *context, const void *user, FILE *stream) {
    const map_file *file = user;
    return file->format->write(context, file->map, stream);
}

/// All of it, by the format's reader. The formats of other programs have no place for some things,
/// so that these are counted in the map text alone.
static sl_status read_map_back(sl_context *context, const void *user, const char *name,
                               sli_again *again) {
    const map_file *file = user;
    const size_t size = sli_size(again->left);
    char *text = sl_alloc_array(context, size == SIZE_MAX ? size : size + 1, 1);
    if (!text) return SL_NO_MEMORY;
    sl_import_options options = sl_import_options_default();
    options.doors = file->format->takes & SL_TAKES_DOORS;
    sl_map map = {0};
    sl_status status = SL_OK;
    if (!sli_again_take(again, text, size))
        status = sl_fail(context, SL_IO, "%s: cannot read back", name);
    if (status == SL_OK) status = file->format->read(context, name, text, size, &options, &map);
    if (status == SL_OK && file->format->write == sli_map_print_text)
        status = sli_map_check_again(context, name, file->map, &map);
    sl_map_destroy(context, &map);
    sl_free(context, text);
    return status;
}

/// Only map text has kinds of doors.
static void tell_kinds(sl_context *context, const sl_map *map, const sl_map_format *format,
                       const char *path) {
    size_t count = 0;
    for (size_t i = 0; i < map->door_count; i++) count += map->doors[i].kind != SL_DOOR_PLAIN;
    if (count && format->keeps & SL_KEEPS_DOORS && format->write != sli_map_print_text)
        sl_note(context, "%s: %s has no place for walls that break and sites: %zu become doors",
                path, format->what, count);
}

static sl_status write_map(sl_context *context, const sl_map *map, const sl_map_format *format,
                           const char *path) {
    tell_left_out(context, map, format, path);
    tell_kinds(context, map, format, path);
    const map_file file = {map, format};
    const sli_to_write written = {&file, print_map, read_map_back};
    return sli_file_write(context, path, &written);
}

/// Into a format that has no place for what walls stop.
static sl_status write_settled(sl_context *context, const sl_map *map, const sl_map_format *format,
                               const char *path) {
    sl_map settled = {0};
    size_t all = sl_map_partial_walls(map), left_out = 0;
    char channel[SL_STOPS_TEXT];
    sl_stops_write(sl_map_channel(map), channel);
    SL_TRY(sl_map_copy(context, map, &settled));
    sl_status status = sl_map_settle_stops(context, &settled, &left_out);
    if (status == SL_OK)
        sl_note(context,
                "%s: %s has no place for what walls stop: %zu of %zu that do not stop all stop %s "
                "and are written as walls, the others are left out",
                path, format->what, all - left_out, all, channel);
    if (status == SL_OK) status = write_map(context, &settled, format, path);
    sl_map_destroy(context, &settled);
    return status;
}

/// Into a format that has a place for what walls stop, but not for limited walls: these are open to
/// sight there.
static sl_status write_unlimited(sl_context *context, const sl_map *map,
                                 const sl_map_format *format, const char *path) {
    sl_map open = {0};
    size_t kept = 0, limited = 0;
    SL_TRY(sl_map_copy(context, map, &open));
    for (size_t i = 0; i < open.seam_count; i++) {
        sl_glass seam = open.seams[i];
        limited += (seam.stops & SL_STOPS_LIMITED) != 0;
        seam.stops &= SL_STOPS_ALL;
        if (seam.stops || !open.seams[i].stops) open.seams[kept++] = seam;
    }
    const size_t gone = open.seam_count - kept;
    open.seam_count = kept;
    sl_note(context,
            "%s: %s has no place for walls that limit sight: %zu written without that, %zu that do "
            "nothing else left out",
            path, format->what, limited - gone, gone);
    const sl_status status = write_map(context, &open, format, path);
    sl_map_destroy(context, &open);
    return status;
}

static bool has_limited(const sl_map *map) {
    for (size_t i = 0; i < map->seam_count; i++)
        if (map->seams[i].stops & SL_STOPS_LIMITED) return true;
    return false;
}

sl_status sl_map_write(sl_context *context, const sl_map *map, const sl_map_format *format,
                       const char *path) {
    if (!format) format = &formats[0];
    if (!format->write)
        return sl_fail(context, SL_UNSUPPORTED, "%s: %s is only read", path, format->what);
    if (format->keeps & SL_KEEPS_STOPS && !(format->keeps & SL_KEEPS_LIMITED) && has_limited(map))
        return write_unlimited(context, map, format, path);
    return format->keeps & SL_KEEPS_STOPS || !sl_map_partial_walls(map)
               ? write_map(context, map, format, path)
               : write_settled(context, map, format, path);
}

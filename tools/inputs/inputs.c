/// Options of how files are read, and files of maps and bakes; places to look from; doors by name.
#include "inputs/inputs.h"

#include "arguments/help.h"
#include "arguments/names.h"
#include "sightline/support.h"
#include "system/built.h"

#include <stdio.h>
#include <string.h>

const char *input_base_name(const char *path, size_t *length) {
    const char *base = sl_path_name(path);
    const char *dot = strrchr(base, '.');
    *length = dot && dot > base ? (size_t)(dot - base) : strlen(base);
    return base;
}

static bool is_baked_name(const char *path) {
    return name_ends_with(path, ".slv");
}

/// Whether the name has an ending of a format.
static bool has_ending(const sl_map_format *format, const char *path) {
    for (const char *word = format->endings; *word;) {
        const size_t length = strcspn(word, " ");
        char ending[32];
        snprintf(ending, sizeof ending, "%.*s", (int)length, word);
        if (name_ends_with(path, ending)) return true;
        word += length;
        word += strspn(word, " ");
    }
    return false;
}

/// Whether the name has the ending of a map format.
static bool is_map_name(const sl_context *context, const char *path) {
    size_t count;
    const sl_map_format *formats = sl_map_formats(context, &count);
    for (size_t i = 0; i < count; i++)
        if (has_ending(&formats[i], path)) return true;
    return false;
}

bool input_is_drawing(const sl_context *context, const char *path) {
    size_t count;
    bool drawing = false;
    const sl_map_format *formats = sl_map_formats(context, &count);
    for (size_t i = 0; i < count; i++) {
        if (!has_ending(&formats[i], path)) continue;
        if (!(formats[i].takes & SL_TAKES_PLANS)) return false;
        drawing = true;
    }
    return drawing;
}

bool input_is_game(const sl_context *context, const char *path) {
    const unsigned own = SL_TAKES_LAYERS | SL_TAKES_DOORS;
    size_t count;
    const sl_map_format *formats = sl_map_formats(context, &count);
    for (size_t i = 0; i < count; i++)
        if (has_ending(&formats[i], path) && (formats[i].takes & (own | SL_TAKES_PLANS)) == own)
            return true;
    return false;
}

// --- options

input_options input_options_default(void) {
    return (input_options){.import = sl_import_options_default(),
                           .clean = sl_clean_options_default()};
}

option_table input_option_table(input_options *input) {
    sl_import_options *to = &input->import;
    const char **given = &input->given;
    const option_spec options[] = {
        {"map", 0, "NAME", "which map of a file that holds several", .text = &to->map,
         .given = given},
        {"crop", 0, "X0,Y0,X1,Y1", "keep only what lies in this box, in the map's places",
         .box = &to->crop, .flag = &to->has_crop, .given = given, .rare = true},
        {"slice", 0, "Z", "cut a 3D model at this height", .number = &to->slice,
         .flag = &to->has_slice, .given = given, .rare = true},
        {"layers", 0, "LAYER,...",
         "which layers of a drawing or a tile map to read; A=wall, =door, =window, =furniture, "
         "=ignore: "
         "what a layer of a drawing is taken for",
         .text = &to->layers, .given = given},
        {"start-names", 0, "NAME,...",
         "which objects of a game map are starts (default: Player, Spawn, Start ...; 'none': no "
         "starts)",
         .text = &to->start_names, .given = given, .rare = true},
        {"tolerance", 0, "T", "largest distance of a curve from its walls",
         .number = &to->tolerance, .over_0 = true, .given = given, .rare = true},
        {"unit", 0, "UNIT",
         "convert a drawing to this unit: mm cm m km in ft yd; mm=m: it is in mm, whatever it "
         "says; "
         "0.0254=m: a unit of the file, of any format, is 0.0254 m",
         .text = &to->unit, .given = given, .rare = true},
        {"entrance", 0, "W",
         "how wide openings to the outside are at most: inside is what a disc of that width cannot "
         "enter (default: 1.2 m if the unit is known, else found from the plan)",
         .number = &to->entrance, .over_0 = true, .given = given, .rare = true},
        {"weld", 0, "T",
         "join wall ends up to T apart, in map units; 0 joins none (default: 2^-46 of the largest "
         "coordinate on oblique maps, or 5 units of the last digit of a drawing)",
         .number = &input->clean.weld, .needs = "0 or a number over 0 is needed", .given = given},
        {"threshold", 0, "T", "darkness from which a pixel is solid, up to 1",
         .number = &to->threshold, .over_0 = true, .most = 1,
         .needs = "a number over 0, at most 1, is needed", .given = given, .rare = true},
        {"planar", 0, NULL, "GeoJSON: coordinates are plain units, not longitude and latitude",
         .flag = &to->planar, .given = given, .rare = true},
        {"degrees", 0, NULL,
         "GeoJSON: coordinates are longitude and latitude, however few their decimals are",
         .flag = &to->degrees, .given = given, .rare = true},
        {"crs", 0, "EPSG:N",
         "the coordinate system that x and y are in, as EPSG:2056: it is written into GeoJSON",
         .text = &to->crs, .given = given, .rare = true},
        {"sectors", 0, NULL, "end cells at the sectors of a Doom map: its REJECT hides more then",
         .flag = &to->sectors, .given = given, .rare = true},
        {"doors", 0, NULL, "Doom: keep doors as doors (default: they are seen through)",
         .flag = &to->doors, .given = given},
        {"max-squares", 0, "N", "refuse a map of more tiles or cells than this (default 2^27)",
         .count = &input->limits.squares, .least = 1, .given = given, .rare = true},
        {"max-pixels", 0, "N", "refuse a picture of more pixels (default 2^28)",
         .count = &input->limits.pixels, .least = 1, .given = given, .rare = true},
        {"max-walls", 0, "N", "refuse a drawing that gives more walls (default 2^24)",
         .count = &input->limits.walls, .least = 1, .given = given, .rare = true},
        {"max-entities", 0, "N",
         "refuse a drawing whose blocks and uses give more entities (default 2^24)",
         .count = &input->limits.entities, .least = 1, .given = given, .rare = true},
        {"max-depth", 0, "N",
         "refuse blocks or groups within others deeper than this (default 128)",
         .count = &input->limits.depth, .least = 1, .most = 1000, .given = given, .rare = true},
    };
    option_table table = {0};
    option_table_add(&table, options, sizeof options / sizeof *options);
    option_table_topic(&table, "reading a map");
    return table;
}

// --- maps

bool input_is_baked(const char *path, const sl_bytes *bytes) {
    static const char start[] = "\x89SLV";
    return is_baked_name(path) ||
           (bytes->size > sizeof start - 1 && memcmp(bytes->data, start, sizeof start - 1) == 0);
}

static sl_status fail_baked(sl_context *context, const char *path) {
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "%s: is baked already; name the map that it was made from", path);
}

sl_status input_read_map(sl_context *context, const char *path, const input_options *input,
                         sl_map *map) {
    if (is_baked_name(path)) return fail_baked(context, path);
    sl_bytes bytes;
    sl_context_set_limits(context, &input->limits);
    SL_TRY(sl_file_read(context, path, &bytes));
    const sl_status status =
        input_is_baked(path, &bytes)
            ? fail_baked(context, path)
            : sl_map_parse(context, path, bytes.data, bytes.size, &input->import, map);
    sl_free(context, bytes.data);
    return status;
}

sl_status input_clean(sl_context *context, const input_options *input, sl_map *map,
                      sl_clean_account *account) {
    return sl_map_clean(context, map, &input->clean, account);
}

sl_status input_refuse_options(sl_context *context, const char *path, const input_options *input) {
    if (!input->given) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT, "--%s: %s is baked; the option is for reading a map",
                   input->given, path);
}

sl_status input_read_baked(sl_context *context, const char *path, sl_baked *baked) {
    if (is_map_name(context, path))
        return sl_fail(
            context, SL_BAD_ARGUMENT,
            "%s: is a map, not a baked file; bake it first: sightline bake %s -o FILE.slv", path,
            path);
    sl_bytes bytes;
    SL_TRY(sl_file_read(context, path, &bytes));
    const sl_status status = input_parse_baked(context, path, &bytes, baked);
    sl_free(context, bytes.data);
    return status;
}

void input_note_limited(sl_context *context, const sl_map *map) {
    const size_t count = sl_map_limited_walls(map);
    if (count)
        sl_note(context,
                "%zu wall%s sight: it passes one of them, not two. What an eye sees counts them; "
                "between cells they are open",
                count, count == 1 ? " limits" : "s limit");
}

sl_status input_parse_baked(sl_context *context, const char *path, const sl_bytes *bytes,
                            sl_baked *baked) {
    SL_TRY(sl_baked_parse(context, path, bytes->data, bytes->size, baked));
    char partial[SL_PARTIAL_TEXT];
    sl_baked_say_partial(baked, partial);
    if (partial[0]) sl_note(context, "%s is %s", path, partial);
    input_note_limited(context, &baked->map);
    return SL_OK;
}

static sl_status parse_map_of_baked(sl_context *context, const char *path, const sl_bytes *bytes,
                                    sl_map *map) {
    sl_baked baked = {0};
    SL_TRY(sl_baked_parse(context, path, bytes->data, bytes->size, &baked));
    const sl_status status = sl_baked_copy_map(context, &baked, map);
    sl_baked_destroy(context, &baked);
    return status;
}

sl_status input_take_lines(sl_context *context, sl_map *map) {
    map->channel = SL_STOPS_ALL | SL_STOPS_LIMITED;
    return sl_map_settle_stops(context, map, NULL);
}

sl_status input_parse_either(sl_context *context, const char *path, const sl_bytes *bytes,
                             const input_options *input, sl_map *map) {
    sl_context_set_limits(context, &input->limits);
    if (!input_is_baked(path, bytes))
        return sl_map_parse(context, path, bytes->data, bytes->size, &input->import, map);
    SL_TRY(input_refuse_options(context, path, input));
    return parse_map_of_baked(context, path, bytes, map);
}

sl_status input_read_either(sl_context *context, const char *path, const input_options *input,
                            sl_map *map) {
    sl_bytes bytes;
    if (is_baked_name(path)) SL_TRY(input_refuse_options(context, path, input));
    SL_TRY(sl_file_read(context, path, &bytes));
    const sl_status status = input_parse_either(context, path, &bytes, input, map);
    sl_free(context, bytes.data);
    return status;
}

void input_print_formats(void) {
    sl_context *context = sl_context_create(NULL);
    if (!context) return;
    size_t count;
    (void)built_use_formats(context); // with no memory: the formats that are always there
    const sl_map_format *formats = sl_map_formats(context, &count);
    puts("\nmaps, by the ending of the file's name:");
    for (size_t i = 0; i < count; i++) help_name(formats[i].endings, 28, formats[i].what, NULL);
    help_name("-", 28, "standard input, by its first bytes, else as the map text", NULL);
    sl_context_destroy(context);
}

// --- places to look from

const char *input_say_nearest(const sl_space *space, sl_point at, char text[INPUT_NEAREST_TEXT]) {
    sl_point near, read = {0};
    *text = '\0';
    if (!sl_space_nearest_inside(space, at, &near)) return text;
    for (int digits = 6; digits <= 17; digits++) {
        char x[32], y[32];
        snprintf(x, sizeof x, "%.*g", digits, near.x);
        snprintf(y, sizeof y, "%.*g", digits, near.y);
        snprintf(text, INPUT_NEAREST_TEXT, "; the nearest place inside: %s,%s", x, y);
        (void)sl_number_read(x, strlen(x), &read.x);
        (void)sl_number_read(y, strlen(y), &read.y);
        if (sl_space_is_inside(space, read)) break;
    }
    return text;
}

/// SL_BAD_ARGUMENT: the point of an option or operand lies outside the map's bounds.
static sl_status fail_outside(sl_context *context, const char *name, const char *text,
                              const sl_space *space, sl_point at) {
    const sl_box bounds = space->bounds;
    const double values[4] = {bounds.min.x, bounds.min.y, bounds.max.x, bounds.max.y};
    char numbers[4][SL_NUMBER_TEXT], near[INPUT_NEAREST_TEXT];
    for (int i = 0; i < 4; i++) sl_number_write(values[i], numbers[i]);
    return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: outside the map, which is %s,%s to %s,%s%s",
                   name, text, numbers[0], numbers[1], numbers[2], numbers[3],
                   input_say_nearest(space, at, near));
}

sl_status input_locate(sl_context *context, const char *name, const char *text,
                       const sl_space *space, sl_point at, uint32_t *cell) {
    const uint32_t found = sl_space_locate(space, at);
    char near[INPUT_NEAREST_TEXT];
    if (cell) *cell = found;
    if (found == SL_NO_CELL) return fail_outside(context, name, text, space, at);
    if (space->cells[found].solid)
        return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: the point is in solid ground%s", name,
                       text, input_say_nearest(space, at, near));
    if (!cell && !space->cells[found].inside && *input_say_nearest(space, at, near))
        sl_note(context, "%s %s: the point is not inside%s", name, text, near);
    return SL_OK;
}

sl_status input_check_place(sl_context *context, const char *path, unsigned line,
                            const sl_space *space, sl_point at) {
    const uint32_t found = sl_space_locate(space, at);
    char near[INPUT_NEAREST_TEXT];
    if (found == SL_NO_CELL)
        return sl_fail_at(context, path, line, "the point lies outside the map%s",
                          input_say_nearest(space, at, near));
    if (space->cells[found].solid)
        return sl_fail_at(context, path, line, "the point is in solid ground%s",
                          input_say_nearest(space, at, near));
    return SL_OK;
}

size_t input_next_start(const sl_map *map, const sl_space *space, size_t from) {
    for (; from < map->start_count; from++) {
        const uint32_t cell = sl_space_locate(space, map->starts[from].at);
        if (cell == SL_NO_CELL || !space->cells[cell].solid) break;
    }
    return from;
}

// --- doors

option_table door_option_table(door_choice *doors) {
    const option_spec options[] = {
        {"shut", 0, "NAME,...",
         "shut these doors, open all others; 'none' opens all (default: as the map says)",
         .text = &doors->shut},
        {"open", 0, "NAME,...", "open these doors, the others as the map says; 'all' opens all",
         .text = &doors->open},
    };
    option_table table = {0};
    option_table_add(&table, options, sizeof options / sizeof *options);
    return table;
}

/// Sets the doors of one name.
static bool set_named(const sl_map *map, const char *name, size_t length, bool to, bool *shut) {
    bool found = false;
    for (size_t i = 0; i < map->door_count; i++) {
        if (strlen(map->doors[i].name) != length || memcmp(map->doors[i].name, name, length) != 0)
            continue;
        shut[i] = to;
        found = true;
    }
    return found;
}

static sl_status fail_door(sl_context *context, const door_choice *by, const sl_map *map,
                           const char *name, size_t length) {
    const name_table doors = {"door", map->doors, sizeof *map->doors, map->door_count, NULL};
    const char *all = by->open ? "; 'all' opens all" : "; 'none' leaves all open";
    const char *option = by->open ? "--open" : by->shut_option ? by->shut_option : "--shut";
    char names[NAME_LIST];
    name_list(&doors, names);
    return sl_fail(context, SL_BAD_ARGUMENT, "%s: there is no door '%.*s'; the map's doors: %s%s",
                   option, (int)(length < 64 ? length : 64), name, names,
                   map->door_count ? all : "");
}

static sl_status read_names(sl_context *context, const door_choice *doors, const sl_map *map,
                            bool *shut) {
    const char *text = doors->open ? doors->open : doors->shut;
    while (*text) {
        const size_t length = strcspn(text, ",");
        if (!set_named(map, text, length, !doors->open, shut))
            return fail_door(context, doors, map, text, length);
        text += length;
        if (*text) text++;
    }
    return SL_OK;
}

sl_status doors_read(sl_context *context, const door_choice *doors, const sl_map *map, bool *shut) {
    const char *text = doors->shut ? doors->shut : doors->open;
    if (doors->shut && doors->open)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--shut says it of all doors: give either --shut or --open");
    const bool all_open = text && strcmp(text, doors->open ? "all" : "none") == 0;
    for (size_t i = 0; i < map->door_count; i++)
        shut[i] = !all_open && !doors->shut && !map->doors[i].open;
    return text && !all_open ? read_names(context, doors, map, shut) : SL_OK;
}

/// Replaces the space and the visible sets by those with the doors shut.
static sl_status shut_doors(sl_context *context, sl_baked *baked, const bool *shut) {
    sl_space space;
    sl_visibility visibility;
    SL_TRY(sl_baked_shut(context, baked, shut, &space, &visibility));
    sl_space_destroy(context, &baked->space);
    sl_visibility_destroy(context, &baked->visibility);
    baked->space = space;
    baked->visibility = visibility;
    return SL_OK;
}

sl_status doors_shut(sl_context *context, const door_choice *doors, sl_baked *baked) {
    const sl_map *map = &baked->map;
    if (!map->door_count) return doors_read(context, doors, map, NULL);
    bool *shut = sl_alloc_array(context, map->door_count, sizeof *shut);
    if (!shut) return SL_NO_MEMORY;
    sl_status status = doors_read(context, doors, map, shut);
    if (status == SL_OK) status = shut_doors(context, baked, shut);
    for (size_t i = 0; i < map->door_count && status == SL_OK; i++)
        baked->map.doors[i].open = !shut[i];
    sl_free(context, shut);
    return status;
}

/// `sightline info`: the contents of a map or of a baked file.
#include "arguments/names.h"
#include "arguments/options.h"
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "inputs/inputs.h"
#include "reports/json_print.h"
#include "reports/report.h"
#include "sightline/support.h"
#include "system/built.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

typedef struct info_request {
    const char *path;
    input_options input;
    const char *shut;
    bool json;
    sl_bytes bytes; ///< the file
    bool is_dxf, is_svg;
    const built_io *io; ///< of a drawing, as the next
    sl_drawing_layers layers;
} info_request;

/// For people: without the rounding noise of the last two digits.
static void print_bounds(sl_box box) {
    printf("  bounds    %.15g %.15g to %.15g %.15g\n", box.min.x, box.min.y, box.max.x, box.max.y);
}

// --- doors

/// A door as its users know it: all doors of one name, which open and shut together.
typedef struct named_door {
    const char *name;
    size_t first, parts, open; ///< `first`: the number of its first part in the map
} named_door;

static int compare_names(const void *a, const void *b) {
    const named_door *p = a, *q = b;
    const int order = strcmp(p->name, q->name);
    return order ? order : (p->first > q->first) - (p->first < q->first);
}

static int compare_places(const void *a, const void *b) {
    const named_door *p = a, *q = b;
    return (p->first > q->first) - (p->first < q->first);
}

/// The doors by name, in the order of their first parts; the caller frees them.
static named_door *name_doors(sl_context *context, const sl_map *map, size_t *count) {
    named_door *doors = sl_alloc_array(context, map->door_count, sizeof *doors);
    *count = 0;
    if (!doors || !map->door_count) return doors;
    for (size_t i = 0; i < map->door_count; i++)
        doors[i] = (named_door){map->doors[i].name, i, 1, map->doors[i].open};
    qsort(doors, map->door_count, sizeof *doors, compare_names);
    for (size_t i = 0; i < map->door_count; i++) {
        named_door *last = *count ? &doors[*count - 1] : NULL;
        if (!last || strcmp(last->name, doors[i].name) != 0) {
            doors[(*count)++] = doors[i];
            continue;
        }
        last->parts++;
        last->open += doors[i].open;
    }
    qsort(doors, *count, sizeof *doors, compare_places);
    return doors;
}

static const char *state_of(const named_door *door) {
    return door->open == 0 ? "shut" : door->open == door->parts ? "open" : "some open";
}

static sl_status print_doors(sl_context *context, const sl_map *map) {
    if (!map->door_count) return SL_OK;
    size_t count;
    named_door *doors = name_doors(context, map, &count);
    if (!doors) return SL_NO_MEMORY;
    puts("  doors by name");
    for (size_t i = 0; i < count; i++) {
        printf("    %s  ", state_of(&doors[i]));
        console_print_text(stdout, doors[i].name, strlen(doors[i].name));
        if (doors[i].parts > 1) printf(" (%zu parts)", doors[i].parts);
        putchar('\n');
    }
    sl_free(context, doors);
    return SL_OK;
}

/// "named_doors": [{"name": "front", "state": "open", "parts": 1}, ...]
static sl_status add_doors_json(sl_context *context, json_fields *fields, const sl_map *map) {
    size_t count;
    named_door *doors = name_doors(context, map, &count);
    if (!doors) return SL_NO_MEMORY;
    json_open_list(fields, "named_doors");
    for (size_t i = 0; i < count; i++) {
        json_open_item(fields);
        json_add_text(fields, "name", doors[i].name);
        json_add_text(fields, "state", state_of(&doors[i]));
        json_add_count(fields, "parts", doors[i].parts);
        json_close(fields);
    }
    json_close_list(fields);
    sl_free(context, doors);
    return SL_OK;
}

// --- maps

/// A number of things in a map.
typedef struct map_count {
    const char *key;
    size_t count;
} map_count;

enum { MAP_COUNTS = 9 };

static size_t count_lines(const char *text) {
    size_t lines = 0;
    for (; text && *text; lines++) {
        text += strcspn(text, "\n");
        text += *text == '\n';
    }
    return lines;
}

static void count_map(const sl_map *map, map_count counts[MAP_COUNTS]) {
    size_t open = 0;
    for (size_t i = 0; i < map->door_count; i++) open += map->doors[i].open;
    const map_count all[MAP_COUNTS] = {
        {"doors", map->door_count},
        {"open_doors", open},
        {"mirrors", map->mirror_count},
        {"oneways", map->oneway_count},
        {"seams", map->seam_count - sl_map_partial_walls(map)},
        {"starts", map->start_count},
        {"paths", map->path_count},
        {"objects", map->object_count},
        {"notices", count_lines(map->source.notes)},
    };
    memcpy(counts, all, sizeof all);
}

/// Walls as they are read; cleaning cuts them.
typedef struct walls_read {
    size_t count, oblique;
    size_t partial;                     ///< that do not stop all
    size_t stops[2 * SL_STOPS_LIMITED]; ///< of these: by what they stop
} walls_read;

static bool is_oblique(sl_point a, sl_point b) {
    return a.x != b.x && a.y != b.y;
}

static walls_read count_walls(const sl_map *map) {
    walls_read walls = {.partial = sl_map_partial_walls(map)};
    walls.count = map->wall_count + walls.partial;
    for (size_t i = 0; i < map->wall_count; i++)
        walls.oblique += is_oblique(map->walls[i].a, map->walls[i].b);
    for (size_t i = 0; i < map->seam_count; i++) {
        const sl_glass *seam = &map->seams[i];
        if (!seam->stops) continue;
        walls.oblique += is_oblique(seam->segment.a, seam->segment.b);
        walls.stops[seam->stops]++;
    }
    return walls;
}

/// Walls that do not stop all: "stops     sight,sound: 3 walls".
static void print_stops(const walls_read *walls) {
    char what[SL_STOPS_TEXT];
    for (uint32_t stops = 1; stops < 2 * SL_STOPS_LIMITED; stops++) {
        const size_t count = walls->stops[stops];
        sl_stops_write(stops, what);
        if (count) printf("  stops     %s: %zu wall%s\n", what, count, count == 1 ? "" : "s");
    }
}

/// "stops": {"sight,sound": 3}
static void add_stops_json(json_fields *fields, const walls_read *walls) {
    char what[SL_STOPS_TEXT];
    if (!walls->partial) return;
    json_open(fields, "stops");
    for (uint32_t stops = 1; stops < 2 * SL_STOPS_LIMITED; stops++) {
        sl_stops_write(stops, what);
        if (walls->stops[stops]) json_add_count(fields, what, walls->stops[stops]);
    }
    json_close(fields);
}

/// The layers that hold something, up to a hundred, and how many there are besides.
static void print_layers(const sl_drawing_layers *layers) {
    enum { MOST = 100 };
    size_t empty = 0, shown = 0;
    if (layers->count) puts("  layers, with their entities");
    for (size_t i = 0; i < layers->count; i++) {
        const sl_drawing_layer *layer = &layers->items[i];
        if (!layer->entities) {
            empty++;
            continue;
        }
        if (++shown > MOST) continue;
        printf("    %6zu  ", layer->entities);
        console_print_text(stdout, layer->name, strlen(layer->name));
        puts(layer->on ? "" : " (off: read only by --layers)");
    }
    if (shown > MOST) printf("    and %zu more (--json lists all)\n", shown - MOST);
    if (empty) printf("    %6zu  empty layer%s (--json lists all)\n", empty, empty == 1 ? "" : "s");
}

/// "layers": [{"name": "WALLS", "entities": 12, "on": true, "taken": "wall"}, ...]
static void add_layers_json(json_fields *fields, const sl_drawing_layers *layers) {
    json_open_list(fields, "layers");
    for (size_t i = 0; i < layers->count; i++) {
        json_open_item(fields);
        json_add_text(fields, "name", layers->items[i].name);
        json_add_count(fields, "entities", layers->items[i].entities);
        json_add_flag(fields, "on", layers->items[i].on);
        json_add_text(fields, "taken", layers->items[i].taken_for);
        json_close(fields);
    }
    json_close_list(fields);
}

/// How places of the file that was read stand to those of the map, as sl_transform says it; nothing
/// where it is not known. "transform": {"x": 0, "y": 1200, "scale": 1, "y_down": true}
static void add_transform_json(json_fields *fields, const sl_transform *transform) {
    if (!(transform->scale > 0)) return;
    json_open(fields, "transform");
    json_add_real(fields, "x", transform->origin.x);
    json_add_real(fields, "y", transform->origin.y);
    json_add_real(fields, "scale", transform->scale);
    json_add_flag(fields, "y_down", transform->y_down);
    json_close(fields);
}

static sl_status print_map_json(sl_context *context, const info_request *request, const sl_map *map,
                                const walls_read *walls, const sl_clean_account *cleaning) {
    map_count counts[MAP_COUNTS];
    count_map(map, counts);
    json_fields fields = json_begin();
    json_add_text(&fields, "file", request->path);
    json_add_text(&fields, "kind", "map");
    json_add_box(&fields, "bounds", sl_map_bounds(map));
    add_transform_json(&fields, &map->source.transform);
    if (*map->unit) json_add_text(&fields, "unit", map->unit);
    json_add_count(&fields, "walls", walls->count);
    json_add_count(&fields, "oblique_walls", walls->oblique);
    add_stops_json(&fields, walls);
    for (int i = 0; i < MAP_COUNTS; i++) json_add_count(&fields, counts[i].key, counts[i].count);
    if (add_doors_json(context, &fields, map) != SL_OK) {
        json_drop(&fields);
        return SL_NO_MEMORY;
    }
    if (request->is_dxf || request->is_svg) add_layers_json(&fields, &request->layers);
    json_add_real(&fields, "range", map->range);
    json_add_cleaning(&fields, "cleaning", cleaning);
    plan_add_json(&fields, map);
    return json_print(context, &fields);
}

static void print_notices(const char *notes) {
    if (!notes) return;
    puts("  notices");
    while (*notes) {
        const size_t length = strcspn(notes, "\n");
        console_print_line(stdout, "    ", notes, length);
        notes += length + (notes[length] == '\n');
    }
}

static sl_status print_map(sl_context *context, const info_request *request, const sl_map *map,
                           const walls_read *walls, const sl_clean_account *cleaning) {
    map_count counts[MAP_COUNTS];
    count_map(map, counts);
    printf("%s: a map\n", request->path);
    print_bounds(sl_map_bounds(map));
    if (*map->unit) printf("  unit      %s\n", map->unit);
    if (request->is_dxf && !*map->unit)
        puts("  unit      unknown; if it is mm, --unit mm=m reads the drawing in metres");
    printf("  walls     %zu, ", walls->count);
    if (walls->oblique)
        printf("%zu of them oblique\n", walls->oblique);
    else
        puts("all axial");
    print_stops(walls);
    for (int i = 0; i < MAP_COUNTS; i++)
        if (counts[i].count) printf("  %-9s %zu\n", counts[i].key, counts[i].count);
    SL_TRY(print_doors(context, map));
    print_layers(&request->layers);
    if (map->range > 0) {
        char number[SL_NUMBER_TEXT];
        sl_number_write(map->range, number);
        printf("  range     %s\n", number);
    }
    printf("  cleaned   %zu walls%s", cleaning->after, walls->partial ? " that stop all" : "");
    cleaning_print(cleaning);
    if (!sl_plan_make(map).effects) puts("  effects   none");
    plan_print(map);
    print_notices(map->source.notes);
    return SL_OK;
}

// --- files of several maps

static sl_status print_list_json(sl_context *context, const char *path, const sl_map_list *list) {
    json_fields fields = json_begin();
    json_add_text(&fields, "file", path);
    json_add_text(&fields, "kind", "maps");
    json_open_list(&fields, "maps");
    for (size_t i = 0; i < list->count; i++) {
        json_open_item(&fields);
        json_add_text(&fields, "name", list->names[i]);
        json_close(&fields);
    }
    json_close_list(&fields);
    return json_print(context, &fields);
}

static void print_list(const char *path, const sl_map_list *list) {
    printf("%s: %zu maps (--map NAME chooses one)\n", path, list->count);
    for (size_t i = 0; i < list->count; i++)
        console_print_line(stdout, "  ", list->names[i], strlen(list->names[i]));
}

/// Lists the maps of a file that holds several; *done says whether it does. Not for standard input,
/// which can be read only once.
static sl_status inform_of_list(command_console *console, info_request *request, bool *done) {
    sl_map_choice choice;
    sl_context_set_limits(console->context, &request->input.limits);
    SL_TRY(sl_map_choice_parse(console->context, request->path, request->bytes.data,
                               request->bytes.size, &choice));
    progress_line_clear(&console->line);
    sl_status status = SL_OK;
    *done = choice.maps.count > 1;
    request->is_dxf = choice.format && strcmp(choice.format->name, "dxf") == 0;
    request->is_svg = choice.format && strcmp(choice.format->name, "svg") == 0;
    if (*done && request->json)
        status = print_list_json(console->context, request->path, &choice.maps);
    else if (*done)
        print_list(request->path, &choice.maps);
    sl_map_choice_destroy(console->context, &choice);
    return status;
}

static sl_status inform_of_map(command_console *console, info_request *request) {
    sl_map map = {0};
    sl_clean_account cleaning;
    sl_context_set_limits(console->context, &request->input.limits);
    if (request->is_dxf || request->is_svg) {
        SL_TRY(built_need_io(console->context, request->path, &request->io));
        SL_TRY((request->is_dxf ? request->io->layers_dxf : request->io->layers_svg)(
            console->context, request->path, request->bytes.data, request->bytes.size,
            &request->layers));
    }
    SL_TRY(sl_map_parse(console->context, request->path, request->bytes.data, request->bytes.size,
                        &request->input.import, &map));
    const walls_read walls = count_walls(&map);
    sl_status status = input_clean(console->context, &request->input, &map, &cleaning);
    progress_line_clear(&console->line);
    if (status == SL_OK && request->json)
        status = print_map_json(console->context, request, &map, &walls, &cleaning);
    else if (status == SL_OK)
        status = print_map(console->context, request, &map, &walls, &cleaning);
    sl_map_destroy(console->context, &map);
    return status;
}

// --- baked files

/// A part of a baked file, with its size in memory.
typedef struct baked_part {
    const char *name;
    uint64_t count, bytes;
} baked_part;

enum { BAKED_PARTS = 11 };

static uint64_t pvs_bytes(const sl_pvs *pvs) {
    if (!pvs->cell_count) return 0;
    return ((uint64_t)pvs->cell_count + 1) * sizeof *pvs->offsets + pvs->offsets[pvs->cell_count];
}

static uint64_t grid_bytes(const sl_cell_grid *grid) {
    const uint64_t buckets = (uint64_t)grid->columns * grid->rows;
    return buckets ? (buckets + 1 + grid->entry_count) * sizeof *grid->cells : 0;
}

static void list_parts(const sl_baked *baked, baked_part parts[BAKED_PARTS]) {
    const sl_space *space = &baked->space;
    const sl_visibility *visibility = &baked->visibility;
    const sl_stab_trees *trees = &visibility->trees;
    const uint64_t tree_nodes = trees->cell_count ? trees->offsets[trees->cell_count] : 0;
    const uint64_t tree_bytes = tree_nodes * sizeof *trees->nodes;
    const baked_part all[BAKED_PARTS] = {
        {"walls", space->wall_count, space->wall_count * sizeof *space->walls},
        {"cells", space->cell_count, space->cell_count * sizeof *space->cells},
        {"vertices", space->vertex_count, space->vertex_count * sizeof *space->vertices},
        {"portals", space->portal_count, space->portal_count * sizeof *space->portals},
        {"directed portals", space->directed_count,
         space->directed_count * sizeof *space->directed},
        {"nodes", space->node_count, space->node_count * sizeof *space->nodes},
        {"buckets", (uint64_t)space->grid.columns * space->grid.rows, grid_bytes(&space->grid)},
        {"pairs", visibility->account.pairs, baked->by_views ? 0 : pvs_bytes(&visibility->pvs)},
        {"doubtful_pairs", visibility->account.doubtful_pairs, pvs_bytes(&visibility->doubtful)},
        {"stab_tree_nodes", tree_nodes, tree_bytes},
        {"view_cells", baked->views.view_cell_count, pvs_bytes(&baked->views.rows)},
    };
    memcpy(parts, all, sizeof all);
}

static sl_status print_baked_json(sl_context *context, const info_request *request,
                                  const sl_baked *baked, const pvs_means *mean) {
    baked_part parts[BAKED_PARTS];
    list_parts(baked, parts);
    char channel[SL_STOPS_TEXT];
    json_fields fields = json_begin();
    json_add_text(&fields, "file", request->path);
    json_add_text(&fields, "kind", "baked");
    json_add_box(&fields, "bounds", baked->space.bounds);
    add_transform_json(&fields, &baked->map.source.transform);
    json_add_text(&fields, "sight", sight_name(baked->visibility.sight));
    json_add_text(&fields, "method", baked->method);
    json_add_text(&fields, "solver", baked->solver[0] ? baked->solver : NULL);
    json_add_text(&fields, "guarantee", sl_guarantee_name(baked->visibility.guarantee));
    sl_stops_write(sl_map_channel(&baked->map), channel);
    if (sl_map_channel(&baked->map) != SL_STOPS_SIGHT)
        json_add_text(&fields, "walls_stop", channel);
    const walls_read walls = count_walls(&baked->map);
    add_stops_json(&fields, &walls);
    json_add_flag(&fields, "finished", !sl_partial_begun(&baked->partial));
    json_add_count(&fields, "inside_cells", baked->space.inside_count);
    ground_add_json(&fields, &baked->space);
    json_add_count(&fields, "tree_depth", baked->space.tree_depth);
    json_add_count(&fields, "stab_trees_left_out", baked->visibility.trees.left_out);
    for (int i = 0; i < BAKED_PARTS; i++) json_add_count(&fields, parts[i].name, parts[i].count);
    if (add_doors_json(context, &fields, &baked->map) != SL_OK) {
        json_drop(&fields);
        return SL_NO_MEMORY;
    }
    mean_pvs_add_json(&fields, mean);
    json_open(&fields, "memory_bytes");
    for (int i = 0; i < BAKED_PARTS; i++) json_add_count(&fields, parts[i].name, parts[i].bytes);
    json_close(&fields);
    json_add_count(&fields, "file_bytes", request->bytes.size);
    return json_print(context, &fields);
}

static sl_status print_baked(sl_context *context, const info_request *request,
                             const sl_baked *baked, const pvs_means *mean) {
    baked_part parts[BAKED_PARTS];
    list_parts(baked, parts);
    const sl_space *space = &baked->space;
    const sl_stab_trees *trees = &baked->visibility.trees;
    char size[SIZE_TEXT];
    size_write(request->bytes.size, size);
    printf("%s: a baked file, %s\n", request->path, size);
    print_bounds(space->bounds);
    printf("  seen      %s sight, by %s%s%s (%s)\n", sight_name(baked->visibility.sight),
           baked->method, baked->solver[0] ? " with " : "", baked->solver,
           sl_guarantee_name(baked->visibility.guarantee));
    char partial[SL_PARTIAL_TEXT];
    sl_baked_say_partial(baked, partial);
    if (partial[0]) printf("  %s\n", partial);
    char channel[SL_STOPS_TEXT];
    sl_stops_write(sl_map_channel(&baked->map), channel);
    if (sl_map_channel(&baked->map) != SL_STOPS_SIGHT)
        printf("  walls     those that stop %s\n", channel);
    const walls_read walls = count_walls(&baked->map);
    print_stops(&walls);
    printf("  inside    %" PRIu32 " of %" PRIu32 " cells", space->inside_count, space->cell_count);
    if (space->node_count) printf("; tree depth %" PRIu32, space->tree_depth);
    putchar('\n');
    ground_print(space);
    mean_pvs_print(mean);
    if (trees->cell_count)
        printf("  trees     %" PRIu32 " of %" PRIu32 " stab trees left out\n", trees->left_out,
               trees->cell_count);
    printf("  %-16s %12s %12s\n", "part", "count", "in memory");
    for (int i = 0; i < BAKED_PARTS; i++) {
        if (!parts[i].count) continue;
        size_write(parts[i].bytes, size);
        printf("  %-16s %12" PRIu64 " %12s\n", parts[i].name, parts[i].count, size);
    }
    SL_TRY(print_doors(context, &baked->map));
    print_notices(baked->map.source.notes);
    return SL_OK;
}

static sl_status inform_of_baked(command_console *console, const info_request *request) {
    sl_baked baked = {0};
    pvs_means mean;
    SL_TRY(input_refuse_options(console->context, request->path, &request->input));
    SL_TRY(input_parse_baked(console->context, request->path, &request->bytes, &baked));
    sl_status status =
        request->shut ? doors_shut(console->context, &(door_choice){.shut = request->shut}, &baked)
                      : SL_OK;
    if (status == SL_OK) status = mean_pvs_of(console->context, &baked, &mean);
    progress_line_clear(&console->line);
    if (status == SL_OK && request->json)
        status = print_baked_json(console->context, request, &baked, &mean);
    else if (status == SL_OK)
        status = print_baked(console->context, request, &baked, &mean);
    sl_baked_destroy(console->context, &baked);
    return status;
}

/// The file is read once, as a pipe can be read once only.
static sl_status inform(command_console *console, info_request *request) {
    bool done = false;
    if (input_is_baked(request->path, &request->bytes)) return inform_of_baked(console, request);
    if (request->shut)
        return sl_fail(console->context, SL_BAD_ARGUMENT, "--shut is for baked files");
    if (!request->input.import.map) SL_TRY(inform_of_list(console, request, &done));
    return done ? SL_OK : inform_of_map(console, request);
}

sl_status cmd_info(command_console *console, int argc, char **argv) {
    info_request request = {.input = input_options_default()};
    const option_table input = input_option_table(&request.input);
    const option_spec options[] = {
        {"json", 0, NULL, "print one JSON object", .flag = &request.json},
        {"shut", 0, "NAME,...", "shut these doors of a baked file (it counts what is still seen)",
         .text = &request.shut},
        {.group = &input},
    };
    const command_usage usage = {
        .name = "info",
        .synopsis = "MAP|FILE.slv [options]",
        .operands = {"MAP|FILE.slv"},
        .what = "Shows what a map holds: walls, doors, starts, effects, and what cleaning would "
                "change. Of a baked file it shows the parts, how it was baked, and how much a cell "
                "sees.",
        .tables = input_print_formats,
        .examples = "  sightline info office.map\n"
                    "  sightline info office.slv --json",
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, &request.path, &helped));
    if (helped) return SL_OK;
    SL_TRY(sl_file_read(console->context, request.path, &request.bytes));
    const sl_status status = inform(console, &request);
    sl_free(console->context, request.bytes.data);
    if (request.io) request.io->layers_destroy(console->context, &request.layers);
    return status;
}

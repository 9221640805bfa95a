/// `sightline path`: shortest ways among walls, and how long they are.
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "inputs/number_table.h"
#include "inputs/pipeline.h"
#include "reports/json_print.h"
#include "sightline/draw.h"
#include "sightline/path.h"
#include "sightline/support.h"
#include "studies/building_path.h"
#include "studies/distance_map.h"
#include "studies/isovist.h"
#include "system/built.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct path_plan {
    const char *input, *from_text, *to_text, *pairs, *output, *picture;
    sl_point from, to;
    map_pipeline pipeline;
    door_choice doors;
    sl_draw_options drawing;
    double loss, audible; ///< NAN: not given
    double radius, grid;
    bool distances, json;
} path_plan;

typedef struct path_work {
    sl_baked baked;
    sl_query *query;
    sl_route_finder *finder;
    sl_route route;
    bool *shut;     ///< by door of the map
    bool all_open;  ///< shut doors are passed at a loss
    double *losses; ///< by door of the map
    sl_route_near *cells;
    sl_route_map *map;
    eye_places places; ///< of a grid
} path_work;

// --- why there is no way

/// Names the doors that are shut on the way that there is if all doors are open, each once.
static void name_doors(const path_work *w, const sl_route *way, char *text, size_t size) {
    const sl_map *map = &w->baked.map;
    size_t used = 0;
    text[0] = '\0';
    for (size_t i = 0; i < way->portal_count; i++) {
        size_t count;
        const sl_seam_portal *seams = sl_space_seams_of(&w->baked.space, way->portals[i], &count);
        for (size_t k = 0; k < count; k++) {
            const sl_seam *seam = &w->baked.space.seams[seams[k].seam];
            if (seam->kind != SL_SEAM_DOOR || !w->shut[seam->number]) continue;
            char name[160];
            snprintf(name, sizeof name, " \"%s\"", map->doors[seam->number].name);
            if (strstr(text, name) || used >= size) continue;
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? "," : "", name);
        }
    }
}

/// What keeps two points apart: doors that are shut, or walls ("").
static sl_status find_doors(sl_context *context, path_work *w, sl_point from, sl_point to,
                            char *text, size_t size) {
    sl_route way = {0};
    text[0] = '\0';
    if (!w->baked.map.door_count || w->all_open) return SL_OK;
    sl_query_set_doors(context, w->query, true);
    sl_status status = sl_route_finder_update(context, w->finder);
    if (status == SL_OK) status = sl_route_find(context, w->finder, from, to, &way);
    if (status == SL_OK && way.found) name_doors(w, &way, text, size);
    sl_route_destroy(context, &way);
    for (size_t i = 0; i < w->baked.map.door_count; i++)
        sl_query_set_door_at(context, w->query, i, !w->shut[i]);
    return status == SL_OK ? sl_route_finder_update(context, w->finder) : status;
}

// --- the report

static void print_way(const path_work *w) {
    const sl_route *route = &w->route;
    const char *unit = w->baked.map.unit;
    char length[SL_NUMBER_TEXT];
    sl_number_write(route->length, length);
    printf("length %s%s%s, %zu corner%s\n", length, *unit ? " " : "", unit, route->count - 2,
           route->count == 3 ? "" : "s");
    for (size_t i = 0; i < route->count; i++) {
        char x[SL_NUMBER_TEXT], y[SL_NUMBER_TEXT];
        sl_number_write(route->points[i].x, x);
        sl_number_write(route->points[i].y, y);
        printf("  %s,%s\n", x, y);
    }
}

static sl_status print_json(sl_context *context, const path_work *w) {
    const sl_route *route = &w->route;
    json_fields fields = json_begin();
    json_add_flag(&fields, "found", route->found);
    if (route->found) {
        json_add_real(&fields, "length", route->length);
        json_add_points(&fields, "points", route->points, route->count);
    } else {
        sl_json_writer *json = json_add(&fields, "nearest");
        sl_json_put_list(json);
        sl_json_put_real(json, route->nearest.x);
        sl_json_put_real(json, route->nearest.y);
        sl_json_put_end(json, ']');
    }
    return json_print(context, &fields);
}

/// The way over the plan: each piece in the colour of how far its end is.
static sl_status draw(sl_context *context, const path_plan *plan, const path_work *w) {
    const sl_route *route = &w->route;
    const size_t count = route->count ? route->count - 1 : 0;
    sl_segment *lines = sl_alloc_array(context, count, sizeof *lines);
    double *values = sl_alloc_array(context, count, sizeof *values);
    sl_status status = lines && values ? SL_OK : SL_NO_MEMORY;
    double far = 0;
    for (size_t i = 0; i < count && status == SL_OK; i++) {
        lines[i] = (sl_segment){route->points[i], route->points[i + 1]};
        far += hypot(lines[i].b.x - lines[i].a.x, lines[i].b.y - lines[i].a.y);
        values[i] = far;
    }
    const sl_drawn_lines drawn = {
        .name = "length", .lines = lines, .values = values, .count = (uint32_t)count};
    if (status == SL_OK)
        status = built_pictures()->lines(context, &w->baked, &drawn, &plan->drawing, plan->picture);
    sl_free(context, lines);
    sl_free(context, values);
    return status;
}

static void put(FILE *out, double value, const char *behind) {
    char text[SL_NUMBER_TEXT];
    sl_number_write(value, text);
    fprintf(out, "%s%s", text, behind);
}

static sl_status put_points(const sl_route *route, FILE *out) {
    fputs("x,y\n", out);
    for (size_t i = 0; i < route->count; i++) {
        put(out, route->points[i].x, ",");
        put(out, route->points[i].y, "\n");
    }
    return SL_OK;
}

/// Says why there is no way, and how far one comes.
static sl_status print_no_way(command_console *console, const path_plan *plan, path_work *w) {
    sl_context *context = console->context;
    const sl_point nearest = w->route.nearest;
    const int digits = sl_map_digits(&w->baked.map);
    char doors[512], why[640];
    if (plan->radius > 0) { // is it the width?
        SL_TRY(sl_route_finder_set_radius(context, w->finder, 0));
        SL_TRY(sl_route_find(context, w->finder, plan->from, plan->to, &w->route));
    }
    SL_TRY(find_doors(context, w, plan->from, plan->to, doors, sizeof doors));
    if (w->route.found)
        snprintf(why, sizeof why, "it is too narrow for radius %.9g", plan->radius);
    else if (*doors)
        snprintf(why, sizeof why, "shut doors on it:%s (--open opens them)", doors);
    else
        snprintf(why, sizeof why, "walls are between");
    printf("no way: %s; the nearest place that can be reached: %.*g,%.*g\n", why, digits, nearest.x,
           digits, nearest.y);
    return SL_OK;
}

/// One way. Without one, the exit status is 3.
static sl_status find_one(command_console *console, const path_plan *plan, path_work *w) {
    sl_context *context = console->context;
    SL_TRY(input_locate(context, "--from", plan->from_text, &w->baked.space, plan->from, NULL));
    SL_TRY(input_locate(context, "--to", plan->to_text, &w->baked.space, plan->to, NULL));
    SL_TRY(sl_route_find(context, w->finder, plan->from, plan->to, &w->route));
    if (plan->picture) SL_TRY(draw(context, plan, w));
    if (plan->output && w->route.found) {
        sl_output output;
        SL_TRY(sl_output_open(context, plan->output, &output));
        SL_TRY(sl_output_close(context, &output, put_points(&w->route, output.stream)));
    }
    progress_line_clear(&console->line);
    console->fault = !w->route.found;
    if (plan->json) return print_json(context, w);
    if (w->route.found) {
        const bool quiet = console->quiet && (plan->picture || plan->output);
        if (!quiet && (!plan->output || output_is_plain_file(plan->output))) print_way(w);
        return SL_OK;
    }
    return print_no_way(console, plan, w);
}

// --- how far all cells are

static sl_status put_cells(const path_work *w, uint32_t count, FILE *out) {
    fputs("cell,distance,x,y\n", out);
    for (uint32_t c = 0; c < count; c++) {
        if (isinf(w->cells[c].distance)) continue;
        fprintf(out, "%u,", c);
        put(out, w->cells[c].distance, ",");
        put(out, w->cells[c].at.x, ",");
        put(out, w->cells[c].at.y, "\n");
    }
    return SL_OK;
}

static sl_status print_cells_json(sl_context *context, const path_work *w, uint32_t count) {
    json_fields fields = json_begin();
    sl_json_writer *json = json_add(&fields, "cells");
    sl_json_put_list(json);
    for (uint32_t c = 0; c < count; c++) {
        if (isinf(w->cells[c].distance)) continue;
        sl_json_put_object(json);
        sl_json_put_key(json, "cell");
        sl_json_put_integer(json, c);
        sl_json_put_key(json, "distance");
        sl_json_put_real(json, w->cells[c].distance);
        sl_json_put_key(json, "nearest");
        sl_json_put_list(json);
        sl_json_put_real(json, w->cells[c].at.x);
        sl_json_put_real(json, w->cells[c].at.y);
        sl_json_put_end(json, ']');
        sl_json_put_end(json, '}');
    }
    sl_json_put_end(json, ']');
    return json_print(context, &fields);
}

static double limit_of(const path_plan *plan) {
    return isnan(plan->audible) ? (double)INFINITY : plan->audible;
}

/// How far the places of the plan are, drawn.
static sl_status draw_map(sl_context *context, const path_plan *plan, path_work *w) {
    const sl_space *space;
    SL_TRY(sl_query_space(context, w->query, &space, NULL));
    return distance_map_draw(context, &w->baked, space, w->finder, plan->from, limit_of(plan),
                             &plan->drawing, plan->picture);
}

static void put_places(path_work *w, FILE *out) {
    fputs("x,y,distance,root_x,root_y\n", out);
    for (size_t i = 0; i < w->places.list.count; i++) {
        const sl_point at = w->places.list.items[i].at;
        sl_route_place place;
        sl_route_map_at(w->map, at, &place);
        if (isinf(place.distance)) continue;
        put(out, at.x, ",");
        put(out, at.y, ",");
        put(out, place.distance, ",");
        put(out, place.root.x, ",");
        put(out, place.root.y, "\n");
    }
}

/// The points of a grid within the range, or all that a way leads to.
static sl_status find_places(command_console *console, const path_plan *plan, path_work *w) {
    sl_context *context = console->context;
    SL_TRY(input_locate(context, "--from", plan->from_text, &w->baked.space, plan->from, NULL));
    SL_TRY(eyes_add_grid(context, &w->baked.space, plan->grid, (eye_place){0}, &w->places));
    SL_TRY(sl_route_map_create(context, w->finder, plan->from, limit_of(plan), &w->map));
    if (plan->picture) SL_TRY(draw_map(context, plan, w));
    progress_line_clear(&console->line);
    if (plan->picture && !plan->output) return SL_OK; // a long table
    sl_output output;
    SL_TRY(sl_output_open(context, plan->output ? plan->output : "-", &output));
    put_places(w, output.stream);
    return sl_output_close(context, &output, SL_OK);
}

/// The cells within the range of hearing, or all that a way leads to.
static sl_status find_cells(command_console *console, const path_plan *plan, path_work *w) {
    sl_context *context = console->context;
    const uint32_t count = w->baked.space.cell_count;
    SL_TRY(input_locate(context, "--from", plan->from_text, &w->baked.space, plan->from, NULL));
    w->cells = sl_alloc_array(context, count, sizeof *w->cells);
    if (!w->cells) return SL_NO_MEMORY;
    SL_TRY(sl_route_distances(context, w->finder, plan->from, limit_of(plan), w->cells));
    if (plan->picture) SL_TRY(draw_map(context, plan, w));
    if (plan->output || !(plan->json || plan->picture)) {
        sl_output output;
        SL_TRY(sl_output_open(context, plan->output ? plan->output : "-", &output));
        SL_TRY(sl_output_close(context, &output, put_cells(w, count, output.stream)));
    }
    progress_line_clear(&console->line);
    return plan->json ? print_cells_json(context, w, count) : SL_OK;
}

// --- a table of questions

static sl_status put_rows(sl_context *context, const number_table *table, path_work *w, bool *all,
                          FILE *out) {
    fputs("from_x,from_y,to_x,to_y,length,corners\n", out);
    for (size_t i = 0; i < table->rows; i++) {
        const double *v = table->values + i * table->columns;
        const sl_point from = {v[0], v[1]}, to = {v[2], v[3]};
        SL_TRY(sl_check_cancelled(context));
        SL_TRY(input_check_place(context, table->path, table->lines[i], &w->baked.space, from));
        SL_TRY(input_check_place(context, table->path, table->lines[i], &w->baked.space, to));
        SL_TRY(sl_route_find(context, w->finder, from, to, &w->route));
        *all &= w->route.found;
        for (int k = 0; k < 4; k++) put(out, v[k], ",");
        if (w->route.found) put(out, w->route.length, "");
        if (w->route.found)
            fprintf(out, ",%zu\n", w->route.count - 2);
        else
            fputs(",\n", out);
    }
    return SL_OK;
}

static sl_status check_table(sl_context *context, const number_table *table) {
    if (table->columns != 4)
        return sl_fail_at(context, table->path, table->first_line,
                          "expected the columns from_x,from_y,to_x,to_y, found %zu column%s",
                          table->columns, table->columns == 1 ? "" : "s");
    for (size_t i = 0; i < table->rows; i++)
        for (size_t k = 0; k < 4; k++)
            if (isnan(table->values[4 * i + k]))
                return sl_fail_at(context, table->path, table->lines[i], "a field is empty");
    return SL_OK;
}

/// Many ways. A row without one has no length, and the exit status is 3.
static sl_status find_many(command_console *console, const path_plan *plan, path_work *w) {
    sl_context *context = console->context;
    number_table table = {0};
    sl_output output;
    bool all = true;
    SL_TRY(number_table_read(context, plan->pairs, &table));
    sl_status status = check_table(context, &table);
    if (status == SL_OK)
        status = sl_output_open(context, plan->output ? plan->output : "-", &output);
    if (status == SL_OK)
        status =
            sl_output_close(context, &output, put_rows(context, &table, w, &all, output.stream));
    number_table_destroy(context, &table);
    console->fault = !all;
    return status;
}

// --- the command

static sl_status check_plan(sl_context *context, path_plan *plan) {
    const bool grid = plan->grid > 0;
    plan->distances |= !isnan(plan->audible) && !grid;
    if (grid && (plan->distances || plan->pairs || plan->to_text || plan->json))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--grid makes a table of points: it goes without --to, --pairs, --distances "
                       "and --json");
    if (plan->pairs && (plan->from_text || plan->to_text || plan->picture || plan->json))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--pairs makes a table: it goes without --from, --to, --picture and --json");
    if (plan->distances && (plan->pairs || plan->to_text))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--distances makes a table of cells: it goes without --to and --pairs");
    if (plan->radius > 0 && (plan->distances || grid || !isnan(plan->loss)))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--radius goes without %s: cells and sounds have no width",
                       grid              ? "--grid"
                       : plan->distances ? "--distances and --audible"
                                         : "--loss");
    if (!plan->pairs && (!plan->from_text || !(plan->to_text || plan->distances || grid)))
        return sl_fail(context, SL_BAD_ARGUMENT, "--%s is missing: where the way %s",
                       plan->from_text ? "to" : "from", plan->from_text ? "ends" : "begins");
    return pipeline_plan(context, plan->input, &plan->pipeline);
}

/// A space of sight has other walls than steps need.
static sl_status check_channel(sl_context *context, const path_plan *plan, const path_work *w) {
    if (!sl_map_steps_differ(&w->baked.map) || plan->pipeline.stops_text) return SL_OK;
    return sl_fail(context, SL_UNSUPPORTED,
                   "%s: its cells are those of sight, and some of its walls stop sight or steps "
                   "alone; give the map, or bake it with --stops steps",
                   plan->input);
}

static sl_status work(command_console *console, path_plan *plan, path_work *w) {
    sl_context *context = console->context;
    SL_TRY(check_plan(context, plan));
    SL_TRY(pipeline_read_space(
        context, &plan->pipeline, "path",
        SL_EFFECT_DOOR | SL_EFFECT_ONEWAY | SL_EFFECT_MIRROR | SL_EFFECT_RANGE, NULL, &w->baked));
    SL_TRY(check_channel(context, plan, w));
    w->shut = sl_alloc_array(context, w->baked.map.door_count, sizeof *w->shut);
    w->losses = sl_alloc_array(context, w->baked.map.door_count, sizeof *w->losses);
    if (!w->shut || !w->losses) return SL_NO_MEMORY;
    w->all_open = !isnan(plan->loss);
    SL_TRY(doors_read(context, &plan->doors, &w->baked.map, w->shut));
    SL_TRY(sl_query_over(context, &w->baked.space, &w->baked.map, NULL, &w->query));
    for (size_t i = 0; i < w->baked.map.door_count; i++) {
        w->baked.map.doors[i].open = !w->shut[i];
        w->losses[i] = w->shut[i] ? plan->loss : 0;
        sl_query_set_door_at(context, w->query, i, w->all_open || !w->shut[i]);
    }
    SL_TRY(sl_route_finder_create(context, w->query, &w->finder));
    if (w->all_open)
        SL_TRY(sl_route_finder_set_losses(context, w->finder, w->losses, w->baked.map.door_count));
    if (plan->radius > 0) SL_TRY(sl_route_finder_set_radius(context, w->finder, plan->radius));
    if (plan->grid > 0) return find_places(console, plan, w);
    if (plan->distances) return find_cells(console, plan, w);
    return plan->pairs ? find_many(console, plan, w) : find_one(console, plan, w);
}

/// A way through a building. What is for one plan alone is refused.
static sl_status walk_building(command_console *console, path_plan *plan) {
    const char *alone = plan->pairs                                ? "pairs"
                        : plan->distances || !isnan(plan->audible) ? "distances and --audible"
                        : plan->grid > 0                           ? "grid"
                        : !isnan(plan->loss)                       ? "loss"
                        : plan->doors.shut                         ? "shut"
                        : plan->doors.open                         ? "open"
                        : plan->picture                            ? "picture"
                                                                   : NULL;
    if (alone)
        return sl_fail(console->context, SL_BAD_ARGUMENT,
                       "%s: a building goes without --%s, which is for one plan", plan->input,
                       alone);
    if (!plan->from_text || !plan->to_text)
        return sl_fail(console->context, SL_BAD_ARGUMENT, "--%s is missing: where the way %s",
                       plan->from_text ? "to" : "from", plan->from_text ? "ends" : "begins");
    return building_path(console, &(building_path_plan){.input = plan->input,
                                                        .from = plan->from_text,
                                                        .to = plan->to_text,
                                                        .output = plan->output,
                                                        .pipeline = &plan->pipeline,
                                                        .radius = plan->radius,
                                                        .json = plan->json});
}

sl_status cmd_path(command_console *console, int argc, char **argv) {
    path_plan plan = {.pipeline = pipeline_default(),
                      .drawing = built_draw_options(),
                      .loss = NAN,
                      .audible = NAN};
    plan.pipeline.channel = SL_STOPS_STEPS;
    const option_table pipeline = pipeline_option_table(&plan.pipeline),
                       picture = picture_option_table(&plan.drawing, "picture", true),
                       doors = door_option_table(&plan.doors);
    const option_spec options[] = {
        {"from", 0, "X,Y", "where the way begins; in a building STOREY:X,Y",
         .text = &plan.from_text},
        {"to", 0, "X,Y", "where it ends", .text = &plan.to_text},
        {"pairs", 0, "CSV",
         "a table of ways, from_x,from_y,to_x,to_y: its first line may name the columns",
         .text = &plan.pairs, .is_input = true},
        {"distances", 0, NULL,
         "instead of --to: how far each cell is, to its nearest point: cell,distance,x,y",
         .flag = &plan.distances},
        {"grid", 0, "STEP",
         "instead of --to: how far the points of a grid are that are inside, and where the way to "
         "each turns last: x,y,distance,root_x,root_y",
         .number = &plan.grid, .over_0 = true, .rare = true},
        {"audible", 0, "R",
         "as --distances, for the cells that a sound with range R reaches, in map units: those "
         "whose nearest point is within R; with --grid its points within R",
         .number = &plan.audible, .needs = "a range of 0 or more"},
        {"loss", 0, "L",
         "shut doors do not block: passing one counts as L more map units (0 or more), as for "
         "sound",
         .number = &plan.loss, .needs = "a length of 0 or more"},
        {"radius", 0, "R",
         "radius of the walker (default 0, a point): its middle stays farther than R from all "
         "walls. The way is no longer than the shortest one for radius 1.0013 R",
         .number = &plan.radius, .needs = "a radius of 0 or more"},
        {"output", 'o', "FILE.csv",
         "the points of the way as a table, with --pairs the lengths, with --distances the cells "
         "(default: standard output)",
         .text = &plan.output, .check = CHECK_TABLE},
        {"picture", 0, "PICTURE",
         "draw the way: .png, .svg or .pdf; with --distances, --audible and --grid how far all "
         "places are, with lines of equal distance (and no table without -o)",
         .text = &plan.picture, .check = CHECK_PICTURE},
        {"json", 0, NULL, "print one JSON object: the length and the points, or the cells",
         .flag = &plan.json},
        {.group = &doors},
        {.group = &picture},
        {.group = &pipeline},
    };
    const command_usage usage = {
        .name = "path",
        .synopsis = "MAP|FILE.slv --from X,Y --to X,Y [options]",
        .operands = {"MAP|FILE.slv"},
        .what = "Finds the shortest way among the walls between two points, for a point or for a "
                "walker with a radius. It turns at ends of walls, and it does not pass between "
                "walls that meet in "
                "a point. Shut doors block it, and one-way glass from one side. In a building (a "
                "file of storeys, .storeys) it goes over links, too. The exit status is 3 if there "
                "is no way.",
        .examples = "  sightline path office.map --from 3,3 --to 53,20\n"
                    "  sightline path office.map --from 3,3 --to 53,20 --picture way.png\n"
                    "  sightline path house.storeys --from ground:3,4 --to first:8,2\n"
                    "  sightline path office.map --pairs desks.csv -o lengths.csv\n"
                    "  sightline path office.map --from 3,3 --to 53,20 --radius 0.3\n"
                    "  sightline path office.map --from 3,3 --audible 20 --loss 5\n"
                    "  sightline path office.map --from 3,3 --distances --picture far.png",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .given = &plan.pipeline.given,
    };
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, &plan.input, &helped));
    if (helped) return SL_OK;
    if (input_is_building(plan.input)) return walk_building(console, &plan);
    if (plan.from_text) SL_TRY(read_point(console->context, "--from", plan.from_text, &plan.from));
    if (plan.to_text) SL_TRY(read_point(console->context, "--to", plan.to_text, &plan.to));
    path_work w = {0};
    const sl_status status = work(console, &plan, &w);
    sl_route_destroy(console->context, &w.route);
    sl_route_map_destroy(console->context, w.map);
    eyes_destroy(console->context, &w.places);
    sl_route_finder_destroy(console->context, w.finder);
    sl_query_destroy(console->context, w.query);
    sl_free(console->context, w.shut);
    sl_free(console->context, w.losses);
    sl_free(console->context, w.cells);
    sl_baked_destroy(console->context, &w.baked);
    return status;
}

/// `path` through a building: its storeys are opened, and the way of the library is said.
#include "studies/building_path.h"

#include "arguments/outputs.h"
#include "reports/fields.h"
#include "reports/json_print.h"
#include "sightline/building_route.h"
#include "sightline/query.h"

#include <stdio.h>
#include <string.h>

typedef struct storey_work {
    sl_baked baked;
    sl_query *query;
} storey_work;

typedef struct building_work {
    sl_context *context;
    const building_path_plan *plan;
    sl_building building;
    storey_work *storeys;
    sl_route_finder **finders; ///< of the storeys; NULL: not yet
    sl_building_place from, to;
    sl_building_route route;
} building_work;

// --- the storeys

static sl_status open_storey(building_work *w, size_t s) {
    map_pipeline pipeline;
    storey_work *storey = &w->storeys[s];
    const sl_storey *what = &w->building.storeys[s];
    SL_TRY(building_pipeline(w->context, w->plan->pipeline, what, &pipeline));
    SL_TRY(
        pipeline_read_space(w->context, &pipeline, "path",
                            SL_EFFECT_DOOR | SL_EFFECT_ONEWAY | SL_EFFECT_MIRROR | SL_EFFECT_RANGE,
                            NULL, &storey->baked));
    SL_TRY(building_check_unit(w->context, w->plan->input, &w->building, s, storey->baked.map.unit,
                               w->storeys[0].baked.map.unit));
    SL_TRY(
        sl_query_over(w->context, &storey->baked.space, &storey->baked.map, NULL, &storey->query));
    for (size_t i = 0; i < storey->baked.map.door_count; i++)
        sl_query_set_door_at(w->context, storey->query, i, storey->baked.map.doors[i].open);
    SL_TRY(sl_route_finder_create(w->context, storey->query, &w->finders[s]));
    if (!(w->plan->radius > 0)) return SL_OK;
    return sl_route_finder_set_radius(w->context, w->finders[s], w->plan->radius);
}

static sl_status read_places(building_work *w) {
    const sl_building *b = &w->building;
    SL_TRY(building_place(w->context, "--from", w->plan->from, b, &w->from.storey, &w->from.at));
    return building_place(w->context, "--to", w->plan->to, b, &w->to.storey, &w->to.at);
}

static sl_status check_places(const building_work *w) {
    const sl_building *b = &w->building;
    SL_TRY(input_locate(w->context, "--from", w->plan->from,
                        &w->storeys[w->from.storey].baked.space, w->from.at, NULL));
    SL_TRY(input_locate(w->context, "--to", w->plan->to, &w->storeys[w->to.storey].baked.space,
                        w->to.at, NULL));
    for (size_t i = 0; i < 2 * b->link_count; i++)
        SL_TRY(input_check_place(w->context, w->plan->input, b->links[i / 2].line,
                                 &w->storeys[b->links[i / 2].storeys[i % 2]].baked.space,
                                 b->links[i / 2].places[i % 2]));
    return SL_OK;
}

// --- what is said

static void put_points(const building_work *w, FILE *out, const char *indent) {
    for (size_t i = 0; i < w->route.count; i++) {
        fputs(indent, out);
        csv_put(out, w->route.points[i].at.x, ",");
        csv_put(out, w->route.points[i].at.y, *indent ? " " : ",");
        fprintf(out, "%s\n", w->building.storeys[w->route.points[i].storey].name);
    }
}

static void print_way(const building_work *w) {
    const char *unit = w->storeys[0].baked.map.unit;
    fputs("length ", stdout);
    csv_put(stdout, w->route.length, *unit ? " " : "");
    fputs(unit, stdout);
    for (size_t i = 0; i < w->route.link_count; i++)
        printf("%s%s", i ? ", " : ", by ", w->building.links[w->route.links[i]].name);
    putchar('\n');
    put_points(w, stdout, "  ");
}

static sl_status print_json(const building_work *w) {
    json_fields fields = json_begin();
    const bool found = w->route.found;
    json_add_flag(&fields, "found", found);
    if (found) json_add_real(&fields, "length", w->route.length);
    json_open_list(&fields, "points");
    for (size_t i = 0; i < w->route.count; i++) {
        json_open_item(&fields);
        json_add_text(&fields, "storey", w->building.storeys[w->route.points[i].storey].name);
        json_add_real(&fields, "x", w->route.points[i].at.x);
        json_add_real(&fields, "y", w->route.points[i].at.y);
        json_close(&fields);
    }
    json_close_list(&fields);
    json_open_list(&fields, "links");
    for (size_t i = 0; i < w->route.link_count; i++) {
        json_open_item(&fields);
        json_add_text(&fields, "name", w->building.links[w->route.links[i]].name);
        json_close(&fields);
    }
    json_close_list(&fields);
    return json_print(w->context, &fields);
}

static sl_status report(command_console *console, const building_work *w) {
    const bool found = w->route.found;
    if (w->plan->output && found) {
        sl_output output;
        SL_TRY(sl_output_open(w->context, w->plan->output, &output));
        fputs("x,y,storey\n", output.stream);
        put_points(w, output.stream, "");
        SL_TRY(sl_output_close(w->context, &output, SL_OK));
    }
    progress_line_clear(&console->line);
    console->fault = !found;
    if (w->plan->json) return print_json(w);
    if (!found)
        puts("no way: walls, shut doors or missing links are between");
    else if (!w->plan->output || (output_is_plain_file(w->plan->output) && !console->quiet))
        print_way(w);
    return SL_OK;
}

static sl_status work(command_console *console, building_work *w) {
    SL_TRY(building_read(w->context, w->plan->input, w->plan->pipeline, &w->building));
    SL_TRY(read_places(w));
    w->storeys = sl_alloc_array(w->context, w->building.storey_count, sizeof *w->storeys);
    w->finders = sl_alloc_array(w->context, w->building.storey_count, sizeof *w->finders);
    if (!w->storeys || !w->finders) return SL_NO_MEMORY;
    for (size_t s = 0; s < w->building.storey_count; s++) SL_TRY(open_storey(w, s));
    SL_TRY(check_places(w));
    SL_TRY(sl_building_route_find(w->context, &w->building, w->finders, w->from, w->to, &w->route));
    return report(console, w);
}

sl_status building_path(command_console *console, const building_path_plan *plan) {
    sl_context *context = console->context;
    building_work w = {.context = context, .plan = plan};
    const sl_status status = work(console, &w);
    for (size_t s = 0; w.storeys && w.finders && s < w.building.storey_count; s++) {
        sl_route_finder_destroy(context, w.finders[s]);
        sl_query_destroy(context, w.storeys[s].query);
        sl_baked_destroy(context, &w.storeys[s].baked);
    }
    sl_free(context, w.storeys);
    sl_free(context, w.finders);
    sl_building_route_destroy(context, &w.route);
    sl_building_destroy(context, &w.building);
    return status;
}

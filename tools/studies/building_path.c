/// Shortest ways through a building: Dijkstra over the ends of links. A step goes along a link, or
/// along the shortest way between two ends on one storey. Each such way is asked for when its begin
/// is settled, so the cost is at most (2 links + 2)^2 / storeys ways.
#include "studies/building_path.h"

#include "arguments/outputs.h"
#include "reports/fields.h"
#include "reports/json_print.h"
#include "sightline/path.h"
#include "sightline/query.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { FROM, TO, ENDS }; ///< nodes: both places, then two ends of each link

typedef struct storey_work {
    sl_baked baked;
    sl_query *query;
    sl_route_finder *finder;
} storey_work;

typedef struct node {
    size_t storey;
    sl_point at;
    double distance;
    bool settled;
    size_t before; ///< node
    bool by_link;  ///< along the link of this node and the one before
} node;

/// A point of the way.
typedef struct way_point {
    size_t storey;
    sl_point at;
} way_point;

typedef struct building_work {
    sl_context *context;
    const building_path_plan *plan;
    sl_building building;
    storey_work *storeys;
    node *nodes;
    size_t node_count;
    sl_route route;
    SL_ARRAY(way_point) points;
    SL_ARRAY(size_t) links; ///< of the way, in order
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
    SL_TRY(sl_route_finder_create(w->context, storey->query, &storey->finder));
    if (!(w->plan->radius > 0)) return SL_OK;
    return sl_route_finder_set_radius(w->context, storey->finder, w->plan->radius);
}

/// Both places, and the ends of links.
static sl_status make_nodes(building_work *w) {
    const sl_building *b = &w->building;
    w->node_count = ENDS + 2 * b->link_count;
    w->nodes = sl_alloc_array(w->context, w->node_count, sizeof *w->nodes);
    if (!w->nodes) return SL_NO_MEMORY;
    SL_TRY(building_place(w->context, "--from", w->plan->from, b, &w->nodes[FROM].storey,
                          &w->nodes[FROM].at));
    SL_TRY(
        building_place(w->context, "--to", w->plan->to, b, &w->nodes[TO].storey, &w->nodes[TO].at));
    for (size_t i = 0; i < 2 * b->link_count; i++)
        w->nodes[ENDS + i] =
            (node){.storey = b->links[i / 2].storeys[i % 2], .at = b->links[i / 2].places[i % 2]};
    for (size_t i = 0; i < w->node_count; i++) w->nodes[i].distance = i == FROM ? 0 : INFINITY;
    return SL_OK;
}

static sl_status check_places(building_work *w) {
    for (size_t i = 0; i < w->node_count; i++) {
        const sl_space *space = &w->storeys[w->nodes[i].storey].baked.space;
        if (i < ENDS)
            SL_TRY(input_locate(w->context, i == FROM ? "--from" : "--to",
                                i == FROM ? w->plan->from : w->plan->to, space, w->nodes[i].at,
                                NULL));
        else
            SL_TRY(input_check_place(w->context, w->plan->input,
                                     w->building.links[(i - ENDS) / 2].line, space,
                                     w->nodes[i].at));
    }
    return SL_OK;
}

// --- the way

static sl_status find_between(building_work *w, size_t from, size_t to) {
    return sl_route_find(w->context, w->storeys[w->nodes[from].storey].finder, w->nodes[from].at,
                         w->nodes[to].at, &w->route);
}

static void relax(building_work *w, size_t from, size_t to, double length, bool by_link) {
    node *n = &w->nodes[to];
    const double distance = w->nodes[from].distance + length;
    if (n->settled || !(distance < n->distance)) return;
    n->distance = distance;
    n->before = from;
    n->by_link = by_link;
}

static sl_status settle(building_work *w, size_t from) {
    w->nodes[from].settled = true;
    if (from >= ENDS)
        relax(w, from, ENDS + ((from - ENDS) ^ 1), w->building.links[(from - ENDS) / 2].length,
              true);
    for (size_t to = 0; to < w->node_count; to++) {
        if (w->nodes[to].settled || w->nodes[to].storey != w->nodes[from].storey) continue;
        SL_TRY(sl_check_cancelled(w->context));
        SL_TRY(find_between(w, from, to));
        if (w->route.found) relax(w, from, to, w->route.length, false);
    }
    return SL_OK;
}

static sl_status search(building_work *w) {
    for (;;) {
        size_t next = w->node_count;
        for (size_t i = 0; i < w->node_count; i++)
            if (!w->nodes[i].settled && isfinite(w->nodes[i].distance) &&
                (next == w->node_count || w->nodes[i].distance < w->nodes[next].distance))
                next = i;
        if (next == w->node_count || next == TO) return SL_OK;
        SL_TRY(settle(w, next));
    }
}

static sl_status add_point(building_work *w, size_t storey, sl_point at) {
    SL_TRY(SL_ARRAY_ROOM(w->context, &w->points, 1));
    w->points.items[w->points.count++] = (way_point){storey, at};
    return SL_OK;
}

/// The points between a node and the next one of the way, and the next one.
static sl_status add_leg(building_work *w, size_t from, size_t to) {
    if (w->nodes[to].by_link) {
        SL_TRY(SL_ARRAY_ROOM(w->context, &w->links, 1));
        w->links.items[w->links.count++] = (to - ENDS) / 2;
        return add_point(w, w->nodes[to].storey, w->nodes[to].at);
    }
    SL_TRY(find_between(w, from, to));
    for (size_t i = 1; i < w->route.count; i++)
        SL_TRY(add_point(w, w->nodes[to].storey, w->route.points[i]));
    return SL_OK;
}

static sl_status follow(building_work *w, size_t to) {
    if (to == FROM) return add_point(w, w->nodes[FROM].storey, w->nodes[FROM].at);
    SL_TRY(follow(w, w->nodes[to].before)); // at most as deep as there are links
    return add_leg(w, w->nodes[to].before, to);
}

// --- what is said

static void put_points(const building_work *w, FILE *out, const char *indent) {
    for (size_t i = 0; i < w->points.count; i++) {
        fputs(indent, out);
        csv_put(out, w->points.items[i].at.x, ",");
        csv_put(out, w->points.items[i].at.y, *indent ? " " : ",");
        fprintf(out, "%s\n", w->building.storeys[w->points.items[i].storey].name);
    }
}

static void print_way(const building_work *w) {
    const char *unit = w->storeys[0].baked.map.unit;
    fputs("length ", stdout);
    csv_put(stdout, w->nodes[TO].distance, *unit ? " " : "");
    fputs(unit, stdout);
    for (size_t i = 0; i < w->links.count; i++)
        printf("%s%s", i ? ", " : ", by ", w->building.links[w->links.items[i]].name);
    putchar('\n');
    put_points(w, stdout, "  ");
}

static sl_status print_json(const building_work *w) {
    json_fields fields = json_begin();
    const bool found = w->points.count > 0;
    json_add_flag(&fields, "found", found);
    if (found) json_add_real(&fields, "length", w->nodes[TO].distance);
    json_open_list(&fields, "points");
    for (size_t i = 0; i < w->points.count; i++) {
        json_open_item(&fields);
        json_add_text(&fields, "storey", w->building.storeys[w->points.items[i].storey].name);
        json_add_real(&fields, "x", w->points.items[i].at.x);
        json_add_real(&fields, "y", w->points.items[i].at.y);
        json_close(&fields);
    }
    json_close_list(&fields);
    json_open_list(&fields, "links");
    for (size_t i = 0; i < w->links.count; i++) {
        json_open_item(&fields);
        json_add_text(&fields, "name", w->building.links[w->links.items[i]].name);
        json_close(&fields);
    }
    json_close_list(&fields);
    return json_print(w->context, &fields);
}

static sl_status report(command_console *console, const building_work *w) {
    const bool found = w->points.count > 0;
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
    SL_TRY(make_nodes(w));
    w->storeys = sl_alloc_array(w->context, w->building.storey_count, sizeof *w->storeys);
    if (!w->storeys) return SL_NO_MEMORY;
    for (size_t s = 0; s < w->building.storey_count; s++) SL_TRY(open_storey(w, s));
    SL_TRY(check_places(w));
    SL_TRY(search(w));
    if (isfinite(w->nodes[TO].distance)) SL_TRY(follow(w, TO));
    return report(console, w);
}

sl_status building_path(command_console *console, const building_path_plan *plan) {
    sl_context *context = console->context;
    building_work w = {.context = context, .plan = plan};
    const sl_status status = work(console, &w);
    for (size_t s = 0; w.storeys && s < w.building.storey_count; s++) {
        sl_route_finder_destroy(context, w.storeys[s].finder);
        sl_query_destroy(context, w.storeys[s].query);
        sl_baked_destroy(context, &w.storeys[s].baked);
    }
    void *const arrays[] = {w.storeys, w.nodes, w.points.items, w.links.items};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) sl_free(context, arrays[i]);
    sl_route_destroy(context, &w.route);
    sl_building_destroy(context, &w.building);
    return status;
}

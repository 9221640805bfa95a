/// Shortest ways through a building: Dijkstra over the ends of links. A step goes along a link, or
/// along the shortest way between two ends on one storey.
#include "sightline/building_route.h"

#include "geometry/length.h"
#include "sightline/support.h"

#include <math.h>

enum { FROM, TO, ENDS }; ///< nodes: both places, then two ends of each link

typedef struct node {
    sl_building_place place;
    double distance;
    bool settled;
    size_t before; ///< node
    bool by_link;  ///< along the link of this node and the one before
} node;

typedef struct search {
    sl_context *context;
    const sl_building *building;
    sl_route_finder *const *finders;
    node *nodes;
    size_t node_count;
    sl_route route;
    SL_ARRAY(sl_building_place) points;
    SL_ARRAY(size_t) links;
} search;

static sl_status make_nodes(search *s, sl_building_place from, sl_building_place to) {
    const sl_building *b = s->building;
    s->node_count = ENDS + 2 * b->link_count;
    s->nodes = sl_alloc_array(s->context, s->node_count, sizeof *s->nodes);
    if (!s->nodes) return SL_NO_MEMORY;
    for (size_t i = 0; i < s->node_count; i++) s->nodes[i].distance = INFINITY;
    s->nodes[FROM] = (node){.place = from};
    s->nodes[TO].place = to;
    for (size_t i = 0; i < 2 * b->link_count; i++)
        s->nodes[ENDS + i].place =
            (sl_building_place){b->links[i / 2].storeys[i % 2], b->links[i / 2].places[i % 2]};
    return SL_OK;
}

static sl_status find_between(search *s, size_t from, size_t to) {
    const sl_building_place *a = &s->nodes[from].place;
    return sl_route_find(s->context, s->finders[a->storey], a->at, s->nodes[to].place.at,
                         &s->route);
}

static void relax(search *s, size_t from, size_t to, double length, bool by_link) {
    node *n = &s->nodes[to];
    const double distance = s->nodes[from].distance + length;
    if (n->settled || !(distance < n->distance)) return;
    n->distance = distance;
    n->before = from;
    n->by_link = by_link;
}

/// Whether a way on the storey may be a part of a shorter one: none is shorter than the straight
/// line.
static bool may_gain(const search *s, size_t from, size_t to) {
    const node *a = &s->nodes[from], *b = &s->nodes[to];
    if (b->settled || b->place.storey != a->place.storey) return false;
    const double least =
        a->distance + sli_length(b->place.at.x - a->place.at.x, b->place.at.y - a->place.at.y);
    return least < b->distance && (to == TO || least < s->nodes[TO].distance);
}

static sl_status settle(search *s, size_t from) {
    s->nodes[from].settled = true;
    if (from >= ENDS)
        relax(s, from, ENDS + ((from - ENDS) ^ 1), s->building->links[(from - ENDS) / 2].length,
              true);
    for (size_t to = 0; to < s->node_count; to++) {
        if (!may_gain(s, from, to)) continue;
        SL_TRY(sl_check_cancelled(s->context));
        SL_TRY(find_between(s, from, to));
        if (s->route.found) relax(s, from, to, s->route.length, false);
    }
    return SL_OK;
}

static sl_status run(search *s) {
    for (;;) {
        size_t next = s->node_count;
        for (size_t i = 0; i < s->node_count; i++)
            if (!s->nodes[i].settled && isfinite(s->nodes[i].distance) &&
                (next == s->node_count || s->nodes[i].distance < s->nodes[next].distance))
                next = i;
        if (next == s->node_count || next == TO) return SL_OK;
        SL_TRY(settle(s, next));
    }
}

static sl_status add_point(search *s, sl_building_place place) {
    SL_TRY(SL_ARRAY_ROOM(s->context, &s->points, 1));
    s->points.items[s->points.count++] = place;
    return SL_OK;
}

/// The points between a node and the next one of the way, and the next one.
static sl_status add_leg(search *s, size_t from, size_t to) {
    const sl_building_place end = s->nodes[to].place;
    if (s->nodes[to].by_link) {
        SL_TRY(SL_ARRAY_ROOM(s->context, &s->links, 1));
        s->links.items[s->links.count++] = (to - ENDS) / 2;
        return add_point(s, end);
    }
    SL_TRY(find_between(s, from, to));
    for (size_t i = 1; i < s->route.count; i++)
        SL_TRY(add_point(s, (sl_building_place){end.storey, s->route.points[i]}));
    return SL_OK;
}

static sl_status follow(search *s, size_t to) {
    if (to == FROM) return add_point(s, s->nodes[FROM].place);
    SL_TRY(follow(s, s->nodes[to].before)); // at most as deep as there are nodes
    return add_leg(s, s->nodes[to].before, to);
}

sl_status sl_building_route_find(sl_context *context, const sl_building *building,
                                 sl_route_finder *const *finders, sl_building_place from,
                                 sl_building_place to, sl_building_route *out) {
    search s = {.context = context, .building = building, .finders = finders};
    if (from.storey >= building->storey_count || to.storey >= building->storey_count)
        return sl_fail(context, SL_BAD_ARGUMENT, "there are %zu storeys", building->storey_count);
    sl_status status = make_nodes(&s, from, to);
    if (status == SL_OK) status = run(&s);
    const bool found = status == SL_OK && isfinite(s.nodes[TO].distance);
    if (found) status = follow(&s, TO);
    if (status == SL_OK) {
        *out = (sl_building_route){.found = found,
                                   .length = found ? s.nodes[TO].distance : 0,
                                   .points = s.points.items,
                                   .count = s.points.count,
                                   .links = s.links.items,
                                   .link_count = s.links.count};
    } else {
        sl_free(context, s.points.items);
        sl_free(context, s.links.items);
    }
    sl_free(context, s.nodes);
    sl_route_destroy(context, &s.route);
    return status;
}

void sl_building_route_destroy(sl_context *context, sl_building_route *route) {
    sl_free(context, route->points);
    sl_free(context, route->links);
    *route = (sl_building_route){0};
}

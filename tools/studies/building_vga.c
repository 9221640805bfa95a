/// Joins the storeys' points, graphs and measures, and measures what goes over links.
#include "studies/building_vga.h"

#include "sightline/support.h"

#include <math.h>
#include <string.h>

static sl_status check_plan(sl_context *context, const vga_plan *plan) {
    const char *alone = plan->pairs                      ? "pairs"
                        : plan->compare                  ? "compare"
                        : plan->agents_given             ? "agents"
                        : plan->points.links             ? "links"
                        : plan->points.at.count          ? "at"
                        : plan->points.points            ? "points"
                        : plan->doors.shut               ? "shut"
                        : plan->doors.open               ? "open"
                        : plan->turned                   ? "seen-from"
                        : plan->parts & VGA_PART_METRIC  ? "measures metric"
                        : plan->parts & VGA_PART_ANGULAR ? "measures angular"
                                                         : NULL;
    if (!alone) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "%s: a building goes without --%s, which is for one plan", plan->input, alone);
}

// --- the storeys

static sl_status check_points(sl_context *context, const vga_plan *plan, uint64_t points) {
    if (points <= SL_VGA_POINTS_MOST) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "--grid %.9g: the building has %.0f points, and a graph has up to %u; choose a "
                   "larger step",
                   plan->points.step, (double)points, SL_VGA_POINTS_MOST);
}

static sl_status compute_storey(sl_context *context, const vga_plan *plan, building_vga *b,
                                size_t s) {
    vga_plan own = *plan;
    own.input = b->building.storeys[s].path;
    own.of_building = true;
    SL_TRY(building_pipeline(context, &plan->pipeline, &b->building.storeys[s], &own.pipeline));
    SL_TRY(vga_compute(context, &own, &b->storeys[s]));
    SL_TRY(check_points(context, plan, (uint64_t)b->first[s] + b->storeys[s].table.grid.count));
    b->first[s + 1] = b->first[s] + b->storeys[s].table.grid.count;
    return building_check_unit(context, plan->input, &b->building, s, b->storeys[s].baked.map.unit,
                               b->storeys[0].baked.map.unit);
}

// --- all points

/// Where all plans lie on the earth; nowhere if they differ.
static sl_earth earth_of(const building_vga *b) {
    const sl_earth first = b->storeys[0].table.earth;
    for (size_t s = 1; s < b->building.storey_count; s++) {
        const sl_earth other = b->storeys[s].table.earth;
        if (other.known != first.known || other.epsg != first.epsg ||
            other.longitude != first.longitude || other.latitude != first.latitude)
            return (sl_earth){0};
    }
    return first;
}

static sl_status join_points(sl_context *context, building_vga *b) {
    vga_table *all = &b->all.table;
    const size_t storeys = b->building.storey_count;
    const uint32_t count = b->first[storeys];
    all->grid = b->storeys[0].table.grid;
    all->grid.count = count;
    all->grid.points = sl_alloc_array(context, count, sizeof *all->grid.points);
    all->grid.squares = sl_alloc_array(context, count, sizeof *all->grid.squares);
    all->measures = sl_alloc_array(context, count, sizeof *all->measures);
    all->part = sl_alloc_array(context, count, sizeof *all->part);
    b->names = sl_alloc_array(context, count, sizeof *b->names);
    all->parts = b->storeys[0].table.parts;
    if (all->parts & VGA_PART_ISOVIST)
        all->isovists = sl_alloc_array(context, count, sizeof *all->isovists);
    if (!all->grid.points || !all->grid.squares || !all->measures || !all->part || !b->names ||
        (all->parts & VGA_PART_ISOVIST && !all->isovists))
        return SL_NO_MEMORY;
    all->storeys = b->names;
    all->earth = earth_of(b);
    for (size_t s = 0; s < storeys; s++) {
        const vga_table *from = &b->storeys[s].table;
        for (uint32_t p = 0; p < from->grid.count; p++) {
            const uint32_t to = b->first[s] + p;
            all->grid.points[to] = from->grid.points[p];
            all->grid.squares[to] = from->grid.squares[p];
            all->measures[to] = from->measures[p];
            if (all->isovists) all->isovists[to] = from->isovists[p];
            b->names[to] = b->building.storeys[s].name;
        }
    }
    return SL_OK;
}

static sl_status join_graphs(sl_context *context, building_vga *b) {
    const size_t count = b->building.storey_count;
    sl_vga_graph *graphs = sl_alloc_array(context, count, sizeof *graphs);
    if (!graphs) return SL_NO_MEMORY;
    for (size_t s = 0; s < count; s++) graphs[s] = b->storeys[s].graph;
    const sl_status status = sl_vga_graph_join(context, graphs, count, &b->all.graph);
    sl_free(context, graphs);
    return status;
}

static sl_status find_links(sl_context *context, const vga_plan *plan, building_vga *b) {
    const sl_building *building = &b->building;
    b->all.links = sl_alloc_array(context, building->link_count, sizeof *b->all.links);
    if (!b->all.links) return SL_NO_MEMORY;
    for (size_t i = 0; i < building->link_count; i++) {
        const sl_storey_link *link = &building->links[i];
        uint32_t ends[2];
        for (int end = 0; end < 2; end++) {
            const sl_vga_grid *grid = &b->storeys[link->storeys[end]].table.grid;
            const uint32_t point = sl_vga_grid_find(grid, link->places[end]);
            if (point == UINT32_MAX)
                return sl_fail_at(context, plan->input, link->line,
                                  "link %s: storey %s has no point of the grid at %.9g,%.9g; its "
                                  "points are %.9g apart",
                                  link->name, building->storeys[link->storeys[end]].name,
                                  link->places[end].x, link->places[end].y, grid->step);
            ends[end] = b->first[link->storeys[end]] + point;
        }
        if (ends[0] == ends[1])
            return sl_fail_at(context, plan->input, link->line,
                              "link %s: both places are nearest to one point of the grid",
                              link->name);
        b->all.links[b->all.link_count++] = (sl_vga_link){ends[0], ends[1]};
    }
    return SL_OK;
}

// --- what goes over links

static sl_status measure_steps(sl_context *context, const vga_plan *plan, building_vga *b) {
    vga_table *all = &b->all.table;
    size_t count;
    const sl_measure *measures = sl_measures(SL_VGA, &count);
    sl_vga_options options = plan->options;
    options.parts = SL_VGA_GLOBAL;
    sl_vga_measures *global = sl_alloc_array(context, all->grid.count, sizeof *global);
    if (!global) return SL_NO_MEMORY;
    const sl_status status =
        sl_vga_measure_linked(context, b->storeys[0].outline, &all->grid, &b->all.graph,
                              b->all.links, b->all.link_count, &options, global);
    for (size_t k = 0; k < count && status == SL_OK; k++)
        if (measures[k].of == SL_OF_GRAPH && measures[k].group == SL_GROUP_GLOBAL)
            for (uint32_t p = 0; p < all->grid.count; p++)
                ((double *)&all->measures[p])[measures[k].index] =
                    ((const double *)&global[p])[measures[k].index];
    sl_free(context, global);
    return status;
}

/// Steps from the places of --from.
static sl_status find_depths(sl_context *context, const vga_plan *plan, building_vga *b) {
    vga_table *all = &b->all.table;
    const size_t count = plan->from.count;
    uint32_t *from = sl_alloc_array(context, count, sizeof *from);
    all->depths = sl_alloc_array(context, all->grid.count, sizeof *all->depths);
    sl_status status = from && all->depths ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; i < count && status == SL_OK; i++) {
        size_t storey;
        sl_point at;
        status = building_place(context, "--from", plan->from.items[i], &b->building, &storey, &at);
        if (status != SL_OK) break;
        const uint32_t point = sl_vga_grid_find(&b->storeys[storey].table.grid, at);
        from[i] = b->first[storey] + point;
        if (point == UINT32_MAX)
            status = sl_fail(context, SL_BAD_ARGUMENT, "--from %s: the grid has no point there",
                             plan->from.items[i]);
    }
    if (status == SL_OK)
        status =
            sl_vga_depth(context, b->storeys[0].outline, &all->grid, &b->all.graph, b->all.links,
                         b->all.link_count, SL_VGA_GLOBAL, from, count, all->depths);
    sl_free(context, from);
    return status;
}

/// Gives the storeys what was found for all, for their pictures.
static sl_status give_back(sl_context *context, building_vga *b) {
    const vga_table *all = &b->all.table;
    for (size_t s = 0; s < b->building.storey_count; s++) {
        vga_table *to = &b->storeys[s].table;
        const uint32_t first = b->first[s], count = to->grid.count;
        to->part = sl_alloc_array(context, count, sizeof *to->part);
        if (all->depths) to->depths = sl_alloc_array(context, count, sizeof *to->depths);
        if (!to->part || (all->depths && !to->depths)) return SL_NO_MEMORY;
        to->part_count = all->part_count;
        for (uint32_t p = 0; p < count; p++) {
            to->measures[p] = all->measures[first + p];
            to->part[p] = all->part[first + p];
            if (all->depths) to->depths[p] = all->depths[first + p];
        }
    }
    return SL_OK;
}

sl_status building_vga_compute(sl_context *context, vga_plan *plan, building_vga *b) {
    SL_TRY(check_plan(context, plan));
    SL_TRY(building_read(context, plan->input, &plan->pipeline, &b->building));
    const size_t count = b->building.storey_count;
    b->storeys = sl_alloc_array(context, count, sizeof *b->storeys);
    b->first = sl_alloc_array(context, count + 1, sizeof *b->first);
    if (!b->storeys || !b->first) return SL_NO_MEMORY;
    for (size_t s = 0; s < count; s++) SL_TRY(compute_storey(context, plan, b, s));
    SL_TRY(join_points(context, b));
    if (!b->storeys[0].graph.rows) return give_back(context, b); // of isovists alone
    SL_TRY(join_graphs(context, b));
    SL_TRY(find_links(context, plan, b));
    SL_TRY(sl_vga_parts(context, &b->all.graph, b->all.links, b->all.link_count, b->all.table.part,
                        &b->all.table.part_count));
    if (plan->parts & VGA_PART_VISUAL) SL_TRY(measure_steps(context, plan, b));
    if (plan->from.count) SL_TRY(find_depths(context, plan, b));
    return give_back(context, b);
}

void building_vga_destroy(sl_context *context, building_vga *b) {
    for (size_t s = 0; b->storeys && s < b->building.storey_count; s++)
        vga_work_destroy(context, &b->storeys[s]);
    vga_work_destroy(context, &b->all);
    sl_free(context, b->storeys);
    sl_free(context, b->first);
    sl_free(context, b->names);
    sl_building_destroy(context, &b->building);
}

sl_status building_vga_storey(sl_context *context, const building_vga *b, const char *name,
                              const vga_work **out) {
    const size_t storey = name ? sl_building_find(&b->building, name, strlen(name)) : 0;
    if (storey == SL_NO_STOREY)
        return sl_fail(context, SL_BAD_ARGUMENT, "--storey %s: the building has no such storey",
                       name);
    *out = &b->storeys[storey];
    return SL_OK;
}

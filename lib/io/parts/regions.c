/// Regions of a map, and which starts to believe.
///
/// A game's map may have a start that nobody begins at: a character that waits in a closed box, a
/// token that is parked beside the plan. Names do not tell. What it reaches does: a start that
/// reaches less than a tenth of what others reach is named and left out.
///
/// The map is cleaned and cut into a mesh, as a bake does it. Portals join its cells to regions
/// (union-find). Time O(n log n).
#include "io/parts/regions.h"

#include "base/base.h"
#include "geometry/length.h"
#include "sightline/support.h"

// --- the map that is cut

/// Walls that stop steps, doors, and no ground.
static sl_status copy_barriers(sl_context *context, const sl_map *map, sl_map *to) {
    for (size_t i = 0; i < map->wall_count; i++)
        SL_TRY(sl_map_add_wall(context, to, map->walls[i].a, map->walls[i].b, 0));
    for (size_t i = 0; i < map->mirror_count; i++)
        SL_TRY(
            sl_map_add_wall(context, to, map->mirrors[i].segment.a, map->mirrors[i].segment.b, 0));
    for (size_t i = 0; i < map->seam_count; i++)
        if (map->seams[i].stops & SL_STOPS_STEPS)
            SL_TRY(
                sl_map_add_wall(context, to, map->seams[i].segment.a, map->seams[i].segment.b, 0));
    for (size_t i = 0; i < map->door_count; i++)
        if (!sli_same_point(map->doors[i].segment.a, map->doors[i].segment.b))
            SL_TRY(sl_map_add_door(context, to, "door", map->doors[i].segment, true, 0));
    to->precision = map->precision;
    return SL_OK;
}

/// What cleaning and cutting would say, the bake of the map itself says.
static sl_status cut(sl_context *context, sl_map *map, sli_regions *out) {
    size_t count, mesh = 0;
    const sl_subdivision *ways = sl_subdivisions(&count);
    sl_clean_account account = {0};
    const sl_hooks hooks = context->hooks;
    while (mesh + 1 < count && strcmp(ways[mesh].name, "mesh") != 0) mesh++;
    context->hooks.note = NULL;
    context->hooks.progress = NULL;
    sl_status status = sl_map_clean(context, map, NULL, &account);
    out->tolerance = account.tolerance;
    if (status == SL_OK) status = ways[mesh].subdivide(context, map, NULL, &out->space);
    context->hooks = hooks;
    return status;
}

// --- joining cells

/// Numbers the regions: `region` holds parents of the union-find first.
static sl_status number_regions(sl_context *context, sli_regions *regions) {
    const sl_space *space = &regions->space;
    uint32_t *region = regions->region;
    for (uint32_t i = 0; i < space->cell_count; i++) region[i] = i;
    for (uint32_t i = 0; i < space->portal_count; i++) {
        const uint32_t a = sl_root_of(region, space->portals[i].cell[0]);
        const uint32_t b = sl_root_of(region, space->portals[i].cell[1]);
        region[a > b ? a : b] = a > b ? b : a; // a root is the lowest cell
    }
    for (uint32_t i = 0; i < space->cell_count; i++) sl_root_of(region, i);
    for (uint32_t i = 0; i < space->cell_count; i++) {
        const uint32_t parent = region[i];
        region[i] = parent == i ? (uint32_t)regions->count++ : region[parent];
    }
    regions->items = sl_alloc_array(context, regions->count, sizeof *regions->items);
    if (!regions->items) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < space->cell_count; i++)
        regions->items[region[i]].area += sl_space_area(space, i);
    for (uint32_t i = 0; i < space->seam_portal_count; i++)
        if (space->seams[space->seam_portals[i].seam].kind == SL_SEAM_DOOR)
            regions->items[region[space->portals[space->seam_portals[i].portal].cell[0]]].doors =
                true;
    return SL_OK;
}

/// Adds up the lengths of walls beside each region.
static sl_status measure_walls(sl_context *context, sli_regions *regions) {
    const sl_space *space = &regions->space;
    uint32_t *beside = sl_alloc_array(context, 2 * (size_t)space->wall_count, sizeof *beside);
    if (!beside) return SL_NO_MEMORY;
    for (size_t i = 0; i < 2 * (size_t)space->wall_count; i++) beside[i] = SL_NO_CELL;
    for (uint32_t i = 0; i < space->cell_count; i++)
        for (uint32_t k = 0; k < space->cells[i].vertex_count; k++) {
            const uint32_t next = space->neighbour[space->cells[i].first_vertex + k];
            if (next == SL_NEIGHBOUR_PORTAL || next == SL_NEIGHBOUR_BORDER) continue;
            beside[2 * (size_t)(next & ~SL_NEIGHBOUR_RIGHT) + (next >> 31)] = regions->region[i];
        }
    for (size_t i = 0; i < space->wall_count; i++) {
        const sl_wall *wall = &space->walls[i];
        const double length = sli_length(wall->b.x - wall->a.x, wall->b.y - wall->a.y);
        const uint32_t left = beside[2 * i], right = beside[2 * i + 1];
        if (left != SL_NO_CELL) regions->items[left].beside += length;
        if (right != SL_NO_CELL) regions->items[right].beside += length;
        if (left != SL_NO_CELL && left == right) regions->items[left].between += 2 * length;
    }
    sl_free(context, beside);
    return SL_OK;
}

sl_status sli_regions_make(sl_context *context, const sl_map *map, const sl_segment *more,
                           size_t count, sli_regions *out) {
    sl_map barriers = {0};
    sli_regions regions = {0};
    sl_status status = copy_barriers(context, map, &barriers);
    for (size_t i = 0; status == SL_OK && i < count; i++)
        status = sl_map_add_wall(context, &barriers, more[i].a, more[i].b, 0);
    if (status == SL_OK) status = cut(context, &barriers, &regions);
    sl_map_destroy(context, &barriers);
    if (status == SL_OK) {
        regions.region = sl_alloc_array(context, regions.space.cell_count, sizeof *regions.region);
        status = regions.region ? number_regions(context, &regions) : SL_NO_MEMORY;
    }
    if (status == SL_OK) status = measure_walls(context, &regions);
    if (status == SL_OK)
        *out = regions;
    else
        sli_regions_destroy(context, &regions);
    return status;
}

void sli_regions_destroy(sl_context *context, sli_regions *regions) {
    sl_space_destroy(context, &regions->space);
    sl_free(context, regions->region);
    sl_free(context, regions->items);
    *regions = (sli_regions){0};
}

uint32_t sli_regions_at(const sli_regions *regions, sl_point place) {
    const uint32_t cell = sl_space_locate(&regions->space, place);
    return cell == SL_NO_CELL ? SL_NO_CELL : regions->region[cell];
}

sl_point sli_cell_middle(const sl_space *space, uint32_t number) {
    const sl_cell *cell = &space->cells[number];
    sl_point sum = {0};
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        sum.x += space->vertices[cell->first_vertex + i].x / cell->vertex_count;
        sum.y += space->vertices[cell->first_vertex + i].y / cell->vertex_count;
    }
    return sum;
}

// --- starts

/// What a start reaches; 0 for what is none, or is in doubt.
static double reached_from(const sli_regions *regions, const sli_things *things, size_t number) {
    const sli_thing *thing = &things->items.items[number];
    if (thing->kind != SLI_THING_START || thing->doubt) return 0;
    const uint32_t region = sli_regions_at(regions, sli_thing_place(things, number));
    return region == SL_NO_CELL ? 0 : regions->items[region].area;
}

void sli_regions_doubt(const sli_regions *regions, sli_things *things) {
    double most = 0;
    if (things->options->start_names) return;
    for (size_t i = 0; i < regions->count; i++)
        if (regions->items[i].doors) most = fmax(most, regions->items[i].area);
    for (size_t i = 0; i < things->items.count; i++)
        most = fmax(most, reached_from(regions, things, i));
    for (size_t i = 0; i < things->items.count; i++) {
        const double area = reached_from(regions, things, i);
        if (area > 0 && sli_reaches_little(area, most))
            things->items.items[i].doubt = "it reaches less than a tenth of what others would; "
                                           "--start-names takes it all the same";
    }
}

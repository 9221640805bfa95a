#include "sightline/map.h"
#include "sightline/support.h"

#include <string.h>

static sl_status copy_walls(sl_context *context, const sl_map *from, sl_map *to) {
    for (size_t i = 0; i < from->wall_count; i++)
        SL_TRY(
            sl_map_add_wall(context, to, from->walls[i].a, from->walls[i].b, from->walls[i].line));
    return SL_OK;
}

static sl_status copy_effects(sl_context *context, const sl_map *from, sl_map *to) {
    for (size_t i = 0; i < from->door_count; i++) {
        const sl_door *d = &from->doors[i];
        SL_TRY(sl_map_add_door(context, to, d->name, d->segment, d->open, d->line));
        if (!d->parts) continue;
        to->doors[i].parts = sl_alloc_array(context, d->part_count, sizeof *d->parts);
        if (!to->doors[i].parts) return SL_NO_MEMORY;
        memcpy(to->doors[i].parts, d->parts, d->part_count * sizeof *d->parts);
        to->doors[i].part_count = d->part_count;
    }
    for (size_t i = 0; i < from->mirror_count; i++) {
        SL_TRY(sl_map_add_mirror(context, to, from->mirrors[i].segment, from->mirrors[i].line));
        to->mirrors[i].one_sided = from->mirrors[i].one_sided;
    }
    for (size_t i = 0; i < from->oneway_count; i++)
        SL_TRY(sl_map_add_oneway(context, to, from->oneways[i].segment, from->oneways[i].line));
    for (size_t i = 0; i < from->seam_count; i++)
        SL_TRY(sl_map_add_seam(context, to, from->seams[i].segment, from->seams[i].line));
    return SL_OK;
}

static sl_status copy_cells(sl_context *context, const sl_map *from, sl_map *to) {
    to->snap = from->snap;
    to->snap_line = from->snap_line;
    for (size_t i = 0; i < from->cell_count; i++) {
        const sl_map_cell *cell = &from->cells[i];
        SL_TRY(sl_map_add_cell(context, to, from->corners + cell->first, cell->count, cell->line));
    }
    return SL_OK;
}

static sl_status copy_things(sl_context *context, const sl_map *from, sl_map *to) {
    for (size_t i = 0; i < from->start_count; i++)
        SL_TRY(sl_map_add_start(context, to, from->starts[i].at, from->starts[i].heading,
                                from->starts[i].line));
    for (size_t i = 0; i < from->path_count; i++)
        SL_TRY(sl_map_add_path(context, to, from->paths[i].name, from->paths[i].points,
                               from->paths[i].count, from->paths[i].line));
    for (size_t i = 0; i < from->object_count; i++)
        SL_TRY(sl_map_add_object(context, to, from->objects[i].name, from->objects[i].box,
                                 from->objects[i].line));
    return SL_OK;
}

sl_status sl_map_copy(sl_context *context, const sl_map *from, sl_map *to) {
    sl_map map = {.range = from->range, .range_line = from->range_line};
    sl_status status = copy_walls(context, from, &map);
    if (status == SL_OK) status = copy_effects(context, from, &map);
    if (status == SL_OK) status = copy_cells(context, from, &map);
    if (status == SL_OK) status = copy_things(context, from, &map);
    if (status == SL_OK && from->notes) {
        map.notes = sl_copy_text(context, from->notes, strlen(from->notes));
        if (!map.notes) status = SL_NO_MEMORY;
    }
    if (status == SL_OK && from->source) {
        map.source = sl_copy_text(context, from->source, strlen(from->source));
        if (!map.source) status = SL_NO_MEMORY;
    }
    if (status == SL_OK)
        *to = map;
    else
        sl_map_destroy(context, &map);
    return status;
}

#include "map_copy.h"

#include "base/base.h"

#include <string.h>

static sl_status copy_effects(sl_context *context, const sl_map *from, sl_map *to) {
    for (size_t i = 0; i < from->door_count; i++) {
        const sl_door *d = &from->doors[i];
        SL_TRY(sl_map_add_door(context, to, d->name, d->segment, d->open, d->line));
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
        SL_TRY(sl_map_add_cell(context, to, from->corners + cell->first,
                               from->corner_walls ? from->corner_walls + cell->first : NULL,
                               cell->count, cell->line));
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

sl_status sl_map_set_walls(sl_context *context, sl_map *map, const sl_wall *walls, size_t count) {
    map->wall_count = 0;
    for (size_t i = 0; i < count; i++)
        SL_TRY(sl_map_add_wall(context, map, walls[i].a, walls[i].b, walls[i].line));
    return SL_OK;
}

sl_status sl_map_copy(sl_context *context, const sl_map *from, sl_map *to) {
    sl_map map = {.range = from->range, .range_line = from->range_line};
    sl_status status = sl_map_set_walls(context, &map, from->walls, from->wall_count);
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

static bool same_segment(sl_segment a, sl_segment b) {
    return a.a.x == b.a.x && a.a.y == b.a.y && a.b.x == b.b.x && a.b.y == b.b.y;
}

static bool same_glass(const sl_glass *a, size_t a_count, const sl_glass *b, size_t b_count) {
    bool same = a_count == b_count;
    for (size_t i = 0; i < a_count && same; i++)
        same = same_segment(a[i].segment, b[i].segment) && a[i].one_sided == b[i].one_sided;
    return same;
}

bool sl_map_same_bake(const sl_map *a, const sl_map *b) {
    bool same = a->wall_count == b->wall_count && a->door_count == b->door_count &&
                a->cell_count == b->cell_count && a->range == b->range;
    for (size_t i = 0; i < a->wall_count && same; i++)
        same = same_segment((sl_segment){a->walls[i].a, a->walls[i].b},
                            (sl_segment){b->walls[i].a, b->walls[i].b});
    for (size_t i = 0; i < a->door_count && same; i++)
        same = same_segment(a->doors[i].segment, b->doors[i].segment);
    return same && same_glass(a->mirrors, a->mirror_count, b->mirrors, b->mirror_count) &&
           same_glass(a->oneways, a->oneway_count, b->oneways, b->oneway_count) &&
           same_glass(a->seams, a->seam_count, b->seams, b->seam_count);
}

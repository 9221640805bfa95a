/// Inside and outside, told by reachability.
#include "sightline/support.h"
#include "space/kd_tree.h"

/// Marks all that can be reached through portals from what is marked and on the stack.
static void flood(const sl_space *space, sl_bits *reached, uint32_t *stack, size_t count) {
    while (count) {
        const sl_cell *cell = &space->cells[stack[--count]];
        for (uint32_t i = 0; i < cell->directed_count; i++) {
            const uint32_t next = space->directed[cell->first_directed + i].cell;
            if (sl_bits_has(reached, next)) continue;
            sl_bits_add(reached, next);
            stack[count++] = next;
        }
    }
}

/// Whether some of the map's border that the cell touches is free of walls.
static bool open_to_border(const sl_space *space, const sl_cell *cell, const sl_piece *walls) {
    if (space->neighbour) {
        for (uint32_t i = 0; i < cell->vertex_count; i++)
            if (space->neighbour[cell->first_vertex + i] == SL_NEIGHBOUR_BORDER) return true;
        return false;
    }
    const sl_point min = space->vertices[cell->first_vertex];
    const sl_point max = space->vertices[cell->first_vertex + 2];
    const size_t count = space->wall_count;
    const sl_box *b = &space->bounds;
    return (min.x == b->min.x && !sl_wall_lines_cover(walls, count, 0, min.x, min.y, max.y)) ||
           (max.x == b->max.x && !sl_wall_lines_cover(walls, count, 0, max.x, min.y, max.y)) ||
           (min.y == b->min.y && !sl_wall_lines_cover(walls, count, 1, min.y, min.x, max.x)) ||
           (max.y == b->max.y && !sl_wall_lines_cover(walls, count, 1, max.y, min.x, max.x));
}

static void mark(const sl_map *map, const sl_piece *walls, sl_space *space, sl_bits *reached,
                 uint32_t *stack) {
    size_t count = 0;
    const bool from_starts = map->start_count > 0;
    for (size_t i = 0; i < map->start_count; i++) {
        const uint32_t cell = sl_space_locate(space, map->starts[i].at);
        if (cell == SL_NO_CELL || sl_bits_has(reached, cell)) continue;
        sl_bits_add(reached, cell);
        stack[count++] = cell;
    }
    for (uint32_t i = 0; i < space->cell_count && !from_starts; i++) {
        if (!open_to_border(space, &space->cells[i], walls)) continue;
        sl_bits_add(reached, i);
        stack[count++] = i;
    }
    flood(space, reached, stack, count);
    space->inside_count = 0;
    for (uint32_t i = 0; i < space->cell_count; i++) {
        space->cells[i].inside = sl_bits_has(reached, i) == from_starts;
        space->inside_count += space->cells[i].inside;
    }
    if (space->inside_count) return;
    for (uint32_t i = 0; i < space->cell_count; i++) space->cells[i].inside = 1;
    space->inside_count = space->cell_count;
}

sl_status sl_mark_inside(sl_context *context, const sl_map *map, const sl_piece *walls,
                         sl_space *space) {
    sl_bits *reached = sl_alloc_array(context, sl_bits_words(space->cell_count), sizeof *reached);
    uint32_t *stack = sl_alloc_array(context, space->cell_count, sizeof *stack);
    if (reached && stack) mark(map, walls, space, reached, stack);
    const bool done = reached && stack;
    sl_free(context, reached);
    sl_free(context, stack);
    return done ? SL_OK : SL_NO_MEMORY;
}

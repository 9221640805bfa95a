#include "view_cells/rooms.h"

#include "sightline/outline.h"

#include <math.h>
#include <stdlib.h>

/// Places nearer to a corner than this share of the map's size are there.
#define SNAP 1e-12

void sl_view_rooms_destroy(sl_context *context, sl_view_rooms *rooms) {
    sl_free(context, rooms->corners);
    sl_free(context, rooms->first_corner);
    sl_free(context, rooms->sides);
    sl_free(context, rooms->first_side);
    sl_free(context, rooms->object);
    for (int axis = 0; axis < 2; axis++) sl_free(context, rooms->places[axis]);
    *rooms = (sl_view_rooms){0};
}

static sl_status make_arrays(sl_context *context, size_t count, size_t corners, size_t sides,
                             sl_view_rooms *rooms) {
    rooms->corners = sl_alloc_array(context, corners, sizeof *rooms->corners);
    rooms->first_corner = sl_alloc_array(context, count + 1, sizeof *rooms->first_corner);
    rooms->sides = sl_alloc_array(context, sides, sizeof *rooms->sides);
    rooms->first_side = sl_alloc_array(context, count + 1, sizeof *rooms->first_side);
    rooms->object = sl_alloc_array(context, count, sizeof *rooms->object);
    return rooms->corners && rooms->first_corner && rooms->sides && rooms->first_side &&
                   rooms->object
               ? SL_OK
               : SL_NO_MEMORY;
}

// --- of cells

static void add_cell(const sl_space *space, const uint32_t *number, uint32_t cell,
                     sl_view_rooms *rooms) {
    const sl_cell *c = &space->cells[cell];
    const uint32_t room = rooms->count++;
    uint32_t corner = rooms->first_corner[room], side = rooms->first_side[room];
    for (uint32_t i = 0; i < c->vertex_count; i++)
        rooms->corners[corner++] = space->vertices[c->first_vertex + i];
    for (uint32_t e = c->first_directed; e < c->first_directed + c->directed_count; e++) {
        const sl_directed_portal *directed = &space->directed[e];
        if (number[directed->cell] == SL_NO_ROOM) continue;
        rooms->sides[side++] =
            (sl_room_side){directed->left, directed->right, number[directed->cell], directed->cell};
    }
    rooms->object[room] = cell;
    rooms->first_corner[room + 1] = corner;
    rooms->first_side[room + 1] = side;
}

static sl_status take_cells(sl_context *context, const sl_space *space, sl_view_rooms *rooms) {
    uint32_t *number = sl_alloc_array(context, space->cell_count, sizeof *number);
    if (!number) return SL_NO_MEMORY;
    uint32_t next = 0;
    for (uint32_t i = 0; i < space->cell_count; i++)
        number[i] = space->cells[i].inside ? next++ : SL_NO_ROOM;
    const sl_status status =
        make_arrays(context, next, space->vertex_count, space->directed_count, rooms);
    for (uint32_t i = 0; i < space->cell_count && status == SL_OK; i++)
        if (number[i] != SL_NO_ROOM) add_cell(space, number, i, rooms);
    rooms->object_count = space->cell_count;
    sl_free(context, number);
    return status;
}

// --- of the outline

/// By room of the outline: its number among those inside.
static uint32_t number_rooms(const sl_outline *outline, uint32_t *number) {
    const sl_space *space = outline->space;
    for (uint32_t i = 0; i < outline->room_count; i++) number[i] = SL_NO_ROOM;
    for (uint32_t cell = 0; cell < space->cell_count; cell++) {
        if (!space->cells[cell].inside) continue;
        for (uint32_t k = outline->first_part[cell]; k < outline->first_part[cell + 1]; k++)
            number[outline->parts[k]] = 0;
    }
    uint32_t next = 0;
    for (uint32_t i = 0; i < outline->room_count; i++)
        if (number[i] != SL_NO_ROOM) number[i] = next++;
    return next;
}

static void add_room(const sl_outline *outline, const uint32_t *room_of, const uint32_t *number,
                     uint32_t from, sl_view_rooms *rooms) {
    const uint32_t room = rooms->count++;
    uint32_t corner = rooms->first_corner[room], at = rooms->first_side[room];
    for (uint32_t i = outline->first[from]; i < outline->first[from + 1]; i++) {
        const sl_side *side = &outline->sides[i];
        sl_room_side made = {outline->sides[side->next].start, side->start, SL_NO_ROOM,
                             SL_NO_OBJECT};
        rooms->corners[corner++] = side->start;
        if (sl_side_is_portal(side))
            made.room = number[room_of[side->neighbour]];
        else if (side->neighbour < SL_SIDE_BORDER)
            made.object = side->neighbour - SL_SIDE_WALL;
        if (made.room != SL_NO_ROOM || made.object != SL_NO_OBJECT) rooms->sides[at++] = made;
    }
    rooms->object[room] = SL_NO_OBJECT;
    rooms->first_corner[room + 1] = corner;
    rooms->first_side[room + 1] = at;
}

static sl_status take_rooms(sl_context *context, const sl_outline *outline, sl_view_rooms *rooms) {
    uint32_t *room_of = sl_alloc_array(context, outline->side_count, sizeof *room_of);
    uint32_t *number = sl_alloc_array(context, outline->room_count, sizeof *number);
    sl_status status = room_of && number ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK)
        status = make_arrays(context, number_rooms(outline, number), outline->side_count,
                             outline->side_count, rooms);
    if (status == SL_OK) {
        for (uint32_t i = 0; i < outline->room_count; i++)
            for (uint32_t k = outline->first[i]; k < outline->first[i + 1]; k++) room_of[k] = i;
        for (uint32_t i = 0; i < outline->room_count; i++)
            if (number[i] != SL_NO_ROOM) add_room(outline, room_of, number, i, rooms);
    }
    rooms->object_count = outline->space->wall_count;
    sl_free(context, room_of);
    sl_free(context, number);
    return status;
}

// --- places of corners

static int compare_places(const void *left, const void *right) {
    const double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

static sl_status find_places(sl_context *context, sl_view_rooms *rooms) {
    const uint32_t count = rooms->first_corner[rooms->count];
    for (int axis = 0; axis < 2; axis++) {
        double *places = sl_alloc_array(context, count, sizeof *places);
        if (!places) return SL_NO_MEMORY;
        rooms->places[axis] = places;
        for (uint32_t i = 0; i < count; i++)
            places[i] = axis ? rooms->corners[i].y : rooms->corners[i].x;
        if (count) qsort(places, count, sizeof *places, compare_places);
        uint32_t kept = 0;
        for (uint32_t i = 0; i < count; i++)
            if (!kept || places[i] != places[kept - 1]) places[kept++] = places[i];
        rooms->place_counts[axis] = kept;
    }
    return SL_OK;
}

double sl_view_rooms_snap(const sl_view_rooms *rooms, int axis, double place) {
    const double *places = rooms->places[axis];
    const sl_box *b = &rooms->bounds;
    const double size = axis ? b->max.y - b->min.y : b->max.x - b->min.x;
    uint32_t low = 0, high = rooms->place_counts[axis];
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (places[middle] < place)
            low = middle + 1;
        else
            high = middle;
    }
    if (low < rooms->place_counts[axis] && places[low] - place <= SNAP * size) return places[low];
    if (low && place - places[low - 1] <= SNAP * size) return places[low - 1];
    return place;
}

sl_status sl_view_rooms_make(sl_context *context, const sl_space *space, sl_view_objects objects,
                             sl_view_rooms *out) {
    sl_view_rooms made = {.bounds = space->bounds};
    sl_status status;
    if (objects == SL_VIEW_CELLS) {
        status = take_cells(context, space, &made);
    } else {
        sl_outline outline = {0};
        status = sl_outline_make(context, space, &outline);
        if (status == SL_OK) status = take_rooms(context, &outline, &made);
        sl_outline_destroy(context, &outline);
    }
    if (status == SL_OK) status = find_places(context, &made);
    if (status == SL_OK)
        *out = made;
    else
        sl_view_rooms_destroy(context, &made);
    return status;
}

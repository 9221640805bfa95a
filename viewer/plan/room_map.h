/// The rooms of the plan, and zones that are drawn over it: their names, how much of each is seen
/// from the viewpoint, and the mean of the heat map in each.
#ifndef VIEWER_ROOM_MAP_H
#define VIEWER_ROOM_MAP_H

#include "document/drawings.h"
#include "plan/tool_job.h"
#include "sightline/rooms.h"

struct room_map {
    tool_job job;
    sl_map map; ///< a copy for the work
    sl_rooms rooms;
    named_places names; ///< that were typed, each for the room about its place
    named_places zones; ///< their rows are behind those of the rooms
    uint32_t opened;    ///< document->opened that names and zones are of
    double *seen;       ///< by row: the area that is seen
    double *means;      ///< by row: of the heat map's points in it; NAN: none
    uint32_t *points;   ///< by row: how many these are
    sl_view view;       ///< that `seen` is of; these three too
    uint32_t seen_version, heat_stamp, zone_stamp;
    bool measured;
    bool drags; ///< a zone is dragged: the last one
};

/// Finds the rooms where the tool is at hand.
void room_map_update(view_state *view, bool wait);
/// Follows the viewpoint and the heat map, once they are those of the frame.
void room_map_follow(view_state *view);
/// NULL: the tool is not at hand, or the rooms are not there yet.
const room_map *room_map_shown(const view_state *view);
/// The name of the room of a place, where rooms are known; else NULL.
const char *room_map_room(const view_state *view, sl_point at);
/// Stops the work; false if none runs.
bool room_map_stop(view_state *view);
job_progress room_map_progress(const view_state *view);
void room_map_destroy(sl_context *context, room_map *map); ///< NULL: nothing

size_t room_map_rows(const room_map *map);
const char *room_map_name(const room_map *map, size_t row);
double room_map_area(const room_map *map, size_t row);
sl_point room_map_place(const room_map *map, size_t row);
sl_box room_map_box(const room_map *map, size_t row);
/// The colour of a room.
sl_colour room_map_tint(const sl_palette *palette, size_t room);
/// Whether a row is a zone.
bool room_map_is_zone(const room_map *map, size_t row);
/// The row of a place: the smallest zone about it, else its room; SIZE_MAX: none.
size_t room_map_at(const room_map *map, sl_point at);

/// Names a row; "" gives a room the name that it had by itself.
void room_map_rename(view_state *view, size_t row, const char *name);
/// Begins a zone; its other corner follows. One of no area is dropped.
void room_map_begin_zone(view_state *view, sl_point at);
void room_map_drag_zone(view_state *view, sl_point to);
void room_map_drop_zone(view_state *view);
/// Deletes a zone; a room stays.
void room_map_delete(view_state *view, size_t row);

void room_map_draw(const view_state *view, const sl_frame *frame);

#endif

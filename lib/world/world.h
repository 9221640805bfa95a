/// What a world is made of.
#ifndef SL_WORLD_SCENE_H
#define SL_WORLD_SCENE_H

#include "sightline/world.h"
#include "world/live.h"
#include "world/world_rows.h"

/// A wall of the world. Its chain is the points of the triangulation that it leads through.
typedef struct sli_world_line {
    sl_segment at, next_at;     ///< now, and after the commit
    bool there, next_there;     ///< likewise: there is one of this number
    bool open, next_open;       ///< likewise, of a door
    bool stands, next_stands;   ///< likewise: it is in the mesh
    uint8_t kind;               ///< of sl_world_kind
    uint8_t stops;              ///< of sl_glass, for one that does not stop all
    bool one_sided;             ///< of a mirror
    bool listed;                ///< it is in `special`
    char *name;                 ///< of a door; else NULL
    bool pending;               ///< it has edits
    uint32_t file_line, ground; ///< of sl_wall
    uint32_t first, count;      ///< of the chain, in `points`; count 0 for none
    uint32_t mark;              ///< the edit that looked at it
    uint32_t next_free;         ///< 1 + the next free number
} sli_world_line;

/// A wall that an edge is part of, and the next one. Lists are never changed while an edit may
/// fail: it makes new ones.
typedef struct sli_world_use {
    uint32_t line, from; ///< from: the point where the wall enters the edge
    uint32_t next;       ///< 1 + its place; 0 for none
} sli_world_use;

struct sl_world {
    sl_context *context;
    sl_map map; ///< the query's: without walls
    sl_query *query;
    sli_live live;
    sl_world_rows mode;
    sli_world_rows rows;
    SL_ARRAY(sli_world_line) lines;
    uint32_t free_line;
    sli_numbers pending; ///< lines with edits

    uint32_t *points; ///< of all chains
    size_t point_room;
    sli_blocks point_blocks;

    SL_ARRAY(sli_world_use) uses;
    uint32_t free_use;
    sli_numbers fresh, stale; ///< uses of this edit, and those that it replaces

    // The edit.
    uint32_t now;
    sli_numbers involved;          ///< lines
    SL_ARRAY(sl_segment) segments; ///< of those that will stand, in their order
    SL_ARRAY(sl_point) corners;    ///< of their new chains
    sli_numbers first_corner;      ///< by line involved, and one more
    sli_numbers chain;             ///< new chains, as points
    sli_numbers doubtful;          ///< points that no wall may need any more
    uint32_t *wanted;              ///< by point: the edit that needs it
    size_t wanted_room;
    sli_numbers flood;           ///< triangles that a segment meets
    SL_ARRAY(sl_segment) opened; ///< where walls go
    bool only_opens;             ///< the edit takes walls away and does nothing else

    sli_numbers special;      ///< lines that the query must know (special.c)
    sli_numbers mirror_walls; ///< by mirror of the map: the line
    bool has_seams;           ///< some of them are seams of the space, before or after the edit
};

/// Whether a line is a seam of the space: glass, or a limited wall.
static inline bool sli_world_is_seam(const sli_world_line *line) {
    return line->kind == SL_WORLD_ONEWAY || line->stops & SL_STOPS_LIMITED;
}

/// Whether the query must know of a line.
static inline bool sli_world_is_special(const sli_world_line *line) {
    return line->kind == SL_WORLD_MIRROR || sli_world_is_seam(line);
}

/// Makes room in `special`, then in what the query knows, before an edit; the lines of its chains
/// are known then.
sl_status sli_world_prepare_special(sl_world *world);
/// Gives the space its seams, and the query's map its glass, limited walls and mirrors.
void sli_world_follow_special(sl_world *world);

/// Takes the walls of a map, of all kinds.
sl_status sli_world_take(sl_world *world, const sl_map *map, const sl_box *bounds);
/// Ends the edits that waited: what will be there is what is there. Numbers without a wall are
/// free.
void sli_world_end_edits(sl_world *world);
/// Finds the lines that an edit has to do with, and their new chains.
sl_status sli_world_involve(sl_world *world);
/// Finds where walls go, and whether that is all that the edit does.
sl_status sli_world_find_opened(sl_world *world);
/// Edits the triangulation accordingly.
sl_status sli_world_edit(sl_world *world);
/// Takes the new chains over; nothing can fail any more.
void sli_world_settle_chains(sl_world *world);
void sli_world_drop_uses(sl_world *world);

/// What an edge with a label is (sli_live_label).
sli_live_edge sli_world_edge(void *world, uint32_t label);
/// The seams on it (sli_live_seams).
bool sli_world_seams(void *world, uint32_t label, uint32_t k, sli_live_seam *out);

#endif

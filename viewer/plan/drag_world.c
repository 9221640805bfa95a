/// The world is made of the clean map without what is held, in the background, when the first step
/// of a drag comes. What is held is then added to it, and moved from step to step: that costs the
/// cells around it alone. The document stays as it is until the drag ends, and is baked then.
///
/// So three things follow in each frame: what is held, what the eye sees, and what stands beside
/// it. Cells, portals and what depends on their numbers are those from before the drag.
#include "plan/drag_world.h"

#include "document/task.h"
#include "draw/draw_plan.h" // private: the width of lines
#include "sightline/world.h"

#include <string.h>

/// A wall, a door, glass or a seam that is held. A mirror that is held is for a bake.
typedef struct held_line {
    held_kind kind;
    bool open;       ///< a door
    uint32_t stops;  ///< of a seam
    size_t index;    ///< in the document's map, by its kind
    uint32_t number; ///< in the world; UINT32_MAX: it is not there yet
    sl_segment at;
} held_line;

struct drag_world {
    task *task; ///< that makes the world; NULL: it is made
    double weld;
    sl_box bounds;
    sl_baked still; ///< walls and map without what is held: all that is drawn of it
    sl_world *world;
    sl_scene *walls; ///< of them; NULL: none yet
    SL_ARRAY(held_line) held;
    uint32_t version, touched; ///< of the document
};

static sl_status make_world(sl_context *context, void *data) {
    drag_world *d = data;
    sl_map *map = &d->still.map;
    const sl_clean_options clean = {.weld = d->weld};
    sl_world_options options = sl_world_options_default();
    options.bounds = d->bounds;
    SL_TRY(sl_map_clean(context, map, &clean, NULL));
    return sl_world_create(context, map, &options, &d->world);
}

void drag_world_drop(view_state *view) {
    drag_world *d = view->drag_world;
    if (!d) return;
    task_drop(view->context, d->task);
    sl_scene_destroy(view->context, d->walls);
    sl_world_destroy(view->context, d->world);
    d->still.space = (sl_space){0}; // the map's
    sl_map_destroy(view->context, &d->still.map);
    sl_free(view->context, d->held.items);
    sl_free(view->context, d);
    view->drag_world = NULL;
    view->seen.valid = false;
}

// --- what is held

/// Whether a map can be dragged in by a world.
static bool serves(const view_state *view) {
    const document_state *document = view->document;
    const sl_map *map = &document->map;
    if (!document->baked || map->wall_count < view->world_walls || document->solid) return false;
    for (size_t i = 0; i < document->object_count; i++)
        if (document->blocks[i]) return false;
    if (view->drag.kind == DRAG_MIRROR) return false;
    for (size_t i = 0; i < view->edit.ends.count; i++)
        if (view->edit.ends.items[i].kind == HELD_MIRROR) return false;
    return !map->cell_count;
}

static bool holds(const drag_world *d, held_kind kind, size_t index) {
    for (size_t i = 0; i < d->held.count; i++)
        if (d->held.items[i].kind == kind && d->held.items[i].index == index) return true;
    return false;
}

static sl_status take_held(view_state *view, drag_world *d) {
    for (size_t i = 0; i < view->edit.ends.count; i++) {
        const held_end *end = &view->edit.ends.items[i];
        if (holds(d, end->kind, end->index)) continue;
        SL_TRY(SL_ARRAY_ROOM(view->context, &d->held, 1));
        d->held.items[d->held.count++] =
            (held_line){.kind = end->kind, .index = end->index, .number = UINT32_MAX};
    }
    return SL_OK;
}

static size_t leave_glass_out(const drag_world *d, held_kind kind, sl_glass *glass, size_t count) {
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (!holds(d, kind, i)) glass[kept++] = glass[i];
    return kept;
}

/// Takes what is held out of a copy of the map. From the last one on, as others take their places.
static void leave_held_out(sl_context *context, const drag_world *d, sl_map *map) {
    size_t walls = 0, doors = 0;
    for (size_t i = 0; i < map->wall_count; i++)
        if (!holds(d, HELD_WALL, i)) map->walls[walls++] = map->walls[i];
    for (size_t i = 0; i < map->door_count; i++) {
        if (!holds(d, HELD_DOOR, i)) {
            map->doors[doors++] = map->doors[i];
            continue;
        }
        sl_free(context, map->doors[i].name);
        sl_free(context, map->doors[i].parts);
    }
    map->wall_count = walls;
    map->door_count = doors;
    map->oneway_count = leave_glass_out(d, HELD_ONEWAY, map->oneways, map->oneway_count);
    map->seam_count = leave_glass_out(d, HELD_SEAM, map->seams, map->seam_count);
}

/// Takes what the map has of a wall, a door or glass now. False where it has it no longer.
static bool take_line(const sl_map *map, held_line *h) {
    const sl_glass *glass = h->kind == HELD_ONEWAY ? map->oneways : map->seams;
    const size_t counts[HELD_KINDS] = {map->wall_count, map->door_count, map->mirror_count,
                                       map->oneway_count, map->seam_count};
    if (h->index >= counts[h->kind]) return false;
    if (h->kind == HELD_WALL) {
        h->at = (sl_segment){map->walls[h->index].a, map->walls[h->index].b};
    } else if (h->kind == HELD_DOOR) {
        h->at = map->doors[h->index].segment;
        h->open = map->doors[h->index].open;
    } else {
        h->at = glass[h->index].segment;
        h->stops = glass[h->index].stops;
    }
    return true;
}

/// Where the map has them now. False where one has no place in it.
static bool follow_map(const view_state *view, drag_world *d) {
    for (size_t i = 0; i < d->held.count; i++)
        if (!take_line(&view->document->map, &d->held.items[i])) return false;
    return true;
}

static sl_status add_held(sl_context *context, sl_world *world, held_line *h) {
    switch (h->kind) {
    case HELD_DOOR:
        return sl_world_add_door(context, world, "held", h->at, h->open, &h->number);
    case HELD_ONEWAY:
        return sl_world_add_oneway(context, world, h->at, &h->number);
    case HELD_SEAM:
        return sl_world_add_partial(context, world, h->at, h->stops, &h->number);
    default:
        return sl_world_add_wall(context, world, h->at, &h->number);
    }
}

static sl_status move_held(sl_context *context, drag_world *d) {
    sl_status status = SL_OK;
    for (size_t i = 0; i < d->held.count && status == SL_OK; i++) {
        held_line *h = &d->held.items[i];
        status = h->number == UINT32_MAX ? add_held(context, d->world, h)
                                         : sl_world_move(context, d->world, h->number, h->at);
    }
    if (status == SL_OK) return sl_world_commit(context, d->world, NULL);
    sl_world_discard(d->world);
    return status;
}

// --- the drag

static sl_status start(view_state *view) {
    const document_state *document = view->document;
    drag_world *d = sl_alloc_array(view->context, 1, sizeof *d);
    if (!d) return SL_NO_MEMORY;
    view->drag_world = d;
    d->weld = document->weld;
    d->version = document->version;
    d->touched = document->touched;
    view->drag_worlds++;
    const sl_box b = document->baked->space.bounds;
    const double wide = (b.max.x - b.min.x) / 8, high = (b.max.y - b.min.y) / 8;
    d->bounds = (sl_box){{b.min.x - wide, b.min.y - high}, {b.max.x + wide, b.max.y + high}};
    SL_TRY(take_held(view, d));
    SL_TRY(sl_map_copy(view->context, &document->map, &d->still.map));
    leave_held_out(view->context, d, &d->still.map);
    return task_start(view->context, make_world, d, "world", NULL, &d->task);
}

/// From now on until the drag ends, cells are made anew.
static void give_up(view_state *view) {
    drag_world_drop(view);
    view->edit.bakes = true;
    if (view->drag.changed && view->edit.ends.count) view_after_step(view);
}

/// What a world refuses, a bake may take.
static void move(view_state *view) {
    view->seen.valid = false;
    if (move_held(view->context, view->drag_world) != SL_OK) give_up(view);
}

bool drag_world_step(view_state *view) {
    if (view->edit.bakes) return false;
    if (!view->drag_world && (!serves(view) || start(view) != SL_OK)) {
        drag_world_drop(view);
        return false;
    }
    if (!follow_map(view, view->drag_world)) return false;
    if (!view->drag_world->task) move(view);
    return true;
}

void drag_world_update(view_state *view, bool wait) {
    drag_world *d = view->drag_world;
    if (!d) return;
    if (view->document->version != d->version) {
        drag_world_drop(view);
        return;
    }
    if (view->document->touched != d->touched) { // a door, or the range
        give_up(view);
        return;
    }
    if (!d->task || !(wait || task_done(d->task))) return;
    const sl_status status = task_end(view->context, d->task);
    d->task = NULL;
    if (status != SL_OK) {
        give_up(view);
        return;
    }
    d->still.space = (sl_space){.walls = d->still.map.walls,
                                .wall_count = (uint32_t)d->still.map.wall_count,
                                .bounds = view->document->baked->space.bounds};
    move(view);
}

sl_query *drag_world_query(const view_state *view) {
    const drag_world *d = view->drag_world;
    return d && !d->task ? sl_world_query(d->world) : NULL;
}

bool drag_world_is_late(const view_state *view) {
    return view->drag_world && view->drag_world->task;
}

// --- what is drawn

const sl_scene *drag_world_walls(view_state *view, const sl_scene *like) {
    drag_world *d = view->drag_world;
    if (!d || d->task) return NULL;
    if (d->walls && d->walls->options.layers == like->options.layers &&
        d->walls->options.dark == like->options.dark)
        return d->walls;
    sl_scene_destroy(view->context, d->walls);
    d->walls = NULL;
    view_check(view, sl_scene_create(view->context, &d->still, &like->options, NULL, &d->walls));
    if (d->walls) d->walls->cell_size = like->cell_size; // lines as wide as in the plan
    return d->walls;
}

void drag_world_draw(const view_state *view, const sl_frame *frame) {
    const drag_world *d = view->drag_world;
    for (size_t i = 0; d && i < d->held.count; i++)
        sl_draw_line(view->ui->cairo, frame, d->held.items[i].at.a, d->held.items[i].at.b,
                     view->ui->palette.start, 4 * frame->unit);
}

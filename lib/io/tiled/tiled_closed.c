/// The insides of closed objects. A rectangle, an ellipse or a polygon that is solid is a body in
/// the games that read Tiled's maps: nobody stands in it. So its inside is solid ground.
///
/// Some are drawn round a room in place of its walls, and stay outlines:
///
/// - one that a start lies in, or that a door lies over,
/// - one that covers more than half of the map,
/// - a polygon or an ellipse that another one lies in, and a rectangle that most others lie in.
///
/// Shapes of tiles are outlines only where a start or a door lies over them. A polygon whose sides
/// cross each other has no inside that all agree on: an outline too.
#include "geometry/orient.h"
#include "io/tiled/tiled.h"
#include "space/index.h"

#include <math.h>

/// What may say that an object is an outline: boxes of starts and doors, and of closed objects.
/// `found` has what lies about the one at hand.
typedef struct about {
    sl_box *boxes;
    size_t *numbers; ///< by box: of the thing, or of the closed object
    sli_box_tree things, objects;
    sli_box_list found;
} about;

sl_status sli_tiled_add_closed(sli_tiled_reader *reader, sli_tiled_kind kind, size_t first,
                               bool of_tile) {
    const size_t count = reader->pen.map->wall_count - first;
    if (kind == SLI_TILED_POLYLINE || kind == SLI_TILED_OTHER || count < 3) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(reader->context, &reader->closed, 1));
    sli_tiled_closed *own = &reader->closed.items[reader->closed.count++];
    const sl_wall *walls = reader->pen.map->walls + first;
    *own = (sli_tiled_closed){.first = first, .count = count, .kind = kind, .of_tile = of_tile};
    reader->closed_objects += !of_tile;
    own->box = (sl_box){walls[0].a, walls[0].a};
    for (size_t i = 1; i < count; i++) own->box = sli_box_with(own->box, walls[i].a);
    return SL_OK;
}

/// A ray to the right crosses its sides an odd number of times.
bool sli_tiled_is_in(const sli_tiled_reader *reader, const sli_tiled_closed *closed, sl_point at) {
    const sl_wall *walls = reader->pen.map->walls + closed->first;
    bool in = false;
    if (!sli_box_holds(&closed->box, at)) return false;
    for (size_t i = 0; i < closed->count; i++) {
        const bool up = walls[i].b.y > at.y;
        if (up == (walls[i].a.y > at.y)) continue;
        const int side = sli_orient(walls[i].a, walls[i].b, at);
        in ^= up ? side > 0 : side < 0;
    }
    return in;
}

sl_box sli_tiled_box_of_thing(const sli_tiled_reader *reader, const sli_thing *thing,
                              sl_point *at) {
    const double x = fabs(thing->u.x) + fabs(thing->v.x);
    const double y = fabs(thing->u.y) + fabs(thing->v.y);
    *at = (sl_point){thing->middle.x, reader->top - thing->middle.y};
    return (sl_box){{at->x - x, at->y - y}, {at->x + x, at->y + y}};
}

/// Whether a start lies in it, or a door lies over it.
static sl_status has_thing(const sli_tiled_reader *reader, about *a, const sli_tiled_closed *closed,
                           bool *has) {
    const sl_box *box = &closed->box;
    SL_TRY(sli_box_tree_find(reader->context, &a->things, box, &a->found));
    *has = false;
    for (size_t i = 0; i < a->found.count && !*has; i++) {
        const sli_thing *thing = &reader->things.items.items[a->found.items[i]];
        sl_point at;
        const sl_box own = sli_tiled_box_of_thing(reader, thing, &at);
        const bool over = own.max.x > box->min.x && own.min.x < box->max.x &&
                          own.max.y > box->min.y && own.min.y < box->max.y;
        *has = over && (thing->kind == SLI_THING_DOOR || sli_tiled_is_in(reader, closed, at));
    }
    return SL_OK;
}

/// How many others lie in it with all of their boxes and their first corners. Of more than so many
/// it is not asked.
static sl_status count_in(const sli_tiled_reader *reader, about *a, const sli_tiled_closed *closed,
                          size_t *count) {
    enum { MOST = 4096 };
    const sl_box *all = &closed->box;
    *count = 0;
    if (reader->closed_objects > MOST) return SL_OK;
    SL_TRY(sli_box_tree_find(reader->context, &a->objects, all, &a->found));
    for (size_t i = 0; i < a->found.count; i++) {
        const sli_tiled_closed *other = &reader->closed.items[a->numbers[a->found.items[i]]];
        const sl_box *own = &other->box;
        const bool within = own->min.x > all->min.x && own->min.y > all->min.y &&
                            own->max.x < all->max.x && own->max.y < all->max.y;
        *count += within && sli_tiled_is_in(reader, closed, reader->pen.map->walls[other->first].a);
    }
    return SL_OK;
}

static sl_status find_outline(const sli_tiled_reader *reader, about *a,
                              const sli_tiled_closed *closed, bool *outline) {
    const bool drawn = closed->kind == SLI_TILED_POLYGON || closed->kind == SLI_TILED_ELLIPSE;
    const sl_box *page = &reader->pen.map->source.page, *own = &closed->box;
    const double all = (page->max.x - page->min.x) * (page->max.y - page->min.y);
    size_t count;
    *outline = !closed->of_tile && all > 0 &&
               2 * (own->max.x - own->min.x) * (own->max.y - own->min.y) > all;
    if (!*outline) SL_TRY(has_thing(reader, a, closed, outline));
    if (*outline || closed->of_tile) return SL_OK;
    SL_TRY(count_in(reader, a, closed, &count));
    *outline = drawn ? count > 0 : 2 * count > reader->closed_objects - 1;
    return SL_OK;
}

/// Marks the ground at the sides of a closed object.
static sl_status fill(sli_tiled_reader *reader, sli_tiled_closed *closed) {
    sl_map polygon = {0};
    sl_wall *walls = reader->pen.map->walls + closed->first;
    sl_point *corners = sl_alloc_array(reader->context, closed->count, sizeof *corners);
    if (!corners) return SL_NO_MEMORY;
    for (size_t i = 0; i < closed->count; i++) corners[i] = walls[i].a;
    const sl_status status = sl_map_add_solid(reader->context, &polygon, corners, closed->count, 0);
    closed->solid = status == SL_OK;
    reader->solid_closed += closed->solid;
    for (size_t i = 0; i < polygon.wall_count && closed->solid; i++)
        walls[i].ground = polygon.walls[i].ground;
    sl_map_destroy(reader->context, &polygon);
    sl_free(reader->context, corners);
    return status == SL_BAD_INPUT ? SL_OK : status;
}

/// Where a map has no tiles, its squares are open, and what is beyond it is solid: else nothing
/// ends the ground about its objects.
static sl_status add_page(sli_tiled_reader *reader) {
    const sl_box *page = &reader->pen.map->source.page;
    const sl_point size = {page->max.x - page->min.x, page->max.y - page->min.y};
    const sli_json infinite = sli_json_member(reader->map, "infinite");
    const sl_box all = sl_map_bounds(reader->pen.map);
    const sl_point corner = {page->min.x, reader->top - page->max.y};
    char *squares;
    if (!reader->solid_closed || reader->tiles.blocks.count || sli_json_true(&infinite, NULL))
        return SL_OK;
    if (!(size.x > 0 && size.y > 0) || all.min.x < page->min.x || all.min.y < page->min.y ||
        all.max.x > page->max.x || all.max.y > page->max.y)
        return SL_OK;
    return sli_tiles_add(reader->context, &reader->tiles, reader->map->file->name, corner, size, 1,
                         1, &squares);
}

/// Puts the boxes into trees: there may be a million shapes of tiles, and thousands of doors.
static sl_status look_about(const sli_tiled_reader *reader, about *a) {
    const size_t things = reader->things.items.count, objects = reader->closed_objects;
    size_t count = 0;
    sl_point at;
    a->boxes = sl_alloc_array(reader->context, things + objects, sizeof *a->boxes);
    a->numbers = sl_alloc_array(reader->context, objects, sizeof *a->numbers);
    if (!a->boxes || !a->numbers) return SL_NO_MEMORY;
    for (size_t i = 0; i < reader->closed.count; i++) {
        if (reader->closed.items[i].of_tile) continue;
        a->numbers[count] = i;
        a->boxes[count++] = reader->closed.items[i].box;
    }
    for (size_t i = 0; i < things; i++)
        a->boxes[count + i] = sli_tiled_box_of_thing(reader, &reader->things.items.items[i], &at);
    SL_TRY(sli_box_tree_create(reader->context, a->boxes, count, &a->objects));
    return sli_box_tree_create(reader->context, a->boxes + count, things, &a->things);
}

/// Fills what is no outline. *outlines: the objects that are.
static sl_status fill_all(sli_tiled_reader *reader, about *a, size_t *outlines) {
    SL_TRY(look_about(reader, a));
    for (size_t i = 0; i < reader->closed.count; i++) {
        sli_tiled_closed *closed = &reader->closed.items[i];
        bool outline;
        if (i % 256 == 0) SL_TRY(sl_check_cancelled(reader->context));
        SL_TRY(find_outline(reader, a, closed, &outline));
        if (!outline) SL_TRY(fill(reader, closed));
        *outlines += !closed->solid && !closed->of_tile;
    }
    return SL_OK;
}

sl_status sli_tiled_settle_closed(sli_tiled_reader *reader) {
    size_t outlines = 0;
    about a = {0};
    const sl_status status = fill_all(reader, &a, &outlines);
    sli_box_tree_destroy(reader->context, &a.things);
    sli_box_tree_destroy(reader->context, &a.objects);
    sl_free(reader->context, a.found.items);
    sl_free(reader->context, a.numbers);
    sl_free(reader->context, a.boxes);
    SL_TRY(status);
    if (outlines)
        sl_note(reader->context,
                "%s: %zu closed object%s an outline, not solid inside: a start or other objects "
                "lie in it, a door lies over it, or it is larger than half of the map",
                reader->map->file->name, outlines, outlines == 1 ? " is" : "s are each");
    return add_page(reader);
}

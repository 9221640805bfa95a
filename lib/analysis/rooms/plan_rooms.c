/// Rooms: the free ground, cut where a disc as wide as a door gets stuck.
///
/// Walls, doors and channels (space/channels.h) cut the ground into triangles. Triangles whose
/// common side is neither a wall nor a channel that stops the disc are in one *part*. A part is a
/// room if it is inside and roomier than its openings:
///
///     +-----------+------+
///     |     A     c   B  |     c: a channel, the door from A to B.
///     |           +--d---+     The doorway between the channels d and e of a thick wall
///     |           +--e---+     is a part, too. It is smaller than the square over d,
///     |              C   |     so it is no room.
///     +------------------+
///
/// The width of doors, where nobody says it, is that of the usual opening: places are joined, the
/// widest channel first (Kruskal 1956), and a channel that joins two places roomier than itself is
/// an opening.
#include "sightline/rooms.h"

#include "geometry/length.h"
#include "geometry/orient.h"
#include "map/source.h"
#include "map/unit.h"
#include "space/clearance.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// Doors in metres, with their frames.
#define DOOR 1.1
/// How much wider doors are than the usual opening.
#define WIDER 1.25
/// How much roomier than its opening a place is that the opening leads to.
#define ROOMIER (4.0 / 3)
/// How much less roomy than the roomiest part rooms are, where no opening counts as a door.
#define LEAST (1.0 / 16)

/// What is joined so far, by its root: a half-edge.
typedef struct part {
    double area, clearance, opening;
    sl_point place;
} part;

typedef struct finder {
    sl_context *context;
    sli_channels channels;
    sli_clearance clearance;
    uint32_t *parent; ///< by half-edge
    part *parts;      ///< by half-edge; of roots: what is joined
} finder;

static const sli_half_edge *half_of(const finder *f, uint32_t half) {
    return &f->channels.triangles.halves.items[half];
}

static sl_point start_of(const finder *f, uint32_t half) {
    return f->channels.triangles.points.items[half_of(f, half)->from];
}

/// The half-edges of a triangle, from its lowest one; false for the others, and beyond the box.
static bool is_triangle(const finder *f, uint32_t half, uint32_t halves[3]) {
    if (sli_half_is_outside(&f->channels.triangles, half)) return false;
    halves[0] = half;
    halves[1] = half_of(f, half)->next;
    halves[2] = half_of(f, halves[1])->next;
    return half < halves[1] && half < halves[2];
}

static double area_of(const finder *f, const uint32_t halves[3]) {
    const sl_point a = start_of(f, halves[0]), b = start_of(f, halves[1]);
    const sl_point c = start_of(f, halves[2]);
    return sli_cross((sl_point){b.x - a.x, b.y - a.y}, (sl_point){c.x - a.x, c.y - a.y}) / 2;
}

static void join(finder *f, uint32_t a, uint32_t b) {
    const uint32_t into = sl_root_of(f->parent, a), other = sl_root_of(f->parent, b);
    part *to = &f->parts[into];
    const part *from = &f->parts[other];
    if (into == other) return;
    f->parent[other] = into;
    to->area += from->area;
    if (from->clearance <= to->clearance) return;
    to->clearance = from->clearance;
    to->place = from->place;
}

/// Makes parts of the triangles: each is one, and so is all that is beyond the box.
static sl_status begin_parts(finder *f) {
    const size_t count = f->channels.triangles.halves.count;
    uint32_t halves[3];
    f->parent = sl_alloc_array(f->context, count, sizeof *f->parent);
    f->parts = sl_alloc_array(f->context, count, sizeof *f->parts);
    if (!f->parent || !f->parts) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++) {
        f->parent[i] = i;
        f->parts[i].clearance = sli_half_is_outside(&f->channels.triangles, i) ? INFINITY : -1;
    }
    for (uint32_t i = 0; i < count; i++) {
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(f->context));
        if (!is_triangle(f, i, halves)) continue;
        part *own = &f->parts[i];
        own->area = area_of(f, halves);
        SL_TRY(sli_clearance_of(&f->clearance, i, -1, &own->place, &own->clearance));
        join(f, i, halves[1]);
        join(f, i, halves[2]);
    }
    for (uint32_t i = 0; i < count; i += 2)
        if (f->channels.label[i / 2] == SLI_FREE) join(f, i, i + 1);
    return SL_OK;
}

static sl_status begin(finder *f, const sl_map *map, double most) {
    SL_TRY(sli_channels_make(f->context, map, most, &f->channels));
    SL_TRY(sli_clearance_make(f->context, &f->channels, &f->clearance));
    return begin_parts(f);
}

static void end(finder *f) {
    sli_clearance_destroy(&f->clearance);
    sli_channels_destroy(f->context, &f->channels);
    sl_free(f->context, f->parent);
    sl_free(f->context, f->parts);
}

// --- the width of doors

/// A side that is a channel, and how wide it is.
typedef struct crossing {
    double width;
    uint32_t half;
} crossing;

static int compare_crossings(const void *left, const void *right) {
    const crossing *a = left, *b = right;
    if (a->width != b->width) return a->width > b->width ? -1 : 1;
    return (a->half > b->half) - (a->half < b->half);
}

static bool is_place(const finder *f, uint32_t half, double width) {
    const part *p = &f->parts[sl_root_of(f->parent, half)];
    return 2 * p->clearance >= ROOMIER * width;
}

/// The median of the openings, of which there are none up to `slit`; 0 for none.
static sl_status usual_opening(finder *f, double slit, double *out) {
    const size_t edges = f->channels.triangles.halves.count / 2;
    crossing *items = sl_alloc_array(f->context, edges, sizeof *items);
    size_t count = 0, openings = 0;
    *out = 0;
    if (!items) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < edges; i++)
        if (f->channels.label[i] < SLI_WALL)
            items[count++] = (crossing){f->channels.items.items[f->channels.label[i]].width, 2 * i};
    if (count) qsort(items, count, sizeof *items, compare_crossings);
    for (size_t i = 0; i < count; i++) {
        const crossing each = items[i];
        const bool opens =
            sl_root_of(f->parent, each.half) != sl_root_of(f->parent, each.half + 1) &&
            is_place(f, each.half, each.width) && is_place(f, each.half + 1, each.width);
        if (opens && each.width > slit) items[openings++] = each;
        join(f, each.half, each.half + 1);
    }
    if (openings) *out = items[openings / 2].width;
    sl_free(f->context, items);
    return SL_OK;
}

/// The width of doors by the openings of the map; 0 where it has none.
static sl_status find_width(sl_context *context, const sl_map *map, double *out) {
    const sl_box b = sl_map_bounds(map);
    const double size = fmax(b.max.x - b.min.x, b.max.y - b.min.y);
    finder f = {.context = context};
    sl_status status = begin(&f, map, size / 3);
    if (status == SL_OK) status = usual_opening(&f, size / 1000, out);
    *out *= WIDER;
    end(&f);
    return status;
}

// --- rooms

/// Joins all that the disc passes to, and notes the openings of what it does not.
static void join_parts(finder *f, double width) {
    const size_t edges = f->channels.triangles.halves.count / 2;
    for (int pass = 0; pass < 2; pass++)
        for (uint32_t i = 0; i < edges; i++) {
            const uint32_t label = f->channels.label[i];
            if (label >= SLI_WALL) continue;
            const sli_channel *channel = &f->channels.items.items[label];
            const bool stops = sli_channel_stops(channel, width);
            if (!stops && pass == 0) join(f, 2 * i, 2 * i + 1);
            for (uint32_t k = 0; k < 2 && stops && pass == 1; k++) {
                part *own = &f->parts[sl_root_of(f->parent, 2 * i + k)];
                own->opening = fmax(own->opening, channel->width);
            }
        }
}

/// A part that is a room, before it has a number.
typedef struct found_room {
    double area;
    sl_point place;
    uint32_t root, triangles;
} found_room;

static int compare_rooms(const void *left, const void *right) {
    const found_room *a = left, *b = right;
    if (a->area != b->area) return a->area > b->area ? -1 : 1;
    return sli_compare_points(a->place, b->place);
}

/// Whether parts are rooms; their numbers by root, or SL_NO_ROOM.
static sl_status number_rooms(finder *f, const sl_space *space, double width, uint32_t *number,
                              sl_rooms *out) {
    const size_t count = f->channels.triangles.halves.count;
    SL_ARRAY(found_room) rooms = {0};
    sl_status status = SL_OK;
    double roomiest = 0;
    for (uint32_t i = 0; i < count; i++)
        if (f->parent[i] == i && f->parts[i].clearance < INFINITY &&
            sl_space_is_inside(space, f->parts[i].place))
            roomiest = fmax(roomiest, f->parts[i].clearance);
    const double least = width > 0 ? width / 4 : LEAST * roomiest;
    for (uint32_t i = 0; status == SL_OK && i < count; i++) {
        const part *p = &f->parts[i];
        number[i] = SL_NO_ROOM;
        if (f->parent[i] != i || p->clearance < least || p->area < p->opening * p->opening ||
            p->clearance == INFINITY || !sl_space_is_inside(space, p->place))
            continue;
        status = SL_ARRAY_ROOM(f->context, &rooms, 1);
        if (status == SL_OK) rooms.items[rooms.count++] = (found_room){p->area, p->place, i, 0};
    }
    if (rooms.count) qsort(rooms.items, rooms.count, sizeof *rooms.items, compare_rooms);
    out->items = sl_alloc_array(f->context, rooms.count, sizeof *out->items);
    if (!out->items) status = SL_NO_MEMORY;
    for (uint32_t i = 0; status == SL_OK && i < rooms.count; i++) {
        const part *p = &f->parts[rooms.items[i].root];
        number[rooms.items[i].root] = i;
        out->items[out->count++] = (sl_room){.at = p->place,
                                             .clearance = p->clearance,
                                             .area = p->area,
                                             .bounds = {p->place, p->place}};
        status = sl_rooms_name(f->context, out, i, "");
    }
    sl_free(f->context, rooms.items);
    return status;
}

/// Gives rooms their triangles, room by room.
static sl_status fill_shapes(finder *f, const uint32_t *number, sl_rooms *out) {
    const size_t count = f->channels.triangles.halves.count;
    size_t *next = sl_alloc_array(f->context, (size_t)out->count + 1, sizeof *next);
    out->points = sl_alloc_array(f->context, count, sizeof *out->points);
    out->ends = sl_alloc_array(f->context, count / 3 + 1, sizeof *out->ends);
    if (!next || !out->points || !out->ends) {
        sl_free(f->context, next);
        return SL_NO_MEMORY;
    }
    uint32_t halves[3];
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t room = number[sl_root_of(f->parent, i)];
        if (is_triangle(f, i, halves) && room != SL_NO_ROOM) out->items[room].shape.count++;
    }
    for (uint32_t i = 0; i < out->count; i++) {
        next[i + 1] = next[i] + out->items[i].shape.count;
        out->items[i].shape.points = out->points + 3 * next[i];
        out->items[i].shape.ends = out->ends + next[i];
        for (size_t k = 0; k < out->items[i].shape.count; k++) out->ends[next[i] + k] = 3 * (k + 1);
    }
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t room = number[sl_root_of(f->parent, i)];
        if (!is_triangle(f, i, halves) || room == SL_NO_ROOM) continue;
        for (int k = 0; k < 3; k++) {
            const sl_point p = start_of(f, halves[k]);
            sl_box *box = &out->items[room].bounds;
            out->points[3 * next[room] + (size_t)k] = p;
            *box = (sl_box){{fmin(box->min.x, p.x), fmin(box->min.y, p.y)},
                            {fmax(box->max.x, p.x), fmax(box->max.y, p.y)}};
        }
        next[room]++;
    }
    sl_free(f->context, next);
    return SL_OK;
}

static sl_status find(finder *f, const sl_map *map, const sl_space *space, sl_rooms *out) {
    SL_TRY(begin(f, map, out->width));
    join_parts(f, out->width);
    const size_t count = f->channels.triangles.halves.count;
    uint32_t *number = sl_alloc_array(f->context, count, sizeof *number);
    if (!number) return SL_NO_MEMORY;
    sl_status status = number_rooms(f, space, out->width, number, out);
    if (status == SL_OK) status = fill_shapes(f, number, out);
    sl_free(f->context, number);
    return status;
}

static sl_status find_by(sl_context *context, const sl_map *map, const sl_space *space,
                         double width, sl_rooms *out) {
    finder f = {.context = context};
    sl_rooms rooms = {.width = width};
    const sl_status status = find(&f, map, space, &rooms);
    end(&f);
    if (status == SL_OK)
        *out = rooms;
    else
        sl_rooms_destroy(context, &rooms);
    return status;
}

sl_status sl_rooms_find(sl_context *context, const sl_map *map, const sl_space *space, double width,
                        sl_rooms *out) {
    const double metres = sli_unit_metres(map->unit);
    *out = (sl_rooms){0};
    if (!(width >= 0 && width <= SL_COORDINATE_MAX))
        return sl_fail(context, SL_BAD_ARGUMENT, "the width of doors is a number from 0 on");
    if (!map->wall_count) return SL_OK;
    if (width > 0) return find_by(context, map, space, width, out);
    if (metres > 0) SL_TRY(find_by(context, map, space, DOOR / metres, out));
    if (out->count) return SL_OK;
    sl_rooms_destroy(context, out); // the unit is unknown, or is not what the file says
    SL_TRY(find_width(context, map, &width));
    return find_by(context, map, space, width, out);
}

void sl_rooms_destroy(sl_context *context, sl_rooms *rooms) {
    for (uint32_t i = 0; i < rooms->count; i++) sl_free(context, rooms->items[i].name);
    sl_free(context, rooms->items);
    sl_free(context, rooms->points);
    sl_free(context, rooms->ends);
    *rooms = (sl_rooms){0};
}

uint32_t sl_rooms_at(const sl_rooms *rooms, sl_point point) {
    for (uint32_t i = 0; i < rooms->count; i++) {
        const sl_room *room = &rooms->items[i];
        if (!sli_box_holds(&room->bounds, point)) continue;
        for (size_t k = 0; k < room->shape.count; k++) {
            const sl_point *c = room->shape.points + 3 * k;
            if (sli_orient(c[0], c[1], point) >= 0 && sli_orient(c[1], c[2], point) >= 0 &&
                sli_orient(c[2], c[0], point) >= 0)
                return i;
        }
    }
    return SL_NO_ROOM;
}

// --- names

sl_status sl_rooms_name(sl_context *context, sl_rooms *rooms, uint32_t room, const char *name) {
    char number[32];
    snprintf(number, sizeof number, "Room %u", room + 1);
    if (!*name) name = number;
    char *copy = sl_copy_text(context, name, strlen(name));
    if (!copy) return SL_NO_MEMORY;
    sl_free(context, rooms->items[room].name);
    rooms->items[room].name = copy;
    return SL_OK;
}

/// Whether a text may be a name: it has a letter, and no number with a unit of area at its end.
static bool is_name(const char *text) {
    const char *at = text + strspn(text, "0123456789.,' ");
    static const char *const areas[] = {"m2",   "m\xc2\xb2",  "m^2",   "qm", "sqm",
                                        "sqft", "ft\xc2\xb2", "sq ft", "sf"};
    bool letter = false;
    for (size_t i = 0; at != text && i < sizeof areas / sizeof *areas; i++)
        if (strcmp(at, areas[i]) == 0) return false;
    for (at = text; *at; at++)
        letter |= (*at >= 'A' && *at <= 'Z') || (*at >= 'a' && *at <= 'z') || (*at & 0x80);
    return letter;
}

/// Whether a text names its room rather than another one does.
static bool names_better(const sl_map_text *text, const sl_map_text *other) {
    const bool name = is_name(text->text), best = is_name(other->text);
    if (name != best) return name;
    if (text->height != other->height) return text->height > other->height;
    return text->at.y > other->at.y;
}

sl_status sl_rooms_take_names(sl_context *context, sl_rooms *rooms, const sl_map *map) {
    const sl_map_source *source = &map->source;
    const sl_map_text **best = sl_alloc_array(context, rooms->count, sizeof(*best));
    sl_status status = best ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; best && i < source->text_count; i++) {
        const sl_map_text *text = &source->texts[i];
        const uint32_t room = sl_rooms_at(rooms, text->at);
        if (room == SL_NO_ROOM) continue;
        if (!best[room] || names_better(text, best[room])) best[room] = text;
    }
    for (uint32_t i = 0; i < rooms->count && status == SL_OK; i++)
        if (best[i]) status = sl_rooms_name(context, rooms, i, best[i]->text);
    sl_free(context, best);
    return status;
}

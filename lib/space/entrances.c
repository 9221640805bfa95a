/// What is inside of a map that has no start: what a disc of the width of an entrance cannot enter
/// from outside.
///
/// Walls and channels (channels.h) cut the free ground into triangles. The widest disc that gets
/// from outside to a triangle is known as a spanning tree is made (Kruskal 1956): sides join
/// triangles, the widest first, and what is joined to the outside by a side of width w has the
/// *access* w. Behind an entrance all is of one access, up to the next narrower door:
///
///     +------------+-----+
///     |    1.2      0.8  |       a house: access 1.2 behind the entrance, 0.8 behind the inner
///     |            +-----+       door, 0 in the cores of walls, and the outside has no limit
///     +---   ------+
///
/// With a width W, triangles of access W or less, joined, are *parts*. A part counts as inside if a
/// disc of W/2 fits in it, so that cores of walls do not. If it has an opening, it must be roomier
/// than the opening: else it is a niche or an alley. In cores of thick walls such a disc fits, too.
/// So a closed part beside parts with openings must be short if it is narrower than W.
///
/// W is what the map says, or 1.2 m if its unit is known, or by the doors that a drawing shows.
/// Else it is found. Every *pocket* (triangles of one access that are roomier than it) tells of an
/// opening, and W is the largest below the greatest step in their widths. What is inside then must
/// have a third of the sides of walls that can be reached at all. If it has less, the map is no
/// building, and nothing is found.
///
/// A pocket with a somewhat wider opening may be a hall whose rooms are inside. So may what all
/// openings of a part lead to, as a corridor with an open end. This is a doubt: then such rooms do
/// not count, unless the map says W. In plans that are drawn (sl_map.entrance_may_be_wide), such an
/// opening is tried as W first (wide_entrances.c).
///
/// Where a part that is inside ends at a channel, the map gets a seam. So no cell lies on both
/// sides. Time O(n log n), and what channels take.
///
/// access.c makes the tree and the groups, interior_parts.c the parts and the doubts.
#include "space/entrances.h"
#include "sightline/space.h"
#include "sightline/support.h"
#include "space/kd_tree.h"

#include "geometry/length.h"
#include "geometry/orient.h"
#include "map/scan.h"
#include "map/source.h"
#include "map/unit.h"

#include <stdlib.h>
#include <string.h>

#define NOWHERE ((sl_point){NAN, NAN})

/// Usual entrances, in metres, and the share of their width that doors have.
#define ENTRANCE 1.2
#define DOORS    0.7
/// Slits are narrower than this share of the map, and no entrances.
#define SLIT 1000
/// How much less roomy than other places cores of walls are.
#define CORE 16
/// How much less roomy than niches outdoors rooms are.
#define ROOMY 4

/// How far apart shares of the area may be that are nearly the same.
static const double STEADY = 0.1;

// --- the width

/// Sorts out channels by the exact width: their rounded ones then agree with it.
static void settle_widths(sli_entrances *f, double width) {
    for (size_t i = 0; i < f->channels.items.count; i++) {
        sli_channel *each = &f->channels.items.items[i];
        const bool stops = sli_channel_stops(each, width);
        if (stops && each->width > width) each->width = width;
        if (!stops && each->width <= width) each->width = nextafter(width, INFINITY);
    }
}

/// Drops widths of slits, where there are others: walls that were meant to meet.
static size_t drop_slits(double *widths, size_t count, double slit) {
    size_t wide = 0;
    for (size_t i = 0; i < count; i++) wide += widths[i] > slit;
    if (!wide) return count;
    wide = 0;
    for (size_t i = 0; i < count; i++)
        if (widths[i] > slit) widths[wide++] = widths[i];
    return wide;
}

/// The number before the greatest step, by ratio; up to `most`.
static double before_step(double *numbers, size_t count, double most) {
    double best = 0, step = 1;
    if (count) qsort(numbers, count, sizeof *numbers, sl_compare_numbers);
    for (size_t i = 0; i < count; i++) {
        const double own = (i + 1 < count ? numbers[i + 1] : most) / numbers[i];
        if (own < step) continue;
        step = own;
        best = numbers[i];
    }
    return best;
}

/// Finds the width of entrances by pockets; 0 for none. Pockets that are small against the map do
/// not count.
static sl_status find_width(sli_entrances *f, double most, double *out) {
    const double width = f->bounds.max.x - f->bounds.min.x,
                 height = f->bounds.max.y - f->bounds.min.y;
    SL_TRY(
        sli_access_gather(f, (sli_access_choice){.least = 0x1p-1000, .most = most, .same = true}));
    double *widths = sl_alloc_array(f->context, f->groups.count, sizeof *widths);
    size_t count = 0;
    sl_status status = widths ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; i < f->groups.count && status == SL_OK; i++) {
        sli_access_group *g = &f->groups.items[i];
        bool roomier = false;
        if (g->area < width * height / 200) continue;
        status = sli_access_fits(f, g, SLI_ROOMIER * g->access, &roomier);
        if (roomier) widths[count++] = g->access;
    }
    const double slit = fmax(width, height) / SLIT;
    count = drop_slits(widths, status == SL_OK ? count : 0, slit);
    const double best = status == SL_OK ? before_step(widths, count, most) : 0;
    // Where there are only slits, all of them are entrances: many are no wider than rounding.
    double widest = best > 0 ? fmax(best, fmin(slit, most)) : 0;
    // Both faces of a door frame are openings.
    for (size_t i = 0; i < f->groups.count; i++)
        if (f->groups.items[i].access <= 1.01 * best)
            widest = fmax(widest, f->groups.items[i].access);
    *out = sli_rounded_up(widest);
    sl_free(f->context, widths);
    return status;
}

/// Whether the ground beyond all walls is solid: so is that beside the wall that bounds the map at
/// its leftmost point. Of the walls there, this is the one with no other at its left.
static bool is_solid_around(const sl_map *map) {
    sl_point first = {INFINITY, INFINITY}, end = first;
    uint32_t beyond = 0;
    for (size_t i = 0; i < map->wall_count; i++) {
        const sl_wall *w = &map->walls[i];
        const bool forth = sli_compare_points(w->a, w->b) < 0;
        const sl_point from = forth ? w->a : w->b, to = forth ? w->b : w->a;
        const int order = sli_compare_points(from, first);
        if (order > 0 || (order == 0 && sli_orient(first, end, to) < 0)) continue;
        first = from;
        end = to;
        beyond = w->ground & (forth ? SL_SOLID_LEFT : SL_SOLID_RIGHT);
    }
    return beyond != 0;
}

/// Whether each wall says what is solid and what is open, and solid ground is around all of them:
/// then all that is open is inside.
static bool knows_ground(const sl_map *map) {
    const uint32_t left = SL_SOLID_LEFT | SL_OPEN_RIGHT, right = SL_SOLID_RIGHT | SL_OPEN_LEFT;
    bool all = true;
    for (size_t i = 0; i < map->wall_count; i++) {
        const uint32_t ground = map->walls[i].ground;
        all &= (ground & left) == left || (ground & right) == right;
    }
    return all && is_solid_around(map);
}

// --- what the map gets

static bool is_inside(const sli_entrances *f, uint32_t triangle) {
    return triangle != SLI_NO_TRIANGLE && f->group_of[triangle] != SLI_NO_TRIANGLE &&
           f->groups.items[f->group_of[triangle]].inside;
}

/// Whether what is inside has a third of the sides of walls that can be reached or are inside.
/// `opened`: only parts with openings count.
static bool is_building(const sli_entrances *f, bool opened) {
    double all = 0, inside = 0;
    for (uint32_t half = 0; half < sli_entrances_triangles(f)->halves.count; half++) {
        const uint32_t own = f->triangle[half];
        if (own == SLI_NO_TRIANGLE || sli_entrances_label(f, half) != SLI_WALL) continue;
        const bool counts = is_inside(f, own) && (!opened || f->access[own] > 0);
        if (counts || f->access[own] > 0) all += sli_entrances_length(f, half);
        if (counts) inside += sli_entrances_length(f, half);
    }
    return inside > 0 && inside >= all / 3;
}

/// Whether a segment lies on the border of the space: no cell is beyond it.
static bool on_border(const sli_entrances *f, sl_segment at) {
    const sl_box *b = &f->border;
    return (at.a.x == at.b.x && (at.a.x == b->min.x || at.a.x == b->max.x)) ||
           (at.a.y == at.b.y && (at.a.y == b->min.y || at.a.y == b->max.y));
}

/// Adds a seam, or marks the one that is there.
static sl_status add_seam(sli_entrances *f, sl_segment at) {
    sl_map *map = f->map;
    if (sli_same_point(at.a, at.b) || on_border(f, at)) return SL_OK;
    for (size_t i = 0; i < map->seam_count; i++) {
        sl_glass *seam = &map->seams[i];
        const sl_segment own = seam->segment;
        if ((sli_same_point(own.a, at.a) && sli_same_point(own.b, at.b)) ||
            (sli_same_point(own.a, at.b) && sli_same_point(own.b, at.a))) {
            seam->entrance = true;
            return SL_OK;
        }
    }
    SL_TRY(sli_map_add_border(f->context, map, at));
    map->seams[map->seam_count - 1].entrance = true;
    return SL_OK;
}

/// Closes what is inside by seams. In an axial map an oblique one becomes two axial ones. Their
/// corner lies on the circle over the channel, on the side that is not inside; so no wall is
/// between.
static sl_status add_seams(sli_entrances *f, bool axial) {
    for (uint32_t half = 0; half < sli_entrances_triangles(f)->halves.count; half += 2) {
        const uint32_t label = sli_entrances_label(f, half);
        if (label == SLI_WALL ||
            is_inside(f, f->triangle[half]) == is_inside(f, f->triangle[half ^ 1]))
            continue;
        f->found.entrances++;
        const sl_point a = sli_entrances_start(f, half), b = sli_entrances_start(f, half ^ 1);
        if (!axial) {
            SL_TRY(add_seam(f, (sl_segment){a, b}));
            continue;
        }
        const bool left = is_inside(f, f->triangle[half]);
        const bool turns_left = sli_orient(a, b, (sl_point){a.x, b.y}) > 0;
        const sl_point corner = left == turns_left ? (sl_point){b.x, a.y} : (sl_point){a.x, b.y};
        SL_TRY(add_seam(f, (sl_segment){a, corner}));
        SL_TRY(add_seam(f, (sl_segment){corner, b}));
    }
    return SL_OK;
}

static int compare_groups(const void *left, const void *right) {
    const sli_access_group *a = left, *b = right;
    if (a->clearance != b->clearance) return a->clearance > b->clearance ? -1 : 1;
    return sli_compare_points(a->place, b->place);
}

/// The roomiest groups first.
static void sort_groups(sli_entrances *f) {
    if (f->groups.count)
        qsort(f->groups.items, f->groups.count, sizeof *f->groups.items, compare_groups);
}

/// Gives the map a place in each part, the roomiest first.
static sl_status add_places(sli_entrances *f) {
    sl_interior *found = &f->found;
    size_t count = 0;
    found->building = is_building(f, false);
    for (size_t i = 0; i < f->groups.count; i++)
        if (f->groups.items[i].inside) f->groups.items[count++] = f->groups.items[i];
    if (!count) return SL_OK;
    found->places = sl_alloc_array(f->context, count, sizeof *found->places);
    if (!found->places) return SL_NO_MEMORY;
    qsort(f->groups.items, count, sizeof *f->groups.items, compare_groups);
    for (size_t i = 0; i < count; i++) found->places[i] = f->groups.items[i].place;
    found->roomiest = found->places[0];
    found->place_count = count;
    return SL_OK;
}

// --- all of it

static sl_status make_channels(sli_entrances *f, double most) {
    SL_TRY(sli_channels_make(f->context, f->map, most, &f->channels));
    SL_TRY(sli_clearance_make(f->context, &f->channels, &f->clearance));
    SL_TRY(sli_access_number(f));
    return sli_access_find(f);
}

static void destroy(sli_entrances *f) {
    sli_clearance_destroy(&f->clearance);
    sli_wall_index_destroy(f->context, &f->walls);
    sli_channels_destroy(f->context, &f->channels);
    void *const arrays[] = {f->triangle,     f->half,          f->access,   f->closed,
                            f->parent,       f->following,     f->group_of, f->order,
                            f->groups.items, f->openings.items};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) sl_free(f->context, arrays[i]);
}

/// Finds the parts that are inside by a width.
static sl_status find_parts(sli_entrances *f, double width) {
    uint8_t *marks = sl_alloc_array(f->context, 2 * (size_t)f->count, sizeof *marks);
    if (!marks) return SL_NO_MEMORY;
    uint8_t *halls = marks + f->count;
    settle_widths(f, width);
    sl_status status = sli_access_find(f);
    if (status == SL_OK) status = sli_parts_find_halls(f, width, halls);
    if (status == SL_OK) status = sli_parts_find_doubts(f, width, halls, marks);
    if (status == SL_OK) status = sli_parts_choose(f, width);
    if (status == SL_OK && f->found.by != SL_ENTRANCE_GIVEN)
        status = sli_parts_drop_doubtful(f, marks);
    sl_free(f->context, marks);
    return status;
}

/// Finds what is inside by openings up to `width`; 0 for a width that is to be found, up to `most`.
static sl_status find_by(sli_entrances *f, sl_entrance by, double width, double most, bool *found) {
    f->found = (sl_interior){.by = by, .width = width, .roomiest = NOWHERE};
    sl_status status = make_channels(f, width > 0 ? sli_parts_doubtful_up_to(f, width) : most);
    if (status == SL_OK && width == 0) status = find_width(f, most, &f->found.width);
    const bool any = f->found.width > 0;
    if (status == SL_OK && any) status = find_parts(f, f->found.width + f->weld);
    *found = false;
    // A wide opening that leaves no doubt about wider ones is steady.
    const bool guess = by == SL_ENTRANCE_FOUND || (by == SL_ENTRANCE_WIDE && most > width);
    // Rooms behind doors that are shut are as closed as the core of a wall.
    const bool opened = by != SL_ENTRANCE_WIDE || !f->map->door_count;
    if (status == SL_OK && any && (!guess || is_building(f, opened)))
        for (size_t i = 0; i < f->groups.count; i++) *found |= f->groups.items[i].inside;
    *found |= status == SL_OK && f->found.doubtful_width > 0;
    return status;
}

static sl_status begin_search_of_entrances(sli_entrances *f, sl_context *context, sl_map *map) {
    *f = (sli_entrances){.context = context,
                         .map = map,
                         .bounds = sl_map_bounds(map),
                         .border = sli_space_bounds(map)};
    f->weld = sli_planar_tolerance(&f->bounds);
    return SL_OK;
}

/// Whether a place is in solid ground: the next wall to its right says so.
static sl_status is_solid(sli_entrances *f, sl_point at, bool *out) {
    sli_wall_index *walls = &f->walls;
    const sl_box along = {at, {f->border.max.x, at.y}};
    double nearest = INFINITY;
    *out = false;
    if (!walls->walls) return SL_OK;
    SL_TRY(sli_box_tree_find(f->context, &walls->tree, &along, &walls->near));
    for (size_t i = 0; i < walls->near.count; i++) {
        const sl_wall *w = &walls->walls[walls->near.items[i]];
        const bool up = w->a.y <= at.y && at.y < w->b.y, down = w->b.y <= at.y && at.y < w->a.y;
        if (!up && !down) continue;
        const double x = w->a.x + (at.y - w->a.y) / (w->b.y - w->a.y) * (w->b.x - w->a.x);
        if (x < at.x || x >= nearest) continue;
        nearest = x;
        *out = w->ground & (up ? SL_SOLID_LEFT : SL_SOLID_RIGHT);
    }
    return SL_OK;
}

/// Takes the place that is farthest from walls, of those with an access up to a width, if it is so
/// many times as far as the one so far.
static sl_status take_roomier(sli_entrances *f, double most, double times, double *clearance) {
    const double least = times * *clearance;
    SL_TRY(sli_access_gather(f, (sli_access_choice){.least = 0, .most = most}));
    sort_groups(f);
    for (size_t i = 0; i < f->groups.count && f->groups.items[i].clearance > least; i++) {
        const sli_access_group *g = &f->groups.items[i];
        bool solid;
        SL_TRY(is_solid(f, g->place, &solid));
        if (solid) continue;
        *clearance = g->clearance;
        f->found.roomiest = g->place;
        break;
    }
    return SL_OK;
}

/// Takes the roomiest place behind openings up to a width that it is roomier than. *behind: the
/// area of all such. *roomy: the clearance of the roomiest place, be it closed or not.
static sl_status take_behind(sli_entrances *f, double most, double *clearance, double *behind,
                             double *roomy) {
    SL_TRY(sli_access_gather(f, (sli_access_choice){.least = 0, .most = most, .same = true}));
    sort_groups(f);
    for (size_t i = 0; i < f->groups.count; i++) {
        const sli_access_group *g = &f->groups.items[i];
        const bool opened = g->access > 0;
        bool solid;
        if (2 * g->clearance < SLI_ROOMIER * g->access) continue;
        if (opened) *behind += g->area;
        if ((opened ? *clearance : *roomy) > 0) continue;
        SL_TRY(is_solid(f, g->place, &solid));
        if (solid) continue;
        *roomy = fmax(*roomy, g->clearance);
        if (!opened) continue;
        *clearance = g->clearance;
        f->found.roomiest = g->place;
    }
    return SL_OK;
}

/// Takes the largest part that is closed, of those that are larger than an area and roomy. They are
/// groups of their own, whatever else was gathered.
static sl_status take_closed(sli_entrances *f, double area, double roomy, double *clearance) {
    for (size_t i = 0; i < f->groups.count; i++) {
        const sli_access_group *g = &f->groups.items[i];
        bool solid;
        if (g->access > 0 || g->clearance < roomy / ROOMY || g->area <= area) continue;
        SL_TRY(is_solid(f, g->place, &solid));
        if (solid) continue;
        area = g->area;
        *clearance = g->clearance;
        f->found.roomiest = g->place;
    }
    return SL_OK;
}

/// Finds a roomy place: in a closed part, or behind openings up to a width where these have more
/// area together, as openings join them. Niches outdoors are behind such, too: they count where
/// nothing is roomier than its opening. Anywhere, if only cores of walls have such.
static sl_status find_roomiest(sli_entrances *f, double most) {
    double clearance = 0, behind = 0, roomy = 0;
    if (sli_entrances_say_ground(f->map))
        SL_TRY(sli_wall_index_create(f->context, f->map, &f->walls));
    SL_TRY(take_behind(f, most, &clearance, &behind, &roomy));
    if (!(roomy > 0)) {
        SL_TRY(take_roomier(f, most, 1, &clearance));
        roomy = clearance;
    }
    SL_TRY(take_closed(f, behind, roomy, &clearance));
    return take_roomier(f, INFINITY, CORE, &clearance);
}

sl_status sli_entrances_try(sl_context *context, sl_map *map, sl_entrance by, double width,
                            double most, bool *found) {
    sli_entrances f;
    SL_TRY(begin_search_of_entrances(&f, context, map));
    f.doubt = most;
    const bool axial = sl_map_is_axial(map);
    sl_status status = find_by(&f, by, width, most, found);
    if (status == SL_OK && *found) status = add_seams(&f, axial);
    if (status == SL_OK && *found) status = add_places(&f);
    if (status == SL_OK && !*found) status = find_roomiest(&f, most);
    if (status == SL_OK && f.clearance.cut_short)
        sl_note(context,
                "%s: the search for rooms was cut short in gaps that are long and thin (triangles: "
                "%zu); if a room counts as outside, name a place in it by --start X,Y",
                sli_map_name(map), f.clearance.cut_short);
    destroy(&f);
    if (status == SL_OK && *found)
        map->interior = f.found;
    else
        sl_free(context, f.found.places);
    if (!*found) map->interior = (sl_interior){.roomiest = f.found.roomiest};
    return status;
}

void sli_entrances_forget(sl_context *context, sl_map *map) {
    size_t kept = 0;
    sl_free(context, map->interior.places);
    map->interior = (sl_interior){.roomiest = NOWHERE};
    for (size_t i = 0; i < map->seam_count; i++) {
        if (map->seams[i].entrance && !map->seams[i].stops) continue;
        map->seams[kept] = map->seams[i];
        map->seams[kept++].entrance = false;
    }
    map->seam_count = kept;
}

/// By doors that are drawn open: the width that is found counts if these can be entrances then.
static sl_status find_by_doors(sl_context *context, sl_map *map, double most, bool *found) {
    SL_TRY(sli_entrances_try(context, map, SL_ENTRANCE_FOUND, 0, most, found));
    if (*found && map->interior.width >= DOORS * map->entrance) return SL_OK;
    sli_entrances_forget(context, map);
    return sli_entrances_try(context, map, SL_ENTRANCE_DOORS, map->entrance, 0, found);
}

#ifndef SLI_WITHOUT_DRAWINGS
/// With more walls the search for a likely start takes seconds, and lettering is among them.
enum { MOST_FOR_PLACE = 1 << 17 };

/// Finds a roomy place alone, behind openings up to a width.
static sl_status find_place(sl_context *context, const sl_map *map, double most, sl_point *place) {
    sli_entrances f;
    sl_map own = *map; // it is not changed
    SL_TRY(begin_search_of_entrances(&f, context, &own));
    sl_status status = make_channels(&f, most);
    f.found.roomiest = NOWHERE;
    if (status == SL_OK) status = find_roomiest(&f, most);
    *place = f.found.roomiest;
    destroy(&f);
    return status == SL_UNSUPPORTED ? SL_OK : status; // too dense
}

sl_status sl_map_find_roomiest(sl_context *context, const sl_map *map, sl_point *place) {
    const sl_box b = sl_map_bounds(map);
    const double shorter = fmin(b.max.x - b.min.x, b.max.y - b.min.y);
    *place = map->interior.roomiest;
    if (!isnan(place->x) || map->start_count || !map->entrance_may_be_wide || !(shorter > 0) ||
        map->wall_count > MOST_FOR_PLACE || !sli_entrances_say_ground(map))
        return SL_OK;
    return find_place(context, map, shorter / 3, place);
}
#endif

/// The share of the map's box that is inside by the parts of a width; 0 where that is no building.
static double share_of_building(const sli_entrances *f) {
    double area = 0;
    for (size_t i = 0; i < f->groups.count; i++)
        if (f->groups.items[i].inside) area += f->groups.items[i].area;
    const double share =
        area / ((f->bounds.max.x - f->bounds.min.x) * (f->bounds.max.y - f->bounds.min.y));
    return share >= 0.5 || is_building(f, false) ? share : 0;
}

sl_status sli_entrances_are_steady(sl_context *context, sl_map *map, double narrow, double width,
                                   bool *steady) {
    enum { WIDTHS = 6 };
    const double widths[WIDTHS] = {narrow,      width,        1.25 * width,
                                   1.5 * width, 1.75 * width, 2 * width};
    double shares[WIDTHS];
    sli_entrances f;
    SL_TRY(begin_search_of_entrances(&f, context, map));
    sl_status status = make_channels(&f, widths[WIDTHS - 1]);
    *steady = true;
    for (size_t i = 0; i < WIDTHS && *steady && status == SL_OK; i++) {
        settle_widths(&f, widths[i] + f.weld);
        status = sli_access_find(&f);
        if (status == SL_OK) status = sli_parts_choose(&f, widths[i] + f.weld);
        if (status != SL_OK) break;
        shares[i] = share_of_building(&f);
        if (i == 1) *steady = shares[1] > 0 && shares[0] <= (1 + STEADY) * shares[1];
        if (i > 1) *steady = fabs(shares[i] - shares[1]) <= STEADY * shares[1];
    }
    destroy(&f);
    return status;
}

static sl_status find(sl_context *context, sl_map *map) {
    const sl_box b = sl_map_bounds(map);
    const double shorter = fmin(b.max.x - b.min.x, b.max.y - b.min.y);
    const double metres = sli_unit_metres(map->unit);
    const bool doors = map->entrance_by_doors;
    const double usual = doors ? map->entrance : metres > 0 ? ENTRANCE / metres : INFINITY;
    bool found = false;
    if (!(shorter > 0)) return SL_OK;
    if (map->entrance > 0 && !doors)
        return sli_entrances_try(context, map, SL_ENTRANCE_GIVEN, map->entrance, 0, &found);
    if (usual < 0.6 * shorter && !knows_ground(map))
        SL_TRY(doors ? find_by_doors(context, map, shorter / 3, &found)
                     : sli_entrances_try(context, map, SL_ENTRANCE_UNIT, usual, 0, &found));
    if (!found && !sli_entrances_say_ground(map))
        SL_TRY(sli_entrances_try(context, map, SL_ENTRANCE_FOUND, 0, shorter / 3, &found));
#ifndef SLI_WITHOUT_DRAWINGS
    if (found) SL_TRY(sli_entrances_widen(context, map));
#endif
    return SL_OK;
}

sl_status sl_map_find_inside(sl_context *context, sl_map *map, const sl_clean_options *clean,
                             sl_clean_account *account) {
    sl_clean_account again = {0};
    sli_entrances_forget(context, map);
    if (map->start_count || !map->wall_count) return SL_OK;
    const size_t seams = map->seam_count;
    const sl_status status = find(context, map);
    if (status == SL_UNSUPPORTED) {
        sli_entrances_forget(context, map);
        sl_note(context,
                "%s: its walls are too dense to look for rooms among them; name a place in a room "
                "by --start X,Y",
                sli_map_name(map));
        return SL_OK;
    }
    SL_TRY(status);
    if (map->seam_count == seams || (sl_map_is_axial(map) && !map->cell_count)) return SL_OK;
    // Walls go through the rounded ends of seams.
    SL_TRY(sl_map_clean(context, map, clean, &again));
    if (!account) return SL_OK;
    account->after = again.after;
    account->split += again.split;
    account->largest_move = fmax(account->largest_move, again.largest_move);
    return SL_OK;
}
